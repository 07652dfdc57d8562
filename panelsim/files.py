"""Files are written beside their place and renamed, so that nothing half-written is left."""

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from panelsim.errors import PanelsimError, require_kind


def as_path(path: str | Path) -> Path:
    """The path of a file; PanelsimError for what is no name of one."""
    require_kind("name of the file", path, str | os.PathLike, "a text or a Path")
    return Path(path)


def require_new(path: Path, what: str, *, overwrite: bool) -> None:
    """Raise PanelsimError where `what` would overwrite a file and may not."""
    if path.exists() and not overwrite:
        raise PanelsimError(
            f"The {what} would overwrite a file", got=path, remedy="give another name or overwrite=True"
        )


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Lend a name beside `path` to write to; at the end rename it to `path`, after an error remove it.

    Raises PanelsimError where the place cannot be written, or runs full.
    """
    beside = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield beside
        beside.replace(path)
    except OSError as error:
        raise PanelsimError(
            "The file cannot be written",
            got=f"{path} ({error.strerror or error})",
            remedy="make room there, or choose another place",
        ) from error
    finally:
        if beside.parent.is_dir():
            beside.unlink(missing_ok=True)


def read_json_table(path: Path, what: str, remedy: str) -> dict[str, Any]:
    """The table that a JSON file holds; PanelsimError that `what` is damaged for anything else."""
    try:
        told = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:  # no JSON, or no UTF-8
        raise PanelsimError(f"{what} is damaged", got=f"{path} ({error})", remedy=remedy) from error
    if not isinstance(told, dict):
        raise PanelsimError(f"{what} is damaged", got=f"{path} (no table)", remedy=remedy)
    return told


def write_whole(path: Path, content: bytes) -> None:
    """Write a file whole or not at all.

    Libraries that write files by themselves do not tell of a full disk, or end the process: let them make
    bytes, and write those here.
    """
    with replacing(path) as beside:
        beside.write_bytes(content)
