"""The hull surface as flat-cornered panels: the one mesh type that everything downstream reads."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from panelsim.conventions import FloatArray, IntArray, panel_triangles


@dataclass(frozen=True)
class PanelMesh:
    """A closed surface of quadrilaterals in hull axes.

    `vertices` (V, 3) [m]: x forward from midships, y to port, z up from the baseline.
    `panels` (N, 4): vertex indices, counter-clockwise seen from the water, so that normals point
    out of the hull; a triangle repeats its third vertex.
    """

    vertices: FloatArray
    panels: IntArray

    def __post_init__(self) -> None:
        vertices = np.ascontiguousarray(self.vertices, dtype=np.float64).copy()
        panels = np.ascontiguousarray(self.panels, dtype=np.int64).copy()
        vertices.setflags(write=False)
        panels.setflags(write=False)
        object.__setattr__(self, "vertices", vertices)
        object.__setattr__(self, "panels", panels)

    @property
    def panel_count(self) -> int:
        return len(self.panels)

    @cached_property
    def area_vector(self) -> FloatArray:
        """Area times outward unit normal (N, 3) [m2]: half the cross product of the diagonals."""
        a, b, c, d = (self.vertices[self.panels[:, i]] for i in range(4))
        return 0.5 * np.cross(c - a, d - b)

    @cached_property
    def area(self) -> FloatArray:
        """Panel areas (N,) [m2]."""
        return np.linalg.norm(self.area_vector, axis=1)

    @cached_property
    def normal(self) -> FloatArray:
        """Outward unit normals (N, 3)."""
        return self.area_vector / self.area[:, None]

    @cached_property
    def centroid(self) -> FloatArray:
        """Panel centroids (N, 3) [m], the area mean over the triangles of the panel."""
        corners = self.triangles
        edges = corners[:, :, 1:] - corners[:, :, :1]
        areas = np.linalg.norm(np.cross(edges[:, :, 0], edges[:, :, 1]), axis=-1)
        return np.einsum("nt,ntx->nx", areas, corners.mean(axis=2)) / areas.sum(axis=1)[:, None]

    @cached_property
    def triangles(self) -> FloatArray:
        """The surface itself, four triangles (N, 4, 3, 3) [m] about the centre of each panel."""
        return panel_triangles(self.vertices, self.panels)

    def export(self, path: str | Path) -> None:
        """Write the mesh to an STL, OBJ, PLY, GLB or GDF file; see panelsim.hull.export.write_mesh."""
        from panelsim.hull.export import write_mesh

        write_mesh(self, path)
