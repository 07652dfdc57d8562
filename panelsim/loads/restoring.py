"""Linear hydrostatic restoring."""

from panelsim.conventions import FloatArray
from panelsim.loads.load import Instant


class Restoring:
    """−C η: the change of buoyancy and weight together, linear in the motions about rest."""

    name = "restoring"

    def __init__(self, stiffness: FloatArray) -> None:
        self._stiffness = stiffness

    def evaluate(self, instant: Instant) -> FloatArray:
        """Load (6,) in translating earth axes."""
        return -self._stiffness @ instant.displacement
