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
        rate = instant.velocity[:, Dof.ROLL]
        size = np.abs(rate)
        linear, quadratic, cubic = self._terms.T
        load = np.zeros_like(instant.velocity)
        load[:, Dof.ROLL] = -rate * (linear + size * (quadratic + size * cubic))
        return load


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
