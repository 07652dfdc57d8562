"""Wigley hull III by strip theory against the towing tank, at Froude numbers 0 and 0.3 in head waves.

Source: J.M.J. Journée, Experiments and Calculations on 4 Wigley Hull Forms in Head Waves, Delft University
of Technology, Report 0909 (1992). Numbers read from its figures, good to about 10 %; the height of the
centre of gravity is not published. The tank has little more than half of the damping of pitch that
strip theory has at speed, and two thirds of that of three dimensions with the same speed terms.
"""

from functools import cache

import numpy as np
import pytest

from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.speed_terms import radiation_at_speed, salvesen_tuck_faltinsen
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

LENGTH, FROUDE = 3.0, 0.3


@cache
def wigley() -> tuple[Ship, HydroDatabase]:
    ship = load_ship("wigley_iii")
    return ship, HydroDatabase.compute(ship, "strip")


def exciting(lambda_over_length: float, speed: float) -> tuple[np.ndarray, float, float]:
    """Load (6,) of a head wave of 1 m, its frequency of encounter [rad/s] and its wavenumber [1/m]."""
    ship, database = wigley()
    k = 2 * np.pi / (lambda_over_length * LENGTH)
    wave, beta = np.sqrt([k * ship.gravity]), np.array([np.pi])
    components = WaveComponents(np.ones(1), wave, beta, np.zeros(1))
    load = froude_krylov_transfer(ship, components) + diffraction_load(database, wave, beta, speed)
    return load[0], float(encounter_frequency(wave, beta, speed, ship.gravity)[0]), k


def speed() -> float:
    return FROUDE * float(np.sqrt(wigley()[0].gravity * LENGTH))


@pytest.mark.parametrize(
    ("lambda_over_length", "heave", "pitch"), [(1.25, 0.345, 0.444), (1.5, 0.454, 0.546)]
)
def test_wave_loads_at_froude_number_0_3(lambda_over_length: float, heave: float, pitch: float) -> None:
    """|X3| / (C33 ζ) and |X5| / (k C55 ζ), incident wave and diffraction with its speed terms."""
    load, _, k = exciting(lambda_over_length, speed())
    stiffness = wigley()[0].hydrostatics.stiffness
    got = np.abs([load[2] / stiffness[2, 2], load[4] / (k * stiffness[4, 4])])
    print(f"λ/L {lambda_over_length}: X3 {got[0]:.3f} ({heave}), X5 {got[1]:.3f} ({pitch})")
    # -5 and -1 % in heave, +6 % in pitch, within the 10 % of the reading.
    np.testing.assert_allclose(got, [heave, pitch], rtol=0.08)


@pytest.mark.parametrize(
    ("lambda_over_length", "heave", "pitch"), [(1.0, 0.29, 0.57), (1.5, 0.57, 0.57), (2.0, 0.74, 0.50)]
)
def test_motions_at_rest(lambda_over_length: float, heave: float, pitch: float) -> None:
    """|heave| / ζ and |pitch| / (2π ζ/L)."""
    ship, database = wigley()
    load, omega, _ = exciting(lambda_over_length, 0.0)
    radiation = radiation_at_speed(database, np.array([omega]), 0.0).impedance[0]
    impedance = radiation + ship.hydrostatics.stiffness - omega**2 * ship.inertia
    plane = np.ix_([0, 2, 4], [0, 2, 4])
    motions = np.abs(np.linalg.solve(impedance[plane], load[[0, 2, 4]]))
    got = motions[1:] / [1.0, 2 * np.pi / LENGTH]
    print(f"λ/L {lambda_over_length}: heave {got[0]:.3f} ({heave}), pitch {got[1]:.3f} ({pitch})")
    # Heave -1, +10 and +5 %, pitch -8, -9 and -12 %, as three dimensions: reading (10 %) and unknown KG.
    np.testing.assert_allclose(got, [heave, pitch], rtol=0.14)


@pytest.mark.parametrize(
    ("frequency", "added_mass", "damping"), [(2.22, 0.707, 1.963), (2.78, 0.537, 1.994), (3.34, 0.465, 1.854)]
)
def test_forced_heave_at_froude_number_0_3(frequency: float, added_mass: float, damping: float) -> None:
    """A33 / (ρ V) and B33 / (ρ V) √(L/g) over ω_e √(L/g)."""
    ship, database = wigley()
    second = np.sqrt(LENGTH / ship.gravity)
    a, b = salvesen_tuck_faltinsen(database, np.array([frequency / second]), speed())
    got = a[0, 2, 2] / ship.mass, b[0, 2, 2] / ship.mass * second
    print(f"{frequency}: A33 {got[0]:.3f} ({added_mass}), B33 {got[1]:.3f} ({damping})")
    # Added mass +1, 0 and -4 %; damping 13, 10 and 9 % too much, as theory is known to have at speed.
    assert got[0] == pytest.approx(added_mass, rel=0.06)
    assert got[1] / damping == pytest.approx(1.11, abs=0.05)


def test_forced_pitch_at_froude_number_0_3() -> None:
    """B55 / (ρ V L²) √(L/g) = 0.073 at ω_e √(L/g) = 2.2; strips have 1.8 times that, panels 1.4."""
    ship, database = wigley()
    second = np.sqrt(LENGTH / ship.gravity)
    _, b = salvesen_tuck_faltinsen(database, np.array([2.2 / second]), speed())
    got = b[0, 4, 4] / (ship.mass * LENGTH**2) * second
    print(f"B55 {got:.3f} (0.073)")
    assert got == pytest.approx(1.8 * 0.073, rel=0.05)
