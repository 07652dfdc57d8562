"""Forms given by a formula: Wigley hulls and a box; bodies of revolution have their own file."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Self

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.closure import PortHalf
from panelsim.hull.curve import Waterline
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.sections import HullLines

# So dense that what the tables miss of the formula is far below what the panels miss.
WIGLEY_SECTIONS, WIGLEY_HEIGHTS = 101, 161


def wigley_lines(
    length: float, beam: float, draft: float, depth: float, fourth_power_term: float
) -> HullLines:
    """Wigley hull of Journée (1992), wall-sided from the draft up to the depth [m].

    y = B/2 [(1 - Z²)(1 - X²)(1 + 0.2 X²) + a Z² (1 - Z⁸)(1 - X²)⁴], X = 2x/L, Z from 0 at the water to
    1 at the keel; `fourth_power_term` a is 1 for hulls I and II, 0 for III and IV.
    """
    depth_share = np.linspace(1.0, 0.0, WIGLEY_HEIGHTS)
    height = np.append(draft * (1.0 - depth_share), depth)
    sections = []
    for x_share in np.linspace(-1.0, 1.0, WIGLEY_SECTIONS)[1:-1]:
        bow = 1.0 - x_share**2
        keel = 1.0 - depth_share**2
        bilge = depth_share**2 * (1.0 - depth_share**8)
        share = keel * bow * (1.0 + 0.2 * x_share**2) + fourth_power_term * bilge * bow**4
        half_breadth = 0.5 * beam * np.append(share, share[-1])
        x = np.full_like(height, 0.5 * length * x_share)
        sections.append(np.column_stack([x, half_breadth, height]))
    post = np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 1.0]])
    stem, stern = post * [0.5 * length, 0.0, depth], post * [-0.5 * length, 0.0, depth]
    return HullLines(tuple(sections), stem, stern, transom=False)


@dataclass(frozen=True)
class Box:
    """A rectangular box on the baseline; length, beam and depth in m."""

    length: float
    beam: float
    depth: float

    def scaled(self, factors: FloatArray) -> Self:
        """The box stretched by factors (3,) along x, y and z."""
        return type(self)(self.length * factors[0], self.beam * factors[1], self.depth * factors[2])

    def panel(self, area: float, waterline: Waterline) -> PanelMesh:
        """Closed mesh of rectangles of about `area` m2, with a row of vertices on the waterline."""
        size = np.sqrt(area)
        x = np.linspace(-0.5, 0.5, _cells(self.length, size) + 1) * self.length
        y = np.linspace(0.0, 0.5, _cells(0.5 * self.beam, size) + 1) * self.beam
        water = waterline.height(x)[:, None]
        if not 0.0 < water.min() <= water.max() < self.depth:
            raise PanelsimError(
                "The waterline at rest does not cut all four sides of the box",
                got=f"from {water.min():g} to {water.max():g} m above the bottom",
                allowed=f"between 0 and {self.depth:g} m",
            )
        wet = np.linspace(0.0, 1.0, _cells(waterline.draft, size) + 1)
        dry = np.linspace(0.0, 1.0, _cells(self.depth - waterline.draft, size) + 1)[1:]
        z = np.hstack([water * wet, water + (self.depth - water) * dry])
        return _box_mesh(x, y, z)

    def signature(self) -> FloatArray:
        """Every number that defines the box, in one row."""
        return np.array([self.length, self.beam, self.depth])


def _cells(length: float, size: float) -> int:
    return max(1, round(length / size))


def _box_mesh(x: FloatArray, y: FloatArray, z: FloatArray) -> PanelMesh:
    """Box with columns at x (C,), breadths y (B,) from 0 outwards and heights z (C, R) along the side."""
    hull = PortHalf()
    rings = [_add_ring(hull, x_column, y, heights) for x_column, heights in zip(x, z, strict=True)]
    for aft, fore in pairwise(rings):
        hull.strip(aft, fore)
    for ring, faces_aft in ((rings[0], True), (rings[-1], False)):
        side = ring[len(y) : -len(y)]
        levels = [ring[: len(y)], *(_add_level(hull, edge, y) for edge in side), ring[: -len(y) - 1 : -1]]
        for lower, upper in pairwise(levels):
            hull.strip(*((upper, lower) if faces_aft else (lower, upper)))
    return hull.mirrored()


def _add_ring(hull: PortHalf, x: float, y: FloatArray, z: FloatArray) -> list[int]:
    """Vertices of a section: from the keel out along the bottom, up the side, in along the deck."""
    bottom = np.column_stack([y, np.full_like(y, z[0])])
    side = np.column_stack([np.full(len(z) - 2, y[-1]), z[1:-1]])
    deck = np.column_stack([y[::-1], np.full_like(y, z[-1])])
    ring = np.vstack([bottom, side, deck])
    return hull.add(np.column_stack([np.full(len(ring), x), ring]))


def _add_level(hull: PortHalf, edge: int, y: FloatArray) -> list[int]:
    """A row of vertices across an end, from the centreline to the vertex `edge` on the side."""
    level = np.repeat(hull.vertices[edge][None], len(y) - 1, axis=0)
    level[:, 1] = y[:-1]
    return [*hull.add(level), edge]
