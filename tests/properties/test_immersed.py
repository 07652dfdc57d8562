"""Cutting a surface at the water: exact, additive, and the same under every symmetry of the plane."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import rotation_to_earth
from panelsim.hull.hydrostatics import hydrostatics
from panelsim.hull.immersed import immersed_part, immersed_triangles
from panelsim.hull.panel_mesh import PanelMesh

ROUNDING = 1e-12  # relative: short sums in double precision
reproducible = settings(derandomize=True, database=None, max_examples=60)

angles = st.floats(-0.6, 0.6)
shifts = st.floats(-5.0, 5.0)


def wedge_hull():
    """A closed hull of 28 quadrilaterals, none flat, with a keel line, mirrored in the centreline."""
    x = np.array([-9.0, -5.0, 0.0, 4.0, 10.0])
    half = np.array([1.5, 2.6, 3.0, 2.4, 0.4])
    keel = np.stack([x, np.zeros(5), np.array([0.9, 0.1, 0.0, 0.2, 1.0])], axis=1)
    bilge = np.stack([0.98 * x, 0.8 * half, np.array([2.0, 1.4, 1.2, 1.5, 2.4])], axis=1)
    deck = np.stack([1.05 * x, half + 0.5, np.array([4.0, 3.8, 3.7, 3.9, 4.6])], axis=1)
    middle = deck * np.array([1.0, 0.0, 1.0])
    flip = np.array([1.0, -1.0, 1.0])
    rows = [keel, bilge, deck, middle, deck * flip, bilge * flip]
    index = np.arange(30).reshape(6, 5)
    around = np.roll(index, -1, axis=0)
    walls = np.stack([index[:, :-1], around[:, :-1], around[:, 1:], index[:, 1:]], axis=-1).reshape(-1, 4)
    ends = []
    for column, forward in ((0, False), (4, True)):
        k, b, d, m, e, c = index[:, column]
        caps = [[k, b, d, m], [m, e, c, k]]
        ends += [cap if forward else cap[::-1] for cap in caps]
    return PanelMesh(np.concatenate(rows), np.concatenate([walls, ends]))


HULL = wedge_hull()


def areas(corners):
    return 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )


def test_hull_of_these_tests_is_closed_and_outward():
    part = immersed_part(HULL, heel=0.0, trim=0.0, waterline=100.0)
    assert np.abs(HULL.area_vector.sum(axis=0)).max() < ROUNDING * HULL.area.sum()
    assert part.volume > 0.0
    assert abs(part.waterplane_area) < ROUNDING * HULL.area.sum()


@pytest.mark.parametrize("heights", list(itertools.product([-1.0, 0.0, 2.0], repeat=3)))
def test_every_pattern_of_corners_keeps_the_wet_area_and_its_sense(heights):
    triangle = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    triangle[:, 2] = heights
    corners, origin = immersed_triangles(triangle[None], 0.0)
    assert np.all(corners[..., 2] <= 0.0)
    wet = np.array(heights) < 0.0
    if not wet.any():
        assert len(corners) == 0
        return
    whole = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    pieces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # The plan area 3 m2 is cut where heights vanish along the edges: the share of a corner is the product
    # of its two edge fractions, and a fraction is 1/3 from -1 to 2 and 1 from -1 to 0.
    fraction = {-1.0: 1.0, 0.0: 1.0, 2.0: 1.0 / 3.0}
    dry_share = {-1.0: 2.0 / 3.0, 0.0: 0.0}
    if wet.sum() == 1:
        share = np.prod([fraction[h] for h in np.array(heights)[~wet]])
    elif wet.sum() == 2 and np.array(heights)[~wet][0] > 0.0:
        share = 1.0 - dry_share[-1.0] ** 2
    else:
        share = 1.0
    assert pieces.sum(axis=0) == pytest.approx(share * whole, abs=ROUNDING)
    assert np.all(pieces @ whole >= 0.0)
    assert np.all(origin == 0)


@reproducible
@given(st.lists(st.floats(-3.0, 3.0), min_size=9, max_size=9), st.floats(-3.0, 3.0))
def test_wet_and_dry_parts_make_the_whole_triangle(coordinates, waterline):
    triangle = np.array(coordinates).reshape(3, 3)
    upside_down = triangle * np.array([1.0, 1.0, -1.0])
    below, _ = immersed_triangles(triangle[None], waterline)
    above, _ = immersed_triangles(upside_down[None], -waterline)
    if np.all(triangle[:, 2] == waterline):
        assert len(below) == len(above) == 0  # a triangle in the water plane counts as dry on both sides
        return
    total = areas(below).sum() + areas(above).sum()
    assert total == pytest.approx(areas(triangle[None]).sum(), abs=1e-12)  # areas here are below 40 m2


@reproducible
@given(st.floats(0.5, 4.0), angles, angles, shifts, shifts)
def test_moving_the_hull_along_the_water_moves_only_its_centers(waterline, heel, trim, dx, dy):
    turn = rotation_to_earth(heel, trim, 0.0)
    moved = PanelMesh(HULL.vertices + turn.T @ np.array([dx, dy, 0.0]), HULL.panels)
    here = immersed_part(HULL, heel=heel, trim=trim, waterline=waterline)
    there = immersed_part(moved, heel=heel, trim=trim, waterline=waterline)
    assert there.volume == pytest.approx(here.volume, rel=1e-10, abs=1e-10)  # heights move by rounding
    shift = np.array([dx, dy, 0.0]) * here.volume
    assert there.volume_moment == pytest.approx(here.volume_moment + shift, rel=1e-10, abs=1e-9)
    shift = np.array([dx, dy]) * here.waterplane_area
    assert there.waterplane_moment == pytest.approx(here.waterplane_moment + shift, rel=1e-10, abs=1e-9)


@reproducible
@given(st.floats(0.5, 4.0), angles, angles)
def test_mirrored_attitude_gives_the_mirrored_ship(draft, heel, trim):
    port = hydrostatics(HULL, draft=draft, heel=heel, trim=trim, center_of_gravity=(0.3, 0.2, 2.0))
    starboard = hydrostatics(HULL, draft=draft, heel=-heel, trim=trim, center_of_gravity=(0.3, -0.2, 2.0))
    mirror = np.array([1.0, -1.0, 1.0])
    assert starboard.displaced_volume == pytest.approx(port.displaced_volume, rel=ROUNDING)
    assert starboard.center_of_buoyancy == pytest.approx(mirror * port.center_of_buoyancy, abs=1e-11)
    assert starboard.center_of_flotation == pytest.approx(mirror * port.center_of_flotation, abs=1e-10)
    sign = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    expected = port.stiffness * np.outer(sign, sign)
    assert starboard.stiffness == pytest.approx(expected, abs=1e-11 * np.abs(expected).max())


@reproducible
@given(st.floats(0.2, 4.0), angles, angles)
def test_wet_and_dry_parts_make_the_whole_volume(waterline, heel, trim):
    # The hull upside down (half a turn about x) floats with its former dry part under water.
    below = immersed_part(HULL, heel=heel, trim=trim, waterline=waterline)
    above = immersed_part(
        PanelMesh(HULL.vertices @ rotation_to_earth(heel, trim, 0.0).T, HULL.panels),
        heel=np.pi,
        trim=0.0,
        waterline=-waterline,
    )
    whole = immersed_part(HULL, heel=0.0, trim=0.0, waterline=100.0)
    # cos π and sin π are exact to 1e-16, which moves heights by as much.
    assert below.volume + above.volume == pytest.approx(whole.volume, rel=1e-11)
    assert below.waterplane_area == pytest.approx(above.waterplane_area, rel=1e-9, abs=1e-9)


@reproducible
@given(st.floats(0.3, 3.4), st.floats(0.01, 0.1), angles)
def test_volume_between_two_waterlines_is_the_integral_of_the_waterplane(waterline, rise, heel):
    heights = waterline + rise * np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    parts = [immersed_part(HULL, heel=heel, trim=0.0, waterline=float(h)) for h in heights]
    boole = np.array([7.0, 32.0, 12.0, 32.0, 7.0]) / 90.0
    integral = rise * boole @ [part.waterplane_area for part in parts]
    # The waterplane of a faceted hull is piecewise quadratic in height; a kink inside the step, where
    # a vertex passes the water, leaves at most about rise² times the change of slope.
    assert parts[-1].volume - parts[0].volume == pytest.approx(integral, abs=0.5 * rise**2 * 20.0)
    assert parts[-1].volume > parts[0].volume


@reproducible
@given(st.floats(0.01, 100.0), st.floats(0.5, 4.0), angles)
def test_a_scaled_hull_has_scaled_integrals(scale, draft, heel):
    small = hydrostatics(HULL, draft=draft, heel=heel, center_of_gravity=(0, 0, 2))
    large = hydrostatics(
        PanelMesh(scale * HULL.vertices, HULL.panels),
        draft=scale * draft,
        heel=heel,
        center_of_gravity=(0, 0, 2 * scale),
    )
    assert large.displaced_volume == pytest.approx(scale**3 * small.displaced_volume, rel=1e-10)
    assert large.wetted_surface == pytest.approx(scale**2 * small.wetted_surface, rel=1e-10)
    assert large.gm_transverse == pytest.approx(scale * small.gm_transverse, rel=1e-9, abs=1e-9 * scale)
    assert large.block_coefficient == pytest.approx(small.block_coefficient, rel=1e-9)
    assert large.panels_wet == small.panels_wet


def test_turning_the_vertex_order_of_panels_changes_nothing():
    # Triangles about the centre know no first corner, on quadrilaterals far from flat.
    turned = PanelMesh(HULL.vertices, np.roll(HULL.panels, 1, axis=1))
    here, there = (immersed_part(m, heel=0.2, trim=-0.1, waterline=2.0) for m in (HULL, turned))
    assert there.volume == pytest.approx(here.volume, rel=ROUNDING)
    assert there.wetted_surface == pytest.approx(here.wetted_surface, rel=ROUNDING)
    assert there.waterplane_second_moment == pytest.approx(here.waterplane_second_moment, rel=1e-11)


def test_upright_symmetric_hull_has_no_moment_to_one_side():
    part = immersed_part(HULL, heel=0.0, trim=0.05, waterline=2.0)
    assert abs(part.volume_moment[1]) < ROUNDING * part.volume
    assert abs(part.waterplane_second_moment[0, 1]) < ROUNDING * part.waterplane_second_moment[0, 0]
