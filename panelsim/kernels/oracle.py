"""The slow, obvious NumPy twin of the pressure kernel, and a brute-force reference above both."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray, IntArray, corner_shares, panel_triangles, rotation_to_earth
from panelsim.kernels.tables import (
    PanelTables,
    WaveTables,
    bend_shares,
    checked_poses,
    require_rule,
    require_stretching,
)

SPLITS = np.array([[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]])  # of a quadrilateral, both ways


@dataclass(frozen=True)
class Surroundings:
    """The water about the ship at one instant: the sea, the pose of the ship in it, the constants."""

    waves: WaveTables
    pose: FloatArray
    waterline: float
    weight_density: float  # ρ g [N/m3]
    stretching: str

    def at(self, points: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """What the rule needs at points (..., 3) in ship axes, wet or dry.

        The depth below the instantaneous surface ζ - z [m], ζ with or without second order; the
        pressure [Pa], p = -ρ g z + ρ g Σ a cos θ exp(k (z - ζ)) with Wheeler's stretching, TM 2003-190
        section 2.6, or with exp(k min(z, 0)) without it; and the pressure [Pa] to interpolate along an
        edge to where the surface cuts it. With Wheeler that is the pressure at the surface above the
        point, ρ g (Σ a cos θ - ζ); without, the pressure itself, which a dry point has too.
        """
        time, wave_factor = self.pose[:2]
        earth = points @ rotation_to_earth(*self.pose[5:8]).T + self.pose[2:5]
        z = earth[..., 2] - self.waterline
        sea = self.waves
        phase = (
            earth[..., 0, None] * sea.wavenumber_x
            + earth[..., 1, None] * sea.wavenumber_y
            - sea.encounter_frequency * time
            - sea.phase
        )
        crest = wave_factor * sea.amplitude * np.cos(phase)
        elevation = crest.sum(axis=-1)
        if sea.second_order:
            second = 0.5 * (wave_factor * sea.amplitude) ** 2 * sea.wavenumber * np.cos(2.0 * phase)
            elevation = elevation + second.sum(axis=-1)
        height = z - elevation if self.stretching == "wheeler" else z
        decay = np.exp(sea.wavenumber * np.minimum(height, 0.0)[..., None])
        pressure = self.weight_density * ((crest * decay).sum(axis=-1) - z)
        at_surface = self.weight_density * (crest.sum(axis=-1) - elevation)
        return elevation - z, pressure, at_surface if self.stretching == "wheeler" else pressure


def wetted_surface_load(
    panels: PanelTables,
    waves: WaveTables,
    poses: FloatArray,
    *,
    waterline: float,
    water_density: float,
    gravity: float,
    stretching: str = "wheeler",
    rule: str = "vertex+centre",
) -> FloatArray:
    """Force and moment (B, 6) of the wetted surface in ship axes: the kernel's rules, spelled out.

    The arguments, units and errors are those of `panelsim.kernels.pressure.wetted_surface_load`.
    """
    require_stretching(stretching)
    require_rule(rule)
    loads = [
        _load_of_panels(
            panels, Surroundings(waves, pose, waterline, water_density * gravity, stretching), rule
        )
        for pose in checked_poses(poses)
    ]
    return np.array(loads).reshape(-1, 6)


def subdivided_load(
    panels: PanelTables,
    waves: WaveTables,
    poses: FloatArray,
    *,
    waterline: float,
    water_density: float,
    gravity: float,
    stretching: str = "wheeler",
    levels: int,
) -> FloatArray:
    """The load with every triangle of a panel in 4^levels parts and the exact pressure at each corner.

    What the rules tend to on flat facets as the panels shrink; arguments as `wetted_surface_load`.
    """
    require_stretching(stretching)
    corners = panel_triangles(panels.points, panels.panels).reshape(-1, 3, 3)
    for _ in range(levels):
        corners = _split_in_four(corners)
    loads = []
    for pose in checked_poses(poses):
        water = Surroundings(waves, pose, waterline, water_density * gravity, stretching)
        wet, pressure, weight, _ = _wet_triangles(corners, *water.at(corners))
        loads.append(weight @ _loads(wet, pressure))
    return np.array(loads).reshape(-1, 6)


def _load_of_panels(panels: PanelTables, water: Surroundings, rule: str) -> FloatArray:
    """Load (6,) on panels as four triangles about their centres, each with a linear pressure."""
    triangles = panel_triangles(panels.points, panels.panels)
    shares = corner_shares(panels.panels)
    at_corners = water.at(panels.points[panels.panels])
    if rule == "vertex":
        continued = _continued(at_corners, shares, water)
        mean = np.einsum("nc,nc->n", shares, continued)
        submergence, _, to_cut = (np.einsum("nc,nc->n", shares, values) for values in at_corners)
        at_centre, bend = (submergence, mean, to_cut), np.zeros(len(mean))
    else:
        at_centre = water.at(triangles[:, 0, 0])
        everywhere = [np.column_stack(pair) for pair in zip(at_corners, at_centre, strict=True)]
        continued = _continued(everywhere, np.insert(shares, 4, 1.0, axis=1), water)
        mean = np.einsum("nc,nc->n", shares, continued[:, :4])
        bend = bend_shares(panels.panels) * (continued[:, 4] - mean)
    on_triangles = [
        np.stack([np.repeat(own[:, None], 4, axis=1), values, np.roll(values, -1, axis=1)], axis=-1)
        for own, values in zip(at_centre, at_corners, strict=True)
    ]
    wet, pressure, weight, origin = _wet_triangles(
        triangles.reshape(-1, 3, 3), *(values.reshape(-1, 3) for values in on_triangles)
    )
    area_vector, arm = _area_vector(wet), triangles[origin // 4, 0, 0]
    bent = -bend[origin // 4, None] * np.concatenate([area_vector, np.cross(arm, area_vector)], axis=1)
    load: FloatArray = weight @ (_loads(wet, pressure) + bent)
    return load


def _continued(at_points: Sequence[FloatArray], weight: FloatArray, water: Surroundings) -> FloatArray:
    """Pressure (N, C) at the points of each panel, as if the water did not end at its surface.

    With Wheeler a dry point has the pressure at the surface above it less ρ g times its height, and what the
    wet points of its panel have besides, in proportion to the depth, means over the panel by `weight`
    (N, C). Without, it has its own.
    """
    submergence, pressure, to_cut = at_points
    if water.stretching == "none":
        return pressure
    depth = np.maximum(submergence, 0.0)
    still = to_cut + water.weight_density * submergence
    added = np.where(submergence > 0.0, pressure - still, 0.0)
    total_added, total_depth = ((weight * part).sum(axis=1, keepdims=True) for part in (added, depth))
    growth = np.divide(total_added, total_depth, out=np.zeros_like(total_depth), where=total_depth > 0.0)
    return np.where(submergence > 0.0, pressure, still + growth * submergence)


def _wet_triangles(
    corners: FloatArray, submergence: FloatArray, pressure: FloatArray, to_cut: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, IntArray]:
    """Wet part of triangles (T, 3, 3), in triangles: corners, pressures there, weight, whose part each is.

    A wet quadrilateral is the mean of both its splits.
    """
    wet_corners = (submergence > 0.0).sum(axis=1)
    whole = np.flatnonzero(wet_corners == 3)
    cut = np.flatnonzero((wet_corners == 1) | (wet_corners == 2))
    polygons = [_wet_polygon(corners[t], submergence[t], pressure[t], to_cut[t]) for t in cut]
    points = np.array([polygon[0] for polygon in polygons]).reshape(-1, 4, 3)[:, SPLITS]
    pressures = np.array([polygon[1] for polygon in polygons]).reshape(-1, 4)[:, SPLITS]
    return (
        np.concatenate([corners[whole], points.reshape(-1, 3, 3)]),
        np.concatenate([pressure[whole], pressures.reshape(-1, 3)]),
        np.concatenate([np.ones(len(whole)), np.full(4 * len(cut), 0.5)]),
        np.concatenate([whole, np.repeat(cut, 4)]),
    )


def _area_vector(corners: FloatArray) -> FloatArray:
    """Area times normal (T, 3) of triangles."""
    return 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def _loads(corners: FloatArray, pressure: FloatArray) -> FloatArray:
    """Load (T, 6) of a pressure that is linear on each triangle (T, 3, 3), given (T, 3) at the corners."""
    area_vector, total = _area_vector(corners), pressure.sum(axis=1)[:, None]
    # The mean of p x over a triangle, both linear: (Σ p x + Σ p Σ x) / 12.
    moment_of_pressure = (np.einsum("tc,tcx->tx", pressure, corners) + total * corners.sum(axis=1)) / 12.0
    return -np.concatenate([total / 3.0 * area_vector, np.cross(moment_of_pressure, area_vector)], axis=1)


def _wet_polygon(
    corners: FloatArray, submergence: FloatArray, pressure: FloatArray, to_cut: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Four corners and their pressures of the wet part of one cut triangle: walk its edges, keep and cut.

    A wet part with three corners repeats the last one; like a panel, it is to be split both ways.
    """
    points, pressures = [], []
    for here, there in ((0, 1), (1, 2), (2, 0)):
        if submergence[here] > 0.0:
            points.append(corners[here])
            pressures.append(pressure[here])
        if (submergence[here] > 0.0) != (submergence[there] > 0.0):
            t = submergence[here] / (submergence[here] - submergence[there])
            points.append(corners[here] + t * (corners[there] - corners[here]))
            pressures.append(to_cut[here] + t * (to_cut[there] - to_cut[here]))
    missing = 4 - len(points)
    return np.array(points + points[-1:] * missing), np.array(pressures + pressures[-1:] * missing)


def _split_in_four(corners: FloatArray) -> FloatArray:
    """Each triangle (T, 3, 3) into four by the middles of its edges: (4 T, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, bc, ca = (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([np.stack(part, axis=1) for part in parts])
