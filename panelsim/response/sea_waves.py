"""Regular waves that stand for a sea on some courses: where to solve, and how much energy is there.

A sea of components is these components. A spectrum is integrated over the wave frequency, not over the
frequency of encounter, in narrow bands, and over directions: so several waves that meet a ship at one
frequency of encounter all count, and the density over it, which is infinite in following seas, never enters.
"""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.point_spectrum import PointSpectrum

# Shares of the energy that are left out below and above, and above which bands are coarse: no ship moves in
# such short waves, but she rises and falls beside them, so that the relative motion is the wave itself.
_TAILS = (1e-5, 1e-4)
_SHORT_WAVES = 2e-3
_COARSE_BAND = 0.05
# Of the frequency. Measured on a frigate up to 20 knots, against bands and directions five times as narrow:
# roll of 9 % of critical damping is within 0.2 %, of 1.5 % within 1 %, the other motions within 0.1 %.
_BAND = 0.012
# Directions around the ship, as many as a spread takes to carry its energy. Those of one frequency lie
# between those of the next: a resonance is a narrow ridge across both, and is met more evenly so.
_RINGS = (36, 72, 144, 288, 720)
_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
_CARRIED = 2e-3
_LEAST_ENERGY = 0.9


@dataclass(frozen=True, eq=False)
class SeaWaves:
    """Waves `frequency` (M,) [rad/s] and `wave_heading` (M,) [rad], and the sea that they make on H courses.

    `courses` has for each the indices of its waves and the variance [m2] that each carries there. `spectral`
    where they stand for a continuous spectrum, `energy_share` the share of its energy that they carry.
    """

    frequency: FloatArray
    wave_heading: FloatArray
    courses: tuple[tuple[IntArray, FloatArray], ...]
    spectral: bool
    energy_share: float


def waves_of_components(seaway: Seaway, ship_headings: FloatArray) -> SeaWaves:
    """The components of a sea as met on compass courses (H,) [rad]."""
    components = seaway.components
    if not components.count:
        raise PanelsimError("There are no waves to respond to", got="a sea without components")
    turned = components.wave_heading + (seaway.ship_heading - ship_headings[:, None])
    variance = 0.5 * components.amplitude**2
    index = np.arange(turned.size).reshape(turned.shape)
    return SeaWaves(
        np.tile(components.frequency, len(turned)),
        turned.ravel(),
        tuple((of_course, variance) for of_course in index),
        spectral=False,
        energy_share=1.0,
    )


def waves_of_spectrum(
    spectrum: PointSpectrum, wave_headings: FloatArray, reach: tuple[float, float]
) -> SeaWaves:
    """A long-crested sea from each heading (H,) [rad]; `reach` [rad/s] are frequencies that can be solved."""
    omega, width, share = _bands(spectrum, reach)
    variance = spectrum.density(omega) * width
    index = np.arange(len(wave_headings) * len(omega)).reshape(len(wave_headings), -1)
    return SeaWaves(
        np.tile(omega, len(wave_headings)),
        np.repeat(wave_headings, len(omega)),
        tuple((of_course, variance) for of_course in index),
        spectral=True,
        energy_share=share,
    )


def waves_of_directions(
    spectrum: DirectionalSpectrum, ship_headings: FloatArray, reach: tuple[float, float]
) -> SeaWaves:
    """A short-crested sea as met on compass courses (H,) [rad].

    The headings that are solved are the same for all courses. Raises PanelsimError for a spectrum that is too
    narrow to be carried by directions half a degree apart.
    """
    omega, width, share = _bands(spectrum.point, reach)
    expected = float(np.sum(spectrum.point.density(omega) * width))
    turn = np.mod(_GOLDEN * np.arange(len(omega)), 1.0)
    for count in _RINGS:
        heading = 2.0 * np.pi / count * (np.arange(count)[:, None] + turn)
        # At β = ν + π - χ a ship on the course χ meets the waves that come from ν.
        direction = np.mod(heading - np.pi + ship_headings[:, None, None], 2.0 * np.pi)
        variance = spectrum.density(omega, direction) * width * (2.0 * np.pi / count)
        carried = variance.sum(axis=(1, 2)) / expected
        if np.abs(carried - 1.0).max() < _CARRIED:
            break
    else:
        raise PanelsimError(
            "The spectrum is too narrow for a short-crested sea",
            got=f"{100 * carried.min():.3g} % of the energy carried by {count} directions",
            remedy="take a long-crested sea: the point spectrum and wave_headings",
        )
    used = np.flatnonzero(variance.any(axis=0).ravel())
    return SeaWaves(
        np.tile(omega, count)[used],
        heading.ravel()[used],
        tuple((np.arange(len(used)), of_course.ravel()[used]) for of_course in variance),
        spectral=True,
        energy_share=share,
    )


def _bands(spectrum: PointSpectrum, reach: tuple[float, float]) -> tuple[FloatArray, FloatArray, float]:
    """Middle and width of the frequency bands (F,) [rad/s], and the share of the energy within them."""
    low = max(spectrum.frequency_below(_TAILS[0]), reach[0])
    high = min(spectrum.frequency_below(1.0 - _TAILS[1]), reach[1])
    share = spectrum.energy_between(low, high) if low < high else 0.0
    if share < _LEAST_ENERGY:
        raise PanelsimError(
            "The diffraction tables hold too little of the sea",
            got=f"{100 * share:.1f} % of its energy between {reach[0]:.3g} and {reach[1]:.3g} rad/s",
            allowed=f"{100 * _LEAST_ENERGY:g} % or more",
            remedy="compute coefficients at more wave frequencies",
        )
    short = float(np.clip(spectrum.frequency_below(1.0 - _SHORT_WAVES), low, high))
    edges = np.concatenate([_edges(low, short, _BAND), _edges(short, high, _COARSE_BAND)[1:]])
    return 0.5 * (edges[1:] + edges[:-1]), np.diff(edges), share


def _edges(low: float, high: float, band: float) -> FloatArray:
    """Edges of bands of a share of their frequency or less, low to high [rad/s]; one edge if they meet."""
    return np.geomspace(low, high, 1 + int(np.ceil(np.log(high / low) / band)))
