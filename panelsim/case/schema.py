"""The tables and keys of a case file, and what each may hold."""

import math
from typing import Annotated, Any, Literal

from pydantic import Field, field_validator, model_validator

from panelsim.case.seaway_schema import SeawaySection
from panelsim.case.section import Degrees, Finite, KeyFault, NotNegative, Place, Positive, Section
from panelsim.conventions import STANDARD_GRAVITY

# A run keeps some 400 bytes a step.
MOST_STEPS = 2_000_000


class MeshSection(Section):
    """[ship.mesh]: unit and axes of a mesh file, as for `read_mesh`."""

    length_unit: str | float
    up: str
    forward: str
    origin: list[Finite] = Field(default_factory=lambda: [0.0, 0.0, 0.0], min_length=3, max_length=3)
    symmetry: Literal["centreline"] | None = None

    @field_validator("length_unit", mode="plain")
    @classmethod
    def _unit(cls, value: Any) -> str | float:
        """A union of types would be told to the user as two faults."""
        if isinstance(value, str):
            return value
        if isinstance(value, bool) or not isinstance(value, float | int):
            raise ValueError("neither a unit nor the metres in one file unit")
        return float(value)


class ShipSection(Section):
    """[ship]: a hull and, where it differs from the hull's particulars, its loading."""

    hull: Annotated[str, Field(min_length=1)]
    panel_area: Positive | None = None  # m2
    mesh: MeshSection | None = None
    draft: Positive | None = None  # m, at midships
    trim_by_stern: Finite | None = None  # m
    mass: Positive | None = None  # kg
    center_of_gravity_x: Finite | None = None  # m forward of midships
    center_of_gravity_height: Finite | None = None  # m above the baseline
    gyradius_roll: Positive | None = None  # m
    gyradius_pitch: Positive | None = None
    gyradius_yaw: Positive | None = None
    water_density: Annotated[float, Field(ge=900, le=1100)] | None = None  # kg/m3
    gravity: Annotated[float, Field(ge=9.7, le=9.9)] = STANDARD_GRAVITY  # m/s2


class HydrodynamicsSection(Section):
    """[hydrodynamics]: how coefficients are computed, or the file that holds them; the transom."""

    method: Literal["bem", "strip"] = "bem"
    section_form: Literal["close-fit", "lewis"] = "close-fit"
    file: Annotated[str, Field(min_length=1)] | None = None
    transom_terms: bool = False

    @model_validator(mode="after")
    def _section_form(self) -> "HydrodynamicsSection":
        if self.section_form != "close-fit" and (self.method != "strip" or self.file is not None):
            raise ValueError(f'section_form = "{self.section_form}" needs method = "strip", and no file')
        return self


class RunSection(Section):
    """[run]: speed, model, time."""

    speed_knots: Annotated[float, Field(ge=0, le=60)]
    ship_heading_deg: Degrees | None = None
    model: Literal["nonlinear", "linear"] = "nonlinear"
    inertia: Literal["large", "linear"] | None = None  # by default that of the model
    stepper: Literal["exponential", "rk4", "ab3"] = "exponential"
    time_step: Annotated[float, Field(ge=1e-4, le=5)]  # s
    duration: Annotated[float, Field(gt=0, le=1e6)]  # s, after the ramp
    ramp: Annotated[float, Field(ge=0, le=1e5)] = 60.0  # s
    capsize_angle_deg: Annotated[float, Field(ge=0, le=180)] = 90.0
    pressure_method: Literal["auto", "direct", "grid", "oracle"] = "auto"
    pressure_rule: Literal["vertex+centre", "vertex", "panel"] = "vertex+centre"

    @model_validator(mode="after")
    def _inertia(self) -> "RunSection":
        if self.model == "linear" and self.inertia == "large":
            raise KeyFault(
                "the linear model has the inertia of small angles",
                got='model = "linear" with inertia = "large"',
                allowed='inertia = "linear", or none given',
                remedy="leave run.inertia out",
            )
        return self

    @model_validator(mode="after")
    def _steps(self) -> "RunSection":
        if self.duration < self.time_step:
            raise KeyFault(
                f"the duration of {self.duration:g} s is shorter than one time_step",
                got=f"duration = {self.duration:g}, time_step = {self.time_step:g}",
                allowed="a duration of one time step or more",
                remedy="set a longer run.duration",
            )
        if self.steps > MOST_STEPS:
            raise KeyFault(
                f"{self.steps} time steps are more than the {MOST_STEPS} that one run may have",
                got=f"ramp = {self.ramp:g}, duration = {self.duration:g}, time_step = {self.time_step:g}",
                allowed=f"at most {MOST_STEPS} steps",
                remedy="shorten run.duration, or set a longer run.time_step",
            )
        return self

    @property
    def steps(self) -> int:
        return math.ceil((self.ramp + self.duration) / self.time_step - 1e-9)


class ByMotion(Section):
    """A value for some of the six motions."""

    surge: NotNegative | None = None
    sway: NotNegative | None = None
    heave: NotNegative | None = None
    roll: NotNegative | None = None
    pitch: NotNegative | None = None
    yaw: NotNegative | None = None

    def values(self) -> dict[str, float]:
        return self.model_dump(exclude_none=True)


class SupplementarySection(Section):
    """[supplementary]: a table given here replaces that of the hull's particulars; an empty one is none."""

    stiffness: ByMotion | None = None
    damping: ByMotion | None = None


class RollDampingSection(Section):
    """[roll_damping]: damping of roll by viscosity and lift, and how it is found."""

    method: Literal["none", "percent", "terms", "ikeda"] = "none"
    critical_percent: Annotated[float, Field(ge=0, le=100)] | None = None
    linear: NotNegative | None = None  # N m s
    quadratic: NotNegative | None = None  # N m s2
    cubic: NotNegative | None = None  # N m s3
    linearised_at_deg: Annotated[float, Field(gt=0, le=90)] | None = None  # for the linear model

    @model_validator(mode="after")
    def _keys_of_the_method(self) -> "RollDampingSection":
        own = {"percent": ("critical_percent",), "terms": ("linear", "quadratic", "cubic")}
        wanted = own.get(self.method, ())
        given = [name for keys in own.values() for name in keys if getattr(self, name) is not None]
        strange = [name for name in given if name not in wanted]
        if strange:
            raise KeyFault(
                f'{", ".join(strange)} has no meaning with method = "{self.method}"',
                got=", ".join(f"{name} = {getattr(self, name):g}" for name in strange),
                allowed=", ".join((*wanted, "linearised_at_deg")) if wanted else "no key of another method",
                remedy=f"leave {', '.join(strange)} out, or set roll_damping.method to "
                + " or ".join(f'"{method}"' for method, keys in own.items() if set(strange) & set(keys)),
            )
        if wanted and not given:
            raise KeyFault(
                f'method = "{self.method}" needs {" or ".join(wanted)}',
                got="none of them" if len(wanted) > 1 else f"no {wanted[0]}",
                allowed="0 to 100 % of critical" if self.method == "percent" else "N m sⁿ, 0 or more",
                remedy=f"set roll_damping.{wanted[0]}"
                + (", for example to 5" if self.method == "percent" else ", for example to 1e7"),
            )
        return self


class CaseFile(Section):
    """The whole file; `points` are [x, y, z] of the ship by name."""

    ship: ShipSection
    hydrodynamics: HydrodynamicsSection = HydrodynamicsSection()
    seaway: SeawaySection
    run: RunSection
    supplementary: SupplementarySection = SupplementarySection()
    roll_damping: RollDampingSection = RollDampingSection()
    points: dict[str, Place] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _stokes(self) -> "CaseFile":
        if self.seaway.wave_theory == "stokes" and self.run.pressure_method == "grid":
            raise ValueError(
                "a Stokes wave goes on no grid: set run.pressure_method to auto or direct,"
                " or seaway.wave_theory to linear"
            )
        return self

    @model_validator(mode="after")
    def _course(self) -> "CaseFile":
        if self.seaway.needs_course and self.run.ship_heading_deg is None:
            raise ValueError(
                "the seaway has compass directions (sea_direction_deg, or those of its spectrum) and"
                " needs the ship's course: set run.ship_heading_deg"
            )
        return self
