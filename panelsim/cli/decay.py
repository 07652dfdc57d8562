"""The command `decay`: run or read a roll decay, and say what its period and damping are."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from panelsim.case import Case
from panelsim.cli.options import EXIT_ENDED_EARLY, Force, Overrides
from panelsim.cli.show import err, out, progress_bars, say, show_rows, warn
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.decay import RollDecay, fit_roll_decay
from panelsim.hydro.roll_damping.natural import NaturalRoll
from panelsim.motion.history import History
from panelsim.results.decay_record import DecayRecord
from panelsim.ship.facts import ship_warnings
from panelsim.studies.output_folder import make_output_folder, refuse_occupied_folder

HEEL_DEG = 10.0
PICTURE = "decay.png"
# A fit that misses more of the record than this is not one of a single free roll.
MUCH_LEFT = 0.05


def decay(
    what: Annotated[Path, typer.Argument(help="Case file (.toml), history (.nc) or record (.csv).")],
    heel: Annotated[
        float | None, typer.Option(help=f"Case: heel at release [deg], {HEEL_DEG:g} if not given.")
    ] = None,
    out_folder: Annotated[
        Path | None, typer.Option("--out", help="Output folder; runs/NAME-decay if not given.")
    ] = None,
    force: Force = False,
    overrides: Overrides = None,
) -> None:
    """Run or read a roll decay; print its period and damping, draw it.

    The files are decay.png and, of a case, history.nc.
    """
    if what.suffix not in (".toml", ".nc", ".csv"):
        raise PanelsimError("This is no roll decay", got=what, allowed="a file .toml, .nc or .csv")
    folder = out_folder if out_folder is not None else Path("runs") / f"{what.stem}-decay"
    refuse_occupied_folder(folder, force=force)
    natural = None
    if what.suffix == ".toml":
        history, natural = _run(what, HEEL_DEG if heel is None else heel, overrides or (), folder)
        record = DecayRecord.of_history(history)
    else:
        if heel is not None or overrides:
            raise PanelsimError("--heel and --set are for a case file", got=what, remedy="leave them out")
        record = _read(what)
    fit = fit_roll_decay(record.time, record.roll)
    _show(what.name, record, fit, natural)
    from panelsim.view.decay_plot import plot_roll_decay  # brings matplotlib

    make_output_folder(folder)
    plot_roll_decay(record, fit, folder / PICTURE)
    files = [PICTURE] if natural is None else [PICTURE, "history.nc"]
    out.print(f"Files in {folder}: {', '.join(files)}", soft_wrap=True)


def _read(path: Path) -> DecayRecord:
    if not path.is_file():
        raise PanelsimError("There is no such file", got=path)
    return DecayRecord.read_csv(path) if path.suffix == ".csv" else DecayRecord.of_history(History.load(path))


def _run(
    path: Path, heel: float, overrides: list[str] | tuple[()], folder: Path
) -> tuple[History, NaturalRoll]:
    """The decay of a case from `heel` [deg], its history saved; ends the program where it ended early."""
    from panelsim.studies.roll_decay import run_roll_decay

    case = Case.load(path, overrides)
    warn(ship_warnings(case.ship))
    with progress_bars() as track:
        result = run_roll_decay(
            case,
            float(np.deg2rad(heel)),
            on_coefficients=track("hydrodynamic coefficients"),
            on_run=track("roll decay"),
        )
    make_output_folder(folder)
    result.history.save(folder / "history.nc", overwrite=True)
    if result.history.outcome != "finished":
        (folder / PICTURE).unlink(missing_ok=True)  # that of another decay
        detail = result.history.attrs["outcome_detail"]
        err.print(f"The decay ended early: {result.history.outcome}, {detail}")
        raise typer.Exit(EXIT_ENDED_EARLY)
    return result.history, result.natural


def _show(name: str, record: DecayRecord, fit: RollDecay, natural: NaturalRoll | None) -> None:
    """The fit in words, dimensional too where the inertia is known."""
    largest = float(np.max(np.abs(record.roll - fit.offset - fit.trend * record.time)))
    equivalent = 100.0 * fit.equivalent_damping_ratio(largest)
    rows = {
        "equation": "x¨ + b1 x˙ + b2 x˙|x˙| + (2π/T)² x = 0",
        "natural period T": f"{fit.period:.4f} s",
        "linear b1": f"{fit.linear:.4g} 1/s",
        "quadratic b2": f"{fit.quadratic:.4g} 1/rad",
        "damping ratio, linear": f"{100.0 * fit.damping_ratio:.3g} % of critical",
        f"  with b2 at {np.rad2deg(largest):.3g}°": f"{equivalent:.3g} % of critical",
        "standard error T, b1, b2": f"{fit.period_error:.2g} s, {fit.linear_error:.2g} 1/s,"
        f" {fit.quadratic_error:.2g} 1/rad",
        "list, drift": f"{np.rad2deg(fit.offset):.3g}°, {np.rad2deg(fit.trend):.2g}°/s",
        "RMS of record less fit": f"{np.rad2deg(fit.residual):.2g}°, {fit.extremes} extremes",
    }
    if natural is not None:
        terms = fit.terms(natural.inertia)
        rows |= {
            "small roll by the matrices": f"T {natural.period:.4f} s, I {natural.inertia:.4g} kg m2",
            "I b1, I b2": f"{terms.linear:.4g} N m s, {terms.quadratic:.4g} N m s2",
        }
    show_rows(f"Roll decay of {name}, {len(record.time)} samples", rows)
    if natural is not None:
        say("The damping is all that the ship has: waves, supplementary and viscous damping.")
    if fit.residual > MUCH_LEFT * largest:
        warn(["The record is not the free decay of one roll: look at the figure before using the fit."])
