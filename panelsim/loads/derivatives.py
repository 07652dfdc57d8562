"""How buoyancy and wave load answer to small motions about any pose, in any sea."""

import numpy as np

from panelsim.conventions import CUT_RULES, FloatArray
from panelsim.errors import PanelsimError
from panelsim.loads.arguments import instant_arguments
from panelsim.loads.load import Instant
from panelsim.loads.wetted_surface import WettedSurface, method_of_one_call
from panelsim.seaway.seaways import CalmSeaway, Seaway
from panelsim.ship.ship import Ship

CALM_WATER = CalmSeaway()
AT_REST = (0.0,) * 6
# Of the beam for translations [m], of one for angles [rad]. Measured at rest, of the stiffness: off by 3e-8
# with ten times this, from the curvature of the load, by 3e-10 with this, by 2e-9 with a tenth of it.
STEP = 1e-5
SIDES = np.array([1.0, -1.0, 0.5, -0.5])
# A plain central difference D(h) is off by a part of h where the load has a kink: so 2 D(h/2) - D(h). A row
# of vertices that stands off the water by less than a step leaves 4e-6 of the stiffness.
WEIGHTS = np.array([-0.5, 0.5, 2.0, -2.0])


def pressure_stiffness(
    ship: Ship,
    seaway: Seaway = CALM_WATER,
    time: float = 0.0,
    displacement: FloatArray | tuple[float, ...] = AT_REST,
    *,
    speed: float = 0.0,
    stretching: str = "wheeler",
    method: str = "auto",
    rule: str = "vertex+centre",
) -> FloatArray:
    """Stiffness −∂F/∂η (6, 6) of buoyancy and wave load, row a load, column a motion [N/m, N, N m].

    F is the load of `WettedSurface` in translating earth axes with moments conjugate to the
    yaw-pitch-roll angles, at `time` [s] and `displacement` (6,) [m, rad], at a mean `speed` [m/s].
    Weight is not in it and would add nothing: a constant force at the CG. So at rest in calm water this is
    `ship.hydrostatics.stiffness`, which has the weight in it.

    By differences, of which half steps cancel the kink that the load has where panels end at the water:
    there the flare, and so the stiffness, differs from one side to the other, and this is the mean of both.
    Raises PanelsimError for values that are no such numbers, angles beyond a turn, unknown names, and the
    rule "panel", whose load jumps and has no derivative. The waves are summed directly: the small steps would
    show what a grid is off.
    """
    at = instant_arguments(ship, seaway, time, displacement, speed)
    if method == "grid":
        raise PanelsimError("A grid gives no derivative", got=repr(method), allowed="auto | direct | oracle")
    if rule == "panel":
        raise PanelsimError(
            "This rule of the pressure integral gives no derivative", got=rule, allowed=", ".join(CUT_RULES)
        )
    step = STEP * np.array([ship.beam] * 3 + [1.0] * 3)
    moved = (at + SIDES[:, None, None] * np.diag(step)).reshape(-1, 6)
    count = len(moved)
    wetted = WettedSurface(
        ship,
        [seaway.components] * count,
        [speed] * count,
        stretching=stretching,
        method=method_of_one_call(method),
        rule=rule,
    )
    load = wetted.evaluate(Instant(time, 1.0, moved, np.zeros_like(moved))).reshape(len(SIDES), 6, 6)
    slope: FloatArray = np.einsum("s,sml->lm", WEIGHTS, load) / step
    return -slope
