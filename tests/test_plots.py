"""The figures show the history's numbers in the units that they name."""

from collections.abc import Callable
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from matplotlib.figure import Figure

from panelsim.motion.history import History
from panelsim.seaway.components import NO_WAVES
from panelsim.view.frames import liveliest_window
from panelsim.view.plots import plot_loads, plot_motions, plot_spectra

MakeHistory = Callable[..., History]
PLOTS = (plot_motions, plot_spectra, plot_loads)


@pytest.mark.parametrize("plot", PLOTS)
def test_a_figure_is_a_picture_and_the_same_one_again(
    plot: Callable[[History, Path], Path], make_history: MakeHistory, tmp_path: Path
) -> None:
    first, second = (plot(make_history(), tmp_path / name) for name in ("a.png", "b.png"))
    assert first.read_bytes() == second.read_bytes()
    pixels = matplotlib.image.imread(first)
    assert pixels.shape[1] >= 1200
    # a page of lines on white: neither blank nor covered
    assert 0.005 < np.mean(pixels[..., :3].min(axis=-1) < 0.8) < 0.5
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.png", "b.png"]


@pytest.mark.parametrize("plot", PLOTS)
@pytest.mark.parametrize("duration", [0.0, 1.0, 13.0])
def test_short_and_calm_runs_are_drawn_too(
    plot: Callable[[History, Path], Path], duration: float, make_history: MakeHistory, tmp_path: Path
) -> None:
    plot(make_history(duration=duration, components=NO_WAVES, ramp=0.0), tmp_path / "short.png")
    plot(make_history(duration=duration), tmp_path / "within_the_ramp.png")


def test_motions_are_drawn_in_degrees_over_the_whole_run_and_closely(
    make_history: MakeHistory, tmp_path: Path, drawn: list[Figure]
) -> None:
    history = make_history(duration=400.0)
    displacement = history.displacement.copy()
    summit = 1200  # t = 300 s
    displacement[summit, 4] = -0.5
    history = make_history(duration=400.0, displacement=displacement)
    plot_motions(history, tmp_path / "motions.png")
    axes = np.reshape(drawn[0].axes, (7, 2))
    labels = [axis.get_ylabel() for axis in axes[:, 0]]
    assert labels == [
        *("wave elevation [m]", "surge [m]", "sway [m]", "heave [m]"),
        *("roll [deg]", "pitch [deg]", "yaw [deg]"),
    ]
    np.testing.assert_allclose(axes[4, 0].lines[0].get_ydata(), np.rad2deg(history.displacement[:, 3]))
    low, high = axes[0, 1].get_xlim()
    assert (low, high) == liveliest_window(history, 120.0) == (240.0, 360.0)


def test_a_spectrum_peaks_at_the_period_of_the_motion_and_holds_its_variance(
    make_history: MakeHistory, tmp_path: Path, drawn: list[Figure]
) -> None:
    plot_spectra(make_history(duration=812.0), tmp_path / "spectra.png")
    heave = next(axis for axis in drawn[0].axes if axis.get_title() == "heave")
    assert heave.get_ylabel() == "[m² s/rad]"
    frequency, density = heave.lines[0].get_data()
    spacing = frequency[1]
    assert frequency[np.argmax(density)] == pytest.approx(2 * np.pi / 8.0, abs=spacing)
    # a sinusoid of 1.2 m; the window's leakage and the trend removal cost well under 2 %
    assert np.sum(density) * spacing == pytest.approx(0.5 * 1.2**2, rel=0.02)


def test_load_bars_are_the_rms_in_meganewtons(
    make_history: MakeHistory, tmp_path: Path, drawn: list[Figure]
) -> None:
    history = make_history()
    plot_loads(history, tmp_path / "loads.png")
    pitch = next(axis for axis in drawn[0].axes if axis.get_title() == "pitch")
    assert pitch.get_xlabel() == "RMS about the mean [MN m]"
    weight, wetted = (bar.get_width() for bar in pitch.patches)
    after_ramp = history.time >= 12.0
    assert weight == 0.0
    assert wetted == pytest.approx(1e-6 * history.loads["wetted_surface"][after_ramp, 4].std(), rel=1e-12)
