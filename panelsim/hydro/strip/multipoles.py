"""Radiation by Lewis forms: a source or dipole at the origin and wave-free multipoles in the mapped plane.

Ursell (1949) for the circle, Tasai (1959) and de Jong (1973) for Lewis forms. With p = y + iz, e^{iα} = ζ on
the form and k = ω²/g, every wave-free potential, here over kM,

    Re [ζ^-n/(kM) + i (ζ^(1-n)/(n-1) - a₁ ζ^(-1-n)/(n+1) - 3 a₃ ζ^(-3-n)/(n+3))],

n = 2, 4, ... in heave and 3, 5, ... in sway and roll, keeps the condition at the surface, and the stream
function on the form is known: ψ = ∫ n_j dl, that is z in sway, -y in heave, -(y² + z²)/2 in roll, each up to
a constant. The strengths follow by least squares. It is independent of the close-fit method but for the
wave integral, and some ten times faster.
"""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.hydro.strip.contour import Contour
from panelsim.hydro.strip.lewis import LewisForm
from panelsim.hydro.strip.solution import SectionSolution, require_water
from panelsim.hydro.strip.wave_function import wave_integral

MULTIPOLES = 20
_POINTS_A_SIDE = 40
_NEGLIGIBLE = 1e-13  # of the largest singular value: at infinite frequency nothing makes waves


def solve_lewis(
    form: LewisForm,
    frequencies: FloatArray,
    *,
    water_density: float,
    gravity: float,
    multipoles: int = MULTIPOLES,
) -> SectionSolution:
    """Potentials, added mass and damping of a Lewis form in sway, heave and roll.

    `frequencies` (F,) [rad/s] above 0, infinity allowed. The elements of the solution are points of a
    quadrature, 40 a side. Raises PanelsimError for frequencies that are not positive.
    """
    omega = require_water(frequencies, water_density, gravity)
    k = omega**2 / gravity
    alpha, weight = _quadrature()
    contour = _contour(form, alpha, weight)
    outline = form.mapped(alpha)
    y, z = outline.real, outline.imag + form.waterline
    stream = {True: np.stack([-y]), False: np.stack([z, -0.5 * (y**2 + z**2)])}
    port = np.empty((len(k), 3, len(alpha)), dtype=np.complex128)
    for even, which in ((True, [1]), (False, [0, 2])):
        port[:, which] = _fitted(form, alpha, k, multipoles, even, stream[even])
    starboard = port[..., ::-1] * np.array([-1.0, 1.0, -1.0])[:, None]
    potential = np.concatenate([starboard, port], axis=-1)
    return SectionSolution.of_potential(contour, omega, potential, water_density, gravity)


def solve_lewis_elements(
    form: LewisForm, frequencies: FloatArray, *, water_density: float, gravity: float
) -> SectionSolution:
    """`solve_lewis` handed on as straight elements, each with the potential of the point that it is about."""
    of_points = solve_lewis(form, frequencies, water_density=water_density, gravity=gravity)
    contour = Contour.of_nodes(lewis_nodes(form), form.waterline)
    return SectionSolution.of_potential(
        contour, of_points.frequencies, of_points.potential.copy(), water_density, gravity
    )


def lewis_nodes(form: LewisForm) -> FloatArray:
    """Ends (81, 2) [m] of elements about the points of the quadrature, of their weights on the circle.

    The points of a Gauss rule lie between the sums of its weights (Chebyshev, Markov and Stieltjes).
    """
    _, weight = _quadrature()
    outline = form.mapped(np.concatenate([[-0.5 * np.pi], np.cumsum(weight) - 0.5 * np.pi]))
    side = np.stack([outline.real, outline.imag + form.waterline], axis=1)
    side[0, 0], side[-1, 1] = 0.0, form.waterline
    return np.vstack([side[:0:-1] * [-1.0, 1.0], side])


def _fitted(
    form: LewisForm, alpha: FloatArray, k: FloatArray, multipoles: int, even: bool, stream: FloatArray
) -> ComplexArray:
    """φ (F, J, P) to port whose stream function is `stream` (J, P), up to a constant in odd modes."""
    outline = form.mapped(alpha)
    travelling = _wave_makers(outline, k, even)
    bound = _wave_free(form, alpha, k, multipoles, even)
    functions = np.concatenate([travelling, bound], axis=1)
    potentials, streams = functions.real.astype(complex), functions.imag.astype(complex)
    # The wave that travels out is the standing one and i times its companion, in time.
    potentials[:, 0] += 1j * potentials[:, 1]
    streams[:, 0] += 1j * streams[:, 1]
    potentials, streams = np.delete(potentials, 1, axis=1), np.delete(streams, 1, axis=1)
    if not even:
        streams = np.concatenate([streams, np.ones_like(streams[:, :1])], axis=1)
        potentials = np.concatenate([potentials, np.zeros_like(potentials[:, :1])], axis=1)
    size = np.maximum(np.abs(streams).max(axis=2, keepdims=True), np.finfo(float).tiny)
    inverse = np.linalg.pinv(np.swapaxes(streams / size, 1, 2), rcond=_NEGLIGIBLE)
    strengths = inverse @ stream.T
    fitted: ComplexArray = np.swapaxes(np.swapaxes(potentials / size, 1, 2) @ strengths, 1, 2)
    return fitted


def _wave_makers(outline: ComplexArray, k: FloatArray, even: bool) -> ComplexArray:
    """Complex potentials (F, 2, P) of a source (even) or dipole at the origin, in and out of phase.

    0 at infinite frequency.
    """
    functions = np.zeros((len(k), 2, len(outline)), dtype=np.complex128)
    finite = np.isfinite(k)
    w = -1j * k[finite, None] * outline
    wave, decay = wave_integral(w), np.exp(w)
    if not even:  # the derivative of the source along y
        wave, decay = -1j * (wave - 1.0 / w), -1j * decay
    functions[finite] = np.stack([-wave, np.pi * decay], axis=1)
    return functions


def _wave_free(
    form: LewisForm, alpha: FloatArray, k: FloatArray, multipoles: int, even: bool
) -> ComplexArray:
    """Complex potentials (F, multipoles, P) that send out no waves."""
    zeta = np.exp(1j * alpha)
    n = (np.arange(multipoles) * 2 + (2 if even else 3))[:, None]
    rigid = (
        zeta ** (1 - n) / (n - 1)
        - form.a1 * zeta ** (-1 - n) / (n + 1)
        - 3.0 * form.a3 * zeta ** (-3 - n) / (n + 3)
    )
    functions: ComplexArray = zeta ** (-n) / (k * form.scale)[:, None, None] + 1j * rigid
    return functions


def _quadrature() -> tuple[FloatArray, FloatArray]:
    """Angles and weights (P,) of the Gauss rule from the keel, α = -π/2, to the waterline, α = 0."""
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS_A_SIDE)
    return 0.25 * np.pi * (nodes - 1.0), 0.25 * np.pi * weights


def _contour(form: LewisForm, alpha: FloatArray, weight: FloatArray) -> Contour:
    """The points of the quadrature on both sides, starboard round the keel to port."""
    turn = np.exp(1j * alpha)
    outline = form.mapped(alpha)
    tangent = 1j * form.scale * (turn - form.a1 / turn - 3.0 * form.a3 / turn**3)
    normal = -1j * tangent / np.abs(tangent)
    side = [
        np.stack([outline.real, outline.imag + form.waterline], axis=1),
        np.stack([normal.real, normal.imag], axis=1),
    ]
    centre, normals = (np.vstack([a[::-1] * [-1.0, 1.0], a]) for a in side)
    length = np.tile(weight * np.abs(tangent), 2)
    length[: len(alpha)] = length[len(alpha) :][::-1]
    return Contour(centre, np.zeros_like(centre), length, normals, form.waterline)
