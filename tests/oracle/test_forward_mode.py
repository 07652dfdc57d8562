"""The stiffness by differences against derivatives that Taichi takes of the formulas themselves.

The kernel here is plain scalar code, written apart from the package: heads at the points of wholly wet
panels, turned into loads in earth axes by the fixed responses of the points. Taichi's forward mode
carries the six derivatives through it, one pose variable a pass.
"""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from panelsim.kernels import runtime
from panelsim.kernels.tables import panel_tables
from panelsim.loads.derivatives import pressure_stiffness
from panelsim.loads.load import Instant
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.seaway.components import WaveComponents
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

ti = runtime.import_taichi()

SPEED, TIME = 6.0, 11.0  # m/s, s
WAVES = WaveComponents(
    np.array([1.4, 0.8, 0.5]),
    np.array([0.55, 0.8, 1.1]),
    np.array([2.6, 0.7, 4.4]),
    np.array([0.3, 2.0, 5.1]),
)
# The forward mode wants fields, and those cannot be empty: calm water is a wave without height.
FLAT = WaveComponents(np.zeros(1), np.ones(1), np.zeros(1), np.zeros(1))
# The frigate with her highest point just under these waves, heeled 20 degrees and yawed 30.
UNDER = (3.0, -5.0, -14.0, 0.35, -0.04, 0.5)


@ti.kernel
def add_earth_load(
    pose: ti.template(),
    load: ti.template(),
    points: ti.template(),
    response: ti.template(),
    waves: ti.template(),
    waterline: ti.f64,
):
    """Σ head x response [m3, m4]; waves: a, kx, ky, k and the phase at the origin, a column each."""
    for p in range(points.shape[0]):
        cr, sr = ti.cos(pose[3]), ti.sin(pose[3])
        cp, sp = ti.cos(pose[4]), ti.sin(pose[4])
        cy, sy = ti.cos(pose[5]), ti.sin(pose[5])
        forward = points[p, 0] * cp + (points[p, 1] * sr + points[p, 2] * cr) * sp
        sideways = points[p, 1] * cr - points[p, 2] * sr
        x = pose[0] + forward * cy - sideways * sy
        y = pose[1] + forward * sy + sideways * cy
        z = pose[2] - waterline + (points[p, 1] * sr + points[p, 2] * cr) * cp - points[p, 0] * sp
        elevation = 0.0
        for m in range(waves.shape[0]):
            elevation += waves[m, 0] * ti.cos(waves[m, 1] * x + waves[m, 2] * y - waves[m, 4])
        head = -z
        for m in range(waves.shape[0]):
            crest = waves[m, 0] * ti.cos(waves[m, 1] * x + waves[m, 2] * y - waves[m, 4])
            head += crest * ti.exp(waves[m, 3] * (z - elevation))
        along = response[p, 0] * cp + (response[p, 1] * sr + response[p, 2] * cr) * sp
        across = response[p, 1] * cr - response[p, 2] * sr
        about_vertical = (response[p, 4] * sr + response[p, 5] * cr) * cp - response[p, 3] * sp
        load[0] += head * (along * cy - across * sy)
        load[1] += head * (along * sy + across * cy)
        load[2] += head * ((response[p, 1] * sr + response[p, 2] * cr) * cp - response[p, 0] * sp)
        load[3] += head * response[p, 3]
        load[4] += head * (response[p, 4] * cr - response[p, 5] * sr)
        load[5] += head * about_vertical


def forward_stiffness(
    ship: Ship, waves: WaveComponents, displacement: tuple[float, ...], wet: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """−∂F/∂η (6, 6) of the panels `wet` (N,), column by column, and the load itself (6,)."""
    runtime.start()
    tables = panel_tables(ship.vertices, ship.mesh.panels[wet])
    response = tables.response["vertex+centre"]
    used = np.abs(response).max(axis=1) > 0.0
    k, beta = waves.wavenumber(ship.gravity), waves.wave_heading
    phase = waves.encounter_frequency(SPEED, ship.gravity) * TIME + waves.phase
    columns = [waves.amplitude, k * np.cos(beta), -k * np.sin(beta), k, phase]
    pose, load = field(np.array(displacement), needs_dual=True), field(np.zeros(6), needs_dual=True)
    given = [field(a) for a in (tables.points[used], response[used], np.column_stack(columns))]
    weight_density = ship.water_density * ship.gravity
    slopes = []
    for dof in range(6):
        load.fill(0.0)
        with ti.ad.FwdMode(loss=load, param=pose, seed=np.eye(6)[dof].tolist()):
            add_earth_load(pose, load, *given, ship.waterline)
        slopes.append(load.dual.to_numpy())
    return -weight_density * np.array(slopes).T, weight_density * load.to_numpy()


def field(values: np.ndarray, *, needs_dual: bool = False) -> Any:
    made = ti.field(ti.f64, shape=values.shape, needs_dual=needs_dual)
    made.from_numpy(values)
    return made


def scale(ship: Ship) -> np.ndarray:
    """Of each entry of a stiffness (6, 6): heave, roll and pitch at rest, and what they say of the others."""
    heave, roll, pitch = np.abs(np.diag(ship.hydrostatics.stiffness))[2:5]
    root = np.sqrt([heave, heave, heave, roll, pitch, pitch])
    return np.outer(root, root)


def test_stiffness_under_waves_is_the_derivative_that_taichi_takes() -> None:
    """Deep under three waves, at an angle to all axes: every panel is wet and every entry is at work."""
    ship = load_ship("halifax", 10.0)
    every = np.ones(ship.mesh.panel_count, dtype=bool)
    expected, load = forward_stiffness(ship, WAVES, UNDER, every)
    sea = SimpleNamespace(kind="given", components=WAVES)
    found = pressure_stiffness(ship, sea, TIME, UNDER, speed=SPEED)
    wetted = WettedSurface(ship, [WAVES], [SPEED])
    reference = wetted.evaluate(Instant(TIME, 1.0, np.array([UNDER]), np.zeros((1, 6))))[0]
    # The same formulas: rounding of a thousand terms.
    np.testing.assert_allclose(load, reference, rtol=0, atol=1e-11 * np.abs(reference).max())
    error = np.abs((found - expected) / scale(ship)).max()
    print(f"stiffness under waves: {error:.1e} from the forward mode")
    # Rounding of the differences is 1e-9; 1e-6 is asked for.
    assert error < 1e-8
    # The waves make 1 % of the scale of each column: what the 1e-8 hold is their part too.
    calm = pressure_stiffness(ship, displacement=UNDER)
    assert (np.abs((expected - calm) / scale(ship)).max(axis=0) > 0.01).all()


def test_stiffness_at_rest_is_the_derivative_that_taichi_takes() -> None:
    """Afloat on a mesh that ends at the water: the pressure is 0 there, so no panel joins to first order."""
    ship = load_ship("halifax", 10.0)
    wet = (ship.vertices[ship.mesh.panels][..., 2] <= ship.waterline).all(axis=1)
    assert 0 < wet.sum() < ship.mesh.panel_count and ship.straddling_panels == 0
    expected, load = forward_stiffness(ship, FLAT, (0.0,) * 6, wet)
    assert load[2] == pytest.approx(ship.mass * ship.gravity, rel=1e-9)
    error = np.abs((pressure_stiffness(ship) - expected) / scale(ship)).max()
    print(f"stiffness at rest: {error:.1e} from the forward mode")
    # The kink of the flare at the waterline is cancelled down to 1e-9.
    assert error < 1e-8
