"""What a grid for the sea about the ship must be, by tolerance and cost; and which method is the cheapest.

The wave head is separated in depth, exp(k d) = Σ_c ψ_c(k) T_c(v), Chebyshev polynomials T_c in a stretched
depth v. Each field W_c(x, y) = Re Σ a ψ_c(k) exp(iθ) is a B-spline of degree p on a grid that moves with the
ship. As every wavenumber is known, the spline coefficients are the waves themselves over the transfer
function of the spline, sinc(k h/2)^(p+1) along each axis. What is left is aliasing,
Σ_n |k h/(k h + 2π n)|^(p+1).

Spacing and terms follow from all waves, weighted with their energy. To keep the shortest out of the grid and
sum them directly never pays: each costs some 1.3 ns a point, and a finer grid hardly anything.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev
from scipy.optimize import brentq, minimize_scalar

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.kernels.tables import WaveTables

DEFAULT_TOLERANCE = 2e-6
LEAST_TOLERANCE, LARGEST_TOLERANCE = 1e-7, 1e-2
DEGREES = (3, 5, 7)
TERM_COUNTS = (8, 16)  # in rows of eight
WINDOW = 8  # modes along each axis that a wave is spread over
NODES_TOGETHER = 4  # pairs of nodes that the kernel sums side by side
MOST_NODES = 500_000
# Each source of error (two axes, depth, window) may be this share of the tolerance, in rms over the standard
# deviation σ of the sea. Independent, the four make half the tolerance; the largest of a random error is
# some four times its rms: twice the tolerance, which over the significant amplitude 2σ is the tolerance.
SHARE = 0.25

# Measured on one core of a Xeon with AVX-512, in ns; only their ratios matter.
DIRECT = 1.3  # a wave at a point
LINE_POINT, LINE_NODE = 10.0, 1.8  # a point, and each of its p + 1 nodes
PLANE_POINT, PLANE_NODE = 25.0, 0.75  # a point, and each of its (p + 1)² nodes
SUM_X, SUM_Y, NODE = 9.6, 5.0, 4.0  # a mode at four pairs of nodes; at one pair; the bound at a node
SET_WAVE, SPREAD_WAVE = 15.0, 125.0


@dataclass(frozen=True)
class GridBox:
    """The water that a grid covers, in translating earth axes relative to the ship [m].

    From `x_low` to `x_high` and `y_low` to `y_high`, down to `depth` below the instantaneous surface.
    Raises PanelsimError unless all are finite, in this order, and the depth is above 0.
    """

    x_low: float
    x_high: float
    y_low: float
    y_high: float
    depth: float

    def __post_init__(self) -> None:
        values = (self.x_low, self.x_high, self.y_low, self.y_high, self.depth)
        ordered = self.x_low < self.x_high and self.y_low < self.y_high and self.depth > 0.0
        if not (np.isfinite(values).all() and ordered):
            raise PanelsimError(
                "The box of a wave grid is none",
                got=f"x {self.x_low} to {self.x_high}, y {self.y_low} to {self.y_high}, depth {self.depth} m",
                allowed="finite lengths, each low end below its high end, depth above 0",
            )

    @property
    def centre(self) -> FloatArray:
        """Centre (2,) [m]."""
        return np.array([self.x_low + self.x_high, self.y_low + self.y_high]) / 2.0

    @property
    def width(self) -> FloatArray:
        """Extent along x and y (2,) [m]."""
        return np.array([self.x_high - self.x_low, self.y_high - self.y_low])


@dataclass(frozen=True)
class Axis:
    """Evenly spaced nodes, symmetric about the centre of the box; `spacing` h [m]."""

    spacing: float
    nodes: int

    @property
    def half(self) -> FloatArray:
        """Where the nodes of the upper half lie, from the outermost inwards [m]."""
        return np.asarray(self.spacing * (0.5 * (self.nodes - 1) - np.arange((self.nodes + 1) // 2)))

    def mode_step(self, oversampling: float) -> float:
        """Step between the wavenumbers of the Fourier modes of the axis [rad/m]."""
        return float(np.pi / (oversampling * self.half[0]))


@dataclass(frozen=True)
class DepthSeries:
    """exp(k d) for d from -`depth` to 0 as `terms` Chebyshev polynomials in v = exp(`rate` d).

    Interpolation at the Chebyshev extrema, so that it is exact at the surface, where exp(k d) = 1 and all
    polynomials are 1: the elevation has no error from the depth. `rate` [1/m], `depth` [m].
    """

    depth: float
    terms: int
    rate: float

    @property
    def lowest(self) -> float:
        """v at the greatest depth."""
        return float(np.exp(-self.rate * self.depth))

    def argument(self, d: FloatArray) -> FloatArray:
        """v scaled to -1 .. 1."""
        return np.asarray((2.0 * np.exp(self.rate * d) - 1.0 - self.lowest) / (1.0 - self.lowest))

    def coefficients(self, wavenumber: FloatArray) -> FloatArray:
        """ψ_c(k) (K, terms) of wavenumbers (K,) [rad/m]."""
        extrema = np.cos(np.pi * np.arange(self.terms) / (self.terms - 1))
        v = 0.5 * (1.0 + self.lowest) + 0.5 * (1.0 - self.lowest) * extrema
        values = v ** (wavenumber[:, None] / self.rate)
        return np.asarray(np.linalg.solve(chebyshev.chebvander(extrema, self.terms - 1), values.T).T, float)

    def error(self, wavenumber: FloatArray, weight: FloatArray) -> float:
        """Largest rms error over the depth, of waves with these shares of the energy."""
        d = -self.depth * np.linspace(0.0, 1.0, 129)
        series = self.coefficients(wavenumber) @ chebyshev.chebvander(self.argument(d), self.terms - 1).T
        squares = (series - np.exp(wavenumber[:, None] * d)) ** 2
        return float(np.sqrt((weight @ squares).max()))


@dataclass(frozen=True)
class GridPlan:
    """A grid as it would be: `kind` "line" or "plane", spline degree, axes, depth series.

    `direction` (2,) is the unit vector of the first axis in translating earth axes; a line has one node
    along the second. `modes` (2,) are its Fourier modes, spaced for waves to spread over; a line has the
    waves themselves.
    """

    kind: str
    degree: int
    direction: FloatArray
    x: Axis
    y: Axis
    modes: tuple[int, int]
    oversampling: float
    depth: DepthSeries

    def cost(self, point_count: int, wave_count: int) -> float:
        """Estimate of one fill and so many points [ns]."""
        groups, wide = np.ceil(len(self.x.half) / NODES_TOGETHER), self.depth.terms / TERM_COUNTS[0]
        order = self.degree + 1
        cost = wide * self.modes[0] * groups * self.y.nodes * SUM_X
        cost += self.x.nodes * self.y.nodes * NODE + wave_count * SET_WAVE
        if self.kind == "line":
            return float(cost + point_count * (LINE_POINT + wide * order * LINE_NODE))
        cost += wide * self.modes[0] * self.modes[1] * len(self.y.half) * SUM_Y
        cost += wide * wave_count * SPREAD_WAVE
        return float(cost + point_count * (PLANE_POINT + wide * order**2 * PLANE_NODE))


def choose_method(
    point_count: int, waves: WaveTables, box: GridBox, tolerance: float = DEFAULT_TOLERANCE
) -> str:
    """The cheapest of "direct", "line" and "plane" for a sea at so many points, by measured costs.

    Raises PanelsimError for a tolerance outside 1e-7 to 1e-2.
    """
    _require_tolerance(tolerance)
    wave_count = len(waves.amplitude)
    # Even without a fill a grid costs that much a point.
    least = (LINE_POINT + 4 * LINE_NODE) / DIRECT
    if wave_count < least or waves.second_order or not np.any(waves.amplitude):
        return "direct"
    try:
        plan = plan_grid(waves, box, tolerance, point_count)
    except GridTooLarge:
        return "direct"
    return plan.kind if plan.cost(point_count, wave_count) < DIRECT * point_count * wave_count else "direct"


class GridTooLarge(PanelsimError):
    """The waves are so short, or the box so wide, that a grid would have too many nodes."""


def plan_grid(
    waves: WaveTables,
    box: GridBox,
    tolerance: float = DEFAULT_TOLERANCE,
    point_count: int = 2500,
    *,
    degrees: tuple[int, ...] = DEGREES,
) -> GridPlan:
    """The cheapest grid within the tolerance: a line where all waves run along one direction, else a plane.

    Elevation and wave head stay within `tolerance` of the significant amplitude. `point_count` is how many
    points a fill serves. Raises PanelsimError for Stokes waves, for a sea without waves, for a tolerance
    outside 1e-7 to 1e-2, and GridTooLarge.
    """
    _require_griddable(waves, tolerance)
    depth = depth_series(waves, box.depth, SHARE * tolerance)
    plans = [_plan_of_degree(waves, box, tolerance, degree, depth) for degree in degrees]
    best = min(plans, key=lambda plan: plan.cost(point_count, len(waves.amplitude)))
    if best.x.nodes * best.y.nodes > MOST_NODES:
        raise GridTooLarge(
            "The wave grid would have too many nodes",
            got=f"{best.x.nodes} x {best.y.nodes}, every {best.x.spacing:.2g} x {best.y.spacing:.2g} m",
            allowed=f"at most {MOST_NODES}",
            remedy="sum the waves directly, or take a smaller box or a larger tolerance",
        )
    return best


def _plan_of_degree(
    waves: WaveTables, box: GridBox, tolerance: float, degree: int, depth: DepthSeries
) -> GridPlan:
    allowed, energy = SHARE * tolerance, waves.amplitude**2 / np.sum(waves.amplitude**2)
    oversampling = window_oversampling(allowed)
    direction = common_direction(waves)
    if direction is not None:
        line = _axis(waves.wavenumber, energy, float(np.abs(direction) @ box.width), degree, allowed)
        modes = (len(energy), 1)
        return GridPlan("line", degree, direction, line, Axis(1.0, 1), modes, oversampling, depth)
    kx, ky, _ = reflected(waves)
    x, y = (
        _axis(np.abs(k), energy, float(width), degree, allowed)
        for k, width in zip((kx, ky), box.width, strict=True)
    )
    counts = [int(np.ptp(k) / axis.mode_step(oversampling)) + WINDOW + 1 for k, axis in ((kx, x), (ky, y))]
    forward = np.array([1.0, 0.0])
    return GridPlan("plane", degree, forward, x, y, (counts[0], counts[1]), oversampling, depth)


def window_oversampling(allowed: float) -> float:
    """How much closer than Nyquist's step the Fourier modes must be for rms errors of waves within `allowed`.

    The error of a Kaiser-Bessel window of w modes falls as exp(-π w √(1 - 1/s)); measured at the ends of the
    box, where it is largest, it is 20 to 40 times that.
    """
    return float(1.0 / (1.0 - (np.log(allowed / 40.0) / (np.pi * WINDOW)) ** 2))


def common_direction(waves: WaveTables) -> FloatArray | None:
    """Unit vector (2,) along which all waves run, one way or the other; None where they differ."""
    vectors = np.column_stack([waves.wavenumber_x, waves.wavenumber_y])
    longest = vectors[np.argmax(waves.wavenumber)]
    length = np.hypot(*longest)
    if length == 0.0:
        return np.array([1.0, 0.0])
    across = vectors @ [-longest[1], longest[0]] / length
    # What the sine and cosine of one and the same heading may differ by; over 100 m it shifts no phase.
    if (np.abs(across) > 1e-12 * length).any():
        return None
    return np.asarray(longest / length)


def reflected(waves: WaveTables) -> tuple[FloatArray, FloatArray, FloatArray]:
    """kx, ky [rad/m], turned so that kx is not below 0, and the signs ±1: cos θ = cos(-θ)."""
    sign = np.where(waves.wavenumber_x < 0.0, -1.0, 1.0)
    return sign * waves.wavenumber_x, sign * waves.wavenumber_y, sign


def aliasing(step: FloatArray, degree: int) -> FloatArray:
    """Largest error of a wave of height 1 on a spline, `step` = |k| h below π: the sum over its aliases."""
    n = 2.0 * np.pi * np.arange(1, 6)[:, None]  # the next ones are below 1e-3 of the first
    order = degree + 1
    return np.asarray(((step / (n - step)) ** order + (step / (n + step)) ** order).sum(axis=0))


def depth_series(waves: WaveTables, depth: float, allowed: float) -> DepthSeries:
    """The fewest terms, at their best rate, with an rms error within `allowed`, down to `depth` [m].

    Where even the most terms are too few the series reaches less deep.
    """
    energy = waves.amplitude**2 / np.sum(waves.amplitude**2)
    # The error is smooth in k: so many bins say as much as thousands of waves.
    edges = np.linspace(0.0, max(waves.wavenumber.max(), 1e-9), 65)
    weight = np.histogram(waves.wavenumber, edges, weights=energy)[0]
    k, weight = edges[1:][weight > 0.0], weight[weight > 0.0]
    while True:
        for terms in TERM_COUNTS:
            series = _best_rate(depth, terms, k, weight)
            if series.error(k, weight) <= allowed:
                return series
        depth *= 0.8


def _best_rate(depth: float, terms: int, k: FloatArray, weight: FloatArray) -> DepthSeries:
    def log_error(log_rate: float) -> float:
        error = DepthSeries(depth, terms, float(np.exp(log_rate))).error(k, weight)
        return float(np.log(error + 1e-16))

    # 20 steps find the minimum, which is flat, to 1 %.
    bounds = (np.log(0.2 / depth), np.log(4.0 / depth))
    best = minimize_scalar(log_error, bounds=bounds, method="bounded", options={"maxiter": 20})
    return DepthSeries(depth, terms, float(np.exp(best.x)))


def _axis(rate: FloatArray, energy: FloatArray, width: float, degree: int, allowed: float) -> Axis:
    """The widest spacing at which the rms aliasing of waves with rates |k| [rad/m] is allowed."""

    def excess(spacing: float) -> float:
        return float(np.sqrt(energy @ aliasing(rate * spacing, degree) ** 2) / allowed - 1.0)

    # Two radians a node at most: three nodes a wave.
    widest = min(width, 2.0 / rate.max()) if rate.any() else width
    spacing = widest
    if excess(widest) > 0.0:
        spacing = 0.998 * brentq(excess, 1e-6 * widest, widest, rtol=1e-3)  # on the safe side of the root
    return Axis(float(spacing), int(width / spacing) + degree + 1)


def _require_griddable(waves: WaveTables, tolerance: float) -> None:
    _require_tolerance(tolerance)
    if waves.second_order:
        raise PanelsimError(
            "A Stokes wave goes on no grid",
            got="second order",
            allowed="waves of first order",
            remedy="sum it directly: one wave costs less so",
        )
    if not np.any(waves.amplitude):
        raise PanelsimError(
            "Calm water goes on no grid",
            got=f"{len(waves.amplitude)} waves of no height",
            remedy="sum it directly",
        )


def _require_tolerance(tolerance: float) -> None:
    number = isinstance(tolerance, float | int | np.floating) and not isinstance(tolerance, bool)
    if not (number and LEAST_TOLERANCE <= tolerance <= LARGEST_TOLERANCE):
        raise PanelsimError(
            "The tolerance of the wave grid is out of range",
            got=repr(tolerance)[:60],
            allowed=f"{LEAST_TOLERANCE:g} to {LARGEST_TOLERANCE:g} of the significant amplitude",
        )
