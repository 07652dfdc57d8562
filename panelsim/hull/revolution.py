"""Spheres and upright cylinders, panelled without a pole.

A square patch of panels covers the bottom, another the top; rings of panels join them.
"""

from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.closure import PortHalf
from panelsim.hull.curve import Waterline
from panelsim.hull.panel_mesh import PanelMesh

# The corners of a patch reach out half as far beyond a circle as those of a plane square would:
# then corner panels and the ring panels beside them have corners well away from 0 and 180 degrees.
PATCH_SQUARENESS = 0.5


@dataclass(frozen=True, eq=False)
class Revolution:
    """A sphere (no `depth`) or an upright cylinder (`depth`) on the baseline [m], stretched by `stretch`.

    Its meridian runs from the lowest to the highest point of the axis with arc length as parameter.
    """

    radius: float
    depth: float | None = None
    stretch: FloatArray = field(default_factory=lambda: np.ones(3))

    def meridian(self, arc: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Radius and height [m] at arc lengths [m] along the meridian of the unstretched body."""
        if self.depth is None:
            angle = arc / self.radius
            return self.radius * np.sin(angle), self.radius * (1.0 - np.cos(angle))
        end = 2.0 * self.radius + self.depth
        return np.minimum(np.minimum(arc, self.radius), end - arc), np.clip(
            arc - self.radius, 0.0, self.depth
        )

    def scaled(self, factors: FloatArray) -> Self:
        """The body stretched by factors (3,) along x, y and z."""
        return replace(self, stretch=self.stretch * factors)

    def signature(self) -> FloatArray:
        """Every number that defines the body, in one row."""
        return np.array([self.radius, self.depth or 0.0, *self.stretch])

    def panel(self, area: float, waterline: Waterline) -> PanelMesh:
        """Closed mesh of panels of about `area` m2, with a ring of vertices on the waterline.

        Raises PanelsimError for a trimmed waterline or one that misses the body.
        """
        breaks, water_break = self._breaks(waterline)
        size = np.sqrt(area) / np.prod(self.stretch) ** (1.0 / 3.0)
        half_cells = max(1, round(0.25 * np.pi * self.radius / size))
        bottom = _patch(half_cells, 0.5 * breaks[1])
        top = _patch(half_cells, 0.5 * (breaks[-1] - breaks[-2]))
        rims = _rim(bottom[0]), breaks[-1] - _rim(top[0])
        arcs, water_row = _ring_arcs(rims, breaks[1:-1], water_break - 1, size)
        rings = self._points(arcs, _rim(bottom[1])[:, None])
        rings[:, water_row, 2] = waterline.draft
        rings[[0, -1], :, 1] = 0.0
        return _assemble(
            self._patch_points(bottom[0], bottom[1]),
            rings,
            self._patch_points(breaks[-1] - top[0], top[1]),
        )

    def _breaks(self, waterline: Waterline) -> tuple[list[float], int]:
        """Arc lengths of the ends, corners and waterline of the meridian, and which is the waterline."""
        draft = waterline.draft / self.stretch[2]
        depth = 2.0 * self.radius if self.depth is None else self.depth
        if waterline.slope != 0.0 or not 0.0 < draft < depth:
            raise PanelsimError(
                "A sphere or cylinder is panelled on an even keel with its bottom in the water only",
                got=f"draft {waterline.draft:g} m, slope of the waterline {waterline.slope:g}",
                allowed=f"draft between 0 and {depth * self.stretch[2]:g} m, no trim",
            )
        if self.depth is None:
            return [0.0, self.radius * np.arccos(1.0 - draft / self.radius), np.pi * self.radius], 1
        side = self.radius + np.array([0.0, draft, depth])
        return [0.0, *side, 2.0 * self.radius + depth], 2

    def _points(self, arc: FloatArray, angle: FloatArray) -> FloatArray:
        """Points (..., 3) at arc length [m] along the meridian and angle [rad] from the bow to port."""
        radius, height = self.meridian(arc)
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1) * self.stretch

    def _patch_points(self, arc: FloatArray, angle: FloatArray) -> FloatArray:
        points = self._points(arc, angle)
        points[:, 0, 1] = 0.0
        return points


def _assemble(bottom: FloatArray, rings: FloatArray, top: FloatArray) -> PanelMesh:
    """The body from its patches (2 n + 1, n + 1, 3) and columns (4 n + 1, R, 3) that end on their rims."""
    hull = PortHalf()
    bottom_ids, top_ids = (np.array([hull.add(row) for row in patch]) for patch in (bottom, top))
    columns = [
        [int(low), *hull.add(ring[1:-1]), int(high)]
        for low, ring, high in zip(_rim(bottom_ids), rings, _rim(top_ids), strict=True)
    ]
    for fore, aft in pairwise(columns):
        hull.strip(aft, fore)
    for aft, fore in pairwise(bottom_ids.tolist()):
        hull.strip(aft, fore)
    for aft, fore in pairwise(top_ids.tolist()):
        hull.strip(fore, aft)
    return hull.mirrored()


def _patch(half_cells: int, reach: float) -> tuple[FloatArray, FloatArray]:
    """Arc length from the pole and angle, (2 n + 1, n + 1), of a square patch: port half, aft to fore."""
    x, y = np.meshgrid(np.arange(-half_cells, half_cells + 1), np.arange(half_cells + 1), indexing="ij")
    ring = np.maximum(np.abs(x), y)
    safe = np.maximum(ring, 1)
    sector = np.where(x >= y, 0.25 * np.pi * y / safe, np.pi - 0.25 * np.pi * y / safe)
    angle = np.where(np.abs(x) < y, 0.5 * np.pi - 0.25 * np.pi * x / safe, sector)
    squareness = 1.0 / np.maximum(np.abs(np.cos(angle)), np.abs(np.sin(angle))) - 1.0
    return reach * ring / half_cells * (1.0 + PATCH_SQUARENESS * squareness), angle


def _rim(patch: NDArray[Any]) -> NDArray[Any]:
    """Outer edge of a patch from the bow over port to the stern."""
    return np.concatenate([patch[-1, :-1], patch[::-1, -1], patch[0, -2::-1]])


def _ring_arcs(
    rims: tuple[FloatArray, FloatArray], breaks: list[float], water_break: int, size: float
) -> tuple[FloatArray, int]:
    """Arc lengths (columns, rows) of the rings from rim to rim, and the row on the waterline."""
    stations = [rims[0], *(np.full_like(rims[0], b) for b in breaks), rims[1]]
    rows, water_row = [rims[0]], 0
    for number, (low, high) in enumerate(pairwise(stations)):
        count = max(1, round(float(np.mean(high - low)) / size))
        rows += [low + (high - low) * k / count for k in range(1, count + 1)]
        if number == water_break:
            water_row = len(rows) - 1
    return np.stack(rows, axis=1), water_row
