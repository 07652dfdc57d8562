"""Wave components: what a seaway is made of, and all that a run needs to know of it."""

from dataclasses import dataclass, field

import numpy as np

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.dispersion import encounter_frequency, wavenumber


@dataclass(frozen=True)
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


def repeat_time(
    components: WaveComponents,
    speed: float,
    duration: float,
    *,
    likeness: float = 0.95,
    gravity: float = STANDARD_GRAVITY,
) -> float | None:
    """First time [s] within the duration after which the ship meets nearly the same waves again.

    The record repeats where its autocorrelation Σ a² cos(ω_e τ) / Σ a², having fallen below one
    half, comes back above `likeness`. A grid of N even frequency steps does so early: the report's
    0.1 rad/s grid after 346 s at 20 knots and 150°. None where it does not within the duration.
    """
    if components.count < 2:
        return None
    omega = components.encounter_frequency(speed, gravity)
    weight = components.amplitude**2 / np.sum(components.amplitude**2)
    # An eighth of a radian of the mean frequency resolves the peaks of the autocorrelation.
    lag = np.arange(0.0, duration, 0.125 / max(np.sqrt(np.sum(weight * omega**2)), 1e-6))
    correlation = np.zeros_like(lag)
    for w, o in zip(weight, omega, strict=True):
        correlation += w * np.cos(o * lag)
    fallen = np.flatnonzero(correlation < 0.5)
    if not fallen.size:
        return None
    again = fallen[0] + np.flatnonzero(correlation[fallen[0] :] > likeness)
    if not again.size:
        return None
    # The top of the first peak, not its flank.
    end = np.flatnonzero(correlation[again[0] :] < likeness)
    stop = again[0] + (end[0] if end.size else 1)
    return float(lag[again[0] + np.argmax(correlation[again[0] : stop])])
