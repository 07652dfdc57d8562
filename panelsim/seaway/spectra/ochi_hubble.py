"""The six-parameter spectrum of Ochi and Hubble: swell and wind sea, each by height, period and shape."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_numbers, require_positive
from panelsim.seaway.spectra.point_spectrum import PIECES, PointSpectrum
from panelsim.seaway.spectra.system import system_density, system_moment, system_share_below
from panelsim.seaway.steepness import require_possible_sea

LOWEST_SHAPE = 0.25  # below which the sea has no mean period
HIGHEST_SHAPE = 50.0  # nearly all energy within 10 % of the peak frequency; seas have shapes of 0.5 to 10


@dataclass(frozen=True)
class OchiHubble(PointSpectrum):
    """Spectrum of one or two collinear systems, TM 2003-190 (49).

    Tuples of equal length of `significant_wave_heights` h_s [m], `peak_periods` [s] and `shapes` λ [-]. One
    system of shape 1 is a Bretschneider spectrum. The tail is ω⁻⁽⁴λ⁺¹⁾: m_n exists for n < 4λ. The
    `significant_wave_height` of the whole is √(h_1² + h_2²) = 4 √m0.

    Raises PanelsimError where a value is not positive, λ is not between 0.25 and 50, or a system or the whole
    sea is steeper than waves can be.
    """

    significant_wave_heights: tuple[float, ...]
    peak_periods: tuple[float, ...]
    shapes: tuple[float, ...]
    significant_wave_height: float = field(init=False)
    peak_period: float = field(init=False)

    def __post_init__(self) -> None:
        for name, unit in (("significant_wave_heights", "m"), ("peak_periods", "s"), ("shapes", "")):
            object.__setattr__(self, name, _one_or_two(name, getattr(self, name), unit))
        counts = len(self.significant_wave_heights), len(self.peak_periods), len(self.shapes)
        if len(set(counts)) > 1:
            raise PanelsimError(
                "The systems do not have as many heights as peak periods and shapes",
                got=", ".join(map(str, counts)),
                allowed="one each, or two each",
            )
        for shape in self.shapes:
            if not LOWEST_SHAPE < shape <= HIGHEST_SHAPE:
                raise PanelsimError(
                    "A shape is out of range",
                    got=shape,
                    allowed=f"over {LOWEST_SHAPE:g}, at most {HIGHEST_SHAPE:g}",
                )
        for height, period in zip(self.significant_wave_heights, self.peak_periods, strict=True):
            require_possible_sea(height, period)
        object.__setattr__(
            self, "significant_wave_height", float(np.hypot.reduce(self.significant_wave_heights))
        )
        object.__setattr__(self, "peak_period", 2 * np.pi / self._peak_frequency())
        require_possible_sea(self.significant_wave_height, self.peak_period)

    @property
    def _systems(self) -> Iterator[tuple[float, float, float]]:
        """Height [m], peak frequency [rad/s] and shape of each system."""
        frequencies = [2 * np.pi / period for period in self.peak_periods]
        return zip(self.significant_wave_heights, frequencies, self.shapes, strict=True)

    def _peak_frequency(self) -> float:
        """Frequency [rad/s] of the largest density, which lies between the peaks of the two systems."""
        peaks = sorted(2 * np.pi / period for period in self.peak_periods)
        omega = np.linspace(peaks[0], peaks[-1], 2001)
        highest = int(np.argmax(self.density(omega)))
        low, high = omega[max(highest - 1, 0)], omega[min(highest + 1, 2000)]
        if self._rise(low) <= 0 or self._rise(high) >= 0:
            return float(omega[highest])
        return float(brentq(self._rise, low, high, xtol=1e-15))

    def _rise(self, omega: float) -> float:
        """ω dS/dω [m² s/rad]."""
        return float(
            sum(
                system_density(np.array(omega), *system)
                * (4 * system[2] + 1)
                * ((system[1] / omega) ** 4 - 1)
                for system in self._systems
            )
        )

    @property
    def tail_power(self) -> float:
        return 4 * min(self.shapes) + 1

    @property
    def break_frequencies(self) -> FloatArray:
        return np.unique([PIECES * frequency for _, frequency, _ in self._systems])

    def density(self, omega: ArrayLike) -> FloatArray:
        omega = require_numbers(omega)
        return np.sum([system_density(omega, *system) for system in self._systems], axis=0)

    def moment(self, n: int, upper_frequency: float | None = None) -> float:
        """Moment m_n = ∫ S ωⁿ dω in closed form, with no upper frequency [rad/s] for n < 4λ only."""
        upper = self._upper(n, upper_frequency)
        return sum(system_moment(n, *system, upper) for system in self._systems)

    def _share_below(self, frequency: float) -> float:
        parts = [h**2 * system_share_below(frequency, peak, shape) for h, peak, shape in self._systems]
        return sum(parts) / self.significant_wave_height**2


def _one_or_two(name: str, given: object, unit: str) -> tuple[float, ...]:
    if not isinstance(given, tuple | list) or len(given) not in (1, 2):
        raise PanelsimError(
            f"{name} is no tuple of one or two numbers", got=repr(given)[:60], remedy="write (2.0,) for one"
        )
    return tuple(require_positive(name, value, unit) for value in given)
