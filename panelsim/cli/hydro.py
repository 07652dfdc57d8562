"""The command `hydro`: coefficients of a ship, computed or taken from another program, stored."""

from pathlib import Path
from typing import Annotated, Any, cast

import typer

from panelsim.cli.arguments import refuse_existing, require_suffix, ship_of
from panelsim.cli.options import Force
from panelsim.cli.respond import numbers
from panelsim.cli.show import out, progress_bars, show_coverage
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.exchange.any_format import read_database
from panelsim.hydro.strip.section_forms import SectionForm
from panelsim.studies.output_folder import make_output_folder


def hydro(
    what: Annotated[str, typer.Argument(help="A bundled hull, a hull folder or a case file.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="NetCDF file to write.")],
    method: Annotated[
        str | None, typer.Option(help="bem (boundary elements in 3-D, if not given) or strip.")
    ] = None,
    section_form: Annotated[
        str | None, typer.Option(help="--method strip: close-fit (if not given) or lewis.")
    ] = None,
    source: Annotated[
        Path | None, typer.Option("--from", help="Of Capytaine, WAMIT (file or folder), BEMIO or HDB5.")
    ] = None,
    forward: Annotated[str | None, typer.Option(help="--from: +x or -x, the way of the bow.")] = None,
    center_of_gravity: Annotated[
        str | None, typer.Option(metavar="X,Y,Z", help="--from: in its axes, z from calm water [m].")
    ] = None,
    moments_about: Annotated[
        str | None, typer.Option(metavar="X,Y,Z", help="--from: point of moments and rotations [m].")
    ] = None,
    length_scale: Annotated[float | None, typer.Option(help="--from WAMIT: ULEN [m].")] = None,
    water_depth: Annotated[float | None, typer.Option(help="--from WAMIT: [m], inf for deep.")] = None,
    first_column: Annotated[str | None, typer.Option(help="--from WAMIT: period or frequency.")] = None,
    rest: Annotated[
        str | None, typer.Option(help="--from: lowest if its lowest frequency may stand for 0.")
    ] = None,
    force: Force = False,
) -> None:
    """Compute the coefficients of a ship, or read those of another program; store them."""
    require_suffix(output, ".nc")
    refuse_existing(output, force)
    about: dict[str, Any] = {
        "forward": forward,
        "center_of_gravity": _point("--center-of-gravity", center_of_gravity),
        "moments_about": _point("--moments-about", moments_about),
        "length_scale": length_scale,
        "water_depth": water_depth,
        "first_column": first_column,
        "rest": rest,
    }
    given = {name: value for name, value in about.items() if value is not None}
    _require_one_source(source, method or section_form, given)
    ship = ship_of(what)
    if source is not None:
        database = read_database(source, ship, **given)
        make_output_folder(output.parent)
    else:
        make_output_folder(output.parent)
        with progress_bars() as track:
            database = HydroDatabase.compute(
                ship,
                method or "bem",
                progress=track("hydrodynamic coefficients"),
                section_form=cast(SectionForm, section_form or "close-fit"),
            )
    database.save(output, overwrite=force)
    out.print(f"Wrote {output}", soft_wrap=True)
    show_coverage(database)


def _require_one_source(source: Path | None, method: str | None, given: dict[str, Any]) -> None:
    if source is None and given:
        names = ", ".join(f"--{name.replace('_', '-')}" for name in given)
        raise PanelsimError("Options for files of other programs were given without --from", got=names)
    if source is not None and method is not None:
        raise PanelsimError(
            "Coefficients are either read or computed",
            got="--from, and --method or --section-form",
            remedy="give one of them",
        )


def _point(option: str, text: str | None) -> tuple[float, ...] | None:
    if text is None:
        return None
    point = tuple(float(value) for value in numbers(option, text, "metres"))
    if len(point) != 3:
        raise PanelsimError(f"{option} is no point", got=text, allowed="X,Y,Z [m], for example 12,0,-1.8")
    return point
