"""particulars.toml of a hull folder: which keys it may hold, and the geometry that it names."""

import difflib
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.appendages import Appendages, read_appendages
from panelsim.hull.revolution import Revolution
from panelsim.hull.sections import HullLines, read_offsets
from panelsim.hull.shapes import Box, wigley_lines

FILE_NAME = "particulars.toml"
TEXTS = ("title", "source")
DIMENSIONS = ("length_pp", "beam", "draft", "trim_by_stern")
LOADING = ("center_of_gravity_height", "gyradius_roll", "gyradius_pitch", "gyradius_yaw", "water_density")
# Named as panelsim names its own results, so that the two can be set side by side.
PUBLISHED = (
    "mass",
    "displaced_volume",
    "center_of_buoyancy_x",
    "center_of_buoyancy_z",
    "gm_transverse",
    "gm_longitudinal",
    "natural_roll_period",
)
SUPPLEMENTARY = ("stiffness", "damping")
FORMS: dict[str, tuple[str, ...]] = {
    "scaled_from": ("scaled_from",),
    "offsets": ("offsets", "stem", "stern", "transom"),
    "wigley": ("shape", "depth", "fourth_power_term"),
    "box": ("shape", "depth"),
    "sphere": ("shape",),
    "cylinder": ("shape", "depth"),
}


@dataclass(frozen=True)
class Loading:
    """How the hull is loaded: height of the CG above the baseline and gyradii about it [m], water [kg/m3]."""

    center_of_gravity_height: float
    gyradius_roll: float
    gyradius_pitch: float
    gyradius_yaw: float
    water_density: float


@dataclass(frozen=True)
class Particulars:
    """A checked particulars.toml: texts, dimensions and loading [m, kg/m3], and the table of the form.

    `appendages`: None where the file says nothing of them.
    """

    title: str
    source: str
    assumptions: tuple[str, ...]
    dimensions: dict[str, float]
    loading: Loading
    form_kind: str
    form: dict[str, Any]
    published: dict[str, float]
    supplementary: dict[str, dict[str, float]]
    appendages: Appendages | None


def read_particulars(folder: Path) -> Particulars:
    """Read and check `folder`/particulars.toml; raises PanelsimError naming file and key."""
    path = folder / FILE_NAME
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise PanelsimError(f"{path} is not a TOML file", got=error) from error
    needed = (*TEXTS, "form", "dimensions", "loading")
    _require_keys(path, "", table, needed, ("assumptions", "published", "supplementary", "appendages"))
    for key, texts in (
        *((key, [table[key]]) for key in TEXTS),
        ("assumptions", table.get("assumptions", [])),
    ):
        if not (isinstance(texts, list) and all(isinstance(text, str) for text in texts)):
            raise PanelsimError(f"{path}: {key} is not text", got=texts)
    form_kind = _form_kind(path, table["form"])
    supplementary = table.get("supplementary", {})
    _require_keys(path, "supplementary", supplementary, (), SUPPLEMENTARY)
    loading = _numbers(path, "loading", table["loading"], LOADING)
    dimensions = _numbers(path, "dimensions", table["dimensions"], DIMENSIONS)
    for name, value in {**loading, **dimensions}.items():
        if value <= 0.0 and name != "trim_by_stern":
            raise PanelsimError(f"{path}: {name} is not positive", got=value, allowed="more than 0")
    return Particulars(
        title=table["title"],
        source=table["source"],
        assumptions=tuple(table.get("assumptions", ())),
        dimensions=dimensions,
        loading=Loading(**loading),
        form_kind=form_kind,
        form=table["form"],
        published=_numbers(path, "published", table.get("published", {}), (), PUBLISHED),
        supplementary={
            kind: _numbers(path, f"supplementary.{kind}", supplementary.get(kind, {}), (), DOF_NAMES)
            for kind in SUPPLEMENTARY
        },
        appendages=read_appendages(str(path), table["appendages"]) if "appendages" in table else None,
    )


def build_shape(folder: Path, particulars: Particulars) -> HullLines | Box | Revolution:
    """The geometry that a particulars file gives by offsets or by formula (not one scaled from another)."""
    length, beam, draft = (particulars.dimensions[name] for name in DIMENSIONS[:3])
    form = particulars.form
    match particulars.form_kind:
        case "offsets":
            return _read_lines(folder, form)
        case "wigley":
            return wigley_lines(length, beam, draft, float(form["depth"]), float(form["fourth_power_term"]))
        case "box":
            return Box(length, beam, float(form["depth"]))
    if length != beam:
        raise PanelsimError(
            f"{folder / FILE_NAME}: a {particulars.form_kind} is as long as it is broad",
            got=f"length_pp {length:g} m, beam {beam:g} m",
        )
    depth = float(form["depth"]) if particulars.form_kind == "cylinder" else None
    return Revolution(0.5 * length, depth)


def _read_lines(folder: Path, form: dict[str, Any]) -> HullLines:
    """Lines from the offsets file and the profiles, points [x, z] in m from midships and baseline."""
    offsets = folder / form["offsets"]
    if not offsets.is_file():
        raise PanelsimError(
            "The file of offsets is missing", got=offsets, allowed="a file in the hull folder"
        )
    stem, stern = (_profile(folder, form, key) for key in ("stem", "stern"))
    return HullLines(read_offsets(offsets), stem, stern, transom=bool(form["transom"]))


def _profile(folder: Path, form: dict[str, Any], key: str) -> FloatArray:
    """Points (P, 3) on the centreline."""
    try:
        points = np.array(form[key], dtype=np.float64).reshape(-1, 2)
    except (ValueError, TypeError) as error:
        raise PanelsimError(
            f"{folder / FILE_NAME}: {key} in [form] is not a list of points",
            got=form[key],
            allowed="[[x, z], ...] in metres from midships and baseline",
        ) from error
    return np.column_stack([points[:, 0], np.zeros(len(points)), points[:, 1]])


def _form_kind(path: Path, form: dict[str, Any]) -> str:
    """Which of FORMS the table [form] is, all of its keys checked."""
    if not isinstance(form, dict):
        raise PanelsimError(f"{path}: [form] is not a table", got=form)
    kind = str(form.get("shape", "scaled_from" if "scaled_from" in form else "offsets"))
    if kind not in FORMS:
        raise PanelsimError(f"{path}: unknown shape in [form]", got=kind, allowed=", ".join(FORMS))
    _require_keys(path, "form", form, FORMS[kind])
    return kind


def _numbers(
    path: Path, table: str, values: dict[str, Any], required: tuple[str, ...], optional: tuple[str, ...] = ()
) -> dict[str, float]:
    """A table of finite numbers with checked keys."""
    _require_keys(path, table, values, required, optional)
    for key, value in values.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not np.isfinite(value):
            raise PanelsimError(f"{path}: {key} in [{table}] is not a number", got=value)
    return {key: float(value) for key, value in values.items()}


def _require_keys(
    path: Path, table: str, values: object, required: tuple[str, ...], optional: tuple[str, ...] = ()
) -> None:
    place = f"[{table}]" if table else "the file"
    if not isinstance(values, dict):
        raise PanelsimError(f"{path}: {place} is not a table", got=values)
    known = (*required, *optional)
    for key in values:
        if key not in known:
            near = difflib.get_close_matches(key, known, n=1)
            remedy = f"did you mean {near[0]}?" if near else "remove it"
            what = f"{path}: unknown key in {place}"
            raise PanelsimError(what, got=key, allowed=", ".join(known), remedy=remedy)
    missing = [key for key in required if key not in values]
    if missing:
        raise PanelsimError(
            f"{path}: {place} lacks {', '.join(missing)}",
            got=", ".join(values) or "nothing",
            allowed=", ".join(known),
        )
