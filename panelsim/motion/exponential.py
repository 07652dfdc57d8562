"""The exponential scheme: the linear system exactly, what is left of the loads evaluated once a step."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.loads.load import times_each
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.exact import advance, harmonic_inputs, polynomial_inputs
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.stepper import State

# Samples of the residual, in steps from the start of the coming one, by how many steps there have been.
PREDICTED_FROM = ((0,), (0, -1), (0, -1, -2))
CORRECTED_FROM = ((1, 0), (1, 0, -1), (1, 0, -1))
EXTRAPOLATED = ((1.0, 0.0, 0.0), (2.0, -1.0, 0.0), (3.0, -3.0, 1.0))


@dataclass(frozen=True)
class _Waves:
    """Accelerations by the linear waves on a ship, Re Σ a exp(iωt): ω (M,) [rad/s], a (6, M) [m/s2, rad/s2]."""

    frequency: FloatArray
    acceleration: ComplexArray

    def ramped(self, ramp: float) -> "_Waves":
        """The same times ½(1 − cos(π t/ramp)): three waves for each."""
        beat = np.pi / ramp
        return _Waves(
            np.concatenate([self.frequency, self.frequency + beat, self.frequency - beat]),
            np.concatenate([0.5 * self.acceleration, *2 * [-0.25 * self.acceleration]], axis=1),
        )


@dataclass(frozen=True)
class _Gains:
    """What the waves add in the step that begins at t: `table` (n + 12, 2 M) times cos ωt and sin ωt."""

    frequency: FloatArray
    table: FloatArray

    def at(self, time: float) -> FloatArray:
        """(n + 12,)."""
        angle = self.frequency * time
        # Not a matrix product: its bits would depend on the number of threads of the linear algebra.
        total: FloatArray = np.einsum("nm,m->n", self.table, np.concatenate([np.cos(angle), np.sin(angle)]))
        return total


@dataclass(frozen=True)
class _LinearSystem:
    """ẏ = S y + G u of a ship: `matrix` S (n, n), and what each load has of y, `loads` (6 L, n)."""

    matrix: FloatArray
    loads: FloatArray

    @classmethod
    def of(cls, equations: EquationsOfMotion, known: KnownLoads, ship: int) -> "_LinearSystem":
        """That of one ship of the batch."""
        radiation = equations.radiation
        loads = np.zeros((len(equations.load_names), 6, radiation.motion_size))
        for name, slope in known.slopes.items():
            loads[equations.load_names.index(name), :, :12] = slope
        loads[-1] = radiation.load_matrix[ship]
        acceleration = equations.inverse @ loads.sum(axis=0)
        loads[-1] -= radiation.added_mass_infinite @ acceleration
        velocity = np.eye(6, radiation.motion_size, 6)
        matrix = np.concatenate([velocity, acceleration, radiation.memory_matrix[ship]])
        return cls(matrix, loads.reshape(-1, radiation.motion_size))

    @property
    def entrance(self) -> FloatArray:
        """G (n, 6): accelerations enter as such."""
        return np.eye(len(self.matrix), 6, -6)

    def forward(self, time_step: float, order: int) -> FloatArray:
        """From y and the last three r (n + 18) to y*, r* and the linear part of the acceleration at y*."""
        size = len(self.matrix)
        table = np.zeros((size + 12, size + 18))
        table[:size, :size] = advance(self.matrix, time_step)
        inputs = polynomial_inputs(self.matrix, self.entrance, time_step, PREDICTED_FROM[order])
        table[:size, size : size + 6 * len(inputs)] = np.hstack(list(inputs))
        table[size : size + 6, size:] = np.kron(EXTRAPOLATED[order], np.eye(6))
        table[-6:] = self.matrix[6:12] @ table[:size]
        return table

    def spread(self, time_step: float, order: int) -> FloatArray:
        """From r − r* (6) to the changes of y, of the acceleration and of all loads."""
        inputs = polynomial_inputs(self.matrix, self.entrance, time_step, CORRECTED_FROM[order])
        return np.concatenate([inputs[0], self.matrix[6:12] @ inputs[0], self.loads @ inputs[0]])

    def gains(self, waves: _Waves, time_step: float) -> _Gains:
        """What the waves add to `forward`."""
        moved = harmonic_inputs(self.matrix, self.entrance @ waves.acceleration, time_step, waves.frequency)
        later = waves.acceleration * np.exp(1j * waves.frequency * time_step)
        none = np.zeros_like(later)
        table = np.concatenate([moved, none, self.matrix[6:12] @ moved + later])
        return _Gains(waves.frequency, np.hstack([table.real, -table.imag]))


class Exponential:
    """Exponential predict-evaluate-correct scheme of third order, one evaluation of the loads a step.

    With y displacement, velocity and memory, ẏ = S y + G(w(t) + r): S has the slopes of the loads at rest,
    radiation with memory and the speed terms; w is the acceleration by the linear wave load; r all else,
    which is small where the motions are. S and w are advanced exactly (w in the ramp too, as three waves
    for each). The residual r is first extrapolated by a parabola through its last three values; the loads
    are evaluated at the end of that step, once; then the step is taken with the parabola through the last two
    and the new value instead: y = y* + V (r − r*). The corrected state keeps the new r, and its
    loads are those evaluated plus their slopes times y − y*. Cox and Matthews (2002) give such schemes, Hochbruck
    and Ostermann (2010) their theory. The first steps have a constant, then a line. In vanishing waves, and in the
    linear model, any step is exact.

    `State.past` has the last three residuals (18,) [m/s2, rad/s2].
    """

    def __init__(self, equations: EquationsOfMotion, known: KnownLoads, time_step: float) -> None:
        self._equations, self._time_step = equations, time_step
        linear = [_LinearSystem.of(equations, known, ship) for ship in range(len(known.encounter))]
        self._slope = np.stack([each.matrix[6:12] for each in linear])
        self._forward = [np.stack([each.forward(time_step, order) for each in linear]) for order in range(3)]
        self._spread = [np.stack([each.spread(time_step, order) for each in linear]) for order in range(2)]
        seas = [
            _Waves(encounter, equations.inverse @ amplitudes)
            for encounter, amplitudes in zip(known.encounter, known.amplitudes, strict=True)
        ]
        ramped = [sea.ramped(equations.ramp) for sea in seas] if equations.ramp else seas
        self._at_start = np.array([sea.acceleration.real.sum(axis=1) for sea in ramped])
        self._gains, self._ramped_gains = (
            [each.gains(sea, time_step) for each, sea in zip(linear, some, strict=True)]
            for some in (seas, ramped)
        )

    def start(self, displacement: FloatArray, velocity: FloatArray) -> State:
        """As for every `Stepper`."""
        motion = self._equations.start(displacement, velocity)
        acceleration, loads = self._equations.evaluate(0.0, motion)
        residual = acceleration - times_each(self._slope, motion) - self._at_start
        past = np.concatenate([residual, np.zeros((len(motion), 12))], axis=1)
        return State(0, motion, past, acceleration, loads)

    def step(self, state: State) -> State:
        """The state one time step later."""
        size = state.motion.shape[1]
        begin, end = state.step * self._time_step, (state.step + 1) * self._time_step
        gains = self._ramped_gains if begin < self._equations.ramp else self._gains
        known = np.concatenate([state.motion, state.past], axis=1)
        forward = times_each(self._forward[min(state.step, 2)], known)
        forward += np.array([each.at(begin) for each in gains])
        predicted, extrapolated, linear = forward[:, :size], forward[:, size:-6], forward[:, -6:]
        acceleration, loads = self._equations.evaluate(end, predicted)
        residual = acceleration - linear
        change = times_each(self._spread[min(state.step, 1)], residual - extrapolated)
        return State(
            state.step + 1,
            predicted + change[:, :size],
            np.concatenate([residual, state.past[:, :12]], axis=1),
            acceleration + change[:, size : size + 6],
            loads + change[:, size + 6 :].reshape(loads.shape),
        )
