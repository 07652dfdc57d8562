"""What the commands of studies share: their options, their folder, and the runs that they make."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from panelsim.case import Case
from panelsim.cli.show import out, progress_bars
from panelsim.studies.computing import compute_runs
from panelsim.studies.output_folder import make_output_folder, remove_if_empty
from panelsim.studies.run_store import RunStore
from panelsim.studies.study_page import RUNS, refuse_other_folder

Seeds = Annotated[int, typer.Option(help="Realizations of the sea: this seed and those after it.")]
Out = Annotated[Path | None, typer.Option("--out", help="Output folder; runs/CASE-STUDY if not given.")]


def study_folder(case: Case, study: str, given: Path | None, *, force: bool) -> Path:
    """The folder of a study; PanelsimError where it holds more than the runs of one that was stopped."""
    folder = given if given is not None else Path("runs") / f"{case.name}-{study}"
    refuse_other_folder(folder, force=force)
    return folder


def make_runs(cases: Sequence[Case], folder: Path, workers: int | None, scheduler: str | None) -> RunStore:
    """Make the runs that are missing under the folder, with a bar on a terminal."""
    make_output_folder(folder)
    store = RunStore(folder / RUNS)
    try:
        with progress_bars() as track:
            compute_runs(cases, store, workers=workers, scheduler=scheduler, progress=track("runs"))
    except BaseException:
        remove_if_empty(folder)
        raise
    return store


def words(text: str | None) -> list[str] | None:
    """The words of a list with commas, if there is one."""
    return None if text is None else [word.strip() for word in text.split(",")]


def tell_files(folder: Path, files: Sequence[str]) -> None:
    """Where the files of a study are."""
    out.print(f"Files in {folder}: {', '.join(files)}; its runs in {folder / RUNS}", soft_wrap=True)
