"""The JONSWAP spectrum: a sea whose fetch is limited, by height, peak period and peak enhancement."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_numbers, require_positive
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.spectra.system import SMALLEST_RATIO
from panelsim.seaway.steepness import require_possible_sea

MEAN_PEAK_ENHANCEMENT = 3.3  # mean of the JONSWAP measurements, Hasselmann et al. (1973)
WIDTH_BELOW, WIDTH_ABOVE = 0.07, 0.09  # σ to the two sides of the peak, TM 2003-190 (47)
FULLY_DEVELOPED = 0.13  # f_p U/g at which a sea has stopped to grow, Pierson and Moskowitz (1964), U at 10 m
# How far a fit of the level goes: past these 4 √m0 is over 1.5 % (Goda) or 3.5 % (logarithmic) from H_s.
HIGHEST_PEAK_ENHANCEMENT = {"goda": 20.0, "logarithmic": 10.0}


@dataclass(frozen=True)
class Jonswap(PointSpectrum):
    """JONSWAP spectrum, TM 2003-190 (45)-(47), by H_s [m], peak period [s] and peak enhancement γ [-].

    S(ω) = α* H_s² ω_p⁴ ω⁻⁵ exp(−(5/4)(ω_p/ω)⁴) γ^κ, κ = exp(−(ω − ω_p)²/(2σ²ω_p²)), where `normalisation`
    says how α* makes H_s the height of the sea: "goda", (48), or "logarithmic", (5/16)(1 − 0.287 ln γ),
    GROUPS (16) with ω_p = 2π/T_p and the minus sign in κ. Both are fits: for γ from 1 to 10 4 √m0 is between
    0.22 % below and 0.01 % above H_s with Goda's, between 0.17 % below and 0.15 % above with the logarithmic
    one up to γ = 5, and 3.5 % below at γ = 10. `significant_wave_height` is the H_s that was given.

    Raises PanelsimError where a value is not positive, γ is below 1 or too large for the fit, the
    normalisation is unknown, or the sea is steeper than waves can be.
    """

    significant_wave_height: float
    peak_period: float
    peak_enhancement: float = MEAN_PEAK_ENHANCEMENT
    normalisation: str = field(default="goda", kw_only=True)

    def __post_init__(self) -> None:
        require_positive("significant_wave_height", self.significant_wave_height, "m")
        require_positive("peak_period", self.peak_period, "s")
        require_positive("peak_enhancement", self.peak_enhancement, "")
        if self.normalisation not in list(HIGHEST_PEAK_ENHANCEMENT):
            raise PanelsimError(
                "Unknown normalisation of the JONSWAP spectrum",
                got=repr(self.normalisation)[:60],
                allowed=" | ".join(HIGHEST_PEAK_ENHANCEMENT),
            )
        highest = HIGHEST_PEAK_ENHANCEMENT[self.normalisation]
        if not 1.0 <= self.peak_enhancement <= highest:
            raise PanelsimError(
                "peak_enhancement is out of range",
                got=f"{self.peak_enhancement:g}",
                allowed=f"1 (no enhancement) to {highest:g} (the {self.normalisation} normalisation)",
            )
        require_possible_sea(self.significant_wave_height, self.peak_period)

    @classmethod
    def from_wind(cls, wind_speed: float, fetch: float) -> "Jonswap":
        """The sea of a wind [m/s] at 10 m above the sea after a fetch [m], Hasselmann et al. (1973), γ = 3.3.

        The tail is α g² ω⁻⁵ with α = 0.076 (U²/(F g))^0.22, SIMULATORS (8), printed with 0.0076;
        ω_p = 22 (g²/(U F))^⅓, from which 2π · 3.5 (g/U) (g F/U²)^−0.33 is 3 % apart at g F/U² = 10⁴. H_s is
        that of the spectrum; Hasselmann's own fit of the energy, 1.6e-7 g F/U², gives a lower one (3.43 m for
        4.51 m at 15 m/s and 200 km).

        Raises PanelsimError where the sea would be more than fully developed.
        """
        wind = require_positive("wind_speed", wind_speed, "m/s")
        fetch, gravity = require_positive("fetch", fetch, "m"), STANDARD_GRAVITY
        longest = (22.0 / (2 * np.pi * FULLY_DEVELOPED)) ** 3 * wind**2 / gravity
        if fetch > longest:
            raise PanelsimError(
                "The sea of this fetch is more than fully developed",
                got=f"{fetch:g} m at {wind:g} m/s",
                allowed=f"a fetch of at most {longest:.3g} m",
                remedy="use the Pierson-Moskowitz spectrum, or a shorter fetch",
            )
        level = 0.076 * (wind**2 / (fetch * gravity)) ** 0.22
        peak_frequency = 22.0 * (gravity**2 / (wind * fetch)) ** (1 / 3)
        height = gravity * np.sqrt(level / _goda(MEAN_PEAK_ENHANCEMENT)) / peak_frequency**2
        return cls(float(height), float(2 * np.pi / peak_frequency))

    @classmethod
    def dnv(cls, significant_wave_height: float, peak_period: float) -> "Jonswap":
        """The sea of DNV-RP-C205 (3.5.5.5): γ by how steep it is, from 1 (fully developed) to 5.

        γ = 5 for T_p/√H_s ≤ 3.6, exp(5.75 − 1.15 T_p/√H_s) to 5, 1 above; logarithmic normalisation.
        """
        height = require_positive("significant_wave_height", significant_wave_height, "m")
        ratio = require_positive("peak_period", peak_period, "s") / np.sqrt(height)
        if ratio <= 3.6:
            enhancement = 5.0
        elif ratio < 5.0:
            enhancement = float(np.exp(5.75 - 1.15 * ratio))
        else:
            enhancement = 1.0
        return cls(height, peak_period, enhancement, normalisation="logarithmic")

    @property
    def _level(self) -> float:
        """α* [-] of (45)."""
        if self.normalisation == "goda":
            return _goda(self.peak_enhancement)
        return float(5 / 16 * (1 - 0.287 * np.log(self.peak_enhancement)))

    def density(self, omega: ArrayLike) -> FloatArray:
        omega = require_numbers(omega)
        peak = 2 * np.pi / self.peak_period
        ratio = peak / np.maximum(omega, SMALLEST_RATIO * peak)
        width = np.where(omega <= peak, WIDTH_BELOW, WIDTH_ABOVE) * peak
        distance = np.clip((omega - peak) / width, -40.0, 40.0)  # past which κ is 0
        enhancement = self.peak_enhancement ** np.exp(-0.5 * distance**2)
        tail = self._level * self.significant_wave_height**2 / peak * ratio**5
        return tail * np.exp(-1.25 * ratio**4) * enhancement


def _goda(peak_enhancement: float) -> float:
    """Goda's α* [-], TM 2003-190 (48)."""
    return 0.0624 / (0.230 + 0.0336 * peak_enhancement - 0.185 / (1.9 + peak_enhancement))
