"""Natural periods: closed forms, the matrices of their own frequency, and decays in the time domain."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from panelsim.conventions import Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.interpolation import complex_inertia
from panelsim.hydro.roll_damping.decay import fit_roll_decay
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.store import database_for
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.simulate import simulate
from panelsim.response.natural import natural_periods
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship


def test_uncoupled_periods_are_those_of_their_own_frequency(
    halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """T = 2π√((I + A(ω))/C) and ζ = B(ω)/(2√((I + A) C)), WORKSHOP 2.2, at ω = 2π/T."""
    found = natural_periods(halifax, halifax_database)
    for name, mode in found.items():
        assert mode is not None
        dof = Dof[name.upper()]
        omega = 2 * np.pi / mode.uncoupled_period
        inertia = complex_inertia(halifax_database, np.array([omega]))[0, dof, dof]
        mass = halifax.inertia[dof, dof] + inertia.real
        stiffness = halifax.hydrostatics.stiffness[dof, dof]
        assert omega == pytest.approx(np.sqrt(stiffness / mass), rel=1e-9)
        ratio = -omega * inertia.imag / (2 * np.sqrt(mass * stiffness))
        assert mode.uncoupled_damping_ratio == pytest.approx(ratio, rel=1e-6)
        # Other motions go with it, and shift it by a few per cent.
        assert mode.period == pytest.approx(mode.uncoupled_period, rel=0.03)


def test_a_sphere_heaves_as_a_sphere() -> None:
    """Half immersed, radius r: A33 and B33 of Hulme (1982) at K r = 1.35 are 0.44 and 0.13 of 2πρr³/3.

    With them ω² r/g = 1.5/(1 + A): period 2π √(r (1 + A)/(1.5 g)), and ζ = ½ B/(1 + A).
    """
    ship = load_ship("sphere")
    radius = ship.draft
    mode = natural_periods(ship, database_for(ship))["heave"]
    assert mode is not None
    added = 0.44
    expected = 2 * np.pi * np.sqrt(radius * (1 + added) / (1.5 * ship.gravity))
    assert mode.period == pytest.approx(expected, rel=0.03)


def test_the_damping_ratio_is_over_the_size_of_the_root() -> None:
    """For (M + A) s² + B s + C = 0 at the frequency of the mode ζ = B/(2√((M + A) C)), T = 2π√((M + A)/C).

    A half sphere heaves alone, with ζ of 0.084: over Im(s) it would be 0.35 % more.
    """
    ship = load_ship("sphere")
    database = database_for(ship)
    mode = natural_periods(ship, database)["heave"]
    assert mode is not None
    omega = 2.0 * np.pi / mode.damped_period
    inertia = complex_inertia(database, np.array([omega]))[0, 2, 2]
    mass, damping = ship.inertia[2, 2] + inertia.real, -omega * inertia.imag
    stiffness = ship.hydrostatics.stiffness[2, 2]
    assert mode.damping_ratio == pytest.approx(damping / (2.0 * np.sqrt(mass * stiffness)), rel=1e-6)
    assert mode.period == pytest.approx(2.0 * np.pi * np.sqrt(mass / stiffness), rel=1e-6)
    assert mode.damping_ratio > 0.05


def test_a_decay_shows_the_period_and_ratio(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """Linear roll decay from 0.05 rad with a roll damper: period to 0.5 %, damping to 2 %.

    The first swing holds the start of the other motions. (Springs and dampers in sway, which have a mode near
    that of roll, would make more of it.)
    """
    damper = Supplementary(damping={"roll": 1e7})
    mode = natural_periods(halifax, halifax_database, damper)["roll"]
    assert mode is not None
    history = simulate(
        halifax,
        CalmSeaway(),
        speed=0.0,
        duration=80.0,
        time_step=0.1,
        ramp=0.0,
        database=halifax_database,
        model="linear",
        supplementary=damper,
        initial_displacement=(0.0, 0.0, 0.0, 0.05, 0.0, 0.0),
    )
    fit = fit_roll_decay(history.time, history.displacement[:, Dof.ROLL])
    print(fit.period, mode.period, fit.damping_ratio, mode.damping_ratio)
    assert fit.period == pytest.approx(mode.period, rel=0.005)
    assert fit.equivalent_damping_ratio(0.02) == pytest.approx(mode.damping_ratio, rel=0.02)
    assert mode.damped_period > mode.period


@pytest.mark.parametrize(
    ("dof", "start", "period_within", "ratio_within"),
    [(Dof.HEAVE, 0.1, 0.01, 0.10), (Dof.PITCH, 0.01, 0.06, 0.15)],
)
def test_heave_and_pitch_decay_about_as_the_matrices_say(
    halifax: Ship,
    halifax_database: HydroDatabase,
    dof: Dof,
    start: float,
    period_within: float,
    ratio_within: float,
) -> None:
    """One damped sinusoid over 15 s from the release of a linear run.

    Measured in period and ratio: heave 0.4 % and 5 %, pitch 4 % and 10 %. A fifth of critical damping leaves
    two swings, no steady oscillation, of which the matrices are: a fit that begins 2.5 s later has periods
    10 % shorter and other ratios.
    """
    mode = natural_periods(halifax, halifax_database)[dof.name.lower()]
    assert mode is not None
    released = np.zeros(6)
    released[dof] = start
    history = simulate(
        halifax,
        CalmSeaway(),
        speed=0.0,
        duration=15.0,
        time_step=0.05,
        ramp=0.0,
        database=halifax_database,
        model="linear",
        initial_displacement=released,
    )
    time, motion = history.time, history.displacement[:, dof] / start

    def misfit(p: np.ndarray) -> np.ndarray:
        swing = p[1] * np.cos(p[2] * time) + p[3] * np.sin(p[2] * time)
        return np.asarray(np.exp(-p[0] * time) * swing + p[4] - motion)

    decay, _, omega, _, _ = least_squares(misfit, [0.2, 1.0, 2.0 * np.pi / mode.period, 0.0, 0.0]).x
    size = np.hypot(decay, omega)
    print(dof.name, 2.0 * np.pi / size, mode.period, decay / size, mode.damping_ratio)
    assert 2.0 * np.pi / size == pytest.approx(mode.period, rel=period_within)
    assert decay / size == pytest.approx(mode.damping_ratio, rel=ratio_within)


def test_roll_damping_adds_to_the_ratio(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """5 % of critical adds some 5 % less what the coupling takes; only the linear term counts."""
    bare = natural_periods(halifax, halifax_database)["roll"]
    assert bare is not None
    omega = 2 * np.pi / bare.uncoupled_period
    stiffness = halifax.hydrostatics.stiffness[Dof.ROLL, Dof.ROLL]
    terms = RollDampingTerms.of_critical(0.05, stiffness / omega**2, stiffness)
    found = natural_periods(halifax, halifax_database, None, terms)
    assert found["roll"] is not None
    added = found["roll"].uncoupled_damping_ratio - bare.uncoupled_damping_ratio
    assert added == pytest.approx(0.05, rel=1e-9)
    assert found["roll"].damping_ratio - bare.damping_ratio == pytest.approx(0.05, rel=0.15)
    more = RollDampingTerms(terms.linear, 1e9, 1e9)
    assert natural_periods(halifax, halifax_database, None, more)["roll"] == found["roll"]


def test_what_does_not_swing_has_no_period(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """A ship of negative metacentric height, and one that is damped beyond the critical."""
    ship = load_ship("wigley_i")
    assert natural_periods(ship, database_for(ship))["roll"] is None
    damped = Supplementary(damping={"roll": 1e10})
    assert natural_periods(halifax, halifax_database, damped)["roll"] is None


def test_other_arguments_are_refused(halifax: Ship, halifax_database: HydroDatabase, barge: Ship) -> None:
    with pytest.raises(PanelsimError, match="another ship"):
        natural_periods(barge, halifax_database)
    with pytest.raises(PanelsimError, match="roll damping"):
        natural_periods(halifax, halifax_database, None, 0.05)  # type: ignore[arg-type]
