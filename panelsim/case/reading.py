"""A case file from disk, with overrides laid over it, checked against the schema."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from panelsim.case.faults import readable
from panelsim.case.schema import CaseFile
from panelsim.errors import PanelsimError


def read_case_file(path: Path, overrides: Sequence[str] = ()) -> CaseFile:
    """Read and check a case file, with `overrides` such as "seaway.seed=7" laid over it.

    Raises PanelsimError that names every key that is unknown, missing or wrong.
    """
    raw = _read_toml(path)
    for override in overrides:
        _lay_over(raw, override)
    try:
        return CaseFile.model_validate(raw)
    except ValidationError as error:
        raise readable(error, str(path)) from None


def changed_case_file(file: CaseFile, changes: Mapping[str, Any], name: str) -> CaseFile:
    """A case file with other values, {"run.time_step": 0.1}; None takes a key away.

    Raises PanelsimError, that names the case and every key that is unknown or wrong.
    """
    raw = file.model_dump(mode="json", exclude_none=True)
    for key, value in changes.items():
        *tables, last = key.split(".")
        table = raw
        for part in tables:
            table = table.setdefault(part, {})
            if not isinstance(table, dict):
                raise PanelsimError(f"The key reaches into {part}, which is no table", got=key)
        table[last] = value
        if value is None:
            del table[last]
    try:
        return CaseFile.model_validate(raw)
    except ValidationError as error:
        raise readable(error, name) from None


def _read_toml(path: Path) -> dict[str, Any]:
    if path.is_dir():
        raise PanelsimError("The case file is a folder", got=path, allowed="a TOML file")
    if not path.is_file():
        raise PanelsimError(
            "There is no such case file", got=path, remedy="`panelsim new NAME` writes one to start from"
        )
    try:
        # Some editors begin a file with a byte order mark; TOML does not allow for it.
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise PanelsimError("The case file is not text in UTF-8", got=path, allowed="a TOML file") from error
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"line (\d+)", str(error))
        line = f"\n    {text.splitlines()[int(place[1]) - 1].strip()[:200]}" if place else ""
        comma = re.search(r"=\s*[+-]?\d+,\d", line)
        raise PanelsimError(
            "The case file is not valid TOML",
            got=f"{path}: {error}{line}",
            remedy="write decimals with a point" if comma else None,
        ) from error
    except RecursionError as error:
        raise PanelsimError("The case file is not valid TOML", got=f"{path}: nested too deeply") from error


def _lay_over(raw: dict[str, Any], override: str) -> None:
    """Put "section.key=value" into the raw case; the value is read as TOML, else as text."""
    path, equals, text = override.partition("=")
    keys = [key.strip() for key in path.split(".")]
    if not equals or not all(keys):
        raise PanelsimError(
            "An override is not of the form key=value", got=override, allowed="for example seaway.seed=7"
        )
    try:
        parsed = tomllib.loads(f"value = {text}")
    except tomllib.TOMLDecodeError:
        parsed = {"value": text.strip()}
    except RecursionError as error:
        raise PanelsimError("An override is nested too deeply", got=path) from error
    if parsed.keys() != {"value"}:
        raise PanelsimError(
            "An override holds more than one key", got=override, remedy="give each its own --set"
        )
    table = raw
    for key in keys[:-1]:
        table = table.setdefault(key, {})
        if not isinstance(table, dict):
            raise PanelsimError(f"The override reaches into {key}, which is no table", got=override)
    table[keys[-1]] = parsed["value"]
