"""The loads of a batch of runs by model, besides radiation."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from panelsim.conventions import ComplexArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.transom import Transom
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.linear_waves import LinearWaveLoad, wave_turning
from panelsim.loads.load import Load
from panelsim.loads.restoring import Restoring
from panelsim.loads.roll_damping import RollDamping
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.weight import Weight
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.motion.known_loads import KnownLoads
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship


class RunLoads(NamedTuple):
    """All loads of a batch of runs but radiation, and what is known of them beforehand."""

    loads: Sequence[Load]
    known: KnownLoads


def run_loads(
    ship: Ship,
    components: Sequence[WaveComponents],
    speeds: Sequence[float],
    *,
    database: HydroDatabase,
    model: str,
    stretching: str,
    pressure_method: str,
    pressure_rule: str,
    supplementary: Supplementary,
    roll_damping: RollDamping | None = None,
    transom: Transom | None = None,
) -> RunLoads:
    """Loads on a ship in one sea at one speed [m/s] for each run of the batch.

    The model "nonlinear" has weight and the pressure over the wetted surface, "linear" restoring and the
    Froude-Krylov load about rest.
    """
    nonlinear = model == "nonlinear"
    incident = [froude_krylov_transfer(ship, sea) for sea in components]
    diffraction = [
        diffraction_load(database, sea.frequency, sea.wave_heading, speed, transom)
        for sea, speed in zip(components, speeds, strict=True)
    ]

    def wave_load(name: str, transfers: Sequence[ComplexArray]) -> LinearWaveLoad:
        return LinearWaveLoad(
            name, transfers, components, speeds, gravity=ship.gravity, follows_ship=nonlinear
        )

    of_hull: list[Load]
    if nonlinear:
        wetted = WettedSurface(
            ship, components, speeds, stretching=stretching, method=pressure_method, rule=pressure_rule
        )
        of_hull = [Weight(ship.mass, ship.gravity), wetted]
    else:
        of_hull = [Restoring(ship.hydrostatics.stiffness), wave_load("froude_krylov", incident)]
    damping = [] if roll_damping is None else [roll_damping]
    by_velocity = np.zeros((6, 6))
    known = KnownLoads(
        slopes={
            of_hull[1 if nonlinear else 0].name: -np.hstack([ship.hydrostatics.stiffness, by_velocity]),
            supplementary.name: -np.hstack([supplementary.stiffness_matrix, supplementary.damping_matrix]),
        }
        | {load.name: load.slope for load in damping},
        turning=[
            wave_turning(sea, speed, gravity=ship.gravity, follows_ship=nonlinear)
            for sea, speed in zip(components, speeds, strict=True)
        ],
        amplitudes=[
            ((first + second) * (sea.amplitude * np.exp(1j * sea.phase))[:, None]).T
            for first, second, sea in zip(incident, diffraction, components, strict=True)
        ],
    )
    return RunLoads([*of_hull, wave_load("diffraction", diffraction), supplementary, *damping], known)
