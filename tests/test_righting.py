"""Righting arms in calm water: closed forms of boxes at any heel, energy, symmetry, refusals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import simpson
from scipy.optimize import brentq

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.ship.bundled import load_ship
from panelsim.ship.righting import righting_arm
from panelsim.ship.ship import Ship

HEELS = np.deg2rad(np.arange(0, 181, 15))
# Of the closed forms: the volume balances to 1e-10, over a righting arm of some metres at most.
CLOSED_FORM = 1e-8


def box_ship(beam: float = 4.0, depth: float = 2.0, draft: float = 1.0, kg: float = 1.0) -> Ship:
    """A box 10 m long."""
    corners = [(x, y, z) for z in (0.0, depth) for x, y in ((-5, -1), (5, -1), (5, 1), (-5, 1))]
    panels = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    mesh = PanelMesh(np.array(corners) * [1.0, 0.5 * beam, 1.0], np.array(panels))
    return Ship(mesh, draft=draft, center_of_gravity=(None, 0.0, kg), gyradii=(1.5, 3.0, 3.0))


def area_of(polygon: FloatArray) -> float:
    (y, z), (y1, z1) = polygon.T, np.roll(polygon, -1, axis=0).T
    return float(0.5 * np.sum(y * z1 - y1 * z))


def across(polygon: FloatArray) -> float:
    """The first coordinate of the centre of area."""
    (y, z), (y1, z1) = polygon.T, np.roll(polygon, -1, axis=0).T
    return float(np.sum((y + y1) * (y * z1 - y1 * z)) / (6.0 * area_of(polygon)))


def below(polygon: FloatArray, water: float) -> FloatArray:
    """The part of a convex polygon below a level."""
    kept = []
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if a[1] <= water:
            kept.append(a)
        if (a[1] - water) * (b[1] - water) < 0.0:
            kept.append(a + (water - a[1]) / (b[1] - a[1]) * (b - a))
    return np.array(kept)


def arm_of_section(heel: float, beam: float, depth: float, draft: float, kg: float) -> float:
    """GZ of a box from its section: a rectangle turned, and cut where it has the area of the upright."""
    half = 0.5 * beam
    corners = np.array([[-half, 0.0], [half, 0.0], [half, depth], [-half, depth]]) - [0.0, kg]
    cos, sin = np.cos(heel), np.sin(heel)
    turned = corners @ np.array([[cos, sin], [-sin, cos]])  # y to port: starboard goes down
    low, high = turned[:, 1].min(), turned[:, 1].max()
    edge = 1e-9 * (high - low)

    def excess(water: float) -> float:
        return area_of(below(turned, water)) - beam * draft

    return -across(below(turned, brentq(excess, low + edge, high - edge, xtol=1e-14)))


@pytest.mark.parametrize(("degrees", "arm"), [(5, 0.073075), (20, 0.315223), (30, 0.505181)])
def test_a_box_with_beam_4_depth_2_draft_1_and_kg_1(degrees: float, arm: float) -> None:
    """Closed forms to six digits; at 30° the deck is in the water: wall-sided it would be 0.527778."""
    heel = np.radians(degrees)
    found = righting_arm(box_ship(), [0.0, heel])
    assert found.arm == pytest.approx([0.0, arm], abs=1e-6)
    if degrees < 25:
        bm = 4.0**2 / 12.0
        wall_sided = np.sin(heel) * (0.5 + bm - 1.0 + 0.5 * bm * np.tan(heel) ** 2)
        assert found.arm[1] == pytest.approx(wall_sided, abs=CLOSED_FORM)


@pytest.mark.parametrize("draft", [0.2, 1.0, 1.95])
def test_a_box_from_upright_to_capsized(draft: float) -> None:
    """Also with 5 cm of freeboard, whose deck is under water from 1.4° on."""
    found = righting_arm(box_ship(draft=draft), HEELS)
    expected = [arm_of_section(heel, 4.0, 2.0, draft, 1.0) for heel in HEELS]
    np.testing.assert_allclose(found.arm, expected, atol=CLOSED_FORM)
    assert found.trim == pytest.approx(np.zeros(13), abs=1e-9)
    assert found.water == "calm water"


@given(
    st.floats(1.0, 8.0), st.floats(1.0, 5.0), st.floats(0.1, 0.9), st.floats(0.2, 0.8), st.floats(-3.1, 3.1)
)
@settings(deadline=None, max_examples=25)
def test_any_box_at_any_heel(beam: float, depth: float, full: float, high: float, heel: float) -> None:
    # Held in trim: short and deep boxes would rather stand on end.
    size = (beam, depth, full * depth, high * depth)
    found = righting_arm(box_ship(*size), [heel, heel + 0.01], free_trim=False)
    assert found.arm[0] == pytest.approx(arm_of_section(heel, *size), abs=CLOSED_FORM)


def test_what_is_read_off_the_curve_of_a_box() -> None:
    """KG 1 m in the middle: the same upside down, so that the arm vanishes on its side, and only there."""
    found = righting_arm(box_ship(), np.deg2rad(np.arange(0, 176, 7)))
    assert found.vanishing_heel == pytest.approx(0.5 * np.pi, abs=1e-8)
    assert found.gm == pytest.approx(
        0.5 + 4.0**2 / 12.0 - 1.0, rel=1e-6
    )  # the smallness of the heel, squared
    fine = np.linspace(0.3, 1.2, 2000)
    arms = np.array([arm_of_section(heel, 4.0, 2.0, 1.0, 1.0) for heel in fine])
    assert found.greatest_arm == pytest.approx(arms.max(), abs=1e-7)  # a flat top, heel to 4e-4 rad
    assert found.greatest_arm_heel == pytest.approx(fine[arms.argmax()], abs=1e-3)
    # G is 0.5 m above B when upright, and 1 m when on its side with half of the beam under water.
    assert found.area(0.0, 0.5 * np.pi) == pytest.approx(1.0 - 0.5, rel=2e-3)  # knots every 7 degrees


def test_a_box_with_a_high_centre_lolls_before_its_stability_vanishes() -> None:
    """GM < 0: the arm is negative first; where it rises through zero, at the loll, nothing vanishes."""
    found = righting_arm(box_ship(kg=1.9), np.deg2rad(np.arange(0, 91, 5)))
    assert found.gm == pytest.approx(0.5 + 4.0**2 / 12.0 - 1.9, rel=1e-5)
    loll = np.arctan(np.sqrt(-2.0 * found.gm / (4.0**2 / 12.0)))  # wall-sided: GM + ½ BM tan² = 0
    assert found.arm[1] < 0.0 < found.arm[5] and found.heel[1] < loll < found.heel[5]
    assert found.vanishing_heel is not None and found.vanishing_heel > found.heel[5]
    assert arm_of_section(found.vanishing_heel, 4.0, 2.0, 1.0, 1.9) == pytest.approx(0.0, abs=CLOSED_FORM)


def test_what_is_read_off_is_read_to_starboard() -> None:
    """Turned to port past its side the box has positive arms too, and larger ones, that vanish again."""
    found = righting_arm(box_ship(kg=1.2), np.deg2rad(np.arange(-175, 176, 10)))
    port = found.heel < 0.0
    assert found.arm[port].max() > found.greatest_arm + 0.1
    assert 0.0 < found.greatest_arm_heel < 0.5 * np.pi
    assert found.vanishing_heel is not None and 0.5 < found.vanishing_heel < 0.5 * np.pi
    assert arm_of_section(found.vanishing_heel, 4.0, 2.0, 1.0, 1.2) == pytest.approx(0.0, abs=CLOSED_FORM)


def test_a_curve_that_stays_above_zero_has_no_vanishing_heel() -> None:
    assert righting_arm(box_ship(), HEELS[:6]).vanishing_heel is None


@pytest.fixture(scope="module")
def frigate() -> Ship:
    return load_ship("frigate", 10.0)


def test_the_slope_at_zero_is_the_metacentric_height(frigate: Ship) -> None:
    found = righting_arm(frigate, HEELS[:3])
    # The flare of the panels has a kink at the water at rest; of a plain difference 6e-4 would be left.
    assert found.gm == pytest.approx(frigate.hydrostatics.gm_transverse, rel=1e-5)
    assert (found.heave[0], found.trim[0]) == pytest.approx((0.0, 0.0), abs=1e-8)


@pytest.mark.parametrize("free_trim", [True, False])
def test_the_area_is_the_work_that_lifts_the_ship_off_its_buoyancy(frigate: Ship, free_trim: bool) -> None:
    """Moseley: ∫ GZ cos θ dφ is the growth of the height of G over B; θ, the trim, turns the axis of heel."""
    heel = np.linspace(0.0, 2.0, 161)
    found = righting_arm(frigate, heel, free_trim=free_trim)
    mesh = PanelMesh(frigate.vertices, frigate.mesh.panels)
    lift = []
    for i in (0, -1):
        waterline = frigate.waterline - float(found.heave[i])
        part = immersed_part(mesh, heel=float(heel[i]), trim=float(found.trim[i]), waterline=waterline)
        assert part.volume * frigate.water_density == pytest.approx(frigate.mass, rel=1e-9)
        if free_trim:
            assert abs(part.volume_moment[0] / part.volume) < 1e-8 * frigate.length
        lift.append(-part.volume_moment[2] / part.volume)
    # Simpson's rule on a curve with kinks where panels go under, every 0.7 degrees.
    assert simpson(found.arm * np.cos(found.trim), heel) == pytest.approx(lift[1] - lift[0], rel=2e-5)
    assert np.all(found.trim == 0.0) != free_trim


def test_freedom_to_trim_costs_righting_arm(frigate: Ship) -> None:
    free, held = (righting_arm(frigate, HEELS[:7], free_trim=trim) for trim in (True, False))
    assert free.area(0.0, HEELS[6]) < held.area(0.0, HEELS[6])
    assert np.degrees(free.trim[4]) > 0.3  # the broad stern lifts, the bow goes down


def test_port_mirrors_starboard(frigate: Ship) -> None:
    found = righting_arm(frigate, np.deg2rad([-75, -40, -10, 0, 10, 40, 75]))
    np.testing.assert_allclose(found.arm, -found.arm[::-1], atol=1e-8)
    np.testing.assert_allclose(found.heave, found.heave[::-1], atol=1e-8)
    np.testing.assert_allclose(found.trim, found.trim[::-1], atol=1e-9)


def test_a_ship_that_rests_with_trim_starts_from_there() -> None:
    ship = load_ship("frigate", 20.0, trim_by_stern=1.0)
    found = righting_arm(ship, [-0.2, 0.0, 0.2])
    assert (found.heave[1], found.trim[1]) == pytest.approx((0.0, 0.0), abs=1e-8)
    assert found.gm == pytest.approx(ship.hydrostatics.gm_transverse, rel=1e-4)  # panels cross the water


def test_the_curve_cannot_be_changed_and_areas_add_up(frigate: Ship) -> None:
    found = righting_arm(frigate, HEELS)
    with pytest.raises(ValueError, match="read-only"):
        found.arm[0] = 1.0
    parts = found.area(0.0, 0.5) + found.area(0.5, 0.9)
    assert found.area(0.0, 0.9) == pytest.approx(parts, rel=1e-12)


@pytest.mark.parametrize(
    "heel",
    [
        [0.0],
        0.3,
        [],
        [0.0, 10.0, 20.0],  # degrees
        [0.2, 0.1],
        [0.1, 0.1],
        [0.0, np.nan],
        [0.0, np.inf],
        ["a", "b"],
        [[0.0, 0.1]],
        None,
    ],
)
def test_heels_that_make_no_curve(heel: object) -> None:
    with pytest.raises(PanelsimError, match="heel angles"):
        righting_arm(box_ship(), heel)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("lower", "upper"), [(0.0, 1.1), (-0.1, 0.5), (0.6, 0.5), (0.0, np.nan), (None, 1), (0.0, "a")]
)
def test_areas_beyond_the_curve(lower: float, upper: float) -> None:
    found = righting_arm(box_ship(), [0.0, 0.5, 1.0])
    with pytest.raises(PanelsimError, match=r"(?s)do not reach.*two heels in order, 0 to 1 rad"):
        found.area(lower, upper)
