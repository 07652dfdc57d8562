"""Pictures of a response: amplitude and phase over wave frequency, and the RMS around the ship by speed."""

from pathlib import Path

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from panelsim.conventions import DOF_NAMES, KNOT, Dof, FloatArray
from panelsim.response.response import Response
from panelsim.results.statistics import display_unit
from panelsim.seaway.dispersion import wavenumber
from panelsim.view.plots import COLORS, INK, plain, save

MOST_HEADINGS = 5
# Of the largest amplitude of a motion: below it a phase says nothing, and would tangle the picture.
_LEAST = 0.03
_STILL = 1e-6  # m/m or rad/rad, m or rad: below it is rounding
# A peak is a spike, which would hide the rest, if it is so many times what one amplitude in twenty exceeds:
# surge and sway without damping where waves pass slowly, not the roll of a ship with bilge keels.
_SPIKE, _USUAL = 4.0, 0.95
_ROOM = 1.05  # above the largest value
_HEADINGS = "wave heading\n(0° following,\n180° head)"


def transfer_picture(table: Response, own_heading: float, speed: float, path: Path) -> Path:
    """Draw amplitude and phase of the six motions at the speed [m/s] nearest to this into a PNG file.

    For up to five headings, among them the one nearest to `own_heading` [rad], drawn thick. Rotations are
    divided by the wave slope k; the phase is the lead over the crest at the centre of gravity. A spike of a
    motion that nothing damps is cut off, and the axis says how high it is.
    """
    figure = Figure(figsize=(13, 9), layout="constrained")
    axes = figure.subplots(4, 3, sharex=True)
    i = int(np.argmin(np.abs(table.speeds - speed)))
    own = int(np.argmin(np.abs(np.angle(np.exp(1j * (table.wave_headings - own_heading))))))
    chosen = np.unique(
        np.append(np.linspace(0, len(table.wave_headings) - 1, MOST_HEADINGS).astype(int), own)
    )
    slope = wavenumber(table.wave_frequencies, table.linear_ship.ship.gravity)
    for dof in Dof:
        amplitude, phase = axes[2 * (dof // 3), dof % 3], axes[2 * (dof // 3) + 1, dof % 3]
        motions = table.transfer[i, chosen, :, dof] / (1.0 if dof < Dof.ROLL else slope)
        motions = np.where(np.abs(motions) < _STILL, 0.0, motions)
        unit = "m/m" if dof < Dof.ROLL else "rad/rad"
        top = _limit_amplitude(amplitude, np.abs(motions), unit)
        least = max(_STILL, _LEAST * top)
        for n, (j, values) in enumerate(zip(chosen, motions, strict=True)):
            width = 2.2 if j == own else 1.0
            label = f"{np.rad2deg(table.wave_headings[j]):.4g}°"
            color = COLORS[n % len(COLORS)]
            amplitude.plot(table.wave_frequencies, np.abs(values), color=color, linewidth=width, label=label)
            _phase_line(phase, table.wave_frequencies, values, least, color, width)
        _label(amplitude, f"{DOF_NAMES[dof]} [{unit}]")
        _label(phase, "phase lead [deg]")
        phase.set_ylim(-180, 180)
        phase.set_yticks([-180, -90, 0, 90, 180])
    for axis in axes[-1]:
        axis.set_xlabel("wave frequency ω [rad/s]", fontsize=9)
    figure.legend(
        *axes[0, 0].get_legend_handles_labels(),
        loc="outside right upper",
        fontsize=8,
        title=_HEADINGS,
    )
    figure.suptitle(
        f"{table.dataset.attrs['ship']} at {table.speeds[i] / KNOT:.3g} knots, per wave amplitude"
        f" and slope; no phase below {100 * _LEAST:g} % of the largest amplitude shown"
    )
    return save(figure, path)


def _limit_amplitude(axis: Axes, amplitude: FloatArray, unit: str) -> float:
    """Set the axis of an amplitude (H, F), which leaves out a spike and says so; returns where it ends."""
    largest = float(amplitude.max())
    usual = _SPIKE * float(np.quantile(amplitude, _USUAL))
    top = usual if 0.0 < _ROOM * usual < largest else largest
    axis.set_ylim(0.0, _ROOM * top or 1.0)
    if top < largest:
        axis.set_title(f"cut off: a spike of {largest:.3g} {unit}", fontsize=8)
    return top


def _phase_line(
    axis: Axes, omega: FloatArray, values: np.ndarray, least: float, color: str, width: float
) -> None:
    """Phase in degrees, broken where it jumps by a turn and left out where the amplitude is below `least`."""
    phase = np.rad2deg(np.angle(values))
    phase[np.abs(values) < least] = np.nan
    jumps = np.flatnonzero(np.abs(np.diff(phase)) > 180.0) + 1
    axis.plot(np.insert(omega, jumps, np.nan), np.insert(phase, jumps, np.nan), color=color, linewidth=width)


def _label(axis: Axes, text: str) -> None:
    plain(axis)
    axis.set_ylabel(text, fontsize=9)


def polar_picture(in_sea: xr.Dataset, path: Path) -> Path:
    """Draw the RMS of the six motions by where the waves come from, bow up, a curve for every speed.

    `in_sea` as `Response.in_sea` gives it by wave heading; its attribute `sea` says in words which sea it is.
    Headings of one side only are drawn on both, as a symmetric ship has them.
    """
    figure = Figure(figsize=(13, 9), layout="constrained")
    headings = np.mod(in_sea["wave_heading"].values, 2.0 * np.pi)
    shades = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, in_sea.sizes["speed"]))
    for dof in Dof:
        axis = figure.add_subplot(2, 3, 1 + dof, projection="polar")
        assert isinstance(axis, PolarAxes)
        unit, factor = display_unit(DOF_NAMES[dof])
        for speed, color in zip(in_sea["speed"].values, shades, strict=True):
            rms = factor * in_sea["rms"].sel(speed=speed, signal=DOF_NAMES[dof]).values
            angle, radius = _around(headings, np.where(rms < factor * _STILL, 0.0, rms))
            label = f"{speed / KNOT:.3g} knots"
            axis.plot(angle, radius, ".-", color=color, label=label, linewidth=1.4, clip_on=False)
        # Clockwise from the bow: head waves (β = π) at 0, waves from port (π/2) at 270°.
        axis.set_theta_zero_location("N")
        axis.set_theta_direction(-1)
        axis.set_xticks(np.deg2rad([0, 90, 180, 270]))
        axis.set_xticklabels(["bow", "starboard", "stern", "port"])
        largest = factor * float(in_sea["rms"].sel(signal=DOF_NAMES[dof]).fillna(0.0).max())
        axis.set_ylim(0.0, _ROOM * largest if largest >= factor * _STILL else 1.0)
        axis.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
        axis.tick_params(colors=INK, labelsize=8)
        axis.tick_params(axis="x", pad=10)
        axis.grid(color="#dddddd", linewidth=0.6)
        axis.set_title(f"{DOF_NAMES[dof]}, RMS [{unit}]", fontsize=10)
    figure.axes[2].legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(0.95, 1.1))
    what = [str(in_sea.attrs[name]) for name in ("ship", "sea") if name in in_sea.attrs]
    figure.suptitle("\n".join([", ".join(what), "RMS by where the waves come from"]).strip())
    return save(figure, path)


def _around(headings: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Angles clockwise from the bow, rising, and values there; a circle where there is one."""
    # β = π at the bow, β = π/2 from port, which is 270° clockwise.
    angle = np.mod(headings + np.pi, 2.0 * np.pi)
    if np.all(headings <= np.pi + 1e-9):
        angle, values = np.append(angle, np.mod(-angle, 2.0 * np.pi)), np.append(values, values)
    angle, first = np.unique(np.round(angle, 9), return_index=True)
    values = values[first]
    if len(angle) > 2:
        angle, values = np.append(angle, angle[0] + 2.0 * np.pi), np.append(values, values[0])
    return angle, values
