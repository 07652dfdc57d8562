"""Wavefront OBJ files, read and written with their quadrilaterals whole.

A general reader would split the quadrilaterals, and would pass over the faces that a file cut short lacks.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np

from panelsim.conventions import FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hull.panel_mesh import PanelMesh


def read_obj(path: Path) -> tuple[FloatArray, IntArray]:
    """Read vertices (V, 3) in file units and panels (N, 4); a face of over four corners becomes a fan.

    Only `v` and `f` records count; textures, normals, groups and materials are passed over. Raises
    PanelsimError naming the line that cannot be read, or a face whose vertices are not in the file.
    """
    vertices: list[list[float]] = []
    panels: list[list[int]] = []
    text = path.read_text(encoding="utf-8", errors="replace")
    for number, line in enumerate(text.splitlines(), start=1):
        record, *words = line.split("#", 1)[0].split() or [""]
        try:
            if record == "v":
                x, y, z = (float(word) for word in words[:3])
                vertices.append([x, y, z])
            elif record == "f":
                panels += _fan([_index(word, len(vertices)) for word in words])
        except ValueError as error:
            raise PanelsimError(
                f"Line {number} of {path.name} cannot be read; the file may be cut short", got=line
            ) from error
    if panels and np.max(panels) >= len(vertices):
        raise PanelsimError(
            f"{path.name} is cut short: a face names a vertex that is not in it",
            got=f"vertex {np.max(panels) + 1} of {len(vertices)}",
        )
    return np.array(vertices).reshape(-1, 3), np.array(panels, dtype=np.int64).reshape(-1, 4)


def _index(word: str, vertex_count: int) -> int:
    """Zero-based index of a face corner `v/vt/vn`; negative numbers count back from the last vertex."""
    index = int(word.split("/", 1)[0])
    index = index - 1 if index > 0 else vertex_count + index
    if index < 0 or word.startswith("0"):
        raise ValueError("no such vertex")
    return index


def _fan(corners: list[int]) -> list[list[int]]:
    """A face as panels: triangles with the third corner repeated, quadrilaterals whole, else a fan."""
    if len(corners) < 3:
        raise ValueError("fewer than three corners")
    if len(corners) == 4:
        return [corners]
    return [[corners[0], b, c, c] for b, c in pairwise(corners[1:])]


def obj_text(mesh: PanelMesh) -> str:
    """A mesh as an OBJ file: hull axes, metres, no digits lost."""
    lines = ["# panelsim hull: metres, x forward from midships, y to port, z up from the baseline"]
    lines += ["v " + " ".join(map(repr, point)) for point in mesh.vertices.tolist()]
    lines += ["f " + " ".join(map(str, dict.fromkeys(panel))) for panel in (mesh.panels + 1).tolist()]
    return "\n".join(lines) + "\n"
