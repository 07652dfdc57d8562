"""What a hydrodynamic database covers, in words."""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import require_kind
from panelsim.hydro.arguments import A_DATABASE
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.tabulated_diffraction import SPEED_NOTE, largest_frequency_step, largest_heading_step

_ROUNDING = 1e-6


def coverage(database: HydroDatabase) -> str:
    """Lines on the frequencies and headings of a database, its gaps, and what holds at speed.

    Raises PanelsimError for what is no database.
    """
    require_kind("database", database, HydroDatabase, A_DATABASE)
    frequency = database.frequencies
    lines = [
        f"Source: {database.dataset.attrs.get('solver', 'not told')}.",
        f"Radiation: {len(frequency)} frequencies, 0 to {frequency[-1]:.4g} rad/s, and the infinite limit;"
        " met faster than that, the ship radiates as the damping's tail says.",
    ]
    if database.has_potentials:
        lines.append(
            "Diffraction: from potentials, at any wave frequency, heading and speed; waves are resolved that"
            f" meet the ship at up to {frequency[-1]:.4g} rad/s."
        )
        return "\n".join([*lines, *database.notes])
    waves, headings = database.wave_frequencies, database.wave_headings
    lines += [
        f"Diffraction: tables at {_frequencies(database)} rad/s ({len(waves)} stored);"
        " other waves are refused.",
        f"Headings: {', '.join(f'{angle:.4g}' for angle in np.degrees(headings))}° ({len(headings)} stored);"
        f" {_between(database)}",
        SPEED_NOTE,
        *database.notes,
    ]
    return "\n".join(lines)


def _frequencies(database: HydroDatabase) -> str:
    """Ranges without a gap, as "0.2 to 1.4, 1.8"."""
    waves = database.wave_frequencies
    gaps = np.diff(waves) > largest_frequency_step(database, waves[1:]) + _ROUNDING
    runs = np.split(waves, np.flatnonzero(gaps) + 1)
    return ", ".join(f"{run[0]:.4g} to {run[-1]:.4g}" if len(run) > 1 else f"{run[0]:.4g}" for run in runs)


def _between(database: HydroDatabase) -> str:
    """Up to which wave frequency headings between the stored ones are taken."""
    headings, waves = database.wave_headings, database.wave_frequencies
    steps = np.diff(np.append(headings, headings[0] + 2 * np.pi))
    inside = steps if steps.max() <= np.pi / 2 else np.delete(steps, steps.argmax())
    near = waves[_held(database, waves, inside)]
    if not len(inside) or not len(near):
        return "no others."
    arc = "all round" if len(inside) == len(steps) else "inside their arc"
    return f"others {arc} for waves of up to {near[-1]:.4g} rad/s, above that only the stored ones."


def _held(database: HydroDatabase, waves: FloatArray, steps: FloatArray) -> list[int]:
    allowed = largest_heading_step(database, waves) + _ROUNDING
    return [i for i, step in enumerate(allowed) if len(steps) and steps.max() <= step]
