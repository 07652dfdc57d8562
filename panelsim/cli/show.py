"""What the command line prints: facts of a ship, of a case, of a run, on 80 columns."""

import shlex
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import astuple
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console
from rich.padding import Padding
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from rich.table import Table

from panelsim.case import Case
from panelsim.case.schema import HydrodynamicsSection
from panelsim.hull.defects import MeshDefect
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.exchange.coverage import coverage
from panelsim.hydro.reach import require_waves_held
from panelsim.hydro.store import stored_database
from panelsim.results.tables import point_table, statistics_table
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.repeat import repeat_time
from panelsim.ship.facts import Published, ShipFacts

if TYPE_CHECKING:  # it brings matplotlib and rerun
    from panelsim.studies.run_case import RunOutput

# Without markup: "[m]" is a unit, and a case may be named "[bold]".
out = Console(highlight=False, markup=False)
err = Console(stderr=True, highlight=False, markup=False, soft_wrap=True)

TONNE = 1000.0  # kg
ROUNDING = 1e-6  # m: a micrometre is rounding


def say(text: str) -> None:
    """Print a sentence, wrapped to the terminal."""
    out.print(text)


def warn(sentences: Iterable[str]) -> None:
    """Print warnings on standard error."""
    for sentence in sentences:
        err.print(f"warning: {sentence}")


@contextmanager
def progress_bars() -> Iterator[Callable[[str], Callable[[float, float], None]]]:
    """Bars on a terminal, silence elsewhere; yields a maker of callbacks (done, total)."""
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=err, transient=True, disable=not err.is_terminal) as progress:

        def track(label: str) -> Callable[[float, float], None]:
            task = progress.add_task(label, visible=False)

            def update(done: float, total: float) -> None:
                progress.update(task, completed=done, total=total, visible=done < total)

            return update

        yield track


def show_facts(facts: ShipFacts) -> None:
    """The particulars of a ship at rest, beside the published ones."""
    cb, cf = facts.center_of_buoyancy, facts.center_of_flotation
    rows = {
        "panels wet, total": f"{facts.panels_wet}, {facts.panels_total}",
        "mass": f"{_mass(facts.mass)} in water of {facts.water_density:g} kg/m3",
        "displaced volume": f"{facts.displaced_volume:.6g} m3",
        "draft, trim by stern": f"{_metres(facts.draft)}, {_metres(facts.trim_by_stern)}",
        "centre of gravity": _forward_and_up(facts.center_of_gravity),
        "centre of buoyancy": _forward_and_up(cb),
        "centre of flotation": _along(cf[0]),
        "waterline length, beam": f"{facts.waterline_length:.5g} m, {facts.waterline_beam:.5g} m",
        "waterplane, wetted surface": f"{facts.waterplane_area:.6g} m2, {facts.wetted_surface:.6g} m2",
        "block coefficient": f"{facts.block_coefficient:.4f}",
        "GM transverse, longitudinal": f"{_metres(facts.gm_transverse)}, {_metres(facts.gm_longitudinal)}",
    }
    if facts.mesh_defect is not None:
        rows |= _defect_rows(facts.mesh_defect)
    show_rows(f"{facts.name}, at rest in calm water", rows)
    if facts.published:
        _show_published(facts.published)


def _defect_rows(defect: MeshDefect) -> dict[str, str]:
    """What the panels lose of their form, under 80 columns."""
    volume, area, transverse, longitudinal = (f"{_number(value, 2)} %" for value in astuple(defect))
    return {
        "panels less smooth form": f"volume {volume}, waterplane {area}",
        "  its second moments": f"transverse {transverse}, longitudinal {longitudinal}",
    }


def _forward_and_up(point: tuple[float, ...]) -> str:
    side = "below" if point[2] < -ROUNDING else "above"
    return f"{_along(point[0])}, {_metres(abs(point[2]))} {side} the baseline"


def _along(x: float) -> str:
    if abs(x) < ROUNDING:
        return "at midships"
    return f"{_metres(abs(x))} {'forward' if x > 0.0 else 'aft'} of midships"


def _metres(value: float) -> str:
    return f"{_number(value, 4)} m"


def _mass(kilograms: float) -> str:
    return f"{kilograms:.4g} kg" if kilograms < TONNE else f"{kilograms / TONNE:.6g} t"


def _number(value: float, digits: int) -> str:
    """A number in so many digits, without rounding noise and without a -0."""
    return f"{0.0 if abs(value) < ROUNDING else value:.{digits}g}"


def _show_published(published: Mapping[str, Published]) -> None:
    table = Table("in SI units", "published", "here", "difference", box=None, padding=(0, 2))
    for key, entry in published.items():
        name, scale = key.replace("_", " ").replace("center", "centre"), 1.0
        if key == "mass" and entry.published >= TONNE:
            name, scale = "mass in t", 1 / TONNE
        here = "–" if entry.here is None else _number(scale * entry.here, 6)
        relative = entry.relative_difference
        difference = "not compared" if relative is None else f"{100 * relative:+z.2f} %"
        table.add_row(name, _number(scale * entry.published, 6), here, difference)
    out.print(table)


def show_rows(title: str, rows: Mapping[str, str]) -> None:
    out.print(title, style="bold")
    table = Table(show_header=False, box=None, padding=(0, 2))
    for name, value in rows.items():
        table.add_row(name, value)
    out.print(table)


def show_case(case: Case) -> None:
    """What a case will run: waves, supplementary terms, coefficients, time."""
    run, hydrodynamics = case.file.run, case.file.hydrodynamics
    database = case.stored_database() or stored_database(
        case.ship, hydrodynamics.method, hydrodynamics.section_form
    )
    source = "computed when it is run" if database is None else "stored; what they cover is told below"
    rows = {
        "sea": _sea(case),
        "supplementary stiffness": _by_motion(case.supplementary.stiffness),
        "supplementary damping": _by_motion(case.supplementary.damping),
        "roll damping": _roll_damping(case),
        "points": "; ".join(f"{name} at {x:g}, {y:g}, {z:g} m" for name, (x, y, z) in case.points.items())
        or "none",
        "coefficients": f"{_source(hydrodynamics)}, {source}",
        "run": f"{run.model}, {run.speed_knots:g} knots, ramp {run.ramp:g} s and {run.duration:g} s,"
        f" {run.steps} {run.stepper} steps of {run.time_step:g} s",
    }
    show_rows(case.name, rows)
    if database is not None:
        require_waves_held(database, case.seaway.components)
        show_coverage(database)


def _source(section: HydrodynamicsSection) -> str:
    lewis = " with Lewis forms" if section.section_form == "lewis" else ""
    return section.file or section.method + lewis


def show_coverage(database: HydroDatabase) -> None:
    """What a database covers, and where it comes from."""
    out.print("Coefficients", style="bold")
    for line in coverage(database).splitlines():
        out.print(Padding(line, (0, 0, 0, 2)))


def _sea(case: Case) -> str:
    components, seaway = case.seaway.components, case.seaway
    if not components.count:
        return "calm water"
    heading = _headings(components)
    if components.count == 1:
        height, omega = 2 * components.amplitude[0], components.frequency[0]
        theory = "second-order Stokes" if components.second_order else "regular"
        return f"{theory} waves, height {height:.4g} m, {omega:.4g} rad/s, {heading}"
    run = case.file.run
    again = repeat_time(components, case.speed, run.ramp + run.duration, gravity=case.ship.gravity)
    repeat = "does not repeat within the run" if again is None else f"repeats after {again:.0f} s"
    significant = 4 * components.variance**0.5
    seed = f", seed {case.file.seaway.seed}" if isinstance(seaway, RandomSeaway) else ""
    return (
        f"{seaway.kind}{seed}, {components.count} components, 4 × RMS of the elevation"
        f" {significant:.4g} m, {heading}; as the ship meets it, it {repeat}"
    )


def _headings(components: WaveComponents) -> str:
    """The heading of the waves, or their mean, and how far they spread about it."""
    mean = np.angle(np.sum(components.amplitude**2 * np.exp(1j * components.wave_heading)))
    heading = f"heading {np.rad2deg(mean) % 360.0:.4g}° (0° following, 180° head)"
    return f"mean {heading}" if np.ptp(components.wave_heading) else heading


def _roll_damping(case: Case) -> str:
    section = case.file.roll_damping
    terms = section.model_dump(include={"linear", "quadratic", "cubic"}, exclude_none=True)
    return {
        "none": "none beside the supplementary one",
        "percent": f"{section.critical_percent or 0.0:g} % of critical",
        "terms": ", ".join(f"{name} {value:g}" for name, value in terms.items()) + " (N m s, s2, s3)",
        "ikeda": f"Ikeda's components at {case.file.run.speed_knots:g} knots",
    }[section.method]


def _by_motion(values: Mapping[str, float]) -> str:
    return ", ".join(f"{motion} {value:g}" for motion, value in values.items()) or "none"


def show_result(result: "RunOutput", known: Sequence[str], imports: float) -> None:
    """The statistics of a run, what it cost, its notes but the `known` ones, where its files are.

    `imports` are the CPU seconds from the start of the program to the first work on the case.
    """
    statistics = result.statistics
    if statistics.duration > 0.0:
        out.print(statistics_table(statistics))
        for point in statistics.points:
            out.print(point_table(statistics, point))
    if statistics.note:
        say(statistics.note)
    factor = statistics.realtime_factor
    if factor:
        say(
            f"Time loop: {statistics.simulated_seconds:g} s of sea in {statistics.cpu_seconds:.2f} s of CPU,"
            f" {factor:.0f} times faster than real time."
        )
    stages = ", ".join(f"{name} {seconds:.1f}" for name, seconds in result.seconds.items())
    say(
        f"CPU seconds by stage: start and imports {imports:.1f}, {stages}"
        f" (of the run {statistics.jit_seconds:.1f} for compilation and set-up)."
    )
    for note in result.history.notes:
        if note not in known:
            say(f"note: {note}")
    files = ", ".join(f"{name} ({_size(result.folder / name)})" for name in result.files)
    out.print(f"Files in {result.folder}:", soft_wrap=True)
    say(f"  {files}")
    recording = shlex.quote(str(result.folder / "run.rrd"))
    out.print(f"To watch: panelsim view {recording}", soft_wrap=True)


def _size(path: Path) -> str:
    size = path.stat().st_size
    return f"{size / 1e6:.1f} MB" if size > 1e5 else f"{size / 1e3:.1f} kB"
