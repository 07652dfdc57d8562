"""The command `reproduce`: the numerical studies of a report made again, as a page."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table

from panelsim.cli.options import Force
from panelsim.cli.show import err, out, progress_bars
from panelsim.errors import PanelsimError
from panelsim.studies.computing import require_processes
from panelsim.studies.output_folder import make_output_folder, refuse_occupied_folder, remove_if_empty

if TYPE_CHECKING:  # it brings matplotlib and rerun
    from panelsim.studies.tm2003_190.section import Section

REPORTS = ("tm2003-190",)


def reproduce(
    name: Annotated[str, typer.Argument(help=f"The report: {', '.join(REPORTS)}.")],
    quick: Annotated[bool, typer.Option("--quick", help="A reduced set, some minutes.")] = False,
    out_folder: Annotated[
        Path | None, typer.Option("--out", help="Folder of the page; reports/NAME if not given.")
    ] = None,
    runs: Annotated[
        Path | None, typer.Option(help="Folder of the runs; runs/NAME if not given. Those in it are kept.")
    ] = None,
    from_runs: Annotated[
        bool, typer.Option("--from-runs", help="Make the page from stored runs, run nothing.")
    ] = False,
    force: Force = False,
    workers: Annotated[int | None, typer.Option(help="Processes; as many as cores if not given.")] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Dask cluster to run on, tcp://host:port.")
    ] = None,
) -> None:
    """Make the numerical studies of a report again, and a page of them: README.md with pictures and tables.

    A set that was stopped goes on where it was.
    """
    if name not in REPORTS:
        raise PanelsimError(
            "There is no such report to reproduce", got=f'"{name}"', allowed=", ".join(REPORTS)
        )
    require_processes(workers, scheduler)
    called = f"{name}-quick" if quick else name
    folder = out_folder if out_folder is not None else Path("reports") / called
    refuse_occupied_folder(folder, force=force)
    from panelsim.studies.tm2003_190.reproduce import reproduction  # brings matplotlib and rerun

    study = reproduction(quick=quick, runs=runs if runs is not None else Path("runs") / called)
    if from_runs:
        study.require_complete()
    make_output_folder(folder)
    try:
        with progress_bars() as track:
            tell = _teller(track)
            if not from_runs:
                study.make_runs(workers=workers, scheduler=scheduler, progress=tell)
            sections = study.make_page(folder, tell, workers=1 if scheduler is not None else workers)
    except BaseException:
        remove_if_empty(folder)
        raise
    _show(sections)
    out.print(f"The page is {folder / 'README.md'}, the runs are in {study.runs}.", soft_wrap=True)


def _teller(track: Callable[[str], Callable[[float, float], None]]) -> Callable[[str, float, float], None]:
    """One bar that bears the name of the study; off a terminal a line a study."""
    bars: dict[str, Callable[[float, float], None]] = {}

    def tell(name: str, done: float, total: float) -> None:
        if name not in bars:
            for older in bars.values():
                older(1, 1)  # hides it
            bars[name] = track(name)
            if not err.is_terminal:
                err.print(name)
        bars[name](done, total)

    return tell


def _show(sections: Sequence["Section"]) -> None:
    """The verdicts, and how many runs failed."""
    from panelsim.studies.tm2003_190.page import verdict

    table = Table("statement", "here", "figure", box=None, padding=(0, 2, 0, 0))
    for section in sections:
        for statement in section.statements:
            table.add_row(statement.says, verdict(statement), statement.figures)
    out.print(table)
    failures = sum(len(section.failures) for section in sections)
    if failures:
        err.print(f"warning: {failures} runs failed; the page lists them.")
