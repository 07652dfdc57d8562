"""The grid method: its plan, its tables, and its kernels against plain sums over the waves."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import chebyshev

from panelsim.conventions import STRETCHINGS, FloatArray
from panelsim.errors import PanelsimError
from panelsim.kernels import grid_plan
from panelsim.kernels.grid_fill import fill_grid
from panelsim.kernels.grid_plan import (
    WINDOW,
    Axis,
    DepthSeries,
    GridBox,
    GridTooLarge,
    choose_method,
    plan_grid,
    window_oversampling,
)
from panelsim.kernels.grid_pressure import Blocks, Row, Rows, elevation_bound, grid_fields, ti
from panelsim.kernels.lanes import Lanes
from panelsim.kernels.tables import WaveTables, wave_tables
from panelsim.kernels.wave_grid import WaveGrid, _spread, _unwindowed, spline_weights, transfer, wave_grid

G = 9.80665
BOX = GridBox(-70.0, 62.0, -14.0, 18.0, 16.0)  # no side like another
# A direct sum of M terms, cos and exp exact to 1e-15, phases of some hundred turns.
ROUNDING = 1e-12


def sea(
    count: int,
    *,
    spread: float = 1.2,
    heading: float = 2.6,
    highest: float = 2.0,
    speed: float = 10.0,
    seed: int = 1,
) -> WaveTables:
    """Waves of a sea with Tp 10 s and a standard deviation of 2 m, each of its own frequency and heading."""
    random = np.random.default_rng(seed)
    omega = np.linspace(0.3, highest, count) + random.uniform(-0.02, 0.02, count)
    height = np.sqrt(omega**-5 * np.exp(-1.25 * (0.628 / omega) ** 4))
    directions = heading + spread * random.uniform(-1.0, 1.0, count)
    k = omega**2 / G
    return wave_tables(
        height * 2.0 / np.sqrt(0.5 * np.sum(height**2)),
        k,
        directions,
        omega - speed * k * np.cos(directions),
        random.uniform(0.0, 2.0 * np.pi, count),
    )


def points(count: int, box: GridBox = BOX, seed: int = 3) -> FloatArray:
    """Points within the box, from well above the crests to 4 m above its depth."""
    low, high = [box.x_low, box.y_low, 6.0 - box.depth], [box.x_high, box.y_high, 8.0]
    return np.random.default_rng(seed).uniform(low, high, (count, 3))


def plain_sum(
    waves: WaveTables,
    at: FloatArray,
    time: float,
    displacement: tuple[float, float] = (0.0, 0.0),
    wave_factor: float = 1.0,
    stretching: str = "wheeler",
) -> tuple[FloatArray, FloatArray]:
    """Elevation and wave head as one would write them down."""
    x, y, z = (at + np.array([*displacement, 0.0])).T[:, :, None]
    theta = waves.wavenumber_x * x + waves.wavenumber_y * y - waves.encounter_frequency * time - waves.phase
    crest = wave_factor * waves.amplitude * np.cos(theta)
    elevation = crest.sum(axis=1)
    height = z[:, 0] - elevation if stretching == "wheeler" else z[:, 0]
    return elevation, (crest * np.exp(waves.wavenumber * np.minimum(height, 0.0)[:, None])).sum(axis=1)


def significant_amplitude(waves: WaveTables) -> float:
    return 2.0 * float(np.sqrt(0.5 * np.sum(waves.amplitude**2)))


def worst_error(grid: WaveGrid, at: FloatArray, time: float, **given: object) -> float:
    """Largest error of elevation and head over the significant amplitude."""
    got, expected = grid_fields(grid, at, time, **given), plain_sum(grid.waves, at, time, **given)  # type: ignore[arg-type]
    worst = max(np.abs(one - other).max() for one, other in zip(got[:2], expected, strict=True))
    return float(worst) / significant_amplitude(grid.waves)


def spline_of_wave(step: float, degree: int, places: FloatArray) -> FloatArray:
    """A spline with unit spacing whose coefficients are cos(step j) over the transfer, at places >= 0."""
    cell, powers = np.floor(places), np.arange(degree, -1, -1)
    weights = (places - cell)[:, None] ** powers @ spline_weights(degree)[:, : degree + 1]
    nodes = cell[:, None] - (degree - 1) // 2 + np.arange(degree + 1)
    return np.sum(weights * np.cos(step * nodes), axis=1) / transfer(np.array(step), degree)


@pytest.mark.parametrize("degree", grid_plan.DEGREES)
def test_a_wave_over_the_transfer_function_leaves_aliasing_alone(degree: int) -> None:
    places = np.linspace(0.0, 40.0, 4001)
    for step in (0.5, 1.0, 2.0):
        error = np.abs(spline_of_wave(step, degree, places) - np.cos(step * places)).max()
        bound = grid_plan.aliasing(np.array([step]), degree)[0]
        # The aliases meet in phase at the nodes or between them; five are summed, the rest is below 1 %.
        assert 0.95 * bound < error < 1.01 * bound, (step, error, bound)


@pytest.mark.parametrize("degree", grid_plan.DEGREES)
def test_aliasing_falls_with_the_power_of_the_spacing(degree: int) -> None:
    step, places = np.geomspace(0.25, 1.0, 5), np.linspace(0.0, 40.0, 401)
    error = [np.abs(spline_of_wave(s, degree, places) - np.cos(s * places)).max() for s in step]
    slope = np.polyfit(np.log(step), np.log(error), 1)[0]
    # (kh/(2π - kh))^(p+1) is a little steeper than the power: by 10 % of it over these steps.
    print(f"degree {degree}: order {slope:.2f}")
    assert degree + 1 < slope < 1.15 * (degree + 1) + 0.15


@pytest.mark.parametrize("allowed", [2.5e-8, 5e-7, 2.5e-4])
def test_waves_spread_over_modes_come_back(allowed: float) -> None:
    axis, oversampling = Axis(2.0, 75), window_oversampling(allowed)
    k = np.random.default_rng(1).uniform(-0.4, 0.4, 300)
    first, window, rates = _spread(k, axis, oversampling)
    cos, sin = np.moveaxis(_unwindowed(axis, rates, oversampling), 2, 0)
    modes = first[:, None] + np.arange(WINDOW)
    wave = np.einsum("mw,hmw->mh", window, (cos + 1j * sin)[:, modes])
    error = np.abs(wave - np.exp(1j * k[:, None] * axis.half))
    rms = np.sqrt(np.mean(error**2, axis=0)).max()
    print(f"allowed {allowed:.1e}, got {rms:.1e}")
    # The factor of 40 is that of the finest windows, 20 that of the coarsest.
    assert 0.3 * allowed < rms < 1.1 * allowed


def test_spline_weights_are_those_of_the_cubic() -> None:
    np.testing.assert_allclose(spline_weights(3)[-1, :4], [1 / 6, 2 / 3, 1 / 6, 0], atol=1e-15)
    np.testing.assert_allclose(spline_weights(3)[0, :4], [-1 / 6, 1 / 2, -1 / 2, 1 / 6], atol=1e-15)
    for degree in grid_plan.DEGREES:
        sums = spline_weights(degree).sum(axis=1)
        np.testing.assert_allclose(sums, [0.0] * degree + [1.0], atol=1e-14)
        assert not spline_weights(degree)[:, degree + 1 :].any()


def test_the_depth_series_is_exact_at_the_surface_and_near_below() -> None:
    series, k = DepthSeries(16.0, 8, 0.06), np.linspace(0.01, 0.4, 20)
    psi = series.coefficients(k)
    np.testing.assert_allclose(psi.sum(axis=1), 1.0, rtol=1e-13)  # all polynomials are 1 there
    d = np.linspace(-16.0, 0.0, 97)
    got = psi @ chebyshev.chebvander(series.argument(d), 7).T
    worst = np.abs(got - np.exp(k[:, None] * d)).max()
    assert 1e-8 < worst < 2e-6  # 3e-7 at the roots, twice that at the extrema
    np.testing.assert_allclose(series.error(k, np.full(20, 1 / 20)), 3e-7, rtol=0.7)


@pytest.mark.parametrize(("depth", "highest", "terms"), [(16.0, 2.0, 8), (16.0, 3.0, 16), (40.0, 2.0, 16)])
def test_depth_terms_follow_from_sea_and_depth(depth: float, highest: float, terms: int) -> None:
    waves = sea(100, highest=highest)
    series = grid_plan.depth_series(waves, depth, 5e-7)
    assert (series.terms, series.depth) == (terms, depth)
    weight = waves.amplitude**2 / np.sum(waves.amplitude**2)
    # Chosen with the energy in 64 bins, each at its upper edge.
    assert series.error(waves.wavenumber, weight) < 5e-7


def test_a_series_that_cannot_reach_so_deep_reaches_less_deep() -> None:
    series = grid_plan.depth_series(sea(100, highest=6.0), 200.0, 1e-8)
    assert series.terms == 16 and 5.0 < series.depth < 150.0


def test_waves_of_one_direction_take_a_line_either_way() -> None:
    both_ways = wave_tables([1.0, 1.0], [0.1, 0.2], [2.6, 2.6 - np.pi], [1.0, 2.0], [0.0, 1.0])
    direction = grid_plan.common_direction(both_ways)
    assert direction is not None
    np.testing.assert_allclose(np.abs(direction), [-np.cos(2.6), np.sin(2.6)], rtol=1e-12)
    nearly = wave_tables([1.0, 1.0], [0.1, 0.2], [2.6, 2.6 + 1e-6], [1.0, 2.0], [0.0, 1.0])
    assert grid_plan.common_direction(nearly) is None
    assert worst_error(wave_grid(both_ways, BOX), points(200), 5.0) < 2e-6


SEAS = {
    "line of 19": {"count": 19, "spread": 0.0},
    "line of 160": {"count": 160, "spread": 0.0, "heading": 0.7},
    "plane of 37": {"count": 37},
    "plane of 160 from everywhere": {"count": 160, "spread": np.pi},
    "plane of 2000": {"count": 2000, "heading": -2.0},
}


@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("name", SEAS)
def test_grid_agrees_with_plain_sums_within_its_tolerance(name: str, stretching: str) -> None:
    waves = sea(**SEAS[name])  # type: ignore[arg-type]
    grid = wave_grid(waves, BOX)
    assert grid.plan.kind == name[: name.index(" ")]
    for state in range(3):
        given = {
            "displacement": (3.0 * state, -7.0),
            "wave_factor": 0.5 + 0.5 * state,
            "stretching": stretching,
        }
        worst = worst_error(grid, points(500, seed=state), 100.0 * state, **given)
        print(f"{name}, {stretching}: {worst:.1e}")
        # The tolerance scales with the waves. Above rounding: it is the grid that was tried.
        assert 1e-9 < worst < 2e-6 * max(given["wave_factor"], 1.0)  # type: ignore[type-var, call-overload]


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-7])
@pytest.mark.parametrize("spread", [0.0, 1.2])
@pytest.mark.parametrize("degree", grid_plan.DEGREES)
def test_every_tolerance_is_kept_and_not_by_far_too_much(
    degree: int, spread: float, tolerance: float
) -> None:
    grid = wave_grid(sea(160, spread=spread), BOX, tolerance, degrees=(degree,))
    worst = worst_error(grid, points(1000), 40.0)
    print(f"degree {degree}, {grid.plan.kind}: {tolerance:.0e} asked, {worst:.1e} got")
    assert 0.01 * tolerance < worst < tolerance  # a random error stays some way below its bound


@pytest.mark.parametrize("spread", [0.0, 1.2])
def test_sixteen_depth_terms_for_short_waves(spread: float) -> None:
    grid = wave_grid(sea(160, spread=spread, highest=3.0), BOX)
    assert grid.plan.depth.terms == 16
    assert 1e-9 < worst_error(grid, points(1000), 40.0) < 2e-6


@pytest.mark.parametrize("heading", np.deg2rad([0, 30, 90, 135, 180, 250, 270, 315]))
def test_single_waves_from_all_sides(heading: float) -> None:
    """A wave alone: the sign of every wavenumber and of the encounter frequency, at a late time."""
    k = 0.05
    wave = wave_tables(1.5, k, heading, np.sqrt(G * k) - 15.0 * k * np.cos(heading), 0.4)
    assert worst_error(wave_grid(wave, BOX), points(200), 1e4, displacement=(5.0, 9.0)) < 2e-6


def test_a_wave_without_end_is_level_water() -> None:
    level = wave_tables([2.0], [0.0], [0.3], [0.5], [0.0])
    got = grid_fields(wave_grid(level, BOX), points(50), 1.0)
    np.testing.assert_allclose(got.elevation, 2.0 * np.cos(0.5), rtol=1e-12)
    np.testing.assert_allclose(got.head, 2.0 * np.cos(0.5), rtol=1e-12)


@pytest.mark.parametrize("spread", [0.0, 1.2])
def test_beyond_box_and_depth_the_waves_are_summed(spread: float) -> None:
    grid, time = wave_grid(sea(60, spread=spread), BOX, 1e-3), 30.0
    bow = points(8) * [0.0, 0.0, 1.0] + [200.0, 0.0, 0.0]
    beam = points(8) * [0.0, 0.0, 1.0] + [0.0, 90.0, 0.0]
    astern = points(8) * [0.0, 0.0, 1.0] + [-90.0, -1.0, 0.0]
    quarter = points(8) * [0.0, 0.0, 1.0] + [0.0, -30.0, 0.0]
    deep = points(8) - [0.0, 0.0, 40.0]
    one_astray = points(8)
    one_astray[5, 0] += 1e4
    # The line runs 31 degrees off the bow and reaches abeam as well.
    for astray in (bow, astern, deep, one_astray) + ((beam, quarter) if spread else ()):
        got, expected = grid_fields(grid, astray, time), plain_sum(grid.waves, astray, time)
        np.testing.assert_allclose(got.elevation, expected[0], rtol=0, atol=ROUNDING * 10)
        np.testing.assert_allclose(got.head, expected[1], rtol=0, atol=ROUNDING * 10)
    assert worst_error(grid, points(8), time) > 1e-7  # in the box the grid is used


@pytest.mark.parametrize("spread", [0.0, 1.2])
def test_the_whole_box_is_on_the_grid_up_to_its_sides(spread: float) -> None:
    corners = np.array([[x, y, -1.0] for x in (-70.0, -4.0, 62.0) for y in (-14.0, 2.0, 18.0)])
    for degree in grid_plan.DEGREES:
        grid = wave_grid(sea(60, spread=spread), BOX, 1e-3, degrees=(degree,))
        for corner in corners:
            at = np.tile(corner, (8, 1))
            assert 1e-9 < worst_error(grid, at, 3.0) < 1e-3


@pytest.mark.parametrize("spread", [0.0, 1.2])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_no_step_out_of_the_box_leaves_the_grid_too_late(axis: int, spread: float) -> None:
    """Points 0.1 m apart across each side and the bottom; eight alike make a block of their own."""
    grid = wave_grid(sea(60, spread=spread), BOX)
    sides = [(-70.0, 62.0), (-14.0, 18.0), (-16.0, -16.0)][axis]
    for side in sides:
        at = np.tile([3.0, 2.0, -1.0], (300, 1))
        at[:, axis] = side + np.linspace(-15.0, 15.0, 300)
        assert worst_error(grid, np.repeat(at, 8, axis=0), 3.0) < 2e-6


@pytest.mark.parametrize("spread", [0.0, 1.2])
def test_no_crest_in_the_box_is_above_its_bound(spread: float) -> None:
    grid, highest = wave_grid(sea(60, spread=spread), BOX), -np.inf
    for time in (0.0, 7.0, 400.0):
        got = grid_fields(grid, points(20_000), time)
        assert got.crest_bound >= got.elevation.max()
        # Coefficients overshoot by (k h)² (p + 1)/24 an axis, 18 % for the shortest waves; nodes lie
        # beyond the box as well, and the points miss the top of the highest crest.
        assert got.crest_bound < got.elevation.max() + 0.3 * significant_amplitude(grid.waves)
        assert got.crest_bound < 0.7 * grid.waves.amplitude.sum()
        highest = max(highest, got.elevation.max())
        trough = grid_fields(grid, points(20_000), time, wave_factor=-1.0)
        assert trough.crest_bound >= trough.elevation.max()
    assert highest > 2.0  # two standard deviations: there were crests


@ti.kernel
def bound_at(
    components: Blocks,
    tables: Rows,
    scratch: Rows,
    xy: Row,
    out: Row,
    terms: ti.template(),
    line: ti.template(),
):
    for _ in range(1):
        inside = fill_grid(components, tables, 0, scratch, 0.0, 0.0, 2.0, 1.5, terms, line)
        out[0] = inside
        out[1] = elevation_bound(tables, 0, Lanes(xy[0]), Lanes(xy[1]), inside, 1.5, line)


@pytest.mark.parametrize("spread", [0.0, 1.2])
def test_the_bound_outside_the_box_is_that_of_all_waves(spread: float) -> None:
    grid, out = wave_grid(sea(60, spread=spread), BOX), np.zeros(2)
    for place, inside in (([10.0, 5.0], True), ([10.0, 400.0], False), ([-200.0, 0.0], False)):
        terms, line = grid.plan.depth.terms, grid.plan.kind == "line"
        bound_at(grid.components, grid.tables, grid.scratch(), np.array(place), out, terms, line)
        expected = out[0] if inside else 1.5 * grid.waves.amplitude.sum()
        np.testing.assert_allclose(out[1], expected, rtol=1e-14)


@settings(deadline=None, max_examples=25)
@given(
    count=st.integers(1, 12),
    seed=st.integers(0, 10_000),
    tolerance=st.sampled_from([1e-6, 1e-4]),
    spread=st.sampled_from([0.0, 0.3, 3.1]),
    longest=st.floats(20.0, 300.0),
)
def test_any_waves_in_any_box(count: int, seed: int, tolerance: float, spread: float, longest: float) -> None:
    """A few waves, one of them often far above the rest, in boxes from a boat to a large ship."""
    random = np.random.default_rng(seed)
    x, y, depth = longest * random.uniform(-1, 1), longest * random.uniform(-1, 1), longest / 8.0
    box = GridBox(x, x + longest, y, y + longest / 4.0, depth)
    k = 2.0 * np.pi / longest * random.uniform(0.1, 8.0, count)
    heading = random.uniform(0, 6) + spread * random.uniform(-1, 1, count)
    height = random.exponential(1.0, count) ** 2 * 0.05 / k
    waves = wave_tables(height, k, heading, np.sqrt(G * k), random.uniform(0, 6, count))
    grid = wave_grid(waves, box, tolerance)
    at = points(200, box, seed)
    at[:, 2] = random.uniform(-0.5 * depth, 0.1 * depth, 200)
    assert worst_error(grid, at, 12.0) < tolerance


def test_same_bits_again_and_alone() -> None:
    grid, at = wave_grid(sea(60), BOX), points(64)
    together = grid_fields(grid, at, 8.0)
    again = grid_fields(grid, at, 8.0)
    alone = [grid_fields(grid, at[i : i + 1], 8.0) for i in range(8)]
    for field in range(2):
        np.testing.assert_array_equal(together[field], again[field])
        np.testing.assert_array_equal(together[field][:8], np.concatenate([one[field] for one in alone]))


def test_a_call_leaves_the_tables_as_they_were() -> None:
    grid = wave_grid(sea(60), BOX)
    before = grid.components.copy(), grid.tables.copy()
    grid_fields(grid, points(10), 8.0)
    assert not grid.components.flags.writeable and not grid.tables.flags.writeable
    np.testing.assert_array_equal(grid.components, before[0])
    np.testing.assert_array_equal(grid.tables, before[1])


def test_other_seas_and_degrees_do_not_compile_the_kernel_again() -> None:
    from taichi.lang import impl

    for spread in (0.0, 1.2):
        grid_fields(wave_grid(sea(60, spread=spread), BOX), points(10), 1.0)
    compiled = impl.get_runtime().get_num_compiled_functions()
    for degree in grid_plan.DEGREES:
        for spread in (0.0, 1.2):
            grid = wave_grid(sea(40, spread=spread), BOX, 1e-5, degrees=(degree,))
            grid_fields(grid, points(30), 2.0, stretching="none")
    assert impl.get_runtime().get_num_compiled_functions() == compiled


def test_the_cheapest_method_is_chosen() -> None:
    stokes = wave_tables(1.0, 0.1, 2.6, 1.0, 0.0, second_order=True)
    calm = wave_tables([], [], [], [], [])
    flat = wave_tables([0.0] * 50, [0.1] * 50, [0.3] * 50, [1.0] * 50, [0.0] * 50)
    for waves in (stokes, calm, flat, sea(8, spread=0.0), sea(30)):
        assert choose_method(2600, waves, BOX) == "direct"
    assert choose_method(2600, sea(40, spread=0.0), BOX) == "line"
    assert choose_method(2600, sea(160), BOX) == "plane"
    assert choose_method(2600, sea(2000), BOX) == "plane"
    assert choose_method(100, sea(160), BOX) == "direct"  # too few points to fill a grid for
    ripples = sea(200, highest=40.0)  # of 4 cm: a grid of centimetres
    assert choose_method(2600, ripples, BOX, 1e-7) == "direct"
    with pytest.raises(GridTooLarge, match="500000"):
        plan_grid(ripples, BOX, 1e-7)


def test_what_goes_on_no_grid_is_refused() -> None:
    with pytest.raises(PanelsimError, match="Stokes"):
        wave_grid(wave_tables(1.0, 0.1, 2.6, 1.0, 0.0, second_order=True), BOX)
    with pytest.raises(PanelsimError, match="0 waves of no height"):
        wave_grid(wave_tables([], [], [], [], []), BOX)
    for tolerance in (0.0, -1e-6, 9e-8, 0.1, np.nan, "fine", True):
        for refuse in (wave_grid, plan_grid):
            with pytest.raises(PanelsimError, match=f"got: {tolerance!r}"):
                refuse(sea(50), BOX, tolerance)  # type: ignore[arg-type]
        with pytest.raises(PanelsimError, match=f"got: {tolerance!r}"):
            choose_method(100, sea(50), BOX, tolerance)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "sides", [(1, -1, 0, 1, 5), (0, 1, 1, 1, 5), (0, 1, 0, 1, 0), (0, 1, 0, 1, -5), (0, np.inf, 0, 1, 5)]
)
def test_a_box_without_water_is_refused(sides: tuple[float, ...]) -> None:
    with pytest.raises(PanelsimError, match="The box of a wave grid is none"):
        GridBox(*sides)
    with pytest.raises(PanelsimError, match="nan"):
        GridBox(np.nan, *sides[1:])


def test_points_that_are_none_are_refused() -> None:
    grid = wave_grid(sea(50), BOX)
    for bad in (np.zeros(3), np.zeros((4, 2)), np.full((4, 3), np.nan), np.full((1, 3), np.inf)):
        with pytest.raises(PanelsimError, match="no finite numbers"):
            grid_fields(grid, bad, 0.0)
    with pytest.raises(PanelsimError, match="time nan"):
        grid_fields(grid, points(1), np.nan)
    with pytest.raises(PanelsimError, match="airy"):
        grid_fields(grid, points(1), 0.0, stretching="airy")
    assert grid_fields(grid, np.empty((0, 3)), 0.0).elevation.shape == (0,)
