"""Wave loads that are linear in the waves: a complex amplitude for every component, summed in time."""

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.loads.load import Instant
from panelsim.seaway.components import WaveComponents


class LinearWaveLoad:
    """F(t) = Re Σ a X exp(i(ω_e t + ε)), the load on the ship in its mean position.

    `transfer` X (M, 6) is the load per unit wave amplitude with the time factor exp(+iω_e t),
    its phase referred to a crest at the centre of gravity; ω_e keeps its sign.
    """

    def __init__(
        self, name: str, transfer: ComplexArray, components: WaveComponents, encounter_frequency: FloatArray
    ) -> None:
        self.name = name
        self._encounter_frequency = 1j * np.asarray(encounter_frequency)
        amplitude = components.amplitude * np.exp(1j * components.phase)
        self._amplitude = np.ascontiguousarray((transfer * amplitude[:, None]).T)

    def evaluate(self, instant: Instant) -> FloatArray:
        """Load (6,) in translating earth axes."""
        rotating = np.exp(self._encounter_frequency * instant.time)
        return instant.wave_factor * (self._amplitude @ rotating).real
