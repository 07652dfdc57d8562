"""The climate tables that travel inside the package."""

import csv
from importlib.resources import files


def bundled_rows(name: str) -> list[list[str]]:
    """Rows of a bundled table, its header first, without the `#` lines that give its source."""
    text = files("panelsim.seaway.climate").joinpath("data", name).read_text(encoding="utf-8")
    return list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
