"""How far the RMS of one run of the report's set-up can be believed, and what it takes to know it better."""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.stats import norm

from panelsim.case import Case
from panelsim.conventions import CONFIDENCE, DOF_NAMES, FloatArray
from panelsim.response.response import Response, response
from panelsim.response.run_length import LONGEST, SamplingError, sampling_error
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.results.rms_tables import markdown_table
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.random import RandomSeaway
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.common import (
    FULL,
    HEADINGS_DEG,
    LIMITING_STEEPNESS,
    QUICK,
    in_sea,
    low_seas,
)
from panelsim.studies.tm2003_190.linear_nonlinear import LINEAR, NONLINEAR, LinearNonlinear
from panelsim.studies.tm2003_190.rms_plan import RmsPlan
from panelsim.studies.tm2003_190.section import Section
from panelsim.view.sampling_picture import sampling_picture

BANDS = (0.10, 0.05)
JITTERED = 12  # realizations of other frequencies, in the frequency domain alone
_ONE_SIDE = float(norm.ppf(0.5 + 0.5 * CONFIDENCE))  # standard deviations of one run
SEA_STATE_7 = tuple(StudySea(f"{heading:g}°", heading, 7.5, 15.0) for heading in HEADINGS_DEG)  # section 8.4


@dataclass(frozen=True)
class SamplingStatistics:
    """Bands of single runs at the limiting steepness, by theory and over the seeds of both models."""

    base: Case
    quick: bool
    key: str = "statistics"

    @property
    def duration(self) -> float:
        """Length of a run [s]."""
        return (QUICK if self.quick else FULL).duration

    @cached_property
    def plan(self) -> RmsPlan:
        """The runs of the comparison of models at the limiting steepness."""
        return LinearNonlinear(self.base, QUICK if self.quick else FULL).plans["limiting"]

    @property
    def cases(self) -> Sequence[Case]:
        """Every run that the section reads."""
        return self.plan.cases

    @cached_property
    def _lengths(self) -> dict[str, FloatArray]:
        """Lengths (2, 6) [s] for the bands by the label of the sea: the search for one takes a while."""
        return {
            label: np.array([waves.run_length(band) for band in BANDS])
            for label, waves in self._waves.items()
        }

    @cached_property
    def _waves(self) -> dict[str, SamplingError]:
        """The components of each sea by its label."""
        return {sea.label: self._of_components(sea) for sea in self.plan.seas}

    @cached_property
    def table(self) -> Response:
        """The ship at the speed of the study, from both headings."""
        return response(
            self.base.ship,
            self.base.database(),
            frequencies=[0.5, 1.0],
            wave_headings=np.deg2rad(HEADINGS_DEG),
            speeds=[self.base.speed],
            supplementary=self.base.supplementary,
        )

    def section(self, store: RunStore, folder: Path) -> Section:
        """Read the runs, draw the picture into the folder, say what they show."""
        study = self.plan.read(store)
        waves = [self._waves[sea.label] for sea in study.seas]
        spectra = [self._of_spectrum(sea) for sea in study.seas]
        scatter = {model: seed_scatter(study, study.levels.index(model)) for model in (LINEAR, NONLINEAR)}
        picture = self._picture(folder, study, waves, spectra, scatter)
        return Section(
            self.key,
            "How far one run can be believed",
            "How near is the RMS of one run to that of its sea, and how long or how many runs does it take?",
            f"{study.rms.shape[2]} runs of {self.duration / 60:g} minutes of each sea, nominal steepness"
            f" {LIMITING_STEEPNESS:g}, 20 knots, 19 components; beside them the band that theory gives for"
            " linear motions in these components with random phases, and in the continuous spectrum."
            + low_seas(self.base, (QUICK if self.quick else FULL).heights, LIMITING_STEEPNESS),
            self._body(study, waves, spectra, scatter) + self._jitter(),
            (),
            (
                (
                    picture.name,
                    f"95 % band of the RMS of one run of {self.duration / 60:g} minutes; of the seeds 1.96"
                    " standard deviations.",
                ),
            ),
            {"sampling.csv": self._csv(study, waves, spectra, scatter)},
            failures=study.failures,
        )

    def _of_components(self, sea: StudySea) -> SamplingError:
        return self._of_case(in_sea(self.base, sea, 0))

    def _of_case(self, case: Case) -> SamplingError:
        """The components alone: their spectrum is solved once, not with every draw."""
        return sampling_error(self.table, ComponentSeaway(case.seaway.components, 0.0))

    def _of_spectrum(self, sea: StudySea) -> SamplingError:
        seaway = in_sea(self.base, sea, 0).seaway
        assert isinstance(seaway, RandomSeaway)
        heading = float(np.deg2rad(sea.wave_heading_deg))
        return sampling_error(self.table, seaway.point_spectrum, wave_heading=heading)

    def _body(
        self,
        study: RmsStudy,
        waves: Sequence[SamplingError],
        spectra: Sequence[SamplingError],
        scatter: dict[str, FloatArray],
    ) -> str:
        """The worst of the modes that count, sea by sea."""
        rows = []
        for i, (sea, of_waves, of_spectrum) in enumerate(zip(study.seas, waves, spectra, strict=True)):
            major = study.major[i]
            bands = (
                of_waves.band(self.duration),
                scatter[LINEAR][i],
                scatter[NONLINEAR][i],
                of_spectrum.band(self.duration),
            )
            rows.append(
                [
                    sea.label,
                    *(_per_cent(_worst(band, major)) for band in bands),
                    *(_time(_worst(length, major)) for length in self._lengths[sea.label]),
                    *(_count(_worst(of_waves.realizations(band, self.duration), major)) for band in BANDS),
                    _signed(of_waves.rms / of_spectrum.rms - 1.0, major),
                ]
            )
        heads = (
            *("sea", "band [± %]", "linear seeds [± %]", "nonlinear seeds [± %]", "in the spectrum [± %]"),
            *(f"length for {100 * band:g} %" for band in BANDS),
            *(f"runs for {100 * band:g} %" for band in BANDS),
            "grid against spectrum",
        )
        return markdown_table(heads, rows, text_columns=1) + (
            "\nThe worst of the modes that count. Length: from which on one run has the band, ∞ where none"
            f" of a day ({LONGEST:g} s) has; then only other phases help, in so many runs of"
            f" {self.duration / 60:g} minutes. The last column is what the 19 components themselves are off"
            " their spectrum: neither length nor seeds mend it. Where the band is wide it is a sign that one"
            " run tells little, not a bound.\n"
        )

    def _jitter(self) -> str:
        """What frequencies left to chance do to the RMS, in the frequency domain."""
        rows = []
        jittered = self.base.changed({"seaway.frequencies.choice": "jittered"})
        for sea in SEA_STATE_7:
            even, spectral = self._of_components(sea), self._of_spectrum(sea)
            drawn = [self._of_case(in_sea(jittered, sea, i)) for i in range(JITTERED)]
            rms = np.array([one.rms for one in drawn]) / spectral.rms
            columns = np.array(
                [
                    even.rms / spectral.rms - 1.0,
                    rms.mean(axis=0) - 1.0,
                    _one_run(rms, axis=0),
                    even.band(self.duration),
                    np.median([one.band(self.duration) for one in drawn], axis=0),
                ]
            )
            length = spectral.run_length(BANDS[0])
            for mode, name in enumerate(DOF_NAMES):
                shown = [f"{100 * value:+.2g}" for value in columns[:2, mode]]
                shown += [_per_cent(value) for value in columns[2:, mode]]
                rows.append([f"{sea.label}, {name}", *shown, _time(length[mode])])
        heads = (
            *("sea state 7", "even grid [%]", "jittered, mean [%]", "jittered, of the frequencies [± %]"),
            *("even, of the phases [± %]", "jittered, of the phases [± %]"),
            f"length for {100 * BANDS[0]:g} % in the spectrum",
        )
        return (
            "\n"
            + markdown_table(heads, rows, text_columns=1)
            + (
                f"\nH_s 7.5 m, T_p 15 s, RMS against the spectrum, linear, {JITTERED} draws of jittered"
                " frequencies. What the even grid is off is the same in every run; of jittered frequencies"
                " most is chance, which more seeds average out.\n"
            )
        )

    def _picture(
        self,
        folder: Path,
        study: RmsStudy,
        waves: Sequence[SamplingError],
        spectra: Sequence[SamplingError],
        scatter: dict[str, FloatArray],
    ) -> Path:
        shown = {}
        for heading in HEADINGS_DEG:
            here = [i for i, sea in enumerate(study.seas) if sea.wave_heading_deg == heading]
            lines = {
                "theory, 19 components": np.array([waves[i].band(self.duration) for i in here]),
                "theory, continuous spectrum": np.array([spectra[i].band(self.duration) for i in here]),
            }
            points = {f"seeds, {model}": values[here] for model, values in scatter.items()}
            shown[f"{heading:g}°"] = (lines, points)
        heights = np.array([sea.significant_wave_height or np.nan for sea in study.seas])
        return sampling_picture(folder / "sampling.png", heights[here], shown)

    def _csv(
        self,
        study: RmsStudy,
        waves: Sequence[SamplingError],
        spectra: Sequence[SamplingError],
        scatter: dict[str, FloatArray],
    ) -> str:
        """A row a sea and mode."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        lengths = [f"length for {band:g} [s]" for band in BANDS]
        runs = [f"runs for {band:g}" for band in BANDS]
        sources = ("band", "linear seeds", "nonlinear seeds", "spectrum")
        writer.writerow(["sea", "mode", "counts", *sources, *lengths, *runs, "grid error"])
        for i, sea in enumerate(study.seas):
            of_waves = waves[i]
            columns = np.array(
                [
                    of_waves.band(self.duration),
                    scatter[LINEAR][i],
                    scatter[NONLINEAR][i],
                    spectra[i].band(self.duration),
                    *self._lengths[sea.label],
                    *(of_waves.realizations(band, self.duration) for band in BANDS),
                    of_waves.rms / spectra[i].rms - 1.0,
                ]
            )
            for mode, name in enumerate(DOF_NAMES):
                counts = "yes" if study.major[i, mode] else "no"
                writer.writerow([sea.label, name, counts, *(f"{value:.4g}" for value in columns[:, mode])])
        return text.getvalue()


def seed_scatter(study: RmsStudy, level: int) -> FloatArray:
    """Half width (S, 6) of the 95 % band of a single run, over the pooled RMS, from its realizations."""
    return np.asarray(_one_run(study.rms[level], axis=1) / study.pooled[level])


def _one_run(rms: FloatArray, axis: int) -> FloatArray:
    """Half width of the 95 % band of a single one of many RMS."""
    return np.asarray(_ONE_SIDE * rms.std(axis=axis, ddof=1))


def _worst(values: FloatArray, major: np.ndarray) -> float:
    """The largest of the modes that count; NaN where one of them is not known, or none counts."""
    return float(np.max(values[major])) if major.any() else np.nan


def _signed(values: FloatArray, major: np.ndarray) -> str:
    """The largest by size of the modes that count, in per cent, with its mode; – where none counts."""
    if not major.any():
        return "–"
    size = np.where(major, np.abs(values), -1.0)
    mode = int(np.argmax(size))
    return f"{100 * values[mode]:+.2g} % in {DOF_NAMES[mode]}"


def _per_cent(share: float) -> str:
    return "–" if np.isnan(share) else f"{100 * share:.2g}"


def _count(runs: float) -> str:
    return "–" if np.isnan(runs) else f"{runs:.0f}"


def _time(seconds: float) -> str:
    if np.isnan(seconds):
        return "–"
    if np.isinf(seconds):
        return "∞"
    return (
        f"{seconds:.0f} s"
        if seconds < 600
        else f"{seconds / 60:.0f} min"
        if seconds < 36000
        else f"{seconds / 3600:.0f} h"
    )
