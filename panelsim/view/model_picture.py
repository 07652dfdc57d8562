"""Figure of a case in two models: RMS of each motion side by side, and how far apart they are."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from panelsim.conventions import CONFIDENCE, DOF_NAMES, FloatArray
from panelsim.results.rms_study import RmsStudy
from panelsim.results.rms_tables import display_rms
from panelsim.results.statistics import display_unit
from panelsim.view.plots import COLORS, INK, plain, save


def model_picture(study: RmsStudy, band: FloatArray, path: Path) -> Path | None:
    """Translations and rotations in the two levels of the first sea; below, their difference.

    `band` (6,) is the half width of that of the difference, a share; NaN where it is not known. None where no
    run of either finished.
    """
    if np.isnan(study.pooled[:, 0]).all():
        return None
    figure = Figure(figsize=(10, 6.5), layout="constrained")
    above, below = figure.subplots(2, 2, height_ratios=[3, 2])
    shown, difference = display_rms(study.pooled)[:, 0], 100.0 * study.difference[1, 0]
    for modes, top, bottom in zip((slice(0, 3), slice(3, 6)), above, below, strict=True):
        names, place = DOF_NAMES[modes], np.arange(3)
        for level, shift, color in ((0, -0.2, COLORS[1]), (1, 0.2, COLORS[0])):
            top.bar(place + shift, shown[level, modes], 0.38, color=color, label=study.levels[level])
        top.set_ylabel(f"RMS [{display_unit(names[0])[0]}]", fontsize=9)
        error = np.nan_to_num(100.0 * band[modes])
        bottom.bar(place, np.nan_to_num(difference[modes]), 0.5, color=COLORS[4], alpha=0.75)
        bottom.errorbar(place, np.nan_to_num(difference[modes]), error, fmt="none", ecolor=INK, capsize=4)
        bottom.axhline(0.0, color=INK, linewidth=0.8)
        bottom.set_ylabel("difference [%]", fontsize=9)
        for axis in (top, bottom):
            plain(axis)
            axis.set_xticks(place, names)
    for axis, mode in zip(np.repeat(below, 3), range(6), strict=True):
        if np.isnan(difference[mode]):
            known = not np.isnan(study.pooled[:, 0, mode]).any()
            axis.text(mode % 3, 0.0, "minor" if known else "no figures", ha="center", va="bottom")
    above[0].legend(frameon=False, fontsize=9)
    bars = "" if np.isnan(band).all() else f" (bars: {100.0 * CONFIDENCE:g} % band of the difference)"
    figure.suptitle(f"{study.title}, {study.seas[0].label}{bars}", fontsize=11)
    return save(figure, path)
