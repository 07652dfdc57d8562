"""Batches: each run of a batch is, bit for bit, the run by itself, whatever the others are and do."""

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
import pytest

from panelsim.conventions import KNOT, Dof, load_to_earth, rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.linear_waves import LinearWaveLoad
from panelsim.loads.load import Instant, times_each
from panelsim.loads.radiation import Radiation
from panelsim.loads.restoring import Restoring
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.weight import Weight
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.history import History
from panelsim.motion.march import Limits, Record, march, require_finite_start
from panelsim.motion.runge_kutta import RungeKutta4
from panelsim.motion.simulate import simulate, simulate_batch
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.direction.spreading import CosineSquared
from panelsim.seaway.frequencies import EvenFrequencies
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway, Seaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship

MEMBERS = 7
CAPSIZING, DIVERGING, OVERFLOWING = 2, 5, 6
SPEEDS = (20 * KNOT, 5.0, 3.0, 0.0, 8.0, 10.0, 2.0)
SEEDS = (1001, None, None, None, 4, None, None)


def seven_seas() -> list[Seaway]:
    """Of every kind, from all sides, with 37, 0, 1, 1, 19, 60 and 1 waves."""
    spectrum = Bretschneider(7.5, 15.0)
    return [
        RandomSeaway(spectrum, EvenFrequencies(0.2, 2.0, 0.05), np.deg2rad(150), seed=1001),
        CalmSeaway(),
        RegularSeaway(2.0, 0.6, np.deg2rad(90)),
        RegularSeaway(3.0, 0.5, np.deg2rad(200), second_order=True),
        RandomSeaway(spectrum, EvenFrequencies(0.2, 2.0, 0.1), np.deg2rad(30), seed=4),
        RandomSeaway(
            Bretschneider(2.0, 8.0),
            EvenFrequencies(0.5, 1.6, 0.1),
            np.deg2rad(120),
            spreading=CosineSquared(),
            direction_step=np.deg2rad(30),
            seed=5,
        ),
        RegularSeaway(1.0, 0.9, np.pi),
    ]


def starts() -> tuple[np.ndarray, np.ndarray]:
    """Displacement and velocity (7, 6): one is let go into a capsize, two into motions without bounds."""
    displacement, velocity = np.zeros((MEMBERS, 6)), np.zeros((MEMBERS, 6))
    displacement[1] = 0.0, 0.0, 0.5, 0.05, 0.01, 0.02
    velocity[CAPSIZING, Dof.ROLL] = 0.3
    velocity[DIVERGING, Dof.PITCH] = 1e200
    displacement[OVERFLOWING, Dof.HEAVE] = 1e300
    return displacement, velocity


@pytest.fixture(scope="module")
def given(halifax_database: HydroDatabase, springs: Supplementary) -> dict[str, Any]:
    """What all runs here share: 16 s in steps of 0.2 s, half of it ramp."""
    return {
        "database": halifax_database,
        "supplementary": springs,
        "duration": 8.0,
        "ramp": 8.0,
        "time_step": 0.2,
        "capsize_angle": np.deg2rad(20.0),
        "case": {"a": 1},
        "notes": ["a note"],
    }


@pytest.fixture(scope="module")
def run_members(halifax: Ship, given: dict[str, Any]) -> Callable[..., tuple[History, ...]]:
    """A runner of some of the seven as a batch, in any order."""

    def run(members: list[int], **more: Any) -> tuple[History, ...]:
        seas, (displacement, velocity) = seven_seas(), starts()
        return simulate_batch(
            halifax,
            [seas[i] for i in members],
            speed=[SPEEDS[i] for i in members],
            seeds=[SEEDS[i] for i in members],
            initial_displacement=displacement[members],
            initial_velocity=velocity[members],
            **(given | more),
        )

    return run


@pytest.fixture(scope="module", params=["nonlinear", "linear"])
def alone(request: pytest.FixtureRequest, halifax: Ship, given: dict[str, Any]) -> list[History]:
    """The seven runs, each by itself."""
    displacement, velocity = starts()
    return [
        simulate(
            halifax,
            sea,
            speed=SPEEDS[i],
            seed=SEEDS[i],
            initial_displacement=displacement[i],
            initial_velocity=velocity[i],
            model=request.param,
            **given,
        )
        for i, sea in enumerate(seven_seas())
    ]


# --- the same bits -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "members",
    [[CAPSIZING], [1, CAPSIZING, 0], list(range(MEMBERS))[::-1]],
    ids=str,
)
def test_each_run_of_a_batch_is_the_run_by_itself(
    members: list[int], alone: list[History], run_members: Callable[..., tuple[History, ...]]
) -> None:
    """Variables, outcome, notes and all facts but the seconds spent; also beside runs that end early."""
    model = alone[0].attrs["model"]
    histories = run_members(members, model=model)
    assert len(histories) == len(members)
    for member, history in zip(members, histories, strict=True):
        expected = alone[member]
        assert history.same_bits(expected), member
        for name, value in expected.attrs.items():
            if not name.endswith("_seconds") or name == "simulated_seconds":
                assert history.attrs[name] == value, (member, name)
        assert history.seaway_attrs == expected.seaway_attrs


def test_the_runs_of_these_tests_end_as_they_should(alone: list[History]) -> None:
    """The comparison above would prove little if all finished, or if none moved."""
    outcomes = [history.outcome for history in alone]
    print(outcomes, [history.attrs["outcome_detail"] for history in alone])
    for i, history in enumerate(alone):
        expected = {CAPSIZING: "capsized", DIVERGING: "diverged", OVERFLOWING: "diverged"}.get(i, "finished")
        assert history.outcome == expected
        assert history.finite.all()
        assert all(np.isfinite(load).all() for load in history.loads.values())
    # She capsizes in the middle of the run: the others go on for seconds beside her.
    assert 0.5 < alone[CAPSIZING].time[-1] < 14.0
    finished = [history for history in alone if history.outcome == "finished"]
    assert all(history.time[-1] == pytest.approx(16.0) for history in finished)
    assert len({history.displacement[-1].tobytes() for history in finished}) == len(finished)
    assert all(np.abs(history.displacement[-1, :3]).max() > 0.01 for history in finished)


def test_one_speed_and_one_start_serve_all(halifax: Ship, given: dict[str, Any]) -> None:
    """A number for the speed and six for the start stand for each member, also where there are six."""
    seas = [RegularSeaway(1.0, 0.3 + 0.1 * i, np.pi) for i in range(6)]
    start = (0.0, 0.0, 0.3, 0.02, 0.0, 0.0)
    brief = given | {"duration": 1.0, "ramp": 0.0}
    batch = simulate_batch(halifax, seas, speed=7.0, initial_displacement=start, **brief)
    single = simulate(halifax, seas[4], speed=7.0, initial_displacement=start, **brief)
    assert batch[4].same_bits(single)
    for history in batch:
        assert history.attrs["speed"] == 7.0
        assert "seed" not in history.attrs
        np.testing.assert_array_equal(history.displacement[0], start)


# --- ends, books ---------------------------------------------------------------------------------


def test_an_interrupt_ends_all_runs_and_keeps_them(
    alone: list[History], run_members: Callable[..., tuple[History, ...]]
) -> None:
    """Those that had ended keep their own end; the rest are the beginnings of whole runs."""

    def stop(done: float, total: float) -> None:
        assert total == pytest.approx(16.0)
        if done >= 10.0:
            raise KeyboardInterrupt

    cut = run_members(list(range(MEMBERS)), model=alone[0].attrs["model"], progress=stop)
    for history, whole in zip(cut, alone, strict=True):
        if whole.outcome != "finished" and whole.time[-1] < 10.0:
            assert history.same_bits(whole)
            assert history.attrs["outcome_detail"] == whole.attrs["outcome_detail"]
            continue
        assert history.outcome == "interrupted"
        assert "10 s" in history.attrs["outcome_detail"]
        count = len(history.time)
        assert count == 51  # 0 to 10 s
        np.testing.assert_array_equal(history.displacement, whole.displacement[:count])


def test_the_seconds_spent_are_shared_by_steps(run_members: Callable[..., tuple[History, ...]]) -> None:
    """Each instant costs as much; setting up costs each member as much."""
    histories = run_members([0, CAPSIZING, 3], model="linear")
    each = [history.attrs["cpu_seconds"] / len(history.time) for history in histories]
    assert each[0] > 0.0
    # Rounding of a product and a quotient.
    assert each == pytest.approx([each[0]] * 3, rel=1e-12)
    set_up = [history.attrs["jit_seconds"] for history in histories]
    assert set_up[0] > 0.0
    assert set_up == [set_up[0]] * 3


class Springs:
    """Equations of motion η̈ = −c η, one stiffness c for each member, told the motions they are asked for."""

    load_names = ("spring",)

    def __init__(self, stiffness: list[float]) -> None:
        self.stiffness = np.array(stiffness)[:, None]
        self.asked: list[np.ndarray] = []

    def start(self, displacement: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        return np.concatenate([displacement, velocity], axis=1)

    def evaluate(self, time: float, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        self.asked.append(motion)
        acceleration = -self.stiffness * motion[:, :6]
        return acceleration, acceleration[:, None].copy()

    def rate(self, motion: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
        return np.concatenate([motion[:, 6:], acceleration], axis=1)


def march_springs(springs: Springs, displacement: np.ndarray, *, steps: int) -> Record:
    """The springs let go, by Runge-Kutta steps of 0.1 s."""
    stepper = RungeKutta4(springs, 0.1)
    state = stepper.start(displacement, 0.0 * displacement)
    require_finite_start(state)
    record = Record(steps + 1, len(displacement), springs.load_names)
    record.add(state)
    limits = Limits(0.0, heave=5.0, drift=1e9)
    march(stepper, state, record, steps=steps, time_step=0.1, limits=limits)
    return record


def test_a_member_that_overflows_or_runs_away_leaves_the_others_alone() -> None:
    """It is held at rest from there on, with the rows that it had; the others oscillate on."""
    stiffness = [1.0, 1e200, 4.0, -1e3]  # the second overflows in its first step, the last runs away
    start = np.full((4, 6), 0.1)
    springs = Springs(stiffness)
    record = march_springs(springs, start, steps=40)
    for motion in springs.asked:
        assert (motion[[0, 2], :6] != 0.0).all()
    runs = [record.of(member) for member in range(4)]
    assert [run.outcome for run in runs] == ["finished", "diverged", "finished", "diverged"]
    assert [run.count for run in runs][:3] == [41, 1, 41]
    assert 1 < runs[3].count < 10
    assert "no longer finite at t = 0.1 s" in runs[1].detail
    assert "limit" in runs[3].detail
    assert (springs.asked[-4][[1, 3]] == 0.0).all()
    for member in range(4):
        alone = march_springs(Springs(stiffness[member : member + 1]), start[:1], steps=40).of(0)
        np.testing.assert_array_equal(runs[member].displacement, alone.displacement)
        np.testing.assert_array_equal(runs[member].loads["spring"], alone.loads["spring"])
        assert runs[member].detail == alone.detail


def test_a_motion_that_overflows_within_a_step_never_reaches_the_loads(
    halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """The loads take numbers only: what is none is taken at rest, and its accelerations are those of rest."""

    class Listener:
        name = "listener"
        asked: ClassVar[list[Instant]] = []

        def evaluate(self, instant: Instant) -> np.ndarray:
            self.asked.append(instant)
            return np.ones((3, 6))

    equations = EquationsOfMotion(
        halifax.inertia, [Listener()], Radiation(halifax_database, [0.0, 5.0, 9.0]), ramp=4.0
    )
    motion = equations.start(*np.random.default_rng(1).normal(size=(2, 3, 6)))
    expected, _ = equations.evaluate(1.0, motion)
    broken = motion.copy()
    broken[1, 3] = np.inf
    broken[2, 40] = np.nan
    found, _ = equations.evaluate(1.0, broken)
    np.testing.assert_array_equal(found[0], expected[0])
    last = Listener.asked[-1]
    assert last.wave_factor == pytest.approx(0.5 * (1 - np.cos(np.pi / 4)))
    assert (last.displacement[1:] == 0.0).all() and (last.velocity[1:] == 0.0).all()
    assert np.isfinite(found).all()


def test_a_run_ends_where_its_loads_are_no_numbers() -> None:
    """At the start that is an error, which names the member; later the row is left out."""
    start = np.full((2, 6), 0.1)
    with pytest.raises(PanelsimError, match="Member 2 of 2: The loads on the ship at the start"):
        march_springs(Springs([1.0, np.inf]), start, steps=5)

    class Breaking(Springs):
        def evaluate(self, time: float, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            acceleration, loads = super().evaluate(time, motion)
            loads[1, :, 0] = np.nan if time > 0.25 else 0.0
            return acceleration, loads

    record = march_springs(Breaking([1.0, 1.0]), start, steps=5)
    assert [record.of(member).count for member in (0, 1)] == [6, 3]  # rows at 0, 0.1, 0.2 s
    assert record.of(1).outcome == "diverged"


# --- loads of a batch ----------------------------------------------------------------------------


def test_seas_of_unequal_length_each_load_their_own_ship() -> None:
    """Re Σ a X exp(i(ω_e t + ε − k(η1 cos β − η2 sin β))) ship by ship; calm water first, amid, last."""
    rng = np.random.default_rng(3)
    gravity, time = 9.8, 31.0
    counts, speeds = [0, 5, 0, 1, 12, 0], [3.0, 4.0, 5.0, 0.0, 9.0, 1.0]
    seas = [
        WaveComponents(
            rng.uniform(0.1, 1.0, m),
            rng.uniform(0.4, 1.5, m),
            rng.uniform(0.0, 6.0, m),
            rng.uniform(0.0, 6.0, m),
        )
        if m
        else NO_WAVES
        for m in counts
    ]
    transfers = [rng.normal(size=(m, 6)) + 1j * rng.normal(size=(m, 6)) for m in counts]
    displacement = rng.normal(0.0, 3.0, (6, 6))
    load = LinearWaveLoad("test", transfers, seas, speeds, gravity=gravity, follows_ship=True)
    found = load.evaluate(Instant(time, 0.7, displacement, np.zeros((6, 6))))
    for i, (sea, transfer, speed) in enumerate(zip(seas, transfers, speeds, strict=True)):
        k = sea.frequency**2 / gravity
        encounter = sea.frequency - speed * k * np.cos(sea.wave_heading)
        surge, sway = displacement[i, :2]
        there = k * (surge * np.cos(sea.wave_heading) - sway * np.sin(sea.wave_heading))
        turned = sea.amplitude * np.exp(1j * (encounter * time + sea.phase - there))
        # Rounding of phases of some tens of radians.
        np.testing.assert_allclose(found[i], 0.7 * (turned @ transfer).real, atol=1e-12)


def test_each_ship_has_the_radiation_of_its_own_speed(halifax_database: HydroDatabase) -> None:
    """The same steady sway, held, at three speeds: yaw moments −U times the momentum, nothing else."""
    speeds = [0.0, 4.0, 9.0]
    radiation = Radiation(halifax_database, speeds)
    velocity = np.zeros((3, 6))
    velocity[:, Dof.SWAY] = 1.5
    motion = radiation.start(np.zeros((3, 6)), velocity)
    states = radiation.states
    motion[:, 12:] = -np.linalg.solve(states.transition, states.entrance @ velocity[0])
    load = radiation.evaluate(motion)
    expected = -1.5 * np.array(speeds) * halifax_database.added_mass_zero[Dof.SWAY, Dof.SWAY]
    # The kernel gives A(0) to rounding.
    np.testing.assert_allclose(load[:, Dof.YAW], expected, atol=1e-9 * np.abs(expected).max())
    yawed = radiation.start(np.zeros((3, 6)) + 0.1 * np.eye(6)[Dof.YAW], np.zeros((3, 6)))
    held = np.array(speeds)[:, None] * yawed[[1], 12:] / speeds[1]
    np.testing.assert_allclose(yawed[:, 12:], held, atol=1e-12 * np.abs(held).max())
    assert (yawed[1, 12:] @ states.momentum[Dof.SWAY]) * velocity[0, Dof.SWAY] < 0.0


def test_loads_of_many_ships_are_those_of_each() -> None:
    """Row by row the same bits: weight, restoring, springs, and the turn to earth axes."""
    rng = np.random.default_rng(5)
    displacement, velocity = rng.normal(size=(2, 9, 6))
    stiffness = rng.normal(size=(6, 6))
    loads = [Weight(3.0, 9.8), Restoring(stiffness), Supplementary({"sway": 2.0}, {"roll": 3.0})]
    for load in loads:
        many = load.evaluate(Instant(0.0, 1.0, displacement, velocity))
        for i in range(9):
            one = load.evaluate(Instant(0.0, 1.0, displacement[[i]], velocity[[i]]))
            np.testing.assert_array_equal(many[[i]], one)
    # Rounding of sums of six.
    np.testing.assert_allclose(
        loads[1].evaluate(Instant(0.0, 1.0, displacement, velocity)), -displacement @ stiffness.T, atol=1e-14
    )
    turned = load_to_earth(velocity, displacement)
    for i in range(9):
        np.testing.assert_array_equal(turned[i], load_to_earth(velocity[i], displacement[i]))
        force = rotation_to_earth(*displacement[i, 3:]) @ velocity[i, :3]
        np.testing.assert_allclose(turned[i, :3], force, atol=1e-15 * 4)


def test_products_for_each_ship_take_one_matrix_or_one_each() -> None:
    rng = np.random.default_rng(6)
    matrices, vectors = rng.normal(size=(4, 3, 5)), rng.normal(size=(4, 5))
    for found, expected in (
        (times_each(matrices, vectors), [m @ v for m, v in zip(matrices, vectors, strict=True)]),
        (times_each(matrices[0], vectors), [matrices[0] @ v for v in vectors]),
    ):
        np.testing.assert_allclose(found, expected, rtol=1e-14)


# --- what is refused -----------------------------------------------------------------------------


SEAS = [CalmSeaway()] * 5
TOO_SHORT = ComponentSeaway(WaveComponents(np.array([0.05]), np.array([3.0]), np.array([np.pi]), np.zeros(1)))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"seaways": []}, "There are no seaways"),
        ({"seaways": CalmSeaway()}, "The seaways are no sequence"),
        ({"seaways": "calm"}, "The seaways are no sequence"),
        ({"seaways": [*SEAS[:4], NO_WAVES]}, "Member 5 of 5: The seaway is of another kind"),
        ({"seaways": [*SEAS[:4], "calm"]}, "Member 5 of 5: The seaway is of another kind"),
        ({"speed": [1.0, 2.0]}, "There is not one of the speeds for each seaway"),
        ({"speed": [1.0, 2.0, -3.0, 4.0, 5.0]}, "Member 3 of 5: The speed is out of range"),
        ({"speed": [1.0, np.nan, 3.0, 4.0, 5.0]}, "Member 2 of 5: The speed is out of range"),
        ({"speed": [1.0, 2.0, 3.0, "fast", 5.0]}, "Member 4 of 5: The speed is not a number"),
        ({"speed": "fast"}, "Member 1 of 5: The speed is not a number"),
        ({"speed": None}, "Member 1 of 5: The speed is not a number"),
        ({"seeds": [1, 2]}, "There is not one of the seeds for each seaway"),
        ({"seeds": 7}, "The seeds are no sequence"),
        ({"seeds": [1, 2, 3, 4, 0.5]}, "Member 5 of 5: The seed is no whole number"),
        ({"seeds": [1, True, 3, 4, 5]}, "Member 2 of 5: The seed is no whole number"),
        ({"initial_displacement": np.zeros((4, 6))}, "initial_displacement is not that of each member"),
        (
            {"initial_velocity": np.full((5, 6), np.inf)},
            "Member 1 of 5: The initial_velocity is not six finite",
        ),
        ({"initial_velocity": np.zeros((5, 5))}, "Member 1 of 5: The initial_velocity is not six finite"),
        (
            {"initial_velocity": [[0.0] * 6] * 4 + [[np.nan] * 6]},
            "Member 5 of 5: The initial_velocity is not",
        ),
        ({"initial_displacement": (0, 0, 0, 25.0, 0, 0)}, "more than a full turn"),
        ({"speed": np.array(5.0)}, "Member 1 of 5: The speed is not a number"),
        ({"seeds": np.array(5)}, "The seeds are no sequence"),
        ({"seeds": [1, 2, 3, 4, 2**70]}, "Member 5 of 5: The seed is no whole number of 64 bits"),
        ({"notes": None}, "The notes are no list"),
        ({"notes": 5}, "The notes are no list"),
        ({"case": {"a": object()}}, "The case cannot be kept"),
        ({"case": {1: 2, "a": 3}}, "The case cannot be kept"),
        ({"progress": "yes"}, "The progress is no function"),
        ({"pressure_rule": np.array(["vertex", "panel"])}, "Unknown pressure rule"),
        ({"pressure_method": None}, "Unknown pressure method"),
        ({"time_step": True}, "time_step is not a number"),
        ({"initial_velocity": np.zeros((6, 5))}, "initial_velocity is not that of each member"),
        ({"seaways": [*SEAS[:3], TOO_SHORT, *SEAS[:1]], "time_step": 0.4}, "Member 4 of 5: .* for the waves"),
        ({"time_step": 2.0}, "Member 1 of 5: The time step is too long for the motions of the ship"),
        ({"time_step": 0.01, "duration": 5000.0}, "The runs of the batch have too many steps"),
        ({"duration": "long"}, "The duration is not a number"),
    ],
)
def test_batches_that_make_no_sense_are_refused(
    arguments: dict[str, Any], words: str, halifax: Ship, given: dict[str, Any]
) -> None:
    defaults: dict[str, Any] = given | {"seaways": SEAS, "speed": 20 * KNOT}
    with pytest.raises(PanelsimError, match=words):
        simulate_batch(halifax, **(defaults | arguments))


def test_a_single_run_takes_no_lists(halifax: Ship, given: dict[str, Any]) -> None:
    """And its errors name no member."""
    for arguments, words in (
        ({"speed": [3.0]}, "^The speed is not a number"),
        ({"speed": -3.0}, "^The speed is out of range"),
        ({"initial_displacement": np.zeros((1, 6))}, "^The initial_displacement is not six finite numbers"),
    ):
        with pytest.raises(PanelsimError, match=words):
            simulate(halifax, CalmSeaway(), **(given | {"speed": 0.0} | arguments))
    with pytest.raises(PanelsimError, match=r"^The seaway is of another kind"):
        simulate(halifax, [CalmSeaway()], speed=0.0, **given)
