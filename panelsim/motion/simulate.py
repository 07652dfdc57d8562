"""A run: from a ship and a sea to a history."""

import json
import time as clock
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import beyond_resolution, diffraction_load
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.linear_waves import LinearWaveLoad
from panelsim.loads.load import Instant, Load
from panelsim.loads.radiation import Radiation
from panelsim.loads.restoring import Restoring
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.weight import Weight
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.history import History
from panelsim.motion.march import Limits, Progress, march, ramp_factor
from panelsim.seaway.components import WaveComponents, repeat_time
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.ship.ship import Ship

MODELS = ("nonlinear", "linear")


def simulate(
    ship: Ship,
    seaway: Seaway,
    *,
    speed: float,
    duration: float,
    time_step: float,
    database: HydroDatabase,
    model: str = "nonlinear",
    ramp: float = 60.0,
    stretching: str = "wheeler",
    supplementary: Supplementary | None = None,
    initial_displacement: Sequence[float] | FloatArray = (0.0,) * 6,
    initial_velocity: Sequence[float] | FloatArray = (0.0,) * 6,
    capsize_angle: float = np.pi / 2,
    progress: Progress | None = None,
    case: Mapping[str, Any] | None = None,
    seed: int | None = None,
    notes: Sequence[str] = (),
) -> History:
    """Run the ship through the sea and keep every motion and every load.

    `speed` [m/s]; `duration` [s] after a `ramp` [s] over which the waves grow by ½(1 − cos(π t/ramp));
    `time_step` [s]; `model` "nonlinear" integrates the pressure over the instantaneous wetted
    surface, "linear" takes restoring and Froude-Krylov load about rest; radiation and diffraction are
    linear in both. The ship is held at `initial_displacement` (6,) [m, rad] until t = 0.

    The run ends early where |roll| exceeds `capsize_angle` [rad] (0 = never), where the motion
    diverges, or on an interrupt; `History.outcome` says which. `progress(done, total)` is told the
    seconds now and then. `case`, `seed` and `notes` are kept in the history.

    Raises PanelsimError for bad arguments and for a database of another ship.
    """
    _require_run(speed, duration, time_step, ramp, capsize_angle, model)
    database.require_for(ship)
    start = _six("initial_displacement", initial_displacement), _six("initial_velocity", initial_velocity)
    components = seaway.components
    before = clock.process_time()
    loads = _pressure_loads(ship, components, speed, model, stretching)
    loads.append(_diffraction(ship, components, speed, database))
    supplementary = Supplementary() if supplementary is None else supplementary
    loads.append(supplementary)
    equations = EquationsOfMotion(ship.inertia, loads, Radiation(database, speed, time_step))
    # The first evaluation compiles the kernel; its time is no part of the time loop.
    for load in loads:
        load.evaluate(Instant(0.0, 0.0, *start))
    compiled = clock.process_time()
    record = march(
        equations,
        *start,
        steps=round((ramp + duration) / time_step),
        time_step=time_step,
        ramp=ramp,
        limits=Limits(capsize_angle, heave=0.5 * ship.length, drift=100.0 * ship.length),
        progress=progress,
    )
    loop = clock.process_time() - compiled
    time = np.arange(record.count, dtype=np.float64) * time_step
    waves = TranslatingSeaway(components, speed, ship.gravity).elevation(0.0, 0.0, time)
    displacement, velocity, acceleration = record.motions
    return History.build(
        time=time,
        displacement=displacement,
        velocity=velocity,
        acceleration=acceleration,
        wave_elevation=waves * np.array([ramp_factor(t, ramp) for t in time]),
        loads=record.loads,
        ship=ship,
        components=components,
        seaway_kind=seaway.kind,
        stretching=stretching,
        speed=speed,
        ramp=ramp,
        time_step=time_step,
        model=model,
        outcome=record.outcome,
        outcome_detail=record.detail,
        case=json.dumps(case or {}, ensure_ascii=False, sort_keys=True),
        seed=seed,
        cpu_seconds=loop,
        jit_seconds=compiled - before,
        notes=[
            *notes,
            *_notes(components, speed, ramp + duration, database, ship.gravity),
            *_course_note(speed, database, supplementary),
        ],
    )


def _pressure_loads(
    ship: Ship, components: WaveComponents, speed: float, model: str, stretching: str
) -> list[Load]:
    if model == "nonlinear":
        wetted = WettedSurface(ship, components, speed, stretching=stretching)
        return [Weight(ship.mass, ship.gravity), wetted]
    incident = LinearWaveLoad(
        "froude_krylov",
        froude_krylov_transfer(ship, components),
        components,
        components.encounter_frequency(speed, ship.gravity),
    )
    return [Restoring(ship.hydrostatics.stiffness), incident]


def _diffraction(
    ship: Ship, components: WaveComponents, speed: float, database: HydroDatabase
) -> LinearWaveLoad:
    return LinearWaveLoad(
        "diffraction",
        diffraction_load(database, components.frequency, components.wave_heading, speed),
        components,
        components.encounter_frequency(speed, ship.gravity),
    )


def _notes(
    components: WaveComponents, speed: float, length: float, database: HydroDatabase, gravity: float
) -> list[str]:
    """What a reader of the results should know of the sea and of the reach of the coefficients."""
    notes = []
    if components.count:
        beyond = beyond_resolution(database, components.frequency, components.wave_heading, speed)
        energy = components.amplitude**2
        share = float(energy[beyond].sum() / energy.sum())
        highest = float(np.abs(components.encounter_frequency(speed, gravity)).max())
        limit = float(database.frequencies[np.isfinite(database.frequencies)].max())
        if beyond.any():
            notes.append(
                f"{beyond.sum()} of {components.count} wave components, with {100 * share:.2g} % of the wave"
                f" energy, meet the ship at up to {highest:.2f} rad/s, beyond the {limit:.2f} rad/s that the"
                " panels of the coefficients resolve; there the diffraction potential tends"
                " to its infinite-frequency limit as 1/ω², and radiation follows A∞ and the damping's tail."
            )
    again = repeat_time(components, speed, length, gravity=gravity)
    if again is not None:
        notes.append(
            f"The ship meets nearly the same waves again every {again:.0f} s (evenly spaced frequencies):"
            " a longer run adds little to its statistics."
        )
    return notes


def _course_note(speed: float, database: HydroDatabase, supplementary: Supplementary) -> list[str]:
    """Say where nothing holds the ship on its course: the Munk moment U² A22(0) per radian turns it."""
    munk = speed**2 * float(database.added_mass_zero[Dof.SWAY, Dof.SWAY])
    if supplementary.stiffness_matrix[Dof.YAW, Dof.YAW] > munk or munk == 0.0:
        return []
    return [
        f"No supplementary yaw stiffness over {munk:.2g} N m/rad holds the ship on its course: at this speed"
        " a bare hull turns broadside by itself (Munk moment)."
    ]


def _require_run(
    speed: float, duration: float, time_step: float, ramp: float, capsize_angle: float, model: str
) -> None:
    """Refuse what cannot be run."""
    if model not in MODELS:
        raise PanelsimError("Unknown model", got=model, allowed=" | ".join(MODELS))
    bounds = {
        "speed": (speed, 0.0, 50.0, "m/s"),
        "time_step": (time_step, 1e-4, 5.0, "s"),
        "duration": (duration, time_step, 1e6, "s"),
        "ramp": (ramp, 0.0, 1e5, "s"),
        "capsize_angle": (capsize_angle, 0.0, np.pi, "rad"),
    }
    for name, (value, low, high, unit) in bounds.items():
        if not low <= value <= high:
            raise PanelsimError(
                f"The {name} is out of range", got=f"{value:g} {unit}", allowed=f"{low:g} to {high:g} {unit}"
            )


def _six(name: str, values: Sequence[float] | FloatArray) -> FloatArray:
    array = np.array(values, dtype=float)
    if array.shape != (6,) or not np.isfinite(array).all():
        raise PanelsimError(f"The {name} is not six finite numbers", got=values)
    return array
