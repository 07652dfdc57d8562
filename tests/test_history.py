"""A history gives back bit for bit what was put in, and refuses what it cannot vouch for."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from panelsim.errors import PanelsimError
from panelsim.motion.history import LOADING_UNITS, History
from panelsim.seaway.components import NO_WAVES

MakeHistory = Callable[..., History]


def test_a_saved_history_comes_back_bit_for_bit(make_history: MakeHistory, tmp_path: Path) -> None:
    history = make_history()
    back = History.load(history.save(tmp_path / "history.nc"))
    assert back.same_bits(history)
    assert back.attrs == history.attrs
    assert back.notes == history.notes == ("The sea repeats itself after 346 s.",)
    assert list(back.loads) == ["weight", "wetted_surface"]
    assert back.ship_name == "barge"
    assert back.waterline == history.waterline == pytest.approx(0.5)  # draft 2 m less KG 1.5 m
    assert set(back.loading) == set(LOADING_UNITS)
    np.testing.assert_array_equal(back.components.phase, [0.3, 2.0])


def test_the_ship_is_kept_in_ship_axes(make_history: MakeHistory, barge) -> None:
    history = make_history()
    np.testing.assert_array_equal(history.mesh_vertices, barge.vertices)
    np.testing.assert_array_equal(history.panels, barge.mesh.panels)
    assert history.mesh_vertices[:, 2].min() == pytest.approx(-1.5)  # the keel lies KG below the CG
    assert float(history.loading["mass"]) == pytest.approx(20 * 6 * 2 * 1025.0)


def test_any_program_can_read_the_file(make_history: MakeHistory, tmp_path: Path) -> None:
    path = make_history().save(tmp_path / "history.nc")
    with xr.open_dataset(path, engine="h5netcdf") as data:
        assert data["displacement"].dims == ("time", "dof")
        assert list(data["dof"].values) == ["surge", "sway", "heave", "roll", "pitch", "yaw"]
        assert "rad (roll, pitch, yaw)" in data["displacement"].attrs["units"]
        assert all(variable.attrs["units"] for variable in data.data_vars.values())
        assert data.attrs["outcome"] == "finished"
        assert data.attrs["seed"] == 7
        assert data.attrs["simulated_seconds"] == 60.0
    with xr.open_dataset(path, engine="h5netcdf", group="seaway") as seaway:
        assert seaway["amplitude"].attrs["units"] == "m"
        assert seaway.attrs["stretching"] == "wheeler"


def test_same_bits_sees_the_last_bit_and_no_timings(make_history: MakeHistory) -> None:
    history = make_history()
    assert history.same_bits(make_history(cpu_seconds=99.0, jit_seconds=0.0, outcome="interrupted"))
    changed = history.displacement.copy()
    changed[-1, 5] = np.nextafter(changed[-1, 5], 1.0)
    assert not history.same_bits(make_history(displacement=changed))
    assert not history.same_bits(make_history(wave_elevation=-0.0 * history.wave_elevation))
    assert not history.same_bits(make_history(duration=59.75))


def test_a_run_cut_short_in_calm_water_is_a_history_too(make_history: MakeHistory, tmp_path: Path) -> None:
    history = make_history(duration=0.0, components=NO_WAVES, outcome="interrupted", seed=None, notes=())
    back = History.load(history.save(tmp_path / "history.nc"))
    assert back.same_bits(history)
    assert back.outcome == "interrupted"
    assert back.components.count == 0
    assert "seed" not in back.attrs


def test_rows_after_the_first_that_is_no_number_are_not_finite(make_history: MakeHistory) -> None:
    displacement = make_history().displacement.copy()
    displacement[200, 3] = np.nan
    history = make_history(displacement=displacement, outcome="diverged")
    assert history.finite[:200].all()
    assert not history.finite[200:].any()


def test_arrays_cannot_be_changed(make_history: MakeHistory, tmp_path: Path) -> None:
    history = make_history()
    for each in (history, History.load(history.save(tmp_path / "history.nc"))):
        with pytest.raises(ValueError, match="read-only"):
            each.displacement[0, 0] = 1.0


def test_an_existing_file_is_kept_unless_told(make_history: MakeHistory, tmp_path: Path) -> None:
    path = make_history().save(tmp_path / "history.nc")
    before = path.read_bytes()
    with pytest.raises(PanelsimError, match="overwrite"):
        make_history(duration=30.0).save(path)
    assert path.read_bytes() == before
    # Written over the very file that was loaded: no handle may still hold it.
    assert History.load(path).time[-1] == 60.0
    make_history(duration=30.0).save(path, overwrite=True)
    assert History.load(path).time[-1] == 30.0


def test_a_failed_write_leaves_the_folder_as_it_was(
    make_history: MakeHistory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = make_history().save(tmp_path / "history.nc")
    before = path.read_bytes()

    def full_disk(self: Path, data: bytes) -> int:
        raise OSError("disk full")

    monkeypatch.setattr(Path, "write_bytes", full_disk)
    with pytest.raises(PanelsimError, match="disk full"):
        make_history(duration=30.0).save(path, overwrite=True)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_files_that_are_no_whole_history_are_refused(make_history: MakeHistory, tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="no such history"):
        History.load(tmp_path / "nowhere.nc")

    whole = make_history().save(tmp_path / "history.nc").read_bytes()
    truncated = tmp_path / "truncated.nc"
    truncated.write_bytes(whole[: len(whole) // 2])
    text = tmp_path / "text.nc"
    text.write_text("not at all")
    for path in (truncated, text):
        with pytest.raises(PanelsimError, match="damaged or of another kind"):
            History.load(path)

    foreign = tmp_path / "foreign.nc"
    xr.Dataset({"temperature": ("time", [1.0, 2.0])}).to_netcdf(foreign, engine="h5netcdf")
    with pytest.raises(PanelsimError, match="no panelsim history"):
        History.load(foreign)


def test_histories_of_another_format_or_with_gaps_are_refused(
    make_history: MakeHistory, tmp_path: Path
) -> None:
    tree = make_history().tree.copy()
    tree.attrs["history_format"] = 99
    tree.to_netcdf(tmp_path / "later.nc", engine="h5netcdf")
    with pytest.raises(PanelsimError, match="format 99"):
        History.load(tmp_path / "later.nc")

    tree = make_history().tree.copy()
    tree["mesh"] = xr.DataTree(tree["mesh"].to_dataset().drop_vars("panels"))
    tree.to_netcdf(tmp_path / "gap.nc", engine="h5netcdf")
    with pytest.raises(PanelsimError, match="mesh/panels"):
        History.load(tmp_path / "gap.nc")


def test_what_does_not_fit_together_is_refused(make_history: MakeHistory) -> None:
    with pytest.raises(PanelsimError, match="sunk"):
        make_history(outcome="sunk")
    with pytest.raises(PanelsimError, match=r"load_weight.*\n.*\(3, 6\)"):
        make_history(loads={"weight": np.zeros((3, 6))})
    with pytest.raises(PanelsimError, match="do not increase"):
        make_history(time=np.zeros(241))
