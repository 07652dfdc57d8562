"""Supplementary stiffness and damping, TM 2003-190 section 8: what keeps the ship on its course."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.errors import PanelsimError
from panelsim.loads.load import Instant
from panelsim.ship.ship import Ship


@dataclass(frozen=True)
class Supplementary:
    """Stiffness [N/m, N m/rad] and damping [N/(m/s), N m/(rad/s)] by motion name, added to the ship's own.

    They stand for autopilot and engine (surge, sway, yaw) and for viscous roll damping; a motion
    that is not named has none. The load is −C_s η − B_s η̇.
    """

    stiffness: Mapping[str, float] = field(default_factory=dict)
    damping: Mapping[str, float] = field(default_factory=dict)

    name = "supplementary"

    def __post_init__(self) -> None:
        for kind, values in (("stiffness", self.stiffness), ("damping", self.damping)):
            for motion, value in values.items():
                if motion not in DOF_NAMES:
                    raise PanelsimError(
                        f"Unknown motion in supplementary {kind}", got=motion, allowed=", ".join(DOF_NAMES)
                    )
                if not (np.isfinite(value) and value >= 0):
                    raise PanelsimError(
                        f"Supplementary {kind} in {motion} is negative or not finite",
                        got=value,
                        allowed="0 or more",
                    )
        object.__setattr__(self, "_stiffness", _six(self.stiffness))
        object.__setattr__(self, "_damping", _six(self.damping))

    _stiffness: FloatArray = field(init=False, repr=False, compare=False)
    _damping: FloatArray = field(init=False, repr=False, compare=False)

    @classmethod
    def of(cls, ship: Ship) -> Self:
        """The terms that the particulars of the ship's hull give; none where no hull form is known."""
        return cls() if ship.form is None else cls(**ship.form.supplementary)

    @property
    def stiffness_matrix(self) -> FloatArray:
        """(6, 6)."""
        return np.diag(self._stiffness)

    @property
    def damping_matrix(self) -> FloatArray:
        """(6, 6)."""
        return np.diag(self._damping)

    def evaluate(self, instant: Instant) -> FloatArray:
        """−C_s η − B_s η̇ (B, 6)."""
        return -self._stiffness * instant.displacement - self._damping * instant.velocity


def _six(values: Mapping[str, float]) -> FloatArray:
    return np.array([float(values.get(name, 0.0)) for name in DOF_NAMES])
