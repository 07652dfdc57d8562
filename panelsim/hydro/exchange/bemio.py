"""HDF5 files of BEMIO, the front of WEC-Sim to WAMIT, Nemoh, AQWA and Capytaine.

As WEC-Sim's writeBEMIOH5 and normalizeBEM leave them: exp(+iωt), directions of travel from x towards y,
arrays with motions first and frequency last; with `scaled` 0 divided as WAMIT has it, A/ρ, B/(ρω), X/(ρg),
C/(ρg), without a length. Moments are about `cg` of the body.
"""

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import as_path
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.exchange.assemble import database_of
from panelsim.hydro.exchange.foreign import ForeignCoefficients
from panelsim.hydro.exchange.frame import Frame
from panelsim.hydro.exchange.hdf5 import Hdf5Numbers, opened
from panelsim.ship.ship import Ship

_RADIANS = {"deg": np.pi / 180.0, "degree": np.pi / 180.0, "degrees": np.pi / 180.0, "rad": 1.0}


def read_bemio(
    path: str | Path,
    ship: Ship,
    *,
    forward: str,
    center_of_gravity: ArrayLike | None = None,
    moments_about: ArrayLike | None = None,
    rest: str = "file",
) -> HydroDatabase:
    """The database of a ship from an HDF5 file of BEMIO with one body.

    `forward` "+x" or "-x": the way of the bow. `center_of_gravity` of the ship and `moments_about` (x, y, z)
    [m] in the axes of the file, z from calm water, are `cg` of the body if left out. `rest` as in
    `database_of`; such files seldom hold frequency 0. Raises PanelsimError for a file that is not whole, of
    more bodies, or of another ship.
    """
    with opened(as_path(path), "BEMIO") as file:
        if "body2" in file:
            raise PanelsimError("The file holds more than one body", got=path, allowed="one")
        omega = file.vector("simulation_parameters/w")
        order = np.argsort(omega)
        omega = omega[order]
        scaled = _scaled(file)
        density, gravity = (1.0, 1.0) if scaled else (ship.water_density, ship.gravity)
        about = file.vector("body1/properties/cg")
        coefficients, force = "body1/hydro_coeffs/", density * gravity
        damping = _matrices(file, coefficients + "radiation_damping/all", order) * density
        parts = _parts(file, coefficients + "excitation", order, force)
        return database_of(
            ForeignCoefficients(
                source=f"BEMIO, {path}",
                frame=Frame.given(
                    forward=forward,
                    center_of_gravity=about if center_of_gravity is None else center_of_gravity,
                    moments_about=about if moments_about is None else moments_about,
                ),
                frequency=omega,
                added_mass=_matrices(file, coefficients + "added_mass/all", order) * density,
                radiation_damping=damping if scaled else damping * omega[:, None, None],
                wave_frequency=omega,
                wave_direction=_directions(file),
                added_mass_infinite=file.array(coefficients + "added_mass/inf_freq") * density,
                stiffness=file.array(coefficients + "linear_restoring_stiffness") * force,
                displaced_volume=file.number("body1/properties/disp_vol"),
                water_density=file.number("simulation_parameters/rho") if scaled else None,
                gravity=file.number("simulation_parameters/g"),
                water_depth=_depth(file),
                excitation=_loads(file, coefficients + "excitation", order, force),
                diffraction=parts.get("diffraction"),
                froude_krylov=parts.get("froude_krylov"),
            ),
            ship,
            rest=rest,
        )


def _scaled(file: Hdf5Numbers) -> bool:
    """True where the file says that its numbers have dimensions."""
    name = "simulation_parameters/scaled"
    if name not in file:
        raise PanelsimError(
            "The file does not say whether its numbers are divided by density and gravity",
            got=f"{file.path} without {name}",
            allowed="scaled: 0 divided, 1 not",
            remedy="write it with BEMIO of WEC-Sim, or add the value",
        )
    return bool(file.number(name))


def _matrices(file: Hdf5Numbers, name: str, order: np.ndarray) -> FloatArray:
    """(6, 6, F) as (F, 6, 6), by ascending frequency."""
    return np.moveaxis(_with_frequencies(file, name, len(order)), -1, 0)[order]


def _loads(file: Hdf5Numbers, name: str, order: np.ndarray, force: float) -> ComplexArray:
    """Real and imaginary parts (6, H, F) as complex loads (F, H, 6)."""
    real, imaginary = (_with_frequencies(file, f"{name}/{part}", len(order)) for part in ("re", "im"))
    return force * np.moveaxis(real + 1j * imaginary, (2, 1, 0), (0, 1, 2))[order]


def _parts(file: Hdf5Numbers, name: str, order: np.ndarray, force: float) -> dict[str, ComplexArray]:
    """Scattering and Froude-Krylov loads, where there are any: else they are NaN throughout."""
    parts = {
        ours: _loads(file, f"{name}/{theirs}", order, force)
        for ours, theirs in (("diffraction", "scattering"), ("froude_krylov", "froude-krylov"))
        if f"{name}/{theirs}/re" in file
    }
    return {ours: load for ours, load in parts.items() if not np.isnan(load).all()}


def _with_frequencies(file: Hdf5Numbers, name: str, count: int) -> FloatArray:
    values = file.array(name)
    if values.ndim != 3 or values.shape[0] != 6 or values.shape[-1] != count:
        raise PanelsimError(
            f"{name} is not whole", got=f"{file.path}: {values.shape}", allowed=f"(6, ..., {count})"
        )
    return values


def _directions(file: Hdf5Numbers) -> FloatArray:
    name = "simulation_parameters/wave_dir"
    unit = file.attribute(name, "units")
    if unit not in _RADIANS:
        raise PanelsimError(
            "The wave directions have no unit", got=f"{file.path}: {unit!r}", allowed=" | ".join(_RADIANS)
        )
    return file.vector(name) * _RADIANS[unit]


def _depth(file: Hdf5Numbers) -> float:
    name = "simulation_parameters/water_depth"
    text = file.text(name)
    return file.number(name) if text is None else np.inf if text == "infinite" else np.nan
