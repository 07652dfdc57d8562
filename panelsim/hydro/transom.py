"""The section at a transom: where the water leaves a moving hull with the momentum that the hull gave it.

Salvesen, Tuck and Faltinsen (1970) integrate the force along the ship up to the transom; the terms that are
left over there need the coefficients of this one section, which are two-dimensional whatever the source of
the others. They take the flow to leave the edge of the transom as if the hull went on; whether they help is
disputed, so that they are left out unless asked for.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.arguments import finite_row
from panelsim.hydro.conditioning import require_physical
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.interpolation import at_frequency
from panelsim.hydro.strip.assembly import lowest_strip_frequency, section_motion
from panelsim.hydro.strip.contour import Contour, contour_nodes, highest_frequency
from panelsim.hydro.strip.frank import ELEMENTS
from panelsim.hydro.strip.incident import diffraction_momentum_section
from panelsim.hydro.strip.long_waves import solve_at_all_frequencies
from panelsim.hydro.strip.mesh_sections import section_of_mesh, wet_ends
from panelsim.hydro.strip.sections import Section
from panelsim.hydro.strip.solution import SectionSolution
from panelsim.hydro.transom_memory import TransomMemory, transom_memory
from panelsim.seaway.dispersion import wavenumber
from panelsim.ship.ship import Ship, require_ship

TRANSOM_NOTE = (
    "Radiation and diffraction have the end terms of the transom (Salvesen, Tuck and Faltinsen 1970)."
)

_AHEAD = 1e-4  # share of the wet length by which the cut is made ahead of the flat transom
_SMALLEST = 0.01  # share of the midship section's area
_MORE = 15  # frequencies beyond the last
_WORTH_MORE = 1.1  # times the last
_SAME_PLACE = 2e-3  # share of the length, by which a centre of gravity may differ with the panelling


@dataclass(frozen=True, eq=False)
class Transom:
    """The solved section, its last frequency infinite and its first rest, of a ship of this length [m].

    `fingerprint` is that of the ship's hull.
    """

    section: Section
    solution: SectionSolution
    length: float
    fingerprint: str

    @classmethod
    def of_ship(cls, ship: Ship, frequencies: FloatArray) -> "Transom":
        """Cut and solve the aftmost wet section of a ship at rest.

        `frequencies` (F,) [rad/s], ascending from 0: those of the database that it goes with. A shallow
        section still makes waves above them, and is solved to the highest that its elements resolve.
        Raises PanelsimError for frequencies that are not such, for a stern that ends without a wet transom,
        and for a solution that no section has.
        """
        require_ship(ship)
        frequencies = _from_rest("frequencies of the transom", frequencies)
        aft, fore = wet_ends(ship.vertices, ship.mesh.panels, ship.waterline)
        section = _section(ship, aft + _AHEAD * (fore - aft))
        share = section.area / _section(ship, 0.5 * (aft + fore)).area
        if share < _SMALLEST:
            raise PanelsimError(
                "The ship has no wet transom",
                got=f"an aftmost section of {100 * share:.2g} % of the midship section's area",
                allowed=f"{100 * _SMALLEST:.2g} % or more",
                remedy="leave the transom terms out",
            )
        contour = Contour.of_nodes(contour_nodes(section, ELEMENTS), section.waterline)
        last, highest = frequencies[-1], highest_frequency(contour, ship.gravity)
        more = np.geomspace(last, highest, _MORE + 1)[1:] if highest > _WORTH_MORE * last else np.empty(0)
        solution = solve_at_all_frequencies(
            section,
            np.concatenate([frequencies, more]),
            lowest_strip_frequency(fore - aft, ship.gravity),
            water_density=ship.water_density,
            gravity=ship.gravity,
        )
        transom = cls(section, solution, ship.length, str(ship.identity()["form"]))
        require_physical(
            solution.frequencies[:-1],
            transom.added_mass[:-1],
            transom.damping[:-1],
            float(np.abs(section.points[:, 0]).max()),
        )
        return transom

    @property
    def x(self) -> float:
        """Place of the section [m] in ship axes."""
        return self.section.x

    def require_for(self, ship: Ship) -> None:
        """Raise PanelsimError unless the transom is of the hull of this ship, and afloat as she is."""
        aft, fore = wet_ends(ship.vertices, ship.mesh.panels, ship.waterline)
        apart = abs(aft + _AHEAD * (fore - aft) - self.x)
        if ship.identity()["form"] != self.fingerprint or apart > _SAME_PLACE * self.length:
            raise PanelsimError(
                f"The transom is of another ship than {ship.name}",
                got=f"a section at x = {self.x:.6g} m of a hull of {self.length:.6g} m",
                remedy="cut that of this ship: Transom.of_ship(ship, database.frequencies)",
            )

    def require_hull_of(self, database: HydroDatabase) -> None:
        """Raise PanelsimError for coefficients that a database tells to be those of another hull."""
        stored = database.dataset.attrs.get("ship_form", self.fingerprint)
        if stored != self.fingerprint:
            raise PanelsimError(
                "The transom and the hydrodynamic database are of different hulls",
                got=f"transom {self.fingerprint}, database {stored}",
                remedy="cut that of the ship: Transom.of_ship(ship, database.frequencies)",
            )

    @cached_property
    def memory(self) -> TransomMemory:
        """Its momentum in the time domain. Raises PanelsimError where no few exponentials give it."""
        return transom_memory(self.section, self.solution, self.length)

    @cached_property
    def added_mass(self) -> FloatArray:
        """Eᵀ a E (F + 1, 6, 6) per metre of length about the CG, the last row at infinite frequency."""
        return self._of_ship(self.solution.added_mass)

    @cached_property
    def damping(self) -> FloatArray:
        """Eᵀ b E (F + 1, 6, 6) per metre of length about the CG."""
        return self._of_ship(self.solution.damping)

    def inertia(self, encounter: FloatArray) -> ComplexArray:
        """Eᵀ (a + b/(iω_e)) E (M, 6, 6) per metre at signed frequencies of encounter (M,) [rad/s]."""
        stored = self.solution.frequencies[:-1]
        ratio = np.zeros_like(self.damping[:-1])
        ratio[1:] = self.damping[1:-1] / stored[1:, None, None]
        return at_frequency(stored, self.added_mass[:-1] - 1j * ratio, self.added_mass[-1], encounter)

    def momentum(
        self, frequency: FloatArray, wave_heading: FloatArray, encounter: FloatArray
    ) -> ComplexArray:
        """Momentum (M, 6) per metre of the scattered wave at the transom, for waves of 1 m.

        `frequency` ω (M,) and `encounter` ω_e (M,) [rad/s], `wave_heading` β (M,) [rad]; the phase is that of
        a crest at the CG.
        """
        solution = self.solution
        stored = solution.frequencies[:-1]
        potential = at_frequency(stored, solution.potential[:-1], solution.potential[-1].real, encounter)
        of_section = diffraction_momentum_section(solution, potential, frequency, wave_heading)
        k = wavenumber(frequency, solution.gravity)
        phase = np.exp(-1j * k * self.x * np.cos(wave_heading))
        momentum: ComplexArray = phase[:, None] * (of_section @ section_motion(self.x))
        return momentum

    def _of_ship(self, sectional: FloatArray) -> FloatArray:
        motion = section_motion(self.x)
        mean = 0.5 * (sectional + np.swapaxes(sectional, 1, 2))
        return motion.T @ mean @ motion


def _from_rest(name: str, frequencies: FloatArray) -> FloatArray:
    """Frequencies (F,) [rad/s]; PanelsimError unless they rise from 0."""
    row = finite_row(name, frequencies, "rad/s, those of the database")
    if len(row) < 2 or row[0] != 0.0 or (np.diff(row) <= 0.0).any():
        raise PanelsimError(
            f"The {name} do not rise from 0",
            got=repr(row.tolist())[:60],
            allowed="two or more, the first 0 rad/s, each above the one before",
            remedy="give database.frequencies",
        )
    return row


def _section(ship: Ship, x: float) -> Section:
    return section_of_mesh(ship.vertices, ship.mesh.panels, ship.waterline, x)
