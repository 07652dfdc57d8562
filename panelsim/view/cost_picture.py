"""Figure of what runs cost: CPU over simulated time, over the components of the sea and over the panels."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from panelsim.conventions import FloatArray
from panelsim.view.plots import COLORS, plain, save

# By title of the panel, then by name of the line: sizes (N,), and CPU over simulated seconds (N, R) by round.
Lines = Mapping[str, Mapping[str, tuple[FloatArray, FloatArray]]]


def cost_picture(lines: Lines, path: Path) -> Path:
    """A panel for each thing that is varied, on logarithmic axes: medians, bars from quickest to slowest."""
    figure = Figure(figsize=(5.5 * len(lines), 4.6), layout="constrained")
    axes = figure.subplots(1, len(lines), sharey=True, squeeze=False)[0]
    for axis, (title, of_panel) in zip(axes, lines.items(), strict=True):
        plain(axis)
        for name, color, marker in zip(of_panel, (COLORS[1], COLORS[0]), "os", strict=False):
            size, cost = of_panel[name]
            middle = np.median(cost, axis=1)
            reach = np.abs(np.array([cost.min(axis=1), cost.max(axis=1)]) - middle)
            axis.errorbar(
                size, middle, reach, color=color, marker=marker, capsize=3, linewidth=1.3, label=name
            )
        axis.set_xscale("log")
        axis.set_yscale("log")
        sizes = np.unique(np.concatenate([size for size, _ in of_panel.values()]))
        axis.set_xticks(sizes, [f"{size:g}" for size in sizes], fontsize=8)
        axis.set_xticks([], minor=True)
        axis.set_xlabel(title, fontsize=9)
        axis.legend(frameon=False, fontsize=9)
    axes[0].set_ylabel("CPU seconds a simulated second", fontsize=9)
    return save(figure, path)
