"""Runs of a study, in as many processes as there are cores; those that are stored are not made again."""

import os
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import CancelledError
from contextlib import closing, suppress
from typing import TYPE_CHECKING, Any

from panelsim.case import Case
from panelsim.errors import PanelsimError, require_kind
from panelsim.hydro.store import database_for, stored_database
from panelsim.studies.arguments import whole_number
from panelsim.studies.cluster import local_client, require_address, scheduler_client
from panelsim.studies.groups import Answer, Failure, Request, groups_of, make_group
from panelsim.studies.run_store import RunStore, run_key

if TYPE_CHECKING:
    from distributed import Client, Future

Progress = Callable[[float, float], None]  # runs done, runs in all
Answers = Generator[tuple[Sequence[Case], Sequence[Answer]], None, None]

MOST_TOGETHER = 8  # more gain little (docs/batches.md)
CORES = os.cpu_count() or 1
MOST_A_CORE = 8  # workers; each takes some 300 MB
TASKS_A_WORKER = 4  # at least, where there are so many runs: the last ones to end leave few cores idle
LOST = Failure(
    "The processes that made the run were lost, again and again. Their memory may not suffice: try fewer"
    " workers.",
    lasting=False,
)


def compute_runs(
    cases: Sequence[Case],
    store: RunStore,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    group: int = MOST_TOGETHER,
    progress: Progress | None = None,
) -> None:
    """Make the runs that are not in the store yet, and keep each as soon as it is made.

    `workers` processes on this machine: as many as it has cores if not given, and with one all runs are made
    in this process. Or a `scheduler`, the address "tcp://host:port" of a Dask cluster. Up to `group` runs of
    a ship are stepped together; the bits are the same whatever these three are. `progress(done, total)` is
    told runs.

    A case that cannot be run leaves its message in the store, and the others go on. A run that takes its
    process with it is tried again some times; then `RunStore.failure` tells so in this process, and the next
    call tries again, as it does for what failed for want of memory or of files. An interrupt ends all; what
    is stored by then stays.

    Raises PanelsimError for an address that is none, where no fitting cluster answers, and for workers that
    are no whole number above 0.
    """
    require_processes(workers, scheduler)
    group = whole_number("number of runs in a group", group)
    missing = list({run_key(case): case for case in cases if case not in store}.values())
    if not missing:
        return
    done = 0
    if progress is not None:
        progress(done, len(missing))
    with closing(_answers(missing, workers, scheduler, group)) as found:
        for made, answers in found:
            for case, answer in zip(made, answers, strict=True):
                _keep(store, case, answer)
            done += len(made)
            if progress is not None:
                progress(done, len(missing))


def require_cluster(scheduler: str | None) -> None:
    """Raise PanelsimError where no fitting cluster answers at an address, before anything is written."""
    if scheduler is not None:
        with scheduler_client(scheduler):
            pass


def require_processes(workers: int | None, scheduler: str | None) -> None:
    """Raise PanelsimError for a number of processes, or an address of a cluster, that cannot be."""
    if workers is not None and whole_number("number of workers", workers) > (most := MOST_A_CORE * CORES):
        raise PanelsimError(
            "There are far more workers than cores",
            got=f"{workers} on {CORES} cores",
            allowed=f"1 to {most}",
            remedy="leave their number out: there are then as many as cores",
        )
    if scheduler is None:
        return
    require_kind("address of the scheduler", scheduler, str, '"tcp://HOST:PORT"')
    require_address(scheduler)
    if workers is not None:
        raise PanelsimError(
            "A cluster that runs already has its own workers",
            got=f"workers {workers}, scheduler {scheduler}",
            remedy="leave out the number of workers",
        )


def _keep(store: RunStore, case: Case, answer: Answer) -> None:
    if isinstance(answer, bytes):
        store.save(case, answer)
    elif answer.lasting:
        store.save_failure(case, answer.message)
    else:
        store.note_lost(case, answer.message)


def _answers(cases: Sequence[Case], workers: int | None, scheduler: str | None, group: int) -> Answers:
    """Cases with their runs, as they are made."""
    if scheduler is not None:
        with scheduler_client(scheduler) as client:
            yield from _by_dask(client, _groups(cases, sum(client.nthreads().values()), group))
        return
    if workers is None:
        from dask.system import CPU_COUNT  # those that this process may use

        workers = CPU_COUNT
    if min(workers, len(cases)) == 1:
        for made in groups_of(cases, group):
            yield made, make_group([Request.of(case) for case in made])
        return
    _make_coefficients(cases)
    groups = _groups(cases, workers, group)
    with local_client(min(workers, len(groups))) as client:
        yield from _by_dask(client, groups)


def _groups(cases: Sequence[Case], workers: int, most: int) -> list[list[Case]]:
    """Groups of which every worker has some."""
    return groups_of(cases, max(1, min(most, len(cases) // (TASKS_A_WORKER * workers))))


def _make_coefficients(cases: Sequence[Case]) -> None:
    """Compute coefficients that are not stored, so that not every process does; faults are told by runs."""
    ships = {
        (case.file.ship.model_dump_json(), case.file.hydrodynamics.model_dump_json()): case for case in cases
    }
    for case in ships.values():
        section = case.file.hydrodynamics
        with suppress(Exception):
            if (
                section.file is None
                and stored_database(case.ship, section.method, section.section_form) is None
            ):
                database_for(case.ship, None, section.method, section.section_form)


def _by_dask(client: "Client", groups: Sequence[Sequence[Case]]) -> Answers:
    """Groups made by the workers of a client; those of a group that is lost are made one by one."""
    from distributed import as_completed

    asked = {_submit(client, made, -i): made for i, made in enumerate(groups)}
    waiting = as_completed(list(asked), loop=client.loop)
    for future in waiting:
        made = asked.pop(future)
        answers: list[Answer] | None = result_of(future)
        future.release()
        if answers is None and len(made) > 1:
            alone = {_submit(client, [case], -len(groups)): [case] for case in made}
            asked |= alone
            waiting.update(list(alone))
        else:
            yield made, [LOST] * len(made) if answers is None else answers


def _submit(client: "Client", made: Sequence[Case], priority: int) -> "Future":
    return client.submit(_in_worker, [Request.of(case) for case in made], pure=False, priority=priority)


def _in_worker(requests: Sequence[Request]) -> list[Answer]:
    import dask.config

    # Or xarray, in a worker, would guard the file in memory by a lock of the cluster, and not find it.
    with dask.config.set(scheduler="synchronous"):
        return make_group(requests)


def result_of(future: "Future") -> Any | None:
    """What a task gave; None where its workers were lost. PanelsimError where the whole cluster was."""
    from distributed import KilledWorker

    try:
        return future.result()
    except KilledWorker:
        return None
    except (CancelledError, OSError) as error:
        raise PanelsimError(
            "The Dask cluster was lost",
            got=type(error).__name__,
            remedy="start the study again: it goes on where it was",
        ) from error
