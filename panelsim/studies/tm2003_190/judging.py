"""From differences of RMS to the verdicts on the report's sentences; minor modes count for nothing."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import DOF_NAMES
from panelsim.results.rms_study import RmsStudy
from panelsim.results.verdicts import WorstDifference

Mask = NDArray[np.bool_]  # (S, 6): which modes in which seas


@dataclass(frozen=True)
class Finding:
    """Half a statement: whether it holds, and the figure beside the threshold."""

    holds: bool
    figure: str


def against(study: RmsStudy, level: str) -> RmsStudy:
    """The same study with another level as the reference."""
    return replace(study, reference=study.levels.index(level))


def everywhere(study: RmsStudy) -> Mask:
    """All modes in all seas."""
    return np.ones((len(study.seas), 6), dtype=bool)


def from_heading(study: RmsStudy, wave_heading_deg: float) -> Mask:
    """All modes in the seas from a heading."""
    here = [sea.wave_heading_deg == wave_heading_deg for sea in study.seas]
    return np.repeat(np.array(here)[:, None], 6, axis=1)


def of_modes(study: RmsStudy, *modes: int, wave_heading_deg: float, above: float = 0.0) -> Mask:
    """Some modes in the seas from a heading that are higher than `above` [m]."""
    mask = from_heading(study, wave_heading_deg)
    high = np.array([(sea.significant_wave_height or np.inf) > above for sea in study.seas])
    return mask & high[:, None] & np.isin(np.arange(6), modes)


def worst(study: RmsStudy, level: str, mask: Mask) -> WorstDifference | None:
    """The largest difference of a level from the reference among these; None where none of them counts.

    Its amount is NaN where a run did not go to its end: then nothing is known of the sea.
    """
    row = study.levels.index(level)
    failed = mask & (np.isnan(study.pooled[row]) | np.isnan(study.pooled[study.reference]))
    known = np.where(mask, np.nan_to_num(np.abs(study.difference[row]), nan=-1.0), -1.0)
    size = np.where(failed, np.inf, known)
    sea, mode = np.unravel_index(int(np.argmax(size)), size.shape)
    if size[sea, mode] < 0.0:
        return None
    amount = np.nan if failed[sea, mode] else study.difference[row, sea, mode]
    return WorstDifference(float(amount), study.seas[sea], DOF_NAMES[int(mode)])


def within(study: RmsStudy, level: str, mask: Mask, most: float, name: str = "") -> Finding:
    """Whether every difference is `most` or less."""
    found = worst(study, level, mask)
    if found is None:
        return Finding(False, f"{name}no motion that counts")
    holds = bool(abs(found.amount) <= most)
    return Finding(holds, f"{name}{told(found)}, {'≤' if holds else 'not ≤'} {100 * most:g} %")


def beyond(study: RmsStudy, level: str, mask: Mask, least: float, name: str = "") -> Finding:
    """Whether any difference is more than `least`."""
    found = worst(study, level, mask)
    if found is None:
        return Finding(False, f"{name}no motion that counts")
    holds = bool(abs(found.amount) > least)
    return Finding(holds, f"{name}{told(found)}, {'>' if holds else 'not >'} {100 * least:g} %")


def both(*halves: Finding) -> Finding:
    """A statement of several parts holds only if all do."""
    return Finding(all(half.holds for half in halves), "; ".join(half.figure for half in halves))


def where_it_counts(study: RmsStudy, level: str, threshold: float) -> str:
    """From which height on a difference stays below the threshold, and how much of it a figure would show.

    The latter is the difference over the largest RMS of the mode in the seas from the same heading: what a
    reader of the report's figures, which go from 0 to 10 m, can see.
    """
    row = study.levels.index(level)
    heights = [sea.significant_wave_height or np.nan for sea in study.seas]
    size = np.nan_to_num(np.abs(study.difference[row]), nan=0.0).max(axis=1)
    high = [height for height, worst_there in zip(heights, size, strict=True) if worst_there > threshold]
    if not high:
        return ""
    higher = [height for height in heights if height > max(high)]
    bound = f"none above {100 * threshold:g} % in seas of {min(higher):g} m and more" if higher else ""
    seen = f"on the axes of the report's figures it is {100.0 * _largest_seen(study, row):.2g} %"
    return "; ".join(part for part in (bound, seen) if part)


def exceptions(study: RmsStudy, level: str, mask: Mask, threshold: float) -> str:
    """Motions among these that differ by more than the threshold, with their range of heights."""
    size = np.where(mask, np.nan_to_num(np.abs(study.difference[study.levels.index(level)]), nan=0.0), 0.0)
    found = []
    for heading in dict.fromkeys(sea.wave_heading_deg for sea in study.seas):
        for mode, name in enumerate(DOF_NAMES):
            here = from_heading(study, heading)[:, mode] & (size[:, mode] > threshold)
            heights = [
                sea.significant_wave_height or np.nan
                for sea, beyond_it in zip(study.seas, here, strict=True)
                if beyond_it
            ]
            if heights:
                span = (
                    f"{min(heights):g} m" if len(heights) == 1 else f"{min(heights):g} to {max(heights):g} m"
                )
                found.append(f"{name} at {heading:g}° ({span}, up to {100 * size[here, mode].max():.0f} %)")
    return f"beyond {100 * threshold:g} %: {', '.join(found)}" if found else ""


def _largest_seen(study: RmsStudy, row: int) -> float:
    """The largest change of RMS of a major mode, over the largest RMS of the mode from that heading."""
    change = np.where(study.major, np.abs(study.pooled[row] - study.pooled[study.reference]), np.nan)
    shares = []
    for heading in {sea.wave_heading_deg for sea in study.seas}:
        here = from_heading(study, heading)[:, 0]
        shares.append(change[here] / np.nanmax(study.pooled[study.reference][here], axis=0))
    return float(np.nanmax(np.concatenate(shares)))


def told(found: WorstDifference) -> str:
    """The difference in per cent, with its mode and sea; or that a run did not finish."""
    if np.isnan(found.amount):
        return f"a run did not finish ({found.sea.label})"
    per_cent = 100.0 * found.amount
    figure = f"{per_cent:+.0f}" if abs(per_cent) >= 100.0 else f"{per_cent:+.2g}"
    return f"{figure} % in {found.mode} ({found.sea.label})"
