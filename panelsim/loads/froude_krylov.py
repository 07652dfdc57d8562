"""Linear incident-wave load: the wave pressure on the hull in its mean position."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.hull.immersed import immersed_triangles
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship


def froude_krylov_transfer(ship: Ship, components: WaveComponents) -> ComplexArray:
    """Froude-Krylov load (M, 6) per unit wave amplitude, exp(+iω_e t), about the CG [N/m, N].

    Pressure ρ g exp(k z) exp(−i k(x cos β − y sin β)) (TM 2003-190 (10), without the factor ω_e/ω of
    (16), so that it does not depend on speed) at the corners of the wet triangles, linear
    between them: the rule of the nonlinear load, so that both agree in small waves.
    """
    triangles = ship.mesh.split_triangles
    weights = np.full(len(triangles), 0.5)
    corners, weights = immersed_triangles(ship.vertices, triangles, weights, ship.waterline)
    response = corner_response(corners, weights)
    k = components.wavenumber(ship.gravity)
    beta = components.wave_heading
    x, y, z = corners[..., 0], corners[..., 1], corners[..., 2] - ship.waterline
    transfer = np.empty((components.count, 6), dtype=complex)
    for i in range(components.count):
        pressure = np.exp(k[i] * (z - 1j * (x * np.cos(beta[i]) - y * np.sin(beta[i]))))
        transfer[i] = ship.water_density * ship.gravity * np.einsum("tc,tcl->l", pressure, response)
    return transfer


def corner_response(corners: FloatArray, weights: FloatArray) -> FloatArray:
    """Load (T, 3, 6) of unit pressure at each corner of triangles (T, 3, 3), linear between corners.

    −n A/3 for the force and −((x_c + Σ x)/12) × n A for the moment, exact for linear pressure.
    """
    area = weights[:, None] * 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    arm = (corners + corners.sum(axis=1, keepdims=True)) / 12.0
    force = np.broadcast_to(-area[:, None] / 3.0, corners.shape)
    return np.concatenate([force, -np.cross(arm, area[:, None])], axis=-1)
