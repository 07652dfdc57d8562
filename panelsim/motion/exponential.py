"""The exponential scheme: the linear system exactly, what is left of the loads evaluated once a step."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.loads.load import times_each
from panelsim.motion.equations import EquationsOfMotion, ramp_factor
from panelsim.motion.exact import advance, harmonic_inputs, polynomial_inputs
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.stepper import State

# Samples of the residual, in steps from the start of the coming one, by how many steps there have been.
PREDICTED_FROM = ((0,), (0, -1), (0, -1, -2))
CORRECTED_FROM = ((1, 0), (1, 0, -1), (1, 0, -1))
# Beyond this no exponential of the system is good to rounding; a ship is held there by no physical damping.
STIFFEST = 1e6
EXTRAPOLATED = ((1.0, 0.0, 0.0), (2.0, -1.0, 0.0), (3.0, -3.0, 1.0))


@dataclass(frozen=True)
class _Waves:
    """Accelerations by the linear waves on a ship, Re Σ a exp(iφ): a (6, M) [m/s2, rad/s2].

    `turning` (3, M) is what time, surge and sway add to φ [rad/s, rad/m].
    """

    turning: FloatArray
    acceleration: ComplexArray

    def ramped(self, ramp: float) -> "_Waves":
        """The same times ½(1 − cos(π t/ramp)): three waves for each."""
        beat = np.array([[np.pi / ramp], [0.0], [0.0]])
        return _Waves(
            np.concatenate([self.turning, self.turning + beat, self.turning - beat], axis=1),
            np.concatenate([0.5 * self.acceleration, *2 * [-0.25 * self.acceleration]], axis=1),
        )


@dataclass(frozen=True)
class _Gains:
    """What waves do in the step that begins at t, for a ship that stays where she is then.

    `table` (n + 30, 2 M) times cos φ and sin φ: their part of y*, of r* (none), of the acceleration at y*,
    and their own acceleration at t, one step and two steps earlier.
    """

    turning: FloatArray
    table: FloatArray

    def at(self, time: float, displacement: FloatArray) -> FloatArray:
        """(n + 30,) at a displacement (6,)."""
        phase = time * self.turning[0] + displacement[0] * self.turning[1] + displacement[1] * self.turning[2]
        # Not a matrix product: its bits would depend on the number of threads of the linear algebra.
        total: FloatArray = np.einsum("nm,m->n", self.table, np.concatenate([np.cos(phase), np.sin(phase)]))
        return total


@dataclass(frozen=True)
class _LinearSystem:
    """ẏ = S y + G u of a ship: `matrix` S (n, n), and what each load has of y, `loads` (6 L, n)."""

    matrix: FloatArray
    loads: FloatArray

    @classmethod
    def of(
        cls, equations: EquationsOfMotion, known: KnownLoads, ship: int, time_step: float
    ) -> "_LinearSystem":
        """That of one ship of the batch."""
        radiation = equations.radiation
        loads = np.zeros((len(equations.load_names), 6, radiation.motion_size))
        for name, slope in known.slopes.items():
            loads[equations.load_names.index(name), :, :12] = slope if slope.ndim == 2 else slope[ship]
        loads[-1] = radiation.load_matrix[ship]
        acceleration = equations.inverse @ loads.sum(axis=0)
        loads[-1] -= radiation.added_mass_infinite @ acceleration
        velocity = np.eye(6, radiation.motion_size, 6)
        matrix = np.concatenate([velocity, acceleration, radiation.memory_matrix[ship]])
        fastest = float(np.abs(np.linalg.eigvals(matrix)).max())
        if not fastest * time_step <= STIFFEST:
            raise PanelsimError(
                "The linear motions of the ship change too fast for the exponential scheme",
                got=f"by exp(−{fastest:.3g} t), {fastest * time_step:.3g} a time step",
                allowed=f"at most {STIFFEST:g} a time step",
                remedy="less supplementary damping",
            )
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
        """What the waves add to `forward`, and what they have been."""
        frequency = waves.turning[0]
        moved = harmonic_inputs(self.matrix, self.entrance @ waves.acceleration, time_step, frequency)
        later, now, before, long_before = (
            waves.acceleration * np.exp(1j * frequency * time_step * steps) for steps in (1, 0, -1, -2)
        )
        linear = self.matrix[6:12] @ moved + later
        table = np.concatenate([moved, np.zeros_like(later), linear, now, before, long_before])
        return _Gains(waves.turning, np.hstack([table.real, -table.imag]))


class Exponential:
    """Exponential predict-evaluate-correct scheme of third order, one evaluation of the loads a step.

    With y displacement, velocity and memory, ẏ = S y + G(w(t) + r): S has the slopes of the loads at rest,
    radiation with memory and the speed terms; w is the acceleration by the linear wave load where the ship
    is when the step begins; r all else, which is small where the motions are. S and w are advanced exactly
    (w in the ramp too, as three waves for each). The residual r is first extrapolated by a parabola through
    its last three values; the loads are evaluated at the end of that step, once; then the step is taken
    with the parabola through the last two and the new value instead: y = y* + V (r − r*). The corrected state
    keeps the new r; its loads are those evaluated plus their slopes times y − y*. Cox and Matthews (2002)
    give such schemes, Hochbruck and Ostermann (2010) their theory. The first steps have a constant, then a
    line. In vanishing waves, and in the linear model, any step is exact.

    `State.past` has w + r of the last three instants (18,) [m/s2, rad/s2].
    """

    def __init__(self, equations: EquationsOfMotion, known: KnownLoads, time_step: float) -> None:
        self._equations, self._time_step = equations, time_step
        linear = [_LinearSystem.of(equations, known, ship, time_step) for ship in range(len(known.turning))]
        self._slope = np.stack([each.matrix[6:12] for each in linear])
        self._forward = [np.stack([each.forward(time_step, order) for each in linear]) for order in range(3)]
        self._spread = [np.stack([each.spread(time_step, order) for each in linear]) for order in range(2)]
        seas = [
            _Waves(turning, equations.inverse @ amplitudes)
            for turning, amplitudes in zip(known.turning, known.amplitudes, strict=True)
        ]
        ramped = [sea.ramped(equations.ramp) for sea in seas] if equations.ramp else seas
        self._gains, self._ramped_gains = (
            [each.gains(sea, time_step) for each, sea in zip(linear, some, strict=True)]
            for some in (seas, ramped)
        )

    def start(self, displacement: FloatArray, velocity: FloatArray) -> State:
        """As for every `Stepper`."""
        motion = self._equations.start(displacement, velocity)
        acceleration, loads = self._equations.evaluate(0.0, motion)
        forced = acceleration - times_each(self._slope, motion)
        return State(
            0, motion, np.concatenate([forced, np.zeros((len(motion), 12))], axis=1), acceleration, loads
        )

    def step(self, state: State) -> State:
        """The state one time step later."""
        size = state.motion.shape[1]
        waves = self._waves(state)
        residuals = state.past - waves[:, -18:]
        forward = times_each(
            self._forward[min(state.step, 2)], np.concatenate([state.motion, residuals], axis=1)
        )
        forward += waves[:, :-18]
        predicted, extrapolated, linear = forward[:, :size], forward[:, size:-6], forward[:, -6:]
        end = (state.step + 1) * self._time_step
        acceleration, loads = self._equations.evaluate(end, predicted)
        change = times_each(self._spread[min(state.step, 1)], acceleration - linear - extrapolated)
        forced = acceleration - times_each(self._slope, predicted)
        return State(
            state.step + 1,
            predicted + change[:, :size],
            np.concatenate([forced, state.past[:, :12]], axis=1),
            acceleration + change[:, size : size + 6],
            loads + change[:, size + 6 :].reshape(loads.shape),
        )

    def _waves(self, state: State) -> FloatArray:
        """What the waves do in the coming step, and what they have been (B, n + 30)."""
        begin, ramp = state.step * self._time_step, self._equations.ramp
        gains = self._ramped_gains if begin < ramp else self._gains
        waves = np.array(
            [each.at(begin, where) for each, where in zip(gains, state.displacement, strict=True)]
        )
        if 0.0 <= begin - ramp < 2.0 * self._time_step:  # waves that had not yet grown to the end
            for back in (1, 2):
                earlier = max(begin - back * self._time_step, 0.0)
                first = waves.shape[1] - 18 + 6 * back
                waves[:, first : first + 6] *= ramp_factor(earlier, ramp)
        return waves
