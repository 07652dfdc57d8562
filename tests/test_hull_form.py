"""Hull forms: what the bundled files say, what is refused, how a form scales."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from panelsim.errors import PanelsimError
from panelsim.hull.form import bundled_hull_names, hull_folder, load_hull

NAMES = (
    "box",
    "corvette",
    "cylinder",
    "frigate",
    "halifax",
    "mine_hunter",
    "s175",
    "sphere",
    "supply_ship",
    "wigley_i",
    "wigley_ii",
    "wigley_iii",
    "wigley_iv",
)


def copied(name: str, folder: Path, old: str = "", new: str = "") -> Path:
    """A copy of a bundled hull with one text of its particulars replaced."""
    copy = folder / f"my_{name}"
    shutil.copytree(hull_folder(name), copy)
    path = copy / "particulars.toml"
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return copy


def test_the_reference_ships_are_bundled() -> None:
    assert bundled_hull_names() == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_each_bundled_hull_says_where_it_comes_from_and_what_is_assumed(name: str) -> None:
    form = load_hull(name)
    assert form.name == name
    assert len(form.title) > 5
    assert len(form.source) > 20
    assert form.assumptions
    assert form.loading.water_density in (1000.0, 1025.0)
    assert set(form.supplementary) == {"stiffness", "damping"}


def test_halifax_is_table_2_of_tm_2003_190() -> None:
    form = load_hull("halifax")
    assert "HALIFAX-like" in form.title
    assert (form.length_pp, form.beam, form.draft, form.trim_by_stern) == (124.5, 14.8, 4.97, -0.04)
    loading = form.loading
    assert (loading.center_of_gravity_height, loading.water_density) == (6.26, 1000.0)
    assert (loading.gyradius_roll, loading.gyradius_pitch, loading.gyradius_yaw) == (5.82, 28.8, 28.8)
    assert form.supplementary["stiffness"] == {"surge": 5e5, "sway": 1e6, "yaw": 2e9}
    assert form.supplementary["damping"] == {"surge": 1e6, "sway": 2e6, "roll": 2e7}


@pytest.mark.parametrize("name", ["corvette", "supply_ship"])
def test_geosims_carry_loading_and_springs_of_the_frigate_by_froudes_law(name: str) -> None:
    ship = load_hull(name)
    scaled = load_hull("frigate").scaled(length=ship.length_pp, beam=ship.beam, draft=ship.draft)
    for field in ("center_of_gravity_height", "gyradius_roll", "gyradius_pitch", "gyradius_yaw"):
        assert getattr(scaled.loading, field) == pytest.approx(getattr(ship.loading, field), rel=1e-3)
    for kind, values in ship.supplementary.items():
        # 1 %: the files give three figures, and round the mass to that of Table 3.
        assert scaled.supplementary[kind] == pytest.approx(values, rel=0.01)


def test_froude_scaling_has_the_powers_of_a_geosim() -> None:
    form = load_hull("halifax")
    four = form.scaled(length=4 * form.length_pp, beam=4 * form.beam, draft=4 * form.draft)
    for kind, per_time in (("stiffness", 1.0), ("damping", 0.5)):
        for dof, value in form.supplementary[kind].items():
            power = 3.0 - per_time + (2.0 if dof in ("roll", "yaw") else 0.0)
            assert four.supplementary[kind][dof] == pytest.approx(value * 4.0**power, rel=1e-12)


def test_scaling_one_dimension_keeps_the_others_and_leaves_published_values_behind() -> None:
    frigate = load_hull("frigate")
    deeper = frigate.scaled(draft=5.25)
    assert (deeper.length_pp, deeper.beam, deeper.draft) == (120.0, 14.106, 5.25)
    assert deeper.loading.center_of_gravity_height == pytest.approx(7.5)
    assert deeper.loading.gyradius_roll == frigate.loading.gyradius_roll
    assert frigate.published["mass"] == 3735e3
    assert deeper.published == {}
    before, after = frigate.panel(10.0).vertices, deeper.panel(10.0).vertices
    assert after[:, 2].max() == pytest.approx(1.25 * before[:, 2].max(), rel=1e-12)
    assert after[:, 0].max() == pytest.approx(before[:, 0].max(), rel=1e-12)


def test_fingerprint_follows_the_form_and_not_the_panels() -> None:
    form = load_hull("frigate")
    form.panel(10.0)
    assert form.fingerprint() == load_hull("frigate").fingerprint()
    assert form.scaled().fingerprint() == form.fingerprint()
    prints = {load_hull(name).fingerprint() for name in NAMES}
    prints |= {form.scaled(draft=4.21).fingerprint(), form.scaled(beam=14.2).fingerprint()}
    assert len(prints) == len(NAMES) + 2


def test_trim_by_stern_is_deeper_aft() -> None:
    mesh = load_hull("frigate").panel(10.0, trim_by_stern=1.2)
    x, _, z = mesh.vertices.T
    waterline = 4.2 - x * 1.2 / 120.0
    on_water = np.abs(z - waterline) < 1e-12
    assert np.count_nonzero(on_water) > 40
    assert z[on_water & (x < -59.9)] == pytest.approx(4.8, abs=1e-9)


def test_folder_loads_like_the_bundled_hull(tmp_path: Path) -> None:
    folder = copied("s175", tmp_path)
    assert load_hull(folder).fingerprint() == load_hull("s175").fingerprint()
    assert load_hull(str(folder)).name == "my_s175"


def test_misspelt_name_is_refused_with_the_nearest() -> None:
    with pytest.raises(PanelsimError, match="did you mean frigate"):
        load_hull("frigat")


@pytest.mark.parametrize(
    ("name", "old", "new", "message"),
    [
        ("frigate", "beam =", "bream =", "did you mean beam"),
        ("frigate", "draft = 4.2\n", "", "lacks draft"),
        ("frigate", "draft = 4.2", "draft = -4.2", "draft is not positive"),
        ("frigate", "draft = 4.2", 'draft = "4.2"', "is not a number"),
        ("frigate", "draft = 4.2", "draft = 4,2", "not a TOML file"),
        ("frigate", "[[54, 0]", "[[54, 9]", "heights of the stem do not run upwards"),
        ("frigate", "[[54, 0]", "[[54]", "not a list of points"),
        ("frigate", 'offsets = "offsets.csv"', 'offsets = "other.csv"', "file of offsets is missing"),
        ("frigate", "surge =", "sruge =", "did you mean surge"),
        ("corvette", '"frigate"', '"tanker"', "does not name another bundled hull"),
        ("box", '"box"', '"brick"', "unknown shape"),
        ("sphere", "beam = 10.0", "beam = 9.0", "as long as it is broad"),
        ("sphere", "[dimensions]", "depth = 3.0\n[dimensions]", "unknown key"),
    ],
)
def test_faulty_particulars_are_refused_by_key(
    name: str, old: str, new: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises(PanelsimError, match=message):
        load_hull(copied(name, tmp_path, old, new))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("x,half_breadth,height", "x,y,z", "column names"),
        ("-60,4.181,3.87", "-60,4.181", "line 6"),
        ("-60,4.181,3.87", "-60,4.181,nan", "line 6"),
        ("-60,4.181,3.87", "-60,-4.181,3.87", "line 6"),
        ("-60,4.181,3.87", "-60,4.181,9.9", "do not run upwards"),
    ],
)
def test_faulty_offsets_are_refused_by_line(old: str, new: str, message: str, tmp_path: Path) -> None:
    folder = copied("frigate", tmp_path)
    offsets = folder / "offsets.csv"
    text = offsets.read_text(encoding="utf-8")
    assert old in text
    offsets.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(PanelsimError, match=message):
        load_hull(folder)


@pytest.mark.parametrize("bad", [0.0, -1.0, float("nan")])
def test_scaling_to_nothing_is_refused(bad: float) -> None:
    with pytest.raises(PanelsimError, match="beam is not positive"):
        load_hull("frigate").scaled(beam=bad)
