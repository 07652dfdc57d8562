"""Studies of RMS as a rerun recording: how they converge, and the motions behind them.

| entity | what | when |
|---|---|---|
| `study_N/rms/HEADING/MOTION` [m, deg] | RMS of all realizations, one line a sea | every level |
| `study_N/difference/HEADING/MOTION` [%] | difference from the reference; minor motions not | every level |
| `levels` | what the levels are, the present one marked | every level |
| `tables/rms`, `tables/differences`, `about` | Markdown | static |
| `histories/SIGNAL/RUN` [m, deg] | motions and wave of some runs | `rows_shown` of the steps |

Timelines: `level`, from 1 for the first level, with which the viewer opens; `sim_time` [s] of the motions. A
viewer has one timeline at a time, and plots of the other one are empty: the page says how to change it.
"""

import hashlib
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from panelsim.errors import PanelsimError
from panelsim.files import write_whole
from panelsim.results.rms_study import RmsStudy
from panelsim.results.rms_tables import difference_markdown, rms_markdown
from panelsim.view.study_blueprint import study_blueprint
from panelsim.view.study_histories import WINDOW, StoredMotions, send_histories, shown_window
from panelsim.view.study_lines import lines_of

if TYPE_CHECKING:
    import rerun as rr

APPLICATION_ID = "panelsim-convergence"
TIMELINES = "Lines over levels need the timeline `level`, time histories need `sim_time`."


def record_study(
    path: Path, studies: Sequence[RmsStudy], *, title: str, text: str, series: Mapping[str, StoredMotions]
) -> Path:
    """Write studies and the motions of some of their runs as one .rrd file, whole or not at all.

    `text` is Markdown, what the studies show; `series` are runs by what they are called in the plots.
    Raises PanelsimError where there is no study, or one of a single level.
    """
    _require_levels(studies)
    import rerun as rr

    stream = rr.RecordingStream(APPLICATION_ID, recording_id=_recording_id(studies, title, text, series))
    memory = stream.memory_recording()
    stream.send_recording_name(title)
    stream.send_property("study", rr.AnyValues(title=title, panelsim_version=version("panelsim")))
    for number, study in enumerate(studies, 1):
        for lines in lines_of(study, number):
            lines.send(stream)
    _send_levels(stream, studies)
    _send_texts(stream, studies, f"# {title}\n\n{text}" + (f"\n\n{TIMELINES}" if series else ""))
    if series:
        send_histories(stream, series)
    stream.send_blueprint(study_blueprint(studies, shown_window(series) if series else None))
    content = memory.drain_as_bytes()
    stream.disconnect()
    write_whole(path, content)
    return path


def _require_levels(studies: Sequence[RmsStudy]) -> None:
    if not studies:
        raise PanelsimError("There is no study to record", got="0 studies", allowed="1 or more")
    for study in studies:
        if len(study.levels) < 2:
            raise PanelsimError(
                f'The study "{study.title}" has nothing to compare',
                got=", ".join(study.levels) or "no level",
                allowed="2 levels or more",
            )


def _recording_id(
    studies: Sequence[RmsStudy], title: str, text: str, series: Mapping[str, StoredMotions]
) -> str:
    """Id from all that is recorded: a viewer merges recordings of one id without a word."""
    digest = hashlib.sha256()
    for part in (version("panelsim"), title, text, *series):
        digest.update(part.encode() + b"\0")
    arrays = [array for run in series.values() for array in (run.time, run.displacement, run.wave_elevation)]
    for study in studies:
        told = (study.title, study.varied, study.levels, study.reference, study.seas, study.failures)
        digest.update(repr(told).encode())
        arrays += [study.values, study.rms]
    for array in arrays:
        digest.update(np.ascontiguousarray(array, dtype=np.float64).tobytes())
    return f"{APPLICATION_ID}-{digest.hexdigest()[:24]}"


def _send_levels(stream: "rr.RecordingStream", studies: Sequence[RmsStudy]) -> None:
    """What each level is, studies of the same levels told together."""
    import rerun as rr

    alike: dict[tuple[str, tuple[str, ...], int], list[str]] = {}
    for study in studies:
        alike.setdefault((study.varied, study.levels, study.reference), []).append(study.title)
    numbers = np.arange(1, max(len(study.levels) for study in studies) + 1)
    pages = []
    for number in numbers:
        parts = [f"## Level {number}"]
        for (varied, levels, reference), titles in alike.items():
            parts += [f"{'; '.join(titles)}. Varied: {varied}.", _level_list(levels, reference, int(number))]
        pages.append("\n\n".join(parts))
    columns = rr.TextDocument.columns(text=pages, media_type=[rr.MediaType.MARKDOWN] * len(pages))
    stream.send_columns("levels", [rr.TimeColumn("level", sequence=numbers)], columns)


def _level_list(levels: Sequence[str], reference: int, present: int) -> str:
    lines = []
    for number, level in enumerate(levels, 1):
        told = f"{level} (reference)" if number - 1 == reference else level
        lines.append(f"- \\#{number}: " + (f"**{told}** ◀" if number == present else told))
    return "\n".join(lines)


def _send_texts(stream: "rr.RecordingStream", studies: Sequence[RmsStudy], about: str) -> None:
    import rerun as rr

    failures = [failure for study in studies for failure in study.failures]
    if failures:
        about += "\n\n## Runs that failed\n\n" + "".join(f"- {failure}\n" for failure in failures)
    texts = {
        "about": about,
        "tables/differences": _titled(studies, [difference_markdown(study) for study in studies]),
        "tables/rms": _titled(studies, [rms_markdown(study) for study in studies]),
        "how_to_see_motions": "**Are the plots empty? Choose the timeline `sim_time` from the menu at the"
        f" lower left.** Runs are here step by step for {WINDOW:g} s about the steepest deck of the first,"
        " and as envelopes elsewhere.",
    }
    for entity, text in texts.items():
        stream.log(entity, rr.TextDocument(text, media_type=rr.MediaType.MARKDOWN), static=True)


def _titled(studies: Sequence[RmsStudy], tables: Sequence[str]) -> str:
    return "\n".join(f"## {study.title}\n\n{table}" for study, table in zip(studies, tables, strict=True))
