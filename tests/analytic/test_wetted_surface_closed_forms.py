"""Loads of incident waves and buoyancy that linear wave theory gives in closed form.

Wave a cos(kx - ωt) along +x (heading 0) in deep water. Each printed number is computed again from
an integral over the smooth body, so that a slip in copying it would show.
"""

import numpy as np
import pytest
from scipy.integrate import dblquad, quad
from scipy.special import j1

from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables

DENSITY, GRAVITY = 1025.0, 9.81
WATER = {"waterline": 0.0, "water_density": DENSITY, "gravity": GRAVITY}
WEIGHT = DENSITY * GRAVITY


def lattice(*sheets: np.ndarray) -> PanelTables:
    """Tables of sheets of points (m, n, 3) about the origin; i towards j turns into the water."""
    vertices, panels = [], []
    for sheet in sheets:
        index = np.arange(sheet[..., 0].size).reshape(sheet.shape[:2]) + sum(map(len, vertices))
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        panels.append(np.stack(corners, axis=-1).reshape(-1, 4))
        vertices.append(sheet.reshape(-1, 3))
    return panel_tables(np.concatenate(vertices), np.concatenate(panels))


def sheet(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    return np.stack(np.broadcast_arrays(x, y, z), axis=-1)


def sphere(n: int) -> PanelTables:
    """Radius 1 about the origin, 2n x 4n panels."""
    theta, phi = np.linspace(0, np.pi, 2 * n + 1)[:, None], np.linspace(0, 2 * np.pi, 4 * n + 1)
    return lattice(sheet(np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)))


def cylinder(n: int) -> PanelTables:
    """Radius 1, draft 2, freeboard 2, upright, 4n panels around."""
    phi, r, z = (
        np.linspace(0, 2 * np.pi, 4 * n + 1),
        np.linspace(0, 1, n + 1)[:, None],
        np.linspace(-2, 2, 2 * n + 1),
    )
    side = sheet(np.cos(phi)[:, None], np.sin(phi)[:, None], z)
    bottom = sheet(r[::-1] * np.cos(phi), r[::-1] * np.sin(phi), -2.0)
    top = sheet(r * np.cos(phi), r * np.sin(phi), 2.0)
    return lattice(side, bottom, top)


def box(length: float, beam: float, draft: float, nx: int, nz: int) -> PanelTables:
    """Freeboard like the draft; one panel across, since the waves run along x."""
    x, z = np.linspace(-length / 2, length / 2, nx + 1), np.linspace(-draft, draft, nz + 1)
    y = np.array([-beam / 2, beam / 2])
    return lattice(
        sheet(x[:, None], -beam / 2, z),
        sheet(x[::-1, None], beam / 2, z),
        sheet(length / 2, y[:, None], z),
        sheet(-length / 2, y[::-1, None], z),
        sheet(x[:, None], y, draft),
        sheet(x[::-1, None], y, -draft),
    )


def along_x(wavenumber: float, amplitude: float, encounter_frequency: float = 1.0) -> WaveTables:
    return wave_tables(amplitude, wavenumber, 0.0, encounter_frequency, 0.0)


def linear_load(body: PanelTables, wavenumber: float, phase: float) -> np.ndarray:
    """Load a unit amplitude at ωt = phase [rad], the limit of small waves.

    A crest and a trough of 1e-4 m are differenced: even orders cancel and third order is 1e-8.
    """
    poses = np.zeros((2, 8))
    poses[:, 0] = phase
    poses[:, 1] = [1.0, -1.0]
    crest, trough = wetted_surface_load(body, along_x(wavenumber, 1e-4), poses, **WATER)
    return (crest - trough) / 2e-4


def measured_order(errors: list[float]) -> float:
    """Slope of the errors, each mesh twice as fine as the one before."""
    return float(-np.polyfit(np.arange(len(errors)), np.log2(errors), 1)[0])


# Froude-Krylov force over ρ g π a² ζ of a floating hemisphere of radius a (closed form, linear
# wave theory): F3 in phase with the crest at the axis, F1 against sin ωt.
HEMISPHERE = [(0.1, 0.934583, 0.064167), (0.5, 0.697808, 0.271265), (2.0, 0.140229, 0.436495)]


def hemisphere_integrals(k: float) -> tuple[float, float]:
    """The same forces from the pressure e^{kz} cos(kx - ωt) over the smooth surface."""

    def point(theta: float, phi: float) -> tuple[float, float, float]:
        return np.sin(theta) * np.cos(phi), -np.cos(theta), np.sin(theta)

    def heave(theta: float, phi: float) -> float:
        x, z, ring = point(theta, phi)
        return -np.exp(k * z) * np.cos(k * x) * z * ring

    def surge(theta: float, phi: float) -> float:
        x, z, ring = point(theta, phi)
        return np.exp(k * z) * np.sin(k * x) * x * ring

    limits = (0.0, 2 * np.pi, 0.0, np.pi / 2)
    return dblquad(heave, *limits)[0] / np.pi, dblquad(surge, *limits)[0] / np.pi


@pytest.mark.parametrize(("k", "heave", "surge"), HEMISPHERE)
def test_froude_krylov_force_on_a_hemisphere(k: float, heave: float, surge: float) -> None:
    np.testing.assert_allclose(hemisphere_integrals(k), [heave, surge], atol=1e-6)  # six digits printed
    errors = []
    for n in (8, 16, 32, 64):
        body = sphere(n)
        f3 = linear_load(body, k, 0.0)[2] / (WEIGHT * np.pi)
        f1 = linear_load(body, k, np.pi / 2)[0] / (WEIGHT * np.pi)
        errors.append(float(np.hypot(f3 - heave, f1 + surge)))
    order = measured_order(errors)
    print(f"hemisphere ka = {k}: errors {errors}, order {order:.2f}")
    assert abs(order - 2.0) < 0.15
    assert errors[-1] < 5e-4  # 128 x 256 panels on the sphere, facets inside it


def test_froude_krylov_force_on_a_truncated_cylinder() -> None:
    k, draft = 0.2, 2.0
    heave, surge = 0.666974, 0.328034  # closed form over ρ g π a² ζ, ka = 0.2, kT = 0.4
    assert np.exp(-k * draft) * 2 * j1(k) / k == pytest.approx(heave, abs=1e-6)
    assert 2 * j1(k) * (1 - np.exp(-k * draft)) / k == pytest.approx(surge, abs=1e-6)
    errors = []
    for n in (4, 8, 16, 32):
        body = cylinder(n)
        f3 = linear_load(body, k, 0.0)[2] / (WEIGHT * np.pi)
        f1 = linear_load(body, k, np.pi / 2)[0] / (WEIGHT * np.pi)
        errors.append(float(np.hypot(f3 - heave, f1 + surge)))
    order = measured_order(errors)
    print(f"cylinder: errors {errors}, order {order:.2f}")
    assert abs(order - 2.0) < 0.15
    assert errors[-1] < 5e-4  # a polygon of 128 sides is 4e-4 short of the circle


@pytest.mark.parametrize("encounter_frequency", [0.3, -0.7, 4.0])
def test_froude_krylov_heave_on_a_box_at_any_encounter_frequency(encounter_frequency: float) -> None:
    """kL = π, kT = 0.3: e^{-0.3} 2/π. The pressure must not carry ω_e/ω (TM 2003-190 (16))."""
    exact = 0.47162  # closed form over ρ g L B ζ
    assert np.exp(-0.3) * 2 / np.pi == pytest.approx(exact, abs=5e-6)
    poses = np.array([[2 * np.pi / encounter_frequency, factor, *[0.0] * 6] for factor in (1.0, -1.0)])
    body = box(np.pi, 0.628, 0.3, 200, 8)
    crest, trough = wetted_surface_load(body, along_x(1.0, 1e-4, encounter_frequency), poses, **WATER)
    heave = (crest - trough)[2] / 2e-4 / (WEIGHT * np.pi * 0.628)
    assert heave == pytest.approx(exact, abs=2e-5)  # trapezoid over 200 panels; five digits printed


# A fixed box of 20 x 10 m, draft 2 m, in a Wheeler-stretched wave of length 40 m and amplitude 1 m;
# ρ 1025, g 9.81 (closed form: pressure integrated over bottom and ends, Fourier series over a period).
BOX_LENGTH, BOX_BEAM, BOX_DRAFT, BOX_WAVENUMBER = 20.0, 10.0, 2.0, 2 * np.pi / 40.0
HEAVE_HARMONICS = {0: -115721.5, 1: 943782.9, 2: 0.0, 3: -963.9}  # cos nωt [N]
SURGE_HARMONICS = {1: -336491.2, 2: 0.0, 3: -2891.6}  # sin nωt [N]
LARGEST_SURGE = 333598.2  # N


def exact_box_force(wt: float, stretching: str = "wheeler") -> tuple[float, float]:
    """Heave force above buoyancy, and surge force, on the fixed box at the instant ωt."""
    k = BOX_WAVENUMBER

    def dynamic(z: float, elevation: float) -> float:
        height = z - elevation if stretching == "wheeler" else min(z, 0.0)
        return elevation * np.exp(k * height)

    def bottom(x: float) -> float:
        return dynamic(-BOX_DRAFT, np.cos(k * x - wt))

    def end(x: float) -> float:
        elevation = np.cos(k * x - wt)
        below, above = min(elevation, 0.0), max(elevation, 0.0)  # the integrand has a kink at z = 0
        pieces = ((-BOX_DRAFT, below), (0.0, above))
        return sum(quad(lambda z: -z + dynamic(z, elevation), *piece)[0] for piece in pieces)

    heave = WEIGHT * BOX_BEAM * quad(bottom, -BOX_LENGTH / 2, BOX_LENGTH / 2)[0]
    surge = WEIGHT * BOX_BEAM * (end(-BOX_LENGTH / 2) - end(BOX_LENGTH / 2))
    return heave, surge


def harmonics(force: np.ndarray, basis: str, order: int, wt: np.ndarray) -> float:
    wave = np.cos(order * wt) if basis == "cos" else np.sin(order * wt)
    return float((force * wave).mean() * (1 if order == 0 else 2))


def harmonic_table(heave: np.ndarray, surge: np.ndarray, wt: np.ndarray) -> np.ndarray:
    return np.array(
        [harmonics(heave, "cos", n, wt) for n in HEAVE_HARMONICS]
        + [harmonics(surge, "sin", n, wt) for n in SURGE_HARMONICS]
    )


# The linear rule is of second order; the other, exact for a quadratic pressure, of third where the surface
# cuts the panels and of fourth below.
ORDERS = [("vertex", 1.85, 2.15), ("vertex+centre", 2.55, 4.2)]

EXACT_HARMONICS = np.array([*HEAVE_HARMONICS.values(), *SURGE_HARMONICS.values()])
PERIOD = np.linspace(0, 2 * np.pi, 64, endpoint=False)


def test_the_printed_harmonics_of_the_wheeler_box_follow_from_its_pressure_integral() -> None:
    heave, surge = np.array([exact_box_force(wt) for wt in PERIOD]).T
    # Printed to 0.1 N; 64 instants resolve harmonics far beyond the third.
    np.testing.assert_allclose(harmonic_table(heave, surge, PERIOD), EXACT_HARMONICS, atol=0.1)
    assert np.abs(surge).max() == pytest.approx(LARGEST_SURGE, rel=1e-5)


@pytest.mark.parametrize(("rule", "least_order", "largest_order"), ORDERS)
def test_fixed_box_in_a_wheeler_wave_has_the_harmonics_of_the_closed_form(
    rule: str, least_order: float, largest_order: float
) -> None:
    poses = np.zeros((len(PERIOD), 8))
    poses[:, 0], poses[:, 1] = PERIOD, 1.0
    buoyancy = WEIGHT * BOX_LENGTH * BOX_BEAM * BOX_DRAFT
    # More digits than the printed ones have, which the test above checks against the same integral.
    exact = harmonic_table(*np.array([exact_box_force(wt) for wt in PERIOD]).T, PERIOD)
    errors = []
    for n in (10, 20, 40, 80):
        body = box(BOX_LENGTH, BOX_BEAM, BOX_DRAFT, 2 * n, n)
        load = wetted_surface_load(body, along_x(BOX_WAVENUMBER, 1.0), poses, rule=rule, **WATER)
        found = harmonic_table(load[:, 2] - buoyancy, load[:, 0], PERIOD)
        errors.append(np.abs(found - exact))
    totals = [float(np.linalg.norm(error)) for error in errors]
    order = measured_order(totals)
    print(f"Wheeler box: errors {totals} N, order {order:.2f}; finest by harmonic {errors[-1].round(1)} N")
    assert least_order < order < largest_order
    # One part in a thousand of each harmonic, and of the first one for those that vanish.
    scale = np.where(EXACT_HARMONICS == 0, 300e3, np.abs(EXACT_HARMONICS))
    assert (errors[-1] < 1e-3 * scale).all()
    assert np.abs(load[:, 0]).max() == pytest.approx(LARGEST_SURGE, rel=1e-3)


@pytest.mark.parametrize(("rule", "least_order", "largest_order"), ORDERS)
def test_fixed_box_in_an_unstretched_wave_keeps_the_pressure_on_the_cut(
    rule: str, least_order: float, largest_order: float
) -> None:
    """Without stretching the pressure at a trough is not zero: the surge force over a period.

    Taking it as zero on the cut, as Wheeler's is, would leave an error of first order.
    """
    poses = np.zeros((len(PERIOD), 8))
    poses[:, 0], poses[:, 1] = PERIOD, 1.0
    exact = np.array([exact_box_force(wt, "none")[1] for wt in PERIOD])
    errors = []
    for n in (10, 20, 40, 80):
        body = box(BOX_LENGTH, BOX_BEAM, BOX_DRAFT, 2 * n, n)
        load = wetted_surface_load(
            body, along_x(BOX_WAVENUMBER, 1.0), poses, stretching="none", rule=rule, **WATER
        )
        errors.append(float(np.sqrt(((load[:, 0] - exact) ** 2).mean())))
    order = measured_order(errors)
    print(f"unstretched box: surge errors {errors} N, order {order:.2f}")
    assert least_order < order < largest_order
    assert errors[-1] < 1e-4 * np.abs(exact).max()


def pressure_below_surface(depth: float, crest_or_trough: float, stretching: str) -> float:
    """Head [m] at `depth` under a crest (+1) or trough (-1) of 1 m, wave length 40 m.

    From the lift of a box small against the wave, whose bottom is there.
    """
    side = 1e-3
    body = box(side, side, 2.0, 1, 16)
    pose = np.zeros((1, 8))
    pose[0, 1] = crest_or_trough
    pose[0, 4] = crest_or_trough - depth + 2.0
    load = wetted_surface_load(body, along_x(BOX_WAVENUMBER, 1.0), pose, stretching=stretching, **WATER)
    return float(load[0, 2] / (WEIGHT * side**2))


@pytest.mark.parametrize("elevation", [1.0, -1.0])
@pytest.mark.parametrize("depth", [1e-6, 0.5, 1.5])
def test_pressure_at_a_depth_below_crest_and_trough(elevation: float, depth: float) -> None:
    """Wheeler: zero at the surface itself; unstretched: not zero there under a trough."""
    k, z = BOX_WAVENUMBER, elevation - depth
    wheeler = -z + elevation * np.exp(-k * depth)
    linear = -z + elevation * np.exp(k * min(z, 0.0))
    # The curvature of the wave over a box of 1 mm is (k 1 mm)² = 2e-8.
    assert pressure_below_surface(depth, elevation, "wheeler") == pytest.approx(wheeler, abs=1e-7)
    assert pressure_below_surface(depth, elevation, "none") == pytest.approx(linear, abs=1e-7)
    assert wheeler < 2 * depth


@pytest.mark.parametrize("stretching", ["wheeler", "none"])
def test_a_wave_far_longer_than_the_ship_is_a_tide(stretching: str) -> None:
    """Heave force of a tide of 0.7 m: ρ g L B (draft + 0.7), as if the box had sunk by it."""
    load = wetted_surface_load(
        box(20.0, 10.0, 2.0, 8, 8),
        along_x(1e-9, 0.7),
        np.array([[0.0, 1.0, *[0.0] * 6]]),
        stretching=stretching,
        **WATER,
    )
    assert load[0, 2] == pytest.approx(WEIGHT * 200.0 * 2.7, rel=1e-8)  # decay over 3 m at k = 1e-9


def test_waterplane_stiffness_is_the_derivative_of_the_lift() -> None:
    """-dF3/dη3 = ρ g A_wp; the sphere's circle, and the exact polygon that its panels float on."""
    body, step = sphere(24), 1e-4
    poses = np.zeros((2, 8))
    poses[:, 4] = [step, -step]
    up, down = wetted_surface_load(body, along_x(1.0, 0.0), poses, **WATER)[:, 2]
    polygon = 48 * np.sin(2 * np.pi / 96)
    # The first facets lean in by half of 180°/48, which takes 3e-6 of the area over the step.
    assert (down - up) / (2 * step) == pytest.approx(WEIGHT * polygon, rel=1e-5)
    assert polygon == pytest.approx(np.pi, rel=1e-3)
