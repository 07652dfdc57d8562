"""CPU times of runs on disk, beside the runs of a study, found again by what was run."""

import json
from collections.abc import Sequence
from dataclasses import asdict, astuple, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.files import read_json_table, write_whole
from panelsim.motion.history import History
from panelsim.studies.run_store import run_identity, run_key

_AGAIN = "remove the file and time the runs again"


@dataclass(frozen=True)
class Timing:
    """One run: CPU seconds of its time loop, and of compilation and set-up; simulated seconds; sizes."""

    cpu_seconds: float
    jit_seconds: float
    simulated_seconds: float
    components: int
    panels: int

    @classmethod
    def of_history(cls, history: History) -> "Timing":
        attrs = history.attrs
        return cls(
            cpu_seconds=float(attrs["cpu_seconds"]),
            jit_seconds=float(attrs["jit_seconds"]),
            simulated_seconds=float(attrs["simulated_seconds"]),
            components=history.components.count,
            panels=len(history.panels),
        )


class TimingStore:
    """A folder of timings: a file a case, with the rounds that were timed or why it could not be run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def path(self, case: Case) -> Path:
        """Where the timings of a case are, or would be."""
        return self.folder / f"{run_key(case)}.times.json"

    def timings(self, case: Case) -> tuple[Timing, ...]:
        """The rounds that were timed, in their order.

        Raises PanelsimError for a file that is damaged, or of another case or version.
        """
        rounds = self._told(case).get("rounds", [])
        try:
            found = [Timing(**round_) for round_ in rounds]
            return tuple(Timing(*(_number(value) for value in astuple(timing))) for timing in found)
        except TypeError as error:
            raise PanelsimError(
                "The file of stored timings is damaged", got=self.path(case), remedy=_AGAIN
            ) from error

    def failure(self, case: Case) -> str | None:
        """Why a case could not be run to its end; None where it was, or was not tried."""
        message = self._told(case).get("failure")
        return None if message is None else str(message)

    def add(self, case: Case, timing: Timing) -> None:
        """Keep one more round."""
        self._write(case, rounds=[*self.timings(case), timing], failure=None)

    def save_failure(self, case: Case, message: str) -> None:
        """Keep why a case could not be timed."""
        self._write(case, rounds=(), failure=message)

    def _write(self, case: Case, *, rounds: Sequence[Timing], failure: str | None) -> None:
        told = {
            "panelsim_version": version("panelsim"),
            "identity": run_identity(case),
            "rounds": [asdict(timing) for timing in rounds],
            "failure": failure,
        }
        write_whole(self.path(case), json.dumps(told, ensure_ascii=False, indent=1).encode())

    def _told(self, case: Case) -> dict[str, Any]:
        path = self.path(case)
        if not path.is_file():
            return {}
        told = read_json_table(path, "The file of stored timings", _AGAIN)
        of = told.get("panelsim_version"), told.get("identity")
        if None in of:
            raise PanelsimError("The file of stored timings is damaged", got=path, remedy=_AGAIN)
        if of != (version("panelsim"), run_identity(case)):
            raise PanelsimError(
                "Stored timings are of another case or version of panelsim",
                got=path,
                remedy="choose another folder, or remove those that are in it",
            )
        return told


def _number(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{value!r} is no number")
    return value
