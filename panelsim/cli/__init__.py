"""The command line: panelsim new, check, sea, run, sweep, decay, hull, righting, hydro, view, export."""

import signal
import sys
from io import TextIOWrapper

EXIT_INTERRUPTED = 130


def main() -> None:
    """Run the command line; bad input ends in one message and exit code 2, never a traceback."""
    for stream in (sys.stdout, sys.stderr):
        # A terminal that has no letter for "ω" shows a question mark.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")
    # A batch queue that ends a run asks in this way: what was computed is kept as after Ctrl-C.
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        # Imported here, because that takes a second, and it may be interrupted.
        from panelsim.cli.commands import call

        code = call()
    except KeyboardInterrupt:
        code = EXIT_INTERRUPTED
    finally:
        signal.signal(signal.SIGTERM, before)
    if code == EXIT_INTERRUPTED:
        sys.stderr.write("interrupted\n")
    sys.exit(code)
