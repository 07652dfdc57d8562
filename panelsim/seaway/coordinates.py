"""Where and when a seaway is asked for: coordinates and speeds, checked."""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_number

FARTHEST = 1e9  # m and s: beyond it a phase has no digits left
HIGHEST_SPEED = 50.0  # m/s


def points(
    x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike
) -> tuple[tuple[int, ...], FloatArray]:
    """The shape that the coordinates [m, m, m, s] broadcast to, and the points as rows (P, 4).

    Raises PanelsimError for coordinates that are no finite numbers or do not broadcast.
    """
    names = ("x", "y", "z_wl", "time")
    given = [numbers(name, value) for name, value in zip(names, (x, y, z_wl, time), strict=True)]
    try:
        columns = np.broadcast_arrays(*given)
    except ValueError:
        raise PanelsimError(
            "The coordinates do not fit together",
            got=", ".join(f"{name} {column.shape}" for name, column in zip(names, given, strict=True)),
            allowed="scalars and arrays that broadcast",
            remedy="for all of x at all of t, give x[:, None] and t",
        ) from None
    return columns[0].shape, np.stack(columns, axis=-1).reshape(-1, 4)


def require_speed(speed: float) -> None:
    """Refuse a ship speed that is no finite number or faster than ships are, astern or ahead."""
    require_number(
        "speed", speed, "m/s", low=-HIGHEST_SPEED, high=HIGHEST_SPEED, remedy="turn knots into m/s: 20 * KNOT"
    )


def numbers(name: str, value: ArrayLike) -> FloatArray:
    """The value as an array of numbers; PanelsimError where one is not finite or beyond `FARTHEST`."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows of unequal length
        array = np.asarray(None)
    if array.dtype.kind not in "iuf":
        raise PanelsimError(
            f"{name} is not a number or an array of numbers", got=repr(value)[:60], allowed="finite numbers"
        )
    beyond = ~(np.abs(array) <= FARTHEST)
    if beyond.any():
        raise PanelsimError(
            f"{name} is out of range",
            got=f"{array[beyond].flat[0]} at {beyond.sum()} of {array.size} points",
            allowed=f"-{FARTHEST:g} to {FARTHEST:g}",
        )
    return array.astype(np.float64)
