"""The exponential scheme: the linear system exactly, what is left of the loads evaluated once a step."""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.loads.load import times_each
from panelsim.loads.roll_damping import RollDamping
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.exact import advance, polynomial_inputs
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.linear_system import LinearSystem
from panelsim.motion.stepper import State
from panelsim.motion.wave_gains import WaveGains

# Samples of the residual, in steps from the start of the coming one, by how many steps there have been.
PREDICTED_FROM = ((0,), (0, -1), (0, -1, -2))
CORRECTED_FROM = ((1, 0), (1, 0, -1), (1, 0, -1))
# Beyond this no exponential of the system is good to rounding; a ship is held there by no physical damping.
STIFFEST = 1e6
EXTRAPOLATED = ((1.0, 0.0, 0.0), (2.0, -1.0, 0.0), (3.0, -3.0, 1.0))


def forward(system: LinearSystem, time_step: float, order: int) -> FloatArray:
    """From y and the last three r (n + 18) to y*, r* and the linear part of the acceleration at y*."""
    size = len(system.matrix)
    table = np.zeros((size + 12, size + 18))
    table[:size, :size] = advance(system.matrix, time_step)
    inputs = polynomial_inputs(system.matrix, system.entrance, time_step, PREDICTED_FROM[order])
    table[:size, size : size + 6 * len(inputs)] = np.hstack(list(inputs))
    table[size : size + 6, size:] = np.kron(EXTRAPOLATED[order], np.eye(6))
    table[-6:] = system.matrix[6:12] @ table[:size]
    return table


def spread(system: LinearSystem, time_step: float, order: int) -> FloatArray:
    """From r − r* (6) to the changes of y, of the acceleration and of all loads."""
    inputs = polynomial_inputs(system.matrix, system.entrance, time_step, CORRECTED_FROM[order])
    return np.concatenate([inputs[0], system.matrix[6:12] @ inputs[0], system.loads @ inputs[0]])


def _require_followed(system: LinearSystem, time_step: float) -> None:
    """Raise PanelsimError for motions of which no exponential is good to rounding."""
    fastest = float(np.abs(np.linalg.eigvals(system.matrix)).max())
    if not fastest * time_step <= STIFFEST:
        raise PanelsimError(
            "The linear motions of the ship change too fast for the exponential scheme",
            got=f"by exp(−{fastest:.3g} t), {fastest * time_step:.3g} a time step",
            allowed=f"at most {STIFFEST:g} a time step",
            remedy="less supplementary damping",
        )


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
    line. In vanishing waves, and in the linear model, any step is exact. Roll damping costs nothing and is
    evaluated once more where the step has ended: that is stable at six times the damping.

    `State.past` has w + r of the last three instants (18,) [m/s2, rad/s2].
    """

    def __init__(self, equations: EquationsOfMotion, known: KnownLoads, time_step: float) -> None:
        self._equations, self._time_step = equations, time_step
        systems = [LinearSystem.of(equations, known, ship) for ship in range(len(known.turning))]
        for system in systems:
            _require_followed(system, time_step)
        self._slope = np.stack([system.matrix[6:12] for system in systems])
        self._forward = [
            np.stack([forward(each, time_step, order) for each in systems]) for order in range(3)
        ]
        self._spread = [np.stack([spread(each, time_step, order) for each in systems]) for order in range(2)]
        self._damping = [(i, load) for i, load in enumerate(equations.loads) if isinstance(load, RollDamping)]
        self._waves = WaveGains(systems, known, equations.inverse, equations.ramp, time_step)

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
        waves = self._waves.at(state.step, state.displacement)
        residuals = state.past - waves[:, -18:]
        ahead = times_each(
            self._forward[min(state.step, 2)], np.concatenate([state.motion, residuals], axis=1)
        )
        ahead += waves[:, :-18]
        predicted, extrapolated, linear = ahead[:, :size], ahead[:, size:-6], ahead[:, -6:]
        end = (state.step + 1) * self._time_step
        acceleration, loads = self._equations.evaluate(end, predicted)
        change = times_each(self._spread[min(state.step, 1)], acceleration - linear - extrapolated)
        forced = acceleration - times_each(self._slope, predicted)
        motion = predicted + change[:, :size]
        acceleration = acceleration + change[:, size : size + 6]
        loads = loads + change[:, size + 6 :].reshape(loads.shape)
        for i, damping in self._damping:
            again = damping.beside_slope(motion[:, 6:12]) - damping.beside_slope(predicted[:, 6:12])
            moved = times_each(self._equations.inverse, again)
            loads[:, i] += again
            loads[:, -1] -= times_each(self._equations.radiation.added_mass_infinite, moved)
            acceleration, forced = acceleration + moved, forced + moved
        past = np.concatenate([forced, state.past[:, :12]], axis=1)
        return State(state.step + 1, motion, past, acceleration, loads)
