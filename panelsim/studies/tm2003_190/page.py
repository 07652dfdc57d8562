"""The page of a reproduction in Markdown: what the report says, whether it holds, each study behind it."""

from collections.abc import Sequence
from dataclasses import dataclass

from panelsim.results.rms_study import MINOR
from panelsim.results.verdicts import IDENTICAL, NOTICEABLE, SIGNIFICANT, SLIGHT
from panelsim.studies.tm2003_190.section import Section, Statement

TITLE = "TM 2003-190 reproduced"
_INTRODUCTION = (
    "DRDC Atlantic TM 2003-190 (K.A. McTaggart, 2003) ends with numerical studies of HALIFAX in waves: how"
    " long a time step may be, how fine a mesh, when loads may be linear, what a run costs, and what waves of"
    " second order change. Here they are made again on a HALIFAX-like ship, a public frigate form scaled to"
    " the report's main particulars, and each of the report's sentences is judged."
)
_IDENTICAL, _SLIGHT, _NOTICEABLE, _SIGNIFICANT, _MINOR = (
    f"{100 * share:g} %" for share in (IDENTICAL, SLIGHT, NOTICEABLE, SIGNIFICANT, MINOR)
)
_THRESHOLDS = (
    "Sentences with a section in brackets are the report's, in short; one without is our own. The words mean"
    " a difference of the RMS of a motion: *practically* or *effectively identical* ≤"
    f" {_IDENTICAL}, *slightly different* {_IDENTICAL} to {_SLIGHT}, *little influence* ≤ {_SLIGHT},"
    f" *noticeable* > {_NOTICEABLE}, *significant* > {_SIGNIFICANT}. Motions under {_MINOR} of the largest"
    " rotation or translation of the reference in the same sea, all realizations together, are left out. One"
    " motion in one sea is enough to break a sentence. In regular waves *negligible*, *very close* and"
    f" *vanish* mean ≤ {_SLIGHT} of the amplitude at the frequency of the wave. ±: 95 % band of the paired"
    " difference over realizations, none for a single one; a verdict that it reaches over is *within the band"
    " of chance*."
)


@dataclass(frozen=True)
class Making:
    """How the page was made: `seeds` and `extent` in words, runs, and what they took without the page."""

    version: str
    machine: str
    extent: str
    seeds: str
    runs: int
    cpu_seconds: float
    wall_seconds: float


def page(sections: Sequence[Section], making: Making) -> str:
    """The whole page; pictures, tables and recordings lie in folders of these names beside it."""
    parts = [
        f"# {TITLE}\n\n{_INTRODUCTION}\n",
        f"## What holds\n\n{_verdicts(sections)}\n{_THRESHOLDS}\n",
        f"## How it was made\n\n{_making(making)}",
        *(_section(section) for section in sections),
    ]
    failures = [failure for section in sections for failure in section.failures]
    if failures:
        parts.append("## Runs that failed\n\n" + "".join(f"- {_line(failure)}\n" for failure in failures))
    return "\n".join(parts)


def verdict(statement: Statement) -> str:
    """In words whether a statement holds."""
    return "holds" if statement.holds else "does not hold"


def _verdicts(sections: Sequence[Section]) -> str:
    rows = [
        f"| {statement.says} | **{verdict(statement)}** | {statement.figures} | {_link(section)} |\n"
        for section in sections
        for statement in section.statements
    ]
    return "| statement | here | figure | section |\n| --- | --- | --- | --- |\n" + "".join(rows)


def _link(section: Section) -> str:
    return f"[{section.title}](#{anchor(section.title)})"


def _making(making: Making) -> str:
    return (
        f"`panelsim reproduce tm2003-190{' --quick' if making.extent == 'quick' else ''}`, panelsim"
        f" {making.version}, {making.runs} runs. {making.seeds} What is written here comes from stored runs"
        " alone; `--from-runs` makes the page again. Recordings, for"
        " `panelsim view`, lie beside a page that was made here; they are not kept with the sources.\n\n"
        f"Time: {_time(making.cpu_seconds)} of CPU in the runs, {_time(making.wall_seconds)} by the clock to"
        f" make them and to measure, in all sessions, without this page; on {making.machine}.\n"
    )


def _section(section: Section) -> str:
    lines = [
        f"## {section.title}\n",
        f"*{section.question}* {section.setup}\n",
        *(f"![{caption}](pictures/{name})\n\n{caption}\n" for name, caption in section.pictures),
        f"{section.body.strip()}\n",
    ]
    if section.statements:
        lines += ["### Verdicts\n", "".join(_told(statement) for statement in section.statements)]
    if section.failures:
        count = len(section.failures)
        lines.append(f"{count} run{'s' if count > 1 else ''} of this study failed; see the end.\n")
    files = [f"[{name}](tables/{name})" for name in section.tables]
    if section.rms:
        files.append(f"[recording](recordings/{section.key}.rrd)")
    if files:
        lines.append(f"Files: {', '.join(files)}.\n")
    return "\n".join(lines)


def _told(statement: Statement) -> str:
    remark = statement.remark.removesuffix(".")
    remark = f" {remark[0].upper()}{remark[1:]}." if remark else ""
    return f"- {statement.says}: **{verdict(statement)}**: {statement.figures}.{remark}\n"


def anchor(title: str) -> str:
    """What a renderer of Markdown makes of a heading to link to it."""
    kept = "".join(one for one in title.lower() if one.isalnum() or one in " -")
    return kept.replace(" ", "-")


def _time(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 120.0 else f"{seconds / 60.0:.0f} min"


def _line(text: str) -> str:
    """A message of several lines in one."""
    return " ".join(text.split())
