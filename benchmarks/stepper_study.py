"""Error of every stepper against what it costs. Run: python benchmarks/stepper_study.py [--folder reports]

The halifax hull at 20 knots in bow and stern quartering seas, nonlinear model, 120 s after a ramp of 20 s.
The whole series of each motion is compared with that of Runge-Kutta at 0.025 s. Writes steppers.md and
steppers.png.
"""

import argparse
import platform
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

import panelsim as ps
from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.motion.history import History
from panelsim.motion.steppers import STEPPERS

SPEED = 20 * ps.KNOT
SEED = 1001
RAMP, DURATION = 20.0, 120.0  # s
TRUE_STEP = 0.025  # s
STEPS = (0.05, 0.1, 0.2, 0.25, 0.4, 0.5, 0.7, 1.0)  # s
EVALUATIONS = {"exponential": 1, "ab3": 1, "rk4": 4}  # a step
# Heading [deg], significant height [m], peak period [s]: the seas of TM 2003-190 section 8, and a small
# steep one.
SEAS = ((150, 7.5, 15.0), (150, 7.5, 9.9), (30, 7.5, 15.0), (30, 7.5, 9.9), (150, 2.5, 5.7))


@dataclass(frozen=True)
class Row:
    """A run: how it ended, or errors of the motions (6,) over their RMS: largest, RMS, of the RMS."""

    sea: tuple[float, float, float]
    stepper: str
    time_step: float
    largest: FloatArray
    rms: FloatArray
    of_rms: FloatArray
    outcome: str

    @property
    def evaluations(self) -> float:
        """Force evaluations a simulated second."""
        return EVALUATIONS[self.stepper] / self.time_step


class Study:
    """The ship, her coefficients, and runs of them."""

    def __init__(self) -> None:
        self.ship = ps.load_ship("halifax", 2.5)
        self.database = ps.database_for(self.ship)
        self.supplementary = ps.Supplementary.of(self.ship)

    def run(self, sea: tuple[float, float, float], stepper: str, time_step: float) -> History:
        """One run."""
        heading, height, period = sea
        frequencies = ps.EvenFrequencies(0.2, 2.0, 0.1)
        return ps.simulate(
            self.ship,
            ps.RandomSeaway(ps.Bretschneider(height, period), frequencies, np.deg2rad(heading), seed=SEED),
            speed=SPEED,
            duration=DURATION,
            time_step=time_step,
            database=self.database,
            ramp=RAMP,
            supplementary=self.supplementary,
            stepper=stepper,
        )

    def rows(self) -> Iterator[Row]:
        """All runs against the true ones."""
        for sea in SEAS:
            truth = self.run(sea, "rk4", TRUE_STEP)
            for stepper in STEPPERS:
                for step in STEPS:
                    try:
                        yield compared(sea, stepper, step, self.run(sea, stepper, step), truth)
                    except ps.PanelsimError:
                        yield Row(sea, stepper, step, *3 * [np.full(6, np.nan)], "refused")


def compared(sea: tuple[float, float, float], stepper: str, step: float, run: History, truth: History) -> Row:
    """A run against the truth at the instants of both."""
    true = truth.displacement[:: round(step / TRUE_STEP)]
    scale = truth.displacement[truth.time > RAMP].std(axis=0)
    none = np.full(6, np.nan)
    if run.outcome != "finished":
        return Row(sea, stepper, step, none, none, none, run.outcome)
    count = min(len(true), len(run.time))
    error = (run.displacement[:count] - true[:count]) / scale
    after = run.time[:count] > RAMP
    of_rms = run.displacement[:count][after].std(axis=0) / true[:count][after].std(axis=0) - 1.0
    return Row(
        sea, stepper, step, np.abs(error).max(axis=0), np.sqrt((error**2).mean(axis=0)), np.abs(of_rms), ""
    )


def table(rows: list[Row]) -> str:
    """Markdown: a line a run, per cent."""
    lines = [
        f"| scheme | dt, s | evaluations a second | {' | '.join(DOF_NAMES)} | largest | RMS |",
        "|---|---|---|" + "---|" * 8,
    ]
    for row in rows:
        if row.outcome:
            errors = f"{row.outcome} |" + " |" * 7
        else:
            worst = f"{100 * row.largest.max():.2g} | {100 * row.of_rms.max():.2g} |"
            errors = " | ".join(f"{100 * e:.2g}" for e in row.rms) + f" | {worst}"
        lines.append(f"| {row.stepper} | {row.time_step:g} | {row.evaluations:.3g} | {errors}")
    return "\n".join(lines)


def cheapest(rows: list[Row], bound: float) -> str:
    """Fewest evaluations a second that keep the series of all motions within a bound."""
    lines = [
        "| scheme | " + " | ".join(f"{h}°, {s:g} m, {p:g} s" for h, s, p in SEAS) + " |",
        "|---|" + "---|" * len(SEAS),
    ]
    for stepper in STEPPERS:
        cells = []
        for sea in SEAS:
            good = [
                r.evaluations for r in rows if r.sea == sea and r.stepper == stepper and r.rms.max() < bound
            ]
            cells.append(f"{min(good):.3g}" if good else f"> {EVALUATIONS[stepper] / min(STEPS):g}")
        lines.append(f"| {stepper} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def picture(rows: list[Row], path: Path) -> None:
    """Worst motion's error against evaluations, one panel a sea."""
    figure, axes = plt.subplots(1, len(SEAS), figsize=(4 * len(SEAS), 4), sharey=True)
    for axis, sea in zip(axes, SEAS, strict=True):
        for stepper in STEPPERS:
            chosen = [r for r in rows if r.sea == sea and r.stepper == stepper and not r.outcome]
            axis.loglog(
                [r.evaluations for r in chosen], [100 * r.rms.max() for r in chosen], "o-", label=stepper
            )
        axis.set_title(f"{sea[0]}°, H_s {sea[1]:g} m, T_p {sea[2]:g} s")
        axis.set_xlabel("force evaluations a simulated second")
        # Over less than a decade matplotlib would label the minor ticks too, one over the other.
        axis.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("error of the series, worst motion, % of its RMS")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=90, metadata={"Software": None})


def written(rows: list[Row]) -> str:
    """The report."""
    parts = [
        "# Steppers: error against cost",
        f"panelsim {version('panelsim')}, numpy {np.__version__}, {platform.machine()}; seed {SEED};"
        " `python benchmarks/stepper_study.py`.",
        "HALIFAX-like hull, 20 knots, nonlinear model, 19 waves, 120 s after a ramp of 20 s. Errors of the"
        f" whole series against rk4 at {TRUE_STEP} s, in per cent of the RMS of each motion: RMS of the error"
        " by motion; its largest value in any motion; error of the RMS of any motion.",
        "![error against evaluations](steppers.png)",
        "Force evaluations a simulated second for a series within 1 % in all motions:",
        cheapest(rows, 0.01),
    ]
    for heading, height, period in SEAS:
        parts.append(f"## {heading}°, H_s {height:g} m, T_p {period:g} s")
        parts.append(table([row for row in rows if row.sea == (heading, height, period)]))
    return "\n\n".join(parts) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description="Error of every stepper against its cost.")
    parser.add_argument("--folder", type=Path, default=Path(__file__).parents[1] / "reports")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    rows = list(Study().rows())
    (folder / "steppers.md").write_text(written(rows), encoding="utf-8")
    picture(rows, folder / "steppers.png")
    print(cheapest(rows, 0.01))


if __name__ == "__main__":
    main()
