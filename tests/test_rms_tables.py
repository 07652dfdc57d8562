"""Tables, verdicts, orders and bands of made-up studies whose answers are known."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.results.convergence_order import convergence_order
from panelsim.results.difference_band import difference_band
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.results.rms_tables import difference_markdown, rms_csv, rms_markdown
from panelsim.results.verdicts import from_heading, words, worst_difference

# Sway and roll are below 5 % of the largest of their kind.
BASE = np.array([0.5, 0.02, 1.0, 0.001, 0.04, 0.03])  # m, rad
SEAS = (StudySea("low, 30°", 30.0, 2.0, 8.0), StudySea("high, 150°", 150.0, 4.0, 9.0))


def made_up(factors: FloatArray, values: FloatArray, reference: int) -> RmsStudy:
    """A study of one realization whose RMS are BASE times `factors` (L,), of the second sea twice that."""
    sea = np.array([1.0, 2.0])[:, None, None]
    rms = np.asarray(factors)[:, None, None, None] * sea * BASE
    levels = tuple(f"level {i}" for i in range(len(values)))
    return RmsStudy("Made up", "step [s]", levels, np.asarray(values), reference, SEAS, rms)


@pytest.mark.parametrize(
    ("difference", "told"),
    [
        (0.0, "practically identical"),
        (-0.01, "practically identical"),
        (0.015, "slightly different, of little influence"),
        (0.02, "slightly different, of little influence"),
        (-0.03, "slightly different, of little influence, noticeable"),
        (0.05, "slightly different, of little influence, noticeable"),
        (-0.07, "noticeable"),
        (0.10, "noticeable"),
        (-0.11, "noticeable, significant"),
        (np.nan, "not known"),
    ],
)
def test_every_class_that_a_difference_belongs_to_is_told(difference: float, told: str) -> None:
    assert words(difference) == told


def test_the_worst_difference_has_its_sign_mode_and_sea_and_passes_over_minor_modes() -> None:
    study = made_up([1.0, 1.01], [0.1, 0.2], reference=0)
    study.rms[1, 1, 0, 4] *= 0.9  # pitch of the second sea
    study.rms[1, 0, 0, 1] *= 5.0  # sway, which is minor
    worst = worst_difference(study, 1)
    # exact but for rounding: 1.01 times 0.9
    assert worst.amount == pytest.approx(1.01 * 0.9 - 1.0, rel=1e-12)
    assert (worst.mode, worst.sea) == ("pitch", SEAS[1])
    assert worst.told == "-9.1 % in pitch (high, 150°)"
    assert worst_difference(study, 1, from_heading(study, 30.0)).amount == pytest.approx(0.01, rel=1e-12)


def test_a_run_that_failed_is_the_worst_of_all() -> None:
    study = made_up([1.0, 1.2], [0.1, 0.2], reference=0)
    study.rms[1, 0] = np.nan
    assert np.isnan(worst_difference(study, 1).amount)
    assert worst_difference(study, 1, from_heading(study, 150.0)).amount == pytest.approx(0.2, rel=1e-12)
    assert "a run did not finish (low, 30°) | not known" in difference_markdown(study)
    study = made_up([1.0, 1.2], [0.1, 0.2], reference=0)
    study.rms[0, 1] = np.nan  # that of the reference
    assert np.isnan(worst_difference(study, 1).amount)
    assert worst_difference(study, 1, from_heading(study, 30.0)).amount == pytest.approx(0.2, rel=1e-12)


def test_csv_gives_back_every_run_in_metres_and_degrees_with_units_in_the_header() -> None:
    study = made_up([1.0, 1.25], [0.1, 0.2], reference=0)
    study.rms[0, 1] = np.nan
    rows = list(csv.DictReader(io.StringIO(rms_csv(study))))
    assert len(rows) == 4
    assert [row["level"] for row in rows] == ["level 0", "level 0", "level 1", "level 1"]
    first, failed, _, last = rows
    assert (float(last["step [s]"]), last["sea"], last["realization"]) == (0.2, "high, 150°", "1")
    assert float(last["significant_wave_height [m]"]) == 4.0 and float(last["peak_period [s]"]) == 9.0
    assert float(last["heave_rms [m]"]) == study.rms[1, 1, 0, 2]
    # the same factor, so the same bits but for the order of two products
    assert float(last["pitch_rms [deg]"]) == pytest.approx(np.rad2deg(study.rms[1, 1, 0, 4]), rel=1e-15)
    assert float(first["wave_heading [deg]"]) == 30.0
    assert failed["surge_rms [m]"] == ""
    models = csv.DictReader(io.StringIO(rms_csv(replace(study, varied="model"))))
    assert models.fieldnames is not None and "model" not in models.fieldnames
    assert [row["heave_rms [m]"] for row in models] == [row["heave_rms [m]"] for row in rows]


def test_markdown_has_the_band_of_several_realizations_only() -> None:
    study = made_up([1.0, 1.25], [0.1, 0.2], reference=0)
    assert "±" not in rms_markdown(study)
    twice = RmsStudy(
        study.title, study.varied, study.levels, study.values, 0, SEAS, study.rms * [[0.9], [1.1]]
    )
    # pooled: the root of the mean of 0.81 and 1.21; pitch in degrees
    assert f"| {np.rad2deg(0.04) * np.sqrt(1.01):.4g} ± " in rms_markdown(twice)


def test_csv_has_the_band_of_all_realizations_together() -> None:
    study = made_up([1.0, 1.25], [0.1, 0.2], reference=0)
    twice = RmsStudy(
        study.title, study.varied, study.levels, study.values, 0, SEAS, study.rms * [[0.9], [1.1]]
    )
    rows = list(csv.DictReader(io.StringIO(rms_csv(twice))))
    assert [row["realization"] for row in rows] == ["1", "2", "all"] * 4
    assert rows[0]["heave_rms_band [m]"] == ""
    pooled = np.sqrt(1.01)  # of 0.81 and 1.21
    assert float(rows[2]["heave_rms [m]"]) == pytest.approx(pooled, rel=1e-12)
    # Half of Student's 12.706 for two, times 0.2/1.01, of the RMS.
    band = 0.5 * 12.7062 * 0.2 / 1.01
    assert float(rows[2]["heave_rms_band [m]"]) == pytest.approx(band * pooled, rel=1e-5)
    assert float(rows[2]["pitch_rms_band [deg]"]) == pytest.approx(np.rad2deg(0.04) * band * pooled, rel=1e-5)


def test_differences_have_their_paired_band_and_large_ones_are_written_out() -> None:
    study = made_up([1.0, 3.3], [0.1, 0.2], reference=0)
    assert "| +230 |" in difference_markdown(study)
    assert "e+0" not in difference_markdown(study)
    assert "±" not in difference_markdown(study)
    rms = np.repeat(study.rms, 3, axis=2)
    rms[1, 1, :, 2] = 2.0 * np.array([1.06, 1.10, 1.14])
    told = difference_markdown(RmsStudy("", "", study.levels, study.values, 0, SEAS, rms))
    # Student's 4.30 over √3, times 0.04
    assert "+10 ± 9.9 |" in told
    assert "95 % band of the paired difference" in told
    together = tuple(StudySea(sea.label, 30.0) for sea in SEAS)
    rms[1, 0] = rms[0, 0]  # the sea without a difference has no band either
    told = difference_markdown(RmsStudy("", "", study.levels, study.values, 0, together, rms))
    assert "| +10 ± 9.9 |" in told


def test_a_table_of_differences_has_a_row_a_level_and_heading_in_signed_per_cent() -> None:
    study = made_up([1.0, 0.97, 1.2], [0.1, 0.2, 0.4], reference=0)
    rows = [line.split("|")[1:-1] for line in difference_markdown(study).splitlines() if line[:2] == "| "]
    head, _, *body = [[cell.strip() for cell in row] for row in rows]
    assert head[2:8] == [f"{name} [%]" for name in DOF_NAMES]
    assert [row[:2] for row in body] == [[f"level {i}", b] for i in (1, 2) for b in ("30", "150")]
    assert body[0][2:8] == ["-3", "–", "-3", "–", "-3", "-3"]
    assert body[3][2:8] == ["+20", "–", "+20", "–", "+20", "+20"]
    assert body[3][9] == "noticeable, significant"


def test_of_several_seas_from_a_heading_the_largest_difference_of_either_sign_is_told() -> None:
    apart = made_up([1.0, 1.0], [0.1, 0.2], reference=0)
    seas = tuple(StudySea(sea.label, 30.0) for sea in SEAS)
    study = RmsStudy(apart.title, apart.varied, apart.levels, apart.values, 0, seas, apart.rms)
    study.rms[1, :, 0] *= np.array([0.9, 1.05])[:, None]
    row = difference_markdown(study).splitlines()[2]
    assert row.startswith("| level 1 | 30 | -10 | – | -10 |")


@pytest.mark.parametrize("order", [1.0, 2.0, 3.5])
def test_the_order_of_differences_that_follow_a_power_is_found(order: float) -> None:
    h = np.array([0.8, 0.4, 0.2, 0.1])
    study = made_up(1.0 - 0.05 * h**order, h, reference=3)
    found = convergence_order(study, h, floor=0.0)
    # The reference's own error is in the fit, so that nothing is left but that 1 - ε h^p is not quite 1.
    assert found.order == pytest.approx(order, abs=2e-3)
    assert found.standard_error < 1e-3
    against_exact = made_up(np.append(1.0 - 0.05 * h**order, 1.0), np.append(h, 0.05), reference=4)
    found = convergence_order(against_exact, np.append(h, 0.05), floor=0.0, own_reference=False)
    assert found.order == pytest.approx(order, abs=1e-9)  # rounding


@pytest.mark.parametrize(
    ("factors", "floor", "reason"),
    [
        ([1.02, 1.01, 1.0], 0.0, "2 levels besides the reference"),
        ([1.02, 1.0], 0.0, "1 level besides the reference"),
        ([1.03, 1.02, np.nan, 1.0], 0.0, "2 levels besides the reference"),
        ([1.0 + 3e-12, 1.0 + 2e-12, 1.0 + 1e-12, 1.0], 1e-9, "round-off"),
        ([1.001, 1.03, 1.0009, 1.02, 1.0], 0.0, "no power"),
    ],
)
def test_differences_without_an_order_are_told_so(factors: list[float], floor: float, reason: str) -> None:
    h = 0.8 * 0.5 ** np.arange(len(factors))
    study = made_up(np.array(factors), h, reference=len(factors) - 1)
    found = convergence_order(study, h, floor=floor)
    assert np.isnan(found.order) and reason in found.told


def test_the_band_of_a_paired_difference_is_none_where_realizations_differ_alike() -> None:
    """One factor for all realizations: however these scatter, the difference is certain."""
    random = np.random.default_rng(2)
    linear = BASE * random.uniform(0.5, 1.5, (len(SEAS), 6, 1))
    rms = np.stack([linear, 1.1 * linear])
    study = RmsStudy("t", "model", ("a", "b"), np.arange(2.0), 0, SEAS, rms)
    band = difference_band(study)
    assert np.nanmax(band) < 1e-12  # rounding
    assert np.isnan(band[1, 0, 1])  # sway is minor
    assert study.band[1, 0, 0] > 0.1  # unpaired it would be wide
    one = RmsStudy("t", "model", ("a", "b"), np.arange(2.0), 0, SEAS, rms[:, :, :1])
    assert np.isnan(difference_band(one)).all()


def test_the_band_of_a_paired_difference_covers_the_truth_as_often_as_it_says() -> None:
    """Variances that scatter by 10 % together and by 4 % apart; the true difference is 20 %."""
    random = np.random.default_rng(3)
    shape = (400, 12, 6)  # each sea a draw of its own
    variance = 1.0 + 0.10 * random.normal(size=shape)
    other = 1.44 * variance * (1.0 + 0.04 * random.normal(size=shape))
    seas = tuple(StudySea(str(i), 0.0) for i in range(shape[0]))
    rms = np.sqrt(np.stack([variance, other]))
    study = RmsStudy("t", "model", ("a", "b"), np.arange(2.0), 0, seas, rms)
    covered = np.abs(study.difference[1] - 0.2) < difference_band(study)[1]
    # 2400 draws of 95 %: a standard error of 0.45 %, and a normal law is not quite that of a ratio
    assert covered.mean() == pytest.approx(0.95, abs=0.02)
