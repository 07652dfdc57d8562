"""The schemes by name."""

from collections.abc import Callable, Mapping

from panelsim.motion.adams_bashforth import AdamsBashforth3
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.exponential import Exponential
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.runge_kutta import RungeKutta4
from panelsim.motion.stepper import Stepper

STEPPERS: Mapping[str, Callable[[EquationsOfMotion, KnownLoads, float], Stepper]] = {
    "exponential": Exponential,
    "rk4": lambda equations, known, time_step: RungeKutta4(equations, time_step),
    "ab3": lambda equations, known, time_step: AdamsBashforth3(equations, time_step),
}


def make_stepper(name: str, equations: EquationsOfMotion, known: KnownLoads, time_step: float) -> Stepper:
    """The scheme "exponential", "rk4" or "ab3" for these equations and a time step [s]."""
    return STEPPERS[name](equations, known, time_step)
