"""The commands of the command line, and how each kind of end becomes an exit code."""

import json
import math
import shlex
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from pydantic import ValidationError

import panelsim
from panelsim.case import Case
from panelsim.case.ship_section import is_mesh_file
from panelsim.case.template import case_template, hull_entry
from panelsim.cli.arguments import refuse_existing, require_suffix, ship_of
from panelsim.cli.compare import compare
from panelsim.cli.converge import converge
from panelsim.cli.cost import cost
from panelsim.cli.decay import decay
from panelsim.cli.hydro import hydro
from panelsim.cli.options import EXIT_BAD_INPUT, EXIT_ENDED_EARLY, Force, Overrides
from panelsim.cli.reproduce import reproduce
from panelsim.cli.respond import respond
from panelsim.cli.righting import righting
from panelsim.cli.show import err, out, progress_bars, say, show_case, show_facts, show_result, warn
from panelsim.cli.show_sea import show_sea
from panelsim.cli.sweep import sweep
from panelsim.cli.view import view
from panelsim.errors import PanelsimError
from panelsim.files import replacing
from panelsim.hull.checks import check_mesh, require_sound
from panelsim.hull.export import require_mesh_target
from panelsim.hull.form import load_hull
from panelsim.hull.readers import SUFFIXES, read_mesh
from panelsim.motion.history import History
from panelsim.results.export import CSV_FILES, history_to_csv
from panelsim.seaway.exchange.components_csv import write_components
from panelsim.ship.facts import ship_facts
from panelsim.studies.going_on import begun_run
from panelsim.studies.output_folder import make_output_folder, refuse_occupied_folder

app = typer.Typer(
    help="Nonlinear panel-method, time-domain ship-motion solver.",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # it takes the "[m]" of a unit for markup
)
app.command()(decay)
app.command()(cost)
app.add_typer(converge, name="converge")
app.add_typer(compare, name="compare")

_NUMBERS = {"float_parsing": "a number", "int_parsing": "a whole number"}


def call() -> int:
    """Call the command that the arguments of the program name; returns the exit code."""
    try:
        code: int | None = app(standalone_mode=False)
    except PanelsimError as error:
        return _refuse(str(error))
    except typer.BadParameter as error:
        return _refuse(_bad_value(error))
    except typer.TyperException as error:
        return _refuse(_bad_usage(error))
    except OSError as error:
        return _refuse(f"{error.strerror or error}.\n  got: {error.filename or 'no file name'}")
    except MemoryError:
        remedy = "shorten the run, take a longer time_step or fewer components"
        return _refuse(str(PanelsimError("There is not enough memory", remedy=remedy)))
    except RecursionError:
        return _refuse(str(PanelsimError("The input is nested too deeply")))
    return code or 0


def _refuse(message: str) -> int:
    err.print(f"error: {message}")
    return EXIT_BAD_INPUT


def _bad_value(error: typer.BadParameter) -> str:
    """The parser's words on the value of an option; ours for one that is no number."""
    message, cause = error.format_message(), error.__cause__
    faults = cause.errors() if isinstance(cause, ValidationError) else []
    allowed = _NUMBERS.get(faults[0]["type"]) if len(faults) == 1 else None
    what = message.partition(": ")[0]  # Invalid value for '--option'
    if allowed is None and len(faults) == 1 and "or equal to" in faults[0]["msg"]:
        allowed = faults[0]["msg"].replace("Input should be ", "")
    return (
        message
        if allowed is None
        else str(PanelsimError(what, got=f'"{faults[0]["input"]}"', allowed=allowed))
    )


def _bad_usage(error: typer.TyperException) -> str:
    """The parser's words; for a command that is missing or unknown those that there are, too."""
    message = error.format_message()
    known = getattr(getattr(getattr(error, "ctx", None), "command", None), "commands", None)
    if known is None or "command" not in message:
        return message
    return str(PanelsimError(message, allowed=", ".join(sorted(known))))


def _version(wanted: bool) -> None:
    if wanted:
        out.print(f"panelsim {panelsim.__version__}")
        raise typer.Exit


@app.callback(invoke_without_command=True)
def _options(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    if context.invoked_subcommand is None:
        err.print(context.get_help())
        raise typer.Exit(EXIT_BAD_INPUT)


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="Name of the case; NAME.toml is written.")],
    ship: Annotated[str, typer.Option(help="A bundled hull, or a hull folder.")] = "halifax",
) -> None:
    """Write a commented case file to start from."""
    path = Path(name)
    if not path.name:
        raise PanelsimError("The case has no name", got=f'"{name}"')
    if path.suffix != ".toml":
        path = path.with_name(f"{path.name}.toml")
    if path.exists():
        raise PanelsimError("The case file exists already", got=path, remedy="choose another name")
    text = case_template(load_hull(ship), hull_entry(ship, path))
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8")
    quoted = shlex.quote(str(path))
    out.print(f"Wrote {path}. Next: panelsim check {quoted}, then panelsim run {quoted}", soft_wrap=True)


@app.command()
def check(
    what: Annotated[Path, typer.Argument(help="A case file, or a mesh file with its unit and axes.")],
    overrides: Overrides = None,
    length_unit: Annotated[str | None, typer.Option(help="Mesh: m, mm, cm, ft or in.")] = None,
    up: Annotated[str | None, typer.Option(help="Mesh: file axis that points up, x to -z.")] = None,
    forward: Annotated[str | None, typer.Option(help="Mesh: file axis that points to the bow.")] = None,
    symmetry: Annotated[
        str | None, typer.Option(help='Mesh: "centreline" if the file holds one side of the hull.')
    ] = None,
    wave_length: Annotated[float | None, typer.Option(help="Mesh: shortest wave of the sea [m].")] = None,
) -> None:
    """Say what a case or a mesh is and what is wrong with it."""
    if is_mesh_file(what):
        if overrides:
            raise PanelsimError("A mesh file has no keys to override", got=f"--set {overrides[0]}")
        _check_mesh(what, length_unit, up, forward, symmetry, wave_length)
        return
    _require_case_file(what)
    if any(option is not None for option in (length_unit, up, forward, symmetry, wave_length)):
        raise PanelsimError(
            "An option for mesh files was given with a case file",
            got=what,
            remedy="leave out --length-unit, --up, --forward, --symmetry and --wave-length;"
            " [ship.mesh] in the case says what they say",
        )
    case = Case.load(what, overrides or ())
    show_facts(ship_facts(case.ship))
    show_case(case)
    warnings = case.warnings()
    warn(warnings)
    out.print("The case can be run; see the warnings." if warnings else "The case is sound.")


def _require_case_file(path: Path) -> None:
    """Raise PanelsimError for a file of another kind, by its suffix."""
    if path.suffix not in ("", ".toml") and not path.is_dir():
        raise PanelsimError(
            "This is neither a case file nor a mesh file that panelsim reads",
            got=path,
            allowed=f"a case file, .toml, or a mesh file, {', '.join(SUFFIXES)}",
        )


def _check_mesh(
    path: Path,
    length_unit: str | None,
    up: str | None,
    forward: str | None,
    symmetry: str | None,
    wave_length: float | None,
) -> None:
    if length_unit is None or up is None or forward is None:
        raise PanelsimError(
            "A mesh file does not say its unit and axes",
            got=path,
            remedy="give all three, for example --length-unit m --up z --forward x",
        )
    if wave_length is not None and not (math.isfinite(wave_length) and wave_length > 0.0):
        raise PanelsimError(
            "The wave length is not possible", got=f"{wave_length:g} m", allowed="more than 0 m"
        )
    mesh = read_mesh(path, length_unit=length_unit, up=up, forward=forward, symmetry=symmetry)
    out.print(check_mesh(mesh, wave_length=wave_length).summary())
    require_sound(mesh)


@app.command()
def run(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    out_folder: Annotated[
        Path | None, typer.Option("--out", help="Output folder; runs/CASE if not given.")
    ] = None,
    force: Force = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the interrupted or shorter run in the folder.")
    ] = False,
    overrides: Overrides = None,
) -> None:
    """Run a case; write history, statistics, report, recording.

    The files are history.nc, statistics.json, report.md with plots, run.rrd.
    """
    if resume and force:
        raise PanelsimError(
            "--resume goes on with the run in the folder, and --force begins it anew",
            got="both",
            remedy="give one of them",
        )
    from panelsim.studies.run_case import run_case  # brings matplotlib and rerun

    imports = time.process_time()
    case = Case.load(case_file, overrides or ())
    folder = out_folder if out_folder is not None else Path("runs") / case.name
    refuse_occupied_folder(folder, force=force or resume)
    warnings = case.warnings()
    warn(warnings)
    begun = begun_run(case, folder) if resume else None
    if begun is not None:
        length = case.file.run.ramp + case.file.run.duration
        out.print(f"Going on at {begun.time[-1]:g} s of {length:g} s.")
    with progress_bars() as track:
        result = run_case(
            case,
            folder,
            force=force,
            resume=begun,
            on_coefficients=track("hydrodynamic coefficients"),
            on_run=track("run"),
        )
    show_result(result, known=warnings, imports=imports)
    if result.history.outcome != "finished":
        detail = result.statistics.outcome_detail
        err.print(f"The run ended early: {result.history.outcome}, {detail}")
        if result.history.outcome == "interrupted":
            err.print(f"To go on: {_command_to_go_on(case_file, out_folder, overrides or ())}")
        raise typer.Exit(EXIT_ENDED_EARLY)


def _command_to_go_on(case_file: Path, out_folder: Path | None, overrides: Sequence[str]) -> str:
    where = [] if out_folder is None else ["--out", str(out_folder)]
    changes = [word for override in overrides for word in ("--set", override)]
    return shlex.join(["panelsim", "run", str(case_file), *where, *changes, "--resume"])


@app.command()
def sea(
    case_file: Annotated[Path, typer.Argument(help="Case file (TOML).")],
    out_folder: Annotated[
        Path | None, typer.Option("--out", help="Output folder; runs/CASE-sea if not given.")
    ] = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Print the parameters of the sea of a case, and draw it.

    The files are sea.png and components.csv.
    """
    case = Case.load(case_file, overrides or ())
    folder = out_folder if out_folder is not None else Path("runs") / f"{case.name}-sea"
    refuse_occupied_folder(folder, force=force)
    if not case.seaway.components.count:
        raise PanelsimError("There is nothing to look at in calm water", got='seaway.kind = "calm"')
    warnings = case.warnings()
    show_sea(case)
    warn(warnings)
    from panelsim.view.sea_picture import sea_picture  # brings matplotlib

    make_output_folder(folder)
    files = [sea_picture(case.seaway, case.ship, case.speed, folder / "sea.png")]
    table = folder / "components.csv"
    if case.seaway.components.second_order:
        table.unlink(missing_ok=True)  # of another sea, and its columns say nothing of the second order
    else:
        files.append(write_components(table, case.seaway.components, overwrite=True))
    out.print(f"Files in {folder}: {', '.join(file.name for file in files)}", soft_wrap=True)


app.command("response")(respond)


app.command()(sweep)


@app.command()
def hull(
    what: Annotated[str, typer.Argument(help="A bundled hull, a hull folder or a case file.")],
    panel_area: Annotated[float | None, typer.Option(help="Nominal panel area [m2].")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    export: Annotated[Path | None, typer.Option(help="Write the mesh: .stl .obj .ply .glb .gdf")] = None,
    sections: Annotated[
        Path | None, typer.Option(help="Draw its sections with their Lewis forms: a .png file.")
    ] = None,
    force: Force = False,
) -> None:
    """Print particulars of a hull at rest beside published ones."""
    if export is not None:
        require_mesh_target(export)
        refuse_existing(export, force)
    if sections is not None:
        require_suffix(sections, ".png")
        refuse_existing(sections, force)
    ship = ship_of(what, panel_area)
    if export is not None:
        ship.mesh.export(export)
    if sections is not None:
        from panelsim.view.section_picture import section_picture  # brings matplotlib

        section_picture(ship, sections)
    facts = ship_facts(ship)
    if as_json:
        sys.stdout.write(json.dumps(facts.as_dict(), indent=2, allow_nan=False) + "\n")
    else:
        show_facts(facts)
        for sentence in ship.form.assumptions if ship.form is not None else ():
            say(f"assumed: {sentence}")
        warn(facts.warnings)
    for file in (export, sections):
        if file is not None:
            err.print(f"Wrote {file}")


app.command()(righting)


app.command()(hydro)


app.command()(reproduce)


app.command()(view)


@app.command()
def export(
    run_folder: Annotated[Path, typer.Argument(help="Output folder of a run, or its history.nc.")],
    csv: Annotated[bool, typer.Option("--csv", help="Write motions.csv and loads.csv.")] = False,
    force: Force = False,
) -> None:
    """Turn a saved history into other formats."""
    if not csv:
        raise PanelsimError("No format was asked for", allowed="--csv")
    file = run_folder if run_folder.is_file() else run_folder / "history.nc"
    for name in CSV_FILES:
        refuse_existing(file.parent / name, force)
    for path in history_to_csv(History.load(file), file.parent):
        out.print(f"Wrote {path}")
