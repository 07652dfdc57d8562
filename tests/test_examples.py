"""Every example runs, and gives the numbers that it is read for."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from panelsim.motion.history import History
from panelsim.results.statistics import statistics

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"


def load_example(name: str) -> ModuleType:
    """Import an example as a module; what it does at import is done."""
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run_case(example: str, folder: Path, *overrides: str) -> None:
    """`panelsim run` on an example, as a user would, with overrides such as "run.duration=20"."""
    panelsim = Path(sys.executable).parent / "panelsim"
    options = [word for override in overrides for word in ("--set", override)]
    process = subprocess.run(
        [panelsim, "run", EXAMPLES / example, "--out", folder, *options],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert process.returncode == 0, process.stderr


def test_each_example_has_its_test() -> None:
    names = {path.name for path in EXAMPLES.iterdir() if path.suffix in (".py", ".toml")}
    assert names == {
        *("quickstart.py", "own_mesh.py", "own_mesh.toml", "halifax_sea_state_7.toml"),
        *("seas.py", "short_crested_sea.toml", "recorded_sea.py", "recorded_sea.toml"),
        "batch.py",
    }


def test_quickstart_gives_motions_of_a_frigate_in_sea_state_7() -> None:
    quickstart = load_example("quickstart")
    assert quickstart.history.outcome == "finished"
    waves = quickstart.sea.components
    slope = np.sqrt(0.5 * np.sum((waves.amplitude * waves.wavenumber()) ** 2))
    # A ship follows waves much longer than itself in heave and in slope and evens out shorter ones; this
    # sea has both, and 20 knots against it bring the ship near its resonance in heave.
    assert 0.6 < quickstart.motions["heave"].rms / np.sqrt(waves.variance) < 1.2
    assert 0.3 < quickstart.motions["pitch"].rms / slope < 1.0


def test_the_readme_shows_the_lines_of_quickstart() -> None:
    script = (EXAMPLES / "quickstart.py").read_text(encoding="utf-8")
    code = script[script.index("import numpy") :]
    assert code.strip() in (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_case_of_the_report_runs_with_every_file(tmp_path: Path) -> None:
    run_case("halifax_sea_state_7.toml", tmp_path, "run.duration=20", "run.ramp=10")
    found = json.loads((tmp_path / "statistics.json").read_text())
    assert (found["outcome"], found["duration_s"]) == ("finished", 20.0)
    assert (tmp_path / "run.rrd").stat().st_size > 0


@pytest.mark.slow
def test_script_and_case_file_take_an_own_mesh_the_whole_way_to_the_same_motions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own_mesh = load_example("own_mesh")
    by_script = own_mesh.main(tmp_path / "script")
    assert (
        "closed: yes   normals outward: yes   symmetric about the centreline: yes" in capsys.readouterr().out
    )
    assert by_script.outcome == "finished"
    motions = statistics(by_script).motions
    # Head waves: a symmetric ship stays in its plane but for the rounding of the mesh file (1e-6 m).
    assert motions["heave"].rms > 0.1
    assert motions["roll"].rms < 1e-4
    left = tmp_path / "script"
    run_case(
        "own_mesh.toml",
        tmp_path / "case",
        f"ship.hull={left / 'hull.stl'}",
        f"hydrodynamics.file={left / 'hydro.nc'}",
        # The case file rounds the frequency of the wave that is as long as the hull.
        f"seaway.wave_frequency={by_script.components.frequency[0]}",
    )
    by_case = History.load(tmp_path / "case" / "history.nc")
    # The stored potentials are single precision, 6e-8 of the largest; the wave amplitude is 0.5 m.
    assert np.abs(by_case.displacement - by_script.displacement).max() < 1e-6


def test_a_ship_that_turns_stays_in_the_same_sea() -> None:
    seas = load_example("seas")
    before, after = seas.at_the_turn
    assert abs(before - after) < 1e-9  # rounding of phases of some hundred radians
    # JONSWAP with γ 3.3: T1 = 0.8343 T_p and T_z = 0.7774 T_p.
    assert seas.periods == pytest.approx((8.343, 7.774), abs=2e-3)


def test_a_batch_tells_the_heading_from_chance() -> None:
    batch = load_example("batch")
    assert {history.outcome for history in batch.histories} == {"finished"}
    assert [history.attrs["seed"] for history in batch.histories] == 3 * [1, 2, 3, 4]
    by_heading = batch.roll.mean(axis=1)
    # The nearer to the beam, the more she rolls, by more than the seeds scatter; that is a fifth or so.
    assert (np.diff(by_heading) > batch.roll.std(axis=1, ddof=1)[:-1]).all()
    assert by_heading[-1] > 2.0 * by_heading[0]


def test_a_short_crested_sea_runs(tmp_path: Path) -> None:
    run_case("short_crested_sea.toml", tmp_path, "run.duration=20", "run.ramp=10")
    found = json.loads((tmp_path / "statistics.json").read_text())
    assert found["outcome"] == "finished"


def test_a_recorded_sea_gives_the_record_back_and_carries_a_ship(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sea = load_example("recorded_sea").main(tmp_path / "record")
    assert "waves hold 99." in capsys.readouterr().out
    # The noise of the made-up instrument is 0.01 m; the band keeps a third of it and leaves the rest out.
    error = sea.in_fixed_axes().elevation(0.0, 0.0, sea.record.time) - sea.record.elevation
    assert error.std() < 0.02
    buoy = tmp_path / "record" / "buoy.csv"
    run_case("recorded_sea.toml", tmp_path / "run", f"seaway.file={buoy}", "run.duration=20", "run.ramp=10")
    history = History.load(tmp_path / "run" / "history.nc")
    assert history.outcome == "finished"
    # What the case makes of the file is what the script makes of it, here as a moving ship meets it.
    moving = sea.in_translating_axes(history.attrs["speed"]).elevation(0.0, 0.0, history.time[-1])
    assert history.wave_elevation[-1] == pytest.approx(float(moving), abs=1e-9)
