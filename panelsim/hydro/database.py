"""The hydrodynamic database: zero-speed coefficients and potentials of one ship."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import as_path, require_new, write_whole
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.refine import subdivided
from panelsim.hydro.bem import Progress, highest_resolved_frequency, solve_radiation
from panelsim.hydro.conditioning import require_physical
from panelsim.hydro.database_file import FORMAT, POTENTIALS, TABLES, read_database_file
from panelsim.hydro.frequency_grids import frequency_grid
from panelsim.hydro.memory import MemoryFunctions, memory_functions
from panelsim.hydro.memory_states import MemoryStates, memory_states
from panelsim.hydro.strip.of_ship import solve_strips_of_ship
from panelsim.hydro.strip.section_forms import SectionForm, require_section_form
from panelsim.hydro.strip.sections import HullSections
from panelsim.ship.bundled import default_panel_area
from panelsim.ship.ship import Ship, require_ship

_CONVENTIONS = {
    "axes": "ship axes: origin at the centre of gravity, x forward, y to port, z up",
    "time_factor": "exp(+i omega t)",
    "units": "SI, rad/s; added mass in kg, kg m, kg m2; damping in kg/s, kg m/s, kg m2/s",
    "potential": "radiation potential of unit velocity, d(phi_j)/dn = n_j with n out of the hull",
}
# About what gives eight panels to the shortest wave that moves a ship (2.5 rad/s at 120 m).
_WET_PANELS = 1000
_WET_PANELS_OF_AN_OWN_MESH = 1200

METHODS = ("bem", "strip")

_PREFIX = "ship_"
# How far a ship may differ from the one the database was made for. The longitudinal centre of gravity of a
# ship that floats at a stated draft moves with its panelling, by centimetres on 100 m.
_LENGTH_TOLERANCES = {"draft": 1e-4, "center_of_gravity_x": 2e-3, "center_of_gravity_z": 1e-4}
_ABSOLUTE_TOLERANCES = {"trim": 2e-4}
_RELATIVE_TOLERANCES = {"water_density": 1e-4, "gravity": 1e-4}


@dataclass(frozen=True)
class HydroDatabase:
    """Zero-speed hydrodynamic coefficients about the centre of gravity, exp(+iωt), SI units.

    A thin class over an xarray `dataset` laid out as `panelsim.hydro.bem.solve_radiation` says, with
    what it was computed for as attributes. One database serves every speed, heading and panel size.

    Databases of other programs have no potentials, but diffraction loads at zero speed by wave frequency and
    heading (`has_potentials` is False): `panelsim.hydro.tabulated_diffraction` says what they are good for.
    """

    dataset: xr.Dataset

    @classmethod
    def compute(
        cls,
        ship: Ship,
        method: str = "bem",
        progress: Progress | None = None,
        *,
        sections: HullSections | None = None,
        section_form: SectionForm = "close-fit",
    ) -> "HydroDatabase":
        """Solve the radiation problems of a ship: by "bem" in seconds to a minute, by "strip" in two seconds.

        "bem" are boundary elements in three dimensions, "strip" is strip theory on 21 sections cut from the
        panels (`panelsim.hydro.strip.assembly`): for a slender hull, without surge, and with coefficients by
        section. A ship with a hull form is panelled anew, as finely as the frequencies need; one without is
        solved on its own mesh, for "bem" with coarse panels split in four. `progress(done, total)` counts
        frequencies or sections.

        For "strip" `sections` in ship axes, from offsets (`sections_from_offsets`), take the place of those
        that are cut; each stands for the strip to half-way to its neighbours. `section_form` "lewis" solves
        the Lewis forms of their breadth, draft and area, in less than half the time of their own outlines.

        Raises PanelsimError for what is no ship, for another method or form, for a solution that is not
        physical, for sections that cannot be cut or are not those of the ship, and for those that no Lewis
        form can stand for.
        """
        require_ship(ship)
        _require_method(method, sections, section_form)
        solved = _panelled_for_solution(ship)
        _require_same_flotation(ship, solved)
        if method == "strip":
            return cls.of_ship(solved, solve_strips_of_ship(solved, sections, section_form, progress))
        mesh = solved.mesh if ship.form is not None else _refined(ship)
        wet = _wet_panels(ship, mesh)
        resolved = highest_resolved_frequency(float(mesh.area[wet].mean()), ship.gravity)
        dataset = solve_radiation(
            solved.to_ship_axes(mesh.vertices),
            mesh.panels,
            solved.waterline,
            water_density=ship.water_density,
            gravity=ship.gravity,
            frequencies=frequency_grid(ship.length, resolved),
            progress=progress,
        )
        return cls.of_ship(solved, dataset)

    @classmethod
    def of_ship(cls, ship: Ship, dataset: xr.Dataset) -> "HydroDatabase":
        """A database of coefficients that were found for this ship: `dataset` is told what it is."""
        identity = {_PREFIX + name: value for name, value in ship.identity().items()}
        conventions = dict(_CONVENTIONS)
        if "diffraction_real" in dataset:
            conventions["potential"] = "none"
            conventions["diffraction"] = (
                "load of the scattered wave at zero speed per metre of amplitude, crest at the centre of"
                " gravity; wave heading in rad, 0 following, pi/2 from port, pi head"
            )
        dataset.attrs |= {
            "format": FORMAT,
            "name": ship.name,
            "length": ship.length,
            **conventions,
            **identity,
        }
        return cls(dataset)

    @classmethod
    def load(cls, path: str | Path) -> "HydroDatabase":
        """Read a database from NetCDF-4.

        Raises PanelsimError for a missing, damaged or foreign file, and for coefficients that no body has.
        """
        database = cls(read_database_file(as_path(path)))
        require_physical(
            database.frequencies, database.added_mass, database.radiation_damping, database.half_breadth
        )
        return database

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write NetCDF-4, the potentials compressed in single precision, beside the target and renamed.

        An existing file is refused unless `overwrite`.
        """
        path = as_path(path)
        require_new(path, "database", overwrite=overwrite)
        compressed = {"dtype": "float32", "compression": "gzip", "compression_opts": 6, "shuffle": True}
        encoding = {name: compressed for name in self.dataset.data_vars if str(name).startswith("potential")}
        write_whole(path, bytes(self.dataset.to_netcdf(engine="h5netcdf", encoding=encoding)))
        return path

    @cached_property
    def frequencies(self) -> FloatArray:
        """Frequencies (F,) [rad/s], ascending from 0."""
        return np.asarray(self.dataset["frequency"].values, dtype=np.float64)

    @cached_property
    def added_mass(self) -> FloatArray:
        """A(ω) (F, 6, 6), row = force, column = motion."""
        return self.dataset["added_mass"].values

    @cached_property
    def radiation_damping(self) -> FloatArray:
        """B(ω) (F, 6, 6), row = force, column = motion."""
        return self.dataset["radiation_damping"].values

    @property
    def added_mass_zero(self) -> FloatArray:
        """A(0) (6, 6)."""
        return self.added_mass[0]

    @cached_property
    def added_mass_infinite(self) -> FloatArray:
        """A(∞) (6, 6), as it was computed or read."""
        return self.dataset["added_mass_infinite"].values

    @cached_property
    def memory(self) -> MemoryFunctions:
        """Memory of the radiated waves. Raises PanelsimError as `memory_functions` does."""
        return memory_functions(self)

    @cached_property
    def memory_states(self) -> MemoryStates:
        """The memory as linear states. Raises PanelsimError as `memory_functions` and `memory_states` do."""
        return memory_states(self.memory)

    @property
    def has_potentials(self) -> bool:
        """True with radiation potentials, from which diffraction at any speed and heading follows."""
        return set(self.dataset.data_vars) >= POTENTIALS

    @cached_property
    def wave_frequencies(self) -> FloatArray:
        """Wave frequencies (W,) [rad/s] of the diffraction tables, ascending."""
        return np.asarray(self._tables["wave_frequency"].values, dtype=np.float64)

    @cached_property
    def wave_headings(self) -> FloatArray:
        """Headings (H,) [rad] of the diffraction tables, ascending in (-π, π], 0 following, π head."""
        return np.asarray(self._tables["wave_heading"].values, dtype=np.float64)

    @cached_property
    def diffraction_table(self) -> ComplexArray:
        """Diffraction loads at zero speed (W, H, 6) per unit amplitude [N/m, N], as `diffraction_load`."""
        tables = self._tables
        return tables["diffraction_real"].values + 1j * tables["diffraction_imag"].values

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on where the coefficients come from and what was taken for granted; often none."""
        return tuple(str(self.dataset.attrs.get("notes", "")).splitlines())

    @property
    def _tables(self) -> xr.Dataset:
        if not set(self.dataset.data_vars) >= TABLES:
            raise PanelsimError(
                "This database holds no diffraction tables",
                remedy="its potentials give diffraction at any frequency and heading: diffraction_load",
            )
        return self.dataset

    @cached_property
    def potential(self) -> ComplexArray:
        """Radiation potentials φ_j(ω) (F, 6, panels), ∂φ_j/∂n = n_j.

        Raises PanelsimError where the database came from another program and holds none.
        """
        if not self.has_potentials:
            raise PanelsimError(
                "This database holds no radiation potentials, only diffraction tables",
                got=self.dataset.attrs.get("solver"),
                remedy="compute one with `panelsim hydro NAME -o FILE.nc`",
            )
        real = self.dataset["potential_real"].values.astype(np.float64)
        return real + 1j * self.dataset["potential_imag"].values

    @cached_property
    def potential_infinite(self) -> FloatArray:
        """Radiation potentials in the limit of infinite frequency (6, panels)."""
        return self.dataset["potential_infinite"].values.astype(np.float64)

    @cached_property
    def panel_corners(self) -> FloatArray:
        """Corners (panels, 4, 3) [m] of the wet panels in ship axes; the port half if `half_hull`."""
        return self.dataset["panel_corners"].values

    @property
    def half_hull(self) -> bool:
        """True when the panels are the port half of a symmetric hull."""
        return bool(self.dataset.attrs["half_hull"])

    @property
    def length(self) -> float:
        """Length of the ship [m]."""
        return float(self.dataset.attrs["length"])

    @property
    def half_breadth(self) -> float:
        """Largest half-breadth [m] of the wet hull."""
        return float(self.dataset.attrs["half_breadth"])

    @property
    def waterline(self) -> float:
        """Height of the calm water surface in ship axes [m]."""
        return float(self.dataset.attrs["waterline"])

    @property
    def water_density(self) -> float:
        """Water density [kg/m3]."""
        return float(self.dataset.attrs["water_density"])

    @property
    def gravity(self) -> float:
        """Acceleration of gravity [m/s2]."""
        return float(self.dataset.attrs["gravity"])

    @property
    def damping_roughness(self) -> float:
        """Largest jump of a diagonal damping off its neighbours, over its peak; below 0.03 for a ship."""
        return float(self.dataset.attrs["damping_roughness"])

    @property
    def fingerprint(self) -> str:
        """Hash of the hull that the database was computed for."""
        return str(self.dataset.attrs[_PREFIX + "form"])

    def require_for(self, ship: Ship) -> None:
        """Raise PanelsimError, naming what differs, unless this database belongs to the ship."""
        differences = []
        for name, wanted in ship.identity().items():
            stored = self.dataset.attrs.get(_PREFIX + name)
            if not _same(name, stored, wanted, ship.length):
                differences.append(f"{name.replace('_', ' ')} {_text(stored)} there, {_text(wanted)} here")
        if differences:
            raise PanelsimError(
                f"The hydrodynamic database was computed for another ship than {ship.name}",
                got="; ".join(differences),
                remedy="compute one for this ship with `panelsim hydro NAME -o FILE.nc`",
            )


def _require_method(method: str, sections: HullSections | None, section_form: str) -> None:
    if method not in METHODS:
        raise PanelsimError("This method is not known", got=repr(method)[:60], allowed=" | ".join(METHODS))
    require_section_form(section_form)
    if method != "strip" and (sections is not None or section_form != "close-fit"):
        raise PanelsimError(
            "Sections and their form belong to strip theory",
            got=f"method {method}, section form {section_form}",
            remedy='take method "strip"',
        )


def _panelled_for_solution(ship: Ship) -> Ship:
    """The ship on about a thousand wet panels, whatever mesh it comes with: one hull, one database."""
    if ship.form is None:
        return ship
    first = ship.at_panel_area(default_panel_area(ship.form))
    wetted_surface = float(first.mesh.area[_wet_panels(first, first.mesh)].sum())
    return ship.at_panel_area(wetted_surface / _WET_PANELS)


def _require_same_flotation(ship: Ship, solved: Ship) -> None:
    """Refuse a ship whose coarse panels float so far from the hull that its coefficients are another's."""
    stored, wanted = solved.identity(), ship.identity()
    apart = [name for name in wanted if not _same(name, stored[name], wanted[name], ship.length)]
    if apart:
        raise PanelsimError(
            "The panels of the ship are too coarse: it floats otherwise than its hull",
            got="; ".join(
                f"{name.replace('_', ' ')} {_text(wanted[name])}, with fine panels {_text(stored[name])}"
                for name in apart
            ),
            remedy="take a smaller ship.panel_area",
        )


def _refined(ship: Ship) -> PanelMesh:
    """The ship's own mesh, its panels split in four for as long as they stay about a thousand."""
    mesh = ship.mesh
    while 4 * np.count_nonzero(_wet_panels(ship, mesh)) <= _WET_PANELS_OF_AN_OWN_MESH:
        mesh = subdivided(mesh)
    return mesh


def _wet_panels(ship: Ship, mesh: PanelMesh) -> NDArray[np.bool_]:
    return ship.to_ship_axes(mesh.centroid)[:, 2] < ship.waterline


def _same(name: str, stored: str | float | None, wanted: str | float, length: float) -> bool:
    if stored is None or isinstance(wanted, str):
        return stored == wanted
    allowed = (
        _LENGTH_TOLERANCES.get(name, 0.0) * length
        + _ABSOLUTE_TOLERANCES.get(name, 0.0)
        + _RELATIVE_TOLERANCES.get(name, 0.0) * abs(wanted)
    )
    return abs(float(stored) - wanted) <= allowed


def _text(value: str | float | None) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
