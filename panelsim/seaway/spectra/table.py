"""A spectrum given as a table, of a buoy, a wave model or a tank."""

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_numbers, require_share
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.steepness import require_possible_sea

# Header of a file, and how many rad/s its unit of frequency is.
HEADERS = {"frequency_rad_s,density": 1.0, "frequency_hz,density": 2 * np.pi}
ROUNDING = 1e-12  # of the frequency at an end of the table, which a grid may miss by its own rounding


@dataclass(frozen=True, eq=False)
class TableSpectrum(PointSpectrum):
    """Spectrum of `density_table` S (F,) [m² s/rad] at `frequency` ω (F,) [rad/s], linear between the rows.

    Moments and energies are the exact integrals of that broken line. Outside the table nothing is known: a
    density is refused there, and counts as no energy. `significant_wave_height` is 4 √m0, `peak_period`
    that of the largest row.

    Raises PanelsimError for fewer than two rows, frequencies that are not positive or do not rise, densities
    that are negative, not finite or zero everywhere, and a sea steeper than waves can be.
    """

    frequency: FloatArray
    density_table: FloatArray
    significant_wave_height: float = field(init=False)
    peak_period: float = field(init=False)

    def __post_init__(self) -> None:
        for name, column in zip(
            ("frequency", "density_table"), _checked(self.frequency, self.density_table), strict=True
        ):
            column.setflags(write=False)
            object.__setattr__(self, name, column)
        peak = self.frequency[np.argmax(self.density_table)]
        object.__setattr__(self, "peak_period", float(2 * np.pi / peak))
        object.__setattr__(self, "significant_wave_height", 4 * float(np.sqrt(self.moment(0))))
        require_possible_sea(self.significant_wave_height, self.peak_period)

    @property
    def tail_power(self) -> float:
        return np.inf

    @property
    def frequency_range(self) -> tuple[float, float]:
        return float(self.frequency[0]), float(self.frequency[-1])

    @property
    def break_frequencies(self) -> FloatArray:
        return self.frequency

    def density(self, omega: ArrayLike) -> FloatArray:
        """S(ω) [m² s/rad] by the line between the rows, zero at ω ≤ 0.

        Raises PanelsimError for a frequency above 0 that the table does not reach.
        """
        omega = require_numbers(omega)
        low, high = self.frequency_range
        outside = (omega > 0) & ((omega < (1 - ROUNDING) * low) | (omega > (1 + ROUNDING) * high))
        if outside.any():
            raise PanelsimError(
                "A frequency lies outside the table of the spectrum",
                got=f"{omega[outside][0]:g} rad/s",
                allowed=f"{low:g} to {high:g} rad/s",
                remedy="choose frequencies within the table, or extend the table",
            )
        return np.where(omega > 0, np.interp(omega, self.frequency, self.density_table), 0.0)

    def moment(self, n: int, upper_frequency: float | None = None) -> float:
        """Moment m_n = ∫ S ωⁿ dω of the table, up to a frequency [rad/s] where one is given; exact."""
        high = min(self._upper(n, upper_frequency), self.frequency[-1])
        if high <= self.frequency[0]:
            return 0.0
        edges = np.append(self.frequency[self.frequency < high], high)
        rows = np.interp(edges, self.frequency, self.density_table)
        slope = np.diff(rows) / np.diff(edges)
        # S = S_a + slope (ω − a) in each interval, so that ∫ S ωⁿ = (S_a − slope a) ∫ ωⁿ + slope ∫ ωⁿ⁺¹.
        constant = rows[:-1] - slope * edges[:-1]
        return float(np.sum(constant * _powers(edges, n) + slope * _powers(edges, n + 1)))

    @cached_property
    def _energy(self) -> FloatArray:
        """Energy (F,) [m²] below each row."""
        steps = 0.5 * (self.density_table[1:] + self.density_table[:-1]) * np.diff(self.frequency)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def _share_below(self, frequency: float) -> float:
        omega = np.clip(frequency, *self.frequency_range)
        i = int(np.searchsorted(self.frequency, omega, side="right")) - 1
        mean = 0.5 * (self.density_table[i] + np.interp(omega, self.frequency, self.density_table))
        return float((self._energy[i] + mean * (omega - self.frequency[i])) / self._energy[-1])

    def frequency_below(self, share: float) -> float:
        share = require_share(share)
        if share in (0.0, 1.0):
            return self.frequency_range[int(share)]
        # The interval in which the share is reached, and so one with energy in it.
        i = int(np.searchsorted(self._energy, share * self._energy[-1])) - 1
        missing = share * self._energy[-1] - self._energy[i]
        first, second = self.density_table[i : i + 2]
        slope = (second - first) / (self.frequency[i + 1] - self.frequency[i])
        root = np.sqrt(max(first**2 + 2 * slope * missing, 0.0))
        return float(self.frequency[i] + 2 * missing / (first + root))


def read_table_spectrum(path: str | Path) -> TableSpectrum:
    """Read a spectrum from a CSV file: the header, then a frequency and a density on each line.

    The header names the unit: `frequency_rad_s,density` for ω [rad/s] and S [m² s/rad],
    `frequency_hz,density` for f [Hz] and S [m²/Hz], turned into ω = 2πf and S/2π.

    Raises PanelsimError for a missing file, another header, lines that are not two numbers, a last line that
    does not end (a file cut short), and all that TableSpectrum refuses.
    """
    path = Path(path)
    header, *lines = _lines(path)
    if header not in HEADERS:
        raise PanelsimError(
            f"{path} has an unknown header", got=repr(header)[:80], allowed=" | ".join(HEADERS)
        )
    rows = np.array([_row(path, number, line) for number, line in enumerate(lines, 2)]).reshape(-1, 2)
    radians = HEADERS[header]
    return TableSpectrum(radians * rows[:, 0], rows[:, 1] / radians)


def _lines(path: Path) -> list[str]:
    """The lines of a text file, without those that are empty at its end."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise PanelsimError("The table of the spectrum cannot be read", got=f"{path} ({error})") from error
    if text and not text.endswith("\n"):
        raise PanelsimError(
            f"{path} is cut short: its last line does not end",
            got=repr(text.splitlines()[-1])[:60],
            remedy="get the whole file, or end the last line",
        )
    return [line.strip() for line in text.rstrip().split("\n")]


def _row(path: Path, number: int, line: str) -> tuple[float, float]:
    try:
        frequency, density = map(float, line.split(","))
    except ValueError:
        raise PanelsimError(
            f"{path}, line {number} is no frequency and density", got=repr(line)[:60], allowed="two numbers"
        ) from None
    return frequency, density


def _checked(frequency: ArrayLike, density: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Copies of the two columns, refused unless they make a spectrum."""
    try:
        omega, rows = np.array(frequency, dtype=float), np.array(density, dtype=float)
    except (TypeError, ValueError) as error:
        raise PanelsimError("The table of the spectrum is not made of numbers", got=str(error)) from None
    if omega.ndim != 1 or omega.shape != rows.shape or len(omega) < 2:
        raise PanelsimError(
            "The table of the spectrum is no two columns",
            got=f"shapes {omega.shape} and {rows.shape}",
            allowed="two or more frequencies and as many densities",
        )
    _require_rows(np.isfinite(omega) & (omega > 0), "a frequency that is not positive", omega, "rad/s")
    rising = np.append(True, np.diff(omega) > 0)
    _require_rows(rising, "a frequency that is not above the one before", omega, "rad/s")
    _require_rows(
        np.isfinite(rows) & (rows >= 0), "a density that is negative or no number", rows, "m² s/rad"
    )
    if not rows.any():
        raise PanelsimError("The table of the spectrum holds no energy", got="densities of 0")
    return omega, rows


def _require_rows(good: NDArray[np.bool_], what: str, column: FloatArray, unit: str) -> None:
    """Refuse a table by its first bad row."""
    if not good.all():
        first = int(np.argmin(good))
        raise PanelsimError(
            f"The table of the spectrum has {what}", got=f"{column[first]:g} {unit} in row {first + 1}"
        )


def _powers(edges: FloatArray, n: int) -> FloatArray:
    """∫ ωⁿ dω between neighbouring edges."""
    return np.diff(np.log(edges)) if n == -1 else np.diff(edges ** (n + 1.0)) / (n + 1)
