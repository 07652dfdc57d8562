"""Fill the grid that moves with the ship: spline coefficients of all depth terms at every node (`wave_grid`).

Both arrays that the kernels read and write hold rows of eight numbers. What the compiler packs into vector
registers here is fragile: sums carried by loops whose length it does not know, and loads from rows whose
index it can prove not to overflow (`MASK`). Measure the speed after any change.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from panelsim.kernels import runtime
from panelsim.kernels import wave_grid as at
from panelsim.kernels.grid_plan import NODES_TOGETHER, WINDOW
from panelsim.kernels.lanes import Lanes, cos_of_turns
from panelsim.kernels.tables import LANES

ti = runtime.import_taichi()

LANE_BITS = LANES.bit_length() - 1  # LANES is a power of two
MASK = at.MOST_ROWS - 1
# What the scratch begins with, four rows for eight waves: phase [turns] and height at the centre of the box,
# then real and imaginary part of a exp(iθ) over the transfer function.
PHASE, CREST, REAL, IMAGINARY = range(4)
WAVE_ROWS = 4


@ti.func
def fill_grid(
    components: ti.template(),
    tables: ti.template(),
    base,
    scratch: ti.template(),
    x,
    y,
    time,
    wave_factor,
    terms: ti.template(),
    line: ti.template(),
):
    """Set the spline coefficients for the ship at x, y [m] and this time [s]; returns a crest bound [m].

    Splines lie in the hull of their coefficients, so no elevation that the grid gives within its box is
    higher than the largest sum of the coefficients of one node.
    """
    _set_waves(components, tables, base, scratch, x, y, time, wave_factor)
    if ti.static(line):
        _take_waves_as_modes(tables, base, scratch, terms)
    else:
        _spread_waves(tables, base, scratch, terms)
        _sum_along_y(tables, base, scratch, terms)
    _sum_along_x(tables, base, scratch, terms)
    return _largest_sum(tables, base, scratch, terms)


@ti.func
def _set_waves(
    components: ti.template(), tables: ti.template(), base, scratch: ti.template(), x, y, time, wave_factor
):
    """Phase and height of each wave at the centre of the box, and its complex amplitude over the transfer."""
    first = whole(tables, base, at.FIRST_BLOCK)
    for b in range(whole(tables, base, at.BLOCKS)):
        turns = eight(components, first + b, at.KX) * (x + number(tables, base, at.CENTRE_X))
        turns += eight(components, first + b, at.KY) * (y + number(tables, base, at.CENTRE_Y))
        turns -= eight(components, first + b, at.FREQUENCY) * time + eight(components, first + b, at.LEAD)
        turns -= ti.floor(turns)
        crest = eight(components, first + b, at.AMPLITUDE) * wave_factor
        gained = crest * eight(components, first + b, at.GAIN)
        scratch[b * WAVE_ROWS + PHASE] = turns
        scratch[b * WAVE_ROWS + CREST] = crest
        scratch[b * WAVE_ROWS + REAL] = cos_of_turns(turns) * gained
        scratch[b * WAVE_ROWS + IMAGINARY] = cos_of_turns(turns - 0.25) * gained


@ti.func
def _take_waves_as_modes(tables: ti.template(), base, scratch: ti.template(), terms: ti.template()):
    """On a line each wave is a mode of its own."""
    wide = ti.static(terms // LANES)
    psi, rows = whole(tables, base, at.SPREADING) + at.PSI, whole(tables, base, at.AT_ROWS)
    for m in range(whole(tables, base, at.MODES_X)):
        wave, lane = (m >> LANE_BITS) * WAVE_ROWS, m & (LANES - 1)
        depth = row_of(tables, psi + m * (at.PSI + wide), terms)
        _store(scratch, rows + 2 * wide * m, depth * scratch[wave + REAL][lane], terms)
        _store(scratch, rows + 2 * wide * m + wide, depth * scratch[wave + IMAGINARY][lane], terms)


@ti.func
def _spread_waves(tables: ti.template(), base, scratch: ti.template(), terms: ti.template()):
    """Add each wave to the 8 x 8 modes about it."""
    wide = ti.static(terms // LANES)
    modes, count_y = whole(tables, base, at.AT_MODES), whole(tables, base, at.MODES_Y)
    for i in range(2 * wide * whole(tables, base, at.MODES_X) * count_y):
        scratch[modes + i] = Lanes(0.0)
    first, stride = whole(tables, base, at.SPREADING), at.PSI + wide
    for m in range((whole(tables, base, at.SUMS_X) - first) // stride):
        table, wave, lane = first + m * stride, (m >> LANE_BITS) * WAVE_ROWS, m & (LANES - 1)
        depth = row_of(tables, table + at.PSI, terms)
        real, imaginary = depth * scratch[wave + REAL][lane], depth * scratch[wave + IMAGINARY][lane]
        place = modes + 2 * wide * ti.cast(tables[table][at.PLACE], ti.i32)
        for i in range(WINDOW):
            real_i, imaginary_i = (
                real * tables[table + at.WINDOWS][i],
                imaginary * tables[table + at.WINDOWS][i],
            )
            for j in range(WINDOW):
                window, here = tables[table + at.WINDOWS + 1][j], place + 2 * wide * (i * count_y + j)
                # Not +=, which Taichi makes atomic.
                _store(scratch, here, row_of(scratch, here, terms) + real_i * window, terms)
                here += wide
                _store(scratch, here, row_of(scratch, here, terms) + imaginary_i * window, terms)


@ti.func
def _sum_along_y(tables: ti.template(), base, scratch: ti.template(), terms: ti.template()):
    """Sum the modes along y at the nodes of that axis, two nodes ±y at a time."""
    wide = ti.static(terms // LANES)
    modes, count_x, count_y = (
        whole(tables, base, at.AT_MODES),
        whole(tables, base, at.MODES_X),
        whole(tables, base, at.MODES_Y),
    )
    rows, nodes, sums = (
        whole(tables, base, at.AT_ROWS),
        whole(tables, base, at.NODES_Y),
        whole(tables, base, at.SUMS_Y),
    )
    zero = ti.Vector.zero(ti.f64, terms)
    for q in range(count_x):
        for j in range((nodes + 1) // 2):
            real_cos, imaginary_cos, real_sin, imaginary_sin = zero, zero, zero, zero
            for r in range(count_y):
                pair = 2 * (j * count_y + r)
                cos = tables[sums + (pair >> LANE_BITS)][pair & (LANES - 1)]
                sin = tables[sums + (pair >> LANE_BITS)][(pair & (LANES - 1)) + 1]
                mode = modes + 2 * wide * (q * count_y + r)
                real, imaginary = row_of(scratch, mode, terms), row_of(scratch, mode + wide, terms)
                real_cos += real * cos
                imaginary_cos += imaginary * cos
                real_sin += real * sin
                imaginary_sin += imaginary * sin
            high = rows + 2 * wide * (q * nodes + nodes - 1 - j)
            _store(scratch, high, real_cos - imaginary_sin, terms)
            _store(scratch, high + wide, imaginary_cos + real_sin, terms)
            low = rows + 2 * wide * (q * nodes + j)
            _store(scratch, low, real_cos + imaginary_sin, terms)
            _store(scratch, low + wide, imaginary_cos - real_sin, terms)


@ti.func
def _sum_along_x(tables: ti.template(), base, scratch: ti.template(), terms: ti.template()):
    """Sum the real part along x at the nodes, four pairs ±x at a time."""
    wide = ti.static(terms // LANES)
    count, rows, sums = (
        whole(tables, base, at.MODES_X),
        whole(tables, base, at.AT_ROWS),
        whole(tables, base, at.SUMS_X),
    )
    nodes_x, nodes_y, out = (
        whole(tables, base, at.NODES_X),
        whole(tables, base, at.NODES_Y),
        whole(tables, base, at.AT_NODES),
    )
    half = (nodes_x + 1) // 2
    zero = ti.Vector.zero(ti.f64, terms)
    for group in range((half + NODES_TOGETHER - 1) // NODES_TOGETHER):
        for j in range(nodes_y):
            even_0, even_1, even_2, even_3 = zero, zero, zero, zero
            odd_0, odd_1, odd_2, odd_3 = zero, zero, zero, zero
            for q in range(count):
                row = rows + 2 * wide * (q * nodes_y + j)
                real, imaginary = row_of(scratch, row, terms), row_of(scratch, row + wide, terms)
                both = tables[(sums + group * count + q) & MASK]  # four cosines, four sines
                even_0 += real * both[0]
                even_1 += real * both[1]
                even_2 += real * both[2]
                even_3 += real * both[3]
                odd_0 += imaginary * both[4]
                odd_1 += imaginary * both[5]
                odd_2 += imaginary * both[6]
                odd_3 += imaginary * both[7]
            i = group * NODES_TOGETHER
            for even, odd in ti.static(((even_0, odd_0), (even_1, odd_1), (even_2, odd_2), (even_3, odd_3))):
                if i < half:
                    _store(scratch, out + wide * ((nodes_x - 1 - i) * nodes_y + j), even - odd, terms)
                    _store(scratch, out + wide * (i * nodes_y + j), even + odd, terms)
                i += 1


@ti.func
def _largest_sum(tables: ti.template(), base, scratch: ti.template(), terms: ti.template()):
    """Largest sum of the coefficients of one node: at the surface every depth polynomial is 1.

    In a loop of its own: a sum over the terms beside the sums along x would have them packed in pairs.
    """
    wide = ti.static(terms // LANES)
    nodes, first = (
        whole(tables, base, at.NODES_X) * whole(tables, base, at.NODES_Y),
        whole(tables, base, at.AT_NODES),
    )
    bound = -ti.math.inf
    for n in range(nodes):
        bound = ti.max(bound, row_of(scratch, first + wide * n, terms).sum())
    return bound


@ti.func
def eight(blocks: ti.template(), b, column):
    return Lanes([blocks[b, column, i] for i in ti.static(range(LANES))])


@ti.func
def number(tables: ti.template(), base, place):
    return tables[base + place // LANES][place % LANES]


@ti.func
def whole(tables: ti.template(), base, place):
    return ti.cast(number(tables, base, place), ti.i32)


@ti.func
def row_of(array: ti.template(), place, terms: ti.template()):
    """The depth terms that begin at a row."""
    place &= MASK
    if ti.static(terms == LANES):
        return array[place]
    else:  # Taichi wants it: of a static condition only one side is compiled
        return ti.Vector([array[place + c // LANES][c % LANES] for c in ti.static(range(terms))])


@ti.func
def _store(array: ti.template(), place, values, terms: ti.template()):
    """Put the depth terms into the row or rows that begin at a place."""
    place &= MASK
    if ti.static(terms == LANES):
        array[place] = values
    else:
        for r in ti.static(range(terms // LANES)):
            array[place + r] = Lanes([values[r * LANES + c] for c in ti.static(range(LANES))])
