"""Drift without supplementary terms in surge and sway (TM 2003-190 section 8), and what stands behind it."""

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.conventions import FloatArray
from panelsim.results.rms_tables import markdown_table
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.studies.run_store import RunStore, StoredRun
from panelsim.studies.tm2003_190.common import BOW_QUARTERING, HEADINGS_DEG
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.view.drift_picture import drift_picture

HEIGHT, PERIOD = 7.5, 15.0  # m, s: sea state 7 of the report
LOW_HEIGHTS = (0.25, 0.5, 1.0, 2.0, 4.0)  # m, at the same period
QUICK_LOW_HEIGHTS = (0.5, 1.0)
DURATION = 600.0  # s
Key = tuple[str, float, str]  # kind of run, heading [deg], model
MODELS = ("nonlinear", "linear")
FREE, NO_SPRINGS, SHIFTED, HELD = "free", "no yaw spring", "other components", "held"
SECOND_ORDER = (1.7, 2.3)  # powers of the height that are the second, whatever is left of the next
# Components between those of the report: none of them stands still beside the ship.
BETWEEN = {"start": 0.25, "stop": 1.95, "step": 0.1}


@dataclass(frozen=True)
class Drift:
    """How far the ship goes in ten minutes when nothing holds her in surge and sway, in both models."""

    base: Case
    quick: bool
    key: str = "drift"

    @cached_property
    def free(self) -> dict[Key, Case]:
        """Sea state 7 by kind of run, heading [deg] and model: free in surge and sway.

        Then without the yaw spring too; and the linear model in components between those of the report.
        """
        cases = {}
        for heading in HEADINGS_DEG:
            for model in MODELS:
                sea = self._case(heading, HEIGHT, model)
                damping = {"roll": self.base.supplementary.damping["roll"]}
                yaw = {"yaw": self.base.supplementary.stiffness["yaw"]}
                loose = {"supplementary.damping": damping, "supplementary.stiffness": yaw}
                cases[FREE, heading, model] = sea.changed(loose)
                cases[NO_SPRINGS, heading, model] = sea.changed(loose | {"supplementary.stiffness": {}})
            cases[SHIFTED, heading, "linear"] = cases[FREE, heading, "linear"].changed(
                {"seaway.frequencies": BETWEEN}
            )
        return cases

    @cached_property
    def held(self) -> dict[tuple[float, str], Case]:
        """Low bow quartering seas by height [m] and model, with the springs, which hold the mean force."""
        heights = QUICK_LOW_HEIGHTS if self.quick else LOW_HEIGHTS
        return {
            (height, model): self._case(BOW_QUARTERING, height, model)
            for height in heights
            for model in MODELS
        }

    def _case(self, heading: float, height: float, model: str) -> Case:
        return self.base.changed(
            {
                "seaway.wave_heading_deg": heading,
                "seaway.significant_wave_height": height,
                "seaway.peak_period": PERIOD,
                "run.model": model,
                "run.duration": DURATION,
            }
        )

    @property
    def cases(self) -> Sequence[Case]:
        """Every run that the section reads."""
        return [*self.free.values(), *self.held.values()]

    def section(self, store: RunStore, folder: Path) -> Section:
        """Read the runs, draw the picture into the folder, say what they show."""
        runs = {key: store.load(case) for key, case in self.free.items() if store.failure(case) is None}
        force = self.mean_force(store)
        paths = {
            f"{model}, {heading:g}°": (run.time, run.displacement[:, :2])
            for (kind, heading, model), run in runs.items()
            if kind == FREE
        }
        picture = drift_picture(folder / "drift.png", paths, force)
        return Section(
            self.key,
            "Drift without springs (8)",
            "How far does the ship go without supplementary terms in surge and sway, and why?",
            f"20 knots, H_s {HEIGHT:g} m, T_p {PERIOD:g} s, ten minutes after the ramp; roll damping and yaw"
            " spring as in the report, nothing in surge and sway. A run ends where yaw passes 60°.",
            _table(runs) + _force_table(force),
            (*(self._drift_statement(heading, runs) for heading in HEADINGS_DEG), force_statement(force)),
            ((picture.name, "Distance from where the ship would be, and mean force over H_s."),),
            {"drift.csv": _csv(runs), "mean_force.csv": _force_csv(force)},
            series={
                f"{model}, {heading:g}°": case
                for (kind, heading, model), case in self.free.items()
                if kind == FREE
            },
            failures=self._failures(store, runs),
        )

    def _drift_statement(self, heading: float, runs: Mapping[Key, StoredRun]) -> Statement:
        """The verdict for one heading, of the runs that finished."""
        finished = {key: run.displacement[:, :2] for key, run in runs.items() if run.early_end is None}
        keys = ((FREE, "nonlinear"), (FREE, "linear"), (SHIFTED, "linear"))
        nonlinear, linear, shifted = (finished.get((kind, heading, model)) for kind, model in keys)
        length, slow = self.base.ship.length, self._slowest(heading)
        return drift_statement(heading, nonlinear, linear, shifted, length, slow=slow)

    def _failures(self, store: RunStore, runs: Mapping[Key, StoredRun]) -> tuple[str, ...]:
        """Runs that should have finished: to broach is what those without a yaw spring are for."""
        found = {", ".join(map(str, key)): store.failure(case) for key, case in self.free.items()}
        found |= {
            ", ".join(map(str, key)): run.early_end for key, run in runs.items() if key[0] != NO_SPRINGS
        }
        for (height, model), case in self.held.items():
            failure = store.failure(case)
            found[f"{HELD}, {height:g} m, {model}"] = failure or store.load(case).early_end
        return tuple(f"{name}: {told}" for name, told in found.items() if told is not None)

    def mean_force(self, store: RunStore) -> dict[float, FloatArray]:
        """Mean force (2,) [N] in surge and sway beyond the linear one, by significant height [m].

        What the springs hold: stiffness times mean displacement, less that of the linear run in the same
        waves, whose mean is of waves that are cut off at the ends. NaN where a run did not finish.
        """
        stiffness = np.array([self.base.supplementary.stiffness[name] for name in ("surge", "sway")])
        force = {}
        for height in dict.fromkeys(height for height, _ in self.held):
            means = []
            for model in MODELS:
                case = self.held[height, model]
                run = None if store.failure(case) else store.load(case)
                finished = run is not None and run.early_end is None
                means.append(
                    run.displacement[run.after_ramp, :2].mean(axis=0)
                    if run is not None and finished
                    else np.full(2, np.nan)
                )
            force[height] = stiffness * (means[0] - means[1])
        return force

    def _slowest(self, heading: float) -> tuple[float, float]:
        """Frequency of the component that passes the ship most slowly, and of its encounter [rad/s]."""
        case = self.free[FREE, heading, "linear"]
        waves = case.seaway.components
        met = encounter_frequency(waves.frequency, waves.wave_heading, case.speed, case.ship.gravity)
        slow = int(np.argmin(np.abs(met)))
        return float(waves.frequency[slow]), float(met[slow])


def drift_statement(
    heading: float,
    nonlinear: FloatArray | None,
    linear: FloatArray | None,
    shifted: FloatArray | None,
    length: float,
    *,
    slow: tuple[float, float],
) -> Statement:
    """Excessive drift, more than a ship length, in the nonlinear model, and less than that in the linear one.

    Tracks (T, 2) [m], None of runs that did not finish; `shifted` the linear one in other components. `slow`:
    the wave that passes most slowly and its frequency of encounter [rad/s].
    """
    says = f"Nonlinear drift without surge and sway terms, none in the linear model (8): {heading:g}°"
    if nonlinear is None or linear is None:
        return Statement(says, False, "a run did not finish")
    far, near = (float(np.linalg.norm(track[-1])) for track in (nonlinear, linear))
    remark = ""
    if near > length and shifted is not None:
        other = float(np.linalg.norm(shifted[-1]))
        remark = (
            f"The component of {slow[0]:.2g} rad/s is met at {slow[1]:.1g} rad/s: it stands still beside the"
            f" ship"
            f" and pushes her on like a constant force, in first order. In components between those of the"
            f" report's grid the linear model goes {other:.0f} m."
        )
    return Statement(
        says,
        far > length >= near,
        f"after ten minutes {far:.0f} m nonlinear and {near:.0f} m linear; a ship length is {length:.0f} m",
        remark,
    )


def force_statement(force: dict[float, FloatArray]) -> Statement:
    """The drift comes from mean forces of nonlinear terms, which are of second order in low waves."""
    heights = sorted(force)
    power = powers(force)
    holds = bool((power >= SECOND_ORDER[0]).all() and (power <= SECOND_ORDER[1]).all())
    told = ", ".join(f"{name} {value:.2f}" for name, value in zip(("surge", "sway"), power, strict=True))
    last = np.log(np.abs(force[heights[-1]]) / np.abs(force[heights[-2]])) / np.log(heights[-1] / heights[-2])
    return Statement(
        "Drift comes from mean forces that nonlinear terms bring, of second order in the wave height (8)",
        holds,
        f"mean force as H_s to the power {told}, from H_s {heights[0]:g} to {heights[1]:g} m;"
        f" {SECOND_ORDER[0]:g} to {SECOND_ORDER[1]:g} is the second",
        f"From {heights[-2]:g} to {heights[-1]:g} m it is {last[0]:.2f} and {last[1]:.2f}."
        if len(heights) > 2
        else "",
    )


def powers(force: dict[float, FloatArray]) -> FloatArray:
    """Power of the height (2,) by which the mean force grows between the two lowest seas."""
    low, high = sorted(force)[:2]
    return np.asarray(np.log(np.abs(force[high]) / np.abs(force[low])) / np.log(high / low))


def _table(runs: Mapping[Key, StoredRun]) -> str:
    rows = []
    for (kind, heading, model), run in runs.items():
        surge, sway = run.displacement[-1, :2]
        outcome = run.early_end or "finished"
        rows.append([kind, f"{heading:g}", model, f"{surge:+.0f}", f"{sway:+.0f}", outcome])
    heads = ("", "wave heading [deg]", "model", "surge [m]", "sway [m]", "outcome")
    return markdown_table(heads, rows, text_columns=1) + "\nSurge and sway at the end of the run.\n\n"


def _force_table(force: dict[float, FloatArray]) -> str:
    rows = [
        [f"{height:g}", *(f"{1e-3 * value:+.3g}" for value in values)] for height, values in force.items()
    ]
    heads = ("H_s [m]", "surge [kN]", "sway [kN]")
    return markdown_table(heads, rows, text_columns=0) + (
        f"\nMean force beyond the linear one at {BOW_QUARTERING:g}°, T_p {PERIOD:g} s, held by the report's"
        f" springs.\n"
    )


def _csv(runs: Mapping[Key, StoredRun]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    heads = ("surge at the end [m]", "sway at the end [m]", "outcome")
    writer.writerow(["run", "wave_heading [deg]", "model", *heads])
    for key, run in runs.items():
        writer.writerow([*key, *(f"{value:.6g}" for value in run.displacement[-1, :2]), run.outcome])
    return text.getvalue()


def _force_csv(force: dict[float, FloatArray]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["significant_wave_height [m]", "mean surge force [N]", "mean sway force [N]"])
    for height, values in force.items():
        writer.writerow([height, *(f"{value:.6g}" for value in values)])
    return text.getvalue()
