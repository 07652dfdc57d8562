"""The command `cost`: CPU seconds a simulated second of a case."""

from pathlib import Path
from typing import Annotated

import typer

from panelsim.case import Case
from panelsim.cli.options import EXIT_ENDED_EARLY, Force, Overrides
from panelsim.cli.respond import numbers
from panelsim.cli.show import progress_bars, say, warn
from panelsim.cli.study import Out, study_folder, tell_files
from panelsim.studies.case_cost import case_cost
from panelsim.studies.cost import ROUNDS, cost_rows, measure_costs
from panelsim.studies.output_folder import make_output_folder
from panelsim.studies.study_page import RUNS
from panelsim.studies.timing_store import TimingStore

_COUNTS = "whole numbers", "19,37,160"


def cost(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    components: Annotated[
        str | None,
        typer.Option(
            help="Numbers of wave frequencies: 19,37,160; once to four times the case's if not given."
        ),
    ] = None,
    panel_areas: Annotated[
        str | None, typer.Option(help="Panel areas [m2]: 5,2.5,1; half to twice the ship's if not given.")
    ] = None,
    rounds: Annotated[int, typer.Option(min=1, max=100, help="How often each run is timed.")] = ROUNDS,
    out_folder: Out = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Time the runs of a case in both models; how that grows with its waves and panels.

    Runs are timed alone, one after another. The files are report.md, cost.csv and cost.png.
    """
    case = Case.load(case_file, overrides or ())
    areas = None if panel_areas is None else list(numbers("--panel-areas", panel_areas, "m2", "5,2.5,1"))
    counts = None if components is None else list(numbers("--components", components, *_COUNTS))
    study = case_cost(case, counts, areas)
    folder = study_folder(case, "cost", out_folder, force=force)
    _ = case.supplementary, case.points  # whatever is wrong with them comes first
    warn(case.warnings())
    with progress_bars() as track:
        case.database(track("hydrodynamic coefficients"))
        make_output_folder(folder)
        store = TimingStore(folder / RUNS)
        measure_costs(study.cases, store, rounds=rounds, progress=track("runs"))
    from panelsim.studies.cost_page import growth_in_words, write_cost  # brings matplotlib

    files = write_cost(study, store, folder, rounds=rounds)
    rows = {what: cost_rows(cases, store, rounds=rounds) for what, cases in study.varied.items()}
    for row in rows["case"]:
        if row.failure is None:
            say(f"{row.model}: {row.median:.2e} CPU s a simulated s, spread {row.told_spread}")
    if powers := growth_in_words(rows):
        say(powers)
    failed = [row for of_what in rows.values() for row in of_what if row.failure is not None]
    warn(" ".join(f"{row.label}: {row.failure}".split()) for row in failed)
    tell_files(folder, files)
    if any(row.failure is not None for row in rows["case"]):
        raise typer.Exit(EXIT_ENDED_EARLY)
