"""Pressure on the hull at one instant, asked for besides the load: panels, waterline, section forces."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray, panel_triangles
from panelsim.errors import PanelsimError
from panelsim.kernels.runtime import interrupts_held_back
from panelsim.kernels.section_loads import section_loads
from panelsim.kernels.tables import PanelTables, panel_tables
from panelsim.kernels.waterline import waterlines
from panelsim.kernels.wet_part import WetPart, area_vectors, wet_part
from panelsim.loads.arguments import instant_arguments
from panelsim.loads.wetted_surface import component_tables, method_of_one_call
from panelsim.seaway.seaways import Seaway
from panelsim.ship.ship import Ship

# A point this part of the hull's size off the surface lies on it: rounding decides nothing.
ON_SURFACE = 1e-12


@dataclass(frozen=True, eq=False)
class HullPressure:
    """What the sea does to the hull at one instant, in ship axes, moments about the CG; by `hull_pressure`.

    In the order of the panels of the mesh (N): `panel_pressure` (N,) [Pa], the mean over the wet part, 0
    where dry; `wet_fraction` (N,) of the area; `panel_load` (N, 6) [N, N m].
    `waterline`: closed polygons (K, 3) [m] where the water surface meets the hull, several for a
    catamaran, none for a hull wholly under or out of the water. Seen from above they run counter-clockwise
    round the hull, clockwise round water inside it, as in a moonpool; the first point is not repeated. A
    panel exactly on the surface counts as dry: the line runs round it if its neighbours are wet. By the rule
    "panel" it follows the edges between wet and dry panels.
    `wet_part`: the wet triangles behind it all.
    """

    panel_pressure: FloatArray
    wet_fraction: FloatArray
    panel_load: FloatArray
    waterline: tuple[FloatArray, ...]
    wet_part: WetPart

    @property
    def load(self) -> FloatArray:
        """Force and moment (6,) of all panels, that of `pressure_force` [N, N m]."""
        return _frozen(self.panel_load.sum(axis=0))

    def section_forces(self, stations: ArrayLike) -> FloatArray:
        """Force and moment about the CG (S, 6) of the pressure between stations, in ship axes [N, N m].

        `stations` (S + 1,): x in ship axes [m], rising. Panels are cut at them and the pressure integrated
        exactly, so sections that cover the hull add up to `load`; sections beyond the hull have
        zero. An area that stands exactly on a station, such as a transom, counts for the section forward of
        it; on the last station, for the section aft. Raises PanelsimError for stations that are fewer than
        two, not finite or not rising.
        """
        return _frozen(section_loads(self.wet_part, _checked_stations(stations)))


def hull_pressure(
    ship: Ship,
    seaway: Seaway,
    time: float,
    displacement: ArrayLike,
    *,
    speed: float = 0.0,
    stretching: str = "wheeler",
    method: str = "auto",
    rule: str = "vertex+centre",
) -> HullPressure:
    """Pressure and wet part of every panel, waterline and section forces at one instant.

    Buoyancy and incident waves together, TM 2003-190 (10) and section 2.6, as in `pressure_force`, whose
    arguments these are: `time` [s], `displacement` (6,) in translating earth axes [m, rad], `speed` [m/s];
    `method` and `rule` as there. Raises PanelsimError for arguments of another kind, angles of more than a
    turn and unknown names.
    """
    pose = np.concatenate([[time, 1.0], instant_arguments(ship, seaway, time, displacement, speed)])
    panels = panel_tables(ship.vertices, ship.mesh.panels)
    method = method_of_one_call(method)
    submergence, pressure, to_cut = _at_points(
        panels, ship, seaway, pose, speed=speed, stretching=stretching, method=method, rule=rule
    )
    wet = wet_part(
        panels,
        (submergence, pressure, to_cut),
        rule=rule,
        stretching=stretching,
        weight_density=ship.water_density * ship.gravity,
    )
    polygons, _ = waterlines(panels, submergence, rule)  # none is open: the mesh of a ship is closed
    return _by_panel(ship, wet, tuple(_frozen(polygon) for polygon in polygons))


def _at_points(
    panels: PanelTables,
    ship: Ship,
    seaway: Seaway,
    pose: FloatArray,
    *,
    speed: float,
    stretching: str,
    method: str,
    rule: str,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Depth below the surface [m], pressure and pressure to interpolate to a cut [Pa] at the points (P,)."""
    with interrupts_held_back():  # Taichi is imported here
        from panelsim.kernels.pressure import PressureIntegral
    integral = PressureIntegral(
        panels,
        [component_tables(seaway.components, speed, ship.gravity)],
        waterline=ship.waterline,
        water_density=ship.water_density,
        gravity=ship.gravity,
        stretching=stretching,
        rule=rule,
        method=method,
    )
    submergence, pressure, to_cut = integral.at_points(pose)
    on_surface = np.abs(submergence) <= ON_SURFACE * np.ptp(ship.vertices, axis=0).max()
    return np.where(on_surface, 0.0, submergence), pressure, to_cut


def _by_panel(ship: Ship, wet: WetPart, waterline: tuple[FloatArray, ...]) -> HullPressure:
    """Sum the wet triangles over the panels of the mesh."""
    count = ship.mesh.panel_count
    whole = area_vectors(panel_triangles(ship.vertices, ship.mesh.panels).reshape(-1, 3, 3))
    area = np.linalg.norm(whole, axis=1).reshape(-1, 4).sum(axis=1)
    wet_area = np.bincount(wet.panel, wet.area, count)
    thrust = np.bincount(wet.panel, wet.area * (wet.pressure.mean(axis=1) + wet.bend), count)
    panel_load = np.zeros((count, 6))
    np.add.at(panel_load, wet.panel, wet.loads)
    return HullPressure(
        panel_pressure=_frozen(np.divide(thrust, wet_area, out=np.zeros(count), where=wet_area > 0.0)),
        wet_fraction=_frozen(np.minimum(wet_area / area, 1.0)),
        panel_load=_frozen(panel_load),
        waterline=waterline,
        wet_part=wet,
    )


def _checked_stations(stations: ArrayLike) -> FloatArray:
    try:
        x = np.asarray(stations, dtype=float)
    except (TypeError, ValueError):
        raise PanelsimError("The stations are not numbers", got=stations) from None
    if x.ndim != 1 or len(x) < 2 or not np.isfinite(x).all() or (np.diff(x) <= 0.0).any():
        raise PanelsimError(
            "The stations do not bound sections",
            got=repr(x.tolist())[:200],
            allowed="two or more finite x in ship axes [m], each larger than the one before",
        )
    return x


def _frozen(array: FloatArray) -> FloatArray:
    array.setflags(write=False)
    return array
