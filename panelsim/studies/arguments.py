"""What studies are given from Python: of the right kind, or refused in words."""

import operator
from collections.abc import Iterable, Mapping
from contextlib import suppress
from numbers import Real
from typing import Any

import numpy as np

from panelsim.case import Case
from panelsim.errors import PanelsimError, require_kind
from panelsim.ship.bundled import default_panel_area

MOST_RUNS = 2000  # of a study; more are a slip, or a sweep that its caller must ask for


def require_case(case: Case) -> None:
    """Raise PanelsimError for what is no case, such as its path."""
    require_kind("case", case, Case, 'a Case, as Case.load("name.toml") reads it')


def whole_number(what: str, number: object) -> int:
    """A number from 1 on, Python's or NumPy's; PanelsimError with `what`, "number of seeds", for others."""
    try:
        found = 0 if isinstance(number, bool) else operator.index(number)  # type: ignore[arg-type]
    except TypeError:
        found = 0
    if found < 1:
        raise PanelsimError(f"The {what} is not possible", got=_short(number), allowed="1, 2, 3, …")
    return found


def real_numbers(what: str, values: object) -> list[float]:
    """Numbers from a list, a tuple or an array of one dimension; PanelsimError for all else."""
    found = listed(what, values, "numbers, for example [0.1, 0.2]")
    if not all(isinstance(value, Real) and not isinstance(value, bool) for value in found):
        raise PanelsimError(
            f"The {what} are not all numbers", got=_short(values), allowed="numbers, for example [0.1, 0.2]"
        )
    return [float(value) for value in found]


def listed(what: str, values: object, allowed: str) -> list[Any]:
    """The values of a list, as Python has them; PanelsimError for a single one, a text, or none at all."""
    single = isinstance(values, str | bytes | Mapping) or (isinstance(values, np.ndarray) and not values.ndim)
    if single or not isinstance(values, Iterable):
        raise PanelsimError(f"The {what} are no list", got=_short(values), allowed=allowed)
    found = [value.item() if isinstance(value, np.generic) else value for value in values]
    if not found:
        raise PanelsimError(f"There are no {what}", got="an empty list", allowed=allowed)
    return found


def require_few_runs(runs: int) -> None:
    """Raise PanelsimError for a study of more runs than anybody means."""
    if runs > MOST_RUNS:
        raise PanelsimError(
            "The study has too many runs",
            got=f"{runs} runs",
            allowed=f"at most {MOST_RUNS}",
            remedy="take fewer seeds, or fewer levels",
        )


def require_ships(cases: Iterable[Case]) -> None:
    """Build each distinct ship once: PanelsimError for one that cannot be, before the first run."""
    for case in {case.file.ship.model_dump_json(): case for case in cases}.values():
        _ = case.ship


def areas_that_suit(case: Case, factors: Iterable[float]) -> list[float]:
    """These multiples of the panel area [m²] of a ship, less those that her hull cannot be made of."""
    form = case.ship.form
    assert form is not None
    own = case.file.ship.panel_area or default_panel_area(form)
    found = []
    for area in [factor * own for factor in factors]:
        with suppress(PanelsimError):
            require_ships([case.changed({"ship.panel_area": area})])
            found.append(area)
    return found


def _short(value: object) -> str:
    return " ".join(repr(value).split())[:60]
