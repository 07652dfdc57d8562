"""Wave components that give a record of elevation back.

A sum of Fourier components with their phases keeps the wave groups of the record, J. A. Richer, The
effects of wave groups on the nonlinear simulation of ship motion in random seas (Texas A&M 2005), (2)-(4);
a spectrum of it would not.
"""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import is_number, require_angle
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.exchange.elevation_record import ElevationRecord


def record_components(
    record: ElevationRecord,
    *,
    wave_heading: float,
    low_frequency: float,
    high_frequency: float,
    taper: float = 0.0,
) -> WaveComponents:
    """Waves ω_n = 2πn/T of a record within a band [rad/s], both ends included, Richer (3), (4).

    `high_frequency` may be infinite: all that the record shows. The mean is taken off. The waves, all of
    `wave_heading` β [rad], give the band of the record back at the origin, at the record's own times
    counted from its first sample: a exp(iε) = (2/N) Σ ζ_j exp(−iω t_j), and half of that at the Nyquist
    frequency, of which samples show only a cos ε. They repeat after the record's length T. Away from
    the origin each wave travels with its own wavenumber in the direction β, cos(kx cos β − ωt − ε); Richer's
    (19) with + ωt would run the other way.

    `taper` is the share of the record that a cosine (Tukey) window fades, half at each end, so that a
    record that does not end as it began repeats without a jump; all amplitudes are then raised alike so
    that the variance of the whole record stays as it was.

    Raises PanelsimError for a band that is none, passes the Nyquist frequency or holds no ω_n, a taper
    that is no share, and a record without waves.
    """
    require_angle("wave heading", wave_heading)
    _require_band(record, low_frequency, high_frequency)
    frequency, amplitude = _fourier_amplitudes(record, taper)
    # The ω_n at an end of the band belongs to it whatever way the last digit rounds.
    slack = 1e-9 * frequency[1]
    inside = (frequency >= low_frequency - slack) & (frequency <= high_frequency + slack)
    inside[0] = False
    if not inside.any():
        raise PanelsimError(
            "The band holds no frequency of the record",
            got=f"{low_frequency:g} to {high_frequency:g} rad/s",
            allowed=f"multiples of {frequency[1]:.4g} rad/s (2π over the record's length)",
            remedy="widen the band, or take a longer record",
        )
    chosen = amplitude[inside]
    heading = np.full(len(chosen), float(wave_heading))
    return WaveComponents(np.abs(chosen), frequency[inside], heading, np.angle(chosen))


def _require_band(record: ElevationRecord, low: float, high: float) -> None:
    """Refuse a band that is no interval of frequencies below the Nyquist frequency."""
    nyquist = record.nyquist_frequency
    if (
        not (is_number(low) and is_number(high))
        or not 0.0 <= low < high
        or nyquist * (1 + 1e-9) < high < np.inf
    ):
        raise PanelsimError(
            "The band is not within the frequencies that the record shows",
            got=f"{low!r} to {high!r} rad/s",
            allowed=f"0 or more to {nyquist:.6g} rad/s (Nyquist, step {record.step:g} s), or to infinity",
            remedy="lower high_frequency; frequencies are in rad/s, 2π times Hz",
        )


def _fourier_amplitudes(record: ElevationRecord, taper: float) -> tuple[FloatArray, ComplexArray]:
    """Frequencies (N//2 + 1,) [rad/s] and complex amplitudes a exp(iε) [m] of the tapered record."""
    from scipy.signal.windows import tukey

    if not is_number(taper) or not 0.0 <= taper <= 1.0:
        raise PanelsimError("The taper is not a share of the record", got=repr(taper), allowed="0 to 1")
    if np.ptp(record.elevation) == 0:
        raise PanelsimError("The record has no waves", got=f"{record.elevation[0]:g} m throughout")
    tapered = tukey(record.count, taper) * (record.elevation - record.elevation.mean())
    tapered *= np.sqrt(record.variance / np.var(tapered))
    amplitude = 2.0 / record.count * np.fft.rfft(tapered)
    if record.count % 2 == 0:
        amplitude[-1] *= 0.5
    frequency: FloatArray = 2 * np.pi / record.length * np.arange(len(amplitude), dtype=float)
    return frequency, amplitude
