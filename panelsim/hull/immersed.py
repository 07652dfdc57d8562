"""The part of a hull below a water plane: exact cut of its triangles and exact integrals over it."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray, IntArray, panel_triangles, rotation_to_earth
from panelsim.hull.panel_mesh import PanelMesh

ON_PLANE = 1e-9  # a vertex this part of the hull's size off the plane lies on it, for counts and extents


def immersed_triangles(corners: FloatArray, waterline: float) -> tuple[FloatArray, IntArray]:
    """Cut triangles (T, 3, 3) exactly at z = waterline and keep what lies below.

    Corners [m] in axes with z up. Returns the corners (W, 3, 3) of what is left, in the sense of the
    originals, and whose piece each is (W,). A vertex on the plane counts as neither wet nor dry: a triangle
    that only touches the plane from above is left out, one that only touches it from below is kept whole.
    """
    submergence = waterline - corners[..., 2]
    some_wet = (submergence > 0.0).any(axis=1)
    some_dry = (submergence < 0.0).any(axis=1)
    whole = np.flatnonzero(some_wet & ~some_dry)
    cut = np.flatnonzero(some_wet & some_dry)
    pieces, origin = _wet_pieces(corners[cut], submergence[cut], waterline)
    return np.concatenate([corners[whole], pieces]), np.concatenate([whole, cut[origin]])


def _wet_pieces(
    corners: FloatArray, submergence: FloatArray, waterline: float
) -> tuple[FloatArray, IntArray]:
    """Wet pieces (P, 3, 3) of triangles (C, 3, 3) that have wet and dry corners, and whose piece each is."""
    wet = submergence > 0.0
    one_wet = wet.sum(axis=1) == 1
    # Turn each triangle so that the corner that is alone on its side of the water comes first.
    first = np.where(one_wet, wet.argmax(axis=1), wet.argmin(axis=1))
    order = (first[:, None] + np.arange(3)) % 3
    p = np.take_along_axis(corners, order[:, :, None], axis=1)
    d = np.take_along_axis(submergence, order, axis=1)
    t = d[:, :1] / (d[:, :1] - d[:, 1:])
    cuts = p[:, :1] + t[:, :, None] * (p[:, 1:] - p[:, :1])
    cuts[..., 2] = waterline
    tip = np.stack([p[:, 0], cuts[:, 0], cuts[:, 1]], axis=1)[one_wet]
    near = np.stack([cuts[:, 0], p[:, 1], p[:, 2]], axis=1)[~one_wet]
    far = np.stack([cuts[:, 0], p[:, 2], cuts[:, 1]], axis=1)[~one_wet]
    alone, paired = np.flatnonzero(one_wet), np.flatnonzero(~one_wet)
    return np.concatenate([tip, near, far]), np.concatenate([alone, paired, paired])


@dataclass(frozen=True)
class ImmersedPart:
    """Integrals over the part of a hull below a water plane, in level axes.

    Level axes have the hull's origin (midships, centreline, baseline) and are turned with the hull's heel
    and trim, so that z is vertical. `volume` [m3], `volume_moment` (3,) = ∫(x, y, z) dV [m4];
    `waterplane_area` [m2], `waterplane_moment` (2,) = ∫(x, y) dA [m3] and `waterplane_second_moment`
    (2, 2) = ∫(x, y)(x, y)ᵀ dA [m4], all about the origin; `wetted_surface` [m2]; `waterline_length` and
    `waterline_beam`, the extents of the waterline along x and y [m]; `panels_wet`, panels with a part under
    the water.
    """

    volume: float
    volume_moment: FloatArray
    waterplane_area: float
    waterplane_moment: FloatArray
    waterplane_second_moment: FloatArray
    wetted_surface: float
    waterline_length: float
    waterline_beam: float
    panels_wet: int


def level_vertices(mesh: PanelMesh, heel: float, trim: float) -> FloatArray:
    """Vertices (V, 3) [m] of a mesh in level axes: turned by heel and trim [rad] about the hull's origin."""
    return mesh.vertices @ rotation_to_earth(heel, trim, 0.0).T


def immersed_part(mesh: PanelMesh, *, heel: float, trim: float, waterline: float) -> ImmersedPart:
    """Integrate over the part of the hull below z = waterline [m] in level axes; heel and trim in rad.

    Volume and waterplane both follow from the wetted surface by the divergence theorem: with z counted
    from the water plane, ∫ f z n_z dS over the wetted surface is the volume integral of f(x, y), and
    -∫ f n_z dS its waterplane integral; the plane that closes the volume adds nothing to the first. All
    integrands are quadratic at most, so the mean over the three edge midpoints of a triangle is exact.
    """
    vertices = level_vertices(mesh, heel, trim)
    triangles = panel_triangles(vertices, mesh.panels).reshape(-1, 3, 3)
    corners, _ = immersed_triangles(triangles, waterline)

    area_vector = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    x, y, z = np.moveaxis(0.5 * (corners + np.roll(corners, -1, axis=1)), -1, 0)
    z = z - waterline
    flux = (area_vector[:, 2] / 3.0)[:, None]

    volume = float(np.sum(z * flux))
    moment_z = float(np.sum(0.5 * z * z * flux)) + waterline * volume
    second_xy = -np.sum(x * y * flux)
    tolerance = ON_PLANE * float(np.ptp(mesh.vertices, axis=0).max(initial=0.0))
    on_plane = corners[np.abs(corners[..., 2] - waterline) <= tolerance]
    extent = np.ptp(on_plane, axis=0) if len(on_plane) else np.zeros(3)
    deepest = waterline - vertices[mesh.panels, 2].min(axis=1)
    return ImmersedPart(
        volume=volume,
        volume_moment=np.array([np.sum(x * z * flux), np.sum(y * z * flux), moment_z]),
        waterplane_area=float(-np.sum(flux) * 3.0),
        waterplane_moment=np.array([-np.sum(x * flux), -np.sum(y * flux)]),
        waterplane_second_moment=np.array(
            [[-np.sum(x * x * flux), second_xy], [second_xy, -np.sum(y * y * flux)]]
        ),
        wetted_surface=float(np.sum(np.linalg.norm(area_vector, axis=1))),
        waterline_length=float(extent[0]),
        waterline_beam=float(extent[1]),
        panels_wet=int(np.sum(deepest > tolerance)),
    )
