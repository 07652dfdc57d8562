"""Runs of a study: the same bits in one process, in several, in groups; what is lost, fails or is stopped."""

import os
import signal
import socket
import sys
from collections.abc import Iterator
from multiprocessing.spawn import get_preparation_data
from pathlib import Path
from types import SimpleNamespace

import psutil
import pytest
from distributed import LocalCluster

import panelsim.studies.computing as computing
import panelsim.studies.groups as groups
from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.studies.cluster import _main_module_left_alone
from panelsim.studies.computing import compute_runs
from panelsim.studies.groups import Failure, Request, groups_of, make_group
from panelsim.studies.run_store import RunStore, StoredRun

EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
SHORT = {"ship.panel_area": 40.0, "run.duration": 8.0, "run.ramp": 4.0, "run.time_step": 0.4}

STEEP = {"seaway.peak_period": 9.0}  # steep enough to be warned of


@pytest.fixture(scope="module")
def base() -> Case:
    return Case.load(EXAMPLE).changed(SHORT)


@pytest.fixture(scope="module")
def cases(base: Case) -> list[Case]:
    """Seven that can be stepped together but for the linear one, one of them in calm water."""
    return [
        *(base.changed({"seaway.seed": seed, "run.speed_knots": 4.0 * seed}) for seed in range(4)),
        base.changed({"seaway.wave_heading_deg": 30, "seaway.frequencies.step": 0.05, **STEEP}),
        base.changed({"seaway": {"kind": "calm"}}),
        base.changed({"run.model": "linear"}),
    ]


@pytest.fixture(scope="module")
def alone(cases: list[Case], tmp_path_factory: pytest.TempPathFactory) -> list[StoredRun]:
    """Each case by itself, in this process."""
    store = RunStore(tmp_path_factory.mktemp("alone"))
    compute_runs(cases, store, workers=1, group=1)
    return [store.load(case) for case in cases]


def require_same(runs: list[StoredRun], others: list[StoredRun]) -> None:
    """The same bits, and the same words about them but for timings."""
    for run, other in zip(runs, others, strict=True):
        for name in ("time", "displacement", "wave_elevation"):
            assert getattr(run, name).tobytes() == getattr(other, name).tobytes()
        timings = {"cpu_seconds", "jit_seconds"}
        assert run.attrs.keys() == other.attrs.keys()
        assert all(run.attrs[name] == other.attrs[name] for name in run.attrs.keys() - timings)


def test_groups_have_the_bits_and_words_of_single_runs(
    cases: list[Case], alone: list[StoredRun], tmp_path: Path
) -> None:
    store = RunStore(tmp_path)
    told: list[tuple[float, float]] = []
    compute_runs(cases, store, workers=1, progress=lambda done, total: told.append((done, total)))
    require_same([store.load(case) for case in cases], alone)
    steeper = ["steeper" in run.attrs["notes"] for run in alone]
    assert steeper == [False] * 4 + [True] + [False] * 2
    # The ship at rest and the linear one go alone.
    assert told == [(0, 7), (5, 7), (6, 7), (7, 7)]
    assert [run.attrs.get("seed") for run in alone] == [0, 1, 2, 3, 1001, None, 1001]


def test_two_processes_of_which_one_is_killed(
    cases: list[Case], alone: list[StoredRun], tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """It is replaced, its runs are made again, a bad case fails alone, and nobody is told of Dask."""
    store = RunStore(tmp_path)
    bad = cases[0].changed({"run.time_step": 5.0})
    killed: list[int] = []

    def kill_one(done: float, total: float) -> None:
        if done and not killed:
            child = next(p for p in psutil.Process().children() if "spawn_main" in " ".join(p.cmdline()))
            killed.append(child.pid)
            os.kill(child.pid, signal.SIGKILL)

    compute_runs([bad, *cases, *cases], store, workers=2, progress=kill_one)
    require_same([store.load(case) for case in cases], alone)
    assert "time step" in str(store.failure(bad))
    assert killed and not [p for p in psutil.Process().children() if "spawn_main" in " ".join(p.cmdline())]
    assert capfd.readouterr() == ("", "")


@pytest.fixture(scope="module")
def cluster() -> Iterator[LocalCluster]:
    """A Dask cluster of one thread of this process, reached by its address."""
    with LocalCluster(
        n_workers=1,
        threads_per_worker=1,
        processes=False,
        protocol="tcp",
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        silence_logs=60,
    ) as cluster:
        yield cluster


def test_a_cluster_that_runs_already(
    cluster: LocalCluster, cases: list[Case], alone: list[StoredRun], tmp_path: Path
) -> None:
    store = RunStore(tmp_path)
    compute_runs(cases, store, scheduler=cluster.scheduler_address)
    require_same([store.load(case) for case in cases], alone)


def test_workers_of_another_version_are_refused(
    cluster: LocalCluster, cases: list[Case], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("panelsim.studies.cluster.version", lambda _: "0.0.9")
    with pytest.raises(PanelsimError, match=r"another Python or panelsim(.|\n)*allowed: .*panelsim 0\.0\.9"):
        compute_runs(cases, RunStore(tmp_path), scheduler=cluster.scheduler_address)
    assert not list(tmp_path.iterdir())


def test_nobody_at_the_address(cases: list[Case], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("panelsim.studies.cluster.CONNECT_SECONDS", 0.5)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))  # and does not listen
        address = f"tcp://127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(PanelsimError, match="No Dask scheduler answers"):
            compute_runs(cases, RunStore(tmp_path), scheduler=address)


@pytest.mark.parametrize("name", ["LocalCluster", "Client"])
def test_processes_that_do_not_start_are_told(
    cases: list[Case], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise RuntimeError("Nanny\nfailed to start.")

    cluster = SimpleNamespace(workers={}, close=lambda: None)
    monkeypatch.setattr("distributed.LocalCluster", lambda **_: cluster)
    monkeypatch.setattr(f"distributed.{name}", fail)
    with pytest.raises(PanelsimError, match=r"could not be started(.|\n)*Nanny failed(.|\n)*fewer workers"):
        compute_runs(cases, RunStore(tmp_path), workers=2)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "address",
    ["", "localhost", "127.0.0.1:8786", "tcp://host", "tcp://host:0", "tcp://host:70000", "tcp://:1"],
)
def test_no_address(address: str, tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match=r"no address(.|\n)*tcp://HOST:PORT"):
        compute_runs([], RunStore(tmp_path), scheduler=address)


@pytest.mark.parametrize("given", [{"workers": 0}, {"workers": 1.5}, {"workers": True}, {"group": 0}])
def test_impossible_numbers(given: dict[str, int], tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="is not possible"):
        compute_runs([], RunStore(tmp_path), **given)
    with pytest.raises(PanelsimError, match="own workers"):
        compute_runs([], RunStore(tmp_path), workers=2, scheduler="tcp://[::1]:8786")


def test_a_case_that_fails_among_others(
    cases: list[Case], alone: list[StoredRun], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever is raised: the others of its group are made, and it is not tried again."""
    calls: list[object] = []

    def fail(case: Case, database: object) -> object:
        calls.append(case.file.seaway.seed)
        if case.file.seaway.seed == 2:
            raise ZeroDivisionError("by\nnothing")
        return original(case, database)  # type: ignore[arg-type]

    original = groups.case_history
    monkeypatch.setattr(groups, "case_history", fail)
    monkeypatch.setattr(groups, "histories_together", lambda *_: 1 / 0)
    store = RunStore(tmp_path)
    for _ in range(2):
        compute_runs(cases[:4], store, workers=1)
    assert sorted(calls) == [0, 1, 2, 3]  # type: ignore[type-var]
    assert store.failure(cases[2]) == "ZeroDivisionError: by nothing"
    require_same([store.load(cases[i]) for i in (0, 1, 3)], [alone[i] for i in (0, 1, 3)])


@pytest.mark.parametrize("error", [MemoryError(), OSError("no room")])
def test_what_the_machine_lacks_is_tried_again(
    error: Exception, base: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def lack(*_: object) -> None:
        raise error

    store = RunStore(tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr(groups, "case_history", lack)
        compute_runs([base], store, workers=1)
    assert type(error).__name__ in str(store.failure(base))
    assert base not in store and not list(tmp_path.iterdir())
    compute_runs([base], store, workers=1)
    assert store.failure(base) is None and store.load(base).outcome == "finished"


def test_a_run_that_takes_its_process_with_it_is_lost_alone(cases: list[Case]) -> None:
    """By a client that loses a group, then one run of it."""
    from concurrent.futures import Future

    from distributed import KilledWorker

    class Client:
        loop = None

        def submit(self, task: object, requests: list[Request], **_: object) -> Future:
            future: Future = Future()
            future.release = lambda: None  # type: ignore[attr-defined]
            if any('"seed":2' in request.text for request in requests):
                future.set_exception(KilledWorker("task", None, 3))
            else:
                future.set_result([b"run"] * len(requests))
            return future

    class Completed(list):
        def update(self, more: list[Future]) -> None:
            self.extend(more)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("distributed.as_completed", lambda futures, loop: Completed(futures))
        found = list(computing._by_dask(Client(), [cases[:4], cases[4:6]]))  # type: ignore[arg-type]
    answers = {id(case): answer for made, given in found for case, answer in zip(made, given, strict=True)}
    assert [answers[id(case)] for case in cases[:6]] == [
        b"run", b"run", computing.LOST, b"run", b"run", b"run",
    ]  # fmt: skip


def test_an_interrupt_ends_the_study_and_is_no_run(
    base: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`simulate` itself ends a run that is interrupted, and calls it so."""
    monkeypatch.setattr(
        "panelsim.motion.march._end_beyond_limits", lambda *_: signal.raise_signal(signal.SIGINT)
    )
    store = RunStore(tmp_path)
    for group in (1, 8):
        with pytest.raises(KeyboardInterrupt):
            compute_runs([base, base.changed({"seaway.seed": 5})], store, workers=1, group=group)
    assert base not in store and not list(tmp_path.iterdir())


def test_other_files_in_the_process_that_makes_the_run(base: Case) -> None:
    (answer,) = make_group([Request(Request.of(base).text, base.folder, base.name, "another")])
    assert isinstance(answer, Failure) and not answer.lasting and "other files" in answer.message


def test_groups_are_of_a_kind_and_the_longest_comes_first(base: Case) -> None:
    seeds = [base.changed({"seaway.seed": seed}) for seed in range(5)]
    fine = base.changed({"ship.panel_area": 20.0})
    slow = base.changed({"run.time_step": 0.1})
    rest = base.changed({"run.speed_knots": 0.0})
    still = base.changed({"seaway.stretching": "none"})
    found = groups_of([rest, still, *seeds, fine, slow], most=4)
    assert found[0] in (seeds[:4], [slow]) and found[1] in (seeds[:4], [slow])
    assert found[2] == [fine] and sorted(map(len, found)) == [1, 1, 1, 1, 1, 4]
    # 3000 s at 0.1 s are 30 000 steps: six of them are as many as are kept in memory at once.
    long = [base.changed({"run.duration": 3e3, "run.time_step": 0.1, "seaway.seed": s}) for s in range(8)]
    assert [len(group) for group in groups_of(long, most=8)] == [6, 2]


def test_a_script_without_main_guard_is_not_begun_again() -> None:
    """Processes are told nothing of the script, and all is as before afterwards."""
    main = sys.modules["__main__"]
    before = main.__spec__, getattr(main, "__file__", None)
    with _main_module_left_alone():
        assert not {"init_main_from_name", "init_main_from_path"} & get_preparation_data("worker").keys()
    assert (main.__spec__, getattr(main, "__file__", None)) == before
