"""Exact steps of a linear system ẏ = S y + G u(t): the free motion, and inputs that are known in time."""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from scipy.linalg import matrix_balance

from panelsim.conventions import ComplexArray, FloatArray

Matrix = TypeVar("Matrix", FloatArray, ComplexArray)

# Of the series over a part of the step in which neither system nor wave turns by more than a radian: 1/20! is
# below rounding.
_TERMS = 20
# Multiplications up to which the linear algebra takes one thread. The bits of larger products depend on how
# many threads it has.
_OF_ONE_THREAD = 50_000


def advance(system: FloatArray, time_step: float) -> FloatArray:
    """exp(S h) (n, n): y(t + h) = exp(S h) y(t) without an input."""
    balanced, scale = _balanced(system)
    return scale[:, None] * _exponential(balanced * time_step) / scale


def polynomial_inputs(
    system: FloatArray, entrance: FloatArray, time_step: float, nodes: Sequence[int]
) -> FloatArray:
    """∫ exp(S (h − s)) G ℓ_j(s) ds (J, n, m) over the step for the Lagrange polynomials ℓ_j of u.

    `nodes` are the times of the samples u_j in steps from its start: (0, -1) for a line through
    the last two. From one exponential of an augmented matrix (Van Loan 1978).
    """
    count, (n, m) = len(nodes), entrance.shape
    balanced, scale = _balanced(system)
    augmented = np.zeros((n + count * m, n + count * m))
    augmented[:n, :n] = balanced * time_step
    augmented[:n, n : n + m] = entrance / scale[:, None] * time_step
    ahead = np.arange(n, n + (count - 1) * m)
    augmented[ahead, ahead + m] = 1.0
    of_power = scale[:, None] * _exponential(augmented)[:n, n:]  # for u = (s/h)^p / p!
    share = np.array(nodes, dtype=float)
    factorial = np.cumprod([1.0, *range(1, count)])
    of_sample = np.linalg.inv(np.vander(share, increasing=True)) * factorial[:, None]
    return np.einsum("pj,npm->jnm", of_sample, of_power.reshape(n, count, m))


def harmonic_inputs(
    system: FloatArray, inputs: ComplexArray, time_step: float, frequency: FloatArray
) -> ComplexArray:
    """∫ exp(S (h − s)) b exp(iω s) ds (n, K) over the step, for inputs b (n, K) at frequencies ω (K,)
    [rad/s].

    By its Taylor series, y_(m+1) = (S y_m + (iω)^m/m! b)/(m + 1), on a small part τ of the step, which is
    doubled until it is the step: q(2τ) = exp(S τ) q(τ) + exp(iω τ) q(τ). Nothing is divided by iω − S,
    which may vanish.
    """
    balanced, scale = _balanced(system)
    turn = max(np.linalg.norm(balanced, 1), np.abs(frequency).max(initial=0.0)) * time_step
    doublings = int(np.ceil(np.log2(max(turn, 1.0))))
    part = time_step / 2.0**doublings
    driven: ComplexArray = inputs / scale[:, None] * part
    term: ComplexArray = np.zeros(inputs.shape, dtype=complex)
    gathered: ComplexArray = term.copy()
    for order in range(_TERMS):
        term = (product(part * balanced, term) + driven) / (order + 1)
        gathered += term
        driven *= 1j * frequency * part / (order + 1)
    decay = _exponential(balanced * part)
    for _ in range(doublings):
        gathered = product(decay, gathered) + gathered * np.exp(1j * frequency * part)
        decay = product(decay, decay)
        part *= 2.0
    return scale[:, None] * gathered


def product(left: FloatArray, right: Matrix) -> Matrix:
    """left @ right (n, m) of (n, k) and (k, m), the same bits whatever the number of threads."""
    found: Matrix = np.empty((len(left), right.shape[1]), dtype=right.dtype)
    side = max(int(np.sqrt(_OF_ONE_THREAD / len(right))), 1)
    for row in range(0, found.shape[0], side):
        for column in range(0, found.shape[1], side):
            block = np.s_[row : row + side], np.s_[column : column + side]
            found[block] = left[block[0]] @ right[:, block[1]]
    return found


def _exponential(matrix: FloatArray) -> FloatArray:
    """exp of a matrix (n, n) by its Taylor series on a small part, squared until it is whole.

    `scipy.linalg.expm` has other bits on another number of threads.
    """
    doublings = int(np.ceil(np.log2(max(float(np.linalg.norm(matrix, 1)), 1.0))))
    part = matrix / 2.0**doublings
    term = gathered = np.eye(len(matrix))
    for order in range(1, _TERMS):
        term = product(part, term) / order
        gathered = gathered + term
    for _ in range(doublings):
        gathered = product(gathered, gathered)
    return gathered


def _balanced(system: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The system in scaled states D⁻¹ S D of moderate norm, and the scales (n,), powers of two."""
    balanced, (scale, _) = matrix_balance(system, permute=False, separate=True)
    return balanced, scale
