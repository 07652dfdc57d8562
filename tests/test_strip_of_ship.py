"""Strips of a ship: her sections close-fitted or as Lewis forms, cut from panels or taken from offsets."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.cli.commands import call
from panelsim.conventions import KNOT, Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.store import database_for, stored_database
from panelsim.hydro.strip.database import solve_strips
from panelsim.hydro.strip.lewis import lewis_form
from panelsim.hydro.strip.long_waves import solve_at_all_frequencies
from panelsim.hydro.strip.mesh_sections import sections_of_mesh, wet_ends
from panelsim.hydro.strip.multipoles import lewis_nodes, solve_lewis, solve_lewis_elements
from panelsim.hydro.strip.of_ship import require_sections_of
from panelsim.hydro.strip.section_forms import lewis_forms
from panelsim.hydro.strip.sections import HullSections, Section, sections_from_offsets
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

WATER = {"water_density": 1025.0, "gravity": 9.81}
G, RHO = WATER["gravity"], WATER["water_density"]
HEADINGS = (180.0, 135.0, 90.0, 30.0)


@cache
def ship_of(name: str) -> Ship:
    return load_ship(name)


@cache
def strips(name: str, section_form: str = "close-fit") -> HydroDatabase:
    return HydroDatabase.compute(ship_of(name), "strip", section_form=section_form)  # type: ignore[arg-type]


@cache
def offsets(name: str, every: int = 1) -> HullSections:
    ship, stations = ship_of(name), load_hull(name).shape.sections  # type: ignore[attr-defined]
    taken = stations[1::every] if every > 1 else stations
    return sections_from_offsets([ship.to_ship_axes(s) for s in taken], ship.waterline)


def largest_difference(first: FloatArray, second: FloatArray) -> FloatArray:
    """Over the first axis, of the peak of the first."""
    return np.abs(first - second).max(axis=0) / np.abs(first).max(axis=0)


# --- Lewis forms


def test_elements_of_a_lewis_form_hold_the_points_of_its_quadrature_and_its_coefficients() -> None:
    form = lewis_form(14.0, 4.5, 52.0, waterline=-1.5)
    omega = np.array([0.05, 0.4, 1.0, 2.0, np.inf])
    points, elements = solve_lewis(form, omega, **WATER), solve_lewis_elements(form, omega, **WATER)
    nodes = lewis_nodes(form)
    assert nodes[[0, -1], 1] == pytest.approx([-1.5, -1.5], abs=1e-12)
    assert nodes[::-1] * [-1.0, 1.0] == pytest.approx(nodes, abs=1e-12)
    assert elements.contour.length.sum() == pytest.approx(points.contour.length.sum(), rel=1e-3)
    # Chords of 80 elements on a convex outline: 0.04 % of the area, twice that in heave.
    for name in ("added_mass", "damping"):
        exact, found = getattr(points, name), getattr(elements, name)
        scale = np.sqrt(np.einsum("fi,fj->fij", *2 * [np.abs(np.einsum("fii->fi", exact)) + 1e-9]))
        assert np.abs(found - exact).max(axis=0) / scale.max(axis=0) == pytest.approx(0.0, abs=2e-3)


def test_a_lewis_form_is_led_to_rest_as_its_own_outline_is() -> None:
    form = lewis_form(14.0, 4.5, 52.0, waterline=-1.5)
    grid = np.array([0.0, 0.1, 0.2, 0.3, 0.4, 0.6, 1.0, 2.0])
    by_multipoles, by_elements = (
        solve_at_all_frequencies(section, grid, 0.4, **WATER) for section in (form, form.section())
    )
    for dof in range(3):
        for name in ("added_mass", "damping"):
            a, b = (getattr(s, name)[:, dof, dof] for s in (by_elements, by_multipoles))
            # Elements of an outline of 48 pieces are 1 % off the smooth form, roll 3 %.
            assert np.abs(a - b).max() < (0.03 if dof == 2 else 0.01) * np.abs(a).max()


def test_lewis_forms_of_a_frigate_are_near_her_own_outlines() -> None:
    """Heave and pitch to some per cent; roll, which asks for the bilge, to a tenth."""
    close_fit, lewis = strips("halifax"), strips("halifax", "lewis")
    assert lewis.frequencies == pytest.approx(close_fit.frequencies)
    assert (
        "21 Lewis forms" in lewis.dataset.attrs["solver"] and "Lewis" not in close_fit.dataset.attrs["solver"]
    )
    # Measured at the most: A 2.3, 1.0, 11.6, 0.3, 1.0 %; B 3.1, 2.5, 8.4, 3.3, 4.2 % of their peaks.
    allowed = np.array([0.05, 0.05, 0.15, 0.05, 0.05])
    for name in ("added_mass", "radiation_damping"):
        diagonal = [np.einsum("fii->fi", getattr(d, name))[:, 1:] for d in (close_fit, lewis)]
        apart = largest_difference(*diagonal)
        assert (apart < allowed).all()
        assert (apart > 1e-3).all()  # they are not the same solution
    omega = np.arange(0.3, 1.6, 0.1)
    for heading in HEADINGS:
        for speed in (0.0, 20 * KNOT):
            loads = [
                diffraction_load(d, omega, np.radians(heading), speed)[:, 1:] for d in (close_fit, lewis)
            ]
            modes = [1, 3] if heading == 180.0 else [0, 1, 2, 3, 4]
            # 4.7 % in heave and pitch, 4.5 % in sway and yaw, 11.3 % in roll.
            assert (largest_difference(*loads)[modes] < allowed[modes] + 0.01).all()


def test_a_form_without_the_area_of_its_section_is_noted() -> None:
    """The second section of S175 from aft is hollow: a lobe above the shaft."""
    ship = ship_of("s175")
    cut = sections_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, 21)
    forms, note = lewis_forms(cut)
    assert note.startswith("No Lewis form has the area of the sections at x = -73.")
    assert [i for i in range(21) if abs(forms[i].area / cut.sections[i].area - 1.0) > 1e-9] == [1]
    ended = HullSections(cut.sections[:6], cut.aft_end, 0.5 * float(cut.x[5] + cut.x[6]))
    data = solve_strips(ended, **WATER, frequencies=np.array([0.0, 0.5, 1.0, 1.5, 2.0]), section_form="lewis")
    assert any(line.startswith(note.split(":")[0]) for line in data.attrs["notes"].splitlines())


def sections_of_outline(outline: FloatArray) -> HullSections:
    return HullSections(tuple(Section(x, outline, 0.0) for x in np.arange(-10.0, 11.0, 4.0)), -12.0, 12.0)


def test_sections_that_no_lewis_form_stands_for_are_refused() -> None:
    angle = np.linspace(-np.pi, np.pi, 41)
    bulb = np.stack([np.cos(angle), np.sin(angle) - 3.0], axis=1)[::1]
    leaning = np.array([[-2.0, 0.0], [-1.0, -2.0], [2.0, -1.0], [2.5, 0.0]])
    hollow = np.array([[-3.0, 0.0], [-0.2, -0.3], [-0.2, -4.0], [0.2, -4.0], [0.2, -0.3], [3.0, 0.0]])
    for outline, words in (
        (np.roll(bulb[:-1], 10, axis=0)[[*range(40), 0]], "under water"),
        (leaning, "unequal sides"),
        (hollow, "displaced volume"),
    ):
        with pytest.raises(PanelsimError, match="(?s)" + words) as refused:
            lewis_forms(sections_of_outline(outline))
        assert "close-fit" in str(refused.value)


def test_forms_and_sections_without_strips_are_refused() -> None:
    ship = ship_of("halifax")
    for arguments, words in (
        ({"method": "strip", "section_form": "frank"}, "close-fit | lewis"),
        ({"method": "bem", "section_form": "lewis"}, 'method "strip"'),
        ({"method": "bem", "sections": offsets("halifax")}, 'method "strip"'),
        ({"method": "strip", "sections": [1, 2]}, "sections_from_offsets"),
    ):
        with pytest.raises(PanelsimError) as refused:
            HydroDatabase.compute(ship, **arguments)  # type: ignore[arg-type]
        assert words in str(refused.value)


def test_the_store_keeps_the_two_forms_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PANELSIM_CACHE", str(tmp_path))
    ship = ship_of("wigley_iii")
    solved = {form: strips("wigley_iii", form) for form in ("close-fit", "lewis")}
    monkeypatch.setattr(
        HydroDatabase, "compute", lambda *_, section_form="close-fit", **__: solved[section_form]
    )
    lewis = database_for(ship, method="strip", section_form="lewis")
    assert stored_database(ship, "strip") is None
    close_fit = database_for(ship, method="strip")
    assert len(list(tmp_path.iterdir())) == 2
    for form, database in (("lewis", lewis), ("close-fit", close_fit)):
        stored = stored_database(ship, "strip", form)  # type: ignore[arg-type]
        assert stored is not None and stored.dataset.identical(database.dataset)
        assert stored.dataset.attrs["section_form"] == form


def test_case_and_command_line_offer_lewis_forms(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PANELSIM_CACHE", str(tmp_path / "cache"))
    example = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
    settings = ["hydrodynamics.method=strip", "hydrodynamics.section_form=lewis"]
    case = Case.load(example, settings)
    assert "Lewis forms" in case.database().dataset.attrs["solver"]
    assert case.resolved()["hydrodynamics"]["section_form"] == "lewis"
    for wrong in (settings[1:], [*settings, "hydrodynamics.file=ship.nc"]):
        with pytest.raises(PanelsimError, match="section_form"):
            Case.load(example, wrong)
    path = tmp_path / "lewis.nc"
    command = ["panelsim", "hydro", "wigley_iii", "-o", str(path), "--section-form", "lewis"]
    monkeypatch.setattr("sys.argv", command)
    assert call() == 2
    assert 'method "strip"' in capsys.readouterr().err and not path.exists()
    monkeypatch.setattr("sys.argv", [*command, "--method", "strip"])
    assert call() == 0
    assert "Lewis forms" in HydroDatabase.load(path).dataset.attrs["solver"]


# --- offsets


def test_offsets_of_wigley_give_what_her_panels_give() -> None:
    """25 of her 99 stations, led on to the stems, which are upright and have no station."""
    ship, cut = ship_of("wigley_iii"), strips("wigley_iii")
    own = offsets("wigley_iii", every=4)
    ends = wet_ends(ship.vertices, ship.mesh.panels, ship.waterline)
    database = HydroDatabase.compute(ship, "strip", sections=HullSections(own.sections, *ends))
    assert "25 sections" in database.dataset.attrs["solver"]
    assert np.array_equal(database.frequencies, cut.frequencies)
    for name in ("added_mass", "radiation_damping"):
        diagonal = [np.einsum("fii->fi", getattr(d, name))[:, 1:] for d in (cut, database)]
        # 25 strips against 21, and chords of the panels; 0.44 % at the most, in roll.
        assert (largest_difference(*diagonal) < 0.01).all()
    omega = np.array([4.0, 6.0, 8.0])
    for heading in (180.0, 120.0):
        loads = [diffraction_load(d, omega, np.radians(heading), 1.0)[:, [2, 4]] for d in (cut, database)]
        # Phases of strips 0.12 m long in waves from 1 m.
        assert (largest_difference(*loads) < 0.02).all()


def test_a_section_acts_at_the_middle_of_its_strip() -> None:
    """A prism cut at uneven stations is the same prism: with levers to the stations it would not be.

    ∫ x a dx has no error; ∫ x² a dx lacks the second moments of the strips about their own middles, Σ l³/12.
    """
    angle = np.linspace(-np.pi, 0.0, 61)
    outline = 2.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    sections = HullSections(
        tuple(Section(x, outline, 0.0) for x in (-9.0, -8.0, -3.0, 0.0, 4.0, 5.0)), -10.0, 12.0
    )
    lengths = np.array([1.5, 3.0, 4.0, 3.5, 2.5, 7.5])
    assert sections.strip_length == pytest.approx(lengths)
    data = solve_strips(sections, **WATER, frequencies=np.array([0.0, 0.5, 1.0, 1.5, 2.0]))
    mass = data["added_mass_infinite"].values
    assert mass[Dof.HEAVE, Dof.PITCH] == pytest.approx(-mass[2, 2] / 22.0 * (12.0**2 - 10.0**2) / 2, rel=1e-9)
    moment = (12.0**3 + 10.0**3) / 3.0 - np.sum(lengths**3) / 12.0
    assert mass[Dof.PITCH, Dof.PITCH] == pytest.approx(mass[2, 2] / 22.0 * moment, rel=1e-9)


def test_sections_of_another_ship_are_refused_with_what_differs() -> None:
    ship, own = ship_of("halifax"), offsets("halifax")
    require_sections_of(ship, own)

    def changed(factor: FloatArray, x: float = 1.0, rise: float = 0.0) -> HullSections:
        order = slice(None, None, -1 if x < 0.0 else 1)
        sections = tuple(
            Section(
                x * s.x,
                (s.points - [0.0, s.waterline]) * factor + [0.0, s.waterline + rise],
                s.waterline + rise,
            )
            for s in own.sections[order]
        )
        return HullSections(sections, sections[0].x, sections[-1].x)

    one = np.ones(2)
    require_sections_of(ship, changed(one))
    for sections, words in (
        (changed(one, x=-1.0), "section areas"),  # bow for stern
        (changed(one, x=1.15), "aft end"),
        (changed(np.array([1.05, 1.0])), "volume"),
        (changed(np.array([1.0, 1.05])), "draft"),
        (changed(one, rise=0.2), "waterline"),
    ):
        with pytest.raises(PanelsimError, match="not those of") as refused:
            HydroDatabase.compute(ship, "strip", sections=sections)
        assert words in str(refused.value) and "to_ship_axes" in str(refused.value)


def test_cut_sections_are_those_of_the_ship() -> None:
    for name in ("s175", "frigate"):
        ship = ship_of(name)
        require_sections_of(ship, sections_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, 11))


def test_a_hull_with_a_bulb_under_water_is_symmetric() -> None:
    angle = np.linspace(0.3, 0.3 + 2.0 * np.pi, 41)[:-1]
    angle = np.sort(np.mod(np.concatenate([angle, np.pi - angle]), 2.0 * np.pi))
    bulb = np.stack([np.cos(angle), np.sin(angle) - 2.5], axis=1)
    box = np.array([[-2.0, 0.0], [-2.0, -3.0], [2.0, -3.0], [2.0, 0.0]])
    outlines = [box] * 5 + [np.vstack([bulb, bulb[:1]])]
    sections = tuple(Section(x, outline, 0.0) for x, outline in zip(range(-10, 14, 4), outlines, strict=True))
    data = solve_strips(
        HullSections(sections, -12.0, 12.0), **WATER, frequencies=np.array([0.0, 0.5, 1.0, 1.5, 2.0])
    )
    assert data.attrs["half_hull"] == data.attrs["mirror_symmetric"] == 1
    assert data.attrs["port_starboard_coupling"] < 1e-9
