"""Memory of the radiated waves: the kernel R of the momentum form and the retardation function K = dR/dt.

A hull velocity ν sets water moving with the momentum P = A∞ ν + ∫ R(s) ν(t-s) ds (Cummins 1962). R, not K,
is led to zero at the end of the memory: then ∫K vanishes, ∫R is A(0) - A∞, and a steady velocity leaves a
steady momentum for ever.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, runtime_checkable

import numpy as np
from scipy.interpolate import CubicSpline

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.errors import PanelsimError, require_kind
from panelsim.hydro.arguments import A_DATABASE
from panelsim.hydro.conditioning import pair_scale
from panelsim.hydro.retardation import fourier_integral, tapered_momentum_kernel

# The memory of a frigate of 120 m by 14 m; others go with the square root of length or, if stubby, of beam.
_REFERENCE_LENGTH, _REFERENCE_BEAM = 120.0, 14.0  # m
_REFERENCE_MEMORY = 32.0  # s, half faded at 25 s
_TIME_SAMPLES = 1001
# Ogilvie's relation is averaged where A is neither at its logarithmic start nor at the end of the mesh.
_INFINITE_FITTED_ON = (0.05, 0.8)  # shares of the highest frequency
_REBUILT_WITHIN = 0.03  # of the peak
_ROUGH = 0.1  # change of damping from one frequency to the next that no single hull makes, of its peak


@runtime_checkable
class RadiationCoefficients(Protocol):
    """What memory is made of: a `HydroDatabase`, or the section at a transom.

    `frequencies` (F,) [rad/s] from 0; `added_mass` and `radiation_damping` (F, 6, 6), `added_mass_zero` and
    `added_mass_infinite` (6, 6); `length` of the ship and `half_breadth` [m]; `damping_roughness` as from
    `panelsim.hydro.conditioning`.
    """

    @property
    def frequencies(self) -> FloatArray: ...
    @property
    def added_mass(self) -> FloatArray: ...
    @property
    def radiation_damping(self) -> FloatArray: ...
    @property
    def added_mass_zero(self) -> FloatArray: ...
    @property
    def added_mass_infinite(self) -> FloatArray: ...
    @property
    def length(self) -> float: ...
    @property
    def half_breadth(self) -> float: ...
    @property
    def damping_roughness(self) -> float: ...


@dataclass(frozen=True)
class MemoryFunctions:
    """Kernels of the radiated waves about the centre of gravity, and how good they are.

    `time` (T,) [s] up to the memory length; `momentum_kernel` R (T, 6, 6) [kg/s, kg m/s, kg m2/s], zero
    at both ends. `added_mass_infinite` (6, 6) is the A∞ that belongs to R (Ogilvie 1964): use it, not
    that of the database. Measures (6, 6), over the square root of the peaks of A_ii A_jj
    or B_ii B_jj: `infinite_difference` of A∞ from the one of the database, `normalisation` what
    was added to ∫R, `rebuilt_added_mass` and `rebuilt_damping` the largest errors of A and B made
    again from R.
    """

    time: FloatArray
    momentum_kernel: FloatArray
    added_mass_infinite: FloatArray
    infinite_difference: FloatArray
    normalisation: FloatArray
    rebuilt_added_mass: FloatArray
    rebuilt_damping: FloatArray

    def __post_init__(self) -> None:
        for array in (self.time, self.momentum_kernel, self.added_mass_infinite):
            array.setflags(write=False)

    @property
    def memory_length(self) -> float:
        """Time [s] after which a velocity is forgotten."""
        return float(self.time[-1])

    @cached_property
    def spline(self) -> CubicSpline:
        """R(t), with its exact derivative and integral."""
        return _momentum_spline(self.time, self.momentum_kernel)

    @cached_property
    def retardation(self) -> FloatArray:
        """K(t) = dR/dt (T, 6, 6) [kg/s2, kg m/s2, kg m2/s2]."""
        return self.spline(self.time, 1)


def memory_functions(database: RadiationCoefficients) -> MemoryFunctions:
    """Kernels from the radiation damping of a database, which keeps them as `HydroDatabase.memory`.

    The memory is 32 s for a frigate of 120 m. Raises PanelsimError when A and B made again from R are more
    than 3 % of their peaks away from those of the database, and for what is no database.
    """
    require_kind("database", database, RadiationCoefficients, A_DATABASE)
    frequencies = database.frequencies
    size = max(database.length / _REFERENCE_LENGTH, 2.0 * database.half_breadth / _REFERENCE_BEAM)
    memory_length = _REFERENCE_MEMORY * np.sqrt(size)
    time = np.linspace(0.0, memory_length, _TIME_SAMPLES)
    kernel = tapered_momentum_kernel(frequencies, database.radiation_damping, time)

    share = frequencies / frequencies[-1]
    fitted = (share > _INFINITE_FITTED_ON[0]) & (share < _INFINITE_FITTED_ON[1])
    memory_part = fourier_integral(time, kernel, frequencies).real
    infinite = (database.added_mass - memory_part)[fitted].mean(axis=0)
    # Below the lowest frequency that the memory can tell from rest, A(0) is met by a slow bump in R.
    missing = (
        database.added_mass_zero - infinite - _momentum_spline(time, kernel).integrate(0.0, memory_length)
    )
    kernel += missing * _slow_bump(time)[:, None, None]

    rebuilt = fourier_integral(time, kernel, frequencies)
    added_mass_scale = pair_scale(database.added_mass, database.half_breadth)
    damping_error = frequencies[:, None, None] * rebuilt.imag - database.radiation_damping
    memory = MemoryFunctions(
        time=time,
        momentum_kernel=kernel,
        added_mass_infinite=infinite,
        infinite_difference=(infinite - database.added_mass_infinite) / added_mass_scale,
        normalisation=missing / added_mass_scale,
        rebuilt_added_mass=np.abs(infinite + rebuilt.real - database.added_mass).max(axis=0)
        / added_mass_scale,
        rebuilt_damping=np.abs(damping_error).max(axis=0)
        / pair_scale(database.radiation_damping, database.half_breadth),
    )
    _require_faithful(memory, database.damping_roughness)
    return memory


def _slow_bump(time: FloatArray) -> FloatArray:
    """Quartic [1/s] of unit area over the memory, flat at both ends."""
    share = time / time[-1]
    return 30.0 * (share * (1.0 - share)) ** 2 / time[-1]


def _momentum_spline(time: FloatArray, kernel: FloatArray) -> CubicSpline:
    return CubicSpline(time, kernel, bc_type=("not-a-knot", "clamped"))


def _require_faithful(memory: MemoryFunctions, roughness: float) -> None:
    """Raise PanelsimError, naming every pair of motions, where the kernels do not give A and B back."""
    faults = [
        f"{name} of {DOF_NAMES[i]} from {DOF_NAMES[j]} {100 * error[i, j]:.1f} %"
        for name, error in (("added mass", memory.rebuilt_added_mass), ("damping", memory.rebuilt_damping))
        for i, j in np.argwhere(error > _REBUILT_WITHIN)
    ]
    if not faults:
        return
    remedy = (
        "the damping jumps from one frequency to the next: the frequencies are too far apart, or water is"
        " trapped between two hulls or in a moonpool, and such hulls are not supported"
        if roughness > _ROUGH
        else "the damping has not died at the highest frequency: smaller panels below the water reach higher,"
        " and a file of another program needs higher ones"
    )
    raise PanelsimError(
        "The coefficients made again from the retardation functions are off",
        got=f"{', '.join(faults)} of the peak",
        allowed=f"{100 * _REBUILT_WITHIN:.0f} %",
        remedy=remedy,
    )
