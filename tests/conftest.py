"""A made-up run of a box barge, for tests of everything that reads a history, and real runs of a frigate."""

import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import rerun_cli
from hypothesis import settings
from matplotlib.figure import Figure

from panelsim.cli import main
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.store import database_for
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.simulate import simulate
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.seaways import CalmSeaway, Seaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

# How long an example takes is the machine's affair: one that others share stops for a while now and then.
settings.register_profile("panelsim", deadline=None)
settings.load_profile("panelsim")

SPEED = 5.0
AMPLITUDE = np.array([0.5, 0.3, 1.2, 0.08, 0.04, 0.02])  # m and rad
MEAN = np.array([0.2, -0.1, 0.3, 0.01, -0.02, 0.0])
FREQUENCY = 2.0 * np.pi / 8.0  # rad/s


@pytest.fixture(scope="session")
def barge() -> Ship:
    """A box 20 m by 6 m by 4 m, draft 2 m, KG 1.5 m."""
    corners = [(x, y, z) for z in (0.0, 4.0) for x, y in ((-10, -3), (10, -3), (10, 3), (-10, 3))]
    panels = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    return Ship(
        PanelMesh(np.array(corners, dtype=float), np.array(panels)),
        draft=2.0,
        center_of_gravity=(None, 0.0, 1.5),
        gyradii=(2.0, 5.0, 5.0),
        name="barge",
    )


@pytest.fixture(scope="session")
def make_history(barge: Ship) -> Callable[..., History]:
    """A maker of histories: sinusoidal motions about a mean with a period of 8 s, loads that sum to M η̈.

    Any argument of `History.build` may be given instead, and `duration` and `step` [s].
    """

    def make(*, duration: float = 60.0, step: float = 0.25, **given: Any) -> History:
        time = step * np.arange(round(duration / step) + 1)
        phase = FREQUENCY * time[:, None] + np.arange(6.0)
        displacement = MEAN + AMPLITUDE * np.cos(phase)
        acceleration = -(FREQUENCY**2) * AMPLITUDE * np.cos(phase)
        weight = np.zeros((len(time), 6))
        weight[:, 2] = -barge.mass * barge.gravity
        values: dict[str, Any] = {
            "time": time,
            "displacement": displacement,
            "velocity": -FREQUENCY * AMPLITUDE * np.sin(phase),
            "acceleration": acceleration,
            "wave_elevation": 0.9 * np.sin(FREQUENCY * time),
            "loads": {"weight": weight, "wetted_surface": acceleration @ barge.inertia - weight},
            "ship": barge,
            "components": WaveComponents(
                np.array([0.9, 0.4]), np.array([0.8, 1.3]), np.array([2.4, 1.2]), np.array([0.3, 2.0])
            ),
            "seaway_kind": "random",
            "stretching": "wheeler",
            "speed": SPEED,
            "ramp": 12.0,
            "time_step": step,
            "model": "nonlinear",
            "outcome": "finished",
            "case": '{"ship": {"hull": "barge"}}',
            "seed": 7,
            "cpu_seconds": 0.5,
            "jit_seconds": 3.0,
            "notes": ["The sea repeats itself after 346 s."],
        }
        return History.build(**(values | given))

    return make


@pytest.fixture(scope="session")
def halifax() -> Ship:
    """The ship of TM 2003-190 Table 2 on its medium mesh."""
    return load_ship("halifax", 2.5)


@pytest.fixture(scope="session")
def halifax_database(halifax: Ship) -> HydroDatabase:
    """Its coefficients, bundled or from the cache."""
    return database_for(halifax)


@pytest.fixture(scope="session")
def springs(halifax: Ship) -> Supplementary:
    """Springs and dampers of TM 2003-190 section 8, as the particulars of the hull have them."""
    assert halifax.form is not None
    return Supplementary(**halifax.form.supplementary)


@pytest.fixture(scope="session")
def run_halifax(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> Callable[..., History]:
    """A runner of short runs from rest without ramp, dt 0.2 s, at zero speed, with springs.

    Any argument of `simulate` may be given instead; a seaway may be plain `WaveComponents`.
    """

    def run(seaway: Seaway | WaveComponents | None = None, **given: Any) -> History:
        if isinstance(seaway, WaveComponents):
            seaway = SimpleNamespace(kind="regular", components=seaway)
        defaults = {
            "speed": 0.0,
            "duration": 60.0,
            "time_step": 0.2,
            "ramp": 0.0,
            "database": halifax_database,
            "supplementary": springs,
        }
        return simulate(halifax, CalmSeaway() if seaway is None else seaway, **(defaults | given))

    return run


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """The figures that were saved."""
    figures: list[Figure] = []
    save = Figure.savefig

    def keep(self: Figure, *args: Any, **kwargs: Any) -> None:
        figures.append(self)
        save(self, *args, **kwargs)

    monkeypatch.setattr(Figure, "savefig", keep)
    return figures


@pytest.fixture
def panelsim(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> Callable[..., tuple[int, str, str]]:
    """Call `panelsim` with these arguments in a folder of its own: exit code, output, errors."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")

    def called(*arguments: object) -> tuple[int, str, str]:
        capsys.readouterr()
        monkeypatch.setattr(sys, "argv", ["panelsim", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return int(ended.value.code or 0), out, err

    return called


@pytest.fixture
def seen(tmp_path: Path) -> Callable[..., tuple[bytes, Any]]:
    """Look at a recording in a viewer without a window: a PNG picture, and the state of the viewer.

    With a timeline and a time [s] on it, that moment is looked at.
    """
    from rerun.experimental import ViewerClient

    def look(recording: Path, timeline: str | None = None, at: float = 0.0) -> tuple[bytes, Any]:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        home = {name: str(tmp_path) for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR")}
        binary = Path(rerun_cli.__file__).parent / "rerun"
        command = [binary, "--headless", "--bind", "127.0.0.1", "--port", str(port), "--hide-welcome-screen"]
        viewer = subprocess.Popen(command, env=os.environ | home | {"CI": "1"}, stderr=subprocess.DEVNULL)
        try:
            client = _connected(ViewerClient, f"rerun+http://127.0.0.1:{port}/proxy", viewer)
            client.open(str(recording))
            return _settled(client, timeline, at), client.get_state()
        finally:
            viewer.terminate()
            viewer.wait(10)

    return look


def _connected(client_class: Any, url: str, viewer: subprocess.Popen) -> Any:
    for _ in range(100):
        if viewer.poll() is not None:
            pytest.skip(f"the viewer ended with {viewer.returncode}: no Vulkan driver?")
        try:
            client = client_class.connect(url)
            client.get_state()
            return client
        except Exception:  # the server is not up yet; its client says so in several ways
            time.sleep(0.2)
    pytest.fail("the viewer does not answer")


def _settled(client: Any, timeline: str | None, at: float) -> bytes:
    """The picture of the window once three in a row are equal: chunks are loaded lazily."""
    if timeline is not None:
        client.set_time(timeline, duration=at, play_state="paused")
    pictures: list[bytes] = []
    for _ in range(60):
        pictures.append(client.take_screenshot())
        if len(pictures) > 3 and pictures[-1] == pictures[-2] == pictures[-3]:
            break
        time.sleep(0.25)
    return pictures[-1]
