"""Datasets of Capytaine: xarray or NetCDF, one floating body, zero speed.

Capytaine (Ancellin and Dias 2019) writes exp(-iωt): its complex loads are conjugated here. A wave direction
is that of travel in radians, from x towards y: exp(ik(x cos θ + y sin θ)). Moments are about
`rotation_center`.
"""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from panelsim.conventions import DOF_NAMES, ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import as_path
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.exchange.assemble import database_of
from panelsim.hydro.exchange.foreign import ForeignCoefficients
from panelsim.hydro.exchange.frame import Frame
from panelsim.ship.ship import Ship

_NEEDED = (
    "added_mass",
    "radiation_damping",
    "diffraction_force",
    "omega",
    "wave_direction",
    "rho",
    "g",
    "water_depth",
)
_DOF_DIMS = ("influenced_dof", "radiating_dof")


def read_capytaine(
    source: str | Path | xr.Dataset,
    ship: Ship,
    *,
    forward: str,
    center_of_gravity: ArrayLike | None = None,
    moments_about: ArrayLike | None = None,
    rest: str = "file",
) -> HydroDatabase:
    """The database of a ship from a dataset of Capytaine, or the NetCDF file of one.

    `forward` "+x" or "-x": the way of the bow. `center_of_gravity` and `moments_about` (x, y, z) [m] in the
    axes of its mesh, z from calm water; left out, they are `center_of_mass` and `rotation_center` of the
    dataset. `rest` as in `database_of`. Raises PanelsimError for a dataset that is not whole, not at zero
    speed, or of another ship.
    """
    name = "the dataset" if isinstance(source, xr.Dataset) else str(source)
    dataset = source if isinstance(source, xr.Dataset) else _opened(as_path(source))
    _require_layout(name, dataset)
    frame = Frame.given(
        forward=forward,
        center_of_gravity=_point(dataset, "center_of_mass")
        if center_of_gravity is None
        else center_of_gravity,
        moments_about=_point(dataset, "rotation_center") if moments_about is None else moments_about,
    )
    along = _frequency_dim(dataset)
    matrices = (along, *_DOF_DIMS)
    omega = np.atleast_1d(np.asarray(dataset["omega"].values, dtype=float))
    order = np.argsort(omega)
    omega = omega[order]
    added_mass = _values(name, dataset, "added_mass", matrices)[order].real
    damping = _values(name, dataset, "radiation_damping", matrices)[order].real
    between = (omega > 0.0) & np.isfinite(omega)
    loads = {
        theirs: _values(name, dataset, theirs, (along, "wave_direction", "influenced_dof"))[order].conj()
        for theirs in ("diffraction_force", "Froude_Krylov_force")
        if theirs in dataset
    }
    # Frequencies at which only radiation was solved hold NaN and nothing else.
    waves = between & ~np.isnan(loads["diffraction_force"]).all(axis=(1, 2))
    incident = loads.get("Froude_Krylov_force")
    density = _scalar(dataset, "rho")
    return database_of(
        ForeignCoefficients(
            source=f"Capytaine {dataset.attrs.get('capytaine_version', '')}, {name}",
            frame=frame,
            frequency=omega[between],
            added_mass=added_mass[between],
            radiation_damping=damping[between],
            wave_frequency=omega[waves],
            wave_direction=np.atleast_1d(np.asarray(dataset["wave_direction"].values, dtype=float)),
            added_mass_zero=_only(added_mass[omega == 0.0]),
            added_mass_infinite=_only(added_mass[omega == np.inf]),
            stiffness=_stiffness(name, dataset),
            displaced_volume=_scalar(dataset, "disp_mass") / density if "disp_mass" in dataset else None,
            water_density=density,
            gravity=_scalar(dataset, "g"),
            water_depth=_scalar(dataset, "water_depth"),
            diffraction=loads["diffraction_force"][waves],
            froude_krylov=None if incident is None else incident[waves],
        ),
        ship,
        rest=rest,
    )


def _opened(path: Path) -> xr.Dataset:
    try:
        with xr.open_dataset(path) as stored:
            return stored.load()
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        raise PanelsimError(
            "The Capytaine dataset cannot be read: it is missing, damaged or no NetCDF",
            # xarray's ValueError lists what other files it could read.
            got=path if isinstance(error, ValueError) else f"{path} ({str(error).splitlines()[0][:100]})",
            remedy="write it with capytaine.export_dataset",
        ) from error


def _require_layout(name: str, dataset: xr.Dataset) -> None:
    missing = [each for each in _NEEDED if each not in dataset.variables]
    if missing:
        raise PanelsimError(
            "The dataset is not whole, or none of Capytaine",
            got=f"{name} without {', '.join(missing)}",
            allowed="radiation and diffraction problems, as fill_dataset gives them",
        )
    for each, wanted in (("forward_speed", 0.0), ("free_surface", 0.0)):
        if each in dataset.variables and _scalar(dataset, each) != wanted:
            raise PanelsimError(
                f"The dataset was computed with another {each}",
                got=f"{name}: {_scalar(dataset, each):g}",
                allowed=f"{wanted:g}",
                remedy="compute it at zero speed: speed is added here",
            )


def _frequency_dim(dataset: xr.Dataset) -> str:
    """The dimension of frequency: omega, or period, wavenumber, ... with omega beside it."""
    dims = dataset["omega"].dims
    return str(dims[0]) if dims else "omega"


def _values(name: str, dataset: xr.Dataset, variable: str, dims: tuple[str, ...]) -> ComplexArray:
    """A variable with these dimensions, the motions in our order, complex."""
    data: Any = dataset[variable]
    if "complex" in data.dims:
        data = data.sel(complex="re", drop=True) + 1j * data.sel(complex="im", drop=True)
    for dim in (str(d) for d in data.dims if d not in dims):
        if data.sizes[dim] != 1:
            raise PanelsimError(
                f"The dataset holds more than one {dim}",
                got=f"{name}: {data.sizes[dim]}",
                remedy=f"choose one, for example dataset.isel({dim}=0)",
            )
        data = data.isel({dim: 0}, drop=True)
    for dim in (dim for dim in dims if dim not in data.dims):
        data = data.expand_dims(dim)
    for dim in (dim for dim in dims if dim in _DOF_DIMS):
        data = data.isel({dim: _six_motions(name, [str(v) for v in dataset[dim].values])})
    values: ComplexArray = data.transpose(*dims).values.astype(np.complex128)
    return values


def _six_motions(name: str, given: list[str]) -> list[int]:
    lower = [each.lower() for each in given]
    if sorted(lower) != sorted(DOF_NAMES):
        raise PanelsimError(
            "The motions of the dataset are not the six of one rigid body",
            got=f"{name}: {', '.join(given)}",
            allowed=", ".join(DOF_NAMES),
        )
    return [lower.index(dof) for dof in DOF_NAMES]


def _point(dataset: xr.Dataset, variable: str) -> FloatArray | None:
    return (
        np.asarray(dataset[variable].values, dtype=float).ravel() if variable in dataset.variables else None
    )


def _scalar(dataset: xr.Dataset, variable: str) -> float:
    values = np.unique(np.asarray(dataset[variable].values, dtype=float))
    if values.size != 1:
        raise PanelsimError(f"The dataset holds more than one {variable}", got=values, remedy="choose one")
    return float(values[0])


def _only(matrices: FloatArray) -> FloatArray | None:
    return matrices[0] if len(matrices) else None


def _stiffness(name: str, dataset: xr.Dataset) -> FloatArray | None:
    if "hydrostatic_stiffness" not in dataset:
        return None
    return _values(name, dataset, "hydrostatic_stiffness", _DOF_DIMS).real
