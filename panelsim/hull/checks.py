"""Is a mesh a sound hull: closed, outward, without bad panels, and fine enough for the waves."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull import mesh_faults as faults
from panelsim.hull.panel_mesh import PanelMesh

SAME_POINT = 1e-6  # of the mesh's largest extent: closer vertices are one point
PANELS_PER_WAVE = 8


@dataclass(frozen=True)
class MeshReport:
    """What check_mesh found. `problems` stop a run, `warnings` do not; both are sentences.

    `size` (3,) [m] is the extent in hull axes, `volume` [m3] the signed volume inside the surface (without
    meaning if it is open) and `area` [m2] that of all panels; `longest_panel` [m] is the largest extent of a
    panel along the hull.
    """

    panel_count: int
    vertex_count: int
    size: FloatArray
    area: float
    volume: float
    closed: bool
    outward: bool
    symmetric: bool
    component_count: int
    longest_panel: float
    problems: tuple[str, ...]
    warnings: tuple[str, ...]

    def summary(self) -> str:
        """The report as readable text."""
        length, beam, depth = self.size
        lines = [
            f"{self.panel_count} panels, {self.vertex_count} vertices, "
            f"{self.component_count} connected part{'' if self.component_count == 1 else 's'}",
            f"length {length:.4g} m, beam {beam:.4g} m, depth {depth:.4g} m, "
            f"area {self.area:.5g} m2, volume {self.volume:.6g} m3",
            f"closed: {_yes(self.closed)}   normals outward: {_yes(self.outward)}   "
            f"symmetric about the centreline: {_yes(self.symmetric)}",
            *(f"problem: {text}" for text in self.problems),
            *(f"warning: {text}" for text in self.warnings),
        ]
        return "\n".join(lines)


def check_mesh(mesh: PanelMesh, *, wave_length: float | None = None) -> MeshReport:
    """Check a mesh in hull axes and report; never raises.

    wave_length [m] is the shortest wave of the sea; panels longer than an eighth of it along the hull are
    named.
    """
    unreadable = faults.unreadable(mesh)
    if unreadable:
        return _report(mesh, problems=[unreadable])
    size = float(np.ptp(mesh.vertices, axis=0).max())
    degenerate = faults.degenerate_panels(mesh)
    component_count, component = faults.connected_parts(mesh)
    open_edges = faults.edge_problems(mesh)
    inside_out = faults.inside_out_parts(mesh, component_count, component)
    symmetric = faults.is_symmetric(mesh, SAME_POINT * size)
    longest = np.ptp(mesh.vertices[mesh.panels, 0], axis=1)

    problems = [
        *faults.named(
            "panels have no area, or corners that repeat other than the third as the fourth", degenerate
        ),
        *faults.named("panels repeat another panel", faults.duplicate_panels(mesh)),
        *open_edges,
        *inside_out,
    ]
    warnings = [
        *faults.shape_warnings(mesh, degenerate),
        *faults.vertex_warnings(mesh, SAME_POINT * size, open_edges),
    ]
    if not symmetric:
        warnings.append("the panels are not mirrored in the centreline plane y = 0")
    if wave_length is not None:
        too_long = np.flatnonzero(longest > wave_length / PANELS_PER_WAVE)
        text = f"panels are longer along the hull than 1/{PANELS_PER_WAVE} of the wave of {wave_length:g} m"
        warnings += faults.named(text, too_long)
    return _report(
        mesh,
        closed=not open_edges,
        outward=not inside_out,
        symmetric=symmetric,
        component_count=component_count,
        longest_panel=float(longest.max()),
        problems=problems,
        warnings=warnings,
    )


def require_sound(mesh: PanelMesh) -> None:
    """Raise PanelsimError with the problems that check_mesh finds, if any."""
    problems = check_mesh(mesh).problems
    if problems:
        raise PanelsimError(
            f"The mesh is not a sound hull: {problems[0]}",
            got="; ".join(problems[1:]) or None,
            allowed="a closed surface with outward normals and no degenerate panels",
            remedy="repair it in the program that made it; panelsim does not repair meshes",
        )


def _report(
    mesh: PanelMesh,
    *,
    problems: Sequence[str],
    warnings: Sequence[str] = (),
    closed: bool = False,
    outward: bool = False,
    symmetric: bool = False,
    component_count: int = 0,
    longest_panel: float = 0.0,
) -> MeshReport:
    measurable = component_count > 0
    return MeshReport(
        panel_count=len(mesh.panels),
        vertex_count=len(mesh.vertices),
        size=np.ptp(mesh.vertices, axis=0) if measurable else np.full(3, np.nan),
        area=float(mesh.area.sum()) if measurable else np.nan,
        volume=float(faults.volume_shares(mesh, mesh.vertices.mean(axis=0)).sum()) if measurable else np.nan,
        closed=closed,
        outward=outward,
        symmetric=symmetric,
        component_count=component_count,
        longest_panel=longest_panel,
        problems=tuple(problems),
        warnings=tuple(warnings),
    )


def _yes(value: bool) -> str:
    return "yes" if value else "no"
