"""The direct method: at each point of the hull the waves are summed one by one.

Inside, pressures are heads p/(ρ g) [m] and phases are in turns. Points go eight at a time (`lanes`). Whether
the compiler packs the two loops over the components into vector registers depends on the code around them, so
measure the speed after any change here.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

import numpy as np

from panelsim.kernels import runtime
from panelsim.kernels.cut_panels import SURFACE_HEAD, Four
from panelsim.kernels.exchange import DISPLACEMENT, LOAD, TIME, WAVE_FACTOR
from panelsim.kernels.lanes import Lanes, cos_of_turns, exp2
from panelsim.kernels.ship_points import (
    integrate_heads,
    may_matter,
    place_on_earth,
    rotation,
    store_heads,
)
from panelsim.kernels.tables import LANES

ti = runtime.import_taichi()

LOG_2 = float(np.log(2.0))

Matrix = ti.types.ndarray(dtype=ti.f64, ndim=2)
Blocks = ti.types.ndarray(dtype=ti.f64, ndim=3)
Integers = ti.types.ndarray(dtype=ti.i32, ndim=2)
CutRows = ti.types.ndarray(dtype=Four, ndim=1)
Numbers = ti.types.ndarray(dtype=ti.i32, ndim=1)

# Columns of a wave component: those of WaveTables.columns, then what changes with pose and block.
AMPLITUDE, KX, KY, DECAY, FREQUENCY, LEAD = range(6)
CREST, PHASE, ELEVATION = 6, 7, 8
COMPONENT_COLUMNS = ELEVATION + LANES


@ti.kernel
def integrate_directly(
    blocks: Blocks,
    panels: Integers,
    components: Matrix,
    ranges: Integers,
    state: Matrix,
    cut: Numbers,
    room: CutRows,
    spans: Integers,
    corners: Matrix,
    exchange: Matrix,
    first: ti.i32,
    stop: ti.i32,
    first_centre: ti.i32,
    cuts: ti.i32,
    centres: ti.i32,
    wheeler: ti.i32,
    second_order: ti.template(),
):
    ti.loop_config(serialize=True)  # the poses share `state`
    for b in range(exchange.shape[0]):
        low, high = ranges[b, 0], ranges[b, 1]
        crest, bend = _set_phases(components, low, high, exchange, b, second_order)
        r, heave = rotation(exchange, b), exchange[b, DISPLACEMENT + 2]
        for k in range(first, stop):
            x, y, height = place_on_earth(blocks, r, heave, k)
            submergence, head = Lanes(-1.0), Lanes(0.0)
            if may_matter(blocks, panels, state, k, height, first_centre, cuts, crest, bend):
                submergence = _elevation(components, low, high, x, y) - height
                head = submergence
                if ti.static(second_order):
                    second = _second_order_elevation(components, low, high)
                    submergence += second
                    for lane in ti.static(range(LANES)):
                        state[SURFACE_HEAD, LANES * k + lane] = -second[lane]
                if wheeler == 0:
                    head = _wave_head(components, low, high, ti.max(-height, 0.0)) - height
                elif submergence.max() > 0.0:
                    head = _wave_head(components, low, high, ti.max(submergence, 0.0)) - height
            store_heads(state, k, submergence, head)
        load = integrate_heads(
            blocks,
            panels,
            state,
            cut,
            room,
            spans,
            corners,
            first,
            stop,
            first_centre,
            cuts,
            centres,
            wheeler,
            second_order,
        )
        for i in ti.static(range(6)):
            exchange[b, LOAD + i] = load[i]


@ti.func
def _set_phases(
    components: ti.template(), low, high, exchange: ti.template(), b, second_order: ti.template()
):
    """Set phase and amplitude of each component at the ship; bounds of the elevation and its curvature."""
    crest, curvature = 0.0, 0.0
    for m in range(low, high):
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
    return crest, curvature


@ti.func
def _elevation(components: ti.template(), low, high, x, y):
    """Elevation at eight points given relative to the ship; keeps a cos θ of each component."""
    elevation = Lanes(0.0)
    for m in range(low, high):
        turns = x * components[m, KX] + y * components[m, KY] + components[m, PHASE]
        crest = cos_of_turns(turns) * components[m, CREST]
        elevation += crest
        for lane in ti.static(range(LANES)):
            components[m, ELEVATION + lane] = crest[lane]
    return elevation


@ti.func
def _second_order_elevation(components: ti.template(), low, high):
    """Σ ½ a² k cos 2θ = Σ k ((a cos θ)² - ½ a²) at the eight points of the last `_elevation`."""
    elevation = Lanes(0.0)
    for m in range(low, high):
        crest = Lanes([components[m, ELEVATION + lane] for lane in ti.static(range(LANES))])
        wavenumber = LOG_2 * components[m, DECAY]
        elevation += wavenumber * (crest * crest - 0.5 * components[m, CREST] ** 2)
    return elevation


@ti.func
def _wave_head(components: ti.template(), low, high, depth):
    """Σ a cos θ exp(-k depth) at the eight points of the last `_elevation`."""
    head = Lanes(0.0)
    for m in range(low, high):
        crest = Lanes([components[m, ELEVATION + lane] for lane in ti.static(range(LANES))])
        head += crest * exp2(depth * -components[m, DECAY])
    return head
