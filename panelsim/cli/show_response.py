"""What `panelsim response` prints: natural modes, motions in the sea, and the RMS by heading and speed."""

import numpy as np
import xarray as xr
from rich.table import Table
from rich.text import Text

from panelsim.case import Case
from panelsim.cli.show import out, say, show_rows
from panelsim.conventions import DOF_NAMES, KNOT, FloatArray
from panelsim.response.natural import NaturalMode
from panelsim.results.statistics import display_unit
from panelsim.studies.case_response import CaseResponse

_STILL = 1e-6  # in the units that are printed: rounding


def show_response(case: Case, found: CaseResponse, *, every_speed: bool) -> None:
    """Natural modes, motions in the sea of the case, RMS by heading at its own or at every speed."""
    knots = f"{case.file.run.speed_knots:g} knots"
    damping = f", with the roll damping of this sea at {knots}" if found.linearised else ""
    show_rows(f"Natural modes at rest{damping}", {name: _mode(mode) for name, mode in found.natural.items()})
    _show_signals(case.name, case, found, found.in_sea)
    for name, (_, in_sea) in found.points.items():
        _show_signals(f"Point {name}", case, found, in_sea)
    for i in range(len(found.table.speeds)):
        if every_speed or i == found.own[0]:
            _show_rms(found, i)
    _show_notes(found, every_speed)


def _show_signals(title: str, case: Case, found: CaseResponse, in_sea: xr.Dataset) -> None:
    speed, heading = found.own
    here = in_sea.isel(speed=speed, wave_heading=heading)
    where = f"{case.file.run.speed_knots:g} knots, waves at {np.rad2deg(found.own_heading):.4g}°"
    table = Table("", "unit", box=None, padding=(0, 2), title=f"{title}: {where}")
    for column in ("RMS", "zero-crossing\nperiod [s]", "peak\nperiod [s]"):
        table.add_column(Text(column), justify="right")
    for k, name in enumerate(here["signal"].values):
        unit, factor = display_unit(str(name))
        periods = (here["zero_crossing_period"].values[k], here["peak_period"].values[k])
        rms = _number(factor * here["rms"].values[k])
        table.add_row(str(name).replace("_", " "), unit, rms, *(_number(period, 2) for period in periods))
    out.print(table)


def _show_rms(found: CaseResponse, speed: int) -> None:
    """RMS by heading at one of the speeds, and the roll damping there where the case has some."""
    in_sea = found.in_sea.isel(speed=speed)
    table = Table(box=None, padding=(0, 1), title=f"RMS at {found.table.speeds[speed] / KNOT:.3g} knots")
    table.add_column(Text("heading\n[deg]"))
    for name in DOF_NAMES:
        table.add_column(Text(f"{name}\n[{display_unit(name)[0]}]"), justify="right")
    damped = bool(in_sea["equivalent_roll_damping"].values.any())
    if damped:
        table.add_column(Text("roll damping\n[MN m s]"), justify="right")
    for j, heading in enumerate(found.table.wave_headings):
        here = in_sea.isel(wave_heading=j)
        cells = _rms_cells(here["rms"].values)
        if damped:
            cells.append(_number(1e-6 * float(here["equivalent_roll_damping"])))
        table.add_row(f"{np.rad2deg(heading):.4g}", *cells)
    out.print(table)


def _rms_cells(rms: FloatArray) -> list[str]:
    return [_number(display_unit(name)[1] * value) for name, value in zip(DOF_NAMES, rms, strict=True)]


def _show_notes(found: CaseResponse, every_speed: bool) -> None:
    say("Waves come from astern at 0°, from port at 90°, from ahead at 180°.")
    if found.linearised:
        say(
            "Quadratic and cubic roll damping is made linear for this sea: for each speed and heading in the"
            " transfer functions, for the case's own in the natural modes."
        )
    if not every_speed and len(found.table.speeds) > 1:
        say("Other speeds are in the files; --speeds prints them.")
    share = 100.0 * found.in_sea.attrs["energy_share"]
    say(f"The waves that are solved hold {share:.1f} % of the sea's energy.")
    for note in [*found.table.notes, *str(found.in_sea.attrs["notes"]).splitlines()]:
        say(f"note: {note}")


def _number(value: float, digits: int = 3) -> str:
    return "–" if not np.isfinite(value) else f"{0.0 if abs(value) < _STILL else value:.{digits}f}"


def _mode(mode: NaturalMode | None) -> str:
    if mode is None:
        return "does not oscillate"
    return (
        f"period {mode.period:.3g} s, damping {100 * mode.damping_ratio:.2g} % of critical"
        f" (by itself {mode.uncoupled_period:.3g} s, {100 * mode.uncoupled_damping_ratio:.2g} %)"
    )
