"""Seaways seen from fixed and from translating axes, in time and in frequency."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import KNOT, STANDARD_GRAVITY, STRETCHINGS
from panelsim.errors import PanelsimError
from panelsim.motion.waves_met import wave_elevation
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.fixed import FixedSeaway, ship_position
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway, Seaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.seaway.view import SeawayView

GRID = 0.1 * np.arange(2, 21)
SPEED = 20 * KNOT
DENSITY = 1025.0
DEG = np.pi / 180
# Formulas written out once more: a few roundings of numbers of order one, angles up to 1e3 rad.
ROUND_OFF = 1e-12

VECTORS = ("potential_gradient", "velocity", "acceleration")
SCALARS = ("potential", "potential_rate", "dynamic_pressure")


def report_sea(heading_deg: float = 150.0, seed: int = 1001) -> RandomSeaway:
    """The sea of TM 2003-190 section 8.4."""
    return RandomSeaway(Bretschneider(7.5, 15.0), GRID, np.deg2rad(heading_deg), seed)


class Waves(Seaway):
    """A seaway of given components."""

    kind = "given"

    def __init__(self, components: WaveComponents, ship_heading: float) -> None:
        self._components, self.ship_heading = components, ship_heading

    @property
    def components(self) -> WaveComponents:
        return self._components


def short_crested(count: int = 7, ship_heading: float = 1.1, seed: int = 4) -> Waves:
    """Waves from all sides, for a ship on a course that is no symmetry of theirs."""
    random = np.random.default_rng(seed)
    omega, phase = random.uniform(0.3, 1.9, count), random.uniform(0, 2 * np.pi, count)
    heading = random.uniform(0, 2 * np.pi, count)
    return Waves(WaveComponents(0.6 * np.exp(-omega), omega, heading, phase), ship_heading)


def given_density(name: str) -> dict[str, float]:
    return {"water_density": DENSITY} if name.endswith("pressure") else {}


def ask(sea: SeawayView, name: str, *coordinates: Any) -> np.ndarray:
    """A quantity by name, with the water density where it needs one."""
    return getattr(sea, name)(*coordinates, **given_density(name))


def deep_points(count: int, seed: int = 2) -> tuple[np.ndarray, ...]:
    """x, y, z, t below every trough."""
    random = np.random.default_rng(seed)
    return tuple(random.uniform([-200, -200, -12, 0], [200, 200, -4, 600], (count, 4)).T)


# --- the report's formulas, spelled out ---


def test_fixed_axes_are_equations_1_and_3_to_7() -> None:
    sea = short_crested().in_fixed_axes(stretching="none")
    waves, (x, y, z, t) = sea.components, deep_points(30)
    a, omega, k = waves.amplitude, waves.frequency, waves.frequency**2 / STANDARD_GRAVITY
    nu = waves.wave_heading + np.pi + 1.1  # β = ν + π − χ, (9), to within a turn
    c, s = np.cos(nu), np.sin(nu)
    theta = k * (y[:, None] * s - x[:, None] * c) - omega * t[:, None] - waves.phase
    decay, g = np.exp(k * z[:, None]), STANDARD_GRAVITY
    expected = {
        "potential": g * a / omega * np.sin(theta) * decay,
        "potential_rate": -g * a * np.cos(theta) * decay,
        "dynamic_pressure": DENSITY * g * a * np.cos(theta) * decay,
    }
    gradient = [-a * omega * c * np.cos(theta), a * omega * s * np.cos(theta), a * omega * np.sin(theta)]
    np.testing.assert_allclose(sea.elevation(x, y, t), (a * np.cos(theta)).sum(axis=1), atol=ROUND_OFF)
    for name, terms in expected.items():
        scale = np.abs(terms).max()
        np.testing.assert_allclose(ask(sea, name, x, y, z, t), terms.sum(axis=1), atol=ROUND_OFF * scale)
    for i, terms in enumerate(gradient):
        for name in ("potential_gradient", "velocity"):
            got = ask(sea, name, x, y, z, t)[:, i]
            np.testing.assert_allclose(got, (terms * decay).sum(axis=1), atol=ROUND_OFF)


def translating_angles(sea: TranslatingSeaway, *at: np.ndarray) -> np.ndarray:
    x, y, t = (coordinate[:, None] for coordinate in at)
    waves = sea.components
    k, beta = waves.frequency**2 / STANDARD_GRAVITY, waves.wave_heading
    encounter = waves.frequency - sea.speed * k * np.cos(beta)
    return k * (x * np.cos(beta) - y * np.sin(beta)) - encounter * t - waves.phase


def test_translating_axes_are_equations_10_and_12_to_16_with_the_sign_of_the_encounter_frequency() -> None:
    sea = short_crested().in_translating_axes(SPEED, stretching="none")
    waves, (x, y, z, t) = sea.components, deep_points(30)
    a, omega, beta = waves.amplitude, waves.frequency, waves.wave_heading
    k, g = omega**2 / STANDARD_GRAVITY, STANDARD_GRAVITY
    encounter = omega - SPEED * k * np.cos(beta)
    assert encounter.min() < 0.0 < encounter.max()
    np.testing.assert_array_equal(sea.observed_frequency, encounter)
    theta = translating_angles(sea, x, y, t)
    decay = np.exp(k * z[:, None])
    terms = {
        "potential": g * a / omega * np.sin(theta),
        "potential_rate": -g * a * encounter / omega * np.cos(theta),
        "dynamic_pressure": DENSITY * g * a * np.cos(theta),
    }
    np.testing.assert_allclose(sea.elevation(x, y, t), np.cos(theta) @ a, atol=ROUND_OFF)
    for name, term in terms.items():
        expected = (term * decay).sum(axis=1)
        np.testing.assert_allclose(
            ask(sea, name, x, y, z, t), expected, atol=ROUND_OFF * np.abs(expected).max()
        )
    velocity = [a * omega * np.cos(beta) * np.cos(theta), -a * omega * np.sin(beta) * np.cos(theta)]
    velocity.append(a * omega * np.sin(theta))
    acceleration = [a * omega**2 * np.cos(beta) * np.sin(theta), -a * omega**2 * np.sin(beta) * np.sin(theta)]
    acceleration.append(-a * omega**2 * np.cos(theta))
    for i in range(3):
        expected = (velocity[i] * decay).sum(axis=1)
        np.testing.assert_allclose(sea.potential_gradient(x, y, z, t)[:, i], expected, atol=ROUND_OFF)
        expected = (acceleration[i] * decay).sum(axis=1)
        np.testing.assert_allclose(sea.acceleration(x, y, z, t)[:, i], expected, atol=ROUND_OFF)


def test_complex_amplitudes_are_equations_21_to_26() -> None:
    sea = short_crested().in_translating_axes(SPEED)
    waves, x, y, z = sea.components, 12.0, -7.0, -3.0
    a, omega, beta, g = waves.amplitude, waves.frequency, waves.wave_heading, STANDARD_GRAVITY
    k = omega**2 / g
    wave = np.exp(-1j * k * (x * np.cos(beta) - y * np.sin(beta)) + 1j * waves.phase)
    decay = np.exp(k * z)
    gradient = sea.complex_potential_gradient(x, y, z)
    assert gradient.shape == (3, 7)
    for got, expected in (
        (sea.complex_elevation(x, y), a * wave),
        (sea.complex_potential(x, y, z), 1j * g * a / omega * wave * decay),
        (gradient[0], a * omega * np.cos(beta) * wave * decay),
        (gradient[1], -a * omega * np.sin(beta) * wave * decay),
        (gradient[2], 1j * a * omega * wave * decay),
        (sea.complex_potential_rate(x, y, z), -sea.observed_frequency * g * a / omega * wave * decay),
    ):
        np.testing.assert_allclose(got, expected, rtol=0, atol=ROUND_OFF)


@pytest.mark.parametrize("view", ["fixed", "translating"])
@pytest.mark.parametrize("name", [*SCALARS, *VECTORS])
def test_time_is_the_real_part_of_frequency(view: str, name: str) -> None:
    """Re Σ X exp(iωt), where the water is above the point and nothing is stretched."""
    seaway = short_crested()
    sea: SeawayView = (
        seaway.in_fixed_axes(stretching="none")
        if view == "fixed"
        else seaway.in_translating_axes(SPEED, stretching="none")
    )
    x, y, z, t = deep_points(25)
    amplitude = ask(sea, f"complex_{name}", x, y, z)
    turn = np.exp(1j * sea.observed_frequency * t[:, None])
    if name in VECTORS:
        turn = turn[:, None, :]
    in_time = ask(sea, name, x, y, z, t)
    assert amplitude.shape == (*in_time.shape, 7)
    # ω t of 1e3 rad, rounded once here.
    np.testing.assert_allclose(
        (amplitude * turn).sum(axis=-1).real, in_time, rtol=0, atol=1e-12 * np.abs(amplitude).max()
    )
    elevation = (sea.complex_elevation(x, y) * np.exp(1j * sea.observed_frequency * t[:, None])).sum(axis=-1)
    np.testing.assert_allclose(elevation.real, sea.elevation(x, y, t), atol=ROUND_OFF)


# --- signs ---


def test_direction_of_travel() -> None:
    """Waves from port (β = 90°) reach port first; head waves the bow first."""
    crest_time = {}
    t = np.linspace(0, 2 * np.pi / 0.5, 4001)
    for name, heading, (x, y) in [("port", 90, (0, 5)), ("starboard", 90, (0, -5)), ("bow", 180, (5, 0))]:
        wave = RegularSeaway(1.0, 0.5, np.deg2rad(heading), phase=-np.pi).in_translating_axes(0.0)
        crest_time[name] = t[np.argmax(wave.elevation(x, y, t))]
    assert crest_time["port"] < np.pi / 0.5 < crest_time["starboard"]
    assert crest_time["bow"] < np.pi / 0.5


def test_phase_is_the_lead_of_the_crest_at_the_origin() -> None:
    """cos(−ω t − ε): the crest passes the origin ε/ω before t = 0, in both axes."""
    seaway = RegularSeaway(1.0, 0.5, 0.4, phase=0.3, ship_heading=0.8)
    for wave in (seaway.in_translating_axes(0.0), seaway.in_fixed_axes()):
        assert wave.elevation(0.0, 0.0, -0.3 / 0.5) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize(
    ("from_deg", "north", "west"), [(45, -1, 1), (0, -1, 0), (90, 0, 1), (135, 1, 1), (250, 0.342, -0.940)]
)
def test_waves_travel_away_from_where_they_come_from(from_deg: float, north: float, west: float) -> None:
    """Waves from the north-east go south-west: the crest at the origin is later found there."""
    course = 70.0 * DEG
    heading = from_deg * DEG + np.pi - course
    wave = RegularSeaway(1.0, 0.6, heading - 2 * np.pi * (heading > 2 * np.pi), ship_heading=course)
    sea = wave.in_fixed_axes()
    assert np.cos(sea.sea_direction[0] - from_deg * DEG) == pytest.approx(1.0, abs=1e-12)
    way = np.array([north, west]) / np.hypot(north, west)
    # Within a quarter of the wave length the crest is the highest point of its line of travel.
    later, phase_speed = 2.0, STANDARD_GRAVITY / 0.6
    s = np.linspace(-0.25, 0.25, 2001) * 2 * np.pi * STANDARD_GRAVITY / 0.36
    crest = s[np.argmax(sea.elevation(s * way[0], s * way[1], later))]
    assert crest == pytest.approx(phase_speed * later, abs=s[1] - s[0])
    # Along the crest it is as high: what a wave from the mirrored direction would not be.
    assert sea.elevation(-50 * way[1], 50 * way[0], 0.0) == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("heading_deg", [0, 20, 110, 160, 300])
def test_water_moves_with_the_crest(heading_deg: float) -> None:
    """At a crest ∇Φ points where the wave goes, at a trough back, on the rising flank up."""
    heading = heading_deg * DEG
    for speed in (0.0, SPEED):
        sea = RegularSeaway(1.0, 0.6, heading).in_translating_axes(speed)
        travel = np.array([np.cos(heading), -np.sin(heading), 0.0])
        k = 0.36 / STANDARD_GRAVITY
        orbital = 0.6 * np.exp(k * (-2.0 - 1.0))  # Wheeler: 2 m deep under a crest of 1 m
        np.testing.assert_allclose(sea.velocity(0.0, 0.0, -2.0, 0.0), orbital * travel, atol=1e-14)
        ahead = np.pi / k * travel[:2]
        orbital = 0.6 * np.exp(k * (-2.0 + 1.0))
        np.testing.assert_allclose(sea.velocity(*ahead, -2.0, 0.0), -orbital * travel, atol=1e-13)
        flank = sea.velocity(*(0.5 * ahead), -2.0, 0.0)
        assert flank[2] == pytest.approx(0.6 * np.exp(-2 * k), rel=1e-12)


# --- one sea, two axes ---


def to_fixed(position: np.ndarray, course: float, x: float, y: float) -> tuple[float, float]:
    """Where (x forward, y to port) of the moving origin is, north and west."""
    return (
        position[0] + x * np.cos(course) + y * np.sin(course),
        position[1] - x * np.sin(course) + y * np.cos(course),
    )


def to_ship(vector: np.ndarray, course: float) -> np.ndarray:
    """(30), (31): a vector in fixed axes along the axes of the ship."""
    along, across, up = np.moveaxis(vector, -1, 0)
    return np.stack(
        [
            along * np.cos(course) - across * np.sin(course),
            across * np.cos(course) + along * np.sin(course),
            up,
        ],
        axis=-1,
    )


def assert_same_sea(fixed: FixedSeaway, moving: TranslatingSeaway, course: float, **where: Any) -> None:
    """Every quantity at a point that moves along with the ship is that of the fixed axes where it is."""
    x, y, z = 17.0, -6.0, -2.5
    time, position = where["time"], where["position"]
    at = *to_fixed(position, course, x, y), z, time
    # Phases of up to k|X| + ω t: some 1e4 rad, rounded a few times. Then other units: g a/ω, ρ g a.
    tolerance = 2e-11 * fixed.components.amplitude.sum()
    scales = {"potential": 30.0, "dynamic_pressure": 1e4, "pressure": 1e4}
    np.testing.assert_allclose(
        moving.elevation(x, y, time), fixed.elevation(*at[:2], time), rtol=0, atol=tolerance
    )
    for name, scale in scales.items():
        got, expected = ask(moving, name, x, y, z, time), ask(fixed, name, *at)
        np.testing.assert_allclose(got, expected, rtol=0, atol=tolerance * scale)
    for name in VECTORS:
        got, expected = ask(moving, name, x, y, z, time), to_ship(ask(fixed, name, *at), course)
        np.testing.assert_allclose(got, expected, rtol=0, atol=4 * tolerance)  # ω² up to 3.6


angles = st.floats(-2 * np.pi, 2 * np.pi)


@settings(deadline=None, max_examples=40)
@given(
    own=angles,
    course=angles,
    speed=st.floats(-10.0, 30.0),
    start=st.floats(-500.0, 3600.0),
    north=st.floats(-5000.0, 5000.0),
    west=st.floats(-5000.0, 5000.0),
    later=st.floats(0.0, 900.0),
    stretching=st.sampled_from(STRETCHINGS),
)
def test_fixed_and_translating_axes_show_the_same_sea(
    own: float,
    course: float,
    speed: float,
    start: float,
    north: float,
    west: float,
    later: float,
    stretching: str,
) -> None:
    """Any speed, astern and overtaking too, any course, from any place and instant: (9), (27)–(31)."""
    seaway = short_crested(ship_heading=own)
    fixed = seaway.in_fixed_axes(stretching=stretching)
    moving = seaway.in_translating_axes(
        speed, course, time=start, position=(north, west), stretching=stretching
    )
    position = ship_position((north, west), speed, course, later)
    assert_same_sea(fixed, moving, course, time=start + later, position=position)


def test_a_ship_that_changes_course_twice_stays_in_the_same_sea() -> None:
    """The view of each leg starts where the last one ended; at the turn both see the same."""
    fixed = short_crested().in_fixed_axes()
    position, clock, before = np.array([120.0, -40.0]), 30.0, None
    for speed, course, lasts in ((SPEED, 0.3, 200.0), (4.0, 2.5, 500.0), (12.0, -1.2, 300.0)):
        moving = fixed.in_translating_axes(speed, course, time=clock, position=position)
        if before is not None:
            assert moving.elevation(0.0, 0.0, clock) == pytest.approx(before, abs=1e-11)
        for elapsed in (0.0, 0.4 * lasts, lasts):
            here = ship_position(position, speed, course, elapsed)
            assert_same_sea(fixed, moving, course, time=clock + elapsed, position=here)
        position, clock = ship_position(position, speed, course, lasts), clock + lasts
        before = moving.elevation(0.0, 0.0, clock)


def test_the_ship_moves_along_its_own_heading_not_along_that_of_the_waves() -> None:
    """(28), (29) print ν. East at χ = 90°: y^f, west, falls. With ν the view is another sea."""
    np.testing.assert_allclose(ship_position((5.0, 7.0), 3.0, np.pi / 2, 10.0), [5.0, -23.0], atol=1e-13)
    np.testing.assert_allclose(ship_position((5.0, 7.0), 3.0, 0.0, [0.0, 10.0]), [[5, 7], [35, 7]])
    course, elapsed = 0.4, 60.0
    fixed = RegularSeaway(1.0, 0.6, 2.2, ship_heading=course).in_fixed_axes()
    moving = fixed.in_translating_axes(SPEED, course)
    right = ship_position((0.0, 0.0), SPEED, course, elapsed)
    printed = ship_position((0.0, 0.0), SPEED, float(fixed.sea_direction[0]), elapsed)
    seen = moving.elevation(0.0, 0.0, elapsed)
    assert fixed.elevation(*right, elapsed) == pytest.approx(seen, abs=1e-12)
    assert abs(fixed.elevation(*printed, elapsed) - seen) > 0.1


@pytest.mark.parametrize("heading_deg", [0, 30, 90, 150, 180, 250])
def test_translating_axes_see_the_same_sea_as_a_fixed_observer(heading_deg: float) -> None:
    """ζ(x, y, t) there is ζ(x + U t, y, t) of the earth-fixed sea Σ a cos(k·x − ω t − ε).

    With the modulus of ω_e, as (11) is printed, the overtaken waves (30°, 0°) run the wrong way.
    """
    c = report_sea(heading_deg).components
    moving, fixed = TranslatingSeaway(c, SPEED), TranslatingSeaway(c, 0.0)
    t = np.linspace(0, 50, 21)
    # Rounding of phases of a few hundred radians.
    np.testing.assert_allclose(
        moving.elevation(12.0, -3.0, t), fixed.elevation(12.0 + SPEED * t, -3.0, t), atol=1e-10
    )
    pressures = [
        sea.pressure(x, -3.0, -4.0, t, water_density=1000.0)
        for sea, x in ((moving, 12.0), (fixed, 12.0 + SPEED * t))
    ]
    # No factor ω_e/ω in the pressure ((16) alone would carry one): speed does not change it.
    np.testing.assert_allclose(pressures[0], pressures[1], rtol=1e-10)


def test_the_modulus_of_the_encounter_frequency_is_another_sea() -> None:
    """(11) as printed: an overtaken wave would gain on the ship."""
    wave = RegularSeaway(1.0, 1.5, 0.0)
    seen, fixed = wave.in_translating_axes(SPEED), wave.in_fixed_axes()
    (encounter,), t = seen.observed_frequency, 3.0
    assert encounter < 0.0
    k = 1.5**2 / STANDARD_GRAVITY
    there = fixed.elevation(2.0 + SPEED * t, 0.0, t)
    assert np.cos(k * 2.0 - encounter * t) == pytest.approx(there, abs=1e-12)
    assert abs(np.cos(k * 2.0 - abs(encounter) * t) - there) > 0.4
    assert seen.elevation(2.0, 0.0, t) == pytest.approx(there, abs=1e-12)


def test_equation_16_is_a_derivative_and_no_pressure() -> None:
    """−ρ ∂Φ/∂t in moving axes lacks ρ U ∂Φ/∂x: wrong by ω_e/ω, and by its sign for overtaken waves."""
    wave = RegularSeaway(1.0, 0.8, np.pi)
    at = 3.0, 1.0, -2.0, 5.0
    still = wave.in_fixed_axes(stretching="none")
    moving = wave.in_translating_axes(SPEED, stretching="none")
    share = moving.observed_frequency[0] / 0.8
    assert share > 1.8
    rate, pressure = moving.potential_rate(*at), moving.dynamic_pressure(*at, water_density=DENSITY)
    assert -DENSITY * rate == pytest.approx(share * pressure, rel=1e-12)
    whole = -DENSITY * (rate - SPEED * moving.potential_gradient(*at)[0])
    assert whole == pytest.approx(pressure, rel=1e-12)
    assert -DENSITY * still.potential_rate(*at) == pytest.approx(
        still.dynamic_pressure(*at, water_density=DENSITY), rel=1e-12
    )


@pytest.mark.parametrize("heading", [-0.5, 0.0, 2.6])
def test_the_own_course_is_the_components_as_they_are(heading: float) -> None:
    sea = RegularSeaway(1.0, 0.6, heading, phase=0.7, ship_heading=1.3)
    view, plain = sea.in_translating_axes(SPEED), TranslatingSeaway(sea.components, SPEED)
    for name in ("amplitude", "frequency", "wave_heading", "phase"):
        np.testing.assert_array_equal(getattr(view.components, name), getattr(plain.components, name))
    x, y, z, t = deep_points(50)
    np.testing.assert_array_equal(view.elevation(x, y, t), plain.elevation(x, y, t))
    np.testing.assert_array_equal(view.velocity(x, y, z, t), plain.velocity(x, y, z, t))
    assert view.gravity == STANDARD_GRAVITY and view.stretching == "wheeler"


def test_gravity_stretching_and_second_order_reach_every_view() -> None:
    components = WaveComponents([2.0], [0.7], [2.0], [0.1], second_order=True)
    sea = Waves(components, 0.4)
    given = {"gravity": 9.8, "stretching": "none"}
    for view in (
        sea.in_fixed_axes(**given),
        sea.in_translating_axes(3.0, **given),
        sea.in_fixed_axes(**given).in_translating_axes(3.0, 1.0, time=2.0, position=(3.0, 4.0)),
    ):
        assert (view.gravity, view.stretching, view.components.second_order) == (9.8, "none", True)
    oracle = replace(sea.in_fixed_axes(), method="oracle").in_translating_axes(3.0, 1.0)
    assert oracle.method == "oracle"


# --- the surface ---


def test_pressure_vanishes_at_the_wheeler_surface_and_is_zero_above() -> None:
    sea = report_sea().in_translating_axes(SPEED)
    t = np.linspace(0, 60, 31)
    zeta = sea.elevation(3.0, 4.0, t)
    # Rounding of ρ g ζ, some 1e5 Pa.
    np.testing.assert_allclose(sea.pressure(3.0, 4.0, zeta, t, water_density=1025.0), 0.0, atol=1e-8)
    assert np.all(sea.pressure(3.0, 4.0, zeta + 0.1, t, water_density=1025.0) == 0.0)
    assert np.all(sea.pressure(3.0, 4.0, zeta - 0.1, t, water_density=1025.0) > 0.0)


def test_pressure_at_the_surface_of_a_stokes_wave() -> None:
    """−ρ g ½ a² k cos 2θ with Wheeler, the elevation being (17) and the potential (12); not 0."""
    a, omega = 3.0, 0.8
    k = omega**2 / STANDARD_GRAVITY
    stokes = WaveComponents([a], [omega], [2.4], [0.3], second_order=True)
    sea = TranslatingSeaway(stokes, SPEED)
    t = np.linspace(0, 10, 41)
    theta = translating_angles(sea, np.full(41, 5.0), np.full(41, 2.0), t)[:, 0]
    zeta = a * np.cos(theta) + 0.5 * a**2 * k * np.cos(2 * theta)
    np.testing.assert_allclose(sea.elevation(5.0, 2.0, t), zeta, atol=1e-12)
    expected = -DENSITY * STANDARD_GRAVITY * 0.5 * a**2 * k * np.cos(2 * theta)
    np.testing.assert_allclose(
        sea.pressure(5.0, 2.0, zeta, t, water_density=DENSITY), expected, rtol=0, atol=1e-7
    )
    assert np.abs(expected).max() > 2900.0
    # The potential is of first order, stretched by the whole elevation.
    np.testing.assert_allclose(
        sea.velocity(5.0, 2.0, zeta - 1.0, t)[:, 2], a * omega * np.sin(theta) * np.exp(-k), atol=1e-12
    )


def test_wheeler_stretches_by_the_elevation_of_all_waves() -> None:
    """Section 3.1: z − ζ with the whole ζ, not the part of each wave."""
    sea = report_sea().in_translating_axes(SPEED)
    waves, t = sea.components, np.linspace(0, 40, 9)
    theta = translating_angles(sea, np.zeros(9), np.zeros(9), t)
    zeta = np.cos(theta) @ waves.amplitude
    k = waves.frequency**2 / STANDARD_GRAVITY
    heights = np.array([-3.0, -0.5])
    for height in heights:
        decay = np.exp(k * height)
        expected = (waves.amplitude * waves.frequency * np.sin(theta) * decay).sum(axis=1)
        np.testing.assert_allclose(
            sea.velocity(0.0, 0.0, zeta + height, t)[:, 2], expected, rtol=0, atol=1e-11
        )


def test_unstretched_pressure_is_linear_theory_below_calm_water() -> None:
    wave = RegularSeaway(1.0, 0.6, np.pi).in_translating_axes(0.0, stretching="none")
    k = 0.36 / STANDARD_GRAVITY
    expected = 1025 * STANDARD_GRAVITY * (np.cos(-0.6 * 2.0 - k * 7.0) * np.exp(-3 * k) + 3.0)
    got = wave.pressure(7.0, 0.0, -3.0, 2.0, water_density=1025.0)
    assert got == pytest.approx(expected, rel=1e-13)


def test_without_stretching_waves_do_not_decay_above_calm_water() -> None:
    """exp(k min(z, 0)) = 1 between calm water and the crest; the pressure is ρ g (ζ − z) there."""
    wave = RegularSeaway(2.0, 0.6, 0.0).in_fixed_axes(stretching="none")
    velocity = wave.velocity(0.0, 0.0, [-1e-12, 0.5, 1.99, 2.01], 0.0)
    np.testing.assert_allclose(velocity[:, 0], np.array([1.2, 1.2, 1.2, 0.0]), rtol=1e-11)
    pressure = wave.pressure(0.0, 0.0, 0.5, 0.0, water_density=DENSITY)
    assert pressure == pytest.approx(DENSITY * STANDARD_GRAVITY * 1.5, rel=1e-12)


@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("name", [*SCALARS, *VECTORS, "pressure"])
def test_everything_is_zero_above_the_water_and_nothing_below(name: str, stretching: str) -> None:
    sea = report_sea().in_translating_axes(SPEED, stretching=stretching)
    t = np.linspace(0, 60, 13)
    zeta = sea.elevation(3.0, 4.0, t)
    assert zeta.min() < -1.0 < 1.0 < zeta.max()
    assert np.all(ask(sea, name, 3.0, 4.0, zeta + 1e-6, t) == 0.0)
    assert np.all(ask(sea, name, 3.0, 4.0, zeta - 0.1, t) != 0.0)


def test_a_point_at_the_surface_is_wet_whoever_found_the_surface() -> None:
    """The elevation by the twin, from other axes or rounded: velocities there do not flicker to zero."""
    fixed = replace(short_crested().in_fixed_axes(), method="oracle")
    moving = replace(fixed.in_translating_axes(SPEED, 0.4), method="direct")
    t = np.linspace(0, 600, 301)
    zeta = fixed.elevation(*ship_position((0.0, 0.0), SPEED, 0.4, t).T, t)
    assert np.all(moving.velocity(0.0, 0.0, zeta, t) != 0.0)


def test_complex_amplitudes_are_zero_above_calm_water_only() -> None:
    sea = report_sea().in_fixed_axes()
    for name in (*SCALARS, *VECTORS):
        assert np.all(ask(sea, f"complex_{name}", 1.0, 2.0, 0.01) == 0.0)
        assert np.all(ask(sea, f"complex_{name}", 1.0, 2.0, 0.0) != 0.0)


# --- calls ---


@pytest.mark.parametrize("method", ["direct", "oracle"])
def test_shapes_broadcast_and_scalars_come_back_as_numbers(method: str) -> None:
    seaway = short_crested()
    for sea in (seaway.in_fixed_axes(), seaway.in_translating_axes(SPEED)):
        sea = replace(sea, method=method)
        assert isinstance(sea.elevation(1, 2.0, 3), float)
        assert isinstance(sea.pressure(1.0, 2.0, -3.0, 4.0, water_density=DENSITY), float)
        assert isinstance(sea.potential(1.0, 2.0, -3.0, 4.0), float)
        assert sea.velocity(1.0, 2.0, -3.0, 4.0).shape == (3,)
        x, y, t = np.arange(4.0)[:, None, None], np.arange(3.0)[:, None], np.arange(5.0)
        assert sea.elevation(x, y, t).shape == (4, 3, 5)
        assert sea.potential_rate(x, y, -2.0, t).shape == (4, 3, 5)
        whole = sea.acceleration(x, y, -2.0, t)
        assert whole.shape == (4, 3, 5, 3)
        np.testing.assert_array_equal(whole[3, 1, 2], sea.acceleration(3, 1, -2, 2))
        assert sea.elevation([], 0.0, 1.0).shape == (0,)
        assert sea.velocity(np.empty((2, 0)), 0.0, -1.0, 1.0).shape == (2, 0, 3)
    assert seaway.in_fixed_axes().complex_elevation(1.0, 2.0).shape == (7,)
    assert seaway.in_fixed_axes().complex_velocity([1.0, 2.0], 0.0, -1.0).shape == (2, 3, 7)


@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_the_compiled_sum_and_its_twin_give_the_same(stretching: str) -> None:
    x, y, z, t = deep_points(60)
    z[::3] = 0.3
    sea = report_sea().in_translating_axes(SPEED, stretching=stretching)
    for name in (*SCALARS, *VECTORS, "pressure"):
        direct, twin = (ask(replace(sea, method=m), name, x, y, z, t) for m in ("direct", "oracle"))
        np.testing.assert_allclose(direct, twin, rtol=0, atol=1e-12 * np.abs(twin).max() * 19)


def test_calm_water_has_static_pressure_only() -> None:
    for sea in (CalmSeaway().in_fixed_axes(), CalmSeaway().in_translating_axes(SPEED)):
        np.testing.assert_array_equal(sea.elevation([1.0, 2.0], 0.0, 3.0), [0.0, 0.0])
        pressure = sea.pressure(0.0, 0.0, [-2.0, 0.0, 1.0], 5.0, water_density=1000.0)
        np.testing.assert_allclose(pressure, [2000.0 * STANDARD_GRAVITY, 0.0, 0.0], rtol=1e-15)
        np.testing.assert_array_equal(sea.velocity(0.0, 0.0, -1.0, 0.0), np.zeros(3))
        assert sea.complex_velocity(0.0, 0.0, -1.0).shape == (3, 0)


def test_the_second_order_grows_with_the_square_of_the_ramp() -> None:
    """The recorded elevation of a run: f a cos θ + f² ½ a² k cos 2θ, as the ship meets it."""
    a, omega, t = 3.0, 0.8, np.linspace(0.0, 20.0, 50)
    factor = np.minimum(t / 15.0, 1.0)
    sea = TranslatingSeaway(WaveComponents([a], [omega], [np.pi], [0.2], second_order=True), SPEED)
    k = omega**2 / STANDARD_GRAVITY
    theta = -(omega + SPEED * k) * t - 0.2
    expected = factor * a * np.cos(theta) + factor**2 * 0.5 * a**2 * k * np.cos(2 * theta)
    np.testing.assert_allclose(wave_elevation(sea, t, factor), expected, atol=1e-12)
    linear = replace(sea, components=replace(sea.components, second_order=False))
    np.testing.assert_array_equal(wave_elevation(linear, t, factor), factor * linear.elevation(0, 0, t))


WAVE = RegularSeaway(1.0, 0.6, 0.3)
FIXED, MOVING = WAVE.in_fixed_axes(), WAVE.in_translating_axes(5.0)


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (lambda: MOVING.elevation(np.zeros(3), np.zeros(2), 0.0), r"x \(3,\), y \(2,\)"),
        (lambda: MOVING.velocity(0.0, 0.0, np.zeros((2, 3)), np.zeros(2)), r"z_wl \(2, 3\)"),
        (lambda: FIXED.elevation([0.0, np.nan], 0.0, 0.0), "x is out of range"),
        (lambda: FIXED.elevation(0.0, np.inf, 0.0), "y is out of range"),
        (lambda: FIXED.potential(0.0, 0.0, -np.inf, 0.0), "z_wl is out of range"),
        (lambda: FIXED.complex_potential(0.0, 0.0, np.nan), "z_wl is out of range"),
        (lambda: FIXED.elevation(0.0, 0.0, 1e12), "time is out of range"),
        (lambda: FIXED.elevation("here", 0.0, 0.0), "x is not a number"),
        (lambda: FIXED.elevation(0.0, None, 0.0), "y is not a number"),
        (lambda: FIXED.elevation(1j, 0.0, 0.0), "x is not a number"),
        (lambda: FIXED.elevation([[1.0], [2.0, 3.0]], 0.0, 0.0), "x is not a number"),
        (lambda: FIXED.pressure(0.0, 0.0, -1.0, 0.0, water_density=0.0), "water density"),
        (lambda: FIXED.complex_dynamic_pressure(0.0, 0.0, -1.0, water_density=np.nan), "water density"),
        (lambda: FIXED.dynamic_pressure(0.0, 0.0, -1.0, 0.0, water_density="salt"), "water density"),
        (lambda: WAVE.in_fixed_axes(stretching="wheler"), "wheler"),
        (lambda: WAVE.in_translating_axes(5.0, stretching="airy"), "airy"),
        (lambda: WAVE.in_fixed_axes(gravity=-9.8), "gravity"),
        (lambda: WAVE.in_fixed_axes(gravity=np.nan), "gravity"),
        (lambda: WAVE.in_translating_axes(np.inf), "speed"),
        (lambda: WAVE.in_translating_axes(200.0), "200"),
        (lambda: WAVE.in_translating_axes("fast"), "speed is not a number"),
        (lambda: WAVE.in_translating_axes(5.0, 45.0), "radians"),
        (lambda: WAVE.in_translating_axes(5.0, np.nan), "ship heading"),
        (lambda: WAVE.in_translating_axes(5.0, time=np.inf), "time"),
        (lambda: WAVE.in_translating_axes(5.0, position=(1.0,)), "position"),
        (lambda: WAVE.in_translating_axes(5.0, position=7.0), "position"),
        (lambda: WAVE.in_translating_axes(5.0, position=(np.nan, 0.0)), "position"),
        (lambda: FIXED.in_translating_axes(5.0, 90.0), "radians"),
        (lambda: FixedSeaway(WAVE.components, 270.0), "radians"),
        (lambda: FixedSeaway(WAVE, 0.0), "WaveComponents"),
        (lambda: TranslatingSeaway(WAVE.components, True), "speed"),
        (lambda: TranslatingSeaway(WAVE.components, 5.0, method="grid"), "grid"),
        (lambda: ship_position((0.0, 0.0), 5.0, 100.0, 1.0), "radians"),
        (lambda: ship_position((0.0, 0.0), 5.0, 0.0, np.nan), "elapsed"),
        (lambda: ship_position((0.0, np.inf), 5.0, 0.0, 1.0), "position"),
    ],
)
def test_bad_input_is_refused(bad: Callable[[], object], words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        bad()


def test_gravity_of_the_view_is_that_of_its_pressure_and_of_its_waves() -> None:
    """Mars: k = ω²/g, p = ρ g(a cos θ e^{k(z − ζ)} − z), and (27) with that k at another course and time."""
    g, rho, z = 3.71, 1025.0, -2.0
    wave = RegularSeaway(1.0, 0.5, 0.3)
    k = 0.25 / g
    fixed = wave.in_fixed_axes(gravity=g)
    dynamic = fixed.dynamic_pressure(0.0, 0.0, z, 0.0, water_density=rho)
    assert dynamic == pytest.approx(rho * g * np.exp(k * (z - 1.0)), rel=1e-13)
    total = fixed.pressure(0.0, 0.0, z, 0.0, water_density=rho)
    assert total == pytest.approx(dynamic - rho * g * z, rel=1e-13)
    moving = fixed.in_translating_axes(7.0, 1.1, time=40.0, position=(30.0, -20.0))
    x, y = ship_position((30.0, -20.0), 7.0, 1.1, 25.0)
    assert moving.elevation(0.0, 0.0, 65.0) == pytest.approx(fixed.elevation(x, y, 65.0), abs=1e-12)
