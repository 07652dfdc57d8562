"""Panels that the water surface cuts: the exact integral over what is wet, less what is already counted.

A panel is four triangles about its centre. Head and submergence are linear on each of them, so the wet part
is a polygon; by the rule "vertex" the centre has the mean of the corners. `state` holds, row by row,
submergence and heads of the points [m]; `corners` are those of `PanelTables`.

Cut panels go four at a time (`Four`), and whichever of their corners are wet, the arithmetic is the same:
which case a triangle is cannot be foreseen, and a wrong guess of the processor costs as much as the triangle.
The compiler packs into vector registers what leads from rows of `room` to rows of it; measure after changes.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from panelsim.kernels import runtime
from panelsim.kernels.tables import QUADRILATERAL_BEND, TRIANGLE_BEND

ti = runtime.import_taichi()

TOGETHER = 4  # panels side by side; eight are no faster and take twice as long to compile
Four = ti.types.vector(TOGETHER, ti.f64)

# Rows of the state of the points; Stokes' second order alone fills the last one.
SUBMERGENCE, HEAD, SURFACE_HEAD = 0, 1, 2
# Rows of the room for each point of four panels: these two; the head to interpolate to a cut; the head in the
# sum over the points; how the heads go on above the surface (`_fetch`); the place.
TO_CUT, COUNTED, ADDED, DEPTH, PLACE = 2, 3, 4, 5, 6
POINT_ROWS = 9
# The points: four corners, the centre where the rule has it, the mean of the corners.
CENTRE, MEAN = 4 * POINT_ROWS, 5 * POINT_ROWS
# Rows for each panel: what the first and the second corner have in the mean; the share of the area that the
# bend at the centre takes, the bend wet and counted; a half, or nothing where a panel is but repeated.
SHARE, BEND, WET_BEND, COUNTED_BEND, HALF = range(6 * POINT_ROWS, 6 * POINT_ROWS + 5)
# The load, and what a triangle adds to it.
LOAD = HALF + 1
ADDEND = LOAD + 6
ROOM_ROWS = ADDEND + 6


@ti.func
def find_cut_panels(
    state: ti.template(),
    panels: ti.template(),
    cut: ti.template(),
    begin,
    end,
    first_centre,
    with_centres,
):
    """Put those from `begin` to `end` that have wet and dry points into `cut`; returns how many they are."""
    count = 0
    for n in range(begin, end):
        wet = 0
        for c in ti.static(range(4)):
            wet += ti.cast(state[SUBMERGENCE, panels[n, c]] > 0.0, ti.i32)
        if with_centres == 1:
            wet += ti.cast(state[SUBMERGENCE, first_centre + n] > 0.0, ti.i32)
        cut[count] = n  # the next one takes its place if it is not cut
        count += ti.cast(0 < wet < 4 + with_centres, ti.i32)
    return count


@ti.func
def correct_cut_panels(
    corners: ti.template(),
    state: ti.template(),
    panels: ti.template(),
    cut: ti.template(),
    room: ti.template(),
    count,
    first_centre,
    with_centres,
    wheeler,
    second_order: ti.template(),
):
    """Load (6,) on the wet part of the panels in `cut` minus what the sum over the points has counted."""
    for i in range(6):
        room[LOAD + i] = Four(0.0)
    for group in range((count + TOGETHER - 1) // TOGETHER):
        for lane in range(TOGETHER):
            place = TOGETHER * group + lane
            n = cut[ti.min(place, count - 1)]
            is_triangle = panels[n, 2] == panels[n, 3]
            room[SHARE][lane] = ti.select(is_triangle, 1.0 / 3.0, 0.25)
            room[BEND][lane] = with_centres * ti.select(is_triangle, TRIANGLE_BEND, QUADRILATERAL_BEND)
            room[HALF][lane] = ti.select(place < count, 0.5, 0.0)
            for c in range(4 + with_centres):
                point = first_centre + n
                if c < 4:
                    point = panels[n, c & 3]
                _fetch(state, room, c * POINT_ROWS, lane, point, wheeler, second_order)
            for c in range(4):
                for i in ti.static(range(3)):
                    room[c * POINT_ROWS + PLACE + i][lane] = corners[n, 3 * c + i]
        _set_centre(room, with_centres)
        middle = ti.select(with_centres == 1, CENTRE, MEAN)
        for side in range(4):
            _add_triangles(room, middle, side * POINT_ROWS, ((side + 1) & 3) * POINT_ROWS)
    return ti.Vector([room[LOAD + i].sum() for i in ti.static(range(6))])


@ti.func
def _fetch(
    state: ti.template(),
    room: ti.template(),
    row,
    lane,
    point,
    wheeler,
    second_order: ti.template(),
):
    """Put a point of one panel into the rows from `row` on.

    Wheeler's head at the surface is Σ a cos θ - ζ whatever the depth of the point: zero, or minus
    the second order of the elevation. Without stretching it is the head of the point itself.

    The bend of the pressure is that of the water, not of where the water ends. So a dry point has the head
    at the surface above it less its height, and besides what the wet points of its panel have more than
    still water, ADDED, in proportion to the depth. Without stretching every dry point has a head of its own.
    """
    submergence, head = state[SUBMERGENCE, point], state[HEAD, point]
    to_cut = head * (1.0 - wheeler)
    if ti.static(second_order):
        to_cut += wheeler * state[SURFACE_HEAD, point]
    is_wet = submergence > 0.0
    room[row + SUBMERGENCE][lane] = submergence
    room[row + HEAD][lane] = head
    room[row + TO_CUT][lane] = to_cut
    room[row + COUNTED][lane] = ti.select(is_wet, head, 0.0)
    room[row + ADDED][lane] = ti.select(is_wet, wheeler * (head - to_cut - submergence), 0.0)
    room[row + DEPTH][lane] = ti.select(is_wet, submergence, 0.0)


@ti.func
def _set_centre(room: ti.template(), with_centres):
    """Set the mean of the corners, as the head goes on above the surface, and the bend at the centre."""
    for i in range(POINT_ROWS):
        first, last = room[i] + room[POINT_ROWS + i], room[2 * POINT_ROWS + i] + room[3 * POINT_ROWS + i]
        room[MEAN + i] = room[SHARE] * first + (0.5 - room[SHARE]) * last
    depth = room[MEAN + DEPTH] + with_centres * room[CENTRE + DEPTH]
    added = room[MEAN + ADDED] + with_centres * room[CENTRE + ADDED]
    growth = ti.select(depth > 0.0, added / depth, 0.0)
    # The heads of the corners go on above the surface, so that a mean of them is one of the water.
    mean = room[MEAN + HEAD] + growth * (room[MEAN + SUBMERGENCE] - room[MEAN + DEPTH])
    centre = room[CENTRE + HEAD] + growth * (room[CENTRE + SUBMERGENCE] - room[CENTRE + DEPTH])
    counted = room[BEND] * (room[CENTRE + COUNTED] - room[MEAN + COUNTED])
    room[WET_BEND] = room[BEND] * (centre - mean)
    room[COUNTED_BEND] = counted
    room[MEAN + HEAD] = mean


@ti.func
def _add_triangles(room: ti.template(), middle, i, j):
    """Add the load on the wet part of a triangle of each panel minus what has been counted.

    Its corners are in the rows from `middle`, `i` and `j` on.
    """
    wet0, wet1, wet2, wet_part = _wet_weights(
        (room[middle + SUBMERGENCE], room[i + SUBMERGENCE], room[j + SUBMERGENCE]),
        (room[middle + HEAD], room[i + HEAD], room[j + HEAD]),
        (room[middle + TO_CUT], room[i + TO_CUT], room[j + TO_CUT]),
    )
    counted0, counted1, counted2 = room[middle + COUNTED], room[i + COUNTED], room[j + COUNTED]
    counted = counted0 + counted1 + counted2
    weight0 = (wet0 - counted - counted0) * (1.0 / 12.0) + room[WET_BEND] * wet_part - room[COUNTED_BEND]
    weight1 = (wet1 - counted - counted1) * (1.0 / 12.0)
    weight2 = (wet2 - counted - counted2) * (1.0 / 12.0)
    x0, y0, z0 = room[MEAN + PLACE], room[MEAN + PLACE + 1], room[MEAN + PLACE + 2]
    x1, y1, z1 = room[i + PLACE], room[i + PLACE + 1], room[i + PLACE + 2]
    x2, y2, z2 = room[j + PLACE], room[j + PLACE + 1], room[j + PLACE + 2]
    area_x, area_y, area_z = _cross(x1 - x0, y1 - y0, z1 - z0, x2 - x0, y2 - y0, z2 - z0)
    area_x, area_y, area_z = room[HALF] * area_x, room[HALF] * area_y, room[HALF] * area_z
    moment_x, moment_y, moment_z = _cross(
        area_x,
        area_y,
        area_z,
        weight0 * x0 + weight1 * x1 + weight2 * x2,
        weight0 * y0 + weight1 * y1 + weight2 * y2,
        weight0 * z0 + weight1 * z1 + weight2 * z2,
    )
    total = weight0 + weight1 + weight2
    force_x, force_y, force_z = -total * area_x, -total * area_y, -total * area_z
    for k, value in ti.static(enumerate((force_x, force_y, force_z, moment_x, moment_y, moment_z))):
        room[ADDEND + k] = value
    # In a loop of its own: added to the rows of the load at once, all this would be packed in pairs.
    for k in range(6):
        room[LOAD + k] = room[LOAD + k] + room[ADDEND + k]


@ti.func
def _wet_weights(submergence: ti.template(), head: ti.template(), to_cut: ti.template()):
    """Twelve times the corner weights, and the share of the wet part, of four triangles at a time.

    The weight of a corner is the mean over the triangle of head times area coordinate: its sum is
    the mean head, and its sum with the corner positions the mean of head times position. On a triangle with
    linear heads it is a twelfth of the head there plus all three.

    Turned so that the corner a that differs from b and c comes first, the surface cuts the edges to them at
    the shares t1 and t2 from a. Wet is the quadrilateral cut1 b c cut2, or with a alone wet a triangle: the
    same with b and c at a. Its four pieces are the halves of both its splits, as neither is preferred. What
    is not cut is such a quadrilateral with both cuts at a, or dry such a triangle.
    """
    s0, s1, s2 = submergence
    wet0, wet1, wet2 = (
        ti.select(s0 > 0.0, 1.0, 0.0),
        ti.select(s1 > 0.0, 1.0, 0.0),
        ti.select(s2 > 0.0, 1.0, 0.0),
    )
    wet_corners = wet0 + wet1 + wet2
    is_cut, few = abs(wet_corners - 1.5) < 1.0, wet_corners < 1.5
    odd = ti.select(few, 1.0, 0.0)
    second, third = wet1 == odd, wet2 == odd
    s_a, s_b, s_c = _turned(second, third, submergence)
    head_a, head_b, head_c = _turned(second, third, head)
    to_cut_a, to_cut_b, to_cut_c = _turned(second, third, to_cut)
    to_cut_a = ti.select(is_cut, to_cut_a, head_a)
    # Only a cut edge has ends that differ.
    t1, t2 = ti.select(is_cut, s_a / (s_a - s_b), 0.0), ti.select(is_cut, s_a / (s_a - s_c), 0.0)
    cut1, cut2 = to_cut_a + t1 * (to_cut_b - to_cut_a), to_cut_a + t2 * (to_cut_c - to_cut_a)
    b, c = ti.select(few, head_a, head_b), ti.select(few, head_a, head_c)
    rest1, rest2 = ti.select(few, t1, 1.0 - t1), ti.select(few, t2, 1.0 - t2)
    # Areas of the pieces cut1 b c, cut1 c cut2, cut1 b cut2, b c cut2, and three times their heads.
    half = 0.5 - 0.5 * odd
    f1, f2, f3, f4 = half * rest1, 0.5 * t1 * rest2, 0.5 * t2 * rest1, half * rest2
    sum1, sum2 = f1 * (cut1 + b + c), f2 * (cut1 + c + cut2)
    sum3, sum4 = f3 * (cut1 + b + cut2), f4 * (b + c + cut2)
    wet_part, total = f1 + f2 + f3 + f4, sum1 + sum2 + sum3 + sum4
    # A corner of the quadrilateral has all pieces but one.
    at_cut1, at_b = total - sum4 + (wet_part - f4) * cut1, total - sum2 + (wet_part - f2) * b
    at_cut2, at_c = total - sum1 + (wet_part - f1) * cut2, total - sum3 + (wet_part - f3) * c
    # The cuts lie on the edges: hand their weights to the ends.
    at_a = (1.0 - t1) * at_cut1 + (1.0 - t2) * at_cut2 + ti.select(few, at_b + at_c, 0.0)
    at_b, at_c = t1 * at_cut1 + ti.select(few, 0.0, at_b), t2 * at_cut2 + ti.select(few, 0.0, at_c)
    at_0, at_1, at_2 = _turned(third, second, (at_a, at_b, at_c))
    return at_0, at_1, at_2, wet_part


@ti.func
def _turned(second, third, values: ti.template()):
    """Three values in their order, but from the second or the third on where it is to come first."""
    v0, v1, v2 = values
    return (
        ti.select(second, v1, ti.select(third, v2, v0)),
        ti.select(second, v2, ti.select(third, v0, v1)),
        ti.select(second, v0, ti.select(third, v1, v2)),
    )


@ti.func
def _cross(x1, y1, z1, x2, y2, z2):
    return y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2
