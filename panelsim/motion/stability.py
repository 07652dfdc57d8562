"""How much a time step of each scheme makes of the linear motions of a ship: whether the scheme is stable."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import Polynomial

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.radiation import Radiation
from panelsim.loads.roll_damping import RollDamping
from panelsim.motion.adams_bashforth import WEIGHTS
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.exact import advance, polynomial_inputs
from panelsim.motion.exponential import forward, spread
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.linear_system import LinearSystem
from panelsim.motion.requirements import LONGEST_STEP, rounded_down

# exp(z) to the order of the scheme (Hairer and Wanner 1996, IV.2).
_RUNGE_KUTTA_4 = Polynomial([1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0])
# A drift without springs has an eigenvalue of 1 twice; rounding parts the two by its root.
_ROUNDING = 1e-5
# Any sea worth a run rolls a ship so far. Where she rolls further her history says whether it was too far.
ROLL = np.deg2rad(10.0)
FASTEST_ROLL = 10.0  # rad/s; no ship rolls so, but a motion that diverges does


@dataclass(frozen=True)
class Stability:
    """Of the linear motions of one ship by one scheme: `ship` is her number in the batch of `equations`.

    `terms` are her roll damping, linear at each roll rate for itself.
    """

    stepper: str
    equations: EquationsOfMotion
    known: KnownLoads
    ship: int
    terms: RollDampingTerms | None

    @cached_property
    def _system(self) -> LinearSystem:
        return LinearSystem.of(self.equations, self.known, self.ship)

    @cached_property
    def _natural_frequency(self) -> float:
        """The highest [rad/s], of undamped motions."""
        stiffness = sum(
            -(slope if slope.ndim == 2 else slope[self.ship])[:, :6] for slope in self.known.slopes.values()
        )
        squared = np.linalg.eigvals(self.equations.inverse @ stiffness).real
        return float(np.sqrt(max(squared.max(), 0.0)))

    @cached_property
    def _roll_rates(self) -> tuple[float, ...]:
        """At which the roll damping is looked at [rad/s]: none, and that of a roll of 10°."""
        if not self._grows_with_rate:
            return (0.0,)
        by_roll = -float(self._system.matrix[6 + Dof.ROLL, Dof.ROLL])
        return 0.0, ROLL * float(np.sqrt(max(by_roll, 0.0)))

    @property
    def _grows_with_rate(self) -> bool:
        return self.terms is not None and bool(self.terms.quadratic or self.terms.cubic)

    def require(self, time_step: float) -> None:
        """Raise PanelsimError for a time step [s] that follows the ship's own motions badly, or unstably.

        Quadratic and cubic roll damping is that of a roll of 10° at her natural frequency.
        """
        fault = self._fault(time_step)
        if fault is None:
            return
        elsewhere = "" if self.stepper == "exponential" else ", or take the stepper exponential"
        raise PanelsimError(
            "The time step is too long for the motions of the ship",
            got=f"{time_step:g} s, {fault}",
            allowed=f"at most {self._longest(time_step)} s with the stepper {self.stepper}",
            remedy="shorten run.time_step; a tenth of the natural period is accurate"
            if "period" in fault
            else f"shorten run.time_step, or lessen the damping{elsewhere}",
        )

    def _fault(self, time_step: float) -> str | None:
        """What is wrong with a time step [s]."""
        if self._natural_frequency * time_step > LONGEST_STEP[self.stepper]:
            return f"with a natural period of {2 * np.pi / self._natural_frequency:.3g} s"
        for rate in self._roll_rates:
            if not self.holds(time_step, rate):
                damping = f" with the roll damping at {rate:.2g} rad/s, a roll of 10°" if rate else ""
                return f"at which {self.stepper} is unstable{damping}"
        return None

    def notes(self, time_step: float, roll_rate: FloatArray) -> list[str]:
        """Say where the roll rate (T,) [rad/s] of a run went beyond what its step [s] follows."""
        fastest = float(np.abs(roll_rate).max())
        if not self._grows_with_rate or self.holds(time_step, min(fastest, FASTEST_ROLL)):
            return []
        return [
            f"The roll reached {fastest:.3g} rad/s; there the roll damping is so strong that a time step of"
            f" {time_step:g} s is unstable with the stepper {self.stepper}: the motion is not to be trusted"
            " from then on. Take a shorter step."
        ]

    def holds(self, time_step: float, roll_rate: float = 0.0) -> bool:
        """Whether no motion grows in a step [s] that does not by itself, with the damping at a roll rate."""
        residual = np.zeros((6, len(self._system.matrix)))
        if self.terms is not None:
            slope = RollDamping([self.terms]).slope_beside(roll_rate)[0]
            residual[:, 6:12] = self.equations.inverse @ slope
        return _is_stable(
            self.stepper, self._system, residual, self.equations.radiation, self.ship, time_step
        )

    def _longest(self, time_step: float) -> str:
        """The longest step [s] without a fault, below one that has one, as text."""
        high, low = time_step, 0.5 * time_step
        while self._fault(low):
            high, low = low, 0.5 * low
        while high > 1.001 * low:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self._fault(middle) else (middle, high)
        return rounded_down(low)


@np.errstate(over="ignore", invalid="ignore")  # of damping beyond all measure: unstable
def _is_stable(
    stepper: str,
    system: LinearSystem,
    residual: FloatArray,
    radiation: Radiation,
    ship: int,
    time_step: float,
) -> bool:
    """As `Stability.holds`; `residual` (6, n) adds to the accelerations by y what the exponential scheme does
    not advance exactly."""
    matrix = system.matrix.copy()
    matrix[6:12] += residual
    own = np.linalg.eigvals(matrix)
    if stepper == "rk4":
        step = np.abs(_RUNGE_KUTTA_4(own * time_step))
    elif stepper == "ab3":
        step = np.abs(np.linalg.eigvals(_adams_bashforth(matrix, radiation, ship, time_step)))
    elif residual.any():
        step = np.abs(np.linalg.eigvals(_exponential(system, residual, time_step)))
    else:
        return True
    # A ship under way without springs turns broadside: as many motions as grow by themselves may.
    grown, growing = ~(step <= 1.0 + _ROUNDING), own.real * time_step > 0.5 * _ROUNDING
    return bool(grown.sum() <= growing.sum())


def _adams_bashforth(matrix: FloatArray, radiation: Radiation, ship: int, time_step: float) -> FloatArray:
    """One step of `AdamsBashforth3` from y, and from rates and ν one step and two steps earlier."""
    size = len(matrix)
    y = np.eye(size, size + 36)
    rates, relative = np.eye(12, size + 36, size), np.eye(6, size + 36, size + 12)
    before, long_before = (rates, relative), (np.roll(rates, 18, axis=1), np.roll(relative, 18, axis=1))
    to_relative = np.hstack([radiation.coupling[ship], np.eye(6)])
    now = matrix[:12] @ y, to_relative @ y[:12]
    states = radiation.states
    moved = y[:12] + time_step * (WEIGHTS[0] * now[0] + WEIGHTS[1] * before[0] + WEIGHTS[2] * long_before[0])
    inputs = polynomial_inputs(states.transition, states.entrance, time_step, (1, 0, -1))
    memory = advance(states.transition, time_step) @ y[12:size]
    memory += inputs[0] @ to_relative @ moved + inputs[1] @ now[1] + inputs[2] @ before[1]
    return np.concatenate([moved, memory, *now, *before])


def _exponential(system: LinearSystem, residual: FloatArray, time_step: float) -> FloatArray:
    """One step of `Exponential` from y and the last three r, with r = `residual` y, evaluated again."""
    size = len(system.matrix)
    ahead = forward(system, time_step, 2)[: size + 6]
    change = spread(system, time_step, 1)[:size] @ (residual @ ahead[:size] - ahead[size:])
    moved = ahead[:size] + change
    return np.concatenate([moved, residual @ moved, np.eye(12, size + 18, size)])
