"""Figures of a run: its motions in time, their spectra, and what the loads amount to."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.files import replacing
from panelsim.motion.history import History
from panelsim.results.statistics import display_unit
from panelsim.view.frames import liveliest_window

# The wave, then surge to yaw: the same colour in every figure.
COLORS = ("#2a7fb8", "#7a7a7a", "#8e5ea2", "#d9822b", "#c8443c", "#4b8f46", "#a98516")
DETAIL_SECONDS = 120.0
# Welch segments of about ten wave periods: longer ones would show the single components of the sea.
SEGMENT_SECONDS = 100.0
INK = "#333333"


def plot_motions(history: History, path: Path) -> Path:
    """The waves and the six motions: the whole run, and its liveliest two minutes."""
    figure = Figure(figsize=(12, 11), layout="constrained")
    axes = figure.subplots(7, 2, sharex="col", sharey="row", width_ratios=[3, 2])
    window = liveliest_window(history, DETAIL_SECONDS)
    ramp = history.attrs["ramp"]
    for row, (label, values, color) in enumerate(_signals(history)):
        for axis, width in zip(axes[row], (0.7, 1.3), strict=True):
            plain(axis)
            axis.plot(history.time, values, color=color, linewidth=width)
        axes[row, 0].set_ylabel(label)
        axes[row, 0].axvspan(*window, color=INK, alpha=0.08, linewidth=0)
        if ramp > 0.0:
            axes[row, 0].axvline(ramp, color=INK, linewidth=0.8, linestyle=":")
    axes[0, 0].set_title("whole run (dotted: end of the ramp; shaded: the part on the right)", fontsize=10)
    axes[0, 1].set_title("around the steepest slope of the deck", fontsize=10)
    if window[1] > window[0]:
        axes[0, 0].set_xlim(history.time[0], history.time[-1])
        axes[0, 1].set_xlim(*window)
    for axis in axes[-1]:
        axis.set_xlabel("time [s]")
    return save(figure, path)


def plot_spectra(history: History, path: Path) -> Path:
    """Spectral densities of the waves and the motions over encounter frequency, by Welch's method."""
    from scipy.signal import welch  # 0.3 s, which pictures of other things should not pay

    figure = Figure(figsize=(12, 6), layout="constrained")
    axes = figure.subplots(2, 4, sharex=True).ravel()
    rows = history.finite & (history.time >= history.attrs["ramp"])
    step = float(history.attrs["time_step"])
    for axis, (label, values, color) in zip(axes, _signals(history), strict=False):
        plain(axis)
        unit = label[label.index("[") + 1 : -1]
        axis.set_title(label[: label.index(" [")], fontsize=10)
        axis.set_ylabel(f"[{unit}² s/rad]")
        signal = values[rows]
        if len(signal) >= 8:
            count = min(len(signal), round(SEGMENT_SECONDS / step))
            frequency, density = welch(signal, fs=2.0 * np.pi / step, nperseg=count, detrend="linear")
            axis.fill_between(frequency, density, color=color, alpha=0.25, linewidth=0)
            axis.plot(frequency, density, color=color, linewidth=1.3)
    axes[0].set_xlim(0.0, min(1.5 * _highest_frequency(history), np.pi / step))
    for axis in axes[:7]:
        axis.set_ylim(bottom=0.0)
    for axis in axes[3:7]:
        axis.set_xlabel("encounter frequency [rad/s]")
        axis.tick_params(labelbottom=True)
    axes[7].set_visible(False)
    return save(figure, path)


def plot_loads(history: History, path: Path) -> Path:
    """RMS of every load about its mean, by motion: which of them carry the ship and which hardly count."""
    figure = Figure(figsize=(12, 5.5), layout="constrained")
    axes = figure.subplots(2, 3, sharey=True)
    rows = history.finite & (history.time >= history.attrs["ramp"])
    loads = history.loads
    names = [name.replace("_", " ") for name in loads]
    for dof, axis in enumerate(axes.ravel()):
        plain(axis)
        rms = [1e-6 * values[rows, dof].std() if rows.any() else 0.0 for values in loads.values()]
        bars = axis.barh(names, rms, color=COLORS[dof + 1], height=0.65)
        # what is below a millionth of the largest is round-off
        figures = [f"{value:.3g}" if value > 1e-6 * max(rms) else "" for value in rms]
        axis.bar_label(bars, figures, padding=3, fontsize=8)
        axis.set_title(DOF_NAMES[dof], fontsize=10)
        axis.set_xlabel(f"RMS about the mean [{'MN' if dof < 3 else 'MN m'}]")
        axis.margins(x=0.15)
        axis.set_xlim(left=0.0)
        axis.grid(axis="y", visible=False)
    axes[0, 0].invert_yaxis()
    return save(figure, path)


def _highest_frequency(history: History) -> float:
    """Encounter frequency [rad/s] below which 98 % of the wave energy is met; 1 in calm water."""
    waves = history.components
    if not waves.count:
        return 1.0
    frequency = np.abs(waves.encounter_frequency(history.attrs["speed"], float(history.loading["gravity"])))
    order = np.argsort(frequency)
    share = np.cumsum(waves.amplitude[order] ** 2) / (2.0 * waves.variance)
    return float(frequency[order][np.searchsorted(share, 0.98)])


def _signals(history: History) -> list[tuple[str, FloatArray, str]]:
    """Label with unit, values in that unit, and colour of the waves and the six motions."""
    signals = [
        ("wave elevation", history.wave_elevation),
        *zip(DOF_NAMES, history.displacement.T, strict=True),
    ]
    labelled = []
    for (name, values), color in zip(signals, COLORS, strict=True):
        unit, factor = display_unit(name)
        labelled.append((f"{name} [{unit}]", factor * values, color))
    return labelled


def plain(axis: Axes) -> None:
    """Thin lines, no frame on the right and on top."""
    axis.grid(color="#dddddd", linewidth=0.6)
    axis.set_axisbelow(True)
    axis.spines[["top", "right"]].set_visible(False)
    axis.tick_params(colors=INK, labelsize=8)


def save(figure: Figure, path: Path) -> Path:
    with replacing(path) as beside:
        figure.savefig(beside, dpi=110)
    return path
