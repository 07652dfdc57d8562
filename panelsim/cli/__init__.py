"""The command line: panelsim new, check, run, hull, hydro, view, export."""

from panelsim.cli.commands import app, main

__all__ = ["app", "main"]
