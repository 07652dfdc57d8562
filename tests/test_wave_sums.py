"""The compiled wave sums against their NumPy twin and against exact arithmetic."""

import subprocess
import sys
import tracemalloc
from fractions import Fraction

import numpy as np
import pytest

from panelsim.conventions import STRETCHINGS
from panelsim.errors import PanelsimError
from panelsim.kernels import wave_sums_oracle
from panelsim.kernels.phases import leading_part, turn_rates, turns
from panelsim.kernels.tables import WaveTables
from panelsim.kernels.wave_sums import wave_sums

# Of the sum of all amplitudes: the same M terms in another order, cos and exp exact to a few 1e-16.
AGREEMENT = 1e-12
LONG = 1e5  # s, a day and a night at sea
TWO_PI = Fraction("6.28318530717958647692528676655900576839433879875021")


def sea(count: int, *, second_order: bool = False) -> WaveTables:
    """Short-crested waves seen from a ship at 10 m/s, some of them overtaken."""
    random = np.random.default_rng(count)
    omega, heading = random.uniform(0.2, 2.0, count), random.uniform(0, 2 * np.pi, count)
    k = omega**2 / 9.80665
    kx, ky = k * np.cos(heading), -k * np.sin(heading)
    amplitude = 3.0 / max(count, 1) ** 0.5 * np.exp(-omega)
    phase = random.uniform(0, 2 * np.pi, count)
    return WaveTables(amplitude, kx, ky, k, omega - 10 * kx, phase, second_order=second_order)


def points(count: int, seed: int = 1) -> np.ndarray:
    """Points within 300 m, from 15 m deep to above the crests, up to a day later."""
    random = np.random.default_rng(seed)
    low, high = [-300, -300, -15, 0], [300, 300, 4, LONG]
    return random.uniform(low, high, (count, 4))


def coefficients(count: int, quantities: int, sines: bool) -> np.ndarray:
    random = np.random.default_rng(quantities)
    real, imaginary = random.uniform(-1, 1, (2, count, quantities))
    return real + 1j * imaginary * sines


def assert_agree(waves: WaveTables, at: np.ndarray, c: np.ndarray, stretching: str) -> None:
    elevation, sums = wave_sums(waves, at, c, stretching=stretching)
    expected, expected_sums = wave_sums_oracle.wave_sums(waves, at, c, stretching=stretching)
    assert elevation.shape == (len(at),) and sums.shape == (len(at), c.shape[1])
    # The second order is at most a²k/2 < a: within the same bound.
    np.testing.assert_allclose(elevation, expected, rtol=0, atol=AGREEMENT * waves.amplitude.sum())
    bound = AGREEMENT * np.abs(c).sum(axis=0, initial=0.0)
    assert (np.abs(sums - expected_sums) <= bound).all()
    np.testing.assert_array_equal(sums == 0.0, expected_sums == 0.0)


@pytest.mark.parametrize("stretching", STRETCHINGS)
@pytest.mark.parametrize(
    ("quantities", "sines"), [(0, False), (1, False), (1, True), (2, True), (3, False), (3, True)]
)
@pytest.mark.parametrize("count", [0, 1, 19, 160])
def test_kernel_agrees_with_its_twin(count: int, quantities: int, sines: bool, stretching: str) -> None:
    assert_agree(sea(count), points(203), coefficients(count, quantities, sines), stretching)


@pytest.mark.parametrize("stretching", STRETCHINGS)
def test_kernel_agrees_with_its_twin_on_a_stokes_wave(stretching: str) -> None:
    assert_agree(sea(1, second_order=True), points(203), coefficients(1, 3, True), stretching)


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9])
def test_any_number_of_points(count: int) -> None:
    assert_agree(sea(3), points(9)[:count], coefficients(3, 3, True), "wheeler")


def exact_turns(rate: float, coordinate: float) -> Fraction:
    return Fraction(rate) * Fraction(coordinate) / TWO_PI


def exact_phases(waves: WaveTables, at: np.ndarray) -> np.ndarray:
    """θ (P, M) within ±π, from rational arithmetic."""
    phases = np.empty((len(at), len(waves.amplitude)))
    for p, (x, y, _, t) in enumerate(at):
        for m in range(phases.shape[1]):
            turned = exact_turns(waves.wavenumber_x[m], x) + exact_turns(waves.wavenumber_y[m], y)
            turned -= exact_turns(waves.encounter_frequency[m], t) + exact_turns(waves.phase[m], 1.0)
            phases[p, m] = 2 * np.pi * float(turned - round(turned))
    return phases


@pytest.mark.parametrize("reach", [300.0, 1e6])
def test_phases_keep_their_digits_for_days_and_over_oceans(reach: float) -> None:
    """At t = 1e5 s, ω t in plain double precision is 2e-11 rad off; both sums stay within 1e-14."""
    waves, at = sea(12), points(40)
    at[:, :2] *= reach / 300.0
    at[:, 3] = np.random.default_rng(3).uniform(0.9 * LONG, LONG, len(at))
    phases, scale = exact_phases(waves, at), waves.amplitude.sum()
    expected = np.cos(phases) @ waves.amplitude
    for method in (wave_sums, wave_sums_oracle.wave_sums):
        got = method(waves, at, np.empty((12, 0), complex), stretching="none")[0]
        # Rounding of the last sum of three parts of a turn each, about 1e-15 rad a wave.
        np.testing.assert_allclose(got, expected, rtol=0, atol=1e-14 * scale)
    x, y, _, t = at.T[:, :, None]
    plain = x * waves.wavenumber_x + y * waves.wavenumber_y - t * waves.encounter_frequency - waves.phase
    assert np.abs(np.cos(plain) @ waves.amplitude - expected).max() > AGREEMENT * scale


def test_sums_against_exact_phases() -> None:
    """Re Σ c e^(−iθ) e^(k(z−ζ)) spelled out: what both the kernel and the twin must give."""
    waves, at, c = sea(6), points(60), coefficients(6, 3, True)
    theta = exact_phases(waves, at)
    zeta = np.cos(theta) @ waves.amplitude
    wet = at[:, 2] <= zeta
    assert 10 < wet.sum() < 60
    depths = {"wheeler": at[:, 2] - zeta, "none": np.minimum(at[:, 2], 0.0)}
    for stretching, depth in depths.items():
        wave = np.exp(-1j * theta + waves.wavenumber * np.minimum(depth, 0.0)[:, None])
        expected = np.where(wet[:, None], (wave @ c).real, 0.0)
        for method in (wave_sums, wave_sums_oracle.wave_sums):
            got = method(waves, at, c, stretching=stretching)[1]
            np.testing.assert_allclose(got, expected, rtol=0, atol=1e-13 * np.abs(c).sum())


def test_the_second_order_lifts_crests_and_fills_troughs() -> None:
    """½ a² k cos 2θ is +½ a² k at crest and trough; the decay below takes the whole elevation."""
    a, k = 4.0, 0.1
    wave = WaveTables(*np.array([[a], [k], [0.0], [k], [1.0], [0.0]]), second_order=True)
    at = np.array([[0.0, 0.0, -5.0, 0.0], [np.pi / k, 0.0, -5.0, 0.0]])
    for method in (wave_sums, wave_sums_oracle.wave_sums):
        elevation, sums = method(wave, at, np.ones((1, 1), complex), stretching="wheeler")
        np.testing.assert_allclose(elevation, [4.8, -3.2], rtol=1e-14)
        np.testing.assert_allclose(sums[:, 0], [np.exp(-0.98), -np.exp(-0.18)], rtol=1e-14)


def test_same_bits_alone_or_among_others() -> None:
    waves, at, c = sea(19), points(100), coefficients(19, 3, True)
    for method in (wave_sums, wave_sums_oracle.wave_sums):
        together = method(waves, at, c, stretching="wheeler")
        alone = [method(waves, at[i : i + 1], c, stretching="wheeler") for i in range(len(at))]
        np.testing.assert_array_equal(together[0], np.concatenate([one[0] for one in alone]))
        np.testing.assert_array_equal(together[1], np.concatenate([one[1] for one in alone]))


def test_the_twin_works_in_chunks_without_a_seam(monkeypatch: pytest.MonkeyPatch) -> None:
    waves, at, c = sea(19), points(100), coefficients(19, 1, True)
    whole = wave_sums_oracle.wave_sums(waves, at, c, stretching="wheeler")
    monkeypatch.setattr(wave_sums_oracle, "CHUNK", 19 * 7)
    pieces = wave_sums_oracle.wave_sums(waves, at, c, stretching="wheeler")
    for one, other in zip(whole, pieces, strict=True):
        np.testing.assert_array_equal(one, other)


def test_nothing_of_the_size_points_times_waves_is_kept() -> None:
    """A matrix of 1e5 points and 160 waves takes 128 MB; ten columns of the points take 8."""
    waves, at, c = sea(160), points(100_000), coefficients(160, 1, False)
    wave_sums(waves, at[:8], c, stretching="wheeler")
    tracemalloc.start()
    wave_sums(waves, at, c, stretching="wheeler")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 20e6


def test_other_seas_and_quantities_do_not_compile_the_kernel_again() -> None:
    from taichi.lang import impl

    wave_sums(sea(1), points(3), coefficients(1, 1, False), stretching="none")
    compiled = impl.get_runtime().get_num_compiled_functions()
    for stretching in STRETCHINGS:
        for quantities in (0, 3):
            wave_sums(sea(37), points(50), coefficients(37, quantities, True), stretching=stretching)
    assert impl.get_runtime().get_num_compiled_functions() == compiled


def test_input_is_left_alone() -> None:
    waves, at, c = sea(5), points(20), coefficients(5, 3, True)
    before = [array.copy() for array in (waves.amplitude, waves.phase, at, c)]
    wave_sums(waves, at, c, stretching="wheeler")
    for array, old in zip((waves.amplitude, waves.phase, at, c), before, strict=True):
        np.testing.assert_array_equal(array, old)


def test_ripples_in_the_deep_stay_finite() -> None:
    """exp(−k d) of a ripple of 1 mm at 90 m and at 1e6 m: no overflow, no trace."""
    k = 2 * np.pi / 1e-3
    ripple = WaveTables(*np.array([[1e-5], [k], [0.0], [k], [200.0], [0.0]]))
    at = np.array([[1.0, 2.0, -90.0, 10.0], [1.0, 2.0, -1e6, 10.0]])
    for method in (wave_sums, wave_sums_oracle.wave_sums):
        assert (np.abs(method(ripple, at, np.ones((1, 1), complex), stretching="wheeler")[1]) < 1e-300).all()


def test_rates_in_two_parts() -> None:
    """26 bits first, so that products with 26 bits are exact; with the rest within 2^-77 of the true rate."""
    rates = np.random.default_rng(5).uniform(-7, 7, 200)
    leading, rest = turn_rates(rates)
    for rate, part, small in zip(rates, leading, rest, strict=True):
        assert Fraction(part).numerator.bit_length() <= 26
        exact = Fraction(rate) / TWO_PI
        # The rest is 2^-26 of the rate and rounded to 53 bits: 2^-79.
        assert abs(Fraction(part) + Fraction(small) - exact) < Fraction(2) ** -77 * abs(exact)
    np.testing.assert_array_equal(leading_part(leading), leading)


def test_whole_turns_are_dropped() -> None:
    assert np.abs(turns(np.array([[1e5], [-3e6]]), np.array([0.7, -2.0]))).max() < 0.51
    np.testing.assert_allclose(turns(1.0, np.array([0.25, 10.5]) * 2 * np.pi), [0.25, 0.5], atol=1e-14)


def test_an_unknown_stretching_is_refused() -> None:
    with pytest.raises(PanelsimError, match="airy"):
        wave_sums(sea(1), points(3), coefficients(1, 1, False), stretching="airy")


def test_views_and_the_twin_leave_taichi_alone_until_there_is_much_to_sum() -> None:
    script = """
import sys
import numpy as np
from panelsim.seaway.regular import RegularSeaway
sea = RegularSeaway(1.0, 0.5, 0.3).in_translating_axes(5.0)
sea.pressure(np.zeros(1000), 0.0, -1.0, 2.0, water_density=1000.0)
print("taichi" in sys.modules)
sea.elevation(np.zeros(300_000), 0.0, 2.0)
print("taichi" in sys.modules)
"""
    finished = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False
    )
    assert finished.stdout.split() == ["False", "True"], finished.stderr
