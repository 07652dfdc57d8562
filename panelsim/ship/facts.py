"""The facts of a ship at rest that people ask for, beside the published ones."""

from dataclasses import asdict, dataclass

from panelsim.ship.ship import Ship


@dataclass(frozen=True)
class Published:
    """A published value, ours, and the relative difference."""

    published: float
    here: float
    difference: float


@dataclass(frozen=True)
class ShipFacts:
    """Hydrostatic particulars of a ship at rest: m, kg, m2, m3; points in hull axes."""

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
    published: dict[str, Published]

    def as_dict(self) -> dict[str, object]:
        """Plain values, for JSON."""
        return asdict(self)


def ship_facts(ship: Ship) -> ShipFacts:
    """Collect the facts of a ship at rest."""
    rest = ship.hydrostatics
    here = {
        "displacement": ship.mass,
        "gm_transverse": rest.gm_transverse,
        "gm_longitudinal": rest.gm_longitudinal,
        "displaced_volume": rest.displaced_volume,
        "center_of_buoyancy_height": float(rest.center_of_buoyancy[2]),
    }
    known = ship.form.published if ship.form is not None else {}
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
        published={
            name: Published(value, here[name], here[name] / value - 1.0)
            for name, value in known.items()
            if name in here and value
        },
    )
