"""The command `panelsim response`: the linear motions of the ship of a case, in its sea, from all sides."""

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from panelsim.case import Case
from panelsim.cli.arguments import refuse_existing, require_suffix
from panelsim.cli.options import Force, Overrides
from panelsim.cli.show import out, progress_bars, warn
from panelsim.cli.show_response import show_response
from panelsim.conventions import KNOT, FloatArray
from panelsim.errors import PanelsimError
from panelsim.loads.arguments import FASTEST
from panelsim.response.arguments import different_headings, different_speeds
from panelsim.ship.points import points_of_ship, require_point_name
from panelsim.studies.case_response import case_response
from panelsim.studies.output_folder import make_output_folder

_MOST = 400  # headings or speeds; a table of more is a mistake in the step


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
        str | None,
        typer.Option(help="Speeds [knots], likewise, all printed; 5 up to that of the case if not given."),
    ] = None,
    point: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=X,Y,Z",
            help="A point besides those of the case: forward of midships, to port, above baseline [m].",
        ),
    ] = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Linear motions in waves and in the sea of a case, by heading and speed.

    Prints RMS and periods; writes NetCDF, and beside it pictures of transfer functions and of the RMS.
    """
    case = Case.load(case_file, overrides or ())
    beta, speed = _headings(headings), _speeds(case, speeds)
    points = _points(case, point or ())
    path = output if output is not None else Path("runs") / f"{case.name}-response" / "response.nc"
    require_suffix(path, ".nc")
    files = [path, *(path.with_name(f"{path.stem}-{name}.png") for name in ("transfer", "polar"))]
    for file in files:
        refuse_existing(file, force=force)
    _ = case.supplementary, case.points  # whatever is wrong with them comes first
    if not case.seaway.components.count:
        raise PanelsimError("A ship does not respond to calm water", got='seaway.kind = "calm"')
    warn(case.warnings())
    make_output_folder(path.parent)
    with progress_bars() as track:
        found = case_response(case, beta, speed, points, track("hydrodynamic coefficients"))
    show_response(case, found, every_speed=speeds is not None)
    found.save(path)
    from panelsim.view.response_picture import polar_picture, transfer_picture  # brings matplotlib

    transfer_picture(found.table, found.own_heading, case.speed, files[1])
    polar_picture(found.in_sea, files[2])
    out.print(f"Files in {path.parent}: {', '.join(file.name for file in files)}", soft_wrap=True)


def _headings(text: str) -> FloatArray:
    """Wave headings (H,) [rad]."""
    degrees = numbers("--headings", text, "degrees")
    if np.abs(degrees).max() > 360.0:
        raise PanelsimError("A wave heading is beyond a turn", got=f"{text} deg", allowed="-360 to 360 deg")
    return different_headings("wave heading", np.deg2rad(degrees))


def _speeds(case: Case, text: str | None) -> FloatArray:
    """Speeds (S,) [m/s]."""
    if text is not None:
        knots = numbers("--speeds", text, "knots", example="0:20:5")
        if len(np.unique(knots)) < len(knots):
            raise PanelsimError("A speed is given twice", got=f"{text} knots", remedy="give each once")
        if knots.min() < 0.0 or knots.max() * KNOT > FASTEST:
            raise PanelsimError(
                "A speed is not that of a ship that goes ahead",
                got=f"{text} knots",
                allowed=f"0 to {FASTEST / KNOT:.0f} knots",
            )
        return different_speeds(knots * KNOT)
    return np.linspace(0.0, case.speed, 5) if case.speed > 0.0 else np.zeros(1)


def numbers(option: str, text: str, unit: str, example: str = "0:180:15") -> FloatArray:
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
        allowed=f"start:stop:step or a,b,c, up to {_MOST} values, for example {example}",
    )


def _points(case: Case, texts: Sequence[str]) -> dict[str, FloatArray]:
    """Points (3,) [m] in hull axes by name, none of them one of the case."""
    points: dict[str, FloatArray] = {}
    for text in texts:
        name, place = _named_place(text, case.file.points)
        if name in points:
            raise PanelsimError("A point is given twice", got=name, remedy="give each name once")
        if name in case.file.points:
            raise PanelsimError(
                "The case has a point of this name already", got=name, remedy="give the other another name"
            )
        points[name] = place
    return points_of_ship(points, case.ship.center_of_gravity, case.ship.vertices)


def _named_place(text: str, known: Collection[str]) -> tuple[str, FloatArray]:
    """Name and place (3,) [m] from "NAME=X,Y,Z"; `known` are the points of the case."""
    name, equals, place = text.partition("=")
    if equals:
        require_point_name(name)
    try:
        found = np.array([float(part) for part in place.split(",")])
    except ValueError:
        found = np.empty(0)
    if not equals or found.shape != (3,) or not np.isfinite(found).all():
        raise PanelsimError(
            "A point is not of the form NAME=X,Y,Z with three finite numbers",
            got=text,
            allowed="metres forward of midships, to port, above the baseline, for example bridge=20,0,15;"
            f" the case has {', '.join(known) or 'none'}",
        )
    return name, found
