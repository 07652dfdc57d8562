"""Regular waves and stretching: runs that are made up from the frequency domain, whose verdicts are known."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.loads.hull_pressure import hull_pressure
from panelsim.response.linear_ship import LinearShip
from panelsim.studies.case_history import case_history
from panelsim.studies.run_store import StoredRun
from panelsim.studies.tm2003_190 import excess_answer as excess_answer_module
from panelsim.studies.tm2003_190 import regular_causes
from panelsim.studies.tm2003_190.common import base_case
from panelsim.studies.tm2003_190.excess_answer import ExcessAnswer, excess_answer, transom_immersion
from panelsim.studies.tm2003_190.excess_load import ExcessLoad, excess_load
from panelsim.studies.tm2003_190.regular_causes import causes_table, growth, growth_told
from panelsim.studies.tm2003_190.regular_runs import (
    MEASURED,
    Measured,
    RegularRuns,
    _scale,
    left_out,
    met_frequency,
    relative_difference,
    worst,
)
from panelsim.studies.tm2003_190.regular_waves import (
    SINUSOIDAL,
    STOKES,
    RegularWaves,
    _not_periodic,
    domains_statement,
    stokes_statement,
)
from panelsim.studies.tm2003_190.stretching import Stretching
from panelsim.studies.tm2003_190.stretching import statement as stretching_statement

Factor = Callable[[Case], float]
INSTANTS_ROOM = 0.004  # of the excess; with eight instants it is twice that


class MadeUpRuns:
    """Runs whose first harmonics are those of the frequency domain times a factor of the case."""

    def __init__(self, grid: RegularRuns, factor: Factor, failed: int | None = None) -> None:
        self._linear, self._grid, self._factor, self._failed = grid.linear(), grid, factor, failed

    def failure(self, case: Case) -> str | None:
        """The one that failed, by its number."""
        own = self._failed is not None and self._place(case) == list(np.ndindex(2, 3))[self._failed]
        return "made to fail" if own else None

    def rms(self, case: Case) -> tuple[FloatArray, str | None]:
        run = self.load(case)
        return run.rms, run.early_end

    def load(self, case: Case) -> StoredRun:
        """Those harmonics, a mean heave of a tenth of the wave, a second one of a twentieth."""
        run, waves = case.file.run, case.seaway.components
        time = run.time_step * np.arange(run.steps + 1)
        displacement = np.zeros((len(time), 6))
        turn = np.exp(1j * met_frequency(case) * time)
        if case.file.seaway.kind == "regular":
            z = self._linear[self._place(case)] * self._factor(case) * waves.amplitude[0]
            displacement[:, 2] = (
                0.1 * waves.amplitude[0] + (z[0] * turn).real + 0.05 * abs(z[0]) * (turn**2).real
            )
            displacement[:, 4] = (z[1] * waves.wavenumber(case.ship.gravity) * turn).real
        else:
            displacement[:] = self._factor(case) * np.sin(time)[:, None]
        attrs = {"outcome": "finished", "outcome_detail": "", "ramp": run.ramp, "time_step": run.time_step}
        return StoredRun(time, displacement, np.zeros(len(time)), attrs)

    def _place(self, case: Case) -> tuple[int, int]:
        length = case.file.seaway.wave_length or np.nan
        ratio = np.array(self._grid.length_ratio) - length / case.ship.length
        speeds = [of.speed for (_, r, h), of in self._grid.by_index.items() if r == h == 0]
        return int(np.argmin(np.abs(np.array(speeds) - case.speed))), int(np.argmin(np.abs(ratio)))


@pytest.fixture(scope="module")
def base() -> Case:
    return base_case()


@pytest.fixture(scope="module")
def study(base: Case) -> RegularWaves:
    return RegularWaves(base, quick=True)


def test_cases_are_the_waves_and_speeds_of_the_report(base: Case) -> None:
    full = RegularWaves(base, quick=False)
    assert len(full.cases) == 2 * 10 * (4 + 3)
    case = full.runs[STOKES].by_index[1, 2, 0]
    length, gravity = base.ship.length, base.ship.gravity
    assert case.speed == pytest.approx(0.20 * np.sqrt(gravity * length))
    waves = case.seaway.components
    assert waves.second_order
    # λ = L, H = L/30.
    assert 2 * np.pi / waves.wavenumber(gravity)[0] == pytest.approx(length)
    assert waves.amplitude[0] == pytest.approx(length / 60)
    assert waves.wave_heading[0] == pytest.approx(np.pi)
    assert case.file.run.model == "nonlinear"
    assert case.file.seaway.stretching == "wheeler"
    # A minute passes after the ramp, then two are measured.
    run = case.file.run
    assert (run.time_step, run.ramp, run.duration, MEASURED) == (0.1, 60.0, 180.0, 120.0)
    assert full.runs[STOKES].told((1, 2, 0)) == "Fn 0.2, λ/L 1, H/λ 1/30"


def test_in_long_waves_the_ship_follows_the_surface(base: Case) -> None:
    """Heave tends to the amplitude, pitch to the slope: down by the bow a quarter period before the crest."""
    found = RegularRuns(base, (0.0,), (40.0,), (0.001,), {}).linear()[0, 0]
    # λ/L = 40: diffraction of first order in kL is some 2 %.
    assert found[0] == pytest.approx(1.0, abs=0.03)
    assert abs(found[1]) == pytest.approx(1.0, abs=0.03)
    assert abs(found[1].real) < 0.1


def test_the_slope_is_that_of_each_wave(base: Case) -> None:
    """Several lengths together are each of them alone; amplitude and slope k a are those of the case."""
    several = RegularRuns(base, (0.2,), (1.0, 3.0, 2.0), (0.05,), {})
    for r, ratio in enumerate(several.length_ratio):
        alone = RegularRuns(base, (0.2,), (ratio,), (0.05,), {})
        assert several.linear()[0, r] == pytest.approx(alone.linear()[0, 0], rel=1e-9)
        # H/λ = 1/20: k a = π/20.
        amplitude = ratio * base.ship.length / 40
        assert _scale(several.by_index[0, r, 0]) == pytest.approx([amplitude, np.pi / 20], rel=1e-9)


def test_stokes_waves_are_compared_with_sinusoidal_ones_of_their_steepness(base: Case) -> None:
    full = RegularWaves(base, quick=False)
    sinusoidal, stokes = (full.runs[name].steepness for name in (SINUSOIDAL, STOKES))
    given = np.array(sinusoidal)[None, None, :, None] * np.ones((2, 10, 1, 2), dtype=complex)
    assert full._common(given)[0, 0, :, 0].real == pytest.approx(stokes)


def test_runs_that_are_not_periodic_yet_are_told(study: RegularWaves) -> None:
    found = _measured(np.ones((2, 3, 1, 2), dtype=complex))
    unsettled = np.zeros((2, 3, 1, 2))
    unsettled[1, 2, 0, 1], unsettled[0, 0, 0, 0] = 0.012, 0.009
    told = _not_periodic(study.runs, {SINUSOIDAL: replace(found, unsettled=unsettled)})
    assert told == [
        "sinusoidal: Fn 0.2, λ/L 2, H/λ 1/20: pitch is not periodic yet, its harmonics change by 1.2 %"
    ]


def test_a_run_in_low_waves_is_the_frequency_domain(base: Case) -> None:
    """Amplitude, phase, slope and sign, of a nonlinear run at H/λ 1/1000."""
    runs = RegularRuns(base, (0.2,), (1.4,), (0.001,), {"run.duration": 120.0})
    (case,) = runs.cases
    history = case_history(case, base.database())
    run = StoredRun(history.time, history.displacement, history.wave_elevation, history.attrs)
    store = MadeUpRuns(runs, lambda case: 1.0)
    store.load = lambda case: run  # type: ignore[method-assign]
    found = runs.read(store)
    # What is left is of the transom, which the first power of the height brings down from 4 % at 1/30.
    assert found.transfer[0, 0, 0] == pytest.approx(runs.linear()[0, 0], abs=4e-3)
    assert found.unsettled.max() < 1e-3
    excess = excess_load(store, case)
    assert excess.size(Dof.PITCH) < 2e-3
    assert excess.share(Dof.HEAVE).sum() == pytest.approx(1.0)


def test_the_sections_of_the_excess_make_the_load_of_the_hull(
    study: RegularWaves, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first harmonic of the load on the whole hull, found in another way."""
    runs = study.runs[SINUSOIDAL]
    store, case = MadeUpRuns(runs, lambda case: 1.0), runs.by_index[0, 0, 0]
    excess, run = excess_load(store, case), store.load(case)
    period = 2 * np.pi / met_frequency(case)
    time = period / 16 * np.arange(16)
    rows = np.stack(
        [np.interp(time + 20 * period, run.time, values) for values in run.displacement.T], axis=1
    )
    loads = np.array(
        [
            hull_pressure(case.ship, case.seaway, float(t), row, speed=case.speed, method="oracle").load
            for t, row in zip(time, rows, strict=True)
        ]
    )
    whole = np.exp(-2j * np.pi / 16 * np.arange(16)) @ loads / 8
    # More instants change nothing: what is not smooth has little above the eighth harmonic.
    monkeypatch.setattr("panelsim.studies.tm2003_190.excess_load.INSTANTS", 64)
    many = excess_load(store, case)
    one, other = ((of.load - of.linear).sum(axis=0)[Dof.PITCH] for of in (excess, many))
    assert abs(one - other) < INSTANTS_ROOM * abs(other)
    # Motions between samples 0.1 s apart of a period of 6 s: 1e-3.
    assert excess.load.sum(axis=0)[[2, 4]] == pytest.approx(whole[[2, 4]], rel=5e-3)
    assert 0.01 < excess.size(Dof.PITCH) < 0.5


def test_minor_amplitudes_count_for_nothing() -> None:
    linear = np.array([[[1.0, 0.04], [0.5, 1.0]]], dtype=complex)
    found = np.array([[[[1.1, 9.0]], [[0.4j, 1.02]]]], dtype=complex)
    difference = relative_difference(found, linear, linear)
    assert difference[0, :, 0] == pytest.approx(np.array([[0.1, np.nan], [-0.2, 0.02]]), nan_ok=True)
    assert worst(difference) == (0, 1, 0, 0)
    assert worst(np.full((2, 2), np.nan)) is None


def test_what_is_left_out_is_told(study: RegularWaves) -> None:
    """A pitch of 4 % of its peak that is off by -65 %: the largest difference told is not that one."""
    runs = study.runs[SINUSOIDAL]
    linear = np.ones((2, 3, 2), dtype=complex)
    assert left_out(runs, _measured(linear[:, :, None]), linear, 1 / 20) == ""
    linear[0, 0, 1] = 0.04j
    transfer = linear.copy()
    transfer[0, 0, 1] *= 0.35
    told = left_out(runs, _measured(transfer[:, :, None]), linear, 1 / 20)
    assert told.endswith(
        "under 5 % of its peak over λ/L in the frequency domain: pitch at Fn 0.12, λ/L 1 (-65 % at H/λ 1/20)."
    )
    transfer[0, 0, 1] = np.nan
    assert left_out(runs, _measured(transfer[:, :, None]), linear, 1 / 20).endswith(
        "pitch at Fn 0.12, λ/L 1."
    )


def _measured(transfer: ComplexArray) -> Measured:
    nothing: FloatArray = np.zeros(transfer.shape)
    return Measured(transfer, nothing, nothing, nothing, ())


@pytest.mark.parametrize(("factor", "holds"), [(1.04, True), (0.96, True), (1.06, False), (0.94, False)])
def test_verdicts_follow_the_amplitudes(study: RegularWaves, factor: float, holds: bool) -> None:
    """5 % of the amplitude at one point, whatever its phase."""
    runs = study.runs[STOKES]
    linear = np.full((2, 3, 2), 1.0 + 0.0j)
    transfer = linear.copy()
    transfer[1, 1, 0] *= factor * np.exp(0.3j)
    found = domains_statement(runs, transfer, linear)
    assert found.holds is holds
    assert f"{100 * (factor - 1):+.0f} % in heave (Fn 0.2, λ/L 1.4" in found.figures
    # Of steeper waves it says nothing: in them the ship may be further off.
    assert ("At H/λ 1/20 within 5 % from λ/L 2 on." in found.remark) is not holds
    both = transfer.copy()
    both[0, 0, 1] *= 1.06
    assert "from λ/L 2 on" in domains_statement(runs, both, linear).remark or holds
    second = stokes_statement(runs, _measured(transfer[:, :, None]), _measured(linear[:, :, None]), linear)
    assert second.holds is holds
    assert f"{abs(100 * (factor - 1)):.0f} % at H/λ 1/20" in second.remark
    # A run that failed is none that agrees, be it the longest wave.
    transfer[0, 2, 1] = np.nan
    assert "on" not in domains_statement(runs, transfer, linear).remark
    transfer[0, 2, 1] = linear[0, 2, 1]
    transfer[0, 0, 1] = np.nan
    assert not domains_statement(runs, transfer, linear).holds
    assert not stokes_statement(
        runs, _measured(transfer[:, :, None]), _measured(linear[:, :, None]), linear
    ).holds


def test_wheeler_makes_the_difference_vanish_only_if_it_was_there() -> None:
    linear = np.ones((2, 3, 2), dtype=complex)
    near, far = _measured(1.04 * linear[:, :, None]), _measured(1.08 * linear[:, :, None])
    assert stretching_statement(near, far, linear).holds
    in_heave = _measured(np.where([True, False], 1.08, 1.01) * linear[:, :, None])
    assert stretching_statement(near, in_heave, linear).holds
    assert not stretching_statement(in_heave, in_heave, linear).holds
    assert not stretching_statement(near, near, linear).holds
    assert not stretching_statement(far, near, linear).holds
    assert not stretching_statement(far, far, linear).holds
    assert "heave 4 %, pitch 4 %; no stretching: heave 8 %" in stretching_statement(near, far, linear).figures


def test_the_power_of_the_height_is_told(base: Case) -> None:
    runs = RegularRuns(base, (0.12,), (1.0,), (0.01, 0.03), {})
    assert growth(runs, np.array([1e-4, 9e-4j])) == pytest.approx(2.0)
    assert np.isnan(growth(RegularRuns(base, (0.12,), (1.0,), (0.05,), {}), np.array([1e-4j])))
    found = _measured(np.array([1.0001, 1.0003])[None, None, :, None] * np.ones((1, 1, 2, 2), dtype=complex))
    told = growth_told(runs, found, np.ones((1, 1, 2), dtype=complex), (0, 0, 1))
    # 1e-4 and 3e-4 over heights as 1 to 3.
    assert "1.0th power of the height from H/λ 1/100 to 1/33" in told


@pytest.mark.parametrize(
    ("run", "pressure", "stern", "displaced", "verdict"),
    [
        (0.13, 0.11, 0.10, 0.13, "most of it is of the stern"),
        (-0.13, -0.11, -0.10, -0.13, "most of it is of the stern"),
        (0.13, 0.11, -0.10, 0.13, "most of it is of the pressure, not of the stern"),
        (
            0.064,
            0.031,
            -0.005,
            0.072,
            "not of the stern: of the pressure elsewhere and of where the ship lies",
        ),
        (0.064, 0.031, 0.05, 0.031, "not explained"),
        (0.064, 0.064, 0.05, -0.064, "not explained"),
    ],
)
def test_the_cause_is_what_was_solved_for(
    base: Case, run: float, pressure: float, stern: float, displaced: float, verdict: str
) -> None:
    answer = ExcessAnswer(run, pressure, stern, displaced, -1.5)
    assert answer.verdict == verdict
    runs = RegularRuns(base, (0.12,), (1.0,), (0.05,), {})
    table = causes_table(runs, {(0, 0, 1): answer})
    cells = " | ".join(f"{100 * share:+.2g}" for share in (run, pressure, stern, displaced))
    assert f"| Fn 0.12, λ/L 1, pitch | {cells} | -1.5 | {verdict} |" in table
    assert "0.37 m" in table
    assert causes_table(runs, {}) == ""
    assert transom_immersion(base.ship) == pytest.approx(0.37, abs=5e-3)


def test_the_linear_ship_with_the_excess_load_is_the_run(base: Case) -> None:
    """A nonlinear run at H/λ 1/20: what the linear ship misses is the pressure and where she lies."""
    runs = RegularRuns(base, (0.2,), (1.0,), (0.05,), {"run.duration": 130.0})
    (case,) = runs.cases
    history = case_history(case, base.database())
    run = StoredRun(history.time, history.displacement, history.wave_elevation, history.attrs)
    store = MadeUpRuns(runs, lambda case: 1.0)
    store.load = lambda case: run  # type: ignore[method-assign]
    for mode, own in ((Dof.HEAVE, 0), (Dof.PITCH, 1)):
        found = excess_answer(store, case, mode)
        measured = runs.read(store).transfer[0, 0, 0, own]
        assert found.run == pytest.approx(abs(measured / runs.linear()[0, 0, own]) - 1.0, abs=1e-6)
        assert abs(found.run) > 0.02
        # What is left are products of motions with the diffraction load.
        assert found.displaced == pytest.approx(found.run, abs=0.15 * abs(found.run))
        assert abs(found.displaced - found.run) < 0.5 * abs(found.pressure - found.run)
    # Waves from ahead push her back.
    assert found.surge < -1.0


@pytest.mark.parametrize(("section", "stern"), [(0, 1.0), (-1, 0.0)])
def test_an_excess_as_large_as_the_load_of_the_waves_doubles_the_motion(
    base: Case, monkeypatch: pytest.MonkeyPatch, section: int, stern: float
) -> None:
    runs = RegularRuns(base, (0.2,), (1.0,), (0.05,), {})
    (case,) = runs.cases
    waves = case.seaway.components
    ship = LinearShip(case.ship, case.database(), case.supplementary)
    of_waves = ship.in_waves(waves.frequency, waves.wave_heading, np.array([case.speed]), np.zeros(1))
    load = np.zeros((3, 6), dtype=complex)
    load[section] = waves.amplitude[0] * (of_waves.froude_krylov[0] + of_waves.diffraction[0, 0])
    excess = ExcessLoad(np.arange(4.0), 1.5 * load, 0.5 * load)
    monkeypatch.setattr(excess_answer_module, "excess_load", lambda store, case: excess)
    store = MadeUpRuns(runs, lambda case: 1.1)
    found = excess_answer(store, case, Dof.PITCH)  # type: ignore[arg-type]
    # Rounding; that of the run is of samples.
    assert (found.pressure, found.stern) == pytest.approx((1.0, stern), abs=1e-9)
    assert found.run == pytest.approx(0.1, abs=1e-6)
    # She lies where she would be.
    assert (found.surge, found.displaced) == pytest.approx((0.0, found.pressure), abs=1e-9)


def test_causes_are_sought_at_the_steepness_that_is_shown(
    base: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = RegularRuns(base, (0.12, 0.2), (1.0, 2.0), (1 / 30, 1 / 20, 1 / 15), {})
    linear = np.ones((2, 2, 2), dtype=complex)
    transfer = np.ones((2, 2, 3, 2), dtype=complex)
    transfer[0, 1, 1, 0], transfer[0, 0, 2, 1], transfer[1, 0, 1, 1] = 0.8, 1.5, 1.04
    monkeypatch.setattr(regular_causes, "excess_answer", lambda store, case, mode: (case, mode))
    store = MadeUpRuns(runs, lambda case: 1.0)
    found = regular_causes.found_causes(store, runs, _measured(transfer), linear, 1)  # type: ignore[arg-type]
    assert found == {(0, 1, 0): (runs.by_index[0, 1, 1], Dof.HEAVE)}


def test_the_section_says_what_the_runs_show(study: RegularWaves, tmp_path: Path) -> None:
    grid = study.runs[SINUSOIDAL]
    store = MadeUpRuns(grid, lambda case: 1.03 if case.file.seaway.wave_theory == "stokes" else 1.0)
    section = study.section(store, tmp_path)
    assert [statement.holds for statement in section.statements] == [True, True]
    assert "+3 % in" in section.statements[0].figures
    assert not section.failures
    assert all((tmp_path / name).is_file() for name, _ in section.pictures)
    assert "| Stokes against sinusoidal | 1/20 | +3 | +3 |" in section.body
    rows = section.tables["regular_waves.csv"].splitlines()
    assert len(rows) == 1 + len(study.cases)
    first = dict(zip(rows[0].split(","), rows[1].split(","), strict=True))
    assert float(first["heave amplitude"]) == pytest.approx(float(first["heave frequency domain"]), rel=1e-5)
    assert float(first["heave phase [deg]"]) == pytest.approx(float(first["heave its phase [deg]"]), abs=1e-3)
    assert float(first["heave mean"]) == pytest.approx(0.1)
    flipped = study.section(MadeUpRuns(grid, lambda case: 1.08), tmp_path).statements
    assert [statement.holds for statement in flipped] == [True, False]
    assert "Fn 0.12" in flipped[1].remark and "Fn 0.2," in flipped[1].remark


def test_a_run_that_failed_is_told_and_holds_nothing(study: RegularWaves, tmp_path: Path) -> None:
    store = MadeUpRuns(study.runs[SINUSOIDAL], lambda case: 1.0, failed=4)
    section = study.section(store, tmp_path)
    assert section.failures[0] == "sinusoidal: Fn 0.2, λ/L 1.4, H/λ 1/20: made to fail"
    assert not any(statement.holds for statement in section.statements)


def test_stretching_compares_both_with_the_frequency_domain(base: Case, tmp_path: Path) -> None:
    study = Stretching(base, quick=True)
    assert {case.file.seaway.stretching for case in study.cases} == {"wheeler", "none"}
    grid = next(iter(study.runs.values()))
    store = MadeUpRuns(grid, lambda case: 1.1 if case.file.seaway.stretching == "none" else 1.01)
    section = study.section(store, tmp_path)
    (statement,) = section.statements
    assert statement.holds
    assert "Wheeler: heave 1 %, pitch 1 %; no stretching: heave 10 %, pitch 10 %" in statement.figures
    # The random runs are 1.01 for both linear and Wheeler.
    assert section.rms[0].difference[:, 0, 2] == pytest.approx([0.0, 0.0, 1.1 / 1.01 - 1.0], abs=1e-6)
