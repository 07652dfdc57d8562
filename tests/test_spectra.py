"""Point spectra: moments in closed form and by quadrature, characteristic values, tables, encounter."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import ArrayLike
from scipy.integrate import quad
from scipy.special import exp1

from panelsim.conventions import STANDARD_GRAVITY as G
from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.characteristics import characteristics, component_characteristics
from panelsim.seaway.spectra.encounter import encounter_branches, encounter_density, encounter_energy
from panelsim.seaway.spectra.jonswap import Jonswap
from panelsim.seaway.spectra.ochi_hubble import OchiHubble
from panelsim.seaway.spectra.pierson_moskowitz import PiersonMoskowitz
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.spectra.table import TableSpectrum, read_table_spectrum

ROUNDING = 1e-12  # relative: closed forms in double precision
TWO_SYSTEMS = OchiHubble((2.0, 1.5), (14.0, 6.0), (3.0, 1.25))
TWO_PEAKS = OchiHubble((0.9, 2.0), (14.0, 6.0), (2.0, 1.0))  # the lower one first
EVERY = [Bretschneider(3.0, 9.0), Jonswap(3.0, 9.0), PiersonMoskowitz(14.0), TWO_SYSTEMS]


class Plain(PointSpectrum):
    """A spectrum that knows nothing but its density, so that the quadrature does all."""

    def __init__(self, spectrum: PointSpectrum) -> None:
        self.significant_wave_height = spectrum.significant_wave_height
        self.peak_period = spectrum.peak_period
        self._spectrum = spectrum

    def density(self, omega: ArrayLike) -> FloatArray:
        return self._spectrum.density(omega)


def gauss_moment(spectrum: PointSpectrum, n: int) -> float:
    """m_n by 40 Gauss points in each of many pieces that meet at the peak, the tail over 1/ω."""
    peak = 2 * np.pi / spectrum.peak_period
    x, weight = np.polynomial.legendre.leggauss(40)
    edges = peak * np.concatenate([np.linspace(0.05, 1.0, 39), np.linspace(1.0, 3.0, 61)[1:]])
    half, middle = 0.5 * np.diff(edges)[:, None], 0.5 * (edges[1:] + edges[:-1])[:, None]
    omega = middle + half * x
    total = np.sum(half * weight * spectrum.density(omega) * omega**n)
    inverse = (1 + x) / (6 * peak)
    return float(total + np.sum(weight / (6 * peak) * spectrum.density(1 / inverse) * inverse ** (-n - 2.0)))


# Moments.


@pytest.mark.parametrize("n", [-1, 0, 1, 2, 3])
@pytest.mark.parametrize("spectrum", EVERY, ids=lambda s: type(s).__name__)
def test_moments_by_closed_form_and_by_quadrature(spectrum: PointSpectrum, n: int) -> None:
    """Both to 1e-9 of a rule of its own that is far finer than either needs."""
    assert spectrum.moment(n) == pytest.approx(gauss_moment(spectrum, n), rel=1e-9)
    assert Plain(spectrum).moment(n) == pytest.approx(spectrum.moment(n), rel=1e-9)


@pytest.mark.parametrize("upper", [0.5, 0.8, 3.0, 12.0])
@pytest.mark.parametrize("n", [-1, 0, 2, 4, 5])
def test_moments_up_to_a_frequency(n: int, upper: float) -> None:
    for spectrum in (Bretschneider(3.0, 9.0), TWO_SYSTEMS, OchiHubble((3.0,), (9.0,), (0.6,))):
        assert spectrum.moment(n, upper) == pytest.approx(Plain(spectrum).moment(n, upper), rel=1e-9)


def test_the_fourth_moment_in_closed_form() -> None:
    """m4 to Ω is (A/4) E_1(B/Ω⁴): it grows as ln Ω, and diverges without an upper frequency."""
    a, b = 1.25 * (2 * np.pi / 9.0) ** 4 * 9.0 / 4, 1.25 * (2 * np.pi / 9.0) ** 4
    sea = Bretschneider(3.0, 9.0)
    for upper in (2.0, 20.0):
        assert sea.moment(4, upper) == pytest.approx(a / 4 * exp1(b / upper**4), rel=ROUNDING)
    assert sea.moment(4, 2e3) - sea.moment(4, 2e2) == pytest.approx(a * np.log(10.0), rel=1e-6)  # (B/Ω⁴)
    for spectrum in EVERY:
        with pytest.raises(PanelsimError, match="diverges") as refusal:
            spectrum.moment(5)
        assert "upper_frequency" in str(refusal.value)
    with pytest.raises(PanelsimError, match="n = 4"):
        sea.moment(4)
    with pytest.raises(PanelsimError, match="n = 4"):
        Jonswap(3.0, 9.0).moment(4)


def test_moments_exist_below_the_power_of_the_tail() -> None:
    """λ = 0.6 has an ω⁻³·⁴ tail: m2 exists (n < 2.4), m3 does not; λ = 1.3 has m4 and m5 (n < 5.2)."""
    broad, narrow = OchiHubble((3.0,), (9.0,), (0.6,)), OchiHubble((3.0,), (9.0,), (1.3,))
    assert broad.moment(2) == pytest.approx(quad(lambda w: broad.density(w) * w**2, 0, np.inf)[0], rel=1e-6)
    with pytest.raises(PanelsimError, match=r"n below 2\.4"):
        broad.moment(3)
    assert narrow.moment(4) > narrow.moment(4, 50.0)
    with pytest.raises(PanelsimError, match="n = 6"):
        narrow.moment(6)


def test_bretschneider_moments_and_periods() -> None:
    """m0 = H_s²/16, m2 = H_s² √(πB)/16 and m₋₁/m0 = Γ(5/4)/B^¼, T_p where S is largest."""
    sea, b = Bretschneider(3.0, 9.0), 1.25 * (2 * np.pi / 9.0) ** 4
    assert sea.moment(0) == pytest.approx(9.0 / 16, rel=ROUNDING)
    assert sea.moment(2) == pytest.approx(9.0 / 16 * np.sqrt(np.pi * b), rel=ROUNDING)
    assert sea.energy_period == pytest.approx(2 * np.pi * 0.9064024770554771 / b**0.25, rel=ROUNDING)
    assert Bretschneider.from_mean_period(3.0, 7.0).mean_period == pytest.approx(7.0, rel=ROUNDING)
    assert Bretschneider.from_zero_crossing_period(3.0, 7.0).zero_crossing_period == pytest.approx(
        7.0, rel=ROUNDING
    )


@pytest.mark.parametrize("spectrum", [*EVERY, TWO_PEAKS], ids=lambda s: type(s).__name__)
def test_the_peak_period_is_that_of_the_largest_density(spectrum: PointSpectrum) -> None:
    peak = 2 * np.pi / spectrum.peak_period
    omega = np.linspace(0.2, 3.0, 200001)
    assert omega[np.argmax(spectrum.density(omega))] == pytest.approx(peak, abs=1.4e-5)  # the search's step
    assert spectrum.density(peak) >= spectrum.density(omega).max()


@pytest.mark.parametrize("spectrum", EVERY, ids=lambda s: type(s).__name__)
def test_density_is_zero_without_a_wave_and_keeps_its_shape(spectrum: PointSpectrum) -> None:
    np.testing.assert_array_equal(spectrum.density([-1.0, 0.0, 1e-320, 1e-3, 1e200, np.inf]), 0.0)
    assert spectrum.density(np.full((2, 3), 0.7)).shape == (2, 3)
    assert np.shape(spectrum.density(0.7)) == ()
    with pytest.raises(PanelsimError, match="NaN"):
        spectrum.density([0.5, np.nan])


# Energy.


@pytest.mark.parametrize("spectrum", [*EVERY, Plain(TWO_SYSTEMS)], ids=lambda s: type(s).__name__)
def test_energy_between_and_its_inverse(spectrum: PointSpectrum) -> None:
    part = quad(spectrum.density, 0.5, 0.9, epsabs=1e-13)[0] / spectrum.moment(0)
    assert spectrum.energy_between(0.5, 0.9) == pytest.approx(part, rel=1e-9)
    assert spectrum.energy_between(0.0, np.inf) == pytest.approx(1.0, abs=1e-11)
    assert spectrum.energy_between(-1.0, 0.0) == 0.0
    for share in (1e-6, 0.1, 0.5, 0.9, 0.999, 1 - 1e-7):
        frequency = spectrum.frequency_below(share)
        assert spectrum.energy_between(0.0, frequency) == pytest.approx(share, abs=1e-11)
    assert spectrum.frequency_below(0.0) == 0.0
    assert spectrum.frequency_below(1.0) == np.inf


def test_the_share_of_the_far_tail() -> None:
    """Past 30 ω_p lies 1 − exp(−(5/4)/30⁴) = 1.5e-6 of a Bretschneider sea, here by quadrature."""
    sea = Plain(Bretschneider(3.0, 9.0))
    assert sea.energy_between(30 * 2 * np.pi / 9.0, np.inf) == pytest.approx(
        -np.expm1(-1.25 / 30**4), abs=1e-11
    )


# JONSWAP and Ochi-Hubble.


def test_how_far_jonswap_is_from_its_height() -> None:
    """4 √m0 against the nominal H_s over γ = 1 … 10, as the docstring of Jonswap states it."""

    def error(gamma: float, normalisation: str) -> float:
        return 4 * np.sqrt(Jonswap(2.0, 9.0, gamma, normalisation=normalisation).moment(0)) / 2.0 - 1

    gammas = np.linspace(1.0, 10.0, 37)
    goda = np.array([error(gamma, "goda") for gamma in gammas])
    assert -0.0023 < goda.min() < -0.0021 and 0.00005 < goda.max() < 0.0001
    logarithmic = np.array([error(gamma, "logarithmic") for gamma in gammas])
    upto_5 = logarithmic[gammas <= 5.0]
    assert -0.0017 < upto_5.min() < -0.0015 and 0.0013 < upto_5.max() < 0.0015
    assert -0.0355 < logarithmic[-1] == logarithmic.min() < -0.035
    assert -0.016 < error(20.0, "goda") < -0.015


def test_jonswap_without_enhancement_is_bretschneider() -> None:
    """Exactly by the logarithmic level 5/16; Goda's 0.0624/0.1998 is 0.07 % lower in density."""
    omega, sea = np.linspace(0.1, 3.0, 59), Bretschneider(3.0, 9.0)
    exact = Jonswap(3.0, 9.0, 1.0, normalisation="logarithmic")
    np.testing.assert_allclose(exact.density(omega), sea.density(omega), rtol=ROUNDING)
    goda = Jonswap(3.0, 9.0, 1.0)
    np.testing.assert_allclose(goda.density(omega), (1 - 0.00064) * sea.density(omega), rtol=1e-5)


def test_one_system_of_shape_one_is_bretschneider() -> None:
    one, sea = OchiHubble((3.0,), (9.0,), (1.0,)), Bretschneider(3.0, 9.0)
    omega = np.linspace(0.05, 5.0, 100)
    np.testing.assert_allclose(one.density(omega), sea.density(omega), rtol=ROUNDING)
    assert (one.peak_period, one.significant_wave_height) == pytest.approx((9.0, 3.0), rel=ROUNDING)
    assert one.moment(3) == pytest.approx(sea.moment(3), rel=ROUNDING)


def test_two_systems_add_up() -> None:
    """Density and energy are sums; H_s² is too; the peak is where the sum is level, not at either peak."""
    parts = [OchiHubble((2.0,), (14.0,), (3.0,)), OchiHubble((1.5,), (6.0,), (1.25,))]
    omega = np.linspace(0.2, 3.0, 57)
    np.testing.assert_allclose(
        TWO_SYSTEMS.density(omega), sum(p.density(omega) for p in parts), rtol=ROUNDING
    )
    assert TWO_SYSTEMS.moment(0) == pytest.approx((2.0**2 + 1.5**2) / 16, rel=ROUNDING)
    assert TWO_SYSTEMS.significant_wave_height == pytest.approx(2.5, rel=ROUNDING)
    close = OchiHubble((2.0, 1.5), (9.0, 8.0), (1.0, 3.0))
    assert 8.0 < close.peak_period < 9.0
    peak, step = 2 * np.pi / close.peak_period, 1e-4
    slope = (close.density(peak + step) - close.density(peak - step)) / (2 * step)
    assert abs(slope) < 1e-5 * close.density(peak) / peak  # second order in the step; 1 % aside it is 0.2


def test_a_large_shape_is_a_narrow_sea() -> None:
    """λ = 50: T_1, T_z and T_p meet, and the density stays finite down to ω = 0."""
    sea = OchiHubble((1.0,), (9.0,), (50.0,))
    assert sea.mean_period == pytest.approx(9.0, rel=0.01)
    assert sea.zero_crossing_period == pytest.approx(9.0, rel=0.01)
    assert np.isfinite(sea.density(np.geomspace(1e-300, 1e300, 601))).all()


# Characteristic values.


def test_characteristics_of_one_wave() -> None:
    """½ a² at ω: every period 2π/ω, no width, H_s = √8 a; the steepness and the slope by hand."""
    sea = component_characteristics(
        WaveComponents(np.array([2.0]), np.array([0.5]), np.zeros(1), np.zeros(1))
    )
    periods = [
        sea.peak_period,
        sea.mean_period,
        sea.zero_crossing_period,
        sea.energy_period,
        sea.crest_period,
    ]
    np.testing.assert_allclose(periods, 2 * np.pi / 0.5, rtol=ROUNDING)
    assert (sea.bandwidth, sea.narrowness) == pytest.approx((0.0, 0.0), abs=1e-7)  # roots of rounding
    moments = [sea.m_minus_1, sea.m0, sea.m1, sea.m2, sea.m3, sea.m4]
    np.testing.assert_allclose(moments, [4.0, 2.0, 1.0, 0.5, 0.25, 0.125], rtol=ROUNDING)
    assert (
        sea.significant_wave_height == sea.corrected_significant_wave_height == pytest.approx(4 * np.sqrt(2))
    )
    assert sea.rms_slope == pytest.approx(np.sqrt(0.5) * 2.0 * 0.25 / G, rel=ROUNDING)
    assert sea.nominal_steepness == pytest.approx(0.25 * 4 * np.sqrt(2) / (2 * np.pi * G), rel=ROUNDING)
    assert np.isnan(sea.peakedness) and sea.upper_frequency == 0.5


def test_heights_are_those_of_rayleigh() -> None:
    """Of 4e6 Rayleigh heights: mean 2.507, RMS 2.828, highest tenth 5.091, all times √m0 = 1.5 m."""
    sea = characteristics(Bretschneider(6.0, 12.0), 5.0)
    heights = np.sort(np.random.default_rng(1).rayleigh(2 * 1.5, 4_000_000))
    assert sea.m0 == pytest.approx(1.5**2, rel=ROUNDING)
    # The sampling error of the mean of the highest tenth is 0.05 %.
    assert sea.mean_wave_height == pytest.approx(heights.mean(), rel=1e-3)
    assert sea.rms_wave_height == pytest.approx(np.sqrt(np.mean(heights**2)), rel=1e-3)
    assert sea.one_tenth_wave_height == pytest.approx(heights[-400_000:].mean(), rel=1e-3)
    assert sea.one_tenth_wave_height / sea.significant_wave_height == pytest.approx(1.27, abs=5e-3)


@pytest.mark.parametrize("spectrum", EVERY, ids=lambda s: type(s).__name__)
def test_characteristics_of_a_spectrum_and_of_its_fine_components(spectrum: PointSpectrum) -> None:
    """Components of a fine even grid up to Ω = 6 rad/s carry the same values, m4 and all.

    Midpoint sums of 6000 smooth terms; what lies past 6 rad/s is taken off the whole moments by hand.
    """
    edges = np.linspace(0.0, 6.0, 6001)
    omega, step = 0.5 * (edges[1:] + edges[:-1]), edges[1]
    amplitude = np.sqrt(2 * spectrum.density(omega) * step)
    got = component_characteristics(WaveComponents(amplitude, omega, np.zeros(6000), np.zeros(6000)))
    want = characteristics(spectrum, 6.0)
    for n, name in enumerate(("m_minus_1", "m0", "m1", "m2", "m3", "m4"), -1):
        assert getattr(got, name) == pytest.approx(spectrum.moment(n, 6.0), rel=1e-5)
    for name in ("m4", "crest_period", "bandwidth", "rms_slope"):
        assert getattr(got, name) == pytest.approx(getattr(want, name), rel=1e-5)
    assert got.corrected_significant_wave_height == pytest.approx(
        want.corrected_significant_wave_height, rel=1e-3
    )
    assert got.peak_period == pytest.approx(want.peak_period, rel=1e-3)  # the step of the grid
    assert (got.upper_frequency, want.upper_frequency) == (omega[-1], 6.0)
    squared = np.sum(omega * spectrum.density(omega) ** 2) * step
    assert want.peakedness == pytest.approx(2 * squared / want.m0**2, rel=1e-5)
    assert want.mean_period == spectrum.mean_period
    assert want.narrowness == pytest.approx(np.sqrt(want.m0 * want.m2 / want.m1**2 - 1), rel=ROUNDING)
    assert want.rms_slope**2 == pytest.approx(spectrum.mean_square_slope(6.0), rel=ROUNDING)


def test_slope_density() -> None:
    sea = Bretschneider(3.0, 9.0)
    assert sea.slope_density(0.9) == pytest.approx(sea.density(0.9) * 0.9**4 / G**2, rel=ROUNDING)
    assert sea.slope_density(0.9, gravity=5.0) == pytest.approx(
        sea.density(0.9) * 0.9**4 / 25.0, rel=ROUNDING
    )
    assert sea.mean_square_slope(4.0) == pytest.approx(quad(sea.slope_density, 0, 4.0)[0], rel=1e-8)


def test_characteristics_of_a_broad_sea_go_to_the_upper_frequency_where_they_must() -> None:
    broad = OchiHubble((3.0,), (9.0,), (0.6,))
    sea = characteristics(broad, 4.0)
    assert (sea.m2, sea.m3) == (broad.moment(2), broad.moment(3, 4.0))


def test_the_peak_of_components() -> None:
    """Directions of one frequency count together; none where all frequencies carry as much."""
    omega = np.array([0.4, 0.5, 0.5, 0.6])
    sea = component_characteristics(WaveComponents(np.array([0.9, 0.8, 0.8, 1.0]), omega, omega, omega))
    assert sea.peak_period == pytest.approx(2 * np.pi / 0.5)
    even = component_characteristics(
        WaveComponents(np.ones(3), np.array([0.4, 0.5, 0.6]), np.zeros(3), np.zeros(3))
    )
    assert np.isnan(even.peak_period) and np.isnan(even.nominal_steepness)
    with pytest.raises(PanelsimError, match="without waves"):
        component_characteristics(NO_WAVES)


# Tables.


def test_the_integrals_of_a_triangle() -> None:
    """S from 0 at 1 to 0.02 at 2 to 0 at 4 rad/s: areas, moments and quantiles by hand."""
    table = TableSpectrum(np.array([1.0, 2.0, 4.0]), np.array([0.0, 0.02, 0.0]))
    assert table.moment(0) == pytest.approx(0.03, rel=ROUNDING)
    assert table.moment(1) == pytest.approx((1 + 2 + 4) / 3 * 0.03, rel=ROUNDING)
    assert table.moment(-1) == pytest.approx(0.02 * (1 - np.log(2)) + 0.04 * np.log(2) - 0.02, rel=ROUNDING)
    fourth = sum(quad(lambda w: table.density(w) * w**4, *part)[0] for part in ((1, 2), (2, 4)))
    assert table.moment(4) == pytest.approx(fourth, rel=1e-10)
    assert table.moment(0, 3.0) == pytest.approx(0.025, rel=ROUNDING)
    assert table.moment(0, 0.5) == 0.0
    assert table.energy_between(1.5, 3.0) == pytest.approx(2.25 / 3.0, rel=ROUNDING)
    assert table.energy_between(0.0, 0.9) == 0.0 and table.energy_between(0.0, np.inf) == 1.0
    assert table.frequency_below(0.25 / 3.0) == pytest.approx(1.5, rel=ROUNDING)
    assert table.frequency_below(2.5 / 3.0) == pytest.approx(3.0, rel=ROUNDING)
    assert (table.frequency_below(0.0), table.frequency_below(1.0)) == (1.0, 4.0)
    assert table.peak_period == pytest.approx(np.pi)
    assert table.significant_wave_height == pytest.approx(4 * np.sqrt(0.03), rel=ROUNDING)
    # ∫ ω S² of the two sides by hand: 4e-4 (7/12) and 1e-4 (20/3).
    assert table.peakedness == pytest.approx(2 * (4e-4 * 7 / 12 + 1e-4 * 20 / 3) / 0.03**2, rel=1e-10)
    with pytest.raises(ValueError, match="read-only"):
        table.frequency[0] = 0.5


def test_a_gap_in_a_table_has_no_quantile_of_its_own() -> None:
    """Two lobes with nothing between: half the energy lies below any frequency of the gap, one is given."""
    table = TableSpectrum(np.array([0.5, 0.6, 0.7, 0.9, 1.0, 1.1]), np.array([0.0, 1.0, 0.0, 0.0, 1.0, 0.0]))
    assert 0.7 <= table.frequency_below(0.5) <= 0.9 + 1e-7  # the root of the rounding of the share
    assert table.frequency_below(0.5 - 1e-9) < 0.7 < 0.9 < table.frequency_below(0.5 + 1e-9)


def test_a_finer_table_comes_nearer_to_its_spectrum() -> None:
    """Lines between rows miss m0 by the square of the step."""
    sea, steps, errors = Jonswap(3.0, 9.0), [], []
    for count in (81, 161, 321, 641):
        omega = np.linspace(0.25, 4.25, count)
        table = TableSpectrum(omega, sea.density(omega))
        steps.append(omega[1] - omega[0])
        errors.append(abs(table.moment(2) - sea.integral(lambda w: sea.density(w) * w**2, 0.25, 4.25)))
    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert slope == pytest.approx(2.0, abs=0.15)
    assert errors[-1] < 1e-4 * sea.moment(2)


def test_a_table_is_refused_outside_its_rows() -> None:
    table = TableSpectrum(np.array([0.3, 0.6, 1.5]), np.array([0.1, 1.0, 0.2]))
    assert table.density([0.3, 0.45, 1.5]) == pytest.approx([0.1, 0.55, 0.2])
    assert table.density([-1.0, 0.0]) == pytest.approx([0.0, 0.0])
    assert table.density(1.5 * (1 + 1e-15)) == pytest.approx(0.2)  # a grid's own rounding
    for outside in (0.29, 1.51):
        with pytest.raises(PanelsimError, match=r"0\.3 to 1\.5 rad/s") as refusal:
            table.density([0.5, outside])
        assert str(outside) in str(refusal.value)


def test_reading_a_table(tmp_path: Path) -> None:
    """The same sea over rad/s and over Hz, S(ω) = S(f)/2π; an Excel mark and line ends do not matter."""
    radians = tmp_path / "radians.csv"
    radians.write_text("frequency_rad_s,density\n0.3,0.1\n0.6,1.0\n1.5,0.2\n")
    hertz = tmp_path / "hertz.csv"
    rows = [(0.3, 0.1), (0.6, 1.0), (1.5, 0.2)]
    lines = [f"{w / (2 * np.pi)!r}, {s * 2 * np.pi!r}\r\n" for w, s in rows]
    hertz.write_bytes(b"\xef\xbb\xbf" + ("frequency_hz,density\r\n" + "".join(lines) + "\r\n").encode())
    for table in (read_table_spectrum(radians), read_table_spectrum(str(hertz))):
        np.testing.assert_allclose(table.frequency, [0.3, 0.6, 1.5], rtol=ROUNDING)
        np.testing.assert_allclose(table.density_table, [0.1, 1.0, 0.2], rtol=ROUNDING)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("frequency_rad_s,density\n0.3,0.1\n0.6,1", "cut short"),
        ("frequency_rad_s,density\n0.3,0.1\n0.6\n", "line 3"),
        ("frequency_rad_s,density\n0.3,0.1\n0.6,1.0,7\n", "line 3"),
        ("frequency_rad_s,density\n0.3,0.1\n\n0.6,1.0\n", "line 3"),
        ("frequency_rad_s,density\n0.3,0.1\n0.6,high\n", "high"),
        ("frequency_rad_s,density\n0.3,0.1\n0.6,nan\n", "density that is negative or no number"),
        ("frequency_rad_s,density\n0.3,0.1\n0.6,-1\n", "-1 m² s/rad in row 2"),
        ("frequency_rad_s,density\n0.3,0.1\n0.2,1\n", "0.2 rad/s in row 2"),
        ("frequency_rad_s,density\n0.3,0.1\n0.3,1\n", "not above the one before"),
        ("frequency_rad_s,density\n0,0\n0.3,1\n", "0 rad/s in row 1"),
        ("frequency_rad_s,density\n0.3,0\n0.6,0\n", "no energy"),
        ("frequency_rad_s,density\n0.3,1\n", "two or more"),
        ("frequency_rad_s,density\n", "two or more"),
        ("frequency,density\n0.3,0.1\n0.6,1.0\n", "frequency_hz,density"),
        ("0.3,0.1\n0.6,1.0\n", "unknown header"),
        ("", "unknown header"),
    ],
)
def test_files_that_are_no_table_are_refused(text: str, words: str, tmp_path: Path) -> None:
    file = tmp_path / "table.csv"
    file.write_text(text)
    with pytest.raises(PanelsimError) as refusal:
        read_table_spectrum(file)
    assert words in str(refusal.value)


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match=r"none\.csv"):
        read_table_spectrum(tmp_path / "none.csv")
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00\x81\n")
    with pytest.raises(PanelsimError, match=r"binary\.csv"):
        read_table_spectrum(tmp_path / "binary.csv")


# Encounter.


def test_the_branches_of_a_following_sea() -> None:
    """10 m/s, β = 60°: τ = 0.51 s; below 1/4τ three waves, above one; each is met at that |ω_e|."""
    speed, heading = 10.0, np.pi / 3
    tau = speed * 0.5 / G
    met = np.array([0.0, 0.1, 0.2, 0.45, 0.6])
    first, second, third = encounter_branches(met, speed, heading)
    np.testing.assert_allclose((first - tau * first**2)[:4], met[:4], atol=ROUNDING)
    np.testing.assert_allclose((second - tau * second**2)[:4], met[:4], atol=ROUNDING)
    np.testing.assert_allclose(third - tau * third**2, -met, atol=ROUNDING)
    assert np.all(first[:4] < 0.5 / tau) and np.all(second[:4] > 0.5 / tau) and np.all(third[1:] > 1 / tau)
    assert np.isnan([first[4], second[4]]).all()


@pytest.mark.parametrize("heading_deg", [90, 120, 180, 260])
def test_one_branch_from_ahead_and_abeam(heading_deg: float) -> None:
    met = np.array([0.0, 0.5, 1.0, 2.0])
    heading = np.deg2rad(heading_deg)
    first, second, third = encounter_branches(met, 10.0, heading)
    np.testing.assert_allclose(first - 10.0 * np.cos(heading) * first**2 / G, met, atol=ROUNDING)
    # Exactly abeam cos β is a rounding error, and the other branches lie at 1e16 rad/s.
    assert heading_deg == 90 or np.isnan([second, third]).all()


@pytest.mark.parametrize("heading_deg", [0, 40, 90, 150, 180])
@pytest.mark.parametrize(
    "spectrum", [*EVERY, TableSpectrum(np.array([0.3, 0.6, 1.8]), np.array([0.1, 1.0, 0.2]))]
)
def test_encounter_energy_is_that_of_a_million_waves(spectrum: PointSpectrum, heading_deg: float) -> None:
    """Waves 1e-5 rad/s apart sorted by their |ω − U cos β ω²/g|: a band gains or loses a wave or so."""
    omega = np.arange(0.5e-5, 10.0, 1e-5)
    if isinstance(spectrum, TableSpectrum):
        omega = omega[(omega > 0.3) & (omega < 1.8)]
    speed, heading = 9.0, np.deg2rad(heading_deg)
    met = np.abs(omega - speed * np.cos(heading) * omega**2 / G)
    edges = np.array([0.0, 0.1, 0.2, 0.25, 0.3, 0.5, 0.8, 1.3, 2.5])
    waves = np.histogram(met, edges, weights=spectrum.density(omega) * 1e-5)[0]
    energy = encounter_energy(spectrum, edges, speed, heading)
    # Some 10 waves at an edge, where many are met alike; none of the bands is that small.
    np.testing.assert_allclose(energy, waves, atol=1e-3 * spectrum.moment(0))
    assert encounter_energy(spectrum, [0.0, np.inf], speed, heading)[0] == pytest.approx(spectrum.moment(0))


def test_encounter_density_is_the_energy_of_narrow_bands() -> None:
    """In head seas S/(1 + 2ωU/g); in following seas the energy between ω_e ± h over 2h, to order h²."""
    sea, met = Bretschneider(3.0, 9.0), np.array([0.1, 0.2, 0.24, 0.6, 1.2])
    omega = encounter_branches(met, 9.0, np.pi)[0]
    expected = sea.density(omega) / (1 + 2 * omega * 9.0 / G)
    np.testing.assert_allclose(encounter_density(sea, met, 9.0, np.pi), expected, rtol=ROUNDING)
    following = encounter_density(sea, met, 9.0, 0.3)
    h = 1e-5
    for frequency, density in zip(met, following, strict=True):
        energy = encounter_energy(sea, [frequency - h, frequency + h], 9.0, 0.3)[0]
        assert density == pytest.approx(energy / (2 * h), rel=1e-5)
    np.testing.assert_allclose(encounter_density(sea, met, 0.0, 0.3), sea.density(met), rtol=ROUNDING)


def test_the_singular_frequency_is_told() -> None:
    sea, singular = Bretschneider(3.0, 9.0), 0.25 * G / 9.0
    with pytest.raises(PanelsimError, match="infinite") as refusal:
        encounter_density(sea, [0.1, singular], 9.0, 0.0)
    assert f"{singular:g}" in str(refusal.value) and "encounter_energy" in str(refusal.value)
    # On the way there it grows as one over the root of the distance.
    near, nearer = encounter_density(sea, singular - np.array([1e-6, 1e-8]), 9.0, 0.0)
    assert nearer / near == pytest.approx(10.0, rel=0.02)


# What is refused.


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (lambda: Bretschneider(-1.0, 10.0), "significant_wave_height"),
        (lambda: Bretschneider(0.0, 10.0), "significant_wave_height"),
        (lambda: Bretschneider(1.0, float("nan")), "peak_period"),
        (lambda: Bretschneider(1.0, float("inf")), "peak_period"),
        (lambda: Bretschneider("3", 9.0), "'3'"),
        (lambda: Bretschneider(True, 9.0), "True"),
        (lambda: Bretschneider(40.0, 5.0), "40 m"),
        (lambda: Bretschneider.from_mean_period(3.0, -9.0), "mean_period"),
        (lambda: Bretschneider.from_zero_crossing_period(3.0, None), "zero_crossing_period"),
        (lambda: Bretschneider.one_parameter(0.0), "significant_wave_height"),
        (lambda: Jonswap(1.0, 9.0, 0.9), "0.9"),
        (lambda: Jonswap(1.0, 9.0, 21.0), "1 (no enhancement) to 20"),
        (lambda: Jonswap(1.0, 9.0, 11.0, normalisation="logarithmic"), "1 (no enhancement) to 10"),
        (lambda: Jonswap(1.0, 9.0, normalisation="ittc"), "goda | logarithmic"),
        (lambda: Jonswap(1.0, 9.0, normalisation=["goda"]), "goda | logarithmic"),
        (lambda: Jonswap(1.0, 0.0), "peak_period"),
        (lambda: Jonswap(40.0, 5.0), "breaking"),
        (lambda: Jonswap.from_wind(15.0, 0.0), "fetch"),
        (lambda: Jonswap.from_wind(-15.0, 1e5), "wind_speed"),
        (lambda: Jonswap.from_wind(5.0, 1e6), "fully developed"),
        (lambda: Jonswap.from_wind(15.0, 1e6), "at most 4.48e+05 m"),  # (22/(2π 0.13))³ 225/g
        (lambda: Jonswap.dnv(float("nan"), 9.0), "significant_wave_height"),
        (lambda: Jonswap.dnv(3.0, -9.0), "peak_period"),
        (lambda: PiersonMoskowitz(0.0), "wind_speed"),
        (lambda: PiersonMoskowitz.from_significant_wave_height(-1.0), "significant_wave_height"),
        (lambda: OchiHubble(2.0, (9.0,), (1.0,)), "one or two numbers"),
        (lambda: OchiHubble((), (), ()), "one or two numbers"),
        (lambda: OchiHubble((1.0,) * 3, (9.0,) * 3, (1.0,) * 3), "one or two numbers"),
        (lambda: OchiHubble((2.0, 1.0), (9.0,), (1.0,)), "2, 1, 1"),
        (lambda: OchiHubble((2.0, 0.0), (9.0, 8.0), (1.0, 1.0)), "significant_wave_heights"),
        (lambda: OchiHubble((2.0,), (9.0,), (0.25,)), "over 0.25"),
        (lambda: OchiHubble((2.0,), (9.0,), (51.0,)), "51"),
        (lambda: OchiHubble((9.0, 6.0), (18.0, 4.0), (1.0, 1.0)), "H_s 6 m at T_p 4 s"),
        (lambda: TableSpectrum([0.3, 0.6], [1.0, 2.0, 3.0]), "(2,) and (3,)"),
        (lambda: TableSpectrum([[0.3, 0.6]], [[1.0, 2.0]]), "no two columns"),
        (lambda: TableSpectrum(["low", "high"], [1.0, 2.0]), "not made of numbers"),
        (lambda: TableSpectrum([0.3, np.nan], [1.0, 2.0]), "row 2"),
        (lambda: TableSpectrum([2.0, 2.5, 3.0], [0.0, 20.0, 0.0]), "steeper"),
        (lambda: Bretschneider(3.0, 9.0).moment(-2), "-2"),
        (lambda: Bretschneider(3.0, 9.0).moment(1.5), "1.5"),
        (lambda: Bretschneider(3.0, 9.0).moment(4, -1.0), "upper_frequency"),
        (lambda: Jonswap(3.0, 9.0).moment(0, float("nan")), "upper_frequency"),
        (lambda: Bretschneider(3.0, 9.0).energy_between(1.0, 0.5), "1.0 to 0.5"),
        (lambda: Bretschneider(3.0, 9.0).energy_between(float("nan"), 0.5), "nan"),
        (lambda: Bretschneider(3.0, 9.0).energy_between("a", "b"), "'a'"),
        (lambda: Bretschneider(3.0, 9.0).frequency_below(1.1), "1.1"),
        (lambda: Jonswap(3.0, 9.0).frequency_below(float("nan")), "nan"),
        (lambda: TableSpectrum([0.3, 0.6], [1.0, 2.0]).frequency_below(-0.1), "-0.1"),
        (lambda: Bretschneider(3.0, 9.0).density("fast"), "no numbers"),
        (lambda: Bretschneider(3.0, 9.0).bandwidth(0.01), "more than the peak, 0.698 rad/s"),
        (lambda: characteristics(Bretschneider(3.0, 9.0), 0.0), "upper_frequency"),
        (lambda: characteristics(TableSpectrum([0.3, 0.6], [1.0, 2.0]), 0.2), "no energy below"),
        (lambda: encounter_branches(-0.1, 9.0, 0.0), "-0.1"),
        (lambda: encounter_branches([0.5, np.inf], 9.0, 0.0), "0.5 to inf"),
        (lambda: encounter_branches(0.1, 9.0, 150), "radians"),
        (lambda: encounter_density(Bretschneider(3.0, 9.0), 0.1, np.nan, 0.0), "speed"),
        (lambda: encounter_energy(Bretschneider(3.0, 9.0), [0.1], 9.0, 0.0), "fewer than two"),
        (lambda: encounter_energy(Bretschneider(3.0, 9.0), [0.2, 0.1], 9.0, 0.0), "rise"),
        (lambda: encounter_energy(Bretschneider(3.0, 9.0), [-0.2, 0.1], 9.0, 0.0), "from 0"),
        (lambda: encounter_energy(Bretschneider(3.0, 9.0), [0.1, 0.2], 9.0, 0.0, gravity=0.0), "gravity"),
    ],
)
def test_bad_input_is_refused(bad: Callable[[], object], words: str) -> None:
    with pytest.raises(PanelsimError) as refusal:
        bad()
    assert words in str(refusal.value)


def test_a_sea_too_steep_is_told_what_would_do() -> None:
    """40 m at 5 s: 2π·40/(g 25) = 1.025 against 0.142, so 5.5 m there, or 13.4 s."""
    with pytest.raises(PanelsimError, match="steeper") as refusal:
        Bretschneider(40.0, 5.0)
    for part in ("1.025", "0.142", "5.5 m", "13.4 s"):
        assert part in str(refusal.value)
    Bretschneider(5.5, 5.0)


def test_no_sea_is_fully_developed_in_a_wind_of_100_m_s() -> None:
    with pytest.raises(PanelsimError, match="long enough") as refusal:
        PiersonMoskowitz(100.0)
    assert "50 m/s" in str(refusal.value)
