"""A sea that repeats a measured record of its elevation."""

from dataclasses import dataclass
from functools import cached_property

from panelsim.seaway.checks import require_angle
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.exchange.elevation_record import ElevationRecord
from panelsim.seaway.exchange.record_components import record_components
from panelsim.seaway.seaways import Seaway


@dataclass(frozen=True)
class RecordedSeaway(Seaway):
    """Waves that give a record of elevation back where the ship starts, all of one `wave_heading` [rad].

    The band from `low_frequency` to `high_frequency` [rad/s] is kept; `taper` (0 to 1) as in
    `record_components`. Time counts from the record's first sample. That the sea is long-crested is an
    assumption: a record at one point does not tell directions.

    Raises PanelsimError as `record_components` does, and for a course that is no angle in radians.
    """

    record: ElevationRecord
    wave_heading: float
    low_frequency: float
    high_frequency: float
    taper: float = 0.0
    ship_heading: float = 0.0

    kind = "record"

    def __post_init__(self) -> None:
        require_angle("ship heading", self.ship_heading)
        # A band that the record cannot fill is refused here, not at the first look at the waves.
        _ = self.components

    @cached_property
    def components(self) -> WaveComponents:
        """The record's Fourier waves within the band, in order of frequency."""
        return record_components(
            self.record,
            wave_heading=self.wave_heading,
            low_frequency=self.low_frequency,
            high_frequency=self.high_frequency,
            taper=self.taper,
        )

    @property
    def record_share(self) -> float:
        """Share of the record's variance that the waves of the band carry, ½ Σ a² over it."""
        return self.components.variance / self.record.variance

    @property
    def length(self) -> float:
        """Length of the record [s], after which its waves repeat at a fixed point."""
        return self.record.length
