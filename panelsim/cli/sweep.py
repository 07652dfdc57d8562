"""The command `panelsim sweep`: a case over values of some of its keys, in seas of several seeds."""

import shlex
import sys
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from panelsim.case import Case
from panelsim.cli.options import EXIT_ENDED_EARLY, Force, Overrides
from panelsim.cli.show import err, out, progress_bars, warn
from panelsim.cli.show_sweep import ended_early, show_sweep
from panelsim.studies.arguments import MOST_RUNS
from panelsim.studies.axes import Axis, require_axes
from panelsim.studies.computing import require_cluster, require_processes
from panelsim.studies.sweep import run_sweep
from panelsim.studies.sweep_folder import SweepFolder
from panelsim.studies.sweep_plan import plan_sweep

Workers = Annotated[
    int | None, typer.Option(metavar="N", help="Processes; as many as there are cores if not given.")
]
Scheduler = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="A Dask cluster that runs already: tcp://HOST:PORT.")
]


def sweep(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    over: Annotated[
        list[str] | None,
        typer.Option(metavar="KEY=VALUES", help="start:stop:step, or a,b,c; may be given again."),
    ] = None,
    seeds: Annotated[
        int, typer.Option(metavar="N", help="Seas of so many seeds, from that of the case on.")
    ] = 1,
    out_folder: Annotated[
        Path | None, typer.Option("--out", help="Output folder; runs/CASE-sweep if not given.")
    ] = None,
    force: Force = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with a sweep of this case; runs in the folder are used.")
    ] = False,
    overrides: Overrides = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    most_runs: Annotated[int, typer.Option(metavar="N", help="Refuse sweeps of more runs.")] = MOST_RUNS,
) -> None:
    """Run a case over values of its keys; write statistics and a picture.

    The files are sweep.nc, sweep.csv, sweep.png, and all runs in the folder runs.
    """
    require_processes(workers, scheduler)
    axes = [Axis.parse(text) for text in over or ()]
    require_axes(axes, [override.partition("=")[0] for override in overrides or ()])
    case = Case.load(case_file, overrides or ())
    plan = plan_sweep(case, axes, seeds, most_runs=most_runs)
    folder = SweepFolder(out_folder if out_folder is not None else Path("runs") / f"{case.name}-sweep")
    folder.require_free(case, force=force, resume=resume)
    _ = case.ship, case.seaway, case.supplementary, case.points  # whatever is wrong with them comes first
    warn(case.warnings())
    require_cluster(scheduler)
    folder.begin(case, anew=force)
    count = int(np.prod(plan.shape))
    out.print(f"{' x '.join(map(str, plan.shape))} = {count} run{'s' * (count > 1)}", soft_wrap=True)
    try:
        with progress_bars() as track:
            found = run_sweep(
                plan, folder.store, workers=workers, scheduler=scheduler, progress=track("runs")
            )
    except KeyboardInterrupt:
        err.print(f"The runs made so far are kept. To go on: {_command_to_go_on()}")
        raise
    files = folder.write(found)
    show_sweep(plan, found)
    out.print(
        f"Files in {folder.path}: {', '.join(files)}, and the runs in {folder.store.folder.name}/",
        soft_wrap=True,
    )
    if ended_early(found):
        raise typer.Exit(EXIT_ENDED_EARLY)


def _command_to_go_on() -> str:
    words = [word for word in sys.argv[1:] if word not in ("--force", "--resume")]
    return shlex.join(["panelsim", *words, "--resume"])
