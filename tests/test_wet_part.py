"""The wet part of a surface and the lines that bound it, point by point and on surfaces that are no ship."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import RULES, panel_triangles
from panelsim.errors import PanelsimError
from panelsim.kernels import oracle
from panelsim.kernels.tables import PanelTables, panel_tables, wave_tables
from panelsim.kernels.waterline import waterlines
from panelsim.kernels.wet_part import (
    area_vectors,
    cut_triangles,
    linear_loads,
    wet_part,
    wet_triangles,
    with_mean_centres,
)

ROUNDING = 1e-13  # of a few sums of numbers near 1
reproducible = settings(deadline=None, derandomize=True, database=None, max_examples=60)
heights = st.lists(st.sampled_from([-1.3, -0.4, 0.0, 0.3, 1.0]), min_size=3, max_size=3)


def sheet(m: int, n: int) -> PanelTables:
    """m x n square panels of 1 m in the plane z = y, seen from below: normals (0, 1, -1)/√2."""
    x, y = np.meshgrid(np.arange(m + 1.0), np.arange(n + 1.0), indexing="ij")
    index = np.arange(x.size).reshape(x.shape)
    corners = (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    vertices = np.stack([x, y, y], axis=-1).reshape(-1, 3)
    return panel_tables(vertices, np.stack(corners, axis=-1).reshape(-1, 4))


def still_water(panels: PanelTables, level: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Depth, pressure and pressure to a cut, ρ g = 1, of calm water at z = level."""
    depth = level - panels.points[:, 2]
    return depth, depth.copy(), np.zeros_like(depth)


# --- triangles -----------------------------------------------------------------------------------


@reproducible
@given(heights, st.floats(0.1, 2.0), st.floats(-1.0, 1.0))
def test_what_is_kept_and_what_is_cut_away_make_the_triangle(
    level: list[float], width: float, skew: float
) -> None:
    """Area and first moment of both sides of the cut, which lies where the level is 0."""
    corners = np.array([[[0.0, 0.0, 0.0], [width, 0.1, 0.2], [skew, 1.0, -0.3]]])
    depth = np.array([level])
    area, moment = np.zeros(3), np.zeros(3)
    for kept in (depth > 0.0, depth <= 0.0):
        tips, of_tip, rests, of_rest = cut_triangles(corners, corners, depth, kept)
        whole = corners[kept.all(axis=1)]
        pieces = np.concatenate([whole, tips, rests[:, [0, 1, 2]], rests[:, [0, 2, 3]]])
        area += area_vectors(pieces).sum(axis=0)
        moment += np.linalg.norm(area_vectors(pieces), axis=1) @ pieces.mean(axis=1)
        assert len(tips) + len(rests) == (0 < kept.sum() < 3)
        assert (np.concatenate([of_tip, of_rest]) == 0).all()
    expected = area_vectors(corners)[0]
    np.testing.assert_allclose(area, expected, atol=ROUNDING)
    np.testing.assert_allclose(moment, np.linalg.norm(expected) * corners[0].mean(axis=0), atol=ROUNDING)


@reproducible
@given(heights)
def test_wet_triangles_reach_to_the_surface_and_no_further(level: list[float]) -> None:
    """Pressure 7 at the cuts, 1 at the corners: which of them a piece has says where it ends."""
    corners = np.array([[[0.0, 0.0, level[0]], [2.0, 0.0, level[1]], [0.3, 1.0, level[2]]]])
    depth = -corners[..., 2]
    wet, pressure, weight, origin = wet_triangles(corners, depth, np.ones((1, 3)), np.full((1, 3), 7.0))
    assert (wet[..., 2] <= ROUNDING).all() and (origin == 0).all()
    np.testing.assert_array_equal(pressure.reshape(-1) == 7.0, np.abs(wet[..., 2].reshape(-1)) < ROUNDING)
    if (depth > 0.0).all():
        np.testing.assert_array_equal(wet, corners)
    assert set(weight) <= {0.5, 1.0}


def test_load_of_a_linear_pressure_on_a_triangle() -> None:
    """Against the mean over a fine regular subdivision, each part at its own centre."""
    corners, pressure = (
        np.array([[[1.0, 0.0, 0.2], [3.0, 0.5, 0.0], [0.5, 2.0, 1.0]]]),
        np.array([[2.0, -1.0, 5.0]]),
    )
    n = 400
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    up = np.stack([i + 1 / 3, j + 1 / 3], axis=-1)[i + j < n]
    down = np.stack([i + 2 / 3, j + 2 / 3], axis=-1)[i + j < n - 1]
    share = np.concatenate([up, down]) / n
    share = np.column_stack([1 - share.sum(axis=1), share])
    points, p = share @ corners[0], share @ pressure[0]
    part = area_vectors(corners)[0] / n**2
    expected = -np.concatenate([p.sum() * part, np.cross(p @ points, part)])
    # The product of two linear functions, each part at one point: 1/n² of it is left out.
    np.testing.assert_allclose(linear_loads(corners, pressure)[0], expected, rtol=10 / n**2)


# --- panels --------------------------------------------------------------------------------------


def test_wet_triangles_name_their_panel_in_the_order_of_the_mesh() -> None:
    """Panels given from top to bottom, which the tables turn round."""
    vertices = np.array([[x, y, z] for z in (2.0, 1.0, 0.0) for x, y in ((0, 0), (0, 3 - z))], dtype=float)
    panels = panel_tables(vertices, np.array([[0, 2, 3, 1], [2, 4, 5, 3]]))
    assert panels.panel_order.tolist() == [1, 0]
    for rule in RULES:
        part = wet_part(panels, still_water(panels, 0.9), rule=rule, stretching="wheeler", weight_density=1.0)
        assert set(part.panel) == {1}
    part = wet_part(panels, still_water(panels, 1.5), rule="vertex", stretching="wheeler", weight_density=1.0)
    area = np.bincount(part.panel, part.area)
    # 1 m deep and 1 to 2, then 2 to 3 m wide; of the upper one the lower half is wet.
    np.testing.assert_allclose(area, [0.5 * 1.75, 2.5], rtol=ROUNDING)


@pytest.mark.parametrize("count", [0, 3])
def test_whole_panels_by_their_centres_as_the_report_has_them(count: int) -> None:
    """Each wet panel: -p n A at the centre of its area, summed one by one; and the tables' response."""
    random = np.random.default_rng(7)
    panels = sheet(4, 5)
    vertices = panels.points[:30] * [1.0, 1.0, 0.4] + random.uniform(-0.2, 0.2, (30, 3))
    surface = panel_tables(vertices, panels.panels)
    k = np.linspace(0.3, 0.9, count)
    waves = wave_tables(0.2 + 0 * k, k, 2.0 + k, 1.0 + k, 3.0 * k)
    pose = np.array([2.0, 1.0, 0.3, -0.2, -1.0, 0.2, 0.1, 0.3])
    water = {"waterline": 0.1, "water_density": 2.0, "gravity": 3.0}
    for stretching in ("wheeler", "none"):
        found = oracle.wetted_surface_load(
            surface, waves, pose[None], rule="panel", stretching=stretching, **water
        )[0]
        around = oracle.Surroundings(waves, pose, 0.1, 6.0, stretching)
        expected, by_response = np.zeros(6), np.zeros(6)
        for n, triangles in enumerate(panel_triangles(surface.points, surface.panels)):
            depth, pressure, _ = around.at(triangles[0, 0])
            if depth > 0.0:
                for a, b, c in triangles:
                    force = -pressure * 0.5 * np.cross(b - a, c - a)
                    expected += np.concatenate([force, np.cross((a + b + c) / 3.0, force)])
                by_response += pressure * surface.response["panel"][surface.first_centre + n]
        assert abs(expected[2]) > 0.1
        np.testing.assert_allclose(found, expected, atol=1e-12 * np.abs(expected).max())
        np.testing.assert_allclose(found, by_response, atol=1e-12 * np.abs(expected).max())


def test_the_rule_of_vertices_reads_no_centres() -> None:
    panels = sheet(2, 3)
    values = still_water(panels, 1.3)
    spoilt = [with_mean_centres(panels, own) for own in values]
    for own in spoilt:
        own[panels.first_centre :] = np.nan
    given = {"rule": "vertex", "stretching": "wheeler", "weight_density": 1.0}
    expected = wet_part(panels, values, **given).loads.sum(axis=0)
    np.testing.assert_allclose(wet_part(panels, spoilt, **given).loads.sum(axis=0), expected, rtol=ROUNDING)


def test_unknown_rules_and_stretchings_are_refused() -> None:
    panels = sheet(1, 1)
    values = still_water(panels, 0.5)
    with pytest.raises(PanelsimError, match=r"simpson[\s\S]*vertex\+centre"):
        wet_part(panels, values, rule="simpson", stretching="wheeler", weight_density=1.0)
    with pytest.raises(PanelsimError, match="airy"):
        wet_part(panels, values, rule="vertex", stretching="airy", weight_density=1.0)
    with pytest.raises(PanelsimError, match="simpson"):
        waterlines(panels, values[0], "simpson")


# --- lines ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("rule", ["vertex", "vertex+centre"])
@pytest.mark.parametrize("level", [0.5, 1.25, 2.0])
def test_an_open_surface_has_an_open_line_from_rim_to_rim(rule: str, level: float) -> None:
    """The water to port of a sloping side, its normal (0, 1, -1): seen from above the hull is on its left."""
    closed, lines = waterlines(sheet(3, 4), still_water(sheet(3, 4), level)[0], rule)
    assert closed == ()
    (line,) = lines
    np.testing.assert_allclose(line[:, 1:], level, atol=ROUNDING)
    assert (np.diff(line[:, 0]) < 0.0).all()
    np.testing.assert_allclose(line[[0, -1], 0], [3.0, 0.0], atol=ROUNDING)


def test_a_crest_inside_a_panel_has_a_line_that_only_centres_see() -> None:
    panels = sheet(1, 1)
    depth = np.full(len(panels.points), -1.0)
    depth[panels.first_centre] = 1.0
    assert waterlines(panels, depth, "vertex") == ((), ())
    (line,), lines = waterlines(panels, depth, "vertex+centre")
    assert lines == ()
    np.testing.assert_allclose(
        np.linalg.norm(line - [0.5, 0.5, 0.5], axis=1), 0.5 * np.sqrt(0.75), rtol=1e-12
    )


def test_wet_panels_that_meet_at_a_vertex_have_lines_of_their_own() -> None:
    """Two of four panels, across from each other: no polygon passes a point twice."""
    panels = sheet(2, 2)
    depth = np.full(len(panels.points), -1.0)
    middle = panels.points[panels.first_centre :][:4]
    depth[panels.first_centre : panels.first_centre + 4] = np.where(middle[:, 0] == middle[:, 1], 1.0, -1.0)
    closed, lines = waterlines(panels, depth, "panel")
    assert lines == () and [len(line) for line in closed] == [4, 4]
    assert all(len(np.unique(line, axis=0)) == 4 for line in closed)
    triangle = panel_tables(np.eye(3), np.array([[0, 1, 2, 2]]))
    (line,), _ = waterlines(triangle, np.ones(len(triangle.points)), "panel")
    assert len(line) == 3
    everything, lines = waterlines(panels, np.ones(len(panels.points)), "panel")
    assert lines == () and [len(line) for line in everything] == [8]


def test_an_edge_or_a_panel_on_the_surface_is_dry() -> None:
    """A roof of two panels whose ridge is on the surface has a line on each side; a panel there has none."""
    vertices = np.array([[0, 0, 0], [2, 0, 0], [0, 1, -1], [2, 1, -1], [0, -1, -1], [2, -1, -1]], dtype=float)
    roof = panel_tables(vertices, np.array([[0, 1, 3, 2], [1, 0, 4, 5]]))
    closed, lines = waterlines(roof, -roof.points[:, 2], "vertex+centre")
    assert closed == () and [line[:, 1:].any() for line in lines] == [False, False]
    flat = panel_tables(vertices[:4] * [1, 1, 0], np.array([[0, 1, 3, 2]]))
    assert waterlines(flat, np.zeros(len(flat.points)), "vertex+centre") == ((), ())
