"""Points of the ship in a run: rigid-body kinematics, the waves at the point, and the transfer functions."""

import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.cli import main
from panelsim.conventions import KNOT, rotation_to_earth
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.history import History
from panelsim.motion.point_motions import point_motions, point_signals, with_points
from panelsim.motion.simulate import simulate, simulate_batch
from panelsim.response.response import response
from panelsim.results.export import history_to_csv
from panelsim.results.statistics import statistics
from panelsim.results.tables import point_markdown
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.seaways import CalmSeaway
from panelsim.ship.points import POINT_UNITS
from panelsim.ship.ship import Ship
from panelsim.view.report import report

MakeHistory = Callable[..., History]
Run = Callable[..., History]
EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
BOW = (55.0, 5.0, 12.0)
WAVE = WaveComponents(np.array([0.02]), np.array([0.7]), np.array([2.4]), np.array([0.3]))


@pytest.fixture(scope="module")
def tumbling(make_history: MakeHistory) -> History:
    """Six motions of large angles, each a sinusoid of its own, with their exact rates."""
    time = np.arange(0.0, 8.0, 1e-3)
    size = np.array([2.0, 1.5, 1.0, 0.9, 0.6, 0.8])
    omega = np.array([0.7, 0.9, 1.1, 1.3, 0.8, 0.6])
    phase = omega * time[:, None] + np.arange(6.0)
    return make_history(
        time=time,
        displacement=size * np.sin(phase),
        velocity=size * omega * np.cos(phase),
        acceleration=-size * omega**2 * np.sin(phase),
        wave_elevation=0.0 * time,
        loads={},
        components=WAVE,
        ramp=3.0,
        time_step=1e-3,
    )


def test_the_point_is_carried_by_the_turned_ship(tumbling: History, barge: Ship) -> None:
    """η123 + R arm − arm with the matrix of the conventions, row by row; to round-off."""
    point = np.array([8.0, -2.0, 5.0])
    arm = barge.to_ship_axes(point)
    found = point_motions(tumbling, point)["displacement"].values
    for i in (0, 1234, 7000):
        motion = tumbling.displacement[i]
        np.testing.assert_allclose(
            found[i], motion[:3] + rotation_to_earth(*motion[3:]) @ arm - arm, atol=1e-13
        )


def test_a_ship_with_trim_lies_turned_in_her_axes(make_history: MakeHistory, barge: Ship) -> None:
    """Points are given in hull axes: the arm and the height over the water are those of the ship afloat."""
    trimmed = Ship(
        barge.mesh, draft=2.0, trim=0.05, center_of_gravity=(None, 0.0, 1.5), gyradii=(2.0, 5.0, 5.0)
    )
    history = make_history(ship=trimmed)
    point = np.array([8.0, -2.0, 5.0])
    arm = trimmed.to_ship_axes(point)
    found = point_motions(history, point)
    motion = history.displacement[17]
    expected = motion[:3] + rotation_to_earth(*motion[3:]) @ arm - arm
    np.testing.assert_allclose(found["displacement"].values[17], expected, atol=1e-13)
    # The bow lies deeper: 8 m ahead by 8 tan(0.05), and a metre of height is shorter by the cosine.
    assert found.attrs["height_above_water"] == pytest.approx(3.0 * np.cos(0.05) - 8.0 * np.sin(0.05))


def test_velocity_and_acceleration_are_the_rates_of_the_displacement(tumbling: History) -> None:
    """Central differences over 1 ms err by some 1e-6 of rates of order ten: 1e-5."""
    found = point_motions(tumbling, (8.0, -2.0, 5.0))
    for of, rate in (("displacement", "velocity"), ("velocity", "acceleration")):
        slope = (found[of].values[2:] - found[of].values[:-2]) / 2e-3
        assert np.abs(slope).max() > 3.0
        np.testing.assert_allclose(found[rate].values[1:-1], slope, atol=1e-5)


def test_a_ship_that_turns_steadily_pulls_its_points_inwards(make_history: MakeHistory, barge: Ship) -> None:
    """At yaw 90° and r rad/s: a point ahead of the CG by l lies to port, moves aft at r l, feels −r² l."""
    count, rate, ahead = 5, 0.3, 7.0
    zero = np.zeros((count, 6))
    displacement, velocity = zero.copy(), zero.copy()
    displacement[:, 5], velocity[:, 5] = np.pi / 2, rate
    history = make_history(
        time=np.arange(count, dtype=float),
        displacement=displacement,
        velocity=velocity,
        acceleration=zero,
        wave_elevation=np.zeros(count),
        loads={},
    )
    found = point_motions(history, barge.center_of_gravity + np.array([ahead, 0.0, 0.0]))
    same = {"atol": 1e-14, "rtol": 0.0}
    np.testing.assert_allclose(found["displacement"].values[0], [-ahead, ahead, 0.0], **same)
    np.testing.assert_allclose(found["velocity"].values[0], [-rate * ahead, 0.0, 0.0], **same)
    np.testing.assert_allclose(found["acceleration"].values[0], [0.0, -(rate**2) * ahead, 0.0], **same)


@pytest.mark.parametrize("model", ["nonlinear", "linear"])
def test_the_wave_is_taken_where_the_model_has_it(
    tumbling: History, make_history: MakeHistory, barge: Ship, model: str
) -> None:
    """a cos(k(x cos β − y sin β) − ω_e t − ε) by hand, grown over the ramp; rest height is left out."""
    history = make_history(
        time=tumbling.time,
        displacement=tumbling.displacement,
        velocity=tumbling.velocity,
        acceleration=tumbling.acceleration,
        wave_elevation=tumbling.wave_elevation,
        loads={},
        components=WAVE,
        ramp=3.0,
        model=model,
    )
    point = (8.0, -2.0, 5.0)
    found = point_motions(history, point)
    moved = found["displacement"].values
    (a,), (omega,), (beta,), (lead,) = WAVE.amplitude, WAVE.frequency, WAVE.wave_heading, WAVE.phase
    k = omega**2 / barge.gravity
    x, y = (barge.to_ship_axes(np.array(point)) + (moved if model == "nonlinear" else 0.0 * moved)).T[:2]
    encounter = omega - k * history.attrs["speed"] * np.cos(beta)
    t = history.time
    ramp = np.where(t < 3.0, 0.5 * (1.0 - np.cos(np.pi * t / 3.0)), 1.0)
    wave = ramp * a * np.cos(k * (x * np.cos(beta) - y * np.sin(beta)) - encounter * t - lead)
    np.testing.assert_allclose(found["relative_motion"].values, moved[:, 2] - wave, atol=1e-13)
    # The box floats at 2 m: its point at 5 m is 3 m above the water.
    assert found.attrs["height_above_water"] == pytest.approx(3.0)


def test_small_motions_are_those_of_the_transfer_functions(
    halifax: Ship, halifax_database: HydroDatabase
) -> None:
    """All ten signals, waves from port and from starboard, from ahead and overtaken, nonlinear kinematics.

    0.5 % of the peak of each kind, as for the six motions themselves; the waves of 1 cm make no more than
    1e-4 by their size.
    """
    springs = Supplementary(
        stiffness={"surge": 5e5, "sway": 1e6, "yaw": 2e9},
        damping={"surge": 1e6, "sway": 2e6, "roll": 2e7, "yaw": 2e9},
    )
    omega = np.array([0.4, 0.6, 0.85])
    courses = [(20.0, 120.0), (20.0, 240.0), (10.0, -30.0), (0.0, 45.0)]
    amplitude, lead = 0.01, 0.4
    seas = [
        WaveComponents(np.full(3, amplitude), omega, np.full(3, np.deg2rad(beta)), np.full(3, lead))
        for _, beta in courses
    ]
    histories = simulate_batch(
        halifax,
        [SimpleNamespace(kind="regular", components=sea) for sea in seas],  # type: ignore[misc]
        speed=[knots * KNOT for knots, _ in courses],
        duration=440.0,
        time_step=0.1,
        database=halifax_database,
        model="linear",
        supplementary=springs,
        points={"bow": BOW},
    )
    kinds = np.array([0, 0, 0, 1, 1, 1, 2, 2, 2, 3])
    for history, sea, (knots, beta) in zip(histories, seas, courses, strict=True):
        last = history.time >= 200.0
        encounter = sea.encounter_frequency(knots * KNOT, halifax.gravity)
        phase = np.outer(history.time[last], encounter)
        basis = np.hstack([np.cos(phase), -np.sin(phase), np.ones((last.sum(), 1))])
        columns = np.array([*point_signals(history.points["bow"]).values()])[:, last].T
        fit = np.linalg.lstsq(basis, columns, rcond=None)[0]
        # A lead ε of the crest: cos(… − ω_e t − ε) = Re e^{iε} e^{iω_e t} at the origin.
        in_time = (fit[:3] + 1j * fit[3:-1]) / (amplitude * np.exp(1j * lead))
        table = response(
            halifax,
            halifax_database,
            frequencies=omega,
            wave_headings=[np.deg2rad(beta)],
            speeds=[knots * KNOT],
            supplementary=springs,
        )
        expected = table.at(BOW).transfer[0, 0]
        peak = np.array([np.abs(expected[:, kinds == kind]).max() for kind in kinds])
        worst = np.abs(in_time - expected) / peak
        print(knots, beta, np.round(100 * worst.max(axis=0), 2))
        assert worst.max() < 0.005


def test_a_run_that_goes_on_has_the_same_points(run_halifax: Run, tmp_path: Path) -> None:
    """Bit for bit, as all else; so are those of the beginning of a longer run, and of the saved history."""
    settings = {"points": {"bow": BOW, "keel": (0.0, 0.0, 0.0)}, "speed": 5.0}
    whole = run_halifax(WAVE, duration=12.0, **settings)
    begun = run_halifax(WAVE, duration=5.0, **settings)
    assert run_halifax(WAVE, duration=12.0, resume=begun, **settings).same_bits(whole)
    rows = len(begun.time)
    for name, motions in begun.points.items():
        for key, column in point_signals(motions).items():
            assert column.tobytes() == point_signals(whole.points[name])[key][:rows].tobytes()
    assert set(whole.points) == {"bow", "keel"}
    assert not whole.points["bow"].identical(whole.points["keel"])
    again = History.load(whole.save(tmp_path / "history.nc"))
    assert again.same_bits(whole)
    np.testing.assert_array_equal(again.points["bow"].attrs["point"], BOW)
    with pytest.raises(ValueError, match="read-only"):
        again.points["bow"]["displacement"].values[0] = 1.0


def test_points_can_be_asked_for_later(run_halifax: Run) -> None:
    before = run_halifax(WAVE, duration=5.0, points={"bow": BOW})
    later = with_points(run_halifax(WAVE, duration=5.0), {"bow": BOW})
    assert later.same_bits(before)
    more = with_points(later, {"keel": (0.0, 0.0, 0.0)})
    assert set(more.points) == {"bow", "keel"}
    assert with_points(more, {}) is more


def test_a_diverged_run_keeps_what_is_a_number(make_history: MakeHistory) -> None:
    history = make_history()
    displacement, velocity = history.displacement.copy(), history.velocity.copy()
    displacement[200:, 4], velocity[199, 5] = np.nan, np.inf
    found = point_motions(make_history(displacement=displacement, velocity=velocity), (5.0, 1.0, 3.0))
    whole = point_motions(history, (5.0, 1.0, 3.0))
    assert np.isnan(found["displacement"].values[200:]).all()
    assert np.isnan(found["relative_motion"].values[200:]).all()
    np.testing.assert_array_equal(found["displacement"].values[:200], whole["displacement"].values[:200])


def test_statistics_tables_and_csv_tell_the_points(make_history: MakeHistory, tmp_path: Path) -> None:
    history = with_points(make_history(), {"bridge": (5.0, 1.0, 3.0)})
    found = statistics(history)
    after = history.time >= 12.0
    column = history.points["bridge"]["acceleration"].values[after, 2]
    assert found.points["bridge"]["acceleration_z"].rms == column.std()
    assert tuple(found.points["bridge"]) == tuple(POINT_UNITS)
    assert '"rms_m/s2"' in found.to_json()
    assert "points" not in statistics(make_history()).to_json()
    page = report(history, tmp_path).read_text(encoding="utf-8")
    assert point_markdown(found, "bridge") in page
    assert "5 m forward of midships, 1 m to port, 3 m above the baseline; at rest 1 m above the water" in page
    motions, _ = history_to_csv(history, tmp_path)
    heads = motions.read_text().splitlines()[0].split(",")
    assert heads[-1] == "bridge_relative_motion [m]" and "bridge_velocity_x [m/s]" in heads
    table = np.loadtxt(motions, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(table[:, -1], history.points["bridge"]["relative_motion"].values)


def test_a_case_names_its_points(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """`panelsim check` and `panelsim run` of a case with [points]."""
    given = ["--set", "points.bridge=[20.0, 0.0, 15.0]", "--set", "ship.panel_area=40"]
    short = ["--set", "run.duration=4", "--set", "run.ramp=2", "--out", str(tmp_path / "run")]
    printed = []
    for words in (["check", str(EXAMPLE), *given], ["run", str(EXAMPLE), *given, *short]):
        monkeypatch.setattr(sys, "argv", ["panelsim", *words])
        with pytest.raises(SystemExit) as end:
            main()
        assert not end.value.code
        printed.append(capsys.readouterr().out)
    assert "bridge at 20, 0, 15 m" in printed[0]
    assert "bridge" in printed[1] and "relative motion" in printed[1]
    history = History.load(tmp_path / "run" / "history.nc")
    np.testing.assert_array_equal(history.points["bridge"].attrs["point"], [20.0, 0.0, 15.0])
    assert '"bridge": [20.0, 0.0, 15.0]' in history.attrs["case"]


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("points.bridge=[20000.0, 0.0, 15000.0]", ["bridge lies far off the ship", "diagonals"]),
        ("points.bridge=[20.0, 0.0]", ["points.bridge", "wrong length"]),
        ("points.bridge=[20.0, 0.0, nan]", ["points.bridge", "finite"]),
        ("points.bridge=20", ["points.bridge", "list"]),
        ("points={'a/b'=[20.0, 0.0, 15.0]}", ["cannot have this name", "a/b"]),
        ("points.1=[20.0, 0.0, 15.0]", ["cannot have this name"]),
        ("point.bridge=[20.0, 0.0, 15.0]", ["did you mean points"]),
    ],
)
def test_points_that_make_no_sense_are_refused(override: str, words: list[str]) -> None:
    with pytest.raises(PanelsimError) as error:
        _ = Case.load(EXAMPLE, ["ship.panel_area=40", override]).points
    assert all(word in str(error.value) for word in words), error.value


@pytest.mark.parametrize(
    "points",
    [[(1.0, 2.0, 3.0)], {"bow": (1.0, 2.0)}, {"bow": "x"}, {"bow": (1e4, 0.0, 0.0)}, {"": BOW}, {7: BOW}],
)
def test_a_run_refuses_them_before_it_begins(
    halifax: Ship, halifax_database: HydroDatabase, points: object
) -> None:
    with pytest.raises(PanelsimError, match="point"):
        simulate(
            halifax,
            CalmSeaway(),
            speed=0.0,
            duration=1e5,
            time_step=0.5,
            database=halifax_database,
            points=points,  # type: ignore[arg-type]
        )
