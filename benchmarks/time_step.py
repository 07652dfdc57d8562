"""What a time step costs beside its force evaluations. Run: python benchmarks/time_step.py [--quick]

The halifax hull with 2596 panels at 20 knots in 37 waves, nonlinear model, alone and in a batch of 16.
Three things take turns in each round, so that other work on the machine touches all alike: the whole
steps of a short run (right-hand sides, memory, stepper, record); at the very instants of these steps, the
right-hand sides (all loads and the accelerations); and the force evaluations (incident waves and buoyancy
over the wet hull). A step with one evaluation is what another stepper would have: a right-hand side and all
that is not right-hand side.
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

import panelsim as ps
from panelsim.conventions import FloatArray
from panelsim.loads.load import Instant
from panelsim.loads.radiation import Radiation
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.march import Limits, march
from panelsim.motion.run_loads import run_loads

BATCHES = (1, 16)
SPEED = 20 * ps.KNOT
TIME_STEP = 0.2  # s
ROUNDS, QUICK_ROUNDS = 15, 5
STEPS, LEAST_STEPS = 200, 25
STAGES = 4  # right-hand sides of a Runge-Kutta step


class Listener:
    """A load of nothing that keeps the instants at which it is asked."""

    name = "listener"

    def __init__(self) -> None:
        self.instants: list[Instant] = []

    def evaluate(self, instant: Instant) -> FloatArray:
        self.instants.append(instant)
        return np.zeros_like(instant.displacement)


def batch_calls(members: int, steps: int) -> tuple[Callable[[], None], ...]:
    """Evaluation, right-hand side and `steps` whole steps of a batch of ships under way."""
    ship = ps.load_ship("halifax", 2.5)
    database = ps.database_for(ship)
    frequencies = ps.EvenFrequencies(0.2, 2.0, 0.05)
    spectrum = ps.Bretschneider(7.5, 15.0)
    seas = [
        ps.RandomSeaway(spectrum, frequencies, np.deg2rad(150), seed=n).components for n in range(members)
    ]
    speeds = [SPEED] * members
    loads = run_loads(
        ship,
        seas,
        speeds,
        database=database,
        model="nonlinear",
        stretching="wheeler",
        pressure_method="auto",
        pressure_rule="vertex+centre",
        supplementary=ps.Supplementary.of(ship),
    )
    wetted = next(load for load in loads if isinstance(load, WettedSurface))
    radiation = Radiation(database, speeds, TIME_STEP)
    equations = EquationsOfMotion(ship.inertia, loads, radiation)
    start = np.zeros((members, 6))
    limits = Limits(0.0, heave=0.5 * ship.length, drift=100.0 * ship.length)

    def whole_steps(equations: EquationsOfMotion = equations) -> None:
        march(equations, start, start, steps=steps, time_step=TIME_STEP, ramp=0.0, limits=limits)

    listener = Listener()
    whole_steps(EquationsOfMotion(ship.inertia, [*loads, listener], radiation))
    instants = listener.instants
    past = radiation.past(radiation.start(start, start), 0.0)

    def right_hand_sides() -> None:
        for instant in instants:
            equations.evaluate(instant, past)

    def evaluations() -> None:
        for instant in instants:
            wetted.in_ship_axes(instant)

    return evaluations, right_hand_sides, whole_steps


def measure(members: int, rounds: int) -> FloatArray:
    """CPU microseconds a member of an evaluation, a right-hand side and a whole step, by rounds (R, 3)."""
    steps = max(STEPS // members, LEAST_STEPS)
    calls = batch_calls(members, steps)
    spent = np.empty((rounds, len(calls)))
    for turn in range(rounds):
        for column, call in enumerate(calls):
            begin = time.process_time()
            call()
            spent[turn, column] = time.process_time() - begin
    # A run of n steps ends with one more right-hand side, for the last row of its record.
    evaluations = STAGES * steps + 1
    return spent * 1e6 / members / np.array([evaluations, evaluations, evaluations / STAGES])


def told(spent: FloatArray) -> str:
    """The rounds in words; differences and ratios are those within a round."""
    evaluation, right_hand_side, step = spent.T
    beside = {
        "right-hand side": right_hand_side - evaluation,
        "Runge-Kutta step, for each of its evaluations": step / STAGES - evaluation,
        "step with one evaluation": step - (STAGES - 1) * right_hand_side - evaluation,
    }
    lines = [
        f"evaluation {np.median(evaluation):.0f}, spread {np.ptp(evaluation) / np.median(evaluation):.0%}"
    ]
    for name, more in beside.items():
        lines.append(f"{name}: +{np.median(more):.0f}, times {1 + np.median(more / evaluation):.2f}")
    return "\n  ".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description="Time a step beside its force evaluations.")
    parser.add_argument("--quick", action="store_true", help="fewer rounds")
    rounds = QUICK_ROUNDS if parser.parse_args().quick else ROUNDS
    print("CPU microseconds a member; what is more than the evaluation, and all of it over the evaluation")
    for members in BATCHES:
        print(f"batch of {members}: {told(measure(members, rounds))}")


if __name__ == "__main__":
    main()
