"""The one exception of panelsim: what is wrong, what was got, what is allowed, what to do."""

from functools import partial
from types import UnionType
from typing import Any


class PanelsimError(Exception):
    """Bad input, told in full sentences; the command line prints it and exits with 2.

    Give the parts by name and leave out what does not apply:

    >>> raise PanelsimError("The time step is not positive", got="0 s", allowed="more than 0 s",
    ...                     remedy="set run.time_step, for example to 0.2")
    Traceback (most recent call last):
    ...
    panelsim.errors.PanelsimError: The time step is not positive.
      got: 0 s
      allowed: more than 0 s
      what to do: set run.time_step, for example to 0.2
    """

    def __init__(
        self, what: str, *, got: object = None, allowed: object = None, remedy: str | None = None
    ) -> None:
        self.what = what
        self.got = got
        self.allowed = allowed
        self.remedy = remedy
        lines = [what if what.endswith((".", "?", "!")) else f"{what}."]
        for label, part in (("got", got), ("allowed", allowed), ("what to do", remedy)):
            if part is not None:
                lines.append(f"  {label}: {part}")
        super().__init__("\n".join(lines))

    def __reduce__(self) -> tuple[Any, ...]:
        """Its parts in words, so that one from another process says the same."""
        got, allowed = (None if part is None else str(part) for part in (self.got, self.allowed))
        return partial(PanelsimError, got=got, allowed=allowed, remedy=self.remedy), (self.what,)


def require_kind(name: str, value: object, kind: type | UnionType, allowed: str) -> None:
    """Raise PanelsimError, with `allowed` in words, for a value that is not an instance of `kind`."""
    if not isinstance(value, kind):
        raise PanelsimError(f"The {name} is of another kind", got=repr(value)[:60], allowed=allowed)
