"""A sea that repeats a measured record of its elevation."""

from dataclasses import dataclass
from functools import cached_property

from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angle, require_share
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.exchange.elevation_record import ElevationRecord
from panelsim.seaway.exchange.record_components import record_components
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.characteristics import component_characteristics
from panelsim.seaway.steepness import BREAKING_STEEPNESS, nominal_steepness


@dataclass(frozen=True)
class RecordedSeaway(Seaway):
    """Waves that give a record of elevation back where the ship starts, all of one `wave_heading` [rad].

    The band from `low_frequency` to `high_frequency` [rad/s] is kept; `taper` (0 to 1) as in
    `record_components`. Time counts from the record's first sample. That the sea is long-crested is an
    assumption: a record at one point does not tell directions.

    Raises PanelsimError as `record_components` does, where the band holds less than `minimum_energy` of the
    record's variance or the sea is steeper than breaking, and for a course that is no angle in radians.
    """

    record: ElevationRecord
    wave_heading: float
    low_frequency: float
    high_frequency: float
    taper: float = 0.0
    ship_heading: float = 0.0
    minimum_energy: float = 0.9

    kind = "record"

    def __post_init__(self) -> None:
        require_angle("ship heading", self.ship_heading)
        if not isinstance(self.record, ElevationRecord):
            raise PanelsimError(
                "The record is of another kind",
                got=repr(self.record)[:60],
                allowed="an ElevationRecord, as read_elevation_record gives it",
            )
        require_share(self.minimum_energy)
        self._require_a_sea()

    def _require_a_sea(self) -> None:
        """Refuse a band that misses the waves, and heights that no sea has: units gone wrong."""
        if self.record_share < self.minimum_energy:
            raise PanelsimError(
                "The band holds too little of the record's variance",
                got=f"{100 * self.record_share:.1f} % from {self.low_frequency:g} to"
                f" {self.high_frequency:g} rad/s",
                allowed=f"at least {100 * self.minimum_energy:.1f} % (minimum_energy)",
                remedy="widen the band; it is in rad/s, 2π times Hz",
            )
        sea = component_characteristics(self.components)
        steepness = nominal_steepness(sea.significant_wave_height, sea.energy_period)
        if steepness > BREAKING_STEEPNESS:
            raise PanelsimError(
                "The recorded sea is steeper than waves can be",
                got=f"4 √m0 {sea.significant_wave_height:.4g} m, energy period {sea.energy_period:.3g} s",
                allowed=f"a steepness of at most {BREAKING_STEEPNESS}",
                remedy="check that the record is in metres and seconds",
            )

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
