"""Roll damping as a polynomial of the roll rate, and what it is worth as linear damping.

The moment is -(b1 p + b2 p|p| + b3 p³) with the roll rate p = φ̇. A linear damper that takes the same energy
has b_eq = b1 + 8/(3π) b2 p_a + 3/4 b3 p_a² in regular rolling of rate amplitude p_a, and
b_eq = b1 + √(8/π) b2 σ + 3 b3 σ² in Gaussian rolling of rate standard deviation σ (ITTC 7.5-02-07-04.5, 3.2).
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import nnls

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.amplitudes import require_amplitudes
from panelsim.seaway.checks import is_number, real_numbers, require_number, require_positive

_REGULAR = np.array([1.0, 8.0 / (3.0 * np.pi), 0.75])
_GAUSSIAN = np.array([1.0, np.sqrt(8.0 / np.pi), 3.0])


@dataclass(frozen=True)
class RollDampingTerms:
    """Damping of roll: `linear` b1 [N m s], `quadratic` b2 [N m s2], `cubic` b3 [N m s3], none below 0."""

    linear: float = 0.0
    quadratic: float = 0.0
    cubic: float = 0.0

    def __post_init__(self) -> None:
        for name, unit in (("linear", "N m s"), ("quadratic", "N m s2"), ("cubic", "N m s3")):
            value = getattr(self, name)
            negative = is_number(value) and value < 0.0
            remedy = "a negative term drives the roll at some rate: leave it out and fit again"
            require_number(f"{name} roll damping", value, unit, low=0.0, remedy=remedy if negative else None)
            object.__setattr__(self, name, float(value))

    @classmethod
    def of_critical(cls, ratio: float, inertia: float, stiffness: float) -> Self:
        """Linear damping as a share of the critical 2√(I C).

        `ratio` ζ, 0.05 for 5 %; `inertia` I with the added inertia [kg m2], `stiffness` C [N m/rad].
        """
        require_number("damping ratio", ratio, "of critical", low=0.0, high=1.0, remedy="5 % is 0.05")
        inertia = require_positive("The roll inertia", inertia, "kg m2")
        stiffness = require_positive("The roll stiffness", stiffness, "N m/rad")
        return cls(linear=2.0 * ratio * np.sqrt(inertia * stiffness))

    @classmethod
    def fitted(cls, roll_amplitude: ArrayLike, damping: ArrayLike, frequency: float) -> Self:
        """The terms whose equivalent damping in regular rolling comes nearest to `damping`, none below 0.

        `roll_amplitude` (A,) [rad], at least three of them; `damping` (A,) [N m s] there, at the roll
        `frequency` [rad/s].
        """
        rate = require_positive("The roll frequency", frequency, "rad/s") * require_amplitudes(roll_amplitude)
        damping = real_numbers("damping", damping)
        if damping.shape != rate.shape or len(np.unique(rate)) < 3 or not np.all(damping >= 0.0):
            raise PanelsimError(
                "Three terms cannot be fitted to this damping",
                got=f"amplitudes {np.shape(roll_amplitude)}, damping {np.round(damping, 3).tolist()}",
                allowed="three different roll amplitudes or more, each with a damping not below 0 N m s",
            )
        # Columns of one size, or the tolerance of the solver would drop the smallest.
        columns = _REGULAR * rate[:, None] ** np.arange(3)
        size = np.linalg.norm(columns, axis=0)
        terms, _ = nnls(columns / size, damping)
        return cls(*(float(term) for term in terms / size))

    def moment(self, roll_rate: ArrayLike) -> FloatArray:
        """Damping moment about x [N m], against the `roll_rate` (...) [rad/s]."""
        rate = real_numbers("roll rate", roll_rate)
        size = np.abs(rate)
        moment: FloatArray = -rate * (self.linear + size * (self.quadratic + size * self.cubic))
        return moment

    def equivalent(self, rate_amplitude: ArrayLike) -> FloatArray:
        """Linear damping [N m s] of the same energy in regular rolling of `rate_amplitude` (...) [rad/s]."""
        return self._equivalent(_REGULAR, rate_amplitude)

    def equivalent_gaussian(self, rate_deviation: ArrayLike) -> FloatArray:
        """Linear damping [N m s] of least error in Gaussian rolling of rate deviation σ (...) [rad/s]."""
        return self._equivalent(_GAUSSIAN, rate_deviation)

    def _equivalent(self, factors: FloatArray, rate: ArrayLike) -> FloatArray:
        terms = factors * np.array([self.linear, self.quadratic, self.cubic])
        damping: FloatArray = _not_negative("roll rate", rate)[..., None] ** np.arange(3) @ terms
        return damping


def _not_negative(name: str, values: ArrayLike) -> FloatArray:
    array = real_numbers(name, values)
    if not (array.size and np.all(np.isfinite(array)) and np.all(array >= 0.0)):
        raise PanelsimError(f"A {name} is negative or not finite", got=repr(values)[:60], allowed="0 or more")
    return array
