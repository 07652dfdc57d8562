"""The folder that a run writes to: empty, or allowed to be written over."""

import os
from pathlib import Path

from panelsim.errors import PanelsimError

OUTPUT_FILES = ("history.nc", "statistics.json", "report.md", "run.rrd")


def prepare_output_folder(folder: Path, *, force: bool) -> None:
    """Make the folder and make sure that it can be written to, before anything long is begun.

    Raises PanelsimError where it holds files already and `force` is not set (with it only files that
    panelsim writes are replaced), and where it cannot be made or written.
    """
    if folder.is_dir() and any(folder.iterdir()) and not force:
        raise PanelsimError(
            "The output folder is not empty",
            got=folder,
            remedy="choose another with --out, or use --force to replace the files that panelsim writes",
        )
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f".panelsim-{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise PanelsimError(
            "The output folder cannot be written",
            got=f"{folder} ({error.strerror})",
            remedy="choose another --out",
        ) from error
