"""Roll damping of viscosity and lift as a load: a polynomial of the roll rate of each ship."""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.load import Instant


class RollDamping:
    """Moment -(b1 φ̇ + b2 φ̇|φ̇| + b3 φ̇³) about x (ITTC 7.5-02-07-04.5, 3.1), with the terms of each ship.

    Viscosity and lift only: the damping by radiated waves is that of the radiation load. `slope` (B, 6, 12)
    has the derivatives at rest by displacement and velocity, those of the linear terms.
    """

    name = "roll_damping"

    def __init__(self, terms: Sequence[RollDampingTerms]) -> None:
        self._terms = np.array([[each.linear, each.quadratic, each.cubic] for each in terms], dtype=float)
        self.slope: FloatArray = np.zeros((len(terms), 6, 12))
        self.slope[:, Dof.ROLL, 6 + Dof.ROLL] = -self._terms[:, 0]
        self.slope.setflags(write=False)

    def evaluate(self, instant: Instant) -> FloatArray:
        """The load (B, 6) [N, N m]."""
        load = self.beside_slope(instant.velocity)
        load[:, Dof.ROLL] -= self._terms[:, 0] * instant.velocity[:, Dof.ROLL]
        return load

    def beside_slope(self, velocity: FloatArray) -> FloatArray:
        """The load (B, 6) by the quadratic and cubic terms at velocities (B, 6)."""
        rate = velocity[:, Dof.ROLL]
        size = np.abs(rate)
        load = np.zeros_like(velocity)
        load[:, Dof.ROLL] = -rate * size * (self._terms[:, 1] + size * self._terms[:, 2])
        return load

    def slope_beside(self, rate: float) -> FloatArray:
        """Derivatives of `beside_slope` (B, 6, 6) by velocity at a roll rate [rad/s]."""
        size = abs(rate)
        slope = np.zeros((len(self._terms), 6, 6))
        slope[:, Dof.ROLL, Dof.ROLL] = -size * (2.0 * self._terms[:, 1] + 3.0 * size * self._terms[:, 2])
        return slope


def require_linear_terms(terms: RollDampingTerms) -> None:
    """Raise PanelsimError for terms that the linear model cannot take."""
    if terms.quadratic or terms.cubic:
        raise PanelsimError(
            "The linear model takes linear roll damping only",
            got=f"{describe_terms(terms)}",
            allowed="quadratic and cubic terms of 0",
            remedy="RollDampingTerms(linear=terms.equivalent(roll rate amplitude)), in a random sea"
            " equivalent_gaussian(its standard deviation); or model nonlinear",
        )


def describe_terms(terms: RollDampingTerms) -> str:
    """The terms with their units, in one line."""
    return (
        f"linear {terms.linear:.4g} N m s, quadratic {terms.quadratic:.4g} N m s2,"
        f" cubic {terms.cubic:.4g} N m s3"
    )
