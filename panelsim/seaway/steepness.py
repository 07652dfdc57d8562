"""How steep waves and seas can be."""

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY

BREAKING_STEEPNESS = 0.142  # H/λ at which regular waves break, TM 2003-190 section 2.2
BUCKLEY_STEEPNESS = 0.049  # largest nominal steepness that wave buoys have seen, TM 2003-190 section 5


def nominal_steepness(significant_wave_height: float, peak_period: float) -> float:
    """2π H_s / (g T_p²), TM 2003-190 (56); H_s in m, T_p in s."""
    return float(2 * np.pi * significant_wave_height / (STANDARD_GRAVITY * peak_period**2))
