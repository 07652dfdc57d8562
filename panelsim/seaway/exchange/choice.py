"""One of several times or sites of a file, chosen by its value."""

import warnings
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from panelsim.errors import PanelsimError

Moment = str | datetime | np.datetime64


def chosen_place(name: str, values: NDArray[np.generic], wanted: object) -> int:
    """Place of the one value that is `wanted`, or of the only value where None is wanted.

    `values` (K,) as a file gives them, times in UTC; a wanted time is a `Moment`, for example
    "2020-06-08 03:50". Raises PanelsimError where the choice is open, or there is no such value.
    """
    if wanted is None:
        if len(values) == 1:
            return 0
        raise PanelsimError(
            f"It is not said which {name} is meant",
            got=_range(values),
            allowed="one of them",
            remedy=f"say which {name}, in a case seaway.{name}, for example {_text(values[0])}"
            if len(values)
            else None,
        )
    if np.issubdtype(values.dtype, np.datetime64):
        wanted = _utc_moment(wanted)
    places = np.flatnonzero(values == wanted)
    if len(places) != 1:
        raise PanelsimError(
            f"The {name} is not there" if not len(places) else f"The {name} is there {len(places)} times",
            got=_text(wanted),
            allowed=_range(values),
            remedy=f"give one {name} that is there once",
        )
    return int(places[0])


def _utc_moment(wanted: object) -> np.datetime64:
    """A time in UTC; raises PanelsimError for what is no time, and for one with a time zone."""
    try:
        # NumPy warns of a time zone and goes on.
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return np.datetime64(wanted)  # type: ignore[call-overload]
    except (TypeError, ValueError, Warning):
        raise PanelsimError(
            "The time is no time in UTC",
            got=repr(wanted)[:60],
            allowed='for example "2020-06-08 03:50", without a time zone',
        ) from None


def _text(value: object) -> str:
    """A value as it is typed; times to the minute where they have no seconds."""
    if isinstance(value, np.datetime64):
        return str(np.datetime_as_string(value, unit="s")).removesuffix(":00").replace("T", " ")
    return str(value)


def _range(values: NDArray[np.generic]) -> str:
    """How many there are, with the first and the last."""
    if not len(values):
        return "0"
    return f"{len(values)}, {_text(values[0])} to {_text(values[-1])}"
