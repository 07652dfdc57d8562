"""Several runs as one rerun recording: motions and waves in the same plots, the ships side by side.

| entity | what | when |
|---|---|---|
| `motions/SIGNAL/RUN` [m, deg] | the six motions and the wave at the moving origin | every step |
| `differences/SIGNAL/RUN` [m, deg] | the same less the first run, where times agree | every step |
| `world/RUN/ship`, `world/RUN/ship/hull`, `world/RUN/sea` | as in the recording of a run | 3-D frames |
| `statistics`, `about` | Markdown | static |

Timelines: `sim_time` [s], and `film` of the window that the 3-D frames of the first run film. The ships stand
side by side from starboard to port in the order of the runs.
"""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from panelsim.conventions import FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.files import write_whole
from panelsim.motion.history import History
from panelsim.results.compared_tables import compared_markdown
from panelsim.results.statistics import display_unit, statistics
from panelsim.view.compared_blueprint import compared_blueprint
from panelsim.view.frames import choose_frames
from panelsim.view.recording import recording_id
from panelsim.view.ship_scene import send_hull, send_sea
from panelsim.view.study_histories import RUN_COLORS, SIGNALS
from panelsim.view.tape import Tape

if TYPE_CHECKING:
    import rerun as rr

APPLICATION_ID = "panelsim-comparison"
# 3-D frames of a run; each brings its sea, some 50 kB.
FRAMES = 60
# More ships side by side would be too small to see.
MOST_SHIPS = 4
# Ship lengths from the ship to the edge of its drawn sea, and from ship to ship.
REACH, SPACING = 0.7, 1.5


def compare_recordings(histories: Mapping[str, History], path: str | Path) -> Path:
    """Write two or more histories, by what they are called, as one .rrd file, whole or not at all.

    Up to four ships are drawn in 3-D, at the moments of the first one. Raises PanelsimError for one history.
    """
    if len(histories) < 2:
        raise PanelsimError("There is nothing to compare", got=f"{len(histories)} runs", allowed="2 or more")
    import rerun as rr

    path = Path(path)
    first = next(iter(histories.values()))
    rows, film = choose_frames(first, FRAMES)
    stream = rr.RecordingStream(APPLICATION_ID, recording_id=_comparison_id(histories))
    memory = stream.memory_recording()
    stream.send_recording_name(" against ".join(histories))
    tapes = {name: Tape(stream, run.time, film, counts_steps=False) for name, run in histories.items()}
    _send_curves(tapes, histories)
    compared = _send_differences(tapes, histories)
    drawn = len(histories) <= MOST_SHIPS
    if drawn:
        _send_ships(tapes, histories, first.time[rows])
    _send_texts(stream, histories, compared=compared, drawn=drawn)
    width = _spacing(histories) * len(histories)
    stream.send_blueprint(compared_blueprint(width=width if drawn else None, differences=bool(compared)))
    content = memory.drain_as_bytes()
    stream.disconnect()
    write_whole(path, content)
    return path


def _comparison_id(histories: Mapping[str, History]) -> str:
    digest = hashlib.sha256()
    for name, history in histories.items():
        digest.update(f"{name}\0{recording_id(history)}\0".encode())
    return f"{APPLICATION_ID}-{digest.hexdigest()[:24]}"


def _signals(history: History) -> dict[str, FloatArray]:
    """The six motions and the wave, (T,) each, in the units of `display_unit`."""
    values = [*history.displacement.T, history.wave_elevation]
    return {name: display_unit(name)[1] * value for name, value in zip(SIGNALS, values, strict=True)}


def _send_curves(tapes: Mapping[str, Tape], histories: Mapping[str, History]) -> None:
    for order, (name, history) in enumerate(histories.items()):
        for signal, values in _signals(history).items():
            _send_curve(tapes[name], f"motions/{signal}", name, order, values)


def _send_differences(tapes: Mapping[str, Tape], histories: Mapping[str, History]) -> list[str]:
    """Send what the runs are beyond the first one; returns those that have its times, as far as they go."""
    (_, first), *others = histories.items()
    compared = []
    for order, (name, history) in enumerate(others, 1):
        common = min(len(first.time), len(history.time))
        # Times are sums of steps: round-off apart.
        if not np.allclose(first.time[:common], history.time[:common], rtol=0.0, atol=1e-6):
            continue
        compared.append(name)
        reference = _signals(first)
        for signal, values in _signals(history).items():
            difference = values[:common] - reference[signal][:common]
            _send_curve(tapes[name], f"differences/{signal}", name, order, difference)
    return compared


def _send_curve(tape: Tape, entity: str, name: str, order: int, values: FloatArray) -> None:
    import rerun as rr

    unit = display_unit(entity.rpartition("/")[2])[0]
    path = f"{entity}/{rr.escape_entity_path_part(name)}"
    color = RUN_COLORS[order % len(RUN_COLORS)]
    tape.send_curve(path, np.arange(len(values)), values, f"{name} [{unit}]", color)


def _spacing(histories: Mapping[str, History]) -> float:
    """From ship to ship [m]: the width of the widest sea, and some room."""
    return SPACING * max(float(history.loading["length"]) for history in histories.values())


def _send_ships(tapes: Mapping[str, Tape], histories: Mapping[str, History], moments: FloatArray) -> None:
    """The ships with their seas, spread about the middle, and their names above them."""
    import rerun as rr

    spacing = _spacing(histories)
    for order, (name, history) in enumerate(histories.items()):
        world, tape = f"world/{rr.escape_entity_path_part(name)}", tapes[name]
        aside = (order - 0.5 * (len(histories) - 1)) * spacing
        tape.stream.log(world, rr.Transform3D(translation=[0.0, aside, 0.0]), static=True)
        above = [0.0, 0.0, 0.3 * float(history.loading["length"])]
        label = rr.Points3D([above], labels=[name], colors=RUN_COLORS[order], radii=0.0)
        tape.stream.log(f"{world}/name", label, static=True)
        rows = _nearest_rows(history, moments)
        send_hull(tape, history, rows, world)
        send_sea(tape, history, rows, world, REACH)
    stream = next(iter(tapes.values())).stream
    stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)


def _nearest_rows(history: History, moments: FloatArray) -> IntArray:
    """Rows of a run nearest to these moments [s], as far as it goes."""
    finite = np.flatnonzero(history.finite)
    within = moments[moments <= history.time[finite[-1:]].max(initial=-1.0) + 1e-9]
    middles = 0.5 * (history.time[finite][1:] + history.time[finite][:-1])
    return np.unique(finite[np.searchsorted(middles, within)])


def _send_texts(
    stream: "rr.RecordingStream", histories: Mapping[str, History], *, compared: list[str], drawn: bool
) -> None:
    import rerun as rr

    lines = [["run", "ship", "model", "speed [m/s]", "time step [s]", "seed", "outcome"], ["---"] * 7]
    for name, history in histories.items():
        attrs = history.attrs
        facts = [name, history.ship_name, attrs["model"], f"{attrs['speed']:.4g}", f"{attrs['time_step']:g}"]
        lines.append([*facts, str(attrs.get("seed", "–")), history.outcome])
    about = "".join(f"| {' | '.join(line)} |\n" for line in lines)
    about += f"\nDifferences are from {next(iter(histories))}"
    left_out = [name for name in list(histories)[1:] if name not in compared]
    about += f"; not of {', '.join(left_out)}, whose times are others.\n" if left_out else ".\n"
    if not drawn:
        about += f"\nShips are drawn for {MOST_SHIPS} runs at most.\n"
    tables = compared_markdown({name: statistics(history) for name, history in histories.items()})
    for entity, text in {"statistics": tables, "about": about}.items():
        stream.log(entity, rr.TextDocument(text, media_type=rr.MediaType.MARKDOWN), static=True)
