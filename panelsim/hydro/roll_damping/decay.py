"""Period and damping of roll from the record of a decay test."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import least_squares

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.roll_damping.amplitudes import require_amplitudes
from panelsim.hydro.roll_damping.extinction import Extinction, fit_extinction_curve
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.seaway.checks import real_numbers, require_angles, require_positive

# RK4 at this many steps a period is good to 1e-6 of the period.
_STEPS_A_PERIOD = 60
# A roll that falls by less over the whole record has no decay that could be fitted.
_LEAST_DECAY = 0.02


@dataclass(frozen=True)
class RollDecay:
    """The roll x¨ + b1 x˙ + b2 x˙|x˙| + ω0² x = 0 about a line, fitted to a record.

    `period` 2π/ω0 [s]; `linear` b1 [1/s] and `quadratic` b2 [1/rad], over the inertia with the added one;
    `offset` [rad] at time 0 and `trend` [rad/s] of the line; `residual` RMS of record less fit [rad];
    `extremes` of the record that stand clear of its noise; `fitted` (N,) [rad] the roll of this equation at
    the times of the record. `period_error` [s], `linear_error` [1/s] and `quadratic_error` [1/rad] are
    standard errors for a residual that is noise, each sample for itself: a short record tells the sum of both
    damping terms better than either.
    """

    period: float
    linear: float
    quadratic: float
    offset: float
    trend: float
    residual: float
    extremes: int
    period_error: float
    linear_error: float
    quadratic_error: float
    fitted: FloatArray = field(default_factory=lambda: np.zeros(0), repr=False, compare=False)

    @property
    def damping_ratio(self) -> float:
        """The linear term as a share of the critical damping."""
        return self.linear * self.period / (4.0 * np.pi)

    def equivalent_damping_ratio(self, roll_amplitude: float) -> float:
        """Damping ratio of the same energy in regular rolling of `roll_amplitude` [rad], natural period."""
        amplitude = float(require_amplitudes(roll_amplitude))
        return self.damping_ratio + 4.0 / (3.0 * np.pi) * self.quadratic * amplitude

    def terms(self, inertia: float) -> RollDampingTerms:
        """The damping of a ship of this roll `inertia` with the added inertia [kg m2]."""
        inertia = require_positive("The roll inertia", inertia, "kg m2")
        return RollDampingTerms(self.linear * inertia, self.quadratic * inertia)


def fit_roll_decay(time: ArrayLike, roll: ArrayLike) -> RollDecay:
    """Fit the equation of roll to a record by least squares on its simulation, from the extinction curve on.

    `time` (N,) [s] increasing, evenly or not; `roll` (N,) [rad], from the release on. A constant offset and a
    straight trend of the record are fitted too, and neither damping term falls below 0. Stiffness is linear:
    where the righting arm is not, the period is that of the mean amplitude. Raises PanelsimError for a record
    that is not finite, is in degrees, has fewer than three extremes, or does not decay.
    """
    time, roll = _checked(time, roll)
    start = fit_extinction_curve(time, roll)
    _require_decay(start, time, roll)
    origin = time[0]
    frequency = 2.0 * np.pi / start.period
    level = start.offset + start.trend * time
    rate = float(np.polyfit(time[: _samples(time, start)] - origin, roll[: _samples(time, start)], 1)[0])
    guess = np.array(
        [
            frequency,
            max(start.linear, 0.0),
            max(start.quadratic, 0.0),
            roll[0] - level[0],
            rate - start.trend,
            level[0],
            start.trend,
        ]
    )
    free = np.full(len(guess), np.inf)
    lowest = -free
    lowest[:3] = [0.5 * frequency, 0.0, 0.0]
    highest = free.copy()
    highest[0] = 2.0 * frequency
    # A step for each unknown in its own size: angles by the record, coefficients by the frequency.
    size = float(np.ptp(roll))
    scale = np.array([frequency, frequency, 1.0, size, size * frequency, size, size / np.ptp(time)])
    guess = np.clip(guess, lowest + 1e-9 * scale, highest)
    fit = least_squares(
        lambda unknown: _simulated(time - origin, unknown, start.period) - roll,
        guess,
        bounds=(lowest, highest),
        x_scale=scale,
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-14,
    )
    frequency, linear, quadratic, *_, offset, trend = (float(value) for value in fit.x)
    errors = _standard_errors(fit.jac * scale, fit.fun) * scale
    return RollDecay(
        period=2.0 * np.pi / frequency,
        linear=linear,
        quadratic=quadratic,
        offset=offset - trend * float(origin),
        trend=trend,
        residual=float(np.sqrt(np.mean(fit.fun**2))),
        extremes=start.extremes,
        period_error=2.0 * np.pi / frequency**2 * float(errors[0]),
        linear_error=float(errors[1]),
        quadratic_error=float(errors[2]),
        fitted=roll + fit.fun,
    )


def _simulated(time: FloatArray, unknown: FloatArray, period: float) -> FloatArray:
    """The roll (N,) at `time` (N,) [s] from 0 of the unknowns ω0, b1, b2, x, x˙, offset, trend, by RK4."""
    frequency, linear, quadratic, x, v, offset, trend = unknown.tolist()
    stiffness = frequency**2
    steps = max(int(np.ceil(time[-1] / period * _STEPS_A_PERIOD)), 2)
    h = float(time[-1]) / steps

    def pull(x: float, v: float) -> float:
        return -stiffness * x - v * (linear + quadratic * abs(v))

    states = [(x, v)]
    for _ in range(steps):
        k1 = pull(x, v)
        v2 = v + 0.5 * h * k1
        k2 = pull(x + 0.5 * h * v, v2)
        v3 = v + 0.5 * h * k2
        k3 = pull(x + 0.5 * h * v2, v3)
        v4 = v + h * k3
        k4 = pull(x + h * v3, v4)
        x += h / 6.0 * (v + 2.0 * (v2 + v3) + v4)
        v += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
        states.append((x, v))
    rolls, rates = np.array(states).T
    path = CubicHermiteSpline(h * np.arange(steps + 1), rolls, rates)
    roll: FloatArray = path(time) + offset + trend * time
    return roll


def _standard_errors(jacobian: FloatArray, residual: FloatArray) -> FloatArray:
    """Standard errors (K,) of K unknowns fitted to N samples, from the Jacobian (N, K) and residual (N,)."""
    samples, unknowns = jacobian.shape
    variance = float(residual @ residual) / max(samples - unknowns, 1)
    return np.asarray(np.sqrt(variance * np.diag(np.linalg.pinv(jacobian.T @ jacobian))))


def _samples(time: FloatArray, start: Extinction) -> int:
    """How many samples lie in the first sixteenth of a period, two at least."""
    return max(int(np.searchsorted(time, time[0] + start.period / 16.0)), 2)


def _require_decay(start: Extinction, time: FloatArray, roll: FloatArray) -> None:
    """Refuse a record whose amplitude does not fall."""
    amplitude = 0.5 * float(np.ptp(roll))
    per_cycle = 0.5 * start.linear * start.period + 8.0 / 3.0 * start.quadratic * amplitude
    fallen = per_cycle * 0.5 * (start.extremes - 1)
    if not fallen > _LEAST_DECAY:
        raise PanelsimError(
            "The roll does not decay over this record",
            got=f"the amplitude falls by {100.0 * fallen:.2g} % from the first extreme to the last",
            allowed=f"{100.0 * _LEAST_DECAY:g} % or more",
            remedy="give the record of a free decay in calm water, longer if its damping is very small",
        )


def _checked(time: ArrayLike, roll: ArrayLike) -> tuple[FloatArray, FloatArray]:
    angles, instants = real_numbers("roll", roll), real_numbers("time", time)
    if instants.shape != angles.shape or angles.ndim != 1 or len(angles) < 10:
        raise PanelsimError(
            "Time and roll are not two equal rows of samples",
            got=f"shapes {instants.shape} and {angles.shape}",
            allowed="ten samples or more of each",
        )
    for name, values in (("time", instants), ("roll", angles)):
        wrong = np.flatnonzero(~np.isfinite(values))
        if len(wrong):
            raise PanelsimError(
                f"The {name} of the record is not finite at sample {wrong[0] + 1} of {len(values)}",
                got=f"{values[wrong[0]]:g}, and {len(wrong)} such samples in all",
                allowed="finite numbers",
                remedy="leave these samples out",
            )
    late = np.flatnonzero(np.diff(instants) <= 0.0)
    if len(late):
        raise PanelsimError(
            f"The times of the record do not increase at sample {late[0] + 2}",
            got=f"{instants[late[0] + 1]:g} s after {instants[late[0]]:g} s",
            allowed="each time after the one before [s]",
        )
    require_angles("largest roll of the decay record", float(np.abs(angles).max()))
    return instants, angles
