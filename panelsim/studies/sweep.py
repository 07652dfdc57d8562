"""Sweeps: a case with other values of some keys, in seas of several seeds, and statistics over them all."""

import tempfile
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from pathlib import Path

import xarray as xr

from panelsim.case import Case
from panelsim.errors import require_kind
from panelsim.files import as_path
from panelsim.studies.arguments import MOST_RUNS, listed, require_case
from panelsim.studies.axes import Axis, Value
from panelsim.studies.computing import Progress, compute_runs
from panelsim.studies.run_store import RunStore
from panelsim.studies.sweep_plan import SweepPlan, plan_sweep
from panelsim.studies.sweep_statistics import sweep_dataset


def sweep(
    case: Case,
    axes: Mapping[str, Iterable[Value]],
    seeds: int = 1,
    *,
    folder: str | Path | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    most_runs: int = MOST_RUNS,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Run a case with all values of some keys, {"run.speed_knots": [0, 10]}, and gather its statistics.

    Each in seas of so many `seeds`, that of the case first. Runs are kept in `folder`, where they are found
    again, or nowhere. `workers`, `scheduler` and `progress` as for `compute_runs`. The dataset has the keys
    as dimensions, and `dof`: see `sweep_dataset`.

    Raises PanelsimError as `plan_sweep` and `compute_runs`, and where no run could be made.
    """
    require_case(case)
    require_kind("mapping of axes", axes, Mapping, '{"run.speed_knots": [0, 10, 20]}')
    require_kind("progress", progress, Callable | None, "a function of runs done and runs in all")  # type: ignore[arg-type]
    place = None if folder is None else as_path(folder)
    found = {key: listed(f"values of {key}", values, "a list") for key, values in axes.items()}
    plan = plan_sweep(
        case, [Axis(key, tuple(values)) for key, values in found.items()], seeds, most_runs=most_runs
    )
    with ExitStack() as stack:
        if place is None:
            place = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="panelsim-")))
        return run_sweep(plan, RunStore(place), workers=workers, scheduler=scheduler, progress=progress)


def run_sweep(
    plan: SweepPlan,
    store: RunStore,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Make the runs of a sweep that the store does not have, and gather their statistics."""
    compute_runs(list(plan.cases.values()), store, workers=workers, scheduler=scheduler, progress=progress)
    return sweep_dataset(plan, store)
