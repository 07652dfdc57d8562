"""The momentum that leaves at a transom, in the time domain: P_T = a∞ ν + C x per metre, ẋ = A x + B ν.

In the momentum form the end terms of Salvesen, Tuck and Faltinsen (1970) are the load −U P_T: for a
sinusoidal motion P_T = (a + b/(iω_e)) ν with the added mass and damping of the section at the transom. Its
memory is found as that of a ship is, in the three motions that a section has.
"""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.hydro.conditioning import damping_roughness, symmetrise
from panelsim.hydro.memory import memory_functions
from panelsim.hydro.memory_states import MemoryStates, memory_states
from panelsim.hydro.strip.assembly import section_motion
from panelsim.hydro.strip.sections import Section
from panelsim.hydro.strip.solution import SectionSolution

_OF_SECTION = slice(1, 4)  # sway, heave and roll among the six motions


@dataclass(frozen=True)
class TransomMemory:
    """`added_mass_infinite` a∞ (6, 6) [kg/m, kg, kg m] and `states` about the centre of gravity."""

    added_mass_infinite: FloatArray
    states: MemoryStates

    def __post_init__(self) -> None:
        self.added_mass_infinite.setflags(write=False)


@dataclass(frozen=True, eq=False)
class _SectionCoefficients:
    """A section as `RadiationCoefficients`: as if it were all of the ship, without surge, pitch and yaw."""

    frequencies: FloatArray
    added_mass: FloatArray
    radiation_damping: FloatArray
    added_mass_infinite: FloatArray
    length: float
    half_breadth: float

    @property
    def added_mass_zero(self) -> FloatArray:
        return self.added_mass[0]

    @property
    def damping_roughness(self) -> float:
        return damping_roughness(self.frequencies, self.radiation_damping, self.half_breadth)


def transom_memory(section: Section, solution: SectionSolution, length: float) -> TransomMemory:
    """Memory of the section at a transom of a ship of this length [m], solved from rest to infinity.

    Raises PanelsimError as `memory_functions` and `memory_states` do.
    """
    coefficients = _coefficients(section, solution, length)
    functions = memory_functions(coefficients)
    states = memory_states(functions)
    motion = np.zeros((6, 6))
    motion[_OF_SECTION] = section_motion(section.x)
    return TransomMemory(
        motion.T @ functions.added_mass_infinite @ motion,
        MemoryStates(states.transition, states.entrance @ motion, motion.T @ states.momentum, states.error),
    )


def _coefficients(section: Section, solution: SectionSolution, length: float) -> _SectionCoefficients:
    half_breadth = float(np.abs(section.points[:, 0]).max())

    def of_six(sectional: FloatArray) -> FloatArray:
        whole = np.zeros((len(sectional), 6, 6))
        whole[:, _OF_SECTION, _OF_SECTION] = sectional
        return symmetrise(whole, mirror_symmetric=section.symmetric, half_breadth=half_breadth)[0]

    added_mass = of_six(solution.added_mass)
    return _SectionCoefficients(
        frequencies=solution.frequencies[:-1],
        added_mass=added_mass[:-1],
        radiation_damping=of_six(solution.damping)[:-1],
        added_mass_infinite=added_mass[-1],
        length=length,
        half_breadth=half_breadth,
    )
