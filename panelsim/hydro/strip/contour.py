"""The elements of a section's outline: where potentials are known and integrals are taken."""

from dataclasses import dataclass

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.strip.sections import Section

# Elements to the shortest wave length; the coefficients are then good to about 1 %.
ELEMENTS_PER_WAVE_LENGTH = 4.0
_CORNER = np.deg2rad(30.0)  # an outline that turns by more keeps the point where it does
FEWEST_ELEMENTS, MOST_ELEMENTS = 8, 1000


@dataclass(frozen=True, eq=False)
class Contour:
    """Elements of the outline of one section, from starboard round the keel to port.

    `centre` (N, 2): y to port, z up [m] in ship axes; `chord` (N, 2) [m]: the straight line that an element
    is, 0 where it is a point of a quadrature; `length` (N,) [m], or the weight of that point; `normal`
    (N, 2): unit vectors into the water. `waterline`: height of the water at rest [m] in ship axes.
    """

    centre: FloatArray
    chord: FloatArray
    length: FloatArray
    normal: FloatArray
    waterline: float

    def __post_init__(self) -> None:
        for array in (self.centre, self.chord, self.length, self.normal):
            array.setflags(write=False)

    @classmethod
    def of_nodes(cls, nodes: FloatArray, waterline: float) -> "Contour":
        """Straight elements between nodes (N + 1, 2) [m] in ship axes."""
        chord = np.diff(nodes, axis=0)
        length = np.hypot(*chord.T)
        normal = np.stack([chord[:, 1], -chord[:, 0]], axis=1) / length[:, None]
        return cls(0.5 * (nodes[1:] + nodes[:-1]), chord, length, normal, waterline)

    @property
    def modes(self) -> FloatArray:
        """Normal velocities (3, N) of unit sway, heave and roll about the origin of ship axes."""
        y, z = self.centre.T
        n2, n3 = self.normal.T
        return np.stack([n2, n3, y * n3 - z * n2])

    def exponential(self, k_y: FloatArray, k_z: FloatArray) -> ComplexArray:
        """∫ exp(k_z (z - waterline) + i k_y y) dl (..., N) over each element, exact.

        Wavenumbers (...) [1/m].
        """
        by_y, by_z = 1j * np.asarray(k_y)[..., None], np.asarray(k_z)[..., None]
        y, z = self.centre.T
        growth = by_y * self.chord[:, 0] + by_z * self.chord[:, 1]
        # sinh(a)/a with a = growth / 2, and numpy's sinc(t) = sin(πt)/(πt)
        mean: ComplexArray = np.exp(by_y * y + by_z * (z - self.waterline)) * np.sinc(0.5j / np.pi * growth)
        return mean * self.length


def contour_nodes(section: Section, count: int) -> FloatArray:
    """Ends (count + 1, 2) [m] of straight elements of nearly equal length that keep the section's corners.

    Those of a symmetric section mirror each other exactly. `count` is even.
    """
    if not isinstance(count, int | np.integer) or count % 2 or not FEWEST_ELEMENTS <= count <= MOST_ELEMENTS:
        raise PanelsimError(
            "The number of elements round a section does not suit",
            got=count,
            allowed=f"an even number from {FEWEST_ELEMENTS} to {MOST_ELEMENTS}",
        )
    if not section.symmetric:
        return _subdivided(section.points, count)
    keel = section.along(np.array(0.5)) * [0.0, 1.0]
    half_way = 0.5 * section.arc[-1]
    port = np.vstack([keel, section.points[section.arc > half_way * (1.0 + 1e-9)]])
    side = _subdivided(port, count // 2)
    return np.vstack([side[:0:-1] * [-1.0, 1.0], side])


def highest_frequency(contour: Contour, gravity: float) -> float:
    """The frequency [rad/s] up to which the elements resolve the wave length."""
    shortest = ELEMENTS_PER_WAVE_LENGTH * float(contour.length.max())
    return float(np.sqrt(2.0 * np.pi * gravity / shortest))


def _subdivided(points: FloatArray, count: int) -> FloatArray:
    """Nodes (count + 1, 2) along a polyline, its corners among them, the pieces between in equal parts."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    corners = _corners(points, count)
    lengths = np.diff(arc[corners])
    parts = _shares(lengths, count)
    s = np.concatenate(
        [
            np.linspace(arc[a], arc[b], n, endpoint=False)
            for a, b, n in zip(corners, corners[1:], parts, strict=False)
        ]
        + [arc[-1:]]
    )
    return np.stack([np.interp(s, arc, c) for c in points.T], axis=-1)


def _corners(points: FloatArray, count: int) -> list[int]:
    """Indices of the ends of a polyline and of its sharpest corners, half as many at most as elements."""
    chord = np.diff(points, axis=0) @ np.array([1.0, 1.0j])
    turn = np.abs(np.angle(chord[1:] / chord[:-1]))
    sharpest = np.argsort(turn)[::-1][: max(count // 2 - 1, 0)]
    inner = [int(i) + 1 for i in sharpest if turn[i] > _CORNER]
    return sorted({0, len(points) - 1, *inner})


def _shares(lengths: FloatArray, count: int) -> list[int]:
    """Parts to each of some lengths, one at least, `count` in all, so that the longest part is short."""
    parts = np.ones(len(lengths), dtype=int)
    for _ in range(count - len(lengths)):
        parts[int(np.argmax(lengths / parts))] += 1
    return parts.tolist()
