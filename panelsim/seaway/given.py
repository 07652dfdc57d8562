"""A sea of given wave components, as read from a file or made by a script."""

from dataclasses import dataclass

import numpy as np

from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angle
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.steepness import BREAKING_STEEPNESS


@dataclass(frozen=True, eq=False)
class ComponentSeaway(Seaway):
    """A sum of waves, each as in TM 2003-190 (10), that are given one by one.

    `wave_components` with headings relative to the ship on the compass course `ship_heading` [rad].

    Raises PanelsimError where there are no components or none has an amplitude, where one alone is steeper
    than H/λ = 0.142, at which waves break, and for a heading that is no angle in radians.
    """

    wave_components: WaveComponents
    ship_heading: float = 0.0

    kind = "components"

    def __post_init__(self) -> None:
        require_angle("ship heading", self.ship_heading)
        given = self.wave_components
        if not isinstance(given, WaveComponents) or not given.count:
            raise PanelsimError(
                "A sea of given components has none",
                got="0 components" if isinstance(given, WaveComponents) else repr(given)[:60],
                allowed="WaveComponents of at least one wave",
                remedy="take CalmSeaway for calm water",
            )
        if not given.variance > 0.0:
            raise PanelsimError(
                "The given components have no energy",
                got=f"{given.count} of amplitude 0",
                remedy='take CalmSeaway, kind = "calm", for calm water',
            )
        _require_unbroken(given)

    @property
    def components(self) -> WaveComponents:
        """The components as given."""
        return self.wave_components


def _require_unbroken(components: WaveComponents) -> None:
    """Refuse a component that alone would break."""
    steepness = np.abs(components.amplitude) * components.wavenumber() / np.pi
    worst = int(np.argmax(steepness))
    if steepness[worst] > BREAKING_STEEPNESS:
        raise PanelsimError(
            "A wave component is steeper than waves can be",
            got=f"component {worst + 1}: amplitude {components.amplitude[worst]:g} m"
            f" at {components.frequency[worst]:g} rad/s, H/λ {steepness[worst]:.3f}",
            allowed=f"H/λ at most {BREAKING_STEEPNESS} (breaking)",
            remedy="check the units of amplitude and frequency",
        )
