"""What several commands make of their arguments: the ship of a name, a file that may be written."""

from pathlib import Path

from panelsim.case import Case
from panelsim.case.ship_section import is_mesh_file
from panelsim.errors import PanelsimError
from panelsim.hull.particulars import FILE_NAME
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship


def ship_of(what: str, panel_area: float | None = None) -> Ship:
    """The ship of a bundled hull, a hull folder or a case file; panel_area [m2]."""
    path = Path(what)
    if is_mesh_file(path):
        raise PanelsimError(
            "A mesh file does not say how the ship floats",
            got=path,
            allowed="a bundled hull, a hull folder or a case file",
            remedy="write a case file with [ship.mesh] and a loading; `panelsim check` checks the mesh alone",
        )
    if path.name == FILE_NAME:
        return load_ship(path.parent, panel_area)
    if path.suffix == ".toml":
        return Case.load(path, [] if panel_area is None else [f"ship.panel_area={panel_area!r}"]).ship
    return load_ship(what, panel_area)


def refuse_existing(path: Path, force: bool) -> None:
    """Raise PanelsimError for a file that is there and may not be replaced, and for a folder."""
    if path.is_dir():
        raise PanelsimError("The output is a folder", got=path, allowed="the name of a file")
    if path.exists() and not force:
        raise PanelsimError("The file exists already", got=path, remedy="use --force to replace it")


def require_suffix(path: Path, suffix: str) -> None:
    """Raise PanelsimError for a file of another kind, by its suffix."""
    if path.suffix != suffix:
        raise PanelsimError("The output is of another kind", got=path, allowed=f"a file name in {suffix}")
