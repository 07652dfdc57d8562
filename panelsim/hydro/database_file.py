"""The file of a hydrodynamic database: its format, and what it must hold."""

from pathlib import Path

import xarray as xr

from panelsim.errors import PanelsimError

FORMAT = "panelsim hydrodynamic database 1"
COEFFICIENTS = {"added_mass", "radiation_damping", "added_mass_infinite"}
POTENTIALS = {"potential_real", "potential_imag", "potential_infinite", "panel_corners"}
TABLES = {"diffraction_real", "diffraction_imag"}


def read_database_file(path: Path) -> xr.Dataset:
    """The dataset of a NetCDF-4 file; PanelsimError where it is missing, damaged, foreign or not whole."""
    if not path.is_file():
        raise PanelsimError(
            "There is no hydrodynamic database here",
            got=path,
            remedy="compute one with `panelsim hydro NAME -o FILE.nc`",
        )
    try:
        with xr.open_dataset(path, engine="h5netcdf") as stored:
            dataset = stored.load()
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        raise PanelsimError(
            "This hydrodynamic database cannot be read: it is damaged, cut short or not NetCDF-4",
            got=f"{path} ({error})",
            remedy="compute it again with `panelsim hydro NAME -o FILE.nc`",
        ) from error
    _require_whole(path, dataset)
    return dataset


def _require_whole(path: Path, dataset: xr.Dataset) -> None:
    """Raise PanelsimError for a dataset of another format, or one that lacks variables."""
    remedy = "compute one with `panelsim hydro NAME -o FILE.nc`"
    if dataset.attrs.get("format") != FORMAT:
        raise PanelsimError(
            "This file is no hydrodynamic database of panelsim",
            got=f"{path}, format {dataset.attrs.get('format')!r}",
            allowed=repr(FORMAT),
            remedy=remedy,
        )
    # Potentials or tables, whichever it is nearer to.
    lacking = [COEFFICIENTS.union(waves).difference(dataset.data_vars) for waves in (POTENTIALS, TABLES)]
    missing = min(lacking, key=len)
    if missing:
        raise PanelsimError(
            "This hydrodynamic database is not whole",
            got=f"{path} without {', '.join(sorted(missing))}",
            remedy=remedy,
        )
