"""The xarray layout of radiation coefficients and potentials, whichever method found them."""

import numpy as np
import xarray as xr

from panelsim.conventions import DOF_NAMES, ComplexArray, FloatArray
from panelsim.hydro.conditioning import damping_roughness, require_physical, symmetrise


def radiation_dataset(
    frequencies: FloatArray,
    inertia: ComplexArray,
    potential: ComplexArray,
    corners: FloatArray,
    *,
    mirror_symmetric: bool,
) -> xr.Dataset:
    """Added mass, damping and potentials as a database holds them; symmetrised, and by how much told.

    `inertia` A + B/(iω) (F + 1, 6, 6) and `potential` φ_j (F + 1, 6, panels) at the `frequencies` (F,)
    [rad/s] from 0 and, in the last row, at infinity; `corners` (panels, 4, 3) [m] in ship axes, of the port
    half or of the whole hull. Raises PanelsimError for coefficients that no body can have.
    """
    half_breadth = float(np.abs(corners[..., 1]).max())
    added_mass, transpose_a, coupling_a = symmetrise(
        inertia.real, mirror_symmetric=mirror_symmetric, half_breadth=half_breadth
    )
    damping, transpose_b, coupling_b = symmetrise(
        frequencies[:, None, None] * -inertia[:-1].imag,
        mirror_symmetric=mirror_symmetric,
        half_breadth=half_breadth,
    )
    require_physical(frequencies, added_mass[:-1], damping, half_breadth)
    matrix = ("frequency", "influenced_dof", "radiating_dof")
    field = ("frequency", "radiating_dof", "panel")
    return xr.Dataset(
        {
            "added_mass": (matrix, added_mass[:-1]),
            "radiation_damping": (matrix, damping),
            "added_mass_infinite": (matrix[1:], added_mass[-1]),
            # Single precision, as they are stored: a computed database is the same as one read back.
            "potential_real": (field, potential[:-1].real.astype(np.float32)),
            "potential_imag": (field, potential[:-1].imag.astype(np.float32)),
            "potential_infinite": (field[1:], potential[-1].real.astype(np.float32)),
            "panel_corners": (("panel", "corner", "axis"), corners),
        },
        coords={
            "frequency": frequencies,
            "influenced_dof": list(DOF_NAMES),
            "radiating_dof": list(DOF_NAMES),
            "axis": ["x", "y", "z"],
        },
        attrs={
            "mirror_symmetric": int(mirror_symmetric),
            "asymmetry_added_mass": transpose_a,
            "asymmetry_radiation_damping": transpose_b,
            "port_starboard_coupling": max(coupling_a, coupling_b),
            "damping_roughness": damping_roughness(frequencies, damping, half_breadth),
            "half_breadth": half_breadth,
        },
    )
