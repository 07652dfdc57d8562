"""A point spectrum that is spread over direction alike at all frequencies."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_angle, require_angles
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum, checked_step
from panelsim.seaway.direction.spreading import Spreading
from panelsim.seaway.spectra.point_spectrum import PointSpectrum


@dataclass(frozen=True)
class SpreadSpectrum(DirectionalSpectrum):
    """S(ω, ν) = S(ω) G(ν − ν̄), TM 2003-190 (50), with the mean direction ν̄ `sea_direction` [rad].

    Raises PanelsimError where a part is of another kind, or the direction is no angle in radians.
    """

    point_spectrum: PointSpectrum
    spreading: Spreading
    sea_direction: float

    def __post_init__(self) -> None:
        for name, kind in (("point_spectrum", PointSpectrum), ("spreading", Spreading)):
            if not isinstance(getattr(self, name), kind):
                got = repr(getattr(self, name))[:60]
                raise PanelsimError(f"{name} is of another kind", got=got, allowed=f"a {kind.__name__}")
        require_angle("sea direction", self.sea_direction)

    @property
    def point(self) -> PointSpectrum:
        """The point spectrum S(ω)."""
        return self.point_spectrum

    def density(self, omega: ArrayLike, sea_direction: ArrayLike) -> FloatArray:
        """S(ω, ν) [m² s/rad²] at frequencies [rad/s] and directions [rad] that broadcast."""
        offset = require_angles("sea direction", sea_direction) - self.sea_direction
        return self.point_spectrum.density(omega) * self.spreading.density(offset)

    def mean_vector(self, omega: ArrayLike | None = None) -> ComplexArray:
        """R e^{iν̄}, the same at every frequency [rad/s]; NaN where there is no energy."""
        vector = self.spreading.mean_cosine * np.exp(1j * self.sea_direction)
        energy = 1.0 if omega is None else self.point_spectrum.density(omega)
        return np.where(np.asarray(energy) > 0.0, vector, np.nan)

    def grid_directions(self, step: float | None) -> FloatArray:
        """Directions ν (D,) [rad, 0 to 2π]: multiples of the step [rad] from the mean direction with G > 0.

        They begin on the left of the mean direction; cos² over ±90° by 20° gives −80° to 80° about it.
        """
        step = checked_step(step)
        if step > 0.5 * self.spreading.half_width * (1 + 1e-9):
            raise PanelsimError(
                "The direction step is too coarse for the spreading: one direction would stand for all",
                got=f"{np.rad2deg(step):.4g}° in ±{np.rad2deg(self.spreading.half_width):.4g}°",
                allowed=f"at most {np.rad2deg(0.5 * self.spreading.half_width):.4g}°",
            )
        # G is zero at the ends of its support.
        last = np.ceil(self.spreading.half_width / step - 1e-9) - 1
        return np.remainder(self.sea_direction + step * np.arange(-last, last + 1), 2 * np.pi)
