"""The band of the RMS of single runs over significant height, from theory and from seeds."""

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.view.plots import COLORS, INK, plain, save


def sampling_picture(
    path: Path,
    heights: FloatArray,
    headings: Mapping[str, tuple[Mapping[str, FloatArray], Mapping[str, FloatArray]]],
) -> Path:
    """Draw bands (S, 6) over heights (S,) [m]: a row a heading, its lines and its markers by label."""
    height = 2.9 * len(headings) + 0.6
    # Margins by hand: of so many panels a layout engine makes most of the time of a page.
    margins = {"left": 0.05, "right": 0.995, "top": 1.0 - 0.35 / height, "bottom": 0.95 / height}
    figure = Figure(figsize=(14, height))
    rows = figure.subplots(
        len(headings), 6, sharex=True, sharey="row", squeeze=False, gridspec_kw=margins | {"wspace": 0.08}
    )
    for axes, (heading, (lines, points)) in zip(rows, headings.items(), strict=True):
        for mode, axis in enumerate(axes):
            plain(axis)
            axis.set_title(DOF_NAMES[mode], fontsize=10, y=1.0)
            for style, color, (label, values) in zip(
                ("-", ":"), (COLORS[0], INK), lines.items(), strict=False
            ):
                axis.plot(heights, 100 * values[:, mode], style, color=color, label=label)
            for marker, color, (label, values) in zip(
                "os", (COLORS[3], COLORS[5]), points.items(), strict=False
            ):
                axis.plot(
                    heights, 100 * values[:, mode], marker, color=color, label=label, markerfacecolor="none"
                )
            axis.set_yscale("log")
        axes[0].set_ylabel(f"{heading}\n95 % band of the RMS [± %]")
    for axis in rows[-1]:
        axis.set_xlabel("significant height [m]")
    figure.legend(
        *rows[0, 0].get_legend_handles_labels(),
        loc="lower center",
        ncols=4,
        frameon=False,
        fontsize=9,
    )
    return save(figure, path)
