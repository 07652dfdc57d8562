"""What a run must have before it is begun: values in range, and a time step that can carry it."""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import STRETCHINGS, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.supplementary import Supplementary
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship

MODELS = ("nonlinear", "linear")
MOST_STEPS = 2_000_000  # a run keeps some 400 bytes a step
# RK4 stays stable to ω dt = 2.83, but at 2 it takes a quarter off a motion with every step.
LONGEST_STEP = 2.0  # over the highest natural frequency of the ship
# Two samples a period are the least that can show a wave at all.
LEAST_SAMPLES = np.pi
ENERGY_THAT_COUNTS = 0.05


def require_run(
    *,
    speed: float,
    duration: float,
    time_step: float,
    ramp: float,
    capsize_angle: float,
    model: str,
    stretching: str,
) -> None:
    """Raise PanelsimError for a value that no run can have; SI units and radians."""
    for name, word, known in (("model", model, MODELS), ("wave stretching", stretching, STRETCHINGS)):
        if word not in known:
            raise PanelsimError(f"Unknown {name}", got=word, allowed=" | ".join(known))
    bounds = {
        "speed": (speed, 0.0, 50.0, "m/s"),
        "time_step": (time_step, 1e-4, 5.0, "s"),
        "duration": (duration, time_step, 1e6, "s"),
        "ramp": (ramp, 0.0, 1e5, "s"),
        "capsize_angle": (capsize_angle, 0.0, np.pi, "rad"),
    }
    for name, (value, low, high, unit) in bounds.items():
        if not low <= value <= high:
            raise PanelsimError(
                f"The {name} is out of range", got=f"{value:g} {unit}", allowed=f"{low:g} to {high:g} {unit}"
            )
    if (ramp + duration) / time_step > MOST_STEPS:
        raise PanelsimError(
            "The run has too many steps",
            got=f"{(ramp + duration) / time_step:.3g}",
            allowed=f"at most {MOST_STEPS}",
            remedy="shorten the run, or take a longer time step",
        )


def require_time_step(
    time_step: float,
    inertia: FloatArray,
    stiffness: FloatArray,
    components: WaveComponents,
    encounter: FloatArray,
) -> None:
    """Raise PanelsimError where the step [s] is too long for the ship's own motions or for the waves.

    `inertia` M + A∞ and `stiffness` with the supplementary terms (6, 6); `encounter` (M,) [rad/s].
    """
    squared = np.linalg.eigvals(np.linalg.solve(inertia, stiffness)).real
    natural = float(np.sqrt(max(squared.max(), 0.0)))
    if natural * time_step > LONGEST_STEP:
        raise PanelsimError(
            "The time step is too long for the motions of the ship",
            got=f"{time_step:g} s, with a natural period of {2 * np.pi / natural:.3g} s",
            allowed=f"at most {LONGEST_STEP / natural:.2g} s",
            remedy="shorten run.time_step; a tenth of the natural period is accurate",
        )
    share = energy_share(components, np.abs(encounter) * time_step > LEAST_SAMPLES)
    if share > ENERGY_THAT_COUNTS:
        raise PanelsimError(
            "The time step is too long for the waves that the ship meets",
            got=f"{time_step:g} s; {100 * share:.0f} % of the wave energy passes in less than two steps",
            allowed=f"at most {LEAST_SAMPLES / np.abs(encounter).max():.2g} s for all of it",
            remedy="shorten run.time_step",
        )


def energy_share(components: WaveComponents, chosen: np.ndarray) -> float:
    """Share of the wave energy that the chosen components (M,) carry; 0 in calm water."""
    energy = components.amplitude**2
    return float(energy[chosen].sum() / energy.sum()) if energy.any() else 0.0


def require_types(ship: object, database: object, supplementary: object, notes: object) -> None:
    """Raise PanelsimError for arguments that are names or tables of what they should be."""
    wanted = {
        "ship": (ship, Ship, "a Ship, as load_ship() makes it"),
        "database": (database, HydroDatabase, "a HydroDatabase, as database_for(ship) gives it"),
        "supplementary": (supplementary, Supplementary | None, "a Supplementary, or None"),
    }
    for name, (value, kind, allowed) in wanted.items():
        if not isinstance(value, kind):
            raise PanelsimError(f"The {name} is of another kind", got=repr(value)[:60], allowed=allowed)
    if isinstance(notes, str):
        raise PanelsimError("The notes are one text", got=repr(notes)[:60], allowed="a list of sentences")


def six_numbers(name: str, values: Sequence[float] | FloatArray) -> FloatArray:
    """Six finite numbers as an array, else PanelsimError."""
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.shape != (6,) or not np.isfinite(array).all():
        raise PanelsimError(f"The {name} is not six finite numbers", got=values)
    return array
