"""All runs of a sweep: a case with other values of some keys, in seas of several seeds."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.studies.arguments import MOST_RUNS, require_ships, whole_number
from panelsim.studies.axes import Axis, Value, require_axes

SEEDED = ("random", "dataset")


@dataclass(frozen=True)
class SweepPlan:
    """All runs of a sweep: the case, its axes, and the seeds of the realizations (R,)."""

    base: Case
    axes: tuple[Axis, ...]
    seeds: tuple[int, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Values of each axis, and realizations."""
        return (*(len(axis.values) for axis in self.axes), len(self.seeds))

    @cached_property
    def cases(self) -> dict[tuple[int, ...], Case]:
        """The case of every run by its place on the axes, the realization last.

        Raises PanelsimError for keys that are unknown and values that no case may have.
        """
        return {place: self.base.changed(self.changes(place)) for place in np.ndindex(self.shape)}

    def changes(self, place: Sequence[int]) -> dict[str, Value]:
        """What the run at a place has other than the case."""
        changes = {axis.key: axis.values[i] for axis, i in zip(self.axes, place, strict=False)}
        # A sea without seeds has one realization, and keeps what it says.
        return changes | ({"seaway.seed": self.seeds[place[-1]]} if len(self.seeds) > 1 else {})

    def words(self, place: Sequence[int]) -> str:
        """What the run at a place is, in words."""
        return ", ".join(f"{key} = {value}" for key, value in self.changes(place).items())


def plan_sweep(case: Case, axes: Sequence[Axis], seeds: int = 1, *, most_runs: int = MOST_RUNS) -> SweepPlan:
    """The plan of a sweep over all values of all axes, in seas with the seed of the case and those after it.

    Raises PanelsimError for axes that do not go with the case or with each other, for seeds of a sea that
    has none, and for more than `most_runs` runs.
    """
    require_axes(axes)
    seeds, most_runs = whole_number("number of seeds", seeds), whole_number("number of most_runs", most_runs)
    first = case.file.seaway.seed
    plan = SweepPlan(case, tuple(axes), tuple(range(first, first + seeds)))
    runs = int(np.prod(plan.shape))
    if runs > most_runs:
        raise PanelsimError(
            "The sweep has more runs than were asked for",
            got=f"{' x '.join(map(str, plan.shape))} = {runs} runs",
            allowed=f"at most {most_runs}",
            remedy=f"take fewer, or allow them by --most-runs {runs} (in Python most_runs={runs})",
        )
    if seeds > 1:
        _require_seeds(plan)
    require_ships(plan.cases.values())  # whatever is wrong with a value comes before anything long
    return plan


def _require_seeds(plan: SweepPlan) -> None:
    if any(axis.key in ("seaway.seed", "seaway") for axis in plan.axes):
        raise PanelsimError(
            "The seeds are an axis of the sweep already",
            got=f"seaway.seed, and {len(plan.seeds)} seeds",
            remedy="leave out the one or the other",
        )
    kinds = {plan.base.file.seaway.kind, *(case.file.seaway.kind for case in plan.cases.values())}
    without = sorted(kinds - {*SEEDED})
    if without:
        raise PanelsimError(
            "The sea has no seeds: all its realizations would be the same",
            got=f'{len(plan.seeds)} seeds, seaway.kind = "{without[0]}"',
            allowed=f"one seed, or a seaway of the kind {' or '.join(SEEDED)}",
            remedy="leave out the number of seeds",
        )
