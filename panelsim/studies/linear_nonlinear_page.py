"""The page of a case in both models, with its table and its recording, from stored runs."""

from pathlib import Path

import numpy as np

from panelsim.conventions import CONFIDENCE, DOF_NAMES
from panelsim.files import write_whole
from panelsim.hydro.database import HydroDatabase
from panelsim.results.difference_band import difference_band
from panelsim.results.rms_study import MINOR, RmsStudy
from panelsim.results.rms_tables import display_rms, markdown_table, rms_csv
from panelsim.results.statistics import display_unit
from panelsim.results.verdicts import words, worst_difference
from panelsim.studies.linear_nonlinear import MODELS, LinearNonlinear, frequency_domain
from panelsim.studies.run_store import RunStore
from panelsim.studies.study_page import PAGE, RECORDING, failures_markdown, setup_markdown, write_page
from panelsim.view.model_picture import model_picture
from panelsim.view.study_recording import record_study

TABLE = "rms.csv"
PICTURE = "models.png"


def write_linear_nonlinear(
    study: LinearNonlinear, store: RunStore, database: HydroDatabase, folder: Path
) -> tuple[str, ...]:
    """Write report.md, rms.csv, a picture and study.rrd into the folder; runs nothing.

    Returns the names of the files. Raises PanelsimError where a run is not stored.
    """
    rms = study.study(store)
    write_whole(folder / TABLE, rms_csv(rms).encode())
    (folder / PICTURE).unlink(missing_ok=True)
    drawn = model_picture(rms, difference_band(rms)[1, 0], folder / PICTURE)
    title = f"Linear against nonlinear: {study.case.name}"
    series = {
        model: store.load(case)
        for model, case in zip(MODELS, study.models, strict=True)
        if store.failure(case) is None
    }
    verdict = models_in_words(rms)
    record_study(folder / RECORDING, [rms], title=title, text=verdict, series=series)
    parts = [
        "How much does it matter that pressure acts on the hull as it is wet at each instant? Both models"
        f" have the same waves. Modes with less than {100.0 * MINOR:g} % of the largest rotation or"
        " translation are minor.",
        "## Set-up",
        _setup(study),
        "## Result",
        verdict,
        _table(rms),
        f"![RMS in both models, and their difference]({PICTURE})" if drawn else "",
        "## The linear runs against the frequency domain",
        _against_frequency_domain(study, rms, database),
        "## Runs",
        failures_markdown(rms.failures),
    ]
    write_page(folder, title, parts)
    return PAGE, TABLE, *([PICTURE] if drawn else []), RECORDING


def models_in_words(rms: RmsStudy) -> str:
    """The worst difference of the nonlinear model from the linear one, and what it is called."""
    worst = worst_difference(rms, 1)
    if np.isnan(worst.amount):
        return "The models cannot be compared: a run did not go to its end."
    return f"Nonlinear less linear, the worst mode: {worst.told}: {words(worst.amount)}."


def _setup(study: LinearNonlinear) -> str:
    run = study.case.file.run
    linear, nonlinear = study.models
    inertia = nonlinear.file.run.inertia or "large"
    facts = {
        "time step": f"{run.time_step:g} s, {run.stepper}",
        "models": f"linear; nonlinear with {inertia} inertia and pressure rule {run.pressure_rule}",
        "realizations": f"{study.seeds}, from seed {linear.file.seaway.seed}" if study.seeds > 1 else "1",
    }
    return setup_markdown(study.case, facts)


def _table(rms: RmsStudy) -> str:
    """RMS of each mode in both models, and the difference with its band."""
    linear, nonlinear = display_rms(rms.pooled)[:, 0]
    difference, band = 100.0 * rms.difference[1, 0], 100.0 * difference_band(rms)[1, 0]
    rows = []
    for mode, name in enumerate(DOF_NAMES):
        sure = "" if np.isnan(band[mode]) else f" ± {band[mode]:.2g}"
        known = not np.isnan(rms.pooled[:, 0, mode]).any()
        told = ("minor" if known else "–") if np.isnan(difference[mode]) else f"{difference[mode]:+.2f}{sure}"
        called = "" if np.isnan(difference[mode]) else words(rms.difference[1, 0, mode])
        rows.append(
            [
                f"{name} [{display_unit(name)[0]}]",
                _figure(linear[mode]),
                _figure(nonlinear[mode]),
                told,
                called,
            ]
        )
    heads = ["RMS", *MODELS, "difference [%]", "this is"]
    count = rms.rms.shape[2]
    note = (
        f"\n±: {100.0 * CONFIDENCE:g} % band of the difference, from {count} realizations, paired.\n"
        if count > 1
        else "\nOne realization says nothing of how sure a difference is: give more `--seeds`.\n"
    )
    return markdown_table(heads, rows, text_columns=1) + note


def _against_frequency_domain(study: LinearNonlinear, rms: RmsStudy, database: HydroDatabase) -> str:
    """Linear runs beside the sum of their very components, and beside the spectrum."""
    found = frequency_domain(study, database)
    shown, run = display_rms(found.components), rms.pooled[0, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        off = 100.0 * (run / found.components - 1.0)
    spectrum = np.full(6, np.nan) if found.spectrum is None else display_rms(found.spectrum)
    rows = [
        [
            f"{name} [{display_unit(name)[0]}]",
            _figure(display_rms(run)[mode]),
            _figure(shown[mode]),
            f"{off[mode]:+.2f}" if rms.major[0, mode] and np.isfinite(off[mode]) else "–",
            f"{100.0 * found.sampling_error[mode]:.2f}" if rms.major[0, mode] else "–",
            _figure(spectrum[mode]),
        ]
        for mode, name in enumerate(DOF_NAMES)
    ]
    heads = ["RMS", "linear runs", "their components", "runs off by [%]", "sampling error [%]", "spectrum"]
    return markdown_table(heads, rows, text_columns=1) + (
        "\nThe components of the very runs, summed in the frequency domain, are what long linear runs show."
        " Beyond the sampling error (one standard deviation, by chance of the phases) runs hold the free"
        " motions that their start leaves, of lightly damped roll above all, which a longer ramp lets die."
        " The spectrum is the sea itself, which a few components stand for roughly.\n"
    )


def _figure(value: float) -> str:
    return "–" if np.isnan(value) else f"{value:.4g}"
