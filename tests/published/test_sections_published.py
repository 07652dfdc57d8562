"""Heaving and swaying sections against published values and against another code in three dimensions.

Semicircle: J.H. Vugts, The hydrodynamic coefficients for swaying, heaving and rolling cylinders in a free
surface, International Shipbuilding Progress 15 (1968), whose curves are the theory of Ursell (1949) and its
extension to sway; points read off the figures, good to about 2 % of the largest. Frequencies are
ω √(B/2g), added mass over ρA, damping over ρA √(2g/B), sway force over ρ g A k ζ. His model tests, read off
the same figures, scatter by some 10 %.
Square: J.N. Newman, Marine Hydrodynamics (1977), table 4.3: 4.754 ρ a² in unbounded fluid, side 2a.
"""

from typing import Any

import capytaine as cpt
import numpy as np
import pytest

from panelsim.conventions import FloatArray
from panelsim.hydro.strip.frank import solve_section
from panelsim.hydro.strip.lewis import lewis_form
from panelsim.hydro.strip.multipoles import solve_lewis
from panelsim.hydro.strip.sections import Section
from panelsim.hydro.strip.solution import SectionSolution

G, RHO = 9.81, 1000.0
WATER: dict[str, Any] = {"water_density": RHO, "gravity": G}
AREA = np.pi / 2
SWAY, HEAVE, ROLL = range(3)
CIRCLE = lewis_form(2.0, 1.0, AREA)

HEAVE_MASS = [(0.309, 1.434), (0.413, 1.079), (0.524, 0.840), (0.644, 0.691), (0.771, 0.614), (0.887, 0.594)]
HEAVE_MASS += [(1.010, 0.607), (1.153, 0.640), (1.263, 0.678), (1.406, 0.724), (1.613, 0.775)]
SWAY_MASS = [(0.116, 1.017), (0.275, 1.108), (0.404, 1.244), (0.501, 1.303), (0.592, 1.238), (0.689, 1.045)]
SWAY_MASS += [(0.812, 0.715), (0.945, 0.457), (1.067, 0.315), (1.197, 0.237), (1.407, 0.193), (1.617, 0.187)]
SWAY_DAMPING = [
    (0.254, 0.007),
    (0.350, 0.036),
    (0.448, 0.106),
    (0.543, 0.260),
    (0.625, 0.439),
    (0.749, 0.663),
]
SWAY_DAMPING += [(0.866, 0.752), (1.009, 0.743), (1.182, 0.667), (1.408, 0.543), (1.615, 0.441)]
SWAY_FORCE = [(0.347, 2.005), (0.475, 1.960), (0.593, 1.780), (0.714, 1.459), (0.841, 1.048), (1.001, 0.676)]
SWAY_FORCE += [(1.247, 0.354), (1.468, 0.213), (1.625, 0.148)]
TEST_HEAVE_MASS = [
    (0.363, 1.049),
    (0.559, 0.803),
    (0.742, 0.647),
    (0.931, 0.608),
    (1.178, 0.681),
    (1.364, 0.747),
]
TEST_SWAY_MASS = [
    (0.252, 1.043),
    (0.437, 1.309),
    (0.683, 1.135),
    (0.867, 0.612),
    (1.051, 0.347),
    (1.239, 0.289),
]


def solved_circle(omega: FloatArray, method: str) -> SectionSolution:
    if method == "lewis":
        return solve_lewis(CIRCLE, omega * np.sqrt(G), **WATER)
    return solve_section(CIRCLE.section(2001), omega * np.sqrt(G), **WATER)


@pytest.mark.parametrize("method", ["frank", "lewis"])
class TestSemicircle:
    # 2 % of the largest: how well the figures can be read.
    @pytest.mark.parametrize(("mode", "curve"), [(HEAVE, HEAVE_MASS), (SWAY, SWAY_MASS)])
    def test_added_mass(self, method: str, mode: int, curve: list[tuple[float, float]]) -> None:
        omega, expected = np.array(curve).T
        computed = solved_circle(omega, method).added_mass[:, mode, mode] / (RHO * AREA)
        np.testing.assert_allclose(computed, expected, atol=0.02 * expected.max())

    def test_damping_in_sway(self, method: str) -> None:
        omega, expected = np.array(SWAY_DAMPING).T
        computed = solved_circle(omega, method).damping[:, SWAY, SWAY] / (RHO * AREA * np.sqrt(G))
        np.testing.assert_allclose(computed, expected, atol=0.02 * expected.max())

    def test_sway_force_of_beam_waves(self, method: str) -> None:
        omega, expected = np.array(SWAY_FORCE).T
        computed = np.abs(solved_circle(omega, method).radiated_wave()[:, SWAY]) / (AREA * omega**2)
        np.testing.assert_allclose(computed, expected, atol=0.02 * expected.max())

    @pytest.mark.parametrize(
        ("mode", "points", "scatter"), [(HEAVE, TEST_HEAVE_MASS, 0.25), (SWAY, TEST_SWAY_MASS, 0.15)]
    )
    def test_model_tests(
        self, method: str, mode: int, points: list[tuple[float, float]], scatter: float
    ) -> None:
        omega, expected = np.array(points).T
        computed = solved_circle(omega, method).added_mass[:, mode, mode] / (RHO * AREA)
        np.testing.assert_allclose(computed, expected, atol=scatter)


def test_square() -> None:
    """Half the double body: heave where φ = 0 at the surface, sway where the surface is a rigid lid."""
    points = np.array([[-1.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 0.0]])
    square = Section(0.0, points, 0.0)
    fast = solve_section(square, np.array([np.inf]), elements=160, **WATER)
    slow = solve_section(square, np.array([1e-3]), elements=160, **WATER)
    # 2e-3: the flow round the corners is singular, 160 elements leave 1e-3.
    assert fast.added_mass[0, HEAVE, HEAVE] == pytest.approx(0.5 * 4.754 * RHO, rel=2e-3)
    assert slow.added_mass[0, SWAY, SWAY] == pytest.approx(0.5 * 4.754 * RHO, rel=2e-3)


def barge(length: float) -> cpt.FloatingBody:
    """A barge of beam 2 m and draft 1 m, its port half mirrored."""
    x = np.linspace(-length / 2, length / 2, round(length / 0.6) + 1)
    y = np.sin(np.linspace(0.0, np.pi / 2, 6))
    z = -0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 7))
    bottom = [[(a, b, -1.0) for a in x] for b in y]
    side = [[(a, 1.0, c) for a in x] for c in z]
    ends = [[[(s * length / 2, b, c) for c in z[:: int(s)]] for b in y] for s in (1.0, -1.0)]
    vertices, panels = [], []
    for patch in (bottom, side, *ends):
        rows, columns = len(patch), len(patch[0])
        start = len(vertices)
        vertices += [point for row in patch for point in row]
        corner = start + np.arange(rows * columns).reshape(rows, columns)
        panels.append(np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=-1))
    faces = np.concatenate([p.reshape(-1, 4) for p in panels])
    half = cpt.Mesh(np.array(vertices), faces, auto_check=False)
    mesh = cpt.ReflectionSymmetricMesh(half=half, plane="xOz")
    return cpt.FloatingBody(mesh=mesh, dofs=cpt.rigid_body_dofs(rotation_center=(0.0, 0.0, 0.0)))


def test_box_against_the_middle_of_long_barges_in_three_dimensions() -> None:
    """What a barge gains when it is lengthened is the section; sway, heave, roll and their coupling."""
    omega = float(np.sqrt(G * 0.8))
    dofs = ["Sway", "Heave", "Roll"]
    coefficients = []
    for length in (18.0, 27.0):
        body = barge(length)
        volumes = np.array(body.mesh.merged().volumes)
        np.testing.assert_allclose(volumes, 2.0 * length, rtol=1e-6)  # every panel looks outwards
        problems = [
            cpt.RadiationProblem(body=body, radiating_dof=dof, omega=omega, rho=RHO, g=G) for dof in dofs
        ]
        results = cpt.BEMSolver(method="direct").solve_all(problems, progress_bar=False)
        data = cpt.assemble_dataset(results).sel(radiating_dof=dofs, influenced_dof=dofs)
        coefficients.append(data.added_mass.values[0] + data.radiation_damping.values[0] / (1j * omega))
    gained = (coefficients[1] - coefficients[0]) / 9.0
    points = np.array([[-1.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 0.0]])
    solution = solve_section(Section(0.0, points, 0.0), np.array([omega]), **WATER)
    section = solution.added_mass[0] + solution.damping[0] / (1j * omega)
    size = np.sqrt(np.abs(np.outer(np.diag(section), np.diag(section))))
    # 5 %: ends of a barge of 2.3 wave lengths and coarse panels; measured 2 % on finer ones.
    assert (np.abs(gained - section) / size).max() < 0.05
