"""A history as CSV files, for spreadsheets and other programs."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.files import replacing
from panelsim.motion.history import History
from panelsim.motion.point_motions import point_signals
from panelsim.ship.points import POINT_UNITS

MOTION_UNITS = ("m",) * 3 + ("rad",) * 3
LOAD_UNITS = ("N",) * 3 + ("N m",) * 3
CSV_FILES = ("motions.csv", "loads.csv")


def history_to_csv(history: History, folder: str | Path) -> tuple[Path, Path]:
    """Write motions.csv and loads.csv into `folder`, both or neither, and return their paths.

    What a named point of the ship does follows the motions, with the name of the point in front.
    Units in the header, SI and radians; every number with the digits that give it back bit for bit.
    """
    motions = [("time [s]", history.time), ("wave_elevation [m]", history.wave_elevation)]
    for name, suffix in (("displacement", ""), ("velocity", "/s"), ("acceleration", "/s2")):
        motions += _columns(name, [u + suffix for u in MOTION_UNITS], getattr(history, name))
    for point, dataset in history.points.items():
        motions += [
            (f"{point}_{name} [{POINT_UNITS[name]}]", column)
            for name, column in point_signals(dataset).items()
        ]
    loads = [("time [s]", history.time)]
    for name, values in history.loads.items():
        loads += _columns(name, LOAD_UNITS, values)
    motions_path, loads_path = (Path(folder) / name for name in CSV_FILES)
    with replacing(motions_path) as motions_beside, replacing(loads_path) as loads_beside:
        _write(motions_beside, motions)
        _write(loads_beside, loads)
    return motions_path, loads_path


def _columns(name: str, units: Sequence[str], values: FloatArray) -> list[tuple[str, FloatArray]]:
    heads = [f"{name}_{dof} [{unit}]" for dof, unit in zip(DOF_NAMES, units, strict=True)]
    return list(zip(heads, values.T, strict=True))


def _write(path: Path, columns: list[tuple[str, FloatArray]]) -> None:
    heads, values = zip(*columns, strict=True)
    np.savetxt(path, np.column_stack(values), fmt="%s", delimiter=",", header=",".join(heads), comments="")
