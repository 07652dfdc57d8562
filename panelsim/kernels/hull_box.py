"""How much water about a moving hull a wave grid must cover, and how exactly."""

from itertools import product

import numpy as np

from panelsim.conventions import FloatArray, rotation_to_earth
from panelsim.kernels.grid_plan import LEAST_TOLERANCE, GridBox
from panelsim.kernels.tables import WaveTables

# A grid is made for headings within half of this of its own axes, and another one beyond.
SECTOR = np.deg2rad(10.0)
# Attitudes that the box covers; what leaves it is summed directly, which costs time but no accuracy.
ROLLS, PITCHES = np.deg2rad([-30.0, -15.0, 0.0, 15.0, 30.0]), np.deg2rad([-5.0, 0.0, 5.0])
# Heave and crest together, in standard deviations of the sea.
RISE = 3.0
MARGIN = 1.0  # m: a hull of one flat panel has a box too


def hull_tolerance(points: FloatArray, waves: WaveTables, tolerance: float) -> float:
    """The tolerance of a grid, such that the load of the waves has that of the elevation.

    On a hull that is small against the waves their pressure all but cancels: to the part k L. k is the mean
    over the energy, L the length of the hull, `points` (P, 3) in ship axes.
    """
    energy = waves.amplitude**2
    length = float(np.ptp(points, axis=0).max())
    share = length * float(energy @ waves.wavenumber) / float(energy.sum())
    return max(tolerance * min(share, 1.0), min(tolerance, LEAST_TOLERANCE))


def hull_box(points: FloatArray, waterline: float, standard_deviation: float) -> GridBox:
    """Box about a hull, `points` (P, 3) in ship axes, calm water at `waterline` [m], in such a sea [m]."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for roll, pitch, yaw in product(ROLLS, PITCHES, 0.5 * SECTOR * np.array([-1.0, 0.0, 1.0])):
        turned = points @ rotation_to_earth(roll, pitch, yaw).T
        low, high = np.minimum(low, turned.min(axis=0)), np.maximum(high, turned.max(axis=0))
    depth = max(waterline - low[2], 0.0) + RISE * standard_deviation + MARGIN
    return GridBox(low[0] - MARGIN, high[0] + MARGIN, low[1] - MARGIN, high[1] + MARGIN, float(depth))
