"""Radiation by a section of any shape: boundary elements close-fitted to it, in deep water.

Frank (NSRDC Report 2375, 1967) spreads sources over the outline. Here Green's identity is solved for the
potential itself, which keeps its accuracy at corners, with the same source potential,

    G = ln r - ln r' - 2 PV ∫₀^∞ exp(κ (z + ζ)) cos κ(y - η)/(κ - k) dκ + 2πi exp(k (z + ζ)) cos k(y - η),

k = ω²/g, outgoing for exp(+iωt) (Wehausen and Laitone 1960, 13.31): π φ = ∫ (G ∂φ/∂n - φ ∂G/∂n) dl on the
outline. At the irregular frequencies these equations have more than one solution; the identity with 0
on its left side for points of the waterline inside the body picks the right one, by least squares (Ohmatsu
1975 puts the same condition there). All integrals over straight elements are exact.
"""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.strip.contour import Contour, contour_nodes, highest_frequency
from panelsim.hydro.strip.sections import Section
from panelsim.hydro.strip.solution import SectionSolution, require_water
from panelsim.hydro.strip.wave_function import wave_integral

ELEMENTS = 48
# Times the girth: below it the rounding of 1/k eats the wave integrals.
_LEAST_WAVENUMBER = 1e-9
_NARROW = 1e-3  # of the girth: the first irregular wave length is twice the breadth
_PARITY = np.array([-1.0, 1.0, -1.0])  # of sway, heave and roll between the sides of a symmetric section


def solve_section(
    section: Section,
    frequencies: FloatArray,
    *,
    water_density: float,
    gravity: float,
    elements: int = ELEMENTS,
    interior_points: int | None = None,
) -> SectionSolution:
    """Potentials, added mass and damping of a section in sway, heave and roll.

    `frequencies` (F,) [rad/s] above 0, infinity allowed; `elements` round the section, even;
    `interior_points` on the waterline inside it, about half as many as elements by default and even, 0 leaves
    the irregular frequencies in. Raises PanelsimError for frequencies that are not positive, too low for the
    arithmetic or too high for the elements.
    """
    omega = require_water(frequencies, water_density, gravity)
    nodes = contour_nodes(section, elements)
    contour = Contour.of_nodes(nodes, section.waterline)
    _require_resolved(contour, omega, gravity, section.x)
    inside = _interior_points(section, elements // 4 * 2 if interior_points is None else interior_points)
    potential = radiation_potentials(nodes, contour, inside, omega**2 / gravity, section.symmetric)
    return SectionSolution.of_potential(contour, omega, potential, water_density, gravity)


def radiation_potentials(
    nodes: FloatArray, contour: Contour, inside: FloatArray, wavenumber: FloatArray, symmetric: bool
) -> ComplexArray:
    """φ_j (F, 3, N) on the elements; arguments as in `solve_section`, `inside` (M,) y of interior points."""
    if not symmetric:
        points = np.concatenate([_complex(contour.centre, contour.waterline), inside])
        single, double = influence(points, _complex(nodes, contour.waterline), wavenumber)
        return solve_identity(single, double, contour.modes)
    # Only the port half is solved for: each element acts together with its mirror image.
    half = len(contour.length) // 2
    points = np.concatenate([_complex(contour.centre[half:], contour.waterline), inside[inside > 0.0]])
    single, double = influence(points, _complex(nodes, contour.waterline), wavenumber, first_own=half)
    modes = contour.modes[:, half:]
    potential = np.empty((len(wavenumber), 3, 2 * half), dtype=np.complex128)
    for parity in (-1.0, 1.0):
        which = np.flatnonzero(parity == _PARITY)
        folded = [a[..., half:] + parity * a[..., half - 1 :: -1] for a in (single, double)]
        port = solve_identity(folded[0], folded[1], modes[which])
        potential[:, which] = np.concatenate([parity * port[..., ::-1], port], axis=-1)
    return potential


def solve_identity(
    single: ComplexArray, double: ComplexArray, flow: FloatArray | ComplexArray
) -> ComplexArray:
    """φ (F, J, N) of the normal velocities `flow` (J, N) on the elements.

    `single`, `double` (F, P, N): integrals of G and ∂G/∂n, see `influence`, for the N middles of the elements
    and then for points inside.
    """
    count = double.shape[-1]
    identity = double.copy()
    identity[:, np.arange(count), np.arange(count)] += np.pi
    right = single @ flow.T
    q, r = np.linalg.qr(identity)
    return np.swapaxes(np.linalg.solve(r, np.conj(np.swapaxes(q, 1, 2)) @ right), 1, 2)


def influence(
    points: ComplexArray, nodes: ComplexArray, wavenumber: FloatArray, first_own: int = 0
) -> tuple[ComplexArray, ComplexArray]:
    """∫ G dl and ∫ ∂G/∂n dl (F, P, N) over straight elements between nodes (N + 1,), for points (P,).

    y + iz [m], z = 0 at the waterline; `wavenumber` (F,) [1/m], infinite allowed. The points begin with
    the middles of the elements from `first_own` on, which add nothing to their own ∫ ∂(ln r)/∂n dl.
    """
    single_near, double_near = _logarithm(points, nodes)
    own = np.arange(len(nodes) - 1 - first_own)
    double_near[own, first_own + own] = 0.0
    single_image, double_image = _logarithm(points.conj(), nodes)
    single = np.empty((len(wavenumber), len(points), len(nodes) - 1), dtype=np.complex128)
    double = np.empty_like(single)
    single[:], double[:] = single_near - single_image, double_near - double_image
    finite = np.isfinite(wavenumber)
    waves = _waves(points, nodes, wavenumber[finite])
    single[finite] += waves[0]
    double[finite] += waves[1]
    return single, double


def _logarithm(points: ComplexArray, nodes: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """∫ ln r dl and ∫ ∂(ln r)/∂n dl (P, N) over the elements.

    In axes along an element, s = (p - q)/t, ln r is the real part of ln s, and n is -i times t.
    """
    chord = np.diff(nodes)
    length = np.abs(chord)
    begin = (points[:, None] - nodes[:-1]) * (chord / length).conj()
    end = begin - length  # the same imaginary part to the bit, lest the points on a line change sides
    log_begin, log_end = np.log(begin), np.log(end)
    single = (begin * (log_begin - 1.0) - end * (log_end - 1.0)).real
    return single, (log_end - log_begin).imag


def _waves(
    points: ComplexArray, nodes: ComplexArray, wavenumber: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """The same integrals (F, P, N) of the part of G that makes waves.

    With u = i (p* - q) it is -2 Re W(ku) + 2πi Re exp(ku), and (W(ku) + ln(-u))/k is an antiderivative of W.
    """
    chord = np.diff(nodes)
    tangent = chord / np.abs(chord)
    u = 1j * (points.conj()[:, None] - nodes)
    k = wavenumber[:, None, None]
    wave, decay = wave_integral(k * u), np.exp(k * u)
    standing = 1j * tangent.conj() * np.diff(wave + np.log(-u)) / k
    travelling = 1j * tangent.conj() * np.diff(decay) / k
    single = -2.0 * standing.real + 2j * np.pi * travelling.real
    double = -2.0 * np.diff(wave).imag + 2j * np.pi * np.diff(decay).imag
    return single, double


def _interior_points(section: Section, count: int) -> FloatArray:
    """The y (count,) [m] of points on the waterline inside, none where the section hardly cuts it."""
    if not isinstance(count, int | np.integer) or count < 0 or count % 2:
        raise PanelsimError(
            "The number of interior points does not suit", got=count, allowed="an even number, 0 or more"
        )
    if section.submerged or section.breadth < _NARROW * section.arc[-1]:
        return np.empty(0)
    shares = (np.arange(count) + 0.5) / max(count, 1)
    return section.points[0, 0] + shares * section.breadth


def _complex(points: FloatArray, waterline: float) -> ComplexArray:
    return points[:, 0] + 1j * (points[:, 1] - waterline)


def _require_resolved(contour: Contour, omega: FloatArray, gravity: float, x: float) -> None:
    least = float(np.sqrt(_LEAST_WAVENUMBER * gravity / contour.length.sum()))
    if omega.min() < least:
        raise PanelsimError(
            f"The lowest frequency is too low for the section at x = {x:g} m",
            got=f"{omega.min():g} rad/s",
            allowed=f"{least:.1e} rad/s or more; only the heave added mass still changes there",
        )
    good_to = highest_frequency(contour, gravity)
    highest = float(np.max(omega[np.isfinite(omega)], initial=0.0))
    if highest > good_to:
        count = len(contour.length)
        # With a twentieth more, as the pieces between corners are divided into whole elements.
        needed = 2 * int(np.ceil(0.525 * count * (highest / good_to) ** 2))
        raise PanelsimError(
            f"The section at x = {x:g} m has too few elements for its highest frequency",
            got=f"{highest:g} rad/s with {count} elements",
            allowed=f"up to {good_to:.3f} rad/s",
            remedy=f"take {needed} elements, or leave out the frequencies above",
        )
