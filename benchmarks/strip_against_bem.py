"""Strip theory against three dimensions on the frigate. Run: python benchmarks/strip_against_bem.py [--write]

Added mass, damping, diffraction and motions of the 120 m frigate by both sources of coefficients, at 0 and
20 knots in head and bow quartering seas, with and without transom terms, and what strips cost. `--write`
puts the page and its plots into reports/.
"""

import argparse
import time
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt

import panelsim
from panelsim.conventions import DOF_NAMES, KNOT, ComplexArray, Dof, FloatArray
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.memory import memory_functions
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.speed_terms import radiation_at_speed
from panelsim.hydro.store import database_for
from panelsim.hydro.strip.database import solve_strips
from panelsim.hydro.strip.mesh_sections import sections_of_mesh
from panelsim.hydro.transom import Transom
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.supplementary import Supplementary
from panelsim.response.response import response
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.dispersion import encounter_frequency, wavenumber
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

REPORTS = Path(__file__).parents[1] / "reports"
COLOURS = {"bem": "black", "strip": "tab:red"}
NAMES = {"bem": "three dimensions", "strip": "strips"}
PAIRS = ((2, 2), (4, 4), (2, 4), (1, 1), (3, 3), (5, 5))
LATERAL, VERTICAL = (Dof.SWAY, Dof.ROLL, Dof.YAW), (Dof.HEAVE, Dof.PITCH)
OMEGA = np.arange(0.2, 1.425, 0.025)  # rad/s
ROLL_DAMPING = 7e6  # N m s, 5 % of critical
CASES = [(knots, heading) for knots in (0, 20) for heading in (180, 135)]


def waves(heading: float) -> WaveComponents:
    count = len(OMEGA)
    return WaveComponents(np.ones(count), OMEGA, np.full(count, heading), np.zeros(count))


def motions(
    ship: Ship, database: HydroDatabase, heading: float, speed: float, transom: Transom | None = None
) -> ComplexArray:
    """Motions (M, 6) per metre of wave, exp(+iω_e t), of the ship with 5 % of roll damping."""
    beta = np.full(len(OMEGA), heading)
    encounter = encounter_frequency(OMEGA, beta, speed, ship.gravity)
    load = froude_krylov_transfer(ship, waves(heading)) + diffraction_load(
        database, OMEGA, beta, speed, transom
    )
    impedance = radiation_at_speed(database, encounter, speed, transom).impedance
    impedance = impedance + ship.hydrostatics.stiffness - encounter[:, None, None] ** 2 * ship.inertia
    impedance[:, Dof.ROLL, Dof.ROLL] += 1j * encounter * ROLL_DAMPING
    return np.asarray(np.linalg.solve(impedance, load[..., None])[..., 0])


def per_wave(ship: Ship, found: ComplexArray) -> FloatArray:
    """Amplitudes over wave amplitude, rotations over wave slope."""
    k = wavenumber(OMEGA, ship.gravity)[:, None]
    return np.abs(found) / np.where(np.arange(6) < 3, 1.0, k)


def plot_coefficients(sources: dict[str, HydroDatabase]) -> None:
    figure, axes = plt.subplots(len(PAIRS), 2, figsize=(9, 14), sharex=True, layout="constrained")
    for row, (i, j) in zip(axes, PAIRS, strict=True):
        for axis, name, letter in zip(row, ("added_mass", "radiation_damping"), "AB", strict=True):
            for source, database in sources.items():
                values = getattr(database, name)[:, i, j]
                axis.plot(database.frequencies, values, color=COLOURS[source], label=NAMES[source])
            axis.set_title(f"${letter}_{{{i + 1}{j + 1}}}$, SI units", fontsize=9)
            axis.set_xlim(0.0, 2.6)
            axis.grid(alpha=0.3)
    for axis in axes[-1]:
        axis.set_xlabel("frequency [rad/s]")
    axes[0, 0].legend()
    figure.savefig(REPORTS / "strip_theory_coefficients.png", dpi=110)


def plot_by_wave(
    name: str, curves: dict[tuple[int, int], dict[str, FloatArray]], units: tuple[str, str], per: str
) -> None:
    """Amplitudes (M, 6) of every mode and case; a name that ends in "transom" is drawn dotted.

    `per` is the title: what they are divided by.
    """
    figure, axes = plt.subplots(5, len(CASES), figsize=(13, 13), layout="constrained")
    for column, case in enumerate(CASES):
        # Head seas move a symmetric ship in her plane of symmetry only.
        shown = VERTICAL if case[1] == 180 else (*VERTICAL, *LATERAL)
        for axis in axes[len(shown) :, column]:
            axis.set_axis_off()
        for axis, dof in zip(axes[:, column], shown, strict=False):
            for label, values in curves[case].items():
                source = label.split(",")[0]
                style = ":" if label.endswith("transom") else "-"
                text = label.replace(source, NAMES[source])
                axis.plot(OMEGA, values[:, dof], style, color=COLOURS[source], label=text)
            axis.set_ylim(bottom=0.0)
            axis.grid(alpha=0.3)
            axis.set_ylabel(f"{DOF_NAMES[dof]} [{units[dof > 2]}]", fontsize=8)
        axes[0, column].set_title(f"{case[0]} knots, {case[1]}°")
        axes[len(shown) - 1, column].set_xlabel("wave frequency [rad/s]")
    handles, labels = axes[0, -1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(handles))
    figure.suptitle(per)
    figure.savefig(REPORTS / f"strip_theory_{name}.png", dpi=110)


def coefficient_table(sources: dict[str, HydroDatabase]) -> list[str]:
    lines = ["| pair | A: 0.3 | 0.6 | 0.9 | 1.2 | 1.8 | B: 0.3 | 0.6 | 0.9 | 1.2 | 1.8 |", "|---" * 11 + "|"]
    at = (0.3, 0.6, 0.9, 1.2, 1.8)
    for i, j in PAIRS:
        shares = []
        for name in ("added_mass", "radiation_damping"):
            strip, bem = (between(d, name, i, j, np.array(at)) for d in (sources["strip"], sources["bem"]))
            shares += [f"{a / b:.2f}" for a, b in zip(strip, bem, strict=True)]
        lines.append(f"| {i + 1}{j + 1} | {' | '.join(shares)} |")
    return lines


def between(database: HydroDatabase, name: str, i: int, j: int, at: FloatArray) -> FloatArray:
    """A coefficient at frequencies between the stored ones, as a power of the frequency from one to the next.

    Damping in long waves grows as ω⁸ in yaw: straight lines between steps of 0.1 rad/s are twice too high.
    """
    stored, values = database.frequencies[1:], getattr(database, name)[1:, i, j]
    sign = np.sign(np.interp(at, stored, values))
    return np.asarray(sign * np.exp(np.interp(np.log(at), np.log(stored), np.log(np.abs(values)))))


def motions_in_a_sea(name: str) -> list[str]:
    """RMS by strips over that in three dimensions of a ship with and without her own springs."""
    ship = load_ship(name)
    sources = {"bem": database_for(ship), "strip": HydroDatabase.compute(ship, "strip")}
    critical = 2.0 * np.sqrt(
        (ship.inertia[3, 3] + sources["bem"].added_mass_zero[3, 3]) * ship.hydrostatics.stiffness[3, 3]
    )
    settings: dict[str, dict[str, Any]] = {
        "springs": {"supplementary": Supplementary.of(ship)},
        "without": {"roll_damping": RollDampingTerms(0.05 * critical)},
    }
    headings = (30, 60, 90, 120, 135, 150, 180)
    order = (*VERTICAL, Dof.ROLL, Dof.YAW)
    lines = [
        "| speed, heading | "
        + " | ".join(f"{DOF_NAMES[d]}, {springs}" for springs in settings for d in order)
        + " |",
        "|---" * 9 + "|",
    ]
    shares = []
    for given in settings.values():
        strip, bem = (
            response(
                ship,
                sources[source],
                frequencies=[0.5],
                wave_headings=np.radians(headings),
                speeds=[0.0, 20 * KNOT],
                **given,
            )
            .rms(Bretschneider(7.5, 15.0))
            .values
            for source in ("strip", "bem")
        )
        moving = bem > 1e-6 * np.nanmax(bem)
        shares.append(np.where(moving, strip / np.where(moving, bem, 1.0), np.nan)[..., order])
    for i, knots in enumerate((0, 20)):
        for h, heading in enumerate(headings):
            cells = ["-" if np.isnan(v) else f"{v:.2f}" for share in shares for v in share[i, h]]
            lines.append(f"| {knots} knots, {heading}° | {' | '.join(cells)} |")
    return lines


def difference_table(curves: dict[tuple[int, int], dict[str, ComplexArray]]) -> list[str]:
    """Largest |strips - three dimensions| of complex amplitudes over the peak of each mode, in per cent."""
    order = (*VERTICAL, *LATERAL)
    lines = ["| speed, heading | " + " | ".join(DOF_NAMES[d] for d in order) + " |", "|---" * 6 + "|"]
    for (knots, heading), by in curves.items():
        cells = []
        for dof in order:
            peak = np.abs(by["bem"][:, dof]).max()
            shown = peak > 1e-6 * np.abs(by["bem"]).max() and not (heading == 180 and dof in LATERAL)
            worst = np.abs(by["strip"] - by["bem"])[:, dof].max()
            cells.append(f"{100 * worst / peak:.1f} %" if shown else "-")
        lines.append(f"| {knots} knots, {heading}° | {' | '.join(cells)} |")
    return lines


def convergence(ship: Ship, reference: HydroDatabase) -> list[str]:
    """Heave and pitch of 11 to 81 sections against the finest, at 1 rad/s."""
    index = int(np.searchsorted(reference.frequencies, 1.0))
    found = {}
    for count in (11, 21, 41, 81):
        sections = sections_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, count)
        data = solve_strips(
            sections,
            water_density=ship.water_density,
            gravity=ship.gravity,
            frequencies=reference.frequencies[: index + 1],
        )
        a, b = data.added_mass.values[-1], data.radiation_damping.values[-1]
        found[count] = np.array([a[2, 2], b[2, 2], a[4, 4], b[4, 4], a[5, 5]])
    lines = ["| sections | A33 | B33 | A55 | B55 | A66 |", "|---" * 6 + "|"]
    for count in (11, 21, 41):
        cells = [f"{100 * e:+.2f} %" for e in found[count] / found[81] - 1.0]
        lines.append(f"| {count} | {' | '.join(cells)} |")
    return lines


def transom_table(ship: Ship, sources: dict[str, HydroDatabase]) -> list[str]:
    lines = ["| source | A33 | B33 | A55 | B55 | B22 | B66 |", "|---" * 7 + "|"]
    for source, database in sources.items():
        transom = Transom.of_ship(ship, database.frequencies)
        speed, one = 20 * KNOT, np.array([1.0])
        bare, more = (radiation_at_speed(database, one, speed, t) for t in (None, transom))
        cells = []
        for name, dof in (("a", 2), ("b", 2), ("a", 4), ("b", 4), ("b", 1), ("b", 5)):
            values = [
                (c.damping if name == "b" else c.added_mass - c.stiffness)[0, dof, dof] for c in (bare, more)
            ]
            cells.append(f"{100 * (values[1] / values[0] - 1.0):+.1f} %")
        lines.append(f"| {NAMES[source]} | {' | '.join(cells)} |")
    return lines


def cost(ship: Ship) -> tuple[float, HydroDatabase]:
    spent = []
    for _ in range(3):
        begin = time.process_time()
        database = HydroDatabase.compute(ship, "strip")
        spent.append(time.process_time() - begin)
    return min(spent), database


def page(ship: Ship, sources: dict[str, HydroDatabase], seconds: float, sections: list[str]) -> str:
    memory = memory_functions(sources["strip"])
    strip = sources["strip"]
    return "\n".join(
        [
            "# Strip theory against three dimensions",
            "",
            f"panelsim {panelsim.__version__}, `python benchmarks/strip_against_bem.py --write`."
            f" The 120 m frigate, {ship.mass / 1e3:.0f} t: {strip.dataset.attrs['solver']},"
            f" {len(strip.frequencies)} frequencies to {strip.frequencies[-1]:g} rad/s, in {seconds:.1f} s of"
            " one core; three dimensions are the bundled database ("
            f"{sources['bem'].dataset.attrs['solver']}).",
            "",
            *sections,
            "",
            "## Memory",
            "",
            "A and B made again from the retardation functions of the strips miss by"
            f" {100 * memory.rebuilt_added_mass.max():.1f} and {100 * memory.rebuilt_damping.max():.1f} % of"
            " the peak at most (3 % are allowed).",
            "",
        ]
    )


def comparisons(ship: Ship, sources: dict[str, HydroDatabase], found: dict[str, dict]) -> list[str]:
    lowest = sources["strip"].dataset.attrs["lowest_strip_frequency"]
    return [
        "## Coefficients at rest, strips over three dimensions, by frequency [rad/s]",
        "",
        *coefficient_table(sources),
        "",
        f"Below {lowest:.2f} rad/s (k L = 2) heave and pitch are led to rest. Strips know no interaction"
        " along the hull: in waves longer than the ship pitch has too little added mass and too much damping."
        " Surge has none of either.",
        "",
        "![coefficients](strip_theory_coefficients.png)",
        "",
        "## Diffraction loads: largest difference over the peak of each mode",
        "",
        *difference_table(found["diffraction"]),
        "",
        "![diffraction](strip_theory_diffraction.png)",
        "",
        "## Motions: largest difference over the peak of each mode",
        "",
        "Rotations over wave slope; 5 % of critical roll damping is added; complex amplitudes, phases count.",
        "",
        *difference_table(found["motions"]),
        "",
        "![motions](strip_theory_motions.png)",
        "",
        "## RMS of HALIFAX in a sea of 7.5 m and 15 s, strips over three dimensions",
        "",
        "With her own springs and dampers in surge, sway, roll and yaw, and without, but with 5 % of critical"
        " roll damping.",
        "",
        *motions_in_a_sea("halifax"),
        "",
        "At rest the yaw spring of HALIFAX resonates near 0.5 rad/s, where strips have several times the yaw"
        " damping of three dimensions: there roll and yaw in oblique seas are far too small.",
        "",
        "## What the transom terms add at 20 knots and 1 rad/s of encounter",
        "",
        *transom_table(ship, sources),
        "",
        "## Number of sections, against 81",
        "",
        *convergence(ship, sources["strip"]),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--write", action="store_true", help="write reports/strip_theory.md and its plots")
    arguments = parser.parse_args()
    ship = load_ship("frigate")
    seconds, strip = cost(ship)
    sources = {"bem": database_for(ship), "strip": strip}
    found: dict[str, dict] = {"diffraction": {}, "motions": {}}
    drawn: dict[tuple[int, int], dict[str, FloatArray]] = {}
    k = wavenumber(OMEGA, ship.gravity)[:, None]
    for case in CASES:
        speed, heading = case[0] * KNOT, np.radians(case[1])
        moved = {s: motions(ship, d, heading, speed) for s, d in sources.items()}
        found["motions"][case] = {s: m / np.where(np.arange(6) < 3, 1.0, k) for s, m in moved.items()}
        load = partial(
            diffraction_load, frequency=OMEGA, wave_heading=np.full(len(OMEGA), heading), speed=speed
        )
        found["diffraction"][case] = {s: load(d) for s, d in sources.items()}
        drawn[case] = {s: per_wave(ship, m) for s, m in moved.items()}
        if speed > 0.0:
            for s, d in sources.items():
                transom = Transom.of_ship(ship, d.frequencies)
                drawn[case][f"{s}, transom"] = per_wave(ship, motions(ship, d, heading, speed, transom))
    text = page(ship, sources, seconds, comparisons(ship, sources, found))
    print(text)
    if arguments.write:
        REPORTS.mkdir(exist_ok=True)
        plot_coefficients(sources)
        loads = {c: {s: np.abs(v) for s, v in by.items()} for c, by in found["diffraction"].items()}
        plot_by_wave("diffraction", loads, ("N", "N m"), "per metre of wave amplitude")
        plot_by_wave("motions", drawn, ("m/m", "rad/rad"), "per wave amplitude and slope")
        (REPORTS / "strip_theory.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
