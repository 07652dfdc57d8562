"""Polylines with a parameter along them, and the plane of the water at rest that cuts them."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from panelsim.conventions import FloatArray


@dataclass(frozen=True)
class Waterline:
    """The water plane at rest in hull axes, z = draft - slope x.

    `draft` at midships [m]; `slope` is the trim by the stern over the length between perpendiculars.
    """

    draft: float
    slope: float = 0.0

    def height(self, x: FloatArray) -> FloatArray:
        """Height of the water plane above the baseline [m] at x [m] from midships."""
        return self.draft - self.slope * np.asarray(x, dtype=np.float64)


@dataclass(frozen=True)
class Curve:
    """A polyline `points` (P, 3) [m] with an increasing `parameter` (P,) that ends at 1."""

    points: FloatArray
    parameter: FloatArray

    @classmethod
    def by_arc_length(cls, points: FloatArray, start: float = 0.0) -> Self:
        """The polyline (P, 3) with arc length as the parameter, which runs from `start` to 1."""
        return cls(points, start + (1.0 - start) * arc_fraction(points))

    def at(self, parameter: FloatArray | float) -> FloatArray:
        """Points (..., 3) at the given parameters (...)."""
        return np.stack([np.interp(parameter, self.parameter, c) for c in self.points.T], axis=-1)

    def with_corner(self, corner: FloatArray, rows: int) -> Self:
        """The same polyline with one of its vertices, `corner` (3,), on one of `rows` equal rows."""
        (index,) = np.flatnonzero(np.all(self.points == corner, axis=1))
        row = min(max(round(rows * self.parameter[index]), 1), rows - 1)
        below = row / rows * arc_fraction(self.points[: index + 1])
        above = row / rows + (1 - row / rows) * arc_fraction(self.points[index:])
        return type(self)(self.points, np.concatenate([below, above[1:]]))

    def last_parameter_at(self, x: float, sign: float) -> float:
        """Parameter above which the whole curve lies beyond x, sign +1 ahead of it or -1 aft of it.

        0 when all of the curve does, 1 when its end does not.
        """
        beyond = sign * (self.points[:, 0] - x)
        short = np.flatnonzero(beyond < 0.0)
        if len(short) == 0:
            return 0.0
        k = int(short[-1])
        if k + 1 == len(beyond):
            return 1.0
        share = beyond[k] / (beyond[k] - beyond[k + 1])
        return float(self.parameter[k] + share * (self.parameter[k + 1] - self.parameter[k]))


def arc_fraction(points: FloatArray) -> FloatArray:
    """Arc length along a polyline (P, ...) over its whole length, from 0 to 1."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return length / length[-1]


def without_repeats(points: FloatArray) -> FloatArray:
    """The polyline (P, 3) without segments of no length."""
    moves = np.any(np.diff(points, axis=0) != 0.0, axis=1)
    return points[np.concatenate([[True], moves])]


def split_at_waterline(points: FloatArray, waterline: Waterline) -> tuple[FloatArray, FloatArray]:
    """Cut a polyline (P, 3) that runs upwards into its wet part and its dry part.

    Both hold the point where it pierces the water. One of them is empty (0, 3) when it does not.
    """
    above = points[:, 2] - waterline.height(points[:, 0])
    if above[-1] <= 0.0:
        return points, points[:0]
    if above[0] >= 0.0:
        return points[:0], points
    k = int(np.argmax(above > 0.0))
    share = above[k - 1] / (above[k - 1] - above[k])
    cut = points[k - 1] + share * (points[k] - points[k - 1])
    cut[2] = waterline.height(cut[0])
    return without_repeats(np.vstack([points[:k], cut])), without_repeats(np.vstack([cut, points[k:]]))
