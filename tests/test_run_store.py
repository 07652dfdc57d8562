"""Runs of studies on disk: found by what was run, refused where they are of something else."""

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

import panelsim.studies.run_store as run_store
from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.motion.history import History
from panelsim.results.rms_study import StudySea
from panelsim.results.statistics import statistics
from panelsim.studies.rms_of_runs import rms_of_runs
from panelsim.studies.run_store import RunStore, kept_bytes, run_identity, run_key

EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"


@pytest.fixture
def case() -> Case:
    return Case.load(EXAMPLE)


@pytest.fixture
def store(tmp_path: Path) -> RunStore:
    return RunStore(tmp_path / "runs")


def keep(store: RunStore, case: Case, history: History) -> None:
    store.save(case, kept_bytes(history, run_identity(case)))


def test_a_stored_run_has_the_motions_of_its_history(store: RunStore, case: Case, make_history: Any) -> None:
    history = make_history()
    assert case not in store
    keep(store, case, history)
    assert case in store
    run = store.load(case)
    assert run.displacement.tobytes() == history.displacement.tobytes()
    assert run.wave_elevation.tobytes() == history.wave_elevation.tobytes()
    assert run.time.tobytes() == history.time.tobytes()
    assert {name: run.attrs[name] for name in history.attrs} == history.attrs
    assert run.early_end is None


def test_its_rms_is_that_of_the_statistics(store: RunStore, case: Case, make_history: Any) -> None:
    # 0.3 s steps: the ramp of 12 s is no whole number of binary steps.
    history = make_history(step=0.3)
    keep(store, case, history)
    motions = statistics(history).motions
    # 1e-13: statistics take one column at a time, which sums in another order
    np.testing.assert_allclose(store.load(case).rms, [motions[name].rms for name in motions], rtol=1e-13)


def test_the_rms_is_known_without_the_motions(store: RunStore, case: Case, make_history: Any) -> None:
    keep(store, case, make_history())
    expected = store.load(case).rms
    with h5py.File(store.path(case), "a") as file:
        del file["displacement"]
    again = RunStore(store.folder)
    rms, early_end = again.rms(case)
    assert rms.tobytes() == expected.tobytes() and early_end is None
    assert set(again.told) == {run_key(case)}
    store.path(case).unlink()
    assert again.rms(case)[0].tobytes() == expected.tobytes()  # it is read once


def test_a_run_that_ended_early_says_so_and_has_no_rms(
    store: RunStore, case: Case, make_history: Any
) -> None:
    keep(store, case, make_history(outcome="capsized", outcome_detail="roll of 91° at 40 s"))
    run = store.load(case)
    assert run.early_end == "capsized: roll of 91° at 40 s"
    assert np.isnan(run.rms).all()


def test_runs_are_told_apart_by_every_key_of_the_case(case: Case) -> None:
    changes: list[dict[str, Any]] = [
        {"run.time_step": 0.2},
        {"seaway.seed": 7},
        {"run.stepper": "rk4"},
        {"run.pressure_rule": "panel"},
        {"supplementary.damping.roll": 3e7},
        {"ship.panel_area": 5.0},
    ]
    keys = {run_key(case)} | {run_key(case.changed(change)) for change in changes}
    assert len(keys) == len(changes) + 1
    assert run_key(case.changed({"seaway.seed": case.file.seaway.seed})) == run_key(case)


def test_a_run_depends_on_the_files_that_its_case_names(tmp_path: Path, case: Case) -> None:
    shutil.copytree(EXAMPLE.parents[1] / "hulls" / "box", tmp_path / "mine")
    mine = Case(case.changed({"ship.hull": "mine"}).file, tmp_path)
    before = run_key(mine)
    (tmp_path / "mine" / "notes.txt").write_text("not read by any run")
    assert run_key(mine.changed({})) == before
    particulars = tmp_path / "mine" / "particulars.toml"
    particulars.write_text(particulars.read_text() + "\n# another\n")
    assert run_key(mine.changed({})) != before
    assert run_key(mine) == before  # it is taken once: a study finds what it has made


def test_the_offsets_of_a_hull_folder_are_read(tmp_path: Path, case: Case) -> None:
    shutil.copytree(EXAMPLE.parents[1] / "hulls" / "s175", tmp_path / "mine")
    mine = Case(case.changed({"ship.hull": "mine"}).file, tmp_path)
    (tmp_path / "mine" / "hydro.nc").unlink()
    assert run_key(mine.changed({})) == run_key(mine)
    offsets = tmp_path / "mine" / "offsets.csv"
    offsets.write_text(offsets.read_text() + "\n")
    assert run_key(mine.changed({})) != run_key(mine)


def test_a_folder_called_as_a_bundled_hull_makes_no_other_run(tmp_path: Path, case: Case) -> None:
    here = Case(case.file, tmp_path)
    before = run_key(here)
    assert before == run_key(case)
    (tmp_path / case.file.ship.hull).mkdir()
    (tmp_path / case.file.ship.hull / "particulars.toml").write_text("another hull")
    assert run_key(here.changed({})) == before


def test_a_mesh_and_the_file_of_a_sea_are_read_and_a_folder_is_none(tmp_path: Path, case: Case) -> None:
    sea = {"kind": "components", "file": "sea.csv"}
    of_file = Case(case.changed({"ship.hull": "ship.stl", "seaway": sea}).file, tmp_path)
    keys = [run_key(of_file.changed({}))]
    (tmp_path / "sea.csv").mkdir()
    (tmp_path / "ship.stl").mkdir()
    assert run_key(of_file.changed({})) == keys[0]
    for name in ("sea.csv", "ship.stl"):
        (tmp_path / name).rmdir()
        for text in ("one", "two"):
            (tmp_path / name).write_text(text)
            keys.append(run_key(of_file.changed({})))
    assert len(set(keys)) == 5


def test_a_run_of_another_case_under_this_name_is_refused(
    store: RunStore, case: Case, make_history: Any
) -> None:
    other = case.changed({"seaway.seed": 7})
    keep(store, other, make_history())
    store.path(other).rename(store.path(case))
    for read in (store.load, store.rms):
        with pytest.raises(PanelsimError, match="of another case"):
            read(case)


def test_a_run_of_another_version_is_refused(
    store: RunStore, case: Case, make_history: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    keep(store, case, make_history())
    store.save_failure(case.changed({"seaway.seed": 7}), "no such sea")
    monkeypatch.setattr(run_store, "panelsim_version", lambda: "9.9.9")
    for read in (store.load, store.rms):
        with pytest.raises(PanelsimError, match=r"another version(.|\n)*0\.1\.0(.|\n)*9\.9\.9"):
            read(case)
    with pytest.raises(PanelsimError, match="another version"):
        store.failure(case.changed({"seaway.seed": 7}))


@pytest.mark.parametrize("cut", [0, 100, 5000])
def test_a_file_cut_short_is_refused(store: RunStore, case: Case, make_history: Any, cut: int) -> None:
    keep(store, case, make_history())
    store.path(case).write_bytes(store.path(case).read_bytes()[:cut])
    for read in (store.load, store.rms):
        with pytest.raises(PanelsimError, match="damaged"):
            read(case)


def test_a_bit_of_the_motions_that_fell_over_is_noticed(
    store: RunStore, case: Case, make_history: Any
) -> None:
    history = make_history()
    keep(store, case, history)
    content = bytearray(store.path(case).read_bytes())
    at = content.index(history.displacement[-5:].tobytes())
    content[at + 3] ^= 16
    store.path(case).write_bytes(content)
    with pytest.raises(PanelsimError, match="damaged"):
        store.load(case)


def test_a_file_without_motions_is_refused(store: RunStore, case: Case) -> None:
    store.folder.mkdir()
    with h5py.File(store.path(case), "w") as file:
        file["time"] = [0.0]
    with pytest.raises(PanelsimError, match="damaged"):
        store.load(case)


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda file: file.attrs.pop("outcome"), "without outcome"),
        (lambda file: file.attrs.pop("rms"), "without rms"),
        (lambda file: file.attrs.pop("identity"), "without identity"),
        (lambda file: shorten(file, "displacement"), "another length"),
        (lambda file: shorten(file, "wave_elevation"), "another length"),
        (
            lambda file: file["displacement"].write_direct(np.full(file["displacement"].shape, np.nan)),
            "finite",
        ),
    ],
)
def test_a_run_with_something_missing_is_refused(
    store: RunStore, case: Case, make_history: Any, damage: Callable[[h5py.File], object], words: str
) -> None:
    keep(store, case, make_history())
    with h5py.File(store.path(case), "a") as file:
        damage(file)
    with pytest.raises(PanelsimError, match=f"damaged(.|\n)*{words}"):
        store.load(case)


def shorten(file: h5py.File, name: str) -> None:
    """Take the last row away."""
    values = file[name][:-1]
    del file[name]
    file[name] = values


def test_a_diverged_run_may_end_in_what_is_no_number(store: RunStore, case: Case, make_history: Any) -> None:
    motions = make_history().displacement.copy()
    motions[-1] = np.nan
    keep(store, case, make_history(displacement=motions, outcome="diverged", outcome_detail="heave"))
    assert store.load(case).early_end == "diverged: heave"


@pytest.mark.parametrize("rms", [np.full(6, np.nan), np.zeros(5), "words"])
def test_a_finished_run_whose_rms_is_no_figure_is_refused(
    store: RunStore, case: Case, make_history: Any, rms: object
) -> None:
    keep(store, case, make_history())
    with h5py.File(store.path(case), "a") as file:
        file.attrs["rms"] = rms
    with pytest.raises(PanelsimError, match=r"damaged(.|\n)*RMS"):
        store.rms(case)


def test_a_run_that_ended_in_its_first_step_is_whole(store: RunStore, case: Case, make_history: Any) -> None:
    keep(store, case, make_history(outcome="capsized", outcome_detail="roll"))
    with h5py.File(store.path(case), "a") as file:
        for name in ("time", "displacement", "wave_elevation"):
            values = file[name][:1]
            del file[name]
            file[name] = values
    assert store.load(case).early_end == "capsized: roll"


@pytest.mark.parametrize("content", [b"", b"[]", b"[1]", b"\xff\xfe", b'"text"'])
def test_a_damaged_note_of_a_failure_is_refused(store: RunStore, case: Case, content: bytes) -> None:
    store.save_failure(case, "no luck")
    (note,) = store.folder.iterdir()
    note.write_bytes(content)
    with pytest.raises(PanelsimError, match=r"damaged(.|\n)*remove the file"):
        store.failure(case)
    note.write_bytes(b"{}")
    with pytest.raises(PanelsimError, match="another version"):
        store.failure(case)


def test_a_run_that_is_not_there_is_told(store: RunStore, case: Case) -> None:
    with pytest.raises(PanelsimError, match="not stored"):
        store.load(case)


def test_a_failure_is_kept_with_its_message(store: RunStore, case: Case) -> None:
    assert store.failure(case) is None
    store.save_failure(case, "The sea is too steep.\n  got: 0.2")
    assert case in store
    assert store.failure(case) == "The sea is too steep.\n  got: 0.2"


def test_rms_of_runs_reads_levels_seas_and_realizations_in_their_places(
    store: RunStore, case: Case, make_history: Any
) -> None:
    still = make_history().displacement

    def case_of(level: int, sea: int, realization: int) -> Case:
        return case.changed({"seaway.seed": 100 * level + 10 * sea + realization})

    for level, sea, realization in np.ndindex(2, 3, 2):
        if (level, sea, realization) == (1, 2, 0):
            store.save_failure(case_of(1, 2, 0), "no luck")
        else:
            scale = 1.0 + 100 * level + 10 * sea + realization
            keep(store, case_of(level, sea, realization), make_history(displacement=scale * still))
    study = rms_of_runs(
        store,
        case_of,
        title="made up",
        varied="time step [s]",
        levels=["0.2 s", "0.1 s"],
        values=np.array([0.2, 0.1]),
        reference=1,
        seas=[StudySea(f"sea {i}", 150.0) for i in range(3)],
        realizations=2,
    )
    one = study.rms[0, 0, 0]
    # 1e-12: the mean of scaled motions rounds elsewhere
    np.testing.assert_allclose(study.rms[1, 1, 1], 112.0 * one, rtol=1e-12)
    np.testing.assert_allclose(study.rms[0, 2, 1], 22.0 * one, rtol=1e-12)
    assert np.isnan(study.rms[1, 2, 0]).all() and np.isfinite(study.rms).sum() == 11 * 6
    assert study.failures == ("0.1 s, sea 2, realization 1: no luck",)


def test_a_run_of_a_study_is_no_history_and_says_so(
    make_history: Callable[..., History], tmp_path: Path
) -> None:
    path = tmp_path / "run.nc"
    path.write_bytes(kept_bytes(make_history(), "identity"))
    with pytest.raises(
        PanelsimError, match=r"motions and the wave alone are kept(.|\n)*run\.nc(.|\n)*panelsim run"
    ):
        History.load(path)
