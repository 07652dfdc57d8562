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
from panelsim.studies.tm2003_190.common import BOW_QUARTERING, HEADINGS_DEG, STERN_QUARTERING
from panelsim.studies.tm2003_190.drift_statements import (
    FREE,
    HELD,
    MODELS,
    NO_SPRINGS,
    SHIFTED,
    SLOW_LEFT_OUT,
    drift_statement,
    force_statement,
)
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.view.drift_picture import drift_picture

HEIGHT, PERIOD = 7.5, 15.0  # m, s: sea state 7 of the report
LOW_HEIGHTS = (0.25, 0.5, 1.0, 2.0, 4.0)  # m, at the same period
QUICK_LOW_HEIGHTS = (0.5, 1.0)
DURATION = 600.0  # s
SEEDS, QUICK_SEEDS = (1, 2, 3, 4), (1, 2)
Key = tuple[str, float, str]  # kind of run, heading [deg], model
# Components between those of the report: none of them stands still beside the ship.
BETWEEN = {"start": 0.25, "stop": 1.95, "step": 0.1}
OUR_READING = (
    "The report has excessive motions with nonlinear terms, by drift forces, for want of springs and as"
    " radiation damping goes to zero with the frequency of encounter. That the linear model has none, and"
    " that the forces are of second order, is our reading of it."
)
UP_TO_1 = {"start": 0.2, "stop": 1.0, "step": 0.1}


@dataclass(frozen=True)
class Drift:
    """How far the ship goes in ten minutes when nothing holds her in surge and sway, in both models."""

    base: Case
    quick: bool
    key: str = "drift"

    @property
    def seeds(self) -> tuple[int, ...]:
        """Seeds of the sea; the runs without a yaw spring have the first alone."""
        return QUICK_SEEDS if self.quick else SEEDS

    @cached_property
    def free(self) -> dict[Key, tuple[Case, ...]]:
        """Sea state 7 by kind of run, heading [deg] and model, a case a seed: free in surge and sway.

        Then in components between those of the report; the linear ones from astern also without the waves
        above 1.0 rad/s, one of which stands still beside the ship; and, of one seed, without the yaw spring.
        """
        cases = {}
        damping = {"roll": self.base.supplementary.damping["roll"]}
        yaw = {"yaw": self.base.supplementary.stiffness["yaw"]}
        loose = {"supplementary.damping": damping, "supplementary.stiffness": yaw}
        for heading in HEADINGS_DEG:
            for model in MODELS:
                sea = self._case(heading, HEIGHT, model).changed(loose)
                cases[FREE, heading, model] = self._of_seeds(sea)
                cases[SHIFTED, heading, model] = self._of_seeds(sea.changed({"seaway.frequencies": BETWEEN}))
                cases[NO_SPRINGS, heading, model] = (sea.changed({"supplementary.stiffness": {}}),)
        sea = cases[FREE, STERN_QUARTERING, "linear"][0].changed({"seaway.frequencies": UP_TO_1})
        cases[SLOW_LEFT_OUT, STERN_QUARTERING, "linear"] = self._of_seeds(sea)
        return cases

    def _of_seeds(self, case: Case) -> tuple[Case, ...]:
        return tuple(case.changed({"seaway.seed": seed}) for seed in self.seeds)

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
        return [*(case for cases in self.free.values() for case in cases), *self.held.values()]

    def section(self, store: RunStore, folder: Path) -> Section:
        """Read the runs, draw the picture into the folder, say what they show."""
        runs = {
            key: tuple(store.load(case) for case in cases if store.failure(case) is None)
            for key, cases in self.free.items()
        }
        force = self.mean_force(store)
        paths = {
            f"{model}, {heading:g}°": [(run.time, run.displacement[:, :2]) for run in of_seeds]
            for (kind, heading, model), of_seeds in runs.items()
            if kind == FREE
        }
        picture = drift_picture(folder / "drift.png", paths, force)
        return Section(
            self.key,
            "Drift without springs (8)",
            "How far does the ship go without supplementary terms in surge and sway, and why?",
            f"20 knots, H_s {HEIGHT:g} m, T_p {PERIOD:g} s, ten minutes after the ramp; roll damping and yaw"
            " spring as in the report, nothing in surge and sway. Seeds"
            f" {', '.join(map(str, self.seeds))}, the same phases from both headings and in both models;"
            " without the yaw spring the first alone. A run ends where yaw passes 60°. " + OUR_READING,
            _table(runs) + _force_table(force),
            (*(self._drift_statement(heading, runs) for heading in HEADINGS_DEG), force_statement(force)),
            ((picture.name, "Distance from where the ship would be, a line a seed; mean force over H_s."),),
            {"drift.csv": _csv(runs), "mean_force.csv": _force_csv(force)},
            series={
                f"{model}, {heading:g}°": cases[0]
                for (kind, heading, model), cases in self.free.items()
                if kind == FREE
            },
            failures=self._failures(store),
        )

    def _drift_statement(self, heading: float, runs: Mapping[Key, Sequence[StoredRun]]) -> Statement:
        """The verdict for one heading, of the runs that finished."""
        found = {
            (kind, model): np.array([_distance(run) for run in of_seeds])
            for (kind, of, model), of_seeds in runs.items()
            if of == heading and len(of_seeds) == len(self.free[kind, of, model])
        }
        return drift_statement(heading, found, self.base.ship.length, slow=self._slowest(heading))

    def _failures(self, store: RunStore) -> tuple[str, ...]:
        """Runs that should have finished: to broach is what those without a yaw spring are for."""
        named = {
            f"{', '.join(map(str, key))}, seed {seed}": (case, key[0] != NO_SPRINGS)
            for key, cases in self.free.items()
            for seed, case in zip(self.seeds, cases, strict=False)
        }
        named |= {
            f"{HELD}, {height:g} m, {model}": (case, True) for (height, model), case in self.held.items()
        }
        found = {
            name: store.failure(case) or (store.load(case).early_end if should_finish else None)
            for name, (case, should_finish) in named.items()
        }
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
                means.append(
                    np.full(2, np.nan)
                    if run is None or run.early_end is not None
                    else run.displacement[run.after_ramp, :2].mean(axis=0)
                )
            force[height] = stiffness * (means[0] - means[1])
        return force

    def _slowest(self, heading: float) -> tuple[float, float]:
        """Frequency of the component that passes the ship most slowly, and of its encounter [rad/s]."""
        case = self.free[FREE, heading, "linear"][0]
        waves = case.seaway.components
        met = encounter_frequency(waves.frequency, waves.wave_heading, case.speed, case.ship.gravity)
        slow = int(np.argmin(np.abs(met)))
        return float(waves.frequency[slow]), float(met[slow])


def _distance(run: StoredRun) -> float:
    """Distance [m] at the end from where the ship would be; NaN of a run that did not finish."""
    return float(np.linalg.norm(run.displacement[-1, :2])) if run.early_end is None else np.nan


def _table(runs: Mapping[Key, Sequence[StoredRun]]) -> str:
    rows = []
    for (kind, heading, model), of_seeds in runs.items():
        ends = np.array([run.displacement[-1, :2] for run in of_seeds]).reshape(-1, 2)
        columns = (np.linalg.norm(ends, axis=1), *ends.T)
        shown = [
            ", ".join(f"{value:{form}}" for value in of) for of, form in zip(columns, _FORMS, strict=True)
        ]
        outcomes = dict.fromkeys(run.early_end or "finished" for run in of_seeds)
        rows.append([kind, f"{heading:g}", model, *shown, "; ".join(outcomes)])
    heads = ("", "wave heading [deg]", "model", "distance [m]", "surge [m]", "sway [m]", "outcome")
    return markdown_table(heads, rows, text_columns=1) + "\nAt the end of the run, seed by seed.\n\n"


_FORMS = (".0f", "+.0f", "+.0f")


def _force_table(force: dict[float, FloatArray]) -> str:
    rows = [
        [f"{height:g}", *(f"{1e-3 * value:+.3g}" for value in values)] for height, values in force.items()
    ]
    heads = ("H_s [m]", "surge [kN]", "sway [kN]")
    return markdown_table(heads, rows, text_columns=0) + (
        f"\nMean force beyond the linear one at {BOW_QUARTERING:g}°, T_p {PERIOD:g} s, held by the report's"
        f" springs.\n"
    )


def _csv(runs: Mapping[Key, Sequence[StoredRun]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    heads = ("seed", "surge at the end [m]", "sway at the end [m]", "outcome")
    writer.writerow(["run", "wave_heading [deg]", "model", *heads])
    for key, of_seeds in runs.items():
        for run in of_seeds:
            end = [f"{value:.6g}" for value in run.displacement[-1, :2]]
            writer.writerow([*key, run.attrs["seed"], *end, run.outcome])
    return text.getvalue()


def _force_csv(force: dict[float, FloatArray]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["significant_wave_height [m]", "mean surge force [N]", "mean sway force [N]"])
    for height, values in force.items():
        writer.writerow([height, *(f"{value:.6g}" for value in values)])
    return text.getvalue()
