"""Sine and exponential from tables, as TM 2003-190 section 7 tried them, in the NumPy twin of the kernel."""

from dataclasses import dataclass, field

import numpy as np

from panelsim.conventions import FloatArray, rotation_to_earth
from panelsim.kernels.oracle import Surroundings

TURN = 4096  # entries a turn: a cosine within 1.6e-3
DEEPEST, DEPTHS = 20.0, 65536  # exp(-20) is nothing; 3e-4 between entries

_COSINE = np.cos(2.0 * np.pi / TURN * (np.arange(TURN) + 0.5))
_DECAY = np.exp(-DEEPEST / DEPTHS * (np.arange(DEPTHS) + 0.5))


@dataclass(frozen=True)
class LookUpSurroundings(Surroundings):
    """The water about the ship in sinusoidal waves with Wheeler stretching, by the nearest entries of tables.

    The report had sine and cosine from tables; with `decay_too` the exponential as well.
    """

    stretching: str = field(default="wheeler", init=False)
    decay_too: bool = False

    def at(self, points: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Depth [m], pressure and pressure to cut [Pa] at points (..., 3), as `Surroundings.at` has them."""
        time, wave_factor = self.pose[:2]
        earth = points @ rotation_to_earth(*self.pose[5:8]).T + self.pose[2:5]
        z = earth[..., 2] - self.waterline
        sea = self.waves
        phase = (
            earth[..., 0, None] * sea.wavenumber_x
            + earth[..., 1, None] * sea.wavenumber_y
            - sea.encounter_frequency * time
            - sea.phase
        )
        crest = wave_factor * sea.amplitude * cosine(phase)
        elevation = crest.sum(axis=-1)
        exponent = sea.wavenumber * np.minimum(z - elevation, 0.0)[..., None]
        head = (crest * (decay(exponent) if self.decay_too else np.exp(exponent))).sum(axis=-1)
        return elevation - z, self.weight_density * (head - z), np.zeros_like(z)


def cosine(angle: FloatArray) -> FloatArray:
    """cos of any angle [rad] by the nearest entry."""
    entry = np.floor(angle * (TURN / (2.0 * np.pi))).astype(np.int64)
    return np.asarray(_COSINE[entry & (TURN - 1)])


def decay(exponent: FloatArray) -> FloatArray:
    """exp of numbers at or below 0 by the nearest entry."""
    entry = (exponent * (-DEPTHS / DEEPEST)).astype(np.int64)
    return np.asarray(_DECAY[np.minimum(entry, DEPTHS - 1)])
