"""Froude-Krylov load of our own hull, to hold that of another program against or to take from its sum."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray, panel_triangles
from panelsim.hull.immersed import immersed_triangles
from panelsim.seaway.dispersion import wavenumber
from panelsim.ship.ship import Ship


def froude_krylov(ship: Ship, frequency: FloatArray, wave_heading: FloatArray) -> ComplexArray:
    """-∫ p (n, r × n) dS (W, H, 6) [N/m, N] over the hull under calm water.

    p = ρ g exp(kz - ik(x cos β - y sin β)), TM 2003-190 (10) without the factor ω_e/ω of (16). About the CG
    in ship axes, exp(+iωt), the phase that of a crest at the CG; `frequency` (W,) [rad/s], `wave_heading`
    (H,) [rad]. Three points a triangle.
    """
    triangles = panel_triangles(ship.vertices, ship.mesh.panels).reshape(-1, 3, 3)
    corners, _ = immersed_triangles(triangles, ship.waterline)
    area = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # Edge midpoints integrate quadratics exactly.
    points = (0.5 * (corners + np.roll(corners, -1, axis=1))).reshape(-1, 3)
    force = -np.repeat(area / 3.0, 3, axis=0) * ship.water_density * ship.gravity
    response = np.hstack([force, np.cross(points, force)])
    x, y, z = points.T
    along = np.outer(np.cos(wave_heading), x) - np.outer(np.sin(wave_heading), y)
    k = wavenumber(frequency, ship.gravity)
    return np.array([np.exp(each * (z - ship.waterline - 1j * along)) @ response for each in k])
