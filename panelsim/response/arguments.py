"""What the functions of the frequency domain refuse of their arguments."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.arguments import finite_row
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.transom import Transom
from panelsim.loads.arguments import FASTEST
from panelsim.loads.supplementary import Supplementary
from panelsim.seaway.checks import require_angles
from panelsim.ship.ship import Ship, require_ship

HIGHEST_FREQUENCY = 50.0  # rad/s; a wave of 2.5 cm

RollDamping = RollDampingTerms | Sequence[RollDampingTerms] | None


def require_parts(ship: Ship, database: HydroDatabase, supplementary: object, transom: object) -> None:
    """Raise PanelsimError for parts of another kind, and for a database or a transom of another ship."""
    require_ship(ship)
    optional = (("supplementary", supplementary, Supplementary), ("transom", transom, Transom))
    parts = [("database", database, HydroDatabase), *(part for part in optional if part[1] is not None)]
    for name, part, kind in parts:
        if not isinstance(part, kind):
            raise PanelsimError(
                f"The {name} is of another kind", got=repr(part)[:60], allowed=f"a {kind.__name__}"
            )
    database.require_for(ship)
    if isinstance(transom, Transom):
        transom.require_for(ship)


def rising_frequencies(values: ArrayLike) -> FloatArray:
    """Wave frequencies (F,) [rad/s]; PanelsimError unless they are positive and rise."""
    array = finite_row("wave frequencies", values, "rad/s")
    if not (array.min() > 0.0 and array.max() <= HIGHEST_FREQUENCY and np.all(np.diff(array) > 0.0)):
        raise PanelsimError(
            "The wave frequencies are not positive and rising",
            got=f"{array.min():g} to {array.max():g} rad/s, {len(array)} of them",
            allowed=f"more than 0, at most {HIGHEST_FREQUENCY:g} rad/s, each above the one before",
        )
    return array


def different_headings(name: str, values: ArrayLike) -> FloatArray:
    """Headings (H,) [rad]; PanelsimError unless they are angles in radians, each but once."""
    array = require_angles(name, finite_row(f"{name}s", values, "rad"))
    if len(np.unique(np.round(np.mod(array, 2.0 * np.pi), 9))) < len(array):
        raise PanelsimError(
            f"A {name} is given twice", got=np.round(np.degrees(array), 3).tolist(), remedy="give each once"
        )
    return array


def different_speeds(values: ArrayLike) -> FloatArray:
    """Speeds (S,) [m/s]; PanelsimError unless they are those of a ship that goes ahead, each but once."""
    array = finite_row("speeds", values, "m/s")
    if array.min() < 0.0 or array.max() > FASTEST or len(np.unique(array)) < len(array):
        raise PanelsimError(
            "The speeds are not those of a ship that goes ahead, or one is given twice",
            got=array.tolist(),
            allowed=f"0 to {FASTEST:g} m/s",
            remedy="turn knots into m/s: 20 * KNOT",
        )
    return array


def terms_by_speed(roll_damping: RollDamping, speeds: int) -> tuple[RollDampingTerms, ...]:
    """The roll damping at each of so many speeds; one for all may be given, or None for none."""
    if roll_damping is None or isinstance(roll_damping, RollDampingTerms):
        return (roll_damping or RollDampingTerms(),) * speeds
    given = tuple(roll_damping) if isinstance(roll_damping, Sequence) else ()
    if len(given) != speeds or not all(isinstance(terms, RollDampingTerms) for terms in given):
        raise PanelsimError(
            "The roll damping is of another kind, or not one for each speed",
            got=repr(roll_damping)[:60],
            allowed=f"RollDampingTerms, or {speeds} of them",
        )
    return given
