"""Named points of a ship, such as the bridge: where they may lie, and what is told of each."""

import re
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError

AXES = ("x", "y", "z")
# What is told of a point, in a history as in a response, with its unit.
POINT_UNITS = (
    {f"displacement_{axis}": "m" for axis in AXES}
    | {f"velocity_{axis}": "m/s" for axis in AXES}
    | {f"acceleration_{axis}": "m/s2" for axis in AXES}
    | {"relative_motion": "m"}
)

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]{0,39}")
_FARTHEST = 2.0  # diagonals of the hull from the centre of gravity: room for a mast, not for millimetres


def point_of_ship(
    point: ArrayLike, center_of_gravity: FloatArray, vertices: FloatArray, name: str = ""
) -> FloatArray:
    """A point (3,) [m] in hull axes: midships, centreline, baseline.

    `center_of_gravity` (3,) [m] of the ship in hull axes, `vertices` (V, 3) [m] of her mesh. Raises
    PanelsimError for what is no three finite numbers, and for a point far from the ship.
    """
    what = f"The point {name}".strip()
    try:
        place = np.array(point, dtype=float)
    except (TypeError, ValueError):
        place = np.empty(0)
    if place.shape != (3,) or not np.isfinite(place).all():
        raise PanelsimError(
            f"{what} is not three finite numbers",
            got=repr(point)[:60],
            allowed="x forward of midships, y to port, z above the baseline, in m",
        )
    distance = float(np.linalg.norm(place - center_of_gravity))
    most = _FARTHEST * float(np.linalg.norm(np.ptp(vertices, axis=0)))
    if distance > most:
        raise PanelsimError(
            f"{what} lies far off the ship",
            got=f"{distance:.4g} m from the centre of gravity",
            allowed=f"up to {most:.4g} m, two diagonals of the hull",
            remedy="give metres in hull axes: forward of midships, to port, above the baseline",
        )
    return place


def points_of_ship(
    points: object, center_of_gravity: FloatArray, vertices: FloatArray
) -> dict[str, FloatArray]:
    """Points (3,) [m] in hull axes by name, checked; None is none. Other arguments as of `point_of_ship`.

    Raises PanelsimError for a name that cannot head a column or a group of a file, and as `point_of_ship`.
    """
    if points is None:
        return {}
    if not isinstance(points, Mapping):
        raise PanelsimError(
            "The points of the ship are no mapping",
            got=repr(points)[:60],
            allowed='points by name, {"bridge": (20.0, 0.0, 15.0)}',
        )
    for name in points:
        require_point_name(name)
    return {name: point_of_ship(place, center_of_gravity, vertices, name) for name, place in points.items()}


def require_point_name(name: object) -> None:
    """Raise PanelsimError for a name that cannot head a column or a group of a file."""
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise PanelsimError(
            "A point cannot have this name",
            got=repr(name)[:60],
            allowed="a letter, then letters, digits, _ and -, 40 in all",
        )
