"""Statistics against closed forms, and their tables and files."""

import io
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from panelsim.conventions import DOF_NAMES
from panelsim.motion.history import History
from panelsim.results.export import history_to_csv
from panelsim.results.statistics import statistics, zero_crossing_period
from panelsim.results.tables import statistics_markdown, statistics_table

MakeHistory = Callable[..., History]


def test_a_sinusoid_has_its_closed_form(make_history: MakeHistory) -> None:
    """Over whole periods: RMS a/√2 about the mean, extremes mean ± a, crossings a period apart."""
    # The ramp of 12 s and 56 s of sea are whole numbers of half periods; 32 samples a period.
    history = make_history(duration=68.0)
    # the last sample closes the period and is one too many for exact means
    cut = {n: getattr(history, n)[:-1] for n in ("time", "displacement", "velocity", "acceleration")}
    history = make_history(
        **cut,
        wave_elevation=history.wave_elevation[:-1],
        loads={name: values[:-1] for name, values in history.loads.items()},
    )
    result = statistics(history)
    assert result.duration == pytest.approx(55.75)
    for name, amplitude, mean in zip(
        DOF_NAMES, (0.5, 0.3, 1.2, 0.08, 0.04, 0.02), (0.2, -0.1, 0.3, 0.01, -0.02, 0.0), strict=True
    ):
        motion = result.motions[name]
        assert motion.mean == pytest.approx(mean, abs=1e-14)
        assert motion.rms == pytest.approx(amplitude / np.sqrt(2.0), rel=1e-12)
        # The crest may fall half a sample, π/32, beside one: 1 − cos(π/32) = 0.5 %.
        assert motion.max == pytest.approx(mean + amplitude, abs=0.005 * amplitude)
        assert motion.min == pytest.approx(mean - amplitude, abs=0.005 * amplitude)
        # Linear interpolation errs alike at every up-crossing of a signal sampled evenly.
        assert motion.zero_crossing_period == pytest.approx(8.0, rel=1e-9)
    assert result.significant_wave_height_realised == pytest.approx(4.0 * 0.9 / np.sqrt(2.0), rel=1e-12)
    assert result.realtime_factor == pytest.approx(67.75 / 0.5)


def test_max_is_up_and_min_is_down(make_history: MakeHistory) -> None:
    history = make_history()
    displacement = history.displacement.copy()
    displacement[100, 2], displacement[120, 2] = 7.0, -3.0
    heave = statistics(make_history(displacement=displacement)).motions["heave"]
    assert (heave.max, heave.min) == (7.0, -3.0)


def test_the_ramp_does_not_count(make_history: MakeHistory) -> None:
    history = make_history(ramp=12.0, step=0.25)
    displacement = history.displacement.copy()
    displacement[:48] = 1e6  # all rows before t = 12 s
    assert statistics(make_history(displacement=displacement)).motions == statistics(history).motions
    displacement[48, 0] = 1e6  # the row at t = ramp does count
    assert statistics(make_history(displacement=displacement)).motions["surge"].max == 1e6


def test_crossings_are_up_crossings_of_the_mean() -> None:
    time = np.arange(0.0, 40.0, 0.1)
    # Two crossings up a period of 10 s, with a dip that stays above the mean between them.
    signal = 5.0 + np.sin(2 * np.pi * time / 10.0)
    # 0.1 s samples of a 10 s sinusoid: linear interpolation errs by 1e-5 of the step at most
    assert zero_crossing_period(time, signal) == pytest.approx(10.0, abs=1e-3)
    assert zero_crossing_period(time[:100], signal[:100]) is None  # one up-crossing only
    assert zero_crossing_period(time, np.full(len(time), 0.1)) is None
    # Round-off about a constant is no oscillation.
    ripple = 0.1 + 1e-16 * np.sign(np.sin(3.0 * time))
    assert zero_crossing_period(time, ripple) is None


def test_json_says_its_units_and_has_degrees(make_history: MakeHistory) -> None:
    result = statistics(make_history())
    data = json.loads(result.to_json())
    assert set(data["roll"]) == {"mean_deg", "rms_deg", "max_deg", "min_deg", "zero_crossing_period_s"}
    assert set(data["heave"]) == {"mean_m", "rms_m", "max_m", "min_m", "zero_crossing_period_s"}
    assert data["roll"]["rms_deg"] == pytest.approx(np.rad2deg(result.motions["roll"].rms))
    assert data["heave"]["rms_m"] == result.motions["heave"].rms
    assert set(DOF_NAMES) | {"wave_elevation", "realtime_factor", "outcome"} <= set(data)
    assert data["realtime_factor"] == pytest.approx(120.0)  # 60 s in half a CPU second


def test_a_run_shorter_than_its_ramp_has_no_statistics_and_says_so(make_history: MakeHistory) -> None:
    history = make_history(
        duration=10.0, outcome="capsized", outcome_detail="at t = 10 s", cpu_seconds=np.nan
    )
    data = json.loads(statistics(history).to_json())
    assert data["heave"] == dict.fromkeys(data["heave"])
    assert data["significant_wave_height_realised_m"] is None
    assert data["realtime_factor"] is None
    assert "before its ramp of 12 s" in data["note"]
    assert data["outcome_detail"] == "at t = 10 s"


def test_a_diverged_run_is_counted_up_to_the_first_number_that_is_none(make_history: MakeHistory) -> None:
    displacement = make_history().displacement.copy()
    displacement[200:, 4] = np.inf
    displacement[201:, :] = np.nan
    result = statistics(make_history(displacement=displacement, outcome="diverged"))
    whole = statistics(make_history(duration=49.75))
    assert result.motions == whole.motions
    assert "t = 50 s" in result.note
    json.loads(result.to_json())


def test_tables_show_seven_signals_with_their_units(make_history: MakeHistory) -> None:
    result = statistics(make_history())
    stream = io.StringIO()
    Console(file=stream, width=150).print(statistics_table(result))
    rms = f"{np.rad2deg(result.motions['roll'].rms):.3f}"
    for text in (stream.getvalue(), statistics_markdown(result)):
        roll = next(line for line in text.splitlines() if "roll" in line)
        assert "deg" in roll
        assert rms in roll
        assert "8.00" in roll
        assert sum(name in text for name in (*DOF_NAMES, "wave elevation")) == 7
    # What is not defined is a dash, no number.
    roll = next(
        x for x in statistics_markdown(statistics(make_history(duration=5.0))).splitlines() if "roll" in x
    )
    assert roll == "| roll | deg | – | – | – | – | – |"


def test_csv_gives_every_number_back_bit_for_bit(make_history: MakeHistory, tmp_path: Path) -> None:
    history = make_history()
    motions, loads = history_to_csv(history, tmp_path / "run")
    head = motions.read_text().splitlines()[0].split(",")
    table = np.loadtxt(motions, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(table[:, 0], history.time)
    np.testing.assert_array_equal(table[:, head.index("displacement_roll [rad]")], history.displacement[:, 3])
    np.testing.assert_array_equal(
        table[:, head.index("acceleration_yaw [rad/s2]")], history.acceleration[:, 5]
    )
    head = loads.read_text().splitlines()[0].split(",")
    table = np.loadtxt(loads, delimiter=",", skiprows=1)
    assert len(head) == 1 + 2 * 6
    np.testing.assert_array_equal(
        table[:, head.index("wetted_surface_pitch [N m]")], history.loads["wetted_surface"][:, 4]
    )
    assert sorted(path.name for path in (tmp_path / "run").iterdir()) == ["loads.csv", "motions.csv"]
