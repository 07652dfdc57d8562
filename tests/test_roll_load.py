"""Roll damping as a load, in runs and in cases: known terms come back out of a decay."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.case.roll_damping_section import rolling_hull
from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.decay import RollDecay, fit_roll_decay
from panelsim.hydro.roll_damping.ikeda import ikeda_terms
from panelsim.hydro.roll_damping.natural import natural_roll
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.store import database_for
from panelsim.loads.load import Instant
from panelsim.loads.roll_damping import RollDamping
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.simulate import simulate_batch
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship
from panelsim.view.report import _facts

Run = Callable[..., History]

HEEL = np.deg2rad(5.0)
FREE = {"supplementary": Supplementary(), "initial_displacement": (0.0, 0.0, 0.0, HEEL, 0.0, 0.0)}
TERMS = RollDampingTerms(1e7, 4e8, 5e9)


def test_each_ship_has_its_own_moment() -> None:
    """-(2 p + 3 p|p| + 5 p³) at p = -2 is 56, and -7 p at p = 0.5 is -3.5; no other force."""
    load = RollDamping([RollDampingTerms(2.0, 3.0, 5.0), RollDampingTerms(7.0)])
    velocity = np.arange(12.0).reshape(2, 6)
    velocity[:, 3] = -2.0, 0.5
    expected = np.zeros((2, 6))
    expected[:, 3] = 56.0, -3.5
    np.testing.assert_allclose(load.evaluate(Instant(0.0, 1.0, velocity, velocity)), expected, rtol=1e-15)


def test_the_slope_is_that_of_the_load_at_rest() -> None:
    load = RollDamping([TERMS, RollDampingTerms(3.0)])
    rest, small = np.zeros((2, 6)), 1e-9
    for column in range(12):
        moved = np.zeros((2, 12))
        moved[:, column] = small
        change = load.evaluate(Instant(0.0, 1.0, moved[:, :6], moved[:, 6:])) / small
        # The quadratic term adds b2/b1 times the rate: 4e-8.
        np.testing.assert_allclose(load.slope[:, :, column], change + rest, rtol=1e-7)


@pytest.mark.parametrize("model", ["nonlinear", "linear"])
def test_linear_damping_is_that_of_the_supplementary_terms(model: str, run_halifax: Run) -> None:
    common = FREE | {"model": model, "duration": 10.0}
    ours = run_halifax(roll_damping=RollDampingTerms(2e7), **common)
    theirs = run_halifax(**(common | {"supplementary": Supplementary(damping={"roll": 2e7})}))
    # The same numbers added in another order: rounding, over 50 steps.
    np.testing.assert_allclose(ours.displacement, theirs.displacement, atol=1e-11)
    np.testing.assert_allclose(ours.loads["roll_damping"], theirs.loads["supplementary"], atol=1e-9 * 2e7)


def test_the_history_has_the_load(run_halifax: Run) -> None:
    """RK4 evaluates the loads where the ship is."""
    history = run_halifax(stepper="rk4", duration=5.0, roll_damping=TERMS, **FREE)
    load = history.loads["roll_damping"]
    np.testing.assert_allclose(load[:, 3], TERMS.moment(history.velocity[:, 3]), rtol=1e-12)
    assert not load[:, [0, 1, 2, 4, 5]].any()
    assert "quadratic 4e+08 N m s2" in _facts(history)["roll damping"]
    without = run_halifax(duration=1.0, **FREE)
    assert "roll_damping" not in without.loads
    assert _facts(without)["roll damping"] == "none beside the supplementary one"


def test_the_slope_at_a_rate_is_that_of_the_moment() -> None:
    """2 b2 |p| + 3 b3 p² against central differences, on either side."""
    load = RollDamping([TERMS, RollDampingTerms(3.0)])
    for rate in (-0.3, 0.2):
        ahead, behind = (np.zeros((2, 6)) for _ in range(2))
        ahead[:, 3], behind[:, 3] = rate + 1e-5, rate - 1e-5
        change = (load.beside_slope(ahead) - load.beside_slope(behind)) / 2e-5
        # A cubic: the differences are off by b3 times the square of 1e-5, a part in 1e10.
        np.testing.assert_allclose(load.slope_beside(rate)[:, :, 3], change, rtol=1e-8)


def test_the_steppers_agree(run_halifax: Run) -> None:
    """The exponential scheme at 0.4 s against RK4 at 0.1 s, damping that halves a roll in two cycles."""
    common = FREE | {"model": "nonlinear", "roll_damping": TERMS, "duration": 20.0}
    fine = run_halifax(stepper="rk4", time_step=0.1, **common).displacement[::4, 3]
    coarse = run_halifax(time_step=0.4, **common).displacement[:, 3]
    # Measured 2.7e-4 of the heel.
    np.testing.assert_allclose(coarse, fine, atol=6e-4 * HEEL)


def test_any_step_is_exact_in_the_linear_model(run_halifax: Run) -> None:
    """The exponential scheme knows the slope of the linear term: 0.1 s and 0.8 s give the same roll."""
    common = FREE | {"model": "linear", "duration": 20.0, "roll_damping": RollDampingTerms(2e7)}
    fine = run_halifax(time_step=0.1, **common).displacement[::8, 3]
    coarse = run_halifax(time_step=0.8, **common).displacement[:, 3]
    # Rounding of some hundred steps.
    np.testing.assert_allclose(coarse, fine, atol=1e-9 * HEEL)


def test_members_of_a_batch_have_their_own(
    run_halifax: Run, halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """Speeds and terms differ: each run has the bits that it has alone."""
    dampings = [RollDampingTerms(), TERMS, RollDampingTerms(3e7)]
    speeds = [0.0, 5.0, 10.0]
    start = (0.0, 0.0, 0.0, HEEL, 0.0, 0.0)
    batch = simulate_batch(
        halifax,
        [CalmSeaway()] * 3,
        speed=speeds,
        duration=6.0,
        time_step=0.2,
        ramp=0.0,
        database=halifax_database,
        supplementary=springs,
        roll_damping=dampings,
        initial_displacement=start,
    )
    for history, speed, terms in zip(batch, speeds, dampings, strict=True):
        alone = run_halifax(speed=speed, duration=6.0, roll_damping=terms, initial_displacement=start)
        np.testing.assert_array_equal(history.displacement, alone.displacement)
        assert history.attrs["roll_damping"] == alone.attrs["roll_damping"]


def test_a_run_goes_on_with_its_own_damping_only(run_halifax: Run) -> None:
    common = FREE | {"model": "nonlinear", "roll_damping": TERMS}
    whole = run_halifax(duration=4.0, **common)
    begun = run_halifax(duration=2.0, **common)
    np.testing.assert_array_equal(
        run_halifax(duration=4.0, resume=begun, **common).displacement, whole.displacement
    )
    # It differs in the sixth digit only.
    other = common | {"roll_damping": replace(TERMS, linear=1.000001e7)}
    with pytest.raises(PanelsimError, match="its roll damping is another"):
        run_halifax(duration=4.0, resume=begun, **other)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"model": "linear", "roll_damping": TERMS}, "linear model takes linear roll damping only"),
        ({"roll_damping": 2e7}, "roll damping is of another kind"),
        ({"roll_damping": {"linear": 2e7}}, "roll damping is of another kind"),
    ],
)
def test_what_no_run_takes(given: dict[str, object], words: str, run_halifax: Run) -> None:
    with pytest.raises(PanelsimError, match=words):
        run_halifax(**given)


@pytest.mark.parametrize("dampings", [[TERMS], [TERMS, None], "none"])
def test_a_batch_needs_one_for_each(dampings: object, halifax: Ship, halifax_database: HydroDatabase) -> None:
    with pytest.raises(PanelsimError, match="roll damping"):
        simulate_batch(
            halifax,
            [CalmSeaway()] * 2,
            speed=0.0,
            duration=1.0,
            time_step=0.2,
            database=halifax_database,
            roll_damping=dampings,  # type: ignore[arg-type]
        )


# --- known terms come back -----------------------------------------------------------------------


@pytest.mark.parametrize("terms", [RollDampingTerms(1e7), RollDampingTerms(1e7, 4e8)])
def test_a_decay_gives_the_terms_back(
    terms: RollDampingTerms, run_halifax: Run, halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """Nonlinear model, from 5 degrees, with the inertia of a ship free to sway and yaw.

    The fit finds what the ship has in all; the damping of the radiated waves, that of the same decay without
    terms, is taken off at half the release, where both amplitudes have been.
    """
    roll = natural_roll(halifax, halifax_database)

    def equivalent(**given: object) -> tuple[float, RollDecay]:
        history = run_halifax(duration=10.0 * roll.period, **FREE, **given)
        fit = fit_roll_decay(history.time, history.displacement[:, 3])
        ratio = fit.equivalent_damping_ratio(0.5 * HEEL)
        return ratio * 4.0 * np.pi / fit.period * roll.inertia, fit

    waves, _ = equivalent()
    total, fit = equivalent(roll_damping=terms)
    wanted = float(terms.equivalent(np.pi / fit.period * HEEL))
    print(f"{100 * ((total - waves) / wanted - 1):+.2f} %, waves {100 * waves / wanted:.1f} % of the terms")
    # Asked for is 1 %; what is left is the stiffness: in a fit from 5 degrees 1.7 % softer.
    assert total - waves == pytest.approx(wanted, rel=0.01)
    if terms.quadratic:
        assert fit.quadratic * roll.inertia == pytest.approx(terms.quadratic, rel=0.01)


def test_natural_roll_and_percent_of_critical(
    run_halifax: Run, halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """5 % of critical in the linear model: the fit has the period of the matrices, and 5 % more damping."""
    roll = natural_roll(halifax, halifax_database)
    assert roll.frequency == pytest.approx(np.sqrt(roll.stiffness / roll.inertia), rel=1e-8)
    terms = RollDampingTerms.of_critical(0.05, roll.inertia, roll.stiffness)
    common = FREE | {"model": "linear", "duration": 10.0 * roll.period}
    damped, bare = (
        fit_roll_decay(run.time, run.displacement[:, 3])
        for run in (run_halifax(roll_damping=terms, **common), run_halifax(**common))
    )
    # Measured 3e-5; the transient of the memory is no part of the fit.
    assert bare.period == pytest.approx(roll.period, rel=2e-4)
    waves = bare.equivalent_damping_ratio(0.5 * HEEL)
    # Measured 0.6 %: the fit has no memory.
    assert damped.equivalent_damping_ratio(0.5 * HEEL) - waves == pytest.approx(0.05, rel=0.01)


def test_a_ship_that_does_not_stand_has_no_natural_roll() -> None:
    ship = load_ship("wigley_i")
    with pytest.raises(PanelsimError, match="does not float upright"):
        natural_roll(ship, database_for(ship))


# --- cases ---------------------------------------------------------------------------------------

NO_ROLL = "[supplementary]\ndamping = { surge = 1e6, sway = 2e6 }\n"


def case(
    tmp_path: Path, table: str, hull: str = "halifax", *, rest: str = NO_ROLL, model: str = "nonlinear"
) -> Case:
    path = tmp_path / "case.toml"
    path.write_text(
        f'[ship]\nhull = "{hull}"\npanel_area = 20.0\n[seaway]\nkind = "calm"\n'
        f'[run]\nspeed_knots = 10\ntime_step = 0.2\nduration = 10\nmodel = "{model}"\n{rest}{table}',
        encoding="utf-8",
    )
    return Case.load(path)


def test_no_roll_damping_is_the_default(tmp_path: Path, halifax_database: HydroDatabase) -> None:
    plain = case(tmp_path, "", rest="")
    assert plain.roll_damping(halifax_database) is None
    assert plain.supplementary.damping["roll"] == 2e7
    assert plain.resolved()["roll_damping"] == {"method": "none"}


def test_terms_and_percent(tmp_path: Path, halifax_database: HydroDatabase) -> None:
    given = case(tmp_path, '[roll_damping]\nmethod = "terms"\nlinear = 1e7\ncubic = 5e9')
    assert given.roll_damping(halifax_database) == RollDampingTerms(1e7, 0.0, 5e9)
    percent = case(tmp_path, '[roll_damping]\nmethod = "percent"\ncritical_percent = 5')
    roll = natural_roll(percent.ship, halifax_database)
    terms = percent.roll_damping(halifax_database)
    assert terms == RollDampingTerms.of_critical(0.05, roll.inertia, roll.stiffness)
    again = Case(type(given.file).model_validate(given.resolved()), tmp_path)
    assert again.resolved() == given.resolved()
    assert again.roll_damping(halifax_database) == RollDampingTerms(1e7, 0.0, 5e9)


def test_ikeda_takes_speed_keels_and_natural_frequency(
    tmp_path: Path, halifax_database: HydroDatabase
) -> None:
    ikeda = case(tmp_path, '[roll_damping]\nmethod = "ikeda"')
    terms, ship = ikeda.roll_damping(halifax_database), ikeda.ship
    assert terms is not None and ship.form is not None
    hull, roll = rolling_hull(ship), natural_roll(ship, halifax_database)
    keels = ship.form.appendages.bilge_keels
    assert terms == ikeda_terms(hull, keels, roll.frequency, 10 * KNOT)
    assert terms.linear > ikeda_terms(hull, keels, roll.frequency, 0.0).linear
    # The keels are most of the damping at ten degrees.
    rate = roll.frequency * np.deg2rad(10.0)
    assert terms.equivalent(rate) > 1.5 * ikeda_terms(hull, (), roll.frequency, 10 * KNOT).equivalent(rate)
    assert not any("bilge keels" in warning for warning in ikeda.warnings())
    # KG 6.26 m over a draft of 4.97 m: the axis is above the water.
    assert hull.axis_depth == pytest.approx(4.97 - 6.26)
    assert (hull.length_pp, hull.beam) == pytest.approx((124.5, 14.8), rel=0.02)


def test_a_hull_without_keels_says_so(tmp_path: Path) -> None:
    naked = case(tmp_path, '[roll_damping]\nmethod = "ikeda"', "s175")
    assert any("no bilge keels" in warning for warning in naked.warnings())
    # Its bulb, which is wider below than at the water, is no section for this method.
    assert 60.0 < rolling_hull(naked.ship).sections.x[-1] < 83.0


def test_the_linear_model_takes_the_same_energy(tmp_path: Path, halifax_database: HydroDatabase) -> None:
    table = '[roll_damping]\nmethod = "terms"\nlinear = 1e7\nquadratic = 4e8\nlinearised_at_deg = 10'
    linear = case(tmp_path, table, model="linear")
    rate = natural_roll(linear.ship, halifax_database).frequency * np.pi / 18.0
    expected = 1e7 + 8.0 / (3.0 * np.pi) * 4e8 * rate
    terms = linear.roll_damping(halifax_database)
    assert terms is not None
    assert (terms.linear, terms.quadratic, terms.cubic) == pytest.approx((expected, 0.0, 0.0), rel=1e-12)
    # The nonlinear model keeps the terms, whatever is said for the other.
    assert case(tmp_path, table).roll_damping(halifax_database) == RollDampingTerms(1e7, 4e8)
    needs = case(tmp_path, '[roll_damping]\nmethod = "terms"\nquadratic = 4e8', model="linear")
    with pytest.raises(PanelsimError, match="linearised_at_deg"):
        needs.roll_damping(halifax_database)
    plain = case(tmp_path, '[roll_damping]\nmethod = "terms"\nlinear = 1e7', model="linear")
    assert plain.roll_damping(halifax_database) == RollDampingTerms(1e7)


@pytest.mark.parametrize("method", ['"ikeda"', '"percent"\ncritical_percent = 5', '"terms"\nlinear = 1e7'])
def test_roll_damping_is_not_counted_twice(method: str, tmp_path: Path) -> None:
    """HALIFAX has 2e7 N m s of her own; the message says what to write, and that is accepted."""
    table = f"[roll_damping]\nmethod = {method}\n"
    with pytest.raises(PanelsimError, match="counted twice") as refused:
        _ = case(tmp_path, table, rest="").supplementary
    remedy = str(refused.value).split("[supplementary] ")[1]
    accepted = case(tmp_path, f"[supplementary]\n{remedy}\n{table}", rest="").supplementary
    assert dict(accepted.damping) == {"surge": 1e6, "sway": 2e6}


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ('method = "lloyd"', "roll_damping.method is not known"),
        ('method = "percent"', "needs critical_percent"),
        ('method = "terms"', "needs linear or quadratic or cubic"),
        ('method = "ikeda"\nlinear = 1e7', "linear has no meaning with method = .ikeda."),
        ('method = "terms"\nlinear = 1e7\ncritical_percent = 5', "critical_percent has no meaning"),
        ("linear = 1e7", "linear has no meaning with method = .none."),
        ('method = "terms"\nquadratic = -1.0', "roll_damping.quadratic is out of range"),
        ('method = "percent"\ncritical_percent = 500', "critical_percent is out of range"),
        ('method = "terms"\nlinear = 1e7\nlinearised_at_deg = 0', "linearised_at_deg is out of range"),
    ],
)
def test_what_no_case_may_say(table: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match=words):
        case(tmp_path, f"[roll_damping]\n{table}\n")


def test_ikeda_needs_sections(tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="needs the sections"):
        case(tmp_path, '[roll_damping]\nmethod = "ikeda"', "box").warnings()
