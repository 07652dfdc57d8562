"""TM 2003-190 section 8.1: how long a time step may be, for each scheme; figures 10 and 11."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.results.rms_study import RmsStudy
from panelsim.results.rms_tables import difference_markdown, rms_csv
from panelsim.results.verdicts import IDENTICAL, NOTICEABLE
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.common import (
    BOW_QUARTERING,
    HEADINGS_DEG,
    LIMITING_STEEPNESS,
    STERN_QUARTERING,
    Scope,
    low_seas,
    study_seas,
)
from panelsim.studies.tm2003_190.judging import (
    against,
    beyond,
    everywhere,
    from_heading,
    where_it_counts,
    within,
    worst,
)
from panelsim.studies.tm2003_190.rms_plan import Level, RmsPlan
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.view.rms_pictures import rms_over_height

STEPPERS = ("exponential", "ab3", "rk4")
SHOWN = ("exponential", "ab3")  # in figures; what rk4 differs by is not to be seen in one
STEPS = (0.5, 0.2, 0.1)  # s
LEAST_ERROR = 1e-3  # below it a difference of RMS says little of the order
REFERENCE_STEP = 0.05  # s, by rk4, whose error is some thousandth of that of any other level


@dataclass(frozen=True)
class TimeStep:
    """Three schemes at 0.1, 0.2 and 0.5 s against rk4 at 0.05 s, in seas of the limiting steepness."""

    base: Case
    scope: Scope
    key: str = "time-step"

    @cached_property
    def plans(self) -> dict[str, RmsPlan]:
        """A plan for each scheme; they share the runs of the reference."""
        return {stepper: self._plan(stepper) for stepper in STEPPERS}

    def _plan(self, stepper: str) -> RmsPlan:
        levels = [
            Level(f"{step:g} s", step, {"run.stepper": stepper, "run.time_step": step}) for step in STEPS
        ]
        exact = {"run.stepper": "rk4", "run.time_step": REFERENCE_STEP}
        return RmsPlan(
            self.base.changed({"run.duration": self.scope.duration}),
            f"Time step, {stepper}",
            "time step [s]",
            (*levels, Level(f"rk4 {REFERENCE_STEP:g} s", REFERENCE_STEP, exact)),
            len(STEPS),
            study_seas(self.scope.heights, LIMITING_STEEPNESS),
            self.scope.realizations,
        )

    @property
    def cases(self) -> Sequence[Case]:
        return [case for plan in self.plans.values() for case in plan.cases]

    def section(self, store: RunStore, folder: Path) -> Section:
        studies = {stepper: plan.read(store) for stepper, plan in self.plans.items()}
        pictures = [
            (
                rms_over_height(study, heading, folder / f"time_step_{stepper}_{heading:g}.png").name,
                f"RMS motions with the scheme {stepper}, wave heading {heading:g}°"
                f" (figure {10 if heading == STERN_QUARTERING else 11} of the report).",
            )
            for stepper, study in studies.items()
            for heading in HEADINGS_DEG
            if stepper in SHOWN
        ]
        last = len(self.plans["exponential"].seas) - 1
        return Section(
            self.key,
            "Time step (8.1)",
            "How long may a time step be?",
            f"Nonlinear runs on the medium mesh at 20 knots, nominal steepness {LIMITING_STEEPNESS:g}, steps"
            f" of 0.1, 0.2 and 0.5 s with each scheme; the reference is rk4 at {REFERENCE_STEP:g} s."
            + low_seas(self.base, self.scope.heights, LIMITING_STEEPNESS),
            "".join(f"### {stepper}\n\n{difference_markdown(study)}\n" for stepper, study in studies.items()),
            tuple(one for stepper, study in studies.items() for one in statements(stepper, study)),
            tuple(pictures),
            {f"time_step_{stepper}.csv": rms_csv(study) for stepper, study in studies.items()},
            tuple(studies.values()),
            {
                f"{stepper} {level.name}": plan.case(row, last, 0)
                for stepper, plan in self.plans.items()
                for row, level in enumerate(plan.levels[: len(STEPS)])
            },
            tuple(dict.fromkeys(failure for study in studies.values() for failure in study.failures)),
        )


def statements(stepper: str, study: RmsStudy) -> tuple[Statement, Statement]:
    """What the report says of 0.2 s and of 0.5 s, for a scheme."""
    half, fifth, tenth = (f"{step:g} s" for step in STEPS)
    near = against(study, tenth)
    alike = within(near, fifth, everywhere(study), IDENTICAL)
    apart = beyond(study, half, from_heading(study, BOW_QUARTERING), NOTICEABLE)
    stern = worst(study, half, from_heading(study, STERN_QUARTERING))
    return (
        Statement(
            f"{stepper}: 0.1 and 0.2 s give practically identical results (8.1)",
            alike.holds,
            alike.figure,
            ""
            if alike.holds
            else "; ".join(
                part for part in (where_it_counts(near, fifth, IDENTICAL), order(study, fifth, tenth)) if part
            ),
        ),
        Statement(
            f"{stepper}: 0.5 s gives noticeable differences in bow quartering seas (8.1)",
            apart.holds,
            apart.figure + ("" if stern is None else f"; in stern quartering seas {stern.told}"),
            where_it_counts(study, half, NOTICEABLE),
        ),
    )


def order(study: RmsStudy, longer: str, shorter: str) -> str:
    """By what the error falls from one step to the half of it: 8 for a scheme of third order."""
    errors = [np.abs(study.difference[study.levels.index(level)]) for level in (longer, shorter)]
    large = (errors[0] > LEAST_ERROR) & (errors[1] > 0.0)
    if not large.any():
        return ""
    factor = float(np.median(errors[0][large] / errors[1][large]))
    return (
        f"the error falls by a factor of {factor:.1f} (median) from {longer} to {shorter}, 8 being that"
        " of third order"
    )
