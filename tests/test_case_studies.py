"""Convergence, both models and cost of a case: which runs they make, and the pages that they leave."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.case.schema import CaseFile
from panelsim.errors import PanelsimError
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.studies import convergence_page, linear_nonlinear_page
from panelsim.studies.case_cost import case_cost
from panelsim.studies.case_history import case_history
from panelsim.studies.convergence import mesh_convergence, recommended, time_step_convergence
from panelsim.studies.cost import CostRow, cost_rows, growth, measure_costs
from panelsim.studies.linear_nonlinear import LinearNonlinear, frequency_domain, require_linear_model
from panelsim.studies.run_store import RunStore
from panelsim.studies.study_page import refuse_other_folder
from panelsim.studies.study_sea import study_sea
from panelsim.studies.timing_store import Timing, TimingStore

Called = Callable[..., tuple[int, str, str]]

CASE = """
[ship]
hull = "halifax"
panel_area = 40

[seaway]
kind = "random"
significant_wave_height = 5
peak_period = 11
frequencies = { start = 0.3, stop = 1.5, step = 0.1 }
wave_heading_deg = 150
minimum_energy = 0.5
seed = 4

[run]
speed_knots = 15
time_step = 0.4
duration = 60
ramp = 10
"""


def case_of(**changes: object) -> Case:
    described = {
        "ship": {"hull": "halifax", "panel_area": 40.0},
        "seaway": {
            "kind": "random",
            "significant_wave_height": 5.0,
            "peak_period": 11.0,
            "frequencies": {"start": 0.3, "stop": 1.5, "step": 0.1},
            "wave_heading_deg": 150.0,
            "minimum_energy": 0.5,
            "seed": 4,
        },
        "run": {"speed_knots": 15.0, "time_step": 0.4, "duration": 60.0, "ramp": 10.0},
    }
    return Case(CaseFile.model_validate(described), Path(), "short").changed(changes)


@pytest.fixture
def recorded(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, object]]:
    """What is recorded, in place of a recording: those have tests of their own."""
    calls: list[dict[str, object]] = []

    def keep(path: Path, studies: object, **given: object) -> Path:
        path.write_bytes(b"")
        calls.append({"studies": studies, **given})
        return path

    for page in (convergence_page, linear_nonlinear_page):
        monkeypatch.setattr(page, "record_study", keep)
    return calls


def test_time_steps_are_about_the_own_one_with_a_finer_reference() -> None:
    study = time_step_convergence(case_of())
    assert study.values == (0.8, 0.4, 0.2)
    assert study.reference == 0.1
    assert study.schemes == ("exponential",)
    assert sorted(case.file.run.time_step for case in study.cases) == [0.1, 0.2, 0.4, 0.8]


def test_every_run_of_a_study_meets_the_same_waves() -> None:
    study = time_step_convergence(case_of(), [0.2, 0.4], ["exponential", "ab3"], seeds=3)
    assert len(study.cases) == 3 * (1 + 2 * 2)
    for index in range(3):
        phases = {
            study.case_of(scheme, level, index).seaway.components.phase.tobytes()
            for scheme in study.schemes
            for level in range(3)
        }
        assert len(phases) == 1
    assert study.case_of("ab3", 0, 2).file.seaway.seed == 6
    assert study.case_of("ab3", 0, 2).file.run.stepper == "ab3"
    # the reference is one run for all
    assert study.case_of("ab3", 2, 1) is study.case_of("exponential", 2, 1)


def test_panels_are_about_the_own_ones_with_a_finer_reference() -> None:
    fine = case_of(**{"ship.panel_area": 16.0})
    study = mesh_convergence(fine, rules=["vertex+centre", "panel"])
    assert study.values == (64.0, 32.0, 16.0, 8.0)
    assert study.reference == 4.0
    # Of the default areas 80 and 160 m² are too large for the hull.
    assert mesh_convergence(case_of()).values == (40.0, 20.0)
    assert study.case_of("panel", 0, 0).file.run.pressure_rule == "panel"
    assert study.case_of("panel", 4, 0).file.run.pressure_rule == "vertex+centre"


@pytest.mark.parametrize(("named", "alone"), [("panel", 3.0), ("vertex+centre", 3.0)])
def test_a_linear_case_has_panels_but_no_rule(named: str, alone: float) -> None:
    linear = case_of(**{"run.model": "linear"})
    assert len(mesh_convergence(linear, [alone]).cases) == 2
    with pytest.raises(PanelsimError, match="no pressure rule") as refused:
        mesh_convergence(linear, [alone], [named])
    assert named in str(refused.value)


@pytest.mark.parametrize(
    ("factors", "coarsest"),
    [
        ([1.2, 1.009, 0.995, 1.0], 0.4),
        ([1.005, 1.02, 0.995, 1.0], 0.2),  # a coarse one that is near by chance does not count
        ([0.98, 0.98, 0.98, 1.0], None),
        ([1.001, np.nan, 1.0, 1.0], 0.2),
    ],
)
def test_the_coarsest_value_within_a_per_cent_is_recommended(
    factors: list[float], coarsest: float | None
) -> None:
    rms = np.array(factors)[:, None, None, None] * np.ones((1, 1, 6))
    steps = np.array([0.8, 0.4, 0.2, 0.1])
    study = RmsStudy("t", "step [s]", ("a", "b", "c", "r"), steps, 3, (StudySea("s", 0.0),), rms)
    assert recommended(study) == coarsest


@pytest.mark.parametrize(
    ("changes", "label", "height"),
    [
        ({}, "H_s 5 m, 150°", 5.0),
        (
            {
                "seaway.kind": "regular",
                "seaway.wave_height": 3.0,
                "seaway.wave_frequency": 0.6,
                "seaway.significant_wave_height": None,
                "seaway.peak_period": None,
                "seaway.frequencies": None,
            },
            "height 3 m, 0.6 rad/s, 150°",
            None,
        ),
    ],
)
def test_a_sea_in_short(changes: dict[str, object], label: str, height: float | None) -> None:
    sea = study_sea(case_of(**changes))
    assert sea.label == label
    assert sea.wave_heading_deg == 150.0
    assert sea.significant_wave_height == (None if height is None else pytest.approx(height, rel=1e-9))


def test_models_have_the_inertia_that_belongs_to_them() -> None:
    for given, of_models in (
        ({}, (None, None)),
        ({"run.inertia": "large"}, (None, "large")),
        ({"run.inertia": "linear"}, ("linear", "linear")),
    ):
        linear, nonlinear = LinearNonlinear(case_of(**given), 1).models
        assert (linear.file.run.inertia, nonlinear.file.run.inertia) == of_models
        assert (linear.file.run.model, nonlinear.file.run.model) == ("linear", "nonlinear")


def test_a_long_linear_run_is_the_sum_of_its_components(tmp_path: Path) -> None:
    """Head seas, in which nothing but heave, pitch and surge moves and no roll is left to die out."""
    from panelsim.studies.computing import compute_runs

    case = case_of(**{"seaway.wave_heading_deg": 180.0, "run.duration": 2000.0, "run.ramp": 100.0})
    study = LinearNonlinear(case, 2)
    database = require_linear_model(case)
    store = RunStore(tmp_path)
    linear = [study.case_of(0, index) for index in range(2)]
    compute_runs(linear, store, workers=1)
    run = np.sqrt(np.mean([store.load(one).rms ** 2 for one in linear], axis=0))
    found = frequency_domain(study, database)
    # 0.3 % is what the fit of the memory leaves (reports/frequency_domain.md), besides the sampling error
    off = np.abs(run / found.components - 1.0)[[2, 4]]
    assert (off < 0.003 + 3.0 * found.sampling_error[[2, 4]]).all()
    assert found.sampling_error[2] < 0.01
    # Even frequencies have the same amplitudes in every realization: two scatter less by the root of two.
    alone = frequency_domain(LinearNonlinear(case, 1), database)
    np.testing.assert_allclose(alone.sampling_error, np.sqrt(2.0) * found.sampling_error, rtol=1e-9)
    # Thirteen components stand for the sea; most of its energy is among them.
    assert found.spectrum is not None
    assert found.components[2] == pytest.approx(found.spectrum[2], rel=0.1)


def test_growth_is_the_power_of_the_size() -> None:
    sizes = np.array([10.0, 20.0, 40.0])
    rows = [CostRow("r", "linear", 1, int(n), (0.5 * n**0.7,) * 3, 0.0) for n in sizes]
    found = growth(rows, list(sizes))
    assert found is not None
    assert found.exponent == pytest.approx(0.7, rel=1e-9)  # rounding
    assert found.standard_error < 1e-6
    assert growth(rows[:1], [10.0]) is None
    two = growth(rows[:2], [10.0, 20.0])
    assert two is not None and two.told == "0.70"
    failed = CostRow("f", "linear", 0, 0, (), np.nan, "why")
    assert growth([*rows, failed], [*sizes, 80.0]) == found


def test_a_row_has_the_median_of_its_rounds_and_their_spread() -> None:
    row = CostRow("r", "linear", 1, 1, (4.0, 1.0, 2.0), 0.0)
    assert (row.median, row.spread, row.told_spread) == (2.0, 1.5, "150 %")
    alone = CostRow("r", "linear", 1, 1, (4.0,), 0.0)
    assert (alone.median, alone.told_spread) == (4.0, "–")


def test_timings_are_kept_taken_up_again_and_cpu_over_simulated_time(tmp_path: Path) -> None:
    case = case_of()
    store = TimingStore(tmp_path)
    store.add(case, Timing(2.0, 0.5, 100.0, 13, 400))
    with pytest.raises(PanelsimError, match="1 of 2 rounds"):
        cost_rows({"it": case}, store, rounds=2)
    measure_costs([case], store, rounds=2)
    first, second = store.timings(case)
    assert first == Timing(2.0, 0.5, 100.0, 13, 400)
    assert (second.components, second.simulated_seconds) == (13, 70.0)
    assert 0.0 < second.cpu_seconds < 10.0
    (row,) = cost_rows({"it": case}, store, rounds=1)
    assert (row.label, row.cpu_per_second, row.compilation) == ("it", (0.02,), 0.5)
    before = store.path(case).read_bytes()
    measure_costs([case], store, rounds=2)
    assert store.path(case).read_bytes() == before


def test_rounds_are_in_turn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What else the machine does in a while falls on all cases alike."""
    one, other = case_of(), case_of(**{"run.model": "linear"})
    store, order = TimingStore(tmp_path), []

    def timed(case: Case, to: TimingStore) -> None:
        order.append(case.file.run.model)
        to.add(case, Timing(1.0, 0.5, 100.0, 13, 400))

    monkeypatch.setattr("panelsim.studies.cost._time", timed)
    measure_costs([one, other], store, rounds=3)
    assert order == ["nonlinear", "linear"] * 3


def test_the_time_of_a_run_is_that_of_its_loop() -> None:
    case = case_of(**{"run.duration": 5.0})
    history = case_history(case, case.database())
    history.tree.attrs |= {"cpu_seconds": 3.0, "jit_seconds": 7.0, "simulated_seconds": 11.0}
    assert Timing.of_history(history) == Timing(3.0, 7.0, 11.0, 13, len(history.panels))


def test_timings_of_another_case_or_version_are_refused(tmp_path: Path) -> None:
    case, store = case_of(), TimingStore(tmp_path)
    store.add(case, Timing(2.0, 0.5, 100.0, 13, 400))
    told = json.loads(store.path(case).read_text())
    for change in ({"identity": "other"}, {"panelsim_version": "0.0.1"}):
        store.path(case).write_text(json.dumps(told | change))
        with pytest.raises(PanelsimError, match="another case or version"):
            store.timings(case)
    damages: list[object] = [{}, [1], told | {"rounds": [{"x": 1}]}, told | {"rounds": "ab"}]
    damages.append(told | {"rounds": [told["rounds"][0] | {"cpu_seconds": "a minute"}]})
    for content in ["", "{", *map(json.dumps, damages)]:
        store.path(case).write_text(content)
        with pytest.raises(PanelsimError, match=r"damaged(.|\n)*remove the file"):
            store.timings(case)


def test_a_case_that_cannot_be_run_does_not_stop_the_others(tmp_path: Path) -> None:
    good, bad = case_of(), case_of(**{"run.stepper": "ab3", "run.time_step": 2.0})
    store = TimingStore(tmp_path)
    measure_costs([bad, good], store, rounds=1)
    failed, timed = cost_rows({"bad": bad, "good": good}, store, rounds=1)
    assert failed.failure is not None and "too long" in failed.failure and np.isnan(failed.median)
    assert timed.failure is None and timed.median > 0.0


def test_what_a_case_costs_by_default_and_by_wish() -> None:
    study = case_cost(case_of())
    assert [case.seaway.components.count for case in study.varied["components"].values()] == [
        13,
        13,
        26,
        26,
        52,
        52,
    ]
    assert [case.file.ship.panel_area for case in study.varied["panels"].values()][::2] == [40.0, 20.0]
    assert [case.file.run.model for case in study.varied["case"].values()] == ["linear", "nonlinear"]
    wished = case_cost(case_of(**{"run.duration": 5000.0}), [19], [60.0])
    assert [case.seaway.components.count for case in wished.varied["components"].values()] == [19, 19]
    assert {case.file.run.duration for case in wished.cases} == {600.0}


def test_few_components_are_timed_though_they_hold_little_of_the_sea() -> None:
    study = case_cost(case_of(**{"seaway.minimum_energy": 0.97}), [3, 5], [60.0])
    assert [case.seaway.components.count for case in study.varied["components"].values()] == [3, 3, 5, 5]


def test_converge_leaves_a_page_that_is_the_same_when_made_again(
    panelsim: Called, tmp_path: Path, recorded: list[dict[str, object]]
) -> None:
    (tmp_path / "short.toml").write_text(CASE)
    command = ["converge", "time-step", "short.toml", "--steppers", "exponential,ab3", "--steps", "0.4,1.0"]
    code, out, err = panelsim(*command, "--workers", 1)
    assert code == 0
    folder = tmp_path / "runs" / "short-time-step"
    page = (folder / "report.md").read_text()
    assert "ab3, 1 s, H_s 5 m, 150°, realization 1: The time step is too long" in page
    assert "ab3, 1 s" in err and "within 1 % of the reference" in out
    assert "| reference | exponential, 0.2 s (reference) |" in page
    assert len((folder / "rms.csv").read_text().splitlines()) == 1 + 2 * 3
    assert set(recorded[0]["series"]) == {
        "exponential, 1 s",
        "exponential, 0.4 s",
        "ab3, 0.4 s",
        "exponential, 0.2 s (reference)",
    }  # type: ignore
    (folder / "difference-mine.png").write_text("the user's")
    kept = {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}
    assert panelsim(*command, "--workers", 1)[0] == 2  # there is a page already
    (folder / "difference-rk4.png").write_text("of an older page")
    lost, *others = sorted((folder / "runs").iterdir())
    times = {file: file.stat().st_mtime_ns for file in others}
    lost.unlink()
    assert panelsim(*command, "--workers", 1, "--force")[0] == 0
    assert {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()} == kept
    assert lost.is_file() and {file: file.stat().st_mtime_ns for file in others} == times


def test_force_keeps_a_picture_where_there_was_no_page(
    panelsim: Called, tmp_path: Path, recorded: list[dict[str, object]]
) -> None:
    (tmp_path / "short.toml").write_text(CASE)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "difference-rk4.png").write_text("the user's")
    command = ["converge", "time-step", "short.toml", "--steps", "0.4", "--workers", 1, "--out", "mine"]
    assert panelsim(*command)[0] == 2
    assert panelsim(*command, "--force")[0] == 0
    assert (tmp_path / "mine" / "difference-rk4.png").read_text() == "the user's"


def test_a_study_that_was_stopped_goes_on_without_force(tmp_path: Path) -> None:
    folder = tmp_path / "study"
    refuse_other_folder(folder, force=False)
    (folder / "runs").mkdir(parents=True)
    (folder / "runs" / "one.nc").touch()
    refuse_other_folder(folder, force=False)
    # What comes before the page, whole or half-written by a process that was killed.
    for name in ("rms.csv", "difference-vertex-centre.png", "study.rrd", ".study.812.rrd", ".panelsim-812"):
        (folder / name).touch()
    refuse_other_folder(folder, force=False)
    (folder / "thesis.csv").touch()
    with pytest.raises(PanelsimError, match="not empty"):
        refuse_other_folder(folder, force=False)
    (folder / "thesis.csv").unlink()
    (folder / "report.md").touch()
    refuse_other_folder(folder, force=True)
    with pytest.raises(PanelsimError, match="not empty"):
        refuse_other_folder(folder, force=False)


def test_converge_mesh_and_compare_leave_their_pages(
    panelsim: Called, tmp_path: Path, recorded: list[dict[str, object]]
) -> None:
    (tmp_path / "short.toml").write_text(CASE)
    assert panelsim("converge", "mesh", "short.toml", "--panel-areas", "60,40", "--workers", 1)[0] == 0
    page = (tmp_path / "runs/short-mesh/report.md").read_text()
    assert "60 m2" in page and "| reference | 20 m2 (reference) |" in page
    code, out, _ = panelsim("compare", "linear-nonlinear", "short.toml", "--seeds", 2, "--workers", 1)
    assert code == 0 and "Nonlinear less linear" in out
    page = (tmp_path / "runs/short-linear-nonlinear/report.md").read_text()
    assert "from 2 realizations, paired" in page and "their components" in page
    (study,) = recorded[1]["studies"]  # type: ignore[misc]
    assert study.levels == ("linear", "nonlinear") and study.reference == 0


def test_cost_leaves_a_page_that_is_the_same_when_made_again(panelsim: Called, tmp_path: Path) -> None:
    (tmp_path / "short.toml").write_text(CASE)
    command = ["cost", "short.toml", "--components", "13,26", "--panel-areas", "60", "--rounds", 2]
    code, out, _ = panelsim(*command)
    assert code == 0 and "CPU s a simulated s" in out
    folder = tmp_path / "runs" / "short-cost"
    kept = {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}
    assert set(kept) == {"report.md", "cost.csv", "cost.png"}
    assert "number of components to the power" in kept["report.md"].decode()
    assert panelsim(*command, "--force")[0] == 0
    assert {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()} == kept


def test_cost_of_a_case_that_cannot_be_timed_is_told_and_no_success(panelsim: Called, tmp_path: Path) -> None:
    (tmp_path / "short.toml").write_text(CASE)
    command = ["cost", "short.toml", "--components", "13", "--panel-areas", "60", "--rounds", 1]
    code, out, _ = panelsim(*command)
    assert code == 0 and "spread –" in out and "\n\n" not in out
    page = (tmp_path / "runs/short-cost/report.md").read_text()
    assert "One round, each run alone" in page and " 0 %" not in page
    code, out, err = panelsim(*command, "--set", "run.capsize_angle_deg=0.01", "--force")
    assert all(line.startswith("warning: ") for line in err.splitlines())
    assert code == 3 and "capsized" in err and "report.md;" in out and "\n\n" not in out
    left = {file.name for file in (tmp_path / "runs/short-cost").iterdir()}
    assert left == {"report.md", "runs"}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["converge", "time-step", "--steps", ""], "no range and no list of seconds"),
        (["converge", "time-step", "--steps", "0.2,0.2"], "Two of the time steps are the same"),
        (["converge", "time-step", "--steps", "0.2,0"], "not positive"),
        (["converge", "time-step", "--steps", "0.2,9"], "run.time_step"),
        (["converge", "time-step", "--steppers", ""], "exponential, rk4, ab3"),
        (["converge", "time-step", "--steppers", "euler"], "exponential, rk4, ab3"),
        (["converge", "time-step", "--steps", "0.2,0.20000001"], "first four digits"),
        (["converge", "time-step", "--steps", "0.01:2:0.01"], "200: 0.01, 0.02, 0.03, 0.04, 0.05, 0.06,"
         " 0.07, 0.08, … s\n  allowed: at most 30"),
        (["converge", "time-step", "--seeds", "100000"], "400000 runs\n  allowed: at most 2000"),
        (["compare", "linear-nonlinear", "--seeds", "1001"], "2002 runs"),
        (["converge", "time-step", "--workers", "1000000"], "more workers than cores"),
        (["cost", "--components", "10000000"], "10000000\n  allowed: different whole numbers from 2 to 5000"),
        (["cost", "--components", "5,5"], "components are the same"),
        (["converge", "time-step", "--seeds", "0"], "number of seeds"),
        (["converge", "time-step", "--set", "seaway.kind=calm"], "seaway"),
        (["converge", "time-step", "--workers", "0"], "workers"),
        (["compare", "linear-nonlinear", "--scheduler", "nowhere"], "tcp://"),
        (["converge", "mesh", "--panel-areas", "-5"], "not positive"),
        (["converge", "mesh", "--panel-areas", "1e9"], "panel area does not suit"),
        (["converge", "mesh", "--panel-areas", "50,1e-6"], "panel area does not suit"),
        (["converge", "mesh", "--panel-areas", "5e3,4e3"], "panel area does not suit"),
        (["cost", "--panel-areas", "50,5e3"], "panel area does not suit"),
        (["sweep", "--over", "ship.hull=halifax,titanic"], "titanic"),
        (["converge", "mesh", "--rules", "corner"], "vertex+centre"),
        (["converge", "mesh", "--set", "run.model=linear", "--rules", "panel"], "no pressure rule"),
        (["compare", "linear-nonlinear", "--set", "roll_damping.method=terms", "--set",
          "roll_damping.quadratic=1e8", "--set", "supplementary.damping={}"], "linearised_at_deg"),
        (["cost", "--components", "1,5"], "different whole numbers from 2 to"),
        (["cost", "--components", "1.5"], "whole numbers"),
        (["cost", "--components", ""], "no list of whole numbers"),
        (["cost", "--panel-areas", "0"], "not positive"),
        (["cost", "--rounds", "0"], '"0"\n  allowed: greater than or equal to 1'),
        (["converge"], "Missing command.\n  allowed: mesh, time-step"),
        (["converge", "foo"], "No such command 'foo'.\n  allowed: mesh, time-step"),
        (["compare"], "Missing command.\n  allowed: linear-nonlinear"),
    ],
)  # fmt: skip
def test_bad_input_is_refused_in_words_and_leaves_nothing(
    panelsim: Called, tmp_path: Path, arguments: list[str], told: str
) -> None:
    (tmp_path / "short.toml").write_text(CASE)
    commands = 1 if arguments[0] in ("cost", "sweep") else 2
    case = ["short.toml"] if len(arguments) > 2 else []
    code, _, err = panelsim(*arguments[:commands], *case, *arguments[commands:])
    assert code == 2
    assert err.startswith("error: ") and told in err
    assert [file.name for file in tmp_path.iterdir()] == ["short.toml"]


CALM = """
[ship]
hull = "halifax"
[seaway]
kind = "calm"
[run]
speed_knots = 5
time_step = 0.2
duration = 9
"""
REGULAR = CALM.replace('"calm"', '"regular"\nwave_height = 2\nwave_period = 9\nwave_heading_deg = 120')


@pytest.mark.parametrize(
    ("text", "arguments", "told"),
    [
        (CALM, ["converge", "time-step"], "calm water"),
        (CALM, ["converge", "mesh"], "calm water"),
        (CALM, ["compare", "linear-nonlinear"], "calm water"),
        (REGULAR, ["converge", "time-step", "--seeds", "2"], "one realization only"),
        (REGULAR, ["compare", "linear-nonlinear", "--seeds", "2"], "one realization only"),
        (REGULAR, ["cost", "--components", "5"], "cannot be varied"),
        (REGULAR.replace("halifax", "hull.stl"), ["converge", "mesh"], "its own panels"),
        (
            REGULAR.replace("halifax", "hull.stl"),
            ["converge", "mesh", "--panel-areas", "5"],
            "its own panels",
        ),
        (REGULAR.replace("halifax", "hull.stl"), ["cost", "--panel-areas", "5"], "its own panels"),
    ],
)
def test_a_case_that_cannot_vary_what_is_studied_is_refused(
    panelsim: Called, tmp_path: Path, text: str, arguments: list[str], told: str
) -> None:
    (tmp_path / "other.toml").write_text(text)
    commands = 1 if arguments[0] == "cost" else 2
    code, _, err = panelsim(*arguments[:commands], "other.toml", *arguments[commands:])
    assert code == 2 and told in err
    assert [file.name for file in tmp_path.iterdir()] == ["other.toml"]


def test_the_order_is_over_the_step_or_the_side_of_a_panel() -> None:
    def made_up(values: list[float], error: float, power: float) -> RmsStudy:
        size = np.array(values)
        rms = (1.0 - error * size**power)[:, None, None, None] * np.ones((1, 1, 6))
        labels = tuple(map(str, values))
        return RmsStudy("t", "v", labels, size, len(values) - 1, (StudySea("s", 0.0),), rms)

    panels = mesh_convergence(case_of(), [60.0, 40.0])
    found = panels.order(made_up([160.0, 80.0, 40.0, 20.0, 10.0], 1e-5, 1.0), "vertex+centre")
    assert found.order == pytest.approx(2.0, abs=0.01)  # 1 − ε h^p is not quite 1
    steps = time_step_convergence(case_of())
    values = [0.8, 0.4, 0.2, 0.1]
    # a step in the duration of 60 s is what the samples of a run leave
    assert "samples" in steps.order(made_up(values, 0.5 / 60.0, 1.0), "exponential").told
    assert steps.order(made_up(values, 3.0 / 60.0, 1.0), "exponential").order == pytest.approx(1.0, abs=0.05)
