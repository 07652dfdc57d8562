"""Point spectra against published densities, ratios and examples, and against the misprints of the sources.

WORKSHOP is the seakeeping workshop's lecture notes, SIMULATORS Zwolan and Czaplewski, "Sea waves models used
in maritime simulators", GROUPS a thesis on wave groups and relative motion (UNIOM).
"""

import numpy as np
import pytest
from scipy.integrate import quad

from panelsim.conventions import KNOT
from panelsim.conventions import STANDARD_GRAVITY as G
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.characteristics import characteristics, component_characteristics
from panelsim.seaway.spectra.encounter import encounter_density, encounter_energy
from panelsim.seaway.spectra.jonswap import Jonswap
from panelsim.seaway.spectra.pierson_moskowitz import PiersonMoskowitz
from panelsim.seaway.spectra.table import TableSpectrum


def logarithmic(height: float, peak_period: float, peak_enhancement: float) -> Jonswap:
    return Jonswap(height, peak_period, peak_enhancement, normalisation="logarithmic")


@pytest.mark.parametrize(
    ("spectrum", "omega", "expected"),
    [
        # (5/16)(2π)⁴/5⁴ exp(−(5/4)(2π/5)⁴), by hand.
        (Bretschneider(1.0, 5.0), 1.0, 0.034510725921325),
        # The same with (1 − 0.287 ln 3.3) 3.3^κ, once on each side of the peak at 0.628 rad/s.
        (logarithmic(1.0, 10.0, 3.3), 0.4, 0.001548977510098),
        (logarithmic(1.0, 10.0, 3.3), 0.5, 0.046145520023689),
    ],
)
def test_densities_at_points(spectrum: Bretschneider | Jonswap, omega: float, expected: float) -> None:
    """Given to 1e-9; the rounded 486.0 and 1948.2 of TM 2003-190 (42) are 0.2 % off and fail."""
    assert spectrum.density(omega) == pytest.approx(expected, rel=1e-9)


def test_the_worked_gamma_spectrum_of_dnv() -> None:
    """DNV's ocean calculator: H_s 12 m, T_z 10 s give T_p 14.077 s, S(0.5) 25.84 m² s, level α 0.018558."""
    sea = Bretschneider.from_zero_crossing_period(12.0, 10.0)
    assert sea.peak_period == pytest.approx(14.077, abs=5e-4)
    assert sea.density(0.5) == pytest.approx(25.84, abs=5e-3)
    # It takes 9.81 m/s2 for g; to its last digit.
    assert sea.density(20.0) * 20.0**5 / 9.81**2 == pytest.approx(0.018558, abs=1e-6)


def test_bretschneider_ratios_of_periods() -> None:
    """T_1 = 0.77177 T_p and T_z = 0.71037 T_p; TM 2003-190 (43) prints 0.773, WORKSHOP T_z/T_1 = 0.92."""
    sea = Bretschneider(3.0, 9.0)
    assert sea.mean_period / 9.0 == pytest.approx(0.77177, abs=5e-6)
    assert sea.zero_crossing_period / 9.0 == pytest.approx(0.71037, abs=5e-6)
    assert sea.zero_crossing_period / sea.mean_period == pytest.approx(0.92, abs=1e-3)
    # Goda (2010) and Longuet-Higgins (1975) give these widths; T_e/T_p is Γ(5/4) (4/5)^¼.
    assert sea.peakedness == pytest.approx(2.0, rel=1e-9)
    assert characteristics(sea, 5.0).narrowness == pytest.approx(0.425, abs=5e-4)
    assert sea.energy_period / 9.0 == pytest.approx(0.857, abs=5e-4)


def test_workshop_and_ittc_constants_belong_to_the_mean_period() -> None:
    """WORKSHOP 4.5: 172.75 and 691; GROUPS (14), (15): 173 and 691. Meant as T_p they are off by a half."""
    sea = Bretschneider.from_mean_period(3.0, 8.0)
    omega = np.linspace(0.5, 3.0, 26)
    for a, tolerance in ((172.75, 1e-3), (173.0, 2.5e-3)):  # their own rounding
        printed = a * 9.0 / 8.0**4 / omega**5 * np.exp(-691 / 8.0**4 / omega**4)
        np.testing.assert_allclose(sea.density(omega), printed, rtol=tolerance)


def test_groups_table_1_calls_the_peak_period_t1() -> None:
    """T_z 8.0 s and "T_1" 11.26 s: the ratio is that of T_p, 0.7104, not that of T_1."""
    sea = Bretschneider.from_zero_crossing_period(3.0, 8.0)
    assert sea.peak_period == pytest.approx(11.26, abs=5e-3)
    assert sea.zero_crossing_period == pytest.approx(8.0, rel=1e-12)


def test_jonswap_ratios_of_periods() -> None:
    """γ = 3.3 over all frequencies: T_1/T_p 0.8343 and T_z/T_p 0.7774; Q_p 3.15 as Goda (2010) gives it."""
    sea = Jonswap(3.0, 9.0)
    assert sea.mean_period / 9.0 == pytest.approx(0.8343, abs=2e-4)
    assert sea.zero_crossing_period / 9.0 == pytest.approx(0.7774, abs=2e-4)
    assert sea.peakedness == pytest.approx(3.15, abs=0.01)


@pytest.mark.parametrize("gamma", [1.0, 2.0, 3.3, 5.0, 7.0])
def test_jonswap_periods_against_the_fits_of_dnv(gamma: float) -> None:
    """DNV-RP-C205 section 3.5.5: polynomials in γ for T_z/T_p and T_1/T_p, which are fits to 0.25 %."""
    sea = Jonswap(3.0, 9.0, gamma)
    zero_crossing = np.polyval([0.0003341, -0.006230, 0.05037, 0.6673], gamma)
    mean = np.polyval([0.0003610, -0.006556, 0.04936, 0.7303], gamma)
    assert sea.zero_crossing_period / 9.0 == pytest.approx(zero_crossing, rel=2.5e-3)
    assert sea.mean_period / 9.0 == pytest.approx(mean, rel=2.5e-3)


def test_jonswap_has_the_minus_sign_the_peak_and_the_widths_of_its_sources() -> None:
    """GROUPS (16) and SIMULATORS (6) lost the minus of κ, GROUPS (17) has another peak, its listing one σ."""
    sea, peak = logarithmic(3.0, 9.0, 3.3), 2 * np.pi / 9.0
    tail = (1 - 0.287 * np.log(3.3)) * Bretschneider(3.0, 9.0).density(
        np.array([0.92, 1.08, 1.0, 2.0]) * peak
    )
    kappa = np.log(sea.density(np.array([0.92, 1.08, 1.0, 2.0]) * peak) / tail) / np.log(3.3)
    expected = [np.exp(-0.5 * (0.08 / 0.07) ** 2), np.exp(-0.5 * (0.08 / 0.09) ** 2), 1.0, 0.0]
    np.testing.assert_allclose(kappa, expected, atol=1e-12)  # rounding
    omega = np.linspace(0.9, 1.1, 20001) * peak
    assert omega[np.argmax(sea.density(omega))] == pytest.approx(peak, rel=1e-5)  # the step of the search


def test_the_workshop_jonswap() -> None:
    """0.658 · 3.3^κ · S_B of WORKSHOP 4.5, S_B by T_1 = 0.77177 T_p, is the logarithmic form to 2 per mille.

    0.658 is 1.0 per mille above 1 − 0.287 ln 3.3; the rest is the rounding of 172.75 and 691. Goda's level
    is 5 per mille under the logarithmic one, and so 6 under this.
    """
    omega, peak, mean = np.linspace(0.45, 2.5, 42), 2 * np.pi / 10.0, 0.77177 * 10.0
    sigma = np.where(omega <= peak, 0.07, 0.09)
    c = 3.3 ** np.exp(-((omega * 10.0 / (2 * np.pi) - 1) ** 2) / (2 * sigma**2))
    printed = 0.658 * c * 172.75 * 4.0 / mean**4 / omega**5 * np.exp(-691 / mean**4 / omega**4)
    np.testing.assert_allclose(logarithmic(2.0, 10.0, 3.3).density(omega), printed, rtol=2e-3)
    np.testing.assert_allclose(Jonswap(2.0, 10.0).density(omega), printed, rtol=7e-3)
    assert 0.658 / (1 - 0.287 * np.log(3.3)) == pytest.approx(1.001, abs=1e-4)


def test_pierson_moskowitz_over_f_and_over_omega() -> None:
    """SIMULATORS (2)-(5) with S(ω) = S(f)/2π, WORKSHOP 4.5, and the three forms of B, (2π)⁴ in the third.

    With the printed (2π)² in (4) the third is 39 times too large.
    """
    wind, alpha, beta = 15.0, 0.0081, 0.74
    sea = PiersonMoskowitz(wind)
    f = np.linspace(0.05, 0.5, 31)
    omega = 2 * np.pi * f
    a, f_p = alpha * G**2 * (2 * np.pi) ** -4, 1 / sea.peak_period
    for b in (
        beta * (2 * np.pi * wind / G) ** -4,
        1.25 * f_p**4,
        4 * alpha * G**2 / ((2 * np.pi) ** 4 * sea.significant_wave_height**2),
    ):
        np.testing.assert_allclose(sea.density(omega), a / f**5 * np.exp(-b / f**4) / (2 * np.pi), rtol=1e-12)
    workshop = 8.1e-3 * G**2 / omega**5 * np.exp(-0.74 * (G / (omega * wind)) ** 4)
    np.testing.assert_allclose(sea.density(omega), workshop, rtol=1e-12)
    # The usual figures of the fully developed sea, to their digits.
    assert sea.significant_wave_height * G / wind**2 == pytest.approx(0.21, abs=5e-3)
    assert 2 * np.pi / sea.peak_period * wind / G == pytest.approx(0.877, abs=5e-4)


def test_the_one_parameter_sea_is_pierson_moskowitz_of_that_height() -> None:
    """The same curve; 4 m for a modal period of 10 s, as WORKSHOP's comparison of spectra chose it."""
    one, wind = Bretschneider.one_parameter(4.0), PiersonMoskowitz.from_significant_wave_height(4.0)
    omega = np.linspace(0.3, 3.0, 28)
    np.testing.assert_allclose(one.density(omega), wind.density(omega), rtol=1e-12)
    np.testing.assert_allclose(wind.significant_wave_height, 4.0, rtol=1e-12)
    assert one.peak_period == pytest.approx(10.0, abs=0.02)


@pytest.mark.parametrize(("wind", "fetch"), [(10.0, 2e4), (15.0, 1e5), (20.0, 3e5)])
def test_jonswap_of_a_wind_and_a_fetch(wind: float, fetch: float) -> None:
    """The tail is exactly α g² ω⁻⁵ with α = 0.076 (U²/(F g))^0.22, whatever the normalisation.

    With SIMULATORS' 0.0076 the sea would be 0.32 times as high. Hasselmann et al. (1973) fitted the energy
    apart: m0 g²/U⁴ = 1.6e-7 g F/U², with which the height agrees to a third.
    """
    sea, x = Jonswap.from_wind(wind, fetch), G * fetch / wind**2
    omega = 4 * 2 * np.pi / sea.peak_period  # where 3.3^κ is 1 and the exponential 0.995
    level = sea.density(omega) * omega**5 / (G**2 * np.exp(-1.25 / 4**4))
    assert level == pytest.approx(0.076 * x**-0.22, rel=1e-12)
    assert sea.significant_wave_height == pytest.approx(4 * np.sqrt(1.6e-7 * x) * wind**2 / G, rel=1 / 3)
    # The two usual forms of the peak frequency: 2π · 3.5 is 22 to 0.04 %, x^(1/3 − 0.33) is up to 1.03 here.
    other = 2 * np.pi * 3.5 * G / wind * x**-0.33
    assert 2 * np.pi / sea.peak_period == pytest.approx(other, rel=0.035)
    assert 2 * np.pi / sea.peak_period == pytest.approx(other / (1.0 - 0.0004) / x ** (1 / 300), rel=1e-4)
    # SIMULATORS (6), (7) over f: f_p is 1/T_p, not 2π/T_p.
    f_p = 1 / sea.peak_period
    f = np.array([0.8, 0.96, 1.0, 1.05, 1.6]) * f_p
    tau = np.where(f <= f_p, 0.07, 0.09)
    enhancement = 3.3 ** np.exp(-((f - f_p) ** 2) / (2 * tau**2 * f_p**2))
    over_f = (
        0.076 * x**-0.22 * G**2 * (2 * np.pi) ** -4 * f**-5 * np.exp(-1.25 * (f / f_p) ** -4) * enhancement
    )
    np.testing.assert_allclose(sea.density(2 * np.pi * f), over_f / (2 * np.pi), rtol=1e-12)


@pytest.mark.parametrize(
    ("height", "period", "gamma"),
    [(9.0, 10.5, 5.0), (5.0, 10.0, 1.8350), (4.0, 10.2, 1.0), (4.0, 9.0, 1.7771)],
)
def test_dnv_peak_enhancement(height: float, period: float, gamma: float) -> None:
    """DNV-RP-C205 (3.5.5.5): exp(5.75 − 1.15 T_p/√H_s) between 3.6 and 5."""
    sea = Jonswap.dnv(height, period)
    assert sea.peak_enhancement == pytest.approx(gamma, rel=1e-4)
    assert sea.normalisation == "logarithmic"
    assert (sea.significant_wave_height, sea.peak_period) == (height, period)


def test_the_five_waves_of_workshop_4_6() -> None:
    """m0 0.624, m2 0.255, m4 0.129, T_z 9.83 s, crests 8.83 s, ε 0.441, H_s 3.16 and 3.00 m, T_o 10.47 s.

    Its sums follow the trapezoid rule, which counts the first and the last wave half. With √(1 − ε/2), as
    4.3 prints it, the corrected height would be 2.79 m.
    """
    omega = np.array([0.2, 0.4, 0.6, 0.8, 1.0])
    amplitude = np.array([0.1, 0.5, 0.8, 0.55, 0.3])
    # The column S(ω) as it should be printed: ½ ζ²/0.2.
    np.testing.assert_allclose(amplitude**2 / 0.4, [0.025, 0.625, 1.6, 0.756, 0.225], atol=5e-4)
    halved = amplitude * np.array([np.sqrt(0.5), 1.0, 1.0, 1.0, np.sqrt(0.5)])
    sea = component_characteristics(WaveComponents(halved, omega, np.zeros(5), np.zeros(5)))
    got = [sea.m0, sea.m2, sea.m4, sea.zero_crossing_period, sea.crest_period, sea.bandwidth]
    got += [sea.significant_wave_height, sea.corrected_significant_wave_height, sea.peak_period]
    np.testing.assert_allclose(got, [0.624, 0.255, 0.129, 9.83, 8.83, 0.441, 3.16, 3.00, 10.47], rtol=0.01)
    assert sea.corrected_significant_wave_height == pytest.approx(3.00, abs=0.005)  # its digits
    assert 4 * np.sqrt(1 - sea.bandwidth / 2) * np.sqrt(sea.m0) < 2.8
    # The same waves with their whole energy, and the broken line through the column.
    whole = component_characteristics(WaveComponents(amplitude, omega, np.zeros(5), np.zeros(5)))
    assert whole.m0 == pytest.approx(0.64625, rel=1e-12)
    table = characteristics(TableSpectrum(omega, amplitude**2 / 0.4), 1.0)
    assert table.m0 == pytest.approx(sea.m0, rel=1e-12)
    assert table.corrected_significant_wave_height == pytest.approx(3.00, rel=0.01)


def test_the_encounter_spectrum_of_workshop_6() -> None:
    """Modal period 11 s, 2 m, 10 knots, head sea: the area stays, the peak is lower and further right."""
    sea, speed = Bretschneider(2.0, 11.0), 10 * KNOT
    omega = np.linspace(0.2, 3.0, 2801)
    met = encounter_density(sea, omega, speed, np.pi)
    still = sea.density(omega)
    assert met.max() < 0.75 * still.max()
    assert omega[np.argmax(met)] > 1.1 * omega[np.argmax(still)]
    assert quad(lambda w: encounter_density(sea, w, speed, np.pi), 0.2, 12.0, points=[0.7, 2.0])[
        0
    ] == pytest.approx(sea.moment(0), rel=1e-3)  # what lies past 12 rad/s


def test_the_encounter_spectrum_printed_in_workshop_6_loses_energy_in_following_seas() -> None:
    """One branch, with no modulus, misses the waves past ω = g/(2U): a fifth of this sea."""
    sea, speed = Bretschneider(2.0, 8.0), 10 * KNOT
    edges = np.array([0.0, 0.25 * G / speed, 3.0, np.inf])
    energy = encounter_energy(sea, edges, speed, 0.0)
    assert energy.sum() == pytest.approx(sea.moment(0), rel=1e-12)
    first_branch = sea.energy_between(0.0, 0.5 * G / speed) * sea.moment(0)
    assert first_branch < 0.85 * energy.sum()
    assert np.all(energy >= 0.0)
