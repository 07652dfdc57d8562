"""Every method and rule of the pressure integral on four hulls at eight attitudes, in 1, 19 and 160 waves.

Against the NumPy twin, against the brute-force sum over subdivided facets, and in calm water against the
hydrostatics of the hull, which cut their triangles by other code.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from panelsim.conventions import CUT_RULES, RULES, STRETCHINGS, FloatArray, rotation_to_earth
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.kernels import oracle
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables
from panelsim.ship.bundled import load_ship

DENSITY, GRAVITY = 1025.0, 9.80665
DEG = np.pi / 180
LENGTH = 124.5  # m, of every hull here, so that one sea suits them all
# By method, how far it may be from the NumPy twin, in parts of the dynamic load: direct sums differ in
# the order of a few thousand terms, the grid is as good as its default tolerance says.
METHODS = {"direct": 1e-11, "grid": 2e-6}
COUNTS = (1, 19, 160)


@dataclass(frozen=True)
class Hull:
    """A closed mesh in ship axes, about its CG, and calm water when upright [m]."""

    mesh: PanelMesh
    waterline: float

    @property
    def tables(self) -> PanelTables:
        return panel_tables(self.mesh.vertices, self.mesh.panels)

    @property
    def water(self) -> dict[str, float]:
        return {"waterline": self.waterline, "water_density": DENSITY, "gravity": GRAVITY}

    @property
    def draft(self) -> float:
        return self.waterline - float(self.mesh.vertices[:, 2].min())

    @property
    def freeboard(self) -> float:
        return float(self.mesh.vertices[:, 2].max()) - self.waterline


# Panel areas that give box and sphere some 800 panels, the Wigley model its 1844 and the frigate its 2596.
SHIPS = {"box": 1.0, "sphere": 0.4, "wigley_iii": None, "halifax": 2.5}


@cache
def hull(name: str) -> Hull:
    """A bundled ship, stretched to the length of the frigate."""
    ship = load_ship(name, SHIPS[name])
    scale = LENGTH / np.ptp(ship.vertices[:, 0])
    return Hull(PanelMesh(ship.vertices * scale, ship.mesh.panels), ship.waterline * scale)


# Heave in drafts up and in freeboards down, then roll, pitch and yaw.
ATTITUDES = {
    "at rest": (0.0, 0, 0, 0),
    "heeled 25, trimmed, yawed": (0.06, 25, 2, 8),
    "heeled 40": (-0.1, -40, -2, 0),
    "deck submerged": (-1.1, 10, 3, 0),
    "bow out": (0.2, 3, -7, 0),
    "stern out": (0.2, -5, 7, 0),
    "capsized": (0.0, 150, 3, 20),
    "upside down": (0.0, 180, 0, 0),
}


def poses(of: Hull) -> FloatArray:
    """The attitudes, each at an instant of its own."""
    rows = []
    for i, (heave, roll, pitch, yaw) in enumerate(ATTITUDES.values()):
        up = heave * (of.draft if heave > 0 else of.freeboard)
        rows.append([3.0 + 7.0 * i, 1.0, 0.3 * i, -0.2 * i, up, roll * DEG, pitch * DEG, yaw * DEG])
    return np.array(rows)


@cache
def sea(count: int) -> WaveTables:
    """One wave as long as the ship, 19 of one direction, or 160 in eight: Hs 4 m, Tp 10 s, at 10 m/s."""
    random = np.random.default_rng(count)
    omega, heading = np.array([0.7]), np.array([2.5])
    if count > 1:
        directions = 2.5 + (np.linspace(-1.2, 1.2, 8) if count == 160 else np.zeros(1))
        grid = np.meshgrid(np.linspace(0.3, 2.0, count // len(directions)), directions)
        omega, heading = grid[0].ravel(), grid[1].ravel()
    amplitude = omega**-2.5 * np.exp(-0.625 * (0.63 / omega) ** 4) * np.cos(heading - 2.5)
    amplitude *= np.sqrt(2.0 / (amplitude**2).sum())
    k = omega**2 / GRAVITY
    encounter = omega - 10 * k * np.cos(heading)
    return wave_tables(amplitude, k, heading, encounter, random.uniform(0, 2 * np.pi, len(omega)))


def dynamic_load(of: Hull, waves: WaveTables) -> FloatArray:
    """Largest load (6,) of the waves of each kind over the attitudes."""
    at, still = poses(of), poses(of) * (np.arange(8) != 1)
    load, calm = (wetted_surface_load(of.tables, waves, each, **of.water) for each in (at, still))
    return np.abs(load - calm).max(axis=0)


def brute_force(of: Hull, waves: WaveTables, at: FloatArray) -> FloatArray:
    """Load on the facets from a linear pressure on 1/4 and on 1/16 of their triangles, extrapolated.

    That pressure errs with the square of the size. A part of the hull at a time, for the memory.
    """
    load = np.zeros((len(at), 6))
    for panels in np.array_split(of.mesh.panels, max(1, len(of.mesh.panels) * len(waves.amplitude) // 8000)):
        tables = panel_tables(of.mesh.vertices, panels)
        coarse, fine = (oracle.subdivided_load(tables, waves, at, levels=n, **of.water) for n in (1, 2))
        load += fine + (fine - coarse) / 3.0
    return load
