"""A batch of runs: what all share, what each has of its own, and the histories that they leave."""

import json
import math
import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from importlib.metadata import version
from typing import Any

import numpy as np
import xarray as xr

from panelsim.conventions import Dof, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.reach import require_waves_held
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.transom import Transom
from panelsim.loads.load import Load
from panelsim.loads.radiation import Radiation
from panelsim.loads.roll_damping import RollDamping, describe_terms
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.motion.equations import EquationsOfMotion, ramp_factor
from panelsim.motion.history import History
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.march import Limits, MemberRecord, Progress, Record, march, require_finite_start
from panelsim.motion.notes import run_notes
from panelsim.motion.point_motions import with_points
from panelsim.motion.requirements import about_member, require_step_for_waves
from panelsim.motion.restart import GOES_ON, digest, restart_group, resumed
from panelsim.motion.run_loads import RunLoads, run_loads
from panelsim.motion.stability import Stability
from panelsim.motion.steppers import make_stepper
from panelsim.motion.waves_met import wave_elevation
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.ship.ship import Ship


@dataclass(frozen=True)
class Member:
    """What a run has of its own: its waves, their kind, the speed [m/s], the seed to remember, roll damping.

    Either all members of a batch have a `roll_damping`, or none has.
    """

    waves: WaveComponents
    seaway_kind: str
    speed: float
    seed: int | None
    roll_damping: RollDampingTerms | None = None


@dataclass(frozen=True)
class Batch:
    """Checked arguments of `simulate_batch`: SI units and radians, `case` as JSON text.

    `points` (3,) [m] of the ship by name, in hull axes.
    With a `transom` no member lies still.
    """

    ship: Ship
    members: Sequence[Member]
    database: HydroDatabase
    supplementary: Supplementary
    transom: Transom | None
    duration: float
    time_step: float
    ramp: float
    model: str
    inertia: str
    stepper: str
    stretching: str
    pressure_method: str
    pressure_rule: str
    capsize_angle: float
    case: str
    notes: Sequence[str]
    points: Mapping[str, FloatArray]

    def run(
        self,
        displacement: FloatArray,
        velocity: FloatArray,
        progress: Progress | None,
        resume: Sequence[History] | None = None,
    ) -> tuple[History, ...]:
        """Step all members from displacement and velocity (B, 6), or from where they were, to their ends."""
        begin = clock.process_time()
        found = self._loads()
        equations = self._equations(found.loads)
        stability = [
            Stability(self.stepper, equations, found.known, i, member.roll_damping)
            for i, member in enumerate(self.members)
        ]
        for i, each in enumerate(stability):
            with about_member(i, len(self.members)):
                each.require(self.time_step)
        stepper = make_stepper(self.stepper, equations, found.known, self.time_step)
        wetted = [load for load in found.loads if isinstance(load, WettedSurface)]
        methods = wetted[0].methods if wetted else ("none",) * len(self.members)
        identities = self._identities(equations, found.known, methods, displacement, velocity)
        kept_identities = [json.dumps(identity, sort_keys=True) for identity in identities]
        # The first evaluation compiles the kernel; its time is no part of the time loop.
        state = stepper.start(displacement, velocity)
        require_finite_start(state)
        # Whole steps that cover all of it; rounding of the quotient is no step.
        steps = math.ceil((self.ramp + self.duration) / self.time_step - 1e-9)
        record = Record(steps + 1, len(self.members), equations.load_names)
        if resume is None:
            record.add(state)
        else:
            state = resumed(resume, identities, record)
        compiled = clock.process_time()
        limits = Limits(self.capsize_angle, heave=0.5 * self.ship.length, drift=100.0 * self.ship.length)
        state = march(
            stepper, state, record, steps=steps, time_step=self.time_step, limits=limits, progress=progress
        )
        loop = clock.process_time() - compiled
        runs = [record.of(i) for i in range(len(self.members))]
        rows = sum(run.count for run in runs)
        before = [float(history.attrs["cpu_seconds"]) for history in resume or ()] or [0.0] * len(runs)
        return tuple(
            self._history(
                self.members[i],
                run,
                methods[i],
                restart_group(state, i, kept_identities[i]) if run.outcome in GOES_ON else None,
                before[i] + loop * run.count / rows,
                (compiled - begin) / len(runs),
                stability[i].notes(self.time_step, run.velocity[:, Dof.ROLL]),
            )
            for i, run in enumerate(runs)
        )

    def _identities(
        self,
        equations: EquationsOfMotion,
        known: KnownLoads,
        methods: Sequence[str],
        displacement: FloatArray,
        velocity: FloatArray,
    ) -> list[dict[str, Any]]:
        """What must be the same in a run that goes on, for each member, by the words for it."""
        ship, radiation = self.ship, equations.radiation
        shared = {
            "version of panelsim": version("panelsim"),
            "ship": digest(ship.vertices, ship.mesh.panels, ship.inertia, np.array(ship.waterline)),
            "water": [ship.water_density, ship.gravity],
            "model": self.model,
            "inertia": self.inertia,
            "stepper": self.stepper,
            "time step": self.time_step,
            "ramp": self.ramp,
            "stretching": self.stretching,
            "pressure rule": self.pressure_rule,
            "capsize angle": self.capsize_angle,
            "choice of transom terms": self.transom is not None,
            "set of supplementary terms": digest(
                self.supplementary.stiffness_matrix, self.supplementary.damping_matrix
            ),
        }
        return [
            shared
            | {
                "speed": member.speed,
                "sea": digest(
                    member.waves.amplitude,
                    member.waves.frequency,
                    member.waves.wave_heading,
                    member.waves.phase,
                    np.array(member.waves.second_order),
                ),
                "pressure method": methods[i],
                "roll damping": None if member.roll_damping is None else [*astuple(member.roll_damping)],
                "initial displacement": displacement[i].tolist(),
                "initial velocity": velocity[i].tolist(),
                # Last: it goes with the ship, the sea and the speed, whose names say more.
                "set of coefficients": digest(
                    self.database.added_mass,
                    self.database.radiation_damping,
                    radiation.load_matrix[i],
                    radiation.memory_matrix[i],
                    known.turning[i],
                    known.amplitudes[i],
                ),
            }
            for i, member in enumerate(self.members)
        ]

    def _loads(self) -> RunLoads:
        """All loads but radiation."""
        damping = [member.roll_damping for member in self.members if member.roll_damping is not None]
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
            roll_damping=RollDamping(damping) if damping else None,
            transom=self.transom,
        )

    def _equations(self, loads: Sequence[Load]) -> EquationsOfMotion:
        """The equations of motion of all members; PanelsimError where step or coefficients do not suffice."""
        ship, members = self.ship, self.members
        radiation = Radiation(self.database, [member.speed for member in members], self.transom)
        for i, member in enumerate(members):
            encounter = member.waves.encounter_frequency(member.speed, ship.gravity)
            with about_member(i, len(members)):
                require_step_for_waves(self.time_step, member.waves, encounter)
                require_waves_held(self.database, member.waves)
        return EquationsOfMotion(
            ship.inertia, loads, radiation, self.ramp, large_angles=self.inertia == "large"
        )

    def _history(
        self,
        member: Member,
        run: MemberRecord,
        method: str,
        restart: xr.Dataset | None,
        cpu_seconds: float,
        jit_seconds: float,
        notes: Sequence[str],
    ) -> History:
        time = np.arange(run.count, dtype=np.float64) * self.time_step
        factor = np.array([ramp_factor(t, self.ramp) for t in time])
        # The twin whatever the length, so that a run is bit for bit the beginning of a longer one.
        sea = TranslatingSeaway(member.waves, member.speed, self.ship.gravity, method="oracle")
        more = run_notes(
            member.waves,
            self.database,
            self.supplementary,
            speed=member.speed,
            time_step=self.time_step,
            stepper=self.stepper,
            length=self.ramp + self.duration,
            model=self.model,
            seeded=member.seaway_kind in ("random", "dataset"),
        )
        history = History.build(
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
            notes=[*self.notes, *more, *notes],
            stepper=self.stepper,
            restart=restart,
            roll_damping=_roll_damping(member),
            coefficients=str(self.database.dataset.attrs.get("solver", "not recorded")),
            inertia=self.inertia,
            transom_terms=self.transom is not None,
        )
        return with_points(history, self.points)


def _roll_damping(member: Member) -> str:
    return "none" if member.roll_damping is None else describe_terms(member.roll_damping)
