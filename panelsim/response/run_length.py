"""How near the RMS of a run comes to that of its sea, and what length or number of runs brings it nearer."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import sici
from scipy.stats import norm

from panelsim.conventions import CONFIDENCE, FloatArray
from panelsim.errors import PanelsimError
from panelsim.response.sampling import variance_scatter
from panelsim.response.transfer_functions import TransferFunctions
from panelsim.seaway.checks import real_numbers, require_positive
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.point_spectrum import PointSpectrum

LONGEST = 86400.0  # s: no run is longer than a day, in which weather changes
SHORTEST = 10.0  # s
# Shares of the energy left out below and above, and the width of a band over its frequency.
_TAILS = (1e-5, 1e-4)
_BAND = 0.01
_EXCESS = 0.01  # of the band: what the search for a run length may overlook
# The longest steps of that search, ratios of lengths: what the mean takes from a run changes with its length,
# of a wave that stands still beside the ship as the square, of a band of waves little.
_STEP_OF_WAVES, _STEP_OF_SPECTRUM = 1.02, 1.1
# Its shortest step, rad of the quickest wave: between two such lengths no crest of a beat is 0.5 % higher.
_STEP_OF_CREST = 0.1
_COARSE = 0.1  # step of the logarithm of the length in what bounds it from above
# Of the standard error of a variance, for half the width of the band of its root.
_ONE_SIDE = 0.5 * float(norm.ppf(0.5 + 0.5 * CONFIDENCE))


@dataclass(frozen=True, eq=False)
class SamplingError:
    """How far the RMS of runs may lie from that of their sea by chance: K signals, one speed, one course.

    `frequency` [rad/s]: the signed frequencies of encounter (M,) of waves, or the edges (M + 1,) of the bands
    of a continuous spectrum, which rise, and fall again where the ship overtakes the waves. `variance` (M, K)
    that each gives each signal, in the squares of their units. Phases are random; of a band, amplitudes as
    well. `grid_error` (K,) is the RMS of the waves over that of the spectrum which they stand for, less 1,
    None where there is none: it is not chance, and neither longer runs nor other phases mend it.
    """

    names: tuple[str, ...]
    frequency: FloatArray
    variance: FloatArray
    grid_error: FloatArray | None = None

    @property
    def rms(self) -> FloatArray:
        """RMS (K,) that endless runs tend to, in the units of the signals."""
        return np.asarray(np.sqrt(self.variance.sum(axis=0)))

    @property
    def spectral(self) -> bool:
        """Whether the sea is a continuous spectrum, not a sum of waves."""
        return len(self.frequency) > len(self.variance)

    def moving(self, duration: float) -> FloatArray:
        """Variance (M, K) about the mean of a run: a wave that hardly moves past the ship is in the mean.

        The square of the mean of a wave over T is s²(ωT/2) of its variance, s(x) = sin x/x.
        """
        ends = self.frequency
        omega = 0.5 * (ends[1:] + ends[:-1]) if self.spectral else ends
        return self.variance * (1.0 - np.sinc(0.5 * omega * duration / np.pi) ** 2)[:, None]

    def band(self, duration: float, realizations: int = 1) -> FloatArray:
        """Half width (K,) of the 95 % band of the RMS of runs of `duration` [s], over the RMS.

        The variances of `realizations` runs of other phases are averaged. 1.96 standard errors of the
        variance, halved for its root: good for narrow bands, and above 0.5 no more than a sign that the run
        tells nothing. NaN for what does not move.
        """
        length = require_positive("duration", duration, "s")
        return self._band_and_sure(length, realizations)[0]

    def _band_and_sure(self, length: float, realizations: int = 1) -> tuple[FloatArray, FloatArray]:
        """The band (K,), and Σ m²/(Σ m)² (K,), which sure amplitudes take from the scatter."""
        moving = self.moving(length)
        total = moving.sum(axis=0)
        scatter = _spectral_scatter if self.spectral else variance_scatter
        deviation = np.sqrt(np.maximum(scatter(self.frequency, moving, length), 0.0) / realizations)
        sure = np.zeros(len(total)) if self.spectral else (moving**2).sum(axis=0)
        return _ONE_SIDE * _ratio(deviation, total), _ratio(sure, total**2)

    def run_length(self, band: float, longest: float = LONGEST) -> FloatArray:
        """Length (K,) [s] from which on no single run has a wider band (0.05 is 5 %), to 1 % of the band.

        Infinite where the longest run [s] has a wider one: waves that meet the ship at nearly one frequency
        beat more slowly, and then only runs of other phases help, `realizations`. NaN for what does not move.
        Raises PanelsimError for a band or a length that is not positive.

        Beats of waves rise and fall with the length T, but T times the scatter of a Gaussian process only
        rises: Var v = (4/T²) ∫ (T - τ) R² dτ, R its autocorrelation. Amplitudes that are sure take Σ m² from
        that. So where the band is narrower than wanted it stays so until T is less by a known ratio: the
        search goes down from the longest run by these steps, and passes over no crest of a beat. Where the
        ratio is next to 1, as for a narrow band in few waves, it goes by a share of the quickest beat.
        """
        wanted = require_positive("band", band, "")
        last = require_positive("longest run", longest, "s")
        first, step = min(SHORTEST, 0.1 * last), _STEP_OF_SPECTRUM if self.spectral else _STEP_OF_WAVES
        crest = 0.0 if self.spectral else _STEP_OF_CREST / max(float(np.abs(self.frequency).max()), 1e-9)
        length, (bands, sure) = last, self._band_and_sure(last)
        found = np.where(np.isnan(bands), np.nan, np.where(bands > wanted, np.inf, first))
        searched = bands <= wanted
        if not self.spectral:
            length = self._no_crest_from(wanted, searched, first, last)
            bands, sure = self._band_and_sure(length)
        while searched.any() and length > first:
            most = ((1.0 + _EXCESS) * wanted / _ONE_SIDE) ** 2 + sure
            ratio = float(np.min((most / ((bands / _ONE_SIDE) ** 2 + sure))[searched]))
            shorter = max(min(length / min(ratio, step), length - crest), first)
            before, (bands, sure) = bands, self._band_and_sure(shorter)
            above = searched & (bands > wanted)
            # Between two lengths so close the bands are about even.
            share = (wanted - before[above]) / (bands[above] - before[above])
            found[above] = length + (shorter - length) * share
            searched &= ~above
            length = shorter
        return np.asarray(found)

    def _no_crest_from(self, wanted: float, searched: NDArray[np.bool_], first: float, last: float) -> float:
        """A length [s] from which on crests of all beats together are no wider than wanted: s²(x) ≤ 1/x².

        Of the signals (K,) that are searched; the last length where that does not tell.
        """
        found = last
        for length in np.geomspace(last, first, int(np.ceil(np.log(last / first) / _COARSE)) + 1):
            x = 0.5 * length * self.frequency
            apart, together = (np.maximum(np.abs(x[:, None] + sign * x), 1.0) ** -2 for sign in (-1.0, 1.0))
            of_pairs = apart + together - np.diag(1.0 + 0.5 * np.diag(together))
            scatter = np.einsum("is,ij,js->s", self.variance, of_pairs, self.variance)
            least = (1.0 - np.maximum(np.abs(x), 1.0) ** -2) @ self.variance
            if not (_ONE_SIDE * np.sqrt(scatter) <= wanted * least)[searched].all():
                break
            found = float(length)
        return found

    def realizations(self, band: float, duration: float) -> FloatArray:
        """Runs (K,) of `duration` [s], of other phases each, whose variances together have this band.

        NaN for what does not move. Raises PanelsimError as `run_length` does.
        """
        wanted = require_positive("band", band, "")
        return np.maximum(np.ceil((self.band(duration) / wanted) ** 2 - 1e-9), 1.0)

    def floor(self, longest: float = LONGEST) -> FloatArray:
        """The band (K,) that the longest run [s] still has: what length alone does not go below."""
        return self.band(longest)


def sampling_error(
    table: TransferFunctions,
    sea: Seaway | PointSpectrum,
    *,
    speed: float | None = None,
    wave_heading: float | None = None,
) -> SamplingError:
    """The sampling error of linear motions, or of the signals of a point, in a sea.

    A seaway is its own components, met on its own course; a random one from one direction is compared with
    its spectrum. A point spectrum is long-crested from `wave_heading` β [rad], by default that of a table
    with one. `speed` [m/s] is by default that of a table with one. Roll damping is that which stands for all
    of its terms in this sea. Raises PanelsimError for seas of another kind, a heading with a seaway, none or
    several to choose from without one, and where the coefficients do not reach.
    """
    own = float(_one_of("speed", speed, table.speeds))
    if isinstance(sea, PointSpectrum):
        heading = float(_one_of("wave heading", wave_heading, table.wave_headings))
        return _of_spectrum(table, sea, own, heading)
    if not isinstance(sea, Seaway) or not sea.components.count:
        raise PanelsimError(
            "The sea is of another kind",
            got=repr(sea)[:60],
            allowed="a seaway with waves, or a point spectrum",
        )
    if wave_heading is not None:
        raise PanelsimError("A seaway has its own heading", got=f"wave_heading={wave_heading!r}")
    waves = sea.components
    damping = _damping(table, sea, own, None)
    encounter, variance = _in_waves(
        table, waves.frequency, waves.wave_heading, own, damping, 0.5 * waves.amplitude**2
    )
    grid_error = None
    if isinstance(sea, RandomSeaway) and sea.directional_spectrum is None:
        spectral = _of_spectrum(table, sea.point_spectrum, own, float(waves.wave_heading[0]))
        grid_error = _ratio(np.sqrt(variance.sum(axis=0)), spectral.rms) - 1.0
    return SamplingError(tuple(table.signals.names), encounter, variance, grid_error)


def _of_spectrum(
    table: TransferFunctions, spectrum: PointSpectrum, speed: float, heading: float
) -> SamplingError:
    """A continuous spectrum in narrow bands, each even over the frequency of encounter."""
    low, high = spectrum.frequency_below(_TAILS[0]), spectrum.frequency_below(1.0 - _TAILS[1])
    edges = np.geomspace(low, high, 2 + int(np.log(high / low) / _BAND))
    gravity = table.linear_ship.ship.gravity
    # Where the frequency of encounter turns round there is an edge, and no other near it.
    turn = 0.5 * gravity / max(speed * np.cos(heading), 1e-9)
    if low < turn < high:
        edges = np.sort(np.append(edges[np.abs(edges / turn - 1.0) > 0.3 * _BAND], turn))
    middle, width = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    damping = _damping(table, spectrum, speed, heading)
    energy = spectrum.density(middle) * width
    _, variance = _in_waves(table, middle, np.full(len(middle), heading), speed, damping, energy)
    ends = encounter_frequency(edges, heading, speed, gravity)
    return SamplingError(tuple(table.signals.names), ends, variance)


def _in_waves(
    table: TransferFunctions,
    frequency: FloatArray,
    heading: FloatArray,
    speed: float,
    damping: float,
    energy: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Frequency of encounter (M,) of waves with energy (M,) [m2], and the variance (M, K) that they give."""
    motions = table.linear_ship.in_waves(frequency, heading, np.array([speed]), np.array([damping]))
    encounter = motions.encounter[0]
    signals = table.signals.of(motions.transfer[0], frequency, heading, encounter)
    return encounter, np.abs(signals) ** 2 * energy[:, None]


def _damping(
    table: TransferFunctions, sea: Seaway | PointSpectrum, speed: float, heading: float | None
) -> float:
    """Linear roll damping [N m s] that stands for all terms in this sea."""
    terms = table.roll_damping[int(np.argmin(np.abs(table.speeds - speed)))]
    if terms.quadratic == 0.0 and terms.cubic == 0.0:
        return terms.linear
    headings = None if heading is None else [heading]
    found = table.in_sea(sea, wave_headings=headings)["equivalent_roll_damping"]
    return float(found.values[int(np.argmin(np.abs(table.speeds - speed))), 0])


def _one_of(name: str, given: float | None, own: FloatArray) -> float:
    """The one given if the table has it, else its only one."""
    if given is None:
        if len(own) == 1:
            return float(own[0])
        raise PanelsimError(f"The {name} is not told", got=f"a table with {len(own)}", remedy="give one")
    value = float(real_numbers(name, given))
    near = float(own[np.argmin(np.abs(own - value))])
    if name == "speed" and abs(near - value) > 1e-6:
        raise PanelsimError("The table does not have this speed", got=f"{value:g} m/s", allowed=own.tolist())
    return near if name == "speed" else value


def _ratio(values: FloatArray, reference: FloatArray) -> FloatArray:
    return np.divide(values, reference, out=np.full(len(values), np.nan), where=reference > 0.0)


def _spectral_scatter(edges: FloatArray, variance: FloatArray, duration: float) -> FloatArray:
    """Variance (K,) of the variances that runs of a Gaussian process show, its density even in each band.

    Var v = ∬ S(ω) S(ω') [s²((ω - ω')T/2) + s²((ω + ω')T/2)] dω dω', s(x) = sin x/x: the integral of the
    autocorrelation squared of Bendat and Piersol, Random Data (2010), section 8.2, over frequencies. The mean
    of s² over a pair of bands is the second difference of a function whose second derivative it is.
    """
    apart, together = (
        np.diff(np.diff(_second_integral(edges[:, None] + sign * edges, duration), axis=0), axis=1)
        for sign in (-1.0, 1.0)
    )
    density = variance / np.diff(edges)[:, None]
    return np.asarray(np.einsum("is,ij,js->s", density, together - apart, density))


def _second_integral(frequency: FloatArray, duration: float) -> FloatArray:
    """What has s²(ωT/2) as its second derivative over ω: 4/T² [u Si(2u) - sin²u - ½ Cin(2u)], u = ωT/2."""
    u = np.abs(0.5 * duration * frequency)
    sine, cosine = sici(2.0 * u)
    with np.errstate(divide="ignore", invalid="ignore"):
        cin = np.where(u > 0.0, np.euler_gamma + np.log(2.0 * u) - cosine, 0.0)
    return np.asarray(4.0 / duration**2 * (u * sine - np.sin(u) ** 2 - 0.5 * cin))
