"""Convergence of a case with its time step or its panels: which runs, and what they amount to."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from panelsim.case import Case
from panelsim.case.ship_section import is_mesh_file
from panelsim.conventions import RULES
from panelsim.errors import PanelsimError
from panelsim.motion.requirements import LONGEST_STEP
from panelsim.results.convergence_order import ConvergenceOrder, convergence_order
from panelsim.results.rms_study import RmsStudy
from panelsim.results.verdicts import IDENTICAL, worst_difference
from panelsim.studies.arguments import (
    areas_that_suit,
    listed,
    real_numbers,
    require_case,
    require_few_runs,
    require_ships,
)
from panelsim.studies.rms_of_runs import rms_of_runs
from panelsim.studies.run_store import RunStore
from panelsim.studies.study_sea import realization, require_seeds, study_sea

STEP_FACTORS = (0.5, 1.0, 2.0)
AREA_FACTORS = (0.5, 1.0, 2.0, 4.0)
# The reference is finer than the finest: half its step, half its panel area.
FINER = 0.5
MOST_LEVELS = 30
SHOWN = 8  # values in a message
ROUND_OFF = 1e-9


@dataclass(frozen=True, eq=False)
class Convergence:
    """A case at several step sizes or panel areas, for each of some schemes, against one finer reference.

    `value_key` and `scheme_key` are the keys of the case that are varied, `values` (L,) [s, m²] of the first,
    falling, and `schemes` of the second. The reference has the first scheme.
    """

    key: str
    title: str
    varied: str
    unit: str
    case: Case
    value_key: str
    values: tuple[float, ...]
    scheme_key: str
    schemes: tuple[str, ...]
    seeds: int

    @property
    def reference(self) -> float:
        """Step [s] or panel area [m²] of the reference."""
        return FINER * min(self.values)

    @property
    def reference_label(self) -> str:
        scheme = f"{self.schemes[0]}, " if len(self.schemes) > 1 else ""
        return f"{scheme}{self.reference:.4g} {self.unit} (reference)"

    @cached_property
    def _cases(self) -> dict[tuple[str, float, int], Case]:
        """Every case by scheme, value and realization."""
        levels = [(scheme, value) for scheme in self.schemes for value in self.values]
        require_few_runs((len(levels) + 1) * self.seeds)
        found = {}
        for scheme, value in [(self.schemes[0], self.reference), *levels]:
            changes: dict[str, Any] = {self.value_key: value}
            # What the case leaves open stays open: it is one run, whether a scheme was named or not.
            if getattr(self.case.file.run, self.scheme_key.removeprefix("run.")) != scheme:
                changes[self.scheme_key] = scheme
            changed = self.case.changed(changes)
            for index in range(self.seeds):
                found[scheme, value, index] = realization(changed, index)
        return found

    @property
    def cases(self) -> list[Case]:
        """Every case to run."""
        return list(self._cases.values())

    def case_of(self, scheme: str, level: int, index: int) -> Case:
        """The case of a level and realization; the level after the last is the reference."""
        if level == len(self.values):
            return self._cases[self.schemes[0], self.reference, index]
        return self._cases[scheme, self.values[level], index]

    def study(self, store: RunStore, scheme: str) -> RmsStudy:
        """What the stored runs of a scheme amount to, the reference as the last level."""
        labels = [f"{value:.4g} {self.unit}" for value in self.values]
        return rms_of_runs(
            store,
            lambda level, _, index: self.case_of(scheme, level, index),
            title=f"{self.title}, {_words_of(self.scheme_key)} {scheme}",
            varied=self.varied,
            levels=[*labels, self.reference_label],
            values=np.array([*self.values, self.reference]),
            reference=len(self.values),
            seas=[study_sea(self.case)],
            realizations=self.seeds,
        )

    def order(self, study: RmsStudy, scheme: str) -> ConvergenceOrder:
        """Order of convergence with the step, or with the length √A of a panel side."""
        own = scheme == self.schemes[0]
        if self.unit == "s":
            # The samples of a run say its RMS to about a step in its duration.
            floor = study.values / self.case.file.run.duration
            return convergence_order(study, study.values, floor=floor, own_reference=own)
        return convergence_order(study, np.sqrt(study.values), floor=ROUND_OFF, own_reference=own)


def recommended(study: RmsStudy) -> float | None:
    """The coarsest value at which, and at all finer ones, the major modes are within 1 % of the reference."""
    coarsest = None
    for level in np.argsort(study.values):
        if level == study.reference:
            continue
        if not abs(worst_difference(study, int(level)).amount) <= IDENTICAL:
            break
        coarsest = float(study.values[level])
    return coarsest


def time_step_convergence(
    case: Case,
    steps: Sequence[float] | None = None,
    steppers: Sequence[str] | None = None,
    seeds: int = 1,
) -> Convergence:
    """Time steps [s], by default half, once and twice that of the case; steppers, by default its own.

    Raises PanelsimError for steps and steppers that no run may have, and for a sea without waves or seeds.
    """
    seeds = _seeds(case, seeds)
    own = case.file.run.time_step
    if steps is None:
        steps = [factor * own for factor in STEP_FACTORS]
    study = Convergence(
        key="time-step",
        title="Time step",
        varied="time step [s]",
        unit="s",
        case=case,
        value_key="run.time_step",
        values=falling("time steps", steps, "s"),
        scheme_key="run.stepper",
        schemes=_different("steppers", steppers, case.file.run.stepper, tuple(LONGEST_STEP)),
        seeds=seeds,
    )
    _ = study.cases  # what no case may have is refused before anything is run
    return study


def mesh_convergence(
    case: Case,
    panel_areas: Sequence[float] | None = None,
    rules: Sequence[str] | None = None,
    seeds: int = 1,
) -> Convergence:
    """Panel areas [m²], by default half, once, twice and four times those of the ship; pressure rules.

    Of the default areas those are left out that the hull cannot be made of.

    A linear case is studied too: its restoring and Froude-Krylov forces are sums over panels. Raises
    PanelsimError for areas and rules that no ship or run may have, for a ship of a mesh file, which has its
    own panels, for pressure rules of a linear case, and for a sea without waves or seeds.
    """
    seeds = _seeds(case, seeds)
    run = case.file.run
    if rules is not None and run.model == "linear":
        raise PanelsimError(
            "The linear model integrates no pressure over the wet panels, and has no pressure rule",
            got=f'run.model = "linear" with rules {", ".join(map(str, rules))}',
            remedy="leave the rules out, or set run.model to nonlinear",
        )
    require_panels(case)
    study = Convergence(
        key="mesh",
        title="Panels",
        varied="panel area [m2]",
        unit="m2",
        case=case,
        value_key="ship.panel_area",
        values=falling(
            "panel areas", areas_that_suit(case, AREA_FACTORS) if panel_areas is None else panel_areas, "m2"
        ),
        scheme_key="run.pressure_rule",
        schemes=_different("pressure rules", rules, run.pressure_rule, RULES),
        seeds=seeds,
    )
    require_ships(study.cases)
    return study


def _words_of(key: str) -> str:
    """The last part of a key of the case, as words: run.pressure_rule, pressure rule."""
    return key.rpartition(".")[2].replace("_", " ")


def require_panels(case: Case) -> None:
    """Raise PanelsimError for a ship whose panels are given."""
    if is_mesh_file(case.file.ship.hull):
        raise PanelsimError(
            "A mesh file has its own panels, which no panel area makes finer or coarser",
            got=f'ship.hull = "{case.file.ship.hull}"',
            allowed="a bundled hull or a hull folder",
            remedy="write the mesh at several sizes of panel, and run the case with each by"
            " --set ship.hull=FILE",
        )


def _seeds(case: Case, seeds: int) -> int:
    require_case(case)
    study_sea(case)
    return require_seeds(case, seeds)


def falling(what: str, values: Sequence[float], unit: str) -> tuple[float, ...]:
    """Values that differ, are positive and not too many, the largest first."""
    given = real_numbers(what, values)
    told = f"{', '.join(f'{value:.9g}' for value in given[:SHOWN])}{', …' * (len(given) > SHOWN)} {unit}"
    if len(given) > MOST_LEVELS:
        raise PanelsimError(
            f"There are too many {what}", got=f"{len(given)}: {told}", allowed=f"at most {MOST_LEVELS}"
        )
    if not all(np.isfinite(value) and value > 0.0 for value in given):
        raise PanelsimError(f"The {what} are not positive", got=told, allowed="more than 0")
    if len({f"{value:.4g}" for value in given}) < len(given):
        raise PanelsimError(
            f"Two of the {what} are the same",
            got=told,
            allowed="values that differ in their first four digits",
            remedy="give each once",
        )
    return tuple(sorted(given, reverse=True))


def _different(what: str, words: Sequence[str] | None, own: str, known: tuple[str, ...]) -> tuple[str, ...]:
    """Words of those that are known, each once; that of the case where none are given."""
    given = (own,) if words is None else tuple(map(str, listed(what, words, ", ".join(known))))
    unknown = [f'"{word}"' for word in given if word not in known]
    if unknown:
        raise PanelsimError(f"Not all {what} are known", got=", ".join(unknown), allowed=", ".join(known))
    if len(set(given)) < len(given):
        raise PanelsimError(f"Two of the {what} are the same", got=", ".join(given), remedy="give each once")
    return given
