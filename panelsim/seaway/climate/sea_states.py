"""NATO sea states of the North Atlantic, by number and by wave height."""

from dataclasses import dataclass
from functools import cache
from numbers import Integral, Real

import numpy as np

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.seaway.climate.bundled import bundled_rows
from panelsim.seaway.spectra.bretschneider import Bretschneider

Range = tuple[float, float]


@dataclass(frozen=True)
class SeaState:
    """One row of TM 2004-041 Table 1: what a sea state of the North Atlantic is.

    `name` as printed ("0-1", "2" … "8", "> 8"); heights are significant wave heights [m], winds sustained
    wind speeds [m/s], `probability` a share. Sea states above 8 have open ranges, up to infinity, and no
    means: there the table prints only "> 14" and "> 63". Sea state 0-1 has no periods. None stands for
    what the table does not have. The printed probabilities add up to 99.95 %.
    """

    name: str
    height_range: Range
    mean_height: float | None
    wind_speed_range: Range
    mean_wind_speed: float | None
    probability: float
    peak_period_range: Range | None
    most_probable_peak_period: float | None

    def spectrum(self) -> Bretschneider:
        """Bretschneider sea of the mean height and the most probable peak period.

        Raises PanelsimError where the table has no such height or period.
        """
        if self.mean_height is None or self.most_probable_peak_period is None:
            missing = "mean wave height" if self.mean_height is None else "peak period"
            raise PanelsimError(
                f"The table gives this sea state no {missing}",
                got=f"sea state {self.name}",
                allowed="2 to 8",
                remedy="give significant_wave_height and peak_period instead",
            )
        return Bretschneider(self.mean_height, self.most_probable_peak_period)


def sea_state(number: int) -> SeaState:
    """NATO sea state by its number: 0 and 1 give the row "0-1", 9 the row "> 8"; TM 2004-041 Table 1."""
    if isinstance(number, bool) or not isinstance(number, Integral) or not 0 <= number <= 9:
        raise PanelsimError(
            "There is no such sea state", got=repr(number), allowed="0, 1 … 8, and 9 for all above 8"
        )
    return _sea_states()[max(int(number) - 1, 0)]


def sea_state_of(significant_wave_height: float) -> SeaState:
    """NATO sea state of a significant wave height [m], TM 2004-041 Table 1.

    A height that bounds two states belongs to the lower one, as in WMO code table 3700: 4 m is sea state 5.
    """
    height = significant_wave_height
    if isinstance(height, bool) or not isinstance(height, Real) or not 0 <= height < np.inf:
        raise PanelsimError(
            "significant_wave_height is no height", got=repr(height), allowed="a finite number, 0 m or more"
        )
    return next(state for state in _sea_states() if height <= state.height_range[1])


@cache
def _sea_states() -> tuple[SeaState, ...]:
    """The nine rows of the table."""
    return tuple(_sea_state(*row) for row in bundled_rows("nato_sea_states.csv")[1:])


def _sea_state(name: str, *cells: str) -> SeaState:
    """One row: height, wind and their means, probability, periods; knots and per cent become SI and share."""
    h_low, h_high, h_mean, w_low, w_high, w_mean, percent, t_low, t_high, t_most = (
        float(cell) if cell else None for cell in cells
    )
    assert h_low is not None and h_high is not None and w_low is not None and w_high is not None
    assert percent is not None
    return SeaState(
        name=name,
        height_range=(h_low, h_high),
        mean_height=h_mean,
        wind_speed_range=(KNOT * w_low, KNOT * w_high),
        mean_wind_speed=None if w_mean is None else KNOT * w_mean,
        probability=percent / 100,
        peak_period_range=None if t_low is None or t_high is None else (t_low, t_high),
        most_probable_peak_period=t_most,
    )
