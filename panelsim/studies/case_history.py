"""The run of a case: from its description to its history, alone or together with others of its kind."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from panelsim.case import Case
from panelsim.case.schema import CaseFile
from panelsim.hydro.database import HydroDatabase
from panelsim.motion.history import History
from panelsim.motion.march import Progress
from panelsim.motion.requirements import case_text
from panelsim.motion.simulate import simulate, simulate_batch
from panelsim.ship.ship import Ship
from panelsim.studies.run_store import file_digests


def case_history(
    case: Case, database: HydroDatabase, *, resume: History | None = None, progress: Progress | None = None
) -> History:
    """Simulate a case with its coefficients; `resume` and `progress` are those of `simulate`.

    Raises PanelsimError for a case that cannot be run.
    """
    return simulate(
        case.ship,
        case.seaway,
        speed=case.speed,
        database=database,
        roll_damping=case.roll_damping(database),
        progress=progress,
        case=case.resolved(),
        seed=_seed(case),
        notes=case.warnings(),
        resume=resume,
        **_settings(case, database),
    )


def histories_together(cases: Sequence[Case], database: HydroDatabase) -> tuple[History, ...]:
    """Simulate cases that differ in their sea and speed only, in less time: each history as if alone.

    Raises PanelsimError for cases that cannot be run, or not together.
    """
    first = cases[0]
    damping = [case.roll_damping(database) for case in cases]
    histories = simulate_batch(
        first.ship,
        [case.seaway for case in cases],
        speed=[case.speed for case in cases],
        database=database,
        roll_damping=None if damping[0] is None else [terms for terms in damping if terms is not None],
        seeds=[_seed(case) for case in cases],
        **_settings(first, database),
    )
    return tuple(_told_by(case, history) for case, history in zip(cases, histories, strict=True))


def _seed(case: Case) -> int | None:
    return case.file.seaway.seed if case.file.seaway.kind == "random" else None


def _settings(case: Case, database: HydroDatabase) -> dict[str, Any]:
    """Arguments of `simulate` that cases run together have in common."""
    run = case.file.run
    return {
        "duration": run.duration,
        "time_step": run.time_step,
        "model": run.model,
        "inertia": run.inertia,
        "stepper": run.stepper,
        "ramp": run.ramp,
        "stretching": case.file.seaway.stretching,
        "pressure_method": run.pressure_method,
        "pressure_rule": run.pressure_rule,
        "supplementary": case.supplementary,
        "transom": case.transom(database),
        "capsize_angle": float(np.deg2rad(run.capsize_angle_deg)),
        "points": case.points,
    }


def _told_by(case: Case, history: History) -> History:
    """The history with the description of its own case, and its warnings before the other notes."""
    tree = history.tree.copy()
    notes = [*case.warnings(), *history.notes]
    tree.attrs |= {"case": case_text(case.resolved()), "notes": json.dumps(notes, ensure_ascii=False)}
    return History(tree)


def case_of_text(text: str, folder: Path, name: str) -> tuple[Case, HydroDatabase]:
    """A case that came as JSON text, as it comes to another process, with its coefficients.

    Cases with the same ship and coefficients share them. Raises PanelsimError for a ship or coefficients
    that cannot be had.
    """
    case = Case(CaseFile.model_validate_json(text), folder, name)
    case.__dict__["ship"], database = _ship_and_database(_ShipKey(case))
    return case, database


@dataclass(frozen=True)
class _ShipKey:
    """A case, equal to all others of the same ship with the same coefficients, and the same files."""

    case: Case = field(compare=False)
    described: str = field(init=False)

    def __post_init__(self) -> None:
        file = self.case.file
        sections = file.ship.model_dump_json() + file.hydrodynamics.model_dump_json()
        described = f"{self.case.folder} {sections} {file_digests(self.case)}"
        object.__setattr__(self, "described", described)


@lru_cache(maxsize=8)
def _ship_and_database(key: _ShipKey) -> tuple[Ship, HydroDatabase]:
    # Not the case that is asked about: it must not go on living here.
    case = Case(key.case.file, key.case.folder, key.case.name)
    return case.ship, case.database()
