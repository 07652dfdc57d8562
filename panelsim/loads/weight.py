"""Weight."""

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.loads.load import Instant


class Weight:
    """The ship's weight: −m g in heave, no moment about the centre of gravity."""

    name = "weight"

    def __init__(self, mass: float, gravity: float) -> None:
        self._weight = mass * gravity

    def evaluate(self, instant: Instant) -> FloatArray:
        """The same (6,) for each ship (B, 6) at every instant."""
        load = np.zeros_like(instant.displacement)
        load[:, Dof.HEAVE] = -self._weight
        return load
