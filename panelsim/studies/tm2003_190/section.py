"""What every study of the report gives to the page: the runs it needs, and what they show."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol, runtime_checkable

from panelsim.case import Case
from panelsim.results.rms_study import RmsStudy
from panelsim.studies.run_store import RunStore


@dataclass(frozen=True)
class Statement:
    """A statement of the report and whether it holds here.

    `says` is what the report says, with its section; `figures` what was measured beside the threshold;
    `remark` where and why we differ; all of one line, as a cell of a table.
    """

    says: str
    holds: bool
    figures: str
    remark: str = ""


@dataclass(frozen=True)
class Section:
    """A section of the page, in Markdown; `pictures` are names of files in the folder with their captions.

    `tables` are CSV texts by file name; `rms` what the recording of the study shows, and `series` cases
    whose motions stand behind it, by what they are called there.
    """

    key: str
    title: str
    question: str
    setup: str
    body: str
    statements: tuple[Statement, ...]
    pictures: tuple[tuple[str, str], ...] = ()
    tables: Mapping[str, str] = field(default_factory=dict)
    rms: tuple[RmsStudy, ...] = ()
    series: Mapping[str, Case] = field(default_factory=dict)
    failures: tuple[str, ...] = ()


class Study(Protocol):
    """A study: its runs, and the section that they amount to."""

    @property
    def key(self) -> str:
        """Short name: time-step, mesh, …"""

    @property
    def cases(self) -> Sequence[Case]:
        """Every run that the section reads."""

    def section(self, store: RunStore, folder: Path) -> Section:
        """Read the runs, draw the pictures into the folder, say what they show; runs nothing."""


@runtime_checkable
class MeasuringStudy(Study, Protocol):
    """A study that reads more than runs: timings, which are taken while nothing else runs, or analyses.

    What it finds it keeps in the folder of the runs.
    """

    def is_measured(self, store: RunStore) -> bool:
        """Whether all of it is there."""

    def measure(self, store: RunStore) -> None:
        """Make and keep what is not there yet; the runs of the study are stored when this is called."""
