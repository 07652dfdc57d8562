"""A body that turns free of all moments, through every attitude: what the angles of a run cannot follow."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError


@dataclass(frozen=True, eq=False)
class FreeRotation:
    """Attitudes (T, 4) and angular velocities (T, 3) [rad/s] in ship axes at the times (T,) [s].

    An attitude is a unit quaternion, scalar first, that turns ship axes into earth axes.
    """

    time: FloatArray
    attitude: FloatArray
    angular_velocity: FloatArray

    @property
    def angles(self) -> FloatArray:
        """Roll, pitch and yaw (T, 3) [rad], for people: from −π to π, pitch from −π/2 to π/2."""
        return angles_of(self.attitude)


def rotate_freely(
    moments_of_inertia: FloatArray,
    attitude: FloatArray,
    angular_velocity: FloatArray,
    *,
    time_step: float,
    steps: int,
) -> FreeRotation:
    """Turn a body by RK4 from an attitude (4,) and an angular velocity (3,) [rad/s] in ship axes.

    `moments_of_inertia` (3,) [kg m²] about the ship axes. The angular momentum in earth axes,
    h = R(q) I ω, is constant; so is all that remains q̇ = ½ q ∘ (0, ω) with ω = I⁻¹ Rᵀ(q) h. After each step
    q is brought back to unit length. Raises PanelsimError for values of other shapes, not finite, moments
    of inertia or a step that are not positive, and a quaternion that is not of unit length.
    """
    inertia = _numbers("moments of inertia", moments_of_inertia, 3)
    q = _numbers("attitude", attitude, 4)
    spin = _numbers("angular velocity", angular_velocity, 3)
    _require(bool((inertia > 0.0).all()), "moments of inertia are", inertia, "positive numbers [kg m²]")
    _require(abs(float(q @ q) - 1.0) < 1e-9, "attitude is", q, "a quaternion of unit length, scalar first")
    _require(bool(np.isfinite(time_step)) and time_step > 0.0, "time step is", time_step, "more than 0 s")
    _require(isinstance(steps, int) and steps >= 1, "number of steps is", steps, "a whole number from 1")
    momentum = to_earth(q, inertia * spin)

    def velocity(now: FloatArray) -> FloatArray:
        return to_ship(now, momentum) / inertia

    def rate(now: FloatArray) -> FloatArray:
        p, r, s = velocity(now)
        w, x, y, z = now
        return 0.5 * np.array(
            [-x * p - y * r - z * s, w * p + y * s - z * r, w * r + z * p - x * s, w * s + x * r - y * p]
        )

    attitudes = np.empty((steps + 1, 4))
    attitudes[0] = q
    for step in range(steps):
        k1 = rate(q)
        k2 = rate(q + 0.5 * time_step * k1)
        k3 = rate(q + 0.5 * time_step * k2)
        k4 = rate(q + time_step * k3)
        q = q + time_step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        q = q / np.sqrt(q @ q)
        attitudes[step + 1] = q
    spins = to_ship(attitudes, momentum) / inertia
    time = time_step * np.arange(steps + 1, dtype=np.float64)
    for array in (time, attitudes, spins):
        array.setflags(write=False)
    return FreeRotation(time, attitudes, spins)


def attitude_of(roll: float, pitch: float, yaw: float) -> FloatArray:
    """The quaternion (4,) of `rotation_to_earth`, Rz(yaw) Ry(pitch) Rx(roll), angles in rad."""
    (cr, cp, cy), (sr, sp, sy) = (turn(0.5 * np.array([roll, pitch, yaw])) for turn in (np.cos, np.sin))
    return np.array(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )


def angles_of(attitude: FloatArray) -> FloatArray:
    """Roll, pitch and yaw (..., 3) [rad] of unit quaternions (..., 4); at a pitch of ±90° one of many."""
    w, x, y, z = np.moveaxis(attitude, -1, 0)
    roll = np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2.0 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return np.stack([roll, pitch, yaw], axis=-1)


def to_earth(attitude: FloatArray, vector: FloatArray) -> FloatArray:
    """R(q) v: a vector (..., 3) from ship axes into earth axes, for unit quaternions (..., 4)."""
    return _turned(attitude[..., :1], attitude[..., 1:], vector)


def to_ship(attitude: FloatArray, vector: FloatArray) -> FloatArray:
    """Rᵀ(q) v: a vector (..., 3) from earth axes into ship axes, for unit quaternions (..., 4)."""
    return _turned(attitude[..., :1], -attitude[..., 1:], vector)


def _turned(scalar: FloatArray, axis: FloatArray, vector: FloatArray) -> FloatArray:
    """v + 2 a × (a × v + w v)."""
    turned: FloatArray = vector + 2.0 * _cross(axis, _cross(axis, vector) + scalar * vector)
    return turned


def _cross(left: FloatArray, right: FloatArray) -> FloatArray:
    # A tenth of the time of numpy.cross for single vectors.
    (a, b, c), (x, y, z) = left.T, right.T
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x]).T


def _numbers(name: str, values: object, count: int) -> FloatArray:
    """Finite numbers (count,) as floats, else PanelsimError."""
    array = np.asarray(values)
    fits = array.shape == (count,) and array.dtype.kind in "iuf" and bool(np.isfinite(array).all())
    _require(fits, f"{name} is", values, f"{count} finite numbers")
    return array.astype(float)


def _require(holds: bool, what: str, got: object, allowed: str) -> None:
    if not holds:
        raise PanelsimError(f"The {what} out of range", got=repr(got)[:100], allowed=allowed)
