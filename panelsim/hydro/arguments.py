"""What the functions of coefficients refuse of their arguments, in the same words."""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import real_numbers, require_number
from panelsim.seaway.coordinates import HIGHEST_SPEED

A_DATABASE = "a HydroDatabase, as database_for(ship) gives it"
A_TRANSOM = "a Transom, as Transom.of_ship(ship, database.frequencies) cuts it, or None"


def require_speed_ahead(speed: object) -> None:
    """Raise PanelsimError unless this is the speed [m/s] of a ship at rest or going ahead."""
    require_number(
        "speed", speed, "m/s", low=0.0, high=HIGHEST_SPEED, remedy="turn knots into m/s: 20 * KNOT"
    )


def finite_row(name: str, values: ArrayLike, unit: str) -> FloatArray:
    """Finite numbers in a row, at least one; PanelsimError for all else."""
    try:
        array = np.atleast_1d(real_numbers(name, values))
    except PanelsimError:
        array = np.empty(0)
    if array.ndim != 1 or not array.size or not np.isfinite(array).all():
        raise PanelsimError(
            f"The {name} are not a row of finite numbers", got=repr(values)[:60], allowed=unit
        )
    return array
