"""Lewis forms: ship-like sections from breadth, draft and area by a conformal map of the circle."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.strip.sections import Section
from panelsim.seaway.checks import require_number, require_positive


@dataclass(frozen=True)
class LewisForm:
    """The section y + i(z - waterline) = M (e^{iα} + a₁ e^{-iα} + a₃ e^{-3iα}), -π ≤ α ≤ 0 (Lewis 1929).

    `scale` M [m]; `a1`, `a3`; `waterline`: height of the water at rest [m] in ship axes; `x` [m].
    """

    x: float
    scale: float
    a1: float
    a3: float
    waterline: float

    @property
    def breadth(self) -> float:
        """Breadth at the waterline [m]."""
        return 2.0 * self.scale * (1.0 + self.a1 + self.a3)

    @property
    def draft(self) -> float:
        """Depth on the centreline [m]."""
        return self.scale * (1.0 - self.a1 + self.a3)

    @property
    def area(self) -> float:
        """Area under water [m2]."""
        return 0.5 * np.pi * self.scale**2 * (1.0 - self.a1**2 - 3.0 * self.a3**2)

    @property
    def shape(self) -> str:
        """Which kind of form it is: conventional, bulbous, tunnelled, or bulbous and tunnelled.

        A bulbous form is broader below the water than at it, a tunnelled one deeper off the centreline.
        """
        kinds = []
        if 1.0 + self.a1 + 9.0 * self.a3 < 0.0:
            kinds.append("bulbous")
        if 1.0 - self.a1 + 9.0 * self.a3 < 0.0:
            kinds.append("tunnelled")
        return " and ".join(kinds) or "conventional"

    def mapped(self, alpha: FloatArray) -> ComplexArray:
        """y + i(z - waterline) [m] at angles α (...) [rad] on the circle."""
        turn = np.exp(1j * np.asarray(alpha))
        outline: ComplexArray = self.scale * (turn + self.a1 / turn + self.a3 / turn**3)
        return outline

    def points(self, count: int = 101) -> FloatArray:
        """Points (count, 2) of the outline, y and z [m] in ship axes, starboard round the keel to port."""
        outline = self.mapped(np.linspace(-np.pi, 0.0, count))
        points = np.stack([outline.real, outline.imag + self.waterline], axis=1)
        points[[0, -1], 1] = self.waterline
        return points

    def section(self, count: int = 401) -> Section:
        """The form as a section, for solvers of any shape."""
        return Section(self.x, self.points(count), self.waterline)


def lewis_form(
    breadth: float, draft: float, area: float, *, waterline: float = 0.0, x: float = 0.0
) -> LewisForm:
    """The Lewis form of a breadth, draft [m] and area [m2] under water.

    Of the two roots for a₃ the one of ship-like forms (von Kerczek and Tuck 1969). Raises PanelsimError where
    the area makes no form: too small, the outline would cross the centreline or the water (re-entrant);
    too large, there is no root.
    """
    for name, value, unit in (("breadth", breadth, "m"), ("draft", draft, "m"), ("area", area, "m2")):
        require_positive(f"The {name} of a Lewis form", value, unit)
    require_number("waterline of a Lewis form", waterline, "m")
    require_number("x of a Lewis form", x, "m")
    least, most = lewis_area_range(breadth, draft)
    if not least <= area <= most:
        raise PanelsimError(
            f"No Lewis form has this area: it would be {'re-entrant' if area < least else 'too full'}",
            got=f"{area:.4g} m2 for breadth {breadth:.4g} and draft {draft:.4g} m at x = {x:g} m",
            allowed=f"{least:.4g} to {most:.4g} m2",
            remedy="use the close-fit method, or the nearest Lewis form",
        )
    slenderness = (0.5 * breadth - draft) / (0.5 * breadth + draft)
    fullness = 4.0 / np.pi * area / (breadth * draft)
    c = 3.0 + fullness + (1.0 - fullness) * slenderness**2
    a3 = (3.0 - c + np.sqrt(max(9.0 - 2.0 * c, 0.0))) / c
    a1 = slenderness * (1.0 + a3)
    return LewisForm(float(x), float(0.5 * breadth / (1.0 + a1 + a3)), float(a1), float(a3), float(waterline))


def nearest_lewis_form(section: Section) -> tuple[LewisForm, float]:
    """The Lewis form of a section's breadth and draft, and the area [m2] that it has more than the section.

    That is 0 unless no Lewis form has the section's area; then the area is the nearest that one has.
    Raises PanelsimError for a section that is not symmetric or wholly under water.
    """
    if section.submerged or not section.symmetric or section.breadth == 0.0:
        raise PanelsimError(
            f"The section at x = {section.x:g} m has no Lewis form",
            got="a section under water or without breadth there" if section.symmetric else "unequal sides",
            allowed="a symmetric section that pierces the water",
            remedy="use the close-fit method",
        )
    area = float(np.clip(section.area, *lewis_area_range(section.breadth, section.draft)))
    form = lewis_form(section.breadth, section.draft, area, waterline=section.waterline, x=section.x)
    return form, area - section.area


def lewis_area_range(breadth: float, draft: float) -> tuple[float, float]:
    """Least and greatest area [m2] of a Lewis form.

    Least where the outline leaves the keel along the centreline, 1 + a₁ = 3 a₃, or the water along
    it, 1 - a₁ = 3 a₃; greatest where the two roots for a₃ meet.
    """
    ratio = 0.5 * breadth / draft
    least = 3.0 * np.pi / 32.0 * (2.0 - min(ratio, 1.0 / ratio))
    most = np.pi / 32.0 * (10.0 + ratio + 1.0 / ratio)
    return least * breadth * draft, most * breadth * draft
