"""Elevation and wave head on a grid that moves with the ship (`wave_grid`): fill it, then interpolate.

The fill hardly depends on how many waves there are, the interpolation not at all. Points go eight at a
time (`lanes`). Where one of eight lies beyond the box or the depth of the grid all eight are summed directly.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from typing import NamedTuple

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.kernels import runtime
from panelsim.kernels import wave_grid as at
from panelsim.kernels.grid_fill import (
    CREST,
    LANE_BITS,
    MASK,
    PHASE,
    WAVE_ROWS,
    eight,
    fill_grid,
    number,
    row_of,
    whole,
)
from panelsim.kernels.lanes import Lanes, cos_of_turns, exp2
from panelsim.kernels.tables import LANES, require_stretching

ti = runtime.import_taichi()

Rows = ti.types.ndarray(dtype=Lanes, ndim=1)
Row = ti.types.ndarray(dtype=ti.f64, ndim=1)
Blocks = ti.types.ndarray(dtype=ti.f64, ndim=3)

# Rows of the part WORK of the scratch, for eight points: spline weights, first node, depth terms there.
WEIGHTS_X, WEIGHTS_Y, FIRST, FIELDS = 0, LANES, 2 * LANES, 2 * LANES + 1
# The pose of `_evaluate`: what goes in, and the bound that comes out.
POSE_X, POSE_Y, TIME, WAVE_FACTOR, BOUND = range(5)


class GridFields(NamedTuple):
    """Elevation and wave head Σ a cos θ exp(k d) (P,) [m]; a bound on the elevation within the box [m]."""

    elevation: FloatArray
    head: FloatArray
    crest_bound: float


def grid_fields(
    grid: at.WaveGrid,
    points: FloatArray,
    time: float,
    *,
    displacement: tuple[float, float] = (0.0, 0.0),
    wave_factor: float = 1.0,
    stretching: str = "wheeler",
) -> GridFields:
    """Elevation and wave head at points by the grid method, TM 2003-190 (10) and section 2.6.

    d is min(z - ζ, 0) for "wheeler" and min(z, 0) for "none". `points` (P, 3): x and y from the ship, z from
    calm water, in translating earth axes [m]; the ship has moved by `displacement` (2,) [m] at `time` [s];
    `wave_factor` multiplies all amplitudes. Raises PanelsimError for points that are not (P, 3) finite
    numbers and an unknown stretching.
    """
    require_stretching(stretching)
    points = np.asarray(points, dtype=np.float64)
    pose = np.array([*displacement, time, wave_factor, 0.0])
    if (
        points.ndim != 2
        or points.shape[1] != 3
        or not (np.isfinite(points).all() and np.isfinite(pose).all())
    ):
        raise PanelsimError(
            "The points, displacement, time and wave factor are no finite numbers",
            got=f"points {points.shape}, displacement {displacement}, time {time}, wave factor {wave_factor}",
            allowed="points (P, 3), all numbers finite",
        )
    runtime.start()
    padded = np.tile([*grid.box.centre, 0.0], (-(-len(points) // LANES) * LANES, 1))
    padded[: len(points)] = points
    blocks = np.ascontiguousarray(padded.reshape(-1, LANES, 3).transpose(0, 2, 1))
    out = np.empty((len(blocks), 2, LANES))
    _evaluate(
        grid.components,
        grid.tables,
        grid.scratch(),
        blocks,
        pose,
        out,
        stretching == "wheeler",
        grid.plan.depth.terms,
        grid.plan.kind == "line",
        1,
        1,
    )
    elevation, head = out.transpose(1, 0, 2).reshape(2, -1)[:, : len(points)]
    return GridFields(elevation, head, float(pose[BOUND]))


@ti.kernel
def _evaluate(
    components: Blocks,
    tables: Rows,
    scratch: Rows,
    points: Blocks,
    pose: Row,
    out: Blocks,
    wheeler: ti.i32,
    terms: ti.template(),
    line: ti.template(),
    fills: ti.i32,
    sweeps: ti.i32,
):
    """Fill and evaluate, each as often as asked for, which is for timing them apart."""
    ti.loop_config(serialize=True)  # the blocks share the scratch
    for _ in range(1):
        base = 0
        for _fill in range(fills):
            x, y, time, factor = pose[POSE_X], pose[POSE_Y], pose[TIME], pose[WAVE_FACTOR]
            pose[BOUND] = fill_grid(components, tables, base, scratch, x, y, time, factor, terms, line)
        for _sweep in range(sweeps):
            for b in range(points.shape[0]):
                x, y, z = eight(points, b, 0), eight(points, b, 1), eight(points, b, 2)
                elevation, head = grid_elevation_and_head(
                    components, tables, base, scratch, x, y, z, wheeler, terms, line
                )
                for i in ti.static(range(LANES)):
                    out[b, 0, i] = elevation[i]
                    out[b, 1, i] = head[i]


@ti.func
def grid_elevation_and_head(
    components: ti.template(),
    tables: ti.template(),
    base,
    scratch: ti.template(),
    x,
    y,
    height,
    wheeler,
    terms: ti.template(),
    line: ti.template(),
):
    """Elevation and wave head at eight points relative to the ship, after `fill_grid` for its pose [m].

    `height` above calm water. The head is that at the surface for dry points, as the direct sum has it.
    """
    u, v = _node_coordinates(tables, base, x, y, line)
    elevation, head = Lanes(0.0), Lanes(0.0)
    summed = True
    if _are_inside(tables, base, u, v, line):
        _interpolate(tables, base, scratch, u, v, terms, line)
        fields = whole(tables, base, at.WORK) + FIELDS
        for c in ti.static(range(terms)):
            elevation += scratch[fields + c]
        depth = _depth_argument(height, elevation, wheeler)
        if depth.min() >= -number(tables, base, at.DEPTH):
            head = _chebyshev(tables, base, scratch, fields, depth, terms)
            summed = False
    if summed:
        elevation, head = _sum_directly(components, tables, base, scratch, x, y, height, wheeler)
    return elevation, head


@ti.func
def elevation_bound(tables: ti.template(), base, x, y, crest_bound, wave_factor, line: ti.template()):
    """A bound on the elevation at eight points [m]: that of `fill_grid` within the box, else Σ |a|."""
    u, v = _node_coordinates(tables, base, x, y, line)
    bound = abs(wave_factor) * number(tables, base, at.AMPLITUDE_SUM)
    if _are_inside(tables, base, u, v, line):
        bound = crest_bound
    return bound


@ti.func
def _node_coordinates(tables: ti.template(), base, x, y, line: ti.template()):
    """Eight points in units of the node spacing, counted from the first node along both axes."""
    u, v = x - number(tables, base, at.CENTRE_X), y - number(tables, base, at.CENTRE_Y)
    if ti.static(line):
        u = u * number(tables, base, at.UNIT_X) + v * number(tables, base, at.UNIT_Y)
    u = u * number(tables, base, at.NODES_A_METRE_X) + 0.5 * (number(tables, base, at.NODES_X) - 1.0)
    v = v * number(tables, base, at.NODES_A_METRE_Y) + 0.5 * (number(tables, base, at.NODES_Y) - 1.0)
    return u, v


@ti.func
def _are_inside(tables: ti.template(), base, u, v, line: ti.template()):
    """Whether all nodes about all eight points exist."""
    margin = 0.5 * (number(tables, base, at.DEGREE) - 1.0)
    inside = _are_between(u, margin, number(tables, base, at.NODES_X) - 1.0 - margin)
    if ti.static(not line):
        inside &= _are_between(v, margin, number(tables, base, at.NODES_Y) - 1.0 - margin)
    return inside


@ti.func
def _are_between(values, low, high):
    """Whether low <= value < high for all eight, compared side by side."""
    between = 1
    for lane in ti.static(range(LANES)):
        between &= ti.cast(values[lane] >= low, ti.i32) & ti.cast(values[lane] < high, ti.i32)
    return between == 1


@ti.func
def _interpolate(
    tables: ti.template(), base, scratch: ti.template(), u, v, terms: ti.template(), line: ti.template()
):
    """Put the depth terms of eight points into the rows FIELDS of the work room, a term a row."""
    wide = ti.static(terms // LANES)
    degree, work = whole(tables, base, at.DEGREE), whole(tables, base, at.WORK)
    margin = 0.5 * (number(tables, base, at.DEGREE) - 1.0)
    first = ti.floor(u) - margin
    _store_weights(tables, base, scratch, work + WEIGHTS_X, u - ti.floor(u))
    if ti.static(not line):
        first = first * number(tables, base, at.NODES_Y) + (ti.floor(v) - margin)
        _store_weights(tables, base, scratch, work + WEIGHTS_Y, v - ti.floor(v))
    scratch[work + FIRST] = first * wide + number(tables, base, at.AT_NODES)
    stride = wide * whole(tables, base, at.NODES_Y)
    for lane in range(LANES):
        node = ti.cast(scratch[work + FIRST][lane], ti.i32)
        field = ti.Vector.zero(ti.f64, terms)
        for a in range(degree + 1):
            weight = scratch[work + WEIGHTS_X + a][lane]
            if ti.static(line):
                field += row_of(scratch, node + a * stride, terms) * weight
            else:
                along = ti.Vector.zero(ti.f64, terms)
                for b in range(degree + 1):
                    beside = scratch[work + WEIGHTS_Y + b][lane]
                    along += row_of(scratch, node + a * stride + b * wide, terms) * beside
                field += along * weight
        for c in ti.static(range(terms)):
            scratch[work + FIELDS + c][lane] = field[c]


@ti.func
def _store_weights(tables: ti.template(), base, scratch: ti.template(), place, fraction):
    """Weights of the p + 1 nodes about eight places in their cells."""
    degree, polynomials = whole(tables, base, at.DEGREE), whole(tables, base, at.SPLINE)
    for node in range(degree + 1):
        weight = Lanes(0.0)
        for power in range(degree + 1):
            weight = weight * fraction + tables[(polynomials + power) & MASK][node]
        scratch[place + node] = weight


@ti.func
def _chebyshev(tables: ti.template(), base, scratch: ti.template(), fields, depth, terms: ti.template()):
    """The depth series at eight points by Clenshaw's rule."""
    argument = exp2(depth * number(tables, base, at.RATE)) * number(tables, base, at.SCALE) + number(
        tables, base, at.SHIFT
    )
    twice = argument + argument
    last, before = Lanes(0.0), Lanes(0.0)
    for c in ti.static(range(terms - 1, 0, -1)):
        last, before = scratch[fields + c] + twice * last - before, last
    return scratch[fields] + argument * last - before


@ti.func
def _depth_argument(height, elevation, wheeler):
    depth = height
    if wheeler == 1:
        depth = height - elevation
    return ti.min(depth, 0.0)


@ti.func
def _sum_directly(
    components: ti.template(), tables: ti.template(), base, scratch: ti.template(), x, y, height, wheeler
):
    """Elevation and wave head at eight points as sums over the waves."""
    x -= number(tables, base, at.CENTRE_X)
    y -= number(tables, base, at.CENTRE_Y)
    first, count = whole(tables, base, at.FIRST_BLOCK), LANES * whole(tables, base, at.BLOCKS)
    elevation, head = Lanes(0.0), Lanes(0.0)
    for m in range(count):
        elevation += _crest_of(components, first, scratch, m, x, y)
    depth = _depth_argument(height, elevation, wheeler)
    for m in range(count):
        decay = components[first + (m >> LANE_BITS), at.DECAY, m & (LANES - 1)]
        head += _crest_of(components, first, scratch, m, x, y) * exp2(depth * decay)
    return elevation, head


@ti.func
def _crest_of(components: ti.template(), first, scratch: ti.template(), m, x, y):
    """a cos θ of one wave at eight points relative to the centre of the box."""
    b, i = m >> LANE_BITS, m & (LANES - 1)
    turns = x * components[first + b, at.KX, i] + y * components[first + b, at.KY, i]
    turns += scratch[b * WAVE_ROWS + PHASE][i]
    return cos_of_turns(turns) * scratch[b * WAVE_ROWS + CREST][i]
