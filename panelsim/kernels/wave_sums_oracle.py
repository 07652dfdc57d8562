"""The slow, obvious NumPy twin of the wave sums; quicker than the kernel where there is little to sum."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.kernels.phases import TURN, turns
from panelsim.kernels.tables import WaveTables

# A point this little above the water counts as at its surface: the elevation there comes from another sum
# of the same waves, or from a position in other axes, and may differ in its last digits.
SURFACE_TOLERANCE = 1e-9  # m
CHUNK = 300_000  # points times components at once, so that the temporaries stay in the cache


def wave_sums(
    waves: WaveTables, points: FloatArray, coefficients: ComplexArray, *, stretching: str
) -> tuple[FloatArray, FloatArray]:
    """Elevation (P,) [m] and sums (P, Q) at the points; arguments as in `panelsim.kernels.wave_sums`."""
    elevation, sums = np.empty(len(points)), np.empty((len(points), coefficients.shape[1]))
    step = max(CHUNK // max(len(waves.amplitude), 1), 1)
    for first in range(0, len(points), step):
        rows = slice(first, first + step)
        elevation[rows], sums[rows] = _chunk(waves, points[rows], coefficients, stretching)
    return elevation, sums


def _chunk(
    waves: WaveTables, points: FloatArray, coefficients: ComplexArray, stretching: str
) -> tuple[FloatArray, FloatArray]:
    x, y, z, time = points.T[:, :, None]
    turned = turns(x, waves.wavenumber_x) + turns(y, waves.wavenumber_y)
    turned -= turns(time, waves.encounter_frequency) + turns(1.0, waves.phase)
    phase = TURN * turned
    cosine = np.cos(phase)
    elevation = (waves.amplitude * cosine).sum(axis=-1)
    if waves.second_order:
        # ½ a² k cos 2θ, TM 2003-190 (17)
        elevation += (0.5 * waves.amplitude**2 * waves.wavenumber * np.cos(2.0 * phase)).sum(axis=-1)
    if not coefficients.shape[1]:
        return elevation, np.empty((len(points), 0))
    height = z[:, 0] - elevation
    wet = height <= SURFACE_TOLERANCE
    depth = height if stretching == "wheeler" else z[:, 0]
    decay = np.exp(waves.wavenumber * np.minimum(depth, 0.0)[:, None])
    cosine, sine = decay * cosine, decay * np.sin(phase)
    sums = [(c.real * cosine + c.imag * sine).sum(axis=-1) for c in coefficients.T]
    return elevation, np.where(wet[:, None], np.stack(sums, axis=-1), 0.0)
