"""The compiled pressure kernel against its NumPy twin, and the manners of its Taichi runtime."""

import itertools
import subprocess
import sys

import numpy as np
import pytest

from panelsim.conventions import STRETCHINGS
from panelsim.errors import PanelsimError
from panelsim.kernels import oracle
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables
from panelsim.ship.bundled import load_ship

WATER = {"water_density": 1025.0, "gravity": 9.80665}
# Both sum the same few thousand terms in another order; the polynomials are exact to 1e-15.
AGREEMENT = 1e-12


def lattice(*sheets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and panels of sheets of points (m, n, 3); i towards j turns into the water."""
    vertices, panels = [], []
    for sheet in sheets:
        index = np.arange(sheet[..., 0].size).reshape(sheet.shape[:2]) + sum(map(len, vertices))
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        panels.append(np.stack(corners, axis=-1).reshape(-1, 4))
        vertices.append(sheet.reshape(-1, 3))
    return np.concatenate(vertices), np.concatenate(panels)


def box() -> PanelTables:
    """A box of 20 x 10 x 6 m in few large panels, its corners at whole metres."""
    corners = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)]) * [20.0, 10.0, 6.0] - [10.0, 5.0, 3.0]
    panels = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return panel_tables(corners, np.array(panels))


def sphere() -> PanelTables:
    """A sphere of radius 5 m in 12 x 20 panels, triangles at its poles."""
    theta, phi = np.linspace(0, np.pi, 13)[:, None], np.linspace(0, 2 * np.pi, 21)
    sheet = 5.0 * np.stack(
        np.broadcast_arrays(np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), axis=-1
    )
    vertices, panels = lattice(sheet)
    # The panels at the first pole start with twice the same point: write them as triangles.
    polar = np.ptp(vertices[panels[:, [0, 3]]], axis=1).max(axis=1) < 1e-9
    panels[polar] = panels[polar][:, [0, 1, 2, 2]]
    return panel_tables(vertices, panels)


def ship() -> PanelTables:
    """A Wigley form of 120 x 15 x 5 m with straight sides above, decked at 11 m, CG at 6.5 m."""
    s, z = np.linspace(-1, 1, 25)[:, None], np.concatenate([np.linspace(0, 5, 6), np.linspace(6.5, 11, 4)])
    half_breadth = 7.5 * (1 - s**2) * (1 - np.maximum(1 - z / 5, 0) ** 2)
    port = np.stack(np.broadcast_arrays(60 * s, half_breadth, z - 6.5), axis=-1)
    starboard = port * [1, -1, 1]
    deck = np.stack([port[:, -1], starboard[:, -1]], axis=1)
    return panel_tables(*lattice(port.swapaxes(0, 1), starboard, deck.swapaxes(0, 1)))


def frigate() -> PanelTables:
    """The frigate of TM 2004-041 on a coarse mesh."""
    loaded = load_ship("frigate", 10.0)
    return panel_tables(loaded.vertices, loaded.mesh.panels)


HULLS = {"box": box, "sphere": sphere, "ship": ship, "frigate": frigate}
DEG = np.pi / 180
ATTITUDES = {
    "upright": [0, 0, 0, 0, 0, 0],
    "heeled 25": [1, 2, 0.3, 25 * DEG, 2 * DEG, 0],
    "heeled 40": [0, 0, -0.5, -40 * DEG, -2 * DEG, 0],
    "trimmed and yawed": [3, -2, 0.5, 3 * DEG, 4 * DEG, 100 * DEG],
    "deck submerged": [0, 0, -3, 10 * DEG, 3 * DEG, 0],
    "bow out": [0, 0, 0.5, 5 * DEG, -7 * DEG, 0],
    "upside down": [0, 0, 1, 178 * DEG, 0, 20 * DEG],
    "on its end": [0, 0, 0, 0, 90 * DEG, 0],
    "fully under": [0, 0, -90, 10 * DEG, 0, 0],
    "out of the water": [0, 0, 90, 10 * DEG, 0, 0],
}
POSES = np.array([[17.0 + i, 1.0, *attitude] for i, attitude in enumerate(ATTITUDES.values())])


def sea(count: int, *, second_order: bool = False) -> WaveTables:
    """Short-crested components of a rough sea at 10 m/s forward speed."""
    random = np.random.default_rng(count)
    omega = np.linspace(0.3, 2.0, count)
    heading = random.uniform(0, 2 * np.pi, count)
    k = omega**2 / 9.80665
    return wave_tables(
        2.0 / max(count, 1) ** 0.5 * np.exp(-omega),
        k,
        heading,
        omega - 10 * k * np.cos(heading),
        random.uniform(0, 2 * np.pi, count),
        second_order=second_order,
    )


def stokes_wave() -> WaveTables:
    """A Stokes wave of 60 m and H/λ = 1/10 from the port bow at 10 m/s: the second order is 0.47 m."""
    k = 2 * np.pi / 60.0
    encounter = np.sqrt(9.80665 * k) - 10 * k * np.cos(2.5)
    return wave_tables(3.0, k, 2.5, encounter, 1.0, second_order=True)


SEAS = {
    "calm": sea(0),
    "one wave": sea(1),
    "19 waves": sea(19),
    "Stokes wave": stokes_wave(),
    # The second order of each of them: no sea, but the sum that the kernel does.
    "19 Stokes waves": sea(19, second_order=True),
}


def worst_difference(load: np.ndarray, reference: np.ndarray, panels: PanelTables) -> float:
    """Largest difference of force and moment, over the weight of water in the hull and its length."""
    hull = panels.points[panels.split_triangles]
    volume = np.einsum("tx,tx->", hull[:, 0], np.cross(hull[:, 1], hull[:, 2])) / 12
    weight = WATER["water_density"] * WATER["gravity"] * volume
    scale = np.array([weight] * 3 + [weight * np.ptp(hull[..., 0])] * 3)
    return float(np.abs((load - reference) / scale).max())


@pytest.mark.parametrize("waves", SEAS)
@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("hull", HULLS)
def test_kernel_agrees_with_its_twin_at_any_attitude(hull: str, stretching: str, waves: str) -> None:
    panels, sea = HULLS[hull](), SEAS[waves]
    given = {"waterline": -1.5, "stretching": stretching, **WATER}
    load = wetted_surface_load(panels, sea, POSES, **given)
    reference = oracle.wetted_surface_load(panels, sea, POSES, **given)
    assert np.isfinite(load).all()
    worst = worst_difference(load, reference, panels)
    print(f"{hull}, {stretching}, {waves}: worst difference {worst:.1e}")
    assert worst < AGREEMENT
    np.testing.assert_array_equal(load[-1], 0.0)  # out of the water


@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_vertices_exactly_on_the_surface_count_as_dry_and_do_no_harm(stretching: str) -> None:
    """The bottom, then the deck of the box exactly at the calm surface, then the surface half way."""
    poses = np.zeros((3, 8))
    poses[:, 4] = [3.0, -3.0, 0.0]
    panels, given = box(), {"waterline": 0.0, "stretching": stretching, **WATER}
    load = wetted_surface_load(panels, sea(0), poses, **given)
    weight = WATER["water_density"] * WATER["gravity"] * 20 * 10 * np.array([0.0, 6.0, 3.0])
    # Vertical sides, so that the clip is exact.
    np.testing.assert_allclose(load[:, 2], weight, atol=1e-12 * weight.max())
    np.testing.assert_allclose(load[:, [0, 1, 3, 4, 5]], 0.0, atol=1e-12 * weight.max() * 10)
    assert (
        worst_difference(load, oracle.wetted_surface_load(panels, sea(0), poses, **given), panels) < AGREEMENT
    )


def test_every_pattern_of_wet_and_dry_corners_of_one_panel() -> None:
    """One warped panel: all sixteen patterns, with a corner exactly at the surface among them."""
    for heights in itertools.product([-1.0, 0.0, 0.7], repeat=4):
        corners = np.column_stack([[0, 2, 2.2, 0], [0, 0.1, 1.5, 1], heights])
        panels, pose = panel_tables(corners, np.array([[0, 1, 2, 3]])), np.zeros((1, 8))
        for stretching in STRETCHINGS:
            given = {"waterline": 0.0, "water_density": 1.0, "gravity": 1.0, "stretching": stretching}
            load = wetted_surface_load(panels, sea(0), pose, **given)
            reference = oracle.wetted_surface_load(panels, sea(0), pose, **given)
            np.testing.assert_allclose(load, reference, atol=1e-14)


@pytest.mark.parametrize("waves", ["19 waves", "Stokes wave"])
def test_same_input_same_bits_alone_or_in_a_batch(waves: str) -> None:
    panels, sea, given = ship(), SEAS[waves], {"waterline": -1.5, **WATER}
    together = wetted_surface_load(panels, sea, POSES, **given)
    again = wetted_surface_load(panels, sea, POSES, **given)
    alone = np.concatenate([wetted_surface_load(panels, sea, pose[None], **given) for pose in POSES])
    np.testing.assert_array_equal(together, again)
    np.testing.assert_array_equal(together, alone)


def test_other_meshes_and_seas_do_not_compile_the_kernel_again() -> None:
    """One kernel for seas of first order and one for Stokes waves."""
    from taichi.lang import impl

    given = {"waterline": 0.0, **WATER}
    for waves in (sea(1), stokes_wave()):
        wetted_surface_load(box(), waves, POSES, **given)
    compiled = impl.get_runtime().get_num_compiled_functions()
    for stretching in STRETCHINGS:
        for waves in (sea(37), stokes_wave()):
            wetted_surface_load(ship(), waves, POSES[:2], stretching=stretching, **given)
    assert impl.get_runtime().get_num_compiled_functions() == compiled


@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_one_small_panel_of_a_stokes_wave_agrees_with_the_twin_in_every_pattern(stretching: str) -> None:
    """The cut, with nothing around it to hide it; corners up to 1 m above and below the surface."""
    given = {"waterline": 0.0, "water_density": 1.0, "gravity": 1.0, "stretching": stretching}
    for heights in itertools.product([-1.0, -0.3, 0.7], repeat=4):
        corners = np.column_stack([[0, 2, 2.2, 0], [0, 0.1, 1.5, 1], heights])
        panels, poses = panel_tables(corners, np.array([[0, 1, 2, 3]])), np.zeros((3, 8))
        poses[:, 0], poses[:, 1] = [0.0, 1.3, 2.9], 1.0
        load = wetted_surface_load(panels, stokes_wave(), poses, **given)
        reference = oracle.wetted_surface_load(panels, stokes_wave(), poses, **given)
        np.testing.assert_allclose(load, reference, atol=1e-13)


def test_deep_water_waves_of_any_length_stay_finite() -> None:
    """exp(-k d) under a ripple of 1 mm at 90 m: no overflow, no trace."""
    ripple = wave_tables(1e-5, 2 * np.pi / 1e-3, 0.3, 200.0, 0.0)
    pose = POSES[list(ATTITUDES).index("fully under")][None]
    given = {"waterline": -1.5, **WATER}
    load = wetted_surface_load(ship(), ripple, pose, **given)
    np.testing.assert_array_equal(load, wetted_surface_load(ship(), sea(0), pose, **given))


def test_bad_poses_and_stretchings_are_refused() -> None:
    panels, waves, given = box(), sea(1), {"waterline": 0.0, **WATER}
    with pytest.raises(PanelsimError, match=r"\(8,\)"):
        wetted_surface_load(panels, waves, POSES[0], **given)
    diverged = POSES.copy()
    diverged[3, 5] = np.inf
    with pytest.raises(PanelsimError, match="inf"):
        wetted_surface_load(panels, waves, diverged, **given)
    with pytest.raises(PanelsimError, match="airy"):
        wetted_surface_load(panels, waves, POSES, stretching="airy", **given)


def in_a_fresh_process(script: str) -> str:
    """Standard output of a Python script in a process of its own."""
    finished = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False
    )
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


def test_importing_panelsim_and_the_tables_leaves_taichi_alone() -> None:
    modules = "panelsim, panelsim.kernels.tables, panelsim.kernels.oracle, panelsim.kernels.runtime"
    script = f"import sys, {modules}; print('taichi' in sys.modules)"
    assert in_a_fresh_process(script) == "False\n"


def test_taichi_starts_without_a_word_on_standard_output() -> None:
    script = "from panelsim.kernels import pressure, runtime; runtime.start(); runtime.start()"
    assert in_a_fresh_process(script) == ""


def test_a_foreign_runtime_with_other_arithmetic_is_refused_and_a_like_one_used() -> None:
    script = """
from panelsim.errors import PanelsimError
from panelsim.kernels import runtime
ti = runtime.import_taichi()
ti.init(arch=ti.cpu, default_fp=ti.f64, fast_math=False)
program = ti.lang.impl.get_runtime().prog
runtime.start()
assert ti.lang.impl.get_runtime().prog is program
ti.init(arch=ti.cpu, default_fp=ti.f64, fast_math=True)
try:
    runtime.start()
except PanelsimError as error:
    print(error)
"""
    assert "fast_math=True" in in_a_fresh_process(script)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows does not fork")
def test_a_forked_process_is_told_to_spawn_instead_of_hanging() -> None:
    script = """
import os
from panelsim.errors import PanelsimError
from panelsim.kernels import runtime
runtime.start()
if os.fork() == 0:
    try:
        runtime.start()
    except PanelsimError as error:
        print(error, flush=True)
    os._exit(0)
os.wait()
"""
    assert "spawn" in in_a_fresh_process(script)
