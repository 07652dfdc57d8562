"""Wave components in files, and the sea that given components make."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import KNOT, STANDARD_GRAVITY
from panelsim.errors import PanelsimError
from panelsim.motion.history import History
from panelsim.seaway.components import NO_WAVES, WaveComponents
from panelsim.seaway.exchange.components_csv import read_components, write_components
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.spectra.bretschneider import Bretschneider

HEADER = "amplitude_m,frequency_rad_s,wave_heading_deg,phase_deg\n"
NAMES = ("amplitude", "frequency", "wave_heading", "phase")


@pytest.fixture
def sea() -> WaveComponents:
    """The 19 components of TM 2003-190 section 8.4."""
    return RandomSeaway(Bretschneider(7.5, 15.0), 0.1 * np.arange(2, 21), np.deg2rad(150), 1001).components


def test_the_file_by_hand(tmp_path: Path) -> None:
    """Waves from port (π/2) with a trough at the origin (π), and head waves: degrees, in this order."""
    waves = WaveComponents([1.5, 0.1], [0.5, 1 / 3], [np.pi / 2, np.pi], [np.pi, -np.pi / 4])
    path = write_components(tmp_path / "sea.csv", waves)
    comment, *lines = path.read_text().splitlines()
    assert path.read_bytes().endswith(b"\n")
    assert comment.startswith("#") and "," not in comment and comment.isascii()
    assert [HEADER.strip(), "1.5,0.5,90.0,180.0", "0.1,0.3333333333333333,180.0,-45.0"] == lines


def test_round_trip(tmp_path: Path, sea: WaveComponents) -> None:
    back = read_components(write_components(tmp_path / "sea.csv", sea))
    np.testing.assert_array_equal(back.amplitude, sea.amplitude)
    np.testing.assert_array_equal(back.frequency, sea.frequency)
    # A few units in the last place of 2π, from radians to degrees and back.
    np.testing.assert_allclose(back.wave_heading, sea.wave_heading, rtol=0, atol=4e-15)
    np.testing.assert_allclose(back.phase, sea.phase, rtol=0, atol=4e-15)
    assert back.second_order is False


_ANGLES = st.floats(-2 * np.pi, 2 * np.pi)


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(st.floats(-50, 50), st.floats(1e-6, 50), _ANGLES, _ANGLES), min_size=1, max_size=5))
def test_any_components_come_back(
    tmp_path_factory: pytest.TempPathFactory, rows: list[tuple[float, float, float, float]]
) -> None:
    waves = WaveComponents(*np.array(rows).T)
    back = read_components(write_components(tmp_path_factory.mktemp("sea") / "sea.csv", waves))
    for name, tolerance in zip(NAMES, (0, 0, 4e-15, 4e-15), strict=True):
        np.testing.assert_allclose(getattr(back, name), getattr(waves, name), rtol=0, atol=tolerance)


def test_a_file_cut_anywhere_within_a_line_is_refused(tmp_path: Path, sea: WaveComponents) -> None:
    whole = write_components(tmp_path / "whole.csv", sea).read_bytes()
    cut = tmp_path / "cut.csv"
    lines_read = set()
    for length in range(len(whole)):
        cut.write_bytes(whole[:length])
        try:
            lines_read.add(read_components(cut).count)
        except PanelsimError:
            continue
        assert whole[:length].endswith(b"\n")
    assert lines_read == set(range(1, 19))


def test_a_cut_file_says_so(tmp_path: Path) -> None:
    path = tmp_path / "sea.csv"
    path.write_text(f"{HEADER}1.0,0.5,90.0,180.0\n1.0,0.6,90.0,18")
    with pytest.raises(PanelsimError, match="cut short") as refusal:
        read_components(path)
    assert "1.0,0.6,90.0,18" in str(refusal.value)


def test_a_file_from_a_spreadsheet_is_read(tmp_path: Path) -> None:
    """Byte order mark, lines ended the Windows way, blanks, empty cells after a comment."""
    path = tmp_path / "sea.csv"
    rows = ["# my sea,,,", "amplitude_m, frequency_rad_s, wave_heading_deg, phase_deg", "1, 0.5, 90, 180", ""]
    path.write_bytes(b"\xef\xbb\xbf" + "\r\n".join(rows).encode())
    waves = read_components(path)
    assert (waves.count, waves.amplitude[0], waves.frequency[0]) == (1, 1.0, 0.5)
    assert (waves.wave_heading[0], waves.phase[0]) == pytest.approx((np.pi / 2, np.pi), rel=1e-15)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "an empty file"),
        ("# only a comment\n", "an empty file"),
        (HEADER, "no wave components"),
        ("1.0,0.5,90.0,180.0\n", "does not begin with the columns"),
        (HEADER.replace("_deg", "_rad") + "1,0.5,1,1\n", "wave_heading_rad"),
        ("amplitude_m,frequency_rad_s,wave_heading_deg\n1,0.5,1\n", "does not begin"),
        (HEADER.replace("\n", ",spread\n") + "1,0.5,90,0,0\n", "does not begin"),
        ("frequency_rad_s,amplitude_m,wave_heading_deg,phase_deg\n0.5,1,90,0\n", "does not begin"),
        (HEADER.replace(",", ";") + "1;0.5;90;0\n", "does not begin"),
        (HEADER + "1,0.5,90,0\n1,0.5,90\n", "line 3 is no wave component"),
        (HEADER + "# a comment\n1,0.5,90,0,0\n", "line 3 is no wave component"),
        (HEADER + "1,0.5,head,0\n", "line 2 is no wave component"),
        (HEADER + "1,0.5,,0\n", "line 2 is no wave component"),
        (HEADER + "nan,0.5,90,0\n", "line 2 is no wave component"),
        (HEADER + "1,0.5,90,inf\n", "line 2 is no wave component"),
        (HEADER + "1,-0.5,90,0\n", "line 2 has a frequency that is not positive"),
        (HEADER + "1,0,90,0\n", "line 2 has a frequency that is not positive"),
    ],
)
def test_bad_files_are_refused(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "sea.csv"
    path.write_text(text)
    with pytest.raises(PanelsimError) as refusal:
        read_components(path)
    assert words in str(refusal.value)


def test_what_is_no_text_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "sea.csv").write_bytes(b"\x89HDF\r\n\x1a\n\xff\xfe")
    for path in (tmp_path / "sea.csv", tmp_path / "missing.csv", tmp_path):
        with pytest.raises(PanelsimError, match="cannot be read") as refusal:
            read_components(path)
        assert str(path) in str(refusal.value)


def test_an_existing_file_is_kept_unless_told(tmp_path: Path, sea: WaveComponents) -> None:
    path = tmp_path / "sea.csv"
    path.write_text("mine")
    with pytest.raises(PanelsimError, match="would overwrite"):
        write_components(path, sea)
    assert path.read_text() == "mine"
    assert read_components(write_components(path, sea, overwrite=True)).count == 19


def test_a_full_disk_leaves_the_old_file(
    tmp_path: Path, sea: WaveComponents, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "sea.csv"
    path.write_text("mine")

    def full(self: Path, data: bytes) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(PanelsimError, match="cannot be written"):
        write_components(path, sea, overwrite=True)
    assert path.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("waves", "words"),
    [
        (NO_WAVES, "no wave components"),
        (np.ones((4, 3)), "no wave components"),
        (WaveComponents(1.0, 0.5, 0.0, 0.0, second_order=True), "second order"),
    ],
)
def test_what_a_file_cannot_hold_is_not_written(tmp_path: Path, waves: WaveComponents, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        write_components(tmp_path / "sea.csv", waves)
    assert not list(tmp_path.iterdir())


def test_given_components_make_the_sum_of_their_waves() -> None:
    """Σ a cos(k(x cos β − y sin β) − ω_e t − ε), TM 2003-190 (10), with a wave that the ship overtakes."""
    a, w, beta, phase = [1.0, 0.4], [0.5, 1.4], [2.5, 0.3], [0.7, -1.1]
    speed, x, y, t = 20 * KNOT, 12.0, -7.0, 33.0
    k = np.square(w) / STANDARD_GRAVITY
    encounter = w - speed * k * np.cos(beta)
    angle = k * (x * np.cos(beta) - y * np.sin(beta)) - encounter * t - phase
    sea = ComponentSeaway(WaveComponents(a, w, beta, phase), ship_heading=1.0)
    assert (sea.kind, sea.ship_heading) == ("components", 1.0)
    got = sea.in_translating_axes(speed).elevation(x, y, t)
    assert got == pytest.approx(a @ np.cos(angle), rel=1e-13)


def test_a_run_in_the_components_of_a_sea_is_the_run_in_that_sea(
    run_halifax: Callable[..., History],
) -> None:
    sea = RandomSeaway(Bretschneider(7.5, 15.0), 0.1 * np.arange(2, 21), np.deg2rad(150), 1001)
    first, second = (run_halifax(s, duration=4.0) for s in (sea, ComponentSeaway(sea.components)))
    np.testing.assert_array_equal(first.displacement, second.displacement)
    assert second.tree["seaway"].attrs["kind"] == "components"


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: ComponentSeaway(NO_WAVES), "0 components"),
        (lambda: ComponentSeaway([1.0, 0.5, 0.0, 0.0]), "[1.0, 0.5, 0.0, 0.0]"),
        (lambda: ComponentSeaway(WaveComponents([0.1, -5.0], [1.0, 1.0], 0.0, 0.0)), "component 2"),
        (lambda: ComponentSeaway(WaveComponents(1.0, 0.5, 0.0, 0.0), 150.0), "radians"),
        (lambda: ComponentSeaway(WaveComponents(1.0, 0.5, 0.0, 0.0), float("nan")), "radians"),
    ],
)
def test_seas_that_cannot_be_are_refused(make: Callable[[], ComponentSeaway], words: str) -> None:
    with pytest.raises(PanelsimError) as refusal:
        make()
    assert words in str(refusal.value)


def test_steep_but_possible_components_are_accepted() -> None:
    """Amplitude 4.3 m at 1 rad/s has H/λ = a k/π = 0.1396, under 0.142; 4.4 m has 0.1428."""
    ComponentSeaway(WaveComponents(4.3, 1.0, 0.0, 0.0))
    with pytest.raises(PanelsimError, match=r"0\.143"):
        ComponentSeaway(WaveComponents(4.4, 1.0, 0.0, 0.0))


def test_components_without_energy_are_no_sea() -> None:
    with pytest.raises(PanelsimError, match="no energy") as refusal:
        ComponentSeaway(WaveComponents(np.zeros(2), np.ones(2), np.zeros(2), np.zeros(2)))
    assert "CalmSeaway" in str(refusal.value)
