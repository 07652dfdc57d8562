"""Records of wave elevation at one point, and their files."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError

FEWEST_SAMPLES = 32
# Share of a step by which a time may stand off its even place. Clocks printed with two decimals pass,
# for example 1.28 samples a second; a missing sample is a hundred times that.
STEP_TOLERANCE = 0.01


@dataclass(frozen=True, eq=False)
class ElevationRecord:
    """Elevation (N,) [m, up] of the sea at a fixed point, at evenly spaced times (N,) [s].

    The step is even where each time is within 1 % of a step of its place on the line through all of them.
    Raises PanelsimError for fewer than 32 samples, values that are not finite, and steps that are not even.
    """

    time: FloatArray
    elevation: FloatArray

    def __post_init__(self) -> None:
        for name in ("time", "elevation"):
            try:
                column = np.array(getattr(self, name), dtype=float)
            except (TypeError, ValueError) as error:
                raise PanelsimError(f"The record's {name} is no list of numbers", got=str(error)) from None
            column.setflags(write=False)
            object.__setattr__(self, name, column)
        if self.time.ndim != 1 or self.time.shape != self.elevation.shape:
            raise PanelsimError(
                "The record's time and elevation are no lists of one length",
                got=f"shapes {self.time.shape} and {self.elevation.shape}",
            )
        if self.count < FEWEST_SAMPLES:
            raise PanelsimError(
                "The record is too short", got=f"{self.count} samples", allowed=f"at least {FEWEST_SAMPLES}"
            )
        for name in ("time", "elevation"):
            bad = np.flatnonzero(~np.isfinite(getattr(self, name)))
            if bad.size:
                raise PanelsimError(
                    f"The record's {name} is missing in sample {bad[0] + 1}",
                    got=f"{bad.size} of {self.count} samples are missing",
                    remedy="take a part of the record without gaps",
                )
        _require_even(self.time, "sample", range(1, self.count + 1))

    @property
    def count(self) -> int:
        """Number of samples N."""
        return len(self.time)

    @property
    def step(self) -> float:
        """Time between samples [s], by least squares."""
        return _even_step(self.time)

    @property
    def length(self) -> float:
        """Length T = N Δt [s], after which the waves of the record repeat; one step past its last sample."""
        return self.count * self.step

    @property
    def nyquist_frequency(self) -> float:
        """Highest frequency π/Δt [rad/s] that the samples show."""
        return np.pi / self.step

    @property
    def variance(self) -> float:
        """Variance of the elevation about its mean [m²]."""
        return float(np.var(self.elevation))


def _even_step(time: FloatArray) -> float:
    """Slope of the line through the times (N,) [s]."""
    place = np.arange(len(time)) - 0.5 * (len(time) - 1)
    return float(place @ (time - time.mean()) / (place @ place))


def _uneven_sample(time: FloatArray) -> int | None:
    """Index of the first time that breaks the even step, None where all are even."""
    steps = np.diff(time)
    usual = float(np.median(steps))
    if usual <= 0:
        return int(np.flatnonzero(steps <= 0)[0]) + 1
    # Both ends of a step may be off.
    broken = np.flatnonzero(np.abs(steps - usual) > 2 * STEP_TOLERANCE * usual)
    if broken.size:
        return int(broken[0]) + 1
    off = time - time.mean() - _even_step(time) * (np.arange(len(time)) - 0.5 * (len(time) - 1))
    drifted = np.flatnonzero(np.abs(off) > STEP_TOLERANCE * usual)
    return int(drifted[0]) if drifted.size else None


def _require_even(time: FloatArray, unit: str, numbers: Sequence[int]) -> None:
    """Refuse uneven steps; `numbers` (N,) count the samples, or the lines that they stand in."""
    sample = _uneven_sample(time)
    if sample is not None:
        before, after = time[sample - 1], time[sample]
        usual = np.median(np.diff(time))
        raise PanelsimError(
            f"The record's steps are not even at {unit} {numbers[sample]}",
            got=f"{after - before:g} s from {before:g} s to {after:g} s, usual {usual:g} s",
            allowed=f"even steps, each time within {100 * STEP_TOLERANCE:g} % of a step of its place",
            remedy="take a part of the record without gaps, or interpolate it to even steps",
        )


def read_elevation_record(
    path: str | Path, *, time_column: str | None = None, elevation_column: str | None = None
) -> ElevationRecord:
    """Read a record from a CSV file with one header line, `time_s,elevation_m` [s, m].

    Columns of other names, and then of the same units, are named by `time_column` and `elevation_column`;
    further columns are left out. Raises PanelsimError for files and values that cannot be read, with
    the line, and for what `ElevationRecord` refuses, with the line.
    """
    names = (time_column or "time_s", elevation_column or "elevation_m")
    lines, values = _read_columns(Path(path), names)
    if len(values) >= FEWEST_SAMPLES:
        _require_even(values[:, 0], "line", lines)
    return ElevationRecord(values[:, 0], values[:, 1])


def _read_columns(path: Path, names: tuple[str, str]) -> tuple[list[int], FloatArray]:
    """Line numbers and values (N, 2) of two columns of a CSV file."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        rows = list(csv.reader(text.splitlines()))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise PanelsimError("The elevation record cannot be read", got=f"{path} ({error})") from error
    places = _column_places(path, [cell.strip() for cell in rows[0]] if rows else [], names)
    if not text.endswith(("\n", "\r")):
        raise PanelsimError(
            f"The file ends in the middle of line {len(rows)}",
            got=f"{path}: {','.join(rows[-1])[:60]!r}",
            remedy="get the whole file; if nothing is missing, end its last line",
        )
    read = [(i, _row_values(path, i, row, places)) for i, row in enumerate(rows[1:], start=2) if row]
    return [line for line, _ in read], np.array([row for _, row in read], dtype=float).reshape(-1, 2)


def _column_places(path: Path, header: list[str], names: tuple[str, str]) -> list[int]:
    """Where the two columns stand; refuses a header that has not each of them once."""
    for name, keyword in zip(names, ("time_column", "elevation_column"), strict=True):
        if header.count(name) != 1:
            raise PanelsimError(
                f"The elevation record has not one column {name!r}",
                got=f"{path}: header {','.join(header)[:120]!r}",
                allowed="a header line time_s,elevation_m",
                remedy=f"name the column in m or s that is meant by {keyword}",
            )
    return [header.index(name) for name in names]


def _row_values(path: Path, line: int, row: list[str], places: list[int]) -> list[float]:
    """The two numbers of a row; refuses a row cut short, text, and missing or infinite values."""
    cells = [row[place].strip() if place < len(row) else "" for place in places]
    try:
        values = [float(cell) for cell in cells]
    except ValueError:
        values = [np.nan]
    if not np.isfinite(values).all():
        raise PanelsimError(
            f"A time or elevation is missing or no number in line {line}",
            got=f"{path}: {','.join(row)[:60]!r}",
            remedy="take a part of the record without gaps",
        )
    return values
