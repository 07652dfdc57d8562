"""Stokes waves of second order, from the seaway to the history of a run and the drawn sea."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from panelsim.conventions import STRETCHINGS
from panelsim.errors import PanelsimError
from panelsim.hydro.store import database_for
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import panel_tables, wave_tables
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.wetted_surface import pressure_force
from panelsim.motion.history import History
from panelsim.motion.simulate import simulate
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.regular import RegularSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship
from panelsim.view.surfaces import SeaGrid

GRAVITY = 9.80665
PERIOD = 10.0
FREQUENCY = 2 * np.pi / PERIOD
WAVENUMBER = FREQUENCY**2 / GRAVITY
AMPLITUDE = 0.05 * np.pi / WAVENUMBER  # H/λ = 1/20, 3.9 m in waves of 156 m
SECOND = 0.5 * AMPLITUDE**2 * WAVENUMBER  # 0.31 m
PHASE = 0.4

# --- the seaway ---


def test_a_regular_seaway_hands_its_second_order_to_its_one_component() -> None:
    wave = RegularSeaway(1.0, 0.8, 0.3, 0.2, second_order=True)
    assert wave.components.second_order and wave.components.count == 1
    assert not RegularSeaway(1.0, 0.8, 0.3, 0.2).components.second_order
    assert wave.kind == "regular"
    with pytest.raises(TypeError):
        RegularSeaway(1.0, 0.8, 0.3, 0.2, 0.0, True)  # type: ignore[misc]


@pytest.mark.parametrize("second_order", [False, True])
def test_the_breaking_limit_is_that_of_the_height_in_either_theory(second_order: bool) -> None:
    """Crest and trough rise by the same ½ a² k, so H is 2 a; H/λ 0.142 is a k = 0.446."""
    steepest = 0.142 * np.pi * GRAVITY
    RegularSeaway(0.999 * steepest, 1.0, 0.0, second_order=second_order)
    with pytest.raises(PanelsimError, match=r"(?s)steeper.*0\.142"):
        RegularSeaway(1.001 * steepest, 1.0, 0.0, second_order=second_order)


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"wave_amplitude": np.nan}, "nan"),
        ({"wave_amplitude": -1.0}, "-1.0"),
        ({"wave_amplitude": "1"}, "'1'"),
        ({"wave_frequency": np.inf}, "inf"),
        ({"wave_heading": 150.0}, "150.0"),
        ({"phase": 90.0}, "90.0"),
        ({"phase": np.nan}, "nan"),
        ({"ship_heading": "north"}, "'north'"),
        ({"second_order": 1}, "1"),
    ],
)
def test_a_regular_seaway_of_other_values_is_refused(values: dict[str, Any], told: str) -> None:
    good = {"wave_amplitude": 1.0, "wave_frequency": 0.8, "wave_heading": 0.3}
    with pytest.raises(PanelsimError) as refused:
        RegularSeaway(**(good | values))
    name = next(iter(values)).removeprefix("wave_")
    assert name in str(refused.value) or name.replace("_", " ") in str(refused.value)
    assert told in str(refused.value)


# --- the load ---


@pytest.mark.parametrize("method", ["direct", "oracle"])
@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_the_pressure_force_is_that_of_the_stokes_wave(barge: Ship, stretching: str, method: str) -> None:
    seas = [RegularSeaway(0.8, 1.2, 2.5, PHASE, second_order=order) for order in (False, True)]
    displacement = np.array([0.3, -0.2, 0.1, 0.05, 0.02, 0.1])
    linear, stokes = (
        pressure_force(barge, sea, 1.7, displacement, speed=3.0, stretching=stretching, method=method)
        for sea in seas
    )
    k = 1.2**2 / barge.gravity
    waves = wave_tables(0.8, k, 2.5, 1.2 - 3.0 * k * np.cos(2.5), PHASE, second_order=True)
    expected = wetted_surface_load(
        panel_tables(barge.vertices, barge.mesh.panels),
        waves,
        np.array([[1.7, 1.0, *displacement]]),
        waterline=barge.waterline,
        water_density=barge.water_density,
        gravity=barge.gravity,
        stretching=stretching,
    )[0]
    weight = barge.mass * barge.gravity
    np.testing.assert_allclose(stokes, expected, atol=1e-11 * weight)  # times a length of 20 m
    assert np.abs(stokes - linear).max() > 1e-5 * weight


# --- a run ---


@pytest.fixture(scope="module")
def run_coarse(springs: Supplementary) -> Callable[..., History]:
    """A runner of 20 s in bow quartering waves without ramp, on the coarse mesh."""
    ship = load_ship("halifax", 10.0)
    database = database_for(ship)

    def run(*, second_order: bool, **given: Any) -> History:
        sea = RegularSeaway(AMPLITUDE, FREQUENCY, np.deg2rad(150), PHASE, second_order=second_order)
        settings = {"speed": 0.0, "duration": 20.0, "time_step": 0.2, "ramp": 0.0, **given}
        return simulate(ship, sea, database=database, supplementary=springs, **settings)

    return run


def amplitude_at(order: int, elevation: np.ndarray) -> complex:
    """Complex amplitude at a multiple of the wave frequency, from two whole periods of fifty steps."""
    turns = np.exp(-2j * np.pi * order * np.arange(100) / 50)
    return complex((elevation[:100] * turns).mean() * 2)


def test_a_run_in_stokes_waves_meets_their_second_harmonic(run_coarse: Callable[..., History]) -> None:
    """Wave elevation at the origin, exact at zero speed: a e^(iε) at ω and ½ a² k e^(2iε) at 2 ω."""
    linear, stokes = (run_coarse(second_order=order) for order in (False, True))
    assert amplitude_at(1, stokes.wave_elevation) == pytest.approx(AMPLITUDE * np.exp(1j * PHASE), rel=1e-12)
    assert amplitude_at(2, stokes.wave_elevation) == pytest.approx(SECOND * np.exp(2j * PHASE), rel=1e-12)
    assert abs(amplitude_at(2, linear.wave_elevation)) < 1e-12
    assert stokes.components.second_order and not linear.components.second_order
    # The load changes by some k ½ a² k = 1.2 % of the wave's, (Stokes - linear) being of third order.
    for dof in (2, 4):
        size = np.abs(linear.displacement[:, dof]).max()
        change = np.abs(stokes.displacement[:, dof] - linear.displacement[:, dof]).max() / size
        print(f"motion {dof}: largest {size:.3g}, changed by {100 * change:.2f} %")
        assert 2e-4 < change < 0.02
    assert not any("Stokes" in note for note in stokes.notes)


def test_the_second_order_grows_with_the_square_of_the_ramp(run_coarse: Callable[..., History]) -> None:
    """In the record of the waves as in the loads and in the drawn sea."""
    run = run_coarse(second_order=True, ramp=15.0, duration=5.0)
    grown = np.where(run.time < 15.0, 0.5 * (1 - np.cos(np.pi * run.time / 15.0)), 1.0)
    theta = FREQUENCY * run.time + PHASE
    expected = grown * AMPLITUDE * np.cos(theta) + grown**2 * SECOND * np.cos(2 * theta)
    np.testing.assert_allclose(run.wave_elevation, expected, atol=1e-12)  # angles of some tens of radians


def test_the_linear_model_takes_the_first_order_and_says_so(run_coarse: Callable[..., History]) -> None:
    linear, stokes = (run_coarse(second_order=order, model="linear") for order in (False, True))
    np.testing.assert_array_equal(stokes.displacement, linear.displacement)
    for name, load in stokes.loads.items():
        np.testing.assert_array_equal(load, linear.loads[name])
    assert np.abs(stokes.wave_elevation - linear.wave_elevation).max() > 0.9 * SECOND
    assert [note for note in stokes.notes if note not in linear.notes] == [
        "The linear model takes the first order of the Stokes waves; their second order shows in the"
        " elevation only."
    ]


@pytest.mark.parametrize("row", [20, 60])  # within the ramp and after it
def test_the_drawn_sea_has_the_second_order(row: int, make_history: Callable[..., History]) -> None:
    """Against a cos θ + ½ a² k cos 2θ vertex by vertex, a grown by the ramp, at 5 m/s."""
    waves = WaveComponents(
        np.array([1.5]), np.array([1.1]), np.array([2.2]), np.array([0.7]), second_order=True
    )
    run = make_history(components=waves)
    sea = SeaGrid.around(run)
    x, y, z = sea.vertices(row, sea.elevation(row)).T
    k = 1.1**2 / GRAVITY
    theta = k * (x * np.cos(2.2) - y * np.sin(2.2)) - (1.1 - 5.0 * k * np.cos(2.2)) * run.time[row] - 0.7
    a = 1.5 * (0.5 * (1 - np.cos(np.pi * 5.0 / 12.0)) if row == 20 else 1.0)
    expected = a * np.cos(theta) + 0.5 * a**2 * k * np.cos(2 * theta)
    # Round-off of angles of some tens of radians.
    np.testing.assert_allclose(z - run.waterline, expected, atol=1e-12)
    assert np.mean(expected[expected > 0] ** 2) > np.mean(expected[expected < 0] ** 2)  # crests stand higher
