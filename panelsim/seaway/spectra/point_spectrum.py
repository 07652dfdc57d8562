"""What every point spectrum is: a density S(ω), its moments, and the heights and periods they give."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad
from scipy.optimize import brentq

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import Number, require_positive, require_share
from panelsim.seaway.dispersion import wavenumber
from panelsim.seaway.steepness import nominal_steepness

# Multiples of the peak frequency between which a peaked spectrum is smooth.
PIECES = np.array([0.5, 0.7, 0.85, 0.95, 1.0, 1.05, 1.15, 1.3, 1.6, 2.0, 3.0, 6.0, 20.0])


class PointSpectrum(ABC):
    """The energy of a sea over the wave frequency at one point, TM 2003-190 section 4.1.

    `significant_wave_height` [m] is 4 √m0, or the nominal height of a spectrum that is given by it;
    `peak_period` [s] is 2π over the frequency at which S(ω) is largest.
    """

    significant_wave_height: float
    peak_period: float

    @abstractmethod
    def density(self, omega: ArrayLike) -> FloatArray:
        """Spectral density S(ω) [m² s/rad] at frequencies [rad/s] of any shape; zero at ω ≤ 0."""

    @property
    def tail_power(self) -> float:
        """Power p of the tail ω⁻ᵖ: moments m_n exist for n < p − 1. Infinite where a spectrum ends."""
        return 5.0

    @property
    def frequency_range(self) -> tuple[float, float]:
        """Frequencies [rad/s] between which the density is known."""
        return 0.0, np.inf

    @property
    def break_frequencies(self) -> FloatArray:
        """Rising frequencies [rad/s] at which integrals over the spectrum are split."""
        return PIECES * 2 * np.pi / self.peak_period

    def moment(self, n: int, upper_frequency: float | None = None) -> float:
        """Moment m_n = ∫ S ωⁿ dω, TM 2003-190 (38), n from −1, by quadrature to 1e-9 of its value.

        Over all frequencies, or up to `upper_frequency` [rad/s]. Raises PanelsimError where the tail makes
        it diverge and no upper frequency is given: m4 of all spectra whose tail is ω⁻⁵.
        """
        upper = self._upper(n, upper_frequency)
        if (n, upper) not in self._known_moments:
            self._known_moments[n, upper] = self.integral(
                lambda omega: self.density(omega) * omega**n, 0.0, upper
            )
        return self._known_moments[n, upper]

    def _upper(self, n: int, upper_frequency: float | None) -> float:
        """The end of the integral of a moment, once it is known that the moment exists."""
        if isinstance(n, bool) or not isinstance(n, int | np.integer) or n < -1:
            raise PanelsimError(
                "The order of a moment is no whole number", got=repr(n)[:60], allowed="-1, 0, 1 …"
            )
        if upper_frequency is not None:
            return require_positive("upper_frequency", upper_frequency, "rad/s")
        if n >= self.tail_power - 1:
            raise PanelsimError(
                f"The moment diverges for a spectrum with an ω^-{self.tail_power:g} tail",
                got=f"n = {n}",
                allowed=f"n below {self.tail_power - 1:g}",
                remedy="give upper_frequency, up to which to integrate",
            )
        return np.inf

    @cached_property
    def _known_moments(self) -> dict[tuple[int, float], float]:
        return {}

    def integral(self, integrand: Callable[[float], ArrayLike], low: float, high: float) -> float:
        """Integral from low to high [rad/s] of a function of the frequency as smooth as the spectrum."""
        low, high = np.clip([low, high], *self.frequency_range)
        breaks = self.break_frequencies
        edges = [low, *breaks[(breaks > low) & (breaks < high)], high]
        # What is below 1e-13 of the value at the peak times the peak frequency is as good as zero.
        peak = 2 * np.pi / self.peak_period
        floor = 1e-13 * abs(float(np.asarray(integrand(peak)))) * peak
        return float(
            sum(
                quad(integrand, a, b, epsabs=floor, epsrel=1e-11, limit=200)[0]
                for a, b in pairwise(edges)
                if a < b
            )
        )

    def energy_between(self, low: float, high: float) -> float:
        """Share of m0 between two frequencies [rad/s], to 1e-11; `high` may be infinite."""
        if not (isinstance(low, Number) and isinstance(high, Number) and low <= high):
            raise PanelsimError(
                "The frequencies do not rise", got=f"{low!r} to {high!r} rad/s", allowed="low ≤ high, no NaN"
            )
        return self._share_below(high) - self._share_below(low)

    def _share_below(self, frequency: float) -> float:
        """Share of m0 below a frequency [rad/s], which may be infinite."""
        first, last = self.frequency_range
        if frequency <= first:
            return 0.0
        if frequency >= last:
            return 1.0
        breaks = self.break_frequencies
        i = int(np.searchsorted(breaks, frequency, side="right"))
        if i == len(breaks):
            return 1.0 - self.integral(self.density, frequency, np.inf) / self.moment(0)
        start, known = (breaks[i - 1], self._shares_below_breaks[i - 1]) if i else (0.0, 0.0)
        return float(known + self.integral(self.density, start, frequency) / self.moment(0))

    @cached_property
    def _shares_below_breaks(self) -> FloatArray:
        pieces = [self.integral(self.density, a, b) for a, b in pairwise([0.0, *self.break_frequencies])]
        return np.cumsum(pieces) / self.moment(0)

    @cached_property
    def _shares_at_breaks(self) -> FloatArray:
        return np.array([self._share_below(frequency) for frequency in self.break_frequencies])

    def frequency_below(self, share: float) -> float:
        """Frequency [rad/s] under which a share of m0 lies: the inverse of `energy_between(0, ·)`."""
        share = require_share(share)
        first, last = self.frequency_range
        if share in (0.0, 1.0):
            return last if share else first
        # Between two breaks, or past the last of them.
        breaks = self.break_frequencies
        i = int(np.searchsorted(self._shares_at_breaks, share))
        low, high = breaks[i - 1] if i else first, breaks[min(i, len(breaks) - 1)]
        while self._share_below(high) < share:
            low, high = high, min(2 * high, last)
        return float(
            brentq(lambda omega: self._share_below(omega) - share, low, high, xtol=1e-13, rtol=1e-13)
        )

    @property
    def mean_period(self) -> float:
        """Mean period T_1 = 2π m0/m1 [s], TM 2003-190 (40)."""
        return 2 * np.pi * self.moment(0) / self.moment(1)

    @property
    def zero_crossing_period(self) -> float:
        """Zero-crossing period T_z = 2π √(m0/m2) [s], TM 2003-190 (41)."""
        return float(2 * np.pi * np.sqrt(self.moment(0) / self.moment(2)))

    @property
    def energy_period(self) -> float:
        """Energy period T_e = 2π m₋₁/m0 [s]."""
        return 2 * np.pi * self.moment(-1) / self.moment(0)

    def crest_period(self, upper_frequency: float) -> float:
        """Mean time from crest to crest 2π √(m2/m4) [s] of the waves up to a frequency [rad/s].

        WORKSHOP 4.3, which calls it T_p; it is not the peak period, and tends to 0 with no upper frequency.
        """
        _, m2, m4 = self._even_moments(upper_frequency)
        return float(2 * np.pi * np.sqrt(m2 / m4))

    def bandwidth(self, upper_frequency: float) -> float:
        """Bandwidth ε [-] of the waves up to a frequency [rad/s], between 0 and 1, WORKSHOP 4.3."""
        return bandwidth_of(*self._even_moments(upper_frequency))

    def _even_moments(self, upper_frequency: float) -> tuple[float, float, float]:
        m0, m2, m4 = (self.moment(n, upper_frequency) for n in (0, 2, 4))
        if m0 * m4 <= 0.0:
            raise PanelsimError(
                "There is no energy below the upper frequency",
                got=f"{upper_frequency:g} rad/s",
                allowed=f"more than the peak, {2 * np.pi / self.peak_period:.3g} rad/s",
            )
        return m0, m2, m4

    @cached_property
    def peakedness(self) -> float:
        """Peakedness Q_p = (2/m0²) ∫ ω S² dω of Goda (1970)."""
        squared = self.integral(lambda omega: omega * self.density(omega) ** 2, 0.0, np.inf)
        return 2.0 * squared / self.moment(0) ** 2

    @property
    def nominal_steepness(self) -> float:
        """2π H_s / (g T_p²), TM 2003-190 (56)."""
        return nominal_steepness(self.significant_wave_height, self.peak_period)

    def slope_density(self, omega: ArrayLike, gravity: float = STANDARD_GRAVITY) -> FloatArray:
        """Spectral density S ω⁴/g² [rad² s/rad] of the wave slope, WORKSHOP 4.5; gravity in m/s²."""
        return self.density(omega) * wavenumber(omega, gravity) ** 2

    def mean_square_slope(self, upper_frequency: float, gravity: float = STANDARD_GRAVITY) -> float:
        """Mean square slope m4/g² [rad²] of the waves up to a frequency [rad/s]."""
        return self.moment(4, upper_frequency) / gravity**2


def bandwidth_of(m0: float, m2: float, m4: float) -> float:
    """Bandwidth ε = √(1 − m2²/(m0 m4)) [-] of three moments, 0 for one frequency, WORKSHOP 4.3."""
    return float(np.sqrt(max(1.0 - m2**2 / (m0 * m4), 0.0)))
