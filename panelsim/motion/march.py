"""The time loop: from the state at rest to the end of the run, or to whatever ends it before."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from panelsim.conventions import Dof, FloatArray
from panelsim.loads.load import Instant
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.steppers import rk4_step

# Pitch near 90° is where yaw-pitch-roll angles cease to mean anything; no ship comes back from 60°.
PITCH_LIMIT = np.deg2rad(60.0)

Progress = Callable[[float, float], None]


@dataclass(frozen=True)
class Limits:
    """Where a run ends early: |roll| [rad] (0 = never), |heave| [m] and drift [m]."""

    capsize_angle: float
    heave: float
    drift: float

    def exceeded(self, displacement: FloatArray) -> tuple[str, str] | None:
        """Outcome and cause, or None while the ship is within all limits."""
        if not np.isfinite(displacement).all():
            return "diverged", "the motion is no longer finite"
        roll, pitch = abs(displacement[Dof.ROLL]), abs(displacement[Dof.PITCH])
        if 0 < self.capsize_angle < roll:
            limit = np.rad2deg(self.capsize_angle)
            return "capsized", f"roll {np.rad2deg(displacement[Dof.ROLL]):.1f}°, limit {limit:g}°"
        if pitch > PITCH_LIMIT:
            return "diverged", f"pitch {np.rad2deg(displacement[Dof.PITCH]):.1f}°, limit 60°"
        if abs(displacement[Dof.HEAVE]) > self.heave:
            return "diverged", f"heave {displacement[Dof.HEAVE]:.4g} m, limit {self.heave:g} m"
        if np.hypot(*displacement[:2]) > self.drift:
            return "diverged", f"drift {np.hypot(*displacement[:2]):.4g} m, limit {self.drift:g} m"
        return None


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
            past = {fraction: radiation.past(memory, fraction) for fraction in (0.0, 0.5, 1.0)}

            def at(
                fraction: float, displacement: FloatArray, velocity: FloatArray
            ) -> tuple[FloatArray, FloatArray]:
                time = start + fraction * time_step  # noqa: B023 - called within this step only
                instant = Instant(time, ramp_factor(time, ramp), displacement, velocity)
                return equations.evaluate(instant, past[fraction])  # noqa: B023

            first, loads = at(0.0, displacement, velocity)
            record.add(displacement, velocity, first, loads)
            if step == steps:
                break
            displacement, velocity = rk4_step(at, first, displacement, velocity, time_step)
            ended = limits.exceeded(displacement)
            if ended is not None:
                record.outcome, cause = ended
                record.detail = f"{cause} at t = {start + time_step:.6g} s"
                break
            memory = radiation.remember(memory, displacement, velocity)
            if progress is not None and step % 25 == 0:
                progress(start, steps * time_step)
    except KeyboardInterrupt:
        record.outcome, record.detail = "interrupted", f"stopped by the user at t = {start:.6g} s"
    return record
