"""From a mesh file of one's own to statistics: read, check, load, solve, run.

    python examples/own_mesh.py FOLDER

writes FOLDER/hull.stl, as a drawing program might leave it, and works with that. own_mesh.toml does the same
as a case file.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

from panelsim import (
    KNOT,
    History,
    HydroDatabase,
    PanelMesh,
    RegularSeaway,
    Ship,
    Supplementary,
    check_mesh,
    read_mesh,
    simulate,
    statistics,
)

LENGTH, BEAM, DRAFT, DEPTH = 60.0, 10.0, 3.0, 6.0  # m
STATIONS = -np.cos(np.linspace(0.0, np.pi, 25))  # from aft to forward, -1 to 1, closer at the ends
LEVELS = np.array([0.0, 0.25, 0.6, 1.0, 2.0])  # drafts; the last is the deck


def write_hull(path: Path) -> None:
    """Write a closed hull y = ±B/2 (1 − s²)(1 − (1 − t)³) as text STL: mm, from the aft perpendicular.

    s runs from -1 aft to 1 forward, t = min(z/DRAFT, 1); above the waterline the sides are vertical.
    """
    s, level = np.meshgrid(STATIONS, LEVELS, indexing="ij")
    y = 0.5 * BEAM * (1.0 - s**2) * (1.0 - (1.0 - np.minimum(level, 1.0)) ** 3)
    side = np.stack([0.5 * LENGTH * s, y, DRAFT * level], axis=-1)
    middle_of_deck = side[:, -1:] * (1.0, 0.0, 1.0)
    port = _triangles(np.concatenate([side, middle_of_deck], axis=1))
    starboard = (port * (1.0, -1.0, 1.0))[:, ::-1]
    from_aft = np.concatenate([port, starboard]) + np.array([0.5 * LENGTH, 0.0, 0.0])
    facets = [
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x:.3f} {y:.3f} {z:.3f}\n" for x, y, z in corners)
        + "endloop\nendfacet\n"
        for corners in 1000.0 * from_aft
    ]
    path.write_text(f"solid hull\n{''.join(facets)}endsolid hull\n")


def _triangles(grid: np.ndarray) -> np.ndarray:
    """Triangles (T, 3, 3) of a grid of points, but those that have no area or lie in the centreline plane."""
    a, b, c, d = grid[1:, :-1], grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:]
    both = np.concatenate([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)]).reshape(-1, 3, 3)
    area = np.linalg.norm(np.cross(both[:, 1] - both[:, 0], both[:, 2] - both[:, 0]), axis=1)
    return both[(area > 1e-9) & np.any(both[..., 1] != 0.0, axis=1)]


def read_hull(path: Path) -> PanelMesh:
    """The mesh in hull axes: metres, from midships, centreline and baseline."""
    return read_mesh(path, length_unit="mm", up="z", forward="x", origin=(1000 * LENGTH / 2, 0.0, 0.0))


def load(mesh: PanelMesh) -> Ship:
    """The ship: it floats at its draft on an even keel, so mass and longitudinal CG follow."""
    return Ship(
        mesh,
        draft=DRAFT,
        center_of_gravity=(None, 0.0, 3.5),
        gyradii=(0.35 * BEAM, 0.25 * LENGTH, 0.25 * LENGTH),
        name="own hull",
    )


def run(ship: Ship, database: HydroDatabase) -> History:
    """The ship at 8 knots in a regular head wave as long as itself and 1 m high."""
    wave_frequency = np.sqrt(2 * np.pi * ship.gravity / LENGTH)
    return simulate(
        ship,
        RegularSeaway(0.5, wave_frequency, wave_heading=np.pi),
        speed=8 * KNOT,
        duration=60.0,
        time_step=0.1,
        ramp=20.0,
        database=database,
        supplementary=Supplementary(stiffness={"surge": 1e5, "sway": 2e5, "yaw": 1e8}, damping={"roll": 1e6}),
    )


def main(folder: Path) -> History:
    """Go the whole way and leave hull.stl, hydro.nc and history.nc in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    write_hull(folder / "hull.stl")
    mesh = read_hull(folder / "hull.stl")
    print(check_mesh(mesh, wave_length=LENGTH).summary())
    ship = load(mesh)
    database = HydroDatabase.compute(ship)  # boundary elements on this mesh, some ten seconds
    database.save(folder / "hydro.nc", overwrite=True)
    history = run(ship, database)
    history.save(folder / "history.nc", overwrite=True)
    motions = statistics(history).motions
    print(f"heave RMS {motions['heave'].rms:.3f} m, pitch RMS {np.rad2deg(motions['pitch'].rms):.2f}°")
    return history


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp()))
