"""Regular waves: one frequency, one direction."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import wavenumber
from panelsim.seaway.seaways import Seaway, require_heading
from panelsim.seaway.steepness import BREAKING_STEEPNESS


@dataclass(frozen=True)
class RegularSeaway(Seaway):
    """One sinusoidal wave, TM 2003-190 section 2: amplitude [m], frequency [rad/s], heading, phase [rad].

    Raises PanelsimError where the wave is steeper than H/λ = 0.142, at which waves break.
    """

    wave_amplitude: float
    wave_frequency: float
    wave_heading: float
    phase: float = 0.0
    ship_heading: float = 0.0

    kind = "regular"

    def __post_init__(self) -> None:
        require_heading(self.wave_heading)
        for name in ("wave_amplitude", "wave_frequency"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise PanelsimError(f"{name} is not positive", got=getattr(self, name), allowed="more than 0")
        steepness = self.wave_amplitude * float(wavenumber(np.array(self.wave_frequency))) / np.pi
        if steepness > BREAKING_STEEPNESS:
            raise PanelsimError(
                "The wave is steeper than waves can be",
                got=f"height {2 * self.wave_amplitude:g} m at {self.wave_frequency:g} rad/s,"
                f" H/λ {steepness:.3f}",
                allowed=f"H/λ at most {BREAKING_STEEPNESS} (breaking)",
                remedy="lower the wave height or the frequency",
            )

    @cached_property
    def components(self) -> WaveComponents:
        """The single component."""
        return WaveComponents(
            np.array([self.wave_amplitude]),
            np.array([self.wave_frequency]),
            np.array([self.wave_heading]),
            np.array([self.phase]),
        )
