"""The page of a convergence study, with its figures, its table and its recording, from stored runs."""

from pathlib import Path

import numpy as np

from panelsim.conventions import RULES
from panelsim.files import write_whole
from panelsim.motion.requirements import LONGEST_STEP
from panelsim.results.rms_study import MINOR, RmsStudy
from panelsim.results.rms_tables import difference_markdown, rms_csv, rms_markdown
from panelsim.results.verdicts import IDENTICAL, words, worst_difference
from panelsim.studies.convergence import Convergence, recommended
from panelsim.studies.run_store import RunStore, StoredRun
from panelsim.studies.study_page import (
    PAGE,
    RECORDING,
    failures_markdown,
    setup_markdown,
    write_page,
)
from panelsim.view.rms_pictures import rms_over_levels
from panelsim.view.study_recording import record_study

TABLE = "rms.csv"


def write_convergence(study: Convergence, store: RunStore, folder: Path) -> tuple[str, ...]:
    """Write report.md, rms.csv, a picture a scheme and study.rrd into the folder; runs nothing.

    Returns the names of the files. Raises PanelsimError where a run is not stored.
    """
    found = {scheme: study.study(store, scheme) for scheme in study.schemes}
    pictures = {scheme: _picture_name(scheme) for scheme in study.schemes}
    if (folder / PAGE).is_file():  # of other schemes, whose page this one takes the place of
        for scheme in (*LONGEST_STEP, *RULES):
            (folder / _picture_name(scheme)).unlink(missing_ok=True)
    for scheme, rms in found.items():
        if rms_over_levels(rms, folder / pictures[scheme]) is None:
            del pictures[scheme]
    write_whole(folder / TABLE, _csv(found).encode())
    parts = [_question(study), "## Set-up", _setup(study), "## Result", convergence_in_words(study, found)]
    for scheme, rms in found.items():
        parts += [f"### {scheme}", difference_markdown(rms), study.order(rms, scheme).told]
        if scheme in pictures:
            parts.append(f"![{rms.title}: differences from the reference]({pictures[scheme]})")
        parts.append(rms_markdown(rms))
    parts += ["## Runs", failures_markdown(failed_runs(study, found))]
    record_study(
        folder / RECORDING,
        list(found.values()),
        title=f"{study.title}: {study.case.name}",
        text=convergence_in_words(study, found),
        series=_series(study, store),
    )
    write_page(folder, f"{study.title}: {study.case.name}", parts)
    return PAGE, TABLE, *pictures.values(), RECORDING


def convergence_in_words(study: Convergence, found: dict[str, RmsStudy]) -> str:
    """A line a scheme: how far its levels are from the reference, and which is recommended."""
    lines = []
    for scheme, rms in found.items():
        coarsest = recommended(rms)
        advice = "none of them is" if coarsest is None else f"{coarsest:.4g} {study.unit} and finer are"
        each = "; ".join(f"{rms.levels[level]} {_called(rms, level)}" for level in range(len(study.values)))
        lines.append(f"- **{scheme}**: {advice} within {100.0 * IDENTICAL:g} % of the reference. {each}.")
    return "\n".join(lines)


def failed_runs(study: Convergence, found: dict[str, RmsStudy]) -> list[str]:
    """A line for each run that did not go to its end, with its scheme."""
    lines = [
        line if line.startswith(study.reference_label) else f"{scheme}, {line}"
        for scheme, rms in found.items()
        for line in rms.failures
    ]
    return list(dict.fromkeys(" ".join(line.split()) for line in lines))


def _called(rms: RmsStudy, level: int) -> str:
    """What the worst difference of a level is called."""
    amount = worst_difference(rms, level).amount
    return "cannot be compared" if np.isnan(amount) else f"({100.0 * amount:+.2g} %) {words(amount)}"


def _question(study: Convergence) -> str:
    what = "How long may the time step be" if study.unit == "s" else "How large may the panels be"
    return (
        f"{what} for the RMS of the motions of this case? Every run has the same waves, so that the"
        " differences are none of sampling. Modes with less than"
        f" {100.0 * MINOR:g} % of the largest rotation or translation are left out."
    )


def _setup(study: Convergence) -> str:
    run = study.case.file.run
    model = f"{run.model}, inertia {run.inertia}" if run.inertia else run.model
    same = {"pressure rule": run.pressure_rule} if study.unit == "s" else _stepping(study)
    varied = ", ".join(f"{value:.4g}" for value in study.values)
    seeds = range(study.case.file.seaway.seed, study.case.file.seaway.seed + study.seeds)
    facts = {
        "model": model,
        **same,
        study.varied: varied,
        "reference": study.reference_label,
        "realizations": f"{study.seeds}, seeds {', '.join(map(str, seeds))}" if study.seeds > 1 else "1",
    }
    return setup_markdown(study.case, facts)


def _stepping(study: Convergence) -> dict[str, str]:
    run = study.case.file.run
    return {"time step": f"{run.time_step:g} s, {run.stepper}"}


def _csv(found: dict[str, RmsStudy]) -> str:
    """The tables of all schemes under one head, with the scheme in front."""
    tables = {scheme: rms_csv(rms).splitlines() for scheme, rms in found.items()}
    head = next(iter(tables.values()))[0]
    rows = [f"{scheme},{row}" for scheme, (_, *lines) in tables.items() for row in lines]
    return "\n".join([f"scheme,{head}", *rows]) + "\n"


def _series(study: Convergence, store: RunStore) -> dict[str, StoredRun]:
    """Motions of the first realization of every level that has any."""
    levels = [(scheme, level) for scheme in study.schemes for level in range(len(study.values))]
    cases = {
        f"{scheme}, {study.values[level]:.4g} {study.unit}": study.case_of(scheme, level, 0)
        for scheme, level in levels
    }
    cases[study.reference_label] = study.case_of(study.schemes[0], len(study.values), 0)
    return {name: store.load(case) for name, case in cases.items() if store.failure(case) is None}


def _picture_name(scheme: str) -> str:
    return f"difference-{scheme.replace('+', '-')}.png"
