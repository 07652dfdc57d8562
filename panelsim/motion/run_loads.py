"""The loads of a batch of runs by model, besides radiation."""

from collections.abc import Sequence

from panelsim.conventions import ComplexArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.linear_waves import LinearWaveLoad
from panelsim.loads.load import Load
from panelsim.loads.restoring import Restoring
from panelsim.loads.supplementary import Supplementary
from panelsim.loads.weight import Weight
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.seaway.components import WaveComponents
from panelsim.ship.ship import Ship


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
) -> list[Load]:
    """Loads on a ship in one sea at one speed [m/s] for each run of the batch.

    The model "nonlinear" has weight and the pressure over the wetted surface, "linear" restoring and the
    Froude-Krylov load about rest.
    """
    nonlinear = model == "nonlinear"
    diffraction = [
        diffraction_load(database, sea.frequency, sea.wave_heading, speed)
        for sea, speed in zip(components, speeds, strict=True)
    ]

    def wave_load(name: str, transfers: Sequence[ComplexArray]) -> LinearWaveLoad:
        return LinearWaveLoad(
            name, transfers, components, speeds, gravity=ship.gravity, follows_ship=nonlinear
        )

    loads: list[Load]
    if nonlinear:
        loads = [
            Weight(ship.mass, ship.gravity),
            WettedSurface(
                ship,
                components,
                speeds,
                stretching=stretching,
                method=pressure_method,
                rule=pressure_rule,
            ),
        ]
    else:
        loads = [
            Restoring(ship.hydrostatics.stiffness),
            wave_load("froude_krylov", [froude_krylov_transfer(ship, sea) for sea in components]),
        ]
    return [*loads, wave_load("diffraction", diffraction), supplementary]
