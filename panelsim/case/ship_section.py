"""From the table [ship] of a case to a ship afloat."""

from pathlib import Path

import numpy as np

from panelsim.case.schema import ShipSection
from panelsim.errors import PanelsimError
from panelsim.hull.form import bundled_hull_names, hull_files, load_hull
from panelsim.hull.readers import SUFFIXES, read_mesh
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

LOADING_OF_A_MESH = (
    "draft",
    "center_of_gravity_height",
    *("gyradius_roll", "gyradius_pitch", "gyradius_yaw"),
    "water_density",
)


def is_mesh_file(name: str | Path) -> bool:
    """Whether the name is that of a mesh file, by its suffix."""
    return Path(name).suffix.lower() in SUFFIXES


def beside(folder: Path, name: str) -> str:
    """A path relative to the case file where there is one, else the name as it is."""
    path = folder / name
    return str(path) if path.exists() else name


def ship_files(section: ShipSection, folder: Path) -> tuple[Path, ...]:
    """The files that `build_ship` reads: a mesh, or those of a hull folder; of a bundled hull none."""
    # A bundled name means that hull, even with a folder of this name beside the case file.
    if section.hull in bundled_hull_names():
        return ()
    path = Path(beside(folder, section.hull))
    if is_mesh_file(section.hull):
        return (path,) if path.is_file() else ()
    return hull_files(path) if path.is_dir() else ()


def build_ship(section: ShipSection, folder: Path) -> Ship:
    """The ship of a case file that lies in `folder`: a hull form's, or one of the user's own mesh.

    Raises PanelsimError for a hull or mesh that cannot be used and for a loading that cannot float.
    """
    if is_mesh_file(section.hull):
        return _ship_of_mesh(section, folder)
    if section.mesh is not None:
        raise PanelsimError(
            "[ship.mesh] is for a mesh file",
            got=f'hull = "{section.hull}"',
            allowed=f"a file ending in {', '.join(SUFFIXES)}",
        )
    # As in `ship_files`: a bundled name comes before a folder of this name.
    form = load_hull(section.hull if section.hull in bundled_hull_names() else beside(folder, section.hull))
    height = section.center_of_gravity_height
    if height is None:
        height = form.loading.center_of_gravity_height
    return load_ship(
        form,
        section.panel_area,
        draft=section.draft,
        trim_by_stern=section.trim_by_stern,
        mass=section.mass,
        center_of_gravity=(section.center_of_gravity_x, 0.0, height),
        gyradii=(
            section.gyradius_roll or form.loading.gyradius_roll,
            section.gyradius_pitch or form.loading.gyradius_pitch,
            section.gyradius_yaw or form.loading.gyradius_yaw,
        ),
        water_density=section.water_density,
        gravity=section.gravity,
    )


def _ship_of_mesh(section: ShipSection, folder: Path) -> Ship:
    """A ship of the user's own mesh: nothing is known of it but what the case says."""
    if section.mesh is None:
        raise PanelsimError(
            "A mesh file needs its unit and axes",
            got=f'hull = "{section.hull}" without [ship.mesh]',
            remedy='add [ship.mesh] with length_unit = "m", up = "z", forward = "x"',
        )
    if section.panel_area is not None:
        raise PanelsimError(
            "A mesh file has its own panels", got="ship.panel_area", remedy="leave panel_area out"
        )
    values = section.model_dump()
    missing = [name for name in LOADING_OF_A_MESH if values[name] is None]
    if missing:
        raise PanelsimError(
            "The loading of a mesh file is not known",
            got=f"[ship] without {', '.join(missing)}",
            remedy="give them in [ship]: m, m and kg/m3",
        )
    mesh = read_mesh(beside(folder, section.hull), **section.mesh.model_dump())
    length, _, depth = np.ptp(mesh.vertices, axis=0)
    keel = float(mesh.vertices[:, 2].min())
    # A dome may reach below the baseline; a whole hull below it was drawn from its waterline.
    if not -0.5 * values["draft"] <= keel <= 1e-3 * depth:
        raise PanelsimError(
            "The mesh does not stand on the baseline, z = 0",
            got=f"its lowest point at z = {keel:.4g} m",
            remedy="set ship.mesh.origin to the point on the keel at midships, in file units",
        )
    return Ship(
        mesh,
        draft=values["draft"],
        trim=-float(np.arctan((section.trim_by_stern or 0.0) / length)),
        center_of_gravity=(section.center_of_gravity_x, 0.0, values["center_of_gravity_height"]),
        gyradii=(values["gyradius_roll"], values["gyradius_pitch"], values["gyradius_yaw"]),
        mass=section.mass,
        water_density=values["water_density"],
        gravity=section.gravity,
        name=Path(section.hull).stem,
    )
