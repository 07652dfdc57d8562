"""Order of convergence of the wetted-surface load, rule by rule, and of the facets it is computed on."""

import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture(scope="module")
def study() -> Iterator[ModuleType]:
    """The script as a module, its folder on the path as when it is run."""
    sys.path.insert(0, str(BENCHMARKS))
    try:
        yield import_module("wetting_convergence")
    finally:
        sys.path.remove(str(BENCHMARKS))


@pytest.fixture(scope="module")
def found(study: ModuleType) -> Any:
    return study.measure()


def told(errors: np.ndarray) -> str:
    return " ".join(f"{error:.1e}" for error in errors)


# Whole panels flood one by one, so that their fall is irregular. The last bound of each is that of the
# error on panels of 0.36 m2, twice what is measured: a slope alone says nothing of the size.
@pytest.mark.parametrize(
    ("name", "least", "largest", "finest"),
    [
        ("panel", 1.6, 2.2, 1e-2),
        ("vertex", 1.85, 2.15, 2e-4),
        ("vertex+centre", 2.55, 4.2, 1e-6),  # fourth below the surface, third where it cuts
        ("facets", 1.9, 2.1, 5e-3),
    ],
)
def test_order_over_four_refinements_of_the_wigley_hull(
    found: Any, name: str, least: float, largest: float, finest: float
) -> None:
    errors = found.together(name)
    each = [np.polyfit(np.log(found.size), np.log(found.errors[name][:, i]), 1)[0] for i in range(6)]
    print(f"{name}: errors {told(errors)}, order {found.order(name):.2f}, of each load {np.round(each, 2)}")
    np.testing.assert_allclose(found.size[:-1] / found.size[1:], 2.0, rtol=0.02)
    assert least < found.order(name) < largest
    assert errors[-1] < finest
    assert (np.diff(errors) < 0.0).all()


def test_facets_are_the_main_error_where_panels_are_cut(found: Any) -> None:
    """On every mesh: a factor of 25 for the vertex rule, of some hundreds for vertex + centre."""
    assert (found.together("facets") > 10 * found.together("vertex")).all()
    assert (found.together("facets") > 100 * found.together("vertex+centre")).all()
    assert (found.together("vertex") > 10 * found.together("vertex+centre")).all()


def test_coarse_panels_by_vertex_and_centre_err_less_than_fine_ones_taken_whole(study: ModuleType) -> None:
    """Rule errors on 5 m2 and on 1 m2, each load by itself, of the Wigley hull and of halifax."""
    for name, (coarse, fine) in study.coarse_and_fine().items():
        print(f"{name}: vertex + centre on 5 m2 {told(coarse)}; whole panels on 1 m2 {told(fine)}")
        assert (coarse < 0.1 * fine).all()
    assert study.wigley(study.COARSE).mean_area > 5.0
    assert study.wigley(study.FINE).mean_area < 1.0


def test_the_smooth_hull_displaces_what_its_formula_says(study: ModuleType) -> None:
    """4/9 L B T, with the centre of buoyancy 3/8 T below the water."""
    pose = np.zeros((2, 8))
    pose[1, 5] = 1e-4  # rad of heel
    upright, heeled = study.smooth_load(pose)
    volume = 4 / 9 * study.LENGTH * study.BEAM * study.DRAFT
    weight = study.DENSITY * study.GRAVITY * volume
    # What is left of the extrapolated error of the facets falls with the fourth power.
    assert upright[2] == pytest.approx(weight, rel=1e-6)
    # BM = I/V with I = 2/3 ∫(B/2 (1 - s²))³ dx = 2/3 (B/2)³ (L/2) 32/35.
    inertia = 2 / 3 * (study.BEAM / 2) ** 3 * (study.LENGTH / 2) * 32 / 35
    metacentre = study.DRAFT - study.KG - 3 / 8 * study.DRAFT + inertia / volume
    # The water cuts its row of panels elsewhere on either mesh, so that the breadth there does not
    # extrapolate: rows of 0.11 m lose up to 1e-3 m of 7.5 m, and BM = 2.86 m three times that share.
    assert heeled[3] / (-weight * 1e-4) == pytest.approx(metacentre, abs=1e-3)
    np.testing.assert_allclose(upright[[0, 1, 3, 4, 5]], 0.0, atol=1e-10 * weight * study.LENGTH)


def test_the_report_has_a_row_for_each_error_and_the_plot_is_written(
    study: ModuleType, found: Any, tmp_path: Path
) -> None:
    pair = (np.full(6, 1.25e-5), np.full(6, 2.5e-3))
    text = study.report(found, {"Wigley": pair})
    for name, title in study.NAMES.items():
        assert f"| {title} | {found.together(name)[0]:.1e} |" in text
        assert f"| {found.order(name):.2f} |" in text
    assert "| Wigley | whole panels, 1 m² | 2.5e-03 |" in text
    study.plot(found, tmp_path / "plot.png")
    assert (tmp_path / "plot.png").stat().st_size > 10_000
