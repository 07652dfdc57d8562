"""RMS and mean periods of linear motions in a sea, with roll damping linearised for that sea."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.response.linear_ship import MotionsInWaves
from panelsim.response.sea_waves import SeaWaves
from panelsim.response.signals import Signals

# Metres or radians per metre of wave: what moves less does not move, and has no period.
_STILL = 1e-8
# Of the mean zero-crossing frequency: to this width a spectrum is smoothed before its peak is taken.
_SMOOTHING = 0.05
_CELLS = 5  # to that width
_HIGHEST = 8.0  # of the mean zero-crossing frequency: a peak is not sought beyond
_TOLERANCE = 1e-10  # of the equivalent damping


@dataclass(frozen=True, eq=False)
class CourseStatistics:
    """RMS (K,) and mean periods (K,) [s] of signals at one speed on one course.

    `roll_damping` [N m s] is the linear damping that stands for all of the roll damping terms there.
    """

    rms: FloatArray
    zero_crossing_period: FloatArray
    peak_period: FloatArray
    roll_damping: float


def course_statistics(
    motions: MotionsInWaves,
    speed: int,
    sea: SeaWaves,
    course: int,
    terms: RollDampingTerms,
    signals: Signals,
    held: tuple[bool, bool],
) -> CourseStatistics:
    """Statistics of the signals at one of the speeds and on one of the courses, by their indices.

    `held` says whether a stiffness holds the ship in surge and in sway. Where not, and in a spectrum with
    waves that stand still beside the ship, the variance of what drifts with her has no bound: NaN.
    """
    waves, variance = sea.courses[course]
    encounter = motions.encounter[speed, waves]
    extra = _equivalent_more(motions, speed, sea, course, terms)
    transfer = motions.more_roll_damping(speed, waves, extra)
    found = signals.of(transfer, motions.frequency[waves], motions.wave_heading[waves], encounter)
    energy = np.abs(found) ** 2 * variance[:, None]
    m0, m2 = energy.sum(axis=0), (encounter**2) @ energy
    moving = m0 > _STILL**2 * variance.sum()
    with np.errstate(divide="ignore", invalid="ignore"):
        period = 2.0 * np.pi * np.where(moving, np.sqrt(m0 / m2), np.nan)
    peak = np.full(len(m0), np.nan)
    for k in np.flatnonzero(moving & np.isfinite(period)):
        peak[k] = 2.0 * np.pi / _peak_frequency(np.abs(encounter), energy[:, k], 2.0 * np.pi / period[k])
    rms = np.sqrt(m0)
    if sea.spectral and encounter[variance > 0.0].min() <= 0.0:
        drifting = [motion is not None and not held[motion] for motion in signals.drift_with]
        for values in (rms, period, peak):
            values[drifting] = np.nan
    return CourseStatistics(rms, period, peak, terms.linear + extra)


def _equivalent_more(
    motions: MotionsInWaves, speed: int, sea: SeaWaves, course: int, terms: RollDampingTerms
) -> float:
    """What the equivalent linear damping [N m s] has above the linear term.

    The more damping, the less roll, and the less damping the other terms are worth: the two meet in one
    point, which is found between none and what the undamped roll would give. Raises PanelsimError where
    roll grows with its damping, so that they need not meet.
    """
    if terms.quadratic == 0.0 and terms.cubic == 0.0:
        return 0.0
    waves, variance = sea.courses[course]
    rate = 1j * motions.encounter[speed, waves]
    roll = rate * motions.transfer[speed, waves, Dof.ROLL]
    unit = rate * motions.per_roll_moment[speed, waves, Dof.ROLL]

    def surplus(damping: float) -> float:
        deviation = np.sqrt(np.sum(np.abs(_damped(roll, unit, damping)) ** 2 * variance))
        return float(terms.equivalent_gaussian(deviation)) - terms.linear - damping

    most = surplus(0.0)
    if most <= 0.0:
        return 0.0
    if surplus(most) > 0.0:
        raise PanelsimError(
            "The roll damping cannot be linearised for this sea: more damping gives more roll",
            got=f"quadratic {terms.quadratic:g} N m s2, cubic {terms.cubic:g} N m s3",
            remedy="check the roll stiffness of the ship and the damping terms",
        )
    return float(brentq(surplus, 0.0, most, xtol=_TOLERANCE * most))


def _damped(roll_rate: ComplexArray, per_moment: ComplexArray, damping: float) -> ComplexArray:
    """Roll rate with more damping [N m s], from the rate and the rate of a roll moment without it."""
    return roll_rate / (1.0 + damping * per_moment)


def _peak_frequency(encounter: FloatArray, energy: FloatArray, mean: float) -> float:
    """|ω_e| [rad/s] of the peak of a spectrum over it, smoothed over 5 % of its `mean` frequency.

    Energies in narrow cells, which are finite in following seas too, spread by a Gaussian; what it spreads
    below 0 comes back.
    """
    cell = _SMOOTHING / _CELLS * mean
    count = int(_HIGHEST * mean / cell)
    place = np.round(encounter / cell).astype(int)
    inside = place < count
    histogram = np.bincount(place[inside], energy[inside], minlength=count)
    offset = np.arange(-4 * _CELLS, 4 * _CELLS + 1)
    kernel = np.exp(-0.5 * (offset / _CELLS) ** 2)
    both_sides = np.concatenate([histogram[:0:-1], histogram])
    density = np.convolve(both_sides, kernel, mode="same")[count - 1 :]
    top = int(np.argmax(density))
    near = np.abs(np.minimum(place, count + offset[-1]) - top) <= _CELLS
    # The mean of what makes the peak is finer than the cells.
    return float(np.average(encounter[near], weights=energy[near])) if energy[near].any() else cell * top
