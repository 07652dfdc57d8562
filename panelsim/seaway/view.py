"""A seaway seen from some axes: elevation, potential, velocity and pressure, in time and in frequency.

All of it follows from the potential Φ = Re Σ (i g a/ω) exp(−iθ) exp(kz) of linear waves: TM 2003-190
sections 2.1, 2.3 and 2.4 write the same formulas out for two sets of axes.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.kernels.phases import TURN, turns
from panelsim.kernels.runtime import interrupts_held_back
from panelsim.kernels.tables import WaveTables, require_stretching
from panelsim.kernels.wave_sums_oracle import SURFACE_TOLERANCE
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.coordinates import points, require_number

METHODS = ("auto", "direct", "oracle")
# Points times components above which the compiled sum is worth its start, half a second once a process; it
# is about fifteen times quicker than NumPy then, which needs some 20 ms for as many.
SMALL = 300_000


class SeawayView(ABC):
    """Waves in axes at rest or in steady motion; x and y [m], `z_wl` [m] above calm water, `time` [s].

    Coordinates are scalars or arrays that broadcast. Results have their shape, a NumPy number for scalars;
    vectors have a last axis of three along x, y and z of these axes.

    `stretching` says how waves in time reach up to the surface ζ: "wheeler" takes z_wl − ζ for z_wl with
    ζ the elevation of all waves (TM 2003-190 2.6, 3.1), "none" exp(k min(z_wl, 0)). With Wheeler the
    gradients are the report's kinematics, not the exact derivatives of the stretched potential.
    Above the surface the potential, its derivatives and the pressure are zero (2.1); a nanometre above
    counts as at it.

    Complex amplitudes X (…, M) or (…, 3, M) are of linear theory: no stretching, no second order, zero
    above calm water. Wave by wave the time function is Re X exp(iωt) with ω of `observed_frequency`, which
    is negative for a wave that is overtaken.

    `method` "direct" is the compiled sum, "oracle" its NumPy twin; "auto" takes the twin for small
    calls. They agree to 1e-12 of the sum of all amplitudes up to 1e5 s and beyond.
    """

    components: WaveComponents
    gravity: float
    stretching: str
    method: str

    @property
    @abstractmethod
    def wave_vector(self) -> FloatArray:
        """Horizontal wavenumber vectors (M, 2) [rad/m] in these axes; they point where the waves go."""

    @property
    @abstractmethod
    def observed_frequency(self) -> FloatArray:
        """Signed frequencies (M,) [rad/s] of the waves at a point fixed in these axes."""

    # --- in time ---

    def elevation(self, x: ArrayLike, y: ArrayLike, time: ArrayLike) -> FloatArray:
        """Wave elevation ζ = Σ a cos θ [m] above calm water, (1), (10); of a Stokes wave (8), (17)."""
        shape, rows = points(x, y, 0.0, time)
        none = np.empty((self.components.count, 0), dtype=np.complex128)
        return self._wave_sums(rows, none)[0].reshape(shape)[()]

    def potential(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike) -> FloatArray:
        """Velocity potential Φ = Σ (g a/ω) sin θ exp(kz) [m2/s], (3), (12)."""
        return self._in_time(self._potential, x, y, z_wl, time)

    def potential_gradient(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike) -> FloatArray:
        """∇Φ (…, 3) [m/s], (4)–(6), (13)–(15)."""
        return self._in_time(self._gradient, x, y, z_wl, time)

    def potential_rate(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike) -> FloatArray:
        """∂Φ/∂t [m2/s2] at a point fixed in these axes, (7), (16) with the sign of ω_e.

        In moving axes it is no pressure: see `dynamic_pressure`.
        """
        return self._in_time(self._rate, x, y, z_wl, time)

    def velocity(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike) -> FloatArray:
        """Velocity of the water over the ground (…, 3) [m/s], along these axes: ∇Φ."""
        return self._in_time(self._gradient, x, y, z_wl, time)

    def acceleration(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike) -> FloatArray:
        """Acceleration of the water (…, 3) [m/s2] to first order: ∂/∂t of its velocity at a point at rest."""
        return self._in_time(self._acceleration, x, y, z_wl, time)

    def dynamic_pressure(
        self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike, *, water_density: float
    ) -> FloatArray:
        """Pressure of the waves ρ g Σ a cos θ exp(kz) [Pa], −ρ ∂Φ/∂t at a point at rest.

        In moving axes −ρ(∂/∂t − U ∂/∂x)Φ, of which (16) is only the first term.
        """
        return self._in_time(self._dynamic_pressure(water_density), x, y, z_wl, time)

    def pressure(
        self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike, *, water_density: float
    ) -> FloatArray:
        """Pressure [Pa] above atmospheric: `dynamic_pressure` − ρ g z_wl, zero above the water.

        With Wheeler it is 0 at the surface of linear waves, and −ρ g ½ a² k cos 2θ at that of a Stokes wave,
        whose potential is of first order.
        """
        shape, rows = points(x, y, z_wl, time)
        elevation, wave = self._wave_sums(rows, self._dynamic_pressure(water_density))
        z = rows[:, 2]
        total = np.where(
            z <= elevation + SURFACE_TOLERANCE, wave[:, 0] - water_density * self.gravity * z, 0.0
        )
        return total.reshape(shape)[()]

    # --- in frequency ---

    def complex_elevation(self, x: ArrayLike, y: ArrayLike) -> ComplexArray:
        """Complex amplitudes of the elevation (…, M) [m], (21)."""
        return self._amplitudes(self._amplitude, x, y, 0.0)

    def complex_potential(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike) -> ComplexArray:
        """Complex amplitudes of the potential (…, M) [m2/s], (22)."""
        return self._amplitudes(self._potential, x, y, z_wl)

    def complex_potential_gradient(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike) -> ComplexArray:
        """Complex amplitudes of ∇Φ (…, 3, M) [m/s], (23)–(25)."""
        return self._amplitudes(self._gradient, x, y, z_wl)

    def complex_potential_rate(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike) -> ComplexArray:
        """Complex amplitudes of ∂Φ/∂t in these axes (…, M) [m2/s2], (26) with the sign of ω_e."""
        return self._amplitudes(self._rate, x, y, z_wl)

    def complex_velocity(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike) -> ComplexArray:
        """Complex amplitudes of the velocity of the water (…, 3, M) [m/s]."""
        return self._amplitudes(self._gradient, x, y, z_wl)

    def complex_acceleration(self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike) -> ComplexArray:
        """Complex amplitudes of the acceleration of the water (…, 3, M) [m/s2]."""
        return self._amplitudes(self._acceleration, x, y, z_wl)

    def complex_dynamic_pressure(
        self, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, *, water_density: float
    ) -> ComplexArray:
        """Complex amplitudes of the pressure of the waves (…, M) [Pa]."""
        return self._amplitudes(self._dynamic_pressure(water_density), x, y, z_wl)

    # --- what each wave contributes at the origin, (M, 1) or (M, 3), to Re Σ … exp(−iθ) exp(kz) ---

    @cached_property
    def _wavenumber(self) -> FloatArray:
        return self.components.wavenumber(self.gravity)

    @property
    def _amplitude(self) -> ComplexArray:
        return self.components.amplitude[:, None].astype(np.complex128)

    @cached_property
    def _potential(self) -> ComplexArray:
        return 1j * self.gravity / self.components.frequency[:, None] * self._amplitude

    @cached_property
    def _gradient(self) -> ComplexArray:
        return self._potential * np.column_stack([-1j * self.wave_vector, self._wavenumber])

    @cached_property
    def _rate(self) -> ComplexArray:
        return 1j * self.observed_frequency[:, None] * self._potential

    @cached_property
    def _acceleration(self) -> ComplexArray:
        return 1j * self.components.frequency[:, None] * self._gradient

    def _dynamic_pressure(self, water_density: float) -> ComplexArray:
        require_number("water density", water_density, "kg/m3", low=500.0, high=2000.0)
        return water_density * self.gravity * self._amplitude

    # --- the sums ---

    @cached_property
    def _tables(self) -> WaveTables:
        waves, (along_x, along_y) = self.components, self.wave_vector.T
        return WaveTables(
            waves.amplitude,
            along_x,
            along_y,
            self._wavenumber,
            self.observed_frequency,
            waves.phase,
            second_order=waves.second_order,
        )

    def _in_time(
        self, contributions: ComplexArray, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike, time: ArrayLike
    ) -> FloatArray:
        """A quantity of one or three parts at points and times: (…) or (…, 3)."""
        shape, rows = points(x, y, z_wl, time)
        sums = self._wave_sums(rows, contributions)[1]
        return sums.reshape(shape + _parts(contributions))[()]

    def _wave_sums(self, rows: FloatArray, contributions: ComplexArray) -> tuple[FloatArray, FloatArray]:
        """Elevation (P,) and the quantity (P, Q) at rows (P, 4) of x, y, z, time."""
        sum_waves = _method(self.method, len(rows) * self.components.count)
        return sum_waves(self._tables, rows, contributions, stretching=self.stretching)

    def _amplitudes(
        self, contributions: ComplexArray, x: ArrayLike, y: ArrayLike, z_wl: ArrayLike
    ) -> ComplexArray:
        """Complex amplitudes of a quantity at points: (…, M) or (…, 3, M)."""
        shape, rows = points(x, y, z_wl, 0.0)
        x_of, y_of, z_of, _ = rows.T[:, :, None]
        along_x, along_y = self.wave_vector.T
        turned = turns(x_of, along_x) + turns(y_of, along_y) - turns(1.0, self.components.phase)
        decay = np.exp(self._wavenumber * np.minimum(z_of, 0.0)) * (z_of <= SURFACE_TOLERANCE)
        waves = (decay * np.exp(-1j * TURN * turned))[:, None, :] * contributions.T
        return waves.reshape((*shape, *_parts(contributions), self.components.count))

    def _require_valid(self) -> None:
        if not isinstance(self.components, WaveComponents):
            raise PanelsimError(
                "The components are no WaveComponents",
                got=repr(self.components)[:60],
                remedy="take the components of a seaway: RegularSeaway(…).components",
            )
        require_number("gravity", self.gravity, "m/s2", low=0.1, high=100.0)
        require_stretching(self.stretching)
        if self.method not in METHODS:
            raise PanelsimError("Unknown method", got=self.method, allowed=" | ".join(METHODS))


def _parts(contributions: ComplexArray) -> tuple[int, ...]:
    """Shape of the quantity at one point."""
    return contributions.shape[1:] if contributions.shape[1] > 1 else ()


def _method(name: str, size: int) -> Callable[..., tuple[FloatArray, FloatArray]]:
    """The function that sums; imported here because the kernel starts Taichi."""
    if name == "oracle" or (name == "auto" and size < SMALL):
        from panelsim.kernels.wave_sums_oracle import wave_sums
    else:
        with interrupts_held_back():
            from panelsim.kernels.wave_sums import wave_sums
    return wave_sums
