"""The tables of the pressure kernel: geometry alone, so no waves and no Taichi."""

import numpy as np
import pytest

from panelsim.conventions import CUT_RULES, panel_triangles
from panelsim.errors import PanelsimError
from panelsim.kernels import tables
from panelsim.kernels.tables import panel_tables, wave_tables

ROUND_OFF = 1e-13  # a few hundred terms of order one summed in double precision

# A box of 6 x 4 x 2 m off the origin, corners numbered by the bits of (x, y, z).
LOW, SIZE = np.array([-1.0, 1.0, -3.0]), np.array([6.0, 4.0, 2.0])
BOX = LOW + SIZE * np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)])
BOX_PANELS = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])


def crooked_box() -> np.ndarray:
    """The box with its corners moved, so that no panel is plane."""
    return BOX + np.random.default_rng(4).uniform(-0.4, 0.4, BOX.shape)


def load_of_linear_pressure(
    built: tables.PanelTables, rule: str, gradient: np.ndarray, offset: float
) -> np.ndarray:
    return (built.points @ gradient + offset) @ built.response[rule]


@pytest.mark.parametrize("rule", CUT_RULES)
def test_uniform_pressure_on_a_closed_surface_gives_no_load(rule: str) -> None:
    built = panel_tables(crooked_box(), BOX_PANELS)
    assert np.abs(built.response[rule]).max() > 1.0
    np.testing.assert_allclose(built.response[rule].sum(axis=0), 0.0, atol=ROUND_OFF)


@pytest.mark.parametrize("rule", CUT_RULES)
def test_hydrostatic_pressure_gives_volume_and_centre_of_the_box(rule: str) -> None:
    built = panel_tables(BOX, BOX_PANELS)
    volume, (x, y, _) = SIZE.prod(), LOW + SIZE / 2
    load = load_of_linear_pressure(built, rule, np.array([0.0, 0.0, -1.0]), 7.0)
    np.testing.assert_allclose(load, volume * np.array([0, 0, 1, y, -x, 0]), atol=100 * ROUND_OFF)


@pytest.mark.parametrize("rule", CUT_RULES)
def test_any_linear_pressure_acts_as_its_gradient_on_the_centroid_of_a_crooked_box(rule: str) -> None:
    """Divergence theorem: the force is -V grad p, its moment that at the centroid of the volume."""
    built = panel_tables(crooked_box(), BOX_PANELS)
    loads = np.array([load_of_linear_pressure(built, rule, -axis, 0.0) for axis in np.eye(3)])
    volume = loads[0, 0]
    np.testing.assert_allclose(loads[:, :3], volume * np.eye(3), atol=100 * ROUND_OFF)
    x, y, z = loads[1, 5] / volume, loads[2, 3] / volume, loads[0, 4] / volume
    cross = np.array([np.cross([x, y, z], axis) for axis in np.eye(3)])
    np.testing.assert_allclose(loads[:, 3:], volume * cross, atol=1000 * ROUND_OFF)
    assert (np.array([x, y, z]) > LOW).all() and (np.array([x, y, z]) < LOW + SIZE).all()


def test_a_panel_with_its_third_vertex_repeated_is_the_plain_triangle() -> None:
    corners = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 1.0], [0.0, 2.0, 2.0]])
    built = panel_tables(corners, np.array([[0, 1, 2, 2]]))
    area_vector = np.cross(corners[1], corners[2]) / 2
    third = np.tile(-area_vector / 3, (3, 1))
    response = built.response["vertex"]
    np.testing.assert_allclose(response[:3, :3], third, atol=ROUND_OFF)
    # The moment of unit pressure at one corner: the integral of its area coordinate times position.
    for point, position in zip(response[:3], built.points[:3], strict=True):
        arm = (position + corners.sum(axis=0)) / 12
        np.testing.assert_allclose(point[3:], -np.cross(arm, area_vector), atol=ROUND_OFF)


CROOKED = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [1.3, 1.0, 1.0], [0.0, 1.0, 1.4]])


def test_a_quadrilateral_is_four_triangles_about_its_centre() -> None:
    """By the linear rule, a centre that is a vertex of four triangles, its response handed to the corners."""
    apex = np.vstack([CROOKED, CROOKED.mean(axis=0)])
    fan = panel_tables(apex, np.array([[4, i, (i + 1) % 4, (i + 1) % 4] for i in range(4)]))
    one = panel_tables(CROOKED, np.array([[0, 1, 2, 3]]))
    middle = np.flatnonzero((fan.points[:8] == apex[4]).all(axis=1))[0]
    expected = np.delete(fan.response["vertex"][:8], middle, axis=0)[:4] + fan.response["vertex"][middle] / 4
    np.testing.assert_allclose(one.response["vertex"][:4], expected, atol=ROUND_OFF)
    split = panel_tables(CROOKED, np.array([[0, 1, 2, 2], [0, 2, 3, 3]]))
    assert np.abs(one.response["vertex"] - split.response["vertex"][:16]).max() > 0.01


@pytest.mark.parametrize(
    ("corners", "panel", "centre"),
    [
        ([[0, 0, 0], [3, 1, 0], [4, 3, 0], [1, 2, 0]], [0, 1, 2, 3], 2 / 3),
        ([[0, 0, 0], [3, 1, 0], [1, 2, 0]], [0, 1, 2, 2], 3 / 4),
    ],
)
def test_a_quadratic_pressure_is_integrated_exactly_with_the_centre(
    corners: list[list[float]], panel: list[int], centre: float
) -> None:
    """On a parallelogram and a triangle: corners 1/12 of the area each; the linear rule is off."""
    built = panel_tables(np.array(corners, dtype=float), np.array([panel]))
    area = 5.0 if panel[3] == 3 else 2.5
    force = -built.response["vertex+centre"][:, 2] / area
    np.testing.assert_allclose(force[: len(corners)], 1 / 12, atol=ROUND_OFF)
    assert force[built.first_centre] == pytest.approx(centre, abs=ROUND_OFF)

    def pressure(x: np.ndarray) -> np.ndarray:
        return 1.0 + 2.0 * x[:, 0] - x[:, 1] + 3.0 * x[:, 0] ** 2 - 5.0 * x[:, 0] * x[:, 1] + x[:, 1] ** 2

    # The same integral by midpoints of edges, exact to the second degree, on the triangles of the panel.
    exact = 0.0
    for a, b, c in panel_triangles(np.array(corners, dtype=float), np.array([panel]))[0]:
        middles = np.array([a + b, b + c, c + a]) / 2
        exact += pressure(middles).mean() * np.cross(b - a, c - a)[2] / 2
    used = np.r_[: len(corners), built.first_centre]
    load = pressure(built.points[used]) @ built.response["vertex+centre"][used]
    assert -load[2] == pytest.approx(exact, rel=ROUND_OFF)
    linear = pressure(built.points[used]) @ built.response["vertex"][used]
    assert abs(-linear[2] / exact - 1.0) > 0.1


def test_the_bend_of_the_pressure_acts_at_the_centre() -> None:
    """Moment of unit pressure at the centre alone: that of the triangles, and of the bend at its arm."""
    built = panel_tables(CROOKED, np.array([[0, 1, 2, 3]]))
    triangles = panel_triangles(CROOKED, np.array([[0, 1, 2, 3]]))[0]
    area = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    arm = (triangles[:, 0] + triangles.sum(axis=1)) / 12
    moment = -np.cross(arm, area).sum(axis=0) - np.cross(CROOKED.mean(axis=0), area.sum(axis=0)) / 3
    response = built.response["vertex+centre"]
    np.testing.assert_allclose(response[built.first_centre, 3:], moment, atol=ROUND_OFF)
    # A pressure that is the same all over has no bend.
    np.testing.assert_allclose(response.sum(axis=0), built.response["vertex"].sum(axis=0), atol=ROUND_OFF)


def test_points_are_ordered_by_height_and_filled_up_with_copies() -> None:
    vertices = np.vstack([crooked_box(), [[0.5, 3.0, 5.0]]])
    built = panel_tables(vertices, BOX_PANELS)
    assert built.points.shape == (24, 3) and built.first_centre == 16
    assert (np.diff(built.points[:16, 2]) >= 0).all() and (np.diff(built.points[16:, 2]) >= 0).all()
    inert = np.r_[9:16, 22:24]
    np.testing.assert_array_equal(built.points[inert], built.points[np.repeat([8, 21], [7, 2])])
    np.testing.assert_array_equal(built.reach[inert], 0.0)
    assert not np.isin(built.panels, inert).any()
    centres = built.points[built.panels].mean(axis=1)
    np.testing.assert_allclose(built.points[16:22], centres, atol=ROUND_OFF)
    order = np.argsort(vertices[BOX_PANELS].mean(axis=1)[:, 2])
    np.testing.assert_array_equal(built.points[built.panels], vertices[BOX_PANELS[order]])
    np.testing.assert_array_equal(built.panel_order, order)
    for rule in CUT_RULES:
        assert built.blocks[rule].shape == (3, 10, 8)
        np.testing.assert_array_equal(built.response[rule][np.r_[8, inert]], 0.0)
        np.testing.assert_array_equal(built.blocks[rule][1, :3, 0], built.points[8])
        np.testing.assert_array_equal(built.blocks[rule][2, 3:9, 5], built.response[rule][21])
    assert not built.response["vertex"][16:].any()


def test_spans_hold_every_panel_that_has_a_point_of_the_block() -> None:
    panels = np.vstack([BOX_PANELS, BOX_PANELS[::-1] + 8])
    built = panel_tables(np.vstack([BOX, np.add(BOX, [0.0, 0.0, 9.0])]), panels)  # a box above a box
    owners = np.column_stack([built.panels, built.first_centre + np.arange(12)]) // 8
    for block, (begin, end) in enumerate(built.spans):
        having = np.flatnonzero((owners == block).any(axis=1))
        assert (begin, end) == (having[0], having[-1] + 1)
    assert built.spans.tolist() == [[0, 6], [6, 12], [0, 8], [8, 12]]
    np.testing.assert_array_equal(built.corners[5, 3:6], built.points[built.panels[5, 1]])


def test_reach_is_the_longest_edge_or_diagonal_at_a_point_and_half_a_diagonal_at_a_centre() -> None:
    built = panel_tables(BOX, BOX_PANELS)
    np.testing.assert_allclose(built.reach[:8], np.hypot(6.0, 4.0), rtol=ROUND_OFF)
    diagonals = np.linalg.norm(np.ptp(built.points[built.panels], axis=1), axis=1)
    np.testing.assert_allclose(built.reach[8:14], diagonals / 2, rtol=ROUND_OFF)


def test_wave_numbers_point_where_the_waves_travel() -> None:
    """ζ = a cos(k(x cos β - y sin β) - ...): waves from port (β = 90°) run towards -y."""
    built = wave_tables([1.0, 2.0], [0.3, 0.1], [np.pi / 2, np.pi], [0.4, 0.9], [0.0, 1.0])
    np.testing.assert_allclose(built.wavenumber_x, [0.0, -0.1], atol=ROUND_OFF)
    np.testing.assert_allclose(built.wavenumber_y, [-0.3, 0.0], atol=ROUND_OFF)
    assert wave_tables([], [], [], [], []).columns.shape == (0, 6)


@pytest.mark.parametrize(
    ("vertices", "panels", "told"),
    [
        (BOX[:, :2], BOX_PANELS, "(8, 2)"),
        (BOX, BOX_PANELS[:, :3], "(6, 3)"),
        (BOX, BOX_PANELS + 1, "1 to 8"),
        (BOX, BOX_PANELS - 1, "-1 to 6"),
        (BOX, BOX_PANELS.astype(float), "float64"),
        (np.vstack([[np.nan, 0.0, 0.0], BOX[1:]]), BOX_PANELS, "vertex 0"),
    ],
)
def test_a_bad_surface_is_refused_with_its_numbers(
    vertices: np.ndarray, panels: np.ndarray, told: str
) -> None:
    with pytest.raises(PanelsimError) as refused:
        panel_tables(vertices, panels)
    assert told in str(refused.value)


def test_bad_wave_components_are_refused() -> None:
    with pytest.raises(PanelsimError, match=r"\(2,\)"):
        wave_tables([1.0, 1.0], [0.1], [0.0], [0.5], [0.0])
    with pytest.raises(PanelsimError, match="nan"):
        wave_tables([np.nan], [0.1], [0.0], [0.5], [0.0])
    with pytest.raises(PanelsimError, match=r"-0\.1"):
        wave_tables([1.0], [-0.1], [0.0], [0.5], [0.0])
