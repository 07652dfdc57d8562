"""The wet part of a hull surface, in triangles, with the pressure that the rules put on it.

The one place, in NumPy, where panels are cut at the water: the oracle sums what is made here, and the
pressures, waterlines and section forces that are asked for besides a load come from it too.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import FloatArray, IntArray, corner_shares
from panelsim.kernels.tables import PanelTables, bend_shares, require_rule, require_stretching

SPLITS = np.array([[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]])  # of a quadrilateral, both ways


@dataclass(frozen=True, eq=False)
class WetPart:
    """The wet part of a surface in W triangles, in ship axes; made by `wet_part`.

    `corners` (W, 3, 3) [m], counter-clockwise seen from the water; `pressure` (W, 3) [Pa] at them, linear
    between; `weight` (W,): how much of itself a triangle counts for, ½ where a wet quadrilateral is the mean
    of both its splits; `panel` (W,): the panel of the mesh that it belongs to. `bend` (W,) [Pa] is the mean
    pressure that the bend of the pressure over the panel adds, a force that acts at the centre of the
    panel, `centre` (W, 3) [m].
    """

    corners: FloatArray
    pressure: FloatArray
    weight: FloatArray
    panel: IntArray
    bend: FloatArray
    centre: FloatArray

    def __post_init__(self) -> None:
        for own in fields(self):
            getattr(self, own.name).setflags(write=False)

    @cached_property
    def area(self) -> FloatArray:
        """What each triangle (W,) counts for of the wet area [m2]."""
        return self.weight * np.linalg.norm(area_vectors(self.corners), axis=1)

    @cached_property
    def loads(self) -> FloatArray:
        """Force and moment (W, 6) of each triangle, moments about the origin [N, N m]."""
        bent = self.bend[:, None] * uniform_loads(area_vectors(self.corners), self.centre)
        return self.weight[:, None] * (linear_loads(self.corners, self.pressure) + bent)


def wet_part(
    panels: PanelTables,
    at_points: Sequence[FloatArray],
    *,
    rule: str,
    stretching: str,
    weight_density: float,
) -> WetPart:
    """Cut the panels at the water, each as four triangles about its centre, and say the pressure there.

    `at_points`: three arrays (P,) in the order of `panels.points`: the depth below the surface [m],
    negative above it, the pressure [Pa], and the pressure [Pa] to interpolate along an edge to where
    the surface cuts it. Of dry points only those count whose panel has a wet one; the rule "vertex" reads
    no centres. `weight_density` ρ g [N/m3]. Depth 0 is dry. Raises PanelsimError for an unknown rule or
    stretching.
    """
    require_rule(rule)
    require_stretching(stretching)
    if rule == "panel":
        return _whole_panels(panels, at_points)
    values, bend = _by_rule(panels, at_points, rule, stretching, weight_density)
    fan = fan_points(panels).reshape(-1, 3)
    corners, pressure, weight, origin = wet_triangles(panels.points[fan], *(own[fan] for own in values))
    panel = origin // 4
    return WetPart(
        corners=corners,
        pressure=pressure,
        weight=weight,
        panel=panels.panel_order[panel],
        bend=bend[panel],
        centre=panels.points[panels.first_centre + panel],
    )


def fan_points(panels: PanelTables) -> IntArray:
    """Points (N, 4, 3) of the triangles of each panel: centre, vertex, next vertex."""
    centre = panels.first_centre + np.arange(len(panels.panels))
    corners = panels.panels.astype(np.int64)
    centres = np.broadcast_to(centre[:, None], corners.shape)
    return np.stack([centres, corners, np.roll(corners, -1, axis=1)], axis=-1)


def with_mean_centres(panels: PanelTables, values: FloatArray) -> FloatArray:
    """Values (P,) at the points, those at the centres being the means of the corners."""
    means = np.einsum("nc,nc->n", corner_shares(panels.panels), values[panels.panels])
    return np.concatenate([values[: panels.first_centre], means, values[panels.first_centre + len(means) :]])


def wet_triangles(
    corners: FloatArray, submergence: FloatArray, pressure: FloatArray, to_cut: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, IntArray]:
    """Wet part of triangles (T, 3, 3), in triangles: corners, pressures there, weight, whose part each is.

    The others are (T, 3): see `wet_part`. A wet quadrilateral is the mean of both its splits, because the
    four pressures at its corners do not lie in one plane.
    """
    inside = np.concatenate([corners, pressure[..., None]], axis=-1)
    at_cut = np.concatenate([corners, to_cut[..., None]], axis=-1)
    tips, of_tip, rests, of_rest = cut_triangles(inside, at_cut, submergence, submergence > 0.0)
    whole = np.flatnonzero((submergence > 0.0).all(axis=1))
    pieces = np.concatenate([inside[whole], tips, rests[:, SPLITS].reshape(-1, 3, 4)])
    return (
        pieces[..., :3],
        pieces[..., 3],
        np.concatenate([np.ones(len(whole) + len(tips)), np.full(4 * len(rests), 0.5)]),
        np.concatenate([whole, of_tip, np.repeat(of_rest, 4)]),
    )


def cut_triangles(
    inside: FloatArray, at_cut: FloatArray, level: FloatArray, kept: NDArray[np.bool_]
) -> tuple[FloatArray, IntArray, FloatArray, IntArray]:
    """Kept parts of the triangles with one corner kept, then of those with two, and whose parts they are.

    `level` (T, 3) is linear over a triangle and 0 on the cut, `kept` (T, 3) says which corners stay.
    `inside` (T, 3, C) are values at the corners, `at_cut` (T, 3, C) those to interpolate along the edges to
    the cut. Returns tips (A, 3, C), quadrilaterals (B, 4, C), each in the sense of its triangle.
    """
    count = kept.sum(axis=1)
    cut = np.flatnonzero((count == 1) | (count == 2))
    one = count[cut] == 1
    # Turn each triangle so that the corner that is alone on its side of the cut comes first.
    first = np.where(one, kept[cut].argmax(axis=1), kept[cut].argmin(axis=1))
    order = (first[:, None] + np.arange(3)) % 3
    depth = level[cut[:, None], order]
    own, ends = inside[cut[:, None], order], at_cut[cut[:, None], order]
    t = (depth[:, :1] / (depth[:, :1] - depth[:, 1:]))[..., None]
    cuts = (1.0 - t) * ends[:, :1] + t * ends[:, 1:]
    tips = np.concatenate([own[one, :1], cuts[one]], axis=1)
    rests = np.stack([cuts[~one, 0], own[~one, 1], own[~one, 2], cuts[~one, 1]], axis=1)
    return tips, cut[one], rests, cut[~one]


def area_vectors(corners: FloatArray) -> FloatArray:
    """Area times normal (T, 3) of triangles (T, 3, 3)."""
    return 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def uniform_loads(area_vector: FloatArray, arm: FloatArray) -> FloatArray:
    """Load (T, 6) of unit pressure on areas (T, 3) that acts at `arm` (T, 3)."""
    return -np.concatenate([area_vector, np.cross(arm, area_vector)], axis=1)


def linear_loads(corners: FloatArray, pressure: FloatArray) -> FloatArray:
    """Load (T, 6) of a pressure that is linear on each triangle (T, 3, 3), given (T, 3) at the corners."""
    area_vector, total = area_vectors(corners), pressure.sum(axis=1)[:, None]
    # The mean of p x over a triangle, both linear: (Σ p x + Σ p Σ x) / 12.
    moment_of_pressure = (np.einsum("tc,tcx->tx", pressure, corners) + total * corners.sum(axis=1)) / 12.0
    return -np.concatenate([total / 3.0 * area_vector, np.cross(moment_of_pressure, area_vector)], axis=1)


def _whole_panels(panels: PanelTables, at_points: Sequence[FloatArray]) -> WetPart:
    """Whole panels, those whose centre is wet, each under the pressure there: TM 2003-190 section 6."""
    submergence, pressure, _ = at_points
    fan = fan_points(panels)
    wet = np.flatnonzero(submergence[fan[:, 0, 0]] > 0.0)
    fan, panel = fan[wet].reshape(-1, 3), np.repeat(wet, 4)
    centre = fan[:, 0]
    return WetPart(
        corners=panels.points[fan],
        pressure=np.repeat(pressure[centre][:, None], 3, axis=1),
        weight=np.ones(len(fan)),
        panel=panels.panel_order[panel],
        bend=np.zeros(len(fan)),
        centre=panels.points[centre],
    )


def _by_rule(
    panels: PanelTables, at_points: Sequence[FloatArray], rule: str, stretching: str, weight_density: float
) -> tuple[list[FloatArray], FloatArray]:
    """The values at the points as the rule has them at the centres, and the bend (N,) of each panel [Pa]."""
    shares = corner_shares(panels.panels)
    of_panel = np.column_stack([panels.panels, panels.first_centre + np.arange(len(panels.panels))])
    # The rule "vertex" knows no centres: they have no share in how the pressure goes on.
    weight = np.insert(shares, 4, float(rule == "vertex+centre"), axis=1)
    on_panels = [values[of_panel] for values in at_points]
    going_on = (
        on_panels[1] if stretching == "none" else _continued(on_panels, weight, weight_density=weight_density)
    )
    mean = np.einsum("nc,nc->n", shares, going_on[:, :4])
    if rule == "vertex+centre":
        return list(at_points), bend_shares(panels.panels) * (going_on[:, 4] - mean)
    values = [with_mean_centres(panels, own) for own in at_points]
    values[1][panels.first_centre : panels.first_centre + len(mean)] = mean
    return values, np.zeros(len(mean))


def _continued(at_points: Sequence[FloatArray], weight: FloatArray, *, weight_density: float) -> FloatArray:
    """Wheeler's pressure (N, C) at the points of each panel, as if the water did not end at its surface.

    A dry point has the pressure at the surface above it less ρ g times its height, and what the
    wet points of its panel have besides, in proportion to the depth, means over the panel by `weight`
    (N, C).
    """
    submergence, pressure, to_cut = at_points
    depth = np.maximum(submergence, 0.0)
    still = to_cut + weight_density * submergence
    added = np.where(submergence > 0.0, pressure - still, 0.0)
    total_added, total_depth = ((weight * part).sum(axis=1, keepdims=True) for part in (added, depth))
    growth = np.divide(total_added, total_depth, out=np.zeros_like(total_depth), where=total_depth > 0.0)
    return np.where(submergence > 0.0, pressure, still + growth * submergence)
