"""A ship in waves much longer than herself goes where the water goes: signs and sizes of all six motions.

At the ship ζ = a cos(ω_e t). Along the direction of travel (cos β, −sin β) the water there moves by
−i a and its surface slopes by −i k a, as complex amplitudes with exp(+iω_e t). So in the limit

    surge  −i a cos β      roll    i a k sin β       (starboard down is a slope +∂ζ/∂y)
    sway    i a sin β      pitch   i a k cos β       (bow down is a slope −∂ζ/∂x)
    heave   a              yaw     a k sin β cos β   (∂/∂x of the water's sway i a sin β exp(−ikx cos β))

whatever the speed: the encounter frequency is in the time factor only.
"""

from collections.abc import Callable

import numpy as np
import pytest

from panelsim.conventions import DOF_NAMES, KNOT, Dof
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship

Run = Callable[..., History]

AMPLITUDE = 0.1  # m: a slope of 4e-4, so that a nonlinear run is a linear one
SHIP_LENGTHS = 12.0


def long_wave(ship: Ship, heading_deg: float) -> WaveComponents:
    """A wave of twelve ship lengths, with its crest at the ship at t = 0."""
    wavenumber = 2 * np.pi / (SHIP_LENGTHS * ship.length)
    return WaveComponents(
        np.array([AMPLITUDE]),
        np.array([np.sqrt(ship.gravity * wavenumber)]),
        np.array([np.deg2rad(heading_deg)]),
        np.zeros(1),
    )


def limit(ship: Ship, heading_deg: float) -> np.ndarray:
    """Complex motions (6,) of the water at the ship, per unit amplitude: the table above."""
    k = 2 * np.pi / (SHIP_LENGTHS * ship.length)
    cos, sin = np.cos(np.deg2rad(heading_deg)), np.sin(np.deg2rad(heading_deg))
    return np.array([-1j * cos, 1j * sin, 1.0, 1j * k * sin, 1j * k * cos, k * sin * cos])


def response(
    run: Run, ship: Ship, heading_deg: float, *, speed: float, model: str, supplementary: Supplementary
) -> np.ndarray:
    """Complex motions (6,) per unit amplitude over the last periods of a run, less mean and drift."""
    wave = long_wave(ship, heading_deg)
    history = run(
        wave,
        speed=speed,
        model=model,
        supplementary=supplementary,
        ramp=100.0,
        duration=300.0,
    )
    assert history.outcome == "finished"
    last = history.time >= 200.0
    t, w = history.time[last], wave.encounter_frequency(speed, ship.gravity)[0]
    basis = np.stack([np.cos(w * t), -np.sin(w * t), np.ones_like(t), t], axis=1)
    fit = np.linalg.lstsq(basis, history.displacement[last], rcond=None)[0]
    return (fit[0] + 1j * fit[1]) / AMPLITUDE


def show(found: np.ndarray, expected: np.ndarray) -> None:
    for name, f, e in zip(DOF_NAMES, found, expected, strict=True):
        if abs(e) > 1e-6:
            print(f"{name}: {abs(f / e):.3f} of the limit, {np.rad2deg(np.angle(f / e)):+.1f}°")


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("speed_knots", [0, 20])
@pytest.mark.parametrize("heading_deg", [180, 0])
def test_ship_rides_long_head_and_following_waves(
    heading_deg: float,
    speed_knots: float,
    model: str,
    run_halifax: Run,
    halifax: Ship,
    springs: Supplementary,
) -> None:
    """Heave the wave, pitch its slope: −90° in head, +90° in following seas, at speed as well.

    This fails with any wrong sign in the speed terms of radiation or diffraction.
    """
    found = response(
        run_halifax, halifax, heading_deg, speed=speed_knots * KNOT, model=model, supplementary=springs
    )
    expected = limit(halifax, heading_deg)
    show(found, expected)
    for dof, tolerance in ((Dof.HEAVE, 0.03), (Dof.PITCH, 0.08)):
        # What is left at 12 L: terms of (ω² m/C)² and of k L.
        assert abs(abs(found[dof] / expected[dof]) - 1.0) < tolerance
        assert abs(np.rad2deg(np.angle(found[dof] / expected[dof]))) < 5.0
    assert np.angle(found[Dof.PITCH], deg=True) * np.cos(np.deg2rad(heading_deg)) > 85.0


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("heading_deg", [90, 270])
def test_beam_waves_roll_sway_and_heave_the_ship(
    heading_deg: float, model: str, run_halifax: Run, halifax: Ship
) -> None:
    """A crest to port rolls the ship to starboard; waves from starboard do the opposite."""
    roll_damping = Supplementary(damping={"roll": 2e7})  # no springs: they would hold the sway
    found = response(run_halifax, halifax, heading_deg, speed=0.0, model=model, supplementary=roll_damping)
    expected = limit(halifax, heading_deg)
    show(found, expected)
    # A quarter of a period before the crest comes, it is on the side that the waves come from.
    before_crest = (found * np.exp(-0.5j * np.pi)).real
    assert before_crest[Dof.ROLL] * np.sin(np.deg2rad(heading_deg)) > 0
    assert abs(found[Dof.HEAVE] - 1.0) < 0.03
    assert abs(found[Dof.SWAY] / expected[Dof.SWAY] - 1.0) < 0.05
    # Roll is magnified by 1/(1 − (ω/ω4)²) = 1.1 here, on the way to its resonance at 0.7 rad/s.
    assert abs(found[Dof.ROLL] / expected[Dof.ROLL]) == pytest.approx(1.1, abs=0.1)
    assert abs(np.rad2deg(np.angle(found[Dof.ROLL] / expected[Dof.ROLL]))) < 10.0


@pytest.mark.parametrize("model", ["linear", "nonlinear"])
@pytest.mark.parametrize("heading_deg", [30, 135, 225, 315])
def test_oblique_waves_move_the_free_ship_with_the_water(
    heading_deg: float, model: str, run_halifax: Run, halifax: Ship
) -> None:
    """All six motions in each quarter, without springs: their signs are those of sin β and cos β."""
    roll_damping = Supplementary(damping={"roll": 2e7})
    found = response(run_halifax, halifax, heading_deg, speed=0.0, model=model, supplementary=roll_damping)
    expected = limit(halifax, heading_deg)
    show(found, expected)
    ratio = found / expected
    assert np.abs(ratio[:3] - 1.0).max() < 0.05
    assert abs(ratio[Dof.PITCH] - 1.0) < 0.08
    # Roll is magnified on the way to resonance and has its phase from the stern, where the breadth is.
    assert abs(ratio[Dof.ROLL] - 1.1) < 0.25
    # Yaw depends on how mass and water are spread along the ship.
    assert abs(ratio[Dof.YAW] - 1.0) < 0.15


def test_waves_from_starboard_mirror_those_from_port(run_halifax: Run, halifax: Ship) -> None:
    """Sway, roll and yaw change sign, the others stay, at 20 knots on springs too."""
    springs = Supplementary(stiffness={"surge": 5e5, "sway": 1e6, "yaw": 2e9}, damping={"roll": 2e7})
    port, starboard = (
        response(run_halifax, halifax, heading, speed=20 * KNOT, model="linear", supplementary=springs)
        for heading in (60.0, -60.0)
    )
    mirror = np.array([1, -1, 1, -1, 1, -1])
    # Rounding, nothing else.
    np.testing.assert_allclose(starboard, mirror * port, atol=1e-9 * np.abs(port).max())
    assert abs(port[Dof.ROLL]) > 1e-3 * abs(port[Dof.HEAVE])
