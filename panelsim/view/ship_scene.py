"""The moving hull and the sea around it, as they go into a recording."""

import numpy as np
from scipy.spatial.transform import Rotation

from panelsim.conventions import FloatArray, IntArray
from panelsim.motion.history import History
from panelsim.view.surfaces import GRID_REACH, SEA_OPACITY, SeaGrid, hull_colors, pressure_head
from panelsim.view.tape import Tape

# Frames sent in one call: one at a time is twice as slow, a hundred at once slower still.
BATCH = 25


def send_hull(tape: Tape, history: History, rows: IntArray, world: str = "world") -> None:
    """The hull under `world`, and how it lies and is coloured at these rows.

    The shape goes in once, without the colours: what is static hides all that comes later.
    """
    import rerun as rr

    corners, triangles, normals = _faceted(history)
    shape = rr.Mesh3D(vertex_positions=corners, triangle_indices=triangles, vertex_normals=normals)
    tape.stream.log(f"{world}/ship/hull", shape, static=True)
    for batch in tape.batches(rows, BATCH):
        attitude = Rotation.from_euler("ZYX", history.displacement[batch, :2:-1]).as_quat()
        pose = rr.Transform3D.columns(translation=history.displacement[batch, :3], quaternion=attitude)
        tape.send(f"{world}/ship", batch, pose)
        colors = [hull_colors(history, pressure_head(history, row))[history.panels].ravel() for row in batch]
        columns = rr.Mesh3D.columns(vertex_colors=np.concatenate(colors))
        tape.send(f"{world}/ship/hull", batch, columns.partition([len(corners)] * len(batch)))


def send_sea(
    tape: Tape, history: History, rows: IntArray, world: str = "world", lengths: float = GRID_REACH
) -> None:
    """The wave surface under `world`, out to so many ship lengths on every side, at these rows."""
    import rerun as rr

    sea = SeaGrid.around(history, lengths)
    highest = max(float(np.abs(history.wave_elevation).max()), 1e-3)
    surface = rr.Mesh3D.from_fields(triangle_indices=sea.triangles, albedo_factor=0xFFFFFF00 | SEA_OPACITY)
    tape.stream.log(f"{world}/sea", surface, static=True)
    for batch in tape.batches(rows, BATCH):
        heights = [sea.elevation(row) for row in batch]
        points = [sea.vertices(row, height) for row, height in zip(batch, heights, strict=True)]
        columns = rr.Mesh3D.columns(
            vertex_positions=np.concatenate(points),
            vertex_colors=np.concatenate([sea.colors(height, highest) for height in heights]),
        )
        tape.send(f"{world}/sea", batch, columns.partition([len(points[0])] * len(batch)))


def _faceted(history: History) -> tuple[FloatArray, IntArray, FloatArray]:
    """Corners (4 N, 3), triangles (2 N, 3) and normals (4 N, 3) of a hull whose panels share no corner.

    So each panel is shaded as the flat facet that it is, and edges of deck and transom stay sharp.
    """
    corners = history.mesh_vertices[history.panels]
    area = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals = area / np.linalg.norm(area, axis=1, keepdims=True)
    first = 4 * np.arange(len(corners))[:, None]
    triangles = np.concatenate([first + np.array([0, 1, 2]), first + np.array([0, 2, 3])])
    return corners.reshape(-1, 3), triangles, np.repeat(normals, 4, axis=0)
