"""Memory of the radiated waves as a handful of linear states: ẋ = A x + B ν, P_m = C x.

The kernel R(s) becomes the sum of decaying exponentials C exp(A s) B. Its momentum follows from states that
any stepper advances with the motions, and a linear one exactly, whatever its step.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.linalg import block_diag, qr

from panelsim.conventions import DOF_NAMES, FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hydro.memory import MemoryFunctions


class _Pencil(NamedTuple):
    """Of the samples of R: what one step of the pencil spans, and the stride of its rows and columns."""

    step: int
    stride: int


# Samples are 0.032 s apart for a frigate, whose panels send out waves of 2.5 s or more. Sections resolve
# shorter ones, and wide shallow ones make them; so the second pencil is tried where the first is not good
# enough. It may see no more than the beginning of R: with larger matrices the linear algebra would take
# several threads, and its bits would depend on how many.
_PENCILS = (_Pencil(5, 17), _Pencil(2, 7))
_LARGEST, _FEWEST_ROWS = 90, 30
_CHUNK = 300  # rows
_ORDERS = range(12, 33, 4)
_WANTED_ERROR = 0.001  # of the peaks of R
_ALLOWED_ERROR = 0.01
_SLOWEST = np.exp(-1.0)  # left at the end of the memory
# A motion that radiates less than this part of the strongest has no memory, as surge in strip theory.
_SMALLEST_PEAK = 1e-9


@dataclass(frozen=True)
class MemoryStates:
    """A linear system that answers a velocity ν as the kernel R does, in SI units.

    `transition` A (n, n) [1/s], all eigenvalues decaying; `entrance` B (n, 6); `momentum` C (6, n):
    P_m = C x. R(0) = C B = 0 and ∫R = −C A⁻¹ B are those of the kernel to rounding: so Ṗ_m = C A x, and a
    steady velocity keeps the momentum (A(0) − A∞) ν. `error` is the largest of C exp(A s) B − R(s), over the
    root of the peaks of R_ii R_jj.
    """

    transition: FloatArray
    entrance: FloatArray
    momentum: FloatArray
    error: float

    def __post_init__(self) -> None:
        for matrix in (self.transition, self.entrance, self.momentum):
            matrix.setflags(write=False)

    @property
    def count(self) -> int:
        """Number of states."""
        return len(self.transition)


def side_by_side(momentum: MemoryStates, other: MemoryStates) -> MemoryStates:
    """Both sets of states, one after the other, entered by the same velocity; P_m is that of the first."""
    return MemoryStates(
        transition=block_diag(momentum.transition, other.transition),
        entrance=np.vstack([momentum.entrance, other.entrance]),
        momentum=np.hstack([momentum.momentum, np.zeros((6, other.count))]),
        error=max(momentum.error, other.error),
    )


class _Group(NamedTuple):
    """Motions that one another's waves load, their scales, and R over the scales (T, m, m)."""

    motions: IntArray
    scale: FloatArray
    kernel: FloatArray


def memory_states(functions: MemoryFunctions) -> MemoryStates:
    """Fit the kernel by exponentials (matrix pencil; Hua and Sarkar 1990), with no more than it takes.

    Poles come from the Hankel matrices of samples of R; the weights C are the least squares over all of R
    that keep R(0) = 0 and ∫R. Raises PanelsimError where 32 exponentials leave more than 1 % of the peak.
    """
    fits = [
        (group, _fit(functions.time, group, _integral(functions, group)))
        for group in _groups(functions.momentum_kernel)
    ]
    sizes = [len(fit.transition) for _, fit in fits]
    entrance, momentum = np.zeros((sum(sizes), 6)), np.zeros((6, sum(sizes)))
    for (group, fit), stop in zip(fits, np.cumsum(sizes), strict=True):
        rows = slice(stop - len(fit.transition), stop)
        entrance[rows, group.motions] = fit.entrance * group.scale
        momentum[group.motions, rows] = fit.momentum * group.scale[:, None]
    states = MemoryStates(
        transition=block_diag(*[fit.transition for _, fit in fits]),
        entrance=entrance,
        momentum=momentum,
        error=max(fit.error for _, fit in fits),
    )
    if not states.error <= _ALLOWED_ERROR:
        motions = " or ".join(
            ", ".join(DOF_NAMES[i] for i in group.motions)
            for group, fit in fits
            if not fit.error <= _ALLOWED_ERROR
        )
        raise PanelsimError(
            "The memory of the radiated waves is no sum of a few decaying exponentials",
            got=f"{100 * states.error:.1f} % of the peak off in {motions}",
            allowed=f"{100 * _ALLOWED_ERROR:.0f} %",
            remedy="the damping is ragged, or still large at its highest frequency: use smaller panels",
        )
    return states


def _groups(kernel: FloatArray) -> list[_Group]:
    """Motions that radiate, in and out of the centreplane apart where no kernel couples them, so that zeros
    stay zeros."""
    in_plane, out_of_plane = np.array([0, 2, 4]), np.array([1, 3, 5])
    coupled = (
        kernel[:, in_plane[:, None], out_of_plane].any() or kernel[:, out_of_plane[:, None], in_plane].any()
    )
    peak = np.abs(np.einsum("tii->ti", kernel)).max(axis=0)
    radiating = np.flatnonzero(peak > _SMALLEST_PEAK * peak.max())
    planes = [np.arange(6)] if coupled else [in_plane, out_of_plane]
    motions = [m for plane in planes if len(m := np.intersect1d(plane, radiating))]
    scale = np.sqrt(peak)
    return [_Group(m, scale[m], kernel[:, m[:, None], m] / np.outer(scale[m], scale[m])) for m in motions]


def _integral(functions: MemoryFunctions, group: _Group) -> FloatArray:
    """∫R over the scales (m, m) [s]."""
    whole = functions.spline.integrate(0.0, functions.memory_length)
    return whole[group.motions[:, None], group.motions] / np.outer(group.scale, group.scale)


def _fit(time: FloatArray, group: _Group, integral: FloatArray) -> MemoryStates:
    """The smallest fit (n, m) of a kernel over its scales that is as good as wanted, else the best."""
    motions = len(integral)
    best = MemoryStates(np.zeros((0, 0)), np.zeros((0, motions)), np.zeros((motions, 0)), np.inf)
    for poles, entrance in _candidates(time, group.kernel):
        if len(poles) + np.count_nonzero(poles.imag) < 2 * motions:
            continue  # too few to meet the conditions
        fit = _weighted(time, group.kernel, integral, poles, entrance)
        best = min(best, fit, key=lambda states: states.error)
        if best.error <= _WANTED_ERROR:
            break
    return best


def _candidates(time: FloatArray, kernel: FloatArray) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Poles and rows of entrance as `_modes` gives them, by each pencil in ascending order."""
    for pencil in _PENCILS:
        left, size, right = np.linalg.svd(_hankel(kernel, pencil, 0))
        later = left.T @ _hankel(kernel, pencil, pencil.step) @ right.T
        for order in _ORDERS:
            root = np.sqrt(size[:order])
            step = later[:order, :order] / np.outer(root, root)
            first = root[:, None] * right[:order, : kernel.shape[1]]
            yield _modes(step, first, time[pencil.step] - time[0], time[-1])


def _hankel(kernel: FloatArray, pencil: _Pencil, shift: int) -> FloatArray:
    """Matrix of blocks R(t_i + t_j), all of them `shift` samples later."""
    motions = kernel.shape[1]
    at = np.arange(0, (len(kernel) - pencil.step + 1) // 2, pencil.stride)
    at = at[: max(_LARGEST // motions, _FEWEST_ROWS)]
    blocks = kernel[at[:, None] + at + shift]
    side = len(at) * motions
    return blocks.transpose(0, 2, 1, 3).reshape(side, side)


def _modes(
    step: FloatArray, first: FloatArray, interval: float, length: float
) -> tuple[FloatArray, FloatArray]:
    """Decaying poles [1/s], of a pair the upper one, and the rows by which a velocity enters them.

    `interval` [s] of a step, `length` [s] of the memory.
    """
    multiplier, vectors = np.linalg.eig(step)
    rows = np.linalg.solve(vectors, first.astype(complex))
    size = np.linalg.norm(rows, axis=1)
    # No sampled exponential turns by half a turn between samples; what seems to, or grows, is noise.
    kept = (np.abs(multiplier) < 1.0) & (multiplier.imag >= 0.0) & (size > 0.0)
    kept &= (multiplier.imag > 0.0) | (multiplier.real > 0.0)
    # What hardly falls while there is a memory would go on long after it.
    kept &= np.abs(multiplier) ** (length / interval) < _SLOWEST
    return np.log(multiplier[kept].astype(complex)) / interval, rows[kept] / size[kept, None]


def _weighted(
    time: FloatArray, kernel: FloatArray, integral: FloatArray, poles: FloatArray, rows: FloatArray
) -> MemoryStates:
    """Real states of these poles with the weights of least squares, under C B = 0 and −C A⁻¹ B = ∫R."""
    transition, entrance, answers = [], [], []
    for pole, row in zip(poles, rows, strict=True):
        answer = np.exp(pole * time)[:, None] * row
        if pole.imag == 0.0:
            transition.append(np.array([[pole.real]]))
            entrance += [row.real]
            answers += [answer.real]
        else:
            transition.append(np.array([[pole.real, -pole.imag], [pole.imag, pole.real]]))
            entrance += [row.real, row.imag]
            answers += [answer.real, answer.imag]
    matrix, enter = block_diag(*transition), np.array(entrance)
    unit_answers = np.array(answers)
    conditions = np.hstack([enter, -np.linalg.solve(matrix, enter)])
    wanted = np.vstack([np.zeros_like(integral), integral.T])
    design = unit_answers.reshape(len(matrix), -1).T
    values = kernel.transpose(0, 2, 1).reshape(-1, len(integral))
    momentum = _constrained_least_squares(design, values, conditions, wanted).T
    error = np.abs(np.einsum("in,ntj->tij", momentum, unit_answers) - kernel).max()
    return MemoryStates(matrix, enter, momentum, float(error))


def _constrained_least_squares(
    design: FloatArray, values: FloatArray, conditions: FloatArray, wanted: FloatArray
) -> FloatArray:
    """x (n, k) of least |design x − values|² among those with conditionsᵀ x = wanted."""
    count = conditions.shape[1]
    base, triangle = qr(conditions)
    fixed = base[:, :count] @ np.linalg.solve(triangle[:count].T, wanted)
    free = base[:, count:]
    # Chunks of rows first, each made a triangle: the same least squares in small matrices.
    both = np.hstack([design @ free, values - design @ fixed])
    chunks = np.array_split(both, len(both) // _CHUNK + 1)
    triangles = np.vstack([qr(chunk, mode="economic")[1] for chunk in chunks])
    small = qr(triangles, mode="economic")[1]
    rest = np.linalg.lstsq(small[:, : free.shape[1]], small[:, free.shape[1] :], rcond=None)[0]
    return fixed + free @ rest
