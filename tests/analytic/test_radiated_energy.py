"""The energy of the waves that a ship at rest sends out is what damping takes from her.

Haskind's relation gives the far waves of a motion by the force of waves upon the ship held still, so that
(Newman 1962) B_ij = k/(8π ρ g c_g) Re ∫ X_i X_j* dβ with the wave loads X per metre of waves from all
directions and the group velocity c_g = g/(2ω).
"""

import numpy as np
import pytest

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.response.response import response
from panelsim.ship.ship import Ship

COUNT = 72  # directions: the loads turn no faster than cos(20 β) here
PAIRS = [(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 5), (2, 4), (1, 3), (1, 5), (3, 5), (0, 4)]


@pytest.fixture(scope="module")
def dampings(halifax: Ship, halifax_database: HydroDatabase) -> tuple[FloatArray, FloatArray]:
    """Stored damping and that of the far waves (F, 6, 6), at stored frequencies of 0.4 to 1.4 rad/s."""
    ship, database = halifax, halifax_database
    chosen = (database.frequencies > 0.4) & (database.frequencies < 1.4)
    omega = database.frequencies[chosen]
    headings = 2 * np.pi / COUNT * np.arange(COUNT)
    table = response(ship, database, frequencies=omega, wave_headings=headings, speeds=[0.0])
    load = table.dataset["froude_krylov"].values + table.dataset["diffraction"].values[0]
    k, group_velocity = omega**2 / ship.gravity, 0.5 * ship.gravity / omega
    energy = np.einsum("bfi,bfj->fij", load, load.conj()).real * 2 * np.pi / COUNT
    scale = k / (8 * np.pi * ship.water_density * ship.gravity * group_velocity)
    return database.radiation_damping[chosen], scale[:, None, None] * energy


@pytest.mark.parametrize(("i", "j"), PAIRS)
def test_damping_is_the_energy_of_far_waves(i: int, j: int, dampings: tuple[FloatArray, FloatArray]) -> None:
    """Of the largest damping; couplings over the root of those of both motions. Measured: 0.6 %, 3.4 in roll.

    A frigate's round sections send out little by rolling, the difference of larger parts.
    """
    stored, far = dampings
    peak = np.sqrt(stored[:, i, i].max() * stored[:, j, j].max())
    error = np.abs(far - stored)[:, i, j].max() / peak
    print(DOF_NAMES[i], DOF_NAMES[j], f"{100 * error:.2f} %", np.abs(stored[:, i, j]).max() / peak)
    assert error < (0.05 if 3 in (i, j) else 0.01)
    # Neither 0 nor of the other sign would pass.
    assert np.abs(stored[:, i, j]).max() > 0.05 * peak
