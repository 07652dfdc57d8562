"""How much one run can tell: when its waves come again, and how far its variance depends on the seed."""

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY, ComplexArray, FloatArray
from panelsim.seaway.checks import require_positive
from panelsim.seaway.components import WaveComponents

BLOCK = 256  # rows of the tables that are held at once


def repeat_time(
    components: WaveComponents,
    speed: float,
    duration: float,
    *,
    likeness: float = 0.95,
    gravity: float = STANDARD_GRAVITY,
) -> float | None:
    """First time [s] within the duration after which the ship meets nearly the same waves again.

    The record repeats where its autocorrelation Σ a² cos(ω_e τ) / Σ a² comes back above `likeness`, after
    its envelope has fallen below one half: in a narrow swell the next wave is like the last, but the groups
    differ. A grid of N even frequency steps repeats early: the report's 0.1 rad/s grid after 346 s at
    20 knots and 150°. None where it does not within the duration.
    """
    if components.count < 2 or components.variance == 0.0:
        return None
    omega = components.encounter_frequency(speed, gravity)
    weight = components.amplitude**2 / np.sum(components.amplitude**2)
    # An eighth of a radian of the mean frequency resolves the peaks of the autocorrelation.
    step = 0.125 / max(float(np.sqrt(np.sum(weight * omega**2))), 1e-6)
    correlation = _autocorrelation(weight, omega, step, int(np.ceil(duration / step)))
    envelope = np.abs(correlation)
    fallen = np.flatnonzero(envelope < 0.5)
    if not fallen.size:
        return None
    again = fallen[0] + np.flatnonzero(correlation[fallen[0] :].real > likeness)
    if not again.size:
        return None
    # The highest wave of the first group that is like the one at 0, not the first of its flank.
    end = np.flatnonzero(envelope[again[0] :] < likeness)
    stop = again[0] + (end[0] if end.size else len(envelope))
    return float(step * (again[0] + np.argmax(correlation[again[0] : stop].real)))


def _autocorrelation(weight: FloatArray, omega: FloatArray, step: float, count: int) -> ComplexArray:
    """Σ w e^{iωτ} at the lags τ = 0, step … (count,), whose modulus is the envelope.

    As products of matrices: e^{iω(τ_a + τ_b)} with τ_a a multiple of BLOCK steps.
    """
    within = weight[:, None] * np.exp(1j * np.outer(omega, step * np.arange(BLOCK)))
    correlation = [np.empty(0, dtype=complex)]
    for first in range(0, count, BLOCK**2):
        start = step * np.arange(first, min(first + BLOCK**2, count), BLOCK)
        correlation.append((np.exp(1j * np.outer(start, omega)) @ within).ravel())
    return np.concatenate(correlation)[:count]


def variance_scatter(
    components: WaveComponents, speed: float, duration: float, *, gravity: float = STANDARD_GRAVITY
) -> float:
    """Standard deviation over seeds of the variance of one record, over its mean; half of it for the RMS.

    The record is the elevation where the ship is, over `duration` T [s] at `speed` [m/s]. With phases that
    are independent and uniform, the mean of ζ² over T has the variance
    Σ_{i<j} ½ a_i² a_j² (s²((ω_i − ω_j)T/2) + s²((ω_i + ω_j)T/2)) + Σ ⅛ a_i⁴ s²(ω_i T), s(x) = sin x / x and
    ω the signed frequencies of encounter, about the mean ½ Σ a². Many small components much closer
    than 2π/T give the scatter √(2π ∫S² dω / T)/m0 that a record of any real sea has, S over the frequency of
    encounter, which falls as 1/√T; of two large ones it does not fall before T is longer than their beat.
    Zero in calm water.

    Raises PanelsimError for a duration that is not positive.
    """
    duration = require_positive("duration", duration, "s")
    if components.variance == 0.0:
        return 0.0
    omega = components.encounter_frequency(speed, gravity)
    energy = 0.5 * components.amplitude**2 / components.variance
    total = 0.0
    for first in range(0, components.count, BLOCK):
        rows = slice(first, first + BLOCK)
        # np.sinc(x) is sin(πx)/(πx).
        pairs = (
            np.sinc(np.subtract.outer(omega[rows], omega) * duration / (2 * np.pi)) ** 2
            + np.sinc(np.add.outer(omega[rows], omega) * duration / (2 * np.pi)) ** 2
        )
        total += float(energy[rows] @ pairs @ energy)
    # A component does not beat with itself, and its own double frequency was counted twice.
    itself = 1.0 + 0.5 * np.sinc(omega * duration / np.pi) ** 2
    return float(np.sqrt(max(total - np.sum(energy**2 * itself), 0.0)))
