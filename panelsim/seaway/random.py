"""Random seas: many components with seeded phases that together carry a spectrum."""

from dataclasses import KW_ONLY, dataclass
from functools import cached_property

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angle
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import Spreading
from panelsim.seaway.frequencies import FrequencyBands, FrequencyChoice, GivenFrequencies
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.selection import negligible, without
from panelsim.seaway.spectra.point_spectrum import PointSpectrum


@dataclass(frozen=True)
class RandomSeaway(Seaway):
    """A random seaway, TM 2003-190 section 3: a sum of components with seeded phases.

    `frequencies` [rad/s] are an array (N,), which means exactly these, or a choice such as EvenFrequencies.
    With a point spectrum the sea is long-crested along `wave_heading` β [rad], amplitudes √(2 S Δω), (33);
    with `spreading` that is the mean heading, amplitudes √(2 S Δω Δν), (36), and the directions are multiples
    of `direction_step` [rad] from it. A directional spectrum brings its own compass directions ν, turned
    to β = ν + π − χ by `ship_heading` χ [rad], and takes neither heading nor spreading.

    Components are ordered by frequency band, then direction. `default_rng(seed)` gives the phases of all,
    uniform(0, 2π), then the jitter of the frequencies. Components with less than the share `drop_below` of
    the energy are dropped after that and the rest enlarged to keep it; else amplitudes are not rescaled.

    Raises PanelsimError where the frequencies hold less than `minimum_energy` of the spectrum, where they or
    the directions are too far apart to carry it, and where more than the rest would be dropped.
    """

    spectrum: PointSpectrum | DirectionalSpectrum
    frequencies: FloatArray | FrequencyChoice
    wave_heading: float | None = None
    seed: int = 1
    minimum_energy: float = 0.9
    ship_heading: float = 0.0
    _: KW_ONLY
    spreading: Spreading | None = None
    direction_step: float | None = None
    drop_below: float = 0.0

    kind = "random"

    def __post_init__(self) -> None:
        if isinstance(self.seed, bool) or not isinstance(self.seed, int | np.integer) or self.seed < 0:
            raise PanelsimError("The seed is not a whole number", got=repr(self.seed), allowed="0, 1, 2 …")
        for name in ("minimum_energy", "drop_below"):
            share = getattr(self, name)
            if not (isinstance(share, float | int | np.floating) and 0.0 <= share <= 1.0):
                raise PanelsimError(f"{name} is not a share", got=repr(share)[:60], allowed="0 to 1")
        require_angle("ship heading", self.ship_heading)
        self._require_directions()
        if not isinstance(self.frequencies, FrequencyChoice):
            object.__setattr__(self, "frequencies", GivenFrequencies(self.frequencies))
        self._require_energy()

    def _require_directions(self) -> None:
        """Refuse a sea whose directions are given twice, or not at all."""
        if isinstance(self.spectrum, DirectionalSpectrum):
            self._refuse("a directional spectrum brings its own directions", "wave_heading", "spreading")
        elif isinstance(self.spectrum, PointSpectrum):
            require_angle("wave heading", self.wave_heading)
            if self.spreading is None:
                self._refuse("a long-crested sea has one direction; give spreading too", "direction_step")
        else:
            raise PanelsimError(
                "The spectrum of a random sea is of another kind",
                got=repr(self.spectrum)[:60],
                allowed="a point spectrum such as Bretschneider, or a directional one",
            )

    def _refuse(self, reason: str, *names: str) -> None:
        """Refuse each of these fields that is given."""
        for name in names:
            if getattr(self, name) is not None:
                got = repr(getattr(self, name))[:60]
                raise PanelsimError(f"This sea takes no {name}", got=got, allowed=f"none: {reason}")

    @property
    def point_spectrum(self) -> PointSpectrum:
        """The spectrum over frequency alone."""
        return self.spectrum.point if isinstance(self.spectrum, DirectionalSpectrum) else self.spectrum

    @cached_property
    def directional_spectrum(self) -> DirectionalSpectrum | None:
        """The spectrum over compass directions; None for a long-crested sea."""
        if isinstance(self.spectrum, DirectionalSpectrum):
            return self.spectrum
        if self.spreading is None or self.wave_heading is None:
            return None
        mean = np.remainder(self.wave_heading - np.pi + self.ship_heading, 2 * np.pi)
        return SpreadSpectrum(self.spectrum, self.spreading, float(mean))

    @cached_property
    def _headings(self) -> FloatArray:
        """Wave headings β (D,) [rad]: as given, else turned from the compass, 0 to 2π."""
        if self.directional_spectrum is None:
            return np.array([self.wave_heading], dtype=float)
        directions = self.directional_spectrum.grid_directions(self.direction_step)
        return np.remainder(directions + np.pi - self.ship_heading, 2 * np.pi)

    @cached_property
    def _draw(self) -> tuple[FloatArray, FrequencyBands]:
        """Phases (N D,) [rad], and the bands, drawn in this order."""
        choice, generator = self.frequencies, np.random.default_rng(self.seed)
        assert isinstance(choice, FrequencyChoice)
        phases = generator.uniform(0.0, 2 * np.pi, choice.band_count * len(self._headings))
        return phases, choice.bands(self.point_spectrum, len(self._headings), generator)

    @cached_property
    def _variance(self) -> FloatArray:
        """Variance (N, D) [m²] of each component, before any is dropped."""
        bands = self._draw[1]
        if self.directional_spectrum is None:
            return np.sum(self.point_spectrum.density(bands.node) * bands.weight, axis=-1)
        directions = self.directional_spectrum.grid_directions(self.direction_step)
        density = self.directional_spectrum.density(bands.node, directions[:, None])
        over_frequency = np.sum(density * bands.weight, axis=-1)
        return over_frequency * self.directional_spectrum.grid_intervals(self.direction_step)

    @cached_property
    def _all_components(self) -> WaveComponents:
        phases, bands = self._draw
        headings = np.broadcast_to(self._headings, bands.frequency.shape)
        amplitude = np.sqrt(2 * self._variance)
        return WaveComponents(amplitude.ravel(), bands.frequency.ravel(), headings.ravel(), phases)

    @cached_property
    def components(self) -> WaveComponents:
        """The components, ordered by frequency band, then direction."""
        return without(self._all_components, negligible(self._all_components, self.drop_below))

    @property
    def dropped(self) -> int:
        """How many components were dropped."""
        return int(negligible(self._all_components, self.drop_below).sum())

    @property
    def energy_share(self) -> float:
        """Share of the spectrum's m0 that lies within the bands."""
        bands = self._draw[1]
        return self.point_spectrum.energy_between(bands.low, bands.high)

    @property
    def carried(self) -> float:
        """Variance of the components over the spectrum's m0."""
        return self._all_components.variance / self.point_spectrum.moment(0)

    def _require_energy(self) -> None:
        """Refuse frequencies that miss a part of the spectrum, and grids too coarse to carry it."""
        missing = 1.0 - self.minimum_energy + 1e-12
        if self.energy_share < 1.0 - missing:
            raise PanelsimError(
                "The wave frequencies hold too little of the spectrum's energy",
                got=f"{100 * self.energy_share:.1f} % in {self._extent}",
                allowed=f"at least {100 * self.minimum_energy:.1f} % (minimum_energy)",
                remedy="widen seaway.frequencies, or lower seaway.minimum_energy",
            )
        if abs(self.carried - 1.0) > missing:
            raise self._not_carried(missing)
        energy = self._all_components.amplitude**2
        share = energy[negligible(self._all_components, self.drop_below)].sum() / energy.sum()
        if share > missing:
            raise PanelsimError(
                "Too much of the sea would be dropped",
                got=f"{self.dropped} of {energy.size} components with {100 * share:.1f} % of the energy",
                allowed=f"at most {100 * missing:.1f} % (minimum_energy)",
                remedy="lower seaway.drop_below; TM 2003-190 takes 1e-6",
            )

    @property
    def _extent(self) -> str:
        bands, peak = self._draw[1], 2 * np.pi / self.point_spectrum.peak_period
        return f"{bands.low:g} to {bands.high:g} rad/s (the spectrum peaks at {peak:.3g} rad/s)"

    def _not_carried(self, missing: float) -> PanelsimError:
        """What to say of a sea that carries another energy than its spectrum: which grid is too coarse."""
        bands = self._draw[1]
        allowed = f"within {100 * missing:.1f} % of all of it (minimum_energy)"
        energy = np.sum(self.point_spectrum.density(bands.node) * bands.weight, axis=(0, 2))
        alone = energy.mean() / self.point_spectrum.moment(0)
        if abs(alone - 1.0) <= missing:
            return PanelsimError(
                "The wave components do not carry the spectrum's energy: their directions are too far apart",
                got=f"{100 * self.carried:.1f} % carried by {len(self._headings)} directions",
                allowed=allowed,
                remedy="take a smaller seaway.direction_step",
            )
        return PanelsimError(
            "The wave components do not carry the spectrum's energy: their frequencies are too far apart",
            got=f"{100 * self.carried:.1f} % carried by {len(bands.frequency)} frequencies in {self._extent}",
            allowed=allowed,
            remedy="take smaller frequency steps, or lower seaway.minimum_energy",
        )
