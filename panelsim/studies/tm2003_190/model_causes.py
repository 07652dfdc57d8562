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
# A load makes most of a difference if what it alone misses has half of the RMS, a quarter of the variance.
ALONE = 0.5
# Parts cancel where one of them is clearly larger than the difference; near 1 it turns with the realization.
CANCELS = 1.2


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
            case in store and store.failure(case) is None and store.rms(case)[1] is None for case in cases
        )


@dataclass(frozen=True)
class Frequencies:
    """For each of some seas: share of the variance of the nonlinear run that is not at the waves' frequencies
    (S, 6), the same of the linear run as `control`, and RMS at them of the nonlinear run over that of the
    linear one, less 1, (S, 6).
    """

    seas: tuple[str, ...]
    elsewhere: FloatArray
    control: FloatArray
    change: FloatArray


def frequencies_of(pairs: Sequence[Pair], store: RunStore) -> Frequencies:
    """Read the pairs of runs that are there to their end."""
    elsewhere, control, change, names = [], [], [], []
    for pair in pairs:
        if not pair.finished(store):
            continue
        cases = (pair.linear, pair.nonlinear)
        linear, nonlinear = (_at_waves(case, store) for case in cases)
        of_linear, of_nonlinear = (store.rms(case)[0] for case in cases)
        elsewhere.append(1.0 - (nonlinear / of_nonlinear) ** 2)
        control.append(1.0 - (linear / of_linear) ** 2)
        change.append(nonlinear / linear - 1.0)
        names.append(pair.sea)
    return Frequencies(tuple(names), *(np.reshape(one, (-1, 6)) for one in (elsewhere, control, change)))


def _at_waves(case: Case, store: RunStore) -> FloatArray:
    # Not that of the ship itself: to build her takes longer than all the rest.
    gravity = case.file.ship.gravity
    return at_wave_frequencies(store.load(case), case.seaway.components, case.speed, gravity)


def frequencies_markdown(found: Frequencies) -> str:
    """A table with a row a sea: the share elsewhere, (that of the linear run), the change at the waves'."""
    rows = [
        [
            sea,
            *(
                f"{100 * share:.0f} ({100 * linear:.0f}), {100 * change:+.0f}"
                for share, linear, change in zip(shares, controls, changes, strict=True)
            ),
        ]
        for sea, shares, controls, changes in zip(
            found.seas, found.elsewhere, found.control, found.change, strict=True
        )
    ]
    return markdown_table(["sea", *(f"{name} [%]" for name in DOF_NAMES)], rows, text_columns=1)


def parts_path(pair: Pair, store: RunStore) -> Path:
    """Where the parts of the load of a pair are kept."""
    return store.folder / f"{run_key(pair.nonlinear)}.load_parts.json"


def store_parts(pair: Pair, store: RunStore) -> None:
    """Take the loads of a pair apart, and keep what is found; nothing where a run did not finish."""
    if not pair.finished(store):
        return
    found = load_parts(pair.nonlinear, pair.linear, store)
    told = {name: value.tolist() for name, value in vars(found).items()}
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
        found = LoadParts(*(np.array(told[name], dtype=np.float64) for name in ("rms", "shares", "missed")))
    except (KeyError, TypeError, ValueError) as error:
        raise PanelsimError(f"{what} is damaged", got=path, remedy=remedy) from error
    if (found.rms.shape, found.shares.shape, found.missed.shape) != (*2 * ((len(PARTS), 6),), (6,)):
        raise PanelsimError(f"{what} is damaged", got=path, remedy=remedy)
    return found


def parts_markdown(found: Mapping[str, LoadParts]) -> str:
    """A table with a row a sea and part: RMS of its answer over that of the difference, and its share."""
    rows = []
    for sea, parts in found.items():
        for name, sizes, shares in zip(PARTS, parts.rms, parts.shares, strict=True):
            cells = (
                f"{100 * size:.0f}, {100 * share:+.0f}" for size, share in zip(sizes, shares, strict=True)
            )
            rows.append([sea, name, *cells])
        rows.append([sea, "explained by none (RMS)", *(f"{100 * share:.0f}" for share in parts.missed)])
    return markdown_table(["sea", "load", *(f"{name} [%]" for name in DOF_NAMES)], rows, text_columns=2)


def cause_in_words(frequencies: Frequencies, parts: Mapping[str, LoadParts]) -> str:
    """What the tables say of surge, sway, roll and yaw in the seas of the frequencies."""
    if not frequencies.seas:
        return ""
    share, control = (100 * of[:, SLOW].mean() for of in (frequencies.elsewhere, frequencies.control))
    change = np.median(np.abs(frequencies.change[:, SLOW]))
    told = (
        f"of surge, sway, roll and yaw in bow quartering seas {share:.0f} % of the variance on average"
        f" ({control:.0f} % in the linear model) is not at the waves' frequencies, while at these the models"
        f" differ by {100 * change:.0f} % (median)"
    )
    return "; ".join([told, *(loads_in_words(sea, one) for sea, one in parts.items())])


def loads_in_words(sea: str, parts: LoadParts) -> str:
    """By which single load each of these motions differs, and which by none; of one sea."""
    by: dict[str, list[str]] = {}
    for mode in SLOW:
        alone = parts.missed_alone[:, mode]
        if alone.min() <= ALONE:
            by.setdefault(PARTS[int(np.argmin(alone))], []).append(DOF_NAMES[mode])
    told = [f"the load of {load} alone makes most of the difference of {_and(of)}" for load, of in by.items()]
    made = {name for of in by.values() for name in of}
    left = [mode for mode in SLOW if DOF_NAMES[mode] not in made]
    if left:
        largest = parts.rms[:, left].max()
        why = "several act together"
        if largest > CANCELS:
            why = f"parts cancel, up to {largest:.2g} times the difference"
        told.append(f"no single load makes that of {_and([DOF_NAMES[mode] for mode in left])}: {why}")
    return f"at {sea} {', '.join(told)}"


def _and(names: Sequence[str]) -> str:
    return " and ".join(part for part in (", ".join(names[:-1]), names[-1]) if part)
