"""What `panelsim sea` prints of a sea: what it was to be, beside what its components make."""

from collections.abc import Iterator

import numpy as np
from rich.table import Table

from panelsim.case import Case
from panelsim.cli.show import out, say, show_rows
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.recorded import RecordedSeaway
from panelsim.seaway.repeat import repeat_time, variance_scatter
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.characteristics import (
    SeaCharacteristics,
    characteristics,
    component_characteristics,
)

# Field of SeaCharacteristics, what it is called, unit, and whether it hangs on the upper frequency.
ROWS = (
    ("significant_wave_height", "significant wave height 4 √m0", "m", False),
    ("corrected_significant_wave_height", "  corrected for bandwidth", "m", True),
    ("mean_wave_height", "mean wave height", "m", False),
    ("rms_wave_height", "RMS wave height", "m", False),
    ("one_tenth_wave_height", "mean of the highest tenth", "m", False),
    ("peak_period", "peak period", "s", False),
    ("energy_period", "energy period m₋₁/m0", "s", False),
    ("mean_period", "mean period m0/m1", "s", False),
    ("zero_crossing_period", "zero-crossing period √(m0/m2)", "s", False),
    ("crest_period", "crest period √(m2/m4)", "s", True),
    ("bandwidth", "bandwidth ε", "", True),
    ("narrowness", "narrowness ν", "", False),
    ("peakedness", "peakedness Q_p", "", False),
    ("nominal_steepness", "nominal steepness", "", False),
    ("rms_slope", "RMS slope", "deg", True),
)


def show_sea(case: Case) -> None:
    """The parameters of the sea, target and realised, and what to know of its components."""
    seaway, gravity = case.seaway, case.ship.gravity
    if seaway.components.count == 1:
        _show_wave(case)
        return
    realised = component_characteristics(seaway.components, gravity)
    target = None
    if isinstance(seaway, RandomSeaway):
        target = characteristics(seaway.point_spectrum, realised.upper_frequency, gravity)
    out.print(f"{case.name}: {_title(case)}", style="bold", soft_wrap=True)
    table = Table(box=None, padding=(0, 2))
    for column, justify in (("", "left"), ("spectrum", "right"), ("components", "right")):
        if target is not None or column != "spectrum":
            table.add_column(column, justify=justify)  # type: ignore[arg-type]
    for field, name, unit, ends in ROWS:
        values = [_value(sea, field) for sea in (target, realised) if sea is not None]
        table.add_row(f"{name}{'*' * ends}{f' [{unit}]' if unit else ''}", *values)
    for name, *cells in _directions(seaway):
        table.add_row(name, *cells[target is None :])
    out.print(table)
    say(f"* of waves up to the highest frequency of the components, {realised.upper_frequency:.4g} rad/s")
    for sentence in _sentences(case):
        say(sentence)


def _show_wave(case: Case) -> None:
    """One wave has a height and a period; heights of Rayleigh's distribution would say nothing of it."""
    waves, gravity = case.seaway.components, case.ship.gravity
    amplitude, omega = float(waves.amplitude[0]), float(waves.frequency[0])
    length = 2 * np.pi / float(waves.wavenumber(gravity)[0])
    encounter = float(waves.encounter_frequency(case.speed, gravity)[0])
    met = f"{2 * np.pi / abs(encounter):.4g} s" if encounter else "never: the ship keeps up with it"
    rows = {
        "theory": "Stokes, second order" if waves.second_order else "linear",
        "wave height": f"{2 * amplitude:.4g} m, steepness H/λ {2 * amplitude / length:.4g}",
        "wave period": f"{2 * np.pi / omega:.4g} s, frequency {omega:.4g} rad/s",
        "wave length": f"{length:.4g} m",
        "encounter period": met + (", overtaken by the ship" if encounter < 0 else ""),
        "wave heading": f"{np.rad2deg(waves.wave_heading[0]) % 360.0:.4g} deg, 0 following, 180 head",
        "phase": f"{np.rad2deg(waves.phase[0]):.4g} deg, lead of the crest at the origin",
    }
    show_rows(f"{case.name}: {_title(case)}", rows)


def _title(case: Case) -> str:
    section, count = case.file.seaway, case.seaway.components.count
    kind = f"random sea, {section.spectrum}" if section.kind == "random" else f"{section.kind} sea"
    return f"{kind}, {count} component{'s' * (count > 1)}"


def _value(sea: SeaCharacteristics, field: str) -> str:
    value = float(getattr(sea, field))
    if field == "rms_slope":
        value = float(np.rad2deg(value))
    return "–" if np.isnan(value) else f"{value:.4g}"


def _directions(seaway: Seaway) -> Iterator[tuple[str, str, str]]:
    """Mean direction and spread, of the spectrum and of the components."""
    waves = seaway.components
    mean = complex(np.average(np.exp(1j * waves.wave_heading), weights=waves.amplitude**2))
    heading = np.rad2deg(np.angle(mean)) % 360.0
    # The difference of 1 and a rounded 1 would print as a millionth of a degree.
    spread = np.rad2deg(np.sqrt(2 * (1 - abs(mean)))) if np.ptp(waves.wave_heading) else 0.0
    target_heading, target_spread = "–", "–"
    if isinstance(seaway, RandomSeaway):
        directional = seaway.directional_spectrum
        if directional is not None:
            from_north = float(directional.mean_direction())
            relative = np.rad2deg(from_north + np.pi - seaway.ship_heading) % 360.0
            target_heading = "–" if np.isnan(relative) else f"{relative:.4g}"
            target_spread = f"{np.rad2deg(float(directional.directional_spread())):.4g}"
        elif seaway.wave_heading is not None:
            target_heading, target_spread = f"{np.rad2deg(seaway.wave_heading) % 360.0:.4g}", "0"
    yield "mean wave heading [deg], 0 following, 180 head", target_heading, f"{heading:.4g}"
    yield "directional spread [deg]", target_spread, f"{spread:.4g}"


def _sentences(case: Case) -> Iterator[str]:
    seaway, run = case.seaway, case.file.run
    waves, length = seaway.components, run.ramp + run.duration
    if isinstance(seaway, RandomSeaway):
        yield (
            f"The frequencies hold {100 * seaway.energy_share:.2f} % of the spectrum's energy; the components"
            f" carry {100 * seaway.carried:.2f} % of it"
            + (f", {seaway.dropped} of them dropped as negligible." if seaway.dropped else ".")
        )
    if isinstance(seaway, RecordedSeaway):
        yield (
            f"The band holds {100 * seaway.record_share:.2f} % of the record's variance; at a fixed point the"
            f" sea repeats after the record's {seaway.length:g} s."
        )
    if waves.count == 1:
        return
    again = repeat_time(waves, case.speed, length, gravity=case.ship.gravity)
    when = f"after {again:.0f} s" if again is not None else f"at no time within the run of {length:g} s"
    yield f"At {run.speed_knots:g} knots the ship meets nearly the same waves again {when}."
    if isinstance(seaway, RandomSeaway):
        scatter = 50 * variance_scatter(waves, case.speed, run.duration, gravity=case.ship.gravity)
        yield (
            f"With other phases the RMS of the waves over {run.duration:g} s would differ by {scatter:.2g} %"
            " (one standard deviation)."
        )
