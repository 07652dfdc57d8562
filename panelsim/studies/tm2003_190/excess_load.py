"""Where along the hull the nonlinear pressure in regular waves differs from its linear part."""

from dataclasses import dataclass

import numpy as np

from panelsim.case import Case
from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.kernels.oracle import Surroundings
from panelsim.kernels.section_loads import section_loads
from panelsim.kernels.tables import panel_tables
from panelsim.loads.wetted_surface import component_tables
from panelsim.results.harmonics import harmonics
from panelsim.studies.run_store import RunStore
from panelsim.studies.tm2003_190.regular_runs import MEASURED, met_frequency

SECTIONS = 20
INSTANTS = 16  # a period: eight harmonics before they fold onto the first
SMALL = 1e-3  # of the motion and of the wave: the linear part of the load, to 1e-3 of what is not linear


@dataclass(frozen=True, eq=False)
class ExcessLoad:
    """First harmonics of the pressure load between stations, of the run and of its linear part.

    `stations` (S + 1,) [m] in ship axes, rising; `load` and `linear` (S, 6) [N, N m].
    """

    stations: FloatArray
    load: ComplexArray
    linear: ComplexArray

    def share(self, mode: Dof) -> FloatArray:
        """Share (S,) of each section in the excess of the whole hull, in phase with it; the sum is 1."""
        excess = (self.load - self.linear)[:, mode]
        return np.asarray((excess / excess.sum()).real)

    def size(self, mode: Dof) -> float:
        """Excess of the whole hull over the linear load."""
        whole = self.load[:, mode].sum(), self.linear[:, mode].sum()
        return float(abs(whole[0] - whole[1]) / abs(whole[1]))


def excess_load(store: RunStore, case: Case) -> ExcessLoad:
    """Follow the pressure over a period of a stored run, with the harmonics that it has at its end.

    The linear part is that of the first harmonic of the motion with the wave, both a thousandth as large.
    """
    run, omega = store.load(case), met_frequency(case)
    found = harmonics(run.time, run.displacement, omega, after=run.time[-1] - MEASURED)
    x = case.ship.vertices[:, 0]
    room = 1e-6 * np.ptp(x)
    stations = np.linspace(x.min() - room, x.max() + room, SECTIONS + 1)
    time = np.linspace(0.0, 2.0 * np.pi / omega, INSTANTS, endpoint=False)
    turn = np.exp(1j * omega * time)
    first: FloatArray = np.asarray((turn[:, None] * found.complex_amplitude[0]).real)
    turns = turn[:, None] ** np.arange(1, len(found.complex_amplitude) + 1)
    whole = found.mean + np.asarray((turns @ found.complex_amplitude).real)
    weights = 2.0 / INSTANTS * turn.conj()
    load = np.einsum("t,tsk->sk", weights, _loads(case, stations, time, whole, 1.0))
    linear = np.einsum("t,tsk->sk", weights, _loads(case, stations, time, SMALL * first, SMALL)) / SMALL
    return ExcessLoad(stations, np.asarray(load), np.asarray(linear))


def _loads(
    case: Case, stations: FloatArray, time: FloatArray, displacement: FloatArray, scale: float
) -> FloatArray:
    """Pressure loads (T, S, 6) of the sections in waves of `scale` times the height of the case."""
    ship = case.ship
    panels = panel_tables(ship.vertices, ship.mesh.panels)
    waves = component_tables(case.seaway.components, case.speed, ship.gravity)
    weight = ship.water_density * ship.gravity
    loads = []
    for instant, motion in zip(time, displacement, strict=True):
        pose = np.concatenate([[instant, scale], motion])
        water = Surroundings(waves, pose, ship.waterline, weight, case.file.seaway.stretching)
        loads.append(section_loads(water.wet_part_of(panels, case.file.run.pressure_rule), stations))
    return np.array(loads)
