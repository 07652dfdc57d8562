"""Readers of users' meshes: units and axes are always said, never guessed."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from panelsim.conventions import FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.hull.gdf import FOOT, read_gdf
from panelsim.hull.obj import read_obj
from panelsim.hull.panel_mesh import PanelMesh

LENGTH_UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "ft": FOOT, "in": FOOT / 12.0}  # m
SUFFIXES = (".stl", ".obj", ".ply", ".glb", ".gdf")
SAME_POINT = 1e-6  # of the largest extent of the mesh: closer vertices are one point
SHORTEST_SHIP, LONGEST_SHIP = 0.1, 1000.0  # m
STL_HEADER, STL_TRIANGLE = 84, 50  # bytes of a binary STL before its triangles, and a triangle


def read_mesh(
    path: str | Path,
    *,
    length_unit: str | float,
    up: str,
    forward: str,
    origin: ArrayLike = (0.0, 0.0, 0.0),
    symmetry: str | None = None,
) -> PanelMesh:
    """Read a hull surface from an STL, OBJ, PLY, GLB or GDF file into hull axes.

    length_unit: "m", "cm", "mm", "ft", "in" or the metres in one file unit. up, forward: the file axes that
    point up and to the bow, "x" to "-z"; port is up x forward. origin (3,): where midships, centreline and
    baseline meet, in file coordinates and file units (a GDF whose z = 0 is the waterline has it at
    (0, 0, -draft)). symmetry "centreline": the file holds one side of the hull and is mirrored in y = 0; a
    GDF says so itself (ISX, ISY).

    Vertices closer than 1e-6 of the largest extent are merged and unused ones left out; nothing else is
    mended, so ask check_mesh whether the surface is closed and its normals point outward. Raises
    PanelsimError for a file that is missing, of an unknown kind, empty, cut short or without a surface, for
    axes or units that make no sense, and for a ship shorter than 0.1 m or longer than 1000 m.
    """
    metres = _metres_per_unit(length_unit)
    axes = _hull_axes(up, forward)
    file_origin = np.array(origin, dtype=float)
    if file_origin.shape != (3,) or not np.isfinite(file_origin).all():
        raise PanelsimError("origin is not a point", got=origin, allowed="three finite numbers in file units")
    if symmetry not in (None, "centreline"):
        raise PanelsimError("Unknown symmetry", got=repr(symmetry), allowed='None or "centreline"')

    path = Path(path)
    points, panels = _read_surface(path, metres)
    if len(panels) == 0:
        raise PanelsimError(f"{path.name} holds no surface", got="no faces")
    if not np.isfinite(points).all():
        bad = int(np.sum(~np.isfinite(points).all(axis=1)))
        raise PanelsimError(f"{path.name} has vertices that are not numbers", got=f"{bad} of {len(points)}")
    vertices = metres * (points - file_origin) @ axes.T
    _require_ship_length(path, points[panels.ravel()] @ axes[0], metres)
    if symmetry == "centreline":
        vertices, panels = _mirrored(path, vertices, panels)
    vertices, panels = _merged(vertices, panels)
    return PanelMesh(vertices, _triangles_by_third_corner(panels))


def to_trimesh(vertices: FloatArray, triangles: IntArray) -> Any:
    """A trimesh.Trimesh of vertices (V, 3) and triangles (T, 3), exactly as given."""
    import trimesh

    return trimesh.Trimesh(vertices, triangles, process=False)


def _metres_per_unit(length_unit: str | float) -> float:
    metres = LENGTH_UNITS.get(length_unit) if isinstance(length_unit, str) else float(length_unit)
    if metres is None or not (np.isfinite(metres) and metres > 0.0):
        raise PanelsimError(
            "Unknown length unit",
            got=repr(length_unit),
            allowed=", ".join(LENGTH_UNITS) + " or the metres in one file unit, above 0",
        )
    return metres


def _hull_axes(up: str, forward: str) -> FloatArray:
    """Rows forward, port, up (3, 3) in file axes: the matrix that turns file axes into hull axes."""
    units = {sign + name: row for name, row in zip("xyz", np.eye(3), strict=True) for sign in ("", "+")}
    units |= {f"-{name}": -units[name] for name in "xyz"}
    for key, name in (("up", up), ("forward", forward)):
        if name not in units:
            raise PanelsimError(f"Unknown axis for {key}", got=repr(name), allowed="x, y, z, -x, -y or -z")
    if up[-1] == forward[-1]:
        raise PanelsimError(
            "Up and forward lie along the same file axis",
            got=f"up {up!r}, forward {forward!r}",
            allowed="two different axes",
        )
    return np.array([units[forward], np.cross(units[up], units[forward]), units[up]])


def _read_surface(path: Path, metres: float) -> tuple[FloatArray, IntArray]:
    """Vertices (V, 3) in file units and axes, and panels (N, 4), of a file of any known kind."""
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise PanelsimError(
            f"{path.name} is not a kind of mesh file that panelsim reads",
            got=path.suffix or "no suffix",
            allowed=", ".join(SUFFIXES),
        )
    if not path.is_file():
        raise PanelsimError("There is no such mesh file", got=path)
    if path.stat().st_size == 0:
        raise PanelsimError(f"{path.name} is empty", got="0 bytes")
    if suffix == ".gdf":
        return read_gdf(path, metres)
    if suffix == ".obj":
        return read_obj(path)
    return _read_triangles(path, suffix)


def _read_triangles(path: Path, suffix: str) -> tuple[FloatArray, IntArray]:
    """Triangles of an STL, PLY or GLB file, all bodies of a scene together in scene axes."""
    import trimesh

    content = path.read_bytes()
    if suffix == ".stl":
        _require_whole_stl(path, content)
    elif suffix == ".ply":
        _require_whole_text_ply(path, content)
    try:
        scene = trimesh.load_scene(trimesh.util.wrap_as_stream(content), file_type=suffix[1:], process=False)
        surface = scene.to_mesh()
    except Exception as error:  # trimesh raises whatever its parsers raise
        raise PanelsimError(
            f"{path.name} cannot be read; it may be damaged or cut short",
            got=f"{type(error).__name__}: {error}",
        ) from error
    triangles = np.array(surface.faces, dtype=np.int64).reshape(-1, 3)
    return np.array(surface.vertices, dtype=float).reshape(-1, 3), triangles[:, [0, 1, 2, 2]]


def _require_whole_stl(path: Path, content: bytes) -> None:
    """Refuse an STL file that ends early: trimesh would take it for an empty one."""
    announced = STL_HEADER + STL_TRIANGLE * int.from_bytes(content[80:84], "little")
    if len(content) == announced:
        return
    if content.lstrip()[:5].lower() != b"solid":
        raise PanelsimError(
            f"{path.name} is cut short or not an STL file",
            got=f"{len(content)} bytes",
            allowed=f"{announced} bytes by its header, or text that begins with 'solid'",
        )
    if not content.rstrip().splitlines()[-1].strip().lower().startswith(b"endsolid"):
        raise PanelsimError(f"{path.name} is cut short", got="no 'endsolid' at its end")


def _require_whole_text_ply(path: Path, content: bytes) -> None:
    """Refuse a text PLY file with fewer lines than its header announces: trimesh would read the rest."""
    header, _, body = content.partition(b"end_header")
    if b"format ascii" not in header:
        return
    words = [line.split() for line in header.splitlines() if line.startswith(b"element")]
    announced = sum(int(count) for _, _, count in words)
    lines = len(body.split(b"\n", 1)[-1].splitlines())
    if lines < announced:
        raise PanelsimError(
            f"{path.name} is cut short", got=f"{lines} lines after its header", allowed=f"{announced} lines"
        )


def _require_ship_length(path: Path, along: FloatArray, metres: float) -> None:
    """Refuse a length that betrays a wrong unit; along: positions along the ship in file units."""
    extent = float(np.ptp(along))
    if not SHORTEST_SHIP <= extent * metres <= LONGEST_SHIP:
        raise PanelsimError(
            f"{path.name} would be no ship of a likely length; the unit or the forward axis may be wrong",
            got=f"{extent:g} file units of {metres:g} m make {extent * metres:g} m",
            allowed=f"{SHORTEST_SHIP:g} to {LONGEST_SHIP:g} m",
        )


def _mirrored(path: Path, vertices: FloatArray, panels: IntArray) -> tuple[FloatArray, IntArray]:
    """Both sides of a hull given one side, in hull axes."""
    port, starboard = vertices[:, 1].max(), -vertices[:, 1].min()
    if min(port, starboard) > SAME_POINT * np.ptp(vertices, axis=0).max():
        raise PanelsimError(
            f"{path.name} holds more than one side of the hull and cannot be mirrored",
            got=f"{port:.4g} m to port and {starboard:.4g} m to starboard",
            remedy="leave out symmetry, or set the origin on the centreline",
        )
    image = vertices * np.array([1.0, -1.0, 1.0])
    both = np.concatenate([panels, panels[:, ::-1] + len(vertices)])
    return np.concatenate([vertices, image]), both


def _merged(vertices: FloatArray, panels: IntArray) -> tuple[FloatArray, IntArray]:
    """Join vertices that lie together, keeping the first of each, and leave out unused ones."""
    used, panels = np.unique(panels, return_inverse=True)
    vertices = vertices[used]
    count = len(vertices)
    tolerance = SAME_POINT * np.ptp(vertices, axis=0).max()
    pairs = cKDTree(vertices).query_pairs(tolerance, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    _, label = connected_components(links, directed=False)
    _, first, label = np.unique(label, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))  # number the joined vertices in their order in the file
    return vertices[np.sort(first)], rank[label][panels.reshape(-1, 4)]


def _triangles_by_third_corner(panels: IntArray) -> IntArray:
    """Turn quadrilaterals with one pair of equal neighbouring corners so that the third repeats."""
    panels = panels.copy()
    equal = panels == np.roll(panels, -1, axis=1)
    rows = np.flatnonzero(equal.sum(axis=1) == 1)
    order = (np.arange(4) + equal[rows].argmax(axis=1)[:, None] - 2) % 4
    panels[rows] = np.take_along_axis(panels[rows], order, axis=1)
    return panels
