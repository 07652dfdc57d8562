"""How the recording of several runs opens: ships and statistics to the left, curves to the right."""

from typing import TYPE_CHECKING

import numpy as np

from panelsim.results.statistics import display_unit
from panelsim.view.blueprint import FILM_TIMELINE, scrolling_curves, sea_view
from panelsim.view.study_histories import SIGNALS

if TYPE_CHECKING:
    import rerun.blueprint as rrb

# Where the camera stands, in widths of all seas together: ahead of the ships and above them.
CAMERA = (0.7, 0.0, 0.3)


def compared_blueprint(*, width: float | None, differences: bool) -> "rrb.Blueprint":
    """The layout; `width` [m] from end to end of the seas, None where no ships are drawn.

    The viewer opens playing the film over and over.
    """
    import rerun.blueprint as rrb

    texts = rrb.Tabs(
        rrb.TextDocumentView(origin="/statistics", name="statistics"),
        rrb.TextDocumentView(origin="/about", name="about these runs"),
    )
    picture: rrb.Container = texts
    if width is not None:
        ships = sea_view("ships at sea", width * np.array(CAMERA), np.zeros(3))
        picture = rrb.Vertical(ships, texts, row_shares=[3, 2])
    pages = [_curves("Motions", "motions")]
    if differences:
        pages.append(_curves("Differences from the first run", "differences"))
    return rrb.Blueprint(
        rrb.Horizontal(picture, rrb.Tabs(*pages, active_tab=0), column_shares=[1, 1]),
        rrb.TimePanel(state="collapsed", timeline=FILM_TIMELINE, play_state="playing", loop_mode="all"),
        rrb.SelectionPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )


def _curves(name: str, origin: str) -> "rrb.Grid":
    import rerun.blueprint as rrb

    views = [
        scrolling_curves(f"{signal.replace('_', ' ')} [{display_unit(signal)[0]}]", f"/{origin}/{signal}")
        for signal in SIGNALS
    ]
    return rrb.Grid(*views, grid_columns=2, name=name)
