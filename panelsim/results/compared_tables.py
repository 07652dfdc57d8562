"""Statistics of several runs side by side, as Markdown."""

from collections.abc import Iterator, Mapping, Sequence

from panelsim.conventions import DOF_NAMES
from panelsim.results.statistics import SignalStatistics, Statistics, display_unit

QUANTITIES = {"rms": "RMS", "mean": "mean", "max": "largest", "min": "smallest"}


def compared_markdown(runs: Mapping[str, Statistics]) -> str:
    """A table each of RMS, mean, largest and smallest value, with a column a run; angles in degrees.

    The RMS of every run but the first has its difference from the first behind it, in per cent.
    """
    return "\n".join(f"## {title}\n\n{_table(quantity, runs)}" for quantity, title in QUANTITIES.items())


def _table(quantity: str, runs: Mapping[str, Statistics]) -> str:
    lines = [["", "unit", *runs], ["---", "---", *(["---:"] * len(runs))]]
    for signal in (*DOF_NAMES, "wave_elevation"):
        unit, factor = display_unit(signal)
        values = [getattr(_signal(run, signal), quantity) for run in runs.values()]
        shown = [None if value is None else factor * value for value in values]
        lines.append([signal.replace("_", " "), unit, *_cells(shown, compared=quantity == "rms")])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _signal(run: Statistics, name: str) -> SignalStatistics:
    return run.wave_elevation if name == "wave_elevation" else run.motions[name]


def _cells(values: Sequence[float | None], *, compared: bool) -> Iterator[str]:
    first = values[0]
    for number, value in enumerate(values):
        if value is None:
            yield "–"
        elif compared and number and first:
            yield f"{value:z.3f} ({100.0 * (value / first - 1.0):+z.1f} %)"
        else:
            yield f"{value:z.3f}"
