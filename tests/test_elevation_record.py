"""Elevation records, the waves that give them back, and a sea made of them."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import KNOT, STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.motion.history import History
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.exchange.elevation_record import ElevationRecord, read_elevation_record
from panelsim.seaway.exchange.record_components import record_components
from panelsim.seaway.recorded import RecordedSeaway
from panelsim.seaway.translating import TranslatingSeaway

STEP = 0.5  # s
BAND = {"low_frequency": 0.2, "high_frequency": 2.0}


def elevation_at_origin(waves: WaveComponents, time: FloatArray) -> FloatArray:
    """Σ a cos(−ω t − ε), TM 2003-190 (1) at x = y = 0."""
    angle = -np.outer(time, waves.frequency) - waves.phase
    return np.cos(angle) @ waves.amplitude


def band_limited(count: int, seed: int = 5, first_time: float = 100.0) -> ElevationRecord:
    """A record of waves at multiples of 2π/T between 0.2 and 2 rad/s, with a mean of 0.7 m."""
    rng = np.random.default_rng(seed)
    fundamental = 2 * np.pi / (count * STEP)
    n = np.arange(np.ceil(0.2 / fundamental), 2.0 / fundamental)
    time = STEP * np.arange(count)
    angle = np.outer(time, n * fundamental) + rng.uniform(0, 2 * np.pi, len(n))
    return ElevationRecord(first_time + time, 0.7 + np.cos(angle) @ rng.rayleigh(0.1, len(n)))


@pytest.mark.parametrize("count", [600, 601])
def test_waves_of_the_band_give_the_record_back(count: int) -> None:
    record = band_limited(count)
    waves = record_components(record, wave_heading=1.0, **BAND)
    # Rounding of phases up to 600 rad.
    np.testing.assert_allclose(
        elevation_at_origin(waves, record.time - record.time[0]),
        record.elevation - record.elevation.mean(),
        atol=1e-10,
    )
    assert waves.variance == pytest.approx(record.variance, rel=1e-12)
    np.testing.assert_array_equal(waves.wave_heading, 1.0)
    assert record.length == pytest.approx(count * STEP, rel=1e-12)


@pytest.mark.parametrize("count", [64, 65])
def test_the_whole_band_gives_noise_back(count: int) -> None:
    """With the Nyquist wave of an even count at half of 2/N; twice as high it fails, and left out too."""
    rng = np.random.default_rng(2)
    record = ElevationRecord(STEP * np.arange(count), rng.normal(size=count))
    waves = record_components(record, wave_heading=0.0, low_frequency=0.0, high_frequency=np.pi / STEP)
    assert waves.count == count // 2
    unbounded = record_components(record, wave_heading=0.0, low_frequency=0.0, high_frequency=np.inf)
    np.testing.assert_array_equal(unbounded.amplitude, waves.amplitude)
    given_back = elevation_at_origin(waves, record.time)
    np.testing.assert_allclose(given_back, record.elevation - record.elevation.mean(), atol=1e-12)


def test_a_known_wave_comes_back_with_its_phase() -> None:
    """0.8 cos(ω t + 0.3): amplitude 0.8 m, crest 0.3 rad ahead of the origin, ε = +0.3."""
    time = STEP * np.arange(400)
    omega = 2 * np.pi * 20 / 200.0
    record = ElevationRecord(time, 0.8 * np.cos(omega * time + 0.3))
    waves = record_components(record, wave_heading=0.0, low_frequency=0.6, high_frequency=0.65)
    assert waves.count == 1
    assert waves.amplitude[0] == pytest.approx(0.8, rel=1e-12)
    assert waves.frequency[0] == pytest.approx(omega, rel=1e-12)
    assert waves.phase[0] == pytest.approx(0.3, abs=1e-12)


@settings(deadline=None, max_examples=20)
@given(n=st.integers(1, 15), edge=st.sampled_from(["low", "high"]))
def test_a_wave_at_an_end_of_the_band_belongs_to_it(n: int, edge: str) -> None:
    record = ElevationRecord(0.1 * np.arange(32), np.random.default_rng(n).normal(size=32))
    omega = 2 * np.pi * n / 3.2
    low, high = (omega, omega + 0.1) if edge == "low" else (omega - 0.1, omega)
    waves = record_components(record, wave_heading=0.0, low_frequency=low, high_frequency=high)
    np.testing.assert_allclose(waves.frequency, omega, rtol=1e-12)


@pytest.mark.parametrize("taper", [0.1, 1.0])
def test_taper_keeps_the_variance_and_fades_the_ends(taper: float) -> None:
    record = band_limited(600)
    waves = record_components(
        record, wave_heading=0.0, low_frequency=0.0, high_frequency=np.pi / STEP, taper=taper
    )
    time = STEP * np.arange(600)
    got = elevation_at_origin(waves, time)
    # The Nyquist wave, with next to nothing of these waves, counts half.
    assert waves.variance == pytest.approx(record.variance, rel=1e-6)
    # At the ends the window is 0, so that the record goes on without a jump: what is left is the mean of
    # the faded waves, which is taken off once more.
    assert got[0] == pytest.approx(got[-1], abs=1e-12)
    assert abs(got[0]) < 0.02 * np.sqrt(record.variance)
    # In the middle it is the record itself, all raised alike: by 1/√(1 − 5/8 taper) on the average.
    middle = slice(280, 320) if taper < 1 else slice(299, 301)
    raised = np.polyfit(record.elevation[middle] - record.elevation.mean(), got[middle], 1)[0]
    assert raised == pytest.approx(1 / np.sqrt(1 - 5 / 8 * taper), rel=0.1)  # one record's own chance


def test_record_downstream_lags_by_its_own_wavenumbers() -> None:
    """The sea at x downstream is the record with each wave turned by −k x, k = ω²/g.

    With Richer's (19) as printed, cos(k x + ω t + Φ), the waves would be those of x upstream.
    """
    record = band_limited(600)
    time = STEP * np.arange(600)
    downstream = 170.0
    omega = 2 * np.pi * np.fft.rfftfreq(600, STEP)
    turned = np.fft.rfft(record.elevation - record.elevation.mean()) * np.exp(
        -1j * omega**2 / STANDARD_GRAVITY * downstream
    )
    expected = np.fft.irfft(turned, 600)
    for heading, (x, y) in [
        (0.0, (1, 0)),
        (np.pi, (-1, 0)),
        (np.pi / 2, (0, -1)),
        (-0.3, (np.cos(0.3), np.sin(0.3))),
    ]:
        sea = RecordedSeaway(record, heading, **BAND).in_translating_axes(0.0)
        got = sea.elevation(downstream * x, downstream * y, time)
        np.testing.assert_allclose(got, expected, atol=1e-10)  # rounding of 600 rad
    upstream = RecordedSeaway(record, 0.0, **BAND).in_translating_axes(0.0).elevation(-downstream, 0.0, time)
    assert np.abs(upstream - expected).max() > 0.5  # the seas differ by more than their rounding


def test_a_wave_group_arrives_downstream_with_the_group_velocity() -> None:
    """A narrow group of 0.8 rad/s goes at g/2ω = 6.13 m/s, half as fast as its crests."""
    time = STEP * np.arange(1200)
    envelope = np.exp(-0.5 * ((time - 200.0) / 25.0) ** 2)
    sea = RecordedSeaway(ElevationRecord(time, envelope * np.cos(0.8 * time)), 0.0, 0.5, 1.1)
    there = sea.in_translating_axes(0.0).elevation(600.0, 0.0, time)
    centre = np.sum(time * there**2) / np.sum(there**2)
    assert centre - 200.0 == pytest.approx(600.0 / (STANDARD_GRAVITY / 1.6), rel=0.01)  # dispersion


def test_recorded_seaway_is_the_record_where_the_ship_starts() -> None:
    record = band_limited(600)
    sea = RecordedSeaway(record, np.deg2rad(150), **BAND, ship_heading=0.4)
    assert sea.kind == "record" and sea.ship_heading == 0.4
    assert sea.length == pytest.approx(300.0, rel=1e-12)
    assert sea.record_share == pytest.approx(1.0, rel=1e-12)
    speed = 20 * KNOT
    time = record.time - record.time[0]
    # The origin of the fixed axes, seen from a ship that has moved on; once more after the record's length.
    view = sea.in_translating_axes(speed)
    for again in (0.0, sea.length):
        got = view.elevation(-speed * (time + again), 0.0, time + again)
        np.testing.assert_allclose(got, record.elevation - record.elevation.mean(), atol=1e-9)
    assert isinstance(view, TranslatingSeaway)


def test_a_ship_runs_in_a_recorded_sea(run_halifax: Callable[..., History]) -> None:
    """The elevation that its history holds at zero speed is the record, at the record's own times."""
    record = band_limited(300)
    sea = RecordedSeaway(record, np.deg2rad(150), **BAND)
    run = run_halifax(sea, duration=5.0, time_step=0.25)
    time = run.dataset["time"].values
    samples = np.isclose(np.remainder(time, STEP), 0.0)
    np.testing.assert_allclose(
        run.dataset["wave_elevation"].values[samples],
        (record.elevation - record.elevation.mean())[np.rint(time[samples] / STEP).astype(int)],
        atol=1e-9,  # rounding of the kernel's phases
    )
    assert run.dataset["displacement"].values[-1, 2] != 0.0
    assert samples.sum() == 11


def test_share_of_the_variance_in_the_band() -> None:
    """Waves of 0.3 m inside and 0.4 m outside: 9/25 of the variance."""
    time = STEP * np.arange(800)
    omega = 2 * np.pi / 400.0
    record = ElevationRecord(time, 0.3 * np.cos(50 * omega * time) + 0.4 * np.sin(150 * omega * time))
    sea = RecordedSeaway(record, 0.0, 0.5, 1.0, minimum_energy=0.3)
    assert sea.record_share == pytest.approx(9 / 25, rel=1e-12)
    with pytest.raises(PanelsimError, match="rad/s, 2π times Hz") as refusal:
        RecordedSeaway(record, 0.0, 0.5, 1.0)
    assert "36.0 %" in str(refusal.value)


def test_a_record_in_centimetres_is_no_sea() -> None:
    """0.3 m at 0.8 rad/s are 30 "m" then: a steepness of 1.2."""
    time = STEP * np.arange(800)
    wave = ElevationRecord(time, 30.0 * np.cos(2 * np.pi / 400.0 * 50 * time))
    with pytest.raises(PanelsimError, match="steeper") as refusal:
        RecordedSeaway(wave, 0.0, 0.5, 1.0)
    assert "metres" in str(refusal.value)
    with pytest.raises(PanelsimError, match="another kind"):
        RecordedSeaway("buoy.csv", 0.0, 0.5, 1.0)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("band", "allowed"),
    [
        ((0.2, 6.4), "6.28319 rad/s"),  # Nyquist π/0.5 s
        ((2.0, 0.2), "6.28319"),
        ((-0.1, 2.0), "0 or more"),
        ((0.2, np.nan), "0 or more"),
        (("0.2", 2.0), "0 or more"),
        ((0.51, 0.515), "0.02094 rad/s"),  # 2π/300 s
    ],
)
def test_bands_that_the_record_does_not_show_are_refused(band: tuple[float, float], allowed: str) -> None:
    with pytest.raises(PanelsimError, match="band") as refusal:
        RecordedSeaway(band_limited(600), 0.0, *band)
    assert allowed in str(refusal.value)


@pytest.mark.parametrize("taper", [-0.1, 1.5, np.nan, "some", True])
def test_tapers_that_are_no_share_are_refused(taper: float) -> None:
    with pytest.raises(PanelsimError, match="taper"):
        RecordedSeaway(band_limited(600), 0.0, **BAND, taper=taper)


def test_other_refusals() -> None:
    record = band_limited(600)
    with pytest.raises(PanelsimError, match="radians"):
        RecordedSeaway(record, 150.0, **BAND)
    with pytest.raises(PanelsimError, match="radians"):
        RecordedSeaway(record, 0.0, **BAND, ship_heading=45.0)
    with pytest.raises(PanelsimError, match="no waves"):
        RecordedSeaway(ElevationRecord(record.time, np.full(600, 0.1)), 0.0, **BAND)


def changed(values: FloatArray, place: int, value: float) -> FloatArray:
    values = values.copy()
    values[place] = value
    return values


TIMES = 0.5 * np.arange(64)
WAVES = np.sin(TIMES)


@pytest.mark.parametrize(
    ("time", "elevation", "message"),
    [
        (TIMES[:31], WAVES[:31], "too short"),
        ([], [], "too short"),
        (TIMES, WAVES[:60], "one length"),
        (TIMES.reshape(8, 8), WAVES.reshape(8, 8), "one length"),
        (TIMES, ["calm"] * 64, "no list of numbers"),
        (changed(TIMES, 9, np.nan), WAVES, "time is missing in sample 10"),
        (TIMES, changed(WAVES, 9, np.inf), "elevation is missing in sample 10"),
        (np.delete(TIMES, 10), WAVES[1:], "not even at sample 11"),
        (changed(TIMES, 10, TIMES[9]), WAVES, "not even at sample 11"),
        (changed(TIMES, 10, TIMES[10] + 0.02), WAVES, "not even at sample 11"),
        (-TIMES, WAVES, "not even at sample 2"),
        (np.zeros(64), WAVES, "not even at sample 2"),
        # Every step within the tolerance of its neighbours, but not the whole.
        (TIMES + 0.004 * np.arange(64) * (np.arange(64) > 32), WAVES, "not even"),
    ],
)
def test_records_that_are_none_are_refused(time: FloatArray, elevation: FloatArray, message: str) -> None:
    with pytest.raises(PanelsimError, match=message):
        ElevationRecord(time, elevation)


def test_a_drifting_clock_is_refused() -> None:
    """Steps of 0.5 s that grow to 0.508 s are each within 2 %, but end half a step off."""
    time = np.concatenate([[0.0], np.cumsum(np.linspace(0.5, 0.508, 600))])
    with pytest.raises(PanelsimError, match="not even at sample"):
        ElevationRecord(time, np.sin(time))


def test_times_printed_with_two_decimals_are_even() -> None:
    """1.28 samples a second, steps of 0.78 and 0.79 s."""
    time = np.arange(500) / 1.28
    record = ElevationRecord(np.round(time, 2), np.sin(time))
    assert record.step == pytest.approx(1 / 1.28, rel=1e-4)
    assert record.nyquist_frequency == pytest.approx(np.pi * 1.28, rel=1e-4)


def test_record_arrays_are_frozen() -> None:
    given_time = TIMES.copy()
    record = ElevationRecord(given_time, WAVES)
    given_time[0] = 9.0
    assert record.time[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        record.elevation[0] = 1.0


def write(path: Path, lines: list[str], end: str = "\n") -> Path:
    path.write_text("\n".join(lines) + end)
    return path


ROWS = [f"{t!r},{z!r}" for t, z in zip(TIMES.tolist(), WAVES.tolist(), strict=True)]


def test_files_are_read(tmp_path: Path) -> None:
    plain = read_elevation_record(write(tmp_path / "plain.csv", ["time_s,elevation_m", *ROWS, ""]))
    np.testing.assert_array_equal(plain.time, TIMES)
    np.testing.assert_array_equal(plain.elevation, WAVES)
    named = write(
        tmp_path / "named.csv", ["probe, t ,note", *(f"{z},{t},ok" for t, z in (r.split(",") for r in ROWS))]
    )
    same = read_elevation_record(named, time_column="t", elevation_column="probe")
    np.testing.assert_array_equal(same.time, TIMES)
    np.testing.assert_array_equal(same.elevation, WAVES)


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["time_s,elevation_m", *ROWS[:20], "10.0", *ROWS[21:]], "line 22"),
        (["time_s,elevation_m", *ROWS[:20], "10.0,", *ROWS[21:]], "line 22"),
        (["time_s,elevation_m", *ROWS[:20], "10.0,calm", *ROWS[21:]], "line 22"),
        (["time_s,elevation_m", *ROWS[:20], "10.0,nan", *ROWS[21:]], "line 22"),
        (["time_s,elevation_m", *ROWS[:20], *ROWS[21:]], "not even at line 22"),
        (["time_s,elevation_m", *ROWS[:5], "", *ROWS[5:20], *ROWS[21:]], "not even at line 23"),
        (["time,elevation", *ROWS], "'time_s'"),
        (["time_s,elevation_ft", *ROWS], "'elevation_m'"),
        (["time_s,elevation_m,elevation_m", *ROWS], "'elevation_m'"),
        (ROWS, "'time_s'"),
        (["time_s,elevation_m"], "too short"),
    ],
)
def test_files_that_are_wrong_are_refused_with_the_line(
    tmp_path: Path, lines: list[str], message: str
) -> None:
    with pytest.raises(PanelsimError, match=message):
        read_elevation_record(write(tmp_path / "record.csv", lines))


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(PanelsimError, match="cannot be read"):
        read_elevation_record(tmp_path / "nothing.csv")
    binary = tmp_path / "binary.csv"
    binary.write_bytes(b"\xff\xfe\x00\x80" * 20)
    with pytest.raises(PanelsimError, match="cannot be read"):
        read_elevation_record(binary)
    (tmp_path / "empty.csv").touch()
    with pytest.raises(PanelsimError, match="'time_s'"):
        read_elevation_record(tmp_path / "empty.csv")
    cut = write(tmp_path / "cut.csv", ["time_s,elevation_m", *ROWS[:40], "20.0,0.9"], end="")
    with pytest.raises(PanelsimError, match="middle of line 42"):
        read_elevation_record(cut)
