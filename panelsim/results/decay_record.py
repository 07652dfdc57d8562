"""The record of a roll decay: from a history of a run, or from a CSV file of a model test."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.motion.history import History

TIME_COLUMN = "time [s]"
# What a column of roll is called, and the radians in its unit; the last is that of `panelsim export`.
ROLL_COLUMNS = {"roll [deg]": np.pi / 180.0, "roll [rad]": 1.0, "displacement_roll [rad]": 1.0}


@dataclass(frozen=True, eq=False)
class DecayRecord:
    """Roll from its release on: `time` (N,) [s] and `roll` (N,) [rad]; `name` of the ship or of the file."""

    time: FloatArray
    roll: FloatArray
    name: str = ""

    @classmethod
    def of_history(cls, history: History) -> "DecayRecord":
        """The roll of a run; raises PanelsimError for a run in waves, which is no free decay."""
        if history.components.count:
            raise PanelsimError(
                "A roll decay is one in calm water",
                got=f"a history in {history.components.count} wave component(s)",
                remedy="run it with seaway.kind = calm and an initial heel, or give the case file itself",
            )
        rows = history.finite
        return cls(history.time[rows], history.displacement[rows, Dof.ROLL], history.ship_name)

    @classmethod
    def read_csv(cls, path: Path) -> "DecayRecord":
        """Read the columns "time [s]" and "roll [deg]" or "roll [rad]"; others may stand beside them.

        Raises PanelsimError that names the columns, or the line that holds no numbers.
        """
        try:
            rows = list(csv.reader(path.read_text(encoding="utf-8-sig").splitlines()))
        except (UnicodeDecodeError, csv.Error) as error:
            raise PanelsimError("The decay record is not text in UTF-8", got=path) from error
        heads = [head.strip() for head in rows[0]] if rows else []
        known = [name for name in ROLL_COLUMNS if name in heads]
        if TIME_COLUMN not in heads or len(known) != 1:
            raise PanelsimError(
                "The decay record does not begin with the names of its columns",
                got=", ".join(heads)[:200] or "an empty file",
                allowed=f"{TIME_COLUMN}, and one of {', '.join(ROLL_COLUMNS)}",
            )
        places = heads.index(TIME_COLUMN), heads.index(known[0])
        lines = [(i, row) for i, row in enumerate(rows[1:], 2) if row]
        for line, row in lines:
            if len(row) != len(heads):
                raise PanelsimError(
                    f"{path}, line {line} has another number of columns than the first line",
                    got=f"{len(row)}: {','.join(row)[:100]}",
                    allowed=f"{len(heads)}: {','.join(heads)[:100]}",
                )
        numbers = np.array([_numbers(path, line, row, places) for line, row in lines])
        time, roll = numbers.reshape(-1, 2).T
        for (line, _), before, after in zip(lines[1:], time[:-1], time[1:], strict=True):
            if after <= before:
                raise PanelsimError(
                    f"{path}, line {line}: the time does not increase",
                    got=f"{after:g} s after {before:g} s",
                    allowed="each time after the one before [s]",
                )
        return cls(time, ROLL_COLUMNS[known[0]] * roll, path.name)


def _numbers(path: Path, line: int, row: list[str], places: tuple[int, int]) -> list[float]:
    try:
        values = [float(row[place]) for place in places]
    except ValueError:
        values = [np.nan]
    if not np.isfinite(values).all():
        raise PanelsimError(
            f"{path}, line {line} holds no time and roll", got=",".join(row)[:100], allowed="finite numbers"
        )
    return values
