"""Incident-wave and buoyancy pressure integrated over the wetted hull, cut exactly at the surface.

One pressure at each vertex, linear in between. First the sum over the vertices, with the dry ones
at zero pressure, through their responses (`tables.PanelTables`); then, for the panels that the
surface cuts, the exact integral over the wet part of their triangles minus what the sum has
already counted. Inside, pressures are heads p/(ρ g) [m] and phases are in turns.

Vertices go eight at a time (`lanes`). Whether the compiler packs the two loops over the components
into vector registers depends on the code around them, so measure the speed after any change here.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

import numpy as np

from panelsim.conventions import SPLIT_WEIGHT, FloatArray
from panelsim.kernels import runtime
from panelsim.kernels.lanes import Lanes, cos_of_turns, exp2
from panelsim.kernels.tables import (
    LANES,
    PanelTables,
    WaveTables,
    checked_poses,
    require_stretching,
)

ti = runtime.import_taichi()

LANE_BITS = LANES.bit_length() - 1  # LANES is a power of two
LOG_2 = float(np.log(2.0))

Matrix = ti.types.ndarray(dtype=ti.f64, ndim=2)
Blocks = ti.types.ndarray(dtype=ti.f64, ndim=3)
Corners = ti.types.ndarray(dtype=ti.i32, ndim=2)

# Columns of PanelTables.blocks.
X, Y, Z, RESPONSE, REACH = 0, 1, 2, 3, 9
# Columns of a wave component: those of WaveTables.columns, then what changes with pose and block.
AMPLITUDE, KX, KY, DECAY, FREQUENCY, LEAD = range(6)
CREST, PHASE, ELEVATION = 6, 7, 8
COMPONENT_COLUMNS = ELEVATION + LANES
# Rows of the state of the points; Stokes' second order alone fills the last one.
SUBMERGENCE, HEAD, SURFACE_HEAD = 0, 1, 2
# Columns of the exchange: a pose goes in, a load comes out.
TIME, WAVE_FACTOR, DISPLACEMENT, LOAD = 0, 1, 2, 8
EXCHANGE_COLUMNS = LOAD + 6


def wetted_surface_load(
    panels: PanelTables,
    waves: WaveTables,
    poses: FloatArray,
    *,
    waterline: float,
    water_density: float,
    gravity: float,
    stretching: str = "wheeler",
) -> FloatArray:
    """Force and moment of buoyancy and incident waves on the wetted hull, one row a pose.

    p = -ρ g z + ρ g Σ a cos θ exp(k (z - ζ)), z above calm water where the panel is: TM 2003-190 (10)
    for the elevation, section 2.6 for Wheeler's z - ζ, section 6 for the integral; "none" puts
    exp(k min(z, 0)) instead. The pressure carries no ω_e/ω, which (16) there seems to ask for: the
    two parts of -ρ(∂/∂t - U ∂/∂x)Φ together give ω. With `waves.second_order` ζ has the term ½ a² k cos 2θ
    of (8) and (17) and Φ stays of first order, section 2.2. Wheeler's pressure at the surface is then
    -ρ g ½ a² k cos 2θ, an inconsistency of that model, where it is 0 without second order.

    `poses` (B, 8): time [s], factor on all wave amplitudes, η1..η3 [m], η4..η6 [rad], of the ship
    axes in the translating earth axes; `waterline`: calm water above the CG when upright [m];
    `water_density` [kg/m3]; `gravity` [m/s2]. Returns (B, 6): force [N] and moment about the CG
    [N m] in ship axes. Raises PanelsimError for poses of another shape or not finite, and for an
    unknown stretching.
    """
    poses = checked_poses(poses)
    require_stretching(stretching)
    runtime.start()
    exchange = np.empty((len(poses), EXCHANGE_COLUMNS))
    exchange[:, :LOAD] = poses
    exchange[:, DISPLACEMENT + 2] -= waterline  # the CG above calm water
    components = np.empty((len(waves.columns), COMPONENT_COLUMNS))
    components[:, :CREST] = waves.columns
    state = np.empty((3, len(panels.points)))
    _integrate_heads(
        panels.blocks,
        panels.panels,
        components,
        state,
        exchange,
        stretching == "wheeler",
        bool(waves.second_order),
    )
    return exchange[:, LOAD:] * (water_density * gravity)


@ti.kernel
def _integrate_heads(
    blocks: Blocks,
    panels: Corners,
    components: Matrix,
    state: Matrix,
    exchange: Matrix,
    wheeler: ti.i32,
    second_order: ti.template(),
):
    ti.loop_config(serialize=True)  # the poses share `state` and `components`
    for b in range(exchange.shape[0]):
        crest_bound = _set_phases(components, exchange, b, second_order)
        load = _sum_over_points(blocks, components, state, exchange, b, crest_bound, wheeler, second_order)
        for n in range(panels.shape[0]):
            corners = ti.Vector([panels[n, 0], panels[n, 1], panels[n, 2], panels[n, 3]])
            wet_corners = 0
            for c in ti.static(range(4)):
                wet_corners += ti.cast(_is_wet(state, corners[c]), ti.i32)
            if 0 < wet_corners < 4:
                load += _correct_cut_panel(blocks, state, corners, wheeler, second_order)
        for i in ti.static(range(6)):
            exchange[b, LOAD + i] = load[i]


@ti.func
def _set_phases(components: ti.template(), exchange: ti.template(), b, second_order: ti.template()):
    """Set phase and amplitude of each component at the ship; returns a bound on the elevation."""
    bound = 0.0
    for m in range(components.shape[0]):
        turns = (
            components[m, KX] * exchange[b, DISPLACEMENT]
            + components[m, KY] * exchange[b, DISPLACEMENT + 1]
            - components[m, FREQUENCY] * exchange[b, TIME]
            - components[m, LEAD]
        )
        components[m, PHASE] = turns - ti.floor(turns)
        components[m, CREST] = exchange[b, WAVE_FACTOR] * components[m, AMPLITUDE]
        bound += abs(components[m, CREST])
        if ti.static(second_order):
            bound += 0.5 * LOG_2 * components[m, DECAY] * components[m, CREST] ** 2
    return bound


@ti.func
def _rotation(roll, pitch, yaw):
    """Rz(yaw) Ry(pitch) Rx(roll), as conventions.rotation_to_earth."""
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
def _sum_over_points(
    blocks: ti.template(),
    components: ti.template(),
    state: ti.template(),
    exchange: ti.template(),
    b,
    crest_bound,
    wheeler,
    second_order: ti.template(),
):
    """Store submergence and head of every point and sum head times response over the wet ones."""
    r = _rotation(exchange[b, DISPLACEMENT + 3], exchange[b, DISPLACEMENT + 4], exchange[b, DISPLACEMENT + 5])
    load = ti.Matrix.zero(ti.f64, 6, LANES)
    for k in range(blocks.shape[0]):
        x, y, z = _eight(blocks, k, X), _eight(blocks, k, Y), _eight(blocks, k, Z)
        earth_x = x * r[0, 0] + y * r[0, 1] + z * r[0, 2]
        earth_y = x * r[1, 0] + y * r[1, 1] + z * r[1, 2]
        height = x * r[2, 0] + y * r[2, 1] + z * r[2, 2] + exchange[b, DISPLACEMENT + 2]
        submergence = Lanes(-1.0)
        head = Lanes(0.0)
        # A dry point needs its true submergence where a neighbour is wet: the cut lies between.
        if (height - _eight(blocks, k, REACH)).min() <= crest_bound:
            submergence = _elevation(components, earth_x, earth_y) - height
            if ti.static(second_order):
                second = _second_order_elevation(components)
                submergence += second
                for lane in ti.static(range(LANES)):
                    state[SURFACE_HEAD, LANES * k + lane] = -second[lane]
            if wheeler == 0:
                head = _wave_head(components, ti.max(-height, 0.0)) - height
            elif submergence.max() > 0.0:
                head = _wave_head(components, ti.max(submergence, 0.0)) - height
        wet_head = ti.select(submergence > 0.0, head, 0.0)
        for lane in ti.static(range(LANES)):
            state[SUBMERGENCE, LANES * k + lane] = submergence[lane]
            state[HEAD, LANES * k + lane] = head[lane]
            for i in ti.static(range(6)):
                load[i, lane] += wet_head[lane] * blocks[k, RESPONSE + i, lane]
    return load @ Lanes(1.0)


@ti.func
def _elevation(components: ti.template(), x, y):
    """Elevation at eight points given relative to the ship; keeps a cos θ of each component."""
    elevation = Lanes(0.0)
    for m in range(components.shape[0]):
        turns = x * components[m, KX] + y * components[m, KY] + components[m, PHASE]
        crest = cos_of_turns(turns) * components[m, CREST]
        elevation += crest
        for lane in ti.static(range(LANES)):
            components[m, ELEVATION + lane] = crest[lane]
    return elevation


@ti.func
def _second_order_elevation(components: ti.template()):
    """Σ ½ a² k cos 2θ = Σ k ((a cos θ)² - ½ a²) at the eight points of the last `_elevation`."""
    elevation = Lanes(0.0)
    for m in range(components.shape[0]):
        crest = Lanes([components[m, ELEVATION + lane] for lane in ti.static(range(LANES))])
        wavenumber = LOG_2 * components[m, DECAY]
        elevation += wavenumber * (crest * crest - 0.5 * components[m, CREST] ** 2)
    return elevation


@ti.func
def _wave_head(components: ti.template(), depth):
    """Σ a cos θ exp(-k depth) at the eight points of the last `_elevation`."""
    head = Lanes(0.0)
    for m in range(components.shape[0]):
        crest = Lanes([components[m, ELEVATION + lane] for lane in ti.static(range(LANES))])
        head += crest * exp2(depth * -components[m, DECAY])
    return head


@ti.func
def _eight(blocks: ti.template(), k, column):
    return Lanes([blocks[k, column, lane] for lane in ti.static(range(LANES))])


@ti.func
def _correct_cut_panel(
    blocks: ti.template(), state: ti.template(), corners, wheeler, second_order: ti.template()
):
    """Load to add for a panel that the surface cuts, the sum over its four half-weight triangles."""
    load = ti.Vector.zero(ti.f64, 6)
    for half in range(4):
        # conventions.QUAD_SPLITS, written out: a loop over it would compile the clip four times.
        a, b, c = corners[0], corners[1], corners[2]
        if half == 1:
            b, c = corners[2], corners[3]
        elif half == 2:
            c = corners[3]
        elif half == 3:
            a, b, c = corners[1], corners[2], corners[3]
        load += _correct_triangle(blocks, state, a, b, c, wheeler, second_order)
    return load


@ti.func
def _correct_triangle(
    blocks: ti.template(), state: ti.template(), a, b, c, wheeler, second_order: ti.template()
):
    """Load on the wet part of a triangle minus what the sum over its vertices has counted."""
    load = ti.Vector.zero(ti.f64, 6)
    wet_a, wet_b, wet_c = _is_wet(state, a), _is_wet(state, b), _is_wet(state, c)
    if wet_a != wet_b or wet_a != wet_c:
        # Turn the triangle so that the corner that differs from the other two comes first.
        i, j, k = a, b, c
        if wet_a == wet_c:
            i, j, k = b, c, a
        elif wet_a == wet_b:
            i, j, k = c, a, b
        depths = ti.Vector([state[SUBMERGENCE, i], state[SUBMERGENCE, j], state[SUBMERGENCE, k]])
        heads = ti.Vector([state[HEAD, i], state[HEAD, j], state[HEAD, k]])
        weights = _clip(depths, heads, _heads_to_cut(state, i, j, k, heads, wheeler, second_order))
        x0, x1, x2 = _position(blocks, i), _position(blocks, j), _position(blocks, k)
        area_vector = SPLIT_WEIGHT * 0.5 * (x1 - x0).cross(x2 - x0)
        force = -weights.sum() * area_vector
        moment = area_vector.cross(weights[0] * x0 + weights[1] * x1 + weights[2] * x2)
        load = ti.Vector([force[0], force[1], force[2], moment[0], moment[1], moment[2]])
    return load


@ti.func
def _heads_to_cut(state: ti.template(), i, j, k, heads, wheeler, second_order: ti.template()):
    """Heads at the corners that are interpolated along an edge to where the surface cuts it.

    Wheeler's head at the surface is Σ a cos θ - ζ whatever the depth of the corner: zero, or minus
    the second order of the elevation. Without stretching it is the head of the corners themselves.
    """
    to_cut = heads * (1.0 - wheeler)
    if ti.static(second_order):
        to_cut += wheeler * ti.Vector(
            [state[SURFACE_HEAD, i], state[SURFACE_HEAD, j], state[SURFACE_HEAD, k]]
        )
    return to_cut


@ti.func
def _clip(depths, heads, to_cut):
    """Corner weights of the wet part minus those counted, first corner alone wet or alone dry.

    The weight of a corner is the mean over the triangle of head times area coordinate: its sum is
    the mean head, and its sum with the corner positions the mean of head times position.
    """
    t1 = depths[0] / (depths[0] - depths[1])
    t2 = depths[0] / (depths[0] - depths[2])
    cut1 = to_cut[0] + t1 * (to_cut[1] - to_cut[0])
    cut2 = to_cut[0] + t2 * (to_cut[2] - to_cut[0])
    at_cut1, at_cut2 = 0.0, 0.0
    weights = ti.Vector([0.0, 0.0, 0.0])
    if depths[0] > 0.0:
        piece = t1 * t2 * _corner_weights(heads[0], cut1, cut2)
        at_cut1, at_cut2 = piece[1], piece[2]
        weights = ti.Vector([piece[0], 0.0, 0.0]) - _corner_weights(heads[0], 0.0, 0.0)
    else:
        # The wet quadrilateral cut1, 1, 2, cut2 is split along both diagonals, like a panel.
        a = 0.5 * (1.0 - t1) * _corner_weights(cut1, heads[1], heads[2])
        b = 0.5 * t1 * (1.0 - t2) * _corner_weights(cut1, heads[2], cut2)
        c = 0.5 * t2 * (1.0 - t1) * _corner_weights(cut1, heads[1], cut2)
        d = 0.5 * (1.0 - t2) * _corner_weights(heads[1], heads[2], cut2)
        at_cut1, at_cut2 = a[0] + b[0] + c[0], b[2] + c[2] + d[2]
        weights = ti.Vector([0.0, a[1] + c[1] + d[0], a[2] + b[1] + d[1]])
        weights -= _corner_weights(0.0, heads[1], heads[2])
    # The cuts lie on the edges: hand their weights to the ends.
    return weights + ti.Vector([(1.0 - t1) * at_cut1 + (1.0 - t2) * at_cut2, t1 * at_cut1, t2 * at_cut2])


@ti.func
def _corner_weights(h0, h1, h2):
    """Corner weights of a triangle with a linear head."""
    total = h0 + h1 + h2
    return ti.Vector([h0 + total, h1 + total, h2 + total]) / 12.0


@ti.func
def _is_wet(state: ti.template(), point):
    return state[SUBMERGENCE, point] > 0.0


@ti.func
def _position(blocks: ti.template(), point):
    k, lane = point >> LANE_BITS, point & (LANES - 1)
    return ti.Vector([blocks[k, X, lane], blocks[k, Y, lane], blocks[k, Z, lane]])
