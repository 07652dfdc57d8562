"""TM 2003-190 section 8.3: what nonlinear buoyancy and incident waves change; figures 14 to 17."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

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
    study_seas,
)
from panelsim.studies.tm2003_190.judging import (
    beyond,
    both,
    everywhere,
    exceptions,
    of_modes,
    within,
)
from panelsim.studies.tm2003_190.rms_plan import Level, RmsPlan
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.view.rms_pictures import rms_over_height

LINEAR, NONLINEAR = "linear", "nonlinear"
STEEPNESS = {"moderate": TYPICAL_STEEPNESS, "limiting": LIMITING_STEEPNESS}
FIGURES = {"moderate": (14, 15), "limiting": (16, 17)}  # of the report, at 30° and at 150°
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
                1,
                study_seas(self.scope.heights, steepness),
                self.scope.model_realizations,
            )
            for name, steepness in STEEPNESS.items()
        }

    @property
    def cases(self) -> Sequence[Case]:
        return [case for plan in self.plans.values() for case in plan.cases]

    def section(self, store: RunStore, folder: Path) -> Section:
        studies = {name: plan.read(store) for name, plan in self.plans.items()}
        return Section(
            self.key,
            "Linear against nonlinear (8.3)",
            "When do nonlinear buoyancy and incident waves change the motions?",
            "Linear and nonlinear runs in the same waves, medium mesh, 20 knots, step 0.2 s, at nominal"
            f" steepness {TYPICAL_STEEPNESS:g} and {LIMITING_STEEPNESS:g}.",
            "".join(
                f"### Steepness {STEEPNESS[name]:g}\n\n{difference_markdown(study)}\n"
                for name, study in studies.items()
            ),
            (moderate_statement(studies["moderate"]), steep_statement(studies["limiting"])),
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
            tuple(failure for study in studies.values() for failure in study.failures),
        )


def moderate_statement(study: RmsStudy) -> Statement:
    """Little influence, but for roll in bow quartering seas above 3 m."""
    roll = of_modes(study, Dof.ROLL, wave_heading_deg=BOW_QUARTERING, above=ROLL_FROM)
    found = both(
        within(study, LINEAR, everywhere(study) & ~roll, SLIGHT, "the rest: "),
        beyond(study, LINEAR, roll, SLIGHT, "roll in bow quartering seas: "),
    )
    return Statement(
        "In moderate steepness nonlinearities have little influence, but for roll in bow quartering seas above"
        " 3 m (8.3)",
        found.holds,
        found.figure,
        "" if found.holds else exceptions(study, LINEAR, everywhere(study) & ~roll, SLIGHT),
    )


def steep_statement(study: RmsStudy) -> Statement:
    """Little influence, but significant on roll and yaw in bow quartering seas."""
    roll, yaw = (of_modes(study, mode, wave_heading_deg=BOW_QUARTERING) for mode in (Dof.ROLL, Dof.YAW))
    found = both(
        within(study, LINEAR, everywhere(study) & ~roll & ~yaw, SLIGHT, "the rest: "),
        beyond(study, LINEAR, roll, SIGNIFICANT, "roll in bow quartering seas: "),
        beyond(study, LINEAR, yaw, SIGNIFICANT, "yaw there: "),
    )
    return Statement(
        "In steep seas nonlinearities have little influence, but a significant one on roll and yaw in bow"
        " quartering seas (8.3, 10)",
        found.holds,
        found.figure,
        "" if found.holds else exceptions(study, LINEAR, everywhere(study) & ~roll & ~yaw, SLIGHT),
    )
