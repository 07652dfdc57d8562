"""The curve of righting arms (GZ) of a ship, and what is read off it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq, minimize_scalar

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError, require_kind
from panelsim.seaway.checks import is_number, real_numbers

SMALL_HEEL = 1e-3  # rad
ROUNDING = 1e-9  # of the largest arm: an arm below this is none
HEEL_ACCURACY = 1e-9  # rad
ON_HALF_A_TURN = 1e-9  # rad: degrees turned into radians may pass π by rounding


class Attitude(NamedTuple):
    """How a ship floats at a heel: righting arm [m], rise of the CG [m] and trim [rad], both from rest."""

    arm: float
    heave: float
    trim: float


Afloat = Callable[[float], Attitude]


@dataclass(frozen=True, eq=False)
class RightingArms:
    """Righting arms (H,) of a ship held at heel angles (H,), free to sink and, unless held, to trim.

    `heel` [rad], starboard down positive, rising. `arm` GZ [m]: weight times arm is the moment that turns the
    ship upright, if positive at a positive heel. `heave` [m] of the CG and `trim` [rad, bow down positive]
    from where the ship rests in calm water. `water` says in which: "calm water", "crest amidships", ….
    `gm`: slope of the arm at zero heel [m]. `greatest_arm` [m] and `greatest_arm_heel` [rad]: the largest
    among the heels to starboard. `vanishing_heel` [rad]: where the arm first falls through zero, to
    starboard; None where it does not within the heels.
    """

    water: str
    heel: FloatArray
    arm: FloatArray
    heave: FloatArray
    trim: FloatArray
    gm: float
    greatest_arm: float
    greatest_arm_heel: float
    vanishing_heel: float | None

    def area(self, lower: float, upper: float) -> float:
        """Area under the curve [m rad] between two heels [rad], of a monotone cubic through its points.

        Raises PanelsimError for heels that the curve does not reach, or that are not in order.
        """
        low, high = float(self.heel[0]), float(self.heel[-1])
        in_order = is_number(lower) and is_number(upper) and low <= lower <= upper <= high
        if not in_order:
            raise PanelsimError(
                "The righting arms do not reach over the area asked for",
                got=f"from {lower} to {upper} rad",
                allowed=f"two heels in order, {low:g} to {high:g} rad",
            )
        return float(PchipInterpolator(self.heel, self.arm).integrate(lower, upper))


def curve_of(afloat: Afloat, heel: ArrayLike, water: str) -> RightingArms:
    """The curve of a ship that floats as `afloat` says at each of the heels (H,) [rad].

    Raises PanelsimError for heels that are not two or more rising angles within half a turn.
    """
    angles = _checked_heels(heel)
    arm, heave, trim = np.array([afloat(float(angle)) for angle in angles]).T
    greatest_heel, greatest = _greatest(afloat, angles, arm)
    for column in (angles, arm, heave, trim):
        column.setflags(write=False)
    return RightingArms(
        water=water,
        heel=angles,
        arm=arm,
        heave=heave,
        trim=trim,
        gm=_slope_at_zero(afloat),
        greatest_arm=greatest,
        greatest_arm_heel=greatest_heel,
        vanishing_heel=_vanishing(afloat, angles, arm),
    )


def require_choice_of_trim(free_trim: object) -> None:
    """Raise PanelsimError unless it is True or False: a word, such as "no", would count as True."""
    require_kind("choice of free_trim", free_trim, bool | np.bool_, "True or False")


def _checked_heels(heel: ArrayLike) -> FloatArray:
    angles = real_numbers("row of heel angles", heel)
    listed = angles.ndim == 1 and len(angles) >= 2 and bool(np.isfinite(angles).all())
    if not listed or (np.diff(angles) <= 0.0).any() or np.abs(angles).max() > np.pi + ON_HALF_A_TURN:
        raise PanelsimError(
            "The heel angles do not make a curve",
            got=repr(angles.tolist())[:60],
            allowed="two or more, rising, from -π to π rad",
            remedy="turn degrees into radians, for example np.deg2rad(np.arange(0, 181, 5))",
        )
    return angles


def _slope_at_zero(afloat: Afloat) -> float:
    """Slope of the arm at zero heel [m].

    Where panels end at the water the flare differs from one side to the other, and a plain difference over h
    is off by a part of h: so 2 D(h/2) - D(h).
    """
    wide, narrow = ((afloat(h).arm - afloat(-h).arm) / (2.0 * h) for h in (SMALL_HEEL, 0.5 * SMALL_HEEL))
    return 2.0 * narrow - wide


def _greatest(afloat: Afloat, heel: FloatArray, arm: FloatArray) -> tuple[float, float]:
    """Heel [rad] of the largest arm to starboard, and that arm [m], refined between the heels."""
    starboard = heel >= 0.0
    if not starboard.any():
        starboard = np.ones_like(starboard)
    top = int(np.flatnonzero(starboard)[arm[starboard].argmax()])
    best = float(heel[top]), float(arm[top])
    if 0 < top < len(heel) - 1:
        found = minimize_scalar(
            lambda angle: -afloat(float(angle)).arm,
            bounds=(heel[top - 1], heel[top + 1]),
            method="bounded",
            options={"xatol": 1e-4},
        )
        best = max(best, (float(found.x), float(-found.fun)), key=lambda pair: pair[1])
    return best


def _vanishing(afloat: Afloat, heel: FloatArray, arm: FloatArray) -> float | None:
    """The first heel to starboard [rad] at which a positive arm falls through zero."""
    least = ROUNDING * float(np.abs(arm).max())
    falls = (arm[:-1] > least) & (arm[1:] <= least) & (heel[:-1] >= 0.0)
    if not falls.any():
        return None
    before = int(np.flatnonzero(falls)[0])
    low, high = float(heel[before]), float(heel[before + 1])
    if arm[before + 1] >= -least:
        return high
    return float(brentq(lambda angle: afloat(angle).arm, low, high, xtol=HEEL_ACCURACY))
