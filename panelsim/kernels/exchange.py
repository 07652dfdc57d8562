"""What passes between Python and the compiled methods: the hull, poses in, loads out."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import FloatArray
from panelsim.kernels.cut_panels import ROOM_ROWS, TOGETHER
from panelsim.kernels.tables import LANES, PanelTables

# Columns of the exchange: a pose goes in, a load comes out.
TIME, WAVE_FACTOR, DISPLACEMENT, LOAD = 0, 1, 2, 8
EXCHANGE_COLUMNS = LOAD + 6


@dataclass(frozen=True)
class Hull:
    """A hull and how its pressure is integrated: calm water at `waterline` [m] above the CG when upright."""

    panels: PanelTables
    waterline: float
    stretching: str
    rule: str

    @property
    def point_count(self) -> int:
        """How many points the rule visits."""
        first, stop = self.blocks
        return LANES * (stop - first)

    @property
    def blocks(self) -> tuple[int, int]:
        """The blocks of eight points that the rule visits, from the first to the last but one."""
        vertex_blocks, all_blocks = self.panels.first_centre // LANES, len(self.panels.points) // LANES
        return (
            vertex_blocks if self.rule == "panel" else 0,
            vertex_blocks if self.rule == "vertex" else all_blocks,
        )

    @property
    def arguments(self) -> tuple[int, int, int, bool, bool, bool]:
        """What the kernels are told: blocks, first centre, whether panels are cut, centres taken, Wheeler."""
        return (
            *self.blocks,
            self.panels.first_centre,
            self.rule != "panel",
            self.rule != "vertex",
            self.stretching == "wheeler",
        )

    def exchange(self, poses: FloatArray) -> FloatArray:
        """Poses (B, 8) with room for the loads, heave becoming the height of the CG above calm water."""
        exchange = np.zeros((len(poses), EXCHANGE_COLUMNS))
        self.put(poses, exchange)
        return exchange

    def state(self) -> FloatArray:
        """Room for submergence, head and head to cut of every point (3, P), of points that no rule takes."""
        state = np.zeros((3, len(self.panels.points)))
        state[0] = -1.0
        return state

    @property
    def cutting(self) -> tuple[NDArray[np.int32], FloatArray, NDArray[np.int32], FloatArray]:
        """Room for the numbers of cut panels and for four of them; where to look for them; their corners."""
        numbers = np.zeros(len(self.panels.panels), dtype=np.int32)
        return numbers, np.zeros((ROOM_ROWS, TOGETHER)), self.panels.spans, self.panels.corners

    def at_points(self, state: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Copies of submergence, head and the head to interpolate to a cut, from what a kernel has left.

        Wheeler's head at the surface is zero, or minus the second order of the elevation.
        """
        submergence, head, surface_head = state.copy()
        return submergence, head, surface_head if self.stretching == "wheeler" else head.copy()

    def put(self, poses: FloatArray, exchange: FloatArray) -> None:
        """Set the poses of an exchange."""
        exchange[:, :LOAD] = poses
        exchange[:, DISPLACEMENT + 2] -= self.waterline
