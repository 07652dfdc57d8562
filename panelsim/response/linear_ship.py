"""The linear equations of motion of a ship in regular waves, solved wave by wave.

    [-ω_e² M + Z(ω_e, U) + iω_e (B_s + b) + C + C_s] η = F_FK + F_D

with the inertia M, the radiation Z at speed (`radiation_at_speed`), supplementary stiffness C_s and damping
B_s, linear roll damping b, the hydrostatic stiffness C, and Froude-Krylov and diffraction loads per metre of
wave amplitude. ω_e keeps its sign, and nothing is divided by it.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import ComplexArray, Dof, FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.speed_terms import radiation_at_speed
from panelsim.hydro.transom import Transom
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.supplementary import Supplementary
from panelsim.response.scattering import diffraction_loads
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.ship.ship import Ship

# Motions of waves from starboard, of those of the same waves from port.
_MIRRORED = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
_NO_FREQUENCY = 1e-12  # of the wave frequency: rounding of a wave that stands still beside the ship


@dataclass(frozen=True, eq=False)
class MotionsInWaves:
    """Linear motions in M regular waves at S speeds, per metre of wave amplitude, exp(+iω_e t).

    `encounter` ω_e (S, M) [rad/s], signed; `froude_krylov` (M, 6) and `diffraction` (S, M, 6) [N/m, N];
    `transfer` (S, M, 6) [m/m, rad/m], the phase that of a crest at the centre of gravity;
    `per_roll_moment` (S, M, 6) [m/(N m), rad/(N m)] the motions of a roll moment alone.
    """

    frequency: FloatArray
    wave_heading: FloatArray
    encounter: FloatArray
    froude_krylov: ComplexArray
    diffraction: ComplexArray
    transfer: ComplexArray
    per_roll_moment: ComplexArray

    def more_roll_damping(self, speed: int, waves: IntArray | slice, damping: float) -> ComplexArray:
        """Transfer functions (m, 6) in some of the waves, at one of the speeds, with more roll damping.

        `damping` [N m s]. The one more term in the equations adds one multiple of `per_roll_moment`.
        """
        motions = self.transfer[speed, waves]
        unit = self.per_roll_moment[speed, waves]
        rate_damping = 1j * self.encounter[speed, waves] * damping
        moment = -rate_damping * motions[:, Dof.ROLL] / (1.0 + rate_damping * unit[:, Dof.ROLL])
        return np.asarray(motions + moment[:, None] * unit)


@dataclass(frozen=True, eq=False)
class LinearShip:
    """A ship with her coefficients and her supplementary terms; with a `transom`, its end terms too."""

    ship: Ship
    database: HydroDatabase
    supplementary: Supplementary = field(default_factory=Supplementary)
    transom: Transom | None = None

    @property
    def stiffness(self) -> FloatArray:
        """Hydrostatic and supplementary stiffness (6, 6)."""
        return self.ship.hydrostatics.stiffness + self.supplementary.stiffness_matrix

    def impedance(self, encounter: FloatArray, speed: float, roll_damping: float) -> ComplexArray:
        """Load per motion (M, 6, 6) at frequencies of encounter (M,) [rad/s] and a speed [m/s].

        `roll_damping` [N m s] is linear and adds to the supplementary one.
        """
        radiation = radiation_at_speed(self.database, encounter, speed, self.transom).impedance
        damping = self.supplementary.damping_matrix
        damping[Dof.ROLL, Dof.ROLL] += roll_damping
        omega = encounter[:, None, None]
        return np.asarray(radiation - omega**2 * self.ship.inertia + 1j * omega * damping + self.stiffness)

    def in_waves(
        self, frequency: FloatArray, wave_heading: FloatArray, speeds: FloatArray, roll_damping: FloatArray
    ) -> MotionsInWaves:
        """Solve for waves of `frequency` (M,) [rad/s] and `wave_heading` (M,) [rad] at speeds (S,) [m/s].

        `roll_damping` (S,) [N m s], linear, of each speed. A hull that is the same on both sides is solved
        for waves from port only. Raises PanelsimError where nothing holds a ship that keeps up with a wave.
        """
        heading = np.pi - np.mod(np.pi - wave_heading, 2.0 * np.pi)
        mirrored = (heading < 0.0) & self._symmetric
        waves = np.column_stack([frequency, np.where(mirrored, -heading, heading)])
        unique, owner = np.unique(waves, axis=0, return_inverse=True)
        sign = np.where(mirrored[:, None], _MIRRORED, 1.0)
        omega, beta = unique[:, 0].copy(), unique[:, 1].copy()
        froude_krylov = froude_krylov_transfer(
            self.ship, WaveComponents(np.ones(len(omega)), omega, beta, np.zeros(len(omega)))
        )
        diffraction = diffraction_loads(self.database, omega, beta, speeds, self.transom)
        encounter = np.array([encounter_frequency(omega, beta, u, self.ship.gravity) for u in speeds])
        encounter[np.abs(encounter) < _NO_FREQUENCY * omega] = 0.0
        motions, per_moment = np.empty_like(diffraction), np.empty_like(diffraction)
        for i, speed in enumerate(speeds):
            impedance = self.impedance(encounter[i], float(speed), float(roll_damping[i]))
            motions[i], per_moment[i] = _solved(impedance, froude_krylov + diffraction[i])
        return MotionsInWaves(
            frequency,
            wave_heading,
            encounter[:, owner],
            froude_krylov[owner] * sign,
            diffraction[:, owner] * sign,
            motions[:, owner] * sign,
            per_moment[:, owner],
        )

    @property
    def _symmetric(self) -> bool:
        """Whether the coefficients were found on the port half of the hull alone."""
        return bool(self.database.dataset.attrs.get("half_hull", False))


def _solved(impedance: ComplexArray, load: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Motions (M, 6) of the loads (M, 6), and those of a roll moment of 1 N m."""
    moment = np.zeros_like(load)
    moment[:, Dof.ROLL] = 1.0
    singular = (impedance == 0.0).all(axis=2).any(axis=1)
    if singular.any():
        raise _not_held(singular)
    motions = np.linalg.solve(impedance, np.stack([load, moment], axis=2)).astype(np.complex128)
    return motions[..., 0], motions[..., 1]


def _not_held(singular: NDArray[np.bool_]) -> PanelsimError:
    return PanelsimError(
        "A wave stands still beside the ship and pushes her away without end",
        got=f"{singular.sum()} of {len(singular)} waves of encounter frequency 0, and no stiffness in surge"
        " or sway",
        remedy="give supplementary stiffness, or leave these waves out",
    )
