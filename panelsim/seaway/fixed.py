"""A seaway seen from axes fixed to the earth, TM 2003-190 sections 2.1, 2.2 and 2.5."""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angle, require_number
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.coordinates import numbers, require_speed
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.seaway.view import SeawayView


@dataclass(frozen=True, eq=False)
class FixedSeaway(SeawayView):
    """Waves in axes at rest: x north, y west [m].

    A wave is a cos(k(y sin ν − x cos ν) − ω t − ε), (1), and comes from the compass direction ν. The
    components keep their headings β relative to a ship on the compass course `ship_heading` χ [rad], so
    ν = β − π + χ, (9). Raises PanelsimError for a course beyond ±2π and for the errors of `SeawayView`.
    """

    components: WaveComponents
    ship_heading: float
    gravity: float = STANDARD_GRAVITY
    stretching: str = field(default="wheeler", kw_only=True)
    method: str = field(default="auto", kw_only=True)

    def __post_init__(self) -> None:
        self._require_valid()
        require_angle("ship heading", self.ship_heading)

    @property
    def sea_direction(self) -> FloatArray:
        """Compass directions (M,) ν that the waves come from [rad], not brought into one turn."""
        return self.components.wave_heading - np.pi + self.ship_heading

    @property
    def wave_vector(self) -> FloatArray:
        """Wavenumber vectors (M, 2) k (−cos ν, sin ν) [rad/m]."""
        direction = self.sea_direction
        return self._wavenumber[:, None] * np.column_stack([-np.cos(direction), np.sin(direction)])

    @property
    def observed_frequency(self) -> FloatArray:
        """Wave frequencies (M,) ω [rad/s]."""
        return self.components.frequency

    def in_translating_axes(
        self,
        speed: float,
        ship_heading: float,
        *,
        time: float = 0.0,
        position: tuple[float, float] | FloatArray = (0.0, 0.0),
    ) -> TranslatingSeaway:
        """The same sea from a ship at `speed` [m/s] on the compass course `ship_heading` [rad], (9), (27).

        `position` (2,) [m] in these axes is where the moving origin is at `time` [s]; the clock stays the
        same. A ship that changes speed or course takes a new view from there: see `ship_position`.
        Raises PanelsimError for values that are not finite, and courses in degrees.
        """
        require_speed(speed)
        require_angle("ship heading", ship_heading)
        require_number("time", time, "s")
        x, y = _position(position)
        waves = self.components
        heading = waves.wave_heading + (self.ship_heading - ship_heading)
        moved = replace(waves, wave_heading=heading)
        encounter = moved.encounter_frequency(speed, self.gravity)
        along_x, along_y = self.wave_vector.T
        # (27) with ω_e signed
        phase = waves.phase + time * (waves.frequency - encounter) - (along_x * x + along_y * y)
        return TranslatingSeaway(
            replace(moved, phase=phase),
            speed,
            self.gravity,
            stretching=self.stretching,
            method=self.method,
        )


def ship_position(
    start: tuple[float, float] | FloatArray, speed: float, ship_heading: float, elapsed: ArrayLike
) -> FloatArray:
    """Where a ship is in fixed axes (…, 2) [m], `elapsed` (…) [s] after `start` (2,), TM 2003-190 (28), (29).

    It moves along its own compass course χ, `ship_heading` [rad], at `speed` U [m/s]: x + U t cos χ,
    y − U t sin χ. (28) and (29) print the direction ν of the waves. Raises PanelsimError as
    `FixedSeaway.in_translating_axes`.
    """
    require_speed(speed)
    require_angle("ship heading", ship_heading)
    way = speed * np.array([np.cos(ship_heading), -np.sin(ship_heading)])
    return np.array(_position(start)) + numbers("elapsed", elapsed)[..., None] * way


def _position(position: tuple[float, float] | FloatArray) -> tuple[float, float]:
    try:
        x, y = position
    except (TypeError, ValueError):
        raise PanelsimError(
            "The position is not two numbers", got=repr(position)[:60], allowed="(x north, y west) in m"
        ) from None
    require_number("position", x, "m")
    require_number("position", y, "m")
    return float(x), float(y)
