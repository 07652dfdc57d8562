"""The S-175 container ship at rest against the strip code ShipX/VERES.

Source: Marine Systems Simulator (MSS), github.com/cybergalactic/MSS, MIT licence, the motion transfer
functions of its S-175 vessel data, made by ShipX/VERES: zero speed, heading 0 in head seas, pitch over wave
slope, bow up. Consistency of two strip codes, not truth.
"""

from functools import cache

import numpy as np
import pytest

from panelsim.hydro.database import HydroDatabase
from panelsim.response.response import response
from panelsim.seaway.dispersion import wavenumber
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

# Heading there [deg], wave frequency [rad/s]; heave and its phase [deg]; pitch over k and its phase.
VERES = [
    (0.0, 0.31416, 0.93265, -0.5, 1.0048, 87.1),
    (0.0, 0.41888, 0.78613, -1.0, 0.92503, 83.9),
    (0.0, 0.48332, 0.6331, -0.7, 0.82933, 80.9),
    (0.0, 0.57120, 0.35447, 4.5, 0.63029, 75.1),
    (30.0, 0.31416, 0.95044, -0.4, 0.88137, 87.4),
    (30.0, 0.41888, 0.84078, -0.7, 0.8363, 84.6),
    (30.0, 0.48332, 0.723, -0.5, 0.77821, 82.0),
    (30.0, 0.57120, 0.49626, 2.2, 0.64936, 76.9),
    (60.0, 0.31416, 0.98669, -0.1, 0.52193, 88.2),
    (60.0, 0.41888, 0.95735, -0.2, 0.52541, 86.2),
    (60.0, 0.48332, 0.92549, -0.2, 0.52485, 84.3),
    (60.0, 0.57120, 0.86172, -0.1, 0.51801, 80.3),
    (150.0, 0.31416, 0.95009, -0.7, 0.88009, -89.0),
    (150.0, 0.41888, 0.8388, -1.9, 0.83046, -88.6),
    (150.0, 0.48332, 0.71767, -3.3, 0.76781, -88.4),
    (150.0, 0.57120, 0.47698, -6.7, 0.6312, -88.4),
    (180.0, 0.31416, 0.93227, -0.9, 1.0031, -88.8),
    (180.0, 0.41888, 0.78403, -2.5, 0.91722, -88.4),
    (180.0, 0.48332, 0.62755, -4.3, 0.81568, -88.2),
    (180.0, 0.57120, 0.33447, -9.3, 0.60759, -87.9),
]


@cache
def s175() -> tuple[Ship, HydroDatabase]:
    ship = load_ship("s175")
    return ship, HydroDatabase.compute(ship, "strip")


def heave_and_pitch(heading_deg: float, omega: float) -> tuple[complex, complex]:
    """Heave, and pitch bow up over the wave slope, exp(+iωt), for a heading of theirs."""
    ship, database = s175()
    heading = np.pi - np.radians(heading_deg)
    table = response(ship, database, frequencies=[omega], wave_headings=[heading], speeds=[0.0])
    motions = table.transfer[0, 0, 0]
    return complex(motions[2]), complex(-motions[4] / wavenumber(np.array([omega]), ship.gravity)[0])


@pytest.mark.parametrize(("heading_deg", "omega", "heave", "heave_phase", "pitch", "pitch_phase"), VERES)
def test_motions_at_rest(
    heading_deg: float, omega: float, heave: float, heave_phase: float, pitch: float, pitch_phase: float
) -> None:
    found = heave_and_pitch(heading_deg, omega)
    expected = (heave * np.exp(1j * np.radians(heave_phase)), pitch * np.exp(1j * np.radians(pitch_phase)))
    errors = [abs(abs(f) / abs(e) - 1.0) for f, e in zip(found, expected, strict=True)]
    turns = [abs(np.degrees(np.angle(f / e))) for f, e in zip(found, expected, strict=True)]
    print(heading_deg, omega, np.round(100 * np.array(errors), 1), "%", np.round(turns, 1), "deg")
    # 1.5 % of heave, 2.3 % of pitch and 0.4 degrees are found. Pitch is 2 % more there at every frequency and
    # heading, in the longest waves too, where it must be the slope.
    assert errors[0] < 0.025
    assert errors[1] < 0.035
    assert max(turns) < 1.0


@pytest.mark.parametrize(
    ("omega", "heave", "heave_phase"), [(0.7854, 0.34461, 127.3), (0.8976, 0.2294, 101.1)]
)
def test_heave_of_short_head_waves(omega: float, heave: float, heave_phase: float) -> None:
    """At the natural period and above, where the exciting force is the difference of large parts."""
    found, _ = heave_and_pitch(0.0, omega)
    print(abs(found) / heave, np.degrees(np.angle(found)) - heave_phase)
    # 4 % and 4 degrees are found.
    assert abs(found) == pytest.approx(heave, rel=0.06)
    assert abs(np.degrees(np.angle(found)) - heave_phase) < 6.0
