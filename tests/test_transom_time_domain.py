"""The end terms of a transom in the time domain: against the frequency domain, and with every scheme."""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.cli.respond import case_response
from panelsim.conventions import KNOT, ComplexArray, Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.speed_terms import radiation_at_speed
from panelsim.hydro.store import database_for
from panelsim.hydro.transom import Transom
from panelsim.loads.radiation import Radiation
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.simulate import simulate, simulate_batch
from panelsim.response.response import response
from panelsim.seaway.regular import RegularSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship
from panelsim.studies.run_case import run_case

RAMP, DURATION, STEP = 40.0, 260.0, 0.2  # s
SPRINGS = Supplementary(
    # TM 2003-190 section 8, and more damping so that what the start has stirred up dies within the run.
    stiffness={"surge": 5e5, "sway": 1e6, "yaw": 2e9},
    damping={"surge": 1e6, "sway": 2e6, "roll": 4e7, "yaw": 2e9},
)
SOURCES = pytest.mark.parametrize("source", ["bem", "strip"])


@cache
def halifax(source: str) -> tuple[Ship, HydroDatabase, Transom]:
    ship = load_ship("halifax", 6.0)
    database = HydroDatabase.compute(ship, "strip") if source == "strip" else database_for(ship)
    return ship, database, Transom.of_ship(ship, database.frequencies)


def impedance_of_states(radiation: Radiation, ship: int, omega: float) -> ComplexArray:
    """Minus the load per motion (6, 6) of motions exp(iωt), from the matrices of the time domain."""
    load, memory = radiation.load_matrix[ship], radiation.memory_matrix[ship]
    count = len(memory)
    by_motion = memory[:, :6] + 1j * omega * memory[:, 6:12]
    states = np.linalg.solve(1j * omega * np.eye(count) - memory[:, 12:], by_motion)
    inertial = -(omega**2) * radiation.added_mass_infinite
    return np.asarray(inertial - load[:, :6] - 1j * omega * load[:, 6:12] - load[:, 12:] @ states)


@SOURCES
@pytest.mark.parametrize("knots", [10.0, 20.0])
def test_the_end_terms_are_those_of_the_frequency_domain(source: str, knots: float) -> None:
    """What a transom adds to the radiation load, element by element, also where ω_e vanishes."""
    _, database, transom = halifax(source)
    speed = knots * KNOT
    bare, more = Radiation(database, [speed]), Radiation(database, [speed], transom)
    for omega in (0.0, 0.2, 0.6, 1.2, 2.0):
        found = impedance_of_states(more, 0, omega) - impedance_of_states(bare, 0, omega)
        at = np.array([omega])
        with_end, without = (radiation_at_speed(database, at, speed, t).impedance[0] for t in (transom, None))
        wanted = with_end - without
        # What the kernel and its exponentials may be off: 1 % each; at rest they are exact.
        scale = np.sqrt(np.abs(np.outer(np.diag(wanted), np.diag(wanted))))
        allowed = (0.02 if omega else 1e-4) * np.maximum(scale, np.abs(wanted))
        if omega:
            # Sway, roll and yaw of a section 0.3 m deep: 10⁻⁴ and less of what the hull has.
            allowed[np.ix_([1, 3, 5], [1, 3, 5])] *= 2.0
        assert (np.abs(found - wanted) <= allowed + 1e-9 * np.abs(wanted).max()).all(), omega
        assert np.abs(wanted[4, 4]) > 0.0


def fitted(history: History, omega: float, speed: float, beta: float) -> ComplexArray:
    """Motions (6,) per metre of wave, exp(+iω_e t), by least squares over the last half of a run."""
    encounter = omega - omega**2 / 9.80665 * speed * np.cos(beta)
    last = history.time > RAMP + 0.5 * DURATION
    phase = encounter * history.time[last]
    design = np.stack([np.cos(phase), -np.sin(phase), np.ones_like(phase)], axis=1)
    in_phase, ahead, _ = np.linalg.lstsq(design, history.displacement[last], rcond=None)[0]
    return np.asarray(in_phase + 1j * ahead)


WAVES = [
    (knots, heading, omega)
    for knots in (10.0, 20.0)
    for heading, omegas in ((180, (0.45, 0.7)), (130, (0.5, 0.75)), (50, (0.45, 0.7)))
    for omega in omegas
]


@SOURCES
def test_the_linear_model_is_the_response_with_transom_terms(source: str) -> None:
    ship, database, transom = halifax(source)
    seas = [RegularSeaway(1.0, w, float(np.radians(h))) for _, h, w in WAVES]
    runs = simulate_batch(
        ship,
        seas,
        speed=[knots * KNOT for knots, _, _ in WAVES],
        duration=DURATION,
        time_step=STEP,
        ramp=RAMP,
        database=database,
        model="linear",
        supplementary=SPRINGS,
        transom=transom,
    )
    worst, gained = 0.0, 0.0
    for (knots, heading, omega), run in zip(WAVES, runs, strict=True):
        beta = np.radians(heading)
        wanted, bare = (
            response(
                ship,
                database,
                frequencies=[omega],
                wave_headings=[beta],
                speeds=[knots * KNOT],
                supplementary=SPRINGS,
                transom=t,
            ).transfer[0, 0, 0]
            for t in (transom, None)
        )
        slope = np.where(np.arange(6) < 3, 1.0, omega**2 / ship.gravity)
        found = fitted(run, omega, knots * KNOT, beta)
        worst = max(worst, float((np.abs(found - wanted) / slope).max()))
        gained = max(gained, float((np.abs(bare - wanted) / slope)[[Dof.HEAVE, Dof.PITCH]].max()))
    print(f"{source}: worst {worst:.4f} of wave amplitude or slope; the terms change up to {gained:.3f}")
    # Memory is within 1 % of the coefficients, and the motions are of the order of the waves.
    assert worst < 0.02
    assert gained > 0.08


def short_run(ship: Ship, database: HydroDatabase, **given: object) -> History:
    """A run in a bow quartering wave, 10 knots unless a speed is given."""
    asked = {"speed": 10 * KNOT, "duration": 30.0, "time_step": STEP, "ramp": 5.0, "supplementary": SPRINGS}
    sea = RegularSeaway(0.5, 0.6, float(np.radians(130)))
    return simulate(ship, sea, database=database, **asked | given)


def same_bits(one: History, other: History) -> bool:
    signals = ("displacement", "velocity", "acceleration")
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in signals) and all(
        np.array_equal(load, other.loads[name]) for name, load in one.loads.items()
    )


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_ship_at_rest_has_no_end_terms(model: str) -> None:
    ship, database, transom = halifax("bem")
    still = {"speed": 0.0, "duration": 10.0, "model": model}
    with_end, without = (short_run(ship, database, transom=t, **still) for t in (transom, None))
    assert same_bits(with_end, without)
    assert with_end.notes == without.notes


def test_the_nonlinear_model_has_them_too() -> None:
    """In a wave of 1 cm it is the linear model, and it says what it has."""
    ship, database, transom = halifax("bem")
    sea = RegularSeaway(0.01, 0.6, float(np.radians(130)))
    asked = {"speed": 20 * KNOT, "duration": 30.0, "time_step": STEP, "ramp": 5.0, "database": database}
    linear, whole = (
        simulate(ship, sea, model=model, supplementary=SPRINGS, transom=transom, **asked)
        for model in ("linear", "nonlinear")
    )
    bare = simulate(ship, sea, supplementary=SPRINGS, **asked)
    peak = np.abs(linear.displacement).max(axis=0)
    # Of second order: a millimetre of heave at 1 cm would be 10 %.
    assert (np.abs(whole.displacement - linear.displacement).max(axis=0) < 0.01 * peak).all()
    assert np.abs(whole.displacement - bare.displacement)[:, Dof.PITCH].max() > 0.04 * peak[Dof.PITCH]
    assert any("transom" in note for note in whole.notes)
    assert not any("transom" in note for note in bare.notes)


@pytest.mark.parametrize("stepper", ["rk4", "ab3"])
def test_every_scheme_steps_them(stepper: str) -> None:
    """The exponential scheme is exact in the linear model; the others err as the cube of ω_e dt, or less."""
    ship, database, transom = halifax("bem")
    fine = {"time_step": 0.05, "model": "linear", "transom": transom}
    exact, stepped = (short_run(ship, database, stepper=name, **fine) for name in ("exponential", stepper))
    error = np.abs(stepped.displacement - exact.displacement).max(axis=0)
    print(stepper, error / np.abs(exact.displacement).max(axis=0))
    assert (error < 1e-3 * np.abs(exact.displacement).max(axis=0)).all()


def test_a_batch_has_the_bits_of_its_runs_alone() -> None:
    ship, database, transom = halifax("strip")
    seas = [RegularSeaway(0.5, 0.6, float(np.radians(h))) for h in (130, 40)]
    speeds = [10 * KNOT, 20 * KNOT]
    shared = {"duration": 20.0, "time_step": STEP, "ramp": 5.0, "database": database, "transom": transom}
    runs = simulate_batch(ship, seas, speed=speeds, **shared)
    for sea, speed, run in zip(seas, speeds, runs, strict=True):
        assert same_bits(run, simulate(ship, sea, speed=speed, **shared))


def test_a_run_goes_on_bit_for_bit_and_only_with_the_same_terms() -> None:
    ship, database, transom = halifax("bem")
    whole = short_run(ship, database, transom=transom)
    begun = short_run(ship, database, transom=transom, duration=12.0)
    assert same_bits(short_run(ship, database, transom=transom, resume=begun), whole)
    with pytest.raises(PanelsimError, match="its choice of transom terms is another"):
        short_run(ship, database, resume=begun)


def test_ships_at_rest_go_in_a_batch_of_their_own() -> None:
    ship, database, transom = halifax("bem")
    with pytest.raises(PanelsimError, match="at rest beside ships under way") as refusal:
        simulate_batch(
            ship,
            [RegularSeaway(0.5, 0.6, 3.0)] * 3,
            speed=[0.0, 5.0, 5.0],
            duration=10.0,
            time_step=STEP,
            database=database,
            transom=transom,
        )
    assert "1 of 3 at rest" in str(refusal.value)


def test_what_is_no_transom_of_this_ship_is_refused() -> None:
    ship, database, _ = halifax("bem")
    other = load_ship("frigate", 6.0)
    with pytest.raises(PanelsimError, match="transom is of another ship than") as refusal:
        short_run(ship, database, transom=Transom.of_ship(other, database.frequencies))
    assert "Transom.of_ship" in str(refusal.value)
    with pytest.raises(PanelsimError, match="The transom is of another kind"):
        short_run(ship, database, transom=True)


# --- in a case


SMALL_CASE = """
[ship]
hull = "{hull}"
panel_area = {area}
[hydrodynamics]
transom_terms = true
[seaway]
kind = "regular"
wave_height = 2.0
wave_frequency = 0.7
wave_heading_deg = 180
[run]
speed_knots = 20
model = "linear"
time_step = 0.2
duration = 10
ramp = 0
"""


def case_file(folder: Path, hull: str, area: float) -> Path:
    path = folder / "case.toml"
    path.write_text(SMALL_CASE.format(hull=hull, area=area), encoding="utf-8")
    return path


def test_a_case_has_them_in_both_domains(tmp_path: Path) -> None:
    case = Case.load(case_file(tmp_path, "halifax", 12.0))
    assert isinstance(case.transom(case.database()), Transom)
    still, sides = np.array([0.0, 20 * KNOT]), np.array([np.pi])
    bare = Case.load(case_file(tmp_path, "halifax", 12.0), ["hydrodynamics.transom_terms=false"])
    assert bare.transom(bare.database()) is None
    with_end, without = (case_response(c, sides, still, {}).table.transfer for c in (case, bare))
    np.testing.assert_array_equal(with_end[0], without[0])
    pitch = np.abs(with_end[1, ..., Dof.PITCH]).max() / np.abs(without[1, ..., Dof.PITCH]).max()
    assert pitch < 0.99


def test_a_case_of_a_hull_without_a_transom_writes_nothing(tmp_path: Path) -> None:
    case = Case.load(case_file(tmp_path, "wigley_iii", 0.005))
    with pytest.raises(PanelsimError, match="no wet transom"):
        run_case(case, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_the_code_of_the_page_runs() -> None:
    page = (Path(__file__).parents[1] / "docs" / "transom.md").read_text(encoding="utf-8")
    names: dict[str, object] = {}
    for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL):
        exec(block, names)
    assert names["history"].outcome == "finished"  # type: ignore[attr-defined]
