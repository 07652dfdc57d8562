"""A spectrum as a ship at speed meets it: over the frequency of encounter, for display.

A ship with a following sea meets up to three wave frequencies at one |ω_e|, and the density is infinite where
the group of the waves keeps up with it. Responses are therefore integrated over the wave frequency.
"""

import numpy as np
from numpy.typing import ArrayLike

from panelsim.conventions import STANDARD_GRAVITY, FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.checks import Number, require_angle, require_numbers, require_positive
from panelsim.seaway.spectra.point_spectrum import PointSpectrum


def encounter_branches(
    encounter_frequency: ArrayLike,
    speed: float,
    wave_heading: float,
    gravity: float = STANDARD_GRAVITY,
) -> FloatArray:
    """Wave frequencies ω (3, ...) [rad/s] that a ship meets at |ω_e| [rad/s], WORKSHOP 5; NaN where none.

    ω_e = ω − τω² with τ = U cos β/g; speed U in m/s, heading β in rad (0 following). The first branch are
    waves up to ω = 1/2τ, whose energy overtakes the ship, and all waves where τ ≤ 0; the second those from
    there to 1/τ, whose crests still overtake it; the third those that the ship overtakes, with ω_e < 0.
    """
    return _branches(_magnitudes(encounter_frequency), _tau(speed, wave_heading, gravity))


def encounter_density(
    spectrum: PointSpectrum,
    encounter_frequency: ArrayLike,
    speed: float,
    wave_heading: float,
    gravity: float = STANDARD_GRAVITY,
) -> FloatArray:
    """Spectral density over |ω_e| [m² s/rad]: the sum of S/|1 − 2ωU cos β/g| over the branches, WORKSHOP 6.

    Printed without the modulus and for one branch. Arguments as in `encounter_branches`; where a table of the
    spectrum ends it counts as zero. It grows without bound towards |ω_e| = g/(4U cos β), the frequency of
    encounter of ω = g/(2U cos β): plots take `encounter_energy`. Raises PanelsimError at that frequency.
    """
    magnitude = _magnitudes(encounter_frequency)
    tau = _tau(speed, wave_heading, gravity)
    if np.any(np.abs(1 - 4 * tau * magnitude) < 8 * np.finfo(float).eps):
        raise PanelsimError(
            "The encounter density is infinite",
            got=f"|ω_e| = g/(4 U cos β) = {0.25 / tau:g} rad/s",
            allowed="other frequencies of encounter",
            remedy="use encounter_energy, which has no singularity",
        )
    omega = _branches(magnitude, tau)
    low, high = spectrum.frequency_range
    met = (omega >= low) & (omega <= high)
    density = np.where(met, spectrum.density(np.where(met, omega, 0.0)), 0.0)
    return np.sum(density / np.where(met, np.abs(1 - 2 * tau * omega), 1.0), axis=0)


def encounter_energy(
    spectrum: PointSpectrum,
    edges: ArrayLike,
    speed: float,
    wave_heading: float,
    gravity: float = STANDARD_GRAVITY,
) -> FloatArray:
    """Energy (N,) [m²] that a ship meets between rising edges (N + 1,) of |ω_e| [rad/s], finite everywhere.

    Exact: the energies of the wave frequencies of each branch, whose sum from 0 to ∞ is m0 at any speed and
    heading. The last edge may be infinite. Arguments as in `encounter_branches`.
    """
    magnitude = require_numbers(edges)
    if magnitude.ndim != 1 or len(magnitude) < 2 or magnitude[0] < 0 or not np.all(np.diff(magnitude) > 0):
        raise PanelsimError(
            "The edges of the bands do not rise from 0 or more, or are fewer than two",
            got=repr(magnitude)[:80],
        )
    tau = _tau(speed, wave_heading, gravity)
    shares = [_share_met(spectrum, edge, tau) for edge in magnitude]
    return spectrum.moment(0) * np.diff(shares)


def _share_met(spectrum: PointSpectrum, magnitude: float, tau: float) -> float:
    """Share of the energy that is met at |ω_e| up to a magnitude [rad/s]."""
    if np.isinf(magnitude):
        return 1.0
    first, second, third = _branches(np.array(magnitude), tau)
    if np.isnan(third):
        return spectrum.energy_between(0.0, float(first))
    share = spectrum.energy_between(0.0, float(third))
    # Waves between the first two branches are met faster than that.
    return share if np.isnan(first) else share - spectrum.energy_between(float(first), float(second))


def _branches(magnitude: FloatArray, tau: float) -> FloatArray:
    inside = 1 - 4 * tau * magnitude
    root = np.sqrt(np.where(inside >= 0, inside, np.nan))
    first = 2 * magnitude / (1 + root)
    if tau < np.finfo(float).tiny:
        none = np.full_like(magnitude, np.nan)
        return np.stack([first, none, none])
    return np.stack([first, (1 + root) / (2 * tau), (1 + np.sqrt(1 + 4 * tau * magnitude)) / (2 * tau)])


def _tau(speed: float, wave_heading: float, gravity: float) -> float:
    """τ = U cos β/g [s/rad]."""
    require_angle("wave heading", wave_heading)
    if not (isinstance(speed, Number) and np.isfinite(speed)):
        raise PanelsimError("The speed is no number", got=repr(speed)[:60], allowed="m/s")
    return float(speed * np.cos(wave_heading) / require_positive("gravity", gravity, "m/s2"))


def _magnitudes(encounter_frequency: ArrayLike) -> FloatArray:
    magnitude = require_numbers(encounter_frequency)
    if np.any(magnitude < 0) or np.any(np.isinf(magnitude)):
        raise PanelsimError(
            "A frequency of encounter |ω_e| is negative or infinite",
            got=f"{magnitude.min():g} to {magnitude.max():g} rad/s",
            allowed="0 or more",
        )
    return magnitude
