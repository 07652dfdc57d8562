"""A body plan of the wet sections of a ship with their Lewis forms laid over."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from panelsim.conventions import FloatArray
from panelsim.hydro.strip.lewis import LewisForm, nearest_lewis_form
from panelsim.hydro.strip.mesh_sections import sections_of_mesh
from panelsim.hydro.strip.sections import HullSections, Section
from panelsim.ship.ship import Ship
from panelsim.view.plots import INK, plain, save

SECTIONS = 20
WIDTH, AREAS_HEIGHT = 10.0, 3.2  # inches
HULL, LEWIS, NEAREST = INK, "#2a7fb8", "#c8443c"
AREA_KEPT = 1e-9  # of a section's area: a difference below it is rounding


def section_picture(ship: Ship, path: Path) -> Path:
    """Draw a body plan into a PNG file: 20 sections, aft on the left, fore on the right, and areas below.

    Each section has the Lewis form of its breadth, draft and area over it; where none has that area the
    nearest, in another colour; none where the section is under water or uneven. Raises
    PanelsimError where the hull cannot be cut into sections.
    """
    sections = sections_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, SECTIONS)
    forms = [_lewis(section) for section in sections.sections]
    draft = max(section.draft for section in sections.sections)
    breadth = max(float(np.ptp(section.points[:, 0])) for section in sections.sections)
    plan_height = WIDTH * min(draft / breadth, 1.0) + 1.0  # the plan keeps its proportions, and has a legend
    figure = Figure(figsize=(WIDTH, plan_height + AREAS_HEIGHT), layout="constrained")
    plan, curve = figure.subplots(2, 1, height_ratios=[plan_height, AREAS_HEIGHT])
    figure.suptitle(f"{ship.name}: {SECTIONS} sections at rest and their Lewis forms")
    _draw_plan(plan, sections, forms)
    _draw_areas(curve, sections, forms)
    return save(figure, path)


def _lewis(section: Section) -> tuple[LewisForm, bool] | None:
    """The Lewis form of a section, and whether it has its area; None where there is none."""
    if section.submerged or not section.symmetric or section.breadth == 0.0:
        return None
    form, excess = nearest_lewis_form(section)
    return form, abs(excess) <= AREA_KEPT * section.area


def _draw_plan(axis: Axes, sections: HullSections, forms: list[tuple[LewisForm, bool] | None]) -> None:
    plain(axis)
    for index, (section, form) in enumerate(zip(sections.sections, forms, strict=True)):
        side = 1.0 if index >= SECTIONS // 2 else -1.0
        _draw_half(axis, section.points, section.waterline, side, HULL)
        if form is not None:
            _draw_half(axis, form[0].points(), section.waterline, side, LEWIS if form[1] else NEAREST)
    axis.axhline(0.0, color=INK, linewidth=0.8)
    axis.axvline(0.0, color=INK, linewidth=1.1, zorder=3)
    axis.set_aspect("equal")
    axis.xaxis.set_major_formatter(lambda y, _: f"{abs(y):g}")
    axis.set_xlabel("aft ←   half-breadth [m]   → fore")
    axis.set_ylabel("above the water at rest [m]")
    names = {HULL: "section of the mesh", LEWIS: "Lewis form of its breadth, draft and area"}
    if any(form is not None and not form[1] for form in forms):
        names[NEAREST] = "nearest Lewis form, of another area"
    for color, name in names.items():
        axis.plot([], [], color=color, linestyle=_style(color), label=name)
    axis.legend(fontsize=9, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)


def _style(color: str) -> str:
    return "-" if color == HULL else "--"


def _draw_half(axis: Axes, points: FloatArray, waterline: float, side: float, color: str) -> None:
    """The port half of an outline (P, 2), to the right where side is 1, to the left where it is -1."""
    # The other half is laid on the centreline, which is drawn anyway.
    half_breadth = np.maximum(points[:, 0], 0.0)
    axis.plot(
        side * half_breadth, points[:, 1] - waterline, color=color, linewidth=1.1, linestyle=_style(color)
    )


def _draw_areas(axis: Axes, sections: HullSections, forms: list[tuple[LewisForm, bool] | None]) -> None:
    plain(axis)
    area = [section.area for section in sections.sections]
    axis.plot(sections.x, area, color=HULL, linewidth=1.1, marker=".")
    for x, form in zip(sections.x, forms, strict=True):
        if form is not None:
            axis.plot(
                x, form[0].area, "o", color=LEWIS if form[1] else NEAREST, fillstyle="none", markersize=7
            )
    axis.set_xlim(sections.aft_end, sections.fore_end)
    axis.set_ylim(bottom=0.0)
    axis.set_xlabel("forward of the CG [m]")
    axis.set_ylabel("area under water [m²]")
