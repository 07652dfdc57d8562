"""The table of Salvesen, Tuck and Faltinsen element by element, and the motions that follow from it."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import KNOT, Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load, diffraction_momentum
from panelsim.hydro.interpolation import complex_inertia
from panelsim.hydro.speed_terms import radiation_at_speed, salvesen_tuck_faltinsen, speed_coupling
from panelsim.hydro.store import database_for
from panelsim.hydro.transom import Transom
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.response.response import response as solve_response
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

SPEED = 20 * KNOT
SOURCES = pytest.mark.parametrize("source", ["bem", "strip"])


@cache
def frigate(source: str) -> tuple[Ship, HydroDatabase, Transom]:
    ship = load_ship("frigate")
    database = HydroDatabase.compute(ship, "strip") if source == "strip" else database_for(ship)
    return ship, database, Transom.of_ship(ship, database.frequencies)


def printed_table(a0: np.ndarray, b0: np.ndarray, w: float, u: float) -> tuple[np.ndarray, np.ndarray]:
    """Salvesen, Tuck and Faltinsen (1970), element by element, pitch positive bow down; w is ω_e."""
    a, b, q = a0.copy(), b0.copy(), u / w**2
    for plane, turn, sign in ((2, 4, 1.0), (1, 5, -1.0)):
        for i in (0, 1, 2, 3):
            a[i, turn] -= sign * q * b0[i, plane]
            b[i, turn] += sign * u * a0[i, plane]
            a[turn, i] += sign * q * b0[plane, i]
            b[turn, i] -= sign * u * a0[plane, i]
        a[turn, turn] += u * q * a0[plane, plane]
        b[turn, turn] += u * q * b0[plane, plane]
    return a, b


def printed_transom(a: np.ndarray, b: np.ndarray, x: float, w: float, u: float) -> list[np.ndarray]:
    """Its end terms, element by element; `a`, `b` (3, 3) of the section in sway, heave and roll."""
    more_a, more_b = np.zeros((2, 6, 6))
    q, q2 = u / w**2, (u / w) ** 2
    more_a[2, 2], more_b[2, 2] = -q * b[1, 1], u * a[1, 1]
    more_a[2, 4], more_b[2, 4] = q * x * b[1, 1] - q2 * a[1, 1], -u * x * a[1, 1] - q2 * b[1, 1]
    more_a[4, 2], more_b[4, 2] = q * x * b[1, 1], -u * x * a[1, 1]
    more_a[4, 4] = -q * x**2 * b[1, 1] + q2 * x * a[1, 1]
    more_b[4, 4] = u * x**2 * a[1, 1] + q2 * x * b[1, 1]
    for i, s in ((1, 0), (3, 2)):
        more_a[i, 5], more_b[i, 5] = -q * x * b[s, 0] + q2 * a[s, 0], u * x * a[s, 0] + q2 * b[s, 0]
        more_a[5, i], more_b[5, i] = -q * x * b[0, s], u * x * a[0, s]
        for j, t in ((1, 0), (3, 2)):
            more_a[i, j], more_b[i, j] = -q * b[s, t], u * a[s, t]
    more_a[5, 5] = -q * x**2 * b[0, 0] + q2 * x * a[0, 0]
    more_b[5, 5] = u * x**2 * a[0, 0] + q2 * x * b[0, 0]
    return [more_a, more_b]


def assert_same(found: np.ndarray, expected: np.ndarray) -> None:
    """To rounding of the largest element of force or moment, in rows and columns."""
    lever = np.array([1.0, 1.0, 1.0, 60.0, 60.0, 60.0])
    scale = np.outer(lever, lever)
    np.testing.assert_allclose(found / scale, expected / scale, atol=1e-12 * np.abs(expected / scale).max())


def at_rest(database: HydroDatabase, w: float) -> tuple[np.ndarray, np.ndarray]:
    inertia = complex_inertia(database, np.array([w]))[0]
    return inertia.real, -w * inertia.imag


@SOURCES
@pytest.mark.parametrize("w", [0.3, 1.0, -0.7])
def test_the_table_is_the_printed_one(source: str, w: float) -> None:
    _, database, _ = frigate(source)
    a, b = salvesen_tuck_faltinsen(database, np.array([w]), SPEED)
    expected_a, expected_b = printed_table(*at_rest(database, abs(w)), abs(w), SPEED)
    assert_same(a[0], expected_a)
    assert_same(b[0], expected_b)


@SOURCES
def test_transom_terms_are_the_printed_ones(source: str) -> None:
    _, database, transom = frigate(source)
    index = int(np.searchsorted(database.frequencies, 1.0))
    w = float(database.frequencies[index])
    bare, with_transom = (salvesen_tuck_faltinsen(database, np.array([w]), SPEED, t) for t in (None, transom))
    sectional = [m[index] for m in (transom.solution.added_mass, transom.solution.damping)]
    a, b = (0.5 * (m + m.T) for m in sectional)
    expected = printed_transom(a, b, transom.x, w, SPEED)
    for more, less, end in zip(with_transom, bare, expected, strict=True):
        assert_same(more[0] - less[0], end)
    # A 10.2 m wide transom of little depth: about the flat plate, which is π ρ b²/8 = 4.2e4 kg/m.
    assert a[1, 1] == pytest.approx(4.2e4, rel=0.15)
    assert with_transom[1][0, 4, 4] / bare[1][0, 4, 4] == pytest.approx(1.3, abs=0.1)
    assert not np.shares_memory(with_transom[1], bare[1])


@SOURCES
@settings(deadline=None, max_examples=15)
@given(w=st.floats(-4.0, 4.0), speed=st.floats(0.0, 20.0), wet=st.booleans())
def test_it_is_the_momentum_form(source: str, w: float, speed: float, wet: bool) -> None:
    """[(iω - Lᵀ) Z + U Z_T] (iω + L), at any frequency, 0 and below 0 included."""
    _, database, transom = frigate(source)
    w = 0.0 if abs(w) < 1e-3 else w
    omega = np.array([w])
    lever = np.eye(6) * 1j * w
    coupling = speed_coupling(speed)
    inner = (lever - coupling.T) @ complex_inertia(database, omega)[0]
    if wet:
        inner = inner + speed * transom.inertia(omega)[0]
    expected = inner @ (lever + coupling)
    found = radiation_at_speed(database, omega, speed, transom if wet else None).impedance[0]
    assert_same(found, expected)


@SOURCES
def test_where_waves_stand_still_the_load_is_a_stiffness(source: str) -> None:
    _, database, transom = frigate(source)
    w = np.array([0.0, 1e-7, -1e-7])
    found = radiation_at_speed(database, w, SPEED)
    a = database.added_mass_zero
    expected = np.zeros((6, 6))
    expected[4, 4], expected[5, 5] = -(SPEED**2) * a[2, 2], -(SPEED**2) * a[1, 1]
    # Munk: sway and heave make the pair of pitch and yaw, here of a lop-sided hull none.
    assert_same(found.stiffness[0], expected)
    assert_same(found.impedance[0], expected.astype(complex))
    scale = np.abs(found.impedance[0]).max()
    assert np.abs(found.impedance[1:] - found.impedance[0]).max() < 1e-5 * scale
    np.testing.assert_array_equal(found.impedance[1], found.impedance[2].conj())
    assert np.isfinite(radiation_at_speed(database, w, SPEED, transom).impedance).all()
    with pytest.raises(PanelsimError, match="infinite where waves stand still"):
        salvesen_tuck_faltinsen(database, w, SPEED)
    assert_same(salvesen_tuck_faltinsen(database, w, 0.0)[0][0], a)


@SOURCES
def test_coupling_at_speed_is_that_of_the_reversed_ship(source: str) -> None:
    """Timman and Newman (1962): A_ij(U) = A_ji(-U); what speed adds to 35 it takes from 53, to 26 from 62."""
    _, database, _ = frigate(source)
    w = np.array([0.4, 0.8, 1.2])
    rest, moving = (salvesen_tuck_faltinsen(database, w, u) for u in (0.0, SPEED))
    for still, under_way in zip(rest, moving, strict=True):
        change = under_way - still
        for i, j in ((2, 4), (1, 5), (3, 5), (0, 4)):
            scale = np.abs(under_way[:, i, j]).max() + 1.0
            np.testing.assert_allclose(change[:, i, j], -change[:, j, i], atol=1e-12 * scale)
    assert np.abs(moving[1][:, 2, 4] - rest[1][:, 2, 4]).min() > 1e7


def response(
    source: str, omega: np.ndarray, heading: float, speed: float, *, with_transom: bool = False
) -> np.ndarray:
    """Motions (M, 6) per metre of wave of the free ship, exp(+iω_e t)."""
    ship, database, section = frigate(source)
    transom = section if with_transom else None
    beta = np.full(len(omega), heading)
    encounter = encounter_frequency(omega, beta, speed, ship.gravity)
    waves = WaveComponents(np.ones(len(omega)), omega, beta, np.zeros(len(omega)))
    force = froude_krylov_transfer(ship, waves) + diffraction_load(database, omega, beta, speed, transom)
    radiation = radiation_at_speed(database, encounter, speed, transom).impedance
    impedance = radiation + ship.hydrostatics.stiffness - encounter[:, None, None] ** 2 * ship.inertia
    motions: np.ndarray = np.linalg.solve(impedance, force[..., None])[..., 0]
    return motions


@SOURCES
@pytest.mark.parametrize("with_transom", [False, True])
@pytest.mark.parametrize("heading_deg", [180, 0])
def test_a_long_wave_carries_the_ship_at_speed(source: str, with_transom: bool, heading_deg: int) -> None:
    """Heave 1, pitch the slope at -90° ahead and +90° from astern; wrong signs in L or Lᵀ miss by a half."""
    omega = np.array([0.15])
    k = omega[0] ** 2 / frigate(source)[0].gravity
    motions = response(source, omega, np.radians(heading_deg), SPEED, with_transom=with_transom)[0]
    expected = 1j * np.cos(np.radians(heading_deg)) * k
    print(source, with_transom, abs(motions[2]), motions[4] / expected)
    # 23 ship lengths; what is left are terms of U ω/g, 0.16, squared, and of k L, 0.28, squared.
    assert abs(motions[2] - 1.0) < 0.01
    assert abs(motions[4] / expected - 1.0) < 0.05


@SOURCES
def test_in_beam_seas_a_long_wave_moves_the_ship_as_the_water(source: str) -> None:
    motions = response(source, np.array([0.15]), 0.5 * np.pi, SPEED)[0]
    k = 0.15**2 / 9.80665
    # Roll is on the way to its resonance, 1/(1 - (0.15/0.7)²).
    assert motions[2] == pytest.approx(1.0, abs=0.01)
    assert motions[1] == pytest.approx(1j, abs=0.03)
    assert motions[3] / (1j * k) == pytest.approx(1.05, abs=0.03)


@SOURCES
@pytest.mark.parametrize(("heading_deg", "omega"), [(180, 0.6), (140, 0.8), (30, 1.5)])
def test_transom_terms_of_diffraction_are_the_printed_ones(
    source: str, heading_deg: int, omega: float
) -> None:
    """F3 gains (U/iω_e) h3, F5 -x_A times that, F6 +x_A (U/iω_e) h2, h = -iω_e p the sectional force."""
    ship, database, transom = frigate(source)
    wave, heading = np.array([omega]), np.radians([heading_deg])
    encounter = encounter_frequency(wave, heading, SPEED, ship.gravity)
    bare, more = (diffraction_load(database, wave, heading, SPEED, t)[0] for t in (None, transom))
    h = -1j * encounter * transom.momentum(wave, heading, encounter)[0]
    gain = SPEED / (1j * encounter) * h
    x = transom.x
    np.testing.assert_allclose((more - bare)[2], gain[2], rtol=1e-9)
    np.testing.assert_allclose((more - bare)[4], -x * gain[2], rtol=1e-9)
    np.testing.assert_allclose((more - bare)[5], x * gain[1], rtol=1e-9, atol=1e-6)
    assert abs(gain[2]) > 0.0


@pytest.mark.parametrize("encounter", [0.6, -0.6, 100.0])
def test_the_transom_takes_the_momentum_of_the_water_that_passes(encounter: float) -> None:
    """In waves long beside its breadth, P_3 = -(a33 + b33/(iω_e)) iω ζ at the section, whatever the ω_e."""
    ship, _, transom = frigate("strip")
    wave, heading, met = np.array([0.6]), np.radians([150.0]), np.array([encounter])
    momentum = transom.momentum(wave, heading, met)[0]
    k = 0.6**2 / ship.gravity
    water = 1j * 0.6 * np.exp(-1j * k * transom.x * np.cos(heading[0]))
    inertia = transom.inertia(met)[0]
    # k times half of the breadth, 0.18, squared, and its mean depth.
    assert momentum[2] == pytest.approx(-inertia[2, 2] * water, rel=0.1)
    assert momentum[4] == pytest.approx(-transom.x * momentum[2])
    assert momentum[5] == pytest.approx(transom.x * momentum[1])


def test_at_zero_speed_nothing_is_added() -> None:
    _, database, transom = frigate("bem")
    wave, heading = np.array([0.6]), np.array([2.0])
    bare, more = (diffraction_load(database, wave, heading, 0.0, t) for t in (None, transom))
    np.testing.assert_array_equal(bare, more)
    np.testing.assert_allclose(bare, -0.6j * diffraction_momentum(database, wave, heading, 0.0))
    found = radiation_at_speed(database, np.array([0.5]), 0.0, transom)
    assert_same(found.damping[0], at_rest(database, 0.5)[1])
    assert not found.stiffness.any()


def test_heave_and_pitch_of_strips_follow_those_of_panels_at_speed() -> None:
    omega = np.arange(0.3, 0.85, 0.1)
    k = omega**2 / 9.80665
    strip, bem = (response(source, omega, np.pi, SPEED)[:, [Dof.HEAVE, Dof.PITCH]] for source in SOURCE_NAMES)
    error = np.abs(strip - bem) / np.stack([np.ones_like(k), k], axis=1)
    print(np.round(error, 3))
    # 6 % in heave and 7 % in pitch, near its peak at 0.4 rad/s.
    assert error.max() < 0.1


SOURCE_NAMES = ("strip", "bem")


def test_a_transom_of_another_hull_is_refused() -> None:
    """One at the same place too: the hull is known by its fingerprint."""
    _, database, transom = frigate("bem")
    other = replace(transom, fingerprint="that of another hull")
    wave = np.array([0.6])
    with pytest.raises(PanelsimError, match="different hulls") as refused:
        diffraction_load(database, wave, wave, SPEED, other)
    assert transom.fingerprint in str(refused.value) and "Transom.of_ship" in str(refused.value)
    with pytest.raises(PanelsimError, match="different hulls"):
        radiation_at_speed(database, wave, SPEED, other)
    ship = frigate("bem")[0]
    transom.require_for(ship)
    with pytest.raises(PanelsimError, match="another ship than"):
        other.require_for(ship)
    with pytest.raises(PanelsimError, match="another ship than"):
        solve_response(ship, database, frequencies=wave, wave_headings=[2.0], speeds=[SPEED], transom=other)


def test_a_hull_without_a_transom_is_told_so() -> None:
    with pytest.raises(PanelsimError, match="no wet transom"):
        Transom.of_ship(load_ship("wigley_iii"), np.array([0.0, 1.0, 2.0]))


@pytest.mark.parametrize("speed", [-1.0, 500.0, np.nan, np.inf])
def test_impossible_speeds_are_refused(speed: float) -> None:
    with pytest.raises(PanelsimError, match="speed is out of range"):
        radiation_at_speed(frigate("bem")[1], np.array([0.5]), speed)


@pytest.mark.parametrize("encounter", [np.array([0.5, np.nan]), np.array([[0.5]]), np.array([np.inf])])
def test_impossible_frequencies_are_refused(encounter: np.ndarray) -> None:
    with pytest.raises(PanelsimError, match="row of finite numbers"):
        radiation_at_speed(frigate("bem")[1], encounter, 0.0)
