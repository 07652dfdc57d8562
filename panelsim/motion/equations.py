"""Equations of motion: (M + A∞) η̈ = the sum of all loads, less the −A∞ η̈ that stands on the left."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import FloatArray
from panelsim.loads.load import Instant, Load, times_each
from panelsim.loads.radiation import Radiation
from panelsim.motion.rigid_body import RigidBody

BoolArray = NDArray[np.bool_]


class EquationsOfMotion:
    """M η̈ = Σ loads in translating earth axes, with M the inertia (6, 6) at rest about the CG.

    For a batch of runs of one ship. A motion (B, 12 + n) is displacement, velocity and the memory of the
    radiated waves; the wave amplitudes grow over `ramp` [s]. M is constant, as in TM 2003-190; with
    `large_angles` what a turned and turning ship adds is a load, `inertial`: M η̈ − M(η) η̈ − c(η, η̇) with M(η)
    and c of `RigidBody`.
    """

    def __init__(
        self,
        inertia: FloatArray,
        loads: Sequence[Load],
        radiation: Radiation,
        ramp: float = 0.0,
        *,
        large_angles: bool = False,
    ) -> None:
        self.loads = tuple(loads)
        self.body = RigidBody(inertia) if large_angles else None
        self.radiation = radiation
        self.ramp = ramp
        self.inverse = np.asarray(np.linalg.inv(inertia + radiation.added_mass_infinite), dtype=float)
        inertial = ("inertial",) if large_angles else ()
        self.load_names = (*(load.name for load in self.loads), *inertial, radiation.name)

    def start(self, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """Motions of ships held at displacements (B, 6) until t = 0, then let go at velocities (B, 6)."""
        return self.radiation.start(displacement, velocity)

    def evaluate(self, time: float, motion: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Accelerations (B, 6) and every load (B, n, 6) in the order of `load_names`; they sum to M η̈.

        The loads take numbers only: a member whose motion is none is taken at rest.
        """
        finite = finite_rows(motion)
        if finite is not None:
            motion = held(motion, finite)
        instant = Instant(time, ramp_factor(time, self.ramp), motion[:, :6], motion[:, 6:12])
        loads = np.empty((len(motion), len(self.load_names), 6))
        for i, load in enumerate(self.loads):
            loads[:, i] = load.evaluate(instant)
        loads[:, -1] = self.radiation.evaluate(motion)
        if self.body is None:
            acceleration = times_each(self.inverse, loads.sum(axis=1))
        else:
            acceleration, loads[:, -2] = self._of_turned(self.body, instant, loads)
        loads[:, -1] -= times_each(self.radiation.added_mass_infinite, acceleration)
        return acceleration, loads

    def _of_turned(
        self, body: RigidBody, instant: Instant, loads: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Accelerations and inertial loads (B, 6): (M(η) + A∞) η̈ = Σ loads − c, all loads but the last two
        ready, radiation without its −A∞ η̈."""
        inertia, gyroscopic = body.terms(instant.displacement, instant.velocity)
        forces = loads[:, :-2].sum(axis=1) + loads[:, -1] - gyroscopic
        whole = inertia + self.radiation.added_mass_infinite
        acceleration = np.linalg.solve(whole, forces[..., None])[..., 0]
        return acceleration, times_each(body.at_rest - inertia, acceleration) - gyroscopic

    def rate(self, motion: FloatArray, acceleration: FloatArray) -> FloatArray:
        """Rate (B, 12 + n) of a motion with these accelerations (B, 6)."""
        return np.concatenate([motion[:, 6:12], acceleration, self.radiation.memory_rate(motion)], axis=1)


def ramp_factor(time: float, ramp: float) -> float:
    """Factor on the wave amplitudes, ½(1 − cos(π t/ramp)) until t = ramp [s], then 1."""
    return 1.0 if time >= ramp else 0.5 * (1.0 - math.cos(math.pi * time / ramp))


def finite_rows(*values: FloatArray) -> BoolArray | None:
    """Which members (B,) of arrays (B, ...) have finite numbers only; None where all have."""
    # An infinite number, or none, makes a sum of squares so; it takes half the time of looking at each.
    if all([math.isfinite(np.vdot(value, value)) for value in values]):
        return None
    rows = [np.isfinite(value).all(axis=tuple(range(1, value.ndim))) for value in values]
    finite: BoolArray = np.logical_and.reduce(rows)
    return None if finite.all() else finite


def held(values: FloatArray, running: BoolArray) -> FloatArray:
    """Values (B, n) of the members that run (B,), zero for those that are held at rest."""
    return np.where(running[:, None], values, 0.0)
