"""Rows of numbers of WAMIT's numeric output, looked at before they are believed."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from panelsim.errors import PanelsimError

Block = dict[tuple[int, ...], list[float]]


@dataclass(frozen=True)
class Rows:
    """Rows of a file with the numbers of their lines; `modes` are the columns of motions, 1 to 6."""

    path: Path
    rows: tuple[tuple[int, list[float]], ...]
    modes: tuple[int, ...]

    def blocks(self, key: Callable[[list[float]], tuple[float, ...]]) -> dict[tuple[float, ...], Block]:
        """Rows by motions (0 to 5), in blocks of one key, a frequency say.

        Raises PanelsimError for a row that comes twice and for a block that is not like the first.
        """
        blocks: dict[tuple[float, ...], Block] = {}
        for line, row in self.rows:
            block = blocks.setdefault(key(row), {})
            modes = tuple(round(row[column]) - 1 for column in self.modes)
            if modes in block:
                raise PanelsimError("A row of the file comes twice", got=f"{self.path}, line {line}")
            block[modes] = row
        first_key, first = next(iter(blocks.items()))
        for other_key, other in blocks.items():
            if other.keys() != first.keys():
                odd = min(other.keys() ^ first.keys())
                raise PanelsimError(
                    "The file is not whole: its blocks do not have the same motions",
                    got=f"{self.path}: {tuple(m + 1 for m in odd)} not in both {first_key} and {other_key}",
                    remedy="write it again, whole",
                )
        return blocks


def read_rows(
    path: Path, *, columns: tuple[int, ...], modes: tuple[int, ...], values: slice = slice(0, 0)
) -> Rows:
    """Rows of a file with one of these counts of columns; a first line of words is a header.

    Rows whose `values` are all NaN are left out: Capytaine writes them where it solved radiation only.
    Raises PanelsimError, with the line, for what is missing, cut short, not a number, or another mode than 1
    to 6.
    """
    try:
        text = path.read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise PanelsimError("The WAMIT file cannot be read", got=f"{path} ({error})") from error
    rows = []
    for line, words in enumerate((line.split() for line in text.splitlines()), 1):
        row = [_number(word) for word in words]
        if row[values] and all(word.lower() == "nan" for word in words[values]):
            continue
        if line == 1 and any(math.isnan(value) for value in row):
            continue
        if row:
            _require_row(path, line, words, row, columns, modes)
            rows.append((line, row))
    if not rows or not text.endswith("\n"):
        raise PanelsimError(
            "The WAMIT file is empty or cut short",
            got=f"{path}: {len(rows)} rows, the last line not ended",
            remedy="write it again, whole",
        )
    return Rows(path, tuple(rows), modes)


def _require_row(
    path: Path,
    line: int,
    words: list[str],
    row: list[float],
    columns: tuple[int, ...],
    modes: tuple[int, ...],
) -> None:
    if len(row) not in columns or not all(map(math.isfinite, row)):
        raise PanelsimError(
            f"The WAMIT file is cut short or damaged in line {line}",
            got=f"{path}: {' '.join(words)!r}",
            allowed=f"{' or '.join(map(str, columns))} numbers",
        )
    for column in modes:
        if row[column] not in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0):
            raise PanelsimError(
                "The WAMIT file has more than one rigid body, or modes of its own",
                got=f"{path}, line {line}: mode {words[column]}",
                allowed="1 to 6",
            )


def _number(word: str) -> float:
    """The value of a word, NaN for what is none; Fortran writes D for E at times."""
    try:
        return float(word.upper().replace("D", "E"))
    except ValueError:
        return math.nan
