"""The rerun viewer, opened on recordings."""

import subprocess
from collections.abc import Sequence
from pathlib import Path

import rerun_cli

from panelsim.errors import PanelsimError


def viewer_binary() -> Path:
    """The viewer that rerun-sdk brings; its console script would leave the window behind when ended."""
    return Path(rerun_cli.__file__).parent / "rerun"


def open_viewer(recordings: Sequence[Path]) -> int:
    """Open recordings together in one viewer and wait until it is closed; returns its exit code."""
    binary = viewer_binary()
    if not binary.exists():
        raise PanelsimError("The rerun viewer is not installed", remedy="install rerun-sdk 0.41 again")
    return subprocess.run([str(binary), *map(str, recordings)], check=False).returncode
