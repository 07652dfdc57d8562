"""What a solver of sections hands on: potentials round the outline, added mass and damping."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.strip.contour import Contour


@dataclass(frozen=True, eq=False)
class SectionSolution:
    """Radiation by one section in sway, heave and roll about the origin of ship axes, exp(+iωt).

    `frequencies` (F,) [rad/s]; `potential` (F, 3, N): φ_j on each element for unit velocity, ∂φ_j/∂n = n_j
    with n into the water and n_4 = y n_3 - z n_2 [m, roll m²]; `added_mass`, `damping` (F, 3, 3) per metre
    of length, row force, column motion [kg/m, kg, kg m; kg/(s m), kg/s, kg m/s].
    """

    contour: Contour
    frequencies: FloatArray
    potential: ComplexArray
    water_density: float
    gravity: float
    added_mass: FloatArray
    damping: FloatArray

    @classmethod
    def of_potential(
        cls,
        contour: Contour,
        frequencies: FloatArray,
        potential: ComplexArray,
        water_density: float,
        gravity: float,
    ) -> "SectionSolution":
        """Added mass and damping from a + b/(iω) = -ρ ∫ φ_j n_i dl."""
        inertia = -water_density * np.einsum("fjn,in->fij", potential, contour.modes * contour.length)
        finite = np.where(np.isfinite(frequencies), frequencies, 0.0)
        solution = cls(
            contour,
            frequencies,
            potential,
            water_density,
            gravity,
            np.ascontiguousarray(inertia.real),
            -finite[:, None, None] * inertia.imag,
        )
        for array in (frequencies, potential, solution.added_mass, solution.damping):
            array.setflags(write=False)
        return solution

    def radiated_wave(self, to_port: bool = True) -> ComplexArray:
        """Kochin function H_j (F, 3) [m, roll m²] of the wave that each motion sends to port or starboard.

        H_j = ∫ (n_j - φ_j ∂/∂n) exp(k (z - waterline) ± i k y) dl, + to port. Far away
        φ_j = i H_j exp(k (z - waterline) ∓ i k y), the elevation for unit amplitude of motion is k |H_j|, and
        energy asks for b_jj = ρω (|H_j to port|² + |H_j to starboard|²) / 2. No wave at infinite frequency.
        """
        finite = np.isfinite(self.frequencies)
        k = self.frequencies[finite] ** 2 / self.gravity
        side = 1.0 if to_port else -1.0
        wave = self.contour.exponential(side * k, k)
        n2, n3 = self.contour.normal.T
        flow = k[:, None] * (n3 + 1j * side * n2) * wave
        kochin = np.zeros((len(finite), 3), dtype=np.complex128)
        kochin[finite] = np.einsum("jn,fn->fj", self.contour.modes, wave)
        kochin[finite] -= np.einsum("fjn,fn->fj", self.potential[finite], flow)
        return kochin


def require_water(frequencies: FloatArray, water_density: float, gravity: float) -> FloatArray:
    """The frequencies (F,) as an array, infinity allowed; raises PanelsimError for what is not positive."""
    omega = np.atleast_1d(np.array(frequencies, dtype=np.float64))
    if omega.ndim != 1 or omega.size == 0 or not (omega > 0.0).all():
        raise PanelsimError(
            "Frequencies of a section must be more than 0",
            got=omega.tolist(),
            allowed="a row of rad/s above 0, infinity among them",
            remedy="heave has no added mass at rest: it grows as the logarithm of the frequency",
        )
    for name, value in (("water density", water_density), ("gravity", gravity)):
        if not (np.isfinite(value) and value > 0.0):
            raise PanelsimError(f"The {name} is not positive", got=value, allowed="a number above 0")
    return omega
