"""Sweeps: statistics of the runs as they are by themselves, what is refused, pictures and the command."""

import json
import socket
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

import panelsim as ps
from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.studies.axes import Axis
from panelsim.studies.case_history import case_history
from panelsim.studies.run_store import RunStore
from panelsim.studies.sweep import sweep
from panelsim.studies.sweep_folder import SweepFolder
from panelsim.studies.sweep_plan import plan_sweep
from panelsim.view.sweep_picture import HEADING, SPEED, _around, sweep_picture

EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
SHORT = {"ship.panel_area": 40.0, "run.duration": 30.0, "run.ramp": 10.0, "run.time_step": 0.5}
AXES = {HEADING: [0, 60, 120, 180], SPEED: [0, 12]}
Panelsim = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def base() -> Case:
    return Case.load(EXAMPLE).changed(SHORT)


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("runs")


@pytest.fixture(scope="module")
def found(base: Case, runs: Path) -> xr.Dataset:
    return sweep(base, AXES, seeds=3, folder=runs, workers=1)


def test_statistics_are_those_of_the_runs(base: Case, found: xr.Dataset) -> None:
    """Of three histories by themselves: 60°, 12 knots, seeds 1001 to 1003, by `statistics`."""
    cases = [
        base.changed({HEADING: 60, SPEED: 12, "seaway.seed": seed})
        for seed in json.loads(found.attrs["seeds"])
    ]
    alone = [ps.statistics(case_history(case, case.database())) for case in cases]
    here = found.sel({HEADING: 60, SPEED: 12})
    for name in ("roll", "heave", "yaw"):
        each = [run.motions[name] for run in alone]
        of = here.sel(dof=name)
        rms = np.array([values.rms for values in each])
        # Rounding: the same numbers in another order.
        assert of["mean"] == pytest.approx(np.mean([values.mean for values in each]), rel=1e-9)
        assert of["rms"] == pytest.approx(np.sqrt(np.mean(rms**2)), rel=1e-12)
        assert of["max"] == max(values.max for values in each if values.max is not None)
        assert of["min"] == min(values.min for values in each if values.min is not None)
        periods = [values.zero_crossing_period for values in each]
        assert of["zero_crossing_period"] == pytest.approx(np.mean(periods), rel=1e-12)  # type: ignore[arg-type]
        # Student's t of two degrees of freedom at 95 % is 4.3027; half the variance's share is the RMS's.
        error = 4.30265 * np.std(rms**2, ddof=1) / np.sqrt(3) / (2 * np.sqrt(np.mean(rms**2)))
        assert of["rms_half_width"] == pytest.approx(error, rel=1e-5)
    heights = [run.wave_elevation.rms for run in alone]
    assert here["wave_elevation_rms"] == pytest.approx(np.sqrt(np.mean(np.square(heights))), rel=1e-12)  # type: ignore[arg-type]


def test_what_the_dataset_says(base: Case, found: xr.Dataset) -> None:
    assert found["rms"].dims == (HEADING, SPEED, "dof")
    assert found[HEADING].attrs["units"] == "deg" and found[SPEED].attrs["units"] == "knots"
    assert all(found[name].attrs["units"] for name in found.data_vars)
    assert found["dof_unit"].values.tolist() == ["m"] * 3 + ["rad"] * 3
    assert (found["realizations"] == 3).all() and not found["failed"].any()
    assert json.loads(found.attrs["seeds"]) == [1001, 1002, 1003]
    assert json.loads(found.attrs["case"]) == json.loads(json.dumps(base.resolved()))
    assert found.attrs["panelsim_version"] == ps.__version__
    assert json.loads(found.attrs["ended_early"]) == []
    # A symmetric ship does not roll in following and head seas, and does between them.
    roll = found["rms"].sel(dof="roll")
    assert (
        float(roll.sel({HEADING: [0, 180]}).max()) < 1e-9 < 1e-3 < float(roll.sel({HEADING: [60, 120]}).min())
    )


def test_runs_that_are_there_are_not_made_again(
    base: Case, found: xr.Dataset, runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("panelsim.studies.computing.make_group", None)
    again = sweep(base, {SPEED: np.array([0, 12]), HEADING: [60]}, seeds=3, folder=runs, workers=1)
    xr.testing.assert_equal(again["rms"].squeeze(HEADING), found["rms"].sel({HEADING: 60}))
    assert again["rms"].dims == (SPEED, HEADING, "dof")


def test_runs_that_end_early_are_told(base: Case) -> None:
    """A limit of roll that one of two headings exceeds; and a step that is too long for one of them."""
    capsized = sweep(base.changed({"run.capsize_angle_deg": 0.5}), {HEADING: [60, 180]}, workers=1)
    assert capsized["capsized"].values.tolist() == [1, 0]
    assert capsized["realizations"].values.tolist() == [0, 1]
    assert np.isnan(capsized["rms"].sel({HEADING: 60})).all()
    assert not np.isnan(capsized["rms"].sel({HEADING: 180})).any()
    (sentence,) = json.loads(capsized.attrs["ended_early"])
    assert sentence.startswith(f"{HEADING} = 60: capsized: roll")
    failed = sweep(base, {"run.time_step": [0.5, 5.0]}, workers=1)
    assert failed["failed"].values.tolist() == [0, 1]
    with pytest.raises(PanelsimError, match=r"No run of the sweep(.|\n)*time_step = 5.0(.|\n)*time step"):
        sweep(base, {"run.time_step": [5.0]}, workers=1)


@pytest.mark.parametrize(
    ("axes", "seeds", "words"),
    [
        ({}, 1, "no axis"),
        ({"run.speed": [1]}, 1, r"run.speed_knots"),
        ({"seaway.wave_heading": [1]}, 1, r"seaway.wave_heading_deg"),
        ({SPEED: [0, 99]}, 1, "60"),
        ({SPEED: []}, 1, "no values"),
        ({SPEED: [0]}, 0, "number of seeds"),
        ({SPEED: [0]}, True, "number of seeds"),
        ({"seaway.seed": [1, 2]}, 2, "seeds are an axis"),
        ({SPEED: range(21), HEADING: range(100)}, 1, r"21 x 100 x 1 = 2100 runs(.|\n)*most_runs=2100"),
    ],
)
def test_sweeps_refused(
    base: Case, axes: dict[str, list[float]], seeds: int, words: str, tmp_path: Path
) -> None:
    with pytest.raises(PanelsimError, match=words):
        sweep(base, axes, seeds=seeds, folder=tmp_path / "runs", workers=1)
    assert not list(tmp_path.iterdir())


def test_a_sea_without_seeds(base: Case) -> None:
    calm = base.changed({"seaway": {"kind": "calm"}})
    with pytest.raises(PanelsimError, match=r"no seeds(.|\n)*2 seeds, seaway.kind = \"calm\""):
        plan_sweep(calm, [Axis(SPEED, (0, 5))], 2)
    plan = plan_sweep(calm, [Axis(SPEED, (0, 5))])
    assert [case.file.run.speed_knots for case in plan.cases.values()] == [0.0, 5.0]


def test_polar_picture(found: xr.Dataset, drawn: list[Figure], tmp_path: Path) -> None:
    """Head seas up, waves from port to the left; the other side mirrored, and crosses where runs ended."""
    marked = found.copy(deep=True)
    marked["capsized"].loc[{HEADING: 60, SPEED: 12}] = 1
    assert sweep_picture(marked.isel({HEADING: [2, 0, 3, 1]}), tmp_path / "polar.png") is not None
    axes = [axis for axis in drawn[0].axes if axis.name == "polar"]
    assert [axis.get_title() for axis in axes] == ["surge", "sway", "heave", "roll", "pitch", "yaw"]
    roll = axes[3]
    assert roll.get_theta_offset() == pytest.approx(np.pi / 2) and roll.get_theta_direction() == -1  # type: ignore[attr-defined]
    crosses = roll.lines[1].get_xdata(), roll.lines[1].get_ydata()
    # β = 60° comes from abaft the port beam: 240° clockwise from the bow; its mirror image is at 120°.
    assert np.rad2deg(crosses[0]).tolist() == pytest.approx([120.0, 240.0]) and list(crosses[1]) == [12, 12]
    assert "mirror image" in drawn[0].get_suptitle() and "✕" in drawn[0].get_suptitle()
    assert "interpolated" in drawn[0].get_suptitle() and "there is none" not in drawn[0].get_suptitle()


@pytest.mark.parametrize(
    ("headings", "symmetric", "angles"),
    [
        # From following seas (180° from the bow) over port to head seas, and nothing across starboard.
        ([0, 60, 120, 180], "no", [180, 240, 300, 360]),
        ([0, 60, 120, 180], "yes", [0, 60, 120, 180, 240, 300, 360]),
        ([0, 90, 180, 270], "yes", [0, 90, 180, 270, 360]),
        ([150, 180, 210], "yes", [330, 360, 390]),
        ([150, 165, 180], "yes", [330, 345, 360, 375, 390]),
    ],
)
def test_the_circle_is_closed_where_all_of_it_was_swept(
    headings: list[float], symmetric: str, angles: list[float]
) -> None:
    found = xr.Dataset(coords={HEADING: headings}, attrs={"port_starboard_symmetric": symmetric})
    angle, taken, mirrored = _around(found)
    assert angle.tolist() == angles
    beta = np.array(headings)[taken]
    # The angle is where the waves come from, 180° less than they travel to; mirrored, the other way round.
    assert np.all((np.abs(np.mod(angle - beta, 360) - 180) < 1e-9) | (np.mod(angle + beta, 360) == 180))
    assert mirrored == (symmetric == "yes" and max(headings) <= 180)


def test_pictures_over_one_key(found: xr.Dataset, drawn: list[Figure], tmp_path: Path) -> None:
    sweep_picture(found.isel({HEADING: [1], SPEED: [1, 0]}), tmp_path / "line.png")
    line = drawn[0].axes[3].lines[0]
    assert list(line.get_xdata()) == [0, 12]
    degrees = np.rad2deg(found["rms"].sel({HEADING: 60}).sel(dof="roll").values)
    assert list(line.get_ydata()) == pytest.approx(degrees.tolist())
    words = (
        found.isel({HEADING: 1})
        .rename({SPEED: "run.model"})
        .assign_coords({"run.model": ["linear", "nonlinear"]})
    )
    sweep_picture(words.drop_vars(HEADING), tmp_path / "words.png")
    assert [tick.get_text() for tick in drawn[1].axes[3].get_xticklabels()] == ["linear", "nonlinear"]
    # Words and points stand inside the panels.
    assert drawn[1].axes[3].get_xlim() == (-0.5, 1.5)
    for figure in drawn:
        for axis in figure.axes:
            assert axis.get_ylim()[1] > 1.05 * max(axis.lines[0].get_ydata())
    assert sweep_picture(found.isel({HEADING: [0, 1]}), tmp_path / "none.png") is None
    assert {file.name for file in tmp_path.iterdir()} == {"line.png", "words.png"}


def test_points_without_an_rms_are_no_points_at_zero(
    found: xr.Dataset, drawn: list[Figure], tmp_path: Path
) -> None:
    gone = found.isel({HEADING: [1]}).copy(deep=True)
    gone["capsized"][:] = [[1, 3]]
    gone["realizations"][:] = [[2, 0]]
    for name in ("rms", "rms_half_width"):
        gone[name][0, 1] = np.nan
    sweep_picture(gone, tmp_path / "line.png")
    roll = drawn[0].axes[3]
    (some, none) = (line for line in roll.lines if line.get_marker() == "x")
    assert (list(some.get_xdata()), list(none.get_xdata())) == ([0], [12])
    assert some.get_ydata()[0] == pytest.approx(roll.lines[0].get_ydata()[0])
    # By its height in the panel, whatever the scale.
    assert list(none.get_ydata()) == [0.97] and none.get_transform() == roll.get_xaxis_transform()
    assert "or there is none" in drawn[0].get_suptitle()
    gone["realizations"][:] = 0
    assert sweep_picture(gone, tmp_path / "nothing.png") is None


@pytest.fixture
def case_file(tmp_path: Path, base: Case) -> Path:
    text = EXAMPLE.read_text(encoding="utf-8")
    for key, value in SHORT.items():
        name = key.rpartition(".")[2]
        text = "\n".join(
            f"{name} = {value}" if line.startswith(f"{name} ") else line for line in text.splitlines()
        )
    path = tmp_path / "sea.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_command(panelsim: Panelsim, case_file: Path, found: xr.Dataset) -> None:
    command = ["sweep", case_file, "--over", f"{HEADING}=60:120:60", "--workers", 1]
    code, out, err = panelsim(*command, "--seeds", 2)
    assert code == 0 and "2 x 2 = 4 runs" in out and "roll" in out
    assert "The RMS is not known" in err and "docs/studies.md" in err  # ± 504 %
    folder = Path("runs/sea-sweep")
    assert {file.name for file in folder.iterdir()} == {
        "sweep.nc",
        "sweep.csv",
        "sweep.png",
        "sweep.json",
        "runs",
    }
    with xr.open_dataset(folder / "sweep.nc", engine="h5netcdf") as kept:
        assert json.loads(kept.attrs["seeds"]) == [1001, 1002]
        assert kept["rms"].dims == (HEADING, "dof")
    lines = (folder / "sweep.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1 + 2 * 6 and lines[0].startswith(f"{HEADING},dof,mean,rms,")

    code, _, err = panelsim(*command, "--seeds", 3)
    assert code == 2 and "a sweep of this case already" in err and "--resume" in err
    before = {file: file.stat().st_mtime_ns for file in (folder / "runs").iterdir()}
    code, out, err = panelsim(*command, "--seeds", 3, "--resume")
    assert code == 0 and "2 x 3 = 6 runs" in out and "The RMS is " in err
    after = {file: file.stat().st_mtime_ns for file in (folder / "runs").iterdir()}
    assert len(after) == 6 and before.items() <= after.items()
    code, _, err = panelsim(*command, "--resume", "--set", "run.speed_knots=3")
    assert code == 2 and "of another case" in err
    code, _, err = panelsim(*command, "--resume", "--out", "elsewhere")
    assert code == 2 and "without a sweep" in err and not Path("elsewhere").exists()
    code, _, err = panelsim(*command, "--force", "--set", "run.capsize_angle_deg=0.5")
    assert code == 3 and "2 capsized" in err and f"{HEADING} = 60" in err
    assert len(list((folder / "runs").iterdir())) == 2


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "no axis"),
        (["--over", "run.speed_knots=0:9:2"], "does not lead"),
        (["--over", "run.speed_knots=0,9", "--set", "run.speed_knots=3"], "set besides"),
        (["--over", "run.speed_knots=0,9", "--seeds", "0"], "number of seeds"),
        (["--over", "run.speed_knot=0,9"], "did you mean run.speed_knots?"),
        (["--over", "run.speed_knots=0,9", "--workers", "0"], "number of workers"),
        (["--over", "run.speed_knots=0,9", "--scheduler", "there"], "no address"),
        (["--over", "run.speed_knots=0,9", "--scheduler", "tcp://a:1", "--workers", "2"], "own workers"),
        (["--over", "run.speed_knots=0,9", "--force", "--resume"], "give one of them"),
        (["--over", "run.speed_knots=0,9", "--seeds", "1001"], "--most-runs 2002"),
    ],
)
def test_commands_refused(panelsim: Panelsim, case_file: Path, arguments: list[str], words: str) -> None:
    code, out, err = panelsim("sweep", case_file, *arguments)
    assert code == 2 and words in err and not out
    assert not Path("runs").exists()


def test_a_sweep_that_was_killed_goes_on_by_the_same_command(
    panelsim: Panelsim, case_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command = ["sweep", case_file, "--over", "run.speed_knots=0,9", "--workers", 1]
    with monkeypatch.context() as patch:
        patch.setattr(SweepFolder, "write", lambda *_: 1 / 0)  # and so it has runs, and no statistics
        with pytest.raises(ZeroDivisionError):
            panelsim(*command)
        before = {file: file.stat().st_mtime_ns for file in Path("runs/sea-sweep/runs").iterdir()}
    assert len(before) == 2
    code, _, err = panelsim(*command, "--set", "seaway.seed=7")
    assert code == 2 and "not empty" in err
    code, _, _ = panelsim(*command)
    assert code == 0
    assert before == {file: file.stat().st_mtime_ns for file in Path("runs/sea-sweep/runs").iterdir()}


def test_a_scheduler_that_does_not_answer_leaves_nothing(
    panelsim: Panelsim, case_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("panelsim.studies.cluster.CONNECT_SECONDS", 0.5)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))  # and does not listen
        address = f"tcp://127.0.0.1:{taken.getsockname()[1]}"
        code, _, err = panelsim("sweep", case_file, "--over", "run.speed_knots=0,9", "--scheduler", address)
    assert code == 2 and "No Dask scheduler answers" in err
    assert not Path("runs").exists()


def test_force_takes_away_what_a_sweep_made_and_nothing_else(base: Case, tmp_path: Path) -> None:
    folder, ours = SweepFolder(tmp_path), f"{'0a' * 10}.nc"
    names = ("sweep.nc", "sweep.csv", "sweep.png", f"runs/{ours}", f"runs/{'b' * 20}.failed.json")
    theirs = ("notes.txt", "runs/my_hydro.nc", "runs/my.failed.json", f"runs/x{ours}")
    (tmp_path / "runs").mkdir()
    for name in (*names, *theirs):
        (tmp_path / name).write_text("mine")
    folder.begin(base, anew=True)  # no sweep was begun here: all are the user's
    assert all((tmp_path / name).read_text() == "mine" for name in (*names, *theirs))
    folder.begin(base, anew=False)
    assert [name for name in names if not (tmp_path / name).exists()] == ["sweep.png"]
    folder.begin(base, anew=True)
    assert not any((tmp_path / name).exists() for name in names)
    assert all((tmp_path / name).read_text() == "mine" for name in theirs)


@pytest.mark.parametrize("content", [b"", b"{}", b"[1]", b"\xff\xfe", b'{"identity": 1}'])
def test_a_damaged_note_of_a_sweep(base: Case, tmp_path: Path, content: bytes) -> None:
    """It is refused in words, and with --force not taken for one of ours."""
    folder = SweepFolder(tmp_path)
    for name in ("sweep.json", "sweep.nc", "sweep.png"):
        (tmp_path / name).write_bytes(content)
    for resume in (True, False):
        with pytest.raises(PanelsimError, match=r"damaged|no note of a sweep"):
            folder.require_free(base, force=False, resume=resume)
    folder.require_free(base, force=True, resume=False)
    folder.begin(base, anew=True)
    assert (tmp_path / "sweep.nc").exists() and (tmp_path / "sweep.png").exists()


def test_a_sweep_into_a_folder_called_as_the_hull(
    panelsim: Panelsim, case_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The bundled hull is meant, and the runs are found again."""
    monkeypatch.chdir(case_file.parent)
    command = ["sweep", case_file, "--over", "run.speed_knots=0,9", "--workers", 1]
    code, _, err = panelsim(*command, "--out", "halifax")
    assert code == 0, err
    code, _, err = panelsim(*command, "--out", "halifax", "--resume")
    assert code == 0, err


def test_an_interrupt_says_how_to_go_on(
    panelsim: Panelsim, case_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("panelsim.cli.sweep.run_sweep", stopped)
    code, _, err = panelsim("sweep", case_file, "--over", "run.speed_knots=0,9", "--force")
    assert code == 130
    assert f"To go on: panelsim sweep {case_file} --over run.speed_knots=0,9 --resume" in err


def test_the_store_has_the_runs(base: Case, found: xr.Dataset, runs: Path) -> None:
    assert found is not None
    assert base.changed({HEADING: 0, SPEED: 12, "seaway.seed": 1003}) in RunStore(runs)
