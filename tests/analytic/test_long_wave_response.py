"""Transfer functions in waves very long beside the ship, by panels and by strips, at 0, 10 and 20 knots.

The ship goes with the water: that moves up and down at iω, and so does she, iω_e of heave and U ik cos β of
pitch. So no water moves beside her, and radiation and diffraction cancel, at any speed. Heave is 1, pitch
ik cos β (bow down), roll ik sin β. A ship that is held in surge does not follow the orbits of the water, and
the water that flows along her turns her bow: at rest pitch is 1 + g A51(0)/C55 of the slope.
"""

from functools import cache

import numpy as np
import pytest

from panelsim.conventions import KNOT, ComplexArray, Dof
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.store import database_for
from panelsim.loads.supplementary import Supplementary
from panelsim.response.response import response
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

KNOTS = (0, 10, 20)
HEADINGS_DEG = (180.0, 135.0, 60.0, 0.0)
SOURCES = pytest.mark.parametrize("source", ["bem", "strip"])


@cache
def ship_and_database(source: str) -> tuple[Ship, HydroDatabase]:
    ship = load_ship("halifax", 2.5)
    return ship, database_for(ship) if source == "bem" else HydroDatabase.compute(ship, "strip")


def in_long_waves(source: str, lengths: float, supplementary: Supplementary | None = None) -> ComplexArray:
    """Motions (speed, heading, 6) in waves of so many ship lengths, rotations over k."""
    ship, database = ship_and_database(source)
    k = 2 * np.pi / (lengths * ship.length)
    table = response(
        ship,
        database,
        frequencies=[np.sqrt(ship.gravity * k)],
        wave_headings=np.deg2rad(HEADINGS_DEG),
        speeds=np.array(KNOTS) * KNOT,
        supplementary=supplementary,
    )
    return np.asarray(table.transfer[:, :, 0] / np.where(np.arange(6) < 3, 1.0, k))


@SOURCES
def test_the_free_ship_rides_the_wave_at_any_speed(source: str) -> None:
    """100 ship lengths, k L = 0.06, and U ω/g = 0.07 at 20 knots."""
    found = in_long_waves(source, 100.0)
    slope = 1j * np.cos(np.deg2rad(HEADINGS_DEG))
    print(np.round(found[..., Dof.HEAVE], 4), np.round(found[..., Dof.PITCH] / slope, 4))
    # The next terms of heave are (k L)² and M (ω_e² - ω²)/C33, 4e-4 at most.
    assert np.abs(found[..., Dof.HEAVE] - 1.0).max() < 1e-3
    # In pitch panels leave 0.4 %, strips 0.7 %, which goes with the wave frequency; see below.
    assert np.abs(found[..., Dof.PITCH] / slope - 1.0).max() < (0.005 if source == "bem" else 0.01)


@pytest.mark.parametrize(("source", "speeds"), [("bem", 1), ("strip", 3)])
def test_what_is_left_of_pitch_vanishes_with_the_wave_frequency(source: str, speeds: int) -> None:
    """Sixteen times as long a wave has a quarter of the frequency: the rest goes with it at least.

    By panels at rest only. Under way the ship surges by ω²/ω_e² of the water's orbit, as its pressure pushes
    her, and A31 leaves some U² A31/C55 of the slope, 0.1 to 0.3 % at 20 knots.
    """
    slope = 1j * np.cos(np.deg2rad(HEADINGS_DEG))
    rest = [
        np.abs(in_long_waves(source, lengths)[:speeds, :, Dof.PITCH] / slope - 1.0).max()
        for lengths in (100.0, 1600.0)
    ]
    print(source, rest)
    assert rest[1] < 0.3 * rest[0]


@SOURCES
def test_roll_follows_the_slope_of_long_waves(source: str) -> None:
    """On the way to its resonance at 0.6 rad/s, 1/(1 - (ω_e/0.6)²), 1.02 here, and a little by the speed."""
    found = in_long_waves(source, 100.0)[:, [1, 2], Dof.ROLL]
    slope = 1j * np.sin(np.deg2rad(HEADINGS_DEG[1:3]))
    print(np.round(found / slope, 3))
    assert np.abs(found / slope - 1.0).max() < 0.04


def test_a_ship_that_is_held_in_surge_pitches_more(springs: Supplementary) -> None:
    """1 + g A51(0)/C55 at rest, 1.020, by panels. Strips have no A51, and their pitch is the slope."""
    ship, database = ship_and_database("bem")
    expected = (
        ship.gravity * database.added_mass_zero[Dof.PITCH, Dof.SURGE] / ship.hydrostatics.stiffness[4, 4]
    )
    slope = 1j * np.cos(np.deg2rad(HEADINGS_DEG))
    at_rest = in_long_waves("bem", 400.0, springs)[0, :, Dof.PITCH] / slope
    print(expected, at_rest)
    assert expected == pytest.approx(0.02, abs=0.003)
    # What is left, 6e-4, goes with the wave frequency.
    assert np.abs(at_rest - 1.0 - expected).max() < 2e-3
    of_strips = in_long_waves("strip", 400.0, springs)[0, :, Dof.PITCH] / slope
    assert np.abs(of_strips - 1.0).max() < 2e-3


def test_twelve_ship_lengths_at_twenty_knots(springs: Supplementary) -> None:
    """Head seas: heave 0.998 and pitch 1.058 on springs, 1.010 without: the difference is the held surge.

    Heave gains M (ω_e² - ω²)/C33 = 0.6 % by the speed, and loses as much by the length of the ship.
    """
    held, free = (in_long_waves("bem", 12.0, given)[2, 0] for given in (springs, None))
    print(held[[2, 4]], free[[2, 4]])
    assert held[Dof.HEAVE] == pytest.approx(0.998, abs=0.002)
    assert abs(held[Dof.PITCH]) == pytest.approx(1.058, abs=0.003)
    assert abs(free[Dof.PITCH]) == pytest.approx(1.010, abs=0.003)
