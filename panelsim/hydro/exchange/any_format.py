"""A database of any program: the format told by the file itself, what the file leaves open asked for."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import h5py
from numpy.typing import ArrayLike

from panelsim.errors import PanelsimError
from panelsim.files import as_path
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.exchange.bemio import read_bemio
from panelsim.hydro.exchange.capytaine_dataset import read_capytaine
from panelsim.hydro.exchange.hdb import read_hdb
from panelsim.hydro.exchange.hdf5 import opened
from panelsim.hydro.exchange.wamit import WAMIT_SUFFIXES, read_wamit
from panelsim.ship.ship import Ship, require_ship

FORMATS = (
    "a dataset of Capytaine (.nc), files or a folder of WAMIT (.1, .3, .3sc), HDF5 of BEMIO or HDB5 (.h5)"
)
MEANINGS = {
    "forward": '"+x" or "-x", the way of the bow',
    "center_of_gravity": "x, y, z [m] of the ship in the axes of the file, z from calm water",
    "moments_about": "x, y, z [m], the point of moments and rotations, in the same axes",
    "length_scale": "ULEN [m]",
    "water_depth": "[m], inf for deep",
    "first_column": '"period" or "frequency"',
}


@dataclass(frozen=True)
class _Format:
    """A reader, what it must be told, and what it may be told."""

    name: str
    reader: Callable[..., HydroDatabase]
    needed: tuple[str, ...]
    optional: tuple[str, ...] = ()


_CAPYTAINE = _Format("Capytaine", read_capytaine, ("forward",), ("center_of_gravity", "moments_about"))
_BEMIO = _Format("BEMIO", read_bemio, ("forward",), ("center_of_gravity", "moments_about"))
_HDB = _Format("HDB5", read_hdb, ("forward", "center_of_gravity"), ("moments_about",))
_WAMIT = _Format(
    "WAMIT",
    read_wamit,
    ("forward", "center_of_gravity", "moments_about", "length_scale", "water_depth"),
    ("first_column",),
)
# What an HDF5 file of each holds at its root; NetCDF-4 is HDF5.
_SIGNS = {"simulation_parameters": _BEMIO, "Discretizations": _HDB, "added_mass": _CAPYTAINE}


def read_database(
    path: str | Path,
    ship: Ship,
    *,
    forward: str | None = None,
    center_of_gravity: ArrayLike | None = None,
    moments_about: ArrayLike | None = None,
    length_scale: float | None = None,
    water_depth: float | None = None,
    first_column: str | None = None,
    rest: str = "file",
) -> HydroDatabase:
    """The database of a ship from the file or folder of another program, whichever it is.

    Arguments as for `read_capytaine`, `read_wamit`, `read_bemio` and `read_hdb`. Raises PanelsimError for a
    file that none of them reads, for what the file does not say and is not given, for what has no meaning
    with it, and as the reader does.
    """
    path = as_path(path)
    require_ship(ship)
    kind, place = _format_of(path)
    given = {
        "forward": forward,
        "center_of_gravity": center_of_gravity,
        "moments_about": moments_about,
        "length_scale": length_scale,
        "water_depth": water_depth,
        "first_column": first_column,
    }
    given = {name: value for name, value in given.items() if value is not None}
    missing = [name for name in kind.needed if name not in given]
    if missing:
        raise PanelsimError(
            f"A file of {kind.name} does not say {', '.join(missing)}",
            got=path,
            remedy="give " + "; ".join(f"{name}: {MEANINGS[name]}" for name in missing),
        )
    strange = [name for name in given if name not in (*kind.needed, *kind.optional)]
    if strange:
        raise PanelsimError(
            f"A file of {kind.name} has no use for {', '.join(strange)}", got=path, remedy="leave it out"
        )
    return kind.reader(place, ship, rest=rest, **given)


def _format_of(path: Path) -> tuple[_Format, Path]:
    """The format, and the path that its reader takes."""
    if path.is_dir():
        return _WAMIT, _only_wamit_file(path)
    if path.suffix in WAMIT_SUFFIXES:
        return _WAMIT, path
    if not path.is_file():
        raise PanelsimError("There is no such file or folder", got=path, allowed=FORMATS)
    if not h5py.is_hdf5(path):
        if path.suffix == ".nc":  # NetCDF-3, or damaged: the reader says so
            return _CAPYTAINE, path
        raise _unknown(path)
    with opened(path, "coefficient") as file:
        if "potential_infinite" in file or "diffraction_real" in file:
            raise PanelsimError(
                "This is a database of panelsim already",
                got=path,
                remedy=f'name it in the case: [hydrodynamics] file = "{path.name}"',
            )
        for sign, kind in _SIGNS.items():
            if sign in file:
                return kind, path
    raise _unknown(path)


def _only_wamit_file(folder: Path) -> Path:
    found = sorted(folder.glob("*.1"))
    if len(found) != 1:
        raise PanelsimError(
            "The folder does not hold the files of one WAMIT run",
            got=f"{folder}: {', '.join(file.name for file in found) or 'no file ending in .1'}",
            allowed="one file ending in .1, and its .3 or .3sc beside it",
            remedy="name the file itself",
        )
    return found[0]


def _unknown(path: Path) -> PanelsimError:
    return PanelsimError("This is no database of a program that panelsim reads", got=path, allowed=FORMATS)
