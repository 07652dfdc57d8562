"""The slow, obvious NumPy twin of the pressure kernel, and a brute-force reference above both."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import QUAD_SPLITS, SPLIT_WEIGHT, FloatArray, rotation_to_earth
from panelsim.kernels.tables import (
    PanelTables,
    WaveTables,
    checked_poses,
    require_stretching,
)


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
) -> FloatArray:
    """Force and moment (B, 6) of the wetted surface in ship axes: the kernel's rule, spelled out.

    The arguments, units and errors are those of `panelsim.kernels.pressure.wetted_surface_load`.
    """
    corners = panels.points[panels.split_triangles]
    return _load_at_poses(corners, waves, poses, waterline, water_density * gravity, stretching)


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
    """The same load with every triangle split into 4^levels parts and the exact pressure at each corner.

    What the rule tends to on flat facets as the panels shrink; arguments as `wetted_surface_load`.
    """
    corners = panels.points[panels.split_triangles]
    for _ in range(levels):
        corners = _split_in_four(corners)
    return _load_at_poses(corners, waves, poses, waterline, water_density * gravity, stretching)


def _load_at_poses(
    corners: FloatArray,
    waves: WaveTables,
    poses: FloatArray,
    waterline: float,
    weight_density: float,
    stretching: str,
) -> FloatArray:
    require_stretching(stretching)
    loads = [
        _load(corners, Surroundings(waves, pose, waterline, weight_density, stretching))
        for pose in checked_poses(poses)
    ]
    return np.array(loads).reshape(-1, 6)


def _load(corners: FloatArray, water: Surroundings) -> FloatArray:
    """Load (6,) on half-weight triangles (T, 3, 3) in ship axes; the cut ones keep their wet pieces."""
    submergence, pressure, to_cut = water.at(corners)
    wet_corners = (submergence > 0.0).sum(axis=1)
    whole = wet_corners == 3
    load = _integrate(corners[whole], pressure[whole])
    polygons = [
        _wet_polygon(corners[t], submergence[t], pressure[t], to_cut[t])
        for t in np.flatnonzero((wet_corners == 1) | (wet_corners == 2))
    ]
    if polygons:
        points, pressures = (np.array(side)[:, QUAD_SPLITS] for side in zip(*polygons, strict=True))
        load += SPLIT_WEIGHT * _integrate(points.reshape(-1, 3, 3), pressures.reshape(-1, 3))
    return SPLIT_WEIGHT * load


def _integrate(corners: FloatArray, pressure: FloatArray) -> FloatArray:
    """Load (6,) of a pressure that is linear on each triangle (T, 3, 3), given (T, 3) at the corners."""
    x0, x1, x2 = corners[:, 0], corners[:, 1], corners[:, 2]
    area_vector = 0.5 * np.cross(x1 - x0, x2 - x0)
    mean = pressure.mean(axis=1)
    # The mean of p x over a triangle, both linear: (Σ p x + Σ p Σ x) / 12.
    moment_of_pressure = (
        np.einsum("tc,tcx->tx", pressure, corners) + pressure.sum(axis=1)[:, None] * corners.sum(axis=1)
    ) / 12.0
    force = -(mean[:, None] * area_vector).sum(axis=0)
    moment = -np.cross(moment_of_pressure, area_vector).sum(axis=0)
    return np.concatenate([force, moment])


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
