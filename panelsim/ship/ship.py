"""A ship: a hull mesh with mass, centre of gravity and gyradii, afloat in equilibrium in calm water."""

import hashlib
from functools import cached_property
from typing import Final

import numpy as np

from panelsim.conventions import (
    SALT_WATER_DENSITY,
    STANDARD_GRAVITY,
    FloatArray,
    rotation_to_earth,
)
from panelsim.errors import PanelsimError, require_kind
from panelsim.hull.checks import require_sound
from panelsim.hull.equilibrium import draft_of_mass, equilibrium
from panelsim.hull.form import HullForm
from panelsim.hull.hydrostatics import Hydrostatics, hydrostatics
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.panelling import EndMissesWater

MOST_TRIM = 0.5  # rad: beyond it the bow or the stern stands out of the water


class Ship:
    """A loaded ship, floating at rest.

    `mesh` in hull axes. `center_of_gravity` (x, y, z) in hull axes [m]; x may be None, then the
    ship is loaded so that it floats at the given trim. `gyradii` (roll, pitch, yaw) [m] about the CG,
    of axes that are level at rest.

    Without `mass`, mass and longitudinal CG are those that float at `draft` [m] (at midships) and
    `trim` [rad] (bow down positive). With a `mass` [kg] and a CG that has an x, the ship sinks and
    trims to its own equilibrium, from `draft` as a first guess.

    Ship axes have their origin at the CG, x forward, y to port, z up, x and y level at rest.
    Raises PanelsimError for an open or inward mesh and for a loading that cannot float.
    """

    def __init__(
        self,
        mesh: PanelMesh,
        *,
        draft: float,
        center_of_gravity: tuple[float | None, float, float],
        gyradii: tuple[float, float, float],
        mass: float | None = None,
        trim: float = 0.0,
        water_density: float = SALT_WATER_DENSITY,
        gravity: float = STANDARD_GRAVITY,
        name: str = "ship",
        form: HullForm | None = None,
    ) -> None:
        require_sound(mesh)
        _require_loading(draft, center_of_gravity, gyradii, mass, trim, water_density, gravity)
        x, y, z = center_of_gravity
        if mass is None and x is not None:
            raise PanelsimError(
                "A longitudinal centre of gravity needs a mass",
                got=f"x = {x:g} m and no mass",
                allowed="both, or neither",
                remedy="give the mass as well, or leave x out (None) to float at the stated draft and trim",
            )
        if mass is not None and x is not None:
            rest = equilibrium(
                mesh,
                mass=mass,
                center_of_gravity=(x, y, z),
                water_density=water_density,
                initial_draft=draft,
            )
            draft, trim = rest.draft, rest.trim
        elif mass is not None:
            draft = draft_of_mass(mesh, mass=mass, trim=trim, water_density=water_density)

        self.name: Final = name
        self.mesh: Final = mesh
        self.form: Final = form
        self.draft: Final = float(draft)
        self.trim: Final = float(trim)
        self.water_density: Final = float(water_density)
        self.gravity: Final = float(gravity)
        self.gyradii: Final = tuple(float(r) for r in gyradii)
        afloat = hydrostatics(mesh, draft=draft, trim=trim, water_density=water_density, gravity=gravity)
        if x is None:
            # Vertically below or above the centre of buoyancy, so that nothing turns the ship.
            x = float(afloat.center_of_buoyancy[0] + (afloat.center_of_buoyancy[2] - z) * np.tan(trim))
        if abs(y - afloat.center_of_buoyancy[1]) > 1e-6 * np.ptp(mesh.vertices[:, 1]):
            raise PanelsimError(
                "The centre of gravity lies to one side of the centre of buoyancy, the ship would list",
                got=f"y = {y:g} m",
                allowed=f"y = {afloat.center_of_buoyancy[1]:.6g} m",
                remedy="a list is not supported: balance the loading",
            )
        self.center_of_gravity: Final = np.array([x, y, z], dtype=float)
        self.mass: Final = float(afloat.displaced_mass if mass is None else mass)
        _require_wet(self)

    @cached_property
    def rotation_from_hull(self) -> FloatArray:
        """Matrix (3, 3) from hull to ship axes: the static trim."""
        return rotation_to_earth(0.0, self.trim, 0.0)

    def to_ship_axes(self, points: FloatArray) -> FloatArray:
        """Turn points (..., 3) from hull axes into ship axes [m]."""
        return (np.asarray(points, float) - self.center_of_gravity) @ self.rotation_from_hull.T

    @cached_property
    def vertices(self) -> FloatArray:
        """Mesh vertices (V, 3) in ship axes [m]; those on the waterline at rest lie on it exactly."""
        vertices = self.to_ship_axes(self.mesh.vertices)
        # Rounding would cut some of the panels that end at the waterline and not their mirror images.
        on_waterline = np.abs(vertices[:, 2] - self.waterline) < 1e-9 * np.ptp(vertices[:, 0])
        vertices[on_waterline, 2] = self.waterline
        vertices.setflags(write=False)
        return vertices

    @cached_property
    def waterline(self) -> float:
        """Height of the calm water surface in ship axes [m]; draft − KG for a ship without trim."""
        return float(self.to_ship_axes(np.array([0.0, 0.0, self.draft]))[2])

    @cached_property
    def hydrostatics(self) -> Hydrostatics:
        """Hydrostatics at rest about the CG, by NumPy from this mesh, apart from the kernels."""
        return hydrostatics(
            self.mesh,
            draft=self.draft,
            trim=self.trim,
            center_of_gravity=tuple(self.center_of_gravity),
            water_density=self.water_density,
            gravity=self.gravity,
        )

    @cached_property
    def inertia(self) -> FloatArray:
        """Rigid-body inertia (6, 6) about the CG [kg, kg m²], without products of inertia."""
        return self.mass * np.diag([1.0, 1.0, 1.0, *(radius**2 for radius in self.gyradii)])

    @property
    def length(self) -> float:
        """Length between perpendiculars [m], or the length of the mesh where no form is known."""
        if self.form is not None:
            return self.form.length_pp
        return float(np.ptp(self.mesh.vertices[:, 0]))

    @property
    def beam(self) -> float:
        """Moulded beam [m], or the breadth of the mesh where no form is known."""
        if self.form is not None:
            return self.form.beam
        return float(np.ptp(self.mesh.vertices[:, 1]))

    @property
    def trim_by_stern(self) -> float:
        """Trim as the difference of the drafts aft and forward [m], over the length."""
        return float(-self.length * np.tan(self.trim))

    def identity(self) -> dict[str, str | float]:
        """What hydrodynamic coefficients depend on, by name: form, flotation, CG, water, gravity.

        The form is a hash, of the hull form where it is known, else of the mesh; the rest are
        numbers to compare within a tolerance (the longitudinal CG of a ship that floats at a
        stated draft moves by centimetres with its panelling). Mass and gyradii do not enter.
        """
        form = self.form.fingerprint() if self.form is not None else _mesh_fingerprint(self.mesh)
        return {
            "form": form,
            "draft": self.draft,
            "trim": self.trim,
            "center_of_gravity_x": float(self.center_of_gravity[0]),
            "center_of_gravity_z": float(self.center_of_gravity[2]),
            "water_density": self.water_density,
            "gravity": self.gravity,
        }

    def with_mesh(self, mesh: PanelMesh) -> "Ship":
        """The same hull at the same draft, trim and KG on another mesh of it, floating there by itself."""
        return Ship(
            mesh,
            draft=self.draft,
            trim=self.trim,
            center_of_gravity=(None, float(self.center_of_gravity[1]), float(self.center_of_gravity[2])),
            gyradii=(self.gyradii[0], self.gyradii[1], self.gyradii[2]),
            water_density=self.water_density,
            gravity=self.gravity,
            name=self.name,
            form=self.form,
        )

    def at_panel_area(self, panel_area: float) -> "Ship":
        """The same ship on a mesh of another panel size [m²]; itself where no form is known."""
        if self.form is None:
            return self
        return self.with_mesh(panel_to_waterline(self.form, panel_area, self.draft, self.trim_by_stern))

    @property
    def straddling_panels(self) -> int:
        """Panels that the water at rest cuts: none where the mesh follows it, as for most hull forms."""
        height = (self.vertices[:, 2] - self.waterline)[self.mesh.panels]
        return int(np.count_nonzero((height.min(axis=1) < 0.0) & (height.max(axis=1) > 0.0)))


def panel_to_waterline(form: HullForm, panel_area: float, draft: float, trim_by_stern: float) -> PanelMesh:
    """A mesh whose panels end at the water at rest, or where that cannot be, at the form's own draft.

    It cannot where the water at rest passes below the transom or the stem. The loads cut panels exactly, so
    only the count of wet panels loses its meaning.
    """
    try:
        return form.panel(panel_area, draft=draft, trim_by_stern=trim_by_stern)
    except EndMissesWater:
        return form.panel(panel_area)


def _mesh_fingerprint(mesh: PanelMesh) -> str:
    digest = hashlib.sha256(mesh.vertices.tobytes())
    digest.update(mesh.panels.tobytes())
    return digest.hexdigest()[:16]


def _require_loading(
    draft: float,
    center_of_gravity: tuple[float | None, float, float],
    gyradii: tuple[float, float, float],
    mass: float | None,
    trim: float,
    water_density: float,
    gravity: float,
) -> None:
    """Refuse what no ship can have."""
    try:
        radii = np.array(gyradii, dtype=float)
        center = np.array([0.0 if c is None else c for c in center_of_gravity], dtype=float)
        numbers = np.array([draft, trim, water_density, gravity, 0.0 if mass is None else mass], dtype=float)
    except (TypeError, ValueError):
        raise PanelsimError("The loading of the ship is not given in numbers") from None
    if radii.shape != (3,) or center.shape != (3,) or None in center_of_gravity[1:]:
        raise PanelsimError(
            "Gyradii and centre of gravity are three numbers each",
            got=f"gyradii {gyradii}, center_of_gravity {center_of_gravity}",
            allowed="(roll, pitch, yaw) and (x, y, z) in m, of which x may be None",
        )
    positive = {"draft": draft, "water_density": water_density, "gravity": gravity, "mass": mass}
    positive |= {f"gyradius_{n}": float(r) for n, r in zip(("roll", "pitch", "yaw"), radii, strict=True)}
    for name, value in positive.items():
        if value is not None and not (np.isfinite(value) and value > 0):
            raise PanelsimError(f"The ship's {name} is not positive", got=value, allowed="more than 0")
    if not (np.isfinite(center).all() and np.isfinite(numbers).all()):
        raise PanelsimError("The centre of gravity or the trim is not finite", got=(center_of_gravity, trim))
    if abs(trim) > MOST_TRIM:
        raise PanelsimError(
            "No ship floats at this trim", got=f"{trim:g} rad", allowed=f"-{MOST_TRIM} to {MOST_TRIM} rad"
        )
    if not 900.0 <= water_density <= 1100.0:
        raise PanelsimError(
            "This water density is not that of water",
            got=f"{water_density:g} kg/m3",
            allowed="900 to 1100 kg/m3 (fresh 1000, salt 1025)",
        )


def _require_wet(ship: Ship) -> None:
    """Refuse a ship that floats on less than a row of its panels: its mass is meant in tonnes."""
    wet = ship.to_ship_axes(ship.mesh.centroid)[:, 2] < ship.waterline
    if not wet.any():
        raise PanelsimError(
            "No panel of the hull lies under the water at rest",
            got=f"mass {ship.mass:g} kg, draft {ship.draft:.3g} m",
            remedy="masses are in kg (4655 t are 4.655e6 kg), lengths in m; or take smaller panels",
        )


def require_ship(ship: object) -> None:
    """Raise PanelsimError for what is no ship."""
    require_kind("ship", ship, Ship, "a Ship, as load_ship() makes it")
