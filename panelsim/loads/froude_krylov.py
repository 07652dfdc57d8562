"""Linear incident-wave load: the slope of the nonlinear one with the wave amplitude, at rest."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray, IntArray, corner_shares, panel_centres
from panelsim.kernels.tables import bend_shares
from panelsim.kernels.wet_part import SPLITS
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship

# The wet part of a triangle with one, two or three wet corners, the odd one first: four corners, each the
# point where the water cuts the edge between two of the triangle's, or one of those twice.
WET_PARTS = np.array(
    [
        [[0, 0], [0, 1], [0, 2], [0, 2]],
        [[0, 1], [1, 1], [2, 2], [0, 2]],
        [[0, 0], [1, 1], [2, 2], [2, 2]],
    ]
)


def froude_krylov_transfer(ship: Ship, components: WaveComponents) -> ComplexArray:
    """Froude-Krylov load (M, 6) per unit wave amplitude, exp(+iω_e t), about the CG [N/m, N].

    Pressure ρ g exp(k z) exp(−i k(x cos β − y sin β)) (TM 2003-190 (10), without the factor ω_e/ω of
    (16), so that it does not depend on speed) over the hull below calm water, z from there. It is the
    derivative with amplitude, at none, of `WettedSurface` by the rule "vertex+centre" with Wheeler's
    stretching, panels that calm water cuts included.

    With c the crest exp(−i k(...)) at a point and d its depth, the depth grows by a c and, to first order,
    the head of a wet point is d + a (c + e), e = c (exp(−k d) − 1). On a triangle the linear part d + a c
    vanishes at the surface itself, so the surface that moves adds nothing: it gives c over the part that
    calm water wets, interpolated along the edges to the cuts. The rest, e, is 0 at the cuts. The bend, that
    of the centre above the mean of the corners, acts over the wet part; a dry point there goes on
    with c + d Σ w e / Σ w d of the wet ones, w being the shares in the panel and 1 for the centre.

    All this holds with vertices on the waterline, where crest and trough differ in second order only; a panel
    that lies in the water surface has no derivative and counts as dry. Without stretching e is not 0 at the
    cuts: the coefficients are the same where panels end at the waterline, and else differ by a part that
    falls with the square of the panel size.
    """
    points, response = _points_of_pressure(ship)
    k = components.wavenumber(ship.gravity)
    beta = components.wave_heading
    x, y, z = points[:, 0], points[:, 1], points[:, 2] - ship.waterline
    transfer = np.empty((components.count, 6), dtype=complex)
    for i in range(components.count):
        pressure = np.exp(k[i] * (z - 1j * (x * np.cos(beta[i]) - y * np.sin(beta[i]))))
        transfer[i] = ship.water_density * ship.gravity * (pressure @ response)
    return transfer


def _points_of_pressure(ship: Ship) -> tuple[FloatArray, FloatArray]:
    """Points (Q, 3) in ship axes, at or below calm water, and the load (Q, 6) of unit pressure at each.

    The wet corners and centres of the panels, and those of cut panels once more, moved to calm water.
    """
    panels, vertices = ship.mesh.panels, ship.vertices
    points = np.concatenate([vertices, panel_centres(vertices, panels)])
    depth = ship.waterline - points[:, 2]
    of_panel = np.column_stack([panels, len(vertices) + np.arange(len(panels))])
    below, at_surface = np.zeros((2, len(points), 6))
    wet_force = _add_wet_triangles(below, at_surface, points, depth, of_panel)
    _add_bend(below, at_surface, points, depth, of_panel, wet_force)
    on_surface = points.copy()
    on_surface[:, 2] = ship.waterline
    wet, used = depth > 0.0, at_surface.any(axis=1)
    return np.concatenate([points[wet], on_surface[used]]), np.concatenate([below[wet], at_surface[used]])


def _add_wet_triangles(
    below: FloatArray, at_surface: FloatArray, points: FloatArray, depth: FloatArray, of_panel: IntArray
) -> FloatArray:
    """Add the responses of the wet triangles, linear between points; give the force of each panel (N, 3).

    `below` and `at_surface` (P, 6) are those of the pressure at a point and on calm water there,
    `of_panel` (N, 5) the corners and the centre; the force is that of unit pressure on the wet part.
    """
    ends, origin = _wet_parts(depth, of_panel)
    start, end = ends[..., 0], ends[..., 1]
    cut = start != end
    t = np.divide(depth[start], depth[start] - depth[end], out=np.zeros(cut.shape), where=cut)[..., None]
    corners = points[start] + t * (points[end] - points[start])
    response = np.zeros((*cut.shape, 6))
    for split in SPLITS:
        response[:, split] += 0.5 * _corner_response(corners[:, split])
    np.add.at(below, start[~cut], response[~cut])
    np.add.at(at_surface, start[cut], ((1.0 - t) * response)[cut])
    np.add.at(at_surface, end[cut], (t * response)[cut])
    force = np.zeros((len(of_panel), 3))
    np.add.at(force, origin, response[..., :3].sum(axis=1))
    return force


def _wet_parts(depth: FloatArray, of_panel: IntArray) -> tuple[IntArray, IntArray]:
    """Wet parts of the triangles about the centres: corners between points (W, 4, 2), panels (W,)."""
    centre = np.repeat(of_panel[:, 4:], 4, axis=1)
    corners = of_panel[:, :4]
    triangles = np.stack([centre, corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 3)
    wet = depth[triangles] > 0.0
    count = wet.sum(axis=1)
    kept = np.flatnonzero(count)
    wet, count = wet[kept], count[kept]
    first = np.where(count == 1, wet.argmax(axis=1), wet.argmin(axis=1))
    turned = np.take_along_axis(triangles[kept], (first[:, None] + np.arange(3)) % 3, axis=1)
    return turned[np.arange(len(kept))[:, None, None], WET_PARTS[count - 1]], kept // 4


def _add_bend(
    below: FloatArray,
    at_surface: FloatArray,
    points: FloatArray,
    depth: FloatArray,
    of_panel: IntArray,
    wet_force: FloatArray,
) -> None:
    """Add the responses of what the centres have above the mean of the corners, on the wet parts."""
    shares, centre = corner_shares(of_panel[:, :4]), points[of_panel[:, 4]]
    bend = np.concatenate([wet_force, np.cross(centre, wet_force)], axis=1) * bend_shares(of_panel)[:, None]
    above_mean, weight = np.insert(-shares, 4, 1.0, axis=1), np.insert(shares, 4, 1.0, axis=1)
    of_point = depth[of_panel]
    wet = of_point > 0.0
    dry_depth = np.sum(above_mean * np.minimum(of_point, 0.0), axis=1, keepdims=True)
    wet_depth = np.sum(weight * np.maximum(of_point, 0.0), axis=1, keepdims=True)
    trend = weight * np.divide(dry_depth, wet_depth, out=np.zeros_like(dry_depth), where=wet_depth > 0.0)
    np.add.at(below, of_panel, np.where(wet, above_mean + trend, 0.0)[..., None] * bend[:, None])
    np.add.at(at_surface, of_panel, np.where(wet, -trend, above_mean)[..., None] * bend[:, None])


def _corner_response(corners: FloatArray) -> FloatArray:
    """Load (T, 3, 6) of unit pressure at each corner of triangles (T, 3, 3), linear between corners.

    −n A/3 for the force and −((x_c + Σ x)/12) × n A for the moment, exact for linear pressure.
    """
    area = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, None]
    arm = (corners + corners.sum(axis=1, keepdims=True)) / 12.0
    force = np.broadcast_to(-area / 3.0, corners.shape)
    return np.concatenate([force, -np.cross(arm, area)], axis=-1)
