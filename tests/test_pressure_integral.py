"""Methods and batches of the pressure integral: the same answer by all, the same bits in any company."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from panelsim.conventions import RULES, STRETCHINGS
from panelsim.errors import PanelsimError
from panelsim.kernels import grid, runtime
from panelsim.kernels.grid_plan import DEFAULT_TOLERANCE
from panelsim.kernels.hull_box import SECTOR, hull_box
from panelsim.kernels.pressure import PressureIntegral, wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables
from panelsim.ship.bundled import load_ship

SHIP = load_ship("halifax", 5.0)
GIVEN = {"waterline": SHIP.waterline, "water_density": 1025.0, "gravity": 9.80665}
CALM = wave_tables([], [], [], [], [])


@pytest.fixture(scope="module")
def panels() -> PanelTables:
    return panel_tables(SHIP.vertices, SHIP.mesh.panels)


def sea(count: int, heading: float, *, spread: float = 0.0, speed: float = 10.0, seed: int = 1) -> WaveTables:
    """A steep sea of 5 m significant height, of `count` waves."""
    random = np.random.default_rng(seed)
    frequency = np.linspace(0.4, 1.8, count)
    height = np.sqrt(frequency**-5 * np.exp(-1.25 * (0.65 / frequency) ** 4))
    k = frequency**2 / GIVEN["gravity"]
    headings = heading + spread * random.uniform(-1.0, 1.0, count)
    return wave_tables(
        1.25 * height / np.sqrt(0.5 * np.sum(height**2)),
        k,
        headings,
        frequency - speed * k * np.cos(headings),
        random.uniform(0.0, 2.0 * np.pi, count),
    )


LINE, PLANE = sea(37, 2.6), sea(160, 2.6, spread=1.2)
STOKES = wave_tables([2.0], [0.06], [2.0], [0.9], [0.3], second_order=True)


def poses(count: int, *, yaw: float = 0.05) -> np.ndarray:
    random = np.random.default_rng(3)
    scatter = [100.0, 0.2, 5.0, 4.0, 1.0, 0.2, 0.03, yaw]
    return random.normal(0.0, scatter, (count, 8)) + np.eye(8)[1]


def dynamic(panels: PanelTables, waves: WaveTables, given: np.ndarray) -> np.ndarray:
    """Largest load of the waves (6,) at the poses."""
    still = given * (np.arange(8) != 1)
    loads = [wetted_surface_load(panels, waves, each, **GIVEN) for each in (given, still)]
    return np.abs(loads[0] - loads[1]).max(axis=0)


@pytest.mark.parametrize("waves", [LINE, PLANE], ids=["line", "plane"])
@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("rule", RULES)
def test_the_grid_gives_the_direct_load_within_its_tolerance(
    panels: PanelTables, waves: WaveTables, stretching: str, rule: str
) -> None:
    """At any heading, the grid turning with the ship a sector at a time."""
    given = np.concatenate([poses(6), poses(10, yaw=1.5)])
    settings = {**GIVEN, "stretching": stretching, "rule": rule}
    apart = np.abs(
        wetted_surface_load(panels, waves, given, method="grid", **settings)
        - wetted_surface_load(panels, waves, given, method="direct", **settings)
    )
    # Whole panels flood or not by the last bit of the elevation, though hardly by chance.
    assert (apart.max(axis=0) <= DEFAULT_TOLERANCE * dynamic(panels, waves, given)).all()
    assert apart.max() > 0.0


def test_a_turn_of_ship_and_sea_leaves_the_load_in_ship_axes(panels: PanelTables) -> None:
    """By whole sectors: the grid then is the same one, turned with them."""
    given = poses(4, yaw=0.02)
    angle = 3.0 * SECTOR
    turned = given.copy()
    turned[:, 2] = given[:, 2] * np.cos(angle) - given[:, 3] * np.sin(angle)
    turned[:, 3] = given[:, 2] * np.sin(angle) + given[:, 3] * np.cos(angle)
    turned[:, 7] += angle
    loads = [
        wetted_surface_load(panels, waves, each, method="grid", **GIVEN)
        for waves, each in ((PLANE, given), (PLANE.turned(-angle), turned))
    ]
    # Rounding of wavenumbers and phases, of some hundred turns.
    np.testing.assert_allclose(loads[1], loads[0], atol=1e-11 * np.abs(loads[0]).max())
    unturned = wetted_surface_load(panels, PLANE, turned, method="grid", **GIVEN)
    assert np.abs(unturned - loads[0]).max() > 1e-3 * np.abs(loads[0]).max()


def test_members_of_a_batch_are_bit_for_bit_what_they_are_alone(panels: PanelTables) -> None:
    """Seas, speeds and headings of every kind together, at poses near the course and far off it."""
    seas = [LINE, CALM, PLANE, STOKES, sea(37, 0.4, speed=3.0), sea(8, 1.0), PLANE, sea(300, 1.5, spread=0.8)]
    given = poses(len(seas), yaw=0.6)
    together = PressureIntegral(panels, seas, **GIVEN)
    assert set(together.methods) == {"direct", "grid"} and together.methods[1] == "direct"
    loads = together(given)
    again = together(given[::-1])[::-1]
    for i, waves in enumerate(seas):
        alone = PressureIntegral(panels, [waves], **GIVEN)
        np.testing.assert_array_equal(alone(given[i : i + 1])[0], loads[i])
        if waves is seas[len(seas) - 1 - i]:
            np.testing.assert_array_equal(again[i], loads[i])
    np.testing.assert_array_equal(together(given), loads)


def test_one_sea_serves_any_number_of_poses(panels: PanelTables) -> None:
    for waves in (LINE, sea(5, 2.0)):
        integral = PressureIntegral(panels, [waves], **GIVEN)
        given = poses(5, yaw=0.4)
        loads = integral(given)
        for count in (1, 3, 5):
            np.testing.assert_array_equal(integral(given[:count]), loads[:count])
        assert integral(given[:0]).shape == (0, 6)


def test_auto_sums_few_waves_directly_and_takes_many_from_a_grid(panels: PanelTables) -> None:
    seas = [CALM, sea(1, 2.0), sea(5, 2.0), STOKES, LINE, PLANE]
    methods = PressureIntegral(panels, seas, **GIVEN).methods
    assert methods == ("direct",) * 4 + ("grid",) * 2


def test_calm_water_needs_no_grid_and_stokes_waves_go_on_none(panels: PanelTables) -> None:
    integral = PressureIntegral(panels, [CALM], method="grid", **GIVEN)
    assert integral.methods == ("direct",)
    with pytest.raises(PanelsimError, match="Stokes"):
        PressureIntegral(panels, [STOKES], method="grid", **GIVEN)


def test_grids_are_built_once_for_each_sector(panels: PanelTables, monkeypatch: pytest.MonkeyPatch) -> None:
    built = []
    original = grid.at.wave_grid
    monkeypatch.setattr(grid.at, "wave_grid", lambda *given: built.append(1) or original(*given))
    integral = PressureIntegral(panels, [LINE], method="grid", **GIVEN)
    for yaw in (0.0, 0.04, -0.04, 0.12, 0.0, 0.12):
        integral(np.array([[3.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, yaw]]))
    assert len(built) == 2


def test_the_box_holds_the_hull_at_the_attitudes_it_is_made_for() -> None:
    box = hull_box(SHIP.vertices, SHIP.waterline, 1.0)
    x, y, z = SHIP.vertices.T
    assert box.x_low < x.min() and x.max() < box.x_high
    assert box.y_low < y.min() and y.max() < box.y_high
    assert box.depth > SHIP.waterline - z.min() + 3.0
    turned = np.abs(y) * np.cos(0.5 * SECTOR) + np.abs(x) * np.sin(0.5 * SECTOR)
    assert turned.max() < max(box.y_high, -box.y_low)


@pytest.mark.parametrize(
    ("changed", "match"),
    [
        ({"method": "magic"}, "Unknown method"),
        ({"method": None}, "Unknown method"),
        ({"rule": "corner"}, "rule"),
        ({"stretching": "much"}, "stretching"),
        ({"method": "grid", "tolerance": 0.0}, "tolerance"),
    ],
)
def test_bad_words_are_refused(panels: PanelTables, changed: dict[str, object], match: str) -> None:
    with pytest.raises(PanelsimError, match=match):
        PressureIntegral(panels, [LINE], **{**GIVEN, **changed})


def test_seas_and_poses_must_match(panels: PanelTables) -> None:
    with pytest.raises(PanelsimError, match="no sea"):
        PressureIntegral(panels, [], **GIVEN)
    with pytest.raises(PanelsimError, match="not one pose for each sea"):
        PressureIntegral(panels, [LINE, LINE], **GIVEN)(poses(3))
    with pytest.raises(PanelsimError, match="not finite"):
        PressureIntegral(panels, [LINE], **GIVEN)(np.full((1, 8), np.nan))


def test_a_launch_is_the_call_it_stands_for(panels: PanelTables) -> None:
    """It keeps its arrays alive, reads them where they are and survives a change of their contents."""
    from panelsim.kernels.wave_sums import ti

    @ti.kernel
    def scale(values: ti.types.ndarray(dtype=ti.f64, ndim=1), factor: ti.i32, negate: ti.template()):  # type: ignore[no-untyped-def]
        for i in range(values.shape[0]):
            values[i] *= factor
            if ti.static(negate):
                values[i] = -values[i]

    values = np.arange(4.0)
    launch = runtime.Launch(scale, values, 3, True)
    launch()
    np.testing.assert_array_equal(values, -3.0 * np.arange(4.0))
    values[:] = 1.0
    launch()
    np.testing.assert_array_equal(values, -3.0)


@pytest.mark.parametrize("waves", [CALM, LINE, STOKES], ids=["calm", "line", "Stokes"])
@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("rule", RULES)
def test_pressures_at_points_are_those_of_the_twin(
    panels: PanelTables, waves: WaveTables, stretching: str, rule: str
) -> None:
    """At all points that the rule takes and a wet panel has; at the others a point counts as dry."""
    settings = {**GIVEN, "stretching": stretching, "rule": rule}
    pose = poses(1)
    told = PressureIntegral(panels, [waves], method="direct", **settings).at_points(pose[0])
    twin = PressureIntegral(panels, [waves], method="oracle", **settings).at_points(pose)
    taken = np.zeros(len(panels.points), dtype=bool)
    taken[panels.panels] = rule != "panel"
    taken[panels.first_centre :][: len(panels.panels)] = rule != "vertex"
    passed_by = told.submergence == -1.0
    assert passed_by[~taken].all() and (twin.submergence[passed_by & taken] < 0.0).all()
    wet = twin.submergence > 0.0
    assert 0.3 < wet[taken].mean() < 0.9 and not passed_by[wet & taken].any()
    near = taken & ~passed_by
    for name in told._fields:
        theirs = getattr(twin, name)[near]
        # Sums of 37 waves in another order, and phases of some hundred turns.
        np.testing.assert_allclose(getattr(told, name)[near], theirs, atol=1e-11 * np.abs(theirs).max())
    if rule == "vertex+centre":
        corners = panels.panels[(twin.submergence[panels.panels] > 0.0).any(axis=1)]
        assert near[corners].all()


def test_pressures_at_points_come_from_the_grid_too(panels: PanelTables) -> None:
    pose = poses(1)[0]
    told = {
        method: PressureIntegral(panels, [PLANE], method=method, **GIVEN).at_points(pose)
        for method in ("grid", "direct")
    }
    wet = told["direct"].submergence > 0.0
    apart = (told["grid"].pressure - told["direct"].pressure)[wet] / (1025.0 * 9.80665)
    assert 0.0 < np.abs(apart).max() < DEFAULT_TOLERANCE * 4.0 * PLANE.standard_deviation
    with pytest.raises(PanelsimError, match="one sea and one pose"):
        PressureIntegral(panels, [PLANE, LINE], **GIVEN).at_points(pose)


def test_a_turn_from_one_sector_to_the_next_changes_the_grid(panels: PanelTables) -> None:
    """Each heading as if it were the first; full turns lead back to the same grid."""
    kept = PressureIntegral(panels, [PLANE], method="grid", **GIVEN)
    pose = poses(1)
    for yaw in np.deg2rad([0.0, 20.0, 40.0, -20.0, 20.0, 355.0, 380.0]):
        pose[0, 7] = yaw
        fresh = PressureIntegral(panels, [PLANE], method="grid", **GIVEN)
        np.testing.assert_array_equal(kept(pose), fresh(pose))
    pose[0, 7] = np.deg2rad(20.0)
    before = kept(pose)
    pose[0, 7] += 2.0 * np.pi
    # A full turn is not quite 2π in floating point.
    np.testing.assert_allclose(kept(pose), before, atol=1e-12 * np.abs(before).max())


@pytest.mark.parametrize("factor", [-1.0, 2.5])
@pytest.mark.parametrize("method", ["direct", "grid"])
def test_any_factor_on_the_waves_is_bounded_by_its_size(
    panels: PanelTables, method: str, factor: float
) -> None:
    """A hull that hangs above calm water meets crests only; a bound of wrong sign would pass them by."""
    given = poses(6)
    given[:, 1], given[:, 4] = factor, 4.0
    waves = sea(37, 2.6, spread=0.5)
    waves = replace(waves, amplitude=np.where(np.arange(37) % 2, -1.0, 1.0) * waves.amplitude)
    loads = [wetted_surface_load(panels, waves, given, method=name, **GIVEN) for name in (method, "oracle")]
    assert (loads[1][:, 2] > 0.0).any()
    allowed = {"direct": 1e-11, "grid": abs(factor) * DEFAULT_TOLERANCE}[method]
    assert (np.abs(loads[0] - loads[1]).max(axis=0) <= allowed * np.abs(loads[1]).max(axis=0)).all()


def test_a_wet_centre_among_dry_corners_counts_on_the_grid_too() -> None:
    """Flat panels of a lid so wide that a crest stands under the middle of one of them alone."""
    corners = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)]) * [30.0, 30.0, 4.0] - [
        15.0,
        15.0,
        -1.0,
    ]
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    lid = panel_tables(corners, np.array(faces))
    k = 2.0 * np.pi / np.linspace(28.0, 34.0, 12)
    waves = wave_tables(np.full(12, 0.3), k, np.tile([2.0, 0.4], 6), np.sqrt(9.81 * k), np.zeros(12))
    level = {**GIVEN, "waterline": 0.0}
    given = np.array([[0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]])
    loads = {
        method: wetted_surface_load(lid, waves, given, method=method, **level)[0]
        for method in ("grid", "direct", "oracle")
    }
    assert loads["oracle"][2] > 1e4
    np.testing.assert_allclose(loads["direct"], loads["oracle"], atol=1e-11 * loads["oracle"][2])
    np.testing.assert_allclose(loads["grid"], loads["oracle"], atol=1e-5 * loads["oracle"][2])


def test_grids_of_other_makes_share_a_batch(panels: PanelTables) -> None:
    """Lines and planes of 8 and of 16 depth terms."""
    short = wave_tables(
        [0.1] * 40, np.linspace(0.5, 4.0, 40), [2.0] * 40, np.linspace(2.0, 6.0, 40), np.arange(40.0) % 6
    )
    seas = [
        LINE,
        PLANE,
        short,
        replace(short, wavenumber_y=short.wavenumber_y * np.linspace(-1, 1, 40)),
        LINE,
    ]
    given = poses(len(seas))
    together = PressureIntegral(panels, seas, method="grid", **GIVEN)
    makes = {(made.plan.kind, made.plan.depth.terms) for made in together._parts[0][1]._grids.values()}
    assert len(makes) > 2 and {terms for _, terms in makes} == {8, 16}
    for i, waves in enumerate(seas):
        alone = PressureIntegral(panels, [waves], method="grid", **GIVEN)
        np.testing.assert_array_equal(alone(given[i : i + 1])[0], together(given)[i])


def test_a_launch_takes_no_more_rows_than_it_can_count(
    panels: PanelTables, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Else the row numbers of the last seas would begin again at the first."""
    given, seas = poses(5), [LINE, PLANE, LINE, sea(60, 1.0), PLANE]
    loads = PressureIntegral(panels, seas, method="grid", **GIVEN)(given)
    monkeypatch.setattr(grid.at, "MOST_ROWS", 3000)
    split = PressureIntegral(panels, seas, method="grid", **GIVEN)
    assert len(split._parts[0][1]._launched) > 2
    np.testing.assert_array_equal(split(given), loads)


def test_many_waves_of_second_order_are_summed_directly(panels: PanelTables) -> None:
    many = replace(LINE, second_order=True)
    assert PressureIntegral(panels, [many, LINE], **GIVEN).methods == ("direct", "grid")


def test_waves_too_low_to_count_are_no_reason_for_a_fine_grid(panels: PanelTables) -> None:
    amplitude, k = np.append(LINE.amplitude, [0.0, 1e-170]), np.append(LINE.wavenumber, [1e3, 1e3])
    low = wave_tables(
        amplitude,
        k,
        np.full(39, 2.6),
        np.append(LINE.encounter_frequency, [9.0, 9.0]),
        np.append(LINE.phase, [0.0, 0.0]),
    )
    given = poses(2)
    np.testing.assert_allclose(
        wetted_surface_load(panels, low, given, method="grid", **GIVEN),
        wetted_surface_load(panels, LINE, given, method="grid", **GIVEN),
        rtol=1e-10,
    )
    still = wave_tables([1e-170], [0.1], [1.0], [1.0], [0.0])
    assert PressureIntegral(panels, [still], method="grid", **GIVEN).methods == ("direct",)


@pytest.mark.parametrize("length", [1.0, 15.0])
def test_small_hulls_have_a_finer_grid(length: float) -> None:
    """Their wave load is what is left of pressures that all but cancel."""
    scale = length / 124.5
    small = panel_tables(SHIP.vertices * scale, SHIP.mesh.panels)
    level = {**GIVEN, "waterline": SHIP.waterline * scale}
    given = poses(6, yaw=0.02)
    given[:, 2:5] *= scale
    k, phase = PLANE.wavenumber_x, PLANE.phase
    crest = [
        np.sum(
            PLANE.amplitude * np.cos(k * x + PLANE.wavenumber_y * y - PLANE.encounter_frequency * t - phase)
        )
        for t, x, y in given[:, [0, 2, 3]]
    ]
    given[:, 4] += crest  # it rides the waves
    apart = np.abs(
        wetted_surface_load(small, PLANE, given, method="grid", **level)
        - wetted_surface_load(small, PLANE, given, method="direct", **level)
    )
    weight = wetted_surface_load(small, CALM, np.zeros((1, 8)), **level)[0, 2]
    # Of the weight; a least tolerance of 1e-7 of the elevation is some ten thousandth of a hull of one metre.
    assert apart[:, 2].max() < {1.0: 2e-5, 15.0: 2e-6}[length] * weight


def test_threads_may_share_an_integral(panels: PanelTables) -> None:
    """One at a time: the methods write into arrays of their own."""
    integral = PressureIntegral(panels, [LINE], **GIVEN)
    given = poses(64)
    alone = integral(given)
    with ThreadPoolExecutor(4) as pool:
        loads = list(pool.map(lambda pose: integral(pose[None])[0], given))
    np.testing.assert_array_equal(loads, alone)
