"""Going on with a run: what a history keeps for it, and whether it belongs to the run that is to go on."""

import hashlib
import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from panelsim.errors import PanelsimError
from panelsim.motion.history import History
from panelsim.motion.march import Record
from panelsim.motion.requirements import about_member
from panelsim.motion.stepper import State

RESTART_FORMAT = 1
# Parts of an identity that are digests: their letters say nothing to a reader.
DIGESTS = ("ship", "sea", "set of supplementary terms", "set of coefficients")
GOES_ON = ("finished", "interrupted")  # outcomes


def digest(*arrays: NDArray[Any]) -> str:
    """Short name of the bits of arrays: other bits, another name."""
    found = hashlib.sha256()
    for array in arrays:
        found.update(repr(np.shape(array)).encode())
        found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()[:16]


def restart_group(state: State, member: int, identity: str) -> xr.Dataset:
    """What the history of a member keeps beside its rows: the rest of the last state, and what run it is, as
    JSON."""
    return xr.Dataset(
        {
            "motion": ("motion_state", state.motion[member].copy(), {"units": "SI"}),
            "past": ("past_state", state.past[member].copy(), {"units": "SI"}),
        },
        attrs={"restart_format": RESTART_FORMAT, "identity": identity},
    )


def resumed(histories: Sequence[History], identities: Sequence[dict[str, Any]], record: Record) -> State:
    """The state of a batch that goes on where its histories ended; the record gets their rows.

    Raises PanelsimError, with the number of the member, for a history that ended for good, holds no
    state, is longer than the run, or is of another run; and for histories of unequal length.
    """
    count = len(histories)
    for i, (history, identity) in enumerate(zip(histories, identities, strict=True)):
        with about_member(i, count):
            _require_same(history, identity, most=record.size)
            if len(history.time) != len(histories[0].time):
                raise PanelsimError(
                    "The histories to go on from are of unequal length",
                    got=f"{history.time[-1]:g} s, the first {histories[0].time[-1]:g} s",
                    allowed="runs of one batch, cut at one time",
                )
    signals = [[h.displacement, h.velocity, h.acceleration] for h in histories]
    loads = [np.stack([h.loads[name] for name in record.load_names], axis=1) for h in histories]
    record.fill(
        [np.stack(columns, axis=1) for columns in zip(*signals, strict=True)], np.stack(loads, axis=1)
    )
    groups = [history.tree.children["restart"].dataset for history in histories]
    return State(
        step=len(histories[0].time) - 1,
        motion=np.stack([group["motion"].values for group in groups]),
        past=np.stack([group["past"].values for group in groups]),
        acceleration=np.stack([history.acceleration[-1] for history in histories]),
        loads=np.stack([[h.loads[name][-1] for name in record.load_names] for h in histories]),
    )


def _require_same(history: History, identity: dict[str, Any], most: int) -> None:
    """Raise PanelsimError unless the history is the beginning of the run with this identity."""
    if history.outcome not in GOES_ON:
        raise PanelsimError(
            "The run to go on from ended for good",
            got=f"{history.outcome}: {history.attrs['outcome_detail']}",
            allowed="a run that is finished or interrupted",
            remedy="run the case from its start",
        )
    group = history.tree.children.get("restart")
    if group is None or group.attrs.get("restart_format") != RESTART_FORMAT:
        raise PanelsimError(
            "The history holds no state to go on from",
            got="none" if group is None else f"one of format {group.attrs.get('restart_format')}",
            allowed=f"format {RESTART_FORMAT}",
            remedy="run the case from its start",
        )
    theirs = json.loads(group.attrs["identity"])
    for name, mine in identity.items():
        if theirs.get(name) != mine:
            raise PanelsimError(
                f"The history to go on from is of another run: its {name} is another",
                got=None if name in DIGESTS else theirs.get(name),
                allowed=None if name in DIGESTS else mine,
                remedy="go on with the same ship, sea and settings, and a longer duration",
            )
    if len(history.time) > most:
        raise PanelsimError(
            "The history to go on from is longer than the run",
            got=f"{history.time[-1]:g} s with its ramp",
            allowed=f"at most {(most - 1) * history.attrs['time_step']:g} s",
            remedy="give a longer duration",
        )
