"""The tables and keys of a case file, and what each may hold."""

import difflib
from collections.abc import Sequence
from typing import Annotated, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from panelsim.conventions import DOF_NAMES, STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Finite = Annotated[float, Field(allow_inf_nan=False)]


class Section(BaseModel):
    """A table of the case file: no key that it does not know, no text where a number belongs."""

    model_config = ConfigDict(extra="forbid", strict=True)


class MeshSection(Section):
    """[ship.mesh]: unit and axes of a mesh file."""

    length_unit: str | Positive
    up: str
    forward: str
    origin: Annotated[list[Finite], Field(min_length=3, max_length=3)] = [0.0, 0.0, 0.0]


class ShipSection(Section):
    """[ship]: a hull and, where it differs from the hull's particulars, its loading."""

    hull: str
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
    water_density: Positive | None = None  # kg/m3
    gravity: Positive = STANDARD_GRAVITY  # m/s2


class HydrodynamicsSection(Section):
    """[hydrodynamics]: how coefficients are computed, or the file that holds them."""

    method: Literal["bem"] = "bem"
    file: str | None = None


class FrequencyGrid(Section):
    """Evenly spaced wave frequencies, both ends included [rad/s]."""

    start: Positive
    stop: Positive
    step: Positive

    @model_validator(mode="after")
    def _rises(self) -> "FrequencyGrid":
        if self.stop <= self.start:
            raise ValueError("stop is not above start")
        if (self.stop - self.start) / self.step > 5000:
            raise ValueError("the step is too small: more than 5000 frequencies")
        return self

    def values(self) -> FloatArray:
        count = int(np.floor((self.stop - self.start) / self.step + 1e-9)) + 1
        return self.start + self.step * np.arange(count, dtype=np.float64)


class SeawaySection(Section):
    """[seaway]: the waves. The heading is relative to the ship, or the compass direction they come from."""

    kind: Literal["random", "regular", "calm"]
    spectrum: Literal["bretschneider"] = "bretschneider"
    significant_wave_height: Positive | None = None  # m
    peak_period: Positive | None = None  # s
    frequencies: FrequencyGrid | None = None  # rad/s
    seed: Annotated[int, Field(ge=0)] = 1
    minimum_energy: Annotated[float, Field(ge=0, le=1)] = 0.9
    wave_height: Positive | None = None  # m, crest to trough
    wave_frequency: Positive | None = None  # rad/s
    wave_period: Positive | None = None  # s
    phase_deg: Finite = 0.0
    wave_heading_deg: Annotated[float, Field(ge=-360, le=360)] | None = None
    sea_direction_deg: Annotated[float, Field(ge=-360, le=360)] | None = None
    stretching: Literal["wheeler", "none"] = "wheeler"

    @model_validator(mode="after")
    def _complete(self) -> "SeawaySection":
        needed: dict[str, tuple[str, ...]] = {
            "random": ("significant_wave_height", "peak_period", "frequencies"),
            "regular": ("wave_height",),
            "calm": (),
        }
        missing = [name for name in needed[self.kind] if getattr(self, name) is None]
        if missing:
            raise ValueError(f"a {self.kind} seaway also needs {', '.join(missing)}")
        foreign = [
            name
            for kind, names in {
                "random": needed["random"],
                "regular": ("wave_height", "wave_frequency", "wave_period"),
            }.items()
            for name in names
            if kind != self.kind and getattr(self, name) is not None
        ]
        if foreign:
            raise ValueError(f"a {self.kind} seaway has no {', '.join(foreign)}")
        if self.kind == "regular" and (self.wave_frequency is None) == (self.wave_period is None):
            raise ValueError("a regular seaway needs wave_frequency or wave_period, one of them")
        if self.kind != "calm" and (self.wave_heading_deg is None) == (self.sea_direction_deg is None):
            raise ValueError(
                "give wave_heading_deg (relative to the ship: 0 following, 180 head) or sea_direction_deg"
                " (compass direction the waves come from, with run.ship_heading_deg), one of them"
            )
        return self


class RunSection(Section):
    """[run]: speed, model, time."""

    speed_knots: Annotated[float, Field(ge=0, le=60)]
    ship_heading_deg: Annotated[float, Field(ge=-360, le=360)] | None = None
    model: Literal["nonlinear", "linear"] = "nonlinear"
    time_step: Annotated[float, Field(ge=1e-4, le=5)]  # s
    duration: Annotated[float, Field(gt=0, le=1e6)]  # s, after the ramp
    ramp: Annotated[float, Field(ge=0, le=1e5)] = 60.0  # s
    capsize_angle_deg: Annotated[float, Field(ge=0, le=180)] = 90.0


class SupplementarySection(Section):
    """[supplementary]: stiffness and damping by motion; what is given replaces the particulars' table."""

    stiffness: dict[str, Annotated[float, Field(ge=0)]] | None = None
    damping: dict[str, Annotated[float, Field(ge=0)]] | None = None

    @model_validator(mode="after")
    def _known_motions(self) -> "SupplementarySection":
        for table in (self.stiffness or {}, self.damping or {}):
            for name in table:
                if name not in DOF_NAMES:
                    raise ValueError(f"{name} is no motion; the motions are {', '.join(DOF_NAMES)}")
        return self


class CaseFile(Section):
    """The whole file."""

    ship: ShipSection
    hydrodynamics: HydrodynamicsSection = HydrodynamicsSection()
    seaway: SeawaySection
    run: RunSection
    supplementary: SupplementarySection = SupplementarySection()


def readable(error: ValidationError, path: str) -> PanelsimError:
    """Pydantic's list of faults as one message, with the nearest known key for an unknown one."""
    faults = []
    for fault in error.errors():
        keys = [str(part) for part in fault["loc"]]
        where = ".".join(keys)
        if fault["type"] == "extra_forbidden":
            known = _known_keys(keys[:-1])
            near = difflib.get_close_matches(keys[-1], known, n=1)
            hint = f"did you mean {near[0]}?" if near else f"known keys: {', '.join(known)}"
            faults.append(f"{where} is unknown; {hint}")
        elif fault["type"] == "missing":
            faults.append(f"{where} is missing")
        else:
            message = fault["msg"].removeprefix("Value error, ")
            faults.append(
                f"{where}: {message}"
                + ("" if fault["type"] == "value_error" else f", got {fault['input']!r}")
            )
    what = f"The case file {path} has {'a fault' if len(faults) == 1 else f'{len(faults)} faults'}"
    return PanelsimError(what, got="\n       ".join(faults))


def _known_keys(table: Sequence[str]) -> list[str]:
    """The keys of the (nested) table of the case file."""
    model: type[BaseModel] = CaseFile
    for name in table:
        annotation = model.model_fields[name].annotation
        candidates = [annotation, *getattr(annotation, "__args__", ())]
        model = next(c for c in candidates if isinstance(c, type) and issubclass(c, BaseModel))
    return sorted(model.model_fields)
