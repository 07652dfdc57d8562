"""TM 2003-190 section 8.2: how fine a mesh has to be, with cut and with whole panels; figures 12 and 13."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.conventions import DOF_NAMES
from panelsim.results.rms_study import RmsStudy
from panelsim.results.rms_tables import difference_markdown, rms_csv
from panelsim.results.verdicts import IDENTICAL, SLIGHT, WorstDifference
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.common import (
    HEADINGS_DEG,
    LIMITING_STEEPNESS,
    STERN_QUARTERING,
    Scope,
    low_seas,
    study_seas,
)
from panelsim.studies.tm2003_190.judging import (
    Finding,
    against,
    beyond,
    both,
    by_chance,
    everywhere,
    where_it_counts,
    within,
    worst,
)
from panelsim.studies.tm2003_190.model_causes import Pair, frequencies_of
from panelsim.studies.tm2003_190.rms_plan import Level, RmsPlan
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.view.rms_pictures import rms_over_height

PANEL_AREAS = (5.0, 2.5, 1.0)  # m2: coarse, medium, fine, Table 3
COARSE, MEDIUM, FINE = (f"{area:g} m²" for area in PANEL_AREAS)
CUT, WHOLE = "cut panels", "whole panels"
RULES = {CUT: "vertex+centre", WHOLE: "panel"}


@dataclass(frozen=True)
class Mesh:
    """Three meshes, with panels cut at the water and whole, against the fine mesh."""

    base: Case
    scope: Scope
    key: str = "mesh"

    @cached_property
    def plans(self) -> dict[str, RmsPlan]:
        """A plan for each way of wetting, by its name."""
        return {wetting: self._plan(wetting) for wetting in RULES}

    def _plan(self, wetting: str) -> RmsPlan:
        """Three meshes; the fine one of cut panels, which has the smaller error, is the reference of both."""
        levels = [
            Level(f"{area:g} m²", area, {"ship.panel_area": area, "run.pressure_rule": RULES[wetting]})
            for area in PANEL_AREAS
        ]
        if wetting == WHOLE:
            finest = {"ship.panel_area": PANEL_AREAS[-1], "run.pressure_rule": RULES[CUT]}
            levels.append(Level(f"{FINE} cut", PANEL_AREAS[-1], finest))
        return RmsPlan(
            self.base.changed({"run.duration": self.scope.duration}),
            f"Mesh, {wetting}",
            "panel area [m²]",
            tuple(levels),
            len(levels) - 1,
            study_seas(self.scope.heights, LIMITING_STEEPNESS),
            self.scope.realizations,
        )

    @property
    def cases(self) -> Sequence[Case]:
        return [case for plan in self.plans.values() for case in plan.cases]

    def section(self, store: RunStore, folder: Path) -> Section:
        studies = {wetting: plan.read(store) for wetting, plan in self.plans.items()}
        return Section(
            self.key,
            "Mesh (8.2)",
            "How fine does the mesh have to be, and what does it bring to cut the panels at the water?",
            f"Nonlinear runs at 20 knots, nominal steepness {LIMITING_STEEPNESS:g}, step 0.2 s, panels of"
            " 5, 2.5 and 1 m². Cut panels: the pressure at corners and centres of what is under water, the"
            " default here. Whole panels: as in the report, wet or dry by their centres, the pressure there."
            " The reference is the fine mesh of cut panels; the statements compare meshes of one kind."
            + low_seas(self.base, self.scope.heights, LIMITING_STEEPNESS),
            "".join(
                f"### {wetting.capitalize()}\n\n{difference_markdown(study)}\n"
                for wetting, study in studies.items()
            ),
            tuple(
                self._with_cause(one, wetting, level, studies, store)
                for wetting in studies
                for level, one in zip((MEDIUM, COARSE), statements(wetting, studies[wetting]), strict=True)
            ),
            tuple(
                (
                    rms_over_height(
                        study, heading, folder / f"mesh_{wetting.split()[0]}_{heading:g}.png"
                    ).name,
                    f"RMS motions with {wetting}, wave heading {heading:g}°"
                    f" (figure {12 if heading == STERN_QUARTERING else 13} of the report).",
                )
                for wetting, study in studies.items()
                for heading in HEADINGS_DEG
            ),
            {f"mesh_{wetting.split()[0]}.csv": rms_csv(study) for wetting, study in studies.items()},
            tuple(studies.values()),
            {
                f"{wetting} {level.name}": plan.case(row, len(plan.seas) - 1, 0)
                for wetting, plan in self.plans.items()
                for row, level in enumerate(plan.levels[: len(PANEL_AREAS)])
            },
            tuple(dict.fromkeys(failure for study in studies.values() for failure in study.failures)),
        )

    def _with_cause(
        self,
        statement: Statement,
        wetting: str,
        level: str,
        studies: Mapping[str, RmsStudy],
        store: RunStore,
    ) -> Statement:
        """A statement of a mesh that does not hold, with what the runs say of why."""
        own = against(studies[wetting], FINE)
        found = worst(own, level, everywhere(own))
        if statement.holds or found is None or np.isnan(found.amount):
            return statement
        if wetting == WHOLE:
            cut = worst(against(studies[CUT], FINE), level, everywhere(own))
            cause = "" if cut is None else f"with panels cut at the water the same mesh is at most {cut.told}"
        else:
            cause = self._second_order(found, level, store)
        return replace(statement, remark="; ".join(part for part in (statement.remark, cause) if part))

    def _second_order(self, found: WorstDifference, level: str, store: RunStore) -> str:
        """How far the worst motion is off at the frequencies of the waves; how much of it is elsewhere."""
        plan, mode = self.plans[CUT], DOF_NAMES.index(found.mode)
        sea = plan.seas.index(found.sea)
        rows = [[one.name for one in plan.levels].index(name) for name in (FINE, level)]
        fine, coarser = (plan.case(row, sea, 0) for row in rows)
        frequencies = frequencies_of([Pair(found.sea.label, fine, coarser)], store)
        if not frequencies.seas:
            return ""
        off, elsewhere = 100 * frequencies.change[0, mode], 100 * frequencies.elsewhere[0, mode]
        return (
            f"at the frequencies of the waves themselves {found.mode} is {off:+.2g} % off there, first"
            f" realization; {elsewhere:.0f} % of its variance is at others, where linear ones have hardly any"
        )


def statements(wetting: str, study: RmsStudy) -> tuple[Statement, Statement]:
    """What the report says of the medium and of the coarse mesh, each against the fine one of its kind."""
    own = against(study, FINE)
    all_of_it = everywhere(own)
    medium = within(own, MEDIUM, all_of_it, IDENTICAL)
    coarse = both(beyond(own, COARSE, all_of_it, IDENTICAL), within(own, COARSE, all_of_it, SLIGHT))
    return (
        Statement(
            f"{wetting}: medium and fine mesh give effectively identical results (8.2)",
            medium.holds,
            medium.figure,
            "" if medium.holds else where_it_counts(own, MEDIUM, IDENTICAL),
        ),
        Statement(
            f"{wetting}: the coarse mesh gives slightly different results (8.2)",
            coarse.holds,
            _one_figure(own, coarse),
            "" if coarse.holds else where_it_counts(own, COARSE, SLIGHT),
        ),
    )


def _one_figure(study: RmsStudy, finding: Finding) -> str:
    """The difference once, beside both bounds."""
    found = worst(study, COARSE, everywhere(study))
    if found is None or np.isnan(found.amount):
        return finding.figure
    chance = [by_chance(study, COARSE, everywhere(study), bound) for bound in (IDENTICAL, SLIGHT)]
    bounds = f"{'' if finding.holds else 'not '}in {100 * IDENTICAL:g} to {100 * SLIGHT:g} %"
    return f"{found.told}, {bounds}{max(chance)}"
