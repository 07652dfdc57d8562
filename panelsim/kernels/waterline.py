"""Where a hull surface leaves the water: the cuts of its panels, chained into polygons."""

from collections import defaultdict

import numpy as np

from panelsim.conventions import FloatArray, IntArray
from panelsim.kernels.tables import PanelTables, require_rule
from panelsim.kernels.wet_part import fan_points, with_mean_centres

SAME_POINT = 1e-11  # of the hull's size: points of a waterline that are closer are one


def waterlines(
    panels: PanelTables, submergence: FloatArray, rule: str
) -> tuple[tuple[FloatArray, ...], tuple[FloatArray, ...]]:
    """Closed polygons and open lines, each (K, 3) [m] in ship axes, that bound the wet part of a surface.

    `submergence` (P,): the depth below the surface [m] at the points, linear on the four triangles of each
    panel; depth 0 is dry. Seen from above, a polygon runs counter-clockwise round the hull and clockwise
    round water within it; it does not repeat its first point. By the rule "panel" it follows the edges
    between wet and dry panels. An open line ends at the rim of an open surface; a closed one has none.

    Each edge of the triangles that is wet at one end and dry at the other has one point, where depth
    is 0, and each triangle that the surface cuts joins two of them, so the chain never asks what lies near
    what. Points that coincide, where the surface passes through a vertex, become one, and what then has
    fewer than three points, a mere touch, is left out. A panel wholly on the surface is dry: the line runs
    round it if its neighbours are wet, and passes it by if they are dry.
    """
    require_rule(rule)
    start, end, points = (
        _rims_of_wet_panels(panels, submergence)
        if rule == "panel"
        else _cuts(panels, with_mean_centres(panels, submergence) if rule == "vertex" else submergence)
    )
    closed, open_lines = _chained(start, end)
    tolerance = SAME_POINT * float(np.ptp(panels.points[panels.panels].reshape(-1, 3), axis=0).max())
    polygons = (_without_repeats(points[chain], tolerance) for chain in closed)
    lines = (_without_repeats(points[chain], tolerance) for chain in open_lines)
    return (
        tuple(polygon for polygon in polygons if len(polygon) > 2),
        tuple(line for line in lines if len(line) > 1),
    )


def _cuts(panels: PanelTables, submergence: FloatArray) -> tuple[IntArray, IntArray, FloatArray]:
    """Segments where the surface cuts triangles, from one point (K, 3) to another; the dry part on the left.

    A triangle with its corners in the order seen from the water is left, wet to dry, on one edge
    and entered again on another; the segment runs from the entry back to the exit.
    """
    here = fan_points(panels).reshape(-1, 3)
    there = np.roll(here, -1, axis=1)
    wet_here, wet_there = submergence[here] > 0.0, submergence[there] > 0.0
    count = len(panels.points)
    entry = (here + there * count)[~wet_here & wet_there]
    leave = (there + here * count)[wet_here & ~wet_there]
    edges, node = np.unique(np.concatenate([entry, leave]), return_inverse=True)
    wet, dry = np.divmod(edges, count)
    t = (submergence[wet] / (submergence[wet] - submergence[dry]))[:, None]
    # So written, the cut through a dry vertex exactly on the surface is that vertex to the last bit.
    points = (1.0 - t) * panels.points[wet] + t * panels.points[dry]
    return node[: len(entry)], node[len(entry) :], points


def _rims_of_wet_panels(
    panels: PanelTables, submergence: FloatArray
) -> tuple[IntArray, IntArray, FloatArray]:
    """Edges of the panels with a wet centre that no other of them shares, reversed; their points (P, 3)."""
    wet = submergence[panels.first_centre : panels.first_centre + len(panels.panels)] > 0.0
    here = panels.panels[wet].astype(np.int64)
    there = np.roll(here, -1, axis=1)
    count = len(panels.points)
    alone = ~np.isin(here * count + there, there * count + here)
    return there[alone], here[alone], panels.points


def _chained(start: IntArray, end: IntArray) -> tuple[list[list[int]], list[list[int]]]:
    """Closed and open chains of the segments from `start` (K,) to `end` (K,), no chain twice at one node."""
    onward: dict[int, list[int]] = defaultdict(list)
    for here, there in zip(start.tolist(), end.tolist(), strict=True):
        onward[here].append(there)
    loose = sorted(set(onward) - set(end.tolist()))
    closed, open_chains = [], []
    for first in [*loose, *onward]:
        path, place = [first], {first: 0}
        while onward.get(path[-1]):
            node = onward[path[-1]].pop()
            if node in place:
                loop = path[place[node] :]
                closed.append(loop)
                for passed in loop[1:]:
                    del place[passed]
                del path[place[node] + 1 :]
            else:
                place[node] = len(path)
                path.append(node)
        if len(path) > 1:
            open_chains.append(path)
    return closed, open_chains


def _without_repeats(points: FloatArray, tolerance: float) -> FloatArray:
    """Points (K, 3) of a chain without those that coincide with the one before, round and round."""
    distance = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1)
    return points[distance > tolerance]
