"""RMS of the six motions of runs that differ in one thing, in the same seas: what a convergence study is.

The rows of every table in it are levels, from coarse to fine or from one model to the other; one of them is
the reference. Runs of one sea and realization share their wave components, so that their differences are
none of sampling.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from panelsim.conventions import CONFIDENCE, FloatArray

# A mode with less than this of the largest rotation or translation of the reference in the same sea, of all
# realizations together, counts for nothing.
MINOR = 0.05


@dataclass(frozen=True)
class StudySea:
    """A sea of a study: from where [deg], significant height [m] and peak period [s], if it has them."""

    label: str
    wave_heading_deg: float
    significant_wave_height: float | None = None
    peak_period: float | None = None


@dataclass(frozen=True)
class RmsStudy:
    """RMS (L, S, R, 6) [m, rad] of L levels in S seas of R realizations each; NaN where a run failed.

    `varied` says what differs, with its unit; `levels` how each level is called and `values` (L,) what it
    amounts to, in that unit; `reference` is the level that the others are compared with. `failures` has a
    sentence for each run that did not go to its end.
    """

    title: str
    varied: str
    levels: tuple[str, ...]
    values: FloatArray
    reference: int
    seas: tuple[StudySea, ...]
    rms: FloatArray
    failures: tuple[str, ...] = ()

    @property
    def pooled(self) -> FloatArray:
        """RMS (L, S, 6) of all realizations together: the root of their mean variance."""
        return np.asarray(np.sqrt(np.mean(self.rms**2, axis=2)))

    @property
    def major(self) -> np.ndarray:
        """Which modes (S, 6) count in each sea, by the reference; none where that has no figures."""
        rms = self.pooled[self.reference]
        largest = np.repeat(np.stack([rms[:, :3].max(axis=1), rms[:, 3:].max(axis=1)], axis=1), 3, axis=1)
        return np.asarray(rms >= MINOR * largest)

    @property
    def unknown(self) -> np.ndarray:
        """Seas (S,) of which the reference has no figures, so that nothing can be said of any mode."""
        return np.asarray(np.isnan(self.pooled[self.reference]).all(axis=1))

    def why_no_difference(self, seas: Sequence[int], mode: int) -> str:
        """Of the reference in these seas "no figures", of a mode that counts in none "minor", else ""."""
        if self.unknown[seas].all():
            return "no figures"
        return "" if self.major[seas, mode].any() else "minor"

    @property
    def difference(self) -> FloatArray:
        """RMS of every level over that of the reference, less 1, (L, S, 6); NaN for minor modes."""
        pooled = self.pooled
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = pooled / pooled[self.reference] - 1.0
        return np.where(self.major, ratio, np.nan)

    @property
    def band(self) -> FloatArray:
        """Half width (L, S, 6) of the 95 % confidence band of `pooled`, over it; NaN for one realization."""
        return confidence_band(np.moveaxis(self.rms, 2, 0))


def confidence_band(rms: FloatArray) -> FloatArray:
    """Half width (…) of the 95 % confidence band of the pooled RMS of realizations (R, …), over it.

    By Student's distribution of the realizations' variances; that of the root is half of it. NaN for one.
    """
    count = len(rms)
    if count < 2:
        return np.full(rms.shape[1:], np.nan)
    variance = rms**2
    error = variance.std(axis=0, ddof=1) / np.sqrt(count)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = error / variance.mean(axis=0)
    return np.asarray(0.5 * student.ppf(0.5 + 0.5 * CONFIDENCE, count - 1) * share)
