"""The lines of the files of the National Data Buoy Center (NDBC), looked at before they are believed.

Format: https://www.ndbc.noaa.gov/measdes.shtml. Files of the last weeks ("realtime") and yearly ones
("historical") differ; the first line of either names its columns, later lines that begin with # are comments.
"""

import gzip
from pathlib import Path

from panelsim.errors import PanelsimError

DATE_COLUMNS = (("YY", "YYYY"), ("MM",), ("DD",), ("hh",))


def read_lines(path: Path) -> list[tuple[int, list[str]]]:
    """Numbers and words of the lines that are no comments, the header first, without its #.

    Raises PanelsimError for a file that cannot be read, that ends within a line, or whose header does not
    begin with the date.
    """
    try:
        with gzip.open(path, "rt") if path.suffix == ".gz" else path.open() as file:
            text = file.read()
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise PanelsimError("The NDBC file cannot be read", got=f"{path} ({error})") from error
    lines = text.splitlines()
    header = lines[0].lstrip("#").split() if lines else []
    if len(header) < 5 or not all(
        word in names for word, names in zip(header[:4], DATE_COLUMNS, strict=True)
    ):
        raise PanelsimError(
            "The file is no NDBC file",
            got=f"{path}: {lines[0][:60] if lines else ''!r}",
            allowed="a first line that begins with #YY MM DD hh, or YYYY MM DD hh",
        )
    if not text.endswith("\n"):
        raise cut_short(path, len(lines), lines[-1].split())
    rows = [(number, line.split()) for number, line in enumerate(lines[1:], 2) if line[:1] != "#"]
    return [(1, header), *((number, words) for number, words in rows if words)]


def cut_short(path: Path, number: int, words: list[str]) -> PanelsimError:
    """The refusal of a line that is not whole."""
    return PanelsimError(
        f"The NDBC file is cut short or damaged in line {number}",
        got=f"{path}: {len(words)} columns, {' '.join(words)[-40:]!r} at the end",
        remedy="get the file again, or take the line out",
    )


def date_count(header: list[str]) -> int:
    """Number of columns of the date; the minutes came in 2005."""
    return 5 if header[4] == "mm" else 4


def require_spectral(path: Path, realtime_name: str) -> None:
    """Refuse what is no whole file of wave spectra.

    `realtime_name` is what a realtime file calls its first value, for example spec_1; historical files do
    not say what they hold.
    """
    (_, header), *rows = read_lines(path)
    dates = date_count(header)
    if header[-1] == ">":
        _require_name(path, header, realtime_name)
        dates += header[dates] == "Sep_Freq"
    elif not all(_is_number(word) for word in header[dates:]):
        raise PanelsimError(
            "The file holds no wave spectra",
            got=f"{path}: columns {' '.join(header[dates:])[:60]}",
            allowed="frequencies as the names of the columns",
            remedy="read standard meteorological files with read_ndbc_meteorology",
        )
    if not rows:
        raise PanelsimError("The NDBC file holds no spectrum", got=path)
    first = rows[0][1]
    for number, words in rows:
        if header[-1] == ">":
            # Values and frequencies in brackets by turns, the frequencies those of the first line.
            values, frequencies = words[dates::2], words[dates + 1 :: 2]
            whole = len(values) == len(frequencies) and frequencies == first[dates + 1 :: 2]
        else:
            whole, values = len(words) == len(header), words[dates:]
        if not whole or not all(map(_is_number, [*words[:dates], *values])):
            raise cut_short(path, number, words)


def _require_name(path: Path, header: list[str], name: str) -> None:
    if name not in header:
        raise PanelsimError(
            "The NDBC file holds another quantity",
            got=f"{path}: columns {' '.join(header[5:8])}",
            allowed=f"{name} …",
            remedy="give the five files in the order density, alpha1, alpha2, r1, r2",
        )


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
