"""The formula shapes against their closed forms."""

import numpy as np
import pytest

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hull.panel_mesh import PanelMesh

# Journée (1992): beam, factor of the fourth-power term, published volume [m3]; L 3 m, d 0.1875 m.
WIGLEY = {
    "wigley_i": (0.3, 1.0, 0.0946),
    "wigley_ii": (0.6, 1.0, 0.1892),
    "wigley_iii": (0.3, 0.0, 0.0780),
    "wigley_iv": (0.6, 0.0, 0.1560),
}


def immersed_volume(mesh: PanelMesh, draft: float) -> float:
    """Divergence theorem about a point of the water plane, which needs no lid: wet panels only."""
    wet = mesh.centroid[:, 2] < draft
    a, b, c = np.moveaxis(mesh.triangles[wet].reshape(-1, 3, 3) - [0.0, 0.0, draft], 1, 0)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def wigley_volume(beam: float, a: float) -> float:
    """Integral of Journée's formula over X in (-1, 1), Z in (0, 1), term by term."""
    flat, bow = np.polynomial.Polynomial([1, 0, -1]), np.polynomial.Polynomial([1, 0, 0.2])
    bilge = np.polynomial.Polynomial([0, 0, 1, *[0] * 7, -1])

    def integral(p: np.polynomial.Polynomial) -> float:
        return float(p.integ()(1.0) - p.integ()(0.0))

    terms = integral(flat) * integral(flat * bow) + a * integral(bilge) * integral(flat**4)
    return 3.0 * beam * 0.1875 * terms


def order(size: FloatArray, error: FloatArray) -> float:
    return float(np.polyfit(np.log(size), np.log(np.abs(error)), 1)[0])


@pytest.mark.parametrize("name", WIGLEY)
def test_wigley_volume_converges_to_journees_with_the_square_of_the_panel_length(name: str) -> None:
    beam, a, published = WIGLEY[name]
    exact = wigley_volume(beam, a)
    assert exact == pytest.approx(published, rel=5e-3)  # published to three or four figures
    length, error = [], []
    for area in (0.016, 0.008, 0.004, 0.002, 0.001):
        mesh = load_hull(name).panel(area)
        on_water = (mesh.vertices[:, 2] == 0.1875) & (mesh.vertices[:, 1] >= 0.0)
        length.append(3.0 / (np.count_nonzero(on_water) - 1))
        error.append(immersed_volume(mesh, 0.1875) / exact - 1.0)
    slope = order(np.array(length), np.array(error))
    print(f"{name}: errors {error}, order {slope:.2f}")
    # Chords lose the square of their length; the counts are whole numbers, hence the band.
    assert slope == pytest.approx(2.0, abs=0.15)
    assert abs(error[-1]) < 5e-4


def test_wigley_meets_the_formula_at_its_vertices_on_the_water() -> None:
    mesh = load_hull("wigley_ii").panel(0.005)
    x, y, z = mesh.vertices.T
    on_water = (z == 0.1875) & (y >= 0.0)
    share = (x[on_water] / 1.5) ** 2
    # 1e-4 of the beam: the tables of the formula are joined by monotone cubics, level at the midship.
    np.testing.assert_allclose(y[on_water], 0.3 * (1 - share) * (1 + 0.2 * share), atol=6e-5)


@pytest.mark.parametrize("area", [4.0, 1.0, 0.3])
def test_box_is_exact_at_any_panel_area(area: float) -> None:
    mesh = load_hull("box").panel(area)
    # Round-off only: all faces are plane.
    assert immersed_volume(mesh, 2.0) == pytest.approx(400.0, rel=1e-12)
    assert mesh.area.sum() == pytest.approx(2 * (200 + 50 + 100), rel=1e-12)
    np.testing.assert_allclose(mesh.area_vector.sum(axis=0), 0.0, atol=1e-10)
    assert mesh.area.max() / area < 1.7  # a count is rounded to a whole number on either edge


def test_trimmed_box_has_its_waterline_on_the_plane_deeper_aft() -> None:
    mesh = load_hull("box").panel(1.0, trim_by_stern=1.0)
    depth = 2.0 - mesh.vertices[:, 0] / 20.0 - mesh.vertices[:, 2]
    assert np.all((depth[mesh.panels].min(axis=1) > -1e-12) | (depth[mesh.panels].max(axis=1) < 1e-12))
    at_stern = mesh.vertices[mesh.vertices[:, 0] == -10.0]
    assert np.any(np.isclose(at_stern[:, 2], 2.5, atol=1e-12))


@pytest.mark.parametrize(
    ("name", "draft", "exact"),
    [
        ("sphere", 5.0, 2.0 / 3.0 * np.pi * 125.0),
        ("sphere", 3.0, np.pi * 9.0 * (5.0 - 1.0)),  # cap: pi h² (R - h/3)
        ("sphere", 7.0, np.pi * 49.0 * (5.0 - 7.0 / 3.0)),
        ("cylinder", 10.0, 250.0 * np.pi),
    ],
)
def test_round_bodies_converge_with_the_square_of_the_panel_size(
    name: str, draft: float, exact: float
) -> None:
    size, error = [], []
    for area in (2.0, 1.0, 0.5, 0.25, 0.125):
        mesh = load_hull(name).panel(area, draft=draft)
        size.append(np.sqrt(mesh.area.mean()))
        error.append(immersed_volume(mesh, draft) / exact - 1.0)
    slope = order(np.array(size), np.array(error))
    print(f"{name} at {draft} m: errors {error}, order {slope:.2f}")
    assert slope == pytest.approx(2.0, abs=0.15)
    assert -5e-3 < error[-1] < 0.0  # vertices lie on the body, so panels lose volume


def test_vertices_of_the_sphere_lie_on_it_and_panels_are_even() -> None:
    mesh = load_hull("sphere").panel(0.5)
    radius = np.linalg.norm(mesh.vertices - [0.0, 0.0, 5.0], axis=1)
    np.testing.assert_allclose(radius, 5.0, rtol=1e-12)
    assert np.all(mesh.panels[:, 2] != mesh.panels[:, 3])  # no pole, no triangle
    assert mesh.area.min() > 0.5 * mesh.area.max()
    assert np.all(np.einsum("ij,ij->i", mesh.normal, mesh.centroid - [0.0, 0.0, 5.0]) > 0.0)


def test_stretched_sphere_is_an_ellipsoid() -> None:
    form = load_hull("sphere").scaled(length=20.0, draft=2.5)
    mesh = form.panel(0.5)
    np.testing.assert_allclose(
        np.sum(((mesh.vertices - [0.0, 0.0, 2.5]) / [10.0, 5.0, 2.5]) ** 2, axis=1), 1.0, rtol=1e-12
    )
    # Volume of half an ellipsoid, to what panels of this size lose.
    assert immersed_volume(mesh, 2.5) == pytest.approx(2 / 3 * np.pi * 10 * 5 * 2.5, rel=0.02)


def test_trimmed_sphere_is_refused() -> None:
    with pytest.raises(PanelsimError, match="no trim"):
        load_hull("sphere").panel(1.0, trim_by_stern=0.5)


@pytest.mark.parametrize("draft", [5.0, 6.0])
def test_box_under_water_is_refused(draft: float) -> None:
    with pytest.raises(PanelsimError, match="between 0 and 5 m"):
        load_hull("box").panel(1.0, draft=draft)
