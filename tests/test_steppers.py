"""The Runge-Kutta step by itself, and the order that whole runs keep of it."""

from collections.abc import Callable

import numpy as np
import pytest

from panelsim.conventions import KNOT
from panelsim.motion.history import History
from panelsim.motion.steppers import rk4_step
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider

OMEGA, DECAY, FORCED = 1.3, 0.08, 0.7  # rad/s, 1/s, rad/s


def exact(time: float) -> np.ndarray:
    """η(t) (6,) of η̈ + 2δη̇ + (ω² + δ²)η = cos(Ωt), free part and forced part, six starting phases."""
    phase = np.arange(6.0)
    gain = 1.0 / ((1j * FORCED) ** 2 + 2j * DECAY * FORCED + OMEGA**2 + DECAY**2)
    return np.exp(-DECAY * time) * np.cos(OMEGA * time + phase) + (gain * np.exp(1j * FORCED * time)).real


def exact_velocity(time: float) -> np.ndarray:
    phase = np.arange(6.0)
    gain = 1.0 / ((1j * FORCED) ** 2 + 2j * DECAY * FORCED + OMEGA**2 + DECAY**2)
    free = -DECAY * np.cos(OMEGA * time + phase) - OMEGA * np.sin(OMEGA * time + phase)
    return np.exp(-DECAY * time) * free + (1j * FORCED * gain * np.exp(1j * FORCED * time)).real


def oscillate(time_step: float, duration: float) -> np.ndarray:
    """η (6,) of the oscillator at the end."""
    displacement, velocity = exact(0.0), exact_velocity(0.0)
    for step in range(round(duration / time_step)):

        def rates(
            fraction: float, displacement: np.ndarray, velocity: np.ndarray, step: int = step
        ) -> tuple[np.ndarray, None]:
            force = np.cos(FORCED * (step + fraction) * time_step)
            return force - 2 * DECAY * velocity - (OMEGA**2 + DECAY**2) * displacement, None

        first = rates(0.0, displacement, velocity)[0]
        displacement, velocity = rk4_step(rates, first, displacement, velocity, time_step)
    return displacement


def slope(steps: np.ndarray, errors: np.ndarray) -> float:
    return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])


def test_a_forced_oscillator_is_met_with_order_four() -> None:
    """Against the closed form after 20 s."""
    steps = np.array([0.4, 0.2, 0.1, 0.05, 0.025])
    errors = np.array([np.abs(oscillate(step, 20.0) - exact(20.0)).max() for step in steps])
    order = slope(steps, errors)
    print("errors", " ".join(f"{e:.1e}" for e in errors), f"order {order:.2f}")
    # The fit is over a factor of 16 in the step; the first step is not yet small.
    assert order == pytest.approx(4.0, abs=0.15)
    assert errors[2] < 1e-4


def test_one_step_is_the_classical_scheme_for_the_doubled_system() -> None:
    """The same bits but for rounding as textbook RK4 on (η, η̇)."""

    def acceleration(time: float, state: np.ndarray) -> np.ndarray:
        return np.sin(3.0 * time) - state[:6] ** 3 - 0.1 * state[6:] * np.abs(state[6:])

    def doubled(time: float, state: np.ndarray) -> np.ndarray:
        return np.concatenate([state[6:], acceleration(time, state)])

    h, state = 0.3, np.linspace(-1.0, 1.0, 12)
    k1 = doubled(0.0, state)
    k2 = doubled(0.5 * h, state + 0.5 * h * k1)
    k3 = doubled(0.5 * h, state + 0.5 * h * k2)
    k4 = doubled(h, state + h * k3)
    expected = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    found = rk4_step(
        lambda fraction, x, v: (acceleration(fraction * h, np.concatenate([x, v])), None),
        k1[6:],
        state[:6],
        state[6:],
        h,
    )
    np.testing.assert_allclose(np.concatenate(found), expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
def test_a_run_converges_with_its_time_step(model: str, run_halifax: Callable[..., History]) -> None:
    """Halifax at 20 knots in the bow-quartering sea of TM 2003-190 8.4: the series against dt 0.0125 s.

    The memory takes velocities as linear between samples: it has order two, and so has the run.
    """
    sea = RandomSeaway(Bretschneider(7.5, 15.0), np.linspace(0.2, 2.0, 19), np.deg2rad(150.0), 1001)
    steps = np.array([0.4, 0.2, 0.1, 0.05])
    runs = [
        run_halifax(sea, speed=20 * KNOT, ramp=20.0, duration=20.0, time_step=step, model=model).displacement
        for step in (*steps, 0.0125)
    ]
    finest = runs[-1][::32]
    errors = np.array(
        [
            (np.abs(run[:: round(0.4 / step)] - finest).max(axis=0) / np.abs(finest).max(axis=0)).max()
            for run, step in zip(runs, steps, strict=False)
        ]
    )
    order = slope(steps, errors)
    print(model, "worst mode", " ".join(f"{100 * e:.3f} %" for e in errors), f"order {order:.2f}")
    assert order == pytest.approx(2.0, abs=0.2)
    # What a user gets at the step of TM 2003-190.
    assert errors[1] < 0.01
