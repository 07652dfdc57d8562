"""Spreading functions G: how the energy of a short-crested sea is spread about its mean direction."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import beta

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import require_positive

_ROUNDING = 1e-14  # rad, of angles of some turns


class Spreading(ABC):
    """A spreading function of area 1 over the circle, symmetric about the mean direction."""

    @property
    @abstractmethod
    def half_width(self) -> float:
        """Largest offset [rad] from the mean direction that has energy; π for the full circle."""

    @abstractmethod
    def density(self, offset: ArrayLike) -> FloatArray:
        """G [1/rad] at offsets [rad] from the mean direction; offsets wrap at ±π."""

    @property
    @abstractmethod
    def mean_cosine(self) -> float:
        """R = ∫ G cos dν, from 0 (all directions alike) to 1 (long-crested)."""

    @property
    def standard_deviation(self) -> float:
        """Circular standard deviation √(2(1 − R)) [rad], as wave buoys and wave models give it."""
        return float(np.sqrt(2 * (1 - self.mean_cosine)))


@dataclass(frozen=True)
class CosineSquared(Spreading):
    """G = cos²(π ν / 2γ_s)/γ_s within ±γ_s [rad], TM 2003-190 (51)(52); π/2 gives (2/π) cos².

    Raises PanelsimError for a spreading angle that is not within 0 to π.
    """

    spreading_angle: float = np.pi / 2

    def __post_init__(self) -> None:
        if require_positive("spreading_angle", self.spreading_angle, "rad") > np.pi:
            raise PanelsimError(
                "The spreading angle is beyond the circle",
                got=f"{self.spreading_angle:g} rad",
                allowed="more than 0, at most π rad",
                remedy="turn degrees into radians, for example np.deg2rad(90)",
            )

    @property
    def half_width(self) -> float:
        """The spreading angle γ_s [rad]."""
        return self.spreading_angle

    def density(self, offset: ArrayLike) -> FloatArray:
        """G [1/rad] at offsets [rad] from the mean direction; offsets wrap at ±π."""
        offset = np.remainder(np.asarray(offset, dtype=float) + np.pi, 2 * np.pi) - np.pi
        inside = np.cos(0.5 * np.pi * offset / self.spreading_angle) ** 2 / self.spreading_angle
        return np.where(np.abs(offset) > self.spreading_angle, 0.0, inside)

    @property
    def mean_cosine(self) -> float:
        """R = π² sin γ_s / (γ_s (π² − γ_s²)), which is 1/2 at γ_s = π."""
        rest = np.pi - self.spreading_angle
        return float(
            np.pi**2 * np.sinc(rest / np.pi) / (self.spreading_angle * (np.pi + self.spreading_angle))
        )


@dataclass(frozen=True)
class CosinePower(Spreading):
    """G = A cosⁿ ν within ±π/2 with its own A = 1/B((n + 1)/2, 1/2).

    The seakeeping workshop, 4.4, prints 2/π for every n; that belongs to n = 2 alone.
    Raises PanelsimError for a power that is not above 0.
    """

    power: float

    def __post_init__(self) -> None:
        require_positive("power", self.power, "")

    @property
    def half_width(self) -> float:
        """π/2."""
        return np.pi / 2

    def density(self, offset: ArrayLike) -> FloatArray:
        """G [1/rad] at offsets [rad] from the mean direction; offsets wrap at ±π."""
        cosine = _cosine(np.asarray(offset, dtype=float)).clip(min=0.0)
        return cosine**self.power / float(beta((self.power + 1) / 2, 0.5))

    @property
    def mean_cosine(self) -> float:
        """R = B((n + 2)/2, 1/2) / B((n + 1)/2, 1/2); 8/(3π) for cos²."""
        return float(beta((self.power + 2) / 2, 0.5) / beta((self.power + 1) / 2, 0.5))


@dataclass(frozen=True)
class CosineHalfAngle(Spreading):
    """G = A(s) cos^{2s}(ν/2) over the full circle, TM 2003-190 (53)–(55).

    (53) and (54) are printed with a cut at ±π/2, which A(s) does not normalise: the area would be 0.82 at
    s = 1. A(s) = 2^{2s−1} Γ²(s + 1)/(π Γ(2s + 1)) is 1/(2 B(s + 1/2, 1/2)), which no s overflows.
    Raises PanelsimError for a spread s that is not above 0.
    """

    spread: float

    def __post_init__(self) -> None:
        require_positive("spread", self.spread, "")

    @property
    def half_width(self) -> float:
        """π: the full circle."""
        return np.pi

    def density(self, offset: ArrayLike) -> FloatArray:
        """G [1/rad] at offsets [rad] from the mean direction; offsets wrap at ±π."""
        cosine = np.abs(_cosine(0.5 * np.asarray(offset, dtype=float)))
        return cosine ** (2 * self.spread) / (2 * float(beta(self.spread + 0.5, 0.5)))

    @property
    def mean_cosine(self) -> float:
        """R = s/(s + 1)."""
        return self.spread / (self.spread + 1)


def _cosine(angle: FloatArray) -> FloatArray:
    """The cosine, 0 where it is only the rounding of π/2: a power below 1 would make 1e-8 or more of it."""
    cosine = np.cos(angle)
    return np.where(np.abs(cosine) < _ROUNDING, 0.0, cosine)
