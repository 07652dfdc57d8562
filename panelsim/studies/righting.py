"""Righting arms of a ship on a frozen wave along the ship, by the pressure of runs or by hydrostatics."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from panelsim.conventions import FloatArray, rotation_to_earth
from panelsim.errors import PanelsimError, require_kind
from panelsim.kernels.runtime import interrupts_held_back
from panelsim.kernels.tables import panel_tables, wave_tables
from panelsim.seaway.checks import require_number, require_positive
from panelsim.seaway.steepness import BREAKING_STEEPNESS
from panelsim.ship.righting_arms import Attitude, RightingArms, curve_of, require_choice_of_trim
from panelsim.ship.ship import Ship, require_ship

PRESSURES = ("wheeler", "hydrostatic")

BALANCE = 1e-10  # of the weight, and of the weight times the ship's length for the moment
STEP = 1e-5  # of the beam for heave [m], of one for trim [rad]
LARGEST_TRIM_STEP = 0.1  # rad
LARGEST_HEAVE_STEP = 0.25  # of the depth of the hull
MOST_STEPS = 60

# Load (B, 6) about the CG in ship axes [N, N m] at displacements (B, 6) of the ship.
Loads = Callable[[FloatArray], FloatArray]
# At rises of the CG [m] and trims [rad] (B, 2), rows (B, 3): what is left of the weight and of the trimming
# moment, as shares of the weight and of weight times length, and the righting arm [m].
Balance = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class FrozenWave:
    """A sinusoidal wave that travels along the ship, stopped at one instant.

    `wave_length` and `wave_height` (crest to trough) [m]; `crest_position`: where the crest is [m], forward
    of the midships of the ship at rest. Raises PanelsimError for a wave steeper than H/λ = 0.142, at which
    waves break, and for values that are no numbers of their kind.
    """

    wave_length: float
    wave_height: float
    crest_position: float = 0.0

    def __post_init__(self) -> None:
        require_positive("wave_length", self.wave_length, "m")
        require_positive("wave_height", self.wave_height, "m")
        require_number(
            "position of the crest",
            self.crest_position,
            "m (a wave length either way)",
            low=-self.wave_length,
            high=self.wave_length,
        )
        steepness = self.wave_height / self.wave_length
        if steepness > BREAKING_STEEPNESS:
            raise PanelsimError(
                "The wave is steeper than waves can be",
                got=f"height {self.wave_height:g} m, length {self.wave_length:g} m, H/λ {steepness:.3f}",
                allowed=f"H/λ at most {BREAKING_STEEPNESS} (breaking)",
                remedy="lower the wave height or take a longer wave",
            )

    @classmethod
    def trough_amidships(cls, wave_length: float, wave_height: float) -> "FrozenWave":
        """The wave whose trough is amidships; lengths in m."""
        return cls(wave_length, wave_height, 0.5 * require_positive("wave_length", wave_length, "m"))

    @property
    def name(self) -> str:
        """Where its crest is, in words."""
        if self.crest_position == 0.0:
            return "crest amidships"
        if abs(self.crest_position) == 0.5 * self.wave_length:
            return "trough amidships"
        side = "forward" if self.crest_position > 0.0 else "aft"
        return f"crest {abs(self.crest_position):g} m {side} of midships"


def righting_arm_in_wave(
    ship: Ship,
    heel: ArrayLike,
    wave: FrozenWave,
    *,
    free_trim: bool = True,
    pressure: str = "wheeler",
) -> RightingArms:
    """Righting arms GZ at heel angles (H,) [rad] on a frozen wave, free to sink and, unless held, to trim.

    The ship is turned by Ry(trim) Rx(heel) about its CG, which stays where it is along the wave. `pressure`
    is that of runs, "wheeler", -ρ g z + ρ g a cos θ exp(k (z - ζ)), TM 2003-190 section 2.6, or
    "hydrostatic", ρ g (ζ - z) below the wave, as rules on stability in waves have it. Arms are moments over
    the weight of the ship. Without `free_trim` the trim stays that of rest. Raises PanelsimError for
    arguments of another kind, heels that are no rising angles, an unknown pressure, and where no balance is
    found.
    """
    require_ship(ship)
    require_kind("wave", wave, FrozenWave, "a FrozenWave, for example FrozenWave(120.0, 4.0)")
    require_choice_of_trim(free_trim)
    if pressure not in PRESSURES:
        raise PanelsimError(
            "The pressure under the wave is not known", got=repr(pressure)[:60], allowed=" | ".join(PRESSURES)
        )
    loads = _loads_in_wave(ship, wave, pressure)
    reach = float(np.linalg.norm(ship.vertices, axis=1).max()) + abs(ship.waterline) + wave.wave_height
    depth = float(np.ptp(ship.vertices[:, 2]))

    def afloat(heel: float) -> Attitude:
        def balance(pose: FloatArray) -> FloatArray:
            return _balance(ship, loads, heel, pose)

        pose = np.array([_float_untrimmed(balance, reach, ship.beam), 0.0])
        if free_trim:
            pose = _settle(balance, pose, np.array([STEP * ship.beam, STEP]), LARGEST_HEAVE_STEP * depth)
        _require_some_of_it_dry(ship, wave, heel, pose)
        return Attitude(float(balance(pose[None])[0, 2]), float(pose[0]), float(pose[1]))

    return curve_of(afloat, heel, wave.name)


def _loads_in_wave(ship: Ship, wave: FrozenWave, pressure: str) -> Loads:
    wavenumber = 2.0 * np.pi / wave.wave_length
    waves = wave_tables(0.5 * wave.wave_height, wavenumber, 0.0, 0.0, wavenumber * _crest(ship, wave))
    if pressure == "hydrostatic":
        # A pressure that does not decay with depth is the static one below the wave.
        waves = replace(waves, wavenumber=np.zeros(1))
    with interrupts_held_back():  # Taichi is imported here
        from panelsim.kernels.pressure import PressureIntegral
    integral = PressureIntegral(
        panel_tables(ship.vertices, ship.mesh.panels),
        [waves],
        waterline=ship.waterline,
        water_density=ship.water_density,
        gravity=ship.gravity,
        method="direct",
    )
    return lambda displacement: integral(np.insert(displacement, 0, [[0.0], [1.0]], axis=1))


def _balance(ship: Ship, loads: Loads, heel: float, pose: FloatArray) -> FloatArray:
    """What `Balance` says, at one heel [rad]."""
    displacement = np.zeros((len(pose), 6))
    displacement[:, [2, 4]], displacement[:, 3] = pose, heel
    load = loads(displacement) / (ship.mass * ship.gravity)
    turn = np.array([rotation_to_earth(heel, trim, 0.0) for trim in pose[:, 1]])
    force, moment = (np.einsum("bij,bj->bi", turn, part) for part in (load[:, :3], load[:, 3:]))
    return np.column_stack([force[:, 2] - 1.0, moment[:, 1] / ship.length, -moment[:, 0]])


def _float_untrimmed(balance: Balance, reach: float, beam: float) -> float:
    """The rise of the CG [m] at which the ship floats without trim; raises PanelsimError where it sinks."""

    def lift(heave: float) -> float:
        return float(balance(np.array([[heave, 0.0]]))[0, 0])

    if lift(-reach) <= 0.0:
        raise _sunk(f"a lift of {1.0 + lift(-reach):.4g} times the weight, wholly under water")
    return float(brentq(lift, -reach, reach, xtol=1e-12 * beam))


def _require_some_of_it_dry(ship: Ship, wave: FrozenWave, heel: float, pose: FloatArray) -> None:
    """Refuse a balance under water: deep down a wave may carry a ship that sinks at its surface."""
    turned = ship.vertices @ rotation_to_earth(heel, float(pose[1]), 0.0).T
    phase = 2.0 * np.pi / wave.wave_length * (turned[:, 0] - _crest(ship, wave))
    surface = ship.waterline + 0.5 * wave.wave_height * np.cos(phase)
    highest = float((turned[:, 2] + pose[0] - surface).max())
    if highest <= 0.0:
        raise _sunk(f"a balance only {-highest:.3g} m under water")


def _sunk(got: str) -> PanelsimError:
    return PanelsimError(
        "The ship sinks on this wave: the water that it can displace weighs too little there",
        got=got,
        remedy="take a lower wave or a lighter ship",
    )


def _crest(ship: Ship, wave: FrozenWave) -> float:
    """Where the crest is, forward of the CG [m]."""
    return float(ship.to_ship_axes(np.array([0.0, 0.0, ship.draft]))[0]) + wave.crest_position


def _settle(balance: Balance, pose: FloatArray, step: FloatArray, heave_limit: float) -> FloatArray:
    """Newton's method for heave [m] and trim [rad] (2,) at a fixed heel."""
    moves = np.array([[0.0, 0.0], [step[0], 0.0], [-step[0], 0.0], [0.0, step[1]], [0.0, -step[1]]])
    limit = np.array([heave_limit, LARGEST_TRIM_STEP])
    for _ in range(MOST_STEPS):
        lack = balance(pose + moves)[:, :2]
        if np.abs(lack[0]).max() <= BALANCE:
            return pose
        rates = np.column_stack([lack[1] - lack[2], lack[3] - lack[4]]) / (2.0 * step)
        if not abs(np.linalg.det(rates)) > 0.0:
            break
        pose = pose + np.clip(np.linalg.solve(rates, -lack[0]), -limit, limit)
    raise PanelsimError(
        "No draft and trim were found at which the ship floats on this wave",
        got=f"in the end heave {pose[0]:.4g} m, trim {np.degrees(pose[1]):.3g} degrees",
        remedy="hold the trim, or take a lower wave",
    )
