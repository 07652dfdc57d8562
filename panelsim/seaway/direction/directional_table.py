"""A directional spectrum given by a table, as wave models and buoys give it."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angles, require_numbers
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.spectra.table import TableSpectrum

WIDEST_GAP = np.pi / 2  # between neighbouring directions; beyond it a straight line is no guess at a sea
ROUNDING = 1e-9  # rad, and of a frequency: the last digits of a grid

# The corner cell of a file names the units of its rows, its columns and its densities: what to multiply
# frequencies by for rad/s, and densities for m² s/rad².
CORNERS = {
    "frequency_rad_s/direction_from_deg/m2_s_per_rad2": (1.0, 1.0),
    "frequency_hz/direction_from_deg/m2_per_hz_deg": (2 * np.pi, 180 / (2 * np.pi**2)),
}


@dataclass(frozen=True, eq=False)
class DirectionalTable(DirectionalSpectrum):
    """S(ω, ν) linear between the rows in ω, and linear between the columns in ν around the circle.

    `frequency` (F,) rising [rad/s], `sea_direction` (D,) [rad] that waves come from, in any order (kept in
    rising order from north), `density` (F, D) [m² s/rad²].

    Raises PanelsimError for other shapes, numbers that are not finite, negative densities, frequencies that
    are not positive or do not rise, directions that repeat or leave a gap of more than 90°, a table without
    energy.
    """

    frequency: FloatArray
    sea_direction: FloatArray
    density_table: FloatArray

    def __post_init__(self) -> None:
        frequency, direction, density = _checked_columns(
            self.frequency, self.sea_direction, self.density_table
        )
        order = np.argsort(direction)
        columns = {
            "frequency": frequency,
            "sea_direction": direction[order],
            "density_table": density[:, order],
        }
        for name, column in columns.items():
            column = column.copy()
            column.setflags(write=False)
            object.__setattr__(self, name, column)
        self._require_directions()
        self.point  # noqa: B018 - built now, so that wrong frequencies are told now

    def _require_directions(self) -> None:
        """Refuse directions that repeat, or that leave a part of the circle open."""
        gaps, degrees = self._gaps, np.rad2deg(self.sea_direction)
        if gaps.min() < ROUNDING:
            raise PanelsimError(
                "A direction of the table is given twice",
                got=f"{degrees[np.argmin(gaps)]:.6g}°",
                remedy="give each direction once; 0° and 360° are the same",
            )
        if gaps.max() > WIDEST_GAP + ROUNDING:
            raise PanelsimError(
                "The directions of the table leave a gap",
                got=f"{np.rad2deg(gaps.max()):.4g}° after {degrees[np.argmax(gaps)]:.4g}°",
                allowed="at most 90° between neighbours, around the whole circle",
                remedy="add directions without energy where none come from",
            )

    @property
    def _gaps(self) -> FloatArray:
        """Angle (D,) [rad] from each direction to the next around the circle."""
        return np.diff(self.sea_direction, append=self.sea_direction[0] + 2 * np.pi)

    @cached_property
    def point(self) -> TableSpectrum:
        """∫ S dν, exact for the interpolation: the trapezoid rule around the circle."""
        return TableSpectrum(self.frequency, self.density_table @ self.grid_intervals(None))

    def density(self, omega: ArrayLike, sea_direction: ArrayLike) -> FloatArray:
        """S(ω, ν) [m² s/rad²] at frequencies [rad/s] and directions [rad] that broadcast.

        Raises PanelsimError for frequencies outside the table.
        """
        inside = self._inside(omega)
        table, steps = self.density_table, np.diff(self.frequency)
        row = np.clip(np.searchsorted(self.frequency, inside, side="right") - 1, 0, len(steps) - 1)
        up = (inside - self.frequency[row]) / steps[row]
        # The last direction before ν, around the circle.
        turned = np.remainder(
            require_angles("sea direction", sea_direction) - self.sea_direction[0], 2 * np.pi
        )
        places = self.sea_direction - self.sea_direction[0]
        column = np.searchsorted(places, turned, side="right") - 1
        across = (turned - places[column]) / self._gaps[column]
        after = (column + 1) % len(places)
        low = (1 - across) * table[row, column] + across * table[row, after]
        high = (1 - across) * table[row + 1, column] + across * table[row + 1, after]
        return np.where(np.asarray(omega, dtype=float) > 0, (1 - up) * low + up * high, 0.0)

    def _inside(self, omega: ArrayLike) -> FloatArray:
        """The frequencies within the table, those at ω ≤ 0 as its first; refused where one is beyond it."""
        omega = require_numbers(omega)
        low, high = self.frequency[[0, -1]]
        outside = (omega > 0) & ((omega < (1 - ROUNDING) * low) | (omega > (1 + ROUNDING) * high))
        if outside.any():
            raise PanelsimError(
                "A frequency lies outside the table of the directional spectrum",
                got=f"{omega[outside][0]:g} rad/s",
                allowed=f"{low:g} to {high:g} rad/s",
                remedy="choose frequencies within the table, or extend the table",
            )
        return np.clip(omega, low, high)

    def mean_vector(self, omega: ArrayLike | None = None) -> ComplexArray:
        """∫ S e^{iν} dν / ∫ S dν at frequencies [rad/s], or over all of them; NaN where there is no energy.

        Exact for the interpolation.
        """
        vectors = self.density_table @ self._direction_weights
        energies = self.density_table @ self.grid_intervals(None)
        if omega is None:
            vector, energy = (np.trapezoid(rows, self.frequency) for rows in (vectors, energies))
        else:
            inside = self._inside(omega)
            vector, energy = (np.interp(inside, self.frequency, rows) for rows in (vectors, energies))
            energy = np.where(np.asarray(omega, dtype=float) > 0, energy, 0.0)
        return np.where(energy > 0.0, vector / np.where(energy > 0.0, energy, 1.0), np.nan)

    @property
    def _direction_weights(self) -> ComplexArray:
        """∫ of e^{iν} (D,) times the hat function of each direction."""
        after = self._gaps
        before = np.roll(after, 1)
        real = sum(2 * np.sin(0.5 * gap) ** 2 / gap for gap in (after, before))
        imaginary = np.sin(before) / before - np.sin(after) / after
        return np.exp(1j * self.sea_direction) * (real + 1j * imaginary)

    def grid_directions(self, step: float | None) -> FloatArray:
        """Directions ν (D,) [rad] of a grid of that step [rad] from north; the table's own without a step."""
        return self.sea_direction if step is None else super().grid_directions(step)

    def grid_intervals(self, step: float | None) -> FloatArray:
        """Direction interval Δν (D,) [rad] of each; of the table's own, half way to both neighbours."""
        if step is None:
            return 0.5 * (self._gaps + np.roll(self._gaps, 1))
        return super().grid_intervals(step)


def _checked_columns(
    frequency: ArrayLike, sea_direction: ArrayLike, density: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Frequencies (F,), directions (D,) within one turn and densities (F, D), if they fit together."""
    rows, table = require_numbers(frequency), require_numbers(density)
    angles = np.remainder(require_angles("sea direction", sea_direction), 2 * np.pi)
    fits = rows.ndim == angles.ndim == 1 and len(rows) >= 2 and len(angles) >= 1
    if not fits or table.shape != (len(rows), len(angles)):
        raise PanelsimError(
            "The directional table does not fit its frequencies and directions",
            got=f"density {table.shape}, frequencies {rows.shape}, directions {angles.shape}",
            allowed="density (F, D), frequencies (F,) of two or more, directions (D,)",
        )
    if not np.isfinite(table).all() or table.min() < 0:
        raise PanelsimError(
            "A density of the directional table is negative, or not finite",
            got=f"{table.min():g} to {table.max():g} m² s/rad²",
            allowed="0 or more",
        )
    return rows, angles, table


def read_directional_table(path: str | Path) -> DirectionalTable:
    """Read a CSV file with directions in the first row, frequencies in the first column, densities between.

    The corner cell names the units and must be `frequency_rad_s/direction_from_deg/m2_s_per_rad2` or
    `frequency_hz/direction_from_deg/m2_per_hz_deg`; the directions are compass ones that waves come from.
    Raises PanelsimError for a missing file, another corner, lines that are not all numbers or not all of one
    length, a last line that does not end (a file cut short), and all that DirectionalTable refuses.
    """
    path = Path(path)
    header, *lines = _lines(path)
    corner, *directions = (cell.strip() for cell in header.split(","))
    if corner not in CORNERS:
        raise PanelsimError(
            f"The first cell of {path} does not name its units",
            got=repr(corner)[:60],
            allowed=" | ".join(CORNERS),
        )
    degrees = _numbers(path, 1, directions, len(directions))
    if np.any(np.abs(degrees) > 360):
        raise PanelsimError(
            f"{path} has a direction beyond 360°", got=f"{degrees[np.abs(degrees) > 360][0]:g}"
        )
    rows = [_numbers(path, n, line.split(","), len(degrees) + 1) for n, line in enumerate(lines, 2)]
    table = np.array(rows).reshape(-1, len(degrees) + 1)
    to_radians, to_density = CORNERS[corner]
    return DirectionalTable(to_radians * table[:, 0], np.deg2rad(degrees), to_density * table[:, 1:])


def _lines(path: Path) -> list[str]:
    """The lines of a text file, whose last line must be ended."""
    try:
        text = path.read_text(encoding="utf-8-sig")  # spreadsheets put a byte order mark first
    except (OSError, UnicodeDecodeError) as error:
        raise PanelsimError("The directional table cannot be read", got=f"{path} ({error})") from error
    if not text.endswith("\n"):
        raise PanelsimError(
            f"{path} is cut short: its last line does not end",
            got=repr(text[-60:]),
            remedy="get the whole file, or end the last line",
        )
    return text.rstrip().splitlines() or [""]


def _numbers(path: Path, number: int, cells: list[str], count: int) -> FloatArray:
    """The numbers of one line."""
    try:
        values = np.array(cells, dtype=float)
    except ValueError:
        values = np.empty(0)
    if len(values) != count or not np.isfinite(values).all():
        raise PanelsimError(
            f"{path}, line {number} does not hold {count} numbers", got=repr(",".join(cells))[:80]
        )
    return values
