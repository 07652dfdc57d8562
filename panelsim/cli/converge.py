"""The commands `converge time-step` and `converge mesh`: how fine the steps or panels of a case must be."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from panelsim.case import Case
from panelsim.cli.options import EXIT_ENDED_EARLY, Force, Overrides
from panelsim.cli.respond import numbers
from panelsim.cli.show import out, say, warn
from panelsim.cli.study import Out, Seeds, make_runs, study_folder, tell_files, words
from panelsim.cli.sweep import Scheduler, Workers
from panelsim.studies.computing import require_processes
from panelsim.studies.convergence import Convergence, mesh_convergence, time_step_convergence

converge = typer.Typer(
    help="Say how fine the time step or the panels of a case must be.", rich_markup_mode=None
)


@converge.command("time-step")
def time_step(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    steps: Annotated[
        str | None,
        typer.Option(help="Time steps [s]: 0.1,0.2,0.5; half, once and twice the case's if not given."),
    ] = None,
    steppers: Annotated[
        str | None, typer.Option(help="Of exponential,rk4,ab3; the case's own if not given.")
    ] = None,
    seeds: Seeds = 1,
    workers: Workers = None,
    scheduler: Scheduler = None,
    out_folder: Out = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Run a case at several time steps and half the finest; compare the RMS of its motions.

    The files are report.md, rms.csv, pictures and study.rrd. A study that was stopped goes on.
    """
    require_processes(workers, scheduler)
    case = Case.load(case_file, overrides or ())
    values = None if steps is None else list(numbers("--steps", steps, "seconds", example="0.1,0.2,0.5"))
    study = time_step_convergence(case, values, words(steppers), seeds)
    _converge(study, out_folder, workers, scheduler, force=force)


@converge.command()
def mesh(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    panel_areas: Annotated[
        str | None,
        typer.Option(help="Panel areas [m2]: 5,2.5,1; half to four times the ship's if not given."),
    ] = None,
    rules: Annotated[
        str | None, typer.Option(help="Of vertex+centre,vertex,panel; the case's own if not given.")
    ] = None,
    seeds: Seeds = 1,
    workers: Workers = None,
    scheduler: Scheduler = None,
    out_folder: Out = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Run a case with several sizes of panel and half the finest; compare the RMS of its motions.

    The files are report.md, rms.csv, pictures and study.rrd. A study that was stopped goes on.
    """
    require_processes(workers, scheduler)
    case = Case.load(case_file, overrides or ())
    values = None if panel_areas is None else list(numbers("--panel-areas", panel_areas, "m2", "5,2.5,1"))
    _converge(
        mesh_convergence(case, values, words(rules), seeds), out_folder, workers, scheduler, force=force
    )


def _converge(
    study: Convergence, out_folder: Path | None, workers: int | None, scheduler: str | None, *, force: bool
) -> None:
    _ = study.case.supplementary, study.case.points  # whatever is wrong with them comes first
    folder = study_folder(study.case, study.key, out_folder, force=force)
    warn(study.case.warnings())
    out.print(f"{len(study.cases)} runs; reference: {study.reference_label}")
    store = make_runs(study.cases, folder, workers, scheduler)
    from panelsim.studies.convergence_page import (  # brings matplotlib
        convergence_in_words,
        failed_runs,
        write_convergence,
    )

    files = write_convergence(study, store, folder)
    found = {scheme: study.study(store, scheme) for scheme in study.schemes}
    say(convergence_in_words(study, found).replace("**", ""))
    for scheme, rms in found.items():
        say(f"{scheme}: {study.order(rms, scheme).told}")
    warn(failed_runs(study, found))
    tell_files(folder, files)
    if any(np.isnan(rms.rms[rms.reference]).any() for rms in found.values()):
        raise typer.Exit(EXIT_ENDED_EARLY)
