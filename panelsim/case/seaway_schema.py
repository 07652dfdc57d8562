"""The table [seaway] of a case file: which keys each kind of sea takes, and what they may hold."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from panelsim.case.section import Degrees, KeyFault, Positive, Section

Frequency = Annotated[float, Field(ge=0.01, le=100)]  # rad/s: from far above any swell to ripples
Period = Annotated[float, Field(ge=0.06, le=630)]  # s: the same span
Height = Annotated[float, Field(gt=0, le=50)]  # m
Share = Annotated[float, Field(ge=0, le=1)]
FileName = Annotated[str, Field(min_length=1)]

MOST_FREQUENCIES = 5000

# What a spectrum can be given by: each way a set of keys that belong together, and what may be added to it.
Ways = tuple[tuple[tuple[str, ...], tuple[str, ...]], ...]
HEIGHT_AND_PEAK = ("significant_wave_height", "peak_period")
SPECTRA: dict[str, Ways] = {
    "bretschneider": (
        (HEIGHT_AND_PEAK, ()),
        (("significant_wave_height", "mean_period"), ()),
        (("significant_wave_height", "zero_crossing_period"), ()),
        (("sea_state",), ()),
    ),
    "bretschneider-one-parameter": ((("significant_wave_height",), ()),),
    "jonswap": (
        (HEIGHT_AND_PEAK, ("peak_enhancement", "normalisation")),
        (("sea_state",), ("peak_enhancement", "normalisation")),
        (("wind_speed", "fetch"), ()),
    ),
    "dnv": ((HEIGHT_AND_PEAK, ()), (("sea_state",), ())),
    "pierson-moskowitz": ((("wind_speed",), ()), (("significant_wave_height",), ())),
    "ochi-hubble": ((("systems",), ()),),
    "ten-parameter": ((("systems",), ()),),
    "table": ((("file",), ()),),
    "directional-table": ((("file",), ()),),
}
DIRECTIONAL_SPECTRA = ("ten-parameter", "directional-table")
CHOICE_OF_COMPONENTS = ("spreading", "direction_step_deg")
KINDS: dict[str, Ways] = {
    "random": ((("frequencies",), CHOICE_OF_COMPONENTS),),
    "regular": tuple(
        (("wave_height", size), ("phase_deg", "wave_theory"))
        for size in ("wave_frequency", "wave_period", "wave_length")
    ),
    "calm": (((), ()),),
    "record": ((("file", "low_frequency", "high_frequency"), ("time_column", "elevation_column", "taper")),),
    "dataset": tuple(
        ((files, "format"), ("time", "site", "frequencies", *CHOICE_OF_COMPONENTS))
        for files in ("file", "files")
    ),
    "components": ((("file",), ()),),
}
# Keys with a default say nothing where they do not apply.
EVERYWHERE = {"kind", "spectrum", "seed", "minimum_energy", "drop_below", "stretching"}
HEADINGS = ("wave_heading_deg", "sea_direction_deg")


class FrequencySection(Section):
    """[seaway.frequencies]: which frequencies [rad/s] carry the sea."""

    choice: Literal["even", "jittered", "equal-energy"] = "even"
    start: Frequency | None = None
    stop: Frequency | None = None
    step: Positive | None = None
    count: Annotated[int, Field(ge=2, le=MOST_FREQUENCIES)] | None = None

    @model_validator(mode="after")
    def _complete(self) -> "FrequencySection":
        wanted, other = (
            (("count",), "step") if self.choice == "equal-energy" else (("start", "stop", "step"), "count")
        )
        missing = [name for name in wanted if getattr(self, name) is None]
        if missing:
            raise ValueError(f"{self.choice} frequencies also need {', '.join(missing)}")
        if getattr(self, other) is not None:
            raise ValueError(f"{self.choice} frequencies have no {other}")
        if self.start is not None and self.stop is not None:
            if self.stop <= self.start:
                raise ValueError("stop is not above start")
            if self.step is not None and (self.stop - self.start) / self.step > MOST_FREQUENCIES:
                raise ValueError(f"the step is too small: more than {MOST_FREQUENCIES} frequencies")
        return self


class SpreadingSection(Section):
    """[seaway.spreading]: how the energy is spread about the mean direction."""

    kind: Literal["cosine-squared", "cosine-power", "cosine-half-angle"]
    spreading_angle_deg: Annotated[float, Field(gt=0, le=180)] | None = None
    power: Annotated[float, Field(gt=0, le=1000)] | None = None
    spread: Annotated[float, Field(gt=0, le=1000)] | None = None

    @model_validator(mode="after")
    def _complete(self) -> "SpreadingSection":
        own = {
            "cosine-squared": "spreading_angle_deg",
            "cosine-power": "power",
            "cosine-half-angle": "spread",
        }
        if getattr(self, own[self.kind]) is None:
            raise ValueError(f"{self.kind} spreading also needs {own[self.kind]}")
        foreign = [
            name for name in own.values() if name != own[self.kind] and getattr(self, name) is not None
        ]
        if foreign:
            raise ValueError(f"{self.kind} spreading has no {', '.join(foreign)}")
        return self


class SystemSection(Section):
    """[[seaway.systems]]: one of the two wave systems of an Ochi-Hubble or ten-parameter spectrum."""

    significant_wave_height: Height
    peak_period: Period
    shape: Annotated[float, Field(gt=0, le=50)]
    sea_direction_deg: Degrees | None = None
    spread: Annotated[float, Field(gt=0, le=1000)] | None = None


class SeawaySection(Section):
    """[seaway]: the waves. The heading is relative to the ship, or the compass direction they come from."""

    kind: Literal["random", "regular", "calm", "record", "dataset", "components"]
    # a random sea
    spectrum: Literal[
        "bretschneider",
        "bretschneider-one-parameter",
        "jonswap",
        "dnv",
        "pierson-moskowitz",
        "ochi-hubble",
        "ten-parameter",
        "table",
        "directional-table",
    ] = "bretschneider"
    significant_wave_height: Height | None = None  # m
    peak_period: Period | None = None  # s
    mean_period: Period | None = None  # s
    zero_crossing_period: Period | None = None  # s
    sea_state: Annotated[int, Field(ge=0, le=9)] | None = None
    peak_enhancement: Annotated[float, Field(ge=1, le=20)] | None = None
    normalisation: Literal["goda", "logarithmic"] | None = None
    wind_speed: Annotated[float, Field(gt=0, le=100)] | None = None  # m/s
    fetch: Annotated[float, Field(gt=0, le=1e7)] | None = None  # m
    systems: Annotated[list[SystemSection], Field(min_length=1, max_length=2)] | None = None
    frequencies: FrequencySection | None = None
    spreading: SpreadingSection | None = None
    direction_step_deg: Annotated[float, Field(gt=0, le=90)] | None = None
    seed: Annotated[int, Field(ge=0, lt=2**63)] = 1
    minimum_energy: Share = 0.9
    drop_below: Annotated[float, Field(ge=0, lt=1)] = 0.0
    # a regular one
    wave_height: Annotated[float, Field(gt=0, le=100)] | None = None  # m, crest to trough
    wave_frequency: Frequency | None = None  # rad/s
    wave_period: Period | None = None  # s
    wave_length: Annotated[float, Field(ge=0.01, le=1e6)] | None = None  # m
    phase_deg: Degrees | None = None
    wave_theory: Literal["linear", "stokes"] | None = None
    # one from elsewhere
    file: FileName | None = None
    files: Annotated[list[FileName], Field(min_length=5, max_length=5)] | None = None
    format: Literal["netcdf", "ndbc", "ndbc-meteorology"] | None = None
    time: FileName | None = None
    site: Annotated[int, Field(ge=0)] | None = None
    time_column: FileName | None = None
    elevation_column: FileName | None = None
    low_frequency: Annotated[float, Field(ge=0, le=100)] | None = None  # rad/s
    high_frequency: Frequency | None = None  # rad/s
    taper: Annotated[float, Field(ge=0, le=1)] | None = None
    # all
    wave_heading_deg: Degrees | None = None
    sea_direction_deg: Degrees | None = None
    stretching: Literal["wheeler", "none"] = "wheeler"

    @model_validator(mode="after")
    def _complete(self) -> "SeawaySection":
        given = {name for name in self.model_fields_set if getattr(self, name) is not None}
        given -= {*EVERYWHERE, *HEADINGS}
        allowed = self._keys_of(KINDS[self.kind], f"a {self.kind} seaway", given)
        if self.kind == "random":
            own = {key for ways in SPECTRA.values() for needed, more in ways for key in (*needed, *more)}
            spectrum = f'the spectrum "{self.spectrum}"'
            allowed |= self._keys_of(SPECTRA[self.spectrum], spectrum, given & own)
        foreign = sorted(given - allowed)
        if foreign:
            keys = sorted({*allowed, *EVERYWHERE}) if self.kind != "calm" else ["kind alone"]
            raise KeyFault(
                f"{self._name()} has no {', '.join(foreign)}",
                got=", ".join(f"{name} = {self._text(name)}" for name in foreign),
                allowed=", ".join(keys),
                remedy=f"leave {', '.join(foreign)} out, or choose another seaway.kind"
                + (" or spectrum" if self.kind == "random" else ""),
            )
        self._systems_fit()
        if self.files is not None and self.format != "ndbc":
            raise ValueError(f'a dataset of the format "{self.format}" is one file, not files')
        if self.site is not None and self.format != "netcdf":
            raise ValueError(f'a dataset of the format "{self.format}" has no site')
        self._headings_fit()
        if self.direction_step_deg is not None and not self._is_spread():
            raise ValueError("direction_step_deg is for short-crested seas: add spreading, or leave it out")
        stepless = self.spreading is not None or (self.kind, self.spectrum) == ("random", "ten-parameter")
        if stepless and self.direction_step_deg is None:
            raise ValueError("a short-crested sea also needs direction_step_deg, for example 20")
        return self

    def _name(self) -> str:
        spectrum = f' with the spectrum "{self.spectrum}"' if self.kind == "random" else ""
        return f"a {self.kind} seaway{spectrum}"

    def _text(self, name: str) -> str:
        """The value of a key as the case file writes it, a table or list told as such."""
        value = getattr(self, name)
        if isinstance(value, str):
            return f'"{value}"'
        return f"{value:g}" if isinstance(value, float) else str(value) if isinstance(value, int) else "…"

    @staticmethod
    def _keys_of(ways: Ways, name: str, given: set[str]) -> set[str]:
        """Keys of the one way that is given whole; ValueError where there is none, or are two."""
        whole = [(needed, more) for needed, more in ways if given.issuperset(needed)]
        if not whole:
            begun = max(ways, key=lambda way: len(given.intersection(way[0])))
            if len(ways) == 1 or given.intersection(begun[0]):
                missing = ", ".join(key for key in begun[0] if key not in given)
                others = [" and ".join(needed) for needed, _ in ways if needed != begun[0]]
                rest = f" (or be given by {', or by '.join(others)})" if others else ""
                raise ValueError(f"{name} also needs {missing}{rest}")
            raise ValueError(f"{name} needs {', or '.join(' and '.join(needed) for needed, _ in ways)}")
        needed, more = max(whole, key=lambda way: len(way[0]))
        for way, _ in whole:
            both = sorted({*needed} ^ {*way})
            if both and not {*way} <= {*needed, *more}:
                raise ValueError(f"{name} has both {' and '.join(both)}; give one")
        return {*needed, *more}

    def _is_spread(self) -> bool:
        """Whether the sea has, or may have, more than one direction."""
        directional = self.kind == "random" and self.spectrum in DIRECTIONAL_SPECTRA
        return self.spreading is not None or directional or self.kind == "dataset"

    def _systems_fit(self) -> None:
        """Systems of a ten-parameter spectrum have a direction and a spread, those of Ochi-Hubble none."""
        for number, system in enumerate(self.systems or (), start=1):
            for key in ("sea_direction_deg", "spread"):
                given = getattr(system, key) is not None
                if given and self.spectrum == "ochi-hubble":
                    raise ValueError(
                        f"system {number} of an ochi-hubble spectrum has no {key}: use ten-parameter"
                    )
                if not given and self.spectrum == "ten-parameter":
                    raise ValueError(f"system {number} of a ten-parameter spectrum also needs {key}")

    def _headings_fit(self) -> None:
        """One heading, but none where the directions are part of the sea itself."""
        given = [name for name in HEADINGS if getattr(self, name) is not None]
        inside = self.kind == "components" or (self.kind == "random" and self.spectrum in DIRECTIONAL_SPECTRA)
        if inside and given:
            raise ValueError(f"{self._name()} brings its own directions and has no {given[0]}")
        if inside and self.spreading is not None:
            raise ValueError(f"{self._name()} brings its own directions and has no spreading")
        if len(given) == 2 or (not given and self.kind in ("random", "regular", "record") and not inside):
            raise ValueError(
                f"{'both' if given else 'neither'} of wave_heading_deg (relative to the ship: 0 following,"
                " 180 head) and sea_direction_deg (compass direction the waves come from, with"
                " run.ship_heading_deg) are given; give one"
            )

    @property
    def needs_course(self) -> bool:
        """Whether its directions are compass ones, so that the ship's course must be known."""
        compass = self.kind == "random" and self.spectrum in DIRECTIONAL_SPECTRA
        return compass or self.sea_direction_deg is not None
