"""A batch of runs: what all share, what each has of its own, and the histories that they leave."""

import math
import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.load import Instant, Load
from panelsim.loads.radiation import Radiation
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.history import History
from panelsim.motion.march import Limits, MemberRecord, Progress, march, ramp_factor
from panelsim.motion.notes import run_notes
from panelsim.motion.requirements import about_member, require_step_for_ship, require_step_for_waves
from panelsim.motion.run_loads import run_loads
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.ship.ship import Ship


@dataclass(frozen=True)
class Member:
    """What a run has of its own: its waves, their kind, the speed [m/s], and the seed to remember."""

    waves: WaveComponents
    seaway_kind: str
    speed: float
    seed: int | None


@dataclass(frozen=True)
class Batch:
    """Checked arguments of `simulate_batch`: SI units and radians, `case` as JSON text."""

    ship: Ship
    members: Sequence[Member]
    database: HydroDatabase
    supplementary: Supplementary
    duration: float
    time_step: float
    ramp: float
    model: str
    stretching: str
    pressure_method: str
    pressure_rule: str
    capsize_angle: float
    case: str
    notes: Sequence[str]

    def run(
        self, displacement: FloatArray, velocity: FloatArray, progress: Progress | None
    ) -> tuple[History, ...]:
        """Step all members from displacement and velocity (B, 6) to their ends."""
        begin = clock.process_time()
        loads = self._loads()
        equations = self._equations(loads)
        # The first evaluation compiles the kernel; its time is no part of the time loop.
        equations.evaluate_loads(Instant(0.0, 0.0, displacement, velocity))
        compiled = clock.process_time()
        record = march(
            equations,
            displacement,
            velocity,
            # Whole steps that cover all of it; rounding of the quotient is no step.
            steps=math.ceil((self.ramp + self.duration) / self.time_step - 1e-9),
            time_step=self.time_step,
            ramp=self.ramp,
            limits=Limits(self.capsize_angle, heave=0.5 * self.ship.length, drift=100.0 * self.ship.length),
            progress=progress,
        )
        loop = clock.process_time() - compiled
        runs = [record.of(i) for i in range(len(self.members))]
        rows = sum(run.count for run in runs)
        wetted = [load for load in loads if isinstance(load, WettedSurface)]
        methods = wetted[0].methods if wetted else ("none",) * len(runs)
        return tuple(
            self._history(member, run, method, loop * run.count / rows, (compiled - begin) / len(runs))
            for member, run, method in zip(self.members, runs, methods, strict=True)
        )

    def _loads(self) -> list[Load]:
        """All loads but radiation."""
        return run_loads(
            self.ship,
            [member.waves for member in self.members],
            [member.speed for member in self.members],
            database=self.database,
            model=self.model,
            stretching=self.stretching,
            pressure_method=self.pressure_method,
            pressure_rule=self.pressure_rule,
            supplementary=self.supplementary,
        )

    def _equations(self, loads: Sequence[Load]) -> EquationsOfMotion:
        """The equations of motion of all members; PanelsimError where the time step is too long."""
        ship, members = self.ship, self.members
        radiation = Radiation(self.database, [member.speed for member in members], self.time_step)
        require_step_for_ship(
            self.time_step,
            ship.inertia + radiation.added_mass_infinite,
            ship.hydrostatics.stiffness + self.supplementary.stiffness_matrix,
        )
        for i, member in enumerate(members):
            encounter = member.waves.encounter_frequency(member.speed, ship.gravity)
            with about_member(i, len(members)):
                require_step_for_waves(self.time_step, member.waves, encounter)
        return EquationsOfMotion(ship.inertia, loads, radiation)

    def _history(
        self, member: Member, run: MemberRecord, method: str, cpu_seconds: float, jit_seconds: float
    ) -> History:
        time = np.arange(run.count, dtype=np.float64) * self.time_step
        factor = np.array([ramp_factor(t, self.ramp) for t in time])
        # The twin whatever the length, so that a run is bit for bit the beginning of a longer one.
        sea = TranslatingSeaway(member.waves, member.speed, self.ship.gravity, method="oracle")
        notes = run_notes(
            member.waves,
            self.database,
            self.supplementary,
            speed=member.speed,
            time_step=self.time_step,
            length=self.ramp + self.duration,
            model=self.model,
            seeded=member.seaway_kind in ("random", "dataset"),
        )
        return History.build(
            time=time,
            displacement=run.displacement,
            velocity=run.velocity,
            acceleration=run.acceleration,
            wave_elevation=wave_elevation(sea, time, factor),
            loads=run.loads,
            ship=self.ship,
            components=member.waves,
            seaway_kind=member.seaway_kind,
            stretching=self.stretching,
            speed=member.speed,
            ramp=self.ramp,
            time_step=self.time_step,
            model=self.model,
            pressure_method=method,
            pressure_rule=self.pressure_rule if self.model == "nonlinear" else "none",
            outcome=run.outcome,
            outcome_detail=run.detail,
            case=self.case,
            seed=member.seed,
            cpu_seconds=cpu_seconds,
            jit_seconds=jit_seconds,
            notes=[*self.notes, *notes],
        )


def wave_elevation(sea: TranslatingSeaway, time: FloatArray, wave_factor: FloatArray) -> FloatArray:
    """Elevation (T,) [m] at the moving origin, all amplitudes times `wave_factor` (T,).

    The second order of a Stokes wave, ½ a² k cos 2θ, grows with the square of the factor.
    """
    elevation = sea.elevation(0.0, 0.0, time)
    if not sea.components.second_order:
        return wave_factor * elevation
    linear = replace(sea, components=replace(sea.components, second_order=False))
    first_order = linear.elevation(0.0, 0.0, time)
    return wave_factor * first_order + wave_factor**2 * (elevation - first_order)
