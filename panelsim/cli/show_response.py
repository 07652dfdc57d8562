"""What `panelsim response` prints: natural modes, motions in the sea, and the RMS by heading and speed."""

from collections.abc import Mapping

import numpy as np
import xarray as xr
from rich.table import Table
from rich.text import Text

from panelsim.case import Case
from panelsim.cli.show import out, say, show_rows
from panelsim.conventions import DOF_NAMES, KNOT
from panelsim.response.natural import NaturalMode
from panelsim.results.statistics import display_unit

_STILL = 1e-6  # in the units that are printed: rounding


def show_response(
    case: Case, in_sea: xr.Dataset, own_heading: float, natural: Mapping[str, NaturalMode | None]
) -> None:
    """Natural modes, the motions of the case, and the RMS of all headings (0° following) and speeds."""
    show_rows(
        "Natural modes at rest, of small motions", {name: _mode(mode) for name, mode in natural.items()}
    )
    _show_signals(case, f"{case.name}, linear", in_sea, own_heading)
    for speed in in_sea["speed"].values:
        table = Table(box=None, padding=(0, 1), title=f"RMS at {speed / KNOT:.3g} knots")
        table.add_column(Text("heading\n[deg]"))
        for name in DOF_NAMES:
            table.add_column(Text(f"{name}\n[{display_unit(name)[0]}]"), justify="right")
        for heading in in_sea["wave_heading"].values:
            rms = in_sea["rms"].sel(speed=speed, wave_heading=heading).values
            cells = [_number(display_unit(name)[1] * v) for name, v in zip(DOF_NAMES, rms, strict=True)]
            table.add_row(f"{np.rad2deg(heading):.4g}", *cells)
        out.print(table)
    say(f"The waves that are solved hold {100 * in_sea.attrs['energy_share']:.1f} % of the sea's energy.")


def show_point(case: Case, name: str, in_sea: xr.Dataset, own_heading: float) -> None:
    """Motions of a point of the ship at the speed and in the waves of the case."""
    _show_signals(case, name, in_sea, own_heading)


def _show_signals(case: Case, title: str, in_sea: xr.Dataset, own_heading: float) -> None:
    apart = np.abs(np.angle(np.exp(1j * (in_sea["wave_heading"].values - own_heading))))
    here = in_sea.sel(speed=case.speed, method="nearest").isel(wave_heading=int(np.argmin(apart)))
    table = Table(
        "",
        "unit",
        box=None,
        padding=(0, 2),
        title=f"{title}: {case.file.run.speed_knots:g} knots, waves at {np.rad2deg(own_heading):.4g}°",
    )
    for column in ("RMS", "zero-crossing\nperiod [s]", "peak\nperiod [s]"):
        table.add_column(Text(column), justify="right")
    for k, name in enumerate(here["signal"].values):
        unit, factor = display_unit(str(name)) if name in DOF_NAMES else (str(here["unit"].values[k]), 1.0)
        periods = (here["zero_crossing_period"].values[k], here["peak_period"].values[k])
        rms = _number(factor * here["rms"].values[k])
        table.add_row(str(name).replace("_", " "), unit, rms, *(_number(period) for period in periods))
    out.print(table)


def _number(value: float) -> str:
    return "–" if not np.isfinite(value) else f"{0.0 if abs(value) < _STILL else value:.3f}"


def _mode(mode: NaturalMode | None) -> str:
    if mode is None:
        return "does not oscillate"
    return (
        f"period {mode.period:.3g} s, damping {100 * mode.damping_ratio:.2g} % of critical"
        f" (by itself {mode.uncoupled_period:.3g} s, {100 * mode.uncoupled_damping_ratio:.2g} %)"
    )
