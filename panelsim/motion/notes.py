"""What a reader of the results should know of a run: its sea, its step, the reach of its coefficients."""

import numpy as np

from panelsim.conventions import Dof
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import beyond_resolution
from panelsim.hydro.tabulated_diffraction import SPEED_NOTE
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.requirements import ENERGY_THAT_COUNTS, energy_share
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.repeat import repeat_time, variance_scatter

# Encounter frequency times time step above which a scheme follows a wave no better than within some per cent
# (reports/steppers.md).
COARSE_STEP = {"exponential": 2.0, "rk4": 1.0, "ab3": 0.5}
# Scatter of the RMS of the waves from one choice of phases to another, above which one run says little.
MUCH_SCATTER = 0.15
# Over ten times the length the scatter of a sea falls to a third; that of waves that beat stays.
STAYS = 0.7


def run_notes(
    components: WaveComponents,
    database: HydroDatabase,
    supplementary: Supplementary,
    *,
    speed: float,
    time_step: float,
    stepper: str,
    length: float,
    model: str,
    seeded: bool = True,
) -> list[str]:
    """Sentences on a run of `length` [s] at `speed` [m/s] with `time_step` [s] of a scheme; none where all
    is well.

    `seeded` where the phases are a choice of chance, not those of a record.
    """
    notes = [*database.notes]
    if speed and not database.has_potentials:
        notes.append(SPEED_NOTE)
    if components.second_order and model == "linear":
        notes.append(
            "The linear model takes the first order of the Stokes waves; their second order shows in the"
            " elevation only."
        )
    if components.count:
        notes += _resolution_note(components, database, speed)
        notes += _step_note(components, speed, time_step, stepper, database.gravity)
    again = repeat_time(components, speed, length, gravity=database.gravity)
    if again is not None:
        notes.append(
            f"The ship meets nearly the same waves again every {again:.0f} s (evenly spaced frequencies):"
            " a longer run adds little to its statistics."
        )
    if seeded:
        notes += _scatter_note(components, speed, length, database.gravity)
    return notes + _course_note(database, supplementary, speed)


def _resolution_note(components: WaveComponents, database: HydroDatabase, speed: float) -> list[str]:
    """Waves met faster than the coefficients reach, and what is done about them."""
    beyond = beyond_resolution(database, components.frequency, components.wave_heading, speed)
    if not beyond.any():
        return []
    diffraction = "diffraction" if database.has_potentials else "the scaling of diffraction"
    highest = np.abs(components.encounter_frequency(speed, database.gravity)).max()
    return [
        f"{beyond.sum()} of {components.count} wave components, with"
        f" {100 * energy_share(components, beyond):.2g} % of the wave energy, meet the ship at up to"
        f" {highest:.2f} rad/s, beyond the {database.frequencies[-1]:.2f} rad/s that the"
        f" coefficients reach; there {diffraction} tends to its infinite-frequency limit as 1/ω², and"
        " radiation follows A∞ and the damping's tail."
    ]


def _step_note(
    components: WaveComponents, speed: float, time_step: float, stepper: str, gravity: float
) -> list[str]:
    """Waves that a coarse step of the scheme follows badly."""
    coarse = COARSE_STEP[stepper]
    encounter = np.abs(components.encounter_frequency(speed, gravity))
    share = energy_share(components, encounter * time_step > coarse)
    if share <= ENERGY_THAT_COUNTS:
        return []
    steps = 2 * np.pi / coarse
    return [
        f"{100 * share:.0f} % of the wave energy meets the ship with fewer than {steps:.2g} time steps a"
        f" period: motions from it are off by several per cent; a step of {coarse / encounter.max():.2g} s"
        " follows all of it."
    ]


def _scatter_note(components: WaveComponents, speed: float, length: float, gravity: float) -> list[str]:
    """Say where one run is no measure of the sea: too short, or with waves that beat for hours."""
    if components.count < 2:
        return []
    scatter = variance_scatter(components, speed, length, gravity=gravity)
    if scatter / 2 < MUCH_SCATTER:
        return []
    longer = variance_scatter(components, speed, 10 * length, gravity=gravity)
    remedy = (
        "waves meet the ship at nearly the same frequency and beat for hours, so that a longer run does not"
        " help: take several seeds, or more frequencies, jittered"
        if longer > STAYS * scatter
        else "take several seeds, or a longer run"
    )
    return [
        f"With other phases the RMS of the waves in a run of this length would be another one, by"
        f" {50 * scatter:.0f} % (one standard deviation): {remedy}."
    ]


def _course_note(database: HydroDatabase, supplementary: Supplementary, speed: float) -> list[str]:
    """Say where nothing holds the ship on its course: the Munk moment U² A22(0) per radian turns it."""
    munk = speed**2 * float(database.added_mass_zero[Dof.SWAY, Dof.SWAY])
    if supplementary.stiffness_matrix[Dof.YAW, Dof.YAW] > munk or munk == 0.0:
        return []
    return [
        f"No supplementary yaw stiffness over {munk:.2g} N m/rad holds the ship on its course: at this speed"
        " a bare hull turns broadside by itself (Munk moment)."
    ]
