"""Heave of a floating hemisphere against Hulme, J. Fluid Mech. 121 (1982), table 1."""

import numpy as np
import pytest

from panelsim.conventions import Dof, FloatArray, IntArray
from panelsim.hydro.bem import solve_radiation

RADIUS, DENSITY, GRAVITY = 5.0, 1000.0, 9.80665
# Ka, added mass over ρ 2/3 π a³, damping over ρ ω 2/3 π a³; to where the finest mesh has 8 panels a wave.
HULME = np.array(
    [
        [0.0, 0.8310, 0.0000],
        [0.1, 0.8627, 0.1816],
        [0.3, 0.7157, 0.3254],
        [0.5, 0.5861, 0.3391],
        [0.7, 0.4999, 0.3098],
        [0.9, 0.4464, 0.2691],
        [1.2, 0.4047, 0.2096],
        [1.6, 0.3871, 0.1469],
        [2.0, 0.3884, 0.1031],
        [3.0, 0.4111, 0.0452],
    ]
)


def hemisphere(rings: int) -> tuple[FloatArray, IntArray]:
    """Lower half sphere about the origin, quadrilaterals between meridians and parallels."""
    columns = 4 * rings
    polar = np.linspace(np.pi, np.pi / 2, rings + 1)
    azimuth = np.linspace(0.0, 2 * np.pi, columns + 1)[:-1]
    p, a = np.meshgrid(polar, azimuth, indexing="ij")
    vertices = RADIUS * np.stack([np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p)], axis=-1)
    index = np.arange(vertices[..., 0].size).reshape(p.shape)
    following = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], following[:-1], following[1:], index[1:]], axis=-1)
    # The parallel at the pole is one point; its panels are triangles with the third vertex repeated.
    quads[0] = np.stack([following[1], index[1], index[0], index[0]], axis=-1)
    return vertices.reshape(-1, 3), quads.reshape(-1, 4)


@pytest.fixture(scope="module")
def by_rings() -> dict[int, tuple[FloatArray, FloatArray]]:
    """Added mass and damping over Hulme's scales on three meshes, and A(∞) as the last added mass."""
    frequencies = np.sqrt(HULME[:, 0] * GRAVITY / RADIUS)
    scale = DENSITY * 2 / 3 * np.pi * RADIUS**3
    results = {}
    for rings in (5, 7, 10):
        dataset = solve_radiation(
            *hemisphere(rings), 0.0, water_density=DENSITY, gravity=GRAVITY, frequencies=frequencies
        )
        heave = np.append(
            dataset.added_mass[:, Dof.HEAVE, Dof.HEAVE], dataset.added_mass_infinite[Dof.HEAVE, Dof.HEAVE]
        )
        damping = dataset.radiation_damping.values[:, Dof.HEAVE, Dof.HEAVE]
        over_frequency = np.divide(damping, frequencies, out=np.zeros_like(damping), where=frequencies > 0)
        results[rings] = heave / scale, over_frequency / scale
    return results


def richardson(coarse: FloatArray, fine: FloatArray, ratio: float) -> FloatArray:
    """Limit of vanishing panels for an error that goes with their area."""
    return (ratio**2 * fine - coarse) / (ratio**2 - 1)


def test_heave_coefficients_converge_to_hulme(by_rings: dict[int, tuple[FloatArray, FloatArray]]) -> None:
    added_mass = richardson(by_rings[7][0], by_rings[10][0], 10 / 7)
    damping = richardson(by_rings[7][1], by_rings[10][1], 10 / 7)
    error_a = added_mass[:-1] / HULME[:, 1] - 1
    # Where the damping has died out a hundredth of it is below the four printed digits: then of the peak.
    error_b = (damping - HULME[:, 2]) / np.maximum(HULME[:, 2], 0.1 * HULME[:, 2].max())
    print("added mass", np.round(100 * error_a, 2), "damping", np.round(100 * error_b, 2), "%")
    # The table has four digits; what is left is the Green function's tabulation and the lid.
    assert np.abs(error_a).max() < 0.01
    assert np.abs(error_b).max() < 0.01


def test_infinite_frequency_limit_is_half_the_displaced_mass(
    by_rings: dict[int, tuple[FloatArray, FloatArray]],
) -> None:
    """A double body on which the surface potential vanishes: the classical sphere, A33(∞) = ½ ρ ∇."""
    infinite = richardson(by_rings[7][0], by_rings[10][0], 10 / 7)[-1]
    print("A33(inf)", infinite)
    assert infinite == pytest.approx(0.5, rel=0.005)


def test_error_goes_with_panel_area(by_rings: dict[int, tuple[FloatArray, FloatArray]]) -> None:
    exact = HULME[2:7, 1]
    errors = [np.abs(by_rings[rings][0][2:7] - exact).mean() for rings in (5, 7, 10)]
    order = -np.polyfit(np.log([5, 7, 10]), np.log(errors), 1)[0]
    print("errors", errors, "order", order)
    assert order > 1.5  # constant panels: two, less where the lid ends short of the waterline
