"""Deep-water dispersion and the frequency at which a moving ship meets a wave."""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import STANDARD_GRAVITY, FloatArray


def wavenumber(frequency: ArrayLike, gravity: float = STANDARD_GRAVITY) -> FloatArray:
    """Wavenumber k = ω²/g [rad/m] in deep water, TM 2003-190 (2); frequency in rad/s."""
    return np.asarray(frequency, dtype=float) ** 2 / gravity


def encounter_frequency(
    frequency: ArrayLike, wave_heading: ArrayLike, speed: float, gravity: float = STANDARD_GRAVITY
) -> FloatArray:
    """Encounter frequency ω_e = ω − U k cos β [rad/s] with its sign.

    TM 2003-190 (11) takes the modulus, which would turn a wave that the ship overtakes around;
    here ω_e < 0 there. Heading in rad (0 following, π head), speed in m/s.
    """
    frequency = np.asarray(frequency, dtype=float)
    return frequency - speed * wavenumber(frequency, gravity) * np.cos(wave_heading)
