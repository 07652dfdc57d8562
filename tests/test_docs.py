"""The code on the pages runs as it stands there, and every name on them is there."""

import importlib
import re
from pathlib import Path

import pytest

import panelsim as ps

PROJECT = Path(__file__).parents[1]
DOCS = PROJECT / "docs"
PAGES = sorted([*DOCS.glob("*.md"), PROJECT / "README.md", *(PROJECT / "examples").glob("*.py")])


def run_code(page: str) -> dict[str, object]:
    """Run the Python of a page from its first block to its last; what it has named."""
    blocks = re.findall(r"```python\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    names: dict[str, object] = {}
    for block in blocks:
        exec(block, names)
    return names


@pytest.mark.parametrize(
    ("page", "name", "shape"),
    [("pressure.md", "force", (6,)), ("coefficients.md", "load", (3, 6)), ("studies.md", "roll", (2,))],
)
def test_the_code_of_a_page_runs(page: str, name: str, shape: tuple[int, ...]) -> None:
    assert run_code(page)[name].shape == shape  # type: ignore[attr-defined]


def test_the_views_of_the_page_on_seas_agree() -> None:
    """A ship that goes straight for a minute meets what is there: 480 m on at 8 m/s."""
    names = run_code("seaways.md")
    at_rest, meeting = names["at_rest"], names["meeting"]
    # The ship heads north, along the fixed x axis.
    there = at_rest.elevation(480.0, 0.0, 60.0)  # type: ignore[attr-defined]
    assert meeting.elevation(0.0, 0.0, 60.0) == pytest.approx(there, rel=1e-9)  # type: ignore[attr-defined]


def test_the_pages_on_runs_keep_their_word(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # a page saves a history
    names = run_code("time_stepping.md")
    whole = ps.simulate(names["ship"], names["sea"], duration=60, **names["settings"])  # type: ignore
    assert names["whole"].same_bits(whole)  # type: ignore[attr-defined]
    names = run_code("roll_damping.md")
    assert names["both"][1].same_bits(names["history"])  # type: ignore[index]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_public_names_of_a_page_are_there(page: Path) -> None:
    for name in set(re.findall(r"\bps\.([A-Za-z_]+)", page.read_text(encoding="utf-8"))):
        assert name in ps.__all__ and getattr(ps, name) is not None, name


def test_the_names_of_studies_are_where_the_page_says() -> None:
    page = (DOCS / "studies.md").read_text(encoding="utf-8")
    (said,) = re.findall(r"In Python, in `panelsim\.studies`: ([^.]+\..*?)\.\n\n", page, re.DOTALL)
    names = [name.rpartition(".") for name in re.findall(r"`([^`]+)`", said)]
    assert len(names) == 5
    for module, _, name in names:
        assert hasattr(importlib.import_module(f"panelsim.studies.{module}"), name), name


def test_every_public_name_can_be_imported() -> None:
    for name in ps.__all__:
        assert getattr(ps, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = ps.nonsense
