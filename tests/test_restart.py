"""Restart: a run that goes on is, bit for bit, the run that never stopped; one of another run is refused."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.batch import Batch, Member
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.history import History
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.march import Limits, Record, march
from panelsim.motion.simulate import simulate_batch
from panelsim.motion.stepper import State
from panelsim.motion.steppers import STEPPERS
from panelsim.seaway.frequencies import EvenFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship

Run = Callable[..., History]
Identified = tuple[Batch, tuple[Any, ...]]

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


# --- what a run is known by --------------------------------------------------------------------------


@pytest.fixture(scope="module")
def identified(run_halifax: Run) -> Identified:
    """A batch of one and what its identity is made of."""
    taken: list[Identified] = []
    identities = Batch._identities

    def listening(self: Batch, *of: Any) -> list[dict[str, Any]]:
        taken.append((self, of))
        return identities(self, *of)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Batch, "_identities", listening)
        run_halifax(SEA, duration=1.0, **GIVEN)
    return taken[0]


class Changed:
    """An object, but for the attributes that are given."""

    def __init__(self, found: object, **values: object) -> None:
        self.__dict__.update(values, found=found)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.__dict__["found"], name)


PARTS: dict[str, tuple[str, Callable[[Any, EquationsOfMotion, KnownLoads], tuple[Any, Any, Any]]]] = {
    "density": ("water", lambda b, e, k: (Changed(b, ship=Changed(b.ship, water_density=990.0)), e, k)),
    "gravity": ("water", lambda b, e, k: (Changed(b, ship=Changed(b.ship, gravity=9.8)), e, k)),
    "inertia": ("ship", lambda b, e, k: (Changed(b, ship=Changed(b.ship, inertia=2 * b.ship.inertia)), e, k)),
    "waterline": ("ship", lambda b, e, k: (Changed(b, ship=Changed(b.ship, waterline=0.1)), e, k)),
    "vertices": ("ship", lambda b, e, k: (Changed(b, ship=Changed(b.ship, vertices=-b.ship.vertices)), e, k)),
    "capsize angle": ("capsize angle", lambda b, e, k: (Changed(b, capsize_angle=1.0), e, k)),
    "transom": ("choice of transom terms", lambda b, e, k: (Changed(b, transom=True), e, k)),
    "added mass": (
        "set of coefficients",
        lambda b, e, k: (Changed(b, database=doubled(b, "added_mass")), e, k),
    ),
    "damping": (
        "set of coefficients",
        lambda b, e, k: (Changed(b, database=doubled(b, "radiation_damping")), e, k),
    ),
    "load matrix": ("set of coefficients", lambda b, e, k: (b, with_doubled(e, "load_matrix"), k)),
    "memory matrix": ("set of coefficients", lambda b, e, k: (b, with_doubled(e, "memory_matrix"), k)),
    "waves' loads": (
        "set of coefficients",
        lambda b, e, k: (b, e, replace(k, amplitudes=[2 * a for a in k.amplitudes])),
    ),
    "waves' turning": (
        "set of coefficients",
        lambda b, e, k: (b, e, replace(k, turning=[2 * a for a in k.turning])),
    ),
    "second order": ("sea", lambda b, e, k: (Changed(b, members=[of_second_order(b.members[0])]), e, k)),
}


def doubled(batch: Batch, name: str) -> Any:
    return Changed(batch.database, **{name: 2 * getattr(batch.database, name)})


def with_doubled(equations: EquationsOfMotion, name: str) -> Any:
    radiation = equations.radiation
    return Changed(equations, radiation=Changed(radiation, **{name: 2 * getattr(radiation, name)}))


def of_second_order(member: Member) -> Any:
    return Changed(member, waves=Changed(member.waves, second_order=True))


@pytest.mark.parametrize("part", PARTS)
def test_each_part_of_a_run_is_in_its_identity(part: str, identified: Identified) -> None:
    """Another density, another inertia, …: that word of the identity changes, and no other."""
    batch, (equations, known, *rest) = identified
    word, change = PARTS[part]
    (mine,) = batch._identities(equations, known, *rest)
    batch, equations, known = change(batch, equations, known)
    (other,) = Batch._identities(batch, equations, known, *rest)
    assert {name for name in mine if mine[name] != other[name]} == {word}


@pytest.mark.parametrize("name", ["potential_real", "potential_imag", "potential_infinite"])
def test_coefficients_with_another_diffraction_are_refused(
    name: str, begun: History, run_halifax: Run, halifax_database: HydroDatabase
) -> None:
    """The same added mass and damping: only what the waves do is another."""
    dataset = halifax_database.dataset.copy()
    dataset[name] = dataset[name] * np.float32(1.5)
    with pytest.raises(PanelsimError, match="its set of coefficients is another"):
        run_halifax(SEA, duration=3.0, resume=begun, **(GIVEN | {"database": HydroDatabase(dataset)}))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"outcome": "capsized"}, "ended for good"),
        ({"restart_format": 2}, r"one of format 2[\s\S]*format 1"),
        ({"identity": {"version of panelsim": "0.0.1"}}, "its version of panelsim is another"),
        ({"identity": {"capsize angle": 1.0}}, "its capsize angle is another"),
    ],
)
def test_histories_that_no_run_goes_on_from(
    change: dict[str, Any], words: str, begun: History, run_halifax: Run
) -> None:
    tree = begun.tree.copy(deep=True)
    group = tree.children["restart"]
    if "outcome" in change:
        tree.attrs["outcome"] = change["outcome"]
    if "restart_format" in change:
        group.attrs["restart_format"] = change["restart_format"]
    if "identity" in change:
        theirs = json.loads(group.attrs["identity"]) | change["identity"]
        group.attrs["identity"] = json.dumps(theirs)
    with pytest.raises(PanelsimError, match=words):
        run_halifax(SEA, duration=3.0, resume=History(tree), **GIVEN)


def test_numbers_of_any_kind_make_the_same_run(begun: History, run_halifax: Run) -> None:
    """NumPy's whole numbers and short floats, refused by JSON, are plain ones from the door on."""
    kinds = {"ramp": np.int64(2), "time_step": np.float32(0.25), "capsize_angle": np.float64(np.pi / 2)}
    assert run_halifax(SEA, duration=np.int32(1), **(GIVEN | kinds)).same_bits(begun)
    damping = RollDampingTerms(linear=np.float32(1e7), quadratic=np.int64(2))  # type: ignore[arg-type]
    first = run_halifax(SEA, duration=1.0, roll_damping=damping, **GIVEN)
    again = run_halifax(SEA, duration=1.0, roll_damping=RollDampingTerms(1e7, 2.0), resume=first, **GIVEN)
    assert again.same_bits(first)


def test_an_interrupt_between_an_instant_and_its_state_keeps_neither() -> None:
    """It falls where the record has the instant already, and the state is not yet the last one."""
    record = Record(4, 1, ("weight",))
    states = [
        State(n, np.full((1, 12), n / 10), np.empty((1, 0)), np.zeros((1, 6)), np.zeros((1, 1, 6)))
        for n in range(3)
    ]
    add = record.add

    def stopped(state: State) -> None:
        add(state)
        if state.step == 2:
            raise KeyboardInterrupt

    record.add = stopped  # type: ignore[method-assign]
    record.add(states[0])
    stepper: Any = SimpleNamespace(step=lambda state: states[state.step + 1])
    limits = Limits(capsize_angle=1.0, heave=1.0, drift=1.0)
    last = march(stepper, states[0], record, steps=3, time_step=0.5, limits=limits)
    assert last.step == 1
    assert record.of(0).displacement[:, 2].tolist() == [0.0, 0.1]
    assert record.of(0).outcome == "interrupted"
