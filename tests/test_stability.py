"""The longest step of each scheme: what is told is allowed, and what is allowed is stable."""

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.requirements import rounded_down
from panelsim.motion.stability import Stability
from panelsim.motion.steppers import STEPPERS
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.regular import RegularSeaway
from panelsim.ship.ship import Ship

Run = Callable[..., History]

ASKEW = (0.0, 0.0, 0.1, 0.02, 0.002, 0.0)
STIFF = Supplementary(stiffness={"surge": 5e5}, damping={"surge": 1e9})
SOFT = Supplementary()


def longest(run: Run, time_step: float, **given: Any) -> float:
    """The step [s] that the refusal of a longer one tells."""
    with pytest.raises(PanelsimError, match="too long") as refusal:
        run(time_step=time_step, **given)
    told = re.match(r"at most (\S+) s", str(refusal.value.allowed))
    assert told is not None
    return float(told[1])


def grown(run: Run, time_step: float, steps: int, **given: Any) -> float:
    """Heave, roll and pitch in the last fifty of so many steps of the linear model, over the first fifty."""
    history = run(
        model="linear",
        duration=steps * time_step,
        time_step=time_step,
        initial_displacement=ASKEW,
        **given,
    )
    if history.outcome == "diverged":
        return np.inf
    motion = np.abs(history.displacement[:, 2:5]).max(axis=1)
    return float(motion[-50:].max() / motion[:50].max())


@pytest.mark.parametrize("speed", [0.0, 20 * KNOT])
@pytest.mark.parametrize("stepper", ["ab3", "rk4"])
def test_the_limit_parts_stable_steps_from_unstable_ones(
    stepper: str, speed: float, run_halifax: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Steps up to 4 % below what is told die out; 6 % longer ones, let through, grow."""
    given = {"stepper": stepper, "speed": speed}
    told = longest(run_halifax, 3.0, **given)
    # Two digits are told, rounded down: the limit itself is up to 2 % above 0.5 s and 9 % above 1.1 s.
    assert grown(run_halifax, told, 600, **given) < 0.5
    monkeypatch.setattr(Stability, "require", lambda self, time_step: None)
    assert grown(run_halifax, 1.1 * told, 600, **given) > 1.0


@pytest.mark.parametrize("supplementary", [SOFT, STIFF, Supplementary(damping={"roll": 1e10})])
@pytest.mark.parametrize("stepper", STEPPERS)
def test_what_is_told_is_allowed(stepper: str, supplementary: Supplementary, run_halifax: Run) -> None:
    given = {"stepper": stepper, "supplementary": supplementary}
    told = longest(run_halifax, 3.0, **given)
    history = run_halifax(time_step=told, duration=20 * told, initial_displacement=ASKEW, **given)
    assert history.outcome == "finished"
    # Damping that is far faster than the ship: 2.78 and 0.545 over its rate, no limit to the exponential.
    if supplementary is not SOFT:
        assert {"rk4": told < 0.06, "ab3": told < 0.02, "exponential": told > 1.0}[stepper]


def test_a_damper_has_the_limit_of_the_real_axis(run_halifax: Run) -> None:
    """Surge of mass M + A∞ = B/λ: RK4 to 2.785/λ, AB3 to 6/11/λ (Hairer and Wanner 1996, IV.2, V.1)."""
    given = {"supplementary": STIFF, "duration": 0.2, "time_step": 0.001}
    history = run_halifax(**given, initial_velocity=(1e-3, 0, 0, 0, 0, 0))
    rate = -history.acceleration[0, 0] / history.velocity[0, 0]
    # Told to two digits, rounded down: 10 % at most.
    for stepper, most in (("rk4", 2.785), ("ab3", 6.0 / 11.0)):
        told = longest(run_halifax, 0.2, stepper=stepper, supplementary=STIFF)
        assert 0.9 * most < told * rate <= most


@pytest.mark.parametrize("stepper", STEPPERS)
def test_roll_damping_that_a_step_cannot_follow_is_refused(stepper: str, run_halifax: Run) -> None:
    """Quadratic damping of a hundred times the usual; ten times is as well stepped as by RK4 at 0.05 s."""
    start = {"supplementary": SOFT, "initial_displacement": (0, 0, 0, 0.5, 0, 0), "duration": 20.0}
    too_much = RollDampingTerms(quadratic=4e10)
    told = longest(run_halifax, 0.4, stepper=stepper, roll_damping=too_much, **start)
    given = start | {"stepper": stepper, "roll_damping": too_much, "duration": 1.0}
    assert run_halifax(time_step=told, **given).outcome == "finished"
    if stepper == "exponential":
        much = RollDampingTerms(quadratic=4e9)
        coarse = run_halifax(time_step=0.2, roll_damping=much, **start).displacement[:, 3]
        fine = run_halifax(time_step=0.05, stepper="rk4", roll_damping=much, **start).displacement[::4, 3]
        # Measured 8e-4 of the heel; without a second look at the damping the run diverges.
        assert np.abs(coarse - fine).max() < 2e-3 * 0.5


def test_roll_damping_looked_at_twice_leaves_no_load_without_its_motion(
    run_halifax: Run, halifax: Ship
) -> None:
    """The load is that of the rate that is kept, and all loads sum to M η̈."""
    terms = RollDampingTerms(1e7, 2e9, 5e9)
    history = run_halifax(
        time_step=0.4, duration=8.0, roll_damping=terms, initial_displacement=(0, 0, 0, 0.4, 0, 0)
    )
    moment = history.loads["roll_damping"][1:, 3]
    # The linear part is carried with the slope, as every load's: to rounding of the largest.
    np.testing.assert_allclose(moment, terms.moment(history.velocity[1:, 3]), rtol=1e-9, atol=1.0)
    largest = np.abs(history.loads["weight"]).max()
    total = sum(history.loads.values())
    np.testing.assert_allclose(total, history.acceleration @ halifax.inertia, rtol=0, atol=1e-9 * largest)


def test_a_roll_beyond_what_the_step_follows_is_told(run_halifax: Run) -> None:
    """Thrown over at 1 rad/s, with damping that 10° of roll allows."""
    terms = RollDampingTerms(quadratic=2e9)
    given = {"time_step": 0.4, "duration": 4.0, "roll_damping": terms, "supplementary": SOFT}
    thrown = run_halifax(initial_velocity=(0, 0, 0, 1.0, 0, 0), **given)
    (note,) = [note for note in thrown.notes if "roll damping is so strong" in note]
    assert "0.4 s is unstable with the stepper exponential" in note
    calm = run_halifax(initial_velocity=(0, 0, 0, 0.05, 0, 0), **given)
    assert not any("so strong" in note for note in calm.notes)


@pytest.mark.parametrize("time_step", [1.0, 0.7])
def test_waves_that_overtake_are_too_fast_as_well(time_step: float, run_halifax: Run) -> None:
    """At 25 m/s in following seas a ship runs over short waves: ω_e = ω − ω² U/g is far below 0."""
    sea = WaveComponents(np.full(3, 0.05), np.array([1.4, 1.6, 1.8]), np.zeros(3), np.zeros(3))
    encounter = sea.encounter_frequency(25.0, 9.80665)
    assert encounter.max() < -3.5
    told = longest(run_halifax, time_step, seaway=sea, speed=25.0, ramp=1.0, duration=5.0)
    assert told == pytest.approx(np.pi / np.abs(encounter).max(), rel=0.1) and told < 0.5
    run_halifax(sea, time_step=told, speed=25.0, ramp=1.0, duration=5.0)


def test_half_a_wave_period_is_the_longest_step(run_halifax: Run) -> None:
    """Head waves of 2 rad/s at g/2 metres a second: ω_e = 4 rad/s, and π/4 s = 0.785 s."""
    given = {"seaway": RegularSeaway(0.1, 2.0, np.pi), "speed": 0.5 * 9.80665, "duration": 2.0}
    assert longest(run_halifax, 0.8, **given) == 0.78
    run_halifax(time_step=0.78, **given)


@pytest.mark.parametrize(
    ("value", "text"), [(1.19, "1.1"), (0.0999, "0.099"), (12.9, "12"), (0.5, "0.5"), (3.99e-5, "3.9e-05")]
)
def test_numbers_are_rounded_down_to_two_digits(value: float, text: str) -> None:
    assert rounded_down(value) == text
