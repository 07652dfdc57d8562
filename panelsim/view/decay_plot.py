"""Figure of a roll decay: the record and the fitted roll over it."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from panelsim.hydro.roll_damping.decay import RollDecay
from panelsim.results.decay_record import DecayRecord
from panelsim.view.plots import COLORS, INK, plain, save


def plot_roll_decay(record: DecayRecord, fit: RollDecay, path: Path) -> Path:
    """The record by its name with its fit, and what is left between them, in degrees; returns the path."""
    figure = Figure(figsize=(10, 6), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    color = COLORS[4]
    above.plot(record.time, np.rad2deg(record.roll), ".", color=INK, markersize=3, label="record")
    above.plot(record.time, np.rad2deg(fit.fitted), color=color, linewidth=1.3, label="fit")
    below.plot(record.time, np.rad2deg(record.roll - fit.fitted), color=INK, linewidth=0.8)
    above.set_title(
        f"{record.name}\nperiod {fit.period:.4g} s, damping ratio {100.0 * fit.damping_ratio:.3g} %,"
        f" quadratic {fit.quadratic:.3g} 1/rad",
        fontsize=10,
    )
    above.set_ylabel("roll [deg]")
    below.set_ylabel("record − fit [deg]")
    below.set_xlabel("time [s]")
    above.legend(frameon=False, fontsize=9)
    for axis in (above, below):
        plain(axis)
    return save(figure, path)
