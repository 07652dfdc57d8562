"""Verdicts on the sentences of TM 2003-190: each holds on made-up RMS, and each can flip."""

from collections.abc import Sequence

import numpy as np
import pytest

from panelsim.conventions import Dof
from panelsim.results.rms_study import RmsStudy
from panelsim.studies.cost import CostRow
from panelsim.studies.tm2003_190.common import base_case, in_sea, study_sea, study_seas
from panelsim.studies.tm2003_190.cost import TABLE_4, Cost, cost_statement, growth_told
from panelsim.studies.tm2003_190.judging import Finding, both, everywhere, exceptions, worst
from panelsim.studies.tm2003_190.linear_nonlinear import moderate_statement, steep_statement
from panelsim.studies.tm2003_190.mesh import statements as mesh_statements
from panelsim.studies.tm2003_190.time_step import statements as step_statements

HEIGHTS = (2.0, 5.0)
LOW_STERN, HIGH_STERN, LOW_BOW, HIGH_BOW = range(4)
STEP_LEVELS = ("0.5 s", "0.2 s", "0.1 s", "rk4 0.05 s")
MESH_LEVELS = ("5 m²", "2.5 m²", "1 m²")
Change = tuple[str, int, int, float]  # level, sea, mode, difference


def made_up(levels: Sequence[str], reference: int, *changes: Change) -> RmsStudy:
    """A study in which all is alike but for these changes; sway is minor everywhere."""
    seas = study_seas(HEIGHTS, 0.049)
    rms = np.ones((len(levels), len(seas), 2, 6))
    rms[..., Dof.SWAY] = 0.04  # below 5 % of the others
    for level, sea, mode, difference in changes:
        rms[list(levels).index(level), sea, :, mode] *= 1.0 + difference
    return RmsStudy("", "", tuple(levels), np.arange(float(len(levels))), reference, seas, rms)


def steps(*changes: Change) -> RmsStudy:
    return made_up(STEP_LEVELS, 3, *changes)


def meshes(*changes: Change) -> RmsStudy:
    return made_up(MESH_LEVELS, 2, *changes)


def models(*changes: Change) -> RmsStudy:
    return made_up(("linear", "nonlinear"), 0, *changes)


@pytest.mark.parametrize(
    ("change", "holds"),
    [
        (("0.2 s", LOW_BOW, Dof.ROLL, 0.009), True),
        (("0.2 s", LOW_BOW, Dof.ROLL, -0.009), True),
        (("0.2 s", LOW_BOW, Dof.ROLL, 0.011), False),
        (("0.2 s", HIGH_STERN, Dof.HEAVE, -0.011), False),
        (("0.1 s", HIGH_STERN, Dof.HEAVE, 0.011), False),  # the two are compared, not each with the reference
        (("0.5 s", LOW_BOW, Dof.ROLL, 0.5), True),
        (("0.2 s", LOW_BOW, Dof.SWAY, 0.5), True),  # minor
    ],
)
def test_steps_are_alike_up_to_one_per_cent(change: Change, holds: bool) -> None:
    alike, _ = step_statements("ab3", steps(change))
    assert alike.holds is holds


def test_steps_that_are_off_by_the_same_are_alike() -> None:
    off = [(level, LOW_BOW, Dof.ROLL, 0.05) for level in ("0.1 s", "0.2 s")]
    alike, _ = step_statements("ab3", steps(*off))
    assert alike.holds


@pytest.mark.parametrize(
    ("sea", "difference", "holds"),
    [(LOW_BOW, 0.021, True), (HIGH_BOW, -0.021, True), (HIGH_BOW, 0.019, False), (HIGH_STERN, 0.5, False)],
)
def test_half_a_second_is_noticed_in_bow_quartering_seas(sea: int, difference: float, holds: bool) -> None:
    _, apart = step_statements("ab3", steps(("0.5 s", sea, Dof.YAW, difference)))
    assert apart.holds is holds
    if sea == HIGH_STERN:
        assert "in stern quartering seas +50 % in yaw (H_s 5 m, T_p 8.1 s, 30°)" in apart.figures
    else:
        assert f"{100 * difference:+.2g} % in yaw" in apart.figures


def test_the_order_of_a_scheme_is_told_where_its_steps_differ() -> None:
    alike, _ = step_statements("ab3", steps(("0.2 s", 0, 0, 0.016), ("0.1 s", 0, 0, 0.002)))
    assert "a factor of 8.0" in alike.remark


@pytest.mark.parametrize(
    ("medium", "coarse", "holds"),
    [
        (0.009, 0.03, (True, True)),
        (-0.011, 0.03, (False, True)),
        (0.0, -0.049, (True, True)),
        (0.0, 0.051, (True, False)),
        (0.0, 0.009, (True, False)),  # identical is not slightly different
    ],
)
def test_meshes(medium: float, coarse: float, holds: tuple[bool, bool]) -> None:
    study = meshes(("2.5 m²", LOW_BOW, Dof.ROLL, medium), ("5 m²", HIGH_STERN, Dof.PITCH, coarse))
    found = mesh_statements("cut panels", study)
    assert tuple(statement.holds for statement in found) == holds
    assert f"{100 * coarse:+.2g} % in pitch (H_s 5 m, T_p 8.1 s, 30°)" in found[1].figures


def test_whole_panels_are_judged_against_the_fine_mesh_of_whole_panels() -> None:
    levels = (*MESH_LEVELS, "1 m² cut")
    all_off = [(level, LOW_BOW, Dof.ROLL, 0.2) for level in MESH_LEVELS]
    medium, _ = mesh_statements("whole panels", made_up(levels, 3, *all_off))
    assert medium.holds


ROLL = ("nonlinear", HIGH_BOW, int(Dof.ROLL), 0.06)


@pytest.mark.parametrize(
    ("changes", "holds"),
    [
        ([ROLL], True),
        ([("nonlinear", HIGH_BOW, Dof.ROLL, 0.04)], False),  # no influence where the report sees some
        ([ROLL, ("nonlinear", LOW_BOW, Dof.ROLL, 0.06)], False),  # 2 m is not above 3 m
        ([ROLL, ("nonlinear", HIGH_STERN, Dof.ROLL, -0.06)], False),
        ([ROLL, ("nonlinear", HIGH_BOW, Dof.YAW, 0.06)], False),
        ([ROLL, ("nonlinear", LOW_STERN, Dof.HEAVE, 0.049)], True),
    ],
)
def test_moderate_steepness(changes: list[Change], holds: bool) -> None:
    assert moderate_statement(models(*changes), "").holds is holds


STEEP = [("nonlinear", HIGH_BOW, int(mode), 0.11) for mode in (Dof.ROLL, Dof.YAW)]


@pytest.mark.parametrize(
    ("changes", "holds"),
    [
        (STEEP, True),
        ([*STEEP, ("nonlinear", LOW_BOW, Dof.YAW, 0.5)], True),
        (STEEP[:1], False),
        (STEEP[1:], False),
        ([("nonlinear", HIGH_BOW, Dof.ROLL, 0.09), STEEP[1]], False),
        ([*STEEP, ("nonlinear", HIGH_BOW, Dof.SURGE, -0.06)], False),
        ([*STEEP, ("nonlinear", HIGH_STERN, Dof.YAW, 0.06)], False),
    ],
)
def test_steep_seas(changes: list[Change], holds: bool) -> None:
    assert steep_statement(models(*changes), "").holds is holds


def test_exceptions_and_their_cause_are_named() -> None:
    found = steep_statement(models(*STEEP, ("nonlinear", HIGH_BOW, Dof.SURGE, 2.3)), "slow drift")
    assert "+230 % in surge (H_s 5 m, T_p 8.1 s, 150°), not ≤ 5 %" in found.figures
    assert found.remark == "beyond 5 %: surge at 150° (5 m, up to 230 %); slow drift"
    study = models(*[("nonlinear", sea, Dof.PITCH, -0.07) for sea in (LOW_STERN, HIGH_STERN)])
    assert exceptions(study, "nonlinear", everywhere(study), 0.05) == (
        "beyond 5 %: pitch at 30° (2 to 5 m, up to 7 %)"
    )


def test_a_run_that_failed_breaks_a_statement() -> None:
    study = steps()
    study.rms[1, HIGH_BOW, 1] = np.nan
    alike, apart = step_statements("ab3", study)
    assert not alike.holds
    assert "a run did not finish (H_s 5 m, T_p 8.1 s, 150°)" in alike.figures
    study.rms[0, LOW_BOW, 0] = np.nan
    _, apart = step_statements("ab3", study)
    assert not apart.holds


def test_minor_motions_alone_are_no_finding() -> None:
    study = steps(("0.2 s", 0, Dof.SWAY, 0.5))
    only_sway = everywhere(study) & (np.arange(6) == Dof.SWAY)
    assert worst(study, "0.2 s", only_sway) is None


def test_both_halves_have_to_hold() -> None:
    yes, no = Finding(True, "yes"), Finding(False, "no")
    assert both(yes, yes).holds
    assert not both(yes, no).holds
    assert not both(no, yes).holds
    assert both(yes, no).figure == "yes; no"


@pytest.mark.parametrize(("slow", "holds"), [(1.0, True), (1.01, False), (np.nan, False)])
def test_cost_has_to_be_a_250th_at_every_number_of_components(slow: float, holds: bool) -> None:
    rows = []
    for count in (19, 37, 160):
        for model in ("linear", "nonlinear"):
            cost = TABLE_4[model][count] / 250.0 * (slow if count == 160 else 0.99)
            rounds = () if np.isnan(cost) else (cost,)
            rows.append(CostRow("", model, count, 2596, rounds, 1.0, None if rounds else "failed"))
    # Rows are known by their components, not by their order.
    found = cost_statement(rows[::-1])
    assert found.holds is holds
    assert "253 times at 19" in found.figures
    assert ("could not be timed" in found.remark) == np.isnan(slow)
    assert not cost_statement(rows[:-1]).holds


def timed(components: int, *rounds: float, panels: int = 2596) -> CostRow:
    return CostRow("", "nonlinear", components, panels, rounds, 1.0)


def test_the_range_of_the_rounds_is_told() -> None:
    rows = [timed(19, 0.254 / 247, 0.254 / 255, 0.254 / 260), timed(37, 0.001), timed(160, 0.004)]
    found = cost_statement(rows)
    assert found.holds
    assert found.figures.startswith("255 times (247 to 260) at 19, 435 times at 37, 409 times at 160;")
    assert found.remark == "At 19 the rounds lie on both sides of it."
    assert not cost_statement([*rows[1:], timed(19, 0.254 / 247, 0.254 / 249, 0.254 / 260)]).holds


def test_growth_is_told_from_each_size_to_the_next() -> None:
    table = [timed(19, 1e-3), timed(37, 1.1e-3), timed(160, 2.2e-3)]
    meshes = [timed(19, 4e-3, panels=4000), timed(19, 1e-3, panels=1000), timed(19, 2e-3, panels=2000)]
    told = growth_told(table, meshes)
    assert "2.00 times from 1000 to 2000 panels (power 1.00), 2.00 times from 2000 to 4000" in told
    assert "1.10 times from 19 to 37 components, 2.00 times from 37 to 160 components." in told
    failed = CostRow("", "nonlinear", 0, 0, (), np.nan, "failed")
    assert "2.20 times from 19 to 160" in growth_told([table[0], failed, table[2]], [])


def test_the_runs_that_are_timed_are_those_of_table_4() -> None:
    study = Cost(base_case(), 120.0, 3)
    counts = [(case.file.run.model, case.seaway.components.count) for case in study.of_table.values()]
    assert counts == [(model, count) for count in (19, 37, 160) for model in ("linear", "nonlinear")]
    # TM 2003-190, Table 4.
    assert list(TABLE_4["linear"].items()) == [(19, 0.019), (37, 0.027), (160, 0.084)]
    assert list(TABLE_4["nonlinear"].items()) == [(19, 0.254), (37, 0.435), (160, 1.636)]


def test_a_realization_has_the_same_phases_in_every_study_and_from_each_heading() -> None:
    base = base_case()
    bow, stern = (in_sea(base, study_sea(heading, 5.0, 0.049), 1) for heading in (150.0, 30.0))
    steeper = in_sea(base.changed({"run.time_step": 0.5}), study_sea(150.0, 5.0, 0.021), 1)
    other = in_sea(base, study_sea(150.0, 5.0, 0.049), 2)
    phases = [case.seaway.components.phase for case in (bow, stern, steeper, other)]
    np.testing.assert_array_equal(phases[0], phases[1])
    np.testing.assert_array_equal(phases[0], phases[2])
    assert not np.allclose(phases[0], phases[3])


def test_the_peak_period_is_that_of_the_nominal_steepness() -> None:
    # TM 2003-190 (56): s = 2π H_s / (g T_p²)
    sea = study_sea(150.0, 7.5, 0.049)
    assert sea.peak_period is not None
    assert 2.0 * np.pi * 7.5 / (9.80665 * sea.peak_period**2) == pytest.approx(0.049, rel=1e-12)
