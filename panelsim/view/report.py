"""A page about a run: what was run, what came out, and pictures of it."""

import json
from pathlib import Path

import numpy as np

from panelsim.conventions import KNOT
from panelsim.files import replacing
from panelsim.motion.history import History
from panelsim.results.statistics import Statistics, statistics
from panelsim.results.tables import point_markdown, statistics_markdown
from panelsim.view.plots import plot_loads, plot_motions, plot_spectra

OUTCOME_SENTENCES = {
    "finished": "The run went to its end.",
    "capsized": "The ship capsized, and the run ended there.",
    "diverged": "The motions grew beyond all bounds, and the run ended there.",
    "interrupted": "The run was interrupted.",
}

PICTURES = ("motions.png", "spectra.png", "loads.png")


def report(history: History, folder: str | Path) -> Path:
    """Write report.md and its figures into `folder` and return the path of the page.

    Everything comes from the history, so that a page can be made again from a saved run.
    """
    folder = Path(folder)
    for name, plot in zip(PICTURES, (plot_motions, plot_spectra, plot_loads), strict=True):
        plot(history, folder / name)
    path = folder / "report.md"
    with replacing(path) as beside:
        beside.write_text(_page(history), encoding="utf-8")
    return path


def _page(history: History) -> str:
    result = statistics(history)
    parts = [
        f"# {history.ship_name}: {_sea_in_short(history)}",
        f"{_outcome(history)} {result.note}".strip(),
        "## Motions",
        _motions_section(result),
        "![The waves and the six motions](motions.png)",
        "![Spectra of the waves and the motions](spectra.png)",
        _points_section(history, result),
        "## Loads",
        "RMS of every load about its mean, from the ramp to the end. Forces act in translating earth axes;"
        " moments are about the centre of gravity, conjugate to roll, pitch and yaw.",
        "![RMS of every load](loads.png)",
        "## What was run",
        _table(_facts(history)),
        "## Time spent",
        _table(_times(result)),
        _notes_section(history),
        "## Files",
        "`panelsim run` leaves beside this page: `history.nc` with everything on it, that is every motion and"
        " load at every step, the mesh, the loading and the waves; `statistics.json`, the table above for"
        " programs; and `run.rrd` to watch with `panelsim view run.rrd`.",
        _case_section(history),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _sea_in_short(history: History) -> str:
    waves, knots = history.components, history.attrs["speed"] / KNOT
    if not waves.count:
        return f"calm water, {knots:.1f} knots"
    kind = {"record": "recorded", "components": "given", "dataset": "random"}.get(
        history.seaway_attrs["kind"], history.seaway_attrs["kind"]
    )
    return f"{kind} waves, {_wave_height(history)}, {_heading_degrees(history):.0f} deg, {knots:.1f} knots"


def _outcome(history: History) -> str:
    detail = str(history.attrs["outcome_detail"])
    cause = f" {detail[0].upper()}{detail[1:]}." if detail else ""
    return f"**{OUTCOME_SENTENCES[history.outcome]}**{cause}"


def _motions_section(result: Statistics) -> str:
    height = result.significant_wave_height_realised
    text = f"From the ramp to the end, {result.duration:g} s. RMS about the mean."
    if height is not None:
        text += f" The waves that the ship met had a significant height of {height:.3g} m."
    signs = "Positive: forward, to port, up; starboard down, bow down, bow to port."
    return f"{text} {signs}\n\n{statistics_markdown(result)}".rstrip()


def _points_section(history: History, result: Statistics) -> str:
    if not result.points:
        return ""
    parts = [
        "## Points of the ship",
        "Along translating earth axes, without the mean speed and without gravity. The relative motion is"
        " the vertical displacement less the incident wave there: a point whose height at rest and relative"
        " motion add up to less than 0 is under water.",
    ]
    for name, motions in history.points.items():
        x, y, z = motions.attrs["point"]
        height = motions.attrs["height_above_water"]
        parts += [
            f"**{name}**: {x:g} m forward of midships, {y:g} m to port, {z:g} m above the baseline; at rest"
            f" {abs(height):.3g} m {'above' if height >= 0.0 else 'below'} the water.",
            point_markdown(result, name).rstrip(),
        ]
    return "\n\n".join(parts)


def _facts(history: History) -> dict[str, str]:
    loading, attrs = history.loading, history.attrs
    center, gyradii = loading["center_of_gravity"], loading["gyradii"]
    wet = history.mesh_vertices[history.panels][..., 2].mean(axis=1) < history.waterline
    return {
        "ship": f"{history.ship_name}, length {loading['length']:.5g} m, beam {loading['beam']:.4g} m",
        "draft at midships": f"{loading['draft']:.4g} m, {_trim(float(loading['trim']))}",
        "mass": f"{_mass(float(loading['mass']))} in water of {loading['water_density']:g} kg/m³",
        "centre of gravity": f"{abs(center[0]):.4g} m {'aft' if center[0] < 0 else 'forward'} of midships,"
        f" {center[2]:.4g} m above the baseline",
        "gyradii": "roll {:.4g} m, pitch {:.4g} m, yaw {:.4g} m".format(*gyradii),
        "mesh": f"{len(history.panels)} panels, {wet.sum()} of them in the water at rest",
        "sea": _sea(history),
        "wave heading": _heading(history),
        "speed": f"{attrs['speed']:.3f} m/s ({attrs['speed'] / KNOT:.2f} knots)",
        "model": str(attrs["model"]),
        "pressure on the hull": _pressure(history),
        "simulated": f"{attrs['simulated_seconds']:g} s, of it {attrs['ramp']:g} s of ramp",
        "time step": f"{attrs['time_step']:g} s",
        # Histories of panelsim 0.1 were all made with it.
        "stepper": str(attrs.get("stepper", "rk4")),
        "coefficients": str(attrs.get("coefficients", "not recorded")),
        "transom terms": str(attrs.get("transom_terms", "not recorded")),
        "inertia": _inertia(history),
        "roll damping": _roll_damping(history),
        "seed": str(attrs.get("seed", "none")),
        "panelsim": str(attrs["panelsim_version"]),
    }


def _pressure(history: History) -> str:
    """How the nonlinear load was found; histories of older versions do not say."""
    method, rule = (history.attrs.get(f"pressure_{name}", "none") for name in ("method", "rule"))
    if method == "none":
        return "that of the hull at rest" if history.attrs["model"] == "linear" else "not recorded"
    return f"method {method}, rule {rule}"


def _inertia(history: History) -> str:
    """Which inertia the run had; histories of older versions do not say."""
    inertia = str(history.attrs.get("inertia", "not recorded"))
    return {
        "large": "that of large angles: it turns with the ship",
        "linear": "that of small angles: constant",
    }.get(inertia, inertia)


def _roll_damping(history: History) -> str:
    """How the roll damping was found, as the case says, and its terms."""
    terms = str(history.attrs.get("roll_damping", "none"))
    section = json.loads(history.attrs["case"]).get("roll_damping", {})
    if terms == "none":
        return "none beside the supplementary one"
    found = {
        "ikeda": "Ikeda's components",
        "percent": f"{section.get('critical_percent', 0.0):g} % of critical",
        "terms": "given terms",
    }.get(section.get("method"), "given terms")
    degrees = section.get("linearised_at_deg")
    if degrees is not None and history.attrs["model"] == "linear":
        found += f", made linear at {degrees:g} deg"
    return f"{found}: {terms}"


def _trim(angle: float) -> str:
    degrees = abs(np.rad2deg(angle))
    return "no trim" if degrees < 5e-4 else f"trim {degrees:.3f} deg bow {'down' if angle > 0 else 'up'}"


def _mass(kilograms: float) -> str:
    return f"{kilograms:.4g} kg" if kilograms < 1000.0 else f"{kilograms / 1000:.1f} t"


def _sea(history: History) -> str:
    waves, attrs = history.components, history.seaway_attrs
    if not waves.count:
        return "calm water"
    low, high = waves.frequency.min(), waves.frequency.max()
    span = f"{low:.3g} rad/s" if low == high else f"{low:.3g} to {high:.3g} rad/s"
    parts = [attrs["kind"], f"{waves.count} component{'s' * (waves.count > 1)}", span, _wave_height(history)]
    return ", ".join([*parts, f"stretching {attrs['stretching']}"])


def _wave_height(history: History) -> str:
    waves = history.components
    if waves.count == 1:
        theory = ", Stokes second order" if waves.second_order else ""
        return f"height {2.0 * waves.amplitude[0]:.3g} m{theory}"
    return f"significant height {4.0 * np.sqrt(waves.variance):.3g} m"


def _heading(history: History) -> str:
    if not history.components.count:
        return "none"
    heading = f"{_heading_degrees(history):.1f} deg (0 following, 90 from port, 180 head)"
    waves = history.components
    if not np.ptp(waves.wave_heading):
        return heading
    mean = np.average(np.exp(1j * waves.wave_heading), weights=waves.amplitude**2)
    return f"mean {heading}, directional spread {np.rad2deg(np.sqrt(2 * (1 - abs(mean)))):.1f} deg"


def _heading_degrees(history: History) -> float:
    """Mean direction of the waves, weighted by their energy [deg]."""
    waves = history.components
    mean = np.angle(np.sum(waves.amplitude**2 * np.exp(1j * waves.wave_heading)))
    return round(float(np.rad2deg(mean)), 6) % 360.0


def _times(result: Statistics) -> dict[str, str]:
    factor, cpu, jit = result.realtime_factor, result.cpu_seconds, result.jit_seconds
    return {
        "time loop": "–" if cpu is None else f"{cpu:.3g} s of CPU",
        "compilation": "–" if jit is None else f"{jit:.3g} s of CPU, not counted in the time loop",
        "faster than real time": "–" if factor is None else f"{factor:.0f} times",
    }


def _table(rows: dict[str, str]) -> str:
    return "\n".join(["| | |", "|---|---|", *(f"| {name} | {value} |" for name, value in rows.items())])


def _notes_section(history: History) -> str:
    if not history.notes:
        return ""
    return "\n".join(["## Notes", "", *(f"- {note}" for note in history.notes)])


def _case_section(history: History) -> str:
    case = json.loads(history.attrs["case"])
    if not case:
        return ""
    return f"## The case\n\n```json\n{json.dumps(case, indent=2, ensure_ascii=False)}\n```"
