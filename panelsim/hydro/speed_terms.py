"""Added mass and damping of a ship under way from those at rest, at any frequency of encounter.

Salvesen, Tuck and Faltinsen (1970), for matrices of strip theory or of three dimensions, with the terms of
the transom if asked for. With L35 = +U, L26 = -U (pitch positive bow down), Z = A + B/(iω_e) at rest and Z_T
that of the section at the transom per metre, as the ship's motions feel it, the load of motions η exp(iω_e t)
is

    -[(iω_e - Lᵀ) Z + U Z_T] (iω_e + L) η = -[-ω_e² A(U) + iω_e B(U)] η.

Written out element by element this is their table. In it A(U) is infinite at ω_e = 0, where the load is that
of a stiffness, among it -U² A33 in pitch and the Munk moment -U² A22 in yaw; `radiation_at_speed` keeps it
apart.
"""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.errors import PanelsimError, require_kind
from panelsim.hydro.arguments import A_DATABASE, A_TRANSOM, finite_row, require_speed_ahead
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.interpolation import complex_inertia
from panelsim.hydro.transom import Transom


@dataclass(frozen=True, eq=False)
class RadiationAtSpeed:
    """Radiation load -[-ω_e² A + iω_e B + C] η at M frequencies of encounter, each part finite at ω_e = 0.

    `added_mass` [kg, kg m, kg m2] that of the ship at rest, `damping` [kg/s, ...] and `stiffness` [kg/s2,
    ...] (M, 6, 6), row = force, column = motion, about the centre of gravity; `encounter` ω_e (M,) [rad/s],
    signed.
    """

    encounter: FloatArray
    added_mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray

    def __post_init__(self) -> None:
        for array in (self.encounter, self.added_mass, self.damping, self.stiffness):
            array.setflags(write=False)

    @property
    def impedance(self) -> ComplexArray:
        """-ω_e² A + iω_e B + C (M, 6, 6): minus the load per unit of motion."""
        omega = self.encounter[:, None, None]
        inertial = -(omega**2) * self.added_mass
        return np.asarray(inertial + self.stiffness + 1j * omega * self.damping)


def speed_coupling(speed: float | FloatArray) -> FloatArray:
    """L (6, 6) [m/s]: ν = η̇ + L η is the velocity of the hull relative to the stream.

    For speeds (B,) [m/s] one for each, (B, 6, 6).
    """
    speeds = np.asarray(speed, dtype=float)
    if not (np.isfinite(speeds) & (speeds >= 0.0)).all():
        raise PanelsimError("This is no speed of a ship", got=f"{speed} m/s", allowed="0 m/s or more")
    coupling = np.zeros((*speeds.shape, 6, 6))
    coupling[..., Dof.HEAVE, Dof.PITCH] = speeds
    coupling[..., Dof.SWAY, Dof.YAW] = -speeds
    return coupling


def radiation_at_speed(
    database: HydroDatabase, encounter: FloatArray, speed: float, transom: Transom | None = None
) -> RadiationAtSpeed:
    """Coefficients at signed frequencies of encounter (M,) [rad/s], 0 allowed, and a speed [m/s].

    With a `transom`, its end terms too. Raises PanelsimError for arguments of another kind, a frequency
    that is not finite, a speed that no ship has and the transom of another hull.
    """
    require_kind("database", database, HydroDatabase, A_DATABASE)
    require_kind("transom", transom, Transom | None, A_TRANSOM)
    require_speed_ahead(speed)
    omega = finite_row("frequencies of encounter", encounter, "rad/s")
    coupling = speed_coupling(speed)
    magnitude = np.abs(omega)
    mass, rate = _real_parts(complex_inertia(database, magnitude), magnitude)
    frequency_squared = magnitude[:, None, None] ** 2
    damping = frequency_squared * rate + mass @ coupling - coupling.T @ mass + coupling.T @ rate @ coupling
    stiffness = frequency_squared * (rate @ coupling - coupling.T @ rate) - coupling.T @ mass @ coupling
    if transom is not None:
        transom.require_hull_of(database)
        end_mass, end_rate = _real_parts(transom.inertia(magnitude), magnitude)
        damping = damping + speed * (end_mass - end_rate @ coupling)
        stiffness = stiffness + speed * (frequency_squared * end_rate + end_mass @ coupling)
    return RadiationAtSpeed(omega, mass, damping, stiffness)


def salvesen_tuck_faltinsen(
    database: HydroDatabase, encounter: FloatArray, speed: float, transom: Transom | None = None
) -> tuple[FloatArray, FloatArray]:
    """A(ω_e, U) and B(ω_e, U) (M, 6, 6) as the table has them; arguments as in `radiation_at_speed`.

    Both are even in ω_e. Raises PanelsimError for ω_e = 0 at speed, where the added masses are infinite.
    """
    found = radiation_at_speed(database, encounter, speed, transom)
    if speed > 0.0 and (found.encounter == 0.0).any():
        raise PanelsimError(
            "The added mass of a ship under way is infinite where waves stand still beside her",
            got="a frequency of encounter of 0 rad/s",
            remedy="take radiation_at_speed, in which this part is a stiffness",
        )
    squared = np.where(found.encounter == 0.0, 1.0, found.encounter**2)[:, None, None]
    return found.added_mass - found.stiffness / squared, found.damping


def _real_parts(inertia: ComplexArray, magnitude: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A and B/ω² (M, 6, 6) of A + B/(iω), at ω ≥ 0; B/ω² vanishes at rest as ω."""
    rest = magnitude[:, None, None] == 0.0
    over = -inertia.imag / np.where(rest, 1.0, magnitude[:, None, None])
    return np.ascontiguousarray(inertia.real), np.where(rest, 0.0, over)
