"""What every directional spectrum S(ω, ν) is: a density, its mean direction and spread, a grid."""

from abc import ABC, abstractmethod
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.spectra.point_spectrum import PointSpectrum

FINEST_STEP = 1e-3  # rad; a grid over the circle has some 6000 directions then
NO_DIRECTION = 1e-9  # a mean vector this short points nowhere: rounding


class DirectionalSpectrum(ABC):
    """Energy over frequency ω and the compass direction ν that waves come from."""

    @property
    @abstractmethod
    def point(self) -> PointSpectrum:
        """The point spectrum S(ω) = ∫ S(ω, ν) dν."""

    @abstractmethod
    def density(self, omega: ArrayLike, sea_direction: ArrayLike) -> FloatArray:
        """S(ω, ν) [m² s/rad²] at frequencies [rad/s] and directions [rad] that broadcast."""

    @abstractmethod
    def mean_vector(self, omega: ArrayLike | None = None) -> ComplexArray:
        """∫ S e^{iν} dν / ∫ S dν at frequencies [rad/s], or over all of them without `omega`.

        NaN where there is no energy.
        """

    def mean_direction(self, omega: ArrayLike | None = None) -> FloatArray:
        """Mean direction [rad, 0 to 2π] that waves come from, at frequencies [rad/s] or overall.

        NaN where there is no energy, or where directions cancel and none is the mean.
        """
        vector = self.mean_vector(omega)
        return np.where(np.abs(vector) > NO_DIRECTION, np.remainder(np.angle(vector), 2 * np.pi), np.nan)

    def directional_spread(self, omega: ArrayLike | None = None) -> FloatArray:
        """Circular standard deviation √(2(1 − R)) [rad], at frequencies [rad/s] or overall.

        R = |∫ S e^{iν} dν| / ∫ S dν. NaN where there is no energy.
        """
        return np.sqrt(2 * np.maximum(1 - np.abs(self.mean_vector(omega)), 0.0))

    def grid_directions(self, step: float | None) -> FloatArray:
        """Directions ν (D,) [rad] of a grid of that step [rad]: multiples of it from north over the circle.

        Raises PanelsimError where no step is given, or one that does not divide the circle.
        """
        step = checked_step(step)
        count = round(2 * np.pi / step)
        if abs(count * step - 2 * np.pi) > 1e-9:
            raise PanelsimError(
                "The direction step does not divide the circle",
                got=f"{np.rad2deg(step):.6g}°",
                allowed="360° over a whole number",
                remedy=f"take direction_step = 2π/{count}, {360 / count:.6g}°",
            )
        return step * np.arange(count, dtype=float)

    def grid_intervals(self, step: float | None) -> FloatArray:
        """Direction interval Δν (D,) [rad] of each direction of the grid."""
        return np.full(len(self.grid_directions(step)), checked_step(step))


def checked_step(step: object) -> float:
    """A direction step [rad] as a float; raises PanelsimError for one that cannot be used."""
    if isinstance(step, bool) or not isinstance(step, Real) or not FINEST_STEP <= float(step) <= np.pi / 2:
        raise PanelsimError(
            "A short-crested sea needs a direction step in radians",
            got=repr(step)[:60],
            allowed=f"{FINEST_STEP:g} to π/2 rad",
            remedy="give direction_step, for example np.deg2rad(20)",
        )
    return float(step)
