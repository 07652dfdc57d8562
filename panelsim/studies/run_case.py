"""One case from its description to all its files."""

import time as clock
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from panelsim.case import Case
from panelsim.files import replacing
from panelsim.hydro.database import Progress as CoefficientProgress
from panelsim.motion.history import History
from panelsim.motion.march import Progress as RunProgress
from panelsim.results.statistics import Statistics, statistics
from panelsim.studies.case_history import case_history
from panelsim.studies.going_on import HISTORY
from panelsim.studies.output_folder import make_output_folder, refuse_occupied_folder, remove_if_empty
from panelsim.view.recording import record
from panelsim.view.report import PICTURES, report

FILES = (HISTORY, "statistics.json", "report.md", "run.rrd")
# Those of an older run, whole or in part, would be taken for this one's. Its history is not taken away but
# replaced in one step: a run that goes on would be lost with it.
OLD_FILES = (*FILES[1:], *PICTURES, "motions.csv", "loads.csv")


@dataclass(frozen=True)
class RunOutput:
    """What a run left: the history, its statistics, where its files are, and CPU seconds by stage."""

    history: History
    statistics: Statistics
    folder: Path
    files: tuple[str, ...]
    seconds: dict[str, float]


def run_case(
    case: Case,
    folder: Path,
    *,
    force: bool = False,
    resume: History | None = None,
    on_coefficients: CoefficientProgress | None = None,
    on_run: RunProgress | None = None,
) -> RunOutput:
    """Run a case and write history.nc, statistics.json, report.md with its plots, and run.rrd.

    `resume` is the beginning of this very run, as `begun_run` finds it in the folder: it goes on bit for bit,
    and files in the folder are replaced. The two callbacks are told the progress of the coefficients (done,
    total) and of the run (seconds done, seconds in all). A run that ends early leaves all its files too; its
    history says why.
    Raises PanelsimError for a folder that is not empty, unless `force` or `resume`, for the beginning of
    another run, and for a case that cannot be run, all before anything is written.
    """
    refuse_occupied_folder(folder, force=force or resume is not None)
    seconds: dict[str, float] = {}
    with _timed(seconds, "ship and waves"):
        _ = case.ship, case.seaway, case.supplementary, case.points  # whatever is wrong with them comes first
    make_output_folder(folder)
    try:
        return _run_into(folder, case, resume, seconds, on_coefficients, on_run)
    except BaseException:
        remove_if_empty(folder)
        raise


def _run_into(
    folder: Path,
    case: Case,
    resume: History | None,
    seconds: dict[str, float],
    on_coefficients: CoefficientProgress | None,
    on_run: RunProgress | None,
) -> RunOutput:
    """Compute, simulate and write; `seconds` gets the time of each stage."""
    with _timed(seconds, "coefficients"):
        database = case.database(on_coefficients)
    with _timed(seconds, "run"):
        history = case_history(case, database, resume=resume, progress=on_run)
    with _timed(seconds, "history and statistics"):
        for name in OLD_FILES:
            (folder / name).unlink(missing_ok=True)
        history.save(folder / HISTORY, overwrite=True)
        result = statistics(history)
        with replacing(folder / "statistics.json") as beside:
            beside.write_text(result.to_json(), encoding="utf-8")
    with _timed(seconds, "report"):
        report(history, folder)
    with _timed(seconds, "recording"):
        record(history, folder / "run.rrd")
    return RunOutput(history, result, folder, FILES, seconds)


@contextmanager
def _timed(seconds: dict[str, float], stage: str) -> Iterator[None]:
    """Note the CPU seconds that a block takes."""
    start = clock.process_time()
    yield
    seconds[stage] = clock.process_time() - start
