"""Coefficients and potentials of a ship by strip theory, laid out as those by boundary elements in 3-D.

An element of a section stands for a panel as long as its strip, with its potentials, so that diffraction at
any speed and heading is formed from the one as from the other. The normal of such a panel has no x-component.
"""

from collections.abc import Callable

import numpy as np
import xarray as xr

from panelsim.conventions import DOF_NAMES, ComplexArray, Dof, FloatArray
from panelsim.hydro.radiation_dataset import radiation_dataset
from panelsim.hydro.strip.assembly import Strips, lowest_strip_frequency, section_motion
from panelsim.hydro.strip.contour import highest_frequency
from panelsim.hydro.strip.lewis import LewisForm
from panelsim.hydro.strip.long_waves import solve_at_all_frequencies
from panelsim.hydro.strip.section_forms import SectionForm, lewis_forms, section_contour
from panelsim.hydro.strip.sections import HullSections, Section

_SLENDER = 3.0  # times the beam; ships are four times and more
_NAMES = {"close-fit": "sections", "lewis": "Lewis forms"}
SECTION_DOFS = tuple(DOF_NAMES[dof] for dof in (Dof.SWAY, Dof.HEAVE, Dof.ROLL))


def solve_strips(
    sections: HullSections,
    *,
    water_density: float,
    gravity: float,
    frequencies: FloatArray,
    section_form: SectionForm = "close-fit",
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Added mass, damping and potentials of a hull at zero speed by strip theory.

    `frequencies` (F,) [rad/s], ascending from 0; the limit of infinite frequency is always added.
    `section_form` "close-fit" takes sections as they are, "lewis" the Lewis forms of their dimensions.
    `progress(done, total)` counts sections. The Dataset is that of `panelsim.hydro.bem.solve_radiation`, and
    holds besides, by station from the stern forward, `section_x`, `strip_length` [m] and the coefficients per
    metre `section_added_mass`, `section_damping` (frequency, section, 3, 3) and `section_added_mass_infinite`
    in sway, heave and roll about the centre of gravity. Raises PanelsimError for frequencies that the
    elements do not resolve, and as `lewis_forms`.
    """
    frequencies = np.array(frequencies, dtype=np.float64)
    lowest = lowest_strip_frequency(sections.fore_end - sections.aft_end, gravity)
    outlines, note = _outlines(sections, section_form)
    solutions = []
    for section in outlines:
        solutions.append(
            solve_at_all_frequencies(
                section, frequencies, lowest, water_density=water_density, gravity=gravity
            )
        )
        if progress is not None:
            progress(len(solutions), len(outlines))
    strips = Strips(sections, tuple(solutions))
    symmetric = all(section.symmetric for section in sections.sections)
    potential, corners = _panels(strips, half_hull=symmetric)
    dataset = radiation_dataset(frequencies, strips.inertia, potential, corners, mirror_symmetric=symmetric)
    return _with_sections(dataset, strips).assign_attrs(
        half_hull=int(symmetric),
        waterline=sections.sections[0].waterline,
        water_density=water_density,
        gravity=gravity,
        lowest_strip_frequency=lowest,
        section_form=section_form,
        solver=f"strip theory, {len(solutions)} {_NAMES[section_form]} of"
        f" {len(solutions[0].contour.length)} elements",
        notes="\n".join(
            [
                "Strip theory: no radiation and no diffraction in surge; heave and pitch are led to their"
                f" limits at rest below {lowest:.3g} rad/s, where waves are longer than three ships.",
                *_slenderness_note(sections),
                *([note] if note else []),
            ]
        ),
    )


def _slenderness_note(sections: HullSections) -> list[str]:
    """Say where the hull is not the slender one that strip theory is for."""
    length = sections.fore_end - sections.aft_end
    beam = max(float(np.ptp(section.points[:, 0])) for section in sections.sections)
    if length >= _SLENDER * beam:
        return []
    return [
        f"Strip theory is for slender hulls: this one is only {length / beam:.1f} times as long as it is wide"
        f" below the water, less than {_SLENDER:g}; take method bem."
    ]


def highest_strip_frequency(
    sections: HullSections, gravity: float, section_form: SectionForm = "close-fit"
) -> float:
    """Frequency [rad/s] up to which the elements of all sections resolve the wave length."""
    outlines, _ = _outlines(sections, section_form)
    return min(highest_frequency(section_contour(outline), gravity) for outline in outlines)


def _outlines(
    sections: HullSections, section_form: SectionForm
) -> tuple[tuple[Section, ...] | tuple[LewisForm, ...], str]:
    """What is solved for each section, and what a reader should know of it."""
    return lewis_forms(sections) if section_form == "lewis" else (sections.sections, "")


def _panels(strips: Strips, *, half_hull: bool) -> tuple[ComplexArray, FloatArray]:
    """Potentials (F + 1, 6, panels) and corners (panels, 4, 3) of all elements, or of those to port."""
    ends = strips.sections.aft_end + np.concatenate([[0.0], np.cumsum(strips.sections.strip_length)])
    potential, corners = [], []
    for i, solution in enumerate(strips.solutions):
        contour = solution.contour
        first = len(contour.length) // 2 if half_hull else 0
        of_ship = np.einsum("fan,ai->fin", solution.potential, section_motion(strips.middle[i]))
        potential.append(of_ship[..., first:])
        start, end = contour.centre - 0.5 * contour.chord, contour.centre + 0.5 * contour.chord
        quads = np.empty((len(contour.length), 4, 3))
        quads[:, [0, 3], 0], quads[:, [1, 2], 0] = ends[i + 1], ends[i]
        quads[:, :2, 1:], quads[:, 2:, 1:] = start[:, None], end[:, None]
        corners.append(quads[first:])
    return np.concatenate(potential, axis=-1), np.concatenate(corners)


def _with_sections(dataset: xr.Dataset, strips: Strips) -> xr.Dataset:
    inertia = strips.section_inertia
    omega = dataset["frequency"].values[:, None, None, None]
    matrix = ("section", "section_influenced_dof", "section_radiating_dof")
    return dataset.assign_coords(
        section_influenced_dof=list(SECTION_DOFS), section_radiating_dof=list(SECTION_DOFS)
    ).assign(
        section_x=("section", strips.middle),
        strip_length=("section", strips.sections.strip_length),
        section_added_mass=(("frequency", *matrix), inertia[:-1].real),
        section_damping=(("frequency", *matrix), -omega * inertia[:-1].imag),
        section_added_mass_infinite=(matrix, inertia[-1].real),
    )
