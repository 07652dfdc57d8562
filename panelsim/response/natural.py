"""Natural periods and damping ratios of heave, roll and pitch, from the matrices of a ship at rest."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.interpolation import complex_inertia
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.supplementary import Supplementary
from panelsim.response.arguments import require_parts
from panelsim.response.linear_ship import LinearShip
from panelsim.ship.ship import Ship

_MODES = (Dof.HEAVE, Dof.ROLL, Dof.PITCH)
_TOLERANCE = 1e-8  # of the frequency
_LEAST_SHARE = 0.1  # of the kinetic energy that a motion has in its own mode
_MOST_STEPS = 200


@dataclass(frozen=True)
class NaturalMode:
    """A free oscillation: `period` T = 2π/|s| [s] and `damping_ratio` ζ = -Re(s)/|s| of the root s.

    A decay shows the longer `damped_period` 2π/Im(s) [s]. `uncoupled_period` 2π√((I + A)/C) [s] and
    `uncoupled_damping_ratio` B/(2√((I + A) C)) are those of the motion by itself, without the others that
    go with it: WORKSHOP 2.2.
    """

    period: float
    damping_ratio: float
    uncoupled_period: float
    uncoupled_damping_ratio: float

    @property
    def damped_period(self) -> float:
        """Period [s] of the decaying oscillation."""
        return float(self.period / np.sqrt(1.0 - self.damping_ratio**2))


def natural_periods(
    ship: Ship,
    database: HydroDatabase,
    supplementary: Supplementary | None = None,
    roll_damping: RollDampingTerms | None = None,
) -> dict[str, NaturalMode | None]:
    """Natural modes of heave, roll and pitch by name, at rest and for small motions.

    Added mass and damping are those of the mode's own frequency, which is sought until it does not change;
    `roll_damping` counts by its linear term. None where a motion does not oscillate: no stiffness, or too
    much damping. Raises PanelsimError for arguments of another kind and where the search does not settle.
    """
    require_parts(ship, database, supplementary, None)
    if roll_damping is not None and not isinstance(roll_damping, RollDampingTerms):
        raise PanelsimError(
            "The roll damping is of another kind", got=repr(roll_damping)[:60], allowed="RollDampingTerms"
        )
    linear = LinearShip(ship, database, Supplementary() if supplementary is None else supplementary)
    more = 0.0 if roll_damping is None else roll_damping.linear
    return {dof.name.lower(): _mode(linear, dof, more) for dof in _MODES}


def _mode(linear: LinearShip, dof: Dof, roll_damping: float) -> NaturalMode | None:
    stiffness = float(linear.stiffness[dof, dof])
    if stiffness <= 0.0:
        return None
    alone = _frequency_alone(linear, dof)
    mass, damping = _matrices(linear, alone, roll_damping)
    ratio = float(damping[dof, dof] / (2.0 * np.sqrt(mass[dof, dof] * stiffness)))
    omega = alone
    for _ in range(_MOST_STEPS):
        root = _root(linear, dof, omega, roll_damping)
        if root is None:
            return None
        # Half a step: the added mass falls where the frequency rises.
        last, omega = omega, 0.5 * (omega + root.imag)
        if abs(omega - last) < _TOLERANCE * omega:
            size = abs(root)
            return NaturalMode(2.0 * np.pi / size, -root.real / size, 2.0 * np.pi / alone, ratio)
    raise PanelsimError(
        f"The natural frequency of {dof.name.lower()} does not settle",
        got=f"{last:.4g} and {omega:.4g} rad/s in turn",
        remedy="the added mass changes too quickly there: look for irregular frequencies in the database",
    )


def _frequency_alone(linear: LinearShip, dof: Dof) -> float:
    """ω [rad/s] of ω² (I + A(ω)) = C for one motion by itself."""
    inertia, stiffness = float(linear.ship.inertia[dof, dof]), float(linear.stiffness[dof, dof])
    added = linear.database.added_mass[:, dof, dof]

    def surplus(omega: float) -> float:
        mass = inertia + float(complex_inertia(linear.database, np.array([omega]))[0, dof, dof].real)
        return omega**2 * mass - stiffness

    low = np.sqrt(stiffness / (inertia + max(float(added.max()), 0.0)))
    return float(brentq(surplus, 0.5 * low, 2.0 * np.sqrt(stiffness / inertia), rtol=1e-12))


def _matrices(linear: LinearShip, omega: float, roll_damping: float) -> tuple[FloatArray, FloatArray]:
    """Inertia with added mass, and damping, (6, 6) at a frequency [rad/s]."""
    inertia = complex_inertia(linear.database, np.array([omega]))[0]
    damping = -omega * inertia.imag + linear.supplementary.damping_matrix
    damping[Dof.ROLL, Dof.ROLL] += roll_damping
    return linear.ship.inertia + inertia.real, damping


def _root(linear: LinearShip, dof: Dof, omega: float, roll_damping: float) -> complex | None:
    """The root s of the oscillation that is mostly this motion, with the coefficients of ω [rad/s]."""
    mass, damping = _matrices(linear, omega, roll_damping)
    by_mass = np.linalg.solve(mass, np.hstack([-linear.stiffness, -damping]))
    state = np.vstack([np.hstack([np.zeros((6, 6)), np.eye(6)]), by_mass])
    roots, vectors = np.linalg.eig(state)
    oscillating = roots.imag > 1e-3 * omega
    if not oscillating.any():
        return None
    share = _shares(vectors[:6, oscillating], mass)[dof]
    mode = int(np.argmax(share))
    return complex(roots[oscillating][mode]) if share[mode] > _LEAST_SHARE else None


def _shares(shapes: ComplexArray, mass: FloatArray) -> FloatArray:
    """Share (6, N) of each motion in the kinetic energy of the shapes (6, N)."""
    energy = np.abs(shapes) ** 2 * np.diag(mass)[:, None]
    return np.asarray(energy / energy.sum(axis=0))
