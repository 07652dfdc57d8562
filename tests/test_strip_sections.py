"""Sections of a ship: cut from meshes, taken from offsets, closed forms, refusals."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from panelsim.conventions import FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import bundled_hull_names, load_hull
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hydro.strip.contour import Contour, contour_nodes, highest_frequency
from panelsim.hydro.strip.mesh_sections import section_of_mesh, sections_of_mesh, wet_ends
from panelsim.hydro.strip.sections import HullSections, Section, section_from_offsets, sections_from_offsets
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

BOX = np.array([[-1.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 0.0]])


def cuboid(low: tuple[float, float, float], high: tuple[float, float, float]) -> tuple[FloatArray, IntArray]:
    """A closed box with outward panels."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    vertices = np.array([[x, y, z] for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)])
    panels = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return vertices, np.array(panels)


@pytest.fixture(scope="module")
def frigate() -> Ship:
    return load_ship("frigate")


def test_a_cuboid_has_the_section_of_a_box() -> None:
    vertices, panels = cuboid((-5.0, -1.5, -2.0), (5.0, 1.5, 1.0))
    section = section_of_mesh(vertices, panels, -0.25, 1.3)
    # To rounding: a planar cut of planar panels is exact.
    assert (section.breadth, section.draft) == pytest.approx((3.0, 1.75), abs=1e-12)
    assert section.area == pytest.approx(3.0 * 1.75, abs=1e-12)
    assert section.symmetric and not section.submerged
    # Starboard first, the water on the right hand.
    np.testing.assert_allclose(section.points[[0, -1]], [[-1.5, -0.25], [1.5, -0.25]], atol=1e-12)
    assert wet_ends(vertices, panels, -0.25) == (-5.0, 5.0)


def test_vertices_on_the_plane_count_as_ahead_of_it() -> None:
    vertices, panels = cuboid((-5.0, -1.5, -2.0), (5.0, 1.5, 1.0))
    assert section_of_mesh(vertices, panels, 0.0, 5.0).area == pytest.approx(6.0, abs=1e-12)
    with pytest.raises(PanelsimError, match="dry"):
        section_of_mesh(vertices, panels, 0.0, -5.0)


def test_wigley_sections_follow_the_formula() -> None:
    """Wigley III: half-breadth B/2 (1 - ζ²)(1 - ξ²)(1 + 0.2 ξ²) with ζ = depth/T, ξ = 2x/L."""
    form = load_hull("wigley_iii")
    mesh = form.panel(0.0015)
    for x in (-1.1, 0.0, 0.7):
        section = section_of_mesh(mesh.vertices, mesh.panels, form.draft, x)
        xi = 2 * x / form.length_pp
        breadth = form.beam * (1 - xi**2) * (1 + 0.2 * xi**2)
        # Chords of the panels stay inside the curve: 0.3 % for panels of a fiftieth of the beam by length.
        assert section.breadth == pytest.approx(breadth, rel=3e-3)
        assert section.area == pytest.approx(breadth * form.draft * 2 / 3, rel=3e-3)


@pytest.mark.parametrize("name", bundled_hull_names())
def test_sections_of_every_bundled_hull_fill_its_volume(name: str) -> None:
    ship = load_ship(name)
    sections = sections_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, 21)
    volume = float(sections.strip_length @ [section.area for section in sections.sections])
    # 0.4 %: midpoint rule with 21 strips, worst at the rounded ends of cylinder and sphere.
    assert volume * ship.water_density == pytest.approx(ship.mass, rel=4e-3)
    assert all(section.symmetric for section in sections.sections)


def test_a_plane_through_a_row_of_vertices_finds_the_same_section(frigate: Ship) -> None:
    x = np.unique(np.round(frigate.vertices[:, 0], 9))
    station = float(frigate.vertices[np.argmin(np.abs(frigate.vertices[:, 0] - np.median(x))), 0])
    on, beside = (
        section_of_mesh(frigate.vertices, frigate.mesh.panels, frigate.waterline, station + dx)
        for dx in (0.0, 1e-7)
    )
    assert on.area == pytest.approx(beside.area, rel=1e-6)


def test_offsets_and_mesh_agree(frigate: Ship) -> None:
    form = load_hull("frigate")
    offsets = sections_from_offsets(
        [frigate.to_ship_axes(station) for station in form.shape.sections],  # type: ignore[attr-defined]
        frigate.waterline,
    )
    assert len(offsets.sections) == 20  # station 0 lies above the water
    for section in offsets.sections[2:-2]:
        cut = section_of_mesh(frigate.vertices, frigate.mesh.panels, frigate.waterline, section.x)
        # The mesh keeps section areas to 0.3 % between stations; fore and aft of these it fairs the ends.
        assert cut.area == pytest.approx(section.area, rel=4e-3)
        assert cut.breadth == pytest.approx(section.breadth, rel=2e-3)


def test_offsets_with_a_flat_bottom_are_closed_and_cut_at_the_water() -> None:
    section = section_from_offsets(0.0, [0.5, 1.0, 1.5], [-2.0, -1.0, 1.0], 0.0)
    # Trapezoids: 2 (0.5 + 1)/2 · 1 + 2 (1 + 1.25)/2 · 1.
    assert section.area == pytest.approx(1.5 + 2.25, abs=1e-12)
    assert section.breadth == pytest.approx(2.5, abs=1e-12)


@given(
    st.floats(0.5, 20.0),
    st.floats(0.3, 8.0),
    st.floats(-3.0, 3.0, allow_subnormal=False),
    st.integers(4, 30).map(lambda n: 2 * n),
)
@settings(deadline=None, max_examples=30)
def test_elements_keep_a_box_whole(breadth: float, draft: float, waterline: float, count: int) -> None:
    points = BOX * [0.5 * breadth, draft] + [0.0, waterline]
    nodes = contour_nodes(Section(0.0, points, waterline), count)
    contour = Contour.of_nodes(nodes, waterline)
    assert len(nodes) == count + 1
    np.testing.assert_array_equal(nodes[::-1] * [-1.0, 1.0], nodes)
    # Corners are kept, so the length and ∫ n dl are exact but for rounding.
    assert contour.length.sum() == pytest.approx(breadth + 2 * draft, rel=1e-12)
    force = contour.modes @ contour.length
    np.testing.assert_allclose(force, [0.0, -breadth, 0.0], atol=1e-9 * breadth)


def test_an_uneven_section_is_known_and_its_normals_point_into_the_water() -> None:
    wedge = Section(0.0, np.array([[-1.0, 0.0], [0.5, -1.0], [1.4, 0.0]]), 0.0)
    assert not wedge.symmetric
    contour = Contour.of_nodes(contour_nodes(wedge, 10), 0.0)
    # ∫ n_4 dl = ∫ (y n_3 - z n_2) dl = -∫ y dy over the waterline = -(1.4² - 1²)/2.
    np.testing.assert_allclose(contour.modes @ contour.length, [0.0, -2.4, -0.48], atol=1e-12)
    assert np.all(np.einsum("ni,ni->n", contour.normal, contour.centre - [0.2, -0.3]) > 0.0)


def test_integrals_of_waves_over_an_element_are_exact() -> None:
    contour = Contour.of_nodes(np.array([[0.3, -1.1], [1.2, -0.4]]), 0.2)
    s = (np.arange(20000) + 0.5) / 20000
    y, z = 0.3 + 0.9 * s, -1.1 + 0.7 * s - 0.2
    expected = np.hypot(0.9, 0.7) * np.exp(2.5 * z - 1.7j * y).mean()
    # The midpoint rule with 20000 points is good to 1e-9.
    assert contour.exponential(np.array([-1.7]), np.array([2.5]))[0, 0] == pytest.approx(expected, rel=1e-8)


def test_the_highest_frequency_has_four_elements_to_a_wave_length() -> None:
    contour = Contour.of_nodes(contour_nodes(Section(0.0, BOX, 0.0), 16), 0.0)
    omega = highest_frequency(contour, 9.81)
    assert 2 * np.pi * 9.81 / omega**2 == pytest.approx(4 * 0.25, rel=1e-12)


class TestRefusals:
    def test_a_hole_below_the_water(self) -> None:
        vertices, panels = cuboid((-5.0, -1.5, -2.0), (5.0, 1.5, 1.0))
        with pytest.raises(PanelsimError, match=r"(?s)x = 1 m does not close.*open end at y = .*1\.500"):
            section_of_mesh(vertices, panels[[0, 1, 3, 4, 5]], 0.0, 1.0)

    def test_an_open_deck_is_no_hole(self) -> None:
        vertices, panels = cuboid((-5.0, -1.5, -2.0), (5.0, 1.5, 1.0))
        open_top = section_of_mesh(vertices, panels[[0, 2, 3, 4, 5]], 0.0, 1.0)
        assert open_top.area == pytest.approx(6.0, abs=1e-12)

    def test_two_hulls(self) -> None:
        port, panels = cuboid((-5.0, 2.0, -2.0), (5.0, 3.0, 1.0))
        vertices = np.vstack([port, port - [0.0, 5.0, 0.0]])
        with pytest.raises(PanelsimError, match=r"(?s)separate parts.*2 parts of 2, 2 m2"):
            section_of_mesh(vertices, np.vstack([panels, panels + 8]), 0.0, 0.0)

    def test_dry(self) -> None:
        vertices, panels = cuboid((-5.0, -1.5, 1.0), (5.0, 1.5, 2.0))
        with pytest.raises(PanelsimError, match=r"dry at x = 0 m"):
            section_of_mesh(vertices, panels, 0.0, 0.0)
        with pytest.raises(PanelsimError, match=r"lowest point 1 m, water at 0 m"):
            sections_of_mesh(vertices, panels, 0.0, 20)

    @pytest.mark.parametrize("count", [4, 0, -3, 7.5])
    def test_too_few(self, count: int) -> None:
        mesh = PanelMesh(*cuboid((-5.0, -1.5, -2.0), (5.0, 1.5, 1.0)))
        with pytest.raises(PanelsimError, match=r"(?s)too few sections.*got: " + str(count)):
            sections_of_mesh(mesh.vertices, mesh.panels, 0.0, count)

    def test_too_few_stations_and_stations_out_of_order(self) -> None:
        sections = tuple(Section(float(x), BOX, 0.0) for x in range(6))
        with pytest.raises(PanelsimError, match=r"(?s)too few.*got: 3"):
            HullSections(sections[:3], 0.0, 5.0)
        with pytest.raises(PanelsimError, match="not ordered"):
            HullSections(sections[::-1], 0.0, 5.0)
        with pytest.raises(PanelsimError, match="not ordered"):
            HullSections(sections, 0.5, 5.0)
        assert HullSections(sections, -0.5, 5.0).strip_length.tolist() == [1.0, 1.0, 1.0, 1.0, 1.0, 0.5]

    @pytest.mark.parametrize(
        ("points", "message"),
        [
            ([[-1.0, -0.5], [0.0, -1.0], [1.0, 0.0]], "does not end at the water"),
            ([[-1.0, 0.0], [-0.5, -1.0], [0.0, 0.5], [0.5, -1.0], [1.0, 0.0]], "rises out of the water"),
            (BOX[::-1], "wrong way round"),
            ([[-1.0, 0.0], [np.nan, -1.0], [1.0, 0.0]], "finite numbers"),
            ([[-1.0, 0.0], [1.0, 0.0]], "too few points"),
        ],
    )
    def test_outlines_that_are_none(self, points: list[list[float]], message: str) -> None:
        with pytest.raises(PanelsimError, match=message):
            Section(3.0, np.array(points), 0.0)

    @pytest.mark.parametrize(
        ("half_breadth", "height", "message"),
        [
            ([0.0, 1.0], [-1.0, -0.2], r"(?s)does not cross the water.*-1 to -0\.2 m"),
            ([0.0, 1.0], [0.2, 1.0], "does not cross the water"),
            ([0.0, -1.0], [-1.0, 1.0], "not half-breadths"),
            ([0.0, np.inf], [-1.0, 1.0], "not half-breadths"),
        ],
    )
    def test_offsets_that_are_none(
        self, half_breadth: list[float], height: list[float], message: str
    ) -> None:
        with pytest.raises(PanelsimError, match=message):
            section_from_offsets(0.0, half_breadth, height, 0.0)

    @pytest.mark.parametrize("count", [7, 6, 0, 1002, 20.0])
    def test_numbers_of_elements(self, count: int) -> None:
        with pytest.raises(PanelsimError, match=r"(?s)number of elements.*got: " + str(count)):
            contour_nodes(Section(0.0, BOX, 0.0), count)


def test_a_bulb_under_water_is_a_closed_section() -> None:
    vertices, panels = cuboid((-5.0, -0.5, -3.0), (5.0, 0.5, -2.0))
    bulb = section_of_mesh(vertices, panels, 0.0, 0.0)
    assert bulb.submerged and bulb.area == pytest.approx(1.0, abs=1e-12)
    assert bulb.breadth == 0.0 and bulb.draft == 3.0
    assert bulb.symmetric


@given(st.floats(0.0, 1.0, exclude_max=True), st.integers(8, 60))
@example(2.477721158389497e-10, 8)  # a corner 1.6e-9 m beside the centreline
@example(1.0 - 2.477721158389497e-10, 8)
def test_a_bulb_is_symmetric_wherever_its_outline_begins(start: float, count: int) -> None:
    angle = 2.0 * np.pi * (start + np.linspace(0.0, 1.0, 4 * count + 1))
    outline = np.stack([np.cos(angle), np.sin(angle) - 3.0], axis=1)
    outline[-1] = outline[0]
    port, off_centre = Section(0.0, outline, 0.0), Section(0.0, outline + np.array([0.5, 0.0]), 0.0)
    # A polygon that begins off the axes is no mirror image of itself, within its sagitta.
    sagitta = 1.0 - np.cos(np.pi / (4 * count))
    assert port.points[0] == pytest.approx([0.0, -2.0], abs=sagitta + 1e-12)
    assert np.array_equal(port.points[0], port.points[-1])
    assert port.along(np.array(0.25)) == pytest.approx([-1.0, -3.0], abs=4.0 / count)
    assert port.area == pytest.approx(2 * count * np.sin(np.pi / (2 * count)), rel=1e-12)
    assert not off_centre.symmetric


@pytest.mark.parametrize("shift", [0, 3, 10, 17, 33])
def test_a_bulb_symmetric_but_for_its_beginning(shift: int) -> None:
    side = np.array([[0.0, -2.0], [-0.8, -2.4], [-1.0, -3.0], [-0.5, -3.6], [0.0, -3.8]])
    fine = np.vstack([np.linspace(a, b, 8, endpoint=False) for a, b in pairwise(side)])
    loop = np.vstack([fine, side[-1:], (fine * [-1.0, 1.0])[:0:-1]])
    loop = np.roll(loop, shift, axis=0)
    section = Section(0.0, np.vstack([loop, loop[:1]]), 0.0)
    assert section.symmetric and section.submerged
    assert section.points[0] == pytest.approx([0.0, -2.0], abs=1e-12)
    nodes = contour_nodes(section, 24)
    assert nodes[::-1] * [-1.0, 1.0] == pytest.approx(nodes, abs=1e-12)


def test_a_small_part_beside_the_section_is_refused_too() -> None:
    """A twentieth of the area, as a rudder beside a hull."""
    (hull, panels), (part, more) = (
        cuboid((-5.0, -2.0, -2.0), (5.0, 2.0, 1.0)),
        cuboid((-5.0, 3.0, -1.0), (5.0, 3.4, 1.0)),
    )
    with pytest.raises(PanelsimError, match="separate parts below the water") as refused:
        section_of_mesh(np.vstack([hull, part]), np.vstack([panels, more + len(hull)]), 0.0, 0.0)
    assert "8, 0.4 m2" in str(refused.value) or "0.4, 8 m2" in str(refused.value)
