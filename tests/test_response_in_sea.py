"""Motions in a sea: component sums, spectra, short crests, following seas, roll damping for the sea."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import KNOT, Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.simulate import simulate_batch
from panelsim.response.response import Response, response
from panelsim.response.statistics import _peak_frequency
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.direction.directional_table import DirectionalTable
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import CosineHalfAngle, CosineSquared, Spreading
from panelsim.seaway.frequencies import EvenFrequencies, JitteredFrequencies
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.seaways import CalmSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.jonswap import Jonswap
from panelsim.seaway.spectra.table import TableSpectrum
from panelsim.ship.ship import Ship

SPEED = 20 * KNOT
SEA = Bretschneider(7.5, 15.0)
# A sea between 0.4 and 0.8 rad/s, which takes few waves.
NARROW = TableSpectrum(np.array([0.4, 0.5, 0.6, 0.8]), np.array([0.0, 4.0, 3.0, 0.0]))


@pytest.fixture(scope="module")
def table(halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary) -> Response:
    """A coarse table: statistics in a sea do not read it."""
    return response(
        halifax,
        halifax_database,
        frequencies=[0.4, 0.8],
        wave_headings=np.deg2rad([0.0, 30.0, 90.0, 150.0, 180.0]),
        speeds=[0.0, SPEED],
        supplementary=springs,
    )


def test_a_sea_of_components_is_their_sum(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary, table: Response
) -> None:
    """Σ ½|H a|² with H of the same waves, and m2 with |ω_e|²; phases do not enter."""
    omega, amplitude = np.array([0.35, 0.6, 1.3]), np.array([1.0, 0.5, 0.2])
    sea = ComponentSeaway(WaveComponents(amplitude, omega, np.full(3, 0.4), np.array([0.1, 2.0, 5.0])))
    found = table.in_sea(sea)
    at = response(
        halifax,
        halifax_database,
        frequencies=omega,
        wave_headings=[0.4],
        speeds=[0.0, SPEED],
        supplementary=springs,
    )
    energy = 0.5 * np.abs(at.transfer[:, 0] * amplitude[:, None]) ** 2
    np.testing.assert_allclose(found["rms"].values[:, 0], np.sqrt(energy.sum(axis=1)), rtol=1e-10)
    m2 = np.einsum("sm,smk->sk", at.encounter_frequency[:, 0] ** 2, energy)
    expected = 2 * np.pi * np.sqrt(energy.sum(axis=1) / m2)
    np.testing.assert_allclose(found["zero_crossing_period"].values[:, 0], expected, rtol=1e-10)


def test_one_wave_has_one_period(table: Response) -> None:
    """3 m of amplitude: RMS 3|H|/√2, both periods that of encounter, also of a wave that is overtaken."""
    for omega, beta in ((0.4, 2.0), (1.2, 0.3)):
        found = table.in_sea(RegularSeaway(0.5, omega, beta)).sel(speed=SPEED).squeeze()
        encounter = abs(omega - SPEED * omega**2 / 9.80665 * np.cos(beta))
        for period in ("zero_crossing_period", "peak_period"):
            np.testing.assert_allclose(found[period].values, 2 * np.pi / encounter, rtol=1e-9)


@pytest.mark.parametrize("heading_deg", [0.0, 30.0, 150.0])
def test_a_spectrum_is_the_limit_of_many_components(table: Response, heading_deg: float) -> None:
    """2000 components from 0.2 to 2.2 rad/s against the narrow bands: 0.3 %, of which the tails are half."""
    heading = np.deg2rad(heading_deg)
    sea = RandomSeaway(SEA, EvenFrequencies(0.2, 2.2, 0.001), heading)
    components, spectrum = table.in_sea(sea), table.in_sea(SEA, wave_headings=[heading])
    for name in ("rms", "zero_crossing_period"):
        np.testing.assert_allclose(spectrum[name].values, components[name].values, rtol=3e-3, atol=1e-9)
    # The peak is told to some per cent: the spectrum is smoothed over 5 % of its mean frequency.
    np.testing.assert_allclose(spectrum["peak_period"].values, components["peak_period"].values, rtol=0.05)
    assert spectrum.attrs["energy_share"] == pytest.approx(0.9999, abs=2e-5)


def test_waves_too_short_to_move_the_ship_count_in_her_relative_motion(table: Response) -> None:
    """In beam seas she follows long waves, and a five-hundredth of the energy is a tenth of the variance."""
    heading = [0.5 * np.pi]
    at = table.at((0.0, 0.0, 5.0))
    spectrum = at.in_sea(SEA, wave_headings=heading).sel(signal="relative_motion")
    omega = np.geomspace(0.2, 15.0, 1500)
    waves = at.linear_ship.in_waves(omega, np.full(1500, heading[0]), table.speeds, np.zeros(2))
    for i in range(2):
        found = at.signals.of(waves.transfer[i], omega, waves.wave_heading, waves.encounter[i])[:, -1]
        energy = np.abs(found) ** 2 * SEA.density(omega)
        # What is beyond the last wave: 0.3 % in RMS, 4 % in period.
        assert float(spectrum["rms"][i, 0]) == pytest.approx(np.sqrt(np.trapezoid(energy, omega)), rel=6e-3)
        m2 = np.trapezoid(waves.encounter[i] ** 2 * energy, omega)
        period = 2.0 * np.pi * np.sqrt(np.trapezoid(energy, omega) / m2)
        assert float(spectrum["zero_crossing_period"][i, 0]) == pytest.approx(period, rel=0.05)


def test_a_sea_much_longer_than_the_ship_lifts_her_with_it(table: Response) -> None:
    """Heave is the elevation: RMS H_s/4 and the period of the sea, as a ship at rest meets it on the beam."""
    swell = Jonswap(2.0, 35.0)
    found = table.in_sea(swell, wave_headings=[np.pi / 2]).sel(speed=0.0, signal="heave")
    np.testing.assert_allclose(found["rms"].values, 0.5, rtol=5e-3)
    np.testing.assert_allclose(found["peak_period"].values, 35.0, rtol=0.02)
    # Without the 0.2 % of the energy above, whose second moment counts more.
    np.testing.assert_allclose(found["zero_crossing_period"].values, swell.zero_crossing_period, rtol=0.05)


def test_following_seas_by_hand(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary, table: Response
) -> None:
    """∫|H|² S dω and ∫ω_e²|H|² S dω over wave frequency by the trapezoid rule: 0.5 % for the tails."""
    omega = np.linspace(0.2, 2.2, 1001)
    fine = response(
        halifax,
        halifax_database,
        frequencies=omega,
        wave_headings=[0.3],
        speeds=[SPEED],
        supplementary=springs,
    )
    density = np.abs(fine.transfer[0, 0]) ** 2 * SEA.density(omega)[:, None]
    m0 = np.trapezoid(density, omega, axis=0)
    m2 = np.trapezoid(density * fine.encounter_frequency[0, 0, :, None] ** 2, omega, axis=0)
    found = table.in_sea(SEA, wave_headings=[0.3]).sel(speed=SPEED).squeeze()
    np.testing.assert_allclose(found["rms"].values, np.sqrt(m0), rtol=5e-3)
    np.testing.assert_allclose(found["zero_crossing_period"].values, 2 * np.pi * np.sqrt(m0 / m2), rtol=5e-3)


@pytest.mark.parametrize("spreading", [CosineSquared(np.pi / 2), CosineHalfAngle(40.0)])
def test_a_short_crested_sea_is_the_limit_of_many_components(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary, spreading: Spreading
) -> None:
    """Directions 5° apart and frequencies 0.01 rad/s against the scattered ones: 0.5 %.

    At 10 knots: at 20 knots the components themselves are too far apart for the resonance in roll.
    """
    table = response(
        halifax,
        halifax_database,
        frequencies=[0.5],
        wave_headings=[0.0],
        speeds=[10 * KNOT],
        supplementary=springs,
    )
    heading = np.deg2rad(60.0)
    sea = RandomSeaway(
        NARROW,
        EvenFrequencies(0.405, 0.795, 0.01),
        heading,
        spreading=spreading,
        direction_step=np.deg2rad(5.0),
    )
    components = table.in_sea(sea)["rms"].values
    continuous = table.rms(NARROW, wave_headings=[heading], spreading=spreading).values
    np.testing.assert_allclose(continuous, components, rtol=5e-3)
    long_crested = table.rms(NARROW, wave_headings=[heading]).values
    assert np.abs(continuous / long_crested - 1.0).max() > 0.03


def test_compass_courses_and_relative_headings_agree(table: Response) -> None:
    """β = ν + 180° - χ: for a spread sea, and for the components of one."""
    direction, courses = np.deg2rad(40.0), np.deg2rad([10.0, 100.0, 250.0])
    spread = SpreadSpectrum(NARROW, CosineSquared(np.pi / 2), direction)
    by_compass = table.rms(spread, ship_headings=courses)
    relative = np.mod(direction + np.pi - courses, 2 * np.pi)
    by_heading = table.rms(NARROW, wave_headings=relative, spreading=CosineSquared(np.pi / 2))
    assert by_compass.dims == ("speed", "ship_heading", "signal")
    # The rings of directions lie differently about the mean.
    np.testing.assert_allclose(by_compass.values, by_heading.values, rtol=5e-3)
    wave = RegularSeaway(1.0, 0.6, 2.0, ship_heading=0.5)
    turned = table.rms(wave, ship_headings=[0.5, 0.8])
    for i, beta in enumerate((2.0, 1.7)):
        own = table.rms(RegularSeaway(1.0, 0.6, beta))
        np.testing.assert_allclose(turned.values[:, i], own.values[:, 0], rtol=1e-9)


def test_a_sea_from_all_sides_is_the_same_on_every_course(table: Response) -> None:
    omega = np.linspace(0.4, 0.8, 11)
    directions = np.deg2rad(np.arange(0.0, 360.0, 30.0))
    density = np.repeat(NARROW.density(omega)[:, None], 12, axis=1)
    around = DirectionalTable(omega, directions, density)
    rms = table.rms(around, ship_headings=[0.0, 0.7, 3.0]).values
    np.testing.assert_allclose(rms[:, 1:], np.repeat(rms[:, :1], 2, axis=1), rtol=1e-6)
    # Its variance is the mean of those of long-crested seas around the circle, 2π S each.
    headings = 2 * np.pi * np.arange(72) / 72
    alone = table.rms(TableSpectrum(omega, 2 * np.pi * NARROW.density(omega)), wave_headings=headings)
    np.testing.assert_allclose(rms[:, 0] ** 2, np.mean(alone.values**2, axis=1), rtol=0.02)


@settings(deadline=None, max_examples=8)
@given(scale=st.floats(0.1, 0.9), heading=st.floats(0.0, 6.2))
def test_without_more_damping_the_ship_is_linear(table: Response, scale: float, heading: float) -> None:
    """Motions grow with the height of the sea; from the other side they are the same."""
    whole = table.rms(NARROW, wave_headings=[heading]).values
    lower = TableSpectrum(NARROW.frequency, scale**2 * NARROW.density_table)
    part = table.rms(lower, wave_headings=[heading]).values
    mirrored = table.rms(NARROW, wave_headings=[-heading]).values
    np.testing.assert_allclose(part, scale * whole, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(mirrored, whole, rtol=1e-9, atol=1e-12)


def test_roll_damping_is_that_of_its_own_roll(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """The ship solved anew with the equivalent damping rolls at just the rate that it stands for.

    √m2 of roll is the deviation of its rate. And the damping grows with the sea.
    """
    springs = Supplementary(stiffness={"surge": 5e5, "sway": 1e6, "yaw": 2e9}, damping={"sway": 2e6})
    terms = RollDampingTerms(linear=5e6, quadratic=2e8, cubic=3e9)
    arguments = {"frequencies": [0.5], "wave_headings": [2.0], "supplementary": springs}
    ship = response(halifax, halifax_database, speeds=[0.0, SPEED], roll_damping=terms, **arguments)  # type: ignore[arg-type]
    headings = np.deg2rad([45.0, 120.0])
    found = ship.in_sea(NARROW, wave_headings=headings, spreading=CosineSquared(np.pi / 2))
    for speed in (0.0, SPEED):
        for beta in headings:
            there = found.sel(speed=speed, wave_heading=beta)
            damping = float(there["equivalent_roll_damping"])
            anew = response(
                halifax,
                halifax_database,
                speeds=[speed],
                roll_damping=RollDampingTerms(damping),
                **arguments,  # type: ignore[arg-type]
            ).in_sea(NARROW, wave_headings=[beta], spreading=CosineSquared(np.pi / 2))
            np.testing.assert_allclose(anew["rms"].values[0, 0], there["rms"].values, rtol=1e-6)
            roll = anew.sel(signal="roll").squeeze()
            rate = 2 * np.pi * float(roll["rms"]) / float(roll["zero_crossing_period"])
            assert terms.equivalent_gaussian(rate) == pytest.approx(damping, rel=1e-6)
    smaller = ship.in_sea(Bretschneider(3.0, 15.0), wave_headings=headings)["equivalent_roll_damping"]
    larger = ship.in_sea(SEA, wave_headings=headings)["equivalent_roll_damping"]
    assert np.all(larger.values > smaller.values) and np.all(smaller.values > 5e6)


def test_a_point_in_a_sea(table: Response, halifax: Ship) -> None:
    """Velocity and acceleration are those of the displacement; the wave itself far from what moves."""
    bow = table.at((55.0, 0.0, 10.0)).in_sea(SEA, wave_headings=[np.pi])
    vertical = bow.sel(speed=SPEED, signal="displacement_z").squeeze()
    rate = 2 * np.pi / float(vertical["zero_crossing_period"])
    speed = float(bow["rms"].sel(speed=SPEED, signal="velocity_z").squeeze())
    assert speed == pytest.approx(rate * float(vertical["rms"]), rel=1e-9)
    ripples = Bretschneider(0.3, 2.0)
    relative = table.at((0.0, 0.0, 5.0)).rms(ripples, wave_headings=[np.pi]).sel(speed=0.0)
    # Waves of 2 s do not move a ship of 124 m: what is relative is the elevation, H_s/4.
    assert float(relative.sel(signal="relative_motion").squeeze()) == pytest.approx(0.3 / 4, rel=0.01)


def test_drift_that_nothing_holds_has_no_rms(halifax: Ship, halifax_database: HydroDatabase) -> None:
    """In quartering seas some waves stand still beside the ship; at rest and in head seas none do."""
    free = response(halifax, halifax_database, frequencies=[0.5], wave_headings=[0.5], speeds=[0.0, SPEED])
    found = free.in_sea(SEA, wave_headings=[0.5, 2.5])
    rms = found["rms"]
    assert np.isnan(rms.sel(speed=SPEED, wave_heading=0.5, signal=["surge", "sway"]).values).all()
    assert np.isfinite(rms.sel(speed=SPEED, wave_heading=0.5, signal=["heave", "roll", "pitch"]).values).all()
    assert np.isfinite(rms.sel(wave_heading=2.5).values).all()
    assert np.isfinite(rms.sel(speed=0.0).values).all()
    assert "surge, sway" in found.attrs["notes"]
    held = response(
        halifax,
        halifax_database,
        frequencies=[0.5],
        wave_headings=[0.5],
        speeds=[SPEED],
        supplementary=Supplementary(stiffness={"surge": 5e5}),
    )
    point = held.at((10.0, 0.0, 10.0)).rms(SEA, wave_headings=[0.5]).squeeze()
    missing = [str(name) for name in point["signal"].values[np.isnan(point.values)]]
    assert missing == ["displacement_y", "velocity_y"]


def test_a_peak_between_cells_and_a_pile_of_small_frequencies() -> None:
    """A Gaussian bump on a fine grid; and one wave much higher than many small ones."""
    omega = np.linspace(0.1, 2.0, 2000)
    bump = np.exp(-0.5 * ((omega - 0.7321) / 0.1) ** 2)
    # The mean of what lies within 5 % of the mean frequency around the cell of the peak: cells are 1 % wide.
    assert _peak_frequency(omega, bump, 0.74) == pytest.approx(0.7321, rel=0.01)
    # What is spread below 0 comes back: half of a pile beside rest would else be lost there.
    waves, energy = np.array([0.004, 0.6]), np.array([1.0, 1.5])
    assert _peak_frequency(waves, energy, 0.4) == pytest.approx(0.004, rel=1e-9)
    waves, energy = np.array([0.5, 0.9, 1.4]), np.array([0.1, 3.0, 0.2])
    assert _peak_frequency(waves, energy, 0.93) == pytest.approx(0.9, rel=1e-12)


def test_runs_with_many_seeds_scatter_about_the_spectrum(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary, table: Response
) -> None:
    """20 linear runs of 400 s in bow seas, jittered frequencies: the mean variance within 3 of its errors.

    The error is the scatter of the seeds over √20, some per cent of the variance.
    """
    heading = np.deg2rad(150.0)
    choice = JitteredFrequencies(0.2, 2.0, 0.05)
    seas = [RandomSeaway(SEA, choice, heading, seed) for seed in range(20)]
    histories = simulate_batch(
        halifax,
        seas,
        speed=SPEED,
        duration=400.0,
        time_step=0.25,
        database=halifax_database,
        model="linear",
        supplementary=springs,
    )
    variance = np.array([h.displacement[h.time >= 100.0].var(axis=0) for h in histories])
    mean, error = variance.mean(axis=0), variance.std(axis=0, ddof=1) / np.sqrt(20)
    expected = table.rms(SEA, wave_headings=[heading]).sel(speed=SPEED).values[0] ** 2
    print(np.round((mean - expected) / error, 2), np.round(100 * error / mean, 1))
    assert np.all(np.abs(mean - expected) < 3 * error)
    # A test that any variance would pass is none.
    assert np.all(error < 0.1 * mean)


BAD = [
    ({"sea": CalmSeaway()}, "no waves"),
    ({"sea": "rough"}, "another kind"),
    ({"sea": SEA, "ship_headings": [0.0]}, "takes no ship_headings"),
    ({"sea": RegularSeaway(1.0, 0.5, 2.0), "wave_headings": [0.0]}, "takes no wave_headings"),
    ({"sea": RegularSeaway(1.0, 0.5, 2.0), "spreading": CosineHalfAngle(2.0)}, "takes no spreading"),
    ({"sea": SEA, "wave_headings": [150.0]}, "radians"),
    ({"sea": SEA, "wave_headings": []}, "row of finite numbers"),
    ({"sea": SEA, "spreading": 2.0}, "spreading"),
]


@pytest.mark.parametrize(("given", "message"), BAD)
def test_other_seas_are_refused(table: Response, given: dict[str, object], message: str) -> None:
    with pytest.raises(PanelsimError, match=message):
        table.in_sea(**given)  # type: ignore[arg-type]


def test_symmetric_motions_have_no_lateral_period(table: Response) -> None:
    head = table.in_sea(SEA, wave_headings=[np.pi]).squeeze()
    for name in ("zero_crossing_period", "peak_period"):
        lateral = head[name].values[:, [Dof.SWAY, Dof.ROLL, Dof.YAW]]
        assert np.isnan(lateral).all()
        assert np.isfinite(head[name].values[:, [Dof.SURGE, Dof.HEAVE, Dof.PITCH]]).all()
