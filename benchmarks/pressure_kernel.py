"""CPU time of one wetted-surface load, method by method. Run: python benchmarks/pressure_kernel.py [--quick]

The halifax hull with panels of 5, 2.5 and 1 m2: 1298, 2596 and 6218 panels, where TM 2003-190 Table 3 has
1272, 2512 and 5962. 19 and 37 waves from one direction, 160 from five, 2000 each with its own frequency.
panelsim's methods cut panels at the surface; the C sum over whole panels is what the processor can do with
the plain method. All run in one process on one thread and take turns, so that other work on the machine
touches all alike; ratios are to the C sum beside them. `--write` puts table and plot into reports/.
"""

import argparse
import os
import platform
import subprocess
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import partial
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from pressure_methods import (
    C_FLAGS,
    C_SUM,
    METHODS,
    PLAIN,
    SEAS,
    Evaluate,
    Setting,
    available,
    c_library,
    numpy_method,
)

from panelsim.conventions import FloatArray
from panelsim.kernels import runtime

REPORT = Path(__file__).parents[1] / "reports" / "pressure_kernel.md"
PANEL_AREAS = (5.0, 2.5, 1.0)  # m2
QUICK_AREAS, QUICK_SEAS = PANEL_AREAS[:1], (19, 160)
COMPILES = 0.5  # s: a first call that takes longer has compiled
ROUND_SECONDS, MOST_POSES, ROUNDS, SLOW_ROUNDS = 0.02, 64, 7, 3
GRID = METHODS["grid, vertex + centre"]
# Plain sums agree to rounding and to the C library's packed functions, good to 4 units in the last place.
SAME_RULE = 1e-9
# Whole panels of 5 m2 miss the cut ones by less than this part of the force and moment of the waves.
OTHER_RULE = 0.05


def differences(setting: Setting, evaluate: dict[str, Evaluate]) -> dict[str, float]:
    """How far each method is from the NumPy sum, as a part of the force or moment of the waves."""
    poses = setting.poses(4)
    reference = numpy_method(setting)
    plain = reference(poses)
    of_waves = plain - reference(poses * (np.arange(8) != 1))

    def apart(loads: FloatArray) -> float:
        shares = (
            np.linalg.norm((loads - plain)[:, part], axis=1) / np.linalg.norm(of_waves[:, part], axis=1)
            for part in (slice(0, 3), slice(3, 6))
        )
        return float(max(share.max() for share in shares))

    return {name: apart(call(poses)) for name, call in evaluate.items()}


def require_agreement(setting: Setting, evaluate: dict[str, Evaluate]) -> dict[str, float]:
    """Stop unless all methods compute the same load, each as well as its rule allows."""
    apart = differences(setting, evaluate)
    for name, share in apart.items():
        allowed = SAME_RULE if name in PLAIN else OTHER_RULE
        if not share <= allowed:
            raise SystemExit(f"{name} is {share:.1e} of the waves' load off the NumPy sum, over {allowed:g}")
    return apart


@dataclass(frozen=True)
class Cell:
    """One method in one setting: microseconds an evaluation, times the C sum, (largest - least) / median."""

    microseconds: float
    ratio: float
    spread: float

    def __str__(self) -> str:
        digits = 1 if self.microseconds < 100 else 0
        return f"{self.microseconds:.{digits}f}" + ("" if np.isnan(self.ratio) else f" ({self.ratio:.2f})")


def cpu_seconds(call: Callable[[], object]) -> float:
    begin = time.process_time()
    call()
    return time.process_time() - begin


def time_methods(setting: Setting, evaluate: dict[str, Evaluate]) -> dict[str, Cell]:
    """Medians of rounds in which the methods take turns, many poses a call; ratios round by round."""
    one, poses, rounds = setting.poses(1), {}, {}
    for name, call in evaluate.items():
        seconds = cpu_seconds(partial(call, one))
        poses[name] = setting.poses(int(np.clip(ROUND_SECONDS / max(seconds, 1e-6), 1, MOST_POSES)))
        rounds[name] = ROUNDS if seconds < 5 * ROUND_SECONDS else SLOW_ROUNDS
    spent = {name: np.full(ROUNDS, np.nan) for name in evaluate}
    for turn in range(ROUNDS):
        for name, call in evaluate.items():
            if turn < rounds[name]:
                spent[name][turn] = cpu_seconds(partial(call, poses[name])) / len(poses[name])
    unit = spent.get(C_SUM, np.full(ROUNDS, np.nan))
    return {
        name: Cell(
            1e6 * float(np.nanmedian(seconds)),
            float(np.nanmedian(seconds / unit)) if C_SUM in spent else np.nan,
            float((np.nanmax(seconds) - np.nanmin(seconds)) / np.nanmedian(seconds)),
        )
        for name, seconds in spent.items()
    }


@dataclass
class Results:
    """What was measured: cells by panels and waves, and what is paid once."""

    cells: dict[tuple[int, int], dict[str, Cell]] = field(default_factory=dict)
    first_call: dict[str, float] = field(default_factory=dict)  # s, of methods that compile then
    tables: dict[int, float] = field(default_factory=dict)  # s, by panels
    grids: dict[int, float] = field(default_factory=dict)  # s, by waves
    wet: dict[int, float] = field(default_factory=dict)  # share of the panels at rest
    single: dict[str, float] = field(default_factory=dict)  # us that a call with one pose costs more
    apart: dict[str, float] = field(default_factory=dict)  # largest differences from the NumPy sum


def run(areas: Iterable[float], counts: Iterable[int]) -> Results:
    """Check and time all methods in all settings."""
    results, areas, counts = Results(), tuple(areas), tuple(counts)
    runtime.start()
    for area in areas:
        for count in counts:
            setting = Setting(area, count)
            rest = setting.ship.hydrostatics
            size = rest.panels_total
            results.wet[size] = rest.panels_wet / size
            results.tables[size] = cpu_seconds(lambda s=setting: s.panels)
            evaluate = {name: method(setting) for name, method in available().items()}
            results.grids[count] = cpu_seconds(lambda s=setting: GRID(s))
            if area == areas[0]:
                for name, call in evaluate.items():
                    seconds = cpu_seconds(partial(call, setting.poses(1)))
                    if name not in PLAIN and seconds > COMPILES:
                        results.first_call[f"{name}, {count} waves"] = seconds
            for name, share in require_agreement(setting, evaluate).items():
                results.apart[name] = max(share, results.apart.get(name, 0.0))
            cells = results.cells[size, count] = time_methods(setting, evaluate)
            results.single = results.single or call_overhead(setting, evaluate, cells)
            print(f"{size} panels, {count} waves:")
            for name, cell in cells.items():
                print(f"  {name:26}{cell}", flush=True)
    return results


def call_overhead(
    setting: Setting, evaluate: dict[str, Evaluate], cells: dict[str, Cell]
) -> dict[str, float]:
    """Microseconds that a call with one pose costs more than a pose among many, of compiled methods."""
    pose = setting.poses(1)

    def single(call: Evaluate) -> float:
        return 1e6 * float(np.median([cpu_seconds(partial(call, pose)) for _ in range(100)]))

    names = [name for name in evaluate if name not in PLAIN or name == C_SUM]
    return {name: single(evaluate[name]) - cells[name].microseconds for name in names}


def report(results: Results) -> str:
    """The table and what belongs to it, in Markdown."""
    names = list(next(iter(results.cells.values())))
    lines = [
        "# Cost of the pressure kernel",
        "",
        "CPU microseconds of one evaluation; in brackets, times the C sum beside it.",
        "",
        f"| panels | waves | {' | '.join(names)} |",
        "|" + "---:|" * (2 + len(names)),
    ]
    for (size, count), cells in results.cells.items():
        row = " | ".join(str(cell) for cell in cells.values())
        lines.append(f"| {size} | {count} | {row} |")
    return "\n".join([*lines, "", *(f"- {note}" for note in notes(results, C_SUM in names))]) + "\n"


def notes(results: Results, with_c: bool) -> list[str]:
    """What the table does not say."""
    spreads = [cell.spread for cells in results.cells.values() for cell in cells.values()]
    grids = ", ".join(f"{1e3 * seconds:.0f} ms for {count} waves" for count, seconds in results.grids.items())
    sizes = ", ".join(f"{1e3 * seconds:.0f} ms for {size}" for size, seconds in results.tables.items())
    wet = ", ".join(f"{share:.0%} of {size}" for size, share in results.wet.items())
    return [
        f"Noise: (largest - least) / median of the rounds of a cell is {np.median(spreads):.0%} in the"
        f" middle of all cells and {max(spreads):.0%} at most.",
        "Paid once and not in the table: compilation, in the first call of a kind (both rules share"
        f" a kernel, seas of one direction have another than others), s: {_told(results.first_call, '.1f')};"
        f" tables of the panels: {sizes}; of the waves and their grid: {grids}.",
        f"A call with one pose costs more than a pose among many, us: {_told(results.single, '.0f')}.",
        "Plain sums take every panel, wet or dry; panelsim's methods cut panels at the surface and pass by"
        f" points above the highest possible crest. Wet at rest: {wet} panels.",
        "Check that all compute the same, largest difference from the NumPy sum as a share of the waves' load"
        f" (it takes panels whole, ours are cut): {_told(results.apart, '.1e')}.",
        machine(with_c),
        *([] if with_c else ["There is no gcc here: the C sum and the ratios to it are left out."]),
    ]


def _told(values: dict[str, float], form: str) -> str:
    return "; ".join(f"{name} {value:{form}}" for name, value in values.items())


def machine(with_c: bool) -> str:
    """What it ran on."""
    info = Path("/proc/cpuinfo")
    models = (
        [line for line in info.read_text().splitlines() if "model name" in line] if info.is_file() else []
    )
    model = models[0].split(":")[1].strip() if models else platform.processor()
    told = f"{model}, one thread, Python {platform.python_version()}, NumPy {np.__version__}"
    told += f", Taichi {version('taichi')}"
    if with_c:
        gcc = subprocess.run(["gcc", "-dumpfullversion"], capture_output=True, text=True, check=True)
        told += f", gcc {gcc.stdout.strip()} {' '.join(C_FLAGS)}, "
        told += f"cos and exp by {', '.join(c_library()[1]) or 'scalar calls: ratios flatter the others'}"
    return f"{told}."


def plot(results: Results, path: Path) -> None:
    """Microseconds over components, one picture for each mesh."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    sizes = list(results.tables)
    figure, axes = pyplot.subplots(
        1, len(sizes), figsize=(4.5 * len(sizes), 4.0), sharey=True, squeeze=False, layout="constrained"
    )
    for axis, size in zip(axes[0], sizes, strict=True):
        counts = [count for panels, count in results.cells if panels == size]
        for name in results.cells[size, counts[0]]:
            axis.loglog(
                counts,
                [results.cells[size, count][name].microseconds for count in counts],
                marker="o",
                linestyle="--" if name in PLAIN else "-",
                label=name,
            )
        axis.set(title=f"{size} panels", xlabel="wave components")
        axis.set_xticks(counts, [str(count) for count in counts], minor=False)
        axis.minorticks_off()
        axis.grid(visible=True, which="major", alpha=0.4)
    axes[0, 0].set_ylabel("CPU time of one evaluation [µs]")
    figure.legend(
        *axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize="small"
    )
    figure.savefig(path, dpi=130)
    pyplot.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description="Time the pressure kernel beside plain sums.")
    parser.add_argument("--quick", action="store_true", help="the smallest mesh, 19 and 160 waves")
    parser.add_argument(
        "--write", action="store_true", help=f"write {REPORT.name} and its plot into reports/"
    )
    options = parser.parse_args()
    if options.quick and options.write:
        parser.error("--quick measures too little for the report: leave out one of --quick and --write")
    with TemporaryDirectory() as empty:
        os.environ["TI_OFFLINE_CACHE_FILE_PATH"] = empty  # so that the first calls compile
        results = run(*((QUICK_AREAS, QUICK_SEAS) if options.quick else (PANEL_AREAS, SEAS)))
    text = report(results)
    print(f"\n{text}")
    if options.write:
        REPORT.parent.mkdir(exist_ok=True)
        picture = REPORT.with_suffix(".png")
        plot(results, picture)
        REPORT.write_text(f"{text}\n![CPU time over components]({picture.name})\n")
        print(f"Wrote {REPORT} and {picture}")


if __name__ == "__main__":
    main()
