"""The Pierson-Moskowitz spectrum: a fully developed sea by its wind."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_positive
from panelsim.seaway.spectra.bretschneider import PHILLIPS_LEVEL, Bretschneider
from panelsim.seaway.spectra.point_spectrum import PointSpectrum

WIND_FACTOR = 0.74  # β, SIMULATORS (5)
STRONGEST_WIND = 50.0  # m/s


@dataclass(frozen=True)
class PiersonMoskowitz(PointSpectrum):
    """Fully developed sea S(ω) = α g² ω⁻⁵ exp(−β (g/(U ω))⁴), WORKSHOP 4.5, α = 0.0081, β = 0.74.

    `wind_speed` U [m/s] at 19.5 m above the sea. It is SIMULATORS (2)–(5) with ω = 2πf, and a Bretschneider
    spectrum of H_s = 2 √(α/β) U²/g = 0.2092 U²/g and ω_p = (4β/5)^¼ g/U = 0.8772 g/U.

    Raises PanelsimError where the wind speed is not positive.
    """

    wind_speed: float
    significant_wave_height: float = field(init=False)
    peak_period: float = field(init=False)

    def __post_init__(self) -> None:
        if require_positive("wind_speed", self.wind_speed, "m/s") > STRONGEST_WIND:
            raise PanelsimError(
                "No such wind blows long enough for a fully developed sea",
                got=f"{self.wind_speed:g} m/s",
                allowed=f"at most {STRONGEST_WIND:g} m/s (a sea of 53 m)",
            )
        object.__setattr__(self, "significant_wave_height", self._as_bretschneider.significant_wave_height)
        object.__setattr__(self, "peak_period", self._as_bretschneider.peak_period)

    @classmethod
    def from_significant_wave_height(cls, significant_wave_height: float) -> "PiersonMoskowitz":
        """The sea of a significant wave height [m]: U² = g H_s √(β/α)/2."""
        height = require_positive("significant_wave_height", significant_wave_height, "m")
        return cls(float(np.sqrt(0.5 * STANDARD_GRAVITY * height * np.sqrt(WIND_FACTOR / PHILLIPS_LEVEL))))

    @cached_property
    def _as_bretschneider(self) -> Bretschneider:
        height = 2 * np.sqrt(PHILLIPS_LEVEL / WIND_FACTOR) * self.wind_speed**2 / STANDARD_GRAVITY
        peak_frequency = (0.8 * WIND_FACTOR) ** 0.25 * STANDARD_GRAVITY / self.wind_speed
        return Bretschneider(float(height), float(2 * np.pi / peak_frequency))

    def density(self, omega: ArrayLike) -> FloatArray:
        return self._as_bretschneider.density(omega)

    def moment(self, n: int, upper_frequency: float | None = None) -> float:
        return self._as_bretschneider.moment(n, upper_frequency)

    def _share_below(self, frequency: float) -> float:
        return self._as_bretschneider._share_below(frequency)

    def frequency_below(self, share: float) -> float:
        return self._as_bretschneider.frequency_below(share)
