"""How far apart RMS of motions may be, and what that is called."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.results.difference_band import difference_band
from panelsim.results.rms_study import RmsStudy, StudySea

Mask = NDArray[np.bool_]  # (S, 6): which modes in which seas

# Differences of RMS, minor modes left out. The classes overlap: 3 % is slight, of little influence and
# noticeable.
IDENTICAL = 0.01
SLIGHT = 0.05
NOTICEABLE = 0.02
SIGNIFICANT = 0.10


def words(difference: float) -> str:
    """Every class that a difference, of either sign, belongs to; "not known" for NaN."""
    size = abs(difference)
    if np.isnan(size):
        return "not known"
    if size <= IDENTICAL:
        return "practically identical"
    holds = {
        "slightly different": size <= SLIGHT,
        "of little influence": size <= SLIGHT,
        "noticeable": size > NOTICEABLE,
        "significant": size > SIGNIFICANT,
    }
    return ", ".join(word for word, true in holds.items() if true)


def per_cent(difference: float, band: float = np.nan) -> str:
    """A signed difference in per cent, with the half width of its band where that is known; – for NaN."""
    if np.isnan(difference):
        return "–"
    amount, half = 100.0 * difference, 100.0 * band
    told = f"{amount:+.0f}" if abs(amount) >= 99.5 else f"{amount:+.2g}"
    if np.isnan(half):
        return told
    return f"{told} ± {half:.0f}" if half >= 99.5 else f"{told} ± {half:.2g}"


@dataclass(frozen=True)
class WorstDifference:
    """The largest difference of a level from the reference, signed; in which sea and mode.

    `band` is the half width of its 95 % band, NaN where there is one realization.
    """

    amount: float
    sea: StudySea
    mode: str
    band: float = np.nan

    @property
    def told(self) -> str:
        """The difference in per cent, with its band, mode and sea; or that a run did not finish."""
        if np.isnan(self.amount):
            return f"a run did not finish ({self.sea.label})"
        return f"{per_cent(self.amount, self.band)} % in {self.mode} ({self.sea.label})"


def from_heading(study: RmsStudy, wave_heading_deg: float) -> Mask:
    """All modes (S, 6) in the seas from a heading."""
    here = [sea.wave_heading_deg == wave_heading_deg for sea in study.seas]
    return np.repeat(np.array(here)[:, None], 6, axis=1)


def unfinished(study: RmsStudy, level: int) -> Mask:
    """Where a run of the level or of the reference did not go to its end (S, 6)."""
    return np.asarray(np.isnan(study.pooled[level]) | np.isnan(study.pooled[study.reference]))


def difference_sizes(study: RmsStudy, level: int, among: Mask | None = None) -> FloatArray:
    """Size of the differences (S, 6), of all or some: infinite where a run failed, -1 where none counts.

    A run that failed is worse than any that did not.
    """
    chosen = np.ones((len(study.seas), 6), dtype=bool) if among is None else among
    known = np.where(chosen, np.nan_to_num(np.abs(study.difference[level]), nan=-1.0), -1.0)
    return np.where(chosen & unfinished(study, level), np.inf, known)


def difference_at(study: RmsStudy, level: int, sea: int, mode: int) -> WorstDifference:
    """The difference of one mode in one sea."""
    return WorstDifference(
        float(study.difference[level, sea, mode]),
        study.seas[sea],
        DOF_NAMES[mode],
        float(difference_band(study)[level, sea, mode]),
    )


def worst_difference(study: RmsStudy, level: int, among: Mask | None = None) -> WorstDifference:
    """The worst of all seas and major modes, or of some of them.

    The amount is NaN where a run of the level or of the reference did not go to its end.
    """
    size = difference_sizes(study, level, among)
    sea, mode = (int(index) for index in np.unravel_index(int(np.argmax(size)), size.shape))
    return difference_at(study, level, sea, mode)
