"""Sections cut from a panel mesh: planes across the ship, chained along the edges of its triangles."""

from itertools import pairwise

import numpy as np

from panelsim.conventions import FloatArray, IntArray, panel_centres, panel_triangles
from panelsim.errors import PanelsimError
from panelsim.hull.immersed import immersed_triangles
from panelsim.hydro.strip.sections import FEWEST_SECTIONS, HullSections, Section

Edge = tuple[int, int]
_SAME_POINT = 1e-7  # share of the size of an outline within which two of its points are one
_DUST = 1e-8  # share of the largest piece's area below which a piece is left by rounding


def sections_of_mesh(vertices: FloatArray, panels: IntArray, waterline: float, count: int) -> HullSections:
    """Cut the wet hull into `count` strips of equal length and take the section in the middle of each.

    `vertices` (V, 3) [m] in ship axes, `panels` (N, 4) with normals out of the hull, `waterline` the height
    of the water at rest [m]. Raises PanelsimError for fewer than five strips, a hull that is dry, or a
    section that does not close.
    """
    if not isinstance(count, int | np.integer) or count < FEWEST_SECTIONS:
        raise PanelsimError(
            "There are too few sections for strip theory",
            got=count,
            allowed=f"a whole number, {FEWEST_SECTIONS} or more; 20 to 40 are usual",
        )
    aft, fore = wet_ends(vertices, panels, waterline)
    edges = np.linspace(aft, fore, count + 1)
    middles = 0.5 * (edges[1:] + edges[:-1])
    return HullSections(
        tuple(section_of_mesh(vertices, panels, waterline, float(x)) for x in middles), aft, fore
    )


def wet_ends(vertices: FloatArray, panels: IntArray, waterline: float) -> tuple[float, float]:
    """The aftmost and the foremost x [m] of the hull below the water; arguments as in `sections_of_mesh`."""
    triangles = panel_triangles(vertices, panels).reshape(-1, 3, 3)
    corners, _ = immersed_triangles(triangles, waterline)
    if len(corners) == 0:
        raise PanelsimError(
            "No part of the hull lies under the water at rest",
            got=f"lowest point {vertices[:, 2].min():.3g} m, water at {waterline:.3g} m",
        )
    return float(corners[..., 0].min()), float(corners[..., 0].max())


def section_of_mesh(vertices: FloatArray, panels: IntArray, waterline: float, x: float) -> Section:
    """The wet section at one x [m]; a vertex on the plane counts as ahead of it.

    For the section at a flat transom ask for an x a little ahead of it. Arguments as in `sections_of_mesh`.
    """
    pieces = [piece for chain in _chains(vertices, panels, x) for piece in _wet_pieces(chain, waterline, x)]
    areas = np.array([abs(_area(piece, waterline)) for piece in pieces])
    if len(pieces) == 0 or areas.max() == 0.0:
        raise PanelsimError(
            f"The hull is dry at x = {x:g} m", allowed="a station that lies between the ends of the wet hull"
        )
    real = np.flatnonzero(areas > _DUST * areas.max())
    if len(real) > 1:
        raise PanelsimError(
            f"The section at x = {x:g} m falls into separate parts below the water",
            got=f"{len(real)} parts of {', '.join(f'{a:.3g}' for a in areas[real])} m2",
            allowed="one part: hulls side by side or above each other are not supported",
        )
    return Section(x, pieces[real[0]], waterline)


def _chains(vertices: FloatArray, panels: IntArray, x: float) -> list[FloatArray]:
    """Polylines (P, 2) in which the plane at x meets the mesh, the water on their right hand.

    A triangle's part leads from the edge that runs through the plane astern to the edge that runs through it
    ahead. The neighbour begins with that edge, so parts join by the names of their edges. Closed chains
    repeat their first point.
    """
    corners = np.vstack([vertices, panel_centres(vertices, panels)])
    ahead = corners[:, 0] >= x
    middle = np.arange(len(panels)) + len(vertices)
    triangles = np.concatenate(
        [np.stack([middle, panels[:, i], panels[:, (i + 1) % 4]], axis=1) for i in range(4)]
    )
    state = ahead[triangles]
    follows: dict[Edge, Edge] = {}
    cut = state.any(axis=1) & ~state.all(axis=1)
    for triangle, side in zip(triangles[cut].tolist(), state[cut].tolist(), strict=True):
        start = end = (0, 0)
        for i, j in ((0, 1), (1, 2), (2, 0)):
            edge = (min(triangle[i], triangle[j]), max(triangle[i], triangle[j]))
            if side[i] and not side[j]:
                start = edge
            elif side[j] and not side[i]:
                end = edge
        if start != end:  # the same edge twice in the part without area of a triangular panel
            follows[start] = end
    return [_points(chain, corners, x) for chain in _follow(follows)]


def _follow(follows: dict[Edge, Edge]) -> list[list[Edge]]:
    """The chains of edges, open ones from their beginning, closed ones with the first edge repeated."""
    chains = []
    continued = set(follows.values())
    beginnings = [edge for edge in follows if edge not in continued]
    while follows:
        edge = beginnings.pop() if beginnings else next(iter(follows))
        chain = [edge]
        while edge in follows:
            edge = follows.pop(edge)
            chain.append(edge)
        chains.append(chain)
    return chains


def _points(chain: list[Edge], corners: FloatArray, x: float) -> FloatArray:
    a, b = (corners[list(ends)] for ends in zip(*chain, strict=True))
    share = (x - a[:, :1]) / (b[:, :1] - a[:, :1])
    points: FloatArray = (a + share * (b - a))[:, 1:]
    moves = np.hypot(*np.diff(points, axis=0).T) > _SAME_POINT * np.ptp(points, axis=0).max()
    return points[np.concatenate([[True], moves])]


def _wet_pieces(chain: FloatArray, waterline: float, x: float) -> list[FloatArray]:
    """The parts of a chain below the water, with their ends on it; a chain that is all wet as it is."""
    wet = chain[:, 1] < waterline
    size = float(np.ptp(chain, axis=0).max())
    closed = len(chain) > 3 and np.hypot(*(chain[-1] - chain[0])) <= _SAME_POINT * size
    if not closed and (wet[0] or wet[-1]):
        end = chain[0] if wet[0] else chain[-1]
        raise PanelsimError(
            f"The section at x = {x:g} m does not close",
            got=f"an open end at y = {end[0]:.3f}, z = {end[1]:.3f} m, below the water",
            allowed="a hull without holes below the water",
            remedy="mend the mesh: panelsim check says where it is open",
        )
    if wet.all():
        return [chain]
    if closed:
        first = int(np.flatnonzero(~wet)[0])
        chain, wet = (
            np.vstack([chain[first:-1], chain[: first + 1]]),
            np.append(wet[first:-1], wet[: first + 1]),
        )
    edges = np.flatnonzero(wet[1:] != wet[:-1])
    pieces = []
    for down, up in pairwise(edges):
        if wet[down + 1]:
            ends = [_crossing(chain[i], chain[i + 1], waterline) for i in (down, up)]
            pieces.append(np.vstack([ends[0], chain[down + 1 : up + 1], ends[1]]))
    return [piece for piece in pieces if len(piece) > 2]


def _crossing(a: FloatArray, b: FloatArray, waterline: float) -> FloatArray:
    return np.array([a[0] + (waterline - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), waterline])


def _area(piece: FloatArray, waterline: float) -> float:
    y, z = piece[:, 0], piece[:, 1] - waterline
    return float(0.5 * np.sum(y[:-1] * z[1:] - y[1:] * z[:-1]))
