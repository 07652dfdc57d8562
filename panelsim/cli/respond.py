"""The command `panelsim response`: the linear motions of the ship of a case, in its sea, from all sides."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
import xarray as xr

from panelsim.case import Case
from panelsim.cli.arguments import refuse_existing, require_suffix
from panelsim.cli.show import out, progress_bars, say, warn
from panelsim.cli.show_response import show_point, show_response
from panelsim.conventions import KNOT, FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import write_whole
from panelsim.hydro.database import Progress
from panelsim.response.arguments import point_of_ship
from panelsim.response.natural import NaturalMode, natural_periods
from panelsim.response.response import Response, TransferFunctions, real_valued, response
from panelsim.seaway.random import RandomSeaway
from panelsim.studies.output_folder import make_output_folder

_MOST = 400  # headings or speeds; a table of more is a mistake in the step
# Waves from ten ship lengths to a sixth of one, which is where a ship moves; and what the diffraction tables
# of another program hold.
_LONGEST, _SHORTEST, _FREQUENCIES = 10.0, 1.0 / 6.0, 120

Overrides = Annotated[
    list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Override, e.g. seaway.seed=7.")
]


@dataclass(frozen=True)
class CaseResponse:
    """The response of a case: table, statistics in its sea, the case's own heading, and points by name."""

    table: Response
    in_sea: xr.Dataset
    own_heading: float
    natural: Mapping[str, NaturalMode | None]
    points: Mapping[str, tuple[TransferFunctions, xr.Dataset]]


def respond(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="NetCDF file; runs/CASE-response/response.nc if not given."),
    ] = None,
    headings: Annotated[
        str, typer.Option(help="Wave headings [deg]: start:stop:step, or a list 0,45,90.")
    ] = "0:180:15",
    speeds: Annotated[
        str | None, typer.Option(help="Speeds [knots], likewise; from 0 to that of the case if not given.")
    ] = None,
    point: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=X,Y,Z", help="A point: forward of midships, to port, above baseline [m]."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace files that panelsim writes.")] = False,
    overrides: Overrides = None,
) -> None:
    """Linear motions in waves and in the sea of a case, by heading and speed.

    Prints RMS and periods; writes NetCDF, and beside it pictures of transfer functions and of the RMS.
    """
    case = Case.load(case_file, overrides or ())
    beta, knots = _degrees(headings), _knots(case, speeds)
    points = _points(point or ())
    path = output if output is not None else Path("runs") / f"{case.name}-response" / "response.nc"
    require_suffix(path, ".nc")
    files = [path, *(path.with_name(f"{path.stem}-{name}.png") for name in ("transfer", "polar"))]
    for file in files:
        refuse_existing(file, force=force)
    warn(case.warnings())
    if not case.seaway.components.count:
        raise PanelsimError("A ship does not respond to calm water", got='seaway.kind = "calm"')
    make_output_folder(path.parent)
    with progress_bars() as track:
        found = case_response(
            case, np.deg2rad(beta), knots * KNOT, points, track("hydrodynamic coefficients")
        )
    show_response(case, found.in_sea, found.own_heading, found.natural)
    for name, (_, in_sea) in found.points.items():
        show_point(case, name, in_sea, found.own_heading)
    _write(found, path)
    from panelsim.view.response_picture import polar_picture, transfer_picture  # brings matplotlib

    transfer_picture(found.table, found.own_heading, case.speed, files[1])
    polar_picture(found.in_sea, files[2])
    for note in [*found.table.notes, *str(found.in_sea.attrs["notes"]).splitlines()]:
        say(f"note: {note}")
    out.print(f"Files in {path.parent}: {', '.join(file.name for file in files)}", soft_wrap=True)


def case_response(
    case: Case,
    wave_headings: FloatArray,
    speeds: FloatArray,
    points: Mapping[str, FloatArray],
    progress: Progress | None = None,
) -> CaseResponse:
    """Solve the case for wave headings (H,) [rad] and speeds (S,) [m/s], which need not hold its own.

    Raises PanelsimError as `response` and `TransferFunctions.in_sea` do.
    """
    database = case.database(progress)
    own = _own_heading(case)
    low, high = np.sqrt(2.0 * np.pi * case.ship.gravity / case.ship.length / np.array([_LONGEST, _SHORTEST]))
    if not database.has_potentials:
        low, high = max(low, database.wave_frequencies[0]), min(high, database.wave_frequencies[-1])
    table = response(
        case.ship,
        database,
        frequencies=np.linspace(low, high, _FREQUENCIES),
        wave_headings=_with(wave_headings, own, 2.0 * np.pi),
        speeds=_with(speeds, case.speed),
        supplementary=case.supplementary,
        transom=case.transom(database),
    )
    at_points = {name: table.at(place) for name, place in points.items()}
    return CaseResponse(
        table,
        in_case_sea(case, table),
        own,
        natural_periods(case.ship, database, case.supplementary),
        {name: (transfer, in_case_sea(case, transfer)) for name, transfer in at_points.items()},
    )


def in_case_sea(case: Case, table: TransferFunctions) -> xr.Dataset:
    """Statistics in the sea of the case, turned so that it comes from each heading of the table.

    A random sea by its spectrum, with its spread if it has one; other seas by their components.
    """
    sea, beta = case.seaway, table.wave_headings
    if isinstance(sea, RandomSeaway) and sea.directional_spectrum is None:
        return table.in_sea(sea.point_spectrum, wave_headings=beta)
    # On another course the same sea comes from another side: β = ν + π - χ.
    courses = np.mod(sea.ship_heading + _own_heading(case) - beta, 2.0 * np.pi)
    spread = sea.directional_spectrum if isinstance(sea, RandomSeaway) else None
    found = table.in_sea(sea if spread is None else spread, ship_headings=courses)
    return found.rename(ship_heading="wave_heading").assign_coords(wave_heading=beta)


def _own_heading(case: Case) -> float:
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


def _degrees(headings: str) -> FloatArray:
    degrees = numbers("--headings", headings, "degrees")
    if np.abs(degrees).max() > 360.0:
        raise PanelsimError(
            "A wave heading is beyond a turn", got=f"{headings} deg", allowed="-360 to 360 deg"
        )
    return degrees


def _knots(case: Case, speeds: str | None) -> FloatArray:
    if speeds is not None:
        return numbers("--speeds", speeds, "knots")
    own = case.file.run.speed_knots
    return np.linspace(0.0, own, 5) if own > 0.0 else np.zeros(1)


def numbers(option: str, text: str, unit: str) -> FloatArray:
    """Numbers from "start:stop:step", both ends included, or from a list with commas.

    Raises PanelsimError for text that is neither.
    """
    try:
        parts = [float(part) for part in text.split(":" if ":" in text else ",")]
    except ValueError:
        parts = []
    if ":" in text and len(parts) == 3 and np.isfinite(parts).all() and parts[2] > 0.0:
        start, stop, step = parts
        count = int(np.floor((stop - start) / step + 1e-9)) + 1
        if 0 < count <= _MOST:
            return np.asarray(start + step * np.arange(count), dtype=np.float64)
    elif ":" not in text and 0 < len(parts) <= _MOST and np.isfinite(parts).all():
        return np.array(parts)
    raise PanelsimError(
        f"{option} is no range and no list of {unit}",
        got=text,
        allowed=f"start:stop:step or a,b,c, up to {_MOST} values, for example 0:180:15",
    )


def _points(texts: Sequence[str]) -> dict[str, FloatArray]:
    """Points (3,) [m] in hull axes by name."""
    points: dict[str, FloatArray] = {}
    for text in texts:
        name, _, place = text.partition("=")
        if not name.strip() or not place or "/" in name or name in points:
            raise PanelsimError(
                "A point has no name of its own", got=text, allowed="NAME=X,Y,Z, for example bridge=20,0,15"
            )
        points[name] = point_of_ship(numbers(f"--point {name}", place, "metres"))
    return points


def _write(found: CaseResponse, path: Path) -> None:
    """NetCDF with groups: the table at the root, `in_sea`, and for every point `points/NAME`."""
    groups = {"/": found.table.dataset, "/in_sea": found.in_sea}
    for name, (transfer, in_sea) in found.points.items():
        groups |= {f"/points/{name}": transfer.dataset, f"/points/{name}/in_sea": in_sea}
    # A group inherits the signals of the one above, and those of a point are others.
    apart = {
        name: real_valued(group.rename(signal="point_signal") if name.startswith("/points") else group)
        for name, group in groups.items()
    }
    write_whole(path, bytes(xr.DataTree.from_dict(apart).to_netcdf(engine="h5netcdf")))
