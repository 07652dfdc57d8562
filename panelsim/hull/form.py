"""A hull form with its dimensions and loading: loaded by name or folder, scaled, panelled."""

import contextlib
import difflib
import hashlib
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol, Self

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.appendages import Appendages
from panelsim.hull.curve import Waterline
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.particulars import FILE_NAME, Loading, build_shape, read_particulars


class Shape(Protocol):
    """What a hull form needs of its geometry, be it lines or a formula."""

    def panel(self, area: float, waterline: Waterline) -> PanelMesh: ...

    def scaled(self, factors: FloatArray) -> Self: ...

    def signature(self) -> FloatArray: ...


@dataclass(frozen=True, eq=False)
class HullForm:
    """A hull in hull axes: origin at midships, centreline and baseline; x forward, y to port, z up.

    `length_pp`, `beam` and `draft` (at midships) [m]; `trim_by_stern` [m] over `length_pp`, deeper aft
    positive. `published`: what the source states of this ship, SI. `supplementary`: stiffness and
    damping by motion, {"stiffness": {"surge": N/m, ...}, "damping": {"roll": N m/(rad/s), ...}}.
    `appendages`: bilge keels, skeg and rudders; panels have none of them.
    """

    name: str
    title: str
    source: str
    assumptions: tuple[str, ...]
    length_pp: float
    beam: float
    draft: float
    trim_by_stern: float
    loading: Loading
    shape: Shape
    published: dict[str, float] = field(default_factory=dict)
    supplementary: dict[str, dict[str, float]] = field(default_factory=dict)
    appendages: Appendages = field(default_factory=Appendages)

    def scaled(
        self, *, length: float | None = None, beam: float | None = None, draft: float | None = None
    ) -> Self:
        """The form stretched to other dimensions [m]; what is not given stays.

        The height of the CG goes with the draft, the roll gyradius with the beam, the others with the
        length, trim with the draft; supplementary loads by Froude's law. Published values stay behind.
        """
        old = np.array([self.length_pp, self.beam, self.draft])
        new = np.array([o if n is None else n for n, o in zip((length, beam, draft), old, strict=True)])
        _require_positive(dict(zip(("length", "beam", "draft"), new, strict=True)))
        x, y, z = factors = new / old
        loading = replace(
            self.loading,
            center_of_gravity_height=self.loading.center_of_gravity_height * z,
            gyradius_roll=self.loading.gyradius_roll * y,
            gyradius_pitch=self.loading.gyradius_pitch * x,
            gyradius_yaw=self.loading.gyradius_yaw * x,
        )
        return replace(
            self,
            length_pp=float(new[0]),
            beam=float(new[1]),
            draft=float(new[2]),
            trim_by_stern=self.trim_by_stern * z,
            loading=loading,
            shape=self.shape.scaled(factors),
            published={},
            supplementary=_froude_scaled(self.supplementary, factors),
            appendages=self.appendages.scaled(factors),
        )

    def panel(
        self, area: float, *, draft: float | None = None, trim_by_stern: float | None = None
    ) -> PanelMesh:
        """Closed mesh of panels of nominal `area` [m2], none of which straddles the water at rest.

        That water is the plane z = draft - x trim_by_stern / length_pp; both in m, by default the
        form's own. Raises PanelsimError where area, draft or trim do not suit the hull.
        """
        draft = self.draft if draft is None else draft
        trim = self.trim_by_stern if trim_by_stern is None else trim_by_stern
        _require_positive({"panel area": area, "draft": draft})
        if not np.isfinite(trim):
            raise PanelsimError("The trim by the stern is not a number", got=trim, allowed="metres")
        return self.shape.panel(area, Waterline(draft, trim / self.length_pp))

    def fingerprint(self) -> str:
        """A hash of the form and its waterline, the same whatever the panels and the loading."""
        dimensions = [self.length_pp, self.beam, self.draft, self.trim_by_stern]
        # Rounded far below any tolerance of shipbuilding, lest another machine's last bit change the hash.
        numbers = np.round(np.concatenate([dimensions, self.shape.signature()]), 9) + 0.0
        kind = type(self.shape).__name__.encode()
        return hashlib.sha256(kind + np.ascontiguousarray(numbers, dtype="<f8").tobytes()).hexdigest()[:16]


def load_hull(name_or_path: str | Path) -> HullForm:
    """The hull form of a bundled name, or of a folder that holds particulars.toml.

    Raises PanelsimError for a name that is not bundled, with the nearest that is, and for a file that
    is not as it should be.
    """
    folder = hull_folder(name_or_path)
    particulars = read_particulars(folder)
    if particulars.form_kind == "scaled_from":
        length, beam, draft = (particulars.dimensions[name] for name in ("length_pp", "beam", "draft"))
        parent = load_hull(_require_bundled(particulars.form["scaled_from"], folder))
        stretched = parent.scaled(length=length, beam=beam, draft=draft)
        shape, inherited = stretched.shape, stretched.appendages
    else:
        shape, inherited = build_shape(folder, particulars), Appendages()
    return HullForm(
        name=folder.name,
        title=particulars.title,
        source=particulars.source,
        assumptions=particulars.assumptions,
        **particulars.dimensions,
        loading=particulars.loading,
        shape=shape,
        published=particulars.published,
        supplementary=particulars.supplementary,
        appendages=inherited if particulars.appendages is None else particulars.appendages,
    )


def hull_folder(name_or_path: str | Path) -> Path:
    """The folder of a bundled hull, or the folder given; raises PanelsimError when it is neither."""
    bundled = _bundled_hulls() / name_or_path
    if str(name_or_path) in bundled_hull_names():
        return bundled
    if (Path(name_or_path) / FILE_NAME).is_file():
        return Path(name_or_path).resolve()
    near = difflib.get_close_matches(str(name_or_path), bundled_hull_names(), n=1)
    raise PanelsimError(
        "There is no such hull",
        got=name_or_path,
        allowed=f"{', '.join(bundled_hull_names())}, or a folder that holds {FILE_NAME}",
        remedy=f"did you mean {near[0]}?" if near else None,
    )


def hull_files(folder: Path) -> tuple[Path, ...]:
    """The files of a hull folder that `load_hull` reads: the particulars, and offsets that they name."""
    read = [folder / FILE_NAME]
    with contextlib.suppress(PanelsimError):  # of particulars that are not as they should be no more is read
        offsets = read_particulars(folder).form.get("offsets")
        read += [folder / offsets] if isinstance(offsets, str) else []
    return tuple(path for path in read if path.is_file())


def bundled_hull_names() -> tuple[str, ...]:
    """Names of the hulls that travel with panelsim, in alphabetical order."""
    return tuple(sorted(path.parent.name for path in _bundled_hulls().glob(f"*/{FILE_NAME}")))


def _require_bundled(name: str, folder: Path) -> str:
    if name not in bundled_hull_names() or name == folder.name:
        raise PanelsimError(
            f"{folder / FILE_NAME}: scaled_from does not name another bundled hull",
            got=name,
            allowed=", ".join(bundled_hull_names()),
        )
    return name


def _bundled_hulls() -> Path:
    """`bundled_hulls` inside the installed package, `hulls` beside it in a checkout."""
    package = Path(__file__).resolve().parents[1]
    installed = package / "bundled_hulls"
    return installed if installed.is_dir() else package.parent / "hulls"


def _require_positive(values: dict[str, float]) -> None:
    for name, value in values.items():
        if not (np.isfinite(value) and value > 0.0):
            raise PanelsimError(f"The {name} is not positive", got=value, allowed="a number above 0")


def _froude_scaled(
    supplementary: dict[str, dict[str, float]], factors: FloatArray
) -> dict[str, dict[str, float]]:
    """Stiffness and damping for the stretched ship: mass with the volume, time with the root of the length.

    Forces and moments go with the inertia they act on: mass, mass beam² (roll), mass length² (pitch, yaw).
    """
    length, beam, _ = factors
    mass = float(np.prod(factors))
    inertia = {"roll": mass * beam**2, "pitch": mass * length**2, "yaw": mass * length**2}
    per_time = {"stiffness": 1.0 / length, "damping": 1.0 / np.sqrt(length)}
    return {
        kind: {dof: value * float(inertia.get(dof, mass) * per_time[kind]) for dof, value in values.items()}
        for kind, values in supplementary.items()
    }
