"""What the runs of a sweep amount to: statistics of the six motions over its axes."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from importlib.metadata import version

import numpy as np
import xarray as xr

from panelsim.case import Case
from panelsim.conventions import CONFIDENCE, DOF_NAMES, FloatArray
from panelsim.errors import PanelsimError
from panelsim.results.rms_study import confidence_band
from panelsim.results.statistics import zero_crossing_period
from panelsim.studies.run_store import RunStore, StoredRun
from panelsim.studies.sweep_plan import SEEDED, SweepPlan

OUTCOMES = ("finished", "capsized", "diverged", "failed")
_SIX = "m (surge, sway, heave), rad (roll, pitch, yaw)"
_LONG_NAMES = {
    "mean": "mean of all realizations that finished",
    "rms": "RMS about the mean, of all realizations that finished together",
    "rms_half_width": "half width of the 95 % confidence band of the RMS",
    "max": "largest value of all realizations that finished",
    "min": "smallest value of all realizations that finished",
    "zero_crossing_period": "mean zero-crossing period of the realizations that finished",
}


def sweep_dataset(plan: SweepPlan, store: RunStore) -> xr.Dataset:
    """The statistics of a sweep whose runs are stored; PanelsimError where none of them could be made.

    Dimensions: the keys of the axes, and `dof`. `mean`, `rms`, `rms_half_width`, `max`, `min` [m, rad] and
    `zero_crossing_period` [s] are of the realizations that finished, from the end of the ramp; `realizations`
    says how many these are, `capsized`, `diverged` and `failed` how many did not. Attributes: the case as
    JSON, its seeds, the version; `ended_early` has a sentence for each run that did not finish.
    """
    shape, found = plan.shape[:-1], _Found(plan, store)
    columns = {name: np.full((*shape, 6), np.nan) for name in _LONG_NAMES}
    counts = {name: np.zeros(shape, dtype=np.int64) for name in OUTCOMES}
    waves = np.full(shape, np.nan)
    for point in np.ndindex(shape):
        runs, outcomes = found.at(point)
        for name, number in outcomes.items():
            counts[name][point] = number
        if runs:
            for name, values in _statistics(runs).items():
                columns[name][point] = values
            waves[point] = np.sqrt(np.mean([run.wave_elevation[run.after_ramp].var() for run in runs]))
    if counts["failed"].sum() == np.prod(plan.shape):
        raise PanelsimError(f"No run of the sweep could be made. The first, {found.sentences[0]}")
    return _dataset(plan, columns, counts, waves, found.sentences)


class _Found:
    """The runs of a sweep as the store has them, and what did not finish."""

    def __init__(self, plan: SweepPlan, store: RunStore) -> None:
        self.plan, self.store = plan, store
        self.sentences: list[str] = []

    def at(self, point: tuple[int, ...]) -> tuple[list[StoredRun], Counter[str]]:
        """The runs at a point that finished, and how many ended in which way."""
        runs, outcomes = [], Counter[str]()
        for realization in range(len(self.plan.seeds)):
            case = self.plan.cases[*point, realization]
            failure = self.store.failure(case)
            run = None if failure is not None else self.store.load(case)
            outcomes[run.outcome if run is not None else "failed"] += 1
            if run is not None and run.outcome == "finished":
                runs.append(run)
            else:
                why = failure if run is None else run.early_end
                self.sentences.append(f"{self.plan.words((*point, realization))}: {why}")
        return runs, outcomes


def _statistics(runs: Sequence[StoredRun]) -> dict[str, FloatArray]:
    """Statistics (6,) of runs that finished, by the names of `_LONG_NAMES`."""
    motions = [run.displacement[run.after_ramp] for run in runs]
    rms = np.array([run.rms for run in runs])
    pooled = np.sqrt(np.mean(rms**2, axis=0))
    periods = np.array(
        [
            [zero_crossing_period(run.time[run.after_ramp], column) or np.nan for column in motion.T]
            for run, motion in zip(runs, motions, strict=True)
        ]
    )
    measured = np.isfinite(periods)
    return {
        "mean": np.mean([motion.mean(axis=0) for motion in motions], axis=0),
        "rms": pooled,
        "rms_half_width": confidence_band(rms) * pooled,
        "max": np.max([motion.max(axis=0) for motion in motions], axis=0),
        "min": np.min([motion.min(axis=0) for motion in motions], axis=0),
        "zero_crossing_period": np.where(
            measured.any(axis=0), np.nansum(periods, axis=0) / np.maximum(measured.sum(axis=0), 1), np.nan
        ),
    }


def _dataset(
    plan: SweepPlan,
    columns: Mapping[str, FloatArray],
    counts: Mapping[str, np.ndarray],
    waves: FloatArray,
    sentences: Sequence[str],
) -> xr.Dataset:
    keys = [axis.key for axis in plan.axes]
    variables: dict[str, tuple[list[str], np.ndarray, dict[str, str]]] = {
        name: ([*keys, "dof"], values, {"units": _unit(name), "long_name": _LONG_NAMES[name]})
        for name, values in columns.items()
    }
    variables["wave_elevation_rms"] = keys, waves, {"units": "m", "long_name": "RMS of the waves met"}
    for name, number in counts.items():
        told = {"units": "1", "long_name": f"realizations that {name}"}
        variables["realizations" if name == "finished" else name] = keys, number, told
    units = "dof", ["m"] * 3 + ["rad"] * 3, {"long_name": "unit of mean, rms, rms_half_width, max and min"}
    coordinates = {axis.key: (axis.key, np.array(axis.values), {"units": axis.unit}) for axis in plan.axes}
    return xr.Dataset(
        variables,
        coords=coordinates | {"dof": list(DOF_NAMES), "dof_unit": units},
        attrs={
            "case": json.dumps(plan.base.resolved(), ensure_ascii=False, sort_keys=True),
            "name": plan.base.name,
            "ship": plan.base.ship.name,
            "seeds": json.dumps(plan.seeds if plan.base.file.seaway.kind in SEEDED else []),
            "confidence": CONFIDENCE,
            "panelsim_version": version("panelsim"),
            "port_starboard_symmetric": "yes" if _is_symmetric(plan.base) else "no",
            "ended_early": json.dumps(list(sentences), ensure_ascii=False),
        },
    )


def _unit(name: str) -> str:
    return "s" if name == "zero_crossing_period" else _SIX


def _is_symmetric(case: Case) -> bool:
    """Whether waves from port do as those from starboard: ship and sea are their own mirror images."""
    mesh = case.file.ship.mesh
    hull = case.ship.form is not None or (mesh is not None and mesh.symmetry is not None)
    return hull and case.file.seaway.kind in ("random", "regular", "record")
