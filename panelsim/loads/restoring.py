"""Linear hydrostatic restoring."""

from panelsim.conventions import FloatArray
from panelsim.loads.load import Instant, times_each


class Restoring:
    """−C η: the change of buoyancy and weight together, linear in the motions about rest."""

    name = "restoring"

    def __init__(self, stiffness: FloatArray) -> None:
        self._negative_stiffness = -stiffness

    def evaluate(self, instant: Instant) -> FloatArray:
        """Load (B, 6) in translating earth axes."""
        return times_each(self._negative_stiffness, instant.displacement)
