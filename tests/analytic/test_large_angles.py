"""Runs at large angles: a box that capsizes, and one that rolls, pitches and yaws at once."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.simulate import simulate_batch
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.ship import Ship

Run = Callable[..., tuple[History, ...]]

DEPTH, DRAFT, BEAM = 5.0, 2.0, 6.0
TOP_HEAVY, STEADY = 4.25, 1.5  # heights of the centre of gravity: GM −1.75 m and +1 m


def box(height: float) -> Ship:
    """20 m long."""
    mesh = load_hull("box").scaled(length=20.0, beam=BEAM, draft=DRAFT).panel(3.0)
    return Ship(mesh, draft=DRAFT, center_of_gravity=(None, 0.0, height), gyradii=(2.2, 4.5, 6.5), name="box")


def runner(ship: Ship, database: HydroDatabase) -> Run:
    """Batches in calm water from one start or many, held by dampers and by springs where water gives none."""
    held = Supplementary({"sway": 2e4, "yaw": 1e6}, {"roll": 3e5, "heave": 1e5, "sway": 5e4, "yaw": 2e5})

    def run(**given: Any) -> tuple[History, ...]:
        defaults: dict[str, Any] = {
            "speed": 0.0,
            "duration": 80.0,
            "time_step": 0.1,
            "ramp": 0.0,
            "database": database,
            "supplementary": held,
            "capsize_angle": 0.0,
        }
        count = len(np.atleast_2d(given.get("initial_displacement", np.zeros(6))))
        return simulate_batch(ship, [CalmSeaway()] * count, **(defaults | given))

    return run


@pytest.fixture(scope="module")
def run_top_heavy() -> Run:
    ship = box(TOP_HEAVY)
    return runner(ship, HydroDatabase.compute(ship))


@pytest.fixture(scope="module")
def run_steady() -> Run:
    ship = box(STEADY)
    return runner(ship, HydroDatabase.compute(ship))


@pytest.mark.parametrize("stepper", ["exponential", "rk4", "ab3"])
def test_a_box_that_capsizes_ends_upside_down(stepper: str, run_top_heavy: Run) -> None:
    """At rest on its deck at the same draft, over one side or the other: roll ±180°."""
    # A little trim and yaw, so that all the moments of large angles are in play.
    starts = [(0.0, 0.0, 0.0, 0.05 * side, 0.03, 0.1) for side in (1.0, -1.0)]
    # Heights of the CG over the water on the deck and on the bottom.
    upside_down = (DEPTH - TOP_HEAVY - DRAFT) - (TOP_HEAVY - DRAFT)
    inertia = box(TOP_HEAVY).inertia
    for side, history in zip(
        (1.0, -1.0), run_top_heavy(stepper=stepper, initial_displacement=starts), strict=True
    ):
        assert history.outcome == "finished"
        assert np.abs(history.displacement[:, 3]).max() > np.deg2rad(190.0)  # it swings through
        end = history.displacement[-1]
        # What is left of the swing after 80 s is 1e-3 rad.
        np.testing.assert_allclose(end[2:5], [upside_down, np.pi * side, 0.0], rtol=0, atol=3e-3)
        assert np.abs(history.velocity[-1, 2:5]).max() < 3e-3
        loads = sum(history.loads.values())
        error = np.abs(loads - history.acceleration @ inertia).max()
        assert error < 1e-9 * np.abs(history.loads["weight"]).max()  # rounding of the largest load


def test_with_a_capsize_angle_the_run_ends_there(run_top_heavy: Run) -> None:
    (history,) = run_top_heavy(initial_displacement=(0, 0, 0, 0.05, 0, 0), capsize_angle=np.pi / 2)
    assert history.outcome == "capsized"


TURNING: dict[str, Any] = {
    "initial_displacement": (0.0, 0.0, 0.0, 0.5, 0.1, 0.2),
    "initial_velocity": (0.0, 0.0, 0.0, 0.5, 0.1, -0.3),
    "duration": 8.0,
}


@pytest.mark.parametrize(("stepper", "allowed"), [("exponential", 1e-4), ("ab3", 2e-3)])
def test_schemes_agree_at_large_angles(stepper: str, allowed: float, run_steady: Run) -> None:
    """Rolling by 30°, pitching and yawing at once; RK4 at a quarter of the step is the truth."""
    truth = run_steady(stepper="rk4", time_step=0.0125, **TURNING)[0].displacement
    peak = np.abs(truth).max(axis=0)[2:]
    errors = []
    for every in (8, 4):
        found = run_steady(stepper=stepper, time_step=0.0125 * every, **TURNING)[0].displacement
        errors.append((np.abs(found - truth[::every])[:, 2:] / peak).max())
    assert errors[1] < allowed
    assert errors[0] / errors[1] > 6.0  # 8 for the third order; the wet hull has kinks


def test_the_linear_inertia_is_another_and_an_option(run_steady: Run) -> None:
    """What large angles do to pitch and yaw shows; in the linear model there are none."""
    large, asked, linear = (
        run_steady(time_step=0.05, **TURNING, **given)[0]
        for given in ({}, {"inertia": "large"}, {"inertia": "linear"})
    )
    assert large.same_bits(asked)
    assert "inertial" in large.loads
    assert "inertial" not in linear.loads
    assert np.abs(large.displacement - linear.displacement)[:, 4:].max() > 2e-3
    assert "inertial" not in run_steady(time_step=0.05, model="linear", **TURNING)[0].loads


def test_small_motions_have_the_same_in_both(run_steady: Run) -> None:
    """The difference goes with the square of the motion."""
    sizes = np.array([[0.2], [0.1], [0.05]])
    given = {name: sizes * np.array(TURNING[name]) for name in ("initial_displacement", "initial_velocity")}
    large, linear = (
        np.stack([history.displacement for history in run_steady(duration=4.0, inertia=inertia, **given)])
        for inertia in ("large", "linear")
    )
    apart = np.abs(large - linear)[..., 3:].max(axis=(1, 2))
    assert np.polyfit(np.log(sizes[:, 0]), np.log(apart), 1)[0] == pytest.approx(
        2.0, abs=0.2
    )  # third order at 6°


def test_a_run_with_another_inertia_does_not_go_on(run_steady: Run) -> None:
    first = run_steady(time_step=0.05, **TURNING | {"duration": 4.0})
    (whole,) = run_steady(time_step=0.05, **TURNING)
    (resumed,) = run_steady(time_step=0.05, resume=first, **TURNING)
    assert resumed.same_bits(whole)
    with pytest.raises(PanelsimError, match="another run: its inertia is another"):
        run_steady(time_step=0.05, resume=first, inertia="linear", **TURNING)


def test_a_batch_gives_the_same_bits(run_steady: Run) -> None:
    starts = [TURNING["initial_displacement"], (0.0, 0.0, 0.3, -0.9, 0.05, 0.0)]
    together = run_steady(duration=4.0, initial_displacement=starts)
    for start, history in zip(starts, together, strict=True):
        (alone,) = run_steady(duration=4.0, initial_displacement=start)
        assert alone.same_bits(history)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"inertia": "small"}, "Unknown inertia"),
        ({"inertia": True}, "Unknown inertia"),
        ({"model": "linear", "inertia": "large"}, "The linear model has the inertia of small angles"),
    ],
)
def test_another_inertia_is_refused(given: dict[str, Any], told: str, run_steady: Run) -> None:
    with pytest.raises(PanelsimError, match=told):
        run_steady(**given)
