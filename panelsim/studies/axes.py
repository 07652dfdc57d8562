"""What a sweep varies: keys of a case, the values of each, and their units."""

import math
import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from panelsim.errors import PanelsimError, require_kind

Value = float | int | str | bool

_EXAMPLE = "for example seaway.wave_heading_deg=0:180:15, or run.model=linear,nonlinear"
MOST_VALUES = 1000  # a list of more is a mistake in the step
_ROUNDING = 1e-6  # of a step
_LARGEST = 1e100  # no key of a case is larger, and differences of such numbers are still numbers
_METRES = (
    "draft trim_by_stern center_of_gravity_x center_of_gravity_height gyradius_roll gyradius_pitch"
    " gyradius_yaw significant_wave_height wave_height wave_length fetch"
)
_SECONDS = "peak_period mean_period zero_crossing_period wave_period time_step duration ramp"
_UNITS = (
    dict.fromkeys(_METRES.split(), "m")
    | dict.fromkeys(_SECONDS.split(), "s")
    | dict.fromkeys(["wave_frequency", "low_frequency", "high_frequency", "start", "stop", "step"], "rad/s")
    | {"panel_area": "m2", "mass": "kg", "water_density": "kg/m3", "gravity": "m/s2", "wind_speed": "m/s"}
    | {"linear": "N m s", "quadratic": "N m s2", "cubic": "N m s3", "critical_percent": "%"}
)
_SUFFIXES = {"_deg": "deg", "_knots": "knots"}


@dataclass(frozen=True)
class Axis:
    """A key of a case, "run.speed_knots", and the values that it takes, each once."""

    key: str
    values: tuple[Value, ...]

    def __post_init__(self) -> None:
        require_kind("key of an axis", self.key, str, '"run.speed_knots", for example')
        if not self.values:
            raise PanelsimError(f"There are no values of {self.key}", got="an empty list", allowed=_EXAMPLE)
        for value in self.values:
            if not isinstance(value, float | int | str):  # a table has no place on an axis of a dataset
                raise PanelsimError(
                    f"A value of {self.key} is of another kind",
                    got=" ".join(repr(value).split())[:60],
                    allowed="a number, a word, True or False",
                )
        twice = [value for i, value in enumerate(self.values) if value in self.values[:i]]
        if twice:
            raise PanelsimError(
                f"A value of {self.key} is given twice", got=twice[0], remedy="give each value once"
            )
        _require_few(self.key, len(self.values))

    @classmethod
    def parse(cls, text: str) -> "Axis":
        """The axis of "key=start:stop:step", both ends included, or "key=a,b,c".

        Raises PanelsimError for text that is neither, and for a step that does not fit.
        """
        key, equals, values = (part.strip() for part in text.partition("="))
        if not equals or not all(part.strip() for part in key.split(".")):
            raise PanelsimError("An axis is not of the form key=values", got=text, allowed=_EXAMPLE)
        return cls(key, tuple(_range(key, values) if ":" in values else _list(text, values)))

    @property
    def unit(self) -> str:
        """The unit that the key of the case file has; "1" for numbers without, and for words."""
        *table, name = self.key.split(".")
        for suffix, unit in _SUFFIXES.items():
            if name.endswith(suffix):
                return unit
        if table and table[0] == "supplementary":
            units = {"stiffness": ("N/m", "N m/rad"), "damping": ("N/(m/s)", "N m/(rad/s)")}
            return units.get(table[-1], ("1", "1"))[name in ("roll", "pitch", "yaw")]
        return _UNITS.get(name, "1")

    @property
    def is_numeric(self) -> bool:
        """Whether its values are numbers, which can be drawn along a line."""
        return all(isinstance(value, int | float) and not isinstance(value, bool) for value in self.values)


def require_axes(axes: Sequence[Axis], set_keys: Iterable[str] = ()) -> None:
    """Raise PanelsimError where there is no axis, two of one key, or one of a key that is set besides."""
    if not axes:
        raise PanelsimError("The sweep has no axis", got="none", allowed=_EXAMPLE)
    keys = [axis.key for axis in axes]
    for i, key in enumerate(keys):
        if any(_overlap(key, other) for other in keys[:i]):
            raise PanelsimError(
                "Two axes go over the same key", got=key, remedy="give its values as one list: key=a,b,c"
            )
        if any(_overlap(key, other.strip()) for other in set_keys):
            raise PanelsimError(
                "An axis goes over a key that is set besides",
                got=key,
                remedy="leave one of them out",
            )


def _overlap(key: str, other: str) -> bool:
    """Whether two keys are the same, or one of them is the table of the other."""
    return f"{key}.".startswith(f"{other}.") or f"{other}.".startswith(f"{key}.")


def _list(text: str, values: str) -> list[Value]:
    found = [_value(part.strip()) for part in values.split(",")]
    if "" in found:
        raise PanelsimError("A list of values has a gap", got=text, allowed=_EXAMPLE)
    return found


def _value(text: str) -> Value:
    """A number or true or false as TOML writes it, else the text itself."""
    try:
        value = tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text
    return value if isinstance(value, float | int | str) else text


def _range(key: str, text: str) -> list[Value]:
    """Numbers from "start:stop:step"; whole where all three are."""
    parts = [_value(part.strip()) for part in text.split(":")]
    numbers = [part for part in parts if isinstance(part, float | int) and not isinstance(part, bool)]
    if len(parts) != 3 or len(numbers) != 3 or not all(abs(number) <= _LARGEST for number in numbers):
        raise PanelsimError(f"This is no range of {key}", got=text, allowed="start:stop:step, three numbers")
    start, stop, step = numbers
    count = (stop - start) / step if step else math.nan
    _require_few(key, count)  # a count that is infinite has no round number
    if not (count > 0.0 and abs(count - round(count)) <= _ROUNDING):
        raise PanelsimError(
            f"The step of {key} does not lead from start to stop",
            got=text,
            allowed="start:stop:step with both ends included, for example 0:180:15",
            remedy=_what_fits(start, stop, step),
        )
    # 0.1 + 2 × 0.1 is to be 0.3, as it is written.
    return [
        start + i * step if isinstance(start + step, int) else float(f"{start + i * step:.12g}")
        for i in range(round(count) + 1)
    ]


def _what_fits(start: float, stop: float, step: float) -> str:
    """How to put a range right whose step has no size, the wrong sign, or ends elsewhere."""
    if start == stop:
        return "give a single value by itself: key=value"
    if not step or (stop - start) / step < 0.0:
        return f"the step must be {'more' if stop > start else 'less'} than 0"
    whole = math.floor((stop - start) / step)
    return f"end at {start + whole * step:.12g} or {start + (whole + 1) * step:.12g}, or take another step"


def _require_few(key: str, count: float) -> None:
    if count > MOST_VALUES:
        raise PanelsimError(
            f"There are too many values of {key}",
            got=f"{count:.6g}",
            allowed=f"at most {MOST_VALUES}",
            remedy="take a longer step",
        )
