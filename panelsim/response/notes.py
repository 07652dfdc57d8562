"""What a reader of a response should know: the reach of its coefficients, and what nothing holds."""

import numpy as np
import xarray as xr

from panelsim.conventions import Dof, FloatArray
from panelsim.hydro.tabulated_diffraction import SPEED_NOTE
from panelsim.hydro.transom import TRANSOM_NOTE
from panelsim.response.linear_ship import LinearShip, MotionsInWaves
from panelsim.response.sea_waves import SeaWaves

_WHOLE = 0.99  # share of the energy of a sea that needs no word


def response_notes(linear_ship: LinearShip, motions: MotionsInWaves, speeds: FloatArray) -> list[str]:
    """Sentences on a table of transfer functions; none where all is well."""
    notes = list(linear_ship.database.notes)
    if speeds.any() and not linear_ship.database.has_potentials:
        notes.append(SPEED_NOTE)
    if speeds.any() and linear_ship.transom is not None:
        notes.append(TRANSOM_NOTE)
    highest = linear_ship.database.frequencies[-1]
    beyond = np.abs(motions.encounter) > highest
    if beyond.any():
        notes.append(
            f"{beyond.sum()} of {beyond.size} waves meet the ship at up to"
            f" {np.abs(motions.encounter).max():.2f} rad/s, beyond the {highest:.2f} rad/s that the"
            " coefficients resolve; there added mass tends to its limit as 1/ω² and damping to 0 as 1/ω."
        )
    return notes + _course_note(linear_ship, float(speeds.max()))


def sea_notes(
    linear_ship: LinearShip, motions: MotionsInWaves, waves: SeaWaves, found: xr.Dataset
) -> list[str]:
    """Sentences on statistics in a sea: energy beyond the coefficients, drift that has no bound."""
    beyond = np.abs(motions.encounter) > linear_ship.database.frequencies[-1]
    shares = [
        float(variance[far[index]].sum() / variance.sum())
        for far in beyond
        for index, variance in waves.courses
    ]
    notes = []
    if waves.energy_share < _WHOLE:
        notes.append(
            f"{100 * (1.0 - waves.energy_share):.2g} % of the energy of the sea is left out: the diffraction"
            f" tables reach {waves.frequency.min():.3g} to {waves.frequency.max():.3g} rad/s at its headings."
        )
    if max(shares) > 0.0:
        notes.append(
            f"Up to {100 * max(shares):.2g} % of the wave energy meets the ship faster than the"
            f" {linear_ship.database.frequencies[-1]:.2f} rad/s that the coefficients resolve."
        )
    drifting = np.isnan(found["rms"].values).any(axis=(0, 1))
    if drifting.any():
        names = ", ".join(str(name) for name in found["signal"].values[drifting])
        notes.append(
            f"No value for {names} where waves stand still beside the ship: nothing holds her there, and she"
            " drifts without bound. Supplementary stiffness in surge and sway gives one."
        )
    return notes


def _course_note(linear_ship: LinearShip, speed: float) -> list[str]:
    """Say where nothing holds the ship on her course: the Munk moment U² A22(0) per radian turns her."""
    munk = speed**2 * float(linear_ship.database.added_mass_zero[Dof.SWAY, Dof.SWAY])
    if munk == 0.0 or linear_ship.stiffness[Dof.YAW, Dof.YAW] > munk:
        return []
    return [
        f"No supplementary yaw stiffness over {munk:.2g} N m/rad holds the ship on her course: the Munk"
        " moment turns her broadside, and what is given for waves is not what she would do."
    ]
