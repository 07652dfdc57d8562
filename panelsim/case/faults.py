"""What is wrong with a case file, in the words of its tables and keys."""

import difflib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from panelsim.case.schema import CaseFile
from panelsim.case.section import KeyFault
from panelsim.errors import PanelsimError

TYPES = {
    "float_type": "a number",
    "int_type": "a whole number",
    "finite_number": "a finite number",
    "string_type": 'text in quotes, "…"',
    "string_too_short": "a name",
    "model_type": "a table, { key = value, … }",
    "model_attributes_type": "a table, { key = value, … }",
    "list_type": "a list in brackets, […]",
    "dict_type": "a table, { key = value, … }",
    "bool_type": "true or false",
}
LIMITS = {"gt": "more than", "ge": "at least", "lt": "less than", "le": "at most"}


@dataclass(frozen=True)
class Fault:
    """One fault: what is wrong, and the other parts of a PanelsimError."""

    what: str
    got: str | None = None
    allowed: str | None = None
    remedy: str | None = None

    def line(self) -> str:
        parts = (self.got and f"got {self.got}", self.allowed and f"allowed {self.allowed}", self.remedy)
        more = "; ".join(part for part in parts if part)
        return f"{self.what}: {more}" if more else self.what


def readable(error: ValidationError, source: str) -> PanelsimError:
    """Pydantic's list of faults as one message, with the nearest known key for an unknown one."""
    found = error.errors()
    unknown = {path: _nearest(path) for path in (_path(f) for f in found if f["type"] == "extra_forbidden")}
    faults = [
        _unknown(_path(fault), unknown[_path(fault)]) if fault["type"] == "extra_forbidden" else _wrong(fault)
        for fault in found
        # A misspelt key is not missing as well.
        if not (fault["type"] == "missing" and _path(fault) in unknown.values())
    ]
    if len(faults) == 1:
        (fault,) = faults
        return PanelsimError(
            f"{source}: {fault.what}", got=fault.got, allowed=fault.allowed, remedy=fault.remedy
        )
    lines = "".join(f"\n    {fault.line()}" for fault in faults)
    return PanelsimError(f"{source} has {len(faults)} faults", got=lines)


def _path(fault: Any) -> tuple[str, ...]:
    return tuple(str(part) for part in fault["loc"])


def _unknown(path: tuple[str, ...], nearest: tuple[str, ...] | None) -> Fault:
    *table, key = path
    kind = "key" if table else "table or key"
    place = f"[{'.'.join(table)}]" if table else "the case file"
    known = ", ".join(_model(table).model_fields)
    remedy = f"did you mean {'.'.join(nearest)}?" if nearest else f"remove {key}"
    return Fault(f"{place} has no {kind} {key}", allowed=known, remedy=remedy)


def _wrong(fault: Any) -> Fault:
    where, kind, value = ".".join(_path(fault)), fault["type"], fault["input"]
    if kind == "missing":
        return Fault(f"{where} is missing")
    if kind == "value_error":
        message = fault["msg"].removeprefix("Value error, ")
        what = f"{where}: {message}" if where else message
        error = fault["ctx"]["error"]
        return (
            Fault(what, error.got, error.allowed, error.remedy)
            if isinstance(error, KeyFault)
            else Fault(what)
        )
    if kind in ("too_short", "too_long"):
        return Fault(
            f"{where} has the wrong length", f"{fault['ctx']['actual_length']}", _length(fault["ctx"])
        )
    allowed = (
        TYPES.get(kind)
        or _limits(_path(fault), fault.get("ctx", {}))
        or fault["msg"].removeprefix("Input should be ")
    )
    comma = isinstance(value, str) and re.fullmatch(r"[+-]?\d+,\d+", value)
    remedy = "decimals are written with a point" if comma else None
    what = f"{where} is not {allowed}" if kind in TYPES else f"{where} is out of range"
    if kind == "literal_error":
        what = f"{where} is not known"
    return Fault(what, _shown(value), None if kind in TYPES else allowed, remedy)


def _limits(path: tuple[str, ...], context: dict[str, Any]) -> str | None:
    """All limits of a number that breaks one of them; None for a fault of another kind."""
    if not LIMITS.keys() & context.keys():
        return None
    *table, key = path
    found = _limits_in(_model(table).model_fields.get(key)) or context
    return ", ".join(f"{LIMITS[name]} {found[name]:g}" for name in LIMITS if name in found)


def _limits_in(annotation: Any) -> dict[str, float]:
    """The limits that an annotation of a number holds, by the names of `LIMITS`."""
    found: dict[str, float] = {}
    for part in (*getattr(annotation, "metadata", ()), *get_args(annotation)):
        found |= {name: getattr(part, name) for name in LIMITS if hasattr(part, name)}
        found |= _limits_in(part)
    return found | (_limits_in(annotation.annotation) if isinstance(annotation, FieldInfo) else {})


def _length(context: dict[str, Any]) -> str:
    if "min_length" in context:
        return f"at least {context['min_length']}"
    return f"at most {context['max_length']}"


def _shown(value: object) -> str:
    """A value as the case file writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, dict):
        return "a table"
    return str(value)


def _nearest(path: tuple[str, ...]) -> tuple[str, ...] | None:
    """The known key that an unknown one may stand for: near in its own table, or the same in another."""
    *table, key = path
    near = difflib.get_close_matches(key, list(_model(table).model_fields), n=1)
    if near:
        return (*table, near[0])
    return next((known for known in _all_keys(CaseFile) if known[-1] == key), None)


def _all_keys(model: type[BaseModel], table: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    for name in model.model_fields:
        yield (*table, name)
        below = _table_model(model, name)
        if below is not None:
            yield from _all_keys(below, (*table, name))


def _model(table: list[str]) -> type[BaseModel]:
    """The model of a table of the case file, given by the keys that lead to it."""
    model: type[BaseModel] = CaseFile
    for name in table:
        if name in model.model_fields:  # the place in a list of tables is no key
            model = _table_model(model, name) or model
    return model


def _table_model(model: type[BaseModel], name: str) -> type[BaseModel] | None:
    """The model of the table, or list of tables, under a key; None where the key holds a plain value."""
    return next(_models_in(model.model_fields[name].annotation), None)


def _models_in(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models_in(part)
