"""The main job's cost: HALIFAX-like ship, sea state 7, 20 knots, 1800 s. Run: python benchmarks/main_job.py

Reports, each in CPU seconds of this process: imports, compilation, the time loop and how much faster than
real time it is, writing the recording, and peak memory. The reference beside which the kernel is
measured, in the same process, is its NumPy twin. TM 2003-190 Table 4 gives 0.254 s of CPU for a
simulated second of this case on an 800 MHz Pentium III.
"""

import resource
import time
from pathlib import Path
from tempfile import TemporaryDirectory

start = time.process_time()

import numpy as np  # noqa: E402

from panelsim import Case  # noqa: E402
from panelsim.loads.load import Instant  # noqa: E402
from panelsim.loads.wetted_surface import WettedSurface  # noqa: E402
from panelsim.studies.run_case import run_case  # noqa: E402

imports = time.process_time() - start
CASE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
REPORT_TABLE_4 = 0.254  # CPU seconds a simulated second


def seconds_each(load: WettedSurface, repeats: int) -> float:
    """Median CPU seconds of a force evaluation."""
    instant = Instant(10.0, 1.0, np.zeros(6), np.zeros(6))
    spent = []
    for _ in range(repeats):
        begin = time.process_time()
        load.in_ship_axes(instant)
        spent.append(time.process_time() - begin)
    return float(np.median(spent))


def main() -> None:
    case = Case.load(CASE)
    with TemporaryDirectory() as folder:
        output = run_case(case, Path(folder) / "run")
    statistics = output.statistics
    direct, twin = (
        seconds_each(WettedSurface(case.ship, case.seaway.components, case.speed, method=method), repeats)
        for method, repeats in (("direct", 500), ("oracle", 5))
    )
    factor = statistics.realtime_factor
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"imports {imports:.2f} s, compilation and set-up {statistics.jit_seconds:.2f} s")
    print(f"time loop {statistics.cpu_seconds:.2f} s of CPU for {statistics.simulated_seconds:.0f} s:")
    print(f"  {factor:.0f} times faster than real time, {factor * REPORT_TABLE_4:.0f} times Table 4's speed")
    print(f"one force evaluation {1e6 * direct:.0f} us; its NumPy twin takes {twin / direct:.0f} times that")
    print(", ".join(f"{stage} {seconds:.2f} s" for stage, seconds in output.seconds.items()))
    print(f"peak memory {memory:.0f} MB")


if __name__ == "__main__":
    main()
