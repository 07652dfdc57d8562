"""A picture of righting arms: the curves, with the rise and the trim of the ship below."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from panelsim.ship.righting_arms import RightingArms
from panelsim.view.plots import INK, plain, save

COLORS = ("#333333", "#2a7fb8", "#c8443c", "#d9822b", "#4b8f46")
TANGENT = 0.35  # rad, as far as it is drawn


def righting_picture(curves: Sequence[RightingArms], title: str, path: Path) -> Path:
    """Draw up to five curves of righting arms into a PNG file."""
    figure = Figure(figsize=(9, 7.5), layout="constrained")
    figure.suptitle(title)
    axes = figure.subplot_mosaic([["arm", "arm"], ["heave", "trim"]], height_ratios=[2.2, 1.0])
    for curve, color in zip(curves, COLORS, strict=False):
        heel = np.degrees(curve.heel)
        _draw_arms(axes["arm"], curve, color)
        axes["heave"].plot(heel, curve.heave, color=color, linewidth=1.3)
        axes["trim"].plot(heel, np.degrees(curve.trim), color=color, linewidth=1.3)
    labels = {"arm": "righting arm GZ [m]", "heave": "rise of the CG [m]", "trim": "trim, bow down [deg]"}
    for name, axis in axes.items():
        plain(axis)
        axis.set_ylabel(labels[name])
        axis.axhline(0.0, color=INK, linewidth=0.8)
        axis.set_xlabel("heel [deg]")
        low, high = np.degrees(curves[0].heel[[0, -1]])
        axis.set_xlim(low, high)
        if high - low >= 120.0:
            axis.set_xticks(np.arange(low, high + 1.0, 30.0))
    axes["arm"].legend(fontsize=9, frameon=False)
    return save(figure, path)


def _draw_arms(axis: Axes, curve: RightingArms, color: str) -> None:
    """One curve, its tangent at zero heel, its greatest arm and where it vanishes."""
    end = "" if curve.vanishing_heel is None else f", vanishes at {np.degrees(curve.vanishing_heel):.0f}°"
    axis.plot(
        np.degrees(curve.heel),
        curve.arm,
        color=color,
        linewidth=1.6,
        label=f"{curve.water}: GM {curve.gm:#.3g} m, greatest {curve.greatest_arm:#.3g} m{end}",
    )
    axis.plot(
        [0.0, np.degrees(TANGENT)], [0.0, TANGENT * curve.gm], color=color, linewidth=0.9, linestyle="--"
    )
    axis.plot(np.degrees(curve.greatest_arm_heel), curve.greatest_arm, "o", color=color, markersize=5)
    if curve.vanishing_heel is not None:
        axis.plot(np.degrees(curve.vanishing_heel), 0.0, "s", color=color, markersize=5)
