"""From differences of RMS to the verdicts on the report's sentences; minor modes count for nothing."""

from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import DOF_NAMES
from panelsim.results.difference_band import difference_band
from panelsim.results.rms_study import RmsStudy
from panelsim.results.verdicts import (
    Mask,
    WorstDifference,
    difference_at,
    difference_sizes,
    from_heading,
    per_cent,
    unfinished,
    worst_difference,
)


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
    counts = bool((difference_sizes(study, row, mask) >= 0.0).any())
    return worst_difference(study, row, mask) if counts else None


def within(study: RmsStudy, level: str, mask: Mask, most: float, name: str = "") -> Finding:
    """Whether every difference is `most` or less."""
    found = worst(study, level, mask)
    if found is None:
        return Finding(False, f"{name}no motion that counts")
    holds = bool(abs(found.amount) <= most)
    bound = f"{'≤' if holds else 'not ≤'} {100 * most:g} %"
    return Finding(holds, f"{name}{found.told}, {bound}{by_chance(study, level, mask, most)}")


def beyond(study: RmsStudy, level: str, mask: Mask, least: float, name: str = "") -> Finding:
    """Whether any difference is more than `least`."""
    found = worst(study, level, mask)
    if found is None:
        return Finding(False, f"{name}no motion that counts")
    holds = bool(abs(found.amount) > least)
    bound = f"{'>' if holds else 'not >'} {100 * least:g} %"
    return Finding(holds, f"{name}{found.told}, {bound}{by_chance(study, level, mask, least)}")


def by_chance(study: RmsStudy, level: str, mask: Mask, threshold: float) -> str:
    """That a verdict on a threshold lies within the band of chance, and by which motion; "" if it does not.

    A difference beyond the threshold is sure if one is with the whole of its band; that all are within it, if
    no band reaches over it.
    """
    row = study.levels.index(level)
    size = difference_sizes(study, row, mask)
    half = np.nan_to_num(difference_band(study)[row])  # of one realization nothing is known
    half[size < 0.0] = 0.0
    if np.any(size - half > threshold) or not np.any(size + half > threshold):
        return ""
    sea, mode = (int(index) for index in np.unravel_index(int(np.argmax(size)), size.shape))
    if size[sea, mode] + half[sea, mode] > threshold:
        return " (within the band of chance)"
    sea, mode = (int(index) for index in np.unravel_index(int(np.argmax(size + half)), size.shape))
    return f" (within the band of chance, which reaches over it: {difference_at(study, row, sea, mode).told})"


def both(*halves: Finding) -> Finding:
    """A statement of several parts holds only if all do."""
    return Finding(all(half.holds for half in halves), "; ".join(half.figure for half in halves))


def where_it_counts(study: RmsStudy, level: str, threshold: float) -> str:
    """From which height on a difference stays below the threshold, and how much of it a figure would show.

    A sea in which a run failed is not known to stay below. What a figure shows is the difference over the
    largest RMS of the mode in the seas from the same heading: what a reader of the report's figures, which go
    from 0 to 10 m, can see.
    """
    row = study.levels.index(level)
    heights = [sea.significant_wave_height or np.nan for sea in study.seas]
    size = difference_sizes(study, row, everywhere(study)).max(axis=1)
    high = [height for height, worst_there in zip(heights, size, strict=True) if worst_there > threshold]
    if not high:
        return ""
    higher = [height for height in heights if height > max(high)]
    bound = f"none above {100 * threshold:g} % in seas of {min(higher):g} m and more" if higher else ""
    largest = _largest_seen(study, row)
    seen = "" if np.isnan(largest) else f"on the axes of the report's figures it is {100.0 * largest:.2g} %"
    return "; ".join(part for part in (bound, seen) if part)


def exceptions(study: RmsStudy, level: str, mask: Mask, threshold: float) -> str:
    """Motions among these that differ by more than the threshold, and at which heights.

    And whether the band of the difference reaches below the threshold in all of these seas.
    """
    row = study.levels.index(level)
    size = np.where(unfinished(study, row), -1.0, difference_sizes(study, row, mask))
    sure = size - np.nan_to_num(difference_band(study)[row]) > threshold
    found = []
    for heading in dict.fromkeys(sea.wave_heading_deg for sea in study.seas):
        for mode, name in enumerate(DOF_NAMES):
            here = from_heading(study, heading)[:, mode] & (size[:, mode] > threshold)
            if here.any():
                largest = difference_at(study, row, int(np.argmax(np.where(here, size[:, mode], -1.0))), mode)
                span = _heights_told(study, heading, here)
                most = f"up to {per_cent(largest.amount, largest.band)} %"
                chance = "" if np.any(here & sure[:, mode]) else ", within the band of chance"
                found.append(f"{name} at {heading:g}° ({span}, {most}{chance})")
    no_end = unfinished(study, row)
    unknown = [sea.label for sea, modes in zip(study.seas, no_end, strict=True) if modes.any()]
    return "; ".join(
        f"{told} {', '.join(names)}"
        for told, names in ((f"beyond {100 * threshold:g} %:", found), ("not known:", unknown))
        if names
    )


def _heights_told(study: RmsStudy, wave_heading_deg: float, chosen: NDArray[np.bool_]) -> str:
    """Heights of the chosen (S,) of the seas from a heading; "a to b" for two or more with none left out."""
    seas = [i for i, sea in enumerate(study.seas) if sea.wave_heading_deg == wave_heading_deg]
    told = []
    for here, group in groupby(seas, key=lambda i: bool(chosen[i])):
        if here:
            heights = [study.seas[i].significant_wave_height or np.nan for i in group]
            told.append(f"{heights[0]:g}" if len(heights) == 1 else f"{heights[0]:g} to {heights[-1]:g}")
    return f"{', '.join(told)} m"


def _largest_seen(study: RmsStudy, row: int) -> float:
    """The largest change of RMS of a major mode, over the largest RMS of the mode from that heading.

    Of the seas in which all runs finished; NaN where there are none.
    """
    known = ~unfinished(study, row).any(axis=1)
    change = np.where(study.major, np.abs(study.pooled[row] - study.pooled[study.reference]), 0.0)
    shares = [np.nan]
    for heading in {sea.wave_heading_deg for sea in study.seas}:
        here = known & from_heading(study, heading)[:, 0]
        if here.any():
            largest = study.pooled[study.reference][here].max(axis=0)
            shares.append(float(np.max(change[here] / largest)))
    return float(np.fmax.reduce(shares))
