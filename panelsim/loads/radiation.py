"""Radiation load at forward speed, in the momentum form: zero-speed memory serves every speed.

With ν = η̇ + L η (L35 = +U, L26 = −U: heave sees the pitch, sway the yaw of a moving ship) the water
holds the momentum P = A∞ ν + P_m, P_m = ∫ R(s) ν(t − s) ds, and pushes back with
F = −Ṗ + Lᵀ P. For a sinusoidal motion this is the table of Salvesen, Tuck and Faltinsen (1970); nothing is
divided by ω_e, and C55 = −U² A33(0), C66 = −U² A22(0) (Munk) are in it. The terms of a transom are −U P_T
more, where P_T is the momentum per metre that the section there has of the same ν, with a memory of its own.
"""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.memory_states import side_by_side
from panelsim.hydro.speed_terms import speed_coupling
from panelsim.hydro.transom import Transom
from panelsim.hydro.transom_memory import TransomMemory
from panelsim.loads.load import times_each


class Radiation:
    """Radiation load of one hull, for a batch of ships at their speeds [m/s].

    Not a `Load` of an instant alone: it also needs the past, which `MemoryStates` x hold: ẋ = A x + B ν,
    P_m = C x. A motion (B, 12 + n) is displacement η, velocity η̇ and memory x; all here is linear in it.
    `load_matrix` (B, 6, 12 + n) gives the load without its −A∞ η̈, which the equations of motion hold on the
    left: −A∞ L η̇ − Ṗ_m + Lᵀ(A∞ ν + P_m). `memory_matrix` (B, n, 12 + n) gives ẋ. With a `transom` the
    last of the states x are those of its memory, and the load has −U P_T.
    """

    name = "radiation"

    def __init__(
        self, database: HydroDatabase, speeds: Sequence[float], transom: Transom | None = None
    ) -> None:
        states = database.memory_states
        self.added_mass_infinite = database.memory.added_mass_infinite
        if transom is not None:
            states = side_by_side(states, transom.memory.states)
        self.states = states
        self.coupling = speed_coupling(np.array(speeds, dtype=float))
        self.motion_size = 12 + states.count
        self.load_matrix = np.stack([self._load_matrix(coupling) for coupling in self.coupling])
        if transom is not None:
            for speed, coupling, load in zip(speeds, self.coupling, self.load_matrix, strict=True):
                load -= speed * _momentum_matrix(transom.memory, coupling, states.count)
        enter = states.entrance
        self.memory_matrix = np.stack(
            [np.hstack([enter @ coupling, enter, states.transition]) for coupling in self.coupling]
        )
        self._held = np.array(np.linalg.solve(-states.transition, states.entrance), dtype=np.float64)

    def _load_matrix(self, coupling: FloatArray) -> FloatArray:
        """The load (6, 12 + n) by displacement, velocity and memory at one speed."""
        turned = coupling.T @ self.added_mass_infinite
        momentum = self.states.momentum
        of_memory = coupling.T @ momentum - momentum @ self.states.transition
        return np.hstack([turned @ coupling, turned - self.added_mass_infinite @ coupling, of_memory])

    def start(self, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """Motions (B, 12 + n) of ships that have always been held at these displacements, then let go."""
        memory = times_each(self._held, times_each(self.coupling, displacement))
        return np.concatenate([displacement, velocity, memory], axis=1)

    def memory_rate(self, motion: FloatArray) -> FloatArray:
        """ẋ (B, n)."""
        return times_each(self.memory_matrix, motion)

    def evaluate(self, motion: FloatArray) -> FloatArray:
        """Load (B, 6) without its −A∞ η̈."""
        return times_each(self.load_matrix, motion)


def _momentum_matrix(memory: TransomMemory, coupling: FloatArray, states: int) -> FloatArray:
    """P_T (6, 12 + n) by displacement, velocity and the last of `states` memory states at one speed."""
    infinite = memory.added_mass_infinite
    before = np.zeros((6, states - memory.states.count))
    return np.hstack([infinite @ coupling, infinite, before, memory.states.momentum])
