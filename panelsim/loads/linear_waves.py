"""Wave loads that are linear in the waves: a complex amplitude for every component, summed in time."""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.loads.load import Instant
from panelsim.seaway.components import WaveComponents


class LinearWaveLoad:
    """F(t) = Re Σ a X exp(i(ω_e t + ε)), the load on each ship of a batch upright on its mean course.

    One of `transfers`, `components` and `speeds` [m/s] for each ship. A transfer X (M, 6) is the load
    per unit wave amplitude with the time factor exp(+iω_e t), its phase referred to a crest at the centre
    of gravity; ω_e keeps its sign.

    With `follows_ship` the phase is that of the waves where the ship is, exp(−i k(η1 cos β − η2 sin β)):
    beside a nonlinear load, which meets the waves there, a phase at the moving origin would be that
    of another sea as soon as the ship has surged or swayed by a part of a wave length.
    """

    def __init__(
        self,
        name: str,
        transfers: Sequence[ComplexArray],
        components: Sequence[WaveComponents],
        speeds: Sequence[float],
        *,
        gravity: float,
        follows_ship: bool,
    ) -> None:
        self.name = name
        ships = [
            _wave_columns(*ship, gravity=gravity, follows_ship=follows_ship)
            for ship in zip(transfers, components, speeds, strict=True)
        ]
        # The waves of all ships in one row, so that seas of unequal length need no filling up.
        counts = [len(turning[0]) for turning, _ in ships]
        self._ship = np.repeat(np.arange(len(ships)), counts)
        self._first_wave = np.cumsum([0, *counts[:-1]])
        self._encounter, self._with_surge, self._with_sway = np.hstack([turning for turning, _ in ships])
        amplitude = np.hstack([amplitude for _, amplitude in ships])
        self._in_phase, self._ahead = amplitude.real.copy(), amplitude.imag.copy()

    def evaluate(self, instant: Instant) -> FloatArray:
        """Load (B, 6) in translating earth axes."""
        surge, sway = instant.displacement.T[:2]
        phase = (
            self._encounter * instant.time
            + self._with_surge * surge[self._ship]
            + self._with_sway * sway[self._ship]
        )
        waves = self._in_phase * np.cos(phase) - self._ahead * np.sin(phase)
        return instant.wave_factor * np.add.reduceat(waves, self._first_wave, axis=1).T


def _wave_columns(
    transfer: ComplexArray, components: WaveComponents, speed: float, *, gravity: float, follows_ship: bool
) -> tuple[FloatArray, ComplexArray]:
    """What time, surge and sway add to the phase of each wave (3, M), and the load amplitudes (6, M)."""
    if not components.count:  # calm water has one wave without a load, since a sum must have a term
        return np.zeros((3, 1)), np.zeros((6, 1), dtype=complex)
    k = components.wavenumber(gravity) * follows_ship
    beta = components.wave_heading
    encounter = components.encounter_frequency(speed, gravity)
    turning = np.array([encounter, -k * np.cos(beta), k * np.sin(beta)])
    return turning, (transfer * (components.amplitude * np.exp(1j * components.phase))[:, None]).T
