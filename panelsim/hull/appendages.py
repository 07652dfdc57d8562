"""Bilge keels, skeg and rudder of a hull, as data."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from itertools import pairwise
from typing import Any, Self, TypeVar

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError

# Lengths that lie along x and along z; the others are places across the ship, or need not be above 0.
_ALONG_X = ("x", "x_forward", "x_aft", "length", "root_chord", "tip_chord")
_ALONG_Z = ("z", "root_z", "depth")
_POSITIVE = ("span", "length", "depth", "root_chord", "tip_chord")


@dataclass(frozen=True)
class _Appendage:
    """Numbers [m] in hull axes, checked when made."""

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            number = isinstance(value, int | float | np.number) and not isinstance(value, bool)
            low = 0.0 if name in _POSITIVE else -np.inf
            if not (number and np.isfinite(value) and value > low):
                raise PanelsimError(
                    f"{name} of a {_label(type(self))} is not a length",
                    got=repr(value)[:60],
                    allowed="metres, more than 0" if name in _POSITIVE else "metres",
                )

    def scaled(self, factors: FloatArray) -> Self:
        """The appendage stretched by factors (3,) along x, y and z."""
        along_x, along_y, along_z = (float(factor) for factor in factors)
        by_name = dict.fromkeys(_ALONG_X, along_x) | dict.fromkeys(_ALONG_Z, along_z)
        by_name["span"] = self._span_factor(along_y, along_z)
        return type(self)(
            **{name: value * by_name.get(name, along_y) for name, value in asdict(self).items()}
        )

    def _span_factor(self, along_y: float, along_z: float) -> float:
        return along_z


@dataclass(frozen=True)
class BilgeKeelSegment(_Appendage):
    """A length of a pair of bilge keels.

    `x_forward`, `x_aft`: its ends; `y` (to port, the other keel is its mirror image) and `z`: its root on the
    hull; `span`: from root to edge, at right angles to the hull.
    """

    x_forward: float
    x_aft: float
    y: float
    z: float
    span: float

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (self.x_forward > self.x_aft and self.y > 0.0):
            raise PanelsimError(
                "A bilge keel segment has no length, or does not lie to port",
                got=f"x_forward {self.x_forward:g}, x_aft {self.x_aft:g}, y {self.y:g} m",
                allowed="x_forward more than x_aft, y more than 0",
            )

    def _span_factor(self, along_y: float, along_z: float) -> float:
        """It stands out at some 45 degrees: the mean of the factors across and upwards."""
        return 0.5 * (along_y + along_z)


@dataclass(frozen=True)
class Skeg(_Appendage):
    """A skeg on the centreline: its forward end `x_forward`, `length` aft of there, greatest `depth`."""

    x_forward: float
    length: float
    depth: float


@dataclass(frozen=True)
class Rudder(_Appendage):
    """A rudder that hangs straight down: root at `x`, `y`, `root_z`; `span`, `root_chord`, `tip_chord`."""

    x: float
    y: float
    root_z: float
    span: float
    root_chord: float
    tip_chord: float


_Kind = TypeVar("_Kind", bound=_Appendage)


@dataclass(frozen=True)
class Appendages:
    """What a hull carries below the water; `bilge_keels` is one pair, in segments from forward."""

    bilge_keels: tuple[BilgeKeelSegment, ...] = ()
    skeg: Skeg | None = None
    rudders: tuple[Rudder, ...] = ()

    def __post_init__(self) -> None:
        for ahead, behind in pairwise(self.bilge_keels):
            if behind.x_forward > ahead.x_aft:
                raise PanelsimError(
                    "Two bilge keel segments overlap, or are not ordered from forward",
                    got=f"x {ahead.x_forward:g} to {ahead.x_aft:g} m, then {behind.x_forward:g} m",
                )

    def scaled(self, factors: FloatArray) -> "Appendages":
        """The appendages stretched with the hull by factors (3,) along x, y and z."""
        return Appendages(
            tuple(segment.scaled(factors) for segment in self.bilge_keels),
            None if self.skeg is None else self.skeg.scaled(factors),
            tuple(rudder.scaled(factors) for rudder in self.rudders),
        )


def read_appendages(place: str, table: object) -> Appendages:
    """The table [appendages] of a particulars file: bilge_keels and rudders are lists of tables, skeg is one.

    `place` names the file in messages. Raises PanelsimError for a key that is unknown, missing or no length.
    """
    known = tuple(field.name for field in fields(Appendages))
    if not isinstance(table, Mapping) or any(key not in known for key in table):
        raise PanelsimError(
            f"{place}: [appendages] holds something unknown", got=repr(table)[:200], allowed=", ".join(known)
        )
    skeg = table.get("skeg")
    return Appendages(
        tuple(_read(place, BilgeKeelSegment, row) for row in _rows(place, table, "bilge_keels")),
        None if skeg is None else _read(place, Skeg, skeg),
        tuple(_read(place, Rudder, row) for row in _rows(place, table, "rudders")),
    )


def _rows(place: str, table: Mapping[str, Any], key: str) -> list[Any]:
    rows = table.get(key, [])
    if not isinstance(rows, list):
        raise PanelsimError(f"{place}: {key} in [appendages] is not a list of tables", got=repr(rows)[:200])
    return rows


def _read(place: str, kind: type[_Kind], row: object) -> _Kind:
    known = [field.name for field in fields(kind)]
    if not isinstance(row, Mapping) or set(row) != set(known):
        raise PanelsimError(
            f"{place}: a {_label(kind)} in [appendages] has not its keys",
            got=repr(row)[:200],
            allowed=", ".join(known),
        )
    return kind(**row)


def _label(kind: type[_Appendage]) -> str:
    return {BilgeKeelSegment: "bilge keel segment", Skeg: "skeg", Rudder: "rudder"}[kind]
