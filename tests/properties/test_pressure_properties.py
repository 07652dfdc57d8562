"""Symmetries and conservation that the wetted-surface load keeps on any hull, in any sea."""

import numpy as np
import pytest
import trimesh

from panelsim.conventions import CUT_RULES, STRETCHINGS, panel_triangles, rotation_to_earth
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import WaveTables, panel_tables, wave_tables

WATERLINE, DENSITY, GRAVITY = -1.5, 1025.0, 9.80665
WATER = {"waterline": WATERLINE, "water_density": DENSITY, "gravity": GRAVITY}
LENGTH, BEAM, DEPTH, KG = 120.0, 15.0, 11.0, 6.5
SPEED = 10.29  # m/s
DEG = np.pi / 180
# Sums of some thousand terms in another order, of loads up to ρ g V and ρ g V L.
FORCE = DENSITY * GRAVITY * LENGTH * BEAM * 5.0
ROUND_OFF = 1e-12 * FORCE * np.array([1, 1, 1, LENGTH, LENGTH, LENGTH])


def lopsided_hull() -> tuple[np.ndarray, np.ndarray]:
    """Vertices in ship axes and panels of a closed, decked form; fuller to port than to starboard."""
    s, z = np.linspace(-1, 1, 25)[:, None], np.linspace(0, DEPTH, 12)
    half_breadth = BEAM / 2 * (1 - s**2) * (1 - np.maximum(1 - z / 5, 0) ** 2)
    port = np.stack(np.broadcast_arrays(LENGTH / 2 * s, half_breadth, z - KG), axis=-1)
    starboard = port * [1, -0.8, 1]
    deck = np.stack([port[:, -1], starboard[:, -1]], axis=1)
    vertices, panels = [], []
    for sheet in (port.swapaxes(0, 1), starboard, deck.swapaxes(0, 1)):
        index = np.arange(sheet[..., 0].size).reshape(sheet.shape[:2]) + sum(map(len, vertices))
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        panels.append(np.stack(corners, axis=-1).reshape(-1, 4))
        vertices.append(sheet.reshape(-1, 3))
    return np.concatenate(vertices), np.concatenate(panels)


VERTICES, PANELS = lopsided_hull()
HULL = panel_tables(VERTICES, PANELS)

OMEGA = np.linspace(0.35, 1.6, 12)
WAVENUMBER = OMEGA**2 / GRAVITY
AMPLITUDE = 1.2 * np.exp(-((OMEGA - 0.6) ** 2))
RANDOM = np.random.default_rng(11)
HEADING = RANDOM.uniform(0, 2 * np.pi, len(OMEGA))
PHASE = RANDOM.uniform(0, 2 * np.pi, len(OMEGA))


def sea(heading: np.ndarray = HEADING, phase: np.ndarray = PHASE, speed: float = SPEED) -> WaveTables:
    encounter = OMEGA - speed * WAVENUMBER * np.cos(heading)
    return wave_tables(AMPLITUDE, WAVENUMBER, heading, encounter, phase)


def random_poses(count: int) -> np.ndarray:
    """Poses up to 45° of roll, 8° of pitch, any yaw, 4 m of heave and 50 m off the origin."""
    random = np.random.default_rng(5)
    poses = np.empty((count, 8))
    poses[:, 0], poses[:, 1] = random.uniform(0, 1000, count), random.uniform(0, 1, count)
    limits = np.array([50, 50, 4, 45 * DEG, 8 * DEG, np.pi])
    poses[:, 2:] = random.uniform(-limits, limits, (count, 6))
    return poses


POSES = random_poses(8)


@pytest.mark.parametrize("rule", CUT_RULES)
@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_mirrored_ship_in_mirrored_waves_feels_the_mirrored_load(stretching: str, rule: str) -> None:
    mirrored_hull = panel_tables(VERTICES * [1, -1, 1], PANELS[:, ::-1])
    flip = np.array([1, -1, 1, -1, 1, -1])
    mirrored_poses = POSES * np.concatenate([[1, 1], flip])
    load = wetted_surface_load(HULL, sea(), POSES, stretching=stretching, rule=rule, **WATER)
    mirrored = wetted_surface_load(
        mirrored_hull, sea(-HEADING), mirrored_poses, stretching=stretching, rule=rule, **WATER
    )
    assert (np.abs(load).max(axis=0) > 1e6 * ROUND_OFF).all()
    assert (np.abs(mirrored * flip - load) < 10 * ROUND_OFF).all()


@pytest.mark.parametrize("rule", CUT_RULES)
def test_upright_symmetric_ship_in_head_seas_feels_no_sway_roll_or_yaw(rule: str) -> None:
    vertices = np.vstack([VERTICES * [1, 1 if side > 0 else -1, 1] for side in (1, -1)])
    both_halves = panel_tables(vertices, np.vstack([PANELS, PANELS[:, ::-1] + len(VERTICES)]))
    poses = POSES * np.array([1, 1, 1, 0, 1, 0, 1, 0])
    load = wetted_surface_load(both_halves, sea(np.full(len(OMEGA), np.pi)), poses, rule=rule, **WATER)
    assert (np.abs(load[:, [1, 3, 5]]) < 10 * ROUND_OFF[[1, 3, 5]]).all()


@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_ship_moved_with_the_waves_feels_the_same(stretching: str) -> None:
    """A shift (Δx, Δy) and phases ε later by k(Δx cos β - Δy sin β)."""
    shift = np.array([300.0, -700.0])
    moved = POSES.copy()
    moved[:, 2:4] += shift
    later = PHASE + WAVENUMBER * (shift[0] * np.cos(HEADING) - shift[1] * np.sin(HEADING))
    load = wetted_surface_load(HULL, sea(), POSES, stretching=stretching, **WATER)
    same = wetted_surface_load(HULL, sea(phase=later), moved, stretching=stretching, **WATER)
    assert (np.abs(same - load) < 10 * ROUND_OFF).all()


def test_yawed_ship_feels_the_waves_from_the_turned_heading() -> None:
    """Bow turned to port by ψ: waves at β meet the ship as waves at β + ψ; ship axes throughout."""
    yaw = 0.7
    poses = POSES.copy()
    poses[:, 2:4], poses[:, 7] = 0.0, yaw
    straight = poses.copy()
    straight[:, 7] = 0.0
    encounter = sea().encounter_frequency
    turned_sea = wave_tables(AMPLITUDE, WAVENUMBER, HEADING + yaw, encounter, PHASE)
    load = wetted_surface_load(HULL, sea(), poses, **WATER)
    same = wetted_surface_load(HULL, turned_sea, straight, **WATER)
    assert (np.abs(same - load) < 10 * ROUND_OFF).all()


def test_load_at_speed_is_that_of_the_ship_where_it_is_in_fixed_axes() -> None:
    """ω_e = ω - U k cos β with its sign, and no ω_e/ω on the pressure (TM 2003-190 (11), (16))."""
    assert (sea().encounter_frequency < 0).any()
    in_fixed_axes = POSES.copy()
    in_fixed_axes[:, 2] += SPEED * POSES[:, 0]
    load = wetted_surface_load(HULL, sea(), POSES, **WATER)
    same = wetted_surface_load(HULL, sea(speed=0.0), in_fixed_axes, **WATER)
    # After 1000 s the phases are some 1e4 rad, and k U t loses 1e-12 of a turn.
    assert (np.abs(same - load) < 100 * ROUND_OFF).all()


def test_load_at_time_zero_does_not_depend_on_speed() -> None:
    poses = POSES.copy()
    poses[:, 0] = 0.0
    loads = [wetted_surface_load(HULL, sea(speed=speed), poses, **WATER) for speed in (0.0, SPEED, -30.0)]
    np.testing.assert_array_equal(loads[0], loads[1])
    np.testing.assert_array_equal(loads[0], loads[2])


def volume_under_calm_water(pose: np.ndarray) -> float:
    """Immersed volume [m3] of the posed hull, its triangles cut by trimesh."""
    earth = VERTICES @ rotation_to_earth(*pose[5:]).T + pose[2:5]
    corners = panel_triangles(earth, PANELS).reshape(-1, 3)
    surface = np.array([0.0, 0.0, WATERLINE])
    faces = np.arange(len(corners)).reshape(-1, 3)
    points, faces, _ = trimesh.intersections.slice_faces_plane(corners, faces, [0, 0, -1], surface)
    # Measured from the surface itself, the missing lid adds nothing.
    a, b, c = np.moveaxis((points - surface)[faces], 1, 0)
    return float(np.einsum("tx,tx->", a, np.cross(b, c)) / 6)


@pytest.mark.parametrize("rule", CUT_RULES)
@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_calm_water_lifts_the_immersed_volume_and_nothing_else(stretching: str, rule: str) -> None:
    calm = wave_tables([], [], [], [], [])
    loads = wetted_surface_load(HULL, calm, POSES, stretching=stretching, rule=rule, **WATER)
    for pose, load in zip(POSES, loads, strict=True):
        rotation = rotation_to_earth(*pose[5:])
        force, moment = rotation @ load[:3], rotation @ load[3:]
        volume = volume_under_calm_water(pose)
        assert volume > 100.0
        # trimesh takes points within 1e-8 m of the surface as on it.
        assert force[2] == pytest.approx(DENSITY * GRAVITY * volume, rel=1e-9)
        assert (np.abs(force[:2]) < ROUND_OFF[:2]).all()
        assert abs(moment[2]) < ROUND_OFF[5]


def test_fully_immersed_hull_in_calm_water_does_not_care_how_deep() -> None:
    calm, poses = wave_tables([], [], [], [], []), POSES.copy()
    poses[:, 4] = -100.0
    deeper = poses.copy()
    deeper[:, 4] = -150.0
    load = wetted_surface_load(HULL, calm, poses, **WATER)
    # Twenty times the pressure at the vertices, so twenty times the round-off.
    assert (np.abs(wetted_surface_load(HULL, calm, deeper, **WATER) - load) < 20 * ROUND_OFF).all()


@pytest.mark.parametrize("rule", CUT_RULES)
def test_load_changes_smoothly_as_the_ship_heaves_through_the_surface(rule: str) -> None:
    """Exact wetting: the heave force over 2 mm steps has no jump as panel after panel goes under."""
    poses = np.zeros((301, 8))
    poses[:, 1] = 1.0
    poses[:, 4] = np.linspace(-0.3, 0.3, 301)
    poses[:, 5] = 5 * DEG
    heave = wetted_surface_load(HULL, sea(), poses, rule=rule, **WATER)[:, 2]
    smooth = np.polynomial.Polynomial.fit(poses[:, 4], heave, 5)(poses[:, 4])
    residue = np.abs(heave - smooth).max() / FORCE
    print(f"{rule}: residue about a quintic: {residue:.1e} of the buoyancy")
    assert residue < 2e-5


@pytest.mark.parametrize("rule", CUT_RULES)
@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("heel", [0.0, 0.3])
def test_load_is_continuous_where_points_pass_the_surface(stretching: str, rule: str, heel: float) -> None:
    """Of one panel, sunk through the surface in steps of 1e-4 m: no step in force or moment.

    A panel that counts otherwise when it is cut than when it is whole would jump as a point passes.
    """
    corners = np.array([[0, 0, 0], [0, 2.2, 0.1], [0.2, 2.0, 1.6], [0.1, 0.2, 1.4]])
    panel = panel_tables(corners, np.array([[0, 1, 2, 3]]))
    wave = wave_tables(0.8, 2 * np.pi / 8.0, 2.0, 1.0, 0.4)  # a few panels long, so that the bend is large
    poses = np.zeros((30001, 8))
    poses[:, 1], poses[:, 4], poses[:, 5] = 1.0, np.linspace(1.0, -2.0, len(poses)), heel
    load = wetted_surface_load(
        panel, wave, poses, waterline=0.0, water_density=1.0, gravity=1.0, stretching=stretching, rule=rule
    )
    steps = np.abs(np.diff(load, axis=0)).max(axis=0)
    # A head changes by 2 m at most in a metre, on 3.3 m2 and arms of 2.5 m; the bend is some 0.1 m.
    np.testing.assert_array_less(steps, 1e-4 * 2.0 * 3.3 * np.array([1, 1, 1, 2.5, 2.5, 2.5]))
