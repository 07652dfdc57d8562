"""Diffraction by Green's identity: against direct solutions, Haskind's relation, limits and symmetries."""

from dataclasses import dataclass
from typing import Any

import capytaine as cpt
import numpy as np
import pytest

from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hydro import bem, diffraction
from panelsim.hydro.bem import solve_radiation
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import (
    beyond_resolution,
    diffraction_load,
    diffraction_momentum,
    radiation_potential,
)
from panelsim.ship.ship import Ship

GRAVITY, DENSITY, SPEED = 9.80665, 1025.0, 10.29
FREQUENCIES = np.array([0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2])


@dataclass(frozen=True)
class Solved:
    """A coarse frigate, its database and the same body for direct solutions."""

    ship: Ship
    database: HydroDatabase
    body: Any

    def direct(self, encounter: float, normal_flow: ComplexArray) -> ComplexArray:
        """Momentum -ρ ∫ φ_D n dS (6,) of the flow that cancels ∂φ_I/∂n (panels,), in exp(+iω_e t).

        Capytaine's factor is exp(-iωt) and its frequency positive, hence the conjugates.
        """
        flow = normal_flow if encounter < 0.0 else normal_flow.conj()
        boundary = np.zeros(self.body.mesh_including_lid.nb_faces, dtype=complex)
        boundary[self.body.hull_mask] = -flow
        problem = cpt.bem.problems_and_results.LinearPotentialFlowProblem(
            body=self.body, omega=abs(encounter), rho=DENSITY, g=GRAVITY, boundary_condition=boundary
        )
        with bem._quiet_single_threaded_capytaine():
            result = cpt.BEMSolver(method="direct").solve(problem, _check_wavelength=False)
        potential = result.potential[self.body.hull_mask]
        areas = bem._generalised_area(self.body.mesh, self.ship.waterline)
        return -DENSITY * areas @ (potential if encounter < 0.0 else potential.conj())

    def normal_flow(self, omega: float, heading: float) -> ComplexArray:
        """∂φ_I/∂n (panels,) of a wave of 1 m at the panel centres, exp(+iω_e t)."""
        k = omega**2 / GRAVITY
        x, y, z = self.body.mesh.faces_centers.T
        wave = 1j * GRAVITY / omega * np.exp(k * z - 1j * k * (x * np.cos(heading) - y * np.sin(heading)))
        gradient = k * np.array([-1j * np.cos(heading), 1j * np.sin(heading), 1.0])
        return wave * (self.body.mesh.faces_normals @ gradient)

    def froude_krylov(self, omega: float, heading: float) -> ComplexArray:
        """-∫ p n dS (6,) of the incident wave of 1 m, p = ρ g ζ exp(kz)."""
        k = omega**2 / GRAVITY
        x, y, z = self.body.mesh.faces_centers.T
        pressure = DENSITY * GRAVITY * np.exp(k * z - 1j * k * (x * np.cos(heading) - y * np.sin(heading)))
        return -bem._generalised_area(self.body.mesh, self.ship.waterline) @ pressure


@pytest.fixture(scope="module")
def solved() -> Solved:
    form = load_hull("frigate")
    mesh = form.panel(10.0)
    ship = Ship(mesh, draft=4.2, center_of_gravity=(None, 0.0, 6.0), gyradii=(4.8, 30.0, 30.0))
    dataset = solve_radiation(
        ship.vertices,
        mesh.panels,
        ship.waterline,
        water_density=DENSITY,
        gravity=GRAVITY,
        frequencies=FREQUENCIES,
    )
    with bem._quiet_single_threaded_capytaine() as capytaine:
        hull, _, half_hull = bem._wet_hull(capytaine, ship.vertices, mesh.panels, ship.waterline)
        body = bem._floating_body(capytaine, hull, half_hull=half_hull, waterline=ship.waterline)
    return Solved(ship, HydroDatabase(dataset), body)


def shares(difference: ComplexArray, reference: ComplexArray) -> FloatArray:
    """Errors (6,) over the largest force and the largest moment of the wave."""
    scale = np.repeat([np.abs(reference[:3]).max(), np.abs(reference[3:]).max()], 3)
    return np.abs(difference) / scale


@pytest.mark.parametrize("heading_deg", [180, 150, 90, 30])
def test_zero_speed_load_is_that_of_a_direct_solution(solved: Solved, heading_deg: int) -> None:
    """Capytaine's own diffraction force, amplitude and phase; its heading is -β, its factor exp(-iωt)."""
    heading = np.radians(heading_deg)
    for omega in (0.3, 0.5, 0.7):
        with bem._quiet_single_threaded_capytaine():
            problem = cpt.DiffractionProblem(
                body=solved.body, omega=omega, wave_direction=-heading, rho=DENSITY, g=GRAVITY
            )
            result = cpt.BEMSolver(method="direct").solve(problem, _check_wavelength=False)
        direct = np.conj([result.forces[dof] for dof in solved.body.dofs])
        load = diffraction_load(solved.database, np.array([omega]), np.array([heading]), 0.0)[0]
        error = shares(load - direct, direct)
        print(heading_deg, omega, np.round(100 * error, 2), "%")
        # Green's identity is exact; its discrete form misses by the asymmetry of the panel solution, 0.6 %
        # on these 98 panels a side and 0.1 % on 400.
        assert error.max() < 0.01


@pytest.mark.parametrize(("heading_deg", "omega"), [(180, 0.5), (150, 0.6), (30, 0.5), (30, 0.8), (30, 1.4)])
def test_momentum_at_speed_is_that_of_a_direct_solution(
    solved: Solved, heading_deg: int, omega: float
) -> None:
    """Wave of its own length at the frequency of encounter; at 30° and 1.4 rad/s the ship overtakes it."""
    heading = np.radians(heading_deg)
    encounter = omega - omega**2 / GRAVITY * SPEED * np.cos(heading)
    direct = solved.direct(encounter, solved.normal_flow(omega, heading))
    momentum = diffraction_momentum(solved.database, np.array([omega]), np.array([heading]), SPEED)[0]
    error = shares(momentum - direct, direct)
    print(f"{heading_deg} deg, encounter {encounter:.3f} rad/s:", np.round(100 * error, 2), "%")
    # Interpolation in frequency and four points a panel against one come on top: 3 % on this coarse mesh.
    assert error.max() < 0.03


def test_damping_follows_from_the_exciting_force(solved: Solved) -> None:
    """Haskind and Newman: B33 = k / (8π ρ g c_g) ∫ |X3|² dβ with c_g = g/2ω."""
    headings = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    for index in (7, 10, 12):
        omega = FREQUENCIES[index]
        incident = np.array([solved.froude_krylov(omega, b)[Dof.HEAVE] for b in headings])
        scattered = diffraction_load(solved.database, np.full(24, omega), headings, 0.0)[:, Dof.HEAVE]
        k, group_velocity = omega**2 / GRAVITY, GRAVITY / (2.0 * omega)
        energy = np.mean(np.abs(incident + scattered) ** 2) * 2.0 * np.pi
        damping = k / (8.0 * np.pi * DENSITY * GRAVITY * group_velocity) * energy
        stored = solved.database.radiation_damping[index, Dof.HEAVE, Dof.HEAVE]
        print(omega, damping / stored)
        # Measured 1 % at most; the incident wave alone gives 60 % too much.
        assert damping == pytest.approx(stored, rel=0.02)


@pytest.mark.parametrize(("heading", "phase"), [(np.pi, -90.0), (0.0, 90.0)])
def test_ship_rides_long_waves_at_speed(solved: Solved, heading: float, phase: float) -> None:
    """Heave 1, pitch k, a quarter period from the crest, as at rest: every sign of the speed terms in one.

    Without Lᵀ in the diffraction the pitch would be 0.51 k in head and 1.72 k in following waves.
    """
    omega = 0.25
    k = omega**2 / GRAVITY
    encounter = omega - k * SPEED * np.cos(heading)
    coupling = np.zeros((6, 6))
    coupling[Dof.HEAVE, Dof.PITCH], coupling[Dof.SWAY, Dof.YAW] = SPEED, -SPEED
    database, ship = solved.database, solved.ship
    added = [
        np.interp(encounter, FREQUENCIES, database.added_mass[:, i, j]) for i in range(6) for j in range(6)
    ]
    damping = [
        np.interp(encounter, FREQUENCIES, database.radiation_damping[:, i, j])
        for i in range(6)
        for j in range(6)
    ]
    complex_mass = np.reshape(added, (6, 6)) + np.reshape(damping, (6, 6)) / (1j * encounter)
    rate = 1j * encounter * np.eye(6)
    radiation = (rate - coupling.T) @ complex_mass @ (rate + coupling)
    exciting = solved.froude_krylov(omega, heading)
    exciting += diffraction_load(database, np.array([omega]), np.array([heading]), SPEED)[0]
    vertical = np.ix_([2, 4], [2, 4])
    system = -(encounter**2) * ship.inertia + radiation + ship.hydrostatics.stiffness
    heave, pitch = np.linalg.solve(system[vertical], exciting[[2, 4]])
    print(abs(heave), abs(pitch) / k, np.degrees(np.angle([heave, pitch])))
    assert abs(heave) == pytest.approx(1.0, abs=0.04)
    assert abs(pitch) / k == pytest.approx(1.03, abs=0.05)  # 1.04 at 12.8 lengths, 1.08 at 5.7
    assert np.degrees(np.angle(heave)) == pytest.approx(0.0, abs=4.0)
    assert np.degrees(np.angle(pitch)) == pytest.approx(phase, abs=4.0)


def test_speed_terms_are_the_convected_momentum(solved: Solved) -> None:
    """F5 gains +U P3, F6 gains -U P2, nothing else: F = (-iω_e + Lᵀ) P."""
    omega, heading = np.array([0.6]), np.array([2.5])
    momentum = diffraction_momentum(solved.database, omega, heading, SPEED)[0]
    encounter = omega[0] - omega[0] ** 2 / GRAVITY * SPEED * np.cos(heading[0])
    extra = diffraction_load(solved.database, omega, heading, SPEED)[0] + 1j * encounter * momentum
    expected = np.zeros(6, dtype=complex)
    expected[Dof.PITCH], expected[Dof.YAW] = SPEED * momentum[Dof.HEAVE], -SPEED * momentum[Dof.SWAY]
    assert extra == pytest.approx(expected, rel=1e-12, abs=1e-9 * np.abs(momentum).max())


def test_long_wave_momentum_is_the_added_mass_in_still_flow(solved: Solved) -> None:
    """A hull held in a wave much longer than itself: P = -(A + B/iω_e) times the velocity of the water."""
    omega, heading = 0.1, np.pi / 2
    momentum = diffraction_momentum(solved.database, np.array([omega]), np.array([heading]), 0.0)[0]
    a = solved.database.added_mass[2] + solved.database.radiation_damping[2] / (1j * omega)
    # ζ = cos(ωt + k y): up with iω, towards starboard under the crest, -ω.
    assert momentum[Dof.HEAVE] == pytest.approx(-a[2, 2] * 1j * omega, rel=0.03)
    assert momentum[Dof.SWAY] == pytest.approx(a[1, 1] * omega, rel=0.03)


def test_waves_from_the_other_side_turn_sway_roll_and_yaw(solved: Solved) -> None:
    one, other = diffraction_load(solved.database, np.array([0.7, 0.7]), np.radians([150.0, -150.0]), SPEED)
    mirror = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    assert other == pytest.approx(mirror * one, rel=1e-9)
    assert np.abs(one[[1, 3, 5]]).min() > 1e3


def test_potential_of_an_overtaken_wave_is_the_conjugate(solved: Solved) -> None:
    ahead, overtaken = radiation_potential(solved.database, np.array([0.43, -0.43]))
    assert np.array_equal(overtaken, ahead.conj())
    assert np.abs(ahead.imag).max() > 0.0


def test_load_is_smooth_through_zero_encounter_frequency(solved: Solved) -> None:
    """Following wave, ship as fast as the wave: ω_e passes 0 and the load with it, without a jump."""
    omega = np.array([0.8])
    speeds = GRAVITY / omega[0] * (1.0 + np.array([-2e-3, -1e-3, 0.0, 1e-3, 2e-3]))
    loads = np.array([diffraction_load(solved.database, omega, np.array([0.0]), u)[0] for u in speeds])
    assert np.isfinite(loads).all()
    middle = loads[2]
    # -iω_e P5 against U P3: 2 % from two per mille of speed, and the same to either side.
    assert np.abs(loads - middle).max() < 0.03 * np.abs(middle).max()
    assert np.abs(loads[1] + loads[3] - 2 * middle).max() < 1e-4 * np.abs(middle).max()


def test_potential_beyond_the_grid_tends_to_its_infinite_limit(solved: Solved) -> None:
    last = FREQUENCIES[-1]
    below, above, far = radiation_potential(solved.database, np.array([1.0, 1.0 + 1e-9, 100.0]) * last)
    infinite = solved.database.potential_infinite
    scale = np.abs(infinite).max(axis=1, keepdims=True)
    assert (np.abs(above - below) / scale).max() < 1e-6
    assert (np.abs(far - infinite) / scale).max() < 1e-3


def test_stored_potentials_are_met_exactly_and_steps_between_are_small(solved: Solved) -> None:
    at_grid = radiation_potential(solved.database, FREQUENCIES)
    assert np.allclose(at_grid, solved.database.potential, rtol=0, atol=1e-12 * np.abs(at_grid).max())


def test_waves_met_faster_than_the_grid_are_told(solved: Solved) -> None:
    told = beyond_resolution(
        solved.database, np.array([0.8, 0.8, 1.3, 3.0]), np.array([np.pi, np.pi / 2, 0.0, 0.0]), SPEED
    )
    # The last is overtaken at some −6 rad/s: its magnitude counts.
    assert told.tolist() == [True, False, False, True]


def test_half_hull_gives_the_load_of_the_whole(solved: Solved, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bem, "is_mirror_symmetric", lambda mesh: False)
    whole = HydroDatabase(
        solve_radiation(
            solved.ship.vertices,
            solved.ship.mesh.panels,
            solved.ship.waterline,
            water_density=DENSITY,
            gravity=GRAVITY,
            frequencies=np.array([0.0, 0.7, 0.8]),
        )
    )
    sea = np.array([0.8]), np.array([2.0]), 0.0
    one, other = diffraction_load(whole, *sea)[0], diffraction_load(solved.database, *sea)[0]
    # Only the lid differs.
    assert shares(one - other, other).max() < 0.01


def test_gauss_points_are_those_of_the_rule() -> None:
    """∫ x² dA over a flat panel of 2 by 2 m about its middle is 4/3, and ∫ x² y² dA 4/9."""
    corners = np.array([[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]]])
    points, areas = diffraction._gauss_points(corners)
    x, y, area = points[0, :, 0], points[0, :, 1], np.abs(areas[0, :, 2])
    assert area @ x**2 == pytest.approx(4.0 / 3.0, rel=1e-12)
    assert area @ (x * y) ** 2 == pytest.approx(4.0 / 9.0, rel=1e-12)


def test_gauss_points_keep_area_and_volume_of_a_warped_panel() -> None:
    corners = np.array([[[0.0, 0.0, 0.0], [2.0, 0.1, 0.3], [2.2, 1.5, -0.2], [0.1, 1.2, 0.4]]])
    points, areas = diffraction._gauss_points(corners)
    a, b, c, d = corners[0]
    assert areas.sum(axis=(0, 1)) == pytest.approx(0.5 * np.cross(c - a, d - b))
    # The volume under the bilinear surface is the mean of those under both diagonal splits.
    splits = [(a, b, c), (a, c, d), (a, b, d), (b, c, d)]
    volume = sum(np.linalg.det(np.array(triangle)) for triangle in splits) / 6.0 / 2.0
    assert np.einsum("pqi,pqi->", points, areas) / 3.0 == pytest.approx(volume)


def test_a_standing_frequency_is_refused(solved: Solved) -> None:
    with pytest.raises(PanelsimError, match="more than 0"):
        diffraction_load(solved.database, np.array([0.0]), np.array([0.0]), 0.0)
