"""Why the nonlinear model moves otherwise than the linear one: at which frequencies, and by which loads."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.conventions import DOF_NAMES, Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import read_json_table, write_whole
from panelsim.results.rms_tables import markdown_table
from panelsim.studies.run_store import RunStore, run_key
from panelsim.studies.tm2003_190.load_parts import PARTS, LoadParts, load_parts
from panelsim.studies.tm2003_190.wave_frequencies import at_wave_frequencies

# The motions that come back slowly, which in bow quartering seas waves hardly excite at the own frequency.
SLOW = (Dof.SURGE, Dof.SWAY, Dof.ROLL, Dof.YAW)


@dataclass(frozen=True)
class Pair:
    """A linear and a nonlinear case in the same waves, and what their sea is called."""

    sea: str
    linear: Case
    nonlinear: Case

    def finished(self, store: RunStore) -> bool:
        """Whether both runs are there to their end."""
        cases = (self.linear, self.nonlinear)
        return all(
            case in store and store.failure(case) is None and store.load(case).early_end is None
            for case in cases
        )


@dataclass(frozen=True)
class Frequencies:
    """For each of some seas: share of the variance of the nonlinear run that is not at the waves' frequencies
    (S, 6), and RMS at them of the nonlinear run over that of the linear one, less 1, (S, 6).
    """

    seas: tuple[str, ...]
    elsewhere: FloatArray
    change: FloatArray


def frequencies_of(pairs: Sequence[Pair], store: RunStore) -> Frequencies:
    """Read the pairs of runs that are there to their end."""
    elsewhere, change, names = [], [], []
    for pair in pairs:
        if not pair.finished(store):
            continue
        linear, nonlinear = (_at_waves(case, store) for case in (pair.linear, pair.nonlinear))
        elsewhere.append(1.0 - (nonlinear / store.load(pair.nonlinear).rms) ** 2)
        change.append(nonlinear / linear - 1.0)
        names.append(pair.sea)
    return Frequencies(tuple(names), np.reshape(elsewhere, (-1, 6)), np.reshape(change, (-1, 6)))


def _at_waves(case: Case, store: RunStore) -> FloatArray:
    # Not that of the ship itself: to build her takes longer than all the rest.
    gravity = case.file.ship.gravity
    return at_wave_frequencies(store.load(case), case.seaway.components, case.speed, gravity)


def frequencies_markdown(found: Frequencies) -> str:
    """A table with a row a sea: the share elsewhere, and the change at the frequencies of the waves."""
    rows = [
        [
            sea,
            *(
                f"{100 * share:.0f}, {100 * change:+.0f}"
                for share, change in zip(shares, changes, strict=True)
            ),
        ]
        for sea, shares, changes in zip(found.seas, found.elsewhere, found.change, strict=True)
    ]
    return markdown_table(["sea", *(f"{name} [%]" for name in DOF_NAMES)], rows, text_columns=1)


def parts_path(pair: Pair, store: RunStore) -> Path:
    """Where the parts of the load of a pair are kept."""
    return store.folder / f"{run_key(pair.nonlinear)}.parts.json"


def store_parts(pair: Pair, store: RunStore) -> None:
    """Take the loads of a pair apart, and keep what is found; nothing where a run did not finish."""
    if not pair.finished(store):
        return
    found = load_parts(pair.nonlinear, pair.linear, store)
    told = {"shares": found.shares.tolist(), "missed": found.missed.tolist()}
    write_whole(parts_path(pair, store), json.dumps(told).encode())


def stored_parts(pairs: Sequence[Pair], store: RunStore) -> dict[str, LoadParts]:
    """The parts that are kept, by sea."""
    found = {}
    for pair in pairs:
        path = parts_path(pair, store)
        if path.is_file():
            found[pair.sea] = _read_parts(path)
    return found


def _read_parts(path: Path) -> LoadParts:
    what, remedy = "The file of the parts of a load", "remove it, and start the command again"
    told = read_json_table(path, what, remedy)
    try:
        shares, missed = (np.array(told[name], dtype=np.float64) for name in ("shares", "missed"))
    except (KeyError, TypeError, ValueError) as error:
        raise PanelsimError(f"{what} is damaged", got=path, remedy=remedy) from error
    if (shares.shape, missed.shape) != ((len(PARTS), 6), (6,)):
        raise PanelsimError(f"{what} is damaged", got=path, remedy=remedy)
    return LoadParts(shares, missed)


def parts_markdown(found: Mapping[str, LoadParts]) -> str:
    """A table with a row a sea and part, in per cent of the variance of the difference."""
    rows = []
    for sea, parts in found.items():
        for name, shares in zip(PARTS, parts.shares, strict=True):
            rows.append([sea, name, *(f"{100 * share:+.0f}" for share in shares)])
        rows.append([sea, "not explained (RMS)", *(f"{100 * share:.0f}" for share in parts.missed)])
    return markdown_table(["sea", "load", *(f"{name} [%]" for name in DOF_NAMES)], rows, text_columns=2)


def cause_in_words(frequencies: Frequencies, parts: Mapping[str, LoadParts]) -> str:
    """What the tables say of surge, sway, roll and yaw in the seas of the frequencies."""
    if not frequencies.seas:
        return ""
    share, change = frequencies.elsewhere[:, SLOW].mean(), np.median(np.abs(frequencies.change[:, SLOW]))
    told = (
        f"of surge, sway, roll and yaw in bow quartering seas {100 * share:.0f} % of the variance on average"
        " is at differences and sums of the waves' frequencies, while at those frequencies themselves the"
        f" models differ by {100 * change:.0f} % (median)"
    )
    return "; ".join([told, *(_largest_load(sea, one) for sea, one in parts.items())])


def _largest_load(sea: str, parts: LoadParts) -> str:
    """Which load has the largest share in the difference of these four motions."""
    share = parts.shares[:, SLOW].mean(axis=1)
    return f"the largest load is that of {PARTS[int(np.argmax(share))]} ({100 * share.max():.0f} %) at {sea}"
