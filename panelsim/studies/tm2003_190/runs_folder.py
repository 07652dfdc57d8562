"""The folder of the runs of a reproduction: which study it is of, and what it took."""

import json
import os
import platform
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from importlib.metadata import version
from pathlib import Path

from panelsim.errors import PanelsimError
from panelsim.files import write_whole

NOTE = "study.json"


@dataclass(frozen=True)
class RunsNote:
    """What `study.json` in the folder says; `wall_seconds` is that of all commands that made runs there."""

    study: str
    extent: str  # full or quick
    panelsim_version: str
    machine: str
    wall_seconds: float = 0.0


def open_runs_folder(folder: Path, study: str, extent: str) -> RunsNote:
    """The note of a folder of runs; of an empty or new one, that of a study that begins.

    Raises PanelsimError for a folder of another study, extent or version, or of something else.
    """
    path = folder / NOTE
    begun = RunsNote(study, extent, version("panelsim"), _machine())
    if not path.is_file():
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise PanelsimError(
                "The folder for the runs holds something else", got=folder, remedy="choose another by --runs"
            )
        return begun
    try:
        note = RunsNote(**json.loads(path.read_text(encoding="utf-8")))
        note = replace(note, wall_seconds=float(note.wall_seconds))
    except (ValueError, TypeError) as error:
        raise PanelsimError("The note on the runs is damaged", got=f"{path} ({error})") from error
    wanted, found = ((one.study, one.extent, one.panelsim_version) for one in (begun, note))
    if wanted != found:
        raise PanelsimError(
            "The folder holds runs of another study or version",
            got=f"{folder}: {_told(note)}",
            allowed=_told(begun),
            remedy="choose another folder by --runs, or remove this one",
        )
    return note


@contextmanager
def timed(folder: Path, note: RunsNote) -> Iterator[Callable[[], None]]:
    """Note the study in the folder, and at the end, also one by an interrupt, the time that a block took.

    The block gets a function that notes the time so far, for a process that is killed has no end.
    """
    start = time.monotonic()

    def noted() -> None:
        _write(folder, replace(note, wall_seconds=note.wall_seconds + time.monotonic() - start))

    _write(folder, note)
    try:
        yield noted
    finally:
        noted()


def _write(folder: Path, note: RunsNote) -> None:
    write_whole(folder / NOTE, json.dumps(asdict(note), indent=1).encode())


def _told(note: RunsNote) -> str:
    return f"{note.study}, {note.extent}, panelsim {note.panelsim_version}"


def _machine() -> str:
    """Number of cores that this process may use, and the model of the processor."""
    model = platform.processor() or platform.machine()
    about = Path("/proc/cpuinfo")
    if about.is_file():
        names = [
            line.partition(":")[2].strip() for line in about.read_text().splitlines() if "model name" in line
        ]
        model = names[0] if names else model
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"{cores} cores, {model}"
