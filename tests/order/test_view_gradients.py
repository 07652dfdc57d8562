"""Gradient, rate, acceleration and pressure of a view are the derivatives of its potential: second order.

Central differences, without stretching, at points that are always under water. Halving the step must divide
the difference by four, down to a stated size.
"""

from collections.abc import Callable

import numpy as np
import pytest

from panelsim.seaway.components import WaveComponents
from panelsim.seaway.fixed import FixedSeaway
from panelsim.seaway.view import SeawayView

SPEED = 11.0  # m/s
STEPS = 0.5 * 0.5 ** np.arange(5)  # m and s
DENSITY = 1025.0  # kg/m3
COMPONENTS = WaveComponents(
    [0.8, 0.6, 0.5, 0.2], [0.5, 0.8, 1.1, 1.7], [0.4, 2.0, 3.9, 5.6], [0.3, 1.0, 4.0, 5.5]
)
FIXED = FixedSeaway(COMPONENTS, 0.7, stretching="none")
MOVING = FIXED.in_translating_axes(SPEED, 2.2, time=20.0, position=(30.0, -50.0))
# x, y, z, t (4, 30), below the deepest trough by more than the largest step.
POINTS = np.random.default_rng(3).uniform([-90, -90, -9, 0], [90, 90, -3, 300], (30, 4)).T
X, Y, Z, T = np.eye(4)


def central(function: Callable[..., np.ndarray], direction: np.ndarray, h: float) -> np.ndarray:
    step = h * direction[:, None]
    return (function(*(POINTS + step)) - function(*(POINTS - step))) / (2 * h)


def assert_second_order(
    exact: np.ndarray, difference: Callable[[float], np.ndarray], label: str, bound: float
) -> None:
    """RMS difference over RMS value; `bound` at the smallest step, 1/32."""
    errors = np.array([np.sqrt(np.mean((difference(h) - exact) ** 2)) for h in STEPS])
    errors /= np.sqrt(np.mean(exact**2))
    slope = float(np.polyfit(np.log(STEPS), np.log(errors), 1)[0])
    print(f"{label}: differences {errors}, order {slope:.3f}")
    assert abs(slope - 2.0) < 0.15
    assert errors[-1] < bound


# Step²/6 times the square of the largest wavenumber (0.29 rad/m), or frequency, that counts.
SPACE, TIME = 2e-5, 2e-3


@pytest.mark.parametrize("sea", [FIXED, MOVING], ids=["fixed", "translating"])
def test_gradient(sea: SeawayView) -> None:
    gradient = sea.potential_gradient(*POINTS)
    for i, direction in enumerate((X, Y, Z)):
        assert_second_order(
            gradient[:, i], lambda h, d=direction: central(sea.potential, d, h), "xyz"[i], SPACE
        )
    np.testing.assert_array_equal(sea.velocity(*POINTS), gradient)


@pytest.mark.parametrize("sea", [FIXED, MOVING], ids=["fixed", "translating"])
def test_rate_at_a_point_of_the_axes(sea: SeawayView) -> None:
    assert_second_order(sea.potential_rate(*POINTS), lambda h: central(sea.potential, T, h), "∂Φ/∂t", TIME)


@pytest.mark.parametrize(("sea", "speed"), [(FIXED, 0.0), (MOVING, SPEED)], ids=["fixed", "translating"])
def test_acceleration_and_pressure_at_a_point_of_the_earth(sea: SeawayView, speed: float) -> None:
    """∂/∂t − U ∂/∂x, a point that falls astern: of ∇Φ the acceleration, of Φ times −ρ the pressure."""
    still = T - speed * X
    acceleration = sea.acceleration(*POINTS)
    for i in range(3):
        assert_second_order(
            acceleration[:, i], lambda h, i=i: central(sea.velocity, still, h)[:, i], f"a{'xyz'[i]}", TIME
        )
    assert_second_order(
        sea.dynamic_pressure(*POINTS, water_density=DENSITY),
        lambda h: -DENSITY * central(sea.potential, still, h),
        "pressure",
        TIME,
    )


@pytest.mark.parametrize("sea", [FIXED, MOVING], ids=["fixed", "translating"])
def test_pressure_is_static_and_dynamic_together(sea: SeawayView) -> None:
    """∂p/∂z = −ρ (g + vertical acceleration): Euler's equation to first order."""
    acceleration = sea.acceleration(*POINTS)
    assert_second_order(
        -DENSITY * (sea.gravity + acceleration[:, 2]),
        lambda h: central(lambda *at: sea.pressure(*at, water_density=DENSITY), Z, h),
        "∂p/∂z",
        SPACE,
    )
