"""Memory kernels and convolution weights: closed forms, conservation, measured order, refusals."""

from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import simpson

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase, frequency_grid
from panelsim.hydro.memory import MemoryFunctions, convolution_weights, memory_functions
from panelsim.hydro.retardation import fourier_integral

# A kernel with closed transforms: R = a t exp(-bt), K = a (1 - bt) exp(-bt),
# B(ω) = 2 a b ω² / (b² + ω²)², A(ω) - A∞ = a (b² - ω²) / (b² + ω²)², and ∫R = a/b².
STRENGTH, DECAY = 3.0e6, 0.8
# Symmetric, with couplings, and positive definite: every element has its own sign and size.
SHAPE = (
    np.eye(6) + 0.3 * np.diag([1.0, -1.0, 0.5, 0.2, -0.7], 1) + 0.3 * np.diag([1.0, -1.0, 0.5, 0.2, -0.7], -1)
)
INFINITE = 4.0e6 * SHAPE


def closed_damping(omega: FloatArray) -> FloatArray:
    return 2 * STRENGTH * DECAY * omega**2 / (DECAY**2 + omega**2) ** 2


def closed_memory_part(omega: FloatArray) -> FloatArray:
    return STRENGTH * (DECAY**2 - omega**2) / (DECAY**2 + omega**2) ** 2


def database(damping_factor: float | FloatArray = 1.0, roughness: float = 0.0) -> HydroDatabase:
    """The closed form as a database of a ship of 120 m."""
    omega = frequency_grid(120.0)
    matrix = ("frequency", "influenced_dof", "radiating_dof")
    added_mass = INFINITE + closed_memory_part(omega)[:, None, None] * SHAPE
    damping = (closed_damping(omega) * damping_factor)[:, None, None] * SHAPE
    return HydroDatabase(
        xr.Dataset(
            {
                "added_mass": (matrix, added_mass),
                "radiation_damping": (matrix, damping),
                "added_mass_infinite": (matrix[1:], INFINITE),
            },
            coords={"frequency": omega, "influenced_dof": list(DOF_NAMES), "radiating_dof": list(DOF_NAMES)},
            attrs={"length": 120.0, "half_breadth": 7.0, "damping_roughness": roughness},
        )
    )


@pytest.fixture(scope="module")
def memory() -> MemoryFunctions:
    return memory_functions(database())


def test_kernels_are_those_of_the_closed_form(memory: MemoryFunctions) -> None:
    t = memory.time[:, None, None]
    momentum = STRENGTH * t * np.exp(-DECAY * t) * SHAPE
    retardation = STRENGTH * (1 - DECAY * t) * np.exp(-DECAY * t) * SHAPE
    # The tail beyond 2.6 rad/s is a fitted power law, here not yet ω⁻²: 1 % of the peak in R. In K, a
    # derivative, the same shows five times as large, at the very start.
    assert np.abs(memory.momentum_kernel - momentum).max() < 0.01 * np.abs(momentum).max()
    assert np.abs(memory.retardation - retardation)[10:].max() < 0.03 * np.abs(retardation).max()


def test_infinite_added_mass_follows_ogilvie(memory: MemoryFunctions) -> None:
    assert np.abs(memory.added_mass_infinite - INFINITE).max() < 0.01 * INFINITE.max()
    assert np.abs(memory.infinite_difference).max() < 0.01


def test_kernel_integral_is_the_difference_of_added_masses(memory: MemoryFunctions) -> None:
    """∫R = A(0) - A∞ and ∫K = 0, so that a steady velocity keeps a steady momentum."""
    integral = memory.spline.integrate(0.0, memory.memory_length)
    expected = database().added_mass_zero - memory.added_mass_infinite
    assert np.allclose(integral, expected, rtol=0.0, atol=1e-9 * expected.max())
    assert np.abs(memory.momentum_kernel[[0, -1]]).max() < 1e-9 * np.abs(memory.momentum_kernel).max()
    assert np.abs(memory.normalisation).max() < 0.01


def test_coefficients_made_again_from_the_kernel_are_within_one_percent(memory: MemoryFunctions) -> None:
    print("damping", memory.rebuilt_damping.max(), "added mass", memory.rebuilt_added_mass.max())
    assert memory.rebuilt_damping.max() < 0.01
    assert memory.rebuilt_added_mass.max() < 0.01


@pytest.mark.parametrize("newest_share", [1.0, 0.5])
def test_steady_velocity_leaves_a_steady_momentum_for_an_hour(
    memory: MemoryFunctions, newest_share: float
) -> None:
    weights = convolution_weights(memory, 0.2, 0.2 * newest_share)
    nu = np.array([1.0, -0.5, 0.2, 0.01, 0.02, -0.03])
    momentum = np.einsum("sij,j->i", weights.momentum, nu)
    rate = np.einsum("sij,j->i", weights.rate, nu)
    expected = (database().added_mass_zero - memory.added_mass_infinite) @ nu
    assert momentum == pytest.approx(expected, rel=1e-9)
    # An hour of what is left would move the momentum by less than a millionth.
    assert np.abs(rate).max() * 3600.0 < 1e-6 * np.abs(expected).max()


def integrated(memory: MemoryFunctions, weight: Callable[[FloatArray], FloatArray], order: int = 0) -> float:
    """∫ R or K (s) weight(s) ds, element (0, 0), by Simpson's rule on 200 steps a spline piece."""
    s = np.linspace(0.0, memory.memory_length, 200 * (len(memory.time) - 1) + 1)
    return float(simpson(memory.spline(s, order)[:, 0, 0] * weight(s), x=s))


@pytest.mark.parametrize("newest_share", [1.0, 0.5])
def test_weights_are_second_order_for_a_sinusoid(memory: MemoryFunctions, newest_share: float) -> None:
    omega, steps = 1.2, np.array([0.2, 0.1, 0.05])
    for name, order in (("momentum", 0), ("rate", 1)):
        exact = integrated(memory, lambda s: np.cos(omega * s), order)
        errors = []
        for step in steps:
            weights = convolution_weights(memory, step, step * newest_share)
            errors.append(abs(getattr(weights, name)[:, 0, 0] @ np.cos(omega * weights.age) - exact))
        measured = np.polyfit(np.log(steps), np.log(errors), 1)[0]
        print(name, "relative errors", np.array(errors) / abs(exact), "order", measured)
        assert measured == pytest.approx(2.0, abs=0.15)
        assert errors[0] < 0.01 * abs(exact)  # (ωΔt)²/12 = 0.5 % at 0.2 s


@pytest.mark.parametrize("newest_share", [1.0, 0.5])
def test_weights_reproduce_added_mass_and_damping(memory: MemoryFunctions, newest_share: float) -> None:
    weights = convolution_weights(memory, 0.2, 0.2 * newest_share)
    omega = frequency_grid(120.0)[1:]
    wave = np.exp(-1j * np.outer(omega, weights.age))
    complex_mass = np.einsum("fs,sij->fij", wave, weights.momentum)
    rate = np.einsum("fs,sij->fij", wave, weights.rate)
    stored = database()
    peak_a, peak_b = np.abs(stored.added_mass).max(), np.abs(stored.radiation_damping).max()
    added_mass = memory.added_mass_infinite + complex_mass.real
    # 3 % as in the self-check; the straight lines between samples add 2 % at 2.6 rad/s and 0.2 s.
    assert np.abs(added_mass - stored.added_mass[1:]).max() < 0.03 * peak_a
    assert (
        np.abs(-omega[:, None, None] * complex_mass.imag - stored.radiation_damping[1:]).max() < 0.03 * peak_b
    )
    assert np.abs(rate.real - stored.radiation_damping[1:]).max() < 0.03 * peak_b


def test_a_linear_velocity_is_convolved_exactly(memory: MemoryFunctions) -> None:
    """ν = s, its own interpolant: Σ w s = ∫ R s ds at any step, here also one that does not divide 32 s."""
    exact = integrated(memory, lambda s: s)
    for step, newest in ((0.2, 0.2), (0.2, 0.1), (0.37, 0.37)):
        weights = convolution_weights(memory, step, newest)
        # 1e-9: rounding, and Simpson's rule on cubics times s.
        assert weights.momentum[:, 0, 0] @ weights.age == pytest.approx(exact, rel=1e-9)


def test_one_history_serves_whole_and_half_steps(memory: MemoryFunctions) -> None:
    whole, half = convolution_weights(memory, 0.2), convolution_weights(memory, 0.2, 0.1)
    assert len(whole.age) == len(half.age)
    assert whole.age[1] == pytest.approx(0.2) and half.age[1] == pytest.approx(0.1)
    assert np.diff(half.age)[1:] == pytest.approx(0.2)


def test_memory_goes_with_the_root_of_length_or_beam(memory: MemoryFunctions) -> None:
    assert memory.memory_length == pytest.approx(32.0)
    stubby = database()
    stubby.dataset.attrs["half_breadth"] = 28.0
    assert memory_functions(stubby).memory_length == pytest.approx(64.0)


def test_ragged_damping_is_refused() -> None:
    ragged = np.ones(len(frequency_grid(120.0)))
    ragged[12] = 1.5
    with pytest.raises(PanelsimError, match="made again from the retardation functions are off") as refusal:
        memory_functions(database(ragged))
    assert "damping of heave from heave" in str(refusal.value) and "smaller panels" in str(refusal.value)
    with pytest.raises(PanelsimError, match="trapped between two hulls"):
        memory_functions(database(ragged, roughness=0.5))


def test_intervals_must_be_positive(memory: MemoryFunctions) -> None:
    for step, newest in ((0.0, 0.1), (0.2, -0.1)):
        with pytest.raises(PanelsimError, match="must be positive"):
            convolution_weights(memory, step, newest)


def test_fourier_integral_of_a_straight_line_is_exact() -> None:
    """∫₀² x exp(ixt) dx = (e^{2it}(1 - 2it) - 1)/t², with three samples and many oscillations."""
    t = np.array([0.0, 0.3, 7.0, 90.0])
    x = np.array([0.0, 0.4, 2.0])
    moving = t[1:]
    exact = (np.exp(2j * moving) * (1 - 2j * moving) - 1) / moving**2
    computed = fourier_integral(x, x, t)
    assert computed[0] == pytest.approx(2.0)
    assert computed[1:] == pytest.approx(exact, rel=1e-12)
