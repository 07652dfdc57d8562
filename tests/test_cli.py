"""The command line through its entry point: every command, every kind of end, no traceback for bad input."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.console import Console

from panelsim.cli import commands, hydro, main
from panelsim.hull.form import bundled_hull_names, hull_folder, load_hull
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.motion.history import History
from panelsim.results.statistics import statistics
from panelsim.results.tables import statistics_markdown, statistics_table
from panelsim.ship.ship import Ship

EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
# A hundred wet panels and the linear model: what is tested here is not the physics.
QUICK = [
    *("--set", "ship.panel_area=20"),
    *("--set", "run.model=linear"),
    *("--set", "run.ramp=5"),
    *("--set", "run.duration=20"),
]
RUN_FILES = {"history.nc", "statistics.json", "report.md", "run.rrd"}
PICTURES = {"motions.png", "spectra.png", "loads.png"}
NOT_UPRIGHT = ("wigley_i", "wigley_iii")  # their GM is negative


@dataclass(frozen=True)
class Called:
    """What a command left: exit code, standard output, standard error."""

    code: int
    out: str
    err: str


Call = Callable[..., Called]


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    """Call `panelsim` with these arguments, in this process but through its entry point."""

    def called(*arguments: object) -> Called:
        capsys.readouterr()
        monkeypatch.setattr(sys, "argv", ["panelsim", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return Called(int(ended.value.code or 0), out, err)

    return called


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, subprocess.CompletedProcess[str]]:
    """The folder of a run that went to its end, by the installed command, and what that printed."""
    folder = tmp_path_factory.mktemp("finished") / "run"
    panelsim = Path(sys.executable).parent / "panelsim"
    environment = {**os.environ, "COLUMNS": "80", "OMP_NUM_THREADS": "1"}
    arguments = [panelsim, "run", EXAMPLE, "--out", folder, *QUICK]
    return folder, subprocess.run(
        arguments, capture_output=True, text=True, check=False, env=environment, timeout=120
    )


def refused(result: Called, *words: str) -> None:
    """Assert one message of the known form on standard error, and exit code 2."""
    assert result.code == 2
    assert result.err.startswith("error: "), result.err
    assert result.err.count("error: ") == 1
    assert all(word in result.err for word in words), result.err


# ---------------------------------------------------------------- the whole


def test_the_version_is_printed(call: Call) -> None:
    result = call("--version")
    assert (result.code, result.out.split()[0]) == (0, "panelsim")
    assert re.fullmatch(r"\d+\.\d+\.\d+", result.out.split()[1])


def test_without_a_command_the_help_is_shown(call: Call) -> None:
    result = call()
    assert result.code == 2
    assert all(name in result.out + result.err for name in ("new", "check", "run", "hull", "hydro", "view"))
    assert "error:" not in result.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["runn"], ["runn", "run"]),
        (["run", "--forc", "x"], ["--forc", "--force"]),
        (["run"], ["Missing argument"]),
        (["hydro", "halifax"], ["--output"]),
        (["hull", "box", "--panel-area", "big"], ["--panel-area"]),
    ],
)
def test_a_wrong_call_is_refused_like_any_bad_input(
    call: Call, arguments: list[str], words: list[str]
) -> None:
    refused(call(*arguments), *words)


def test_a_file_that_the_system_refuses_is_bad_input(call: Call, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    refused(call("new", tmp_path / "file" / "case"), "file")


def test_help_keeps_its_units(call: Call) -> None:
    assert "[m2]" in call("hull", "--help").out
    assert "[m]" in call("check", "--help").out


@pytest.mark.parametrize(
    ("error", "words"), [(MemoryError, "fewer components"), (RecursionError, "nested too deeply")]
)
def test_what_python_gives_up_on_is_one_message(
    call: Call, monkeypatch: pytest.MonkeyPatch, error: type[Exception], words: str
) -> None:
    def fails(*_: object) -> None:
        raise error

    monkeypatch.setattr("panelsim.cli.arguments.load_ship", fails)
    refused(call("hull", "box"), words)


def started(*arguments: object, **environment: str) -> subprocess.Popen[str]:
    """Start `python -m panelsim` as a process of its own."""
    return subprocess.Popen(
        [sys.executable, "-m", "panelsim", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **environment},
    )


@pytest.mark.parametrize("encoding", ["ascii", "latin-1"])
def test_a_terminal_without_greek_letters_is_no_reason_to_fail(encoding: str) -> None:
    out, err = started("hull", "frigate", "--panel-area", 20, PYTHONIOENCODING=encoding).communicate(
        timeout=60
    )
    assert err == ""
    assert "not compared" in out  # its row holds a dash that neither encoding knows


def test_an_interrupt_while_panelsim_is_imported_ends_with_one_line() -> None:
    code = (
        "import builtins, os, signal, sys\n"
        "from panelsim.cli import main\n"
        "assert 'numpy' not in sys.modules\n"
        "plain = builtins.__import__\n"
        "def interrupted(name, *rest):\n"
        "    if name == 'numpy': os.kill(os.getpid(), signal.SIGINT)\n"
        "    return plain(name, *rest)\n"
        "builtins.__import__ = interrupted\n"
        "sys.argv = ['panelsim', '--version']\n"
        "main()\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "interrupted\n")


# ---------------------------------------------------------------- new, check


@pytest.mark.parametrize("name", bundled_hull_names())
def test_new_then_check_for_every_bundled_hull(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert call("new", f"{name}_2.5", "--ship", name).code == 0
    result = call("check", f"{name}_2.5.toml")  # the dot of 2.5 begins no suffix
    assert result.code == 0
    if name in NOT_UPRIGHT:
        assert "warning: The transverse metacentric height is -" in result.err
        assert "see the warnings" in result.out
    else:
        assert result.err == ""
        assert "The case is sound." in result.out


def test_new_refuses_a_file_that_is_there_and_a_name_that_is_none(call: Call, tmp_path: Path) -> None:
    assert call("new", tmp_path / "mine").code == 0
    (tmp_path / "mine.toml").write_text("kept")
    refused(call("new", tmp_path / "mine"), "exists already")
    refused(call("new", tmp_path / "mine.toml"), "exists already")
    assert (tmp_path / "mine.toml").read_text() == "kept"
    refused(call("new", ""), "no name")
    refused(call("new", tmp_path / "other", "--ship", "halifx"), "did you mean halifax?")


def test_new_for_a_hull_folder_names_the_folder_not_the_bundled_hull(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for place in ('my "hulls"/halifax', "halifax"):
        shutil.copytree(hull_folder("box"), tmp_path / place)
    for ship, entry in (
        ('my "hulls"/halifax', r'"./my \"hulls\"/halifax"'),
        ("./halifax", '"./halifax"'),  # "halifax" alone is the bundled hull
        ("halifax", '"halifax"'),
    ):
        assert call("new", "cases/mine", "--ship", ship).code == 0
        written = tmp_path / "cases" / "mine.toml"
        expected = entry.replace('"./', '"../', 1)
        assert f"hull = {expected}\n" in written.read_text()
        length = json.loads(call("hull", written, "--json").out)["waterline_length"]
        assert (length > 100) == (ship == "halifax")  # the box is 50 m long
        written.unlink()
    assert call("new", "here", "--ship", "./halifax").code == 0
    assert 'hull = "./halifax"\n' in (tmp_path / "here.toml").read_text()


def test_new_refuses_a_hull_folder_that_no_case_file_can_name(call: Call, tmp_path: Path) -> None:
    folder = tmp_path / os.fsdecode(b"hull\xff")
    shutil.copytree(hull_folder("box"), folder)
    refused(call("new", tmp_path / "mine", "--ship", folder), "not UTF-8", "rename")
    assert not (tmp_path / "mine.toml").exists()


def test_new_says_what_to_type_next(call: Call, tmp_path: Path) -> None:
    said = call("new", tmp_path / "my case").out
    assert shlex.quote(str(tmp_path / "my case.toml")) in said


def test_check_tells_ship_sea_and_run_on_80_columns(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    result = call("check", EXAMPLE)
    assert result.code == 0
    assert max(map(len, result.out.splitlines())) <= 80
    text = " ".join(result.out.split())
    # 346 s is the measured repeat of the report's 0.1 rad/s grid at 20 knots and 150°.
    run = "4650 exponential steps of 0.4 s"
    for words in ("it repeats after 346 s", "heading 150°", "roll 2e+07", run, "seed 1001"):
        assert words in text


def test_check_refuses_a_bad_case_and_runs_nothing(call: Call, tmp_path: Path) -> None:
    refused(call("check", EXAMPLE, "--set", "seaway.sead=7"), "did you mean seaway.seed?")
    refused(call("check", tmp_path), "is a folder")
    refused(call("check", tmp_path / "none.toml"), "no such case file")


MESH_OPTIONS = ("--length-unit", "m", "--up", "z", "--forward", "x")


def test_check_of_a_mesh_needs_its_unit_and_axes(call: Call, tmp_path: Path, barge: Ship) -> None:
    path = tmp_path / "barge.stl"
    barge.mesh.export(path)
    for left_out in range(0, 6, 2):
        given = MESH_OPTIONS[:left_out] + MESH_OPTIONS[left_out + 2 :]
        refused(call("check", path, *given), "unit and axes", "--length-unit m --up z --forward x")
    sound = call("check", path, *MESH_OPTIONS)
    assert sound.code == 0
    assert "length 20 m" in sound.out
    assert "closed: yes" in sound.out


def test_check_refuses_what_it_would_have_to_ignore(call: Call, tmp_path: Path, barge: Ship) -> None:
    path = tmp_path / "barge.stl"
    barge.mesh.export(path)
    for wave_length in ("-5", "0", "nan", "inf"):
        refused(call("check", path, *MESH_OPTIONS, "--wave-length", wave_length), "wave length")
    refused(call("check", path, *MESH_OPTIONS, "--set", "seaway.seed=7"), "seaway.seed=7")
    refused(call("check", EXAMPLE, "--up", "z"), "mesh", "--up")
    refused(call("check", tmp_path / "hull.igs"), ".stl", ".gdf", ".toml")


def test_check_of_an_open_or_inward_mesh_ends_with_2(call: Call, tmp_path: Path, barge: Ship) -> None:
    mesh = barge.mesh
    faulty = {
        "hole": (PanelMesh(mesh.vertices, mesh.panels[1:]), "hole"),
        "inward": (PanelMesh(mesh.vertices, mesh.panels[:, ::-1]), "inside out"),
    }
    for name, (each, word) in faulty.items():
        each.export(tmp_path / f"{name}.obj")
        result = call("check", tmp_path / f"{name}.obj", *MESH_OPTIONS)
        refused(result, "not a sound hull", word)
        assert "problem: " in result.out


# ---------------------------------------------------------------- run


def test_a_run_leaves_its_files_and_says_where_on_80_columns(
    finished: tuple[Path, subprocess.CompletedProcess[str]],
) -> None:
    folder, process = finished
    assert (process.returncode, process.stderr) == (0, "")
    assert {path.name for path in folder.iterdir()} == RUN_FILES | PICTURES
    table = [line for line in process.stdout.splitlines() if "│" in line]
    assert len(table) == 7  # six motions and the wave
    assert "[s]" in process.stdout
    assert max(map(len, table)) <= 80
    text = " ".join(process.stdout.split())
    for words in (
        "times faster than real time",
        "recording ",
        f"Files in {folder}",
        "To watch: panelsim view",
    ):
        assert words in text


def test_the_statistics_table_has_no_minus_zero_and_keeps_its_units(
    finished: tuple[Path, subprocess.CompletedProcess[str]],
) -> None:
    found = statistics(History.load(finished[0] / "history.nc"))
    tiny = replace(found.wave_elevation, mean=-1e-5)
    markdown = statistics_markdown(replace(found, wave_elevation=tiny))
    assert "| wave elevation | m | 0.000 |" in markdown
    assert "-0.000" not in markdown
    written = StringIO()
    console = Console(file=written, width=120)  # one that reads markup, as a user's does
    console.print(statistics_table(found))
    assert "[s]" in written.getvalue()


def test_statistics_json_has_units_in_its_keys(
    finished: tuple[Path, subprocess.CompletedProcess[str]],
) -> None:
    found = json.loads((finished[0] / "statistics.json").read_text())
    assert {"mean_deg", "rms_deg", "max_deg", "min_deg", "zero_crossing_period_s"} <= found["roll"].keys()
    assert found["heave"]["rms_m"] > 0
    assert found["realtime_factor"] > 0
    assert (found["outcome"], found["simulated_seconds"]) == ("finished", pytest.approx(25.2))


def test_the_history_keeps_the_resolved_case(
    finished: tuple[Path, subprocess.CompletedProcess[str]],
) -> None:
    history = History.load(finished[0] / "history.nc")
    case = json.loads(history.attrs["case"])
    assert case["run"]["duration"] == 20
    assert case["supplementary"]["damping"] == {"surge": 1e6, "sway": 2e6, "roll": 2e7}
    assert history.attrs["seed"] == 1001


def test_an_occupied_folder_is_refused_before_anything_is_computed(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_ship(_: object) -> None:
        raise AssertionError("the ship was built")

    monkeypatch.setattr("panelsim.case.Case.ship", property(no_ship))
    (tmp_path / "notes.txt").write_text("mine")
    refused(call("run", EXAMPLE, "--out", tmp_path, *QUICK), "not empty", "--force")
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_force_replaces_only_what_panelsim_writes(call: Call, tmp_path: Path) -> None:
    mine = {"notes.txt": "mine", "motions.csv": "of an older run", "history.nc": "of an older run"}
    for name, text in mine.items():
        (tmp_path / name).write_text(text)
    result = call("run", EXAMPLE, "--out", tmp_path, "--force", *QUICK, "--set", "seaway.seed=7")
    assert (result.code, result.err) == (0, "")
    assert (tmp_path / "notes.txt").read_text() == "mine"
    assert {path.name for path in tmp_path.iterdir()} == RUN_FILES | PICTURES | {"notes.txt"}
    history = History.load(tmp_path / "history.nc")
    assert history.attrs["seed"] == 7
    assert np.array_equal(history.components.phase, np.random.default_rng(7).uniform(0, 2 * np.pi, 19))


@pytest.mark.parametrize(("place", "word"), [("file", "is a file"), ("file/below", "cannot be written")])
def test_a_folder_that_cannot_be_written_is_refused(
    call: Call, tmp_path: Path, place: str, word: str
) -> None:
    (tmp_path / "file").write_text("kept")
    refused(call("run", EXAMPLE, "--out", tmp_path / place, *QUICK), word)
    assert (tmp_path / "file").read_text() == "kept"


def test_a_refused_case_leaves_no_folder(call: Call, tmp_path: Path) -> None:
    refused(call("run", EXAMPLE, "--out", tmp_path / "run", "--set", "ship.hull=halifx"), "halifax?")
    refused(call("run", EXAMPLE, "--out", tmp_path / "run", "--set", "seaway.peak_period=4"), "steeper")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    ("file", "words"),
    [
        ("other.nc", ["computed for another ship than halifax"]),
        ("short.nc", ["cannot be read", "cut short"]),
        ("text.nc", ["cannot be read", "not NetCDF-4"]),
        ("none.nc", ["no hydrodynamic database here"]),
    ],
)
def test_a_database_that_does_not_serve_is_refused(
    call: Call, tmp_path: Path, file: str, words: list[str]
) -> None:
    stored = (hull_folder("box") / "hydro.nc").read_bytes()
    (tmp_path / "other.nc").write_bytes(stored)
    (tmp_path / "short.nc").write_bytes(stored[: len(stored) // 2])
    (tmp_path / "text.nc").write_text("no database")
    result = call(
        "run", EXAMPLE, "--out", tmp_path / "run", *QUICK, "--set", f"hydrodynamics.file={tmp_path / file}"
    )
    refused(result, *words)


@pytest.mark.parametrize(
    ("override", "outcome", "cause"),
    [
        ("run.capsize_angle_deg=0.1", "capsized", "roll"),
        ("supplementary.stiffness.yaw=0", "diverged", "broached"),
    ],
)
def test_a_run_that_ends_early_keeps_its_files_and_ends_with_3(
    call: Call, tmp_path: Path, override: str, outcome: str, cause: str
) -> None:
    quick = [*QUICK[:2], "--set", "run.duration=100", "--set", "run.ramp=5"]
    overrides = [word for each in override.split() for word in ("--set", each)]
    result = call("run", EXAMPLE, "--out", tmp_path / "run", *quick, *overrides)
    assert result.code == 3
    assert result.err.startswith(f"The run ended early: {outcome}, ")
    assert cause in result.err
    assert {path.name for path in (tmp_path / "run").iterdir()} == RUN_FILES | PICTURES
    assert History.load(tmp_path / "run" / "history.nc").outcome == outcome
    assert json.loads((tmp_path / "run" / "statistics.json").read_text())["outcome"] == outcome


def interrupt_during(
    monkeypatch: pytest.MonkeyPatch, stage: str, number: signal.Signals = signal.SIGINT
) -> None:
    """Send this process a real signal when the progress of a stage is first told."""

    @contextmanager
    def bars() -> Iterator[Callable[[str], Callable[[float, float], None]]]:
        def track(label: str) -> Callable[[float, float], None]:
            def update(done: float, total: float) -> None:
                if label == stage:
                    signal.raise_signal(number)  # to this thread, which listens

            return update

        yield track

    for module in (commands, hydro):
        monkeypatch.setattr(module, "progress_bars", bars)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_during_the_run_keeps_what_was_computed(
    number: signal.Signals, call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C, and the signal by which a batch queue ends a run."""
    interrupt_during(monkeypatch, "run", number)
    result = call("run", EXAMPLE, "--out", tmp_path / "run", *QUICK, "--set", "run.duration=5000")
    assert result.code == 3
    assert "interrupted, stopped by the user" in result.err
    history = History.load(tmp_path / "run" / "history.nc")
    assert history.outcome == "interrupted"
    assert 1 <= len(history.time) < 100
    assert {path.name for path in (tmp_path / "run").iterdir()} == RUN_FILES | PICTURES


def test_an_interrupt_during_the_coefficients_ends_with_one_line(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, small_case: Path
) -> None:
    interrupt_during(monkeypatch, "hydrodynamic coefficients")
    monkeypatch.setenv("PANELSIM_CACHE", str(tmp_path / "cache"))
    result = call("run", small_case, "--out", tmp_path / "run")
    assert (result.code, result.err) == (130, "interrupted\n")
    assert not (tmp_path / "run").exists()  # nothing was written to it
    result = call("hydro", small_case, "-o", tmp_path / "hydro.nc")
    assert (result.code, result.err) == (130, "interrupted\n")
    assert not (tmp_path / "hydro.nc").exists()


@pytest.mark.slow
@pytest.mark.parametrize("name", [n for n in bundled_hull_names() if n not in NOT_UPRIGHT])
def test_new_then_run_for_every_hull_that_floats_upright(call: Call, tmp_path: Path, name: str) -> None:
    case = tmp_path / f"{name}.toml"
    assert call("new", case, "--ship", name).code == 0
    assert call("run", case, "--out", tmp_path / "run", "--set", "run.duration=20").code == 0
    heave = json.loads((tmp_path / "run" / "statistics.json").read_text())["heave"]
    assert heave["rms_m"] > 0


# ---------------------------------------------------------------- hull, hydro, export, view


def test_hull_json_names_what_others_read(call: Call) -> None:
    facts: dict[str, Any] = json.loads(call("hull", "s175", "--json").out)
    assert {
        *("panels_wet", "panels_total", "displaced_volume", "mass", "center_of_buoyancy", "waterplane_area"),
        *("gm_transverse", "gm_longitudinal", "published"),
    } <= facts.keys()
    assert facts["mass"] == pytest.approx(1025 * facts["displaced_volume"], rel=1e-12)
    published = facts["published"]
    # Within 1.2 % of the published ship: what its offsets leave open at bow and stern.
    for name in ("mass", "center_of_buoyancy_x", "center_of_buoyancy_z", "gm_transverse", "gm_longitudinal"):
        entry = published[name]
        assert entry["here"] - entry["published"] == pytest.approx(entry["difference"])
        assert abs(entry["relative_difference"]) < 0.012, name
    assert published["mass"]["here"] == facts["mass"]


def test_hull_says_what_it_cannot_compare(call: Call) -> None:
    facts = json.loads(call("hull", "frigate", "--json", "--panel-area", 20).out)
    roll = facts["published"]["natural_roll_period"]
    assert (roll["published"], roll["here"], roll["difference"]) == (9.1, None, None)
    assert "not compared" in call("hull", "frigate", "--panel-area", 20).out


def test_published_values_are_not_set_beside_another_loading(call: Call) -> None:
    at_another_draft = ["--set", "ship.draft=5.2", "--set", "ship.panel_area=20"]
    assert "published" not in call("check", EXAMPLE, *at_another_draft).out
    assert "published" in call("check", EXAMPLE, *at_another_draft[2:]).out


@pytest.mark.parametrize("name", NOT_UPRIGHT)
def test_hull_warns_of_a_ship_that_does_not_float_upright(call: Call, name: str) -> None:
    result = call("hull", name)
    assert result.code == 0
    assert "transverse metacentric height is -" in result.err
    assert len(json.loads(call("hull", name, "--json").out)["warnings"]) == 1


def test_hull_takes_a_case_file_and_a_hull_folder(call: Call, small_case: Path) -> None:
    assert json.loads(call("hull", small_case, "--json").out)["panels_total"] > 6
    folder = hull_folder("box")
    for what in (folder, folder / "particulars.toml"):
        assert json.loads(call("hull", what, "--json").out)["draft"] == 2.0
    coarse = json.loads(call("hull", EXAMPLE, "--json", "--panel-area", 40).out)
    assert coarse["panels_total"] < 400


def test_hull_exports_its_mesh_and_refuses_what_it_cannot(call: Call, tmp_path: Path) -> None:
    assert call("hull", "box", "--panel-area", 5, "--export", tmp_path / "box.stl").code == 0
    assert "volume 1000 m3" in call("check", tmp_path / "box.stl", *MESH_OPTIONS).out
    refused(call("hull", "box", "--export", tmp_path / "box.step"), ".stl")
    refused(call("hull", tmp_path / "box.stl"), "does not say how the ship floats", "[ship.mesh]")
    refused(call("hull", "halifx"), "did you mean halifax?")
    for area in ("1e9", "1e-9", "-1", "nan"):
        result = call("hull", "halifax", "--panel-area", area)
        refused(result, "panel area")
        assert result.out == ""


def test_an_exported_mesh_replaces_a_file_only_by_force(call: Call, tmp_path: Path) -> None:
    path = tmp_path / "box.obj"
    path.write_text("kept")
    result = call("hull", "box", "--panel-area", 20, "--export", path)
    refused(result, "exists already", "--force")
    assert (result.out, path.read_text()) == ("", "kept")
    refused(call("hull", "box", "--export", tmp_path / "none" / "box.obj"), "no such folder")
    assert call("hull", "box", "--panel-area", 20, "--export", path, "--force").code == 0
    assert path.read_text() != "kept"
    assert list(tmp_path.iterdir()) == [path]


def test_small_ships_weigh_kilograms_and_points_lie_forward_or_aft(call: Call) -> None:
    sphere = call("hull", "sphere", "--panel-area", 2).out
    wigley, frigate = call("hull", "wigley_iii").out, call("hull", "frigate", "--panel-area", 20).out
    assert re.search(r"mass +\d+\.?\d* kg in water", wigley)
    assert re.search(r"mass +\d+\.?\d* t in water", frigate)
    assert re.search(r"mass in t +\d+", frigate)
    assert re.search(r"\d m aft of midships", frigate)
    assert "at midships" in sphere
    for text in (sphere, wigley, frigate):
        assert "center" not in text
        assert not re.search(r"-0(\.0*)?(?![.\d])", text)
        assert not re.search(r"-[\d.]+ m (forward|aft|above|below)", text)


def test_hydro_refuses_before_it_computes(call: Call, tmp_path: Path) -> None:
    (tmp_path / "there.nc").write_text("kept")
    refused(call("hydro", "halifax", "-o", tmp_path / "there.nc"), "exists already", "--force")
    refused(call("hydro", "halifax", "-o", tmp_path), "a file name in .nc")
    (tmp_path / "folder.nc").mkdir()
    refused(call("hydro", "halifax", "-o", tmp_path / "folder.nc"), "is a folder")
    refused(call("hydro", "halifax", "-o", tmp_path / "there.nc" / "x.nc"), "cannot be written")
    refused(call("hydro", "halifax", "-o", tmp_path / "new.nc", "--method", "slender"), "slender", "bem")
    assert (tmp_path / "there.nc").read_text() == "kept"


def test_a_computed_database_serves_the_run(call: Call, tmp_path: Path, small_case: Path) -> None:
    database = tmp_path / "hydro.nc"
    assert call("hydro", small_case, "-o", database).code == 0
    result = call("check", small_case, "--set", f"hydrodynamics.file={database}")
    assert result.code == 0
    assert "frequencies" in result.out


def test_export_writes_the_history_as_csv(
    call: Call, finished: tuple[Path, subprocess.CompletedProcess[str]], tmp_path: Path
) -> None:
    (tmp_path / "history.nc").write_bytes((finished[0] / "history.nc").read_bytes())
    refused(call("export", tmp_path), "--csv")
    assert call("export", tmp_path, "--csv").code == 0
    written = (tmp_path / "motions.csv").read_bytes()
    (tmp_path / "motions.csv").unlink()
    refused(call("export", tmp_path, "--csv"), "loads.csv", "exists already", "--force")
    assert not (tmp_path / "motions.csv").exists()
    assert call("export", tmp_path / "history.nc", "--csv", "--force").code == 0
    assert (tmp_path / "motions.csv").read_bytes() == written
    motions = np.loadtxt(tmp_path / "motions.csv", delimiter=",", skiprows=1)
    assert np.array_equal(motions[:, 0], History.load(tmp_path / "history.nc").time)
    assert (tmp_path / "loads.csv").is_file()
    refused(call("export", tmp_path / "none", "--csv"), "no such history file")
    (tmp_path / "history.nc").write_text("no history")
    refused(call("export", tmp_path, "--csv", "--force"), "damaged or of another kind")
    assert (tmp_path / "motions.csv").read_bytes() == written


def test_view_opens_recordings_and_refuses_others(
    call: Call,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    finished: tuple[Path, subprocess.CompletedProcess[str]],
) -> None:
    opened: list[Path] = []

    def open_viewer(recordings: list[Path]) -> int:
        opened.extend(recordings)
        return 5

    monkeypatch.setattr("panelsim.view.viewer.open_viewer", open_viewer)
    first, second = tmp_path / "a.rrd", tmp_path / "b.rrd"
    recording = (finished[0] / "run.rrd").read_bytes()
    first.write_bytes(recording)
    refused(call("view", first, second), "no such recording")
    second.write_bytes(recording[: len(recording) // 2])
    refused(call("view", first, second), "cut short", "b.rrd")
    for content in (b"", b"garbage", b"no recording, but longer than a footer"):
        second.write_bytes(content)
        refused(call("view", first, second), "not a recording", "b.rrd")
    assert opened == []
    second.write_bytes(recording)
    assert call("view", first, second).code == 5  # the viewer's own exit code
    assert opened == [first, second]


@pytest.fixture
def small_case(tmp_path: Path) -> Path:
    """A box of 96 panels from a mesh file, in calm water: its coefficients take a second."""
    box = load_hull("box").panel(8.0)
    box.export(tmp_path / "box.obj")
    path = tmp_path / "small.toml"
    path.write_text(
        """
[ship]
hull = "box.obj"
draft = 2.0
center_of_gravity_height = 2.0
gyradius_roll = 3.2
gyradius_pitch = 6.0
gyradius_yaw = 6.5
water_density = 1025.0
mesh = { length_unit = "m", up = "z", forward = "x" }
[seaway]
kind = "calm"
[run]
speed_knots = 0
time_step = 0.1
duration = 5
"""
    )
    return path
