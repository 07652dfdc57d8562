"""panelsim: a nonlinear panel-method, time-domain ship-motion solver.

The public names below are imported when they are first used, so that `import panelsim` stays light.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

_HOMES = {
    "PanelsimError": "errors",
    "Dof": "conventions",
    "KNOT": "conventions",
    "HullForm": "hull.form",
    "load_hull": "hull.form",
    "bundled_hull_names": "hull.form",
    "PanelMesh": "hull.panel_mesh",
    "read_mesh": "hull.readers",
    "MeshReport": "hull.checks",
    "check_mesh": "hull.checks",
    "Hydrostatics": "hull.hydrostatics",
    "hydrostatics": "hull.hydrostatics",
    "equilibrium": "hull.equilibrium",
    "Ship": "ship.ship",
    "load_ship": "ship.bundled",
    "Bretschneider": "seaway.spectra.bretschneider",
    "WaveComponents": "seaway.components",
    "CalmSeaway": "seaway.seaways",
    "RegularSeaway": "seaway.regular",
    "RandomSeaway": "seaway.random",
    "HydroDatabase": "hydro.database",
    "database_for": "hydro.store",
    "pressure_force": "loads.wetted_surface",
    "Supplementary": "loads.supplementary",
    "simulate": "motion.simulate",
    "History": "motion.history",
    "statistics": "results.statistics",
    "report": "view.report",
    "record": "view.recording",
    "Case": "case",
}
__all__ = sorted(_HOMES)

if TYPE_CHECKING:
    from panelsim.case import Case as Case
    from panelsim.conventions import KNOT as KNOT
    from panelsim.conventions import Dof as Dof
    from panelsim.errors import PanelsimError as PanelsimError
    from panelsim.hull.checks import MeshReport as MeshReport
    from panelsim.hull.checks import check_mesh as check_mesh
    from panelsim.hull.equilibrium import equilibrium as equilibrium
    from panelsim.hull.form import HullForm as HullForm
    from panelsim.hull.form import bundled_hull_names as bundled_hull_names
    from panelsim.hull.form import load_hull as load_hull
    from panelsim.hull.hydrostatics import Hydrostatics as Hydrostatics
    from panelsim.hull.hydrostatics import hydrostatics as hydrostatics
    from panelsim.hull.panel_mesh import PanelMesh as PanelMesh
    from panelsim.hull.readers import read_mesh as read_mesh
    from panelsim.hydro.database import HydroDatabase as HydroDatabase
    from panelsim.hydro.store import database_for as database_for
    from panelsim.loads.supplementary import Supplementary as Supplementary
    from panelsim.loads.wetted_surface import pressure_force as pressure_force
    from panelsim.motion.history import History as History
    from panelsim.motion.simulate import simulate as simulate
    from panelsim.results.statistics import statistics as statistics
    from panelsim.seaway.components import WaveComponents as WaveComponents
    from panelsim.seaway.random import RandomSeaway as RandomSeaway
    from panelsim.seaway.regular import RegularSeaway as RegularSeaway
    from panelsim.seaway.seaways import CalmSeaway as CalmSeaway
    from panelsim.seaway.spectra.bretschneider import Bretschneider as Bretschneider
    from panelsim.ship.bundled import load_ship as load_ship
    from panelsim.ship.ship import Ship as Ship
    from panelsim.view.recording import record as record
    from panelsim.view.report import report as report


def __getattr__(name: str) -> Any:
    """Import a public name from its home, once."""
    if name not in _HOMES:
        raise AttributeError(f"module 'panelsim' has no attribute {name!r}")
    value = getattr(import_module(f"panelsim.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
