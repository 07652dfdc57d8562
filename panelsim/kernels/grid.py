"""The grid method: the waves at the points of the hull from a grid that moves with the ship (`wave_grid`)."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import FloatArray
from panelsim.kernels import runtime
from panelsim.kernels import wave_grid as at
from panelsim.kernels.exchange import DISPLACEMENT, LOAD, Hull
from panelsim.kernels.grid_kernel import integrate_on_grid
from panelsim.kernels.hull_box import SECTOR, hull_box, hull_tolerance
from panelsim.kernels.tables import LANES, WaveTables

SECTORS = round(2.0 * np.pi / SECTOR)
SURGE, SWAY, YAW = DISPLACEMENT, DISPLACEMENT + 1, DISPLACEMENT + 5


class GridMethod:
    """Seas about one hull, each on a grid whose axes follow the heading of the ship, a sector at a time.

    Which grid a pose takes depends on the pose alone, so that a run can be taken up again where it was left.
    """

    def __init__(self, hull: Hull, seas: Sequence[WaveTables], tolerance: float) -> None:
        self._hull, self._tolerance = hull, tolerance
        self._seas = [sea.felt() for sea in seas]
        self._grids: dict[tuple[int, int], at.WaveGrid] = {}
        self._arrange(np.zeros(len(seas), dtype=np.int64))

    def heads(self, poses: FloatArray) -> FloatArray:
        """Loads (B, 6) over ρ g; a single sea serves any number of poses (B, 8)."""
        sectors = np.rint(poses[:, YAW] / SECTOR).astype(np.int64) % SECTORS
        if sectors.tobytes() != self._arranged:
            self._arrange(sectors)
        if self._turns:
            poses = _turned(poses, sectors * SECTOR)
        if len(self._launched) == 1:
            return self._launched[0][1].heads(poses)
        loads = np.empty((len(poses), 6))
        for members, launched in self._launched:
            loads[members] = launched.heads(poses[members])
        return loads

    def at_points(self, poses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Submergence and heads of the points (P,) at a single pose."""
        self.heads(poses)
        return self._hull.at_points(self._launched[0][1].state)

    def _arrange(self, sectors: NDArray[np.int64]) -> None:
        """Launch together the poses whose grids are of one make."""
        self._arranged, self._turns = sectors.tobytes(), bool(sectors.any())
        seas = np.broadcast_to(np.arange(len(self._seas)), len(sectors))
        grids = [self._grid(int(sea), int(sector)) for sea, sector in zip(seas, sectors, strict=True)]
        self._launched = [
            (members, _Launched(self._hull, [grids[i] for i in members])) for members in _of_one_make(grids)
        ]

    def _grid(self, sea: int, sector: int) -> at.WaveGrid:
        """The grid of a sea for headings in a sector, built when it is first asked for."""
        if (sea, sector) not in self._grids:
            waves = self._seas[sea].turned(sector * SECTOR)
            box = hull_box(self._hull.panels.points, self._hull.waterline, waves.standard_deviation)
            tolerance = hull_tolerance(self._hull.panels.points, waves, self._tolerance)
            self._grids[sea, sector] = at.wave_grid(waves, box, tolerance, self._hull.point_count)
        return self._grids[sea, sector]


def _of_one_make(grids: Sequence[at.WaveGrid]) -> list[list[int]]:
    """Which grids one launch can take: of one kind, as many depth terms, in no more rows than it counts."""
    parts: list[list[int]] = []
    for make in dict.fromkeys((grid.plan.kind, grid.plan.depth.terms) for grid in grids):
        rows = at.MOST_ROWS
        for i, grid in enumerate(grids):
            if (grid.plan.kind, grid.plan.depth.terms) == make:
                if rows + len(grid.tables) > at.MOST_ROWS:
                    parts.append([])
                    rows = 0
                parts[-1].append(i)
                rows += len(grid.tables)
    return parts


class _Launched:
    """Poses on grids of one kind, with as many depth terms."""

    def __init__(self, hull: Hull, grids: Sequence[at.WaveGrid]) -> None:
        self._hull = hull
        self._exchange = hull.exchange(np.zeros((len(grids), 8)))
        self.state = hull.state()
        each = {id(grid): grid for grid in grids}  # poses in one sea share its grid
        components, tables, starts = at.stacked(list(each.values()))
        self._launch = runtime.Launch(
            integrate_on_grid,
            hull.panels.blocks[hull.rule],
            hull.panels.panels,
            components,
            tables,
            starts[[list(each).index(id(grid)) for grid in grids]],
            np.zeros((max(grid.scratch_rows for grid in grids), LANES)),
            self.state,
            *hull.cutting,
            self._exchange,
            *hull.arguments,
            grids[0].plan.depth.terms,
            grids[0].plan.kind == "line",
        )

    def heads(self, poses: FloatArray) -> FloatArray:
        """Loads (B, 6) over ρ g."""
        self._hull.put(poses, self._exchange)
        self._launch()
        return self._exchange[:, LOAD:]


def _turned(poses: FloatArray, angle: FloatArray) -> FloatArray:
    """Poses (B, 8) seen from axes turned by `angle` (B,) about the vertical [rad]."""
    turned, cos, sin = poses.copy(), np.cos(angle), np.sin(angle)
    turned[:, SURGE] = poses[:, SURGE] * cos + poses[:, SWAY] * sin
    turned[:, SWAY] = poses[:, SWAY] * cos - poses[:, SURGE] * sin
    turned[:, YAW] -= angle
    return turned
