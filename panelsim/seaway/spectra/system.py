"""One system of waves by height, peak and shape: the form that Bretschneider and Ochi-Hubble spectra share.

S(ω) = (h²/4) (c ω_p⁴)^λ / Γ(λ) · ω^−(4λ+1) exp(−c (ω_p/ω)⁴), c = λ + 1/4: a term of TM 2003-190 (49). With
q = c (ω_p/ω)⁴ the integrals of ωⁿ S are incomplete gamma functions:
m_n = (h²/16) (c^¼ ω_p)ⁿ Γ(λ − n/4, q)/Γ(λ).
"""

import numpy as np
from scipy.special import exp1, gamma, gammaincc

from panelsim.conventions import FloatArray

# At a tenth of the peak frequency the exponent is below −2500: the density is 0 in any number of digits.
SMALLEST_RATIO = 0.1


def system_density(omega: FloatArray, height: float, peak_frequency: float, shape: float) -> FloatArray:
    """Spectral density [m² s/rad] at frequencies [rad/s]; height in m, peak frequency in rad/s."""
    c = shape + 0.25
    ratio = peak_frequency / np.maximum(omega, SMALLEST_RATIO * peak_frequency)
    scale = height**2 / (4 * peak_frequency) * c**shape / gamma(shape)
    return scale * ratio ** (4 * shape + 1) * np.exp(-c * ratio**4)


def system_moment(
    n: int, height: float, peak_frequency: float, shape: float, upper_frequency: float = np.inf
) -> float:
    """Moment m_n up to a frequency [rad/s]; without one n must be below 4 λ."""
    c = shape + 0.25
    q = c * (peak_frequency / max(upper_frequency, SMALLEST_RATIO * peak_frequency)) ** 4
    scale = height**2 / 16 * (c**0.25 * peak_frequency) ** n
    return float(scale * _upper_gamma(shape - n / 4, q) / gamma(shape))


def system_share_below(frequency: float, peak_frequency: float, shape: float) -> float:
    """Share of the system's m0 below a frequency [rad/s]."""
    ratio = peak_frequency / max(frequency, SMALLEST_RATIO * peak_frequency)
    return float(gammaincc(shape, (shape + 0.25) * ratio**4))


def _upper_gamma(a: float, q: float) -> float:
    """Γ(a, q) for any a, by the recurrence Γ(a + 1, q) = a Γ(a, q) + q^a exp(−q) where a is negative."""
    if a > 0:
        return float(gammaincc(a, q) * gamma(a))
    if a == 0:
        return float(exp1(q))
    return float((_upper_gamma(a + 1, q) - q**a * np.exp(-q)) / a)
