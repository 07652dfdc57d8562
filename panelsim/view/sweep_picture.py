"""Pictures of a sweep: the RMS of the six motions over one key of a case, or around the ship by speed."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from panelsim.conventions import DOF_NAMES, Dof, FloatArray
from panelsim.results.statistics import display_unit
from panelsim.view.plots import COLORS, INK, plain, save

HEADING, SPEED = "seaway.wave_heading_deg", "run.speed_knots"
_STILL = 1e-6  # m or rad: below it is rounding
_FINE = 1.0  # degrees: contours are drawn on so fine a circle, between headings along straight lines
_OPEN = 1.5  # a gap so many times the usual one between headings is a part that was not swept
_ROOM = 1.1  # above the highest point
_HOLE = 0.3  # of the span of speeds: ships at rest are a circle, not a point
_CROSS: dict[str, Any] = {"color": "#d62728", "markersize": 8, "markeredgewidth": 2.0}


def sweep_picture(found: xr.Dataset, path: Path) -> Path | None:
    """Draw a sweep into a PNG file: by heading and speed, or over one key; None where it is neither.

    `found` as `sweep` gives it. Keys with a single value do not count. None too where no run finished.
    """
    if not found["realizations"].any():
        return None
    keys = [key for key in found["realizations"].dims if found.sizes[key] > 1]
    flat = found.squeeze([key for key in found["realizations"].dims if found.sizes[key] == 1])
    if {*keys} == {HEADING, SPEED} and found.sizes[HEADING] > 2:
        return _polar(flat.sortby([HEADING, SPEED]), path)
    return _lines(flat, str(keys[0]), path) if len(keys) == 1 else None


def _lines(found: xr.Dataset, key: str, path: Path) -> Path:
    """RMS over one key, with the band of confidence; points where runs did not finish are marked."""
    figure = Figure(figsize=(11, 6.5), layout="constrained")
    axes = figure.subplots(2, 3, sharex=True).ravel()
    numeric = np.issubdtype(found[key].dtype, np.number)
    if numeric:
        found = found.sortby(key)
    places = found[key].values.astype(float) if numeric else np.arange(float(found.sizes[key]))
    short = _short(found)
    for dof, axis in zip(Dof, axes, strict=True):
        rms, half, unit = _rms(found, dof)
        plain(axis)
        axis.plot(places, rms, "o-" if numeric else "o", color=COLORS[dof + 1], markersize=4)
        axis.errorbar(places, rms, half, fmt="none", ecolor=COLORS[dof + 1], capsize=3, linewidth=1.0)
        _cross(axis, places, rms, short)
        top = float(np.nanmax(rms + np.nan_to_num(half), initial=0.0))
        axis.set_ylim(0.0, _ROOM * top if top > 0.0 else 1.0)
        axis.set_title(f"{DOF_NAMES[dof]}, RMS [{unit}]", fontsize=10)
        if not numeric:
            axis.set_xticks(places, [str(value) for value in found[key].values])
            axis.set_xlim(-0.5, len(places) - 0.5)  # room for the words
    for axis in axes[3:]:
        axis.set_xlabel(_label(found, key), fontsize=9)
    bars = "" if np.isnan(found["rms_half_width"]).all() else "bars: 95 % confidence of the RMS"
    figure.suptitle(_title(found, bars, short), fontsize=11)
    return save(figure, path)


def _cross(axis: Axes, places: FloatArray, rms: FloatArray, short: np.ndarray) -> None:
    """Mark points where runs did not finish: on the RMS of the others, or at the top where there is none."""
    none = short & np.isnan(rms)
    some = short & ~none
    if some.any():
        axis.plot(places[some], rms[some], "x", clip_on=False, zorder=5, **_CROSS)
    if none.any():
        height = np.full(int(none.sum()), 0.97)
        axis.plot(places[none], height, "x", transform=axis.get_xaxis_transform(), zorder=5, **_CROSS)


def _polar(found: xr.Dataset, path: Path) -> Path:
    """RMS by where the waves come from (angle, bow up) and speed (radius): colours, labelled contours."""
    figure = Figure(figsize=(13, 11))
    # By hand: contours on a circle lead the layout engines astray.
    figure.subplots_adjust(left=0.06, right=0.94, bottom=0.03, top=0.85, hspace=0.3, wspace=0.35)
    angle, taken, mirrored = _around(found)
    speeds = found[SPEED].values.astype(float)
    found = found.transpose(HEADING, SPEED, ...)
    short = _short(found)
    places = np.meshgrid(np.deg2rad(angle), speeds, indexing="ij")
    for dof in Dof:
        axis = figure.add_subplot(2, 3, 1 + dof, projection="polar")
        assert isinstance(axis, PolarAxes)
        rms, _, unit = _rms(found, dof)
        _fill(figure, axis, angle, speeds, rms[taken], f"RMS [{unit}]")
        axis.plot(*(place.ravel() for place in places), ".", color=INK, markersize=2.5, clip_on=False)
        marked = short[taken]
        axis.plot(*(place[marked] for place in places), "x", clip_on=False, zorder=5, **_CROSS)
        _dress(axis, speeds)
        axis.set_title(DOF_NAMES[dof], fontsize=11, pad=10)
    sides = "starboard is drawn as the mirror image of port: ship and sea are symmetric" if mirrored else ""
    how = "angle: where the waves come from, 180° head seas; radius: speed [knots]"
    dots = "dots: points of the sweep; between them colours are interpolated along straight lines"
    figure.suptitle(_title(found, "\n".join(filter(None, [how, dots, sides])), short), fontsize=11)
    return save(figure, path)


def _around(found: xr.Dataset) -> tuple[FloatArray, np.ndarray, bool]:
    """Angles (A,) [deg] clockwise from the bow, rising; which heading each is; whether half are mirrored.

    A circle that is all there is closed: its first angle comes again, a turn on. Else they begin after the
    gap, so that nothing is drawn across it.
    """
    headings = np.mod(found[HEADING].values.astype(float), 360.0)
    # β = 180° at the bow, β = 90° from port, which is 270° clockwise.
    angle, taken = np.mod(headings + 180.0, 360.0), np.arange(len(headings))
    mirrored = found.attrs.get("port_starboard_symmetric") == "yes" and bool(np.all(headings <= 180.0))
    if mirrored:
        angle, taken = np.append(angle, np.mod(-angle, 360.0)), np.append(taken, taken)
    angle, first = np.unique(np.round(angle, 6), return_index=True)
    taken = taken[first]
    gaps = np.diff(angle, append=angle[0] + 360.0)
    if gaps.max() <= _OPEN * np.median(gaps):
        return np.append(angle, angle[0] + 360.0), np.append(taken, taken[0]), mirrored
    from_gap = np.roll(np.arange(len(angle)), -1 - np.argmax(gaps))
    angle, taken = angle[from_gap], taken[from_gap]
    return np.where(angle < angle[0], angle + 360.0, angle), taken, mirrored


def _fill(
    figure: Figure, axis: PolarAxes, angle: FloatArray, speeds: FloatArray, rms: FloatArray, label: str
) -> None:
    """Colours and contours of an RMS (A, S), along straight lines between the points."""
    fine = np.linspace(angle[0], angle[-1], 1 + round((angle[-1] - angle[0]) / _FINE))
    values = np.column_stack([np.interp(fine, angle, column) for column in rms.T])
    largest = float(np.nanmax(values, initial=0.0))
    if largest < _STILL:
        axis.text(0.5, 0.5, "nothing moves", transform=axis.transAxes, ha="center", color=INK)
        return
    levels = MaxNLocator(10, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, largest)
    around = np.deg2rad(fine)
    colours = axis.contourf(around, speeds, values.T, levels, cmap="viridis", zorder=0)
    lines = axis.contour(around, speeds, values.T, levels[1:], colors="white", linewidths=0.7, zorder=1)
    axis.clabel(lines, fontsize=7, fmt="%g")
    bar = figure.colorbar(colours, ax=axis, orientation="horizontal", shrink=0.8, pad=0.12, aspect=30)
    bar.set_label(label, fontsize=9)
    bar.ax.tick_params(labelsize=8, colors=INK)


def _dress(axis: PolarAxes, speeds: FloatArray) -> None:
    axis.set_facecolor("#eeeeee")
    axis.set_theta_zero_location("N")
    axis.set_theta_direction(-1)
    axis.set_xticks(np.deg2rad(np.arange(0, 360, 45)))
    axis.set_xticklabels(
        ["180° head", "225°", "270°\nstarboard", "315°", "0° following", "45°", "90°\nport", "135°"],
        fontsize=8,
        color=INK,
    )
    span = float(np.ptp(speeds))
    axis.set_rlim(speeds.min(), speeds.max())
    axis.set_rorigin(speeds.min() - _HOLE * span)
    axis.set_rlabel_position(112.5)
    axis.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    axis.tick_params(axis="x", pad=9)
    axis.tick_params(axis="y", labelsize=7, colors=INK)
    for label in axis.get_yticklabels():
        label.set_bbox({"facecolor": "white", "alpha": 0.6, "linewidth": 0.0, "pad": 0.6})
    axis.grid(color="#bbbbbb", linewidth=0.4)


def _rms(found: xr.Dataset, dof: Dof) -> tuple[FloatArray, FloatArray, str]:
    """RMS of a motion and half its band in the unit that people read, and that unit; rounding is 0."""
    unit, factor = display_unit(DOF_NAMES[dof])
    rms = found["rms"].sel(dof=DOF_NAMES[dof]).values
    half = found["rms_half_width"].sel(dof=DOF_NAMES[dof]).values
    moves = ~(rms < _STILL)
    return factor * np.where(moves, rms, 0.0), factor * np.where(moves, half, 0.0), unit


def _short(found: xr.Dataset) -> np.ndarray:
    """Where some realizations did not finish."""
    return np.asarray(sum(found[name].values for name in ("capsized", "diverged", "failed")) > 0)


def _label(found: xr.Dataset, key: str) -> str:
    unit = found[key].attrs.get("units", "1")
    name = key.rpartition(".")[2].removesuffix("_deg").removesuffix("_knots").replace("_", " ")
    name = "wave heading (0° following, 180° head)" if key == HEADING else name
    return name if unit == "1" else f"{name} [{unit}]"


def _title(found: xr.Dataset, more: str, short: np.ndarray) -> str:
    most = int(found["realizations"].max())
    what = (
        f"{found.attrs['ship']}, {found.attrs['name']}: {most} realization{'s' if most > 1 else ''} a point"
    )
    marks = "✕: some runs capsized, diverged or failed; the RMS is that of the others" if short.any() else ""
    if (found["realizations"].values == 0).any():
        marks += ", or there is none"
    return "\n".join(filter(None, [what, more, marks]))
