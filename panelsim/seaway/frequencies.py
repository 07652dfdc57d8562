"""Which frequencies stand for a spectrum, and how much of its energy each carries."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Self

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_positive
from panelsim.seaway.spectra.point_spectrum import PointSpectrum

MOST_FREQUENCIES = 100_000
# Sixteen points follow the peak of a JONSWAP spectrum within an interval as wide as the peak itself.
GAUSS_POINTS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True)
class FrequencyBands:
    """Frequencies ω (N, D) [rad/s] in N bands for D directions, and the energy that each stands for.

    A component has the variance Σ S(`node`) `weight` (N, D, Q), [rad/s]: S(ω) Δω, or the integral of S
    over its interval by quadrature. All bands lie between `low` and `high` [rad/s].
    """

    frequency: FloatArray
    node: FloatArray
    weight: FloatArray
    low: float
    high: float

    @classmethod
    def of_intervals(cls, frequency: FloatArray, interval: FloatArray, low: float, high: float) -> Self:
        """Bands that each have the variance S(ω) Δω, (33); interval Δω (N, D) [rad/s]."""
        return cls(frequency, frequency[..., None], interval[..., None], low, high)


class FrequencyChoice(ABC):
    """A rule that chooses the frequencies of a random sea."""

    @property
    @abstractmethod
    def band_count(self) -> int:
        """Bands N, each with one frequency for every direction."""

    @abstractmethod
    def bands(
        self, spectrum: PointSpectrum, direction_count: int, generator: np.random.Generator
    ) -> FrequencyBands:
        """The frequencies for a spectrum, of so many directions; the generator for those left to chance."""


@dataclass(frozen=True, eq=False)
class GivenFrequencies(FrequencyChoice):
    """Exactly these frequencies (N,) [rad/s], the same in all directions; Δω reaches half way to the next.

    Raises PanelsimError where they are not positive, do not rise, or are fewer than two.
    """

    frequency: FloatArray

    def __post_init__(self) -> None:
        try:
            frequency = np.array(self.frequency, dtype=float)
        except (TypeError, ValueError):
            frequency = np.empty(0)
        frequency.setflags(write=False)
        object.__setattr__(self, "frequency", frequency)
        finite = frequency.ndim == 1 and len(frequency) >= 2 and np.isfinite(frequency).all()
        if not finite or not np.all(np.diff(frequency) > 0):
            raise PanelsimError(
                "The wave frequencies do not rise, or are fewer than two",
                got=repr(self.frequency)[:200],
                allowed="a rising list of numbers [rad/s], or a choice such as EvenFrequencies",
            )
        if frequency[0] <= 0:
            raise PanelsimError(
                "A wave frequency is not positive", got=f"{frequency[0]:g} rad/s", allowed="more than 0"
            )

    @property
    def band_count(self) -> int:
        """Bands N, each with one frequency for every direction."""
        return len(self.frequency)

    @property
    def edges(self) -> FloatArray:
        """Edges (N + 1,) of the bands [rad/s]: half way between neighbours, and as far beyond the ends."""
        middle = 0.5 * (self.frequency[1:] + self.frequency[:-1])
        first = 1.5 * self.frequency[0] - 0.5 * self.frequency[1]
        last = 1.5 * self.frequency[-1] - 0.5 * self.frequency[-2]
        return np.concatenate([[max(first, 0.0)], middle, [last]])

    def bands(
        self, spectrum: PointSpectrum, direction_count: int, generator: np.random.Generator
    ) -> FrequencyBands:
        """The same frequencies for every spectrum and direction."""
        edges, shape = self.edges, (self.band_count, direction_count)
        frequency = np.broadcast_to(self.frequency[:, None], shape)
        interval = np.broadcast_to(np.diff(edges)[:, None], shape)
        return FrequencyBands.of_intervals(frequency, interval, edges[0], edges[-1])


@dataclass(frozen=True)
class EvenFrequencies(FrequencyChoice):
    """The grid `start`, `start` + `step` … `stop` [rad/s] of TM 2003-190, both ends included, Δω = `step`.

    Such a sea repeats (`repeat_time`). Waves of one frequency from several directions stand in a fixed
    pattern: a short-crested sea on this grid is higher in some places than in others for ever.
    Raises PanelsimError for values that are not positive, and a stop that is not a step above the start.
    """

    start: float
    stop: float
    step: float

    def __post_init__(self) -> None:
        _require_grid(self.start, self.stop, self.step)

    @property
    def frequency(self) -> FloatArray:
        """The grid (N,) [rad/s]."""
        return _grid(self.start, self.stop, self.step)

    @property
    def band_count(self) -> int:
        """Bands N, each with one frequency for every direction."""
        return len(self.frequency)

    def bands(
        self, spectrum: PointSpectrum, direction_count: int, generator: np.random.Generator
    ) -> FrequencyBands:
        """The same grid for every spectrum and direction."""
        return GivenFrequencies(self.frequency).bands(spectrum, direction_count, generator)


@dataclass(frozen=True)
class JitteredFrequencies(FrequencyChoice):
    """One frequency, anywhere in it, of each bin of the even grid, bins centred on the grid [rad/s].

    Each direction has its own, so that no two components share a frequency: the sea neither repeats nor
    stands in a pattern. The interval of a component reaches half way to its neighbours of the same
    direction, and to the ends of the outer bins; S in (33) is its mean over the interval, so that every seed
    carries the energy of the bins. With S at the frequency itself, H_s would differ from seed to seed: for
    JONSWAP γ 3.3, T_p 15 s by 3.7 % (standard deviation) at a step of 0.05 rad/s.
    Raises PanelsimError as EvenFrequencies, and where the first bin begins below 0.
    """

    start: float
    stop: float
    step: float

    def __post_init__(self) -> None:
        _require_grid(self.start, self.stop, self.step)
        if self.start < 0.5 * self.step:
            raise PanelsimError(
                "The first frequency bin begins below 0",
                got=f"start {self.start:g} rad/s with a step of {self.step:g} rad/s",
                allowed=f"a start of at least {0.5 * self.step:g} rad/s",
            )

    @property
    def band_count(self) -> int:
        """Bands N, each with one frequency for every direction."""
        return len(_grid(self.start, self.stop, self.step))

    def bands(
        self, spectrum: PointSpectrum, direction_count: int, generator: np.random.Generator
    ) -> FrequencyBands:
        """One draw of N frequencies for each direction; the spectrum does not matter."""
        lower = _grid(self.start, self.stop, self.step)[:, None] - 0.5 * self.step
        frequency = lower + self.step * generator.uniform(0.0, 1.0, (self.band_count, direction_count))
        low, high = float(lower[0, 0]), float(lower[-1, 0] + self.step)
        _require_within(spectrum, low, high, self.step)
        ends = np.full((1, direction_count), low), np.full((1, direction_count), high)
        edges = np.concatenate([ends[0], 0.5 * (frequency[1:] + frequency[:-1]), ends[1]])
        middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges, axis=0)
        node = middle[..., None] + half[..., None] * GAUSS_POINTS
        return FrequencyBands(frequency, node, half[..., None] * GAUSS_WEIGHTS, low, high)


@dataclass(frozen=True)
class EqualEnergyFrequencies(FrequencyChoice):
    """`count` bands of equal energy between `start` and `stop` [rad/s], each at the middle of its energy.

    The components of a long-crested sea are all of one amplitude: Δω is the energy of a band over
    S, so that (33) gives it. With D directions a band is parted into D equal shares, and each direction
    takes the middle of another one, in turn from below and from above: no two share a frequency.
    Raises PanelsimError for a count below 2, frequencies that do not rise, and a band whose middle is where
    the spectrum has no energy.
    """

    count: int
    start: float = 0.0
    stop: float = np.inf

    def __post_init__(self) -> None:
        whole = isinstance(self.count, Integral) and not isinstance(self.count, bool)
        if not whole or not 2 <= self.count <= MOST_FREQUENCIES:
            raise PanelsimError(
                "The count of frequencies is no whole number in range",
                got=repr(self.count)[:60],
                allowed=f"2 to {MOST_FREQUENCIES}",
            )
        numbers = all(isinstance(value, Real) for value in (self.start, self.stop))
        if not numbers or not 0.0 <= self.start < self.stop:
            raise PanelsimError(
                "The frequencies do not rise from start to stop",
                got=f"{self.start!r} to {self.stop!r} rad/s",
                allowed="0 ≤ start < stop",
            )

    @property
    def band_count(self) -> int:
        """Bands N, each with one frequency for every direction."""
        return self.count

    def bands(
        self, spectrum: PointSpectrum, direction_count: int, generator: np.random.Generator
    ) -> FrequencyBands:
        """The frequencies at the middle of each share; nothing is left to chance."""
        rank = np.tile(np.arange(direction_count), (self.count, 1))
        rank[1::2] = rank[1::2, ::-1]
        share = (np.arange(self.count)[:, None] + (rank + 0.5) / direction_count) / self.count
        below = spectrum.energy_between(0.0, self.start)
        held = spectrum.energy_between(self.start, self.stop)
        frequency = np.vectorize(spectrum.frequency_below, otypes=[float])(below + held * share)
        density = spectrum.density(frequency)
        if not np.all(density > 0.0):
            raise PanelsimError(
                "The middle of a band of equal energy lies where the spectrum has none",
                got=f"{frequency[density <= 0.0][0]:g} rad/s",
                remedy="take another count of frequencies",
            )
        interval = held * spectrum.moment(0) / self.count / density
        return FrequencyBands.of_intervals(frequency, interval, self.start, self.stop)


def _grid(start: float, stop: float, step: float) -> FloatArray:
    """The even grid (N,); the stop belongs to it where it is a whole number of steps away."""
    count = int(np.floor((stop - start) / step + 1e-9)) + 1
    return start + step * np.arange(count, dtype=np.float64)


def _require_grid(start: float, stop: float, step: float) -> None:
    """Refuse an even grid that is none, or one of absurd length."""
    for name, value in (("start", start), ("stop", stop), ("step", step)):
        require_positive(f"The frequency {name}", value, "rad/s")
    if not step <= (stop - start) * (1 + 1e-9) <= MOST_FREQUENCIES * step:
        raise PanelsimError(
            "The frequencies do not make a grid",
            got=f"{start:g} to {stop:g} rad/s in steps of {step:g} rad/s",
            allowed=f"2 to {MOST_FREQUENCIES} frequencies from start to stop",
        )


def _require_within(spectrum: PointSpectrum, low: float, high: float, step: float) -> None:
    """Refuse bins that reach beyond a table, whatever the seed draws in them."""
    first, last = spectrum.frequency_range
    if low < first * (1 - 1e-12) or high > last * (1 + 1e-12):
        raise PanelsimError(
            "The frequency bins reach beyond the table of the spectrum",
            got=f"{low:g} to {high:g} rad/s, half a step beyond start and stop",
            allowed=f"{first:g} to {last:g} rad/s",
            remedy=f"take a start of at least {first + 0.5 * step:g} and a stop of at most"
            f" {last - 0.5 * step:g} rad/s",
        )
