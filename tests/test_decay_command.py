"""The command `decay`: a case is run, a history or a record read, and the known damping is printed."""

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

from panelsim.case import Case
from panelsim.conventions import Dof
from panelsim.hydro.roll_damping.natural import natural_roll
from panelsim.hydro.store import database_for
from panelsim.motion.history import History
from panelsim.results.export import history_to_csv
from panelsim.studies.roll_decay import run_roll_decay

Call = Callable[..., tuple[int, str, str]]
PERIOD, LINEAR, QUADRATIC = 9.0, 0.04, 0.3


@pytest.fixture
def call(panelsim: Callable[..., tuple[int, str, str]]) -> Callable[..., tuple[int, str, str]]:
    """Call `panelsim decay`: exit code, output, errors."""
    return partial(panelsim, "decay")


@pytest.fixture
def record(tmp_path: Path) -> Callable[[str, float], Path]:
    """A maker of records of a decay with known coefficients, by an integrator that is not that of the fit."""

    def write(column: str, unit: float) -> Path:
        time = np.arange(0.0, 70.0, 0.1)

        def rates(_: float, state: list[float]) -> list[float]:
            roll, rate = state
            pull = (2.0 * np.pi / PERIOD) ** 2 * roll + rate * (LINEAR + QUADRATIC * abs(rate))
            return [rate, -pull]

        run = solve_ivp(rates, (0.0, 70.0), [np.deg2rad(12.0), 0.0], t_eval=time, rtol=1e-9, atol=1e-12)
        path = tmp_path / "tank.csv"
        columns = np.column_stack([np.zeros_like(time), run.y[0] / unit, time])
        np.savetxt(path, columns, delimiter=",", header=f"probe,{column},time [s]", comments="", fmt="%.9g")
        return path

    return write


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    path = tmp_path / "ship.toml"
    path.write_text(
        '[ship]\nhull = "halifax"\npanel_area = 20.0\n[seaway]\nkind = "calm"\n'
        "[run]\nspeed_knots = 0\ntime_step = 0.4\nduration = 100\n"
        "[supplementary]\nstiffness = { surge = 5e5, sway = 1e6, yaw = 2e9 }\ndamping = { sway = 2e6 }\n"
        '[roll_damping]\nmethod = "terms"\nlinear = 1e7\nquadratic = 4e8\n',
        encoding="utf-8",
    )
    return path


def printed(out: str, row: str) -> float:
    found = re.search(rf"{re.escape(row)}\s+(-?[\d.e+-]+)", out)
    assert found, out
    return float(found[1])


@pytest.mark.parametrize(("column", "unit"), [("roll [deg]", np.pi / 180.0), ("roll [rad]", 1.0)])
def test_a_record_gives_its_coefficients_back(
    column: str,
    unit: float,
    call: Call,
    record: Callable[[str, float], Path],
    tmp_path: Path,
    drawn: list[Figure],
) -> None:
    code, out, err = call(record(column, unit))
    assert (code, err) == (0, "")
    # Asked for is 1 %; printed are four digits.
    assert printed(out, "natural period T") == pytest.approx(PERIOD, rel=1e-3)
    assert printed(out, "linear b1") == pytest.approx(LINEAR, rel=1e-3)
    assert printed(out, "quadratic b2") == pytest.approx(QUADRATIC, rel=1e-3)
    ratio = 100.0 * LINEAR * PERIOD / (4.0 * np.pi)
    assert printed(out, "damping ratio, linear") == pytest.approx(ratio, rel=5e-3)
    # 8/(3π) b2 over 2 ω, times ω a.
    with_quadratic = ratio + 100.0 * 4.0 / (3.0 * np.pi) * QUADRATIC * np.deg2rad(12.0)
    assert printed(out, "with b2 at 12°") == pytest.approx(with_quadratic, rel=5e-3)
    assert "runs/tank-decay: decay.png" in out
    assert drawn[0].axes[0].get_title().startswith("tank.csv\nperiod 9")
    assert (tmp_path / "runs/tank-decay/decay.png").stat().st_size > 10_000


def test_a_case_is_run_and_its_terms_come_out(call: Call, case_file: Path, tmp_path: Path) -> None:
    """10 degrees, springs of the case left out; then the same from its history and from its CSV."""
    code, out, err = call(case_file, "--out", tmp_path / "d")
    assert (code, err) == (0, "")
    history = History.load(tmp_path / "d/history.nc")
    assert history.displacement[0, Dof.ROLL] == pytest.approx(np.deg2rad(10.0))
    assert not np.abs(history.loads["supplementary"]).any()
    linear, quadratic = re.search(r"I b1, I b2\s+(\S+) N m s, (\S+) N m s2", out).groups()  # type: ignore[union-attr]
    # Measured 3.5 % and 1.8 %: the radiated waves are in them, and at 10 degrees the stiffness is 5 % softer.
    assert float(linear) == pytest.approx(1e7, rel=0.06)
    assert float(quadratic) == pytest.approx(4e8, rel=0.03)
    natural = natural_roll(Case.load(case_file).ship, database_for(Case.load(case_file).ship))
    assert printed(out, "small roll by the matrices    T") == pytest.approx(natural.period, abs=1e-3)
    again = call(tmp_path / "d/history.nc", "--out", tmp_path / "again")[1]
    spreadsheet, _ = history_to_csv(history, tmp_path)
    third = call(spreadsheet, "--out", tmp_path / "third")[1]
    for row in ("natural period T", "linear b1", "quadratic b2"):
        assert printed(again, row) == printed(third, row) == printed(out, row)


def test_heel_and_overrides_reach_the_run(call: Call, case_file: Path, tmp_path: Path) -> None:
    code, _, _ = call(
        case_file,
        "--heel",
        -4,
        "--set",
        "run.model=linear",
        "--set",
        "roll_damping.quadratic=0",
        "--out",
        "o",
    )
    history = History.load(tmp_path / "o/history.nc")
    assert code == 0
    assert history.displacement[0, Dof.ROLL] == pytest.approx(np.deg2rad(-4.0))
    assert (history.attrs["model"], history.attrs["speed"]) == ("linear", 0.0)


def test_under_way_the_course_is_held(case_file: Path) -> None:
    """At 20 knots a free ship would broach; the stiff course hardly shows in the roll."""
    at_speed = run_roll_decay(Case.load(case_file, ["run.speed_knots=20"]), np.deg2rad(10.0))
    yaw = np.abs(at_speed.history.displacement[:, Dof.YAW])
    assert at_speed.history.outcome == "finished"
    assert yaw.max() < np.deg2rad(0.5)
    assert at_speed.history.loads["supplementary"][:, Dof.YAW].any()
    assert not at_speed.history.loads["supplementary"][:, [0, 1, 3]].any()


def test_a_ship_that_capsizes_ends_early(call: Call, case_file: Path, tmp_path: Path) -> None:
    code, _, err = call(case_file, "--heel", 20, "--set", "run.capsize_angle_deg=10", "--out", "o")
    assert code == 3
    assert "The decay ended early: capsized" in err
    assert (tmp_path / "o/history.nc").is_file()


def test_what_is_refused(
    call: Call, case_file: Path, tmp_path: Path, make_history: Callable[..., History]
) -> None:
    waves = tmp_path / "waves.nc"
    make_history().save(waves)
    texts = {
        "empty.csv": "",
        "degrees.csv": "time [s],roll\n0,1\n",
        "both.csv": "time [s],roll [deg],roll [rad]\n0,1,1\n",
        "text.csv": "time [s],roll [deg]\n0,1\n1,starboard\n",
        "nan.csv": "time [s],roll [deg]\n0,1\n1,nan\n2,1\n",
        "ragged.csv": "time [s],roll [deg]\n0,1\n1,0,5\n",
        "cut.csv": "time [s],roll [deg]\n0,1\n1,0\n2\n",
        "back.csv": "time [s],roll [deg]\n0,1\n\n2,0\n1.5,1\n",
        "short.csv": "time [s],roll [deg]\n0,1\n1,0\n",
        "wrong_unit.csv": "time [s],roll [rad]\n" + "".join(f"{i},{20 * (-1) ** i}\n" for i in range(40)),
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    for arguments, words in (
        (["empty.csv"], "names of its columns"),
        (["degrees.csv"], "names of its columns"),
        (["both.csv"], "names of its columns"),
        (["text.csv"], "line 3 holds no time and roll"),
        (["nan.csv"], "nan.csv, line 3 holds no time and roll"),
        (["ragged.csv"], "line 3 has another number of columns"),
        (["cut.csv"], "line 4 has another number of columns"),
        (["back.csv"], "line 5: the time does not increase.\n  got: 1.5 s after 2 s"),
        (["short.csv"], "ten samples or more"),
        (["wrong_unit.csv"], "no angle in radians"),
        (["nothing.csv"], "no such file"),
        (["ship.obj"], "no roll decay"),
        ([waves], "one in calm water"),
        (["short.csv", "--heel", "5"], "are for a case file"),
        ([case_file, "--heel", "0"], "heel, to either side, is out of range"),
        ([case_file, "--heel", "nan"], "heel, to either side, is out of range"),
        ([case_file, "--heel", "-200"], "got: -200 deg\n  allowed: 0.1 to 60 deg"),
        ([case_file, "--heel", "abc"], "'--heel'.\n  got: \"abc\"\n  allowed: a number"),
        ([case_file, "--out", tmp_path], "not empty"),
    ):
        code, _, err = call(*arguments)
        assert (code, err.startswith("error: ")) == (2, True), err
        assert words in err
