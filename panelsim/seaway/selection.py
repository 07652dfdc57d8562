"""Leaving out wave components that carry next to nothing, without losing their energy."""

import numpy as np
from numpy.typing import NDArray

from panelsim.seaway.components import WaveComponents


def negligible(components: WaveComponents, below: float) -> NDArray[np.bool_]:
    """True (M,) for the components that carry less than the share `below` of the energy of all."""
    energy = components.amplitude**2
    return energy < below * energy.sum()


def without(components: WaveComponents, dropped: NDArray[np.bool_]) -> WaveComponents:
    """The components that are not dropped (M,), enlarged to carry the energy of all.

    TM 2003-190 section 7: one factor on all amplitudes keeps ½ Σ a². With none dropped they stay as they are.
    """
    if not dropped.any():
        return components
    energy, keep = components.amplitude**2, ~dropped
    return WaveComponents(
        components.amplitude[keep] * np.sqrt(energy.sum() / energy[keep].sum()),
        components.frequency[keep],
        components.wave_heading[keep],
        components.phase[keep],
    )
