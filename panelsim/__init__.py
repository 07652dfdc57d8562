"""panelsim: a nonlinear panel-method, time-domain ship-motion solver.

The public names below are imported when they are first used, so that `import panelsim` stays light.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

_HOMES = {
    "PanelsimError": "errors",
    "Dof": "conventions",
    "KNOT": "conventions",
    "HullForm": "hull.form",
    "load_hull": "hull.form",
    "bundled_hull_names": "hull.form",
    "PanelMesh": "hull.panel_mesh",
    "read_mesh": "hull.readers",
    "MeshReport": "hull.checks",
    "check_mesh": "hull.checks",
    "Hydrostatics": "hull.hydrostatics",
    "hydrostatics": "hull.hydrostatics",
    "equilibrium": "hull.equilibrium",
    "Ship": "ship.ship",
    "load_ship": "ship.bundled",
    "righting_arm": "ship.righting",
    "RightingArms": "ship.righting_arms",
    "Bretschneider": "seaway.spectra.bretschneider",
    "buckley_height": "seaway.climate.limits",
    "ScatterTable": "seaway.climate.scatter",
    "north_atlantic": "seaway.climate.scatter",
    "sea_state": "seaway.climate.sea_states",
    "sea_state_of": "seaway.climate.sea_states",
    "DirectionalTable": "seaway.direction.directional_table",
    "read_directional_table": "seaway.direction.directional_table",
    "SpreadSpectrum": "seaway.direction.spread_spectrum",
    "CosineHalfAngle": "seaway.direction.spreading",
    "CosinePower": "seaway.direction.spreading",
    "CosineSquared": "seaway.direction.spreading",
    "TenParameterSpectrum": "seaway.direction.ten_parameter",
    "read_components": "seaway.exchange.components_csv",
    "write_components": "seaway.exchange.components_csv",
    "dataset_from_spectrum": "seaway.exchange.datasets",
    "open_spectrum": "seaway.exchange.datasets",
    "spectrum_from_dataset": "seaway.exchange.datasets",
    "ElevationRecord": "seaway.exchange.elevation_record",
    "read_elevation_record": "seaway.exchange.elevation_record",
    "read_ndbc_meteorology": "seaway.exchange.ndbc",
    "read_ndbc_spectrum": "seaway.exchange.ndbc",
    "FixedSeaway": "seaway.fixed",
    "EqualEnergyFrequencies": "seaway.frequencies",
    "EvenFrequencies": "seaway.frequencies",
    "JitteredFrequencies": "seaway.frequencies",
    "ComponentSeaway": "seaway.given",
    "RecordedSeaway": "seaway.recorded",
    "repeat_time": "seaway.repeat",
    "variance_scatter": "seaway.repeat",
    "characteristics": "seaway.spectra.characteristics",
    "component_characteristics": "seaway.spectra.characteristics",
    "encounter_density": "seaway.spectra.encounter",
    "encounter_energy": "seaway.spectra.encounter",
    "Jonswap": "seaway.spectra.jonswap",
    "OchiHubble": "seaway.spectra.ochi_hubble",
    "PiersonMoskowitz": "seaway.spectra.pierson_moskowitz",
    "TableSpectrum": "seaway.spectra.table",
    "read_table_spectrum": "seaway.spectra.table",
    "TranslatingSeaway": "seaway.translating",
    "WaveComponents": "seaway.components",
    "CalmSeaway": "seaway.seaways",
    "RegularSeaway": "seaway.regular",
    "RandomSeaway": "seaway.random",
    "HydroDatabase": "hydro.database",
    "database_for": "hydro.store",
    "Section": "hydro.strip.sections",
    "HullSections": "hydro.strip.sections",
    "sections_from_offsets": "hydro.strip.sections",
    "LewisForm": "hydro.strip.lewis",
    "lewis_form": "hydro.strip.lewis",
    "coverage": "hydro.exchange.coverage",
    "read_database": "hydro.exchange.any_format",
    "read_capytaine": "hydro.exchange.capytaine_dataset",
    "read_wamit": "hydro.exchange.wamit",
    "read_bemio": "hydro.exchange.bemio",
    "read_hdb": "hydro.exchange.hdb",
    "diffraction_load": "hydro.diffraction",
    "radiation_at_speed": "hydro.speed_terms",
    "Transom": "hydro.transom",
    "RollDampingTerms": "hydro.roll_damping.terms",
    "RollDecay": "hydro.roll_damping.decay",
    "fit_roll_decay": "hydro.roll_damping.decay",
    "IkedaDamping": "hydro.roll_damping.ikeda",
    "rolling_hull": "case.roll_damping_section",
    "ikeda_damping": "hydro.roll_damping.ikeda",
    "ikeda_terms": "hydro.roll_damping.ikeda",
    "RollingHull": "hydro.roll_damping.hull_data",
    "memory_functions": "hydro.memory",
    "FreeRotation": "motion.free_rotation",
    "rotate_freely": "motion.free_rotation",
    "attitude_of": "motion.free_rotation",
    "angles_of": "motion.free_rotation",
    "pressure_force": "loads.wetted_surface",
    "WettedSurface": "loads.wetted_surface",
    "Instant": "loads.load",
    "pressure_stiffness": "loads.derivatives",
    "hull_pressure": "loads.hull_pressure",
    "HullPressure": "loads.hull_pressure",
    "Supplementary": "loads.supplementary",
    "SamplingError": "response.run_length",
    "sampling_error": "response.run_length",
    "natural_periods": "response.natural",
    "NaturalMode": "response.natural",
    "Response": "response.response",
    "response": "response.response",
    "TransferFunctions": "response.transfer_functions",
    "point_motions": "motion.point_motions",
    "with_points": "motion.point_motions",
    "simulate": "motion.simulate",
    "simulate_batch": "motion.simulate",
    "History": "motion.history",
    "statistics": "results.statistics",
    "report": "view.report",
    "record": "view.recording",
    "Case": "case",
    "FrozenWave": "studies.righting",
    "righting_arm_in_wave": "studies.righting",
    "sweep": "studies.sweep",
}
__all__ = sorted(_HOMES)

if TYPE_CHECKING:
    from panelsim.case import Case as Case
    from panelsim.case.roll_damping_section import rolling_hull as rolling_hull
    from panelsim.conventions import KNOT as KNOT
    from panelsim.conventions import Dof as Dof
    from panelsim.errors import PanelsimError as PanelsimError
    from panelsim.hull.checks import MeshReport as MeshReport
    from panelsim.hull.checks import check_mesh as check_mesh
    from panelsim.hull.equilibrium import equilibrium as equilibrium
    from panelsim.hull.form import HullForm as HullForm
    from panelsim.hull.form import bundled_hull_names as bundled_hull_names
    from panelsim.hull.form import load_hull as load_hull
    from panelsim.hull.hydrostatics import Hydrostatics as Hydrostatics
    from panelsim.hull.hydrostatics import hydrostatics as hydrostatics
    from panelsim.hull.panel_mesh import PanelMesh as PanelMesh
    from panelsim.hull.readers import read_mesh as read_mesh
    from panelsim.hydro.database import HydroDatabase as HydroDatabase
    from panelsim.hydro.diffraction import diffraction_load as diffraction_load
    from panelsim.hydro.exchange.any_format import read_database as read_database
    from panelsim.hydro.exchange.bemio import read_bemio as read_bemio
    from panelsim.hydro.exchange.capytaine_dataset import read_capytaine as read_capytaine
    from panelsim.hydro.exchange.coverage import coverage as coverage
    from panelsim.hydro.exchange.hdb import read_hdb as read_hdb
    from panelsim.hydro.exchange.wamit import read_wamit as read_wamit
    from panelsim.hydro.memory import memory_functions as memory_functions
    from panelsim.hydro.roll_damping.decay import RollDecay as RollDecay
    from panelsim.hydro.roll_damping.decay import fit_roll_decay as fit_roll_decay
    from panelsim.hydro.roll_damping.hull_data import RollingHull as RollingHull
    from panelsim.hydro.roll_damping.ikeda import IkedaDamping as IkedaDamping
    from panelsim.hydro.roll_damping.ikeda import ikeda_damping as ikeda_damping
    from panelsim.hydro.roll_damping.ikeda import ikeda_terms as ikeda_terms
    from panelsim.hydro.roll_damping.terms import RollDampingTerms as RollDampingTerms
    from panelsim.hydro.speed_terms import radiation_at_speed as radiation_at_speed
    from panelsim.hydro.store import database_for as database_for
    from panelsim.hydro.strip.lewis import LewisForm as LewisForm
    from panelsim.hydro.strip.lewis import lewis_form as lewis_form
    from panelsim.hydro.strip.sections import HullSections as HullSections
    from panelsim.hydro.strip.sections import Section as Section
    from panelsim.hydro.strip.sections import sections_from_offsets as sections_from_offsets
    from panelsim.hydro.transom import Transom as Transom
    from panelsim.loads.derivatives import pressure_stiffness as pressure_stiffness
    from panelsim.loads.hull_pressure import HullPressure as HullPressure
    from panelsim.loads.hull_pressure import hull_pressure as hull_pressure
    from panelsim.loads.load import Instant as Instant
    from panelsim.loads.supplementary import Supplementary as Supplementary
    from panelsim.loads.wetted_surface import WettedSurface as WettedSurface
    from panelsim.loads.wetted_surface import pressure_force as pressure_force
    from panelsim.motion.free_rotation import FreeRotation as FreeRotation
    from panelsim.motion.free_rotation import angles_of as angles_of
    from panelsim.motion.free_rotation import attitude_of as attitude_of
    from panelsim.motion.free_rotation import rotate_freely as rotate_freely
    from panelsim.motion.history import History as History
    from panelsim.motion.point_motions import point_motions as point_motions
    from panelsim.motion.point_motions import with_points as with_points
    from panelsim.motion.simulate import simulate as simulate
    from panelsim.motion.simulate import simulate_batch as simulate_batch
    from panelsim.response.natural import NaturalMode as NaturalMode
    from panelsim.response.natural import natural_periods as natural_periods
    from panelsim.response.response import Response as Response
    from panelsim.response.response import response as response
    from panelsim.response.run_length import SamplingError as SamplingError
    from panelsim.response.run_length import sampling_error as sampling_error
    from panelsim.response.transfer_functions import TransferFunctions as TransferFunctions
    from panelsim.results.statistics import statistics as statistics
    from panelsim.seaway.climate.limits import buckley_height as buckley_height
    from panelsim.seaway.climate.scatter import ScatterTable as ScatterTable
    from panelsim.seaway.climate.scatter import north_atlantic as north_atlantic
    from panelsim.seaway.climate.sea_states import sea_state as sea_state
    from panelsim.seaway.climate.sea_states import sea_state_of as sea_state_of
    from panelsim.seaway.components import WaveComponents as WaveComponents
    from panelsim.seaway.direction.directional_table import DirectionalTable as DirectionalTable
    from panelsim.seaway.direction.directional_table import read_directional_table as read_directional_table
    from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum as SpreadSpectrum
    from panelsim.seaway.direction.spreading import CosineHalfAngle as CosineHalfAngle
    from panelsim.seaway.direction.spreading import CosinePower as CosinePower
    from panelsim.seaway.direction.spreading import CosineSquared as CosineSquared
    from panelsim.seaway.direction.ten_parameter import TenParameterSpectrum as TenParameterSpectrum
    from panelsim.seaway.exchange.components_csv import read_components as read_components
    from panelsim.seaway.exchange.components_csv import write_components as write_components
    from panelsim.seaway.exchange.datasets import dataset_from_spectrum as dataset_from_spectrum
    from panelsim.seaway.exchange.datasets import open_spectrum as open_spectrum
    from panelsim.seaway.exchange.datasets import spectrum_from_dataset as spectrum_from_dataset
    from panelsim.seaway.exchange.elevation_record import ElevationRecord as ElevationRecord
    from panelsim.seaway.exchange.elevation_record import read_elevation_record as read_elevation_record
    from panelsim.seaway.exchange.ndbc import read_ndbc_meteorology as read_ndbc_meteorology
    from panelsim.seaway.exchange.ndbc import read_ndbc_spectrum as read_ndbc_spectrum
    from panelsim.seaway.fixed import FixedSeaway as FixedSeaway
    from panelsim.seaway.frequencies import EqualEnergyFrequencies as EqualEnergyFrequencies
    from panelsim.seaway.frequencies import EvenFrequencies as EvenFrequencies
    from panelsim.seaway.frequencies import JitteredFrequencies as JitteredFrequencies
    from panelsim.seaway.given import ComponentSeaway as ComponentSeaway
    from panelsim.seaway.random import RandomSeaway as RandomSeaway
    from panelsim.seaway.recorded import RecordedSeaway as RecordedSeaway
    from panelsim.seaway.regular import RegularSeaway as RegularSeaway
    from panelsim.seaway.repeat import repeat_time as repeat_time
    from panelsim.seaway.repeat import variance_scatter as variance_scatter
    from panelsim.seaway.seaways import CalmSeaway as CalmSeaway
    from panelsim.seaway.spectra.bretschneider import Bretschneider as Bretschneider
    from panelsim.seaway.spectra.characteristics import characteristics as characteristics
    from panelsim.seaway.spectra.characteristics import component_characteristics as component_characteristics
    from panelsim.seaway.spectra.encounter import encounter_density as encounter_density
    from panelsim.seaway.spectra.encounter import encounter_energy as encounter_energy
    from panelsim.seaway.spectra.jonswap import Jonswap as Jonswap
    from panelsim.seaway.spectra.ochi_hubble import OchiHubble as OchiHubble
    from panelsim.seaway.spectra.pierson_moskowitz import PiersonMoskowitz as PiersonMoskowitz
    from panelsim.seaway.spectra.table import TableSpectrum as TableSpectrum
    from panelsim.seaway.spectra.table import read_table_spectrum as read_table_spectrum
    from panelsim.seaway.translating import TranslatingSeaway as TranslatingSeaway
    from panelsim.ship.bundled import load_ship as load_ship
    from panelsim.ship.righting import righting_arm as righting_arm
    from panelsim.ship.righting_arms import RightingArms as RightingArms
    from panelsim.ship.ship import Ship as Ship
    from panelsim.studies.righting import FrozenWave as FrozenWave
    from panelsim.studies.righting import righting_arm_in_wave as righting_arm_in_wave
    from panelsim.studies.sweep import sweep as sweep
    from panelsim.view.recording import record as record
    from panelsim.view.report import report as report


def __getattr__(name: str) -> Any:
    """Import a public name from its home, once."""
    if name not in _HOMES:
        raise AttributeError(f"module 'panelsim' has no attribute {name!r}")
    value = getattr(import_module(f"panelsim.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
