"""Coefficients and potentials between the stored frequencies, beyond the last and below 0."""

import numpy as np
from scipy.interpolate import CubicSpline

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.hydro.database import HydroDatabase


def at_frequency(
    stored: FloatArray, values: ComplexArray, infinite: FloatArray, frequency: FloatArray
) -> ComplexArray:
    """Values (M, ...) at signed frequencies (M,) [rad/s]; at -ω the conjugate of that at ω.

    `values` (F, ...) at the `stored` frequencies (F,) [rad/s], ascending from 0, `infinite` (...) their
    limit. Cubic between them. The real part is even in ω and the imaginary part, B(ω)/ω or its like, vanishes
    at rest as ω² or faster, so both leave 0 with no slope. Beyond the last frequency, where no wave is
    resolved, f(ω) = f(∞) + (f(last) - f(∞)) (last/ω)²: B, of which f has B/ω, falls as 1/ω there.
    """
    last = stored[-1]
    magnitude = np.abs(frequency)
    spline = CubicSpline(stored, values, bc_type=("clamped", "not-a-knot"))
    like_values = (len(frequency), *(1,) * (values.ndim - 1))
    fading = np.reshape((last / np.maximum(magnitude, last)) ** 2, like_values)
    found = infinite + (spline(np.minimum(magnitude, last)) - infinite) * fading
    return np.where(np.reshape(frequency < 0.0, like_values), found.conj(), found)


def complex_inertia(database: HydroDatabase, frequency: FloatArray) -> ComplexArray:
    """Z = A + B/(iω) (M, 6, 6) of a ship at rest at signed frequencies (M,) [rad/s]."""
    stored = database.frequencies
    ratio = np.zeros_like(database.radiation_damping)
    ratio[1:] = database.radiation_damping[1:] / stored[1:, None, None]
    return at_frequency(stored, database.added_mass - 1j * ratio, database.added_mass_infinite, frequency)
