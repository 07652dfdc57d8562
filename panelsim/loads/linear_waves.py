"""Wave loads that are linear in the waves: a complex amplitude for every component, summed in time."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.loads.load import Instant
from panelsim.seaway.components import WaveComponents


class LinearWaveLoad:
    """F(t) = Re Σ a X exp(i(ω_e t + ε)), the load on the ship upright on its mean course.

    `transfer` X (M, 6) is the load per unit wave amplitude with the time factor exp(+iω_e t),
    its phase referred to a crest at the centre of gravity; ω_e keeps its sign.

    With `follows_ship` the phase is that of the waves where the ship is, exp(−i k(η1 cos β − η2 sin β)):
    beside a nonlinear load, which meets the waves there, a phase at the moving origin would be that
    of another sea as soon as the ship has surged or swayed by a part of a wave length.
    """

    def __init__(
        self,
        name: str,
        transfer: ComplexArray,
        components: WaveComponents,
        *,
        speed: float,
        gravity: float,
        follows_ship: bool,
    ) -> None:
        self.name = name
        encounter = components.encounter_frequency(speed, gravity)
        k = components.wavenumber(gravity) * follows_ship
        beta = components.wave_heading
        # Columns that turn time, surge and sway into the phase of each component.
        self._turning = 1j * np.column_stack([encounter, -k * np.cos(beta), k * np.sin(beta)])
        amplitude = components.amplitude * np.exp(1j * components.phase)
        self._amplitude = np.ascontiguousarray((transfer * amplitude[:, None]).T)

    def evaluate(self, instant: Instant) -> FloatArray:
        """Load (6,) in translating earth axes."""
        surge, sway = instant.displacement[:2]
        rotating = np.exp(self._turning @ np.array([instant.time, surge, sway]))
        return instant.wave_factor * (self._amplitude @ rotating).real
