"""What goes into a recording at many moments: curves and frames, on the timelines of a run."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from panelsim.conventions import FloatArray, IntArray
from panelsim.view.blueprint import FILM_TIMELINE
from panelsim.view.frames import rows_within

if TYPE_CHECKING:
    import rerun as rr


@dataclass(frozen=True)
class Tape:
    """A stream with the timelines of one run: `sim_time` [s], `film` of the filmed window, and `step`.

    `time` (T,) [s] of the run; `film` is the window [s]. Without `counts_steps` there is no `step`, which
    would set runs of different steps side by side at different moments.
    """

    stream: "rr.RecordingStream"
    time: FloatArray
    film: tuple[float, float]
    counts_steps: bool = True

    def batches(self, rows: IntArray, size: int) -> Iterator[IntArray]:
        """Rows in lots of at most `size`, each wholly inside or wholly outside the film."""
        inside = rows_within(self.time[rows], self.film)
        for part in (rows[~inside], rows[inside]):
            for first in range(0, len(part), size):
                yield part[first : first + size]

    def send(self, entity: str, rows: IntArray, columns: "rr.ComponentColumnList") -> None:
        """Send one value a row, on all timelines that have these rows."""
        import rerun as rr

        seconds = self.time[rows]
        times = [rr.TimeColumn("sim_time", duration=seconds)]
        if self.counts_steps:
            times.append(rr.TimeColumn("step", sequence=rows))
        if rows_within(seconds, self.film).all():
            times.append(rr.TimeColumn(FILM_TIMELINE, duration=seconds))
        self.stream.send_columns(entity, times, columns)

    def send_curve(self, entity: str, rows: IntArray, values: FloatArray, label: str, color: int) -> None:
        """A curve of the values (T,) at these rows; the label carries the unit."""
        import rerun as rr

        self.stream.log(entity, rr.SeriesLines(names=label, colors=color, widths=2.0), static=True)
        for batch in self.batches(rows, len(rows)):
            self.send(entity, batch, rr.Scalars.columns(scalars=values[batch]))
