"""TM 2003-190 section 8.4: CPU time over simulated time, Table 4, and how it grows."""

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.results.rms_tables import markdown_table
from panelsim.studies.cost import CostRow, cost_rows, measure_costs
from panelsim.studies.run_store import RunStore
from panelsim.studies.timing_store import TimingStore
from panelsim.studies.tm2003_190.common import BOW_QUARTERING
from panelsim.studies.tm2003_190.mesh import PANEL_AREAS
from panelsim.studies.tm2003_190.section import Section, Statement

# Table 4: CPU over simulated time by components, on a Pentium III of 800 MHz.
TABLE_4 = {
    "linear": {19: 0.019, 37: 0.027, 160: 0.084},
    "nonlinear": {19: 0.254, 37: 0.435, 160: 1.636},
}
LESS = 250.0  # times less CPU than the report is what nonlinear runs have to take
SEED = 1001
DEFAULT_STEP = 0.4  # s: that of a new case of this ship, and of the example
SHORT_CRESTED = 160
# cos² over ±90°, in steps of 20°. Of 19 frequencies and 9 directions the rule of the report, a millionth of
# the energy, leaves 162 here, two of which have 3.2 millionths.
SPREADING = {
    "seaway.spreading": {"kind": "cosine-squared", "spreading_angle_deg": 90.0},
    "seaway.direction_step_deg": 20.0,
    "seaway.drop_below": 3.5e-6,
}
SEAS: Mapping[int, Mapping[str, object]] = {
    19: {},
    37: {"seaway.frequencies.step": 0.05},
    SHORT_CRESTED: SPREADING,
}


@dataclass(frozen=True)
class Cost:
    """Runs of Table 4 timed one at a time, alone; each `seconds` long, `rounds` times."""

    base: Case
    seconds: float
    rounds: int
    key: str = "cost"

    @property
    def cases(self) -> Sequence[Case]:
        return ()

    @cached_property
    def of_table(self) -> dict[str, Case]:
        """The six runs of Table 4, in sea state 7."""
        return {
            f"{components}, {model}": self._case(model, changes)
            for components, changes in SEAS.items()
            for model in TABLE_4
        }

    @cached_property
    def of_meshes(self) -> dict[str, Case]:
        """Nonlinear runs on the three meshes, 19 components."""
        return {f"{area:g} m²": self._case("nonlinear", {"ship.panel_area": area}) for area in PANEL_AREAS}

    @cached_property
    def of_default_step(self) -> dict[str, Case]:
        """The nonlinear runs of Table 4 with the step that our scheme takes by default."""
        return {
            f"{components}, nonlinear, {DEFAULT_STEP:g} s": self._case(
                "nonlinear", {**changes, "run.time_step": DEFAULT_STEP}
            )
            for components, changes in SEAS.items()
        }

    def _case(self, model: str, changes: Mapping[str, object]) -> Case:
        return self.base.changed(
            {
                "seaway.wave_heading_deg": BOW_QUARTERING,
                "seaway.seed": SEED,
                "run.duration": self.seconds,
                "run.model": model,
                **changes,
            }
        )

    @property
    def _all(self) -> list[Case]:
        return [*self.of_table.values(), *self.of_default_step.values(), *self.of_meshes.values()]

    def is_measured(self, store: RunStore) -> bool:
        timings = TimingStore(store.folder)
        return all(
            timings.failure(case) is not None or len(timings.timings(case)) >= self.rounds
            for case in self._all
        )

    def measure(self, store: RunStore) -> None:
        measure_costs(self._all, TimingStore(store.folder), rounds=self.rounds)

    def section(self, store: RunStore, folder: Path) -> Section:
        timings = TimingStore(store.folder)
        table, longer, meshes = (
            cost_rows(of, timings, rounds=self.rounds)
            for of in (self.of_table, self.of_default_step, self.of_meshes)
        )
        return Section(
            self.key,
            "Cost (8.4)",
            "How much CPU time does a second of sea take?",
            "Sea state 7 (H_s 7.5 m, T_p 15 s), 150°, 20 knots, medium mesh, step 0.2 s, long-crested seas of"
            " 19 and 37 components, and a short-crested one with those directions and frequencies of the"
            f" report whose energy is not negligible. They are {SHORT_CRESTED} there and here; its rule, more"
            " than a millionth of the energy, leaves 162 here, so the two with the least, 3.2 millionths, are"
            f" left out. Each run, {self.seconds:g} s after a ramp of {self.base.file.run.ramp:g} s, was made"
            f" {self.rounds} times, one at a time and all in turn; the median counts. Compilation, once a"
            " process, is told apart. The report's machine was a Pentium III of 800 MHz.",
            _body(table, longer, meshes),
            (cost_statement(table),),
            tables={"cost.csv": _csv((*table, *longer, *meshes))},
            failures=tuple(
                f"{row.label}: {row.failure}" for row in (*table, *longer, *meshes) if row.failure
            ),
        )


def cost_statement(rows: Sequence[CostRow]) -> Statement:
    """Nonlinear runs take so many times less CPU than those of the report: the median of the rounds."""
    nonlinear = {row.components: row for row in rows if row.model == "nonlinear" and not row.failure}
    known = {count: row for count, row in nonlinear.items() if count in SEAS}
    figures = ", ".join(
        f"{_published(row) / row.median:.0f} times{_range(row)} at {n}" for n, row in known.items()
    )
    return Statement(
        f"Nonlinear runs take at least {LESS:g} times less CPU than in Table 4, at 19, 37 and 160 components",
        set(known) == set(SEAS) and all(_published(row) / row.median >= LESS for row in known.values()),
        f"{figures}; at least {LESS:g} in the median of the rounds",
        " ".join(_doubts(known)),
    )


def _doubts(known: Mapping[int, CostRow]) -> list[str]:
    """What was not timed, and where the rounds lie on both sides of the threshold."""
    told = ["Some runs could not be timed."] if set(known) != set(SEAS) else []
    times = {count: [_published(row) / cost for cost in row.cpu_per_second] for count, row in known.items()}
    unsure = [f"{count}" for count, of in times.items() if min(of) < LESS <= max(of)]
    if unsure:
        told.append(f"At {' and '.join(unsure)} the rounds lie on both sides of it.")
    return told


def _published(row: CostRow) -> float:
    """What Table 4 has for a run; NaN if it has none."""
    return TABLE_4[row.model].get(row.components, np.nan)


def _range(row: CostRow) -> str:
    """Least and most of the rounds, of how many times less than in the report."""
    times = [_published(row) / cost for cost in row.cpu_per_second]
    return f" ({min(times):.0f} to {max(times):.0f})" if len(times) > 1 else ""


def _body(table: Sequence[CostRow], longer: Sequence[CostRow], meshes: Sequence[CostRow]) -> str:
    steps = ["0.2"] * len(table) + [f"{DEFAULT_STEP:g}"] * len(longer)
    rows = [
        [
            row.model,
            step,
            f"{row.components}",
            f"{_published(row):g}",
            f"{row.median:.2g}",
            row.told_spread,
            f"{_published(row) / row.median:.0f}{_range(row)}",
        ]
        for row, step in zip((*table, *longer), steps, strict=True)
        if not row.failure
    ]
    heads = ["model", "step [s]", "components", "the report", "here", "spread", "times less (rounds)"]
    by_mesh = [[row.label, f"{row.panels}", f"{row.median:.2g}", row.told_spread] for row in meshes]
    compilation = max((row.compilation for row in (*table, *meshes) if not row.failure), default=0.0)
    return (
        "CPU seconds over simulated seconds:\n\n"
        + markdown_table(heads, rows, text_columns=1)
        + f"\nThe report's step is 0.2 s; ours is {DEFAULT_STEP:g} s by default. Spread: slowest less"
        f" quickest round, over the median. Compilation and set-up: up to {compilation:.1f} s."
        "\n\n### Growth\n\n"
        + markdown_table(["panels of", "panels", "CPU over simulated", "spread"], by_mesh, text_columns=1)
        + f"\n{growth_told(table, meshes)}\n"
    )


def growth_told(table: Sequence[CostRow], meshes: Sequence[CostRow]) -> str:
    """How cost grows from each size to the next.

    Of components only the ratios: the seas are unlike, the last is short-crested, and a part of the cost does
    not depend on them.
    """
    of_panels = [
        f"{more.median / less.median:.2f} times from {less.panels} to {more.panels} panels (power"
        f" {np.log(more.median / less.median) / np.log(more.panels / less.panels):.2f})"
        for less, more in _steps(meshes, lambda row: row.panels)
    ]
    nonlinear = [row for row in table if row.model == "nonlinear"]
    of_components = [
        f"{more.median / less.median:.2f} times from {less.components} to {more.components} components"
        for less, more in _steps(nonlinear, lambda row: row.components)
    ]
    told = ", ".join((*of_panels, *of_components))
    short = (
        " The sea of most components is short-crested, the others are long-crested." if of_components else ""
    )
    return f"The time of a nonlinear run grows {told}.{short}" if told else ""


def _steps(rows: Sequence[CostRow], size: Callable[[CostRow], int]) -> list[tuple[CostRow, CostRow]]:
    """Neighbours by size, of those that were timed."""
    known = sorted((row for row in rows if not row.failure), key=size)
    return [(less, more) for less, more in pairwise(known) if size(less) < size(more)]


def _csv(rows: Sequence[CostRow]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["run", "model", "components", "panels", "round", "CPU over simulated time"])
    for row in rows:
        for number, cost in enumerate(row.cpu_per_second, start=1):
            writer.writerow([row.label, row.model, row.components, row.panels, number, repr(cost)])
    return text.getvalue()
