"""What roll damping refuses of the amplitudes it is given."""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angles


def require_amplitudes(roll_amplitude: ArrayLike) -> FloatArray:
    """Roll amplitudes (...) [rad] as an array; raises PanelsimError unless all are angles above 0."""
    amplitude = require_angles("roll amplitude", roll_amplitude)
    if not (amplitude.size and np.all(amplitude > 0.0)):
        got, allowed = repr(roll_amplitude)[:60], "more than 0 rad"
        raise PanelsimError("A roll amplitude is not positive", got=got, allowed=allowed)
    return amplitude
