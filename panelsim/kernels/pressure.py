"""Incident-wave and buoyancy pressure integrated over the wetted hull, by whichever method is asked for."""

import threading
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from panelsim.conventions import METHODS, FloatArray
from panelsim.errors import PanelsimError
from panelsim.kernels import oracle
from panelsim.kernels.direct import DirectMethod
from panelsim.kernels.exchange import Hull
from panelsim.kernels.grid import GridMethod
from panelsim.kernels.grid_plan import DEFAULT_TOLERANCE, choose_method
from panelsim.kernels.hull_box import hull_box, hull_tolerance
from panelsim.kernels.tables import PanelTables, WaveTables, checked_poses, require_rule, require_stretching


class PointPressure(NamedTuple):
    """At the points (P,) of a hull (`PanelTables`) that the rule takes and that lie near the water.

    `submergence` below the instantaneous surface [m], below zero where dry; `pressure` [Pa]; and the pressure
    to interpolate along an edge to where the surface cuts it, `to_cut` [Pa]. Points that no wet panel has:
    submergence -1, pressure 0.
    """

    submergence: FloatArray
    pressure: FloatArray
    to_cut: FloatArray


class PressureIntegral:
    """Force and moment of buoyancy and incident waves on one wetted hull, in one sea or in several.

    p = -ρ g z + ρ g Σ a cos θ exp(k (z - ζ)), z above calm water where the panel is: TM 2003-190 (10)
    for the elevation, section 2.6 for Wheeler's z - ζ, section 6 for the integral; "none" puts
    exp(k min(z, 0)) instead. The pressure carries no ω_e/ω, which (16) there seems to ask for: the
    two parts of -ρ(∂/∂t - U ∂/∂x)Φ together give ω. With `second_order` waves ζ has the term ½ a² k cos 2θ
    of (8) and (17) and Φ stays of first order, section 2.2. Wheeler's pressure at the surface is then
    -ρ g ½ a² k cos 2θ, an inconsistency of that model, where it is 0 without second order.

    `waterline`: calm water above the CG when upright [m]; `water_density` [kg/m3]; `gravity` [m/s2]; `rule`
    one of `conventions.RULES`. `method` of each sea: "direct" sums the waves at every point, "grid" takes
    them from a grid within `tolerance` of the significant amplitude, "oracle" is the NumPy twin of "direct",
    "auto" takes the cheaper of the first two. Raises PanelsimError for no seas, an unknown stretching, rule
    or method, and a sea that the method cannot take.
    """

    def __init__(
        self,
        panels: PanelTables,
        seas: Sequence[WaveTables],
        *,
        waterline: float,
        water_density: float,
        gravity: float,
        stretching: str = "wheeler",
        rule: str = "vertex+centre",
        method: str = "auto",
        tolerance: float = DEFAULT_TOLERANCE,
    ) -> None:
        require_stretching(stretching)
        require_rule(rule)
        if not (isinstance(method, str) and method in METHODS):
            raise PanelsimError("Unknown method", got=repr(method)[:60], allowed=" | ".join(METHODS))
        if not seas:
            raise PanelsimError("There is no sea", allowed="one or more; calm water is a sea without waves")
        self._sea_count, self._weight_density = len(seas), water_density * gravity
        hull = Hull(panels, waterline, stretching, rule)
        self.methods = tuple(_chosen(method, hull, sea, tolerance) for sea in seas)
        kinds = [(name, sea.second_order) for name, sea in zip(self.methods, seas, strict=True)]
        self._parts = []
        self._busy = threading.Lock()  # the methods write into arrays of their own
        for kind in dict.fromkeys(kinds):
            members = np.flatnonzero([other == kind for other in kinds])
            self._parts.append(
                (members, _method(kind[0], hull, [seas[i] for i in members.tolist()], tolerance))
            )

    def __call__(self, poses: FloatArray) -> FloatArray:
        """Force [N] and moment about the CG [N m] in ship axes, (B, 6), one row a pose.

        `poses` (B, 8): time [s], factor on all wave amplitudes, η1..η3 [m], η4..η6 [rad], of the ship axes in
        the translating earth axes. One sea serves any number of poses; of several each has its own pose.
        The row of a pose is the same to the bit whatever others there are. Raises PanelsimError for poses of
        another shape or not finite.
        """
        poses = checked_poses(poses)
        with self._busy:
            return self._loads(poses)

    def _loads(self, poses: FloatArray) -> FloatArray:
        if self._sea_count == 1:
            return self._parts[0][1].heads(poses) * self._weight_density
        if len(poses) != self._sea_count:
            raise PanelsimError(
                "There is not one pose for each sea", got=f"{len(poses)} poses", allowed=f"{self._sea_count}"
            )
        loads = np.empty((len(poses), 6))
        for members, method in self._parts:
            loads[members] = method.heads(poses[members])
        return loads * self._weight_density

    def at_points(self, pose: FloatArray) -> PointPressure:
        """What the water does at the points of the hull at one pose (8,) in a single sea.

        Raises PanelsimError as a call does, and for several seas.
        """
        poses = checked_poses(np.atleast_2d(pose))
        if self._sea_count != 1 or len(poses) != 1:
            raise PanelsimError(
                "Pressures at points are of one sea and one pose",
                got=f"{self._sea_count} seas, {len(poses)} poses",
            )
        with self._busy:
            submergence, head, to_cut = self._parts[0][1].at_points(poses)
        return PointPressure(submergence, head * self._weight_density, to_cut * self._weight_density)


def wetted_surface_load(
    panels: PanelTables,
    waves: WaveTables,
    poses: FloatArray,
    *,
    waterline: float,
    water_density: float,
    gravity: float,
    stretching: str = "wheeler",
    rule: str = "vertex+centre",
    method: str = "direct",
) -> FloatArray:
    """Force and moment (B, 6) in ship axes at poses (B, 8) in one sea; all as `PressureIntegral`."""
    integral = PressureIntegral(
        panels,
        [waves],
        waterline=waterline,
        water_density=water_density,
        gravity=gravity,
        stretching=stretching,
        rule=rule,
        method=method,
    )
    return integral(poses)


class _Method(Protocol):
    """Seas about one hull, by one method."""

    def heads(self, poses: FloatArray) -> FloatArray: ...

    def at_points(self, poses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]: ...


def _method(name: str, hull: Hull, seas: list[WaveTables], tolerance: float) -> _Method:
    if name == "direct":
        return DirectMethod(hull, seas)
    if name == "grid":
        return GridMethod(hull, seas, tolerance)
    return _Oracle(hull, seas)


def _chosen(method: str, hull: Hull, sea: WaveTables, tolerance: float) -> str:
    """ "direct", "grid" or "oracle": calm water needs no grid, and "auto" takes what costs less."""
    felt = sea.felt()
    if method in ("auto", "grid") and not len(felt.amplitude):
        return "direct"
    if method != "auto":
        return method
    box = hull_box(hull.panels.points, hull.waterline, sea.standard_deviation)
    tolerance = hull_tolerance(hull.panels.points, felt, tolerance)
    return "direct" if choose_method(hull.point_count, felt, box, tolerance) == "direct" else "grid"


class _Oracle:
    """The NumPy twin, one pose after the other."""

    def __init__(self, hull: Hull, seas: list[WaveTables]) -> None:
        self._hull, self._seas = hull, seas

    def heads(self, poses: FloatArray) -> FloatArray:
        """Loads (B, 6) over ρ g; a single sea serves any number of poses (B, 8)."""
        seas = self._seas * len(poses) if len(self._seas) == 1 else self._seas
        loads = [
            oracle.wetted_surface_load(
                self._hull.panels,
                sea,
                pose[None],
                waterline=self._hull.waterline,
                water_density=1.0,
                gravity=1.0,
                stretching=self._hull.stretching,
                rule=self._hull.rule,
            )[0]
            for sea, pose in zip(seas, poses, strict=True)
        ]
        return np.array(loads).reshape(-1, 6)

    def at_points(self, poses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Submergence and heads of the points (P,) at a single pose."""
        water = oracle.Surroundings(self._seas[0], poses[0], self._hull.waterline, 1.0, self._hull.stretching)
        return water.at(self._hull.panels.points)
