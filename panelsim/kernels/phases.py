"""Wave phases that keep their digits at any time and place.

A wave of 2 rad/s has turned 3e4 times after 1e5 s, and ω t in double precision then carries an error of
2e-11 rad. So rates are kept in turns and in two parts: the product of the leading parts is exact, its
whole turns are dropped, and only the small rest is rounded. What is left is an error of some 1e-15 turns.
"""

import numpy as np

from panelsim.conventions import FloatArray

SPLIT = 2.0**27 + 1.0  # Veltkamp's factor: what remains of a double are its leading 26 bits
TURN = 2.0 * np.pi
TURN_ROUNDING = 2.4492935982947064e-16  # 2π − TURN


def leading_part(value: FloatArray | float) -> FloatArray:
    """The value to its leading 26 bits; what is left over has 26 bits as well."""
    spread = SPLIT * value
    return np.asarray(spread - (spread - value))


def turn_rates(rate: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rates (M,) in rad a unit as turns a unit: the leading 26 bits, and what is to be added to them."""
    leading = leading_part(rate / TURN)
    turn_leading = leading_part(TURN)
    # The first two products are exact, and so is the first difference.
    left = rate - leading * turn_leading - leading * (TURN - turn_leading) - leading * TURN_ROUNDING
    return leading, left / TURN


def turns(coordinate: FloatArray | float, rate: FloatArray) -> FloatArray:
    """Turns of a wave, short of whole ones, at coordinates (P, 1) and rates (M,) in rad a unit: (P, M)."""
    leading_rate, small_rate = turn_rates(rate)
    leading = leading_part(coordinate)
    whole = leading * leading_rate
    small = leading * small_rate + (coordinate - leading) * (leading_rate + small_rate)
    return (whole - np.rint(whole)) + small
