"""Sections of a ship below the water at rest: polylines in ship axes, checked to close."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError, require_kind
from panelsim.seaway.checks import real_numbers, require_number

FEWEST_SECTIONS = 5
_ON_THE_WATERLINE = 1e-6  # share of a section's size within which its ends lie on the water
_SYMMETRIC = 1e-5  # share of a section's size within which its two sides are mirror images
_REPEATED = 1e-9  # share of a section's size within which points are one


@dataclass(frozen=True, eq=False)
class Section:
    """The wet outline of a ship at one station.

    `x` [m] in ship axes. `points` (P, 2): y to port and z up [m] in ship axes, from the waterline on the
    starboard side round the keel to the waterline on the port side; the outline of a part that lies
    wholly under water (a bulb) runs the same way round and ends where it began, and is kept from the highest
    point on the centreline on, if it has one. `waterline`: height of the water at rest in ship axes [m].
    Raises PanelsimError for an outline that does not close.
    """

    x: float
    points: FloatArray
    waterline: float

    def __post_init__(self) -> None:
        require_number("x of a section", self.x, "m")
        require_number("waterline of a section", self.waterline, "m")
        where = f"The section at x = {self.x:g} m"
        points = real_numbers(f"outline of the section at x = {self.x:g} m", self.points)
        if points.ndim != 2 or points.shape[1:] != (2,) or len(points) < 3:
            raise PanelsimError(
                f"{where} has too few points", got=points.shape, allowed="three or more pairs of y and z"
            )
        if not np.isfinite(points).all():
            raise PanelsimError(f"{where} is not given in finite numbers", got=points.tolist())
        height = points[:, 1] - self.waterline
        tolerance = _ON_THE_WATERLINE * float(np.ptp(points, axis=0).max())
        closed = bool(np.hypot(*(points[-1] - points[0])) <= tolerance and height.max() < -tolerance)
        ends = np.abs(height[[0, -1]])
        if not closed and ends.max() > tolerance:
            raise PanelsimError(
                f"{where} does not close: it does not end at the water on both sides",
                got=f"ends {ends[0]:.3g} and {ends[1]:.3g} m from the waterline",
                allowed=f"within {tolerance:.1g} m",
                remedy="carry the section up to the waterline, or mend the hole in the hull",
            )
        if height[1:-1].max() > tolerance:
            raise PanelsimError(
                f"{where} rises out of the water between its ends",
                got=f"{height.max():.3g} m above the water",
                allowed="one body below the water at each station",
            )
        points[-1 if closed else [0, -1], 1] = points[0, 1] if closed else self.waterline
        if closed:
            points = _from_the_centreline(points)
        points.setflags(write=False)
        object.__setattr__(self, "points", points)
        if self.area <= tolerance**2 or self.breadth < 0.0:
            raise PanelsimError(
                f"{where} encloses no water, or runs the wrong way round",
                got=f"area {self.area:.3g} m2, breadth {self.breadth:.3g} m",
                allowed="points from starboard round the keel to port",
            )

    @property
    def submerged(self) -> bool:
        """True where the section lies wholly under water."""
        return bool(self.points[0, 1] < self.waterline)

    @property
    def breadth(self) -> float:
        """Breadth at the waterline [m]."""
        return float(self.points[-1, 0] - self.points[0, 0])

    @property
    def draft(self) -> float:
        """Depth of the lowest point [m]."""
        return float(self.waterline - self.points[:, 1].min())

    @cached_property
    def area(self) -> float:
        """Area under water [m2]."""
        y, z = self.points[:, 0], self.points[:, 1] - self.waterline
        return float(0.5 * np.sum(y[:-1] * z[1:] - y[1:] * z[:-1]))

    @cached_property
    def symmetric(self) -> bool:
        """True where starboard mirrors port about y = 0."""
        tolerance = _SYMMETRIC * float(np.ptp(self.points, axis=0).max())
        middle = 0.5 * (self.points[0, 0] + self.points[-1, 0])
        if abs(middle) > tolerance:
            return False
        share = np.linspace(0.0, 1.0, 101)
        port, starboard = self.along(share), self.along(1.0 - share) * [-1.0, 1.0]
        return bool(np.abs(port - starboard).max() <= tolerance)

    @cached_property
    def arc(self) -> FloatArray:
        """Length along the outline up to each point (P,) [m]."""
        steps = np.hypot(*np.diff(self.points, axis=0).T)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def along(self, share: FloatArray) -> FloatArray:
        """Points (..., 2) at shares of the length of the outline, 0 to starboard and 1 to port."""
        s = np.asarray(share) * self.arc[-1]
        return np.stack([np.interp(s, self.arc, c) for c in self.points.T], axis=-1)


@dataclass(frozen=True, eq=False)
class HullSections:
    """The sections of a ship, from the stern forward, and the ends of its wet hull.

    `aft_end`, `fore_end`: x [m] in ship axes, beyond all sections or at the outermost.
    Raises PanelsimError for fewer than five sections, or sections out of order.
    """

    sections: tuple[Section, ...]
    aft_end: float
    fore_end: float

    def __post_init__(self) -> None:
        require_kind("list of sections", self.sections, Sequence, "a sequence of Section")
        for section in self.sections:
            require_kind("section", section, Section, "a Section")
        require_number("aft end", self.aft_end, "m")
        require_number("fore end", self.fore_end, "m")
        if len(self.sections) < FEWEST_SECTIONS:
            raise PanelsimError(
                "There are too few sections for strip theory",
                got=len(self.sections),
                allowed=f"{FEWEST_SECTIONS} or more below the water; 20 to 40 are usual",
            )
        x = [self.aft_end, *self.x, self.fore_end]
        if not (np.diff(self.x) > 0.0).all() or not (np.diff(x) >= 0.0).all():
            raise PanelsimError(
                "The sections are not ordered along the hull",
                got=[round(float(station), 3) for station in x],
                allowed="x from the stern forward, each once, between the ends of the wet hull",
            )

    @cached_property
    def x(self) -> FloatArray:
        """Stations (S,) [m] in ship axes."""
        return np.array([section.x for section in self.sections])

    @cached_property
    def strip_length(self) -> FloatArray:
        """Length of hull (S,) [m] that each section stands for: half-way to its neighbours, or to the end."""
        edges = np.concatenate([[self.aft_end], 0.5 * (self.x[1:] + self.x[:-1]), [self.fore_end]])
        return np.diff(edges)


def section_from_offsets(
    x: float,
    half_breadth: Sequence[float] | FloatArray,
    height: Sequence[float] | FloatArray,
    waterline: float,
) -> Section:
    """A section, port and starboard alike, from half-breadths and heights (P,) [m], keel to deck.

    Ship axes; a first half-breadth above 0 is the edge of a flat bottom. Raises PanelsimError for a
    section that is dry, or whose last point lies below the waterline.
    """
    port = np.array([half_breadth, height], dtype=np.float64).T
    if port.ndim != 2 or not np.isfinite(port).all() or (port[:, 0] < 0.0).any():
        raise PanelsimError(
            f"The offsets at x = {x:g} m are not half-breadths and heights",
            got=port.tolist(),
            allowed="as many finite heights as half-breadths, none of these negative",
        )
    wet = port[:, 1] < waterline
    if not wet.any() or wet.all():
        raise PanelsimError(
            f"The section at x = {x:g} m does not cross the water at rest",
            got=f"heights {port[:, 1].min():.3g} to {port[:, 1].max():.3g} m, water at {waterline:.3g} m",
            allowed="a lowest point below the water and a last point above it",
        )
    last = int(np.flatnonzero(wet)[-1])
    below, above = port[last], port[last + 1]
    end = below + (waterline - below[1]) / (above[1] - below[1]) * (above - below)
    side = _without_repeats(np.vstack([port[: last + 1], end]))
    starboard = side[::-1] * [-1.0, 1.0]
    return Section(x, _without_repeats(np.vstack([starboard, side])), waterline)


def sections_from_offsets(stations: Sequence[FloatArray], waterline: float) -> HullSections:
    """Sections from the stations of an offset table, (P, 3) each: x, half-breadth, height, keel to deck.

    Ship axes [m]; a station that trim has inclined counts at its mean x. Stations that lie wholly above the
    water are left out. The outermost wet stations are the ends of the hull. Raises PanelsimError for stations
    that are no such rows, and as `section_from_offsets` and `HullSections` do.
    """
    require_number("waterline", waterline, "m")
    wet = [station for station in _stations(stations) if np.min(station[:, 2]) < waterline]
    sections = [
        section_from_offsets(float(s[:, 0].mean()), s[:, 1], s[:, 2], waterline)
        for s in sorted(wet, key=lambda s: float(s[:, 0].mean()))
    ]
    ends = (sections[0].x, sections[-1].x) if sections else (0.0, 0.0)
    return HullSections(tuple(sections), *ends)


def _stations(stations: Sequence[FloatArray]) -> list[FloatArray]:
    """Stations (P, 3) of numbers; PanelsimError for what is none."""
    allowed = "a sequence of stations, (P, 3) each: x, half-breadth and height [m]"
    require_kind("table of offsets", stations, Sequence | np.ndarray, allowed)
    rows = [real_numbers("station of the table of offsets", station) for station in stations]
    for row in rows:
        if row.ndim != 2 or row.shape[1] != 3 or not len(row):
            raise PanelsimError("A station is not rows of three numbers", got=row.shape, allowed=allowed)
    return rows


def _from_the_centreline(points: FloatArray) -> FloatArray:
    """The same closed outline (P, 2) from its highest crossing of y = 0 on; as it is where there is none."""
    y, z = points.T
    crossing = np.flatnonzero((y[:-1] * y[1:] <= 0.0) & (y[:-1] != y[1:]))
    if not crossing.size:
        return points
    height = (z[:-1] * y[1:] - z[1:] * y[:-1])[crossing] / (y[1:] - y[:-1])[crossing]
    first = int(crossing[np.argmax(height)])
    top = np.array([[0.0, height.max()]])
    beside = points[first : first + 2]
    distance = np.hypot(*(beside - top).T)
    if distance.min() <= _REPEATED * np.ptp(points, axis=0).max():
        # It is the crossing itself: were it left out for that, the outline would move.
        top = beside[[np.argmin(distance)]]
    turned = _without_repeats(np.vstack([top, points[first + 1 : -1], points[: first + 1], top]))
    turned[-1] = turned[0]
    return turned


def _without_repeats(points: FloatArray) -> FloatArray:
    moves = np.hypot(*np.diff(points, axis=0).T) > _REPEATED * np.ptp(points, axis=0).max()
    return points[np.concatenate([[True], moves])]
