"""What both compiled methods share: where the points of the hull are, which may be wet, the sum over them.

One pressure at each vertex and, by the finer rule, at each panel's centre (`tables`). A method fills `state`,
submergence and head p/(ρ g) [m] of every point; then comes the sum over the points, with the dry ones at zero
pressure, through their responses; then, for the panels that the surface cuts, the exact integral over the wet
part of their triangles less what the sum has already counted (`cut_panels`).

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from panelsim.kernels import runtime
from panelsim.kernels.cut_panels import HEAD, SUBMERGENCE, correct_cut_panels, find_cut_panels
from panelsim.kernels.exchange import DISPLACEMENT
from panelsim.kernels.lanes import Lanes
from panelsim.kernels.tables import LANES

ti = runtime.import_taichi()

# Columns of PanelTables.blocks.
X, Y, Z, RESPONSE, REACH = 0, 1, 2, 3, 9


@ti.func
def rotation(exchange: ti.template(), b):
    """Rz(yaw) Ry(pitch) Rx(roll) of a pose, as conventions.rotation_to_earth."""
    roll, pitch = exchange[b, DISPLACEMENT + 3], exchange[b, DISPLACEMENT + 4]
    yaw = exchange[b, DISPLACEMENT + 5]
    cr, sr, cp, sp, cy, sy = (
        ti.cos(roll),
        ti.sin(roll),
        ti.cos(pitch),
        ti.sin(pitch),
        ti.cos(yaw),
        ti.sin(yaw),
    )
    return ti.Matrix(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


@ti.func
def place_on_earth(blocks: ti.template(), r, heave, k):
    """Eight points as the water sees them: x and y from the ship, height above calm water [m]."""
    x, y, z = eight(blocks, k, X), eight(blocks, k, Y), eight(blocks, k, Z)
    earth_x = x * r[0, 0] + y * r[0, 1] + z * r[0, 2]
    earth_y = x * r[1, 0] + y * r[1, 1] + z * r[1, 2]
    height = x * r[2, 0] + y * r[2, 1] + z * r[2, 2] + heave
    return earth_x, earth_y, height


@ti.func
def may_matter(
    blocks: ti.template(),
    panels: ti.template(),
    state: ti.template(),
    k,
    height,
    first_centre,
    cuts,
    crest,
    bend,
):
    """Whether the heads of eight points are needed, no elevation being above `crest` [m].

    A dry point needs its true submergence where a neighbour is wet: the cut lies between. The elevation at a
    centre is at most the mean of those at the corners and half its largest curvature, `bend` [1/m], times the
    square of their distance; so much, at most, lies the centre deeper than a corner.
    """
    reach = eight(blocks, k, REACH)
    answer = 0
    for lane in ti.static(range(LANES)):  # eight comparisons side by side; a minimum takes them in a row
        answer |= ti.cast(height[lane] - reach[lane] <= crest, ti.i32)
    if answer == 1 and cuts == 1 and LANES * k >= first_centre:
        answer = 0
        for lane in ti.static(range(LANES)):
            n = ti.min(LANES * k + lane - first_centre, panels.shape[0] - 1)
            deeper = 0.5 * bend * reach[lane] ** 2
            for c in ti.static(range(4)):
                answer |= ti.cast(state[SUBMERGENCE, panels[n, c]] + deeper > 0.0, ti.i32)
    return answer


@ti.func
def store_heads(state: ti.template(), k, submergence, head):
    for lane in ti.static(range(LANES)):
        state[SUBMERGENCE, LANES * k + lane] = submergence[lane]
        state[HEAD, LANES * k + lane] = head[lane]


@ti.func
def integrate_heads(
    blocks: ti.template(),
    panels: ti.template(),
    state: ti.template(),
    cut: ti.template(),
    room: ti.template(),
    spans: ti.template(),
    corners: ti.template(),
    first,
    stop,
    first_centre,
    cuts,
    centres,
    wheeler,
    second_order: ti.template(),
):
    """Load (6,) of the heads of all points, over ρ g; `spans` and `corners` are those of `PanelTables`."""
    lanes = ti.Matrix.zero(ti.f64, 6, LANES)
    begin, end = panels.shape[0], 0
    for k in range(first, stop):
        wet = ti.Vector([state[SUBMERGENCE, LANES * k + lane] > 0.0 for lane in ti.static(range(LANES))])
        wet_count = 0
        for lane in ti.static(range(LANES)):
            wet_count += ti.cast(wet[lane], ti.i32)
        # Before the first panel of a block with dry points all are wet, behind the last of one with wet, dry.
        if wet_count < LANES:
            begin = ti.min(begin, spans[k, 0])
        if wet_count > 0:
            end = ti.max(end, spans[k, 1])
            for lane in ti.static(range(LANES)):
                head = ti.select(wet[lane], state[HEAD, LANES * k + lane], 0.0)
                for i in ti.static(range(6)):
                    lanes[i, lane] += head * blocks[k, RESPONSE + i, lane]
    load = lanes @ Lanes(1.0)
    if cuts == 1:
        count = find_cut_panels(state, panels, cut, begin, end, first_centre, centres)
        load += correct_cut_panels(
            corners, state, panels, cut, room, count, first_centre, centres, wheeler, second_order
        )
    return load


@ti.func
def eight(blocks: ti.template(), k, column):
    return Lanes([blocks[k, column, lane] for lane in ti.static(range(LANES))])
