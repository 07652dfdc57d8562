"""Pressure by panel, waterline and section forces of a hull at one instant."""

import functools
import itertools
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import RULES, STRETCHINGS, rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.kernels.wet_part import area_vectors
from panelsim.loads.hull_pressure import HullPressure, hull_pressure
from panelsim.loads.wetted_surface import pressure_force
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway, Seaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

DEG = np.pi / 180
RHO_G = 1025.0 * 9.80665
CALM = CalmSeaway()
# Sums of a few thousand terms in another order.
ROUNDING = 1e-12
# The kernels' own polynomials and order, and points within 1e-12 of the length that count as on the surface.
AGREEMENT = 1e-11
# Points of a waterline that are closer than 1e-11 of the length are one.
SAME_AREA = 1e-9


def blocks(*boxes: tuple[np.ndarray, np.ndarray, np.ndarray]) -> PanelMesh:
    """Boxes panelled at the given x, y and z, outward, their vertices merged."""
    sheets = []
    for x, y, z in boxes:
        for axis, outer in ((0, x), (1, y), (2, z)):
            for end, turned in ((outer[0], axis != 1), (outer[-1], axis == 1)):
                u, v = ((y, z), (x, z), (x, y))[axis]
                grid = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1)
                sheet = np.insert(grid, axis, end, axis=-1)
                corners = [sheet[:-1, :-1], sheet[1:, :-1], sheet[1:, 1:], sheet[:-1, 1:]]
                quads = np.stack(corners, axis=2).reshape(-1, 4, 3)
                sheets.append(quads[:, ::-1] if turned else quads)
    return merged(np.concatenate(sheets))


def merged(quads: np.ndarray) -> PanelMesh:
    vertices, index = np.unique(quads.reshape(-1, 3), axis=0, return_inverse=True)
    return PanelMesh(vertices, index.reshape(-1, 4))


def afloat(mesh: PanelMesh, *, draft: float, kg: float = 1.5, y: float = 0.0) -> Ship:
    return Ship(mesh, draft=draft, center_of_gravity=(None, y, kg), gyradii=(2.0, 5.0, 5.0))


@functools.cache
def box() -> Ship:
    """20 x 6 x 4 m, draft 2 m, in uneven panels of 1 to 2 m, no vertices at the waterline."""
    return afloat(
        blocks(([-10, -8, -5, -3, 0, 2, 5, 7.5, 10], [-3, -1, 0, 1, 3], [0, 1.1, 2.3, 3, 4])), draft=2.0
    )


@functools.cache
def catamaran() -> Ship:
    """Two hulls of 20 x 2 x 4 m, 8 m apart."""
    x, z = np.linspace(-10, 10, 9), np.linspace(0, 4, 4)
    return afloat(blocks((x, np.array([-5, -4, -3]), z), (x, np.array([3, 4, 5]), z)), draft=2.0)


@functools.cache
def proa() -> Ship:
    """Two hulls of 20 m with 4 and 2 m beam and a bow higher than the stern: no mirror image of itself."""
    x, z = np.linspace(-10, 10, 9), np.linspace(0, 4, 4)
    mesh = blocks((x, np.array([2, 3, 5, 6]), z), (x, np.array([-6, -5, -4]), z))
    y = (4 * 4 - 2 * 5) / 6
    rise = 1.0 + 0.02 * np.maximum(mesh.vertices[:, :1], 0.0)
    return afloat(
        PanelMesh(mesh.vertices * np.hstack([rise * 0 + 1, rise * 0 + 1, rise]), mesh.panels), draft=2.0, y=y
    )


@functools.cache
def moonpool() -> Ship:
    """A square pontoon of 12 m with a well of 4 m in its middle, 4 m deep, draft 2 m."""
    s, z = np.array([-6, -2, 2, 6.0]), np.array([0, 1.5, 2.5, 4.0])
    quads = []
    for i in range(3):
        for j in range(3):
            cell = np.array([[s[i], s[j]], [s[i + 1], s[j]], [s[i + 1], s[j + 1]], [s[i], s[j + 1]]])
            if (i, j) != (1, 1):
                quads += [np.insert(cell, 2, z[-1], axis=1), np.insert(cell, 2, z[0], axis=1)[::-1]]
            for side, (di, dj) in enumerate(((0, -1), (1, 0), (0, 1), (-1, 0))):
                outside = not (0 <= i + di < 3 and 0 <= j + dj < 3) or (i + di, j + dj) == (1, 1)
                if (i, j) == (1, 1) or not outside:
                    continue
                a, b = cell[side], cell[(side + 1) % 4]
                quads += [
                    np.array([[*a, low], [*b, low], [*b, high], [*a, high]])
                    for low, high in itertools.pairwise(z)
                ]
    return afloat(merged(np.array(quads)), draft=2.0)


@functools.cache
def wigley() -> Ship:
    return load_ship("wigley_iii", 0.02)


@functools.cache
def frigate() -> Ship:
    return load_ship("halifax", 10.0)


SHIPS = {"box": box, "catamaran": catamaran, "moonpool": moonpool, "wigley": wigley, "halifax": frigate}
ATTITUDES = {
    "at rest": [0, 0, 0, 0, 0, 0],
    "heeled 25": [1, 2, 0.02, 25 * DEG, 2 * DEG, 8 * DEG],
    "heeled 40, bow out": [0, 0, 0.05, -40 * DEG, -7 * DEG, 100 * DEG],
    "upside down": [0, 0, 0.02, 180 * DEG, 0, 0],
    "deck partly submerged": [0, 0, -0.3, 30 * DEG, 8 * DEG, 0],
    "on its end": [0, 0, 0.01, 0, 90 * DEG, 0],
}


HEADINGS = np.array([2.0, 2.6, -1.0])


def sea(heading: np.ndarray = HEADINGS) -> Seaway:
    return ComponentSeaway(
        WaveComponents(
            np.array([0.2, 0.15, 0.1]), np.array([1.3, 1.7, 2.0]), heading, np.array([0.4, 2.0, 5.0])
        )
    )


SEAS = {
    "calm": CALM,
    "waves": sea(),
    "Stokes wave": RegularSeaway(0.3, 1.6, 2.5, 1.0, second_order=True),
}


def scale(ship: Ship) -> np.ndarray:
    """What is large for force and moment: the weight, and that half a length away."""
    weight = ship.mass * ship.gravity
    return np.array([weight] * 3 + [weight * ship.length / 2] * 3)


# --- sums ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("seaway", SEAS)
@pytest.mark.parametrize("attitude", ATTITUDES)
@pytest.mark.parametrize("name", SHIPS)
def test_the_panels_and_the_sections_add_up_to_the_pressure_force(
    name: str, attitude: str, seaway: str
) -> None:
    ship, displacement = SHIPS[name](), np.array(ATTITUDES[attitude])
    stations = np.linspace(*(1.01 * np.ptp(ship.vertices[:, 0]) * np.array([-0.6, 0.6])), 14)
    for stretching in STRETCHINGS:
        for method in ("direct", "oracle"):
            given = {"speed": 4.0, "stretching": stretching, "method": method}
            found = hull_pressure(ship, SEAS[seaway], 3.0, displacement, **given)
            expected = pressure_force(ship, SEAS[seaway], 3.0, displacement, **given)
            assert (np.abs(found.load - expected) < AGREEMENT * scale(ship)).all()
        largest = np.abs(found.panel_load).max() + scale(ship)
        np.testing.assert_array_equal(found.load, found.panel_load.sum(axis=0))
        assert (np.abs(found.section_forces(stations).sum(axis=0) - found.load) < ROUNDING * largest).all()
        assert found.wet_fraction.min() >= 0.0 and found.wet_fraction.max() <= 1.0
        assert (found.panel_pressure[found.wet_fraction == 0.0] == 0.0).all()
        assert np.isfinite(found.panel_pressure).all()


@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("rule", RULES)
def test_each_rule_has_the_load_of_its_own(rule: str, stretching: str) -> None:
    ship, displacement = frigate(), ATTITUDES["heeled 25"]
    given = {"speed": 4.0, "stretching": stretching, "rule": rule, "method": "direct"}
    found = hull_pressure(ship, SEAS["waves"], 3.0, displacement, **given)
    expected = pressure_force(ship, SEAS["waves"], 3.0, np.array(displacement), **given)
    assert (np.abs(found.load - expected) < AGREEMENT * scale(ship)).all()
    sections = found.section_forces(np.linspace(-80, 80, 12))
    assert (np.abs(sections.sum(axis=0) - expected) < AGREEMENT * scale(ship)).all()
    whole = np.isin(found.wet_fraction, [0.0, 1.0]).all()
    assert whole == (rule == "panel")


def test_pressures_from_the_grid_add_up_to_the_force_from_the_grid() -> None:
    ship, displacement = frigate(), np.array(ATTITUDES["heeled 25"])
    grid, direct = (
        hull_pressure(ship, SEAS["waves"], 3.0, displacement, method=method) for method in ("grid", "direct")
    )
    expected = pressure_force(ship, SEAS["waves"], 3.0, displacement, method="grid")
    assert (np.abs(grid.load - expected) < AGREEMENT * scale(ship)).all()
    apart = np.abs(grid.panel_pressure - direct.panel_pressure).max()
    assert 0.0 < apart < 1e-4 * RHO_G * 0.3  # a share of the wave amplitudes that the grid may err by


@settings(deadline=None, derandomize=True, database=None, max_examples=25)
@given(
    st.lists(st.integers(-98, 98), min_size=1, max_size=6, unique=True),
    st.sampled_from([box, catamaran, proa]),
    st.sampled_from(list(ATTITUDES.values())),
)
def test_a_cut_between_two_stations_adds_nothing_and_loses_nothing(
    tenths: list[int], make: Callable[[], Ship], displacement: list[float]
) -> None:
    """Also where a station is a panel's edge, 0 of the box, or runs within rounding of one."""
    ship = make()
    found = hull_pressure(ship, SEAS["waves"], 3.0, displacement)
    ends = [ship.vertices[:, 0].min(), ship.vertices[:, 0].max()]
    stations = np.unique([*ends, *(0.1 * np.array(tenths)), 0.0, 1e-14])
    sections = found.section_forces(stations)
    largest = np.abs(found.panel_load).sum(axis=0)
    assert (np.abs(sections.sum(axis=0) - found.load) <= ROUNDING * largest.max()).all()
    for i in range(len(stations) - 1):
        alone = found.section_forces(stations[i : i + 2])
        np.testing.assert_allclose(alone[0], sections[i], rtol=0, atol=ROUNDING * largest.max())


# --- closed forms --------------------------------------------------------------------------------


def test_every_panel_of_a_box_in_calm_water(barge: Ship) -> None:
    """Six panels: bottom, deck, starboard, bow, port, stern; the water half way up, the CG 0.5 m below it."""
    found = hull_pressure(barge, CALM, 0.0, np.zeros(6))
    half = RHO_G * 1.0  # mean pressure over the wet half of a side, 2 m deep
    np.testing.assert_allclose(found.panel_pressure, [2 * half, 0, half, half, half, half], rtol=ROUNDING)
    np.testing.assert_allclose(found.wet_fraction, [1, 0, 0.5, 0.5, 0.5, 0.5], rtol=ROUNDING)
    side, end = half * 20 * 2, half * 6 * 2
    arm = 0.5 - 4 / 3  # of the centre of pressure, 4/3 m under water, from the CG
    expected = np.zeros((6, 6))
    expected[0, 2] = 2 * half * 20 * 6
    expected[2, [1, 3]] = side, -arm * side
    expected[3, [0, 4]] = -end, -arm * end
    expected[4, [1, 3]] = -side, arm * side
    expected[5, [0, 4]] = end, arm * end
    np.testing.assert_allclose(found.panel_load, expected, atol=ROUNDING * 2 * half * 1200)
    (line,) = found.waterline
    corners = {(10, -3), (10, 3), (-10, 3), (-10, -3)}
    assert corners <= {tuple(np.round(point[:2], 9)) for point in line}
    np.testing.assert_allclose(line[:, 2], 0.5, atol=1e-12)


@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("rule", RULES)
def test_mean_pressure_times_wet_area_pushes_a_flat_panel(rule: str, stretching: str) -> None:
    """-p n A of every panel of a box in waves short enough to bend the pressure over a panel."""
    ship = box()
    seaway = RegularSeaway(0.2, 3.0, 2.5, 1.0)
    found = hull_pressure(ship, seaway, 1.0, ATTITUDES["heeled 25"], rule=rule, stretching=stretching)
    thrust = found.panel_pressure * found.wet_fraction * ship.mesh.area
    np.testing.assert_allclose(
        found.panel_load[:, :3], -thrust[:, None] * ship.mesh.normal, atol=ROUNDING * thrust.max()
    )
    assert ((found.wet_fraction > 0.0) & (found.wet_fraction < 1.0)).any() == (rule != "panel")


def test_sections_of_a_box_in_calm_water_lift_their_length(barge: Ship) -> None:
    """Also the ends: their pressure counts for the sections that they bound, and for none beyond."""
    stations = np.array([-14, -10, -7.3, 0.0, 0.1, 10, 11, 12])
    sections = hull_pressure(barge, CALM, 0.0, np.zeros(6)).section_forces(stations)
    low, high = np.clip(stations[:-1], -10, 10), np.clip(stations[1:], -10, 10)
    per_length = RHO_G * 2 * 6
    end, arm = RHO_G * 1.0 * 6 * 2, 0.5 - 4 / 3
    expected = np.zeros((7, 6))
    expected[:, 2] = per_length * (high - low)
    expected[:, 4] = -per_length * (high**2 - low**2) / 2
    expected[1, [0, 4]] += end, arm * end  # the stern stands on a station: the section forward of it
    expected[5, [0, 4]] -= end, arm * end  # so does the bow, and the section forward of it is empty of sides
    np.testing.assert_allclose(sections, expected, atol=ROUNDING * per_length * 200)
    assert (sections[[0, 6]] == 0.0).all()
    # On the last station the bow counts for the section aft of it.
    aft = hull_pressure(barge, CALM, 0.0, np.zeros(6)).section_forces([0.1, 10.0])
    np.testing.assert_allclose(aft.sum(axis=0), expected[4:6].sum(axis=0), atol=ROUNDING * per_length * 200)


@pytest.mark.parametrize("displacement", [*ATTITUDES.values(), [0, 0, -0.5, 0.5, 0.1, 0.3]])
def test_sections_of_an_inclined_box_are_the_buoyancy_of_its_slices(displacement: list[float]) -> None:
    """A slice of the box is a box: its ends push along x only, so Y, Z and K are those of the whole slice."""
    ship, stations = box(), np.array([-10.0, -6.1, -3.0, 1.7, 8.2, 10.0])
    sections = hull_pressure(ship, CALM, 0.0, displacement).section_forces(stations)
    heave, roll, pitch = displacement[2:5]
    turn = rotation_to_earth(roll, pitch, 0.0).T
    up = turn @ [0.0, 0.0, 1.0]
    for i, ends in enumerate(itertools.pairwise(stations)):
        cut = blocks((np.array(ends), np.array([-3.0, 3.0]), np.array([0.0, 4.0])))
        in_ship_axes = PanelMesh(ship.to_ship_axes(cut.vertices), cut.panels)
        part = immersed_part(in_ship_axes, heel=roll, trim=pitch, waterline=ship.waterline - heave)
        expected = RHO_G * np.concatenate([part.volume * up, np.cross(turn @ part.volume_moment, up)])
        np.testing.assert_allclose(
            sections[i, 1:4], expected[1:4], atol=AGREEMENT * scale(ship)[1:4].max(), rtol=0
        )


def section_lift_of_a_wave(stations: np.ndarray) -> np.ndarray:
    """Vertical force between stations on a deep bottom 6 m wide: ∫ρ g (T + a e^{-kT} cos(k x + ε)) dA."""
    k = 0.9**2 / 9.80665
    wave = np.exp(-2.0 * k) * np.sin(k * stations + 1.0) / k
    return RHO_G * 6.0 * (2.0 * np.diff(stations) + 0.5 * np.diff(wave))


@pytest.mark.parametrize(("rule", "order"), [("vertex", 1.85), ("vertex+centre", 2.55)])
def test_order_of_the_section_forces_in_a_wave_along_a_box(rule: str, order: float) -> None:
    """Heave force between stations that no panel ends at, no stretching, so that it has a closed form.

    Head seas, cos(-k x - ε) at t = 0, the side walls vertical: the bottom alone lifts.
    """
    seaway = RegularSeaway(0.5, 0.9, np.pi, 1.0)
    stations = np.linspace(-9.7, 9.4, 18)
    exact = section_lift_of_a_wave(stations)
    dynamic = np.abs(exact - RHO_G * 12.0 * np.diff(stations)).max()
    errors = []
    for n in (6, 12, 24, 48):
        ship = afloat(blocks((np.linspace(-10, 10, n + 1), np.linspace(-3, 3, 3), [0, 3, 4])), draft=2.0)
        found = hull_pressure(ship, seaway, 0.0, np.zeros(6), stretching="none", rule=rule)
        lift = found.section_forces(stations)[:, 2]
        errors.append(np.sqrt(np.mean((lift - exact) ** 2)) / dynamic)
    slope = -np.polyfit(np.arange(4), np.log2(errors), 1)[0]
    print(f"{rule}: errors {errors}, order {slope:.2f}")
    assert slope > order
    assert errors[0] < 0.01  # panels of 3.3 m in waves of 76 m


# --- waterline -----------------------------------------------------------------------------------


def in_earth(ship: Ship, points: np.ndarray, displacement: object) -> np.ndarray:
    """Points in translating earth axes, z from the calm surface."""
    moved = np.asarray(displacement, float)
    return points @ rotation_to_earth(*moved[3:]).T + moved[:3] - [0, 0, ship.waterline]


def signed_area(plan: np.ndarray) -> float:
    """Area (K, 2) of a polygon, positive counter-clockwise."""
    x, y = plan.T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def assert_sound(found: HullPressure, ship: Ship) -> None:
    for line in found.waterline:
        assert len(line) >= 3
        gaps = np.linalg.norm(line - np.roll(line, 1, axis=0), axis=1)
        assert gaps.min() > 1e-12 * ship.length


@pytest.mark.parametrize("attitude", ATTITUDES)
@pytest.mark.parametrize("name", SHIPS)
def test_the_waterlines_enclose_the_waterplane(name: str, attitude: str) -> None:
    """Area and first moments of the plane that the hydrostatics of the panels have, at any attitude."""
    ship, displacement = SHIPS[name](), np.array(ATTITUDES[attitude], dtype=float)
    heave, roll, pitch = displacement[2:5]
    mesh = PanelMesh(ship.vertices, ship.mesh.panels)
    part = immersed_part(mesh, heel=roll, trim=pitch, waterline=ship.waterline - heave)
    for rule in ("vertex", "vertex+centre"):
        found = hull_pressure(ship, CALM, 0.0, displacement, rule=rule)
        assert_sound(found, ship)
        lines = [in_earth(ship, line, displacement) for line in found.waterline]
        assert max(np.abs(line[:, 2]).max() for line in lines) < 1e-12 * ship.length
        total = sum(signed_area(line[:, :2]) for line in lines)
        assert total == pytest.approx(part.waterplane_area, rel=SAME_AREA)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("seaway", SEAS)
@pytest.mark.parametrize("name", SHIPS)
def test_the_waterlines_bound_the_wet_part(name: str, seaway: str, rule: str) -> None:
    """In waves and by any rule: their area as a vector, ½ ∮ x × dx, closes that of the wet triangles."""
    ship, largest = SHIPS[name](), 0.0
    for displacement in ATTITUDES.values():
        found = hull_pressure(ship, SEAS[seaway], 2.0, displacement, rule=rule)
        assert_sound(found, ship)
        lid = np.zeros(3)
        for line in found.waterline:
            lid += 0.5 * np.cross(line, np.roll(line, -1, axis=0)).sum(axis=0)
        wet = found.wet_part.weight @ area_vectors(found.wet_part.corners)
        np.testing.assert_allclose(lid, -wet, rtol=0, atol=0.1 * SAME_AREA * ship.mesh.area.sum())
        largest = max(largest, float(np.linalg.norm(lid)))
    assert largest > 0.1  # m2: the Wigley hull is 3 m long


def test_a_catamaran_has_two_waterlines_and_a_moonpool_one_inside() -> None:
    hulls = hull_pressure(catamaran(), CALM, 0.0, np.zeros(6)).waterline
    np.testing.assert_allclose([signed_area(line[:, :2]) for line in hulls], [40.0, 40.0], rtol=SAME_AREA)
    assert sorted(np.sign(line[:, 1].mean()) for line in hulls) == [-1.0, 1.0]
    pool = hull_pressure(moonpool(), CALM, 0.0, np.zeros(6)).waterline
    areas = sorted(signed_area(line[:, :2]) for line in pool)
    np.testing.assert_allclose(areas, [-16.0, 144.0], rtol=SAME_AREA)


@pytest.mark.parametrize("name", SHIPS)
@pytest.mark.parametrize("seaway", SEAS)
def test_a_hull_under_or_out_of_the_water_has_no_waterline(name: str, seaway: str) -> None:
    ship = SHIPS[name]()
    for heave, fraction in ((-60.0, 1.0), (60.0, 0.0)):
        found = hull_pressure(ship, SEAS[seaway], 0.0, [0, 0, heave, 0.2, 0.1, 0])
        assert found.waterline == ()
        assert (found.wet_fraction == fraction).all()
        if not fraction:
            assert (found.load == 0.0).all() and (found.section_forces([-90, 0, 90]) == 0.0).all()


def test_the_waterline_lies_on_the_waves() -> None:
    """To the sag of the waves between points of the mesh: a k² h² / 8 a component, h 3.2 m at most."""
    ship, seaway, displacement = (
        frigate(),
        RegularSeaway(1.5, 0.8, 2.0, 0.7),
        np.array([2, 1, 0.3, 0.2, 0.02, 0.3]),
    )
    speed, time = 5.0, 7.0
    k = 0.8**2 / 9.80665
    found = hull_pressure(ship, seaway, time, displacement, speed=speed)
    assert found.waterline
    x, y, z = in_earth(ship, np.concatenate(found.waterline), displacement).T
    encounter = 0.8 - speed * k * np.cos(2.0)
    elevation = 1.5 * np.cos(k * (x * np.cos(2.0) - y * np.sin(2.0)) - encounter * time - 0.7)
    longest = np.linalg.norm(np.ptp(ship.vertices[ship.mesh.panels], axis=1), axis=1).max()
    assert np.abs(z - elevation).max() < 1.5 * (k * longest) ** 2 / 8
    assert np.ptp(elevation) > 2.0


def test_water_on_deck_is_bounded_clockwise() -> None:
    """A wave along the box lifts its middle above the rail: two dry ends, two lines round them."""
    seaway = RegularSeaway(1.0, np.sqrt(9.80665 * 2 * np.pi / 20.0), np.pi, 0.0)
    found = hull_pressure(box(), seaway, 0.0, [0, 0, -1.5, 0, 0, 0])
    areas = sorted(signed_area(line[:, :2]) for line in found.waterline)
    assert len(areas) == 2 and areas[0] > 20.0
    np.testing.assert_allclose(areas[0], areas[1], rtol=0.3)


# --- exactly on the surface ------------------------------------------------------------------------


@pytest.mark.parametrize("nudge", [0.0, 1e-14, -1e-14])
@pytest.mark.parametrize("yaw", [0.0, 0.7])
@pytest.mark.parametrize("rule", RULES)
def test_a_box_with_deck_bottom_or_vertices_exactly_on_the_surface(
    rule: str, yaw: float, nudge: float
) -> None:
    """A level panel on the surface is dry, and round it runs the line of its wet neighbours, if any."""
    ship = box()
    for heave, planes, deck in ((-2.0, 1, 0.0), (2.0, 0, 0.0), (-0.3, 1, 0.0)):
        displacement = [0, 0, heave + nudge, 0, 0, yaw]
        found = hull_pressure(ship, CALM, 0.0, displacement, rule=rule)
        assert_sound(found, ship)
        areas = [signed_area(line[:, :2]) for line in found.waterline]
        np.testing.assert_allclose(areas, [120.0] * planes, rtol=SAME_AREA)
        up = ship.mesh.normal[:, 2]
        assert (found.wet_fraction[up > 0.5] == deck).all()
        assert (found.wet_fraction[up < -0.5] == float(heave < 2.0)).all()
        lift = RHO_G * 120.0 * (2.0 - heave)
        assert rule == "panel" or found.load[2] == pytest.approx(lift, abs=ROUNDING * RHO_G * 480)


@pytest.mark.parametrize("roll", [90 * DEG, -90 * DEG, 180 * DEG])
def test_faces_that_rounding_leaves_near_the_surface_are_on_it(roll: float) -> None:
    """On its side or head the box's upper face is within 1e-15 m of the surface, not on it."""
    ship = box()
    corners = ship.vertices @ rotation_to_earth(roll, 0, 0).T
    heave = ship.waterline - corners[:, 2].max()
    found = hull_pressure(ship, CALM, 0.0, [0, 0, heave, roll, 0, 0])
    (line,) = found.waterline
    plan = in_earth(ship, line, [0, 0, heave, roll, 0, 0])[:, :2]
    assert signed_area(plan) == pytest.approx(120.0 if abs(roll) > 3 else 80.0, rel=SAME_AREA)
    assert set(np.unique(np.round(found.wet_fraction, 12))) == {0.0, 1.0}


def test_a_vertex_that_only_touches_the_surface_leaves_no_line() -> None:
    """A diamond under water, its top vertex on the surface; from above, its bottom vertex."""
    ring = np.array([[3, 0, 2], [0, 3, 2], [-3, 0, 2], [0, -3, 2.0]])
    vertices = np.vstack([ring, [[0, 0, 4], [0, 0, 0]]])
    panels = [[i, (i + 1) % 4, 4, 4] for i in range(4)] + [[(i + 1) % 4, i, 5, 5] for i in range(4)]
    ship = afloat(PanelMesh(vertices, np.array(panels)), draft=2.0, kg=1.0)
    for heave, fraction in ((-2.0, 1.0), (2.0, 0.0)):
        found = hull_pressure(ship, CALM, 0.0, [0, 0, heave, 0, 0, 0.4])
        assert found.waterline == ()
        np.testing.assert_allclose(found.wet_fraction, fraction, rtol=ROUNDING)
    (line,) = hull_pressure(ship, CALM, 0.0, np.zeros(6)).waterline
    np.testing.assert_allclose(signed_area(line[:, :2]), 18.0, rtol=ROUNDING)
    assert len(line) == 4  # the cuts of two triangles and two centres at each vertex are one point


@settings(deadline=None, derandomize=True, database=None, max_examples=40)
@given(
    st.sampled_from([0.0, 1e-16, -1e-15, 1e-13, -1e-12, 1e-11, 1e-8]),
    st.sampled_from([0.0, 1e-15, -1e-14, 1e-12, 1e-9]),
    st.sampled_from([-2.0, 0.0, -0.3, 0.9, -1.0, 2.0]),
    st.sampled_from(["vertex", "vertex+centre"]),
)
def test_next_to_the_surface_the_lines_stay_whole(nudge: float, tilt: float, heave: float, rule: str) -> None:
    """Rows of vertices within rounding of the surface, level or hardly tilted: no gaps, no stray lines."""
    ship = box()
    displacement = np.array([0, 0, heave + nudge, tilt, -tilt, 0.3])
    found = hull_pressure(ship, CALM, 0.0, displacement, rule=rule)
    assert_sound(found, ship)
    total = sum(signed_area(line[:, :2]) for line in found.waterline)
    mesh = PanelMesh(ship.vertices, ship.mesh.panels)
    part = immersed_part(mesh, heel=tilt, trim=-tilt, waterline=ship.waterline - heave - nudge)
    assert np.isfinite(found.panel_load).all()
    if abs(heave) < 2.0:  # at ±2 m a face is on the surface, and wet or dry by a rounding
        assert len(found.waterline) == 1
        assert total == pytest.approx(part.waterplane_area, rel=SAME_AREA)
    assert (np.abs(found.load[2] - RHO_G * part.volume) < AGREEMENT * scale(ship)[2]).all()


# --- symmetry --------------------------------------------------------------------------------------


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_a_mirrored_hull_in_a_mirrored_sea_mirrors_everything(stretching: str, rule: str) -> None:
    ship, flip = proa(), np.array([1, -1, 1, -1, 1, -1])
    mesh = PanelMesh(ship.mesh.vertices * [1, -1, 1], ship.mesh.panels[:, ::-1])
    other = afloat(mesh, draft=2.0, y=-ship.center_of_gravity[1])
    displacement = np.array([1.0, 2.0, 0.3, 0.2, 0.1, 0.4])
    given = {"speed": 3.0, "stretching": stretching, "rule": rule}
    here = hull_pressure(ship, sea(HEADINGS), 2.0, displacement, **given)
    there = hull_pressure(other, sea(-HEADINGS), 2.0, displacement * flip, **given)
    largest = scale(ship)
    assert np.abs(here.load[[1, 3, 5]]).min() > 1e-4 * largest.min()
    np.testing.assert_allclose(there.panel_pressure, here.panel_pressure, atol=ROUNDING * RHO_G * 10)
    np.testing.assert_allclose(there.wet_fraction, here.wet_fraction, atol=ROUNDING * 10)
    np.testing.assert_allclose(there.panel_load * flip, here.panel_load, atol=10 * ROUNDING * largest.max())
    stations = np.linspace(-11, 11, 8)
    np.testing.assert_allclose(
        there.section_forces(stations) * flip,
        here.section_forces(stations),
        atol=10 * ROUNDING * largest.max(),
    )
    assert len(here.waterline) == len(there.waterline) > 0
    areas = [
        sorted(signed_area(in_earth(hull, line, moved)[:, :2]) for line in lines)
        for hull, lines, moved in (
            (ship, here.waterline, displacement),
            (other, there.waterline, displacement * flip),
        )
    ]
    np.testing.assert_allclose(areas[0], areas[1], rtol=SAME_AREA)
    points, mirrored = (
        np.array(sorted(np.round(np.concatenate(lines) * side, 8).tolist()))
        for lines, side in ((here.waterline, [1, 1, 1]), (there.waterline, [1, -1, 1]))
    )
    np.testing.assert_allclose(points, mirrored, atol=1e-7)


def test_an_upright_catamaran_in_head_seas_has_even_halves() -> None:
    ship = catamaran()
    seaway = RegularSeaway(0.4, 1.5, np.pi, 0.3)
    found = hull_pressure(ship, seaway, 2.0, [0, 0, 0.1, 0, 0.05, 0], speed=3.0)
    sections = found.section_forces(np.linspace(-10, 10, 7))
    assert (np.abs(sections[:, [1, 3, 5]]) < 10 * ROUNDING * scale(ship)[[1, 3, 5]]).all()
    assert (sections[:, 2] > 0.0).all()


# --- refusals --------------------------------------------------------------------------------------


def test_what_cannot_be_is_refused(barge: Ship) -> None:
    still = np.zeros(6)
    for displacement in ([0.0] * 5, [0, 0, np.nan, 0, 0, 0], "none", [[0.0] * 6]):
        with pytest.raises(PanelsimError, match="isplacement"):
            hull_pressure(barge, CALM, 0.0, displacement)
    with pytest.raises(PanelsimError, match=r"25.0[\s\S]*np.radians"):
        hull_pressure(barge, CALM, 0.0, [0, 0, 0, 25.0, 0, 0])
    with pytest.raises(PanelsimError, match="time is out of range"):
        hull_pressure(barge, CALM, np.nan, still)
    with pytest.raises(PanelsimError, match="speed is out of range"):
        hull_pressure(barge, CALM, 0.0, still, speed=np.inf)
    for name, value in (("stretching", "airy"), ("rule", "simpson"), ("method", "fast")):
        with pytest.raises(PanelsimError, match=value):
            hull_pressure(barge, CALM, 0.0, still, **{name: value})


@pytest.mark.parametrize(
    "stations",
    [[], [0.0], 3.0, [0.0, 0.0], [1.0, -1.0], [0.0, np.nan], [0.0, np.inf], [[0.0, 1.0]], ["a", "b"]],
)
def test_stations_that_bound_nothing_are_refused(barge: Ship, stations: object) -> None:
    with pytest.raises(PanelsimError, match="stations"):
        hull_pressure(barge, CALM, 0.0, np.zeros(6)).section_forces(stations)


def test_what_is_handed_out_cannot_be_written_to(barge: Ship) -> None:
    found = hull_pressure(barge, CALM, 0.0, np.zeros(6))
    arrays = [found.panel_pressure, found.wet_fraction, found.panel_load, found.load, *found.waterline]
    for array in [*arrays, found.section_forces([-1, 1]), found.wet_part.corners, found.wet_part.pressure]:
        assert not array.flags.writeable
