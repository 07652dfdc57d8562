"""How far a ship drifts, and the mean force behind it over wave height."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from panelsim.conventions import FloatArray
from panelsim.view.plots import COLORS, INK, plain, save


def drift_picture(
    path: Path,
    tracks: Mapping[str, Sequence[tuple[FloatArray, FloatArray]]],
    force: Mapping[float, FloatArray],
) -> Path:
    """Draw distances of tracks, time (T,) [s] and place (T, 2) [m], and forces (2,) [N] by height [m].

    Tracks of one name, of several seeds, are drawn alike.
    """
    figure = Figure(figsize=(11, 4.5), layout="constrained")
    far, forces = figure.subplots(1, 2)
    plain(far)
    for i, (label, of_seeds) in enumerate(tracks.items()):
        color, dashes = COLORS[(0, 4)[i // 2 % 2]], ("-", "--")[i % 2]
        for number, (time, place) in enumerate(of_seeds):
            named = label if number == 0 else None
            distance = np.linalg.norm(place, axis=1)
            far.plot(time, distance, label=named, color=color, linestyle=dashes, linewidth=1.2)
    far.set(xlabel="time [s]", ylabel="distance [m]", title="without springs")
    far.set_ylim(bottom=0.0)
    far.legend(fontsize=9, frameon=False)
    plain(forces)
    heights = np.array(sorted(force))
    values = 1e-3 * np.abs([force[height] for height in heights])
    for mode, name in enumerate(("surge", "sway")):
        forces.loglog(heights, values[:, mode], "o-", color=COLORS[1 + 3 * mode], label=name)
    second = values.max(axis=1)[0] * (heights / heights[0]) ** 2
    forces.loglog(heights, second, color=INK, linestyle=":", label="second power")
    forces.set(xlabel="significant wave height [m]", ylabel="mean force [kN]", title="with springs")
    forces.set_xticks(heights, [f"{height:g}" for height in heights])
    forces.set_xticks([], minor=True)
    forces.legend(fontsize=9, frameon=False)
    return save(figure, path)
