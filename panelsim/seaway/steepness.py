"""How steep waves and seas can be."""

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY
from panelsim.errors import PanelsimError

BREAKING_STEEPNESS = 0.142  # H/λ at which regular waves break, TM 2003-190 section 2.2
BUCKLEY_STEEPNESS = 0.049  # largest nominal steepness that wave buoys have seen, TM 2003-190 section 5


def nominal_steepness(significant_wave_height: float, peak_period: float) -> float:
    """2π H_s / (g T_p²), TM 2003-190 (56); H_s in m, T_p in s."""
    return float(2 * np.pi * significant_wave_height / (STANDARD_GRAVITY * peak_period**2))


def require_possible_sea(significant_wave_height: float, peak_period: float) -> None:
    """Refuse a sea whose nominal steepness is above that at which regular waves break."""
    steepness = nominal_steepness(significant_wave_height, peak_period)
    if steepness > BREAKING_STEEPNESS:
        lowest = peak_period * np.sqrt(steepness / BREAKING_STEEPNESS)
        highest = significant_wave_height * BREAKING_STEEPNESS / steepness
        raise PanelsimError(
            "The sea is steeper than waves can be",
            got=f"H_s {significant_wave_height:g} m at T_p {peak_period:g} s, steepness {steepness:.3f}",
            allowed=f"at most {BREAKING_STEEPNESS} (breaking)",
            remedy=f"take significant_wave_height under {highest:.2g} m, or peak_period over {lowest:.1f} s",
        )
