"""The incident wave on one section: Froude-Krylov force, and the momentum of the scattered wave."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.hydro.strip.contour import Contour
from panelsim.hydro.strip.solution import SectionSolution


def froude_krylov_section(
    contour: Contour,
    wavenumber: FloatArray,
    wave_heading: FloatArray,
    *,
    water_density: float,
    gravity: float,
) -> ComplexArray:
    """Sway and heave force, roll moment (M, 3) [N/m, N] per metre by a wave of 1 m amplitude undisturbed.

    -ρ g ∫ n_j exp(k z + i k y sin β) dl about the origin of ship axes, z from the waterline, exp(+iω_e t).
    The phase is that of a crest on the centreline at this station: multiply by exp(-i k x cos β) for one at
    the CG. `wavenumber` k (M,) [1/m]; `wave_heading` β (M,) [rad], 0 following, π head.
    """
    k = np.asarray(wavenumber, dtype=float)
    wave = contour.exponential(k * np.sin(wave_heading), k)
    force: ComplexArray = -water_density * gravity * np.einsum("jn,mn->mj", contour.modes, wave)
    return force


def diffraction_momentum_section(
    solution: SectionSolution, potential: ComplexArray, frequency: FloatArray, wave_heading: FloatArray
) -> ComplexArray:
    """Momentum P_d (M, 3) [kg/s, kg m/s] per metre of the wave that the section scatters, amplitude 1 m.

    P_d,j = ρ ∫ φ_j(ω_e) ∂φ_I/∂n dl with φ_I = (i g/ω) exp(k z + i k y sin β) and the normal in the section's
    plane; -iω_e P_d is the sectional diffraction force h_j of Salvesen, Tuck and Faltinsen (1970).
    `potential` (M, 3, N): φ_j at the frequencies of encounter, conjugate where these are negative;
    `frequency` ω (M,) [rad/s] of the waves; phase and heading as in `froude_krylov_section`.
    """
    omega = np.asarray(frequency, dtype=float)
    k = omega**2 / solution.gravity
    sine = np.sin(wave_heading)
    n2, n3 = solution.contour.normal.T
    wave = solution.contour.exponential(k * sine, k)
    flow = 1j * omega[:, None] * (n3 + 1j * sine[:, None] * n2) * wave
    momentum: ComplexArray = solution.water_density * np.einsum("mjn,mn->mj", potential, flow)
    return momentum
