"""Linear coefficients as derivatives of the nonlinear load: in the wave amplitude and in the motions."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import panelsim.loads.derivatives
import panelsim.loads.froude_krylov
from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.kernels import oracle
from panelsim.kernels.tables import panel_tables, wave_tables
from panelsim.loads.derivatives import pressure_stiffness
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.load import Instant
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.regular import RegularSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

HEADINGS = np.deg2rad([180.0, 130.0, 90.0, 20.0])
PARTS = (slice(0, 3), slice(3, 6))


# --- hulls ---------------------------------------------------------------------------------------


def afloat(mesh: PanelMesh, draft: float, *, height: float, trim: float = 0.0) -> Ship:
    """A ship on a mesh at a draft and trim [m, rad], its CG at a height [m] above the baseline."""
    return Ship(mesh, draft=draft, trim=trim, center_of_gravity=(None, 0.0, height), gyradii=(1.0, 5.0, 5.0))


def deeper(ship: Ship, rise: float, trim: float) -> Ship:
    """The same mesh, with the water where it cuts panels: a part of the draft higher, and trimmed."""
    moved = afloat(ship.mesh, (1.0 + rise) * ship.draft, height=float(ship.center_of_gravity[2]), trim=trim)
    assert moved.straddling_panels > 10
    return moved


def catamaran() -> Ship:
    """Two Wigley hulls 0.8 m apart, trimmed so that the water cuts their panels."""
    demi = load_ship("wigley_iii", 0.01).mesh
    sides = [demi.vertices + np.array([0.0, y, 0.0]) for y in (-0.4, 0.4)]
    panels = np.concatenate([demi.panels, demi.panels + len(demi.vertices)])
    mesh = PanelMesh(np.concatenate(sides), panels)
    twin = afloat(mesh, 0.17, height=0.2, trim=0.006)
    assert twin.straddling_panels > 10
    return twin


HULLS: dict[str, Callable[[], Ship]] = {
    "box": lambda: load_ship("box", 4.0),
    "cut box": lambda: deeper(load_ship("box", 4.0), 0.07, 0.01),
    "wigley": lambda: load_ship("wigley_i", 0.01),
    "cut wigley": lambda: deeper(load_ship("wigley_i", 0.01), -0.1, 0.005),
    "halifax": lambda: load_ship("halifax", 10.0),
    "cut halifax": lambda: deeper(load_ship("halifax", 10.0), 0.08, 0.01),
    "catamaran": catamaran,
}
ENDS_AT_WATER = ("box", "wigley", "halifax")


@cache
def hull(name: str) -> Ship:
    return HULLS[name]()


def waves(ship: Ship, length: float) -> WaveComponents:
    """Waves of a length [m] from ahead, the bow, the side and astern."""
    omega = np.sqrt(2.0 * np.pi * ship.gravity / length)
    return WaveComponents(np.ones(4), np.full(4, omega), HEADINGS, np.zeros(4))


# --- derivative in the wave amplitude ------------------------------------------------------------


@dataclass(frozen=True)
class InWaves:
    """The nonlinear load of a ship at rest in each of some waves alone, from the plain twin of the kernel."""

    ship: Ship
    components: WaveComponents
    stretching: str = "wheeler"

    def load(self, turn: float, amplitudes: list[float]) -> FloatArray:
        """Load (M, B, 6) at a phase ω_e t [rad] in each wave with each amplitude [m], troughs negative."""
        panels = panel_tables(self.ship.vertices, self.ship.mesh.panels)
        poses = np.zeros((len(amplitudes), 8))
        poses[:, 0], poses[:, 1] = turn, amplitudes
        return np.array(
            [
                oracle.wetted_surface_load(
                    panels,
                    wave_tables(1.0, k, beta, 1.0, 0.0),
                    poses,
                    waterline=self.ship.waterline,
                    water_density=self.ship.water_density,
                    gravity=self.ship.gravity,
                    stretching=self.stretching,
                )
                for k, beta in zip(
                    self.components.wavenumber(self.ship.gravity), self.components.wave_heading, strict=True
                )
            ]
        )

    def slope(self) -> ComplexArray:
        """Derivative (M, 6) with the amplitude, exp(+iω_e t), by central differences at two phases.

        The flare of a hull is another above the water than below it, so crest and trough differ in second
        order and a difference is off by a part of the amplitude; half the amplitude cancels it.
        """
        a = 2e-5 * self.ship.draft
        slopes = []
        for turn in (0.0, np.pi / 2.0):
            load = self.load(turn, [a, -a, a / 2.0, -a / 2.0])
            slopes.append(2.0 * (load[:, 2] - load[:, 3]) / a - (load[:, 0] - load[:, 1]) / (2.0 * a))
        # Re(X e^{iωt}) is Re X at the first phase and -Im X a quarter turn later.
        return slopes[0] - 1j * slopes[1]


def misfit(found: ComplexArray, expected: ComplexArray) -> float:
    """Largest difference of forces and of moments, each over the largest of its kind in all waves."""
    return max(float(np.abs((found - expected)[:, p]).max() / np.abs(expected[:, p]).max()) for p in PARTS)


@pytest.mark.parametrize("share", [0.25, 1.0])
@pytest.mark.parametrize("name", HULLS)
def test_linear_load_is_the_derivative_of_the_nonlinear_one(name: str, share: float) -> None:
    """Panels that end at the water or are cut by it, waves of a quarter of the ship's length and of it."""
    ship = hull(name)
    sea = waves(ship, share * ship.length)
    found, expected = froude_krylov_transfer(ship, sea), InWaves(ship, sea).slope()
    error = misfit(found, expected)
    print(f"{name}, wave {share:g} L: {error:.1e}")
    # Third order leaves (2e-5 draft/panel)², rounding 1e-16/2e-5 of the buoyancy; 1e-6 is asked for.
    assert error < 1e-7
    # A phase turned round, or one part in a thousand, would be seen.
    assert misfit(found.conj(), expected) > 1e-2
    assert misfit(1.001 * found, expected) > 5e-4


@pytest.mark.parametrize("name", ["cut box", "cut wigley", "cut halifax", "catamaran"])
def test_bend_of_cut_panels_is_in_it(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without it, which left out a part of the load before, the comparison above fails."""
    ship = hull(name)
    sea = waves(ship, 0.25 * ship.length)
    expected = InWaves(ship, sea).slope()
    module = panelsim.loads.froude_krylov
    whole = module._add_bend

    def of_wet_panels(*given: np.ndarray) -> None:
        *tables, depth, of_panel, force = given
        wet = (depth[of_panel] >= 0.0).all(axis=1)
        whole(*tables, depth, of_panel[wet], force[wet])

    monkeypatch.setattr(module, "_add_bend", of_wet_panels)
    error = misfit(froude_krylov_transfer(ship, sea), expected)
    print(f"{name} without the bend of cut panels: {error:.1e}")
    assert error > 1e-5


@pytest.mark.parametrize("name", ["wigley", "halifax"])
def test_vertices_on_the_waterline_have_one_derivative_from_both_sides(name: str) -> None:
    """Crest alone and trough alone tend to it, and part in proportion to the amplitude."""
    ship = hull(name)
    sea = waves(ship, ship.length)
    expected, flow = froude_krylov_transfer(ship, sea).real, InWaves(ship, sea)
    amplitudes = ship.draft * np.array([1e-2, 1e-3, 1e-4])
    calm = flow.load(0.0, [0.0])
    for side in (1.0, -1.0):
        load = flow.load(0.0, list(side * amplitudes))
        slope = (load - calm) / (side * amplitudes)[None, :, None]
        error = [misfit(slope[:, i], expected) for i in range(3)]
        order = np.polyfit(np.log(amplitudes), np.log(error), 1)[0]
        print(f"{name}, {'crest' if side > 0 else 'trough'}: {error}, order {order:.2f}")
        # What is left is of first order in the slope, of second in the load, flare jump or not.
        assert order == pytest.approx(1.0, abs=0.1)
        assert error[-1] < 1e-3


def test_a_deck_in_the_water_surface_counts_as_dry() -> None:
    """A raft whose deck lies in the surface, behind a box: the linear load is that of a trough."""
    corners = np.array([(x, y, z) for z in (0.0, 1.0) for x, y in ((0, -3), (9, -3), (9, 3), (0, 3))], float)
    faces = np.array(
        [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)], dtype=np.int64
    )
    raft, box = corners * [1, 1, 2] - [10, 0, 0], corners * [1, 1, 4] + [1, 0, 0]
    ship = afloat(PanelMesh(np.concatenate([raft, box]), np.concatenate([faces, faces + 8])), 2.0, height=1.5)
    sea, a = waves(ship, 200.0), 1e-6
    flow = InWaves(ship, sea)
    rise, calm, fall = np.moveaxis(flow.load(0.0, [a, 0.0, -a]), 1, 0)
    trough, crest = (calm - fall) / a, (rise - calm) / a
    linear = froude_krylov_transfer(ship, sea).real
    # The load of second order, a over the draft, and rounding 1e-16/1e-6.
    assert misfit(trough, linear) < 1e-5
    # A crest on the deck presses it down by ρ g times its area at once.
    deck = ship.water_density * ship.gravity * 54.0
    pressed = (linear - crest)[:, Dof.HEAVE]
    k = sea.wavenumber(ship.gravity)[0]
    assert pressed == pytest.approx(deck * np.ones(4), rel=(10.0 * k) ** 2)


@pytest.mark.parametrize("name", HULLS)
def test_waves_without_end_lift_and_push_as_hydrostatics_say(name: str) -> None:
    """X tends to C η for a lift of 1 m, and its part of first order in k to the thrust of a sloping sea.

    A pressure that is linear in space is integrated exactly, on cut panels too: the force is
    ρ g ∇ times the slope, downhill, in the direction of the crest to come.
    """
    ship = hull(name)
    k = 1e-6 / ship.length
    sea = WaveComponents(np.ones(4), np.full(4, np.sqrt(ship.gravity * k)), HEADINGS, np.zeros(4))
    found = froude_krylov_transfer(ship, sea)
    stiffness = ship.hydrostatics.stiffness
    lift = np.broadcast_to(stiffness[:, Dof.HEAVE], (4, 6))
    # k L is left out of every component; the moments in heave's arms of a tenth of the length.
    unit = stiffness[Dof.HEAVE, Dof.HEAVE] * np.array([1.0] * 3 + [0.1 * ship.length] * 3)
    assert np.abs((found.real - lift) / unit).max() < 3e-6
    slope = ship.mass * ship.gravity * k * np.column_stack([np.cos(HEADINGS), -np.sin(HEADINGS)])
    np.testing.assert_allclose(found[:, :2].imag, slope, rtol=0, atol=1e-5 * np.abs(slope).max())


@pytest.mark.parametrize("name", ["cut box", "cut halifax", "halifax"])
def test_head_seas_push_an_upright_ship_neither_sideways_nor_about(name: str) -> None:
    ship = hull(name)
    found = froude_krylov_transfer(ship, waves(ship, ship.length))[0]
    # Rounding of a thousand terms that cancel in pairs.
    for across, along in ((Dof.SWAY, Dof.SURGE), (Dof.ROLL, Dof.PITCH), (Dof.YAW, Dof.PITCH)):
        assert abs(found[across]) < 1e-12 * max(abs(found[along]), abs(found[Dof.HEAVE]))


@pytest.mark.parametrize("name", ENDS_AT_WATER)
def test_without_stretching_the_derivative_is_the_same_where_panels_end_at_the_water(name: str) -> None:
    ship = hull(name)
    sea = waves(ship, ship.length)
    assert misfit(froude_krylov_transfer(ship, sea), InWaves(ship, sea, "none").slope()) < 1e-7


def cut_box(rows: int) -> Ship:
    """A box of 20 x 4 x 4 m in panels as many over its depth, calm water through the middle of a row."""
    step = 4.0 / rows
    ship = afloat(load_ship("box", step**2).mesh, 2.0 + step / 2.0, height=1.5)
    assert ship.straddling_panels > 0
    return ship


def test_without_stretching_cut_panels_differ_by_the_square_of_their_size() -> None:
    sizes, errors = [], []
    for rows in (4, 8, 16):
        ship = cut_box(rows)
        sea = waves(ship, 10.0)
        errors.append(misfit(froude_krylov_transfer(ship, sea), InWaves(ship, sea, "none").slope()))
        sizes.append(4.0 / rows)
    order = np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    print(f"panels of {sizes} m: {errors}, order {order:.2f}")
    assert order == pytest.approx(2.0, abs=0.3)
    assert errors[0] > 1e-4


# --- linear and nonlinear runs meet in small waves ------------------------------------------------


SPEED, TIME = 7.0, 13.0  # m/s, s


def seaway(amplitude: float, ship: Ship, wave_length: float, heading: float) -> RegularSeaway:
    omega = float(np.sqrt(2.0 * np.pi * ship.gravity / wave_length))
    return RegularSeaway(amplitude, omega, heading, 0.8)


def relative_difference(ship: Ship, amplitude: float, linear: ComplexArray, wave_length: float) -> float:
    """Of the nonlinear wave load at rest at speed from Re(a X exp(i(ω_e t + ε))), over the largest |a X|."""
    differences = []
    for transfer, heading in zip(linear, HEADINGS, strict=True):
        sea = seaway(amplitude, ship, wave_length, float(heading)).components
        wetted = WettedSurface(ship, [sea], [SPEED])
        moment = [Instant(TIME, factor, np.zeros((1, 6)), np.zeros((1, 6))) for factor in (1.0, 0.0)]
        dynamic = (wetted.evaluate(moment[0]) - wetted.evaluate(moment[1]))[0]
        turn = sea.encounter_frequency(SPEED, ship.gravity)[0] * TIME + sea.phase[0]
        differences.append(dynamic / amplitude - (transfer * np.exp(1j * turn)).real)
    error = np.abs(differences)
    return max(float(error[:, p].max() / np.abs(linear[:, p]).max()) for p in PARTS)


@pytest.mark.parametrize("share", [0.5, 1.0, 2.0])
def test_small_waves_load_a_ship_at_rest_as_the_linear_coefficients_say(share: float, halifax: Ship) -> None:
    """Waves of 1 mm within 1e-4, and a difference that grows with the amplitude, of second order."""
    length = share * halifax.length
    linear = froude_krylov_transfer(halifax, waves(halifax, length))
    amplitudes = np.array([1e-3, 1e-2, 1e-1])
    errors = [relative_difference(halifax, a, linear, length) for a in amplitudes]
    order = np.polyfit(np.log(amplitudes), np.log(errors), 1)[0]
    print(f"wave {share:g} L: {errors}, order {order:.2f}")
    assert errors[0] < 1e-4
    # First order of the relative difference; a wrong coefficient would not fall at all.
    assert order == pytest.approx(1.0, abs=0.15)
    for mistaken in (linear.conj(), 1.001 * linear, np.roll(linear, 1, axis=0)):
        assert relative_difference(halifax, 1e-3, mistaken, length) > 5e-4


def test_small_motions_in_small_waves_are_loaded_by_both_together(halifax: Ship) -> None:
    """Buoyancy, weight and waves about rest are −C η + Re(a X exp(i(ω_e t + ε))), both of one size."""
    amplitude, length = 1e-3, halifax.length
    motion = amplitude * np.array([0.0, 0.0, 0.7, 0.02, -0.01, 0.0])
    for transfer, heading in zip(
        froude_krylov_transfer(halifax, waves(halifax, length)), HEADINGS, strict=True
    ):
        sea = seaway(amplitude, halifax, length, float(heading)).components
        wetted = WettedSurface(halifax, [sea], [SPEED])
        load = wetted.evaluate(Instant(TIME, 1.0, motion[None], np.zeros((1, 6))))[0]
        load[Dof.HEAVE] -= halifax.mass * halifax.gravity
        turn = sea.encounter_frequency(SPEED, halifax.gravity)[0] * TIME + sea.phase[0]
        wave_part = amplitude * (transfer * np.exp(1j * turn)).real
        restoring = -halifax.hydrostatics.stiffness @ motion
        scale = amplitude * np.array([halifax.hydrostatics.stiffness[2, 2]] * 3 + [abs(transfer[4])] * 3)
        # Motion and waves act on each other in second order, 1 mm over metres.
        assert np.abs((load - wave_part - restoring) / scale).max() < 1e-3
        assert np.abs((load - wave_part + restoring) / scale).max() > 0.1


# --- derivative in the motions -------------------------------------------------------------------


def scale(ship: Ship) -> FloatArray:
    """Of each entry of a stiffness (6, 6): heave, roll and pitch at rest, and what they say of the others."""
    heave, roll, pitch = np.abs(np.diag(ship.hydrostatics.stiffness))[2:5]
    root = np.sqrt([heave, heave, heave, roll, pitch, pitch])
    return np.outer(root, root)


SEA = WaveComponents(
    np.array([0.9, 0.6, 0.4]), np.array([0.5, 0.8, 1.1]), np.array([2.6, 0.7, 4.4]), np.array([0.3, 2.0, 5.1])
)
POSE = (2.0, -3.0, 0.4, 0.3, 0.02, -0.2)


@pytest.mark.parametrize("rule", ["vertex", "vertex+centre"])
@pytest.mark.parametrize("name", HULLS)
def test_stiffness_at_rest_is_that_of_the_hydrostatics(name: str, rule: str) -> None:
    """Calm water lifts exactly by either rule, and the weight, constant at the CG, has no stiffness."""
    ship = hull(name)
    error = np.abs((pressure_stiffness(ship, rule=rule) - ship.hydrostatics.stiffness) / scale(ship)).max()
    print(f"{name}, {rule}: {error:.1e}")
    # Rounding of the differences; a plain central one is off by up to 2e-5 here, 1e-7 is asked for.
    assert error < 5e-9


# A row of vertices within a step of the water leaves the most.
@example(heave=1.4e-4, angles=(0.0, 0.0, 0.0), rule="vertex+centre")
@settings(deadline=None, max_examples=15)
@given(
    heave=st.floats(-1.5, 1.5),
    angles=st.tuples(st.floats(-1.0, 1.0), st.floats(-0.08, 0.08), st.floats(-6.0, 6.0)),
    rule=st.sampled_from(["vertex", "vertex+centre"]),
)
def test_stiffness_in_calm_water_is_symmetric_at_any_attitude(
    heave: float, angles: tuple[float, float, float], rule: str
) -> None:
    """Buoyancy has a potential, so conjugate loads have a symmetric stiffness; moments in ship axes have not.

    Nor does it care where the ship is or where her bow points.
    """
    ship = hull("halifax")
    found = pressure_stiffness(ship, displacement=(3.0, -2.0, heave, *angles), rule=rule) / scale(ship)
    # Where the kinks of such a row are not cancelled: 4e-6; elsewhere 1e-7.
    np.testing.assert_allclose(found, found.T, rtol=0, atol=1e-5)
    np.testing.assert_allclose(found[[0, 1, 5]], 0.0, atol=1e-8)


@pytest.mark.parametrize("stretching", ["wheeler", "none"])
@pytest.mark.parametrize("rule", ["vertex", "vertex+centre"])
def test_stiffness_in_waves_is_the_slope_of_the_load_of_each_choice(rule: str, stretching: str) -> None:
    """Against plain central differences of the twin of the kernel, with another step."""
    ship = hull("halifax")
    sea = SimpleNamespace(kind="given", components=SEA)
    choice = {"rule": rule, "stretching": stretching}
    found = pressure_stiffness(ship, sea, TIME, POSE, speed=SPEED, **choice)
    steps = np.diag([1e-3] * 3 + [1e-4] * 3)
    expected = np.empty((6, 6))
    for dof in range(6):
        moved = np.array([POSE + steps[dof], POSE - steps[dof]])
        wetted = WettedSurface(ship, [SEA, SEA], [SPEED] * 2, method="oracle", **choice)
        ahead, behind = wetted.evaluate(Instant(TIME, 1.0, moved, np.zeros((2, 6))))
        expected[:, dof] = (behind - ahead) / (2.0 * steps[dof, dof])
    # The plain step crosses the kinks of a few panels.
    assert np.abs((found - expected) / scale(ship)).max() < 2e-5
    calm = pressure_stiffness(ship, displacement=POSE, **choice)
    assert np.abs((calm - expected) / scale(ship))[:, 3].max() > 1e-3


def test_each_choice_has_a_stiffness_of_its_own() -> None:
    """Rule, stretching, time and speed all reach the load; the compiled kernel and its twin agree."""
    ship, sea = hull("halifax"), SimpleNamespace(kind="given", components=SEA)
    usual = pressure_stiffness(ship, sea, TIME, POSE, speed=SPEED)
    for other in ({"rule": "vertex"}, {"stretching": "none"}, {"speed": 0.0}, {"time": 0.0}):
        found = pressure_stiffness(ship, sea, **{"time": TIME, "displacement": POSE, "speed": SPEED} | other)
        assert np.abs((found - usual) / scale(ship)).max() > 1e-5
    twin = pressure_stiffness(ship, sea, TIME, POSE, speed=SPEED, method="oracle")
    # Rounding of both, 1e-15 of the buoyancy over the step.
    assert np.abs((twin - usual) / scale(ship)).max() < 2e-8


def test_a_ship_that_surges_meets_a_following_wave_as_if_time_ran_back() -> None:
    """∂F/∂η1 = −(k/ω_e) ∂F/∂t where one wave follows: the phase is k x − ω_e t."""
    ship = hull("cut halifax")
    following = RegularSeaway(1.5, 0.6, 0.0, 0.4)
    found, sea = (
        pressure_stiffness(ship, following, TIME, POSE, speed=2.0)[:, Dof.SURGE],
        following.components,
    )
    wetted, step = WettedSurface(ship, [sea], [2.0]), 1e-4
    late, early = (
        wetted.evaluate(Instant(TIME + s, 1.0, np.array([POSE]), np.zeros((1, 6))))[0] for s in (step, -step)
    )
    ratio = sea.wavenumber(ship.gravity)[0] / sea.encounter_frequency(2.0, ship.gravity)[0]
    expected = ratio * (late - early) / (2.0 * step)
    root = scale(ship)[:, 0]
    assert np.abs((found - expected) / root).max() < 1e-6
    assert np.abs((found + expected) / root).max() > 1e-2


def test_half_steps_cancel_the_kink_at_the_waterline(monkeypatch: pytest.MonkeyPatch) -> None:
    """The error at rest falls with the step squared; that of plain central differences with the step."""
    ship = hull("halifax")
    rest = ship.hydrostatics.stiffness

    def order(weights: list[float]) -> float:
        monkeypatch.setattr(panelsim.loads.derivatives, "WEIGHTS", np.array(weights))
        steps, errors = np.array([4e-3, 1e-3, 2.5e-4]), []
        for step in steps:
            monkeypatch.setattr(panelsim.loads.derivatives, "STEP", step)
            errors.append(np.abs((pressure_stiffness(ship) - rest) / scale(ship)).max())
        print(f"weights {weights}: {errors}")
        return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])

    assert order([-0.5, 0.5, 2.0, -2.0]) == pytest.approx(2.0, abs=0.2)
    assert order([0.5, -0.5, 0.0, 0.0]) == pytest.approx(1.0, abs=0.2)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"displacement": np.zeros(5)}, "not six finite numbers"),
        ({"displacement": np.zeros((1, 6))}, "not six finite numbers"),
        ({"displacement": (0, 0, np.nan, 0, 0, 0)}, "not six finite numbers"),
        ({"displacement": (0, 0, 0, np.inf, 0, 0)}, "not six finite numbers"),
        ({"displacement": "upright"}, "not six finite numbers"),
        ({"displacement": (0, 0, 0, 25.0, 0, 0)}, r"25\.0[\s\S]*for 25 degrees"),
        ({"time": np.nan}, "time is out of range"),
        ({"speed": np.inf}, "speed is out of range"),
        ({"rule": "panel"}, r"no derivative[\s\S]*panel[\s\S]*vertex"),
        ({"rule": "simpson"}, "simpson"),
        ({"stretching": "airy"}, "airy"),
        ({"method": "magic"}, "magic"),
    ],
)
def test_what_has_no_stiffness_is_refused(arguments: dict, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        pressure_stiffness(hull("box"), **arguments)


def test_no_waves_have_no_coefficients_and_ripples_no_overflow() -> None:
    """exp(k z) of a ripple of 1 cm is beyond all numbers at the deck, where it does not act."""
    assert froude_krylov_transfer(hull("box"), NO_WAVES).shape == (0, 6)
    assert np.isfinite(froude_krylov_transfer(hull("halifax"), waves(hull("halifax"), 0.01))).all()
