"""Each load by itself: signs, limits, and the linear loads as slopes of the nonlinear one."""

from dataclasses import replace

import numpy as np
import pytest

from panelsim.conventions import DOF_NAMES, KNOT, Dof, load_to_earth
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.memory import memory_functions
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.linear_waves import LinearWaveLoad
from panelsim.loads.load import Instant
from panelsim.loads.radiation import Radiation, speed_coupling
from panelsim.loads.restoring import Restoring
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.weight import Weight
from panelsim.loads.wetted_surface import WettedSurface, pressure_force
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

TWENTY_KNOTS = 20 * KNOT
LONG_WAVE = 0.203  # rad/s: 1500 m, twelve ship lengths


def instant(displacement: object = np.zeros(6), velocity: object = np.zeros(6), time: float = 0.0) -> Instant:
    """A single ship: a batch of one."""
    return Instant(time, 1.0, np.array(displacement, float)[None], np.array(velocity, float)[None])


def regular(omega: float, heading_deg: float, amplitude: float = 1.0, phase: float = 0.0) -> WaveComponents:
    return WaveComponents(
        np.array([amplitude]), np.array([omega]), np.array([np.deg2rad(heading_deg)]), np.array([phase])
    )


# --- radiation -----------------------------------------------------------------------------------


@pytest.mark.parametrize("dof", Dof, ids=DOF_NAMES)
def test_an_hour_of_steady_velocity_leaves_the_momentum_of_the_added_mass(
    dof: Dof, halifax_database: HydroDatabase
) -> None:
    """P_m stays at (A(0) − A∞) ν and its rate at 0, for each mode; a kernel with ∫K ≠ 0 drifts away."""
    functions = memory_functions(halifax_database)
    radiation = Radiation(halifax_database, [0.0], 0.2)
    steady = np.eye(6)[dof]
    memory = radiation.start(np.zeros((1, 6)), steady[None])
    found = []
    for _ in range(18000):
        memory = radiation.remember(memory, np.zeros((1, 6)), steady[None])
        past = radiation.past(memory, 0.0)
        found.append(past.fixed[0] + past.newest @ steady)
    momentum, rate = np.array(found)[:, :6], np.array(found)[:, 6:]
    expected = (halifax_database.added_mass_zero - functions.added_mass_infinite)[:, dof]
    error = np.abs(momentum[-1] - expected).max() / np.abs(expected).max()
    filled = int(functions.memory_length / 0.2) + 2
    drift = np.abs(momentum[filled:] - momentum[-1]).max() / np.abs(expected).max()
    print(f"{dof.name.lower()}: P_m {100 * error:.1e} % from (A(0) − A∞) ν, drift {drift:.1e}")
    # ∫R is set to A(0) − A∞ when it is made, so that only rounding is left of the 1 % allowed.
    assert error < 1e-9
    assert drift < 1e-12
    # The rate over the memory's 32 s would be as large as the momentum itself.
    assert np.abs(rate[filled:]).max() < 1e-10 * np.abs(expected).max()
    half = radiation.past(memory, 0.5)
    np.testing.assert_allclose((half.fixed[0] + half.newest @ steady)[:6], expected, rtol=0, atol=1e-9 * 1e9)


def test_a_ship_held_trimmed_at_speed_feels_munks_moments(halifax_database: HydroDatabase) -> None:
    """Held at a pitch or a yaw, C55 = −U² A33(0) and C66 = −U² A22(0), both turning it further."""
    radiation = Radiation(halifax_database, [TWENTY_KNOTS], 0.2)
    at_rest = np.zeros((1, 6))
    added = halifax_database.added_mass_zero
    for dof, across in ((Dof.PITCH, Dof.HEAVE), (Dof.YAW, Dof.SWAY)):
        displacement = 0.1 * np.eye(6)[[dof]]
        memory = radiation.start(displacement, at_rest)
        for _ in range(200):
            memory = radiation.remember(memory, displacement, at_rest)
        load = radiation.evaluate(radiation.past(memory, 0.0), displacement, at_rest)[0]
        # Exact for the kernel's ∫R, to rounding.
        assert load[dof] == pytest.approx(TWENTY_KNOTS**2 * added[across, across] * 0.1, rel=1e-9)
        # A steady momentum pushes on no translation.
        assert np.abs(load[:3]).max() < 1e-9 * abs(load[dof])


@pytest.mark.parametrize("speed", [0.0, TWENTY_KNOTS])
def test_a_steady_oscillation_gives_added_mass_and_damping(
    speed: float, halifax_database: HydroDatabase
) -> None:
    """F = −(iω − Lᵀ)(A + B/iω)(iω + L) η̂ of a sinusoid, at half steps as well: within 1 % at dt 0.2 s."""
    step, omega = 0.2, 2 * np.pi / 10.0
    radiation = Radiation(halifax_database, [speed], step)
    nearest = int(np.argmin(np.abs(halifax_database.frequencies - omega)))
    omega = float(halifax_database.frequencies[nearest])
    momentum = halifax_database.added_mass[nearest] + halifax_database.radiation_damping[nearest] / (
        1j * omega
    )
    coupling = speed_coupling(speed)
    transfer = -(1j * omega * np.eye(6) - coupling.T) @ momentum @ (1j * omega * np.eye(6) + coupling)
    scale = np.sqrt(np.outer(np.abs(np.diag(transfer)), np.abs(np.diag(transfer))))
    for dof in Dof:

        def state(time: float, dof: Dof = dof) -> tuple[np.ndarray, ...]:
            return tuple(
                ((1j * omega) ** n * np.exp(1j * omega * time)).real * np.eye(6)[[dof]] for n in range(3)
            )

        memory = radiation.start(*state(-300 * step)[:2])
        for n in range(-299, 1):
            memory = radiation.remember(memory, *state(n * step)[:2])
        for fraction in (0.0, 0.5, 1.0):
            displacement, velocity, acceleration = state(fraction * step)
            load = radiation.evaluate(radiation.past(memory, fraction), displacement, velocity)[0]
            load -= radiation.added_mass_infinite @ acceleration[0]
            expected = (transfer[:, dof] * np.exp(1j * omega * fraction * step)).real
            # The kernel gives the database back to 1 %; the hat weights add (ω dt)²/12 = 0.1 %.
            assert np.abs((load - expected) / scale[:, dof]).max() < 0.01


# --- waves ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("heading_deg", [0, 30, 90, 150, 180, 250])
@pytest.mark.parametrize("omega", [0.3, 0.8])
def test_linear_wave_load_is_the_slope_of_the_nonlinear_one(
    omega: float, heading_deg: float, halifax: Ship
) -> None:
    """Froude-Krylov transfer against the pressure kernel, crest and descent, to 1e-4 of the largest."""
    amplitude, speed = 1e-4, 7.0
    transfer = froude_krylov_transfer(halifax, regular(omega, heading_deg))[0]
    encounter = regular(omega, heading_deg).encounter_frequency(speed)[0]
    for turn in (0.0, 0.25):
        time = turn * 2 * np.pi / encounter
        up, down = (
            pressure_force(
                halifax,
                RegularSeaway(amplitude, omega, np.deg2rad(heading_deg), phase),
                time,
                np.zeros(6),
                speed=speed,
            )
            for phase in (0.0, np.pi)
        )
        slope = (up - down) / (2 * amplitude)
        expected = (transfer * np.exp(1j * encounter * time)).real
        for part in (slice(0, 3), slice(3, 6)):
            # The same rule over the same triangles; flare that changes at the waterline leaves 0.1 a.
            assert np.abs(slope - expected)[part].max() < 1e-4 * np.abs(transfer)[part].max()


def test_linear_wave_load_turns_with_the_phase_and_fades_with_the_ramp() -> None:
    """F = Re Σ a X exp(i(ω_e t + ε)): a wave that leads by ε is as far ahead in time."""
    transfer = np.array([[1.0, 1j, 2.0, 0.0, -1j, 3.0]])
    wave = regular(1.2, 30, amplitude=2.0, phase=0.4)
    load = LinearWaveLoad("test", [transfer], [wave], [20.0], gravity=10.0, follows_ship=False)
    encounter = 1.2 - 20.0 * 0.144 * np.cos(np.deg2rad(30))
    assert encounter < -1.0  # overtaken: the sign tells
    expected = (2.0 * transfer[0] * np.exp(1j * (encounter * 3.0 + 0.4))).real
    np.testing.assert_allclose(load.evaluate(instant(time=3.0))[0], expected, rtol=1e-13)
    half = replace(instant(time=3.0), wave_factor=0.5)
    np.testing.assert_allclose(load.evaluate(half)[0], 0.5 * expected, rtol=1e-13)
    moved = instant((5.0, -3.0, 0, 0, 0, 0), time=3.0)
    np.testing.assert_allclose(load.evaluate(moved)[0], expected, rtol=1e-13)


def test_a_linear_load_that_follows_the_ship_meets_the_waves_where_the_ship_is() -> None:
    """A ship that has moved by (η1, η2) feels the wave whose phase lead is less by k(η1 cos β − η2 sin β)."""
    transfer = np.array([[1.0, 1j, 2.0, 0.0, -1j, 3.0]])
    k, beta, surge, sway = 0.09, np.deg2rad(30), 5.0, -3.0
    shift = k * (surge * np.cos(beta) - sway * np.sin(beta))
    moved, other = (
        LinearWaveLoad("test", [transfer], [wave], [4.0], gravity=10.0, follows_ship=True)
        for wave in (regular(np.sqrt(0.9), 30, phase=lead) for lead in (0.4, 0.4 - shift))
    )
    np.testing.assert_allclose(
        moved.evaluate(instant((surge, sway, 0, 0, 0, 0), time=3.0)),
        other.evaluate(instant(time=3.0)),
        rtol=1e-13,
    )


@pytest.mark.parametrize("gravity", [9.80665, 4.9])
def test_incident_wave_on_a_box_in_any_gravity(gravity: float) -> None:
    """Heave load of a head wave on a box, ρ g B L exp(−kT) sin(kL/2)/(kL/2) cos(ω_e t), k = ω²/g.

    Half the gravity doubles k at the same frequency, and changes ω_e at speed.
    """
    ship = load_ship("box", 2.0, gravity=gravity)
    speed, omega, time = 5.0, 0.9, 7.0
    wave = regular(omega, 180, amplitude=1e-4)
    k = omega**2 / gravity
    half = k * ship.length / 2
    lift = ship.water_density * gravity * ship.beam * ship.length * np.exp(-k * ship.draft)
    expected = lift * np.sin(half) / half
    transfer = froude_krylov_transfer(ship, wave)[0, Dof.HEAVE]
    # Vertex and centre on panels of 1.5 m in waves of 76 and 38 m: 1e-7 and 1e-6, of fourth order in k h.
    assert transfer == pytest.approx(expected, rel=3e-6)
    encounter = omega + speed * k
    load = WettedSurface(ship, [wave], [speed])
    up, still = (load.evaluate(replace(instant(time=time), wave_factor=f))[0] for f in (1.0, 0.0))
    slope = (up - still)[Dof.HEAVE] / 1e-4
    # The second order of a wave of 0.1 mm over the draft of 2 m.
    assert slope == pytest.approx(expected * np.cos(encounter * time), abs=1e-4 * abs(expected))


def test_long_waves_lift_by_the_waterplane_and_push_the_mass_along(
    halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """In a beam wave of 12 L the incident wave lifts by C33 and pushes m, the scattered wave A and B along.

    The water at the ship moves by i a sin β sideways and by a upwards (here β = 90°), so that
    sway is i (−ω² m) and i (−ω² A22 + iω B22), heave C33 and −ω² A33 + iω B33.
    """
    k = LONG_WAVE**2 / halifax.gravity
    incident = froude_krylov_transfer(halifax, regular(LONG_WAVE, 90))[0]
    scattered = diffraction_load(halifax_database, np.array([LONG_WAVE]), np.array([np.pi / 2]), 0.0)[0]
    nearest = np.argmin(np.abs(halifax_database.frequencies - LONG_WAVE))  # 0.2 rad/s
    moved = (
        -(LONG_WAVE**2) * halifax_database.added_mass[nearest]
        + 1j * LONG_WAVE * halifax_database.radiation_damping[nearest]
    )
    stiffness = halifax.hydrostatics.stiffness[2, 2]
    # exp(k z) over the draft of 5 m takes up to k T = 2 % off, the frequency beside the grid adds some.
    assert incident[2] == pytest.approx(stiffness, rel=k * halifax.draft)
    assert incident[1] == pytest.approx(-(LONG_WAVE**2) * 1j * halifax.mass, rel=0.03)
    assert scattered[2] == pytest.approx(moved[2, 2], rel=0.05)
    assert scattered[1] == pytest.approx(1j * moved[1, 1], rel=0.05)
    print(
        f"found/expected: heave {scattered[2] / moved[2, 2]:.3f}, sway {scattered[1] / 1j / moved[1, 1]:.3f}"
    )


# --- buoyancy and weight -------------------------------------------------------------------------


@pytest.mark.parametrize("dof", [Dof.HEAVE, Dof.ROLL, Dof.PITCH])
def test_restoring_is_the_slope_of_buoyancy_and_weight(dof: Dof, halifax: Ship) -> None:
    """−C η against central differences of the kernel's buoyancy plus weight, column by column."""
    step = 1e-3
    weight, wetted = Weight(halifax.mass, halifax.gravity), WettedSurface(halifax, [NO_WAVES], [0.0])
    total = [
        (weight.evaluate(moved) + wetted.evaluate(moved))[0]
        for moved in (instant(step * np.eye(6)[dof]), instant(-step * np.eye(6)[dof]))
    ]
    slope = (total[0] - total[1]) / (2 * step)
    linear = Restoring(halifax.hydrostatics.stiffness).evaluate(instant(np.eye(6)[dof]))[0]
    scale = np.sqrt(np.abs(np.diag(halifax.hydrostatics.stiffness)))
    scale[[0, 1, 5]] = scale[2], scale[2], scale[4]
    # A kink where the panels meet the waterline leaves what is linear in the step: 1e-3 of a beam.
    assert np.abs((slope - linear) / (scale * scale[dof])).max() < 1e-3
    assert linear[dof] < 0


def test_calm_water_never_turns_a_ship_about_the_vertical(halifax: Ship) -> None:
    """Q6 of buoyancy vanishes heeled, trimmed and yawed, and Q4, Q5, F3 do not care about the yaw.

    With the moments left in ship axes, F6 is as large as F5 sin η4.
    """
    pose = np.array([3.0, -2.0, 0.4, 0.35, -0.06, 0.9])
    in_ship_axes = pressure_force(halifax, CalmSeaway(), 0.0, pose)
    load = load_to_earth(in_ship_axes, pose)
    unyawed = pose * np.array([1, 1, 1, 1, 1, 0])
    without_yaw = load_to_earth(pressure_force(halifax, CalmSeaway(), 0.0, unyawed), unyawed)
    # Rounding of sums over 2500 panels.
    assert abs(load[5]) < 1e-10 * abs(load[4])
    assert abs(in_ship_axes[5]) > 0.1 * abs(load[4])
    np.testing.assert_allclose(load[[2, 3, 4]], without_yaw[[2, 3, 4]], rtol=1e-10)


# --- supplementary -------------------------------------------------------------------------------


def test_supplementary_loads_pull_back_and_brake() -> None:
    """−C η − B η̇, each motion by itself."""
    load = Supplementary({"surge": 2.0, "yaw": 3.0}, {"sway": 5.0, "roll": 7.0})
    (found,) = load.evaluate(instant(np.arange(1.0, 7.0), np.arange(10.0, 70.0, 10.0)))
    np.testing.assert_array_equal(found, [-2.0, -100.0, 0.0, -280.0, 0.0, -18.0])
    np.testing.assert_array_equal(np.diag(load.stiffness_matrix), [2.0, 0, 0, 0, 0, 3.0])
    np.testing.assert_array_equal(np.diag(load.damping_matrix), [0, 5.0, 0, 7.0, 0, 0])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"stiffness": {"swap": 1.0}}, "Unknown motion in supplementary stiffness"),
        ({"damping": {"roll": -1.0}}, "Supplementary damping in roll is negative"),
        ({"stiffness": {"yaw": np.nan}}, "Supplementary stiffness in yaw is negative or not finite"),
    ],
)
def test_supplementary_values_that_make_no_sense_are_refused(arguments: dict, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        Supplementary(**arguments)


def test_unknown_method_and_displacement_are_refused(halifax: Ship) -> None:
    with pytest.raises(PanelsimError, match="Unknown method"):
        pressure_force(halifax, CalmSeaway(), 0.0, np.zeros(6), method="magic")
    with pytest.raises(PanelsimError, match="not six finite numbers"):
        pressure_force(halifax, CalmSeaway(), 0.0, np.full(6, np.nan))


def test_compiled_and_plain_method_agree(halifax: Ship) -> None:
    """The oracle is reachable by name from `pressure_force` and gives the kernel's answer."""
    pose = np.array([1.0, 2.0, -0.5, 0.2, 0.03, -0.1])
    direct, oracle = (
        pressure_force(halifax, RegularSeaway(2.0, 0.6, 2.0), 7.0, pose, speed=5.0, method=method)
        for method in ("direct", "oracle")
    )
    # Rounding of the largest entry of force and of moment.
    assert np.abs(direct - oracle)[:3].max() < 1e-9 * np.abs(direct[:3]).max()
    assert np.abs(direct - oracle)[3:].max() < 1e-9 * np.abs(direct[3:]).max()
