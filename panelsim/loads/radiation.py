"""Radiation load at forward speed, in the momentum form: zero-speed memory serves every speed.

With ν = η̇ + L η (L35 = +U, L26 = −U: heave sees the pitch, sway the yaw of a moving ship) the water
holds the momentum P = A∞ ν + P_m, P_m = ∫ R(s) ν(t − s) ds, and pushes back with
F = −Ṗ + Lᵀ P. For a sinusoidal motion this is the table of Salvesen, Tuck and Faltinsen (1970) without
transom terms; nothing is divided by ω_e, and C55 = −U² A33(0), C66 = −U² A22(0) (Munk) are in it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.memory import ConvolutionWeights, convolution_weights, memory_functions
from panelsim.loads.load import times_each


def speed_coupling(speed: float | FloatArray) -> FloatArray:
    """L (6, 6) [m/s]: ν = η̇ + L η is the velocity of the hull relative to the stream.

    For speeds (B,) [m/s] one for each, (B, 6, 6).
    """
    coupling = np.zeros((*np.shape(speed), 6, 6))
    coupling[..., Dof.HEAVE, Dof.PITCH] = speed
    coupling[..., Dof.SWAY, Dof.YAW] = -np.asarray(speed)
    return coupling


@dataclass(frozen=True, slots=True)
class Past:
    """What past velocities leave in P_m and its rate, besides the newest sample's own part.

    `fixed` (B, 12): P_m before Ṗ_m; `newest` (12, 6) turns the newest ν into its own part of both.
    """

    fixed: FloatArray
    newest: FloatArray


class Radiation:
    """Radiation load of one hull, for a batch of ships at their speeds [m/s], stepped with one time step.

    Not a `Load` of an instant alone: it also needs the past. That is a plain array of samples of ν, newest
    first, `memory` (B, n, 6), which the stepper carries from step to step. `evaluate` leaves out −A∞ η̈;
    the equations of motion hold A∞ on the left.
    """

    name = "radiation"

    def __init__(self, database: HydroDatabase, speeds: Sequence[float], time_step: float) -> None:
        functions = memory_functions(database)
        self.added_mass_infinite = functions.added_mass_infinite
        self.coupling = speed_coupling(np.array(speeds, dtype=float))
        self._transposed = self.coupling.swapaxes(1, 2).copy()
        self._turning = np.matmul(self.added_mass_infinite, self.coupling)
        whole = convolution_weights(functions, time_step, time_step)
        half = convolution_weights(functions, time_step, 0.5 * time_step)
        self._newest = {1.0: _column(whole, 0), 0.5: _column(half, 0)}
        self._older = {1.0: _row(whole), 0.5: _row(half)}
        self.sample_count = len(whole.momentum)

    def start(self, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """Memory (B, n, 6) of ships that have always been held at these displacements, then let go."""
        held = times_each(self.coupling, displacement)
        memory = np.repeat(held[:, None], self.sample_count, axis=1)
        memory[:, 0] += velocity
        return memory

    def remember(self, memory: FloatArray, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """The memory one step later, with ν of the new state in front."""
        newest = velocity + times_each(self.coupling, displacement)
        return np.concatenate([newest[:, None], memory[:, :-1]], axis=1)

    def past(self, memory: FloatArray, fraction: float) -> Past:
        """The part of the past in P_m and Ṗ_m at this fraction (0, ½, 1) of the coming step."""
        samples = memory.reshape(len(memory), -1)
        if fraction == 0.0:
            return Past(times_each(self._older[1.0], samples[:, 6:]), self._newest[1.0])
        return Past(times_each(self._older[fraction], samples[:, :-6]), self._newest[fraction])

    def evaluate(self, past: Past, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """Load (B, 6) without its −A∞ η̈: −A∞ L η̇ − Ṗ_m + Lᵀ(A∞ ν + P_m)."""
        relative = velocity + times_each(self.coupling, displacement)
        memory_part = past.fixed + times_each(past.newest, relative)
        momentum = times_each(self.added_mass_infinite, relative) + memory_part[:, :6]
        inertial = times_each(self._turning, velocity)
        return times_each(self._transposed, momentum) - inertial - memory_part[:, 6:]


def _column(weights: ConvolutionWeights, sample: int) -> FloatArray:
    return np.concatenate([weights.momentum[sample], weights.rate[sample]])


def _row(weights: ConvolutionWeights) -> FloatArray:
    """Weights of all but the newest sample as one matrix (12, 6 (n − 1))."""
    both = np.concatenate([weights.momentum[1:], weights.rate[1:]], axis=1)
    return np.ascontiguousarray(both.transpose(1, 0, 2).reshape(12, -1))
