"""Scatter tables, sea states and the limit of steepness: what they compute and what they refuse."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.seaway.climate.limits import buckley_height
from panelsim.seaway.climate.scatter import ScatterTable, north_atlantic
from panelsim.seaway.climate.sea_states import sea_state, sea_state_of
from panelsim.seaway.steepness import nominal_steepness

HEIGHTS, PERIODS = np.array([1.0, 3.0]), np.array([4.0, 6.0, 10.0])
# Ten observations; cells of 0-2-4 m and 3-5-8-12 s.
COUNTS = np.array([[1.0, 2.0, 0.0], [0.0, 3.0, 4.0]])


@pytest.fixture
def table() -> ScatterTable:
    return ScatterTable(HEIGHTS, PERIODS, COUNTS)


def test_cells_reach_half_way_to_their_neighbours(table: ScatterTable) -> None:
    np.testing.assert_array_equal(table.height_edges, [0, 2, 4])
    np.testing.assert_array_equal(table.period_edges, [3, 5, 8, 12])
    # As far outward as inward would be -1 m.
    np.testing.assert_array_equal(ScatterTable([1, 5], PERIODS, COUNTS).height_edges, [0, 3, 7])


@pytest.mark.parametrize(
    ("height", "period", "share"),
    [
        (1.0, 6.0, 0.2),
        (3.9, 11.9, 0.4),
        (1.0, 10.0, 0.0),
        (2.0, 5.0, 0.1),  # edges belong to the lower cell
        (2.01, 5.01, 0.3),
        (0.0, 3.0, 0.1),  # the corners of the table are inside it
        (4.0, 12.0, 0.4),
    ],
)
def test_probability_of_the_cell_that_holds_a_sea(
    table: ScatterTable, height: float, period: float, share: float
) -> None:
    assert table.probability(height, period) == pytest.approx(share, rel=1e-15)


@pytest.mark.parametrize(
    ("height", "period", "words"),
    [
        (4.01, 6.0, "4.01 m"),
        (-0.1, 6.0, "0 to 4 m"),
        (1.0, 12.1, "3 to 12 s"),
        (1.0, 2.9, "2.9 s"),
        (float("nan"), 6.0, "nan m"),
        ("1", 6.0, "'1'"),
        (1.0, True, "True"),
    ],
)
def test_seas_outside_the_table_are_refused(
    table: ScatterTable, height: float, period: float, words: str
) -> None:
    with pytest.raises(PanelsimError, match="outside the scatter table") as refusal:
        table.probability(height, period)
    assert words in str(refusal.value)


def test_distributions_by_hand(table: ScatterTable) -> None:
    assert table.total == 10
    np.testing.assert_allclose(table.height_probabilities, [0.3, 0.7], rtol=1e-15)
    np.testing.assert_allclose(table.period_probabilities, [0.1, 0.5, 0.4], rtol=1e-15)
    np.testing.assert_allclose(table.period_distribution(2.5), [0, 3 / 7, 4 / 7], rtol=1e-15)
    assert table.mean_peak_period(2.5) == pytest.approx((3 * 6 + 4 * 10) / 7, rel=1e-15)


def test_exceedance_by_hand(table: ScatterTable) -> None:
    """Exact at the edges of the cells, straight between them, zero at the top."""
    for height, share in [(0, 1.0), (1, 0.85), (2, 0.7), (3, 0.35), (4, 0.0)]:
        assert table.height_exceedance(height) == pytest.approx(share, abs=1e-15)
    with pytest.raises(PanelsimError, match="outside"):
        table.height_exceedance(4.1)


def test_a_height_without_observations_has_no_periods() -> None:
    gap = ScatterTable([1, 2, 3], [5, 6], [[1, 0], [0, 0], [0, 1]])
    assert gap.probability(2, 5) == 0
    with pytest.raises(PanelsimError, match="No sea of this height") as refusal:
        gap.mean_peak_period(2)
    assert "1, 3 m" in str(refusal.value)


def test_steepness_of_the_occupied_cells(table: ScatterTable) -> None:
    np.testing.assert_array_equal(np.isnan(table.steepness), COUNTS == 0)
    # 2π·3/(9.80665·36) by hand.
    assert table.steepness[1, 1] == pytest.approx(0.0533922, abs=1e-7)
    highest = [nominal_steepness(1, 4), nominal_steepness(3, 6), nominal_steepness(3, 10)]
    np.testing.assert_allclose(table.steepest, highest, rtol=1e-15)
    empty_column = ScatterTable(HEIGHTS, PERIODS, COUNTS * [1, 0, 1])
    np.testing.assert_array_equal(np.isnan(empty_column.steepest), [False, True, False])


def test_samples_follow_the_cells(table: ScatterTable) -> None:
    count = 20_000
    heights, periods = table.sample(count, seed=5)
    assert heights.shape == periods.shape == (count,)
    drawn = np.array([[np.sum((heights == h) & (periods == t)) for t in PERIODS] for h in HEIGHTS])
    assert drawn.sum() == count  # centres of cells and nothing else
    p = table.probabilities
    # Four standard deviations of a binomial count; empty cells are never drawn.
    assert np.all(np.abs(drawn - count * p) <= 4 * np.sqrt(count * p * (1 - p)))


def test_samples_are_those_of_the_seed() -> None:
    first, again, other = (north_atlantic().sample(50, seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


@pytest.mark.parametrize(
    ("count", "seed"), [(0, 1), (1.5, 1), (True, 1), (10, -1), (10, 0.5), (10, "1"), (10, None)]
)
def test_samples_of_no_whole_number_are_refused(table: ScatterTable, count: int, seed: int) -> None:
    with pytest.raises(PanelsimError, match="no whole number"):
        table.sample(count, seed)


@settings(deadline=None, max_examples=30)
@given(arrays(np.float64, (2, 3), elements=st.floats(0.5, 1e5)))
def test_any_table_adds_up(counts: np.ndarray) -> None:
    table = ScatterTable(HEIGHTS, PERIODS, counts)
    assert table.probabilities.sum() == pytest.approx(1, abs=1e-14)
    # The mean over all is the mean of the means by height.
    means = [table.mean_peak_period(height) for height in HEIGHTS]
    by_height = table.height_probabilities @ means
    assert by_height == pytest.approx(table.period_probabilities @ PERIODS, rel=1e-13)
    above = [table.height_exceedance(height) for height in np.linspace(0, 4, 9)]
    assert np.all(np.diff(above) < 0)


def test_tables_are_frozen(table: ScatterTable) -> None:
    given_counts = COUNTS.copy()
    own = ScatterTable(HEIGHTS, PERIODS, given_counts)
    given_counts[0, 0] = 99
    assert own.total == 10
    for array in (table.observations, table.peak_period, table.height_edges, north_atlantic().observations):
        assert not array.flags.writeable


@pytest.mark.parametrize(
    ("heights", "periods", "counts", "words"),
    [
        (HEIGHTS, PERIODS, COUNTS.T, "do not fit"),
        (HEIGHTS, PERIODS, COUNTS[0], "do not fit"),
        (HEIGHTS, PERIODS, 0 * COUNTS, "no observations"),
        (HEIGHTS, PERIODS, -COUNTS, "-1 at H_s 1 m, T_p 4 s"),
        (HEIGHTS, PERIODS, np.add(COUNTS, [0, 0, np.nan]), "nan at H_s 1 m, T_p 10 s"),
        (HEIGHTS, PERIODS, np.add(COUNTS, [0, np.inf, 0]), "inf at"),
        (HEIGHTS[::-1], PERIODS, COUNTS, "significant_wave_height is no row"),
        (HEIGHTS, [4, 4, 6], COUNTS, "peak_period is no row"),
        (HEIGHTS, [0, 4, 6], COUNTS, "peak_period is no row"),
        (HEIGHTS, [4, 6, np.nan], COUNTS, "peak_period is no row"),
        ([1], PERIODS, COUNTS[:1], "at least two"),
        (1.0, PERIODS, COUNTS, "at least two"),
        ([], [], [], "at least two"),
        (HEIGHTS, PERIODS, "many", "observations is no array"),
        (HEIGHTS, PERIODS, [[1, 2], [3]], "observations is no array"),
        (None, PERIODS, COUNTS, "at least two"),
    ],
)
def test_bad_tables_are_refused(heights: object, periods: object, counts: object, words: str) -> None:
    with pytest.raises(PanelsimError) as refusal:
        ScatterTable(heights, periods, counts)  # type: ignore[arg-type]
    assert words in str(refusal.value)


def test_sea_states_by_number() -> None:
    assert sea_state(0) is sea_state(1)
    assert [sea_state(n).name for n in range(10)] == ["0-1", "0-1", *"2345678", "> 8"]
    assert sea_state(np.int64(5)) is sea_state(5)


@pytest.mark.parametrize("number", [-1, 10, 5.0, "5", None, True, float("nan")])
def test_other_numbers_are_refused(number: int) -> None:
    with pytest.raises(PanelsimError, match="no such sea state") as refusal:
        sea_state(number)
    assert repr(number) in str(refusal.value)


@pytest.mark.parametrize(
    ("height", "name"),
    [
        (0, "0-1"),
        (0.1, "0-1"),
        (0.11, "2"),
        (3.9, "5"),
        (4, "5"),
        (4.01, "6"),
        (14, "8"),
        (14.1, "> 8"),
        (40, "> 8"),
    ],
)
def test_sea_state_of_a_height(height: float, name: str) -> None:
    """A height that bounds two states belongs to the lower: WMO code table 3700 has 4 m in code 5."""
    assert sea_state_of(height).name == name


@pytest.mark.parametrize("height", [-0.1, float("nan"), float("inf"), "4", None, True])
def test_heights_that_are_none_are_refused(height: float) -> None:
    with pytest.raises(PanelsimError, match="no height"):
        sea_state_of(height)


def test_the_mean_height_of_each_state_lies_in_it() -> None:
    for number in range(1, 9):
        state = sea_state(number)
        assert state.mean_height is not None
        assert sea_state_of(state.mean_height) is state


def test_winds_are_in_metres_a_second() -> None:
    """Sea state 5: 22 to 27 knots, 24.5 in the mean; a knot is 1852 m an hour."""
    state = sea_state(5)
    assert state.wind_speed_range == (22 * KNOT, 27 * KNOT)
    assert state.mean_wind_speed == pytest.approx(24.5 * 1852 / 3600, rel=1e-15)


def test_spectrum_of_a_sea_state() -> None:
    spectrum = sea_state(7).spectrum()
    assert (spectrum.significant_wave_height, spectrum.peak_period) == (7.5, 15.0)


@pytest.mark.parametrize(("number", "words"), [(0, "no peak period"), (9, "no mean wave height")])
def test_states_without_height_or_period_have_no_spectrum(number: int, words: str) -> None:
    with pytest.raises(PanelsimError, match=words) as refusal:
        sea_state(number).spectrum()
    assert "2 to 8" in str(refusal.value)


def test_buckley_height() -> None:
    # 0.049 · 9.80665 · 10² / 2π by hand.
    assert buckley_height(10.0) == pytest.approx(7.647806, abs=1e-6)
    periods = np.array([5.0, 10.0, 20.0])
    heights = buckley_height(periods)
    steepness = [nominal_steepness(h, t) for h, t in zip(heights, periods, strict=True)]
    np.testing.assert_allclose(steepness, 0.049, rtol=1e-14)


@pytest.mark.parametrize("period", [0.0, -5.0, float("nan"), float("inf"), [10.0, 0.0], "ten", None])
def test_periods_that_are_none_are_refused(period: object) -> None:
    with pytest.raises(PanelsimError, match="peak_period is not positive"):
        buckley_height(period)  # type: ignore[arg-type]
