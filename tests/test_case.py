"""Case files: what is refused and in which words, and that a case becomes what a script would build."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.case.template import case_template
from panelsim.errors import PanelsimError
from panelsim.hull.form import bundled_hull_names, load_hull
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.ship import Ship

EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"

RANDOM = """
[ship]
hull = "halifax"
panel_area = 20
[seaway]
kind = "random"
significant_wave_height = 7.5
peak_period = 15.0
frequencies = { start = 0.2, stop = 2.0, step = 0.1 }
wave_heading_deg = 150
[run]
speed_knots = 20
time_step = 0.2
duration = 20
"""
REGULAR = """
[ship]
hull = "halifax"
panel_area = 20
[seaway]
kind = "regular"
wave_height = 2
wave_period = 9
wave_heading_deg = 180
[run]
speed_knots = 10
time_step = 0.2
duration = 20
"""
OWN_MESH = """
[ship]
hull = "barge.obj"
draft = 2
center_of_gravity_height = 1.5
gyradius_roll = 2
gyradius_pitch = 5
gyradius_yaw = 5
water_density = 1025
[ship.mesh]
length_unit = "m"
up = "z"
forward = "x"
[seaway]
kind = "calm"
[run]
speed_knots = 0
time_step = 0.1
duration = 5
"""


def case_of(folder: Path, text: str, *overrides: str) -> Case:
    path = folder / "trial.toml"
    path.write_text(text, encoding="utf-8")
    return Case.load(path, overrides)


def refusal(folder: Path, text: str | bytes, *overrides: str) -> str:
    """The message with which a case is refused, be it when it is read or when its parts are built."""
    path = folder / "trial.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(PanelsimError) as refused:
        case = Case.load(path, overrides)
        _ = case.warnings(), case.supplementary, case.stored_database()
    return str(refused.value)


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("seaway.sead=7", ["[seaway] has no key sead", "did you mean seaway.seed?"]),
        ("seawy.seed=7", ["no table or key seawy", "did you mean seaway?"]),
        ("seaway.frequencies.stopp=3", ["[seaway.frequencies]", "did you mean seaway.frequencies.stop?"]),
        ("supplementary.damping.rol=1", ["did you mean supplementary.damping.roll?"]),
        ("run.seed=7", ["[run] has no key seed", "did you mean seaway.seed?"]),
        ("time_step=0.1", ["did you mean run.time_step?"]),
        ("qqq=1", ["no table or key qqq", "ship, hydrodynamics, seaway, run", "remove qqq"]),
    ],
)
def test_an_unknown_key_is_refused_with_the_nearest_known_one(
    tmp_path: Path, override: str, words: list[str]
) -> None:
    message = refusal(tmp_path, RANDOM, override)
    assert all(word in message for word in words), message


def test_a_misspelt_key_is_not_called_missing_as_well(tmp_path: Path) -> None:
    message = refusal(tmp_path, RANDOM.replace("speed_knots", "sped_knots"))
    assert "did you mean run.speed_knots?" in message
    assert "missing" not in message


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("run.time_step=fast", ["run.time_step is not a number", 'got: "fast"']),
        ("run.time_step=2,5", ["not a number", "with a point"]),
        ("run.speed_knots=true", ["not a number", "got: true"]),
        ("run.speed_knots=[20]", ["not a number", "got: [20]"]),
        ("seaway.seed=1.5", ["not a whole number"]),
        ("ship.hull=2", ["ship.hull is not text"]),
        ("ship.hull=", ["ship.hull is not a name"]),
        ("seaway.frequencies=[0.1, 0.2]", ["seaway.frequencies is not a table"]),
        ("run=5", ["run is not a table"]),
        ("points=5", ["points is not a table, { key", "got: 5"]),
        ("hydrodynamics.transom_terms=yes", ["transom_terms is not true or false", 'got: "yes"']),
        ("run.pressure_method=gird", ["run.pressure_method is not known", "'grid'"]),
        ("run.pressure_rule=vertices", ["run.pressure_rule is not known", "'vertex+centre'"]),
        ("seaway.kind=randm", ["seaway.kind is not known", "'random', 'regular', 'calm'"]),
        ("supplementary.damping.roll=nan", ["not a finite number"]),
        ("run.stepper=euler", ["run.stepper is not known", "'exponential', 'rk4' or 'ab3'"]),
        ("run.inertia=small", ["run.inertia is not known", "'large' or 'linear'"]),
    ],
)
def test_a_wrong_type_is_named_with_what_was_got(tmp_path: Path, override: str, words: list[str]) -> None:
    message = refusal(tmp_path, RANDOM, override)
    assert all(word in message for word in words), message


@pytest.mark.parametrize(
    ("override", "allowed"),
    [
        ("run.time_step=0", "at least 0.0001"),
        ("run.time_step=-1", "at least 0.0001"),
        ("run.time_step=nan", "at most 5"),
        ("run.duration=1e999", "at most 1e+06"),
        ("run.speed_knots=-3", "at least 0"),
        ("run.capsize_angle_deg=200", "at most 180"),
        ("seaway.wave_heading_deg=400", "at most 360"),
        ("seaway.minimum_energy=90", "at most 1"),
        ("seaway.seed=99999999999999999999", "at least 0, less than"),
        ("roll_damping.linearised_at_deg=100", "more than 0, at most 90"),
        ("seaway.peak_period=1e-200", "at least 0.06"),
        ("ship.water_density=1.025", "at least 900"),
        ("ship.gravity=32.2", "at least 9.7, at most 9.9"),
        ("supplementary.stiffness.surge=-1", "at least 0"),
    ],
)
def test_a_value_out_of_range_is_refused_with_the_limit(tmp_path: Path, override: str, allowed: str) -> None:
    message = refusal(tmp_path, RANDOM, override)
    assert "out of range" in message
    assert re.search(rf"allowed: .*{re.escape(allowed)}", message)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ["3 faults", "ship is missing", "seaway is missing", "run is missing"]),
        ("[ship]\nhull = halifax", ["not valid TOML", "line 2", "hull = halifax"]),
        ("[run]\nramp = 1\nramp = 2\n", ["not valid TOML", "ramp = 2"]),
        ("[run]\ntime_step = 0,2", ["not valid TOML", "decimals with a point"]),
        (RANDOM.encode("utf-16"), ["not text in UTF-8"]),
        (bytes(range(256)), ["not text in UTF-8"]),
        (RANDOM.replace("wave_heading_deg = 150", ""), ["neither of wave_heading_deg"]),
        (RANDOM + "[seaway.x]", ["[seaway] has no key x"]),
        (RANDOM.replace("stop = 2.0", "stop = 0.1"), ["stop is not above start"]),
        (RANDOM.replace("step = 0.1", "step = 1e-9"), ["more than 5000 frequencies"]),
        (RANDOM.replace("peak_period = 15.0", ""), ["also needs peak_period"]),
        (RANDOM + "ramp = 1e5\ncapsize_angle_deg = 0\nmodel = 'cubic'", ["run.model is not known"]),
        (
            RANDOM + "model = 'linear'\ninertia = 'large'",
            ["the linear model has the inertia of small angles"],
        ),
        (
            RANDOM.replace("= 20\n[sea", "= 20\nmesh = {length_unit = 1, up = 'z', forward = 'x'}\n[sea"),
            [".stl"],
        ),
        (REGULAR.replace("wave_period = 9", ""), ["also needs wave_frequency", "wave_period"]),
        (
            REGULAR.replace("wave_period = 9", "wave_period = 9\nwave_frequency = 1"),
            ["both wave_frequency and wave_period", "give one"],
        ),
        (REGULAR.replace("wave_height = 2", "wave_height = 30"), ["steeper than waves can be", "breaking"]),
        (REGULAR.replace("wave_height = 2", "wave_height = 2\npeak_period = 9"), ["has no peak_period"]),
        (REGULAR.replace("wave_heading_deg", "sea_direction_deg"), ["set run.ship_heading_deg"]),
        (REGULAR + "[hydrodynamics]\nfile = 'none.nc'", ["no hydrodynamic database", "panelsim hydro"]),
    ],
)
def test_a_file_that_says_no_case_is_refused_with_the_reason(
    tmp_path: Path, text: str | bytes, words: list[str]
) -> None:
    message = refusal(tmp_path, text)
    assert all(word in message for word in words), message


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        (
            ("seaway.significant_wave_height=40", "seaway.peak_period=5"),
            ["steeper than waves can be", "0.142"],
        ),
        (("seaway.frequencies.start=1.5",), ["too little of the spectrum's energy", "minimum_energy"]),
        (("run.duration=0.1",), ["shorter than one time_step"]),
        (("run.time_step=1e-4", "run.duration=1800"), ["more than the 2000000"]),
        (
            ("roll_damping.method=percent",),
            ["needs critical_percent", "got: no critical_percent", "allowed: 0 to 100 %", "for example to 5"],
        ),
        (("roll_damping.method=terms",), ["needs linear or quadratic or cubic", "got: none", "to 1e7"]),
        (
            ("roll_damping.method=ikeda", "roll_damping.linear=5"),
            ['linear has no meaning with method = "ikeda"', "got: linear = 5", 'method to "terms"'],
        ),
        (
            ("seaway.kind=calm",),
            ["a calm seaway has no", "got: frequencies = …, ", "allowed: kind alone", "to do: leave freq"],
        ),
        (
            ("run.model=linear", "run.inertia=large"),
            ["inertia of small angles", 'got: model = "linear"', "to do: leave run.inertia out"],
        ),
        (("ship.hull=halifx",), ["did you mean halifax?"]),
        (("ship.panel_area=1e-6",), ["panel area does not suit"]),
        (("ship.draft=50",), ["under water"]),
        (("ship.mass=1e12",), ["cannot float"]),
        (("ship.center_of_gravity_x=3",), ["needs a mass"]),
        (("ship.hull.x=1",), ["hull, which is no table"]),
        (("foo",), ["not of the form key=value"]),
        (("=3",), ["not of the form key=value"]),
    ],
)
def test_what_cannot_be_run_is_refused(tmp_path: Path, overrides: tuple[str, ...], words: list[str]) -> None:
    message = refusal(tmp_path, RANDOM, *overrides)
    assert all(word in message for word in words), message


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="There is no such case file"):
        Case.load(tmp_path / "none.toml")
    with pytest.raises(PanelsimError, match="is a folder"):
        Case.load(tmp_path)


def test_a_byte_order_mark_is_no_fault(tmp_path: Path) -> None:
    assert case_of(tmp_path, "\ufeff" + RANDOM).file.run.duration == 20


def test_compass_courses_become_the_heading_relative_to_the_ship(tmp_path: Path) -> None:
    compass = RANDOM.replace("wave_heading_deg = 150", "sea_direction_deg = 30") + "ship_heading_deg = 100"
    # β = ν + 180° − χ = 30 + 180 − 100: waves from ahead to port, so they travel aft and to starboard.
    assert case_of(tmp_path, compass).wave_heading == pytest.approx(np.deg2rad(110.0), rel=1e-15)


def test_a_regular_wave_takes_height_period_and_phase(tmp_path: Path) -> None:
    seaway = case_of(tmp_path, REGULAR, "seaway.phase_deg=90").seaway
    assert isinstance(seaway, RegularSeaway)
    assert seaway.wave_amplitude == 1.0
    assert seaway.wave_frequency == pytest.approx(2 * np.pi / 9, rel=1e-15)
    assert seaway.phase == pytest.approx(np.pi / 2, rel=1e-15)


def test_calm_water_needs_no_heading(tmp_path: Path) -> None:
    text = REGULAR.replace('"regular"', '"calm"').replace("wave_height = 2\nwave_period = 9\n", "")
    case = case_of(tmp_path, text.replace("wave_heading_deg = 180", ""))
    assert isinstance(case.seaway, CalmSeaway)


def test_the_phases_are_those_of_the_seed(tmp_path: Path) -> None:
    seaway = case_of(tmp_path, RANDOM, "seaway.seed=7").seaway
    assert isinstance(seaway, RandomSeaway)
    expected = np.random.default_rng(7).uniform(0, 2 * np.pi, 19)
    assert np.array_equal(seaway.components.phase, expected)


def test_a_sea_over_the_observed_steepness_is_warned_of(tmp_path: Path) -> None:
    # 2π 7.5 / (9.81 · 9²) = 0.059, between Buckley's 0.049 and breaking.
    assert any("Buckley" in text for text in case_of(tmp_path, RANDOM, "seaway.peak_period=9").warnings())
    assert case_of(tmp_path, RANDOM).warnings() == []


def test_a_ship_that_does_not_float_upright_and_gyradii_beyond_the_hull_are_warned_of(tmp_path: Path) -> None:
    (top_heavy,) = case_of(tmp_path, RANDOM, "ship.center_of_gravity_height=9").warnings()
    assert "transverse metacentric height is -" in top_heavy
    (slipped_point,) = case_of(tmp_path, RANDOM, "ship.gyradius_pitch=288").warnings()
    assert "pitch gyradius of 288 m" in slipped_point


def test_supplementary_tables_replace_those_of_the_particulars_one_by_one(tmp_path: Path) -> None:
    own = case_of(tmp_path, RANDOM).supplementary
    assert (own.stiffness["yaw"], own.damping["roll"]) == (2e9, 2e7)
    given = case_of(tmp_path, RANDOM, "supplementary.damping={roll = 3e7}").supplementary
    assert (given.stiffness["yaw"], dict(given.damping)) == (2e9, {"roll": 3e7})
    none = case_of(tmp_path, RANDOM, "supplementary.stiffness={}").supplementary
    assert dict(none.stiffness) == {}


def test_loading_keys_change_the_loading_they_name_and_no_other(tmp_path: Path) -> None:
    plain = case_of(tmp_path, RANDOM).ship
    other = case_of(
        tmp_path,
        RANDOM,
        "ship.center_of_gravity_height=0",
        "ship.gyradius_roll=4",
        "ship.water_density=1025",
        "ship.gravity=9.81",
    ).ship
    assert (other.center_of_gravity[2], other.gyradii[0]) == (0.0, 4.0)
    assert (other.water_density, other.gravity) == (1025.0, 9.81)
    assert other.gyradii[1:] == plain.gyradii[1:]
    assert other.draft == plain.draft
    assert other.mass == pytest.approx(1.025 * plain.mass, rel=1e-12)  # the same volume in denser water


def test_the_resolved_case_is_a_valid_case_that_says_what_was_used(tmp_path: Path) -> None:
    case = case_of(tmp_path, RANDOM.replace("panel_area = 20", ""))
    resolved = case.resolved()
    assert resolved["ship"]["panel_area"] == pytest.approx(2.5, rel=0.2)  # some 800 wet panels
    assert resolved["supplementary"]["stiffness"] == {"surge": 5e5, "sway": 1e6, "yaw": 2e9}
    assert "null" not in json.dumps(resolved)
    again = Case(type(case.file).model_validate(resolved), tmp_path)
    assert again.resolved() == resolved
    assert again.ship.mass == case.ship.mass


def test_a_bundled_name_is_not_taken_for_a_folder_beside_the_case(tmp_path: Path) -> None:
    (tmp_path / "halifax").mkdir()
    assert case_of(tmp_path, RANDOM).ship.name == "halifax"


def test_an_own_mesh_is_found_beside_the_case_and_loaded_as_it_says(tmp_path: Path, barge: Ship) -> None:
    barge.mesh.export(tmp_path / "barge.obj")
    ship = case_of(tmp_path, OWN_MESH).ship
    assert ship.mass == pytest.approx(20 * 6 * 2 * 1025, rel=1e-12)
    heavier = case_of(tmp_path, OWN_MESH, "ship.mass=3e5", "ship.center_of_gravity_x=0").ship
    assert heavier.draft == pytest.approx(3e5 / (20 * 6 * 1025), rel=1e-9)


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        (("ship.mesh.up=w",), ["Unknown axis"]),
        (("ship.mesh.length_unit=true",), ["length_unit", "neither a unit"]),
        (("ship.mesh.length_unit=km",), ["Unknown length unit", "m, cm, mm, ft, in"]),
        (("ship.mesh.length_unit=-1",), ["Unknown length unit"]),
        (("ship.mesh.origin=[0, 0]",), ["ship.mesh.origin has the wrong length", "got: 2", "at least 3"]),
        (("ship.mesh.origin=[0, 0, 2]",), ["baseline", "ship.mesh.origin"]),
        (("ship.mesh.origin=[0, 0, -1]",), ["baseline", "ship.mesh.origin"]),
        (("ship.mesh.origin=[0, 1, 0]",), ["to one side"]),
        (("ship.panel_area=1",), ["its own panels"]),
        (("ship.hull=none.obj",), ["no such mesh file"]),
    ],
)
def test_a_mesh_that_does_not_say_how_it_lies_is_refused(
    tmp_path: Path, barge: Ship, overrides: tuple[str, ...], words: list[str]
) -> None:
    barge.mesh.export(tmp_path / "barge.obj")
    message = refusal(tmp_path, OWN_MESH, *overrides)
    assert all(word in message for word in words), message


def test_a_mesh_without_loading_or_axes_is_refused(tmp_path: Path) -> None:
    assert "without draft" in refusal(tmp_path, OWN_MESH.replace("draft = 2", ""))
    without_axes = OWN_MESH[: OWN_MESH.index("[ship.mesh]")] + OWN_MESH[OWN_MESH.index("[seaway]") :]
    assert "needs its unit and axes" in refusal(tmp_path, without_axes)


@pytest.mark.parametrize("name", bundled_hull_names())
def test_the_template_of_every_bundled_hull_is_a_case(tmp_path: Path, name: str) -> None:
    form = load_hull(name)
    case = case_of(tmp_path, case_template(form, form.name))
    assert case.ship.draft == form.draft
    assert bool(case.warnings()) == (name in ("wigley_i", "wigley_iii"))  # their GM is negative
    # Without something that holds it on its course a ship under way turns beam to the waves.
    assert case.supplementary.stiffness["yaw"] > 0


def test_an_override_holds_one_key(tmp_path: Path) -> None:
    assert "more than one key" in refusal(tmp_path, RANDOM, "seaway.seed=7\nrun.x=3")
    assert "more than one key" in refusal(tmp_path, RANDOM, "seaway.seed=7\n[run]\nx=3")
    assert case_of(tmp_path, RANDOM, "seaway.seed=7").file.seaway.seed == 7


@pytest.mark.parametrize("depth", [5000, 100_000])
def test_what_is_nested_too_deeply_is_refused(tmp_path: Path, depth: int) -> None:
    assert "not valid TOML" in refusal(tmp_path, f"x = {'[' * depth}{']' * depth}")
    assert "nested too deeply" in refusal(tmp_path, RANDOM, f"x={'[' * depth}{']' * depth}")


def test_a_changed_case_has_the_new_values_and_the_same_ship() -> None:
    case = Case.load(EXAMPLE)
    other = case.changed({"run.time_step": 0.1, "seaway.seed": 3, "supplementary.damping.roll": 3e7})
    assert (other.file.run.time_step, other.file.seaway.seed) == (0.1, 3)
    assert other.file.supplementary.damping.roll == 3e7  # type: ignore[union-attr]
    assert case.file.run.time_step == 0.4
    _ = case.ship
    assert case.changed({"run.time_step": 0.1}).ship is case.ship
    assert case.changed({"ship.panel_area": 5.0}).ship is not case.ship


def test_none_takes_a_key_away() -> None:
    case = Case.load(EXAMPLE)
    sea = case.changed(
        {"seaway.significant_wave_height": None, "seaway.peak_period": None, "seaway.sea_state": 6}
    )
    assert sea.file.seaway.sea_state == 6


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"run.timestep": 0.1}, "time_step"),
        ({"run.time_step": -1.0}, "time_step"),
        ({"seaway.seed.first": 1}, "no table"),
        ({"seaway.wave_length": 100.0}, "wave_length"),
    ],
)
def test_a_case_is_not_changed_to_what_no_case_may_be(changes: dict[str, object], words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        Case.load(EXAMPLE).changed(changes)
