"""Drift, kernel speed and sampling statistics of the report's set-up: verdicts on made-up data."""

import json
from pathlib import Path

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.response.run_length import sampling_error
from panelsim.results.rms_study import RmsStudy
from panelsim.studies.run_store import RunStore, StoredRun
from panelsim.studies.tm2003_190 import kernel_speed, look_up
from panelsim.studies.tm2003_190.common import base_case, in_sea
from panelsim.studies.tm2003_190.drift import Drift
from panelsim.studies.tm2003_190.drift_statements import (
    FREE,
    NO_SPRINGS,
    SHIFTED,
    SLOW_LEFT_OUT,
    drift_statement,
    force_statement,
    powers,
)
from panelsim.studies.tm2003_190.kernel_speed import DIRECT, FILE, GRID, NUMPY, SINES, TABLES, KernelSpeed
from panelsim.studies.tm2003_190.look_up import LookUpSurroundings
from panelsim.studies.tm2003_190.section import Statement
from panelsim.studies.tm2003_190.statistics import SEA_STATE_7, SamplingStatistics, _worst, seed_scatter


@pytest.fixture(scope="module")
def base() -> Case:
    return base_case()


class MadeUpRuns:
    """A store of runs that drift with the square of the height if they are nonlinear, and else stay."""

    def __init__(self, base: Case) -> None:
        self.base = base

    def failure(self, case: Case) -> str | None:
        return None

    def rms(self, case: Case) -> tuple[FloatArray, str | None]:
        run = self.load(case)
        return run.rms, run.early_end

    def load(self, case: Case) -> StoredRun:
        run = case.file.run
        time = run.time_step * np.arange(run.steps + 1)
        displacement = 0.1 * np.sin(0.5 * time)[:, None] * np.ones(6)
        if run.model == "nonlinear":
            height = case.file.seaway.significant_wave_height or np.nan
            held = "surge" in case.supplementary.stiffness
            displacement[:, 0] -= 0.02 * height**2 if held else time
            displacement[:, 1] += 0.01 * height**2 if held else 0.0
        loose = not case.supplementary.stiffness
        attrs = {
            "outcome": "diverged" if loose else "finished",
            "outcome_detail": "broached",
            "ramp": run.ramp,
            "seed": case.file.seaway.seed,
        }
        return StoredRun(time, displacement, np.zeros(len(time)), attrs | {"time_step": run.time_step})


def test_the_runs_are_without_the_terms_that_hold(base: Case) -> None:
    study = Drift(base, quick=False)
    free = study.free[FREE, 150.0, "nonlinear"][0].supplementary
    assert free.stiffness == {"yaw": 2e9}
    assert free.damping == {"roll": 2e7}
    assert not study.free[NO_SPRINGS, 30.0, "linear"][0].supplementary.stiffness
    assert study.held[1.0, "linear"].supplementary.stiffness == base.supplementary.stiffness
    for kind in (FREE, SHIFTED):
        for model in ("linear", "nonlinear"):
            assert [case.file.seaway.seed for case in study.free[kind, 30.0, model]] == [1, 2, 3, 4]
    assert [case.file.seaway.seed for case in study.free[NO_SPRINGS, 30.0, "linear"]] == [1]
    assert len(Drift(base, quick=True).free[FREE, 30.0, "linear"]) == 2
    without = study.free[SLOW_LEFT_OUT, 30.0, "linear"][0].seaway.components
    assert without.frequency[-1] == pytest.approx(1.0)
    even, between = (study.free[kind, 30.0, "linear"][0].seaway.components for kind in (FREE, SHIFTED))
    assert even.frequency[0] == pytest.approx(0.2)
    assert between.frequency == pytest.approx(0.05 + even.frequency[:-1])


def _judged(nonlinear: list[float], linear: list[float], **more: list[float]) -> Statement:
    found = {(FREE, "nonlinear"): np.array(nonlinear), (FREE, "linear"): np.array(linear)}
    found |= {(kind, "linear"): np.array(of) for kind, of in more.items()}
    return drift_statement(30.0, found, 124.5, slow=(1.1, 0.0006))


def test_drift_is_judged_by_the_ship_length_over_all_seeds() -> None:
    """The median of the nonlinear runs is beyond, and no linear run."""
    assert _judged([200.0, 80.0, 300.0, 900.0], [2.0, 3.0, 4.0, 124.0]).holds
    assert not _judged([200.0, 80.0, 100.0, 110.0], [2.0, 3.0, 4.0, 1.0]).holds
    assert not _judged([200.0, 200.0, 300.0, 900.0], [2.0, 3.0, 4.0, 125.0]).holds
    assert not _judged([200.0, np.nan, 300.0, 900.0], [2.0, 3.0, 4.0, 5.0]).holds
    assert not _judged([200.0, 200.0, 300.0, 900.0], [2.0, 3.0, 4.0, np.nan]).holds
    assert not drift_statement(30.0, {}, 124.5, slow=(1.1, 0.0006)).holds


def test_ranges_over_seeds_and_the_cause_are_told() -> None:
    shifted, without = [10.0, 152.0, np.nan], [69.0, 14.0, 30.0]
    found = _judged(
        [496.0, 4633.0, 211.0], [1144.0, 3155.0, 90.0], **{SHIFTED: shifted, SLOW_LEFT_OUT: without}
    )
    assert not found.holds
    assert "211 to 4633 m nonlinear (median 496 m) and 90 to 3155 m linear, 3 seeds" in found.figures
    assert "1.1 rad/s is met at 0.0006 rad/s" in found.remark
    assert "Without the components above 1.0 rad/s the linear ship goes 14 to 69 m" in found.remark
    assert "between those of the report's grid she goes 10 to 152 m linear." in found.remark


def test_the_mean_force_is_of_second_order_or_not() -> None:
    force = {height: np.array([-3.0, 2.0]) * height**2 for height in (0.25, 0.5, 2.0)}
    assert powers(force) == pytest.approx([2.0, 2.0])
    # Of the two lowest, where no higher order is seen yet; a force that turns round has none.
    assert powers({**force, 2.0: np.array([-1.0, 1.0])}) == pytest.approx([2.0, 2.0])
    assert np.isnan(powers({**force, 0.25: np.array([1.0, 1.0])})[0])
    assert not force_statement({**force, 0.25: -force[0.25] * [1.0, -1.0]}).holds
    assert force_statement(force).holds
    assert not force_statement({h: values / h for h, values in force.items()}).holds
    assert not force_statement({h: values * h**0.5 for h, values in force.items()}).holds
    force[0.5] = np.array([np.nan, 0.5])
    assert not force_statement(force).holds


def test_the_section_of_drift(base: Case, tmp_path: Path) -> None:
    study = Drift(base, quick=True)
    store = MadeUpRuns(base)
    section = study.section(store, tmp_path)  # type: ignore[arg-type]
    # What the springs hold: 5e5 N/m times 0.02 m, away from the waves, and 1e6 N/m times 0.01 m.
    force = study.mean_force(store)[1.0]  # type: ignore[arg-type]
    assert force == pytest.approx([-1e4, 1e4])
    assert [statement.holds for statement in section.statements] == [True, True, True]
    assert not section.failures
    # The report speaks of nonlinear terms alone, and names what stands behind the linear drift at 30° too.
    assert "radiation damping goes to zero" in section.setup
    assert "That the linear model has none" in section.setup
    assert "| no yaw spring | 30 | nonlinear | 660 | -660 | -0 | diverged: broached |" in section.body
    assert "| free | 30 | nonlinear | 660, 660 | -660, -660 | -0, -0 | finished |" in section.body
    assert "free,30.0,nonlinear,2,-660" in section.tables["drift.csv"]
    assert (tmp_path / "drift.png").is_file()
    assert "0.5,-2500,2500" in section.tables["mean_force.csv"]


def test_a_wave_stands_still_beside_the_ship_in_stern_quartering_seas(base: Case) -> None:
    """ω = g/(U cos 30°) is 1.1 rad/s at 20 knots."""
    frequency, met = Drift(base, quick=True)._slowest(30.0)
    assert frequency == pytest.approx(1.1)
    assert abs(met) < 1e-3


def test_tables_are_sines_and_exponentials() -> None:
    angle = np.linspace(-50.0, 50.0, 10001)
    # Half an entry: π/4096, and half of 20/65536.
    assert look_up.cosine(angle) == pytest.approx(np.cos(angle), abs=np.pi / look_up.TURN * 1.001)
    exponent = -np.linspace(0.0, 40.0, 10001)
    assert look_up.decay(exponent) == pytest.approx(np.exp(exponent), abs=2e-4)


def test_all_methods_compute_the_same_load(base: Case) -> None:
    methods = kernel_speed._methods(base)
    poses = kernel_speed._poses()[:2]
    found = kernel_speed.timings({name: methods[name] for name in (NUMPY, TABLES)}, poses, 1)
    assert found[NUMPY]["difference"] == 0.0
    one, other = methods[NUMPY](poses), methods[TABLES](poses)
    # Entries of tables are 1e-3 off, of either sign: over thousands of points and 19 waves little is left.
    assert other == pytest.approx(one, abs=1e-3 * np.abs(one).max())
    assert not np.array_equal(one, other)
    assert LookUpSurroundings.__dataclass_fields__["stretching"].default == "wheeler"


def test_timings_are_medians_of_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock that every evaluation moves on: 2 s and 6 s of two poses, with one slow round of the first."""
    clock = {"now": 0.0}
    calls = {"a": 0, "b": 0}

    def method(name: str, seconds: float, load: float) -> kernel_speed.Evaluate:
        def evaluate(poses: FloatArray) -> FloatArray:
            calls[name] += 1
            clock["now"] += 50.0 if (name, calls[name]) == ("a", 2) else seconds
            return np.full((len(poses), 6), load) * np.arange(1, len(poses) + 1)[:, None]

        return evaluate

    monkeypatch.setattr("time.process_time", lambda: clock["now"])
    found = kernel_speed.timings(
        {"a": method("a", 2.0, 1.0), "b": method("b", 6.0, 1.5)}, np.zeros((2, 8)), 3
    )
    assert found["a"]["seconds"] == 1.0
    assert found["b"]["seconds"] == 3.0
    # Loads of 1 and 2, which range over 1, against 1.5 and 3.
    assert found["b"]["difference"] == 1.0


def _timed(sines: float) -> dict[str, dict[str, float]]:
    times = {NUMPY: 1e-2, SINES: sines * 1e-2, TABLES: 9e-3, DIRECT: 2e-4, GRID: 1e-4}
    return {name: {"seconds": of, "spread": 0.1, "difference": 1e-6} for name, of in times.items()}


def test_tables_that_gain_flip_the_verdict() -> None:
    assert kernel_speed.statements(_timed(1.2))[0].holds
    assert kernel_speed.statements(_timed(0.96))[0].holds
    assert not kernel_speed.statements(_timed(0.9))[0].holds


def test_timings_are_kept_beside_the_runs(
    base: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Measured once; those of another version are not taken; without any there is no section."""
    study, store = KernelSpeed(base, quick=True), RunStore(tmp_path)
    with pytest.raises(PanelsimError, match="not measured"):
        study.section(store, tmp_path)
    monkeypatch.setattr(kernel_speed, "timings", lambda *given: _timed(0.8))
    study.measure(store)
    assert study.is_measured(store)
    section = study.section(store, tmp_path)
    assert "| kernel, grid | 100 | 0.01 |" in section.body
    assert not section.statements[0].holds
    assert not KernelSpeed(base, quick=False).is_measured(store)
    monkeypatch.setattr(kernel_speed, "timings", lambda *given: _timed(1.2))
    study.measure(store)
    assert not study.section(store, tmp_path).statements[0].holds
    told = json.loads((tmp_path / FILE).read_text(encoding="utf-8"))
    (tmp_path / FILE).write_text(json.dumps(told | {"panelsim_version": "0.0"}), encoding="utf-8")
    study.measure(store)
    assert study.section(store, tmp_path).statements[0].holds


def test_the_scatter_of_seeds_is_that_of_one_run() -> None:
    study = SamplingStatistics(base_case(), quick=True).plan
    rms = np.ones((2, len(study.seas), 3, 6))
    rms[1, :, :, 2] = [0.9, 1.0, 1.1]
    made = RmsStudy("", "", ("linear", "nonlinear"), np.arange(2.0), 1, study.seas, rms)
    found = seed_scatter(made, 1)[0]
    # Standard deviation 0.1 about an RMS of √1.00667.
    assert found == pytest.approx([0.0, 0.0, 1.95996 * 0.1 / np.sqrt(1 + 0.02 / 3), 0.0, 0.0, 0.0], abs=1e-5)


def test_the_statistics_of_the_sea_are_those_of_its_components(base: Case) -> None:
    """The grid against the spectrum as `sampling_error` itself has it."""
    study, sea = SamplingStatistics(base, quick=True), SEA_STATE_7[1]
    whole = sampling_error(study.table, in_sea(base, sea, 0).seaway)
    assert whole.grid_error is not None
    ratio = study._of_components(sea).rms / study._of_spectrum(sea).rms - 1.0
    assert ratio == pytest.approx(whole.grid_error)
    # 0.1 rad/s is too coarse for the roll resonance.
    assert ratio[3] < -0.2


def test_the_section_of_statistics(base: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("panelsim.studies.tm2003_190.statistics.JITTERED", 3)
    study = SamplingStatistics(base, quick=True)
    section = study.section(MadeUpRuns(base), tmp_path)  # type: ignore[arg-type]
    assert not section.statements
    assert not section.failures
    # In stern quartering seas of 7 m two waves beat for hours; from the bow none do.
    stern, bow = (
        next(line for line in section.body.splitlines() if name in line)
        for name in ("9.6 s, 30°", "9.6 s, 150°")
    )
    assert "∞ | ∞" in stern
    assert "∞" not in bow
    assert (tmp_path / "sampling.png").is_file()
    assert len(section.tables["sampling.csv"].splitlines()) == 1 + 6 * 4


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_run_that_failed_leaves_the_section_of_statistics(
    model: str, base: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the reference, which says what counts, the sea's row is unknown."""
    monkeypatch.setattr(SamplingStatistics, "_jitter", lambda self: "")
    study = SamplingStatistics(base, quick=True)
    store = MadeUpRuns(base)
    failing = study.plan.case(["linear", "nonlinear"].index(model), 0, 1)
    monkeypatch.setattr(store, "failure", lambda case: "made to fail" if case == failing else None)
    section = study.section(store, tmp_path)  # type: ignore[arg-type]
    assert len(section.failures) == 1
    row = next(line for line in section.body.splitlines() if line.startswith(f"| {study.plan.seas[0].label}"))
    cells = row.split(" | ")
    assert cells[3] == "–"  # of the nonlinear seeds, or of anything where nothing counts
    if model == "linear":
        assert row == f"| {study.plan.seas[0].label}{9 * ' | –'} |"
    else:
        assert "–" not in cells[1:3]


def test_the_worst_band_is_of_motions_that_count() -> None:
    values, major = np.array([1.0, 9.0, 2.0, -3.0, 0.0, 0.0]), np.array([1, 0, 1, 1, 1, 1], dtype=bool)
    assert _worst(values, major) == 2.0
    assert np.isnan(_worst(values, np.zeros(6, dtype=bool)))


def test_the_wave_that_stands_still_is_left_out_where_it_does() -> None:
    """At 30° the component of 1.1 rad/s is met at 0.0006 rad/s; at 150° none is slow."""
    cases = Drift(base_case(), quick=True).free
    ((kind, heading, model),) = [key for key in cases if key[0] == SLOW_LEFT_OUT]
    assert (kind, heading, model) == (SLOW_LEFT_OUT, 30.0, "linear")
    for free, left in zip(cases[FREE, 30.0, "linear"], cases[kind, heading, model], strict=True):
        assert left.file.seaway.wave_heading_deg == 30.0
        assert left.file.seaway.seed == free.file.seaway.seed
        met = [
            np.abs(case.seaway.components.encounter_frequency(case.speed, 9.80665)).min()
            for case in (free, left)
        ]
        assert met[0] < 0.001 < 0.05 < met[1]
