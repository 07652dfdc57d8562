"""Ikeda's bilge-keel component of roll damping (Ikeda et al. 1978; ITTC 7.5-02-07-04.5, 2.2.5.1)."""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.hydro.roll_damping.eddy import bilge_radius


def normal_force_damping(
    span: FloatArray, lever: FloatArray, sigma: FloatArray, roll_amplitude: FloatArray
) -> FloatArray:
    """Damping of a pair of keels by the force on the keels, over ρ ω, per metre of length [m4].

    `span` b, `lever` l from the roll axis to the keel [m]; `sigma` area coefficient of the section;
    `roll_amplitude` [rad] above 0. The square of f belongs here: the flow past the bilge is f times l φ̇.
    """
    flow = _flow(sigma)
    drag = 2.4 + _vortex_drag(span, lever, flow, roll_amplitude)
    return 8.0 / (3.0 * np.pi) * lever**3 * span * flow**2 * drag * roll_amplitude


def hull_pressure_damping(
    span: FloatArray,
    lever: FloatArray,
    half: FloatArray,
    draft: FloatArray,
    sigma: FloatArray,
    axis_depth: float,
    roll_amplitude: FloatArray,
) -> FloatArray:
    """Damping of a pair of keels by the pressure that they raise on the hull, over ρ ω, per metre [m4].

    Arguments as for `normal_force_damping`; `half` H0 half-beam over draft, `draft` d of the section
    [m], `axis_depth` OG below the calm water [m]. The integral over the bottom has the cube of m4, as
    its lever and its triangular pressure make it; some prints have the square of m2.
    """
    flow = _flow(sigma)
    bilge = bilge_radius(half, sigma)
    axis = axis_depth / draft
    m3, m4 = 1.0 - bilge - axis, half - bilge
    side, chord = _suction_reach(span, lever, flow, bilge, draft, roll_amplitude)
    suction = (m3 + m4) * chord - side**2
    width, height = half - 0.215 * bilge, 1.0 - 0.215 * bilge
    shared = 0.414 * half + 0.0651 * bilge**2
    m5 = (shared - (0.382 * half + 0.0106) * bilge) / (width * height)
    m6 = (shared - (0.382 + 0.0106 * half) * bilge) / (width * height)
    push = (
        m4**3 / (3.0 * width)
        + (1.0 - bilge) ** 2 * (2.0 * m3 - axis) / (6.0 * height)
        + bilge * (m3 * m5 + m4 * m6)
    )
    pull = 1.2 + _vortex_drag(span, lever, flow, roll_amplitude)
    area = draft**2 * (suction * pull + push * 1.2)
    return 4.0 / (3.0 * np.pi) * lever**2 * flow**2 * area * roll_amplitude


def _flow(sigma: FloatArray) -> FloatArray:
    """f: the speed of the flow past the bilge over that of the bilge itself."""
    return 1.0 + 0.3 * np.exp(-160.0 * (1.0 - sigma))


def _vortex_drag(
    span: FloatArray, lever: FloatArray, flow: FloatArray, roll_amplitude: FloatArray
) -> FloatArray:
    """The part of the drag coefficient that falls with the length of the stroke."""
    return 22.5 * span / (np.pi * lever * roll_amplitude * flow)


def _suction_reach(
    span: FloatArray,
    lever: FloatArray,
    flow: FloatArray,
    bilge: FloatArray,
    draft: FloatArray,
    roll_amplitude: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """m7 and m8: how far the suction behind the keel reaches beyond the bilge, and its chord, over draft."""
    reach = (0.3 * np.pi * flow * lever * roll_amplitude + 1.95 * span) / draft
    quarter = 0.25 * np.pi * bilge
    beyond = np.maximum(reach - quarter, 0.0)
    # Within the bilge only so much of its arc.
    turned = np.divide(reach, bilge, out=np.zeros(np.broadcast(reach, bilge).shape), where=bilge > 0.0)
    within = 1.414 * bilge * (1.0 - np.cos(turned))
    return beyond, np.where(reach > quarter, beyond + 0.414 * bilge, within)
