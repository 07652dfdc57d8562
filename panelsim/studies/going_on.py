"""The run in an output folder that a case may go on with."""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.motion.history import History

HISTORY = "history.nc"
# All else must be as it was; `simulate` sees to it that files which the case names are too.
_MAY_DIFFER = "run.duration"
_NONE = "not given"
_REMEDY = "choose the folder of this case with --out, or leave out --resume to run it from its start"


def begun_run(case: Case, folder: Path) -> History:
    """The history in a folder, if it is that of the beginning of this case.

    Raises PanelsimError where there is none, with the keys that are others than in the case, and where it is
    longer than the case.
    """
    file = folder / HISTORY
    if not file.is_file():
        raise PanelsimError(
            "There is no run to go on with in the output folder",
            got=f"{folder} without {HISTORY}",
            remedy=_REMEDY,
        )
    history = History.load(file)
    theirs, ours = json.loads(history.attrs["case"]), json.loads(json.dumps(case.resolved()))
    differences = list(_differences(theirs, ours))
    if differences:
        raise PanelsimError(
            "The run in the output folder is of another case", got="; ".join(differences), remedy=_REMEDY
        )
    run = case.file.run
    if len(history.time) > run.steps + 1:
        raise PanelsimError(
            "The run in the output folder is longer than the case",
            got=f"{history.time[-1] - run.ramp:g} s after the ramp",
            allowed=f"at most run.duration = {run.duration:g} s",
            remedy="give a longer run.duration, or leave out --resume to run the case from its start",
        )
    return history


def _differences(theirs: Mapping[str, Any], ours: Mapping[str, Any], table: str = "") -> Iterator[str]:
    """Keys with other values, as "seaway.seed 7 there, 8 here"."""
    for key in sorted(theirs.keys() | ours.keys()):
        name = f"{table}{key}"
        there, here = theirs.get(key, _NONE), ours.get(key, _NONE)
        if isinstance(there, dict) and isinstance(here, dict):
            yield from _differences(there, here, f"{name}.")
        elif there != here and name != _MAY_DIFFER:
            yield f"{name} {there} there, {here} here"
