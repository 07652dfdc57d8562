"""A recording holds the history's motions at every step, and true pictures at some of them."""

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
import rerun_cli
from rerun.chunk import RrdReader
from scipy.spatial.transform import Rotation

from panelsim.conventions import DOF_NAMES, rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.motion.history import History
from panelsim.seaway.components import NO_WAVES
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.view import recording
from panelsim.view.frames import choose_frames, liveliest_window
from panelsim.view.recording import record, recording_id
from panelsim.view.surfaces import SeaGrid, hull_colors, pressure_head

MakeHistory = Callable[..., History]
RERUN = Path(rerun_cli.__file__).parent / "rerun"  # the binary: the script of that name only wraps it


@pytest.fixture(autouse=True)
def strict(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without it rerun drops bad data with a warning."""
    monkeypatch.setenv("RERUN_STRICT", "1")


def read(path: Path, entity: str, component: str, timeline: str = "sim_time") -> tuple[np.ndarray, list]:
    """Times [s] and values of a component, in the order of time."""
    times, values = [], []
    for chunk in RrdReader(path).stream():
        batch = chunk.to_record_batch()
        if str(chunk.entity_path) == entity and {component, timeline} <= set(batch.schema.names):
            times.append(batch[timeline].cast(pa.int64()).to_numpy())
            values += batch[component].to_pylist()
    order = np.argsort(np.concatenate(times), kind="stable")
    return 1e-9 * np.concatenate(times)[order], [values[i] for i in order]


@pytest.fixture(scope="module")
def run(make_history: MakeHistory) -> History:
    return make_history()


@pytest.fixture(scope="module")
def recorded(run: History, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(run, tmp_path_factory.mktemp("recording") / "new folder" / "run.rrd", frames=40).path


def test_the_file_is_whole(recorded: Path) -> None:
    done = subprocess.run([RERUN, "rrd", "verify", recorded], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert list(recorded.parent.iterdir()) == [recorded]
    assert len(RrdReader(recorded).blueprints()) == 1


def test_every_motion_is_there_at_every_step(run: History, recorded: Path) -> None:
    for dof, name in enumerate(DOF_NAMES):
        entity = f"/motions/{'linear' if dof < 3 else 'angular'}/{name}"
        times, values = read(recorded, entity, "Scalars:scalars")
        expected = run.displacement[:, dof] if dof < 3 else np.rad2deg(run.displacement[:, dof])
        np.testing.assert_allclose(times, run.time, atol=1e-9)  # rerun counts nanoseconds
        np.testing.assert_array_equal(np.concatenate(values), expected)
    _, values = read(recorded, "/waves/elevation", "Scalars:scalars")
    np.testing.assert_array_equal(np.concatenate(values), run.wave_elevation)
    entities = {str(path) for path in RrdReader(recorded).store().schema().entity_paths()}
    assert {"/world/ship/hull", "/world/sea", "/statistics", "/about"} <= entities
    assert "/loads/heave/wetted_surface" in entities
    assert "/loads/heave/weight" not in entities  # it never changes


def test_the_pose_turns_the_ship_as_the_motions_say(run: History, recorded: Path) -> None:
    rows, _ = choose_frames(run, 40)
    times, places = read(recorded, "/world/ship", "Transform3D:translation")
    _, turns = read(recorded, "/world/ship", "Transform3D:quaternion")
    np.testing.assert_allclose(times, run.time[rows], atol=1e-9)
    for row, place, turn in zip(rows, places, turns, strict=True):
        expected = run.mesh_vertices @ rotation_to_earth(*run.displacement[row, 3:]).T
        # single precision of the recording, 1e-7 of 10 m
        turned = run.mesh_vertices @ Rotation.from_quat(turn[0]).as_matrix().T
        np.testing.assert_allclose(turned, expected, atol=5e-6)
        np.testing.assert_allclose(place[0], run.displacement[row, :3], atol=5e-7)


def test_hull_and_sea_are_drawn_at_the_same_moments(run: History, recorded: Path) -> None:
    hull_times, colors = read(recorded, "/world/ship/hull", "Mesh3D:vertex_colors")
    sea_times, points = read(recorded, "/world/sea", "Mesh3D:vertex_positions")
    pose_times, _ = read(recorded, "/world/ship", "Transform3D:translation")
    np.testing.assert_array_equal(hull_times, sea_times)
    np.testing.assert_array_equal(hull_times, pose_times)
    assert len(hull_times) <= 40
    rows, _ = choose_frames(run, 40)
    sea = SeaGrid.around(run)
    for row, color, point in zip(rows, colors, points, strict=True):
        expected = hull_colors(run, pressure_head(run, row))[run.panels].ravel()
        np.testing.assert_array_equal(color, expected)
        np.testing.assert_allclose(point, sea.vertices(row, sea.elevation(row)), atol=5e-6)


def test_nothing_static_hides_what_changes(recorded: Path) -> None:
    static = {
        (str(chunk.entity_path), name)
        for chunk in RrdReader(recorded).stream()
        if chunk.is_static
        for name in chunk.to_record_batch().schema.names
    }
    assert ("/world/ship/hull", "Mesh3D:vertex_positions") in static
    changing = {
        ("/world/ship/hull", "Mesh3D:vertex_colors"),
        ("/world/sea", "Mesh3D:vertex_positions"),
        ("/world/sea", "Mesh3D:vertex_colors"),
        ("/motions/linear/heave", "Scalars:scalars"),
    }
    assert not static & changing


def test_the_film_timeline_holds_the_filmed_window_alone(make_history: MakeHistory, tmp_path: Path) -> None:
    history = make_history(duration=300.0)
    summary = record(history, tmp_path / "run.rrd", frames=40)
    times, _ = read(summary.path, "/motions/linear/heave", "Scalars:scalars", timeline="film")
    start, stop = summary.film
    within = history.time[(history.time >= start - 1e-9) & (history.time <= stop + 1e-9)]
    np.testing.assert_allclose(times, within, atol=1e-9)
    assert summary.frames <= 40
    assert summary.steps == 1201
    assert summary.file_bytes == summary.path.stat().st_size


def test_the_id_is_the_same_for_the_same_run_only(make_history: MakeHistory, tmp_path: Path) -> None:
    first, again = make_history(), make_history(cpu_seconds=9.0)
    assert recording_id(first) == recording_id(again)
    others = [make_history(case='{"ship": {}}'), make_history(duration=30.0)]
    assert len({recording_id(history) for history in (first, *others)}) == 3
    path = record(first, tmp_path / "run.rrd", frames=5).path
    store = RrdReader(path).recordings()[0]
    assert (store.application_id, store.recording_id) == ("panelsim", recording_id(first))


def test_an_old_recording_is_replaced_only_by_a_whole_one(
    run: History, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run.rrd"
    path.write_bytes(b"old")

    def fail(*_: object) -> None:
        raise MemoryError("no room")

    with monkeypatch.context() as patch:
        patch.setattr(recording, "send_sea", fail)
        with pytest.raises(MemoryError):
            record(run, path, frames=5)
    assert [p.read_bytes() for p in tmp_path.iterdir()] == [b"old"]
    record(run, path, frames=5)
    assert path.stat().st_size > 1000


def test_runs_cut_short_diverged_or_calm_can_be_watched(make_history: MakeHistory, tmp_path: Path) -> None:
    displacement = make_history().displacement.copy()
    displacement[100:] = np.nan
    histories = [
        make_history(duration=0.0, outcome="interrupted"),
        make_history(components=NO_WAVES, loads={}),
        make_history(displacement=displacement, outcome="diverged"),
    ]
    for history in histories:
        summary = record(history, tmp_path / "run.rrd", frames=10)
        assert summary.frames >= 1
        assert subprocess.run([RERUN, "rrd", "verify", summary.path], check=False).returncode == 0


def test_a_recording_without_pictures_is_refused(run: History, tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="1 frames"):
        record(run, tmp_path / "run.rrd", frames=1)


# --- which moments are drawn ---


def test_the_film_shows_the_steepest_slope_of_the_deck(make_history: MakeHistory) -> None:
    displacement = make_history(duration=600.0).displacement.copy()
    displacement[1500, 3] = -0.6  # t = 375 s, port side down
    displacement[10, 3] = 2.0  # within the ramp, where nothing counts yet
    history = make_history(duration=600.0, displacement=displacement)
    assert liveliest_window(history, 40.0) == (355.0, 395.0)
    rows, (start, stop) = choose_frames(history, 100)
    assert start < 375.0 < stop
    film = rows[(history.time[rows] >= start) & (history.time[rows] <= stop)]
    # Pictures every two steps, 0.5 s, nearest to the 0.4 s asked for; a stray one may fall between.
    assert np.isin(np.arange(film[0], film[-1] + 1, 2), rows).all()
    assert rows[0] == 0
    assert rows[-1] == 2400
    assert 95 <= len(rows) <= 100
    assert (np.diff(rows) > 0).all()


def test_the_end_of_a_capsize_is_filmed_whole(make_history: MakeHistory) -> None:
    displacement = make_history(duration=600.0).displacement.copy()
    displacement[-1, 3] = 1.6
    history = make_history(duration=600.0, displacement=displacement, outcome="capsized")
    rows, (_, stop) = choose_frames(history, 50)
    assert stop == history.time[-1]
    assert rows[-1] == len(history.time) - 1


def test_a_short_run_is_filmed_from_start_to_end(make_history: MakeHistory) -> None:
    history = make_history(duration=20.0)
    rows, film = choose_frames(history, 100)
    assert film == (0.0, 20.0)
    np.testing.assert_array_equal(rows, np.arange(0, 81, 2))


# --- what is drawn ---


@pytest.mark.parametrize("row", [8, 200])  # within the ramp and after it
def test_the_drawn_sea_is_the_sea_of_the_run(row: int, run: History) -> None:
    """Vertex for vertex against the plain sum over components, with the ship away from the origin."""
    sea = SeaGrid.around(run)
    x, y, z = sea.vertices(row, sea.elevation(row)).T
    t = run.time[row]
    grown = 0.5 * (1.0 - np.cos(np.pi * t / 12.0)) if t < 12.0 else 1.0
    expected = grown * TranslatingSeaway(run.components, 5.0, 9.80665).elevation(x, y, t)
    # round-off of angles up to 1e3 rad
    np.testing.assert_allclose(z - run.waterline, expected, atol=1e-11)
    assert x.max() - x.min() == pytest.approx(2 * 1.2 * 20.0)


def test_sea_triangles_face_up(run: History) -> None:
    sea = SeaGrid.around(run)
    points = sea.vertices(0, np.zeros((len(sea.line),) * 2))[sea.triangles]
    normals = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    assert (normals[:, 2] > 0.0).all()


def test_in_calm_water_the_pressure_head_is_the_depth(make_history: MakeHistory) -> None:
    """Rolled to starboard, bow down and sunk: the starboard fore foot lies deepest, the port deck is dry."""
    history = make_history(components=NO_WAVES)
    displacement = history.displacement.copy()
    displacement[5] = [3.0, -2.0, -0.4, 0.2, 0.1, 0.7]
    history = make_history(components=NO_WAVES, displacement=displacement)
    head = pressure_head(history, 5)
    # hull axes: 0 aft starboard keel, 1 fore starboard keel, 2 fore port keel, 3 aft port keel, 4.. deck
    x, y, z = history.mesh_vertices.T
    lowered = -np.sin(0.1) * x + np.cos(0.1) * (np.sin(0.2) * y + np.cos(0.2) * z) - 0.4
    np.testing.assert_allclose(head, np.maximum(0.5 - lowered, 0.0), atol=1e-12)
    assert head.argmax() == 1
    assert head[7] == 0.0


def test_colours_tell_wet_dry_and_bared_bottom_apart(run: History) -> None:
    keel, deck = 0, 4
    head = np.zeros(8)
    colors = hull_colors(run, head)
    red, blue = (colors >> np.uint32(shift) & 255 for shift in (24, 8))
    assert red[keel] > 2 * blue[keel]  # bottom out of the water
    assert abs(int(red[deck]) - int(blue[deck])) < 20  # grey topsides
    deeper = [hull_colors(run, np.full(8, depth))[keel] >> np.uint32(8) & 255 for depth in (0.1, 1.0, 2.9)]
    assert deeper[0] > deeper[1] > deeper[2]
    assert (colors & 255 == 255).all()


# --- what is seen ---


@pytest.mark.viewer
@pytest.mark.slow
def test_the_viewer_shows_it_without_complaint(recorded: Path, seen: Callable[..., Any]) -> None:
    picture, state = seen(recorded, "film", 30.0)
    assert state.recordings[0].current_timeline == "film"
    assert [report for view in state.views for report in view.reports] == []
    assert len({view.name for view in state.views}) == 12
    # A sea, a hull and curves: thousands of colours where an empty window has a few dozen.
    assert len(picture) > 50_000
