"""Spreading functions, directional spectra and their tables."""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import gamma

from panelsim.errors import PanelsimError
from panelsim.seaway.direction.directional_table import DirectionalTable, read_directional_table
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import CosineHalfAngle, CosinePower, CosineSquared, Spreading
from panelsim.seaway.direction.ten_parameter import TenParameterSpectrum
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.ochi_hubble import OchiHubble

DEG = np.pi / 180
SEA = Bretschneider(4.0, 10.0)
# A swell from 30° and a wind sea from 110°.
TEN = TenParameterSpectrum((3.0, 2.0), (14.0, 7.0), (2.5, 1.2), (30 * DEG, 110 * DEG), (12.0, 3.0))

OMEGA = np.array([0.3, 0.5, 0.9, 1.4])
COMPASS = DEG * np.array([10.0, 80.0, 150.0, 230.0, 300.0])
TABLE = 0.1 * (np.arange(20.0).reshape(4, 5) % 7) + 0.01


# --- spreading ----------------------------------------------------------------------------------------------


def test_cosine_squared_at_its_values() -> None:
    """(51) with γ_s = π/2 is (2/π) cos²; with another angle it is half its height at half the angle."""
    assert CosineSquared().density(0.0) == pytest.approx(2 / np.pi, rel=1e-15)
    assert CosineSquared().density(60 * DEG) == pytest.approx(0.5 / np.pi, rel=1e-14)
    narrow = CosineSquared(40 * DEG)
    assert narrow.density(0.0) == pytest.approx(1 / (40 * DEG), rel=1e-15)
    assert narrow.density([-20 * DEG, 20 * DEG]) == pytest.approx(0.5 / (40 * DEG), rel=1e-14)
    np.testing.assert_array_equal(narrow.density([-41 * DEG, 41 * DEG, np.pi]), 0.0)  # (52)
    # 350° from 10° is an offset of −20°.
    assert narrow.density(350 * DEG - 10 * DEG) == pytest.approx(0.5 / (40 * DEG), rel=1e-12)


@pytest.mark.parametrize(("power", "peak"), [(2, 2 / np.pi), (4, 8 / (3 * np.pi)), (1, 0.5), (3, 0.75)])
def test_cosine_power_has_its_own_normalisation(power: float, peak: float) -> None:
    """∫ cosⁿ over ±π/2 is π/2, 3π/8, 2 and 4/3 for n = 2, 4, 1 and 3; 2/π for all would be up to 27 % off."""
    assert CosinePower(power).density(0.0) == pytest.approx(peak, rel=1e-14)
    assert CosinePower(power).density(60 * DEG) == pytest.approx(peak * 0.5**power, rel=1e-13)
    np.testing.assert_array_equal(CosinePower(power).density([100 * DEG, 180 * DEG, -100 * DEG]), 0.0)


@pytest.mark.parametrize("spread", [0.5, 1.0, 2.0, 10.0, 80.0])
def test_cosine_half_angle_is_55_over_the_full_circle(spread: float) -> None:
    """A(P) of (55), typed here as printed."""
    printed = 2 ** (2 * spread - 1) * gamma(spread + 1) ** 2 / (np.pi * gamma(2 * spread + 1))
    wide = CosineHalfAngle(spread)
    assert wide.density(0.0) == pytest.approx(printed, rel=1e-11)
    assert wide.density(2.0) == pytest.approx(printed * np.cos(1.0) ** (2 * spread), rel=1e-10)


def test_the_printed_cut_at_a_right_angle_would_lose_energy() -> None:
    """(53), (54): within ±π/2 only 0.82 of the area at P = 1 would be left. Ours goes around the circle."""
    spreading = CosineHalfAngle(1.0)
    assert quad(spreading.density, -np.pi / 2, np.pi / 2)[0] == pytest.approx(0.5 + 1 / np.pi, rel=1e-10)
    assert quad(spreading.density, -np.pi, np.pi)[0] == pytest.approx(1.0, rel=1e-10)
    assert spreading.density(120 * DEG) > 0.0


def test_very_narrow_spreading_does_not_overflow() -> None:
    """Γ(2001) is beyond the floats; A(s) → √(s/4π)·(1 + 1/(8s)…) for large s, by Stirling."""
    peak = CosineHalfAngle(1000.0).density(0.0)
    # The next term is of order 1/s².
    assert peak == pytest.approx(np.sqrt(1000 / (4 * np.pi)) * (1 + 3 / 8000) / np.exp(1 / 4000), rel=1e-6)
    assert quad(CosineHalfAngle(1000.0).density, -0.5, 0.5, limit=100)[0] == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize(
    ("spreading", "mean_cosine"),
    [
        (CosineSquared(), 8 / (3 * np.pi)),
        (CosineSquared(np.pi), 0.5),
        (CosinePower(2.0), 8 / (3 * np.pi)),
        (CosinePower(1.0), np.pi / 4),
        (CosineHalfAngle(1.0), 0.5),
        (CosineHalfAngle(15.0), 15 / 16),
    ],
)
def test_standard_deviation(spreading: Spreading, mean_cosine: float) -> None:
    """√(2(1 − R)): 31.5° for cos² over 90°."""
    assert spreading.mean_cosine == pytest.approx(mean_cosine, rel=1e-14)
    assert spreading.standard_deviation == pytest.approx(np.sqrt(2 - 2 * mean_cosine), rel=1e-12)


def test_narrow_spreading_has_the_ordinary_standard_deviation() -> None:
    """For small angles it is that of cos² over ±γ on a line, γ √(1/3 − 2/π²)."""
    ordinary = 0.01 * np.sqrt(1 / 3 - 2 / np.pi**2)
    # Relative difference of order γ².
    assert CosineSquared(0.01).standard_deviation == pytest.approx(ordinary, rel=1e-4)


def test_nan_offsets_stay_nan() -> None:
    for spreading in (CosineSquared(), CosinePower(2.0), CosineHalfAngle(2.0)):
        assert np.isnan(spreading.density(np.nan))


# --- spread spectra -----------------------------------------------------------------------------------------


def test_spread_spectrum_is_a_product() -> None:
    """(50), on frequencies down and directions across."""
    spectrum = SpreadSpectrum(SEA, CosineSquared(), 300 * DEG)
    got = spectrum.density(OMEGA[:, None], COMPASS)
    assert got.shape == (4, 5)
    assert got[1, 4] == pytest.approx(SEA.density(0.5) * 2 / np.pi, rel=1e-14)
    assert got[2, 3] == pytest.approx(SEA.density(0.9) * 2 / np.pi * np.cos(70 * DEG) ** 2, rel=1e-12)
    assert got[1, 0] == pytest.approx(SEA.density(0.5) * 2 / np.pi * np.cos(70 * DEG) ** 2, rel=1e-12)
    assert got[1, 2] == 0.0
    assert spectrum.point is SEA
    for omega in (None, 0.5):
        assert spectrum.mean_direction(omega) == pytest.approx(300 * DEG, rel=1e-13)
        assert spectrum.directional_spread(omega) == pytest.approx(
            CosineSquared().standard_deviation, rel=1e-13
        )
    assert np.isnan(spectrum.mean_direction([0.0]))


def test_directions_of_the_report() -> None:
    """cos² over 90° by 20° is −80° to 80° about the mean; the ends of the support have no energy."""
    spectrum = SpreadSpectrum(SEA, CosineSquared(), 10 * DEG)
    expected = np.remainder(np.arange(-70.0, 91.0, 20.0), 360)
    np.testing.assert_allclose(spectrum.grid_directions(20 * DEG) / DEG, expected, atol=1e-10)
    np.testing.assert_allclose(spectrum.grid_intervals(20 * DEG), np.full(9, 20 * DEG), rtol=1e-15)
    assert len(spectrum.grid_directions(30 * DEG)) == 5
    around = SpreadSpectrum(SEA, CosineHalfAngle(2.0), 0.0).grid_directions(30 * DEG)
    assert len(np.unique(np.round(around, 9))) == len(around) == 11


def test_the_grid_of_other_spectra_starts_at_north() -> None:
    np.testing.assert_allclose(TEN.grid_directions(90 * DEG) / DEG, [0, 90, 180, 270], atol=1e-12)
    np.testing.assert_allclose(TEN.grid_intervals(30 * DEG), np.full(12, 30 * DEG), rtol=1e-15)
    with pytest.raises(PanelsimError, match="does not divide") as refusal:
        TEN.grid_directions(25 * DEG)
    assert "25°" in str(refusal.value) and "25.7143°" in str(refusal.value)


@pytest.mark.parametrize("step", [None, 0.0, -0.1, np.nan, 20, "20", True, 1e-5])
def test_direction_steps_that_are_none_are_refused(step: float) -> None:
    with pytest.raises(PanelsimError, match="direction step in radians"):
        TEN.grid_directions(step)


# --- ten parameters -----------------------------------------------------------------------------------------


def test_ten_parameters_integrate_to_six() -> None:
    """∫ S(ω, ν) dν is the Ochi-Hubble spectrum: the trapezoid rule on a circle is exact for P = 12 and 3."""
    omega = np.linspace(0.25, 2.0, 15)
    directions = np.arange(72) * 5 * DEG
    area = TEN.density(omega[:, None], directions).sum(axis=1) * 5 * DEG
    np.testing.assert_allclose(area, TEN.point.density(omega), rtol=1e-12)
    assert isinstance(TEN.point, OchiHubble)
    assert TEN.point.moment(0) == pytest.approx((3.0**2 + 2.0**2) / 16, rel=1e-12)


def test_each_system_keeps_its_own_direction() -> None:
    """Below the swell's peak the sea comes from 30°, in the tail from 110°; the overall mean lies between."""
    swell, sea = TEN.mean_direction([0.4, 2.5]) / DEG
    assert swell == pytest.approx(30, abs=1e-3)
    assert sea == pytest.approx(110, abs=1.0)  # what the swell has left there
    np.testing.assert_allclose(
        TEN.directional_spread([0.4]), CosineHalfAngle(12.0).standard_deviation, rtol=1e-6
    )
    vector = 9 * 12 / 13 * np.exp(1j * 30 * DEG) + 4 * 3 / 4 * np.exp(1j * 110 * DEG)
    assert TEN.mean_direction() == pytest.approx(np.angle(vector), rel=1e-12)
    assert TEN.directional_spread() == pytest.approx(np.sqrt(2 - 2 * abs(vector) / 13), rel=1e-12)
    assert np.isnan(TEN.mean_direction(0.0)) and np.isnan(TEN.directional_spread([0.0]))


def test_one_system_is_a_spread_spectrum() -> None:
    """With λ = 1 and one system: Bretschneider with cos^{2P}."""
    one = TenParameterSpectrum((4.0,), (10.0,), (1.0,), (200 * DEG,), (5.0,))
    same = SpreadSpectrum(SEA, CosineHalfAngle(5.0), 200 * DEG)
    np.testing.assert_allclose(
        one.density(OMEGA[:, None], COMPASS), same.density(OMEGA[:, None], COMPASS), rtol=1e-12
    )


def test_opposed_seas_have_no_mean_direction() -> None:
    both = TenParameterSpectrum((2.0, 2.0), (9.0, 9.0), (1.0, 1.0), (0.0, np.pi), (4.0, 4.0))
    assert np.isnan(both.mean_direction())
    assert both.directional_spread() == pytest.approx(np.sqrt(2), rel=1e-12)


# --- tables -------------------------------------------------------------------------------------------------


def table() -> DirectionalTable:
    return DirectionalTable(OMEGA, COMPASS, TABLE)


def test_a_table_gives_its_own_values_and_the_lines_between() -> None:
    t = table()
    np.testing.assert_allclose(t.density(OMEGA[:, None], COMPASS), TABLE, rtol=1e-13)
    quarter = t.density(0.4, COMPASS[1] + 0.25 * (COMPASS[2] - COMPASS[1]))
    assert quarter == pytest.approx(
        0.5 * (0.75 * TABLE[0, 1] + 0.25 * TABLE[0, 2] + 0.75 * TABLE[1, 1] + 0.25 * TABLE[1, 2]), rel=1e-13
    )
    # From 300° through north to 10° are 70°: at 0° six sevenths of the way.
    north = TABLE[2, 4] / 7 + TABLE[2, 0] * 6 / 7
    for direction in (0.0, 2 * np.pi, -2 * np.pi):
        assert t.density(0.9, direction) == pytest.approx(north, rel=1e-13)
    assert t.density([0.0, -1.0], 1.0).tolist() == [0.0, 0.0]


def test_a_table_in_any_order_of_directions_is_the_same_sea() -> None:
    order = [3, 0, 4, 2, 1]
    shifted = np.array([c - 360 * DEG if c > np.pi else c for c in COMPASS])
    other = DirectionalTable(OMEGA, shifted[order], TABLE[:, order])
    np.testing.assert_allclose(other.sea_direction, COMPASS, rtol=1e-14)
    np.testing.assert_allclose(
        other.density(0.7, COMPASS + 0.3), table().density(0.7, COMPASS + 0.3), rtol=1e-12
    )


def test_integrals_of_a_table_are_exact() -> None:
    """Against quadrature between the columns, where the interpolation is smooth."""
    t = table()
    edges = [*COMPASS, COMPASS[0] + 2 * np.pi]
    for omega in (0.3, 0.63, 1.4):

        def part(weight: Callable[[float], float], omega: float = omega) -> float:
            def integrand(v: float) -> float:
                return weight(v) * t.density(omega, np.remainder(v, 2 * np.pi))

            return sum(quad(integrand, a, b)[0] for a, b in pairwise(edges))

        area = part(lambda v: 1.0)
        assert t.point.density(omega) == pytest.approx(area, rel=1e-11)
        vector = (part(np.cos) + 1j * part(np.sin)) / area
        assert t.mean_vector(omega) == pytest.approx(vector, rel=1e-10)
    areas = TABLE @ t.grid_intervals(None)
    assert t.point.moment(0) == pytest.approx(np.trapezoid(areas, OMEGA), rel=1e-12)
    vectors = np.array([complex(t.mean_vector(w)) for w in OMEGA])
    assert t.mean_vector() == pytest.approx(
        np.trapezoid(vectors * areas, OMEGA) / t.point.moment(0), rel=1e-12
    )


def test_a_table_of_a_spread_sea_is_that_sea() -> None:
    """Mean direction and spread of cos² over 5° columns: linear interpolation widens it by order h²."""
    spectrum = SpreadSpectrum(SEA, CosineSquared(), 350 * DEG)
    omega, directions = np.linspace(0.2, 3.0, 281), np.arange(0, 360, 5) * DEG
    t = DirectionalTable(omega, directions, spectrum.density(omega[:, None], directions))
    np.testing.assert_allclose(t.mean_direction(omega[20:]) / DEG, 350.0, atol=1e-9)
    # h²/6 = 0.0013 adds to the variance 0.30 of the spread.
    np.testing.assert_allclose(
        t.directional_spread(omega[20:]), CosineSquared().standard_deviation, rtol=3e-3
    )
    assert t.mean_direction() / DEG == pytest.approx(350.0, abs=1e-9)
    assert t.point.significant_wave_height == pytest.approx(4.0, rel=5e-3)  # the tail beyond 3 rad/s


def test_grids_of_a_table() -> None:
    t = table()
    np.testing.assert_allclose(t.grid_directions(None), COMPASS, rtol=1e-14)
    np.testing.assert_allclose(t.grid_intervals(None) / DEG, [70, 70, 75, 75, 70], rtol=1e-12)
    np.testing.assert_allclose(t.grid_directions(60 * DEG) / DEG, [0, 60, 120, 180, 240, 300], atol=1e-12)
    assert t.grid_intervals(60 * DEG) == pytest.approx(60 * DEG, rel=1e-14)


def test_a_table_cannot_be_changed_behind_its_back() -> None:
    density = TABLE.copy()
    t = DirectionalTable(OMEGA, COMPASS, density)
    density[:] = 0.0
    assert t.density(0.5, COMPASS[0]) == pytest.approx(TABLE[1, 0])
    with pytest.raises(ValueError, match="read-only"):
        t.density_table[0, 0] = 1.0


def test_frequencies_outside_a_table_are_refused() -> None:
    for omega in (0.29, 1.41, [0.5, 2.0]):
        with pytest.raises(PanelsimError, match="outside the table") as refusal:
            table().density(omega, 1.0)
        assert "0.3 to 1.4 rad/s" in str(refusal.value)
    with pytest.raises(PanelsimError, match="outside the table"):
        table().mean_direction(3.0)


def with_one(value: float) -> np.ndarray:
    changed = TABLE.copy()
    changed[2, 3] = value
    return changed


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ((OMEGA, COMPASS, with_one(-1.0)), "negative"),
        ((OMEGA, COMPASS, with_one(np.inf)), "not finite"),
        ((OMEGA, COMPASS, with_one(np.nan)), "NaN"),
        ((OMEGA, COMPASS, 0 * TABLE), "no energy"),
        ((OMEGA, COMPASS, TABLE.T), "does not fit"),
        ((OMEGA[:3], COMPASS, TABLE), "does not fit"),
        ((OMEGA[:1], COMPASS, TABLE[:1]), "does not fit"),
        ((OMEGA, np.empty(0), np.empty((4, 0))), "does not fit"),
        ((OMEGA[::-1], COMPASS, TABLE), "above the one before"),
        ((OMEGA - 0.3, COMPASS, TABLE), "not positive"),
        ((OMEGA, COMPASS / DEG, TABLE), "radians"),
        ((OMEGA, COMPASS[[0, 1, 2, 3, 3]], TABLE), "twice"),
        ((OMEGA, DEG * np.array([0, 90, 180, 270, 360]), TABLE), "twice"),
        ((OMEGA, DEG * np.array([0, 60, 120, 180, 240]), TABLE), "gap"),
        ((OMEGA, ["north"] * 5, TABLE), "radians"),
        ((OMEGA, COMPASS, [["a"] * 5] * 4), "no numbers"),
    ],
)
def test_tables_that_are_none_are_refused(columns: tuple[object, ...], words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        DirectionalTable(*columns)  # type: ignore[arg-type]


def test_a_gap_is_named() -> None:
    with pytest.raises(PanelsimError) as refusal:
        DirectionalTable(OMEGA, DEG * np.array([0, 60, 120, 180, 240]), TABLE)
    assert "120° after 240°" in str(refusal.value)


# --- files --------------------------------------------------------------------------------------------------

RADIANS = "frequency_rad_s/direction_from_deg/m2_s_per_rad2"
HERTZ = "frequency_hz/direction_from_deg/m2_per_hz_deg"


def write(path: Path, corner: str, frequency: np.ndarray, degrees: np.ndarray, density: np.ndarray) -> Path:
    lines = [",".join([corner, *map(repr, degrees.tolist())])]
    lines += [
        ",".join(map(repr, [f, *row])) for f, row in zip(frequency.tolist(), density.tolist(), strict=True)
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_table_is_read_in_both_units(tmp_path: Path) -> None:
    """The same sea written per rad/s and rad, and per Hz and degree: S_f,deg = S · 2π · π/180."""
    first = read_directional_table(write(tmp_path / "a.csv", RADIANS, OMEGA, COMPASS / DEG, TABLE))
    np.testing.assert_allclose(first.density_table, TABLE, rtol=1e-15)
    np.testing.assert_allclose(first.sea_direction, COMPASS, rtol=1e-15)
    per_hertz = TABLE * 2 * np.pi * DEG
    second = read_directional_table(
        write(tmp_path / "b.csv", HERTZ, OMEGA / (2 * np.pi), COMPASS / DEG, per_hertz)
    )
    np.testing.assert_allclose(second.frequency, OMEGA, rtol=1e-14)
    np.testing.assert_allclose(second.density_table, TABLE, rtol=1e-14)


GOOD = f"{RADIANS},0,90,180,270\n0.4,1,2,3,4\n0.8,1,1,1,1\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (GOOD.replace(RADIANS, "frequency_rad_s"), "units"),
        ("", "cut short"),
        ("\n", "units"),
        (GOOD[:-1], "cut short"),
        (GOOD[:-3] + "\n", "line 3 does not hold 5 numbers"),
        (GOOD.replace("3,4", "x,4"), "line 2 does not hold 5 numbers"),
        (GOOD.replace("3,4", "nan,4"), "line 2"),
        (GOOD.replace("90", "E"), "line 1"),
        (GOOD.replace("270", "2700"), "beyond 360°"),
        (GOOD.replace("3,4", "-3,4"), "negative"),
        (f"{RADIANS},0,90,180,270\n", "does not fit"),
        (f"{RADIANS}\n0.4\n0.8\n", "does not fit"),
    ],
)
def test_files_that_are_none_are_refused(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "sea.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(PanelsimError, match=words):
        read_directional_table(path)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="cannot be read") as refusal:
        read_directional_table(tmp_path / "none.csv")
    assert "none.csv" in str(refusal.value)


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        (lambda: CosineSquared(0.0), "spreading_angle"),
        (lambda: CosineSquared(90), "circle"),
        (lambda: CosineSquared(np.nan), "spreading_angle"),
        (lambda: CosinePower(-2.0), "power"),
        (lambda: CosinePower("2"), "power"),
        (lambda: CosineHalfAngle(np.inf), "spread"),
        (lambda: CosineHalfAngle(True), "spread"),
        (lambda: SpreadSpectrum(SEA, 2.0, 0.0), "spreading"),
        (lambda: SpreadSpectrum("sea", CosineSquared(), 0.0), "point_spectrum"),
        (lambda: SpreadSpectrum(SEA, CosineSquared(), 150), "radians"),
        (lambda: SpreadSpectrum(SEA, CosineSquared(), np.nan), "radians"),
        (lambda: SpreadSpectrum(SEA, CosineSquared(), [0.0, 1.0]), "no angle"),
        (lambda: SpreadSpectrum(SEA, CosineSquared(), 0.0).density(0.5, 270), "radians"),
        (lambda: TenParameterSpectrum((2.0,), (9.0,), (1.0,), (0.0, 1.0), (2.0,)), "sea_directions"),
        (lambda: TenParameterSpectrum((2.0,), (9.0,), (1.0,), (0.0,), 2.0), "spreads"),
        (lambda: TenParameterSpectrum((2.0,), (9.0,), (1.0,), (90.0,), (2.0,)), "radians"),
        (lambda: TenParameterSpectrum((2.0,), (9.0,), (1.0,), (0.0,), (-2.0,)), "spread"),
        (lambda: TenParameterSpectrum((2.0,), (9.0, 8.0), (1.0,), (0.0,), (2.0,)), "as many"),
        (lambda: TenParameterSpectrum((20.0,), (4.0,), (1.0,), (0.0,), (2.0,)), "steep"),
    ],
)
def test_bad_input_is_refused(bad: object, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        bad()  # type: ignore[operator]
