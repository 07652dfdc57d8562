"""Diffraction from tables of zero-speed loads, as other programs give them, and at speed by scaling them.

A table F(ω, β) holds the momentum of the scattered wave, P_d = iF/ω, for a wave of frequency ω met at that
same frequency. A ship that moves meets it at ω_e, and tables cannot tell P_d at the wavenumber of ω and the
frequency of ω_e. They can tell which steady-state velocity v = -Z(ω)⁻¹ P_d of the hull, Z = A + B/(iω), sets
the same momentum going; at speed the hull is given P_d = -Z(ω_e) v. This is exact at rest and in beam seas,
where ω_e = ω, and in waves long beside the ship; it is the relative-motion hypothesis in between. Against
loads formed from potentials, for a frigate at 20 knots and wave frequencies of 0.3 to 1.2 rad/s, it misses on
average by 5 % of the peak of each mode in following and quartering seas, 8 % at 120°, 21 % (heave) in head
seas. The zero-speed load taken as it is, which also breaks the limit of long waves, misses by 15 % to 240 %.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.conditioning import pair_scale
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.interpolation import complex_inertia
from panelsim.seaway.dispersion import wavenumber

# The widest steps of a table that a cubic follows: the phase of a wave at bow and stern may turn by so much
# from one stored value to the next. Measured on a frigate, loads between are then within 3 % of their peak;
# at 2.7 rad they are 13 % off.
_LARGEST_TURN = 2.0  # rad
# In long waves the load itself bends: steps of frequency for a ship of 120 m [rad/s], others go as 1/√L.
_REFERENCE_LENGTH, _REFERENCE_STEP = 120.0, 0.15
_LARGEST_HEADING_STEP = np.radians(30.0)
SPEED_NOTE = (
    "The diffraction tables hold zero speed: at speed they are scaled by the added mass and damping of the"
    " frequency of encounter, an approximation that is exact at rest and in beam seas."
)
_ROUNDING = 1e-6  # rad/s and rad: a wave this near a stored one is that one
# Motions that move less water than this share of the others have no momentum to be scaled.
_NO_INERTIA = 1e-4


def tabulated_momentum(
    database: HydroDatabase, frequency: FloatArray, wave_heading: FloatArray, encounter: FloatArray
) -> ComplexArray:
    """Momentum P_d (M, 6) [kg m/s, kg m2/s] per unit wave amplitude from the tables of a database.

    `frequency` ω (M,) [rad/s], `wave_heading` β (M,) [rad], `encounter` ω_e (M,) [rad/s] with its sign.
    Raises PanelsimError for waves that `require_covered` refuses.
    """
    require_covered(database, frequency, wave_heading)
    still = 1j * _interpolated(database, frequency, wave_heading) / frequency[:, None]
    scale = np.sqrt(np.diag(pair_scale(database.added_mass, database.half_breadth)))
    pairs = np.outer(scale, scale)
    at_rest = complex_inertia(database, frequency)
    velocity = np.linalg.pinv(at_rest / pairs, rcond=_NO_INERTIA) @ (still / scale)[..., None]
    change = (complex_inertia(database, encounter) - at_rest) / pairs
    return still + scale * (change @ velocity)[..., 0]


def largest_frequency_step(database: HydroDatabase, frequency: FloatArray) -> FloatArray:
    """Widest step (M,) [rad/s] of the tables to interpolate across at frequencies (M,) [rad/s]."""
    length = database.length
    turning = _LARGEST_TURN * database.gravity / (frequency * length)
    return np.minimum(turning, _REFERENCE_STEP * np.sqrt(_REFERENCE_LENGTH / length))


def largest_heading_step(database: HydroDatabase, frequency: FloatArray) -> FloatArray:
    """Widest step (M,) [rad] of the tables to interpolate across at frequencies (M,) [rad/s]."""
    k = wavenumber(frequency, database.gravity)
    return np.minimum(2.0 * _LARGEST_TURN / (k * database.length), _LARGEST_HEADING_STEP)


def highest_covered(database: HydroDatabase, wave_heading: FloatArray | None) -> float:
    """Frequency [rad/s] up to which the tables are fine enough to interpolate at headings (H,) [rad].

    None stands for all headings. Steps of heading that are too wide for any frequency do not count: they are
    for `require_covered` to refuse.
    """
    stored, headings = database.wave_frequencies, database.wave_headings
    too_wide = np.diff(stored) > largest_frequency_step(database, stored[1:]) + _ROUNDING
    last = float(stored[int(np.argmax(too_wide))] if too_wide.any() else stored[-1])
    ring = np.append(headings, headings[0] + 2 * np.pi)
    gaps = np.diff(ring)
    if wave_heading is not None:
        turned = headings[0] + np.mod(wave_heading - headings[0] + _ROUNDING, 2 * np.pi) - _ROUNDING
        between = np.abs(turned[:, None] - ring).min(axis=1) > _ROUNDING
        gaps = gaps[np.searchsorted(ring, turned[between], side="right") - 1]
    gaps = gaps[gaps <= _LARGEST_HEADING_STEP + _ROUNDING]
    if not gaps.size:
        return last
    return min(last, float(np.sqrt(2.0 * _LARGEST_TURN * database.gravity / (gaps.max() * database.length))))


def require_covered(database: HydroDatabase, frequency: FloatArray, wave_heading: FloatArray) -> None:
    """Refuse waves that the diffraction tables do not hold, naming the first and what is held.

    `frequency` (M,) [rad/s], `wave_heading` (M,) [rad]. A wave is held at a stored frequency, or between two
    that are near enough to interpolate, and likewise in heading. Raises PanelsimError for any other.
    """
    stored, headings = database.wave_frequencies, database.wave_headings
    steps = largest_frequency_step(database, frequency)
    missing = ~_within(frequency, stored, steps)
    if missing.any():
        raise PanelsimError(
            f"The diffraction tables do not hold the frequency of {missing.sum()} of {len(missing)} waves",
            got=f"{frequency[missing][0]:.4g} rad/s",
            allowed=f"{stored[0]:.4g} to {stored[-1]:.4g} rad/s, there between steps of"
            f" {steps[missing][0]:.3g} rad/s or less",
            remedy="choose other wave frequencies, or compute the database at more",
        )
    around = np.concatenate([headings - 2 * np.pi, headings, headings + 2 * np.pi])
    steps = largest_heading_step(database, frequency)
    missing = ~_within(_wrapped(wave_heading), around, steps)
    if missing.any():
        held = ", ".join(f"{angle:.4g}" for angle in np.degrees(headings))
        raise PanelsimError(
            f"The diffraction tables do not hold the heading of {missing.sum()} of {len(missing)} waves",
            got=f"{np.degrees(wave_heading[missing][0]):.4g}° at {frequency[missing][0]:.4g} rad/s",
            allowed=f"{held}°, and at that frequency between steps of"
            f" {np.degrees(steps[missing][0]):.3g}° or less",
            remedy="choose stored wave headings, or compute the database at more",
        )


def _interpolated(database: HydroDatabase, frequency: FloatArray, wave_heading: FloatArray) -> ComplexArray:
    """F (M, 6) at the waves, cubic in frequency and heading."""
    stored = database.wave_frequencies
    table = database.diffraction_table
    at_frequency = CubicSpline(stored, table)(frequency) if len(stored) > 1 else table[[0] * len(frequency)]
    return np.einsum("mh,mhd->md", _heading_weights(database.wave_headings, wave_heading), at_frequency)


def _heading_weights(stored: FloatArray, wave_heading: FloatArray) -> FloatArray:
    """Weights (M, H) of the stored headings, cubic around the circle or along the arc that they cover."""
    count = len(stored)
    if count == 1:
        return np.ones((len(wave_heading), 1))
    gaps = np.diff(np.append(stored, stored[0] + 2 * np.pi))
    first = (int(gaps.argmax()) + 1) % count
    order = (first + np.arange(count)) % count
    arc = stored[first] + np.mod(stored[order] - stored[first], 2 * np.pi)
    unit = np.eye(count)[order]
    wanted = arc[0] + np.mod(wave_heading - arc[0] + _ROUNDING, 2 * np.pi) - _ROUNDING
    if gaps.max() <= _LARGEST_HEADING_STEP + _ROUNDING:
        ring, values = np.append(arc, arc[0] + 2 * np.pi), np.vstack([unit, unit[:1]])
        return CubicSpline(ring, values, bc_type="periodic")(wanted)
    return CubicSpline(arc, unit)(wanted)


def _within(wanted: FloatArray, stored: FloatArray, largest_step: FloatArray) -> NDArray[np.bool_]:
    """True (M,) for values that are stored (ascending), or lie between two no further apart than (M,)."""
    after = np.minimum(np.searchsorted(stored, wanted), len(stored) - 1)
    before = np.maximum(after - 1, 0)
    inside = (wanted >= stored[before] - _ROUNDING) & (wanted <= stored[after] + _ROUNDING)
    near = np.abs(wanted[:, None] - stored).min(axis=1) <= _ROUNDING
    return near | (inside & (stored[after] - stored[before] <= largest_step + _ROUNDING))


def _wrapped(angle: FloatArray) -> FloatArray:
    return np.pi - np.mod(np.pi - angle, 2 * np.pi)
