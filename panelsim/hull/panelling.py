"""From the lines of a hull to panels: rows along the girth, columns along the length, deck, transom."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.closure import PortHalf
from panelsim.hull.curve import Curve, Waterline, split_at_waterline
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.side_surface import SideSurface, keep_section_areas

# The wet panels behind TM 2003-190 Table 3 measure 0.88 to 0.95 of what the table calls their nominal size.
MEAN_OVER_NOMINAL_AREA = 0.92
# Bilges bend more along the girth than waterlines along the length: panels are longer than high.
LENGTH_OVER_HEIGHT = 1.6
FEWEST_WET_PANELS_A_SIDE, MOST_WET_PANELS_A_SIDE = 16, 50_000
FINE_COLUMNS, FINE_ROWS = 96, 256  # of the grids that measure the hull before it is panelled


@dataclass(frozen=True)
class Counts:
    """Panels along the length and along the girth of the port side, and the width of deck panels [m]."""

    columns: int
    wet_rows: int
    dry_rows: int
    deck_width: float


class EndMissesWater(PanelsimError):
    """The water at rest passes the bow or the stern by, so that no row of panels can follow it there."""


def panel_lines(
    sections: tuple[FloatArray, ...],
    aft: FloatArray,
    fore: FloatArray,
    transom_foot: FloatArray | None,
    area: float,
    waterline: Waterline,
) -> PanelMesh:
    """Closed mesh of a hull, with a row of vertices on the waterline at rest; hull axes, m.

    `sections`: polylines (P, 3) of the port side, keel to deck, constant in x, ordered forward; `aft`,
    `fore`: the ends, polylines (P, 3) from the keel to the deck; `transom_foot` (3,): where the
    transom begins, None for a hull that ends in a sternpost; `area`: nominal panel area [m2].
    Raises PanelsimError where `area` or the waterline do not suit the hull.
    """
    wet_parts, dry_parts = _cut_sections(sections, waterline)
    (aft_wet, aft_dry), (fore_wet, fore_dry) = _cut_ends(aft, fore, waterline)
    wet = SideSurface.through(wet_parts, Curve.by_arc_length(aft_wet), Curve.by_arc_length(fore_wet), 1.0)
    dry = SideSurface.through(dry_parts, Curve.by_arc_length(aft_dry), Curve.by_arc_length(fore_dry), 0.0)
    counts = _count_panels(wet, dry, area)
    if transom_foot is not None:
        wet = _with_transom_row(wet, wet_parts, transom_foot, counts.wet_rows)
        dry = _with_transom_row(dry, dry_parts, transom_foot, counts.dry_rows)
    return _close(_side_grid(wet, dry, counts, waterline), counts)


def _cut_sections(
    sections: tuple[FloatArray, ...], waterline: Waterline
) -> tuple[list[FloatArray], list[FloatArray]]:
    """Wet and dry parts of the sections; the deck must be dry everywhere."""
    parts = [split_at_waterline(section, waterline) for section in sections]
    for section, (_, dry_part) in zip(sections, parts, strict=True):
        if len(dry_part) < 2:
            raise PanelsimError(
                f"The deck is under water at rest at x = {section[0, 0]:.2f} m from midships",
                got=f"the waterline at {waterline.height(section[0, 0]):.3f} m above the baseline",
                allowed=f"less than the deck edge at {section[-1, 2]:.3f} m",
                remedy="choose a smaller draft or trim",
            )
    return [wet_part for wet_part, _ in parts], [dry_part for _, dry_part in parts]


def _cut_ends(aft: FloatArray, fore: FloatArray, waterline: Waterline) -> list[tuple[FloatArray, FloatArray]]:
    """Wet and dry parts of stern and stem, both of which must pierce the water."""
    ends = [split_at_waterline(end, waterline) for end in (aft, fore)]
    for name, end, parts in zip(("stern", "stem"), (aft, fore), ends, strict=True):
        if any(len(part) < 2 for part in parts):
            raise EndMissesWater(
                f"The water at rest does not reach the {name} between its lowest point and the deck",
                got=f"the waterline at {waterline.height(end[0, 0]):.3f} m above the baseline there",
                allowed=f"more than {end[0, 2]:.3f} m, less than {end[-1, 2]:.3f} m",
                remedy="choose another draft or trim (a transom must be immersed at rest)",
            )
    return ends


def _with_transom_row(side: SideSurface, parts: list[FloatArray], foot: FloatArray, rows: int) -> SideSurface:
    """The side with one of its rows at the foot (3,) of a transom, which would be cut off otherwise."""
    inside = np.any(np.all(side.aft.points[1:-1] == foot, axis=1))
    if not inside or rows < 2:
        return side
    return SideSurface.through(parts, side.aft.with_corner(foot, rows), side.fore, side.waterline_at)


def _count_panels(wet: SideSurface, dry: SideSurface, area: float) -> Counts:
    """Counts that make the mean panel suit the nominal `area` [m2] on each part of the hull."""
    length = wet.fore.points[-1, 0] - wet.aft.points[-1, 0]
    wet_area, dry_area = _fine_area(wet), _fine_area(dry)
    mean = MEAN_OVER_NOMINAL_AREA * area
    smallest = wet_area / MEAN_OVER_NOMINAL_AREA / MOST_WET_PANELS_A_SIDE
    largest = wet_area / MEAN_OVER_NOMINAL_AREA / FEWEST_WET_PANELS_A_SIDE
    if not smallest <= area <= largest:
        raise PanelsimError(
            "The panel area does not suit this hull",
            got=f"{area:g} m2",
            allowed=f"{smallest:.3g} to {largest:.3g} m2 at this draft (wet side of {wet_area:.4g} m2)",
            remedy="choose a panel area in that range; wet area / 400 is a good beginning",
        )
    wet_rows = max(2, round(wet_area / length / np.sqrt(mean / LENGTH_OVER_HEIGHT)))
    columns = round(wet_area / (wet_rows * mean))
    dry_rows = max(1, round(dry_area / (columns * mean)))
    return Counts(columns, wet_rows, dry_rows, deck_width=mean * columns / length)


def _fine_area(side: SideSurface) -> float:
    """Area of one side [m2], from a fine grid."""
    points = side.points(side.stations(FINE_COLUMNS), np.linspace(0.0, 1.0, FINE_ROWS + 1))
    diagonals = points[1:, 1:] - points[:-1, :-1], points[1:, :-1] - points[:-1, 1:]
    return float(0.5 * np.linalg.norm(np.cross(*diagonals), axis=-1).sum())


def _side_grid(wet: SideSurface, dry: SideSurface, counts: Counts, waterline: Waterline) -> FloatArray:
    """Vertices (columns + 1, wet rows + dry rows + 1, 3) of the port side, keel to deck, stern to bow."""
    x = wet.stations(counts.columns)
    fine = np.linspace(0.0, 1.0, FINE_ROWS + 1)
    below, above = (
        keep_section_areas(side.points(x, np.linspace(0.0, 1.0, rows + 1)), side.points(x, fine))
        for side, rows in ((wet, counts.wet_rows), (dry, counts.dry_rows))
    )
    below[:, -1, 2] = waterline.height(below[:, -1, 0])
    return np.concatenate([below, above[:, 1:]], axis=1)


def _close(side: FloatArray, counts: Counts) -> PanelMesh:
    """The whole hull from the vertices of its port side: panels, deck, transom, mirror."""
    hull = PortHalf()
    index = np.reshape(hull.add(side.reshape(-1, 3)), side.shape[:2])
    for aft, fore in pairwise(index):
        hull.strip(list(aft), list(fore))
    # The transom begins at the highest point of the stern on the centreline; below the waterline
    # one strip closes it from its outline up to the water, above there is a row a panel.
    foot = int(np.flatnonzero(side[0, :, 1] == 0.0)[-1])
    first_row = max(foot + 1, counts.wet_rows)
    transom = [list(index[0, foot:first_row])]
    transom += [hull.across(edge, counts.deck_width) for edge in index[0, first_row:]]
    for lower, upper in pairwise(transom):
        hull.strip(upper, lower)
    deck = [transom[-1], *(hull.across(edge, counts.deck_width) for edge in index[1:, -1])]
    for aft_row, fore_row in pairwise(deck):
        hull.strip(fore_row, aft_row)
    return hull.mirrored()
