"""The tables of a study of RMS: every run as CSV, and what they amount to as Markdown."""

import csv
import io
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.results.rms_study import CONFIDENCE, RmsStudy
from panelsim.results.statistics import display_unit
from panelsim.results.verdicts import words, worst_difference

SEA_COLUMNS = ("sea", "wave_heading [deg]", "significant_wave_height [m]", "peak_period [s]")


def rms_csv(study: RmsStudy) -> str:
    """CSV text with a row a level, sea and realization: RMS in m and degrees, empty where a run failed.

    What is varied has a column where it has a unit, as a model has not.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    heads = [f"{name}_rms [{display_unit(name)[0]}]" for name in DOF_NAMES]
    varied = [study.varied] if study.varied.endswith("]") else []
    writer.writerow(["level", *varied, *SEA_COLUMNS, "realization", *heads])
    shown = display_rms(study.rms)
    for level, sea, realization in np.ndindex(shown.shape[:3]):
        met = study.seas[sea]
        of_sea = (met.label, met.wave_heading_deg, met.significant_wave_height, met.peak_period)
        cells = ("" if np.isnan(value) else repr(float(value)) for value in shown[level, sea, realization])
        value = [repr(float(study.values[level]))] if varied else []
        writer.writerow([study.levels[level], *value, *of_sea, realization + 1, *cells])
    return text.getvalue()


def rms_markdown(study: RmsStudy) -> str:
    """Markdown with a row a level and sea: RMS of all realizations, with their confidence band if known."""
    heads = [f"{name} [{display_unit(name)[0]}]" for name in DOF_NAMES]
    shown, band = display_rms(study.pooled), study.band
    rows = [
        [study.levels[level], study.seas[sea].label, *_with_band(shown[level, sea], band[level, sea])]
        for level, sea in np.ndindex(shown.shape[:2])
    ]
    note = "" if np.isnan(band).all() else f"\n±: {100.0 * CONFIDENCE:g} % confidence band.\n"
    return markdown_table(["level", "sea", *heads], rows, text_columns=2) + note


def difference_markdown(study: RmsStudy) -> str:
    """Markdown with a row a level and wave heading: the largest differences of the seas from there.

    In per cent of the reference, signed, by mode; then the worst of all with its sea, and what that is
    called. A dash stands for a mode that is minor in all of the seas.
    """
    headings = list(dict.fromkeys(sea.wave_heading_deg for sea in study.seas))
    rows = []
    for level in range(len(study.levels)):
        for heading in headings if level != study.reference else ():
            worst = worst_difference(study, level, heading)
            told = "a run did not finish" if np.isnan(worst.amount) else worst.told
            cells = [_per_cent(value) for value in _largest(study, level, heading)]
            rows.append([study.levels[level], f"{heading:g}", *cells, told, words(worst.amount)])
    heads = ["level", "wave heading [deg]", *(f"{name} [%]" for name in DOF_NAMES), "worst", "this is"]
    return markdown_table(heads, rows, text_columns=1) + f"\nAgainst {study.levels[study.reference]}.\n"


def markdown_table(heads: Sequence[str], rows: Iterable[Sequence[str]], *, text_columns: int) -> str:
    """A Markdown table; columns after the first `text_columns` are set to the right."""
    rule = ["---"] * text_columns + ["---:"] * (len(heads) - text_columns)
    return "".join(f"| {' | '.join(line)} |\n" for line in [heads, rule, *rows])


def display_rms(rms: FloatArray) -> FloatArray:
    """RMS (…, 6) [m, rad] in the units that people read, m and degrees."""
    return np.asarray(rms * np.array([display_unit(name)[1] for name in DOF_NAMES]))


def _largest(study: RmsStudy, level: int, heading: float) -> Iterator[float]:
    """Of each mode the largest difference in the seas from a heading; NaN where it is minor in all."""
    chosen = [i for i, sea in enumerate(study.seas) if sea.wave_heading_deg == heading]
    for values in study.difference[level, chosen].T:
        known = values[~np.isnan(values)]
        yield float(known[np.argmax(np.abs(known))]) if len(known) else np.nan


def _with_band(rms: FloatArray, band: FloatArray) -> Iterator[str]:
    for value, share in zip(rms, band, strict=True):
        told = "–" if np.isnan(value) else f"{value:.4g}"
        yield told if np.isnan(share) else f"{told} ± {share * value:.2g}"


def _per_cent(value: float) -> str:
    return "–" if np.isnan(value) else f"{100.0 * value:+.2g}"
