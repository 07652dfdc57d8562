"""Waves on a section: long waves, the Haskind relation, forward speed, the three-dimensional momentum."""

import numpy as np
import pytest

from panelsim.hydro.diffraction import diffraction_momentum
from panelsim.hydro.store import database_for
from panelsim.hydro.strip.frank import solve_section
from panelsim.hydro.strip.incident import diffraction_momentum_section, froude_krylov_section
from panelsim.hydro.strip.mesh_sections import sections_of_mesh
from panelsim.hydro.strip.sections import Section
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.ship.bundled import load_ship

G, RHO = 9.81, 1000.0
SWAY, HEAVE, ROLL = range(3)
SKEW = Section(0.0, np.array([[-1.2, -0.3], [-0.9, -1.0], [0.4, -1.6], [0.8, -1.2], [1.0, -0.3]]), -0.3)


def test_a_long_wave_lifts_and_pushes_as_hydrostatics_and_slope_say() -> None:
    omega = np.sqrt(G * np.array([1e-3]))
    solution = solve_section(SKEW, omega, water_density=RHO, gravity=G)
    k = omega**2 / G
    beta = np.pi / 2
    force = froude_krylov_section(solution.contour, k, np.array([beta]), water_density=RHO, gravity=G)[0]
    # The next terms are k times the size of the section, 1e-3 · 2.
    assert force[HEAVE] == pytest.approx(RHO * G * SKEW.breadth, rel=5e-3)
    # A crest that comes from port, exp(iky): the surface slopes, the fluid there accelerates with -dp/dy.
    assert force[SWAY] == pytest.approx(-1j * RHO * G * k[0] * SKEW.area, rel=1e-2)
    # ρ g times the waterline moment ∫ y dy = (1.0² - 1.2²)/2, lifted to port is positive.
    assert force[ROLL] == pytest.approx(RHO * G * 0.5 * (1.0**2 - 1.2**2), rel=1e-2, abs=RHO * G * 5e-3)


@pytest.mark.parametrize("beta", [np.pi / 2, -np.pi / 2])
def test_froude_krylov_and_diffraction_make_up_the_haskind_force(beta: float) -> None:
    omega = np.sqrt(G * np.array([0.2, 1.0]))
    solution = solve_section(SKEW, omega, water_density=RHO, gravity=G)
    heading = np.full(2, beta)
    force = froude_krylov_section(solution.contour, omega**2 / G, heading, water_density=RHO, gravity=G)
    momentum = diffraction_momentum_section(solution, solution.potential, omega, heading)
    force = force - 1j * omega[:, None] * momentum
    # Waves from port are those that the section would send to port. To rounding.
    expected = -RHO * G * solution.radiated_wave(to_port=beta > 0)
    np.testing.assert_allclose(force, expected, rtol=1e-10, atol=1e-8)


def test_at_speed_the_wave_keeps_its_own_length() -> None:
    """P_d of a wave of ω met at ω_e is linear in φ(ω_e) and carries i ω, not i ω_e."""
    omega, met = np.array([1.0]), np.array([2.0])
    solution = solve_section(SKEW, met, water_density=RHO, gravity=G)
    momentum = diffraction_momentum_section(solution, solution.potential, omega, np.array([np.pi]))[0]
    k = omega[0] ** 2 / G
    z = solution.contour.centre[:, 1]
    n3 = solution.contour.normal[:, 1]
    flow = 1j * omega[0] * n3 * np.exp(k * (z - SKEW.waterline)) * solution.contour.length
    # Midpoint rule over elements of k times 0.1 m.
    np.testing.assert_allclose(momentum, RHO * solution.potential[0] @ flow, rtol=1e-4)


# Tolerances of sway, heave, roll: half as much again as measured. In beam seas roll about the CG is a
# difference of two moments ten times as large.
@pytest.mark.parametrize(
    ("heading_deg", "speed", "tolerance"), [(90.0, 0.0, [0.05, 0.07, 0.5]), (120.0, 8.0, [0.08, 0.11, 0.13])]
)
def test_strips_of_the_frigate_scatter_what_her_panels_do(
    heading_deg: float, speed: float, tolerance: list[float]
) -> None:
    """Sign, phase and size of sway, heave and roll of the whole ship against three dimensions."""
    ship = load_ship("frigate")
    database = database_for(ship)
    omega, beta = np.array([0.8]), np.array([np.deg2rad(heading_deg)])
    encounter = encounter_frequency(omega, beta, speed, ship.gravity)
    sections = sections_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, 31)
    strips = np.zeros(3, dtype=complex)
    for length, section in zip(sections.strip_length, sections.sections, strict=True):
        solution = solve_section(section, encounter, water_density=ship.water_density, gravity=ship.gravity)
        momentum = diffraction_momentum_section(solution, solution.potential, omega, beta)[0]
        phase = np.exp(-1j * omega[0] ** 2 / ship.gravity * section.x * np.cos(beta[0]))
        strips += length * phase * momentum
    panels = diffraction_momentum(database, omega, beta, speed)[0, 1:4]
    assert (np.abs(strips - panels) / np.abs(panels) < tolerance).all()
