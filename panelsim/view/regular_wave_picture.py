"""Heave and pitch in regular waves over wave length, as TM 2003-190 figures 18 and 19 have them."""

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from panelsim.conventions import FloatArray
from panelsim.view.plots import COLORS, INK, plain, save

_LINES = (
    {"color": INK, "linestyle": ":"},
    {"color": COLORS[0], "linestyle": "--"},
    {"color": COLORS[4], "linestyle": "-"},
)
_MARKERS = "o^svD"
_LABELS = ("heave amplitude / wave amplitude", "pitch amplitude / wave slope")


def regular_wave_picture(
    path: Path,
    title: str,
    length_ratio: FloatArray,
    lines: Mapping[str, FloatArray],
    points: Mapping[str, FloatArray],
) -> Path:
    """Draw heave and pitch over λ/L: up to three lines and up to five kinds of marker, (R, 2) by label."""
    figure = Figure(figsize=(11, 4.8), layout="constrained")
    axes = figure.subplots(1, 2)
    for mode, axis in enumerate(axes):
        plain(axis)
        for style, (label, values) in zip(_LINES, lines.items(), strict=False):
            axis.plot(length_ratio, values[:, mode], label=label, linewidth=1.5, **style)
        for i, (label, values) in enumerate(points.items()):
            axis.plot(
                length_ratio,
                values[:, mode],
                label=label,
                linestyle="none",
                marker=_MARKERS[i],
                markersize=5.0,
                markerfacecolor="none",
                color=COLORS[(3, 5, 2, 6, 1)[i]],
            )
        axis.set_ylim(bottom=0.0)
        axis.set_xlabel("wave length over ship length, λ/L")
        axis.set_ylabel(_LABELS[mode])
    figure.suptitle(title, fontsize=11)
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False, fontsize=9
    )
    return save(figure, path)
