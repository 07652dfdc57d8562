"""How high the seas of one peak period have been seen to be."""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.steepness import BUCKLEY_STEEPNESS


def buckley_height(peak_period: ArrayLike) -> FloatArray:
    """Buckley's limiting significant wave height 0.049 g T_p²/2π [m], TM 2003-190 (56), TM 2004-041 (12).

    Wave buoys have seen no higher sea of that peak period [s]. Scalars or arrays; PanelsimError where a
    period is not positive.
    """
    try:
        period = np.asarray(peak_period, dtype=float)
    except (TypeError, ValueError):
        period = np.array(np.nan)
    if not (np.isfinite(period).all() and (period > 0).all()):
        raise PanelsimError("peak_period is not positive", got=peak_period, allowed="more than 0 s")
    return BUCKLEY_STEEPNESS * STANDARD_GRAVITY * period**2 / (2 * np.pi)
