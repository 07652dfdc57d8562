"""Each scheme by itself: closed forms, exactness in the linear model, and what its loads and limits are."""

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.linalg import expm

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.radiation import Radiation
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.exact import advance, harmonic_inputs, polynomial_inputs
from panelsim.motion.exponential import forward, spread
from panelsim.motion.history import History
from panelsim.motion.linear_system import LinearSystem
from panelsim.motion.requirements import LONGEST_STEP
from panelsim.motion.run_loads import run_loads
from panelsim.motion.runge_kutta import RungeKutta4
from panelsim.motion.stepper import State
from panelsim.motion.steppers import STEPPERS, make_stepper
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.frequencies import EvenFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship

Run = Callable[..., History]

SEA = RandomSeaway(Bretschneider(7.5, 15.0), EvenFrequencies(0.2, 2.0, 0.1), np.deg2rad(150.0), seed=1001)
TWENTY_KNOTS = 20 * KNOT


# --- exact steps -----------------------------------------------------------------------------------

SYSTEM = np.array([[0.0, 1.0, 0.0], [-2.0, -0.1, 3e6], [0.0, -2e-7, -0.8]])  # badly scaled, as a ship's is
ENTRANCE = np.array([[0.0, 0.0], [1.0, 0.5], [2e-7, 0.0]])
STEP = 0.7  # s
UNIT = np.array([1.0, 1.0, 1e-7])  # sizes of the states


def integral(input_at: Callable[[float], np.ndarray]) -> np.ndarray:
    """∫ exp(S (h − s)) u(s) ds by adaptive quadrature."""
    found, _ = quad_vec(lambda s: expm(SYSTEM * (STEP - s)) @ input_at(s), 0.0, STEP, epsabs=0, epsrel=1e-12)
    return found


def test_a_free_motion_is_the_exponential() -> None:
    np.testing.assert_allclose(advance(SYSTEM, STEP), expm(SYSTEM * STEP), rtol=1e-12)


@pytest.mark.parametrize("nodes", [(0,), (0, -1), (1, 0), (0, -1, -2), (1, 0, -1)])
def test_polynomial_inputs_are_integrals_of_lagrange_polynomials(nodes: tuple[int, ...]) -> None:
    found = polynomial_inputs(SYSTEM, ENTRANCE, STEP, nodes)
    for j, node in enumerate(nodes):
        others = [other for other in nodes if other != node]

        def share(s: float, node: int = node, others: list[int] = others) -> float:
            return float(np.prod([(s / STEP - other) / (node - other) for other in others]))

        expected = integral(lambda s, share=share: share(s) * ENTRANCE)
        assert np.abs((found[j] - expected) / UNIT[:, None]).max() < 1e-11


@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_residual_that_is_a_polynomial_is_followed_exactly(order: int) -> None:
    """Predicted from a constant, a line, a parabola through its past; then corrected by its new value.

    A wrong guess of the new value is mended by the correction: it is the polynomial through the new value and
    the last ones. From the first step on that is a line, then a parabola. 1e-12: rounding.
    """
    random, step = np.random.default_rng(3), 0.4
    matrix = random.normal(size=(15, 15)) - 3.0 * np.eye(15)
    matrix[:6] = np.eye(6, 15, 6)
    system = LinearSystem(matrix, random.normal(size=(6, 15)))
    y, powers = random.normal(size=15), random.normal(size=(order + 1, 6))

    def residual(time: float) -> np.ndarray:
        return np.polynomial.polynomial.polyval(time, powers)

    driven, _ = quad_vec(
        lambda s: expm(matrix * (step - s)) @ system.entrance @ residual(s), 0.0, step, epsabs=1e-13
    )
    exact = expm(matrix * step) @ y + driven
    past = np.concatenate([residual(0.0), residual(-step), residual(-2.0 * step)])
    ahead = forward(system, step, order) @ np.concatenate([y, past])
    np.testing.assert_allclose(ahead[:15], exact, rtol=0, atol=1e-12)
    np.testing.assert_allclose(ahead[15:21], residual(step), rtol=0, atol=1e-12)
    np.testing.assert_allclose(ahead[21:], matrix[6:12] @ exact, rtol=0, atol=1e-11)
    if order < 2:
        return
    guessed = forward(system, step, 1) @ np.concatenate([y, past])
    lines = forward(system, step, 2) @ np.concatenate([y, past[:12], 2 * past[6:12] - past[:6]])
    np.testing.assert_allclose(lines[:15], guessed[:15], rtol=0, atol=1e-12)
    change = spread(system, step, 1) @ (residual(step) - guessed[15:21])
    np.testing.assert_allclose(guessed[:15] + change[:15], exact, rtol=0, atol=1e-12)
    np.testing.assert_allclose(change[15:21], matrix[6:12] @ change[:15], rtol=0, atol=1e-12)
    np.testing.assert_allclose(change[21:], system.loads @ change[:15], rtol=0, atol=1e-12)


@pytest.mark.parametrize("frequency", [0.0, -0.3, 1.0, 6.2, 60.0])
def test_harmonic_inputs_are_integrals(frequency: float) -> None:
    """ω = 0 and short waves too; so is resonance, where the quotient of the resolvent would be 0/0."""
    load = ENTRANCE @ np.array([1.0 + 2.0j, -0.5j])
    found = harmonic_inputs(SYSTEM, load[:, None], STEP, np.array([frequency]))[:, 0]
    expected = integral(lambda s: np.exp(1j * frequency * s) * load)
    assert np.abs((found - expected) / UNIT).max() < 1e-11
    undamped = np.array([[0.0, 1.0], [-4.0, 0.0]])  # its own frequency is 2 rad/s: y = t/(4i) exp(2it) + …
    at_resonance = harmonic_inputs(undamped, np.array([[0.0], [1.0 + 0j]]), STEP, np.array([2.0]))[0, 0]
    assert at_resonance == pytest.approx(STEP * np.exp(2j * STEP) / 4j - np.sin(2 * STEP) / 8j, abs=1e-13)


# --- Runge-Kutta ---------------------------------------------------------------------------------


def test_one_step_is_the_classical_scheme() -> None:
    """The same bits but for rounding as textbook RK4 on (η, η̇)."""

    def rates(time: float, state: np.ndarray) -> np.ndarray:
        acceleration = np.sin(3.0 * time) - state[:6] ** 3 - 0.1 * state[6:] * np.abs(state[6:])
        return np.concatenate([state[6:], acceleration])

    equations = SimpleNamespace(
        start=lambda displacement, velocity: np.concatenate([displacement, velocity], axis=1),
        evaluate=lambda time, motion: (rates(time, motion[0])[None, 6:], np.zeros((1, 1, 6))),
        rate=lambda motion, acceleration: np.concatenate([motion[:, 6:], acceleration], axis=1),
    )
    h, y = 0.3, np.linspace(-1.0, 1.0, 12)
    k1 = rates(h, y)
    k2 = rates(1.5 * h, y + 0.5 * h * k1)
    k3 = rates(1.5 * h, y + 0.5 * h * k2)
    k4 = rates(2.0 * h, y + h * k3)
    state = State(1, y[None], np.empty((1, 0)), k1[None, 6:], np.zeros((1, 1, 6)))
    after = RungeKutta4(equations, h).step(state)  # type: ignore[arg-type]
    assert after.step == 2
    np.testing.assert_allclose(after.motion[0], y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), rtol=0, atol=1e-15)


# --- the exponential scheme ----------------------------------------------------------------------


@pytest.mark.parametrize("ramp", [0.0, 12.0])
@pytest.mark.parametrize("time_step", [0.3, 1.0])
def test_the_linear_model_is_exact_at_any_step(time_step: float, ramp: float, run_halifax: Run) -> None:
    """Against the same run at a fifth of the step, in the ramp and after it."""
    sea = WaveComponents(
        *(SEA.components.amplitude[:12], SEA.components.frequency[:12]),
        *(SEA.components.wave_heading[:12], SEA.components.phase[:12]),
    )
    given = {
        "model": "linear",
        "speed": TWENTY_KNOTS,
        "duration": 24.0,
        "ramp": ramp,
        "initial_displacement": (0, 0, 0.5, 0.05, 0.01, 0.02),
    }
    coarse = run_halifax(sea, time_step=time_step, **given)
    fine = run_halifax(sea, time_step=time_step / 5, **given)
    scale = np.abs(fine.displacement).max(axis=0)
    error = np.abs(coarse.displacement - fine.displacement[::5]).max(axis=0) / scale
    print(f"dt {time_step} s, ramp {ramp} s: {error.max():.1e}")
    # Rounding of 100 steps and of loads some thousand times what is left of them.
    assert error.max() < 1e-9
    for name, load in fine.loads.items():
        largest = np.abs(load).max(axis=0)
        assert np.abs(coarse.loads[name] - load[::5]).max() < 1e-8 * largest.max(), name


@pytest.mark.parametrize(
    ("ramp", "time_step"), [(5.0, 0.7), (0.35, 0.4), (0.1, 0.4), (2.1, 0.7), (0.8, 0.4), (1.3, 0.4)]
)
def test_the_linear_model_is_exact_where_the_ramp_ends_within_a_step(
    ramp: float, time_step: float, run_halifax: Run
) -> None:
    """Against 28 steps each of Runge-Kutta: off by 0.2 % to 4 % where the step is taken as one of the ramp.
    3 × 0.7 is a bit less than 2.1: a step of rounding is left."""
    given = {"model": "linear", "speed": TWENTY_KNOTS, "ramp": ramp, "duration": 16.0}
    coarse = run_halifax(SEA, time_step=time_step, **given)
    fine = run_halifax(SEA, time_step=time_step / 28, stepper="rk4", **given)
    rows = min(len(coarse.time), (len(fine.time) - 1) // 28 + 1)
    assert coarse.time[rows - 1] > 14.0
    for found, true in (
        (coarse.displacement, fine.displacement),
        (coarse.acceleration, fine.acceleration),
    ):
        error = np.abs(found[:rows] - true[::28][:rows]).max(axis=0) / np.abs(true).max(axis=0)
        # Runge-Kutta's own error, measured up to 1e-6.
        assert error.max() < 1e-5


def test_waves_that_grow_leave_no_trace_in_the_residual(run_halifax: Run) -> None:
    """In vanishing waves, after ramps of a step or two: what waves have been is what they were."""
    wave = RegularSeaway(0.0005, 0.7, np.deg2rad(150.0))
    for ramp in (0.8, 1.6, 2.0):
        given = {"speed": TWENTY_KNOTS, "duration": 12.0, "ramp": ramp}
        coarse = run_halifax(wave, time_step=0.8, **given)
        fine = run_halifax(wave, time_step=0.05, stepper="rk4", **given).displacement[::16]
        rows = min(len(coarse.time), len(fine))
        error = np.abs(coarse.displacement[:rows] - fine[:rows]).max() / np.abs(fine).max()
        print(ramp, error)
        # Measured 2e-6, of the height squared; 1e-2 with waves before the ramp's end taken as grown.
        assert error < 2e-5


def test_in_vanishing_waves_the_nonlinear_model_is_exact_too(run_halifax: Run) -> None:
    """1 mm high: dt 0.8 s against Runge-Kutta at 0.05 s, five hundred times better than in waves of 2 m."""
    errors = []
    for amplitude in (0.0005, 1.0):
        wave = RegularSeaway(amplitude, 0.7, np.deg2rad(150.0))
        given = {"speed": TWENTY_KNOTS, "duration": 24.0, "ramp": 8.0}
        coarse = run_halifax(wave, time_step=0.8, **given).displacement
        fine = run_halifax(wave, time_step=0.05, stepper="rk4", **given).displacement[::16]
        errors.append(np.abs(coarse - fine).max() / np.abs(fine).max())
    print("errors", errors)
    assert errors[0] < 1e-4
    assert errors[1] > 20 * errors[0]


@pytest.mark.parametrize("stepper", STEPPERS)
def test_a_step_takes_the_evaluations_that_it_says(
    stepper: str, halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """One for the multistep schemes, after a start by Runge-Kutta for AB3; four for Runge-Kutta."""
    loads, known = run_loads(
        halifax,
        [SEA.components],
        [TWENTY_KNOTS],
        database=halifax_database,
        model="linear",
        stretching="wheeler",
        pressure_method="auto",
        pressure_rule="vertex+centre",
        supplementary=springs,
        roll_damping=None,
    )
    equations = EquationsOfMotion(halifax.inertia, loads, Radiation(halifax_database, [TWENTY_KNOTS]), 4.0)
    times: list[float] = []
    evaluate = equations.evaluate

    def listening(time: float, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        times.append(time)
        return evaluate(time, motion)

    equations.evaluate = listening  # type: ignore[method-assign]
    scheme = make_stepper(stepper, equations, known, 0.2)
    state = scheme.start(np.zeros((1, 6)), np.zeros((1, 6)))
    counts = []
    for _ in range(5):
        before = len(times)
        state = scheme.step(state)
        counts.append(len(times) - before)
    assert counts == {"exponential": [1] * 5, "rk4": [4] * 5, "ab3": [4, 4, 1, 1, 1]}[stepper]
    assert times[-1] == pytest.approx(1.0)


def test_a_ship_far_off_is_stepped_as_one_at_the_origin(run_halifax: Run) -> None:
    """Without springs, 3 km away in waves of shifted phase: the linear waves are those where the ship is."""
    wave = RegularSeaway(2.0, 0.8, np.deg2rad(150.0))
    k = 0.8**2 / 9.80665
    away = np.array([3000.0, -700.0, 0, 0, 0, 0])
    shift = k * (away[0] * np.cos(np.deg2rad(150.0)) - away[1] * np.sin(np.deg2rad(150.0)))
    here = RegularSeaway(2.0, 0.8, np.deg2rad(150.0), phase=-np.fmod(shift, 2 * np.pi))
    given = {"supplementary": Supplementary(), "duration": 20.0, "time_step": 0.5}
    found = run_halifax(wave, initial_displacement=away, **given).displacement - away
    # Rounding of phases of a hundred radians.
    np.testing.assert_allclose(found, run_halifax(here, **given).displacement, atol=1e-8)


# --- limits --------------------------------------------------------------------------------------


@pytest.mark.parametrize("stepper", STEPPERS)
def test_too_long_a_step_is_refused_with_the_longest_that_is_not(stepper: str, run_halifax: Run) -> None:
    """And that one is taken, to its end."""
    long_waves = RegularSeaway(0.5, 0.3, np.pi)
    with pytest.raises(PanelsimError, match="too long for the motions of the ship") as refusal:
        run_halifax(long_waves, time_step=3.0, stepper=stepper)
    allowed = float(str(refusal.value.allowed).split()[2])
    assert stepper in str(refusal.value.allowed)
    # Two digits are told, so the longest may be half of the last one less.
    history = run_halifax(long_waves, time_step=0.95 * allowed, stepper=stepper)
    assert history.outcome == "finished"
    assert np.abs(history.displacement[:, 2]).max() < 1.0
    assert set(LONGEST_STEP) == set(STEPPERS)
