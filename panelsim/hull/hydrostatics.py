"""Hydrostatics of a hull at rest: exact for its panels, and independent of the pressure kernels."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import (
    SALT_WATER_DENSITY,
    STANDARD_GRAVITY,
    Dof,
    FloatArray,
    rotation_to_earth,
)
from panelsim.errors import PanelsimError
from panelsim.hull.immersed import ImmersedPart, immersed_part, level_vertices
from panelsim.hull.panel_mesh import PanelMesh

NO_WATERPLANE = 1e-9  # a waterplane this part of the wetted surface is rounding: the hull is under water


@dataclass(frozen=True)
class Hydrostatics:
    """What the hull displaces at a draft, trim and heel, and how it resists leaving them.

    Points are in hull axes. `waterplane_second_moment` (2, 2) [m4] is about the centre of flotation, along
    horizontal axes: [0, 0] = ∫x² dA resists trim, [1, 1] = ∫y² dA resists heel, [0, 1] couples them.
    `waterline_length` and `waterline_beam` are the extents of the waterline, `immersed_depth` that of
    the lowest point under water. `gm_transverse`, `gm_longitudinal` and `stiffness` need the centre of
    gravity and raise PanelsimError where none was given.
    """

    draft: float
    trim: float
    heel: float
    center_of_gravity: FloatArray | None
    water_density: float
    gravity: float
    displaced_volume: float
    center_of_buoyancy: FloatArray
    wetted_surface: float
    waterplane_area: float
    center_of_flotation: FloatArray
    waterplane_second_moment: FloatArray
    waterline_length: float
    waterline_beam: float
    immersed_depth: float
    panels_wet: int
    panels_total: int

    @property
    def displaced_mass(self) -> float:
        """Mass of the displaced water [kg]."""
        return self.water_density * self.displaced_volume

    @property
    def block_coefficient(self) -> float:
        """Displaced volume over waterline length x waterline beam x immersed depth."""
        return self.displaced_volume / (self.waterline_length * self.waterline_beam * self.immersed_depth)

    @property
    def waterplane_coefficient(self) -> float:
        """Waterplane area over waterline length x waterline beam."""
        return self.waterplane_area / (self.waterline_length * self.waterline_beam)

    @property
    def gm_transverse(self) -> float:
        """Metacentric height in heel [m], from the second moment about the centre of flotation."""
        return float(self.waterplane_second_moment[1, 1]) / self.displaced_volume + self._buoyancy_lever()[2]

    @property
    def gm_longitudinal(self) -> float:
        """Metacentric height in trim [m], from the second moment about the centre of flotation."""
        return float(self.waterplane_second_moment[0, 0]) / self.displaced_volume + self._buoyancy_lever()[2]

    @property
    def stiffness(self) -> FloatArray:
        """Hydrostatic restoring (6, 6) about the CG, weight included: load = -stiffness @ displacement.

        Axes are horizontal at rest (x forward, y to port, z up), the mass is the displaced mass, and the
        moments are those conjugate to the yaw-pitch-roll angles, so the matrix is symmetric and has no
        surge, sway or yaw. N/m, N/rad, N m/rad. Bow down is positive pitch: C35 = -ρg ∫x dA.
        """
        flotation = self._from_gravity(self.center_of_flotation)
        area = self.waterplane_area
        xx, xy, yy = (
            self.waterplane_second_moment[i, j] + area * flotation[i] * flotation[j]
            for i, j in ((0, 0), (0, 1), (1, 1))
        )
        weight_term = self.displaced_volume * self._buoyancy_lever()[2]
        restoring = np.zeros((6, 6))
        block = slice(Dof.HEAVE, Dof.YAW)
        restoring[block, block] = [
            [area, area * flotation[1], -area * flotation[0]],
            [area * flotation[1], yy + weight_term, -xy],
            [-area * flotation[0], -xy, xx + weight_term],
        ]
        return self.water_density * self.gravity * restoring

    def _buoyancy_lever(self) -> FloatArray:
        """Centre of buoyancy from the CG (3,) [m], in horizontal axes."""
        return self._from_gravity(self.center_of_buoyancy)

    def _from_gravity(self, point: FloatArray) -> FloatArray:
        if self.center_of_gravity is None:
            raise PanelsimError(
                "Metacentric heights and stiffness need the centre of gravity",
                remedy="give hydrostatics(..., center_of_gravity=(x, y, z)) in hull axes",
            )
        return rotation_to_earth(self.heel, self.trim, 0.0) @ (point - self.center_of_gravity)


def hydrostatics(
    mesh: PanelMesh,
    *,
    draft: float,
    trim: float = 0.0,
    heel: float = 0.0,
    center_of_gravity: ArrayLike | None = None,
    water_density: float = SALT_WATER_DENSITY,
    gravity: float = STANDARD_GRAVITY,
) -> Hydrostatics:
    """Integrate exactly over the immersed part of a mesh, a panel being four triangles about its centre.

    The hull is turned by rotation_to_earth(heel, trim, 0) [rad], starboard and bow down positive, and the
    water plane passes through the point (0, 0, draft) of the hull [m]. center_of_gravity (3,) is in hull
    axes [m], water_density in kg/m3, gravity in m/s2. Raises PanelsimError for values that make no sense,
    for a hull wholly above or below the water, and for one whose immersed volume is negative.
    """
    for name, value in (("draft", draft), ("trim", trim), ("heel", heel)):
        if not np.isfinite(value):
            raise PanelsimError(f"{name} is not a finite number", got=value)
    require_positive(water_density=water_density, gravity=gravity)
    gravity_center = None if center_of_gravity is None else hull_point(center_of_gravity)

    turn = rotation_to_earth(heel, trim, 0.0)
    waterline = float(turn[2, 2] * draft)
    part = immersed_part(mesh, heel=heel, trim=trim, waterline=waterline)
    _require_afloat(part, draft)
    flotation = part.waterplane_moment / part.waterplane_area
    about_flotation = part.waterplane_second_moment - part.waterplane_area * np.outer(flotation, flotation)
    return Hydrostatics(
        draft=draft,
        trim=trim,
        heel=heel,
        center_of_gravity=gravity_center,
        water_density=water_density,
        gravity=gravity,
        displaced_volume=part.volume,
        center_of_buoyancy=turn.T @ (part.volume_moment / part.volume),
        wetted_surface=part.wetted_surface,
        waterplane_area=part.waterplane_area,
        center_of_flotation=turn.T @ np.array([*flotation, waterline]),
        waterplane_second_moment=about_flotation,
        waterline_length=part.waterline_length,
        waterline_beam=part.waterline_beam,
        immersed_depth=waterline - float(level_vertices(mesh, heel, trim)[:, 2].min()),
        panels_wet=part.panels_wet,
        panels_total=mesh.panel_count,
    )


def require_positive(**values: float) -> None:
    """Raise PanelsimError for the first value that is not finite and above zero."""
    for name, value in values.items():
        if not (np.isfinite(value) and value > 0.0):
            raise PanelsimError(f"{name} is not positive", got=value, allowed="more than 0")


def hull_point(center_of_gravity: ArrayLike) -> FloatArray:
    """The centre of gravity as an array (3,) in hull axes [m]; raises PanelsimError if it is not one."""
    point = np.array(center_of_gravity, dtype=float)
    if point.shape != (3,) or not np.isfinite(point).all():
        raise PanelsimError(
            "center_of_gravity is not a point in hull axes",
            got=center_of_gravity,
            allowed="three finite numbers [m]: forward of midships, to port, above the baseline",
        )
    return point


def _require_afloat(part: ImmersedPart, draft: float) -> None:
    if part.panels_wet == 0:
        raise PanelsimError("The hull does not reach the water", got=f"draft {draft} m")
    if part.volume <= 0.0:
        raise PanelsimError(
            "The immersed volume is not positive: the normals point into the hull, or it is open",
            got=f"{part.volume:.6g} m3 at draft {draft} m",
            remedy="run check_mesh on it",
        )
    if part.waterplane_area <= NO_WATERPLANE * part.wetted_surface:
        raise PanelsimError(
            "The hull lies wholly under water",
            got=f"draft {draft:g} m",
            remedy="choose a smaller draft or mass",
        )
