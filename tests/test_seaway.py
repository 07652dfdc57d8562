"""Spectra, components and the seaway in translating axes."""

import numpy as np
import pytest
from scipy.integrate import quad

from panelsim.conventions import KNOT, STANDARD_GRAVITY
from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents, repeat_time
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.translating import TranslatingSeaway

GRID = 0.1 * np.arange(2, 21)
SPEED = 20 * KNOT


def report_sea(heading_deg: float = 150.0, seed: int = 1001) -> RandomSeaway:
    """The sea of TM 2003-190 section 8.4."""
    return RandomSeaway(Bretschneider(7.5, 15.0), GRID, np.deg2rad(heading_deg), seed)


def test_bretschneider_against_a_published_density() -> None:
    """H_s 1 m, T_p 5 s at 1 rad/s: S = (5/16)(2π)⁴/5⁴ exp(−(5/4)(2π/5)⁴), by hand 0.034510725921325."""
    # The rounded 486.0 and 1948.2 of (42) are 0.2 % off and fail.
    assert Bretschneider(1.0, 5.0).density(1.0) == pytest.approx(0.034510725921325, rel=1e-12)


@pytest.mark.parametrize("n", [0, 1, 2])
def test_bretschneider_moments_against_quadrature(n: int) -> None:
    spectrum = Bretschneider(4.0, 10.0)
    numeric = quad(lambda w: spectrum.density(w) * w**n, 0, 3, limit=200)[0]
    numeric += quad(lambda w: spectrum.density(w) * w**n, 3, np.inf, limit=200)[0]
    assert spectrum.moment(n) == pytest.approx(numeric, rel=1e-7)  # quad's own tolerance


def test_bretschneider_periods_and_height() -> None:
    """TM 2003-190 (43), (44) and H_s = 4 √m0."""
    s = Bretschneider(3.0, 9.0)
    assert 4 * np.sqrt(s.moment(0)) == pytest.approx(3.0, rel=1e-12)
    # (43) prints 0.773 where the exact ratio is 0.7718; (44) is right to its three digits.
    assert 2 * np.pi * s.moment(0) / s.moment(1) / 9.0 == pytest.approx(0.773, abs=1.5e-3)
    assert 2 * np.pi * np.sqrt(s.moment(0) / s.moment(2)) / 9.0 == pytest.approx(0.710, abs=5e-4)
    assert s.energy_between(0.5, 1.5) == pytest.approx(quad(s.density, 0.5, 1.5)[0] / s.moment(0), rel=1e-8)


def test_fourth_moment_is_refused() -> None:
    with pytest.raises(PanelsimError, match="diverges"):
        Bretschneider(3.0, 9.0).moment(4)


def test_breaking_seas_and_waves_are_refused() -> None:
    with pytest.raises(PanelsimError, match="steeper") as refusal:
        Bretschneider(40.0, 5.0)
    assert "40 m" in str(refusal.value) and "0.142" in str(refusal.value)
    with pytest.raises(PanelsimError, match="steeper"):
        RegularSeaway(5.0, 1.0, 0.0)
    RegularSeaway(4.3, 1.0, 0.0)  # H/λ = 0.1396: just possible


def test_components_of_the_report() -> None:
    """19 components with seeded phases, amplitudes (33), 99.8 % of the energy."""
    sea = report_sea()
    c = sea.components
    assert c.count == 19
    np.testing.assert_array_equal(c.phase, np.random.default_rng(1001).uniform(0, 2 * np.pi, 19))
    np.testing.assert_allclose(c.amplitude, np.sqrt(2 * sea.spectrum.density(GRID) * 0.1), rtol=1e-12)
    assert 0.99 < sea.energy_share < 1.0
    # A 0.1 rad/s grid of this narrow spectrum holds its variance to 1 %.
    assert 4 * np.sqrt(c.variance) == pytest.approx(7.5, rel=0.01)


def test_frequencies_that_miss_the_energy_are_refused() -> None:
    with pytest.raises(PanelsimError, match="too little") as refusal:
        RandomSeaway(Bretschneider(7.5, 15.0), GRID[10:], 0.0, 1)
    assert "90.0 %" in str(refusal.value)


@pytest.mark.parametrize("frequencies", [[0.2, 2.0], [0.2, 0.25, 2.0], [0.2, 0.42, 2.0]])
def test_frequencies_too_far_apart_to_carry_the_energy_are_refused(frequencies: list[float]) -> None:
    """Their bands span 99 % of the spectrum, but √(2 S Δω) at so few points is another sea."""
    with pytest.raises(PanelsimError, match="too far apart"):
        RandomSeaway(Bretschneider(7.5, 15.0), np.array(frequencies), 0.0, 1)


def test_encounter_frequency_keeps_its_sign() -> None:
    """A wave of 1.5 rad/s from astern is overtaken at 20 knots: ω_e = 1.5 − U·1.5²/g < 0."""
    c = WaveComponents(np.ones(2), np.array([0.5, 1.5]), np.zeros(2), np.zeros(2))
    expected = c.frequency - SPEED * c.frequency**2 / STANDARD_GRAVITY
    np.testing.assert_allclose(c.encounter_frequency(SPEED), expected, rtol=1e-14)
    assert expected[1] < 0 < expected[0]


@pytest.mark.parametrize("heading_deg", [0, 30, 90, 150, 180, 250])
def test_translating_axes_see_the_same_sea_as_a_fixed_observer(heading_deg: float) -> None:
    """ζ(x, y, t) there is ζ(x + U t, y, t) of the earth-fixed sea Σ a cos(k·x − ω t − ε).

    With the modulus of ω_e, as (11) is printed, the overtaken waves (30°, 0°) run the wrong way.
    """
    c = report_sea(heading_deg).components
    moving = TranslatingSeaway(c, SPEED, STANDARD_GRAVITY)
    fixed = TranslatingSeaway(c, 0.0, STANDARD_GRAVITY)
    t = np.linspace(0, 50, 21)
    # Rounding of phases of a few hundred radians.
    np.testing.assert_allclose(
        moving.elevation(12.0, -3.0, t), fixed.elevation(12.0 + SPEED * t, -3.0, t), atol=1e-10
    )
    pressures = [
        sea.pressure(x, -3.0, -4.0, t, water_density=1000.0)
        for sea, x in ((moving, 12.0), (fixed, 12.0 + SPEED * t))
    ]
    # No factor ω_e/ω in the pressure ((16) alone would carry one): speed does not change it.
    np.testing.assert_allclose(pressures[0], pressures[1], rtol=1e-10)


def test_direction_of_travel() -> None:
    """Waves from port (β = 90°) reach port first; head waves the bow first."""
    crest_time = {}
    t = np.linspace(0, 2 * np.pi / 0.5, 4001)
    for name, heading, (x, y) in [("port", 90, (0, 5)), ("starboard", 90, (0, -5)), ("bow", 180, (5, 0))]:
        wave = RegularSeaway(1.0, 0.5, np.deg2rad(heading), phase=-np.pi).in_translating_axes(0.0)
        crest_time[name] = t[np.argmax(wave.elevation(x, y, t))]
    assert crest_time["port"] < np.pi / 0.5 < crest_time["starboard"]
    assert crest_time["bow"] < np.pi / 0.5


def test_phase_is_the_lead_of_the_crest_at_the_origin() -> None:
    """cos(−ω t − ε): the crest passes the origin ε/ω before t = 0."""
    wave = RegularSeaway(1.0, 0.5, 0.0, phase=0.3).in_translating_axes(0.0)
    assert wave.elevation(0.0, 0.0, -0.3 / 0.5) == pytest.approx(1.0, abs=1e-14)


def test_pressure_vanishes_at_the_wheeler_surface_and_is_zero_above() -> None:
    sea = report_sea().in_translating_axes(SPEED)
    t = np.linspace(0, 60, 31)
    zeta = sea.elevation(3.0, 4.0, t)
    # Rounding of ρ g ζ, some 1e5 Pa.
    np.testing.assert_allclose(sea.pressure(3.0, 4.0, zeta, t, water_density=1025.0), 0.0, atol=1e-8)
    assert np.all(sea.pressure(3.0, 4.0, zeta + 0.1, t, water_density=1025.0) == 0.0)
    assert np.all(sea.pressure(3.0, 4.0, zeta - 0.1, t, water_density=1025.0) > 0.0)
    with pytest.raises(PanelsimError, match="stretching"):
        sea.pressure(0, 0, 0, 0, water_density=1025.0, stretching="wheler")


def test_unstretched_pressure_is_linear_theory_below_calm_water() -> None:
    wave = RegularSeaway(1.0, 0.6, np.pi).in_translating_axes(0.0)
    k = 0.36 / STANDARD_GRAVITY
    expected = 1025 * STANDARD_GRAVITY * (np.cos(-0.6 * 2.0 - k * 7.0) * np.exp(-3 * k) + 3.0)
    got = wave.pressure(7.0, 0.0, -3.0, 2.0, water_density=1025.0, stretching="none")
    assert got == pytest.approx(expected, rel=1e-13)


def test_the_report_grid_repeats_after_346_seconds() -> None:
    """ω_e = 0.1 n + c n² with c = 0.01 U cos 30°/g returns where 2 c T = 2π: T = 345.8 s.

    At 150° the linear part happens to return there as well.
    """
    again = repeat_time(report_sea().components, SPEED, 1860.0)
    assert again == pytest.approx(345.8, abs=0.5)  # the peak lies where the linear part returns best
    uneven = GRID + np.random.default_rng(0).uniform(-0.04, 0.04, len(GRID))
    jittered = RandomSeaway(Bretschneider(7.5, 15.0), np.sort(uneven), np.deg2rad(150), 1)
    assert repeat_time(jittered.components, SPEED, 1860.0) is None
    assert repeat_time(RegularSeaway(1.0, 0.5, 0.0).components, SPEED, 1860.0) is None


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (lambda: Bretschneider(-1.0, 10.0), "significant_wave_height"),
        (lambda: Bretschneider(1.0, float("nan")), "peak_period"),
        (lambda: RegularSeaway(0.0, 0.5, 0.0), "wave_amplitude"),
        (lambda: RegularSeaway(1.0, 0.5, 150), "radians"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, "head", 1), "radians"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, 0.0, -1), "seed"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, 0.0, 1.5), "seed"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, 0.0, 1, float("nan")), "minimum_energy"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), [0.2, np.nan], 0.0, 1), "rise"),
        (lambda: WaveComponents(np.ones(2), np.ones(3), np.zeros(2), np.zeros(2)), "one length"),
        (lambda: RandomSeaway(Bretschneider(1, 10), GRID[::-1], 0.0, 1), "rise"),
        (lambda: WaveComponents(np.ones(2), np.array([1.0, np.nan]), np.zeros(2), np.zeros(2)), "frequency"),
        (lambda: WaveComponents(np.ones(2), np.array([1.0, -1.0]), np.zeros(2), np.zeros(2)), "not positive"),
    ],
)
def test_bad_input_is_refused(bad: object, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        bad()  # type: ignore[operator]
