"""Transfer functions: what theory says of them, and the linear time domain wave by wave."""

import subprocess
import sys
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from panelsim.conventions import KNOT, Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.speed_terms import radiation_at_speed
from panelsim.hydro.store import database_for
from panelsim.hydro.transom import Transom
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.simulate import simulate_batch
from panelsim.response.response import Response, response
from panelsim.response.scattering import diffraction_loads
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

HEADINGS = np.deg2rad([0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0])
SPEEDS = np.array([0.0, 10.0, 20.0]) * KNOT
OMEGA = np.arange(0.25, 1.5, 0.05)
MIRROR = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])


@pytest.fixture(scope="module")
def springs() -> Supplementary:
    """TM 2003-190 section 8, with the yaw damped as well so that its transient dies within a run."""
    return Supplementary(
        stiffness={"surge": 5e5, "sway": 1e6, "yaw": 2e9},
        damping={"surge": 1e6, "sway": 2e6, "roll": 2e7, "yaw": 2e9},
    )


@pytest.fixture(scope="module")
def table(halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary) -> Response:
    return response(
        halifax,
        halifax_database,
        frequencies=OMEGA,
        wave_headings=HEADINGS,
        speeds=SPEEDS,
        supplementary=springs,
    )


def one(
    ship: Ship, database: HydroDatabase, omega: float, beta: float, speed: float, **more: object
) -> np.ndarray:
    """Motions (6,) in one wave."""
    found = response(ship, database, frequencies=[omega], wave_headings=[beta], speeds=[speed], **more)  # type: ignore[arg-type]
    return found.transfer[0, 0, 0]


def test_the_equations_of_motion_hold(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary, table: Response
) -> None:
    """Put together here from the parts: inertia, radiation at speed, springs, loads. Rounding: 1e-9."""
    for i, speed in enumerate(SPEEDS):
        for j, beta in enumerate(HEADINGS):
            omega, heading = OMEGA, np.full(len(OMEGA), beta)
            encounter = encounter_frequency(omega, heading, speed, halifax.gravity)
            np.testing.assert_allclose(table.encounter_frequency[i, j], encounter, rtol=1e-12)
            waves = WaveComponents(np.ones(len(omega)), omega, heading, np.zeros(len(omega)))
            load = froude_krylov_transfer(halifax, waves)
            load = load + diffraction_load(halifax_database, omega, heading, speed)
            radiation = radiation_at_speed(halifax_database, encounter, speed)
            motions = table.transfer[i, j]
            velocity, acceleration = 1j * encounter[:, None] * motions, -(encounter[:, None] ** 2) * motions
            left = acceleration @ halifax.inertia.T
            left = left + np.einsum("mij,mj->mi", radiation.impedance, motions)
            left = left + motions @ (halifax.hydrostatics.stiffness + springs.stiffness_matrix).T
            left = left + velocity @ springs.damping_matrix.T
            # A motion that vanishes by symmetry is held against what it is elsewhere.
            assert np.abs(left - load).max() < 1e-9 * np.abs(load).max()


@pytest.mark.parametrize("transom", [False, True])
def test_diffraction_at_several_speeds_is_that_of_each(
    halifax: Ship, halifax_database: HydroDatabase, transom: bool
) -> None:
    """Overtaken waves, waves beyond the last stored frequency, and the terms of the transom."""
    omega = np.array([0.4, 0.9, 1.4, 2.2, 0.5, 0.7])
    beta = np.deg2rad([0.0, 20.0, -30.0, 180.0, 90.0, 250.0])
    end = Transom.of_ship(halifax, halifax_database.frequencies) if transom else None
    speeds = np.array([0.0, 5.0, 12.0])
    found = diffraction_loads(halifax_database, omega, beta, speeds, end)
    for loads, speed in zip(found, speeds, strict=True):
        expected = diffraction_load(halifax_database, omega, beta, speed, end)
        np.testing.assert_allclose(loads, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_long_waves_carry_the_ship_along(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """Heave 1, roll and pitch the slope of the wave, surge and sway the circles of the water, at any speed.

    At 0.12 rad/s the waves are 35 ship lengths long, k L 0.18: what is left is of the order of its square.
    Under a crest the water moves as the wave travels, so displacements lead by a quarter period the other
    way. Under way yaw is turned by the Munk moment, and with it sway, roll and surge are others' tests.
    """
    omega = 0.12
    k = omega**2 / halifax.gravity
    for speed in SPEEDS:
        for beta in (0.0, 0.5, 1.5, 2.0, np.pi, -0.5, -2.0):
            motions = one(halifax, halifax_database, omega, beta, float(speed))
            assert motions[Dof.HEAVE] == pytest.approx(1.0, abs=0.03)
            # ζ = exp(-ik(x cos β - y sin β)): bow down is -∂ζ/∂x = ik cos β, starboard down ∂ζ/∂y = ik sin β.
            assert motions[Dof.PITCH] / k == pytest.approx(1j * np.cos(beta), abs=0.03)
            if speed == 0.0:
                assert motions[Dof.ROLL] / k == pytest.approx(1j * np.sin(beta), abs=0.06)
                assert motions[Dof.SURGE] == pytest.approx(-1j * np.cos(beta), abs=0.05)
                assert motions[Dof.SWAY] == pytest.approx(1j * np.sin(beta), abs=0.05)


def test_port_and_starboard_are_alike(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary, table: Response
) -> None:
    """Waves from starboard: sway, roll and yaw change their sign. Head and following seas have none."""
    mirrored = response(
        halifax,
        halifax_database,
        frequencies=OMEGA,
        wave_headings=-HEADINGS[1:-1],
        speeds=SPEEDS,
        supplementary=springs,
    )
    np.testing.assert_allclose(mirrored.transfer, table.transfer[:, 1:-1] * MIRROR, rtol=1e-12)
    np.testing.assert_allclose(
        mirrored.dataset["froude_krylov"].values, table.dataset["froude_krylov"].values[1:-1] * MIRROR
    )
    lateral = [Dof.SWAY, Dof.ROLL, Dof.YAW]
    along = np.abs(table.transfer[:, [0, -1]][..., lateral]).max()
    # The mesh is the same on both sides to rounding.
    assert along < 1e-9 * np.abs(table.transfer[:, 1:-1][..., lateral]).max()


def test_mirrored_loads_are_those_of_the_waves_themselves(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """What is taken from the other side is what a solution there gives."""
    found = response(
        halifax,
        halifax_database,
        frequencies=OMEGA,
        wave_headings=[-0.8],
        speeds=[10.0],
        supplementary=springs,
    )
    heading = np.full(len(OMEGA), -0.8)
    expected = diffraction_load(halifax_database, OMEGA, heading, 10.0)
    size = np.abs(expected).max(axis=0)
    assert np.all(np.abs(found.dataset["diffraction"].values[0, 0] - expected) < 1e-9 * size)
    waves = WaveComponents(np.ones(len(OMEGA)), OMEGA, heading, np.zeros(len(OMEGA)))
    expected = froude_krylov_transfer(halifax, waves)
    assert np.all(
        np.abs(found.dataset["froude_krylov"].values[0] - expected) < 1e-9 * np.abs(expected).max(axis=0)
    )


def test_short_waves_do_not_move_the_ship_and_resonance_does(table: Response) -> None:
    """Beam seas at rest: heave near 1 in long waves; roll peaks at its natural frequency of 0.6 rad/s."""
    beam = np.abs(table.transfer[0, 3])
    assert beam[:5, Dof.HEAVE] == pytest.approx(1.0, abs=0.05)
    peak = OMEGA[np.argmax(beam[:, Dof.ROLL])]
    assert peak == pytest.approx(2 * np.pi / 10.4, abs=0.05)
    head = np.abs(table.transfer[0, -1])
    assert head[-1, Dof.HEAVE] < 0.05 and head[0, Dof.HEAVE] > 0.95


def test_the_linear_time_domain_gives_the_same_motions(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """Amplitude and phase within 0.5 % of each mode's peak at dt 0.1 s, wave by wave.

    All waves of a heading in one run, whose encounter frequencies a record of 240 s tells apart; at 30° and
    20 knots the ship overtakes the wave of 1.2 rad/s. Measured: 0.16 % of the peak, in pitch, at most.
    """
    waves = {180: [0.35, 0.55, 0.8], 120: [0.4, 0.6, 0.85], 90: [0.4, 0.6, 0.85], 30: [0.35, 0.9, 1.2]}
    cases = [(knots * KNOT, degrees) for knots in (0, 10, 20) for degrees in waves]
    seas = [
        WaveComponents(np.full(3, 0.01), np.array(waves[degrees]), np.deg2rad(degrees), np.zeros(1))
        for _, degrees in cases
    ]
    histories = simulate_batch(
        halifax,
        [SimpleNamespace(kind="regular", components=sea) for sea in seas],  # type: ignore[misc]
        speed=[speed for speed, _ in cases],
        duration=440.0,
        time_step=0.1,
        database=halifax_database,
        model="linear",
        supplementary=springs,
    )
    scan = response(
        halifax,
        halifax_database,
        frequencies=np.arange(0.2, 1.5, 0.05),
        wave_headings=np.deg2rad(list(waves)),
        speeds=SPEEDS,
        supplementary=springs,
    )
    worst = np.zeros(6)
    for history, sea, (speed, degrees) in zip(histories, seas, cases, strict=True):
        last = history.time >= 200.0
        encounter = sea.encounter_frequency(speed, halifax.gravity)
        phase = np.outer(history.time[last], encounter)
        basis = np.hstack([np.cos(phase), -np.sin(phase), np.ones((last.sum(), 1))])
        fit = np.linalg.lstsq(basis, history.displacement[last], rcond=None)[0]
        in_time = (fit[:3] + 1j * fit[3:-1]) / 0.01
        at = response(
            halifax,
            halifax_database,
            frequencies=sea.frequency,
            wave_headings=[np.deg2rad(degrees)],
            speeds=[speed],
            supplementary=springs,
        )
        peak = np.abs(scan.transfer[list(SPEEDS).index(speed)]).max(axis=(0, 1))
        worst = np.maximum(worst, (np.abs(in_time - at.transfer[0, 0]) / peak).max(axis=0))
    print(np.round(100 * worst, 2))
    assert np.all(worst < 0.005)


def test_linear_roll_damping_is_that_of_a_supplementary_one(
    halifax: Ship, halifax_database: HydroDatabase
) -> None:
    beam = {"omega": 0.6, "beta": np.pi / 2, "speed": 0.0}
    by_terms = one(halifax, halifax_database, **beam, roll_damping=RollDampingTerms(3e7, 1e9, 1e9))
    by_damper = one(halifax, halifax_database, **beam, supplementary=Supplementary(damping={"roll": 3e7}))
    np.testing.assert_allclose(by_terms, by_damper, rtol=1e-12)
    bare = one(halifax, halifax_database, **beam)
    assert abs(by_terms[Dof.ROLL]) < 0.5 * abs(bare[Dof.ROLL])


def test_each_speed_has_its_own_roll_damping(halifax: Ship, halifax_database: HydroDatabase) -> None:
    arguments = {"frequencies": [0.6], "wave_headings": [2.0]}
    terms = [RollDampingTerms(1e7), RollDampingTerms(5e7)]
    both = response(halifax, halifax_database, **arguments, speeds=[0.0, 10.0], roll_damping=terms)  # type: ignore[arg-type]
    for i, (speed, own) in enumerate(zip([0.0, 10.0], terms, strict=True)):
        alone = response(halifax, halifax_database, **arguments, speeds=[speed], roll_damping=own)  # type: ignore[arg-type]
        np.testing.assert_allclose(both.transfer[i], alone.transfer[0], rtol=1e-12)


def test_the_table_takes_roll_damping_by_speed_and_heading(
    halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """In place of the linear term: each row is that of a table with this damping from the start."""
    arguments = {"frequencies": [0.5, 0.6], "wave_headings": [2.0, 1.0, 4.0]}
    terms = RollDampingTerms(2e7, 1e9, 1e9)
    table = response(halifax, halifax_database, **arguments, speeds=[0.0, 8.0], roll_damping=terms)  # type: ignore[arg-type]
    assert np.all(table.dataset["roll_damping"].values == 2e7)
    wanted = 1e7 * np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    found = table.with_roll_damping(wanted)
    for i, j in np.ndindex(2, 3):
        own = RollDampingTerms(wanted[i, j])
        alone = response(halifax, halifax_database, **arguments, speeds=[0.0, 8.0], roll_damping=own)  # type: ignore[arg-type]
        # Round-off of a solution of equations whose matrix spans nine orders of magnitude.
        np.testing.assert_allclose(found.transfer[i, j], alone.transfer[i, j], rtol=1e-9)
    np.testing.assert_array_equal(found.dataset["roll_damping"].values, wanted)
    np.testing.assert_array_equal(found.at((0.0, 0.0, 5.0)).dataset["roll_damping"].values, wanted)
    sea = Bretschneider(5.0, 11.0)
    np.testing.assert_array_equal(found.rms(sea).values, table.rms(sea).values)
    np.testing.assert_allclose(
        found.with_roll_damping(np.full((2, 3), 2e7)).transfer, table.transfer, rtol=1e-9
    )
    for wrong in (wanted.T, -wanted, wanted * np.nan):
        with pytest.raises(PanelsimError, match="one for each speed and heading"):
            table.with_roll_damping(wrong)


def test_transom_terms_damp_pitch(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """By a third of the pitch damping at 20 knots for this broad transom: hydrodynamic sources say so."""
    end = Transom.of_ship(halifax, halifax_database.frequencies)
    head = {"omega": 0.75, "beta": np.pi, "speed": 20 * KNOT}
    without, with_terms = (
        abs(one(halifax, halifax_database, **head, transom=t)[Dof.PITCH]) for t in (None, end)
    )
    assert 0.5 < with_terms / without < 0.97
    still = {"omega": 0.75, "beta": np.pi, "speed": 0.0}
    np.testing.assert_allclose(
        one(halifax, halifax_database, **still, transom=end),
        one(halifax, halifax_database, **still),
        rtol=1e-12,
    )


def test_a_wave_that_stands_still_beside_the_ship(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """ω_e = 0: springs hold her against it, without them she is pushed away without end."""
    speed = 10.0
    omega = halifax.gravity / speed
    held = one(halifax, halifax_database, omega, 0.0, speed, supplementary=springs)
    assert np.isfinite(held).all()
    near = one(halifax, halifax_database, omega * (1 + 1e-7), 0.0, speed, supplementary=springs)
    np.testing.assert_allclose(held, near, atol=1e-4 * np.abs(held).max())
    with pytest.raises(PanelsimError, match="stands still"):
        one(halifax, halifax_database, omega, 0.0, speed)


def test_points_of_the_ship_by_rigid_motion(halifax: Ship, table: Response) -> None:
    """Bow: heave less the arm times pitch. Port side: heave plus the arm times roll. Mast: sway less it."""

    def near_cg(x: float, y: float, z: float) -> np.ndarray:
        # Points are given in hull axes, which the trim turns from ship axes.
        arm = np.array([x, y, z]) @ halifax.rotation_from_hull
        return table.at(halifax.center_of_gravity + arm).transfer

    surge, sway, heave, roll, pitch, yaw = np.moveaxis(table.transfer, -1, 0)
    same = partial(np.testing.assert_allclose, rtol=0.0, atol=1e-12)
    bow, port, mast = near_cg(50.0, 0.0, 0.0), near_cg(0.0, 7.0, 0.0), near_cg(0.0, 0.0, 20.0)
    same(bow[..., 2], heave - 50.0 * pitch)
    same(bow[..., 1], sway + 50.0 * yaw)
    same(port[..., 2], heave + 7.0 * roll)
    same(port[..., 0], surge - 7.0 * yaw)
    same(mast[..., 1], sway - 20.0 * roll)
    same(mast[..., 0], surge + 20.0 * pitch)
    rate = 1j * table.encounter_frequency[..., None]
    same(mast[..., 3:6], rate * mast[..., :3])
    same(mast[..., 6:9], rate**2 * mast[..., :3])


def test_a_point_at_the_side_rides_long_waves(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """Relative motion goes with the square of k where the ship follows the slope, and is -ζ in short waves.

    In phase with the wave at the point, not at the CG: bow and port quarter, at speed, seas from both sides.
    """
    x, _, z = halifax.center_of_gravity
    for speed in (0.0, 10.0):
        for beta in (np.pi, 0.0, 2.0):
            long = response(
                halifax, halifax_database, frequencies=[0.1], wave_headings=[beta], speeds=[speed]
            ).at((x + 55.0, 5.0, z))
            assert abs(long.transfer[0, 0, 0, -1]) < 0.03
    abeam = response(halifax, halifax_database, frequencies=[2.2], wave_headings=[2.0], speeds=[0.0])
    away = abeam.at((x + 30.0, 6.0, z)).transfer[0, 0, 0, -1]
    phase = 2.2**2 / halifax.gravity * (30.0 * np.cos(2.0) - 6.0 * np.sin(2.0))
    # A tenth of the wave moves her in sway and roll; from the other side the phase would be 5.4 rad off.
    assert away == pytest.approx(-np.exp(-1j * phase), abs=0.15)
    short = response(halifax, halifax_database, frequencies=[2.2], wave_headings=[np.pi], speeds=[0.0])
    k = 2.2**2 / halifax.gravity
    relative = short.at((x + 55.0, 0.0, z)).transfer[0, 0, 0, -1]
    # The ship itself still moves by some thousandths of the wave.
    assert relative == pytest.approx(-np.exp(1j * k * 55.0), abs=0.02)


def test_what_is_stored_can_be_read(table: Response, tmp_path: object) -> None:
    path = table.save(f"{tmp_path}/response.nc")
    with xr.open_dataset(path) as stored:
        complex_again = stored["transfer_real"] + 1j * stored["transfer_imag"]
        np.testing.assert_array_equal(complex_again.values, table.transfer)
        assert stored.attrs["time_factor"].startswith("exp(+i")
    with pytest.raises(PanelsimError, match="overwrite"):
        table.save(path)
    with pytest.raises(ValueError, match="read-only"):
        table.transfer[0] = 0.0


def test_waves_beyond_the_coefficients_are_noted(halifax: Ship, halifax_database: HydroDatabase) -> None:
    found = response(
        halifax, halifax_database, frequencies=[0.5, 1.8], wave_headings=[np.pi], speeds=[0.0, 10.0]
    )
    assert any(note.startswith("1 of 4 waves") and "5.10 rad/s" in note for note in found.notes)
    # Nothing holds this ship on her course.
    assert any("Munk" in note for note in found.notes)


BAD = [
    ({"frequencies": [0.5, 0.4]}, "0.5"),
    ({"frequencies": [0.0, 0.4]}, "positive and rising"),
    ({"frequencies": []}, "row of finite numbers"),
    ({"frequencies": [np.nan]}, "row of finite numbers"),
    ({"frequencies": "many"}, "row of finite numbers"),
    ({"wave_headings": [150.0]}, "radians"),
    ({"wave_headings": [0.0, 2 * np.pi]}, "twice"),
    ({"wave_headings": [[0.0]]}, "row of finite numbers"),
    ({"speeds": [-1.0]}, "goes ahead"),
    ({"speeds": [20.0, 20.0]}, "twice"),
    ({"speeds": [80.0]}, "50"),
    ({"supplementary": 3}, "supplementary"),
    ({"transom": True}, "transom"),
    ({"roll_damping": [RollDampingTerms()] * 2}, "one for each speed"),
    ({"roll_damping": 0.05}, "RollDampingTerms"),
]


@pytest.mark.parametrize(("given", "message"), BAD)
def test_bad_arguments_are_refused(
    halifax: Ship, halifax_database: HydroDatabase, given: dict[str, object], message: str
) -> None:
    arguments: dict[str, object] = {"frequencies": [0.5], "wave_headings": [0.5], "speeds": [5.0]}
    with pytest.raises(PanelsimError, match=message):
        response(halifax, halifax_database, **(arguments | given))  # type: ignore[arg-type]


def test_a_database_of_another_ship_is_refused(halifax_database: HydroDatabase, barge: Ship) -> None:
    with pytest.raises(PanelsimError, match="another ship"):
        response(barge, halifax_database, frequencies=[0.5], wave_headings=[0.5], speeds=[0.0])
    with pytest.raises(PanelsimError, match="load_ship"):
        response("halifax", halifax_database, frequencies=[0.5], wave_headings=[0.5], speeds=[0.0])  # type: ignore[arg-type]


def test_the_public_name_is_a_function_however_it_is_imported() -> None:
    """The package of that name may be there first."""
    for first in ("import panelsim.response.natural", "from panelsim import natural_periods", ""):
        script = (
            f"{first}\nimport panelsim as ps\ntry:\n    ps.response(1, 2, frequencies=1, wave_headings=1,"
        )
        script += " speeds=1)\nexcept ps.PanelsimError as error:\n    assert 'load_ship' in str(error)\n"
        subprocess.run([sys.executable, "-c", script], check=True, timeout=60)


@pytest.mark.parametrize("point", [(1.0, 2.0), "bridge", (np.nan, 0.0, 0.0), (1e6, 0.0, 0.0)])
def test_a_point_is_three_numbers(table: Response, point: object) -> None:
    with pytest.raises(PanelsimError, match="point"):
        table.at(point)  # type: ignore[arg-type]


def test_a_hull_of_strips_is_answered_too() -> None:
    """Coefficients by strip theory: head-sea heave and pitch near those of three dimensions.

    They differ by some per cent of the peak for this slender hull; 15 % tells a wrong sign.
    """
    ship = load_ship("frigate")
    arguments = {"frequencies": [0.4, 0.6, 0.8], "wave_headings": [np.pi], "speeds": [10.0]}
    strip = response(ship, database_for(ship, method="strip"), **arguments)  # type: ignore[arg-type]
    bem = response(ship, database_for(ship), **arguments)  # type: ignore[arg-type]
    for dof in (Dof.HEAVE, Dof.PITCH):
        difference = np.abs(strip.transfer[..., dof] - bem.transfer[..., dof]).max()
        assert difference < 0.15 * np.abs(bem.transfer[..., dof]).max()
