"""What every spreading function keeps: area 1, symmetry, the period of the circle, its mean cosine."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import CosineHalfAngle, CosinePower, CosineSquared, Spreading
from panelsim.seaway.frequencies import EvenFrequencies, JitteredFrequencies
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider

SPREADINGS = st.one_of(
    st.floats(0.02, np.pi).map(CosineSquared),
    st.floats(0.2, 500.0).map(CosinePower),
    st.floats(0.2, 1000.0).map(CosineHalfAngle),
)
ANGLES = st.floats(-2 * np.pi, 2 * np.pi)
SPECTRUM = Bretschneider(4.0, 10.0)


def integral(spreading: Spreading, cosine: bool) -> float:
    """∫ G dν or ∫ G cos ν dν over the circle, split where a narrow function ends."""
    edges = np.unique([0.0, *np.minimum([0.03, 0.1, 0.3, 1.0, np.pi], spreading.half_width)])
    return 2 * sum(
        quad(lambda v: spreading.density(v) * (np.cos(v) if cosine else 1.0), a, b, limit=200)[0]
        for a, b in pairwise(edges)
    )


@settings(deadline=None, max_examples=60)
@given(SPREADINGS)
def test_area_is_one_and_the_mean_cosine_is_its_closed_form(spreading: Spreading) -> None:
    # quad's own tolerance, 1.5e-8 a piece, where a power below 1 ends with a vertical slope.
    assert integral(spreading, cosine=False) == pytest.approx(1.0, abs=1e-7)
    assert integral(spreading, cosine=True) == pytest.approx(spreading.mean_cosine, abs=1e-7)


@settings(deadline=None, max_examples=60)
@given(SPREADINGS, st.floats(-np.pi, np.pi))
@example(CosineHalfAngle(0.25), np.pi)
@example(CosinePower(0.2), 0.5 * np.pi)
def test_symmetric_periodic_and_zero_outside(spreading: Spreading, offset: float) -> None:
    density = spreading.density(offset)
    scale = spreading.density(0.0)
    # Rounding of the angle, steepened by powers up to 2000.
    assert spreading.density(-offset) == pytest.approx(density, abs=1e-12 * scale)
    for turns in (-2, -1, 1, 2):
        assert spreading.density(offset + 2 * np.pi * turns) == pytest.approx(density, abs=1e-11 * scale)
    assert 0.0 <= density <= scale
    if abs(offset) > spreading.half_width:
        assert density == 0.0


@pytest.mark.parametrize("spreading", [CosineHalfAngle(0.25), CosinePower(0.2), CosineSquared(np.pi)])
def test_nothing_comes_from_the_end_of_the_spread(spreading: Spreading) -> None:
    ends = spreading.half_width * np.array([-1.0, 1.0])
    # cos² keeps the square of a rounding.
    assert spreading.density(ends) == pytest.approx(0.0, abs=1e-30)
    assert (spreading.density(0.999 * ends) > 0.0).all()


@settings(deadline=None, max_examples=40)
@given(SPREADINGS, ANGLES, st.floats(-np.pi, np.pi))
def test_turning_the_sea_turns_its_density(spreading: Spreading, mean: float, offset: float) -> None:
    spectrum = SpreadSpectrum(SPECTRUM, spreading, mean)
    expected = SPECTRUM.density(0.7) * spreading.density(offset)
    direction = np.remainder(mean + offset, 2 * np.pi)
    scale = SPECTRUM.density(0.7) * spreading.density(0.0)
    assert spectrum.density(0.7, direction) == pytest.approx(expected, abs=1e-11 * scale)


@settings(deadline=None, max_examples=25)
@given(
    st.floats(-np.pi, np.pi),
    st.floats(-np.pi, np.pi),
    st.integers(0, 2**32),
    st.sampled_from([EvenFrequencies(0.3, 2.5, 0.1), JitteredFrequencies(0.3, 2.5, 0.1)]),
)
def test_a_short_crested_sea_keeps_energy_and_mean_heading(
    heading: float, course: float, seed: int, frequencies: EvenFrequencies | JitteredFrequencies
) -> None:
    """cos² on a grid that divides its 180° has area 1 exactly, and its energy is centred on the mean heading.

    Jittered, each direction carries a slightly different energy, and the centre moves by some degrees.
    """
    sea = RandomSeaway(
        SPECTRUM,
        frequencies,
        heading,
        seed,
        ship_heading=course,
        spreading=CosineSquared(),
        direction_step=np.deg2rad(20),
        drop_below=1e-6,
    )
    c = sea.components
    assert c.variance == pytest.approx(sea.carried * SPECTRUM.moment(0), rel=1e-12)
    centre = np.sum(c.amplitude**2 * np.exp(1j * (c.wave_heading - heading)))
    jittered = isinstance(frequencies, JitteredFrequencies)
    assert abs(np.angle(centre)) < (np.deg2rad(5) if jittered else 1e-12)
    # What the step of 0.1 rad/s leaves: 0.03 %, or with jitter some per cent.
    assert sea.carried == pytest.approx(sea.energy_share, rel=0.05 if jittered else 1e-3)
