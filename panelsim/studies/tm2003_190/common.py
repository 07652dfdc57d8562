"""What the studies of TM 2003-190 section 8 share: the ship, the seas and how much of them is run."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from panelsim.case import Case
from panelsim.case.schema import CaseFile
from panelsim.conventions import STANDARD_GRAVITY
from panelsim.results.rms_study import StudySea
from panelsim.seaway.steepness import BUCKLEY_STEEPNESS

STERN_QUARTERING, BOW_QUARTERING = 30.0, 150.0  # wave heading, deg
HEADINGS_DEG = (STERN_QUARTERING, BOW_QUARTERING)
LIMITING_STEEPNESS = BUCKLEY_STEEPNESS
TYPICAL_STEEPNESS = 0.021  # section 8.3
# At the limiting steepness half of the energy of a sea of 1 m is above the 2.0 rad/s where the report's
# components end: its seas are lower than they are called, and so are ours.
LEAST_ENERGY = 0.4
LOWER = 0.05  # by more than this share of its height a sea is called lower


@dataclass(frozen=True)
class Scope:
    """How much is run: significant heights [m], realizations of each sea, seconds after the ramp.

    `model_realizations` are those of linear against nonlinear, whose differences scatter more than those of
    time steps and meshes.
    """

    heights: tuple[float, ...]
    realizations: int
    model_realizations: int
    duration: float


FULL = Scope(tuple(float(height) for height in range(1, 11)), 3, 10, 1200.0)
QUICK = Scope((3.0, 7.0), 1, 3, 300.0)


def base_case() -> Case:
    """HALIFAX as in section 8: medium mesh, 20 knots, nonlinear, 0.2 s, 19 components, its sea state 7.

    Supplementary terms are those of the hull's particulars, which are the report's; the inertia is that of
    its equations.
    """
    described = {
        "ship": {"hull": "halifax", "panel_area": 2.5},
        "seaway": {
            "kind": "random",
            "significant_wave_height": 7.5,
            "peak_period": 15.0,
            "frequencies": {"start": 0.2, "stop": 2.0, "step": 0.1},
            "wave_heading_deg": BOW_QUARTERING,
            "minimum_energy": LEAST_ENERGY,
        },
        "run": {
            "speed_knots": 20.0,
            "inertia": "linear",
            "time_step": 0.2,
            "duration": FULL.duration,
            "ramp": 60.0,
        },
    }
    # The folder holds no file that a case could name.
    return Case(CaseFile.model_validate(described), Path(__file__).parent, "tm2003-190")


def study_sea(wave_heading_deg: float, height: float, steepness: float) -> StudySea:
    """A Bretschneider sea of a significant height [m], its peak period from the nominal steepness, (56)."""
    period = float(np.sqrt(2.0 * np.pi * height / (STANDARD_GRAVITY * steepness)))
    label = f"H_s {height:g} m, T_p {period:.1f} s, {wave_heading_deg:g}°"
    return StudySea(label, wave_heading_deg, height, period)


def study_seas(heights: tuple[float, ...], steepness: float) -> tuple[StudySea, ...]:
    """The seas of both headings, each in rising height."""
    return tuple(study_sea(heading, height, steepness) for heading in HEADINGS_DEG for height in heights)


def in_sea(case: Case, sea: StudySea, realization: int) -> Case:
    """The case in a sea; realization r of a height has the same phases in every study and at each heading."""
    assert sea.significant_wave_height is not None
    return case.changed(
        {
            "seaway.significant_wave_height": sea.significant_wave_height,
            "seaway.peak_period": sea.peak_period,
            "seaway.wave_heading_deg": sea.wave_heading_deg,
            "seaway.seed": round(1000.0 * sea.significant_wave_height) + realization + 1,
        }
    )


def low_seas(base: Case, heights: Sequence[float], *steepness: float) -> str:
    """A sentence on the seas whose components are lower than the sea is called; "" where none is by 5 %."""
    low = []
    for one in steepness:
        for height in heights:
            components = in_sea(base, study_sea(BOW_QUARTERING, height, one), 0).seaway.components
            share = components.variance / (height / 4.0) ** 2
            if np.sqrt(share) < 1.0 - LOWER:
                told = f"H_s {height:g} m at steepness {one:g} has {100 * share:.0f} % of its energy"
                low.append(f"{told} and is {height * np.sqrt(share):.2f} m high")
    if not low:
        return ""
    return f" Low seas are lower than called, as components end at 2.0 rad/s: {'; '.join(low)}."
