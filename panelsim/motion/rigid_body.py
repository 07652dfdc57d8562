"""Rigid-body inertia at large angles: it turns with the ship."""

import math

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError


class RigidBody:
    """Inertia of a ship about her CG, conjugate to surge, sway, heave and the yaw-pitch-roll angles.

    From the kinetic energy T = ½ m v² + ½ ωᵀ I ω with ω = E(η) η̇ in ship axes,
    d/dt ∂T/∂η̇ − ∂T/∂η = M(η) η̈ + c(η, η̇) = Q: M turns with the ship, c are the gyroscopic moments, and the
    moments of Q are those of `load_to_earth`. M(0) is the inertia (6, 6) [kg, kg m²] of `Ship`, which has no
    products of inertia. All angles are allowed, but at a pitch of ±90° M(η) is singular.

    Raises PanelsimError for an inertia that is not diagonal, positive, with one mass in three directions.
    """

    def __init__(self, inertia: FloatArray) -> None:
        diagonal = np.diag(inertia) if np.shape(inertia) == (6, 6) else np.zeros(6)
        sound = np.array_equal(inertia, np.diag(diagonal)) and np.ptp(diagonal[:3]) == 0.0
        if not (sound and np.isfinite(diagonal).all() and (diagonal > 0.0).all()):
            raise PanelsimError(
                "The inertia is not that of a ship about her centre of gravity",
                got=np.array2string(np.asarray(inertia), max_line_width=1000, threshold=36),
                allowed="a diagonal (6, 6) of m, m, m and three moments of inertia, all positive",
            )
        self.at_rest = np.array(inertia, dtype=float)
        self._moments = tuple(diagonal[3:].tolist())

    def terms(self, displacement: FloatArray, velocity: FloatArray) -> tuple[FloatArray, FloatArray]:
        """M (B, 6, 6) and c (B, 6) [N, N m] at displacements and velocities (B, 6), finite ones."""
        inertia = np.empty((len(displacement), 6, 6))
        inertia[:] = self.at_rest
        gyroscopic = np.zeros((len(displacement), 6))
        # Plain numbers: for a single ship a third of the time of arrays, and for a batch no more.
        turns = zip(displacement[:, 3:5].tolist(), velocity[:, 3:].tolist(), strict=True)
        found = [(*self._inertia(*angles), *self._gyroscopic(*angles, *rates)) for angles, rates in turns]
        flat = np.array(found)
        inertia[:, 3:, 3:] = flat[:, :9].reshape(-1, 3, 3)
        gyroscopic[:, 3:] = flat[:, 9:]
        return inertia, gyroscopic

    def _inertia(self, roll: float, pitch: float) -> tuple[float, ...]:
        """Eᵀ I E, row by row."""
        cr, cp, sr, sp = math.cos(roll), math.cos(pitch), math.sin(roll), math.sin(pitch)
        along, across, upward = self._moments
        leant = (across - upward) * sr
        roll_yaw, pitch_yaw = -along * sp, leant * cr * cp
        pitch_pitch = across - leant * sr
        yaw_yaw = along * sp * sp + (upward + leant * sr) * cp * cp
        return along, 0.0, roll_yaw, 0.0, pitch_pitch, pitch_yaw, roll_yaw, pitch_yaw, yaw_yaw

    def _gyroscopic(
        self, roll: float, pitch: float, rolling: float, pitching: float, yawing: float
    ) -> tuple[float, float, float]:
        """Eᵀ (I Ė η̇ + ω × I ω)."""
        cr, cp, sr, sp = math.cos(roll), math.cos(pitch), math.sin(roll), math.sin(pitch)
        along, across, upward = self._moments
        level, both = yawing * cp, pitching * yawing
        p, q, r = rolling - yawing * sp, pitching * cr + level * sr, level * cr - pitching * sr
        x = (upward - across) * q * r - along * both * cp
        y = (along - upward) * r * p + across * (rolling * r - both * sr * sp)
        z = (across - along) * p * q - upward * (rolling * q + both * cr * sp)
        return x, y * cr - z * sr, (y * sr + z * cr) * cp - x * sp
