"""What a point of the ship does in a run: kinematics at any angle, and its motion over the waves."""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from panelsim.conventions import Dof, FloatArray, rotation_to_earth
from panelsim.errors import require_kind
from panelsim.motion.equations import ramp_factor
from panelsim.motion.history import BoolArray, History
from panelsim.motion.waves_met import wave_elevation
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.ship.points import AXES, POINT_UNITS, point_of_ship, points_of_ship

_FORWARD = np.array([1.0, 0.0, 0.0])
_UP = np.array([0.0, 0.0, 1.0])
_A_HISTORY = "a History, as simulate() gives it or History.load() reads it"
_AXES_NOTE = "translating earth: x forward, y port, z up; mean speed and gravity left out"


def point_motions(history: History, point: ArrayLike) -> xr.Dataset:
    """Motions of a point of the ship (3,) [m], given in hull axes: midships, centreline, baseline.

    `displacement` from rest, `velocity` and `acceleration` (time, axis) [m, m/s, m/s2] along translating
    earth axes, of the rigid ship at any angle: the mean speed is not in the velocity, and gravity, which an
    instrument on deck feels, not in the acceleration. `relative_motion` (time) [m] is the vertical
    displacement less the elevation of the incident wave, positive where the point rises from the water: its
    sum with the attribute `height_above_water` [m], that at rest, is the height over the wave. The wave is
    taken where the point is, in a linear run at its mean place, as the loads of that model are. Rows of a
    diverged run that hold no numbers are NaN. Raises PanelsimError for what is no history, and as
    `point_of_ship`.
    """
    require_kind("history", history, History, _A_HISTORY)
    center = history.loading["center_of_gravity"]
    place = point_of_ship(point, center, history.mesh_vertices)
    arm = rotation_to_earth(0.0, float(history.loading["trim"]), 0.0) @ (place - center)
    rows = history.finite
    signals = np.full((len(rows), 10), np.nan)
    with np.errstate(over="ignore", invalid="ignore"):  # rates of the last rows of a diverged run
        signals[rows, :9] = _kinematics(history, rows, arm)
    at = arm[:2] + (0.0 if history.attrs["model"] == "linear" else signals[rows, :2])
    signals[rows, 9] = signals[rows, 2] - _elevation(history, rows, at)
    vectors = {
        name: (("time", "axis"), signals[:, 3 * i : 3 * i + 3], {"units": unit})
        for i, (name, unit) in enumerate(
            {"displacement": "m", "velocity": "m/s", "acceleration": "m/s2"}.items()
        )
    }
    return xr.Dataset(
        vectors | {"relative_motion": (("time",), signals[:, 9], {"units": "m"})},
        coords={"time": ("time", history.time, {"units": "s"}), "axis": list(AXES)},
        attrs={
            "point": place,
            "height_above_water": float(arm[2] - history.waterline),
            "axes": _AXES_NOTE,
        },
    )


def with_points(history: History, points: Mapping[str, ArrayLike]) -> History:
    """The history with the motions of points by name, (3,) [m] in hull axes, as groups `points/NAME`.

    Points that it has already stay, but for those given anew. Raises PanelsimError for what is no history,
    and as `points_of_ship`.
    """
    require_kind("history", history, History, _A_HISTORY)
    places = points_of_ship(points, history.loading["center_of_gravity"], history.mesh_vertices)
    if not places:
        return history
    groups = {node.path: node.to_dataset(inherit=False) for node in history.tree.subtree}
    # The time is that of the root.
    added = {
        f"/points/{name}": point_motions(history, place).drop_vars("time") for name, place in places.items()
    }
    return History(xr.DataTree.from_dict(groups | added))


def point_signals(motions: xr.Dataset) -> dict[str, FloatArray]:
    """The motions of a point as columns (T,) by the names of `POINT_UNITS`."""
    columns = [
        *motions["displacement"].values.T,
        *motions["velocity"].values.T,
        *motions["acceleration"].values.T,
        motions["relative_motion"].values,
    ]
    return dict(zip(POINT_UNITS, columns, strict=True))


def _kinematics(history: History, rows: BoolArray, arm: FloatArray) -> FloatArray:
    """Displacement, velocity and acceleration (T, 9) of a point at `arm` (3,) [m] from the CG, ship axes.

    With the axes a of roll, b of pitch and z of yaw, the ship turns at w = φ̇ a + θ̇ b + ψ̇ z; b turns by yaw
    alone, a by yaw and pitch.
    """
    motion, rate, second = (
        values[rows] for values in (history.displacement, history.velocity, history.acceleration)
    )
    ship = Rotation.from_euler("ZYX", motion[:, [Dof.YAW, Dof.PITCH, Dof.ROLL]])
    reach = ship.apply(arm)
    yaw = motion[:, Dof.YAW]
    roll_axis = ship.apply(_FORWARD)
    pitch_axis = np.column_stack([-np.sin(yaw), np.cos(yaw), np.zeros(len(yaw))])
    axes = np.stack([roll_axis, pitch_axis, np.broadcast_to(_UP, roll_axis.shape)], axis=1)
    rolling, pitching, yawing = (values[:, None] for values in rate[:, 3:].T)
    spin = (rate[:, 3:, None] * axes).sum(axis=1)
    turn_of_roll_axis = np.cross(pitching * pitch_axis + yawing * _UP, roll_axis)
    turn_of_pitch_axis = np.cross(yawing * _UP, pitch_axis)
    spin_rate = (
        (second[:, 3:, None] * axes).sum(axis=1) + rolling * turn_of_roll_axis + pitching * turn_of_pitch_axis
    )
    return np.hstack(
        [
            motion[:, :3] + reach - arm,
            rate[:, :3] + np.cross(spin, reach),
            second[:, :3] + np.cross(spin_rate, reach) + np.cross(spin, np.cross(spin, reach)),
        ]
    )


def _elevation(history: History, rows: BoolArray, at: FloatArray) -> FloatArray:
    """Incident wave (T,) [m] at a place (2,), or one at each time (T, 2) [m], in translating axes."""
    time, ramp = history.time[rows], float(history.attrs["ramp"])
    factor = np.array([ramp_factor(t, ramp) for t in time])
    # The NumPy twin, as for the wave at the origin: the same bits whatever the length.
    sea = TranslatingSeaway(
        history.components,
        float(history.attrs["speed"]),
        float(history.loading["gravity"]),
        method="oracle",
    )
    return wave_elevation(sea, time, factor, at[..., 0], at[..., 1])
