"""The table [seaway] of a case: what each kind of sea asks for, and that it becomes what a script builds."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import CosineHalfAngle, CosinePower, CosineSquared
from panelsim.seaway.direction.ten_parameter import TenParameterSpectrum
from panelsim.seaway.exchange.components_csv import write_components
from panelsim.seaway.exchange.datasets import dataset_from_spectrum
from panelsim.seaway.exchange.ndbc import read_ndbc_meteorology
from panelsim.seaway.frequencies import EqualEnergyFrequencies, JitteredFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.jonswap import Jonswap
from panelsim.seaway.spectra.ochi_hubble import OchiHubble
from panelsim.seaway.spectra.pierson_moskowitz import PiersonMoskowitz

REST = """
[ship]
hull = "halifax"
panel_area = 20
[run]
speed_knots = 20
time_step = 0.2
duration = 20
"""
RANDOM = 'kind = "random"\n'
TEN = 'spectrum = "ten-parameter"\ndirection_step_deg = 10\n'
GRID = "frequencies = { start = 0.3, stop = 2.0, step = 0.05 }\n"
WAVES = GRID + "wave_heading_deg = 150\n"
SYSTEMS = """
[[seaway.systems]]
significant_wave_height = 2.0
peak_period = 12.0
shape = 3.0
{swell}
[[seaway.systems]]
significant_wave_height = 3.0
peak_period = 8.0
shape = 1.5
{sea}
"""


def case_of(folder: Path, seaway: str, course: float | None = None, overrides: tuple[str, ...] = ()) -> Case:
    text = REST if course is None else f"{REST}ship_heading_deg = {course}\n"
    path = folder / "trial.toml"
    path.write_text(f"{text}[seaway]\n{seaway}", encoding="utf-8")
    return Case.load(path, overrides)


def random_sea(folder: Path, seaway: str, course: float | None = None) -> RandomSeaway:
    sea = case_of(folder, f"{RANDOM}{seaway}", course).seaway
    assert isinstance(sea, RandomSeaway)
    return sea


@pytest.mark.parametrize(
    ("keys", "spectrum"),
    [
        ("significant_wave_height = 4\npeak_period = 10", Bretschneider(4.0, 10.0)),
        ("significant_wave_height = 4\nmean_period = 8", Bretschneider.from_mean_period(4.0, 8.0)),
        (
            "significant_wave_height = 4\nzero_crossing_period = 7",
            Bretschneider.from_zero_crossing_period(4.0, 7.0),
        ),
        # TM 2004-041 Table 1: sea state 6 has 5 m and 12.4 s.
        ("sea_state = 6", Bretschneider(5.0, 12.4)),
        (
            'spectrum = "bretschneider-one-parameter"\nsignificant_wave_height = 4',
            Bretschneider.one_parameter(4.0),
        ),
        ('spectrum = "jonswap"\nsignificant_wave_height = 4\npeak_period = 10', Jonswap(4.0, 10.0)),
        (
            'spectrum = "jonswap"\nsea_state = 6\npeak_enhancement = 2\nnormalisation = "logarithmic"',
            Jonswap(5.0, 12.4, 2.0, normalisation="logarithmic"),
        ),
        ('spectrum = "jonswap"\nwind_speed = 15\nfetch = 2e5', Jonswap.from_wind(15.0, 2e5)),
        ('spectrum = "dnv"\nsignificant_wave_height = 4\npeak_period = 9', Jonswap.dnv(4.0, 9.0)),
        ('spectrum = "pierson-moskowitz"\nwind_speed = 15', PiersonMoskowitz(15.0)),
        (
            'spectrum = "pierson-moskowitz"\nsignificant_wave_height = 4',
            PiersonMoskowitz.from_significant_wave_height(4.0),
        ),
    ],
)
def test_each_spectrum_can_be_given(tmp_path: Path, keys: str, spectrum: object) -> None:
    assert random_sea(tmp_path, f"{keys}\n{WAVES}").spectrum == spectrum


def test_the_example_of_a_spectrum_table_is_read_beside_the_case(tmp_path: Path) -> None:
    rows = "".join(f"{w},{Bretschneider(3.0, 10.0).density(w)}\n" for w in np.linspace(0.1, 3.0, 200))
    (tmp_path / "sea.csv").write_text(f"frequency_rad_s,density\n{rows}")
    sea = random_sea(tmp_path, f'spectrum = "table"\nfile = "sea.csv"\n{WAVES}')
    # 0.3 to 2 rad/s hold 98.9 % of the energy.
    assert 4 * np.sqrt(sea.components.variance) == pytest.approx(3.0 * np.sqrt(0.989), rel=2e-3)


def test_systems_of_an_ochi_hubble_and_a_ten_parameter_spectrum(tmp_path: Path) -> None:
    plain = SYSTEMS.format(swell="", sea="")
    sea = random_sea(tmp_path, f'spectrum = "ochi-hubble"\n{WAVES}{plain}')
    assert sea.spectrum == OchiHubble((2.0, 3.0), (12.0, 8.0), (3.0, 1.5))
    turned = SYSTEMS.format(
        swell="sea_direction_deg = 45\nspread = 10", sea="sea_direction_deg = 300\nspread = 3"
    )
    ten = f"{TEN}{GRID}{turned}"
    directional = random_sea(tmp_path, ten, course=20).spectrum
    assert isinstance(directional, TenParameterSpectrum)
    # The swell comes from the north-east: at the longest waves there is nothing else.
    assert directional.mean_direction(0.42) == pytest.approx(np.deg2rad(45), abs=np.deg2rad(3))


@pytest.mark.parametrize(
    ("spreading", "expected"),
    [
        ('{ kind = "cosine-squared", spreading_angle_deg = 60 }', CosineSquared(np.deg2rad(60))),
        ('{ kind = "cosine-power", power = 4 }', CosinePower(4.0)),
        ('{ kind = "cosine-half-angle", spread = 8 }', CosineHalfAngle(8.0)),
    ],
)
def test_short_crested_seas(tmp_path: Path, spreading: str, expected: object) -> None:
    keys = f"sea_state = 6\nspreading = {spreading}\ndirection_step_deg = 15\n{WAVES}"
    sea = random_sea(tmp_path, keys)
    assert sea.spreading == expected
    waves = sea.components
    mean = np.angle(np.sum(waves.amplitude**2 * np.exp(1j * waves.wave_heading)))
    # Symmetric about the mean heading: rounding.
    assert np.rad2deg(mean) == pytest.approx(150.0, abs=1e-9)


def test_choices_of_frequencies(tmp_path: Path) -> None:
    start = "sea_state = 6\nwave_heading_deg = 0\n"
    jittered = 'frequencies = { choice = "jittered", start = 0.3, stop = 2.0, step = 0.05 }\n'
    assert random_sea(tmp_path, start + jittered).frequencies == JitteredFrequencies(0.3, 2.0, 0.05)
    equal = 'frequencies = { choice = "equal-energy", count = 30 }\n'
    assert random_sea(tmp_path, start + equal).frequencies == EqualEnergyFrequencies(30)


def test_compass_directions_of_a_spectrum_turn_with_the_course(tmp_path: Path) -> None:
    """The same sea from the north-east, for a ship going north and one going east: β less by 90°."""
    turned = SYSTEMS.format(
        swell="sea_direction_deg = 45\nspread = 10", sea="sea_direction_deg = 45\nspread = 10"
    )
    ten = f"{TEN}{GRID}{turned}"
    north, east = (random_sea(tmp_path, ten, course).components for course in (0, 90))
    turn = np.angle(np.exp(1j * (east.wave_heading - north.wave_heading)))
    np.testing.assert_allclose(turn, -np.pi / 2, atol=1e-12)  # rounding
    # From the north-east a ship going north has them on the starboard bow: β = 45° + 180°.
    mean = np.angle(np.sum(north.amplitude**2 * np.exp(1j * north.wave_heading)))
    assert np.rad2deg(mean) % 360 == pytest.approx(225.0, abs=1.0)  # directions in steps of 10°


def test_stokes_waves_and_wave_length(tmp_path: Path) -> None:
    keys = 'kind = "regular"\nwave_height = 5\nwave_length = 100\nwave_heading_deg = 180\n'
    waves = case_of(tmp_path, keys + 'wave_theory = "stokes"').seaway.components
    assert waves.second_order
    assert waves.wavenumber()[0] == pytest.approx(2 * np.pi / 100, rel=1e-12)
    assert not case_of(tmp_path, keys).seaway.components.second_order
    with pytest.raises(PanelsimError, match=r"no grid[\s\S]*run.pressure_method"):
        case_of(tmp_path, keys + 'wave_theory = "stokes"', overrides=("run.pressure_method=grid",))


def test_components_of_a_file_are_those_that_were_written(tmp_path: Path) -> None:
    given = WaveComponents(
        np.array([1.0, 0.5]), np.array([0.5, 0.9]), np.array([2.0, 3.0]), np.array([0.1, 4.0])
    )
    write_components(tmp_path / "waves.csv", given)
    sea = case_of(tmp_path, 'kind = "components"\nfile = "waves.csv"').seaway
    assert sea.kind == "components"
    np.testing.assert_allclose(sea.components.wave_heading, given.wave_heading, rtol=1e-14)


def test_a_recorded_sea(tmp_path: Path) -> None:
    time = np.arange(0, 200, 0.5)
    elevation = 1.2 * np.cos(2 * np.pi * time * 20 / 200 + 0.7)
    rows = "".join(f"{t},{z}\n" for t, z in zip(time, elevation, strict=True))
    (tmp_path / "buoy.csv").write_text(f"time_s,elevation_m\n{rows}")
    keys = (
        'kind = "record"\nfile = "buoy.csv"\nlow_frequency = 0.3\nhigh_frequency = 2\nwave_heading_deg = 180'
    )
    case = case_of(tmp_path, keys)
    view = case.seaway.in_translating_axes(0.0)
    # One Fourier wave of the record: rounding of the file and the transform.
    np.testing.assert_allclose(view.elevation(0.0, 0.0, time), elevation, atol=1e-10)


@pytest.mark.parametrize(
    ("seaway", "words"),
    [
        (
            f"{RANDOM}{WAVES}",
            ["bretschneider", "significant_wave_height and peak_period", "sea_state"],
        ),
        (f"{RANDOM}significant_wave_height = 4\n{WAVES}", ["also needs peak_period"]),
        (
            f"{RANDOM}significant_wave_height = 4\npeak_period = 9\nmean_period = 8\n{WAVES}",
            ["both mean_period and peak_period", "give one"],
        ),
        (
            f"{RANDOM}sea_state = 5\npeak_period = 9\n{WAVES}",
            ["has no peak_period"],
        ),
        (f"{RANDOM}sea_state = 5\nwave_heading_deg = 0", ["also needs frequencies"]),
        (f'{RANDOM}spectrum = "dnv"\nwind_speed = 5\n{WAVES}', ["dnv", "significant_wave_height"]),
        (f"{RANDOM}sea_state = 5\npeak_enhancement = 2\n{WAVES}", ["has no peak_enhancement"]),
        (
            f'{RANDOM}spectrum = "jonswap"\nsea_state = 5\npeak_enhancement = 0.5\n{WAVES}',
            ["at least 1"],
        ),
        (f"{RANDOM}sea_state = 0\n{WAVES}", ["sea state", "no peak period"]),
        (f"{RANDOM}sea_state = 5\nwave_height = 2\n{WAVES}", ["has no wave_height"]),
        (f'{RANDOM}spectrum = "table"\nfile = "nowhere.csv"\n{WAVES}', ["nowhere.csv"]),
        (
            f'{RANDOM}sea_state = 5\ndirection_step_deg = 9\nspreading = {{ kind = "cosine-power" }}\n'
            + WAVES,
            ["also needs power"],
        ),
        (
            f'{RANDOM}sea_state = 5\nspreading = {{ kind = "cosine-power", power = 2 }}\n{WAVES}',
            ["direction_step_deg"],
        ),
        (f"{RANDOM}sea_state = 5\ndirection_step_deg = 9\n{WAVES}", ["add spreading"]),
        (
            f'{RANDOM}spectrum = "ten-parameter"\n{GRID}'
            + SYSTEMS.format(
                swell="sea_direction_deg = 5\nspread = 9", sea="sea_direction_deg = 5\nspread = 9"
            ),
            ["direction_step_deg", "for example 20"],
        ),
        (f'{RANDOM}spectrum = "table"\nfile = "a\\u0000b"\n{WAVES}', ["seaway.file", "u0000"]),
        (
            f'{RANDOM}spectrum = "ochi-hubble"\n{WAVES}{SYSTEMS.format(swell="spread = 3", sea="")}',
            ["system 1", "has no spread", "ten-parameter"],
        ),
        (
            f"{RANDOM}{TEN}{GRID}{SYSTEMS.format(swell='spread = 3', sea='')}",
            ["system 1", "also needs sea_direction_deg"],
        ),
        (
            f"{RANDOM}{TEN}{WAVES}{SYSTEMS.format(swell='', sea='')}",
            ["sea_direction_deg"],
        ),
        (
            RANDOM
            + 'sea_state = 5\nwave_heading_deg = 0\nfrequencies = { choice = "equal-energy", step = 1 }',
            ["also need count"],
        ),
        (
            RANDOM
            + "sea_state = 5\nwave_heading_deg = 0\nfrequencies = { start = 1, stop = 0.5, step = 0.1 }",
            ["stop is not above start"],
        ),
        (
            'kind = "regular"\nwave_height = 2\nwave_heading_deg = 0',
            ["also needs wave_frequency", "wave_period"],
        ),
        (
            'kind = "regular"\nwave_height = 2\nwave_length = 90\nwave_period = 9\nwave_heading_deg = 0',
            ["both wave_length and wave_period"],
        ),
        (
            'kind = "record"\nfile = "a.csv"\nwave_heading_deg = 0',
            ["also needs low_frequency, high_frequency"],
        ),
        ('kind = "components"\nfile = "a.csv"\nwave_heading_deg = 0', ["brings its own directions"]),
        ('kind = "components"\nfile = "a.csv"', ["a.csv"]),
        ('kind = "dataset"\nfile = "a.nc"', ["also needs format"]),
        ('kind = "dataset"\nformat = "netcdf"\nfile = "a.nc"', ["a.nc"]),
        ('kind = "dataset"\nformat = "netcdf"\nfiles = ["a", "b"]', ["seaway.files", "at least 5"]),
    ],
)
def test_what_does_not_make_a_sea_is_refused(tmp_path: Path, seaway: str, words: list[str]) -> None:
    with pytest.raises(PanelsimError) as refused:
        _ = case_of(tmp_path, seaway).seaway.components
    message = str(refused.value)
    assert all(word in message for word in words), message


def test_compass_directions_need_a_course(tmp_path: Path) -> None:
    turned = SYSTEMS.format(
        swell="sea_direction_deg = 45\nspread = 10", sea="sea_direction_deg = 300\nspread = 3"
    )
    with pytest.raises(PanelsimError, match="ship_heading_deg"):
        case_of(tmp_path, f"{RANDOM}{TEN}{GRID}{turned}")


def test_a_misspelt_key_of_a_system_is_told_with_its_place(tmp_path: Path) -> None:
    text = f'{RANDOM}spectrum = "ochi-hubble"\n{WAVES}{SYSTEMS.format(swell="", sea="")}'
    with pytest.raises(PanelsimError) as refused:
        case_of(tmp_path, text.replace("shape = 3.0", "shap = 3.0"))
    assert "seaway.systems.0.shape?" in str(refused.value)


def test_a_resolved_case_is_itself_a_case(tmp_path: Path) -> None:
    """What a history keeps of its case can be run again: the same waves, bit by bit."""
    turned = SYSTEMS.format(
        swell="sea_direction_deg = 45\nspread = 10", sea="sea_direction_deg = 300\nspread = 3"
    )
    ten = f"{RANDOM}{TEN}{GRID}{turned}"
    case = case_of(tmp_path, ten, course=20)
    again = Case(type(case.file).model_validate(case.resolved()), tmp_path)
    assert again.seaway.components.amplitude.tobytes() == case.seaway.components.amplitude.tobytes()


# --- every key arrives ---


RECORD_TIME = np.arange(0, 200, 0.5)


@pytest.fixture
def record_file(tmp_path: Path) -> Path:
    """A record of two waves, 0.6283 and 1.2566 rad/s, that starts and ends at different heights."""
    elevation = np.cos(0.2 * np.pi * RECORD_TIME + 0.7) + 0.5 * np.cos(0.4 * np.pi * RECORD_TIME - 1.0)
    rows = "".join(f"{t},{z},{2 * z}\n" for t, z in zip(RECORD_TIME, elevation, strict=True))
    path = tmp_path / "buoy.csv"
    path.write_text(f"t,up,twice\n{rows}")
    return path


RECORD = (
    'kind = "record"\nfile = "buoy.csv"\ntime_column = "t"\nelevation_column = "up"\nwave_heading_deg = 160\n'
)


def test_keys_of_a_record(tmp_path: Path, record_file: Path) -> None:
    both = case_of(
        tmp_path, RECORD + "minimum_energy = 0\nlow_frequency = 0.3\nhigh_frequency = 2"
    ).seaway.components
    np.testing.assert_allclose(np.sort(both.amplitude)[-2:], [0.5, 1.0], atol=1e-9)
    upper = case_of(
        tmp_path, RECORD + "minimum_energy = 0\nlow_frequency = 1\nhigh_frequency = 2"
    ).seaway.components
    assert upper.amplitude.max() == pytest.approx(0.5, abs=1e-9)
    lower = case_of(
        tmp_path, RECORD + "minimum_energy = 0\nlow_frequency = 0.3\nhigh_frequency = 1"
    ).seaway.components
    assert (lower.amplitude.max(), lower.frequency.max() <= 1) == (pytest.approx(1.0, abs=1e-9), True)
    faded = case_of(
        tmp_path, RECORD + "minimum_energy = 0\nlow_frequency = 0.3\nhigh_frequency = 1\ntaper = 0.5"
    ).seaway.components
    assert np.sum(faded.amplitude > 0.01) > 1  # a tapered wave has neighbours in the spectrum
    twice = case_of(
        tmp_path,
        RECORD.replace("up", "twice") + "minimum_energy = 0\nlow_frequency = 0.3\nhigh_frequency = 1",
    ).seaway.components
    assert twice.amplitude.max() == pytest.approx(2.0, abs=1e-9)
    # A band in Hz where rad/s belong holds nothing of the sea.
    with pytest.raises(PanelsimError, match="2π times Hz"):
        _ = case_of(tmp_path, RECORD + "low_frequency = 0.05\nhigh_frequency = 0.4").seaway


@pytest.mark.parametrize(
    "keys",
    [
        'kind = "regular"\nwave_height = 2\nwave_period = 9\nwave_heading_deg = 160',
        f"{RANDOM}sea_state = 5\n{WAVES}",
        f"{RECORD}low_frequency = 0.3\nhigh_frequency = 2",
        'kind = "components"\nfile = "waves.csv"',
        'kind = "calm"',
    ],
)
def test_the_course_arrives_at_every_kind_of_sea(tmp_path: Path, record_file: Path, keys: str) -> None:
    """It is what fixed axes and other courses are counted from."""
    waves = WaveComponents(np.ones(1), np.array([0.5]), np.array([2.0]), np.zeros(1))
    write_components(tmp_path / "waves.csv", waves, overwrite=True)
    assert case_of(tmp_path, keys, course=70).seaway.ship_heading == pytest.approx(np.deg2rad(70))


def test_the_phase_of_a_regular_wave_is_in_degrees(tmp_path: Path) -> None:
    keys = 'kind = "regular"\nwave_height = 2\nwave_frequency = 0.7\nwave_heading_deg = 160\nphase_deg = 30'
    waves = case_of(tmp_path, keys).seaway.components
    assert (waves.phase[0], waves.amplitude[0]) == (pytest.approx(np.pi / 6), 1.0)


def test_the_wave_length_is_that_in_the_gravity_of_the_ship(tmp_path: Path) -> None:
    keys = 'kind = "regular"\nwave_height = 2\nwave_length = 100\nwave_heading_deg = 180'
    path = tmp_path / "trial.toml"
    path.write_text(REST.replace("[run]", "gravity = 9.75\n[run]") + f"[seaway]\n{keys}")
    case = Case.load(path)
    assert case.seaway.components.wavenumber(case.ship.gravity)[0] == pytest.approx(
        2 * np.pi / 100, rel=1e-12
    )


def test_seed_dropping_and_minimum_energy_arrive(tmp_path: Path) -> None:
    spreading = 'spreading = { kind = "cosine-squared", spreading_angle_deg = 90 }\ndirection_step_deg = 20\n'
    keys = f"sea_state = 6\n{spreading}"
    sea = random_sea(tmp_path, keys + "seed = 12\n" + WAVES)
    np.testing.assert_array_equal(
        sea.components.phase, np.random.default_rng(12).uniform(0, 2 * np.pi, sea.components.count)
    )
    assert random_sea(tmp_path, keys + "drop_below = 1e-3\n" + WAVES).dropped > 0
    with pytest.raises(PanelsimError, match="minimum_energy"):
        random_sea(tmp_path, keys + "minimum_energy = 0.999\n" + WAVES)


def test_limits_of_equal_energy_arrive(tmp_path: Path) -> None:
    equal = 'frequencies = { choice = "equal-energy", count = 30, start = 0.35, stop = 1.5 }\n'
    found = random_sea(tmp_path, f"sea_state = 6\nwave_heading_deg = 0\n{equal}").frequencies
    assert found == EqualEnergyFrequencies(30, 0.35, 1.5)


# --- datasets ---

NDBC = Path(__file__).parent / "data" / "ndbc"
METEOROLOGY = f'kind = "dataset"\nformat = "ndbc-meteorology"\nfile = "{NDBC / "99999.txt"}"\n'
LATE = "time = '2020-06-08 03:50'\nfrequencies = { start = 0.3, stop = 3, step = 0.02 }\n"


@pytest.fixture
def dataset_file(tmp_path: Path) -> Path:
    """Two times at two sites: a sea from the north-east whose height grows from one to the next."""
    grid = 2 * np.pi * np.linspace(0.05, 0.35, 31), np.deg2rad(np.arange(0, 360, 15.0))
    spread = CosineHalfAngle(8.0)
    seas = [
        dataset_from_spectrum(SpreadSpectrum(Jonswap(height, 9.0), spread, np.deg2rad(45)), *grid)
        for height in (1.0, 2.0, 3.0, 4.0)
    ]
    rows = [xr.concat(seas[i : i + 2], "site").assign_coords(site=[0, 1]) for i in (0, 2)]
    times = np.array(["2020-01-01T00:00", "2020-01-01T06:00"], dtype="datetime64[ns]")
    path = tmp_path / "model.nc"
    xr.concat(rows, "time").assign_coords(time=times).to_netcdf(path, engine="h5netcdf")
    return path


DATASET = 'kind = "dataset"\nfile = "model.nc"\nformat = "netcdf"\n'


def test_time_and_site_of_a_dataset(tmp_path: Path, dataset_file: Path) -> None:
    chosen = "time = '2020-01-01 06:00'\nsite = 0\n"
    waves = case_of(tmp_path, DATASET + chosen, course=20).seaway.components
    # A JONSWAP with Goda's factor in a table from 0.05 to 0.35 Hz: 3 m within 2 %.
    assert 4 * np.sqrt(waves.variance) == pytest.approx(3.0, rel=0.02)
    mean = np.angle(np.sum(waves.amplitude**2 * np.exp(1j * waves.wave_heading)))
    assert np.rad2deg(mean) % 360 == pytest.approx(45 + 180 - 20, abs=1e-3)
    with pytest.raises(PanelsimError, match="time"):
        _ = case_of(tmp_path, DATASET + "site = 0\n", course=20).seaway


@pytest.mark.parametrize(
    ("keys", "course", "words"),
    [
        ("wave_heading_deg = 180\n", 20.0, "own directions"),
        ("sea_direction_deg = 180\n", 20.0, "own directions"),
        (
            "spreading = { kind = 'cosine-power', power = 2 }\ndirection_step_deg = 10\n",
            20.0,
            "own directions",
        ),
        ("", None, "set run.ship_heading_deg"),
    ],
)
def test_a_directional_dataset_has_its_own_directions(
    tmp_path: Path, dataset_file: Path, keys: str, course: float | None, words: str
) -> None:
    chosen = "time = '2020-01-01 06:00'\nsite = 0\n"
    with pytest.raises(PanelsimError, match=words):
        _ = case_of(tmp_path, DATASET + chosen + keys, course).seaway


@pytest.mark.parametrize(
    "keys",
    [
        'format = "netcdf"\nfiles = ["a", "b", "c", "d", "e"]',
        'format = "ndbc-meteorology"\nfiles = ["a", "b", "c", "d", "e"]',
        'format = "ndbc"\nfile = "a"\nsite = 1',
    ],
)
def test_keys_of_another_format_are_refused(tmp_path: Path, keys: str) -> None:
    with pytest.raises(PanelsimError, match="format"):
        case_of(tmp_path, f'kind = "dataset"\n{keys}')


def test_a_buoy_tells_the_direction_where_the_case_does_not(tmp_path: Path) -> None:
    buoy = read_ndbc_meteorology(NDBC / "99999.txt")
    from_north = np.rad2deg(buoy.sea_direction_at("2020-06-08 03:50"))
    sea = case_of(tmp_path, METEOROLOGY + LATE, course=70).seaway
    assert isinstance(sea, RandomSeaway) and sea.wave_heading is not None
    assert np.rad2deg(sea.wave_heading) == pytest.approx((from_north + 180 - 70) % 360, abs=1e-9)
    given = case_of(tmp_path, METEOROLOGY + LATE + "wave_heading_deg = 10").seaway
    assert np.rad2deg(given.components.wave_heading[0]) == pytest.approx(10)
    with pytest.raises(PanelsimError, match="ship_heading_deg"):
        _ = case_of(tmp_path, METEOROLOGY + LATE).seaway


def test_a_sea_of_very_many_components_is_warned_of(tmp_path: Path) -> None:
    keys = f"{RANDOM}sea_state = 6\nwave_heading_deg = 0\ndirection_step_deg = 10\n"
    keys += 'spreading = { kind = "cosine-squared", spreading_angle_deg = 90 }\n'
    grid = "frequencies = {{ start = 0.2, stop = 2.0, step = {} }}\n"
    cases = [case_of(tmp_path, keys + grid.format(step)) for step in (0.001, 0.1)]
    assert cases[0].seaway.components.count > 20_000
    told = [case.warnings() for case in cases]
    assert ["components" in warning for warning in told[0]].count(True) == 1
    assert not any("components" in warning for warning in told[1])
