"""Motions of several runs of a study in one plot each, thinned to what a screen shows."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

import numpy as np

from panelsim.conventions import DOF_NAMES, FloatArray, IntArray
from panelsim.results.statistics import display_unit
from panelsim.view.frames import rows_within, window_of_steepest_deck

if TYPE_CHECKING:
    import rerun as rr

# The waves as the last plot: what the runs had in common.
SIGNALS = (*DOF_NAMES, "wave_elevation")
# Of the runs that are drawn one over the other; told apart on a dark and on a light background.
RUN_COLORS = (0x3FA7D6FF, 0xF28E2BFF, 0x59A14FFF, 0xE15759FF, 0xB07CD8FF, 0xC9A227FF, 0x9A9A9AFF, 0x2FB5A5FF)
# This much of the runs is there step by step, where the deck of the first one slopes most.
WINDOW = 120.0  # s
# A pixel of a plot of the window is about as much; nothing finer is kept of it.
FINEST = 0.2  # s
# Outside the window the lowest and the highest value of so many parts of the run are kept: its envelope.
PARTS = 100


class StoredMotions(Protocol):
    """Motions of a run: `time` (T,) [s], `displacement` (T, 6) [m, rad], `wave_elevation` (T,) [m]."""

    @property
    def time(self) -> FloatArray: ...
    @property
    def displacement(self) -> FloatArray: ...
    @property
    def wave_elevation(self) -> FloatArray: ...


def shown_window(series: Mapping[str, StoredMotions]) -> tuple[float, float]:
    """Start and end [s] of what is shown step by step: where the deck of the first run slopes most."""
    run = next(iter(series.values()))
    finite = np.isfinite(run.displacement).all(axis=1)
    if not finite.any():
        return 0.0, WINDOW
    return window_of_steepest_deck(run.time[finite], run.displacement[finite], WINDOW)


def rows_shown(time: FloatArray, values: FloatArray, window: tuple[float, float]) -> IntArray:
    """Rows of a signal (T,) that are kept: in the window one every 0.2 s, outside it the envelope.

    Rows without a finite value are left out.
    """
    finite = np.flatnonzero(np.isfinite(values))
    inside = rows_within(time[finite], window)
    close, rest = finite[inside], finite[~inside]
    step = np.diff(time).min(initial=FINEST)
    close = close[:: max(1, int(np.floor(FINEST / step + 1e-6)))]
    if len(rest) <= 2 * PARTS:
        return np.union1d(close, rest)
    parts = np.array_split(rest, PARTS)
    lowest = [part[np.argmin(values[part])] for part in parts]
    highest = [part[np.argmax(values[part])] for part in parts]
    return np.unique(np.concatenate([close, lowest, highest]))


def send_histories(stream: "rr.RecordingStream", series: Mapping[str, StoredMotions]) -> None:
    """Every motion and the wave of every run, `histories/SIGNAL/RUN` on the timeline `sim_time`."""
    import rerun as rr

    window = shown_window(series)
    for order, (name, run) in enumerate(series.items()):
        color = RUN_COLORS[order % len(RUN_COLORS)]
        for signal, raw in zip(SIGNALS, [*run.displacement.T, run.wave_elevation], strict=True):
            unit, factor = display_unit(signal)
            entity = f"histories/{signal}/{rr.escape_entity_path_part(name)}"
            rows = rows_shown(run.time, raw, window)
            style = rr.SeriesLines(names=f"{name} [{unit}]", colors=color, widths=1.5)
            stream.log(entity, style, static=True)
            seconds = rr.TimeColumn("sim_time", duration=run.time[rows])
            stream.send_columns(entity, [seconds], rr.Scalars.columns(scalars=factor * raw[rows]))
