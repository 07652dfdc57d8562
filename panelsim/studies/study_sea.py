"""The sea of a case as studies of it have it, and the same sea in other realizations."""

import numpy as np

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.results.rms_study import StudySea
from panelsim.seaway.random import RandomSeaway
from panelsim.studies.arguments import whole_number
from panelsim.studies.case_response import own_heading


def study_sea(case: Case) -> StudySea:
    """The sea of a case in short. Raises PanelsimError for calm water, in which nothing has an RMS."""
    sea = case.seaway
    if not sea.components.count:
        raise PanelsimError(
            "The RMS of motions cannot be studied in calm water",
            got='seaway.kind = "calm"',
            remedy="give the case waves, for example --set seaway.kind=random and a spectrum",
        )
    heading = round(float(np.rad2deg(own_heading(case))), 6)
    height = None
    if isinstance(sea, RandomSeaway):
        height = 4.0 * float(np.sqrt(sea.point_spectrum.moment(0)))
    elif sea.components.count > 1:
        height = 4.0 * float(np.sqrt(sea.components.variance))
    if height is None:
        words = f"height {2.0 * sea.components.amplitude[0]:.4g} m, {sea.components.frequency[0]:.4g} rad/s"
    else:
        words = f"H_s {height:.4g} m"
    return StudySea(f"{words}, {heading:g}°", heading, height, case.file.seaway.peak_period)


def realization(case: Case, index: int) -> Case:
    """The case with its own seed (index 0), or with that of another realization of its sea."""
    return case if index == 0 else case.changed({"seaway.seed": case.file.seaway.seed + index})


def require_seeds(case: Case, seeds: int) -> int:
    """The number of realizations; PanelsimError for one that the sea of a case does not have."""
    seeds = whole_number("number of seeds", seeds)
    if seeds > 1 and not isinstance(case.seaway, RandomSeaway):
        raise PanelsimError(
            "The sea of the case has one realization only",
            got=f'{seeds} seeds, seaway.kind = "{case.file.seaway.kind}"',
            allowed="1",
            remedy="leave --seeds out, or take a random sea",
        )
    return seeds
