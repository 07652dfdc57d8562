"""How much of a motion is at the frequencies at which the waves are met, and how much elsewhere.

A linear motion has no others. Nonlinear loads bring in sums and differences of them: slow drift, or a roll at
its natural frequency.
"""

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.seaway.components import WaveComponents
from panelsim.studies.run_store import StoredRun

# Waves with less of the energy are none: differences of others fall upon their frequencies of encounter,
# which in the report's set-up are all but multiples of one.
LEAST_SHARE = 1e-3


def at_wave_frequencies(run: StoredRun, waves: WaveComponents, speed: float, gravity: float) -> FloatArray:
    """RMS (6,) [m, rad] of what least squares find at the frequencies of encounter after the ramp.

    Frequencies that come closer than one turn in the record go as one, and those of less than half a turn
    are left to the mean. `speed` in m/s, `gravity` in m/s2.
    """
    time = run.time[run.after_ramp]
    resolution = 2.0 * np.pi / (time[-1] - time[0])
    energetic = waves.amplitude**2 >= LEAST_SHARE * 2.0 * waves.variance
    met = np.sort(np.abs(waves.encounter_frequency(speed, gravity)[energetic]))
    met = met[met > 0.5 * resolution]
    kept = met[np.insert(np.diff(met) >= resolution, 0, True)]
    turns = np.outer(time, kept)
    basis = np.column_stack([np.ones_like(time), np.cos(turns), np.sin(turns)])
    fit = np.linalg.lstsq(basis, run.displacement[run.after_ramp], rcond=None)[0]
    return np.asarray((basis @ fit).std(axis=0))
