"""A run, or a batch of runs: from a ship and a sea to a history."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.transom import TRANSOM_NOTE, Transom
from panelsim.loads.arguments import require_seaway
from panelsim.loads.roll_damping import require_linear_terms
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.batch import Batch, Member
from panelsim.motion.history import History
from panelsim.motion.march import Progress
from panelsim.motion.requirements import (
    about_member,
    case_text,
    is_iterable,
    require_run,
    require_seed,
    require_speed,
    require_types,
    sequence_of,
    six_numbers_each,
)
from panelsim.seaway.seaways import Seaway
from panelsim.ship.points import points_of_ship
from panelsim.ship.ship import Ship


def simulate(
    ship: Ship,
    seaway: Seaway,
    *,
    speed: float,
    duration: float,
    time_step: float,
    database: HydroDatabase,
    model: str = "nonlinear",
    inertia: str | None = None,
    stepper: str = "exponential",
    ramp: float = 60.0,
    stretching: str = "wheeler",
    pressure_method: str = "auto",
    pressure_rule: str = "vertex+centre",
    supplementary: Supplementary | None = None,
    roll_damping: RollDampingTerms | None = None,
    transom: Transom | None = None,
    initial_displacement: Sequence[float] | FloatArray = (0.0,) * 6,
    initial_velocity: Sequence[float] | FloatArray = (0.0,) * 6,
    capsize_angle: float = np.pi / 2,
    progress: Progress | None = None,
    case: Mapping[str, Any] | None = None,
    seed: int | None = None,
    notes: Sequence[str] = (),
    resume: History | None = None,
    points: Mapping[str, ArrayLike] | None = None,
) -> History:
    """Run the ship through the sea and keep every motion and every load.

    `speed` [m/s]; `duration` [s] after a `ramp` [s] over which the waves grow by ½(1 − cos(π t/ramp));
    `time_step` [s]; `model` "nonlinear" integrates the pressure over the instantaneous wetted
    surface, "linear" takes restoring and Froude-Krylov load about rest; radiation and diffraction are
    linear in both. `inertia` "large" turns with the ship and has the gyroscopic terms, "linear" is that of
    small angles; by default each model has its own, and the linear model has no other. `pressure_method`
    and `pressure_rule` are `method` and `rule` of `pressure_force`: how the waves are summed over the
    wetted surface, and where on a panel. `stepper` is "exponential" (one evaluation of the loads a step),
    "rk4" (four, the reference) or "ab3" (one). `roll_damping` is that of viscosity and lift, beside any that
    `supplementary` has; the linear model takes linear terms only. With a `transom`, the end terms of
    Salvesen, Tuck and Faltinsen (1970) in radiation and diffraction, none at zero speed. The ship is held at
    `initial_displacement` (6,) [m, rad] until t = 0.

    The run ends early where |roll| exceeds `capsize_angle` [rad] (0 = never), where the motion
    diverges, or on an interrupt; `History.outcome` says which. `progress(done, total)` is told the
    seconds now and then. `case`, `seed` and `notes` are kept in the history. `resume` is the history of the
    beginning of this very run, finished earlier or interrupted: it goes on there, and the history
    is, bit for bit, that of the whole run. `points` are (3,) [m] of the ship in hull axes, by name; what each
    does is in `History.points`, as `point_motions` finds it.

    Raises PanelsimError for bad arguments, for a database of another ship and a history of another run.
    """
    (history,) = simulate_batch(
        ship,
        [seaway],
        speed=[speed],
        duration=duration,
        time_step=time_step,
        database=database,
        model=model,
        inertia=inertia,
        stepper=stepper,
        ramp=ramp,
        stretching=stretching,
        pressure_method=pressure_method,
        pressure_rule=pressure_rule,
        supplementary=supplementary,
        roll_damping=None if roll_damping is None else [roll_damping],
        transom=transom,
        initial_displacement=[initial_displacement],
        initial_velocity=[initial_velocity],
        capsize_angle=capsize_angle,
        progress=progress,
        case=case,
        seeds=[seed],
        notes=notes,
        resume=None if resume is None else [resume],
        points=points,
    )
    return history


def simulate_batch(
    ship: Ship,
    seaways: Sequence[Seaway],
    *,
    speed: float | Sequence[float] | FloatArray,
    duration: float,
    time_step: float,
    database: HydroDatabase,
    model: str = "nonlinear",
    inertia: str | None = None,
    stepper: str = "exponential",
    ramp: float = 60.0,
    stretching: str = "wheeler",
    pressure_method: str = "auto",
    pressure_rule: str = "vertex+centre",
    supplementary: Supplementary | None = None,
    roll_damping: RollDampingTerms | Sequence[RollDampingTerms] | None = None,
    transom: Transom | None = None,
    initial_displacement: ArrayLike | Sequence[ArrayLike] = (0.0,) * 6,
    initial_velocity: ArrayLike | Sequence[ArrayLike] = (0.0,) * 6,
    capsize_angle: float = np.pi / 2,
    progress: Progress | None = None,
    case: Mapping[str, Any] | None = None,
    seeds: Sequence[int | None] | None = None,
    notes: Sequence[str] = (),
    resume: Sequence[History] | None = None,
    points: Mapping[str, ArrayLike] | None = None,
) -> tuple[History, ...]:
    """Run the ship through many seas at once, and keep every motion and every load of each run.

    Each history is that of `simulate` in the same sea, bit for bit; together they take less time. The seas
    may differ in all: kind, phases, heading, number of waves. Arguments as for `simulate`, but that `speed`
    [m/s] may be one for each seaway, and so may `roll_damping`; `initial_displacement` and
    `initial_velocity` may be (6,) or (B, 6), and `seeds` has one for each seaway. With a `transom` either all
    ships are under way or none is. A run that ends early
    leaves the others as they are; an interrupt ends all, and all are kept. `cpu_seconds` and `jit_seconds`
    of a history are a share of those of the batch: of the time loop by the steps of the run, of compilation
    and set-up an equal one. `resume` has one history for each seaway, all cut at the same time.

    Raises PanelsimError for bad arguments, with the number of the member, and for a database of another ship.
    """
    require_types(ship, database, supplementary, notes, progress)
    kept_case = case_text(case)
    members = _members(seaways, speed, seeds, roll_damping, model)
    require_run(
        members=len(members),
        duration=duration,
        time_step=time_step,
        ramp=ramp,
        capsize_angle=capsize_angle,
        model=model,
        inertia=inertia,
        stepper=stepper,
        stretching=stretching,
        pressure_method=pressure_method,
        pressure_rule=pressure_rule,
    )
    database.require_for(ship)
    start = (
        six_numbers_each("initial_displacement", initial_displacement, len(members), angles=True),
        six_numbers_each("initial_velocity", initial_velocity, len(members), angles=False),
    )
    transom = _transom_under_way(transom, ship, [member.speed for member in members])
    batch = Batch(
        ship=ship,
        members=members,
        database=database,
        supplementary=Supplementary() if supplementary is None else supplementary,
        transom=transom,
        duration=float(duration),
        time_step=float(time_step),
        ramp=float(ramp),
        model=model,
        inertia=inertia or ("large" if model == "nonlinear" else "linear"),
        stepper=stepper,
        stretching=stretching,
        pressure_method=pressure_method,
        pressure_rule=pressure_rule,
        capsize_angle=float(capsize_angle),
        case=kept_case,
        notes=notes if transom is None else [*notes, TRANSOM_NOTE],
        points=points_of_ship(points, ship.center_of_gravity, ship.vertices),
    )
    return batch.run(*start, progress, _histories(resume, len(members)))


def _transom_under_way(transom: object, ship: Ship, speeds: Sequence[float]) -> Transom | None:
    """The checked transom, or None where no ship moves: so that such a run is, bit for bit, one without."""
    if transom is None:
        return None
    if not isinstance(transom, Transom):
        raise PanelsimError(
            "The transom is of another kind", got=repr(transom)[:60], allowed="a Transom, or None"
        )
    transom.require_for(ship)
    moving = sum(speed > 0.0 for speed in speeds)
    if 0 < moving < len(speeds):
        raise PanelsimError(
            "A batch with transom terms has ships at rest beside ships under way",
            got=f"{len(speeds) - moving} of {len(speeds)} at rest",
            allowed="all at rest, or none",
            remedy="run the ships at rest in a batch of their own",
        )
    return transom if moving else None


def _histories(resume: object, members: int) -> list[History] | None:
    """Checked histories to go on from, one for each member."""
    if resume is None:
        return None
    histories = sequence_of("histories to go on from", resume, members)
    for i, history in enumerate(histories):
        with about_member(i, members):
            if not isinstance(history, History):
                raise PanelsimError(
                    "The run to go on from is no history", got=repr(history)[:60], allowed="a History"
                )
    return histories


def _members(seaways: object, speed: object, seeds: object, roll_damping: object, model: str) -> list[Member]:
    """Checked seaways with their speeds [m/s], seeds and roll damping."""
    seas = sequence_of("seaways", seaways)
    count = len(seas)
    speeds = sequence_of(
        "speeds", speed if is_iterable(speed) and not isinstance(speed, str) else [speed] * count, count
    )
    listed_seeds = sequence_of("seeds", [None] * count if seeds is None else seeds, count)
    dampings = sequence_of(
        "roll dampings", roll_damping if is_iterable(roll_damping) else [roll_damping] * count, count
    )
    members = []
    for i, (sea, own_speed, seed, damping) in enumerate(
        zip(seas, speeds, listed_seeds, dampings, strict=True)
    ):
        with about_member(i, count):
            require_seaway(sea)
            require_speed(own_speed)
            require_seed(seed)
            if damping is not None or roll_damping is not None:
                _require_roll_damping(damping, model)
        members.append(Member(sea.components, sea.kind, float(own_speed), seed, damping))
    return members


def _require_roll_damping(damping: object, model: str) -> None:
    if not isinstance(damping, RollDampingTerms):
        raise PanelsimError(
            "The roll damping is of another kind", got=repr(damping)[:60], allowed="RollDampingTerms, or None"
        )
    if model == "linear":
        require_linear_terms(damping)
