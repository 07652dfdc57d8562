"""Elevation and pressure of 160 waves at 1e5 points in one call. Run: python benchmarks/seaway_views.py

CPU seconds of this process, best of three, against the obvious NumPy: cos and exp of a matrix of points
times waves, in chunks that stay in the cache. What starting Taichi and compiling costs is printed apart,
and so are calls up to the size where the compiled sum takes over from the NumPy twin.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from panelsim.conventions import KNOT, FloatArray
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.translating import TranslatingSeaway
from panelsim.seaway.view import SMALL

POINTS, WAVES, CHUNK = 100_000, 160, 2_000
SPEED, DENSITY, REPEATS = 20 * KNOT, 1025.0, 3


def short_crested_sea() -> TranslatingSeaway:
    """20 frequencies from 8 directions."""
    random = np.random.default_rng(1)
    omega, heading = np.meshgrid(np.linspace(0.3, 2.0, 20), np.linspace(1.6, 3.6, 8))
    waves = WaveComponents(
        0.3 * np.exp(-omega.ravel()), omega.ravel(), heading.ravel(), random.uniform(0, 2 * np.pi, WAVES)
    )
    return TranslatingSeaway(waves, SPEED)


def plain(sea: TranslatingSeaway, points: FloatArray, *, pressure: bool) -> FloatArray:
    """Elevation, or pressure with Wheeler's stretching, as one would write it down."""
    waves = sea.components
    k = waves.wavenumber(sea.gravity)
    kx, ky = k * np.cos(waves.wave_heading), -k * np.sin(waves.wave_heading)
    encounter = waves.encounter_frequency(sea.speed, sea.gravity)
    result = np.empty(len(points))
    for first in range(0, len(points), CHUNK):
        x, y, z, t = points[first : first + CHUNK].T[:, :, None]
        crest = waves.amplitude * np.cos(kx * x + ky * y - encounter * t - waves.phase)
        elevation, z = crest.sum(axis=1), z[:, 0]
        if pressure:
            head = (crest * np.exp(k * np.minimum(z - elevation, 0.0)[:, None])).sum(axis=1) - z
            elevation = np.where(z <= elevation, DENSITY * sea.gravity * head, 0.0)
        result[first : first + CHUNK] = elevation
    return result


def seconds(call: Callable[[], object]) -> float:
    """Best CPU seconds of a call."""
    spent = []
    for _ in range(REPEATS):
        begin = time.process_time()
        call()
        spent.append(time.process_time() - begin)
    return min(spent)


def main() -> None:
    sea = short_crested_sea()
    random = np.random.default_rng(2)
    points = random.uniform([-300, -300, -10, 0], [300, 300, 1, 3600], (POINTS, 4))
    x, y, z, t = points.T

    begin = time.process_time()
    replace(sea, method="direct").elevation(0.0, 0.0, 0.0)
    print(
        f"first call, Taichi started and the kernel compiled or loaded: {time.process_time() - begin:.2f} s"
    )

    calls: dict[str, tuple[Callable[[], FloatArray], Callable[[], FloatArray] | None]] = {
        "elevation": (lambda: sea.elevation(x, y, t), lambda: plain(sea, points, pressure=False)),
        "pressure": (
            lambda: sea.pressure(x, y, z, t, water_density=DENSITY),
            lambda: plain(sea, points, pressure=True),
        ),
        "velocity": (lambda: sea.velocity(x, y, z, t), None),
    }
    print(f"{POINTS} points, {WAVES} waves   view    a point and wave   NumPy / view   difference")
    for name, (view, numpy) in calls.items():
        spent = seconds(view)
        line = f"{name:26s} {1e3 * spent:6.0f} ms {1e9 * spent / (POINTS * WAVES):10.2f} ns"
        if numpy is not None:
            difference = np.abs(view() - numpy()).max() / np.abs(numpy()).max()
            line += f" {seconds(numpy) / spent:15.1f} {difference:14.0e}"
        print(line)

    print(f"\npressure in small calls (the compiled sum takes over at {SMALL} points times waves)")
    for count in (1, 100, 1_000, SMALL // WAVES):
        twin, direct = (
            seconds(partial(view.pressure, *points[:count].T, water_density=DENSITY))
            for view in (replace(sea, method="oracle"), replace(sea, method="direct"))
        )
        print(f"{count:6d} points   twin {1e3 * twin:7.2f} ms   compiled {1e3 * direct:6.2f} ms")


if __name__ == "__main__":
    main()
