"""Rotations and conjugate moments: signs, order, and virtual work."""

import pickle
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import panelsim
from panelsim.conventions import load_to_earth, rotation_to_earth
from panelsim.errors import PanelsimError

ANGLE = st.floats(-1.2, 1.2)


def test_signs_of_the_three_rotations() -> None:
    """Roll lowers starboard (raises port), pitch lowers the bow, yaw turns the bow to port."""
    port, bow = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
    assert (rotation_to_earth(0.1, 0, 0) @ port)[2] > 0
    assert (rotation_to_earth(0, 0.1, 0) @ bow)[2] < 0
    assert (rotation_to_earth(0, 0, 0.1) @ bow)[1] > 0


@given(ANGLE, ANGLE, ANGLE)
def test_rotation_is_yaw_then_pitch_then_roll_in_turned_axes(roll: float, pitch: float, yaw: float) -> None:
    """The words above TM 2003-190 (57)-(59); the printed matrix, the reverse product, fails this."""
    rx, ry, rz = (rotation_to_earth(*a) for a in ((roll, 0, 0), (0, pitch, 0), (0, 0, yaw)))
    # Rounding of a product of three rotations.
    np.testing.assert_allclose(rotation_to_earth(roll, pitch, yaw), rz @ ry @ rx, atol=1e-15)


@given(ANGLE, ANGLE, ANGLE, st.lists(st.floats(-1, 1), min_size=6, max_size=6))
def test_moments_do_the_virtual_work_of_the_force_system(
    roll: float, pitch: float, yaw: float, load: list[float]
) -> None:
    """Q·δη equals the work of forces at three points of the ship for any small change of the angles.

    Fails with (62) as printed (F6 sin η4 for F6 cos η4) and with moments that are not turned.
    """
    points = np.array([[1.0, 0.3, -0.2], [-0.7, 1.1, 0.4], [0.2, -0.9, 1.3]])
    forces = np.array(load).reshape(2, 3)
    forces = np.vstack([forces, forces[0] - 2 * forces[1]])  # ship axes
    total = np.concatenate([forces.sum(axis=0), np.cross(points, forces).sum(axis=0)])
    displacement = np.array([0.0, 0.0, 0.0, roll, pitch, yaw])
    generalised = load_to_earth(total, displacement)
    step = 1e-6
    for dof in range(3):
        plus, minus = displacement.copy(), displacement.copy()
        plus[3 + dof] += step
        minus[3 + dof] -= step
        moved = points @ (rotation_to_earth(*plus[3:]) - rotation_to_earth(*minus[3:])).T / (2 * step)
        earth_forces = forces @ rotation_to_earth(roll, pitch, yaw).T
        # Central differences of step 1e-6 leave about 1e-10.
        assert generalised[3 + dof] == pytest.approx(np.sum(moved * earth_forces), abs=1e-8)


def test_error_carries_all_four_parts() -> None:
    message = str(PanelsimError("Too steep", got="0.2", allowed="0.142", remedy="lower it"))
    for part in ("Too steep.", "0.2", "0.142", "lower it"):
        assert part in message


def test_the_package_and_its_metadata_state_one_version() -> None:
    """A history takes its version from the metadata, `panelsim --version` from the package."""
    assert version("panelsim") == panelsim.__version__


def test_an_error_from_another_process_says_the_same() -> None:
    error = PanelsimError("The step is too long", got=Path("a/b"), allowed="0.2 s", remedy="shorten it")
    again = pickle.loads(pickle.dumps(error))
    assert isinstance(again, PanelsimError)
    assert str(again) == str(error)
    assert (again.what, again.remedy) == (error.what, error.remedy)
