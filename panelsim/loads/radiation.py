"""Radiation load at forward speed, in the momentum form: zero-speed memory serves every speed.

With ν = η̇ + L η (L35 = +U, L26 = −U: heave sees the pitch, sway the yaw of a moving ship) the water
holds the momentum P = A∞ ν + P_m, P_m = ∫ R(s) ν(t − s) ds, and pushes back with
F = −Ṗ + Lᵀ P. For a sinusoidal motion this is the table of Salvesen, Tuck and Faltinsen (1970) without
transom terms; nothing is divided by ω_e, and C55 = −U² A33(0), C66 = −U² A22(0) (Munk) are in it.
"""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.memory import ConvolutionWeights, convolution_weights, memory_functions


def speed_coupling(speed: float) -> FloatArray:
    """L (6, 6) [m/s]: ν = η̇ + L η is the velocity of the hull relative to the stream."""
    coupling = np.zeros((6, 6))
    coupling[Dof.HEAVE, Dof.PITCH] = speed
    coupling[Dof.SWAY, Dof.YAW] = -speed
    return coupling


@dataclass(frozen=True, slots=True)
class Past:
    """What past velocities leave in P_m and its rate, besides the newest sample's own part.

    `fixed` (12,): P_m above, Ṗ_m below; `newest` (12, 6) turns the newest ν into its own part of both.
    """

    fixed: FloatArray
    newest: FloatArray


class Radiation:
    """Radiation load of one ship at one speed, stepped with one time step.

    Not a `Load` of an instant alone: it also needs the past. That is a plain array of samples of ν, newest
    first, `memory` (n, 6), which the stepper carries from step to step. `evaluate` leaves out −A∞ η̈;
    the equations of motion hold A∞ on the left.
    """

    name = "radiation"

    def __init__(self, database: HydroDatabase, speed: float, time_step: float) -> None:
        functions = memory_functions(database)
        self.added_mass_infinite = functions.added_mass_infinite
        self.coupling = speed_coupling(speed)
        whole = convolution_weights(functions, time_step, time_step)
        half = convolution_weights(functions, time_step, 0.5 * time_step)
        self._newest = {1.0: _column(whole, 0), 0.5: _column(half, 0)}
        self._older = {1.0: _row(whole), 0.5: _row(half)}
        self.sample_count = len(whole.momentum)

    def start(self, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """Memory (n, 6) of a ship that has always been held at this displacement, then let go."""
        memory = np.tile(self.coupling @ displacement, (self.sample_count, 1))
        memory[0] += velocity
        return memory

    def remember(self, memory: FloatArray, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """The memory one step later, with ν of the new state in front."""
        newest = velocity + self.coupling @ displacement
        return np.concatenate([newest[None], memory[:-1]])

    def past(self, memory: FloatArray, fraction: float) -> Past:
        """The part of the past in P_m and Ṗ_m at this fraction (0, ½, 1) of the coming step."""
        if fraction == 0.0:
            return Past(self._older[1.0] @ memory[1:].ravel(), self._newest[1.0])
        return Past(self._older[fraction] @ memory[:-1].ravel(), self._newest[fraction])

    def evaluate(self, past: Past, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """Load (6,) without its −A∞ η̈: −A∞ L η̇ − Ṗ_m + Lᵀ(A∞ ν + P_m)."""
        relative = velocity + self.coupling @ displacement
        memory_part = past.fixed + past.newest @ relative
        momentum = self.added_mass_infinite @ relative + memory_part[:6]
        inertial = self.added_mass_infinite @ (self.coupling @ velocity)
        return self.coupling.T @ momentum - inertial - memory_part[6:]


def _column(weights: ConvolutionWeights, sample: int) -> FloatArray:
    return np.concatenate([weights.momentum[sample], weights.rate[sample]])


def _row(weights: ConvolutionWeights) -> FloatArray:
    """Weights of all but the newest sample as one matrix (12, 6 (n − 1))."""
    both = np.concatenate([weights.momentum[1:], weights.rate[1:]], axis=1)
    return np.ascontiguousarray(both.transpose(1, 0, 2).reshape(12, -1))
