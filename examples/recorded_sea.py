"""A ship in a sea that was measured: a record of the elevation, its waves, and the same sea elsewhere.

    python examples/recorded_sea.py FOLDER

writes FOLDER/buoy.csv, as a wave buoy might leave it, and works with that. recorded_sea.toml does the same
as a case file.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

import panelsim as ps

HIGHEST = 2.5  # rad/s, above which a buoy of this size follows no waves
LOWEST = 0.25


def write_record(path: Path) -> None:
    """Write twenty minutes of a made-up record at 2.56 Hz, with some noise of the instrument."""
    sea = ps.RandomSeaway(ps.Jonswap(2.0, 8.0), ps.JitteredFrequencies(0.4, 2.4, 0.01), 0.0, seed=3)
    time = np.arange(3072) / 2.56
    noise = np.random.default_rng(3).normal(0.0, 0.01, len(time))
    elevation = sea.in_fixed_axes().elevation(0.0, 0.0, time) + noise
    np.savetxt(
        path,
        np.column_stack([time, elevation]),
        delimiter=",",
        header="time_s,elevation_m",
        comments="",
        fmt="%.9g",
    )


def main(folder: Path) -> ps.RecordedSeaway:
    """Read the record, find its waves, and compare them with it and with the sea further on."""
    folder.mkdir(parents=True, exist_ok=True)
    write_record(folder / "buoy.csv")
    record = ps.read_elevation_record(folder / "buoy.csv")
    sea = ps.RecordedSeaway(record, wave_heading=np.pi, low_frequency=LOWEST, high_frequency=HIGHEST)
    error = sea.in_fixed_axes().elevation(0.0, 0.0, record.time) - record.elevation
    print(f"{sea.components.count} waves hold {100 * sea.record_share:.2f} % of the record's variance")
    print(f"RMS of what is left out {error.std():.3f} m")
    # Waves from ahead reach a point 200 m further aft later, each with its own speed.
    aft = sea.in_fixed_axes().elevation(-200.0, 0.0, record.time)
    print(f"highest crest at the buoy {record.elevation.max():.2f} m, 200 m on {aft.max():.2f} m")
    return sea


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp()))
