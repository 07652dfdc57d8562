"""What both compiled methods share: where the points of the hull are, which may be wet, the sum over them.

One pressure at each vertex and, by the finer rule, at each panel's centre (`tables`). A method fills `state`,
submergence and head p/(ρ g) [m] of every point; then comes the sum over the points, with the dry ones at zero
pressure, through their responses; then, for the panels that the surface cuts, the exact integral over the wet
part of their triangles less what the sum has already counted (`cut_panels`).

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from panelsim.kernels import runtime
from panelsim.kernels.cut_panels import (
    HEAD,
    REACH,
    RESPONSE,
    SUBMERGENCE,
    X,
    Y,
    Z,
    correct_cut_panel,
    is_wet,
)
from panelsim.kernels.exchange import DISPLACEMENT
from panelsim.kernels.lanes import Lanes
from panelsim.kernels.tables import LANES

ti = runtime.import_taichi()


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
    answer = ti.cast((height - reach).min() <= crest, ti.i32)
    if answer == 1 and cuts == 1 and LANES * k >= first_centre:
        answer = 0
        for lane in ti.static(range(LANES)):
            n = LANES * k + lane - first_centre
            if n < panels.shape[0]:
                for c in ti.static(range(4)):
                    if state[SUBMERGENCE, panels[n, c]] + 0.5 * bend * reach[lane] ** 2 > 0.0:
                        answer = 1
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
    first,
    stop,
    first_centre,
    cuts,
    centres,
    wheeler,
    second_order: ti.template(),
):
    """Load (6,) of the heads of all points, over ρ g."""
    lanes = ti.Matrix.zero(ti.f64, 6, LANES)
    for k in range(first, stop):
        for lane in ti.static(range(LANES)):
            wet_head = 0.0
            if state[SUBMERGENCE, LANES * k + lane] > 0.0:
                wet_head = state[HEAD, LANES * k + lane]
            for i in ti.static(range(6)):
                lanes[i, lane] += wet_head * blocks[k, RESPONSE + i, lane]
    load = lanes @ Lanes(1.0)
    if cuts == 1:
        for n in range(panels.shape[0]):
            wet_points = 0
            for c in ti.static(range(4)):
                wet_points += ti.cast(is_wet(state, panels[n, c]), ti.i32)
            if centres == 1:
                wet_points += ti.cast(is_wet(state, first_centre + n), ti.i32)
            if 0 < wet_points < 4 + centres:
                load += correct_cut_panel(
                    blocks, state, panels, n, first_centre + n, centres, wheeler, second_order
                )
    return load


@ti.func
def eight(blocks: ti.template(), k, column):
    return Lanes([blocks[k, column, lane] for lane in ti.static(range(LANES))])
