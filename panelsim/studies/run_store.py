"""Runs of studies on disk, found again by what was run.

A study makes hundreds of runs; what is kept of each is the motions and the wave, not the loads. The file is
NetCDF, named by a digest of the case and of the files that it names; inside stands the case itself, so that
a run of another case or version is not taken for this one.
"""

import hashlib
import json
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.metadata import version
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from panelsim.case import Case
from panelsim.case.ship_section import beside
from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import as_path, write_whole
from panelsim.motion.history import History

panelsim_version = cache(lambda: version("panelsim"))  # to look it up takes as long as to read a run
KEPT = ("displacement", "wave_elevation")
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
    def outcome(self) -> str:
        """How the run ended: finished, capsized, diverged or interrupted."""
        return str(self.attrs["outcome"])

    @property
    def early_end(self) -> str | None:
        """Why the run ended before its time; None where it finished."""
        return None if self.outcome == "finished" else f"{self.outcome}: {self.attrs['outcome_detail']}"

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
    """A folder of runs."""

    def __init__(self, folder: str | Path) -> None:
        self.folder = as_path(folder)
        self._lost: dict[str, str] = {}
        self._rms: dict[str, tuple[FloatArray, str | None]] = {}

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
        self._rms.pop(run_key(case), None)

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
        told = json.loads(path.read_text(encoding="utf-8"))
        _require_same(path, told, case)
        return str(told["message"])

    def rms(self, case: Case) -> tuple[FloatArray, str | None]:
        """`StoredRun.rms` and `early_end` of a case; studies that share runs read them once.

        Raises PanelsimError as `load` does.
        """
        key = run_key(case)
        if key not in self._rms:
            run = self.load(case)
            self._rms[key] = run.rms, run.early_end
        return self._rms[key]

    def load(self, case: Case) -> StoredRun:
        """The run of a case.

        Raises PanelsimError where there is none, where it is damaged, or of another case or version.
        """
        path = self.path(case)
        if not path.is_file():
            raise PanelsimError(
                "A run of the study is not stored", got=path, remedy="run the study, it goes on where it was"
            )
        try:
            with h5py.File(path) as file:
                attrs = {name: _plain(value) for name, value in file.attrs.items()}
                time, displacement, elevation = (file[name][:] for name in ("time", *KEPT))
        except (OSError, KeyError, RuntimeError) as error:
            raise PanelsimError(
                "A stored run is damaged", got=f"{path} ({error})", remedy="remove the file and run again"
            ) from error
        _require_same(path, attrs, case)
        return StoredRun(time, displacement, elevation, attrs)


def run_identity(case: Case) -> str:
    """What a run depends on, as JSON: the case, and digests of the files that it names."""
    described = {
        "case": case.file.model_dump(mode="json", exclude_none=True),
        "files": file_digests(case),
    }
    return json.dumps(described, sort_keys=True, ensure_ascii=False)


def run_key(case: Case) -> str:
    """A short name for a run, from what it depends on."""
    return hashlib.sha256(run_identity(case).encode()).hexdigest()[:20]


def kept_bytes(history: History, identity: str) -> bytes:
    """The NetCDF file of a run: motions, wave and attributes of its history, and its `run_identity`."""
    dataset = history.dataset[list(KEPT)].assign_attrs(history.attrs | {"identity": identity})
    encoding = {name: {"zlib": True, "complevel": 4, "shuffle": True} for name in KEPT}
    return bytes(dataset.to_netcdf(engine="h5netcdf", encoding=encoding))


def file_digests(case: Case) -> dict[str, str]:
    """Digests of the files and folders that the case names and that are there, by their names in the case."""
    file = case.file
    named = [file.ship.hull, file.hydrodynamics.file, file.seaway.file, *(file.seaway.files or ())]
    paths = [(name, Path(beside(case.folder, name))) for name in named if name is not None]
    return {name: _digest(path) for name, path in paths if path.exists()}


def _digest(path: Path) -> str:
    """Digest of a file, or of all files in a folder."""
    digest = hashlib.sha256()
    for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
        if file.is_file():
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


def _plain(value: Any) -> Any:
    """An attribute as Python has it; numbers come as arrays of one."""
    return value.item() if isinstance(value, np.generic | np.ndarray) else value
