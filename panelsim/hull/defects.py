"""What flat panels lose of the smooth form they came from, at the water at rest.

Flat facets, not the rule that integrates over them, are the main error of a coarse mesh. The panelling
of lines makes up for one part of it: it moves vertices outside the surface so that every column of panels
keeps the area of its section (`side_surface.keep_section_areas`). What is cut off along the length stays,
and so does all that the waterplane loses, since vertices at the edges are not moved. The panelling of
boxes and bodies of revolution corrects nothing.
"""

from dataclasses import dataclass
from functools import singledispatch

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.hull.curve import Waterline
from panelsim.hull.form import HullForm
from panelsim.hull.hydrostatics import Hydrostatics
from panelsim.hull.revolution import Revolution
from panelsim.hull.sections import HullLines
from panelsim.hull.shapes import Box

# Grids that measure the volume of lines, columns and rows: their errors of 1e-4 and 3e-5 fall with the
# square of the size, and extrapolated leave 1e-6.
GRIDS = ((200, 256), (400, 512))
# The waterline is cubic between sections, so five points are exact for y³, the highest power of it.
GAUSS_POINTS = 5


@dataclass(frozen=True)
class FormIntegrals:
    """Integrals of a smooth form at a water plane.

    `volume` below it [m3]; `waterplane_area` [m2] and the second moments of the waterplane about its
    centroid [m4], along the plane: `transverse` ∫y² dA, `longitudinal` ∫x² dA.
    """

    volume: float
    waterplane_area: float
    transverse: float
    longitudinal: float


@dataclass(frozen=True)
class MeshDefect:
    """Panels less the smooth form, in % of the form: volume, waterplane area and its second moments."""

    volume_percent: float
    waterplane_area_percent: float
    transverse_second_moment_percent: float
    longitudinal_second_moment_percent: float


def mesh_defect(form: HullForm, rest: Hydrostatics) -> MeshDefect | None:
    """The defect of a mesh of `form` whose hydrostatics at an even heel are `rest`.

    None where the form is not measured, see `form_integrals`.
    """
    smooth = form_integrals(form.shape, Waterline(rest.draft, -np.tan(rest.trim)))
    if smooth is None:
        return None
    along, across = np.diag(rest.waterplane_second_moment)
    pairs = (
        (rest.displaced_volume, smooth.volume),
        (rest.waterplane_area, smooth.waterplane_area),
        (across, smooth.transverse),
        (along, smooth.longitudinal),
    )
    return MeshDefect(*(float(100.0 * (panels / exact - 1.0)) for panels, exact in pairs))


@singledispatch
def form_integrals(shape: object, waterline: Waterline) -> FormIntegrals | None:
    """Integrals of the shape of a hull form at a waterline, apart from any mesh of it.

    Closed forms of the box and the bodies of revolution. Lines have the surface that joins their sections
    (`SideSurface`): its waterplane is exact to rounding, its volume to 1e-6 or so. None for other shapes,
    and where the water passes the stem, the stern or the deck by.
    """
    return None


@form_integrals.register
def _of_lines(shape: HullLines, waterline: Waterline) -> FormIntegrals | None:
    side = shape.wet_side(waterline)
    if side is None:
        return None
    coarse, fine = (2.0 * side.volume(*grid) for grid in GRIDS)
    knots = side.waterline_knots()
    node, weight = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    half = 0.5 * np.diff(knots)[:, None]
    x = (knots[:-1, None] + half * (1.0 + node)).ravel()
    y = side.half_breadth(x)
    secant = np.hypot(1.0, waterline.slope)
    along = x * secant  # in the water plane, which a trim inclines
    strip = 2.0 * y * (half * weight).ravel() * secant
    area = strip.sum()
    center = strip @ along / area
    return FormIntegrals(
        volume=fine + (fine - coarse) / 3.0,
        waterplane_area=float(area),
        transverse=float(strip @ y**2 / 3.0),
        longitudinal=float(strip @ (along - center) ** 2),
    )


@form_integrals.register
def _of_box(shape: Box, waterline: Waterline) -> FormIntegrals | None:
    length, beam = shape.length, shape.beam
    water = waterline.height(np.array([-0.5, 0.5]) * length)
    if not 0.0 < water.min() <= water.max() < shape.depth:
        return None
    inclined = length * np.hypot(1.0, waterline.slope)
    return FormIntegrals(
        volume=length * beam * waterline.draft,
        waterplane_area=float(inclined * beam),
        transverse=float(inclined * beam**3 / 12.0),
        longitudinal=float(beam * inclined**3 / 12.0),
    )


@form_integrals.register
def _of_revolution(shape: Revolution, waterline: Waterline) -> FormIntegrals | None:
    """A circle of radius r: πr²/4 of second moment over area, which a stretch makes an ellipse."""
    stretch: FloatArray = shape.stretch
    draft = waterline.draft / stretch[2]
    depth = 2.0 * shape.radius if shape.depth is None else shape.depth
    if waterline.slope != 0.0 or not 0.0 < draft < depth:
        return None
    if shape.depth is None:
        square_radius = draft * (2.0 * shape.radius - draft)
        volume = np.pi * draft**2 * (shape.radius - draft / 3.0)
    else:
        square_radius = shape.radius**2
        volume = np.pi * square_radius * draft
    area = np.pi * square_radius * stretch[0] * stretch[1]
    return FormIntegrals(
        volume=float(volume * stretch.prod()),
        waterplane_area=float(area),
        transverse=float(area * square_radius * stretch[1] ** 2 / 4.0),
        longitudinal=float(area * square_radius * stretch[0] ** 2 / 4.0),
    )
