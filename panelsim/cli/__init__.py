"""The command line: panelsim new, check, run, hull, hydro, view, export."""

import sys
from io import TextIOWrapper

EXIT_INTERRUPTED = 130


def main() -> None:
    """Run the command line; bad input ends in one message and exit code 2, never a traceback."""
    for stream in (sys.stdout, sys.stderr):
        # A terminal that has no letter for "ω" shows a question mark.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        # Imported here, because that takes a second, and it may be interrupted.
        from panelsim.cli.commands import call

        code = call()
    except KeyboardInterrupt:
        code = EXIT_INTERRUPTED
    if code == EXIT_INTERRUPTED:
        sys.stderr.write("interrupted\n")
    sys.exit(code)
