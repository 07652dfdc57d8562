"""The main job's cost: HALIFAX-like ship, sea state 7, 20 knots, 1800 s.

Run: python benchmarks/main_job.py [--quick] [--components 19 37 160]

First the case itself with all its files, in CPU seconds of this process: imports, compilation, stages, peak
memory. Then its time loop with 19 and 37 waves from one direction and with 160 from five: how much faster
than real time, and the RMS of the six motions, by which two versions can be compared. The reference beside
which the kernel is measured, in the same process, is its NumPy twin. TM 2003-190 Table 4 gives 0.254 s of
CPU for a simulated second of the case on an 800 MHz Pentium III.
"""

import argparse
import resource
import time
from pathlib import Path
from tempfile import TemporaryDirectory

start = time.process_time()

import numpy as np  # noqa: E402

import panelsim as ps  # noqa: E402
from panelsim.conventions import DOF_NAMES  # noqa: E402
from panelsim.loads.load import Instant  # noqa: E402
from panelsim.loads.wetted_surface import WettedSurface  # noqa: E402
from panelsim.results.statistics import Statistics  # noqa: E402
from panelsim.studies.run_case import run_case  # noqa: E402

imports = time.process_time() - start
CASE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
REPORT_TABLE_4 = 0.254  # CPU seconds a simulated second
QUICK_DURATION = 120.0  # s
# Frequencies [rad/s] by number of waves; those of 160 come from five directions.
FREQUENCIES = {
    19: ps.EvenFrequencies(0.2, 2.0, 0.1),
    37: ps.EvenFrequencies(0.2, 2.0, 0.05),
    160: ps.EvenFrequencies(0.3, 1.85, 0.05),
}


def sea(case: ps.Case, count: int) -> ps.RandomSeaway:
    """The sea of the case with another number of waves."""
    spread = {"spreading": ps.CosineSquared(), "direction_step": np.deg2rad(30.0)} if count == 160 else {}
    found = ps.RandomSeaway(
        ps.Bretschneider(7.5, 15.0),
        FREQUENCIES[count],
        np.deg2rad(150.0),
        seed=case.file.seaway.seed,
        **spread,
    )
    if found.components.count != count:
        raise SystemExit(f"The sea has {found.components.count} waves, not {count}")
    return found


def seconds_each(load: WettedSurface, repeats: int) -> float:
    """Median CPU seconds of a force evaluation."""
    instant = Instant(10.0, 1.0, np.zeros((1, 6)), np.zeros((1, 6)))
    spent = []
    for _ in range(repeats):
        begin = time.process_time()
        load.in_ship_axes(instant)
        spent.append(time.process_time() - begin)
    return float(np.median(spent))


def run_files(case: ps.Case) -> None:
    """The case with all its files, and what each stage takes."""
    with TemporaryDirectory() as folder:
        output = run_case(case, Path(folder) / "run")
    statistics = output.statistics
    direct, twin = (
        seconds_each(WettedSurface(case.ship, [case.seaway.components], [case.speed], method=method), repeats)
        for method, repeats in (("direct", 500), ("oracle", 5))
    )
    factor = statistics.realtime_factor
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"imports {imports:.2f} s, compilation and set-up {statistics.jit_seconds:.2f} s")
    print(f"time loop {statistics.cpu_seconds:.2f} s of CPU for {statistics.simulated_seconds:.0f} s:")
    print(f"  {factor:.0f} times faster than real time, {factor * REPORT_TABLE_4:.0f} times Table 4's speed")
    print(f"one force evaluation {1e6 * direct:.0f} us; its NumPy twin takes {twin / direct:.0f} times that")
    print(", ".join(f"{stage} {seconds:.2f} s" for stage, seconds in output.seconds.items()))
    print(f"peak memory {memory:.0f} MB", flush=True)


def run_loop(case: ps.Case, count: int, duration: float) -> Statistics:
    """The time loop of the case with so many waves."""
    run = case.file.run
    history = ps.simulate(
        case.ship,
        sea(case, count),
        speed=case.speed,
        duration=duration,
        time_step=run.time_step,
        database=case.database(),
        model=run.model,
        ramp=run.ramp,
        supplementary=case.supplementary,
        seed=case.file.seaway.seed,
    )
    return ps.statistics(history)


def main() -> None:
    parser = argparse.ArgumentParser(description="Time the main job.")
    parser.add_argument("--quick", action="store_true", help=f"loops of {QUICK_DURATION:g} s only, no files")
    parser.add_argument("--components", type=int, nargs="+", choices=FREQUENCIES, default=[*FREQUENCIES])
    options = parser.parse_args()
    case = ps.Case.load(CASE)
    if not options.quick:
        run_files(case)
    duration = QUICK_DURATION if options.quick else case.file.run.duration
    print(f"waves, times real time, CPU s per simulated s, RMS of {', '.join(DOF_NAMES)} [m, rad]")
    for count in options.components:
        found = run_loop(case, count, duration)
        rms = " ".join(f"{found.motions[name].rms:.6g}" for name in DOF_NAMES)
        spent = found.cpu_seconds / found.simulated_seconds
        print(f"{count:5d} {found.realtime_factor:6.0f} {spent:.3e}  {rms}", flush=True)


if __name__ == "__main__":
    main()
