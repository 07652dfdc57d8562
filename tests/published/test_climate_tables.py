"""The climate tables of TM 2003-190 and TM 2004-041, against the print and against each other."""

import numpy as np
import pytest

from panelsim.conventions import KNOT
from panelsim.seaway.climate.limits import buckley_height
from panelsim.seaway.climate.scatter import north_atlantic
from panelsim.seaway.climate.sea_states import sea_state
from panelsim.seaway.steepness import BUCKLEY_STEEPNESS

# TM 2003-190 Table 1: its head, and the sums of the printed counts by row and by column.
PERIODS = [3.2, 4.5, 6.3, 7.5, 8.5, 9.7, 10.9, 12.4, 13.9, 15.0, 16.4, 18.0, 20.0, 22.5, 25.7]
BY_HEIGHT = [29386, 33752, 24365, 16306, 10382, 6751, 4158, 2340, 1381, 717]
BY_HEIGHT += [372, 185, 88.5, 88.5, 28, 28, 5, 5, 0.5, 0.5]
BY_PERIOD = [541, 630, 9446, 14408, 15703, 21136, 17769, 20379, 10478, 9940, 5661, 3399, 781, 51, 17]
# First and last peak period printed with a count, by height from 0.5 m.
SPANS = [(3.2, 22.5), (4.5, 22.5), (6.3, 22.5), (7.5, 22.5), (8.5, 22.5), (9.7, 22.5), (9.7, 20.0)]
SPANS += [(12.4, 25.7), (12.4, 25.7), (12.4, 25.7), (13.9, 22.5), (15.0, 25.7), (16.4, 20.0), (16.4, 20.0)]
SPANS += [(18.0, 25.7), (18.0, 25.7), (20.0, 22.5), (20.0, 22.5), (25.7, 25.7), (25.7, 25.7)]

# TM 2004-041 Table 1 from sea state 1 to 9: heights [m], winds [knots], per cent, peak periods [s].
INF = float("inf")
SEA_STATES = [
    ((0, 0.1), 0.05, (0, 6), 3, 0.7, None, None),
    ((0.1, 0.5), 0.3, (7, 10), 8.5, 6.8, (3.3, 12.8), 7.5),
    ((0.5, 1.25), 0.88, (11, 16), 13.5, 23.7, (5.0, 14.8), 7.5),
    ((1.25, 2.5), 1.88, (17, 21), 19, 27.8, (6.1, 15.2), 8.8),
    ((2.5, 4), 3.25, (22, 27), 24.5, 20.6, (8.3, 15.5), 9.7),
    ((4, 6), 5, (28, 47), 37.5, 13.1, (9.8, 16.2), 12.4),
    ((6, 9), 7.5, (48, 55), 51.5, 6.1, (11.8, 18.5), 15.0),
    ((9, 14), 11.5, (56, 63), 59.5, 1.1, (14.2, 18.6), 16.4),
    ((14, INF), None, (63, INF), None, 0.05, (18.0, 23.7), 20.0),
]


def test_scattergram_as_printed() -> None:
    table = north_atlantic()
    np.testing.assert_array_equal(table.significant_wave_height, 0.5 + np.arange(20))
    np.testing.assert_array_equal(table.peak_period, PERIODS)
    assert table.total == 130_339
    np.testing.assert_array_equal(table.observations.sum(axis=1), BY_HEIGHT)
    np.testing.assert_array_equal(table.observations.sum(axis=0), BY_PERIOD)
    for counts, span in zip(table.observations, SPANS, strict=True):
        occupied = table.peak_period[counts > 0]
        assert (occupied[0], occupied[-1]) == span


@pytest.mark.parametrize(
    ("height", "period", "count"),
    [
        (0.5, 3.2, 541),
        (6.5, 9.7, 2),  # with the observation that stood at 8.5 m
        (7.5, 15.0, 778),
        (7.5, 22.5, 0),  # the one row with a gap before its last count
        (7.5, 25.7, 6),
        (12.5, 16.4, 13.5),
        (14.5, 25.7, 0.5),
        (17.5, 20.0, 2.5),
    ],
)
def test_single_cells(height: float, period: float, count: float) -> None:
    assert north_atlantic().probability(height, period) == pytest.approx(count / 130_339, rel=1e-15)


def test_the_scattergram_stays_under_buckleys_limit() -> None:
    """Figure 5 with the change to Table 1; the sea that was moved is the one that exceeded the limit."""
    table = north_atlantic()
    assert np.nanmax(table.steepness) < BUCKLEY_STEEPNESS
    # The steepest comes close: 1.5 m at 4.5 s.
    assert np.argmax(table.steepest) == 1
    assert 0.96 * BUCKLEY_STEEPNESS < table.steepest.max() < BUCKLEY_STEEPNESS
    assert 6.5 < buckley_height(9.7) < 8.5


@pytest.mark.parametrize("number", range(1, 10))
def test_sea_states_as_printed(number: int) -> None:
    heights, mean_height, winds, mean_wind, per_cent, periods, most_probable = SEA_STATES[number - 1]
    state = sea_state(number)
    assert (state.height_range, state.mean_height) == (heights, mean_height)
    assert state.wind_speed_range == tuple(KNOT * wind for wind in winds)
    assert state.mean_wind_speed == (None if mean_wind is None else KNOT * mean_wind)
    assert state.probability == pytest.approx(per_cent / 100, rel=1e-15)
    assert (state.peak_period_range, state.most_probable_peak_period) == (periods, most_probable)


def test_the_probabilities_of_the_sea_states_add_up_to_the_printed_sum() -> None:
    # 99.95 %: 0.05 % is lost in the rounding of the print.
    assert sum(sea_state(n).probability for n in range(1, 10)) == pytest.approx(0.9995, abs=1e-12)


@pytest.mark.parametrize("number", [6, 7, 8, 9])
def test_both_tables_exceed_a_height_equally_often(number: int) -> None:
    """4, 6, 9 and 14 m are edges of the scattergram and bounds of sea states, of one hindcast."""
    higher = range(number, 10)
    # Each printed percentage is good to half its last digit: 0.05 %, and 0.005 % above sea state 8.
    rounding = sum(5e-5 if n == 9 else 5e-4 for n in higher)
    exceeded = north_atlantic().height_exceedance(sea_state(number).height_range[0])
    assert exceeded == pytest.approx(sum(sea_state(n).probability for n in higher), abs=rounding)


@pytest.mark.parametrize("number", [5, 6, 7, 8, 9])
def test_both_tables_have_the_same_most_probable_periods(number: int) -> None:
    """The scattergram's columns are where the sea states have them; a shifted row would move the peak."""
    table, state = north_atlantic(), sea_state(number)
    low, high = np.clip(state.height_range, 0, table.height_edges[-1])
    edges = table.height_edges
    # Cells that the range cuts count with the share of their heights inside it.
    share = np.clip(np.minimum(edges[1:], high) - np.maximum(edges[:-1], low), 0, None) / np.diff(edges)
    assert table.peak_period[np.argmax(share @ table.observations)] == state.most_probable_peak_period
