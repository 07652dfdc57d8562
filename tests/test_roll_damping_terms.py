"""Roll damping as a polynomial of the roll rate, and its linear equivalents."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.terms import RollDampingTerms

TERMS = RollDampingTerms(linear=2.0, quadratic=3.0, cubic=5.0)


def test_the_moment_is_against_the_rate() -> None:
    """-(2 p + 3 p|p| + 5 p³) at p = 2 is -(4 + 12 + 40)."""
    np.testing.assert_allclose(TERMS.moment([2.0, 0.0, -2.0]), [-56.0, 0.0, 56.0], rtol=1e-15)


@pytest.mark.parametrize("terms", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (2.0, 3.0, 5.0)])
def test_equivalent_damping_takes_the_same_energy_a_cycle(terms: tuple[float, float, float]) -> None:
    """∮ M dφ by quadrature over a cycle, against -π b_eq p_a²/ω."""
    damping = RollDampingTerms(*terms)
    peak, frequency = 0.3, 0.7
    phase = 2.0 * np.pi * (np.arange(4000) + 0.5) / 4000
    rate = peak * np.cos(phase)
    lost = -np.mean(damping.moment(rate) * rate) * 2.0 * np.pi / frequency
    # The midpoint rule meets the kink of p|p| with an error of its step squared: 1e-6.
    assert np.pi * damping.equivalent(peak) * peak**2 / frequency == pytest.approx(lost, rel=1e-5)


@pytest.mark.parametrize("terms", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)])
def test_gaussian_equivalent_against_sampling(terms: tuple[float, float, float]) -> None:
    """The least-squares line through M(p) for Gaussian p has the slope -E[M p]/E[p²]."""
    damping = RollDampingTerms(*terms)
    rate = 0.2 * np.random.default_rng(5).standard_normal(1_000_000)
    slope = -np.mean(damping.moment(rate) * rate) / np.mean(rate**2)
    # Relative scatter of the ratio at a million samples: 0.2 % for the cubic term, less for the others.
    assert damping.equivalent_gaussian(0.2) == pytest.approx(slope, rel=0.01)


@settings(deadline=None, max_examples=30)
@given(st.tuples(*[st.floats(0.0, 10.0)] * 3), st.floats(0.2, 2.0))
def test_the_fit_returns_the_terms_that_made_the_curve(
    terms: tuple[float, float, float], frequency: float
) -> None:
    amplitude = np.deg2rad([2.0, 5.0, 10.0, 20.0, 30.0])
    damping = RollDampingTerms(*terms).equivalent(frequency * amplitude)
    again = RollDampingTerms.fitted(amplitude, damping, frequency)
    # Terms of 0 come back at round-off of the curve, magnified by the condition of the columns.
    np.testing.assert_allclose(again.equivalent(frequency * amplitude), damping, rtol=1e-9, atol=1e-9)


def test_the_fit_has_no_negative_term() -> None:
    """Damping that falls with amplitude would need one: the linear term alone comes nearest."""
    terms = RollDampingTerms.fitted([0.1, 0.2, 0.3], [3.0, 2.0, 1.0], 1.0)
    assert (terms.linear, terms.quadratic, terms.cubic) == pytest.approx((2.0, 0.0, 0.0))


def test_percent_of_critical() -> None:
    """5 % of 2 √(I C): a decay of that damping loses a factor exp(-2π ζ/√(1-ζ²)) a cycle."""
    terms = RollDampingTerms.of_critical(0.05, inertia=4.0e7, stiffness=1.0e7)
    assert (terms.linear, terms.quadratic, terms.cubic) == pytest.approx((2.0e6, 0.0, 0.0))
    roots = np.roots([4.0e7, terms.linear, 1.0e7])
    assert -roots[0].real / abs(roots[0]) == pytest.approx(0.05, rel=1e-12)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: RollDampingTerms(linear=-1.0), r"linear roll damping is out of range(.|\n)*negative term"),
        (lambda: RollDampingTerms(cubic=np.inf), r"a finite number, 0 or more \[N m s3\]$"),
        (lambda: RollDampingTerms(cubic=np.nan), "cubic roll damping is out of range"),
        (lambda: RollDampingTerms.of_critical(5.0, 1.0, 1.0), "5 % is 0.05"),
        (lambda: RollDampingTerms.of_critical(0.05, 0.0, 1.0), "roll inertia is not positive"),
        (lambda: TERMS.equivalent(-0.1), "roll rate is negative"),
        (lambda: TERMS.equivalent("fast"), "roll rate is not made of real numbers"),
        (lambda: TERMS.equivalent_gaussian(np.inf), "roll rate is negative or not finite"),
        (lambda: RollDampingTerms.fitted([5.0, 10.0, 20.0], [1.0, 2.0, 3.0], 1.0), "no angle in radians"),
        (lambda: RollDampingTerms.fitted([0.1, 0.1, 0.2], [1.0, 1.0, 2.0], 1.0), "three different"),
        (lambda: RollDampingTerms.fitted([0.1, 0.2, 0.3], [1.0, -1.0, 2.0], 1.0), "cannot be fitted"),
    ],
)
def test_refusals(call: object, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        call()  # type: ignore[operator]
