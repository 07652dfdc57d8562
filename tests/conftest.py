"""A made-up run of a box barge, for tests of everything that reads a history."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from panelsim.hull.panel_mesh import PanelMesh
from panelsim.motion.history import History
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship

SPEED = 5.0
AMPLITUDE = np.array([0.5, 0.3, 1.2, 0.08, 0.04, 0.02])  # m and rad
MEAN = np.array([0.2, -0.1, 0.3, 0.01, -0.02, 0.0])
FREQUENCY = 2.0 * np.pi / 8.0  # rad/s


@pytest.fixture(scope="session")
def barge() -> Ship:
    """A box 20 m by 6 m by 4 m, draft 2 m, KG 1.5 m."""
    corners = [(x, y, z) for z in (0.0, 4.0) for x, y in ((-10, -3), (10, -3), (10, 3), (-10, 3))]
    panels = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    return Ship(
        PanelMesh(np.array(corners, dtype=float), np.array(panels)),
        draft=2.0,
        center_of_gravity=(None, 0.0, 1.5),
        gyradii=(2.0, 5.0, 5.0),
        name="barge",
    )


@pytest.fixture(scope="session")
def make_history(barge: Ship) -> Callable[..., History]:
    """A maker of histories: sinusoidal motions about a mean with a period of 8 s, loads that sum to M η̈.

    Any argument of `History.build` may be given instead, and `duration` and `step` [s].
    """

    def make(*, duration: float = 60.0, step: float = 0.25, **given: Any) -> History:
        time = step * np.arange(round(duration / step) + 1)
        phase = FREQUENCY * time[:, None] + np.arange(6.0)
        displacement = MEAN + AMPLITUDE * np.cos(phase)
        acceleration = -(FREQUENCY**2) * AMPLITUDE * np.cos(phase)
        weight = np.zeros((len(time), 6))
        weight[:, 2] = -barge.mass * barge.gravity
        values: dict[str, Any] = {
            "time": time,
            "displacement": displacement,
            "velocity": -FREQUENCY * AMPLITUDE * np.sin(phase),
            "acceleration": acceleration,
            "wave_elevation": 0.9 * np.sin(FREQUENCY * time),
            "loads": {"weight": weight, "wetted_surface": acceleration @ barge.inertia - weight},
            "ship": barge,
            "components": WaveComponents(
                np.array([0.9, 0.4]), np.array([0.8, 1.3]), np.array([2.4, 1.2]), np.array([0.3, 2.0])
            ),
            "seaway_kind": "random",
            "stretching": "wheeler",
            "speed": SPEED,
            "ramp": 12.0,
            "time_step": step,
            "model": "nonlinear",
            "outcome": "finished",
            "case": '{"ship": {"hull": "barge"}}',
            "seed": 7,
            "cpu_seconds": 0.5,
            "jit_seconds": 3.0,
            "notes": ["The sea repeats itself after 346 s."],
        }
        return History.build(**(values | given))

    return make
