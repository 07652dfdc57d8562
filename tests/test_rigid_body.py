"""Inertia at large angles, against point masses, closed forms of turning bodies, and quaternions."""

from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.special import ellipj

from panelsim.conventions import rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.loads.load import Instant
from panelsim.motion.equations import EquationsOfMotion
from panelsim.motion.free_rotation import (
    FreeRotation,
    angles_of,
    attitude_of,
    rotate_freely,
    to_earth,
    to_ship,
)
from panelsim.motion.rigid_body import RigidBody
from panelsim.motion.runge_kutta import RungeKutta4

MASS, MOMENTS = 7.0, np.array([2.0, 5.0, 6.0])
INERTIA = np.diag([MASS, MASS, MASS, *MOMENTS])
BODY = RigidBody(INERTIA)
RNG = np.random.default_rng(12)
POSES = RNG.uniform(-1.4, 1.4, (5, 6)) * [1, 1, 1, 4, 1, 4]  # roll and yaw beyond a half turn
RATES = RNG.normal(size=(5, 6))

angles = st.tuples(st.floats(-6.0, 6.0), st.floats(-1.5, 1.5), st.floats(-6.0, 6.0))


def inertia_of_points(pose: np.ndarray) -> np.ndarray:
    """Σ m ∂x/∂η ∂x/∂η (6, 6) of six masses on the ship axes that have this mass and these moments."""
    arm = np.sqrt(3.0 * (MOMENTS.sum() / 2.0 - MOMENTS) / MASS)
    points = np.concatenate([np.diag(arm), -np.diag(arm)])
    by_pose = np.empty((6, 6, 3))  # points, motions, directions
    by_pose[:, :3] = np.eye(3)
    for i in range(3):
        nudged = pose[3:] + 1e-30j * np.eye(3)[i]  # a complex step: derivatives to rounding
        by_pose[:, 3 + i] = points @ turned(nudged).imag.T / 1e-30
    return np.einsum("pix,pjx->ij", by_pose, by_pose) * MASS / 6.0


def turned(roll_pitch_yaw: np.ndarray) -> np.ndarray:
    return rotation_to_earth(*roll_pitch_yaw)


def test_the_inertia_is_that_of_masses_that_turn_with_the_ship() -> None:
    inertia, _ = BODY.terms(POSES, RATES)
    expected = np.array([inertia_of_points(pose) for pose in POSES])
    np.testing.assert_allclose(inertia, expected, rtol=0, atol=1e-13)  # rounding of moments up to 6
    at_rest, none = BODY.terms(np.zeros((1, 6)), np.zeros((1, 6)))
    np.testing.assert_array_equal(at_rest[0], INERTIA)
    np.testing.assert_array_equal(none, np.zeros((1, 6)))


def test_the_gyroscopic_moments_are_those_of_lagrange() -> None:
    """c = Ṁ η̇ − ½ ∂(η̇ᵀ M η̇)/∂η, by central differences of the inertia of the points."""
    _, gyroscopic = BODY.terms(POSES, RATES)
    for pose, rate, found in zip(POSES, RATES, gyroscopic, strict=True):
        step = 1e-5
        slopes = np.array(
            [
                (inertia_of_points(pose + step * side) - inertia_of_points(pose - step * side)) / (2 * step)
                for side in np.eye(6)
            ]
        )
        changing = np.einsum("k,kij,j->i", rate, slopes, rate)
        expected = changing - 0.5 * np.einsum("i,kij,j->k", rate, slopes, rate)
        # step² and 1e-16/step of moments up to 6 and rates up to 2, squared.
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8)
        assert np.abs(found[3:]).max() > 0.1
        np.testing.assert_array_equal(found[:3], 0.0)


def test_small_motions_know_the_inertia_at_rest_only() -> None:
    """What large angles add goes with the square of the motion."""
    sizes = np.array([1e-1, 1e-2, 1e-3])
    acceleration = RNG.normal(size=6)
    added = []
    for size in sizes:
        inertia, gyroscopic = BODY.terms(size * POSES[:1] / 4, size * RATES[:1])
        added.append(np.abs((inertia[0] - INERTIA) @ acceleration * size + gyroscopic[0]).max())
    slope = np.polyfit(np.log(sizes), np.log(added), 1)[0]
    assert slope == pytest.approx(2.0, abs=0.1)  # the cubic part at 0.1


@pytest.mark.parametrize("roll", [0.0, 0.7, 2.9, -4.0])
def test_a_top_precesses_under_a_moment(roll: float) -> None:
    """A body with Iy = Iz that spins about x at a steady bow angle θ, however it is rolled.

    Its spin p = φ̇ − ψ̇ sin θ and precession ψ̇ need Q5 = (Ix p + Iy ψ̇ sin θ) ψ̇ cos θ and nothing else.
    """
    along, across = 2.0, 5.0
    body = RigidBody(np.diag([1.0, 1.0, 1.0, along, across, across]))
    pitch, rolling, yawing = 0.4, 3.0, 0.6
    pose, rate = np.array([[0, 0, 0, roll, pitch, 1.0]]), np.array([[0, 0, 0, rolling, 0, yawing]])
    _, needed = body.terms(pose, rate)
    spin = rolling - yawing * np.sin(pitch)
    expected = (along * spin + across * yawing * np.sin(pitch)) * yawing * np.cos(pitch)
    np.testing.assert_allclose(needed[0], [0, 0, 0, 0, expected, 0], rtol=0, atol=1e-14)
    assert expected == pytest.approx(3.70, abs=0.01)


def test_angles_and_a_quaternion_follow_the_same_free_body() -> None:
    """Through many rolls, with pitch within 60°, as far as the angles of a run reach."""
    start, spin = np.array([0.2, 0.3, -0.5]), np.array([2.0, 0.5, 0.4])
    roll, pitch, _ = start
    rates = np.linalg.solve(
        [
            [1.0, 0.0, -np.sin(pitch)],
            [0.0, np.cos(roll), np.sin(roll) * np.cos(pitch)],
            [0.0, -np.sin(roll), np.cos(roll) * np.cos(pitch)],
        ],
        spin,
    )

    def rate(_: float, state: np.ndarray) -> np.ndarray:
        pose, velocity = np.zeros((2, 1, 6))
        pose[0, 3:], velocity[0, 3:] = state[:3], state[3:]
        inertia, gyroscopic = BODY.terms(pose, velocity)
        return np.concatenate([state[3:], np.linalg.solve(inertia[0], -gyroscopic[0])[3:]])

    found = solve_ivp(rate, (0, 20), [*start, *rates], method="DOP853", rtol=1e-11, atol=1e-12)
    assert np.abs(found.y[1]).max() < np.deg2rad(60.0)
    assert np.ptp(found.y[0]) > 4 * np.pi
    free = rotate_freely(MOMENTS, attitude_of(*start), spin, time_step=0.005, steps=4000)
    # RK4 at 0.01 rad a step over 40 rad: 40 · 0.01⁴/120; the other is off by less.
    np.testing.assert_allclose(turned(free.angles[-1]), turned(found.y[:3, -1]), rtol=0, atol=1e-7)


# --- quaternions -----------------------------------------------------------------------------------


@settings(deadline=None, max_examples=50)
@given(angles)
def test_a_quaternion_turns_as_the_angles_do(roll_pitch_yaw: tuple[float, float, float]) -> None:
    q = attitude_of(*roll_pitch_yaw)
    matrix = rotation_to_earth(*roll_pitch_yaw)
    vector = np.array([0.3, -1.2, 0.7])
    np.testing.assert_allclose(to_earth(q, vector), matrix @ vector, rtol=0, atol=1e-14)
    np.testing.assert_allclose(to_ship(q, vector), matrix.T @ vector, rtol=0, atol=1e-14)
    # 1e-16 over the cosine of the pitch, 0.07 at the least, in the arc sine.
    np.testing.assert_allclose(turned(angles_of(q)), matrix, rtol=0, atol=1e-13)


@pytest.fixture(scope="module")
def tumbling() -> FreeRotation:
    """100 turns and more of a body that is thrown up about its middle axis of inertia, as a racket is."""
    return rotate_freely(
        np.array([1.0, 2.0, 3.0]),
        attitude_of(0.5, -0.8, 2.0),
        np.array([0.01, 1.0, 0.01]),
        time_step=0.02,
        steps=33_000,
    )


def test_a_tumbling_body_keeps_energy_and_angular_momentum(tumbling: FreeRotation) -> None:
    moments = np.array([1.0, 2.0, 3.0])
    spin = tumbling.angular_velocity
    turns = np.sqrt((spin**2).sum(axis=1)).sum() * 0.02 / (2 * np.pi)
    assert turns > 100
    energy = (moments * spin**2).sum(axis=1)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)  # as the issue of large angles asks; 6e-8 found
    some = slice(None, None, 50)
    momentum = np.array(
        [turned(a) @ (moments * w) for a, w in zip(tumbling.angles[some], spin[some], strict=True)]
    )
    length = np.linalg.norm(momentum[0])
    np.testing.assert_allclose(momentum, momentum[:1].repeat(len(momentum), 0), rtol=0, atol=1e-6 * length)


def test_it_passes_through_every_attitude(tumbling: FreeRotation) -> None:
    """Upright bow and stern too, where angles fail; and every part of a turn of roll and yaw."""
    roll, pitch, yaw = np.degrees(tumbling.angles).T
    assert pitch.max() > 89.0
    assert pitch.min() < -89.0
    for angle in (roll, yaw):
        assert (np.histogram(angle, bins=36, range=(-180.0, 180.0))[0] > 0).all()


def test_it_spins_as_the_elliptic_functions_say() -> None:
    """ω of a free body in closed form, Landau and Lifshitz, Mechanics, section 37: h² > 2 E I2."""
    first, second, third = moments = np.array([1.0, 2.0, 3.0])
    start = np.array([0.3, 0.0, 0.9])
    double_energy, square = (moments * start**2).sum(), ((moments * start) ** 2).sum()
    assert square > double_energy * second
    free = rotate_freely(moments, attitude_of(0.1, 0.2, 0.3), start, time_step=0.02, steps=2000)
    rate = np.sqrt((third - second) * (square - double_energy * first) / moments.prod())
    modulus = ((second - first) * (double_energy * third - square)) / (
        (third - second) * (square - double_energy * first)
    )
    sn, cn, dn, _ = ellipj(rate * free.time, modulus)
    across = np.sqrt((double_energy * third - square) / (second * (third - second)))
    expected = np.stack([start[0] * cn, across * sn, start[2] * dn], axis=1)
    # RK4 over 40 rad at 0.02 a step, 40 · 0.02⁴/120 = 5e-8; found 1e-7.
    np.testing.assert_allclose(free.angular_velocity, expected, rtol=0, atol=3e-7)


def test_the_scheme_is_of_fourth_order() -> None:
    found = []
    for steps in (40, 80, 160, 1280):
        free = rotate_freely(
            MOMENTS, attitude_of(0, 0, 0), np.array([1.0, 2.0, 0.5]), time_step=8.0 / steps, steps=steps
        )
        found.append(free.attitude[-1])
    errors = [np.abs(attitude - found[-1]).max() for attitude in found[:3]]
    slope = -np.polyfit(np.log([40, 80, 160]), np.log(errors), 1)[0]
    assert slope == pytest.approx(4.0, abs=0.4)  # the next order at the coarsest


def test_a_symmetric_body_precesses_about_its_angular_momentum() -> None:
    """h along the vertical: the bow goes round at h/Iy, up by a steady angle, and the ship rolls steadily."""
    along, across, pitch = 2.0, 5.0, -0.6
    momentum = 3.0
    spin = momentum / np.array([along, across, across]) * rotation_to_earth(0.0, pitch, 0.0)[2]
    moments = np.array([along, across, across])
    free = rotate_freely(moments, attitude_of(0, pitch, 0), spin, time_step=0.02, steps=500)
    roll, found_pitch, yaw = np.unwrap(free.angles, axis=0).T
    tolerance = {"rtol": 0, "atol": 1e-7}  # RK4 over 10 rad at 0.02 a step: 10 · 0.02⁴/120
    np.testing.assert_allclose(found_pitch, pitch, **tolerance)
    np.testing.assert_allclose(yaw, momentum / across * free.time, **tolerance)
    rolling = momentum * np.sin(pitch) * (1 / across - 1 / along)
    np.testing.assert_allclose(roll, rolling * free.time, **tolerance)


# --- equations of motion -------------------------------------------------------------------------


class Spring:
    """−C η with a full C."""

    name = "spring"
    stiffness: ClassVar[np.ndarray] = np.diag([1.0, 2.0, 3.0, 4.0, 9.0, 8.0]) + 0.3

    def evaluate(self, instant: Instant) -> np.ndarray:
        return -np.einsum("ij,bj->bi", self.stiffness, instant.displacement)


def still_water(added_mass: np.ndarray) -> Any:
    """Radiation without memory."""
    return SimpleNamespace(
        name="radiation",
        added_mass_infinite=added_mass,
        start=lambda displacement, velocity: np.concatenate([displacement, velocity], axis=1),
        evaluate=lambda motion: np.zeros((len(motion), 6)),
        memory_rate=lambda motion: np.empty((len(motion), 0)),
    )


ADDED_MASS = np.diag([0.5, 3.0, 6.0, 0.4, 2.0, 1.0]) + 0.1


def equations(*, large_angles: bool = True) -> EquationsOfMotion:
    return EquationsOfMotion(INERTIA, [Spring()], still_water(ADDED_MASS), large_angles=large_angles)


START = np.array([[0.3, 0.2, 0.1, 0.9, 0.5, -0.7]]), np.array([[0.2, 0.0, 0.4, 1.0, -0.8, 0.9]])


def test_loads_sum_to_the_inertia_at_rest_times_the_acceleration() -> None:
    """With the inertial load, which has a name and no force; M(η) η̈ + c is what the other loads move."""
    all_of = equations()
    assert all_of.load_names == ("spring", "inertial", "radiation")
    acceleration, loads = all_of.evaluate(0.0, np.concatenate(START, axis=1))
    np.testing.assert_allclose(loads.sum(axis=1), acceleration @ INERTIA, rtol=0, atol=1e-13)
    inertia, gyroscopic = BODY.terms(*START)
    np.testing.assert_allclose(
        (loads[:, 0] + loads[:, 2])[0], inertia[0] @ acceleration[0] + gyroscopic[0], rtol=0, atol=1e-13
    )
    np.testing.assert_allclose(loads[:, 2], -acceleration @ ADDED_MASS, rtol=0, atol=1e-13)
    np.testing.assert_array_equal(loads[0, 1, :3], 0.0)
    assert np.abs(loads[0, 1, 3:]).min() > 0.1
    plain = equations(large_angles=False)
    assert plain.load_names == ("spring", "radiation")
    expected = np.linalg.solve(INERTIA + ADDED_MASS, -Spring.stiffness @ START[0][0])
    np.testing.assert_allclose(plain.evaluate(0.0, np.concatenate(START, axis=1))[0][0], expected, atol=1e-14)


def test_conservative_loads_keep_the_energy() -> None:
    """½ η̇ᵀ (M(η) + A∞) η̇ + ½ ηᵀ C η, to the order of RK4; not without the inertial load."""

    def energies(time_step: float, *, large_angles: bool = True) -> np.ndarray:
        scheme = RungeKutta4(equations(large_angles=large_angles), time_step)
        state, found = scheme.start(*START), []
        for _ in range(round(20.0 / time_step)):
            inertia, _ = BODY.terms(state.displacement, state.velocity)
            kinetic = state.velocity[0] @ (inertia[0] + ADDED_MASS) @ state.velocity[0]
            found.append(0.5 * (kinetic + state.displacement[0] @ Spring.stiffness @ state.displacement[0]))
            state = scheme.step(state)
        return np.array(found)

    lost = [np.abs(energies(step) / energies(step)[0] - 1.0).max() for step in (0.05, 0.025)]
    assert lost[1] < 1e-6  # some 50 rad of motion at 0.06 rad a step: 50 · 0.06⁵
    assert lost[0] / lost[1] > 12.0  # 16 for the fourth order
    linear = energies(0.025, large_angles=False)
    assert np.abs(linear / linear[0] - 1.0).max() > 1e-2


def test_a_ship_is_the_same_alone_and_in_a_batch() -> None:
    motions = np.concatenate([POSES, RATES], axis=1)
    together = equations().evaluate(0.0, motions)
    for i in range(len(motions)):
        alone = equations().evaluate(0.0, motions[i : i + 1])
        for mine, theirs in zip(alone, together, strict=True):
            np.testing.assert_array_equal(mine[0], theirs[i])


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "inertia",
    [
        np.eye(5),
        np.ones(6),
        np.eye(6) + 0.1,
        np.diag([1.0, 1.0, 2.0, 1.0, 1.0, 1.0]),
        np.diag([1.0, 1.0, 1.0, 1.0, 0.0, 1.0]),
        np.diag([1.0, 1.0, 1.0, 1.0, np.nan, 1.0]),
        np.diag([1.0, 1.0, 1.0, 1.0, np.inf, 1.0]),
    ],
)
def test_another_inertia_is_refused(inertia: np.ndarray) -> None:
    with pytest.raises(PanelsimError, match="The inertia is not that of a ship"):
        RigidBody(inertia)


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("moments_of_inertia", [1.0, 2.0], "3 finite numbers"),
        ("moments_of_inertia", [1.0, 2.0, -1.0], "positive numbers"),
        ("attitude", [1.0, 0.0, 0.0], "4 finite numbers"),
        ("attitude", [1.0, 0.1, 0.0, 0.0], "unit length"),
        ("angular_velocity", [np.nan, 0.0, 0.0], "3 finite numbers"),
        ("angular_velocity", ["a", "b", "c"], "3 finite numbers"),
        ("time_step", 0.0, "more than 0 s"),
        ("time_step", np.nan, "more than 0 s"),
        ("steps", 0, "a whole number from 1"),
        ("steps", 2.5, "a whole number from 1"),
    ],
)
def test_a_free_rotation_refuses(name: str, value: object, told: str) -> None:
    given: dict[str, Any] = {
        "moments_of_inertia": MOMENTS,
        "attitude": [1.0, 0.0, 0.0, 0.0],
        "angular_velocity": [1.0, 0.0, 0.0],
        "time_step": 0.1,
        "steps": 2,
    }
    with pytest.raises(PanelsimError, match=told):
        rotate_freely(**(given | {name: value}))
