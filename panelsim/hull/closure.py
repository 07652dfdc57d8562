"""Closing a hull: strips of panels over deck and transom, and the mirror that makes starboard of port."""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.hull.panel_mesh import PanelMesh


class PortHalf:
    """Vertices and outward panels of the port half while it is put together."""

    def __init__(self) -> None:
        self.vertices: list[FloatArray] = []
        self.panels: list[list[int]] = []

    def add(self, points: FloatArray) -> list[int]:
        """Take in points (P, 3); returns their indices."""
        first = len(self.vertices)
        self.vertices.extend(points)
        return list(range(first, first + len(points)))

    def across(self, edge: int, cell_width: float) -> list[int]:
        """A level row of vertices from the centreline to the vertex `edge`, about `cell_width` m apart."""
        half_breadth = self.vertices[edge][1]
        if half_breadth == 0.0:
            return [edge]
        cells = max(1, round(half_breadth / cell_width))
        row = np.repeat(self.vertices[edge][None], cells, axis=0)
        row[:, 1] *= np.arange(cells) / cells
        return [*self.add(row), edge]

    def strip(self, first: list[int], second: list[int]) -> None:
        """Panels between two rows of vertices, `second` to the left of `first` seen from the water.

        Quadrilaterals, and a triangle wherever one row would get ahead by half a cell.
        """
        i = j = 0
        cells, other_cells = len(first) - 1, len(second) - 1
        half_cell = 0.5 / max(cells, other_cells)
        while i < cells or j < other_cells:
            next_first = (i + 1) / cells if i < cells else np.inf
            next_second = (j + 1) / other_cells if j < other_cells else np.inf
            if next_first < next_second - half_cell:
                self.panels.append([first[i], first[i + 1], second[j], second[j]])
                i += 1
            elif next_second < next_first - half_cell:
                self.panels.append([first[i], second[j + 1], second[j], second[j]])
                j += 1
            else:
                self.panels.append([first[i], first[i + 1], second[j + 1], second[j]])
                i, j = i + 1, j + 1

    def mirrored(self) -> PanelMesh:
        """The whole hull; starboard repeats port with -y bit for bit and shares the vertices at y = 0."""
        vertices = np.array(self.vertices)
        port = np.array(self.panels, dtype=np.int64)
        off_centre = vertices[:, 1] != 0.0
        image = np.arange(len(vertices))
        image[off_centre] = len(vertices) + np.arange(np.count_nonzero(off_centre))
        # A triangle keeps its repeated vertex third and fourth; the reversal would put it elsewhere.
        triangle = (port[:, 2] == port[:, 3])[:, None]
        starboard = image[np.where(triangle, port[:, [0, 2, 1, 1]], port[:, [0, 3, 2, 1]])]
        mirrored = vertices[off_centre] * np.array([1.0, -1.0, 1.0])
        return PanelMesh(np.vstack([vertices, mirrored]), np.vstack([port, starboard]))
