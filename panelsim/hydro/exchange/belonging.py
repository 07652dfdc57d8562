"""Whether coefficients of another program are those of this ship, in its axes and signs.

Nothing in such a file names the ship, and a wrong time factor, length scale or direction gives numbers as
smooth as the right ones. What the file and the hull both know is therefore compared: water, flotation,
waterplane, volume, and the load of the incident wave, which changes with every one of those mistakes.
"""

import numpy as np

from panelsim.conventions import DOF_NAMES, ComplexArray, Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.exchange.foreign import ForeignCoefficients
from panelsim.seaway.dispersion import wavenumber
from panelsim.ship.ship import Ship

_SAME_WATER = 1e-3  # 9.81 for 9.80665 m/s2 passes, fresh for salt water does not
_SAME_VOLUME, _SAME_WATERPLANE = 0.02, 0.02  # coarse panels lose a per cent of either
_SAME_POINT = 5e-3  # of the length, for the centres of gravity and of flotation
_DEEP = 0.99  # tanh kh, with which the wavenumber of finite depth is that of deep water within a per cent
# One point a panel, on panels of 10 m2, changes the Froude-Krylov roll moment of a frigate about its CG by 17
# %, every other load by 1 %. A wrong sign changes one by 200 %, a wrong length scale by as much as it is
# wrong.
_SAME_INCIDENT = 0.25
_NO_LOAD = 0.01  # of the largest: the yaw of a ship with two ends alike is rounding
_LONG_WAVE = 2.0  # ship lengths
_REMEDY = "look at forward, moments_about, center_of_gravity, the length scale and the loading of the ship"


def require_belonging(foreign: ForeignCoefficients, ship: Ship) -> None:
    """Refuse a file in other water, on another draft, or with another volume or waterplane than the ship's.

    Raises PanelsimError with both values.
    """
    _require_same(foreign, "water density", foreign.water_density, ship.water_density, _SAME_WATER, "kg/m3")
    _require_same(foreign, "gravity", foreign.gravity, ship.gravity, _SAME_WATER, "m/s2")
    _require_deep(foreign, ship.gravity)
    above_water, allowed = -ship.waterline, _SAME_POINT * ship.length
    height, side = foreign.frame.center_of_gravity[2], foreign.frame.center_of_gravity[1]
    if abs(height - above_water) > allowed or abs(side - ship.center_of_gravity[1]) > allowed:
        raise PanelsimError(
            "The centre of gravity in the axes of the file is not where the ship has it",
            got=f"{foreign.source}: y {side:.4g} m, {height:.4g} m above calm water",
            allowed=f"y {ship.center_of_gravity[1]:.4g} m, {above_water:.4g} m, to {allowed:.2g} m",
            remedy="give center_of_gravity=(x, y, z) in the axes of the file, z from calm water",
        )
    volume = ship.hydrostatics.displaced_volume
    _require_same(foreign, "displaced volume", foreign.displaced_volume, volume, _SAME_VOLUME, "m3")
    if foreign.stiffness is not None:
        _require_waterplane(foreign, foreign.stiffness, ship)


def require_same_incident(source: str, theirs: ComplexArray, ours: ComplexArray) -> None:
    """Refuse Froude-Krylov loads (W, H, 6) more than 25 % (root mean square) off ours.

    Both about the CG in ship axes. Raises PanelsimError with the worst motion, its ratio and its phase.
    """
    size = np.sqrt(np.mean(np.abs(ours) ** 2, axis=(0, 1)))
    size = np.maximum(size, _NO_LOAD * np.repeat([size[:3].max(), size[3:].max()], 3))
    error = np.sqrt(np.mean(np.abs(theirs - ours) ** 2, axis=(0, 1))) / size
    if error.max() > _SAME_INCIDENT:
        dof = int(error.argmax())
        ratio = np.vdot(ours[..., dof], theirs[..., dof]) / np.vdot(ours[..., dof], ours[..., dof])
        raise PanelsimError(
            f"The Froude-Krylov load of the file is not that of this hull in {DOF_NAMES[dof]}",
            got=f"{source}: {100 * error[dof]:.0f} % off (root mean square), in all {abs(ratio):.3g} times"
            f" ours, {np.degrees(np.angle(ratio)):.0f}° ahead",
            allowed=f"{100 * _SAME_INCIDENT:.0f} %",
            remedy=_REMEDY,
        )


def require_same_long_waves(
    source: str, excitation: ComplexArray, ours: ComplexArray, frequency: FloatArray, ship: Ship
) -> None:
    """Refuse excitation (W, H, 6) that in long waves does not push with the Froude-Krylov load (W, H, 6).

    In waves much longer than the ship the sum is the incident part plus an added mass in phase with it:
    surge, sway, heave and pitch go the same way. Roll and yaw may not: they hang on the height of the CG.
    Raises PanelsimError, also where no wave of the file is twice as long as the ship.
    """
    length = 2 * np.pi / wavenumber(frequency[0], ship.gravity)
    if length < _LONG_WAVE * ship.length:
        longest = np.sqrt(2 * np.pi * ship.gravity / (_LONG_WAVE * ship.length))
        raise PanelsimError(
            "No wave of the file is long beside the ship: nothing tells whether its signs and units are ours",
            got=f"{source}: a longest wave of {length:.4g} m, {frequency[0]:.4g} rad/s",
            allowed=f"{longest:.3g} rad/s or less",
            remedy="compute longer waves too, or give the Froude-Krylov load beside the sum",
        )
    for dof in (Dof.HEAVE, Dof.SURGE, Dof.SWAY, Dof.PITCH):
        theirs, own = excitation[0, :, dof], ours[0, :, dof]
        if np.abs(own).max() < 1e-6 * np.abs(ours[0]).max():
            continue
        along = np.vdot(own, theirs) / np.vdot(own, own)
        if along.real < 0.5 or along.real > 3.0 or abs(along.imag) > along.real:
            raise PanelsimError(
                f"The load of long waves in the file does not go with this hull in {DOF_NAMES[dof]}",
                got=f"{source}: at {frequency[0]:.4g} rad/s {abs(along):.3g} times the Froude-Krylov load,"
                f" {np.degrees(np.angle(along)):.0f}° ahead",
                allowed="0.5 to 3 times, within 45°",
                remedy=_REMEDY,
            )


def _require_same(
    foreign: ForeignCoefficients, name: str, theirs: float | None, ours: float, allowed: float, unit: str
) -> None:
    if theirs is not None and not abs(theirs - ours) <= allowed * ours:
        raise PanelsimError(
            f"The {name} of the file is not that of {'the ship' if name != 'gravity' else 'this run'}",
            got=f"{foreign.source}: {theirs:.6g} {unit}",
            allowed=f"{ours:.6g} {unit}, to {100 * allowed:g} %",
            remedy="load the ship as it was there, or compute the file for this loading",
        )


def _require_deep(foreign: ForeignCoefficients, gravity: float) -> None:
    depth = foreign.water_depth
    if not depth > 0.0:
        raise PanelsimError("The water depth of the file is not positive", got=f"{foreign.source}: {depth} m")
    shortest = min(foreign.frequency[0], foreign.wave_frequency[0])
    if np.isfinite(depth) and np.tanh(wavenumber(shortest, gravity) * depth) < _DEEP:
        raise PanelsimError(
            "The file was computed in water that is not deep for its longest waves",
            got=f"{foreign.source}: {depth:.4g} m at {shortest:.4g} rad/s",
            allowed="half the longest wave length or more, or infinite depth",
            remedy="leave out the lowest frequencies, or compute it in deep water",
        )


def _require_waterplane(foreign: ForeignCoefficients, stiffness: FloatArray, ship: Ship) -> None:
    theirs, ours = foreign.frame.matrix(stiffness), ship.hydrostatics.stiffness
    specific = ship.water_density * ship.gravity
    area = ours[Dof.HEAVE, Dof.HEAVE]
    _require_same(
        foreign,
        "waterplane area",
        theirs[Dof.HEAVE, Dof.HEAVE] / specific,
        area / specific,
        _SAME_WATERPLANE,
        "m2",
    )
    flotation = [-c[Dof.HEAVE, Dof.PITCH] / c[Dof.HEAVE, Dof.HEAVE] for c in (theirs, ours)]
    if abs(flotation[0] - flotation[1]) > _SAME_POINT * ship.length:
        raise PanelsimError(
            "The centre of flotation of the file is not that of the ship",
            got=f"{foreign.source}: {flotation[0]:.4g} m ahead of the CG",
            allowed=f"{flotation[1]:.4g} m, to {_SAME_POINT * ship.length:.2g} m",
            remedy=_REMEDY,
        )
