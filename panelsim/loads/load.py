"""What every load on the ship looks like."""

from dataclasses import dataclass
from typing import Protocol

from panelsim.conventions import FloatArray


@dataclass(frozen=True, slots=True)
class Instant:
    """The ship at one moment: all that a load may depend on.

    `time` [s]; `wave_factor` (0 to 1) multiplies the wave amplitudes while a run fades its sea in;
    `displacement` and `velocity` (6,) in translating earth axes [m, rad, m/s, rad/s].
    """

    time: float
    wave_factor: float
    displacement: FloatArray
    velocity: FloatArray


class Load(Protocol):
    """A force and moment (6,) conjugate to the motions η1..η6 in translating earth axes [N, N m]."""

    @property
    def name(self) -> str: ...

    def evaluate(self, instant: Instant) -> FloatArray: ...
