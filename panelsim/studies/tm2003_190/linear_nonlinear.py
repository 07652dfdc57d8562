"""TM 2003-190 section 8.3: what nonlinear buoyancy and incident waves change; figures 14 to 17."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.conventions import Dof
from panelsim.results.rms_study import RmsStudy
from panelsim.results.rms_tables import difference_markdown, rms_csv
from panelsim.results.verdicts import SIGNIFICANT, SLIGHT
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.common import (
    BOW_QUARTERING,
    HEADINGS_DEG,
    LIMITING_STEEPNESS,
    STERN_QUARTERING,
    TYPICAL_STEEPNESS,
    Scope,
    low_seas,
    study_seas,
)
from panelsim.studies.tm2003_190.held_runs import (
    Held,
    held,
    held_failures,
    held_in_words,
    held_markdown,
    what_stays,
)
from panelsim.studies.tm2003_190.judging import (
    beyond,
    both,
    everywhere,
    exceptions,
    of_modes,
    within,
)
from panelsim.studies.tm2003_190.load_parts import LoadParts
from panelsim.studies.tm2003_190.model_causes import (
    Frequencies,
    Pair,
    cause_in_words,
    frequencies_markdown,
    frequencies_of,
    parts_markdown,
    parts_path,
    store_parts,
    stored_parts,
)
from panelsim.studies.tm2003_190.rms_plan import Level, RmsPlan
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.studies.tm2003_190.wave_frequencies import LEAST_SHARE
from panelsim.view.rms_pictures import rms_over_height

LINEAR, NONLINEAR = "linear", "nonlinear"
STEEPNESS = {"moderate": TYPICAL_STEEPNESS, "limiting": LIMITING_STEEPNESS}
FIGURES = {"moderate": (14, 15), "limiting": (16, 17)}  # of the report, at 30° and at 150°
TAKEN_APART_AT = 7.0  # m
ABOUT_FREQUENCIES = (
    "A linear ship moves at the frequencies at which she meets the waves. In bow quartering seas, first"
    " realization: how much of the variance of the nonlinear motion is at others, in brackets that of the"
    " linear one as a control, and by how much the RMS at those of the waves differs from the linear one."
    f" Waves with less than {100 * LEAST_SHARE:g} % of the energy do not count: differences of others fall"
    " upon their frequencies, and with them all less would be at others."
)
ABOUT_PARTS = (
    "The nonlinear pressure load of a run, less its linear part, is taken apart into what waves do to a ship"
    " at rest, what her motions do in calm water, and products of both; the linear ship answers each. Of"
    " the first realization; first the RMS of the answer over that of the difference between the models, then"
    " its share in the variance of that (a covariance, below 0 where loads act against each other). Where"
    " answers are larger than the difference they cancel, and a share is no cause. The last row is the RMS"
    " of what all of them miss. All loads are of incident waves and buoyancy: neither here nor in the report"
    " have diffraction and radiation nonlinear loads, which would act too."
)
ABOUT_HELD = (
    "The test of it: heave and pitch held by stiff springs in both models, and how much of the variance of"
    " the difference between them stays. Near 0 means that heave and pitch make it, 100 or more that they do"
    " not."
)
ROLL_FROM = 3.0  # m: the report excepts roll in bow quartering seas above it


@dataclass(frozen=True)
class LinearNonlinear:
    """Both models in the same waves, in seas of moderate and of limiting steepness."""

    base: Case
    scope: Scope
    key: str = "linear-nonlinear"

    @cached_property
    def plans(self) -> dict[str, RmsPlan]:
        """A plan for each steepness, by its name."""
        levels = tuple(
            Level(model, float(value), {"run.model": model})
            for value, model in enumerate((LINEAR, NONLINEAR))
        )
        return {
            name: RmsPlan(
                self.base.changed({"run.duration": self.scope.duration}),
                f"Linear against nonlinear, steepness {steepness:g}",
                "model: 0 linear, 1 nonlinear",
                levels,
                0,
                study_seas(self.scope.heights, steepness),
                self.scope.model_realizations,
            )
            for name, steepness in STEEPNESS.items()
        }

    @property
    def cases(self) -> Sequence[Case]:
        compared = [case for plan in self.plans.values() for case in plan.cases]
        apart = [one.held for found in self._held.values() for one in found]
        return compared + [case for pair in apart for case in (pair.linear, pair.nonlinear)]

    def is_measured(self, store: RunStore) -> bool:
        return all(parts_path(pair, store).is_file() for pair in self._taken_apart if pair.finished(store))

    def measure(self, store: RunStore) -> None:
        for pair in self._taken_apart:
            if not parts_path(pair, store).is_file():
                store_parts(pair, store)

    def _pairs(self, name: str, wave_heading_deg: float, realization: int = 0) -> list[Pair]:
        """A realization of each sea from a heading, in both models."""
        plan = self.plans[name]
        return [
            Pair(
                f"{STEEPNESS[name]:g}, {sea.label}",
                *(plan.case(model, index, realization) for model in range(2)),
            )
            for index, sea in enumerate(plan.seas)
            if sea.wave_heading_deg == wave_heading_deg
        ]

    @property
    def _taken_apart(self) -> list[Pair]:
        """The seas in which the nonlinear load is taken apart: one of each kind, about 7 m high."""
        return [
            self._pairs("limiting", BOW_QUARTERING)[self._near],
            self._pairs("moderate", BOW_QUARTERING)[self._near],
            self._pairs("limiting", STERN_QUARTERING)[self._near],
        ]

    @property
    def _near(self) -> int:
        """The number of the height that is taken apart."""
        return int(np.argmin(np.abs(np.array(self.scope.heights) - TAKEN_APART_AT)))

    @cached_property
    def _held(self) -> dict[str, list[Held]]:
        """Realizations of the sea from the bow that is taken apart, free and held, by its steepness."""
        count = min(self.scope.realizations, self.scope.model_realizations)
        return {
            name: [held(self._pairs(name, BOW_QUARTERING, i)[self._near]) for i in range(count)]
            for name in STEEPNESS
        }

    def section(self, store: RunStore, folder: Path) -> Section:
        studies = {name: plan.read(store) for name, plan in self.plans.items()}
        frequencies = {name: frequencies_of(self._pairs(name, BOW_QUARTERING), store) for name in studies}
        parts = stored_parts(self._taken_apart, store)
        stays = {name: what_stays(found, store) for name, found in self._held.items()}
        why = {
            name: _because(
                cause_in_words(
                    found, {sea: one for sea, one in parts.items() if sea.startswith(f"{STEEPNESS[name]:g},")}
                ),
                held_in_words(stays[name]),
            )
            for name, found in frequencies.items()
        }
        return Section(
            self.key,
            "Linear against nonlinear (8.3)",
            "When do nonlinear buoyancy and incident waves change the motions?",
            "Linear and nonlinear runs in the same waves, medium mesh, 20 knots, step 0.2 s, at nominal"
            f" steepness {TYPICAL_STEEPNESS:g} and {LIMITING_STEEPNESS:g}. Differences are those of the"
            " nonlinear from the linear model."
            + low_seas(self.base, self.scope.heights, *STEEPNESS.values()),
            _body(studies, list(frequencies.values()), parts)
            + f"\n{ABOUT_HELD} Of {len(self._held['limiting'])} realizations.\n\n"
            + held_markdown({self._held[name][0].free.sea: found for name, found in stays.items()}),
            (
                moderate_statement(studies["moderate"], why["moderate"]),
                steep_statement(studies["limiting"], why["limiting"]),
            ),
            tuple(
                (
                    rms_over_height(study, heading, folder / f"models_{name}_{heading:g}.png").name,
                    f"RMS motions at steepness {STEEPNESS[name]:g}, wave heading {heading:g}°"
                    f" (figure {FIGURES[name][0 if heading == STERN_QUARTERING else 1]} of the report).",
                )
                for name, study in studies.items()
                for heading in HEADINGS_DEG
            ),
            {f"models_{name}.csv": rms_csv(study) for name, study in studies.items()},
            tuple(studies.values()),
            {
                f"steepness {STEEPNESS[name]:g} {level.name}": plan.case(row, len(plan.seas) - 1, 0)
                for name, plan in self.plans.items()
                for row, level in enumerate(plan.levels)
            },
            (
                *(failure for study in studies.values() for failure in study.failures),
                *(failure for found in self._held.values() for failure in held_failures(found, store)),
            ),
        )


def _body(
    studies: Mapping[str, RmsStudy], frequencies: Sequence[Frequencies], parts: Mapping[str, LoadParts]
) -> str:
    """Differences, at which frequencies they are, and which loads make them."""
    differences = "".join(
        f"### Steepness {STEEPNESS[name]:g}\n\n{difference_markdown(study)}\n"
        for name, study in studies.items()
    )
    return (
        f"{differences}### At which frequencies\n\n{ABOUT_FREQUENCIES}\n\n"
        + "\n".join(frequencies_markdown(found) for found in frequencies)
        + f"\n### By which loads\n\n{ABOUT_PARTS}\n\n{parts_markdown(parts)}"
    )


def moderate_statement(study: RmsStudy, why: str) -> Statement:
    """Little influence, but for roll in bow quartering seas above 3 m."""
    roll = of_modes(study, Dof.ROLL, wave_heading_deg=BOW_QUARTERING, above=ROLL_FROM)
    found = both(
        within(study, NONLINEAR, everywhere(study) & ~roll, SLIGHT, "the rest: "),
        beyond(study, NONLINEAR, roll, SLIGHT, "roll in bow quartering seas: "),
    )
    return Statement(
        "In moderate steepness nonlinearities have little influence, but for roll in bow quartering seas"
        " above 3 m (8.3)",
        found.holds,
        found.figure,
        "" if found.holds else _because(exceptions(study, NONLINEAR, everywhere(study) & ~roll, SLIGHT), why),
    )


def steep_statement(study: RmsStudy, why: str) -> Statement:
    """Little influence, but significant on roll and yaw in bow quartering seas."""
    roll, yaw = (of_modes(study, mode, wave_heading_deg=BOW_QUARTERING) for mode in (Dof.ROLL, Dof.YAW))
    found = both(
        within(study, NONLINEAR, everywhere(study) & ~roll & ~yaw, SLIGHT, "the rest: "),
        beyond(study, NONLINEAR, roll, SIGNIFICANT, "roll in bow quartering seas: "),
        beyond(study, NONLINEAR, yaw, SIGNIFICANT, "yaw there: "),
    )
    return Statement(
        "In steep seas nonlinearities have little influence, but a significant one on roll and yaw in bow"
        " quartering seas (8.3, 10)",
        found.holds,
        found.figure,
        ""
        if found.holds
        else _because(exceptions(study, NONLINEAR, everywhere(study) & ~roll & ~yaw, SLIGHT), why),
    )


def _because(what: str, why: str) -> str:
    return "; ".join(part for part in (what, why) if part)
