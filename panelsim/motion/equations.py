"""Equations of motion: (M + A∞) η̈ = the sum of all loads, less the −A∞ η̈ that stands on the left."""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.loads.load import Instant, Load, times_each
from panelsim.loads.radiation import Past, Radiation


class EquationsOfMotion:
    """M η̈ = Σ loads in translating earth axes, with M the inertia (6, 6) at rest about the CG.

    For a batch of runs of one ship. As in TM 2003-190, M is constant: the gyroscopic terms of large
    angles are left out.
    """

    def __init__(self, inertia: FloatArray, loads: Sequence[Load], radiation: Radiation) -> None:
        self._loads = tuple(loads)
        self.radiation = radiation
        self._inverse = np.asarray(np.linalg.inv(inertia + radiation.added_mass_infinite), dtype=float)
        self.load_names = (*(load.name for load in self._loads), radiation.name)

    def evaluate(self, instant: Instant, past: Past) -> tuple[FloatArray, FloatArray]:
        """Accelerations (B, 6) and every load (B, n, 6) in the order of `load_names`; they sum to M η̈."""
        loads = self.evaluate_loads(instant)
        loads[:, -1] = self.radiation.evaluate(past, instant.displacement, instant.velocity)
        acceleration = times_each(self._inverse, loads.sum(axis=1))
        loads[:, -1] -= times_each(self.radiation.added_mass_infinite, acceleration)
        return acceleration, loads

    def evaluate_loads(self, instant: Instant) -> FloatArray:
        """Every load (B, n, 6) but the last, radiation, which needs the past and is zero here."""
        loads = np.zeros((len(instant.displacement), len(self.load_names), 6))
        for i, load in enumerate(self._loads):
            loads[:, i] = load.evaluate(instant)
        return loads
