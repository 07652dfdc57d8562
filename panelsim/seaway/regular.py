"""Regular waves: one frequency, one direction."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angle, require_positive
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import wavenumber
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.steepness import BREAKING_STEEPNESS


@dataclass(frozen=True)
class RegularSeaway(Seaway):
    """One wave, TM 2003-190 section 2: amplitude a [m], frequency [rad/s], heading, phase [rad].

    With `second_order` it is a Stokes wave: ½ a² k cos 2θ is added to the elevation, (8) and (17), which
    raises crest and trough alike, so that the height stays 2 a; potential and dispersion stay of first
    order, section 2.2. Raises PanelsimError where the wave is steeper than H/λ = 0.142, at which
    waves break, and for values that are no numbers of their kind.
    """

    wave_amplitude: float
    wave_frequency: float
    wave_heading: float
    phase: float = 0.0
    ship_heading: float = 0.0
    second_order: bool = field(default=False, kw_only=True)

    kind = "regular"

    def __post_init__(self) -> None:
        for name in ("wave_amplitude", "wave_frequency"):
            require_positive(name, getattr(self, name), "m" if name == "wave_amplitude" else "rad/s")
        for name in ("wave_heading", "phase", "ship_heading"):
            require_angle(name.replace("_", " "), getattr(self, name))
        if not isinstance(self.second_order, bool):
            raise PanelsimError(
                "second_order is no yes or no", got=repr(self.second_order)[:60], allowed="True or False"
            )
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
            second_order=self.second_order,
        )
