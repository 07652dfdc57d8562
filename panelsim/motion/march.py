"""The time loop: from the state at rest to the end of the run, or to whatever ends it before."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.motion.equations import finite_rows
from panelsim.motion.requirements import about_member
from panelsim.motion.stepper import State, Stepper

# Pitch near 90° is where yaw-pitch-roll angles cease to mean anything; no ship comes back from 60°.
PITCH_LIMIT = np.deg2rad(60.0)
# Radiation, diffraction and the speed terms are those of a ship near her mean course.
YAW_LIMIT = np.deg2rad(60.0)
# Steps that can follow a ship as she capsizes see less of a turn at a time: this is an unstable scheme.
FASTEST_CAPSIZE = np.deg2rad(45.0)

STEPS_BETWEEN_PROGRESS = 25

Progress = Callable[[float, float], None]


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


class Record:
    """Columns of a batch of runs, filled step by step; what is filled stays when a run is cut short."""

    def __init__(self, size: int, members: int, load_names: tuple[str, ...]) -> None:
        self.load_names = load_names
        self.count = 0
        self.size = size
        self.running = np.ones(members, dtype=bool)
        self._ends = [(0, "", "")] * members
        self._columns = [np.empty((size, members, 6)) for _ in range(3)]
        self._loads = np.empty((size, members, len(load_names), 6))

    def add(self, state: State) -> None:
        """Keep one instant."""
        signals = state.displacement, state.velocity, state.acceleration
        for column, value in zip(self._columns, signals, strict=True):
            column[self.count] = value
        self._loads[self.count] = state.loads
        self.count += 1

    def fill(self, columns: Sequence[FloatArray], loads: FloatArray) -> None:
        """Put the instants of an earlier run in front: displacement, … (T, B, 6) and loads (T, B, L, 6)."""
        self.count = len(loads)
        for column, values in zip(self._columns, columns, strict=True):
            column[: self.count] = values
        self._loads[: self.count] = loads

    def drop_after(self, step: int) -> None:
        """Forget instants after so many steps: an interrupt may fall between an instant and its state."""
        self.count = min(self.count, step + 1)

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


@np.errstate(over="ignore", invalid="ignore")  # a motion that overflows has diverged, and is told so
def march(
    stepper: Stepper,
    state: State,
    record: Record,
    *,
    steps: int,
    time_step: float,
    limits: Limits,
    progress: Progress | None = None,
) -> State:
    """Step a batch of runs from a state until `steps` steps are done, and keep every instant in the record.

    Returns the state of the last instant that the record keeps.

    A member ends early where a limit is exceeded or its motion is no longer finite, all of them on an
    interrupt. A member that has ended is held at rest, whatever it costs: the others go on as if it were
    not there.
    """
    kept, begin = state, state.step * time_step
    try:
        for step in range(state.step, steps):
            begin, end = step * time_step, (step + 1) * time_step
            after = stepper.step(kept)
            _end_where_not_finite(record, after, end)
            _end_beyond_limits(record, limits, after.displacement, kept.displacement, end)
            if not record.running.any():
                return kept
            if not record.running.all():
                after = after.holding(record.running)
            if progress is not None and step % STEPS_BETWEEN_PROGRESS == 0:
                progress(begin, steps * time_step)
            record.add(after)
            kept = after
        record.end_all("finished")
    except KeyboardInterrupt:
        record.drop_after(kept.step)
        record.end_all("interrupted", f"stopped by the user at t = {begin:.6g} s")
    return kept


def require_finite_start(state: State) -> None:
    """Raise PanelsimError, with the number of the member, where the loads at the start are no numbers."""
    finite = finite_rows(state.acceleration, state.loads)
    if finite is None:
        return
    member = int(np.flatnonzero(~finite)[0])
    with about_member(member, len(finite)):
        raise PanelsimError(
            "The loads on the ship at the start are no numbers",
            got=f"accelerations {state.acceleration[member]}",
            allowed="a ship near rest",
        )


def _end_where_not_finite(record: Record, state: State, time: float) -> None:
    """End the runs of which a number is no longer finite."""
    finite = finite_rows(state.motion, state.acceleration, state.loads)
    if finite is not None:
        for member in np.flatnonzero(~finite):
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
