"""Why time and frequency domain part in regular waves: the worst point of each Froude number, solved for."""

from collections.abc import Mapping

import numpy as np

from panelsim.conventions import ComplexArray
from panelsim.results.rms_tables import markdown_table
from panelsim.results.verdicts import SLIGHT
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.excess_answer import ExcessAnswer, excess_answer, transom_immersion
from panelsim.studies.tm2003_190.excess_load import SECTIONS
from panelsim.studies.tm2003_190.regular_runs import (
    MODE_NAMES,
    MODES,
    Measured,
    RegularRuns,
    relative_difference,
    steepness_told,
    worst,
)


def found_causes(
    store: RunStore, runs: RegularRuns, found: Measured, linear: ComplexArray, shown: int
) -> dict[tuple[int, ...], ExcessAnswer]:
    """What makes the largest difference at each Froude number, if it is more than slight.

    At the steepness of index `shown`; by the indices of Froude number, λ/L and mode.
    """
    causes = {}
    for f, of_speed in enumerate(relative_difference(found.transfer[:, :, shown], linear, linear)):
        at = worst(of_speed)
        if at is not None and abs(of_speed[at]) > SLIGHT:
            causes[f, *at] = excess_answer(store, runs.by_index[f, at[0], shown], MODES[at[-1]])
    return causes


def growth(runs: RegularRuns, departure: ComplexArray) -> float:
    """Power of the steepness by which a departure (H,) grows between the two lowest waves; NaN for one."""
    if len(runs.steepness) < 2:
        return np.nan
    ratio = np.log(runs.steepness[1] / runs.steepness[0])
    return float(np.log(abs(departure[1]) / abs(departure[0])) / ratio)


def growth_told(runs: RegularRuns, found: Measured, linear: ComplexArray, at: tuple[int, ...]) -> str:
    """With which power of the height a transfer function departs; empty for one height."""
    power = growth(runs, found.transfer[at[0], at[1], :, at[-1]] - linear[at[0], at[1], at[-1]])
    if not np.isfinite(power):
        return ""
    low, high = (steepness_told(steepness) for steepness in runs.steepness[:2])
    return (
        f" At the worst point the transfer function departs as the {power:.1f}th power of the height"
        f" from H/λ {low} to {high}: a smooth hull would give the second."
    )


def causes_table(runs: RegularRuns, causes: Mapping[tuple[int, ...], ExcessAnswer]) -> str:
    """The difference of a run from the frequency domain beside what the linear ship makes of its causes."""
    if not causes:
        return ""
    rows = []
    for at, answer in causes.items():
        shares = (answer.run, answer.pressure, answer.stern, answer.displaced)
        told = [f"{100 * share:+.2g}" for share in shares]
        name = f"{runs.told(at[:-1])}, {MODE_NAMES[at[-1]]}"
        rows.append([name, *told, f"{answer.surge:+.1f}", answer.verdict])
    heads = (
        *("", "run [%]", "pressure [%]", "of the stern [%]"),
        *("pressure and diffraction [%]", "mean surge [m]", "cause"),
    )
    return (
        "\n### The largest difference at each Froude number, H/λ 1/20\n\n"
        + markdown_table(heads, rows, text_columns=1)
        + "\nBy how much the amplitude is larger than the linear one. Run: in the nonlinear run. Pressure: of"
        " the linear ship, when the part of the run's pressure load that is not linear is added to her load;"
        f" of the stern: when that part of the aftermost {SECTIONS}th of the length alone is added. Its"
        f" transom is wetted by {transom_immersion(runs.base.ship):.2f} m of calm water. The last figure has"
        " all of the pressure, and the diffraction load met where the waves hold her on average against the"
        " springs.\n"
    )
