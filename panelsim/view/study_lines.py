"""The lines of a study over its levels: RMS of every motion and its difference from the reference."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import colormaps

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.results.rms_study import RmsStudy, StudySea
from panelsim.results.statistics import display_unit
from panelsim.view.surfaces import ColorArray

if TYPE_CHECKING:
    import rerun as rr

QUANTITIES = ("difference", "rms")
# The ends of the colour map are left out: too dark on a dark background, too pale on a light one.
DARKEST, PALEST = 0.2, 0.95


@dataclass(frozen=True)
class Lines:
    """One plot: `values` (L, S) of one quantity and motion, a line for each sea from one heading.

    `name` has the unit; `labels` and `colors` (S,) are those of the lines.
    """

    entity: str
    name: str
    quantity: str
    wave_heading_deg: float
    values: FloatArray
    labels: tuple[str, ...]
    colors: ColorArray

    def send(self, stream: "rr.RecordingStream") -> None:
        """Send the lines on the timeline `level`, which counts from 1; a run that failed leaves a gap."""
        import rerun as rr

        stream.log(
            self.entity,
            rr.SeriesLines(names=self.labels, colors=self.colors, widths=2.0),
            rr.SeriesPoints(names=self.labels, colors=self.colors, marker_sizes=4.0),
            static=True,
        )
        levels = rr.TimeColumn("level", sequence=np.arange(1, len(self.values) + 1))
        columns = rr.Scalars.columns(scalars=self.values.ravel())
        stream.send_columns(self.entity, [levels], columns.partition([len(self.labels)] * len(self.values)))


def lines_of(study: RmsStudy, number: int) -> Iterator[Lines]:
    """All plots of a study, heading by heading; `number` tells its entities from those of other studies.

    Differences in per cent, without the motions that are minor in the sea of the line.
    """
    units = np.array([display_unit(name)[1] for name in DOF_NAMES])
    amounts = {"difference": 100.0 * study.difference, "rms": units * study.pooled}
    for heading in dict.fromkeys(sea.wave_heading_deg for sea in study.seas):
        chosen = [i for i, sea in enumerate(study.seas) if sea.wave_heading_deg == heading]
        labels = _labels([study.seas[i] for i in chosen])
        for quantity in QUANTITIES:
            for dof, motion in enumerate(DOF_NAMES):
                yield Lines(
                    entity=f"study_{number}/{quantity}/{heading:g}_deg/{motion}",
                    name=_name(quantity, motion, study.why_no_difference(chosen, dof)),
                    quantity=quantity,
                    wave_heading_deg=heading,
                    values=amounts[quantity][:, chosen, dof],
                    labels=labels,
                    colors=_colors(len(chosen)),
                )


def _name(quantity: str, motion: str, why_empty: str) -> str:
    if quantity == "rms":
        return f"{motion}, RMS [{display_unit(motion)[0]}]"
    return f"{motion}, difference [%]" + (f": {why_empty}" if why_empty else "")


def _labels(seas: list[StudySea]) -> tuple[str, ...]:
    """The heights of the seas, where these tell them apart; their whole labels otherwise."""
    heights = [sea.significant_wave_height for sea in seas]
    if None in heights or len(set(heights)) < len(heights):
        return tuple(sea.label for sea in seas)
    return tuple(f"H_s {height:g} m" for height in heights)


def _colors(count: int) -> ColorArray:
    """From dark to pale in the order of the seas."""
    shades = (255.0 * colormaps["plasma"](np.linspace(DARKEST, PALEST, count + 2)[1:-1])).astype(np.uint32)
    return np.asarray(shades @ np.array([1 << 24, 1 << 16, 1 << 8, 1], dtype=np.uint32))
