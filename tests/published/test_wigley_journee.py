"""Wigley hull III in head waves against the towing tank.

Source: J.M.J. Journée, Experiments and Calculations on 4 Wigley Hull Forms in Head Waves, Delft University
of Technology, Report 0909 (1992). Numbers read from its figures, good to about 10 %; the height of the
centre of gravity is not published. Theory here is zero-speed radiation with the speed terms of
Salvesen, Tuck and Faltinsen, which at Fn 0.3 is known to overpredict heave damping.
"""

from functools import cache

import numpy as np
import pytest

from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.store import database_for
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.simulate import simulate
from panelsim.seaway.regular import RegularSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

LENGTH = 3.0


@cache
def wigley() -> tuple[Ship, HydroDatabase]:
    ship = load_ship("wigley_iii")
    return ship, database_for(ship)


def head_wave(lambda_over_length: float, amplitude: float) -> tuple[RegularSeaway, float]:
    """A head wave and its wavenumber [rad/m]."""
    k = 2 * np.pi / (lambda_over_length * LENGTH)
    return RegularSeaway(amplitude, np.sqrt(k * wigley()[0].gravity), np.pi), k


@pytest.mark.parametrize(
    ("lambda_over_length", "heave", "pitch"), [(1.25, 0.345, 0.444), (1.5, 0.454, 0.546)]
)
def test_wave_loads_at_froude_number_0_3(lambda_over_length: float, heave: float, pitch: float) -> None:
    """|X3| / (C33 ζ) and |X5| / (k C55 ζ), incident wave and diffraction with its speed terms."""
    ship, database = wigley()
    wave, k = head_wave(lambda_over_length, 1e-3)
    c = wave.components
    speed = 0.3 * np.sqrt(ship.gravity * LENGTH)
    load = diffraction_load(database, c.frequency, c.wave_heading, speed) + froude_krylov_transfer(ship, c)
    stiffness = ship.hydrostatics.stiffness
    got = np.abs([load[0, 2] / stiffness[2, 2], load[0, 4] / (k * stiffness[4, 4])])
    print(f"λ/L {lambda_over_length}: X3 {got[0]:.3f} ({heave}), X5 {got[1]:.3f} ({pitch})")
    # 5 % at most is found, within the 10 % to which the points can be read; without diffraction
    # they are 12 and 13 % off in heave.
    np.testing.assert_allclose(got, [heave, pitch], rtol=0.08)


@pytest.mark.parametrize(
    ("lambda_over_length", "heave", "pitch"), [(1.0, 0.29, 0.57), (1.5, 0.57, 0.57), (2.0, 0.74, 0.50)]
)
def test_motions_at_rest_in_head_waves(lambda_over_length: float, heave: float, pitch: float) -> None:
    """|heave| / ζ and |pitch| / (2π ζ/L) of a nonlinear run in waves of ζ = 5 mm."""
    ship, database = wigley()
    amplitude = 0.005
    wave, _ = head_wave(lambda_over_length, amplitude)
    history = simulate(
        ship,
        wave,
        speed=0.0,
        duration=30.0,
        time_step=0.03,
        ramp=10.0,
        database=database,
        # The tank held the model in roll and near its place; surge stays soft.
        supplementary=Supplementary(stiffness={"roll": 50.0, "surge": 5.0}, damping={"surge": 20.0}),
    )
    t = history.time
    last = t > 25.0
    w = wave.wave_frequency
    basis = np.column_stack([np.cos(w * t), np.sin(w * t), np.ones_like(t)])[last]
    fit = np.linalg.lstsq(basis, history.displacement[last], rcond=None)[0]
    got = np.hypot(fit[0], fit[1])[[2, 4]] / [amplitude, 2 * np.pi * amplitude / LENGTH]
    print(f"λ/L {lambda_over_length}: heave {got[0]:.3f} ({heave}), pitch {got[1]:.3f} ({pitch})")
    # Heave is found within 9 %, pitch within 13 %: the reading (10 %) and the unknown KG.
    np.testing.assert_allclose(got, [heave, pitch], rtol=0.14)
