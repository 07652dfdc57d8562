"""Regular and random seaways as a user describes them; each holds its wave components."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.dispersion import wavenumber
from panelsim.seaway.spectra import BREAKING_STEEPNESS, Bretschneider
from panelsim.seaway.translating import TranslatingSeaway


class Seaway(Protocol):
    """What a run asks of any seaway."""

    @property
    def kind(self) -> str: ...

    @property
    def components(self) -> WaveComponents: ...


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
class CalmSeaway:
    """Calm water: no waves at all."""

    kind = "calm"

    @property
    def components(self) -> WaveComponents:
        return NO_WAVES


@dataclass(frozen=True)
class RegularSeaway:
    """One sinusoidal wave, TM 2003-190 section 2: amplitude [m], frequency [rad/s], heading, phase [rad].

    Raises PanelsimError where the wave is steeper than H/λ = 0.142, at which waves break.
    """

    wave_amplitude: float
    wave_frequency: float
    wave_heading: float
    phase: float = 0.0

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

    def in_translating_axes(self, speed: float, gravity: float = STANDARD_GRAVITY) -> TranslatingSeaway:
        """The waves as a ship at this speed [m/s] meets them."""
        return TranslatingSeaway(self.components, speed, gravity)


@dataclass(frozen=True)
class RandomSeaway:
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

    def in_translating_axes(self, speed: float, gravity: float = STANDARD_GRAVITY) -> TranslatingSeaway:
        """The waves as a ship at this speed [m/s] meets them."""
        return TranslatingSeaway(self.components, speed, gravity)
