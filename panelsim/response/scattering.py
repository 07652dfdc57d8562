"""Diffraction loads of many waves at several speeds: what does not depend on speed is found once.

The loads are those of `diffraction_load`. The flow of a wave through the hull knows no speed, and the
potentials enter linearly: so the momentum at every stored frequency is found first, and each speed only
interpolates between those, at its own frequencies of encounter.
"""

import numpy as np

from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import _normal_flow, diffraction_load
from panelsim.hydro.interpolation import at_frequency
from panelsim.hydro.speed_terms import speed_coupling
from panelsim.hydro.transom import Transom
from panelsim.seaway.dispersion import encounter_frequency

_BY_SIDE = ([Dof.SURGE, Dof.HEAVE, Dof.PITCH], [Dof.SWAY, Dof.ROLL, Dof.YAW])
_WAVES_AT_ONCE = 512  # a flow of so many waves through a thousand panels takes 8 MB


def diffraction_loads(
    database: HydroDatabase,
    frequency: FloatArray,
    wave_heading: FloatArray,
    speeds: FloatArray,
    transom: Transom | None = None,
) -> ComplexArray:
    """Diffraction force and moment (S, M, 6) [N, N m] for waves of 1 m at speeds (S,) [m/s].

    All else as in `diffraction_load`, which gives the same for one speed.
    """
    if not database.has_potentials:
        one = [diffraction_load(database, frequency, wave_heading, float(u), transom) for u in speeds]
        return np.array(one)
    loads = np.empty((len(speeds), len(frequency), 6), dtype=complex)
    for start in range(0, len(frequency), _WAVES_AT_ONCE):
        part = slice(start, start + _WAVES_AT_ONCE)
        loads[:, part] = _loads(database, frequency[part], wave_heading[part], speeds, transom)
    return loads


def _loads(
    database: HydroDatabase,
    frequency: FloatArray,
    wave_heading: FloatArray,
    speeds: FloatArray,
    transom: Transom | None,
) -> ComplexArray:
    """(-iω_e + Lᵀ) P_d, less U times the momentum that leaves at a transom."""
    ahead, overtaken = _momentum_at_stored(database, frequency, wave_heading)
    loads = []
    for speed in speeds:
        encounter = encounter_frequency(frequency, wave_heading, speed, database.gravity)
        weights = _weights(database.frequencies, encounter)
        stored = np.where((encounter < 0.0)[:, None, None], overtaken, ahead)
        momentum = np.einsum("mf,mfj->mj", weights, stored)
        load = -1j * encounter[:, None] * momentum + momentum @ speed_coupling(float(speed))
        if transom is not None:
            load = load - speed * transom.momentum(frequency, wave_heading, encounter)
        loads.append(load)
    return np.array(loads)


def _momentum_at_stored(
    database: HydroDatabase, frequency: FloatArray, wave_heading: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """P_d (M, F + 1, 6) with the potentials of each stored frequency, last the infinite, and of minus it."""
    potential = np.concatenate([database.potential, database.potential_infinite[None]])
    flows = _normal_flow(database, frequency, wave_heading)
    shape = (len(frequency), len(potential), 6)
    ahead, overtaken = np.empty((2, *shape), dtype=np.complex128)
    for flow, dofs in zip(flows, _BY_SIDE, strict=True):
        of_side = potential[:, dofs]
        ahead[..., dofs] = np.tensordot(flow, of_side, axes=(1, 2))
        overtaken[..., dofs] = np.tensordot(flow, of_side.conj(), axes=(1, 2))
    ahead *= database.water_density
    overtaken *= database.water_density
    return ahead, overtaken


def _weights(stored: FloatArray, encounter: FloatArray) -> FloatArray:
    """What each stored frequency and the infinite one count (M, F + 1) at frequencies of encounter (M,)."""
    infinite = np.append(np.zeros(len(stored)), 1.0)
    unit = np.eye(len(stored), len(stored) + 1, dtype=np.complex128)
    return at_frequency(stored, unit, infinite, np.abs(encounter)).real
