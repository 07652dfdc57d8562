"""How the recording of studies opens: lines over the levels; tables and motions in the next tabs."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.results.rms_study import RmsStudy
from panelsim.results.statistics import display_unit
from panelsim.view.study_histories import SIGNALS
from panelsim.view.study_lines import Lines, lines_of

if TYPE_CHECKING:
    import rerun.blueprint as rrb

TAB_NAMES = {"difference": "differences", "rms": "RMS"}
# Fewer per cent than this are not worth a finer axis.
LEAST_PER_CENT = 0.1
# RMS that differ by less than this share of the largest are drawn from zero.
LEAST_SPREAD = 0.2


def study_blueprint(studies: Sequence[RmsStudy], window: tuple[float, float] | None) -> "rrb.Blueprint":
    """The layout; `window` [s] is what is seen of the motions, None where there are none."""
    import rerun.blueprint as rrb

    tabs = [_study_tab(study, number) for number, study in enumerate(studies, 1)]
    tables = rrb.Vertical(
        rrb.TextDocumentView(origin="/tables/differences", name="differences from the reference"),
        rrb.TextDocumentView(origin="/tables/rms", name="RMS"),
        name="Tables",
    )
    motions = [] if window is None else [_motions_tab(window)]
    side = rrb.Vertical(
        rrb.TextDocumentView(origin="/levels", name="levels"),
        rrb.TextDocumentView(origin="/about", name="about this study"),
        row_shares=[2, 3],
    )
    return rrb.Blueprint(
        rrb.Horizontal(rrb.Tabs(*tabs, tables, *motions, active_tab=0), side, column_shares=[3, 1]),
        rrb.TimePanel(state="collapsed", timeline="level", play_state="paused"),
        rrb.SelectionPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )


def _study_tab(study: RmsStudy, number: int) -> "rrb.Tabs":
    """Tabs of one study: differences and RMS for each heading."""
    import rerun.blueprint as rrb

    plots: dict[str, list[Lines]] = {}
    for lines in lines_of(study, number):
        plots.setdefault(f"{TAB_NAMES[lines.quantity]} at {lines.wave_heading_deg:g}°", []).append(lines)
    pages = [rrb.Grid(*map(_lines_view, page), grid_columns=3, name=name) for name, page in plots.items()]
    return rrb.Tabs(*pages, active_tab=0, name=study.title)


def _lines_view(lines: Lines) -> "rrb.TimeSeriesView":
    """A plot with room for the legend behind the last level.

    The automatic axis of a sequence is centred on its first point.
    """
    import rerun.blueprint as rrb

    ends = (rrb.TimeRangeBoundary.absolute(seq=end) for end in (0, len(lines.values) + 1))
    limits = _limits(lines)
    return rrb.TimeSeriesView(
        name=lines.name,
        origin=f"/{lines.entity}",
        axis_x=rrb.TimeAxis(view_range=rrb.TimeRange(*ends)),
        axis_y=None if limits is None else rrb.ScalarAxis(range=limits),
        plot_legend="RightTop",
    )


def _limits(lines: Lines) -> tuple[float, float] | None:
    """Ends of the upright axis where the automatic ones would blow nothing up; None where they are good.

    Each property of a view takes some 2 kB of the file, more than the lines themselves.
    """
    values: FloatArray = lines.values[np.isfinite(lines.values)]
    if lines.quantity == "difference":
        return None if np.ptp([0.0, *values]) >= LEAST_PER_CENT else (-LEAST_PER_CENT, LEAST_PER_CENT)
    largest = values.max(initial=0.0)
    if largest > 0.0 and np.ptp(values) >= LEAST_SPREAD * largest:
        return None
    return 0.0, 1.1 * float(largest) or 1.0


def _motions_tab(window: tuple[float, float]) -> "rrb.Vertical":
    import rerun.blueprint as rrb

    ends = (rrb.TimeRangeBoundary.absolute(seconds=end) for end in window)
    axis = rrb.TimeAxis(view_range=rrb.TimeRange(*ends))
    plots = [
        rrb.TimeSeriesView(
            name=f"{signal.replace('_', ' ')} [{display_unit(signal)[0]}]",
            origin=f"/histories/{signal}",
            axis_x=axis,
            plot_legend=rrb.PlotLegend("LeftTop", visible=signal == SIGNALS[0]),
        )
        for signal in SIGNALS
    ]
    return rrb.Vertical(
        rrb.TextDocumentView(origin="/how_to_see_motions", name="time histories"),
        rrb.Grid(*plots, grid_columns=2),
        row_shares=[1, 9],
        name="Time histories",
    )
