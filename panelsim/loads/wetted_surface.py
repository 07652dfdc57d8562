"""Nonlinear buoyancy and incident-wave load: pressure over the hull that is wet at this instant."""

from collections.abc import Sequence

import numpy as np

from panelsim.conventions import FloatArray, load_to_earth
from panelsim.kernels.runtime import interrupts_held_back
from panelsim.kernels.tables import WaveTables, panel_tables, wave_tables
from panelsim.loads.arguments import instant_arguments
from panelsim.loads.load import Instant
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.seaways import Seaway
from panelsim.ship.ship import Ship


class WettedSurface:
    """Static and wave pressure integrated over the instantaneous wetted surface, TM 2003-190 section 6.

    Pressure −ρ g z_w + ρ g Σ a cos θ exp(k(z_w − ζ)) where the panel is, panels cut at the water
    surface, ζ with the second order of Stokes waves; force and moment about the CG in ship axes, then
    turned to translating earth axes.
    A batch: one ship in several seas or at several speeds [m/s], stepped together; each row is to the bit
    what it would be alone. `method`: "direct" sums the waves at every point of the hull, "grid" takes them
    from a grid that moves with the ship, "oracle" is the slow NumPy twin, "auto" chooses by cost. `rule` says
    where the pressure of a panel is taken: "vertex" at its corners, "vertex+centre" at its centre as well,
    "panel" at the centre for the whole of it. Raises PanelsimError for unknown names and for Stokes waves on
    a grid.
    """

    name = "wetted_surface"

    def __init__(
        self,
        ship: Ship,
        components: Sequence[WaveComponents],
        speed: Sequence[float],
        *,
        stretching: str = "wheeler",
        method: str = "auto",
        rule: str = "vertex+centre",
    ) -> None:
        with interrupts_held_back():  # Taichi is imported here
            from panelsim.kernels.pressure import PressureIntegral
        self._integral = PressureIntegral(
            panel_tables(ship.vertices, ship.mesh.panels),
            [component_tables(sea, u, ship.gravity) for sea, u in zip(components, speed, strict=True)],
            waterline=ship.waterline,
            water_density=ship.water_density,
            gravity=ship.gravity,
            stretching=stretching,
            rule=rule,
            method=method,
        )

    @property
    def methods(self) -> tuple[str, ...]:
        """By which method each sea is evaluated: "direct", "grid" or "oracle"."""
        return self._integral.methods

    def in_ship_axes(self, instant: Instant) -> FloatArray:
        """Force and moment (B, 6) about the CG in ship axes [N, N m]."""
        poses = np.empty((len(instant.displacement), 8))
        poses[:, 0] = instant.time
        poses[:, 1] = instant.wave_factor
        poses[:, 2:] = instant.displacement
        return self._integral(poses)

    def evaluate(self, instant: Instant) -> FloatArray:
        """Load (B, 6) in translating earth axes, moments conjugate to the yaw-pitch-roll angles."""
        return load_to_earth(self.in_ship_axes(instant), instant.displacement)


def component_tables(sea: WaveComponents, speed: float, gravity: float) -> WaveTables:
    """The components of a sea as a ship at `speed` [m/s] meets them, for the kernels."""
    return wave_tables(
        sea.amplitude,
        sea.wavenumber(gravity),
        sea.wave_heading,
        sea.encounter_frequency(speed, gravity),
        sea.phase,
        second_order=sea.second_order,
    )


def pressure_force(
    ship: Ship,
    seaway: Seaway,
    time: float,
    displacement: FloatArray,
    *,
    speed: float = 0.0,
    stretching: str = "wheeler",
    method: str = "auto",
    rule: str = "vertex+centre",
) -> FloatArray:
    """Incident-wave and buoyancy force and moment (6,) about the CG, in ship axes [N, N m].

    `time` [s], `displacement` (6,) of the ship in translating earth axes [m, rad], `speed` [m/s].
    `method`: "direct" sums the waves at every point of the hull, "grid" takes them from a grid that moves
    with the ship, "oracle" is the slow NumPy twin; "auto" is "direct" here, because a grid pays for many
    calls only. `rule`: pressure at the corners of the panels, "vertex", at their centres as well,
    "vertex+centre", or of whole panels at the centre, "panel". Hull and waves are made ready in every call;
    where there are many, a `WettedSurface` does so once. Raises PanelsimError for arguments of another kind,
    angles of more than a turn and unknown names.
    """
    at = instant_arguments(ship, seaway, time, displacement, speed)
    load = WettedSurface(
        ship,
        [seaway.components],
        [speed],
        stretching=stretching,
        method=method_of_one_call(method),
        rule=rule,
    )
    return load.in_ship_axes(Instant(time, 1.0, at[None], np.zeros((1, 6))))[0]


def method_of_one_call(method: str) -> str:
    """A grid costs more to set up than a single call can save."""
    return "direct" if method == "auto" else method
