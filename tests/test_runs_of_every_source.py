"""Time-domain runs with coefficients by strip theory and from elsewhere: as the response, and kept memory."""

from functools import cache

import numpy as np
import pytest

from panelsim.conventions import KNOT, ComplexArray, Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.memory import memory_functions
from panelsim.hydro.memory_states import memory_states
from panelsim.hydro.radiation_dataset import radiation_dataset
from panelsim.loads.radiation import Radiation
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.simulate import simulate
from panelsim.response.response import response
from panelsim.seaway.regular import RegularSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

SPEED, OMEGA, BETA = 10 * KNOT, 0.6, float(np.radians(130))
ENCOUNTER = OMEGA - OMEGA**2 / 9.80665 * SPEED * np.cos(BETA)
NAMES = pytest.mark.parametrize("name", ["frigate", "s175"])


@cache
def by_strips(name: str) -> tuple[Ship, HydroDatabase]:
    ship = load_ship(name)
    return ship, HydroDatabase.compute(ship, "strip")


@cache
def from_elsewhere() -> tuple[Ship, HydroDatabase]:
    """A frigate's strips as another program writes them: tables at rest, no potentials, nothing in surge."""
    ship, strips = by_strips("frigate")
    waves, headings = np.arange(0.3, 0.95, 0.1), np.radians(np.arange(-165.0, 180.1, 15.0))
    table = np.array([diffraction_load(strips, np.full(len(headings), w), headings, 0.0) for w in waves])
    dims = ("wave_frequency", "wave_heading", "influenced_dof")
    dataset = strips.dataset[["added_mass", "radiation_damping", "added_mass_infinite"]].assign(
        diffraction_real=(dims, table.real), diffraction_imag=(dims, table.imag)
    )
    return ship, HydroDatabase(dataset.assign_coords(wave_frequency=waves, wave_heading=headings))


def springs(ship: Ship) -> Supplementary:
    """Such that what the start stirs up dies within the run, by Froude's law from HALIFAX."""
    size = ship.mass / 3.7e6
    area, lever = size ** (2 / 3), size ** (4 / 3)
    stiffness = {"surge": 5e5 * area, "sway": 1e6 * area, "yaw": 2e9 * lever}
    damping = {"surge": 1e6 * size, "sway": 2e6 * size, "roll": 4e7 * area * size, "yaw": 2e9 * area * size}
    return Supplementary(stiffness=stiffness, damping=damping)


def run(ship: Ship, database: HydroDatabase, **given: object) -> History:
    asked = {"duration": 300.0, "ramp": 40.0, "time_step": 0.2, "model": "linear"}
    sea = RegularSeaway(0.01, OMEGA, BETA)
    return simulate(ship, sea, speed=SPEED, database=database, supplementary=springs(ship), **asked | given)


def transfer(history: History) -> ComplexArray:
    """Motions (6,) per metre of wave, exp(+iω_e t), over the last 150 s."""
    last = history.time > history.time[-1] - 150.0
    phase = ENCOUNTER * history.time[last]
    design = np.stack([np.cos(phase), -np.sin(phase), np.ones_like(phase)], axis=1)
    in_phase, ahead, _ = np.linalg.lstsq(design, history.displacement[last], rcond=None)[0]
    return np.asarray(in_phase + 1j * ahead) / 0.01


def expected(ship: Ship, database: HydroDatabase) -> ComplexArray:
    table = response(
        ship,
        database,
        frequencies=[OMEGA],
        wave_headings=[BETA],
        speeds=[SPEED],
        supplementary=springs(ship),
    )
    return table.transfer[0, 0, 0]


def off(found: ComplexArray, wanted: ComplexArray) -> float:
    """Largest difference in wave amplitudes and slopes."""
    slope = np.where(np.arange(6) < 3, 1.0, OMEGA**2 / 9.80665)
    return float((np.abs(found - wanted) / slope).max())


@NAMES
def test_a_linear_run_with_strips_is_their_response(name: str) -> None:
    ship, database = by_strips(name)
    error = off(transfer(run(ship, database)), expected(ship, database))
    print(f"{name}: {error:.4f} of wave amplitude or slope, {database.memory_states.count} states")
    # Memory is within 1 % of the coefficients, and the motions are of the order of the waves.
    assert error < 0.02


@NAMES
def test_a_nonlinear_run_with_strips_in_small_waves_is_the_linear_one(name: str) -> None:
    ship, database = by_strips(name)
    linear, whole = (run(ship, database, duration=25.0, ramp=5.0, model=m) for m in ("linear", "nonlinear"))
    peak = np.abs(linear.displacement).max(axis=0)
    # What is of second order at a wave of 1 cm, and what the panels of a nonlinear hull add to it.
    assert (np.abs(whole.displacement - linear.displacement).max(axis=0) < 0.01 * peak).all()


def test_a_linear_run_with_tables_from_elsewhere_is_their_response() -> None:
    ship, database = from_elsewhere()
    assert not database.added_mass[:, Dof.SURGE].any() and not database.has_potentials
    assert off(transfer(run(ship, database)), expected(ship, database)) < 0.02
    assert run(ship, database, duration=5.0, ramp=0.0, model="nonlinear").outcome == "finished"


def test_a_motion_that_makes_no_waves_has_no_memory() -> None:
    _, database = by_strips("frigate")
    states = database.memory_states
    assert not states.entrance[:, Dof.SURGE].any() and not states.momentum[Dof.SURGE].any()
    held = -np.linalg.solve(states.transition, states.entrance)
    wanted = database.added_mass_zero - database.memory.added_mass_infinite
    # To rounding of the largest, in pitch.
    np.testing.assert_allclose(states.momentum @ held, wanted, rtol=0, atol=1e-9 * np.abs(wanted).max())
    assert states.error < 0.003


# --- memory is found once


def test_memory_is_found_once_for_a_database(monkeypatch: pytest.MonkeyPatch) -> None:
    ship, stored = by_strips("frigate")
    database = HydroDatabase(stored.dataset)
    calls: list[object] = []

    def counted(of: HydroDatabase) -> object:
        calls.append(of)
        return memory_functions(of)

    monkeypatch.setattr("panelsim.hydro.database.memory_functions", counted)
    for _ in range(2):
        run(ship, database, duration=2.0, ramp=0.0)
    assert calls == [database]
    assert Radiation(database, [0.0]).states is database.memory_states


def test_what_is_kept_is_what_would_be_found_and_cannot_be_changed() -> None:
    _, database = by_strips("frigate")
    again = memory_functions(HydroDatabase(database.dataset))
    np.testing.assert_array_equal(again.momentum_kernel, database.memory.momentum_kernel)
    np.testing.assert_array_equal(memory_states(again).transition, database.memory_states.transition)
    for kept in (
        database.memory.momentum_kernel,
        database.memory.added_mass_infinite,
        database.memory_states.transition,
    ):
        with pytest.raises(ValueError, match="read-only"):
            kept += 1.0


# --- what is refused


def test_negative_damping_of_strips_is_refused_with_its_frequency_and_motion() -> None:
    omega = np.array([0.0, 0.5, 1.0, 1.5])
    inertia = np.tile(np.diag([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).astype(complex), (5, 1, 1)) * 1e6
    inertia[1:4] *= 1.0 - 0.3j
    inertia[2, Dof.SWAY, Dof.SWAY] = 2e6 * (1.0 + 0.1j)
    corners = np.array([[[0.0, 1.0, -1.0]] * 4])
    with pytest.raises(PanelsimError, match="negative radiation damping in sway") as refusal:
        radiation_dataset(omega, inertia, np.zeros((5, 6, 1), complex), corners, mirror_symmetric=True)
    assert "at 1 rad/s" in str(refusal.value)


@pytest.mark.parametrize("source", [lambda: by_strips("frigate"), from_elsewhere], ids=["strip", "elsewhere"])
def test_negative_damping_in_a_file_is_refused_with_its_frequency_and_motion(source, tmp_path) -> None:
    _, database = source()
    damping = database.radiation_damping.copy()
    damping[20, Dof.HEAVE, Dof.HEAVE] *= -1.0
    dims = database.dataset["radiation_damping"].dims
    dataset = database.dataset.assign(radiation_damping=(dims, damping))
    stored = HydroDatabase.of_ship(by_strips("frigate")[0], dataset)
    stored.save(tmp_path / "changed.nc")
    with pytest.raises(PanelsimError, match="negative radiation damping in heave") as refusal:
        HydroDatabase.load(tmp_path / "changed.nc")
    assert f"at {database.frequencies[20]:.3g} rad/s" in str(refusal.value)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_run_in_waves_outside_the_tables_is_refused(model: str) -> None:
    ship, database = from_elsewhere()
    asked = {"speed": SPEED, "duration": 5.0, "time_step": 0.2, "database": database, "model": model}
    with pytest.raises(PanelsimError, match="do not hold the frequency of 1 of 1 waves") as refusal:
        simulate(ship, RegularSeaway(0.01, 1.2, BETA), **asked)
    assert "0.3 to 0.9 rad/s" in str(refusal.value)


def test_a_run_in_waves_that_strips_do_not_resolve_says_so() -> None:
    ship, database = by_strips("frigate")
    asked = {"speed": 20 * KNOT, "duration": 5.0, "ramp": 0.0, "time_step": 0.1, "database": database}
    history = simulate(ship, RegularSeaway(0.01, 2.0, np.pi), model="linear", **asked)
    assert any("beyond the 5.00 rad/s" in note for note in history.notes)
