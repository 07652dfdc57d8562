"""A run: from a ship and a sea to a history."""

import json
import math
import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
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
from panelsim.motion.notes import run_notes
from panelsim.motion.requirements import require_run, require_time_step, require_types, six_numbers
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.translating import TranslatingSeaway
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
    require_types(ship, database, supplementary, notes)
    require_run(
        speed=speed,
        duration=duration,
        time_step=time_step,
        ramp=ramp,
        capsize_angle=capsize_angle,
        model=model,
        stretching=stretching,
    )
    database.require_for(ship)
    start = (
        six_numbers("initial_displacement", initial_displacement),
        six_numbers("initial_velocity", initial_velocity),
    )
    components = seaway.components
    before = clock.process_time()
    loads = _pressure_loads(ship, components, speed, model, stretching)
    loads.append(_diffraction(ship, components, speed, database, follows_ship=model == "nonlinear"))
    supplementary = Supplementary() if supplementary is None else supplementary
    loads.append(supplementary)
    radiation = Radiation(database, speed, time_step)
    require_time_step(
        time_step,
        ship.inertia + radiation.added_mass_infinite,
        ship.hydrostatics.stiffness + supplementary.stiffness_matrix,
        components,
        components.encounter_frequency(speed, ship.gravity),
    )
    equations = EquationsOfMotion(ship.inertia, loads, radiation)
    # The first evaluation compiles the kernel; its time is no part of the time loop.
    for load in loads:
        load.evaluate(Instant(0.0, 0.0, *start))
    compiled = clock.process_time()
    record = march(
        equations,
        *start,
        # Whole steps that cover all of it; rounding of the quotient is no step.
        steps=math.ceil((ramp + duration) / time_step - 1e-9),
        time_step=time_step,
        ramp=ramp,
        limits=Limits(capsize_angle, heave=0.5 * ship.length, drift=100.0 * ship.length),
        progress=progress,
    )
    loop = clock.process_time() - compiled
    time = np.arange(record.count, dtype=np.float64) * time_step
    # The twin whatever the length, so that a run is bit for bit the beginning of a longer one.
    sea = TranslatingSeaway(components, speed, ship.gravity, method="oracle")
    displacement, velocity, acceleration = record.motions
    return History.build(
        time=time,
        displacement=displacement,
        velocity=velocity,
        acceleration=acceleration,
        wave_elevation=_wave_elevation(sea, time, np.array([ramp_factor(t, ramp) for t in time])),
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
            *run_notes(
                components,
                database,
                supplementary,
                speed=speed,
                time_step=time_step,
                length=ramp + duration,
                model=model,
                seeded=seaway.kind in ("random", "dataset"),
            ),
        ],
    )


def _wave_elevation(sea: TranslatingSeaway, time: FloatArray, wave_factor: FloatArray) -> FloatArray:
    """Elevation (T,) [m] at the moving origin, all amplitudes times `wave_factor` (T,).

    The second order of a Stokes wave, ½ a² k cos 2θ, grows with the square of the factor.
    """
    elevation = sea.elevation(0.0, 0.0, time)
    if not sea.components.second_order:
        return wave_factor * elevation
    linear = replace(sea, components=replace(sea.components, second_order=False))
    first_order = linear.elevation(0.0, 0.0, time)
    return wave_factor * first_order + wave_factor**2 * (elevation - first_order)


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
        speed=speed,
        gravity=ship.gravity,
        follows_ship=False,
    )
    return [Restoring(ship.hydrostatics.stiffness), incident]


def _diffraction(
    ship: Ship, components: WaveComponents, speed: float, database: HydroDatabase, *, follows_ship: bool
) -> LinearWaveLoad:
    return LinearWaveLoad(
        "diffraction",
        diffraction_load(database, components.frequency, components.wave_heading, speed),
        components,
        speed=speed,
        gravity=ship.gravity,
        follows_ship=follows_ship,
    )
