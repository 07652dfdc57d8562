"""The tables and keys of a case file, and what each may hold."""

import math
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from panelsim.conventions import STANDARD_GRAVITY, FloatArray

Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Degrees = Annotated[float, Field(ge=-360, le=360)]
Frequency = Annotated[float, Field(ge=0.01, le=100)]  # rad/s: from far above any swell to ripples
Period = Annotated[float, Field(ge=0.06, le=630)]  # s: the same span

# A run keeps some 400 bytes a step.
MOST_STEPS = 2_000_000
MOST_FREQUENCIES = 5000


class Section(BaseModel):
    """A table of the case file: no key that it does not know, no text where a number belongs."""

    model_config = ConfigDict(extra="forbid", strict=True)


class MeshSection(Section):
    """[ship.mesh]: unit and axes of a mesh file, as for `read_mesh`."""

    length_unit: str | float
    up: str
    forward: str
    origin: Annotated[list[Finite], Field(min_length=3, max_length=3)] = [0.0, 0.0, 0.0]
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
    """[hydrodynamics]: how coefficients are computed, or the file that holds them."""

    method: Literal["bem"] = "bem"
    file: Annotated[str, Field(min_length=1)] | None = None


class FrequencyGrid(Section):
    """Evenly spaced wave frequencies, both ends included [rad/s]."""

    start: Frequency
    stop: Frequency
    step: Positive

    @model_validator(mode="after")
    def _rises(self) -> "FrequencyGrid":
        if self.stop <= self.start:
            raise ValueError("stop is not above start")
        if (self.stop - self.start) / self.step > MOST_FREQUENCIES:
            raise ValueError(f"the step is too small: more than {MOST_FREQUENCIES} frequencies")
        return self

    def values(self) -> FloatArray:
        count = int(np.floor((self.stop - self.start) / self.step + 1e-9)) + 1
        return self.start + self.step * np.arange(count, dtype=np.float64)


class SeawaySection(Section):
    """[seaway]: the waves. The heading is relative to the ship, or the compass direction they come from."""

    kind: Literal["random", "regular", "calm"]
    spectrum: Literal["bretschneider"] = "bretschneider"
    significant_wave_height: Annotated[float, Field(gt=0, le=50)] | None = None  # m
    peak_period: Period | None = None  # s
    frequencies: FrequencyGrid | None = None  # rad/s
    seed: Annotated[int, Field(ge=0, lt=2**63)] = 1
    minimum_energy: Annotated[float, Field(ge=0, le=1)] = 0.9
    wave_height: Annotated[float, Field(gt=0, le=100)] | None = None  # m, crest to trough
    wave_frequency: Frequency | None = None  # rad/s
    wave_period: Period | None = None  # s
    phase_deg: Degrees | None = None
    wave_heading_deg: Degrees | None = None
    sea_direction_deg: Degrees | None = None
    stretching: Literal["wheeler", "none"] = "wheeler"

    @model_validator(mode="after")
    def _complete(self) -> "SeawaySection":
        needed: dict[str, tuple[str, ...]] = {
            "random": ("significant_wave_height", "peak_period", "frequencies"),
            "regular": ("wave_height",),
            "calm": (),
        }
        own = {**needed, "regular": ("wave_height", "wave_frequency", "wave_period", "phase_deg")}
        missing = [name for name in needed[self.kind] if getattr(self, name) is None]
        if missing:
            raise ValueError(f"a {self.kind} seaway also needs {', '.join(missing)}")
        foreign = [
            name
            for kind, names in own.items()
            for name in names
            if kind != self.kind and getattr(self, name) is not None
        ]
        if foreign:
            raise ValueError(f"a {self.kind} seaway has no {', '.join(foreign)}")
        if self.kind == "regular" and (self.wave_frequency is None) == (self.wave_period is None):
            raise ValueError("a regular seaway needs wave_frequency or wave_period, one of them")
        given = (self.wave_heading_deg is not None) + (self.sea_direction_deg is not None)
        if given == 2 or (given == 0 and self.kind != "calm"):
            raise ValueError(
                f"{'both' if given else 'neither'} of wave_heading_deg (relative to the ship: 0 following,"
                " 180 head) and sea_direction_deg (compass direction the waves come from, with"
                " run.ship_heading_deg) are given; give one"
            )
        return self


class RunSection(Section):
    """[run]: speed, model, time."""

    speed_knots: Annotated[float, Field(ge=0, le=60)]
    ship_heading_deg: Degrees | None = None
    model: Literal["nonlinear", "linear"] = "nonlinear"
    time_step: Annotated[float, Field(ge=1e-4, le=5)]  # s
    duration: Annotated[float, Field(gt=0, le=1e6)]  # s, after the ramp
    ramp: Annotated[float, Field(ge=0, le=1e5)] = 60.0  # s
    capsize_angle_deg: Annotated[float, Field(ge=0, le=180)] = 90.0

    @model_validator(mode="after")
    def _steps(self) -> "RunSection":
        if self.duration < self.time_step:
            raise ValueError(f"the duration of {self.duration:g} s is shorter than one time_step")
        if self.steps > MOST_STEPS:
            raise ValueError(f"{self.steps} time steps are more than the {MOST_STEPS} that one run may have")
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


class CaseFile(Section):
    """The whole file."""

    ship: ShipSection
    hydrodynamics: HydrodynamicsSection = HydrodynamicsSection()
    seaway: SeawaySection
    run: RunSection
    supplementary: SupplementarySection = SupplementarySection()

    @model_validator(mode="after")
    def _course(self) -> "CaseFile":
        if self.seaway.sea_direction_deg is not None and self.run.ship_heading_deg is None:
            raise ValueError(
                "seaway.sea_direction_deg is a compass direction and needs the ship's course:"
                " set run.ship_heading_deg, or give seaway.wave_heading_deg (relative to the ship) instead"
            )
        return self
