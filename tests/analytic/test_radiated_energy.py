"""The energy of the waves that a ship at rest sends out is what damping takes from her.

Haskind's relation gives the far waves of a motion by the force of waves upon the ship held still, so that
(Newman 1962) B_ij = k/(8π ρ g c_g) Re ∫ X_i X_j* dβ with the wave loads X per metre of waves from all
directions and the group velocity c_g = g/(2ω).
"""

from functools import cache

import numpy as np
import pytest

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.response.response import response
from panelsim.ship.ship import Ship

COUNT = 72  # directions: the loads turn no faster than cos(20 β) here
PAIRS = [(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 5), (2, 4), (1, 3), (1, 5), (3, 5), (0, 4)]


@cache
def from_far_waves(ship: Ship, database: HydroDatabase) -> tuple[FloatArray, FloatArray]:
    """Stored damping and that of the far waves (F, 6, 6), at stored frequencies of 0.4 to 1.4 rad/s."""
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
def test_damping_is_the_energy_of_far_waves(
    i: int, j: int, halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """Within 2 % of the largest damping of the pair; couplings over the root of those of both motions."""
    stored, far = from_far_waves(halifax, halifax_database)
    peak = np.sqrt(stored[:, i, i].max() * stored[:, j, j].max())
    error = np.abs(far - stored)[:, i, j].max() / peak
    print(DOF_NAMES[i], DOF_NAMES[j], f"{100 * error:.2f} %", np.abs(stored[:, i, j]).max() / peak)
    assert error < 0.02
    # Neither 0 nor of the other sign would pass.
    assert np.abs(stored[:, i, j]).max() > 0.05 * peak
