"""The load of the wet hull between stations: its triangles cut at planes x = constant, nothing lost."""

import numpy as np

from panelsim.conventions import FloatArray, IntArray
from panelsim.kernels.wet_part import WetPart, area_vectors, cut_triangles, linear_loads, uniform_loads

ON_STATION = 1e-12  # of the hull's reach along x: a point this near to a station stands on it


def section_loads(wet: WetPart, stations: FloatArray) -> FloatArray:
    """Force and moment (S, 6) about the origin of the pressure between stations (S + 1,) along x [N, N m].

    Stations rise [m], in ship axes. Pressure is linear on the pieces as on their triangles, so the integral
    is exact and the sections add up to the load. The bend of the pressure acts at the centre of its
    panel whatever piece it is on, as in the load. A triangle that stands exactly on a station counts for
    the section forward of it, on the last one for the section aft.
    """
    x = _put_on_stations(wet.corners[..., 0], stations)
    triangle, section = _overlaps(x, stations)
    values = np.concatenate([wet.corners, np.stack([wet.pressure, x], axis=-1)], axis=-1)[triangle]
    values, origin = _part_beyond(values, stations[section], 1.0)
    triangle, section = triangle[origin], section[origin]
    values, origin = _part_beyond(values, stations[section + 1], -1.0)
    triangle, section = triangle[origin], section[origin]
    corners = values[..., :3]
    bent = wet.bend[triangle, None] * uniform_loads(area_vectors(corners), wet.centre[triangle])
    loads = wet.weight[triangle, None] * (linear_loads(corners, values[..., 3]) + bent)
    total = np.zeros((len(stations) - 1, 6))
    np.add.at(total, section, loads)
    return total


def _put_on_stations(x: FloatArray, stations: FloatArray) -> FloatArray:
    """The x (T, 3) [m] of corners, those within rounding of a station exactly on it.

    Else a transverse area, whose x differ by rounding, would be cut along its middle, and half of it
    lost beyond the last station.
    """
    after = np.clip(np.searchsorted(stations, x), 1, len(stations) - 1)
    before = after - 1
    nearest = np.where(x - stations[before] < stations[after] - x, stations[before], stations[after])
    return np.where(np.abs(x - nearest) <= ON_STATION * np.abs(x).max(initial=0.0), nearest, x)


def _overlaps(x: FloatArray, stations: FloatArray) -> tuple[IntArray, IntArray]:
    """Triangle and section of every pair that may share area; `x` (T, 3) of the corners [m]."""
    low, high = x.min(axis=1), x.max(axis=1)
    sections = len(stations) - 1
    first = np.searchsorted(stations, low, side="right") - 1
    first[(low == stations[-1]) & (high == low)] = sections - 1
    last = np.maximum(np.searchsorted(stations, high, side="left") - 1, first)
    first, last = np.maximum(first, 0), np.minimum(last, sections - 1)
    count = np.maximum(last - first + 1, 0)
    triangle = np.repeat(np.arange(len(x)), count)
    section = np.arange(len(triangle)) + np.repeat(first - np.cumsum(count) + count, count)
    return triangle, section


def _part_beyond(values: FloatArray, station: FloatArray, sense: float) -> tuple[FloatArray, IntArray]:
    """Parts (Q, 3, 5) of triangles (T, 3, 5) where sense (x - station) is not negative; whose they are.

    The values at the corners are position, pressure, and the x that decides.
    """
    level = sense * (values[..., 4] - station[:, None])
    inside = level >= 0.0
    whole = np.flatnonzero(inside.all(axis=1))
    tips, of_tip, rests, of_rest = cut_triangles(values, values, level, inside)
    # Pressure is linear here, so one split of a quadrilateral is as good as the other.
    parts = [values[whole], tips, rests[:, [0, 1, 2]], rests[:, [0, 2, 3]]]
    return np.concatenate(parts), np.concatenate([whole, of_tip, of_rest, of_rest])
