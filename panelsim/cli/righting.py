"""The command that prints, stores and draws righting arms."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.table import Table

from panelsim.cli.arguments import refuse_existing, require_suffix, ship_of
from panelsim.cli.show import out
from panelsim.errors import PanelsimError
from panelsim.ship.righting import righting_arm
from panelsim.ship.righting_arms import RightingArms
from panelsim.ship.ship import Ship
from panelsim.studies.righting import PRESSURES, FrozenWave, righting_arm_in_wave
from panelsim.studies.righting_table import write_righting_arms

HEELS = np.deg2rad(np.arange(0.0, 181.0, 5.0))
MODEL_SIZED = 0.1  # m: smaller arms are told with more digits
AREAS = ((0, 30), (0, 40), (30, 40))  # degrees: those of the IMO's code on intact stability


def righting(
    what: Annotated[str, typer.Argument(help="A bundled hull, a hull folder or a case file.")],
    wave_length: Annotated[float | None, typer.Option(help="Frozen wave along the ship: length [m].")] = None,
    wave_height: Annotated[float | None, typer.Option(help="Its height, crest to trough [m].")] = None,
    crest: Annotated[
        float | None,
        typer.Option(help="Its crest forward of midships [m]; if not given, crest and trough amidships."),
    ] = None,
    pressure: Annotated[
        str | None, typer.Option(help="wheeler (as in runs, if not given) or hydrostatic.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="CSV file to write; the curves are drawn beside it.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace files that panelsim writes.")] = False,
) -> None:
    """Print righting arms (GZ) from 0 to 180 degrees, in calm water and on a frozen wave.

    The ship is free to sink and to trim. With -o FILE.csv the arms, heave and trim every 5 degrees are
    written, and the curves drawn in FILE.png.
    """
    waves = _waves(wave_length, wave_height, crest, pressure)
    if output is not None:
        require_suffix(output, ".csv")
        for file in (output, output.with_suffix(".png")):
            refuse_existing(file, force)
    ship = ship_of(what)
    curves = [righting_arm(ship, HEELS)]
    curves += [righting_arm_in_wave(ship, HEELS, wave, pressure=pressure or PRESSURES[0]) for wave in waves]
    show_righting(ship, curves)
    if output is not None:
        from panelsim.view.righting_picture import righting_picture  # brings matplotlib

        picture = righting_picture(curves, f"{ship.name}{_on(waves, pressure)}", output.with_suffix(".png"))
        out.print(f"Wrote {write_righting_arms(output, curves)} and {picture}", soft_wrap=True)


def _waves(
    length: float | None, height: float | None, crest: float | None, pressure: str | None
) -> list[FrozenWave]:
    """The frozen waves that the options ask for; raises PanelsimError where they do not go together."""
    if pressure is not None and pressure not in PRESSURES:
        raise PanelsimError("Unknown pressure", got=f'"{pressure}"', allowed=" | ".join(PRESSURES))
    if length is None or height is None:
        if (length, height, crest, pressure) != (None,) * 4:
            raise PanelsimError(
                "A frozen wave needs its length and its height",
                got=f"--wave-{'length' if length is not None else 'height'} alone"
                if (length, height) != (None, None)
                else "neither",
                allowed="--wave-length and --wave-height in m, and if wanted --crest and --pressure",
            )
        return []
    if crest is not None:
        return [FrozenWave(length, height, crest)]
    return [FrozenWave(length, height), FrozenWave.trough_amidships(length, height)]


def _on(waves: Sequence[FrozenWave], pressure: str | None) -> str:
    if not waves:
        return " in calm water"
    size = f"wave {waves[0].wave_length:g} m long and {waves[0].wave_height:g} m high"
    return f", {size}, pressure {pressure or PRESSURES[0]}"


def show_righting(ship: Ship, curves: Sequence[RightingArms]) -> None:
    """The righting arms every 10 degrees, and what is read off the curves, on 80 columns."""
    out.print(f"{ship.name}: righting arms GZ [m], free to sink and to trim", style="bold")
    digits = 3 if max(curve.greatest_arm for curve in curves) > MODEL_SIZED else 5
    table = _table("heel [deg]", curves)
    for row in range(0, len(HEELS), 2):
        table.add_row(f"{np.degrees(HEELS[row]):.0f}", *(f"{curve.arm[row]:z.{digits}f}" for curve in curves))
    out.print(table)
    table = _table("", curves)
    columns = [_read_off(curve, digits) for curve in curves]
    for name in columns[0]:
        table.add_row(name, *(column[name] for column in columns))
    out.print(table)


def _table(first: str, curves: Sequence[RightingArms]) -> Table:
    table = Table(first, *(curve.water for curve in curves), box=None, padding=(0, 1))
    for column in table.columns[1:]:
        column.justify = "right"
    return table


def _read_off(curve: RightingArms, digits: int) -> dict[str, str]:
    end = curve.vanishing_heel
    areas = {
        f"area {low} to {high} deg [m rad]": f"{curve.area(*np.deg2rad((low, high))):z.{digits + 1}f}"
        for low, high in AREAS
    }
    return {
        "GM, slope at 0 [m]": f"{curve.gm:.{digits}f}",
        "greatest GZ [m]": f"{curve.greatest_arm:.{digits}f}",
        "  at [deg]": f"{np.degrees(curve.greatest_arm_heel):.1f}",
        "vanishes at [deg]": "nowhere" if end is None else f"{np.degrees(end):.1f}",
        **areas,
    }
