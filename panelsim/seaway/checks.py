"""What seas refuse of the numbers they are given."""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError

Number = int | float | np.integer | np.floating


def is_number(value: object) -> bool:
    """Whether the value is one number; True and False are none."""
    return isinstance(value, Number) and not isinstance(value, bool)


def require_positive(name: str, value: object, unit: str) -> float:
    """The value as a float, refused unless it is a finite number above 0."""
    if not (is_number(value) and 0 < value < np.inf):  # type: ignore[operator]
        raise PanelsimError(f"{name} is not positive", got=_shown(value), allowed=f"more than 0 {unit}")
    return float(value)  # type: ignore[arg-type]


def require_share(share: object) -> float:
    """The share as a float, refused unless it is a number from 0 to 1."""
    if not (is_number(share) and 0.0 <= share <= 1.0):  # type: ignore[operator]
        raise PanelsimError(
            "A share of the energy is no number from 0 to 1", got=repr(share)[:60], allowed="0 to 1"
        )
    return float(share)  # type: ignore[arg-type]


def require_numbers(omega: ArrayLike) -> FloatArray:
    """The frequencies as an array of floats, refused where one is no number."""
    try:
        omega = np.asarray(omega, dtype=float)
    except (TypeError, ValueError):
        raise PanelsimError("The wave frequencies are no numbers", got=repr(omega)[:60]) from None
    if np.isnan(omega).any():
        raise PanelsimError("A wave frequency is NaN", got=omega, allowed="numbers [rad/s]")
    return omega


def require_number(
    name: str,
    value: object,
    unit: str,
    *,
    low: float = -np.inf,
    high: float = np.inf,
    remedy: str | None = None,
) -> None:
    """Raise PanelsimError unless the value is one finite number from `low` to `high`."""
    number = is_number(value)
    if not (number and np.isfinite(value) and low <= value <= high):  # type: ignore[call-overload,operator]
        raise PanelsimError(
            f"The {name} is out of range" if number else f"The {name} is not a number",
            got=_shown(value),
            allowed=_range(low, high, unit),
            remedy=remedy,
        )


def real_numbers(name: str, values: ArrayLike) -> FloatArray:
    """The values, finite or not, as a new array of floats.

    Raises PanelsimError for text, None, complex numbers and rows of unequal length.
    """
    try:
        array = np.asarray(values)
    except ValueError:  # rows of unequal length
        array = np.asarray(None)
    if array.dtype.kind not in "iuf":
        raise PanelsimError(
            f"The {name} is not made of real numbers", got=repr(values)[:60], allowed="numbers"
        )
    return array.astype(np.float64)


def require_angle(name: str, angle: object) -> float:
    """One angle [rad]; raises PanelsimError as `require_angles`, and for a list."""
    if not is_number(angle):
        raise _no_angle(name, angle)
    return float(require_angles(name, angle))  # type: ignore[arg-type]


def require_angles(name: str, angles: ArrayLike) -> FloatArray:
    """Angles [rad] as an array of floats.

    Raises PanelsimError for what is no number, not finite, or beyond ±2π: degrees, most likely.
    """
    try:
        array = real_numbers(name, angles)
    except PanelsimError:
        raise _no_angle(name, angles) from None
    if not np.all(np.abs(array) <= 2 * np.pi):
        raise _no_angle(name, angles)
    return array


def _no_angle(name: str, got: object) -> PanelsimError:
    return PanelsimError(
        f"The {name} is no angle in radians",
        got=repr(got)[:60],
        allowed="-2π to 2π rad",
        remedy="turn degrees into radians, for example np.deg2rad(150)",
    )


def _range(low: float, high: float, unit: str) -> str:
    """What a finite number may be, in words."""
    if np.isfinite(low) and np.isfinite(high):
        return f"{low:g} to {high:g} {unit}"
    ends = f", {low:g} or more" if np.isfinite(low) else f", {high:g} or less" if np.isfinite(high) else ""
    return f"a finite number{ends} [{unit}]"


def _shown(value: object) -> str:
    """A value as it is typed: NumPy's scalars show their type with it."""
    return repr(value.item() if isinstance(value, np.generic) else value)[:60]
