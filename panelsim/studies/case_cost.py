"""What the runs of one case cost: by model, by number of wave frequencies, by size of panel."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from panelsim.case import Case
from panelsim.case.seaway_schema import MOST_FREQUENCIES
from panelsim.errors import PanelsimError
from panelsim.seaway.random import RandomSeaway
from panelsim.studies.arguments import areas_that_suit, real_numbers, require_case, require_ships
from panelsim.studies.convergence import SHOWN, falling, require_panels
from panelsim.studies.linear_nonlinear import models_of

FREQUENCY_FACTORS = (1, 2, 4)
AREA_FACTORS = (0.5, 1.0, 2.0)
# A second of sea costs the same in a long run as in a short one.
LONGEST = 600.0


@dataclass(frozen=True, eq=False)
class CaseCost:
    """A case in both models; with each number of wave frequencies; with each panel area [m²]."""

    case: Case
    frequencies: tuple[int, ...]
    panel_areas: tuple[float, ...]

    @cached_property
    def varied(self) -> dict[str, dict[str, Case]]:
        """Cases by label, under what is varied: "components", "panels", or "case" for the case alone."""
        case = self._timed
        sets = {
            "case": {"as it is": case},
            "components": {f"{count} frequencies": _with(case, count) for count in self.frequencies},
            "panels": {
                f"{area:.4g} m2": case.changed({"ship.panel_area": area}) for area in self.panel_areas
            },
        }
        return {
            what: {
                f"{label}, {model}": of_model
                for label, one in cases.items()
                for model, of_model in zip(("linear", "nonlinear"), models_of(one), strict=True)
            }
            for what, cases in sets.items()
            if cases
        }

    @property
    def cases(self) -> list[Case]:
        """Every case to time."""
        return [case for cases in self.varied.values() for case in cases.values()]

    @cached_property
    def _timed(self) -> Case:
        """The case, cut to ten minutes."""
        return self.case.changed({"run.duration": min(self.case.file.run.duration, LONGEST)})


def case_cost(
    case: Case, frequencies: Sequence[int] | None = None, panel_areas: Sequence[float] | None = None
) -> CaseCost:
    """What is timed: by default once to four times the frequencies of a random sea, half to twice the panels.

    What the case cannot vary is left out where it was not asked for. Raises PanelsimError for numbers that no
    case may have, for frequencies of a sea that is not random, and for panel areas of a mesh file.
    """
    require_case(case)
    found = CaseCost(case, tuple(_frequencies(case, frequencies)), tuple(_areas(case, panel_areas)))
    require_ships(found.cases)  # what no case may have is refused before anything is run
    return found


def _frequencies(case: Case, given: Sequence[int] | None) -> list[int]:
    sea = case.seaway
    if not isinstance(sea, RandomSeaway) or case.file.seaway.frequencies is None:
        if given is None:
            return []
        raise PanelsimError(
            "The waves of this sea are given, and their number cannot be varied",
            got=f'--components for seaway.kind = "{case.file.seaway.kind}"',
            allowed="a random sea",
            remedy="leave --components out",
        )
    if given is None:
        own = sea.components.count if sea.directional_spectrum is None else _own_count(case)
        return [factor * own for factor in FREQUENCY_FACTORS]
    counts = real_numbers("numbers of components", given)
    told = ", ".join(f"{count:.9g}" for count in counts[:SHOWN])
    if not all(2 <= count <= MOST_FREQUENCIES and count == round(count) for count in counts):
        raise PanelsimError(
            "The numbers of components cannot be",
            got=told,
            allowed=f"different whole numbers from 2 to {MOST_FREQUENCIES}",
        )
    if len(set(counts)) < len(counts):
        raise PanelsimError(
            "Two of the numbers of components are the same", got=told, remedy="give each once"
        )
    return sorted(map(int, counts))


def _own_count(case: Case) -> int:
    section = case.file.seaway.frequencies
    assert section is not None
    if section.count is not None:
        return section.count
    assert section.start is not None and section.stop is not None and section.step is not None
    return round((section.stop - section.start) / section.step) + 1


def _with(case: Case, count: int) -> Case:
    """The case with so many wave frequencies between the same ends, however much energy a few may miss."""
    section = case.file.seaway.frequencies
    assert section is not None
    if section.choice == "equal-energy":
        return case.changed({"seaway.frequencies.count": count, "seaway.minimum_energy": 0.0})
    assert section.start is not None and section.stop is not None
    step = (section.stop - section.start) / (count - 1)
    return case.changed({"seaway.frequencies.step": step, "seaway.minimum_energy": 0.0})


def _areas(case: Case, given: Sequence[float] | None) -> Sequence[float]:
    if given is not None:
        require_panels(case)
        return falling("panel areas", given, "m2")
    if case.ship.form is None:
        return []
    return areas_that_suit(case, sorted(AREA_FACTORS, reverse=True))
