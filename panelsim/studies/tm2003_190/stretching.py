"""What Wheeler stretching does to the difference of time and frequency domain (TM 2003-190 section 9)."""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.conventions import ComplexArray, FloatArray
from panelsim.results.rms_study import StudySea
from panelsim.results.rms_tables import difference_markdown, markdown_table, rms_csv
from panelsim.results.verdicts import SLIGHT
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.common import BOW_QUARTERING, FULL, QUICK
from panelsim.studies.tm2003_190.excess_answer import excess_answer
from panelsim.studies.tm2003_190.regular_runs import (
    MODE_NAMES,
    MODES,
    Measured,
    RegularRuns,
    left_out,
    relative_difference,
    worst,
)
from panelsim.studies.tm2003_190.regular_waves import (
    FROUDE,
    LENGTH_RATIO,
    QUICK_LENGTH_RATIO,
    QUICK_STEEPNESS,
    SHOWN,
    STEEPNESS,
)
from panelsim.studies.tm2003_190.rms_plan import Level, RmsPlan
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.view.regular_wave_picture import regular_wave_picture

WHEELER, NONE = "Wheeler", "no stretching"
STRETCHING = {WHEELER: "wheeler", NONE: "none"}
SEA = StudySea("H_s 7.5 m, T_p 15 s, 150°", BOW_QUARTERING, 7.5, 15.0)


@dataclass(frozen=True)
class Stretching:
    """Regular head seas and one random sea, nonlinear with both kinds of wave kinematics, beside linear."""

    base: Case
    quick: bool
    key: str = "stretching"

    @cached_property
    def runs(self) -> dict[str, RegularRuns]:
        """The regular waves with each stretching; those with Wheeler are of the study of regular waves."""
        return {
            name: RegularRuns(
                self.base,
                FROUDE,
                QUICK_LENGTH_RATIO if self.quick else LENGTH_RATIO,
                QUICK_STEEPNESS if self.quick else STEEPNESS[:2],
                {"seaway.wave_theory": "linear", "seaway.stretching": key, "run.model": "nonlinear"},
            )
            for name, key in STRETCHING.items()
        }

    @cached_property
    def random(self) -> RmsPlan:
        """One random sea: linear, which is the frequency domain in these very waves, and nonlinear."""
        levels = (
            Level("linear", 0.0, {"run.model": "linear"}),
            *(
                Level(name, float(value), {"run.model": "nonlinear", "seaway.stretching": key})
                for value, (name, key) in enumerate(STRETCHING.items(), start=1)
            ),
        )
        duration = (QUICK if self.quick else FULL).duration
        return RmsPlan(
            self.base.changed({"run.duration": duration}),
            "Stretching",
            "0 linear, 1 Wheeler, 2 no stretching",
            levels,
            0,
            (SEA,),
            1,
        )

    @property
    def cases(self) -> Sequence[Case]:
        """Every run that the section reads."""
        return [*(case for runs in self.runs.values() for case in runs.cases), *self.random.cases]

    def section(self, store: RunStore, folder: Path) -> Section:
        """Read the runs, draw the pictures into the folder, say what they show."""
        measured = {name: runs.read(store) for name, runs in self.runs.items()}
        linear = self.runs[WHEELER].linear()
        study = self.random.read(store)
        return Section(
            self.key,
            "Wheeler stretching (9)",
            "Is it Wheeler stretching that brings the time domain near to the frequency domain?",
            "Nonlinear runs in sinusoidal head seas at Fn 0.12 and 0.20, with Wheeler stretching, exp(k(z -"
            f" ζ)), and without, exp(k min(z, 0)), step 0.1 s; and a random sea, {SEA.label}, at 20 knots"
            " beside a linear run in the same waves. The earlier report's kinematics above calm water are"
            " not told in this one: what it compared with may not be our run without stretching."
            + left_out(self.runs[WHEELER], measured[WHEELER], linear, SHOWN),
            _table(self.runs, measured, linear) + f"\n{difference_markdown(study)}",
            (self._statement(store, measured, linear),),
            tuple(self._picture(folder, f, measured, linear) for f in range(len(FROUDE))),
            {
                "stretching.csv": _csv(self.runs, measured, linear),
                "stretching_random_sea.csv": rms_csv(study),
            },
            (study,),
            {level.name: self.random.case(row, 0, 0) for row, level in enumerate(self.random.levels)},
            (
                *(f"{name}: {failure}" for name, found in measured.items() for failure in found.failures),
                *study.failures,
            ),
        )

    def _statement(self, store: RunStore, measured: dict[str, Measured], linear: ComplexArray) -> Statement:
        """The verdict, and where the load is not linear, with and without stretching."""
        found = statement(measured[WHEELER], measured[NONE], linear)
        at = worst(relative_difference(measured[WHEELER].transfer, linear, linear))
        if found.holds or at is None:
            return found
        told = []
        for name, runs in self.runs.items():
            answer = excess_answer(store, runs.by_index[at[0], at[1], at[2]], MODES[at[-1]])
            told.append(
                f"{name} {100 * answer.run:+.2g} % in the run, {100 * answer.pressure:+.2g} % of the linear"
                f" ship with the pressure that is not linear, {100 * answer.stern:+.2g} % with that of"
                " the stern alone"
            )
        cause = f"At the worst ({self.runs[WHEELER].told(at[:-1])}, {MODE_NAMES[at[-1]]}): {'; '.join(told)}."
        return replace(found, remark=f"{found.remark} {cause}")

    def _picture(
        self, folder: Path, f: int, measured: dict[str, Measured], linear: ComplexArray
    ) -> tuple[str, str]:
        runs = self.runs[WHEELER]
        shown = len(runs.steepness) - 1
        steep = f"H/λ 1/{1 / runs.steepness[shown]:.0f}"
        path = folder / f"stretching_{FROUDE[f]:.2f}.png"
        lines = {
            "frequency domain": np.abs(linear[f]),
            **{name: np.abs(found.transfer[f, :, shown]) for name, found in measured.items()},
        }
        title = f"Head seas, Fn {FROUDE[f]:g}, {steep}"
        regular_wave_picture(path, title, np.array(runs.length_ratio), lines, {})
        return path.name, f"Heave and pitch at Fn {FROUDE[f]:g}, {steep}, with and without stretching."


def statement(wheeler: Measured, none: Measured, linear: ComplexArray) -> Statement:
    """Wheeler's stretching made the earlier difference vanish: ≤ 5 % with it, and more than that without."""
    size = {
        name: np.nan_to_num(np.abs(relative_difference(found.transfer, linear, linear)), nan=0.0).max(
            axis=(0, 1)
        )
        for name, found in ((WHEELER, wheeler), (NONE, none))
    }
    failed = bool(np.isnan(wheeler.transfer).any() or np.isnan(none.transfer).any())
    holds = not failed and float(size[WHEELER].max()) <= SLIGHT < float(size[NONE].max())
    figures = "; ".join(
        f"{name}: heave {100 * heave:.2g} %, pitch {100 * pitch:.2g} %"
        for name, (heave, pitch) in ((name, of.max(axis=0)) for name, of in size.items())
    )
    mean = {
        name: f"{100 * np.nanmax(np.abs(found.mean[..., 0])):.2g} %"
        for name, found in ((WHEELER, wheeler), (NONE, none))
    }
    return Statement(
        "Wheeler stretching makes the difference of time and frequency domain vanish (9)",
        holds,
        f"largest difference of the first harmonic, {figures}; Wheeler ≤ {100 * SLIGHT:g} % and none above it"
        " would hold",
        f"What stretching changes above all is the mean heave: at most {mean[WHEELER]} of the wave amplitude"
        f" with it, {mean[NONE]} without.",
    )


def _table(runs: dict[str, RegularRuns], measured: dict[str, Measured], linear: ComplexArray) -> str:
    """RMS over λ/L of the differences, which is the size of one without its sign, and mean heave."""
    rows = []
    for name, found in measured.items():
        difference = relative_difference(found.transfer, linear, linear)
        for f, froude in enumerate(FROUDE):
            for h, steepness in enumerate(runs[name].steepness):
                shown = [_rms(difference[f, :, h, mode]) for mode in range(2)]
                mean = 100 * float(np.nanmean(found.mean[f, :, h, 0]))
                told = [name, f"{froude:g}", f"1/{1 / steepness:.0f}"]
                rows.append([*told, *shown, f"{mean:+.2g}"])
    heads = ("", "Fn", "H/λ", "heave [%]", "pitch [%]", "mean heave [% of a]")
    note = (
        "\nAmplitudes against the frequency domain, root mean square over λ/L; mean heave, mean over λ/L.\n"
    )
    return markdown_table(heads, rows, text_columns=1) + note


def _rms(values: FloatArray) -> str:
    known = values[~np.isnan(values)]
    return f"{100 * np.sqrt(np.mean(known**2)):.2g}" if len(known) else "–"


def _csv(runs: dict[str, RegularRuns], measured: dict[str, Measured], linear: ComplexArray) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    heads = [f"{mode} {part}" for mode in MODE_NAMES for part in ("amplitude", "frequency domain", "mean")]
    writer.writerow(["stretching", "Fn", "λ/L", "H/λ", *heads])
    for name, found in measured.items():
        of = runs[name]
        for f, r, h in of.by_index:
            cells = [
                float(value)
                for mode in range(2)
                for value in (
                    abs(found.transfer[f, r, h, mode]),
                    abs(linear[f, r, mode]),
                    found.mean[f, r, h, mode],
                )
            ]
            wave = (name, of.froude[f], of.length_ratio[r], f"{of.steepness[h]:.6g}")
            writer.writerow([*wave, *("" if np.isnan(cell) else f"{cell:.6g}" for cell in cells)])
    return text.getvalue()
