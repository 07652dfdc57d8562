"""Righting arms on a frozen wave: closed forms of a box, the loads of runs, symmetry, refusals."""

import numpy as np
import pytest

from panelsim.conventions import load_to_earth
from panelsim.errors import PanelsimError
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.loads.wetted_surface import pressure_force
from panelsim.seaway.regular import RegularSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.righting import righting_arm
from panelsim.ship.ship import Ship
from panelsim.studies.righting import FrozenWave, righting_arm_in_wave

HEELS = np.deg2rad([0.0, 15.0, 30.0, 60.0, 90.0, 150.0])
LENGTH, BEAM, DRAFT, KG = 40.0, 6.0, 2.0, 2.0
WAVE = FrozenWave(LENGTH, 1.2)


def box_ship(depth: float = 5.0, draft: float = DRAFT, count: int = 32) -> Ship:
    """A box 40 m long and 6 m broad, in `count` panels along its length and two along its height."""
    x = np.linspace(-0.5 * LENGTH, 0.5 * LENGTH, count + 1)
    rim = np.array([[-3.0, 0.0], [3.0, 0.0], [3.0, draft], [3.0, depth], [-3.0, depth], [-3.0, draft]])
    vertices = np.array([[station, *point] for station in x for point in rim])
    ring = np.arange(6)
    first = 6 * np.arange(count)[:, None]
    sides = np.stack([first + ring, first + 6 + ring, first + 6 + (ring + 1) % 6, first + (ring + 1) % 6], -1)
    end = np.array([[0, 1, 2, 5], [5, 2, 3, 4]])
    panels = np.concatenate([sides.reshape(-1, 4)[:, ::-1], end[:, ::-1], end + 6 * count])
    return Ship(
        PanelMesh(vertices, panels), draft=draft, center_of_gravity=(None, 0.0, KG), gyradii=(2.0, 10.0, 10.0)
    )


@pytest.fixture(scope="module")
def box() -> Ship:
    return box_ship()


@pytest.fixture(scope="module")
def frigate() -> Ship:
    return load_ship("frigate", 10.0)


@pytest.mark.parametrize("crest", [0.0, 0.5 * LENGTH])
def test_a_box_on_a_wave_of_its_length_under_hydrostatic_pressure(crest: float) -> None:
    """Draft d = T + a cos kx: no heave, no trim, GM = ∫ ½ d² / ∫ d + BM - KG, with ∫ d² = (T² + ½ a²) L."""
    wave = FrozenWave(LENGTH, 1.2, crest)
    gm = (DRAFT**2 + 0.5 * 0.6**2) / (2.0 * DRAFT) + BEAM**2 / (12.0 * DRAFT) - KG
    error = []
    for count in (16, 32, 64):
        found = righting_arm_in_wave(box_ship(count=count), [-0.1, 0.0, 0.1], wave, pressure="hydrostatic")
        assert found.trim == pytest.approx(np.zeros(3), abs=1e-9)
        error.append(abs(found.gm - gm) + abs(found.heave[1]))
    assert error[2] < 2e-4  # chords of 5.6 degrees of the wave
    assert np.log2(error[0] / error[2]) / 2.0 == pytest.approx(2.0, abs=0.3)  # second order in their length
    # Wall-sided: GZ = sin φ (GM + ½ BM tan² φ), and along the turned hull the wave is a / cos φ high.
    steeper = 0.5 * 0.6**2 * np.tan(0.1) ** 2 / (2.0 * DRAFT)
    expected = np.sin(0.1) * (gm + steeper + 0.5 * BEAM**2 / (12.0 * DRAFT) * np.tan(0.1) ** 2)
    assert found.arm == pytest.approx([-expected, 0.0, expected], abs=2e-5)


def test_a_crest_forward_lifts_the_bow(box: Ship) -> None:
    """Small waves: ∫ ζ x dx = -θ L³/12, for a crest a quarter of a wave forward ζ = a sin kx."""
    wave = FrozenWave(LENGTH, 0.02, 0.25 * LENGTH)
    found = righting_arm_in_wave(box, [0.0, 0.1], wave, pressure="hydrostatic")
    moment = 0.01 * LENGTH**2 / (2.0 * np.pi)  # ∫ a sin(kx) x dx
    stiffness = LENGTH**3 / 12.0 + LENGTH * DRAFT * (0.5 * DRAFT - KG)
    assert found.trim[0] == pytest.approx(-moment / stiffness, rel=5e-3)  # chords, and trim squared
    assert found.heave[0] == pytest.approx(0.0, abs=1e-5)


def test_a_longer_crest_lifts_the_box(box: Ship) -> None:
    """Hydrostatic: heave = mean ζ = 2a/(kL) sin(kL/2), 2a/π for a wave of twice the length."""
    found = righting_arm_in_wave(box, [0.0, 0.1], FrozenWave(2 * LENGTH, 0.5), pressure="hydrostatic")
    assert found.heave[0] == pytest.approx(0.5 / np.pi, rel=1e-3)  # chords


@pytest.mark.parametrize("crest", [0.0, 20.0, -35.0])
def test_the_balance_is_that_of_the_loads_of_runs(frigate: Ship, crest: float) -> None:
    """By default: the same pressure at the pose found gives the weight, no trimming moment, and the arm."""
    length = 100.0
    wave = FrozenWave(length, 5.0, crest)
    found = righting_arm_in_wave(frigate, HEELS, wave)
    midships = float(frigate.to_ship_axes(np.array([0.0, 0.0, frigate.draft]))[0])
    wavenumber = 2.0 * np.pi / length
    sea = RegularSeaway(
        2.5, float(np.sqrt(frigate.gravity * wavenumber)), 0.0, (midships + crest) * wavenumber
    )
    weight = frigate.mass * frigate.gravity
    for heel, arm, heave, trim in zip(found.heel, found.arm, found.heave, found.trim, strict=True):
        displacement = np.array([0.0, 0.0, heave, heel, trim, 0.0])
        load = load_to_earth(pressure_force(frigate, sea, 0.0, displacement), displacement) / weight
        assert load[2] == pytest.approx(1.0, abs=1e-9)  # the balance, ten times
        assert load[4] / frigate.length == pytest.approx(0.0, abs=1e-9)
        # Nothing pushes sideways, so the moment about the keel's axis is that of the arm turned by the trim,
        # less the moment about the vertical that the push along the wave makes.
        assert load[3] == pytest.approx(-arm * np.cos(trim) - load[5] * np.sin(trim), abs=1e-8)
        assert load[1] == pytest.approx(0.0, abs=1e-4)  # of the weight: quadrature


@pytest.mark.parametrize("pressure", ["wheeler", "hydrostatic"])
def test_in_a_vanishing_wave_it_is_the_curve_of_calm_water(frigate: Ship, pressure: str) -> None:
    calm = righting_arm(frigate, HEELS)
    found = righting_arm_in_wave(frigate, HEELS, FrozenWave(100.0, 1e-8), pressure=pressure)
    for name in ("arm", "heave", "trim"):
        np.testing.assert_allclose(getattr(found, name), getattr(calm, name), atol=2e-8)
    assert found.gm == pytest.approx(calm.gm, abs=1e-6)
    assert found.vanishing_heel == pytest.approx(calm.vanishing_heel, abs=1e-6)
    held = righting_arm_in_wave(frigate, HEELS, FrozenWave(100.0, 1e-8), pressure=pressure, free_trim=False)
    np.testing.assert_allclose(held.arm, righting_arm(frigate, HEELS, free_trim=False).arm, atol=2e-8)
    assert (held.trim == 0.0).all()


def test_a_ship_loses_stability_on_a_crest_and_gains_it_in_a_trough(frigate: Ship) -> None:
    """As ever with broad ends above the water, by both pressures; hydrostatics lifts the ship higher."""
    crest, trough = FrozenWave(120.0, 6.0), FrozenWave.trough_amidships(120.0, 6.0)
    calm = righting_arm(frigate, HEELS[:4])
    for pressure in ("wheeler", "hydrostatic"):
        on, between = (
            righting_arm_in_wave(frigate, HEELS[:4], wave, pressure=pressure) for wave in (crest, trough)
        )
        assert on.gm < calm.gm - 0.3 < calm.gm + 0.3 < between.gm
        assert on.greatest_arm < calm.greatest_arm < between.greatest_arm
        assert (on.water, between.water) == ("crest amidships", "trough amidships")
        assert between.heave[0] < 0.0 < on.heave[0]
    assert on.heave[0] > righting_arm_in_wave(frigate, HEELS[:4], crest).heave[0] + 0.2


def test_mirror_images(box: Ship) -> None:
    fore, aft = (
        righting_arm_in_wave(box, [-0.6, -0.3, 0.3, 0.6], FrozenWave(50.0, 2.0, x)) for x in (7.0, -7.0)
    )
    np.testing.assert_allclose(fore.arm, aft.arm, atol=1e-8)
    np.testing.assert_allclose(fore.trim, -aft.trim, atol=1e-8)
    np.testing.assert_allclose(fore.arm, -fore.arm[::-1], atol=1e-8)
    assert fore.trim[1] < -1e-3
    assert (fore.water, aft.water) == ("crest 7 m forward of midships", "crest 7 m aft of midships")


class TestRefusals:
    def test_a_ship_that_its_freeboard_does_not_carry_on_a_crest(self) -> None:
        """Pressure under Wheeler's crest grows by ρ g (1 - ka) with depth: 5 % of reserve are too few."""
        ship = box_ship(depth=2.1, draft=2.0)
        wave = FrozenWave(200.0, 20.0)
        with pytest.raises(PanelsimError, match=r"(?s)sinks on this wave.*under water"):
            righting_arm_in_wave(ship, HEELS, wave)
        found = righting_arm_in_wave(ship, HEELS[:3], wave, pressure="hydrostatic")
        assert 0.0 < found.heave[0] < 10.0  # its displaced water weighs what it does in calm water

    def test_a_ship_that_would_float_only_deep_below_the_crest(self) -> None:
        """There the wave has decayed, and 8 % of reserve are enough; at the surface they are too few."""
        with pytest.raises(
            PanelsimError, match=r"(?s)sinks on this wave.*a balance only [\d.]+ m under water"
        ):
            righting_arm_in_wave(box_ship(depth=2.16), HEELS, FrozenWave(100.0, 14.0))

    @pytest.mark.parametrize(
        ("wave", "message"),
        [
            ((100.0, 15.0), r"(?s)steeper than waves can be.*0\.150.*0\.142"),
            ((0.0, 1.0), "wave_length is not positive"),
            ((100.0, -1.0), "wave_height is not positive"),
            ((100.0, np.nan), "wave_height is not positive"),
            ((True, 1.0), "wave_length is not positive"),
            ((100.0, 1.0, 120.0), r"(?s)position of the crest.*-100 to 100 m"),
            ((100.0, 1.0, np.inf), "position of the crest"),
            ((100.0, 1.0, "amidships"), "position of the crest is not a number"),
        ],
    )
    def test_waves_that_are_none(self, wave: tuple[float, ...], message: str) -> None:
        with pytest.raises(PanelsimError, match=message):
            FrozenWave(*wave)

    def test_an_unknown_pressure(self, box: Ship) -> None:
        with pytest.raises(PanelsimError, match=r"(?s)not known.*'static'.*wheeler \| hydrostatic"):
            righting_arm_in_wave(box, HEELS, WAVE, pressure="static")

    def test_heels_in_degrees(self, box: Ship) -> None:
        with pytest.raises(PanelsimError, match=r"(?s)heel angles.*deg2rad"):
            righting_arm_in_wave(box, [0.0, 10.0], WAVE)
