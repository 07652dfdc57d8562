"""Where along the hull the nonlinear pressure in regular waves differs from its linear part."""

from dataclasses import dataclass

import numpy as np

from panelsim.case import Case
from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.loads.hull_pressure import hull_pressure
from panelsim.results.harmonics import harmonics
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.seaway.regular import RegularSeaway
from panelsim.studies.run_store import RunStore

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


def excess_load(store: RunStore, case: Case, *, measured: float) -> ExcessLoad:
    """Follow the pressure over a period of a stored run; its harmonics are those of its last seconds `measured`.

    The linear part is that of the first harmonic of the motion with the wave, both a thousandth as large.
    """
    run, wave = store.load(case), case.seaway.components
    omega = float(encounter_frequency(wave.frequency, wave.wave_heading, case.speed, case.ship.gravity)[0])
    found = harmonics(run.time, run.displacement, omega, after=run.time[-1] - measured)
    x = case.ship.vertices[:, 0]
    room = 1e-6 * np.ptp(x)
    stations = np.linspace(x.min() - room, x.max() + room, SECTIONS + 1)
    time = 2.0 * np.pi / omega / INSTANTS * np.arange(INSTANTS)
    turn = np.exp(1j * omega * time)
    first = (turn[:, None] * found.complex_amplitude[0]).real
    powers = turn[:, None] ** np.arange(1, len(found.complex_amplitude) + 1)
    whole = found.mean + (powers @ found.complex_amplitude).real
    loads = [
        2.0
        / INSTANTS
        * np.einsum("t,tsk->sk", turn.conj(), _loads(case, stations, time, motion, scale))
        / scale
        for motion, scale in ((whole, 1.0), (SMALL * first, SMALL))
    ]
    return ExcessLoad(stations, *loads)


def _loads(
    case: Case, stations: FloatArray, time: FloatArray, displacement: FloatArray, scale: float
) -> FloatArray:
    """Pressure loads (T, S, 6) of the sections in waves of `scale` times the height of the case."""
    wave = case.seaway.components
    sea = RegularSeaway(
        scale * float(wave.amplitude[0]),
        float(wave.frequency[0]),
        float(wave.wave_heading[0]),
        second_order=wave.second_order and scale == 1.0,
    )
    return np.array(
        [
            hull_pressure(
                case.ship,
                sea,
                float(instant),
                row,
                speed=case.speed,
                stretching=case.file.seaway.stretching,
                method="oracle",
            ).section_forces(stations)
            for instant, row in zip(time, displacement, strict=True)
        ]
    )
