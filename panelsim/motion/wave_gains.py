"""What known linear waves do in a step of the exponential scheme, exactly, the ramp and its end too."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.motion.equations import ramp_factor
from panelsim.motion.exact import advance, harmonic_inputs, product
from panelsim.motion.known_loads import KnownLoads
from panelsim.motion.linear_system import LinearSystem


@dataclass(frozen=True)
class _Waves:
    """Accelerations by the linear waves on a ship, Re Σ a exp(iφ): a (6, M) [m/s2, rad/s2].

    `turning` (3, M) is what time, surge and sway add to φ [rad/s, rad/m].
    """

    turning: FloatArray
    acceleration: ComplexArray

    def ramped(self, ramp: float) -> "_Waves":
        """The same times ½(1 − cos(π t/ramp)): three waves for each."""
        beat = np.array([[np.pi / ramp], [0.0], [0.0]])
        return _Waves(
            np.concatenate([self.turning, self.turning + beat, self.turning - beat], axis=1),
            np.concatenate([0.5 * self.acceleration, *2 * [-0.25 * self.acceleration]], axis=1),
        )

    def in_step(self, system: LinearSystem, time_step: float) -> tuple[ComplexArray, ComplexArray]:
        """What each does to y (n, M) in a step that it begins with φ = 0, and its acceleration at the end."""
        frequency = self.turning[0]
        moved = harmonic_inputs(system.matrix, system.entrance @ self.acceleration, time_step, frequency)
        return moved, self.acceleration * np.exp(1j * frequency * time_step)

    def in_step_with_end_of_ramp(
        self, system: LinearSystem, time_step: float, grown: ComplexArray, until: float
    ) -> tuple[ComplexArray, ComplexArray]:
        """As `in_step`, but from `until` [s] after the beginning on the accelerations are `grown`."""
        rest, turned = time_step - until, np.exp(1j * self.turning[0] * until)
        growing, _ = self.in_step(system, until)
        after, at_end = _Waves(self.turning, grown * turned).in_step(system, rest)
        return product(advance(system.matrix, rest), growing) + after, at_end


@dataclass(frozen=True)
class _Gains:
    """What waves do in the step that begins at t, for a ship that stays where she is then.

    `table` (n + 30, 2 M) times cos φ and sin φ: their part of y*, of r* (none), of the acceleration at y*,
    and their own acceleration at t, one step and two steps earlier.
    """

    turning: FloatArray
    table: FloatArray

    @classmethod
    def of(
        cls,
        system: LinearSystem,
        waves: _Waves,
        time_step: float,
        in_step: tuple[ComplexArray, ComplexArray] | None = None,
    ) -> "_Gains":
        """Those of waves, with another `in_step` than their own if it is given."""
        moved, later = in_step or waves.in_step(system, time_step)
        turn = np.exp(-1j * waves.turning[0] * time_step)
        past = [waves.acceleration * turn**back for back in range(3)]
        linear = product(system.matrix[6:12], moved) + later
        table = np.concatenate([moved, np.zeros_like(later), linear, *past])
        return cls(waves.turning, np.hstack([table.real, -table.imag]))

    def at(self, time: float, displacement: FloatArray) -> FloatArray:
        """(n + 30,) at a displacement (6,)."""
        phase = time * self.turning[0] + displacement[0] * self.turning[1] + displacement[1] * self.turning[2]
        # Not a matrix product: its bits would depend on the number of threads of the linear algebra.
        total: FloatArray = np.einsum("nm,m->n", self.table, np.concatenate([np.cos(phase), np.sin(phase)]))
        return total


class WaveGains:
    """The waves on each ship of a batch, which grow over `ramp` [s], for steps of one length [s].

    Three tables for each ship: before the end of the ramp, in the step that it falls into, and after it.
    `inverse` (6, 6) is that of M + A∞.
    """

    def __init__(
        self,
        systems: Sequence[LinearSystem],
        known: KnownLoads,
        inverse: FloatArray,
        ramp: float,
        time_step: float,
    ) -> None:
        self._ramp, self._time_step = ramp, time_step
        self._growing: list[_Gains] = []
        self._ending: list[_Gains] = []
        self._grown: list[_Gains] = []
        last = np.arange(int(ramp / time_step) + 2) * time_step
        until = ramp - last[last < ramp].max(initial=0.0)
        for system, turning, amplitudes in zip(systems, known.turning, known.amplitudes, strict=True):
            waves = _Waves(turning, product(inverse, amplitudes))
            self._grown.append(_Gains.of(system, waves, time_step))
            if ramp:
                growing = waves.ramped(ramp)
                self._growing.append(_Gains.of(system, growing, time_step))
                grown = np.concatenate([waves.acceleration, *2 * [0.0 * waves.acceleration]], axis=1)
                ending = growing.in_step_with_end_of_ramp(system, time_step, grown, until)
                self._ending.append(_Gains.of(system, growing, time_step, ending))

    def at(self, step: int, displacement: FloatArray) -> FloatArray:
        """(B, n + 30) of `_Gains` in the step after so many, for ships at displacements (B, 6)."""
        begin, end = step * self._time_step, (step + 1) * self._time_step
        growing = self._growing if end < self._ramp else self._ending
        gains = self._grown if begin >= self._ramp else growing
        waves = np.array([each.at(begin, where) for each, where in zip(gains, displacement, strict=True)])
        if 0.0 <= begin - self._ramp < 2.0 * self._time_step:  # waves that had not yet grown to the end
            for back in (1, 2):
                earlier = max(begin - back * self._time_step, 0.0)
                first = waves.shape[1] - 18 + 6 * back
                waves[:, first : first + 6] *= ramp_factor(earlier, self._ramp)
        return waves
