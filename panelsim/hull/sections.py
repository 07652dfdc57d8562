"""The lines of a hull: sections from a table of offsets, stem and stern profile."""

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.curve import Curve, Waterline, split_at_waterline, without_repeats
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.panelling import panel_lines
from panelsim.hull.side_surface import SideSurface

OFFSET_COLUMNS = ["x", "half_breadth", "height"]


@dataclass(frozen=True, eq=False)
class HullLines:
    """Port side of a hull in hull axes [m].

    `sections`: polylines (P, 3) from keel to deck edge, each constant in x, ordered forward. `stem`:
    polyline (P, 3) on the centreline from the keel to the tip of the deck. `stern`: likewise from the
    keel to the deck, or with a `transom` to the foot of the aftmost section (may be empty then).
    """

    sections: tuple[FloatArray, ...]
    stem: FloatArray
    stern: FloatArray
    transom: bool

    def __post_init__(self) -> None:
        for name, curve in (("stem", self.stem), ("stern", self.stern), *self._named_sections()):
            if len(curve) and (not np.all(np.isfinite(curve)) or np.any(np.diff(curve[:, 2]) < 0.0)):
                raise PanelsimError(
                    f"The heights of the {name} do not run upwards",
                    got=np.round(curve[:, 2], 3).tolist(),
                    allowed="finite heights from the keel to the deck, none below the one before",
                )
        x = np.array([section[0, 0] for section in self.sections])
        if len(x) < 2 or np.any(np.diff(x) <= 0.0):
            raise PanelsimError(
                "The sections are not ordered along the hull",
                got=x.tolist(),
                allowed="at least two, from the stern forward, each x [m from midships] once",
            )

    def _named_sections(self) -> list[tuple[str, FloatArray]]:
        return [(f"section at x = {section[0, 0]:g} m", section) for section in self.sections]

    def scaled(self, factors: FloatArray) -> Self:
        """The lines stretched by factors (3,) along x, y and z."""
        sections = tuple(section * factors for section in self.sections)
        return type(self)(sections, self.stem * factors, self.stern * factors, self.transom)

    def panel(self, area: float, waterline: Waterline) -> PanelMesh:
        """Closed mesh of nominal panel area [m2], see `panel_lines`."""
        foot = self.sections[0][0] if self.transom else None
        return panel_lines(self.sections, self.aft, self.stem, foot, area, waterline)

    @property
    def aft(self) -> FloatArray:
        """The end (P, 3) [m] from the keel to the deck: the stern profile, then the edge of a transom."""
        if not self.transom:
            return self.stern
        return without_repeats(np.vstack([self.stern, self.sections[0]]))

    def wet_side(self, waterline: Waterline) -> SideSurface | None:
        """The port side under water, which its panels follow ever closer as they shrink.

        None where the water passes the deck, the stem or the stern by.
        """
        wet, dry = zip(
            *(split_at_waterline(line, waterline) for line in (self.aft, *self.sections, self.stem)),
            strict=True,
        )
        if min(len(part) for part in (wet[0], wet[-1], *dry)) < 2:
            return None
        ends = Curve.by_arc_length(wet[0]), Curve.by_arc_length(wet[-1])
        return SideSurface.through(list(wet[1:-1]), *ends, waterline_at=1.0)

    def signature(self) -> FloatArray:
        """Every number that defines the lines, in one row."""
        return np.concatenate([c.ravel() for c in (*self.sections, self.stem, self.stern)])


def read_offsets(path: Path) -> tuple[FloatArray, ...]:
    """Sections of an `offsets.csv`: x, half_breadth, height [m] a line, keel to deck, `#` comments.

    Lines of equal x make one section (P, 3). Raises PanelsimError naming file and line.
    """
    with path.open(newline="", encoding="utf-8") as file:
        numbered = [(number, line) for number, line in enumerate(file, 1) if not line.startswith("#")]
    rows = list(csv.reader(line for _, line in numbered))
    if not rows or rows[0] != OFFSET_COLUMNS:
        raise PanelsimError(
            f"{path} does not begin with its column names",
            got=rows[0] if rows else "an empty file",
            allowed=",".join(OFFSET_COLUMNS),
        )
    sections: dict[float, list[tuple[float, float, float]]] = {}
    for (number, _), row in zip(numbered[1:], rows[1:], strict=True):
        x, half_breadth, height = _offsets(row, path, number)
        sections.setdefault(x, []).append((x, half_breadth, height))
    return tuple(without_repeats(np.array(sections[x])) for x in sorted(sections))


def _offsets(row: list[str], path: Path, number: int) -> tuple[float, float, float]:
    try:
        x, half_breadth, height = map(float, row)
    except ValueError:
        x = half_breadth = height = float("nan")
    if not np.all(np.isfinite([x, half_breadth, height])) or half_breadth < 0.0:
        raise PanelsimError(
            f"{path}, line {number} is not a point of a section",
            got=",".join(row),
            allowed="three finite numbers in metres, the half-breadth not negative",
        )
    return x, half_breadth, height
