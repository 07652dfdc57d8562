"""The ten-parameter spectrum: sea and swell, each with its own direction and spread."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.direction.spread_spectrum import SpreadSpectrum
from panelsim.seaway.direction.spreading import CosineHalfAngle
from panelsim.seaway.spectra.ochi_hubble import OchiHubble


@dataclass(frozen=True)
class TenParameterSpectrum(DirectionalSpectrum):
    """One or two systems of Ochi and Hubble, each spread over direction, TM 2003-190 (49), (53)–(55).

    Each of the five is a tuple of one value a system: `significant_wave_heights` [m], `peak_periods` [s],
    `shapes` λ, `sea_directions` [rad] (mean direction that the system comes from) and `spreads` P, with
    cos^{2P} of half the angle over the full circle; the printed cut at ±π/2 would lose 18 % at P = 1.

    Raises PanelsimError for lists of other lengths, and for what OchiHubble and CosineHalfAngle refuse.
    """

    significant_wave_heights: tuple[float, ...]
    peak_periods: tuple[float, ...]
    shapes: tuple[float, ...]
    sea_directions: tuple[float, ...]
    spreads: tuple[float, ...]

    def __post_init__(self) -> None:
        systems = len(self.point.significant_wave_heights)
        for name in ("sea_directions", "spreads"):
            values = getattr(self, name)
            if np.shape(values) != (systems,):
                raise PanelsimError(
                    f"The {name} are not one for each system",
                    got=repr(values)[:60],
                    allowed=f"{systems} numbers",
                )
            object.__setattr__(self, name, tuple(values))
        self._systems  # noqa: B018 - built now, so that wrong values are told now

    @cached_property
    def point(self) -> OchiHubble:
        """The six-parameter spectrum, (49)."""
        return OchiHubble(self.significant_wave_heights, self.peak_periods, self.shapes)

    @cached_property
    def _systems(self) -> tuple[SpreadSpectrum, ...]:
        """Each system by itself."""
        columns = (self.significant_wave_heights, self.peak_periods, self.shapes)
        points = (OchiHubble((h,), (t,), (shape,)) for h, t, shape in zip(*columns, strict=True))
        return tuple(
            SpreadSpectrum(point, CosineHalfAngle(spread), direction)
            for point, spread, direction in zip(points, self.spreads, self.sea_directions, strict=True)
        )

    def density(self, omega: ArrayLike, sea_direction: ArrayLike) -> FloatArray:
        """S(ω, ν) [m² s/rad²] at frequencies [rad/s] and directions [rad] that broadcast."""
        return np.sum([system.density(omega, sea_direction) for system in self._systems], axis=0)

    def mean_vector(self, omega: ArrayLike | None = None) -> ComplexArray:
        """∫ S e^{iν} dν / ∫ S dν at frequencies [rad/s], or over all of them; NaN without energy."""
        if omega is None:
            energies = [np.asarray(system.point.moment(0)) for system in self._systems]
        else:
            energies = [system.point.density(omega) for system in self._systems]
        vectors = [s.spreading.mean_cosine * np.exp(1j * s.sea_direction) for s in self._systems]
        total = np.sum(energies, axis=0)
        weighted = np.sum([e * v for e, v in zip(energies, vectors, strict=True)], axis=0)
        return np.where(total > 0.0, weighted / np.where(total > 0.0, total, 1.0), np.nan)
