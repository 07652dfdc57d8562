"""Processes that make runs, by Dask: a cluster of this machine's own cores, or one that runs already."""

import logging
import multiprocessing.resource_tracker
import os
import platform
import re
import signal
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from panelsim.errors import PanelsimError

if TYPE_CHECKING:
    from distributed import Client, LocalCluster

ADDRESS = re.compile(r"(tcp|tls)://([^\s:/\[\]]+|\[[0-9a-fA-F:.]+\]):(\d{1,5})")
CONNECT_SECONDS = 5.0
WORKER_SECONDS = 15.0  # a cluster that has just been started may still wait for its workers
_LOGGERS = ("distributed", "tornado", "asyncio")


def require_address(scheduler: str) -> None:
    """Raise PanelsimError for what is no address of a Dask scheduler."""
    found = ADDRESS.fullmatch(scheduler)
    if not found or not 0 < int(found[3]) < 65536:
        raise PanelsimError(
            "This is no address of a Dask scheduler",
            got=f'"{scheduler}"',
            allowed="tcp://HOST:PORT, for example tcp://127.0.0.1:8786",
            remedy="`dask scheduler` prints its address when it starts",
        )


@contextmanager
def local_client(workers: int) -> Iterator["Client"]:
    """A client of so many processes of one thread each, which end with the block.

    They listen on 127.0.0.1 only.
    """
    with ExitStack() as stack:
        stack.enter_context(_quiet())
        import dask.config
        from distributed import Client, LocalCluster

        stack.enter_context(_main_module_left_alone())
        # One task at a process: those that wait at a lost one would be taken for what killed it.
        stack.enter_context(dask.config.set({"distributed.scheduler.worker-saturation": 1.0}))
        with _interrupts_kept_from_children(), _start_told():
            cluster = LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
                scheduler_kwargs={"dashboard": False},
                # A process that is paused for its memory would wait for ever; one that is killed is replaced.
                memory_limit=None,
                silence_logs=logging.CRITICAL + 1,
            )
            stack.callback(_end, cluster)
            client = stack.enter_context(Client(cluster, set_as_default=False))
        yield client


@contextmanager
def _start_told() -> Iterator[None]:
    """Tell of processes that did not start."""
    try:
        yield
    except (RuntimeError, OSError) as error:
        raise PanelsimError(
            "The processes for the runs could not be started",
            got=f"{type(error).__name__}: {' '.join(str(error).split())}",
            remedy="start the study again, it goes on where it was; fewer workers need less memory,"
            " and one worker needs none of these processes",
        ) from error


def _end(cluster: "LocalCluster") -> None:
    """End the processes at once, and whatever they are at: nothing that they hold is missed."""
    for nanny in cluster.workers.values():
        nanny.close_gracefully()  # or it would start another
        if nanny.pid is not None:
            with suppress(OSError):
                os.kill(nanny.pid, getattr(signal, "SIGKILL", signal.SIGTERM))
    cluster.close()


@contextmanager
def scheduler_client(address: str) -> Iterator["Client"]:
    """A client of the Dask scheduler at an address.

    Raises PanelsimError where nobody answers, where it has no workers, and where their Python or panelsim is
    another than ours.
    """
    with _quiet():
        from distributed import Client

        try:
            client = Client(address, timeout=CONNECT_SECONDS, set_as_default=False)
        except (OSError, ValueError, RuntimeError) as error:
            raise PanelsimError(
                "No Dask scheduler answers at this address",
                got=address,
                remedy="start one with `dask scheduler`, and workers with `dask worker ADDRESS --nthreads 1`",
            ) from error
        with client:
            _require_workers_like_us(client, address)
            yield client


def _require_workers_like_us(client: "Client", address: str) -> None:
    with suppress(TimeoutError):
        client.wait_for_workers(1, timeout=WORKER_SECONDS)
    answer: Any = client.get_versions(packages=["panelsim"])
    told = answer["workers"]
    if not told:
        raise PanelsimError(
            "The Dask cluster has no workers",
            got=address,
            remedy=f"start some with `dask worker {address} --nthreads 1`",
        )
    ours = _short(platform.python_version(), version("panelsim"))
    for worker, versions in told.items():
        packages = versions["packages"]
        theirs = _short(packages["python"], packages["panelsim"])
        if theirs != ours:
            raise PanelsimError(
                "A worker of the Dask cluster has another Python or panelsim than this process",
                got=f"{theirs} at {worker}",
                allowed=ours,
                remedy="install the same on all machines of the cluster",
            )


def _short(python: str, panelsim: str | None) -> str:
    return f"Python {'.'.join(python.split('.')[:2])}, panelsim {panelsim or 'not installed'}"


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep to ourselves what Dask logs about connections and processes: what matters is told by the runs."""
    import distributed  # it sets up its loggers, and each has a level of its own

    assert distributed
    loggers = [logging.getLogger(name) for name in (*_LOGGERS, *logging.root.manager.loggerDict)]
    ours = [logger for logger in loggers if logger.name.startswith(_LOGGERS) and not logger.disabled]
    try:
        for logger in ours:
            logger.disabled = True
        yield
    finally:
        for logger in ours:
            logger.disabled = False


@contextmanager
def _main_module_left_alone() -> Iterator[None]:
    """Let no process import the script that was started: without main guard it would begin the study anew."""
    main = sys.modules["__main__"]
    spec, file = main.__spec__, main.__dict__.pop("__file__", None)
    main.__spec__ = None
    try:
        yield
    finally:
        main.__spec__ = spec
        if file is not None:
            main.__file__ = file


@contextmanager
def _interrupts_kept_from_children() -> Iterator[None]:
    """Let Ctrl-C reach this process alone, which then ends the others.

    Threads made in the block, and the processes that they start at any time, have it blocked.
    """
    if sys.platform == "win32":
        yield
        return
    multiprocessing.resource_tracker.ensure_running()  # as it starts, it unblocks the signal again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
