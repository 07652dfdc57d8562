"""Runs that are stepped together: a ship in many seas and at many speeds, each with its bits as if alone."""

import contextlib
import json
import threading
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.motion.history import History
from panelsim.studies.case_history import case_history, case_of_text, histories_together
from panelsim.studies.run_store import kept_bytes, run_identity

# A batch keeps a kilobyte a step while its histories are made.
MOST_STEPS_TOGETHER = 200_000
# Evaluations a step, and panel area [m2] at which a force costs as much as the rest of the step: rough, and
# they only say which group is the longest.
_EVALUATIONS, _AREA = {"rk4": 4.0}, 20.0

# Another thread of this process would gain nothing: a kernel holds Python's lock.
_one_at_a_time = threading.Lock()


@dataclass(frozen=True)
class Request:
    """What a process needs to make a run: the case as JSON text, its folder and name, its `run_identity`."""

    text: str
    folder: Path
    name: str
    identity: str

    @classmethod
    def of(cls, case: Case) -> "Request":
        return cls(case.file.model_dump_json(exclude_none=True), case.folder, case.name, run_identity(case))


@dataclass(frozen=True)
class Failure:
    """Why a run was not made; `lasting` where it is the case's own fault, and no second try can help."""

    message: str
    lasting: bool


Answer = bytes | Failure  # a run as `kept_bytes` makes it, or why there is none


def groups_of(cases: Sequence[Case], most: int) -> list[list[Case]]:
    """Cases in groups of up to `most` that can be stepped together, the longest first."""
    alike: dict[str, list[Case]] = defaultdict(list)
    for case in cases:
        alike[_what_is_shared(case)].append(case)
    groups = []
    for together in alike.values():
        size = max(1, min(most, MOST_STEPS_TOGETHER // together[0].file.run.steps))
        groups += [together[i : i + size] for i in range(0, len(together), size)]
    return sorted(groups, key=_length, reverse=True)


def _what_is_shared(case: Case) -> str:
    """All of a case that runs stepped together must have in common."""
    file = case.file.model_dump(mode="json", exclude_none=True)
    stretching = file.pop("seaway")["stretching"]
    # Ships at rest have no transom terms, and go in groups of their own.
    moves = file["run"].pop("speed_knots") > 0.0
    file["run"].pop("ship_heading_deg", None)
    return json.dumps([str(case.folder), file, stretching, moves], sort_keys=True)


def _length(group: Sequence[Case]) -> float:
    """How long a group takes, in units of its own."""
    run, area = group[0].file.run, group[0].file.ship.panel_area or _AREA
    cost = 1.0 + (_AREA / area if run.model == "nonlinear" else 0.0)
    return len(group) * run.steps * _EVALUATIONS.get(run.stepper, 1.0) * cost


def make_group(requests: Sequence[Request]) -> list[Answer]:
    """Make the runs of a group, or say of each why it could not be made; runs in any process.

    Where one of them cannot be run, each is made alone, so that only that one fails. An interrupt is raised.
    """
    with _one_at_a_time:
        if len(requests) > 1:
            with contextlib.suppress(Exception):
                return _together(requests)
        return [_alone(request) for request in requests]


def _together(requests: Sequence[Request]) -> list[Answer]:
    cases = [_case(request) for request in requests]
    histories = histories_together([case for case, _ in cases], cases[0][1])
    return [_kept(history, request) for history, request in zip(histories, requests, strict=True)]


def _alone(request: Request) -> Answer:
    try:
        return _kept(case_history(*_case(request)), request)
    except _OtherFilesError as error:
        return Failure(str(error), lasting=False)
    except PanelsimError as error:
        return Failure(str(error), lasting=True)
    except Exception as error:
        # What the machine lacks today, memory or a file, it may have tomorrow.
        lasting = not isinstance(error, MemoryError | OSError)
        return Failure(f"{type(error).__name__}: {' '.join(str(error).split())}", lasting)


def _case(request: Request) -> tuple[Case, HydroDatabase]:
    case, database = case_of_text(request.text, request.folder, request.name)
    if run_identity(case) != request.identity:
        raise _OtherFilesError(
            "The process that makes the run sees other files than the one that asked for it",
            got=f"{request.folder} there",
            remedy="give all machines of the cluster the same folders, and start again",
        )
    return case, database


class _OtherFilesError(PanelsimError):
    """The files of a case are not those that it was asked for with."""


def _kept(history: History, request: Request) -> bytes:
    if history.outcome == "interrupted":
        raise KeyboardInterrupt
    return kept_bytes(history, request.identity)
