"""The run of a case: from its description to its history, and many cases one after another."""

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.case.schema import CaseFile
from panelsim.hydro.database import HydroDatabase
from panelsim.motion.history import History
from panelsim.motion.march import Progress
from panelsim.motion.simulate import simulate
from panelsim.ship.ship import Ship


def case_history(
    case: Case, database: HydroDatabase, *, resume: History | None = None, progress: Progress | None = None
) -> History:
    """Simulate a case with its coefficients; `resume` and `progress` are those of `simulate`.

    Raises PanelsimError for a case that cannot be run.
    """
    run = case.file.run
    return simulate(
        case.ship,
        case.seaway,
        speed=case.speed,
        duration=run.duration,
        time_step=run.time_step,
        database=database,
        model=run.model,
        inertia=run.inertia,
        stepper=run.stepper,
        ramp=run.ramp,
        stretching=case.file.seaway.stretching,
        pressure_method=run.pressure_method,
        pressure_rule=run.pressure_rule,
        supplementary=case.supplementary,
        roll_damping=case.roll_damping(database),
        transom=case.transom(database),
        capsize_angle=float(np.deg2rad(run.capsize_angle_deg)),
        progress=progress,
        case=case.resolved(),
        seed=case.file.seaway.seed if case.file.seaway.kind == "random" else None,
        notes=case.warnings(),
        points=case.points,
        resume=resume,
    )


def history_of_text(text: str, folder: Path, name: str) -> History:
    """The history of a case that came as JSON text, as it comes to another process.

    Cases with the same ship and coefficients share them. Raises PanelsimError as `case_history` does.
    """
    file = CaseFile.model_validate_json(text)
    shared = _ShipKey(file, folder, name)
    case = Case(file, folder, name)
    case.__dict__["ship"], database = _ship_and_database(shared)
    return case_history(case, database)


@dataclass(frozen=True)
class _ShipKey:
    """A case, equal to all others of the same ship with the same coefficients."""

    file: CaseFile = field(compare=False)
    folder: Path
    name: str = field(compare=False)
    sections: str = field(init=False)

    def __post_init__(self) -> None:
        sections = self.file.ship.model_dump_json() + self.file.hydrodynamics.model_dump_json()
        object.__setattr__(self, "sections", sections)


@lru_cache(maxsize=8)
def _ship_and_database(key: _ShipKey) -> tuple[Ship, HydroDatabase]:
    case = Case(key.file, key.folder, key.name)
    return case.ship, case.database()
