"""Case files: a checked TOML description that becomes the same objects that a script would build."""

import json
import tomllib
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from panelsim.case.schema import CaseFile, ShipSection, readable
from panelsim.conventions import KNOT
from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hull.readers import read_mesh
from panelsim.hydro.database import HydroDatabase, Progress
from panelsim.hydro.store import database_for
from panelsim.loads.supplementary import Supplementary
from panelsim.seaway.seaways import CalmSeaway, RandomSeaway, RegularSeaway, Seaway
from panelsim.seaway.spectra import BUCKLEY_STEEPNESS, Bretschneider
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship

MESH_SUFFIXES = (".stl", ".obj", ".ply", ".glb", ".gdf")


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
        if not path.is_file():
            raise PanelsimError(
                "There is no such case file", got=path, remedy="`panelsim new NAME` writes one to start from"
            )
        try:
            raw = tomllib.loads(path.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise PanelsimError("The case file is not valid TOML", got=f"{path}: {error}") from error
        for override in overrides:
            _lay_over(raw, override)
        try:
            return cls(CaseFile.model_validate(raw), path.resolve().parent, path.stem)
        except ValidationError as error:
            raise readable(error, str(path)) from None

    @cached_property
    def ship(self) -> Ship:
        """The ship, afloat."""
        section = self.file.ship
        if Path(section.hull).suffix.lower() in MESH_SUFFIXES:
            return self._ship_of_mesh(section)
        if section.mesh is not None:
            raise PanelsimError(
                "[ship.mesh] is for a mesh file",
                got=f'hull = "{section.hull}"',
                allowed=f"a file ending in {', '.join(MESH_SUFFIXES)}",
            )
        form = load_hull(self._path(section.hull))
        cg = (section.center_of_gravity_x, 0.0, form.loading.center_of_gravity_height)
        if section.center_of_gravity_height is not None:
            cg = (cg[0], 0.0, section.center_of_gravity_height)
        radii = {n: getattr(section, f"gyradius_{n}") for n in ("roll", "pitch", "yaw")}
        given = {n: r if r is not None else getattr(form.loading, f"gyradius_{n}") for n, r in radii.items()}
        return load_ship(
            form,
            section.panel_area,
            draft=section.draft,
            trim_by_stern=section.trim_by_stern,
            mass=section.mass,
            center_of_gravity=cg,
            gyradii=(given["roll"], given["pitch"], given["yaw"]),
            water_density=section.water_density,
            gravity=section.gravity,
        )

    def _ship_of_mesh(self, section: ShipSection) -> Ship:
        """A ship from the user's own mesh: nothing is known of it but what the case says."""
        if section.mesh is None:
            raise PanelsimError(
                "A mesh file needs its unit and axes",
                got=f'hull = "{section.hull}" without [ship.mesh]',
                remedy='add [ship.mesh] with length_unit = "m", up = "z", forward = "x"',
            )
        if section.panel_area is not None:
            raise PanelsimError(
                "A mesh file has its own panels", got="ship.panel_area", remedy="leave panel_area out"
            )
        needed = ("draft", "center_of_gravity_height", "gyradius_roll", "gyradius_pitch", "gyradius_yaw")
        missing = [n for n in (*needed, "water_density") if getattr(section, n) is None]
        if missing:
            raise PanelsimError(
                "The loading of a mesh file is not known", got=f"no {', '.join(missing)} in [ship]"
            )
        mesh = read_mesh(self._path(section.hull), **section.mesh.model_dump())
        keel = float(mesh.vertices[:, 2].min())
        trim = -np.arctan((section.trim_by_stern or 0.0) / float(np.ptp(mesh.vertices[:, 0])))
        if keel > 1e-3 * float(np.ptp(mesh.vertices[:, 2])):
            raise PanelsimError(
                "The keel lies above the baseline", got=f"{keel:g} m", remedy="set ship.mesh.origin"
            )
        values = section.model_dump()
        return Ship(
            mesh,
            draft=values["draft"],
            trim=float(trim),
            center_of_gravity=(section.center_of_gravity_x, 0.0, values["center_of_gravity_height"]),
            gyradii=(values["gyradius_roll"], values["gyradius_pitch"], values["gyradius_yaw"]),
            mass=section.mass,
            water_density=values["water_density"],
            gravity=section.gravity,
            name=Path(section.hull).stem,
        )

    def _path(self, name: str) -> str:
        """A path relative to the case file where there is one, else the name as it is."""
        beside = self.folder / name
        return str(beside) if beside.exists() else name

    @cached_property
    def wave_heading(self) -> float:
        """β [rad]; from compass directions β = ν + 180° − χ, TM 2003-190 (9)."""
        section, heading = self.file.seaway, self.file.run.ship_heading_deg
        if section.wave_heading_deg is not None:
            return float(np.deg2rad(section.wave_heading_deg))
        if section.sea_direction_deg is None:
            return 0.0
        if heading is None:
            raise PanelsimError(
                "seaway.sea_direction_deg is a compass direction and needs the ship's course",
                remedy="set run.ship_heading_deg, or give seaway.wave_heading_deg instead",
            )
        return float(np.deg2rad((section.sea_direction_deg + 180.0 - heading) % 360.0))

    @cached_property
    def seaway(self) -> Seaway:
        """The waves."""
        section = self.file.seaway.model_dump()
        if section["kind"] == "calm":
            return CalmSeaway()
        if section["kind"] == "regular":
            omega = section["wave_frequency"] or 2 * np.pi / section["wave_period"]
            phase = float(np.deg2rad(section["phase_deg"]))
            return RegularSeaway(0.5 * section["wave_height"], omega, self.wave_heading, phase)
        assert self.file.seaway.frequencies is not None
        return RandomSeaway(
            Bretschneider(section["significant_wave_height"], section["peak_period"]),
            self.file.seaway.frequencies.values(),
            self.wave_heading,
            section["seed"],
            section["minimum_energy"],
        )

    @property
    def speed(self) -> float:
        """Ship speed [m/s]."""
        return self.file.run.speed_knots * KNOT

    @cached_property
    def supplementary(self) -> Supplementary:
        """Supplementary terms: those of the case, else of the hull's particulars."""
        section = self.file.supplementary
        own = self.ship.form.supplementary if self.ship.form is not None else {}
        stiffness = section.stiffness if section.stiffness is not None else own.get("stiffness", {})
        damping = section.damping if section.damping is not None else own.get("damping", {})
        return Supplementary(stiffness, damping)

    def database(self, progress: Progress | None = None) -> HydroDatabase:
        """The hydrodynamic coefficients: from the case's file, stored before, or computed now."""
        if self.file.hydrodynamics.file is None:
            return database_for(self.ship, progress)
        database = HydroDatabase.load(self._path(self.file.hydrodynamics.file))
        database.require_for(self.ship)
        return database

    def warnings(self) -> list[str]:
        """What is allowed but unusual, one sentence each."""
        seaway = self.seaway
        if isinstance(seaway, RandomSeaway) and seaway.spectrum.nominal_steepness > BUCKLEY_STEEPNESS:
            return [
                f"The sea is steeper ({seaway.spectrum.nominal_steepness:.3f}) than the limit of wave-buoy"
                f" observations, {BUCKLEY_STEEPNESS} (Buckley, TM 2003-190 section 5)."
            ]
        return []

    def resolved(self) -> dict[str, Any]:
        """The case with every default filled in, for the record."""
        return json.loads(self.file.model_dump_json())


def _lay_over(raw: dict[str, Any], override: str) -> None:
    """Put "section.key=value" into the raw case; the value is read as TOML, else as text."""
    path, equals, text = override.partition("=")
    keys = path.strip().split(".")
    if not equals or not all(keys):
        raise PanelsimError(
            "An override is not of the form key=value", got=override, allowed="for example seaway.seed=7"
        )
    try:
        value = tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        value = text.strip()
    table = raw
    for key in keys[:-1]:
        table = table.setdefault(key, {})
        if not isinstance(table, dict):
            raise PanelsimError("An override reaches into a key that is no table", got=override)
    table[keys[-1]] = value
