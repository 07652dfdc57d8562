"""Case files: a checked TOML description that becomes the same objects that a script would build."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from panelsim.case.reading import changed_case_file, read_case_file
from panelsim.case.roll_damping_section import (
    build_roll_damping,
    require_one_roll_damping,
    roll_damping_warnings,
)
from panelsim.case.schema import CaseFile
from panelsim.case.seaway_section import SeawayBuilder
from panelsim.case.ship_section import beside, build_ship
from panelsim.conventions import KNOT, FloatArray
from panelsim.hydro.database import HydroDatabase, Progress
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.store import database_for
from panelsim.hydro.transom import Transom
from panelsim.loads.supplementary import Supplementary
from panelsim.seaway.random import RandomSeaway
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.steepness import BUCKLEY_STEEPNESS
from panelsim.ship.bundled import default_panel_area
from panelsim.ship.facts import ship_warnings
from panelsim.ship.points import points_of_ship
from panelsim.ship.ship import Ship

# At this many a force on a medium mesh takes some three milliseconds, and an hour of sea four minutes.
MANY_COMPONENTS = 20_000


class Case:
    """A checked case: what to run. Reading it builds nothing heavy; its properties do, once each."""

    def __init__(self, file: CaseFile, folder: Path, name: str = "case") -> None:
        self.file = file
        self.folder = folder
        self.name = name

    @classmethod
    def load(cls, path: str | Path, overrides: Sequence[str] = ()) -> "Case":
        """Read a case file, with `overrides` such as "seaway.seed=7" laid over it.

        Raises PanelsimError that names every key that is unknown, missing or wrong.
        """
        path = Path(path)
        return cls(read_case_file(path, overrides), path.resolve().parent, path.stem)

    def changed(self, changes: Mapping[str, Any]) -> "Case":
        """This case with other values, {"run.time_step": 0.1}; None takes a key away.

        The ship is the same object where nothing of her is changed. Raises PanelsimError for keys that are
        unknown and values that no case may have.
        """
        other = Case(changed_case_file(self.file, changes, self.name), self.folder, self.name)
        if other.file.ship == self.file.ship and "ship" in self.__dict__:
            other.__dict__["ship"] = self.ship
        return other

    @cached_property
    def ship(self) -> Ship:
        """The ship, afloat."""
        return build_ship(self.file.ship, self.folder)

    @property
    def wave_heading(self) -> float | None:
        """β [rad]; from compass directions β = ν + 180° − χ, TM 2003-190 (9); None where none is given."""
        sea, course = self.file.seaway.sea_direction_deg, self.file.run.ship_heading_deg
        if sea is not None and course is not None:
            return float(np.deg2rad((sea + 180.0 - course) % 360.0))
        relative = self.file.seaway.wave_heading_deg
        return None if relative is None else float(np.deg2rad(relative))

    @cached_property
    def seaway(self) -> Seaway:
        """The waves. Raises PanelsimError for files and values that cannot be used."""
        heading, course = self.wave_heading, self.file.run.ship_heading_deg
        radians = None if course is None else float(np.deg2rad(course))
        gravity = self.file.ship.gravity
        builder = SeawayBuilder(
            self.file.seaway, self.folder, wave_heading=heading, ship_heading=radians, gravity=gravity
        )
        return builder.build()

    @property
    def speed(self) -> float:
        """Ship speed [m/s]."""
        return self.file.run.speed_knots * KNOT

    @cached_property
    def supplementary(self) -> Supplementary:
        """Supplementary terms: each table that of the case, else of the hull's particulars.

        Raises PanelsimError where they damp the roll and [roll_damping] does so too.
        """
        section = self.file.supplementary
        own = Supplementary.of(self.ship)
        supplementary = Supplementary(
            own.stiffness if section.stiffness is None else section.stiffness.values(),
            own.damping if section.damping is None else section.damping.values(),
        )
        require_one_roll_damping(self.file.roll_damping, supplementary)
        return supplementary

    def roll_damping(self, database: HydroDatabase) -> RollDampingTerms | None:
        """Roll damping of the run's model at its speed, with the natural roll that the coefficients give."""
        model = self.file.run.model
        return build_roll_damping(self.file.roll_damping, self.ship, database, speed=self.speed, model=model)

    def roll_damping_at(self, speed: float, database: HydroDatabase) -> RollDampingTerms:
        """Roll damping at a speed [m/s] with its quadratic and cubic terms, whatever the model of the run."""
        terms = build_roll_damping(
            self.file.roll_damping, self.ship, database, speed=speed, model="nonlinear"
        )
        return RollDampingTerms() if terms is None else terms

    @cached_property
    def points(self) -> dict[str, FloatArray]:
        """Points of the ship (3,) [m] in hull axes by name; PanelsimError for those that are off her."""
        return points_of_ship(self.file.points, self.ship.center_of_gravity, self.ship.vertices)

    def database(self, progress: Progress | None = None) -> HydroDatabase:
        """The hydrodynamic coefficients: from the case's file, stored before, or computed now."""
        section = self.file.hydrodynamics
        return self.stored_database() or database_for(
            self.ship, progress, section.method, section.section_form
        )

    def transom(self, database: HydroDatabase) -> Transom | None:
        """The section at the transom, if the case wants its terms; PanelsimError for a hull without one."""
        if not self.file.hydrodynamics.transom_terms:
            return None
        return Transom.of_ship(self.ship, database.frequencies)

    def stored_database(self) -> HydroDatabase | None:
        """The coefficients of the file that the case names, or None where it names none.

        Raises PanelsimError for a file that cannot be used or that belongs to another ship.
        """
        file = self.file.hydrodynamics.file
        if file is None:
            return None
        database = HydroDatabase.load(beside(self.folder, file))
        database.require_for(self.ship)
        return database

    def warnings(self) -> list[str]:
        """What is allowed but unusual, one sentence each."""
        warnings = [*ship_warnings(self.ship), *roll_damping_warnings(self.file.roll_damping, self.ship)]
        seaway = self.seaway
        if seaway.components.count > MANY_COMPONENTS:
            warnings.append(
                f"The sea has {seaway.components.count} components, and a run's time grows with them: fewer"
                " frequencies or directions, a narrower band or seaway.drop_below make it quicker."
            )
        steepness = seaway.point_spectrum.nominal_steepness if isinstance(seaway, RandomSeaway) else 0.0
        if steepness > BUCKLEY_STEEPNESS:
            warnings.append(
                f"The sea is steeper ({steepness:.3f}) than the limit of wave-buoy observations,"
                f" {BUCKLEY_STEEPNESS} (Buckley, TM 2003-190 section 5)."
            )
        return warnings

    def resolved(self) -> dict[str, Any]:
        """The case with what it left open filled in, for the record; it is itself a valid case."""
        resolved = self.file.model_dump(mode="json", exclude_none=True)
        if self.ship.form is not None:
            resolved["ship"].setdefault("panel_area", default_panel_area(self.ship.form))
        resolved["supplementary"] = {
            "stiffness": dict(self.supplementary.stiffness),
            "damping": dict(self.supplementary.damping),
        }
        return resolved
