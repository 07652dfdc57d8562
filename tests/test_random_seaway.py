"""Random seas: the choice of components, their energy and directions, their statistics over seeds."""

import time

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import kstest

from panelsim.conventions import KNOT, STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.direction.directional_table import DirectionalTable
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import CosineHalfAngle, CosineSquared
from panelsim.seaway.direction.ten_parameter import TenParameterSpectrum
from panelsim.seaway.frequencies import (
    EqualEnergyFrequencies,
    EvenFrequencies,
    FrequencyChoice,
    GivenFrequencies,
    JitteredFrequencies,
)
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.repeat import repeat_time, variance_scatter
from panelsim.seaway.selection import negligible, without
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.jonswap import Jonswap
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.spectra.table import TableSpectrum

DEG = np.pi / 180
STATE_7 = Bretschneider(7.5, 15.0)
EVEN = EvenFrequencies(0.2, 2.0, 0.1)
JITTERED = JitteredFrequencies(0.2, 2.0, 0.1)
SPEED = 20 * KNOT
TEN = TenParameterSpectrum((3.0, 2.0), (14.0, 8.0), (2.5, 1.2), (30 * DEG, 110 * DEG), (12.0, 3.0))
FINE = JitteredFrequencies(0.25, 2.5, 0.05)


def short_crested(frequencies: FrequencyChoice = EVEN, **given: object) -> RandomSeaway:
    """The short-crested sea of TM 2003-190 section 8.4, at 150°."""
    fields = {"spreading": CosineSquared(), "direction_step": 20 * DEG, "seed": 1001} | given
    return RandomSeaway(STATE_7, frequencies, 150 * DEG, **fields)  # type: ignore[arg-type]


def waves(*rows: tuple[float, float]) -> WaveComponents:
    """Waves of an amplitude [m] and a frequency [rad/s] each, from ahead, with made-up phases."""
    amplitude, frequency = np.array(rows).T
    return WaveComponents(amplitude, frequency, np.full(len(rows), np.pi), 0.7 * np.arange(len(rows)))


# --- frequencies --------------------------------------------------------------------------------------------


def test_even_frequencies_are_the_grid_of_the_report() -> None:
    """0.2, 0.3 … 2.0 rad/s, and the same sea, bit for bit, as from the array."""
    np.testing.assert_array_equal(EVEN.frequency, 0.2 + 0.1 * np.arange(19.0))
    assert EVEN.frequency[-1] == pytest.approx(2.0, rel=1e-15)
    by_array = RandomSeaway(STATE_7, 0.2 + 0.1 * np.arange(19.0), 150 * DEG, 1001).components
    by_choice = RandomSeaway(STATE_7, EVEN, 150 * DEG, 1001).components
    for name in ("amplitude", "frequency", "wave_heading", "phase"):
        np.testing.assert_array_equal(getattr(by_array, name), getattr(by_choice, name))


def test_bands_of_given_frequencies_reach_half_way() -> None:
    choice = GivenFrequencies(np.array([0.1, 0.4, 0.5, 0.9]))
    np.testing.assert_allclose(choice.edges, [0.0, 0.25, 0.45, 0.7, 1.1], rtol=1e-14)
    bands = choice.bands(STATE_7, 2, np.random.default_rng(0))
    np.testing.assert_allclose(bands.weight[:, 1, 0], [0.25, 0.2, 0.25, 0.4], rtol=1e-14)
    assert (bands.low, bands.high) == pytest.approx((0.0, 1.1))
    assert bands.frequency.shape == (4, 2)


def test_jittered_frequencies_lie_each_in_its_bin_and_share_the_whole_span() -> None:
    bands = JITTERED.bands(STATE_7, 9, np.random.default_rng(3))
    place = (bands.frequency - 0.15) / 0.1
    np.testing.assert_array_equal(np.floor(place), np.tile(np.arange(19.0)[:, None], (1, 9)))
    # They fill their bins: 171 uniform draws leave no more than a tenth empty at either side.
    inside = place - np.floor(place)
    assert inside.min() < 0.1 and inside.max() > 0.9
    interval = bands.weight.sum(axis=-1)
    np.testing.assert_allclose(interval.sum(axis=0), 1.9, rtol=1e-13)
    middle = 0.5 * (bands.frequency[2] + bands.frequency[1]), 0.5 * (bands.frequency[3] + bands.frequency[2])
    np.testing.assert_allclose(interval[2], middle[1] - middle[0], rtol=1e-13)
    assert np.all((bands.node[2] > middle[0][:, None]) & (bands.node[2] < middle[1][:, None]))
    assert (bands.low, bands.high) == pytest.approx((0.15, 2.05))


def test_jitter_is_drawn_after_the_phases() -> None:
    """So the phases are those of the even grid with the same seed; each direction has its own jitter."""
    generator = np.random.default_rng(1001)
    phases, jitter = generator.uniform(0, 2 * np.pi, 171), generator.uniform(0, 1, (19, 9))
    c = short_crested(JITTERED).components
    np.testing.assert_array_equal(c.phase, phases)
    np.testing.assert_array_equal(c.phase, short_crested(EVEN).components.phase)
    expected = 0.2 + 0.1 * np.arange(19)[:, None] - 0.05 + 0.1 * jitter
    np.testing.assert_allclose(c.frequency, expected.ravel(), rtol=1e-14)
    assert len(np.unique(c.frequency)) == 171


@pytest.mark.parametrize("spectrum", [STATE_7, Jonswap(4.0, 9.0), TEN.point])
def test_components_of_equal_energy(spectrum: PointSpectrum) -> None:
    """Equal amplitudes that carry all of m0, one frequency at the middle of each share."""
    sea = RandomSeaway(spectrum, EqualEnergyFrequencies(40), 0.0, 1)
    c = sea.components
    np.testing.assert_allclose(c.amplitude, np.sqrt(2 * spectrum.moment(0) / 40), rtol=1e-12)
    shares = [spectrum.energy_between(0.0, omega) for omega in c.frequency]
    np.testing.assert_allclose(shares, (np.arange(40) + 0.5) / 40, atol=1e-9)
    assert sea.energy_share == pytest.approx(1.0, abs=1e-12)


def test_components_of_equal_energy_within_limits() -> None:
    """Between 0.3 and 1.2 rad/s they carry what lies there: share p of it is where exp(−B ω⁻⁴) says."""
    sea = RandomSeaway(STATE_7, EqualEnergyFrequencies(30, 0.3, 1.2), 0.0, 1)
    held = STATE_7.energy_between(0.3, 1.2)
    assert sea.energy_share == pytest.approx(held, rel=1e-12)
    assert sea.carried == pytest.approx(held, rel=1e-12)
    b = 1.25 * (2 * np.pi / 15.0) ** 4
    share = np.exp(-b / 0.3**4) + held * (np.arange(30) + 0.5) / 30
    np.testing.assert_allclose(sea.components.frequency, (b / -np.log(share)) ** 0.25, rtol=1e-10)


def test_directions_of_equal_energy_share_no_frequency() -> None:
    """Each takes another part of the band, in turn from below and above, so that none has the lower half."""
    c = short_crested(EqualEnergyFrequencies(20)).components
    assert len(np.unique(c.frequency)) == c.count == 180
    share = np.array([STATE_7.energy_between(0.0, omega) for omega in c.frequency]).reshape(20, 9)
    np.testing.assert_allclose(share.mean(axis=0), 0.5, atol=1e-9)
    np.testing.assert_array_equal(np.floor(20 * share), np.tile(np.arange(20.0)[:, None], (1, 9)))


def test_a_gap_in_the_spectrum_where_a_frequency_should_be() -> None:
    """Half the energy below a gap, half above, and an odd count: its middle has no density."""
    two = TableSpectrum(np.array([0.4, 0.5, 0.6, 0.8, 0.9, 1.0]), np.array([0, 1.0, 0, 0, 1, 0]))
    with pytest.raises(PanelsimError, match="has none"):
        RandomSeaway(two, EqualEnergyFrequencies(5), 0.0, 1)
    assert RandomSeaway(two, EqualEnergyFrequencies(4), 0.0, 1).carried == pytest.approx(1.0, rel=1e-12)


# --- energy -------------------------------------------------------------------------------------------------


def test_energy_of_the_report_grid() -> None:
    """19 frequencies of state 7 carry 99.13 % of m0: 0.22 % lies outside them, 0.65 % is lost to the step.

    H_s of the components is 7.467 m, 0.44 % below 7.5 m. At a step of 0.05 rad/s the loss is 3e-5.
    """
    sea = RandomSeaway(STATE_7, EVEN, 150 * DEG, 1001)
    assert sea.energy_share == pytest.approx(0.99782, abs=1e-5)
    assert sea.carried / sea.energy_share == pytest.approx(1 - 0.00658, abs=1e-5)
    assert 4 * np.sqrt(sea.components.variance) == pytest.approx(7.4671, abs=1e-4)
    finer = RandomSeaway(STATE_7, EvenFrequencies(0.2, 2.0, 0.05), 150 * DEG, 1001)
    assert finer.carried / finer.energy_share == pytest.approx(1.0, abs=4e-5)


def test_m0_converges_with_the_step_of_an_even_grid() -> None:
    """At least order 2, that of the midpoint rule; fast until the ends of the grid limit it."""
    steps = np.array([0.1, 0.05, 0.025, 0.0125])
    seas = [RandomSeaway(STATE_7, EvenFrequencies(0.2, 2.0, h), 0.0, 1) for h in steps]
    errors = [abs(sea.carried / sea.energy_share - 1) for sea in seas]
    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    print(f"even grid: order of m0 {slope:.2f}, errors {errors}")
    assert slope > 2.0 and errors[-1] < 1e-6


@pytest.mark.parametrize("spectrum", [STATE_7, Jonswap(6.0, 15.0), Jonswap(6.0, 15.0, 7.0)])
@pytest.mark.parametrize("step", [0.1, 0.05])
def test_every_seed_of_jittered_frequencies_carries_the_same_energy(
    spectrum: PointSpectrum, step: float
) -> None:
    """That of the bins: with S at the frequency drawn, m0 of γ 3.3 would scatter by 7.4 % at 0.05 rad/s.

    An interval has the integral of S over itself by sixteen points: 2e-4 where one spans the sharpest peak.
    """
    choice = JitteredFrequencies(0.2, 2.0, step)
    seas = [RandomSeaway(spectrum, choice, 0.0, seed) for seed in range(100)]
    np.testing.assert_allclose([sea.carried / sea.energy_share for sea in seas], 1.0, rtol=2e-4)
    # One component: the mean of S over its interval times the interval, in (33).
    c = seas[7].components
    low, high = 0.5 * (c.frequency[5:7] + c.frequency[4:6])
    expected = spectrum.moment(0) * spectrum.energy_between(low, high)
    assert 0.5 * c.amplitude[5] ** 2 == pytest.approx(expected, rel=1e-3)


def test_jittered_bins_beyond_a_table_are_refused_for_every_seed() -> None:
    """Not only where a draw happens to fall beyond it."""
    omega = np.linspace(0.2, 2.0, 100)
    table = TableSpectrum(omega, STATE_7.density(omega))
    for seed in range(20):
        with pytest.raises(PanelsimError, match="beyond the table") as refusal:
            RandomSeaway(table, JitteredFrequencies(0.2, 2.0, 0.05), 0.0, seed)
    assert "0.225" in str(refusal.value) and "1.975" in str(refusal.value)
    RandomSeaway(table, JitteredFrequencies(0.225, 1.975, 0.05), 0.0, 1)


def test_variance_of_the_record_is_half_the_sum_of_squares() -> None:
    """Over one period of the even grid, 2π/0.1 s, all components are orthogonal: equal to rounding."""
    sea = RandomSeaway(STATE_7, EVEN, 150 * DEG, 5)
    t = np.linspace(0.0, 2 * np.pi / 0.1, 400, endpoint=False)
    record = sea.in_translating_axes(0.0).elevation(13.0, -4.0, t)
    assert np.mean(record**2) == pytest.approx(0.5 * np.sum(sea.components.amplitude**2), rel=1e-12)


# --- directions ---------------------------------------------------------------------------------------------


def test_amplitudes_of_a_short_crested_sea() -> None:
    """(36), ordered by frequency, then direction; phases in that order."""
    c = short_crested().components
    offsets = np.arange(-80, 81, 20) * DEG
    np.testing.assert_allclose(
        c.frequency.reshape(19, 9), np.tile(EVEN.frequency[:, None], (1, 9)), rtol=1e-14
    )
    np.testing.assert_allclose(c.wave_heading.reshape(19, 9)[4], 150 * DEG + offsets, rtol=1e-12)
    spread = 2 / np.pi * np.cos(offsets) ** 2
    expected = np.sqrt(2 * np.outer(STATE_7.density(EVEN.frequency), spread) * 0.1 * 20 * DEG)
    np.testing.assert_allclose(c.amplitude, expected.ravel(), rtol=1e-11)
    np.testing.assert_array_equal(c.phase, np.random.default_rng(1001).uniform(0, 2 * np.pi, 171))


def test_a_spread_spectrum_is_the_same_sea_as_a_heading_with_spreading() -> None:
    """β = ν + π − χ, with waves from 200° and the ship on 50°: 330°."""
    spectrum = SpreadSpectrum(STATE_7, CosineSquared(), 200 * DEG)
    compass = RandomSeaway(spectrum, EVEN, seed=4, ship_heading=50 * DEG, direction_step=20 * DEG)
    relative = RandomSeaway(STATE_7, EVEN, 330 * DEG, 4, spreading=CosineSquared(), direction_step=20 * DEG)
    turned = RandomSeaway(
        STATE_7, EVEN, 330 * DEG, 4, 0.9, 300 * DEG, spreading=CosineSquared(), direction_step=20 * DEG
    )
    for other in (relative.components, turned.components):
        np.testing.assert_allclose(compass.components.amplitude, other.amplitude, rtol=1e-11)
        np.testing.assert_allclose(compass.components.wave_heading, other.wave_heading, atol=1e-12)
        np.testing.assert_array_equal(compass.components.phase, other.phase)


@pytest.mark.parametrize(
    ("sea_direction", "course", "heading"),
    [(0, 0, 180), (90, 0, 270), (0, 90, 90), (180, 0, 0), (45, 350, 235)],
)
def test_compass_directions_as_the_ship_meets_them(
    sea_direction: float, course: float, heading: float
) -> None:
    """Waves from north meet a ship going north head on; from east they come from starboard (270°)."""
    spectrum = SpreadSpectrum(STATE_7, CosineHalfAngle(40.0), sea_direction * DEG)
    sea = RandomSeaway(spectrum, EVEN, ship_heading=course * DEG, direction_step=5 * DEG)
    c = sea.components
    centre = np.sum(c.amplitude**2 * np.exp(1j * (c.wave_heading - heading * DEG)))
    assert abs(np.angle(centre)) < 1e-12


def test_a_ten_parameter_sea_keeps_its_systems_apart() -> None:
    """Energy and mean heading of the components are those of the spectrum."""
    sea = RandomSeaway(TEN, FINE, seed=2, ship_heading=300 * DEG, direction_step=10 * DEG)
    c = sea.components
    assert c.count == 46 * 36
    assert sea.carried == pytest.approx(sea.energy_share, rel=5e-3)  # the jitter of 36 directions
    for swell, chosen in ((True, c.frequency < 0.45), (False, c.frequency > 1.1)):
        vector = np.sum(c.amplitude[chosen] ** 2 * np.exp(1j * c.wave_heading[chosen]))
        expected = (30 if swell else 110) + 180 - 300
        # The other system and the jitter move it by a few degrees.
        assert np.angle(vector) / DEG == pytest.approx(expected, abs=3.0)


def test_a_table_brings_its_own_directions() -> None:
    omega, directions = np.linspace(0.25, 2.0, 36), np.arange(12) * 30 * DEG
    table = DirectionalTable(omega, directions, TEN.density(omega[:, None], directions))
    sea = RandomSeaway(table, omega, seed=3)
    assert sea.components.count == 36 * 12
    expected = 2 * table.density_table * 0.05 * 30 * DEG
    np.testing.assert_allclose(sea.components.amplitude.reshape(36, 12) ** 2, expected, rtol=1e-10)
    by_step = RandomSeaway(table, omega, seed=3, direction_step=15 * DEG)
    assert by_step.components.count == 36 * 24
    assert by_step.components.variance == pytest.approx(sea.components.variance, rel=1e-12)


def test_waves_of_one_frequency_from_several_directions_stand_in_a_pattern() -> None:
    """The mean square over all time depends on the place with the even grid, and not with the others.

    The components of one frequency add up before they are squared: ½ Σ_ω |Σ_ν a e^{i(k·x − ε)}|².
    """

    def places(choice: FrequencyChoice) -> FloatArray:
        c = short_crested(choice).components
        x = np.linspace(-400, 400, 41)[:, None]
        wave = c.amplitude * np.exp(1j * (c.wavenumber() * x * np.cos(c.wave_heading) - c.phase))
        _, group = np.unique(c.frequency, return_inverse=True)
        sums = np.array([wave[:, group == g].sum(axis=1) for g in range(group.max() + 1)])
        return 0.5 * np.sum(np.abs(sums) ** 2, axis=0) / c.variance

    assert np.ptp(places(EVEN)) > 0.3
    for choice in (JITTERED, EqualEnergyFrequencies(19)):
        np.testing.assert_allclose(places(choice), 1.0, rtol=1e-12)


# --- dropping -----------------------------------------------------------------------------------------------


def test_the_report_sea_keeps_162_of_171_components() -> None:
    """TM 2003-190 section 8.4 keeps 160 after dropping those with less than one millionth of the energy.

    With its own (36) and even intervals only the nine of 0.2 rad/s are that small (at most 4e-10), and the
    next, 2.0 rad/s at ±80°, have 3.2e-6. They would go, and 160 remain, with the trapezoid rule in both
    frequency and direction, whose end intervals are half as wide: a quarter of that is 0.8e-6.
    """
    sea = short_crested(drop_below=1e-6)
    assert (sea.components.count, sea.dropped) == (162, 9)
    energy = short_crested().components.amplitude.reshape(19, 9) ** 2
    share = np.sort((energy / energy.sum()).ravel())
    assert share[8] < 4e-10 and share[9] == pytest.approx(3.24e-6, rel=2e-3)
    ends = np.outer(np.r_[0.5, np.ones(17), 0.5], np.r_[0.5, np.ones(7), 0.5])
    trapezoid = energy * ends / np.sum(energy * ends)
    assert np.sum(trapezoid >= 1e-6) == 160
    # Half intervals in one of the two only would leave 162 as well.
    for factor in (ends / ends[:, :1], ends / ends[:1]):
        assert np.sum(energy * factor >= 1e-6 * np.sum(energy * factor)) == 162


def test_dropping_keeps_the_sea_and_its_energy() -> None:
    """The waves that stay have their own phases; one factor restores the energy."""
    whole, fewer = short_crested(), short_crested(drop_below=1e-3)
    assert fewer.dropped == whole.components.count - fewer.components.count > 9
    small = negligible(whole.components, 1e-3)
    for name in ("frequency", "wave_heading", "phase"):
        np.testing.assert_array_equal(
            getattr(fewer.components, name), getattr(whole.components, name)[~small]
        )
    factor = fewer.components.amplitude / whole.components.amplitude[~small]
    np.testing.assert_allclose(factor, factor[0], rtol=1e-13)
    lost = np.sum(whole.components.amplitude[small] ** 2) / np.sum(whole.components.amplitude**2)
    assert factor[0] == pytest.approx(1 / np.sqrt(1 - lost), rel=1e-12)
    assert fewer.components.variance == pytest.approx(whole.components.variance, rel=1e-13)
    assert fewer.carried == whole.carried


def test_less_than_means_less_than() -> None:
    """Shares 0.2 and 0.8: at 0.2 both stay; above it the small one goes and the other grows by √1.25."""
    both = waves((1.0, 0.5), (2.0, 0.7))
    assert not negligible(both, 0.2).any() and not negligible(both, 0.0).any()
    assert without(both, negligible(both, 0.2)) is both
    one = without(both, negligible(both, 0.201))
    assert one.count == 1
    assert one.amplitude[0] == pytest.approx(2 * np.sqrt(1.25), rel=1e-14)


# --- records and seeds --------------------------------------------------------------------------------------


def test_elevations_over_seeds_are_gaussian() -> None:
    """1000 seeds at one place and time, against N(0, ½ Σ a²): Kolmogorov and Smirnov at 1 % false alarms.

    200 waves of equal energy: the kurtosis is 3 − 1.5/200, which 1000 draws cannot tell from 3.
    """
    choice = EqualEnergyFrequencies(200)
    elevations = []
    for seed in range(1000):
        c = RandomSeaway(STATE_7, choice, 150 * DEG, seed).components
        angle = c.wavenumber() * 40.0 * np.cos(c.wave_heading) - c.frequency * 12.0 - c.phase
        elevations.append(np.sum(c.amplitude * np.cos(angle)))
    assert kstest(elevations, "norm", args=(0.0, np.sqrt(c.variance))).pvalue > 0.01


def test_maxima_of_narrow_band_records_are_rayleigh() -> None:
    """The first crest of each of 1000 seeds, at 1 % false alarms: P(crest > c) = exp(−c²/2m0).

    The band of 0.58 to 0.62 rad/s has ε² of some 4e-4, which makes a share of 1e-4 of the crests negative.
    """
    narrow = TableSpectrum(np.array([0.58, 0.6, 0.62]), np.array([0.0, 20.0, 0.0]))
    choice, t = EqualEnergyFrequencies(60), np.arange(0.0, 13.0, 0.05)
    crests = []
    for seed in range(1000):
        sea = RandomSeaway(narrow, choice, 0.0, seed)
        c = sea.components
        record = np.cos(np.outer(t, c.frequency) + c.phase) @ c.amplitude
        first = np.flatnonzero((record[1:-1] > record[:-2]) & (record[1:-1] >= record[2:]))[0] + 1
        crests.append(record[first])
    assert kstest(crests, "rayleigh", args=(0.0, np.sqrt(narrow.moment(0)))).pvalue > 0.01


@pytest.mark.parametrize(("speed", "heading"), [(0.0, np.pi), (SPEED, 30 * DEG)])
def test_variance_scatter_against_many_seeds(speed: float, heading: float) -> None:
    """2000 records of 200 s, by quadrature; at 30° the waves are met at frequencies of both signs.

    The standard deviation of 2000 draws is known to 1.6 % for a normal distribution, here to some 3 %.
    """
    c = RandomSeaway(STATE_7, EvenFrequencies(0.3, 1.4, 0.1), heading, 1).components
    t = np.linspace(0.0, 200.0, 801)
    omega = c.encounter_frequency(speed)
    phase = np.random.default_rng(8).uniform(0, 2 * np.pi, (2000, c.count))
    even, odd = np.cos(np.outer(omega, t)), np.sin(np.outer(omega, t))
    records = (c.amplitude * np.cos(phase)) @ even - (c.amplitude * np.sin(phase)) @ odd
    means = np.trapezoid(records**2, t) / 200.0
    assert means.mean() == pytest.approx(c.variance, rel=0.05)
    expected = variance_scatter(c, speed, 200.0)
    print(f"variance scatter {expected:.4f}, of 2000 seeds {means.std() / c.variance:.4f}")
    assert means.std() / c.variance == pytest.approx(expected, rel=0.1)


def test_variance_scatter_in_closed_form() -> None:
    """Two waves of equal energy that beat slowly: √(2·½·½) = 0.71; apart by many beats: none.

    In an instant ζ² has the relative variance 2 − 3/2 Σ e², with e the shares of the energy.
    """
    beating = waves((1.0, 0.6), (1.0, 0.6 + 1e-6))
    assert variance_scatter(beating, 0.0, 3600.0) == pytest.approx(np.sqrt(0.5), rel=1e-3)
    assert variance_scatter(waves((1.0, 0.5), (1.0, 0.9)), 0.0, 1e6) < 1e-4
    uneven = waves((1.0, 0.5), (2.0, 0.9), (1.5, 1.4))
    shares = uneven.amplitude**2 / np.sum(uneven.amplitude**2)
    instant = np.sqrt(2 - 1.5 * np.sum(shares**2))
    assert variance_scatter(uneven, 0.0, 1e-6) == pytest.approx(instant, rel=1e-9)
    # One wave alone: cos² over a part of its period, sin(ωT)/ωT of √½.
    assert variance_scatter(waves((2.0, 0.5)), 0.0, 3.0) == pytest.approx(
        np.sqrt(0.5) * np.sin(1.5) / 1.5, rel=1e-12
    )
    assert variance_scatter(waves((0.0, 0.5)), 0.0, 60.0) == 0.0


def test_waves_met_from_ahead_and_from_behind_beat_too() -> None:
    """ω_e = +0.2 and −0.2 rad/s are one frequency to the ship; ω_i − ω_j alone would miss it."""
    k_cos = SPEED / STANDARD_GRAVITY
    omega = [
        (1 - np.sqrt(1 - 4 * k_cos * 0.2)) / (2 * k_cos),
        (1 + np.sqrt(1 + 4 * k_cos * 0.2)) / (2 * k_cos),
    ]
    c = WaveComponents(np.ones(2), np.array(omega), np.zeros(2), np.zeros(2))
    np.testing.assert_allclose(c.encounter_frequency(SPEED), [0.2, -0.2], rtol=1e-12)
    assert variance_scatter(c, SPEED, 1e5) == pytest.approx(np.sqrt(0.5), rel=1e-3)


def test_a_dense_grid_scatters_as_a_real_sea_does() -> None:
    """√(2π ∫S² dω / T)/m0, once the components are much closer than 2π/T and T is many waves.

    At a finite step the components, which do not beat with themselves, leave out Δω ∫S² dω.
    """
    spectrum, duration = Bretschneider(4.0, 10.0), 600.0
    sea = RandomSeaway(spectrum, EvenFrequencies(0.3, 2.8, 0.001), np.pi, 1)
    squared = quad(lambda omega: spectrum.density(omega) ** 2, 0.2, 4.0, limit=200)[0]
    expected = np.sqrt((2 * np.pi / duration - 0.001) * squared) / spectrum.moment(0)
    # The record ends somewhere in its waves: corrections of the order of T_p/T.
    assert variance_scatter(sea.components, 0.0, duration) == pytest.approx(expected, rel=0.01)


def test_two_waves_of_the_report_grid_beat_for_hours_at_30_degrees() -> None:
    """0.5 and 0.6 rad/s meet the ship at 0.27284 and 0.27289 rad/s, of which a record of 30 min sees one.

    Where a finer sea scatters less and less with time, the report's grid keeps its 35 % for hours.
    """
    report = RandomSeaway(STATE_7, EVEN, 30 * DEG, 1).components
    met = report.encounter_frequency(SPEED)
    np.testing.assert_allclose(met[3:5], [0.27284, 0.27289], atol=1e-5)
    half_hour, three_hours = (variance_scatter(report, SPEED, hours * 3600.0) for hours in (0.5, 3.0))
    assert half_hour == pytest.approx(0.371, abs=2e-3) and three_hours == pytest.approx(0.348, abs=2e-3)
    fine = RandomSeaway(STATE_7, EvenFrequencies(0.2, 2.0, 0.002), 30 * DEG, 1).components
    assert variance_scatter(fine, SPEED, 3 * 3600.0) < 0.15
    head_seas = RandomSeaway(STATE_7, EVEN, 150 * DEG, 1).components
    assert variance_scatter(head_seas, SPEED, 1800.0) < 0.01


def test_jitter_keeps_a_sea_from_repeating() -> None:
    for choice in (JITTERED, EqualEnergyFrequencies(30)):
        sea = RandomSeaway(STATE_7, choice, 150 * DEG, 1001)
        assert repeat_time(sea.components, SPEED, 3600.0) is None
    even = RandomSeaway(STATE_7, EVEN, 90 * DEG, 1001)
    assert repeat_time(even.components, SPEED, 3600.0) == pytest.approx(2 * np.pi / 0.1, abs=0.2)


def test_a_repeat_after_hours_is_found() -> None:
    """Twenty waves at multiples of 2π/20 000 s, beyond the 65 536 lags that are searched at once.

    Each wave is much like the one before, 12 s earlier; that is no repetition.
    """
    c = waves(*((1.0, 2 * np.pi / 20_000 * n) for n in range(1600, 1620)))
    assert repeat_time(c, 0.0, 19_000.0) is None
    assert repeat_time(c, 0.0, 30_000.0) == pytest.approx(20_000.0, abs=0.3)
    # A run that ends just before: one of the last waves, and not the first of the flank at 19 825 s.
    assert 19_950.0 < (repeat_time(c, 0.0, 19_995.0) or 0.0) < 19_995.0


def test_repeat_time_finds_the_peak_of_the_autocorrelation() -> None:
    """The sum of cosines at the lag that comes out, against its neighbours; and nothing before it."""
    c = RandomSeaway(STATE_7, EVEN, 150 * DEG, 1001).components
    again = repeat_time(c, SPEED, 1860.0)
    assert again is not None
    lag = np.arange(0.0, again + 2.0, 0.05)
    weight = c.amplitude**2 / np.sum(c.amplitude**2)
    correlation = np.cos(np.outer(lag, c.encounter_frequency(SPEED))) @ weight
    fallen = np.flatnonzero(correlation < 0.5)[0]
    assert correlation[fallen:][lag[fallen:] < again - 2.0].max() < 0.95
    assert lag[fallen + np.argmax(correlation[fallen:])] == pytest.approx(
        again, abs=0.2
    )  # a step of the search


def test_checks_of_a_large_sea_are_quick() -> None:
    """3000 components over an hour; 20 and 240 ms were measured."""
    c = RandomSeaway(STATE_7, EqualEnergyFrequencies(3000), 30 * DEG, 1).components
    for check, limit in ((repeat_time, 0.5), (variance_scatter, 3.0)):
        start = time.process_time()
        check(c, SPEED, 3600.0)
        assert time.process_time() - start < limit


# --- refusals -----------------------------------------------------------------------------------------------


def test_directions_too_far_apart_are_named() -> None:
    """cos^{2s} with s = 300 is some 7° wide: a grid of 20° cannot carry it, though its frequencies could."""
    with pytest.raises(PanelsimError, match="directions are too far apart") as refusal:
        short_crested(spreading=CosineHalfAngle(300.0))
    assert "direction_step" in str(refusal.value) and "17 directions" in str(refusal.value)
    with pytest.raises(PanelsimError, match="frequencies are too far apart"):
        short_crested(EvenFrequencies(0.2, 2.0, 0.45))


def test_frequencies_that_miss_a_directional_spectrum_are_named() -> None:
    with pytest.raises(PanelsimError, match="too little") as refusal:
        RandomSeaway(TEN, EvenFrequencies(0.6, 2.0, 0.05), direction_step=10 * DEG)
    assert "0.575 to 2.025 rad/s" in str(refusal.value)


def test_frequencies_outside_a_table_are_named() -> None:
    table = TableSpectrum(np.array([0.3, 0.5, 1.0]), np.array([0.1, 1.0, 0.0]))
    with pytest.raises(PanelsimError, match="outside the table"):
        RandomSeaway(table, EvenFrequencies(0.2, 1.0, 0.05), 0.0, 1)


def test_dropping_too_much_is_refused() -> None:
    with pytest.raises(PanelsimError, match="Too much") as refusal:
        short_crested(drop_below=0.02)
    assert "of 171 components" in str(refusal.value)
    with pytest.raises(PanelsimError, match="Too much"):
        short_crested(drop_below=1.0)


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (lambda: EvenFrequencies(0.2, 2.0, 0.0), "step"),
        (lambda: EvenFrequencies(-0.2, 2.0, 0.1), "start"),
        (lambda: EvenFrequencies(2.0, 0.2, 0.1), "grid"),
        (lambda: EvenFrequencies(0.2, 2.0, 1e-9), "grid"),
        (lambda: EvenFrequencies(0.2, np.inf, 0.1), "stop"),
        (lambda: JitteredFrequencies(0.2, 2.0, np.nan), "step"),
        (lambda: JitteredFrequencies(0.1, 2.0, 0.3), "below 0"),
        (lambda: EqualEnergyFrequencies(1), "count"),
        (lambda: EqualEnergyFrequencies(20.0), "count"),
        (lambda: EqualEnergyFrequencies(20, 1.0, 0.5), "rise"),
        (lambda: EqualEnergyFrequencies(20, np.nan), "rise"),
        (lambda: EqualEnergyFrequencies(20, "0.2"), "rise"),
        (lambda: RandomSeaway(STATE_7, [[0.2, 0.3]], 0.0, 1), "rise"),
        (lambda: RandomSeaway(STATE_7, "0.2", 0.0, 1), "rise"),
        (lambda: RandomSeaway(STATE_7, [0.0, 0.3], 0.0, 1), "not positive"),
        (lambda: RandomSeaway("bretschneider", EVEN, 0.0, 1), "another kind"),
        (lambda: RandomSeaway(STATE_7, EVEN), "wave heading"),
        (lambda: RandomSeaway(STATE_7, EVEN, 150), "radians"),
        (lambda: RandomSeaway(STATE_7, EVEN, 0.0, ship_heading=270), "ship heading"),
        (lambda: RandomSeaway(STATE_7, EVEN, 0.0, seed=None), "seed"),
        (lambda: RandomSeaway(STATE_7, EVEN, 0.0, minimum_energy=2), "minimum_energy"),
        (lambda: RandomSeaway(STATE_7, EVEN, 0.0, drop_below=-1e-6), "drop_below"),
        (lambda: RandomSeaway(STATE_7, EVEN, 0.0, drop_below="1e-6"), "drop_below"),
        (lambda: RandomSeaway(STATE_7, EVEN, 0.0, direction_step=0.3), "direction_step"),
        (lambda: RandomSeaway(STATE_7, EVEN, 0.0, spreading=CosineSquared()), "direction step"),
        (lambda: short_crested(spreading=2.0), "spreading is of another kind"),
        (lambda: short_crested(direction_step=20), "direction step in radians"),
        (lambda: RandomSeaway(TEN, EVEN), "direction step"),
        (lambda: RandomSeaway(TEN, EVEN, 0.0, direction_step=0.1), "no wave_heading"),
        (lambda: RandomSeaway(TEN, EVEN, spreading=CosineSquared()), "no spreading"),
        (lambda: variance_scatter(waves((1.0, 0.5), (1.0, 0.6)), 0.0, 0.0), "duration"),
    ],
)
def test_bad_input_is_refused(bad: object, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        bad()  # type: ignore[operator]
