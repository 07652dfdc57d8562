"""The time loop: from the state at rest to the end of the run, or to whatever ends it before."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.loads.load import Instant
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.requirements import about_member
from panelsim.motion.steppers import Rates, rk4_step

# Pitch near 90° is where yaw-pitch-roll angles cease to mean anything; no ship comes back from 60°.
PITCH_LIMIT = np.deg2rad(60.0)
# Radiation, diffraction and the speed terms are those of a ship near her mean course.
YAW_LIMIT = np.deg2rad(60.0)
# Steps that can follow a ship as she capsizes see less of a turn at a time: this is an unstable scheme.
FASTEST_CAPSIZE = np.deg2rad(45.0)

STEPS_BETWEEN_PROGRESS = 25

Progress = Callable[[float, float], None]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True)
class Limits:
    """Where a run ends early: |roll| [rad] (0 = never), |heave| [m] and drift [m]."""

    capsize_angle: float
    heave: float
    drift: float

    @cached_property
    def safe(self) -> FloatArray:
        """Motions (6,) within which no limit is exceeded, told without a closer look."""
        roll = self.capsize_angle or np.inf
        return np.array([0.5 * self.drift, 0.5 * self.drift, self.heave, roll, PITCH_LIMIT, YAW_LIMIT])

    def exceeded(self, displacement: FloatArray, before: FloatArray) -> tuple[str, str] | None:
        """Outcome and cause, or None while the ship is within all limits; `before` is a step earlier."""
        heave, roll, pitch, yaw = (float(displacement[dof]) for dof in list(Dof)[Dof.HEAVE :])
        drift = float(np.hypot(*displacement[:2]))
        # Before the roll: a motion that grows without bound passes all limits in the same step.
        if abs(pitch) > PITCH_LIMIT:
            return "diverged", f"pitch {np.rad2deg(pitch):.4g}°, limit 60°"
        if abs(heave) > self.heave:
            return "diverged", f"heave {heave:.4g} m, limit {self.heave:g} m"
        if drift > self.drift:
            return "diverged", f"drift {drift:.4g} m, limit {self.drift:g} m"
        if 0 < self.capsize_angle < abs(roll):
            limit = np.rad2deg(self.capsize_angle)
            turned = abs(roll - before[Dof.ROLL])
            outcome = "capsized" if turned < FASTEST_CAPSIZE else "diverged"
            return outcome, f"roll {np.rad2deg(roll):.4g}°, limit {limit:g}°"
        if abs(yaw) > YAW_LIMIT:
            return "diverged", f"broached: yaw {np.rad2deg(yaw):.4g}°, limit 60°"
        return None


def finite_rows(*values: FloatArray) -> BoolArray | None:
    """Which members (B,) of arrays (B, ...) have finite numbers only; None where all have."""
    # An infinite number, or none, makes a sum of squares so; it takes half the time of looking at each.
    if all([math.isfinite(np.vdot(value, value)) for value in values]):
        return None
    rows = [np.isfinite(value).all(axis=tuple(range(1, value.ndim))) for value in values]
    return np.logical_and.reduce(rows)


class Record:
    """Columns of a batch of runs, filled step by step; what is filled stays when a run is cut short."""

    def __init__(self, size: int, members: int, load_names: tuple[str, ...]) -> None:
        self.load_names = load_names
        self.count = 0
        self.running = np.ones(members, dtype=bool)
        self._ends = [(0, "", "")] * members
        self._columns = [np.empty((size, members, 6)) for _ in range(3)]
        self._loads = np.empty((size, members, len(load_names), 6))

    def add(
        self, displacement: FloatArray, velocity: FloatArray, acceleration: FloatArray, loads: FloatArray
    ) -> None:
        """Keep one instant."""
        for column, value in zip(self._columns, (displacement, velocity, acceleration), strict=True):
            column[self.count] = value
        self._loads[self.count] = loads
        self.count += 1

    def end(self, member: int, outcome: str, detail: str = "") -> None:
        """End the run of a member that runs, with the instants kept so far; later ones are not its own."""
        if self.running[member]:
            self._ends[member] = self.count, outcome, detail
            self.running[member] = False

    def end_all(self, outcome: str, detail: str = "") -> None:
        """End the runs of all members that still run."""
        for member in range(len(self.running)):
            self.end(member, outcome, detail)

    def of(self, member: int) -> "MemberRecord":
        """What one run left."""
        count, outcome, detail = self._ends[member]
        displacement, velocity, acceleration = (column[:count, member] for column in self._columns)
        loads = {name: self._loads[:count, member, i] for i, name in enumerate(self.load_names)}
        return MemberRecord(outcome, detail, displacement, velocity, acceleration, loads)


@dataclass(frozen=True)
class MemberRecord:
    """One run of a batch: how it ended, and displacement, velocity, acceleration and each load (T, 6)."""

    outcome: str
    detail: str
    displacement: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    loads: dict[str, FloatArray]

    @property
    def count(self) -> int:
        """Instants kept."""
        return len(self.displacement)


def ramp_factor(time: float, ramp: float) -> float:
    """Factor on the wave amplitudes, ½(1 − cos(π t/ramp)) until t = ramp [s], then 1."""
    return 1.0 if time >= ramp else 0.5 * (1.0 - math.cos(math.pi * time / ramp))


@np.errstate(over="ignore", invalid="ignore")  # a motion that overflows has diverged, and is told so
def march(
    equations: EquationsOfMotion,
    displacement: FloatArray,
    velocity: FloatArray,
    *,
    steps: int,
    time_step: float,
    ramp: float,
    limits: Limits,
    progress: Progress | None = None,
) -> Record:
    """Step the equations of motion of a batch of runs `steps` times and keep every instant.

    Starts from `displacement` and `velocity` (B, 6), held there until t = 0. A member ends early where a
    limit is exceeded or its motion is no longer finite, all of them on an interrupt. A member that has
    ended is held at rest, whatever it costs: the others go on as if it were not there.
    """
    radiation = equations.radiation
    memory = radiation.start(displacement, velocity)
    record = Record(steps + 1, len(displacement), equations.load_names)
    start = 0.0
    try:
        for step in range(steps + 1):
            start = step * time_step
            rates = _rates(equations, memory, start, time_step, ramp)
            first, loads = rates(0.0, displacement, velocity)
            _end_where_not_finite(record, start + time_step, first, loads)
            record.add(displacement, velocity, first, loads)
            if step == steps:
                break
            before = displacement
            displacement, velocity = rk4_step(rates, first, displacement, velocity, time_step)
            _end_where_not_finite(record, start + time_step, displacement, velocity)
            _end_beyond_limits(record, limits, displacement, before, start + time_step)
            if not record.running.any():
                break
            if not record.running.all():
                displacement, velocity = (_held(value, record.running) for value in (displacement, velocity))
            memory = radiation.remember(memory, displacement, velocity)
            if progress is not None and step % STEPS_BETWEEN_PROGRESS == 0:
                progress(start, steps * time_step)
        record.end_all("finished")
    except KeyboardInterrupt:
        if not record.count:  # nothing to keep yet
            raise
        record.end_all("interrupted", f"stopped by the user at t = {start:.6g} s")
    return record


def _rates(
    equations: EquationsOfMotion, memory: FloatArray, start: float, time_step: float, ramp: float
) -> Rates:
    """Accelerations (B, 6) and loads at a fraction of the step that begins at `start` [s]."""
    past = {fraction: equations.radiation.past(memory, fraction) for fraction in (0.0, 0.5, 1.0)}

    def at(fraction: float, displacement: FloatArray, velocity: FloatArray) -> tuple[FloatArray, FloatArray]:
        finite = finite_rows(displacement, velocity)
        if finite is not None:  # the loads take numbers only; the member ends with the step
            displacement, velocity = _held(displacement, finite), _held(velocity, finite)
        time = start + fraction * time_step
        instant = Instant(time, ramp_factor(time, ramp), displacement, velocity)
        return equations.evaluate(instant, past[fraction])

    return at


def _held(values: FloatArray, running: BoolArray) -> FloatArray:
    """Values (B, 6) of the members that run (B,), zero for those that are held at rest."""
    return np.where(running[:, None], values, 0.0)


def _end_where_not_finite(record: Record, time: float, *values: FloatArray) -> None:
    """End the runs whose values (B, ...) are no longer finite; at the start that is an error."""
    finite = finite_rows(*values)
    if finite is None:
        return
    for member in np.flatnonzero(~finite):
        if not record.count:
            with about_member(int(member), len(finite)):
                raise PanelsimError(
                    "The loads on the ship at the start are no numbers",
                    got=f"accelerations {values[0][member]}",
                    allowed="a ship near rest",
                )
        record.end(int(member), "diverged", f"the motion is no longer finite at t = {time:.6g} s")


def _end_beyond_limits(
    record: Record, limits: Limits, displacement: FloatArray, before: FloatArray, time: float
) -> None:
    """End the runs whose displacement (B, 6) exceeds a limit; `before` is a step earlier."""
    inside = np.abs(displacement) <= limits.safe
    if inside.all():
        return
    for member in np.flatnonzero(~inside.all(axis=1)):
        ended = limits.exceeded(displacement[member], before[member])
        if ended is not None:
            outcome, cause = ended
            record.end(int(member), outcome, f"{cause} at t = {time:.6g} s")
