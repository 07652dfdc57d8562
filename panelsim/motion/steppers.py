"""Steppers: pure functions from one state of motion to the next."""

from collections.abc import Callable
from typing import Any

from panelsim.conventions import FloatArray

# rates(fraction, displacement, velocity): the accelerations (B, 6) at a fraction (0, ½, 1) of the
# coming step, first of what it returns.
Rates = Callable[[float, FloatArray, FloatArray], tuple[FloatArray, Any]]


def rk4_step(
    rates: Rates, first: FloatArray, displacement: FloatArray, velocity: FloatArray, time_step: float
) -> tuple[FloatArray, FloatArray]:
    """One step of the classical fourth-order Runge-Kutta scheme for η̈ = f(t, η, η̇).

    `first` is the acceleration (B, 6) at the start of the step, which the caller has recorded already.
    Returns displacement and velocity (B, 6) at its end.
    """
    half = 0.5 * time_step
    v2 = velocity + half * first
    a2 = rates(0.5, displacement + half * velocity, v2)[0]
    v3 = velocity + half * a2
    a3 = rates(0.5, displacement + half * v2, v3)[0]
    v4 = velocity + time_step * a3
    a4 = rates(1.0, displacement + time_step * v3, v4)[0]
    sixth = time_step / 6.0
    return (
        displacement + sixth * (velocity + 2.0 * v2 + 2.0 * v3 + v4),
        velocity + sixth * (first + 2.0 * a2 + 2.0 * a3 + a4),
    )
