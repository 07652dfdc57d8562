"""What Ikeda's method needs to know of a hull: particulars and the immersed sections."""

from dataclasses import dataclass, fields
from typing import Self

import numpy as np

from panelsim.conventions import SALT_WATER_DENSITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.curve import Waterline, split_at_waterline
from panelsim.hull.sections import HullLines
from panelsim.seaway.checks import require_number, require_positive

SALT_WATER_VISCOSITY = 1.19e-6  # m2/s at 15 °C, ITTC 7.5-02-01-03


@dataclass(frozen=True, eq=False)
class ImmersedSections:
    """Sections below the calm water, arrays (S,) ordered from the stern forward.

    `x` in hull axes, `beam` at the waterline, `draft` down to the lowest point [m], `area` both sides [m2].
    """

    x: FloatArray
    beam: FloatArray
    draft: FloatArray
    area: FloatArray

    def __post_init__(self) -> None:
        for field in fields(self):
            values = np.array(getattr(self, field.name), dtype=float)
            values.setflags(write=False)
            object.__setattr__(self, field.name, values)
            if values.ndim != 1 or len(values) < 3 or not np.all(np.isfinite(values)):
                raise PanelsimError(
                    f"The {field.name} of the sections is not a list of numbers",
                    got=f"shape {values.shape}",
                    allowed="three finite numbers or more",
                )
        if not (self.x.shape == self.beam.shape == self.draft.shape == self.area.shape):
            raise PanelsimError("x, beam, draft and area of the sections are not equally many")
        if np.any(np.diff(self.x) <= 0.0):
            raise PanelsimError("The sections are not ordered from the stern forward", got=self.x.tolist())
        box = self.beam * self.draft
        wrong = (self.beam <= 0.0) | (self.draft <= 0.0) | (self.area <= 0.0) | (self.area > box * (1 + 1e-9))
        if np.any(wrong):
            raise PanelsimError(
                "A section has no beam, draft or area, or more area than beam times draft",
                got=f"x = {self.x[wrong].tolist()} m",
                remedy="leave out sections that do not reach into the water",
            )

    @classmethod
    def of_lines(cls, lines: HullLines, draft: float) -> Self:
        """The sections of a hull's offsets that reach below the level waterline at `draft` [m].

        Those of a bulb, with more area than their beam at the waterline times draft, have no Lewis form and
        are left out.
        """
        draft = require_positive("The draft", draft, "m")
        rows = []
        for section in lines.sections:
            wet, _ = split_at_waterline(section, Waterline(draft, 0.0))
            if len(wet) > 1 and wet[0, 2] < draft and wet[-1, 1] > 0.0:
                # Twice the half-breadth over the height; a flat bottom adds nothing.
                area = 2.0 * np.trapezoid(wet[:, 1], wet[:, 2])
                beam, depth = 2.0 * wet[-1, 1], draft - wet[0, 2]
                if area <= beam * depth:
                    rows.append((wet[0, 0], beam, depth, area))
        return cls(*np.array(rows).reshape(-1, 4).T)

    @property
    def coefficient(self) -> FloatArray:
        """Area over beam times draft σ (S,)."""
        return self.area / (self.beam * self.draft)


@dataclass(frozen=True, eq=False)
class RollingHull:
    """A hull as Ikeda's method sees it; lengths [m] at the waterline of the calm water.

    `block_coefficient` and `midship_coefficient` of the immersed hull; `center_of_gravity_height` above the
    baseline [m]; `water_density` [kg/m3], `kinematic_viscosity` [m2/s].
    """

    length_pp: float
    beam: float
    draft: float
    block_coefficient: float
    midship_coefficient: float
    center_of_gravity_height: float
    sections: ImmersedSections
    water_density: float = SALT_WATER_DENSITY
    kinematic_viscosity: float = SALT_WATER_VISCOSITY

    def __post_init__(self) -> None:
        for name in ("length_pp", "beam", "draft", "water_density", "kinematic_viscosity"):
            require_positive(f"The {name} of the rolling hull", getattr(self, name), "SI")
        require_number("height of the centre of gravity", self.center_of_gravity_height, "m")
        for name in ("block_coefficient", "midship_coefficient"):
            require_number(name, getattr(self, name), "", low=1e-3, high=1.0)
        if not isinstance(self.sections, ImmersedSections):
            raise PanelsimError("sections is not ImmersedSections", got=type(self.sections).__name__)

    @property
    def axis_depth(self) -> float:
        """OG: how far the roll axis, taken at the centre of gravity, lies below the calm water [m]."""
        return self.draft - self.center_of_gravity_height

    @property
    def displaced_volume(self) -> float:
        """C_B L B d [m3]."""
        return self.block_coefficient * self.length_pp * self.beam * self.draft


def nondimensional(hull: RollingHull, damping: FloatArray, gravity: float) -> FloatArray:
    """B̂ = B/(ρ ∇ B²) √(B/2g) of a damping B44 (...) [N m s]."""
    scale = hull.water_density * hull.displaced_volume * hull.beam**2
    return damping / scale * float(np.sqrt(hull.beam / (2.0 * gravity)))
