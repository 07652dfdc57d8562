"""The Bretschneider spectrum: a fully developed sea by its height and one period."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gamma

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.steepness import BREAKING_STEEPNESS, nominal_steepness


@dataclass(frozen=True)
class Bretschneider:
    """Bretschneider spectrum, TM 2003-190 (42), by significant wave height [m] and peak period [s].

    S(ω) = A ω⁻⁵ exp(−B ω⁻⁴) with B = (5/4) ω_p⁴ and A = B H_s²/4, so that H_s = 4 √m0 exactly;
    the printed 486.0 and 1948.2 are these rounded, with H_s = 4.005 √m0 (0.1 % apart).

    Raises PanelsimError where a value is not positive or the sea is steeper than waves can be.
    """

    significant_wave_height: float
    peak_period: float

    def __post_init__(self) -> None:
        for name in ("significant_wave_height", "peak_period"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise PanelsimError(f"{name} is not positive", got=value, allowed="more than 0")
        if self.nominal_steepness > BREAKING_STEEPNESS:
            lowest = self.peak_period * np.sqrt(self.nominal_steepness / BREAKING_STEEPNESS)
            raise PanelsimError(
                "The sea is steeper than waves can be",
                got=f"H_s {self.significant_wave_height:g} m at T_p {self.peak_period:g} s,"
                f" steepness {self.nominal_steepness:.3f}",
                allowed=f"at most {BREAKING_STEEPNESS} (breaking)",
                remedy=f"lower significant_wave_height, or take peak_period over {lowest:.1f} s",
            )

    @property
    def nominal_steepness(self) -> float:
        """2π H_s / (g T_p²), TM 2003-190 (56)."""
        return nominal_steepness(self.significant_wave_height, self.peak_period)

    @property
    def _shape(self) -> tuple[float, float]:
        b = 1.25 * (2 * np.pi / self.peak_period) ** 4
        return b * self.significant_wave_height**2 / 4, b

    def density(self, omega: ArrayLike) -> FloatArray:
        """Spectral density [m² s/rad] at the frequencies omega [rad/s]; zero at ω ≤ 0."""
        omega = np.asarray(omega, dtype=float)
        a, b = self._shape
        safe = np.where(omega > 0, omega, 1.0)
        return np.where(omega > 0, a / safe**5 * np.exp(-b / safe**4), 0.0)

    def moment(self, n: int) -> float:
        """Moment m_n = ∫ S ω^n dω, TM 2003-190 (38), in closed form for n < 4; m4 diverges."""
        if n >= 4:
            raise PanelsimError(
                "The moment diverges for a spectrum with an ω⁻⁵ tail", got=f"n = {n}", allowed="n below 4"
            )
        a, b = self._shape
        return float(a / 4 * b ** (n / 4 - 1) * gamma(1 - n / 4))

    def energy_between(self, low: float, high: float) -> float:
        """Share of m0 between two frequencies [rad/s], from the closed form of the integral."""
        _, b = self._shape
        below = np.exp(-b / low**4) if low > 0 else 0.0
        return float(np.exp(-b / high**4) - below)
