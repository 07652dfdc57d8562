"""Each known mistake, made on purpose, fails a comparison that the right code passes.

The comparison is the linear run in three small waves at 20 knots against the frequency domain,
[−ω_e² M + iω_e B_s + C + C_s + (iω_e − Lᵀ)(A + B/iω_e)(iω_e + L)] η = F_FK + (−iω_e + Lᵀ) P_d, with every
term of it put together here. Errors are shares of each mode's largest response among the six waves.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

import panelsim.hydro.diffraction
import panelsim.loads.radiation
import panelsim.loads.wetted_surface
import panelsim.motion.batch
import panelsim.motion.run_loads
import panelsim.seaway.components
from panelsim.conventions import DOF_NAMES, KNOT, ComplexArray, Dof, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_momentum
from panelsim.hydro.memory import MemoryFunctions, memory_functions
from panelsim.hydro.memory_states import memory_states
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.radiation import Radiation
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.ship.ship import Ship

Run = Callable[..., History]

SPEED = 20 * KNOT
AMPLITUDE = 0.01  # m
TOLERANCE = 0.02  # of the right code, at dt 0.2 s
CLEAR = 5 * TOLERANCE  # what a mistake must exceed
# Waves whose encounter frequencies a record of 240 s tells apart; at 30° 1.2 rad/s is overtaken.
WAVES = {150: np.array([0.35, 0.6, 0.8]), 30: np.array([0.35, 0.9, 1.2])}
# Those of TM 2003-190 section 8, with the yaw damped so that its transient dies within the run.
SPRINGS = Supplementary(
    stiffness={"surge": 5e5, "sway": 1e6, "yaw": 2e9},
    damping={"surge": 1e6, "sway": 2e6, "roll": 2e7, "yaw": 2e9},
)


def components(heading_deg: int) -> WaveComponents:
    return WaveComponents(
        np.full(3, AMPLITUDE), WAVES[heading_deg], np.array([np.deg2rad(heading_deg)]), np.zeros(1)
    )


def stream(speed: float) -> FloatArray:
    """L: ν3 = η̇3 + U η5, ν2 = η̇2 − U η6."""
    coupling = np.zeros((6, 6))
    coupling[2, 4], coupling[1, 5] = speed, -speed
    return coupling


@pytest.fixture(scope="module")
def expected(halifax: Ship, halifax_database: HydroDatabase) -> dict[int, ComplexArray]:
    """Complex motions (3, 6) per unit amplitude for each heading, in the frequency domain."""
    data, unit, coupling = halifax_database, np.eye(6), stream(SPEED)
    restoring = halifax.hydrostatics.stiffness + SPRINGS.stiffness_matrix
    found = {}
    for heading_deg, omegas in WAVES.items():
        beta = np.full(3, np.deg2rad(heading_deg))
        momentum = diffraction_momentum(data, omegas, beta, SPEED)
        incident = froude_krylov_transfer(halifax, components(heading_deg))
        motions = []
        for m, w in enumerate(omegas - SPEED * omegas**2 / halifax.gravity * np.cos(beta)):
            a, b = (
                PchipInterpolator(data.frequencies, c)(abs(w))
                for c in (data.added_mass, data.radiation_damping)
            )
            radiation = (1j * w * unit - coupling.T) @ (a + b / (1j * w)) @ (1j * w * unit + coupling)
            impedance = -(w**2) * halifax.inertia + 1j * w * SPRINGS.damping_matrix + restoring + radiation
            scattered = (-1j * w * unit + coupling.T) @ momentum[m]
            motions.append(np.linalg.solve(impedance, incident[m] + scattered))
        found[heading_deg] = np.array(motions)
    return found


@pytest.fixture
def errors(
    run_halifax: Run, halifax: Ship, expected: dict[int, ComplexArray]
) -> Callable[[], dict[int, FloatArray]]:
    """A function that runs the ship and gives errors (3 waves, 6 modes) for each heading."""
    scale = np.abs(np.concatenate(list(expected.values()))).max(axis=0)

    def measure() -> dict[int, FloatArray]:
        found = {}
        for heading_deg, omegas in WAVES.items():
            history = run_halifax(
                components(heading_deg),
                speed=SPEED,
                ramp=60.0,
                duration=380.0,
                model="linear",
                supplementary=SPRINGS,
            )
            if history.outcome != "finished":
                found[heading_deg] = np.full((3, 6), np.inf)
                continue
            last = history.time >= 200.0
            w = omegas - SPEED * omegas**2 / halifax.gravity * np.cos(np.deg2rad(heading_deg))
            turn = np.outer(history.time[last], w)
            basis = np.hstack([np.cos(turn), -np.sin(turn), np.ones((len(turn), 1))])
            fit = np.linalg.lstsq(basis, history.displacement[last], rcond=None)[0] / AMPLITUDE
            found[heading_deg] = np.abs(fit[:3] + 1j * fit[3:6] - expected[heading_deg]) / scale
            worst = zip(DOF_NAMES, 100 * found[heading_deg].max(axis=0), strict=True)
            print(f"{heading_deg}°, % of the peak:", " ".join(f"{name} {e:.1f}" for name, e in worst))
        return found

    return measure


Errors = Callable[[], dict[int, FloatArray]]


def test_the_right_code_passes(errors: Errors) -> None:
    for found in errors().values():
        assert found.max() < TOLERANCE


def test_diffraction_without_its_convected_momentum_fails(
    errors: Errors, monkeypatch: pytest.MonkeyPatch
) -> None:
    """F_dif = −Ṗ_d alone, as if at zero speed: pitch in quartering and roll in bow seas are far off."""

    def without_lt(
        database: HydroDatabase, frequency: FloatArray, wave_heading: FloatArray, speed: float, transom: None
    ) -> ComplexArray:
        momentum = diffraction_momentum(database, frequency, wave_heading, speed)
        encounter = encounter_frequency(frequency, wave_heading, speed, database.gravity)
        return -1j * encounter[:, None] * momentum

    monkeypatch.setattr(panelsim.motion.run_loads, "diffraction_load", without_lt)
    found = errors()
    assert found[30][:, Dof.PITCH].max() > CLEAR
    assert found[150][:, Dof.ROLL].max() > CLEAR


def test_radiation_without_speed_terms_fails(errors: Errors, monkeypatch: pytest.MonkeyPatch) -> None:
    """Zero-speed radiation with diffraction at speed: roll and pitch are far off."""
    monkeypatch.setattr(panelsim.loads.radiation, "speed_coupling", lambda speed: np.zeros((1, 6, 6)))
    found = errors()
    assert found[150][:, Dof.ROLL].max() > CLEAR
    assert found[150][:, Dof.PITCH].max() > CLEAR


def test_radiation_without_its_transposed_coupling_fails(
    errors: Errors, monkeypatch: pytest.MonkeyPatch
) -> None:
    """ν = η̇ + L η but F = −Ṗ, the form that some codes stop at."""

    class WithoutTransposed(Radiation):
        def _load_matrix(self, coupling):
            momentum = np.hstack([self.added_mass_infinite @ coupling, self.added_mass_infinite])
            momentum = np.hstack([momentum, self.states.momentum])
            return super()._load_matrix(coupling) - coupling.T @ momentum

    monkeypatch.setattr(panelsim.motion.batch, "Radiation", WithoutTransposed)
    assert errors()[150][:, Dof.PITCH].max() > CLEAR


def test_the_modulus_of_the_encounter_frequency_fails(
    errors: Errors, monkeypatch: pytest.MonkeyPatch
) -> None:
    """TM 2003-190 (11) as printed: the overtaken wave of 1.2 rad/s at 30° runs the wrong way."""

    def modulus(frequency, wave_heading, speed, gravity=9.80665):
        return np.abs(encounter_frequency(frequency, wave_heading, speed, gravity))

    monkeypatch.setattr(panelsim.hydro.diffraction, "encounter_frequency", modulus)
    monkeypatch.setattr(panelsim.seaway.components, "encounter_frequency", modulus)
    found = errors()
    assert found[150].max() < TOLERANCE  # no wave is overtaken there
    assert found[30][:2].max() < TOLERANCE
    assert found[30][2].max() > CLEAR


def cut_memory(database: HydroDatabase, length: float) -> MemoryFunctions:
    """Memory functions whose K is simply cut off at a time [s], so that ∫K = R(length), not 0."""
    whole = memory_functions(database)
    kept = whole.time <= length
    return replace(whole, time=whole.time[kept], momentum_kernel=whole.momentum_kernel[kept])


def test_a_memory_that_fades_too_fast_fails(errors: Errors, monkeypatch: pytest.MonkeyPatch) -> None:
    """R times exp(−t/3 s): heave, roll and pitch in bow, sway and yaw in quartering seas."""

    def faded(database: HydroDatabase) -> MemoryFunctions:
        whole = memory_functions(database)
        fade = np.exp(-whole.time / 3.0)[:, None, None]
        return replace(whole, momentum_kernel=whole.momentum_kernel * fade)

    monkeypatch.setattr(HydroDatabase, "memory", property(faded))
    monkeypatch.setattr(HydroDatabase, "memory_states", property(lambda of: memory_states(of.memory)))
    assert max(found.max() for found in errors().values()) > CLEAR


def test_a_retardation_function_that_does_not_add_up_to_zero_drifts(
    halifax_database: HydroDatabase,
) -> None:
    """Cut at 10 s, a steady relative velocity meets a steady force, and K gathers momentum without end."""

    def momentum_gathered(functions: MemoryFunctions) -> float:
        """|∫Ṗ_m dt| over 500 s of steady sway velocity, in shares of (A(0) − A∞) ν."""
        added = halifax_database.added_mass_zero - functions.added_mass_infinite
        # ∫₀ᵗ K ν ds is R(t) ν; beyond the memory K is zero, and what is left of R stays.
        length = functions.memory_length
        gathered = functions.spline.integrate(0.0, length) + functions.spline(length) * (500.0 - length)
        gathered = gathered[Dof.SWAY, Dof.SWAY]
        return abs(gathered / added[Dof.SWAY, Dof.SWAY])

    right = momentum_gathered(memory_functions(halifax_database))
    drifting = momentum_gathered(cut_memory(halifax_database, 10.0))
    print(f"momentum after 500 s: {right:.3f} of A(0) − A∞, cut off at 10 s {drifting:.3f}")
    # Exact but for rounding.
    assert abs(right - 1.0) < TOLERANCE
    assert abs(drifting - 1.0) > CLEAR


def test_moments_left_in_ship_axes_yaw_a_rolling_ship(
    run_halifax: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Buoyancy has no moment about the vertical; with moments not made conjugate to the angles it has."""

    def yaw_share() -> float:
        history = run_halifax(duration=20.0, initial_displacement=(0, 0, 0, 0.35, 0.03, 0.2))
        wetted = history.loads["wetted_surface"]
        return float(np.abs(wetted[:, Dof.YAW]).max() / np.abs(wetted[:, Dof.ROLL]).max())

    right = yaw_share()
    monkeypatch.setattr(panelsim.loads.wetted_surface, "load_to_earth", lambda load, displacement: load)
    wrong = yaw_share()
    print(f"yaw moment of buoyancy over its roll moment: {right:.1e}, moments in ship axes {wrong:.2f}")
    assert right < 1e-10
    assert wrong > 0.1
