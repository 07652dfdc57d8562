"""Extremes of a roll decay record, and the damping that their extinction curve tells."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError

_FIRST_FEW = 3
_LEAST_SPREAD = 0.01
# An extreme counts if it stands out by this share of the range of the record: smaller ones are noise.
_PROMINENCE = 0.05


@dataclass(frozen=True)
class Extinction:
    """What the extremes of a decay record tell.

    `linear` [1/s] and `quadratic` [1/rad] as in `RollDecay`; `period` [s] of the natural roll; `offset` [rad]
    and `trend` [rad/s] of the line about which it rolls, from time 0; `extremes` counts those used.
    """

    period: float
    linear: float
    quadratic: float
    offset: float
    trend: float
    extremes: int


def fit_extinction_curve(time: FloatArray, roll: FloatArray) -> Extinction:
    """Period and damping from successive extremes: ln(φ_n/φ_n+1) = ½ (2π/ω) b1/2 + 4/3 b2 φ_m.

    `time` (N,) [s] increasing, `roll` (N,) [rad]. The loss of a half cycle in the linear and quadratic terms
    (Froude's a φ + b φ²), with the mean φ_m of the two amplitudes. Either coefficient may come out negative.
    Raises PanelsimError for fewer than three extremes.
    """
    instants, values = _extremes(time, roll)
    # Between two extremes of one sign lies one of the other: this mean of three is free of the oscillation
    # but for the curvature of the envelope.
    centre = 0.25 * (values[:-2] + 2.0 * values[1:-1] + values[2:])
    trend, offset = (
        np.polyfit(instants[1:-1], centre, 1) if len(centre) > 2 else (0.0, float(np.mean(centre)))
    )
    amplitude = np.abs(values - offset - trend * instants)
    half_period = float((instants[-1] - instants[0]) / (len(instants) - 1))
    loss = np.log(amplitude[:-1] / amplitude[1:])
    mean = 0.5 * (amplitude[:-1] + amplitude[1:])
    # Small amplitudes are read badly: weigh each loss with its amplitude. Losses that are few, or all at one
    # amplitude, do not tell the terms apart.
    if len(loss) > _FIRST_FEW and np.ptp(mean) > _LEAST_SPREAD * np.max(mean):
        slope, start = np.polyfit(mean, loss, 1, w=mean)
    else:
        slope, start = 0.0, float(np.average(loss, weights=mean))
    ratio = float(start) / np.hypot(np.pi, float(start))
    period = 2.0 * half_period * np.sqrt(1.0 - ratio**2)
    return Extinction(
        period=float(period),
        linear=float(4.0 * np.pi * ratio / period),
        quadratic=float(0.75 * slope),
        offset=float(offset),
        trend=float(trend),
        extremes=len(values),
    )


def _extremes(time: FloatArray, roll: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Instants and values of the alternating highs and lows of a record, each from a parabola about it."""
    from scipy.signal import find_peaks, savgol_filter  # 0.3 s, which no other command should pay

    even = np.linspace(time[0], time[-1], max(len(time), 200))
    step = even[1] - even[0]
    record = np.interp(even, time, roll)
    window = max(3, round(_rough_period(even, record) / step / 8))
    smooth = savgol_filter(record, 2 * (window // 2) + 1, 2) if window > 4 else record
    prominence = _PROMINENCE * float(np.ptp(smooth))
    peaks = [find_peaks(sign * smooth, prominence=prominence)[0] for sign in (1.0, -1.0)]
    found = np.sort(np.concatenate(peaks))
    found = found[(found >= window) & (found < len(even) - window)]
    if len(found) < 3:
        raise PanelsimError(
            "The record holds too few extremes for a fit of its decay",
            got=f"{len(found)}",
            allowed="three successive extremes or more, each clear of the noise",
            remedy="give a longer record, from the release on",
        )
    points = [_vertex(even[k - window : k + window + 1], record[k - window : k + window + 1]) for k in found]
    instants, values = np.array(points).T
    return instants, values


def _rough_period(even: FloatArray, record: FloatArray) -> float:
    """The period of the greatest power in the record less its straight line [s]."""
    level = record - np.polyval(np.polyfit(even, record, 1), even)
    power = np.abs(np.fft.rfft(level, 8 * len(level)))
    # Not longer than the record, or nothing could be smoothed with it.
    strongest = max(int(np.argmax(power)), 8)
    return float(8 * len(level) * (even[1] - even[0]) / strongest)


def _vertex(time: FloatArray, roll: FloatArray) -> tuple[float, float]:
    """Instant and value of the extreme of the parabola through a few samples."""
    centre = time[len(time) // 2]
    a, b, c = np.polyfit(time - centre, roll, 2)
    shift = float(np.clip(-0.5 * b / a, time[0] - centre, time[-1] - centre))
    return centre + shift, float(c + shift * (b + shift * a))
