"""Diffraction loads at speed from zero-speed radiation potentials, by Green's identity.

The scattered wave φ_D cancels the flow of the incident wave φ_I through the hull. Its momentum needs no
solution of its own: P_d,j = -ρ ∫ φ_D n_j dS = ρ ∫ φ_j(ω_e) ∂φ_I/∂n dS, with the radiation potentials φ_j
at the frequency of encounter and φ_I at the wave's own wavenumber. The load is F = (-iω_e + Lᵀ) P_d with
L35 = +U, L26 = -U, and nothing is divided by ω_e. A database without potentials gives P_d from its tables.
"""

import numpy as np
from numpy.typing import NDArray

from panelsim.conventions import ComplexArray, Dof, FloatArray
from panelsim.errors import PanelsimError, require_kind
from panelsim.hydro.arguments import A_DATABASE, A_TRANSOM, require_speed_ahead
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.interpolation import at_frequency
from panelsim.hydro.tabulated_diffraction import tabulated_momentum
from panelsim.hydro.transom import Transom
from panelsim.seaway.checks import real_numbers, require_angles
from panelsim.seaway.dispersion import encounter_frequency, wavenumber

_GAUSS = np.array([-1.0, 1.0]) / np.sqrt(3.0)
# Sign of each motion's potential on the mirrored half: normals of surge, heave and pitch are even in y.
_MIRROR_SIGN = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])


def diffraction_load(
    database: HydroDatabase,
    frequency: FloatArray,
    wave_heading: FloatArray,
    speed: float,
    transom: Transom | None = None,
) -> ComplexArray:
    """Diffraction force and moment (M, 6) [N, N m] about the centre of gravity for waves of 1 m amplitude.

    `frequency` ω (M,) [rad/s] more than 0, `wave_heading` β (M,) [rad], 0 following, π head; `speed` [m/s].
    Complex amplitude with exp(+iω_e t), ω_e signed, on the ship's mean position in ship axes, the phase that
    of a crest at the centre of gravity at t = 0. With a `transom`, less U times the momentum per metre that
    leaves there, the end terms of Salvesen, Tuck and Faltinsen (1970). Raises PanelsimError for arguments of
    another kind or out of range, for the transom of another hull and, without potentials, for waves that the
    tables do not cover.
    """
    require_kind("database", database, HydroDatabase, A_DATABASE)
    require_kind("transom", transom, Transom | None, A_TRANSOM)
    require_speed_ahead(speed)
    omega, heading = _components(frequency, require_angles("wave heading", wave_heading))
    if transom is not None:
        transom.require_hull_of(database)
    momentum = diffraction_momentum(database, omega, heading, speed)
    encounter = encounter_frequency(omega, heading, speed, database.gravity)
    load = -1j * encounter[:, None] * momentum
    load[:, Dof.PITCH] += speed * momentum[:, Dof.HEAVE]
    load[:, Dof.YAW] -= speed * momentum[:, Dof.SWAY]
    return load if transom is None else load - speed * transom.momentum(omega, heading, encounter)


def diffraction_momentum(
    database: HydroDatabase, frequency: FloatArray, wave_heading: FloatArray, speed: float
) -> ComplexArray:
    """Momentum P_d (M, 6) [kg m/s, kg m2/s] of the scattered wave, arguments as in `diffraction_load`."""
    omega, heading = _components(frequency, wave_heading)
    encounter = encounter_frequency(omega, heading, speed, database.gravity)
    if not database.has_potentials:
        return tabulated_momentum(database, omega, heading, encounter)
    even, odd = _normal_flow(database, omega, heading)
    momentum = np.empty((len(omega), 6), dtype=np.complex128)
    potential = radiation_potential(database, encounter)
    for dof in Dof:
        flow = even if _MIRROR_SIGN[dof] > 0 else odd
        momentum[:, dof] = database.water_density * np.einsum("mp,mp->m", potential[:, dof], flow)
    return momentum


def radiation_potential(database: HydroDatabase, encounter: FloatArray) -> ComplexArray:
    """Radiation potentials φ_j (M, 6, panels) at signed frequencies of encounter (M,) [rad/s]."""
    return at_frequency(database.frequencies, database.potential, database.potential_infinite, encounter)


def beyond_resolution(
    database: HydroDatabase, frequency: FloatArray, wave_heading: FloatArray, speed: float
) -> NDArray[np.bool_]:
    """True (M,) where waves meet the ship faster than the database's last frequency resolves."""
    omega, heading = _components(frequency, wave_heading)
    encounter = encounter_frequency(omega, heading, speed, database.gravity)
    return np.abs(encounter) > database.frequencies[-1]


def _normal_flow(
    database: HydroDatabase, omega: FloatArray, heading: FloatArray
) -> tuple[ComplexArray, ComplexArray]:
    """∫ ∂φ_I/∂n dS over each panel (M, panels), for potentials even and odd across the centreplane.

    Four Gauss points a panel keep the wave's phase and decay where k times the panel size is near 1 or above.
    A half hull adds its mirror image, with the sign of the potential.
    """
    points, area_vectors = _gauss_points(database.panel_corners)
    port = _incident_flow(database, points, area_vectors, omega, heading)
    if not database.half_hull:
        return port, port
    mirror = np.array([1.0, -1.0, 1.0])
    starboard = _incident_flow(database, points * mirror, area_vectors * mirror, omega, heading)
    return port + starboard, port - starboard


def _incident_flow(
    database: HydroDatabase,
    points: FloatArray,
    area_vectors: FloatArray,
    omega: FloatArray,
    heading: FloatArray,
) -> ComplexArray:
    """∫ ∇φ_I · n dS (M, panels), φ_I = (i g/ω) exp(kz - ik(x cos β - y sin β)), z above calm water."""
    k = wavenumber(omega, database.gravity)
    flow = np.empty((len(omega), len(points)), dtype=np.complex128)
    for m, (cos, sin) in enumerate(zip(np.cos(heading), np.sin(heading), strict=True)):
        direction = k[m] * np.array([-1j * cos, 1j * sin, 1.0])
        wave = np.exp(points @ direction - k[m] * database.waterline)
        flow[m] = (1j * database.gravity / omega[m] * wave * (area_vectors @ direction)).sum(axis=1)
    return flow


def _gauss_points(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points and outward area vectors (panels, 4, 3) of the bilinear surface through panel corners.

    Its enclosed volume is the mean over both diagonal splits of the panel.
    """
    points, area_vectors = [], []
    a, b, c, d = (corners[:, i] for i in range(4))
    for u in _GAUSS:
        for v in _GAUSS:
            points.append(
                0.25
                * (
                    (1 - u) * (1 - v) * a
                    + (1 + u) * (1 - v) * b
                    + (1 + u) * (1 + v) * c
                    + (1 - u) * (1 + v) * d
                )
            )
            along_u = 0.25 * ((1 - v) * (b - a) + (1 + v) * (c - d))
            along_v = 0.25 * ((1 - u) * (d - a) + (1 + u) * (c - b))
            area_vectors.append(np.cross(along_u, along_v))
    return np.stack(points, axis=1), np.stack(area_vectors, axis=1)


def _components(frequency: FloatArray, wave_heading: FloatArray) -> tuple[FloatArray, FloatArray]:
    omega = np.atleast_1d(real_numbers("wave frequency", frequency))
    heading = real_numbers("wave heading", wave_heading)
    possible = (omega > 0.0) & (omega < np.inf)
    if not possible.all():
        raise PanelsimError(
            "Wave frequencies must be more than 0 and finite",
            got=f"{omega[~possible][0]:g}",
            allowed="more than 0 rad/s",
        )
    if max(omega.ndim, heading.ndim) > 1 or len({omega.size, heading.size} - {1}) > 1:
        raise PanelsimError(
            "Wave frequencies and headings are not two rows of one length",
            got=f"shapes {omega.shape} and {heading.shape}",
            allowed="one heading for each frequency, or one for all",
        )
    omega, heading = np.broadcast_arrays(omega, heading)
    return omega, heading
