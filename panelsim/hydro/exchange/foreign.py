"""What the file of another program holds, in SI units and exp(+iωt), still in the axes of that program."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import DOF_NAMES, ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.exchange.frame import Frame

_SAME_DIRECTION = 1e-6  # rad


@dataclass(frozen=True)
class ForeignCoefficients:
    """Coefficients and wave loads at zero speed of one floating body, six motions, in the axes of `frame`.

    `frequency` (F,) [rad/s] above 0, `added_mass` and `radiation_damping` (F, 6, 6), row = force;
    `added_mass_zero` and `added_mass_infinite` (6, 6) where the file has the limits. `wave_frequency` (W,),
    `wave_direction` (H,) [rad] of travel, from x towards y; `diffraction`, `froude_krylov` and `excitation`,
    the sum, (W, H, 6) [N/m, N] per unit amplitude, the phase that of a crest at the origin; one of the first
    and the last is there. `stiffness` (6, 6) and `displaced_volume` [m3] where the file has them,
    `water_density` [kg/m3] and `gravity` [m/s2] where the numbers depend on them.
    """

    source: str
    frame: Frame
    frequency: FloatArray
    added_mass: FloatArray
    radiation_damping: FloatArray
    wave_frequency: FloatArray
    wave_direction: FloatArray
    diffraction: ComplexArray | None = None
    froude_krylov: ComplexArray | None = None
    excitation: ComplexArray | None = None
    added_mass_zero: FloatArray | None = None
    added_mass_infinite: FloatArray | None = None
    stiffness: FloatArray | None = None
    displaced_volume: float | None = None
    water_density: float | None = None
    gravity: float | None = None
    water_depth: float = np.inf
    notes: tuple[str, ...] = ()


def require_sound(foreign: ForeignCoefficients) -> None:
    """Refuse numbers that are missing, not finite or out of shape, and grids without order.

    Raises PanelsimError with the quantity, the frequency and the motion of the first fault.
    """
    for name, grid in (("frequencies", foreign.frequency), ("wave frequencies", foreign.wave_frequency)):
        if len(grid) == 0 or not np.isfinite(grid).all() or grid[0] <= 0.0 or (np.diff(grid) <= 0.0).any():
            raise PanelsimError(
                f"The {name} do not rise from above 0",
                got=f"{foreign.source}: {len(grid)} of them, {np.array2string(grid, threshold=8)}",
                allowed="at least one, each once, in rad/s",
            )
    for name in ("added_mass", "radiation_damping"):
        _require_numbers(foreign, name, getattr(foreign, name), foreign.frequency, (6, 6))
    for name in ("added_mass_zero", "added_mass_infinite", "stiffness"):
        value = getattr(foreign, name)
        if value is not None:
            _require_numbers(foreign, name, value[None], np.zeros(1), (6, 6))
    if foreign.diffraction is None and foreign.excitation is None:
        raise PanelsimError(
            "The file holds no loads of waves", got=foreign.source, allowed="diffraction or their sum"
        )
    for name in ("diffraction", "froude_krylov", "excitation"):
        value = getattr(foreign, name)
        if value is not None:
            _require_numbers(foreign, name, value, foreign.wave_frequency, (len(foreign.wave_direction), 6))
    _require_directions(foreign)


def _require_numbers(
    foreign: ForeignCoefficients, name: str, values: np.ndarray, frequency: FloatArray, shape: tuple[int, int]
) -> None:
    label = name.replace("_", " ")
    if values.shape != (len(frequency), *shape):
        raise PanelsimError(
            f"The {label} is not whole",
            got=f"{foreign.source}: {values.shape}",
            allowed=f"{(len(frequency), *shape)}: frequencies, then six motions",
            remedy="compute all six motions of one body; a file cut short has to be written again",
        )
    if not np.isfinite(values).all():
        where = np.argwhere(~np.isfinite(values))[0]
        raise PanelsimError(
            f"The {label} is missing or not finite",
            got=f"{foreign.source}: {DOF_NAMES[where[-1]]} at {frequency[where[0]]:.4g} rad/s",
        )


def _require_directions(foreign: ForeignCoefficients) -> None:
    """Refuse directions that are degrees taken for radians, or come twice."""
    direction = foreign.wave_direction
    if len(direction) == 0 or not np.isfinite(direction).all() or np.abs(direction).max() > 2 * np.pi + 1e-9:
        raise PanelsimError(
            "The wave directions are no angles",
            got=f"{foreign.source}: {np.array2string(direction, threshold=8)} rad",
            allowed="-2π to 2π rad",
            remedy="look whether they are in degrees",
        )
    ordered = np.sort(direction)
    if (np.diff(ordered) < _SAME_DIRECTION).any():
        raise PanelsimError(
            "A wave direction comes twice",
            got=f"{foreign.source}: {np.degrees(ordered[:-1][np.diff(ordered) < _SAME_DIRECTION][0]):.4g}°",
        )
