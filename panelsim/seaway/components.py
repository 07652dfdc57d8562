"""Wave components: what a seaway is made of, and all that a run needs to know of it."""

from dataclasses import dataclass, field

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.dispersion import encounter_frequency, wavenumber


@dataclass(frozen=True, eq=False)
class WaveComponents:
    """Sinusoidal deep-water waves, each array of shape (M,).

    `amplitude` a [m], `frequency` ω [rad/s], `wave_heading` β [rad] (the direction waves travel
    relative to the ship: 0 following, π/2 from port, π head), `phase` ε [rad], the phase lead
    of the crest at the origin. One component is a cos(k(x cos β − y sin β) − ω_e t − ε),
    TM 2003-190 (10). `second_order` adds the Stokes term ½ a² k cos 2θ to the elevation of a single
    wave, (17); its potential stays that of first order.

    Raises PanelsimError for values that are not finite, frequencies that are not positive, and a
    second order of more than one wave, which would interact.
    """

    amplitude: FloatArray
    frequency: FloatArray
    wave_heading: FloatArray
    phase: FloatArray
    second_order: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        names = ("amplitude", "frequency", "wave_heading", "phase")
        try:
            given = (np.atleast_1d(np.asarray(getattr(self, name), float)) for name in names)
            columns = np.broadcast_arrays(*given)
        except (TypeError, ValueError) as error:
            raise PanelsimError(
                "The wave components are no arrays of numbers of one length", got=str(error)
            ) from None
        for name, column in zip(names, columns, strict=True):
            if column.ndim != 1 or not np.isfinite(column).all():
                raise PanelsimError(
                    f"The wave components' {name} is not a list of finite numbers", got=column
                )
            column = column.copy()
            column.setflags(write=False)
            object.__setattr__(self, name, column)
        if self.count and self.frequency.min() <= 0:
            raise PanelsimError(
                "A wave frequency is not positive",
                got=f"{self.frequency.min():g} rad/s",
                allowed="more than 0",
            )
        if self.second_order and self.count != 1:
            raise PanelsimError(
                "Stokes waves of second order are regular waves",
                got=f"{self.count} components",
                allowed="one component",
            )

    @property
    def count(self) -> int:
        return len(self.amplitude)

    @property
    def variance(self) -> float:
        """Variance of the elevation ½ Σ a² [m²], TM 2003-190 (34)."""
        return float(0.5 * np.sum(self.amplitude**2))

    def wavenumber(self, gravity: float = STANDARD_GRAVITY) -> FloatArray:
        """Wavenumbers (M,) [rad/m]."""
        return wavenumber(self.frequency, gravity)

    def encounter_frequency(self, speed: float, gravity: float = STANDARD_GRAVITY) -> FloatArray:
        """Signed encounter frequencies (M,) [rad/s] at ship speed [m/s]."""
        return encounter_frequency(self.frequency, self.wave_heading, speed, gravity)


NO_WAVES = WaveComponents(np.empty(0), np.empty(0), np.empty(0), np.empty(0))
