"""A seaway seen from translating earth axes, TM 2003-190 sections 2.3 and 2.4."""

from dataclasses import dataclass, field

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.coordinates import require_speed
from panelsim.seaway.view import SeawayView


@dataclass(frozen=True, eq=False)
class TranslatingSeaway(SeawayView):
    """Waves in axes that move with the mean speed [m/s] and course of the ship, x forward and y to port.

    A wave is a cos(k(x cos β − y sin β) − ω_e t − ε), (10), with ω_e = ω − U k cos β and its sign: with the
    modulus of (11) a wave that the ship overtakes would run the wrong way.
    Raises PanelsimError for a speed beyond ±50 m/s and for the errors of `SeawayView`.
    """

    components: WaveComponents
    speed: float
    gravity: float = STANDARD_GRAVITY
    stretching: str = field(default="wheeler", kw_only=True)
    method: str = field(default="auto", kw_only=True)

    def __post_init__(self) -> None:
        self._require_valid()
        require_speed(self.speed)

    @property
    def wave_vector(self) -> FloatArray:
        """Wavenumber vectors (M, 2) k (cos β, −sin β) [rad/m]."""
        heading = self.components.wave_heading
        return self._wavenumber[:, None] * np.column_stack([np.cos(heading), -np.sin(heading)])

    @property
    def observed_frequency(self) -> FloatArray:
        """Encounter frequencies (M,) ω_e [rad/s], negative for waves that the ship overtakes."""
        return self.components.encounter_frequency(self.speed, self.gravity)
