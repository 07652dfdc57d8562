"""The sea and the hull as they are drawn: where their vertices are and how they are coloured."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import ComplexArray, FloatArray, IntArray, rotation_to_earth
from panelsim.motion.equations import ramp_factor
from panelsim.motion.history import History
from panelsim.seaway.translating import TranslatingSeaway

ColorArray = NDArray[np.uint32]  # 0xRRGGBBAA

# Stops of the colour scales: position and red, green, blue.
WET_HULL = np.array([[0.0, 188, 226, 240], [0.35, 84, 160, 214], [0.7, 32, 88, 168], [1.0, 12, 36, 92]])
DRY_TOPSIDES = np.array([186, 190, 194])
DRY_BOTTOM = np.array([186, 58, 44])
SEA = np.array([[0.0, 8, 40, 66], [0.5, 22, 92, 118], [0.8, 74, 158, 172], [1.0, 226, 242, 242]])
# Towards the sun, which only shades the sea.
SUN = np.array([0.45, 0.55, 0.70])
SEA_OPACITY = 215  # of 255: the hull shows through
GRID_COUNT = 65
GRID_REACH = 1.2  # ship lengths from the ship to the edge of the drawn sea


@dataclass(frozen=True)
class SeaGrid:
    """A square of sea around the ship with the spatial part of every wave worked out once.

    On a grid of lines x and y the sum over components is a product of two small matrices,
    ζ = Re Σ a e^(−i(ω_e t + ε)) e^(i k x cos β) e^(−i k y sin β), so that a frame costs almost nothing.
    The second order of a Stokes wave A = a e^(iθ), ½ a² k cos 2θ of TM 2003-190 (17), is ½ k Re A².
    """

    line: FloatArray  # (n,) [m], the same for x and y, about the ship
    along_x: ComplexArray  # (n, M)
    along_y: ComplexArray  # (M, n)
    history: History

    @classmethod
    def around(cls, history: History, lengths: float = GRID_REACH) -> "SeaGrid":
        """The sea out to so many ship lengths on every side."""
        reach = lengths * float(history.loading["length"])
        line = np.linspace(-reach, reach, GRID_COUNT)
        waves = history.components
        k = waves.wavenumber(float(history.loading["gravity"]))
        along_x = np.exp(1j * np.outer(line, k * np.cos(waves.wave_heading)))
        along_y = np.exp(-1j * np.outer(k * np.sin(waves.wave_heading), line))
        return cls(line, along_x, along_y, history)

    @property
    def triangles(self) -> IntArray:
        """Vertex indices (2 (n − 1)², 3), counter-clockwise seen from above."""
        n = len(self.line)
        corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
        first = np.column_stack([corner, corner + n, corner + n + 1])
        second = np.column_stack([corner, corner + n + 1, corner + 1])
        return np.concatenate([first, second])

    def elevation(self, row: int) -> FloatArray:
        """Elevation (n, n) [m] above calm water, x down and y across, about the ship at this time step."""
        waves, gravity = self.history.components, float(self.history.loading["gravity"])
        time = float(self.history.time[row])
        x, y = self.history.displacement[row, :2]
        k = waves.wavenumber(gravity)
        angle = k * (x * np.cos(waves.wave_heading) - y * np.sin(waves.wave_heading)) - waves.phase
        angle -= waves.encounter_frequency(self.history.attrs["speed"], gravity) * time
        amplitude = ramp_factor(time, self.history.attrs["ramp"]) * waves.amplitude
        # einsum, not @: threads of a matrix library cost more than these small products
        weight = amplitude * np.exp(1j * angle)
        complex_elevation = np.einsum("xm,my->xy", self.along_x * weight, self.along_y)
        if waves.second_order:  # a single wave
            complex_elevation = complex_elevation + 0.5 * k[0] * complex_elevation**2
        return np.real(complex_elevation)

    def vertices(self, row: int, elevation: FloatArray) -> FloatArray:
        """Vertices (n², 3) [m] of the sea in translating earth axes."""
        x, y = self.history.displacement[row, :2]
        grid = np.meshgrid(x + self.line, y + self.line, indexing="ij")
        return np.stack([*grid, self.history.waterline + elevation], axis=-1).reshape(-1, 3)

    def colors(self, elevation: FloatArray, highest: float) -> ColorArray:
        """Colours (n²,): dark troughs to pale crests at ±`highest` [m], shaded by the slope."""
        slope_x, slope_y = np.gradient(elevation, self.line, self.line)
        normal = np.stack([-slope_x, -slope_y, np.ones_like(elevation)], axis=-1)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        light = np.clip(normal @ SUN / SUN[2], 0.0, 2.0) ** 2  # squared: gentle slopes would hardly show
        scaled = 0.5 + 0.5 * elevation / max(highest, 1e-9)
        return _pack(_scale(SEA, scaled.ravel()) * light.reshape(-1, 1), SEA_OPACITY)


def pressure_head(history: History, row: int) -> FloatArray:
    """Pressure over ρ g (V,) [m] at the hull's vertices where they are at this time step; zero where dry."""
    time, motion = float(history.time[row]), history.displacement[row]
    x, y, z = (history.mesh_vertices @ rotation_to_earth(*motion[3:]).T + motion[:3]).T
    waves = history.components
    grown = replace(waves, amplitude=ramp_factor(time, history.attrs["ramp"]) * waves.amplitude)
    density, gravity = (float(history.loading[name]) for name in ("water_density", "gravity"))
    stretching = history.seaway_attrs["stretching"]
    # Compiled, because there are thousands of frames.
    sea = TranslatingSeaway(grown, history.attrs["speed"], gravity, stretching=stretching, method="direct")
    return sea.pressure(x, y, z - history.waterline, time, water_density=density) / (density * gravity)


def deepest_head(history: History) -> float:
    """Pressure head [m] that is drawn darkest: half as much again as at the keel at rest."""
    return 1.5 * float(history.waterline - history.mesh_vertices[:, 2].min())


def hull_colors(history: History, head: FloatArray) -> ColorArray:
    """Colours (V,): wet hull from pale to dark blue with the pressure head (V,) [m]; dry topsides grey.

    Bottom that has come out of the water is red, the sign of slamming to come.
    """
    wet = _scale(WET_HULL, head / deepest_head(history))
    topsides = history.mesh_vertices[:, 2:] > history.waterline - 1e-9
    return _pack(np.where(head[:, None] > 0.0, wet, np.where(topsides, DRY_TOPSIDES, DRY_BOTTOM)), 255)


def _scale(stops: FloatArray, values: FloatArray) -> FloatArray:
    return np.column_stack([np.interp(values, stops[:, 0], stops[:, channel]) for channel in (1, 2, 3)])


def _pack(rgb: FloatArray, opacity: int) -> ColorArray:
    red, green, blue = np.clip(rgb, 0, 255).astype(np.uint32).T
    return (red << 24) | (green << 16) | (blue << 8) | np.uint32(opacity)
