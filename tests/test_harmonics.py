"""Harmonics of signals that are known, in windows of whole periods."""

import numpy as np
import pytest

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.results.harmonics import harmonics

OMEGA = 0.83
TIME = 0.2 * np.arange(1501)


def _signal(time: FloatArray) -> FloatArray:
    """Mean 0.3, harmonics 2 with a lead of 0.4, 0.5 with a lag of 1.1, and 0.1; beside it a cosine."""
    theta = OMEGA * time
    first = 0.3 + 2.0 * np.cos(theta + 0.4) + 0.5 * np.cos(2 * theta - 1.1) + 0.1 * np.sin(3 * theta)
    return np.column_stack([first, -np.cos(theta)])


def test_known_harmonics_come_back() -> None:
    found = harmonics(TIME, _signal(TIME), OMEGA, after=50.0)
    # The model holds the signal: rounding only.
    assert found.mean == pytest.approx([0.3, 0.0], abs=1e-12)
    assert found.amplitude == pytest.approx(np.array([[2.0, 1.0], [0.5, 0.0], [0.1, 0.0]]), abs=1e-12)
    assert found.phase[:, 0] == pytest.approx([0.4, -1.1, -np.pi / 2], abs=1e-11)
    assert abs(found.phase[0, 1]) == pytest.approx(np.pi)
    assert found.change == pytest.approx(0.0, abs=1e-12)
    assert found.rest == pytest.approx(0.0, abs=1e-12)


def test_an_overtaken_wave_is_the_same_motion() -> None:
    """Time runs on whatever the sign of the encounter frequency."""
    one, other = (harmonics(TIME, _signal(TIME), omega, after=50.0) for omega in (OMEGA, -OMEGA))
    assert other.complex_amplitude == pytest.approx(one.complex_amplitude)
    assert other.frequency == OMEGA


def test_a_transient_is_told() -> None:
    """A decaying mean 3 exp(-t/100): the windows, of 18 periods each, differ by what it loses."""
    transient = 3.0 * np.exp(-TIME / 100.0)
    found = harmonics(TIME, _signal(TIME) + transient[:, None], OMEGA, after=20.0)
    window = 18 * 2 * np.pi / OMEGA
    end = TIME[-1]
    mean = [
        300.0 / window * (np.exp(-(end - (i + 1) * window) / 100) - np.exp(-(end - i * window) / 100))
        for i in (0, 1)
    ]
    # The first harmonics see a little of the slope of the mean.
    assert found.change == pytest.approx(mean[1] - mean[0], rel=0.02)
    # The result is that of the last window.
    assert found.mean == pytest.approx(np.array([0.3, 0.0]) + mean[0], abs=0.02 * mean[0])
    assert found.unsettled == pytest.approx(found.change / found.amplitude[0])
    quiet = harmonics(TIME, _signal(TIME) + 1e-6 * transient[:, None], OMEGA, after=20.0)
    assert quiet.unsettled.max() < 1e-5


def test_what_is_no_harmonic_is_left_over() -> None:
    """A subharmonic of half the frequency with amplitude 0.2: RMS 0.2/√2 over an even number of periods."""
    found = harmonics(TIME, _signal(TIME) + 0.2 * np.cos(0.5 * OMEGA * TIME[:, None]), OMEGA, after=20.0)
    # Whole periods of both: the windows have 18 of the wave; samples do not end there exactly.
    assert found.rest == pytest.approx(0.2 / np.sqrt(2), rel=0.01)
    assert found.amplitude[0] == pytest.approx([2.0, 1.0], abs=0.01)


def test_the_record_before_after_does_not_matter() -> None:
    signals = _signal(TIME)
    signals[TIME < 50.0] = np.nan
    assert harmonics(TIME, signals, OMEGA, after=50.0).amplitude[0] == pytest.approx([2.0, 1.0])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"after": 290.0}, "too short"),
        ({"after": 50.0, "count": 15}, "too far apart"),
        ({"after": 0.0}, "not finite"),
    ],
)
def test_records_without_harmonics_are_refused(given: dict[str, float], message: str) -> None:
    signals = _signal(TIME)
    signals[100:120] = np.nan
    with pytest.raises(PanelsimError, match=message):
        harmonics(TIME, signals, OMEGA, **given)
