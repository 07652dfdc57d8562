"""Figures of studies: what is drawn where, in which unit, and that lines which coincide can be told apart."""

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from panelsim.conventions import DOF_NAMES
from panelsim.errors import PanelsimError
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.view.cost_picture import cost_picture
from panelsim.view.model_picture import model_picture
from panelsim.view.rms_pictures import rms_over_height, rms_over_levels
from panelsim.view.study_lines import lines_of

BASE = np.array([0.5, 0.02, 1.0, 0.001, 0.04, 0.03])  # m, rad; sway and roll are minor
HEIGHTS = (4.0, 2.0, 6.0)  # in no order
STEPS = np.array([0.4, 0.2, 0.1])


def study(realizations: int = 1) -> RmsStudy:
    """RMS in proportion to the height, 4 % and 1 % above the reference; another heading is ten times that."""
    seas = tuple(StudySea(f"{h:g} m, {b:g}°", b, h) for b in (30.0, 150.0) for h in HEIGHTS)
    height = np.array(
        [sea.significant_wave_height * (10.0 if sea.wave_heading_deg == 30.0 else 1.0) for sea in seas]
    )  # type: ignore
    scatter = np.linspace(0.9, 1.1, realizations)[:, None] if realizations > 1 else np.ones((1, 1))
    rms = np.array([1.04, 1.01, 1.0])[:, None, None, None] * height[:, None, None] * scatter * BASE
    levels = ("0.4 s", "0.2 s", "0.1 s")
    return RmsStudy("Made up", "time step [s]", levels, STEPS, 2, seas, rms)


def test_rms_over_height_has_a_line_a_level_in_order_of_height(tmp_path: Path, drawn: list[Figure]) -> None:
    path = rms_over_height(study(), 150.0, tmp_path / "rms.png")
    assert path.stat().st_size > 10_000
    axes = drawn[0].axes
    titles = [axis.get_title() for axis in axes]
    assert [titles[i] for i in (0, 1, 2, 6, 7, 8)] == list(DOF_NAMES)  # as the report lays them out
    assert [axes[0].get_ylabel(), axes[7].get_ylabel()] == ["RMS [m]", "RMS [deg]"]
    coarse, _, reference = axes[7].get_lines()
    np.testing.assert_array_equal(coarse.get_xdata(), [2.0, 4.0, 6.0])
    # pitch in degrees; rounding
    np.testing.assert_allclose(coarse.get_ydata(), np.rad2deg(1.04 * 0.04 * np.array([2.0, 4.0, 6.0])))
    assert (coarse.get_label(), reference.get_label()) == ("0.4 s", "0.1 s")
    below = [line for line in axes[10].get_lines() if len(np.asarray(line.get_xdata())) == 3]
    np.testing.assert_allclose([line.get_ydata()[0] for line in below], [4.0, 1.0])  # per cent
    assert axes[4].texts[0].get_text().startswith("minor")  # sway
    assert not axes[3].texts
    assert not axes[0].collections  # no band of one realization
    # lines that coincide can be told apart: the reference is broad and below, the others differ in marker
    lines = axes[0].get_lines()
    assert len({(line.get_linestyle(), line.get_marker(), line.get_markersize()) for line in lines}) == 3
    assert lines[2].get_linewidth() > 2.0 * lines[0].get_linewidth()
    assert lines[2].get_zorder() < lines[0].get_zorder()


def test_differences_of_many_per_cent_are_drawn_by_their_logarithm(
    tmp_path: Path, drawn: list[Figure]
) -> None:
    wide = study()
    wide.rms[0, :, :, 2] *= 1.5  # heave of the coarse step: 56 %
    rms_over_height(wide, 150.0, tmp_path / "rms.png")
    surge, heave = drawn[0].axes[3], drawn[0].axes[5]
    assert (surge.get_yscale(), heave.get_yscale()) == ("linear", "symlog")
    assert heave.get_ylim()[1] > 56.0 and heave.get_ylim()[0] == -heave.get_ylim()[1]
    told = [label.get_text() for label in heave.get_yticklabels()]
    assert told == ["-100", "", "-1", "0", "1", "", "100"]


@pytest.mark.parametrize("factor", [1.0, 1.5, 1.8, 7.0])
def test_no_marker_is_cut_off(factor: float, tmp_path: Path, drawn: list[Figure]) -> None:
    """Differences of 4, 56, 87 and 630 %: the largest ones have their whole marker inside of the panel."""
    wide = study()
    wide.rms[0, :, :, 2] *= factor
    rms_over_height(wide, 150.0, tmp_path / "rms.png")
    axis = drawn[0].axes[5]
    line = axis.get_lines()[0]
    radius = 0.5 * (line.get_markersize() + line.get_markeredgewidth()) * drawn[0].dpi / 72.0
    height = float(np.asarray(line.get_ydata())[0])
    assert axis.transData.transform((2.0, height))[1] + radius < axis.transAxes.transform((0.0, 1.0))[1]


def test_the_band_is_drawn_where_it_is_known(tmp_path: Path, drawn: list[Figure]) -> None:
    rms_over_height(study(realizations=4), 30.0, tmp_path / "rms.png")
    axis = drawn[0].axes[0]
    (reference,) = (line for line in axis.get_lines() if line.get_label() == "0.1 s")
    edge = axis.collections[0].get_paths()[0].vertices[:, 1]
    assert edge.min() < reference.get_ydata()[0] and edge.max() > reference.get_ydata()[-1]


def test_a_heading_without_a_height_is_refused(tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="90 deg") as refused:
        rms_over_height(study(), 90.0, tmp_path / "rms.png")
    assert "150, 30" in str(refused.value)
    assert not list(tmp_path.iterdir())


def test_differences_over_levels_are_slopes_on_logarithmic_axes(tmp_path: Path, drawn: list[Figure]) -> None:
    rms_over_levels(study(), tmp_path / "levels.png")
    axes = drawn[0].axes
    surge = axes[0].get_lines()[0]
    np.testing.assert_array_equal(surge.get_xdata(), [0.2, 0.4])
    np.testing.assert_allclose(surge.get_ydata(), [1.0, 4.0])  # per cent; rounding
    assert (axes[0].get_xscale(), axes[0].get_yscale()) == ("log", "log")
    assert axes[5].get_xlabel() == "time step [s]"
    assert axes[1].texts and not axes[0].texts


def test_a_study_of_which_every_run_failed_has_no_figures(tmp_path: Path, drawn: list[Figure]) -> None:
    nothing = study()
    nothing.rms[:] = np.nan
    assert rms_over_levels(nothing, tmp_path / "b.png") is None
    assert model_picture(nothing, np.full(6, np.nan), tmp_path / "c.png") is None
    assert not list(tmp_path.iterdir())
    rms_over_height(nothing, 30.0, tmp_path / "a.png")
    told = {text.get_text() for axis in drawn[0].axes for text in axis.texts}
    assert told == {"no figures: the reference did not finish"}
    assert {lines.name.partition(": ")[2] for lines in lines_of(nothing, 1)} == {"", "no figures"}


def test_a_reference_that_failed_makes_nothing_minor(tmp_path: Path, drawn: list[Figure]) -> None:
    some = study()
    some.rms[2, 3:] = np.nan  # the reference, from 150°
    assert some.unknown.tolist() == [False] * 3 + [True] * 3
    rms_over_height(some, 150.0, tmp_path / "a.png")
    assert drawn[0].axes[3].texts[0].get_text().startswith("no figures")
    rms_over_levels(some, tmp_path / "b.png")
    assert [bool(axis.texts) for axis in drawn[1].axes] == [False, True, False, True, False, False]
    assert all(axis.texts[0].get_text().startswith("minor") for axis in drawn[1].axes if axis.texts)
    # One model ran: its bars are drawn, and no difference is called minor.
    some.rms[1] = np.nan
    assert model_picture(some, np.full(6, np.nan), tmp_path / "c.png") is not None
    assert [text.get_text() for axis in drawn[2].axes for text in axis.texts] == ["no figures"] * 6


def test_models_stand_side_by_side_with_their_difference(tmp_path: Path, drawn: list[Figure]) -> None:
    both = study()
    model_picture(both, np.full(6, 0.005), tmp_path / "models.png")
    translations, rotations, below, _ = drawn[0].axes
    assert [bar.get_height() for bar in translations.patches[:3]] == pytest.approx(1.04 * 40.0 * BASE[:3])
    assert rotations.patches[4].get_height() == pytest.approx(1.01 * 40.0 * np.rad2deg(BASE[4]))
    # the second level over the reference, which is the third
    assert below.patches[0].get_height() == pytest.approx(1.0)
    assert below.texts[0].get_text() == "minor"


def test_costs_are_drawn_by_model_with_medians_and_extremes(tmp_path: Path, drawn: list[Figure]) -> None:
    size, cost = np.array([10.0, 20.0]), np.array([[1.0, 4.0, 2.0], [3.0, 3.0, 9.0]])
    cost_picture({"panels": {"linear": (size, 0.1 * cost), "nonlinear": (size, cost)}}, tmp_path / "cost.png")
    containers = drawn[0].axes[0].containers
    assert [container.get_label() for container in containers] == ["linear", "nonlinear"]
    line, _, bars = containers[1]
    np.testing.assert_array_equal(line.get_ydata(), [2.0, 3.0])
    np.testing.assert_allclose(
        [segment[:, 1] for segment in bars[0].get_segments()], [[1.0, 4.0], [3.0, 9.0]]
    )
