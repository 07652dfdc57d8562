"""Statistics of linear motions in a sea, for every speed and course."""

from collections.abc import Callable
from functools import partial

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from panelsim.conventions import Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.tabulated_diffraction import highest_covered
from panelsim.response.arguments import different_headings
from panelsim.response.linear_ship import LinearShip
from panelsim.response.notes import sea_notes
from panelsim.response.sea_waves import SeaWaves, waves_of_components, waves_of_directions, waves_of_spectrum
from panelsim.response.signals import Signals, units_by_signal
from panelsim.response.statistics import CourseStatistics, course_statistics
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import Spreading
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.point_spectrum import PointSpectrum

Sea = Seaway | PointSpectrum | DirectionalSpectrum


def in_sea(
    linear_ship: LinearShip,
    signals: Signals,
    speeds: FloatArray,
    roll_damping: tuple[RollDampingTerms, ...],
    sea: Sea,
    *,
    wave_headings: ArrayLike | None,
    ship_headings: ArrayLike | None,
    spreading: Spreading | None,
) -> xr.Dataset:
    """Statistics (speed, heading, signal) as `TransferFunctions.in_sea` says; `speeds` (S,) [m/s]."""
    name, headings, waves = _waves_of(
        sea, wave_headings, ship_headings, spreading, partial(_reach, linear_ship.database)
    )
    linear = np.array([terms.linear for terms in roll_damping])
    motions = linear_ship.in_waves(waves.frequency, waves.wave_heading, speeds, linear)
    stiffness = np.diag(linear_ship.stiffness)
    held = (bool(stiffness[Dof.SURGE] > 0.0), bool(stiffness[Dof.SWAY] > 0.0))
    found = [
        [
            course_statistics(motions, i, waves, j, roll_damping[i], signals, held)
            for j in range(len(headings))
        ]
        for i in range(len(speeds))
    ]
    dataset = _dataset(found, speeds, name, headings, signals)
    dataset.attrs = {
        "ship": linear_ship.ship.name,
        "energy_share": waves.energy_share,
        "notes": "\n".join(sea_notes(linear_ship, motions, waves, dataset)),
    }
    return dataset


def _waves_of(
    sea: Sea,
    wave_headings: ArrayLike | None,
    ship_headings: ArrayLike | None,
    spreading: Spreading | None,
    reach: Callable[[FloatArray | None], tuple[float, float]],
) -> tuple[str, FloatArray, SeaWaves]:
    """Which headings the courses are told by, these (H,) [rad], and the waves that stand for the sea.

    `reach` tells the frequencies that can be solved at some wave headings, or with None at all.
    """
    if isinstance(sea, PointSpectrum):
        _refuse(ship_headings=ship_headings)
        beta = different_headings("wave heading", [] if wave_headings is None else wave_headings)
        if spreading is None:
            return "wave_heading", beta, waves_of_spectrum(sea, beta, reach(beta))
        # Waves from north: β = π - χ.
        spread = SpreadSpectrum(sea, spreading, 0.0)
        return "wave_heading", beta, waves_of_directions(spread, np.pi - beta, reach(None))
    _refuse(wave_headings=wave_headings, spreading=spreading)
    if isinstance(sea, DirectionalSpectrum):
        courses = different_headings("ship heading", 0.0 if ship_headings is None else ship_headings)
        return "ship_heading", courses, waves_of_directions(sea, courses, reach(None))
    if isinstance(sea, Seaway):
        courses = different_headings(
            "ship heading", sea.ship_heading if ship_headings is None else ship_headings
        )
        return "ship_heading", courses, waves_of_components(sea, courses)
    raise PanelsimError(
        "The sea is of another kind",
        got=repr(sea)[:60],
        allowed="a seaway, a point spectrum or a directional spectrum",
    )


def _reach(database: HydroDatabase, wave_heading: FloatArray | None) -> tuple[float, float]:
    """Lowest and highest frequency [rad/s] that can be solved at wave headings (H,) [rad], None for all."""
    if database.has_potentials:
        return 0.0, np.inf
    return float(database.wave_frequencies[0]), highest_covered(database, wave_heading)


def _refuse(**given: object) -> None:
    """Refuse arguments that do not belong to this kind of sea."""
    for name, value in given.items():
        if value is not None:
            raise PanelsimError(
                f"This sea takes no {name}",
                got=repr(value)[:60],
                allowed="wave_headings and spreading with a point spectrum; ship_headings with other seas",
            )


def _dataset(
    found: list[list[CourseStatistics]], speeds: FloatArray, name: str, headings: FloatArray, signals: Signals
) -> xr.Dataset:
    by_course = ("speed", name)
    values = {
        field: ((*by_course, "signal"), np.array([[getattr(one, field) for one in row] for row in found]))
        for field in ("rms", "zero_crossing_period", "peak_period")
    }
    damping = np.array([[one.roll_damping for one in row] for row in found])
    dataset = xr.Dataset(
        values | {"equivalent_roll_damping": (by_course, damping)},
        coords={
            "speed": ("speed", speeds.copy(), {"units": "m/s"}),
            name: (name, headings.copy(), {"units": "rad"}),
            "signal": ("signal", list(signals.names)),
            "unit": ("signal", list(signals.units)),
        },
    )
    for variable, unit, long_name in (
        ("rms", units_by_signal(signals), "root mean square"),
        ("zero_crossing_period", "s", "zero-crossing period of encounter"),
        ("peak_period", "s", "peak period of encounter"),
        ("equivalent_roll_damping", "N m s", "linear roll damping in this sea"),
    ):
        dataset[variable].attrs = {"units": unit, "long_name": long_name}
    for array in dataset.variables.values():
        array.values.setflags(write=False)
    return dataset
