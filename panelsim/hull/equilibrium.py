"""The draft and trim at which a loaded hull floats, upright or held at a heel."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from panelsim.conventions import SALT_WATER_DENSITY, FloatArray, rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.hull.hydrostatics import hull_point, require_positive
from panelsim.hull.immersed import ImmersedPart, immersed_part, level_vertices
from panelsim.hull.panel_mesh import PanelMesh

BALANCE = 1e-10  # of the weight, and of the weight times the hull's length for the moment
LARGEST_LIST = 1e-6  # of the beam: a CG further off the centre of buoyancy would heel the ship
LARGEST_TRIM = 0.5  # rad: no ship at sea
LARGEST_TRIM_STEP = 0.1  # rad
MOST_STEPS = 60


@dataclass(frozen=True)
class Equilibrium:
    """Where a loaded hull floats: `draft` at midships [m], `trim` [rad, bow down positive], upright."""

    draft: float
    trim: float
    heel: float = 0.0


def equilibrium(
    mesh: PanelMesh,
    *,
    mass: float,
    center_of_gravity: ArrayLike,
    water_density: float = SALT_WATER_DENSITY,
    initial_draft: float,
) -> Equilibrium:
    """Find the draft and trim at which buoyancy carries the weight with no trimming moment.

    mass in kg, center_of_gravity (3,) in hull axes [m], initial_draft [m] where the search starts. The
    residuals end below 1e-10 of the weight and of weight times length. Raises PanelsimError where the hull
    cannot carry the mass, where no balance is found, and where the ship would take a list.
    """
    gravity_center = hull_point(center_of_gravity)
    _require_carried(mesh, mass, water_density)
    low, high = mesh.vertices[:, 2].min(), mesh.vertices[:, 2].max()
    if not low < initial_draft < high:
        raise PanelsimError(
            "The search cannot start outside the hull",
            got=f"initial_draft {initial_draft} m",
            allowed=f"between {low:g} and {high:g} m",
        )
    volume = mass / water_density
    waterline, trim, part = settle(mesh, 0.0, volume, gravity_center, waterline=initial_draft)
    if abs(trim) > LARGEST_TRIM:
        raise PanelsimError(
            "The hull floats only at a trim that no ship has",
            got=f"{np.degrees(trim):.1f} degrees, bow down positive",
            allowed=f"up to {np.degrees(LARGEST_TRIM):.0f} degrees either way",
            remedy="check the longitudinal centre of gravity",
        )
    offset = gravity_center[1] - part.volume_moment[1] / part.volume
    allowed = LARGEST_LIST * part.waterline_beam
    if abs(offset) > allowed:
        raise PanelsimError(
            "The ship would take a list, which is not supported",
            got=f"centre of gravity {offset:.6g} m to port of the centre of buoyancy",
            allowed=f"within {allowed:.3g} m of it sideways",
            remedy="move the centre of gravity, or check that the mesh is symmetric about the centreline",
        )
    return Equilibrium(draft=waterline / float(np.cos(trim)), trim=trim)


def draft_of_mass(
    mesh: PanelMesh, *, mass: float, trim: float = 0.0, water_density: float = SALT_WATER_DENSITY
) -> float:
    """Draft at midships [m] at which the hull, held at a trim [rad, bow down positive], displaces a mass.

    mass in kg. Raises PanelsimError for a mass that is not positive or that the hull cannot carry.
    """
    _require_carried(mesh, mass, water_density)
    return waterline_of_volume(mesh, mass / water_density, heel=0.0, trim=trim) / float(np.cos(trim))


def waterline_of_volume(mesh: PanelMesh, volume: float, *, heel: float, trim: float) -> float:
    """Height of the water plane [m] in level axes at which a hull held at heel and trim displaces a volume.

    volume [m3], less than that of the closed hull; heel and trim [rad].
    """
    height = level_vertices(mesh, heel, trim)[:, 2]

    def excess(waterline: float) -> float:
        return immersed_part(mesh, heel=heel, trim=trim, waterline=waterline).volume - volume

    return float(brentq(excess, height.min(), height.max(), xtol=1e-12))


def _require_carried(mesh: PanelMesh, mass: float, water_density: float) -> None:
    """Refuse a mass that is not positive, or more than the hull displaces when it is just under water."""
    require_positive(mass=mass, water_density=water_density)
    top = float(mesh.vertices[:, 2].max())
    capacity = water_density * immersed_part(mesh, heel=0.0, trim=0.0, waterline=top).volume
    if mass >= capacity:
        raise PanelsimError(
            "The hull cannot float with this mass",
            got=f"{mass:.6g} kg",
            allowed=f"less than {capacity:.6g} kg, what the closed hull displaces",
        )


def settle(
    mesh: PanelMesh, heel: float, volume: float, gravity_center: FloatArray, *, waterline: float
) -> tuple[float, float, ImmersedPart]:
    """Newton's method for the water's height [m] and the trim [rad] at a fixed heel [rad].

    volume [m3] to displace, gravity_center (3,) in the axes of the mesh [m], waterline [m] in level axes
    where the search starts, without trim. Returns height and trim, and the immersed part there. Raises
    PanelsimError where no balance is found.
    """
    trim = 0.0
    length = float(np.ptp(mesh.vertices[:, 0]))
    for _ in range(MOST_STEPS):
        part = immersed_part(mesh, heel=heel, trim=trim, waterline=waterline)
        level_gravity = rotation_to_earth(heel, trim, 0.0) @ gravity_center
        lack = np.array([volume - part.volume, volume * level_gravity[0] - part.volume_moment[0]])
        if abs(lack[0]) <= BALANCE * volume and abs(lack[1]) <= BALANCE * volume * length:
            return waterline, trim, part
        # Rates of the volume and of its x moment, less the weight's, as water rises and bow goes down.
        moment_rate = part.volume_moment[2] - volume * level_gravity[2] + part.waterplane_second_moment[0, 0]
        rates = np.array(
            [[part.waterplane_area, part.waterplane_moment[0]], [part.waterplane_moment[0], moment_rate]]
        )
        if not abs(np.linalg.det(rates)) > 0.0:
            break
        rise, trim_step = np.linalg.solve(rates, lack)
        trim += float(np.clip(trim_step, -LARGEST_TRIM_STEP, LARGEST_TRIM_STEP))
        height = level_vertices(mesh, heel, trim)[:, 2]
        waterline = _within_hull(waterline + float(rise), waterline, float(height.min()), float(height.max()))
    raise PanelsimError(
        "No draft and trim were found at which the hull floats",
        got=f"{volume:.6g} m3 to displace, centre of gravity {gravity_center.tolist()}",
        remedy="check the mass, the centre of gravity and that the mesh is closed",
    )


def _within_hull(wanted: float, present: float, low: float, high: float) -> float:
    """The wanted waterline, or half the way to the end of the hull that it would pass."""
    if low < wanted < high:
        return wanted
    start = present if low < present < high else 0.5 * (low + high)
    return 0.5 * (start + (low if wanted <= low else high))
