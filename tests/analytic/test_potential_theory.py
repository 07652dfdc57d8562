"""The waves obey potential theory: Laplace's equation, the surface conditions, the dispersion relation.

Everything by finite differences of the potential and the elevation alone, in fixed axes and in axes that
move with a ship, where ∂/∂t of somebody at rest is ∂/∂t − U ∂/∂x. Halving the step must divide what is
left by four.
"""

from collections.abc import Callable

import numpy as np
import pytest

from panelsim.conventions import STANDARD_GRAVITY
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.fixed import FixedSeaway
from panelsim.seaway.view import SeawayView

SPEED = 9.0  # m/s
STEPS = 0.4 * 0.5 ** np.arange(5)  # m and s
COMPONENTS = WaveComponents(
    [0.8, 0.6, 0.5, 0.2], [0.5, 0.8, 1.1, 1.7], [0.4, 2.0, 3.9, 5.6], [0.3, 1.0, 4.0, 5.5]
)
FIXED = FixedSeaway(COMPONENTS, 0.7, stretching="none")
MOVING = FIXED.in_translating_axes(SPEED, -0.5, time=20.0, position=(30.0, -50.0))
VIEWS = [pytest.param(FIXED, 0.0, id="fixed"), pytest.param(MOVING, SPEED, id="translating")]


def high_water(sea: SeawayView) -> tuple[np.ndarray, ...]:
    """x, y, t where the water stands well above calm level, so that z = 0 and its neighbours are wet."""
    x, y, t = np.random.default_rng(7).uniform([-90, -90, 0], [90, 90, 200], (400, 3)).T
    high = sea.elevation(x, y, t) > 0.8
    assert high.sum() > 20
    return x[high][:20], y[high][:20], t[high][:20]


def at_rest(
    function: Callable[..., np.ndarray], x: np.ndarray, t: np.ndarray, speed: float, s: float
) -> np.ndarray:
    """The function s seconds later at the same point of the earth, which falls astern of the moving axes."""
    return function(x - speed * s, t + s)


def order(residual: Callable[[float], np.ndarray], scale: float) -> float:
    """Fitted order in the step; the last residual must be small against the size of its terms too."""
    errors = np.array([np.sqrt(np.mean(residual(step) ** 2)) for step in STEPS])
    slope = float(np.polyfit(np.log(STEPS), np.log(errors), 1)[0])
    print(f"residuals {errors / scale}, order {slope:.3f}")
    # Step² k²/4 of the shortest wave, k = 0.29 rad/m, at a step of 0.025: 1e-5; in time with ω 1.7: 5e-4.
    assert errors[-1] < 1e-3 * scale
    return slope


@pytest.mark.parametrize("sea", [FIXED, MOVING], ids=["fixed", "translating"])
def test_laplace_equation(sea: SeawayView) -> None:
    x, y, t = high_water(sea)
    z = np.linspace(-6.0, -1.0, len(x))

    def residual(h: float) -> np.ndarray:
        total = -6.0 * sea.potential(x, y, z, t)
        for step in np.vstack([np.eye(3), -np.eye(3)]) * h:
            total += sea.potential(x + step[0], y + step[1], z + step[2], t)
        return total / h**2

    # The terms: k² Φ of order 0.1 · 5 m2/s.
    assert abs(order(residual, 0.5) - 2.0) < 0.15


@pytest.mark.parametrize(("sea", "speed"), VIEWS)
def test_linear_free_surface_condition(sea: SeawayView, speed: float) -> None:
    """(∂/∂t − U ∂/∂x)² Φ + g ∂Φ/∂z = 0 at z = 0."""
    x, y, t = high_water(sea)

    def residual(h: float, drift: float = speed) -> np.ndarray:
        def surface(x: np.ndarray, t: np.ndarray) -> np.ndarray:
            return sea.potential(x, y, 0.0, t)

        later, now, before = (at_rest(surface, x, t, drift, s) for s in (h, 0.0, -h))
        upward = (3 * now - 4 * sea.potential(x, y, -h, t) + sea.potential(x, y, -2 * h, t)) / (2 * h)
        return (later - 2 * now + before) / h**2 + STANDARD_GRAVITY * upward

    assert abs(order(residual, 10.0) - 2.0) < 0.15
    if speed:  # without the convective part it does not hold
        assert np.abs(residual(STEPS[-1], 0.0)).max() > 1.0


@pytest.mark.parametrize(("sea", "speed"), VIEWS)
def test_dynamic_and_kinematic_condition(sea: SeawayView, speed: float) -> None:
    """ζ = −(1/g)(∂/∂t − U ∂/∂x)Φ and (∂/∂t − U ∂/∂x)ζ = ∂Φ/∂z, at z = 0."""
    x, y, t = high_water(sea)

    def rate(function: Callable[..., np.ndarray], h: float) -> np.ndarray:
        return (at_rest(function, x, t, speed, h) - at_rest(function, x, t, speed, -h)) / (2 * h)

    def dynamic(h: float) -> np.ndarray:
        potential_rate = rate(lambda x, t: sea.potential(x, y, 0.0, t), h)
        return sea.elevation(x, y, t) + potential_rate / STANDARD_GRAVITY

    def kinematic(h: float) -> np.ndarray:
        return rate(lambda x, t: sea.elevation(x, y, t), h) - sea.potential_gradient(x, y, 0.0, t)[:, 2]

    assert abs(order(dynamic, 1.0) - 2.0) < 0.15
    assert abs(order(kinematic, 1.0) - 2.0) < 0.15


@pytest.mark.parametrize("heading", [0.3, 1.4, 2.9])
@pytest.mark.parametrize("gravity", [STANDARD_GRAVITY, 9.78])
def test_dispersion_relation(heading: float, gravity: float) -> None:
    """Both from the potential alone: k² = ∂²Φ/∂z² / Φ, ω² = −(∂/∂t − U ∂/∂x)²Φ / Φ; then ω² = g k, (2)."""
    wave = FixedSeaway(WaveComponents([1.0], [0.9], [heading], [0.2]), 0.3, gravity, stretching="none")
    sea = wave.in_translating_axes(SPEED, 1.0)
    x, y, z, t = 4.0, -3.0, -2.0, 5.0

    def residual(h: float) -> np.ndarray:
        here = sea.potential(x, y, z, t)
        curvature = (sea.potential(x, y, z + h, t) - 2 * here + sea.potential(x, y, z - h, t)) / h**2
        later, before = (sea.potential(x - SPEED * s, y, z, t + s) for s in (h, -h))
        squared = -(later - 2 * here + before) / h**2 / here
        return squared - gravity * np.sqrt(curvature / here)

    assert abs(order(residual, 0.81) - 2.0) < 0.15
    assert wave.components.wavenumber(gravity)[0] == pytest.approx(0.81 / gravity, rel=1e-14)


def test_horizontal_wave_length_and_period() -> None:
    """One wave length 2πg/ω² further and one period 2π/|ω_e| later the sea is the same."""
    wave = WaveComponents([1.0], [1.4], [0.2], [0.0])
    sea = FixedSeaway(wave, 0.0, stretching="none").in_translating_axes(SPEED, 0.0)
    length = 2 * np.pi * STANDARD_GRAVITY / 1.4**2
    travel = np.array([np.cos(0.2), -np.sin(0.2)])
    encounter = 1.4 - SPEED * 1.4**2 / STANDARD_GRAVITY * np.cos(0.2)
    assert encounter < 0.0
    here = np.array([3.0, 1.0])
    for moved, later in ((length * travel, 0.0), (np.zeros(2), 2 * np.pi / encounter)):
        np.testing.assert_allclose(
            sea.velocity(*(here + moved), -1.5, 7.0 + later), sea.velocity(*here, -1.5, 7.0), atol=1e-12
        )
