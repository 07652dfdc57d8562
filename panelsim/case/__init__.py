"""Case files."""

from panelsim.case.case import Case

__all__ = ["Case"]
