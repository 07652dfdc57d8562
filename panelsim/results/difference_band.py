"""How sure a difference of two RMS is, where both come from the same realizations of a sea."""

import numpy as np
from scipy.stats import t as student

from panelsim.conventions import CONFIDENCE, FloatArray
from panelsim.results.rms_study import RmsStudy


def difference_band(study: RmsStudy) -> FloatArray:
    """Half width (L, S, 6) of the 95 % confidence band of `difference`; NaN for one realization.

    The realizations are paired. The ratio q of the mean variances v over those of the reference w has the
    standard error s(v − q w)/(w̄ √R) of a ratio estimate, Cochran, Sampling Techniques (1977), 6.4; that of √q
    is 1/(2 √q) of it.
    """
    count = study.rms.shape[2]
    if count < 2:
        return np.full(study.pooled.shape, np.nan)
    variance = study.rms**2
    of_reference = variance[study.reference]
    mean = of_reference.mean(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = variance.mean(axis=2) / mean
        left = variance - ratio[:, :, None] * of_reference
        error = left.std(axis=2, ddof=1) / (mean * np.sqrt(count)) / (2.0 * np.sqrt(ratio))
    half = student.ppf(0.5 + 0.5 * CONFIDENCE, count - 1) * error
    return np.where(study.major, half, np.nan)
