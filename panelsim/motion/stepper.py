"""What every stepper looks like: a pure function from the state of a run to the state one step later."""

from dataclasses import dataclass, replace
from typing import Protocol

from panelsim.conventions import FloatArray
from panelsim.motion.equations import BoolArray, held


@dataclass(frozen=True, slots=True)
class State:
    """A batch of runs after `step` steps, all that the next one depends on.

    `motion` (B, 12 + n): displacement [m, rad], velocity and memory of the radiated waves. `past` (B, m):
    what the scheme keeps of earlier steps. `acceleration` (B, 6) and every load `loads` (B, L, 6) at this
    instant.
    """

    step: int
    motion: FloatArray
    past: FloatArray
    acceleration: FloatArray
    loads: FloatArray

    @property
    def displacement(self) -> FloatArray:
        """(B, 6) [m, rad]."""
        return self.motion[:, :6]

    @property
    def velocity(self) -> FloatArray:
        """(B, 6) [m/s, rad/s]."""
        return self.motion[:, 6:12]

    def holding(self, running: BoolArray) -> "State":
        """The state with all members at rest that do not run (B,)."""
        motion, past, acceleration = (
            held(value, running) for value in (self.motion, self.past, self.acceleration)
        )
        return replace(self, motion=motion, past=past, acceleration=acceleration)


class Stepper(Protocol):
    """A scheme with its time step and equations of motion built in.

    What becomes of a member does not depend, to the last bit, on the others of the batch.
    """

    def start(self, displacement: FloatArray, velocity: FloatArray) -> State:
        """The state at t = 0 of ships held at displacements (B, 6), then let go at velocities (B, 6)."""
        ...

    def step(self, state: State) -> State:
        """The state one time step later."""
        ...
