"""From radiation damping to the kernel of the momentum form: power-law tail, sine transform, taper."""

import numpy as np
from scipy.interpolate import PchipInterpolator

from panelsim.conventions import ComplexArray, FloatArray

_FREQUENCY_SAMPLES = 2001
_TAIL_FITTED_FROM = 0.8  # share of the highest frequency
_TAIL_POWERS = (2.0, 6.0)
_TAIL_REACH = 100.0  # times the highest frequency
_TAIL_SAMPLES = 1501
_TAPER_FROM = 0.6  # share of the memory after which the kernel is led to zero


def tapered_momentum_kernel(frequencies: FloatArray, damping: FloatArray, time: FloatArray) -> FloatArray:
    """R(t) = (2/π) ∫ B(ω)/ω sin ωt dω, the integral of the retardation function, led to zero at the end.

    `frequencies` (F,) [rad/s] from 0, `damping` B (F, 6, 6), `time` (T,) [s] from 0 over the memory.
    Returns (T, 6, 6). Cutting B off at its last frequency would cost a third of the kernel, so a power law
    follows it.
    """
    omega, damping = _damping_with_tail(frequencies, damping)
    ratio = np.zeros_like(damping)
    ratio[1:] = damping[1:] / omega[1:, None, None]
    kernel = 2.0 / np.pi * fourier_integral(omega, ratio, time).imag
    return kernel * _taper(time)[:, None, None]


def fourier_integral(x: FloatArray, values: FloatArray, t: FloatArray) -> ComplexArray:
    """∫ f(x) exp(i x t) dx (T, ...) for `t` (T,), f linear between `values` (X, ...) at ascending `x` (X,).

    After Filon the oscillation is integrated exactly: samples need only follow f, however large t is.
    """
    flat = values.reshape(len(x), -1)
    integral = np.empty((len(t), flat.shape[1]), dtype=np.complex128)
    still = t == 0.0
    integral[still] = np.trapezoid(flat, x, axis=0)
    moving = t[~still, None]
    wave = np.exp(1j * moving * x)
    slope = np.diff(flat, axis=0) / np.diff(x)[:, None]
    # By parts: the ends, and one jump of slope at each sample.
    ends = (wave[:, -1:] * flat[-1] - wave[:, :1] * flat[0]) / (1j * moving)
    # Not a matrix product: its bits would depend on the number of threads of the linear algebra.
    integral[~still] = ends + np.einsum("tx,xk->tk", np.diff(wave, axis=1), slope) / moving**2
    return integral.reshape(len(t), *values.shape[1:])


def _damping_with_tail(frequencies: FloatArray, damping: FloatArray) -> tuple[FloatArray, FloatArray]:
    """B on a fine grid, shape-preserving between the frequencies and with a power law beyond the last.

    A pair of motions takes the mean of its two powers, so that |B_ij| never exceeds √(B_ii B_jj).
    """
    last = frequencies[-1]
    inside = np.linspace(0.0, last, _FREQUENCY_SAMPLES)
    resolved = PchipInterpolator(frequencies, damping)(inside)
    end = inside >= _TAIL_FITTED_FROM * last
    diagonal = np.einsum("fii->fi", resolved)
    # A motion may make no waves at all, as surge in strip theory.
    positive = np.maximum(diagonal[end], 1e-6 * diagonal.max(axis=0) + np.finfo(float).tiny)
    power = np.clip(-np.polyfit(np.log(inside[end]), np.log(positive), 1)[0], *_TAIL_POWERS)
    beyond = last * np.geomspace(1.0, _TAIL_REACH, _TAIL_SAMPLES)[1:]
    pair_power = 0.5 * (power[:, None] + power[None, :])
    tail = damping[-1] * (beyond[:, None, None] / last) ** -pair_power
    return np.concatenate([inside, beyond]), np.concatenate([resolved, tail])


def _taper(time: FloatArray) -> FloatArray:
    """1 until 0.6 of the memory, then half a cosine to 0 at its end."""
    progress = np.clip((time / time[-1] - _TAPER_FROM) / (1.0 - _TAPER_FROM), 0.0, 1.0)
    return 0.5 * (1.0 + np.cos(np.pi * progress))
