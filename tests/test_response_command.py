"""`panelsim response`: its table, its file and its pictures, and what it refuses."""

import json
import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import panelsim
from panelsim.case import Case
from panelsim.cli.respond import numbers
from panelsim.conventions import KNOT
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.response.natural import natural_periods
from panelsim.response.response import response
from panelsim.studies.case_response import case_response
from panelsim.view.response_picture import polar_picture, transfer_picture

ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "examples" / "halifax_sea_state_7.toml"
QUICK = ["--set", "ship.panel_area=20", "--headings", "0,90,150", "--speeds", "0:20:20"]


@pytest.fixture
def call(panelsim: Callable[..., tuple[int, str, str]]) -> Callable[..., tuple[int, str, str]]:
    """Call `panelsim response`: exit code, output, errors."""
    return partial(panelsim, "response")


@pytest.fixture(scope="module")
def quick() -> Case:
    return Case.load(EXAMPLE, ["ship.panel_area=20"])


def test_it_prints_the_table_and_writes_file_and_pictures(call, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    target = tmp_path / "out" / "r.nc"
    code, text, errors = call(EXAMPLE, *QUICK, "-o", target, "--point", "bow=60,0,12")
    assert (code, errors) == (0, "")
    # The paths of the files are not broken.
    assert max(len(line) for line in text.splitlines() if not line.startswith("Files in")) <= 80
    assert sorted(p.name for p in target.parent.iterdir()) == ["r-polar.png", "r-transfer.png", "r.nc"]
    with xr.open_datatree(target, engine="h5netcdf") as tree:
        own = (
            tree["in_sea"].to_dataset().sel(speed=20 * KNOT, wave_heading=np.deg2rad(150.0), method="nearest")
        )
        rms = dict(zip(own["signal"].values, own["rms"].values, strict=True))
        transfer = tree["transfer_real"] + 1j * tree["transfer_imag"]
        assert transfer.dims == ("speed", "wave_heading", "wave_frequency", "signal")
        # Heave of the longest wave, of ten ship lengths.
        assert abs(complex(transfer.sel(signal="heave").values[0, 1, 0])) == pytest.approx(1.0, abs=0.02)
        bow = tree["points/bow/in_sea/rms"].sel(point_signal="displacement_z")
        assert bow.values[1, 2] > own["rms"].sel(signal="heave").item()
    # The line of the motion in the first table, and the row of the heading in that of the last speed.
    heave = re.search(r"heave +m +([\d.]+)", text)
    assert heave is not None and float(heave[1]) == pytest.approx(rms["heave"], abs=6e-4)
    row = [line for line in text.splitlines() if line.split()[:1] == ["150"]][-1].split()
    assert float(row[4]) == pytest.approx(np.rad2deg(rms["roll"]), abs=6e-4)
    assert "damping" in text and "of critical" in text
    # What is there is not replaced by itself.
    code, _, errors = call(EXAMPLE, *QUICK, "-o", target)
    assert code == 2 and "--force" in errors
    assert call(EXAMPLE, *QUICK, "-o", target, "--force")[0] == 0


def test_a_sea_by_compass_is_turned_with_the_headings(quick: Case) -> None:
    """The same sea given by spectrum and spread, and by a compass direction with a course."""
    spread = [
        "ship.panel_area=20",
        'seaway.spreading={kind="cosine-squared", spreading_angle_deg=90}',
        "seaway.direction_step_deg=15",
        "seaway.minimum_energy=0.5",
        "seaway.spectrum=jonswap",
    ]
    case = Case.load(EXAMPLE, spread)
    beta = np.deg2rad([30.0])
    found = case_response(case, beta, np.array([10.0]), {})
    at = found.table.in_sea(
        case.seaway.point_spectrum,  # type: ignore[attr-defined]
        wave_headings=found.table.wave_headings,
        spreading=case.seaway.spreading,  # type: ignore[attr-defined]
    )
    # The scattered directions lie otherwise about the mean.
    np.testing.assert_allclose(found.in_sea["rms"].values, at["rms"].values, rtol=0.01)
    assert np.all(found.in_sea["wave_heading"].values == found.table.wave_headings)


def test_a_regular_wave_is_turned_too() -> None:
    case = Case.load(
        EXAMPLE,
        [
            "ship.panel_area=20",
            'seaway={kind="regular", wave_height=2.0, wave_frequency=0.6, wave_heading_deg=150}',
        ],
    )
    found = case_response(case, np.deg2rad([40.0, 150.0]), np.array([5.0]), {})
    here = found.table.dataset["transfer"]
    assert found.own_heading == pytest.approx(np.deg2rad(150.0))
    exact = found.table.in_sea(case.seaway)["rms"].values[:, 0]
    np.testing.assert_allclose(found.in_sea["rms"].values[:, 1], exact, rtol=1e-9)
    # Two knots of a fine table: H at 0.6 rad/s by a straight line is good to a per cent of the peak.
    omega = found.table.wave_frequencies
    for j in range(2):
        amplitude = np.abs([np.interp(0.6, omega, here.values[0, j, :, k]) for k in range(6)]) / np.sqrt(2)
        np.testing.assert_allclose(
            found.in_sea["rms"].values[0, j], amplitude, atol=0.01 * np.abs(here.values[0, :, :]).max()
        )


def test_the_cases_own_speed_and_heading_are_always_there(quick: Case) -> None:
    found = case_response(quick, np.deg2rad([0.0, 90.0]), np.array([0.0]), {})
    np.testing.assert_allclose(found.table.speeds, [0.0, quick.speed])
    np.testing.assert_allclose(np.rad2deg(found.table.wave_headings), [0.0, 90.0, 150.0])


BARE = ["ship.panel_area=20", "supplementary.damping={surge=1e6, sway=2e6}"]


def test_roll_damping_of_the_case_is_made_linear_for_its_sea() -> None:
    """Ikeda's terms of each speed; transfer functions, natural roll and statistics have one damping."""
    case = Case.load(EXAMPLE, [*BARE, 'roll_damping.method="ikeda"', 'run.model="linear"'])
    database = case.database()
    found = case_response(case, np.deg2rad([60.0, 150.0]), np.array([0.0, case.speed]), {})
    terms = [case.roll_damping_at(speed, database) for speed in found.table.speeds]
    assert terms[1].linear > 1.5 * terms[0].linear > 0.0  # lift
    plain = response(
        case.ship,
        database,
        frequencies=found.table.wave_frequencies,
        wave_headings=found.table.wave_headings,
        speeds=found.table.speeds,
        supplementary=case.supplementary,
        roll_damping=terms,
    )
    sea = plain.in_sea(case.seaway.point_spectrum)  # type: ignore[attr-defined]
    np.testing.assert_array_equal(found.in_sea["rms"].values, sea["rms"].values)
    equivalent = sea["equivalent_roll_damping"].values
    assert np.all(equivalent > [[1.05 * each.linear] * 2 for each in terms]) and found.linearised
    np.testing.assert_array_equal(found.table.dataset["roll_damping"].values, equivalent)
    assert found.own == (1, 1)
    natural = natural_periods(
        case.ship, database, case.supplementary, RollDampingTerms(float(equivalent[1, 1]))
    )
    assert found.natural == natural


def test_roll_damping_in_percent_is_linear_already() -> None:
    """5 % of critical more than none: the damping of roll by itself tells it."""
    free = ["ship.panel_area=20", "supplementary={stiffness={}, damping={}}"]
    bare, damped = (
        case_response(Case.load(EXAMPLE, [*free, *more]), np.array([1.0]), np.array([0.0]), {})
        for more in ([], ['roll_damping={method="percent", critical_percent=5}'])
    )
    assert not damped.linearised
    assert bare.natural["roll"] is not None and damped.natural["roll"] is not None
    added = damped.natural["roll"].damping_ratio - bare.natural["roll"].damping_ratio
    # Both are of the roll that is free to sway and yaw; the radiated waves couple them a little.
    assert added == pytest.approx(0.05, rel=0.05)
    at_rest = {"signal": "roll", "speed": 0.0}
    assert np.all(damped.in_sea["rms"].sel(at_rest) < 0.9 * bare.in_sea["rms"].sel(at_rest))


def test_the_damping_of_each_heading_is_printed(call, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    damping = ["--set", "roll_damping.method=ikeda", "--set", "supplementary.damping={sway=2e6}"]
    points = ["--set", "points.bridge=[20.0, 0.0, 15.0]", "--point", "mast=0,0,30"]
    target = tmp_path / "r.nc"
    code, text, _ = call(EXAMPLE, "-o", target, *QUICK[:4], *damping, *points)
    assert code == 0 and "made linear for this sea" in text
    assert text.index("Point bridge") < text.index("Point mast")
    assert text.count("RMS at") == 1 and "--speeds prints them" in text
    with xr.open_datatree(target, engine="h5netcdf") as tree:
        assert set(tree["points"].children) == {"bridge", "mast"}
        own = tree["in_sea/equivalent_roll_damping"].values[-1, -1]
        assert tree["roll_damping"].values[-1, -1] == own
    row = next(line for line in text.splitlines() if line.split()[:1] == ["150"]).split()
    assert float(row[-1]) == pytest.approx(1e-6 * own, abs=6e-4)


def test_pictures_show_the_right_side_and_the_right_phase(
    quick: Case, tmp_path: Path, drawn: list[Figure]
) -> None:
    found = case_response(quick, np.deg2rad([45.0, 150.0, 270.0]), np.array([10.0]), {})
    polar_picture(found.in_sea, tmp_path / "polar.png")
    transfer_picture(found.table, found.own_heading, quick.speed, tmp_path / "transfer.png")
    polar, transfer = drawn
    heave = polar.axes[2]
    assert heave.get_theta_direction() == -1  # type: ignore[attr-defined]
    angle, radius = (np.asarray(values) for values in heave.lines[1].get_data())
    rms = found.in_sea["rms"].sel(signal="heave").values[1]
    # Waves of 150° come from 30° to port of the bow, 330° clockwise; 270° from starboard; 45° from port aft.
    for side, heading in ((330.0, 1), (90.0, 2), (225.0, 0)):
        assert radius[np.argmin(np.abs(np.rad2deg(angle) - side))] == pytest.approx(rms[heading])
    amplitude, phase = transfer.axes[7], transfer.axes[10]
    assert amplitude.get_ylabel().startswith("pitch")
    line = amplitude.lines[1].get_ydata()
    j = 1
    i = int(np.argmin(np.abs(found.table.speeds - quick.speed)))
    k = found.table.wave_frequencies**2 / quick.ship.gravity
    np.testing.assert_allclose(line, np.abs(found.table.transfer[i, j, :, 4]) / k)  # type: ignore[arg-type]
    # Long waves from ahead: the bow goes down as the crest passes from it to the CG and on, 90° behind.
    assert np.asarray(phase.lines[1].get_ydata())[0] == pytest.approx(-90.0, abs=15.0)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--headings", "0:x:3"], "--headings"),
        (["--headings", "0:180:0"], "--headings"),
        (["--headings", "180:0:15"], "--headings"),
        (["--headings", "0:360:0.1"], "400"),
        (["--headings", "500"], "beyond a turn"),
        (["--headings", "0,360"], "twice"),
        (["--speeds", "-5,10"], "goes ahead"),
        (["--speeds", "nan"], "--speeds"),
        (["--speeds", "inf"], "for example 0:20:5"),
        (["--speeds", "0:20"], "for example 0:20:5"),
        (["--speeds", "5,5"], "got: 5,5 knots"),
        (["--point", "bridge"], "NAME=X,Y,Z"),
        (["--point", "mast", "--set", "points.bridge=[20.0, 0.0, 15.0]"], "the case has bridge"),
        (["--point", "a=1,2"], "three finite numbers"),
        (["--point", "a=1,2,nan"], "three finite numbers"),
        (["--point", "a=0:20:10"], "NAME=X,Y,Z"),
        (["--point", "a=nan,0,0"], "NAME=X,Y,Z"),
        (["--point", "bridge=1,2", "--set", "points.bridge=[20.0, 0.0, 15.0]"], "three finite numbers"),
        (["--point", "a/b=1,2,3"], "a/b"),
        (["--point", "a=2000,0,15"], "far off the ship"),
        (["--point", "a=1,2,3", "--point", "a=1,2,3"], "twice"),
        (["--point", "a=1,2,3", "--set", "points.a=[20.0, 0.0, 15.0]"], "The case has a point"),
        (["--set", "points.a=[2000.0, 0.0, 15.0]"], "far off the ship"),
        (["--set", 'roll_damping.method="ikeda"'], "counted twice"),
        (["--set", 'seaway={kind="calm"}'], "calm"),
        (["-o", "response.csv"], ".nc"),
    ],
)
def test_bad_input_is_refused_in_one_message(call, tmp_path: Path, options: list[str], message: str) -> None:  # type: ignore[no-untyped-def]
    target = tmp_path / "r.nc"
    where = [] if "-o" in options else ["-o", target]
    code, text, errors = call(EXAMPLE, "--set", "ship.panel_area=20", *where, *options)
    assert code == 2 and message in errors and text == ""
    assert errors.count("error:") == 1 and "Traceback" not in errors
    assert not target.exists()


def test_ranges_and_lists() -> None:
    np.testing.assert_allclose(numbers("--x", "0:180:45", "degrees"), [0, 45, 90, 135, 180])
    np.testing.assert_allclose(numbers("--x", "0:1:0.1", "knots"), np.arange(11) / 10)
    np.testing.assert_allclose(numbers("--x", "5, 7.5", "knots"), [5.0, 7.5])


def test_the_code_of_the_page_runs() -> None:
    page = (ROOT / "docs" / "response.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert blocks
    names: dict[str, object] = {}
    for block in blocks:
        exec(block, names)
    # RMS of heave of the frigate of TM 2003-190 at 20 knots in bow seas of 7.5 m.
    assert names["heave"] == pytest.approx(1.67, abs=0.02)


def test_the_file_says_what_made_it_and_each_group_stands_alone(tmp_path: Path) -> None:
    case = Case.load(
        EXAMPLE,
        [
            "ship.panel_area=20",
            "hydrodynamics.transom_terms=true",
            "supplementary.damping={sway=2e6}",
            "roll_damping.method=ikeda",
        ],
    )
    bridge = {"bridge": np.array([20.0, 0.0, 15.0])}
    found = case_response(case, np.deg2rad([150.0]), np.array([case.speed]), bridge)
    found.save(tmp_path / "r.nc")
    root = xr.load_dataset(tmp_path / "r.nc", engine="h5netcdf")
    about = root.attrs
    assert about["ship"] == case.ship.name and about["panelsim_version"] == panelsim.__version__
    assert (about["draft"], about["mass"]) == (case.ship.draft, case.ship.mass)
    assert "Capytaine" in about["coefficients"] and about["transom_terms"] == "yes"
    assert json.loads(about["supplementary"])["damping"] == {"sway": 2e6}
    assert about["roll_damping_method"] == "ikeda"
    assert f"linear {found.table.roll_damping[0].linear:.4g} N m s" in about["roll_damping"]
    assert json.loads(about["case"])["hydrodynamics"]["transom_terms"] is True
    sea = "bretschneider sea, long-crested, significant height 7.5 m, mean period 11.58 s"  # 0.77177 · 15 s
    assert about["sea"] == sea
    for variable in root.data_vars.values():
        assert {"units", "long_name"} <= set(variable.attrs), variable.name
    imaginary = root["transfer_imag"].attrs
    assert imaginary["units"] == "m/m: surge, sway, heave; rad/m: roll, pitch, yaw"
    assert imaginary["long_name"] == "imaginary part of transfer function per metre of wave amplitude"
    for group, of_point in (("in_sea", False), ("points/bridge", True), ("points/bridge/in_sea", True)):
        alone = xr.load_dataset(tmp_path / "r.nc", group=group, engine="h5netcdf")
        np.testing.assert_array_equal(alone["speed"], root["speed"])
        np.testing.assert_array_equal(alone["wave_heading"], root["wave_heading"])
        np.testing.assert_array_equal(alone["wave_frequency"], root["wave_frequency"])
        name, unit = ("transfer_real", "m/m") if group == "points/bridge" else ("rms", "m")
        signal = "displacement_x" if of_point else "surge"
        assert alone[name].attrs["units"].startswith(f"{unit}: {signal}")
        assert alone.attrs["ship"] == case.ship.name and alone.attrs["sea"] == sea
    assert any("end terms of the transom" in note for note in found.table.notes)


def test_roll_damping_of_each_speed_is_told(quick: Case) -> None:
    database = quick.database()
    table = response(
        quick.ship,
        database,
        frequencies=[0.5],
        wave_headings=[np.pi],
        speeds=[0.0, 5.0],
        supplementary=quick.supplementary,
        roll_damping=[RollDampingTerms(1e6), RollDampingTerms(2e6, 3e7)],
    )
    assert table.dataset.attrs["roll_damping"] == (
        "at 0 m/s linear 1e+06 N m s, quadratic 0 N m s2, cubic 0 N m s3;"
        " at 5 m/s linear 2e+06 N m s, quadratic 3e+07 N m s2, cubic 0 N m s3"
    )
    assert table.dataset.attrs["transom_terms"] == "no"


def test_head_seas_alone_are_points_and_motions_out_of_the_plane_are_nothing(
    quick: Case, tmp_path: Path, drawn: list[Figure]
) -> None:
    found = case_response(
        Case.load(EXAMPLE, ["ship.panel_area=20", "seaway.wave_heading_deg=180"]),
        np.array([np.pi]),
        np.array([quick.speed]),
        {},
    )
    polar_picture(found.in_sea, tmp_path / "polar.png")
    transfer_picture(found.table, found.own_heading, quick.speed, tmp_path / "transfer.png")
    polar, transfer = drawn
    assert polar.get_suptitle().startswith(f"{quick.ship.name}, bretschneider sea")
    for dof in range(6):
        (line,) = polar.axes[dof].lines
        assert line.get_marker() == "."
        rms = np.asarray(line.get_ydata())
        if dof in (1, 3, 5):
            assert np.all(rms == 0.0) and polar.axes[dof].get_ylim() == (0.0, 1.0)
        else:
            factor = 180 / np.pi if dof > 2 else 1.0
            assert rms == pytest.approx(factor * found.in_sea["rms"].values[0, 0, dof])
            assert polar.axes[dof].get_ylim()[1] > rms.max()
        amplitude = transfer.axes[6 * (dof // 3) + dof % 3]
        assert np.any(amplitude.lines[0].get_ydata()) == (dof not in (1, 3, 5))  # type: ignore[arg-type]
        assert amplitude.get_title() == ""


def test_a_spike_is_cut_off_and_told(tmp_path: Path, drawn: list[Figure]) -> None:
    """Nothing damps the surge on its spring in following seas: its peak is hundreds of times the rest."""
    loose = ["ship.panel_area=20", "supplementary={stiffness={surge=5e5, sway=1e6, yaw=2e9}, damping={}}"]
    case = Case.load(EXAMPLE, [*loose, "seaway.wave_heading_deg=0"])
    found = case_response(case, np.array([0.0]), np.array([case.speed]), {})
    transfer_picture(found.table, found.own_heading, case.speed, tmp_path / "transfer.png")
    surge, heave = drawn[0].axes[0], drawn[0].axes[2]
    largest = float(np.abs(found.table.transfer[0, 0, :, 0]).max())
    usual = float(np.quantile(np.abs(found.table.transfer[0, 0, :, 0]), 0.95))
    assert surge.get_title() == f"cut off: a spike of {largest:.3g} m/m"
    assert surge.get_ylim()[1] == pytest.approx(1.05 * 4.0 * usual) and 4.0 * usual < largest
    assert heave.get_title() == ""
