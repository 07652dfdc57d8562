"""The Bretschneider spectrum: a fully developed sea by its height and one period."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.seaway.checks import require_numbers, require_positive, require_share
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.spectra.system import SMALLEST_RATIO, system_moment, system_share_below
from panelsim.seaway.steepness import require_possible_sea

MEAN_PERIOD_RATIO = 1 / (1.25**0.25 * gamma(0.75))  # T_1/T_p = 0.77177, printed as 0.773 in TM 2003-190 (43)
ZERO_CROSSING_RATIO = (1.25 * np.pi) ** -0.25  # T_z/T_p = 0.71037, (44)
PHILLIPS_LEVEL = 0.0081  # α of the tail α g² ω⁻⁵ of fully developed seas, SIMULATORS (5)


@dataclass(frozen=True)
class Bretschneider(PointSpectrum):
    """Bretschneider spectrum, TM 2003-190 (42), by significant wave height [m] and peak period [s].

    S(ω) = A ω⁻⁵ exp(−B ω⁻⁴) with B = (5/4) ω_p⁴ and A = B H_s²/4, so that H_s = 4 √m0 exactly;
    the printed 486.0 and 1948.2 are these rounded, with H_s = 4.005 √m0 (0.1 % apart).

    Raises PanelsimError where a value is not positive or the sea is steeper than waves can be.
    """

    significant_wave_height: float
    peak_period: float

    def __post_init__(self) -> None:
        require_positive("significant_wave_height", self.significant_wave_height, "m")
        require_positive("peak_period", self.peak_period, "s")
        require_possible_sea(self.significant_wave_height, self.peak_period)

    @classmethod
    def from_mean_period(cls, significant_wave_height: float, mean_period: float) -> "Bretschneider":
        """By the mean period T_1 = 2π m0/m1 [s], to which 172.75 and 691 of WORKSHOP 4.5 belong."""
        return cls(
            significant_wave_height, require_positive("mean_period", mean_period, "s") / MEAN_PERIOD_RATIO
        )

    @classmethod
    def from_zero_crossing_period(
        cls, significant_wave_height: float, zero_crossing_period: float
    ) -> "Bretschneider":
        """By the zero-crossing period T_z = 2π √(m0/m2) [s]."""
        period = require_positive("zero_crossing_period", zero_crossing_period, "s")
        return cls(significant_wave_height, period / ZERO_CROSSING_RATIO)

    @classmethod
    def one_parameter(cls, significant_wave_height: float) -> "Bretschneider":
        """The fully developed sea of a height, with the tail α g² ω⁻⁵ of Pierson and Moskowitz.

        SIMULATORS (4) over ω: B = 4 α g²/H_s²; printed with (2π)² for (2π)⁴ over f.
        """
        height = require_positive("significant_wave_height", significant_wave_height, "m")
        peak_frequency = (3.2 * PHILLIPS_LEVEL) ** 0.25 * np.sqrt(STANDARD_GRAVITY / height)
        return cls(height, float(2 * np.pi / peak_frequency))

    @property
    def _peak_frequency(self) -> float:
        return 2 * np.pi / self.peak_period

    def density(self, omega: ArrayLike) -> FloatArray:
        b = 1.25 * self._peak_frequency**4
        a = b * self.significant_wave_height**2 / 4
        omega = np.maximum(require_numbers(omega), SMALLEST_RATIO * self._peak_frequency)
        with np.errstate(over="ignore"):  # of powers of frequencies past 1e60 rad/s: the tail is 0 there
            return a / omega**5 * np.exp(-b / omega**4)

    def moment(self, n: int, upper_frequency: float | None = None) -> float:
        """Moment m_n = ∫ S ωⁿ dω, TM 2003-190 (38), in closed form; m4 needs an upper frequency [rad/s]."""
        upper = self._upper(n, upper_frequency)
        return system_moment(n, self.significant_wave_height, self._peak_frequency, 1.0, upper)

    def _share_below(self, frequency: float) -> float:
        return system_share_below(frequency, self._peak_frequency, 1.0)

    def frequency_below(self, share: float) -> float:
        share = require_share(share)
        if share in (0.0, 1.0):
            return np.inf if share else 0.0
        return float(self._peak_frequency * (-1.25 / np.log(share)) ** 0.25)
