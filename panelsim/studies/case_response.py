"""The linear motions of the ship of a case: transfer functions, and statistics in its sea from all sides."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr

from panelsim.case import Case
from panelsim.conventions import FloatArray
from panelsim.files import write_whole
from panelsim.hydro.database import HydroDatabase, Progress
from panelsim.hydro.reach import require_waves_held
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.response.natural import NaturalMode, natural_periods
from panelsim.response.response import Response, response
from panelsim.response.transfer_functions import TransferFunctions, real_valued
from panelsim.seaway.random import RandomSeaway

# Waves from ten ship lengths to a sixth of one, which is where a ship moves; and what the diffraction tables
# of another program hold.
_LONGEST, _SHORTEST, _FREQUENCIES = 10.0, 1.0 / 6.0, 120


@dataclass(frozen=True)
class CaseResponse:
    """The response of a case: table, statistics in its sea, natural modes, and points by name.

    The transfer functions, and the natural modes, have quadratic and cubic roll damping made linear for the
    sea of the case: the table for each speed and heading, the modes for its own, which are `own_heading`
    [rad] and `own`, (speed, heading) by index.
    """

    table: Response
    in_sea: xr.Dataset
    own_heading: float
    own: tuple[int, int]
    natural: Mapping[str, NaturalMode | None]
    points: Mapping[str, tuple[TransferFunctions, xr.Dataset]]

    @property
    def linearised(self) -> bool:
        """Whether there is roll damping that had to be made linear."""
        return any(terms.quadratic or terms.cubic for terms in self.table.roll_damping)

    def save(self, path: Path) -> None:
        """NetCDF with groups: the table at the root, `in_sea`, and for every point `points/NAME`.

        Every group has the coordinates of the one above too, so that it can be opened alone.
        """
        groups = {"/": self.table.dataset, "/in_sea": self.in_sea}
        for name, (transfer, in_sea) in self.points.items():
            groups |= {f"/points/{name}": transfer.dataset, f"/points/{name}/in_sea": in_sea}
        # A group inherits the signals of the one above, and those of a point are others.
        apart = {
            name: real_valued(group.rename(signal="point_signal") if name.startswith("/points") else group)
            for name, group in groups.items()
        }
        tree = xr.DataTree.from_dict(apart)
        write_whole(path, bytes(tree.to_netcdf(engine="h5netcdf", write_inherited_coords=True)))


def case_response(
    case: Case,
    wave_headings: FloatArray,
    speeds: FloatArray,
    points: Mapping[str, FloatArray],
    progress: Progress | None = None,
) -> CaseResponse:
    """Solve the case for wave headings (H,) [rad] and speeds (S,) [m/s], which need not hold its own.

    `points` (3,) [m] of the ship by name, besides those of the case. Raises PanelsimError as `response` and
    `TransferFunctions.in_sea` do, and as the roll damping of the case.
    """
    database = case.database(progress)
    require_waves_held(database, case.seaway.components)
    heading = own_heading(case)
    speed = _with(speeds, case.speed)
    table = response(
        case.ship,
        database,
        frequencies=_frequencies(case, database),
        wave_headings=_with(wave_headings, heading, 2.0 * np.pi),
        speeds=speed,
        supplementary=case.supplementary,
        transom=case.transom(database),
        roll_damping=[case.roll_damping_at(float(each), database) for each in speed],
    )
    in_sea = in_case_sea(case, table)
    equivalent = in_sea["equivalent_roll_damping"].values
    table = table.with_roll_damping(equivalent)
    table = replace(table, dataset=table.dataset.assign_attrs(_of_case(case)))
    apart = np.abs(np.angle(np.exp(1j * (table.wave_headings - heading))))
    own = int(np.argmin(np.abs(table.speeds - case.speed))), int(np.argmin(apart))
    at_points = {name: table.at(place) for name, place in {**case.points, **points}.items()}
    return CaseResponse(
        table,
        in_sea,
        heading,
        own,
        natural_periods(case.ship, database, case.supplementary, RollDampingTerms(float(equivalent[own]))),
        {name: (transfer, in_case_sea(case, transfer)) for name, transfer in at_points.items()},
    )


def in_case_sea(case: Case, table: TransferFunctions) -> xr.Dataset:
    """Statistics in the sea of the case, turned so that it comes from each heading of the table.

    A random sea by its spectrum, with its spread if it has one; other seas by their components.
    """
    sea, beta, words = case.seaway, table.wave_headings, {"sea": sea_in_words(case)}
    if isinstance(sea, RandomSeaway) and sea.directional_spectrum is None:
        return table.in_sea(sea.point_spectrum, wave_headings=beta).assign_attrs(words)
    # On another course the same sea comes from another side: β = ν + π - χ.
    courses = np.mod(sea.ship_heading + own_heading(case) - beta, 2.0 * np.pi)
    spread = sea.directional_spectrum if isinstance(sea, RandomSeaway) else None
    found = table.in_sea(sea if spread is None else spread, ship_headings=courses)
    return found.rename(ship_heading="wave_heading").assign_coords(wave_heading=beta).assign_attrs(words)


def sea_in_words(case: Case) -> str:
    """Kind, spectrum, height and period of the sea of the case, in one line."""
    sea, section = case.seaway, case.file.seaway
    waves = sea.components
    if isinstance(sea, RandomSeaway):
        height = 4.0 * np.sqrt(sea.point_spectrum.moment(0))
        spread = "short-crested" if sea.directional_spectrum is not None else "long-crested"
        return (
            f"{section.spectrum or 'random'} sea, {spread}, significant height {height:.4g} m,"
            f" mean period {sea.point_spectrum.mean_period:.4g} s"
        )
    if waves.count == 1:
        return f"regular waves of {2.0 * waves.amplitude[0]:.4g} m and {waves.frequency[0]:.4g} rad/s"
    return f"{sea.kind} sea of {waves.count} waves, significant height {4.0 * np.sqrt(waves.variance):.4g} m"


def _of_case(case: Case) -> dict[str, str]:
    """What only the case knows of its response."""
    return {
        "sea": sea_in_words(case),
        "roll_damping_method": case.file.roll_damping.method,
        "case": json.dumps(case.resolved(), ensure_ascii=False),
    }


def _frequencies(case: Case, database: HydroDatabase) -> FloatArray:
    """Wave frequencies (F,) [rad/s] of the table."""
    low, high = np.sqrt(2.0 * np.pi * case.ship.gravity / case.ship.length / np.array([_LONGEST, _SHORTEST]))
    if not database.has_potentials:
        low, high = max(low, database.wave_frequencies[0]), min(high, database.wave_frequencies[-1])
    return np.linspace(low, high, _FREQUENCIES)


def own_heading(case: Case) -> float:
    """Mean wave heading β [rad, 0 to 2π] of the sea of the case."""
    waves = case.seaway.components
    mean = np.angle(np.sum(waves.amplitude**2 * np.exp(1j * waves.wave_heading)))
    own = case.wave_heading
    return float(np.mod(mean if own is None else own, 2.0 * np.pi))


def _with(values: FloatArray, own: float, turn: float = np.inf) -> FloatArray:
    """The values, rising, and the case's own one if it is not among them."""
    apart = np.abs(values - own)
    near = np.minimum(apart, np.abs(turn - apart)) < 1e-6
    return np.sort(values if near.any() else np.append(values, own))
