"""Runs of a ship whose heave and pitch are held by stiff springs: what these make of the other motions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from panelsim.case import Case
from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.hull.form import load_hull
from panelsim.results.rms_tables import markdown_table
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.model_causes import SLOW, Pair

# Some thirty times the stiffness of the water; damped so that she does not shake on them.
SPRINGS = {"heave": 4e8, "pitch": 4e11}  # N/m, N m/rad
DAMPERS = {"heave": 8e7, "pitch": 8e10}  # N/(m/s), N m/(rad/s)


@dataclass(frozen=True)
class Held:
    """A free pair of runs and the same with heave and pitch held."""

    free: Pair
    held: Pair

    def finished(self, store: RunStore) -> bool:
        """Whether all four runs are there to their end."""
        return self.free.finished(store) and self.held.finished(store)


def held(pair: Pair) -> Held:
    """The pair beside one whose ship is held by the springs."""
    return Held(pair, Pair(pair.sea, _held(pair.linear), _held(pair.nonlinear)))


def _held(case: Case) -> Case:
    """The case with the springs, and with half of its step, as their natural period is 0.9 s."""
    # Those of the case are asked of its ship, which takes longer to build than all of the page.
    own = load_hull(case.file.ship.hull).supplementary
    return case.changed(
        {
            "supplementary.stiffness": {**own["stiffness"], **SPRINGS},
            "supplementary.damping": {**own["damping"], **DAMPERS},
            "run.time_step": 0.5 * case.file.run.time_step,
        }
    )


def what_stays(realizations: Sequence[Held], store: RunStore) -> FloatArray:
    """Variance (6,) of the difference of the models with heave and pitch held, over that of the free ship.

    Both are means over the realizations; NaN where one did not finish.
    """
    if not realizations or not all(one.finished(store) for one in realizations):
        return np.full(6, np.nan)
    free, kept = (
        np.mean([_variance_between(pair, store) for pair in pairs], axis=0)
        for pairs in ([one.free for one in realizations], [one.held for one in realizations])
    )
    return np.asarray(kept / free)


def _variance_between(pair: Pair, store: RunStore) -> FloatArray:
    linear, nonlinear = (store.load(case) for case in (pair.linear, pair.nonlinear))
    return np.asarray((nonlinear.displacement - linear.displacement)[nonlinear.after_ramp].var(axis=0))


def held_failures(realizations: Sequence[Held], store: RunStore) -> list[str]:
    """A sentence for each held run that did not go to its end."""
    told = []
    for number, one in enumerate(realizations, start=1):
        for case in (one.held.linear, one.held.nonlinear):
            failure = store.failure(case)
            failure = store.load(case).early_end if failure is None else failure
            if failure is not None:
                model = case.file.run.model
                told.append(f"{model}, heave and pitch held, {one.free.sea}, realization {number}: {failure}")
    return told


def held_markdown(found: Mapping[str, FloatArray]) -> str:
    """A table with a row a sea: the variance that stays, in per cent, of surge, sway, roll and yaw."""
    rows = [
        [sea, *("–" if np.isnan(stays[mode]) else f"{100 * stays[mode]:.0f}" for mode in SLOW)]
        for sea, stays in found.items()
    ]
    return markdown_table(["sea", *(f"{DOF_NAMES[mode]} [%]" for mode in SLOW)], rows, text_columns=1)


def held_in_words(stays: FloatArray) -> str:
    """What stays of the difference of each motion, in one line; "" where it is not known."""
    if np.isnan(stays[[*SLOW]]).any():
        return ""
    told = ", ".join(f"{DOF_NAMES[mode]} {100 * stays[mode]:.0f} %" for mode in SLOW)
    return f"with heave and pitch held by stiff springs the variance of the difference that stays is: {told}"
