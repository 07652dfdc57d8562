"""From the numbers of another program to a hydrodynamic database of the ship."""

import numpy as np
import xarray as xr

from panelsim.conventions import DOF_NAMES, ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.bem import is_mirror_symmetric
from panelsim.hydro.conditioning import damping_roughness, require_physical, symmetrise
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.exchange.belonging import (
    require_belonging,
    require_same_incident,
    require_same_long_waves,
)
from panelsim.hydro.exchange.foreign import ForeignCoefficients, require_sound
from panelsim.hydro.exchange.incident import froude_krylov
from panelsim.hydro.memory import memory_functions
from panelsim.seaway.dispersion import wavenumber
from panelsim.ship.ship import Ship

REST = ("file", "lowest")
# A and B are symmetric about any point, and uncoupled across the centreplane about any point on it.
_LARGEST_ASYMMETRY = 0.05
_SAME_HEADING = 1e-6  # rad
_SAME_LOAD = 0.01  # of the largest, where a file has one heading twice, as -180° and 180°
_MIRROR = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])


def database_of(foreign: ForeignCoefficients, ship: Ship, *, rest: str = "file") -> HydroDatabase:
    """The database of a ship from coefficients of another program.

    `rest` says where the added mass at frequency 0 is from: "file", or "lowest", that of the lowest frequency
    where the file has none. Without the limit of infinite frequency it is fitted to the damping (Ogilvie
    1964). A sum of wave loads has the Froude-Krylov load of our hull taken off. A symmetric hull has the
    headings of its other side added. `notes` of the database name all of these.

    Raises PanelsimError for numbers that are not whole or not physical, and for those of another ship.
    """
    if rest not in REST:
        raise PanelsimError("rest is not known", got=repr(rest), allowed=" | ".join(REST))
    require_sound(foreign)
    require_belonging(foreign, ship)
    notes = list(foreign.notes)
    frequency, added_mass, damping = _from_rest(foreign, rest, notes)
    added_mass, damping = foreign.frame.matrix(added_mass), foreign.frame.matrix(damping)
    symmetric = is_mirror_symmetric(ship.mesh)
    half_breadth = _half_breadth(ship)
    conditions = frequency, symmetric, half_breadth
    added_mass, measures = _symmetric(foreign.source, "added mass", added_mass, *conditions)
    damping, _ = _symmetric(foreign.source, "radiation damping", damping, *conditions)
    require_physical(frequency, added_mass, damping, half_breadth)
    heading, table = _tables(foreign, ship, symmetric, notes)
    infinite = foreign.added_mass_infinite
    attributes = {
        **measures,
        "half_breadth": half_breadth,
        "damping_roughness": damping_roughness(frequency, damping, half_breadth),
        "mirror_symmetric": int(symmetric),
        "waterline": ship.waterline,
        "water_density": ship.water_density,
        "gravity": ship.gravity,
        "solver": foreign.source,
    }
    dataset = _dataset(
        frequency,
        added_mass,
        damping,
        added_mass[-1]
        if infinite is None
        else _even(foreign.frame.matrix(infinite), symmetric, half_breadth),
        foreign.wave_frequency,
        heading,
        table,
    )
    dataset.attrs |= attributes
    database = HydroDatabase.of_ship(ship, dataset)
    if infinite is None:
        notes.append(
            "The file has no added mass of infinite frequency: it is fitted to the damping (Ogilvie 1964)."
        )
        dataset["added_mass_infinite"] = (
            ("influenced_dof", "radiating_dof"),
            memory_functions(database).added_mass_infinite,
        )
    dataset.attrs["notes"] = "\n".join(notes)
    return HydroDatabase(dataset)


def _from_rest(
    foreign: ForeignCoefficients, rest: str, notes: list[str]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Frequencies from 0 (F + 1,), A and B (F + 1, 6, 6) in the axes of the file."""
    zero = foreign.added_mass_zero
    if zero is None:
        lowest = foreign.frequency[0]
        if rest == "file":
            raise PanelsimError(
                "The file has no added mass at frequency 0, which steady speed and slow waves need",
                got=f"{foreign.source}: frequencies from {lowest:.4g} rad/s",
                remedy='compute it there too, or take that of the lowest frequency with rest="lowest"',
            )
        notes.append(f"The file has no added mass at frequency 0: that of {lowest:.4g} rad/s stands for it.")
        zero = foreign.added_mass[0]
    return (
        np.concatenate([[0.0], foreign.frequency]),
        np.concatenate([zero[None], foreign.added_mass]),
        np.concatenate([np.zeros((1, 6, 6)), foreign.radiation_damping]),
    )


def _symmetric(
    source: str,
    name: str,
    matrices: FloatArray,
    frequency: FloatArray,
    mirror_symmetric: bool,
    half_breadth: float,
) -> tuple[FloatArray, dict[str, float]]:
    """Symmetrised matrices and how much that changed; refuses more than 5 %, with the frequency of it."""
    mean, transpose, coupling = symmetrise(
        matrices, mirror_symmetric=mirror_symmetric, half_breadth=half_breadth
    )
    if max(transpose, coupling) > _LARGEST_ASYMMETRY:
        what = (
            "is not symmetric" if transpose >= coupling else "couples motions in and out of the centreplane"
        )
        raise PanelsimError(
            f"The {name} of the file {what}",
            got=f"{source}: {100 * max(transpose, coupling):.0f} % of the peak;"
            f" {_good_to(matrices, frequency, mirror_symmetric, half_breadth)}",
            allowed=f"{100 * _LARGEST_ASYMMETRY:.0f} %",
            remedy="where low frequencies are good, the panels are too large for the high ones: compute it to"
            " a lower frequency; else look at the axes, at moments_about, and whether the file is whole",
        )
    return mean, {"asymmetry_" + name.replace(" ", "_"): transpose, "port_starboard_coupling": coupling}


def _good_to(matrices: FloatArray, frequency: FloatArray, mirror_symmetric: bool, half_breadth: float) -> str:
    """To which frequency the matrices are symmetric, in words."""
    for count in range(len(frequency) - 1, 1, -1):
        _, *errors = symmetrise(
            matrices[:count], mirror_symmetric=mirror_symmetric, half_breadth=half_breadth
        )
        if max(errors) <= _LARGEST_ASYMMETRY:
            return f"good to {frequency[count - 1]:.4g} rad/s"
    return f"from {frequency[1]:.4g} rad/s on"


def _even(matrix: FloatArray, mirror_symmetric: bool, half_breadth: float) -> FloatArray:
    return symmetrise(matrix[None], mirror_symmetric=mirror_symmetric, half_breadth=half_breadth)[0][0]


def _tables(
    foreign: ForeignCoefficients, ship: Ship, symmetric: bool, notes: list[str]
) -> tuple[FloatArray, ComplexArray]:
    """Headings (H,) ascending and diffraction loads (W, H, 6) about the CG in ship axes."""
    frame, omega = foreign.frame, foreign.wave_frequency
    heading = frame.wave_heading(foreign.wave_direction)
    gravity = ship.gravity if foreign.gravity is None else foreign.gravity
    loads = {
        name: frame.load(value, foreign.wave_direction, wavenumber(omega, gravity))
        for name in ("diffraction", "froude_krylov", "excitation")
        if (value := getattr(foreign, name)) is not None
    }
    ours = froude_krylov(ship, omega, heading)
    if "froude_krylov" in loads:
        require_same_incident(foreign.source, loads["froude_krylov"], ours)
    else:
        total = loads["excitation"] if "excitation" in loads else loads["diffraction"] + ours
        require_same_long_waves(foreign.source, total, ours, omega, ship)
    if "diffraction" not in loads:
        loads["diffraction"] = loads["excitation"] - loads.get("froude_krylov", ours)
        if "froude_krylov" not in loads:
            notes.append(
                "The file has the sum of the wave loads: our hull's Froude-Krylov load is taken off."
            )
    return _around(foreign.source, heading, loads["diffraction"], symmetric, notes)


def _around(
    source: str, heading: FloatArray, table: ComplexArray, symmetric: bool, notes: list[str]
) -> tuple[FloatArray, ComplexArray]:
    """Headings in (-π, π], ascending, each once, with those of the other side of a symmetric hull."""
    wrapped = np.pi - np.mod(np.pi - heading + _SAME_HEADING, 2 * np.pi) + _SAME_HEADING
    missing = np.array(
        [np.abs(np.exp(1j * wrapped) - np.exp(-1j * b)).min() > _SAME_HEADING for b in wrapped]
    )
    if symmetric and missing.any():
        notes.append("The hull is symmetric: the file has headings of one side, the other side mirrors them.")
        wrapped = np.concatenate([wrapped, -wrapped[missing]])
        table = np.concatenate([table, table[:, missing] * _MIRROR], axis=1)
    wrapped = np.round(wrapped, 12) + 0.0
    order = np.argsort(wrapped)
    wrapped, table = wrapped[order], table[:, order]
    again = np.flatnonzero(np.diff(wrapped) < 2 * _SAME_HEADING)
    peak = np.abs(table).max(axis=(0, 1))
    if (np.abs(table[:, again + 1] - table[:, again]) > _SAME_LOAD * peak + 1e-300).any():
        raise PanelsimError(
            "The file has two loads for one heading",
            got=f"{source}: {np.degrees(wrapped[again[0]]):.4g}°",
            allowed=f"differences to {100 * _SAME_LOAD:.0f} % of the peak",
        )
    kept = np.delete(np.arange(len(wrapped)), again + 1)
    return wrapped[kept], table[:, kept]


def _half_breadth(ship: Ship) -> float:
    wet = ship.vertices[:, 2] <= ship.waterline
    return float(np.abs(ship.vertices[wet, 1]).max())


def _dataset(
    frequency: FloatArray,
    added_mass: FloatArray,
    damping: FloatArray,
    infinite: FloatArray,
    wave_frequency: FloatArray,
    wave_heading: FloatArray,
    table: ComplexArray,
) -> xr.Dataset:
    matrix = ("frequency", "influenced_dof", "radiating_dof")
    waves = ("wave_frequency", "wave_heading", "influenced_dof")
    return xr.Dataset(
        {
            "added_mass": (matrix, added_mass),
            "radiation_damping": (matrix, damping),
            "added_mass_infinite": (matrix[1:], infinite),
            "diffraction_real": (waves, table.real),
            "diffraction_imag": (waves, table.imag),
        },
        coords={
            "frequency": frequency,
            "influenced_dof": list(DOF_NAMES),
            "radiating_dof": list(DOF_NAMES),
            "wave_frequency": wave_frequency,
            "wave_heading": wave_heading,
        },
    )
