"""Fits of roll decay records: known coefficients come back."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.decay import RollDecay, fit_roll_decay
from panelsim.hydro.roll_damping.extinction import fit_extinction_curve
from panelsim.hydro.roll_damping.terms import RollDampingTerms

PERIOD = 9.0
FREQUENCY = 2.0 * np.pi / PERIOD
RELEASE = np.deg2rad(20.0)


def decay(
    ratio: float, quadratic: float, *, cycles: float = 8.0, time_step: float = 0.1, start: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Time and roll of a release from 20 degrees, by an integrator that is not that of the fit."""
    time = np.arange(0.0, cycles * PERIOD, time_step)
    linear = 2.0 * ratio * FREQUENCY

    def rates(_: float, state: FloatArray) -> list[float]:
        roll, rate = state
        return [rate, -(FREQUENCY**2) * roll - linear * rate - quadratic * rate * abs(rate)]

    run = solve_ivp(rates, (0.0, time[-1]), [RELEASE, 0.0], t_eval=time, rtol=1e-10, atol=1e-12)
    return start + time, run.y[0]


def check(fit: RollDecay, ratio: float, quadratic: float, tolerance: float) -> None:
    assert fit.period == pytest.approx(PERIOD, rel=tolerance)
    assert fit.damping_ratio == pytest.approx(ratio, rel=tolerance, abs=1e-6)
    assert fit.quadratic == pytest.approx(quadratic, rel=tolerance, abs=1e-6)


@pytest.mark.parametrize("ratio", [0.01, 0.05, 0.2])
def test_linear_decay_in_closed_form(ratio: float) -> None:
    """φ = e^(-ζωt)(cos ω_d t + …): logarithmic decrement 2πζ/√(1-ζ²), both ways of fitting."""
    time = np.arange(0.0, 6.0 * PERIOD, 0.1)
    damped = FREQUENCY * np.sqrt(1.0 - ratio**2)
    roll = RELEASE * np.exp(-ratio * FREQUENCY * time)
    roll = roll * (np.cos(damped * time) + ratio * FREQUENCY / damped * np.sin(damped * time))
    fit = fit_roll_decay(time, roll)
    # RK4 at 60 steps a period is good to 1e-6; ten times that for the damping of 1 %.
    check(fit, ratio, 0.0, 1e-4)
    assert fit.residual < 1e-6
    # The extremes are read from parabolas over a quarter of a period: 3 % here where few are left.
    curve = fit_extinction_curve(time, roll)
    assert curve.period == pytest.approx(PERIOD, rel=2e-3)
    assert curve.linear == pytest.approx(2.0 * ratio * FREQUENCY, rel=0.05)


@pytest.mark.parametrize(
    ("ratio", "quadratic", "cycles", "time_step"),
    [(0.03, 0.3, 8, 0.1), (0.0, 0.3, 8, 0.1), (0.1, 1.0, 8, 0.1), (0.03, 0.3, 2, 0.1), (0.03, 0.3, 8, 0.5)],
)
def test_known_coefficients_come_back(
    ratio: float, quadratic: float, cycles: float, time_step: float
) -> None:
    """A few cycles, quadratic damping alone, 18 samples a period: all within 1e-4, where 1 % is asked."""
    check(
        fit_roll_decay(*decay(ratio, quadratic, cycles=cycles, time_step=time_step)), ratio, quadratic, 1e-4
    )


def test_offset_and_trend_are_told_from_the_roll() -> None:
    """A clock that starts at 100 s, a list of 1 degree, a drift of 0.03 degrees a second."""
    time, roll = decay(0.03, 0.3, start=100.0)
    fit = fit_roll_decay(time, roll + np.deg2rad(1.0) + np.deg2rad(0.03) * time)
    check(fit, 0.03, 0.3, 1e-4)
    assert np.rad2deg([fit.offset, fit.trend]) == pytest.approx([1.0, 0.03], rel=1e-3)


def test_uneven_samples() -> None:
    time, roll = decay(0.03, 0.3)
    keep = np.random.default_rng(3).uniform(size=len(time)) < 0.3
    check(fit_roll_decay(time[keep], roll[keep]), 0.03, 0.3, 1e-4)


def test_noise_averages_out() -> None:
    """Noise of 1 % of the release: the mean of 12 seeds is within 1 %, where its standard error is 0.6 %."""
    time, roll = decay(0.03, 0.3)
    fits = []
    for seed in range(12):
        noise = 0.01 * RELEASE * np.random.default_rng(seed).standard_normal(len(time))
        fits.append(fit_roll_decay(time, roll + noise))
        assert fits[-1].residual == pytest.approx(0.01 * RELEASE, rel=0.1)
    assert np.mean([fit.period for fit in fits]) == pytest.approx(PERIOD, rel=1e-4)
    assert np.mean([fit.damping_ratio for fit in fits]) == pytest.approx(0.03, rel=0.01)
    assert np.mean([fit.quadratic for fit in fits]) == pytest.approx(0.3, rel=0.01)
    # One record alone scatters with a standard deviation of 2 %: three of them.
    np.testing.assert_allclose([fit.damping_ratio for fit in fits], 0.03, rtol=0.06)


def test_standard_errors_are_the_scatter_of_the_fits() -> None:
    """Two cycles with 0.6° of noise, 40 seeds: b1 alone is then hardly known, and the fit says so."""
    time, roll = decay(0.03, 0.3)
    short = time < 2.2 * PERIOD
    time, roll = time[short], roll[short]
    noise = np.deg2rad(0.6) * np.random.default_rng(5).standard_normal((40, len(time)))
    fits = [fit_roll_decay(time, roll + one) for one in noise]
    inner = [fit for fit in fits if fit.linear > 0.0 and fit.quadratic > 0.0]
    assert len(inner) > 20
    for value, error in (("period", "period_error"), ("linear", "linear_error")):
        told = np.mean([getattr(fit, error) for fit in inner])
        # Bounds at 0 cut the scatter of the damping, 40 seeds tell it to a tenth.
        ratio = np.std([getattr(fit, value) for fit in fits]) / told
        print(value, ratio, told)
        assert 0.5 < ratio < 1.5
    clean = fit_roll_decay(time, roll)
    assert clean.linear_error < 1e-6 and clean.period_error < 1e-5
    assert np.mean([fit.linear_error for fit in inner]) > 0.1 * clean.linear


def test_simulation_is_the_better_fit() -> None:
    """Why the extinction curve is only the start: its coefficients are 2 to 4 % off on a clean record."""
    record = decay(0.03, 0.3)
    curve, fit = fit_extinction_curve(*record), fit_roll_decay(*record)
    assert 0.01 < abs(curve.quadratic / 0.3 - 1.0) < 0.1
    assert abs(fit.quadratic / 0.3 - 1.0) < 1e-4


def test_terms_and_equivalent_ratio_agree() -> None:
    """b_eq/(2 √(I C)) of the terms, in regular rolling of 10 degrees at the natural period."""
    fit = RollDecay(9.0, 0.04, 0.3, 0.0, 0.0, 0.0, 10, 0.0, 0.0, 0.0)
    inertia, amplitude = 1.3e8, np.deg2rad(10.0)
    terms = fit.terms(inertia)
    assert terms == RollDampingTerms(0.04 * inertia, 0.3 * inertia, 0.0)
    critical = 2.0 * inertia * FREQUENCY
    expected = terms.equivalent(FREQUENCY * amplitude) / critical
    assert fit.equivalent_damping_ratio(amplitude) == pytest.approx(expected, rel=1e-12)


TIME, ROLL = decay(0.03, 0.3)


@pytest.mark.parametrize(
    ("time", "roll", "words"),
    [
        (TIME[:90], ROLL[:90], "too few extremes"),
        (TIME, RELEASE * np.cos(FREQUENCY * TIME), "does not decay"),
        (TIME, ROLL[::-1], "does not decay"),
        (TIME, np.zeros(len(TIME)), "too few extremes"),
        (TIME, np.rad2deg(ROLL), "no angle in radians"),
        (TIME, np.where(np.arange(len(TIME)) == 50, np.nan, ROLL), r"roll .* not finite at sample 51 of"),
        (np.where(np.arange(len(TIME)) == 50, np.inf, TIME), ROLL, "time .* not finite at sample 51 of"),
        (np.where(np.arange(len(TIME)) == 50, TIME[49], TIME), ROLL, "do not increase at sample 51"),
        (TIME, ROLL + 0.1j, "not made of real numbers"),
        (TIME, np.append(np.rad2deg(ROLL[:-1]), np.nan), "not finite"),
        (TIME[::-1], ROLL, "do not increase"),
        (TIME[:-1], ROLL, "two equal rows"),
        (TIME[:5], ROLL[:5], "two equal rows"),
        (TIME, None, "not made of real numbers"),
        ("long", ROLL, "not made of real numbers"),
    ],
)
def test_refusals(time: FloatArray, roll: FloatArray, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        fit_roll_decay(time, roll)
