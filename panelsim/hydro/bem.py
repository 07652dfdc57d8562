"""Zero-speed radiation by boundary elements in deep water: the only door to Capytaine.

Capytaine (Ancellin and Dias 2019) uses exp(-iωt); everything that leaves this file is in exp(+iωt), about
the centre of gravity, in panelsim's axes. The direct method with a lid on the interior free surface keeps
irregular frequencies away; one thread is both faster and repeatable.
"""

import logging
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import xarray as xr
from scipy.spatial import cKDTree

from panelsim.conventions import ComplexArray, FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hydro.radiation_dataset import radiation_dataset

Progress = Callable[[int, int], None]

_PANELS_PER_WAVE_LENGTH = 8.0
_MOST_PANELS = 4000  # two dense complex matrices of 256 MB each
_ON_THE_WATERLINE = 1e-6  # share of the ship's length within which a vertex is put on the waterline
_SAME_POINT = 1e-5  # share of the ship's length within which two panels are mirror images


def solve_radiation(
    vertices: FloatArray,
    panels: IntArray,
    waterline: float,
    *,
    water_density: float,
    gravity: float,
    frequencies: FloatArray,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Added mass, radiation damping and radiation potentials of a floating hull at zero speed.

    `vertices` (V, 3) [m] in ship axes, origin at the centre of gravity; `panels` (N, 4) with normals out
    of the hull, of which the part below `waterline` [m] is used; `frequencies` (F,) [rad/s], ascending
    from 0. The limit of infinite frequency is always added. `progress(done, total)` counts frequencies.

    The Dataset holds `added_mass`, `radiation_damping` (frequency, influenced_dof, radiating_dof),
    `added_mass_infinite`, the potentials φ_j with ∂φ_j/∂n = n_j, n into the water and n_4..6 = r × n, as
    `potential_real`, `potential_imag` (frequency, radiating_dof, panel) and `potential_infinite`, and
    `panel_corners` (panel, corner, axis) [m] in ship axes. With the attribute `half_hull` the panels are
    those of the port side. Raises PanelsimError when nothing is wet or the solution is not physical.
    """
    frequencies = np.asarray(frequencies, dtype=np.float64)
    if frequencies.ndim != 1 or frequencies[0] != 0.0 or np.any(np.diff(frequencies) <= 0.0):
        raise PanelsimError(
            "Frequencies for a radiation solution must ascend from 0",
            got=frequencies,
            allowed="0 < ω1 < ω2 ...",
        )
    inertia, potential = [], []
    with _quiet_single_threaded_capytaine() as cpt:
        hull, mirror_symmetric, half_hull = _wet_hull(cpt, vertices, panels, waterline)
        body = _floating_body(cpt, hull, half_hull=half_hull, waterline=waterline)
        areas = _generalised_area(body.mesh, waterline)
        solver = cpt.BEMSolver(method="direct")
        for done, omega in enumerate([*frequencies, np.inf], start=1):
            problems = [
                cpt.RadiationProblem(body=body, omega=omega, radiating_dof=dof, rho=water_density, g=gravity)
                for dof in body.dofs
            ]
            phi = _radiation_potentials(solver, problems)
            inertia.append(-water_density * areas @ phi.T)
            # The other half carries the same values, with the sign of the motion.
            potential.append(phi[:, : hull.nb_faces])
            if progress is not None:
                progress(done, len(frequencies) + 1)
        dataset = radiation_dataset(
            frequencies,
            np.array(inertia),
            np.array(potential),
            hull.vertices[hull.faces] + np.array([0.0, 0.0, waterline]),
            mirror_symmetric=mirror_symmetric,
        )
        dataset.attrs |= {
            "half_hull": int(half_hull),
            "waterline": float(waterline),
            "water_density": float(water_density),
            "gravity": float(gravity),
            "length": float(np.ptp(hull.vertices[:, 0])),
            "solver": f"Capytaine {cpt.__version__}, direct method",
            "lid_panels": 0 if body.lid_mesh is None else int(body.lid_mesh.nb_faces),
        }
    return dataset


def highest_resolved_frequency(panel_area: float, gravity: float) -> float:
    """Frequency [rad/s] whose waves are eight panels long, for a mean panel area [m2], in deep water."""
    wave_length = _PANELS_PER_WAVE_LENGTH * np.sqrt(panel_area)
    return float(np.sqrt(2.0 * np.pi * gravity / wave_length))


@contextmanager
def _quiet_single_threaded_capytaine() -> Iterator[Any]:
    """Capytaine on one thread, silent about the non-planar panels that every ship has."""
    before = os.environ.get("OMP_NUM_THREADS")
    # Capytaine's own OpenMP library reads this once, when it is loaded, and then keeps it.
    os.environ["OMP_NUM_THREADS"] = "1"
    try:
        import capytaine as cpt
    finally:
        if before is None:
            del os.environ["OMP_NUM_THREADS"]
        else:
            os.environ["OMP_NUM_THREADS"] = before
    log = logging.getLogger("capytaine")
    level = log.level
    log.setLevel(logging.ERROR)
    try:
        yield cpt
    finally:
        log.setLevel(level)


def _wet_hull(cpt: Any, vertices: FloatArray, panels: IntArray, waterline: float) -> tuple[Any, bool, bool]:
    """Capytaine mesh of the wet hull or its port half, whether the hull is symmetric, whether it is half."""
    points = np.array(vertices, dtype=np.float64)
    points[:, 2] -= waterline
    length = float(np.ptp(points[:, 0]))
    points[np.abs(points[:, 2]) < _ON_THE_WATERLINE * length, 2] = 0.0
    mesh = PanelMesh(points, panels)
    mirror_symmetric = is_mirror_symmetric(mesh)
    off_centreline = np.abs(mesh.centroid[:, 1]) > _SAME_POINT * length
    half_hull = mirror_symmetric and bool(off_centreline.all())
    kept = mesh.panels[mesh.centroid[:, 1] > 0.0] if half_hull else mesh.panels
    # A panel that lies in the water surface, the closed top of a hull cut there, is no part of the wet hull.
    wet = (points[kept, 2] < 0.0).any(axis=1)
    if not wet.any():
        raise PanelsimError(
            "No panel of the hull is under water",
            got=f"a lowest point {points[:, 2].min():.3g} m from the waterline",
            remedy="check the draft and the vertical axis of the mesh",
        )
    if wet.sum() > _MOST_PANELS:
        raise PanelsimError(
            "The mesh is too fine for a boundary-element solution",
            got=f"{wet.sum()} wet panels{' on one side' if half_hull else ''}",
            allowed=f"up to {_MOST_PANELS}; 500 on one side resolve all that moves a ship",
            remedy="use larger panels",
        )
    # Capytaine writes a triangle with its first vertex repeated, panelsim with its third: both are quads.
    hull = cpt.Mesh(points, kept[wet], auto_check=False)
    if (points[kept[wet], 2] > 0.0).any():
        hull = hull.immersed_part()
    return hull, mirror_symmetric, half_hull


def is_mirror_symmetric(mesh: PanelMesh) -> bool:
    """True when every panel has a mirror image across the centreplane, to 1e-5 of the length."""
    tolerance = _SAME_POINT * float(np.ptp(mesh.vertices[:, 0]))
    mirror = np.array([1.0, -1.0, 1.0])
    distance, image = cKDTree(mesh.centroid).query(mesh.centroid * mirror)
    same_size = np.abs(mesh.area_vector[image] - mesh.area_vector * mirror) < 1e-3 * mesh.area.mean()
    return bool((distance < tolerance).all() and same_size.all())


def _floating_body(cpt: Any, hull: Any, *, half_hull: bool, waterline: float) -> Any:
    lid = hull.generate_lid(z=0.0)
    if not lid.nb_faces:  # a hull so few panels wide that none as large as they are fits inside it
        lid = hull.generate_lid(z=0.0, faces_max_radius=0.1 * float(np.ptp(hull.vertices[:, 1])))
    if half_hull:
        hull = cpt.ReflectionSymmetricMesh(half=hull, plane="xOz")
        lid = cpt.ReflectionSymmetricMesh(half=lid, plane="xOz")
    center_of_gravity = (0.0, 0.0, -waterline)
    dofs = cpt.rigid_body_dofs(rotation_center=center_of_gravity)
    return cpt.FloatingBody(mesh=hull, lid_mesh=lid if lid.nb_faces else None, dofs=dofs, name="ship")


def _radiation_potentials(solver: Any, problems: list[Any]) -> ComplexArray:
    """φ_j (6, panels) at one frequency with ∂φ_j/∂n = n_j, in exp(+iωt)."""
    potentials = []
    for problem in problems:
        result = solver.solve(problem, _check_wavelength=False)
        # At 0 and infinity Capytaine keeps the frequency as a symbol in front of a finite value.
        frequency = getattr(result.omega, "value", result.omega)
        solution = getattr(result.potential, "value", result.potential)
        # Its boundary condition is that of a displacement of unit amplitude, ∂φ/∂n = -iω n_j.
        potentials.append(np.conj(solution[problem.body.hull_mask] / (-1j * frequency)))
    return np.array(potentials)


def _generalised_area(mesh: Any, waterline: float) -> FloatArray:
    """(n, r × n) dS (6, panels) about the centre of gravity, one point a panel as Capytaine has it."""
    arm = mesh.faces_centers + np.array([0.0, 0.0, waterline])
    normal = mesh.faces_normals
    return (np.hstack([normal, np.cross(arm, normal)]) * mesh.faces_areas[:, None]).T
