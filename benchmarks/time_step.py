"""What a time step costs beside its force evaluations. Run: python benchmarks/time_step.py [--quick]

The halifax hull with 2596 panels at 20 knots in 37 waves, nonlinear model, alone and in a batch of 16.
Three things take turns in each round, so that other work on the machine touches all alike: the whole
steps of a short run (right-hand sides, stepper, record); at the very instants of these steps, the
right-hand sides (all loads and the accelerations); and the force evaluations (incident waves and buoyancy
over the wet hull).
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
from panelsim.motion.march import Limits, Record, march
from panelsim.motion.run_loads import run_loads
from panelsim.motion.steppers import make_stepper

BATCHES = (1, 16)
SPEED = 20 * ps.KNOT
TIME_STEP = 0.4  # s
ROUNDS, QUICK_ROUNDS = 15, 5
STEPS, LEAST_STEPS = 200, 25
STAGES = {"exponential": 1, "rk4": 4}  # right-hand sides of a step


def batch_calls(members: int, steps: int, stepper: str) -> tuple[Callable[[], None], ...]:
    """Evaluation, right-hand side and `steps` whole steps of a batch of ships under way."""
    ship = ps.load_ship("halifax", 2.5)
    database = ps.database_for(ship)
    frequencies = ps.EvenFrequencies(0.2, 2.0, 0.05)
    spectrum = ps.Bretschneider(7.5, 15.0)
    seas = [
        ps.RandomSeaway(spectrum, frequencies, np.deg2rad(150), seed=n).components for n in range(members)
    ]
    speeds = [SPEED] * members
    loads, known = run_loads(
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
    equations = EquationsOfMotion(ship.inertia, loads, Radiation(database, speeds))
    scheme = make_stepper(stepper, equations, known, TIME_STEP)
    begin = scheme.start(np.zeros((members, 6)), np.zeros((members, 6)))
    limits = Limits(0.0, heave=0.5 * ship.length, drift=100.0 * ship.length)

    def whole_steps() -> None:
        record = Record(steps + 1, members, equations.load_names)
        record.add(begin)
        march(scheme, begin, record, steps=steps, time_step=TIME_STEP, limits=limits)

    asked: list[tuple[float, FloatArray]] = []
    evaluate = equations.evaluate

    def listening(time: float, motion: FloatArray) -> tuple[FloatArray, FloatArray]:
        asked.append((time, motion.copy()))
        return evaluate(time, motion)

    equations.evaluate = listening
    whole_steps()
    del equations.evaluate
    instants = [Instant(time, 1.0, motion[:, :6], motion[:, 6:12]) for time, motion in asked]

    def right_hand_sides() -> None:
        for instant, motion in asked:
            equations.evaluate(instant, motion)

    def evaluations() -> None:
        for instant in instants:
            wetted.in_ship_axes(instant)

    return evaluations, right_hand_sides, whole_steps


def measure(members: int, rounds: int, stepper: str) -> FloatArray:
    """CPU microseconds a member of an evaluation, a right-hand side and a whole step, by rounds (R, 3)."""
    steps = max(STEPS // members, LEAST_STEPS)
    calls = batch_calls(members, steps, stepper)
    spent = np.empty((rounds, len(calls)))
    for turn in range(rounds):
        for column, call in enumerate(calls):
            begin = time.process_time()
            call()
            spent[turn, column] = time.process_time() - begin
    evaluations = STAGES[stepper] * steps
    return spent * 1e6 / members / np.array([evaluations, evaluations, steps])


def told(spent: FloatArray, stages: int) -> str:
    """The rounds in words; differences and ratios are those within a round."""
    evaluation, right_hand_side, step = spent.T
    beside = {
        "right-hand side": right_hand_side - evaluation,
        "step, for each of its evaluations": step / stages - evaluation,
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
    for stepper, stages in STAGES.items():
        for members in BATCHES:
            print(f"{stepper}, batch of {members}: {told(measure(members, rounds, stepper), stages)}")


if __name__ == "__main__":
    main()
