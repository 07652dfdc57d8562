"""How far apart RMS of motions may be, and what that is called."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import DOF_NAMES
from panelsim.results.difference_band import difference_band
from panelsim.results.rms_study import RmsStudy, StudySea

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


def worst_difference(study: RmsStudy, level: int, wave_heading_deg: float | None = None) -> WorstDifference:
    """The worst of all seas and major modes, or of the seas from one heading [deg].

    The amount is NaN where a run of the level or of the reference did not go to its end.
    """
    chosen = [
        i
        for i, sea in enumerate(study.seas)
        if wave_heading_deg is None or sea.wave_heading_deg == wave_heading_deg
    ]
    # A run that failed is worse than any that did not.
    failed = np.isnan(study.pooled[level]) | np.isnan(study.pooled[study.reference])
    size = np.where(failed, np.inf, np.nan_to_num(np.abs(study.difference[level]), nan=-1.0))[chosen]
    row, mode = np.unravel_index(int(np.argmax(size)), size.shape)
    sea = chosen[int(row)]
    return WorstDifference(
        float(study.difference[level, sea, mode]),
        study.seas[sea],
        DOF_NAMES[int(mode)],
        float(difference_band(study)[level, sea, mode]),
    )
