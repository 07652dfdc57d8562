"""A reproduction on disk: a tiny one is run, stopped, gone on with, made again from its runs."""

import json
import os
import shutil
import socket
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from distributed import KilledWorker

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents
from panelsim.studies.computing import compute_runs
from panelsim.studies.run_store import RunStore, StoredRun
from panelsim.studies.tm2003_190 import linear_nonlinear, reproduce
from panelsim.studies.tm2003_190.common import Scope, base_case
from panelsim.studies.tm2003_190.kernel_speed import KernelSpeed
from panelsim.studies.tm2003_190.linear_nonlinear import LinearNonlinear
from panelsim.studies.tm2003_190.load_parts import answer_to, load_parts, pressure_parts
from panelsim.studies.tm2003_190.model_causes import Pair, parts_path, stored_parts
from panelsim.studies.tm2003_190.page import anchor
from panelsim.studies.tm2003_190.reproduce import Reproduction
from panelsim.studies.tm2003_190.wave_frequencies import at_wave_frequencies

TINY = Scope((6.0,), 1, 1, 40.0)


def tiny(runs: Path) -> Reproduction:
    """Linear against nonlinear on coarse panels, twelve runs of 45 s."""
    base = base_case().changed({"ship.panel_area": 20.0, "run.ramp": 5.0, "run.time_step": 0.4})
    return Reproduction([LinearNonlinear(base, TINY)], TINY, "quick", runs)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Reproduction, Path]:
    """The tiny reproduction, run at one go, and its page."""
    folder = tmp_path_factory.mktemp("reproduction")
    study = tiny(folder / "runs")
    study.make_runs(workers=1)
    study.make_page(folder / "page")
    return study, folder / "page"


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave pictures and recordings out, which take most of the time of a page."""
    monkeypatch.setattr(linear_nonlinear, "rms_over_height", lambda study, heading, path: path)
    monkeypatch.setattr(reproduce, "record_study", lambda path, *_, **__: path)


def texts(folder: Path) -> dict[str, bytes]:
    """Every file of a page but recordings and the list of its files, without the line of times."""
    files = {str(path.relative_to(folder)): path for path in sorted(folder.rglob("*")) if path.is_file()}
    told = {name: path for name, path in files.items() if not name.endswith((".rrd", "files.json"))}
    found = {name: path.read_bytes() for name, path in told.items()}
    lines = found["README.md"].decode().splitlines()
    found["README.md"] = "\n".join(line for line in lines if not line.startswith("Time: ")).encode()
    return found


def test_the_page_links_to_what_is_there(made: tuple[Reproduction, Path]) -> None:
    _, folder = made
    text = (folder / "README.md").read_text()
    for name in (
        "pictures/models_limiting_150.png",
        "tables/models_moderate.csv",
        "recordings/linear-nonlinear.rrd",
    ):
        assert f"({name})" in text
        assert (folder / name).is_file()
    assert f"(#{anchor('Linear against nonlinear (8.3)')})" in text
    assert "## Linear against nonlinear (8.3)" in text
    assert "12 runs" in text
    # The statement on CPU time is no sentence of the report, nor has it a section of it.
    assert "one without is our own." in text
    assert "## Runs that failed" not in text


def test_the_page_is_made_again_from_its_runs_byte_for_byte(
    made: tuple[Reproduction, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study, folder = made
    monkeypatch.setattr(reproduce, "compute_runs", None)  # running would fail
    again = tiny(study.runs)
    again.require_complete()
    again.make_page(tmp_path / "page")
    assert texts(tmp_path / "page") == texts(folder)
    assert (tmp_path / "page/README.md").read_bytes() == (folder / "README.md").read_bytes()


def test_a_reproduction_that_was_stopped_goes_on_to_the_same_page(
    made: tuple[Reproduction, Path], undrawn: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = tiny(tmp_path / "runs")

    def stopped(cases: list[Case], store: RunStore, **_: object) -> None:
        compute_runs(cases[:3], store, workers=1)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(reproduce, "compute_runs", stopped)
        with pytest.raises(KeyboardInterrupt):
            study.make_runs(workers=1)
    with pytest.raises(PanelsimError, match="are missing in"):
        study.require_complete()
    first = json.loads((tmp_path / "runs/study.json").read_text())
    told: list[tuple[str, float, float]] = []
    study.make_runs(workers=1, progress=lambda *step: told.append(step))
    assert max(total for name, _, total in told if name == "linear-nonlinear") == 9
    assert (
        json.loads((tmp_path / "runs/study.json").read_text())["wall_seconds"] > first["wall_seconds"] > 0.0
    )
    study.make_page(tmp_path / "page")
    whole = {name: content for name, content in texts(made[1]).items() if not name.endswith(".png")}
    assert texts(tmp_path / "page") == whole


def test_a_run_that_failed_is_told_and_breaks_its_statement(
    made: tuple[Reproduction, Path], undrawn: None, tmp_path: Path
) -> None:
    study = tiny(tmp_path / "runs")
    failing = study.studies[0].cases[7]  # the nonlinear run from the bow in steep seas
    study.store.save_failure(failing, "The ship is a fish.\n  got: scales")
    for case in study.studies[0].cases:
        if case is not failing:
            study.store.save(case, made[0].store.path(case).read_bytes())
    (tmp_path / "runs/study.json").write_bytes((made[0].runs / "study.json").read_bytes())
    study.make_runs(workers=1)
    sections = study.make_page(tmp_path / "page")
    text = (tmp_path / "page/README.md").read_text()
    assert "The ship is a fish. got: scales" in text
    assert "1 run of this study failed" in text
    steep = sections[0].statements[1]
    assert not steep.holds
    assert "a run did not finish" in steep.figures


def test_a_run_that_was_lost_is_told_on_the_page_and_tried_again(
    made: tuple[Reproduction, Path], undrawn: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(made[0].runs, tmp_path / "runs")
    study = tiny(tmp_path / "runs")
    lost = study.studies[0].cases[7]
    study.store.path(lost).unlink()

    def exhausted(*_: object) -> None:
        raise MemoryError("none left")

    with monkeypatch.context() as patch:
        patch.setattr("panelsim.studies.groups.case_history", exhausted)
        study.make_runs(workers=1)
    study.make_page(tmp_path / "page")
    assert "MemoryError: none left" in (tmp_path / "page/README.md").read_text()
    assert study.missing == 1
    study.make_runs(workers=1)
    study.make_page(tmp_path / "page")
    assert "MemoryError" not in (tmp_path / "page/README.md").read_text()


def test_the_time_of_a_process_that_is_killed_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    study = tiny(tmp_path / "runs")
    noted: list[float] = []

    def watched(*_: object, progress: Callable[[float, float], None], **__: object) -> None:
        for done in (1, 2):
            progress(done, 12)
            noted.append(json.loads((tmp_path / "runs/study.json").read_text())["wall_seconds"])
        raise KeyboardInterrupt

    monkeypatch.setattr(reproduce, "compute_runs", watched)
    with pytest.raises(KeyboardInterrupt):
        study.make_runs(workers=1)
    assert 0.0 < noted[0] < noted[1]


def test_a_page_is_made_where_nothing_may_be_written_beside_it(
    made: tuple[Reproduction, Path], undrawn: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    beside = tmp_path / "mount"
    (beside / "page").mkdir(parents=True)
    make = os.mkdir

    def mkdir(path: str | Path, *given: object, **named: object) -> None:
        if Path(path).parent == beside:
            raise PermissionError(13, "Permission denied", str(path))
        make(path, *given, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(os, "mkdir", mkdir)
    made[0].make_page(beside / "page")
    assert [path.name for path in beside.iterdir()] == ["page"]


def test_an_older_page_is_replaced_and_other_files_stay(
    made: tuple[Reproduction, Path], undrawn: None, tmp_path: Path
) -> None:
    mine = ("pictures/photo.png", "tables/mine.csv", "recordings/mine.rrd", "notes.txt")
    for name in mine:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("mine")
    made[0].make_page(tmp_path)
    listed = json.loads((tmp_path / "files.json").read_text())
    assert "tables/models_moderate.csv" in listed["files"]
    (tmp_path / "pictures/of_old.png").write_text("old")
    listed["files"] += ["pictures/of_old.png", "notes.txt", "pictures/../notes.txt", 3]
    (tmp_path / "files.json").write_text(json.dumps(listed))
    made[0].make_page(tmp_path)
    assert not (tmp_path / "pictures/of_old.png").exists()
    assert (tmp_path / "tables/models_moderate.csv").is_file()
    assert all((tmp_path / name).read_text() == "mine" for name in mine)
    # A list of another's is none of ours.
    (tmp_path / "files.json").write_text(json.dumps({"study": "another", "files": ["pictures/photo.png"]}))
    made[0].make_page(tmp_path)
    assert (tmp_path / "pictures/photo.png").is_file()


@pytest.mark.parametrize(
    ("key", "value"), [("study", "tm1999-1"), ("extent", "full"), ("panelsim_version", "0.0.1")]
)
def test_runs_of_another_study_are_refused(
    key: str, value: str, made: tuple[Reproduction, Path], tmp_path: Path
) -> None:
    note = json.loads((made[0].runs / "study.json").read_text()) | {key: value}
    (tmp_path / "study.json").write_text(json.dumps(note))
    with pytest.raises(PanelsimError, match="another study or version") as refused:
        tiny(tmp_path).make_runs(workers=1)
    assert value in str(refused.value)


def test_a_folder_of_something_else_is_not_taken_for_runs(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(PanelsimError, match="holds something else"):
        tiny(tmp_path).make_runs(workers=1)


@pytest.mark.parametrize("damage", ["{", "[1]", '{"study": 1}', "words"])
def test_a_damaged_note_is_refused(tmp_path: Path, made: tuple[Reproduction, Path], damage: str) -> None:
    note = json.loads((made[0].runs / "study.json").read_text()) | {"wall_seconds": "an hour"}
    (tmp_path / "study.json").write_text(json.dumps(note) if damage == "words" else damage)
    with pytest.raises(PanelsimError, match="damaged"):
        tiny(tmp_path).make_runs(workers=1)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["tm2004-041"], ('got: "tm2004-041"', "allowed: tm2003-190")),
        (["tm2003-190", "--quick", "--from-runs"], ("are missing in", "leave --from-runs out")),
        (["tm2003-190", "--workers", "0"], ("workers",)),
        (["tm2003-190", "--scheduler", "nowhere"], ("nowhere",)),
    ],
)
def test_bad_arguments_are_refused(
    arguments: list[str],
    words: tuple[str, ...],
    panelsim: Callable[..., tuple[int, str, str]],
    tmp_path: Path,
) -> None:
    code, _, err = panelsim("reproduce", *arguments)
    assert code == 2
    for word in words:
        assert word in err
    assert not (tmp_path / "reports").exists()
    assert not (tmp_path / "runs").exists()


def test_a_folder_that_cannot_be_made_is_told_before_the_runs(
    panelsim: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("mine")
    code, _, err = panelsim("reproduce", "tm2003-190", "--quick", "--out", "file/x")
    assert code == 2 and "cannot be written" in err
    assert not (tmp_path / "runs").exists()


def test_a_scheduler_that_does_not_answer_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("panelsim.studies.cluster.CONNECT_SECONDS", 0.5)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))  # and does not listen
        address = f"tcp://127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(PanelsimError, match="No Dask scheduler answers"):
            tiny(tmp_path / "runs").make_runs(scheduler=address)
    assert not (tmp_path / "runs").exists()


@pytest.mark.parametrize(
    "content",
    ["", "{}", "[1]", '{"rms": [], "shares": [], "missed": []}', '{"rms": 0, "shares": "a", "missed": {}}'],
)
def test_damaged_parts_of_a_load_are_refused(
    made: tuple[Reproduction, Path], tmp_path: Path, content: str
) -> None:
    store = made[0].store
    path = next(store.folder.glob("*.load_parts.json"))
    pair = Pair("a sea", base_case(), base_case())
    beside = RunStore(tmp_path)
    parts_path(pair, beside).write_text(path.read_text())
    assert stored_parts([pair], beside)
    parts_path(pair, beside).write_text(content)
    with pytest.raises(PanelsimError, match="damaged"):
        stored_parts([pair], beside)


@pytest.mark.parametrize("content", ["", "[1]"])
def test_damaged_timings_of_the_kernel_are_refused(tmp_path: Path, content: str) -> None:
    study = KernelSpeed(base_case(), True)
    (tmp_path / "kernel_speed.json").write_text("{}")
    assert not study.is_measured(RunStore(tmp_path))
    (tmp_path / "kernel_speed.json").write_text(content)
    with pytest.raises(PanelsimError, match="damaged"):
        study.is_measured(RunStore(tmp_path))


@pytest.mark.parametrize("methods", [None, {}, "words", {"NumPy": 1.0}, {"NumPy": {}}])
def test_damaged_figures_of_the_kernel_are_refused(tmp_path: Path, methods: object) -> None:
    study = KernelSpeed(base_case(), True)
    told = {"panelsim_version": version("panelsim"), "rounds": study.rounds, "panels": 1, "components": 1}
    path = tmp_path / "kernel_speed.json"
    path.write_text(json.dumps(told | {"machine": "mine", "methods": methods}))
    with pytest.raises(PanelsimError, match="damaged"):
        study.section(RunStore(tmp_path), tmp_path)
    path.write_text(json.dumps(told | {"rounds": "many", "methods": methods}))
    assert not study.is_measured(RunStore(tmp_path))


def test_a_page_that_is_there_is_not_overwritten(
    panelsim: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    (tmp_path / "reports/tm2003-190").mkdir(parents=True)
    (tmp_path / "reports/tm2003-190/README.md").write_text("mine")
    code, _, err = panelsim("reproduce", "tm2003-190")
    assert code == 2
    assert "--force" in err
    assert not (tmp_path / "runs").exists()


def test_what_is_at_the_frequencies_of_the_waves() -> None:
    """Two waves, one met at 1.2 and one at 0.7 rad/s, a motion at both and one at their difference too."""
    waves = WaveComponents(np.array([1.0, 0.5]), np.array([0.7, 1.2]), np.full(2, np.pi / 2), np.zeros(2))
    time = np.arange(0.0, 660.0, 0.2)
    both = 0.3 * np.cos(0.7 * time + 0.4) + 0.2 * np.sin(1.2 * time)
    slow = 0.5 * np.cos(0.5 * time + 1.0)
    motions = np.stack([both, both + slow, slow, both + 2.0, both, both], axis=1)
    run = StoredRun(time, motions, both, {"ramp": 60.0, "time_step": 0.2, "outcome": "finished"})
    found = at_wave_frequencies(run, waves, 5.0, 9.80665)
    own = np.sqrt(0.5 * (0.3**2 + 0.2**2))
    # 600 s are 48 turns of the slow motion: what leaks from it is of the order of a hundredth.
    # 600 s are no whole number of turns of the waves: 0.5 / (0.7 × 600) of the variance.
    np.testing.assert_allclose(found[[0, 3]], own, rtol=3e-3)
    assert found[1] == pytest.approx(own, rel=0.02)
    assert found[2] < 0.02


def test_parts_of_the_load_explain_the_difference_of_the_models(made: tuple[Reproduction, Path]) -> None:
    """The answers to all parts are what the nonlinear run has beyond the linear one, in steep bow seas."""
    study = made[0].studies[0]
    assert isinstance(study, LinearNonlinear)
    plan = study.plans["limiting"]
    linear, nonlinear = plan.case(0, 1, 0), plan.case(1, 1, 0)
    assert nonlinear.file.seaway.wave_heading_deg == 150.0
    found = load_parts(nonlinear, linear, made[0].store)
    # The memory of the run's first seconds and the step of 0.4 s are what is missed.
    assert np.all(found.missed < 0.25), found.missed
    # Covariances of the parts add up to that of their sum, 1 less what is missed.
    np.testing.assert_allclose(found.shares.sum(axis=0), 1.0, atol=0.3)
    # No covariance is more than the product of the standard deviations.
    assert np.all(np.abs(found.shares) <= found.rms + 1e-9)
    runs = [made[0].store.load(case) for case in (linear, nonlinear)]
    apart = (runs[1].displacement - runs[0].displacement)[runs[1].after_ramp].std(axis=0)
    waves = answer_to(nonlinear, runs[1].time, pressure_parts(nonlinear, runs[1])[0])
    np.testing.assert_allclose(found.rms[0], waves[runs[1].after_ramp].std(axis=0) / apart, rtol=1e-9)


def test_a_process_that_is_lost_leaves_its_section_to_this_one(
    made: tuple[Reproduction, Path], undrawn: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = made[0]
    one = study.studies[0]
    assert isinstance(one, LinearNonlinear)

    def killed() -> None:
        raise KilledWorker("a section", None, 3)

    client = SimpleNamespace(submit=lambda *_, **__: SimpleNamespace(result=killed))
    monkeypatch.setattr(reproduce, "local_client", lambda processes: nullcontext(client))
    twice = replace(study, studies=[one, replace(one, key="again")])
    sections = twice.make_page(tmp_path / "page", workers=2)
    assert [section.key for section in sections] == [one.key, "again"]
    assert sections[0].body == sections[1].body and "Against linear" in sections[0].body
