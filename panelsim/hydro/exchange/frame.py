"""From the axes of another program to ship axes: where its origin lies, which way it points, what turns.

Programs agree on x and y in the calm water surface and z up. They leave open which end of x is the bow, about
which point moments and rotations are taken, and that crests pass the origin of x and y at phase zero.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError

FORWARD = ("+x", "-x")
# Half a turn about z, motions and loads alike.
_HALF_TURN = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])


@dataclass(frozen=True)
class Frame:
    """Axes of another program: x and y on calm water, z up.

    `forward` is "+x" or "-x", the way of the bow; `center_of_gravity` and `moments_about` (3,) [m] are points
    in those axes.
    """

    forward: str
    center_of_gravity: FloatArray
    moments_about: FloatArray

    @classmethod
    def given(
        cls, *, forward: str, center_of_gravity: ArrayLike | None, moments_about: ArrayLike | None
    ) -> "Frame":
        """Check what the caller or the file gave; raises PanelsimError, naming what is missing or odd."""
        if forward not in FORWARD:
            raise PanelsimError("forward is not known", got=repr(forward), allowed=" | ".join(FORWARD))
        return cls(
            forward, _point("center_of_gravity", center_of_gravity), _point("moments_about", moments_about)
        )

    def matrix(self, coefficients: FloatArray) -> FloatArray:
        """Coefficients (..., 6, 6) about `moments_about`, as those about the CG in ship axes.

        With η_p = T η_cg and F_cg = Tᵀ F_p the matrix becomes Tᵀ C T.
        """
        turn = self._motion_at_reference()
        return turn.T @ coefficients @ turn

    def load(self, load: ComplexArray, direction: FloatArray, wavenumber: FloatArray) -> ComplexArray:
        """Loads (W, H, 6), exp(+iωt), as those about the CG in ship axes with the crest at the CG at t = 0.

        `direction` θ (H,) [rad] of travel, from x towards y; `wavenumber` k (W,) [rad/m]. The crest that
        passes the origin passes the CG by k(x cos θ + y sin θ) later.
        """
        x, y, _ = self.center_of_gravity
        delay = wavenumber[:, None] * (x * np.cos(direction) + y * np.sin(direction))
        return (load * np.exp(1j * delay)[..., None]) @ self._motion_at_reference()

    def wave_heading(self, direction: FloatArray) -> FloatArray:
        """Heading β (H,) [rad] of waves that travel towards θ, from x to y; ours counts towards starboard."""
        return -(direction + (np.pi if self.forward == "-x" else 0.0))

    def _motion_at_reference(self) -> FloatArray:
        """T (6, 6): motions of `moments_about` in the file's axes from those of the CG in ship axes."""
        x, y, z = self.moments_about - self.center_of_gravity
        motion = np.eye(6)
        motion[:3, 3:] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
        return motion * _HALF_TURN if self.forward == "-x" else motion


def _point(name: str, value: ArrayLike | None) -> FloatArray:
    if value is None:
        raise PanelsimError(
            f"The file does not say {name}",
            allowed="(x, y, z) [m] in the axes of the file, z from calm water",
            remedy=f"give {name}=(x, y, z)",
        )
    try:
        point = np.array(value, dtype=float)
    except (TypeError, ValueError):
        point = np.empty(0)
    if point.shape != (3,) or not np.isfinite(point).all():
        raise PanelsimError(f"{name} is no point", got=value, allowed="three finite numbers [m]")
    point.setflags(write=False)
    return point
