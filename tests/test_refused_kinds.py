"""Arguments of another kind or out of range: one PanelsimError that says what was got and what to give."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import panelsim as ps
from panelsim.case.roll_damping_section import rolling_hull

HEEL = np.deg2rad([0.0, 10.0, 20.0])
WAVES, HEADINGS = np.array([0.5, 0.6]), np.array([1.0, 2.0])
SECTION = [[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]]
TERMS = ps.RollDampingTerms(linear=1e7)
NO_SHIP = ["The ship is of another kind", "allowed: a Ship, as load_ship() makes it"]
NO_DATABASE = ["The database is of another kind", "allowed: a HydroDatabase"]
NO_FILE = ["name of the file", "allowed: a text or a Path"]
NO_SPEED = ["speed", "allowed: 0 to 50 m/s", "20 * KNOT"]
NO_ANGLE = ["heading is no angle in radians", "np.deg2rad"]
NO_FREQUENCIES = ["frequencies of the transom", "allowed: "]


@cache
def ship() -> ps.Ship:
    return ps.load_ship("halifax")


@cache
def database() -> ps.HydroDatabase:
    return ps.database_for(ship())


@cache
def table() -> ps.Response:
    return ps.response(ship(), database(), frequencies=WAVES, wave_headings=[3.0], speeds=[5.0])


def scattered(
    waves: object = WAVES, heading: object = HEADINGS, speed: object = 1.0, **given: object
) -> object:
    return ps.diffraction_load(database(), waves, heading, speed, **given)


def radiated(encounter: object = WAVES, speed: object = 1.0, **given: object) -> object:
    return ps.radiation_at_speed(database(), encounter, speed, **given)


def in_wave(ship: object, wave: object, **given: object) -> object:
    return ps.righting_arm_in_wave(ship, HEEL, wave, **given)


def ikeda(hull: object, keels: object = ()) -> object:
    return ps.ikeda_damping(hull, keels, 0.1, 0.5, 1.0)


CALLS: dict[str, tuple[Callable[[], object], list[str]]] = {
    "compute a name": (lambda: ps.HydroDatabase.compute("halifax"), [*NO_SHIP, "got: 'halifax'"]),
    "compute None": (lambda: ps.HydroDatabase.compute(None), NO_SHIP),
    "compute by a list": (lambda: ps.HydroDatabase.compute(ship(), ["bem"]), ["not known", "bem | strip"]),
    "database_for None": (lambda: ps.database_for(None), NO_SHIP),
    "database_for a name": (lambda: ps.database_for("halifax"), NO_SHIP),
    "load None": (lambda: ps.HydroDatabase.load(None), NO_FILE),
    "save None": (lambda: database().save(None), NO_FILE),
    "history None": (lambda: ps.History.load(None), NO_FILE),
    "response to 3": (lambda: table().save(3), [*NO_FILE, "got: 3"]),
    "read None": (lambda: ps.read_database(None, ship()), NO_FILE),
    "read for None": (lambda: ps.read_database("none.nc", None), NO_SHIP),
    "capytaine None": (lambda: ps.read_capytaine(None, ship(), forward="+x"), NO_FILE),
    "bemio None": (lambda: ps.read_bemio(None, ship(), forward="+x"), NO_FILE),
    "hdb None": (lambda: ps.read_hdb(None, ship(), forward="+x", center_of_gravity=(0, 0, 0)), NO_FILE),
    "diffraction of None": (lambda: ps.diffraction_load(None, WAVES, HEADINGS, 1.0), NO_DATABASE),
    "diffraction degrees": (lambda: scattered(heading=[150.0, 100.0]), NO_ANGLE),
    "diffraction heading text": (lambda: scattered(heading="head"), [*NO_ANGLE, "got: 'head'"]),
    "diffraction heading complex": (lambda: scattered(heading=[1j, 1.0]), NO_ANGLE),
    "diffraction waves text": (lambda: scattered("a"), ["wave frequency is not made of real numbers"]),
    "diffraction waves infinite": (lambda: scattered([0.5, np.inf]), ["more than 0 and finite", "got: inf"]),
    "diffraction lengths": (lambda: scattered(heading=[1.0, 2.0, 3.0]), ["one length", "(2,) and (3,)"]),
    "diffraction two rows": (lambda: scattered(0.5, [[1.0, 2.0]]), ["one length", "(1,) and (1, 2)"]),
    "diffraction transom": (lambda: scattered(transom="t"), ["transom is of another kind", "got: 't'"]),
    "radiation of None": (lambda: ps.radiation_at_speed(None, WAVES, 1.0), NO_DATABASE),
    "radiation text": (lambda: radiated("a"), ["not a row of finite numbers", "got: 'a'"]),
    "radiation none": (lambda: radiated([]), ["not a row of finite numbers", "got: []"]),
    "radiation transom": (lambda: radiated(transom="t"), ["transom is of another kind"]),
    "coverage of None": (lambda: ps.coverage(None), NO_DATABASE),
    "coverage of a ship": (lambda: ps.coverage(ship()), NO_DATABASE),
    "memory of None": (lambda: ps.memory_functions(None), NO_DATABASE),
    "transom None": (lambda: ps.Transom.of_ship(ship(), None), [*NO_FREQUENCIES, "got: None"]),
    "transom none": (lambda: ps.Transom.of_ship(ship(), []), [*NO_FREQUENCIES, "got: []"]),
    "transom NaN": (lambda: ps.Transom.of_ship(ship(), [np.nan, 1]), [*NO_FREQUENCIES, "got: [nan, 1]\n"]),
    "transom falling": (lambda: ps.Transom.of_ship(ship(), [0, 1, 0.5]), ["do not rise from 0"]),
    "transom not from rest": (lambda: ps.Transom.of_ship(ship(), [0.2, 0.5]), ["do not rise from 0"]),
    "transom of None": (lambda: ps.Transom.of_ship(None, database().frequencies), NO_SHIP),
    "arms of None": (lambda: ps.righting_arm(None, HEEL), NO_SHIP),
    "arms with a word": (
        lambda: ps.righting_arm(ship(), HEEL, free_trim="no"),
        ["free_trim", "True or False"],
    ),
    "arms at complex heels": (lambda: ps.righting_arm(ship(), HEEL + 1j), ["not made of real numbers"]),
    "wave None": (lambda: in_wave(ship(), None), ["wave is of another kind", "a FrozenWave, for example"]),
    "wave a sea": (lambda: in_wave(ship(), ps.RegularSeaway(1.0, 0.6, 1.0)), ["wave is of another kind"]),
    "wave without ship": (lambda: in_wave(None, ps.FrozenWave(100.0, 3.0)), NO_SHIP),
    "wave with a word": (
        lambda: in_wave(ship(), ps.FrozenWave(100.0, 3.0), free_trim="no"),
        ["free_trim", "True or False"],
    ),
    "ikeda None": (lambda: ikeda(None), ["hull is of another kind", "got: None"]),
    "ikeda a ship": (lambda: ikeda(ship()), ["allowed: a RollingHull", "rolling_hull(ship) makes one"]),
    "ikeda terms a ship": (lambda: ps.ikeda_terms(ship(), (), 0.5, 1.0), ["rolling_hull(ship) makes one"]),
    "ikeda keels": (lambda: ikeda(rolling_hull(ship()), ["a"]), ["bilge keel is of", "a BilgeKeelSegment"]),
    "section text": (lambda: ps.Section(0.0, "a", 0.0), ["outline of the section at x = 0 m", "got: 'a'"]),
    "section x": (lambda: ps.Section("a", SECTION, 0.0), ["x of a section is not a number"]),
    "section water": (lambda: ps.Section(0.0, SECTION, None), ["waterline of a section is not a number"]),
    "sections None": (lambda: ps.HullSections(None, 0, 1), ["list of sections", "a sequence of Section"]),
    "sections text": (lambda: ps.HullSections("abcde", 0, 1), ["section is of another kind", "got: 'a'"]),
    "sections ends": (lambda: ps.HullSections((ps.Section(0.0, SECTION, 0.0),) * 5, None, 1), ["aft end"]),
    "offsets None": (
        lambda: ps.sections_from_offsets(None, 1.0),
        ["table of offsets", "x, half-breadth and"],
    ),
    "offsets text": (lambda: ps.sections_from_offsets("halifax", 1.0), ["table of offsets", "got: 'h'"]),
    "offsets flat": (lambda: ps.sections_from_offsets([1.0, 2.0], 1.0), ["rows of three", "x, half-breadth"]),
    "offsets water": (
        lambda: ps.sections_from_offsets([np.zeros((3, 3))], "a"),
        ["waterline is not a number"],
    ),
    "lewis text": (
        lambda: ps.lewis_form("a", 1, 1),
        ["breadth of a Lewis form", "got: 'a'", "more than 0 m"],
    ),
    "lewis water": (lambda: ps.lewis_form(1, 1, 0.8, waterline="a"), ["waterline of a Lewis form"]),
    "rate": (lambda: TERMS.equivalent("a"), ["roll rate is not made of real numbers", "got: 'a'"]),
    "roll damping": (lambda: table().with_roll_damping("x"), ["roll damping is not made of", "got: 'x'"]),
    "point": (lambda: ps.point_motions(None, (0, 0, 0)), ["allowed: a History, as simulate() gives it"]),
    "points": (lambda: ps.with_points(None, {}), ["allowed: a History, as simulate() gives it"]),
} | {
    f"{name} at {speed}": (lambda call=call, speed=speed: call(speed=speed), [*NO_SPEED, f"got: {speed!r}\n"])
    for name, call in (("diffraction", scattered), ("radiation", radiated))
    for speed in (-3.0, 500.0, np.nan, "a", None)
}


@pytest.mark.parametrize("name", CALLS)
def test_one_message_says_what_was_got_and_what_to_give(name: str) -> None:
    call, words = CALLS[name]
    with pytest.raises(ps.PanelsimError) as refused:
        call()
    message = str(refused.value)
    assert all(word in message for word in words), message
    assert "\n  got: " in message and "\n  allowed: " in message
    assert len(message) < 600


def test_what_is_right_is_still_taken() -> None:
    """Lists for arrays, one heading for all waves, one wave at all headings, NumPy's numbers and booleans."""
    load = scattered([0.5, 0.6], 1.0, np.float32(1.0))
    assert np.array_equal(load[1], scattered(0.6, [1.0, 2.0], 1)[0])
    assert np.array_equal(radiated([0.5], np.int64(1)).impedance, radiated(0.5).impedance)
    held = ps.righting_arm(ship(), HEEL, free_trim=np.False_)
    assert not held.trim.any()
    offsets = np.array([[[x, 0.0, -1.0], [x, 1.0, -1.0], [x, 1.0, 1.0]] for x in np.arange(6.0)])
    assert ps.sections_from_offsets(offsets, 0.0).x[-1] == 5.0


@pytest.mark.parametrize("content", [b"", b"hello\n" * 99, b"CDF\x01 and no more"])
def test_a_netcdf_file_that_is_none_is_refused_by_its_name_alone(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "coefficients.nc"
    path.write_bytes(content)
    for read in (ps.read_database, ps.read_capytaine):
        with pytest.raises(ps.PanelsimError) as refused:
            read(path, ship(), forward="+x")
        message = str(refused.value)
        assert "missing, damaged or no NetCDF" in message and f"got: {path}\n" in message
        assert "backend" not in message


@pytest.mark.parametrize("name", ["cut.nc", "cut.h5"])
def test_a_file_cut_short_is_refused_by_its_name(name: str, tmp_path: Path) -> None:
    whole = database().save(tmp_path / "whole.nc").read_bytes()
    path = tmp_path / name
    for size in (5000, len(whole) // 2):
        path.write_bytes(whole[:size])
        with pytest.raises(ps.PanelsimError, match="cannot be read") as refused:
            ps.read_database(path, ship(), forward="+x")
        assert f"got: {path} (" in str(refused.value)


def test_a_number_of_numpy_is_shown_as_it_is_typed() -> None:
    with pytest.raises(ps.PanelsimError, match=r"got: -3\.0\n"):
        radiated(speed=np.float64(-3.0))
    with pytest.raises(ps.PanelsimError, match=r"got: -3\.0\n"):
        ps.lewis_form(np.float64(-3.0), 1.0, 1.0)
