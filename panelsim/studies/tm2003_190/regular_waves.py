"""TM 2003-190 section 9: sinusoidal and Stokes waves, time and frequency domain; figures 18 and 19."""

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.conventions import ComplexArray, FloatArray
from panelsim.results.rms_tables import markdown_table
from panelsim.results.verdicts import IDENTICAL, SLIGHT
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.excess_answer import ExcessAnswer
from panelsim.studies.tm2003_190.regular_causes import causes_table, found_causes, growth_told
from panelsim.studies.tm2003_190.regular_runs import (
    MEASURED,
    MODE_NAMES,
    RAMP,
    TIME_STEP,
    TRANSIENT,
    Measured,
    RegularRuns,
    left_out,
    relative_difference,
    steepness_told,
    worst,
)
from panelsim.studies.tm2003_190.section import Section, Statement
from panelsim.view.regular_wave_picture import regular_wave_picture

FROUDE = (0.12, 0.20)
LENGTH_RATIO = (0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0)
STEEPNESS = (1 / 30, 1 / 20, 1 / 15)
QUICK_LENGTH_RATIO, QUICK_STEEPNESS = (1.0, 1.4, 2.0), (1 / 20,)
SHOWN = 1 / 20  # the steepness of the predictions in the report's figures
LOW = 1 / 100  # to see with which power of the steepness a difference grows
SINUSOIDAL, STOKES = "sinusoidal", "Stokes"
THEORY = {SINUSOIDAL: "linear", STOKES: "stokes"}
SETTLED = 0.01  # windows that differ by more are not periodic yet


@dataclass(frozen=True)
class RegularWaves:
    """Heave and pitch in head seas, nonlinear runs in both kinds of wave beside the frequency domain."""

    base: Case
    quick: bool
    key: str = "regular-waves"

    @cached_property
    def runs(self) -> dict[str, RegularRuns]:
        """The runs in each kind of wave; the sinusoidal ones in low waves too."""
        length = QUICK_LENGTH_RATIO if self.quick else LENGTH_RATIO
        steepness = QUICK_STEEPNESS if self.quick else STEEPNESS
        low = () if self.quick else (LOW,)
        return {
            name: RegularRuns(
                self.base,
                FROUDE,
                length,
                (*low, *steepness) if name == SINUSOIDAL else steepness,
                {"seaway.wave_theory": theory, "seaway.stretching": "wheeler", "run.model": "nonlinear"},
            )
            for name, theory in THEORY.items()
        }

    @property
    def cases(self) -> Sequence[Case]:
        """Every run that the section reads."""
        return [case for runs in self.runs.values() for case in runs.cases]

    def section(self, store: RunStore, folder: Path) -> Section:
        """Read the runs, draw the pictures into the folder, say what they show."""
        measured = {name: runs.read(store) for name, runs in self.runs.items()}
        linear = self.runs[SINUSOIDAL].linear()
        stokes = replace(measured[SINUSOIDAL], transfer=self._common(measured[SINUSOIDAL].transfer))
        causes = found_causes(store, self.runs[SINUSOIDAL], measured[SINUSOIDAL], linear, self._shown)
        unsettled = max(float(np.nanmax(found.unsettled, initial=0.0)) for found in measured.values())
        return Section(
            self.key,
            "Regular waves (9)",
            "Do second-order waves matter for heave and pitch, and how near are time and frequency domain?",
            "Head seas at Fn 0.12 and 0.20; nonlinear runs with Wheeler stretching in sinusoidal and in"
            f" Stokes waves, step {TIME_STEP:g} s; first harmonics of the last {0.5 * MEASURED:g} s, after a"
            f" ramp of {RAMP:g} s and {TRANSIENT + 0.5 * MEASURED:g} s more. Between the last two windows"
            f" mean and harmonics change by {unsettled:.1g} of the first harmonic at most. The report's axes"
            " are not told; here they are λ/L, heave over the wave amplitude and pitch over the wave slope"
            " k a." + left_out(self.runs[SINUSOIDAL], measured[SINUSOIDAL], linear, SHOWN),
            self._body(measured, linear) + causes_table(self.runs[SINUSOIDAL], causes),
            (
                stokes_statement(self.runs[STOKES], measured[STOKES], stokes, linear),
                self._domains_statement(measured[SINUSOIDAL], linear, causes),
            ),
            tuple(self._picture(folder, f, measured, linear) for f in range(len(FROUDE))),
            {"regular_waves.csv": _csv(self.runs, measured, linear)},
            series={
                f"{name}, Fn {FROUDE[f]:g}, λ/L {runs.length_ratio[r]:g}, H/λ 1/20": case
                for name, runs in self.runs.items()
                for (f, r, h), case in runs.by_index.items()
                if runs.length_ratio[r] == 1.0 and runs.steepness[h] == SHOWN
            },
            failures=(
                *(f"{name}: {failure}" for name, found in measured.items() for failure in found.failures),
                *_not_periodic(self.runs, measured),
            ),
        )

    def _common(self, sinusoidal: ComplexArray) -> ComplexArray:
        """Of the sinusoidal waves those of the steepness that the Stokes waves have."""
        return sinusoidal[:, :, -len(self.runs[STOKES].steepness) :]

    def _domains_statement(
        self, found: Measured, linear: ComplexArray, causes: Mapping[tuple[int, ...], ExcessAnswer]
    ) -> Statement:
        """Close agreement of time and frequency domain, with the causes where there is none."""
        runs = self.runs[SINUSOIDAL]
        statement = domains_statement(runs, found.transfer[:, :, self._shown], linear)
        if statement.holds or not causes:
            return statement
        told = [
            f"{runs.told(at[:-1])}, {MODE_NAMES[at[-1]]} {100 * answer.run:+.2g} %: {answer.verdict}"
            for at, answer in causes.items()
        ]
        at = worst(relative_difference(found.transfer[:, :, self._shown], linear, linear))
        power = "" if at is None else growth_told(runs, found, linear, at)
        remark = f"{statement.remark} The cause, solved for in the section: {'; '.join(told)}.{power}"
        return replace(statement, remark=remark.strip())

    @property
    def _shown(self) -> int:
        return self.runs[SINUSOIDAL].steepness.index(SHOWN)

    def _picture(
        self, folder: Path, f: int, measured: dict[str, Measured], linear: ComplexArray
    ) -> tuple[str, str]:
        runs = self.runs[SINUSOIDAL]
        lines = {"frequency domain": np.abs(linear[f])}
        points: dict[str, FloatArray] = {}
        for name, of in self.runs.items():
            amplitude = np.abs(measured[name].transfer[f])
            for h, steepness in enumerate(of.steepness):
                label = f"{name}, H/λ 1/{1 / steepness:.0f}"
                (lines if steepness == SHOWN else points)[label] = amplitude[:, h]
        path = folder / f"regular_waves_{FROUDE[f]:.2f}.png"
        regular_wave_picture(path, f"Head seas, Fn {FROUDE[f]:g}", np.array(runs.length_ratio), lines, points)
        return path.name, (
            f"Heave and pitch in head seas at Fn {FROUDE[f]:g} (figure {18 + f} of the report, which has"
            " tank tests beside predictions at H/λ 1/20)."
        )

    def _body(self, measured: dict[str, Measured], linear: ComplexArray) -> str:
        """The largest differences by steepness, and the second harmonics."""
        heads = ("", "H/λ", "heave [%]", "pitch [%]")
        runs, rows = self.runs[SINUSOIDAL], []
        for h, steepness in enumerate(runs.steepness):
            against = relative_difference(measured[SINUSOIDAL].transfer[:, :, h], linear, linear)
            rows.append(
                ["sinusoidal against frequency domain", steepness_told(steepness), *_largest(against)]
            )
        sinusoidal = self._common(measured[SINUSOIDAL].transfer)
        for h, steepness in enumerate(self.runs[STOKES].steepness):
            against = relative_difference(measured[STOKES].transfer[:, :, h], sinusoidal[:, :, h], linear)
            rows.append(["Stokes against sinusoidal", steepness_told(steepness), *_largest(against)])
        for name, found in measured.items():
            second = found.second[:, :, self.runs[name].steepness.index(SHOWN)]
            rows.append([f"second harmonic, {name}, of a and k a", steepness_told(SHOWN), *_largest(second)])
        return markdown_table(heads, rows, text_columns=1)


def stokes_statement(
    runs: RegularRuns, stokes: Measured, sinusoidal: Measured, linear: ComplexArray
) -> Statement:
    """Second-order waves are negligible for heave and pitch: of little influence on the first harmonic."""
    difference = relative_difference(stokes.transfer, sinusoidal.transfer, linear)
    at = worst(difference)
    says = "Second-order waves have negligible influence on heave and pitch (9)"
    if at is None:
        return Statement(says, False, "no run to compare")
    value = difference[at]
    holds = bool(abs(value) <= SLIGHT) and not np.isnan(stokes.transfer).any()
    return Statement(
        says,
        holds,
        f"{100 * value:+.2g} % in {MODE_NAMES[at[-1]]} ({runs.told(at[:-1])}), {'' if holds else 'not '}≤"
        f" {100 * SLIGHT:g} %",
        _not_identical(runs, difference),
    )


def domains_statement(runs: RegularRuns, transfer: ComplexArray, linear: ComplexArray) -> Statement:
    """Close agreement at the steepness of the report's figures, transfer (F, R, 2): within 5 %."""
    difference = relative_difference(transfer, linear, linear)
    at = worst(difference)
    says = "Very close agreement of frequency and time domain with Wheeler stretching (9)"
    if at is None:
        return Statement(says, False, "no run to compare")
    value = difference[at]
    of_peak = (np.abs(transfer) - np.abs(linear)) / np.abs(linear).max(axis=1, keepdims=True)
    peak = worst(of_peak)
    assert peak is not None
    holds = bool(abs(value) <= SLIGHT) and not np.isnan(transfer).any()
    size = np.nanmax(np.abs(np.nan_to_num(difference)), axis=(0, 2))
    size[np.isnan(transfer).any(axis=(0, 2))] = np.inf  # of a run that failed nothing is known
    far = [ratio for ratio, most in zip(runs.length_ratio, size, strict=True) if most > SLIGHT]
    near = [ratio for ratio in runs.length_ratio if ratio > max(far, default=0.0)]
    return Statement(
        says,
        holds,
        f"{100 * value:+.2g} % in {MODE_NAMES[at[-1]]} ({runs.told(at[:-1])}, H/λ 1/20),"
        f" {'' if holds else 'not '}≤ {100 * SLIGHT:g} %; of the peak {100 * of_peak[peak]:+.2g} % in"
        f" {MODE_NAMES[peak[-1]]} ({runs.told(peak[:-1])})",
        f"At H/λ 1/20 within {100 * SLIGHT:g} % from λ/L {near[0]:g} on." if far and near else "",
    )


def _not_identical(runs: RegularRuns, difference: FloatArray) -> str:
    """How the difference grows with steepness, where it is above what is practically identical."""
    size = np.nanmax(np.abs(np.nan_to_num(difference)), axis=(0, 1, 3))
    if size.max() <= IDENTICAL:
        return f"≤ {100 * IDENTICAL:g} % as well."
    told = ", ".join(
        f"{100 * value:.2g} % at H/λ {steepness_told(steep)}"
        for value, steep in zip(size, runs.steepness, strict=True)
    )
    return f"Not ≤ {100 * IDENTICAL:g} %: {told}."


def _not_periodic(runs: dict[str, RegularRuns], measured: dict[str, Measured]) -> list[str]:
    return [
        f"{name}: {runs[name].told(tuple(int(i) for i in index[:-1]))}: {MODE_NAMES[index[-1]]} is not"
        f" periodic yet, its harmonics change by {100 * found.unsettled[tuple(index)]:.2g} %"
        for name, found in measured.items()
        for index in np.argwhere(found.unsettled > SETTLED)
    ]


def _largest(values: FloatArray) -> list[str]:
    """Of heave and of pitch the value of the largest size, in per cent."""
    found = (worst(values[..., mode]) for mode in range(2))
    return ["–" if at is None else f"{100 * values[(*at, mode)]:+.2g}" for mode, at in enumerate(found)]


def _csv(runs: dict[str, RegularRuns], measured: dict[str, Measured], linear: ComplexArray) -> str:
    """A row a run: amplitudes and phases beside those of the frequency domain, means, second harmonics."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    columns = ("amplitude", "phase [deg]", "frequency domain", "its phase [deg]", "mean", "second harmonic")
    heads = [f"{mode} {column}" for mode in MODE_NAMES for column in columns]
    writer.writerow(["waves", "Fn", "λ/L", "H/λ", *heads])
    for name, found in measured.items():
        of = runs[name]
        for f, r, h in of.by_index:
            cells: list[float] = []
            for mode in range(2):
                both = found.transfer[f, r, h, mode], linear[f, r, mode]
                cells += [part for z in both for part in (abs(z), np.degrees(np.angle(z)))]
                cells += [found.mean[f, r, h, mode], found.second[f, r, h, mode]]
            wave = (name, of.froude[f], of.length_ratio[r], f"{of.steepness[h]:.6g}")
            writer.writerow([*wave, *("" if np.isnan(cell) else f"{cell:.6g}" for cell in cells)])
    return text.getvalue()
