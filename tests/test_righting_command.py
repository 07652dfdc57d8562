"""`panelsim righting` and `panelsim hull --sections`: what they print, write, draw and refuse."""

import re
from collections.abc import Callable
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from matplotlib.figure import Figure

from panelsim.cli.righting import HEELS as HEELS_OF_THE_COMMAND
from panelsim.cli.righting import show_righting
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.ship.bundled import load_ship
from panelsim.ship.righting import righting_arm
from panelsim.ship.ship import Ship
from panelsim.studies.righting import FrozenWave, righting_arm_in_wave
from panelsim.studies.righting_table import write_righting_arms
from panelsim.view.righting_picture import righting_picture
from panelsim.view.section_picture import section_picture

HEELS = np.deg2rad(np.arange(0, 181, 30))
Call = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def frigate() -> Ship:
    return load_ship("frigate", 20.0)


@pytest.fixture
def case(panelsim: Call, tmp_path: Path) -> Path:
    """A case file of the frigate in large panels."""
    file = tmp_path / "frigate.toml"
    panelsim("new", file, "--ship", "frigate")
    text, count = re.subn(r"(?m)^#? *panel_area = \S+", "panel_area = 20.0", file.read_text())
    assert count == 1
    file.write_text(text)
    return file


def test_the_table_of_calm_water(panelsim: Call, case: Path, frigate: Ship) -> None:
    code, out, err = panelsim("righting", case)
    assert (code, err) == (0, "")
    found = righting_arm(frigate, np.deg2rad([0, 30, 60]))
    words = [line.split() for line in out.splitlines()]
    assert ["30", f"{found.arm[1]:.3f}"] in words and ["180", "0.000"] in words
    assert ["GM,", "slope", "at", "0", "[m]", f"{found.gm:.3f}"] in words
    assert max(map(len, out.splitlines())) <= 80 and "-0.000" not in out


def test_arms_of_a_model_have_more_digits(capsys: pytest.CaptureFixture[str], barge: Ship) -> None:
    """The barge at a scale of 1 to 100."""
    model = Ship(
        PanelMesh(0.01 * barge.mesh.vertices, barge.mesh.panels),
        draft=0.02,
        center_of_gravity=(None, 0.0, 0.015),
        gyradii=(0.02, 0.05, 0.05),
    )
    found = righting_arm(model, HEELS_OF_THE_COMMAND)
    show_righting(model, [found])
    assert ["30", f"{found.arm[6]:.5f}"] in [line.split() for line in capsys.readouterr().out.splitlines()]


def test_a_wave_gives_crest_and_trough_and_its_files(
    panelsim: Call, case: Path, frigate: Ship, tmp_path: Path
) -> None:
    file = tmp_path / "out" / "gz.csv"
    wave = ("--wave-length", 120, "--wave-height", 6)
    code, out, err = panelsim("righting", case, *wave, "-o", file)
    assert (code, err) == (0, "")
    assert out.count("crest amidships") == out.count("trough amidships") == 2
    assert "area 30 to 40 deg [m rad] " in out  # no name of a row or a column is broken
    assert max(map(len, out.splitlines()[:-1])) <= 80
    table = np.genfromtxt(file, delimiter=",", names=True)
    assert len(table) == 37
    for name, crest in (("crest", 0.0), ("trough", 60.0)):
        found = righting_arm_in_wave(frigate, HEELS, FrozenWave(120.0, 6.0, crest))
        # Six decimals are written.
        arm, trim = (
            table[f"{what}_{name}_amidships_{unit}"]
            for what, unit in (("righting_arm", "m"), ("trim", "deg"))
        )
        assert arm[::6] == pytest.approx(found.arm, abs=6e-7)
        assert trim[::6] == pytest.approx(np.degrees(found.trim), abs=6e-7)
        assert arm[0] == 0.0  # upright there is none, not some 1e-17
    assert table["heel_deg"][6] == 30.0
    assert sorted(path.name for path in file.parent.iterdir()) == ["gz.csv", "gz.png"]

    code, out, err = panelsim("righting", case, *wave, "-o", file)
    assert code == 2 and "exists already" in err and not out
    code, out, _ = panelsim("righting", case, *wave, "--crest", 10, "--pressure", "hydrostatic")
    hydrostatic = righting_arm_in_wave(frigate, HEELS, FrozenWave(120.0, 6.0, 10.0), pressure="hydrostatic")
    assert code == 0 and f"{hydrostatic.gm:.3f}" in out
    assert "crest 10 m forward of midships" in out and "area 30 to 40 deg [m rad] " in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--wave-length", 100], ["length and its height", "--wave-length alone"]),
        (["--wave-height", 5], ["--wave-height alone"]),
        (["--crest", 5], ["length and its height"]),
        (["--pressure", "hydrostatic"], ["length and its height"]),
        (["--wave-length", 100, "--wave-height", 5, "--pressure", "static"], ['"static"', "hydrostatic"]),
        (["--wave-length", 100, "--wave-height", 20], ["0.200", "0.142"]),
        (["--wave-length", -100, "--wave-height", 20], ["wave_length is not positive"]),
        (
            ["--wave-length", 100, "--wave-height", 5, "--crest", 200],
            ["position of the crest", "-100 to 100"],
        ),
        (["--wave-length", "long", "--wave-height", 5], ["--wave-length"]),
        (["-o", "gz.txt"], ["gz.txt", ".csv"]),
    ],
)
def test_options_that_do_not_go_together(panelsim: Call, arguments: list[object], words: list[str]) -> None:
    code, out, err = panelsim("righting", "frigate", *arguments)
    assert code == 2 and not out
    assert err.startswith("error: ") and err.count("error: ") == 1
    assert all(word in err for word in words), err


def test_a_ship_that_is_none(panelsim: Call) -> None:
    code, _, err = panelsim("righting", "frigat")
    assert code == 2 and "frigate" in err


def test_the_picture_shows_the_curves(frigate: Ship, tmp_path: Path, drawn: list[Figure]) -> None:
    curves = [
        righting_arm(frigate, HEELS),
        righting_arm_in_wave(frigate, HEELS, FrozenWave(120.0, 6.0)),
    ]
    path = righting_picture(curves, "a frigate", tmp_path / "gz.png")
    pixels = matplotlib.image.imread(path)
    assert 0.005 < np.mean(pixels[..., :3].min(axis=-1) < 0.8) < 0.5
    arm, heave, trim = drawn[0].axes
    whole = [line for line in arm.lines if len(np.atleast_1d(line.get_xdata())) == len(HEELS)]
    for line, curve in zip(whole, curves, strict=True):
        np.testing.assert_allclose(line.get_xdata(), np.degrees(HEELS))
        np.testing.assert_array_equal(line.get_ydata(), curve.arm)
    np.testing.assert_array_equal(heave.lines[1].get_ydata(), curves[1].heave)
    np.testing.assert_allclose(trim.lines[1].get_ydata(), np.degrees(curves[1].trim))
    legend = arm.get_legend()
    assert legend is not None
    assert "vanishes at 93°" in legend.get_texts()[0].get_text()


def test_a_table_has_no_minus_zero(frigate: Ship, tmp_path: Path) -> None:
    text = write_righting_arms(tmp_path / "gz.csv", [righting_arm(frigate, HEELS)]).read_text()
    head = "heel [deg],righting_arm_calm_water [m],heave_calm_water [m],trim_calm_water [deg]"
    assert text.splitlines()[0] == head
    assert ",-0," not in text and ",-0\n" not in text


def test_the_code_of_the_page_runs() -> None:
    page = (Path(__file__).parents[1] / "docs" / "stability.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) == 1
    exec(blocks[0], {})  # its assertions are the test


class TestSections:
    def test_the_body_plan_of_a_hull(self, panelsim: Call, tmp_path: Path, drawn: list[Figure]) -> None:
        code, _, err = panelsim("hull", "s175", "--sections", tmp_path / "plan.png")
        assert code == 0 and "Wrote" in err and (tmp_path / "plan.png").exists()
        plan, areas = drawn[0].axes
        legend = plan.get_legend()
        assert legend is not None and len(legend.get_texts()) == 3  # one stern section has no Lewis form
        outlines = [line for line in plan.lines if len(np.atleast_1d(line.get_xdata())) > 2]
        assert len(outlines) == 40
        aft, fore = (np.asarray(line.get_xdata()) for line in (outlines[0], outlines[-1]))
        assert aft.max() == 0.0 and fore.min() == 0.0  # the stern on the left, the bow on the right
        ship = load_ship("s175")
        x, area = np.asarray(areas.lines[0].get_xdata()), np.asarray(areas.lines[0].get_ydata())
        volume = area.mean() * (areas.get_xlim()[1] - areas.get_xlim()[0])
        assert volume == pytest.approx(ship.hydrostatics.displaced_volume, rel=4e-3)  # 20 strips
        assert len(x) == 20 and (np.diff(x) > 0.0).all()

    def test_a_section_under_water_is_drawn_without_a_form(
        self, barge: Ship, tmp_path: Path, drawn: list[Figure]
    ) -> None:
        """A box with a ram at the bow, whose sections there have no Lewis form."""
        box, panels = barge.mesh.vertices, barge.mesh.panels
        ram = np.array([[x, y, z] for z in (0.5, 1.5) for x, y in ((9, -1), (16, -1), (16, 1), (9, 1))])
        mesh = PanelMesh(np.vstack([box, ram]), np.vstack([panels, panels + 8]))
        ship = Ship(mesh, draft=2.0, center_of_gravity=(None, 0.0, 1.5), gyradii=(2.0, 5.0, 5.0))
        section_picture(ship, tmp_path / "plan.png")
        circles = [line for line in drawn[0].axes[1].lines if line.get_marker() == "o"]
        assert 10 <= len(circles) < 20

    def test_refusals(self, panelsim: Call, tmp_path: Path) -> None:
        code, _, err = panelsim("hull", "box", "--sections", tmp_path / "plan.jpg")
        assert code == 2 and ".png" in err
        (tmp_path / "plan.png").touch()
        code, _, err = panelsim("hull", "box", "--sections", tmp_path / "plan.png")
        assert code == 2 and "--force" in err
        assert (tmp_path / "plan.png").stat().st_size == 0
