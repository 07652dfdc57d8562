"""Studies from Python: what is of another kind is one PanelsimError, and NumPy's numbers are numbers."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import panelsim as ps
from panelsim.errors import PanelsimError
from panelsim.studies.arguments import listed, real_numbers, whole_number
from panelsim.studies.case_cost import case_cost
from panelsim.studies.computing import require_processes
from panelsim.studies.convergence import mesh_convergence, time_step_convergence
from panelsim.studies.linear_nonlinear import LinearNonlinear
from panelsim.studies.run_store import RunStore

EXAMPLE = Path(__file__).parents[1] / "examples" / "halifax_sea_state_7.toml"
KEY = "run.speed_knots"
NO_LIST, NO_NUMBERS, NO_SEEDS = "are no list", "not all numbers", "number of seeds is not possible"


@cache
def case() -> ps.Case:
    return ps.Case.load(EXAMPLE)


def swept(axes: object = None, **given: object) -> object:
    return ps.sweep(case(), {KEY: [0]} if axes is None else axes, workers=given.pop("workers", 1), **given)


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "sweep of a path": (lambda: ps.sweep(EXAMPLE, {KEY: [0]}), "The case is of another kind"),
    "axes, a list": (lambda: swept([KEY]), "mapping of axes"),
    "axis, a number": (lambda: swept({KEY: 5}), NO_LIST),
    "axis, a text": (lambda: swept({KEY: "510"}), NO_LIST),
    "axis, a mapping": (lambda: swept({KEY: {5: 1}}), NO_LIST),
    "axis, None": (lambda: swept({KEY: None}), NO_LIST),
    "axis, a table of numbers": (lambda: swept({KEY: np.zeros((2, 2))}), "A value of run.speed_knots"),
    "axis, an array of no dimension": (lambda: swept({KEY: np.array(3.0)}), NO_LIST),
    "axis, empty": (lambda: swept({KEY: []}), "There are no values of run.speed_knots"),
    "axis, tables": (lambda: swept({"seaway": [{"kind": "calm"}]}), "a number, a word"),
    "key, a number": (lambda: swept({5: [1]}), "key of an axis"),
    "scheduler": (lambda: swept(workers=None, scheduler=8786), "address of the scheduler"),
    "folder": (lambda: swept(folder=5), "a text or a Path"),
    "most_runs, a text": (lambda: swept(most_runs="x"), "most_runs"),
    "most_runs, None": (lambda: swept(most_runs=None), "most_runs"),
    "progress": (lambda: swept(progress=3), "progress"),
    "workers": (lambda: swept(workers=10**6), "more workers than cores"),
    "steps, a text": (lambda: time_step_convergence(case(), "0.1"), NO_LIST),
    "steps, a number": (lambda: time_step_convergence(case(), 0.1), NO_LIST),
    "steps, None in it": (lambda: time_step_convergence(case(), [None]), NO_NUMBERS),
    "steps, true": (lambda: time_step_convergence(case(), [True]), NO_NUMBERS),
    "steps, empty": (lambda: time_step_convergence(case(), []), "There are no time steps"),
    "steppers, None in it": (lambda: time_step_convergence(case(), None, [None]), 'got: "None"'),
    "steppers, a text": (lambda: time_step_convergence(case(), None, "rk4"), NO_LIST),
    "time steps of a path": (lambda: time_step_convergence(EXAMPLE), "The case is of another kind"),
    "seeds, half": (lambda: time_step_convergence(case(), seeds=1.5), NO_SEEDS),
    "seeds, a text": (lambda: time_step_convergence(case(), seeds="1"), NO_SEEDS),
    "too many runs": (lambda: time_step_convergence(case(), seeds=501), "2004 runs"),
    "areas": (lambda: mesh_convergence(case(), ["a"]), NO_NUMBERS),
    "mesh of a path": (lambda: mesh_convergence(str(EXAMPLE)), "The case is of another kind"),
    "models of a text": (lambda: LinearNonlinear("x", 1), "The case is of another kind"),
    "models, seeds": (lambda: LinearNonlinear(case(), "x"), NO_SEEDS),
    "models, half": (lambda: LinearNonlinear(case(), 2.5), NO_SEEDS),
    "models, NaN": (lambda: LinearNonlinear(case(), np.nan), NO_SEEDS),
    "models, too many": (lambda: LinearNonlinear(case(), 1001), "2002 runs"),
    "cost, none": (lambda: case_cost(case(), []), "There are no numbers of components"),
    "cost, a text": (lambda: case_cost(case(), "ab"), NO_LIST),
    "cost, half": (lambda: case_cost(case(), [5.5]), "whole numbers from 2"),
    "cost, no area": (lambda: case_cost(case(), None, []), "There are no panel areas"),
    "cost of a path": (lambda: case_cost(EXAMPLE), "The case is of another kind"),
    "store": (lambda: RunStore(5), "a text or a Path"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused_in_words(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    call, words = REFUSED[name]
    with pytest.raises(PanelsimError) as refused:
        call()
    assert words in str(refused.value)
    assert not list(tmp_path.iterdir())


def test_numbers_of_numpy_are_numbers() -> None:
    two = np.int64(2)
    assert whole_number("number", two) == 2 and type(whole_number("number", two)) is int
    require_processes(np.int64(1), None)  # type: ignore[arg-type]
    study = time_step_convergence(case(), np.array([0.1, 0.2]), seeds=two)  # type: ignore[arg-type]
    assert study.values == (0.2, 0.1) and len(study.cases) == 6
    assert LinearNonlinear(case(), two).seeds == 2  # type: ignore[arg-type]
    assert case_cost(case(), np.array([19.0, 37.0])).frequencies == (19, 37)  # type: ignore[arg-type]
    assert real_numbers("steps", (1, np.float32(0.5))) == [1.0, 0.5]
    assert [type(value) for value in listed("values", np.array([1, 2]), "")] == [int, int]
    assert RunStore("here").folder == Path("here")


def test_one_value_of_each_kind_is_not_too_many() -> None:
    assert LinearNonlinear(case(), 1000).seeds == 1000  # 2000 runs
    assert len(time_step_convergence(case(), [0.2], seeds=2).cases) == 4
