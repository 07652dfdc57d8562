"""Weight."""

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.loads.load import Instant


class Weight:
    """The ship's weight: −m g in heave, no moment about the centre of gravity."""

    name = "weight"

    def __init__(self, mass: float, gravity: float) -> None:
        self._load = np.zeros(6)
        self._load[Dof.HEAVE] = -mass * gravity

    def evaluate(self, instant: Instant) -> FloatArray:
        """The same (6,) at every instant."""
        return self._load
