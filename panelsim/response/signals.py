"""What is looked at of a ship that moves in waves: her six motions, or what a point of her does."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from panelsim.conventions import DOF_NAMES, ComplexArray, Dof, FloatArray
from panelsim.seaway.dispersion import wavenumber
from panelsim.ship.points import POINT_UNITS


class Signals(Protocol):
    """Some quantities that are linear in the motions and in the waves."""

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each signal (K,)."""

    @property
    def units(self) -> tuple[str, ...]:
        """Unit of each signal (K,)."""

    @property
    def drift_with(self) -> tuple[Dof | None, ...]:
        """The motion (K,) whose drift, where nothing holds the ship, is in the signal."""

    def of(
        self, motions: ComplexArray, frequency: FloatArray, wave_heading: FloatArray, encounter: FloatArray
    ) -> ComplexArray:
        """Complex amplitudes (..., K) per metre of wave amplitude.

        `motions` (..., 6) [m/m, rad/m]; `frequency` and `encounter` (...) [rad/s]; `wave_heading` (...)
        [rad].
        """


def units_by_signal(signals: Signals, per: str = "") -> str:
    """Each unit, with `per` behind it, and the signals that have it: "m: surge, sway, heave; rad: roll …"."""
    names: dict[str, list[str]] = {}
    for name, unit in zip(signals.names, signals.units, strict=True):
        names.setdefault(unit + per, []).append(name)
    return "; ".join(f"{unit}: {', '.join(of_unit)}" for unit, of_unit in names.items())


@dataclass(frozen=True)
class SixMotions:
    """Surge to yaw at the centre of gravity."""

    names = DOF_NAMES
    units = ("m", "m", "m", "rad", "rad", "rad")
    drift_with: tuple[Dof | None, ...] = (Dof.SURGE, Dof.SWAY, None, None, None, None)

    def of(
        self, motions: ComplexArray, frequency: FloatArray, wave_heading: FloatArray, encounter: FloatArray
    ) -> ComplexArray:
        """The motions as they are."""
        return motions


@dataclass(frozen=True, eq=False)
class PointSignals:
    """Displacement, velocity and acceleration of a point of the ship, and its motion relative to the water.

    `arm` (3,) [m] from the centre of gravity in ship axes. For small angles the displacement is
    (η1, η2, η3) + (η4, η5, η6) × arm in translating earth axes; an accelerometer would also feel gravity.
    The relative motion is the vertical displacement less the elevation of the incident wave at the point
    (TM 2004-041, figure 9): positive where the point rises out of the water. Waves that the ship makes are
    not in it.
    """

    arm: FloatArray
    gravity: float

    names = tuple(POINT_UNITS)
    units = tuple(POINT_UNITS.values())
    drift_with: tuple[Dof | None, ...] = (*2 * (Dof.SURGE, Dof.SWAY, None), *4 * (None,))

    def of(
        self, motions: ComplexArray, frequency: FloatArray, wave_heading: FloatArray, encounter: FloatArray
    ) -> ComplexArray:
        """Complex amplitudes (..., 10) in the order of `names`."""
        x, y, _ = self.arm
        displacement = motions[..., :3] + np.cross(motions[..., 3:], self.arm)
        rate = 1j * encounter[..., None]
        k = wavenumber(frequency, self.gravity)
        wave = np.exp(-1j * k * (x * np.cos(wave_heading) - y * np.sin(wave_heading)))
        relative = displacement[..., 2] - wave
        return np.concatenate(
            [displacement, rate * displacement, rate**2 * displacement, relative[..., None]], axis=-1
        )
