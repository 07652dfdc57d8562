"""What is known of the loads before a run: their slopes at rest, and the linear wave load in time."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from panelsim.conventions import ComplexArray, FloatArray


@dataclass(frozen=True)
class KnownLoads:
    """The linear part of the loads on a batch of ships, of which a scheme may make use.

    `slopes`: by the name of a load its derivatives (6, 12) by displacement and velocity at rest; loads that are
    not named are taken as constant. `encounter` ω_e [rad/s] (M,) and `amplitudes` a X exp(iε) (6, M) [N, N m] for
    each ship: Re Σ a X exp(i(ω_e t + ε)) is the Froude-Krylov and diffraction load on a ship on her
    mean course.
    """

    slopes: Mapping[str, FloatArray]
    encounter: Sequence[FloatArray]
    amplitudes: Sequence[ComplexArray]
