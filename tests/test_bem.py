"""Boundary elements: signs, the point of reference, symmetry, limits and refusals."""

from typing import Any

import capytaine as cpt
import numpy as np
import pytest
import xarray as xr

from panelsim.conventions import Dof, FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hydro import bem
from panelsim.hydro.bem import highest_resolved_frequency, is_mirror_symmetric, solve_radiation
from panelsim.hydro.conditioning import damping_roughness, require_physical, symmetrise

WATER: dict[str, Any] = {"water_density": 1025.0, "gravity": 9.80665}
FREQUENCIES = np.array([0.0, 2.0, 4.0])
KEEL_TO_CG = 0.25


def wigley(area: float = 0.012) -> tuple[FloatArray, IntArray, float]:
    """Vertices, panels and waterline of a 3 m Wigley hull about a CG above the water, freeboard and all."""
    form = load_hull("wigley_iii")
    mesh = form.panel(area)
    return mesh.vertices - np.array([0.1, 0.0, KEEL_TO_CG]), mesh.panels, form.draft - KEEL_TO_CG


@pytest.fixture(scope="module")
def solved() -> xr.Dataset:
    return solve_radiation(*wigley(), frequencies=FREQUENCIES, **WATER)


def generalised_area(corners: FloatArray) -> FloatArray:
    """(n, r × n) dS (6, panels) about the origin from the diagonals and the mean of the corners."""
    area = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return np.hstack([area, np.cross(corners.mean(axis=1), area)]).T


def test_coefficients_are_the_integrals_of_the_stored_potentials(solved: xr.Dataset) -> None:
    """A + B/(iω) = -ρ ∫ φ_j n_i dS; a wrong sign, conjugate or half hull would be off by 100 %."""
    potential = (solved.potential_real + 1j * solved.potential_imag).values
    areas = generalised_area(solved.panel_corners.values)
    inertia = -2.0 * WATER["water_density"] * np.einsum("ip,fjp->fij", areas, potential)
    omega = FREQUENCIES[1:]
    for dof in Dof:
        # Both halves of the hull add for a motion against itself. 2 %: coarse warped and triangular panels
        # at stem and stern are integrated in another way here.
        reference = solved.added_mass.values[:, dof, dof]
        assert inertia[:, dof, dof].real == pytest.approx(reference, rel=0.02)
        damping = -omega * inertia[1:, dof, dof].imag
        assert damping == pytest.approx(solved.radiation_damping.values[1:, dof, dof], rel=0.02)
    assert np.all(solved.radiation_damping.values[1:, range(6), range(6)] > 0.0)


def test_coefficients_are_those_of_capytaine_itself(solved: xr.Dataset) -> None:
    vertices, panels, waterline = wigley()
    with bem._quiet_single_threaded_capytaine():
        mesh = cpt.Mesh(vertices - [0.0, 0.0, waterline], panels, auto_check=False).immersed_part()
        dofs = cpt.rigid_body_dofs(rotation_center=(0.0, 0.0, -waterline))
        body = cpt.FloatingBody(mesh=mesh, lid_mesh=mesh.generate_lid(), dofs=dofs)
        problem = cpt.RadiationProblem(body=body, omega=4.0, radiating_dof="Pitch", rho=1025.0, g=9.80665)
        result = cpt.BEMSolver(method="direct").solve(problem, _check_wavelength=False)
    for name, ours in (("Heave", Dof.HEAVE), ("Pitch", Dof.PITCH), ("Surge", Dof.SURGE)):
        # The matrices here are the mean with their transposes, and the lid of a half hull differs a little.
        assert solved.added_mass.values[2, ours, Dof.PITCH] == pytest.approx(
            result.added_mass[name], abs=0.02 * result.added_mass["Pitch"]
        )
        assert solved.radiation_damping.values[2, ours, Dof.PITCH] == pytest.approx(
            result.radiation_damping[name], abs=0.02 * result.radiation_damping["Pitch"]
        )


def test_half_hull_gives_what_the_whole_hull_gives(
    solved: xr.Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bem, "is_mirror_symmetric", lambda mesh: False)
    whole = solve_radiation(*wigley(), frequencies=FREQUENCIES[:2], **WATER)
    assert solved.half_hull and not whole.half_hull
    assert whole.sizes["panel"] == 2 * solved.sizes["panel"]
    scale = np.sqrt(np.outer(*[np.diag(solved.added_mass_infinite)] * 2))
    # Only the lid differs: rectangles that need not end on the centreline.
    assert (np.abs(whole.added_mass[1] - solved.added_mass[1]) / scale).max() < 0.01
    assert (np.abs(whole.added_mass_infinite - solved.added_mass_infinite) / scale).max() < 0.01


def test_moving_the_point_of_reference_is_a_change_of_coordinates(solved: xr.Dataset) -> None:
    """With r the old centre seen from the new one: A' = T A Tᵀ, moments gain r × F."""
    vertices, panels, waterline = wigley()
    r = np.array([0.4, 0.0, -0.15])
    moved = solve_radiation(vertices + r, panels, waterline + r[2], frequencies=FREQUENCIES[:2], **WATER)
    transfer = np.eye(6)
    transfer[3:, :3] = [[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]]
    for name in ("added_mass", "radiation_damping"):
        expected = transfer @ solved[name].values[:2] @ transfer.T
        # Exact in the discrete equations; 1e-9 is rounding.
        assert np.abs(moved[name].values - expected).max() < 1e-9 * np.abs(expected).max()


def test_panels_across_the_waterline_are_cut(solved: xr.Dataset) -> None:
    """The hull 4 cm deeper in the water than it was panelled for, against panels that end there."""
    form = load_hull("wigley_iii")
    vertices, panels, waterline = wigley()
    cut = solve_radiation(vertices, panels, waterline + 0.04, frequencies=FREQUENCIES, **WATER)
    mesh = form.panel(0.012, draft=form.draft + 0.04)
    offset = np.array([0.1, 0.0, KEEL_TO_CG])
    fitted = solve_radiation(
        mesh.vertices - offset, mesh.panels, waterline + 0.04, frequencies=FREQUENCIES, **WATER
    )
    assert cut.panel_corners.values[..., 2].max() == pytest.approx(waterline + 0.04)
    for dof in (Dof.SWAY, Dof.HEAVE, Dof.PITCH):
        a, b, c = (d.added_mass.values[2, dof, dof] for d in (cut, fitted, solved))
        # Two panellings of 120 panels; without the cut it would be the shallower hull.
        assert a == pytest.approx(b, rel=0.02)
        assert abs(b - c) > 0.05 * b


def test_mesh_too_fine_to_solve_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bem, "_MOST_PANELS", 10)
    with pytest.raises(PanelsimError, match="too fine"):
        solve_radiation(*wigley(0.04), frequencies=FREQUENCIES, **WATER)


def test_symmetric_hull_does_not_couple_port_and_starboard(solved: xr.Dataset) -> None:
    a = solved.added_mass.values
    assert np.all(a[:, [0, 2, 4]][:, :, [1, 3, 5]] == 0.0)
    assert np.array_equal(a, np.swapaxes(a, 1, 2))
    # Before it was imposed: theory held to the error of the panels.
    assert solved.attrs["asymmetry_added_mass"] < 0.02
    assert solved.attrs["asymmetry_radiation_damping"] < 0.03
    assert solved.attrs["port_starboard_coupling"] < 0.02


def test_deep_sphere_has_half_its_displaced_mass() -> None:
    """Far below the surface every motion of a sphere has ½ ρ V, and no frequency changes it (Lamb)."""
    mesh = cpt.mesh_sphere(radius=1.0, center=(0.0, 0.0, 0.0), resolution=(12, 24))
    dataset = solve_radiation(
        mesh.vertices, np.asarray(mesh.faces), 30.0, frequencies=np.array([0.0, 2.0]), **WATER
    )
    half_mass = 0.5 * WATER["water_density"] * 4.0 / 3.0 * np.pi
    for a in (*dataset.added_mass.values, dataset.added_mass_infinite.values):
        # 288 flat panels hold 2 % less water than the sphere.
        assert np.diag(a)[:3] == pytest.approx(half_mass, rel=0.03)


def test_progress_counts_every_frequency_and_infinity() -> None:
    seen: list[tuple[int, int]] = []
    solve_radiation(
        *wigley(0.04), frequencies=np.array([0.0, 1.0]), progress=lambda *a: seen.append(a), **WATER
    )
    assert seen == [(1, 3), (2, 3), (3, 3)]


def test_same_input_gives_the_same_bits() -> None:
    one, two = (solve_radiation(*wigley(0.04), frequencies=FREQUENCIES, **WATER) for _ in range(2))
    assert one.identical(two)


def test_hull_out_of_the_water_is_refused() -> None:
    vertices, panels, _ = wigley(0.04)
    with pytest.raises(PanelsimError, match="No panel of the hull is under water"):
        solve_radiation(vertices, panels, -5.0, frequencies=FREQUENCIES, **WATER)


def test_frequencies_must_ascend_from_rest() -> None:
    for wrong in ([1.0, 2.0], [0.0, 2.0, 1.0]):
        with pytest.raises(PanelsimError, match="ascend from 0"):
            solve_radiation(*wigley(0.04), frequencies=np.array(wrong), **WATER)


def test_mirror_symmetry_is_seen_and_its_lack_too() -> None:
    mesh = load_hull("wigley_iii").panel(0.04)
    assert is_mirror_symmetric(mesh)
    lopsided = mesh.vertices.copy()
    lopsided[np.argmax(lopsided[:, 1])] *= [1.0, 1.1, 1.0]
    assert not is_mirror_symmetric(type(mesh)(lopsided, mesh.panels))


def test_eight_panels_a_wave_length() -> None:
    """Panels of 1 m²: the shortest wave is 8 m, ω² = 2π g / 8."""
    assert highest_resolved_frequency(1.0, 9.80665) ** 2 == pytest.approx(2 * np.pi * 9.80665 / 8)


def test_negative_damping_and_nonsense_are_refused() -> None:
    frequencies = np.arange(5.0)
    good = np.tile(np.eye(6), (5, 1, 1))
    require_physical(frequencies, good, good, 1.0)
    bad = good.copy()
    bad[3, Dof.HEAVE, Dof.HEAVE] = -0.02
    with pytest.raises(PanelsimError, match=r"negative radiation damping in heave[\s\S]* at 3 rad/s"):
        require_physical(frequencies, good, bad, 1.0)
    bad[3, Dof.HEAVE, Dof.HEAVE] = np.nan
    with pytest.raises(PanelsimError, match="added mass is not finite"):
        require_physical(frequencies, bad, good, 1.0)


def test_symmetrise_reports_what_it_removes() -> None:
    matrices = np.tile(np.diag([1.0, 1.0, 4.0, 1.0, 1.0, 1.0]), (3, 1, 1))
    matrices[1, 0, 2], matrices[1, 0, 1], matrices[1, 1, 0] = 0.4, 0.1, 0.1
    mean, transpose_error, coupling = symmetrise(matrices, mirror_symmetric=True, half_breadth=1.0)
    assert mean[1, 0, 2] == mean[1, 2, 0] == pytest.approx(0.2)
    assert mean[1, 0, 1] == 0.0
    # Over √(1 · 4) and √(1 · 1).
    assert transpose_error == pytest.approx(0.1)
    assert coupling == pytest.approx(0.1)


def test_an_irregular_point_shows_as_roughness() -> None:
    frequencies = np.linspace(0.0, 2.0, 11)
    damping = np.einsum("f,ij->fij", frequencies**2 * np.exp(-frequencies), np.eye(6))
    smooth = damping_roughness(frequencies, damping, 1.0)
    damping[5] *= 1.2
    assert smooth < 0.005 < 0.1 < damping_roughness(frequencies, damping, 1.0)
