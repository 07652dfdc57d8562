"""Random seas: many components with seeded phases that together carry a spectrum."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.seaways import Seaway, require_heading
from panelsim.seaway.spectra.bretschneider import Bretschneider


@dataclass(frozen=True)
class RandomSeaway(Seaway):
    """A long-crested random seaway, TM 2003-190 section 3.1: a sum of components with seeded phases.

    `frequencies` (M,) [rad/s] in rising order; `wave_heading` [rad]. Amplitudes are √(2 S Δω), (33),
    with Δω the spacing of the frequencies, not rescaled. Phases are
    `numpy.random.default_rng(seed).uniform(0, 2π, M)` in the order of the frequencies.

    Raises PanelsimError where the frequencies hold less than `minimum_energy` of the spectrum, or are too
    far apart to carry it.
    """

    spectrum: Bretschneider
    frequencies: FloatArray
    wave_heading: float
    seed: int
    minimum_energy: float = 0.9
    ship_heading: float = 0.0

    kind = "random"

    def __post_init__(self) -> None:
        require_heading(self.wave_heading)
        if isinstance(self.seed, bool) or not isinstance(self.seed, int | np.integer) or self.seed < 0:
            raise PanelsimError("The seed is not a whole number", got=repr(self.seed), allowed="0, 1, 2 …")
        if not 0.0 <= self.minimum_energy <= 1.0:
            raise PanelsimError("minimum_energy is not a share", got=self.minimum_energy, allowed="0 to 1")
        frequencies = np.array(self.frequencies, dtype=float)
        frequencies.setflags(write=False)
        object.__setattr__(self, "frequencies", frequencies)
        if frequencies.ndim != 1 or len(frequencies) < 2 or not np.all(np.diff(frequencies) > 0):
            raise PanelsimError("The wave frequencies do not rise, or are fewer than two", got=frequencies)
        if frequencies[0] <= 0:
            raise PanelsimError("A wave frequency is not positive", got=f"{frequencies[0]:g} rad/s")
        self._require_energy()

    def _require_energy(self) -> None:
        """Refuse frequencies that miss a part of the spectrum, and steps too coarse to follow its peak."""
        span = f"{self.frequencies[0]:g} to {self.frequencies[-1]:g} rad/s"
        peak = 2 * np.pi / self.spectrum.peak_period
        if self.energy_share < self.minimum_energy:
            raise PanelsimError(
                "The wave frequencies hold too little of the spectrum's energy",
                got=f"{100 * self.energy_share:.1f} % in {span} (the spectrum peaks at {peak:.3g} rad/s)",
                allowed=f"at least {100 * self.minimum_energy:.1f} % (minimum_energy)",
                remedy="widen seaway.frequencies, or lower seaway.minimum_energy",
            )
        carried = self.components.variance / self.spectrum.moment(0)
        if abs(carried - 1.0) > 1.0 - self.minimum_energy + 1e-12:
            raise PanelsimError(
                "The wave components do not carry the spectrum's energy: their frequencies are too far apart",
                got=f"{100 * carried:.1f} % carried by {len(self.frequencies)} frequencies in {span}"
                f" (the spectrum peaks at {peak:.3g} rad/s)",
                allowed=f"within {100 * (1 - self.minimum_energy):.1f} % of all of it (minimum_energy)",
                remedy="take smaller frequency steps, or lower seaway.minimum_energy",
            )

    @cached_property
    def band_edges(self) -> FloatArray:
        """Edges (M + 1,) of the frequency bands, halfway between neighbours [rad/s]."""
        middle = 0.5 * (self.frequencies[1:] + self.frequencies[:-1])
        first = 1.5 * self.frequencies[0] - 0.5 * self.frequencies[1]
        last = 1.5 * self.frequencies[-1] - 0.5 * self.frequencies[-2]
        return np.concatenate([[max(first, 0.0)], middle, [last]])

    @property
    def energy_share(self) -> float:
        """Share of the spectrum's m0 that lies within the bands."""
        return self.spectrum.energy_between(self.band_edges[0], self.band_edges[-1])

    @cached_property
    def components(self) -> WaveComponents:
        """The components, ordered by frequency."""
        phases = np.random.default_rng(self.seed).uniform(0.0, 2 * np.pi, len(self.frequencies))
        amplitude = np.sqrt(2 * self.spectrum.density(self.frequencies) * np.diff(self.band_edges))
        return WaveComponents(amplitude, self.frequencies, np.full_like(amplitude, self.wave_heading), phases)
