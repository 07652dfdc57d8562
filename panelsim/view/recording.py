"""A run as a rerun recording: the moving hull and sea, the six motions, the loads and the statistics.

| entity | what | when |
|---|---|---|
| `world/ship` | position and attitude of the ship in translating earth axes | 3-D frames |
| `world/ship/hull` | panels; colour by pressure head where wet | static; colour in 3-D frames |
| `world/sea` | wave surface around the ship | 3-D frames |
| `motions/linear/{surge,sway,heave}` [m], `motions/angular/{roll,pitch,yaw}` [deg] | | every step |
| `waves/elevation` [m] | waves at the moving origin | every step |
| `loads/<dof>/<name>` [MN or MN m] | every load, in the filmed window | every step of it |
| `statistics`, `about` | Markdown | static |

Timelines: `sim_time` [s] and `step` of the whole run; `film`, the same seconds for the filmed window alone,
with which the viewer opens. Pose, colour and sea are drawn at the same instants, so that the ship never
rides on a sea of another moment.
"""

import hashlib
import time as clock
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from panelsim.conventions import DOF_NAMES
from panelsim.errors import PanelsimError
from panelsim.files import write_whole
from panelsim.motion.history import History
from panelsim.results.statistics import display_unit, statistics
from panelsim.results.tables import statistics_markdown
from panelsim.view.blueprint import ship_blueprint
from panelsim.view.frames import choose_frames, rows_within
from panelsim.view.ship_scene import send_hull, send_sea
from panelsim.view.surfaces import deepest_head
from panelsim.view.tape import Tape

if TYPE_CHECKING:
    import rerun as rr

APPLICATION_ID = "panelsim"
# Surge to yaw, and the loads in their order; told apart on a dark and on a light background.
CURVE_COLORS = (0x9A9A9AFF, 0xB07CD8FF, 0xF28E2BFF, 0xE15759FF, 0x59A14FFF, 0xC9A227FF)
WAVE_COLOR = 0x3FA7D6FF


@dataclass(frozen=True)
class RecordingSummary:
    """What was written: `frames` 3-D pictures, `steps` of every motion, the filmed window [s], the cost."""

    path: Path
    recording_id: str
    frames: int
    steps: int
    film: tuple[float, float]
    file_bytes: int
    seconds: float


def record(history: History, path: str | Path, *, frames: int = 100) -> RecordingSummary:
    """Write a history as a .rrd file with at most `frames` 3-D pictures; the motions are there at every step.

    The file is written beside and renamed. Raises PanelsimError for fewer than two frames.
    """
    if frames < 2:
        raise PanelsimError("A recording needs 3-D pictures", got=f"{frames} frames", allowed="2 or more")
    import rerun as rr

    start, path = clock.perf_counter(), Path(path)
    rows, film = choose_frames(history, frames)
    stream = rr.RecordingStream(APPLICATION_ID, recording_id=recording_id(history))
    tape = Tape(stream, history.time, film)
    memory = stream.memory_recording()
    _send_facts(stream, history)
    _send_motions(tape, history)
    _send_loads(tape, history)
    send_hull(tape, history, rows)
    send_sea(tape, history, rows)
    middle = np.median(history.displacement[rows, :3], axis=0) if len(rows) else np.zeros(3)
    stream.send_blueprint(ship_blueprint(length=float(history.loading["length"]), look_at=middle))
    content = memory.drain_as_bytes()
    stream.disconnect()
    write_whole(path, content)
    return RecordingSummary(
        path=path,
        recording_id=recording_id(history),
        frames=len(rows),
        steps=len(history.time),
        film=film,
        file_bytes=path.stat().st_size,
        seconds=clock.perf_counter() - start,
    )


def recording_id(history: History) -> str:
    """Id of a recording, from the case, the version and the motions that they gave.

    The same case gives the same id again. The motions enter because a viewer merges recordings of one id
    without a word, and a run from a script may name no case.
    """
    digest = hashlib.sha256()
    for part in (history.attrs["case"], history.attrs["panelsim_version"]):
        digest.update(str(part).encode() + b"\0")
    digest.update(np.ascontiguousarray(history.displacement).tobytes())
    return f"panelsim-{digest.hexdigest()[:24]}"


def _send_facts(stream: "rr.RecordingStream", history: History) -> None:
    """What does not change: axes, tables, properties."""
    import rerun as rr

    attrs = history.attrs
    stream.send_recording_name(f"{history.ship_name}, {attrs['model']}, {attrs['outcome']}")
    facts = {name: attrs[name] for name in ("panelsim_version", "model", "speed", "time_step", "ramp")}
    facts |= {"ship": history.ship_name, "panels": len(history.panels), "outcome": history.outcome}
    facts |= {"seed": str(attrs.get("seed", "none")), "case": attrs["case"]}
    stream.send_property("run", rr.AnyValues(**facts))
    stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    table = statistics(history)
    text = statistics_markdown(table)
    if table.note:
        text += f"\n{table.note}\n"
    stream.log("statistics", rr.TextDocument(text, media_type=rr.MediaType.MARKDOWN), static=True)
    stream.log("about", rr.TextDocument(_about(history), media_type=rr.MediaType.MARKDOWN), static=True)


def _about(history: History) -> str:
    attrs = history.attrs
    lines = [
        f"**{history.ship_name}**, {attrs['model']} model, {len(history.panels)} panels,"
        f" {attrs['speed']:.2f} m/s.",
        f"Outcome: **{history.outcome}** {attrs['outcome_detail']}".rstrip(),
        f"Hull: wet parts pale to dark blue with the pressure head, 0 to {deepest_head(history):.1f} m;"
        " dry topsides grey; bottom out of the water red. Sea: dark troughs, pale crests.",
        "Loads: less their mean, and for the filmed moments only; history.nc has all of them.",
        *history.notes,
    ]
    return "\n\n".join(lines)


def _send_motions(tape: Tape, history: History) -> None:
    rows = np.arange(len(history.time))
    for dof, name in enumerate(DOF_NAMES):
        unit, factor = display_unit(name)
        entity = f"motions/{'linear' if unit == 'm' else 'angular'}/{name}"
        values = factor * history.displacement[:, dof]
        tape.send_curve(entity, rows, values, f"{name} [{unit}]", CURVE_COLORS[dof])
    tape.send_curve("waves/elevation", rows, history.wave_elevation, "wave elevation [m]", WAVE_COLOR)


def _send_loads(tape: Tape, history: History) -> None:
    """Loads of the filmed window; of a whole run they would be most of the file.

    Weight and buoyancy would flatten every other curve, so each is drawn about its mean over the run.
    """
    rows = np.flatnonzero(rows_within(history.time, tape.film))
    for order, (load, values) in enumerate(history.loads.items()):
        color = CURVE_COLORS[order % len(CURVE_COLORS)]
        for dof, name in enumerate(DOF_NAMES):
            mean = values[history.finite, dof].mean()
            if np.ptp(values[rows, dof]) > 1e-9 * abs(mean):
                label = f"{load.replace('_', ' ')} [{'MN' if dof < 3 else 'MN m'}]"
                tape.send_curve(f"loads/{name}/{load}", rows, 1e-6 * (values[:, dof] - mean), label, color)
