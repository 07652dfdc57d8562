"""The frequency domain against runs in time, a wave a run; reports/frequency_domain.md has more waves.

Every wave is run twice, the second time a quarter period later: the two motions are real and imaginary part
of H exp(iω_e t). So H is read at any instant, with ω_e signed, also where waves stand still beside her.
"""

from typing import Any

import numpy as np
import pytest

from panelsim.conventions import KNOT, ComplexArray
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.simulate import simulate_batch
from panelsim.response.response import response
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.seaways import CalmSeaway, Seaway
from panelsim.ship.ship import Ship

AMPLITUDE = 0.02  # m, slopes below 0.005: a nonlinear run is a linear one
SETTLED, END = 240.0, 280.0  # s; transients have died to 1e-3, yaw on its spring last
STANDING = 9.80665 / (20 * KNOT)  # rad/s: the wave as fast as a ship at 20 knots

# Knots, heading [deg], wave frequency [rad/s]: met at up to 3.1 rad/s, overtaken, standing beside her.
LINEAR = [
    *[(knots, 180.0, omega) for knots in (0, 10, 20) for omega in (0.4, 0.7)],
    *[(knots, 120.0, omega) for knots in (0, 10, 20) for omega in (0.5, 1.0)],
    *[(knots, 90.0, omega) for knots in (0, 20) for omega in (0.6, 1.2)],
    *[(knots, 60.0, omega) for knots in (10, 20) for omega in (0.8, 1.1)],
    *[(20, 30.0, omega) for omega in (0.5, 1.1, 1.5)],
    *[(20, 0.0, omega) for omega in (0.6, STANDING, 1.2)],
    (20, 150.0, 1.4),
]
NONLINEAR = [(20, 150.0, 0.7), (20, 30.0, 0.6), (20, 30.0, 1.2), (0, 90.0, 0.6)]
HEADINGS = np.deg2rad([180.0, 150.0, 120.0, 90.0, 60.0, 30.0, 0.0])


@pytest.fixture(scope="module")
def held() -> Supplementary:
    """TM 2003-190 section 8, with the yaw damped as well so that its transient dies within a run."""
    return Supplementary(
        stiffness={"surge": 5e5, "sway": 1e6, "yaw": 2e9},
        damping={"surge": 1e6, "sway": 2e6, "roll": 2e7, "yaw": 2e9},
    )


def sea(omega: float, heading_deg: float, phase: float) -> Seaway:
    return ComponentSeaway(
        WaveComponents(*(np.array([v]) for v in (AMPLITUDE, omega, np.deg2rad(heading_deg), phase)))
    )


def encounter(knots: float, heading_deg: float, omega: float) -> float:
    """Signed ω_e [rad/s]."""
    return omega - omega**2 / 9.80665 * knots * KNOT * np.cos(np.deg2rad(heading_deg))


def from_runs(
    ship: Ship,
    database: HydroDatabase,
    held: Supplementary,
    waves: list[tuple[float, float, float]],
    **given: Any,
) -> ComplexArray:
    """Motions (M, 6) per metre of wave, less what the ship does in calm water."""
    speeds = [knots * KNOT for knots, _, _ in waves]
    seas = [sea(omega, heading, lag) for lag in (0.0, -0.5 * np.pi) for _, heading, omega in waves]
    *runs, calm = simulate_batch(
        ship,
        [*seas, CalmSeaway()],
        speed=[*speeds, *speeds, 0.0],
        duration=END - 60.0,
        ramp=60.0,
        database=database,
        supplementary=held,
        **given,
    )
    last = calm.time >= SETTLED
    motion = np.array([run.displacement[last] - calm.displacement[last] for run in runs]) / AMPLITUDE
    first, second = np.split(motion, 2)
    met = np.array([encounter(*wave) for wave in waves])
    read = (first + 1j * second) * np.exp(-1j * np.outer(met, calm.time[last]))[..., None]
    return np.asarray(read.mean(axis=1))


def worst(
    ship: Ship,
    database: HydroDatabase,
    held: Supplementary,
    waves: list[tuple[float, float, float]],
    found: ComplexArray,
) -> np.ndarray:
    """Largest |difference| (6,) of complex amplitudes over each mode's peak at the speed."""
    omega = np.array(sorted({w for _, _, w in waves} | set(np.arange(0.2, 2.05, 0.1))))
    speeds = sorted({knots for knots, _, _ in waves})
    table = response(
        ship,
        database,
        frequencies=omega,
        wave_headings=HEADINGS,
        speeds=np.array(speeds) * KNOT,
        supplementary=held,
    )
    errors = []
    for (knots, heading, w), motions in zip(waves, found, strict=True):
        of_speed = table.transfer[speeds.index(knots)]
        at = of_speed[list(HEADINGS).index(np.deg2rad(heading)), np.searchsorted(omega, w)]
        errors.append(np.abs(motions - at) / np.abs(of_speed).max(axis=(0, 1)))
    return np.max(errors, axis=0)


def test_linear_runs_give_the_transfer_functions_wave_by_wave(
    halifax: Ship, halifax_database: HydroDatabase, held: Supplementary
) -> None:
    """Amplitude and phase at dt 0.1 s: 2 % of the peak is asked for, 3 % in roll.

    What is found, 0.19 % in pitch at most, comes from the memory of the waves; the runs add nothing to it.
    """
    found = from_runs(halifax, halifax_database, held, LINEAR, model="linear", time_step=0.1)
    error = worst(halifax, halifax_database, held, LINEAR, found)
    print(np.round(100 * error, 3))
    assert np.all(error < 0.005)


def test_nonlinear_runs_in_small_waves_give_them_too(
    halifax: Ship, halifax_database: HydroDatabase, held: Supplementary
) -> None:
    """Measured: 0.36 %, in roll, at most."""
    found = from_runs(halifax, halifax_database, held, NONLINEAR, model="nonlinear", time_step=0.2)
    error = worst(halifax, halifax_database, held, NONLINEAR, found)
    print(np.round(100 * error, 3))
    assert np.all(error < 0.005)


def test_waves_here_are_overtaken_and_stand_still() -> None:
    """Else the sign of ω_e would be no matter in these tests."""
    met = [encounter(*wave) for wave in LINEAR]
    assert min(met) < -0.2 and max(met) > 3.0 and min(np.abs(met)) < 1e-9
