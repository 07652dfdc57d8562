"""The compiled pressure kernel against its NumPy twin, and the manners of its Taichi runtime."""

import itertools
import subprocess
import sys

import numpy as np
import pytest

from panelsim.conventions import CUT_RULES, STRETCHINGS, panel_triangles, rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.kernels import oracle
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables
from panelsim.ship.bundled import load_ship

WATER = {"water_density": 1025.0, "gravity": 9.80665}
HEADS = {"waterline": 0.0, "water_density": 1.0, "gravity": 1.0}  # ρ g = 1: loads are heads times areas
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
    hull = panel_triangles(panels.points, panels.panels).reshape(-1, 3, 3)
    volume = np.einsum("tx,tx->", hull[:, 0], np.cross(hull[:, 1], hull[:, 2])) / 6
    weight = WATER["water_density"] * WATER["gravity"] * volume
    scale = np.array([weight] * 3 + [weight * np.ptp(hull[..., 0])] * 3)
    return float(np.abs((load - reference) / scale).max())


@pytest.mark.parametrize("waves", SEAS)
@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize("rule", CUT_RULES)
@pytest.mark.parametrize("hull", HULLS)
def test_kernel_agrees_with_its_twin_at_any_attitude(
    hull: str, rule: str, stretching: str, waves: str
) -> None:
    panels, sea = HULLS[hull](), SEAS[waves]
    given = {"waterline": -1.5, "stretching": stretching, "rule": rule, **WATER}
    load = wetted_surface_load(panels, sea, POSES, **given)
    reference = oracle.wetted_surface_load(panels, sea, POSES, **given)
    assert np.isfinite(load).all()
    worst = worst_difference(load, reference, panels)
    print(f"{hull}, {rule}, {stretching}, {waves}: worst difference {worst:.1e}")
    assert worst < AGREEMENT
    np.testing.assert_array_equal(load[-1], 0.0)  # out of the water


@pytest.mark.parametrize("rule", CUT_RULES)
@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_vertices_exactly_on_the_surface_count_as_dry_and_do_no_harm(stretching: str, rule: str) -> None:
    """The bottom, then the deck of the box exactly at the calm surface, then the surface half way."""
    poses = np.zeros((3, 8))
    poses[:, 4] = [3.0, -3.0, 0.0]
    panels, given = box(), {"waterline": 0.0, "stretching": stretching, "rule": rule, **WATER}
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
        for stretching, rule in itertools.product(STRETCHINGS, CUT_RULES):
            given = {"stretching": stretching, "rule": rule, **HEADS}
            load = wetted_surface_load(panels, sea(0), pose, **given)
            reference = oracle.wetted_surface_load(panels, sea(0), pose, **given)
            np.testing.assert_allclose(load, reference, atol=1e-14)


RIPPLE = wave_tables(0.3, 2 * np.pi / 4.0, 0.0, 1.0, 0.0)  # a crest at the origin, 4 m long


@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize(("phase", "alone"), [(0.0, "wet"), (np.pi, "dry")])
def test_a_centre_that_is_alone_wet_or_alone_dry_is_found(phase: float, alone: str, stretching: str) -> None:
    """A level plate of 2 x 2 m that looks down, under or over a crest or trough at its middle."""
    corners = np.array([[-1, -1, 0], [-1, 1, 0], [1, 1, 0], [1, -1, 0]], dtype=float)
    panels, pose = panel_tables(corners, np.array([[0, 1, 2, 3]])), np.zeros((1, 8))
    pose[0, :2] = phase, 1.0
    pose[0, 4] = 0.1 if alone == "wet" else -0.1  # ζ is 0 at the corners, ±0.3 m at the centre
    given = {"stretching": stretching, **HEADS}
    lift = {rule: wetted_surface_load(panels, RIPPLE, pose, rule=rule, **given)[0, 2] for rule in CUT_RULES}
    exact = oracle.subdivided_load(panels, RIPPLE, pose, levels=6, **given)[0, 2]
    print(f"{alone}, {stretching}: {lift}, exact {exact:.3f}")
    assert lift["vertex"] == pytest.approx(0.0 if alone == "wet" else 0.4, abs=0.08)
    # The pressure is far from quadratic over half a wave: only the side it errs to is certain.
    assert abs(lift["vertex+centre"] - exact) < 0.6 * abs(lift["vertex"] - exact)
    for rule in CUT_RULES:
        reference = oracle.wetted_surface_load(panels, RIPPLE, pose, rule=rule, **given)
        assert lift[rule] == pytest.approx(reference[0, 2], abs=1e-14)


def test_a_centre_wet_by_the_second_order_of_a_crest_is_found() -> None:
    """A plank along a Stokes wave, its ends 0.08 m above the water: the first order alone leaves it dry."""
    k, amplitude = 2 * np.pi / 12.0, 0.5
    crest = wave_tables(amplitude, k, 0.0, 1.0, 0.0, second_order=True)
    ends = amplitude * np.cos(k) + 0.5 * amplitude**2 * k * np.cos(2 * k)
    corners = np.array([[-1, -0.01, 0], [-1, 0.01, 0], [1, 0.01, 0], [1, -0.01, 0]])
    panels, pose = panel_tables(corners, np.array([[0, 1, 2, 3]])), np.zeros((1, 8))
    pose[0, 1], pose[0, 4] = 1.0, ends + 0.08
    assert amplitude * (1 - np.cos(k)) < 0.08
    load = wetted_surface_load(panels, crest, pose, **HEADS)
    assert abs(load[0, 2]) > 1e-5  # negative: Wheeler with Stokes has less than no pressure at a crest
    np.testing.assert_allclose(load, oracle.wetted_surface_load(panels, crest, pose, **HEADS), atol=1e-14)


@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_panels_skipped_as_surely_dry_are_dry(stretching: str) -> None:
    """Steep short waves, with only the crests in reach of the panels: nothing wet is left out."""
    corners = np.array([[x, y, 0.0] for x in np.arange(-6, 7, 1.0) for y in (-0.5, 0.5)])
    index = np.arange(0, len(corners) - 2, 2)
    panels = panel_tables(corners, np.stack([index, index + 1, index + 3, index + 2], axis=1))
    steep = wave_tables([0.2, 0.15], [3.1, 2.3], [0.0, 0.5], [1.0, 1.3], [0.0, 0.0])
    poses = np.zeros((200, 8))
    poses[:, 0], poses[:, 1] = np.linspace(0, 20, 200), 1.0
    poses[:, 4] = np.linspace(-0.1, 0.4, 200)
    given = {"stretching": stretching, **HEADS}
    load = wetted_surface_load(panels, steep, poses, **given)
    reference = oracle.wetted_surface_load(panels, steep, poses, **given)
    assert (reference[:, 2] > 0).sum() > 100 and (reference[:, 2] == 0).any()
    np.testing.assert_allclose(load, reference, atol=1e-13)


@pytest.mark.parametrize("rule", CUT_RULES)
def test_calm_water_lifts_the_surface_of_four_triangles_about_the_centre(rule: str) -> None:
    """A twisted panel, wet, cut and cut again: the load of the fan, which neither split has."""
    corners = np.column_stack([[0, 2, 2.2, 0], [0, 0.1, 1.5, 1], [-1.0, -0.1, -1.4, 0.5]])
    fan = panel_triangles(corners, np.array([[0, 1, 2, 3]]))[0].reshape(-1, 3)
    as_fan = panel_tables(fan, np.arange(12).reshape(4, 3)[:, [0, 1, 2, 2]])
    split = panel_tables(corners, np.array([[0, 1, 2, 2], [0, 2, 3, 3]]))
    one, poses = panel_tables(corners, np.array([[0, 1, 2, 3]])), np.zeros((4, 8))
    poses[:, 4], poses[:, 5] = [-3.0, 0.0, 0.4, 0.9], [0.0, 0.1, -0.2, 0.0]
    load, expected, other = (
        wetted_surface_load(surface, sea(0), poses, rule=rule, **HEADS) for surface in (one, as_fan, split)
    )
    np.testing.assert_allclose(load, expected, atol=1e-14)
    assert (np.abs(load - other).max(axis=1) > 0.01).all()


def test_calm_water_load_is_that_of_the_independent_hydrostatics() -> None:
    """Halifax at rest, heeled, trimmed, with her deck under water: weight of the volume at its centroid."""
    loaded = load_ship("halifax", 10.0)
    panels = panel_tables(loaded.vertices, loaded.mesh.panels)
    mesh = PanelMesh(loaded.vertices, loaded.mesh.panels)
    for roll, pitch, heave in ((0, 0, 0), (25, 2, 0.3), (-40, -2, -0.5), (10, 3, -7), (3, -7, 0.5)):
        pose = np.array([[0.0, 1.0, 0, 0, heave, roll * DEG, pitch * DEG, 0.0]])
        part = immersed_part(mesh, heel=roll * DEG, trim=pitch * DEG, waterline=loaded.waterline - heave)
        up = rotation_to_earth(roll * DEG, pitch * DEG, 0.0).T @ [0.0, 0.0, 1.0]
        centroid = rotation_to_earth(roll * DEG, pitch * DEG, 0.0).T @ part.volume_moment
        weight = WATER["water_density"] * WATER["gravity"]
        expected = weight * np.concatenate([part.volume * up, np.cross(centroid, up)])
        for rule in CUT_RULES:
            load = wetted_surface_load(panels, sea(0), pose, waterline=loaded.waterline, rule=rule, **WATER)[
                0
            ]
            assert np.abs(load - expected)[:3].max() < 1e-10 * weight * part.volume
            # Arms of half the length of the ship.
            assert np.abs(load - expected)[3:].max() < 1e-10 * weight * part.volume * 60.0


@pytest.mark.parametrize("rule", CUT_RULES)
@pytest.mark.parametrize("waves", ["19 waves", "Stokes wave"])
def test_same_input_same_bits_alone_or_in_a_batch(waves: str, rule: str) -> None:
    panels, sea, given = ship(), SEAS[waves], {"waterline": -1.5, "rule": rule, **WATER}
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
    for stretching, rule in itertools.product(STRETCHINGS, CUT_RULES):
        for waves in (sea(37), stokes_wave()):
            wetted_surface_load(ship(), waves, POSES[:2], stretching=stretching, rule=rule, **given)
    assert impl.get_runtime().get_num_compiled_functions() == compiled


@pytest.mark.parametrize("rule", CUT_RULES)
@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_one_small_panel_of_a_stokes_wave_agrees_with_the_twin_in_every_pattern(
    stretching: str, rule: str
) -> None:
    """The cut, with nothing around it to hide it; corners up to 1 m above and below the surface."""
    given = {"stretching": stretching, "rule": rule, **HEADS}
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


def test_bad_poses_stretchings_and_rules_are_refused() -> None:
    panels, waves, given = box(), sea(1), {"waterline": 0.0, **WATER}
    with pytest.raises(PanelsimError, match=r"\(8,\)"):
        wetted_surface_load(panels, waves, POSES[0], **given)
    diverged = POSES.copy()
    diverged[3, 5] = np.inf
    with pytest.raises(PanelsimError, match="inf"):
        wetted_surface_load(panels, waves, diverged, **given)
    with pytest.raises(PanelsimError, match="airy"):
        wetted_surface_load(panels, waves, POSES, stretching="airy", **given)
    for load in (wetted_surface_load, oracle.wetted_surface_load):
        with pytest.raises(PanelsimError, match=r"simpson[\s\S]*vertex\+centre"):
            load(panels, waves, POSES, rule="simpson", **given)


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
for other in ({"fast_math": True}, {"default_ip": ti.i64}, {"debug": True}, {"default_fp": ti.f32}):
    ti.init(**({"arch": ti.cpu, "default_fp": ti.f64, "fast_math": False, "log_level": ti.ERROR} | other))
    try:
        runtime.start()
    except PanelsimError as error:
        print(error)
"""
    told = in_a_fresh_process(script)
    for word in ("fast_math=True", "default_ip=i64", "debug=True", "default_fp=f32"):
        assert word in told


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


FIRST_CALLS = """
import numpy as np
import panelsim as ps
ship, sea = ps.load_ship("halifax", 10.0), ps.RegularSeaway(2.0, 0.6, 2.0)
"""


def test_threads_may_make_the_first_calls_together() -> None:
    """Taichi compiles one kernel at a time and is confused by a second."""
    script = (
        FIRST_CALLS
        + """
from concurrent.futures import ThreadPoolExecutor
with ThreadPoolExecutor(4) as pool:
    loads = list(pool.map(lambda roll: ps.pressure_force(ship, sea, 3.0, [0, 0, 0, roll, 0, 0]), [0.1] * 8))
print(len({load.tobytes() for load in loads}))
"""
    )
    assert in_a_fresh_process(script) == "1\n"


def test_an_interrupt_while_a_kernel_compiles_is_raised() -> None:
    """Taichi swallows it there, and a run would go on to its end."""
    script = (
        FIRST_CALLS
        + """
import os, signal
from panelsim.kernels import runtime
original = runtime.Launch._prepare
def prepare(self):
    os.kill(os.getpid(), signal.SIGINT)
    original(self)
runtime.Launch._prepare = prepare
try:
    ps.pressure_force(ship, sea, 3.0, [0.0] * 6)
except KeyboardInterrupt:
    print("interrupted")
"""
    )
    assert in_a_fresh_process(script) == "interrupted\n"


def test_a_launch_outlives_the_runtime_it_was_made_for() -> None:
    script = (
        FIRST_CALLS
        + """
from panelsim.kernels import runtime
from panelsim.loads.load import Instant
load = ps.WettedSurface(ship, [sea.components], [0.0])
rest = Instant(3.0, 1.0, np.zeros((1, 6)), np.zeros((1, 6)))
before = load.in_ship_axes(rest)
ti = runtime.import_taichi()
ti.reset()
ti.init(arch=ti.cpu, default_fp=ti.f64, fast_math=False, log_level=ti.ERROR)
print(np.array_equal(load.in_ship_axes(rest), before))
"""
    )
    assert in_a_fresh_process(script).splitlines()[-1] == "True"


def test_starting_taichi_leaves_the_arithmetic_of_the_process_alone() -> None:
    """It would flush the smallest numbers to zero, and functions of scipy that pass through them go wrong."""
    script = (
        FIRST_CALLS
        + """
before = ps.CosinePower(340.0).mean_cosine
ps.pressure_force(ship, sea, 3.0, [0.0] * 6)
sea.in_fixed_axes().elevation(np.zeros(20), 0.0, 0.0)
print(np.float64(1e-310) * 0.5 > 0.0, ps.CosinePower(340.0).mean_cosine == before)
"""
    )
    assert in_a_fresh_process(script).split() == ["True", "True"]
