"""Frequencies that a database is solved at, by the length of the ship."""

import numpy as np

from panelsim.conventions import FloatArray

# For a ship of 120 m [rad/s]; others go as 1/√L. Stern-quartering seas meet the ship at
# less than 0.3 rad/s, hence the fine start; waves shorter than half the ship turn the phase of the potentials
# quickly, hence the fine end.
_REFERENCE_LENGTH = 120.0
_REFERENCE_FREQUENCIES = np.array([*np.arange(4) / 20.0, *np.arange(2, 10) / 10.0, *np.arange(20, 53) / 20.0])

# Strips are led to rest from 0.4 rad/s, which wants closer steps; and sections resolve shorter waves than
# panels do, which a ship at speed meets in head seas.
_MORE_FOR_STRIPS = np.array([0.25, 0.35, 0.45, 0.55, *np.arange(14, 26) / 5.0])


def frequency_grid(length: float, highest: float = np.inf) -> FloatArray:
    """Frequencies (F,) [rad/s] from 0 for a ship of this length [m], drawn together to end by `highest`."""
    scale = np.sqrt(_REFERENCE_LENGTH / length)
    return _REFERENCE_FREQUENCIES * min(scale, highest / _REFERENCE_FREQUENCIES[-1])


def strip_frequency_grid(length: float, highest: float = np.inf) -> FloatArray:
    """`frequency_grid` with closer steps at the lower end, and on to `highest` [rad/s] or 5 at 120 m."""
    grid = frequency_grid(length, highest)
    more = _MORE_FOR_STRIPS * grid[-1] / _REFERENCE_FREQUENCIES[-1]
    return np.union1d(grid, more[more <= highest])
