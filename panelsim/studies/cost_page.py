"""The page of what the runs of a case cost, with its figure and its table, from stored timings."""

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from panelsim.files import write_whole
from panelsim.results.rms_tables import markdown_table
from panelsim.studies.case_cost import LONGEST, CaseCost
from panelsim.studies.cost import CostRow, cost_rows, growth
from panelsim.studies.study_page import PAGE, failures_markdown, setup_markdown, write_page
from panelsim.studies.timing_store import TimingStore
from panelsim.view.cost_picture import Lines, cost_picture

TABLE = "cost.csv"
PICTURE = "cost.png"
MODELS = ("linear", "nonlinear")
# What is varied, and the size of a row that it changes.
VARIED = ("components", "panels")


def write_cost(study: CaseCost, store: TimingStore, folder: Path, *, rounds: int) -> tuple[str, ...]:
    """Write report.md, cost.csv and, where something was varied, cost.png into the folder; times nothing.

    Only the page where nothing could be timed.

    Returns the names of the files. Raises PanelsimError where a round is not stored.
    """
    rows = {what: cost_rows(cases, store, rounds=rounds) for what, cases in study.varied.items()}
    every = [row for of_what in rows.values() for row in of_what]
    lines = _lines(rows)
    taken = "One round" if rounds == 1 else f"The median of {rounds} rounds, in which all runs took turns"
    parts = [
        "What does a simulated second cost? CPU seconds of the time loop, over simulated seconds; compilation"
        f" and set-up apart. {taken}, each run alone.",
        "## Set-up",
        setup_markdown(study.case, {"timed": f"{LONGEST:g} s at most of each run, alone"}),
        "## Result",
        cost_markdown(every),
        growth_in_words(rows),
    ]
    for old in (TABLE, PICTURE):  # those of another page
        (folder / old).unlink(missing_ok=True)
    if any(row.cpu_per_second for row in every):
        write_whole(folder / TABLE, _csv(every).encode())
    if lines:
        cost_picture(lines, folder / PICTURE)
        parts.append(f"![CPU over simulated time]({PICTURE})")
    failures = (f"{row.label}: {row.failure}" for row in every if row.failure is not None)
    write_page(folder, f"Cost: {study.case.name}", [*parts, "## Runs", failures_markdown(failures)])
    return tuple(name for name in (PAGE, TABLE, PICTURE) if (folder / name).is_file())


def cost_markdown(rows: Sequence[CostRow]) -> str:
    """A row a case: sizes, CPU over simulated time, how that scatters, and what compilation took."""
    heads = [
        *("run", "components", "panels", "CPU s a simulated s", "spread"),
        *("times faster than real time", "compilation and set-up [s]"),
    ]
    cells = [
        [
            row.label,
            *(str(row.components), str(row.panels), f"{row.median:.2e}", row.told_spread),
            *(f"{1.0 / row.median:.0f}", f"{row.compilation:.1f}"),
        ]
        if row.cpu_per_second
        else [row.label, *["–"] * 6]
        for row in rows
    ]
    return (
        markdown_table(heads, cells, text_columns=1)
        + "\nSpread: slowest less quickest round, over the median.\n"
    )


def growth_in_words(rows: Mapping[str, Sequence[CostRow]]) -> str:
    """A line for what was varied and each model: the power of the size with which the cost grows."""
    lines = []
    for what in VARIED:
        for model in MODELS:
            of_model = [row for row in rows.get(what, ()) if row.model == model]
            found = growth(of_model, [float(getattr(row, what)) for row in of_model])
            if found is not None:
                lines.append(f"- {model}: CPU time grows as the number of {what} to the power {found.told}.")
    return "\n".join(lines)


def _lines(rows: Mapping[str, Sequence[CostRow]]) -> Lines:
    found = {}
    for what in VARIED:
        timed = [row for row in rows.get(what, ()) if row.cpu_per_second]
        if timed:
            found[what] = {
                model: (
                    np.array([float(getattr(row, what)) for row in timed if row.model == model]),
                    np.array([row.cpu_per_second for row in timed if row.model == model]),
                )
                for model in MODELS
                if any(row.model == model for row in timed)
            }
    return found


def _csv(rows: Sequence[CostRow]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["run", "model", "components", "panels", "round", "cpu_seconds_per_simulated_second"])
    writer.writerows(_csv_rows(rows))
    return text.getvalue()


def _csv_rows(rows: Sequence[CostRow]) -> Iterator[tuple[object, ...]]:
    for row in rows:
        for index, cost in enumerate(row.cpu_per_second):
            yield row.label, row.model, row.components, row.panels, index + 1, repr(cost)
