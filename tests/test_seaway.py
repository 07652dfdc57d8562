"""Components of seaways."""

import numpy as np
import pytest

from panelsim.conventions import KNOT, STANDARD_GRAVITY
from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.repeat import repeat_time
from panelsim.seaway.spectra.bretschneider import Bretschneider

GRID = 0.1 * np.arange(2, 21)
SPEED = 20 * KNOT


def report_sea(heading_deg: float = 150.0, seed: int = 1001) -> RandomSeaway:
    """The sea of TM 2003-190 section 8.4."""
    return RandomSeaway(Bretschneider(7.5, 15.0), GRID, np.deg2rad(heading_deg), seed)


def test_breaking_waves_are_refused() -> None:
    with pytest.raises(PanelsimError, match="steeper"):
        RegularSeaway(5.0, 1.0, 0.0)
    RegularSeaway(4.3, 1.0, 0.0)  # H/λ = 0.1396: just possible


def test_components_of_the_report() -> None:
    """19 components with seeded phases, amplitudes (33), 99.8 % of the energy."""
    sea = report_sea()
    c = sea.components
    assert c.count == 19
    np.testing.assert_array_equal(c.phase, np.random.default_rng(1001).uniform(0, 2 * np.pi, 19))
    np.testing.assert_allclose(c.amplitude, np.sqrt(2 * sea.spectrum.density(GRID) * 0.1), rtol=1e-12)
    assert 0.99 < sea.energy_share < 1.0
    # A 0.1 rad/s grid of this narrow spectrum holds its variance to 1 %.
    assert 4 * np.sqrt(c.variance) == pytest.approx(7.5, rel=0.01)


def test_frequencies_that_miss_the_energy_are_refused() -> None:
    with pytest.raises(PanelsimError, match="too little") as refusal:
        RandomSeaway(Bretschneider(7.5, 15.0), GRID[10:], 0.0, 1)
    assert "90.0 %" in str(refusal.value)


@pytest.mark.parametrize("frequencies", [[0.2, 2.0], [0.2, 0.25, 2.0], [0.2, 0.42, 2.0]])
def test_frequencies_too_far_apart_to_carry_the_energy_are_refused(frequencies: list[float]) -> None:
    """Their bands span 99 % of the spectrum, but √(2 S Δω) at so few points is another sea."""
    with pytest.raises(PanelsimError, match="too far apart"):
        RandomSeaway(Bretschneider(7.5, 15.0), np.array(frequencies), 0.0, 1)


def test_encounter_frequency_keeps_its_sign() -> None:
    """A wave of 1.5 rad/s from astern is overtaken at 20 knots: ω_e = 1.5 − U·1.5²/g < 0."""
    c = WaveComponents(np.ones(2), np.array([0.5, 1.5]), np.zeros(2), np.zeros(2))
    expected = c.frequency - SPEED * c.frequency**2 / STANDARD_GRAVITY
    np.testing.assert_allclose(c.encounter_frequency(SPEED), expected, rtol=1e-14)
    assert expected[1] < 0 < expected[0]


def test_the_report_grid_repeats_after_346_seconds() -> None:
    """ω_e = 0.1 n + c n² with c = 0.01 U cos 30°/g returns where 2 c T = 2π: T = 345.8 s.

    At 150° the linear part happens to return there as well.
    """
    again = repeat_time(report_sea().components, SPEED, 1860.0)
    assert again == pytest.approx(345.8, abs=0.5)  # the peak lies where the linear part returns best
    uneven = GRID + np.random.default_rng(0).uniform(-0.04, 0.04, len(GRID))
    jittered = RandomSeaway(Bretschneider(7.5, 15.0), np.sort(uneven), np.deg2rad(150), 1)
    assert repeat_time(jittered.components, SPEED, 1860.0) is None
    assert repeat_time(RegularSeaway(1.0, 0.5, 0.0).components, SPEED, 1860.0) is None


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (lambda: RegularSeaway(0.0, 0.5, 0.0), "wave_amplitude"),
        (lambda: RegularSeaway(1.0, 0.5, 150), "radians"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, "head", 1), "radians"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, 0.0, -1), "seed"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, 0.0, 1.5), "seed"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), GRID, 0.0, 1, float("nan")), "minimum_energy"),
        (lambda: RandomSeaway(Bretschneider(7.5, 15), [0.2, np.nan], 0.0, 1), "rise"),
        (lambda: WaveComponents(np.ones(2), np.ones(3), np.zeros(2), np.zeros(2)), "one length"),
        (lambda: RandomSeaway(Bretschneider(1, 10), GRID[::-1], 0.0, 1), "rise"),
        (lambda: WaveComponents(np.ones(2), np.array([1.0, np.nan]), np.zeros(2), np.zeros(2)), "frequency"),
        (lambda: WaveComponents(np.ones(2), np.array([1.0, -1.0]), np.zeros(2), np.zeros(2)), "not positive"),
    ],
)
def test_bad_input_is_refused(bad: object, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        bad()  # type: ignore[operator]
