"""Hydrostatics: closed forms first, then the stiffness against differences of the exact buoyancy."""

import numpy as np
import pytest

from panelsim.conventions import rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.hull.equilibrium import draft_of_mass, equilibrium
from panelsim.hull.hydrostatics import hydrostatics
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh

ROUNDING = 1e-12  # relative: a sum of some thousand terms in double precision
RHO, G = 1025.0, 9.80665


def box(length=20.0, beam=8.0, depth=5.0):
    x, y, z = np.meshgrid([-length / 2, length / 2], [-beam / 2, beam / 2], [0.0, depth], indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    panels = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return PanelMesh(vertices, np.array(panels))


def revolved(radius, height, around):
    """A closed surface of revolution about z: rings of `around` points, the first and last of radius 0."""
    angle = 2.0 * np.pi * np.arange(around) / around
    rings = [
        np.stack([r * np.cos(angle), r * np.sin(angle), np.full(around, z)], axis=1)
        for r, z in zip(radius[1:-1], height[1:-1], strict=True)
    ]
    bottom, top = [0.0, 0.0, height[0]], [0.0, 0.0, height[-1]]
    vertices = np.concatenate([*rings, [bottom, top]])
    here, there = np.arange(around), (np.arange(around) + 1) % around
    low, high = len(vertices) - 2, len(vertices) - 1
    last = (len(rings) - 1) * around
    panels = [np.stack([there, here, np.full(around, low), np.full(around, low)], axis=1)]
    for k in range(len(rings) - 1):
        a = k * around
        panels.append(np.stack([a + here, a + there, a + around + there, a + around + here], axis=1))
    panels.append(np.stack([last + here, last + there, np.full(around, high), np.full(around, high)], axis=1))
    return PanelMesh(vertices, np.concatenate(panels))


def sphere(rows):
    angle = np.linspace(0.0, np.pi, rows + 1)
    radius = 5.0 * np.sin(angle)
    return revolved(radius, 5.0 - 5.0 * np.cos(angle), 2 * rows)


def ship_like(lopsided=0.0):
    """A flared hull with raked ends and twisted panels, none of whose sides is vertical."""
    x = np.linspace(-30.0, 30.0, 13)
    rows = []
    for z in np.linspace(0.0, 8.0, 6):
        half = (2.0 + 0.5 * z) * (1.05 - (x / 34.0) ** 2) * (1.0 + 0.004 * x * (z / 8.0))
        rows.append(np.stack([x * (1.0 + 0.02 * z) + 0.1 * z, half, np.full_like(x, z)], axis=1))
    port = np.stack(rows)
    starboard = port * np.array([1.0, -1.0 + lopsided, 1.0])
    m, n = port.shape[:2]
    index = np.arange(m * n).reshape(m, n)
    other = index + m * n
    wall = [[index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]]]
    wall.append([other[:-1, 1:], other[1:, 1:], other[1:, :-1], other[:-1, :-1]])
    wall.append([index[:1, :-1], index[:1, 1:], other[:1, 1:], other[:1, :-1]])
    wall.append([index[-1:, 1:], index[-1:, :-1], other[-1:, :-1], other[-1:, 1:]])
    wall.append([index[1:, :1], index[:-1, :1], other[:-1, :1], other[1:, :1]])
    wall.append([index[:-1, -1:], index[1:, -1:], other[1:, -1:], other[:-1, -1:]])
    panels = np.concatenate([np.stack([c.ravel() for c in corners], axis=1) for corners in wall])
    return PanelMesh(np.concatenate([port.reshape(-1, 3), starboard.reshape(-1, 3)]), panels)


def test_ship_like_hull_of_these_tests_is_closed_and_outward():
    # ∮ n dS = 0 and ∮ z n_z dS = volume > 0.
    mesh = ship_like()
    assert np.abs(mesh.area_vector.sum(axis=0)).max() < ROUNDING * mesh.area.sum()
    assert np.sum(mesh.centroid * mesh.area_vector) > 0.0


def test_box_has_the_closed_form_of_every_quantity():
    length, beam, draft, kg = 20.0, 8.0, 2.0, 2.5
    found = hydrostatics(
        box(length, beam), draft=draft, center_of_gravity=(0, 0, kg), water_density=1000.0, gravity=9.81
    )
    volume, area = length * beam * draft, length * beam
    assert found.displaced_volume == pytest.approx(volume, rel=ROUNDING)
    assert found.displaced_mass == pytest.approx(1000.0 * volume, rel=ROUNDING)
    assert found.center_of_buoyancy == pytest.approx([0.0, 0.0, draft / 2], abs=ROUNDING * length)
    assert found.waterplane_area == pytest.approx(area, rel=ROUNDING)
    assert found.center_of_flotation == pytest.approx([0.0, 0.0, draft], abs=ROUNDING * length)
    assert found.wetted_surface == pytest.approx(area + 2 * draft * (length + beam), rel=ROUNDING)
    assert (found.waterline_length, found.waterline_beam) == pytest.approx((length, beam), rel=ROUNDING)
    assert found.block_coefficient == pytest.approx(1.0, rel=ROUNDING)
    assert found.waterplane_coefficient == pytest.approx(1.0, rel=ROUNDING)
    assert (found.panels_wet, found.panels_total) == (5, 6)
    # GM = KB + BM - KG with BM = B²/(12 T) and L²/(12 T).
    gm, gml = draft / 2 - kg + beam**2 / (12 * draft), draft / 2 - kg + length**2 / (12 * draft)
    assert found.gm_transverse == pytest.approx(gm, rel=ROUNDING)
    assert found.gm_longitudinal == pytest.approx(gml, rel=ROUNDING)
    weight = 1000.0 * 9.81 * volume
    expected = np.diag([0.0, 0.0, 1000.0 * 9.81 * area, weight * gm, weight * gml, 0.0])
    assert found.stiffness == pytest.approx(expected, abs=ROUNDING * weight * gml)


def test_cylinder_of_many_sides_has_the_closed_form_of_a_prism():
    around, radius, draft = 24, 5.0, 3.0
    mesh = revolved(np.array([0.0, radius, radius, 0.0]), np.array([0.0, 0.0, 7.0, 7.0]), around)
    found = hydrostatics(mesh, draft=draft, center_of_gravity=(0, 0, 2.0))
    wedge = 2.0 * np.pi / around
    area = 0.5 * around * radius**2 * np.sin(wedge)
    second = around * radius**4 * np.sin(wedge) * (2.0 + np.cos(wedge)) / 24.0  # of a regular polygon
    assert found.waterplane_area == pytest.approx(area, rel=ROUNDING)
    assert found.displaced_volume == pytest.approx(area * draft, rel=ROUNDING)
    assert np.diag(found.waterplane_second_moment) == pytest.approx([second, second], rel=ROUNDING)
    assert found.gm_transverse == pytest.approx(draft / 2 - 2.0 + second / (area * draft), rel=ROUNDING)


def test_sphere_cap_converges_with_order_two():
    radius, draft = 5.0, 3.7
    volume = np.pi * draft**2 * (radius - draft / 3.0)
    area = np.pi * (radius**2 - (radius - draft) ** 2)
    depth_of_center = 3.0 * (2.0 * radius - draft) ** 2 / (4.0 * (3.0 * radius - draft))  # below the centre
    rows = np.array([12, 24, 48])
    errors = []
    for row_count in rows:
        found = hydrostatics(sphere(row_count), draft=draft)
        height = found.center_of_buoyancy[2]
        errors.append(
            [
                abs(found.displaced_volume / volume - 1.0),
                abs(found.wetted_surface / (2.0 * np.pi * radius * draft) - 1.0),
                abs(height / (radius - depth_of_center) - 1.0),
            ]
        )
        assert found.waterplane_area == pytest.approx(area, rel=8.0 / row_count**2)
    slopes = -np.polyfit(np.log(rows), np.log(errors), 1)[0]
    print("order in rows of volume, wetted surface, KB:", slopes)
    assert np.all(slopes > 1.9)


def static_load(mesh, draft, trim, heel, gravity_center, displacement):
    """Buoyancy and weight conjugate to heave, roll and pitch after (η3, η4, η5) from rest, exactly.

    Built from the volume and its centre only; the ship is turned about its CG in level axes.
    """
    rest = rotation_to_earth(heel, trim, 0.0)
    turn = rotation_to_earth(displacement[1], displacement[2], 0.0)
    center = rest @ gravity_center
    waterline = rest[2, 2] * draft
    level = (mesh.vertices @ rest.T - center) @ turn.T
    moved = PanelMesh(level, mesh.panels)
    part = immersed_part(moved, heel=0.0, trim=0.0, waterline=waterline - center[2] - displacement[0])
    buoyancy = RHO * G * part.volume
    x, y = part.volume_moment[:2] / part.volume
    weight = RHO * G * immersed_part(mesh, heel=heel, trim=trim, waterline=waterline).volume
    moment = turn.T @ np.array([y * buoyancy, -x * buoyancy, 0.0])  # about the CG, in ship axes
    roll = displacement[1]
    return np.array([buoyancy - weight, moment[0], moment[1] * np.cos(roll) - moment[2] * np.sin(roll)])


@pytest.mark.parametrize("attitude", [(0.0, 0.0), (0.03, 0.0), (-0.04, 0.3)], ids=["upright", "trim", "heel"])
def test_stiffness_is_the_slope_of_the_exact_buoyancy_and_its_error_falls_with_order_two(attitude):
    trim, heel = attitude
    mesh, center = ship_like(lopsided=0.1), np.array([0.7, -0.1, 5.0])
    found = hydrostatics(mesh, draft=4.3, trim=trim, heel=heel, center_of_gravity=center, water_density=RHO)
    arms = np.array([1.0, 4.0, 20.0])  # m: bring heave, roll and pitch to one scale
    scale = found.stiffness[2, 2] * np.outer(arms, arms)
    exact = found.stiffness[2:5, 2:5]
    steps = np.array([0.008, 0.004, 0.002])
    errors = []
    for step in steps:
        slopes = np.empty((3, 3))
        for column in range(3):
            ahead = step * np.eye(3)[column]
            there = static_load(mesh, 4.3, trim, heel, center, ahead)
            back = static_load(mesh, 4.3, trim, heel, center, -ahead)
            slopes[:, column] = -(there - back) / (2.0 * step)
        errors.append(np.abs((slopes - exact) / scale).max())
    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    print("order of the central difference:", order, "last error:", errors[-1])
    # Edges that pass through the water between the steps let the order stray a little from two.
    assert order == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 2e-5  # the third derivatives of this hull leave 7e-6 to 8e-6
    assert np.all(np.abs(exact / scale) > 1e-3)  # every element is put to the test, well above the error


def test_stiffness_signs_follow_the_axes():
    # A waterplane aft of and to port of the CG: bow down lifts the stern out, so heave force falls.
    mesh = box()
    found = hydrostatics(mesh, draft=2.0, center_of_gravity=(3.0, -1.0, 2.0))
    c33 = found.stiffness[2, 2]
    assert found.stiffness[2, 4] == pytest.approx(3.0 * c33, rel=ROUNDING)  # -ρg A x_F, x_F = -3
    assert found.stiffness[2, 3] == pytest.approx(1.0 * c33, rel=ROUNDING)  # +ρg A y_F, y_F = +1
    assert found.stiffness[3, 4] == pytest.approx(3.0 * c33, rel=ROUNDING)  # -ρg ∫xy dA = +3
    assert np.array_equal(found.stiffness, found.stiffness.T)


def test_point_of_the_draft_lies_on_the_water():
    mesh = box(depth=6.0)
    found = hydrostatics(mesh, draft=3.0, trim=0.02, heel=0.1)
    # A wall-sided hull that turns about a point of its centreline keeps its volume.
    assert found.displaced_volume == pytest.approx(20.0 * 8.0 * 3.0, rel=ROUNDING)
    assert found.center_of_flotation == pytest.approx([0.0, 0.0, 3.0], abs=1e-11)  # 20 m times rounding
    assert found.center_of_buoyancy[0] > 0.0  # bow down moves buoyancy forward
    assert found.center_of_buoyancy[1] < 0.0  # starboard down moves it to starboard


def test_equilibrium_floats_the_weight_under_the_center_of_buoyancy():
    mesh = ship_like()
    rest = hydrostatics(mesh, draft=4.0)
    center = np.array([rest.center_of_buoyancy[0] + 0.5, 0.0, 4.5])
    mass = rest.displaced_mass
    found = equilibrium(mesh, mass=mass, center_of_gravity=center, initial_draft=1.0)
    assert found.trim > 0.0  # the CG was moved forward: bow down
    afloat = hydrostatics(mesh, draft=found.draft, trim=found.trim, center_of_gravity=center)
    assert afloat.displaced_mass == pytest.approx(mass, rel=1e-10)  # the promised balance
    lever = rotation_to_earth(0.0, found.trim, 0.0) @ (afloat.center_of_buoyancy - center)
    assert abs(lever[0]) < 1e-10 * 60.0
    # The trim agrees with weight shift over GM_L to first order; the hull is flared, hence 2 %.
    shift = 0.5 * np.cos(found.trim)
    assert found.trim == pytest.approx(shift / afloat.gm_longitudinal, rel=0.02)


def test_equilibrium_of_a_level_box_is_its_draft():
    mass = RHO * 20.0 * 8.0 * 1.25
    for start in (0.01, 2.0, 4.99):
        found = equilibrium(box(), mass=mass, center_of_gravity=(0, 0, 1.0), initial_draft=start)
        assert found.draft == pytest.approx(1.25, rel=1e-9)
        assert found.trim == pytest.approx(0.0, abs=1e-10)
    assert draft_of_mass(box(), mass=mass, trim=0.01) == pytest.approx(1.25, rel=1e-9)  # wall-sided


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass": RHO * 20.0 * 8.0 * 5.1}, "cannot float with this mass"),
        ({"mass": -1.0}, "mass is not positive"),
        ({"mass": np.nan}, "mass is not positive"),
        ({"center_of_gravity": (0.0, 0.01, 1.0)}, "take a list"),
        ({"center_of_gravity": (60.0, 0.0, 1.0)}, "a trim that no ship has|No draft and trim"),
        ({"center_of_gravity": (0.0, 1.0)}, "not a point"),
        ({"initial_draft": 5.5}, "outside the hull"),
    ],
)
def test_equilibrium_refuses_what_cannot_float(changes, message):
    loading = {"mass": RHO * 20.0 * 8.0, "center_of_gravity": (0.0, 0.0, 1.0), "initial_draft": 1.0}
    with pytest.raises(PanelsimError, match=message):
        equilibrium(box(), **(loading | changes))


def test_panels_above_the_water_change_nothing():
    mesh = ship_like()
    raised = mesh.vertices.copy()
    raised[mesh.vertices[:, 2] > 7.9, 2] += 3.0
    low, high = (hydrostatics(m, draft=4.0) for m in (mesh, PanelMesh(raised, mesh.panels)))
    assert low.displaced_volume == high.displaced_volume
    assert low.waterplane_area == high.waterplane_area


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"draft": -1.0}, "does not reach the water"),
        ({"draft": 6.0}, "wholly under"),
        ({"draft": np.nan}, "draft is not a finite"),
        ({"draft": 2.0, "trim": np.inf}, "trim is not a finite"),
        ({"draft": 2.0, "water_density": 0.0}, "water_density is not positive"),
        ({"draft": 2.0, "gravity": -9.8}, "gravity is not positive"),
        ({"draft": 2.0, "center_of_gravity": (0, 0)}, "not a point"),
    ],
)
def test_hydrostatics_refuses_what_makes_no_sense(arguments, message):
    with pytest.raises(PanelsimError, match=message):
        hydrostatics(box(), **arguments)


def test_inside_out_mesh_is_refused():
    mesh = box()
    with pytest.raises(PanelsimError, match="normals point into the hull"):
        hydrostatics(PanelMesh(mesh.vertices, mesh.panels[:, ::-1]), draft=2.0)


def test_metacentric_height_without_center_of_gravity_is_refused():
    with pytest.raises(PanelsimError, match="need the centre of gravity"):
        _ = hydrostatics(box(), draft=2.0).gm_transverse
