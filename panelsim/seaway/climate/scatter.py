"""Scatter tables: how often which wave height comes with which peak period."""

from dataclasses import dataclass
from functools import cache, cached_property
from numbers import Integral, Real

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.climate.bundled import bundled_rows
from panelsim.seaway.steepness import nominal_steepness


@dataclass(frozen=True, eq=False)
class ScatterTable:
    """Joint occurrence of significant wave height (H,) [m] and peak period (T,) [s].

    Both are the centres of cells, rising; `observations` (H, T) counts, halves allowed, 0 where none.
    Cells reach half way to the neighbouring centres, the outer ones as far outward as inward. A value on
    an edge belongs to the lower cell.

    Raises PanelsimError for centres that are not positive or do not rise, counts that are negative or not
    finite, shapes that do not fit, and a table without observations.
    """

    significant_wave_height: FloatArray
    peak_period: FloatArray
    observations: FloatArray

    def __post_init__(self) -> None:
        for name in ("significant_wave_height", "peak_period", "observations"):
            try:
                values = np.array(getattr(self, name), dtype=float)
            except (TypeError, ValueError):
                raise PanelsimError(
                    f"The scatter table's {name} is no array of numbers", got=repr(getattr(self, name))[:60]
                ) from None
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        for name, centres in (
            ("significant_wave_height", self.significant_wave_height),
            ("peak_period", self.peak_period),
        ):
            _require_centres(name, centres)
        self._require_observations()

    def _require_observations(self) -> None:
        counts, shape = self.observations, (len(self.significant_wave_height), len(self.peak_period))
        if counts.shape != shape:
            raise PanelsimError(
                "The observations do not fit the heights and periods", got=counts.shape, allowed=shape
            )
        bad = np.argwhere(~(np.isfinite(counts) & (counts >= 0)))
        if len(bad):
            h, t = bad[0]
            raise PanelsimError(
                "A number of observations is negative or not finite",
                got=f"{counts[h, t]:g} at H_s {self.significant_wave_height[h]:g} m,"
                f" T_p {self.peak_period[t]:g} s",
                allowed="0 or more",
            )
        if not counts.any():
            raise PanelsimError("The scatter table holds no observations", allowed="at least one")

    @property
    def total(self) -> float:
        """Number of observations."""
        return float(self.observations.sum())

    @cached_property
    def height_edges(self) -> FloatArray:
        """Edges (H + 1,) of the cells [m]."""
        return _edges(self.significant_wave_height)

    @cached_property
    def period_edges(self) -> FloatArray:
        """Edges (T + 1,) of the cells [s]."""
        return _edges(self.peak_period)

    @property
    def probabilities(self) -> FloatArray:
        """Share of all observations in each cell (H, T)."""
        return self.observations / self.total

    @property
    def height_probabilities(self) -> FloatArray:
        """Share of all observations at each height (H,), whatever the period."""
        return self.probabilities.sum(axis=1)

    @property
    def period_probabilities(self) -> FloatArray:
        """Share of all observations at each peak period (T,), whatever the height."""
        return self.probabilities.sum(axis=0)

    def probability(self, significant_wave_height: float, peak_period: float) -> float:
        """Share of all observations in the cell that holds this height [m] and peak period [s].

        Raises PanelsimError outside the table.
        """
        return float(self.probabilities[self._row(significant_wave_height), self._column(peak_period)])

    def period_distribution(self, significant_wave_height: float) -> FloatArray:
        """Shares (T,) of the peak periods among the observations of the cell that holds this height [m].

        Raises PanelsimError outside the table and where no sea of that height was observed.
        """
        counts = self.observations[self._row(significant_wave_height)]
        if not counts.any():
            observed = self.significant_wave_height[self.observations.any(axis=1)]
            raise PanelsimError(
                "No sea of this height was observed",
                got=f"{significant_wave_height:g} m",
                allowed=f"a cell with observations: {', '.join(f'{height:g}' for height in observed)} m",
            )
        return counts / counts.sum()

    def mean_peak_period(self, significant_wave_height: float) -> float:
        """Mean [s] of the peak periods observed with this height [m], see `period_distribution`."""
        return float(self.period_distribution(significant_wave_height) @ self.peak_period)

    def height_exceedance(self, significant_wave_height: float) -> float:
        """Share of all observations above this height [m]; those of a cell lie evenly over its heights.

        Raises PanelsimError outside the table.
        """
        self._row(significant_wave_height)
        # Summed from the top, so that the rare high seas keep their digits.
        above = np.append(np.cumsum(self.height_probabilities[::-1])[::-1], 0.0)
        return float(np.interp(significant_wave_height, self.height_edges, above))

    @property
    def steepness(self) -> FloatArray:
        """Nominal steepness (H, T) of the centre of each occupied cell, TM 2003-190 (56); else NaN."""
        steepness = [
            [nominal_steepness(height, period) for period in self.peak_period]
            for height in self.significant_wave_height
        ]
        return np.where(self.observations > 0, steepness, np.nan)

    @property
    def steepest(self) -> FloatArray:
        """Largest `steepness` at each peak period (T,), TM 2003-190 figure 5; NaN where none observed."""
        return np.fmax.reduce(self.steepness, axis=0)

    def sample(self, count: int, seed: int) -> tuple[FloatArray, FloatArray]:
        """Heights [m] and peak periods [s] (count,) of seas drawn by their probability.

        They are cell centres. The cells come from `numpy.random.default_rng(seed).choice`.
        """
        _require_whole("count", count, 1)
        _require_whole("seed", seed, 0)
        cells = np.random.default_rng(seed).choice(
            self.observations.size, size=count, p=self.probabilities.ravel()
        )
        rows, columns = np.unravel_index(cells, self.observations.shape)
        return self.significant_wave_height[rows], self.peak_period[columns]

    def _row(self, significant_wave_height: float) -> int:
        return _cell("significant wave height", "m", self.height_edges, significant_wave_height)

    def _column(self, peak_period: float) -> int:
        return _cell("peak period", "s", self.period_edges, peak_period)


@cache
def north_atlantic() -> ScatterTable:
    """North Atlantic wave scattergram, TM 2003-190 Table 1, adapted there from Bales et al.

    The cells add up to the printed total of 130,339. Half counts are printed so. One observation of 8.5 m
    at 9.7 s stands at 6.5 m, as the report moved it, so that no cell is steeper than Buckley's 0.049.
    """
    header, *rows = bundled_rows("north_atlantic.csv")
    heights = [float(row[0]) for row in rows]
    observations = [[float(cell or 0) for cell in row[1:]] for row in rows]
    return ScatterTable(np.array(heights), np.array(header[1:], dtype=float), np.array(observations))


def _require_centres(name: str, centres: FloatArray) -> None:
    fits = centres.ndim == 1 and len(centres) >= 2
    if not (fits and np.isfinite(centres).all() and centres[0] > 0 and (np.diff(centres) > 0).all()):
        raise PanelsimError(
            f"The scatter table's {name} is no row of cell centres",
            got=centres,
            allowed="at least two finite values, positive and rising",
        )


def _require_whole(name: str, value: int, lowest: int) -> None:
    if isinstance(value, bool) or not isinstance(value, Integral) or value < lowest:
        raise PanelsimError(
            f"{name} is no whole number", got=repr(value), allowed=f"{lowest}, {lowest + 1} …"
        )


def _edges(centres: FloatArray) -> FloatArray:
    """Edges half way between the centres, the outer ones as far out as in, none below 0."""
    middle = 0.5 * (centres[1:] + centres[:-1])
    first, last = 2 * centres[0] - middle[0], 2 * centres[-1] - middle[-1]
    edges = np.concatenate([[max(first, 0.0)], middle, [last]])
    edges.setflags(write=False)
    return edges


def _cell(name: str, unit: str, edges: FloatArray, value: float) -> int:
    """Number of the cell that holds the value; one on an edge belongs to the lower cell."""
    number = isinstance(value, Real) and not isinstance(value, bool)
    if not number or not edges[0] <= value <= edges[-1]:
        raise PanelsimError(
            f"The {name} lies outside the scatter table",
            got=f"{value:g} {unit}" if number else repr(value),
            allowed=f"{edges[0]:g} to {edges[-1]:g} {unit}",
        )
    return max(int(np.searchsorted(edges, value)) - 1, 0)
