"""The side of a hull, wet or dry, as a smooth surface through its sections and its two ends.

Each section is run through by the share of its girth; points of equal share are joined along the
length by monotone cubics (PCHIP), which do not overshoot where a section changes fast. The surface
is four-sided: its ends are the stem and the stern profile or transom, so that it has no pole.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from panelsim.conventions import FloatArray
from panelsim.hull.curve import Curve

# Along the hull the lean of the stem is spread over this many times the lean itself, so that
# neighbouring columns of panels differ in width by less than half.
LEAN_SPREAD = 4.0


@dataclass(frozen=True)
class SideSurface:
    """The port side between two edges, of which one is the waterline.

    `sections` are constant in x and ordered forward, each from where its parameter begins (not at 0
    when the profile of the end rises above the lower edge there); `aft` and `fore` are the ends.
    `waterline_at` is the parameter of the waterline: 1 for the wet side, 0 for the dry.
    """

    sections: tuple[Curve, ...]
    aft: Curve
    fore: Curve
    waterline_at: float

    @classmethod
    def through(cls, sections: list[FloatArray], aft: Curve, fore: Curve, waterline_at: float) -> Self:
        """The surface through parts of sections, polylines (P, 3) that may be empty, and two ends."""
        curves = []
        for section in sections:
            if len(section) < 2:
                continue
            x = float(section[0, 0])
            start = max(aft.last_parameter_at(x, -1.0), fore.last_parameter_at(x, 1.0))
            if start < 1.0:
                curves.append(Curve.by_arc_length(section, start))
        return cls(tuple(curves), aft, fore, waterline_at)

    def stations(self, columns: int) -> FloatArray:
        """Evenly spaced x (columns + 1,) [m] along the waterline from stern to stem."""
        return np.linspace(self.aft.at(self.waterline_at)[0], self.fore.at(self.waterline_at)[0], columns + 1)

    def points(self, x_on_waterline: FloatArray, girth: FloatArray) -> FloatArray:
        """Points (C, R, 3) of columns that pass the waterline at x (C,), at girth shares (R,)."""
        nodes = np.stack([curve.at(girth) for curve in (self.aft, *self.sections, self.fore)])
        reached = self._reached(nodes, girth)
        x = self._abscissae(x_on_waterline, girth)
        points = np.empty((*x.shape, 3))
        points[..., 0] = x
        for row in range(len(girth)):
            known = nodes[reached[:, row], row]
            points[:, row, 1:] = PchipInterpolator(known[:, 0], known[:, 1:])(x[:, row])
        points[0], points[-1] = nodes[0], nodes[-1]
        return points

    def volume(self, columns: int, rows: int) -> float:
        """Volume between the surface and the centreplane [m3], from a grid of so many cells cut in triangles.

        The error falls with the square of their size.
        """
        grid = self.points(self.stations(columns), np.linspace(0.0, 1.0, rows + 1))
        corners = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]])
        x, half_breadth, z = np.moveaxis(corners, -1, 0)
        volume = 0.0
        for i, j, k in ((0, 1, 2), (0, 2, 3)):
            shadow = (x[j] - x[i]) * (z[k] - z[i]) - (x[k] - x[i]) * (z[j] - z[i])
            volume += float(np.sum(shadow * (half_breadth[i] + half_breadth[j] + half_breadth[k]))) / 6.0
        return volume

    def half_breadth(self, x: FloatArray) -> FloatArray:
        """Half-breadths (X,) of the waterline [m] at x (X,) [m] on it: cubic between `waterline_knots`."""
        ends = self.stations(1)
        columns = np.concatenate([ends[:1], x, ends[1:]])
        return self.points(columns, np.array([self.waterline_at]))[1:-1, 0, 1]

    def waterline_knots(self) -> FloatArray:
        """x [m] of the ends of the waterline and of the sections between them, in order."""
        aft, fore = self.stations(1)
        between = [x for x in (float(curve.points[0, 0]) for curve in self.sections) if aft < x < fore]
        return np.array([aft, *between, fore])

    def _reached(self, nodes: FloatArray, girth: FloatArray) -> NDArray[np.bool_]:
        """Which curves (K, R) each row meets: its ends, and the sections that it reaches between them."""
        clear = 1e-6 * (nodes[-1, :, 0] - nodes[0, :, 0])
        reached = (nodes[:, :, 0] > nodes[0, :, 0] + clear) & (nodes[:, :, 0] < nodes[-1, :, 0] - clear)
        reached[1:-1] &= np.array([section.parameter[0] for section in self.sections])[:, None] <= girth
        reached[[0, -1]] = True
        return reached

    def _abscissae(self, x_on_waterline: FloatArray, girth: FloatArray) -> FloatArray:
        """x (C, R) of the columns, which lean more and more towards the ends until they follow them."""
        x = np.repeat(x_on_waterline[:, None], len(girth), axis=1)
        for end, first in ((self.aft, 0), (self.fore, -1)):
            lean = end.at(girth)[:, 0] - end.at(self.waterline_at)[0]
            half_length = 0.5 * abs(x_on_waterline[-1] - x_on_waterline[0])
            reach = min(LEAN_SPREAD * np.max(np.abs(end.points[:, 0] - end.points[0, 0])), half_length)
            if reach > 0.0:
                inward = np.abs(x_on_waterline - x_on_waterline[first])
                x += (np.clip(1.0 - inward / reach, 0.0, 1.0) ** 2)[:, None] * lean
        return x


def keep_section_areas(points: FloatArray, exact: FloatArray) -> FloatArray:
    """Scale the half-breadths of a coarse grid so that its columns hold the areas of a fine one.

    points (C, R, 3) and exact (C, F, 3) share columns and edges. The edges and the two end columns stay.
    Without this the chords across the bilge lose more than 1 % of the volume of a coarse mesh.
    """
    kept = points.copy()
    half_breadth = points[..., 1].copy()
    edges = half_breadth.copy()
    edges[:, 1:-1] = 0.0
    of_edges = _areas(edges, points[..., 2])
    inner = _areas(half_breadth, points[..., 2]) - of_edges
    factor = np.ones_like(inner)
    np.divide(_areas(exact[..., 1], exact[..., 2]) - of_edges, inner, out=factor, where=inner > 0.0)
    kept[1:-1, 1:-1, 1] *= factor[1:-1, None]
    return kept


def _areas(half_breadth: FloatArray, height: FloatArray) -> FloatArray:
    """Area of each column (C,) [m2] under a polyline of half-breadths (C, R) over heights (C, R)."""
    return np.asarray(np.trapezoid(half_breadth, height, axis=1))
