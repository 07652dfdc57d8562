"""The time loop: from the state at rest to the end of the run, or to whatever ends it before."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.loads.load import Instant
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.steppers import Rates, rk4_step

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


class _NotFinite(ArithmeticError):
    """The motion has left the numbers."""


def _require_finite(*values: FloatArray) -> None:
    if not all(np.isfinite(value).all() for value in values):
        raise _NotFinite


class Record:
    """Columns of a run, filled step by step; what is filled stays when the run is cut short."""

    def __init__(self, size: int, load_names: tuple[str, ...]) -> None:
        self.load_names = load_names
        self.outcome, self.detail = "finished", ""
        self.count = 0
        self._columns = [np.empty((size, 6)) for _ in range(3)]
        self._loads = np.empty((size, len(load_names), 6))

    def add(
        self, displacement: FloatArray, velocity: FloatArray, acceleration: FloatArray, loads: FloatArray
    ) -> None:
        """Keep one instant."""
        for column, value in zip(self._columns, (displacement, velocity, acceleration), strict=True):
            column[self.count] = value
        self._loads[self.count] = loads
        self.count += 1

    @property
    def motions(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Displacement, velocity and acceleration, (T, 6) each."""
        first, second, third = (column[: self.count] for column in self._columns)
        return first, second, third

    @property
    def loads(self) -> dict[str, FloatArray]:
        """Every load by name (T, 6)."""
        return {name: self._loads[: self.count, i] for i, name in enumerate(self.load_names)}


def ramp_factor(time: float, ramp: float) -> float:
    """Factor on the wave amplitudes, ½(1 − cos(π t/ramp)) until t = ramp [s], then 1."""
    return 1.0 if time >= ramp else 0.5 * (1.0 - float(np.cos(np.pi * time / ramp)))


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
    """Step the equations of motion `steps` times and keep every instant.

    Starts from `displacement` and `velocity` (6,), held there until t = 0. Ends early where a limit
    is exceeded or on an interrupt; `Record.outcome` and `.detail` say which and when.
    """
    radiation = equations.radiation
    memory = radiation.start(displacement, velocity)
    record = Record(steps + 1, equations.load_names)
    try:
        for step in range(steps + 1):
            start = step * time_step
            rates = _rates(equations, memory, start, time_step, ramp)
            first, loads = rates(0.0, displacement, velocity)
            _require_finite(first, loads)
            record.add(displacement, velocity, first, loads)
            if step == steps:
                break
            before = displacement
            displacement, velocity = rk4_step(rates, first, displacement, velocity, time_step)
            _require_finite(displacement, velocity)
            ended = limits.exceeded(displacement, before)
            if ended is not None:
                record.outcome, cause = ended
                record.detail = f"{cause} at t = {start + time_step:.6g} s"
                break
            memory = radiation.remember(memory, displacement, velocity)
            if progress is not None and step % STEPS_BETWEEN_PROGRESS == 0:
                progress(start, steps * time_step)
    except _NotFinite:
        if not record.count:
            raise PanelsimError(
                "The loads on the ship at the start are no numbers",
                got=displacement,
                allowed="a ship near rest",
            ) from None
        record.outcome = "diverged"
        record.detail = f"the motion is no longer finite at t = {start + time_step:.6g} s"
    except KeyboardInterrupt:
        if not record.count:  # nothing to keep yet
            raise
        record.outcome, record.detail = "interrupted", f"stopped by the user at t = {start:.6g} s"
    return record


def _rates(
    equations: EquationsOfMotion, memory: FloatArray, start: float, time_step: float, ramp: float
) -> Rates:
    """Acceleration (6,) and loads at a fraction of the step that begins at `start` [s]."""
    past = {fraction: equations.radiation.past(memory, fraction) for fraction in (0.0, 0.5, 1.0)}

    def at(fraction: float, displacement: FloatArray, velocity: FloatArray) -> tuple[FloatArray, FloatArray]:
        _require_finite(displacement, velocity)
        time = start + fraction * time_step
        instant = Instant(time, ramp_factor(time, ramp), displacement, velocity)
        return equations.evaluate(instant, past[fraction])

    return at
