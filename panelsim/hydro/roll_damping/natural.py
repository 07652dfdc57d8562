"""Natural roll of a ship: its frequency, and the inertia that goes with it."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import fixed_point

from panelsim.conventions import Dof
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.interpolation import complex_inertia
from panelsim.ship.ship import Ship


@dataclass(frozen=True)
class NaturalRoll:
    """Small free roll: `frequency` ω0 [rad/s], `inertia` I with the added one [kg m2], `stiffness` [N m]."""

    frequency: float
    inertia: float
    stiffness: float

    @property
    def period(self) -> float:
        """2π/ω0 [s]."""
        return 2.0 * np.pi / self.frequency


def natural_roll(ship: Ship, database: HydroDatabase) -> NaturalRoll:
    """Undamped roll of a ship that is free to sway and yaw, at rest: ω0² = C44/I(ω0).

    I is 1/((M + A(ω))⁻¹)44, so a ship that turns about another axis than that through its centre of gravity
    has the inertia of that axis; forward speed and springs are left out. Raises PanelsimError for a ship that
    does not float upright by itself.
    """
    stiffness = float(ship.hydrostatics.stiffness[Dof.ROLL, Dof.ROLL])
    if not stiffness > 0.0:
        raise PanelsimError(
            "The ship has no natural roll, it does not float upright by itself",
            got=f"a transverse metacentric height of {ship.hydrostatics.gm_transverse:.3g} m",
            allowed="more than 0 m",
        )

    def inertia(frequency: float) -> float:
        added = complex_inertia(database, np.array([frequency])).real[0]
        return 1.0 / float(np.linalg.inv(ship.inertia + added)[Dof.ROLL, Dof.ROLL])

    dry = np.sqrt(stiffness / float(ship.inertia[Dof.ROLL, Dof.ROLL]))
    frequency = float(fixed_point(lambda omega: np.sqrt(stiffness / inertia(float(omega))), dry, xtol=1e-10))
    return NaturalRoll(frequency, inertia(frequency), stiffness)
