"""Ikeda's components of roll damping: friction, eddies, hull lift and bilge keels.

Each is the linear damping [N m s] that takes the same energy as the real one, in regular rolling of one
frequency and amplitude. The radiated waves are no part of it: they come from the potential flow. Sources:
ITTC 7.5-02-07-04.5 (2011); Y. Himeno, Prediction of ship roll damping, University of Michigan 239 (1981). It
was made for cargo ships; it is not validated here for others.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError, require_kind
from panelsim.hull.appendages import BilgeKeelSegment
from panelsim.hydro.roll_damping.amplitudes import require_amplitudes
from panelsim.hydro.roll_damping.bilge_keels import hull_pressure_damping, normal_force_damping
from panelsim.hydro.roll_damping.eddy import eddy_coefficient
from panelsim.hydro.roll_damping.hull_data import RollingHull
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.seaway.checks import require_number, require_positive

# κ of the lift slope, by midship coefficient: up to 0.92, up to 0.97, above (given up to 0.99).
_LIFT_MIDSHIP = (0.92, 0.97)
_LIFT_KAPPA = (0.0, 0.1, 0.3)
A_ROLLING_HULL = (
    "a RollingHull: particulars and immersed sections; panelsim.rolling_hull(ship)"
    " makes one of a Ship with a table of offsets"
)
# Amplitudes at which terms are fitted: what ships roll, and what the method was measured at.
_FIT_AMPLITUDES = np.deg2rad([2.0, 5.0, 10.0, 15.0, 20.0])


@dataclass(frozen=True, eq=False)
class IkedaDamping:
    """Equivalent linear roll damping by component [N m s], arrays shaped as the roll amplitudes."""

    friction: FloatArray
    eddy: FloatArray
    lift: FloatArray
    bilge_keel: FloatArray

    @property
    def total(self) -> FloatArray:
        """The sum of the components."""
        return self.friction + self.eddy + self.lift + self.bilge_keel


def ikeda_damping(
    hull: RollingHull,
    bilge_keels: tuple[BilgeKeelSegment, ...],
    roll_amplitude: ArrayLike,
    frequency: float,
    speed: float,
) -> IkedaDamping:
    """The components for `roll_amplitude` (...) [rad], roll `frequency` [rad/s] and ship `speed` [m/s].

    `bilge_keels` may be empty. Raises PanelsimError for arguments of another kind, for an amplitude not above
    0, for keels outside the sections, for a negative speed.
    """
    require_kind("hull", hull, RollingHull, A_ROLLING_HULL)
    require_kind("list of bilge keels", bilge_keels, Sequence, "BilgeKeelSegment, none or more")
    for keel in bilge_keels:
        require_kind("bilge keel", keel, BilgeKeelSegment, "a BilgeKeelSegment")
    amplitude = require_amplitudes(roll_amplitude)
    require_positive("The roll frequency", frequency, "rad/s")
    require_number("speed", speed, "m/s", low=0.0)
    return IkedaDamping(
        friction_damping(hull, frequency, speed) * np.ones(amplitude.shape),
        eddy_damping(hull, amplitude, frequency, speed),
        lift_damping(hull, speed) * np.ones(amplitude.shape),
        bilge_keel_damping(hull, bilge_keels, amplitude, frequency),
    )


def ikeda_terms(
    hull: RollingHull, bilge_keels: tuple[BilgeKeelSegment, ...], frequency: float, speed: float
) -> RollDampingTerms:
    """Linear, quadratic and cubic damping nearest to Ikeda's from 2 to 20 degrees, arguments as above.

    `frequency` is that of the natural roll, as a rule: the components vary little about it.
    """
    damping = ikeda_damping(hull, bilge_keels, _FIT_AMPLITUDES, frequency, speed)
    return RollDampingTerms.fitted(_FIT_AMPLITUDES, damping.total, frequency)


def friction_damping(hull: RollingHull, frequency: float, speed: float) -> float:
    """Friction of the hull [N m s], laminar, whatever the amplitude (Kato 1957; ITTC 2.2.3).

    With speed it grows by Tamiya's 1 + 4.1 U/(ω L). On a ship it is a few percent of the whole, so
    turbulence, which may double it, is left out. The exponent of the friction coefficient
    is -1/2; STAB 2009 prints +1/2.
    """
    depth, beam, full = hull.draft, hull.beam, hull.block_coefficient
    girth = 1.7 * depth + full * beam
    radius = ((0.887 + 0.145 * full) * girth - 2.0 * hull.axis_depth) / np.pi
    wetted = hull.length_pp * (1.75 * depth + full * beam)
    # C_f φ_a, in which the amplitude cancels.
    reynolds = 3.22 * radius**2 * frequency / (2.0 * np.pi * hull.kinematic_viscosity)
    friction = 1.328 / np.sqrt(reynolds)
    at_rest = 4.0 / (3.0 * np.pi) * hull.water_density * wetted * radius**3 * frequency * friction
    return float(at_rest * (1.0 + 4.1 * speed / (frequency * hull.length_pp)))


def eddy_damping(hull: RollingHull, roll_amplitude: ArrayLike, frequency: float, speed: float) -> FloatArray:
    """Eddies shed by the naked hull [N m s], for `roll_amplitude` (...) [rad] (ITTC 2.2.4).

    In proportion to amplitude and frequency; speed sweeps them away by (0.04 ω L)²/((0.04 ω L)² + U²).
    """
    sections = hull.sections
    moment = sections.draft**4 * eddy_coefficient(
        sections.beam, sections.draft, sections.coefficient, hull.axis_depth
    )
    strength = 4.0 / (3.0 * np.pi) * hull.water_density * np.trapezoid(moment, sections.x)
    swept = (0.04 * frequency * hull.length_pp) ** 2
    return require_amplitudes(roll_amplitude) * float(strength * frequency * swept / (swept + speed**2))


def lift_damping(hull: RollingHull, speed: float) -> float:
    """Lift of the hull as it rolls under way [N m s], in proportion to `speed` [m/s] (ITTC 2.2.2)."""
    d, axis = hull.draft, hull.axis_depth
    kappa = _LIFT_KAPPA[np.searchsorted(_LIFT_MIDSHIP, hull.midship_coefficient)]
    slope = 2.0 * np.pi * d / hull.length_pp + kappa * (4.1 * hull.beam / hull.length_pp - 0.045)
    flow_lever, force_lever = 0.3 * d, 0.5 * d
    levers = flow_lever * force_lever - 1.4 * axis * flow_lever + 0.7 * axis**2
    return float(0.5 * hull.water_density * hull.length_pp * d * speed * slope * levers)


def bilge_keel_damping(
    hull: RollingHull,
    bilge_keels: tuple[BilgeKeelSegment, ...],
    roll_amplitude: ArrayLike,
    frequency: float,
) -> FloatArray:
    """Bilge keels [N m s]: force on the keels and the pressure that they raise on the hull, at any speed.

    Each segment takes the hull section at its middle. ITTC 2.2.5.1; the small lift of the keels at speed and
    the waves that they make are left out.
    """
    amplitude = require_amplitudes(roll_amplitude)
    if not bilge_keels:
        return np.zeros(amplitude.shape)
    ends = np.array([[keel.x_forward, keel.x_aft] for keel in bilge_keels])
    x, reach = ends.mean(axis=1), hull.sections.x[[0, -1]]
    if np.any(x < reach[0]) or np.any(x > reach[1]):
        raise PanelsimError(
            "A bilge keel lies beyond the immersed sections",
            got=f"x {x.min():g} to {x.max():g} m",
            allowed=f"{reach[0]:g} to {reach[1]:g} m from midships",
        )
    span = np.array([keel.span for keel in bilge_keels])
    lever = np.array([np.hypot(keel.y, keel.z - hull.center_of_gravity_height) for keel in bilge_keels])
    beam, draft, area = (
        np.interp(x, hull.sections.x, values)
        for values in (hull.sections.beam, hull.sections.draft, hull.sections.area)
    )
    sigma = area / (beam * draft)
    swing = amplitude[..., None]
    per_length = normal_force_damping(span, lever, sigma, swing) + hull_pressure_damping(
        span, lever, 0.5 * beam / draft, draft, sigma, hull.axis_depth, swing
    )
    length = ends[:, 0] - ends[:, 1]
    damping: FloatArray = hull.water_density * frequency * (per_length @ length)
    return damping
