"""The tables of a study of RMS: every run as CSV, and what they amount to as Markdown."""

import csv
import io
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from panelsim.conventions import CONFIDENCE, DOF_NAMES, FloatArray
from panelsim.results.difference_band import difference_band
from panelsim.results.rms_study import RmsStudy
from panelsim.results.statistics import display_unit
from panelsim.results.verdicts import from_heading, per_cent, words, worst_difference

SEA_COLUMNS = ("sea", "wave_heading [deg]", "significant_wave_height [m]", "peak_period [s]")


def rms_csv(study: RmsStudy) -> str:
    """CSV text with a row a level, sea and realization: RMS in m and degrees, empty where a run failed.

    Where there are several realizations a row "all" follows them: the RMS of all together, with the half
    width of its confidence band. What is varied has a column where it has a unit, as a model has not.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    units = [display_unit(name)[0] for name in DOF_NAMES]
    heads = [
        f"{name}_rms{of} [{unit}]"
        for of in ("", "_band")
        for name, unit in zip(DOF_NAMES, units, strict=True)
    ]
    varied = [study.varied] if study.varied.endswith("]") else []
    writer.writerow(["level", *varied, *SEA_COLUMNS, "realization", *heads])
    shown, pooled = display_rms(study.rms), display_rms(study.pooled)
    band = study.band * pooled
    for level, sea in np.ndindex(pooled.shape[:2]):
        met = study.seas[sea]
        of_sea = (met.label, met.wave_heading_deg, met.significant_wave_height, met.peak_period)
        value = [repr(float(study.values[level]))] if varied else []
        of_row = (study.levels[level], *value, *of_sea)
        for realization, values in enumerate(shown[level, sea], start=1):
            writer.writerow([*of_row, realization, *_csv_cells(values), *[""] * 6])
        if shown.shape[2] > 1:
            writer.writerow([*of_row, "all", *_csv_cells(pooled[level, sea]), *_csv_cells(band[level, sea])])
    return text.getvalue()


def _csv_cells(values: FloatArray) -> Iterator[str]:
    return ("" if np.isnan(value) else repr(float(value)) for value in values)


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

    In per cent of the reference, signed, by mode, with the band of the difference if it is known; then the
    worst of all with its sea, and what that is called. A dash stands for a mode that is minor in all of the
    seas.
    """
    headings = list(dict.fromkeys(sea.wave_heading_deg for sea in study.seas))
    rows = []
    for level in range(len(study.levels)):
        for heading in headings if level != study.reference else ():
            worst = worst_difference(study, level, from_heading(study, heading))
            cells = [per_cent(value, half) for value, half in _largest(study, level, heading)]
            rows.append([study.levels[level], f"{heading:g}", *cells, worst.told, words(worst.amount)])
    heads = ["level", "wave heading [deg]", *(f"{name} [%]" for name in DOF_NAMES), "worst", "this is"]
    note = "" if study.rms.shape[2] < 2 else f" ±: {100.0 * CONFIDENCE:g} % band of the paired difference."
    return markdown_table(heads, rows, text_columns=1) + f"\nAgainst {study.levels[study.reference]}.{note}\n"


def markdown_table(heads: Sequence[str], rows: Iterable[Sequence[str]], *, text_columns: int) -> str:
    """A Markdown table; columns after the first `text_columns` are set to the right."""
    rule = ["---"] * text_columns + ["---:"] * (len(heads) - text_columns)
    return "".join(f"| {' | '.join(line)} |\n" for line in [heads, rule, *rows])


def display_rms(rms: FloatArray) -> FloatArray:
    """RMS (…, 6) [m, rad] in the units that people read, m and degrees."""
    return np.asarray(rms * np.array([display_unit(name)[1] for name in DOF_NAMES]))


def _largest(study: RmsStudy, level: int, heading: float) -> Iterator[tuple[float, float]]:
    """Of each mode the largest difference in the seas from a heading, and its band; NaN where none counts."""
    chosen = [i for i, sea in enumerate(study.seas) if sea.wave_heading_deg == heading]
    bands = difference_band(study)[level, chosen]
    for values, halves in zip(study.difference[level, chosen].T, bands.T, strict=True):
        at = int(np.argmax(np.where(np.isnan(values), -1.0, np.abs(values))))
        yield float(values[at]), float(halves[at])


def _with_band(rms: FloatArray, band: FloatArray) -> Iterator[str]:
    for value, share in zip(rms, band, strict=True):
        told = "–" if np.isnan(value) else f"{value:.4g}"
        yield told if np.isnan(share) else f"{told} ± {share * value:.2g}"
