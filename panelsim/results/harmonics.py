"""Harmonics of motions in regular waves, after the transient, by least squares over whole periods."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError

LEAST_SAMPLES = 4  # a period for each harmonic: twice of what tells one from the next


@dataclass(frozen=True, eq=False)
class Harmonics:
    """Mean (K,) and harmonics (N, K) of K signals, in their units: mean + Re Σ z_n exp(i n ω t).

    `complex_amplitude` z_n, n = 1, 2 …; `frequency` ω [rad/s], positive. `change` (K,) is the largest
    difference of the mean and the harmonics from those of the window before, `rest` (K,) the RMS of what the
    harmonics leave over in the last window: both are small of what is periodic.
    """

    frequency: float
    mean: FloatArray
    complex_amplitude: ComplexArray
    change: FloatArray
    rest: FloatArray

    @property
    def amplitude(self) -> FloatArray:
        """Amplitudes |z_n| (N, K)."""
        return np.abs(self.complex_amplitude)

    @property
    def phase(self) -> FloatArray:
        """Phases (N, K) [rad], a lead."""
        return np.angle(self.complex_amplitude)

    @property
    def unsettled(self) -> FloatArray:
        """`change` over the first harmonic (K,); NaN of what does not move."""
        first = self.amplitude[0]
        return np.divide(self.change, first, out=np.full(len(first), np.nan), where=first > 0.0)


def harmonics(
    time: FloatArray, signals: FloatArray, frequency: float, *, after: float, count: int = 3
) -> Harmonics:
    """Fit `count` harmonics of `frequency` [rad/s] to signals (T, K) at `time` (T,) [s].

    The time from `after` [s] on is parted into two windows of the same whole number of periods that end with
    the record; the result is that of the last. A frequency below 0, of a wave that the ship overtakes, is
    that of the same motion above 0. Raises PanelsimError where there are not two periods, for samples too far
    apart for the harmonics, and for signals that are not finite there.
    """
    omega = abs(frequency)
    whole = int((time[-1] - after) * omega / (4.0 * np.pi) + 1e-9)
    if whole < 1:
        raise PanelsimError(
            "The record is too short for its harmonics",
            got=f"{time[-1] - after:g} s after {after:g} s, at {frequency:g} rad/s",
            allowed="two periods or more",
            remedy="run longer",
        )
    window = whole * 2.0 * np.pi / omega
    step = float(np.max(np.diff(time)))
    if 2.0 * np.pi / (omega * step) < LEAST_SAMPLES * count:
        raise PanelsimError(
            "The samples are too far apart for the harmonics",
            got=f"{2.0 * np.pi / (omega * step):.3g} samples a period",
            allowed=f"{LEAST_SAMPLES * count} or more for {count} harmonics",
        )
    before, last = (
        _fitted(time, signals, omega, time[-1] - end * window, window, count) for end in (2.0, 1.0)
    )
    change = np.abs(last[0] - before[0]).max(axis=0)
    return Harmonics(omega, last[0][0].real, last[0][1:], change, last[1])


def _fitted(
    time: FloatArray, signals: FloatArray, omega: float, start: float, length: float, count: int
) -> tuple[ComplexArray, FloatArray]:
    """Mean and complex amplitudes (1 + N, K) in a window, and the RMS (K,) of the rest."""
    # Rounding of the times drops no sample at the ends.
    room = 1e-6 * length
    rows = (time >= start - room) & (time <= start + length + room)
    if not np.isfinite(signals[rows]).all():
        raise PanelsimError(
            "The record has no harmonics", got="values that are not finite", remedy="see how the run ended"
        )
    angle = omega * time[rows, None] * np.arange(1, count + 1)
    basis = np.column_stack([np.ones(rows.sum()), np.cos(angle), np.sin(angle)])
    found = np.linalg.lstsq(basis, signals[rows], rcond=None)[0]
    rest = np.sqrt(np.mean((signals[rows] - basis @ found) ** 2, axis=0))
    fitted = np.concatenate([found[:1], found[1 : count + 1] - 1j * found[count + 1 :]])
    return fitted, rest
