"""Cost of a response: 13 headings, 7 speeds, 40 frequencies. Run: python benchmarks/response_cost.py

CPU seconds of this process, best of three, coefficients stored: the table of transfer functions; the table
with the RMS in a long-crested sea of every heading and speed, which solves the waves of that sea anew; and
the plain loop, one call of `response` for each speed, heading and frequency, estimated from 60 of them.
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

import panelsim as ps

HEADINGS = np.deg2rad(np.linspace(0.0, 180.0, 13))
SPEEDS = np.linspace(0.0, 25.0, 7) * ps.KNOT
FREQUENCIES = np.linspace(0.2, 1.8, 40)
LOOPED = 60  # waves of the plain loop
REPEATS = 3


def seconds(call: Callable[[], object], repeats: int = REPEATS) -> float:
    """Best CPU seconds of a call."""
    spent = []
    for _ in range(repeats):
        begin = time.process_time()
        call()
        spent.append(time.process_time() - begin)
    return min(spent)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.parse_args()
    ship = ps.load_ship("halifax", panel_area=2.5)
    begin = time.process_time()
    database = ps.database_for(ship)
    reading = time.process_time() - begin
    supplementary = ps.Supplementary.of(ship)
    sea = ps.Bretschneider(7.5, 15.0)

    def table(
        frequencies: np.ndarray = FREQUENCIES, headings: np.ndarray = HEADINGS, speeds: np.ndarray = SPEEDS
    ) -> ps.Response:
        return ps.response(
            ship,
            database,
            frequencies=frequencies,
            wave_headings=headings,
            speeds=speeds,
            supplementary=supplementary,
        )

    waves = len(HEADINGS) * len(SPEEDS) * len(FREQUENCIES)
    each = np.random.default_rng(1).integers([len(SPEEDS), len(HEADINGS), len(FREQUENCIES)], size=(LOOPED, 3))

    def loop() -> None:
        for i, j, k in each:
            table(FREQUENCIES[[k]], HEADINGS[[j]], SPEEDS[[i]])

    alone = seconds(table)
    with_sea = seconds(lambda: table().in_sea(sea))
    plain = seconds(loop, repeats=1) * waves / LOOPED
    print(f"reading the coefficients          {reading:8.2f} s")
    print(f"table of {waves} transfer functions {alone:8.2f} s")
    print(f"table and RMS in a sea            {with_sea:8.2f} s")
    print(f"plain loop, estimated             {plain:8.2f} s, {plain / alone:.0f} times the table")


if __name__ == "__main__":
    main()
