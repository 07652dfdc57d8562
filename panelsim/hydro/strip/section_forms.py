"""Which outline stands for a section: its own, close-fitted, or the Lewis form of its three dimensions."""

from typing import Literal, get_args

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.strip.contour import Contour, contour_nodes
from panelsim.hydro.strip.frank import ELEMENTS
from panelsim.hydro.strip.lewis import LewisForm, nearest_lewis_form
from panelsim.hydro.strip.multipoles import lewis_nodes
from panelsim.hydro.strip.sections import HullSections, Section

SectionForm = Literal["close-fit", "lewis"]
SECTION_FORMS: tuple[SectionForm, ...] = get_args(SectionForm)
_VOLUME_APART = 0.02  # of the displaced volume, that Lewis forms of another area may make


def require_section_form(section_form: str) -> None:
    """Raise PanelsimError unless `section_form` is one of `SECTION_FORMS`."""
    if section_form not in SECTION_FORMS:
        raise PanelsimError(
            "This form of sections is not known", got=section_form, allowed=" | ".join(SECTION_FORMS)
        )


def lewis_forms(sections: HullSections) -> tuple[tuple[LewisForm, ...], str]:
    """The Lewis form of each section, and a sentence on those of another area, empty if there are none.

    Raises PanelsimError for a section that no Lewis form can stand for: unequal sides, wholly under water;
    and where forms that cannot have the area of their section change the displaced volume by over 2 %.
    """
    pairs = [nearest_lewis_form(section) for section in sections.sections]
    more = np.array([difference for _, difference in pairs])
    apart = np.flatnonzero(more)
    forms = tuple(form for form, _ in pairs)
    if not apart.size:
        return forms, ""
    volume = sections.strip_length @ [section.area for section in sections.sections]
    share = float(sections.strip_length @ np.abs(more)) / volume
    places = ", ".join(f"{sections.x[i]:.4g}" for i in apart)
    if share > _VOLUME_APART:
        raise PanelsimError(
            "Lewis forms do not fit this hull: they are re-entrant or too full",
            got=f"another area at x = {places} m, {100 * share:.2g} % of the displaced volume",
            allowed=f"{100 * _VOLUME_APART:g} % of the volume",
            remedy="use the close-fit form",
        )
    return forms, (
        f"No Lewis form has the area of the sections at x = {places} m: the nearest stand for them,"
        f" {100 * share:.2g} % of the displaced volume apart."
    )


def section_nodes(section: Section | LewisForm) -> FloatArray:
    """Ends (N + 1, 2) [m] of the elements that a section, or the Lewis form of one, is solved on."""
    return lewis_nodes(section) if isinstance(section, LewisForm) else contour_nodes(section, ELEMENTS)


def section_contour(section: Section | LewisForm) -> Contour:
    """The elements that a section, or the Lewis form of one, is solved on."""
    return Contour.of_nodes(section_nodes(section), section.waterline)
