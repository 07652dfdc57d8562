"""The grid method: at each point of the hull the waves are taken from a grid that moves with the ship.

The fill hardly depends on how many waves there are, the interpolation not at all (`wave_grid`).

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from panelsim.kernels import runtime
from panelsim.kernels import wave_grid as at
from panelsim.kernels.cut_panels import Four
from panelsim.kernels.exchange import DISPLACEMENT, LOAD, TIME, WAVE_FACTOR
from panelsim.kernels.grid_fill import fill_grid, number
from panelsim.kernels.grid_pressure import elevation_bound, grid_elevation_and_head
from panelsim.kernels.lanes import Lanes
from panelsim.kernels.ship_points import (
    integrate_heads,
    may_matter,
    place_on_earth,
    rotation,
    store_heads,
)

ti = runtime.import_taichi()

Matrix = ti.types.ndarray(dtype=ti.f64, ndim=2)
Blocks = ti.types.ndarray(dtype=ti.f64, ndim=3)
Integers = ti.types.ndarray(dtype=ti.i32, ndim=2)
CutRows = ti.types.ndarray(dtype=Four, ndim=1)
Numbers = ti.types.ndarray(dtype=ti.i32, ndim=1)
Rows = ti.types.ndarray(dtype=Lanes, ndim=1)
Starts = ti.types.ndarray(dtype=ti.i32, ndim=1)


@ti.kernel
def integrate_on_grid(
    blocks: Blocks,
    panels: Integers,
    components: Blocks,
    tables: Rows,
    starts: Starts,
    scratch: Rows,
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
    terms: ti.template(),
    line: ti.template(),
):
    ti.loop_config(serialize=True)  # the poses share `scratch` and `state`
    for b in range(exchange.shape[0]):
        base, factor = starts[b], exchange[b, WAVE_FACTOR]
        surge, sway, heave = (
            exchange[b, DISPLACEMENT],
            exchange[b, DISPLACEMENT + 1],
            exchange[b, DISPLACEMENT + 2],
        )
        crest = fill_grid(
            components, tables, base, scratch, surge, sway, exchange[b, TIME], factor, terms, line
        )
        bend = abs(factor) * number(tables, base, at.CURVATURE_SUM)
        r = rotation(exchange, b)
        for k in range(first, stop):
            x, y, height = place_on_earth(blocks, r, heave, k)
            submergence, head = Lanes(-1.0), Lanes(0.0)
            bound = elevation_bound(tables, base, x, y, crest, factor, line)
            if may_matter(blocks, panels, state, k, height, first_centre, cuts, bound, bend):
                elevation, wave_head = grid_elevation_and_head(
                    components, tables, base, scratch, x, y, height, wheeler, terms, line
                )
                submergence, head = elevation - height, wave_head - height
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
            False,
        )
        for i in ti.static(range(6)):
            exchange[b, LOAD + i] = load[i]
