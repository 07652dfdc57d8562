"""The RMS study that stored runs amount to."""

from collections.abc import Callable, Sequence

import numpy as np

from panelsim.case import Case
from panelsim.conventions import FloatArray
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.studies.run_store import RunStore

CaseOf = Callable[[int, int, int], Case]  # level, sea, realization


def rms_of_runs(
    store: RunStore,
    case_of: CaseOf,
    *,
    title: str,
    varied: str,
    levels: Sequence[str],
    values: FloatArray,
    reference: int,
    seas: Sequence[StudySea],
    realizations: int = 1,
) -> RmsStudy:
    """Read the runs of all levels, seas and realizations; all else as `RmsStudy` has it.

    Raises PanelsimError where a run is not stored.
    """
    rms = np.full((len(levels), len(seas), realizations, 6), np.nan)
    failures = []
    for level, sea, realization in np.ndindex(rms.shape[:3]):
        case = case_of(level, sea, realization)
        failure = store.failure(case)
        if failure is None:
            rms[level, sea, realization], failure = store.rms(case)
        if failure is not None:
            failures.append(f"{levels[level]}, {seas[sea].label}, realization {realization + 1}: {failure}")
    return RmsStudy(title, varied, tuple(levels), values, reference, tuple(seas), rms, tuple(failures))
