"""The benchmark of the pressure kernel compares like with like: its methods agree."""

import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture(scope="module")
def benchmark() -> Iterator[ModuleType]:
    """The script as a module, its folder on the path as when it is run."""
    sys.path.insert(0, str(BENCHMARKS))
    try:
        yield import_module("pressure_kernel")
    finally:
        sys.path.remove(str(BENCHMARKS))


@pytest.fixture(scope="module")
def methods(benchmark: ModuleType) -> ModuleType:
    return import_module("pressure_methods")


def test_the_c_sum_is_the_numpy_sum(benchmark: ModuleType, methods: ModuleType) -> None:
    """1298 panels in 160 waves, where no block of the C sum is left half full but the last."""
    if methods.C_SUM not in methods.available():
        pytest.skip("no gcc")
    setting = methods.Setting(5.0, 160)
    evaluate = {methods.C_SUM: methods.c_method(setting)}
    apart = benchmark.require_agreement(setting, evaluate)
    # 4 units in the last place of cos and exp, and the order of sums over 1298 panels and 160 waves.
    assert 0.0 < apart[methods.C_SUM] < 1e-11


def test_the_c_sum_leaves_the_arithmetic_of_the_process_alone(methods: ModuleType) -> None:
    """Linked with -ffast-math it would have smallest numbers read as zero everywhere: search trees crash."""
    if methods.C_SUM not in methods.available():
        pytest.skip("no gcc")
    methods.c_library()
    assert np.float64(1e-310) > 0.0


def test_the_naive_loop_is_the_numpy_sum_and_the_kernel_has_another_rule(
    benchmark: ModuleType, methods: ModuleType
) -> None:
    setting = methods.Setting(5.0, 19)
    names = [name for name in methods.METHODS if name != methods.C_SUM]
    apart = benchmark.require_agreement(setting, {name: methods.METHODS[name](setting) for name in names})
    assert apart["Taichi, naive"] < 1e-11
    # Whole panels against cut ones, on the coarse mesh.
    assert 1e-4 < apart["direct, vertex + centre"] < 0.05


def test_a_method_that_computes_something_else_is_not_timed(
    benchmark: ModuleType, methods: ModuleType
) -> None:
    setting = methods.Setting(5.0, 19)
    plain = methods.numpy_method(setting)
    wrong = {
        "Taichi, naive": lambda poses: plain(poses) * (1 + 1e-8),
        "direct, vertex": lambda poses: plain(poses * [1, 1, 1, 1, 1, 1, -1, 1]),  # the other way down
    }
    for name, call in wrong.items():
        with pytest.raises(SystemExit, match=name):
            benchmark.require_agreement(setting, {name: call})


@pytest.mark.parametrize("count", [19, 37, 160, 2000])
def test_each_sea_has_the_waves_it_is_called_by(methods: ModuleType, count: int) -> None:
    waves = methods.Setting(5.0, count).waves
    assert len(waves.amplitude) == count
    headings = np.unique(np.round(np.arctan2(waves.wavenumber_y, waves.wavenumber_x), 9))
    assert len(headings) == {19: 1, 37: 1, 160: 5, 2000: 25}[count]


def test_without_gcc_the_column_is_left_out(
    benchmark: ModuleType, methods: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(methods.shutil, "which", lambda name: None)
    assert list(methods.available()) == [name for name in methods.METHODS if name != methods.C_SUM]
    cells = {name: benchmark.Cell(12.34, np.nan, 0.1) for name in methods.available()}
    text = benchmark.report(
        benchmark.Results(cells={(1298, 19): cells}, first_call={}, tables={1298: 0.01}, wet={1298: 0.3})
    )
    assert "| 1298 | 19 | 12.3 | 12.3 |" in text
    assert "no gcc" in text
    assert methods.C_SUM not in text
    assert "nan" not in text


def test_ratios_are_to_the_c_sum_of_the_same_round(
    benchmark: ModuleType, methods: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a clock that doubles its pace from round to round, the ratio of 1 s to 4 s stays 4."""
    pace = iter(2.0 ** np.arange(99))
    seconds = {methods.C_SUM: 1.0, "slower": 4.0}
    probes = iter(seconds.values())
    now = [1.0]

    def clock(call: object) -> float:
        probe = next(probes, None)
        if probe is not None:  # the first look at each
            return probe
        name = call.func.__name__  # type: ignore[attr-defined]
        if name == "c":
            now[0] = next(pace)
        return now[0] * {"c": 1.0, "slower": 4.0}[name]

    def c(poses: object) -> None: ...

    def slower(poses: object) -> None: ...

    monkeypatch.setattr(benchmark, "cpu_seconds", clock)
    cells = benchmark.time_methods(methods.Setting(5.0, 19), {methods.C_SUM: c, "slower": slower})
    assert cells["slower"].ratio == pytest.approx(4.0)
    assert cells["slower"].microseconds == pytest.approx(4.0e6 * 2.0)  # the middle of three rounds: 1, 2, 4
    assert cells["slower"].spread == pytest.approx(1.5)
