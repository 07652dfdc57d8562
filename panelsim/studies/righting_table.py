"""Righting arms as a CSV file."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from panelsim.files import replacing
from panelsim.ship.righting_arms import RightingArms

_DECIMALS = 6


def write_righting_arms(path: Path, curves: Sequence[RightingArms]) -> Path:
    """Write curves of the same heels side by side: arm, heave and trim of each, in m and degrees.

    To a micrometre and a millionth of a degree.
    """
    heads, columns = ["heel [deg]"], [np.degrees(curves[0].heel)]
    for curve in curves:
        water = curve.water.replace(" ", "_")
        heads += [f"righting_arm_{water} [m]", f"heave_{water} [m]", f"trim_{water} [deg]"]
        columns += [curve.arm, curve.heave, np.degrees(curve.trim)]
    with replacing(path) as beside:
        np.savetxt(
            beside,
            np.round(np.column_stack(columns), _DECIMALS) + 0.0,  # a -0 is written as 0
            fmt="%.9g",
            delimiter=",",
            header=",".join(heads),
            comments="",
        )
    return path
