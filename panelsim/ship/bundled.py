"""Ships by name: a bundled or a user's hull with the loading of its particulars."""

import math
from pathlib import Path

from panelsim.conventions import STANDARD_GRAVITY
from panelsim.hull.form import HullForm, load_hull
from panelsim.ship.ship import Ship, panel_to_waterline

# A mesh like the medium one of TM 2003-190 Table 3 has some 800 panels below the waterline.
WET_PANELS_BY_DEFAULT = 800
# Each panelling is a few hundred times closer to the waterline at rest than the one before.
MOST_PANELLINGS = 8
SETTLED = 1e-10  # of the length


def default_panel_area(form: HullForm) -> float:
    """Nominal panel area [m²] for a mesh like the report's medium one, from Mumford's wetted surface."""
    wetted_surface = 1.7 * form.length_pp * form.draft + 0.5 * form.length_pp * form.beam
    return wetted_surface / WET_PANELS_BY_DEFAULT


def load_ship(
    name_or_path: str | Path | HullForm,
    panel_area: float | None = None,
    *,
    draft: float | None = None,
    trim_by_stern: float | None = None,
    mass: float | None = None,
    center_of_gravity: tuple[float | None, float, float] | None = None,
    gyradii: tuple[float, float, float] | None = None,
    water_density: float | None = None,
    gravity: float = STANDARD_GRAVITY,
) -> Ship:
    """Load a ship: `load_ship("halifax", panel_area=2.5)` is the ship of TM 2003-190 Table 2.

    What is not given comes from the hull's particulars. `panel_area` [m²] is nominal; lengths in m,
    mass in kg, `center_of_gravity` in hull axes with x None to float at the stated trim. With a
    mass and an x the ship finds its own draft and trim, and is panelled to that waterline.
    """
    form = name_or_path if isinstance(name_or_path, HullForm) else load_hull(name_or_path)
    loading = form.loading
    area = default_panel_area(form) if panel_area is None else panel_area
    draft = form.draft if draft is None else draft
    stern = form.trim_by_stern if trim_by_stern is None else trim_by_stern
    cg = (None, 0.0, loading.center_of_gravity_height) if center_of_gravity is None else center_of_gravity
    gyradii = (
        (loading.gyradius_roll, loading.gyradius_pitch, loading.gyradius_yaw) if gyradii is None else gyradii
    )
    density = loading.water_density if water_density is None else water_density

    def afloat(draft: float, stern: float) -> Ship:
        return Ship(
            panel_to_waterline(form, area, draft, stern),
            draft=draft,
            trim=-math.atan(stern / form.length_pp),
            center_of_gravity=cg,
            gyradii=gyradii,
            mass=mass,
            water_density=density,
            gravity=gravity,
            name=form.name,
            form=form,
        )

    ship = afloat(draft, stern)
    # A mass moves the waterline off the panel edges: panel the hull again until it rests on them.
    for _ in range(MOST_PANELLINGS if mass is not None else 0):
        moved = abs(ship.draft - draft) + abs(ship.trim_by_stern - stern)
        if moved < SETTLED * form.length_pp:
            break
        draft, stern = ship.draft, ship.trim_by_stern
        ship = afloat(draft, stern)
    return ship
