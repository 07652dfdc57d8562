"""The order at which a study converges: the slope of its differences over the size of step or panel."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import curve_fit

from panelsim.conventions import FloatArray
from panelsim.results.rms_study import RmsStudy

# Two levels always lie on a line: it takes three to see whether there is an order.
FEWEST_LEVELS = 3
LOWEST, HIGHEST = 0.05, 10.0
# Of the order itself: beyond it the differences follow no power of the size.
UNCERTAIN = 0.5


@dataclass(frozen=True)
class ConvergenceOrder:
    """The order p with its standard error, both NaN where `reason` says why none can be told."""

    order: float
    standard_error: float
    reason: str = ""

    @property
    def told(self) -> str:
        """A sentence."""
        if self.reason:
            return f"No order of convergence can be told: {self.reason}."
        return f"Order of convergence {self.order:.2f} ± {self.standard_error:.2f} (standard error)."


def convergence_order(
    study: RmsStudy, size: FloatArray, *, floor: FloatArray | float, own_reference: bool = True
) -> ConvergenceOrder:
    """Fit C (hᵖ − h_refᵖ) to the differences, root mean square over seas and major modes, of each level.

    `size` h (L,) [s or m] of every level, the reference with them. Below `floor`, a share of the RMS, one for
    each level or for all, a difference is noise. Where the reference is of another scheme
    (`own_reference` False) its error is taken for nothing, and C hᵖ is fitted.
    """
    others = np.arange(len(size)) != study.reference
    error = _sizes_of_difference(study)
    known = others & np.isfinite(error)
    if known.sum() < FEWEST_LEVELS:
        levels = "1 level" if known.sum() == 1 else f"{known.sum()} levels"
        return _none(f"{levels} besides the reference, and it takes {FEWEST_LEVELS}")
    if (error <= floor)[known].any():
        least = 100.0 * error[known].min()
        return _none(f"a difference of {least:.2g} % is round-off, or below what the samples tell of an RMS")
    h, e = size[known], error[known]
    least = size[study.reference] if own_reference else 0.0

    def logarithm(h: FloatArray, constant: float, order: float) -> FloatArray:
        return np.asarray(constant + np.log(h**order - least**order))

    start = (float(np.log(e.mean() / h.mean() ** 2)), 2.0)
    bounds = ((-np.inf, LOWEST), (np.inf, HIGHEST))
    (_, order), covariance = curve_fit(logarithm, h, np.log(e), p0=start, bounds=bounds)
    deviation = float(np.sqrt(covariance[1, 1]))
    if not LOWEST * 1.01 < order < HIGHEST * 0.99 or deviation > UNCERTAIN * order:
        return _none("the differences follow no power of the size")
    return ConvergenceOrder(float(order), deviation)


def _sizes_of_difference(study: RmsStudy) -> FloatArray:
    """Root mean square (L,) of the differences over seas and major modes; NaN where a run failed."""
    counted = np.where(study.major, study.difference**2, 0.0).sum(axis=(1, 2))
    modes = study.major.sum()
    return np.asarray(np.sqrt(counted / modes)) if modes else np.full(len(counted), np.nan)


def _none(reason: str) -> ConvergenceOrder:
    return ConvergenceOrder(np.nan, np.nan, reason)
