"""What the command line prints of a sweep."""

import json

import numpy as np
import xarray as xr
from rich.table import Table
from rich.text import Text

from panelsim.cli.show import err, out, warn
from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.results.rms_study import MINOR
from panelsim.results.statistics import display_unit
from panelsim.studies.sweep_plan import SweepPlan
from panelsim.studies.sweep_statistics import OUTCOMES

WIDE = 0.1  # of the RMS: a band that is wider says little
_SHOWN = 5  # sentences on runs that ended early; the file has all


def show_sweep(plan: SweepPlan, found: xr.Dataset) -> None:
    """The range of the RMS of each motion, and where it is largest, with the band there."""
    table = Table(title="RMS over the sweep")
    for column in ("motion", "unit", "smallest", "largest", "95 % band", "largest at"):
        table.add_column(
            Text(column), justify="left" if column in ("motion", "unit", "largest at") else "right"
        )
    dims = [axis.key for axis in plan.axes]
    for name in DOF_NAMES:
        unit, factor = display_unit(name)
        rms = factor * found["rms"].sel(dof=name).transpose(*dims).values
        if np.isnan(rms).all():
            continue
        place = np.unravel_index(np.nanargmax(rms), rms.shape)
        half = factor * found["rms_half_width"].sel(dof=name).transpose(*dims).values[place]
        where = ", ".join(
            f"{axis.key.rpartition('.')[2]} {axis.values[i]}"
            for axis, i in zip(plan.axes, place, strict=True)
        )
        band = "–" if np.isnan(half) else f"± {half:z.3f}"
        table.add_row(name, unit, f"{np.nanmin(rms):z.3f}", f"{np.nanmax(rms):z.3f}", band, where)
    out.print(table)
    _warn_of_wide_bands(plan, found, dims)


def _warn_of_wide_bands(plan: SweepPlan, found: xr.Dataset, dims: list[str]) -> None:
    rms, half = (found[name].transpose(*dims, "dof").values for name in ("rms", "rms_half_width"))
    share = np.where(_counts(rms), half, np.nan) / np.where(rms > 0.0, rms, np.nan)
    if np.isnan(share).all() or np.nanmax(share) <= WIDE:
        return
    *place, dof = np.unravel_index(np.nanargmax(share), share.shape)
    where = ", ".join(f"{axis.key} = {axis.values[i]}" for axis, i in zip(plan.axes, place, strict=True))
    widest = float(np.nanmax(share))
    known = "not known" if widest > 1.0 else f"known to ± {100 * widest:.0f} % only"
    warn(
        [
            f"The RMS is {known} ({DOF_NAMES[dof]} at {where}): take more seeds or a longer run.duration;"
            " docs/studies.md says how many."
        ]
    )


def _counts(rms: FloatArray) -> np.ndarray:
    """Which modes (…, 6) are not small beside the largest translation or rotation there."""
    with np.errstate(invalid="ignore"):
        largest = np.repeat(np.stack([rms[..., :3].max(-1), rms[..., 3:].max(-1)], axis=-1), 3, axis=-1)
        return np.asarray(rms >= MINOR * largest)


def ended_early(found: xr.Dataset) -> bool:
    """Tell of runs that did not finish, if there are any."""
    sentences = json.loads(found.attrs["ended_early"])
    if not sentences:
        return False
    counts = {name: int(found[name].sum()) for name in OUTCOMES if name != "finished"}
    told = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    err.print(f"Not all runs finished: {told}.")
    for sentence in sentences[:_SHOWN]:
        err.print(f"  {' '.join(sentence.split())}")
    if len(sentences) > _SHOWN:
        err.print(f"  and {len(sentences) - _SHOWN} more, in the attribute ended_early of sweep.nc")
    return True
