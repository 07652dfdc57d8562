"""The direct method: every wave at every point of the hull."""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.kernels import runtime
from panelsim.kernels.direct_kernel import COMPONENT_COLUMNS, CREST, integrate_directly
from panelsim.kernels.exchange import LOAD, Hull
from panelsim.kernels.tables import WaveTables


class DirectMethod:
    """Seas about one hull, summed directly: all of first order, or all of second."""

    def __init__(self, hull: Hull, seas: Sequence[WaveTables]) -> None:
        self._hull, self._second_order = hull, bool(seas[0].second_order)
        counts = [len(sea.columns) for sea in seas]
        self._components = np.zeros((sum(counts), COMPONENT_COLUMNS))
        self._components[:, :CREST] = np.concatenate([sea.columns for sea in seas])
        stops = np.cumsum(counts)
        self._ranges = np.column_stack([stops - counts, stops])
        self._prepare(np.zeros((len(seas), 8)))

    def heads(self, poses: FloatArray) -> FloatArray:
        """Loads (B, 6) over ρ g; a single sea serves any number of poses (B, 8)."""
        if len(poses) != len(self._exchange):
            self._prepare(poses)
        self._hull.put(poses, self._exchange)
        self._launch()
        return self._exchange[:, LOAD:].copy()

    def at_points(self, poses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Submergence and heads of the points (P,) at a single pose."""
        self.heads(poses)
        return self._hull.at_points(self._state)

    def _prepare(self, poses: FloatArray) -> None:
        self._exchange = self._hull.exchange(poses)
        self._state = self._hull.state()
        ranges = np.ascontiguousarray(np.broadcast_to(self._ranges, (len(poses), 2)), dtype=np.int32)
        self._launch = runtime.Launch(
            integrate_directly,
            self._hull.panels.blocks[self._hull.rule],
            self._hull.panels.panels,
            self._components,
            ranges,
            self._state,
            *self._hull.cutting,
            self._exchange,
            *self._hull.arguments,
            self._second_order,
        )
