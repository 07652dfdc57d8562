"""Whether a hydrodynamic database reaches the waves of a sea."""

from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.tabulated_diffraction import require_covered
from panelsim.seaway.components import WaveComponents

# A tail of short waves moves no ship, and is told in a note; a sea of nothing else is refused.
_MOST_BEYOND = 0.5


def require_waves_held(database: HydroDatabase, waves: WaveComponents) -> None:
    """Refuse a sea that the coefficients do not reach.

    Diffraction tables hold their own waves and those between near ones; potentials hold all, but no panel is
    short enough for most of the energy beyond the last frequency. Raises PanelsimError with the frequency
    that the coefficients are good to.
    """
    if not waves.count:
        return
    if not database.has_potentials:
        require_covered(database, waves.frequency, waves.wave_heading)
    last = float(database.frequencies[-1])
    energy = waves.amplitude**2
    beyond = float(energy[waves.frequency > last].sum())
    if beyond > _MOST_BEYOND * energy.sum():
        raise PanelsimError(
            "The coefficients do not reach the waves of this sea",
            got=f"waves of up to {waves.frequency.max():.4g} rad/s,"
            f" {100 * beyond / energy.sum():.0f} % of the energy beyond what the mesh or the file is good to",
            allowed=f"most of the energy at {last:.4g} rad/s or less",
            remedy="compute coefficients on smaller panels, or choose longer waves",
        )
