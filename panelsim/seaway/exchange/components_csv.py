"""Wave components to and from a CSV file, so that two programs can run in the same waves."""

from pathlib import Path

import numpy as np

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import write_whole
from panelsim.seaway.components import WaveComponents

COLUMNS = ("amplitude_m", "frequency_rad_s", "wave_heading_deg", "phase_deg")
# No commas: a spreadsheet would put the line in quotes.
CONVENTION = (
    "# amplitude*cos(k(x*cos(heading) - y*sin(heading)) - w_e*t - phase) with x forward and y to port;"
    " heading relative to the ship: 0 following 90 from port 180 head"
)


def write_components(path: str | Path, components: WaveComponents, *, overwrite: bool = False) -> Path:
    """Write one line a component, amplitude and frequency with every digit they have, angles in degrees.

    The file is written whole or not at all. Raises PanelsimError where it exists and `overwrite` is not
    given, where there are no components, and for waves of second order, for which the file has no column.
    """
    path = Path(path)
    if path.exists() and not overwrite:
        raise PanelsimError(
            "The wave components would overwrite a file",
            got=path,
            remedy="give another name or overwrite=True",
        )
    _require_writable(components)
    angles = np.rad2deg([components.wave_heading, components.phase])
    table = np.column_stack([components.amplitude, components.frequency, *angles])
    # The repr of a float is the shortest text that gives back the same bits.
    lines = [CONVENTION, ",".join(COLUMNS), *(",".join(map(repr, row)) for row in table.tolist())]
    write_whole(path, "".join(f"{line}\n" for line in lines).encode())
    return path


def read_components(path: str | Path) -> WaveComponents:
    """Read a file as `write_components` makes it: `#` lines, the header, one component a line.

    Raises PanelsimError, naming the line, for a missing file, another header, missing or surplus values,
    text, NaN, infinities, frequencies that are not positive, no components, and a last line that does not
    end: a file cut short. One cut exactly between two lines cannot be told from a shorter sea.
    """
    path = Path(path)
    numbered = [
        (number, line)
        for number, line in enumerate(_text(path).splitlines(), 1)
        if line.strip() and not line.startswith("#")
    ]
    _require_header(path, numbered[0][1] if numbered else "")
    if len(numbered) < 2:
        raise PanelsimError(f"{path} holds no wave components", allowed="at least one line below the header")
    table = np.array([_component(path, number, line) for number, line in numbered[1:]])
    amplitude, frequency, *angles = table.T
    return WaveComponents(amplitude, frequency, *np.deg2rad(angles))


def _require_writable(components: WaveComponents) -> None:
    """Refuse what a file of wave components cannot hold."""
    if not isinstance(components, WaveComponents) or not components.count:
        raise PanelsimError(
            "There are no wave components to write",
            got="no waves" if isinstance(components, WaveComponents) else repr(components)[:60],
            allowed="WaveComponents of at least one wave",
        )
    if components.second_order:
        raise PanelsimError(
            "A file of wave components holds waves of first order only",
            got="a Stokes wave of second order",
            remedy="give the regular wave by its height and period instead",
        )


def _text(path: Path) -> str:
    """The text of the file, whose last line must be ended."""
    try:
        text = path.read_text(encoding="utf-8-sig")  # spreadsheets put a byte order mark first
    except (OSError, UnicodeDecodeError) as error:
        raise PanelsimError(
            "The file of wave components cannot be read",
            got=f"{path} ({getattr(error, 'strerror', None) or 'no text'})",
            allowed="a CSV file as write_components makes it",
        ) from error
    if text and not text.endswith("\n"):
        raise PanelsimError(
            f"The last line of {path} does not end: the file may be cut short",
            got=text.splitlines()[-1][:80],
            remedy="take the whole file, or end its last line",
        )
    return text


def _require_header(path: Path, line: str) -> None:
    names = [name.strip() for name in line.split(",")]
    if tuple(names) != COLUMNS:
        raise PanelsimError(
            f"{path} does not begin with the columns of wave components",
            got=line[:80] or "an empty file",
            allowed=",".join(COLUMNS),
        )


def _component(path: Path, number: int, line: str) -> FloatArray:
    """The four values of one line, in the units of the file."""
    try:
        values = np.array(line.split(","), dtype=float)
    except ValueError:
        values = np.array([])
    if values.shape != (len(COLUMNS),) or not np.isfinite(values).all():
        raise PanelsimError(
            f"{path}, line {number} is no wave component",
            got=line[:80],
            allowed=f"four finite numbers: {','.join(COLUMNS)}",
        )
    if values[1] <= 0:
        raise PanelsimError(
            f"{path}, line {number} has a frequency that is not positive",
            got=f"{values[1]:g} rad/s",
            allowed="more than 0",
        )
    return values
