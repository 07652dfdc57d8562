"""TM 2003-190 reproduced: the studies, their runs, and the page that is made of them."""

import json
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass, is_dataclass, replace
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory

from dask.system import CPU_COUNT

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.files import read_json_table, replacing, write_whole
from panelsim.studies.cluster import local_client
from panelsim.studies.computing import compute_runs, require_cluster, require_processes, result_of
from panelsim.studies.run_store import RunStore, run_key
from panelsim.studies.tm2003_190.common import FULL, QUICK, Scope, base_case
from panelsim.studies.tm2003_190.cost import Cost
from panelsim.studies.tm2003_190.drift import Drift
from panelsim.studies.tm2003_190.kernel_speed import KernelSpeed
from panelsim.studies.tm2003_190.linear_nonlinear import LinearNonlinear
from panelsim.studies.tm2003_190.mesh import Mesh
from panelsim.studies.tm2003_190.page import Making, page
from panelsim.studies.tm2003_190.regular_waves import RegularWaves
from panelsim.studies.tm2003_190.runs_folder import open_runs_folder, timed
from panelsim.studies.tm2003_190.section import MeasuringStudy, Section, Study
from panelsim.studies.tm2003_190.statistics import SamplingStatistics
from panelsim.studies.tm2003_190.stretching import Stretching
from panelsim.studies.tm2003_190.time_step import TimeStep
from panelsim.view.study_recording import record_study

NAME = "tm2003-190"
FILES = "files.json"  # in the folder of the page: which files are of it
FOLDERS = ("pictures", "tables", "recordings")
Progress = Callable[[str, float, float], None]  # key of the study, done, in all


@dataclass(frozen=True)
class Reproduction:
    """The studies of the report over a folder of runs; `extent` is "full" or "quick"."""

    studies: Sequence[Study]
    scope: Scope
    extent: str
    runs: Path

    @cached_property
    def store(self) -> RunStore:
        """The runs; one store, for it alone knows which runs were lost by no fault of their case, and why."""
        return RunStore(self.runs)

    @property
    def missing(self) -> int:
        """How many runs and measurements are not stored."""
        runs = {run_key(case) for study in self.studies for case in study.cases if case not in self.store}
        return len(runs) + len(self._unmeasured)

    @property
    def _unmeasured(self) -> list[MeasuringStudy]:
        return [
            study
            for study in self.studies
            if isinstance(study, MeasuringStudy) and not study.is_measured(self.store)
        ]

    def require_complete(self) -> None:
        """Raise PanelsimError where a page cannot be made without running."""
        open_runs_folder(self.runs, NAME, self.extent)
        missing = self.missing
        if missing:
            raise PanelsimError(
                "Runs of the study are not stored",
                got=f"{missing} are missing in {self.runs}",
                remedy="leave --from-runs out: what is there is not run again",
            )

    def make_runs(
        self, *, workers: int | None = None, scheduler: str | None = None, progress: Progress | None = None
    ) -> None:
        """Make what is not stored yet: the runs of all studies, then the measurements, alone.

        Raises PanelsimError for a folder of other runs, and as `compute_runs`.
        """
        require_processes(workers, scheduler)
        note = open_runs_folder(self.runs, NAME, self.extent)
        cases, keys = self._missing_cases()
        if cases:
            require_cluster(scheduler)
        with timed(self.runs, note) as note_time:
            # The study too; runs are made about in their order.
            def told(done: float, total: float) -> None:
                note_time()
                if progress is not None:
                    progress(keys[min(int(done), len(keys) - 1)], done, total)

            compute_runs(cases, self.store, workers=workers, scheduler=scheduler, progress=told)
            for study in self._unmeasured:
                if progress is not None:
                    progress(study.key, 0, 1)
                study.measure(self.store)
                note_time()
                if progress is not None:
                    progress(study.key, 1, 1)

    def _missing_cases(self) -> tuple[list[Case], list[str]]:
        """Cases to be run, study by study, and the study that each is of."""
        found: dict[str, tuple[Case, str]] = {}
        for study in self.studies:
            for case in study.cases:
                key = run_key(case)
                if key not in found and case not in self.store:
                    found[key] = (case, study.key)
        return [case for case, _ in found.values()], [name for _, name in found.values()]

    def make_page(
        self, folder: Path, progress: Progress | None = None, *, workers: int | None = 1
    ) -> tuple[Section, ...]:
        """Write README.md, pictures, tables and recordings into the folder, from stored runs alone.

        What an older page had of these is replaced, at the end and in one go. Sections are made by so many
        `workers`, as many as there are cores if None.
        """
        note = open_runs_folder(self.runs, NAME, self.extent)
        self.store.told.clear()  # runs may be others than when they were last read
        # Not beside the folder, where one who may write into it may not.
        with TemporaryDirectory(prefix="panelsim-") as beside:
            made = self._written(Path(beside), _processes(workers, len(self.studies)), progress)
            sections = [section for section, _ in made]
            spent = {key: seconds for _, of_runs in made for key, seconds in of_runs.items()}
            making = Making(
                version("panelsim"),
                note.machine,
                self.extent,
                _seeds(self.scope),
                len({run_key(case) for study in self.studies for case in study.cases}),
                sum(spent.values()),
                note.wall_seconds,
            )
            write_whole(Path(beside) / "README.md", page(sections, making).encode())
            _replace(folder, Path(beside))
        if progress is not None:
            progress("page", 1, 1)
        return tuple(sections)

    def _written(
        self, folder: Path, processes: int, progress: Progress | None
    ) -> list[tuple[Section, dict[str, float]]]:
        """The sections, written into the folder, and the CPU seconds of the runs that each read, by key."""

        def told(done: int) -> None:
            if progress is not None and done < len(self.studies):
                progress(f"page: {self.studies[done].key}", done, len(self.studies))

        if processes == 1:
            # One store: what a study has read of the runs the others need not read again.
            found, store = [], self.store
            for done, study in enumerate(self.studies):
                told(done)
                found.append(_write_section(study, store, folder))
            return found
        with local_client(processes) as client:
            # Those that read most come first, or the last one would keep the others waiting.
            order = sorted(range(len(self.studies)), key=lambda i: -len(self.studies[i].cases))
            futures = {
                i: client.submit(_write_section, _anew(self.studies[i]), self.store, folder, pure=False)
                for i in order
            }
            found = []
            for i in range(len(self.studies)):
                told(i)
                made = result_of(futures[i])
                if made is None:  # a process that is lost leaves its section to this one
                    made = _write_section(self.studies[i], self.store, folder)
                found.append(made)
            return found


def _anew(study: Study) -> Study:
    """The study without what it remembers: thousands of cases, which take longer to send than to make."""
    assert is_dataclass(study) and not isinstance(study, type)
    return replace(study)


def reproduction(*, quick: bool, runs: Path) -> Reproduction:
    """All studies of the report, or a reduced set of them, over a folder of runs."""
    scope, base = QUICK if quick else FULL, base_case()
    studies: list[Study] = [
        TimeStep(base, scope),
        Mesh(base, scope),
        LinearNonlinear(base, scope),
        Cost(base, *((120.0, 3) if quick else (600.0, 5))),
        RegularWaves(base, quick),
        Stretching(base, quick),
        Drift(base, quick),
        KernelSpeed(base, quick),
        SamplingStatistics(base, quick),
    ]
    return Reproduction(studies, scope, "quick" if quick else "full", runs)


def _processes(workers: int | None, most: int) -> int:
    """How many processes write the sections: as many as there are cores if not given."""
    return min(CPU_COUNT if workers is None else workers, most)


def _write_section(study: Study, store: RunStore, folder: Path) -> tuple[Section, dict[str, float]]:
    """The section of a study, its pictures, tables and recording written into the folder.

    And the CPU seconds of the runs that it read, by their keys.
    """
    pictures, tables, recordings = (folder / name for name in FOLDERS)
    pictures.mkdir(exist_ok=True)
    section = study.section(store, pictures)
    for name, text in section.tables.items():
        write_whole(tables / name, text.encode())
    if section.rms:
        known = {name: case for name, case in section.series.items() if store.failure(case) is None}
        record_study(
            recordings / f"{section.key}.rrd",
            section.rms,
            title=section.title,
            text=f"# {section.title}\n\n{section.setup}\n\n{section.body}",
            series={name: store.load(case) for name, case in known.items()},
        )
    return section, {key: float(told["cpu_seconds"]) for key, told in store.told.items()}


def _seeds(scope: Scope) -> str:
    heights = ", ".join(f"{height:g}" for height in scope.heights)
    return (
        f"Significant heights {heights} m, {scope.duration:g} s after a ramp of 60 s, realizations of each"
        f" sea: {scope.realizations}, for linear against nonlinear {scope.model_realizations}. In these and"
        " in stretching the seed is 1000 times the height in metres plus the number of the realization, the"
        " same for whatever is compared, so that differences are none of sampling. Drift and cost have seeds"
        " of their own."
    )


def _replace(folder: Path, made: Path) -> None:
    """Put a page in the place of an older one, README.md last; other files in the folder stay."""
    files = [
        f"{path.parent.name}/{path.name}" for name in FOLDERS for path in sorted((made / name).glob("*"))
    ]
    for old in set(_files_of_page(folder)) - set(files):
        (folder / old).unlink(missing_ok=True)
    # Also what is being written now: were it stopped here, the next page would know of it.
    write_whole(folder / FILES, json.dumps({"study": NAME, "files": files}, indent=1).encode())
    for name in files:
        with replacing(folder / name) as beside:
            shutil.move(made / name, beside)
    with replacing(folder / "README.md") as beside:
        shutil.copyfile(made / "README.md", beside)


def _files_of_page(folder: Path) -> list[str]:
    """The files of the page in a folder, as "pictures/NAME"; of none where there is no page of ours."""
    if not (folder / FILES).is_file():
        return []
    told = read_json_table(folder / FILES, "The list of the files of the page", "remove it")
    names = told.get("files") if told.get("study") == NAME else None
    return [
        name
        for name in (names if isinstance(names, list) else [])
        if isinstance(name, str) and len(parts := name.split("/")) == 2 and parts[0] in FOLDERS
    ]
