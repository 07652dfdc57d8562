"""The statistics of a run as a table: on a terminal with rich, and as Markdown for pages and recordings."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from panelsim.results.statistics import SignalStatistics, Statistics, display_unit

if TYPE_CHECKING:
    from rich.table import Table

HEADER = ("motion", "unit", "mean", "RMS", "max", "min", "zero-crossing period [s]")


Signals = Mapping[str, SignalStatistics]


def statistics_table(statistics: Statistics) -> "Table":
    """A rich table of the six motions and the wave at the moving origin, angles in degrees."""
    return _table(f"From the ramp to the end, {statistics.duration:g} s", _motions(statistics))


def point_table(statistics: Statistics, point: str) -> "Table":
    """A rich table of what a named point of the ship does."""
    return _table(point, statistics.points[point])


def statistics_markdown(statistics: Statistics) -> str:
    """The table of motions as Markdown."""
    return _markdown(_motions(statistics))


def point_markdown(statistics: Statistics, point: str) -> str:
    """The table of a named point as Markdown."""
    return _markdown(statistics.points[point])


def _motions(statistics: Statistics) -> Signals:
    return statistics.motions | {"wave_elevation": statistics.wave_elevation}


def _table(title: str, signals: Signals) -> "Table":
    from rich.table import Table
    from rich.text import Text

    table = Table(title=title)
    for column in HEADER:
        # As text: "[s]" would be taken for markup.
        table.add_column(Text(column), justify="left" if column in ("motion", "unit") else "right")
    for row in _rows(signals):
        table.add_row(*row)
    return table


def _markdown(signals: Signals) -> str:
    lines = [HEADER, ("---", "---", "---:", "---:", "---:", "---:", "---:"), *_rows(signals)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _rows(signals: Signals) -> Iterator[tuple[str, ...]]:
    for name, values in signals.items():
        unit, factor = display_unit(name)
        amounts = (values.mean, values.rms, values.max, values.min)
        cells = ["–" if v is None else f"{factor * v:z.3f}" for v in amounts]
        period = values.zero_crossing_period
        yield (name.replace("_", " "), unit, *cells, "–" if period is None else f"{period:.2f}")
