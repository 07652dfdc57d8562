"""Strip theory of a ship: sections cut from her panels or given, checked to be hers, and solved."""

from collections.abc import Callable

import numpy as np
import xarray as xr

from panelsim.errors import PanelsimError
from panelsim.hydro.frequency_grids import strip_frequency_grid
from panelsim.hydro.strip.database import highest_strip_frequency, solve_strips
from panelsim.hydro.strip.mesh_sections import section_of_mesh, sections_of_mesh, wet_ends
from panelsim.hydro.strip.section_forms import SectionForm
from panelsim.hydro.strip.sections import HullSections
from panelsim.ship.ship import Ship

_STRIPS = 21
_SAME_WATERLINE = 1e-3  # of the draft
# A table of offsets has stations 5 % of the length apart, and none where the wet hull ends.
_SAME_ENDS = 0.06  # of the wet length
_SAME_DRAFT = 0.03  # of the draft
_SAME_VOLUME = 0.03  # of the displaced volume; a table of 20 stations and the panels differ by 0.5 %
_SAME_AREAS = 0.05  # of the displaced volume, by which areas differ in all; 0.4 % there
_AMIDSHIPS = 0.45  # of the wet length to either side of its middle, where areas are compared


def solve_strips_of_ship(
    ship: Ship,
    sections: HullSections | None,
    section_form: SectionForm,
    progress: Callable[[int, int], None] | None,
) -> xr.Dataset:
    """Coefficients of a ship by strip theory, on 21 sections cut from her panels unless others are given.

    Arguments as in `HydroDatabase.compute`; the Dataset is that of `solve_strips`. Raises PanelsimError for
    sections of another ship, sections that cannot be cut, and Lewis forms that do not fit.
    """
    if sections is None:
        sections = sections_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, _STRIPS)
    else:
        require_sections_of(ship, sections)
    highest = highest_strip_frequency(sections, ship.gravity, section_form)
    return solve_strips(
        sections,
        water_density=ship.water_density,
        gravity=ship.gravity,
        frequencies=strip_frequency_grid(ship.length, highest),
        section_form=section_form,
        progress=progress,
    )


def require_sections_of(ship: Ship, sections: HullSections) -> None:
    """Raise PanelsimError, naming what differs, unless sections in ship axes are those of the ship at rest.

    Compared are the waterline, the ends and the draft of the wet hull, the displaced volume, and the areas at
    the stations, which tell bow from stern.
    """
    if not isinstance(sections, HullSections):
        raise PanelsimError(
            "The sections are of another kind",
            got=repr(sections)[:60],
            allowed="HullSections in ship axes, as sections_from_offsets gives them",
        )
    aft, fore = wet_ends(ship.vertices, ship.mesh.panels, ship.waterline)
    length = fore - aft
    draft = ship.waterline - float(ship.vertices[:, 2].min())
    volume = ship.hydrostatics.displaced_volume
    areas = np.array([section.area for section in sections.sections])
    inner = np.flatnonzero(np.abs(sections.x - 0.5 * (aft + fore)) < _AMIDSHIPS * length)
    own = [
        section_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, x).area for x in sections.x[inner]
    ]
    elsewhere = float(sections.strip_length[inner] @ np.abs(areas[inner] - own))
    waterlines = np.array([section.waterline for section in sections.sections])
    lowest = max(section.draft for section in sections.sections)
    compared = (
        ("waterline", float(waterlines[0]), ship.waterline, _SAME_WATERLINE * draft, "m"),
        ("aft end", sections.aft_end, aft, _SAME_ENDS * length, "m"),
        ("fore end", sections.fore_end, fore, _SAME_ENDS * length, "m"),
        ("draft", lowest, draft, _SAME_DRAFT * draft, "m"),
        ("volume", float(sections.strip_length @ areas), volume, _SAME_VOLUME * volume, "m3"),
    )
    apart = [
        f"{name} {there:.4g} {unit} there, {here:.4g} {unit} here"
        for name, there, here, allowed, unit in compared
        if not abs(there - here) <= allowed
    ]
    if elsewhere > _SAME_AREAS * volume:
        apart.append(f"section areas by {100 * elsewhere / volume:.2g} % of the volume in all")
    if np.ptp(waterlines) > 0.0:
        apart.append("not all at one waterline")
    if apart:
        raise PanelsimError(
            f"The sections are not those of {ship.name}",
            got="; ".join(apart),
            remedy="turn offsets into ship axes, ship.to_ship_axes, and give ship.waterline",
        )
