"""How much a time step of each scheme makes of the linear motions of a ship: whether the scheme is stable."""

import numpy as np
from numpy.polynomial import Polynomial

from panelsim.conventions import FloatArray
from panelsim.loads.radiation import Radiation
from panelsim.motion.adams_bashforth import WEIGHTS
from panelsim.motion.exact import advance, polynomial_inputs
from panelsim.motion.exponential import forward, spread
from panelsim.motion.linear_system import LinearSystem

# exp(z) to the order of the scheme (Hairer and Wanner 1996, IV.2).
_RUNGE_KUTTA_4 = Polynomial([1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0])
# A drift without springs has an eigenvalue of 1 twice; rounding parts the two by its root.
_ROUNDING = 1e-5


def is_stable(
    stepper: str,
    system: LinearSystem,
    residual: FloatArray,
    radiation: Radiation,
    ship: int,
    time_step: float,
) -> bool:
    """Whether no motion of the ship grows by the scheme that does not grow by itself.

    `residual` (6, n) adds to the accelerations by y what the exponential scheme does not advance exactly,
    such as damping at a high roll rate; `radiation` is that of the `ship` (its number in the batch).
    """
    matrix = system.matrix.copy()
    matrix[6:12] += residual
    own = np.linalg.eigvals(matrix)
    if stepper == "rk4":
        step = np.abs(_RUNGE_KUTTA_4(own * time_step))
    elif stepper == "ab3":
        step = np.abs(np.linalg.eigvals(_adams_bashforth(matrix, radiation, ship, time_step)))
    elif residual.any():
        step = np.abs(np.linalg.eigvals(_exponential(system, residual, time_step)))
    else:
        return True
    return bool(step.max() <= np.exp(max(own.real.max(), 0.0) * time_step) + _ROUNDING)


def _adams_bashforth(matrix: FloatArray, radiation: Radiation, ship: int, time_step: float) -> FloatArray:
    """One step of `AdamsBashforth3` from y, and from rates and ν one step and two steps earlier."""
    size = len(matrix)
    y = np.eye(size, size + 36)
    rates, relative = np.eye(12, size + 36, size), np.eye(6, size + 36, size + 12)
    before, long_before = (rates, relative), (np.roll(rates, 18, axis=1), np.roll(relative, 18, axis=1))
    to_relative = np.hstack([radiation.coupling[ship], np.eye(6)])
    now = matrix[:12] @ y, to_relative @ y[:12]
    states = radiation.states
    moved = y[:12] + time_step * (
        WEIGHTS[0] * now[0] + WEIGHTS[1] * before[0] + WEIGHTS[2] * long_before[0]
    )
    inputs = polynomial_inputs(states.transition, states.entrance, time_step, (1, 0, -1))
    memory = advance(states.transition, time_step) @ y[12:size]
    memory += inputs[0] @ to_relative @ moved + inputs[1] @ now[1] + inputs[2] @ before[1]
    return np.concatenate([moved, memory, *now, *before])


def _exponential(system: LinearSystem, residual: FloatArray, time_step: float) -> FloatArray:
    """One step of `Exponential` from y and the last three r, with r = `residual` y, evaluated again."""
    size = len(system.matrix)
    ahead = forward(system, time_step, 2)[: size + 6]
    change = spread(system, time_step, 1)[:size] @ (residual @ ahead[:size] - ahead[size:])
    moved = ahead[:size] + change
    return np.concatenate([moved, residual @ moved, np.eye(12, size + 18, size)])
