"""Righting arms of a ship in calm water."""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.hull.equilibrium import settle, waterline_of_volume
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.ship.righting_arms import Attitude, RightingArms, curve_of, require_choice_of_trim
from panelsim.ship.ship import Ship, require_ship

CALM = "calm water"


def righting_arm(ship: Ship, heel: ArrayLike, *, free_trim: bool = True) -> RightingArms:
    """Righting arms GZ at heel angles (H,) [rad] in calm water, at constant mass, free to sink and to trim.

    The ship is turned by Ry(trim) Rx(heel) about its CG, in ship axes, as in a run: starboard and bow down
    positive, 0 at rest. The heels reach from -π to π. Buoyancy is exact for the panels, decks
    included, the hull being closed; the draft and trim at each heel leave no force and no trimming moment.
    Without `free_trim` the trim stays that of rest. Raises PanelsimError for arguments of another kind, for
    heels that are no rising angles and where no balance is found.
    """
    require_ship(ship)
    require_choice_of_trim(free_trim)
    mesh = PanelMesh(ship.vertices, ship.mesh.panels)
    volume = ship.mass / ship.water_density
    gravity_center = np.zeros(3)

    def afloat(heel: float) -> Attitude:
        waterline, trim = waterline_of_volume(mesh, volume, heel=heel, trim=0.0), 0.0
        if free_trim:
            waterline, trim, part = settle(mesh, heel, volume, gravity_center, waterline=waterline)
        else:
            part = immersed_part(mesh, heel=heel, trim=trim, waterline=waterline)
        arm = -float(part.volume_moment[1]) / part.volume
        return Attitude(arm, ship.waterline - waterline, trim)

    return curve_of(afloat, heel, CALM)
