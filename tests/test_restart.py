"""Restart: a run that goes on is, bit for bit, the run that never stopped; one of another run is refused."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.simulate import simulate_batch
from panelsim.motion.steppers import STEPPERS
from panelsim.seaway.frequencies import EvenFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship

Run = Callable[..., History]

SEA = RandomSeaway(Bretschneider(7.5, 9.9), EvenFrequencies(0.2, 2.0, 0.1), np.deg2rad(150.0), seed=1001)
GIVEN: dict[str, Any] = {
    "speed": 20 * KNOT,
    "ramp": 2.0,
    "time_step": 0.25,
    "initial_displacement": (0.0, 0.0, 0.2, 0.03, 0.01, 0.02),
}


@pytest.mark.parametrize(
    ("stepper", "model"), [*[(name, "nonlinear") for name in STEPPERS], ("exponential", "linear")]
)
def test_a_run_goes_on_as_if_it_had_not_stopped(
    stepper: str, model: str, run_halifax: Run, tmp_path: Path
) -> None:
    """Cut in the ramp, at each of the first steps, at the end of the ramp and later; through a file once."""
    whole = run_halifax(SEA, duration=2.0, stepper=stepper, model=model, **GIVEN)
    for steps in (1, 2, 8, 10):
        given = GIVEN | {"stepper": stepper, "model": model}
        # The ramp is part of what a run is; so its beginning is told by an interrupt.
        begun = interrupted_after(steps, run_halifax, **given)
        assert len(begun.time) == steps + 1
        if steps == 8:
            begun = History.load(begun.save(tmp_path / "begun.nc"))
        resumed = run_halifax(SEA, duration=2.0, resume=begun, **given)
        assert resumed.outcome == "finished"
        assert resumed.same_bits(whole), steps
    # It did move, and another step would not be the same.
    assert np.abs(whole.displacement[-1, :3]).max() > 0.1


def interrupted_after(steps: int, run: Run, **given: Any) -> History:
    """The beginning of the run: a shorter duration where that is after the ramp, else an interrupt."""
    time = steps * given["time_step"]
    if time - given["ramp"] >= given["time_step"]:
        return run(SEA, duration=time - given["ramp"], **given)

    from panelsim.motion import march

    def stop(done: float, total: float) -> None:
        if done >= time - 1e-9:
            raise KeyboardInterrupt

    between, march.STEPS_BETWEEN_PROGRESS = march.STEPS_BETWEEN_PROGRESS, 1
    try:
        return run(SEA, duration=2.0, progress=stop, **given)
    finally:
        march.STEPS_BETWEEN_PROGRESS = between


def test_a_batch_goes_on_as_each_of_its_members(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """Three seas together, put together in another order after the stop, against each whole run alone."""
    seas = [SEA, CalmSeaway(), RegularSeaway(2.0, 0.6, np.pi)]
    given = GIVEN | {"database": halifax_database, "supplementary": springs}
    begun = simulate_batch(halifax, seas, duration=3.0, **given)
    order = [2, 0, 1]
    resumed = simulate_batch(
        halifax, [seas[i] for i in order], duration=5.0, resume=[begun[i] for i in order], **given
    )
    for i, history in zip(order, resumed, strict=True):
        (whole,) = simulate_batch(halifax, [seas[i]], duration=5.0, **given)
        assert history.same_bits(whole)


def test_twice_stopped_is_still_the_same(run_halifax: Run) -> None:
    first = run_halifax(SEA, duration=1.0, **GIVEN)
    second = run_halifax(SEA, duration=2.0, resume=first, **GIVEN)
    third = run_halifax(SEA, duration=3.0, resume=second, **GIVEN)
    assert third.same_bits(run_halifax(SEA, duration=3.0, **GIVEN))
    # Nothing left to do is the run itself.
    assert run_halifax(SEA, duration=3.0, resume=third, **GIVEN).same_bits(third)


@pytest.fixture(scope="module")
def begun(run_halifax: Run) -> History:
    return run_halifax(SEA, duration=1.0, **GIVEN)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"speed": 5.0}, "its speed is another"),
        ({"ramp": 2.5}, "its ramp is another"),
        ({"time_step": 0.2}, "its time step is another"),
        ({"stepper": "rk4"}, "its stepper is another"),
        ({"model": "linear"}, "its model is another"),
        ({"stretching": "none"}, "its stretching is another"),
        ({"pressure_rule": "vertex"}, "its pressure rule is another"),
        ({"pressure_method": "direct"}, "its pressure method is another"),
        ({"supplementary": Supplementary()}, "its set of supplementary terms is another"),
        ({"seaway": CalmSeaway()}, "its sea is another"),
        ({"initial_displacement": (0.0,) * 6}, "its initial displacement is another"),
        ({"initial_velocity": (0.1,) * 6}, "its initial velocity is another"),
        ({"duration": 0.5}, "longer than the run"),
        ({"resume": "history.nc"}, "is no history"),
    ],
)
def test_a_history_of_another_run_is_refused(
    given: dict[str, Any], words: str, begun: History, run_halifax: Run
) -> None:
    arguments: dict[str, Any] = {"seaway": SEA, "duration": 3.0, "resume": begun} | GIVEN | given
    with pytest.raises(PanelsimError, match=words):
        run_halifax(**arguments)


def test_a_run_of_another_ship_or_with_other_coefficients_is_refused(
    begun: History, run_halifax: Run, halifax_database: HydroDatabase
) -> None:
    dataset = halifax_database.dataset.copy()
    dataset["radiation_damping"] = dataset["radiation_damping"] * 1.0001
    with pytest.raises(PanelsimError, match="its set of coefficients is another"):
        run_halifax(SEA, duration=3.0, resume=begun, **(GIVEN | {"database": HydroDatabase(dataset)}))


def test_a_run_that_ended_for_good_does_not_go_on(run_halifax: Run) -> None:
    given = GIVEN | {"initial_velocity": (0, 0, 0, 0, 10.0, 0)}
    ended = run_halifax(SEA, duration=5.0, **given)
    assert ended.outcome == "diverged"
    with pytest.raises(PanelsimError, match="ended for good"):
        run_halifax(SEA, duration=9.0, resume=ended, **given)


def test_a_history_without_a_state_is_refused(make_history: Callable[..., History], run_halifax: Run) -> None:
    with pytest.raises(PanelsimError, match="holds no state"):
        run_halifax(SEA, duration=9.0, resume=make_history(), **GIVEN)


def test_histories_of_a_batch_are_cut_at_one_time(
    begun: History, halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary, run_halifax: Run
) -> None:
    other = run_halifax(SEA, duration=1.5, **GIVEN)
    given = GIVEN | {"database": halifax_database, "supplementary": springs, "duration": 3.0}
    with pytest.raises(PanelsimError, match=r"Member 2 of 2: .* unequal length"):
        simulate_batch(halifax, [SEA, SEA], resume=[begun, other], **given)
    with pytest.raises(PanelsimError, match="not one of the histories to go on from for each seaway"):
        simulate_batch(halifax, [SEA, SEA], resume=[begun], **given)
