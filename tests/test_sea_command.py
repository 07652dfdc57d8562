"""`panelsim sea`: it prints the numbers of the sea, and its picture shows it the right way round."""

from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import StepPatch
from rich.console import Console

from panelsim.case import Case
from panelsim.cli import show, show_sea
from panelsim.conventions import KNOT
from panelsim.hydro.database import HydroDatabase
from panelsim.loads.supplementary import Supplementary
from panelsim.motion.notes import _scatter_note, run_notes
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.direction.spreading import CosineHalfAngle
from panelsim.seaway.exchange.components_csv import read_components
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.regular import RegularSeaway
from panelsim.seaway.repeat import variance_scatter
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship
from panelsim.view.sea_picture import sea_picture

EXAMPLES = Path(__file__).parents[1] / "examples"
GRID = 0.1 * np.arange(2, 21)
SPEED = 20 * KNOT
WAVE = (
    '[ship]\nhull = "halifax"\npanel_area = 20\n[run]\nspeed_knots = 20\ntime_step = 0.2\nduration = 9\n'
    '[seaway]\nkind = "regular"\nwave_length = 60\nwave_height = 3\nwave_heading_deg = 0\n'
)


def printed(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], case: Case) -> str:
    console = Console(width=80, highlight=False, markup=False)
    monkeypatch.setattr(show_sea, "out", console)
    monkeypatch.setattr(show_sea, "say", console.print)
    monkeypatch.setattr(show, "out", console)
    capsys.readouterr()
    show_sea.show_sea(case)
    return capsys.readouterr().out


def row(text: str, name: str) -> list[float]:
    line = next(line for line in text.splitlines() if line.strip().startswith(name))
    return [float(word) for word in line.split()[-2:]]  # the columns spectrum and components


def test_target_and_realised_parameters_stand_side_by_side(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = printed(monkeypatch, capsys, Case.load(EXAMPLES / "halifax_sea_state_7.toml"))
    assert max(map(len, text.splitlines())) <= 80
    target, realised = row(text, "significant wave height")
    # 19 components hold 99.1 % of the variance.
    assert target == 7.5
    assert realised == pytest.approx(7.5 * np.sqrt(0.9913), abs=2e-3)
    # Bretschneider: T1 = 0.77177 T_p, T_z = 0.71037 T_p; four digits are printed.
    assert row(text, "mean period")[0] == pytest.approx(0.77177 * 15, abs=6e-3)
    assert row(text, "zero-crossing period")[0] == pytest.approx(0.71037 * 15, abs=6e-3)
    assert row(text, "nominal steepness")[0] == pytest.approx(0.02136, abs=1e-5)
    assert "mean wave heading [deg], 0 following, 180 head" in text
    assert "after 346 s" in " ".join(text.split())


def test_the_command_leaves_a_picture_and_the_components(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from panelsim.cli import main

    def call(*arguments: object) -> int:
        monkeypatch.setattr("sys.argv", ["panelsim", "sea", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            main()
        return int(ended.value.code or 0)

    case = EXAMPLES / "short_crested_sea.toml"
    folder = tmp_path / "sea"
    assert call(case, "--out", folder, "--set", "ship.panel_area=20") == 0
    assert sorted(path.name for path in folder.iterdir()) == ["components.csv", "sea.png"]
    read, made = read_components(folder / "components.csv"), Case.load(case).seaway.components
    np.testing.assert_array_equal(read.amplitude, made.amplitude)
    # The second order of a Stokes wave has no column there: an older file of that name goes.
    wave = tmp_path / "wave.toml"
    wave.write_text(WAVE)
    assert call(wave, "--out", folder, "--force", "--set", "seaway.wave_theory=stokes") == 0
    assert sorted(path.name for path in folder.iterdir()) == ["sea.png"]
    # An occupied folder is refused, and so is calm water, before anything is written.
    assert call(case, "--out", folder) == 2
    assert "not empty" in capsys.readouterr().err
    calm = tmp_path / "calm.toml"
    calm.write_text(
        '[ship]\nhull="box"\n[seaway]\nkind="calm"\n[run]\nspeed_knots=0\ntime_step=1\nduration=9\n'
    )
    assert call(calm, "--out", tmp_path / "none") == 2
    assert not (tmp_path / "none").exists()


def test_the_picture_shows_where_waves_come_from(barge: Ship, tmp_path: Path, drawn: list[Figure]) -> None:
    """Waves from port (β = 90°), 100 m long: the bar is at port, crests lie along the ship."""
    wave = RegularSeaway(1.0, float(np.sqrt(2 * np.pi * barge.gravity / 100.0)), np.pi / 2, phase=-np.pi / 2)
    path = sea_picture(wave, barge, 0.0, tmp_path / "sea.png")
    assert matplotlib.image.imread(path).shape[1] >= 1200
    spectrum, _, directions, surface = drawn[0].axes[:4]
    (bar,) = directions.patches
    side = bar.get_x() + 0.5 * bar.get_width()
    # Clockwise from the bow: port is at 270°.
    assert np.rad2deg(side) % 360 == pytest.approx(270.0, abs=1e-4)  # directions are drawn to 1e-6 rad
    assert directions.get_theta_direction() == -1  # type: ignore[attr-defined]
    # cos(−ky + π/2) = sin(ky): a crest 25 m to port, a trough 25 m to starboard.
    mesh = surface.collections[0]
    shape = tuple(n - 1 for n in mesh.get_coordinates().shape[:2])
    elevation = np.asarray(mesh.get_array()).reshape(shape)
    starboard = 0.5 * (mesh.get_coordinates()[0, 1:, 0] + mesh.get_coordinates()[0, :-1, 0])
    assert elevation[0][np.argmin(abs(starboard + 25))] > 0.9
    assert elevation[0][np.argmin(abs(starboard - 25))] < -0.9
    assert np.ptp(elevation[:, 3]) < 1e-9  # long-crested along the ship
    assert spectrum.lines[0].get_data() == ([wave.wave_frequency], [1.0])  # its amplitude


def test_overtaken_waves_are_told_apart(barge: Ship, tmp_path: Path, drawn: list[Figure]) -> None:
    """At 10 m/s a following wave of 1.5 rad/s is overtaken, one of 0.5 rad/s is not."""
    waves = WaveComponents(np.array([1.0, 0.5]), np.array([0.5, 1.5]), np.zeros(2), np.zeros(2))
    sea_picture(ComponentSeaway(waves), barge, 10.0, tmp_path / "sea.png")
    encounter = drawn[0].axes[1]
    areas = {
        bars.get_label(): sum(p.get_height() * p.get_width() for p in bars) for bars in encounter.containers
    }
    assert areas == pytest.approx({"components": 0.5, "overtaken by the ship": 0.125}, rel=1e-9)


@pytest.mark.parametrize(("heading_deg", "told"), [(150, None), (30, "beat for hours")])
def test_a_run_whose_statistics_hang_on_the_seed_says_so(heading_deg: float, told: str | None) -> None:
    """The report's grid at 20 knots: 0.5 and 0.6 rad/s meet the ship alike at 30°, not at 150°."""
    sea = RandomSeaway(Bretschneider(7.5, 15.0), GRID, np.deg2rad(heading_deg), 1)
    notes = _scatter_note(sea.components, SPEED, 1860.0, 9.80665)
    if told is None:
        assert notes == []
        return
    scatter = variance_scatter(sea.components, SPEED, 1860.0)
    assert told in notes[0]
    assert f"by {50 * scatter:.0f} %" in notes[0]
    # Half of it, for the RMS, is what counts: in 40 s the variance scatters by 0.27, the RMS by 0.13.
    # A short run in an ordinary sea is only too short.
    dense = RandomSeaway(Bretschneider(7.5, 15.0), np.arange(0.2, 2.0, 0.002), np.deg2rad(150), 1)
    (short,) = _scatter_note(dense.components, SPEED, 30.0, 9.80665)
    assert "a longer run" in short


def test_the_arrow_and_the_curves_of_a_short_crested_sea(
    barge: Ship, tmp_path: Path, drawn: list[Figure]
) -> None:
    """Waves that come from 60° to starboard of the bow, for a ship on the course 100°."""
    sea = RandomSeaway(
        Bretschneider(3.0, 6.0),
        np.arange(0.6, 3.0, 0.05),
        np.deg2rad(240.0),
        1,
        0.9,
        np.deg2rad(100.0),
        spreading=CosineHalfAngle(20.0),
        direction_step=np.deg2rad(10.0),
    )
    sea_picture(sea, barge, 5.0, tmp_path / "sea.png")
    _, _, directions, surface = drawn[0].axes[:4]
    angle, radius = directions.lines[0].get_data()
    assert np.rad2deg(angle[np.argmax(radius)]) == pytest.approx(60.0, abs=1.0)  # drawn degree by degree
    # The curve is the energy of a bar of its width at each angle: it runs through the tops of the bars.
    tops = {round(np.rad2deg(bar.get_x() + 0.5 * bar.get_width())) % 360: bar for bar in directions.patches}
    assert radius[60] == pytest.approx(tops[60].get_height(), rel=0.01)
    (arrow,) = surface.texts
    start, tip = np.array(arrow.xyann), np.array(arrow.xy)
    # To starboard and forward: they travel aft and to port, and the arrow lies where they come from.
    assert np.all((tip - start) / np.array([np.sin(np.deg2rad(60)), np.cos(np.deg2rad(60))]) < 0)
    assert start[0] > 0 and start[1] > 0


def test_the_target_curve_is_that_of_the_speed(barge: Ship, tmp_path: Path, drawn: list[Figure]) -> None:
    """Head waves at 5 m/s: the energy under the curve over |ω_e| is that of the spectrum."""
    sea = RandomSeaway(Bretschneider(3.0, 6.0), np.arange(0.6, 3.0, 0.01), np.pi, 1)
    sea_picture(sea, barge, 5.0, tmp_path / "sea.png")
    stairs = next(patch for patch in drawn[0].axes[1].patches if isinstance(patch, StepPatch))
    values = stairs.get_data().values
    bars = drawn[0].axes[1].containers[0]
    heights = np.array([bar.get_height() for bar in bars])
    # Components of 0.01 rad/s fill bands of 0.1 rad/s to a few per cent of the highest.
    np.testing.assert_allclose(heights, values, atol=0.05 * values.max())


def test_notes_tell_of_a_sea_that_repeats_for_the_ship_not_for_a_buoy(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """0.1 rad/s repeats after 2π/0.1 = 63 s at rest; at 20 knots from ahead after 346 s."""
    sea = RandomSeaway(Bretschneider(7.5, 15.0), GRID, np.deg2rad(150), 1)
    for speed, told in ((0.0, "every 63 s"), (SPEED, "every 346 s")):
        notes = run_notes(
            sea.components,
            halifax_database,
            springs,
            speed=speed,
            time_step=0.2,
            stepper="rk4",
            length=900.0,
            model="linear",
        )
        assert sum(told in note for note in notes) == 1, notes


def test_a_record_has_no_other_phases(
    halifax: Ship, halifax_database: HydroDatabase, springs: Supplementary
) -> None:
    """What is told of a random sea that beats, is not told of the same waves from a file."""
    sea = RandomSeaway(Bretschneider(7.5, 15.0), GRID, np.deg2rad(30), 1)
    told = [
        any(
            "other phases" in note
            for note in run_notes(
                sea.components,
                halifax_database,
                springs,
                speed=SPEED,
                time_step=0.2,
                stepper="rk4",
                length=900.0,
                model="linear",
                seeded=seeded,
            )
        )
        for seeded in (True, False)
    ]
    assert told == [True, False]


def test_one_wave_is_told_as_a_wave(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "wave.toml"
    path.write_text(WAVE)
    text = printed(monkeypatch, capsys, Case.load(path))
    assert "3 m, steepness H/λ 0.05" in text
    assert "60 m" in text and "overtaken by the ship" in text
    assert "highest tenth" not in text
