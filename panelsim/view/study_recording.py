"""Studies of RMS as a rerun recording: how they converge, and the motions behind them."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Protocol

from panelsim.conventions import FloatArray
from panelsim.results.rms_study import RmsStudy


class StoredMotions(Protocol):
    """Motions of a run: `time` (T,) [s], `displacement` (T, 6) [m, rad], `wave_elevation` (T,) [m]."""

    @property
    def time(self) -> FloatArray: ...
    @property
    def displacement(self) -> FloatArray: ...
    @property
    def wave_elevation(self) -> FloatArray: ...


def record_study(
    path: Path, studies: Sequence[RmsStudy], *, title: str, text: str, series: Mapping[str, StoredMotions]
) -> Path:
    """Write studies and the motions of some of their runs as one .rrd file, whole or not at all."""
    raise NotImplementedError
