"""Speed of the pressure kernel beside NumPy with and without look-up tables (TM 2003-190 section 7)."""

import json
import platform
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from panelsim.case import Case
from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import read_json_table, write_whole
from panelsim.kernels.oracle import Surroundings
from panelsim.kernels.runtime import interrupts_held_back
from panelsim.kernels.tables import panel_tables
from panelsim.loads.wetted_surface import component_tables
from panelsim.results.rms_tables import markdown_table
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.look_up import LookUpSurroundings
from panelsim.studies.tm2003_190.section import Section, Statement

FILE = "kernel_speed.json"
_WHAT, _AGAIN = "The file of the kernel's timings", "remove it, and measure again"
NUMPY, SINES, TABLES = "NumPy", "NumPy, sines from a table", "NumPy, sines and exponentials from tables"
DIRECT, GRID = "kernel, direct sum", "kernel, grid"
POSES, ROUNDS, QUICK_ROUNDS = 8, 11, 3
GAIN = 0.05  # of the time: less is no improvement that two measurements tell apart
# Poses scatter about rest by these: time, factor, surge, sway, heave, roll, pitch, yaw.
SCATTER = np.array([500.0, 0.0, 3.0, 2.0, 1.0, 0.1, 0.04, 0.03])

Evaluate = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class KernelSpeed:
    """CPU time of one wetted-surface load in sea state 7 with 19 components, method by method."""

    base: Case
    quick: bool
    key: str = "kernel-speed"

    @property
    def cases(self) -> Sequence[Case]:
        """It reads no runs."""
        return ()

    @property
    def rounds(self) -> int:
        """How often every method takes its turn."""
        return QUICK_ROUNDS if self.quick else ROUNDS

    def is_measured(self, store: RunStore) -> bool:
        """Whether timings by this version, of as many rounds, are in the folder."""
        path = store.folder / FILE
        if not path.is_file():
            return False
        found = read_json_table(path, _WHAT, _AGAIN)
        of_now = found.get("panelsim_version") == version("panelsim")
        rounds = found.get("rounds")
        return of_now and "methods" in found and isinstance(rounds, int) and rounds >= self.rounds

    def measure(self, store: RunStore) -> None:
        """Time all methods and keep the figures as JSON in the folder of the runs."""
        if self.is_measured(store):
            return
        found = timings(_methods(self.base), _poses(), self.rounds)
        told = {
            "panelsim_version": version("panelsim"),
            "machine": f"{platform.machine()}, Python {platform.python_version()}, NumPy {np.__version__}",
            "rounds": self.rounds,
            "panels": self.base.ship.mesh.panel_count,
            "components": self.base.seaway.components.count,
            "methods": found,
        }
        write_whole(store.folder / FILE, json.dumps(told, ensure_ascii=False, indent=2).encode())

    def section(self, store: RunStore, folder: Path) -> Section:
        """What the stored timings show. Raises PanelsimError where there are none."""
        if not self.is_measured(store):
            raise PanelsimError(
                "The speed of the kernel is not measured",
                got=store.folder / FILE,
                remedy="run the study, it goes on where it was",
            )
        told = json.loads((store.folder / FILE).read_text(encoding="utf-8"))
        try:
            return self._section(told, told["methods"])
        except (KeyError, TypeError, AttributeError, ZeroDivisionError) as error:
            raise PanelsimError(f"{_WHAT} is damaged", got=store.folder / FILE, remedy=_AGAIN) from error

    def _section(self, told: dict[str, Any], found: dict[str, dict[str, float]]) -> Section:
        return Section(
            self.key,
            "Look-up tables and the pressure kernel (7)",
            "Do look-up tables for sine and exponential make the pressure quicker, and what does the kernel?",
            f"One wetted-surface load of {told['panels']} panels in {told['components']} components, panels"
            f" cut at the water; all methods in one process and thread take turns, {POSES} poses at a time,"
            f" CPU time, median of {told['rounds']} rounds ({told['machine']}). Tables of 4096 cosines a"
            " turn and 65536 exponentials, without interpolation. Compilation is not counted. Our tables"
            " are read by NumPy from Python, those of the report by C code in a DLL: this is another"
            " experiment than its.",
            _table(found),
            statements(found),
            tables={"kernel_speed.csv": _csv(found)},
        )


def timings(methods: dict[str, Evaluate], poses: FloatArray, rounds: int) -> dict[str, dict[str, float]]:
    """CPU seconds of an evaluation and the largest difference from the first method, by method.

    The methods take turns, so that other work on the machine touches all alike; medians of the rounds.
    Differences are shares of the largest force and of the largest moment that waves change.
    """
    loads = {name: evaluate(poses) for name, evaluate in methods.items()}  # compiles
    seconds: dict[str, list[float]] = {name: [] for name in methods}
    for _ in range(rounds):
        for name, evaluate in methods.items():
            begin = time.process_time()
            evaluate(poses)
            seconds[name].append((time.process_time() - begin) / len(poses))
    reference = next(iter(loads.values()))
    size = np.ptp(reference, axis=0).reshape(2, 3).max(axis=1).repeat(3)
    return {
        name: {
            "seconds": float(np.median(seconds[name])),
            "spread": float(np.ptp(seconds[name]) / np.median(seconds[name])),
            "difference": float(np.abs((loads[name] - reference) / size).max()),
        }
        for name in methods
    }


def statements(found: dict[str, dict[str, float]]) -> tuple[Statement, ...]:
    """Look-up tables gave no improvement over the library's functions; our kernels do.

    Those of the report were in C; whether tables gain there these figures cannot say.
    """
    times = {name: of["seconds"] for name, of in found.items()}
    look_up = times[SINES] / times[NUMPY]
    return (
        Statement(
            "Look-up tables for sine and cosine give no improvement over the numerical library (7)",
            look_up >= 1.0 - GAIN,
            f"{look_up:.2g} times the time of NumPy's own functions; {1.0 - GAIN:g} or more is no"
            f" improvement",
            f"Tables of NumPy, not of C as in the report."
            f" With the exponential from a table too it is {times[TABLES] / times[NUMPY]:.2g}. The pressure"
            f" kernel takes {times[DIRECT] / times[NUMPY]:.2g} (direct sum) and"
            f" {times[GRID] / times[NUMPY]:.2g} (grid) of that time.",
        ),
    )


def _methods(case: Case) -> dict[str, Evaluate]:
    """The load (B, 6) of poses (B, 8) by each method, the plain one first."""
    with interrupts_held_back():  # Taichi is imported here
        from panelsim.kernels.pressure import PressureIntegral
    ship = case.ship
    panels = panel_tables(ship.vertices, ship.mesh.panels)
    waves = component_tables(case.seaway.components, case.speed, ship.gravity)
    weight = ship.water_density * ship.gravity

    def summed(surroundings: Callable[[FloatArray], Surroundings]) -> Evaluate:
        return lambda poses: np.array(
            [surroundings(pose).wet_part_of(panels, "vertex+centre").loads.sum(axis=0) for pose in poses]
        )

    def kernel(method: str) -> Evaluate:
        return PressureIntegral(
            panels,
            [waves],
            waterline=ship.waterline,
            water_density=ship.water_density,
            gravity=ship.gravity,
            method=method,
        )

    return {
        NUMPY: summed(lambda pose: Surroundings(waves, pose, ship.waterline, weight, "wheeler")),
        SINES: summed(lambda pose: LookUpSurroundings(waves, pose, ship.waterline, weight)),
        TABLES: summed(lambda pose: LookUpSurroundings(waves, pose, ship.waterline, weight, decay_too=True)),
        DIRECT: kernel("direct"),
        GRID: kernel("grid"),
    }


def _poses() -> FloatArray:
    poses = np.random.default_rng(1).normal(0.0, SCATTER, (POSES, 8))
    poses[:, 1] = 1.0
    return poses


def _rows(found: dict[str, dict[str, Any]]) -> list[list[str]]:
    unit = found[NUMPY]["seconds"]
    return [
        [
            name,
            f"{1e6 * of['seconds']:.3g}",
            f"{of['seconds'] / unit:.2g}",
            f"{100 * of['spread']:.0f}",
            f"{of['difference']:.1g}",
        ]
        for name, of in found.items()
    ]


_HEADS = ("", "µs an evaluation", "of NumPy's time", "spread [%]", "largest difference")


def _table(found: dict[str, dict[str, Any]]) -> str:
    note = "\nDifference of the load from NumPy's, of what the load ranges over; spread of the rounds.\n"
    return markdown_table(_HEADS, _rows(found), text_columns=1) + note


def _csv(found: dict[str, dict[str, Any]]) -> str:
    return "".join(f"{','.join(row)}\n" for row in [["method", *_HEADS[1:]], *_rows(found)]).replace(
        "kernel, ", "kernel "
    )
