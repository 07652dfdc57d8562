"""The faults a panel mesh can have, each found by its own function; `checks` makes a report of them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from panelsim.conventions import FloatArray, IntArray
from panelsim.hull.panel_mesh import PanelMesh

ZERO_AREA = 1e-6  # of the mean panel area
LARGEST_ASPECT = 50.0  # longest edge squared over area; 1 for a square
LARGEST_WARP = 0.1  # distance of the corners from the mean plane, over the longest edge
NAMED = 10  # bad panels named in a message


def unreadable(mesh: PanelMesh) -> str | None:
    """Why nothing more can be said of this mesh, if so."""
    vertices, panels = mesh.vertices, mesh.panels
    if vertices.ndim != 2 or vertices.shape[1:] != (3,) or panels.ndim != 2 or panels.shape[1:] != (4,):
        return f"arrays are not (V, 3) and (N, 4): {vertices.shape} and {panels.shape}"
    if len(panels) == 0:
        return "the mesh has no panels"
    if panels.min() < 0 or panels.max() >= len(vertices):
        return f"panels name vertices outside 0 to {len(vertices) - 1}"
    if not np.isfinite(vertices).all():
        return f"{np.sum(~np.isfinite(vertices).all(axis=1))} vertices are not finite numbers"
    return None


def degenerate_panels(mesh: PanelMesh) -> IntArray:
    """Panels of no area, and those whose corners repeat in another way than a triangle's."""
    a, b, c, d = mesh.panels.T
    repeated = (a == b) | (b == c) | (a == c) | (a == d) | (b == d)
    return np.flatnonzero(repeated | (mesh.area <= ZERO_AREA * mesh.area.mean()))


def duplicate_panels(mesh: PanelMesh) -> IntArray:
    """Panels on the same vertices as an earlier one."""
    _, first = np.unique(_vertex_sets(mesh.panels), axis=0, return_index=True)
    return np.setdiff1d(np.arange(len(mesh.panels)), first)


def edge_problems(mesh: PanelMesh) -> list[str]:
    """Edges that are not shared by exactly two panels in opposite senses, and the panels they belong to."""
    start = mesh.panels.ravel()
    end = np.roll(mesh.panels, -1, axis=1).ravel()
    panel = np.repeat(np.arange(len(mesh.panels)), 4)
    real = start != end  # a triangle's third vertex is repeated
    start, end, panel = start[real], end[real], panel[real]
    pairs = np.stack([np.minimum(start, end), np.maximum(start, end)], axis=1)
    _, edge, uses = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    turn = np.zeros(len(uses), dtype=np.int64)
    np.add.at(turn, edge, np.where(start < end, 1, -1))
    kinds = (
        ("lie at the rim of a hole", uses == 1),
        ("meet more than one other panel at an edge", uses > 2),
        ("are turned against their neighbour, one of the two faces inward", (uses == 2) & (turn != 0)),
    )
    problems: list[str] = []
    for text, bad in kinds:
        problems += named(f"panels {text} ({bad.sum()} edges)", np.unique(panel[bad[edge]]))
    return problems


def connected_parts(mesh: PanelMesh) -> tuple[int, IntArray]:
    """Number of connected parts, and the part (N,) each panel belongs to."""
    row = mesh.panels[:, [0, 1, 2]].ravel()
    column = mesh.panels[:, [1, 2, 3]].ravel()
    links = coo_array((np.ones(len(row)), (row, column)), shape=(len(mesh.vertices),) * 2)
    _, label = connected_components(links, directed=False)
    parts, component = np.unique(label[mesh.panels[:, 0]], return_inverse=True)
    return len(parts), component


def volume_shares(mesh: PanelMesh, origin: FloatArray) -> FloatArray:
    """What each panel (N,) adds to the volume inside the surface [m3]."""
    a, b, c = np.moveaxis(mesh.triangles - origin, 2, 0)
    shares: FloatArray = np.einsum("ntx,ntx->n", a, np.cross(b, c)) / 6.0
    return shares


def inside_out_parts(mesh: PanelMesh, component_count: int, component: IntArray) -> list[str]:
    """Connected parts of negative volume: their normals point into the hull."""
    problems = []
    for part in range(component_count):
        panels = np.flatnonzero(component == part)
        middle = mesh.vertices[mesh.panels[panels]].mean(axis=(0, 1))
        volume = volume_shares(mesh, middle)[panels].sum()
        if volume <= 0.0:
            name = "the mesh" if component_count == 1 else f"part {part + 1} of {component_count}"
            problems.append(f"{name} ({len(panels)} panels) is inside out, volume {volume:.4g} m3")
    return problems


def is_symmetric(mesh: PanelMesh, tolerance: float) -> bool:
    """Whether every panel has a mirror image in the plane y = 0, vertices within the tolerance [m]."""
    tree = cKDTree(mesh.vertices)
    distance, image = tree.query(mesh.vertices * np.array([1.0, -1.0, 1.0]))
    if distance[np.unique(mesh.panels)].max() > tolerance:
        return False
    here = np.unique(_vertex_sets(mesh.panels), axis=0)
    there = np.unique(_vertex_sets(image[mesh.panels]), axis=0)
    return bool(np.array_equal(here, there))


def _vertex_sets(panels: IntArray) -> IntArray:
    """Corners (N, 4) in rising order, so that a panel is known whichever corner it starts from."""
    corners = panels.copy()
    corners[panels[:, 2] == panels[:, 3], 3] = -1  # which corner of a triangle repeats says nothing
    return np.sort(corners, axis=1)


def shape_warnings(mesh: PanelMesh, degenerate: IntArray) -> list[str]:
    """Slivers, twisted and folded quadrilaterals; degenerate panels apart."""
    corners = mesh.vertices[mesh.panels]
    longest = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).max(axis=1)
    sound: NDArray[np.bool_] = np.ones(len(mesh.panels), dtype=bool)
    sound[degenerate] = False
    area = np.where(sound, mesh.area, 1.0)
    normal = mesh.area_vector / area[:, None]
    twist = corners[:, 0] - corners[:, 1] + corners[:, 2] - corners[:, 3]
    quadrilateral = mesh.panels[:, 2] != mesh.panels[:, 3]
    warp = np.abs(np.einsum("nx,nx->n", twist, normal)) / (4.0 * np.where(sound, longest, 1.0))
    onward, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    facing = np.einsum("ncx,nx->nc", np.cross(onward, back), normal)
    folded = facing.min(axis=1) < -ZERO_AREA * area
    aspect_text = f"panels are slivers (longest edge squared over {LARGEST_ASPECT:g} times the area)"
    return [
        *named(aspect_text, np.flatnonzero(sound & (longest**2 > LARGEST_ASPECT * area))),
        *named(
            f"panels are twisted by more than {LARGEST_WARP:g} of their longest edge",
            np.flatnonzero(sound & quadrilateral & (warp > LARGEST_WARP)),
        ),
        *named("panels have a re-entrant corner or cross themselves", np.flatnonzero(sound & folded)),
    ]


def vertex_warnings(mesh: PanelMesh, tolerance: float, open_edges: Sequence[str]) -> list[str]:
    """Vertices that no panel uses, and, where the mesh is open, those that were perhaps not merged."""
    warnings = []
    unused = len(mesh.vertices) - len(np.unique(mesh.panels))
    if unused:
        warnings.append(f"{unused} vertices belong to no panel")
    if open_edges:
        close = len(cKDTree(mesh.vertices).query_pairs(tolerance, output_type="ndarray"))
        if close:
            warnings.append(f"{close} pairs of vertices lie within {tolerance:.2g} m but are not merged")
    return warnings


def named(text: str, panels: IntArray) -> list[str]:
    """A finding with its count and the first panels by index; none where there are no such panels."""
    if len(panels) == 0:
        return []
    names = ", ".join(str(index) for index in panels[:NAMED])
    more = ", …" if len(panels) > NAMED else ""
    return [f"{len(panels)} {text}: {names}{more}"]
