"""From the table [seaway] of a case to the seaway."""

from pathlib import Path

import numpy as np

from panelsim.case.seaway_schema import FrequencySection, SeawaySection, SpreadingSection
from panelsim.case.ship_section import beside
from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.climate.sea_states import sea_state
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.direction.directional_table import DirectionalTable, read_directional_table
from panelsim.seaway.direction.spreading import CosineHalfAngle, CosinePower, CosineSquared, Spreading
from panelsim.seaway.direction.ten_parameter import TenParameterSpectrum
from panelsim.seaway.exchange.components_csv import read_components
from panelsim.seaway.exchange.datasets import open_spectrum
from panelsim.seaway.exchange.elevation_record import read_elevation_record
from panelsim.seaway.exchange.ndbc import read_ndbc_meteorology, read_ndbc_spectrum
from panelsim.seaway.frequencies import (
    EqualEnergyFrequencies,
    EvenFrequencies,
    FrequencyChoice,
    JitteredFrequencies,
)
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.recorded import RecordedSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway, Seaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.jonswap import Jonswap
from panelsim.seaway.spectra.ochi_hubble import OchiHubble
from panelsim.seaway.spectra.pierson_moskowitz import PiersonMoskowitz
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.spectra.table import TableSpectrum, read_table_spectrum

Spectrum = PointSpectrum | DirectionalSpectrum


class SeawayBuilder:
    """Builds the seaway of one table [seaway] for a ship on its course.

    `folder` is that of the case file; `wave_heading` β and `ship_heading` χ in rad, None where the case
    gives none; `gravity` [m/s2] is that of the ship.
    """

    def __init__(
        self,
        section: SeawaySection,
        folder: Path,
        *,
        wave_heading: float | None,
        ship_heading: float | None,
        gravity: float,
    ) -> None:
        self._section = section
        self._gravity = gravity
        self._folder = folder
        self._heading = wave_heading
        self._course_given = ship_heading is not None
        self._course = ship_heading or 0.0

    def build(self) -> Seaway:
        """The seaway. Raises PanelsimError for files and values that cannot be used."""
        kinds = {
            "random": self._random,
            "regular": self._regular,
            "calm": lambda: CalmSeaway(self._course),
            "record": self._record,
            "dataset": self._dataset,
            "components": lambda: ComponentSeaway(read_components(self._path()), self._course),
        }
        return kinds[self._section.kind]()

    def _path(self) -> Path:
        assert self._section.file is not None
        return _file(self._folder, self._section.file)

    def _regular(self) -> RegularSeaway:
        section = self._section
        if section.wave_length is not None:
            frequency = np.sqrt(2 * np.pi * self._gravity / section.wave_length)
        else:
            frequency = section.wave_frequency or 2 * np.pi / (section.wave_period or np.nan)
        return RegularSeaway(
            0.5 * (section.wave_height or np.nan),
            float(frequency),
            self._one_heading(),
            float(np.deg2rad(section.phase_deg or 0.0)),
            self._course,
            second_order=section.wave_theory == "stokes",
        )

    def _one_heading(self) -> float:
        if self._heading is None:
            raise PanelsimError(
                "The direction of the waves is not known",
                got=f"a {self._section.kind} seaway without one",
                remedy="set seaway.wave_heading_deg (relative to the ship), or seaway.sea_direction_deg and"
                " run.ship_heading_deg",
            )
        return self._heading

    def _random(self) -> RandomSeaway:
        return self._random_of(build_spectrum(self._section, self._folder))

    def _random_of(self, spectrum: Spectrum) -> RandomSeaway:
        """The random sea of a spectrum, with a heading and perhaps a spreading, or its own directions."""
        section, directional = self._section, isinstance(spectrum, DirectionalSpectrum)
        if directional:
            self._require_own_directions()
        step = section.direction_step_deg
        return RandomSeaway(
            spectrum,
            _frequencies(section.frequencies, spectrum),
            None if directional else self._one_heading(),
            section.seed,
            section.minimum_energy,
            spreading=None if section.spreading is None else _spreading(section.spreading),
            direction_step=None if step is None else float(np.deg2rad(step)),
            drop_below=section.drop_below,
            ship_heading=self._course,
        )

    def _record(self) -> RecordedSeaway:
        section = self._section
        record = read_elevation_record(
            self._path(), time_column=section.time_column, elevation_column=section.elevation_column
        )
        return RecordedSeaway(
            record,
            self._one_heading(),
            section.low_frequency or 0.0,
            section.high_frequency or np.inf,
            taper=section.taper or 0.0,
            ship_heading=self._course,
            minimum_energy=section.minimum_energy,
        )

    def _require_own_directions(self) -> None:
        """Refuse a heading beside directions that the sea brings itself, and a course that is not known."""
        if self._heading is not None or self._section.spreading is not None:
            raise PanelsimError(
                "This sea brings its own directions",
                got="a heading or a spreading beside them",
                remedy="leave out wave_heading_deg, sea_direction_deg and spreading",
            )
        self._require_course()

    def _require_course(self) -> None:
        """Refuse compass directions for a ship whose course is not known."""
        if not self._course_given:
            raise PanelsimError(
                "The directions of this sea are compass ones, and the ship's course is not known",
                got="no run.ship_heading_deg",
                remedy="set run.ship_heading_deg",
            )

    def _dataset(self) -> RandomSeaway:
        section = self._section
        if section.format == "netcdf":
            return self._random_of(open_spectrum(self._path(), time=section.time, site=section.site))
        if section.format == "ndbc":
            files = [_file(self._folder, name) for name in section.files or [section.file or ""]]
            return self._random_of(read_ndbc_spectrum(files, time=section.time))
        buoy = read_ndbc_meteorology(self._path())
        if self._heading is None:
            self._require_course()
            from_north = buoy.sea_direction_at(section.time)
            self._heading = float(np.remainder(from_north + np.pi - self._course, 2 * np.pi))
        return self._random_of(buoy.spectrum_at(section.time))


def _file(folder: Path, name: str) -> Path:
    """A file beside the case, or where panelsim is run; PanelsimError where there is none."""
    path = Path(beside(folder, name))
    if not path.is_file():
        raise PanelsimError(
            "There is no such file of the seaway",
            got=name,
            allowed=f"a file in {folder}, beside the case, or a path from where panelsim is run",
        )
    return path


def build_spectrum(section: SeawaySection, folder: Path) -> Spectrum:
    """The spectrum that the table [seaway] of a random sea describes."""
    values = section.model_dump()
    if section.sea_state is not None:
        values |= _of_sea_state(section.sea_state)
    height, peak_period = values["significant_wave_height"], values["peak_period"]
    match section.spectrum:
        case "bretschneider" if section.mean_period is not None:
            return Bretschneider.from_mean_period(height, section.mean_period)
        case "bretschneider" if section.zero_crossing_period is not None:
            return Bretschneider.from_zero_crossing_period(height, section.zero_crossing_period)
        case "bretschneider":
            return Bretschneider(height, peak_period)
        case "bretschneider-one-parameter":
            return Bretschneider.one_parameter(height)
        case "jonswap" if section.fetch is not None:
            return Jonswap.from_wind(values["wind_speed"], section.fetch)
        case "jonswap":
            given = {name: values[name] for name in ("peak_enhancement", "normalisation")}
            return Jonswap(height, peak_period, **{k: v for k, v in given.items() if v is not None})
        case "dnv":
            return Jonswap.dnv(height, peak_period)
        case "pierson-moskowitz" if section.wind_speed is not None:
            return PiersonMoskowitz(section.wind_speed)
        case "pierson-moskowitz":
            return PiersonMoskowitz.from_significant_wave_height(height)
        case "ochi-hubble" | "ten-parameter":
            return _of_systems(section)
        case "table":
            return read_table_spectrum(_file(folder, values["file"]))
        case "directional-table":
            return read_directional_table(_file(folder, values["file"]))


def _of_sea_state(number: int) -> dict[str, float]:
    state = sea_state(number)
    spectrum = state.spectrum()
    return {
        "significant_wave_height": spectrum.significant_wave_height,
        "peak_period": spectrum.peak_period,
    }


def _of_systems(section: SeawaySection) -> OchiHubble | TenParameterSpectrum:
    systems = section.systems or []
    shapes = (
        tuple(system.significant_wave_height for system in systems),
        tuple(system.peak_period for system in systems),
        tuple(system.shape for system in systems),
    )
    if section.spectrum == "ochi-hubble":
        return OchiHubble(*shapes)
    directions = tuple(float(np.deg2rad(system.sea_direction_deg or 0.0)) for system in systems)
    return TenParameterSpectrum(*shapes, directions, tuple(system.spread or 0.0 for system in systems))


def _spreading(section: SpreadingSection) -> Spreading:
    if section.kind == "cosine-squared":
        return CosineSquared(float(np.deg2rad(section.spreading_angle_deg or np.nan)))
    if section.kind == "cosine-power":
        return CosinePower(section.power or np.nan)
    return CosineHalfAngle(section.spread or np.nan)


def _frequencies(section: FrequencySection | None, spectrum: Spectrum) -> FrequencyChoice | FloatArray:
    """The choice of the case; a table of a buoy or a wave model keeps its own frequencies without one."""
    if section is None:
        if isinstance(spectrum, TableSpectrum | DirectionalTable):
            return spectrum.frequency
        raise PanelsimError(
            "The frequencies of the sea are not known",
            got="no seaway.frequencies",
            remedy="set them, for example { start = 0.2, stop = 2.0, step = 0.05 }",
        )
    start, stop, step = section.start, section.stop, section.step
    if section.choice == "equal-energy":
        return EqualEnergyFrequencies(section.count or 0, start or 0.0, stop or np.inf)
    assert start is not None and stop is not None and step is not None
    return (EvenFrequencies if section.choice == "even" else JitteredFrequencies)(start, stop, step)
