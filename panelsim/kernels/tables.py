"""What the pressure kernel reads: the hull surface as loaded points, the sea as components.

A panel is four triangles about its centre, and a pressure is linear on each of them. Force and moment are
then linear in the pressures at the points, F = Σ p_v G_v. The response G of a point follows from the
geometry alone and is built once. Three rules say what the points are:

"vertex": the corners of the panels; the centre has the mean of its corners.
"vertex+centre": the centres too. What the centre has above the mean of its corners bends the pressure over
the whole panel, so it acts at the centre on more area than the triangles give it: so much that the corners
have 1/12 of a panel each and the centre the rest: exact for quadratic pressure on triangles, parallelograms.
"panel": the centres alone, for whole panels that are wet or dry by them, as in TM 2003-190 section 6.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from panelsim.conventions import RULES, STRETCHINGS, FloatArray, IntArray, corner_shares, panel_centres
from panelsim.errors import PanelsimError

LANES = 8  # points that the kernel handles side by side
# Share of a panel that the bend of the pressure takes beyond the third that the triangles give the centre.
QUADRILATERAL_BEND = 2.0 / 3.0 - 1.0 / 3.0
TRIANGLE_BEND = 3.0 / 4.0 - 1.0 / 3.0

Scalar = TypeVar("Scalar", bound=np.generic)


@dataclass(frozen=True)
class PanelTables:
    """The hull surface in ship axes, ready for the pressure sum; made by `panel_tables`.

    The points are the vertices in order of height, so that most blocks of eight are wholly wet or
    wholly dry, filled up to a multiple of eight with copies that no panel uses; then the centres of
    the panels likewise, that of panel n being point `first_centre` + n.

    `points` (P, 3) [m]; `response`, of each rule (P, 6): force [m2] and moment about the origin [m3] for
    unit pressure at the point; `reach` (P,) [m]: the distance to the farthest point of the same panel;
    `panels` (N, 4): point indices, counter-clockwise seen from the water; `panel_order` (N,): which panel of
    the mesh each of them is.
    """

    points: FloatArray
    response: Mapping[str, FloatArray]
    reach: FloatArray
    panels: NDArray[np.int32]
    panel_order: IntArray
    first_centre: int

    @cached_property
    def blocks(self) -> Mapping[str, FloatArray]:
        """Of each rule, points in blocks of eight (P/8, 10, 8): x, y, z, six responses, reach."""
        return {rule: self._blocks_of(response) for rule, response in self.response.items()}

    @cached_property
    def corners(self) -> FloatArray:
        """x, y, z of the corners of each panel one after the other (N, 12) [m]."""
        return _frozen(self.points[self.panels].reshape(-1, 12))

    @cached_property
    def spans(self) -> NDArray[np.int32]:
        """Of each block of eight points the first panel that has one of them, and one past the last (P/8, 2).

        Where no panel has any: the number of panels, and 0.
        """
        count = len(self.panels)
        numbers = np.arange(count, dtype=np.int32)
        spans = np.tile(np.array([count, 0], dtype=np.int32), (len(self.points) // LANES, 1))
        for points in (*self.panels.T, self.first_centre + numbers):
            np.minimum.at(spans[:, 0], points // LANES, numbers)
            np.maximum.at(spans[:, 1], points // LANES, numbers + 1)
        return _frozen(spans)

    def _blocks_of(self, response: FloatArray) -> FloatArray:
        columns = np.column_stack([self.points, response, self.reach])
        return np.ascontiguousarray(columns.reshape(-1, LANES, 10).transpose(0, 2, 1))


@dataclass(frozen=True)
class WaveTables:
    """Wave components seen from the translating earth axes; made by `wave_tables`.

    All (M,), M = 0 for calm water: `amplitude` [m], `wavenumber_x` = k cos β and `wavenumber_y` =
    -k sin β [rad/m], `wavenumber` k [rad/m], `encounter_frequency` with its sign [rad/s], `phase`
    ε [rad]. The elevation is Σ a cos(kx x + ky y - ω_e t - ε); with `second_order` Σ ½ a² k cos 2θ is
    added to it, which is Stokes' theory for a single wave.
    """

    amplitude: FloatArray
    wavenumber_x: FloatArray
    wavenumber_y: FloatArray
    wavenumber: FloatArray
    encounter_frequency: FloatArray
    phase: FloatArray
    second_order: bool = field(default=False, kw_only=True)

    @property
    def standard_deviation(self) -> float:
        """Of the elevation of first order [m]."""
        return float(np.sqrt(0.5 * np.sum(self.amplitude**2)))

    def felt(self) -> "WaveTables":
        """The waves whose energy is above zero, as computers count."""
        high = self.amplitude**2 > 0.0
        columns = ("amplitude", "wavenumber_x", "wavenumber_y", "wavenumber", "encounter_frequency", "phase")
        return replace(self, **{name: getattr(self, name)[high] for name in columns})

    def turned(self, angle: float) -> Self:
        """The same waves in axes turned by `angle` [rad] about the vertical; by none, to the bit."""
        cos, sin = np.cos(angle), np.sin(angle)
        x, y = self.wavenumber_x, self.wavenumber_y
        return replace(self, wavenumber_x=cos * x + sin * y, wavenumber_y=cos * y - sin * x)

    @cached_property
    def columns(self) -> FloatArray:
        """The components as the kernel counts them (M, 6): phases in turns, decay in powers of two.

        Columns a, kx/2π, ky/2π, k log2(e), ω_e/2π, ε/2π.
        """
        turn = 2.0 * np.pi
        return np.column_stack(
            [
                self.amplitude,
                self.wavenumber_x / turn,
                self.wavenumber_y / turn,
                self.wavenumber / np.log(2.0),
                self.encounter_frequency / turn,
                self.phase / turn,
            ]
        )


def panel_tables(vertices: FloatArray, panels: IntArray) -> PanelTables:
    """Build the tables of a surface from vertices (V, 3) in ship axes [m] and panels (N, 4).

    Normals point into the water; a triangle repeats its third vertex. Raises PanelsimError for wrong shapes,
    coordinates that are not finite and indices that name no vertex.
    """
    vertices, panels = _checked_surface(vertices, panels)
    vertex_order = np.argsort(vertices[:, 2], kind="stable")
    rank = np.empty(len(vertex_order), dtype=np.int32)
    rank[vertex_order] = np.arange(len(vertex_order))
    panel_order = np.argsort(panel_centres(vertices, panels)[:, 2], kind="stable")
    panels = panels[panel_order]

    lower = _blocks_filled_up(vertices[vertex_order])
    points = np.concatenate([lower, _blocks_filled_up(panel_centres(vertices, panels))])
    ordered_panels = rank[panels]
    return PanelTables(
        points=_frozen(points),
        response={rule: _frozen(_responses(points, ordered_panels, len(lower), rule)) for rule in RULES},
        reach=_frozen(_reach(points, ordered_panels, len(lower))),
        panels=_frozen(ordered_panels),
        panel_order=_frozen(panel_order),
        first_centre=len(lower),
    )


def bend_shares(panels: NDArray[np.integer]) -> FloatArray:
    """Share (N,) of each panel that the centre's pressure above the mean of its corners takes in addition."""
    return np.where(panels[:, 2] == panels[:, 3], TRIANGLE_BEND, QUADRILATERAL_BEND)


def wave_tables(
    amplitude: ArrayLike,
    wavenumber: ArrayLike,
    wave_heading: ArrayLike,
    encounter_frequency: ArrayLike,
    phase: ArrayLike,
    *,
    second_order: bool = False,
) -> WaveTables:
    """Build the tables of a seaway from its components, each argument (M,) or a scalar for M = 1.

    Amplitude a [m], wavenumber k [rad/m], wave heading β [rad] (0 following, π/2 from port), signed
    encounter frequency ω - U k cos β [rad/s], phase ε [rad]; no components mean calm water;
    `second_order` adds the Stokes term to the elevation. Raises
    PanelsimError for unequal lengths, values that are not finite and negative wavenumbers.
    """
    given = (amplitude, wavenumber, wave_heading, encounter_frequency, phase)
    columns = [np.atleast_1d(np.asarray(column, dtype=np.float64)) for column in given]
    shapes = {column.shape for column in columns}
    if len(shapes) > 1 or columns[0].ndim != 1:
        raise PanelsimError(
            "The wave components do not have one value of each kind",
            got=", ".join(str(column.shape) for column in columns),
            allowed="five arrays of one length: amplitude, wavenumber, wave heading, "
            "encounter frequency, phase",
        )
    a, k, heading, frequency, lead = columns
    if not all(np.isfinite(column).all() for column in columns) or (k < 0.0).any():
        raise PanelsimError(
            "A wave component is not finite or has a negative wavenumber",
            got=f"wavenumbers from {k.min()} to {k.max()} rad/m, amplitudes from {a.min()} to {a.max()} m",
            allowed="finite numbers, wavenumbers not below 0",
            remedy="turn the wave heading by 180 degrees to reverse a wave",
        )
    columns = [_frozen(c) for c in (a, k * np.cos(heading), -k * np.sin(heading), k, frequency, lead)]
    return WaveTables(*columns, second_order=second_order)


def checked_poses(poses: FloatArray) -> FloatArray:
    """Poses (B, 8) as float64: time [s], factor on all amplitudes, η1..η3 [m], η4..η6 [rad].

    Raises PanelsimError if the shape is another or a value is not finite.
    """
    poses = np.asarray(poses, dtype=np.float64)
    if poses.ndim != 2 or poses.shape[1] != 8:
        raise PanelsimError(
            "The poses do not have the right shape",
            got=str(poses.shape),
            allowed="(B, 8): time, wave factor, surge, sway, heave, roll, pitch, yaw",
        )
    if not np.isfinite(poses).all():
        row = poses[~np.isfinite(poses).all(axis=1)][0]
        raise PanelsimError(
            "A pose of the ship is not finite",
            got=f"time, wave factor, surge to yaw = {row.tolist()}",
            allowed="finite numbers",
            remedy="the motion has diverged: try a shorter time step",
        )
    return poses


def require_stretching(stretching: str) -> None:
    """Raise PanelsimError unless `stretching` is one of STRETCHINGS."""
    if not (isinstance(stretching, str) and stretching in STRETCHINGS):
        raise PanelsimError(
            "The stretching of the wave pressure is not known",
            got=repr(stretching)[:60],
            allowed=", ".join(STRETCHINGS),
        )


def require_rule(rule: str) -> None:
    """Raise PanelsimError unless `rule` is one of RULES."""
    if not (isinstance(rule, str) and rule in RULES):
        raise PanelsimError(
            "The rule of the pressure integral is not known", got=repr(rule)[:60], allowed=", ".join(RULES)
        )


def _blocks_filled_up(points: FloatArray) -> FloatArray:
    """Points (P, 3) up to the next multiple of eight, the last one repeated: no panel uses the copies."""
    return points[np.minimum(np.arange(-(-len(points) // LANES) * LANES), len(points) - 1)]


def _responses(points: FloatArray, panels: NDArray[np.int32], first_centre: int, rule: str) -> FloatArray:
    """Load for unit pressure at each point: (P, 6), about the origin.

    A triangle of area vector nA gives each of its corners -nA/3 for the force and
    -((x_v + x_a + x_b + x_c)/12) × nA for the moment, the exact first moments of a linear pressure. By the
    rule "panel" the pressure at the centre is that of the whole panel.
    """
    centre = first_centre + np.arange(len(panels))
    triangles = np.stack(
        [np.repeat(centre[:, None], 4, axis=1), panels, np.roll(panels, -1, axis=1)], axis=-1
    )
    x = points[triangles]
    area_vector = 0.5 * np.cross(x[:, :, 1] - x[:, :, 0], x[:, :, 2] - x[:, :, 0])
    response = np.zeros((len(points), 6))
    if rule == "panel":
        moment = -np.cross(x.mean(axis=2), area_vector).sum(axis=1)
        response[centre] = np.concatenate([-area_vector.sum(axis=1), moment], axis=1)
        return response
    for corner in range(3):
        arm = (x[:, :, corner] + x.sum(axis=2)) / 12.0
        load = np.concatenate([-area_vector / 3.0, -np.cross(arm, area_vector)], axis=-1)
        np.add.at(response, triangles[..., corner], load)
    if rule == "vertex":
        handed_over = response[centre]
    else:
        whole = area_vector.sum(axis=1)
        bend = np.column_stack([-whole, -np.cross(points[centre], whole)])
        handed_over = -bend_shares(panels)[:, None] * bend
    response[centre] -= handed_over
    np.add.at(response, panels, corner_shares(panels)[:, :, None] * handed_over[:, None, :])
    return response


def _reach(points: FloatArray, panels: NDArray[np.int32], first_centre: int) -> FloatArray:
    """Distance from each point (P,) to the farthest point of the panels it belongs to [m]."""
    centre = first_centre + np.arange(len(panels))
    of_panel = np.column_stack([panels, centre])
    x = points[of_panel]
    farthest = np.linalg.norm(x[:, :, None] - x[:, None, :], axis=-1).max(axis=2)
    reach = np.zeros(len(points))
    np.maximum.at(reach, of_panel, farthest)
    return reach


def _checked_surface(vertices: FloatArray, panels: IntArray) -> tuple[FloatArray, IntArray]:
    vertices = np.asarray(vertices, dtype=np.float64)
    panels = np.asarray(panels)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or panels.ndim != 2 or panels.shape[1] != 4:
        raise PanelsimError(
            "The surface does not have the right shape",
            got=f"vertices {vertices.shape}, panels {panels.shape}",
            allowed="vertices (V, 3), panels (N, 4)",
            remedy="give a triangle as a panel that repeats its third vertex",
        )
    if not np.isfinite(vertices).all():
        bad = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
        raise PanelsimError(
            "A vertex of the surface is not finite", got=f"vertex {bad[0]} at {vertices[bad[0]].tolist()}"
        )
    if not np.issubdtype(panels.dtype, np.integer):
        raise PanelsimError("The panels are not vertex indices", got=str(panels.dtype), allowed="integers")
    if panels.size and (panels.min() < 0 or panels.max() >= len(vertices)):
        raise PanelsimError(
            "A panel names a vertex that does not exist",
            got=f"indices from {panels.min()} to {panels.max()}",
            allowed=f"0 to {len(vertices) - 1}",
        )
    return vertices, panels


def _frozen(array: NDArray[Scalar]) -> NDArray[Scalar]:
    array = array.copy()
    array.setflags(write=False)
    return array
