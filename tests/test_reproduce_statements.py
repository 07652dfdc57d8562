"""Verdicts on the sentences of TM 2003-190: each holds on made-up RMS, and each can flip."""

import re
import tomllib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from panelsim.case.template import case_template
from panelsim.conventions import Dof
from panelsim.hull.form import load_hull
from panelsim.results.rms_study import RmsStudy
from panelsim.studies.cost import CostRow
from panelsim.studies.tm2003_190 import reproduce
from panelsim.studies.tm2003_190.common import FULL, base_case, in_sea, low_seas, study_sea, study_seas
from panelsim.studies.tm2003_190.cost import TABLE_4, Cost, cost_statement, growth_told
from panelsim.studies.tm2003_190.judging import (
    Finding,
    beyond,
    both,
    everywhere,
    exceptions,
    where_it_counts,
    within,
    worst,
)
from panelsim.studies.tm2003_190.linear_nonlinear import LinearNonlinear, moderate_statement, steep_statement
from panelsim.studies.tm2003_190.mesh import Mesh
from panelsim.studies.tm2003_190.mesh import statements as mesh_statements
from panelsim.studies.tm2003_190.reproduce import reproduction
from panelsim.studies.tm2003_190.time_step import TimeStep
from panelsim.studies.tm2003_190.time_step import statements as step_statements

HEIGHTS = (2.0, 5.0)
LOW_STERN, HIGH_STERN, LOW_BOW, HIGH_BOW = range(4)
STEP_LEVELS = ("0.5 s", "0.2 s", "0.1 s", "rk4 0.05 s")
MESH_LEVELS = ("5 m²", "2.5 m²", "1 m²")
Change = tuple[str, int, int, float]  # level, sea, mode, difference


def made_up(
    levels: Sequence[str], reference: int, *changes: Change, heights: tuple[float, ...] = HEIGHTS
) -> RmsStudy:
    """A study of one realization in which all is alike but for these changes; sway is minor everywhere."""
    seas = study_seas(heights, 0.049)
    rms = np.ones((len(levels), len(seas), 1, 6))
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
        ([STEEP[0], ("nonlinear", HIGH_BOW, Dof.YAW, 0.09)], False),  # more than little, not significant
        ([*STEEP, ("nonlinear", HIGH_BOW, Dof.SURGE, -0.06)], False),
        ([*STEEP, ("nonlinear", HIGH_STERN, Dof.YAW, 0.06)], False),
    ],
)
def test_steep_seas(changes: list[Change], holds: bool) -> None:
    assert steep_statement(models(*changes), "").holds is holds


@pytest.mark.parametrize(("rolling", "holds"), [((3,), True), ((2, 3), False), ((2,), False)])
def test_roll_is_excepted_above_three_metres_only(rolling: tuple[int, ...], holds: bool) -> None:
    """Seas 2 and 3 are of 3 and 4 m, from the bow."""
    changes: list[Change] = [("nonlinear", sea, Dof.ROLL, 0.06) for sea in rolling]
    study = made_up(("linear", "nonlinear"), 0, *changes, heights=(3.0, 4.0))
    assert moderate_statement(study, "").holds is holds


def test_exceptions_and_their_cause_are_named() -> None:
    found = steep_statement(models(*STEEP, ("nonlinear", HIGH_BOW, Dof.SURGE, 2.3)), "slow drift")
    assert "+230 % in surge (H_s 5 m, T_p 8.1 s, 150°), not ≤ 5 %" in found.figures
    assert found.remark == "beyond 5 %: surge at 150° (5 m, up to +230 %); slow drift"
    study = models(*[("nonlinear", sea, Dof.PITCH, -0.07) for sea in (LOW_STERN, HIGH_STERN)])
    assert exceptions(study, "nonlinear", everywhere(study), 0.05) == (
        "beyond 5 %: pitch at 30° (2 to 5 m, up to -7 %)"
    )


def test_heights_that_do_not_differ_are_not_told_of() -> None:
    """1, 4 and 5 m of five heights: not "1 to 5 m"; seas 5 to 9 are from the bow."""
    changes: list[Change] = [("nonlinear", sea, Dof.PITCH, -0.07) for sea in (0, 3, 4, 7)]
    study = made_up(("linear", "nonlinear"), 0, *changes, heights=(1.0, 2.0, 3.0, 4.0, 5.0))
    assert exceptions(study, "nonlinear", everywhere(study), 0.05) == (
        "beyond 5 %: pitch at 30° (1, 4 to 5 m, up to -7 %), pitch at 150° (3 m, up to -7 %)"
    )


def test_a_run_that_failed_breaks_a_statement() -> None:
    study = steps()
    study.rms[1, HIGH_BOW, 0] = np.nan
    alike, apart = step_statements("ab3", study)
    assert not alike.holds
    assert "a run did not finish (H_s 5 m, T_p 8.1 s, 150°)" in alike.figures
    study.rms[0, LOW_BOW, 0] = np.nan
    _, apart = step_statements("ab3", study)
    assert not apart.holds


def test_a_reference_that_failed_breaks_a_statement_too() -> None:
    study = models()
    study.rms[0, HIGH_BOW] = np.nan
    for found in (moderate_statement(study, ""), steep_statement(study, "")):
        assert not found.holds
        assert "a run did not finish (H_s 5 m, T_p 8.1 s, 150°)" in found.figures
        assert "not known: H_s 5 m, T_p 8.1 s, 150°" in found.remark


def test_a_sea_with_a_run_that_failed_is_not_one_that_agrees() -> None:
    heights = (2.0, 5.0, 8.0)
    study = made_up(STEP_LEVELS, 3, ("0.2 s", 3, Dof.ROLL, 0.02), heights=heights)
    assert where_it_counts(study, "0.2 s", 0.01).startswith("none above 1 % in seas of 5 m and more; on")
    study.rms[1, 4] = np.nan  # 5 m, from the bow
    assert where_it_counts(study, "0.2 s", 0.01).startswith("none above 1 % in seas of 8 m and more; on")
    study.rms[3] = np.nan  # the reference everywhere
    assert where_it_counts(study, "0.2 s", 0.01) == ""


def test_the_highest_sea_with_a_difference_bounds_the_seas_without() -> None:
    changes: list[Change] = [("0.2 s", sea, Dof.ROLL, 0.02) for sea in (0, 1)]
    study = made_up(STEP_LEVELS, 3, *changes, heights=(2.0, 5.0, 8.0))
    assert where_it_counts(study, "0.2 s", 0.01).startswith("none above 1 % in seas of 8 m and more")


def test_what_a_figure_shows_is_over_the_largest_from_the_same_heading() -> None:
    study = steps(("0.2 s", LOW_BOW, Dof.ROLL, 0.02))
    study.rms[:, HIGH_BOW] *= 2.0
    study.rms[:, HIGH_STERN] *= 8.0
    assert where_it_counts(study, "0.2 s", 0.01).endswith("on the axes of the report's figures it is 1 %")


@pytest.mark.parametrize(("size", "counts"), [(0.051, True), (0.049, False)])
def test_a_motion_counts_from_a_twentieth_of_the_largest_on(size: float, counts: bool) -> None:
    study = steps(("0.2 s", LOW_BOW, Dof.HEAVE, 0.5))
    study.rms[:, :, :, Dof.HEAVE] *= size
    alike, _ = step_statements("ab3", study)
    assert alike.holds is not counts


def in_realizations(*changes: tuple[int, Sequence[float]], sea: int = HIGH_BOW) -> RmsStudy:
    """Models whose nonlinear RMS has these differences in a sea, one a realization; the rest is alike."""
    study = models()
    rms = np.repeat(study.rms, len(changes[0][1]), axis=2)
    for mode, differences in changes:
        rms[1, sea, :, mode] = 1.0 + np.array(differences)
    return replace(study, rms=rms)


@pytest.mark.parametrize(
    ("differences", "threshold", "chance"),
    [
        ((0.09, 0.10, 0.11), 0.05, False),  # 10 ± 2.5 %
        ((0.06, 0.10, 0.14), 0.05, True),  # 10 ± 9.9 %
        ((0.06, 0.10, 0.14), 0.21, False),
        ((0.06, 0.10, 0.14), 0.19, True),
        ((-0.06, -0.10, -0.14), 0.05, True),
        ((0.10,), 0.099, False),  # of one realization nothing is known
    ],
)
def test_a_verdict_within_its_band_says_so(
    differences: tuple[float, ...], threshold: float, chance: bool
) -> None:
    """Half width: Student's 4.30 for three, over √3, times 1 or 4 %."""
    study = in_realizations((Dof.ROLL, differences))
    for judge in (within, beyond):
        found = judge(study, "nonlinear", everywhere(study), threshold)
        assert ("(within the band of chance)" in found.figure) is chance, found.figure
    # Signs, means of squares and the root of their ratio: 10 % is 10.0 or 10.1 %.
    assert abs(worst(study, "nonlinear", everywhere(study)).amount) == pytest.approx(0.1, abs=0.002)  # type: ignore[union-attr]


@pytest.mark.parametrize(("scatter", "chance"), [(0.01, False), (0.04, True)])
def test_an_exception_within_its_band_is_told(scatter: float, chance: bool) -> None:
    """10 % with half widths of 2.5 and of 9.9 %."""
    study = in_realizations((Dof.ROLL, (0.1 - scatter, 0.1, 0.1 + scatter)))
    found = exceptions(study, "nonlinear", everywhere(study), 0.05)
    assert found.startswith("beyond 5 %: roll at 150° (5 m, up to +10 ± ")
    assert found.endswith("within the band of chance)") is chance


def test_another_motion_than_the_worst_may_reach_over_the_threshold() -> None:
    study = in_realizations((Dof.ROLL, (0.045, 0.045, 0.045)), (Dof.YAW, (0.0, 0.03, 0.06)))
    figure = within(study, "nonlinear", everywhere(study), 0.05).figure
    assert "+4.5 ± " in figure
    assert "(within the band of chance, which reaches over it: +3 ± 7.5 % in yaw (H_s 5 m" in figure
    # With one that is surely beyond, the verdict is sure.
    study = in_realizations((Dof.ROLL, (0.06, 0.06, 0.06)), (Dof.YAW, (0.0, 0.07, 0.14)))
    assert "chance" not in within(study, "nonlinear", everywhere(study), 0.05).figure


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
    all_below = cost_statement([*rows[1:], timed(19, 0.254 / 240, 0.254 / 245, 0.254 / 249)])
    assert not all_below.holds and not all_below.remark


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


def test_the_default_step_is_that_of_a_new_case() -> None:
    new = tomllib.loads(case_template(load_hull("halifax"), "halifax"))["run"]["time_step"]
    base = base_case()
    cost = Cost(base, 120.0, 3)
    assert {case.file.run.time_step for case in cost.of_default_step.values()} == {new} != {0.2}
    assert {case.file.run.time_step for case in cost.of_table.values()} == {0.2}


def test_a_realization_has_the_same_phases_in_every_study_and_from_each_heading() -> None:
    base = base_case()
    bow, stern = (in_sea(base, study_sea(heading, 5.0, 0.049), 1) for heading in (150.0, 30.0))
    steeper = in_sea(base.changed({"run.time_step": 0.5}), study_sea(150.0, 5.0, 0.021), 1)
    other = in_sea(base, study_sea(150.0, 5.0, 0.049), 2)
    phases = [case.seaway.components.phase for case in (bow, stern, steeper, other)]
    np.testing.assert_array_equal(phases[0], phases[1])
    np.testing.assert_array_equal(phases[0], phases[2])
    assert not np.allclose(phases[0], phases[3])


def test_levels_and_references_are_those_that_the_page_tells() -> None:
    base = base_case()
    steps_of = TimeStep(base, FULL).plans
    for stepper, plan in steps_of.items():
        runs = [plan.case(level, 0, 0).file.run for level in range(4)]
        assert [run.time_step for run in runs] == [0.5, 0.2, 0.1, 0.05]
        assert [run.stepper for run in runs] == [stepper, stepper, stepper, "rk4"]
        assert plan.reference == 3
    cut, whole = Mesh(base, FULL).plans.values()
    for plan, rules in ((cut, ["vertex+centre"] * 3), (whole, ["panel"] * 3 + ["vertex+centre"])):
        cases = [plan.case(level, 0, 0).file for level in range(len(plan.levels))]
        assert [case.run.pressure_rule for case in cases] == rules
        assert [case.ship.panel_area for case in cases][:3] == [5.0, 2.5, 1.0]
        assert cases[plan.reference].ship.panel_area == 1.0
        assert cases[plan.reference].run.pressure_rule == "vertex+centre"
    models_of = LinearNonlinear(base, FULL).plans
    # TM 2003-190 (56) with 0.021 and 0.049, a sea of 7 m.
    for name, period in (("moderate", 14.614), ("limiting", 9.567)):
        (sea,) = {one.peak_period for one in models_of[name].seas if one.significant_wave_height == 7.0}
        assert sea == pytest.approx(period, abs=0.0005)
        assert [models_of[name].case(i, 0, 0).file.run.model for i in range(2)] == ["linear", "nonlinear"]
    for plan in (*steps_of.values(), cut, whole):
        assert {one.peak_period for one in plan.seas if one.significant_wave_height == 7.0} == {sea}


def test_seeds_are_those_that_the_page_tells() -> None:
    told = reproduce._seeds(FULL)
    assert "1000 times the height in metres plus the number of the realization" in told
    assert "the same in all studies" not in told
    with_seeds = reproduction(quick=True, runs=Path("none")).studies
    for study in with_seeds:
        if study.key in ("time-step", "mesh", "linear-nonlinear", "stretching", "statistics"):
            for case in study.cases:
                sea = case.file.seaway
                if sea.kind == "random":
                    assert sea.significant_wave_height is not None
                    assert 1 <= sea.seed - 1000.0 * sea.significant_wave_height <= 10


def test_seas_that_are_lower_than_called_are_told() -> None:
    base = base_case()
    told = low_seas(base, (1.0, 2.0, 3.0), 0.049)
    # By the integral of the Bretschneider spectrum up to 2.0 rad/s, exp(-1.25 (ω_p/ω)⁴), and the grid's end.
    for height in (1.0, 2.0):
        omega_p = np.sqrt(2.0 * np.pi * 9.80665 * 0.049 / height)
        share = np.exp(-1.25 * (omega_p / 2.05) ** 4)
        (said,) = re.findall(rf"H_s {height:g} m at steepness 0.049 has (\d+) % of its energy", told)
        assert float(said) == pytest.approx(100.0 * share, abs=3.0)
    assert "is 0.72 m high" in told
    assert "H_s 3 m" not in told
    assert low_seas(base, (3.0,), 0.049) == ""


def test_the_peak_period_is_that_of_the_nominal_steepness() -> None:
    # TM 2003-190 (56): s = 2π H_s / (g T_p²)
    sea = study_sea(150.0, 7.5, 0.049)
    assert sea.peak_period is not None
    assert 2.0 * np.pi * 7.5 / (9.80665 * sea.peak_period**2) == pytest.approx(0.049, rel=1e-12)
