"""The command line: panelsim new, check, run, hull, hydro, view, export."""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from rich.table import Table

import panelsim
from panelsim.case import Case
from panelsim.case.case import MESH_SUFFIXES
from panelsim.case.template import case_template
from panelsim.errors import PanelsimError
from panelsim.files import replacing
from panelsim.hull.checks import check_mesh
from panelsim.hull.form import load_hull
from panelsim.hull.readers import read_mesh
from panelsim.hydro.database import HydroDatabase
from panelsim.motion.history import History
from panelsim.results.export import history_to_csv
from panelsim.results.tables import statistics_table
from panelsim.seaway.components import repeat_time
from panelsim.ship.bundled import load_ship
from panelsim.ship.facts import ShipFacts, ship_facts
from panelsim.ship.ship import Ship
from panelsim.studies.run_case import RunOutput, run_case

EXIT_BAD_INPUT = 2
EXIT_ENDED_EARLY = 3

app = typer.Typer(
    help="Nonlinear panel-method, time-domain ship-motion solver.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
out = Console(highlight=False, soft_wrap=True)
err = Console(stderr=True, highlight=False, soft_wrap=True)

Force = Annotated[bool, typer.Option("--force", help="Replace files that panelsim writes.")]
Overrides = Annotated[
    list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Override, e.g. seaway.seed=7.")
]
PanelArea = Annotated[float | None, typer.Option("--panel-area", help="Nominal panel area [m2].")]


def main() -> None:
    """Run the command line; bad input ends in one message and exit code 2, never a traceback."""
    try:
        app()
    except PanelsimError as error:
        err.print(f"error: {error}", markup=False)
        sys.exit(EXIT_BAD_INPUT)
    except KeyboardInterrupt:
        err.print("interrupted")
        sys.exit(130)


def _version(wanted: bool) -> None:
    if wanted:
        out.print(f"panelsim {panelsim.__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="Name of the case; NAME.toml is written.")],
    ship: Annotated[str, typer.Option(help="A bundled hull.")] = "halifax",
) -> None:
    """Write a commented case file to start from."""
    path = Path(name).with_suffix(".toml")
    if path.exists():
        raise PanelsimError("The case file exists already", got=path, remedy="choose another name")
    text = case_template(load_hull(ship))
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8")
    out.print(f"Wrote {path}. Next: panelsim check {path}, then panelsim run {path}", markup=False)


@app.command()
def check(
    what: Annotated[Path, typer.Argument(help="A case file, or a mesh file with its unit and axes.")],
    overrides: Overrides = None,
    length_unit: Annotated[str | None, typer.Option(help="Mesh: m, mm, cm, ft, in.")] = None,
    up: Annotated[str, typer.Option(help="Mesh: axis that points up.")] = "z",
    forward: Annotated[str, typer.Option(help="Mesh: axis that points to the bow.")] = "x",
    wave_length: Annotated[float | None, typer.Option(help="Mesh: shortest wave [m].")] = None,
) -> None:
    """Read a case or a mesh, say what it is and what is wrong with it; run nothing."""
    if what.suffix.lower() in MESH_SUFFIXES:
        _check_mesh(what, length_unit, up, forward, wave_length)
        return
    case = Case.load(what, overrides or ())
    _print_facts(ship_facts(case.ship))
    _print_sea(case)
    out.print("The case is sound.")


def _check_mesh(
    path: Path, length_unit: str | None, up: str, forward: str, wave_length: float | None
) -> None:
    if length_unit is None:
        raise PanelsimError(
            "A mesh file does not say its unit", got=path, remedy="give --length-unit m (or mm, cm, ft, in)"
        )
    mesh = read_mesh(path, length_unit=length_unit, up=up, forward=forward)
    report = check_mesh(mesh, wave_length=wave_length)
    out.print(report.summary(), markup=False)
    if report.problems:
        raise typer.Exit(EXIT_BAD_INPUT)


@app.command()
def run(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    out_folder: Annotated[
        Path | None, typer.Option("--out", help="Output folder; runs/CASE if not given.")
    ] = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Run a case: history.nc, statistics.json, report.md with plots, run.rrd."""
    case = Case.load(case_file, overrides or ())
    folder = out_folder if out_folder is not None else Path("runs") / case.name
    for warning in case.warnings():
        err.print(f"warning: {warning}", markup=False)
    with _progress() as track:
        result = run_case(
            case,
            folder,
            force=force,
            on_coefficients=track("hydrodynamic coefficients"),
            on_run=track("run"),
        )
    _print_run(result)
    if result.history.outcome != "finished":
        err.print(f"The run ended early: {result.statistics.outcome_detail}", markup=False)
        raise typer.Exit(EXIT_ENDED_EARLY)


@app.command()
def hull(
    name: Annotated[str, typer.Argument(help="A bundled hull or a hull folder.")],
    panel_area: PanelArea = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    export: Annotated[Path | None, typer.Option(help="Write the mesh: .stl .obj .ply .glb .gdf")] = None,
) -> None:
    """Panel a hull and print its particulars at rest, beside the published ones."""
    ship = load_ship(name, panel_area)
    facts = ship_facts(ship)
    if as_json:
        sys.stdout.write(json.dumps(facts.as_dict(), indent=2) + "\n")
    else:
        _print_facts(facts)
        if ship.form is not None:
            for sentence in ship.form.assumptions:
                out.print(f"  assumed: {sentence}", markup=False)
    if export is not None:
        ship.mesh.export(export)
        err.print(f"Wrote {export}", markup=False)


@app.command()
def hydro(
    what: Annotated[str, typer.Argument(help="A bundled hull, a hull folder or a case file.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="NetCDF file to write.")],
    method: Annotated[str, typer.Option(help="bem (three-dimensional boundary elements).")] = "bem",
    force: Force = False,
) -> None:
    """Compute the hydrodynamic coefficients of a ship and store them."""
    if output.exists() and not force:
        raise PanelsimError("The file exists already", got=output, remedy="use --force to replace it")
    ship = _ship_of(what)
    with _progress() as track:
        database = HydroDatabase.compute(ship, method, progress=track("hydrodynamic coefficients"))
    database.save(output)
    top = database.frequencies.max()
    out.print(f"Wrote {output}: {len(database.frequencies)} frequencies to {top:.2f} rad/s", markup=False)


@app.command()
def view(recordings: Annotated[list[Path], typer.Argument(help="Recordings (.rrd).")]) -> None:
    """Open recordings in the rerun viewer."""
    for path in recordings:
        if not path.is_file():
            raise PanelsimError("There is no such recording", got=path)
    from panelsim.view.viewer import open_viewer

    raise typer.Exit(open_viewer(recordings))


@app.command()
def export(
    folder: Annotated[Path, typer.Argument(help="Output folder of a run.")],
    csv: Annotated[bool, typer.Option("--csv", help="Write motions.csv and loads.csv.")] = False,
) -> None:
    """Turn a saved history into other formats."""
    if not csv:
        raise PanelsimError("No format was asked for", allowed="--csv")
    for path in history_to_csv(History.load(folder / "history.nc"), folder):
        out.print(f"Wrote {path}", markup=False)


def _ship_of(what: str) -> Ship:
    return Case.load(what).ship if Path(what).suffix == ".toml" else load_ship(what)


@contextmanager
def _progress() -> Iterator[Callable[[str], Callable[[float, float], None]]]:
    """Bars on a terminal, silence elsewhere; yields a maker of callbacks (done, total)."""
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    with Progress(*columns, console=err, transient=True, disable=not err.is_terminal) as progress:

        def track(label: str) -> Callable[[float, float], None]:
            task = progress.add_task(label, visible=False)

            def update(done: float, total: float) -> None:
                progress.update(task, completed=done, total=total, visible=done < total)

            return update

        yield track


def _print_facts(facts: ShipFacts) -> None:
    table = Table(title=f"{facts.name}, at rest in calm water", show_header=False, box=None, padding=(0, 2))
    cg, cb, cf = facts.center_of_gravity, facts.center_of_buoyancy, facts.center_of_flotation
    rows = [
        ("panels wet / total", f"{facts.panels_wet} / {facts.panels_total}"),
        ("mass", f"{facts.mass / 1000:.1f} t in water of {facts.water_density:g} kg/m3"),
        ("displaced volume", f"{facts.displaced_volume:.2f} m3"),
        ("draft, trim by stern", f"{facts.draft:.3f} m, {facts.trim_by_stern:.3f} m"),
        ("centre of gravity", f"{cg[0]:.3f} m from midships, {cg[2]:.3f} m above the baseline"),
        ("centre of buoyancy", f"{cb[0]:.3f} m from midships, {cb[2]:.3f} m above the baseline"),
        ("centre of flotation", f"{cf[0]:.3f} m from midships"),
        ("waterline length, beam", f"{facts.waterline_length:.2f} m, {facts.waterline_beam:.2f} m"),
        ("waterplane, wetted surface", f"{facts.waterplane_area:.1f} m2, {facts.wetted_surface:.1f} m2"),
        ("GM transverse, longitudinal", f"{facts.gm_transverse:.3f} m, {facts.gm_longitudinal:.1f} m"),
    ]
    for name, value in rows:
        table.add_row(name, value)
    for name, entry in facts.published.items():
        difference = (
            f"{entry.published:.6g} published, here {entry.here:.6g} ({100 * entry.difference:+.2f} %)"
        )
        table.add_row(name.replace("_", " "), difference)
    out.print(table)


def _print_sea(case: Case) -> None:
    components = case.seaway.components
    if not components.count:
        out.print("Calm water.")
        return
    again = repeat_time(components, case.speed, case.file.run.duration)
    repeat = f"repeats after {again:.0f} s" if again is not None else "does not repeat within the run"
    significant = 4 * components.variance**0.5
    out.print(
        f"{case.seaway.kind} sea of {components.count} components, 4 × RMS of the elevation"
        f" {significant:.3f} m; as the ship meets it, it {repeat}.",
        markup=False,
    )


def _print_run(result: RunOutput) -> None:
    out.print(statistics_table(result.statistics))
    factor = result.statistics.realtime_factor
    if factor is not None:
        loop = result.statistics.cpu_seconds
        out.print(f"Time loop {loop:.1f} s of CPU: {factor:.0f} times faster than real time.")
    others = ", ".join(f"{name} {seconds:.1f}" for name, seconds in result.seconds.items())
    out.print(f"CPU seconds by stage: {others} (of it compilation {result.statistics.jit_seconds:.1f}).")
    for note in result.history.notes:
        out.print(f"note: {note}", markup=False)
    for path in result.files:
        out.print(f"  {path}", markup=False)


if __name__ == "__main__":
    main()
