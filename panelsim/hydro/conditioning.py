"""Symmetry and sanity of coefficients from any source: what theory demands of them."""

import numpy as np

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.errors import PanelsimError

# Motions in the plane of symmetry against those out of it, which a symmetric hull does not couple.
_IN_PLANE = (0, 2, 4)
_OUT_OF_PLANE = (1, 3, 5)
# A damping this far below zero, as a share of its own peak, is a failed solution and not rounding.
_NEGATIVE_DAMPING_ALLOWED = 0.01
# And this share of ω A is rounding, where a body makes no waves.
_NEGATIVE_DAMPING_ROUNDING = 1e-3
# Below this share of the largest translation, times half the breadth squared for rotations, a motion moves no
# water to speak of: a sphere that rolls about its centre has no peak to measure errors by.
_SMALLEST_SCALE = 1e-3


def pair_scale(coefficients: FloatArray, half_breadth: float) -> FloatArray:
    """√(peak of C_ii · peak of C_jj) (6, 6) over all frequencies: what an error of C_ij is a share of.

    `coefficients` (F, 6, 6) in SI units, `half_breadth` [m], the lever that compares rotations with
    translations.
    """
    peak = np.abs(np.einsum("fii->fi", coefficients)).max(axis=0)
    lever_squared = np.array([1.0] * 3 + [half_breadth**2] * 3)
    peak = np.maximum(peak, _SMALLEST_SCALE * peak[:3].max() * lever_squared)
    return np.sqrt(np.outer(peak, peak))


def symmetrise(
    coefficients: FloatArray, *, mirror_symmetric: bool, half_breadth: float
) -> tuple[FloatArray, float, float]:
    """Mean of coefficient matrices and their transposes, without port-starboard coupling if symmetric.

    At zero speed A and B are symmetric (Timman and Newman 1962). `coefficients` (F, 6, 6) in SI units.
    Returns them and two measures of what was removed, the largest |C_ij - C_ji| / 2 and the largest
    coupling of motions in and out of the centreplane, as shares of `pair_scale`.
    """
    scale = pair_scale(coefficients, half_breadth)
    transpose = np.swapaxes(coefficients, 1, 2)
    mean = 0.5 * (coefficients + transpose)
    transpose_error = float((0.5 * np.abs(coefficients - transpose) / scale).max())
    if not mirror_symmetric:
        return mean, transpose_error, 0.0
    coupled = np.zeros((6, 6), dtype=bool)
    coupled[np.ix_(_IN_PLANE, _OUT_OF_PLANE)] = True
    coupled |= coupled.T
    coupling = float((np.abs(mean[:, coupled]) / scale[coupled]).max())
    return np.where(coupled, 0.0, mean), transpose_error, coupling


def require_physical(
    frequencies: FloatArray, added_mass: FloatArray, radiation_damping: FloatArray, half_breadth: float
) -> None:
    """Refuse coefficients that no body can have, wherever they come from.

    `frequencies` (F,) [rad/s], `added_mass` and `radiation_damping` (F, 6, 6), `half_breadth` [m]. Raises
    PanelsimError for a value that is not finite and for a diagonal damping below -1 % of its peak, since
    waves only carry energy away.
    """
    for name, values in (("added mass", added_mass), ("radiation damping", radiation_damping)):
        if not np.isfinite(values).all():
            worst = frequencies[~np.isfinite(values).all(axis=(1, 2))][0]
            raise PanelsimError(
                f"The {name} is not finite",
                got=f"at {worst:.3g} rad/s",
                remedy="check the mesh for overlapping panels or holes below the waterline, a file for gaps",
            )
    damping_scale = np.diag(pair_scale(radiation_damping, half_breadth))
    inertia_scale = np.diag(pair_scale(added_mass, half_breadth))
    rounding = _NEGATIVE_DAMPING_ROUNDING * frequencies[:, None] * inertia_scale
    damping = np.einsum("fii->fi", radiation_damping)
    too_low = damping < -_NEGATIVE_DAMPING_ALLOWED * damping_scale - rounding
    if too_low.any():
        i, dof = np.argwhere(too_low)[0]
        raise PanelsimError(
            f"There is negative radiation damping in {DOF_NAMES[dof]}",
            got=f"{damping[i, dof]:.3g} at {frequencies[i]:.3g} rad/s, peak {damping[:, dof].max():.3g}",
            allowed="not below -1 % of the peak",
            remedy="solve it with smaller panels or to a lower frequency, normals out of the hull; look at"
            " the signs of a file of another program",
        )


def damping_roughness(frequencies: FloatArray, radiation_damping: FloatArray, half_breadth: float) -> float:
    """Largest jump of a diagonal damping off the cubic through its four neighbours, over its peak.

    An irregular frequency shows as one point out of line. `frequencies` (F,) [rad/s],
    `radiation_damping` (F, 6, 6), `half_breadth` [m].
    """
    diagonal = np.einsum("fii->fi", radiation_damping)
    peak = np.diag(pair_scale(radiation_damping, half_breadth))
    worst = 0.0
    for i in range(2, len(frequencies) - 2):
        near = [i - 2, i - 1, i + 1, i + 2]
        cubic = np.polynomial.polynomial.polyfit(frequencies[near] - frequencies[i], diagonal[near], 3)
        worst = max(worst, float((np.abs(cubic[0] - diagonal[i]) / peak).max()))
    return worst
