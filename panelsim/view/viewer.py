"""The rerun viewer, opened on recordings."""

import subprocess
from collections.abc import Sequence
from pathlib import Path

import rerun_cli

from panelsim.errors import PanelsimError

RRD_START = b"RRF2"
RRD_FOOTER_MARK = b"RRF2FOOT"
RRD_FOOTER = 12  # bytes: the mark and four more


def viewer_binary() -> Path:
    """The viewer that rerun-sdk brings; its console script would leave the window behind when ended."""
    return Path(rerun_cli.__file__).parent / "rerun"


def require_whole(recording: Path) -> None:
    """Raise PanelsimError for a file that is no recording, or one that was cut short.

    The viewer would open an empty window. A whole .rrd file begins with its format and ends with a footer
    that bears a mark; rerun's own `rrd verify` passes over files that do not begin as they should.
    """
    size = recording.stat().st_size
    with recording.open("rb") as file:
        begins = file.read(len(RRD_START)) == RRD_START
        file.seek(max(0, size - RRD_FOOTER))
        ends = file.read(len(RRD_FOOTER_MARK)) == RRD_FOOTER_MARK
    if not (begins and ends):
        raise PanelsimError(
            "The recording is cut short" if begins else "The file is not a recording",
            got=f"{recording}, {size} bytes",
            allowed="a whole .rrd file, as a run writes it",
        )


def open_viewer(recordings: Sequence[Path]) -> int:
    """Open recordings together in one viewer and wait until it is closed; returns its exit code."""
    binary = viewer_binary()
    if not binary.exists():
        raise PanelsimError("The rerun viewer is not installed", remedy="install rerun-sdk 0.41 again")
    return subprocess.run([str(binary), *map(str, recordings)], check=False).returncode
