"""Numeric output of WAMIT: .1, .3 or .3sc with .3fk, and .hst; one body, as many other programs write it too.

After the WAMIT user manual, chapters 3 and 5. With L = ULEN: A/(ρ Lᵏ), B/(ρ ω Lᵏ), k = 3, 4 or 5 for no, one
or two rotations; X/(ρ g a Lᵐ), m = 2 for forces and 3 for moments; C33/(ρ g L²), C34/(ρ g L³), C44/(ρ g L⁴).
Time factor exp(+iωt), phase that of a crest at the origin, directions of travel from x towards y in degrees.
Being without dimension in ρ and g, the numbers take those of the ship. Files leave out what symmetry makes
zero.
"""

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import DOF_NAMES, ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import as_path
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.exchange.assemble import database_of
from panelsim.hydro.exchange.foreign import ForeignCoefficients
from panelsim.hydro.exchange.frame import Frame
from panelsim.hydro.exchange.wamit_files import Rows, read_rows
from panelsim.ship.ship import Ship

FIRST_COLUMNS = ("period", "frequency")
_ROTATIONS = np.array([0, 0, 0, 1, 1, 1])
_SAME_LOAD = 1e-3  # of the largest, between modulus with phase (three decimals) and real with imaginary part
_PARTS = {".3": "excitation", ".3sc": "diffraction", ".3fk": "froude_krylov"}
WAMIT_SUFFIXES = (".1", *_PARTS, ".hst")


def read_wamit(
    path: str | Path,
    ship: Ship,
    *,
    length_scale: float,
    forward: str,
    center_of_gravity: ArrayLike,
    moments_about: ArrayLike,
    water_depth: float,
    first_column: str = "period",
    rest: str = "file",
) -> HydroDatabase:
    """The database of a ship from the files `path`.1, .3 (or .3sc, .3fk) and, if it is there, .hst.

    None of these is in the files: `length_scale` ULEN [m]; `forward` "+x" or "-x", the way of the bow;
    `center_of_gravity` of the ship and `moments_about`, the origin of the body, (x, y, z) [m] in the global
    axes, z from calm water; `water_depth` [m], np.inf for deep. `first_column` is "period" [s] or "frequency"
    [rad/s] (IPEROUT 1 or 2). `rest` as in `database_of`. Raises PanelsimError for files that are missing, cut
    short or not of this ship.
    """
    path = as_path(path)
    stem = path.with_suffix("") if path.suffix in WAMIT_SUFFIXES else path
    if first_column not in FIRST_COLUMNS:
        raise PanelsimError(
            "first_column is not known", got=repr(first_column), allowed=" | ".join(FIRST_COLUMNS)
        )
    if not (np.isfinite(length_scale) and length_scale > 0.0):
        raise PanelsimError("length_scale is not positive", got=length_scale, allowed="ULEN in m")
    frame = Frame.given(forward=forward, center_of_gravity=center_of_gravity, moments_about=moments_about)
    frequency, added_mass, damping, limits = _radiation(stem, length_scale, first_column, ship)
    waves = [
        (name, *_loads(stem.with_name(stem.name + suffix), length_scale, first_column, ship))
        for suffix, name in _PARTS.items()
        if stem.with_name(stem.name + suffix).is_file()
    ]
    if not any(name != "froude_krylov" for name, *_ in waves):
        raise PanelsimError("There are no wave loads", got=stem, allowed=f"{stem.name}.3 or {stem.name}.3sc")
    _, wave_frequency, direction, _ = waves[0]
    if not all(np.array_equal(w, wave_frequency) and np.array_equal(d, direction) for _, w, d, _ in waves):
        raise PanelsimError(
            "The files of wave loads have other frequencies or headings from one to the next", got=stem
        )
    loads = {name: load for name, _, _, load in waves}
    return database_of(
        ForeignCoefficients(
            source=f"WAMIT, {stem}",
            frame=frame,
            frequency=frequency,
            added_mass=added_mass,
            radiation_damping=damping,
            wave_frequency=wave_frequency,
            wave_direction=direction,
            added_mass_zero=limits.get(0.0),
            added_mass_infinite=limits.get(np.inf),
            stiffness=_stiffness(stem.with_name(stem.name + ".hst"), length_scale, ship),
            water_depth=water_depth,
            diffraction=loads.get("diffraction"),
            froude_krylov=loads.get("froude_krylov"),
            excitation=loads.get("excitation"),
        ),
        ship,
        rest=rest,
    )


def frequency_of(first: float, first_column: str) -> float:
    """Frequency [rad/s] of a value in the first column; 0 and infinity have values of their own.

    A period of 0 is infinite frequency and a negative one frequency 0; a negative frequency is infinite.
    """
    if first_column == "frequency":
        return first if first >= 0.0 else np.inf
    if first < 0.0:
        return 0.0
    return 2.0 * np.pi / first if first > 0.0 else np.inf


def _radiation(
    stem: Path, length: float, first_column: str, ship: Ship
) -> tuple[FloatArray, FloatArray, FloatArray, dict[float, FloatArray]]:
    """Frequencies (F,), A and B (F, 6, 6), and A at 0 and infinity by frequency."""
    rows = read_rows(stem.with_name(stem.name + ".1"), columns=(4, 5), modes=(1, 2))
    blocks = rows.blocks(lambda row: (frequency_of(row[0], first_column),))
    frequency = np.array(sorted(omega for (omega,) in blocks if 0.0 < omega < np.inf))
    _require_diagonal(rows, next(iter(blocks.values())))
    scale = ship.water_density * length ** (3 + _ROTATIONS[:, None] + _ROTATIONS)
    matrices = {omega: _matrix(rows, block, 3) * scale for (omega,), block in blocks.items()}
    limits = {omega: a for omega, a in matrices.items() if omega in (0.0, np.inf)}
    damping = np.array([_matrix(rows, blocks[(w,)], 4) * scale * w for w in frequency]).reshape(-1, 6, 6)
    added_mass = np.array([matrices[w] for w in frequency]).reshape(-1, 6, 6)
    return frequency, added_mass, damping, limits


def _matrix(rows: Rows, block: dict[tuple[int, ...], list[float]], column: int) -> FloatArray:
    matrix = np.zeros((6, 6))
    for (i, j), row in block.items():
        if len(row) <= column:
            raise PanelsimError("A row of the file has no damping", got=f"{rows.path}: {row}")
        matrix[i, j] = row[column]
    return matrix


def _require_diagonal(rows: Rows, block: dict[tuple[int, ...], list[float]]) -> None:
    missing = [DOF_NAMES[i] for i in range(6) if (i, i) not in block]
    if missing:
        raise PanelsimError(
            "The file does not have all six motions",
            got=f"{rows.path} without {', '.join(missing)}",
            remedy="compute all six (IRAD = 1)",
        )


def _loads(
    path: Path, length: float, first_column: str, ship: Ship
) -> tuple[FloatArray, FloatArray, ComplexArray]:
    """Wave frequencies (W,), directions (H,) [rad] and loads (W, H, 6) of one file."""
    rows = read_rows(path, columns=(7,), modes=(2,), values=slice(3, 7))
    blocks = rows.blocks(lambda row: (frequency_of(row[0], first_column), row[1]))
    frequency = np.array(sorted({omega for omega, _ in blocks}))
    direction = np.array(sorted({beta for _, beta in blocks}))
    missing = [(w, b) for w in frequency for b in direction if (w, b) not in blocks]
    modes = {mode for mode in next(iter(blocks.values()))}
    if missing or len(modes) != 6:
        raise PanelsimError(
            "The file does not have every motion at every frequency and heading",
            got=f"{path}: "
            + (
                f"none at {missing[0][0]:.4g} rad/s, {missing[0][1]:g}°"
                if missing
                else f"{len(modes)} motions"
            ),
            remedy="write it again, whole",
        )
    numbers = np.array([[[blocks[(w, b)][(i,)] for i in range(6)] for b in direction] for w in frequency])
    load = numbers[..., 5] + 1j * numbers[..., 6]
    polar = numbers[..., 3] * np.exp(1j * np.radians(numbers[..., 4]))
    scale = length ** (2.0 + _ROTATIONS)
    apart = np.abs(load - polar) * scale / np.abs(load * scale).max(axis=(0, 1)).max()
    if not apart.max() <= _SAME_LOAD:
        w, b, i = np.unravel_index(np.nanargmax(apart), apart.shape)
        raise PanelsimError(
            "Modulus and phase of a load are not its real and imaginary part",
            got=f"{path}: {numbers[w, b, i, 3:].tolist()} in {DOF_NAMES[i]}",
            remedy="the columns are modulus, phase in degrees, real and imaginary part",
        )
    return frequency, np.radians(direction), load * scale * ship.water_density * ship.gravity


def _stiffness(path: Path, length: float, ship: Ship) -> FloatArray | None:
    if not path.is_file():
        return None
    (block,) = read_rows(path, columns=(3,), modes=(0, 1)).blocks(lambda row: ()).values()
    stiffness = np.zeros((6, 6))
    for (i, j), row in block.items():
        stiffness[i, j] = row[2]
    scale = ship.water_density * ship.gravity * length ** (2.0 + _ROTATIONS[:, None] + _ROTATIONS)
    return stiffness * scale
