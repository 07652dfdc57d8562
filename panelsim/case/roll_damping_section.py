"""From the table [roll_damping] of a case to the damping terms of its ship."""

import numpy as np

from panelsim.case.schema import RollDampingSection
from panelsim.errors import PanelsimError
from panelsim.hull.sections import HullLines
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.hull_data import ImmersedSections, RollingHull
from panelsim.hydro.roll_damping.ikeda import ikeda_terms
from panelsim.hydro.roll_damping.natural import natural_roll
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.loads.supplementary import Supplementary
from panelsim.ship.ship import Ship


def build_roll_damping(
    section: RollDampingSection, ship: Ship, database: HydroDatabase, *, speed: float, model: str
) -> RollDampingTerms | None:
    """The terms that a run of the `model` takes at this `speed` [m/s]; None for method "none".

    The linear model takes, in place of terms that are not linear, the linear damping of the same energy in
    regular rolling at the natural frequency with the amplitude `linearised_at_deg`. Raises PanelsimError
    where that is missing, and for a hull that the method does not suit.
    """
    if section.method == "none":
        return None
    terms = _terms(section, ship, database, speed)
    if model == "nonlinear" or not (terms.quadratic or terms.cubic):
        return terms
    if section.linearised_at_deg is None:
        raise PanelsimError(
            "The linear model needs the amplitude at which roll damping is made linear",
            got="[roll_damping] without linearised_at_deg",
            remedy="set roll_damping.linearised_at_deg, or run.model to nonlinear",
        )
    rate = natural_roll(ship, database).frequency * np.deg2rad(section.linearised_at_deg)
    return RollDampingTerms(linear=float(terms.equivalent(rate)))


def require_one_roll_damping(section: RollDampingSection, supplementary: Supplementary) -> None:
    """Raise PanelsimError where the case has roll damping twice: that in [supplementary] is viscous too."""
    roll = supplementary.damping.get("roll", 0.0)
    if section.method == "none" or not roll:
        return
    others = ", ".join(
        f"{name} = {value:g}" for name, value in supplementary.damping.items() if name != "roll"
    )
    raise PanelsimError(
        "The roll damping of viscosity would be counted twice",
        got=f'roll_damping.method = "{section.method}", and a supplementary damping of {roll:g} N m s',
        allowed="one of them",
        remedy=f"leave roll out of the supplementary damping: [supplementary] damping = {{ {others} }}",
    )


def rolling_hull(ship: Ship) -> RollingHull:
    """The ship as Ikeda's method sees it: its lines below the water at rest, the keel taken as level.

    Raises PanelsimError for a ship of which no lines are known.
    """
    lines = None if ship.form is None else ship.form.shape
    if not isinstance(lines, HullLines):
        raise PanelsimError(
            "Ikeda's roll damping needs the sections of the hull",
            got=f"{ship.name}, a hull without a table of offsets",
            allowed="a hull with offsets, such as frigate, halifax or s175",
            remedy='give the damping itself: roll_damping.method = "percent" or "terms"',
        )
    sections = ImmersedSections.of_lines(lines, ship.draft)
    beam = float(np.interp(0.0, sections.x, sections.beam))
    midship = float(np.interp(0.0, sections.x, sections.area)) / (beam * ship.draft)
    return RollingHull(
        length_pp=ship.length,
        beam=beam,
        draft=ship.draft,
        block_coefficient=ship.hydrostatics.displaced_volume / (ship.length * beam * ship.draft),
        midship_coefficient=midship,
        center_of_gravity_height=float(ship.center_of_gravity[2]),
        sections=sections,
        water_density=ship.water_density,
    )


def roll_damping_warnings(section: RollDampingSection, ship: Ship) -> list[str]:
    """What is unusual about the roll damping of a case, one sentence each; faults as `rolling_hull`."""
    if section.method != "ikeda":
        return []
    rolling_hull(ship)
    if ship.form is not None and ship.form.appendages.bilge_keels:
        return []
    return [
        f"The particulars of {ship.name} have no bilge keels under [appendages]: its roll damping is that of"
        " the naked hull."
    ]


def _terms(
    section: RollDampingSection, ship: Ship, database: HydroDatabase, speed: float
) -> RollDampingTerms:
    if section.method == "terms":
        return RollDampingTerms(section.linear or 0.0, section.quadratic or 0.0, section.cubic or 0.0)
    roll = natural_roll(ship, database)
    if section.method == "percent":
        ratio = 0.01 * (section.critical_percent or 0.0)
        return RollDampingTerms.of_critical(ratio, roll.inertia, roll.stiffness)
    keels = ship.form.appendages.bilge_keels if ship.form is not None else ()
    return ikeda_terms(rolling_hull(ship), keels, roll.frequency, speed)
