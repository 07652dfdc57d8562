"""The command that opens recordings, and runs side by side, in the rerun viewer."""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import typer

from panelsim.cli.arguments import refuse_existing, require_suffix
from panelsim.cli.options import Force
from panelsim.cli.show import out
from panelsim.errors import PanelsimError
from panelsim.motion.history import History
from panelsim.studies.going_on import HISTORY

ALLOWED = "recordings (.rrd), or runs: their folders or history.nc"


def view(
    what: Annotated[list[Path], typer.Argument(help="Recordings (.rrd), or folders of runs to compare.")],
    save: Annotated[
        Path | None, typer.Option("--save", help="Write the compared runs to FILE.rrd; open no viewer.")
    ] = None,
    force: Force = False,
) -> None:
    """Open recordings in the rerun viewer, or compare runs there.

    Recordings open together as they are. Two or more runs, each a folder or its history.nc, become one
    recording: motions in the same plots, statistics and ships side by side. One run opens its run.rrd.
    """
    recordings = [path for path in what if path.suffix == ".rrd"]
    if recordings and len(recordings) < len(what):
        raise PanelsimError(
            "Recordings and runs do not open together",
            got=", ".join(map(str, what)),
            allowed="either .rrd files, or folders of runs",
            remedy="give the folders alone to compare the runs, or the run.rrd of each",
        )
    histories = [] if recordings else [_history_file(path) for path in what]
    if len(histories) > 1:
        _compare(histories, save, force)
        return
    if save is not None:
        raise PanelsimError("There is nothing to save", got=what[0], allowed="--save with 2 or more runs")
    _open(recordings or [_recording_of(histories[0])])


def _history_file(path: Path) -> Path:
    """The history of a run that is named by it or by its folder."""
    file = path / HISTORY if path.is_dir() else path
    if not file.is_file() or file.suffix != ".nc":
        what = "There is no run in the folder" if path.is_dir() else "There is no such run"
        raise PanelsimError(what, got=path, allowed=ALLOWED)
    return file


def _recording_of(history: Path) -> Path:
    recording = history.with_name("run.rrd")
    if not recording.is_file():
        raise PanelsimError(
            "The run has no recording",
            got=recording,
            remedy="run the case again, or compare it with another run",
        )
    return recording


def _open(recordings: Sequence[Path]) -> None:
    for path in recordings:
        if not path.is_file():
            raise PanelsimError("There is no such recording", got=path, allowed=ALLOWED)
    from panelsim.view.viewer import open_viewer, require_whole  # brings rerun

    for path in recordings:
        require_whole(path)
    raise typer.Exit(open_viewer(recordings))


def _compare(files: Sequence[Path], save: Path | None, force: bool) -> None:
    """Compare the runs of these histories, in the viewer or in a file."""
    if save is not None:
        require_suffix(save, ".rrd")
        refuse_existing(save, force)
    histories = {name: History.load(file) for name, file in zip(run_names(files), files, strict=True)}
    from panelsim.view.compared_runs import compare_recordings  # brings rerun

    if save is not None:
        out.print(f"Wrote {compare_recordings(histories, save)}", soft_wrap=True)
        return
    with TemporaryDirectory(prefix="panelsim-") as folder:
        _open([compare_recordings(histories, Path(folder) / "compared.rrd")])


def run_names(files: Sequence[Path]) -> list[str]:
    """What to call runs: their folders, with as much of the path before them as tells them apart.

    Raises PanelsimError for a run that is given twice.
    """
    places = [file.resolve() for file in files]
    for file, place in zip(files, places, strict=True):
        if places.count(place) > 1:
            raise PanelsimError("A run is given twice", got=file, allowed="different runs")
    parts = [place.parent.parts if place.name == HISTORY else place.parts for place in places]
    return ["/".join(_telling_end(number, parts)) for number in range(len(parts))]


def _telling_end(number: int, parts: Sequence[tuple[str, ...]]) -> tuple[str, ...]:
    """The shortest end of the path of this number that is the end of no other."""
    path = parts[number]
    ends = (path[-depth:] for depth in range(1, len(path)))
    others = [*parts[:number], *parts[number + 1 :]]
    return next((end for end in ends if all(other[-len(end) :] != end for other in others)), path)
