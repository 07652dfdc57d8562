"""check_mesh finds each fault that a mesh can have, names the panels, and never raises."""

import numpy as np
import pytest

from panelsim.errors import PanelsimError
from panelsim.hull.checks import check_mesh, require_sound
from panelsim.hull.panel_mesh import PanelMesh

BOX_PANELS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def box_vertices(length=20.0, beam=8.0, depth=5.0):
    x, y, z = np.meshgrid([-length / 2, length / 2], [-beam / 2, beam / 2], [0.0, depth], indexing="ij")
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)


def box():
    return PanelMesh(box_vertices(), BOX_PANELS)


def with_panels(panels):
    return PanelMesh(box_vertices(), np.array(panels))


def test_sound_box_has_no_problems_and_the_right_figures():
    report = check_mesh(box())
    assert report.problems == ()
    assert report.warnings == ()
    assert (report.closed, report.outward, report.symmetric) == (True, True, True)
    assert report.volume == pytest.approx(20.0 * 8.0 * 5.0, rel=1e-12)  # rounding
    assert report.area == pytest.approx(2 * (20 * 8 + 20 * 5 + 8 * 5), rel=1e-12)  # rounding
    assert report.size == pytest.approx([20.0, 8.0, 5.0])
    require_sound(box())


def test_triangles_with_a_repeated_third_vertex_are_sound():
    panels = [*BOX_PANELS[:5], [1, 5, 7, 7], [1, 7, 3, 3]]
    assert check_mesh(with_panels(panels)).problems == ()


def test_missing_panel_leaves_a_hole_whose_rim_is_named():
    report = check_mesh(with_panels(BOX_PANELS[:5]))
    assert not report.closed
    assert report.problems == ("4 panels lie at the rim of a hole (4 edges): 0, 1, 2, 3",)


def test_panel_turned_inward_is_told_from_a_hole():
    panels = BOX_PANELS.copy()
    panels[2] = panels[2, ::-1]
    report = check_mesh(with_panels(panels))
    assert not report.closed
    assert "turned against their neighbour" in report.problems[0]
    assert "(4 edges)" in report.problems[0]


def test_mesh_inside_out_is_closed_but_not_outward():
    report = check_mesh(with_panels(BOX_PANELS[:, ::-1]))
    assert report.closed
    assert not report.outward
    assert "inside out, volume -800 m3" in report.problems[0]
    with pytest.raises(PanelsimError, match="inside out"):
        require_sound(with_panels(BOX_PANELS[:, ::-1]))


def test_one_part_inside_out_is_found_beside_a_larger_sound_part():
    small = 0.1 * box_vertices() + np.array([50.0, 0.0, 0.0])
    panels = np.concatenate([BOX_PANELS, BOX_PANELS[:, ::-1] + 8])
    report = check_mesh(PanelMesh(np.concatenate([box_vertices(), small]), panels))
    assert report.component_count == 2
    assert report.volume > 0.0
    assert report.problems == ("part 2 of 2 (6 panels) is inside out, volume -0.8 m3",)


def test_third_panel_at_an_edge_and_a_repeated_panel_are_named():
    report = check_mesh(with_panels([*BOX_PANELS, BOX_PANELS[3]]))
    assert "1 panels repeat another panel: 6" in report.problems
    same_triangle = [*BOX_PANELS, [0, 1, 3, 3], [1, 3, 0, 0]]
    assert "1 panels repeat another panel: 7" in check_mesh(with_panels(same_triangle)).problems
    assert any("meet more than one other panel" in problem for problem in report.problems)


@pytest.mark.parametrize("corners", [[0, 0, 1, 3], [0, 1, 0, 3], [1, 3, 2, 1], [0, 1, 1, 1]])
def test_corners_repeated_otherwise_than_in_a_triangle_are_degenerate(corners):
    report = check_mesh(with_panels([*BOX_PANELS, corners]))
    assert any("corners that repeat" in problem and problem.endswith(": 6") for problem in report.problems)


def test_panel_without_area_is_degenerate():
    vertices = np.concatenate([box_vertices(), [[-10.0, 0.0, 0.0]]])  # on the middle of an edge of the stern
    report = check_mesh(PanelMesh(vertices, np.array([*BOX_PANELS, [0, 8, 2, 2]])))
    assert any("no area" in problem and problem.endswith(": 6") for problem in report.problems)


def test_first_ten_bad_panels_are_named_and_all_are_counted():
    report = check_mesh(with_panels([*BOX_PANELS, *[BOX_PANELS[0]] * 25]))
    assert "25 panels repeat another panel: 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, …" in report.problems


def test_symmetry_is_judged_relative_to_the_size_of_the_ship():
    vertices = box_vertices()
    for shift, symmetric in ((1e-5, True), (1e-3, False)):  # of 20 m: below and above 1e-6
        moved = vertices.copy()
        moved[0, 1] += shift
        for scale in (0.01, 1.0, 100.0):
            assert check_mesh(PanelMesh(scale * moved, BOX_PANELS)).symmetric == symmetric


def test_mirrored_triangles_may_repeat_different_corners():
    vertices = np.concatenate([box_vertices(), [[12.0, 0.0, 2.0]]])  # a bow of four triangles
    for bow in (
        [[4, 6, 8, 8], [6, 7, 8, 8], [7, 5, 8, 8], [5, 4, 8, 8]],
        [[4, 6, 8, 8], [7, 8, 6, 6], [5, 8, 7, 7], [5, 4, 8, 8]],
    ):
        report = check_mesh(PanelMesh(vertices, np.array([*np.delete(BOX_PANELS, 1, axis=0), *bow])))
        assert report.problems == ()
        assert report.symmetric


def test_diagonals_that_are_not_mirrored_make_the_mesh_asymmetric():
    ends = BOX_PANELS[:4]
    mirrored = [*ends, [0, 2, 6, 4], [1, 5, 7, 3]]
    split_deck = [*ends, [0, 2, 6, 4], [1, 5, 7, 7], [1, 7, 3, 3]]
    assert check_mesh(with_panels(mirrored)).symmetric
    report = check_mesh(with_panels(split_deck))
    assert not report.symmetric
    assert any("not mirrored" in warning for warning in report.warnings)


def test_slivers_twists_and_folds_are_warnings():
    assert any("slivers" in w for w in check_mesh(PanelMesh(box_vertices(beam=0.1), BOX_PANELS)).warnings)
    twisted = box_vertices()
    twisted[0, 0] += 8.0
    assert any("twisted" in w for w in check_mesh(PanelMesh(twisted, BOX_PANELS)).warnings)
    folded = box_vertices()
    folded[7] = [-2.0, -1.0, 5.0]  # a corner of the deck inside the triangle of the other three
    assert any("re-entrant" in w for w in check_mesh(PanelMesh(folded, BOX_PANELS)).warnings)


def test_panels_too_long_for_the_waves_are_named():
    assert check_mesh(box(), wave_length=161.0).warnings == ()
    (warning,) = check_mesh(box(), wave_length=159.0).warnings
    assert warning == "4 panels are longer along the hull than 1/8 of the wave of 159 m: 2, 3, 4, 5"


def test_unused_and_unmerged_vertices_are_warnings():
    vertices = np.concatenate([box_vertices(), [[0.0, 0.0, 2.0]]])
    assert check_mesh(PanelMesh(vertices, BOX_PANELS)).warnings == ("1 vertices belong to no panel",)
    soup = PanelMesh(box_vertices()[BOX_PANELS].reshape(-1, 3), np.arange(24).reshape(6, 4))
    report = check_mesh(soup)
    assert not report.closed
    assert any("not merged" in warning for warning in report.warnings)


@pytest.mark.parametrize(
    ("vertices", "panels", "problem"),
    [
        (np.zeros((0, 3)), np.zeros((0, 4), dtype=int), "no panels"),
        (box_vertices(), BOX_PANELS + 1, "outside 0 to 7"),
        (box_vertices() * np.nan, BOX_PANELS, "8 vertices are not finite"),
        (box_vertices()[:, :2], BOX_PANELS, "arrays are not"),
        (box_vertices(), BOX_PANELS[:, :3], "arrays are not"),
    ],
)
def test_arrays_that_are_no_mesh_are_reported_not_raised(vertices, panels, problem):
    report = check_mesh(PanelMesh(vertices, panels))
    assert problem in report.problems[0]
    assert "problem: " in report.summary()


def test_all_vertices_in_one_point_is_reported_not_raised():
    report = check_mesh(PanelMesh(np.ones((8, 3)), BOX_PANELS))
    assert report.problems


def test_summary_reads_as_text():
    text = check_mesh(with_panels(BOX_PANELS[:5]), wave_length=50.0).summary()
    assert text.splitlines()[:3] == [
        "5 panels, 8 vertices, 1 connected part",
        "length 20 m, beam 8 m, depth 5 m, area 440 m2, volume 666.667 m3",
        "closed: no   normals outward: yes   symmetric about the centreline: yes",
    ]
    assert "problem: 4 panels lie at the rim of a hole" in text
    assert "warning: " in text
