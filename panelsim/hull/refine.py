"""Finer panels on the same surface."""

import numpy as np

from panelsim.conventions import IntArray
from panelsim.hull.panel_mesh import PanelMesh


def subdivided(mesh: PanelMesh) -> PanelMesh:
    """Every panel split into four at the midpoints of its edges; a closed mesh stays closed.

    A quadrilateral gets its four corners' mean as a new vertex, so the surface changes only where panels are
    twisted. A triangle becomes four triangles.
    """
    ends = np.stack([mesh.panels, np.roll(mesh.panels, -1, axis=1)], axis=-1)
    edges, which = np.unique(np.sort(ends.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    vertices = np.concatenate(
        [
            mesh.vertices,
            mesh.vertices[edges].mean(axis=1),
            mesh.vertices[mesh.panels].mean(axis=1),
        ]
    )
    middle = len(mesh.vertices) + which.reshape(-1, 4)
    center = len(mesh.vertices) + len(edges) + np.arange(mesh.panel_count)
    triangle = mesh.panels[:, 2] == mesh.panels[:, 3]
    quads = _quads_of_quads(mesh.panels[~triangle], middle[~triangle], center[~triangle])
    triangles = _triangles_of_triangles(mesh.panels[triangle], middle[triangle])
    panels = np.concatenate([quads, triangles])
    used, panels = np.unique(panels, return_inverse=True)
    return PanelMesh(vertices[used], panels.reshape(-1, 4))


def _quads_of_quads(corners: IntArray, middle: IntArray, center: IntArray) -> IntArray:
    """One quadrilateral at each corner."""
    before = np.roll(middle, 1, axis=1)
    return np.concatenate(
        [np.column_stack([corners[:, i], middle[:, i], center, before[:, i]]) for i in range(4)]
    )


def _triangles_of_triangles(corners: IntArray, middle: IntArray) -> IntArray:
    """One triangle at each corner and one between; edge 2 of a triangle written as a quad is no edge."""
    a, b, c = corners[:, :3].T
    ab, bc, ca = middle[:, 0], middle[:, 1], middle[:, 3]
    return np.concatenate(
        [np.column_stack([*t, t[2]]) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    )
