"""A commented case file to start from."""

import json
import os
from pathlib import Path

from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hull.form import HullForm, bundled_hull_names, hull_folder, load_hull
from panelsim.ship.bundled import default_panel_area


def hull_entry(name_or_path: str, case_file: Path) -> str:
    """What `ship.hull` of a case file says: a bundled name, or the way from there to a hull folder.

    Raises PanelsimError when it is neither, and for a folder whose name cannot stand in a case file.
    """
    if name_or_path in bundled_hull_names():
        return name_or_path
    folder = hull_folder(name_or_path)
    if not _is_unicode(str(folder)):
        raise PanelsimError(
            "The name of the hull folder is not UTF-8", got=folder, remedy="rename the folder"
        )
    try:
        way = Path(os.path.relpath(folder, case_file.resolve().parent)).as_posix()
    except ValueError:  # on another drive
        return folder.as_posix()
    # The mark of a path keeps it from being read as a bundled name.
    return way if way.startswith("..") else f"./{way}"


def _is_unicode(name: str) -> bool:
    """Whether a name is text: Python keeps other bytes of file names as lone surrogates."""
    return not any("\ud800" <= letter <= "\udfff" for letter in name)


def case_template(form: HullForm, hull: str) -> str:
    """Text of a case file in a moderate sea that suits the length of a hull.

    `hull` is its entry in the file, from `hull_entry`.
    """
    # A sea whose peak wave is 1.5 ship lengths long, at a typical steepness (TM 2003-190 8.3: 0.021).
    wave_length = 1.5 * form.length_pp
    peak_period = round((wave_length / 1.561) ** 0.5, 1)
    height = round(0.021 * 1.561 * peak_period**2, 2)
    scale = (120.0 / form.length_pp) ** 0.5
    peak = 6.2832 / peak_period
    froude_quarter = 0.25 * (9.81 * form.length_pp) ** 0.5 / KNOT
    # A box or a sphere is no ship under way.
    speed = min(15.0, round(froude_quarter, 1)) if form.length_pp > 3.0 * form.beam else 0.0
    return f"""\
# {" ".join(form.title.split())}
# Check this file with `panelsim check`, look at its sea with `panelsim sea`, run it with `panelsim run`.

[ship]
hull = {_toml_string(hull)}
panel_area = {default_panel_area(form):.3g}              # m2, nominal
# The loading comes from the hull's particulars; to change it, set for example
# mass = …                      # kg; the ship then finds its own draft
# center_of_gravity_height = …  # m above the baseline
# water_density = 1025.0        # kg/m3

[hydrodynamics]
method = "bem"                  # bem | strip, or file = "coefficients.nc", from `panelsim hydro`
# section_form = "lewis"        # with "strip": Lewis forms in place of the outlines of the sections
# transom_terms = true          # end terms of a wet transom at speed: see docs/transom.md

[seaway]
kind = "random"                 # random | regular | calm | record | dataset | components
spectrum = "bretschneider"      # or jonswap, pierson-moskowitz, ochi-hubble, …: see docs/seaways.md
significant_wave_height = {height:g}   # m
peak_period = {peak_period:g}              # s
# one frequency in each step, drawn with the seed: even frequencies would repeat the sea after 2π/step
frequencies = {{ choice = "jittered", {_grid(peak)} }}   # rad/s
wave_heading_deg = 150          # 0 following, 90 from port, 180 head
# or compass directions: sea_direction_deg = 210 (from) here and ship_heading_deg = 0 in [run]
# short-crested: spreading = {{ kind = "cosine-squared", spreading_angle_deg = 90 }}, direction_step_deg = 20
minimum_energy = 0.9            # refuse frequencies that hold less of the spectrum's energy
stretching = "wheeler"          # wheeler | none
seed = 1

[run]
speed_knots = {speed:g}
model = "nonlinear"             # nonlinear | linear
# inertia = "linear"            # with the nonlinear model: that of small angles, as in TM 2003-190
stepper = "exponential"         # exponential | rk4 | ab3: see docs/time_stepping.md
time_step = {float(f"{0.4 / scale:.1g}"):g}                 # s
duration = 600                  # s, after the ramp
ramp = 60                       # s over which the waves grow
capsize_angle_deg = 90          # end the run there; 0 = never

{_supplementary(form)}
# Roll damping by viscosity, in place of one in [supplementary] (docs/roll_damping.md):
# [roll_damping]
# method = "percent"            # percent | terms | ikeda
# critical_percent = 5

# Points of the ship whose motions a run and `panelsim response` tell too (docs/response.md):
# [points]
# bridge = [{0.15 * form.length_pp:.3g}, 0.0, {3.0 * form.draft:.3g}]   # m: forward, to port, above the keel
"""


def _grid(peak: float) -> str:
    """Frequencies about a spectral peak [rad/s] that hold 99 % of the energy of a Bretschneider sea."""
    return f"start = {0.5 * peak:.3g}, stop = {4.5 * peak:.3g}, step = {0.08 * peak:.3g}"


def _toml_string(text: str) -> str:
    # TOML's basic strings are those of JSON, which does not escape the delete character.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _supplementary(form: HullForm) -> str:
    """[supplementary]: the hull's own terms as comments, or some that hold it on its course."""
    if any(form.supplementary.values()):
        terms, mark = form.supplementary, "# "
        source = "The hull's own terms; a table that is given here replaces one of them."
    else:
        dimensions = {"length": form.length_pp, "beam": form.beam, "draft": form.draft}
        terms, mark = load_hull("halifax").scaled(**dimensions).supplementary, ""
        source = (
            "None are known for this hull: those of HALIFAX (TM 2003-190 section 8) by Froude's law,\n"
            "# lest it turn beam to the waves."
        )
    stiffness, damping = (
        ", ".join(f"{motion} = {value:.3g}" for motion, value in terms[kind].items())
        for kind in ("stiffness", "damping")
    )
    return f"""\
# {source}
{mark}[supplementary]
{mark}stiffness = {{ {stiffness} }}   # N/m, N m/rad
{mark}damping = {{ {damping} }}   # N/(m/s), N m/(rad/s)
"""
