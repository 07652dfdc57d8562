"""A case in the linear and the nonlinear model, in the same waves; the linear one held against theory."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from panelsim.case import Case
from panelsim.conventions import FloatArray
from panelsim.hydro.database import HydroDatabase, Progress
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.response.linear_ship import LinearShip
from panelsim.response.response import response
from panelsim.response.sampling import variance_scatter
from panelsim.results.rms_study import RmsStudy
from panelsim.seaway.random import RandomSeaway
from panelsim.studies.arguments import require_case, require_few_runs
from panelsim.studies.case_response import in_case_sea
from panelsim.studies.rms_of_runs import rms_of_runs
from panelsim.studies.run_store import RunStore
from panelsim.studies.study_sea import realization, require_seeds, study_sea

MODELS = ("linear", "nonlinear")
SEEDS = 5


@dataclass(frozen=True, eq=False)
class LinearNonlinear:
    """A case in both models, in each of some realizations of its sea; the linear model is the reference."""

    case: Case
    seeds: int

    def __post_init__(self) -> None:
        require_case(self.case)
        study_sea(self.case)
        object.__setattr__(self, "seeds", require_seeds(self.case, self.seeds))
        require_few_runs(len(MODELS) * self.seeds)

    @cached_property
    def models(self) -> tuple[Case, Case]:
        """The case, linear and nonlinear."""
        return models_of(self.case)

    @property
    def cases(self) -> list[Case]:
        """Every case to run."""
        return [self.case_of(level, index) for level in range(2) for index in range(self.seeds)]

    def case_of(self, level: int, index: int) -> Case:
        """The case of a model and realization."""
        return realization(self.models[level], index)

    def study(self, store: RunStore) -> RmsStudy:
        """What the stored runs amount to."""
        return rms_of_runs(
            store,
            lambda level, _, index: self.case_of(level, index),
            title="Linear against nonlinear",
            varied="model",
            levels=MODELS,
            values=np.arange(2.0),
            reference=0,
            seas=[study_sea(self.case)],
            realizations=self.seeds,
        )


def models_of(case: Case) -> tuple[Case, Case]:
    """A case, linear and nonlinear; where it leaves the inertia open each has that of its model."""
    linear: dict[str, Any] = {"run.model": "linear"}
    if case.file.run.inertia == "large":
        linear["run.inertia"] = None
    return case.changed(linear), case.changed({"run.model": "nonlinear"})


def require_linear_model(case: Case, progress: Progress | None = None) -> HydroDatabase:
    """The coefficients of a case. Raises PanelsimError where its roll damping has no linear model."""
    linear, _ = models_of(case)
    _ = linear.supplementary, linear.points
    database = linear.database(progress)
    linear.roll_damping(database)
    return database


@dataclass(frozen=True, eq=False)
class FrequencyDomain:
    """RMS (6,) [m, rad] by the frequency domain: of the very components, and of the whole spectrum.

    `components` are those of all realizations together, Σ ½ |H a|², which long linear runs have too; by
    chance the RMS of such runs lies off it by the share `sampling_error` (6,) of it, one standard deviation.
    `spectrum` is None where the sea has none.
    """

    components: FloatArray
    sampling_error: FloatArray
    spectrum: FloatArray | None


def frequency_domain(study: LinearNonlinear, database: HydroDatabase) -> FrequencyDomain:
    """Solve the linear case for the components of each realization, and for its spectrum."""
    linear = study.models[0]
    damping = linear.roll_damping(database) or RollDampingTerms()
    ship = LinearShip(linear.ship, database, linear.supplementary, linear.transom(database))
    found = [_of_components(study.case_of(0, index), ship, damping.linear) for index in range(study.seeds)]
    variance = np.mean([of_run for of_run, _ in found], axis=0)
    # Each realization is independent of the others: the scatter of the mean is that of one over their number.
    scatter = np.mean([of_run for _, of_run in found], axis=0) / study.seeds
    with np.errstate(divide="ignore", invalid="ignore"):
        error = 0.5 * np.sqrt(scatter) / variance
    return FrequencyDomain(np.sqrt(variance), error, _of_spectrum(linear, ship, damping))


def _of_components(case: Case, ship: LinearShip, roll_damping: float) -> tuple[FloatArray, FloatArray]:
    """Variance (6,) of the motions in the waves of a case, and the scatter of that by their phases."""
    waves = case.seaway.components
    motions = ship.in_waves(
        waves.frequency, waves.wave_heading, np.array([case.speed]), np.array([roll_damping])
    )
    variance = 0.5 * np.abs(motions.transfer[0] * waves.amplitude[:, None]) ** 2
    scatter = variance_scatter(motions.encounter[0], variance, case.file.run.duration)
    return variance.sum(axis=0), scatter


def _of_spectrum(case: Case, ship: LinearShip, damping: RollDampingTerms) -> FloatArray | None:
    """RMS (6,) in the spectrum of a random sea; its integral needs no run, and no realization."""
    if not isinstance(case.seaway, RandomSeaway):
        return None
    table = response(
        ship.ship,
        ship.database,
        frequencies=case.seaway.components.frequency[:1],
        wave_headings=[np.deg2rad(study_sea(case).wave_heading_deg)],
        speeds=[case.speed],
        supplementary=ship.supplementary,
        transom=ship.transom,
        roll_damping=[damping],
    )
    return np.asarray(in_case_sea(case, table)["rms"].values[0, 0])
