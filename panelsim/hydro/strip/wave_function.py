"""The wave integral of a two-dimensional pulsating source, and its antiderivative's other half."""

import numpy as np
from scipy.special import exp1

from panelsim.conventions import ComplexArray

_FAR, _TERMS = 50.0, 20  # beyond it the asymptotic series is good to 20! / 50^20 = 3e-16


def wave_integral(w: ComplexArray) -> ComplexArray:
    """PV ∫₀^∞ exp(κ w)/(κ - 1) dκ for Re w ≤ 0, w ≠ 0, analytic there; any shape.

    It is exp(w) (E1(w) ± iπ) with the sign of Im w, the sum in which the cut of E1 along the negative axis
    cancels (Abramowitz and Stegun 5.1.7). Far out E1 by its asymptotic series (5.1.51), as exp(w) E1(w)
    would be 0 times infinity.
    """
    w = np.asarray(w, dtype=np.complex128)
    upper = w.real + 1j * np.abs(w.imag)  # the function takes conjugate values at conjugate points
    value = np.empty_like(upper)
    far = np.abs(upper) > _FAR
    near = ~far
    value[near] = np.exp(upper[near]) * (exp1(upper[near]) + 1j * np.pi)
    value[far] = _asymptotic(upper[far]) + 1j * np.pi * np.exp(upper[far])
    return np.where(w.imag < 0.0, value.conj(), value)


def _asymptotic(w: ComplexArray) -> ComplexArray:
    """exp(w) E1(w) for large w: Σ (-1)^n n! / w^(n+1), summed from the smallest term."""
    total = np.ones_like(w)
    for n in range(_TERMS, 0, -1):
        total = 1.0 - n / w * total
    return total / w
