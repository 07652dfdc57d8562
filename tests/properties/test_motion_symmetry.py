"""Symmetries of whole runs: the mirrored sea, head seas on an upright ship, the same sea later."""

from collections.abc import Callable

import numpy as np
import pytest

from panelsim.conventions import KNOT
from panelsim.motion.history import History
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship

Run = Callable[..., History]

MIRROR = np.array([1, -1, 1, -1, 1, -1])
SPEED = 20 * KNOT


def rough_sea(heading_deg: float) -> RandomSeaway:
    """The sea of TM 2003-190 section 8.4 from a direction."""
    return RandomSeaway(Bretschneider(7.5, 15.0), np.linspace(0.2, 2.0, 19), np.deg2rad(heading_deg), 1001)


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("heading_deg", [30.0, 120.0])
def test_a_mirrored_sea_gives_the_mirrored_motion(heading_deg: float, model: str, run_halifax: Run) -> None:
    """β to −β turns sway, roll and yaw around and leaves the rest, motions and every load."""
    start = np.array([0.0, 0.5, 0.2, 0.1, 0.01, 0.05])
    port, starboard = (
        run_halifax(
            rough_sea(sign * heading_deg),
            speed=SPEED,
            ramp=20.0,
            duration=100.0,
            model=model,
            initial_displacement=start if sign > 0 else MIRROR * start,
        )
        for sign in (1, -1)
    )
    largest = np.abs(port.displacement).max(axis=0)
    difference = np.abs(starboard.displacement - MIRROR * port.displacement).max(axis=0) / largest
    print(f"{model} {heading_deg:g}°: {difference.max():.1e} of the largest motion")
    # Rounding of 1e-16, which a stable motion does not make grow; 600 steps add it up.
    assert difference.max() < 1e-10
    assert np.rad2deg(largest[3]) > 1.0
    for name, load in port.loads.items():
        scale = np.abs(load).max(axis=0)
        assert (np.abs(starboard.loads[name] - MIRROR * load) <= 1e-9 * scale + 1e-3).all(), name


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("heading_deg", [180.0, 0.0])
def test_head_and_following_seas_leave_an_upright_ship_on_her_course(
    heading_deg: float, model: str, run_halifax: Run
) -> None:
    """Sway, roll and yaw stay zero to rounding over 300 s, while she heaves metres."""
    history = run_halifax(rough_sea(heading_deg), speed=SPEED, ramp=20.0, duration=280.0, model=model)
    largest = np.abs(history.displacement).max(axis=0)
    print(
        f"{model} {heading_deg:g}°: sway {largest[1]:.1e} m, roll {largest[3]:.1e}, yaw {largest[5]:.1e} rad"
    )
    assert largest[2] > 1.0
    # sin 180° is 1e-16 here, and the sums over port and starboard panels differ by rounding.
    assert largest[1] < 1e-9
    assert max(largest[3], largest[5]) < 1e-9


@pytest.mark.parametrize("heading_deg", [150.0, 30.0])
def test_the_same_waves_later_give_the_same_motion_later(
    heading_deg: float, run_halifax: Run, halifax: Ship
) -> None:
    """Phases that lead by ω_e τ start the sea τ later in its life: the motion is that of t + τ.

    ω_e with its sign: of the waves at 30° some are overtaken (1.2 rad/s), and lag instead.
    """
    later = 40.0
    frequency = np.array([0.45, 0.8, 1.2])
    heading = np.full(3, np.deg2rad(heading_deg))
    phase = np.array([0.3, 2.0, 5.0])
    waves = WaveComponents(np.array([0.8, 0.4, 0.1]), frequency, heading, phase)
    lead = phase + waves.encounter_frequency(SPEED, halifax.gravity) * later
    shifted = WaveComponents(waves.amplitude, frequency, heading, lead)
    first = run_halifax(waves, speed=SPEED, ramp=40.0, duration=300.0)
    second = run_halifax(shifted, speed=SPEED, ramp=40.0, duration=260.0)
    lag = round(later / 0.2)
    settled = second.time > 240.0
    difference = second.displacement[settled] - first.displacement[lag:][settled]
    scale = np.abs(first.displacement[lag:][settled]).max(axis=0)
    np.testing.assert_allclose(
        second.wave_elevation[settled], first.wave_elevation[lag:][settled], rtol=0, atol=1e-12
    )
    error = np.abs(difference).max(axis=0) / scale
    print(f"{heading_deg:g}°:", " ".join(f"{e:.1e}" for e in error))
    # What is left is the transient of the start, which the springs and dampers take 240 s to damp.
    assert error.max() < 2e-3
