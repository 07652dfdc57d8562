"""Elevation, potential, velocity, pressure of many waves at many points: one kernel for all of them.

In linear theory each is Σ (C cos θ + S sin θ) exp(k z') with constants C and S of the wave. One pass over the
waves gives the elevation, which says what is water and how far to stretch; the second sums up to
three quantities below it. Points go eight at a time (`lanes`), so nothing of the size points times waves is
kept. The compiler packs the loops over the waves because they end in sums, so measure the speed after
any change here.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.kernels import runtime
from panelsim.kernels.lanes import ROUND, Lanes, cos_of_turns, exp2
from panelsim.kernels.phases import SPLIT, turn_rates, turns
from panelsim.kernels.tables import LANES, WaveTables, require_stretching
from panelsim.kernels.wave_sums_oracle import SURFACE_TOLERANCE

ti = runtime.import_taichi()

Matrix = ti.types.ndarray(dtype=ti.f64, ndim=2)
Blocks = ti.types.ndarray(dtype=ti.f64, ndim=3)

MOST_QUANTITIES = 3
# Columns of a point and of the results there.
X, Y, Z, TIME = 0, 1, 2, 3
ELEVATION, SUMS = 0, 1
# Columns of a wave: rates in turns, each in two parts; then what it does at the eight points at hand.
AMPLITUDE, SECOND_ORDER, DECAY, LEAD = 0, 1, 2, 3
KX, KY, FREQUENCY = 4, 6, 8
COSINE = 10
SINE_TURNS = COSINE + LANES
WAVE_COLUMNS = SINE_TURNS + LANES


def wave_sums(
    waves: WaveTables, points: FloatArray, coefficients: ComplexArray, *, stretching: str
) -> tuple[FloatArray, FloatArray]:
    """Elevation (P,) [m] of the waves and sums Re Σ c e^(−iθ) e^(k z') (P, Q) at the points.

    θ = kx x + ky y − ω_e t − ε. z' is z − ζ for "wheeler", TM 2003-190 section 2.6, with ζ the elevation of
    all waves, second order included; min(z, 0) for "none". The sums are zero above the water, section 2.1.
    `points` (P, 4): x, y, z above calm water [m], time [s], finite; `coefficients` c (M, Q), Q at most 3,
    in units of the quantity. Raises PanelsimError for an unknown stretching.
    """
    require_stretching(stretching)
    runtime.start()
    blocks = _blocks_of_eight(points)
    out = np.zeros((len(blocks), SUMS + MOST_QUANTITIES, LANES))
    quantities = coefficients.shape[1]
    # Without quantities no row of coefficients, and the kernel stops at the elevation.
    cosine, sine = np.zeros((2, len(coefficients) if quantities else 0, MOST_QUANTITIES))
    if quantities:
        cosine[:, :quantities], sine[:, :quantities] = coefficients.real, coefficients.imag
    only_cosines = quantities == 1 and not sine.any()  # as pressure is
    with runtime.compiling, runtime.interrupts_held_back():
        _sum_waves(blocks, _columns(waves), cosine, sine, out, stretching == "wheeler", only_cosines)
    results = out.transpose(0, 2, 1).reshape(-1, SUMS + MOST_QUANTITIES)[: len(points)]
    return results[:, ELEVATION].copy(), results[:, SUMS : SUMS + quantities].copy()


def _blocks_of_eight(points: FloatArray) -> FloatArray:
    """Points (P, 4) in blocks (P/8, 4, 8), filled up with points at the origin."""
    padded = np.zeros((-(-len(points) // LANES) * LANES, 4))
    padded[: len(points)] = points
    return np.ascontiguousarray(padded.reshape(-1, LANES, 4).transpose(0, 2, 1))


def _columns(waves: WaveTables) -> FloatArray:
    """The waves as the kernel counts them (M, WAVE_COLUMNS): phases in turns, decay in powers of two."""
    columns = np.zeros((len(waves.amplitude), WAVE_COLUMNS))
    columns[:, AMPLITUDE] = waves.amplitude
    if waves.second_order:
        columns[:, SECOND_ORDER] = 0.5 * waves.amplitude**2 * waves.wavenumber
    columns[:, DECAY] = waves.wavenumber / np.log(2.0)
    columns[:, LEAD] = turns(1.0, waves.phase)
    for column, rate in (
        (KX, waves.wavenumber_x),
        (KY, waves.wavenumber_y),
        (FREQUENCY, waves.encounter_frequency),
    ):
        columns[:, column], columns[:, column + 1] = turn_rates(rate)
    return columns


@ti.kernel
def _sum_waves(
    points: Blocks,
    waves: Matrix,
    cosine: Matrix,
    sine: Matrix,
    out: Blocks,
    wheeler: ti.i32,
    only_cosines: ti.i32,
):
    ti.loop_config(serialize=True)  # the blocks share the scratch columns of `waves`
    for b in range(points.shape[0]):
        z = _eight(points, b, Z)
        elevation = _elevation(waves, _eight(points, b, X), _eight(points, b, Y), _eight(points, b, TIME))
        height = z - elevation
        for lane in ti.static(range(LANES)):
            out[b, ELEVATION, lane] = elevation[lane]
        if cosine.shape[0] > 0 and height.min() <= SURFACE_TOLERANCE:
            depth = z
            if wheeler == 1:
                depth = height
            depth = ti.min(depth, 0.0)
            first, second, third = Lanes(0.0), Lanes(0.0), Lanes(0.0)
            if only_cosines == 1:
                first = _sum_cosines(waves, cosine, depth)
            else:
                first, second, third = _sum_both(waves, cosine, sine, depth)
            for lane in ti.static(range(LANES)):
                if height[lane] <= SURFACE_TOLERANCE:
                    out[b, SUMS, lane] = first[lane]
                    out[b, SUMS + 1, lane] = second[lane]
                    out[b, SUMS + 2, lane] = third[lane]


@ti.func
def _elevation(waves: ti.template(), x, y, time):
    """Elevation at eight points; keeps cos θ, and θ − π/2 in turns, of each wave."""
    lead_x, lead_y, lead_time = _leading_part(x), _leading_part(y), _leading_part(time)
    rest_x, rest_y, rest_time = x - lead_x, y - lead_y, time - lead_time
    elevation = Lanes(0.0)
    for m in range(waves.shape[0]):
        turned = _turns(waves, m, KX, lead_x, rest_x) + _turns(waves, m, KY, lead_y, rest_y)
        turned -= _turns(waves, m, FREQUENCY, lead_time, rest_time) + waves[m, LEAD]
        cosine = cos_of_turns(turned)
        # a cos θ + ½ a² k cos 2θ with cos 2θ = 2 cos² θ − 1
        second_order = waves[m, SECOND_ORDER]
        elevation += cosine * (cosine * (2.0 * second_order) + waves[m, AMPLITUDE]) - second_order
        for lane in ti.static(range(LANES)):
            waves[m, COSINE + lane] = cosine[lane]
            waves[m, SINE_TURNS + lane] = turned[lane] - 0.25
    return elevation


@ti.func
def _leading_part(value):
    """`phases.leading_part` of eight numbers."""
    spread = value * SPLIT
    return spread - (spread - value)


@ti.func
def _turns(waves: ti.template(), m, rate, leading, rest):
    """`phases.turns` at eight coordinates in two parts, rates in two columns from `rate` on."""
    leading_rate, small_rate = waves[m, rate], waves[m, rate + 1]
    whole = leading * leading_rate
    small = leading * small_rate + rest * (leading_rate + small_rate)
    return (whole - ((whole + ROUND) - ROUND)) + small


@ti.func
def _sum_cosines(waves: ti.template(), cosine: ti.template(), depth):
    """Σ C cos θ exp(k depth) of the first quantity at the eight points of the last `_elevation`."""
    total = Lanes(0.0)
    for m in range(waves.shape[0]):
        wave = exp2(depth * waves[m, DECAY]) * _eight_of_wave(waves, m, COSINE)
        total += wave * cosine[m, 0]
    return total


@ti.func
def _sum_both(waves: ti.template(), cosine: ti.template(), sine: ti.template(), depth):
    """Σ (C cos θ + S sin θ) exp(k depth) of three quantities, likewise."""
    first, second, third = Lanes(0.0), Lanes(0.0), Lanes(0.0)
    for m in range(waves.shape[0]):
        decay = exp2(depth * waves[m, DECAY])
        wave = decay * _eight_of_wave(waves, m, COSINE)
        quarter = decay * cos_of_turns(_eight_of_wave(waves, m, SINE_TURNS))
        first += wave * cosine[m, 0] + quarter * sine[m, 0]
        second += wave * cosine[m, 1] + quarter * sine[m, 1]
        third += wave * cosine[m, 2] + quarter * sine[m, 2]
    return first, second, third


@ti.func
def _eight(points: ti.template(), b, column):
    return Lanes([points[b, column, lane] for lane in ti.static(range(LANES))])


@ti.func
def _eight_of_wave(waves: ti.template(), m, column):
    return Lanes([waves[m, column + lane] for lane in ti.static(range(LANES))])
