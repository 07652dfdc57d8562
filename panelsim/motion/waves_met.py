"""Waves of a run at places that move with the ship, as they grow over the ramp."""

from dataclasses import replace

from panelsim.conventions import FloatArray
from panelsim.seaway.translating import TranslatingSeaway


def wave_elevation(
    sea: TranslatingSeaway,
    time: FloatArray,
    wave_factor: FloatArray,
    x: FloatArray | float = 0.0,
    y: FloatArray | float = 0.0,
) -> FloatArray:
    """Elevation (T,) [m], all amplitudes times `wave_factor` (T,), at the moving origin if not elsewhere.

    `x` and `y` [m] are one place in translating axes, or one at each time. The second order of a Stokes wave,
    ½ a² k cos 2θ, grows with the square of the factor.
    """
    elevation = sea.elevation(x, y, time)
    if not sea.components.second_order:
        return wave_factor * elevation
    linear = replace(sea, components=replace(sea.components, second_order=False))
    first_order = linear.elevation(x, y, time)
    return wave_factor * first_order + wave_factor**2 * (elevation - first_order)
