"""Subdivision keeps the surface, its closedness and its direction."""

import numpy as np
import pytest

from panelsim.hull.checks import check_mesh
from panelsim.hull.form import load_hull
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.refine import subdivided


def volume(mesh: PanelMesh) -> float:
    return float(np.linalg.det(mesh.triangles).sum() / 6)


def as_triangles(mesh: PanelMesh) -> PanelMesh:
    a, b, c, d = mesh.panels.T
    halves = np.concatenate([np.column_stack([a, b, c, c]), np.column_stack([a, c, d, d])])
    return PanelMesh(mesh.vertices, halves)


@pytest.mark.parametrize(
    ("name", "area", "triangles", "twist"),
    [("box", 4.0, False, 1e-12), ("box", 4.0, True, 1e-12), ("halifax", 20.0, False, 2e-3)],
)
def test_a_subdivided_mesh_is_the_same_closed_surface(
    name: str, area: float, triangles: bool, twist: float
) -> None:
    coarse = load_hull(name).panel(area)
    if triangles:
        coarse = as_triangles(coarse)
    fine = subdivided(coarse)
    assert fine.panel_count == 4 * coarse.panel_count
    report = check_mesh(fine)
    assert report.closed and report.outward and report.symmetric == check_mesh(coarse).symmetric
    # Flat panels keep the volume to rounding; twisted ones move by the twist between their diagonals.
    assert volume(fine) == pytest.approx(volume(coarse), rel=twist)
    assert fine.area.sum() == pytest.approx(coarse.area.sum(), rel=5 * twist)
    assert len(np.unique(fine.panels)) == len(fine.vertices)
