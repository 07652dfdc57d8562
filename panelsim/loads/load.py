"""What every load on the ship looks like."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from panelsim.conventions import FloatArray


@dataclass(frozen=True, slots=True)
class Instant:
    """A batch of ships at one moment: all that a load may depend on. A single run is a batch of one.

    `time` [s]; `wave_factor` (0 to 1) multiplies the wave amplitudes while a run fades its sea in;
    `displacement` and `velocity` (B, 6) in translating earth axes [m, rad, m/s, rad/s].
    """

    time: float
    wave_factor: float
    displacement: FloatArray
    velocity: FloatArray


class Load(Protocol):
    """Forces and moments (B, 6) conjugate to the motions η1..η6 in translating earth axes [N, N m].

    The load on a ship is the same, to the last bit, whatever other ships are in the batch.
    """

    @property
    def name(self) -> str: ...

    def evaluate(self, instant: Instant) -> FloatArray: ...


def times_each(matrix: FloatArray, vectors: FloatArray) -> FloatArray:
    """The matrix (n, m), or one for each vector (B, n, m), times vectors (B, m): (B, n).

    Each number is a dot product by itself: one product of two matrices would round a vector differently
    beside others, and a large matrix times a vector differently on another number of threads.
    """
    return np.vecdot(matrix, vectors[..., None, :])
