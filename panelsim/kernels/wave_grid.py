"""The tables of the grid method: what is built once for a sea, a heading and a box.

Waves of one direction take a line of nodes, and are summed at each node. For others the sum goes by way of
Fourier modes of the grid: each wave is spread over the 8 x 8 modes about its own wavenumber by a
Kaiser-Bessel window, and the modes are summed along y, then along x, where the transform of the window is
taken out again. So the cost hardly depends on how many waves there are, nor on any order in their
frequencies and directions.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline
from scipy.special import factorial

from panelsim.conventions import FloatArray
from panelsim.kernels.grid_plan import (
    DEFAULT_TOLERANCE,
    DEGREES,
    NODES_TOGETHER,
    WINDOW,
    Axis,
    GridBox,
    GridPlan,
    plan_grid,
    reflected,
)
from panelsim.kernels.tables import LANES, WaveTables

# Places of the numbers at the head of WaveGrid.tables.
(
    CENTRE_X,
    CENTRE_Y,
    UNIT_X,  # the axis of a line
    UNIT_Y,
    NODES_A_METRE_X,
    NODES_A_METRE_Y,
    NODES_X,
    NODES_Y,
    MODES_X,
    MODES_Y,
    DEGREE,
    RATE,  # v = 2^(RATE d), scaled to -1 .. 1 by the next two
    SCALE,
    SHIFT,
    DEPTH,
    AMPLITUDE_SUM,
    SPLINE,  # the rows where the tables begin that follow
    SPREADING,
    SUMS_X,
    SUMS_Y,
    AT_MODES,  # and the parts of the scratch
    AT_ROWS,
    AT_NODES,
    WORK,
    CURVATURE_SUM,
    FIRST_BLOCK,  # where the waves begin among those of several grids, and how many blocks they are
    BLOCKS,
) = range(27)
HEAD = 32
MOST_ROWS = 1 << 24  # of tables that a kernel can tell apart; a power of two
# Columns of WaveGrid.components; phases in turns, decay in powers of two, gain 1/transfer.
AMPLITUDE, KX, KY, DECAY, FREQUENCY, LEAD, GAIN = range(7)
COMPONENT_COLUMNS = 7
# Rows of a wave in the table of spreading: its first mode, its windows along x and y, its depth terms ψ.
PLACE, WINDOWS, PSI = 0, 1, 3


@dataclass(frozen=True)
class WaveGrid:
    """Frozen tables of the grid method for one sea, heading and box; made by `wave_grid`.

    `components` (M/8, 7, 8): the waves in blocks of eight, filled up with waves of no height. `tables`
    (R, 8): all that the kernel reads beside, its head by the names at the top of this module.
    `scratch_rows`: how many rows of eight numbers it writes.
    """

    waves: WaveTables
    box: GridBox
    plan: GridPlan
    components: FloatArray
    tables: FloatArray
    scratch_rows: int

    def scratch(self) -> FloatArray:
        """Room for the kernel to write in; keep it from call to call, one a thread."""
        return np.zeros((self.scratch_rows, LANES))


def wave_grid(
    waves: WaveTables,
    box: GridBox,
    tolerance: float = DEFAULT_TOLERANCE,
    point_count: int = 2500,
    *,
    degrees: tuple[int, ...] = DEGREES,
) -> WaveGrid:
    """Build the grid of a sea over a box; arguments and errors as `grid_plan.plan_grid`.

    Nothing depends on the speed of the ship but the encounter frequencies among the components.
    """
    plan = plan_grid(waves, box, tolerance, point_count, degrees=degrees)
    kx, ky, sign = reflected(waves)
    along = np.column_stack([kx, ky]) @ plan.direction
    across = ky if plan.kind == "plane" else np.zeros_like(ky)
    psi = plan.depth.coefficients(waves.wavenumber)
    if plan.kind == "line":
        order, modes = np.arange(len(psi)), (len(psi), 1)
        spreading = np.column_stack([np.zeros((len(psi), LANES * PSI)), psi])
        sums_x, sums_y = _group(_cos_and_sin(plan.x.half, along)), np.zeros(0)
    else:
        first_x, window_x, rates_x = _spread(along, plan.x, plan.oversampling)
        first_y, window_y, rates_y = _spread(across, plan.y, plan.oversampling)
        modes = (len(rates_x), len(rates_y))
        place = first_x * modes[1] + first_y
        order = np.argsort(place, kind="stable")  # neighbours in the sum are neighbours in memory
        spreading = np.column_stack([place, np.zeros((len(place), LANES - 1)), window_x, window_y, psi])
        sums_x = _group(_unwindowed(plan.x, rates_x, plan.oversampling))
        sums_y = _unwindowed(plan.y, rates_y, plan.oversampling)
    gain = (
        1.0 / transfer(along * plan.x.spacing, plan.degree) / transfer(across * plan.y.spacing, plan.degree)
    )
    components = _components(waves, kx, ky, sign, gain, order)
    tables, scratch_rows = _packed(plan, box, waves, modes, spreading[order], sums_x, sums_y)
    components.setflags(write=False)
    tables.setflags(write=False)
    return WaveGrid(waves, box, plan, components, tables, scratch_rows)


def stacked(grids: Sequence[WaveGrid]) -> tuple[FloatArray, FloatArray, NDArray[np.int32]]:
    """Components and tables of several grids one after the other, and the row (G,) where each one begins."""
    rows = np.cumsum([0, *(len(grid.tables) for grid in grids)])
    blocks = np.cumsum([0, *(len(grid.components) for grid in grids)])
    tables = np.concatenate([grid.tables for grid in grids])
    heads = [tables[row : row + HEAD // LANES].reshape(-1) for row in rows[:-1]]
    for head, row, block in zip(heads, rows, blocks, strict=False):
        head[[SPLINE, SPREADING, SUMS_X, SUMS_Y]] += row
        head[FIRST_BLOCK] = block
    return np.concatenate([grid.components for grid in grids]), tables, rows[:-1].astype(np.int32)


def transfer(step: FloatArray, degree: int) -> FloatArray:
    """Transfer function sinc(k h/2)^(p+1) of a B-spline of degree p, `step` = k h [rad]."""
    return np.asarray(np.sinc(step / (2.0 * np.pi)) ** (degree + 1))


def spline_weights(degree: int) -> FloatArray:
    """Polynomials (p + 1, 8) of the weights of the nodes about a cell: highest power first, a node a column.

    Their argument is the place within the cell, 0 to 1.
    """
    spline = BSpline.basis_element(np.arange(degree + 2.0))
    powers, nodes = np.arange(degree, -1, -1), np.arange(degree + 1)
    # Taylor series at the start of the cell, where each node has another piece of the spline.
    derivatives = [
        [spline.derivative(k)(degree - n) if k else spline(degree - n) for n in nodes] for k in powers
    ]
    return np.pad(derivatives / factorial(powers)[:, None], ((0, 0), (0, LANES - degree - 1)))


def _components(
    waves: WaveTables,
    kx: FloatArray,
    ky: FloatArray,
    sign: FloatArray,
    gain: FloatArray,
    order: NDArray[np.intp],
) -> FloatArray:
    """The waves in their order, in blocks of eight (M/8, 7, 8)."""
    turn = 2.0 * np.pi
    padded = np.zeros((-(-len(order) // LANES) * LANES, COMPONENT_COLUMNS))
    columns = padded[: len(order)].T
    columns[AMPLITUDE], columns[GAIN] = waves.amplitude[order], gain[order]
    columns[KX], columns[KY] = kx[order] / turn, ky[order] / turn
    columns[DECAY] = waves.wavenumber[order] / np.log(2.0)
    columns[FREQUENCY] = (sign * waves.encounter_frequency)[order] / turn
    columns[LEAD] = (sign * waves.phase)[order] / turn
    return np.ascontiguousarray(padded.reshape(-1, LANES, COMPONENT_COLUMNS).transpose(0, 2, 1))


def _spread(
    k: FloatArray, axis: Axis, oversampling: float
) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
    """First mode (M,) and windows (M, 8) of waves k (M,) along an axis; wavenumbers of the modes [rad/m]."""
    step = axis.mode_step(oversampling)
    first = np.ceil(k / step - 0.5 * WINDOW)
    place = (first[:, None] + np.arange(WINDOW) - (k / step)[:, None]) / (0.5 * WINDOW)
    window = np.i0(_window_shape(oversampling) * np.sqrt(np.maximum(1.0 - place**2, 0.0)))
    lowest = first.min()
    rates = step * (lowest + np.arange(first.max() - lowest + WINDOW))
    return (first - lowest).astype(np.intp), window, rates


def _window_shape(oversampling: float) -> float:
    """Parameter of the Kaiser-Bessel window: its spectrum ends where the first alias of the box begins."""
    return np.pi * WINDOW * (1.0 - 0.5 / oversampling)


def _unwindowed(axis: Axis, rates: FloatArray, oversampling: float) -> FloatArray:
    """cos and sin (H, Q, 2) of modes (Q,) at the half nodes (H,), over the transform of the window there."""
    reach = 0.5 * WINDOW * axis.mode_step(oversampling) * axis.half
    root = np.sqrt(_window_shape(oversampling) ** 2 - reach**2)
    return _cos_and_sin(axis.half, rates) * (root / (WINDOW * np.sinh(root)))[:, None, None]


def _cos_and_sin(at: FloatArray, rates: FloatArray) -> FloatArray:
    """cos and sin (H, Q, 2) of rates (Q,) [rad/m] at places (H,) [m]."""
    phase = at[:, None] * rates
    return np.stack([np.cos(phase), np.sin(phase)], axis=-1)


def _group(both: FloatArray) -> FloatArray:
    """cos and sin (H, Q, 2) as (H/4, Q, 2, 4): four nodes side by side, filled up with zeros."""
    padded = np.zeros((-(-len(both) // NODES_TOGETHER) * NODES_TOGETHER, *both.shape[1:]))
    padded[: len(both)] = both
    return padded.reshape(-1, NODES_TOGETHER, both.shape[1], 2).transpose(0, 2, 3, 1)


def _packed(
    plan: GridPlan,
    box: GridBox,
    waves: WaveTables,
    modes: tuple[int, int],
    spreading: FloatArray,
    sums_x: FloatArray,
    sums_y: FloatArray,
) -> tuple[FloatArray, int]:
    """All tables in rows of eight, the head saying where each begins; and the rows of the scratch."""
    depth, wide = plan.depth, plan.depth.terms // LANES
    spline = spline_weights(plan.degree)
    parts = np.cumsum([HEAD, spline.size, spreading.size, sums_x.size]) // LANES
    sizes = [
        4 * -(-len(spreading) // LANES),
        2 * wide * modes[0] * modes[1],
        2 * wide * modes[0] * plan.y.nodes,
        wide * plan.x.nodes * plan.y.nodes,
        2 * LANES + 1 + depth.terms,
    ]
    rooms = np.cumsum(sizes)
    head = np.zeros(HEAD)
    head[[CENTRE_X, CENTRE_Y]] = box.centre
    head[[UNIT_X, UNIT_Y]] = plan.direction
    head[[NODES_A_METRE_X, NODES_A_METRE_Y]] = 1.0 / plan.x.spacing, 1.0 / plan.y.spacing
    head[[NODES_X, NODES_Y, MODES_X, MODES_Y]] = plan.x.nodes, plan.y.nodes, *modes
    head[[DEGREE, RATE, DEPTH]] = plan.degree, depth.rate / np.log(2.0), depth.depth
    head[[SCALE, SHIFT]] = 2.0 / (1.0 - depth.lowest), -(1.0 + depth.lowest) / (1.0 - depth.lowest)
    amplitude = np.abs(waves.amplitude)
    head[[AMPLITUDE_SUM, CURVATURE_SUM]] = amplitude.sum(), amplitude @ waves.wavenumber**2
    head[BLOCKS] = -(-len(amplitude) // LANES)
    head[[SPLINE, SPREADING, SUMS_X, SUMS_Y]] = parts
    head[[AT_MODES, AT_ROWS, AT_NODES, WORK]] = rooms[:-1]
    flat = np.concatenate([head, spline.ravel(), spreading.ravel(), sums_x.ravel(), sums_y.ravel()])
    return np.append(flat, np.zeros(-len(flat) % LANES)).reshape(-1, LANES), int(rooms[-1])
