"""Runs of studies on disk, found again by what was run.

A study makes hundreds of runs; what is kept of each is the motions and the wave, not the loads. The file is
NetCDF, named by a digest of the case and of the files that it names; inside stands the case itself, so that
a run of another case or version is not taken for this one.
"""

import hashlib
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.metadata import version
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import h5py
import numpy as np

from panelsim.case import Case
from panelsim.case.ship_section import beside, ship_files
from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import as_path, read_json_table, write_whole
from panelsim.motion.history import History

panelsim_version = cache(lambda: version("panelsim"))  # to look it up takes as long as to read a run
NEEDED = ("outcome", "outcome_detail", "ramp", "time_step", "cpu_seconds", "rms")
_OF_RUN = ("identity", "panelsim_version")
KEPT = ("displacement", "wave_elevation")
RUN_FILE = re.compile(r"[0-9a-f]{20}\.(nc|failed\.json)")  # how the files of a store are called
_identities: WeakKeyDictionary[Case, str] = WeakKeyDictionary()
_AGAIN = "remove the file and run again"
_ANOTHER = "choose another folder for the runs, or remove those that are in it"


@dataclass(frozen=True, eq=False)
class StoredRun:
    """Motions of a run: `time` (T,) [s], `displacement` (T, 6) [m, rad], `wave_elevation` (T,) [m].

    `attrs` are those of the history.
    """

    time: FloatArray
    displacement: FloatArray
    wave_elevation: FloatArray
    attrs: dict[str, Any]

    @property
    def fault(self) -> str | None:
        """What is wrong with the run as it was read; None where it is whole."""
        rows = len(self.time)
        # A run that ends in its first step has one row.
        if rows < 1 or self.displacement.shape != (rows, 6) or self.wave_elevation.shape != (rows,):
            return "motions of another length than the time"
        # A diverged run may end in what is no number.
        motions = self.displacement[self.after_ramp]
        if self.outcome == "finished" and not (len(motions) and np.isfinite(motions).all()):
            return "motions that are no finite numbers"
        return None

    @property
    def outcome(self) -> str:
        """How the run ended: finished, capsized, diverged or interrupted."""
        return str(self.attrs["outcome"])

    @property
    def early_end(self) -> str | None:
        """Why the run ended before its time; None where it finished."""
        return _early_end(self.attrs)

    @cached_property
    def after_ramp(self) -> slice:
        """Rows from the end of the ramp on: half a step of room, as in `statistics`."""
        first = np.searchsorted(self.time, self.attrs["ramp"] - 0.5 * self.attrs["time_step"])
        return slice(int(first), None)

    @property
    def rms(self) -> FloatArray:
        """RMS of the motions about their means (6,) [m, rad] after the ramp; NaN if it did not finish."""
        if self.outcome != "finished":
            return np.full(6, np.nan)
        return np.asarray(self.displacement[self.after_ramp].std(axis=0))


class RunStore:
    """A folder of runs.

    `told` is what is `NEEDED` of the runs that have been read, by their keys.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = as_path(folder)
        self.told: dict[str, dict[str, Any]] = {}
        self._lost: dict[str, str] = {}

    def __contains__(self, case: Case) -> bool:
        """Whether the run, or why it failed, is known."""
        return self.path(case).is_file() or self._failure_path(case).is_file()

    def path(self, case: Case) -> Path:
        """Where the run of a case is, or would be."""
        return self.folder / f"{run_key(case)}.nc"

    def _failure_path(self, case: Case) -> Path:
        return self.folder / f"{run_key(case)}.failed.json"

    def save(self, case: Case, content: bytes) -> None:
        """Keep a run as `kept_bytes` made it, whole or not at all."""
        write_whole(self.path(case), content)
        self.told.pop(run_key(case), None)

    def save_failure(self, case: Case, message: str) -> None:
        """Keep why a case could not be run."""
        told = {"identity": run_identity(case), "panelsim_version": panelsim_version(), "message": message}
        write_whole(self._failure_path(case), json.dumps(told, ensure_ascii=False).encode())

    def note_lost(self, case: Case, message: str) -> None:
        """Tell why a run was lost by no fault of the case: not kept on disk, so that it is tried again."""
        self._lost[run_key(case)] = message

    def failure(self, case: Case) -> str | None:
        """Why a case could not be run, or was lost in this process; None where it was run."""
        path = self._failure_path(case)
        if not path.is_file():
            return None if self.path(case).is_file() else self._lost.get(run_key(case))
        told = read_json_table(path, "The note of a run that failed", _AGAIN)
        _require_same(path, told, case)
        return str(told.get("message", "the note does not say why"))

    def rms(self, case: Case) -> tuple[FloatArray, str | None]:
        """`StoredRun.rms` and `early_end` of a case, as they were stored: the motions are not read.

        Studies that share runs read them once. Raises PanelsimError as `load` does, but for damaged motions.
        """
        key = run_key(case)
        if key not in self.told:
            with self._opened(case, (*NEEDED, *_OF_RUN)):
                pass
        return np.asarray(self.told[key]["rms"]), _early_end(self.told[key])

    def load(self, case: Case) -> StoredRun:
        """The run of a case.

        Raises PanelsimError where there is none, where it is damaged, or of another case or version.
        """
        with self._opened(case) as (file, attrs):
            time, displacement, elevation = (file[name][:] for name in ("time", *KEPT))
        run = StoredRun(time, displacement, elevation, attrs)
        if run.fault is not None:
            raise _damaged(self.path(case), run.fault)
        return run

    @contextmanager
    def _opened(
        self, case: Case, attributes: Sequence[str] | None = None
    ) -> Iterator[tuple[h5py.File, dict[str, Any]]]:
        """The file of a run that was found to be of this case, and some of its attributes or all."""
        path = self.path(case)
        if not path.is_file():
            raise PanelsimError(
                "A run of the study is not stored", got=path, remedy="run the study, it goes on where it was"
            )
        try:
            with h5py.File(path) as file:
                stored = file.attrs
                names = attributes or list(stored)
                attrs = {name: _plain(stored[name]) for name in names if name in stored}
                _require_told(path, attrs, _OF_RUN)
                _require_same(path, attrs, case)
                _require_told(path, attrs, NEEDED)
                _require_rms(path, attrs)
                self.told[run_key(case)] = {name: attrs[name] for name in NEEDED}
                yield file, attrs
        except (OSError, KeyError, RuntimeError) as error:
            raise _damaged(path, error) from error


def run_identity(case: Case) -> str:
    """What a run depends on, as JSON: the case, and digests of the files that it reads.

    It is taken once for each case, so that a study finds its runs under the names that it gave them.
    """
    if case not in _identities:
        described = {
            "case": case.file.model_dump(mode="json", exclude_none=True),
            "files": file_digests(case),
        }
        _identities[case] = json.dumps(described, sort_keys=True, ensure_ascii=False)
    return _identities[case]


def run_key(case: Case) -> str:
    """A short name for a run, from what it depends on."""
    return hashlib.sha256(run_identity(case).encode()).hexdigest()[:20]


def kept_bytes(history: History, identity: str) -> bytes:
    """The NetCDF file of a run: motions, wave and attributes of its history, its `run_identity` and RMS.

    With checksums. Not compressed: that saves an eighth of the size, and takes thrice the time to read.
    """
    run = StoredRun(history.time, history.displacement, history.wave_elevation, history.attrs)
    dataset = history.dataset[list(KEPT)].assign_attrs(history.attrs | {"identity": identity, "rms": run.rms})
    encoding = {name: {"fletcher32": True} for name in ("time", *KEPT)}
    return bytes(dataset.to_netcdf(engine="h5netcdf", encoding=encoding))


def file_digests(case: Case) -> dict[str, str]:
    """Digests of the files that a run of the case reads, by the names in the case that lead to them.

    What lies beside them makes no other run: not a folder that is called as a bundled hull, nor other files
    in the folder of a hull.
    """
    file = case.file
    named = [file.hydrodynamics.file, file.seaway.file, *(file.seaway.files or ())]
    paths = {name: Path(beside(case.folder, name)) for name in named if name is not None}
    read: dict[str, tuple[Path, ...]] = {
        name: (path,) if path.is_file() else () for name, path in paths.items()
    }
    read[file.ship.hull] = ship_files(file.ship, case.folder)
    return {name: _digest(files) for name, files in read.items() if files}


def _digest(files: Sequence[Path]) -> str:
    digest = hashlib.sha256()
    for file in files:
        digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()


def _require_same(path: Path, told: dict[str, Any], case: Case) -> None:
    """Raise PanelsimError for a file of another version or case."""
    if told.get("panelsim_version") != panelsim_version():
        raise PanelsimError(
            "A stored run is of another version of panelsim",
            got=f"{path}: {told.get('panelsim_version', 'not told')}",
            allowed=panelsim_version(),
            remedy=_ANOTHER,
        )
    if told.get("identity") != run_identity(case):
        raise PanelsimError("A stored run is of another case", got=path, remedy=_ANOTHER)


def _early_end(attrs: Mapping[str, Any]) -> str | None:
    return None if attrs["outcome"] == "finished" else f"{attrs['outcome']}: {attrs['outcome_detail']}"


def _require_told(path: Path, attrs: Mapping[str, Any], names: Sequence[str]) -> None:
    missing = [name for name in names if name not in attrs]
    if missing:
        raise _damaged(path, f"without {', '.join(missing)}")


def _require_rms(path: Path, attrs: Mapping[str, Any]) -> None:
    """Raise PanelsimError where the RMS are not six figures; a run that ended early has none."""
    rms = np.asarray(attrs["rms"])
    if (
        rms.shape != (6,)
        or rms.dtype.kind != "f"
        or (attrs["outcome"] == "finished" and not np.isfinite(rms).all())
    ):
        raise _damaged(path, "RMS that are no six figures")


def _damaged(path: Path, fault: object) -> PanelsimError:
    return PanelsimError("A stored run is damaged", got=f"{path} ({fault})", remedy=_AGAIN)


def _plain(value: Any) -> Any:
    """An attribute as Python has it; numbers come as arrays of one."""
    if not isinstance(value, np.generic | np.ndarray):
        return value
    return value.item() if value.size == 1 else value.tolist()
