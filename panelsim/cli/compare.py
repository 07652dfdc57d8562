"""The command `compare linear-nonlinear`: a case in both models, in the same waves."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from panelsim.case import Case
from panelsim.cli.options import EXIT_ENDED_EARLY, Force, Overrides
from panelsim.cli.show import out, progress_bars, say, warn
from panelsim.cli.study import Out, Scheduler, Workers, make_runs, study_folder, tell_files
from panelsim.seaway.random import RandomSeaway
from panelsim.studies.linear_nonlinear import SEEDS, LinearNonlinear, require_linear_model

compare = typer.Typer(help="Compare models of a case.", rich_markup_mode=None)


@compare.callback()
def _models() -> None:
    """With a callback one command stays a command of a group."""


@compare.command("linear-nonlinear")
def linear_nonlinear(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    seeds: Annotated[
        int | None,
        typer.Option(help=f"Realizations of the sea; {SEEDS} of a random sea if not given, else 1."),
    ] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    out_folder: Out = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Run a case in the linear and the nonlinear model; compare RMS, and with the frequency domain.

    The files are report.md, rms.csv, models.png and study.rrd. A study that was stopped goes on.
    """
    case = Case.load(case_file, overrides or ())
    if seeds is None:
        seeds = SEEDS if isinstance(case.seaway, RandomSeaway) else 1
    study = LinearNonlinear(case, seeds)
    folder = study_folder(case, "linear-nonlinear", out_folder, force=force)
    with progress_bars() as track:
        database = require_linear_model(case, track("hydrodynamic coefficients"))
    warn(case.warnings())
    out.print(f"{len(study.cases)} runs")
    store = make_runs(study.cases, folder, workers, scheduler)
    from panelsim.studies.linear_nonlinear_page import (  # brings matplotlib
        models_in_words,
        write_linear_nonlinear,
    )

    files = write_linear_nonlinear(study, store, database, folder)
    rms = study.study(store)
    say(models_in_words(rms))
    warn(" ".join(failure.split()) for failure in rms.failures)
    tell_files(folder, files)
    if np.isnan(rms.rms).any():
        raise typer.Exit(EXIT_ENDED_EARLY)
