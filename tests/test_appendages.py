"""Bilge keels, skeg and rudder of the bundled ships."""

from dataclasses import asdict
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from panelsim.errors import PanelsimError
from panelsim.hull.appendages import (
    Appendages,
    BilgeKeelSegment,
    Rudder,
    Skeg,
    read_appendages,
)
from panelsim.hull.form import load_hull
from panelsim.hull.sections import HullLines

KEEL = BilgeKeelSegment(24.0, 21.0, 5.14, 2.49, 0.6)


def test_the_frigate_has_those_of_the_report() -> None:
    """TM 2004-041 Annex B: keels from station 6 to 14, 0.60 m; skeg from 16, rudder at 19; 6 m a station."""
    appendages = load_hull("frigate").appendages
    keels = appendages.bilge_keels
    assert len(keels) == 9
    assert keels[0] == KEEL
    assert keels[-1] == BilgeKeelSegment(-21.0, -24.0, 5.23, 1.66, 0.6)
    assert all(ahead.x_aft == behind.x_forward for ahead, behind in pairwise(keels))
    assert appendages.skeg == Skeg(x_forward=-36.0, length=12.0, depth=1.2)
    assert appendages.rudders == (Rudder(-54.0, 0.0, 3.6, 4.8, 4.8, 2.4),)


def test_keels_and_rudder_of_the_frigate_are_rooted_on_its_hull() -> None:
    """Why y and z of Annex B are read as the root: they lie on the offsets to their centimetre."""
    form = load_hull("frigate")
    assert isinstance(form.shape, HullLines)
    sections = {float(section[0, 0]): section for section in form.shape.sections}
    for keel in form.appendages.bilge_keels:
        middle = 0.5 * (keel.x_forward + keel.x_aft)
        section = sections[6.0 * round(middle / 6.0)] if middle % 6.0 == 0.0 else None
        if section is not None:
            assert np.interp(keel.z, section[:, 2], section[:, 1]) == pytest.approx(keel.y, abs=0.01)
    rudder = form.appendages.rudders[0]
    assert sections[rudder.x][0, 2] == pytest.approx(rudder.root_z, abs=0.02)


def test_they_are_stretched_with_the_hull() -> None:
    scaled = Appendages((KEEL,), Skeg(-36.0, 12.0, 1.2), (Rudder(-54.0, 1.0, 3.6, 4.8, 4.8, 2.4),)).scaled(
        np.array([2.0, 3.0, 5.0])
    )
    assert scaled.bilge_keels == (BilgeKeelSegment(48.0, 42.0, 3 * 5.14, 5 * 2.49, 4 * 0.6),)
    assert scaled.skeg == Skeg(-72.0, 24.0, 6.0)
    assert scaled.rudders == (Rudder(-108.0, 3.0, 18.0, 24.0, 9.6, 4.8),)


def test_ships_scaled_from_the_frigate_have_its_appendages() -> None:
    """HALIFAX is 124.5 m long and 4.97 m deep; a box has none."""
    halifax, frigate = load_hull("halifax"), load_hull("frigate")
    rudder, parent = halifax.appendages.rudders[0], frigate.appendages.rudders[0]
    assert rudder.x == pytest.approx(parent.x * 124.5 / 120.0, rel=1e-12)
    assert rudder.span == pytest.approx(parent.span * 4.97 / 4.2, rel=1e-12)
    assert halifax.scaled(length=120.0).appendages.rudders[0].x == pytest.approx(-54.0, rel=1e-12)
    assert load_hull("box").appendages == Appendages()


def test_read_table() -> None:
    table = {"bilge_keels": [asdict(KEEL)], "skeg": {"x_forward": -36, "length": 12.0, "depth": 1.2}}
    assert read_appendages("a file", table) == Appendages((KEEL,), Skeg(-36, 12.0, 1.2))
    assert read_appendages("a file", {}) == Appendages()


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"fins": []}, "a file: .appendages. holds something unknown"),
        ([], "holds something unknown"),
        ({"bilge_keels": {}}, "bilge_keels in .appendages. is not a list"),
        ({"skeg": {"x_forward": -36.0, "length": 12.0}}, "a skeg in .appendages. has not its keys"),
        ({"rudders": [3.0]}, "a rudder in .appendages. has not its keys"),
        ({"skeg": {"x_forward": -36.0, "length": 0.0, "depth": 1.2}}, "length of a skeg is not a length"),
        ({"skeg": {"x_forward": "-36", "length": 1.0, "depth": 1.2}}, "x_forward of a skeg"),
        ({"bilge_keels": [asdict(KEEL) | {"span": float("nan")}]}, "span of a bilge keel segment"),
        ({"bilge_keels": [asdict(KEEL) | {"x_aft": 25.0}]}, "has no length"),
        ({"bilge_keels": [asdict(KEEL) | {"y": -5.14}]}, "does not lie to port"),
        ({"bilge_keels": [asdict(KEEL), asdict(KEEL)]}, "overlap"),
    ],
)
def test_refusals(table: object, words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        read_appendages("a file", table)


def test_a_particulars_file_is_named(tmp_path: Path) -> None:
    text = (Path(__file__).parents[1] / "hulls/box/particulars.toml").read_text(encoding="utf-8")
    (tmp_path / "particulars.toml").write_text(text + "\n[appendages]\nskegs = 3\n", encoding="utf-8")
    with pytest.raises(PanelsimError, match=r"particulars\.toml: \[appendages\] holds something unknown"):
        load_hull(tmp_path)
