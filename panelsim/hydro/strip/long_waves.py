"""Sections in waves longer than the ship, where two dimensions are no guide, led to rest causally.

A motion that displaces the waterline, as heave does, sends waves however long they are: Im φ_j, which damping
over frequency follows, tends to a constant and Re φ_j to a logarithm. Below a lowest frequency Im φ_j is
replaced by c2 ω² + c4 ω⁴ with the value and the slope that it has there: 0 at rest and as ω² near it, as in
three dimensions. Re φ_j, the added mass, must belong to it lest the water answer before it is pushed; by
Kramers and Kronig it changes by -(2/π) PV ∫ ω' ΔIm φ_j(ω')/(ω'² - ω²) dω', which removes the logarithm. At
twice the lowest frequency a frigate's heave added mass is 8 % more by this, at four times 2 %.
"""

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import xlogy

from panelsim.conventions import FloatArray, IntArray
from panelsim.hydro.strip.frank import solve_section
from panelsim.hydro.strip.lewis import LewisForm
from panelsim.hydro.strip.multipoles import solve_lewis_elements
from panelsim.hydro.strip.sections import Section
from panelsim.hydro.strip.solution import SectionSolution

_SAMPLES = 9  # of Im φ up to the lowest frequency
_FINE_SAMPLES = 201
# Share of the lowest frequency that stands for rest: sway and roll reach their limit as ω².
_AT_REST = 1e-3
_DISPLACES = 1e-6  # share of ∫ |n_j| dl above which ∫ n_j dl is no rounding


def solve_at_all_frequencies(
    section: Section | LewisForm,
    frequencies: FloatArray,
    lowest: float,
    *,
    water_density: float,
    gravity: float,
) -> SectionSolution:
    """A section at the frequencies of a database, rest and infinity included; a Lewis form by multipoles.

    `frequencies` (F,) [rad/s], ascending from 0; infinity is added. `lowest` [rad/s]: the frequency below
    which motions that displace the waterline are led to rest. Raises PanelsimError for frequencies that the
    elements do not resolve.
    """
    share = np.maximum(frequencies / lowest, _AT_REST)
    samples = np.maximum(np.linspace(0.0, 1.0, _SAMPLES), _AT_REST)
    asked = np.concatenate([lowest * share, [np.inf], lowest * samples])
    solved = (
        solve_lewis_elements(section, asked, water_density=water_density, gravity=gravity)
        if isinstance(section, LewisForm)
        else solve_section(section, asked, water_density=water_density, gravity=gravity)
    )
    potential = solved.potential[: -len(samples)].copy()
    displacing = _displacing(solved)
    flat = solved.potential[-len(samples) :, displacing].imag.reshape(len(samples), -1)
    wave = CubicSpline(samples, flat)
    real, imaginary = long_wave_change(wave, share)
    change = (real + 1j * imaginary).reshape(len(share), len(displacing), potential.shape[2])
    potential[:-1, displacing] += change
    potential[0] = potential[0].real
    stored = np.append(frequencies, np.inf)
    return SectionSolution.of_potential(solved.contour, stored, potential, water_density, gravity)


def long_wave_change(wave: CubicSpline, share: FloatArray) -> tuple[FloatArray, FloatArray]:
    """What Re φ and Im φ (F, K) change by at shares (F,), above 0, of the lowest frequency.

    `wave`: Im φ (K,) of the section in two dimensions over shares of 0 to 1.
    """
    value, slope = wave(1.0), wave(1.0, 1)

    def change(x: FloatArray) -> FloatArray:
        x2 = x[:, None] ** 2
        led: FloatArray = x2 * ((2.0 - x2) * value - 0.5 * (1.0 - x2) * slope) - wave(x)
        return led

    imaginary = np.where(share[:, None] < 1.0, change(np.minimum(share, 1.0)), 0.0)
    fine = np.linspace(0.0, 1.0, _FINE_SAMPLES)
    return -_principal_value(fine**2, change(fine), share**2) / np.pi, imaginary


def _principal_value(u: FloatArray, values: FloatArray, x: FloatArray) -> FloatArray:
    """PV ∫ f(u)/(u - x) du (F, K) over (0, 1), f linear between `values` (Q, K) at `u` (Q,), 0 at 1.

    By parts, so that it stays finite where x (F,) is one of `u`: -f(0) ln x - ∫ f' ln |u - x| du.
    """
    away = u - x[:, None]
    integral = np.diff(xlogy(away, np.abs(away)) - away, axis=1)
    slope = np.diff(values, axis=0) / np.diff(u)[:, None]
    return -np.log(x)[:, None] * values[0] - integral @ slope


def _displacing(solution: SectionSolution) -> IntArray:
    """Indices of the motions for which ∫ n_j dl is not 0."""
    modes, length = solution.contour.modes, solution.contour.length
    return np.flatnonzero(np.abs(modes @ length) > _DISPLACES * (np.abs(modes) @ length))
