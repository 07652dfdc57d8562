"""The characteristic heights, periods and widths of a sea, of its spectrum and of its components."""

from dataclasses import dataclass

import numpy as np
from scipy.special import erfc

from panelsim.conventions import STANDARD_GRAVITY
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_positive
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.spectra.point_spectrum import PointSpectrum, bandwidth_of
from panelsim.seaway.steepness import nominal_steepness

# Mean of the highest tenth of Rayleigh-distributed heights over √m0: √8 (√ln 10 + 5 √π erfc √ln 10) = 5.0909.
ONE_TENTH_FACTOR = float(np.sqrt(8) * (np.sqrt(np.log(10)) + 5 * np.sqrt(np.pi) * erfc(np.sqrt(np.log(10)))))


@dataclass(frozen=True)
class SeaCharacteristics:
    """Characteristic values of a sea: moments m_n [m² (rad/s)ⁿ], heights [m], periods [s] and widths [-].

    `significant_wave_height` is 4 √m0, which for a spectrum given by its height may be a little off the
    nominal one. `peakedness` is Q_p of Goda, NaN for components, which have no density; `peak_period` is NaN
    where no one frequency carries the most. `upper_frequency` [rad/s] is where m4 ends, and with it all that
    rests on it: `crest_period`, `bandwidth`, `corrected_significant_wave_height`, `rms_slope` [rad].
    """

    m_minus_1: float
    m0: float
    m1: float
    m2: float
    m3: float
    m4: float
    significant_wave_height: float
    corrected_significant_wave_height: float
    mean_wave_height: float
    rms_wave_height: float
    one_tenth_wave_height: float
    peak_period: float
    mean_period: float
    zero_crossing_period: float
    energy_period: float
    crest_period: float
    bandwidth: float
    narrowness: float
    peakedness: float
    nominal_steepness: float
    rms_slope: float
    upper_frequency: float


def characteristics(
    spectrum: PointSpectrum, upper_frequency: float, gravity: float = STANDARD_GRAVITY
) -> SeaCharacteristics:
    """Characteristic values of a spectrum; the moments that diverge go to `upper_frequency` [rad/s].

    m4, and m0 and m2 beside it in the bandwidth and the crest period, are taken up to that frequency; m₋₁ to
    m3 over the whole spectrum, but for an Ochi-Hubble sea whose shape lets one of them diverge.
    Raises PanelsimError where there is no energy below the upper frequency.
    """
    upper = require_positive("upper_frequency", upper_frequency, "rad/s")
    moments = [spectrum.moment(n, None if n < spectrum.tail_power - 1 else upper) for n in range(-1, 4)]
    return _characteristics(
        [*moments, spectrum.moment(4, upper)],
        peak_period=spectrum.peak_period,
        crest_period=spectrum.crest_period(upper),
        bandwidth=spectrum.bandwidth(upper),
        peakedness=spectrum.peakedness,
        upper_frequency=upper,
        gravity=gravity,
    )


def component_characteristics(
    components: WaveComponents, gravity: float = STANDARD_GRAVITY
) -> SeaCharacteristics:
    """Characteristic values of wave components: sums m_n = Σ ½ a² ωⁿ over all of them.

    The peak is the wave frequency that carries the most energy, all its directions together. The upper
    frequency is the largest. Raises PanelsimError where there are no waves.
    """
    energy, omega = 0.5 * components.amplitude**2, components.frequency
    if not energy.any():
        raise PanelsimError(
            "A sea without waves has no characteristic values", got=f"{len(omega)} components"
        )
    moments = [float(np.sum(energy * omega**n)) for n in range(-1, 5)]
    _, m0, _, m2, _, m4 = moments
    return _characteristics(
        moments,
        peak_period=_peak_period(components),
        crest_period=float(2 * np.pi * np.sqrt(m2 / m4)),
        bandwidth=bandwidth_of(m0, m2, m4),
        peakedness=float("nan"),
        upper_frequency=float(omega.max()),
        gravity=gravity,
    )


def _characteristics(
    moments: list[float],
    *,
    peak_period: float,
    crest_period: float,
    bandwidth: float,
    peakedness: float,
    upper_frequency: float,
    gravity: float,
) -> SeaCharacteristics:
    """All values from the moments m₋₁ … m4, and what does not follow from them."""
    m_minus_1, m0, m1, m2, m3, m4 = moments
    height = 4 * float(np.sqrt(m0))
    return SeaCharacteristics(
        m_minus_1=m_minus_1,
        m0=m0,
        m1=m1,
        m2=m2,
        m3=m3,
        m4=m4,
        significant_wave_height=height,
        corrected_significant_wave_height=height * float(np.sqrt(1 - bandwidth**2 / 2)),
        mean_wave_height=float(np.sqrt(2 * np.pi * m0)),
        rms_wave_height=float(np.sqrt(8 * m0)),
        one_tenth_wave_height=ONE_TENTH_FACTOR * float(np.sqrt(m0)),
        peak_period=peak_period,
        mean_period=2 * np.pi * m0 / m1,
        zero_crossing_period=float(2 * np.pi * np.sqrt(m0 / m2)),
        energy_period=2 * np.pi * m_minus_1 / m0,
        crest_period=crest_period,
        bandwidth=bandwidth,
        narrowness=float(np.sqrt(max(m0 * m2 / m1**2 - 1, 0.0))),
        peakedness=peakedness,
        nominal_steepness=nominal_steepness(height, peak_period),
        rms_slope=float(np.sqrt(m4)) / gravity,
        upper_frequency=upper_frequency,
    )


def _peak_period(components: WaveComponents) -> float:
    """Period [s] of the frequency that carries the most energy; NaN where several carry as much."""
    frequency, owner = np.unique(components.frequency, return_inverse=True)
    energy = np.bincount(owner, components.amplitude**2)
    most = np.flatnonzero(energy > (1 - 1e-9) * energy.max())
    return float(2 * np.pi / frequency[most[0]]) if len(most) == 1 else float("nan")
