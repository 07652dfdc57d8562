"""Axes, signs, units and constants that all of panelsim shares; CONVENTIONS.md draws them.

SI units and radians inside. Right-handed axes: x forward, y to port, z up.
"""

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
IntArray = NDArray[np.int64]

STANDARD_GRAVITY = 9.80665  # m/s2
SALT_WATER_DENSITY = 1025.0  # kg/m3
FRESH_WATER_DENSITY = 1000.0  # kg/m3
KNOT = 1852.0 / 3600.0  # m/s
CONFIDENCE = 0.95  # of every confidence band

# How the wave pressure reaches up to the instantaneous surface: Wheeler's stretching, or not at all.
STRETCHINGS = ("wheeler", "none")

# Where the pressure of a panel is taken. With panels cut at the water: at the corners, or at the centre too.
# With whole panels, each wet or dry by its centre, as in TM 2003-190 section 6: there.
CUT_RULES = ("vertex", "vertex+centre")
RULES = (*CUT_RULES, "panel")

# How that pressure is found: the waves summed point by point, taken from a grid that moves with the ship, or
# summed by the slow NumPy twin; "auto" takes the cheaper of the first two.
METHODS = ("auto", "direct", "grid", "oracle")


class Dof(IntEnum):
    """The six motions, in the order of every array of six."""

    SURGE = 0
    SWAY = 1
    HEAVE = 2
    ROLL = 3
    PITCH = 4
    YAW = 5


DOF_NAMES = tuple(dof.name.lower() for dof in Dof)


def corner_shares(panels: NDArray[np.integer]) -> FloatArray:
    """Share (N, 4) of each corner in the mean of a panel; a repeated third vertex shares with itself."""
    triangle = (panels[:, 2] == panels[:, 3])[:, None]
    return np.where(triangle, np.array([2.0, 2.0, 1.0, 1.0]) / 6.0, 0.25)


def panel_centres(vertices: FloatArray, panels: NDArray[np.integer]) -> FloatArray:
    """Centre (N, 3) of each panel (N, 4), the mean of its corners; `vertices` (V, 3) in any axes."""
    centres: FloatArray = np.einsum("nc,ncx->nx", corner_shares(panels), vertices[panels])
    return centres


def panel_triangles(vertices: FloatArray, panels: NDArray[np.integer]) -> FloatArray:
    """The surface that the panels (N, 4) stand for: four triangles about the centre of each, (N, 4, 3, 3).

    Corners are centre, vertex, next vertex. Every surface integral of panelsim is one over these
    triangles: no diagonal of a quadrilateral is preferred, so an upright symmetric hull feels no roll or
    yaw from its own panelling. A panel that repeats its third vertex has one triangle without area.
    `vertices` (V, 3) in any axes.
    """
    corners = vertices[panels]
    centres = np.broadcast_to(panel_centres(vertices, panels)[:, None], corners.shape)
    return np.stack([centres, corners, np.roll(corners, -1, axis=1)], axis=2)


def rotation_to_earth(roll: float, pitch: float, yaw: float) -> FloatArray:
    """Matrix (3, 3) that turns ship axes into translating earth axes, Rz(yaw) Ry(pitch) Rx(roll).

    Yaw, then pitch, then roll, each about the axes already turned: the words above TM 2003-190
    (57)-(59). The matrix printed there is the reverse order and has one cosine for a sine.
    Angles in rad; roll lowers starboard, pitch lowers the bow, yaw turns the bow to port.
    """
    cr, sr = np.cos(roll), np.sin(roll)
    cp, sp = np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def load_to_earth(load_in_ship_axes: FloatArray, displacement: FloatArray) -> FloatArray:
    """Turn force and moment (6,) or (B, 6) about the CG from ship axes into translating earth axes.

    The force by Rz Ry Rx; the moments become those conjugate to the yaw-pitch-roll angles,
    the exact form of TM 2003-190 (60)-(62) (printed with F6 sin for F6 cos in (62)):
    Q4 = F4, Q5 = F5 cos η4 - F6 sin η4, Q6 = -F4 sin η5 + (F5 sin η4 + F6 cos η4) cos η5.
    N and N m; displacement of the same shape in m and rad.
    """
    angles = displacement[..., 3:6].T
    (cr, cp, cy), (sr, sp, sy) = np.cos(angles), np.sin(angles)
    # Force and moment side by side. A moment turns only by the angles inside its own.
    x, y, z = load_in_ship_axes.T.reshape(2, 3, *displacement.shape[:-1]).swapaxes(0, 1)
    y, z = y * cr - z * sr, y * sr + z * cr
    vertical = z * cp - x * sp
    forward, sideways = x[0] * cp + z[0] * sp, y[0]
    surge, sway = forward * cy - sideways * sy, forward * sy + sideways * cy
    return np.array([surge, sway, vertical[0], x[1], y[1], vertical[1]]).T
