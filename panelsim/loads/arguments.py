"""What the functions of loads and runs refuse of their arguments, in the same words."""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_number
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import require_ship

FASTEST = 50.0  # m/s, astern as well as ahead
# Beyond these, phases of waves have no digits left.
FARTHEST = 1e6  # m
LATEST = 1e8  # s


def require_seaway(seaway: object) -> None:
    """Raise PanelsimError for what is no seaway."""
    components, kind = getattr(seaway, "components", None), getattr(seaway, "kind", None)
    if not (isinstance(components, WaveComponents) and isinstance(kind, str)):
        raise PanelsimError(
            "The seaway is of another kind",
            got=repr(seaway)[:60],
            allowed="a seaway, for example a RandomSeaway",
            remedy="a ComponentSeaway makes one of wave components",
        )


def require_word(name: str, word: object, known: tuple[str, ...]) -> None:
    """Raise PanelsimError unless the word is one of those known."""
    if not (isinstance(word, str) and word in known):
        raise PanelsimError(f"Unknown {name}", got=repr(word)[:60], allowed=" | ".join(known))


def six_numbers(name: str, values: object) -> FloatArray:
    """Six finite real numbers (6,) as floats, else PanelsimError."""
    try:
        array = np.asarray(values)
    except ValueError:  # ragged
        array = np.empty(0)
    if array.shape != (6,) or array.dtype.kind not in "iuf" or not np.isfinite(array).all():
        raise PanelsimError(
            f"The {name} is not six finite numbers", got=repr(values)[:200], allowed="surge, sway … yaw"
        )
    return array.astype(float)


def ship_displacement(name: str, values: object) -> FloatArray:
    """Surge to yaw (6,) [m, rad] of a ship; PanelsimError also for angles of more than a turn."""
    moved = six_numbers(name, values)
    if (np.abs(moved[3:]) > 2.0 * np.pi).any():
        raise PanelsimError(
            f"An angle of the {name} is more than a full turn",
            got=f"roll, pitch, yaw = {moved[3:].tolist()} rad",
            allowed="-2π to 2π",
            remedy="angles are in rad: np.radians(25.0) for 25 degrees",
        )
    return moved


def instant_arguments(
    ship: object, seaway: object, time: object, displacement: object, speed: object
) -> FloatArray:
    """The displacement (6,) of a ship at an instant, all else checked: PanelsimError names what is wrong."""
    require_ship(ship)
    require_seaway(seaway)
    require_number("time", time, "s", low=-LATEST, high=LATEST)
    require_number("speed", speed, "m/s", low=-FASTEST, high=FASTEST)
    moved = ship_displacement("displacement", displacement)
    if (np.abs(moved[:3]) > FARTHEST).any():
        raise PanelsimError(
            "The displacement is out of range",
            got=f"surge, sway, heave = {moved[:3].tolist()} m",
            allowed=f"-{FARTHEST:g} to {FARTHEST:g} m",
        )
    return moved
