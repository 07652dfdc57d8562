"""The code on the pages runs as it stands there, and every name on them is there."""

import re
from pathlib import Path

import pytest

import panelsim as ps

PROJECT = Path(__file__).parents[1]
DOCS = PROJECT / "docs"
PAGES = sorted([*DOCS.glob("*.md"), PROJECT / "README.md", *(PROJECT / "examples").glob("*.py")])


@pytest.mark.parametrize(
    ("page", "name", "shape"), [("pressure.md", "force", (6,)), ("coefficients.md", "load", (3, 6))]
)
def test_the_code_of_a_page_runs(page: str, name: str, shape: tuple[int, ...]) -> None:
    blocks = re.findall(r"```python\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    names: dict[str, object] = {}
    for block in blocks:
        exec(block, names)
    assert names[name].shape == shape  # type: ignore[attr-defined]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_public_names_of_a_page_are_there(page: Path) -> None:
    for name in set(re.findall(r"\bps\.([A-Za-z_]+)", page.read_text(encoding="utf-8"))):
        assert name in ps.__all__ and getattr(ps, name) is not None, name


def test_every_public_name_can_be_imported() -> None:
    for name in ps.__all__:
        assert getattr(ps, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = ps.nonsense
