"""Ships afloat: equilibrium by draft and by mass, axes, trim, water, and what is refused."""

import math

import numpy as np
import pytest

from panelsim.conventions import SALT_WATER_DENSITY, STANDARD_GRAVITY, load_to_earth
from panelsim.errors import PanelsimError
from panelsim.hull.form import bundled_hull_names, load_hull
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.loads.wetted_surface import pressure_force
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.bundled import default_panel_area, load_ship
from panelsim.ship.facts import ship_facts, ship_warnings
from panelsim.ship.ship import Ship


def unbalance(ship: Ship) -> np.ndarray:
    """Force and moment (6,) of buoyancy and weight at rest, in weights and weights times length."""
    load = load_to_earth(pressure_force(ship, CalmSeaway(), 0.0, np.zeros(6)), np.zeros(6))
    weight = ship.mass * ship.gravity
    load[2] -= weight
    return load / (weight * np.array([1, 1, 1, ship.length, ship.length, ship.length]))


def box(**given: object) -> Ship:
    """A box 20 m by 6 m by 4 m, draft 2 m, KG 1.5 m."""
    corners = [(x, y, z) for z in (0.0, 4.0) for x, y in ((-10, -3), (10, -3), (10, 3), (-10, 3))]
    panels = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    mesh = PanelMesh(np.array(corners, dtype=float), np.array(panels))
    defaults = {"draft": 2.0, "center_of_gravity": (None, 0.0, 1.5), "gyradii": (2.0, 5.0, 5.0)}
    return Ship(mesh, **(defaults | given))


@pytest.mark.parametrize("name", bundled_hull_names())
def test_every_bundled_ship_floats_in_balance_as_stated(name: str) -> None:
    """At its draft and trim the kernel finds no residual force or moment beyond 1e-9 of the weight."""
    ship = load_ship(name)
    form = load_hull(name)
    assert ship.draft == pytest.approx(form.draft, abs=1e-12)
    assert ship.trim_by_stern == pytest.approx(form.trim_by_stern, abs=1e-9)
    # Hydrostatics by NumPy on one side, the compiled kernel on the other.
    assert np.abs(unbalance(ship)).max() < 1e-9


def test_frigate_and_halifax_float_as_the_reports_say(halifax: Ship) -> None:
    """Waterlines −1.8 m and draft − KG; HALIFAX within 1 % of 4655 t in fresh water; GM of the frigate.

    HALIFAX is the frigate stretched: KB goes with the draft, BM with beam² / draft.
    """
    frigate = load_ship("frigate")
    assert frigate.waterline == pytest.approx(-1.8, abs=2e-3)
    # Draft 4.97 m, KG 6.26 m; the 0.04 m of trim by the stern moves it by less than 1 mm.
    assert halifax.waterline == pytest.approx(4.97 - 6.26, abs=1e-3)
    assert halifax.trim == pytest.approx(math.atan(0.04 / 124.5))  # Table 2: by the bow
    facts, rest = ship_facts(halifax), frigate.hydrostatics
    print(f"halifax {halifax.mass / 1000:.0f} t, GM {facts.gm_transverse:.3f} m, wet {facts.panels_wet}")
    assert facts.water_density == 1000.0
    assert halifax.mass == pytest.approx(4655e3, rel=0.01)
    # TM 2004-041 Table 3 has 1.398 m; the lines of its Annex B give 1.428 m on ever finer panels.
    assert rest.gm_transverse == pytest.approx(1.428, abs=0.01)
    assert rest.gm_transverse == pytest.approx(1.398, rel=0.03)
    height = rest.center_of_buoyancy[2]
    radius = rest.gm_transverse + 6.0 - height
    deeper, beamier = 4.97 / 4.2, (14.8 / 14.106) ** 2
    # Two panellings, and the trim of 0.04 m.
    assert facts.gm_transverse == pytest.approx(height * deeper + radius * beamier / deeper - 6.26, abs=0.01)


def test_box_has_the_mass_and_the_axes_of_its_closed_form() -> None:
    """Mass ρLBT; ship axes from the CG, so that the keel lies KG below and the water T − KG above."""
    ship = box()
    assert ship.mass == pytest.approx(SALT_WATER_DENSITY * 20 * 6 * 2, rel=1e-14)
    np.testing.assert_allclose(ship.center_of_gravity, [0.0, 0.0, 1.5], atol=1e-14)
    assert ship.waterline == pytest.approx(0.5, abs=1e-15)
    assert ship.vertices[:, 2].min() == pytest.approx(-1.5, abs=1e-15)
    np.testing.assert_allclose(np.diag(ship.inertia), ship.mass * np.array([1, 1, 1, 4, 25, 25]), rtol=1e-14)
    assert ship.hydrostatics.gm_transverse == pytest.approx(1.0 + 6**2 / (12 * 2.0) - 1.5, rel=1e-12)
    assert not ship.vertices.flags.writeable


def test_mass_alone_finds_the_draft_and_mass_with_x_the_trim_too() -> None:
    """A box of mass ρLBT sinks to T; with its CG forward it goes bow down by x/GM_L, bow down positive."""
    mass = SALT_WATER_DENSITY * 20 * 6 * 1.5
    level = box(mass=mass)
    assert level.draft == pytest.approx(1.5, abs=1e-9)
    assert level.trim == 0.0
    forward = box(mass=mass, center_of_gravity=(0.5, 0.0, 1.5))
    metacentre = 0.75 + 20**2 / (12 * 1.5) - 1.5
    # Wall-sided: tan θ (GM_L + ½ BM tan²θ) = x, third order in 0.03.
    assert math.tan(forward.trim) == pytest.approx(0.5 / metacentre, rel=2e-3)
    assert forward.trim > 0
    assert forward.trim_by_stern < 0
    bow, stern = (forward.to_ship_axes(np.array([x, 0.0, 0.0]))[2] for x in (10.0, -10.0))
    assert bow < stern
    for ship in (level, forward, box(mass=mass, center_of_gravity=(-0.5, 0.0, 1.5))):
        assert ship.mass == mass
        assert np.abs(unbalance(ship)).max() < 1e-9


def test_halifax_with_a_mass_finds_draft_and_trim(halifax: Ship) -> None:
    """5 % more mass sinks her by Δm/(ρ A_wp); CG moved forward 1 m trims by m g x/C55; both balance."""
    heavier = load_ship("halifax", 5.0, mass=1.05 * halifax.mass)
    sinkage = 0.05 * halifax.mass / (1000.0 * halifax.hydrostatics.waterplane_area)
    # The waterplane grows by a few per cent on the way.
    assert heavier.draft - halifax.draft == pytest.approx(sinkage, rel=0.05)
    assert heavier.trim_by_stern == pytest.approx(-0.04, abs=1e-9)
    x, y, z = halifax.center_of_gravity
    forward = load_ship("halifax", 5.0, mass=halifax.mass, center_of_gravity=(x + 1.0, y, z))
    weight = halifax.mass * halifax.gravity
    turn = weight * 1.0 / halifax.hydrostatics.stiffness[4, 4]
    assert forward.trim - halifax.trim == pytest.approx(turn, rel=0.1)
    for ship in (heavier, forward):
        assert np.abs(unbalance(ship)).max() < 1e-9
        # Panelled to the waterline found: none is cut at rest.
        side = np.sign(ship.vertices[ship.mesh.panels][..., 2] - ship.waterline)
        assert not ((side > 0).any(axis=1) & (side < 0).any(axis=1)).any()


def test_fresh_water_floats_less_and_a_given_mass_deeper() -> None:
    """At one draft the mass goes with the density; at one mass the draft goes against it."""
    salt, fresh = load_ship("wigley_iii", water_density=1025.0), load_ship("wigley_iii", water_density=1000.0)
    assert salt.mass / fresh.mass == pytest.approx(1.025, rel=1e-12)
    deep = box(mass=box().mass, water_density=1000.0)
    assert deep.draft == pytest.approx(2.0 * 1.025, rel=1e-9)


def test_gravity_changes_forces_and_not_flotation() -> None:
    heavy = box(gravity=2 * STANDARD_GRAVITY)
    assert heavy.mass == box().mass
    np.testing.assert_allclose(heavy.hydrostatics.stiffness, 2 * box().hydrostatics.stiffness, rtol=1e-12)


def test_geosim_has_the_cube_of_the_mass_and_the_same_shape() -> None:
    """A frigate scaled by 2 in all three: mass ×8, GM ×2, stiffness ρgL² ×4 and ρgL⁴ ×16."""
    form = load_hull("frigate")
    large = form.scaled(length=2 * form.length_pp, beam=2 * form.beam, draft=2 * form.draft)
    one, two = load_ship(form, 4.0), load_ship(large, 16.0)
    assert len(one.mesh.panels) == len(two.mesh.panels)
    assert two.mass / one.mass == pytest.approx(8.0, rel=1e-9)
    assert two.hydrostatics.gm_transverse / one.hydrostatics.gm_transverse == pytest.approx(2.0, rel=1e-9)
    ratio = np.diag(two.hydrostatics.stiffness)[2:5] / np.diag(one.hydrostatics.stiffness)[2:5]
    np.testing.assert_allclose(ratio, [4.0, 16.0, 16.0], rtol=1e-9)


def test_another_panel_size_is_the_same_ship(halifax: Ship) -> None:
    """Same draft, trim and KG; the identity by which databases are found agrees; mass within 0.5 %."""
    coarse = halifax.at_panel_area(5.0)
    assert len(coarse.mesh.panels) < 0.7 * len(halifax.mesh.panels)
    assert coarse.draft == halifax.draft
    assert coarse.trim == pytest.approx(halifax.trim, abs=1e-12)
    assert coarse.mass == pytest.approx(halifax.mass, rel=5e-3)
    one, other = halifax.identity(), coarse.identity()
    assert one["form"] == other["form"]
    # The CG moves with the centre of buoyancy of the mesh, a decimetre at most.
    assert one["center_of_gravity_x"] == pytest.approx(other["center_of_gravity_x"], abs=0.1)
    assert {k: v for k, v in one.items() if k != "center_of_gravity_x"} == pytest.approx(
        {k: v for k, v in other.items() if k != "center_of_gravity_x"}
    )
    assert box().at_panel_area(1.0).mesh.panels.shape == (6, 4)


def test_identity_tells_ships_apart() -> None:
    plain, higher = box().identity(), box(center_of_gravity=(None, 0.0, 1.6)).identity()
    assert plain["form"] == higher["form"]
    assert plain["center_of_gravity_z"] != higher["center_of_gravity_z"]
    assert load_ship("wigley_i").identity()["form"] != load_ship("wigley_ii").identity()["form"]


def test_default_panels_are_some_eight_hundred_below_the_water() -> None:
    for name in ("frigate", "mine_hunter", "s175"):
        wet = load_ship(name, default_panel_area(load_hull(name))).hydrostatics.panels_wet
        print(name, wet)
        # The wetted surface is estimated; a factor of 1.5 either way is the same kind of mesh.
        assert 550 < wet < 1200


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"draft": 0.0}, "draft is not positive"),
        ({"draft": np.nan}, "draft is not positive"),
        ({"draft": 5.0}, "wholly under water"),
        ({"mass": -1.0}, "mass is not positive"),
        ({"mass": 1e9}, "cannot float with this mass"),
        ({"gyradii": (2.0, 0.0, 5.0)}, "gyradius_pitch is not positive"),
        ({"center_of_gravity": (1.0, 0.0, 1.5)}, "needs a mass"),
        ({"center_of_gravity": (None, 0.1, 1.5)}, "the ship would list"),
        ({"center_of_gravity": (None, 0.0, np.inf)}, "not finite"),
        ({"mass": 1e5, "center_of_gravity": (0.0, 0.1, 1.5)}, "list"),
        ({"water_density": 1.025}, "not that of water"),
        ({"gravity": -9.81}, "gravity is not positive"),
        ({"trim": 1.5}, "No ship floats at this trim"),
        ({"gyradii": (2.0, 5.0)}, "three numbers each"),
        ({"center_of_gravity": (0.0, 1.0)}, "three numbers each"),
        ({"center_of_gravity": (None, 0.0, None)}, "three numbers each"),
        ({"draft": "deep"}, "not given in numbers"),
    ],
)
def test_a_loading_that_no_ship_can_have_is_refused(given: dict[str, object], words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        box(**given)


@pytest.mark.parametrize(
    "loading",
    [{"mass": 3900e3}, {"mass": 4655e3, "center_of_gravity": (6.0, 0.0, 6.3)}, {"draft": 4.2}],
    ids=["light", "trimmed by the bow", "shallow"],
)
def test_a_ship_that_lifts_its_transom_floats_all_the_same(loading: dict[str, object]) -> None:
    """Its panels cannot follow the water there and are cut by it: equilibrium holds as for any other."""
    ship = load_ship("halifax", 5.0, **loading)
    assert ship.straddling_panels > 0
    assert any("are cut by" in warning for warning in ship_warnings(ship))
    weight = ship.mass * ship.gravity
    load = pressure_force(ship, CalmSeaway(), 0.0, np.zeros(6))
    load[2] -= weight
    # Newton and the kernel both to rounding.
    assert np.abs(load[:3]).max() < 1e-9 * weight
    assert np.abs(load[3:]).max() < 1e-9 * weight * ship.length
    assert load_ship("halifax", 5.0).straddling_panels == 0


def test_tonnes_for_kilograms_are_refused() -> None:
    form = load_hull("halifax")
    with pytest.raises(PanelsimError, match="masses are in kg"):
        Ship(
            form.panel(10.0),
            draft=form.draft,
            mass=4655.0,
            center_of_gravity=(None, 0.0, 6.26),
            gyradii=(5.8, 28.8, 28.8),
        )
