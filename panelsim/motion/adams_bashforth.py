"""The third-order Adams-Bashforth scheme."""

from dataclasses import replace

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.loads.load import times_each
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.exact import advance, polynomial_inputs
from panelsim.motion.runge_kutta import RungeKutta4
from panelsim.motion.stepper import State

# Of the rates now, one step and two steps ago.
WEIGHTS = (23.0 / 12.0, -16.0 / 12.0, 5.0 / 12.0)


class AdamsBashforth3:
    """One evaluation of the loads a step: displacement and velocity go on with the parabola of their last
    rates.

    η_(n+1) = η_n + h (23 η̇_n − 16 η̇_(n−1) + 5 η̇_(n−2))/12 and likewise η̇ with η̈. The memory follows
    exactly for relative velocities ν that are a parabola through the last three, the new one among them.
    The first two steps are Runge-Kutta's. `State.past` has rates (η̇, η̈) and ν of the last two instants.
    """

    def __init__(self, equations: EquationsOfMotion, time_step: float) -> None:
        self._equations = equations
        self._time_step = time_step
        self._first = RungeKutta4(equations, time_step)
        states = equations.radiation.states
        self._decay = advance(states.transition, time_step)
        inputs = polynomial_inputs(states.transition, states.entrance, time_step, (1, 0, -1))
        self._inputs = np.concatenate(list(inputs), axis=1)

    def start(self, displacement: FloatArray, velocity: FloatArray) -> State:
        """As for every `Stepper`."""
        state = self._first.start(displacement, velocity)
        return replace(state, past=np.zeros((len(displacement), 36)))

    def step(self, state: State) -> State:
        """The state one time step later."""
        now = np.concatenate([state.velocity, state.acceleration, self._relative(state.motion)], axis=1)
        before, long_before = state.past[:, :18], state.past[:, 18:]
        past = np.concatenate([now, before], axis=1)
        if state.step < 2:
            return replace(self._first.step(state), past=past)
        rate = WEIGHTS[0] * now[:, :12] + WEIGHTS[1] * before[:, :12] + WEIGHTS[2] * long_before[:, :12]
        moved = state.motion[:, :12] + self._time_step * rate
        relative = np.concatenate([self._relative(moved), now[:, 12:], before[:, 12:]], axis=1)
        memory = times_each(self._decay, state.motion[:, 12:]) + times_each(self._inputs, relative)
        motion = np.concatenate([moved, memory], axis=1)
        end = (state.step + 1) * self._time_step
        return State(state.step + 1, motion, past, *self._equations.evaluate(end, motion))

    def _relative(self, motion: FloatArray) -> FloatArray:
        """ν = η̇ + L η (B, 6)."""
        return motion[:, 6:12] + times_each(self._equations.radiation.coupling, motion[:, :6])
