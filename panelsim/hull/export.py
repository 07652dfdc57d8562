"""Writer of meshes for other programs."""

from pathlib import Path

import numpy as np

from panelsim.conventions import IntArray
from panelsim.errors import PanelsimError
from panelsim.files import replacing
from panelsim.hull.gdf import gdf_text
from panelsim.hull.obj import obj_text
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.readers import SUFFIXES, to_trimesh

GLTF_AXES = (1, 2, 0)  # glTF has y up and z forward, so x to port: hull (y, z, x)


def write_mesh(mesh: PanelMesh, path: str | Path) -> None:
    """Write a mesh in metres to an STL, OBJ, PLY, GLB or GDF file, by its suffix.

    Hull axes, except GLB, which turns to the y up, z forward of the glTF standard (read it back with
    up="y", forward="z"). OBJ and GDF keep quadrilaterals and every digit; the others hold triangles in
    single precision, each quadrilateral split along its shorter diagonal. Raises PanelsimError for an
    unknown suffix and a folder that does not exist.
    """
    path = Path(path)
    require_mesh_target(path)
    with replacing(path) as beside:
        beside.write_bytes(_content(mesh, path.suffix.lower()))


def require_mesh_target(path: Path) -> None:
    """Raise PanelsimError for an unknown suffix and a folder that does not exist."""
    if path.suffix.lower() not in SUFFIXES:
        raise PanelsimError(
            "A mesh cannot be written to this kind of file",
            got=path.suffix or f"no suffix in {path.name!r}",
            allowed=", ".join(SUFFIXES),
        )
    if not path.parent.is_dir():
        raise PanelsimError("There is no such folder to write to", got=path.parent)


def _content(mesh: PanelMesh, suffix: str) -> bytes:
    if suffix == ".gdf":
        return gdf_text(mesh).encode()
    if suffix == ".obj":
        return obj_text(mesh).encode()
    vertices = mesh.vertices[:, GLTF_AXES] if suffix == ".glb" else mesh.vertices
    content: bytes = to_trimesh(vertices, _shorter_diagonal(mesh)).export(file_type=suffix[1:])
    return content


def _shorter_diagonal(mesh: PanelMesh) -> IntArray:
    """Triangles (T, 3) of a mesh, which mirrors port and starboard alike."""
    a, b, c, d = mesh.panels.T
    x = mesh.vertices
    along_ac = np.linalg.norm(x[c] - x[a], axis=1) <= np.linalg.norm(x[d] - x[b], axis=1)
    along_ac |= c == d
    first = np.where(along_ac, [a, b, c], [a, b, d]).T
    second = np.where(along_ac, [a, c, d], [b, c, d]).T
    is_triangle = np.stack([np.ones_like(c, dtype=bool), c != d], axis=1)
    return np.stack([first, second], axis=1)[is_triangle]
