"""Figures of a study of RMS, as the report lays them out: six panels, one for each motion."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from panelsim.conventions import CONFIDENCE, DOF_NAMES, FloatArray
from panelsim.errors import PanelsimError
from panelsim.results.rms_study import MINOR, RmsStudy
from panelsim.results.rms_tables import display_rms
from panelsim.results.statistics import display_unit
from panelsim.results.verdicts import IDENTICAL
from panelsim.view.plots import COLORS, INK, plain, save

WIDE = 20.0  # times one per cent: from here on differences are drawn by their logarithm
_ROOM = 0.2  # of half of that axis, beyond the largest difference
_MARGINS = {"left": 0.06, "right": 0.99, "top": 0.925, "bottom": 0.095, "hspace": 0.28, "wspace": 0.17}
_MARKERS = "osD^vP*X"


def rms_over_height(study: RmsStudy, wave_heading_deg: float, path: Path) -> Path:
    """RMS of each motion over significant height in the seas from one heading, TM 2003-190 figures 10 to 17.

    Below each motion the difference of the levels from the reference, where the motion is not minor; shaded
    the confidence band of the reference, if it is known. Raises PanelsimError where no sea from there has a
    height.
    """
    seas = _by_height(study, wave_heading_deg)
    height = np.array([study.seas[i].significant_wave_height for i in seas], dtype=np.float64)
    # Margins by hand: a layout engine takes as long again as the picture, and pages have many of them.
    figure = Figure(figsize=(12, 9))
    axes = figure.subplots(
        4,
        3,
        sharex=True,
        height_ratios=[3, 1.2, 3, 1.2],
        gridspec_kw=_MARGINS,  # of the figure, and of a panel
    )
    above, below = axes[[0, 2]].ravel(), axes[[1, 3]].ravel()
    shown, band = display_rms(study.pooled)[:, seas], study.band[study.reference, seas]
    for mode, (axis, twin) in enumerate(zip(above, below, strict=True)):
        _panel(axis, DOF_NAMES[mode], f"RMS [{display_unit(DOF_NAMES[mode])[0]}]")
        plain(twin)
        _shade(axis, height, shown[study.reference, :, mode], band[:, mode])
        for level, style in enumerate(_styles(study)):
            axis.plot(height, shown[level, :, mode], label=study.levels[level], **style)
            if level != study.reference:
                twin.plot(height, 100.0 * study.difference[level, seas, mode], **style)
        _finish_twin(twin, _why_empty(study, seas, mode))
        axis.set_ylim(bottom=0.0)
        axis.tick_params(labelbottom=False)
    _label_below(axes[-1], "significant wave height [m]")
    for twin in axes[[1, 3], 0]:
        twin.set_ylabel("difference [%]", fontsize=8)
    shade = "" if np.isnan(band).any() else f" (shaded: {100.0 * CONFIDENCE:g} % band of the reference)"
    _caption(figure, above[0], f"{study.title}, wave heading {wave_heading_deg:g}°{shade}")
    return save(figure, path)


def rms_over_levels(study: RmsStudy, path: Path) -> Path | None:
    """Size of the difference from the reference over what is varied, of each motion, a line a sea.

    On logarithmic axes where the values are positive, so that an order of convergence is a slope. A line
    ends where the motion is minor, or where there is no difference at all. None where nothing can be
    compared.
    """
    if np.isnan(study.difference[np.arange(len(study.levels)) != study.reference]).all():
        return None
    others = [i for i in np.argsort(study.values) if i != study.reference]
    values = study.values[others]
    size = 100.0 * np.abs(study.difference[others])
    figure = Figure(figsize=(12, 7), layout="constrained")
    axes = figure.subplots(2, 3, sharex=True, sharey=True)
    for mode, axis in enumerate(axes.ravel()):
        _panel(axis, DOF_NAMES[mode], "")
        for sea, met in enumerate(study.seas):
            shown = np.where(size[:, sea, mode] > 0.0, size[:, sea, mode], np.nan)
            axis.plot(values, shown, label=met.label, **_line(sea))
        axis.axhline(100.0 * IDENTICAL, color=INK, linewidth=0.8, linestyle=":")
        _say(axis, _why_empty(study, list(range(len(study.seas))), mode))
        if values.min() > 0.0:
            axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xticks(values, [study.levels[i] for i in others], rotation=20, fontsize=8)
        axis.set_xticks([], minor=True)
    _label_below(axes[-1], study.varied)
    for axis in axes[:, 0]:
        axis.set_ylabel("size of difference [%]", fontsize=9)
    _caption(figure, axes[0, 0], f"{study.title}: RMS against {study.levels[study.reference]}")
    return save(figure, path)


def _by_height(study: RmsStudy, heading: float) -> list[int]:
    """Seas from a heading that have a height, by it."""
    heights = {
        i: sea.significant_wave_height
        for i, sea in enumerate(study.seas)
        if sea.wave_heading_deg == heading and sea.significant_wave_height is not None
    }
    if not heights:
        raise PanelsimError(
            "No sea of the study has this wave heading and a significant height",
            got=f"{heading:g} deg",
            allowed=", ".join(sorted({f"{sea.wave_heading_deg:g}" for sea in study.seas})),
        )
    return sorted(heights, key=lambda i: heights[i] or 0.0)


def _styles(study: RmsStudy) -> list[dict[str, Any]]:
    """A style a level: the reference broad and pale, over it ever smaller open markers and other dashes.

    Lines that coincide can so be told apart.
    """
    styles: list[dict[str, Any]] = []
    others = 0
    for level in range(len(study.levels)):
        if level == study.reference:
            styles.append({"color": "#b5b5b5", "linewidth": 4.5, "zorder": 2, "solid_capstyle": "round"})
            continue
        styles.append(_line(others) | {"markersize": max(9.0 - 1.8 * others, 3.0), "zorder": 3 + others})
        others += 1
    return styles


def _line(index: int) -> dict[str, Any]:
    """Colour, dashes and open marker of one of several lines."""
    return {
        "color": COLORS[(0, 4, 5, 3, 2, 6, 1)[index % 7]],
        "linestyle": ("-", "--", "-.", ":")[index % 4],
        "linewidth": 1.2,
        "marker": _MARKERS[index % len(_MARKERS)],
        "markersize": 5.0,
        "markerfacecolor": "none",
        "markeredgewidth": 1.1,
    }


def _panel(axis: Axes, name: str, label: str) -> None:
    plain(axis)
    # Its height is given: to find one, every label of the panel would be measured.
    axis.set_title(name, fontsize=10, y=1.0)
    axis.set_ylabel(label, fontsize=9)


def _shade(axis: Axes, height: FloatArray, rms: FloatArray, band: FloatArray) -> None:
    """The confidence band of the reference about it, where it is known.

    Differences have none of it: the runs of all levels share their waves.
    """
    if not np.isnan(band).any():
        axis.fill_between(height, rms * (1.0 - band), rms * (1.0 + band), color=INK, alpha=0.12, linewidth=0)


def _finish_twin(twin: Axes, why_empty: str) -> None:
    """A line at no difference, room for a per cent either way, and a word where there is nothing to show.

    Where a low sea has differences of many times a per cent, those beyond one per cent are drawn by their
    logarithm, so that the others can still be read.
    """
    twin.axhline(0.0, color=INK, linewidth=0.8)
    one = 100.0 * IDENTICAL
    reach = 1.2 * max(one, float(np.max(np.abs(twin.dataLim.intervaly), initial=0.0)))
    if reach > WIDE * one:
        reach *= (10.0 * reach / one) ** _ROOM  # a share of the axis, or half of a marker is cut off
        decades = 10.0 ** np.arange(np.ceil(np.log10(reach)))
        twin.set_yscale("symlog", linthresh=one)
        ticks = np.concatenate([-decades[::-1], [0.0], decades])
        twin.set_yticks(
            ticks,
            [f"{tick:g}" if tick in (0.0, one, -one) or abs(tick) == decades[-1] else "" for tick in ticks],
        )
        twin.set_yticks([], minor=True)
    twin.set_ylim(-reach, reach)
    _say(twin, why_empty)


def _why_empty(study: RmsStudy, seas: list[int], mode: int) -> str:
    """Why no difference of a mode is drawn in any of the seas; empty where some are."""
    told = {
        "no figures": "no figures: the reference did not finish",
        "minor": f"minor: below {100.0 * MINOR:g} % of the largest",
    }
    return told.get(study.why_no_difference(seas, mode), "")


def _say(axis: Axes, text: str) -> None:
    if text:
        axis.text(0.5, 0.8, text, transform=axis.transAxes, ha="center", fontsize=8, color=INK)


def _label_below(axes: Sequence[Axes], text: str) -> None:
    for axis in axes:
        axis.set_xlabel(text, fontsize=9)
        axis.tick_params(labelbottom=True)


def _caption(figure: Figure, axis: Axes, title: str) -> None:
    """A title, and one legend for all panels below them."""
    figure.suptitle(title, fontsize=11)
    handles, labels = axis.get_legend_handles_labels()
    columns = min(len(labels), 6)
    outside = figure.get_layout_engine() is not None
    figure.legend(
        handles,
        labels,
        loc="outside lower center" if outside else "lower center",
        ncols=columns,
        frameon=False,
        fontsize=9,
    )
