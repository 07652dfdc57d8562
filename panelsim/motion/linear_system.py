"""The linear part of the motions of a ship as one system of first order."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.known_loads import KnownLoads


@dataclass(frozen=True)
class LinearSystem:
    """ẏ = S y + G u of a ship: `matrix` S (n, n), and what each load has of y, `loads` (6 L, n).

    y is displacement, velocity and the memory of the radiated waves; accelerations u (6,) enter as such.
    """

    matrix: FloatArray
    loads: FloatArray

    @classmethod
    def of(cls, equations: EquationsOfMotion, known: KnownLoads, ship: int) -> "LinearSystem":
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
        return cls(matrix, loads.reshape(-1, radiation.motion_size))

    @property
    def entrance(self) -> FloatArray:
        """G (n, 6)."""
        return np.eye(len(self.matrix), 6, -6)
