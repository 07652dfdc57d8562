"""What panels lose of their form: closed forms, order in panel size, and what `panelsim hull` says of it."""

import json
from dataclasses import astuple, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from panelsim.cli import show
from panelsim.conventions import FloatArray
from panelsim.hull.curve import Waterline
from panelsim.hull.defects import form_integrals, mesh_defect
from panelsim.hull.form import HullForm, load_hull
from panelsim.hull.hydrostatics import hydrostatics
from panelsim.hull.sections import HullLines
from panelsim.ship.bundled import load_ship
from panelsim.ship.facts import ship_facts
from panelsim.ship.ship import Ship


def measured(form: HullForm, *, draft: float | None = None, trim_by_stern: float = 0.0) -> FloatArray:
    """Volume, waterplane area, transverse and longitudinal second moment (4,) of the smooth form."""
    integrals = form_integrals(
        form.shape, Waterline(form.draft if draft is None else draft, trim_by_stern / form.length_pp)
    )
    assert integrals is not None
    return np.array(astuple(integrals))


def defects(form: HullForm, areas: list[float], **at_rest: float) -> tuple[FloatArray, FloatArray]:
    """Mean panel sizes (A,) [m] and defects (A, 4) [%] on meshes of these nominal panel areas [m2]."""
    size, defect = [], []
    for area in areas:
        mesh = form.panel(area, **at_rest)
        rest = hydrostatics(
            mesh,
            draft=at_rest.get("draft", form.draft),
            trim=-np.arctan(at_rest.get("trim_by_stern", form.trim_by_stern) / form.length_pp),
        )
        size.append(np.sqrt(mesh.area.mean()))
        found = mesh_defect(form, rest)
        assert found is not None
        defect.append(astuple(found))
    return np.array(size), np.array(defect)


def integral(p: Polynomial) -> float:
    """From -1 to 1."""
    return float(p.integ()(1.0) - p.integ()(-1.0))


@pytest.mark.parametrize(("name", "beam", "a"), [("wigley_i", 0.3, 1.0), ("wigley_iv", 0.6, 0.0)])
def test_wigley_has_the_integrals_of_its_formula(name: str, beam: float, a: float) -> None:
    """Journée (1992): y = B/2 [(1 - Z²)(1 - X²)(1 + 0.2 X²) + a Z² (1 - Z⁸)(1 - X²)⁴], L 3 m, d 0.1875 m."""
    bow = Polynomial([1, 0, -1])
    water = bow * Polynomial([1, 0, 0.2])
    half, y = 1.5, 0.5 * beam * water
    flat_part, bilge_part = integral(water), a * integral(bow**4)
    # The sections of the form are chords between 161 heights, which lose h²/12 of the slope at the keel.
    chords = (2.0 * flat_part + 8.0 * bilge_part) / (12 * 160**2)
    area_shares = 2 / 3 * flat_part + (1 / 3 - 1 / 11) * bilge_part - chords
    x = Polynomial([0, half])
    exact = [
        half * beam * 0.1875 * area_shares,
        2 * half * integral(y),
        2 / 3 * half * integral(y**3),
        2 * half * integral(x**2 * y),
    ]
    error = measured(load_hull(name)) / exact - 1.0
    print(f"{name}: chords {-chords / area_shares:.1e}, errors {error}")
    # Cubics through sections 0.02 of the half-length apart, level at midships, and the grids of the volume.
    np.testing.assert_allclose(error, 0.0, atol=5e-7)


def test_a_trim_inclines_the_waterplane_of_lines() -> None:
    """Wigley IV is wall-sided from 0.1875 to 0.3375 m: between them the plane is the same cut, on a slope."""
    form = load_hull("wigley_iv")
    volume, area, transverse, longitudinal = measured(form)
    secant = np.hypot(1.0, 0.04)
    exact = [volume + 0.0725 * area, area * secant, transverse * secant, longitudinal * secant**3]
    inclined = measured(form, draft=0.26, trim_by_stern=0.12)
    # The grids of the volume differ; the secant is 8e-4 from 1.
    np.testing.assert_allclose(inclined, exact, rtol=1e-6)


def test_five_points_between_sections_are_exact(monkeypatch: pytest.MonkeyPatch) -> None:
    form = load_hull("halifax")
    five = measured(form)
    monkeypatch.setattr("panelsim.hull.defects.GAUSS_POINTS", 9)
    np.testing.assert_allclose(measured(form), five, rtol=1e-13)  # rounding


@pytest.mark.parametrize(
    ("name", "draft", "exact"),
    [
        # A cap of height h: V = π h² (R - h/3), radius² h (2R - h).
        ("sphere", 3.0, [36 * np.pi, 21 * np.pi, 441 * np.pi / 4, 441 * np.pi / 4]),
        ("sphere", 5.0, [250 / 3 * np.pi, 25 * np.pi, 625 * np.pi / 4, 625 * np.pi / 4]),
        ("cylinder", 4.0, [100 * np.pi, 25 * np.pi, 625 * np.pi / 4, 625 * np.pi / 4]),
        ("box", 2.0, [400.0, 200.0, 20 * 10**3 / 12, 10 * 20**3 / 12]),
    ],
)
def test_simple_bodies_have_their_closed_forms(name: str, draft: float, exact: list[float]) -> None:
    np.testing.assert_allclose(measured(load_hull(name), draft=draft), exact, rtol=1e-14)


def test_the_volume_of_lines_is_right_to_a_millionth() -> None:
    """Against one grid of 1600 by 2048, which is short by a third of its step from the one before, 5e-7."""
    form = load_hull("halifax")
    assert isinstance(form.shape, HullLines)
    side = form.shape.wet_side(Waterline(form.draft, form.trim_by_stern / form.length_pp))
    assert side is not None
    volume = measured(form, trim_by_stern=form.trim_by_stern)[0]
    assert 2.0 * side.volume(1600, 2048) == pytest.approx(volume, rel=1e-6)


FIRST_AREA = {"wigley_i": 0.012, "sphere": 4.0, "cylinder": 4.0, "halifax": 12.0}


@pytest.mark.parametrize("name", FIRST_AREA)
def test_the_defect_falls_with_the_square_of_the_panel_size(name: str) -> None:
    """A form measured wrong by a thousandth would bend the line: the defects go from 1 % down to 0.01 %."""
    form = load_hull(name)
    size, defect = defects(form, [FIRST_AREA[name] / 4**k for k in range(4)])
    slopes = np.polyfit(np.log(size), np.log(np.abs(defect)), 1)[0]
    print(f"{name}: defects {np.round(defect, 4).tolist()} %, orders {np.round(slopes, 2)}")
    # Chords lose the square of their length; the counts are whole numbers, hence the band.
    np.testing.assert_allclose(slopes, 2.0, atol=0.15)
    # A convex waterline lies outside its chords, and the corrected columns still lose along the length.
    assert np.all(defect < 0.0)


def test_the_defect_of_the_medium_mesh_is_small_because_columns_keep_their_areas(halifax: Ship) -> None:
    """Without `keep_section_areas` chords across the bilge would lose more than 1 % of a coarse mesh."""
    assert halifax.form is not None
    found = mesh_defect(halifax.form, halifax.hydrostatics)
    assert found is not None
    assert -0.05 < found.volume_percent < 0.0
    assert -0.05 < found.waterplane_area_percent < 0.0


@pytest.mark.parametrize("trim_by_stern", [-1.2, 1.2])
def test_lines_and_panels_meet_on_a_trimmed_waterline(trim_by_stern: float) -> None:
    """Within 0.1 % at 6 m2, as on an even keel; with the trim reversed the form is 4 % apart in volume."""
    form = load_hull("halifax")
    assert isinstance(form.shape, HullLines)
    _, defect = defects(form, [6.0], draft=5.3, trim_by_stern=trim_by_stern)
    assert np.all(np.abs(defect) < 0.1)
    ahead, astern = (measured(form, draft=5.3, trim_by_stern=trim) for trim in (1.2, -1.2))
    assert np.abs(ahead / astern - 1.0).max() > 0.03


@pytest.mark.parametrize("trim_by_stern", [0.0, 1.0, -3.0])
def test_a_box_loses_nothing(trim_by_stern: float) -> None:
    """Plane faces: rounding only, on a level water plane and on one inclined by up to 0.15."""
    _, defect = defects(load_hull("box"), [2.0], draft=2.2, trim_by_stern=trim_by_stern)
    np.testing.assert_allclose(defect, 0.0, atol=1e-10)


@settings(deadline=None, max_examples=20)
@given(
    st.sampled_from(["box", "sphere", "cylinder"]),
    st.floats(0.5, 2.0),
    st.floats(0.5, 2.0),
    st.floats(0.5, 2.0),
)
def test_a_stretched_body_has_stretched_integrals(name: str, x: float, y: float, z: float) -> None:
    form = load_hull(name)
    scaled = form.scaled(length=form.length_pp * x, beam=form.beam * y, draft=form.draft * z)
    factors = [x * y * z, x * y, x * y**3, x**3 * y]
    np.testing.assert_allclose(measured(scaled), measured(form) * factors, rtol=1e-12)


def test_lines_twice_as_large_have_integrals_of_their_powers() -> None:
    form = load_hull("s175")
    scaled = form.scaled(length=2 * form.length_pp, beam=2 * form.beam, draft=2 * form.draft)
    np.testing.assert_allclose(measured(scaled), measured(form) * [8, 4, 16, 16], rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "draft", "slope"),
    [
        ("halifax", 20.0, 0.0),  # over the deck
        ("halifax", 2.0, -0.1),  # out of the water at the stern
        ("box", 5.0, 0.0),
        ("box", 2.0, 0.3),
        ("sphere", 10.0, 0.0),
        ("cylinder", 15.0, 0.0),
        ("sphere", 5.0, 0.01),
    ],
)
def test_a_waterline_that_misses_the_form_is_not_measured(name: str, draft: float, slope: float) -> None:
    assert form_integrals(load_hull(name).shape, Waterline(draft, slope)) is None


def test_a_shape_of_another_kind_is_not_measured(halifax: Ship) -> None:
    assert halifax.form is not None

    class Raft:
        pass

    form = replace(halifax.form, shape=Raft())  # type: ignore[arg-type]
    assert mesh_defect(form, halifax.hydrostatics) is None


# ---------------------------------------------------------------- what is said of it


def test_facts_carry_the_defect_in_per_cent() -> None:
    """A cylinder's panels make a prism of n sides, n / 2π sin(2π/n) of the circle it stands in."""
    ship = load_ship("cylinder", 4.0)
    x, y, _ = ship.mesh.vertices[np.isclose(ship.mesh.vertices[:, 2], ship.draft)].T
    sides = len(np.unique(np.round(np.arctan2(y, x), 9)))
    share = sides / (2 * np.pi) * np.sin(2 * np.pi / sides)
    defect = json.loads(json.dumps(ship_facts(ship).as_dict()))["mesh_defect"]
    assert set(defect) == {
        *("volume_percent", "waterplane_area_percent"),
        *("transverse_second_moment_percent", "longitudinal_second_moment_percent"),
    }
    # Their sides are as many radians at the centre: equal to rounding, and at least 0.1 % short.
    assert defect["waterplane_area_percent"] == pytest.approx(100 * (share - 1), rel=1e-9)
    assert defect["waterplane_area_percent"] < -0.1


def test_the_table_says_which_second_moment_is_which() -> None:
    facts = ship_facts(load_ship("halifax", 12.0))
    defect = facts.mesh_defect
    assert defect is not None
    with show.out.capture() as captured:
        show.show_facts(facts)
    text = " ".join(captured.get().split())
    assert f"volume {defect.volume_percent:.2g} %, waterplane {defect.waterplane_area_percent:.2g} %" in text
    transverse, longitudinal = (
        f"{value:.2g} %"
        for value in (defect.transverse_second_moment_percent, defect.longitudinal_second_moment_percent)
    )
    assert f"transverse {transverse}, longitudinal {longitudinal}" in text
    assert transverse != longitudinal


def test_nothing_is_said_of_a_mesh_without_a_form(barge: Ship) -> None:
    facts = ship_facts(barge)
    assert facts.mesh_defect is None
    assert json.loads(json.dumps(facts.as_dict()))["mesh_defect"] is None
    with show.out.capture() as captured:
        show.show_facts(facts)
    assert "smooth form" not in captured.get()
