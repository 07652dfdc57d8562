"""Axes of a sweep: what is read from text, what is refused, and the units of keys."""

import pytest

from panelsim.errors import PanelsimError
from panelsim.studies.axes import Axis, require_axes


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("run.speed_knots=0:30:5", (0, 5, 10, 15, 20, 25, 30)),
        ("run.speed_knots=30:0:-15", (30, 15, 0)),
        ("run.time_step=0.1:0.5:0.1", (0.1, 0.2, 0.3, 0.4, 0.5)),  # as they are written, to the last bit
        (" seaway.wave_heading_deg = -30 : 30 : 30 ", (-30, 0, 30)),
        ("run.model=linear, nonlinear", ("linear", "nonlinear")),
        ('run.stepper="rk4",ab3', ("rk4", "ab3")),
        ("hydrodynamics.transom_terms=true,false", (True, False)),
        ("ship.panel_area=2.5,10,1e1", None),
        ("seaway.sea_state=7", (7,)),
    ],
)
def test_texts(text: str, values: tuple[object, ...] | None) -> None:
    if values is None:
        with pytest.raises(PanelsimError, match=r"given twice(.|\n)*10"):
            Axis.parse(text)
        return
    axis = Axis.parse(text)
    assert axis.values == values
    assert [type(value) for value in axis.values] == [type(value) for value in values]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("run.speed_knots", "form key=values"),
        ("=1,2", "form key=values"),
        ("run..speed=1", "form key=values"),
        ("run.speed_knots=", "gap"),
        ("run.speed_knots=1,,2", "gap"),
        ("run.speed_knots=0:30", "no range"),
        ("run.speed_knots=0:30:5:1", "no range"),
        ("run.speed_knots=a:b:c", "no range"),
        ("run.speed_knots=0:inf:1", "no range"),
        ("run.speed_knots=0:true:1", "no range"),
        ("run.speed_knots=0:30:7", r"does not lead(.|\n)*end at 28 or 35"),
        ("run.speed_knots=0:30:-5", r"must be more than 0"),
        ("run.speed_knots=30:0:5", r"must be less than 0"),
        ("run.speed_knots=0:30:0", r"must be more than 0"),
        ("run.speed_knots=5:5:1", r"single value"),
        ("run.speed_knots=0:30:0.001", r"too many(.|\n)*30000(.|\n)*1000"),
        ("run.speed_knots=0:1:5e-324", r"too many(.|\n)*inf"),
        ("run.speed_knots=-1e308:1e308:1e307", "no range"),
        (f"seaway.seed=0:{10**400}:1", "no range"),
    ],
)
def test_texts_refused(text: str, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        Axis.parse(text)


def test_axes_that_do_not_go_together() -> None:
    with pytest.raises(PanelsimError, match="no axis"):
        require_axes([])
    with pytest.raises(PanelsimError, match="no values"):
        Axis("run.speed_knots", ())
    speed, again = Axis("run.speed_knots", (0, 1)), Axis("run.speed_knots", (2, 3))
    with pytest.raises(PanelsimError, match="same key"):
        require_axes([speed, again])
    for key in ("run.speed_knots", "run", " run.speed_knots "):
        with pytest.raises(PanelsimError, match="set besides"):
            require_axes([speed], [key])
    require_axes([speed], ["run.speed", "run.speed_knots_more"])


@pytest.mark.parametrize(
    ("key", "unit"),
    [
        ("seaway.wave_heading_deg", "deg"),
        ("run.speed_knots", "knots"),
        ("run.time_step", "s"),
        ("seaway.frequencies.step", "rad/s"),
        ("ship.gyradius_roll", "m"),
        ("supplementary.damping.roll", "N m/(rad/s)"),
        ("supplementary.stiffness.surge", "N/m"),
        ("run.model", "1"),
    ],
)
def test_units(key: str, unit: str) -> None:
    assert Axis(key, (1,)).unit == unit
