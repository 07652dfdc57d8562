"""Nonlinear buoyancy and incident-wave load: pressure over the hull that is wet at this instant."""

from collections.abc import Callable, Sequence

import numpy as np

from panelsim.conventions import FloatArray, load_to_earth
from panelsim.errors import PanelsimError
from panelsim.kernels.runtime import interrupts_held_back
from panelsim.kernels.tables import panel_tables, require_rule, wave_tables
from panelsim.loads.load import Instant
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.seaways import Seaway
from panelsim.ship.ship import Ship

METHODS = ("auto", "direct", "oracle")


class WettedSurface:
    """Static and wave pressure integrated over the instantaneous wetted surface, TM 2003-190 section 6.

    Pressure −ρ g z_w + ρ g Σ a cos θ exp(k(z_w − ζ)) where the panel is, panels cut at the water
    surface, ζ with the second order of Stokes waves; force and moment about the CG in ship axes, then
    turned to translating earth axes.
    `method` "direct" is the compiled sum over components, "oracle" its slow NumPy twin; `rule` says where
    the pressure of a panel is taken, "vertex" at its corners, "vertex+centre" at its centre as well.
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
        require_rule(rule)
        self._integrate = _method(method)
        self._panels = panel_tables(ship.vertices, ship.mesh.panels)
        self._seas = [
            wave_tables(
                sea.amplitude,
                sea.wavenumber(ship.gravity),
                sea.wave_heading,
                sea.encounter_frequency(u, ship.gravity),
                sea.phase,
                second_order=sea.second_order,
            )
            for sea, u in zip(components, speed, strict=True)
        ]
        self._ship = ship
        self._stretching = stretching
        self._rule = rule

    def in_ship_axes(self, instant: Instant) -> FloatArray:
        """Force and moment (B, 6) about the CG in ship axes [N, N m]."""
        poses = np.empty((len(self._seas), 8))
        poses[:, 0] = instant.time
        poses[:, 1] = instant.wave_factor
        poses[:, 2:] = instant.displacement
        return np.concatenate(
            [
                self._integrate(
                    self._panels,
                    sea,
                    pose[None],
                    waterline=self._ship.waterline,
                    water_density=self._ship.water_density,
                    gravity=self._ship.gravity,
                    stretching=self._stretching,
                    rule=self._rule,
                )
                for sea, pose in zip(self._seas, poses, strict=True)
            ]
        )

    def evaluate(self, instant: Instant) -> FloatArray:
        """Load (B, 6) in translating earth axes, moments conjugate to the yaw-pitch-roll angles."""
        return load_to_earth(self.in_ship_axes(instant), instant.displacement)


def pressure_force(
    ship: Ship,
    seaway: Seaway,
    time: float,
    displacement: FloatArray,
    *,
    speed: float = 0.0,
    stretching: str = "wheeler",
    method: str = "auto",
) -> FloatArray:
    """Incident-wave and buoyancy force and moment (6,) about the CG, in ship axes [N, N m].

    `time` [s], `displacement` (6,) of the ship in translating earth axes [m, rad], `speed` [m/s].
    `method` "direct" is the compiled direct sum, "oracle" its slow NumPy twin; "auto" chooses.
    Raises PanelsimError for a displacement that is not six finite numbers and for unknown names.
    """
    displacement = np.asarray(displacement, dtype=float)
    if displacement.shape != (6,) or not np.isfinite(displacement).all():
        raise PanelsimError("The displacement is not six finite numbers", got=displacement)
    load = WettedSurface(ship, [seaway.components], [speed], stretching=stretching, method=method)
    return load.in_ship_axes(Instant(time, 1.0, displacement[None], np.zeros((1, 6))))[0]


def _method(name: str) -> Callable[..., FloatArray]:
    """The function that integrates; imported here because the kernel starts Taichi."""
    if name not in METHODS:
        raise PanelsimError("Unknown method", got=name, allowed=" | ".join(METHODS))
    if name == "oracle":
        from panelsim.kernels.oracle import wetted_surface_load
    else:
        with interrupts_held_back():
            from panelsim.kernels.pressure import wetted_surface_load
    return wetted_surface_load
