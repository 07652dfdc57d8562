"""What a run must have before it is begun: values in range, and a time step that can carry it."""

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from panelsim.conventions import METHODS, RULES, STRETCHINGS, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.arguments import require_word, ship_displacement, six_numbers
from panelsim.loads.supplementary import Supplementary
from panelsim.seaway.checks import is_number
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import require_ship

MODELS = ("nonlinear", "linear")
INERTIAS = ("large", "linear")
MOST_STEPS = 2_000_000  # a run keeps some 600 bytes a step, 1000 while its history is made
# The longest step of each scheme over the highest natural frequency of the ship, whatever her damping. RK4 is
# stable to ω dt = 2.83, but at 2 it takes a quarter off a motion with every step; AB3 is stable to 0.72. The
# exponential scheme is stable, but what is not linear is off by a tenth or more from 1.5 on
# (reports/steppers.md). Whether the damped motions are stable is asked by `Stability`.
LONGEST_STEP = {"exponential": 1.5, "rk4": 2.0, "ab3": 0.7}
# Two samples a period are the least that can show a wave at all.
LEAST_SAMPLES = np.pi
ENERGY_THAT_COUNTS = 0.05


@contextmanager
def about_member(member: int, members: int) -> Iterator[None]:
    """Put the number of the member of a batch in front of a PanelsimError from the block."""
    try:
        yield
    except PanelsimError as error:
        if members == 1:
            raise
        raise PanelsimError(
            f"Member {member + 1} of {members}: {error.what}",
            got=error.got,
            allowed=error.allowed,
            remedy=error.remedy,
        ) from None


def require_run(
    *,
    members: int,
    duration: float,
    time_step: float,
    ramp: float,
    capsize_angle: float,
    model: str,
    inertia: str | None,
    stepper: str,
    stretching: str,
    pressure_method: str,
    pressure_rule: str,
) -> None:
    """Raise PanelsimError for a value that no batch of runs can have; SI units and radians."""
    for name, word, known in (
        ("model", model, MODELS),
        ("stepper", stepper, tuple(LONGEST_STEP)),
        ("wave stretching", stretching, STRETCHINGS),
        ("pressure method", pressure_method, METHODS),
        ("pressure rule", pressure_rule, RULES),
    ):
        require_word(name, word, known)
    if inertia is not None:
        require_word("inertia", inertia, INERTIAS)
    if (model, inertia) == ("linear", "large"):
        raise PanelsimError(
            "The linear model has the inertia of small angles",
            got=f'inertia "{inertia}"',
            allowed='"linear", or none given',
        )
    bounds = {
        "time_step": (time_step, 1e-4, 5.0, "s"),
        "duration": (duration, time_step, 1e6, "s"),
        "ramp": (ramp, 0.0, 1e5, "s"),
        "capsize_angle": (capsize_angle, 0.0, np.pi, "rad"),
    }
    for name, (value, low, high, unit) in bounds.items():
        _require_between(name, value, low, high, unit)
    steps = members * (ramp + duration) / time_step
    if steps > MOST_STEPS:
        raise PanelsimError(
            "The run has too many steps" if members == 1 else "The runs of the batch have too many steps",
            got=f"{steps:.3g}",
            allowed=f"at most {MOST_STEPS}",
            remedy="shorten the run, or take a longer time step"
            + (", or fewer seaways at a time" if members > 1 else ""),
        )


def require_speed(speed: float) -> None:
    """Raise PanelsimError unless the speed [m/s] is one that a ship can have."""
    _require_between("speed", speed, 0.0, 50.0, "m/s")


def require_seed(seed: int | None) -> None:
    """Raise PanelsimError unless the seed to remember is a whole number or None."""
    whole = isinstance(seed, int | np.integer) and not isinstance(seed, bool)
    if seed is not None and not (whole and -(2**63) <= seed < 2**63):
        raise PanelsimError(
            "The seed is no whole number of 64 bits", got=repr(seed)[:60], allowed="an integer, or None"
        )


def _require_between(name: str, value: float, low: float, high: float, unit: str) -> None:
    allowed = f"{low:g} to {high:g} {unit}"
    if not is_number(value):
        raise PanelsimError(f"The {name} is not a number", got=repr(value)[:60], allowed=allowed)
    if not low <= value <= high:
        raise PanelsimError(f"The {name} is out of range", got=f"{value:g} {unit}", allowed=allowed)


def rounded_down(value: float) -> str:
    """A number above 0 as text of two digits, not above it: what is told as the longest must be allowed."""
    digits = 1 - math.floor(math.log10(value))
    return f"{math.floor(value * 10.0**digits) / 10.0**digits:.2g}"


def require_step_for_waves(time_step: float, components: WaveComponents, encounter: FloatArray) -> None:
    """Raise PanelsimError where the step [s] is too long for the waves, met at `encounter` (M,) [rad/s]."""
    share = energy_share(components, np.abs(encounter) * time_step > LEAST_SAMPLES)
    if share > ENERGY_THAT_COUNTS:
        raise PanelsimError(
            "The time step is too long for the waves that the ship meets",
            got=f"{time_step:g} s; {100 * share:.0f} % of the wave energy passes in less than two steps",
            allowed=f"at most {rounded_down(LEAST_SAMPLES / np.abs(encounter).max())} s for all of it",
            remedy="shorten run.time_step",
        )


def energy_share(components: WaveComponents, chosen: np.ndarray) -> float:
    """Share of the wave energy that the chosen components (M,) carry; 0 in calm water."""
    energy = components.amplitude**2
    return float(energy[chosen].sum() / energy.sum()) if energy.any() else 0.0


def require_types(
    ship: object, database: object, supplementary: object, notes: object, progress: object
) -> None:
    """Raise PanelsimError for arguments that are names or tables of what they should be."""
    require_ship(ship)
    wanted = {
        "database": (database, HydroDatabase, "a HydroDatabase, as database_for(ship) gives it"),
        "supplementary": (supplementary, Supplementary | None, "a Supplementary, or None"),
    }
    for name, (value, kind, allowed) in wanted.items():
        if not isinstance(value, kind):
            raise PanelsimError(f"The {name} is of another kind", got=repr(value)[:60], allowed=allowed)
    if (
        isinstance(notes, str)
        or not isinstance(notes, Sequence)
        or not all(isinstance(n, str) for n in notes)
    ):
        raise PanelsimError(
            "The notes are no list of texts", got=repr(notes)[:60], allowed="a list of sentences"
        )
    if progress is not None and not callable(progress):
        raise PanelsimError(
            "The progress is no function", got=repr(progress)[:60], allowed="progress(done, total), or None"
        )


def case_text(case: Mapping[str, Any] | None) -> str:
    """The case to keep as JSON; PanelsimError for what JSON cannot hold."""
    try:
        return json.dumps(case or {}, ensure_ascii=False, sort_keys=True)
    except (TypeError, ValueError) as error:
        raise PanelsimError(
            "The case cannot be kept",
            got=str(error)[:200],
            allowed="tables, lists, texts, numbers, true and false, as in a case file",
        ) from None


def sequence_of(name: str, values: object, members: int | None = None) -> list[Any]:
    """A sequence as a list, one entry for each of the members of a batch, else PanelsimError."""
    allowed = "a sequence" if members is None else f"a sequence of {members}, one for each seaway"
    if isinstance(values, (str, bytes, Mapping)) or not is_iterable(values):
        raise PanelsimError(f"The {name} are no sequence", got=repr(values)[:60], allowed=allowed)
    listed = list(values)  # type: ignore[call-overload]
    if not listed:
        raise PanelsimError(f"There are no {name}", got="an empty sequence", allowed="one or more")
    if members not in (None, len(listed)):
        raise PanelsimError(
            f"There is not one of the {name} for each seaway", got=len(listed), allowed=allowed
        )
    return listed


def is_iterable(values: object) -> bool:
    """Whether there is something to list; arrays without a dimension say so but have nothing."""
    return (
        isinstance(values, Iterable) and np.ndim(values) > 0
        if isinstance(values, np.ndarray)
        else isinstance(values, Iterable)
    )


def six_numbers_each(name: str, values: object, members: int, *, angles: bool) -> FloatArray:
    """Six finite numbers for each member (B, 6), given once (6,) or for each; else PanelsimError.

    With `angles` the last three are angles of no more than a turn.
    """
    check = ship_displacement if angles else six_numbers
    rows = list(values) if is_iterable(values) else [values]  # type: ignore[call-overload]
    if not any(is_iterable(row) for row in rows):
        return np.tile(check(name, values), (members, 1))
    if len(rows) != members:
        raise PanelsimError(
            f"The {name} is not that of each member of the batch",
            got=f"{len(rows)} rows",
            allowed=f"(6,), or ({members}, 6)",
        )
    checked = []
    for i, row in enumerate(rows):
        with about_member(i, members):
            checked.append(check(name, row))
    return np.array(checked)
