"""What every seaway is: wave components as a ship on its course meets them, and views of them."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.seaway.checks import require_angle
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.fixed import FixedSeaway
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

    def in_fixed_axes(self, *, gravity: float = STANDARD_GRAVITY, stretching: str = "wheeler") -> FixedSeaway:
        """The waves as somebody at rest sees them, x north and y west."""
        return FixedSeaway(self.components, self.ship_heading, gravity, stretching=stretching)

    def in_translating_axes(
        self,
        speed: float,
        ship_heading: float | None = None,
        *,
        time: float = 0.0,
        position: tuple[float, float] | FloatArray = (0.0, 0.0),
        gravity: float = STANDARD_GRAVITY,
        stretching: str = "wheeler",
    ) -> TranslatingSeaway:
        """The waves as a ship at this speed [m/s] meets them, TM 2003-190 2.3, 2.5.

        On its own course from the origin, or on the compass course `ship_heading` [rad] that it takes at
        `time` [s] and `position` (2,) [m], north and west of the origin.
        """
        fixed = self.in_fixed_axes(gravity=gravity, stretching=stretching)
        course = self.ship_heading if ship_heading is None else ship_heading
        return fixed.in_translating_axes(speed, course, time=time, position=position)


@dataclass(frozen=True)
class CalmSeaway(Seaway):
    """Calm water: no waves at all."""

    ship_heading: float = 0.0

    kind = "calm"

    def __post_init__(self) -> None:
        require_angle("ship heading", self.ship_heading)

    @property
    def components(self) -> WaveComponents:
        return NO_WAVES
