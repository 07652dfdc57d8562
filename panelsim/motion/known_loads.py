"""What is known of the loads before a run: their slopes at rest, and the linear wave load in time."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from panelsim.conventions import ComplexArray, FloatArray


@dataclass(frozen=True)
class KnownLoads:
    """The linear part of the loads on a batch of ships, of which a scheme may make use.

    `slopes`: by the name of a load its derivatives (6, 12) by displacement and velocity at rest, (B, 6, 12)
    where they differ from ship to ship; loads that are not named are taken as constant. For each ship
    `turning` (3, M), what time, surge and sway add to the phase of each wave [rad/s, rad/m], and `amplitudes`
    a X exp(iε) (6, M) [N, N m], of which the real part is the Froude-Krylov and diffraction load on a ship
    that stands upright where she is.
    """

    slopes: Mapping[str, FloatArray]
    turning: Sequence[FloatArray]
    amplitudes: Sequence[ComplexArray]
