"""What every seaway is: wave components as a ship on its course meets them, and views of them."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY
from panelsim.errors import PanelsimError
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.translating import TranslatingSeaway


class Seaway(ABC):
    """A sea, described for a ship on the compass course `ship_heading` χ [rad] that starts at the origin.

    The fixed axes x^f north and y^f west have their origin where the ship's moving origin is at t = 0.
    """

    kind: ClassVar[str]
    ship_heading: float

    @property
    @abstractmethod
    def components(self) -> WaveComponents:
        """The waves, their headings relative to that course, their phases at the origin at t = 0."""

    def in_translating_axes(self, speed: float, gravity: float = STANDARD_GRAVITY) -> TranslatingSeaway:
        """The waves as a ship at this speed [m/s] meets them."""
        return TranslatingSeaway(self.components, speed, gravity)


def require_heading(wave_heading: float) -> None:
    """Refuse a heading that is no number, or is one of degrees."""
    if (
        not isinstance(wave_heading, float | int | np.floating | np.integer)
        or not abs(wave_heading) <= 2 * np.pi
    ):
        raise PanelsimError(
            "The wave heading is no angle in radians",
            got=repr(wave_heading)[:60],
            allowed="-2π to 2π rad",
            remedy="turn degrees into radians, for example np.deg2rad(150)",
        )


@dataclass(frozen=True)
class CalmSeaway(Seaway):
    """Calm water: no waves at all."""

    ship_heading: float = 0.0

    kind = "calm"

    @property
    def components(self) -> WaveComponents:
        return NO_WAVES
