"""Spectra and sea states that the buoys of the National Data Buoy Center (NDBC) have measured."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.direction.directional_table import DirectionalTable
from panelsim.seaway.exchange.choice import Moment, chosen_place
from panelsim.seaway.exchange.ndbc_directions import (
    DIRECTIONS,
    require_known_directions,
    weighted_distribution,
)
from panelsim.seaway.exchange.ndbc_files import cut_short, date_count, read_lines, require_spectral
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.table import TableSpectrum

# The files in their order, with the name of the first value in realtime files.
QUANTITIES = ("spec_1", "alpha1_1", "alpha2_1", "r1_1", "r2_1")
MISSING = 999.0

# Quantity, column, the value that stands for a missing one in historical files, factor to SI.
METEOROLOGY = {
    "significant_wave_height": ("WVHT", 99.0, 1.0),
    "peak_period": ("DPD", 99.0, 1.0),
    "zero_crossing_period": ("APD", 99.0, 1.0),
    "sea_direction": ("MWD", 999.0, np.pi / 180.0),
    "wind_speed": ("WSPD", 99.0, 1.0),
}


def read_ndbc_spectrum(
    files: str | Path | Sequence[str | Path], *, time: Moment | None = None
) -> TableSpectrum | DirectionalTable:
    """One spectrum of NDBC files, realtime or historical, the historical ones also .gz, read by wavespectra.

    One file gives the point spectrum; five, in the order density, α1, α2, r1, r2, the directional one, every
    10° by `weighted_distribution`. r1 and r2 in hundredths, as historical files may have them, are told
    by values above 2. Realtime files print frequencies to 0.001 Hz: 0.0325 Hz is 0.033 there.

    `time` (UTC) must be given where the files hold several. Raises PanelsimError for files cut short or of
    another kind, files that do not belong together, densities that are missing (999), directions that are
    missing at a density above 0, and r and α that give negative densities.
    """
    paths = [Path(files)] if isinstance(files, str | Path) else [Path(name) for name in files]
    if len(paths) not in (1, 5):
        raise PanelsimError(
            "The number of NDBC files is wrong",
            got=len(paths),
            allowed="1 (density), or 5 (density, alpha1, alpha2, r1, r2)",
        )
    tables = [_read_table(path, name) for path, name in zip(paths, QUANTITIES, strict=False)]
    rows = [table[chosen_place("time", table["time"].values, time)] for table in tables]
    _require_together(paths, rows)
    # wavespectra keeps frequencies in single precision; the files have four decimals at most.
    frequency = np.round(rows[0]["freq"].values.astype(float), 6)
    density = rows[0].values
    _require_known(density, frequency)
    if len(rows) == 1:
        return TableSpectrum(2 * np.pi * frequency, density / (2 * np.pi))
    moments = np.array([row.values for row in rows[1:]])
    known = np.less(moments, MISSING).all(axis=0)
    require_known_directions(density, known, frequency)
    moments[2:] *= _resultant_factor(paths, tables)
    spread = np.zeros((len(frequency), len(DIRECTIONS)))
    spread[known] = weighted_distribution(frequency[known], *moments[:, known])
    return DirectionalTable(2 * np.pi * frequency, DIRECTIONS, density[:, None] * spread / (2 * np.pi))


def _read_table(path: Path, realtime_name: str) -> xr.DataArray:
    """The values (time, freq) of a file, times rising."""
    from wavespectra import read_ndbc_ascii

    require_spectral(path, realtime_name)
    # A reader that gives up leaves its file to be closed by Python, which would warn.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        try:
            return read_ndbc_ascii(path)["efth"].isel(dir=0, drop=True)
        except (OSError, ValueError, LookupError, TypeError) as error:
            reason = str(error)
    raise PanelsimError("The NDBC file cannot be read", got=f"{path} ({reason[:100]})")


def _require_together(paths: list[Path], rows: list[xr.DataArray]) -> None:
    """Refuse rows of another time or other frequencies than the first."""
    for path, row in zip(paths, rows, strict=True):
        for name in ("time", "freq"):
            if not np.array_equal(row[name].values, rows[0][name].values):
                raise PanelsimError(
                    f"The NDBC files do not have the same {name}", got=f"{path} against {paths[0]}"
                )


def _require_known(density: FloatArray, frequency: FloatArray) -> None:
    """Refuse a density that is missing or negative."""
    bad = np.flatnonzero((density == MISSING) | ~(density >= 0))
    if bad.size:
        raise PanelsimError(
            "The NDBC file has no density there",
            got=f"{density[bad[0]]:g} at {frequency[bad[0]]:g} Hz, and {bad.size} of {len(density)} in all",
            allowed=f"0 or more; {MISSING:g} is a missing one",
            remedy="choose another time",
        )


def _resultant_factor(paths: list[Path], tables: list[xr.DataArray]) -> float:
    """0.01 where r1 and r2 are in hundredths, else 1, from the largest of all times."""
    largest = max(float(table.values[table.values < MISSING].max(initial=0.0)) for table in tables[3:])
    if largest > 100.0:
        raise PanelsimError(
            "The values of r1 and r2 are none",
            got=f"{largest:g} in {paths[3]} or {paths[4]}",
            allowed="0 to 1, or 0 to 100 in hundredths",
            remedy="give the five files in the order density, alpha1, alpha2, r1, r2",
        )
    return 0.01 if largest > 2.0 else 1.0


@dataclass(frozen=True, eq=False)
class BuoyMeteorology:
    """What a buoy has told of the sea, each (N,), NaN where it has not.

    `time` UTC, rising; `significant_wave_height` WVHT = 4 √m0 [m]; `peak_period` DPD [s];
    `zero_crossing_period` APD [s], √(m0/m2) of NDBC's own buoys but m0/m1 of those of Scripps, says
    https://www.ndbc.noaa.gov/wavecalc.shtml; `sea_direction` MWD [rad], compass direction that the waves of
    the peak period come from; `wind_speed` [m/s].
    """

    time: NDArray[np.datetime64]
    significant_wave_height: FloatArray
    peak_period: FloatArray
    zero_crossing_period: FloatArray
    sea_direction: FloatArray
    wind_speed: FloatArray

    def spectrum_at(self, time: Moment | None = None) -> Bretschneider:
        """Bretschneider spectrum of the height and peak period at a time (UTC).

        Raises PanelsimError for a time that is not there, or at which one of them is missing.
        """
        place = self._known("significant_wave_height", "peak_period", time=time)
        return Bretschneider(float(self.significant_wave_height[place]), float(self.peak_period[place]))

    def sea_direction_at(self, time: Moment | None = None) -> float:
        """Direction [rad] that waves come from at a time (UTC); raises as `spectrum_at`."""
        return float(self.sea_direction[self._known("sea_direction", time=time)])

    def _known(self, *names: str, time: Moment | None) -> int:
        """Place of a time at which these quantities are known."""
        place = chosen_place("time", self.time, time)
        known = np.isfinite(sum(getattr(self, name) for name in names))
        if not known[place]:
            wanted = self.time[place]
            others = self.time[known]
            raise PanelsimError(
                f"The buoy has not told the {' and '.join(names)} at {wanted}",
                got=f"{known.sum()} of {len(known)} times with it",
                remedy=f"the nearest is {others[np.argmin(np.abs(others - wanted))]}"
                if others.size
                else None,
            )
        return place


def read_ndbc_meteorology(path: str | Path) -> BuoyMeteorology:
    """Read a standard meteorological file of NDBC, realtime or historical, plain or .gz.

    Missing values (MM, 99.00, 999) become NaN. Years of two digits, until 1998, are 19...
    Raises PanelsimError for files of another kind, cut short, or with what is no number.
    """
    path = Path(path)
    (_, header), *rows = read_lines(path)
    dates = date_count(header)
    lacking = [column for column, _, _ in METEOROLOGY.values() if column not in header]
    if lacking or not rows:
        raise PanelsimError(
            "The file is no standard meteorological file of NDBC, or empty",
            got=f"{path}: no {', '.join(lacking) or 'rows'}; columns {' '.join(header)[:60]}",
            allowed="columns WSPD WVHT DPD APD MWD",
            remedy="read wave spectra with read_ndbc_spectrum",
        )
    for number, words in rows:
        if len(words) != len(header):
            raise cut_short(path, number, words)
    time = np.array([_row_time(path, number, words[:dates]) for number, words in rows])
    order = np.argsort(time, kind="stable")
    columns = {
        name: _column(path, rows, header.index(column), code)[order] * factor
        for name, (column, code, factor) in METEOROLOGY.items()
    }
    return BuoyMeteorology(time[order], **columns)


def _row_time(path: Path, number: int, words: list[str]) -> np.datetime64:
    """The time of a row, from year, month, day, hour and perhaps minute."""
    try:
        year, month, day, hour, *minute = (int(word) for word in words)
        date = f"{year + 1900 if year < 100 else year:04d}-{month:02d}-{day:02d}"
        return np.datetime64(f"{date}T{hour:02d}:{minute[0] if minute else 0:02d}", "m")
    except ValueError:
        raise PanelsimError(
            f"Line {number} does not begin with a date", got=f"{path}: {' '.join(words)!r}"
        ) from None


def _column(path: Path, rows: list[tuple[int, list[str]]], place: int, code: float) -> FloatArray:
    """A column of numbers, NaN where they are missing."""
    values = np.empty(len(rows))
    for i, (number, words) in enumerate(rows):
        word = words[place]
        try:
            values[i] = np.nan if word == "MM" else float(word)
        except ValueError:
            raise PanelsimError(f"Line {number} has no number there", got=f"{path}: {word!r}") from None
    return np.where(values >= code, np.nan, values)
