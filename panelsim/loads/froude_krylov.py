"""Linear incident-wave load: the wave pressure on the hull in its mean position."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray, corner_shares, panel_triangles
from panelsim.hull.immersed import immersed_triangles
from panelsim.kernels.tables import bend_shares
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship

AT_SURFACE = 1e-9  # m: meshes end at the waterline to rounding


def froude_krylov_transfer(ship: Ship, components: WaveComponents) -> ComplexArray:
    """Froude-Krylov load (M, 6) per unit wave amplitude, exp(+iω_e t), about the CG [N/m, N].

    Pressure ρ g exp(k z) exp(−i k(x cos β − y sin β)) (TM 2003-190 (10), without the factor ω_e/ω of
    (16), so that it does not depend on speed) at the points of the wet hull, by the rule "vertex+centre"
    of the nonlinear load, so that both agree in small waves.
    """
    points, response = _wet_points(ship)
    k = components.wavenumber(ship.gravity)
    beta = components.wave_heading
    x, y, z = points[:, 0], points[:, 1], points[:, 2] - ship.waterline
    transfer = np.empty((components.count, 6), dtype=complex)
    for i in range(components.count):
        pressure = np.exp(k[i] * (z - 1j * (x * np.cos(beta[i]) - y * np.sin(beta[i]))))
        transfer[i] = ship.water_density * ship.gravity * (pressure @ response)
    return transfer


def _wet_points(ship: Ship) -> tuple[FloatArray, FloatArray]:
    """Points (P, 3) of the hull below calm water, in ship axes, and their loads (P, 6) of unit pressure.

    The corners of the wet triangles, between which the pressure is linear; then, for its bend, centre and
    corners of the panels that are wholly wet. The panels that calm water cuts have none here, which leaves
    out a share of the bend that falls with the panel size.
    """
    panels = ship.mesh.panels
    triangles = panel_triangles(ship.vertices, panels)
    corners, _ = immersed_triangles(triangles.reshape(-1, 3, 3), ship.waterline)
    wet = (triangles[..., 2] <= ship.waterline + AT_SURFACE).all(axis=(1, 2))
    panels, triangles = panels[wet], triangles[wet]
    centre = triangles[:, 0, 0]
    area = _area_vector(triangles.reshape(-1, 3, 3)).reshape(-1, 4, 3).sum(axis=1)
    bend = -bend_shares(panels)[:, None] * np.concatenate([area, np.cross(centre, area)], axis=1)
    shares = np.insert(-corner_shares(panels), 0, 1.0, axis=1)
    points = np.concatenate([centre[:, None], triangles[:, :, 1]], axis=1)
    return (
        np.concatenate([corners.reshape(-1, 3), points.reshape(-1, 3)]),
        np.concatenate(
            [
                _corner_response(corners).reshape(-1, 6),
                (shares[:, :, None] * bend[:, None, :]).reshape(-1, 6),
            ]
        ),
    )


def _corner_response(corners: FloatArray) -> FloatArray:
    """Load (T, 3, 6) of unit pressure at each corner of triangles (T, 3, 3), linear between corners.

    −n A/3 for the force and −((x_c + Σ x)/12) × n A for the moment, exact for linear pressure.
    """
    area = _area_vector(corners)[:, None]
    arm = (corners + corners.sum(axis=1, keepdims=True)) / 12.0
    force = np.broadcast_to(-area / 3.0, corners.shape)
    return np.concatenate([force, -np.cross(arm, area)], axis=-1)


def _area_vector(corners: FloatArray) -> FloatArray:
    """Area times normal (T, 3) of triangles."""
    return 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
