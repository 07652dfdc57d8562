"""Ikeda's components of roll damping against published numbers, theory and each other."""

from dataclasses import replace

import numpy as np
import pytest

from panelsim.conventions import KNOT, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hull.sections import HullLines
from panelsim.hydro.roll_damping.bilge_keels import hull_pressure_damping, normal_force_damping
from panelsim.hydro.roll_damping.eddy import (
    bilge_radius,
    eddy_coefficient,
    lewis_parameters,
    radius_and_peak_speed,
)
from panelsim.hydro.roll_damping.hull_data import ImmersedSections, RollingHull, nondimensional
from panelsim.hydro.roll_damping.ikeda import (
    bilge_keel_damping,
    eddy_damping,
    friction_damping,
    ikeda_damping,
    ikeda_terms,
    lift_damping,
)
from panelsim.hydro.roll_damping.simplified import HullRatios, simplified_bilge_keel, simplified_eddy

FREQUENCY = 2.0 * np.pi / 9.1  # the natural roll of TM 2004-041 Table 3
TEN_DEGREES = np.deg2rad(10.0)
WALL = ImmersedSections(*np.array([[-50.0, 0.0, 50.0], [20.0] * 3, [8.0] * 3, [150.0] * 3]))


def rolling(name: str) -> RollingHull:
    form = load_hull(name)
    assert isinstance(form.shape, HullLines)
    sections = ImmersedSections.of_lines(form.shape, form.draft)
    block = float(np.trapezoid(sections.area, sections.x)) / (form.length_pp * form.beam * form.draft)
    middle = sections.coefficient[np.argmin(np.abs(sections.x))]
    height, density = form.loading.center_of_gravity_height, form.loading.water_density
    return RollingHull(form.length_pp, form.beam, form.draft, block, float(middle), height, sections, density)


FRIGATE = rolling("frigate")
KEELS = load_hull("frigate").appendages.bilge_keels


def cargo_ship(**changes: float) -> RollingHull:
    """The ship of the worked example: L/B 6, B/d 4, C_B 0.65, C_M 0.98, OG/d -0.2, 300 m long."""
    ship = RollingHull(300.0, 50.0, 12.5, 0.65, 0.98, 15.0, WALL, 102.0, 1.14e-6)
    return replace(ship, **changes)


def test_worked_example_of_kawahara() -> None:
    """B̂ at 10 degrees and ω̂ 0.6, keels 0.025 B by 0.2 L: the case of STAB 2009 Fig. 1.

    The whole, with waves, is 0.010156148773301035 (test of rolldecay-estimators, M. Alexandersson). Its parts
    are those of the authors' program of 2009 for the same case: friction 1.4880e-5, waves 3.49354e-3, eddies
    9.95030e-4, keels 5.65270e-3. The same formulas on both sides: 1e-9 is round-off.
    """
    frequency = 0.6 / np.sqrt(25.0 / 9.81)
    ratios = HullRatios(0.65, 4.0, 0.98, -0.2)
    ship = cargo_ship()
    friction = float(nondimensional(ship, np.array(friction_damping(ship, frequency, 0.0)), 9.81))
    eddy = float(simplified_eddy(ratios, TEN_DEGREES, 0.6))
    keels = float(simplified_bilge_keel(ratios, 0.025, 0.2, TEN_DEGREES, 0.6))
    assert friction == pytest.approx(1.487980862573565e-05, rel=1e-9)
    assert eddy == pytest.approx(9.95030188648203e-4, rel=1e-9)
    assert keels == pytest.approx(5.652702945162681e-3, rel=1e-9)
    assert friction + 3.4935358308644145e-3 + eddy + keels == pytest.approx(0.010156148773301035, rel=1e-9)


def test_second_case_of_the_program_of_kawahara() -> None:
    """C_B 0.56, B/d 3, C_M 0.94, OG/d -1, 18 degrees, ω̂ 0.8, keels 0.03 B by 0.3 L."""
    ratios = HullRatios(0.56, 3.0, 0.94, -1.0)
    amplitude = np.deg2rad(18.0)
    assert simplified_eddy(ratios, amplitude, 0.8) == pytest.approx(0.015435647212248412, rel=1e-9)
    keels = simplified_bilge_keel(ratios, 0.03, 0.3, amplitude, 0.8)
    assert keels == pytest.approx(0.0404518154979785, rel=1e-9)


def test_worked_example_of_the_s175() -> None:
    """Lift per m/s and force on a metre of keel of the S175, 20 s, 5 degrees (MATLAB of C.-J. Söder, by
    the tests of rolldecay-estimators).

    Its OG is a height above the water, as its lift has it; its lever takes the other sign. Its friction and
    hull pressure are of no use: m7³ for m7², m2²/(3(H0 - 0.215/m1)) for m4³/(3(H0 - 0.215 m1)), S0
    without the span.
    """
    ship = RollingHull(175.0, 25.4, 9.5, 0.58, 0.95, 9.52, WALL)
    assert lift_damping(ship, 1.0) == pytest.approx(4595742.29457220, rel=1e-9)
    k, half, above = 1.0 - np.sqrt(0.5), 25.4 / 19.0, 0.02 / 9.5
    lever = 9.5 * np.hypot(half - k * 3.0 / 9.5, 1.0 - above - k * 3.0 / 9.5)
    force = normal_force_damping(*np.array([0.4, lever, 0.95, np.deg2rad(5.0)]))
    # It has f for f², 1.0001 here.
    assert 1025.0 * 2.0 * np.pi / 20.0 * force == pytest.approx(1.384980250651594e5, rel=3e-4)


def test_eddies_of_a_box_as_measured_by_ikeda() -> None:
    """B/d 2.5, sharp corners, axis in the water, 0.175 rad at ω̂ 1: 3π/8 B̂ 0.042 measured.

    Ikeda 1978, SNAJ 142, as digitised by M. Alexandersson. Experiment and a fit of it: 10 %.
    """
    beam, draft = np.array([0.28]), np.array([0.112])
    coefficient = float(eddy_coefficient(beam, draft, np.array([1.0]), 0.0)[0])
    damping = 4.0 / (3.0 * np.pi) * 0.112**4 * 0.8 * 0.175 * coefficient  # over ρ ω
    assert 3.0 * np.pi / 8.0 * damping / (0.02509 * 0.28**2) == pytest.approx(0.042, rel=0.1)


def test_a_semicircle_sheds_no_eddies_about_its_centre() -> None:
    circle = eddy_coefficient(np.array([2.0]), np.array([1.0]), np.array([np.pi / 4]), 0.0)
    np.testing.assert_allclose(circle, 0.0, atol=1e-3)  # the fit of the pressure crosses 0 there within 1e-3


@pytest.mark.parametrize(("half", "sigma"), [(0.7, 0.9), (1.5, 0.75), (3.0, 0.6)])
def test_lewis_form_has_beam_draft_and_area(half: float, sigma: float) -> None:
    """Half-beam and draft are M (1 ± a1 + a3), the area π/2 M² (1 - a1² - 3 a3²)."""
    a1, a3 = (float(a) for a in lewis_parameters(np.array(half), np.array(sigma)))
    scale = 1.0 / (1.0 - a1 + a3)
    assert scale * (1.0 + a1 + a3) == pytest.approx(half, rel=1e-12)
    area = 0.5 * np.pi * scale**2 * (1.0 - a1**2 - 3.0 * a3**2)
    assert area == pytest.approx(2.0 * half * sigma, rel=1e-12)


@pytest.mark.parametrize(("half", "sigma"), [(0.8, 0.9), (1.25, 0.95), (1.5, 0.85), (1.5, 0.7)])
def test_peak_speed_is_that_of_the_flow_about_a_rolling_lewis_form(half: float, sigma: float) -> None:
    """z = M (ζ + a1/ζ + a3/ζ³) turns about its centre: w = iM² (a1 (1 + a3)/ζ² + a3/ζ⁴), ψ = ½|z|² on it.

    Relative to the bilge at r_max the water runs at r_max + |dw/dz| for unit roll rate.
    """
    a1, a3 = (float(a) for a in lewis_parameters(np.array(half), np.array(sigma)))
    scale = 2.0 * half / (2.0 * (1.0 + a1 + a3))
    circle = np.exp(1j * np.linspace(-0.5 * np.pi, 0.0, 20_001))
    z = scale * (circle + a1 / circle + a3 / circle**3)
    flow = scale**2 * (-2.0 * a1 * (1.0 + a3) / circle**3 - 4.0 * a3 / circle**5)
    speed = np.abs(flow / (scale * (1.0 - a1 / circle**2 - 3.0 * a3 / circle**4)))
    stream = (1j * scale**2 * (a1 * (1.0 + a3) / circle**2 + a3 / circle**4)).imag
    np.testing.assert_allclose(np.ptp(stream - 0.5 * np.abs(z) ** 2), 0.0, atol=1e-12)
    # A V-shaped section sheds at the keel; the waterline of a broad one is no bilge.
    bilge = 0 if sigma < 0.75 else int(np.argmax(np.abs(z)))
    radius, peak = (float(v) for v in radius_and_peak_speed(*np.array([2.0 * half, half, sigma])))
    assert radius == pytest.approx(abs(z[bilge]), rel=1e-6)
    # The speed has no extremum at the greatest radius: 1e-4 for the grid.
    assert peak == pytest.approx(abs(z[bilge]) + speed[bilge], rel=1e-4)


def test_eddy_coefficient_against_a_second_transcription() -> None:
    """C_R by ikeda_eddy.py of rolldecay-estimators with its scale M halved (B for B/2 there)."""
    sections = np.array([[20.0, 8.0, 0.95], [20.0, 8.0, 0.95], [12.0, 8.0, 0.85]])
    got = [
        float(eddy_coefficient(*s[:, None], og)[0]) for s, og in zip(sections, (-2.0, 2.0, -2.0), strict=True)
    ]
    np.testing.assert_allclose(
        got, [0.16088291494714113, 0.22676414249199406, 0.0032374570387515666], rtol=1e-9
    )


def test_force_on_the_keels_of_a_box() -> None:
    """Twice ½ρ C_D b (f l φ̇)² l, linearised by 8/(3π) ω φ_a: f is 1.3 at σ = 1."""
    span, lever, swing = 0.05, 1.7, 0.15
    drag = 22.5 * span / (np.pi * lever * swing * 1.3) + 2.4
    expected = 8.0 / (3.0 * np.pi) * swing * drag * span * (1.3 * lever) ** 2 * lever
    assert normal_force_damping(*np.array([span, lever, 1.0, swing])) == pytest.approx(expected, rel=1e-12)


def test_bilge_radius_takes_off_the_missing_area() -> None:
    """Two corners less two quarter circles: (2 - π/2) R² of B d (1 - σ); at most draft or half-beam."""
    radius = float(bilge_radius(np.array(1.5), np.array(0.95)))
    assert (2.0 - 0.5 * np.pi) * radius**2 == pytest.approx(3.0 * 0.05, rel=1e-12)
    np.testing.assert_allclose(bilge_radius(np.array([1.5, 0.5]), np.array([0.5, 0.5])), [1.0, 0.5])


@pytest.mark.parametrize("axis", [-1.0, -0.5, 0.0, 0.1])
@pytest.mark.parametrize("wide", [2.7, 3.3, 4.0])
@pytest.mark.parametrize("mid", [0.94, 0.98])
def test_keels_by_sections_against_the_formula_fitted_to_them(axis: float, wide: float, mid: float) -> None:
    """Keels on a midship section against STAB 2009 (38), which was fitted to keels on whole hulls.

    Measured 1.04 to 1.18 over this grid; a wrong sign of OG or a factor 2 in the pressure leaves it.
    """
    amplitude, full, span, length = TEN_DEGREES, 0.65, 0.025, 0.2
    half, draft, sigma = np.array([0.5 * wide]), np.array([1.0 / wide]), np.array([mid])
    corner = (1.0 - np.sqrt(0.5)) * bilge_radius(half, sigma)
    lever = draft * np.hypot(half - corner, 1.0 - axis - corner)
    swing = np.array([amplitude])
    on_keels = normal_force_damping(np.array([span]), lever, sigma, swing)
    on_hull = hull_pressure_damping(np.array([span]), lever, half, draft, sigma, axis / wide, swing)
    frequency = 0.6
    by_sections = (on_keels + on_hull) * frequency * length / (full * draft)
    formula = simplified_bilge_keel(HullRatios(full, wide, mid, axis), span, length, amplitude, frequency)
    np.testing.assert_allclose(by_sections / formula, 1.11, rtol=0.0, atol=0.08)


def test_pressure_of_keels_on_a_box() -> None:
    """Sharp corners: suction 1.2 + 22.5 b/(π l φ f) over a reach S0 of side and bottom, pressure 1.2 that
    falls to 0 at the water and the keel line, each with its lever about the axis, by quadrature."""
    half, axis, span, lever, swing = 1.4, -0.3, 0.05, 1.7, 0.15
    flow = 1.3  # f at σ = 1
    reach = 0.3 * np.pi * flow * lever * swing + 1.95 * span
    across, down = (np.linspace(0.0, end, 200_001) for end in (half, 1.0))
    near_bottom, near_side = across > half - reach, down > 1.0 - reach
    suction = np.trapezoid(across * near_bottom, across) + np.trapezoid((down - axis) * near_side, down)
    push = np.trapezoid(across * across / half, across) + np.trapezoid((down - axis) * down, down)
    pull = 1.2 + 22.5 * span / (np.pi * lever * swing * flow)
    expected = 4.0 / (3.0 * np.pi) * (flow * lever) ** 2 * swing * (pull * suction + 1.2 * push)
    got = hull_pressure_damping(*np.array([span, lever, half, 1.0, 1.0]), axis, np.array(swing))
    assert got == pytest.approx(expected, rel=1e-4)  # the edges of the reach fall between the samples


def test_damping_of_halifax_is_near_that_of_the_report() -> None:
    """TM 2003-190 section 8 takes 2e7 N m s for viscosity and appendages.

    Ikeda's at 20 knots and 10 degrees: 1.81e7. Skeg and rudder are not in it. A judgement of
    the report against a method: 20 %.
    """
    keels = load_hull("halifax").appendages.bilge_keels
    damping = ikeda_damping(rolling("halifax"), keels, TEN_DEGREES, FREQUENCY, 20.0 * KNOT)
    assert damping.total == pytest.approx(2.0e7, rel=0.2)


def test_growth_with_speed() -> None:
    """Friction 1 + 4.1 U/(ωL), lift as U, eddies (0.04ωL)²/((0.04ωL)² + U²), keels not at all."""
    rest, slow, fast = (
        ikeda_damping(FRIGATE, KEELS, TEN_DEGREES, FREQUENCY, speed) for speed in (0.0, 5.0, 10.0)
    )
    wave = FREQUENCY * FRIGATE.length_pp
    assert rest.lift == 0.0 < slow.lift
    assert fast.lift == pytest.approx(2.0 * slow.lift, rel=1e-12)
    assert fast.friction == pytest.approx(rest.friction * (1.0 + 41.0 / wave), rel=1e-12)
    assert fast.eddy == pytest.approx(rest.eddy / (1.0 + (10.0 / (0.04 * wave)) ** 2), rel=1e-12)
    assert fast.bilge_keel == rest.bilge_keel > 0.0


@pytest.mark.parametrize(("midship", "kappa"), [(0.92, 0.0), (0.921, 0.1), (0.97, 0.1), (0.971, 0.3)])
def test_lift_slope_changes_above_its_midship_coefficients(midship: float, kappa: float) -> None:
    """ITTC 7.5-02-07-04.5: κ is 0 for C_M up to 0.92, 0.1 up to 0.97 and 0.3 above."""
    ship = cargo_ship(midship_coefficient=midship)
    plain = lift_damping(cargo_ship(midship_coefficient=0.5), 10.0)
    flat = 2.0 * np.pi * ship.draft / ship.length_pp
    grown = flat + kappa * (4.1 * ship.beam / ship.length_pp - 0.045)
    assert lift_damping(ship, 10.0) / plain == pytest.approx(grown / flat, rel=1e-12)


def test_growth_with_amplitude_and_frequency() -> None:
    small, large = (ikeda_damping(FRIGATE, KEELS, a, FREQUENCY, 5.0) for a in (0.1, 0.2))
    assert large.eddy == pytest.approx(2.0 * small.eddy, rel=1e-12)
    assert (large.friction, large.lift) == (small.friction, small.lift)
    # The keels have a part without amplitude (vortices), one in proportion to it, and a little beyond.
    assert small.bilge_keel < large.bilge_keel < 2.0 * small.bilge_keel
    assert friction_damping(FRIGATE, 4.0 * FREQUENCY, 0.0) == pytest.approx(
        2.0 * friction_damping(FRIGATE, FREQUENCY, 0.0), rel=1e-12
    )
    assert eddy_damping(FRIGATE, 0.1, 2.0 * FREQUENCY, 0.0) == pytest.approx(
        2.0 * eddy_damping(FRIGATE, 0.1, FREQUENCY, 0.0), rel=1e-12
    )
    np.testing.assert_allclose(
        ikeda_damping(FRIGATE, KEELS, [0.1, 0.2], FREQUENCY, 5.0).total,
        [small.total, large.total],
        rtol=1e-14,
    )


def test_without_keels_nothing_of_keels_and_half_of_them_half() -> None:
    assert ikeda_damping(FRIGATE, (), TEN_DEGREES, FREQUENCY, 0.0).bilge_keel == 0.0
    keel = KEELS[4]
    middle = 0.5 * (keel.x_forward + keel.x_aft)
    halves = (replace(keel, x_aft=middle), replace(keel, x_forward=middle))
    whole = bilge_keel_damping(FRIGATE, (keel,), TEN_DEGREES, FREQUENCY)
    # Each half takes the section at its own middle, 1.5 m from that of the whole.
    assert bilge_keel_damping(FRIGATE, halves, TEN_DEGREES, FREQUENCY) == pytest.approx(whole, rel=1e-3)


def test_geosims_have_the_same_coefficients() -> None:
    """TM 2004-041 Table 3: corvette and supply ship are the frigate at another scale; only friction knows."""
    damping: list[FloatArray] = []
    for name in ("frigate", "corvette", "supply_ship"):
        ship, keels = rolling(name), load_hull(name).appendages.bilge_keels
        frequency = FREQUENCY * np.sqrt(120.0 / ship.length_pp)
        speed = 10.0 * np.sqrt(ship.length_pp / 120.0)
        parts = ikeda_damping(ship, keels, TEN_DEGREES, frequency, speed)
        hats = [nondimensional(ship, part, 9.81) for part in (parts.eddy, parts.lift, parts.bilge_keel)]
        damping.append(np.array(hats))
    # Table 3 and the particulars round beams to millimetres: 2e-4 of 8.228 m.
    np.testing.assert_allclose(damping[1:], [damping[0]] * 2, rtol=2e-3)


def test_terms_follow_the_components() -> None:
    """b1, b2 and b3 give back the sum from 2 to 20 degrees within 1 %."""
    amplitude = np.deg2rad([2.0, 7.0, 12.0, 20.0])
    expected = ikeda_damping(FRIGATE, KEELS, amplitude, FREQUENCY, 10.0).total
    terms = ikeda_terms(FRIGATE, KEELS, FREQUENCY, 10.0)
    np.testing.assert_allclose(terms.equivalent(FREQUENCY * amplitude), expected, rtol=0.01)


def test_sections_of_the_frigate() -> None:
    """Beam and draft of TM 2004-041 Table 3 at midships; σ by the trapezoid rule over its offsets."""
    sections = FRIGATE.sections
    middle = int(np.argmin(np.abs(sections.x)))
    assert sections.beam[middle] == pytest.approx(14.106, abs=0.002)
    assert sections.draft[middle] == pytest.approx(4.2, abs=1e-12)
    # Displaced volume 3643.9 m3; the sections leave out 6 m at the bow, some 23 m3.
    assert np.trapezoid(sections.area, sections.x) == pytest.approx(3643.9, rel=0.012)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: HullRatios(0.45, 3.0, 0.95, 0.0), "block_coefficient is out of range"),
        (lambda: HullRatios(0.65, 5.0, 0.95, 0.0), "beam_to_draft is out of range"),
        (lambda: HullRatios(0.51, 3.36, 0.78, -0.4), "midship_coefficient is out of range"),
        (lambda: HullRatios(0.65, 3.0, 0.95, 0.3), "axis_depth_to_draft is out of range"),
        (lambda: simplified_eddy(HullRatios(0.65, 3.0, 0.95, 0.0), 10, 0.6), "no angle in radians"),
        (lambda: simplified_eddy(HullRatios(0.65, 3.0, 0.95, 0.0), 0.1, 1.1), "out of range"),
        (lambda: simplified_eddy(HullRatios(0.65, 3.0, 0.95, 0.0), 0.0, 0.6), "not positive"),
        (
            lambda: simplified_bilge_keel(HullRatios(0.65, 3.0, 0.95, 0.0), 0.1, 0.2, 0.1, 0.6),
            "keel_span_to_beam is out of range",
        ),
        (lambda: ikeda_damping(FRIGATE, KEELS, 10.0, FREQUENCY, 0.0), "no angle in radians"),
        (lambda: ikeda_damping(FRIGATE, KEELS, -0.1, FREQUENCY, 0.0), "not positive"),
        (lambda: ikeda_damping(FRIGATE, KEELS, 0.1, 0.0, 0.0), "roll frequency is not positive"),
        (lambda: ikeda_damping(FRIGATE, KEELS, 0.1, FREQUENCY, -1.0), "speed is out of range"),
        (
            lambda: bilge_keel_damping(
                FRIGATE, (replace(KEELS[0], x_forward=70.0, x_aft=65.0),), 0.1, FREQUENCY
            ),
            "beyond the immersed sections",
        ),
        (lambda: eddy_damping(replace(FRIGATE, center_of_gravity_height=3.5), 0.1, 1.0, 0.0), "too far down"),
        (lambda: replace(FRIGATE, draft=-1.0), "draft of the rolling hull is not positive"),
        (lambda: replace(FRIGATE, block_coefficient=65.0), "block_coefficient is out of range"),
        (lambda: replace(FRIGATE, sections=None), "not ImmersedSections"),
        (lambda: ImmersedSections(*np.ones((4, 2))), "three finite numbers"),
        (lambda: ImmersedSections(*np.ones((4, 3))), "not ordered from the stern"),
        (lambda: replace(WALL, area=np.array([150.0, 170.0, 150.0])), "more area than beam times draft"),
        (lambda: replace(WALL, beam=np.ones(4)), "not equally many"),
    ],
)
def test_refusals(call: object, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        call()  # type: ignore[operator]
