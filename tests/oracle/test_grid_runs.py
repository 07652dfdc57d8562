"""Runs with the waves from the grid against runs that sum them directly."""

from collections.abc import Callable

import numpy as np
import pytest

from panelsim.motion.history import History
from panelsim.seaway.direction.spreading import CosineSquared
from panelsim.seaway.frequencies import EvenFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider

SPREAD = {"spreading": CosineSquared(), "direction_step": np.deg2rad(30.0)}


@pytest.mark.parametrize("spread", [{}, SPREAD], ids=["long-crested", "short-crested"])
def test_no_motion_moves_by_more_than_the_tolerance_of_the_grid(
    run_halifax: Callable[..., History], spread: dict[str, object]
) -> None:
    """HALIFAX at 20 knots in bow quartering seas, as in TM 2003-190 section 8.4, for forty seconds."""
    sea = RandomSeaway(
        Bretschneider(7.5, 15.0), EvenFrequencies(0.3, 1.85, 0.05), np.deg2rad(150.0), **spread
    )
    settings = {"speed": 10.289, "duration": 30.0, "ramp": 10.0, "time_step": 0.2}
    runs = {
        method: run_halifax(sea, pressure_method=method, **settings) for method in ("grid", "direct", "auto")
    }
    assert [run.attrs["pressure_method"] for run in runs.values()] == ["grid", "direct", "grid"]
    np.testing.assert_array_equal(runs["auto"].displacement, runs["grid"].displacement)
    direct = runs["direct"].displacement
    apart = np.abs(runs["grid"].displacement - direct).max(axis=0) / np.sqrt((direct**2).mean(axis=0))
    # The loads are within 2e-6 of each other. A thousandth is what a published number may move by.
    assert 0.0 < apart.max() < 1e-5
