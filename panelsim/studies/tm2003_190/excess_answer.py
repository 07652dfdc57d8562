"""What the linear ship makes of the part of the pressure load that is not linear, beside the run itself."""

from dataclasses import dataclass

import numpy as np

from panelsim.case import Case
from panelsim.conventions import Dof
from panelsim.response.linear_ship import LinearShip
from panelsim.results.harmonics import harmonics
from panelsim.ship.ship import Ship
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.excess_load import excess_load
from panelsim.studies.tm2003_190.regular_runs import MEASURED, met_frequency

EXPLAINED = 0.25  # of the difference: what may be left of it
MOST = 0.5  # of the difference


@dataclass(frozen=True)
class ExcessAnswer:
    """By how much a first harmonic is larger than the linear one, over it, in a run and solved for.

    `run`: in the run. The linear ship: `pressure` with the pressure load that is not linear, `stern` with
    that of the aftermost section alone, `displaced` with all of that load and with the diffraction load of
    where the run lies, `surge` [m] ahead.
    """

    run: float
    pressure: float
    stern: float
    displaced: float
    surge: float

    @property
    def verdict(self) -> str:
        """Whose the difference is, in words."""
        if abs(self.displaced - self.run) > EXPLAINED * abs(self.run):
            return "not explained"
        if self.stern / self.run >= MOST:
            return "most of it is of the stern"
        if self.pressure / self.run >= MOST:
            return "most of it is of the pressure, not of the stern"
        return "not of the stern: of the pressure elsewhere and of where the ship lies"


def excess_answer(store: RunStore, case: Case, mode: Dof) -> ExcessAnswer:
    """Solve the linear equations of motion in regular waves for the excess load of a stored run.

    The wave is met at the centre of gravity where the ship would be; at x the phase is k x cos β behind.
    """
    run, omega = store.load(case), met_frequency(case)
    found = harmonics(run.time, run.displacement, omega, after=run.time[-1] - MEASURED)
    excess = excess_load(store, case)
    load = excess.load - excess.linear
    ship = LinearShip(case.ship, case.database(), case.supplementary)
    waves = case.seaway.components
    speed = np.array([case.speed])
    linear = ship.in_waves(waves.frequency, waves.wave_heading, speed, np.zeros(1))
    impedance = ship.impedance(linear.encounter[0], case.speed, 0.0)[0]
    surge = float(found.mean[Dof.SURGE])
    wavenumber = float(waves.wavenumber(case.ship.gravity)[0])
    turn = np.exp(-1j * wavenumber * surge * np.cos(waves.wave_heading[0])) - 1.0
    displaced = turn * linear.diffraction[0, 0] * waves.amplitude[0]
    motion = linear.transfer[0, 0] * waves.amplitude[0]

    def larger(more: np.ndarray) -> np.ndarray:
        solved = motion + np.linalg.solve(impedance, more.T).T
        return np.asarray(np.abs(solved[..., mode]) / abs(motion[mode]) - 1.0)

    whole = load.sum(axis=0)
    pressure, stern, both = larger(np.stack([whole, load[0], whole + displaced]))
    return ExcessAnswer(
        float(abs(found.complex_amplitude[0, mode]) / abs(motion[mode]) - 1.0),
        float(pressure),
        float(stern),
        float(both),
        surge,
    )


def transom_immersion(ship: Ship) -> float:
    """Depth [m] of the aftermost points of the hull below calm water."""
    x, z = ship.vertices[:, 0], ship.vertices[:, 2]
    return float(ship.waterline - z[x < x.min() + 1e-3 * ship.length].min())
