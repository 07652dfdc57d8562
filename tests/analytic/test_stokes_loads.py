"""Loads of Stokes waves: elevation of second order, potential of first order, TM 2003-190 section 2.2.

The exact values are worked out here from the formulas for pressure and elevation alone. A wave
a cos(kx - ωt) along +x, θ its phase at the origin; heads are pressures over ρ g [m].
"""

import numpy as np
import pytest
from scipy.integrate import quad

from panelsim.kernels import oracle
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables

HEADS = {"waterline": 0.0, "water_density": 1.0, "gravity": 1.0}  # ρ g = 1: loads are heads times areas
WAVENUMBER = 2 * np.pi / 40.0
AMPLITUDE = 2.0  # H/λ = 1/10: the second order is 0.31 m
LENGTH, BEAM, DRAFT, FREEBOARD = 20.0, 6.0, 4.0, 4.0
SMALL = 1e-3  # m: side of a probe, over which the curvature of the wave is (k 1 mm)² = 2e-8
PHASES = np.linspace(0, 2 * np.pi, 12, endpoint=False)
ORDERS = {"linear": False, "stokes": True}


def wave(
    theta: float = 0.0, *, second_order: bool = True, amplitude: float = AMPLITUDE, heading: float = 0.0
) -> WaveTables:
    """The wave with phase θ [rad] at the origin at t = 0, encountered at 1 rad/s."""
    return wave_tables(amplitude, WAVENUMBER, heading, 1.0, -theta, second_order=second_order)


def elevations(theta: float, second_order: bool, amplitude: float = AMPLITUDE) -> tuple[float, float]:
    """First order and whole of the elevation at a phase, (17)."""
    first = amplitude * np.cos(theta)
    return first, first + 0.5 * amplitude**2 * WAVENUMBER * np.cos(2 * theta) * second_order


def exact_head(z: float, theta: float, stretching: str, second_order: bool) -> float:
    first, whole = elevations(theta, second_order)
    height = z - whole if stretching == "wheeler" else min(z, 0.0)
    return float(-z + first * np.exp(WAVENUMBER * height))


def slope(errors: list[float]) -> float:
    """Fitted order of errors, each mesh twice as fine as the one before."""
    return float(-np.polyfit(np.arange(len(errors)), np.log2(errors), 1)[0])


# --- the head at a point ---


def head_on_a_plate(z: float, theta: float, stretching: str, second_order: bool) -> float:
    """Head on a small level plate that looks down at z [m]; 0 where it is dry."""
    s = SMALL / 2
    plate = panel_tables(np.array([[-s, -s, 0], [-s, s, 0], [s, s, 0], [s, -s, 0]]), np.array([[0, 1, 2, 3]]))
    pose = np.array([[0.0, 1.0, 0, 0, z, 0, 0, 0]])
    load = wetted_surface_load(
        plate, wave(theta, second_order=second_order), pose, stretching=stretching, **HEADS
    )
    return float(load[0, 2] / SMALL**2)


@pytest.mark.parametrize("stretching", ["wheeler", "none"])
@pytest.mark.parametrize(("theta", "wet_by_linear"), [(0.0, False), (np.pi, False), (np.pi / 2, True)])
def test_crests_are_higher_troughs_flatter_and_flanks_lower(
    theta: float, wet_by_linear: bool, stretching: str
) -> None:
    """A plate half way between the linear surface and Stokes': one of them leaves it dry.

    With -½ a² k cos 2θ every one is the other way round; a crest bound of first order misses the first.
    """
    first, whole = elevations(theta, True)
    assert (whole > first) == (not wet_by_linear)
    z = (first + whole) / 2
    linear = head_on_a_plate(z, theta, stretching, False)
    stokes = head_on_a_plate(z, theta, stretching, True)
    assert (linear != 0.0) == wet_by_linear
    assert (stokes != 0.0) == (not wet_by_linear)
    found, exact = (
        (linear, exact_head(z, theta, stretching, False))
        if wet_by_linear
        else (stokes, exact_head(z, theta, stretching, True))
    )
    assert found == pytest.approx(exact, abs=1e-6)  # the wave slopes by 0.3 over the plate's 1 mm, evenly


@pytest.mark.parametrize("stretching", ["wheeler", "none"])
@pytest.mark.parametrize("depth", [1e-3, 0.5, 3.0])
@pytest.mark.parametrize("theta", PHASES[[0, 2, 3, 6, 7]])
def test_head_at_a_depth(theta: float, depth: float, stretching: str) -> None:
    z = elevations(theta, True)[1] - depth
    found = head_on_a_plate(z, theta, stretching, True)
    assert found == pytest.approx(exact_head(z, theta, stretching, True), abs=1e-6)


def test_a_growing_wave_has_the_square_of_its_factor_in_the_second_order() -> None:
    """Half the amplitude by the ramp: the same load as of a wave of half the amplitude."""
    body = box(4)
    pose = np.array([[0.3, 0.5, 0, 0, 0, 0.1, 0, 0]])
    grown = wetted_surface_load(body, wave(0.2), pose, **HEADS)
    pose[0, 1] = 1.0
    half = wetted_surface_load(body, wave(0.2, amplitude=0.5 * AMPLITUDE), pose, **HEADS)
    np.testing.assert_array_equal(grown, half)  # a factor of two is exact


# --- the head at the surface itself ---


def head_at_the_cut(theta: float, stretching: str, second_order: bool) -> float:
    """Mean head on a small wall whose wet part reaches 1e-6 m down from the cut: half of it is the cut's."""
    depth = 1e-6
    corners = np.array([[0, 0, -depth], [0, SMALL, -depth], [0, SMALL, depth], [0, 0, depth]])
    wall = panel_tables(corners, np.array([[0, 1, 2, 3]]))  # looks towards +x
    pose = np.array([[0.0, 1.0, 0, 0, elevations(theta, second_order)[1], 0, 0, 0]])
    load = wetted_surface_load(
        wall, wave(theta, second_order=second_order), pose, stretching=stretching, **HEADS
    )
    return float(-load[0, 0] / (SMALL * depth))


@pytest.mark.parametrize("theta", PHASES)
def test_wheeler_head_at_the_surface_is_minus_the_second_order(theta: float) -> None:
    """-½ a² k cos 2θ in Stokes waves, 0 in linear ones; a cut at zero head would give half of it."""
    first, whole = elevations(theta, True)
    # Head and depth change by no more than 1.3 to 1 over 1e-6 m.
    assert head_at_the_cut(theta, "wheeler", True) == pytest.approx(first - whole, abs=2e-6)
    assert head_at_the_cut(theta, "wheeler", False) == pytest.approx(0.0, abs=2e-6)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("theta", PHASES)
def test_unstretched_head_at_the_surface_vanishes_on_linear_crests_only(theta: float, order: str) -> None:
    """Σ a cos θ exp(k min(ζ, 0)) - ζ: above calm water minus the second order, below it more."""
    first, whole = elevations(theta, ORDERS[order])
    exact = exact_head(whole, theta, "none", ORDERS[order])
    assert head_at_the_cut(theta, "none", ORDERS[order]) == pytest.approx(exact, abs=2e-6)
    if whole > 0.0:
        assert exact == pytest.approx(first - whole, abs=1e-12)
    elif np.cos(theta) < -0.1:
        assert exact > first - whole + 0.1  # a (1 - e^(-k a)) = 0.54 m at the trough


@pytest.mark.parametrize(("theta", "stretching"), [(0.0, "wheeler"), (np.pi, "wheeler"), (np.pi, "none")])
def test_head_interpolated_to_the_cut_converges_with_the_square_of_the_edge(
    theta: float, stretching: str
) -> None:
    """A triangle with one wet corner below crest or trough, so that both its cuts are alike.

    Its load is A t² (p0 + 2 p_cut)/3 with t = d0/(d0 - d1), hence p_cut; zero there does not converge.
    """
    whole = elevations(theta, True)[1]
    exact = exact_head(whole, theta, stretching, True)
    errors = []
    for size in (1.6, 0.8, 0.4, 0.2):
        corners = np.array([[0, 0, whole - size], [size, 0, whole + size], [-size, 0, whole + size]])
        load = wetted_surface_load(
            panel_tables(corners, np.array([[0, 1, 2, 2]])),
            wave(theta),
            np.array([[0.0, 1.0, *[0.0] * 6]]),
            stretching=stretching,
            rule="vertex",  # linear from corner to corner
            **HEADS,
        )
        d1 = elevations(theta + WAVENUMBER * size, True)[1] - corners[1, 2]
        t = size / (size - d1)
        p0 = exact_head(corners[0, 2], theta, stretching, True)
        mean = load[0, 1] / (2 * size**2 * t**2)  # it looks to starboard: pressure pushes to port
        errors.append(abs((3 * mean - p0) / 2 - exact))
    print(f"{stretching} at {theta:.2f}: exact {exact:.4f} m, errors {errors}, order {slope(errors):.2f}")
    assert abs(slope(errors) - 2.0) < 0.15
    assert errors[-1] < 0.01 * abs(exact)


# --- a wall-sided box ---


def box(n: int) -> PanelTables:
    """The box in 2n x n panels, one across; keel at -DRAFT."""
    x, z = np.linspace(-LENGTH / 2, LENGTH / 2, 2 * n + 1), np.linspace(-DRAFT, FREEBOARD, 2 * n + 1)
    y = np.array([-BEAM / 2, BEAM / 2])
    sheets = (
        (x[:, None], -BEAM / 2, z),
        (x[::-1, None], BEAM / 2, z),
        (LENGTH / 2, y[:, None], z),
        (-LENGTH / 2, y[::-1, None], z),
        (x[:, None], y, FREEBOARD),
        (x[::-1, None], y, -DRAFT),
    )
    vertices, panels, count = [], [], 0
    for sheet in sheets:
        points = np.stack(np.broadcast_arrays(*sheet), axis=-1)
        index = np.arange(points[..., 0].size).reshape(points.shape[:2]) + count
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        panels.append(np.stack(corners, axis=-1).reshape(-1, 4))
        vertices.append(points.reshape(-1, 3))
        count += index.size
    return panel_tables(np.concatenate(vertices), np.concatenate(panels))


def exact_box_load(wt: float, stretching: str, second_order: bool) -> np.ndarray:
    """Surge and heave over ρ g and pitch moment about the origin, by quadrature over ends and bottom."""

    def end(x: float) -> tuple[float, float]:
        theta = WAVENUMBER * x - wt
        top = elevations(theta, second_order)[1]
        kink = [0.0] if top > 0.0 else []  # the unstretched decay ends there
        force, moment = (
            quad(
                lambda z, power=power: z**power * exact_head(z, theta, stretching, second_order),
                -DRAFT,
                top,
                points=kink,
            )[0]
            for power in (0, 1)
        )
        return BEAM * force, BEAM * moment

    def bottom(x: float) -> float:
        return exact_head(-DRAFT, WAVENUMBER * x - wt, stretching, second_order)

    (aft, aft_moment), (fore, fore_moment) = end(-LENGTH / 2), end(LENGTH / 2)
    heave, trim = (
        BEAM * quad(lambda x, power=power: x**power * bottom(x), -LENGTH / 2, LENGTH / 2)[0]
        for power in (0, 1)
    )
    return np.array([aft - fore, heave, aft_moment - fore_moment - trim])


@pytest.mark.parametrize(
    ("rule", "least_order", "largest_order"), [("vertex", 1.85, 2.15), ("vertex+centre", 2.55, 4.2)]
)
@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("stretching", ["wheeler", "none"])
def test_fixed_box_feels_the_integral_of_the_pressure_over_its_wet_walls(
    stretching: str, order: str, rule: str, least_order: float, largest_order: float
) -> None:
    """Surge, heave and pitch over a period, to a thousandth of their dynamic part.

    Zero head on the cut of a Stokes wave is an error of first order; with the other sign of the second
    order surge is off by parts in a hundred.
    """
    poses = np.zeros((len(PHASES), 8))
    poses[:, 0], poses[:, 1] = PHASES, 1.0
    exact = np.array([exact_box_load(wt, stretching, ORDERS[order]) for wt in PHASES])
    calm = np.array([0.0, LENGTH * BEAM * DRAFT, 0.0])
    dynamic = np.abs(exact - calm).max(axis=0)
    errors = []
    for n in (10, 20, 40, 80):
        load = wetted_surface_load(
            box(n), wave(second_order=ORDERS[order]), poses, stretching=stretching, rule=rule, **HEADS
        )
        errors.append(np.abs((load[:, [0, 2, 4]] - exact) / dynamic).max(axis=0))
    fitted = slope([float(np.linalg.norm(error)) for error in errors])
    print(f"{rule}, {stretching}, {order}: error of surge, heave, pitch {errors[-1]}, order {fitted:.2f}")
    assert least_order < fitted < largest_order
    assert errors[-1].max() < 1e-3


def test_split_triangles_converge_to_the_integral_too() -> None:
    """The brute-force reference on the coarsest box, its triangles in 1, 4 … 64 parts each."""
    pose, exact = np.array([[0.8, 1.0, *[0.0] * 6]]), exact_box_load(0.8, "wheeler", True)
    errors = []
    for levels in range(4):
        load = oracle.subdivided_load(box(2), wave(), pose, levels=levels, **HEADS)
        errors.append(float(np.linalg.norm(load[0, [0, 2, 4]] - exact)))
    print(f"errors {errors}, order {slope(errors):.2f}")
    assert abs(slope(errors) - 2.0) < 0.15
    assert errors[-1] < 1e-3 * LENGTH * BEAM * AMPLITUDE


def test_second_order_of_the_load_falls_with_the_cube_of_the_amplitude() -> None:
    """With the potential of first order and Wheeler's z - ζ the head changes by -k ζ2 a cos θ: third order.

    So the loads of Stokes waves tend to linear ones faster than the elevations do: the difference over a
    falls with a². Zero head on the cut leaves a difference of second order, slope 1.
    """
    body, poses = box(10), np.zeros((len(PHASES), 8))
    poses[:, 0], poses[:, 1] = PHASES, 1.0
    poses[:, 4:7] = [0.1, 0.2, 0.03]
    amplitudes = np.array([0.8, 0.4, 0.2, 0.1])
    difference = []
    for amplitude in amplitudes:
        linear, stokes = (
            wetted_surface_load(
                body, wave(second_order=order, amplitude=amplitude, heading=0.7), poses, **HEADS
            )
            for order in (False, True)
        )
        difference.append(np.sqrt(((stokes - linear) ** 2).mean(axis=0)) / amplitude)
    fitted = [slope(list(column)) for column in np.array(difference).T]
    print("slope of (Stokes - linear)/a, surge to yaw:", np.round(fitted, 2))
    # Terms of the next order are a k = 0.13 times smaller at the largest amplitude.
    np.testing.assert_allclose(fitted, 2.0, atol=0.15)
