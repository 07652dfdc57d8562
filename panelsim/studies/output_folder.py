"""The folder that a run writes to: empty, or allowed to be written over."""

import contextlib
import os
from pathlib import Path

from panelsim.errors import PanelsimError


def refuse_occupied_folder(folder: Path, *, force: bool) -> None:
    """Raise PanelsimError where the folder is a file, or holds files already and `force` is not set.

    With `force` only files that panelsim writes are replaced.
    """
    if folder.exists() and not folder.is_dir():
        raise PanelsimError("The output folder is a file", got=folder, remedy="choose another place")
    if folder.is_dir() and any(folder.iterdir()) and not force:
        raise PanelsimError(
            "The output folder is not empty",
            got=folder,
            remedy="choose another with --out, or use --force to replace the files that panelsim writes",
        )


def make_output_folder(folder: Path) -> None:
    """Make the folder and make sure that it can be written to, before anything long is begun.

    Raises PanelsimError where it cannot.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f".panelsim-{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise PanelsimError(
            "The output folder cannot be written",
            got=f"{folder} ({error.strerror})",
            remedy="choose another place",
        ) from error


def remove_if_empty(folder: Path) -> None:
    """Take an output folder away again that nothing has been written to."""
    with contextlib.suppress(OSError):
        folder.rmdir()
