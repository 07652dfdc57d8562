"""The classical fourth-order Runge-Kutta scheme."""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.stepper import State


class RungeKutta4:
    """RK4 on displacement, velocity and memory together: four evaluations of the loads a step, the reference.

    It starts by itself and keeps nothing of the past.
    """

    def __init__(self, equations: EquationsOfMotion, time_step: float) -> None:
        self._equations = equations
        self._time_step = time_step

    def start(self, displacement: FloatArray, velocity: FloatArray) -> State:
        """As for every `Stepper`."""
        motion = self._equations.start(displacement, velocity)
        return State(0, motion, np.empty((len(motion), 0)), *self._equations.evaluate(0.0, motion))

    def step(self, state: State) -> State:
        """k1 from the loads of the state, k2 and k3 in the middle of the step, k4 at its end."""
        h, begin = self._time_step, state.step * self._time_step
        y, k1 = state.motion, self._equations.rate(state.motion, state.acceleration)
        k2 = self._rate(begin + 0.5 * h, y + 0.5 * h * k1)
        k3 = self._rate(begin + 0.5 * h, y + 0.5 * h * k2)
        k4 = self._rate(begin + h, y + h * k3)
        motion = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        end = (state.step + 1) * h
        return State(state.step + 1, motion, state.past, *self._equations.evaluate(end, motion))

    def _rate(self, time: float, motion: FloatArray) -> FloatArray:
        return self._equations.rate(motion, self._equations.evaluate(time, motion)[0])
