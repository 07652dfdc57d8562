"""The vertex rule converges with the square of the panel size."""

import numpy as np

from panelsim.kernels import oracle
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables

WATER = {"waterline": -1.5, "water_density": 1025.0, "gravity": 9.80665}
DEG = np.pi / 180
# The deck stays dry: a surface that cuts through a few long deck panels makes the roll moment
# converge by jumps (a slope of 1.2 to 1.6 at 40 degrees of heel over these meshes).
STATES = np.array(
    [
        [3.0, 1.0, 0, 0, 0, 0, 0, 0],
        [11.0, 1.0, 0, 0, 0.5, -25 * DEG, 3 * DEG, 8 * DEG],
        [13.0, 1.0, 0, 0, -1.0, 10 * DEG, -2 * DEG, 0],
    ]
)


def ship(n: int) -> PanelTables:
    """A Wigley form of 120 x 15 x 5 m, decked 11 m above its keel, in 4n x n panels a side."""
    s, z = np.linspace(-1, 1, 4 * n + 1)[:, None], 11 * np.linspace(0, 1, n + 1)
    half_breadth = 7.5 * (1 - s**2) * (1 - np.maximum(1 - z / 5, 0) ** 2)
    port = np.stack(np.broadcast_arrays(60 * s, half_breadth, z - 6.5), axis=-1)
    deck = np.stack([port[:, -1] * [1, t, 1] for t in np.linspace(-1, 1, n // 3 + 1)], axis=1)
    vertices, panels = [], []
    for sheet in (port.swapaxes(0, 1), port * [1, -1, 1], deck):
        index = np.arange(sheet[..., 0].size).reshape(sheet.shape[:2]) + sum(map(len, vertices))
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        panels.append(np.stack(corners, axis=-1).reshape(-1, 4))
        vertices.append(sheet.reshape(-1, 3))
    return panel_tables(np.concatenate(vertices), np.concatenate(panels))


def sea() -> WaveTables:
    """Five bow-quartering components at 20 knots, none shorter than a few coarse panels."""
    k = 2 * np.pi / (160.0 / np.array([1.0, 1.4, 1.9, 2.6, 3.3]))
    omega, heading = np.sqrt(9.80665 * k), 150 * DEG + np.array([-0.3, 0.2, 0.0, 0.4, -0.2])
    amplitude, phase = np.array([1.5, 1.0, 0.8, 0.5, 0.3]), np.array([0.3, 2.0, 4.0, 5.5, 1.2])
    return wave_tables(amplitude, k, heading, omega - 10.29 * k * np.cos(heading), phase)


def relative_error(load: np.ndarray, reference: np.ndarray, panels: PanelTables) -> np.ndarray:
    """RMS over the states of the error of each load (6,), over the largest dynamic load of its kind."""
    still = STATES.copy()
    still[:, 1] = 0.0
    dynamic = np.abs(reference - wetted_surface_load(panels, sea(), still, **WATER)).max(axis=0)
    return np.sqrt(((load - reference) ** 2).mean(axis=0)) / dynamic


def slope(errors: list[float]) -> float:
    return float(-np.polyfit(np.arange(len(errors)), np.log2(errors), 1)[0])


def test_rule_error_on_one_hull_falls_with_the_square_of_the_panel_size() -> None:
    """Panels of half the size each time, the reference on the same flat facets split further."""
    errors = []
    for n in (3, 6, 12, 24):
        panels = ship(n)
        load = wetted_surface_load(panels, sea(), STATES, **WATER)
        reference = oracle.subdivided_load(panels, sea(), STATES, levels=2, **WATER)
        errors.append(relative_error(load, reference, panels))
    orders = np.array([slope([error[i] for error in errors]) for i in range(6)])
    total = slope([float(np.linalg.norm(error)) for error in errors])
    for error in errors:
        print("error surge to yaw:", *(f"{part:.1e}" for part in error))
    print(f"orders {orders.round(2)}, together {total:.2f}")
    assert abs(total - 2.0) < 0.15
    # The size of the error matters as much as its slope: 96 x 24 panels a side, 1.3 x 0.5 m.
    assert errors[-1].max() < 4e-4


def test_splitting_the_triangles_of_one_mesh_converges_with_the_square() -> None:
    """Same facets, every triangle in 4^n parts: what is left is the pressure between the corners."""
    panels = ship(4)
    reference = oracle.subdivided_load(panels, sea(), STATES, levels=4, **WATER)
    errors = [
        float(
            np.linalg.norm(
                relative_error(
                    oracle.subdivided_load(panels, sea(), STATES, levels=n, **WATER), reference, panels
                )
            )
        )
        for n in (0, 1, 2)
    ]
    print(f"errors {errors}, order {slope(errors):.2f}")
    assert abs(slope(errors) - 2.0) < 0.15
