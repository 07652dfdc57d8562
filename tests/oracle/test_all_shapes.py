"""The pressure integral on a catamaran, a tumblehome form, a deck with a well, a moonpool and a bulb.

Port is the mirror of starboard in all of them, panel by panel.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import RULES, FloatArray, IntArray, panel_triangles, rotation_to_earth
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.kernels import oracle
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables

Mesh = tuple[FloatArray, IntArray]
WATER = {"waterline": 0.0, "water_density": 1025.0, "gravity": 9.80665}
WEIGHT_DENSITY = WATER["water_density"] * WATER["gravity"]
DEG = np.pi / 180
STARBOARD = np.array([1.0, -1.0, 1.0])
STATIONS = np.linspace(-1.0, 1.0, 41)  # along the half length


def lattice(*sheets: FloatArray) -> Mesh:
    """Vertices and panels of sheets of points (m, n, 3); i towards j turns into the water."""
    vertices, panels = [], []
    for sheet in sheets:
        index = np.arange(sheet[..., 0].size).reshape(sheet.shape[:2]) + sum(map(len, vertices))
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        panels.append(np.stack(corners, axis=-1).reshape(-1, 4))
        vertices.append(sheet.reshape(-1, 3))
    return np.concatenate(vertices), np.concatenate(panels)


def both_sides(*port: FloatArray) -> Mesh:
    """A mesh of port sheets, aft to fore along the first index, keel to deck along the second, mirrored."""
    sheets = [sheet.swapaxes(0, 1) for sheet in port]
    return lattice(*sheets, *(sheet.swapaxes(0, 1) * STARBOARD for sheet in sheets))


def along_girth(corners: list[FloatArray], counts: list[int]) -> FloatArray:
    """Sections (S, R, 3) through corners, each (S, 3), with so many panels from one to the next."""
    parts = [
        a[:, None] + (b - a)[:, None] * np.linspace(0.0, 1.0, count + 1)[:-1, None]
        for a, b, count in zip(corners[:-1], corners[1:], counts, strict=True)
    ]
    return np.concatenate([*parts, corners[-1][:, None]], axis=1)


def corner(half_length: float, y: FloatArray, z: FloatArray | float) -> FloatArray:
    return np.stack(np.broadcast_arrays(half_length * STATIONS, y, z), axis=-1)


def fullness() -> FloatArray:
    """Of the breadth along the length, pointed at both ends and fuller aft."""
    return (1 - STATIONS**2) * (1 - 0.3 * STATIONS)


def tumblehome() -> Mesh:
    """Broadest below the water, with sides that lean in above it."""
    b = fullness()
    corners = [
        corner(50.0, y * b, z) for y, z in ((0.0, -5.0), (6.5, -4.0), (8.0, -1.0), (4.5, 6.0), (0.0, 6.0))
    ]
    return both_sides(along_girth(corners, [4, 3, 5, 3]))


def deck_with_a_well() -> Mesh:
    """A barge whose deck sinks to 1 m below calm water amidships: its well is open to the sea."""
    b, floor = fullness(), 4.0 - 5.0 * np.clip(2.0 - 3.0 * np.abs(STATIONS), 0.0, 1.0)
    corners = [
        corner(50.0, 0.0 * b, -5.0),
        corner(50.0, 8.0 * b, -5.0),
        corner(50.0, 8.0 * b, 4.0),
        corner(50.0, 5.0 * b, 4.0),
        corner(50.0, 4.0 * b, floor),
        corner(50.0, 0.0 * b, floor),
    ]
    return both_sides(along_girth(corners, [4, 4, 2, 3, 3]))


def bulb() -> Mesh:
    """A pointed hull with a bulb that juts out ahead of the stem under water."""
    heights = np.array([-5.0, -4.6, -3.8, -2.8, -1.6, -0.6, 0.5, 2.0, 4.0, 6.0])
    share = np.clip(1 + (heights - 0.5) / 5.5, 0.0, 1.0)
    round_section = np.sqrt(np.clip(1 - ((heights + 3.3) / 1.7) ** 2, 0.0, None))
    fore = np.clip((STATIONS - 0.6) / 0.4, 0.0, 1.0)[:, None]
    y = 7.5 * fullness()[:, None] * (1 - (1 - share) ** 2)
    y = y + 2.0 * round_section * fore * np.sqrt(1 - fore**2)
    x = 50.0 * STATIONS[:, None] + 5.0 * round_section * fore**2
    side = np.stack(np.broadcast_arrays(x, y, heights), axis=-1)
    deck = np.stack([side[:, -1] * [1, y, 1] for y in np.linspace(1.0, 0.0, 5)], axis=1)
    return both_sides(side, deck)


def catamaran() -> Mesh:
    """Two slender hulls 18 m apart, decked, as one mesh without a bridge."""
    b, z = fullness(), np.linspace(-4.0, 5.0, 10)
    inside = 3.0 * b[:, None] * (1 - np.clip(-z / 4.0, 0.0, 1.0) ** 2)
    out = np.stack(np.broadcast_arrays(50.0 * STATIONS[:, None], inside, z), axis=-1)
    deck = np.stack([out[:, -1], out[:, -1] * STARBOARD], axis=1)
    off = np.array([0.0, 9.0, 0.0])
    inner = (out * STARBOARD)[:, ::-1]  # from the deck down to the keel
    return both_sides(out + off, deck + off, inner + off)


def moonpool() -> Mesh:
    """An oval barge with a hole through it: a rectangle about the vertical axis."""
    phi = np.linspace(0.0, 2.0 * np.pi, 65)
    out, up = np.linspace(2.0, 10.0, 9), np.linspace(-4.0, 3.0, 6)
    radius = np.concatenate([out, np.full(4, 10.0), out[::-1], np.full(5, 2.0)])
    z = np.concatenate([np.full(9, -4.0), up[1:-1], np.full(9, 3.0), up[-2::-1]])
    cos, sin = np.cos(phi)[:, None], np.sin(phi)[:, None]
    # Exactly as many turns on one side as on the other.
    sin, cos = (sin - sin[::-1]) / 2.0, (cos + cos[::-1]) / 2.0
    return lattice(np.stack(np.broadcast_arrays(3.0 * radius * cos, radius * sin, z), axis=-1))


SHAPES: dict[str, Callable[[], Mesh]] = {
    "catamaran": catamaran,
    "tumblehome": tumblehome,
    "deck with a well": deck_with_a_well,
    "moonpool": moonpool,
    "bulb": bulb,
}
# By method, how far from the NumPy twin, in parts of the dynamic load: see test_pressure_methods. The waves
# hardly yaw a catamaran, whose slender hulls add up what the grid is off by.
METHODS = {"direct": 1e-11, "grid": 5e-6}
# Time, factor, surge, sway, heave [m], roll, pitch, yaw [rad].
ATTITUDES = np.array(
    [
        [3.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [10.0, 1.0, 1.0, 2.0, 0.3, 25 * DEG, 2 * DEG, 8 * DEG],
        [17.0, 1.0, 0.0, 0.0, -0.5, -40 * DEG, -2 * DEG, 0.0],
        [24.0, 1.0, 0.0, 0.0, -7.0, 10 * DEG, 3 * DEG, 0.0],  # deck submerged
        [31.0, 1.0, 0.0, 0.0, 1.0, 3 * DEG, -7 * DEG, 0.0],  # bow out of the water
        [38.0, 1.0, 0.0, 0.0, 1.0, -5 * DEG, 7 * DEG, 0.0],  # stern out
        [45.0, 1.0, 2.0, -1.0, 0.5, 150 * DEG, 3 * DEG, 20 * DEG],  # capsized
        [52.0, 1.0, 0.0, 0.0, 0.0, 180 * DEG, 0.0, 0.0],
    ]
)
SUBMERGED = 3
STILL = ATTITUDES * (np.arange(8) != 1)
# Sway, roll and yaw change sign in the mirror of the centreline.
FLIP = np.array([1, -1, 1, -1, 1, -1])


@cache
def tables(name: str) -> PanelTables:
    return panel_tables(*SHAPES[name]())


def sea(heading: FloatArray | float | None = None) -> WaveTables:
    """19 waves of 3 m significant height at 8 m/s, none shorter than 43 m, from all over the port bow."""
    random = np.random.default_rng(3)
    omega = np.linspace(0.35, 1.2, 19)
    heading = random.uniform(1.6, 3.6, 19) if heading is None else np.broadcast_to(heading, 19)
    amplitude = omega**-2.5 * np.exp(-0.625 * (0.7 / omega) ** 4)
    amplitude *= 0.75 / np.sqrt((amplitude**2).sum() / 2)
    k = omega**2 / WATER["gravity"]
    encounter = omega - 8 * k * np.cos(heading)
    return wave_tables(amplitude, k, heading, encounter, random.uniform(0, 2 * np.pi, 19))


@cache
def dynamic_load(name: str) -> FloatArray:
    """Largest load (6,) of the waves of each kind over the attitudes."""
    load, calm = (wetted_surface_load(tables(name), sea(), at, **WATER) for at in (ATTITUDES, STILL))
    return np.abs(load - calm).max(axis=0)


@pytest.mark.parametrize("name", SHAPES)
def test_the_shapes_are_closed_and_face_the_water(name: str) -> None:
    vertices, panels = SHAPES[name]()
    corners = panel_triangles(vertices, panels).reshape(-1, 3, 3)
    area_vector = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # Sums of a thousand areas of a few m2.
    np.testing.assert_allclose(area_vector.sum(axis=0), 0.0, atol=1e-10)
    volume = np.einsum("tx,tx->", corners.mean(axis=1), area_vector) / 3.0
    assert volume > 5000.0
    if name == "moonpool":  # an oval polygon less an oval polygon, 7 m high
        assert volume == pytest.approx(7.0 * 3.0 * (10.0**2 - 2.0**2) * 32 * np.sin(2 * np.pi / 64))


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", SHAPES)
def test_each_method_is_its_numpy_twin(name: str, method: str, rule: str) -> None:
    load = wetted_surface_load(tables(name), sea(), ATTITUDES, rule=rule, method=method, **WATER)
    twin = oracle.wetted_surface_load(tables(name), sea(), ATTITUDES, rule=rule, **WATER)
    assert (np.abs(load - twin).max(axis=0) <= METHODS[method] * dynamic_load(name)).all()


@pytest.mark.parametrize("name", SHAPES)
def test_both_rules_are_near_the_brute_force_sum(name: str) -> None:
    """On some 1000 panels of 2.5 m length: coarse for the linear rule, not for the other."""
    coarse, fine = (
        oracle.subdivided_load(tables(name), sea(), ATTITUDES, levels=levels, **WATER) for levels in (0, 1)
    )
    exact = fine + (fine - coarse) / 3.0  # it errs with the square of the size
    error = {
        rule: np.abs(wetted_surface_load(tables(name), sea(), ATTITUDES, rule=rule, **WATER) - exact).max(
            axis=0
        )
        / dynamic_load(name)
        for rule in RULES
    }
    for rule, each in error.items():
        print(f"{name}, {rule}:", *(f"{part:.1e}" for part in each))
    assert error["vertex"].max() < 1.5e-2
    assert error["vertex+centre"].max() < 2e-4
    assert error["panel"].max() > 3 * error["vertex"].max()


@pytest.mark.parametrize("rule", ["vertex", "vertex+centre"])
@pytest.mark.parametrize("name", SHAPES)
def test_calm_water_lifts_what_the_hydrostatics_say(name: str, rule: str) -> None:
    """The hole, the well and both hulls included: at any attitude, with the moment about the CG."""
    mesh = PanelMesh(*SHAPES[name]())
    load = wetted_surface_load(tables(name), sea(), STILL, rule=rule, **WATER)
    for pose, found in zip(STILL, load, strict=True):
        part = immersed_part(mesh, heel=pose[5], trim=pose[6], waterline=-pose[4])
        to_ship = rotation_to_earth(pose[5], pose[6], 0.0).T
        lever = np.cross(to_ship @ part.volume_moment, to_ship[:, 2])
        expected = WEIGHT_DENSITY * np.concatenate([part.volume * to_ship[:, 2], lever])
        weight = WEIGHT_DENSITY * part.volume
        assert np.abs(found - expected)[:3].max() <= 1e-10 * weight
        assert np.abs(found - expected)[3:].max() <= 1e-10 * weight * 100.0  # arms of the length at most


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", SHAPES)
def test_upright_in_head_seas_there_is_no_sway_roll_or_yaw(name: str, method: str, rule: str) -> None:
    upright = ATTITUDES * np.isin(np.arange(8), [0, 1, 2, 4, 6])
    if (
        method == "grid"
    ):  # what leaves its box, 7 m down, is summed directly: not the same points on both sides
        upright = np.delete(upright, SUBMERGED, axis=0)
    load = wetted_surface_load(tables(name), sea(np.pi), upright, rule=rule, method=method, **WATER)
    largest = np.abs(load).max(axis=0)
    print(f"{name}, {method}, {rule}:", *(f"{part:.1e}" for part in largest))
    # Both sides are the same numbers in another order.
    assert largest[1] <= 1e-13 * largest[2]
    assert largest[[3, 5]].max() <= 1e-13 * largest[4]


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", SHAPES)
def test_the_mirrored_attitude_in_mirrored_waves_has_the_mirrored_load(
    name: str, method: str, rule: str
) -> None:
    heading = np.linspace(1.6, 3.6, 19)
    mirrored = ATTITUDES * np.concatenate([[1, 1], FLIP])
    load, image = (
        wetted_surface_load(tables(name), sea(each), at, rule=rule, method=method, **WATER)
        for each, at in ((heading, ATTITUDES), (-heading, mirrored))
    )
    largest = np.repeat([np.abs(load[:, part]).max() for part in (slice(3), slice(3, 6))], 3)
    # The grids of the two seas are two: within their tolerance of the dynamic load each.
    allowed = 1e-12 * largest if method == "direct" else 2 * METHODS[method] * dynamic_load(name)
    assert (np.abs(load).max(axis=0) > 1e3 * allowed).all()
    assert (np.abs(image * FLIP - load).max(axis=0) <= allowed).all()


angles = st.floats(-np.pi, np.pi)


@settings(deadline=None, max_examples=20, derandomize=True, database=None)
@given(st.sampled_from(list(SHAPES)), st.floats(-10, 10), angles, angles, angles, st.sampled_from(RULES))
def test_at_any_attitude_the_kernel_is_its_twin(
    name: str, heave: float, roll: float, pitch: float, yaw: float, rule: str
) -> None:
    pose = np.array([[5.0, 1.0, 0.0, 0.0, heave, roll, pitch, yaw]])
    load = wetted_surface_load(tables(name), sea(), pose, rule=rule, **WATER)
    twin = oracle.wetted_surface_load(tables(name), sea(), pose, rule=rule, **WATER)
    assert np.isfinite(load).all()
    scale = np.repeat([np.abs(twin[0, part]).max() for part in (slice(3), slice(3, 6))], 3)
    # Floating on its end a hull reaches 50 m down: large pressures that cancel all but their buoyancy.
    np.testing.assert_array_less(np.abs(load - twin)[0], 1e-11 * scale + 1e-3)
