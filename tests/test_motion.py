"""Whole runs: rest, decay, the sum of the loads, the same bits again, and the ends that a run can have."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from panelsim.conventions import DOF_NAMES, KNOT
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.memory import memory_functions
from panelsim.hydro.store import database_for
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.radiation import speed_coupling
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.march import Limits
from panelsim.motion.simulate import simulate
from panelsim.motion.stability import Stability
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

Run = Callable[..., History]

TWENTY_KNOTS = 20 * KNOT
NO_SPRINGS = Supplementary()
RELEASED = (0.0, 0.0, 1.0, np.deg2rad(5.0), np.deg2rad(1.0), 0.0)


def sea_state_7(heading_deg: float = 150.0, seed: int = 1001) -> RandomSeaway:
    """The sea of TM 2003-190 section 8.4."""
    frequencies = np.linspace(0.2, 2.0, 19)
    return RandomSeaway(Bretschneider(7.5, 15.0), frequencies, np.deg2rad(heading_deg), seed)


# Head waves that meet the ship at 12.4 rad/s at 20 knots, 0.5 s apart.
SHORT_WAVES = WaveComponents(np.array([0.05]), np.array([3.0]), np.array([np.pi]), np.zeros(1))


# --- rest ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["nonlinear", "linear"])
@pytest.mark.parametrize(("speed", "sprung"), [(0.0, True), (0.0, False), (TWENTY_KNOTS, True)])
def test_a_ship_at_rest_stays_at_rest(
    speed: float, sprung: bool, model: str, run_halifax: Run, springs: Supplementary
) -> None:
    """Calm water, 600 s: less than 1 mm and 1e-5 rad of drift."""
    held = springs if sprung else NO_SPRINGS
    history = run_halifax(speed=speed, duration=600.0, model=model, supplementary=held)
    assert history.outcome == "finished"
    drift = np.abs(history.displacement).max(axis=0)
    print(f"drift {drift[:3].max():.1e} m, {drift[3:].max():.1e} rad")
    # Asked for is 1 mm and 1e-5 rad; what is there is rounding.
    assert drift[:3].max() < 1e-9
    assert drift[3:].max() < 1e-10


def test_without_springs_a_ship_under_way_broaches_at_the_rate_of_munks_moment(
    run_halifax: Run, halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """At 20 knots the smallest yaw grows as exp(σt), with det(σ²M + (σ − Lᵀ)Ã(σ)(σ + L) + C) = 0.

    Ã(σ) = A∞ + ∫R exp(−σs) ds. This is a property of the potential flow (no rudder, no lift), and why
    TM 2003-190 ties the ship to springs.
    """
    functions = memory_functions(halifax_database)
    coupling, unit = speed_coupling(TWENTY_KNOTS), np.eye(6)

    def characteristic(rate: float) -> float:
        decay = np.exp(-rate * functions.time)[:, None, None]
        memory = np.trapezoid(functions.momentum_kernel * decay, functions.time, axis=0)
        added = functions.added_mass_infinite + memory
        radiation = (rate * unit - coupling.T) @ added @ (rate * unit + coupling)
        impedance = rate**2 * halifax.inertia + radiation + halifax.hydrostatics.stiffness
        free = np.array([1, 3, 5])  # sway, roll, yaw
        scale = np.sqrt(np.diag(halifax.inertia))[free]
        return float(np.linalg.det(impedance[np.ix_(free, free)] / np.outer(scale, scale)))

    expected = brentq(characteristic, 0.05, 1.0)
    history = run_halifax(
        speed=TWENTY_KNOTS,
        duration=100.0,
        supplementary=NO_SPRINGS,
        model="linear",
        initial_displacement=(0, 0, 0, 0, 0, 1e-9),
    )
    yaw = np.abs(history.displacement[:, 5])
    late = history.time > 60.0
    measured = np.polyfit(history.time[late], np.log(yaw[late]), 1)[0]
    print(f"growth {measured:.4f} 1/s, characteristic equation {expected:.4f} 1/s")
    # dt 0.2 s against an e-folding of 5 s: (σ dt)²/12 is 1e-4.
    assert measured == pytest.approx(expected, rel=1e-3)
    # From rest nothing but rounding is there to grow: exp(0.18 * 100 s) is 1e8.
    at_rest = run_halifax(speed=TWENTY_KNOTS, duration=100.0, supplementary=NO_SPRINGS)
    assert np.abs(at_rest.displacement).max() < 1e-5


@pytest.mark.parametrize("model", ["nonlinear", "linear"])
@pytest.mark.parametrize("speed", [0.0, TWENTY_KNOTS])
def test_a_released_ship_comes_to_rest_at_its_equilibrium(speed: float, model: str, run_halifax: Run) -> None:
    """Lifted 1 m, heeled 5°, trimmed 1°: within 1 mm and 1e-4 rad after 600 s, on its springs."""
    history = run_halifax(speed=speed, duration=600.0, model=model, initial_displacement=RELEASED)
    late = np.abs(history.displacement[history.time > 590.0]).max(axis=0)
    print(f"left after 590 s: {late[:3].max():.1e} m, {late[3:].max():.1e} rad")
    assert late[:3].max() < 1e-3
    assert late[3:].max() < 1e-4
    # It was let go from where it was put, upwards and heeled to starboard, and fell back.
    np.testing.assert_array_equal(history.displacement[0], RELEASED)
    assert (history.acceleration[0, [2, 3, 4]] < 0).all()


def test_buoyancy_does_not_yaw_a_rolling_ship(run_halifax: Run) -> None:
    """Calm water has no moment about the vertical, whatever the heel and the trim of the decay."""
    history = run_halifax(duration=30.0, initial_displacement=(0, 0, 0, 0.35, 0.03, 0.2))
    wetted = history.loads["wetted_surface"]
    # Rounding of sums over 2500 panels.
    assert np.abs(wetted[:, 5]).max() < 1e-10 * np.abs(wetted[:, 3]).max()


# --- books that balance --------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["nonlinear", "linear"])
def test_loads_sum_to_mass_times_acceleration(model: str, run_halifax: Run, halifax: Ship) -> None:
    """At every instant, to 1e-9 of the largest load."""
    history = run_halifax(sea_state_7(), speed=TWENTY_KNOTS, ramp=20.0, model=model)
    total = np.sum(list(history.loads.values()), axis=0)
    largest = np.max([np.abs(load).max(axis=0) for load in history.loads.values()], axis=0)
    error = np.abs(total - history.acceleration @ halifax.inertia) / largest
    print(f"{model}: {error.max():.1e} of the largest load")
    assert error.max() < 1e-9
    assert set(history.loads) >= {"radiation", "diffraction", "supplementary"}


@pytest.mark.parametrize("model", ["nonlinear", "linear"])
def test_motion_is_the_integral_of_the_recorded_acceleration(model: str, run_halifax: Run) -> None:
    """Velocity and displacement follow from the recorded rates by Simpson's rule, to its error."""
    history = run_halifax(sea_state_7(), speed=TWENTY_KNOTS, ramp=20.0, time_step=0.1, model=model)
    for rate, value in (
        (history.acceleration, history.velocity),
        (history.velocity, history.displacement),
    ):
        three = rate[:-2] + 4 * rate[1:-1] + rate[2:]
        error = np.abs(value[2:] - value[:-2] - 0.1 / 3 * three).max(axis=0) / np.abs(value).max(axis=0)
        print(f"{model}: {error.max():.1e}")
        # (ω dt)⁵/90 of the shortest wave met, ω_e = 5.6 rad/s, is 6e-4 of its small share of the motion;
        # the factor 1/3 wrong, or rates a step late, would be 1e-2 or more.
        assert error.max() < 1e-3


def test_the_same_seed_gives_the_same_bits_and_another_does_not(run_halifax: Run) -> None:
    first, second, other = (
        run_halifax(sea_state_7(seed=seed), speed=TWENTY_KNOTS, ramp=10.0, duration=20.0)
        for seed in (7, 7, 8)
    )
    assert first.same_bits(second)
    assert not first.same_bits(other)


PROCESS = """
import sys
import numpy as np
from panelsim.hydro.store import database_for
from panelsim.motion.simulate import simulate
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.bundled import load_ship

ship = load_ship("halifax", 2.5)
base = database_for(ship)
sea = RandomSeaway(Bretschneider(7.5, 15.0), np.linspace(0.2, 2.0, 19), np.deg2rad(150), 7)
history = simulate(ship, sea, speed=10.0, duration=20.0, time_step=0.2, ramp=10.0, database=base)
history.save(sys.argv[1])
"""


def test_another_process_gives_the_same_bits(run_halifax: Run, tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-c", PROCESS, str(tmp_path / "other.nc")], check=True, timeout=300)
    here = run_halifax(sea_state_7(seed=7), speed=10.0, ramp=10.0, duration=20.0, supplementary=NO_SPRINGS)
    assert here.same_bits(History.load(tmp_path / "other.nc"))


def test_a_run_is_the_beginning_of_a_longer_run(run_halifax: Run) -> None:
    short, long = (
        run_halifax(sea_state_7(), speed=TWENTY_KNOTS, ramp=10.0, duration=duration)
        for duration in (10.0, 30.0)
    )
    count = len(short.time)
    assert count == 101
    np.testing.assert_array_equal(short.displacement, long.displacement[:count])
    np.testing.assert_array_equal(short.loads["radiation"], long.loads["radiation"][:count])
    np.testing.assert_array_equal(short.wave_elevation, long.wave_elevation[:count])


# --- ends ----------------------------------------------------------------------------------------


def test_a_ship_without_stability_capsizes_and_keeps_its_history() -> None:
    """Wigley hull I, KG assumed 0.17 m, has GM −0.028 m: from 1° of heel it turns over, to that side."""
    ship = load_ship("wigley_i")
    assert ship.hydrostatics.gm_transverse < 0
    history = simulate(
        ship,
        CalmSeaway(),
        speed=0.0,
        duration=60.0,
        time_step=0.02,
        ramp=0.0,
        database=database_for(ship),
        initial_displacement=(0, 0, 0, np.deg2rad(1.0), 0, 0),
    )
    print(history.attrs["outcome_detail"])
    assert history.outcome == "capsized"
    assert history.attrs["outcome_detail"].startswith("roll 9")
    assert 0 < history.time[-1] < 60.0
    assert history.finite.all()
    # The last row is the last before the limit: within one step of 90°.
    assert np.deg2rad(80.0) < history.displacement[-1, 3] < np.pi / 2


@pytest.mark.parametrize("model", ["nonlinear", "linear"])
@pytest.mark.parametrize(
    ("given", "cause"),
    [
        ({"supplementary": Supplementary(damping={"heave": 1e12}), "stepper": "rk4"}, "limit"),
        ({"supplementary": Supplementary(damping={"heave": 1e300}), "stepper": "ab3"}, "no longer finite"),
        ({"initial_velocity": (0, 0, 0, 0, 1e200, 0)}, "limit"),
        ({"initial_displacement": (0, 0, 1e300, 0, 0, 0)}, "limit"),
    ],
)
def test_a_motion_without_bounds_ends_diverged(
    given: dict[str, object], cause: str, model: str, run_halifax: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No traceback, no overflow warning (they are errors here), and the rows so far are numbers.

    Steps at which linear motions are unstable are refused; so that some are, they are let through.
    """
    monkeypatch.setattr(Stability, "require", lambda self, time_step: None)
    history = run_halifax(sea_state_7(), model=model, speed=TWENTY_KNOTS, **given)
    assert history.outcome == "diverged"
    assert cause in history.attrs["outcome_detail"]
    assert len(history.attrs["outcome_detail"]) < 80
    assert len(history.time) >= 1
    assert all(np.isfinite(load).all() for load in history.loads.values())
    assert history.finite.all()


def test_an_interrupt_keeps_what_was_computed(run_halifax: Run) -> None:
    """Ctrl-C, here from the progress display, leaves the beginning of the whole run."""
    told: list[tuple[float, float]] = []

    def stop(done: float, total: float) -> None:
        told.append((done, total))
        if done >= 20.0:
            raise KeyboardInterrupt

    cut = run_halifax(sea_state_7(), progress=stop)
    whole = run_halifax(sea_state_7())
    assert cut.outcome == "interrupted"
    assert "20 s" in cut.attrs["outcome_detail"]
    assert told[0] == (0.0, 60.0)
    assert cut.time[-1] == pytest.approx(20.0)
    np.testing.assert_array_equal(cut.displacement, whole.displacement[: len(cut.time)])


def test_limits_name_the_outcome() -> None:
    """A large roll is a capsizing; all else, and half a turn within one step, is a diverged motion."""
    limits = Limits(capsize_angle=np.pi / 2, heave=60.0, drift=12000.0)
    unlimited = Limits(capsize_angle=0.0, heave=60.0, drift=12000.0)

    def outcome(limits: Limits, *, roll_before: float = 0.0, **at: float) -> str | None:
        before = np.array([0.0, 0.0, 0.0, roll_before, 0.0, 0.0])
        ended = limits.exceeded(np.array([at.get(name, 0.0) for name in DOF_NAMES]), before)
        return None if ended is None else ended[0]

    assert outcome(limits, roll=-1.5, yaw=1.0, surge=5000.0) is None
    assert outcome(limits, yaw=-1.1) == "diverged"
    assert outcome(limits, roll=-1.6, roll_before=-1.5) == "capsized"
    assert outcome(limits, roll=1.6, roll_before=-1.5) == "diverged"
    # 45° in a step part the two.
    assert outcome(limits, roll=1.6, roll_before=0.83) == "capsized"
    assert outcome(limits, roll=1.6, roll_before=0.8) == "diverged"
    assert outcome(limits, roll=1.6, roll_before=1.5, heave=1e9) == "diverged"
    assert outcome(limits, pitch=-1.1) == "diverged"
    assert outcome(limits, surge=9000.0, sway=-9000.0) == "diverged"
    assert outcome(unlimited, roll=3.0) is None


def test_the_quick_look_at_the_limits_misses_none() -> None:
    """Inside `safe` no limit is exceeded; just beyond, all are but the drift, which is a hypotenuse."""
    limits = Limits(capsize_angle=1.2, heave=60.0, drift=12000.0)
    rest = np.zeros(6)
    for signs in np.random.default_rng(1).choice([-1.0, 1.0], (64, 6)):
        assert limits.exceeded(signs * limits.safe, rest) is None
    for dof in (2, 3, 4, 5):
        assert limits.exceeded(-1.0001 * limits.safe[dof] * np.eye(6)[dof], rest) is not None
    assert Limits(capsize_angle=0.0, heave=60.0, drift=12000.0).safe[3] == np.inf


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"time_step": 0.0}, "The time_step is out of range"),
        ({"time_step": np.nan}, "The time_step is out of range"),
        ({"speed": -1.0}, "The speed is out of range"),
        ({"duration": 0.0}, "The duration is out of range"),
        ({"ramp": -1.0}, "The ramp is out of range"),
        ({"capsize_angle": 4.0}, "The capsize_angle is out of range"),
        ({"model": "weakly nonlinear"}, "Unknown model"),
        ({"stretching": "chang"}, "stretching"),
        ({"model": "linear", "stretching": "chang"}, "stretching"),
        ({"time_step": 2.0}, "too long for the motions of the ship"),
        ({"supplementary": Supplementary(stiffness={"roll": 1e15})}, "too long for the motions of the ship"),
        ({"supplementary": Supplementary(damping={"heave": 1e300})}, "change too fast for the exponential"),
        ({"stepper": "euler"}, "Unknown stepper"),
        ({"seaway": SHORT_WAVES, "time_step": 0.4, "speed": TWENTY_KNOTS}, "too long for the waves"),
        ({"time_step": 1e-4, "duration": 1e5}, "too many steps"),
        ({"database": "halifax.nc"}, "The database is of another kind"),
        ({"supplementary": {}}, "The supplementary is of another kind"),
        ({"notes": "abc"}, "The notes are no list of texts"),
        ({"initial_displacement": "here"}, "initial_displacement is not six finite numbers"),
        ({"initial_displacement": (0, 0, 0)}, "initial_displacement is not six finite numbers"),
        ({"initial_velocity": (np.inf,) * 6}, "initial_velocity is not six finite numbers"),
    ],
)
def test_what_cannot_be_run_is_refused(given: dict[str, object], words: str, run_halifax: Run) -> None:
    with pytest.raises(PanelsimError, match=words):
        run_halifax(**given)


def test_the_database_of_another_ship_is_refused(halifax_database: HydroDatabase) -> None:
    frigate = load_ship("frigate", 5.0)
    with pytest.raises(PanelsimError, match="computed for another ship than frigate"):
        simulate(frigate, CalmSeaway(), speed=0.0, duration=1.0, time_step=0.2, database=halifax_database)


# --- where the ship is, and when ---------------------------------------------------------------------


def test_a_ship_that_starts_elsewhere_moves_as_in_the_waves_that_are_there(
    run_halifax: Run, halifax: Ship
) -> None:
    """Without springs a run from (30, −12) m is the run from the origin in waves of shifted phase.

    Both the incident and the scattered wave must be taken where the ship is: with diffraction at the
    moving origin heave differs by 30 %.
    """
    omega, beta = np.array([0.5, 0.8]), np.deg2rad([150.0, 60.0])
    k = omega**2 / halifax.gravity
    start = np.array([30.0, -12.0, 0, 0, 0, 0])
    shift = k * (start[0] * np.cos(beta) - start[1] * np.sin(beta))
    there = WaveComponents(np.array([1.0, 0.7]), omega, beta, np.array([0.3, 1.1]))
    here = WaveComponents(there.amplitude, omega, beta, there.phase - shift)
    given = {"supplementary": NO_SPRINGS, "duration": 40.0}
    moved = run_halifax(there, initial_displacement=start, **given).displacement - start
    expected = run_halifax(here, **given).displacement
    # Rounding of phases, carried through 40 s.
    np.testing.assert_allclose(moved, expected, atol=1e-9)


def test_the_ramp_fades_in_the_waves_and_every_load_of_theirs(run_halifax: Run) -> None:
    """Linear wave loads do not depend on the motion: in the ramp ½(1 − cos(πt/ramp)) of the full ones."""
    sea = sea_state_7()
    faded, full = (run_halifax(sea, model="linear", duration=20.0, ramp=r) for r in (10.0, 0.0))
    time = full.time
    factor = np.where(time < 10.0, 0.5 * (1 - np.cos(np.pi * time / 10.0)), 1.0)
    rows = slice(0, len(time))
    np.testing.assert_allclose(faded.wave_elevation[rows], factor * full.wave_elevation, atol=1e-12)
    for name in ("froude_krylov", "diffraction"):
        load = full.loads[name]
        np.testing.assert_allclose(
            faded.loads[name][rows], factor[:, None] * load, atol=1e-12 * np.abs(load).max()
        )


def test_a_ship_held_askew_at_speed_starts_with_its_steady_radiation_load(
    run_halifax: Run, halifax_database: HydroDatabase
) -> None:
    """Held pitched and yawed until t = 0 the water has the momentum A(0) L η: F = Lᵀ A(0) L η − A∞ η̈.

    That is the Munk moment and its like in pitch; a memory that starts empty has A∞ for A(0).
    """
    askew = np.array([0, 0, 0, 0, 0.01, 0.02])
    history = run_halifax(speed=TWENTY_KNOTS, duration=1.0, initial_displacement=askew)
    coupling = speed_coupling(TWENTY_KNOTS)
    infinite = memory_functions(halifax_database).added_mass_infinite
    expected = coupling.T @ halifax_database.added_mass_zero @ coupling @ askew
    got = history.loads["radiation"][0] + infinite @ history.acceleration[0]
    np.testing.assert_allclose(got, expected, atol=1e-9 * np.abs(expected).max())


def test_a_run_covers_its_duration_and_says_where_its_step_is_coarse(run_halifax: Run) -> None:
    """10 s in steps of 0.3 s are 34 steps, not 33; RK4 takes 0.5 s for coarse in waves of 3.3 rad/s."""
    sea = WaveComponents(np.array([0.1]), np.array([1.5]), np.array([np.pi]), np.zeros(1))
    history = run_halifax(sea, duration=10.0, time_step=0.3)
    assert history.time[-1] == pytest.approx(10.2)
    assert not any("time steps a period" in note for note in history.notes)
    coarse = {"speed": 8.0, "duration": 10.0}
    for stepper, time_step, told in (("rk4", 0.5, "6.3"), ("exponential", 0.8, "3.1"), ("ab3", 0.4, "13")):
        notes = run_halifax(sea, time_step=time_step, stepper=stepper, **coarse).notes
        assert any(f"fewer than {told} time steps a period" in note for note in notes)
    notes = run_halifax(sea, time_step=0.5, **coarse).notes
    assert not any("time steps a period" in note for note in notes)


def test_a_ship_under_way_without_a_yaw_spring_is_warned_of_and_broaches(run_halifax: Run) -> None:
    """Its Munk moment turns it; beyond 60° of yaw the run ends, since nothing linear holds any more."""
    history = run_halifax(
        speed=TWENTY_KNOTS, supplementary=NO_SPRINGS, initial_displacement=(0, 0, 0, 0, 0, 0.05)
    )
    assert any("Munk" in note for note in history.notes)
    assert history.outcome == "diverged"
    assert "broached" in history.attrs["outcome_detail"]


def test_linear_wave_loads_turn_at_the_encounter_frequency_of_the_ships_gravity(
    halifax_database: HydroDatabase,
) -> None:
    """Re a X exp(i(ω_e t + ε)) with ω_e = ω + U ω²/g: less gravity, faster head waves."""
    gravity, speed, omega = 4.9, 8.0, 0.6
    ship = load_ship("halifax", 20.0, gravity=gravity)
    database = HydroDatabase(halifax_database.dataset.assign_attrs(gravity=gravity, ship_gravity=gravity))
    wave = RegularSeaway(0.01, omega, np.pi, phase=0.4)
    history = simulate(
        ship,
        wave,
        speed=speed,
        duration=20.0,
        time_step=0.2,
        ramp=0.0,
        model="linear",
        database=database,
        supplementary=Supplementary.of(ship),
    )
    encounter = omega + speed * omega**2 / gravity
    turning = 0.01 * np.exp(1j * (encounter * history.time + 0.4))
    parts = {
        "diffraction": diffraction_load(database, np.array([omega]), np.array([np.pi]), speed)[0],
        "froude_krylov": froude_krylov_transfer(ship, wave.components)[0],
    }
    for name, transfer in parts.items():
        expected = (turning[:, None] * transfer).real
        np.testing.assert_allclose(
            history.loads[name], expected, atol=1e-9 * np.abs(expected).max(), err_msg=name
        )
