"""The statistics of a run as a table: on a terminal with rich, and as Markdown for pages and recordings."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from panelsim.results.statistics import Statistics, display_unit

if TYPE_CHECKING:
    from rich.table import Table

HEADER = ("motion", "unit", "mean", "RMS", "max", "min", "zero-crossing period [s]")


def statistics_table(statistics: Statistics) -> "Table":
    """A rich table of the six motions and the wave at the moving origin, angles in degrees."""
    from rich.table import Table
    from rich.text import Text

    table = Table(title=f"From the ramp to the end, {statistics.duration:g} s")
    for column in HEADER:
        # As text: "[s]" would be taken for markup.
        table.add_column(Text(column), justify="left" if column in ("motion", "unit") else "right")
    for row in _rows(statistics):
        table.add_row(*row)
    return table


def statistics_markdown(statistics: Statistics) -> str:
    """The same table as Markdown."""
    lines = [HEADER, ("---", "---", "---:", "---:", "---:", "---:", "---:"), *_rows(statistics)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _rows(statistics: Statistics) -> Iterator[tuple[str, ...]]:
    for name, values in [*statistics.motions.items(), ("wave_elevation", statistics.wave_elevation)]:
        unit, factor = display_unit(name)
        amounts = (values.mean, values.rms, values.max, values.min)
        cells = ["–" if v is None else f"{factor * v:z.3f}" for v in amounts]
        period = values.zero_crossing_period
        yield (name.replace("_", " "), unit, *cells, "–" if period is None else f"{period:.2f}")
