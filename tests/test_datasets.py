"""Spectra in wavespectra's layout: conversions, directions, choice and refusals."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import write_whole
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.direction.directional_table import DirectionalTable
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import CosineSquared
from panelsim.seaway.dispersion import wavenumber
from panelsim.seaway.exchange.datasets import dataset_from_spectrum, open_spectrum, spectrum_from_dataset
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.table import TableSpectrum

# Below 0.333 Hz, above which wavespectra adds a tail of its own to the height.
FREQUENCY = np.arange(0.04, 0.325, 0.005)  # Hz
DIRECTION = np.arange(0.0, 360.0, 15.0)  # degrees


def hump(frequency: float, direction: float, height: float) -> FloatArray:
    """A narrow sea (F, D) [m²/Hz/degree] about a frequency [Hz] and a direction [degrees, from]."""
    off = np.deg2rad(DIRECTION - direction)
    shape = np.exp(-0.5 * ((FREQUENCY - frequency) / 0.01) ** 2)[:, None] * np.exp(30 * (np.cos(off) - 1))
    return height**2 / 16 * shape / (shape.sum() * 0.005 * 15.0)


# Swell from the north-east and a wind sea from east by south: no direction mirrors the other.
ASYMMETRIC = hump(0.1, 45.0, 3.0) + hump(0.2, 105.0, 1.0)


def dataset(density: FloatArray, **coordinates: object) -> xr.Dataset:
    names = (*coordinates, "freq", "dir")[: density.ndim] if coordinates else ("freq", "dir")
    held = {**coordinates, "freq": FREQUENCY, "dir": DIRECTION}
    return xr.Dataset({"efth": (names, density)}, {name: held[name] for name in names})


def accessor_values(spectra: xr.Dataset) -> list[float]:
    """H_s, T_p and mean direction as wavespectra has them."""
    return [float(getattr(spectra.spec, name)()) for name in ("hs", "tp", "dm")]


def test_density_by_its_units() -> None:
    """1 m²/Hz/degree is (1/2π) (180/π) m² s/rad², by hand 9.118906527810399; per Hz alone 1/2π."""
    table = spectrum_from_dataset(dataset(np.ones((len(FREQUENCY), len(DIRECTION)))))
    assert isinstance(table, DirectionalTable)
    assert table.density(1.0, 0.3) == pytest.approx(9.118906527810399, rel=1e-12)
    np.testing.assert_allclose(table.frequency, 2 * np.pi * FREQUENCY, rtol=1e-14)
    np.testing.assert_allclose(table.sea_direction, np.deg2rad(DIRECTION), rtol=1e-14)
    point = spectrum_from_dataset(xr.Dataset({"efth": ("freq", FREQUENCY / 0.3)}, {"freq": FREQUENCY}))
    assert isinstance(point, TableSpectrum)
    assert point.density(2 * np.pi * 0.3) == pytest.approx(1 / (2 * np.pi), rel=1e-12)


def test_height_and_direction_agree_with_wavespectra() -> None:
    import wavespectra  # noqa: F401 - for the accessor

    held = dataset(ASYMMETRIC)
    table = spectrum_from_dataset(held)
    assert isinstance(table, DirectionalTable)
    # wavespectra sums bins, the table trapezoids: apart by half of the end bins, 1e-8 of the peak.
    assert 4 * np.sqrt(table.point.moment(0)) == pytest.approx(float(held.spec.hs()), rel=1e-7)
    assert np.rad2deg(table.mean_direction()) == pytest.approx(float(held.spec.dm()), abs=1e-4)


@pytest.mark.parametrize("density", [hump(0.1, 45.0, 4.0), ASYMMETRIC])
def test_round_trip_keeps_what_wavespectra_finds(density: FloatArray) -> None:
    held = dataset(density)
    back = dataset_from_spectrum(spectrum_from_dataset(held))
    assert accessor_values(back) == pytest.approx(accessor_values(held), rel=1e-6)
    # Two divisions and multiplications by 2π and π/180.
    np.testing.assert_allclose(back["efth"], held["efth"], rtol=1e-13)
    np.testing.assert_allclose(back["dir"], held["dir"], atol=1e-12)
    assert back["efth"].dims == ("freq", "dir")


@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 1000), first=st.floats(-90.0, 90.0), count=st.integers(4, 12))
def test_round_trip_of_any_table(seed: int, first: float, count: int) -> None:
    """Through unordered directions, as wave models write them, and back."""
    rng = np.random.default_rng(seed)
    direction = rng.permutation(first + 360.0 / count * np.arange(count))
    held = xr.Dataset(
        {"efth": (("dir", "freq"), rng.uniform(1e-6, 1e-5, (count, 9)))},
        {"freq": np.cumsum(rng.uniform(0.01, 0.05, 9)), "dir": direction},
    )
    back = dataset_from_spectrum(spectrum_from_dataset(held))
    for frequency, angle in [(2, 1), (8, 3), (0, 0)]:
        near = np.argmin(np.abs(np.remainder(back["dir"].values - direction[angle] + 180.0, 360.0) - 180.0))
        expected = float(held["efth"][angle, frequency])
        assert float(back["efth"][frequency, near]) == pytest.approx(expected, rel=1e-12)


def components_of(table: DirectionalTable, low: float, high: float) -> WaveComponents:
    """Waves of a band [Hz], crests together at the origin at t = 0, for a ship on course north."""
    omega = table.frequency[(table.frequency > 2 * np.pi * low) & (table.frequency < 2 * np.pi * high)]
    nu = table.sea_direction
    density = table.density(omega[:, None], nu)
    amplitude = np.sqrt(2 * density * 2 * np.pi * 0.005 * np.deg2rad(15.0))
    frequency, direction = np.broadcast_arrays(omega[:, None], nu)
    return WaveComponents(
        amplitude.ravel(), frequency.ravel(), direction.ravel() + np.pi, np.zeros(density.size)
    )


@pytest.mark.parametrize(("band", "comes_from"), [((0.06, 0.14), 45.0), ((0.16, 0.24), 105.0)])
def test_the_crest_comes_from_where_the_dataset_says(band: tuple[float, float], comes_from: float) -> None:
    """Before t = 0 the crest that is at the origin then stands off in that compass direction.

    Elevation in fixed axes, x north and y west, TM 2003-190 (1).
    """
    table = spectrum_from_dataset(dataset(ASYMMETRIC))
    assert isinstance(table, DirectionalTable)
    waves = components_of(table, *band)
    omega = 2 * np.pi * np.mean(band)
    time = -0.2 * 2 * np.pi / omega
    compass = np.deg2rad(np.arange(0.0, 360.0, 1.0))
    radius = -omega * time / wavenumber(omega)  # the crest goes ω/k
    x, y = radius * np.cos(compass), -radius * np.sin(compass)
    nu = waves.wave_heading - np.pi
    angle = wavenumber(waves.frequency) * (y[:, None] * np.sin(nu) - x[:, None] * np.cos(nu))
    elevation = np.cos(angle - waves.frequency * time - waves.phase) @ waves.amplitude
    # The two humps overlap by less than 1e-9; the ring is of 1°.
    assert np.rad2deg(compass[np.argmax(elevation)]) == pytest.approx(comes_from, abs=1.0)


def test_dataset_of_formulas() -> None:
    """A spread Bretschneider sea at one place by its formula, and its mean direction by wavespectra."""
    sea = SpreadSpectrum(Bretschneider(3.0, 9.0), CosineSquared(), np.deg2rad(300.0))
    omega, nu = 2 * np.pi * FREQUENCY, np.deg2rad(DIRECTION)
    held = dataset_from_spectrum(sea, omega, nu[::-1])
    expected = Bretschneider(3.0, 9.0).density(omega[20]) * 2 / np.pi * np.cos(np.deg2rad(30)) ** 2
    got = held["efth"].sel(dir=330.0, method="nearest")[20]
    assert float(got) == pytest.approx(float(expected) * 2 * np.pi * np.pi / 180, rel=1e-12)
    hs, _, dm = accessor_values(held)
    assert dm == pytest.approx(300.0, abs=1e-9)
    assert hs == pytest.approx(3.0, rel=0.02)  # without what is above 0.32 Hz
    line = dataset_from_spectrum(Bretschneider(3.0, 9.0), omega)
    assert line["efth"].dims == ("freq",)
    assert float(line["efth"][20]) == pytest.approx(
        float(Bretschneider(3.0, 9.0).density(omega[20])) * 2 * np.pi, rel=1e-12
    )
    assert float(line.spec.hs()) == pytest.approx(hs, rel=1e-3)  # cos² on 15° steps


def test_attributes_are_those_of_wavespectra() -> None:
    held = dataset_from_spectrum(spectrum_from_dataset(dataset(ASYMMETRIC)))
    assert held["efth"].attrs["units"] == "m2 s degree-1"
    assert held["freq"].attrs == {"standard_name": "sea_surface_wave_frequency", "units": "Hz"}
    assert held["dir"].attrs == {"standard_name": "sea_surface_wave_from_direction", "units": "degree"}
    line = dataset_from_spectrum(spectrum_from_dataset(dataset(ASYMMETRIC).sum("dir")))
    assert line["efth"].attrs["units"] == "m2 s"
    line["efth"].attrs["units"] = "changed"
    again = dataset_from_spectrum(TableSpectrum(np.array([0.5, 1.0]), np.array([1.0, 2.0])))
    assert again["efth"].attrs["units"] == "m2 s"


TIMES = np.array(["2020-06-08T00:50", "2020-06-08T01:50", "2020-06-08T03:50"], "datetime64[ns]")


def several() -> xr.Dataset:
    """Three times at two sites; at the second time and site the asymmetric sea, else heights from 1 m up."""
    scale = np.arange(1.0, 7.0).reshape(3, 2)[..., None, None]
    density = scale * hump(0.1, 300.0, 1.0)
    density[1, 1] = ASYMMETRIC
    return dataset(density, time=TIMES, site=np.array([7, 9]))


@pytest.mark.parametrize(
    "time", ["2020-06-08 01:50", "2020-06-08T01:50:00", TIMES[1], datetime(2020, 6, 8, 1, 50)]
)
def test_one_of_several_is_chosen(time: object) -> None:
    table = spectrum_from_dataset(several(), time=time, site=9)
    assert isinstance(table, DirectionalTable)
    got = table.density(2 * np.pi * FREQUENCY[8], np.deg2rad(45.0))
    assert got == pytest.approx(ASYMMETRIC[8, 3] * 9.118906527810399, rel=1e-12)


@pytest.mark.parametrize(
    ("choice", "parts"),
    [
        ({}, ("which time", "3, 2020-06-08 00:50 to 2020-06-08 03:50")),
        ({"time": "2020-06-08 01:50"}, ("which site", "2, 7 to 9")),
        ({"time": "2020-06-08 02:50", "site": 9}, ("time is not there", "2020-06-08 02:50", "3, 2020")),
        ({"time": "2020-06-08 01:50", "site": 8}, ("site is not there", "2, 7 to 9")),
        ({"time": "2020-06-08 01:50", "site": "9"}, ("site is not there",)),
        ({"time": "noon", "site": 9}, ("no time in UTC", "noon")),
        ({"time": 3, "site": 9}, ("no time in UTC",)),
        ({"time": "2020-06-08T01:50Z", "site": 9}, ("no time in UTC",)),
        ({"time": datetime(2020, 6, 8, 1, 50, tzinfo=UTC), "site": 9}, ("no time in UTC",)),
    ],
)
def test_open_and_wrong_choices_are_refused(choice: dict[str, object], parts: tuple[str, ...]) -> None:
    with pytest.raises(PanelsimError) as refusal:
        spectrum_from_dataset(several(), **choice)
    for part in parts:
        assert part in str(refusal.value)


def test_choices_that_are_none_are_refused() -> None:
    with pytest.raises(PanelsimError, match="no site to choose from"):
        spectrum_from_dataset(dataset(ASYMMETRIC), site=9)
    twice = dataset(np.stack([ASYMMETRIC, ASYMMETRIC]), time=TIMES[[1, 1]])
    with pytest.raises(PanelsimError, match="there 2 times"):
        spectrum_from_dataset(twice, time=TIMES[1])
    with pytest.raises(PanelsimError, match="more than one spectrum") as refusal:
        spectrum_from_dataset(dataset(np.stack([ASYMMETRIC, ASYMMETRIC]), lat=np.array([60.0, 61.0])))
    assert "isel(lat=0)" in str(refusal.value)
    one = dataset(ASYMMETRIC[None, None], time=TIMES[:1], lat=np.array([60.0]))
    assert isinstance(spectrum_from_dataset(one), DirectionalTable)


def with_units(name: str, units: str, directional: bool = True) -> xr.Dataset:
    held = dataset(ASYMMETRIC) if directional else dataset(ASYMMETRIC).sum("dir")
    held[name].attrs["units"] = units
    return held


@pytest.mark.parametrize(
    ("name", "units"),
    [
        ("efth", "m^{2}.s.degree^{-1}"),
        ("efth", "m2/Hz/deg"),
        ("efth", "m**2 s degree**-1"),
        ("freq", "s-1"),
        ("dir", "Degrees"),
    ],
)
def test_units_in_other_spellings_are_taken(name: str, units: str) -> None:
    assert isinstance(spectrum_from_dataset(with_units(name, units)), DirectionalTable)


@pytest.mark.parametrize(
    "wrong",
    [
        with_units("efth", "m2 s rad-1"),
        with_units("efth", "m2 s"),
        with_units("efth", "m2 s degree-1", directional=False),
        with_units("freq", "rad/s"),
        with_units("dir", "radian"),
    ],
)
def test_other_units_are_refused(wrong: xr.Dataset) -> None:
    with pytest.raises(PanelsimError, match="units") as refusal:
        spectrum_from_dataset(wrong)
    assert any(repr(held.attrs.get("units")) in str(refusal.value) for held in wrong.variables.values())


def changed(place: tuple[int, int], value: float) -> FloatArray:
    density = ASYMMETRIC.copy()
    density[place] = value
    return density


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (xr.Dataset(), "layout"),
        (dataset(ASYMMETRIC)["efth"], "layout"),
        (dataset(ASYMMETRIC).rename(efth="energy"), "layout"),
        (dataset(ASYMMETRIC).rename(freq="frequency"), "layout"),
        (xr.Dataset({"efth": (("freq", "dir"), ASYMMETRIC)}), "values of freq"),
        (dataset(ASYMMETRIC).isel(dir=[3]), "one direction"),
        (dataset(ASYMMETRIC).isel(dir=3), "one direction"),
        (dataset(changed((4, 2), -1e-9)), "0.06 Hz from 30°, and 1 of"),
        (dataset(changed((4, 2), np.nan)), "nan at 0.06 Hz from 30°"),
        (dataset(ASYMMETRIC).sum("dir") - 1.0, "-1 at 0.04 Hz"),
        (dataset(ASYMMETRIC).isel(freq=slice(None, None, -1)), "do not rise"),
        (dataset(ASYMMETRIC).assign_coords(freq=FREQUENCY - 0.04), "do not rise from above 0"),
    ],
)
def test_datasets_that_are_no_spectrum_are_refused(wrong: xr.Dataset, message: str) -> None:
    with pytest.raises(PanelsimError) as refusal:
        spectrum_from_dataset(wrong)
    assert message in str(refusal.value)


def test_grids_that_wavespectra_would_misread_are_refused() -> None:
    sea = SpreadSpectrum(Bretschneider(3.0, 9.0), CosineSquared(), 1.0)
    omega, nu = 2 * np.pi * FREQUENCY, np.deg2rad(DIRECTION)
    refusals = {
        "no frequency of its own": (sea, None, nu),
        "no sea_direction of its own": (sea, omega, None),
        "no directions": (sea.point, omega, nu),
        "not even": (sea, omega, nu[1:]),
        "do not rise": (sea, omega[::-1], nu),
        "list of finite numbers": (sea, "all", nu),
    }
    for message, arguments in refusals.items():
        with pytest.raises(PanelsimError, match=message):
            dataset_from_spectrum(*arguments)
    uneven = DirectionalTable(omega, nu[DIRECTION != 30.0], np.ones((len(omega), len(nu) - 1)))
    with pytest.raises(PanelsimError, match="not even") as refusal:
        dataset_from_spectrum(uneven)
    assert "15° to 30°" in str(refusal.value)


def test_netcdf_files(tmp_path: Path) -> None:
    """Ours, classic NetCDF as older models write it, and wavespectra's own, packed in steps of 1e-5."""
    import wavespectra  # noqa: F401 - for the accessor

    held = several()
    write_whole(tmp_path / "plain.nc", bytes(held.to_netcdf(engine="h5netcdf")))
    held.to_netcdf(tmp_path / "classic.nc", engine="scipy", format="NETCDF3_CLASSIC")
    held.spec.to_netcdf(tmp_path / "packed.nc")
    for name, tolerance in [("plain", 1e-15), ("classic", 1e-15), ("packed", 0.5e-5 * 10)]:
        table = open_spectrum(tmp_path / f"{name}.nc", time="2020-06-08 01:50", site=9)
        assert isinstance(table, DirectionalTable)
        got = table.density(table.frequency[:, None], table.sea_direction)
        np.testing.assert_allclose(got, ASYMMETRIC * 9.118906527810399, atol=tolerance, rtol=1e-12)


def test_files_that_are_no_netcdf_are_refused(tmp_path: Path) -> None:
    whole = bytes(dataset(ASYMMETRIC).to_netcdf(engine="h5netcdf"))
    (tmp_path / "short.nc").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "text.nc").write_text("freq,dir\n")
    for name in ("short.nc", "text.nc", "missing.nc"):
        with pytest.raises(PanelsimError, match="cannot be read") as refusal:
            open_spectrum(tmp_path / name)
        assert name in str(refusal.value) and "backend" not in str(refusal.value)
    with pytest.raises(PanelsimError, match="which time"):
        write_whole(tmp_path / "plain.nc", bytes(several().to_netcdf(engine="h5netcdf")))
        open_spectrum(tmp_path / "plain.nc")
