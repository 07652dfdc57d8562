"""Panels that the water surface cuts: the exact integral over what is wet, less what is already counted.

A panel is four triangles about its centre. Head and submergence are linear on each of them, so the wet part
is a polygon; by the rule "vertex" the centre has the mean of the corners. `state` holds, row by row,
submergence and heads of the points [m]; `blocks` are those of `PanelTables`.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from panelsim.kernels import runtime
from panelsim.kernels.tables import LANES, QUADRILATERAL_BEND, TRIANGLE_BEND

ti = runtime.import_taichi()

LANE_BITS = LANES.bit_length() - 1  # LANES is a power of two

# Columns of PanelTables.blocks.
X, Y, Z, RESPONSE, REACH = 0, 1, 2, 3, 9
# Rows of the state of the points; Stokes' second order alone fills the last one.
SUBMERGENCE, HEAD, SURFACE_HEAD = 0, 1, 2
# What a cut needs of a point besides these two: the head at the surface, the head in the sum over the points.
TO_CUT, COUNTED = 2, 3
# How the heads go on above the surface, see `_trend`.
HEIGHT, ADDED, DEPTH = 0, 1, 2


@ti.func
def correct_cut_panel(
    blocks: ti.template(),
    state: ti.template(),
    panels: ti.template(),
    n,
    centre,
    with_centres,
    wheeler,
    second_order: ti.template(),
):
    """Load on the wet part of a panel minus what the sum over the points has counted."""
    shares, bend_share = ti.Vector([0.25, 0.25, 0.25, 0.25]), QUADRILATERAL_BEND
    if panels[n, 2] == panels[n, 3]:
        shares, bend_share = ti.Vector([2.0, 2.0, 1.0, 1.0]) / 6.0, TRIANGLE_BEND
    mean, mean_trend = ti.Vector.zero(ti.f64, 4), ti.Vector.zero(ti.f64, 3)
    position = ti.Vector.zero(ti.f64, 3)
    for c in ti.static(range(4)):
        values = _values(state, panels[n, c], wheeler, second_order)
        mean += shares[c] * values
        mean_trend += shares[c] * _trend(values, wheeler)
        position += shares[c] * _position(blocks, panels[n, c])
    middle, trend = mean, mean_trend
    if with_centres == 1:
        middle = _values(state, centre, wheeler, second_order)
        trend += _trend(middle, wheeler)
    growth = 0.0
    if trend[DEPTH] > 0.0:
        growth = trend[ADDED] / trend[DEPTH]
    # The heads of the corners go on above the surface, so that a mean of them is one of the water.
    mean[HEAD] += growth * mean_trend[HEIGHT]
    wet_bend, counted_bend = 0.0, 0.0
    if with_centres == 1:
        wet_bend = bend_share * (middle[HEAD] + growth * ti.min(middle[SUBMERGENCE], 0.0) - mean[HEAD])
        counted_bend = bend_share * (middle[COUNTED] - mean[COUNTED])
    else:
        middle[HEAD] = mean[HEAD]
    load = ti.Vector.zero(ti.f64, 6)
    for side in range(4):
        i, j = panels[n, side], panels[n, (side + 1) & 3]
        if i != j:
            load += _correct_triangle(
                middle,
                _values(state, i, wheeler, second_order),
                _values(state, j, wheeler, second_order),
                position,
                _position(blocks, i),
                _position(blocks, j),
                wet_bend,
                counted_bend,
            )
    return load


@ti.func
def _values(state: ti.template(), point, wheeler, second_order: ti.template()):
    """Submergence and heads of a point: its own, the one to interpolate to a cut, the one counted.

    Wheeler's head at the surface is Σ a cos θ - ζ whatever the depth of the point: zero, or minus
    the second order of the elevation. Without stretching it is the head of the point itself.
    """
    submergence, head = state[SUBMERGENCE, point], state[HEAD, point]
    to_cut, counted = head * (1.0 - wheeler), 0.0
    if ti.static(second_order):
        to_cut += wheeler * state[SURFACE_HEAD, point]
    if submergence > 0.0:
        counted = head
    return ti.Vector([submergence, head, to_cut, counted])


@ti.func
def _trend(values, wheeler):
    """What continues the heads of a panel above the surface: height above it, added head, depth below it.

    The bend of the pressure is that of the water, not of where the water ends. So a dry point has the head
    at the surface above it less its height, and besides what the wet points of its panel have more than
    still water, in proportion to the depth. Without stretching every dry point has a head of its own.
    """
    depth = ti.max(values[SUBMERGENCE], 0.0)
    added = 0.0
    if values[SUBMERGENCE] > 0.0:
        added = wheeler * (values[HEAD] - values[TO_CUT] - values[SUBMERGENCE])
    return ti.Vector([values[SUBMERGENCE] - depth, added, depth])


@ti.func
def _correct_triangle(middle, first, second, x0, x1, x2, wet_bend, counted_bend):
    """Load on the wet part of one triangle of a panel minus what has been counted."""
    wet0, wet1, wet2 = middle[SUBMERGENCE] > 0.0, first[SUBMERGENCE] > 0.0, second[SUBMERGENCE] > 0.0
    weights = -_corner_weights(middle[COUNTED], first[COUNTED], second[COUNTED])
    wet_part = 0.0
    if wet0 and wet1 and wet2:
        weights += _corner_weights(middle[HEAD], first[HEAD], second[HEAD])
        wet_part = 1.0
    elif wet0 or wet1 or wet2:
        # Turn the triangle so that the corner that differs from the other two comes first, and back.
        a, b, c = middle, first, second
        if wet0 == wet2:
            a, b, c = first, second, middle
        elif wet0 == wet1:
            a, b, c = second, middle, first
        clipped = _clip(a, b, c)
        wet_part = clipped[3]
        if wet0 == wet2:
            weights += ti.Vector([clipped[2], clipped[0], clipped[1]])
        elif wet0 == wet1:
            weights += ti.Vector([clipped[1], clipped[2], clipped[0]])
        else:
            weights += ti.Vector([clipped[0], clipped[1], clipped[2]])
    weights[0] += wet_bend * wet_part - counted_bend
    area_vector = 0.5 * (x1 - x0).cross(x2 - x0)
    force = -weights.sum() * area_vector
    moment = area_vector.cross(weights[0] * x0 + weights[1] * x1 + weights[2] * x2)
    return ti.Vector([force[0], force[1], force[2], moment[0], moment[1], moment[2]])


@ti.func
def _clip(alone, b, c):
    """Corner weights and share of the wet part of a triangle, first corner alone wet or alone dry.

    The weight of a corner is the mean over the triangle of head times area coordinate: its sum is
    the mean head, and its sum with the corner positions the mean of head times position.
    """
    t1 = alone[SUBMERGENCE] / (alone[SUBMERGENCE] - b[SUBMERGENCE])
    t2 = alone[SUBMERGENCE] / (alone[SUBMERGENCE] - c[SUBMERGENCE])
    cut1 = alone[TO_CUT] + t1 * (b[TO_CUT] - alone[TO_CUT])
    cut2 = alone[TO_CUT] + t2 * (c[TO_CUT] - alone[TO_CUT])
    at_cut1, at_cut2, wet_part = 0.0, 0.0, t1 * t2
    weights = ti.Vector([0.0, 0.0, 0.0])
    if alone[SUBMERGENCE] > 0.0:
        piece = t1 * t2 * _corner_weights(alone[HEAD], cut1, cut2)
        at_cut1, at_cut2 = piece[1], piece[2]
        weights[0] = piece[0]
    else:
        # The mean over both splits of the wet quadrilateral cut1, b, c, cut2: neither is preferred.
        one = 0.5 * (1.0 - t1) * _corner_weights(cut1, b[HEAD], c[HEAD])
        two = 0.5 * t1 * (1.0 - t2) * _corner_weights(cut1, c[HEAD], cut2)
        three = 0.5 * t2 * (1.0 - t1) * _corner_weights(cut1, b[HEAD], cut2)
        four = 0.5 * (1.0 - t2) * _corner_weights(b[HEAD], c[HEAD], cut2)
        at_cut1, at_cut2 = one[0] + two[0] + three[0], two[2] + three[2] + four[2]
        weights = ti.Vector([0.0, one[1] + three[1] + four[0], one[2] + two[1] + four[1]])
        wet_part = 1.0 - wet_part
    # The cuts lie on the edges: hand their weights to the ends.
    weights += ti.Vector([(1.0 - t1) * at_cut1 + (1.0 - t2) * at_cut2, t1 * at_cut1, t2 * at_cut2])
    return ti.Vector([weights[0], weights[1], weights[2], wet_part])


@ti.func
def _corner_weights(h0, h1, h2):
    """Corner weights of a triangle with a linear head."""
    total = h0 + h1 + h2
    return ti.Vector([h0 + total, h1 + total, h2 + total]) / 12.0


@ti.func
def is_wet(state: ti.template(), point):
    return state[SUBMERGENCE, point] > 0.0


@ti.func
def _position(blocks: ti.template(), point):
    k, lane = point >> LANE_BITS, point & (LANES - 1)
    return ti.Vector([blocks[k, X, lane], blocks[k, Y, lane], blocks[k, Z, lane]])
