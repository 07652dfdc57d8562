"""Rigid-body inertia at large angles: it turns with the ship."""

import numpy as np

from panelsim.conventions import Dof, FloatArray
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
        self._moments = diagonal[3:].copy()

    def inertia(self, displacement: FloatArray) -> FloatArray:
        """M (B, 6, 6) of ships at displacements (B, 6) [m, rad]."""
        (cr, cp, _), (sr, sp, _) = _cosines_and_sines(displacement)
        along, across, upward = self._moments
        matrix = np.empty((len(displacement), 6, 6))
        matrix[:] = self.at_rest
        leant = (across - upward) * sr
        matrix[:, Dof.ROLL, Dof.YAW] = matrix[:, Dof.YAW, Dof.ROLL] = -along * sp
        matrix[:, Dof.PITCH, Dof.PITCH] = across - leant * sr
        matrix[:, Dof.PITCH, Dof.YAW] = matrix[:, Dof.YAW, Dof.PITCH] = leant * cr * cp
        matrix[:, Dof.YAW, Dof.YAW] = along * sp * sp + (upward + leant * sr) * cp * cp
        return matrix

    def gyroscopic(self, displacement: FloatArray, velocity: FloatArray) -> FloatArray:
        """c (B, 6) [N, N m] at displacements and velocities (B, 6): Eᵀ (I Ė η̇ + ω × I ω)."""
        (cr, cp, _), (sr, sp, _) = _cosines_and_sines(displacement)
        rolling, pitching, yawing = velocity[:, Dof.ROLL :].T
        along, across, upward = self._moments
        level, both = yawing * cp, pitching * yawing
        p, q, r = rolling - yawing * sp, pitching * cr + level * sr, level * cr - pitching * sr
        x = (upward - across) * q * r - along * both * cp
        y = (along - upward) * r * p + across * (rolling * r - both * sr * sp)
        z = (across - along) * p * q - upward * (rolling * q + both * cr * sp)
        load = np.zeros_like(displacement)
        load[:, Dof.ROLL] = x
        load[:, Dof.PITCH] = y * cr - z * sr
        load[:, Dof.YAW] = (y * sr + z * cr) * cp - x * sp
        return load


def _cosines_and_sines(displacement: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Of roll, pitch and yaw, each (3, B)."""
    angles = displacement[:, Dof.ROLL :].T
    return np.cos(angles), np.sin(angles)
