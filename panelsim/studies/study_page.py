"""What the page and the folder of every study of a case have: its set-up, its failures, its runs."""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from panelsim.case import Case
from panelsim.files import write_whole
from panelsim.results.rms_tables import markdown_table
from panelsim.studies.case_response import sea_in_words
from panelsim.studies.output_folder import refuse_occupied_folder

PAGE = "report.md"
RUNS = "runs"
RECORDING = "study.rrd"
# Also as they are called while they are written: a process that is killed leaves one.
_BEFORE_PAGE = re.compile(
    r"(rms|cost)\.csv|(difference-[a-z0-9-]+|models|cost)\.png|study\.rrd"
    r"|\.(rms|cost|difference-[a-z0-9-]+|models|study|report)\.\d+\.(csv|png|rrd|md)|\.panelsim-\d+"
)


def refuse_other_folder(folder: Path, *, force: bool) -> None:
    """Raise PanelsimError for a folder with files in it, unless `force`; a study that was stopped goes on.

    Until its page is written, which comes last, it has only its runs there and other files of the page.
    """
    stopped = (folder / RUNS).is_dir() and all(
        entry.name == RUNS or _BEFORE_PAGE.fullmatch(entry.name) for entry in folder.iterdir()
    )
    refuse_occupied_folder(folder, force=force or stopped)


def setup_markdown(case: Case, more: Mapping[str, str]) -> str:
    """A table of what is the same in all runs of a study, then of what is `more`."""
    run = case.file.run
    facts = {
        "ship": case.ship.name,
        "sea": sea_in_words(case),
        "speed": f"{run.speed_knots:g} knots",
        "each run": f"{run.duration:g} s after a ramp of {run.ramp:g} s",
    }
    return markdown_table(["", ""], list((facts | dict(more)).items()), text_columns=2)


def failures_markdown(failures: Iterable[str]) -> str:
    """The runs that did not go to their end, or that all did."""
    told = list(failures)
    if not told:
        return "Every run went to its end."
    lines = (f"- {' '.join(failure.split())}" for failure in told)
    return "These runs did not go to their end, and have no figures above:\n\n" + "\n".join(lines)


def write_page(folder: Path, title: str, parts: Sequence[str]) -> None:
    """Write report.md whole: the title, and the parts that are not empty."""
    text = "\n\n".join([f"# {title}", *(part.strip() for part in parts if part.strip())]) + "\n"
    write_whole(folder / PAGE, text.encode())
