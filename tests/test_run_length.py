"""The band of the RMS of a run, the length and the number of runs for a band: closed forms and chance."""

import numpy as np
import pytest

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.supplementary import Supplementary
from panelsim.response.response import Response, response
from panelsim.response.run_length import SamplingError, sampling_error
from panelsim.seaway.frequencies import EvenFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship

SPEED = 20 * KNOT
SEA = Bretschneider(7.5, 15.0)
DRAWS = 4000
ONE_SIDE = 0.5 * 1.959964  # of the standard error of the variance, for 95 % of the RMS


def _flat(low: float, high: float, bands: int) -> SamplingError:
    """A process of variance 1 and even density between two frequencies."""
    return SamplingError(("x",), np.linspace(low, high, bands + 1), np.full((bands, 1), 1.0 / bands))


def test_two_waves_that_beat_slowly() -> None:
    """Variances 1 and 3 at one frequency: v has the variance 2 · 1 · 3 about 4, however long the run."""
    error = SamplingError(("x",), np.array([0.5, 0.5 + 1e-9]), np.array([[1.0], [3.0]]))
    long = 4000 * np.pi
    assert error.band(long) == pytest.approx(ONE_SIDE * np.sqrt(6.0) / 4.0, rel=1e-5)
    assert error.band(long, 9) == pytest.approx(error.band(long) / 3)
    assert error.floor() == pytest.approx(ONE_SIDE * np.sqrt(6.0) / 4.0, rel=1e-3)
    assert error.run_length(0.5)[0] == np.inf
    assert error.realizations(0.1, long) == pytest.approx(np.ceil(36 * ONE_SIDE**2 * 6 / 16 * 100 / 36))
    assert error.realizations(2.0, long) == 1.0
    assert error.rms == pytest.approx(2.0)


def test_two_waves_apart_need_the_time_that_tells_them_apart() -> None:
    """The band is that of equal frequencies times |s(ΔωT/2)|, whose crests fall as 2/(ΔωT)."""
    apart = 0.02
    error = SamplingError(("x",), np.array([5.0, 5.0 + apart]), np.ones((2, 1)))
    same = ONE_SIDE * np.sqrt(2.0) / 2.0
    wanted = 0.05
    # After this length no crest of the beat is higher; the last that is comes within a beat before it.
    crest = 2.0 * same / (apart * wanted)
    assert crest - 2.0 * np.pi / apart < error.run_length(wanted)[0] < crest


@pytest.mark.parametrize("wanted", [0.1, 0.05, 0.02])
def test_no_longer_run_has_a_wider_band(wanted: float) -> None:
    """Every crest of the beats of ten waves, each 13 to 60 s: a scan of all lengths, 0.2 s apart."""
    frequency = np.array([0.31, 0.42, 0.55, 0.69, 0.84, 1.01, 1.19, 1.38, 1.6, 1.83])
    variance = np.stack([np.exp(-(((frequency - 0.8) / width) ** 2)) for width in (0.3, 0.6)], axis=1)
    error = SamplingError(("x", "y"), frequency, variance)
    found = error.run_length(wanted, 3000.0)
    length = np.arange(10.0, 3000.0, 0.2)
    bands = np.array([error.band(float(one)) for one in length])
    last = [length[np.flatnonzero(of > wanted)[-1]] for of in bands.T]
    # The search may overlook 1 % of the band, which falls as 1/T over its crests; the scan 0.2 s.
    assert found == pytest.approx(last, rel=0.01, abs=0.2)


@pytest.mark.parametrize(("wanted", "most"), [(1e-3, 1000), (1e-9, 10)])
def test_a_narrow_band_in_one_wave_is_found_soon(
    wanted: float, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The band is √½ |s(ωT)| of 0.98: crests of half a period fall as 1/(ωT). The day is at a trough."""
    omega = 2.0 * np.pi / 8.0
    error = SamplingError(("x",), np.array([omega]), np.ones((1, 1)))
    counted, asked = [], SamplingError._band_and_sure
    monkeypatch.setattr(
        SamplingError, "_band_and_sure", lambda self, length: counted.append(length) or asked(self, length)
    )
    found = error.run_length(wanted)[0]
    crest = min(ONE_SIDE * np.sqrt(0.5) / (omega * wanted), 86400.0)
    # The search may overlook 1 % of the band, which is 1 % of the length.
    assert 0.99 * crest - np.pi / omega < found <= crest
    assert len(counted) < most


def test_no_longer_run_in_two_swells_has_a_wider_band() -> None:
    """The same in a spectrum of two narrow bands."""
    error = SamplingError(("x",), np.array([0.5, 0.51, 0.7, 0.71]), np.array([[1.0], [0.0], [1.0]]))
    (found,) = error.run_length(0.2)
    length = np.geomspace(0.2 * found, 20.0 * found, 400)
    bands = np.array([error.band(float(one))[0] for one in length])
    assert bands[length > 1.01 * found].max() < 0.2 < bands[length < 0.99 * found].min()


def test_a_flat_spectrum_has_the_band_of_its_width() -> None:
    """√(2π/(B T)) of the variance for a spectrum of width B that is met by T ≫ 1/B; half for the RMS."""
    error, width, duration = _flat(0.5, 0.9, 1), 0.4, 40000.0
    # Corrections are of the order log(BT)/(BT), 1e-3.
    assert error.band(duration) == pytest.approx(ONE_SIDE * np.sqrt(2 * np.pi / (width * duration)), rel=2e-3)
    wanted = 0.02
    length = (ONE_SIDE / wanted) ** 2 * 2 * np.pi / width
    # Corrections of 1e-3.
    assert error.run_length(wanted) == pytest.approx(length, rel=5e-3)


@pytest.mark.parametrize("duration", [3.0, 30.0, 300.0])
def test_bands_add_up(duration: float) -> None:
    """One wide band is many narrow ones: the integral does not know of the partition."""
    many, one = _flat(2.0, 3.0, 64), _flat(2.0, 3.0, 1)
    # But what goes into the mean, 1/(ωT/2)² of the variance or less, is told band by band.
    assert many.band(duration) == pytest.approx(one.band(duration), rel=2.0 / duration**2)


def test_a_spectrum_scatters_by_its_autocorrelation() -> None:
    """Var v = (4/T) ∫ (1 - τ/T) R² dτ of a Gaussian process, here of two bands, one of them overtaken."""
    error = SamplingError(("x",), np.array([-0.9, -0.5, 0.7]), np.array([[2.0], [1.0]]))
    duration = 57.0
    lag = np.linspace(0.0, duration, 200001)
    correlation = np.zeros_like(lag)
    variance = error.moving(duration)[:, 0]
    for (low, high), of_band in zip([(0.5, 0.9), (-0.5, 0.7)], variance, strict=True):
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        correlation += of_band * np.cos(middle * lag) * np.sinc(half * lag / np.pi)
    scatter = 4.0 / duration * np.trapezoid((1.0 - lag / duration) * correlation**2, lag)
    assert error.band(duration) == pytest.approx(ONE_SIDE * np.sqrt(scatter) / variance.sum(), rel=1e-6)


def test_a_spectrum_that_turns_round_is_met_twice() -> None:
    """Edges that rise and fall again are those of two spectra over each other, of one density."""
    twice = SamplingError(("x",), np.array([0.5, 0.9, 0.5]), np.full((2, 1), 0.5))
    assert twice.band(200.0) == pytest.approx(_flat(0.5, 0.9, 1).band(200.0), rel=1e-9)


def test_random_phases_scatter_the_rms_as_told() -> None:
    """The RMS about the mean of 4000 runs in five waves, of which one hardly moves past the ship."""
    frequency = np.array([1e-4, 0.5, 0.53, -0.62, 1.1])
    amplitude = np.array([9.0, 0.3, 0.3, 0.4, 0.1])
    duration, generator = 400.0, np.random.default_rng(5)
    error = SamplingError(("x",), frequency, 0.5 * amplitude[:, None] ** 2)
    t = duration / 400 * (np.arange(400) + 0.5)
    angle = frequency[:, None] * t + generator.uniform(0.0, 2 * np.pi, (DRAWS, 5, 1))
    rms = np.einsum("i,sit->st", amplitude, np.cos(angle)).std(axis=1)
    expected = np.sqrt(error.moving(duration).sum())
    # The slow wave alone has an RMS of 6.4: 0.36 is left.
    assert rms.mean() == pytest.approx(expected, rel=0.01)
    # Standard deviations of 4000 draws are good to 1.1 %; the band is of first order in a scatter of 8 %.
    assert 1.959964 * rms.std() / expected == pytest.approx(error.band(duration)[0], rel=0.06)


@pytest.fixture(scope="module")
def table(halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary) -> Response:
    return response(
        halifax,
        halifax_database,
        frequencies=[0.5, 0.6],
        wave_headings=np.deg2rad([150.0, 30.0]),
        speeds=[0.0, SPEED],
        supplementary=springs,
    )


def test_the_waves_of_a_seaway_are_those_of_the_response(table: Response) -> None:
    sea = RandomSeaway(SEA, EvenFrequencies(0.2, 2.0, 0.1), np.deg2rad(150.0))
    error = sampling_error(table, sea, speed=SPEED)
    assert error.names == table.signals.names
    assert error.rms == pytest.approx(table.in_sea(sea)["rms"].values[1, 0], rel=1e-12)
    # Table of DESIGN: at 20 knots and 150° the components are far apart, and 20 minutes tell them apart.
    assert error.band(1200.0).max() < 0.01
    assert not error.spectral
    spectral = table.in_sea(SEA)["rms"].values[1, 0]
    # Both are integrals over bands of 1 %.
    assert error.grid_error == pytest.approx(error.rms / spectral - 1.0, abs=5e-3)
    # 0.1 rad/s is coarse for the roll resonance, which lies between two components.
    assert error.grid_error is not None
    assert -0.4 < error.grid_error[3] < -0.2


def test_stern_quartering_seas_beat_for_hours(table: Response) -> None:
    """0.5 and 0.6 rad/s are met at 0.272847 and 0.272900 rad/s: a beat of 33 hours."""
    sea = RandomSeaway(SEA, EvenFrequencies(0.2, 2.0, 0.1), np.deg2rad(30.0))
    error = sampling_error(table, sea, speed=SPEED)
    assert np.isinf(error.run_length(0.1)[[0, 1, 3, 4, 5]]).all()
    # A day is three quarters of the beat.
    assert error.band(6 * 3600.0)[0] > 0.4
    assert 0.1 < error.floor()[0] < 0.2
    # The band of R runs is that of one over √R.
    count = error.realizations(0.1, 1200.0)
    assert (error.band(1200.0, int(count.max())) <= 0.1).all()
    assert (error.band(1200.0) / np.sqrt(count - 1) > 0.1).all()


def test_a_spectrum_is_that_of_many_waves(table: Response) -> None:
    """Waves 0.002 rad/s apart, which are met again after 1400 s or more, are a spectrum to a run of 1200 s.

    But their amplitudes are sure, which takes Σ m² from the variance.
    """
    spectral = sampling_error(table, SEA, speed=SPEED, wave_heading=np.deg2rad(150.0))
    sea = RandomSeaway(SEA, EvenFrequencies(0.2, 2.0, 0.002), np.deg2rad(150.0))
    waves = sampling_error(table, sea, speed=SPEED)
    assert spectral.spectral
    # Bands of 1 % are coarse for the roll resonance.
    assert spectral.rms == pytest.approx(waves.rms, rel=0.005)
    share = (waves.variance / waves.variance.sum(axis=0)) ** 2
    scatter = (waves.band(1200.0) / ONE_SIDE) ** 2 + share.sum(axis=0)
    assert (share.sum(axis=0) > 0.5 * scatter).all()
    assert np.sqrt(scatter) * ONE_SIDE == pytest.approx(spectral.band(1200.0), rel=0.01)


def test_roll_damping_of_all_terms_counts(halifax: Ship, halifax_database: HydroDatabase) -> None:
    tables = [
        response(
            halifax,
            halifax_database,
            frequencies=[0.5],
            wave_headings=[np.pi / 2],
            speeds=[0.0],
            roll_damping=terms,
        )
        for terms in (RollDampingTerms(linear=1e6), RollDampingTerms(linear=1e6, quadratic=1e9))
    ]
    found = [sampling_error(table, SEA).rms[3] for table in tables]
    expected = [float(table.in_sea(SEA)["rms"].sel(signal="roll").values.item()) for table in tables]
    assert found == pytest.approx(expected, rel=0.02)
    assert found[1] < 0.9 * found[0]


def test_what_does_not_move_has_no_band(table: Response) -> None:
    error = SamplingError(("x", "y"), np.array([0.5, 0.8]), np.array([[1.0, 0.0], [1.0, 0.0]]))
    assert np.isnan(error.band(100.0)[1])
    assert np.isnan(error.run_length(0.1)[1])
    assert np.isnan(error.realizations(0.1, 100.0)[1])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"sea": SEA, "wave_heading": 2.0}, "speed is not told"),
        ({"sea": SEA, "speed": SPEED}, "wave heading is not told"),
        ({"sea": SEA, "speed": 3.0, "wave_heading": 2.0}, "does not have this speed"),
        ({"sea": RegularSeaway(1.0, 0.5, 0.0), "speed": SPEED, "wave_heading": 2.0}, "its own heading"),
        ({"sea": 3.0, "speed": SPEED}, "another kind"),
    ],
)
def test_what_is_no_sea_and_no_course_is_refused(
    table: Response, given: dict[str, object], message: str
) -> None:
    with pytest.raises(PanelsimError, match=message):
        sampling_error(table, **given)  # type: ignore[arg-type]


@pytest.mark.parametrize("value", [0.0, -0.1, np.nan, "wide"])
def test_bands_and_lengths_are_positive(value: object) -> None:
    error = _flat(0.5, 0.9, 1)
    for asked in (
        lambda: error.band(value),
        lambda: error.run_length(value),
        lambda: error.run_length(0.1, value),
        lambda: error.realizations(value, 100.0),
    ):
        with pytest.raises(PanelsimError, match="not positive"):
            asked()
