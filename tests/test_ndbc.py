"""Spectra and sea states from files of the National Data Buoy Center."""

import gzip
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.errors import PanelsimError
from panelsim.seaway.direction.directional_table import DirectionalTable
from panelsim.seaway.exchange.datasets import spectrum_from_dataset
from panelsim.seaway.exchange.ndbc import read_ndbc_meteorology, read_ndbc_spectrum
from panelsim.seaway.exchange.ndbc_directions import DIRECTIONS, weighted_distribution
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.table import TableSpectrum

DATA = Path(__file__).parent / "data" / "ndbc"
REALTIME = [DATA / f"99999.{end}" for end in ("data_spec", "swdir", "swdir2", "swr1", "swr2")]
HISTORICAL = [DATA / f"99999{letter}2020.txt" for letter in "wdijk"]
FORMATS = {"realtime": (REALTIME, "2020-06-08 03:50"), "historical": (HISTORICAL, "2020-06-08 03:40")}
# The centres of the bands of 0.005, 0.01 and 0.02 Hz.
FREQUENCY = np.concatenate(
    [np.arange(0.0325, 0.095, 0.005), np.arange(0.1, 0.355, 0.01), [0.365], np.arange(0.385, 0.49, 0.02)]
)


@pytest.mark.parametrize(("kind", "digits", "height"), [("realtime", 3, 2.985), ("historical", 2, 2.996)])
def test_density_file_gives_the_point_spectrum(kind: str, digits: int, height: float) -> None:
    """S(ω) = S(f)/2π; the files hold a Bretschneider sea of 3 m and 10 s to their last digit."""
    files, time = FORMATS[kind]
    table = read_ndbc_spectrum(files[0], time=time)
    assert isinstance(table, TableSpectrum)
    expected = Bretschneider(3.0, 10.0).density(2 * np.pi * FREQUENCY)
    rounding = 0.5 * 10.0**-digits / (2 * np.pi)
    np.testing.assert_allclose(table.density_table, expected, rtol=1e-12, atol=1.001 * rounding)
    # Realtime files print 0.0325 Hz as 0.033: a half of the low bands' width is lost of the height.
    printed = FREQUENCY if kind == "historical" else np.floor(1000 * FREQUENCY + 0.501) / 1000
    np.testing.assert_allclose(table.frequency, 2 * np.pi * printed, rtol=1e-12)
    assert table.significant_wave_height == pytest.approx(height, abs=1e-3)
    assert table.peak_period == pytest.approx(10.0, rel=1e-12)


@pytest.mark.parametrize("kind", FORMATS)
def test_five_files_give_the_directional_spectrum(kind: str) -> None:
    """Swell from 45° and wind sea from 105°, r1 = s/(s + 1): the density of the file at each frequency."""
    files, time = FORMATS[kind]
    table = read_ndbc_spectrum(files, time=time)
    point = read_ndbc_spectrum(files[0], time=time)
    assert isinstance(table, DirectionalTable) and isinstance(point, TableSpectrum)
    # Sums of 36 directions of two harmonics are exact.
    np.testing.assert_allclose(table.point.density_table, point.density_table, rtol=1e-13)
    energy = point.density_table > 0
    low = FREQUENCY < 0.145
    direction = np.rad2deg(table.mean_direction(table.frequency))
    np.testing.assert_allclose(direction[low & energy], 45.0, atol=1e-9)
    np.testing.assert_allclose(direction[~low], 105.0, atol=1e-9)
    # At 0.1 and at 0.2 Hz by the formula, of the printed digits r1 0.95, r2 0.82 and 0.75, 0.30.
    for place, nu, alpha, r1, r2 in [(13, 60.0, 45.0, 0.95, 0.82), (23, 340.0, 105.0, 0.75, 0.30)]:
        if kind == "historical":
            r1, r2 = (0.9524, 0.8225) if place == 13 else (0.75, 0.30)
        off = np.deg2rad(nu - alpha)
        share = (0.5 + 2 / 3 * r1 * np.cos(off) + r2 / 6 * np.cos(2 * off)) / np.pi
        got = table.density(table.frequency[place], np.deg2rad(nu))
        assert got == pytest.approx(point.density_table[place] * share, rel=2e-4)  # a unit of the last digit
    np.testing.assert_array_equal(table.density_table[~energy], 0.0)


def test_realtime_files_as_wavespectra_puts_them_together() -> None:
    from wavespectra import read_ndbc_ascii

    theirs = read_ndbc_ascii(REALTIME, weight_coeff=True).sel(time="2020-06-08T03:50")
    # Its one factor for all frequencies of a density of 0 does not matter, nor its single precision.
    expected = spectrum_from_dataset(theirs.where(theirs["efth"].sum("dir") > 0, 0.0))
    got = read_ndbc_spectrum(REALTIME, time="2020-06-08 03:50")
    assert isinstance(got, DirectionalTable) and isinstance(expected, DirectionalTable)
    np.testing.assert_allclose(got.frequency, expected.frequency, rtol=1e-6)
    np.testing.assert_allclose(got.density_table, expected.density_table, rtol=1e-12, atol=1e-12)


def test_without_weights_the_series_is_negative() -> None:
    """r1 0.95 and r2 0.82, a swell of ± 18°: 1/π (½ − 0.95 cos 75° …) falls to −0.10 a radian."""
    off = DIRECTIONS - np.deg2rad(45.0)
    plain = (0.5 + 0.95 * np.cos(off) + 0.82 * np.cos(2 * off)) / np.pi
    assert plain.min() < -0.09
    weighted = weighted_distribution(*np.array([[0.1], [45.0], [45.0], [0.95], [0.82]]))
    assert weighted.min() >= 0.0
    assert weighted.sum() * np.deg2rad(10.0) == pytest.approx(1.0, rel=1e-12)
    vector = weighted[0] @ np.exp(1j * DIRECTIONS) * np.deg2rad(10.0)
    assert np.rad2deg(np.angle(vector)) == pytest.approx(45.0, abs=1e-9)
    assert abs(vector) == pytest.approx(2 / 3 * 0.95, rel=1e-12)  # as the docstring says


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 10_000), count=st.integers(1, 4))
def test_weighted_series_of_any_distribution_is_not_negative(seed: int, count: int) -> None:
    """Harmonics of a few waves from any directions, the sharpest distributions that there are."""
    rng = np.random.default_rng(seed)
    share, nu = rng.dirichlet(np.ones(count)), rng.uniform(0, 2 * np.pi, count)
    first, second = share @ np.exp(1j * nu), share @ np.exp(2j * nu)
    got = weighted_distribution(
        np.array([0.1]),
        np.array([np.rad2deg(np.angle(first))]),
        np.array([np.rad2deg(np.angle(second)) / 2]),
        np.minimum(np.array([abs(first)]), 1.0),
        np.minimum(np.array([abs(second)]), 1.0),
    )
    assert got.min() >= 0.0
    # Each wave seen through (4/3π) cos⁴ of half the angle.
    expected = 4 / (3 * np.pi) * np.cos(0.5 * (DIRECTIONS[:, None] - nu)) ** 4 @ share
    np.testing.assert_allclose(got[0], expected, atol=1e-12)


def edited(tmp_path: Path, files: list[Path], place: int, old: str, new: str) -> list[Path]:
    """Copies of the files with `old` replaced once in one of them."""
    copies = [Path(shutil.copy(path, tmp_path)) for path in files]
    text = copies[place].read_text()
    assert old in text
    copies[place].write_text(text.replace(old, new, 1))
    return copies


@pytest.mark.parametrize(
    ("place", "old", "new", "message"),
    [
        (0, "8.058 (0.100)", "999.00 (0.100)", "no density there"),
        (0, "8.058 (0.100)", "-0.100 (0.100)", "no density there"),
        (0, "8.058 (0.100)", "nan (0.100)", "no density there"),
        (0, "8.058 (0.100)", "MM (0.100)", "cut short or damaged in line 2"),
        (0, "8.058 (0.100)", "8.058", "cut short or damaged in line"),
        (1, "45.0 (0.100)", "999.0 (0.100)", "at 0.1 Hz from an unknown direction"),
        (3, "0.95 (0.100)", "999.00 (0.100)", "at 0.1 Hz from an unknown direction"),
        (4, "0.82 (0.100)", "0.60 (0.100)", "r2 0.6 of 45° at 0.1 Hz"),
        (2, "45.0 (0.100)", "135.0 (0.100)", "r2 0.82 of 135° at 0.1 Hz"),
        (3, "0.95 (0.100)", "1.05 (0.100)", "r1 1.05"),
        (3, "0.95 (0.100)", "-0.95 (0.100)", "r1 -0.95"),
        (3, "0.95 (0.100)", "195.0 (0.100)", "195 in"),
        (1, "2020 06 08 03 50", "2020 06 08 03 40", "time is not there"),
        (0, "2020 06 08 03 50", "2020 13 08 03 50", "cannot be read"),
        (0, "2020 06 08 03 50", "2020 06 08 02 50", "time is not there"),
        (3, "(0.485)", "(0.495)", "cut short or damaged in line 3"),
        (3, "r1_1", "r2_1", "another quantity"),
        (0, "#YY", "#Station", "no NDBC file"),
    ],
)
def test_files_that_cannot_be_believed_are_refused(
    tmp_path: Path, place: int, old: str, new: str, message: str
) -> None:
    files = edited(tmp_path, REALTIME, place, old, new)
    with pytest.raises(PanelsimError) as refusal:
        read_ndbc_spectrum(files, time="2020-06-08 03:50")
    assert message in str(refusal.value)


def test_frequencies_that_differ_between_files_are_refused(tmp_path: Path) -> None:
    files = edited(tmp_path, HISTORICAL, 3, ".4850", ".4950")
    with pytest.raises(PanelsimError, match="the same freq") as refusal:
        read_ndbc_spectrum(files, time="2020-06-08 03:40")
    assert "99999j2020.txt" in str(refusal.value)


def test_what_is_missing_at_other_times_does_not_matter(tmp_path: Path) -> None:
    files = edited(tmp_path, HISTORICAL, 0, "0.01", "999.00")  # 01:40
    read_ndbc_spectrum(files, time="2020-06-08 03:40")
    with pytest.raises(PanelsimError, match="no density there"):
        read_ndbc_spectrum(files, time="2020-06-08 01:40")


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("end", [1, 40, 700])
def test_files_cut_short_are_refused(tmp_path: Path, kind: str, end: int) -> None:
    """Without their last letters: within a number, and without the end of the last line."""
    path = tmp_path / "short.txt"
    path.write_text(FORMATS[kind][0][0].read_text().rstrip()[:-end])
    with pytest.raises(PanelsimError, match="cut short or damaged in line"):
        read_ndbc_spectrum(path)


def test_a_line_cut_short_is_refused_by_its_number(tmp_path: Path) -> None:
    for kind, (files, _) in FORMATS.items():
        lines = files[0].read_text().splitlines()
        path = tmp_path / f"{kind}.txt"
        path.write_text("\n".join([*lines[:2], lines[2][:200], lines[3]]) + "\n")
        with pytest.raises(PanelsimError, match="line 3"):
            read_ndbc_spectrum(path, time="2020-06-08 03:50")


def test_a_single_line_cut_short_is_refused(tmp_path: Path) -> None:
    """Nothing to compare it with, but its last value has no frequency."""
    path = tmp_path / "single.txt"
    header, first, *_ = REALTIME[0].read_text().splitlines()
    path.write_text(f"{header}\n{first.removesuffix('(0.485) ')}\n")
    with pytest.raises(PanelsimError, match="line 2"):
        read_ndbc_spectrum(path)


def test_wrong_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="number of NDBC files") as refusal:
        read_ndbc_spectrum(REALTIME[:3])
    assert "3" in str(refusal.value)
    with pytest.raises(PanelsimError, match="another quantity"):
        read_ndbc_spectrum([REALTIME[i] for i in (0, 1, 2, 4, 3)], time="2020-06-08 03:50")
    # Historical files do not say what they hold; directions are no r1.
    with pytest.raises(PanelsimError, match="r1 and r2 are none"):
        read_ndbc_spectrum([HISTORICAL[i] for i in (0, 3, 4, 1, 2)], time="2020-06-08 03:40")
    with pytest.raises(PanelsimError, match="read_ndbc_meteorology"):
        read_ndbc_spectrum(DATA / "99999h2020.txt")
    with pytest.raises(PanelsimError, match="read_ndbc_spectrum"):
        read_ndbc_meteorology(HISTORICAL[0])
    for reader in (read_ndbc_spectrum, read_ndbc_meteorology):
        with pytest.raises(PanelsimError, match="cannot be read"):
            reader(tmp_path / "missing.txt")
        (tmp_path / "empty.txt").touch()
        with pytest.raises(PanelsimError, match="no NDBC file"):
            reader(tmp_path / "empty.txt")
        (tmp_path / "short.gz").write_bytes(gzip.compress(HISTORICAL[0].read_bytes())[:-20])
        with pytest.raises(PanelsimError, match="cannot be read"):
            reader(tmp_path / "short.gz")
        (tmp_path / "binary.txt").write_bytes(b"\xff\xfe\x00\x80" * 20)
        with pytest.raises(PanelsimError, match="cannot be read"):
            reader(tmp_path / "binary.txt")
    (tmp_path / "header.txt").write_text(HISTORICAL[0].read_text().splitlines()[0] + "\n")
    with pytest.raises(PanelsimError, match="no spectrum"):
        read_ndbc_spectrum(tmp_path / "header.txt")
    with pytest.raises(PanelsimError, match="which time") as refusal:
        read_ndbc_spectrum(HISTORICAL[0])
    assert "3, 2020-06-08 01:40 to 2020-06-08 03:40" in str(refusal.value)


def test_compressed_files_are_read(tmp_path: Path) -> None:
    path = tmp_path / "99999w2020.txt.gz"
    path.write_bytes(gzip.compress(HISTORICAL[0].read_bytes()))
    got = read_ndbc_spectrum(str(path), time="2020-06-08 02:40")
    assert isinstance(got, TableSpectrum)
    assert got.significant_wave_height == pytest.approx(2.0, rel=0.01)  # to 0.485 Hz, two digits


def test_old_files_without_minutes_are_read(tmp_path: Path) -> None:
    path = tmp_path / "99999w2000.txt"
    path.write_text("YYYY MM DD hh   .090   .100   .110\n2000 01 01 05    .50   2.00    .25\n")
    got = read_ndbc_spectrum(path, time="2000-01-01 05:00")
    assert isinstance(got, TableSpectrum)
    np.testing.assert_allclose(got.density_table, np.array([0.5, 2.0, 0.25]) / (2 * np.pi), rtol=1e-12)
    np.testing.assert_allclose(got.frequency, 2 * np.pi * np.array([0.09, 0.1, 0.11]), rtol=1e-12)
    assert read_ndbc_spectrum(path) is not None  # the only time needs no choice


def test_realtime_meteorology() -> None:
    table = read_ndbc_meteorology(DATA / "99999.txt")
    assert [str(time) for time in table.time] == [
        f"2020-06-08T{at}" for at in ("02:40", "02:50", "03:50", "04:00")
    ]
    nan = np.nan
    np.testing.assert_array_equal(table.significant_wave_height, [nan, 2.0, 3.0, nan])
    np.testing.assert_array_equal(table.peak_period, [nan, 9.0, 10.0, nan])
    np.testing.assert_array_equal(table.zero_crossing_period, [nan, 6.4, 7.1, nan])
    np.testing.assert_allclose(table.sea_direction, [nan, nan, np.pi / 4, nan], rtol=1e-14)
    np.testing.assert_array_equal(table.wind_speed, [8.0, nan, 8.0, 7.0])
    # APD is √(m0/m2), here of the Bretschneider sea of 3 m and 10 s, 7.10 s; m0/m1 is 7.72 s.
    assert Bretschneider(3.0, 10.0).zero_crossing_period == pytest.approx(
        table.zero_crossing_period[2], abs=0.05
    )


def test_historical_meteorology() -> None:
    table = read_ndbc_meteorology(DATA / "99999h2020.txt")
    np.testing.assert_array_equal(table.significant_wave_height, [1.5, np.nan, 2.0])
    np.testing.assert_array_equal(table.wind_speed, [6.1, 6.3, np.nan])
    np.testing.assert_allclose(np.rad2deg(table.sea_direction), [48.0, np.nan, 46.0], rtol=1e-14)
    assert table.spectrum_at("2020-06-08 02:40") == Bretschneider(2.0, 9.09)
    assert table.sea_direction_at("2020-06-08 02:40") == pytest.approx(np.deg2rad(46.0), rel=1e-14)


@pytest.mark.parametrize(
    ("date_columns", "date", "time"),
    [
        ("YY MM DD hh", "97 01 02 03", "1997-01-02T03:00"),
        ("YYYY MM DD hh", "2003 01 02 03", "2003-01-02T03:00"),
        ("YYYY MM DD hh mm", "2006 01 02 03 07", "2006-01-02T03:07"),
    ],
)
def test_meteorology_of_older_years(tmp_path: Path, date_columns: str, date: str, time: str) -> None:
    path = tmp_path / "99999h.txt"
    rows = ("WD WSPD GST WVHT DPD APD MWD BAR", "120 5.0 6.0 1.5 8.0 5.7 270 1016.5")
    path.write_text(f"{date_columns} {rows[0]}\n{date} {rows[1]}\n")
    table = read_ndbc_meteorology(path)
    assert str(table.time[0]) == time
    assert table.spectrum_at() == Bretschneider(1.5, 8.0)  # the only time needs no choice
    assert table.sea_direction_at() == pytest.approx(1.5 * np.pi, rel=1e-14)


def test_seas_that_the_buoy_has_not_told_are_refused() -> None:
    table = read_ndbc_meteorology(DATA / "99999.txt")
    with pytest.raises(
        PanelsimError, match="significant_wave_height and peak_period at 2020-06-08T04:00"
    ) as refusal:
        table.spectrum_at("2020-06-08 04:00")
    assert "2 of 4" in str(refusal.value) and "the nearest is 2020-06-08T03:50" in str(refusal.value)
    with pytest.raises(PanelsimError, match="sea_direction at 2020-06-08T02:50") as refusal:
        table.sea_direction_at("2020-06-08 02:50")
    assert "1 of 4" in str(refusal.value)
    with pytest.raises(PanelsimError, match="which time"):
        table.spectrum_at()
    with pytest.raises(PanelsimError, match="not there"):
        table.spectrum_at("2020-06-08 03:00")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (" 99.0 99.00\n2020 06 08 02 40", "\n2020 06 08 02 40", "line 4"),
        ("  1.50 ", "  1,50 ", "Line 3 has no number"),
        ("2020 06 08 01 50", "2020 06 31 01 50", "Line 4 does not begin with a date"),
        ("2020 06 08 01 50", "2020 06 x 01 50", "Line 4 does not begin with a date"),
        (" WVHT ", " SwH ", "no WVHT"),
    ],
)
def test_meteorology_that_cannot_be_believed_is_refused(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    (path,) = edited(tmp_path, [DATA / "99999h2020.txt"], 0, old, new)
    with pytest.raises(PanelsimError) as refusal:
        read_ndbc_meteorology(path)
    assert message in str(refusal.value)
