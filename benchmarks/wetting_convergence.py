"""Errors of the wetted-surface load over panel size. Run: python benchmarks/wetting_convergence.py [--write]

A Wigley hull in four meshes, each twice as fine as the one before, in sixteen states of a short-crested sea.
Two errors apart: of the rule, against the same flat facets in finer triangles; and of the facets, against
the smooth hull. Both are rms over the states, in parts of the largest load of the waves of each kind.
Three rules: whole panels wet or dry by their centre, as in TM 2003-190, and the two that cut panels at the
surface. `--write` puts table and plot into reports/.
"""

import argparse
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import numpy as np
import trimesh

from panelsim.conventions import RULES, FloatArray, IntArray
from panelsim.kernels.pressure import wetted_surface_load
from panelsim.kernels.tables import PanelTables, WaveTables, panel_tables, wave_tables
from panelsim.ship.bundled import load_ship

REPORT = Path(__file__).parents[1] / "reports" / "wetting_convergence.md"
DENSITY, GRAVITY = 1000.0, 9.80665
LENGTH, BEAM, DRAFT, DEPTH, KG = 120.0, 15.0, 5.0, 11.0, 6.5  # m
ROWS = (4, 8, 16, 32)  # of panels a side; about 20, 5, 1.3 and 0.33 m2
SMOOTH_ROWS = (48, 96)  # extrapolated to the smooth hull
COARSE, FINE = 8, 20  # rows for somewhat more than 5 and less than 1 m2
FACETS, VERTEX, CENTRE, PANEL = "facets", "vertex", "vertex+centre", "panel"
NAMES = {FACETS: "flat facets", PANEL: "whole panels", VERTEX: "vertex", CENTRE: "vertex + centre"}
DEG = np.pi / 180
ATTITUDES = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 2.0, 0.3, 25 * DEG, 2 * DEG, 8 * DEG],
        [0.0, 0.0, -0.5, -40 * DEG, -2 * DEG, 0.0],
        [0.0, 0.0, -5.0, 10 * DEG, 3 * DEG, 0.0],  # deck submerged
        [0.0, 0.0, 1.0, 3 * DEG, -6 * DEG, 0.0],  # bow out of the water
        [0.0, 0.0, 1.0, -5 * DEG, 6 * DEG, 0.0],  # stern out of the water
        [2.0, -1.0, 0.5, 12 * DEG, 1 * DEG, -10 * DEG],
        [0.0, 1.0, -1.0, -15 * DEG, -1 * DEG, 100 * DEG],
    ]
)
POSES = np.array([[t + 7.0 * i, 1.0, *a] for t in (3.0, 40.0) for i, a in enumerate(ATTITUDES)])


@dataclass(frozen=True)
class Hull:
    """A mesh in ship axes and the water it floats in at rest."""

    vertices: FloatArray
    panels: IntArray
    waterline: float

    @cached_property
    def tables(self) -> PanelTables:
        return panel_tables(self.vertices, self.panels)

    @property
    def mean_area(self) -> float:
        """Mean area of the panels [m2]; of a warped one, that of its area vector."""
        area_vector = self.tables.response[PANEL][self.tables.first_centre :, :3]
        return float(np.linalg.norm(area_vector, axis=1).sum() / len(self.panels))

    def load(self, rule: str, poses: FloatArray = POSES) -> FloatArray:
        """Load (B, 6) [N, N m] by one of the rules."""
        water = {"waterline": self.waterline, "water_density": DENSITY, "gravity": GRAVITY}
        return wetted_surface_load(self.tables, sea(), poses, rule=rule, **water)

    def split(self) -> "Hull":
        """The same facets, each of the four triangles of a panel in four."""
        tables = self.tables
        centre = tables.first_centre + np.arange(len(tables.panels))
        corner, following = tables.panels, np.roll(tables.panels, -1, axis=1)
        fan = np.stack([np.repeat(centre[:, None], 4, axis=1), corner, following], axis=2).reshape(-1, 3)
        fan = fan[fan[:, 1] != fan[:, 2]]  # of triangles one has no area
        vertices, faces = trimesh.remesh.subdivide(tables.points, fan)
        return Hull(vertices, faces[:, [0, 1, 2, 2]], self.waterline)


def wigley(rows: int) -> Hull:
    """Wigley hull, wall-sided above the water, in 4 rows columns of `rows` panels a side, decked."""
    s, z = np.linspace(-1, 1, 4 * rows + 1)[:, None], DEPTH * np.linspace(0, 1, rows + 1)
    half_breadth = BEAM / 2 * (1 - s**2) * (1 - np.maximum(1 - z / DRAFT, 0) ** 2)
    port = np.stack(np.broadcast_arrays(LENGTH / 2 * s, half_breadth, z - KG), axis=-1)
    deck = np.stack([port[:, -1] * [1, t, 1] for t in np.linspace(-1, 1, rows + 1)], axis=1)
    vertices, panels = [], []
    for sheet in (port.swapaxes(0, 1), port * [1, -1, 1], deck):
        index = np.arange(sheet[..., 0].size).reshape(sheet.shape[:2]) + sum(map(len, vertices))
        corners = (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
        panels.append(np.stack(corners, axis=-1).reshape(-1, 4))
        vertices.append(sheet.reshape(-1, 3))
    return Hull(np.concatenate(vertices), np.concatenate(panels), DRAFT - KG)


def halifax(area: float) -> Hull:
    """The ship of TM 2003-190 Table 2 in panels of `area` m2."""
    ship = load_ship("halifax", area)
    return Hull(ship.vertices, ship.mesh.panels, ship.waterline)


@cache
def sea() -> WaveTables:
    """19 waves of 4 m significant height from the port bow at 20 knots, none shorter than 36 m."""
    random = np.random.default_rng(19)
    omega = np.linspace(0.35, 1.3, 19)
    heading = 150 * DEG + random.uniform(-1.0, 1.0, len(omega))
    amplitude = omega**-2.5 * np.exp(-0.625 * (0.6 / omega) ** 4)
    amplitude *= np.sqrt(2.0 / (amplitude**2).sum())
    k = omega**2 / GRAVITY
    encounter = omega - 10.29 * k * np.cos(heading)
    return wave_tables(amplitude, k, heading, encounter, random.uniform(0, 2 * np.pi, len(omega)))


def dynamic_load(hull: Hull) -> FloatArray:
    """Largest load (6,) of the waves over the states, of each kind."""
    still = POSES * (np.arange(8) != 1)
    return np.abs(hull.load(CENTRE) - hull.load(CENTRE, still)).max(axis=0)


def rms(difference: FloatArray, scale: FloatArray) -> FloatArray:
    """Rms over the states (6,) in parts of the dynamic load."""
    return np.sqrt((difference**2).mean(axis=0)) / scale


def rule_errors(hull: Hull) -> dict[str, FloatArray]:
    """Error (6,) of each rule on the facets of a hull, against vertex + centre on the facets split further.

    A panel becomes sixteen triangles, on which that rule errs by some 1/30 of its error on the panel.
    """
    exact, scale = hull.split().load(CENTRE), dynamic_load(hull)
    return {rule: rms(hull.load(rule) - exact, scale) for rule in RULES}


def smooth_load(poses: FloatArray = POSES) -> FloatArray:
    """Load (B, 6) of the smooth Wigley hull, extrapolated from two fine meshes.

    The facets err with the square of their size.
    """
    coarse, fine = (wigley(rows).load(CENTRE, poses) for rows in SMOOTH_ROWS)
    return fine + (fine - coarse) / ((SMOOTH_ROWS[1] / SMOOTH_ROWS[0]) ** 2 - 1.0)


def facet_errors(hulls: list[Hull]) -> list[FloatArray]:
    """Error (6,) of the flat facets of Wigley hulls against the smooth one."""
    smooth, scale = smooth_load(), dynamic_load(wigley(SMOOTH_ROWS[0]))
    return [rms(hull.load(CENTRE) - smooth, scale) for hull in hulls]


@dataclass(frozen=True)
class Convergence:
    """Errors (R, 6) by their names over meshes of `size` (R,), the root of the mean panel area [m]."""

    panels: list[int]
    size: FloatArray
    errors: dict[str, FloatArray]

    def together(self, name: str) -> FloatArray:
        """Rms over the six loads (R,)."""
        return np.sqrt((self.errors[name] ** 2).mean(axis=1))

    def order(self, name: str) -> float:
        """Slope of the error over the panel size."""
        return float(np.polyfit(np.log(self.size), np.log(self.together(name)), 1)[0])


def measure() -> Convergence:
    """All errors over the refinements of the Wigley hull."""
    hulls = [wigley(rows) for rows in ROWS]
    by_rule = [rule_errors(hull) for hull in hulls]
    errors = {rule: np.array([found[rule] for found in by_rule]) for rule in RULES}
    errors[FACETS] = np.array(facet_errors(hulls))
    area = np.array([hull.mean_area for hull in hulls])
    return Convergence([len(hull.panels) for hull in hulls], np.sqrt(area), errors)


def coarse_and_fine() -> dict[str, tuple[FloatArray, FloatArray]]:
    """Of two ships, the rule errors (6,): vertex + centre on panels of 5 m2, whole panels on 1 m2."""
    pairs = {"Wigley": (wigley(COARSE), wigley(FINE)), "halifax": (halifax(5.0), halifax(1.0))}
    return {
        name: (rule_errors(coarse)[CENTRE], rule_errors(fine)[PANEL])
        for name, (coarse, fine) in pairs.items()
    }


def report(found: Convergence, pairs: dict[str, tuple[FloatArray, FloatArray]]) -> str:
    """The tables and what belongs to them, in Markdown."""
    meshes = " | ".join(
        f"{count} panels, {size**2:.2g} m²" for count, size in zip(found.panels, found.size, strict=True)
    )
    lines = [
        "# Convergence of the wetted-surface load in panel size",
        "",
        "Wigley hull of 120 x 15 x 5 m, sixteen states (upright; heeled to 40°; deck under water; bow and"
        " stern out of the water) in 19 short-crested waves, 4 m significant height. Rms over states and"
        " loads, in parts of the largest load of the waves of each kind. The error of a rule is against the"
        " same facets; that of the facets is against the smooth hull, on which all vertices lie here"
        " (panelsim's own panelling moves some outside to keep section areas).",
        "",
        f"| error of | {meshes} | order |",
        "|---|" + "---:|" * (len(found.panels) + 1),
    ]
    for name, told in NAMES.items():
        row = " | ".join(f"{error:.1e}" for error in found.together(name))
        lines.append(f"| {told} | {row} | {found.order(name):.2f} |")
    lines += [
        "",
        "Vertex + centre on panels of about 5 m² against whole panels of about 1 m², rule errors alone:",
        "",
        "| hull | rule, panels | surge | sway | heave | roll | pitch | yaw |",
        "|---|---|" + "---:|" * 6,
    ]
    for name, errors in pairs.items():
        for told, each in zip(("vertex + centre, 5 m²", "whole panels, 1 m²"), errors, strict=True):
            lines.append(f"| {name} | {told} | {' | '.join(f'{error:.1e}' for error in each)} |")
    lines += ["", "Flat facets, not the rule, are the main error where panels are cut at the surface."]
    return "\n".join(lines) + "\n"


def plot(found: Convergence, path: Path) -> None:
    """Errors over panel size, both on logarithmic scales."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axis = pyplot.subplots(figsize=(6.0, 4.5))
    for name, told in NAMES.items():
        style = "--" if name == FACETS else "-"
        label = f"{told}, order {found.order(name):.2f}"
        axis.loglog(found.size, found.together(name), style, marker="o", label=label)
    axis.set(xlabel="root of the mean panel area [m]", ylabel="rms error / largest load of the waves")
    axis.set_xticks(found.size, [f"{size:.2g}" for size in found.size])
    axis.minorticks_off()
    axis.grid(visible=True, alpha=0.4)
    axis.legend(fontsize="small")
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description="Errors of the wetted-surface load over panel size.")
    parser.add_argument(
        "--write", action="store_true", help=f"write {REPORT.name} and its plot into reports/"
    )
    options = parser.parse_args()
    found = measure()
    text = report(found, coarse_and_fine())
    print(text)
    if options.write:
        REPORT.parent.mkdir(exist_ok=True)
        picture = REPORT.with_suffix(".png")
        plot(found, picture)
        REPORT.write_text(f"{text}\n![Errors over panel size]({picture.name})\n")
        print(f"Wrote {REPORT} and {picture}")


if __name__ == "__main__":
    main()
