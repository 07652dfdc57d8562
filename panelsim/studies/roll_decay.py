"""A roll decay of the ship of a case: heeled, let go in calm water, its roll kept."""

from dataclasses import dataclass

import numpy as np

from panelsim.case import Case
from panelsim.conventions import Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.database import Progress as CoefficientProgress
from panelsim.hydro.roll_damping.natural import NaturalRoll, natural_roll
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.march import Progress as RunProgress
from panelsim.motion.simulate import simulate
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.ship import Ship

PERIODS = 10  # of natural roll: what is left after them of a roll with 1 % of critical damping is half of it
HEELS_DEG = (0.1, 60.0)
# Steps a natural period, at least: the fit is then better than its record.
STEPS_A_PERIOD = 40
# What holds the course is this many times faster than the roll, so that it does not show in it.
COURSE_OVER_ROLL = 3.0


@dataclass(frozen=True)
class RollDecayRun:
    """The history of a decay, and the natural roll that the matrices give."""

    history: History
    natural: NaturalRoll


def run_roll_decay(
    case: Case,
    heel: float,
    *,
    on_coefficients: CoefficientProgress | None = None,
    on_run: RunProgress | None = None,
) -> RollDecayRun:
    """Let the ship of a case go at a `heel` [rad], starboard down if above 0, and run ten natural periods.

    Speed, model, stepper and roll damping are those of the case, the time step no longer than 1/40 of the
    natural period. The ship is free to surge and sway, as a model in a tank: springs would have modes of
    their own that show in the roll. She is free to yaw too at rest; under way a stiff spring with critical
    damping holds her course. Raises PanelsimError for a heel that is no release, and for a bad case.
    """
    degrees = float(np.rad2deg(heel))
    if not HEELS_DEG[0] <= abs(degrees) <= HEELS_DEG[1]:
        raise PanelsimError(
            "The heel, to either side, is out of range",
            got=f"{degrees:g} deg",
            allowed=f"{HEELS_DEG[0]:g} to {HEELS_DEG[1]:g} deg, or as much below 0",
        )
    run = case.file.run
    supplementary = case.supplementary
    database = case.database(on_coefficients)
    natural = natural_roll(case.ship, database)
    history = simulate(
        case.ship,
        CalmSeaway(),
        speed=case.speed,
        duration=PERIODS * natural.period,
        time_step=min(run.time_step, natural.period / STEPS_A_PERIOD),
        database=database,
        model=run.model,
        stepper=run.stepper,
        ramp=0.0,
        pressure_method=run.pressure_method,
        pressure_rule=run.pressure_rule,
        supplementary=_free(supplementary, case.ship, database, natural, under_way=case.speed > 0.0),
        roll_damping=case.roll_damping(database),
        initial_displacement=(0.0, 0.0, 0.0, heel, 0.0, 0.0),
        capsize_angle=float(np.deg2rad(run.capsize_angle_deg)),
        progress=on_run,
        case=case.resolved(),
        notes=[f"Roll decay from {np.rad2deg(heel):g} degrees: calm water, springs of the case left out."],
    )
    return RollDecayRun(history, natural)


def _free(
    supplementary: Supplementary,
    ship: Ship,
    database: HydroDatabase,
    natural: NaturalRoll,
    *,
    under_way: bool,
) -> Supplementary:
    """The terms of the case less those that hold the ship in place, with a firm course `under_way`."""
    stiffness, damping = (
        {name: value for name, value in terms.items() if name not in ("surge", "sway", "yaw")}
        for terms in (supplementary.stiffness, supplementary.damping)
    )
    if under_way:
        inertia = float((ship.inertia + database.added_mass_infinite)[Dof.YAW, Dof.YAW])
        frequency = COURSE_OVER_ROLL * natural.frequency
        stiffness["yaw"], damping["yaw"] = inertia * frequency**2, 2.0 * inertia * frequency
    return Supplementary(stiffness, damping)
