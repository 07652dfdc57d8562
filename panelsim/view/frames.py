"""Which part of a run is worth looking at closely, and the instants at which it is drawn."""

import numpy as np

from panelsim.conventions import Dof, FloatArray, IntArray
from panelsim.motion.history import BoolArray, History

# Waves and roll of a ship take 5 to 15 s: two and a half pictures a second still move smoothly.
SECONDS_A_FRAME = 0.4
# The rest of the frames are strewn over the whole run, so that every moment shows some picture.
FILM_SHARE = 0.85


def liveliest_window(history: History, length: float) -> tuple[float, float]:
    """Start and end [s] of the window of this length [s] around the moment when the deck slopes most.

    The window lies within the run and, where the run is long enough, after its ramp.
    """
    rows = np.flatnonzero(history.finite)
    if not len(rows):
        return float(history.time[0]), float(history.time[0])
    after_ramp = rows[history.time[rows] >= history.attrs["ramp"]]
    if len(after_ramp) and history.time[rows[-1]] - history.attrs["ramp"] >= length:
        rows = after_ramp
    return window_of_steepest_deck(history.time[rows], history.displacement[rows], length)


def window_of_steepest_deck(time: FloatArray, displacement: FloatArray, length: float) -> tuple[float, float]:
    """Start and end [s] of the window of this length [s] within `time` (T,) where the deck slopes most.

    `displacement` (T, 6) in rad and m; all of `time` where it is no longer than that.
    """
    first, last = float(time[0]), float(time[-1])
    if last - first <= length:
        return first, last
    roll, pitch = displacement[:, [Dof.ROLL, Dof.PITCH]].T
    summit = time[np.argmin(np.cos(roll) * np.cos(pitch))]
    start = float(np.clip(summit - 0.5 * length, first, last - length))
    return start, start + length


def choose_frames(history: History, frames: int) -> tuple[IntArray, tuple[float, float]]:
    """Rows of the history to draw in 3-D, at most `frames`, and the window [s] that they film.

    A hundred pictures spread over half an hour are a slide show: most of them go into one smooth film of
    the liveliest moment instead. A short run is filmed whole.
    """
    rows = np.flatnonzero(history.finite)
    stride = max(1, round(SECONDS_A_FRAME / history.attrs["time_step"]))
    if len(rows[::stride]) <= frames:
        return rows[::stride], (float(history.time[0]), float(history.time[rows[-1:]].max(initial=0.0)))
    film_count = max(1, round(FILM_SHARE * frames))
    start, stop = liveliest_window(history, (film_count - 1) * stride * float(history.attrs["time_step"]))
    first = int(np.searchsorted(history.time, start))
    film = first + stride * np.arange(film_count)
    strewn = np.linspace(rows[0], rows[-1], frames - film_count).round().astype(np.int64)
    chosen = np.union1d(film[film <= rows[-1]], strewn)
    return chosen, (start, stop)


def rows_within(time: FloatArray, window: tuple[float, float]) -> BoolArray:
    """Whether each time (T,) [s] lies in the window, its ends included up to round-off."""
    return (time >= window[0] - 1e-9) & (time <= window[1] + 1e-9)
