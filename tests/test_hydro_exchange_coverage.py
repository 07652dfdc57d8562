"""Tables of diffraction: what they cover, what is interpolated, at speed; axes and signs by closed forms."""

from functools import cache

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import hull_folder
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import beyond_resolution, diffraction_load, diffraction_momentum
from panelsim.hydro.exchange.assemble import database_of
from panelsim.hydro.exchange.coverage import coverage
from panelsim.hydro.exchange.foreign import ForeignCoefficients
from panelsim.hydro.exchange.frame import Frame
from panelsim.hydro.exchange.incident import froude_krylov
from panelsim.hydro.exchange.wamit import frequency_of
from panelsim.hydro.interpolation import complex_inertia
from panelsim.hydro.store import STORED_NAME
from panelsim.hydro.tabulated_diffraction import tabulated_momentum
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

SPEED = 10.29  # m/s
STEP = 0.1  # rad/s
WAVES = np.round(np.arange(0.2, 1.21, STEP), 9)


@pytest.fixture(scope="module")
def potentials() -> HydroDatabase:
    return HydroDatabase.load(hull_folder("halifax") / STORED_NAME)


def tabulated(database: HydroDatabase, waves: FloatArray, headings_deg: FloatArray) -> HydroDatabase:
    """The same coefficients with tables at rest for potentials."""
    headings = np.radians(headings_deg)
    table = np.array([diffraction_load(database, np.full(len(headings), w), headings, 0.0) for w in waves])
    dims = ("wave_frequency", "wave_heading", "influenced_dof")
    dataset = database.dataset[["added_mass", "radiation_damping", "added_mass_infinite"]].assign(
        diffraction_real=(dims, table.real), diffraction_imag=(dims, table.imag)
    )
    return HydroDatabase(dataset.assign_coords(wave_frequency=waves, wave_heading=headings))


@pytest.fixture(scope="module")
def tables(potentials: HydroDatabase) -> HydroDatabase:
    """Every 15° all round, as many programs have it."""
    return tabulated(potentials, WAVES, np.arange(-165.0, 180.1, 15.0))


def off(load: np.ndarray, exact: np.ndarray) -> FloatArray:
    """Largest error (6,) over the peak of each motion, or of a thousandth of the largest."""
    peak = np.abs(exact).max(axis=0)
    peak = np.maximum(peak, 1e-3 * np.repeat([peak[:3].max(), peak[3:].max()], 3))
    return np.abs(load - exact).max(axis=0) / peak


def test_stored_waves_at_rest_are_met_to_rounding(tables: HydroDatabase, potentials: HydroDatabase) -> None:
    for heading in np.radians([-165.0, -90.0, 0.0, 30.0, 180.0, -180.0, 195.0]):
        there, exact = (diffraction_load(d, WAVES, np.array([heading]), 0.0) for d in (tables, potentials))
        assert off(there, exact).max() < 1e-9


def test_waves_between_the_stored_ones_are_within_three_per_cent(
    tables: HydroDatabase, potentials: HydroDatabase
) -> None:
    """What the largest turn of phase is chosen for; at ends of the range the cubic has one side only."""
    rng = np.random.default_rng(5)
    omega, heading = rng.uniform(0.3, 1.0, 200), rng.uniform(-np.pi, np.pi, 200)
    error = off(*(diffraction_load(d, omega, heading, 0.0) for d in (tables, potentials)))
    print(np.round(100 * error, 2), "%")
    assert error.max() < 0.03


def test_beam_seas_at_speed_are_exact(tables: HydroDatabase, potentials: HydroDatabase) -> None:
    """ω_e is ω: the scattered momentum is that at rest, and speed convects it."""
    heading = np.array([np.pi / 2])
    there, exact = (diffraction_load(d, WAVES, heading, SPEED) for d in (tables, potentials))
    assert off(there, exact).max() < 1e-6
    momentum = diffraction_momentum(tables, WAVES, heading, SPEED)
    at_rest = diffraction_load(tables, WAVES, heading, 0.0)
    assert there[:, Dof.PITCH] - at_rest[:, Dof.PITCH] == pytest.approx(SPEED * momentum[:, Dof.HEAVE])
    assert there[:, Dof.YAW] - at_rest[:, Dof.YAW] == pytest.approx(-SPEED * momentum[:, Dof.SWAY])


@pytest.mark.parametrize(
    ("heading_deg", "allowed"), [(180, 0.24), (150, 0.21), (120, 0.1), (60, 0.1), (30, 0.07), (0, 0.08)]
)
def test_loads_at_speed_are_nearer_than_those_at_rest(
    tables: HydroDatabase, potentials: HydroDatabase, heading_deg: float, allowed: float
) -> None:
    """Mean error of the worst motion over 0.3 to 1.2 rad/s, of its peak, as the module states it."""
    omega, heading = WAVES[1:], np.radians([float(heading_deg)])
    exact = diffraction_load(potentials, omega, heading, SPEED)
    peak = np.abs(exact).max(axis=0)
    peak = np.maximum(peak, 0.01 * np.repeat([peak[:3].max(), peak[3:].max()], 3))
    mean = [
        (np.abs(load - exact) / peak).mean(axis=0)
        for load in (
            diffraction_load(tables, omega, heading, SPEED),
            diffraction_load(tables, omega, heading, 0.0),
        )
    ]
    print(heading_deg, *(np.round(100 * each) for each in mean))
    assert mean[0].max() < allowed < mean[1].max()


def test_long_waves_at_speed_push_as_their_flow_does(
    tables: HydroDatabase, potentials: HydroDatabase
) -> None:
    """At 0.2 rad/s, 12 ship lengths, only what the wave bends over the hull is missed."""
    for heading in (np.pi, 2.5, 0.5, 0.0):
        there, exact = (
            diffraction_load(d, np.array([0.2]), np.array([heading]), SPEED) for d in (tables, potentials)
        )
        scale = np.repeat([np.abs(exact[0, :3]).max(), np.abs(exact[0, 3:]).max()], 3)
        error = np.abs(there - exact)[0] / scale
        print(heading, np.round(100 * error, 1))
        # The zero-speed load as it is would be 17 % (following) to 21 % (head) off.
        assert error.max() < 0.06


def test_overtaken_waves_are_smooth_through_zero_encounter(tables: HydroDatabase) -> None:
    omega = np.array([0.9])
    speeds = tables.gravity / omega[0] * (1.0 + np.array([-2e-3, -1e-3, 0.0, 1e-3, 2e-3]))
    loads = np.array([diffraction_load(tables, omega, np.array([0.0]), u)[0] for u in speeds])
    assert np.isfinite(loads).all()
    assert np.abs(loads[1] + loads[3] - 2 * loads[2]).max() < 1e-3 * np.abs(loads[2]).max()


@cache
def sphere_database() -> HydroDatabase:
    return HydroDatabase.load(hull_folder("sphere") / STORED_NAME)


@settings(deadline=None, max_examples=20)
@given(st.floats(0.01, 6.0))
def test_inertia_of_negative_frequencies_is_the_conjugate(omega: float) -> None:
    database = sphere_database()
    ahead, overtaken = complex_inertia(database, np.array([omega, -omega]))
    assert np.array_equal(overtaken, ahead.conj())
    # exp(+iωt): damping makes the momentum lag, Z = A - iB/ω.
    assert -ahead[Dof.HEAVE, Dof.HEAVE].imag > 0.0


def test_inertia_is_the_stored_one_and_tends_to_the_infinite(tables: HydroDatabase) -> None:
    omega = tables.frequencies[5]
    stored = tables.added_mass[5] - 1j * tables.radiation_damping[5] / omega
    last = tables.frequencies[-1]
    at_five, far = complex_inertia(tables, np.array([omega, 1e4 * last]))
    assert at_five == pytest.approx(stored, rel=1e-9, abs=1e-3)
    assert far.real == pytest.approx(tables.added_mass_infinite, rel=1e-5, abs=1.0)


def test_a_body_that_moves_no_water_in_some_motion_is_met(potentials: HydroDatabase) -> None:
    """A sphere about its centre: Z is singular in roll, pitch and yaw."""
    sphere = sphere_database()
    waves = sphere.frequencies[10:16]
    there = tabulated(sphere, waves, np.array([-90.0, 0.0, 90.0, 180.0]))
    load = diffraction_load(there, waves, np.zeros(1), 1.0)
    exact = diffraction_load(sphere, waves, np.zeros(1), 1.0)
    assert np.isfinite(load).all()
    assert off(load, exact)[[0, 2]].max() < 0.3


# --- coverage


@pytest.mark.parametrize(
    ("omega", "heading_deg", "words"),
    [
        (0.19, 180.0, "0.19 rad/s"),
        (1.3, 180.0, "0.2 to 1.2 rad/s"),
        (1.2, 172.0, "172° at 1.2 rad/s"),
        (1.15, 98.0, "steps of .* or less"),
    ],
)
def test_waves_outside_the_tables_are_refused(
    tables: HydroDatabase, omega: float, heading_deg: float, words: str
) -> None:
    sea = np.array([0.5, omega]), np.radians([180.0, heading_deg])
    with pytest.raises(PanelsimError, match=words) as refusal:
        diffraction_load(tables, *sea, 0.0)
    assert "of 1 of 2" in str(refusal.value) or "1 of 2 waves" in str(refusal.value)


def test_gaps_are_refused_and_their_ends_are_not(potentials: HydroDatabase) -> None:
    gap = tabulated(
        potentials, np.array([0.3, 0.4, 0.5, 0.8, 0.9]), np.array([-30.0, 0.0, 30.0, 90.0, 180.0])
    )
    for omega, heading_deg in ((0.5, 0.0), (0.8, 30.0), (0.45, 15.0), (0.85, 90.0), (0.8, 180.0)):
        diffraction_load(gap, np.array([omega]), np.radians([heading_deg]), SPEED)
    for omega, heading_deg in ((0.6, 0.0), (0.4, 60.0), (0.4, 135.0), (0.4, -90.0), (0.9, 15.0)):
        with pytest.raises(PanelsimError, match="do not hold"):
            diffraction_load(gap, np.array([omega]), np.radians([heading_deg]), SPEED)
    words = coverage(gap)
    assert "0.3 to 0.5, 0.8 to 0.9 rad/s (5 stored)" in words
    assert "-30, 0, 30, 90, 180°" in words


def test_one_frequency_and_one_heading_serve_that_wave_only(potentials: HydroDatabase) -> None:
    one = tabulated(potentials, np.array([0.6]), np.array([150.0]))
    sea = np.array([0.6]), np.radians([150.0])
    assert diffraction_load(one, *sea, 0.0) == pytest.approx(diffraction_load(potentials, *sea, 0.0))
    for omega, heading_deg in ((0.61, 150.0), (0.6, 149.0)):
        with pytest.raises(PanelsimError, match="do not hold"):
            diffraction_load(one, np.array([omega]), np.radians([heading_deg]), 0.0)
    assert "no others." in coverage(one)


def test_coverage_says_what_is_held_and_what_is_not(tables: HydroDatabase, potentials: HydroDatabase) -> None:
    words = coverage(tables)
    print(words)
    assert "0.2 to 1.2 rad/s (11 stored)" in words
    # 2 rad of turn over 62 m at 15°: k = 0.123 /m, 1.1 rad/s.
    assert "all round for waves of up to 1 rad/s" in words
    assert "approximation" in words
    assert "any wave frequency, heading and speed" in coverage(potentials)


def test_waves_met_faster_than_radiation_reaches_are_told(tables: HydroDatabase) -> None:
    told = beyond_resolution(tables, np.array([0.8, 1.2]), np.full(2, np.pi), SPEED)
    assert told.tolist() == [False, True]


# --- axes and signs


def moved(point: FloatArray, about: FloatArray) -> FloatArray:
    """Displacements (6, 3) of a point for unit motions about another, by the cross product itself."""
    return np.vstack([np.eye(3), np.cross(np.eye(3), point - about)])


@settings(deadline=None, max_examples=20)
@given(st.lists(st.floats(-20.0, 20.0), min_size=6, max_size=6))
def test_matrices_and_loads_move_to_the_centre_of_gravity(numbers: list[float]) -> None:
    """A point mass at (3, -2, 5) m, and a force on it, seen from anywhere."""
    mass, point = 2.0, np.array([3.0, -2.0, 5.0])
    center, about = np.array(numbers[:3]), np.array(numbers[3:])
    frame = Frame.given(forward="+x", center_of_gravity=center, moments_about=about)
    arms = moved(point, about)
    wanted = moved(point, center)
    assert frame.matrix(mass * arms @ arms.T) == pytest.approx(mass * wanted @ wanted.T, abs=1e-9)
    force = np.array([1.0, 2.0, -3.0])
    load = np.concatenate([force, np.cross(point - about, force)]).astype(complex)
    here = frame.load(load[None, None], np.zeros(1), np.zeros(1))[0, 0]
    assert here == pytest.approx(np.concatenate([force, np.cross(point - center, force)]), abs=1e-9)


def test_a_crest_at_the_origin_passes_a_point_ahead_later() -> None:
    frame = Frame.given(forward="+x", center_of_gravity=(10.0, 4.0, 0.0), moments_about=(10.0, 4.0, 0.0))
    direction, k = np.array([0.0, np.pi / 2, np.pi]), np.array([0.1])
    load = np.ones((1, 3, 6), dtype=complex)
    phase = np.angle(frame.load(load, direction, k)[0, :, 0])
    # With the crest at the origin the CG is k·10 behind it: a crest at the CG leads that by as much.
    assert phase == pytest.approx([1.0, 0.4, -1.0])


def test_headings_are_those_of_our_axes() -> None:
    """Travel towards +y, port, is a wave from starboard: -90°; axes that look astern turn it round."""
    places = {"center_of_gravity": (0.0, 0.0, 0.0), "moments_about": (0.0, 0.0, 0.0)}
    travel = np.radians([0.0, 90.0, 180.0])
    ahead = Frame.given(forward="+x", **places).wave_heading(travel)
    astern = Frame.given(forward="-x", **places).wave_heading(travel)
    assert np.degrees(np.angle(np.exp(1j * ahead)))[1] == pytest.approx(-90.0)
    assert np.cos(ahead) == pytest.approx([1.0, 0.0, -1.0], abs=1e-12)
    assert np.cos(astern) == pytest.approx([-1.0, 0.0, 1.0], abs=1e-12)
    assert np.sin(astern)[1] == pytest.approx(1.0)


def test_our_froude_krylov_is_that_of_the_loads() -> None:
    ship = load_ship("frigate", 5.0)
    headings = np.radians([180.0, 140.0, 90.0, -60.0, 0.0])
    ours = froude_krylov(ship, np.array([0.4, 0.8]), headings)
    for w, omega in enumerate((0.4, 0.8)):
        waves = WaveComponents(np.ones(5), np.full(5, omega), headings, np.zeros(5))
        exact = froude_krylov_transfer(ship, waves)
        scale = np.repeat([np.abs(exact[:, :3]).max(), np.abs(exact[:, 3:]).max()], 3)
        # Pressure linear between corners there, at three points of each triangle here.
        assert (np.abs(ours[w] - exact) / scale).max() < 0.02


def test_values_of_the_first_column_of_wamit() -> None:
    assert frequency_of(2.0 * np.pi, "period") == pytest.approx(1.0)
    assert frequency_of(-1.0, "period") == 0.0 and frequency_of(0.0, "period") == np.inf
    assert frequency_of(0.7, "frequency") == 0.7
    assert frequency_of(0.0, "frequency") == 0.0 and frequency_of(-1.0, "frequency") == np.inf


def test_a_file_of_wamit_itself_pushes_as_long_waves_do() -> None:
    """ITI Energy's barge by WAMIT, in the tests of NREL's OpenFAST: numbers of the longest wave, 125.664 s.

    40 m by 40 m, draft 4 m, a moonpool of 10 m by 10 m: 6000 m3. X1 = 1.98307i in a wave that travels with x,
    X2 = 1.98307i and X4 = -54.4711i in one that travels with y; A11 = 1779.42 m3. A long wave pushes with its
    slope times volume and added volume.
    """
    frequency, k = np.array([2.0 * np.pi / 125.664]), (2.0 * np.pi / 125.664) ** 2 / 9.80665
    loads = np.zeros((1, 2, 6), dtype=complex)
    loads[0, 0, [Dof.SURGE, Dof.PITCH]] = 1.983066j, 54.47115j
    loads[0, 1, [Dof.SWAY, Dof.ROLL]] = 1.983073j, -54.47108j
    loads[..., Dof.HEAVE] = 1591.02
    frame = Frame.given(forward="+x", center_of_gravity=(0.0, 0.0, 0.0), moments_about=(0.0, 0.0, 0.0))
    travel = np.radians([0.0, 90.0])
    ours = frame.load(loads, travel, np.array([k]))[0]
    heading = frame.wave_heading(travel)
    # exp(iωt - ik(x cos β - y sin β)): the force is minus the slope of pressure times volume.
    slope = 1j * k * np.array([np.cos(heading), -np.sin(heading)]).T
    push = (6000.0 + 1779.42) * slope
    assert ours[:, :2] == pytest.approx(push, rel=2e-3, abs=1e-9)
    # Roll and pitch by the righting moment of the waterplane on the slope, bow and starboard down.
    stiffness = 201300.0
    assert ours[0, Dof.PITCH] / slope[0, 0] == pytest.approx(stiffness, rel=0.1)
    assert ours[1, Dof.ROLL] / slope[1, 1] == pytest.approx(-stiffness, rel=0.1)
    assert frequency[0] == pytest.approx(0.05, rel=1e-5)


# --- numbers that are not sound


def foreign_of(database: HydroDatabase, ship: Ship, **changed: object) -> ForeignCoefficients:
    """The tables as another program in ship axes over its CG would have them."""
    heading = database.wave_headings
    place = np.array([0.0, 0.0, -ship.waterline])
    omega = database.wave_frequencies
    values: dict[str, object] = {
        "source": "a test",
        "frame": Frame("+x", place, place),
        "frequency": database.frequencies[1:],
        "added_mass": database.added_mass[1:],
        "radiation_damping": database.radiation_damping[1:],
        "wave_frequency": omega,
        "wave_direction": -heading,
        "diffraction": database.diffraction_table,
        "froude_krylov": froude_krylov(ship, omega, heading),
        "added_mass_zero": database.added_mass_zero,
        "added_mass_infinite": database.added_mass_infinite,
    }
    return ForeignCoefficients(**(values | changed))  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def halifax_coarse() -> Ship:
    return load_ship("halifax", 12.0)


def test_bundled_coefficients_come_back_through_the_door(tables: HydroDatabase, halifax_coarse: Ship) -> None:
    database = database_of(foreign_of(tables, halifax_coarse), halifax_coarse)
    assert database.added_mass == pytest.approx(tables.added_mass, rel=1e-9, abs=1e-3)
    assert database.wave_headings == pytest.approx(tables.wave_headings, abs=1e-9)
    assert database.diffraction_table == pytest.approx(tables.diffraction_table, rel=1e-9, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "change", "words"),
    [
        ("frequency", lambda v: v[::-1], "do not rise"),
        ("frequency", lambda v: v[:-1], "not whole"),
        ("wave_frequency", lambda v: np.zeros(0), "do not rise"),
        ("added_mass", lambda v: np.where(np.arange(6) == 4, np.nan, v), "pitch"),
        ("radiation_damping", lambda v: -v, "negative"),
        ("added_mass", lambda v: np.triu(v) * [1, 1, 1, 1, -1, 1], "not symmetric|couples"),
        ("diffraction", lambda v: v[:, :-1], "not whole"),
        ("diffraction", lambda v: None, "no loads of waves"),
        ("wave_direction", np.degrees, "in degrees"),
        ("wave_direction", lambda v: np.append(v[:-1], v[0]), "comes twice"),
    ],
)
def test_numbers_that_are_not_whole_are_refused(
    tables: HydroDatabase, halifax_coarse: Ship, name: str, change: object, words: str
) -> None:
    value = getattr(foreign_of(tables, halifax_coarse), name)
    foreign = foreign_of(tables, halifax_coarse, **{name: change(value)})  # type: ignore[operator]
    with pytest.raises(PanelsimError, match=words):
        database_of(foreign, halifax_coarse)


def test_one_heading_with_two_loads_is_refused(tables: HydroDatabase, halifax_coarse: Ship) -> None:
    """-180° and 180° are one heading: alike they pass, and come once."""
    direction = np.append(-tables.wave_headings, np.pi)
    twice = {
        "wave_direction": direction,
        "froude_krylov": froude_krylov(halifax_coarse, tables.wave_frequencies, -direction),
    }
    again = np.concatenate([tables.diffraction_table, tables.diffraction_table[:, -1:]], axis=1)
    assert tables.wave_headings[-1] == pytest.approx(np.pi)
    database = database_of(foreign_of(tables, halifax_coarse, diffraction=again, **twice), halifax_coarse)
    assert len(database.wave_headings) == len(tables.wave_headings)
    again[:, -1] *= 1.1
    with pytest.raises(PanelsimError, match="two loads for one heading"):
        database_of(foreign_of(tables, halifax_coarse, diffraction=again, **twice), halifax_coarse)


def test_encounter_is_signed_in_the_tables(tables: HydroDatabase, potentials: HydroDatabase) -> None:
    """A wave that a fast ship overtakes: with the modulus of ω_e the momentum is further off."""
    omega, heading, fast = np.array([0.7]), np.array([0.0]), 25.0
    encounter = encounter_frequency(omega, heading, fast, tables.gravity)
    assert encounter[0] < -0.5
    exact = diffraction_momentum(potentials, omega, heading, fast)[0]
    signed, modulus = (
        tabulated_momentum(tables, omega, heading, e)[0] for e in (encounter, np.abs(encounter))
    )
    for dof in (Dof.HEAVE, Dof.PITCH):
        print(
            abs(signed[dof] - exact[dof]) / abs(exact[dof]), abs(modulus[dof] - exact[dof]) / abs(exact[dof])
        )
        assert abs(signed[dof] - exact[dof]) < 0.5 * abs(modulus[dof] - exact[dof])


def test_dataset_layout_is_told(tables: HydroDatabase) -> None:
    dataset = HydroDatabase.of_ship(load_ship("halifax", 12.0), xr.Dataset(tables.dataset.data_vars)).dataset
    assert "crest at the centre of gravity" in dataset.attrs["diffraction"]
    assert dataset.attrs["potential"] == "none"
