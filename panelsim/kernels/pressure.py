"""Incident-wave and buoyancy pressure integrated over the wetted hull, cut exactly at the surface.

One pressure at each vertex and, by the finer rule, at each panel's centre (`tables`). First the sum over
these points, with the dry ones at zero pressure, through their responses; then, for the panels that the
surface cuts, the exact integral over the wet part of their triangles minus what the sum has already
counted. Inside, pressures are heads p/(ρ g) [m] and phases are in turns.

Points go eight at a time (`lanes`). Whether the compiler packs the two loops over the components
into vector registers depends on the code around them, so measure the speed after any change here.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.kernels import runtime
from panelsim.kernels.cut_panels import (
    HEAD,
    LANE_BITS,
    REACH,
    RESPONSE,
    SUBMERGENCE,
    SURFACE_HEAD,
    X,
    Y,
    Z,
    correct_cut_panel,
    is_wet,
)
from panelsim.kernels.lanes import Lanes, cos_of_turns, exp2
from panelsim.kernels.tables import (
    LANES,
    PanelTables,
    WaveTables,
    checked_poses,
    require_rule,
    require_stretching,
)

ti = runtime.import_taichi()

LOG_2 = float(np.log(2.0))

Matrix = ti.types.ndarray(dtype=ti.f64, ndim=2)
Blocks = ti.types.ndarray(dtype=ti.f64, ndim=3)
Corners = ti.types.ndarray(dtype=ti.i32, ndim=2)

# Columns of a wave component: those of WaveTables.columns, then what changes with pose and block.
AMPLITUDE, KX, KY, DECAY, FREQUENCY, LEAD = range(6)
CREST, PHASE, ELEVATION = 6, 7, 8
COMPONENT_COLUMNS = ELEVATION + LANES
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
    rule: str = "vertex+centre",
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
    `water_density` [kg/m3]; `gravity` [m/s2]; `rule` "vertex" or "vertex+centre", see `tables`. Returns
    (B, 6): force [N] and moment about the CG [N m] in ship axes. Raises PanelsimError for poses of another
    shape or not finite, and for an unknown stretching or rule.
    """
    poses = checked_poses(poses)
    require_stretching(stretching)
    require_rule(rule)
    runtime.start()
    exchange = np.empty((len(poses), EXCHANGE_COLUMNS))
    exchange[:, :LOAD] = poses
    exchange[:, DISPLACEMENT + 2] -= waterline  # the CG above calm water
    components = np.empty((len(waves.columns), COMPONENT_COLUMNS))
    components[:, :CREST] = waves.columns
    state = np.empty((3, len(panels.points)))
    _integrate_heads(
        panels.blocks[rule],
        panels.panels,
        components,
        state,
        exchange,
        panels.first_centre,
        rule == "vertex+centre",
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
    first_centre: ti.i32,
    with_centres: ti.i32,
    wheeler: ti.i32,
    second_order: ti.template(),
):
    ti.loop_config(serialize=True)  # the poses share `state` and `components`
    for b in range(exchange.shape[0]):
        block_count = first_centre >> LANE_BITS
        if with_centres == 1:
            block_count = blocks.shape[0]
        bounds = _set_phases(components, exchange, b, second_order)
        load = _sum_over_points(
            blocks,
            panels,
            components,
            state,
            exchange,
            b,
            first_centre,
            block_count,
            bounds,
            wheeler,
            second_order,
        )
        for n in range(panels.shape[0]):
            wet_points = 0
            for c in ti.static(range(4)):
                wet_points += ti.cast(is_wet(state, panels[n, c]), ti.i32)
            if with_centres == 1:
                wet_points += ti.cast(is_wet(state, first_centre + n), ti.i32)
            if 0 < wet_points < 4 + with_centres:
                load += correct_cut_panel(
                    blocks, state, panels, n, first_centre + n, with_centres, wheeler, second_order
                )
        for i in ti.static(range(6)):
            exchange[b, LOAD + i] = load[i]


@ti.func
def _set_phases(components: ti.template(), exchange: ti.template(), b, second_order: ti.template()):
    """Set phase and amplitude of each component at the ship; bounds of the elevation and its curvature."""
    crest, curvature = 0.0, 0.0
    for m in range(components.shape[0]):
        turns = (
            components[m, KX] * exchange[b, DISPLACEMENT]
            + components[m, KY] * exchange[b, DISPLACEMENT + 1]
            - components[m, FREQUENCY] * exchange[b, TIME]
            - components[m, LEAD]
        )
        components[m, PHASE] = turns - ti.floor(turns)
        components[m, CREST] = exchange[b, WAVE_FACTOR] * components[m, AMPLITUDE]
        wavenumber = LOG_2 * components[m, DECAY]
        amplitude = abs(components[m, CREST])
        crest += amplitude
        curvature += amplitude * wavenumber**2
        if ti.static(second_order):
            second = 0.5 * wavenumber * amplitude**2
            crest += second
            curvature += second * (2.0 * wavenumber) ** 2
    return ti.Vector([crest, curvature])


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
    panels: ti.template(),
    components: ti.template(),
    state: ti.template(),
    exchange: ti.template(),
    b,
    first_centre,
    block_count,
    bounds,
    wheeler,
    second_order: ti.template(),
):
    """Store submergence and head of every point and sum head times response over the wet ones."""
    r = _rotation(exchange[b, DISPLACEMENT + 3], exchange[b, DISPLACEMENT + 4], exchange[b, DISPLACEMENT + 5])
    load = ti.Matrix.zero(ti.f64, 6, LANES)
    for k in range(block_count):
        x, y, z = _eight(blocks, k, X), _eight(blocks, k, Y), _eight(blocks, k, Z)
        earth_x = x * r[0, 0] + y * r[0, 1] + z * r[0, 2]
        earth_y = x * r[1, 0] + y * r[1, 1] + z * r[1, 2]
        height = x * r[2, 0] + y * r[2, 1] + z * r[2, 2] + exchange[b, DISPLACEMENT + 2]
        submergence = Lanes(-1.0)
        head = Lanes(0.0)
        # A dry point needs its true submergence where a neighbour is wet: the cut lies between.
        reach = _eight(blocks, k, REACH)
        near = ti.cast((height - reach).min() <= bounds[0], ti.i32)
        if near == 1 and LANES * k >= first_centre:
            near = _may_be_wet(state, panels, LANES * k - first_centre, 0.5 * bounds[1] * reach * reach)
        if near == 1:
            submergence = _elevation(components, earth_x, earth_y) - height
            head = submergence
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
def _may_be_wet(state: ti.template(), panels: ti.template(), first, margins):
    """Whether one of eight panels may have a wet point.

    The elevation at the centre is at most the mean of those at the corners and half its largest
    curvature times the square of their distance; so much, at most, lies the centre deeper than a corner.
    """
    answer = 0
    for lane in ti.static(range(LANES)):
        if first + lane < panels.shape[0]:
            for c in ti.static(range(4)):
                if state[SUBMERGENCE, panels[first + lane, c]] + margins[lane] > 0.0:
                    answer = 1
    return answer


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
