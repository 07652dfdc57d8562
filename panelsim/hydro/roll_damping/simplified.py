"""Ikeda's eddy and bilge-keel components from a few coefficients of the hull (Kawahara, Maekawa, Ikeda 2009).

Y. Kawahara, K. Maekawa, Y. Ikeda, A simple prediction formula of roll damping of conventional cargo ships on
the basis of Ikeda's method and its limitation, STAB 2009: polynomials fitted to the results of the method by
sections, for ships whose sections are not known. They hold inside their ranges only, and refuse outside.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.hydro.roll_damping.amplitudes import require_amplitudes
from panelsim.seaway.checks import require_number

_RANGES = {
    "block_coefficient": (0.5, 0.85),
    "beam_to_draft": (2.5, 4.5),
    "midship_coefficient": (0.9, 0.99),
    "axis_depth_to_draft": (-1.5, 0.2),
}
_KEEL_RANGES = {"keel_span_to_beam": (0.01, 0.06), "keel_length_to_length": (0.05, 0.4)}


@dataclass(frozen=True)
class HullRatios:
    """The shape of a hull in four numbers, each refused outside the range of the formulas.

    `block_coefficient` 0.5 to 0.85, `beam_to_draft` 2.5 to 4.5, `midship_coefficient` 0.9 to 0.99,
    `axis_depth_to_draft` OG/d, the roll axis below the calm water over the draft, -1.5 to 0.2.
    """

    block_coefficient: float
    beam_to_draft: float
    midship_coefficient: float
    axis_depth_to_draft: float

    def __post_init__(self) -> None:
        remedy = "use the method by sections, ikeda_damping"
        for name, (low, high) in _RANGES.items():
            require_number(name, getattr(self, name), "", low=low, high=high, remedy=remedy)


def simplified_eddy(ratios: HullRatios, roll_amplitude: ArrayLike, frequency: float) -> FloatArray:
    """Eddy component at rest, nondimensional: B/(ρ ∇ B²) √(B/2g), STAB 2009 (31).

    `roll_amplitude` (...) [rad]; `frequency` nondimensional, ω √(B/2g), 0 to 1.
    """
    full, wide, mid = ratios.block_coefficient, ratios.beam_to_draft, ratios.midship_coefficient
    axis = ratios.axis_depth_to_draft
    a = (-0.0182 * full + 0.0155) * (wide - 1.8) ** 3
    a += float(np.polyval([-79.414, 215.695, -215.883, 93.894, -14.848], full))
    b1 = (3.98 * full - 5.1525) * (-0.2 * wide + 1.6) * axis
    b1 *= (0.9717 * full**2 - 1.55 * full + 0.723) * axis + 0.04567 * full + 0.9408
    b2 = (0.25 * axis + 0.95) * axis + np.polyval([-219.2, 443.7, -283.3, 59.6], full)
    b3 = (46.5 - 15.0 * wide) * full + 11.2 * wide - 28.6
    coefficient = a * np.exp(b1 + b2 * mid**b3)
    size = 4.0 * _frequency(frequency) * coefficient / (3.0 * np.pi * full * wide**3)
    return require_amplitudes(roll_amplitude) * float(size)


def simplified_bilge_keel(
    ratios: HullRatios,
    keel_span_to_beam: float,
    keel_length_to_length: float,
    roll_amplitude: ArrayLike,
    frequency: float,
) -> FloatArray:
    """Bilge-keel component at rest, nondimensional as above, STAB 2009 (38).

    `keel_span_to_beam` b_BK/B 0.01 to 0.06, `keel_length_to_length` l_BK/L_PP 0.05 to 0.4; `roll_amplitude`
    (...) [rad]; `frequency` ω √(B/2g).
    """
    for name, value in (
        ("keel_span_to_beam", keel_span_to_beam),
        ("keel_length_to_length", keel_length_to_length),
    ):
        low, high = _KEEL_RANGES[name]
        require_number(
            name, value, "", low=low, high=high, remedy="use the method by sections, ikeda_damping"
        )
    full, wide, mid = ratios.block_coefficient, ratios.beam_to_draft, ratios.midship_coefficient
    axis, span, length = ratios.axis_depth_to_draft, keel_span_to_beam, keel_length_to_length
    degrees = np.rad2deg(require_amplitudes(roll_amplitude))
    f1 = (-0.3651 * full + 0.3907) * (wide - 2.83) ** 2 - 2.21 * full + 2.632
    f2 = np.polyval([0.00255, 0.122, 0.4794], degrees)
    f3 = (-0.8913 * span**2 - 0.0733 * span) * length**2
    f3 += (5.2857 * span**2 - 0.01185 * span + 0.00189) * length
    b1 = (5.0 * span + 0.3 * wide - 0.2 * length + np.polyval([0.00125, -0.0425, -1.86], degrees)) * axis
    b2 = -15.0 * span + 1.2 * full - 0.1 * wide + np.polyval([-0.0657, 0.0586, 1.6164], axis)
    b3 = 2.5 * axis + 15.75
    damping: FloatArray = f1 * f2 * f3 * np.exp(b1 + b2 * mid**b3) * _frequency(frequency)
    return damping


def _frequency(frequency: float) -> float:
    require_number("nondimensional roll frequency ω √(B/2g)", frequency, "", low=0.0, high=1.0)
    return float(frequency)
