"""Strip theory: the ship as the sum of her sections, each in two-dimensional flow.

A section at x meets the velocity ν of the ship as E(x) ν, E = [[0, 1, 0, 0, 0, x], [0, 0, 1, 0, -x, 0], [0,
0, 0, 1, 0, 0]] for sway, heave and roll (Salvesen, Tuck and Faltinsen 1970, with pitch positive bow down).
Surge moves no water: strip theory has nothing to say of it.

In waves much longer than the ship the flow is not two-dimensional: a section's added mass in heave grows as
the logarithm of the wave length, and its damping falls only as ω. By the energy of the waves a slender ship's
heave damping is ρ ω ∫ B² dx in strips and ρ ω k A_wp²/2 in three dimensions; with one breadth B all along the
length L they are equal at k L = 2. `panelsim.hydro.strip.long_waves` leads the sections to rest from there.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.hydro.strip.sections import HullSections
from panelsim.hydro.strip.solution import SectionSolution

_WAVENUMBER_TIMES_LENGTH = 2.0


def lowest_strip_frequency(length: float, gravity: float) -> float:
    """Frequency [rad/s] under which the flow about a ship of this wet length [m] is three-dimensional."""
    return float(np.sqrt(_WAVENUMBER_TIMES_LENGTH * gravity / length))


def section_motion(x: float) -> FloatArray:
    """E (3, 6): sway, heave and roll velocity of the section at x [m] from the six of the ship."""
    motion = np.zeros((3, 6))
    motion[0, 1] = motion[1, 2] = motion[2, 3] = 1.0
    motion[0, 5], motion[1, 4] = x, -x
    return motion


def strip_middles(sections: HullSections) -> FloatArray:
    """x (S,) [m] of the middle of the strip that each section stands for, which need not be its station."""
    length = sections.strip_length
    return sections.aft_end + np.cumsum(length) - 0.5 * length


@dataclass(frozen=True, eq=False)
class Strips:
    """The solved sections of a hull; every solution at the same frequencies, from 0, infinity the last."""

    sections: HullSections
    solutions: tuple[SectionSolution, ...]

    @cached_property
    def middle(self) -> FloatArray:
        """x (S,) [m] of the middle of each strip, the lever of its loads."""
        return strip_middles(self.sections)

    @cached_property
    def section_inertia(self) -> ComplexArray:
        """a + b/(iω) (F + 1, S, 3, 3) per metre [kg/m, kg, kg m], the mean with their transposes."""
        inertia = np.stack([_inertia(solution) for solution in self.solutions], axis=1)
        return 0.5 * (inertia + np.swapaxes(inertia, -1, -2))

    @cached_property
    def inertia(self) -> ComplexArray:
        """A + B/(iω) (F + 1, 6, 6) = ∫ Eᵀ (a + b/(iω)) E dx of the ship about the origin of ship axes."""
        motion = np.array([section_motion(x) for x in self.middle])
        length = self.sections.strip_length
        # Not optimised into matrix products: their bits would depend on the number of threads.
        whole: ComplexArray = np.einsum(
            "s,sai,fsab,sbj->fij", length, motion, self.section_inertia, motion, optimize=False
        )
        return whole


def _inertia(solution: SectionSolution) -> ComplexArray:
    modes = solution.contour.modes * solution.contour.length
    return -solution.water_density * np.einsum("fjn,in->fij", solution.potential, modes)
