"""Force and moment of the wave pressure on a hull at many attitudes: the grid against sums over all waves."""

import numpy as np
import pytest

from panelsim.conventions import FloatArray, rotation_to_earth
from panelsim.kernels.grid_plan import GridBox
from panelsim.kernels.grid_pressure import grid_fields
from panelsim.kernels.tables import WaveTables, wave_tables
from panelsim.kernels.wave_grid import wave_grid

G = 9.80665
# A ship of 124.5 m, at any of the attitudes below, from her keel to 3 m below a trough.
BOX = GridBox(-68.0, 68.0, -18.0, 18.0, 20.0)
# Of the largest dynamic load of each component; pointwise errors cancel over the hull by a part.
TOLERANCE = 2e-6
# Surge, sway, heave [m], roll, pitch, yaw [rad].
ATTITUDES = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, -2.0, -1.0, 0.44, 0.03, 0.0],
        [3.0, 1.0, 1.5, 0.0, -0.05, 0.05],
        [-4.0, 0.5, 0.0, -0.44, 0.05, 0.14],
        [2.0, 2.0, -0.5, 0.70, -0.03, -0.1],
        [0.0, 0.0, -3.0, 0.17, 0.05, 0.0],
    ]
)


def hull() -> tuple[FloatArray, FloatArray]:
    """Centroids and area vectors of a Wigley form of 124.5 x 15 x 5 m, straight sides above, in ship axes."""
    s, z = np.linspace(-1, 1, 51)[:, None], np.linspace(-5.0, 6.0, 23)
    half_breadth = 7.5 * (1 - s**2) * (1 - np.minimum(z / 5.0, 0.0) ** 2)
    port = np.stack(np.broadcast_arrays(62.25 * s, half_breadth, z), axis=-1)
    corners = port[:-1, :-1], port[1:, :-1], port[1:, 1:], port[:-1, 1:]
    centroid = sum(corners).reshape(-1, 3) / 4.0  # type: ignore[union-attr]
    area = 0.5 * np.cross(corners[3] - corners[1], corners[2] - corners[0]).reshape(-1, 3)
    mirror = np.array([1.0, -1.0, 1.0])
    return np.concatenate([centroid, centroid * mirror]), np.concatenate([area, area * mirror])


def sea(headings: FloatArray, frequencies: FloatArray, peak: float) -> WaveTables:
    """A sea of 4 m significant height with the tail of a wind sea."""
    random = np.random.default_rng(len(frequencies))
    height = np.sqrt(frequencies**-5 * np.exp(-1.25 * (peak / frequencies) ** 4))
    k = frequencies**2 / G
    return wave_tables(
        height / np.sqrt(0.5 * np.sum(height**2)),
        k,
        headings,
        frequencies - 8.0 * k * np.cos(headings),
        random.uniform(0.0, 2.0 * np.pi, len(k)),
    )


def long_crested(count: int) -> WaveTables:
    return sea(np.full(count, 2.6), np.linspace(0.3, 2.0, count), 2 * np.pi / 10)


def ordered() -> WaveTables:
    """20 frequencies from 8 directions."""
    frequency, heading = np.meshgrid(np.linspace(0.3, 2.0, 20), np.linspace(1.4, 3.8, 8))
    return sea(heading.ravel(), frequency.ravel(), 2 * np.pi / 6)


def jittered(count: int) -> WaveTables:
    """Each wave of its own frequency and heading."""
    random = np.random.default_rng(7)
    return sea(random.uniform(1.0, 4.0, count), random.uniform(0.3, 2.0, count), 2 * np.pi / 10)


SEAS = {
    "19 long-crested": long_crested(19),
    "160 long-crested": long_crested(160),
    "160 ordered, Tp 6 s": ordered(),
    "160 jittered": jittered(160),
    "2000 jittered": jittered(2000),
}


def loads(waves: WaveTables, *, on_grid: bool, stretching: str) -> FloatArray:
    """Force and moment (A, 6) over ρ g, in ship axes, of the whole panels that are wet."""
    centroid, area = hull()
    grid, result = wave_grid(waves, BOX, TOLERANCE) if on_grid else None, []
    for time, pose in enumerate(ATTITUDES):
        at = centroid @ rotation_to_earth(*pose[3:]).T + [0.0, 0.0, pose[2]]
        if grid is not None:
            shift = (float(pose[0]), float(pose[1]))
            elevation, head, _ = grid_fields(grid, at, 17.0 * time, displacement=shift, stretching=stretching)
        else:
            elevation, head = plain_sum(waves, at + pose[:3] * [1.0, 1.0, 0.0], 17.0 * time, stretching)
        wet = np.where(elevation > at[:, 2], head, 0.0)
        result.append(np.concatenate([-wet @ area, -wet @ np.cross(centroid, area)]))
    return np.array(result)


def plain_sum(
    waves: WaveTables, at: FloatArray, time: float, stretching: str
) -> tuple[FloatArray, FloatArray]:
    x, y, z = at.T[:, :, None]
    theta = waves.wavenumber_x * x + waves.wavenumber_y * y - waves.encounter_frequency * time - waves.phase
    crest = waves.amplitude * np.cos(theta)
    elevation = crest.sum(axis=1)
    depth = np.minimum(z[:, 0] - elevation if stretching == "wheeler" else z[:, 0], 0.0)
    return elevation, np.sum(crest * np.exp(waves.wavenumber * depth[:, None]), axis=1)


@pytest.mark.parametrize("stretching", ["wheeler", "none"])
@pytest.mark.parametrize("name", SEAS)
def test_dynamic_loads_agree_within_the_tolerance(name: str, stretching: str) -> None:
    direct = loads(SEAS[name], on_grid=False, stretching=stretching)
    difference = loads(SEAS[name], on_grid=True, stretching=stretching) - direct
    worst = np.abs(difference).max(axis=0) / np.abs(direct).max(axis=0)
    print(name, stretching, " ".join(f"{w:.1e}" for w in worst))
    assert 1e-10 < worst.max() < TOLERANCE
