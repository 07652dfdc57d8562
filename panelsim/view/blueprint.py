"""How a recording opens in the viewer: the ship at sea to the left, curves and tables to the right."""

from typing import TYPE_CHECKING

import numpy as np

from panelsim.conventions import DOF_NAMES, FloatArray

if TYPE_CHECKING:
    import rerun.blueprint as rrb

# Of the filmed moments alone, for a blueprint cannot set the cursor of the timeline of the whole run.
FILM_TIMELINE = "film"
# The curves scroll past the cursor, this many seconds of them.
SECONDS_BEFORE, SECONDS_AFTER = 60.0, 15.0
# Where the camera stands, in ship lengths from the ship: off the port bow, low, so that the waves stand up.
CAMERA = (0.56, 0.72, 0.28)


def ship_blueprint(*, length: float, look_at: FloatArray) -> "rrb.Blueprint":
    """The layout for a ship of this length [m], the camera turned to `look_at` (3,) [m].

    The viewer opens playing the film over and over.
    """
    import rerun.blueprint as rrb

    side = rrb.Vertical(
        scrolling_curves("waves and heave", "/", ["/waves/**", "/motions/linear/heave"]),
        scrolling_curves("surge and sway", "/", ["/motions/linear/surge", "/motions/linear/sway"]),
        scrolling_curves("roll, pitch and yaw", "/motions/angular"),
        rrb.Tabs(
            *(scrolling_curves(f"loads: {name}", f"/loads/{name}") for name in DOF_NAMES),
            active_tab="loads: heave",
            name="loads",
        ),
    )
    picture = rrb.Vertical(
        sea_view("ship at sea", look_at + length * np.array(CAMERA), look_at),
        rrb.Horizontal(
            rrb.TextDocumentView(origin="/statistics", name="statistics"),
            rrb.TextDocumentView(origin="/about", name="about this run"),
            column_shares=[3, 2],
        ),
        row_shares=[5, 3],
    )
    return rrb.Blueprint(
        rrb.Horizontal(picture, side, column_shares=[3, 2]),
        rrb.TimePanel(
            state="collapsed",
            timeline=FILM_TIMELINE,
            play_state="playing",
            loop_mode="all",
        ),
        rrb.SelectionPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        auto_views=False,
        auto_layout=False,
    )


def sea_view(name: str, camera: FloatArray, look_at: FloatArray) -> "rrb.Spatial3DView":
    """The ships and seas of a recording, from `camera` (3,) [m] towards `look_at` (3,) [m]."""
    import rerun.blueprint as rrb

    return rrb.Spatial3DView(
        origin="/world",
        name=name,
        background=[206, 219, 228],
        line_grid=rrb.LineGrid3D(visible=False),
        eye_controls=rrb.EyeControls3D(
            position=camera,
            look_target=look_at,
            eye_up=(0.0, 0.0, 1.0),
        ),
    )


def scrolling_curves(
    name: str, origin: str, contents: list[str] | str = "$origin/**"
) -> "rrb.TimeSeriesView":
    """Curves that scroll past the cursor."""
    import rerun.blueprint as rrb

    window = rrb.TimeRange(
        start=rrb.TimeRangeBoundary.cursor_relative(seconds=-SECONDS_BEFORE),
        end=rrb.TimeRangeBoundary.cursor_relative(seconds=SECONDS_AFTER),
    )
    return rrb.TimeSeriesView(
        name=name,
        origin=origin,
        contents=contents,
        axis_x=rrb.TimeAxis(view_range=window),
        plot_legend=rrb.PlotLegend("LeftTop"),
    )
