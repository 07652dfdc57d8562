"""The slow, obvious NumPy twin of the pressure kernel, and a brute-force reference above both."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray, panel_triangles, rotation_to_earth
from panelsim.kernels.tables import (
    PanelTables,
    WaveTables,
    checked_poses,
    require_rule,
    require_stretching,
)
from panelsim.kernels.wet_part import WetPart, linear_loads, wet_part, wet_triangles


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

    def wet_part_of(self, panels: PanelTables, rule: str) -> WetPart:
        """The wet part of a hull surface, with the pressure on it by the rule."""
        return wet_part(
            panels,
            self.at(panels.points),
            rule=rule,
            stretching=self.stretching,
            weight_density=self.weight_density,
        )


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
    loads = []
    for pose in checked_poses(poses):
        water = Surroundings(waves, pose, waterline, water_density * gravity, stretching)
        loads.append(water.wet_part_of(panels, rule).loads.sum(axis=0))
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
        wet, pressure, weight, _ = wet_triangles(corners, *water.at(corners))
        loads.append(weight @ linear_loads(wet, pressure))
    return np.array(loads).reshape(-1, 6)


def _split_in_four(corners: FloatArray) -> FloatArray:
    """Each triangle (T, 3, 3) into four by the middles of its edges: (4 T, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, bc, ca = (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([np.stack(part, axis=1) for part in parts])
