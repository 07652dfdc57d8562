"""Runs side by side in one recording: their curves, what lies between them, statistics and ships."""

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pyarrow as pa
import pytest
import rerun_cli
from rerun.chunk import RrdReader

from panelsim.cli.view import run_names
from panelsim.conventions import DOF_NAMES
from panelsim.errors import PanelsimError
from panelsim.motion.history import History
from panelsim.results.compared_tables import compared_markdown
from panelsim.results.statistics import statistics
from panelsim.view.compared_runs import MOST_SHIPS, REACH, SPACING, compare_recordings
from panelsim.view.frames import choose_frames

MakeHistory = Callable[..., History]
Panelsim = Callable[..., tuple[int, str, str]]
RERUN = Path(rerun_cli.__file__).parent / "rerun"
LENGTH = 20.0  # m, of the barge


@pytest.fixture(autouse=True)
def strict(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without it rerun drops bad data with a warning."""
    monkeypatch.setenv("RERUN_STRICT", "1")


@pytest.fixture(scope="module")
def runs(make_history: MakeHistory) -> dict[str, History]:
    """A run, one of larger motions that ends sooner, and one of another time step."""
    larger = make_history(duration=50.0)
    return {
        "base": make_history(),
        "new fins": make_history(duration=50.0, displacement=1.5 * larger.displacement, outcome="capsized"),
        "coarse": make_history(step=0.4),
    }


@pytest.fixture(scope="module")
def compared(runs: dict[str, History], tmp_path_factory: pytest.TempPathFactory) -> Path:
    return compare_recordings(runs, tmp_path_factory.mktemp("compared") / "new folder" / "runs.rrd")


def read(path: Path, entity: str, component: str, timeline: str = "sim_time") -> tuple[np.ndarray, list]:
    """Times [s] and values of a component, in the order of time."""
    times, values = [], []
    for chunk in RrdReader(path).stream():
        batch = chunk.to_record_batch()
        if str(chunk.entity_path) == entity and {component, timeline} <= set(batch.schema.names):
            times.append(batch[timeline].cast(pa.int64()).to_numpy())
            values += batch[component].to_pylist()
    order = np.argsort(np.concatenate(times), kind="stable")
    return 1e-9 * np.concatenate(times)[order], [values[i] for i in order]


def static(path: Path, entity: str, component: str) -> Any:
    """A component that does not change."""
    (found,) = (
        batch[component][0].as_py()
        for chunk in RrdReader(path).stream()
        if str(chunk.entity_path) == entity
        and chunk.is_static
        and component in (batch := chunk.to_record_batch()).schema.names
    )
    return found


def shown(history: History, signal: str) -> np.ndarray:
    """A motion or the wave in m or degrees."""
    if signal == "wave_elevation":
        return history.wave_elevation
    dof = DOF_NAMES.index(signal)
    return history.displacement[:, dof] * (1.0 if dof < 3 else 180.0 / np.pi)


def test_the_file_is_whole(compared: Path) -> None:
    assert subprocess.run([RERUN, "rrd", "verify", compared], check=False).returncode == 0
    assert list(compared.parent.iterdir()) == [compared]
    assert len(RrdReader(compared).blueprints()) == 1
    assert RrdReader(compared).recordings()[0].application_id == "panelsim-comparison"


@pytest.mark.parametrize("signal", [*DOF_NAMES, "wave_elevation"])
def test_every_run_is_there_at_every_step(signal: str, runs: dict[str, History], compared: Path) -> None:
    colors = set()
    for name, history in runs.items():
        entity = f"/motions/{signal}/" + name.replace(" ", "\\ ")
        times, values = read(compared, entity, "Scalars:scalars")
        np.testing.assert_allclose(times, history.time, atol=1e-9)  # rerun counts nanoseconds
        np.testing.assert_allclose(np.concatenate(values), shown(history, signal), rtol=1e-14)
        unit = "deg" if signal in DOF_NAMES[3:] else "m"
        assert static(compared, entity, "SeriesLines:names") == [f"{name} [{unit}]"]
        colors.add(tuple(static(compared, entity, "SeriesLines:colors")))
    assert len(colors) == 3


def test_differences_are_from_the_first_run_where_times_agree(
    runs: dict[str, History], compared: Path
) -> None:
    times, values = read(compared, "/differences/pitch/new\\ fins", "Scalars:scalars")
    first, other = runs["base"], runs["new fins"]
    np.testing.assert_allclose(times, other.time, atol=1e-9)
    expected = shown(other, "pitch") - shown(first, "pitch")[: len(other.time)]
    np.testing.assert_allclose(np.concatenate(values), expected, rtol=1e-14)
    entities = {str(entity) for entity in RrdReader(compared).store().schema().entity_paths()}
    assert not {entity for entity in entities if entity.startswith("/differences") and "fins" not in entity}
    about = static(compared, "/about", "TextDocument:text")[0]
    assert "not of coarse, whose times are others" in about
    assert "| new fins | barge | nonlinear | 5 | 0.25 | 7 | capsized |" in about


def test_the_ships_follow_each_other_at_the_same_moments(runs: dict[str, History], compared: Path) -> None:
    rows, (start, stop) = choose_frames(runs["base"], 100)
    moments = runs["base"].time[rows]
    for order, (name, history) in enumerate(runs.items()):
        world = "/world/" + name.replace(" ", "\\ ")
        (place,) = static(compared, world, "Transform3D:translation")
        assert place == pytest.approx([(1 - order) * SPACING * LENGTH, 0.0, 0.0])
        times, places = read(compared, f"{world}/ship", "Transform3D:translation")
        seas, points = read(compared, f"{world}/sea", "Mesh3D:vertex_positions")
        np.testing.assert_array_equal(times, seas)
        # The nearest step to each moment, as far as the run goes.
        for moment in moments[moments <= history.time[-1]]:
            assert np.abs(times - moment).min() <= 0.5 * history.attrs["time_step"] + 1e-9
        assert len(times) == len(np.unique(times))
        assert times[-1] == pytest.approx(history.time[-1], abs=1e-9)  # how a run ended is always seen
        for time, where in zip(times, places, strict=True):
            row = int(np.argmin(np.abs(history.time - time)))
            np.testing.assert_allclose(where[0], history.displacement[row, :3], atol=5e-7)  # float32
        assert np.ptp(np.array(points[0])[:, 0]) == pytest.approx(2 * REACH * LENGTH, rel=1e-6)
        film, _ = read(compared, f"/motions/heave/{world[7:]}", "Scalars:scalars", "film")
        assert start - 1e-9 <= film[0]
        assert film[-1] <= stop + 1e-9


def test_statistics_stand_side_by_side(runs: dict[str, History]) -> None:
    text = compared_markdown({name: statistics(history) for name, history in runs.items()})
    first, other = (statistics(runs[name]).motions["heave"] for name in ("base", "new fins"))
    assert first.rms is not None
    assert other.rms is not None
    assert "|  | unit | base | new fins | coarse |" in text
    row = next(line for line in text.splitlines() if line.startswith("| heave | m |"))
    percent = 100.0 * (other.rms / first.rms - 1.0)
    assert percent > 40.0
    assert f"| {first.rms:.3f} | {other.rms:.3f} ({percent:+.1f} %) |" in row
    assert f"| roll | deg | {np.rad2deg(statistics(runs['base']).motions['roll'].rms):.3f} |" in text
    assert [line for line in text.splitlines() if line.startswith("##")] == [
        *("## RMS", "## mean", "## largest", "## smallest")
    ]


def test_the_id_is_that_of_the_runs_and_their_names(runs: dict[str, History], tmp_path: Path) -> None:
    base, other = runs["base"], runs["new fins"]
    made = [{"a": base, "b": other}, {"a": base, "b": other}]
    made += [{"a": base, "c": other}, {"b": other, "a": base}]
    ids = [RrdReader(compare_recordings(m, tmp_path / "x.rrd")).recordings()[0].recording_id for m in made]
    assert ids[0] == ids[1]
    assert len(set(ids)) == 3


def test_many_runs_and_runs_cut_short_have_curves(make_history: MakeHistory, tmp_path: Path) -> None:
    displacement = make_history().displacement.copy()
    displacement[100:] = np.nan
    histories = [
        make_history(displacement=displacement, outcome="diverged"),
        make_history(duration=0.0, outcome="interrupted"),
        *[make_history()] * (MOST_SHIPS - 1),
    ]
    path = compare_recordings({f"run {i}": run for i, run in enumerate(histories)}, tmp_path / "x.rrd")
    assert "at most" in static(path, "/about", "TextDocument:text")[0]
    entities = {str(entity) for entity in RrdReader(path).store().schema().entity_paths()}
    assert not {entity for entity in entities if entity.startswith("/world")}
    few = compare_recordings({"diverged": histories[0], "at once": histories[1]}, tmp_path / "few.rrd")
    for file in (path, few):
        assert subprocess.run([RERUN, "rrd", "verify", file], check=False).returncode == 0
    nowhere = make_history(displacement=np.full_like(displacement, np.nan), outcome="diverged")
    compare_recordings({"nowhere": nowhere, "base": make_history()}, tmp_path / "nowhere.rrd")


def test_a_single_run_is_refused(runs: dict[str, History], tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="1 runs"):
        compare_recordings({"base": runs["base"]}, tmp_path / "x.rrd")


# --- the command ---


@pytest.fixture
def folders(runs: dict[str, History], tmp_path: Path) -> list[Path]:
    """Run folders, of which two have the same name."""
    folders = [tmp_path / name for name in ("a/run", "b/run", "coarse")]
    for folder, history in zip(folders, runs.values(), strict=True):
        history.save(folder / "history.nc")
    return folders


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[list[Path]]:
    """What the viewer was opened with; it ends with 5."""
    opened: list[list[Path]] = []

    def open_viewer(recordings: list[Path]) -> int:
        assert all(path.stat().st_size > 1000 for path in recordings)
        opened.append(list(recordings))
        return 5

    monkeypatch.setattr("panelsim.view.viewer.open_viewer", open_viewer)
    return opened


def test_view_compares_folders_and_histories(
    panelsim: Panelsim, folders: list[Path], opened: list[list[Path]], tmp_path: Path
) -> None:
    code, out, _ = panelsim("view", *folders[:2], folders[2] / "history.nc", "--save", "new/all.rrd")
    assert (code, out.strip()) == (0, "Wrote new/all.rrd")
    assert opened == []
    saved = tmp_path / "new" / "all.rrd"
    entities = {str(path) for path in RrdReader(saved).store().schema().entity_paths()}
    assert {"/motions/heave/a\\/run", "/motions/heave/b\\/run", "/motions/heave/coarse"} <= entities
    assert panelsim("view", *folders)[0] == 5  # the viewer's own exit code
    ((recording,),) = opened
    assert not recording.parent.exists()  # made for this look alone


def test_view_opens_the_recording_of_one_run(
    panelsim: Panelsim, folders: list[Path], opened: list[list[Path]], compared: Path
) -> None:
    code, _, err = panelsim("view", folders[0])
    assert code == 2
    assert "has no recording" in err
    recording = folders[0] / "run.rrd"
    recording.write_bytes(compared.read_bytes())
    assert panelsim("view", folders[0])[0] == 5
    assert panelsim("view", folders[0] / "history.nc")[0] == 5
    assert opened == [[recording], [recording]]


def test_what_view_cannot_open_is_refused(
    panelsim: Panelsim, folders: list[Path], opened: list[list[Path]], compared: Path, tmp_path: Path
) -> None:
    first, second, third = folders
    history = (second / "history.nc").read_bytes()
    (tmp_path / "empty").mkdir()
    (tmp_path / "cut").mkdir()
    (tmp_path / "cut" / "history.nc").write_bytes(history[: len(history) // 2])
    (tmp_path / "case.toml").write_text("[run]\n")
    (tmp_path / "old.rrd").write_bytes(b"old")
    for name, found in (("older", 0), ("another", None)):
        (tmp_path / f"{name}.nc").write_bytes(history)
        with h5py.File(tmp_path / f"{name}.nc", "r+") as file:
            del file.attrs["history_format"]
            if found is not None:
                file.attrs["history_format"] = found
    for arguments, message in {
        (first, tmp_path / "nowhere"): "no such run",
        (first, tmp_path / "empty"): "no run in the folder",
        (first, tmp_path / "case.toml"): "no such run",
        (first, tmp_path / "cut"): "damaged",
        (first, tmp_path / "older.nc"): "another format",
        (first, tmp_path / "another.nc"): "no panelsim history",
        (first, compared): "do not open together",
        (first, second, first / "history.nc"): "given twice",
        (first, "--save", "one.rrd"): "nothing to save",
        (compared, "--save", "one.rrd"): "nothing to save",
        (first, second, "--save", "all.txt"): ".rrd",
        (first, second, "--save", "old.rrd"): "exists already",
        (tmp_path / "nowhere.rrd",): "no such recording",
    }.items():
        code, out, err = panelsim("view", *arguments)
        assert (code, out) == (2, ""), arguments
        assert message in err, arguments
    assert opened == []
    assert (tmp_path / "old.rrd").read_bytes() == b"old"
    assert not list(tmp_path.glob("*.txt")) + list(tmp_path.glob("one*"))
    assert panelsim("view", first, third, "--save", "old.rrd", "--force")[0] == 0
    assert (tmp_path / "old.rrd").stat().st_size > 1000


def test_names_of_runs_are_told_apart(tmp_path: Path) -> None:
    def named(*files: str) -> list[str]:
        return run_names([tmp_path / file for file in files])

    assert named("a/history.nc", "b/history.nc") == ["a", "b"]
    assert named("x/a/history.nc", "y/a/history.nc", "b/history.nc") == ["x/a", "y/a", "b"]
    assert named("a/history.nc", "x/a/history.nc") == [f"{tmp_path.name}/a", "x/a"]
    assert named("a/history.nc", "a/short.nc", "a.nc") == ["a", "short.nc", "a.nc"]
    with pytest.raises(PanelsimError, match="given twice"):
        named("a/history.nc", "b/../a/history.nc")


@pytest.mark.viewer
@pytest.mark.slow
def test_the_viewer_shows_it_without_complaint(compared: Path, seen: Callable[..., Any]) -> None:
    picture, state = seen(compared, "film", 30.0)
    assert state.recordings[0].current_timeline == "film"
    assert [report for view in state.views for report in view.reports] == []
    assert len(state.views) == 3 + 2 * 7
    # Seas, hulls and curves: an empty window takes 10 kB.
    assert len(picture) > 50_000
