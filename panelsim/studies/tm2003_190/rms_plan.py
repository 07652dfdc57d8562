"""The plan of a study of RMS motions: which levels are compared in which seas."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from panelsim.case import Case
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.studies.rms_of_runs import rms_of_runs
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.common import in_sea


@dataclass(frozen=True)
class Level:
    """A level of a study: its name, what it amounts to in the study's unit, the keys that make it."""

    name: str
    value: float
    changes: Mapping[str, Any]


@dataclass(frozen=True)
class RmsPlan:
    """Levels in seas, a number of realizations each; `reference` is the index of the level compared with."""

    base: Case
    title: str
    varied: str
    levels: tuple[Level, ...]
    reference: int
    seas: tuple[StudySea, ...]
    realizations: int
    _made: dict[tuple[int, int, int], Case] = field(default_factory=dict, compare=False, repr=False)

    def case(self, level: int, sea: int, realization: int) -> Case:
        """The case of a run."""
        key = (level, sea, realization)
        if key not in self._made:
            self._made[key] = in_sea(self._level_cases[level], self.seas[sea], realization)
        return self._made[key]

    @cached_property
    def _level_cases(self) -> tuple[Case, ...]:
        return tuple(self.base.changed(level.changes) for level in self.levels)

    @property
    def cases(self) -> tuple[Case, ...]:
        """All runs, sea by sea, so that a study that is stopped has whole seas."""
        levels, seas = range(len(self.levels)), range(len(self.seas))
        return tuple(
            self.case(level, sea, realization)
            for realization in range(self.realizations)
            for sea in seas
            for level in levels
        )

    def read(self, store: RunStore) -> RmsStudy:
        """The RMS of the stored runs."""
        return rms_of_runs(
            store,
            self.case,
            title=self.title,
            varied=self.varied,
            levels=[level.name for level in self.levels],
            values=np.array([level.value for level in self.levels]),
            reference=self.reference,
            seas=self.seas,
            realizations=self.realizations,
        )
