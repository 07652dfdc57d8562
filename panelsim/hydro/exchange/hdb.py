"""HDB5: the HDF5 databases of FRyDoM, versions 2 and 3.

Loads belong to exp(i(k(x cos θ + y sin θ) - ωt)) (FRyDoM theory manual, wave excitation): they are conjugated
here. Directions of travel in degrees, SI units, moments about the point of the rotation modes (version 2) or
the centre of gravity in the axes of the file (version 3, `BodyPosition`). Version 2 has even grids by their
ends.
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

_BODY = "Bodies/Body_0"
_RADIATION = _BODY + "/Radiation/BodyMotion_0"
_SAME_ANGLE = 1e-3  # degrees


def read_hdb(
    path: str | Path,
    ship: Ship,
    *,
    forward: str,
    center_of_gravity: ArrayLike,
    moments_about: ArrayLike | None = None,
    rest: str = "file",
) -> HydroDatabase:
    """The database of a ship from an HDB5 file with one body.

    `forward` "+x" or "-x": the way of the bow. `center_of_gravity` of the ship and `moments_about` (x, y, z)
    [m] in the axes of the file, z from calm water; the second is read if left out. `rest` as in
    `database_of`. Raises PanelsimError for a file that is not whole, of more bodies or motions, or of another
    ship.
    """
    with opened(as_path(path), "HDB5") as file:
        if file.number("NbBody") != 1:
            raise PanelsimError(
                "The file holds more than one body", got=f"{path}: {file.number('NbBody'):g}", allowed="one"
            )
        version = file.number("Version") if "Version" in file else 1.0
        frequency, angles = _grids(file, version)
        zero = _RADIATION + "/ZeroFreqAddedMass"
        stiffness = _BODY + "/Hydrostatic/StiffnessMatrix"
        depth = file.number("WaterDepth")
        return database_of(
            ForeignCoefficients(
                source=f"HDB5, {path}",
                frame=Frame.given(
                    forward=forward,
                    center_of_gravity=center_of_gravity,
                    moments_about=_reference(file, version) if moments_about is None else moments_about,
                ),
                frequency=frequency,
                added_mass=_matrices(file, "AddedMass", len(frequency)),
                radiation_damping=_matrices(file, "RadiationDamping", len(frequency)),
                wave_frequency=frequency,
                wave_direction=np.radians(angles),
                diffraction=_loads(file, "Diffraction", angles, len(frequency)),
                froude_krylov=_loads(file, "FroudeKrylov", angles, len(frequency)),
                added_mass_zero=file.array(zero) if zero in file else None,
                added_mass_infinite=file.array(_RADIATION + "/InfiniteAddedMass"),
                stiffness=file.array(stiffness) if stiffness in file else None,
                water_density=file.number("WaterDensity"),
                gravity=file.number("GravityAcc"),
                water_depth=depth if depth > 0.0 else np.inf,
            ),
            ship,
            rest=rest,
        )


def _grids(file: Hdf5Numbers, version: float) -> tuple[FloatArray, FloatArray]:
    """Frequencies [rad/s] and directions [degrees]."""
    if version >= 3.0:
        return file.vector("Discretizations/Frequency"), file.vector("Discretizations/WaveDirection")
    frequency, angle = "Discretizations/Frequency/", "Discretizations/WaveDirections/"
    return (
        _even(file, frequency + "MinFrequency", frequency + "MaxFrequency", frequency + "NbFrequencies"),
        _even(file, angle + "MinAngle", angle + "MaxAngle", angle + "NbWaveDirections"),
    )


def _even(file: Hdf5Numbers, lowest: str, highest: str, count: str) -> FloatArray:
    return np.linspace(file.number(lowest), file.number(highest), int(file.number(count)))


def _reference(file: Hdf5Numbers, version: float) -> FloatArray | None:
    """Point of the moments, None where the file has none or several."""
    if version >= 3.0:
        return file.vector(_BODY + "/BodyPosition")
    names = [f"{_BODY}/Modes/{kind}Modes/Mode_{i}/Point" for kind in ("Force", "Motion") for i in (3, 4, 5)]
    points = [file.vector(name) for name in names if name in file]
    if len(points) < len(names) or any(not np.allclose(point, points[0]) for point in points):
        return None
    return points[0]


def _matrices(file: Hdf5Numbers, name: str, count: int) -> FloatArray:
    """One table (6, F) for each motion, its rows the forces, as (F, 6, 6)."""
    tables = [_table(file, f"{_RADIATION}/{name}/DOF_{motion}", count) for motion in range(6)]
    return np.stack(tables, axis=-1).transpose(1, 0, 2)


def _loads(file: Hdf5Numbers, name: str, angles: FloatArray, count: int) -> ComplexArray:
    """Conjugated loads (F, H, 6)."""
    loads = []
    for i, angle in enumerate(angles):
        place = f"{_BODY}/Excitation/{name}/Angle_{i}"
        stored = file.number(place + "/Angle")
        if abs(stored - angle) > _SAME_ANGLE:
            raise PanelsimError(
                "The wave directions of the file do not agree",
                got=f"{file.path}: {stored:g}° at {place}",
                allowed=f"{angle:g}° by the list of directions",
            )
        loads.append(
            _table(file, place + "/RealCoeffs", count) - 1j * _table(file, place + "/ImagCoeffs", count)
        )
    return np.array(loads).transpose(2, 0, 1)


def _table(file: Hdf5Numbers, name: str, count: int) -> FloatArray:
    values = file.array(name)
    if values.shape != (6, count):
        raise PanelsimError(
            f"{name} is not whole",
            got=f"{file.path}: {values.shape}",
            allowed=f"(6, {count}): six motions, frequencies",
        )
    return values
