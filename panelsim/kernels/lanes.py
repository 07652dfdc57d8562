"""Eight points side by side: cos and exp that the compiler packs into vector registers.

Plain arithmetic and polynomials, no fast-math. Phases are in turns and exponents in powers of two.

Taichi reads the annotations of this module itself: no `from __future__ import annotations`.
"""

from panelsim.kernels import runtime
from panelsim.kernels.tables import LANES

ti = runtime.import_taichi()

Lanes = ti.types.vector(LANES, ti.f64)

# cos(2π r) = s P(s²), s = 1/4 - |r|, for |r| <= 1/2: P interpolates sin(2π s)/s in s² at eight
# Chebyshev points of [0, 1/16]; absolute error below 1e-15.
COS_COEFFICIENTS = (
    6.283185307179585,
    -41.341702240398284,
    81.60524927557977,
    -76.70585968962867,
    42.05868995395094,
    -15.09450614073429,
    3.817365633469135,
    -0.6925067010720717,
)
# 2^f for |f| <= 1/2, interpolated at eleven Chebyshev points; relative error below 1e-15.
EXP2_COEFFICIENTS = (
    1.0,
    0.69314718055995,
    0.24022650695910097,
    0.05550410866444772,
    0.009618129107606888,
    0.0013333558230164974,
    0.0001540353044173605,
    1.5252657260200837e-05,
    1.321544258792169e-06,
    1.0208690299958306e-07,
    7.072585949269223e-09,
)
# Adding 1.5 * 2^52 rounds a small number to an integer and leaves that integer in the lowest bits.
ROUND = 1.5 * 2.0**52
LEAST_EXPONENT = -1000.0  # 2^-1000 is zero here; below -1022 the exponent field would wrap
EXPONENT_BIAS = 1023
MANTISSA_BITS = 52


@ti.func
def cos_of_turns(turns):
    """cos(2π turns) of eight numbers."""
    s = 0.25 - abs(turns - ((turns + ROUND) - ROUND))
    return s * _polynomial(ti.static(COS_COEFFICIENTS), s * s)


@ti.func
def exp2(exponent):
    """2^exponent of eight numbers, zero below 2^-1000."""
    exponent = ti.select(exponent > LEAST_EXPONENT, exponent, LEAST_EXPONENT)
    rounded = exponent + ROUND
    power = _polynomial(ti.static(EXP2_COEFFICIENTS), exponent - (rounded - ROUND))
    return power * ti.bit_cast((ti.bit_cast(rounded, ti.i64) + EXPONENT_BIAS) << MANTISSA_BITS, ti.f64)


@ti.func
def _polynomial(coefficients: ti.template(), x):
    value = x * coefficients[-1] + coefficients[-2]
    for i in ti.static(range(len(coefficients) - 3, -1, -1)):
        value = value * x + coefficients[i]
    return value
