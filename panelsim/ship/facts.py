"""The facts of a ship at rest that people ask for, beside the published ones."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from panelsim.hull.defects import MeshDefect, mesh_defect
from panelsim.hull.form import HullForm
from panelsim.ship.ship import Ship


@dataclass(frozen=True)
class Published:
    """A published value, ours, and the difference, ours less published; None where we have none."""

    published: float
    here: float | None
    difference: float | None
    relative_difference: float | None


@dataclass(frozen=True)
class ShipFacts:
    """Hydrostatic particulars of a ship at rest: m, kg, m2, m3; points in hull axes.

    `mesh_defect`: what the panels lose of the form they came from [%], None where no form is known.
    """

    name: str
    draft: float
    trim_by_stern: float
    panels_wet: int
    panels_total: int
    displaced_volume: float
    mass: float
    center_of_gravity: tuple[float, ...]
    center_of_buoyancy: tuple[float, ...]
    center_of_flotation: tuple[float, ...]
    wetted_surface: float
    waterplane_area: float
    waterline_length: float
    waterline_beam: float
    block_coefficient: float
    gm_transverse: float
    gm_longitudinal: float
    water_density: float
    mesh_defect: MeshDefect | None
    published: dict[str, Published]
    warnings: tuple[str, ...]

    def as_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return asdict(self)


def ship_facts(ship: Ship) -> ShipFacts:
    """Collect the facts of a ship at rest; published values only for the loading they were published for."""
    rest = ship.hydrostatics
    return ShipFacts(
        name=ship.name,
        draft=ship.draft,
        trim_by_stern=ship.trim_by_stern,
        panels_wet=rest.panels_wet,
        panels_total=rest.panels_total,
        displaced_volume=rest.displaced_volume,
        mass=ship.mass,
        center_of_gravity=tuple(float(v) for v in ship.center_of_gravity),
        center_of_buoyancy=tuple(float(v) for v in rest.center_of_buoyancy),
        center_of_flotation=tuple(float(v) for v in rest.center_of_flotation),
        wetted_surface=rest.wetted_surface,
        waterplane_area=rest.waterplane_area,
        waterline_length=rest.waterline_length,
        waterline_beam=rest.waterline_beam,
        block_coefficient=rest.block_coefficient,
        gm_transverse=rest.gm_transverse,
        gm_longitudinal=rest.gm_longitudinal,
        water_density=ship.water_density,
        mesh_defect=None if ship.form is None else mesh_defect(ship.form, rest),
        published=_beside_published(ship),
        warnings=ship_warnings(ship),
    )


def ship_warnings(ship: Ship) -> tuple[str, ...]:
    """What is allowed but unusual about the loading, one sentence each."""
    rest = ship.hydrostatics
    warnings = [
        f"The {axis} metacentric height is {gm:.3g} m: the ship does not float upright by itself,"
        " it heels and may capsize."
        for axis, gm in (("transverse", rest.gm_transverse), ("longitudinal", rest.gm_longitudinal))
        if gm <= 0.0
    ]
    x, y, z = np.abs(ship.vertices).max(axis=0)
    reach = {"roll": np.hypot(y, z), "pitch": np.hypot(x, z), "yaw": np.hypot(x, y)}
    warnings += [
        f"The {name} gyradius of {radius:g} m reaches beyond the hull, {reach[name]:.3g} m from its axis."
        for name, radius in zip(reach, ship.gyradii, strict=True)
        if radius > reach[name]
    ]
    forward, aft = ship.mesh.vertices[:, 0].max(), ship.mesh.vertices[:, 0].min()
    if ship.form is None and abs(forward + aft) > 0.1 * (forward - aft):
        warnings.append(
            f"The middle of the mesh lies {0.5 * (forward + aft):.3g} m from the origin of hull axes, which"
            " is midships: draft and trim are counted there. Is the origin of the mesh as meant?"
        )
    straddling = ship.straddling_panels
    if ship.form is not None and straddling:
        warnings.append(
            f"The water at rest passes the stern or the bow by: {straddling} panels are cut by it instead of"
            " ending there. Loads are exact for them; the count of wet panels is not."
        )
    return tuple(warnings)


def _beside_published(ship: Ship) -> dict[str, Published]:
    form = ship.form
    if form is None or not _floats_as_stated(ship, form):
        return {}
    rest = ship.hydrostatics
    here = {
        "mass": ship.mass,
        "displaced_volume": rest.displaced_volume,
        "center_of_buoyancy_x": float(rest.center_of_buoyancy[0]),
        "center_of_buoyancy_z": float(rest.center_of_buoyancy[2]),
        "gm_transverse": rest.gm_transverse,
        "gm_longitudinal": rest.gm_longitudinal,
    }
    return {name: _compared(value, here.get(name)) for name, value in form.published.items()}


def _compared(published: float, here: float | None) -> Published:
    if here is None:
        return Published(published, None, None, None)
    difference = here - published
    return Published(published, here, difference, difference / abs(published) if published else None)


def _floats_as_stated(ship: Ship, form: HullForm) -> bool:
    """Whether the ship floats and is loaded as the particulars of its hull say."""
    loading = form.loading
    stated = (form.draft, form.trim_by_stern, loading.center_of_gravity_height, loading.water_density)
    here = (ship.draft, ship.trim_by_stern, ship.center_of_gravity[2], ship.water_density)
    return np.allclose(here, stated, rtol=1e-9, atol=1e-9)
