"""A seaway seen from translating earth axes, TM 2003-190 section 2.3."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import STRETCHINGS, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.components import WaveComponents


@dataclass(frozen=True)
class TranslatingSeaway:
    """Elevation and pressure in axes that move with the mean speed [m/s] and heading of the ship.

    Coordinates x forward and y to port [m] from the moving origin, z_wl [m] above calm water,
    time [s]; scalars or arrays that broadcast.
    """

    components: WaveComponents
    speed: float
    gravity: float

    def _angles(self, x: ArrayLike, y: ArrayLike, time: ArrayLike) -> FloatArray:
        """Phase angles θ, with the components along a new last axis."""
        c = self.components
        k = c.wavenumber(self.gravity)
        x, y, time = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float), np.asarray(time, float))
        along = x[..., None] * np.cos(c.wave_heading) - y[..., None] * np.sin(c.wave_heading)
        return k * along - c.encounter_frequency(self.speed, self.gravity) * time[..., None] - c.phase

    def elevation(self, x: ArrayLike, y: ArrayLike, time: ArrayLike) -> FloatArray:
        """Wave elevation ζ = Σ a cos θ [m] above calm water, TM 2003-190 (10)."""
        return np.cos(self._angles(x, y, time)) @ self.components.amplitude

    def pressure(
        self,
        x: ArrayLike,
        y: ArrayLike,
        z_wl: ArrayLike,
        time: ArrayLike,
        *,
        water_density: float,
        stretching: str = "wheeler",
    ) -> FloatArray:
        """Pressure [Pa] above atmospheric, static and wave together; zero above the water surface.

        p = −ρ g z_wl + ρ g Σ a cos θ exp(k (z_wl − ζ)) with Wheeler stretching (TM 2003-190 2.6),
        exp(k min(z_wl, 0)) with none. No factor ω_e/ω: −ρ(∂/∂t − U ∂/∂x)Φ is the dynamic pressure,
        of which (16) is only the first term.
        """
        if stretching not in STRETCHINGS:
            raise PanelsimError("Unknown wave stretching", got=stretching, allowed=" | ".join(STRETCHINGS))
        z_wl = np.asarray(z_wl, float)
        wave = np.cos(self._angles(x, y, time)) * self.components.amplitude
        elevation = wave.sum(axis=-1)
        depth = z_wl - elevation if stretching == "wheeler" else np.minimum(z_wl, 0.0)
        k = self.components.wavenumber(self.gravity)
        submerged = z_wl <= elevation
        decay = np.exp(k * np.where(submerged, depth, 0.0)[..., None])
        pressure = water_density * self.gravity * ((wave * decay).sum(axis=-1) - z_wl)
        return np.where(submerged, pressure, 0.0)
