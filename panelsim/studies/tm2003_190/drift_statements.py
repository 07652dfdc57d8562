"""Verdicts on drift without supplementary terms in surge and sway, over seeds of the sea."""

from collections.abc import Mapping

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.studies.tm2003_190.section import Statement

MODELS = ("nonlinear", "linear")
FREE, NO_SPRINGS, SHIFTED, HELD = "free", "no yaw spring", "other components", "held"
SLOW_LEFT_OUT = "without the components above 1.0 rad/s"
SECOND_ORDER = (1.7, 2.3)  # powers of the height that are the second, whatever is left of the next


def drift_statement(
    heading: float,
    found: Mapping[tuple[str, str], FloatArray],
    length: float,
    *,
    slow: tuple[float, float],
) -> Statement:
    """Excessive drift in the nonlinear model and none in the linear one, over seeds of the sea.

    The median nonlinear run goes more than a ship length [m], no linear one does. `found`: distances [m] by
    kind of run and model, NaN of runs that did not finish; `slow`: the wave that passes most slowly and its
    frequency of encounter [rad/s].
    """
    says = f"Nonlinear drift without surge and sway terms, none in the linear model (8): {heading:g}°"
    far, near = (found.get((FREE, model), np.array([np.nan])) for model in MODELS)
    if np.isnan(far).any() or np.isnan(near).any():
        return Statement(says, False, "a run did not finish")
    return Statement(
        says,
        bool(np.median(far) > length >= near.max()),
        f"after ten minutes {_range(far)} nonlinear (median {np.median(far):.0f} m) and {_range(near)}"
        f" linear, {len(far)} seeds; a ship length is {length:.0f} m",
        _why_linear_drifts(found, slow) if near.max() > length else "",
    )


def _why_linear_drifts(found: Mapping[tuple[str, str], FloatArray], slow: tuple[float, float]) -> str:
    """The wave that stands still beside the ship, and how far she goes without it."""
    told = (
        f"The component of {slow[0]:.2g} rad/s is met at {slow[1]:.1g} rad/s: it stands still beside the ship"
        " and pushes her like a constant force, in first order, by its phase on or back."
    )
    if (SLOW_LEFT_OUT, "linear") in found:
        told += (
            f" {SLOW_LEFT_OUT.capitalize()} the linear ship goes {_range(found[SLOW_LEFT_OUT, 'linear'])}."
        )
    between = [f"{_range(found[SHIFTED, model])} {model}" for model in MODELS if (SHIFTED, model) in found]
    if between:
        told += f" In components between those of the report's grid she goes {' and '.join(between)}."
    return told


def _range(distances: FloatArray) -> str:
    """Least and most of the runs that finished."""
    known = distances[~np.isnan(distances)]
    if not len(known):
        return "an unknown distance"
    low, high = (f"{value:.0f}" for value in (known.min(), known.max()))
    return f"{low} m" if low == high else f"{low} to {high} m"


def force_statement(force: dict[float, FloatArray]) -> Statement:
    """The drift comes from mean forces of nonlinear terms, which are of second order in low waves."""
    heights = sorted(force)
    power = powers(force)
    holds = bool((power >= SECOND_ORDER[0]).all() and (power <= SECOND_ORDER[1]).all())
    told = ", ".join(f"{name} {value:.2f}" for name, value in zip(("surge", "sway"), power, strict=True))
    last = _power(force, *heights[-2:])
    return Statement(
        "Drift comes from mean forces that nonlinear terms bring, of second order in the wave height (8)",
        holds,
        f"mean force as H_s to the power {told}, from H_s {heights[0]:g} to {heights[1]:g} m;"
        f" {SECOND_ORDER[0]:g} to {SECOND_ORDER[1]:g} is the second",
        f"From {heights[-2]:g} to {heights[-1]:g} m it is {last[0]:.2f} and {last[1]:.2f}."
        if len(heights) > 2
        else "",
    )


def powers(force: dict[float, FloatArray]) -> FloatArray:
    """Power of the height (2,) by which the mean force grows between the two lowest seas; NaN if it turns."""
    low, high = sorted(force)[:2]
    return _power(force, low, high)


def _power(force: dict[float, FloatArray], low: float, high: float) -> FloatArray:
    ratio = force[high] / force[low]
    return np.asarray(np.log(np.where(ratio > 0.0, ratio, np.nan)) / np.log(high / low))
