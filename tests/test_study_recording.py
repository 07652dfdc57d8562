"""The recording of a study holds its RMS, its differences and the motions behind them, level by level."""

import json
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
import rerun_cli
from rerun.chunk import RrdReader

from panelsim.case import Case
from panelsim.conventions import DOF_NAMES
from panelsim.errors import PanelsimError
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.studies.computing import compute_runs
from panelsim.studies.rms_of_runs import rms_of_runs
from panelsim.studies.run_store import RunStore
from panelsim.view import study_recording
from panelsim.view.study_histories import FINEST, PARTS, SIGNALS, WINDOW, rows_shown, shown_window
from panelsim.view.study_recording import record_study

RERUN = Path(rerun_cli.__file__).parent / "rerun"
UNITS = np.array([1.0, 1.0, 1.0, 180.0 / np.pi, 180.0 / np.pi, 180.0 / np.pi])
EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"


@pytest.fixture(autouse=True)
def strict(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without it rerun drops bad data with a warning."""
    monkeypatch.setenv("RERUN_STRICT", "1")


def made_study(realizations: int = 1, *, failed: bool = False) -> RmsStudy:
    """Three levels in two seas from 30° and three from 150°; every RMS is another number, sway is minor."""
    seas = [StudySea(f"H_s {h} m, 30°", 30.0, float(h), 8.0) for h in (1, 2)]
    seas += [StudySea(f"H_s {h} m, 150°", 150.0, float(h), 8.0) for h in (1, 2, 3)]
    rms = np.random.default_rng(5).uniform(1.0, 2.0, (3, 5, realizations, 6))
    rms[..., 1] *= 0.01
    rms[..., 3:] *= 0.05
    if failed:
        rms[0, 3] = np.nan
    values = np.array([0.5, 0.2, 0.1])
    told = ("0.5 s, H_s 2 m, 150°, realization 1: diverged",) if failed else ()
    return RmsStudy("RK4", "time step [s]", ("0.5 s", "0.2 s", "0.1 s"), values, 2, tuple(seas), rms, told)


def made_run(step: float, phase: float = 0.0, length: float = 900.0) -> SimpleNamespace:
    """Motions with a period of 10 s, whose deck slopes most at 400 s."""
    time = step * np.arange(round(length / step) + 1)
    grown = 1.0 + np.exp(-(((time - 400.0) / 50.0) ** 2))
    wave = np.sin(0.2 * np.pi * time + phase) * grown
    displacement = wave[:, None] * np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
    return SimpleNamespace(time=time, displacement=displacement, wave_elevation=4.0 * wave)


def chunks(path: Path, entity: str, *, static: bool = False) -> Any:
    """The one batch of an entity."""
    (found,) = (
        chunk.to_record_batch()
        for chunk in RrdReader(path).stream()
        if str(chunk.entity_path) == f"/{entity}" and chunk.is_static == static
    )
    return found


def lines(path: Path, entity: str) -> tuple[list[int], np.ndarray]:
    """Levels, and values with a row a level."""
    batch = chunks(path, entity)
    return batch["level"].to_pylist(), np.array(batch["Scalars:scalars"].to_pylist(), dtype=float)


def text(path: Path, entity: str) -> str:
    return chunks(path, entity, static=True)["TextDocument:text"][0].as_py()[0]


def record(path: Path, *studies: RmsStudy, **given: Any) -> Path:
    told: dict[str, Any] = {"title": "Time step", "text": "It **holds**.", "series": {}}
    return record_study(path, studies or [made_study()], **(told | given))


def verified(path: Path) -> bool:
    done = subprocess.run([RERUN, "rrd", "verify", path], capture_output=True, check=False)
    return done.returncode == 0 and len(RrdReader(path).blueprints()) == 1


@pytest.mark.parametrize("realizations", [1, 4])
def test_lines_are_the_numbers_of_the_study(realizations: int, tmp_path: Path) -> None:
    first, second = made_study(realizations), replace(made_study(), title="Exponential", reference=1)
    path = record(tmp_path / "new folder" / "study.rrd", first, second)
    assert verified(path)
    assert list(path.parent.iterdir()) == [path]
    for number, study in enumerate((first, second), 1):
        for heading, seas in ((30, slice(0, 2)), (150, slice(2, 5))):
            for dof, motion in enumerate(DOF_NAMES):
                levels, rms = lines(path, f"study_{number}/rms/{heading}_deg/{motion}")
                assert levels == [1, 2, 3]
                np.testing.assert_allclose(rms, UNITS[dof] * study.pooled[:, seas, dof], rtol=1e-14)
                _, difference = lines(path, f"study_{number}/difference/{heading}_deg/{motion}")
                np.testing.assert_array_equal(difference, 100.0 * study.difference[:, seas, dof])
    # Of the reference itself the differences are nothing, of a minor motion they are not told.
    assert (lines(path, "study_2/difference/30_deg/roll")[1][1] == 0.0).all()
    assert np.isnan(lines(path, "study_2/difference/30_deg/sway")[1]).all()


def test_each_line_says_its_sea_and_each_level_its_name(tmp_path: Path) -> None:
    study = made_study()
    path = record(tmp_path / "study.rrd", study)
    style = chunks(path, "study_1/rms/150_deg/heave", static=True)
    assert style["SeriesLines:names"][0].as_py() == ["H_s 1 m", "H_s 2 m", "H_s 3 m"]
    assert style["SeriesPoints:names"] == style["SeriesLines:names"]
    assert len(set(style["SeriesLines:colors"][0].as_py())) == 3
    pages = [page.as_py()[0] for page in chunks(path, "levels")["TextDocument:text"]]
    for number, (page, level) in enumerate(zip(pages, study.levels, strict=True), 1):
        assert f"## Level {number}" in page
        assert "time step [s]" in page
        assert f"#{number}: **{level}" in page
        assert page.count("**") == 2
        assert "0.1 s (reference)" in page
    told = replace(study, levels=("0.5 s", "0.2 s", "the reference, 0.1 s"))
    page = chunks(record(tmp_path / "told.rrd", told), "levels")["TextDocument:text"][0].as_py()[0]
    assert page.count("reference") == 1
    # Heights that do not tell the seas apart give way to the whole labels.
    alike = tuple(replace(sea, significant_wave_height=2.0) for sea in study.seas)
    path = record(tmp_path / "alike.rrd", replace(study, seas=alike))
    names = chunks(path, "study_1/rms/30_deg/heave", static=True)["SeriesLines:names"][0].as_py()
    assert names == ["H_s 1 m, 30°", "H_s 2 m, 30°"]


def test_views_say_their_units(tmp_path: Path) -> None:
    path = record(tmp_path / "study.rrd", series={"a": made_run(0.5)})
    names = {
        batch["ViewBlueprint:display_name"][0].as_py()[0]
        for chunk in RrdReader(path).stream(store=RrdReader(path).blueprints()[0])
        if "ViewBlueprint:display_name" in (batch := chunk.to_record_batch()).schema.names
    }
    assert {
        "heave, RMS [m]",
        "roll, RMS [deg]",
        "yaw, difference [%]",
        "sway, difference [%]: minor",
    } <= names
    assert {"pitch [deg]", "wave elevation [m]"} <= names


def test_tables_and_texts_are_there(tmp_path: Path) -> None:
    path = record(tmp_path / "study.rrd", made_study(failed=True))
    assert "It **holds**." in text(path, "about")
    assert "realization 1: diverged" in text(path, "about")
    assert "| 0.5 s | 150 |" in text(path, "tables/differences")
    assert "H_s 3 m, 150°" in text(path, "tables/rms")


def test_a_run_that_failed_leaves_a_gap(tmp_path: Path) -> None:
    path = record(tmp_path / "study.rrd", made_study(3, failed=True))
    assert verified(path)
    _, rms = lines(path, "study_1/rms/150_deg/pitch")
    np.testing.assert_array_equal(np.isnan(rms), [[False, True, False], [False] * 3, [False] * 3])
    study = made_study()
    assert verified(record(path, replace(study, rms=np.full_like(study.rms, np.nan))))


# --- the motions behind it ---


def test_motions_stand_behind_it(tmp_path: Path) -> None:
    series = {"0.5 s": made_run(0.5), "0.1 s": made_run(0.1, 0.1)}
    path = record(tmp_path / "study.rrd", series=series)
    window = shown_window(series)
    assert window[0] == pytest.approx(400.0 - WINDOW / 2, abs=5.0)  # a period is 10 s
    for name, run in series.items():
        for dof, signal in enumerate(SIGNALS):
            factor = UNITS[dof] if dof < 6 else 1.0
            values = run.displacement[:, dof] if dof < 6 else run.wave_elevation
            entity = f"histories/{signal}/" + name.replace(" ", "\\ ")
            batch, style = chunks(path, entity), chunks(path, entity, static=True)
            unit = "deg" if 3 <= dof < 6 else "m"
            assert style["SeriesLines:names"][0].as_py() == [f"{name} [{unit}]"]
            rows = rows_shown(run.time, values, window)
            seconds = 1e-9 * batch["sim_time"].cast(pa.int64()).to_numpy()
            np.testing.assert_allclose(seconds, run.time[rows], atol=1e-9)  # rerun counts nanoseconds
            shown = batch["Scalars:scalars"].flatten().to_numpy()
            np.testing.assert_allclose(shown, factor * values[rows], rtol=1e-14)


def test_a_long_run_is_thinned_to_steps_in_the_window_and_its_envelope() -> None:
    run = made_run(0.05, length=1800.0)
    values = run.displacement[:, 2].copy()
    values[[20_000, 30_001]] = 11.0, -12.0  # 1000 s and 1500 s
    values[35_000:] = np.nan
    rows = rows_shown(run.time, values, (340.0, 460.0))
    assert (np.diff(rows) > 0).all()
    assert {20_000, 30_001} <= set(rows)
    inside = rows[(run.time[rows] >= 340.0 - 1e-9) & (run.time[rows] <= 460.0 + 1e-9)]
    np.testing.assert_allclose(np.diff(run.time[inside]), FINEST)
    assert len(inside) == 601
    assert len(rows) - len(inside) <= 2 * PARTS
    assert rows[-1] < 35_000
    short = made_run(0.5, length=100.0)
    np.testing.assert_array_equal(rows_shown(short.time, short.wave_elevation, (0.0, 100.0)), np.arange(201))


def test_a_run_without_a_number_can_stand_behind_it(tmp_path: Path) -> None:
    run = made_run(0.5)
    run.displacement[:] = np.nan
    assert verified(record(tmp_path / "study.rrd", series={"diverged": run, "b": made_run(0.2)}))


def test_a_study_takes_a_megabyte_at_most(tmp_path: Path) -> None:
    """Twenty seas, four levels, four runs of half an hour: some 400 kB of plots, the rest are curves."""
    study = made_study()
    seas = tuple(StudySea(f"{h} {b}", b, float(h)) for b in (30.0, 150.0) for h in range(10))
    rms = np.random.default_rng(5).uniform(1.0, 2.0, (4, 20, 1, 6))
    study = replace(study, levels=("a", "b", "c", "d"), values=np.arange(4.0), seas=seas, rms=rms)
    series = {f"{step} s": made_run(step, length=1860.0) for step in (0.5, 0.2, 0.1, 0.05)}
    assert record(tmp_path / "study.rrd", study, series=series).stat().st_size < 1.3e6


# --- files, ids, bad input ---


def test_the_id_is_that_of_the_content(tmp_path: Path) -> None:
    series = {"a": made_run(0.5)}
    study = made_study()
    ids = []
    for given in (
        {"series": series},
        {"series": series},
        {},
        {"title": "Mesh"},
        {"text": "It does not hold."},
        {"series": {"b": made_run(0.5)}},
        {"series": {"a": made_run(0.5, 0.1)}},
        {"study": replace(study, rms=1.01 * study.rms)},
        {"study": replace(study, reference=0)},
        {"study": replace(study, seas=study.seas[::-1])},
    ):
        told = dict(given)
        store = RrdReader(record(tmp_path / "x.rrd", told.pop("study", study), **told)).recordings()[0]
        assert store.application_id == "panelsim-convergence"
        ids.append(store.recording_id)
    assert ids[0] == ids[1]
    assert len(set(ids)) == len(ids) - 1


def test_a_file_is_replaced_only_by_a_whole_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "study.rrd"
    path.write_bytes(b"old")

    def fail(*_: object) -> None:
        raise MemoryError("no room")

    with monkeypatch.context() as patch:
        patch.setattr(study_recording, "send_histories", fail)
        with pytest.raises(MemoryError):
            record(path, series={"a": made_run(0.5)})
    assert [file.read_bytes() for file in tmp_path.iterdir()] == [b"old"]


def test_nothing_to_compare_is_refused(tmp_path: Path) -> None:
    study = made_study()
    one = replace(study, levels=("0.5 s",), values=study.values[:1], reference=0, rms=study.rms[:1])
    with pytest.raises(PanelsimError, match=r'"RK4" has nothing to compare(.|\n)*got: 0\.5 s'):
        record(tmp_path / "study.rrd", study, one)
    with pytest.raises(PanelsimError, match="no study"):
        record_study(tmp_path / "study.rrd", [], title="", text="", series={})
    assert list(tmp_path.iterdir()) == []


# --- real runs, and what is seen of them ---


def test_real_runs_are_recorded(tmp_path: Path) -> None:
    base = Case.load(EXAMPLE, ["ship.panel_area=10.0", "run.duration=60", "run.ramp=20"])
    steps = (0.8, 0.4)
    cases = [base.changed({"run.time_step": step}) for step in steps]
    store = RunStore(tmp_path / "runs")
    compute_runs(cases, store)
    study = rms_of_runs(
        store,
        lambda level, sea, realization: cases[level],
        title="Time step",
        varied="time step [s]",
        levels=[f"{step} s" for step in steps],
        values=np.array(steps),
        reference=1,
        seas=[StudySea("sea state 7", 150.0)],
    )
    series = {f"{step} s": store.load(case) for step, case in zip(steps, cases, strict=True)}
    path = record(tmp_path / "study.rrd", study, series=series)
    assert verified(path)
    _, heave = lines(path, "study_1/rms/150_deg/heave")
    np.testing.assert_array_equal(heave[:, 0], study.pooled[:, 0, 2])
    assert 0.5 < heave[1, 0] < 3.0  # m, in a sea of 7.5 m
    style = chunks(path, "study_1/rms/150_deg/heave", static=True)
    assert style["SeriesLines:names"][0].as_py() == ["sea state 7"]
    assert json.loads(series["0.8 s"].attrs["case"])["run"]["time_step"] == 0.8


@pytest.mark.viewer
@pytest.mark.slow
@pytest.mark.parametrize(("timeline", "at"), [(None, 0.0), ("sim_time", 400.0)])
def test_the_viewer_shows_it_without_complaint(
    timeline: str | None, at: float, tmp_path: Path, seen: Callable[..., Any]
) -> None:
    path = record(tmp_path / "study.rrd", made_study(failed=True), series={"a": made_run(0.5)})
    picture, state = seen(path, timeline, at)
    assert state.recordings[0].current_timeline == (timeline or "level")
    assert [report for view in state.views for report in view.reports] == []
    assert len({view.name for view in state.views}) == 12 + 7 + 5
    # Lines and texts, where an empty window takes 10 kB.
    assert len(picture) > 30_000
