"""WAMIT geometric data files: text, flat quadrilateral panels, optional planes of symmetry."""

from pathlib import Path

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY, FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hull.panel_mesh import PanelMesh

FOOT = 0.3048  # m
CORNER_NUMBERS = 12  # four corners of three coordinates a panel


def read_gdf(path: Path, metres_per_unit: float) -> tuple[FloatArray, IntArray]:
    """Read vertices (4 N, 3) in file units and panels (N, 4), planes of symmetry unfolded.

    Low-order GDF, WAMIT user manual chapter 6: a title, ULEN and GRAV, ISX and ISY, the panel count, then
    four corners a panel, counter-clockwise seen from the water. ULEN only makes WAMIT's results
    non-dimensional and does not scale coordinates. Raises PanelsimError for a file that is cut short or
    is not of this form, and where GRAV says another unit than metres_per_unit.
    """
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    try:
        gravity = float(lines[1].split()[1])
        symmetry = [int(word) for word in lines[2].split()[:2]]
        panel_count = int(lines[3].split()[0])
        numbers = np.array(" ".join(lines[4:]).split(), dtype=np.float64)
    except (IndexError, ValueError) as error:
        raise PanelsimError(
            f"{path.name} is not a low-order GDF file",
            got=str(error),
            allowed="a title; ULEN GRAV; ISX ISY; the panel count; 12 numbers a panel",
        ) from error
    if len(numbers) != CORNER_NUMBERS * panel_count:
        raise PanelsimError(
            f"{path.name} is cut short or has a wrong panel count",
            got=f"{len(numbers)} coordinates for {panel_count} panels",
            allowed=f"{CORNER_NUMBERS * panel_count} coordinates",
        )
    if len(symmetry) != 2 or not set(symmetry) <= {0, 1}:
        raise PanelsimError(
            f"{path.name} has a symmetry that panelsim does not read",
            got=f"ISX ISY = {' '.join(map(str, symmetry))}",
            allowed="0 or 1 each",
        )
    _require_same_unit(path, gravity, metres_per_unit)

    corners = numbers.reshape(-1, 4, 3)
    for axis, mirrored in enumerate(symmetry):
        if mirrored:
            sign = np.where(np.arange(3) == axis, -1.0, 1.0)
            corners = np.concatenate([corners, (corners * sign)[:, ::-1]])
    return corners.reshape(-1, 3), np.arange(4 * len(corners)).reshape(-1, 4)


def _require_same_unit(path: Path, gravity: float, metres_per_unit: float) -> None:
    """Refuse a length unit other than the one GRAV is written in; other values of GRAV say nothing."""
    for unit, metres in (("metres", 1.0), ("feet", FOOT)):
        says_unit = abs(gravity * metres / STANDARD_GRAVITY - 1.0) < 0.01
        if says_unit and abs(metres_per_unit / metres - 1.0) > 0.01:
            raise PanelsimError(
                f"{path.name} is in {unit}, by its gravity",
                got=f"GRAV {gravity:g} with a length unit of {metres_per_unit:g} m",
                allowed=f"length_unit {metres:g} m",
            )


def gdf_text(mesh: PanelMesh) -> str:
    """A mesh as a GDF file: hull axes, metres, both sides, no digits lost."""
    lines = ["panelsim hull: x forward from midships, y to port, z up from the baseline"]
    lines += [f"1.0 {STANDARD_GRAVITY} ULEN GRAV", "0 0 ISX ISY", f"{mesh.panel_count}"]
    lines += [" ".join(map(repr, point.tolist())) for point in mesh.vertices[mesh.panels].reshape(-1, 3)]
    return "\n".join(lines) + "\n"
