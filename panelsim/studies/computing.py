"""Runs of a study, made one after another; those that are stored already are not made again."""

from collections.abc import Callable, Sequence

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.studies.case_history import history_of_text
from panelsim.studies.run_store import RunStore, kept_bytes, run_identity, run_key

Progress = Callable[[float, float], None]  # runs done, runs in all


def compute_runs(
    cases: Sequence[Case],
    store: RunStore,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    group: int = 1,
    progress: Progress | None = None,
) -> None:
    """Make the runs that are not in the store yet, and keep each as soon as it is made.

    A case that cannot be run leaves its message in the store, and the others go on.
    """
    missing = list({run_key(case): case for case in cases if case not in store}.values())
    for done, case in enumerate(missing):
        if progress is not None:
            progress(done, len(missing))
        try:
            history = history_of_text(case.file.model_dump_json(exclude_none=True), case.folder, case.name)
            store.save(case, kept_bytes(history, run_identity(case)))
        except PanelsimError as error:
            store.save_failure(case, str(error))
    if progress is not None:
        progress(len(missing), len(missing))
