"""The hull, the seas and the methods that `pressure_kernel.py` compares: panelsim's own and three plain sums.

The plain sums take a panel as wet or dry by its centroid, where they take its pressure too: in NumPy, in a
loop that Taichi compiles, and in C (`pressure_direct.c`).
"""

import ctypes
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property, partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from panelsim.conventions import CUT_RULES, KNOT, STANDARD_GRAVITY, FloatArray, rotation_to_earth
from panelsim.kernels import runtime
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables
from panelsim.seaway.direction.spreading import CosineSquared
from panelsim.seaway.frequencies import EvenFrequencies, FrequencyChoice, JitteredFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

ti = runtime.import_taichi()

C_SOURCE = Path(__file__).with_name("pressure_direct.c")
C_FLAGS = ("-O3", "-march=native", "-ffast-math", "-mprefer-vector-width=512", "-fPIC")

# Components by count: frequencies [rad/s], and the degrees between directions in short-crested seas.
SEAS: dict[int, tuple[FrequencyChoice, float | None]] = {
    19: (EvenFrequencies(0.2, 2.0, 0.1), None),
    37: (EvenFrequencies(0.2, 2.0, 0.05), None),
    160: (EvenFrequencies(0.3, 1.85, 0.05), 30.0),
    2000: (JitteredFrequencies(0.3, 2.275, 0.025), 180.0 / 26.0),
}
SPEED = 20 * KNOT
DENSITY = 1000.0  # kg/m3
# Poses scatter about zero by these: time, factor, surge, sway, heave, roll, pitch, yaw.
SCATTER = np.array([500.0, 0.0, 3.0, 2.0, 1.0, 0.1, 0.04, 0.03])

Evaluate = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class Setting:
    """A hull in a sea: what every method works from."""

    panel_area: float
    component_count: int

    @cached_property
    def ship(self) -> Ship:
        return load_ship("halifax", self.panel_area)

    @cached_property
    def panels(self) -> PanelTables:
        return panel_tables(self.ship.vertices, self.ship.mesh.panels)

    @cached_property
    def waves(self) -> WaveTables:
        choice, step = SEAS[self.component_count]
        spread = {} if step is None else {"spreading": CosineSquared(), "direction_step": np.deg2rad(step)}
        sea = RandomSeaway(Bretschneider(7.5, 15.0), choice, np.deg2rad(150.0), **spread)
        waves = sea.components
        return wave_tables(
            waves.amplitude,
            waves.wavenumber(),
            waves.wave_heading,
            waves.encounter_frequency(SPEED),
            waves.phase,
        )

    @cached_property
    def whole_panels(self) -> FloatArray:
        """Centroid [m] and area vector [m2] of the panels in ship axes, (6, N)."""
        mesh = self.ship.mesh
        area_vector = mesh.area_vector @ self.ship.rotation_from_hull.T
        return np.concatenate([self.ship.to_ship_axes(mesh.centroid), area_vector], axis=1).T.copy()

    @cached_property
    def components(self) -> FloatArray:
        """Amplitude, k_x, k_y, k, encounter frequency, phase: (6, M)."""
        sea = self.waves
        return np.array(
            [
                *(sea.amplitude, sea.wavenumber_x, sea.wavenumber_y, sea.wavenumber),
                *(sea.encounter_frequency, sea.phase),
            ]
        )

    def poses(self, count: int) -> FloatArray:
        """Poses (count, 8) of a ship under way in these waves."""
        poses = np.random.default_rng(1).normal(0.0, SCATTER, (count, 8))
        poses[:, 1] = 1.0
        return poses


def own_method(method: str, rule: str, setting: Setting) -> Evaluate:
    """One of panelsim's own."""
    with runtime.interrupts_held_back():
        from panelsim.kernels.pressure import PressureIntegral
    return PressureIntegral(
        setting.panels,
        [setting.waves],
        waterline=setting.ship.waterline,
        water_density=DENSITY,
        gravity=STANDARD_GRAVITY,
        rule=rule,
        method=method,
    )


def numpy_method(setting: Setting) -> Evaluate:
    """As one would write it down: matrices of panels times waves."""
    centroid, area_vector = setting.whole_panels[:3].T, setting.whole_panels[3:].T
    amplitude, kx, ky, k, frequency, lead = setting.components

    def load(pose: FloatArray) -> FloatArray:
        x, y, z = (centroid @ rotation_to_earth(*pose[5:]).T + pose[2:5]).T[:, :, None]
        z = z - setting.ship.waterline
        crest = pose[1] * amplitude * np.cos(kx * x + ky * y - frequency * pose[0] - lead)
        depth = np.minimum(z - crest.sum(axis=1, keepdims=True), 0.0)
        head = (crest * np.exp(k * depth)).sum(axis=1) - z[:, 0]
        force = -np.where(depth[:, 0] < 0.0, head, 0.0)[:, None] * area_vector
        return np.concatenate([force.sum(axis=0), np.cross(centroid, force).sum(axis=0)])

    return lambda poses: DENSITY * STANDARD_GRAVITY * np.array([load(pose) for pose in poses])


Rows = ti.types.ndarray(dtype=ti.f64, ndim=2)
Matrices = ti.types.ndarray(dtype=ti.f64, ndim=3)


@ti.func
def _crest(waves: ti.template(), m, place, poses: ti.template(), b):
    phase = waves[1, m] * place[0] + waves[2, m] * place[1] - waves[4, m] * poses[b, 0] - waves[5, m]
    return poses[b, 1] * waves[0, m] * ti.cos(phase)


@ti.kernel
def _naive_sum(panels: Rows, waves: Rows, rotations: Matrices, poses: Rows, loads: Rows):
    ti.loop_config(serialize=True)
    for b in range(poses.shape[0]):
        force, moment = ti.Vector([0.0, 0.0, 0.0]), ti.Vector([0.0, 0.0, 0.0])
        for n in range(panels.shape[1]):
            arm = ti.Vector([panels[0, n], panels[1, n], panels[2, n]])
            place = ti.Vector([0.0, 0.0, 0.0])
            for i in ti.static(range(3)):
                place[i] = poses[b, 2 + i]
                for j in ti.static(range(3)):
                    place[i] += rotations[b, i, j] * arm[j]
            elevation = 0.0
            for m in range(waves.shape[1]):
                elevation += _crest(waves, m, place, poses, b)
            if place[2] < elevation:
                head = -place[2]
                for m in range(waves.shape[1]):
                    head += _crest(waves, m, place, poses, b) * ti.exp(waves[3, m] * (place[2] - elevation))
                push = -head * ti.Vector([panels[3, n], panels[4, n], panels[5, n]])
                force += push
                moment += arm.cross(push)
        for i in ti.static(range(3)):
            loads[b, i], loads[b, 3 + i] = force[i], moment[i]


def naive_method(setting: Setting) -> Evaluate:
    """One scalar loop over panels and waves, compiled by Taichi."""

    def loads(poses: FloatArray) -> FloatArray:
        runtime.start()
        result = np.empty((len(poses), 6))
        rotations = np.array([rotation_to_earth(*pose[5:]) for pose in poses])
        _naive_sum(setting.whole_panels, setting.components, rotations, _above_water(poses, setting), result)
        return DENSITY * STANDARD_GRAVITY * result

    return loads


def _above_water(poses: FloatArray, setting: Setting) -> FloatArray:
    """The poses with the height of the CG above calm water in place of heave."""
    return poses - setting.ship.waterline * np.eye(8)[4]


@cache
def c_library() -> tuple[ctypes.CDLL, list[str]]:
    """The C sum, compiled for this processor, and the packed functions it takes from the C library."""
    with TemporaryDirectory() as folder:
        compiled, target = Path(folder) / "pressure_direct.o", Path(folder) / "pressure_direct.so"
        subprocess.run(["gcc", *C_FLAGS, "-c", "-o", compiled, C_SOURCE], check=True)
        # Linked without -ffast-math, which would have the whole process read the smallest numbers as zero:
        # scipy's search trees crash then.
        subprocess.run(["gcc", "-shared", "-o", target, compiled, "-lm"], check=True)
        packed = sorted({name.decode() for name in re.findall(rb"_ZGV\w+_(?:cos|exp)", target.read_bytes())})
        return ctypes.CDLL(str(target)), packed


def c_method(setting: Setting) -> Evaluate:
    """The same in C, blocks of panels with the waves outside."""
    library, _ = c_library()
    panels, waves = setting.whole_panels, setting.components

    def loads(poses: FloatArray) -> FloatArray:
        result, shifted = np.empty((len(poses), 6)), _above_water(poses, setting)
        panel, wave, pose, load = (ctypes.c_void_p(a.ctypes.data) for a in (panels, waves, shifted, result))
        if library.pressure_direct(panels.shape[1], panel, waves.shape[1], wave, len(poses), pose, load):
            raise MemoryError
        return DENSITY * STANDARD_GRAVITY * result

    return loads


Method = Callable[[Setting], Evaluate]
C_SUM = "C, plain"
PLAIN: dict[str, Method] = {C_SUM: c_method, "NumPy, plain": numpy_method, "Taichi, naive": naive_method}
# One line for each method of the project: its name and how it is made ready for a setting.
METHODS: dict[str, Method] = PLAIN | {
    f"{method}, {rule.replace('+', ' + ')}": partial(own_method, method, rule)
    for method in ("direct", "grid")
    for rule in CUT_RULES
}


def available() -> dict[str, Method]:
    """The methods by name; without the C sum where there is no gcc."""
    return {name: method for name, method in METHODS.items() if name != C_SUM or shutil.which("gcc")}
