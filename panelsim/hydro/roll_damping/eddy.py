"""Ikeda's eddy component of roll damping, section by section (Ikeda et al. 1977; Himeno 1981, 4.3)."""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError


def eddy_coefficient(beam: FloatArray, draft: FloatArray, sigma: FloatArray, axis_depth: float) -> FloatArray:
    """C_R (S,) of sections: the eddy moment of a section is C_R ½ρ d⁴ φ̇|φ̇| per metre of length.

    `beam`, `draft` d [m], `sigma` area coefficient, each (S,); `axis_depth` OG of the roll axis below the
    calm water [m]. ITTC 7.5-02-07-04.5, 2.2.4, with the Lewis form of beam, draft and area. Made for
    sections of ordinary ships: broad flat sterns come out too high. Raises PanelsimError for an axis so deep
    that a shallow section lies above it.
    """
    half = 0.5 * beam / draft
    axis = axis_depth / draft
    if np.any(axis >= sigma):
        raise PanelsimError(
            "The roll axis lies too far down for the eddies of a section",
            got=f"{axis_depth:g} m below the water, at a section of draft {draft[axis >= sigma].min():g} m",
            allowed="less than the area of the section over its beam",
            remedy="leave out the shallow sections of the stern",
        )
    bilge = bilge_radius(half, sigma)
    radius, peak_speed = radius_and_peak_speed(beam, half, sigma)
    # Speed at the bilge over the mean speed round the section, both for unit roll rate.
    mean_speed = 2.0 * (draft - axis_depth) * np.sqrt(half * (sigma - axis) / ((1.0 - axis) ** 2 * np.pi))
    gamma = peak_speed / mean_speed
    # The fit of the pressure falls below 0 where the peak speed is below the mean: no eddies are shed there.
    pressure = np.maximum(0.5 * (0.87 * np.exp(-gamma) - 4.0 * np.exp(-0.187 * gamma) + 3.0), 0.0)
    f1 = 0.5 * (1.0 + np.tanh(20.0 * (sigma - 0.7)))
    f2 = 0.5 * (1.0 - np.cos(np.pi * sigma)) - 1.5 * (1.0 - np.exp(-5.0 * (1.0 - sigma))) * (
        np.sin(np.pi * sigma) ** 2
    )
    rounding = f1 * bilge
    levers = (1.0 - rounding) * (1.0 - axis - rounding) + f2 * (half - rounding) ** 2
    coefficient: FloatArray = (radius / draft) ** 2 * pressure * levers
    return coefficient


def bilge_radius(half: FloatArray, sigma: FloatArray) -> FloatArray:
    """Bilge radius over draft, from the area that a round bilge takes off the corner of a box.

    `half` H0 half-beam over draft, `sigma` area coefficient, each (...); no more than draft or half-beam.
    """
    radius = 2.0 * np.sqrt(half * (1.0 - sigma) / (4.0 - np.pi))
    return np.minimum(radius, np.minimum(1.0, half))


def lewis_parameters(half: FloatArray, sigma: FloatArray) -> tuple[FloatArray, FloatArray]:
    """a1 and a3 (...) of the Lewis form with half-beam over draft `half` and area coefficient `sigma`."""
    ratio = (half - 1.0) / (half + 1.0)
    fullness = 4.0 * sigma / np.pi
    c = 3.0 + fullness + (1.0 - fullness) * ratio**2
    a3 = (3.0 - c + np.sqrt(9.0 - 2.0 * c)) / c
    return (1.0 + a3) * ratio, a3


def radius_and_peak_speed(
    beam: FloatArray, half: FloatArray, sigma: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Greatest radius r_max [m] of the Lewis form, and f3 (r_max + 2M/H √(A² + B²)) there, each (S,)."""
    a1, a3 = lewis_parameters(half, sigma)
    scale = beam / (2.0 * (1.0 + a1 + a3))
    # The bilge, where the radius is greatest; a V-shaped section (a3 above 0) has none: it sheds at the keel.
    cosine = np.divide(a1 * (1.0 + a3), 4.0 * a3, out=np.ones_like(a3), where=a3 != 0.0)
    angle = 0.5 * np.arccos(np.clip(cosine, -1.0, 1.0))
    angle = np.where(_radius(a1, a3, 0.0 * angle) >= _radius(a1, a3, angle), 0.0, angle)
    radius = scale * _radius(a1, a3, angle)
    jacobian = (
        1.0
        + a1**2
        + 9.0 * a3**2
        + 2.0 * a1 * (1.0 - 3.0 * a3) * np.cos(2.0 * angle)
        - 6.0 * a3 * np.cos(4.0 * angle)
    )
    even = (6.0 - 3.0 * a1) * a3**2 + (a1**2 - 3.0 * a1) * a3 + a1**2
    odd = (6.0 + 3.0 * a1) * a3**2 + (3.0 * a1 + a1**2) * a3 + a1**2
    third = a1 * (1.0 - a3)
    a = -2.0 * a3 * np.cos(5.0 * angle) + third * np.cos(3.0 * angle) + even * np.cos(angle)
    b = -2.0 * a3 * np.sin(5.0 * angle) + third * np.sin(3.0 * angle) + odd * np.sin(angle)
    sharp = 1.0 + 4.0 * np.exp(-1.65e5 * (1.0 - sigma) ** 2)
    return radius, sharp * (radius + 2.0 * scale / jacobian * np.hypot(a, b))


def _radius(a1: FloatArray, a3: FloatArray, angle: FloatArray) -> FloatArray:
    """Distance of the Lewis form from the waterline's centre, over its scale; `angle` 0 is the keel."""
    across = (1.0 + a1) * np.sin(angle) - a3 * np.sin(3.0 * angle)
    down = (1.0 - a1) * np.cos(angle) + a3 * np.cos(3.0 * angle)
    distance: FloatArray = np.hypot(across, down)
    return distance
