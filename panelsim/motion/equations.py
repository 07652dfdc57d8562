"""Equations of motion: (M + A∞) η̈ = the sum of all loads, less the −A∞ η̈ that stands on the left."""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.loads.load import Instant, Load
from panelsim.loads.radiation import Past, Radiation


class EquationsOfMotion:
    """M η̈ = Σ loads in translating earth axes, with M the inertia (6, 6) at rest about the CG.

    As in TM 2003-190, M is constant: the gyroscopic terms of large angles are left out.
    """

    def __init__(self, inertia: FloatArray, loads: Sequence[Load], radiation: Radiation) -> None:
        self._loads = tuple(loads)
        self.radiation = radiation
        self._inverse = np.linalg.inv(inertia + radiation.added_mass_infinite)
        self.load_names = (*(load.name for load in self._loads), radiation.name)

    def evaluate(self, instant: Instant, past: Past) -> tuple[FloatArray, FloatArray]:
        """Acceleration (6,) and every load (n, 6) in the order of `load_names`; their sum is M η̈."""
        loads = np.empty((len(self.load_names), 6))
        for i, load in enumerate(self._loads):
            loads[i] = load.evaluate(instant)
        loads[-1] = self.radiation.evaluate(past, instant.displacement, instant.velocity)
        acceleration = self._inverse @ loads.sum(axis=0)
        loads[-1] -= self.radiation.added_mass_infinite @ acceleration
        return acceleration, loads
