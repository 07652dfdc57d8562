"""A picture of a sea: its spectrum as it is and as a ship meets it, its directions, and its surface."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from panelsim.conventions import FloatArray
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.encounter import encounter_energy
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.ship.ship import Ship
from panelsim.view.plots import INK, plain, save

TARGET, REALISED, OVERTAKEN = "#c8443c", "#2a7fb8", "#a98516"
MOST_BANDS = 60
BROAD_BANDS = 24  # where there are more frequencies than that, so that each band has several
SURFACE_POINTS = 201
PEAK_WAVES_SHOWN = 1.25  # to each side of the ship
ENERGY_SHOWN = 0.998


def sea_picture(seaway: Seaway, ship: Ship, speed: float, path: Path) -> Path:
    """Draw the sea that a ship meets at a speed [m/s] into a PNG file."""
    figure = Figure(figsize=(12, 9.5), layout="constrained")
    _draw_spectrum(figure.add_subplot(2, 2, 1), seaway)
    _draw_encounter(figure.add_subplot(2, 2, 2), seaway, speed, ship.gravity)
    polar = figure.add_subplot(2, 2, 3, projection="polar")
    assert isinstance(polar, PolarAxes)
    _draw_directions(polar, seaway)
    _draw_surface(figure.add_subplot(2, 2, 4), seaway, ship, speed)
    figure.suptitle(_title(seaway))
    return save(figure, path)


def _title(seaway: Seaway) -> str:
    waves = seaway.components
    if waves.count == 1:
        theory = "Stokes wave of second order" if waves.second_order else "regular wave"
        period = 2 * np.pi / float(waves.frequency[0])
        return f"{theory}, height {2 * waves.amplitude[0]:.3g} m, period {period:.3g} s"
    height = 4 * np.sqrt(waves.variance)
    return f"{seaway.kind} sea, {waves.count} components, 4 × RMS of the elevation {height:.3g} m"


def _bands(frequency: FloatArray) -> FloatArray:
    """Edges of bands around the frequencies: one each where they are few, else even ones."""
    distinct = np.unique(frequency)
    if len(distinct) == 1:  # several directions of one frequency
        return distinct[0] * np.array([0.98, 1.02])
    if len(distinct) > MOST_BANDS:
        return np.linspace(distinct[0], distinct[-1], BROAD_BANDS + 1)
    middle = 0.5 * (distinct[1:] + distinct[:-1])
    return np.concatenate([[2 * distinct[0] - middle[0]], middle, [2 * distinct[-1] - middle[-1]]])


def _energy_in(bands: FloatArray, frequency: FloatArray, waves: WaveComponents) -> FloatArray:
    return np.histogram(frequency, bins=bands, weights=0.5 * waves.amplitude**2)[0]


def _spectrum_of(seaway: Seaway) -> PointSpectrum | None:
    """The spectrum that a sea was made from, where there is one."""
    return seaway.point_spectrum if isinstance(seaway, RandomSeaway) else None


def _draw_spectrum(axis: Axes, seaway: Seaway) -> None:
    waves, target = seaway.components, _spectrum_of(seaway)
    axis.set_title("Spectrum", fontsize=10)
    if waves.count == 1:
        _draw_one(axis, float(waves.frequency[0]), waves, REALISED, "wave frequency ω [rad/s]")
        return
    bands = _bands(waves.frequency)
    energy = _energy_in(bands, waves.frequency, waves)
    axis.bar(bands[:-1], energy / np.diff(bands), np.diff(bands), align="edge", color=REALISED, alpha=0.45)
    axis.plot([], [], color=REALISED, alpha=0.45, linewidth=7, label="components")
    if target is not None:
        ends = np.clip(bands[[0, -1]], *target.frequency_range)
        omega = np.linspace(ends[0], ends[1], 600)
        axis.plot(omega, target.density(omega), color=TARGET, linewidth=1.5, label="spectrum")
    _label(axis, "wave frequency ω [rad/s]", "S [m² s/rad]")


def _draw_encounter(axis: Axes, seaway: Seaway, speed: float, gravity: float) -> None:
    """Energy by |ω_e|: waves that the ship overtakes beside those that run through it."""
    waves, target = seaway.components, _spectrum_of(seaway)
    encounter = waves.encounter_frequency(speed, gravity)
    axis.set_title(f"As met at {speed:.3g} m/s", fontsize=10)
    if waves.count == 1:
        color = REALISED if encounter[0] >= 0 else OVERTAKEN
        _draw_one(axis, abs(float(encounter[0])), waves, color, "encounter frequency |ω_e| [rad/s]")
        return
    order = np.argsort(np.abs(encounter))
    share = np.cumsum(waves.amplitude[order] ** 2) / (2 * waves.variance)
    highest = np.abs(encounter)[order][np.searchsorted(share, ENERGY_SHOWN)]
    bands = np.linspace(0.0, 1.02 * highest, BROAD_BANDS + 1)
    width = np.diff(bands)
    base = np.zeros(len(width))
    for chosen, color, label in (
        (encounter >= 0, REALISED, "components"),
        (encounter < 0, OVERTAKEN, "overtaken by the ship"),
    ):
        if chosen.any():
            energy = np.histogram(
                np.abs(encounter[chosen]), bands, weights=0.5 * waves.amplitude[chosen] ** 2
            )[0]
            axis.bar(
                bands[:-1], energy / width, width, base, align="edge", color=color, alpha=0.45, label=label
            )
            base += energy / width
    if target is not None and np.ptp(waves.wave_heading) == 0.0:
        energy = encounter_energy(target, bands, speed, float(waves.wave_heading[0]), gravity)
        axis.stairs(energy / width, bands, color=TARGET, linewidth=1.5, label="spectrum")
    _label(axis, "encounter frequency |ω_e| [rad/s]", "S [m² s/rad]")


def _draw_one(axis: Axes, frequency: float, waves: WaveComponents, color: str, label: str) -> None:
    """One wave has an amplitude, not a density."""
    amplitude = float(waves.amplitude[0])
    axis.vlines(frequency, 0.0, amplitude, color=color, linewidth=3)
    axis.plot(frequency, amplitude, "o", color=color)
    axis.set_xlim(0.0, 2.0 * max(frequency, float(waves.frequency[0])))
    axis.set_ylim(0.0, 1.2 * amplitude)
    _label(axis, label, "amplitude [m]")


def _draw_directions(axis: PolarAxes, seaway: Seaway) -> None:
    """Energy by the side of the ship that the waves come from, bow up."""
    waves = seaway.components
    # Clockwise from the bow: head waves (β = π) at 0, waves from port (π/2) at 270°.
    from_bow = np.mod(waves.wave_heading + np.pi, 2 * np.pi)
    axis.set_theta_zero_location("N")
    axis.set_theta_direction(-1)
    headings, owner = np.unique(np.round(from_bow, 6), return_inverse=True)
    energy = np.bincount(owner, 0.5 * waves.amplitude**2)
    width = np.deg2rad(4.0)
    if len(headings) > 1:
        gaps = np.diff(np.concatenate([headings, headings[:1] + 2 * np.pi]))
        width = max(float(gaps.min()), np.deg2rad(1.0))
    axis.bar(headings, energy / energy.max(), width, color=REALISED, alpha=0.45, edgecolor=REALISED)
    if isinstance(seaway, RandomSeaway) and seaway.directional_spectrum is not None:
        side = np.linspace(0.0, 2 * np.pi, 361)
        compass = np.mod(side + seaway.ship_heading, 2 * np.pi)
        density = _over_frequency(seaway.directional_spectrum, compass, waves)
        axis.plot(side, density * width / energy.max(), color=TARGET, linewidth=1.5)
    axis.set_xticks(np.deg2rad([0, 45, 90, 135, 180, 225, 270, 315]))
    axis.set_xticklabels(["bow", "", "starboard", "", "stern", "", "port", ""])
    axis.set_yticklabels([])
    axis.tick_params(colors=INK, labelsize=8, pad=14)
    axis.set_title("Energy by where the waves come from", fontsize=10)


def _over_frequency(
    spectrum: DirectionalSpectrum, sea_direction: FloatArray, waves: WaveComponents
) -> FloatArray:
    """Energy over direction (D,) [m2/rad] between the lowest and the highest component."""
    omega = np.linspace(waves.frequency.min(), waves.frequency.max(), 400)
    return np.trapezoid(spectrum.density(omega[:, None], sea_direction), omega, axis=0)


def _draw_surface(axis: Axes, seaway: Seaway, ship: Ship, speed: float) -> None:
    """The surface at t = 0 around the ship, seen from above, bow up."""
    waves = seaway.components
    strongest = waves.frequency[np.argmax(waves.amplitude)]
    reach = max(PEAK_WAVES_SHOWN * 2 * np.pi * ship.gravity / strongest**2, 0.75 * ship.length)
    line = np.linspace(-reach, reach, SURFACE_POINTS)
    forward, port = np.meshgrid(line, line, indexing="ij")
    view = seaway.in_translating_axes(speed, gravity=ship.gravity)
    elevation = view.elevation(forward, port, 0.0)
    top = np.abs(elevation).max()
    picture = axis.pcolormesh(-line, line, elevation, cmap="RdBu_r", vmin=-top, vmax=top, shading="nearest")
    axis.figure.colorbar(picture, ax=axis, label="elevation [m]", shrink=0.85)
    outline = 0.5 * ship.length * np.array([-1.0, 0.6, 1.0, 0.6, -1.0])
    side = 0.5 * ship.beam * np.array([0.8, 1.0, 0.0, -1.0, -0.8])
    axis.fill(side, outline, facecolor="white", edgecolor=INK, linewidth=1.0)
    mean = np.angle(np.sum(waves.amplitude**2 * np.exp(1j * waves.wave_heading)))
    travel = 0.35 * reach * np.array([np.sin(mean), np.cos(mean)])  # to starboard, forward
    corner = -0.75 * reach * np.array([np.sin(mean), np.cos(mean)])
    axis.annotate("", xy=corner + travel, xytext=corner, arrowprops={"arrowstyle": "-|>", "color": INK})
    axis.set_aspect("equal")
    _label(axis, "to starboard [m]", "forward [m]")
    axis.set_title("Surface at t = 0, the ship in the middle", fontsize=10)


def _label(axis: Axes, x: str, y: str) -> None:
    plain(axis)
    axis.set_xlabel(x)
    axis.set_ylabel(y)
    if axis.get_legend_handles_labels()[0]:
        axis.legend(frameon=False, fontsize=8)
