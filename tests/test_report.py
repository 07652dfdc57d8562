"""The page of a run says what was run and what came out, from the history alone."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.transom import Transom
from panelsim.motion.history import History
from panelsim.results.statistics import statistics
from panelsim.results.tables import statistics_markdown
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.ship.ship import Ship
from panelsim.view.report import _facts, report

MakeHistory = Callable[..., History]


def test_the_page_holds_the_run_and_its_results(make_history: MakeHistory, tmp_path: Path) -> None:
    history = make_history()
    path = report(history, tmp_path)
    page = path.read_text(encoding="utf-8")
    assert path == tmp_path / "report.md"
    assert statistics_markdown(statistics(history)) in page
    for fact in (
        "barge, length 20 m, beam 6 m",
        "246.0 t in water of 1025 kg/m³",
        "6 panels",
        "5.000 m/s (9.72 knots)",
        "2 components, 0.8 to 1.3 rad/s, significant height 2.79 m",  # 4 √(½ (0.9² + 0.4²))
        "| time step | 0.25 s |",
        "| faster than real time | 120 times |",
        "**The run went to its end.**",
        "- The sea repeats itself after 346 s.",
        '"hull": "barge"',
        "nonlinear",
    ):
        assert fact in page, fact


def test_every_picture_of_the_page_is_there(make_history: MakeHistory, tmp_path: Path) -> None:
    page = report(make_history(), tmp_path).read_text(encoding="utf-8")
    pictures = [part.split(")")[0] for part in page.split("](")[1:]]
    assert sorted(pictures) == ["loads.png", "motions.png", "spectra.png"]
    assert all((tmp_path / name).is_file() for name in pictures)


def test_the_page_can_be_made_again_from_the_file(make_history: MakeHistory, tmp_path: Path) -> None:
    history = make_history()
    saved = History.load(history.save(tmp_path / "history.nc"))
    first, again = report(history, tmp_path / "first"), report(saved, tmp_path / "again")
    assert first.read_bytes() == again.read_bytes()


@pytest.mark.parametrize("outcome", ["capsized", "diverged", "interrupted"])
def test_a_run_that_ended_early_says_so_first(
    outcome: str, make_history: MakeHistory, tmp_path: Path
) -> None:
    history = make_history(duration=8.0, outcome=outcome, outcome_detail="t = 8 s, roll 91.2°", notes=())
    lines = report(history, tmp_path).read_text(encoding="utf-8").splitlines()
    assert "T = 8 s, roll 91.2°." in lines[2]
    assert "before its ramp" in lines[2]
    assert "## Notes" not in lines


def test_headings_are_averaged_around_the_circle(make_history: MakeHistory, tmp_path: Path) -> None:
    """Waves 10 degrees to either side of following come from astern, not from ahead."""
    heading = np.deg2rad([10.0, 350.0])
    waves = WaveComponents(np.array([1.0, 1.0]), np.array([0.8, 0.8]), heading, np.zeros(2))
    page = report(make_history(components=waves), tmp_path).read_text(encoding="utf-8")
    degrees = float(page.split("| wave heading | mean ")[1].split(" deg")[0])
    assert degrees == 0.0


def test_regular_waves_have_a_height_and_calm_water_has_none(
    make_history: MakeHistory, tmp_path: Path
) -> None:
    wave = WaveComponents(np.array([1.5]), np.array([0.6]), np.array([np.pi]), np.zeros(1))
    page = report(make_history(components=wave, seaway_kind="regular"), tmp_path / "a").read_text("utf-8")
    assert page.startswith("# barge: regular waves, height 3 m, 180 deg, 9.7 knots")
    page = report(make_history(components=NO_WAVES, seaway_kind="calm"), tmp_path / "b").read_text("utf-8")
    assert page.startswith("# barge: calm water, 9.7 knots")


def test_the_page_tells_a_short_crested_sea_and_a_stokes_wave(
    make_history: MakeHistory, tmp_path: Path
) -> None:
    """Two equal waves 60° to each side of a mean of 100°: R = cos 60°, spread √(2(1 − R)) = 57.3°."""
    headings = np.deg2rad([40.0, 160.0])
    sea = WaveComponents(np.ones(2), np.array([0.8, 1.0]), headings, np.zeros(2))
    page = report(make_history(components=sea), tmp_path / "sea").read_text(encoding="utf-8")
    assert "mean 100.0 deg (0 following, 90 from port, 180 head), directional spread 57.3 deg" in page
    wave = WaveComponents(np.ones(1), np.array([0.8]), headings[:1], np.zeros(1), second_order=True)
    page = report(make_history(components=wave), tmp_path / "wave").read_text(encoding="utf-8")
    assert "height 2 m, Stokes second order" in page
    assert "directional spread" not in page


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ({"method": "ikeda"}, "Ikeda's components: linear 3 N m s"),
        ({"method": "percent", "critical_percent": 5.0}, "5 % of critical: linear 3 N m s"),
        ({"method": "terms", "linear": 3.0}, "given terms: linear 3 N m s"),
        ({}, "given terms: linear 3 N m s"),  # of a script
    ],
)
def test_the_page_names_what_the_loads_are_made_from(
    make_history: MakeHistory, section: dict[str, object], words: str
) -> None:
    history = make_history(
        case=json.dumps({"roll_damping": section}),
        roll_damping="linear 3 N m s",
        coefficients="strip theory, 21 sections",
        inertia="large",
        transom_terms=True,
    )
    told = _facts(history)
    assert told["roll damping"] == words
    assert told["coefficients"] == "strip theory, 21 sections"
    assert told["inertia"] == "that of large angles: it turns with the ship"
    assert told["transom terms"] == "yes"


def test_linearised_roll_damping_says_at_which_amplitude(make_history: MakeHistory, tmp_path: Path) -> None:
    case = json.dumps({"roll_damping": {"method": "ikeda", "linearised_at_deg": 10.0}})
    made = make_history(case=case, roll_damping="linear 3 N m s", model="linear", inertia="linear")
    page = report(made, tmp_path).read_text(encoding="utf-8")
    assert "Ikeda's components, made linear at 10 deg: linear 3 N m s" in page
    assert "| inertia | that of small angles: constant |" in page and "| transom terms | no |" in page


def test_a_run_tells_the_page_what_it_was_made_from(
    run_halifax: Callable[..., History], halifax: Ship, halifax_database: HydroDatabase
) -> None:
    transom = Transom.of_ship(halifax, halifax_database.frequencies)
    with_terms = run_halifax(duration=1.0, speed=5.0, transom=transom).attrs
    without = run_halifax(duration=1.0, model="linear").attrs
    assert "Capytaine" in with_terms["coefficients"]
    assert (with_terms["transom_terms"], without["transom_terms"]) == ("yes", "no")
    assert (with_terms["inertia"], without["inertia"]) == ("large", "linear")
