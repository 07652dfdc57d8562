"""CPU time of runs over the time that they simulate, as TM 2003-190 Table 4 has it, and how it grows."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import linregress

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.studies.case_history import case_history, case_of_text
from panelsim.studies.timing_store import Timing, TimingStore

Progress = Callable[[float, float], None]  # runs timed, runs in all

ROUNDS = 3


@dataclass(frozen=True)
class CostRow:
    """A case that was timed: `cpu_per_second` (R,) of each round, CPU over simulated seconds.

    Compilation and set-up are not in it; `compilation` [s] is the most that any round had of them. A case
    that could not be run has a `failure`, and no rounds.
    """

    label: str
    model: str
    components: int
    panels: int
    cpu_per_second: tuple[float, ...]
    compilation: float
    failure: str | None = None

    @property
    def median(self) -> float:
        """CPU seconds a simulated second; NaN where there are none."""
        return float(np.median(self.cpu_per_second)) if self.cpu_per_second else np.nan

    @property
    def spread(self) -> float:
        """Slowest less quickest round, over the median; NaN where there are no two."""
        return float(np.ptp(self.cpu_per_second)) / self.median if len(self.cpu_per_second) > 1 else np.nan

    @property
    def told_spread(self) -> str:
        """The spread in per cent, or a dash."""
        return "–" if np.isnan(self.spread) else f"{100.0 * self.spread:.0f} %"


@dataclass(frozen=True)
class Growth:
    """CPU time grows as some size to this power; the standard error is NaN for two sizes."""

    exponent: float
    standard_error: float

    @property
    def told(self) -> str:
        error = "" if np.isnan(self.standard_error) else f" ± {self.standard_error:.2f}"
        return f"{self.exponent:.2f}{error}"


def measure_costs(
    cases: Sequence[Case], store: TimingStore, *, rounds: int = ROUNDS, progress: Progress | None = None
) -> None:
    """Time each case `rounds` times, and keep each round as soon as it is done; what is stored stays.

    In this process, one run at a time and all cases in turn, so that what else the machine does in a while
    falls on all of them alike. A case that cannot be run leaves its message, and the others go on.
    """
    done = 0
    for round_ in range(rounds):
        for case in cases:
            if progress is not None:
                progress(done, rounds * len(cases))
            if len(store.timings(case)) <= round_ and store.failure(case) is None:
                _time(case, store)
            done += 1
    if progress is not None:
        progress(done, done)


def _time(case: Case, store: TimingStore) -> None:
    try:
        text = case.file.model_dump_json(exclude_none=True)
        history = case_history(*case_of_text(text, case.folder, case.name))
    except PanelsimError as error:
        store.save_failure(case, str(error))
        return
    if history.outcome == "interrupted":
        raise KeyboardInterrupt
    if history.outcome != "finished":
        store.save_failure(case, f"{history.outcome}: {history.attrs['outcome_detail']}")
        return
    store.add(case, Timing.of_history(history))


def cost_rows(cases: Mapping[str, Case], store: TimingStore, *, rounds: int = ROUNDS) -> tuple[CostRow, ...]:
    """What was timed, a row a case by its label; runs nothing.

    Raises PanelsimError for a case of which fewer rounds are stored.
    """
    return tuple(_row(label, case, store, rounds) for label, case in cases.items())


def _row(label: str, case: Case, store: TimingStore, rounds: int) -> CostRow:
    model, failure = case.file.run.model, store.failure(case)
    if failure is not None:
        return CostRow(label, model, 0, 0, (), np.nan, failure)
    timings = store.timings(case)[:rounds]
    if len(timings) < rounds:
        raise PanelsimError(
            "A run of the study has not been timed",
            got=f"{label}: {len(timings)} of {rounds} rounds in {store.folder}",
            remedy="run the study, it goes on where it was",
        )
    return CostRow(
        label,
        model,
        timings[0].components,
        timings[0].panels,
        tuple(timing.cpu_seconds / timing.simulated_seconds for timing in timings),
        max(timing.jit_seconds for timing in timings),
    )


def growth(rows: Sequence[CostRow], sizes: Sequence[float]) -> Growth | None:
    """Power of the sizes with which the cost of the rows grows; None where no two sizes were timed."""
    known = [(size, row.median) for size, row in zip(sizes, rows, strict=True) if row.cpu_per_second]
    if len({size for size, _ in known}) < 2:
        return None
    size, cost = np.log(np.array(known)).T
    line = linregress(size, cost)
    return Growth(float(line.slope), float(line.stderr) if len(known) > 2 else np.nan)
