"""`panelsim run --resume`: an interrupted or shorter run becomes the whole one, bit for bit, and no other."""

import json
import shlex
import shutil
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from panelsim.case import Case
from panelsim.cli import commands
from panelsim.errors import PanelsimError
from panelsim.hull.form import hull_folder
from panelsim.hydro.database import HydroDatabase
from panelsim.motion import march
from panelsim.motion.history import History
from panelsim.studies import run_case
from panelsim.studies.going_on import begun_run

Call = Callable[..., tuple[int, str, str]]
SEA = "significant_wave_height = 3.0\npeak_period = 9.0\nwave_heading_deg = 150\nseed = 1001\n"
WITHOUT_TIMINGS = ("realtime_factor", "cpu_seconds", "jit_seconds")


@pytest.fixture(autouse=True)
def without_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Plots and recordings take most of the time of a short run; they are made from the history."""
    monkeypatch.setattr(run_case, "report", lambda history, folder: (folder / "report.md").write_text("made"))
    monkeypatch.setattr(run_case, "record", lambda history, path: path.write_text("made"))


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    return write_case(tmp_path)


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run of the case that was interrupted in its ramp."""
    folder = tmp_path_factory.mktemp("begun")
    case = Case.load(write_case(folder))
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(march, "STEPS_BETWEEN_PROGRESS", 1)
        patched.setattr(run_case, "report", lambda history, folder: None)
        patched.setattr(run_case, "record", lambda history, path: path.write_text("made"))

        def stop(done: float, total: float) -> None:
            if done >= 2.0 - 1e-9:
                raise KeyboardInterrupt

        run_case.run_case(case, folder / "run", on_run=stop)
    return folder / "run"


def write_case(folder: Path) -> Path:
    """A frigate of a hundred wet panels, nonlinear, 40 steps."""
    path = folder / "my ship.toml"
    path.write_text(
        f'[ship]\nhull = "halifax"\npanel_area = 20.0\n[seaway]\nkind = "random"\n{SEA}'
        "spectrum = 'bretschneider'\nfrequencies = { start = 0.4, stop = 1.8, step = 0.1 }\n"
        "[run]\nspeed_knots = 15\ntime_step = 0.4\nramp = 4\nduration = 12\n",
        encoding="utf-8",
    )
    return path


@contextmanager
def interrupted_at(seconds: float) -> Iterator[list[float]]:
    """Send this process Ctrl-C when the run has come so far; lends the times [s] that were told of it."""
    told: list[float] = []

    @contextmanager
    def bars() -> Iterator[Callable[[str], Callable[[float, float], None]]]:
        def track(label: str) -> Callable[[float, float], None]:
            def update(done: float, total: float) -> None:
                if label == "run":
                    told.append(done)
                    if done >= seconds - 1e-9:
                        # To this thread: the system may give a signal of the process to any thread,
                        # and this one hears of it too late.
                        signal.raise_signal(signal.SIGINT)

            return update

        yield track

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(commands, "progress_bars", bars)
        patched.setattr(march, "STEPS_BETWEEN_PROGRESS", 1)
        yield told


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def numbers(folder: Path) -> dict[str, object]:
    found = json.loads((folder / "statistics.json").read_text())
    return {name: value for name, value in found.items() if name not in WITHOUT_TIMINGS}


def test_an_interrupted_run_tells_the_command_that_finishes_it(panelsim: Call, case_file: Path) -> None:
    """Stopped before the first step, in the ramp and after it: what is typed next makes the whole run."""
    change = ("--set", "run.duration=16")
    assert panelsim("run", case_file, "--out", "whole", *change)[0] == 0
    whole = History.load(Path("whole/history.nc"))
    with interrupted_at(0.0):
        code, _, err = panelsim("run", case_file, "--out", "my runs/1", *change)
    for stop in (2.0, 10.0, None):
        assert code == 3
        begun = History.load(Path("my runs/1/history.nc"))
        assert begun.outcome == "interrupted" and len(begun.time) < len(whole.time)
        (told,) = [line for line in err.splitlines() if line.startswith("To go on: ")]
        command = shlex.split(told.removeprefix("To go on: panelsim "))
        assert command[-1] == "--resume" and command[2:4] == ["--out", "my runs/1"]
        if stop is None:
            code, out, err = panelsim(*command)
        else:
            with interrupted_at(stop):
                code, out, err = panelsim(*command)
    assert code == 0 and "Going on" in out and err == ""
    assert History.load(Path("my runs/1/history.nc")).same_bits(whole)
    assert numbers(Path("my runs/1")) == numbers(Path("whole"))
    assert contents(Path("my runs/1")).keys() == contents(Path("whole")).keys()


def test_a_finished_run_is_made_longer(panelsim: Call, case_file: Path) -> None:
    assert panelsim("run", case_file)[0] == 0
    folder = Path("runs/my ship")
    short = History.load(folder / "history.nc")
    (folder / "motions.csv").write_text("of the shorter run")
    with interrupted_at(1e9) as told:
        code, out, _ = panelsim("run", case_file, "--set", "run.duration=20", "--resume")
    # It went on, and did not do the same again.
    assert told[0] == pytest.approx(16.0)
    assert code == 0 and "Going on at 16 s of 24 s" in out
    assert not (folder / "motions.csv").exists()
    assert panelsim("run", case_file, "--set", "run.duration=20", "--out", "whole")[0] == 0
    longer, whole = (History.load(f / "history.nc") for f in (folder, Path("whole")))
    assert longer.same_bits(whole) and not longer.same_bits(short)
    # Nothing left to do is the run itself; a shorter one than there is cannot be.
    assert panelsim("run", case_file, "--set", "run.duration=20", "--resume")[0] == 0
    assert History.load(folder / "history.nc").same_bits(whole)
    before = contents(folder)
    code, out, err = panelsim("run", case_file, "--resume")
    assert (code, out) == (2, "")
    assert "longer than the case.\n  got: 20 s after the ramp\n  allowed: at most run.duration = 12 s" in err
    with pytest.raises(PanelsimError, match="longer than the case"):  # by one step
        begun_run(Case.load(case_file, ["run.duration=19.6"]), folder)
    assert contents(folder) == before


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("seaway.seed=7", "seaway.seed 1001 there, 7 here"),
        ("run.speed_knots=16", "run.speed_knots 15.0 there, 16.0 here"),
        ("run.capsize_angle_deg=60", "run.capsize_angle_deg 90.0 there, 60.0 here"),
        ("ship.hull=frigate", "ship.hull halifax there, frigate here"),
        ("supplementary.damping.roll=1e7", "supplementary.damping.roll 20000000.0 there, 10000000.0 here"),
        ("roll_damping.method=ikeda", "roll"),
    ],
)
def test_a_run_of_another_case_is_refused_and_kept(
    panelsim: Call, case_file: Path, begun: Path, tmp_path: Path, change: str, words: str
) -> None:
    """On the command line and by the function; the folder is as it was, to the bit."""
    shutil.copytree(begun, tmp_path / "run")
    before = contents(tmp_path / "run")
    code, _, err = panelsim("run", case_file, "--out", "run", "--resume", "--set", change)
    assert code == 2 and err.startswith("error: ") and err.count("error: ") == 1
    assert words in err
    with pytest.raises(PanelsimError, match=words.replace(".", r"\.")):
        begun_run(Case.load(case_file, [change]), tmp_path / "run")
    assert contents(tmp_path / "run") == before


def test_what_only_the_files_of_a_case_tell_apart_is_refused_too(
    panelsim: Call, case_file: Path, begun: Path, tmp_path: Path
) -> None:
    """The same words in the case, other coefficients in the file that it names."""
    shutil.copytree(begun, tmp_path / "run")
    database = HydroDatabase.load(hull_folder("halifax") / "hydro.nc")
    database.save(tmp_path / "coefficients.nc")
    change = ("--set", "hydrodynamics.file=coefficients.nc", "--out", "run")
    code, _, err = panelsim("run", case_file, *change, "--resume")
    assert code == 2 and "hydrodynamics.file not given there, coefficients.nc here" in err
    assert panelsim("run", case_file, *change, "--force")[0] == 0
    dataset = database.dataset.copy()
    dataset["radiation_damping"] = dataset["radiation_damping"] * 1.0001
    HydroDatabase(dataset).save(tmp_path / "coefficients.nc", overwrite=True)
    before = contents(tmp_path / "run")
    code, _, err = panelsim("run", case_file, *change, "--resume")
    assert code == 2 and "its set of coefficients is another" in err
    assert contents(tmp_path / "run") == before


def test_a_folder_without_a_run_is_refused(panelsim: Call, case_file: Path, tmp_path: Path) -> None:
    code, _, err = panelsim("run", case_file, "--out", "none", "--resume")
    assert code == 2 and "no run to go on with" in err and "leave out --resume" in err
    assert not (tmp_path / "none").exists()
    code, _, err = panelsim("run", case_file, "--resume", "--force")
    assert code == 2 and "give one of them" in err
    (tmp_path / "cut").mkdir()
    (tmp_path / "cut/history.nc").write_text("no history")
    code, _, err = panelsim("run", case_file, "--out", "cut", "--resume")
    assert code == 2 and "damaged" in err
    assert contents(tmp_path / "cut") == {"history.nc": b"no history"}
